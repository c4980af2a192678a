// SPDX-License-Identifier: MIT
#include "construction_plan.hpp"

#include "joint_laws.hpp"

namespace voussoir::program {

LawsBySet<AnyJoint> laws_of(const Input& input) {
  LawsBySet<AnyJoint> laws(joint_of(input.joint));
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k)
    if (const auto& own = input.joint_sets[k].law) laws.add(static_cast<int>(k), joint_of(*own));
  return laws;
}

Acceptance acceptance_of(const Input& input, const SimplePolygon& opening) {
  Acceptance acceptance;
  acceptance.error_estimate = input.run.tolerance;
  acceptance.displacement_limit = input.run.displacement_limit;
  acceptance.contact_update_limit = input.run.contact_update_limit;
  acceptance.collapse_measure = collapse_measure_of(opening);
  return acceptance;
}

BoltPattern pattern_of(const BoltsInput& bolts, const BoltSpacing& spacing) {
  return {.length = bolts.length,
          .angular_spacing = spacing.is_angle ? spacing.value : 0.0,
          .wall_spacing = spacing.is_angle ? 0.0 : spacing.value,
          .from = bolts.arc.from,
          .to = bolts.arc.to};
}

int lining_nodes(const Input& input, const RockMass<Planar>& mass, const SimplePolygon& opening,
                 double thickness) {
  const LiningInput& lining = *input.lining;
  if (lining.nodes) return *lining.nodes;
  const double half_width = input.tunnel.half_width();
  const double joint_spacing = radial_spacing(mass, Vec2::Zero(), half_width, 2 * half_width);
  const double needed = std::ceil(opening.perimeter() / joint_spacing);
  const int count = static_cast<int>(
      std::clamp(needed, static_cast<double>(std::max(input.tunnel.facets, 8)), 2000.0));
  if (!(lining.tensile_bond > 0)) return count;
  return std::max(
      count, *with_chosen_nodes<2>({}, opening, section_of(lining, thickness), interface_of(lining))
                  .nodes);
}

std::optional<int> rib_nodes(const Input& input) {
  const LiningInput& lining = *input.lining;
  if (lining.nodes || lining.tensile_bond > 0) return lining.nodes;
  return std::max(input.tunnel.facets, 8);
}

StripsOfStretch strips_of(const Input& input) {
  const double stretch = input.stretch();
  const double asked = input.lining->rib_spacing.value_or(std::min(1.0, stretch));
  const int count = std::max(1, static_cast<int>(std::floor(stretch / asked + 1e-9)));
  return {count, stretch / count};
}

LiningRing ring_of(const LiningInput& lining, std::optional<int> nodes) {
  LiningRing ring{.nodes = nodes, .fill_depth = lining.fill_depth};
  if (lining.arc) {
    ring.from = lining.arc->from;
    ring.to = lining.arc->to;
  }
  return ring;
}

