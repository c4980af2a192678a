// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>

namespace voussoir {

/// What `creep` found at a time.
struct CreepState {
  double time;  ///< since the call [s]
  EquilibriumReport report;
};

/// Lets the joints of a solver creep, a new equilibrium after every step: convergence against time.
/// A step is a fifth of the shortest creep time: longer ones overshoot where blocks cannot follow.
/// @param duration  [s], > 0
/// @param seen      seen(state), called after every equilibrium; returns false to stop
/// @return  the states; the last is at `duration` unless one was not stable, which ends it
/// @throws InvalidInput  duration out of range
template <class Solver, class Seen>
requires CreepingLaw<typename Solver::JointLaw, Solver::dim> std::vector<CreepState> creep(
    Solver& solver, double duration, Seen&& seen,
    const typename Solver::Method& method = typename Solver::Method(),
    const Acceptance& acceptance = {}) {
  require(duration > 0 && std::isfinite(duration), "duration of creep", duration, "> 0 s");
  std::vector<CreepState> states;
  double longest = duration;
  for (const auto& law : solver.joint_laws().all())
    longest = std::min(longest, 0.2 * law.creep_time());
  for (double time = 0; time < duration;) {
    const double step = std::min(longest, duration - time);
    solver.creep_joints(step);
    time = duration - time <= longest ? duration : time + step;
    states.push_back({time, solver.equilibrium(solver.wall_fractions(), method, acceptance)});
    if (states.back().report.verdict != Verdict::stable || !seen(states.back())) break;
  }
  return states;
}

}  // namespace voussoir
