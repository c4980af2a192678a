// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

namespace voussoir::detail {

/// Part of its roughness that a joint has mobilised, JRC_mob / JRC [-], against shear displacement
/// over peak displacement, as published; straight lines between:
///
///   0.3  0.6   1  2     4     10    25    100
///   0    0.75  1  0.85  0.70  0.50  0.40  0
///
/// Below 0.3 friction is mobilised and roughness is not; beyond 100 it is worn. Where the table is
/// quoted without its value at 25, that is 0.42.
///
/// Source: Barton (1982), in Barton, Bandis & Bakhtar (1985), Int. J. Rock Mech. Min. Sci. 22,
/// 121-140.
struct MobilisedRoughness {
  struct Knot {
    double ratio, part;
  };
  static constexpr Knot knots[] = {{0.3, 0},  {0.6, 0.75}, {1, 1},     {2, 0.85},
                                   {4, 0.70}, {10, 0.50},  {25, 0.40}, {100, 0}};
  static constexpr std::size_t count = sizeof knots / sizeof knots[0];

  [[nodiscard]] static double at(double ratio) {
    if (ratio <= knots[0].ratio) return 0;
    for (std::size_t k = 1; k < count; ++k)
      if (ratio < knots[k].ratio) return between(knots[k - 1], knots[k], ratio);
    return 0;
  }
  /// Mean from one ratio to a larger one.
  [[nodiscard]] static double mean(double from, double to) {
    if (!(to > from)) return at(from);
    double sum = 0;
    for (std::size_t k = 1; k < count; ++k) {
      const double begin = std::max(from, knots[k - 1].ratio), end = std::min(to, knots[k].ratio);
      if (end > begin) sum += (end - begin) * between(knots[k - 1], knots[k], 0.5 * (begin + end));
    }
    return sum / (to - from);
  }
  /// Ratio before the peak at which a part is mobilised. @param part  0 to 1
  [[nodiscard]] static double ratio_before_peak(double part) {
    const std::size_t k = part < knots[1].part ? 1 : 2;
    const Knot &from = knots[k - 1], &to = knots[k];
    return from.ratio + (to.ratio - from.ratio) * (part - from.part) / (to.part - from.part);
  }

 private:
  [[nodiscard]] static double between(const Knot& from, const Knot& to, double ratio) {
    return from.part + (to.part - from.part) * (ratio - from.ratio) / (to.ratio - from.ratio);
  }
};

}  // namespace voussoir::detail
