// SPDX-License-Identifier: MIT
#include "analysis.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <mutex>
#include <numbers>
#include <thread>
#include <voussoir/core/memory.hpp>
#include <voussoir/core/parallel.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/io/operating_system.hpp>
#include <voussoir/rockmass/carving_limits.hpp>
#include <voussoir/rockmass/trace_coverage.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "mapped_rock.hpp"
#include "plausibility.hpp"

namespace voussoir::program {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string number(double value, const char* format = "%.3g") {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

Acceptance acceptance_of(const Input& input, const SimplePolygon& opening) {
  Acceptance acceptance;
  acceptance.error_estimate = input.run.tolerance;
  acceptance.displacement_limit = input.run.displacement_limit;
  acceptance.contact_update_limit = input.run.contact_update_limit;
  acceptance.collapse_measure = collapse_measure_of(opening);
  return acceptance;
}

/// The law of the joints, and of those sets that differ.
LawsBySet<CoulombJoint> laws_of(const Input& input) {
  LawsBySet<CoulombJoint> laws(CoulombJoint(mechanics_of(input, -1)));
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k) {
    const JointSetInput& set = input.joint_sets[k];
    if (!set.normal_stiffness && !set.shear_stiffness && !set.friction_angle) continue;
    const int index = static_cast<int>(k);
    laws.add(index, CoulombJoint(mechanics_of(input, index)));
  }
  return laws;
}

std::vector<Segment> bars_of(const BoltsInput& bolts, const BoltSpacing& spacing,
                             const SimplePolygon& opening) {
  return bolt_bars({.length = bolts.length,
                    .angular_spacing = spacing.is_angle ? spacing.value : 0.0,
                    .wall_spacing = spacing.is_angle ? 0.0 : spacing.value,
                    .from = bolts.arc.from,
                    .to = bolts.arc.to},
                   opening);
}

Domain<2> domain_of(const Input& input) {
  Domain<2> domain = domain_around(opening_of(input), input.model.width, input.tunnel.cover,
                                   input.model.below_invert);
  domain.site_origin = Vec2(input.model.origin[0], input.model.origin[1]);
  return domain;
}

BoltInstallation<Tunnel> bolts_of(const BoltsInput& bolts, const BoltSpacing& spacing,
                                  const SimplePolygon& opening) {
  return {bars_of(bolts, spacing, opening), bolt_of(bolts), bolts.out_of_plane, anchors_of(bolts)};
}

/// On the full ring: as many as facets, or as many as it takes to be no farther apart than joints,
/// for a block that falls between two nodes loads none, or than a bond needs.
/// @param thickness  of the lining [m], > 0
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

LiningInstallation<Tunnel> lining_of(const LiningInput& lining, int nodes, double thickness) {
  LiningRing ring{.nodes = nodes, .fill_depth = lining.fill_depth};
  if (lining.arc) {
    ring.from = lining.arc->from;
    ring.to = lining.arc->to;
  }
  LiningInstallation<Tunnel> made{ring, {section_of(lining, thickness)}, interface_of(lining)};
  if (const auto& feet = lining.feet) {
    // Under a rib the beam settles and presses by so much more than all along.
    const double peak = feet->on_beam().settlement;
    made.feet.emplace(FootBearing::Params{
        .width = feet->width,
        .stiffness = feet->stiffness / peak,
        .strength = feet->strength.value_or(std::numeric_limits<double>::infinity()) / peak,
        .friction_angle = feet->friction_angle});
  }
  return made;
}

/// The stages of the input. `spacing` none: no bolts; `thickness` 0: no lining.
Construction<Tunnel> construction_of(const Input& input, const Tunnel& tunnel,
                                     const SimplePolygon& opening,
                                     const std::optional<BoltSpacing>& spacing, double thickness,
                                     const LinearSettings& linear, RangeSought range) {
  Construction<Tunnel> construction;
  construction.method = method_of(input, linear, range);
  construction.acceptance = acceptance_of(input, opening);
  for (const StageInput& stage : input.stages) {
    auto& made = construction.add_stage(stage.name, stage.wall_traction);
    if (stage.install_bolts && spacing)
      made.install_bolts(bolts_of(*input.bolts, *spacing, opening));
    if (stage.install_lining && thickness > 0)
      made.install_lining(lining_of(
          *input.lining, lining_nodes(input, tunnel.mass(), opening, thickness), thickness));
  }
  return construction;
}

/// What became of the joints: how often one went into a block, and why a cut was not made.
std::string slicing_text(const SlicingReport& slicing, const Input& input) {
  std::string text = counted(slicing.joints, "joint") + ", of which " +
                     std::to_string(slicing.joints - slicing.outside_joints) +
                     " reach into the domain: " + counted(slicing.cuts, "cut") + " made, " +
                     std::to_string(slicing.refused_too_small) +
                     " refused for a part smaller than blocks.min_inscribed_radius = " +
                     format_quantity(input.blocks.min_inscribed_radius, dimension::length) + ", " +
                     std::to_string(slicing.refused_too_long) + " for a part longer than " +
                     "blocks.max_elongation = " + number(input.blocks.max_elongation);
  if (slicing.coincident > 0)
    text += ", " + std::to_string(slicing.coincident) + " merged with an existing joint";
  return text;
}

/// No result without its rock: joints asked for and not used are said.
void check_slicing(const Input& input, const SlicingReport& slicing,
                   std::vector<std::string>& warnings) {
  const bool asked = !input.joint_sets.empty() || !input.joints_file.empty();
  if (!asked) return;
  const std::string text = slicing_text(slicing, input);
  if (slicing.joints == slicing.outside_joints) {
    warnings.push_back("the rock is one block without joints, though there are joint sets: " +
                       text);
  } else if (slicing.cuts == 0 && input.joints_file.empty()) {
    // Traces may all end in whole rock: what of them cuts nothing is said with its metres.
    throw InvalidInput("no joint cuts the rock, which stays one block: " + text +
                       "\n   = accepted: limits in [blocks] that let joints cut");
  } else if (2 * slicing.refused_too_long > slicing.offered_cuts() ||
             50 * slicing.cuts < slicing.offered_cuts()) {
    // Far more cuts than blocks are refused for size in any dense network: that is its saturation.
    warnings.push_back("most joints leave no trace in the rock: " + text);
  }
  if (slicing.blocks_too_long > 0)
    warnings.push_back(
        counted(slicing.blocks_too_long, "block") + " longer than blocks.max_elongation = " +
        number(input.blocks.max_elongation) + ", as the domain is: no joint cut them shorter");
}

/// What became of the random joints of every set, after `mapped` others.
/// @throws InvalidInput  none of one set is used
void add_random_sources(const Input& input, std::size_t mapped, GeneratedRock& rock) {
  std::vector<JointSource> sources;
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k) {
    sources.push_back({input.joint_sets[k].name});
    sources.back().law = mechanics_of(input, static_cast<int>(k));
  }
  for (std::size_t k = mapped; k < rock.mass.joints.size(); ++k) {
    JointSource& source = sources[static_cast<std::size_t>(rock.mass.joints[k].set)];
    const JointFate fate = rock.mass.slicing.fates[k];
    ++source.asked;
    source.used += fate == JointFate::used;
    source.outside += fate == JointFate::outside;
    source.refused += fate == JointFate::refused;
  }
  for (const JointSource& source : sources)
    if (source.asked > 0 && source.used == 0 && source.refused > 0)
      throw InvalidInput(source.name + ": none of its " + counted(source.asked, "joint") +
                         " cuts the rock: " + std::to_string(source.outside) +
                         " outside the domain, " + std::to_string(source.refused) +
                         " refused for parts too small or too long, or where a joint was already" +
                         "\n   = accepted: limits in [blocks] that let them cut, or a source of "
                         "joints that are not there yet");
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const bool is_mapped =
        std::any_of(rock.joints.begin(), rock.joints.end(), [&](const JointSource& source) {
          return source.mapped && source.mapped->set == static_cast<int>(k);
        });
    if (input.joint_sets[k].is_random())
      rock.joints.push_back(std::move(sources[k]));
    else if (!is_mapped)
      rock.warnings.push_back("joint_set[" + std::to_string(k) + "] " + sources[k].name +
                              " has no joint: no trace of joints.file names it, and it has neither "
                              "intensity nor spacing");
  }
}

