// SPDX-License-Identifier: MIT
#include "spatial_analysis.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>

#include "joint_laws.hpp"
#include "joint_sets.hpp"
#include "mapped_rock.hpp"
#include "openings.hpp"
#include "plausibility.hpp"
#include "survey.hpp"

namespace voussoir::program {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<std::string> warnings_of(const Input& input, const SpatialRunResult& run) {
  std::vector<std::string> warnings = run.warnings;
  for (std::string& text : unusual_values(input)) warnings.push_back(std::move(text));
  if (!input.unused.empty()) warnings.push_back(input.unused_text());
  if (input.survey && !input.survey->left_out.empty())
    warnings.push_back(left_out_text(*input.survey));
  const auto number = [](double value) { return significant_text(value, 3); };
  const RockMass<Spatial>& mass = run.tunnel.mass();
  if (mass.carving.dropped_pieces > 0)
    warnings.push_back(std::to_string(mass.carving.dropped_pieces) +
                       " pieces at the wall below min_wall_area^(3/2) = " +
                       number(std::pow(input.blocks.min_wall_area, 1.5)) + " m3 were dropped, " +
                       number(mass.carving.dropped_measure) + " m3 in all");
  const double needed = run.tunnel.in_situ().required_friction_angle<3>(input.domain_top());
  if (needed >
      (1 + 1e-12) * least_friction_angle(input, run.tunnel.in_situ().vertical(input.domain_top())))
    warnings.push_back("in situ: some joint orientations need " +
                       number(needed * 180 / std::numbers::pi) +
                       " deg of friction; joints that cannot carry the in-situ shear slip at the "
                       "first equilibrium");
  for (std::string& text : remarks_on(support_condition(run.tunnel)))
    warnings.push_back(std::move(text));
  return warnings;
}

Domain<2> section_of(const Domain<3>& domain) {
  return {{domain.low.x(), domain.low.z()}, {domain.high.x(), domain.high.z()}};
}

/// A joint of the section that goes on along the tunnel without end.
JointPlane along_the_tunnel(const Segment& trace, const JointSetInput& set,
                            const Domain<3>& domain) {
  const Vec2 centre = trace.centre(), half = 0.5 * (trace.end - trace.start);
  const Vec3 middle(centre.x(), 0.5 * (domain.low.y() + domain.high.y()), centre.y()),
      down(half.x(), 0, half.y());
  const Vec2 across = normalized(perpendicular(half));
  if (std::isinf(set.extent)) return unbounded_joint(middle, Vec3(across.x(), 0, across.y()));
  return joint_rectangle(middle, down, Vec3(0, domain.size().y(), 0));
}

}  // namespace

InSitu in_situ_of(const Input& input) {
  const StressInput& stress = input.stress;
  InSitu made{.density = input.rock.density,
              .k0 = input.K0_across(),
              .surcharge = stress.surcharge,
              .gravity = input.model.gravity};
  if (stress.K0_minor && input.is_spatial())
    made = made.with_horizontal(stress.K0, *stress.K0_minor,
                                stress.K0_trend.value_or(0) - input.tunnel.trend.value_or(0));
  return stress.horizontal > 0 ? made.with_constant_horizontal(stress.horizontal) : made;
}

GeneratedRockIn<Spatial> spatial_rock_of(const Input& input, const Progress& progress) {
  const Domain<3> domain = spatial_domain(input);
  const Domain<2> section = section_of(domain);
  std::vector<SpatialJoint> joints;
  int index = 0;  // among the random sets, as in the section
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k) {
    const JointSetInput& set = input.joint_sets[k];
    if (!set.is_random()) continue;
    const auto add = [&](JointPlane trace) {
      joints.push_back({std::move(trace), static_cast<int>(k)});
    };
    if (is_of_section(input, set))
      for (const Joint& joint :
           generate(*section_set(set, input.tunnel), index, section, input.model.seed, progress))
        add(along_the_tunnel(joint.trace, set, domain));
    else
      for (SpatialJoint& joint :
           generate(spatial_set(set, input.tunnel), index, domain, input.model.seed, progress))
        add(std::move(joint.trace));
    ++index;
  }
  // One random order, that of the section where all sets are of it: see `joint_network`.
  Random(input.model.seed, 0).shuffle(joints);
  GeneratedRockIn<Spatial> rock;
  rock.mass = slice<Spatial>(
      domain, joints, {input.blocks.min_inscribed_radius, input.blocks.max_elongation}, progress);
  check_slicing(input, rock.mass.slicing, rock.warnings);
  std::vector<int> set_of;
  for (const SpatialJoint& joint : rock.mass.joints) set_of.push_back(joint.set);
  add_random_sources(input, set_of.size() - joints.size(), set_of, rock.mass.slicing, rock.joints,
                     rock.warnings);
  return rock;
}

ExcavatedRock spatial_rock_in_situ(const Input& input, const Report& report) {
  const Progress progress = [&](double fraction) { return report("blocks", fraction); };
  GeneratedRockIn<Spatial> rock = spatial_rock_of(input, progress);
  SpatialTunnel tunnel(std::move(rock.mass), laws_of(input), in_situ_of(input), progress);
  const double unbalance = tunnel.out_of_balance_ratio();
  return {std::move(tunnel),
          std::move(rock.joints),
          opening_of(input),
          {},
          unbalance,
          std::move(rock.warnings),
          {},
          {}};
}

Convergence middle_convergence(const Input& input, const SpatialTunnel& tunnel) {
  const double driven = input.round_count() * input.stretch();
  return convergence(tunnel, driven_tunnel(input), 0.5 * driven, driven / 6);
}

SupportDemand per_metre(const Input& input, SupportDemand demand) {
  if (!input.lining) return demand;
  const double width = strip_width(input);
  for (double* const force : {&demand.largest_thrust, &demand.mean_thrust, &demand.largest_moment})
    *force /= width;
  return demand;
}

SpatialRunResult run_spatial_tunnel(const Input& input, const Report& report,
                                    const StageObserver<SpatialTunnel>& observer) {
  return naming_unusual_values(input, [&] {
    const auto start = std::chrono::steady_clock::now();
    if (input.bolts) check_bolts(input, {input.bolts->spacing});
    report("blocks", -1.0);
    ExcavatedRock rock = spatial_rock_in_situ(input, report);
    SpatialRunResult run{std::get<SpatialTunnel>(std::move(rock.tunnel)), rock.opening};
    run.warnings = run.rock_warnings = std::move(rock.warnings);
    run.joints = std::move(rock.joints);
    run.in_situ_unbalance = rock.in_situ_unbalance;
    run.generation_seconds = seconds_since(start);
    const auto search = std::chrono::steady_clock::now();
    const LinearSettings linear{.threads = std::clamp(std::thread::hardware_concurrency(), 1U, 2U)};
    run.built =
        construct(run.tunnel, construction_of(input, supports_of(input), linear, RangeSought::all),
                  report, observer);
    if (run.last().stopped) throw Stopped();
    run.equilibrium_seconds = seconds_since(search);
    run.warnings = warnings_of(input, run);
    return run;
  });
}

}  // namespace voussoir::program
