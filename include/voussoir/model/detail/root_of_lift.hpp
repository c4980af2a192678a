// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace voussoir::detail {

/// The lift of a joint that is the mean of what its points would lift it by: the root of
/// lift - mean_at(lift), by false position (Illinois), halved where that is slow. What the joint
/// was last asked for is the lift that is returned.
/// @param first     mean_at(0), > 0 [m]
/// @param rounding  by which the two may differ [m]
/// @param mean_at   falls, or rises less than the lift does
template <class MeanAt>
double root_of_lift(double first, double rounding, const MeanAt& mean_at) {
  double low = 0, before = -first, high = first, lift = high;
  double beyond = high - mean_at(high);
  for (int k = 0; k < 60 && beyond < -rounding; ++k) {
    low = high;
    before = beyond;
    lift = high *= 2;
    beyond = high - mean_at(high);
  }
  int one_sided = 0;  // steps in which the same end has moved: > 0 the upper one
  for (int k = 0; k < 200 && std::abs(high - low) > rounding; ++k) {
    if (lift == high && std::abs(beyond) <= rounding) return lift;
    const bool is_slow = std::abs(one_sided) > 4;
    const double next =
        is_slow ? 0.5 * (low + high) : low - (high - low) * before / (beyond - before);
    lift = next;
    const double error = next - mean_at(next);
    if (std::abs(error) <= rounding) return lift;
    if (error < 0) {
      low = next;
      before = error;
      one_sided = one_sided < 0 ? one_sided - 1 : -1;
      if (one_sided < -1) beyond *= 0.5;
    } else {
      high = next;
      beyond = error;
      one_sided = one_sided > 0 ? one_sided + 1 : 1;
      if (one_sided > 1) before *= 0.5;
    }
    if (is_slow) one_sided = 0;
  }
  if (lift != low) (void)mean_at(lift = low);  // where it jumps: no more than is paid for
  return lift;
}

}  // namespace voussoir::detail
