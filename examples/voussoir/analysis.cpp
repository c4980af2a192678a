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
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/memory.hpp>
#include <voussoir/core/parallel.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/io/operating_system.hpp>
#include <voussoir/rockmass/carving_limits.hpp>
#include <voussoir/rockmass/trace_coverage.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "joint_laws.hpp"
#include "joint_sets.hpp"
#include "mapped_rock.hpp"
#include "openings.hpp"
#include "plausibility.hpp"
#include "spatial_analysis.hpp"
#include "survey.hpp"

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

std::vector<std::string> warnings_of(const Input& input, const RunResult& run) {
  std::vector<std::string> warnings = run.warnings;
  for (std::string& text : unusual_values(input)) warnings.push_back(std::move(text));
  if (!input.unused.empty()) warnings.push_back(input.unused_text());
  if (input.survey && !input.survey->left_out.empty())
    warnings.push_back(left_out_text(*input.survey));
  const auto warn = [&](std::string text) { warnings.push_back(std::move(text)); };
  const RockMass<Planar>& mass = run.tunnel.mass();
  const std::vector<const LiningInput*> linings = input.linings();
  double least_filled = std::numeric_limits<double>::infinity();
  for (const LiningInput* lining : linings)
    least_filled = std::min(least_filled, lining->fill_depth);
  if (mass.slicing.coincident > 0)
    warn(std::to_string(mass.slicing.coincident) +
         " times a joint only touched a block or ran along an existing joint: merged, no cut made");
  if (mass.carving.dropped_pieces > 0)
    warn(std::to_string(mass.carving.dropped_pieces) + " pieces at the wall below " +
         number(input.blocks.min_wall_area) +
         " m2, or thinner between it and a joint along it than " +
         number(skin_thickness(2, input.blocks.min_wall_area)) + " m, were dropped, " +
         number(mass.carving.dropped_measure) + " m2 in all; the wall is the rock behind them" +
         (linings.empty() ? std::string()
                          : ", a lining fills the holes to " + number(least_filled) + " m"));
  const double needed = run.tunnel.in_situ().required_friction_angle(input.domain_top());
  if (needed >
      (1 + 1e-12) * least_friction_angle(input, run.tunnel.in_situ().vertical(input.domain_top())))
    warn("in situ: some joint orientations need " + number(needed * 180 / std::numbers::pi) +
         " deg of friction; joints that cannot carry the " +
         "in-situ shear slip at the first equilibrium");
  const SupportCondition supports = support_condition(run.tunnel);
  for (std::string& text : remarks_on(supports)) warn(std::move(text));
  if (!supports.open_linings.empty())
    warn("feet of a lining: [support.lining.feet]; its bond: support.lining.interface.shear_bond");
  for (const LiningInput* const made : linings) {
    if (run.tunnel.first_lining_node() < 0) break;
    const LiningInput& lining = *made;
    if (!is_modelled(input, lining.opening)) continue;
    const SimplePolygon outline = outline_of(outline_input(input, lining.opening));
    const double node_spacing =
        outline.perimeter() / lining_nodes(input, lining, mass, lining.thickness);
    const double joint_spacing = radial_spacing(mass, Vec2::Zero(), input.tunnel.half_width(),
                                                2 * input.tunnel.half_width());
    if (node_spacing > joint_spacing)
      warn("lining nodes are " + number(node_spacing) + " m apart, joints " +
           number(joint_spacing) + " m: take more nodes");
    if (lining.beam == LiningElement::pinned) continue;  // nothing bends
    // What a block weighs on one rigid stretch bends nothing (docs/decisions.md).
    const double length = bending_length(section_of(lining, lining.thickness).bending_stiffness,
                                         lining.interface_normal_stiffness);
    if (node_spacing > coarsest_moment_spacing * length)
      warn("lining nodes are " + number(node_spacing) + " m apart, farther than " +
           number(coarsest_moment_spacing) + " L = " + number(coarsest_moment_spacing * length) +
           " m, L = (4 E I / kn)^(1/4): moments under a block may come out too small; "
           "take " +
           number(node_count_for(outline.perimeter(), length, coarsest_moment_spacing)) +
           " nodes or more");
  }
  return warnings;
}

}  // namespace

