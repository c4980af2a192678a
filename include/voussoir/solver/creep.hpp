// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
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

/// The time in which forces are taken to stay as they are: a fifth of the shortest creep time of
/// all laws; infinity if none creeps [s].
template <class Laws>
[[nodiscard]] double longest_creep_step(const Laws& laws) {
  double longest = std::numeric_limits<double>::infinity();
  for (const auto& law : laws.all()) longest = std::min(longest, 0.2 * law.creep_time());
  return longest;
}

/// Lets the joints of a solver creep, a new equilibrium after every step: convergence against time.
/// A step is a fifth of the shortest creep time: longer ones overshoot where blocks cannot follow.
/// Laws that do not creep rest meanwhile.
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
  const double longest = std::min(duration, longest_creep_step(solver.joint_laws()));
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
