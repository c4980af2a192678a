// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/motion/dynamics_settings.hpp>
#include <voussoir/motion/moving_body.hpp>

namespace voussoir::detail {

/// The lengths and the speed that a run goes by, where its settings leave them to be chosen.
struct RunSizes {
  double reach;        ///< contacts are listed up to this gap [m]
  double refresh;      ///< bodies of a contact move so far before it is found again [m]
  double speed_limit;  ///< nothing can be faster, unless the run has gone bad [m/s]

  /// @throws InvalidInput  no body can move
  template <int Dim>
  [[nodiscard]] static RunSizes choose(const std::vector<MovingBody<Dim>>& bodies,
                                       const DynamicsSettings& settings) {
    double size = 0, thrown = 0;
    int count = 0;
    Vec<Dim> low = Vec<Dim>::Zero(), high = low;
    for (const MovingBody<Dim>& body : bodies) {
      low = smaller_of(low, body.pose.position);
      high = larger_of(high, body.pose.position);
      if (!body.movable()) continue;
      thrown = std::max(thrown, body.velocity.norm() + body.spin().norm() * body.radius);
      size += body.radius;
      ++count;
    }
    if (count == 0) throw InvalidInput("dynamics: there is no block that can move");
    size /= count;
    RunSizes sizes;
    sizes.reach = settings.reach > 0 ? settings.reach : 0.02 * size;
    sizes.refresh = settings.refresh > 0 ? settings.refresh : 0.25 * sizes.reach;
    // Falling through all there is; and a light block that heavy ones hit.
    sizes.speed_limit =
        settings.speed_limit > 0
            ? settings.speed_limit
            : 4 * thrown + std::sqrt(2 * settings.gravity * ((high - low).norm() + size));
    if (!(sizes.speed_limit > 0)) sizes.speed_limit = std::numeric_limits<double>::infinity();
    return sizes;
  }

  /// Steps that can be made before contacts must be looked at again.
  template <int Dim>
  [[nodiscard]] int steps_in_batch(const std::vector<MovingBody<Dim>>& bodies,
                                   const DynamicsSettings& settings, double step) const {
    if (!settings.find_contacts) return settings.check_every;
    double fastest = settings.gravity * step;
    for (const MovingBody<Dim>& body : bodies)
      if (body.movable())
        fastest = std::max(fastest, body.velocity.norm() + body.spin().norm() * body.radius);
    // Both bodies of a pair move, and may get faster.
    const double steps = 0.5 * std::min(refresh, 0.5 * reach) / (fastest * step);
    return static_cast<int>(std::clamp(steps, 1.0, static_cast<double>(settings.check_every)));
  }
};

}  // namespace voussoir::detail
