// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include <voussoir/design/lining_utilisation.hpp>

#include "input.hpp"
#include "input_section.hpp"

/// The strength of a lining: its keys, and what is printed of it.
namespace voussoir::program {

/// [support.lining.concrete]
/// @param lining  of which its thickness has been read, within which bars lie
void read_concrete(Section& s, LiningInput& lining);

/// Of a lining that stands, beside its forces: "strength", "of_its_strength", "governing".
/// @param nodes  of all linings whose concrete is given
void add_lining_strength(const Input& input, const std::vector<NodeUtilisation>& nodes,
                         nlohmann::json& lining);
/// A line for a terminal; empty: nothing is checked.
[[nodiscard]] std::string lining_strength_line(const Input& input,
                                               const std::vector<NodeUtilisation>& nodes);
/// Thrust over moment of every node, within what the section of its lining bears.
/// @pre  something is checked
[[nodiscard]] std::string lining_strength_svg(const Input& input,
                                              const std::vector<NodeUtilisation>& nodes);
/// A warning where it carries more than it can; empty: it does not, or nothing is checked.
[[nodiscard]] std::string lining_strength_warning(const std::vector<NodeUtilisation>& nodes);
/// For every member in 3-D across the tunnel that of its ends which has more, of those along it not
/// a number.
/// @param ribs  of which `nodes` are
[[nodiscard]] std::vector<double> strength_by_member(const std::vector<MemberForces<3>>& members,
                                                     const std::vector<RibForce>& ribs,
                                                     const std::vector<NodeUtilisation>& nodes);
/// For every node of a table its utilisation; not a number: it is not checked.
[[nodiscard]] std::vector<double> strength_by_node(const std::vector<NodeUtilisation>& nodes);

}  // namespace voussoir::program
