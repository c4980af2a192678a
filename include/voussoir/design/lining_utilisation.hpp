// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
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
#include <voussoir/design/composite_support.hpp>
#include <voussoir/design/construction_plan.hpp>
#include <voussoir/design/models.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/design/section_check.hpp>
#include <voussoir/tunnel/construction.hpp>
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
  SectionForces load;    ///< of the lining; shear is that of the member with most of it
  SectionUtilisation use;
  SectionMethod method = SectionMethod::en1992;  ///< by which thrust and moment were checked
  SectionForces on_section = {};                 ///< what `SectionCheck::section` has of the load
  /// What one of its steel ribs has of it; none: there are none.
  std::optional<SectionForces> on_rib = {};

  [[nodiscard]] bool rib_governs() const { return use.mode == SectionMode::yield; }
};

/// Of what it would fail: "bending"; with steel ribs "rib: yield", "shotcrete: bending".
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::string mode_text(const NodeUtilisation& node);

/// The part of a lining at an angle from the right-hand springing: "crown", "left springing", ...
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::string lining_place(double angle);

/// The section of a lining per metre of tunnel, in 3-D of a strip; none: its concrete is not given.
/// @param age  of its concrete, if it has one [s]
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::optional<ConcreteSection> section_of_lining(
    const AnalysisInput& input, const LiningInput& lining, const SupportChoice& supports,
    double age = std::numeric_limits<double>::infinity());

/// Of all nodes that stand, of linings whose concrete is given, in the order of the nodes.
/// @param begun  stages of `planned_stages` that have been begun: concrete is as old as when the
///               last of them loads it
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<NodeUtilisation> lining_utilisations(
    const AnalysisInput& input, const SupportChoice& supports, const Tunnel& tunnel,
    std::size_t begun);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<NodeUtilisation> lining_utilisations(
    const AnalysisInput& input, const SupportChoice& supports, const SpatialTunnel& tunnel,
    std::size_t begun);

/// Where, and of what: "left springing, 182 deg: compression".
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::string governed_by(const NodeUtilisation& node);

/// The one that governs; none where there are none.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE const NodeUtilisation* governing(
    const std::vector<NodeUtilisation>& nodes);

/// The node that governs when a stage has ended, of concrete that ages: young concrete may bear
/// less of a first stage than it has at the end.
struct StageUtilisation {
  std::string stage;
  double age = 0;  ///< of its concrete when the stage began [s]
  NodeUtilisation most;
};
/// The stage that governs; none where there are none.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE const StageUtilisation* governing(
    const std::vector<StageUtilisation>& stages);

/// Looks at linings whose concrete ages when a stage has ended.
/// @param history  grows by one for each at which there is something to check; nothing without age
/// @param then     what looks at it besides; may be empty
template <class Solver>
[[nodiscard]] StageObserver<Solver> observing_age(const AnalysisInput& input,
                                                  const SupportChoice& supports,
                                                  std::vector<StageUtilisation>& history,
                                                  StageObserver<Solver> then = {});

#if VOUSSOIR_DESIGN_BODIES

VOUSSOIR_DESIGN_INLINE std::string lining_place(double angle) {
  const char* const places[] = {"right springing", "right shoulder", "crown",  "left shoulder",
                                "left springing",  "left foot",      "invert", "right foot"};
  const double eighths = angle / (0.25 * std::numbers::pi);
  const double turned = eighths - 8 * std::floor(eighths / 8);
  return places[static_cast<std::size_t>(std::floor(turned + 0.5)) % 8];
}

