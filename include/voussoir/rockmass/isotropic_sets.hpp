// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>

namespace voussoir {

/// Joint sets of a rock mass that is elastically alike in all directions: what to compare with
/// closed forms of continua.
///
/// Their six normals are the axes of an icosahedron, two of them level. Moduli come from the mean
/// of n n n n over the normals, and six lines are the fewest for which it is that of a sphere;
/// three sets at right angles are isotropic only if k_s = k_n, and then without a Poisson effect.
/// Sets are persistent, equidistant and without scatter: P32 = 6 / spacing. Blocks are of many
/// sizes, and their number is about that of Poisson planes, pi / 48 P32^3 = 14 / spacing^3 a cubic
/// metre: 2.4 m make blocks of one. `isotropic_joint_oedometer` has the moduli.
///
/// @param spacing  of each set [m], > 0
/// @return  six sets, named I1 to I6; mirrored in x = 0 and in y = 0 they are the same
/// @throws InvalidInput  spacing out of range
///
/// Source: fourth-order isotropy of icosahedral directions, Bazant & Oh (1986), Z. angew. Math.
/// Mech. 66, 37-49; number of cells of Poisson planes, Miles (1972), Suppl. Adv. Appl. Prob. 4.
[[nodiscard]] VOUSSOIR_INLINE std::vector<SpatialJointSet> isotropic_sets(double spacing);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<SpatialJointSet> isotropic_sets(double spacing) {
  require(spacing > 0 && std::isfinite(spacing), "spacing of isotropic sets", spacing, "> 0 m");
  constexpr double pi = std::numbers::pi;
  const double low = std::atan(2 / (1 + std::sqrt(5.0))), steep = 0.5 * pi - low;  // 31.7, 58.3 deg
  const struct {
    double dip, dip_direction;
  } planes[] = {{low, 0},          {low, pi},       {steep, 0.5 * pi},
                {steep, 1.5 * pi}, {0.5 * pi, low}, {0.5 * pi, pi - low}};
  std::vector<SpatialJointSet> sets;
  for (const auto& plane : planes) {
    SpatialJointSet set{"I" + std::to_string(sets.size() + 1), plane.dip, plane.dip_direction};
    set.spacing = spacing;
    sets.push_back(set);
  }
  return sets;
}

#endif

}  // namespace voussoir
