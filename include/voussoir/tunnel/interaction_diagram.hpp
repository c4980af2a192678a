// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/parallel.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>

namespace voussoir {

/// One tunnel of an interaction diagram.
struct DiagramPoint {
  std::size_t spacing, thickness;  ///< indices into the two axes
  double crown_convergence = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  double largest_bolt_force = 0;                                        ///< [N]
  double mean_bolt_force = 0;  ///< mean over bolts of each one's largest [N]
  double largest_thrust = 0;   ///< of the lining [N/m]
  double largest_moment = 0;   ///< absolute value, of the lining [N m/m]
  EquilibriumReport report;

  /// Rock detached, the lining came off, or no equilibrium was found: not a design.
  [[nodiscard]] bool failed() const {
    return report.verdict != Verdict::stable || report.fallen_measure > 0 || report.lacks_lining;
  }
};

/// Computes a grid of supported tunnels, bolt spacing against lining thickness, in parallel.
///
/// @param run      run(i, j): the tunnel with spacing i and thickness j; called once for each, from
///                 several threads, must not share mutable state
/// @param done     called after each tunnel with the number finished; from several threads
/// @return  row by row (spacing), thickness running faster; independent of the number of threads
///
/// Source: Boon, Houlsby & Utili (2015), section 8.1 and Fig. 24.
[[nodiscard]] VOUSSOIR_INLINE std::vector<DiagramPoint> interaction_diagram(
    std::size_t spacings, std::size_t thicknesses, unsigned threads,
    const std::function<DiagramPoint(std::size_t, std::size_t)>& run,
    const std::function<void(std::size_t)>& done = {});

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<DiagramPoint> interaction_diagram(
    std::size_t spacings, std::size_t thicknesses, unsigned threads,
    const std::function<DiagramPoint(std::size_t, std::size_t)>& run,
    const std::function<void(std::size_t)>& done) {
  std::vector<DiagramPoint> points(spacings * thicknesses);
  std::atomic<std::size_t> finished{0};
  parallel_for(points.size(), threads, [&](std::size_t job) {
    // The least supported tunnels take longest: first, so that they do not keep others waiting.
    const std::size_t i = spacings - 1 - job / thicknesses, j = job % thicknesses;
    VOUSSOIR_ASSERT(i < spacings && j < thicknesses, "a tunnel is a point of the diagram");
    DiagramPoint& point = points[i * thicknesses + j];
    point = run(i, j);
    point.spacing = i;
    point.thickness = j;
    const std::size_t now = ++finished;
    if (done) done(now);
  });
  return points;
}

#endif

}  // namespace voussoir
