// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <type_traits>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/core/random.hpp>

#include "support/near.hpp"

namespace mohr_coulomb_joint_test {

using namespace voussoir;

namespace {

constexpr double kn = 5e9, ks = 5e8, degree = std::numbers::pi / 180, w = 0.4;
template <int Dim>
using Dimension = std::integral_constant<int, Dim>;

template <int Dim>
PointLoad<Dim> point(double normal, double opening, double slip) {
  PointLoad<Dim> load{w, {}, {opening, Vec<Dim - 1>::Zero()}};
  load.initial.normal = normal;
  if constexpr (Dim == 2)
    load.motion.slip[0] = slip;
  else
    load.motion.slip = slip * Vec<2>(0.6, -0.8);
  return load;
}

/// Slides a point at this initial normal force by steps to `slip`; the shear at the end, and the
/// largest on the way.
struct Path {
  double end, peak, normal, lost, stored;
};
template <int Dim>
Path slide(const MohrCoulombJoint& law, double normal, double slip, int steps) {
  MohrCoulombJoint::State<Dim> state;
  Path path{};
  PointForce<Dim> force;
  for (int k = 1; k <= steps; ++k) {
    const auto load = point<Dim>(normal, 0, slip * k / steps);
    force = law.force(load, state);
    path.peak = std::max(path.peak, force.tangential.norm());
    path.lost += law.commit(load, state);
    path.end = force.tangential.norm();
    path.normal = force.normal;
    path.stored = law.stored_energy(load, state);
  }
  return path;
}

}  // namespace

TEST_SUITE("contact/mohr_coulomb_joint") {
  TEST_CASE_TEMPLATE("without cohesion, tension and dilation it is a Coulomb joint", D,
                     Dimension<2>, Dimension<3>) {
    constexpr int dim = D::value;
    const MohrCoulombJoint law({kn, ks, 35 * degree});
    const CoulombJoint plain({kn, ks, 35 * degree});
    MohrCoulombJoint::State<dim> state;
    CoulombJoint::State<dim> other;
    for (const auto& [opening, slip] : {std::pair{0.0, 1e-4},
                                        {1e-5, 1e-3},
                                        {-1e-5, 2e-3},
                                        {-1e-5, 1.5e-3},
                                        {3e-4, 0.0},
                                        {-2e-5, -1e-3}}) {
      const auto load = point<dim>(1e5, opening, slip);
      const auto mine = law.force(load, state), theirs = plain.force(load, other);
      CHECK(mine.normal == voussoir_test::near(theirs.normal).epsilon(1e-14));
      CHECK((mine.tangential - theirs.tangential).norm() < 1e-9);
      CHECK(law.commit(load, state) ==
            voussoir_test::near(plain.commit(load, other)).epsilon(1e-9));
    }
  }

  // Strength and flow are linear, so along a straight path what is solved at its end is what small
  // steps come to; in the last of them, as far as they go.
  TEST_CASE_TEMPLATE("dilation may hold shut what is pulled open: one step is as good as 4 000", D,
                     Dimension<2>, Dimension<3>) {
    constexpr int dim = D::value;
    Random random(71);
    int held = 0, open = 0;
    for (int k = 0; k < 100; ++k) {
      const double limit = random.uniform() < 0.5 ? 1e-3 : 1;
      const MohrCoulombJoint law({.joint_normal_stiffness = kn,
                                  .joint_shear_stiffness = ks,
                                  .friction_angle = 35 * degree,
                                  .dilation_angle = (2 + 18 * random.uniform()) * degree,
                                  .dilation_limit = limit});
      const double normal = 1e5 * random.uniform(), slip = 4e-3 * random.uniform(),
                   opening = 1e-3 * random.uniform();
      MohrCoulombJoint::State<dim> at_once, by_steps;
      const auto end = point<dim>(normal, opening, slip);
      const PointForce<dim> one = law.force(end, at_once);
      PointForce<dim> many;
      constexpr int steps = 4000;
      for (int n = 1; n <= steps; ++n) {
        const auto load = point<dim>(normal, opening * n / steps, slip * n / steps);
        many = law.force(load, by_steps);
        (void)law.commit(load, by_steps);
      }
      const bool is_pulled = normal < kn * w * opening;
      held += is_pulled && one.normal > 0;
      open += one.normal == 0;
      CAPTURE(k);
      const double last_step = (kn * opening + ks * slip) * w / steps;
      CHECK(std::abs(one.normal - many.normal) <= last_step);
      CHECK((one.tangential - many.tangential).norm() <= last_step);
    }
    CHECK(held >= 10);
    CHECK(open >= 10);
  }

  TEST_CASE_TEMPLATE("force is a continuous function of motion", D, Dimension<2>, Dimension<3>) {
    constexpr int dim = D::value;
    const MohrCoulombJoint law({.joint_normal_stiffness = kn,
                                .joint_shear_stiffness = ks,
                                .friction_angle = 35 * degree,
                                .dilation_angle = 10 * degree,
                                .dilation_limit = 1e-3});
    const MohrCoulombJoint::State<dim> state;
    // Nowhere does it change faster than the joint is stiff: slip less than motion, and what
    // dilation adds to the normal force no more than friction turns into shear.
    constexpr double step = 1e-6;
    for (double slip = 0; slip < 5e-3; slip += 5e-4)
      for (double opening = -1e-4; opening < 1e-3; opening += step) {
        const auto a = law.force(point<dim>(1e5, opening, slip), state),
                   b = law.force(point<dim>(1e5, opening + step, slip), state);
        CHECK(std::abs(a.normal - b.normal) <= kn * w * step * (1 + 1e-9));
        CHECK((a.tangential - b.tangential).norm() <= kn * w * step * (1 + 1e-9));
      }
  }

  TEST_CASE_TEMPLATE("peak strength c + sigma tan(phi), then the residual", D, Dimension<2>,
                     Dimension<3>) {
    const MohrCoulombJoint law({.joint_normal_stiffness = kn,
                                .joint_shear_stiffness = ks,
                                .friction_angle = 40 * degree,
                                .cohesion = 3e5,
                                .tensile_strength = 1e5,
                                .residual_friction_angle = 30 * degree,
                                .residual_cohesion = 2e4});
    const double normal = 2e5;
    const Path path = slide<D::value>(law, normal, 3e-3, 3000);
    // The peak is met to a step of slip: k_s w 1e-6 m = 200 N.
    CHECK(std::abs(path.peak - (3e5 * w + normal * std::tan(40 * degree))) < 200);
    CHECK(path.end == voussoir_test::near(2e4 * w + normal * std::tan(30 * degree)).epsilon(1e-12));
    // Work of the shear force = friction + what failure set free + what the spring still holds.
    const double residual = path.end, spring = ks * w, top = path.peak;
    const double rise = 0.5 * top * top / spring, after = residual * (3e-3 - top / spring);
    CHECK(path.lost + path.stored - 0.5 * normal * normal / (kn * w) ==
          voussoir_test::near(rise + after).epsilon(2e-3));
  }

  TEST_CASE("it carries tension up to its strength once") {
    const MohrCoulombJoint law({.joint_normal_stiffness = kn,
                                .joint_shear_stiffness = ks,
                                .friction_angle = 40 * degree,
                                .cohesion = 3e5,
                                .tensile_strength = 1e5});
    MohrCoulombJoint::State<2> state;
    const auto at = [&](double opening) { return point<2>(0, opening, 0); };
    const double strain = 1e5 / kn;
    CHECK(law.force(at(0.99 * strain), state).normal == voussoir_test::near(-0.99e5 * w));
    CHECK(law.commit(at(0.99 * strain), state) == 0);
    CHECK(law.force(at(1.01 * strain), state).normal == 0);
    CHECK(law.commit(at(1.01 * strain), state) ==
          voussoir_test::near(0.5 * w * 1e5 * 1e5 / kn));  // what it stored
    CHECK(law.force(at(0.5 * strain), state).normal == 0);
    CHECK(law.force(at(-strain), state).normal == voussoir_test::near(1e5 * w));
  }

  TEST_CASE_TEMPLATE("dilation lifts the joint by tan(psi) per slip, up to its limit", D,
                     Dimension<2>, Dimension<3>) {
    const double psi = 10 * degree, limit = 1e-3;
    const MohrCoulombJoint law({.joint_normal_stiffness = kn,
                                .joint_shear_stiffness = ks,
                                .friction_angle = 40 * degree,
                                .dilation_angle = psi,
                                .dilation_limit = limit});
    // Held shut: all dilation becomes normal force. Slip is what is left of s after the spring.
    for (const int steps : {1, 7, 1000}) {
      CAPTURE(steps);
      const Path path = slide<D::value>(law, 1e5, 0.8e-3, steps);
      const double plastic = 0.8e-3 - path.end / (ks * w);
      CHECK(path.normal ==
            voussoir_test::near(1e5 + kn * w * std::tan(psi) * plastic).epsilon(1e-9));
      CHECK(path.end == voussoir_test::near(path.normal * std::tan(40 * degree)).epsilon(1e-9));
      const Path far = slide<D::value>(law, 1e5, 8e-3, steps);
      CHECK(far.normal == voussoir_test::near(1e5 + kn * w * std::tan(psi) * limit).epsilon(1e-9));
      CHECK(far.end == voussoir_test::near(far.normal * std::tan(40 * degree)).epsilon(1e-9));
    }
  }

  TEST_CASE_TEMPLATE(
      "work is stored or lost to the last digit, also where a bond in tension is sheared", D,
      Dimension<2>, Dimension<3>) {
    // Normal stress and shear are linear in every step until the bond is sheared off, in the commit
    // of that step: the work by the mean force of both ends is exact.
    constexpr int dim = D::value;
    Random random(83, dim);
    int sheared_in_tension = 0;
    for (int n = 0; n < 200; ++n) {
      CAPTURE(n);
      const MohrCoulombJoint law({.joint_normal_stiffness = kn,
                                  .joint_shear_stiffness = ks,
                                  .friction_angle = 30 * degree,
                                  .cohesion = 3e5,
                                  .tensile_strength = 4e5,
                                  .residual_friction_angle = 20 * degree,
                                  .residual_cohesion = n % 2 == 0 ? 0.0 : 5e4});
      MohrCoulombJoint::State<dim> state;
      PointLoad<dim> load = point<dim>(1e4 * random.uniform(), 0, 0);
      load.bond.stretch = 4e5 / kn;  // a joint of one point, which tells it what is left
      double stored = law.stored_energy(load, state), work = 0, lost = 0, turned_over = stored;
      const double start = stored;
      PointForce<dim> before = law.force(load, state);
      for (int k = 0; k < 100 && !state.failed; ++k) {
        const PointMotion<dim> from = load.motion;
        load.motion.opening = 7e-5 * (2 * random.uniform() - 1);
        for (int i = 0; i + 1 < dim; ++i) load.motion.slip[i] += 3e-4 * (2 * random.uniform() - 1);
        const PointForce<dim> now = law.force(load, state);
        const double done =
            -0.5 * (before.normal + now.normal) * (load.motion.opening - from.opening) -
            0.5 * (before.tangential + now.tangential).dot(load.motion.slip - from.slip);
        lost += law.commit(load, state);
        stored = law.stored_energy(load, state);
        work += done;
        turned_over += std::abs(done) + stored;
        before = law.force(load, state);
        if (state.failed && now.normal < 0) ++sheared_in_tension;
      }
      REQUIRE(state.failed);
      CHECK(std::abs(work - (stored - start) - lost) <= 1e-9 * turned_over);
      CHECK(lost > 0);
    }
    CHECK(sheared_in_tension > 50);
  }

  TEST_CASE("parameters out of range are refused by name") {
    using P = MohrCoulombJoint::Params;
    CHECK_THROWS_WITH_AS(MohrCoulombJoint(P{.joint_normal_stiffness = kn,
                                            .joint_shear_stiffness = ks,
                                            .friction_angle = 0.6,
                                            .cohesion = 1e5,
                                            .tensile_strength = 2e5}),
                         "tensile_strength = 200000: must be >= 0 Pa and <= cohesion / "
                         "tan(phi)",
                         InvalidInput);
    CHECK_THROWS_AS(MohrCoulombJoint(P{kn, ks, 0.6, -1}), InvalidInput);
    CHECK_THROWS_AS(MohrCoulombJoint(P{kn, ks, 0.6, 1e5, 0, 0.7, 1e-3}), InvalidInput);
    CHECK_THROWS_AS(MohrCoulombJoint(P{kn, ks, 0.6, 1e5, 0, 0, 0, 0.7}), InvalidInput);
    CHECK_THROWS_AS(MohrCoulombJoint(P{kn, ks, 0.6, 1e5, 0, 0, 0, -1, 2e5}), InvalidInput);
  }
}

}  // namespace mohr_coulomb_joint_test
