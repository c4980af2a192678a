// SPDX-License-Identifier: MIT
#include "blocks_analysis.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>
#include <voussoir/core/message.hpp>

#include "joint_laws.hpp"
#include "plausibility.hpp"

namespace voussoir::program {

namespace {

std::vector<ConvexPolygon> shapes_of(const LaidInput& laid) {
  std::vector<ConvexPolygon> shapes;
  for (const LaidBlockInput& block : laid.blocks) {
    std::vector<Vec2> corners;
    for (const Point& p : block.vertices) corners.emplace_back(p[0], p[1]);
    shapes.emplace_back(std::move(corners));
  }
  return shapes;
}

void add_loads(Tunnel& solver, const LaidInput& laid, bool proportional) {
  for (const BlockLoadInput& load : laid.loads) {
    if (load.is_proportional != proportional) continue;
    const Vec2 force(load.force[0], load.force[1]);
    Spin<2> moment(load.moment);
    if (load.at)
      moment += moment_of(
          Vec2(Vec2((*load.at)[0], (*load.at)[1]) - solver.system().body(load.block).centre),
          force);
    solver.add_load(load.block, {force, moment});
  }
  if (proportional && (laid.kh != 0 || laid.kv != 0)) solver.add_body_force(Vec2(laid.kh, laid.kv));
}

/// Half of what can move: when more has come off, the whole has.
double half_of_the_free(const Tunnel& solver) {
  double sum = 0;
  for (int b = 0; b < solver.ground(); ++b)
    if (solver.system().body(b).movable)
      sum += solver.mass().bodies[static_cast<std::size_t>(b)].properties.measure;
  return 0.5 * sum;
}

/// Blocks that can move and share no joint with another: nothing holds them.
void warn_of_loose_blocks(const LaidInput& laid, BlocksRun& run) {
  std::vector<bool> is_held(laid.blocks.size());
  for (const auto& contact : run.solver.system().joints.contacts())
    for (const int b : {contact.a, contact.b}) is_held[static_cast<std::size_t>(b)] = true;
  std::string names;
  int count = 0;
  for (std::size_t b = 0; b < laid.blocks.size(); ++b) {
    if (is_held[b] || laid.blocks[b].fixed) continue;
    if (++count <= 10) names += (count > 1 ? ", \"" : "\"") + laid.blocks[b].name + "\"";
  }
  if (count == 0) return;
  run.warnings.push_back(message(
      {"nothing holds ", count == 1 ? "block " : "blocks ", names,
       count > 10 ? message({" and ", count - 10, " more"}) : std::string(),
       ": no part of a face lies on one of another block, corners alone do not count; where "
       "they are meant to touch, write the corners that they share with the same digits"}));
}

bool stands(const EquilibriumReport& report) {
  return report.verdict == Verdict::stable && report.fallen.empty();
}

}  // namespace

std::string BlocksRun::word() const {
  if (last().verdict == Verdict::undecided) return "undecided";
  if (last().verdict == Verdict::collapse) return "falls";
  return stands(last()) ? "stands" : "part of it falls";
}

BlocksRun run_blocks(const Input& input, const Report& report) {
  const auto start = std::chrono::steady_clock::now();
  const LaidInput& laid = *input.laid;
  const auto progress = [&](const char* stage) {
    return [&report, stage](double fraction) { return report(stage, fraction); };
  };
  BlocksRun run{
      Tunnel(laid_blocks<Planar>(shapes_of(laid)), *input.joint,
             {.density = input.rock.density, .gravity = input.model.gravity, .is_laid = true},
             progress("blocks")),
      {},
      {}};
  for (std::size_t b = 0; b < laid.blocks.size(); ++b)
    if (laid.blocks[b].fixed) run.solver.fix(static_cast<int>(b));
  run.warnings = laid.warnings;
  warn_of_loose_blocks(laid, run);
  Acceptance acceptance;
  acceptance.error_estimate = input.run.tolerance;
  acceptance.unbalance_over_weight = input.run.out_of_balance;
  acceptance.displacement_limit = input.run.displacement_limit;
  acceptance.contact_update_limit = input.run.contact_update_limit;
  acceptance.collapse_measure = half_of_the_free(run.solver);
  const AnyMethod method =
      method_of(input, {.threads = std::clamp(std::thread::hardware_concurrency(), 1U, 2U)},
                RangeSought::none);
  add_loads(run.solver, laid, false);
  run.weight = run.solver.equilibrium(0.0, method, acceptance, progress("weight"));
  if (run.weight.stopped) throw Stopped();
  if (stands(run.weight) && laid.has_loading()) {
    add_loads(run.solver, laid, true);
    std::vector<PrescribedDisplacement<2>> motions;
    for (const BlockDisplacementInput& d : laid.displacements)
      motions.push_back({d.block, Vec2(d.by[0], d.by[1]), Spin<2>(d.rotation)});
    run.steps =
        load_in_steps(run.solver, motions, laid.steps, method, acceptance, progress("loading"));
    if (run.last().stopped) throw Stopped();
    const auto made = static_cast<double>(run.steps.size()) - (stands(run.last()) ? 0 : 1);
    run.reached = made / laid.steps;
  }
  for (std::string& value : warnings_about_values(input)) run.warnings.push_back(std::move(value));
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace voussoir::program
