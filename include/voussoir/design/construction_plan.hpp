// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/core/elementary.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/models.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/design/placed_loads.hpp>
#include <voussoir/design/planned_stages.hpp>
#include <voussoir/rockmass/statistics.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/construction.hpp>

/// From the input of an analysis to the construction of its tunnel, in 2-D and 3-D: what is
/// excavated and what is installed, in which order.
namespace voussoir::design {

[[nodiscard]] VOUSSOIR_DESIGN_INLINE Acceptance acceptance_of(const AnalysisInput& input,
                                                              const SimplePolygon& opening);
/// The bars of a pattern in the section.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<Segment> bars_of_pattern(
    const AnalysisInput& input, const BoltsInput& bolts, const BoltSpacing& spacing);
/// In 3-D, in rows along what is driven of its opening.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<SpatialLine> rows_of_pattern(
    const AnalysisInput& input, const BoltsInput& bolts, const BoltSpacing& spacing);
/// Of every bar the pattern that it is of. @pre the bars are those of the patterns of the input
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<const BoltsInput*> patterns_of_bars(
    const AnalysisInput& input, const std::vector<Segment>& bars);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::vector<const BoltsInput*> patterns_of_bars(
    const AnalysisInput& input, const std::vector<SpatialLine>& bars);

[[nodiscard]] VOUSSOIR_DESIGN_INLINE BoltPattern pattern_of(const BoltsInput& bolts,
                                                            const BoltSpacing& spacing);
/// Nodes on the full ring of a section: as many as facets, or as many as it takes to be no farther
/// apart than joints, for a block that falls between two nodes loads none, or than a bond needs.
/// @param thickness  of the lining [m], > 0
[[nodiscard]] VOUSSOIR_DESIGN_INLINE int lining_nodes(const AnalysisInput& input,
                                                      const LiningInput& lining,
                                                      const RockMass<Planar>& mass,
                                                      double thickness);
/// In 3-D: as many as facets; none where they are chosen for a bond.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::optional<int> rib_nodes(const AnalysisInput& input,
                                                                  const LiningInput& lining);
/// The part of a lining around the section, and the feet that it stands on.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LiningRing ring_of(const LiningInput& lining,
                                                        std::optional<int> nodes);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::optional<FootBearing> feet_of(const LiningInput& lining);

/// The tunnel of an input along its axis, 3-D: as far as it is driven, through the beginning of the
/// domain and, where no rock is left ahead, its end.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE PrismaticOpening driven_tunnel(const AnalysisInput& input);

/// All stages. 2-D: those of the input. 3-D: the same over the whole length, or round by round.
/// @param is_excavated  what the first stage takes out is out
[[nodiscard]] VOUSSOIR_DESIGN_INLINE Construction<Tunnel> construction_of(
    const AnalysisInput& input, const Tunnel& tunnel, bool is_excavated,
    const SupportChoice& supports, const LinearSettings& linear, RangeSought range);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE Construction<SpatialTunnel> construction_of(
    const AnalysisInput& input, const SupportChoice& supports, const LinearSettings& linear,
    RangeSought range);

#if VOUSSOIR_DESIGN_BODIES

VOUSSOIR_DESIGN_INLINE Acceptance acceptance_of(const AnalysisInput& input,
                                                const SimplePolygon& opening) {
  Acceptance acceptance;
  acceptance.error_estimate = input.run.tolerance;
  acceptance.unbalance_over_weight = input.run.out_of_balance;
  acceptance.displacement_limit = input.run.displacement_limit;
  acceptance.contact_update_limit = input.run.contact_update_limit;
  acceptance.collapse_measure = collapse_measure_of(opening);
  return acceptance;
}

VOUSSOIR_DESIGN_INLINE BoltPattern pattern_of(const BoltsInput& bolts, const BoltSpacing& spacing) {
  return {.length = bolts.length,
          .angular_spacing = spacing.is_angle ? spacing.value : 0.0,
          .wall_spacing = spacing.is_angle ? 0.0 : spacing.value,
          .from = bolts.arc.from,
          .to = bolts.arc.to};
}

