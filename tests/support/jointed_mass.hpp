// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>

#include "support/degree.hpp"

/// Jointed rock in 3-D to test with.
namespace voussoir_test {

using voussoir::Vec3;

/// A set that scatters by 1 degree, given by its normal spacing.
[[nodiscard]] inline voussoir::SpatialJointSet spaced_set(double dip, double dip_direction,
                                                          double spacing,
                                                          voussoir::JointShape shape = {}) {
  voussoir::SpatialJointSet set{"J", dip * degree, dip_direction * degree};
  set.dip_deviation = set.dip_direction_deviation = 1 * degree;
  set.spacing = spacing;
  set.shape = shape;
  return set;
}

/// Three sets, 75/010, 25/130 and 60/250.
[[nodiscard]] inline std::vector<voussoir::SpatialJointSet> three_sets(
    double spacing, voussoir::JointShape shape = {}) {
  return {spaced_set(75, 10, spacing, shape), spaced_set(25, 130, spacing, shape),
          spaced_set(60, 250, spacing, shape)};
}

[[nodiscard]] inline voussoir::RockMass<voussoir::Spatial> jointed_mass(
    const voussoir::Domain<3>& ground, std::uint64_t seed, double spacing,
    const voussoir::BlockLimits& limits = {}, voussoir::JointShape shape = {}) {
  const auto joints = voussoir::joint_network(three_sets(spacing, shape), ground, seed);
  return voussoir::slice<voussoir::Spatial>(ground, joints, limits);
}

[[nodiscard]] inline double total_volume(const voussoir::RockMass<voussoir::Spatial>& mass) {
  double sum = 0;
  for (const auto& body : mass.bodies) sum += body.properties.measure;
  return sum;
}

[[nodiscard]] inline std::vector<double> sorted_volumes(
    const voussoir::RockMass<voussoir::Spatial>& mass) {
  std::vector<double> volumes;
  for (const auto& body : mass.bodies) volumes.push_back(body.properties.measure);
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

/// Largest difference of two lists of the same length; infinite if they are not.
[[nodiscard]] inline double difference(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() != y.size()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (std::size_t k = 0; k < x.size(); ++k) worst = std::max(worst, std::abs(x[k] - y[k]));
  return worst;
}

/// The joint moved by x -> turn x + shift.
[[nodiscard]] inline voussoir::SpatialJoint moved(const voussoir::SpatialJoint& joint,
                                                  const Eigen::Matrix3d& turn, const Vec3& shift) {
  using voussoir::HalfSpace;
  const Vec3 point = joint.trace.plane.offset * joint.trace.plane.normal;
  voussoir::SpatialJoint result{
      {HalfSpace<3>::through(turn * point + shift, turn * joint.trace.plane.normal), {}},
      joint.set};
  for (const Vec3& corner : joint.trace.corners)
    result.trace.corners.push_back(turn * corner + shift);
  const bool is_mirror = voussoir::cross(turn.col(0), turn.col(1)).dot(turn.col(2)) < 0;
  if (is_mirror) std::reverse(result.trace.corners.begin(), result.trace.corners.end());
  return result;
}

}  // namespace voussoir_test