std::optional<FootBearing> feet_of(const LiningInput& lining) {
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

PrismaticOpening driven_opening(const Input& input, const SimplePolygon& section) {
  const double end = input.round_count() * input.stretch();
  return PrismaticOpening(section, -PrismaticOpening::endless,
                          end < input.model.length * (1 - 1e-9) ? end : PrismaticOpening::endless);
}

Construction<Tunnel> construction_of(const Input& input, const Tunnel& tunnel, bool is_excavated,
                                     const SimplePolygon& opening, const SupportChoice& supports,
                                     const LinearSettings& linear, RangeSought range) {
  Construction<Tunnel> construction;
  construction.method = method_of(input, linear, range);
  construction.acceptance = acceptance_of(input, opening);
  for (const StageInput& stage : input.stages) {
    auto& made = construction.add_stage(stage.name, stage.wall_traction);
    if (stage.part && !is_excavated)
      made.excavate(*outline_of_part(opening, *stage.part), input.blocks.min_wall_area);
    if (stage.install_bolts && supports.spacing)
      made.install_bolts({bolt_bars(pattern_of(*input.bolts, *supports.spacing), opening),
                          bolt_of(*input.bolts), input.bolts->out_of_plane,
                          anchors_of(*input.bolts)});
    if (stage.install_lining && supports.thickness > 0) {
      const int nodes = lining_nodes(input, tunnel.mass(), opening, supports.thickness);
      LiningInstallation<Tunnel> lining{ring_of(*input.lining, nodes),
                                        {section_of(*input.lining, supports.thickness)},
                                        interface_of(*input.lining)};
      if (!is_excavated) lining.opening = opening;
      lining.feet = feet_of(*input.lining);
      made.install_lining(std::move(lining));
    }
  }
  return construction;
}

namespace {

/// What one entry of the file does in one stretch of the tunnel.
class StretchWork {
 public:
  StretchWork(const Input& input, const SimplePolygon& section, const SupportChoice& supports)
      : input_(input), whole_(driven_opening(input, section)), supports_(supports) {
    if (input.bolts && supports.spacing)
      bars_ = bolt_bars(pattern_of(*input.bolts, *supports.spacing), whole_,
                        input.bolts->out_of_plane, 0, input.round_count() * input.stretch());
  }

  /// @param k  number of the stretch, from 0
  void add(const StageInput& entry, int k, ConstructionStage<SpatialTunnel>& stage) const {
    const int last = input_.round_count() - 1;
    const double from = k * input_.stretch(), to = (k + 1) * input_.stretch();
    if (entry.part)
      stage.excavate(PrismaticOpening(*outline_of_part(whole_.section(), *entry.part),
                                      k == 0 ? whole_.from() : from, k == last ? whole_.to() : to),
                     input_.blocks.min_wall_area * std::sqrt(input_.blocks.min_wall_area));
    if (entry.install_bolts && supports_.spacing) {
      BoltInstallation<SpatialTunnel> bolts{
          {}, bolt_of(*input_.bolts), 1, anchors_of(*input_.bolts)};
      for (const SpatialLine& bar : bars_) {
        const double y = whole_.along(bar.start);
        if (y >= from && y < to) bolts.bars.push_back(bar);
      }
      if (!bolts.bars.empty()) stage.install_bolts(std::move(bolts));
    }
    if (entry.install_lining && supports_.thickness > 0) stage.install_lining(lining(from, to));
  }

 private:
  [[nodiscard]] LiningInstallation<SpatialTunnel> lining(double from, double to) const {
    const LiningInput& lining = *input_.lining;
    const double width = strips_of(input_).width;
    LiningInstallation<SpatialTunnel> made{
        {.ring = ring_of(lining, rib_nodes(input_)), .spacing = width, .from = from, .to = to},
        {strip_of(lining, supports_.thickness, width)},
        interface_of(lining)};
    const SimplePolygon& section = whole_.section();
    const int nodes = made.layout.ring.nodes.value_or(
        with_chosen_nodes<3>(made.layout.ring, section, made.sections.front(), made.interface_law,
                             width)
            .nodes.value_or(72));
    made.sections.push_back(strip_of(lining, supports_.thickness, section.perimeter() / nodes));
    made.opening = whole_;
    made.feet = feet_of(lining);
    return made;
  }

  const Input& input_;
  PrismaticOpening whole_;
  SupportChoice supports_;
  std::vector<SpatialLine> bars_;
};

}  // namespace

Construction<SpatialTunnel> construction_of(const Input& input, const SimplePolygon& section,
                                            const SupportChoice& supports,
                                            const LinearSettings& linear, RangeSought range) {
  Construction<SpatialTunnel> construction;
  // Every round in which rock comes off would be followed five times, half a minute each.
  construction.method =
      method_of(input, linear, input.tunnel.round_length ? RangeSought::none : range);
  construction.acceptance = acceptance_of(input, section);
  const StretchWork work(input, section, supports);
  if (!input.tunnel.round_length) {
    for (const StageInput& entry : input.stages)
      work.add(entry, 0, construction.add_stage(entry.name, entry.wall_traction));
    return construction;
  }
  int farthest = 0;
  for (const StageInput& entry : input.stages) farthest = std::max(farthest, entry.behind);
  const int rounds = input.round_count();
  for (int face = 0; face < rounds + farthest; ++face) {
    auto& stage = construction.add_stage(face < rounds ? "round " + std::to_string(face + 1)
                                                       : "behind the face " +
                                                             std::to_string(face - rounds + 1));
    for (const StageInput& entry : input.stages)
      if (const int k = face - entry.behind; k >= 0 && k < rounds) work.add(entry, k, stage);
  }
  return construction;
}

}  // namespace voussoir::program
