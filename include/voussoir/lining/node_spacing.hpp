// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/lining/lining_frame.hpp>
#include <voussoir/lining/lining_model.hpp>

namespace voussoir {

// How far apart the nodes of a lining may be. The stretch of a node is rigid: it spreads the peak
// of the stress at the edge of a block, where a bond fails, and a block that weighs on one stretch
// bends nothing. A mesh that is too coarse is unsafe, with a bond and without.

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

/// Farthest that nodes of a bonded lining may be apart, over `bending_length` [-]: up to here no
/// less bond is found enough than a block needs; at 2.4 up to 27 % less is (docs/decisions.md).
inline constexpr double coarsest_bonded_spacing = 1.2;
/// Without a bond moments under a block come out too small on coarse meshes: by up to 8 % here, by
/// 30 % at 2, by nine tenths at 4 [-].
inline constexpr double coarsest_moment_spacing = 1.5;
/// What is chosen for a bonded lining of which no number of nodes is given [-]: within 1 % of the
/// bond that a beam on springs needs.
inline constexpr double chosen_bonded_spacing = 0.4;

/// Fewest nodes on an outline that are no farther apart than a share of the bending length.
/// @param perimeter  [m];  @param length  see `bending_length` [m];  @param share  of it [-]
/// @return  a whole number, infinite for a length of 0
[[nodiscard]] inline double node_count_for(double perimeter, double length, double share) {
  return std::ceil(perimeter / (share * length) * (1 - 1e-12));
}

/// Refuses a bonded lining whose nodes are farther apart than `coarsest_bonded_spacing`, those of
/// neighbouring ribs that are tied too.
/// @param sections          those that its members name; a member of another is not looked at
/// @param normal_stiffness  k_n of the interface, per area [Pa/m]
/// @throws InvalidInput     with the spacing, the largest accepted, and a number of nodes that is
///                          enough; with corners on the outline fewer may be
template <class Geometry>
void require_nodes_for_bond(const LiningFrame<Geometry>& frame,
                            const std::vector<LiningSection>& sections, double normal_stiffness) {
  constexpr int dim = Geometry::dim;
  const auto is_along = [](const auto& member) { return dim == 3 && member.section > 0; };
  std::vector<double> wall(frame.nodes.size(), 0.0);  // that bears on a node [m], [m^2]
  for (const auto& panel : frame.panels)
    wall[static_cast<std::size_t>(panel.node)] += panel.facet.measure();
  std::vector<double> spacings, lengths;  // of every member; a length of -1: not looked at
  double enough = 0;                      // nodes on the outline, for all members along it
  for (const auto& member : frame.members) {
    const auto i = static_cast<std::size_t>(member.first),
               j = static_cast<std::size_t>(member.second),
               of = static_cast<std::size_t>(member.section);
    const double spacing = (frame.nodes[j] - frame.nodes[i]).norm();
    const double width = dim == 2 ? 1.0 : 0.5 * (wall[i] + wall[j]) / spacing;
    const bool counts = of < sections.size() && spacing > 0 && width > 0;
    spacings.push_back(spacing);
    lengths.push_back(
        counts ? bending_length(sections[of].bending_stiffness, width * normal_stiffness) : -1.0);
    if (counts && !is_along(member))
      enough = std::max(enough,
                        node_count_for(frame.perimeter, lengths.back(), coarsest_bonded_spacing));
  }
  for (std::size_t m = 0; m < spacings.size(); ++m) {
    const double spacing = spacings[m], length = lengths[m],
                 most = coarsest_bonded_spacing * length;
    if (length < 0) continue;
    if (spacing <= most * (1 + 1e-9)) continue;
    const bool along = is_along(frame.members[m]);
    const std::string named =
        along || frame.perimeter == 0 ? std::string() : message({", nodes >= ", enough});
    throw InvalidInput(message(
        {"lining: ", along ? "ribs" : "nodes", " ", spacing,
         " m apart are too far to see its bond to the rock fail at the edge of a block: that acts "
         "over L = (4 E I / k_n)^(1/4) = ",
         length, " m; accepted: at most ", coarsest_bonded_spacing, " L = ", most, " m", named,
         ", or an interface without tensile strength"}));
  }
}

}  // namespace voussoir
