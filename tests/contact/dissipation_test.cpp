// SPDX-License-Identifier: MIT
// No joint law makes energy, on any path from any state: what is done on a point is stored or lost.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/contact/burgers_joint.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/foot_bearing.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/contact/smooth_wall.hpp>
#include <voussoir/core/random.hpp>

#include "support/degree.hpp"
#include "support/near.hpp"

namespace dissipation_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

/// What is done on a point and what it stores, step by step.
///
/// The work of a step is that of the force at its end, as an implicit scheme does it. For a stored
/// energy that is convex in the elastic motion that is never less than what it grows by, and slip
/// against the shear at the end is never less than nothing: the inequality below holds exactly, for
/// steps of any length, if the law has such a potential, and only then.
template <class Law, int Dim>
class Path {
 public:
  Path(const Law& law, double weight, double normal, const Vec<Dim - 1>& tangential) : law_(law) {
    load_ = {weight, {normal, tangential}, {0, zeros<Vec<Dim - 1>>()}};
    stored_ = law_.stored_energy(load_, state_);
  }
  void move_to(double opening, const Vec<Dim - 1>& slip) {
    const double opened = opening - load_.motion.opening;
    const Vec<Dim - 1> slipped = slip - load_.motion.slip;
    load_.motion = {opening, slip};
    const PointForce<Dim> force = law_.force(load_, state_);
    law_.commit(load_, state_);
    const double work = -force.normal * opened - force.tangential.dot(slipped);
    work_ += work;
    turned_over_ += std::abs(work);
    const double stored = law_.stored_energy(load_, state_);
    turned_over_ += std::abs(stored - stored_);
    lost_in_step_ = work - (stored - stored_);
    stored_ = stored;
    least_lost_ = std::min(least_lost_, lost_in_step_);
  }
  /// Time passes, nothing moves.
  void creep(double time) requires CreepingLaw<Law, Dim> {
    law_.creep(load_, state_, time);
    const double stored = law_.stored_energy(load_, state_);
    turned_over_ += std::abs(stored - stored_);
    least_lost_ = std::min(least_lost_, stored_ - stored);
    stored_ = stored;
  }
  [[nodiscard]] double work() const { return work_; }
  [[nodiscard]] double stored() const { return stored_; }
  [[nodiscard]] double least_lost() const { return least_lost_; }
  [[nodiscard]] double turned_over() const { return turned_over_; }

 private:
  const Law& law_;
  PointLoad<Dim> load_;
  typename Law::template State<Dim> state_{};
  double work_ = 0, stored_ = 0, turned_over_ = 0, lost_in_step_ = 0, least_lost_ = 0;
};

template <int Dim>
Vec<Dim - 1> drawn(Random& random, double size) {
  Vec<Dim - 1> v;
  for (int k = 0; k + 1 < Dim; ++k) v[k] = size * (2 * random.uniform() - 1);
  return v;
}

/// 500 random paths of 60 steps, from random in-situ forces that the law must bear, of steps from a
/// hundredth of a closure to many times it, opening and closing on the way.
template <class Law, int Dim>
void check_random_paths(const Law& law, double closure, double friction) {
  Random random(77, Dim);
  for (int n = 0; n < 500; ++n) {
    CAPTURE(n);
    const double weight = 0.1 + random.uniform(),
                 size = closure * std::pow(10, -2 + 3 * random.uniform());
    const double normal = 1e6 * weight * random.uniform();
    Path<Law, Dim> path(law, weight, normal, drawn<Dim>(random, friction * normal));
    double opening = 0;
    Vec<Dim - 1> slip = zeros<Vec<Dim - 1>>();
    for (int k = 0; k < 60; ++k) {
      opening = 0.9 * opening + size * (2 * random.uniform() - 1);
      slip = Vec<Dim - 1>(0.9 * slip + drawn<Dim>(random, size));
      path.move_to(opening, slip);
      if constexpr (CreepingLaw<Law, Dim>) path.creep(0.2 * law.creep_time());  // as a solver does
    }
    // Rounding of a stored energy is 1e-16 of it.
    REQUIRE(path.least_lost() >= -1e-9 * path.turned_over());
  }
}

template <class Law>
void check_in_both(const Law& law, double closure, double friction = 0.3) {
  check_random_paths<Law, 2>(law, closure, friction);
  check_random_paths<Law, 3>(law, closure, friction);
}

constexpr BartonBandisJoint::Params rough_joint{.roughness = 10,
                                                .wall_strength = 100e6,
                                                .residual_friction_angle = 28 * degree,
                                                .initial_stiffness = 20e9,
                                                .maximum_closure = 2e-4};
const BartonBandisJoint rough(rough_joint);

}  // namespace

