// SPDX-License-Identifier: MIT
// Joints that lift as they slip: the search finds their equilibrium as it finds that of others.
#include <doctest/doctest.h>

#include <cstdint>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace dilating_joints_long {

using namespace voussoir;
using namespace voussoir_test;

namespace {

MohrCoulombJoint joint(double dilation) {
  return MohrCoulombJoint({.joint_normal_stiffness = 5e9,
                           .joint_shear_stiffness = 1e9,
                           .friction_angle = 35 * degree,
                           .dilation_angle = dilation * degree,
                           .dilation_limit = dilation > 0 ? 0.01 : 0});
}

template <class Method = TwoLevel>
Solver<MohrCoulombJoint, Method> tunnel(std::uint64_t seed, double dilation) {
  const auto opening = circular_opening(5, 36);
  Solver<MohrCoulombJoint, Method> made(jointed_rock(domain_around(opening, 25, 9, 9), seed),
                                        joint(dilation),
                                        {.density = 2700, .k0 = 1, .surcharge = 1e6});
  made.excavate(opening);
  made.install_lining(lining_frame(made.mass(), {}), LiningSection::rectangular(0.15, 25e9),
                      CoulombJoint({2e9, 2e9, 30 * degree}));
  return made;
}

}  // namespace

TEST_SUITE("equilibrium/dilating_joints_long") {
  TEST_CASE("2-D: no more than three times the effort of Coulomb, and what explicit steps find") {
    int compared = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
      for (const double dilation : {5.0, 10.0}) {
        CAPTURE(seed);
        CAPTURE(dilation);
        auto plain = tunnel(seed, 0), lifting = tunnel(seed, dilation);
        const EquilibriumReport without = plain.equilibrium(0), with = lifting.equilibrium(0);
        if (without.verdict != Verdict::stable || !without.fallen.empty()) continue;
        REQUIRE(with.verdict == Verdict::stable);
        ++compared;
        CHECK(with.steps <= 3 * without.steps);
        CHECK_FALSE(with.is_from_motion);
        if (seed > 3) continue;
        auto stepped = tunnel<Explicit>(seed, dilation);
        REQUIRE(stepped.equilibrium(0).verdict == Verdict::stable);
        CHECK(convergence(lifting).crown == near(convergence(stepped).crown).epsilon(0.01));
      }
    CHECK(compared >= 8);
  }

  TEST_CASE("3-D: no more than three times the effort of Coulomb") {
    const Domain<3> ground{{-6, 0, -6}, {6, 4, 7}};
    SpatialJointSet a{"J1", 75 * degree, 80 * degree}, b{"J2", 25 * degree, 100 * degree},
        c{"J3", 80 * degree, 5 * degree};
    for (SpatialJointSet* set : {&a, &b, &c}) set->spacing = 1.2;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(seed);
      const auto effort = [&](double dilation) {
        Solver<Spatial, MohrCoulombJoint> made(
            slice<Spatial>(ground, joint_network({a, b, c}, ground, seed),
                           {.min_inscribed_radius = 0.1}),
            joint(dilation), {.density = 2700, .surcharge = 1e6});
        made.excavate(PrismaticOpening(circular_opening(4, 20)), 0.02);
        const EquilibriumReport report = made.equilibrium(0);
        REQUIRE(report.verdict == Verdict::stable);
        CHECK_FALSE(report.is_from_motion);
        return report.steps;
      };
      const int plain = effort(0);
      for (const double dilation : {5.0, 10.0}) CHECK(effort(dilation) <= 3 * plain);
    }
  }
}

}  // namespace dilating_joints_long