std::vector<std::string> warnings_of(const Input& input, const RunResult& run) {
  std::vector<std::string> warnings = run.warnings;
  for (std::string& text : unusual_values(input)) warnings.push_back(std::move(text));
  const auto warn = [&](std::string text) { warnings.push_back(std::move(text)); };
  const RockMass<Planar>& mass = run.tunnel.mass();
  if (mass.slicing.coincident > 0)
    warn(std::to_string(mass.slicing.coincident) +
         " times a joint only touched a block or ran along an existing joint: merged, no cut made");
  if (mass.carving.dropped_pieces > 0)
    warn(std::to_string(mass.carving.dropped_pieces) + " pieces at the wall below " +
         number(input.blocks.min_wall_area) +
         " m2, or thinner between it and a joint along it than " +
         number(skin_thickness(2, input.blocks.min_wall_area)) + " m, were dropped, " +
         number(mass.carving.dropped_measure) + " m2 in all; the wall is the rock behind them" +
         (input.lining ? ", a lining fills the holes to " + number(input.lining->fill_depth) + " m"
                       : std::string()));
  const double needed = run.tunnel.in_situ().required_friction_angle();
  double friction = input.joint.friction_angle;
  for (const JointSetInput& set : input.joint_sets)
    friction = std::min(friction, set.friction_angle.value_or(friction));
  if (needed > friction)
    warn("in situ: with K0 = " + number(input.stress.K0) + " some joint orientations need " +
         number(needed * 180 / std::numbers::pi) +
         " deg of friction; joints that cannot carry the " +
         "in-situ shear slip at the first equilibrium");
  const SupportCondition supports = support_condition(run.tunnel);
  for (std::string& text : remarks_on(supports)) warn(std::move(text));
  if (!supports.open_linings.empty())
    warn("feet of a lining: [support.lining.feet]; its bond: support.lining.interface.shear_bond");
  if (input.lining && run.tunnel.first_lining_node() >= 0) {
    const LiningInput& lining = *input.lining;
    const double node_spacing =
        run.opening.perimeter() / lining_nodes(input, mass, run.opening, lining.thickness);
    const double joint_spacing = radial_spacing(mass, Vec2::Zero(), input.tunnel.half_width(),
                                                2 * input.tunnel.half_width());
    if (node_spacing > joint_spacing)
      warn("lining nodes are " + number(node_spacing) + " m apart, joints " +
           number(joint_spacing) + " m: take more nodes");
    // What a block weighs on one rigid stretch bends nothing (docs/decisions.md).
    const double length = bending_length(section_of(lining, lining.thickness).bending_stiffness,
                                         lining.interface_normal_stiffness);
    if (node_spacing > coarsest_moment_spacing * length)
      warn("lining nodes are " + number(node_spacing) + " m apart, farther than " +
           number(coarsest_moment_spacing) + " L = " + number(coarsest_moment_spacing * length) +
           " m, L = (4 E I / kn)^(1/4): moments under a block may come out too small; "
           "take " +
           number(node_count_for(run.opening.perimeter(), length, coarsest_moment_spacing)) +
           " nodes or more");
  }
  return warnings;
}

}  // namespace

