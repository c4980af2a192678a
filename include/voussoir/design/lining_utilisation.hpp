// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/construction_plan.hpp>
#include <voussoir/design/models.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/design/section_check.hpp>
#include <voussoir/tunnel/rib_forces.hpp>
#include <voussoir/tunnel/support_forces.hpp>

/// Whether linings bear what they carry: every node of those whose concrete is given against the
/// capacity of its section.
namespace voussoir::design {

/// Of a lining at a node.
struct NodeUtilisation {
  std::size_t node = 0;  ///< index among `lining_forces`, in 3-D among `rib_forces`
  int lining = 0;        ///< which it is of, in the order of installation
  double angle = 0;      ///< at the centre of its opening, from the right-hand springing,
                         ///< anticlockwise [rad], 0 to 2 pi
  double along = 0;      ///< 3-D: along the axis of its opening [m]
  SectionForces load;  ///< on `SectionCheck::section`; shear is that of the member with most of it
  SectionUtilisation use;
  SectionMethod method = SectionMethod::en1992;  ///< by which thrust and moment were checked
};

/// The part of a lining at an angle from the right-hand springing: "crown", "left springing", ...
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::string lining_place(double angle);

/// The section of a lining per metre of tunnel, in 3-D of a strip; none: its concrete is not given.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::optional<ConcreteSection> section_of_lining(
    const AnalysisInput& input, const LiningInput& lining, const SupportChoice& supports);

/// Of all nodes that stand, of linings whose concrete is given, in the order of the nodes.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<NodeUtilisation> lining_utilisations(
    const AnalysisInput& input, const SupportChoice& supports, const Tunnel& tunnel);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<NodeUtilisation> lining_utilisations(
    const AnalysisInput& input, const SupportChoice& supports, const SpatialTunnel& tunnel);

/// Where, and of what: "left springing, 182 deg: compression".
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::string governed_by(const NodeUtilisation& node);

/// The one that governs; none where there are none.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE const NodeUtilisation* governing(
    const std::vector<NodeUtilisation>& nodes);

#if VOUSSOIR_DESIGN_BODIES

VOUSSOIR_DESIGN_INLINE std::string lining_place(double angle) {
  const char* const places[] = {"right springing", "right shoulder", "crown",  "left shoulder",
                                "left springing",  "left foot",      "invert", "right foot"};
  const double eighths = angle / (0.25 * std::numbers::pi);
  const double turned = eighths - 8 * std::floor(eighths / 8);
  return places[static_cast<std::size_t>(std::floor(turned + 0.5)) % 8];
}

VOUSSOIR_DESIGN_INLINE std::optional<ConcreteSection> section_of_lining(
    const AnalysisInput& input, const LiningInput& lining, const SupportChoice& supports) {
  if (!lining.concrete) return std::nullopt;
  ConcreteSection section = *lining.concrete;
  section.thickness = thickness_of(input, lining, supports);
  section.width = input.is_spatial() ? strips_of(input, lining.opening).width : 1.0;
  for (BarLayer& bars : section.bars) bars.area *= section.width;
  return section;
}

namespace detail {

/// From the right, anticlockwise [rad], 0 to 2 pi.
[[nodiscard]] inline double turn_of(const Vec2& out) {
  const double angle = elementary::angle_of(out.y(), out.x());
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

/// Of every lining that is installed, none where its concrete is not given.
VOUSSOIR_DESIGN_INLINE std::vector<std::optional<SectionCheck>> checks_of_sections(
    const AnalysisInput& input, const SupportChoice& supports) {
  std::vector<std::optional<SectionCheck>> all;
  for (const LiningInput* const lining : linings_as_installed(input, supports)) {
    auto& check = all.emplace_back();
    if (auto section = section_of_lining(input, *lining, supports))
      check.emplace(std::move(*section));
  }
  return all;
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE std::vector<NodeUtilisation> lining_utilisations(
    const AnalysisInput& input, const SupportChoice& supports, const Tunnel& tunnel) {
  const auto checks = detail::checks_of_sections(input, supports);
  const std::vector<LiningForce> forces = lining_forces(tunnel);
  std::vector<NodeUtilisation> found;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const LiningForce& at = forces[k];
    const auto& check = checks.at(static_cast<std::size_t>(at.lining));
    if (!check || at.is_lost) continue;
    const Vec2 out = at.position - at.centre;
    const SectionForces load{at.thrust, at.moment, at.largest_shear};
    found.push_back({k, at.lining, detail::turn_of(out), 0, load, check->utilisation(load),
                     check->section().method});
  }
  return found;
}

VOUSSOIR_DESIGN_INLINE std::vector<NodeUtilisation> lining_utilisations(
    const AnalysisInput& input, const SupportChoice& supports, const SpatialTunnel& tunnel) {
  const auto checks = detail::checks_of_sections(input, supports);
  const auto linings = linings_as_installed(input, supports);
  const std::vector<RibForce> forces = rib_forces(tunnel);
  std::vector<NodeUtilisation> found;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const RibForce& at = forces[k];
    const auto number = static_cast<std::size_t>(at.lining);
    const auto& check = checks.at(number);
    if (!check) continue;
    const std::size_t opening = linings[number]->opening;
    const PrismaticOpening whole =
        opening_in_space(input, opening, outline_of(outline_input(input, opening)));
    const Vec2 out = whole.across(at.position);
    const SectionForces load{at.thrust, at.moment, at.largest_shear};
    found.push_back({k, at.lining, detail::turn_of(out), whole.along(at.position), load,
                     check->utilisation(load), check->section().method});
  }
  return found;
}

VOUSSOIR_DESIGN_INLINE std::string governed_by(const NodeUtilisation& node) {
  const int degrees = static_cast<int>(std::lround(node.angle * 180 / std::numbers::pi));
  return message({lining_place(node.angle), ", ", degrees, " deg: ", to_string(node.use.mode)});
}

VOUSSOIR_DESIGN_INLINE const NodeUtilisation* governing(const std::vector<NodeUtilisation>& nodes) {
  const NodeUtilisation* most = nullptr;
  for (const NodeUtilisation& node : nodes)
    if (most == nullptr || node.use.value > most->use.value) most = &node;
  return most;
}

#endif

}  // namespace voussoir::design
