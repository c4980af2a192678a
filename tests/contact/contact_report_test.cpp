// SPDX-License-Identifier: MIT
// What joint laws say of a point: the same whether the law says it or its force tells, and true to
// what happens when the point is let go.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <type_traits>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/contact/burgers_joint.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/contact/smooth_wall.hpp>

#include "support/near.hpp"

namespace contact_report_test {

using namespace voussoir;

namespace {

constexpr double kn = 5e9, ks = 5e8, degree = std::numbers::pi / 180, w = 0.4, day = 86400;
constexpr double infinity = std::numeric_limits<double>::infinity();
template <int Dim>
using Dimension = std::integral_constant<int, Dim>;

const CoulombJoint coulomb({kn, ks, 35 * degree});
const MohrCoulombJoint bonded({kn, ks, 35 * degree, 2e5, 1e5, 5 * degree, 2e-3, 30 * degree});
const BurgersJoint creeping({kn, ks, 35 * degree, infinity, 2e8, 2e8 * day});

/// A point under 1 MPa, moved by this; no shear in the in-situ state.
template <int Dim>
PointLoad<Dim> point(double opening, double slip) {
  PointLoad<Dim> load{w, {}, {opening, Vec<Dim - 1>::Zero()}};
  load.initial.normal = 1e6 * w;
  load.motion.slip[0] = slip;
  return load;
}

}  // namespace

TEST_SUITE("contact/contact_report") {
  TEST_CASE_TEMPLATE("the slip that the force tells is the slip that the law remembers", D,
                     Dimension<2>, Dimension<3>) {
    constexpr int dim = D::value;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-1, 1);
    CoulombJoint::State<dim> plain;
    MohrCoulombJoint::State<dim> brittle;
    BurgersJoint::State<dim> burgers;
    PointLoad<dim> load = point<dim>(0, 0);
    load.initial.tangential[0] = 1e5;
    int slipped = 0;
    for (int k = 0; k < 200; ++k) {
      load.motion.opening = 1e-4 * place(random);
      for (int t = 0; t < dim - 1; ++t) load.motion.slip[t] = 3e-3 * place(random);
      // Slips of 3 mm and T/(k_s w) up to 6 mm, each rounded a few times.
      const double tolerance = 16 * std::numeric_limits<double>::epsilon() * 1e-2;
      coulomb.commit(load, plain);
      const ContactReport told = report_of(coulomb, load, plain);
      CHECK(std::abs(told.plastic_slip - plain.plastic_slip.norm()) <= tolerance);
      CHECK(told.normal == coulomb.force(load, plain).normal);
      CHECK(told.shear == coulomb.force(load, plain).tangential.norm());
      CHECK(told.opening == load.motion.opening);
      CHECK(told.damage == 0);
      CHECK(told.is_open == (coulomb.force(load, plain).normal == 0));
      for (int again = 0; again < 3; ++again) bonded.commit(load, brittle);  // weaker at the second
      CHECK(std::abs(report_of(bonded, load, brittle).plastic_slip - brittle.plastic_slip.norm()) <=
            tolerance);
      // Without time Burgers' joint is Coulomb's.
      creeping.commit(load, burgers);
      const ContactReport other = report_of(creeping, load, burgers);
      CHECK(std::abs(other.plastic_slip - told.plastic_slip) <= tolerance);
      CHECK(other.is_slipping == told.is_slipping);
      slipped += told.is_slipping;
    }
    CHECK(slipped > 20);
    CHECK(slipped < 180);
  }