SimplePolygon opening_of(const Input& input) {
  const TunnelInput& t = input.tunnel;
  switch (t.shape) {
    case TunnelShape::circle:
      return circular_opening(t.diameter, t.facets);
    case TunnelShape::horseshoe:
      return horseshoe_opening(t.width, t.wall_height, t.facets);
    case TunnelShape::polygon: {
      std::vector<Vec2> vertices;
      for (const Point& p : t.vertices) vertices.emplace_back(p[0], p[1]);
      return SimplePolygon(std::move(vertices));
    }
  }
  throw std::logic_error("unknown tunnel shape");
}

GeneratedRock rock_of(const Input& input, const Progress& progress) {
  const Domain<2> domain = domain_of(input);
  std::vector<JointSet> sets;
  std::vector<int> index;  // of a random set among those of the input
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k) {
    const JointSetInput& s = input.joint_sets[k];
    if (!s.is_random()) continue;
    sets.push_back({s.name, s.dip,
                    s.dip_direction == DipDirection::east ? voussoir::DipDirection::east
                                                          : voussoir::DipDirection::west,
                    s.sd, s.intensity.value_or(0.0), s.spacing.value_or(0.0), s.extent});
    index.push_back(static_cast<int>(k));
  }
  GeneratedRock rock;
  const BlockLimits limits{input.blocks.min_inscribed_radius, input.blocks.max_elongation};
  // Mapped joints come first: what was seen takes precedence over what was drawn at random.
  std::vector<MappedTrace> traces;
  if (!input.joints_file.empty()) traces = read_mapped_traces(input, domain, progress, rock);
  auto random = joint_network(sets, domain, input.model.seed, progress);
  for (Joint& joint : random) joint.set = index[static_cast<std::size_t>(joint.set)];
  if (input.joints_file.empty()) {
    rock.mass = slice(domain, random, limits, progress);
  } else {
    // What the sets alone come to was checked when the input was read.
    std::vector<Joint> all = straight_pieces(traces);
    all.insert(all.end(), random.begin(), random.end());
    const double blocks = estimated_blocks(all, domain, limits.min_inscribed_radius);
    if (blocks > largest_count || static_cast<double>(all.size()) > largest_count)
      throw InvalidInput(
          "joints.file: with " + utf8_text(input.joints_file) + " the rock has " +
          counted(all.size(), "joint") + " and would come to about " + number(blocks, "%.0f") +
          " blocks\n   = accepted: at most 1000000 of either in the domain: a smaller "
          "domain, fewer joints, or a larger blocks.min_inscribed_radius");
    slice_by_traces(input, domain, std::move(traces), random, progress, rock);
  }
  check_slicing(input, rock.mass.slicing, rock.warnings);
  add_random_sources(input, rock.mass.joints.size() - random.size(), rock);
  return rock;
}

