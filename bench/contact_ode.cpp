// SPDX-License-Identifier: MIT
// ODE 0.16 as queries: separating axes over faces and edges, then clipping. It keeps nothing.
#include <ode/ode.h>

#include <array>
#include <cmath>
#include <deque>
#include <memory>

#include "contact_query.hpp"

namespace voussoir_bench {

const char* const build_description = VOUSSOIR_BENCH_BUILD;

namespace {

constexpr const char* precision = sizeof(dReal) == 8 ? "f64" : "f32";

/// The library refers to the numbers that it is given, so they stay here.
class Prepared {
 public:
  explicit Prepared(const Workload<3>& workload) {
    dInitODE2(0);
    for (const auto& block : workload.blocks) {
      Numbers& numbers = numbers_.emplace_back();
      for (const auto& vertex : block.vertices)
        for (const double x : vertex) numbers.points.push_back(static_cast<dReal>(x));
      for (const auto& face : block.faces) {
        add_plane(block, face, numbers);
        numbers.loops.push_back(static_cast<unsigned>(face.size()));
        for (const int vertex : face) numbers.loops.push_back(static_cast<unsigned>(vertex));
      }
      for (std::size_t step = 0; step < 2; ++step) {
        const dGeomID shape =
            dCreateConvex(nullptr, numbers.planes.data(), static_cast<unsigned>(block.faces.size()),
                          numbers.points.data(), static_cast<unsigned>(block.vertices.size()),
                          numbers.loops.data());
        const auto& [position, turn] = block.places[step];
        dGeomSetPosition(shape, static_cast<dReal>(position[0]), static_cast<dReal>(position[1]),
                         static_cast<dReal>(position[2]));
        dQuaternion quaternion;
        for (std::size_t k = 0; k < 4; ++k) quaternion[k] = static_cast<dReal>(turn[k]);
        dGeomSetQuaternion(shape, quaternion);
        dReal box[6];
        dGeomGetAABB(shape, box);  // computes what is derived from the place, before any clock runs
        shapes[step].push_back(shape);
      }
    }
  }
  std::array<std::vector<dGeomID>, 2> shapes;

 private:
  struct Numbers {
    std::vector<dReal> planes, points;
    std::vector<unsigned> loops;
  };

  static void add_plane(const WorkloadBlock<3>& block, const std::vector<int>& face,
                        Numbers& numbers) {
    const auto corner = [&](std::size_t k) {
      return block.vertices[static_cast<std::size_t>(face[k])];
    };
    const auto origin = corner(0);
    std::array<double, 3> normal{};
    for (std::size_t k = 2; k < face.size(); ++k) {
      const auto p = corner(k - 1), q = corner(k);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
        normal[i] +=
            (p[j] - origin[j]) * (q[l] - origin[l]) - (p[l] - origin[l]) * (q[j] - origin[j]);
      }
    }
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    double offset = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      numbers.planes.push_back(static_cast<dReal>(normal[i] / length));
      offset += normal[i] / length * origin[i];
    }
    numbers.planes.push_back(static_cast<dReal>(offset));
  }

  std::deque<Numbers> numbers_;
};

Query query(const std::shared_ptr<Prepared>& blocks, const Workload<3>& workload, const char* peer,
            const char* operation, int most) {
  return query_over(workload.pairs, {peer, precision, operation, false}, [=](int step) {
    return [&shapes = blocks->shapes[static_cast<std::size_t>(step)], most](
               std::size_t, const CandidatePair& pair, Answer* answer) {
      dContactGeom points[32];
      const int count = dCollide(shapes[pair.a], shapes[pair.b], most, points, sizeof points[0]);
      double depth = 0;
      const dContactGeom* deepest = points;
      for (int k = 0; k < count; ++k)
        if (static_cast<double>(points[k].depth) > depth) {
          depth = static_cast<double>(points[k].depth);
          deepest = points + k;
        }
      if (answer != nullptr && count > 0) {
        *answer = {true, false, true, count, -depth, {}};
        for (std::size_t k = 0; k < 3; ++k)  // theirs points from b to a
          answer->normal[k] = -static_cast<double>(deepest->normal[k]);
      }
      return depth;
    };
  });
}

}  // namespace

std::vector<Query> queries(const Workload<2>&) { return {}; }

std::vector<Query> queries(const Workload<3>& workload) {
  const auto blocks = std::make_shared<Prepared>(workload);
  return {query(blocks, workload, "ODE 0.16 dCollide (1 contact)", "depth", 1),
          query(blocks, workload, "ODE 0.16 dCollide (up to 32)", "manifold", 32)};
}

}  // namespace voussoir_bench
