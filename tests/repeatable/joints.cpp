// SPDX-License-Identifier: MIT
// Prints a hash of every bit of joints drawn from a seed, in 2-D and 3-D. check.cmake compiles this
// with several sets of flags and wants one and the same line.
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>

using namespace voussoir;

namespace {

/// FNV-1a over the bits of numbers.
struct Hash {
  std::uint64_t value = 0xcbf29ce484222325;
  void operator()(double x) {
    unsigned char bytes[sizeof x];
    std::memcpy(bytes, &x, sizeof x);
    for (const unsigned char byte : bytes) value = (value ^ byte) * 0x100000001b3;
  }
  template <int Dim>
  void operator()(const Vec<Dim>& v) {
    for (int k = 0; k < Dim; ++k) (*this)(v[k]);
  }
};

std::string planar() {
  // Dips that a compiler knows, so that it may compute their sines itself.
  constexpr double degree = std::numbers::pi / 180;
  const Domain<2> ground{{-37.3, -41.7}, {39.1, 24.9}};
  const std::vector<JointSet> sets{
      {.name = "scattered",
       .dip = 75 * degree,
       .dip_deviation = 3 * degree,
       .intensity = 0.7,
       .extent = 1.3},
      {.name = "exact", .dip = 25 * degree, .dip_direction = DipDirection::west, .spacing = 0.37},
      {.name = "through", .dip = 61.3 * degree, .dip_deviation = 7 * degree, .spacing = 0.71},
      {.name = "upright", .dip = 90 * degree, .spacing = 1.9, .extent = 2.7},
  };
  Hash hash;
  std::size_t count = 0;
  for (const std::uint64_t seed : {1u, 2u, 77u})
    for (const Joint& joint : joint_network(sets, ground, seed)) {
      hash.operator()<2>(joint.trace.start);
      hash.operator()<2>(joint.trace.end);
      hash(joint.set);
      ++count;
    }
  char text[80];
  std::snprintf(text, sizeof text, "2-D %zu %016" PRIx64, count, hash.value);
  return text;
}

std::string spatial() {
  constexpr double degree = std::numbers::pi / 180;
  const Domain<3> ground{{-7.3, -8.1, -6.7}, {6.9, 9.2, 5.9}};
  const std::vector<SpatialJointSet> sets{
      {.name = "Fisher discs",
       .dip = 35 * degree,
       .dip_direction = 123 * degree,
       .fisher_concentration = 17.3,
       .area_per_volume = 1.1,
       .shape = DiscJoints{2.3}},
      {.name = "narrow Fisher",
       .dip = 70 * degree,
       .dip_direction = 310 * degree,
       .fisher_concentration = 900,
       .spacing = 0.43},
      {.name = "wide Fisher",
       .dip = 5 * degree,
       .dip_direction = 10 * degree,
       .fisher_concentration = 0.3,
       .area_per_volume = 0.9},
      {.name = "rectangles",
       .dip = 80 * degree,
       .dip_direction = 213 * degree,
       .dip_deviation = 5 * degree,
       .dip_direction_deviation = 11 * degree,
       .count_per_volume = 0.31,
       .shape = RectangularJoints{1.7, 3.1}},
      {.name = "exact", .dip = 45 * degree, .dip_direction = 0, .spacing = 0.9},
  };
  Hash hash;
  std::size_t count = 0;
  for (const std::uint64_t seed : {1u, 2u, 77u})
    for (const SpatialJoint& joint : joint_network(sets, ground, seed)) {
      hash.operator()<3>(joint.trace.plane.normal);
      hash(joint.trace.plane.offset);
      for (const Vec3& corner : joint.trace.corners) hash.operator()<3>(corner);
      hash(joint.set);
      ++count;
    }
  char text[80];
  std::snprintf(text, sizeof text, "3-D %zu %016" PRIx64, count, hash.value);
  return text;
}

}  // namespace

int main() { std::printf("%s, %s\n", planar().c_str(), spatial().c_str()); }