SimplePolygon outline_of(const OutlineInput& outline) {
  switch (outline.shape) {
    case TunnelShape::circle:
      return circular_opening(outline.diameter, outline.facets);
    case TunnelShape::horseshoe:
      return horseshoe_opening(outline.width, outline.wall_height, outline.facets);
    case TunnelShape::polygon: {
      std::vector<Vec2> vertices;
      for (const Point& p : outline.vertices) vertices.emplace_back(p[0], p[1]);
      return SimplePolygon(std::move(vertices));
    }
  }
  throw std::logic_error("unknown tunnel shape");
}

GeneratedRock rock_of(const Input& input, const Progress& progress) {
  const Domain<2> domain = section_domain(input);
  std::vector<JointSet> sets;
  std::vector<int> index;  // of a random set among those of the input
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k) {
    const JointSetInput& s = input.joint_sets[k];
    if (!s.is_random()) continue;
    const auto shown = section_set(s, input.tunnel);
    if (!shown) continue;  // it runs along the section, and the run says so
    sets.push_back(*shown);
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
  std::vector<int> set_of;
  for (const Joint& joint : rock.mass.joints) set_of.push_back(joint.set);
  add_random_sources(input, set_of.size() - random.size(), set_of, rock.mass.slicing, rock.joints,
                     rock.warnings);
  if (const double acts = elementary::cosine(input.tunnel.plunge); acts < 0.99)
    rock.warnings.push_back("the tunnel plunges: a section takes gravity whole, of which " +
                            number(100 * acts) +
                            " % act in its plane; model.dimension = 3 has it as it is");
  for (const JointSetInput& set : input.joint_sets)
    if (std::string text = section_text(set, input.tunnel); !text.empty())
      (section_set(set, input.tunnel) ? rock.in_section : rock.warnings).push_back(std::move(text));
  return rock;
}

ExcavatedRock excavated_rock(const Input& input, bool wants_bias, const Report& report) {
  if (input.is_spatial()) return spatial_rock_in_situ(input, report);
  const Progress progress = [&](double fraction) { return report("blocks", fraction); };
  const SimplePolygon opening = opening_of(input);
  const GeneratedRock rock = rock_of(input, progress);
  const LawsBySet<AnyJoint> laws = laws_of(input);
  double unbalance = 0;
  const auto in_situ_tunnel = [&](const FarField<2>& far_field) {
    return Tunnel(rock.mass, laws, in_situ_of(input), progress, far_field);
  };
  const auto tunnel_of = [&](const FarField<2>& far_field) {
    Tunnel tunnel = in_situ_tunnel(far_field);
    unbalance = tunnel.out_of_balance_ratio();
    tunnel.excavate(opening, input.blocks.min_wall_area, progress);
    return tunnel;
  };
  BoundedTunnel bounded = bounded_tunnel(input, rock.mass, laws, tunnel_of, wants_bias, progress);
  if (input.has_rounds)  // each takes out its part; what the boundary does was asked of the whole
    bounded.tunnel = in_situ_tunnel(bounded.boundary.field);
  std::vector<std::string> warnings = rock.warnings;
  const double half_width = input.tunnel.half_width();
  for (std::string& text : remarks_on(in_situ_closure(
           input, bounded.tunnel.in_situ().vertical(rock.mass.domain.depth(Vec2::Zero())),
           std::sqrt(block_sizes(rock.mass).mean),
           radial_spacing(rock.mass, Vec2::Zero(), half_width, 2 * half_width))))
    warnings.push_back(std::move(text));
  return {std::move(bounded.tunnel),
          rock.joints,
          opening,
          std::move(bounded.boundary),
          unbalance,
          std::move(warnings),
          rock.joints_read,
          rock.in_section};
}

