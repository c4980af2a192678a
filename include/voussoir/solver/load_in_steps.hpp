// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/model/prescribed_displacement.hpp>

namespace voussoir {

/// Lets loads come on and fixed blocks move in equal steps, each of which is brought to
/// equilibrium: the path counts, for joints remember their slip.
///
/// Ends with the first step that is not stable or in which a block comes off. Loads are what the
/// solver still holds (`ComposedSolver::wall_fractions`): with step k of n it holds the part
/// 1 - k / n of that. After n steps of the result the loads stand in full if its last report says
/// so; after fewer they have stood up to (count - 1) / n.
///
///   arch.add_body_force(Vec2(0.15, 0));
///   const auto reports = load_in_steps(arch, {}, 10);
///
/// @param steps  > 0
/// @throws InvalidInput  no steps, or as `ComposedSolver::displace` and `equilibrium`
template <class Solver>
[[nodiscard]] std::vector<EquilibriumReport> load_in_steps(
    Solver& solver, const std::vector<PrescribedDisplacement<Solver::dim>>& displacements,
    int steps, const typename Solver::Method& method = typename Solver::Method(),
    const Acceptance& acceptance = {}, const Progress& progress = {}) {
  require(steps > 0, "steps of a loading", steps, "> 0");
  std::vector<PrescribedDisplacement<Solver::dim>> each = displacements;
  for (auto& motion : each) motion = {motion.block, motion.by / steps, motion.rotation / steps};
  const std::vector<double> held = solver.wall_fractions();
  std::vector<EquilibriumReport> reports;
  for (int k = 1; k <= steps; ++k) {
    if (!each.empty()) solver.displace(each);
    std::vector<double> left = held;
    for (double& fraction : left) fraction *= static_cast<double>(steps - k) / steps;
    reports.push_back(solver.equilibrium(left, method, acceptance, [&](double fraction) {
      return !progress || progress(fraction < 0 ? fraction : (k - 1 + fraction) / steps);
    }));
    const EquilibriumReport& last = reports.back();
    if (last.verdict != Verdict::stable || !last.fallen.empty()) break;
  }
  return reports;
}

}  // namespace voussoir
