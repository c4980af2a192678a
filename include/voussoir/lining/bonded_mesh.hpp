// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/errors.hpp>
#include <voussoir/lining/lining_model.hpp>

namespace voussoir {

// How far apart the nodes of a lining may be. A bond to the rock fails at the edge of a block,
// where its stress is largest; the stretch of a node is rigid and spreads that peak, so that a
// coarse mesh finds a bond enough which is not.

/// Length over which a beam on springs bends under a load, L = (4 E I / k)^(1/4) [m].
///
/// Source: Hetenyi (1946), Beams on elastic foundation: 1 / lambda.
/// @param bending_stiffness  E I [N m^2], >= 0; per metre of tunnel in 2-D
/// @param springs            k, of the interface per length of beam [N/m^2], > 0: k_n in 2-D, in
///                           3-D k_n times the width of wall that bears on the member
[[nodiscard]] inline double bending_length(double bending_stiffness, double springs) {
  require(bending_stiffness >= 0, "bending stiffness of a lining", bending_stiffness, ">= 0 N m^2");
  require(springs > 0, "stiffness of a lining's interface", springs, "> 0 N/m^2");
  return std::sqrt(std::sqrt(4 * bending_stiffness / springs));
}

/// Nodes of a bonded lining, farthest apart over `bending_length` [-]: no mesh finer than this
/// found too little bond enough, coarser ones up to 27 % (docs/decisions.md).
inline constexpr double coarsest_bonded_spacing = 1.2;
/// What is chosen where no number of nodes is given [-]: within 1 % of the beam.
inline constexpr double chosen_bonded_spacing = 0.4;
/// Without a bond: beyond this a block may weigh on one rigid stretch, or two, which bends nothing.
/// Largest moments were within 1 % up to 1.8 and down by a quarter at 2, by nine tenths at 4 [-].
inline constexpr double coarsest_moment_spacing = 1.8;

/// On an outline so long, for nodes that are so far apart at most.
/// @param perimeter  [m];  @param length  see `bending_length` [m];  @param share  of it [-]
/// @return  a whole number, infinite for a length of 0
[[nodiscard]] inline double bonded_node_count(double perimeter, double length, double share) {
  return std::ceil(perimeter / (share * length) * (1 - 1e-12));
}

}  // namespace voussoir
