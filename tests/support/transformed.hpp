// SPDX-License-Identifier: MIT
#pragma once
// A problem and its image: mirrored, turned or moved with all that belongs to it.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

#include "support/jointed_mass.hpp"

namespace voussoir_test {

using voussoir::Vec;

/// x -> turn x + shift; a turn may be a mirror.
template <int Dim>
struct Transform {
  Eigen::Matrix<double, Dim, Dim> turn = Eigen::Matrix<double, Dim, Dim>::Identity();
  Vec<Dim> shift = Vec<Dim>::Zero();

  [[nodiscard]] Vec<Dim> operator()(const Vec<Dim>& p) const { return turn * p + shift; }
  [[nodiscard]] Vec<Dim> back(const Vec<Dim>& p) const { return turn.transpose() * (p - shift); }
  [[nodiscard]] voussoir::Domain<Dim> operator()(const voussoir::Domain<Dim>& domain) const {
    const Vec<Dim> a = (*this)(domain.low), b = (*this)(domain.high);
    return {a.cwiseMin(b), a.cwiseMax(b)};
  }
};

[[nodiscard]] inline Transform<2> mirrored_2d(const Vec<2>& shift = Vec<2>::Zero()) {
  return {Eigen::Vector2d(-1, 1).asDiagonal(), shift};
}

[[nodiscard]] inline voussoir::Segment moved(const voussoir::Segment& s, const Transform<2>& map) {
  return {map(s.start), map(s.end)};
}
[[nodiscard]] inline std::vector<voussoir::Joint> moved(std::vector<voussoir::Joint> joints,
                                                        const Transform<2>& map) {
  for (auto& j : joints) j.trace = moved(j.trace, map);
  return joints;
}
[[nodiscard]] inline std::vector<voussoir::SpatialJoint> moved(
    std::vector<voussoir::SpatialJoint> joints, const Transform<3>& map) {
  for (auto& j : joints) j = moved(j, map.turn, map.shift);
  return joints;
}
/// Anticlockwise again in the mirror; it then begins with another vertex.
[[nodiscard]] inline voussoir::SimplePolygon moved(const voussoir::SimplePolygon& outline,
                                                   const Transform<2>& map) {
  std::vector<Vec<2>> vertices;
  for (const Vec<2>& v : outline.vertices()) vertices.push_back(map(v));
  if (map.turn(0, 0) * map.turn(1, 1) < 0) std::reverse(vertices.begin(), vertices.end());
  return voussoir::SimplePolygon(vertices);
}

/// For every body its image in the other mass, by its centroid; -1: none within a micrometre.
template <class Geometry>
[[nodiscard]] std::vector<int> twins(const voussoir::RockMass<Geometry>& mass,
                                     const voussoir::RockMass<Geometry>& image,
                                     const Transform<Geometry::dim>& map) {
  std::vector<int> found(mass.bodies.size(), -1);
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const auto place = map(mass.bodies[b].properties.centroid);
    double least = 1e-6;
    for (std::size_t c = 0; c < image.bodies.size(); ++c)
      if (const double d = (image.bodies[c].properties.centroid - place).norm(); d < least) {
        least = d;
        found[b] = static_cast<int>(c);
      }
  }
  return found;
}

/// How two equilibria differ of which one should be the image of the other.
struct Disagreement {
  bool same_blocks = false;  ///< as many, each with its image
  bool same_fallen = false;
  double difference = 0;  ///< of translations of blocks that stand, over the largest [-]
};

template <class Solver, int Dim>
[[nodiscard]] Disagreement disagreement(const Solver& one, const Solver& other,
                                        const Transform<Dim>& map) {
  constexpr int dof = Solver::dof;
  Disagreement result;
  const std::vector<int> twin = twins(one.mass(), other.mass(), map);
  result.same_blocks = one.mass().bodies.size() == other.mass().bodies.size() &&
                       std::find(twin.begin(), twin.end(), -1) == twin.end();
  if (!result.same_blocks) return result;
  std::vector<int> fallen, image = other.fallen();
  for (const int b : one.fallen()) fallen.push_back(twin[static_cast<std::size_t>(b)]);
  std::sort(fallen.begin(), fallen.end());
  std::sort(image.begin(), image.end());
  result.same_fallen = fallen == image;
  double largest = 0;
  for (std::size_t b = 0; b < twin.size(); ++b) {
    const auto k = static_cast<Eigen::Index>(b);
    if (one.system().body(static_cast<int>(b)).is_gone) continue;
    const Vec<Dim> u = one.system().displacement.template segment<Dim>(dof * k);
    const Vec<Dim> v = other.system().displacement.template segment<Dim>(dof * twin[b]);
    result.difference = std::max(result.difference, (map.turn * u - v).norm());
    largest = std::max(largest, u.norm());
  }
  result.difference /= largest;
  return result;
}

}  // namespace voussoir_test
