// SPDX-License-Identifier: MIT
// The toolkit's own detectors as queries. Compiled twice, see contact.cmake.
#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/pose.hpp>
#include <voussoir/detection/analytic_centre.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/detection/placed_shapes.hpp>

#include "contact_query.hpp"

#ifndef VOUSSOIR_BENCH_BUILD
#define VOUSSOIR_BENCH_BUILD "flags not stated"
#endif

namespace voussoir_bench {

const char* const build_description = VOUSSOIR_BENCH_BUILD;

namespace {

using namespace voussoir;

Pose<2> pose_of(const Place<2>& place) {
  return {Vec2(place.position[0], place.position[1]), rotation_by(Spin<2>(place.turn[0]))};
}

Pose<3> pose_of(const Place<3>& place) {
  const auto [w, x, y, z] = place.turn;
  Pose<3> pose;
  pose.position = Vec3(place.position[0], place.position[1], place.position[2]);
  pose.rotation << 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y),
      2 * (y * z + w * x), 1 - 2 * (x * x + y * y);
  return pose;
}

ConvexPolygon shape_of(const WorkloadBlock<2>& block) {
  std::vector<Vec2> vertices;
  for (const auto& vertex : block.vertices) vertices.emplace_back(vertex[0], vertex[1]);
  return {std::move(vertices), std::vector<int>(block.vertices.size())};
}

ConvexPolyhedron shape_of(const WorkloadBlock<3>& block) {
  std::vector<Vec3> vertices;
  for (const auto& vertex : block.vertices) vertices.emplace_back(vertex[0], vertex[1], vertex[2]);
  return {std::move(vertices), block.faces, std::vector<int>(block.faces.size())};
}

/// Blocks and their poses in the toolkit's own form, prepared before any clock runs.
template <int Dim>
class Prepared {
 public:
  explicit Prepared(const Workload<Dim>& workload) {
    for (const auto& block : workload.blocks) {
      shapes_.add(shape_of(block), Vec<Dim>::Zero());
      for (std::size_t step = 0; step < 2; ++step)
        poses_[step].push_back(pose_of(block.places[step]));
    }
  }
  /// Brings every block to the common frame: part of what is timed.
  void place(int step) {
    const auto& poses = poses_[static_cast<std::size_t>(step)];
    for (std::size_t block = 0; block < poses.size(); ++block) shapes_.place(block, poses[block]);
  }
  [[nodiscard]] const PlacedShapes<Dim>& shapes() const { return shapes_; }

 private:
  PlacedShapes<Dim> shapes_;
  std::array<std::vector<Pose<Dim>>, 2> poses_;
};

struct AskOverlap {
  static constexpr const char* operation = "bool";
  template <class Pair>
  static double ask(Pair& detect, const CandidatePair& pair, typename Pair::Memory& memory,
                    Answer* answer) {
    const bool touch = detect.overlap(pair.a, pair.b, memory);
    if (answer) answer->touch = touch;
    return touch ? 1 : 0;
  }
};

struct AskSeparation {
  static constexpr const char* operation = "depth";
  template <class Pair>
  static double ask(Pair& detect, const CandidatePair& pair, typename Pair::Memory& memory,
                    Answer* answer) {
    double separation = 0;
    // How far apart they are nobody asks.
    if constexpr (requires { detect.separation(pair.a, pair.b, memory, 0.0); }) {
      separation = detect.separation(pair.a, pair.b, memory, 0.0);
    } else {
      separation = detect.separation(pair.a, pair.b, memory);
    }
    if (answer) {
      answer->touch = separation < 0;
      answer->has_separation = true;
      answer->separation = separation;
    }
    return separation;
  }
};

struct AskContact {
  static constexpr const char* operation = "manifold";
  template <class Pair>
  static double ask(Pair& detect, const CandidatePair& pair, typename Pair::Memory& memory,
                    Answer* answer) {
    const auto contact = detect.contact(pair.a, pair.b, memory, 0);
    if (contact.touch == Touch::none) return 0;
    if (answer) {
      answer->touch = answer->has_separation = true;
      answer->separation = contact.separation;
      answer->points = static_cast<int>(contact.polygon.size());
      for (Eigen::Index axis = 0; axis < contact.normal.size(); ++axis)
        answer->normal[static_cast<std::size_t>(axis)] = contact.normal[axis];
    }
    return contact.separation + contact.measure + contact.polygon.back()[0];
  }
};

template <class Ask, class Detector, int Dim>
Query query(const std::string& peer, bool warm, std::size_t stride,
            const std::shared_ptr<Prepared<Dim>>& prepared, const Workload<Dim>& workload) {
  using Pair = typename Detector::template Pair<Dim>;
  using Memory = typename Pair::Memory;
  struct State {
    State(const PlacedShapes<Dim>& shapes, std::size_t memories) : pair(shapes), memory(memories) {}
    Pair pair;
    std::vector<Memory> memory;
  };
  // Created by the first pass, so that queries that are not run take no memory.
  auto created = std::make_shared<std::unique_ptr<State>>();
  return query_over(
      workload.pairs, {peer, "f64", Ask::operation, warm, stride}, [=, &workload](int step) {
        if (!*created)
          *created = std::make_unique<State>(prepared->shapes(), warm ? workload.pairs.size() : 0);
        prepared->place(step);
        return [state = created->get(), warm, cold = Memory()](
                   std::size_t k, const CandidatePair& pair, Answer* answer) mutable {
          Memory& memory = warm ? state->memory[k] : cold = Memory();
          return Ask::ask(state->pair, pair, memory, answer);
        };
      });
}

template <class Detector, int Dim>
void add(std::vector<Query>& all, const std::string& peer, std::size_t stride,
         const std::shared_ptr<Prepared<Dim>>& prepared, const Workload<Dim>& workload) {
  for (const bool warm : {false, true}) {
    all.push_back(query<AskOverlap, Detector>(peer, warm, stride, prepared, workload));
    all.push_back(query<AskSeparation, Detector>(peer, warm, stride, prepared, workload));
    all.push_back(query<AskContact, Detector>(peer, warm, stride, prepared, workload));
  }
}

template <int Dim>
std::vector<Query> all_queries(const Workload<Dim>& workload) {
  const auto prepared = std::make_shared<Prepared<Dim>>(workload);
  std::vector<Query> all;
  add<FaceContacts>(all, "Voussoir FaceContacts", 1, prepared, workload);
  add<AnalyticCentre>(all, "Voussoir AnalyticCentre", Dim == 2 ? 1 : 4, prepared, workload);
  return all;
}

}  // namespace

std::vector<Query> queries(const Workload<2>& workload) { return all_queries(workload); }
std::vector<Query> queries(const Workload<3>& workload) { return all_queries(workload); }

}  // namespace voussoir_bench
