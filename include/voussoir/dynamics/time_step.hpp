// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message_number.hpp>
#include <voussoir/dynamics/dynamics_settings.hpp>

namespace voussoir::detail {

/// The largest step that is stable, damping included [s]; infinite without contacts.
///
/// The highest frequency is bounded body by body: omega^2 <= 2 max eigenvalue of M_b^-1 K_bb, for
/// a contact's energy is at most twice that of its bodies moving alone, and so what its dashpots
/// take. Local damping makes an unknown behave as if (1 + alpha) times as stiff. A dashpot sees the
/// velocity of half a step ago: with rates omega^2 and d = c / m a step h is stable if
/// omega^2 h^2 / 4 + d h / 2 <= 1.
/// @param stiffest  a bound on that eigenvalue, of the worst body [1/s^2]
/// @param most_damped  the same of the dashpots [1/s]
[[nodiscard]] inline double stable_time_step(double stiffest, double most_damped,
                                             const DynamicsSettings& settings) {
  const double square = 2 * stiffest * (1 + settings.local_damping),
               rate = 2 * most_damped * (1 + settings.local_damping);
  return 4 / (rate + std::sqrt(rate * rate + 4 * square));
}

/// The step that was asked for, or a part of the stable one [s].
/// @param steps  made so far, for the message
/// @throws NumericalFault  the step asked for is longer than the stable one
[[nodiscard]] inline double chosen_time_step(const DynamicsSettings& settings, double stable,
                                             std::int64_t steps) {
  if (settings.time_step > stable)
    throw NumericalFault("dynamics: step " + std::to_string(steps) + ": the time step of " +
                         message_number(settings.time_step, 3) +
                         " s that was asked for is longer than the stable one of " +
                         message_number(stable, 3) + " s; leave time_step at 0 to have it chosen");
  const double step = settings.time_step > 0 ? settings.time_step : settings.safety * stable;
  return std::isfinite(step) ? step : 1e-3;  // nothing touches
}

/// No longer than contacts can be followed for: what is apart must not come to overlap in one step.
/// @param longest  that [s];  @param reach  of contacts [m], for the message
/// @throws NumericalFault  the step asked for is longer
[[nodiscard]] inline double watched_time_step(double step, double longest, double reach,
                                              const DynamicsSettings& settings,
                                              std::int64_t steps) {
  if (settings.time_step > longest)
    throw NumericalFault("dynamics: step " + std::to_string(steps) + ": in the time step of " +
                         message_number(settings.time_step, 3) +
                         " s that was asked for a body moves more than a quarter of the reach of " +
                         "contacts of " + message_number(reach, 3) +
                         " m, and may pass into another unseen; leave time_step at 0, or give " +
                         "<= " + message_number(longest, 3) + " s");
  return longest > 0 ? std::min(step, longest) : step;
}

}  // namespace voussoir::detail
