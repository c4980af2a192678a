// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <voussoir/tunnel/support_demand.hpp>

namespace voussoir_test {

/// What an arch of lining on two feet carries.
struct ArchOnFeet {
  double thrust, moment;  ///< the largest [N/m], [N m/m]
  double right, left;     ///< what the feet bear [N/m]

  /// As its mirror image has it.
  [[nodiscard]] ArchOnFeet mirrored() const { return {thrust, moment, left, right}; }
};

template <class Solver>
[[nodiscard]] ArchOnFeet arch_on_feet(const Solver& tunnel) {
  const auto feet = voussoir::foot_forces(tunnel);
  REQUIRE(feet.size() == 2);
  const voussoir::SupportDemand demand = voussoir::support_demand(tunnel);
  const bool right_first = feet[0].place.x() > feet[1].place.x();
  return {demand.largest_thrust, demand.largest_moment, feet[right_first ? 0 : 1].bearing,
          feet[right_first ? 1 : 0].bearing};
}

/// The largest of the relative differences.
[[nodiscard]] inline double apart(const ArchOnFeet& a, const ArchOnFeet& b) {
  const auto relative = [](double x, double y) { return std::abs(x - y) / std::max(x, y); };
  return std::max({relative(a.thrust, b.thrust), relative(a.moment, b.moment),
                   relative(a.right, b.right), relative(a.left, b.left)});
}

}  // namespace voussoir_test
