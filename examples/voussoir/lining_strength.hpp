// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include <voussoir/design/analysis.hpp>
#include <voussoir/design/lining_utilisation.hpp>

#include "input.hpp"
#include "input_section.hpp"

/// The strength of a lining: its keys, and what is printed of it.
namespace voussoir::program {

/// [support.lining.concrete]
/// @param lining  of which its thickness has been read, within which bars lie
void read_concrete(Section& s, LiningInput& lining);
/// [support.lining.ribs]
void read_ribs(Section& s, LiningInput& lining);

/// What linings carry of what they can.
struct LiningStrength {
  std::vector<NodeUtilisation> nodes;     ///< at the end, of all whose concrete is given
  std::vector<StageUtilisation> history;  ///< of all stages, where concrete ages

  /// The node that governs, of concrete that ages in whichever stage; null: nothing is checked.
  [[nodiscard]] const NodeUtilisation* most() const {
    const StageUtilisation* const stage = governing(history);
    return stage != nullptr ? &stage->most : governing(nodes);
  }
};
template <class Geometry>
[[nodiscard]] LiningStrength lining_strength_of(const Input& input,
                                                const TunnelRun<Geometry>& run) {
  return {lining_utilisations(input, run), run.lining_history};
}

/// Largest stress of the concrete of a lining at an edge, |N| / t + 6 |M| / t^2; steel ribs have
/// their part [Pa].
/// @param forces  per metre of tunnel
[[nodiscard]] double concrete_stress(const LiningInput& lining, const SectionForces& forces);

/// Of a lining that stands, beside its forces: "strength", "of_its_strength", "governing".
void add_lining_strength(const Input& input, const LiningStrength& strength,
                         nlohmann::json& lining);
/// A line for a terminal; empty: nothing is checked.
[[nodiscard]] std::string lining_strength_line(const Input& input, const LiningStrength& strength);
/// Thrust over moment of every node, within what the section of its lining bears.
/// @pre  something is checked
[[nodiscard]] std::string lining_strength_svg(const Input& input, const LiningStrength& strength);
/// A warning where it carries more than it can; empty: it does not, or nothing is checked.
[[nodiscard]] std::string lining_strength_warning(const LiningStrength& strength);
/// For every member in 3-D across the tunnel that of its ends which has more, of those along it not
/// a number.
/// @param ribs  of which `nodes` are
[[nodiscard]] std::vector<double> strength_by_member(const std::vector<MemberForces<3>>& members,
                                                     const std::vector<RibForce>& ribs,
                                                     const std::vector<NodeUtilisation>& nodes);
/// For every node of a table its utilisation; not a number: it is not checked.
[[nodiscard]] std::vector<double> strength_by_node(const std::vector<NodeUtilisation>& nodes);

}  // namespace voussoir::program