namespace {

template <int Dim, class Bars>
void check_ends(const Input& input, std::size_t pattern, const Bars& bars,
                const Domain<Dim>& domain) {
  const BoltsInput& bolts = *input.bolt_patterns()[pattern];
  for (const auto& bar : bars)
    for (const Vec<Dim>& end : {bar.start, bar.end})
      if ((end.array() < domain.low.array()).any() || (end.array() > domain.high.array()).any())
        throw InvalidInput(
            input.bolts_key(pattern) +
            (bolts.bars.empty() ? ".length = " + number(bolts.length) + " m" : ".bars") +
            ": a bolt would end at " + text_of<Dim>(end) + " m, outside the rock" +
            unusual_among(input, {"model.", "tunnel.", "support.bolts."}) +
            "\n   = accepted: bolts that end within " + text_of<Dim>(domain.low) + " and " +
            text_of<Dim>(domain.high) + " m");
}

}  // namespace

void check_bolts(const Input& input, const std::vector<std::optional<BoltSpacing>>& spacings) {
  const std::vector<const BoltsInput*> patterns = input.bolt_patterns();
  const auto check = [&](std::size_t k, const BoltSpacing& spacing) {
    const BoltsInput& bolts = *patterns[k];
    if (!is_modelled(input, bolts)) return;
    // Along a level tunnel the rows lie inside; the section says the rest.
    if (!input.is_spatial() || (bolts.opening == 0 && !bolts.ahead && input.tunnel.plunge == 0))
      check_ends<2>(input, k, bars_of_pattern(input, bolts, spacing), section_domain(input));
    else
      check_ends<3>(input, k, rows_of_pattern(input, bolts, spacing), spatial_domain(input));
  };
  for (const auto& spacing : spacings)
    if (spacing && input.bolts) check(0, *spacing);
  for (std::size_t k = 1; k < patterns.size(); ++k) check(k, patterns[k]->spacing);
}

double bolt_strength(const BoltsInput& bolts) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return std::min(bolts.yield_force.value_or(unlimited), bolts.rupture_force.value_or(unlimited));
}

std::vector<std::string> unchecked_supports(const Input& input) {
  std::vector<std::string> unchecked;
  const std::vector<const BoltsInput*> patterns = input.bolt_patterns();
  if (std::any_of(patterns.begin(), patterns.end(),
                  [](const BoltsInput* pattern) { return std::isinf(bolt_strength(*pattern)); }))
    unchecked.emplace_back("bolts");
  if (input.lining) unchecked.emplace_back("lining");
  for (const LiningInput* lining : input.linings())
    if (lining->feet && !lining->feet->strength) {
      unchecked.emplace_back("feet of the lining");
      break;
    }
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

RunResult computed_run(const Input& input, const Report& report) {
  const auto start = std::chrono::steady_clock::now();
  if (input.bolts) check_bolts(input, {input.bolts->spacing});
  report("blocks", -1.0);
  ExcavatedRock excavated = excavated_rock(input, true, report);
  RunResult run{std::get<Tunnel>(std::move(excavated.tunnel)), excavated.opening,
                excavated.boundary};
  run.warnings = run.rock_warnings = std::move(excavated.warnings);
  run.joints = std::move(excavated.joints);
  run.joints_read = std::move(excavated.joints_read);
  run.in_section = std::move(excavated.in_section);
  run.in_situ_unbalance = excavated.in_situ_unbalance;
  run.generation_seconds = seconds_since(start);
  const auto search = std::chrono::steady_clock::now();
  const SupportChoice supports = supports_of(input);
  // Two threads make and apply a factor 1.6 times as fast as one (bench/elastic_bench).
  const LinearSettings linear{.threads = std::clamp(std::thread::hardware_concurrency(), 1U, 2U)};
  run.built = construct(
      run.tunnel,
      construction_of(input, run.tunnel, !input.has_rounds, supports, linear, RangeSought::all),
      report);
  if (run.last().stopped) throw Stopped();  // nobody reads what could be told
  run.equilibrium_seconds = seconds_since(search);
  for (const LiningInput* lining : input.linings())
    if (!lining->nodes && lining->bends_on_bond())
      run.bonded_nodes = std::max(
          run.bonded_nodes, lining_nodes(input, *lining, run.tunnel.mass(), lining->thickness));
  run.warnings = warnings_of(input, run);
  return run;
}

}  // namespace

