// SPDX-License-Identifier: MIT
// Writes the workloads of the contact benchmarks, sliced by the toolkit, with the exact answers:
//   contact_workloads FOLDER [SEED [AREAS VOLUMES]]
// W2, W2deep: a section of 70 m x 60 m; W3, W3deep: a cube of 20 m; three fully persistent
// joint sets. TIMES: so many times the area and the volume, for counts of wrong decisions on more
// pairs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <numbers>
#include <string>
#include <support/separating_axes.hpp>
#include <utility>
#include <vector>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>

#include "contact_workload.hpp"

namespace {

using namespace voussoir;
using namespace voussoir_bench;
using voussoir_test::LongShape;
using voussoir_test::LongVec;

constexpr double degree = std::numbers::pi / 180;
/// Blocks thinner than this are not made: 1 cm of rock, a hundredth of the mean block.
constexpr BlockLimits limits{.min_inscribed_radius = 0.005};

/// Standard deviations of the random motions of every block.
struct Motion {
  const char* suffix;
  double shift, turn;            ///< from the block's place in the rock to step 0 [m], [rad]
  double next_shift, next_turn;  ///< from step 0 to step 1 [m], [rad]
};
constexpr Motion motions[] = {{"", 1e-4, 1e-4, 1e-5, 1e-5}, {"deep", 3e-2, 2e-2, 1e-4, 1e-4}};

RockMass<Planar> section(std::uint64_t seed, double times) {
  const double scale = std::sqrt(times);
  const Domain<2> ground{Vec2(-35, -30) * scale, Vec2(35, 30) * scale};
  const auto set = [&](const char* name, double dip, DipDirection direction) {
    // As many endless joints as that, which here are longer than the ground.
    return JointSet{name,
                    dip * degree,
                    direction,
                    1 * degree,
                    0.0102 / scale,
                    0 /* spacing */,
                    2.1 * ground.diameter()};
  };
  return slice<Planar>(
      ground,
      joint_network({set("J1", 75, DipDirection::east), set("J2", 25, DipDirection::east),
                     set("J3", 25, DipDirection::west)},
                    ground, seed),
      limits);
}

RockMass<Spatial> cube(std::uint64_t seed, double times) {
  const Vec3 half = Vec3::Constant(10 * std::cbrt(times));
  const Domain<3> ground{-half, half};
  const auto set = [](const char* name, double dip, double direction) {
    SpatialJointSet joints{name, dip * degree, direction * degree};
    joints.dip_deviation = joints.dip_direction_deviation = 1 * degree;
    joints.area_per_volume = 1.02;
    return joints;
  };
  return slice<Spatial>(
      ground,
      joint_network({set("J1", 75, 10), set("J2", 25, 130), set("J3", 60, 250)}, ground, seed),
      limits);
}

template <int Dim>
using Turn = decltype(Place<Dim>::turn);
template <int Dim>
using LongRotation = Eigen::Matrix<long double, Dim, Dim>;

LongRotation<2> rotation_of(const Turn<2>& turn) {
  const long double c = std::cos(static_cast<long double>(turn[0]));
  const long double s = std::sin(static_cast<long double>(turn[0]));
  return (LongRotation<2>() << c, -s, s, c).finished();
}

LongRotation<3> rotation_of(const Turn<3>& turn) {
  const long double w = turn[0], x = turn[1], y = turn[2], z = turn[3];
  const long double t = 2 / (w * w + x * x + y * y + z * z);
  return (LongRotation<3>() << 1 - t * (y * y + z * z), t * (x * y - w * z), t * (x * z + w * y),
          t * (x * y + w * z), 1 - t * (x * x + z * z), t * (y * z - w * x), t * (x * z - w * y),
          t * (y * z + w * x), 1 - t * (x * x + y * y))
      .finished();
}

Turn<3> normalized(const Turn<3>& q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

/// Any rotation, uniformly: so that no face of a block's own frame is parallel to an axis.
void turn_at_will(Random& random, Turn<2>& turn) {
  turn[0] = 2 * std::numbers::pi * random.uniform();
}
void turn_at_will(Random& random, Turn<3>& turn) {
  for (double& part : turn) part = random.normal();
  turn = normalized(turn);
}

void turn_a_little(Random& random, double deviation, Turn<2>& turn) {
  turn[0] += deviation * random.normal();
}
void turn_a_little(Random& random, double deviation, Turn<3>& turn) {
  double half[3];
  for (double& part : half) part = 0.5 * deviation * random.normal();
  const auto [x, y, z] = half;  // quaternion (1, x, y, z), not yet of unit length
  const auto [w, a, b, c] = turn;
  turn = normalized({w - x * a - y * b - z * c, a + x * w + y * c - z * b,
                     b + y * w + z * a - x * c, c + z * w + x * b - y * a});
}

template <int Dim>
void move(Random& random, double shift, double turn, Place<Dim>& place) {
  for (double& x : place.position) x += shift * random.normal();
  turn_a_little(random, turn, place.turn);
}

template <int Dim>
Vec<Dim> vector_of(const std::array<double, Dim>& numbers) {
  return Eigen::Map<const Vec<Dim>>(numbers.data());
}

template <int Dim>
LongShape<Dim> in_space(const WorkloadBlock<Dim>& block, const Place<Dim>& place) {
  std::vector<Vec<Dim>> own;
  for (const auto& vertex : block.vertices) own.push_back(vector_of<Dim>(vertex));
  auto faces = block.faces;
  if constexpr (Dim == 2) faces = voussoir_test::ring_of_faces(own.size());
  return voussoir_test::placed<Dim>(own, faces, rotation_of(place.turn),
                                    vector_of<Dim>(place.position));
}

/// Least width over diameter.
template <int Dim>
double slenderness(const LongShape<Dim>& shape) {
  long double width = HUGE_VALL, squared = 0;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    long double depth = 0;
    for (const auto& vertex : shape.vertices)
      depth = std::max(depth, shape.normals[f].dot(shape.at(shape.faces[f][0]) - vertex));
    width = std::min(width, depth);
  }
  for (const auto& p : shape.vertices)
    for (const auto& q : shape.vertices) squared = std::max(squared, (p - q).squaredNorm());
  return static_cast<double>(width / std::sqrt(squared));
}

void copy_faces(const ConvexPolygon&, WorkloadBlock<2>&) {}
void copy_faces(const ConvexPolyhedron& shape, WorkloadBlock<3>& block) {
  for (std::size_t f = 0; f < shape.size(); ++f)
    block.faces.emplace_back(shape.loop(f).begin(), shape.loop(f).end());
}

/// The blocks where they are in the rock, each in a frame of its own about its centroid.
template <class Geometry>
std::vector<WorkloadBlock<Geometry::dim>> blocks_of(const RockMass<Geometry>& mass,
                                                    Random& random) {
  constexpr int dim = Geometry::dim;
  std::vector<WorkloadBlock<dim>> blocks;
  for (const auto& body : mass.bodies) {
    const auto& shape = body.parts.front();
    WorkloadBlock<dim> block;
    Place<dim> place;
    for (std::size_t axis = 0; axis < dim; ++axis)
      place.position[axis] = body.properties.centroid[static_cast<Eigen::Index>(axis)];
    turn_at_will(random, place.turn);
    block.places = {place, place};
    const auto back = rotation_of(place.turn).transpose().eval();
    for (const auto& vertex : shape.vertices()) {
      const LongVec<dim> own =
          back * (vertex - body.properties.centroid).template cast<long double>();
      auto& written = block.vertices.emplace_back();
      for (std::size_t axis = 0; axis < dim; ++axis)
        written[axis] = static_cast<double>(own[static_cast<Eigen::Index>(axis)]);
    }
    copy_faces(shape, block);
    block.slenderness = slenderness(in_space(block, place));
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// Pairs whose bounding boxes at step 0, inflated by a millimetre, overlap: by sweeping along x.
template <int Dim>
std::vector<CandidatePair> candidates(const std::vector<LongShape<Dim>>& shapes) {
  struct Box {
    LongVec<Dim> low, high;
    std::size_t block;
  };
  std::vector<Box> boxes;
  for (std::size_t block = 0; block < shapes.size(); ++block) {
    Box box{shapes[block].vertices[0], shapes[block].vertices[0], block};
    for (const auto& vertex : shapes[block].vertices) {
      box.low = box.low.cwiseMin(vertex);
      box.high = box.high.cwiseMax(vertex);
    }
    box.low.array() -= 1e-3L;
    box.high.array() += 1e-3L;
    boxes.push_back(box);
  }
  std::sort(boxes.begin(), boxes.end(),
            [](const Box& p, const Box& q) { return p.low[0] < q.low[0]; });
  std::vector<CandidatePair> pairs;
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (std::size_t m = k + 1; m < boxes.size() && boxes[m].low[0] <= boxes[k].high[0]; ++m)
      if ((boxes[m].low.array() <= boxes[k].high.array()).all() &&
          (boxes[k].low.array() <= boxes[m].high.array()).all()) {
        const auto [a, b] = std::minmax(boxes[k].block, boxes[m].block);
        pairs.push_back({a, b, 0, {}});
      }
  std::sort(pairs.begin(), pairs.end(), [](const CandidatePair& p, const CandidatePair& q) {
    return p.a != q.a ? p.a < q.a : p.b < q.b;
  });
  return pairs;
}

template <class Geometry>
void write_moved(const std::string& folder, const RockMass<Geometry>& mass, std::uint64_t seed) {
  constexpr int dim = Geometry::dim;
  Random framing(seed, 100 + dim);
  const auto at_rest = blocks_of(mass, framing);
  for (const Motion& motion : motions) {
    Workload<dim> workload{"W" + std::to_string(dim) + motion.suffix, at_rest, {}};
    Random random(seed, 200 + dim);
    std::vector<LongShape<dim>> shapes;
    for (auto& block : workload.blocks) {
      move(random, motion.shift, motion.turn, block.places[0]);
      block.places[1] = block.places[0];
      move(random, motion.next_shift, motion.next_turn, block.places[1]);
      shapes.push_back(in_space(block, block.places[0]));
    }
    workload.pairs = candidates(shapes);
    std::size_t touching = 0, slivers = 0, vertices = 0;
    for (CandidatePair& pair : workload.pairs) {
      const auto truth = voussoir_test::separating_axes(shapes[pair.a], shapes[pair.b]);
      pair.separation = static_cast<double>(truth.value);
      for (std::size_t axis = 0; axis < dim; ++axis)
        pair.normal[axis] = static_cast<double>(truth.normal[static_cast<Eigen::Index>(axis)]);
      if (truth.value < 0) ++touching;
    }
    for (const auto& block : workload.blocks) {
      vertices += block.vertices.size();
      if (block.slenderness < 0.05) ++slivers;
    }
    write_workload(folder, workload);
    const auto count = static_cast<double>(workload.blocks.size());
    std::printf("%-7s %6zu blocks, %.2f vertices each, %zu slivers; %7zu pairs, %zu touching\n",
                workload.name.c_str(), workload.blocks.size(),
                static_cast<double>(vertices) / count, slivers, workload.pairs.size(), touching);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const double areas = argc > 3 ? std::atof(argv[3]) : 1,
               volumes = argc > 4 ? std::atof(argv[4]) : 1;
  const auto fits = [](double times) { return times >= 0.01 && times <= 1000; };
  if (argc < 2 || argc > 5 || argc == 4 || !fits(areas) || !fits(volumes)) {
    std::fprintf(stderr, "usage: contact_workloads FOLDER [SEED [AREAS VOLUMES, 0.01 to 1000]]\n");
    return 2;
  }
  try {
    std::filesystem::create_directories(argv[1]);
    write_moved(argv[1], section(seed, areas), seed);
    write_moved(argv[1], cube(seed, volumes), seed);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contact_workloads: %s\n", error.what());
    return 1;
  }
}