ExcavatedRock excavated_rock(const Input& input, bool wants_bias, const Report& report) {
  const Progress progress = [&](double fraction) { return report("blocks", fraction); };
  const SimplePolygon opening = opening_of(input);
  const GeneratedRock rock = rock_of(input, progress);
  const LawsBySet<CoulombJoint> laws = laws_of(input);
  double unbalance = 0;
  const auto tunnel_of = [&](const FarField<2>& far_field) {
    Tunnel tunnel(rock.mass, laws,
                  {.density = input.rock.density,
                   .k0 = input.stress.K0,
                   .surcharge = input.stress.surcharge,
                   .gravity = input.model.gravity},
                  progress, far_field);
    unbalance = tunnel.out_of_balance_ratio();
    tunnel.excavate(opening, input.blocks.min_wall_area, progress);
    return tunnel;
  };
  BoundedTunnel bounded = bounded_tunnel(input, rock.mass, laws, tunnel_of, wants_bias, progress);
  std::vector<std::string> warnings = rock.warnings;
  const double half_width = input.tunnel.half_width();
  for (std::string& text : remarks_on(in_situ_closure(
           input, bounded.tunnel.in_situ().vertical(rock.mass.domain.depth(Vec2::Zero())),
           std::sqrt(block_sizes(rock.mass).mean),
           radial_spacing(rock.mass, Vec2::Zero(), half_width, 2 * half_width))))
    warnings.push_back(std::move(text));
  return {
      std::move(bounded.tunnel), rock.joints,     opening, std::move(bounded.boundary), unbalance,
      std::move(warnings),       rock.joints_read};
}

void check_bolts(const Input& input, const std::vector<std::optional<BoltSpacing>>& spacings) {
  if (!input.bolts) return;
  const Domain<2> domain = domain_of(input);
  const SimplePolygon opening = opening_of(input);
  for (const auto& spacing : spacings) {
    if (!spacing) continue;
    for (const Segment& bar : bars_of(*input.bolts, *spacing, opening))
      if ((bar.end.array() < domain.low.array()).any() ||
          (bar.end.array() > domain.high.array()).any())
        throw InvalidInput("support.bolts.length = " + number(input.bolts->length) +
                           " m: a bolt would end at " + text_of<2>(bar.end) +
                           " m, outside the rock" +
                           unusual_among(input, {"model.", "tunnel.", "support.bolts."}) +
                           "\n   = accepted: bolts that end within " + text_of<2>(domain.low) +
                           " and " + text_of<2>(domain.high) + " m");
  }
}

double bolt_strength(const BoltsInput& bolts) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return std::min(bolts.yield_force.value_or(unlimited), bolts.rupture_force.value_or(unlimited));
}

std::vector<std::string> unchecked_supports(const Input& input) {
  std::vector<std::string> unchecked;
  if (input.bolts && std::isinf(bolt_strength(*input.bolts))) unchecked.emplace_back("bolts");
  if (input.lining) unchecked.emplace_back("lining");
  if (input.lining && input.lining->feet && !input.lining->feet->strength)
    unchecked.emplace_back("feet of the lining");
  return unchecked;
}

std::string TunnelResult::word() const {
  if (failed) return "failed";
  std::string text = to_string(verdict, fallen, lost_lining);
  if (verdict != Verdict::stable) return text;
  if (bolts_yielded > 0) text += ", bolts yielded";
  if (bolts_ruptured > 0) text += ", bolts ruptured";
  if (feet_yielded > 0) text += ", feet at their strength";
  return text;
}