  TEST_CASE(
      "a point slips where twice the slip makes no more shear, and sticks below its strength") {
    const auto check = [](const auto& law, auto state, double before, double beyond) {
      auto load = point<2>(0, before);
      law.commit(load, state);
      CHECK(!report_of(law, load, state).is_slipping);
      CHECK(report_of(law, load, state).plastic_slip <= 1e-15);
      load.motion.slip[0] = beyond;
      CHECK(report_of(law, load, state).is_slipping);  // before a commit
      for (int again = 0; again < 3; ++again)
        law.commit(load, state);  // a bond breaks at the first
      const ContactReport now = report_of(law, load, state);
      CHECK(now.is_slipping);  // and after
      auto further = load;
      further.motion.slip[0] = 2 * beyond;
      CHECK(report_of(law, further, state).shear == voussoir_test::near(now.shear).epsilon(1e-12));
      // Let go: back by the elastic part there is no shear left, and what stays is plastic.
      auto back = load;
      back.motion.slip[0] = now.plastic_slip;
      const ContactReport free = report_of(law, back, state);
      CHECK(free.shear <= 1e-9 * now.shear);
      CHECK(free.plastic_slip == voussoir_test::near(now.plastic_slip).epsilon(1e-9));
      CHECK(!free.is_slipping);
      CHECK(!free.is_open);
    };
    check(coulomb, CoulombJoint::State<2>{}, 1e-3, 5e-3);  // strength at 1.4 mm
    // Without roughness, which would be worn between 3 and 6 times the peak slip.
    const BartonBandisJoint smooth({.roughness = 0,
                                    .wall_strength = 80e6,
                                    .residual_friction_angle = 28 * degree,
                                    .initial_stiffness = 2e10,
                                    .maximum_closure = 2e-4});
    check(smooth, BartonBandisJoint::State<2>{}, 0.2 * smooth.peak_slip(), 3 * smooth.peak_slip());
    // Without dilation, which would raise its strength from 5 to 10 mm.
    check(MohrCoulombJoint({kn, ks, 35 * degree, 2e5, 1e5}), MohrCoulombJoint::State<2>{}, 1e-3,
          5e-3);
    check(creeping, BurgersJoint::State<2>{}, 1e-3, 5e-3);
  }

  TEST_CASE("slip that creep gives back is not plastic") {
    BurgersJoint::State<2> state;
    const auto load = point<2>(0, 1e-3);  // half of its strength and more
    for (int k = 0; k < 100; ++k) creeping.creep(load, state, 0.05 * day);
    CHECK(state.delayed_slip[0] > 1e-4);
    CHECK(report_of(creeping, load, state).plastic_slip <= 1e-15);
    CHECK(report_of(creeping, load, state).shear ==
          voussoir_test::near(creeping.force(load, state).tangential.norm()).epsilon(1e-12));
    // The force alone would call it plastic: it cannot know.
    CHECK(report_from_force(creeping, load, state).plastic_slip ==
          voussoir_test::near(state.delayed_slip[0]));
  }

  TEST_CASE("damage is the bond that broke, or the teeth that are worn") {
    MohrCoulombJoint::State<2> state;
    CHECK(report_of(bonded, point<2>(0, 1e-3), state).damage == 0);
    auto load = point<2>(2.2e-4, 0);  // pulled by 40 kN: the bond holds 40
    CHECK(report_of(bonded, point<2>(2.1e-4, 0), state).normal < 0);
    CHECK(!report_of(bonded, point<2>(2.1e-4, 0), state).is_open);
    load.motion.opening = 3e-4;
    bonded.commit(load, state);
    const ContactReport torn = report_of(bonded, load, state);
    CHECK(torn.damage == 1);
    CHECK(torn.is_open);
    CHECK(torn.normal == 0);
    // Teeth alone, 2 mm of them: a slip of 1 mm beyond the strength takes half.
    const MohrCoulombJoint teeth({kn, ks, 35 * degree, 0, 0, 1e-6, 2e-3});
    MohrCoulombJoint::State<2> worn;
    const double at_strength = 1e6 * std::tan(35 * degree) / ks;
    load = point<2>(0, at_strength + 1e-3);
    teeth.commit(load, worn);
    CHECK(report_of(teeth, load, worn).damage == voussoir_test::near(0.5).epsilon(1e-4));
    load = point<2>(0, at_strength + 5e-3);
    teeth.commit(load, worn);
    CHECK(report_of(teeth, load, worn).damage == 1);
    // A bond that was never there cannot be lost.
    const MohrCoulombJoint plain({kn, ks, 35 * degree});
    MohrCoulombJoint::State<2> slid;
    plain.commit(load, slid);
    CHECK(slid.failed);
    CHECK(report_of(plain, load, slid).damage == 0);
  }

  TEST_CASE("a smooth wall keeps no slip back, and lets go of what leaves it") {
    const SmoothWall wall(kn);
    const ContactReport closed = report_of(wall, point<3>(0, 2e-3), SmoothWall::State<3>{});
    CHECK(closed.is_slipping);
    CHECK(closed.plastic_slip == 2e-3);
    CHECK(closed.shear == 0);
    const ContactReport open = report_of(wall, point<3>(1e-3, 2e-3), SmoothWall::State<3>{});
    CHECK(open.is_open);
    CHECK(!open.is_slipping);
  }
}

}  // namespace contact_report_test
