// SPDX-License-Identifier: MIT
// Excavated in rounds or at once, in 3-D.
#include <doctest/doctest.h>

#include <cstdint>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/elastic_tunnel.hpp"
#include "support/jointed_mass.hpp"

namespace construction_3d_long {

using namespace voussoir;
using voussoir_test::deep;
using voussoir_test::difference;
using voussoir_test::elastic;
using voussoir_test::jointed_mass;
using voussoir_test::tight;

namespace {

using Elastic = Solver<Spatial, MohrCoulombJoint>;

void settle(Elastic& tunnel) {
  const EquilibriumReport report = tunnel.equilibrium(0, {}, tight);
  INFO(report.reason);
  REQUIRE(report.verdict == Verdict::stable);
}

}  // namespace

TEST_SUITE("solver/construction_3d_long") {
  TEST_CASE("3-D: rounds along the axis end as one drift") {
    const Domain<3> space{{-6, 0, -6}, {6, 8, 6}};
    const auto section = circular_opening(4, 12);
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      CAPTURE(seed);
      const auto rock = jointed_mass(space, seed, 2.2, {.min_inscribed_radius = 0.25});
      Elastic at_once(rock, elastic, deep), in_rounds(rock, elastic, deep);
      at_once.excavate(PrismaticOpening(section, -1, 6), 0);
      settle(at_once);
      for (int round = 0; round < 3; ++round) {
        in_rounds.excavate(PrismaticOpening(section, round == 0 ? -1 : 2 * round, 2 * round + 2),
                           0);
        settle(in_rounds);
      }
      CHECK(difference(at_once, in_rounds) < 1e-6);
    }
  }
}

}  // namespace construction_3d_long