SupportChoice supports_of(const Input& input) {
  return {input.bolts ? std::optional(input.bolts->spacing) : std::nullopt,
          input.lining ? input.lining->thickness : 0.0};
}

namespace {

/// Adds to a numerical fault which keys of the input are likely to blame.
template <class Compute>
auto naming_unusual_values(const Input& input, Compute&& compute) {
  try {
    return compute();
  } catch (const NumericalFault& fault) {
    std::string text = fault.what();
    for (const std::string& value : unusual_values(input)) text += "\n   = " + value;
    throw NumericalFault(text);
  }
}

RunResult computed_run(const Input& input, const Report& report) {
  const auto start = std::chrono::steady_clock::now();
  if (input.bolts) check_bolts(input, {input.bolts->spacing});
  report("blocks", -1.0);
  ExcavatedRock excavated = excavated_rock(input, true, report);
  RunResult run{std::move(excavated.tunnel), excavated.opening, excavated.boundary};
  run.warnings = run.rock_warnings = std::move(excavated.warnings);
  run.joints = std::move(excavated.joints);
  run.joints_read = std::move(excavated.joints_read);
  run.in_situ_unbalance = excavated.in_situ_unbalance;
  run.generation_seconds = seconds_since(start);
  const auto search = std::chrono::steady_clock::now();
  const SupportChoice supports = supports_of(input);
  // Two threads make and apply a factor 1.6 times as fast as one (bench/elastic_bench).
  const LinearSettings linear{.threads = std::clamp(std::thread::hardware_concurrency(), 1U, 2U)};
  run.built = construct(run.tunnel,
                        construction_of(input, run.tunnel, run.opening, supports.spacing,
                                        supports.thickness, linear, RangeSought::all),
                        report);
  if (run.last().stopped) throw Stopped();  // nobody reads what could be told
  run.equilibrium_seconds = seconds_since(search);
  if (input.lining && !input.lining->nodes && input.lining->tensile_bond > 0)
    run.bonded_nodes = lining_nodes(input, run.tunnel.mass(), run.opening, input.lining->thickness);
  run.warnings = warnings_of(input, run);
  return run;
}

}  // namespace

RunResult run_tunnel(const Input& input, const Report& report) {
  return naming_unusual_values(input, [&] { return computed_run(input, report); });
}

namespace {
/// What the direct solution may take of one tunnel among many: the same on every machine, lest its
/// memory decide how equations are solved [bytes].
constexpr double memory_of_a_case = 4e9;
}  // namespace

TunnelResult supported_tunnel(const Input& input, const ExcavatedRock& rock,
                              const SupportChoice& supports, const Report& report) {
  TunnelResult result;
  result.blocks = rock.tunnel.mass().bodies.size();
  result.boundary = boundary_text(rock.boundary);
  result.warnings = rock.warnings;
  for (std::string& text : unusual_values(input)) result.warnings.push_back(std::move(text));
  try {
    Tunnel tunnel = rock.tunnel;
    const auto built = naming_unusual_values(input, [&] {
      return construct(
          tunnel,
          construction_of(input, tunnel, rock.opening, supports.spacing, supports.thickness,
                          {.memory_limit = memory_of_a_case}, RangeSought::until_marginal),
          report);
    });
    if (built.last().stopped) throw Stopped();
    result.verdict = built.verdict();
    result.lost_lining = built.has_lost_lining();
    result.fallen = built.fallen_measure();
    if (const auto range = built.rockfall_range()) result.marginal = range->is_marginal();
    result.reason = built.last().reason;
    result.convergence = built.stages.back().convergence;
    result.demand = support_demand(tunnel);
    const SupportCondition condition = support_condition(tunnel);
    result.bolts_yielded = condition.yielded;
    result.bolts_ruptured = condition.ruptured;
    result.feet_yielded = static_cast<int>(condition.yielded_feet.size());
    if (input.bolts && std::isfinite(bolt_strength(*input.bolts)))
      result.of_bolt_strength = result.demand.largest_bolt_force / bolt_strength(*input.bolts);
    result.error_estimate = built.last().error_estimate;
    result.out_of_balance = built.last().unbalance_over_weight;
  } catch (const NumericalFault& fault) {
    result.failed = true;
    result.reason = fault.what();
  }
  return result;
}

}  // namespace voussoir::program
