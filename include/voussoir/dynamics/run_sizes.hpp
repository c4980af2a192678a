// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/dynamics/dynamics_settings.hpp>
#include <voussoir/model/moving_body.hpp>

namespace voussoir::detail {

/// The lengths and the speed that a run goes by, where its settings leave them to be chosen.
struct RunSizes {
  double reach;        ///< contacts are listed up to this gap [m]
  double refresh;      ///< bodies of a contact move so far before its contact update [m]
  double speed_limit;  ///< nothing here gets faster by itself [m/s]
  double unnoticed;    ///< energy that is nothing here: a thousandth of a block's radius fallen [J]

  /// @throws InvalidInput  no body can move
  template <int Dim>
  [[nodiscard]] static RunSizes choose(const std::vector<MovingBody<Dim>>& bodies,
                                       const DynamicsSettings& settings) {
    double size = 0, thrown = 0, mass = 0;
    int count = 0;
    Vec<Dim> low = zeros<Vec<Dim>>(), high = low;
    for (const MovingBody<Dim>& body : bodies) {
      low = smaller_of(low, body.pose.position);
      high = larger_of(high, body.pose.position);
      if (!body.movable()) continue;
      thrown = std::max(thrown, body.velocity.norm() + body.spin().norm() * body.radius);
      size += body.radius;
      mass += body.mass;
      ++count;
    }
    if (count == 0) throw InvalidInput("dynamics: there is no block that can move");
    size /= count;
    RunSizes sizes;
    sizes.reach = settings.reach > 0 ? settings.reach : 0.02 * size;
    sizes.refresh = settings.refresh > 0 ? settings.refresh : 0.25 * sizes.reach;
    // Falling through all there is; and a light block between heavy ones, hit twice.
    sizes.speed_limit =
        settings.speed_limit > 0
            ? settings.speed_limit
            : 4 * (thrown + std::sqrt(2 * settings.gravity * ((high - low).norm() + size)));
    sizes.unnoticed = 1e-3 * mass * settings.gravity * size;
    if (!(sizes.speed_limit > 0)) sizes.speed_limit = std::numeric_limits<double>::infinity();
    return sizes;
  }

  /// How far a body may move between two looks at the contacts [m]. Both bodies of a pair move: a
  /// pair that was further apart than `reach` when it was last asked about is asked again after
  /// half the reach at the latest, hence before it can touch.
  [[nodiscard]] double travel_limit() const { return 0.5 * std::min(refresh, 0.5 * reach); }

  /// The longest step in which no body moves further than a quarter of the reach, from its present
  /// speed and acceleration [s]; infinite where nothing moves.
  /// @param acting  what acts on each body, up to date
  /// @param each    each(visit) calls visit(number) for every body in question
  template <int Dim, class Acting, class Each>
  [[nodiscard]] double longest_step(const std::vector<MovingBody<Dim>>& bodies,
                                    const std::vector<Acting>& acting, Each&& each) const {
    double least = std::numeric_limits<double>::infinity();
    each([&](std::size_t b) {
      if (!bodies[b].movable()) return;
      const double speed = bodies[b].fastest_point(), gain = acting[b].fastest_gain(bodies[b]);
      const double way = 0.25 * reach;
      // speed t + gain t^2 / 2 = way; 0 / 0 where it is at rest and stays there
      const double time = 2 * way / (speed + std::sqrt(speed * speed + 2 * gain * way));
      if (time < least) least = time;
    });
    return least;
  }
};

}  // namespace voussoir::detail