VOUSSOIR_DESIGN_INLINE std::optional<ConcreteSection> section_of_lining(
    const AnalysisInput& input, const LiningInput& lining, const SupportChoice& supports,
    double age) {
  if (!lining.concrete) return std::nullopt;
  ConcreteSection section = *lining.concrete;
  if (lining.age && std::isfinite(age)) section = lining.age->aged(std::move(section), age);
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

/// A lining that is installed, and how its nodes are checked.
struct CheckedLining {
  const LiningInput& lining;
  double thickness;                   ///< [m]
  std::optional<SectionCheck> check;  ///< none: its concrete is not given

  [[nodiscard]] NodeUtilisation at(std::size_t node, int number, double angle, double along,
                                   const SectionForces& load) const {
    NodeUtilisation found{node, number,      angle, along, load, {}, check->section().method,
                          load, std::nullopt};
    if (lining.ribs) {
      const SharedForces shared = shared_forces(*lining.ribs, lining.first_modulus(), thickness,
                                                load, check->section().width);
      found.on_section = shared.on_concrete;
      found.on_rib = shared.on_rib;
    }
    found.use = check->utilisation(found.on_section);
    if (found.on_rib)
      if (const auto rib = rib_utilisation(*lining.ribs, *found.on_rib);
          rib.value > found.use.value)
        found.use = rib;
    return found;
  }
};

VOUSSOIR_DESIGN_INLINE std::vector<CheckedLining> checked_linings(const AnalysisInput& input,
                                                                  const SupportChoice& supports,
                                                                  std::size_t begun) {
  const std::vector<PlannedStage> stages = planned_stages(input, supports);
  const std::vector<double> ages =
      lining_ages(stages, std::clamp<std::size_t>(begun, 1, stages.size()) - 1);
  std::vector<CheckedLining> all;
  for (const LiningInput* const lining : linings_as_installed(input, supports)) {
    CheckedLining& made =
        all.emplace_back(CheckedLining{*lining, thickness_of(input, *lining, supports), {}});
    const double age =
        all.size() <= ages.size() ? ages[all.size() - 1] : std::numeric_limits<double>::infinity();
    if (auto section = section_of_lining(input, *lining, supports, age))
      made.check.emplace(std::move(*section));
  }
  return all;
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE std::vector<NodeUtilisation> lining_utilisations(
    const AnalysisInput& input, const SupportChoice& supports, const Tunnel& tunnel,
    std::size_t begun) {
  const auto linings = detail::checked_linings(input, supports, begun);
  const std::vector<LiningForce> forces = lining_forces(tunnel);
  std::vector<NodeUtilisation> found;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const LiningForce& at = forces[k];
    const auto& lining = linings.at(static_cast<std::size_t>(at.lining));
    if (!lining.check || at.is_lost) continue;
    found.push_back(lining.at(k, at.lining, detail::turn_of(at.position - at.centre), 0,
                              {at.thrust, at.moment, at.largest_shear}));
  }
  return found;
}

VOUSSOIR_DESIGN_INLINE std::vector<NodeUtilisation> lining_utilisations(
    const AnalysisInput& input, const SupportChoice& supports, const SpatialTunnel& tunnel,
    std::size_t begun) {
  const auto linings = detail::checked_linings(input, supports, begun);
  const std::vector<RibForce> forces = rib_forces(tunnel);
  std::vector<NodeUtilisation> found;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const RibForce& at = forces[k];
    const auto& lining = linings.at(static_cast<std::size_t>(at.lining));
    if (!lining.check) continue;
    const std::size_t opening = lining.lining.opening;
    const PrismaticOpening whole =
        opening_in_space(input, opening, outline_of(outline_input(input, opening)));
    found.push_back(lining.at(k, at.lining, detail::turn_of(whole.across(at.position)),
                              whole.along(at.position), {at.thrust, at.moment, at.largest_shear}));
  }
  return found;
}

VOUSSOIR_DESIGN_INLINE std::string mode_text(const NodeUtilisation& node) {
  if (!node.on_rib) return to_string(node.use.mode);
  return std::string(node.rib_governs() ? "rib: " : "shotcrete: ") + to_string(node.use.mode);
}

VOUSSOIR_DESIGN_INLINE std::string governed_by(const NodeUtilisation& node) {
  const int degrees = static_cast<int>(std::lround(node.angle * 180 / std::numbers::pi));
  return message({lining_place(node.angle), ", ", degrees, " deg: ", mode_text(node)});
}

VOUSSOIR_DESIGN_INLINE const NodeUtilisation* governing(const std::vector<NodeUtilisation>& nodes) {
  const NodeUtilisation* most = nullptr;
  for (const NodeUtilisation& node : nodes)
    if (most == nullptr || node.use.value > most->use.value) most = &node;
  return most;
}

VOUSSOIR_DESIGN_INLINE const StageUtilisation* governing(
    const std::vector<StageUtilisation>& stages) {
  const StageUtilisation* most = nullptr;
  for (const StageUtilisation& stage : stages)
    if (most == nullptr || stage.most.use.value > most->most.use.value) most = &stage;
  return most;
}

#endif

template <class Solver>
StageObserver<Solver> observing_age(const AnalysisInput& input, const SupportChoice& supports,
                                    std::vector<StageUtilisation>& history,
                                    StageObserver<Solver> then) {
  if (std::none_of(input.linings.begin(), input.linings.end(),
                   [](const LiningInput& lining) { return lining.age && lining.concrete; }))
    return then;
  return [&input, supports, &history, then = std::move(then), begun = std::size_t{0}](
             const Solver& solver, const StageResult& stage) mutable {
    const auto nodes = lining_utilisations(input, supports, solver, ++begun);
    if (const NodeUtilisation* const most = governing(nodes))
      history.push_back({stage.name,
                         lining_ages(planned_stages(input, supports),
                                     begun - 1)[static_cast<std::size_t>(most->lining)],
                         *most});
    if (then) then(solver, stage);
  };
}

}  // namespace voussoir::design