namespace detail {

/// About the centre of the opening.
VOUSSOIR_DESIGN_INLINE std::vector<Segment> local_bars(const AnalysisInput& input,
                                                       const BoltsInput& bolts,
                                                       const BoltSpacing& spacing) {
  if (!bolts.bars.empty()) return bolts.bars;
  return bolt_bars(pattern_of(bolts, spacing), outline_of(outline_input(input, bolts.opening)));
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE std::vector<Segment> bars_of_pattern(const AnalysisInput& input,
                                                            const BoltsInput& bolts,
                                                            const BoltSpacing& spacing) {
  std::vector<Segment> bars = detail::local_bars(input, bolts, spacing);
  const Vec2 centre = centre_in_section(input, bolts.opening);
  if (bolts.opening != 0)
    for (Segment& bar : bars) bar = {bar.start + centre, bar.end + centre};
  return bars;
}

namespace detail {

/// Rows from the beginning of the opening on, each over the rock ahead of it; no bar leaves the
/// model.
VOUSSOIR_DESIGN_INLINE std::vector<SpatialLine> forepoles(const AnalysisInput& input,
                                                          const BoltsInput& bolts,
                                                          const std::vector<Segment>& around,
                                                          const PrismaticOpening& opening,
                                                          const Drive& drive) {
  const Domain<3> domain = spatial_domain(input);
  const double level = elementary::cosine(*bolts.ahead), rise = elementary::sine(*bolts.ahead);
  std::vector<SpatialLine> bars;
  const auto rows = static_cast<int>(std::ceil(drive.length() / bolts.out_of_plane - 1e-9));
  for (int k = 0; k < rows; ++k)
    for (const Segment& bar : around) {
      const Vec2 outward = (bar.end - bar.start) / bar.length();
      const Vec3 head = opening.in_space(bar.start, drive.from + k * bolts.out_of_plane);
      const Vec3 way = level * opening.axis().along() + rise * opening.axis().direction(outward);
      double length = bar.length();
      for (int axis = 0; axis < 3; ++axis) {
        const double end = way[axis] > 0 ? domain.high[axis] : domain.low[axis];
        if (way[axis] != 0) length = std::min(length, (1 - 1e-9) * (end - head[axis]) / way[axis]);
      }
      bars.push_back({head, head + length * way});
    }
  return bars;
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE std::vector<SpatialLine> rows_of_pattern(const AnalysisInput& input,
                                                                const BoltsInput& bolts,
                                                                const BoltSpacing& spacing) {
  const PrismaticOpening opening =
      opening_in_space(input, bolts.opening, outline_of(outline_input(input, bolts.opening)));
  const Drive drive = drive_of(input, bolts.opening);
  if (bolts.ahead)
    return detail::forepoles(input, bolts, detail::local_bars(input, bolts, spacing), opening,
                             drive);
  if (bolts.bars.empty())
    return bolt_bars(pattern_of(bolts, spacing), opening, bolts.out_of_plane, drive.from, drive.to);
  std::vector<SpatialLine> bars;
  const auto rows = static_cast<int>(std::floor(drive.length() / bolts.out_of_plane + 1e-9));
  for (int k = 0; k < rows; ++k)
    for (const Segment& bar : detail::local_bars(input, bolts, spacing)) {
      const double along = drive.from + (k + 0.5) * bolts.out_of_plane;
      bars.push_back({opening.in_space(bar.start, along), opening.in_space(bar.end, along)});
    }
  return bars;
}

namespace detail {

/// Two patterns with a bar in common are told apart by their order: the first has it.
template <class Bars, class BarsOf>
VOUSSOIR_DESIGN_INLINE std::vector<const BoltsInput*> patterns_of(const AnalysisInput& input,
                                                                  const Bars& bars,
                                                                  const BarsOf& bars_of) {
  std::vector<const BoltsInput*> found(bars.size(), nullptr);
  for (const BoltsInput& pattern : input.bolts) {
    if (!is_modelled(input, pattern)) continue;  // its bars may lie where those of another do
    const Bars own = bars_of(pattern);
    for (std::size_t k = 0; k < bars.size(); ++k)
      for (std::size_t i = 0; i < own.size() && found[k] == nullptr; ++i)
        if (own[i].start == bars[k].start && own[i].end == bars[k].end) found[k] = &pattern;
  }
  // Those of another spacing, in a diagram, are of the first pattern.
  for (const BoltsInput*& pattern : found)
    if (pattern == nullptr) pattern = &input.bolts.front();
  return found;
}

/// That of the input, or for the first pattern what is chosen; none: it is left out.
VOUSSOIR_DESIGN_INLINE std::optional<BoltSpacing> spacing_of(const BoltsInput& pattern,
                                                             std::size_t number,
                                                             const SupportChoice& supports) {
  return number == 0 ? supports.spacing : std::optional(pattern.spacing);
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE std::vector<const BoltsInput*> patterns_of_bars(
    const AnalysisInput& input, const std::vector<Segment>& bars) {
  return detail::patterns_of(input, bars, [&](const BoltsInput& pattern) {
    return bars_of_pattern(input, pattern, pattern.spacing);
  });
}
VOUSSOIR_DESIGN_INLINE std::vector<const BoltsInput*> patterns_of_bars(
    const AnalysisInput& input, const std::vector<SpatialLine>& bars) {
  return detail::patterns_of(input, bars, [&](const BoltsInput& pattern) {
    return rows_of_pattern(input, pattern, pattern.spacing);
  });
}

namespace detail {

/// Linings of which concrete ages grow stiffer from stage to stage.
template <class Solver>
void age_linings(const AnalysisInput& input, const SupportChoice& supports,
                 Construction<Solver>& construction) {
  construction.ages = std::any_of(input.linings.begin(), input.linings.end(),
                                  [](const LiningInput& lining) { return lining.age.has_value(); });
  if (!construction.ages) return;
  const std::vector<PlannedStage> stages = planned_stages(input, supports);
  const std::vector<const LiningInput*> linings = linings_as_installed(input, supports);
  VOUSSOIR_ASSERT(stages.size() == construction.stages.size(), "what is planned is built");
  for (std::size_t k = 1; k < stages.size(); ++k) {
    const std::vector<double> before = lining_ages(stages, k - 1), now = lining_ages(stages, k);
    for (std::size_t n = 0; n < before.size(); ++n) {
      if (!linings[n]->age) continue;
      const double factor = linings[n]->modulus_at(now[n]) / linings[n]->modulus_at(before[n]);
      if (factor != 1) construction.stages[k].stiffened.push_back({static_cast<int>(n), factor});
    }
  }
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE int lining_nodes(const AnalysisInput& input, const LiningInput& lining,
                                        const RockMass<Planar>& mass, double thickness) {
  if (lining.nodes) return *lining.nodes;
  const OutlineInput& outline = outline_input(input, lining.opening);
  const SimplePolygon opening = outline_of(outline);
  const double half_width = outline.half_width();
  const double joint_spacing =
      radial_spacing(mass, centre_in_section(input, lining.opening), half_width, 2 * half_width);
  const double needed = std::ceil(opening.perimeter() / joint_spacing);
  const int count = static_cast<int>(
      std::clamp(needed, static_cast<double>(std::max(outline.facets, 8)), 2000.0));
  if (!lining.bends_on_bond()) return count;
  return std::max(
      count, *with_chosen_nodes<2>({}, opening, section_of(lining, thickness), interface_of(lining))
                  .nodes);
}

VOUSSOIR_DESIGN_INLINE std::optional<int> rib_nodes(const AnalysisInput& input,
                                                    const LiningInput& lining) {
  if (lining.nodes || lining.bends_on_bond()) return lining.nodes;
  return std::max(outline_input(input, lining.opening).facets, 8);
}

VOUSSOIR_DESIGN_INLINE LiningRing ring_of(const LiningInput& lining, std::optional<int> nodes) {
  LiningRing ring{.nodes = nodes, .fill_depth = lining.fill_depth};
  if (lining.arc) {
    ring.from = lining.arc->from;
    ring.to = lining.arc->to;
  }
  return ring;
}

VOUSSOIR_DESIGN_INLINE std::optional<FootBearing> feet_of(const LiningInput& lining) {
  const auto& feet = lining.feet;
  if (!feet) return std::nullopt;
  // Under a rib the beam settles and presses by so much more than all along.
  const double peak = feet->on_beam().settlement;
  return FootBearing(FootBearing::Params{
      .width = feet->width,
      .stiffness = feet->stiffness / peak,
      .strength = feet->strength.value_or(std::numeric_limits<double>::infinity()) / peak,
      .friction_angle = feet->friction_angle});
}

VOUSSOIR_DESIGN_INLINE PrismaticOpening driven_tunnel(const AnalysisInput& input) {
  return opening_in_space(input, 0, opening_of(input));
}

VOUSSOIR_DESIGN_INLINE Construction<Tunnel> construction_of(const AnalysisInput& input,
                                                            const Tunnel& tunnel, bool is_excavated,
                                                            const SupportChoice& supports,
                                                            const LinearSettings& linear,
                                                            RangeSought range) {
  Construction<Tunnel> construction;
  construction.method = method_of(input, linear, range);
  const SimplePolygon opening = opening_of(input);
  construction.acceptance = acceptance_of(input, opening);
  if (!input.openings.empty()) construction.measured = opening;
  for (const StageInput& stage : input.stages) {
    if (!is_modelled(input, stage.opening)) continue;
    auto& made = construction.add_stage(stage.name, stage.wall_traction);
    made.duration = stage.duration;
    if (stage.part && !is_excavated)
      made.excavate(in_section(input, stage.opening, *outline_of_round(input, stage)),
                    input.blocks.min_wall_area);
    for (const std::size_t k : stage.bolts) {
      const BoltsInput& pattern = input.bolts[k];
      if (const auto spacing = detail::spacing_of(pattern, k, supports);
          spacing && is_modelled(input, pattern))
        made.install_bolts({bars_of_pattern(input, pattern, *spacing), bolt_of(pattern),
                            pattern.out_of_plane, anchors_of(pattern)});
    }
    for (const std::size_t k : stage.linings) {
      const LiningInput& asked = input.linings[k];
      const double thickness = thickness_of(input, asked, supports);
      if (!(thickness > 0)) continue;
      const int nodes = lining_nodes(input, asked, tunnel.mass(), thickness);
      LiningInstallation<Tunnel> lining{
          ring_of(asked, nodes), {section_of(asked, thickness)}, interface_of(asked)};
      if (asked.opening != 0) lining.layout.centre = centre_in_section(input, asked.opening);
      if (!is_excavated) lining.opening = opening_in_section(input, asked.opening);
      lining.feet = feet_of(asked);
      made.install_lining(std::move(lining));
    }
  }
  detail::age_linings(input, supports, construction);
  load_blocks(input, construction);
  return construction;
}

namespace detail {

/// What one stage of the input does in one stretch of its opening.
class StretchWork {
 public:
  StretchWork(const AnalysisInput& input, const SupportChoice& supports)
      : input_(input), supports_(supports) {
    for (std::size_t k = 0; k < input.bolts.size(); ++k) {
      const auto spacing = spacing_of(input.bolts[k], k, supports);
      bars_.push_back(spacing ? rows_of_pattern(input, input.bolts[k], *spacing)
                              : std::vector<SpatialLine>{});
    }
  }

  /// @param k  number of the stretch, from 0
  void add(const StageInput& entry, int k, ConstructionStage<SpatialTunnel>& stage) const {
    const Drive drive = drive_of(input_, entry.opening);
    const double from = drive.begin_of(k), to = drive.end_of(k);
    const PrismaticOpening whole =
        opening_in_space(input_, entry.opening, outline_of(outline_input(input_, entry.opening)));
    if (entry.part)
      stage.excavate(stretch_in_space(input_, entry.opening, *outline_of_round(input_, entry), k),
                     input_.blocks.min_wall_area * std::sqrt(input_.blocks.min_wall_area));
    for (const std::size_t pattern : entry.bolts) {
      BoltInstallation<SpatialTunnel> bolts{
          {}, bolt_of(input_.bolts[pattern]), 1, anchors_of(input_.bolts[pattern])};
      for (const SpatialLine& bar : bars_[pattern]) {
        const double along = whole.along(bar.start);
        if (along >= from && along < to) bolts.bars.push_back(bar);
      }
      if (!bolts.bars.empty()) stage.install_bolts(std::move(bolts));
    }
    for (const std::size_t number : entry.linings) {
      const LiningInput& asked = input_.linings[number];
      if (thickness_of(input_, asked, supports_) > 0)
        stage.install_lining(lining(asked, whole, from, to));
    }
  }

 private:
  [[nodiscard]] LiningInstallation<SpatialTunnel> lining(const LiningInput& lining,
                                                         const PrismaticOpening& whole, double from,
                                                         double to) const {
    const double width = strips_of(input_, lining.opening).width;
    const double thickness = thickness_of(input_, lining, supports_);
    LiningInstallation<SpatialTunnel> made{{.ring = ring_of(lining, rib_nodes(input_, lining)),
                                            .spacing = width,
                                            .from = from,
                                            .to = to},
                                           {rib_strip_of(lining, thickness, width)},
                                           interface_of(lining)};
    const SimplePolygon& section = whole.section();
    const int nodes = made.layout.ring.nodes.value_or(
        with_chosen_nodes<3>(made.layout.ring, section, made.sections.front(), made.interface_law,
                             width)
            .nodes.value_or(72));
    made.sections.push_back(strip_of(lining, thickness, section.perimeter() / nodes));
    made.opening = whole;
    made.feet = feet_of(lining);
    return made;
  }

  const AnalysisInput& input_;
  SupportChoice supports_;
  std::vector<std::vector<SpatialLine>> bars_;  ///< of each pattern
};

}  // namespace detail

VOUSSOIR_DESIGN_INLINE Construction<SpatialTunnel> construction_of(const AnalysisInput& input,
                                                                   const SupportChoice& supports,
                                                                   const LinearSettings& linear,
                                                                   RangeSought range) {
  Construction<SpatialTunnel> construction;
  // Every round in which rock comes off would be followed five times, half a minute each.
  construction.method =
      method_of(input, linear, input.tunnel.round_length ? RangeSought::none : range);
  construction.acceptance = acceptance_of(input, opening_of(input));
  if (!input.openings.empty()) construction.measured = driven_tunnel(input);
  const detail::StretchWork work(input, supports);
  if (!input.tunnel.round_length) {
    for (const StageInput& entry : input.stages) {
      auto& stage = construction.add_stage(entry.name, entry.wall_traction);
      stage.duration = entry.duration;
      work.add(entry, 0, stage);
    }
    detail::age_linings(input, supports, construction);
    load_blocks(input, construction);
    return construction;
  }
  const int rounds = input.round_count();
  const int advances = advance_count(input);
  for (int face = 0; face < advances; ++face) {
    auto& stage = construction.add_stage(face < rounds ? "round " + std::to_string(face + 1)
                                                       : "behind the face " +
                                                             std::to_string(face - rounds + 1));
    for (const StageInput& entry : input.stages)
      if (const auto k = detail::stretch_at(input, entry, face)) {
        work.add(entry, *k, stage);
        stage.duration = std::max(stage.duration, entry.duration);  // they work side by side
      }
  }
  detail::age_linings(input, supports, construction);
  load_blocks(input, construction);
  return construction;
}

#endif

}  // namespace voussoir::design
