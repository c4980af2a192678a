// SPDX-License-Identifier: MIT
#include "analysis.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/operating_system.hpp>
#include <voussoir/rockmass/carving_limits.hpp>
#include <voussoir/rockmass/statistics.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "bolts_strength.hpp"
#include "joint_laws.hpp"
#include "lining_strength.hpp"
#include "mapped_rock.hpp"
#include "plausibility.hpp"
#include "survey.hpp"

namespace voussoir::program {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string number(double value) { return significant_text(value, 3); }

void append(std::vector<std::string>& to, std::vector<std::string> more) {
  for (std::string& text : more) to.push_back(std::move(text));
}

/// Of a run, besides those about its pieces at the wall and its lining.
template <class Geometry>
void warn_of_stress_and_supports(const Input& input, const RunResultIn<Geometry>& run,
                                 std::vector<std::string>& warnings) {
  const InSitu& in_situ = run.tunnel.in_situ();
  const double needed = in_situ.template required_friction_angle<Geometry::dim>(input.domain_top());
  if (needed > (1 + 1e-12) * least_friction_angle(input, in_situ.vertical(input.domain_top())))
    warnings.push_back("in situ: some joint orientations need " +
                       number(needed * 180 / std::numbers::pi) +
                       " deg of friction; joints that cannot carry the in-situ shear slip at the "
                       "first equilibrium");
  append(warnings, remarks_on(support_condition(run.tunnel)));
  if (std::string text = bolt_strength_warning(bolt_utilisations(input, run.tunnel)); !text.empty())
    warnings.push_back(std::move(text));
  if (std::string text = lining_strength_warning(lining_strength_of(input, run)); !text.empty())
    warnings.push_back(std::move(text));
}

std::vector<std::string> warnings_of(const Input& input, const RunResult& run) {
  std::vector<std::string> warnings = run.warnings;
  append(warnings, warnings_about_values(input));
  if (input.survey && !input.survey->left_out.empty())
    warnings.push_back(left_out_text(*input.survey));
  const auto warn = [&](std::string text) { warnings.push_back(std::move(text)); };
  const RockMass<Planar>& mass = run.tunnel.mass();
  const std::vector<LiningInput>& linings = input.linings;
  double least_filled = std::numeric_limits<double>::infinity();
  for (const LiningInput& lining : linings)
    least_filled = std::min(least_filled, lining.fill_depth);
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
  warn_of_stress_and_supports(input, run, warnings);
  if (!support_condition(run.tunnel).open_linings.empty())
    warn("feet of a lining: [support.lining.feet]; its bond: support.lining.interface.shear_bond");
  for (const LiningInput& lining : linings) {
    if (run.tunnel.first_lining_node() < 0) break;
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

std::vector<std::string> warnings_of(const Input& input, const SpatialRunResult& run) {
  std::vector<std::string> warnings = run.warnings;
  append(warnings, warnings_about_values(input));
  if (input.survey && !input.survey->left_out.empty())
    warnings.push_back(left_out_text(*input.survey));
  const RockMass<Spatial>& mass = run.tunnel.mass();
  if (mass.carving.dropped_pieces > 0)
    warnings.push_back(std::to_string(mass.carving.dropped_pieces) +
                       " pieces at the wall below min_wall_area^(3/2) = " +
                       number(std::pow(input.blocks.min_wall_area, 1.5)) + " m3 were dropped, " +
                       number(mass.carving.dropped_measure) + " m3 in all");
  warn_of_stress_and_supports(input, run, warnings);
  return warnings;
}

/// What became of the random joints, after those that were mapped.
template <class Geometry>
void report_random(const Input& input, RockIn<Geometry>& made) {
  check_slicing(input, made.mass.slicing, made.warnings);
  std::vector<int> set_of;
  for (const auto& joint : made.mass.joints) set_of.push_back(joint.set);
  add_random_sources(input, made.mapped_joints, set_of, made.mass.slicing, made.joints,
                     made.warnings);
}

Progress progress_of_blocks(const Report& report) {
  return [&report](double fraction) { return report("blocks", fraction); };
}

}  // namespace

RockIn<Planar> described_rock(const Input& input, const Progress& progress) {
  RockIn<Planar> made;
  DescribedRock& described = made;
  if (input.joints_file.empty()) {
    static_cast<JointedRock<Planar>&>(made) = rock_of(input, progress);
  } else {
    AnalysisInput with_traces = input;
    with_traces.mapped.traces =
        read_mapped_traces(input, section_domain(input), progress, described);
    try {
      static_cast<JointedRock<Planar>&>(made) = rock_of(with_traces, progress);
    } catch (const InvalidInput& fault) {
      throw InvalidInput("joints.file: " + utf8_text(input.joints_file) + ": " + fault.what());
    }
    report_mapped(input, made, described);
  }
  report_random(input, made);
  if (const double acts = elementary::cosine(input.tunnel.plunge); acts < 0.99)
    made.warnings.push_back("the tunnel plunges: a section takes gravity whole, of which " +
                            number(100 * acts) +
                            " % act in its plane; model.dimension = 3 has it as it is");
  for (const JointSetInput& set : input.joint_sets)
    if (std::string text = section_text(set, input.tunnel); !text.empty())
      (section_set(set, input.tunnel) ? made.in_section : made.warnings).push_back(std::move(text));
  return made;
}

RockIn<Spatial> described_spatial_rock(const Input& input, const Progress& progress) {
  RockIn<Spatial> made;
  static_cast<JointedRock<Spatial>&>(made) = spatial_rock_of(input, progress);
  report_random(input, made);
  return made;
}

RockInSitu rock_in_situ(const Input& input, bool wants_bias, const Report& report) {
  const Progress progress = progress_of_blocks(report);
  if (input.is_spatial()) {
    RockIn<Spatial> rock = described_spatial_rock(input, progress);
    DescribedRock described = std::move(rock);
    return {excavated_rock(input, static_cast<JointedRock<Spatial>&&>(rock), report),
            std::move(described)};
  }
  RockIn<Planar> rock = described_rock(input, progress);
  const double half_width = input.tunnel.half_width();
  const double block = std::sqrt(block_sizes(rock.mass).mean),
               spacing = radial_spacing(rock.mass, Vec2::Zero(), half_width, 2 * half_width),
               depth = rock.mass.domain.depth(Vec2::Zero());
  DescribedRock described = std::move(rock);
  RockInSitu made{
      excavated_rock(input, static_cast<JointedRock<Planar>&&>(rock), wants_bias, report),
      std::move(described)};
  append(made.warnings,
         remarks_on(in_situ_closure(input, std::get<Tunnel>(made.tunnel).in_situ().vertical(depth),
                                    block, spacing)));
  return made;
}

void check_bolt_ends(const Input& input, const std::vector<std::optional<BoltSpacing>>& first) {
  std::vector<std::optional<BoltSpacing>> spacings(1);
  for (std::size_t k = 1; k < input.bolts.size(); ++k) spacings.push_back(input.bolts[k].spacing);
  for (const std::optional<BoltSpacing>& spacing : first) {
    spacings.front() = spacing;
    const auto found = bolt_outside(input, spacings);
    if (!found) continue;
    const BoltsInput& bolts = input.bolts[found->pattern];
    throw InvalidInput(input.bolts_key(found->pattern) +
                       (bolts.bars.empty() ? ".length = " + number(bolts.length) + " m" : ".bars") +
                       ": a bolt would end at " + found->end + " m, outside the rock" +
                       unusual_among(input, {"model.", "tunnel.", "support.bolts."}) +
                       "\n   = accepted: bolts that end within " + found->low + " and " +
                       found->high + " m; this one could be " +
                       number(std::floor(1e3 * found->room) / 1e3) + " m long");
  }
}

namespace {

/// From the file to a finished run, with what is to be said of it.
/// @param construct  finishes it, from rock that is ready
template <class Geometry, class Construct>
RunResultIn<Geometry> timed_run(const Input& input, const Report& report,
                                const Construct& construct) {
  return naming_unusual_values(input, [&] {
    const auto start = std::chrono::steady_clock::now();
    check_bolt_ends(input, {supports_of(input).spacing});
    report("blocks", -1.0);
    RockInSitu rock = rock_in_situ(input, true, report);
    DescribedRock described = rock;
    const double generation = seconds_since(start);
    const auto search = std::chrono::steady_clock::now();
    RunResultIn<Geometry> run{construct(static_cast<ExcavatedRock&&>(rock)), std::move(described)};
    run.rock_warnings = run.warnings;
    run.generation_seconds = generation;
    run.equilibrium_seconds = seconds_since(search);
    return run;
  });
}

}  // namespace

RunResult run_of(const Input& input, const Report& report, const StageObserver<Tunnel>& observer) {
  auto run = timed_run<Planar>(input, report, [&](ExcavatedRock&& rock) {
    return run_tunnel(input, std::move(rock), report, observer);
  });
  for (const LiningInput& lining : input.linings)
    if (!lining.nodes && lining.bends_on_bond())
      run.bonded_nodes = std::max(run.bonded_nodes,
                                  lining_nodes(input, lining, run.tunnel.mass(), lining.thickness));
  run.warnings = warnings_of(input, run);
  return run;
}

SpatialRunResult spatial_run_of(const Input& input, const Report& report,
                                const StageObserver<SpatialTunnel>& observer) {
  auto run = timed_run<Spatial>(input, report, [&](ExcavatedRock&& rock) {
    return run_spatial_tunnel(input, std::move(rock), report, observer);
  });
  run.warnings = warnings_of(input, run);
  return run;
}

TunnelResult tunnel_in(const Input& input, const RockInSitu& rock, const SupportChoice& supports,
                       const Report& report) {
  TunnelResult result = supported_tunnel(input, rock, supports, report);
  std::vector<std::string> warnings = rock.warnings;
  append(warnings, warnings_about_values(input));
  append(warnings, std::move(result.warnings));
  result.warnings = std::move(warnings);
  if (result.failed)
    for (const std::string& value : unusual_values(input)) result.reason += "\n   = " + value;
  return result;
}

std::string composition_of(const Input& input) {
  std::string text =
      std::string(input.is_spatial() ? Spatial::name : Planar::name) + ", " + CutContacts::name;
  for (const JointLawInput* law : laws_in_use(input)) {
    const std::string name = joint_of(*law).type_name();
    if (text.find(", " + name) == std::string::npos) text.append(", ").append(name);
  }
  for (const BoltsInput& bolts : input.bolts) {
    const std::string before = text;
    text.append(", ").append(anchors_of(bolts).type_name());
    text.append(", ").append(bolt_of(bolts).type_name());
    // Patterns that are alike are named once.
    if (before.ends_with(text.substr(before.size()))) text = before;
  }
  for (const LiningInput& lining : input.linings) {
    const std::string before = text;
    text.append(", ")
        .append(AnyLining::type_name(lining.beam))
        .append(" on ")
        .append(lining.shear_bond > 0 ? MohrCoulombJoint::name : CoulombJoint::name);
    if (before.ends_with(text.substr(before.size()))) text = before;
  }
  return text + ", " + method_of(input, {}, RangeSought::none).type_name();
}

}  // namespace voussoir::program
