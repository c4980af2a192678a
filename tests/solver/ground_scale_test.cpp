// SPDX-License-Identifier: MIT
// By what the movement of rock around an opening is measured: its span, and the stress at it.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <voussoir/solver/detail/ground_scale.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/near.hpp"

namespace ground_scale_test {

using namespace voussoir;
using voussoir_test::near;

TEST_SUITE("solver/ground_scale") {
  TEST_CASE("the stress is that at the opening, however far it goes, level, inclined or upright") {
    const InSitu in_situ{.density = 2700, .k0 = 0.5, .surcharge = 2e5};
    const auto at_depth = [&](double depth) {
      const double upright = 2e5 + 2700 * in_situ.gravity * depth;
      return near(upright * (1 + 2 * 0.5) / 3).epsilon(1e-9);
    };
    const FarField<3> rollers;
    RockMass<Spatial> mass;
    mass.domain = {{-20, 0, -15}, {20, 12, 25}};
    const SimplePolygon circle = circular_opening(6, 36);
    constexpr double endless = PrismaticOpening::endless;
    // Level, through all of the model, through its beginning alone, and inside it.
    for (const auto& [from, to] :
         {std::pair(-endless, endless), std::pair(-endless, 4.0), std::pair(2.0, 4.0)}) {
      mass.openings = {PrismaticOpening(circle, from, to)};
      const GroundScale scale = detail::ground_scale(mass, in_situ, rollers);
      CHECK(scale.span == near(6).epsilon(1e-9));
      CHECK(scale.pressure == at_depth(25));
    }
    // It goes down, or up, by 0.1 in 1: in the middle of the model by 0.6 m, give or take what a
    // domain of 40 m reaches along an inclined axis.
    const double slope = std::atan(0.1);
    for (const double sign : {1.0, -1.0}) {
      mass.openings = {PrismaticOpening(circle, TunnelAxis({0, 0, 0}, 0, sign * slope))};
      const GroundScale scale = detail::ground_scale(mass, in_situ, rollers);
      CHECK(scale.pressure > in_situ.stress<3>(25 + sign * 0.6 - 0.6).trace() / 3);
      CHECK(scale.pressure < in_situ.stress<3>(25 + sign * 0.6 + 0.6).trace() / 3);
    }
    // A shaft from the surface, 10 m deep: halfway down.
    mass.openings = {
        PrismaticOpening(circle, TunnelAxis({0, 6, 25}, 0, 0.5 * std::numbers::pi), 0, 10)};
    CHECK(detail::ground_scale(mass, in_situ, rollers).pressure == at_depth(5));
  }
}

}  // namespace ground_scale_test