std::vector<OpeningConvergence> other_convergences(const Input& input, const Tunnel& tunnel) {
  std::vector<OpeningConvergence> found;
  for (std::size_t k = 1; k <= input.openings.size(); ++k)
    if (is_modelled(input, k))
      found.push_back({opening_name(input, k), convergence(tunnel, opening_in_section(input, k))});
  return found;
}

std::vector<OpeningConvergence> other_convergences(const Input& input,
                                                   const SpatialTunnel& tunnel) {
  std::vector<OpeningConvergence> found;
  for (std::size_t k = 1; k <= input.openings.size(); ++k) {
    const SimplePolygon section = outline_of(outline_input(input, k));
    found.push_back(
        {opening_name(input, k), convergence(tunnel, opening_in_space(input, k, section))});
  }
  return found;
}

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
  std::visit([&](const auto& tunnel) { result.blocks = tunnel.mass().bodies.size(); }, rock.tunnel);
  result.boundary = input.is_spatial() ? spatial_boundary_text : boundary_text(rock.boundary);
  result.warnings = rock.warnings;
  for (std::string& text : unusual_values(input)) result.warnings.push_back(std::move(text));
  if (!input.unused.empty()) result.warnings.push_back(input.unused_text());
  const auto compute = [&](auto tunnel, const auto& construction) {
    const auto built =
        naming_unusual_values(input, [&] { return construct(tunnel, construction, report); });
    if (built.last().stopped) throw Stopped();
    result.verdict = built.verdict();
    result.lost_lining = built.has_lost_lining();
    result.fallen = built.fallen_measure();
    if (const auto range = built.rockfall_range()) result.marginal = range->is_marginal();
    result.reason = built.last().reason;
    result.demand = support_demand(tunnel);
    if constexpr (std::is_same_v<decltype(tunnel), SpatialTunnel>) {
      result.convergence = middle_convergence(input, tunnel);
      result.demand = per_metre(input, result.demand);
      result.fallen /= input.round_count() * input.stretch();
      if (result.fallen > 0 && !built.rockfall_range())
        result.warnings.emplace_back("rock came off; whether that is marginal was not looked for");
    } else {
      result.convergence = built.stages.back().convergence;
    }
    const SupportCondition condition = support_condition(tunnel);
    result.bolts_yielded = condition.yielded;
    result.bolts_ruptured = condition.ruptured;
    result.feet_yielded = static_cast<int>(condition.yielded_feet.size());
    if (const auto part = most_of_bolt_strength(input, tunnel)) result.of_bolt_strength = *part;
    result.error_estimate = built.last().error_estimate;
    result.out_of_balance = built.last().unbalance_over_weight;
  };
  const LinearSettings linear{.memory_limit = memory_of_a_case};
  try {
    if (const auto* section = std::get_if<Tunnel>(&rock.tunnel))
      compute(*section, construction_of(input, *section, !input.has_rounds, supports, linear,
                                        RangeSought::until_marginal));
    else
      compute(std::get<SpatialTunnel>(rock.tunnel),
              construction_of(input, supports, linear, RangeSought::until_marginal));
  } catch (const NumericalFault& fault) {
    result.failed = true;
    result.reason = fault.what();
  }
  return result;
}

}  // namespace voussoir::program