TEST_SUITE("contact/dissipation") {
  TEST_CASE("no law makes energy on random paths") {
    check_in_both(CoulombJoint({5e9, 1e9, 35 * degree}), 2e-4);
    check_in_both(CoulombJoint({5e9, 1e9, 0}), 2e-4);
    check_in_both(SmoothWall(5e9), 2e-4);
    check_in_both(rough, 2e-4);
    // The foot of a lining, that gives way within the pressures of the paths; none starts beyond.
    for (const double strength : {1e6, 2e6})
      check_in_both(
          FootBearing(
              {.width = 1, .stiffness = 5e9, .strength = strength, .friction_angle = 30 * degree}),
          2e-4);
    check_in_both(BurgersJoint({.joint_normal_stiffness = 5e9,
                                .joint_shear_stiffness = 5e8,
                                .friction_angle = 35 * degree,
                                .maxwell_viscosity = 1e15,
                                .kelvin_stiffness = 5e8,
                                .kelvin_viscosity = 1e14}),
                  2e-4);
    check_in_both(MohrCoulombJoint({5e9, 1e9, 35 * degree, 5e5, 2e5}), 2e-4);
    check_in_both(MohrCoulombJoint({.joint_normal_stiffness = 5e9,
                                    .joint_shear_stiffness = 1e9,
                                    .friction_angle = 40 * degree,
                                    .cohesion = 3e5,
                                    .tensile_strength = 1e5,
                                    .dilation_angle = 12 * degree,
                                    .dilation_limit = 5e-3,
                                    .residual_friction_angle = 25 * degree,
                                    .residual_cohesion = 5e4}),
                  2e-4);
    check_in_both(MohrCoulombJoint({.joint_normal_stiffness = 5e9,
                                    .joint_shear_stiffness = 5e8,
                                    .friction_angle = 30 * degree,
                                    .dilation_angle = 30 * degree,
                                    .dilation_limit = 1}),
                  2e-4);
  }

  TEST_CASE("a rough joint makes no energy as it lifts, wears and stiffens") {
    // Steps of 2 um to 2 mm and 0.05 to 50 mm; the peak is at 0.5 to 1.2 mm. Steep teeth on hardly
    // any friction: there the lift takes all that the friction gives.
    for (const double roughness : {0.0, 3.0, 20.0})
      for (const double friction : {3.0, 28.0})
        for (const double damage : {1.0, 2.0, std::numeric_limits<double>::infinity()}) {
          CAPTURE(roughness);
          CAPTURE(friction);
          CAPTURE(damage);
          auto joint = rough_joint;
          joint.roughness = roughness;
          joint.residual_friction_angle = friction * degree;
          joint.damage_coefficient = damage;
          for (const double size : {2e-4, 5e-3})
            check_in_both(BartonBandisJoint(joint), size,
                          0.6 * std::tan(joint.residual_friction_angle));
        }
  }

  TEST_CASE("a rough joint sheared, pressed, sheared back and let go gives nothing") {
    // In fine steps, of which the work of the end force is off by their length.
    constexpr int steps = 20000;
    const double slip = 0.2 * rough.peak_slip(), press = rough.closure(5e6) - rough.closure(5e5);
    Path<BartonBandisJoint, 2> path(rough, 1, 5e5, Vec<1>(0.0));
    const double before = path.stored();
    const auto go = [&](double from_opening, double from_slip, double to_opening, double to_slip) {
      for (int k = 1; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        path.move_to(from_opening + t * (to_opening - from_opening),
                     Vec<1>(from_slip + t * (to_slip - from_slip)));
      }
    };
    go(0, 0, 0, slip);
    const double sheared = path.stored() - before, work = path.work();
    CHECK(work == voussoir_test::near(sheared).epsilon(1e-3));  // it has not slipped
    CHECK(sheared > 15);
    go(0, slip, -press, slip);
    // Pressed it is stiffer, and holds less with the same shear.
    const double pressed =
        rough.stored_energy<2>({1, {5e5, Vec<1>(0.0)}, {-press, Vec<1>(0.0)}}, {});
    CHECK(path.stored() - pressed < 0.5 * sheared);
    go(-press, slip, -press, 0);
    go(-press, 0, 0, 0);
    // With a stiffness that follows the stress it was 271 J/m2 gained where 109 were stored.
    CHECK(path.work() >= path.stored() - before);
    CHECK(path.work() > 0);
  }

  TEST_CASE("a dilation that would make energy, or never end, is refused") {
    MohrCoulombJoint::Params params{.joint_normal_stiffness = 5e9,
                                    .joint_shear_stiffness = 1e9,
                                    .friction_angle = 40 * degree,
                                    .dilation_angle = 30 * degree,
                                    .dilation_limit = 5e-3,
                                    .residual_friction_angle = 25 * degree};
    CHECK_THROWS_WITH_AS(MohrCoulombJoint{params}, doctest::Contains("makes energy"), InvalidInput);
    params.residual_friction_angle = 35 * degree;
    CHECK_NOTHROW(MohrCoulombJoint{params});
    for (const double limit : {0.0, 1e9}) {
      params.dilation_limit = limit;
      CHECK_THROWS_WITH_AS(MohrCoulombJoint{params}, doctest::Contains("dilation_limit"),
                           InvalidInput);
    }
  }
}

}  // namespace dissipation_test
