// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <type_traits>
#include <voussoir/contact/burgers_joint.hpp>

#include "support/near.hpp"

namespace burgers_joint_test {

using namespace voussoir;

namespace {

constexpr double kn = 5e9, ks = 5e8, degree = std::numbers::pi / 180, w = 0.4;
constexpr double day = 86400, eta_m = ks * 100 * day, kk = 2e8, eta_k = kk * 3 * day;
template <int Dim>
using Dimension = std::integral_constant<int, Dim>;

const BurgersJoint law({kn, ks, 35 * degree, eta_m, kk, eta_k});

}  // namespace

TEST_SUITE("contact/burgers_joint") {
  TEST_CASE_TEMPLATE("under a constant shear it moves as Burgers' body does", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    BurgersJoint::State<dim> state;
    const double stress = 1e5;  // below sigma_n tan(phi) = 7e5
    const Vec<dim - 1> along = Vec<dim - 1>::Unit(0);
    PointLoad<dim> load{w, {}, {0, stress / ks * along}};
    load.initial.normal = 1e6 * w;
    // The block follows: s such that T = -stress w at every time.
    const double step = 0.1 * day;
    double time = 0;
    for (int k = 0; k < 200; ++k) {
      REQUIRE(law.force(load, state).tangential.norm() == voussoir_test::near(stress * w));
      law.creep(load, state, step);
      time += step;
      load.motion.slip = state.joint.plastic_slip + stress / ks * along;
    }
    const double exact = stress * (1 / ks + time / eta_m + (1 - std::exp(-time * kk / eta_k)) / kk);
    CHECK(load.motion.slip[0] == voussoir_test::near(exact).epsilon(1e-12));  // the steps are exact
  }

  TEST_CASE("held in place its shear relaxes, without overshoot at a fifth of the creep time") {
    // Maxwell's body alone: T = T0 exp(-k_s t / eta_M); explicit steps, of first order.
    const BurgersJoint maxwell({kn, ks, 35 * degree, eta_m});
    CHECK(maxwell.creep_time() == voussoir_test::near(100 * day));
    CHECK(law.creep_time() == voussoir_test::near(1 / (1 / (100 * day) + ks / eta_k)));
    const auto left = [&](int steps) {
      BurgersJoint::State<2> state;
      PointLoad<2> load{w, {}, {0, Vec<1>(1e-4)}};
      load.initial.normal = 1e6 * w;
      const double before = law.force(load, state).tangential[0];
      for (int k = 0; k < steps; ++k) maxwell.creep(load, state, maxwell.creep_time() / steps);
      return maxwell.force(load, state).tangential[0] / before;
    };
    const double coarse = left(5) - std::exp(-1), fine = left(50) - std::exp(-1);
    CHECK(std::abs(coarse) < 0.05);
    CHECK(coarse / fine == voussoir_test::near(10).epsilon(0.15));
  }

  TEST_CASE("parameters out of range are refused by name") {
    CHECK_THROWS_WITH_AS(BurgersJoint({kn, ks, 0.6, 0}),
                         "maxwell_viscosity = 0: must be > 0 Pa s/m", InvalidInput);
    CHECK_THROWS_AS(BurgersJoint({kn, ks, 0.6, eta_m, -1}), InvalidInput);
    CHECK_THROWS_AS(BurgersJoint({kn, ks, 0.6, eta_m, kk, 0}), InvalidInput);
  }
}

}  // namespace burgers_joint_test
