// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>

namespace coulomb_joint_test {

using namespace voussoir;

namespace {

constexpr double kn = 5e9, ks = 5e8, degree = std::numbers::pi / 180, phi = 35 * degree;
constexpr double eps = std::numeric_limits<double>::epsilon();

template <int Dim>
using Dimension = std::integral_constant<int, Dim>;

/// A law that sticks and slides at the values above.
CoulombJoint joint() {
  return CoulombJoint(
      {.joint_normal_stiffness = kn, .joint_shear_stiffness = ks, .friction_angle = phi});
}

/// A slip of this length; in 3-D along a direction that is none of the tangents.
template <int Dim>
Vec<Dim - 1> slip(double length) {
  if constexpr (Dim == 2) {
    return Vec<1>(length);
  } else {
    return length * Vec<2>(0.6, -0.8);
  }
}

/// A point of 0.4 m (m^2) that carries `normal` [N] and no shear before it moves.
template <int Dim>
PointLoad<Dim> point(double normal, double opening, double slip_length) {
  PointLoad<Dim> load{0.4, {}, {opening, slip<Dim>(slip_length)}};
  load.initial.normal = normal;
  return load;
}

/// What the constructor says of these parameters; empty if it takes them.
std::string refusal(const CoulombJoint::Params& params) {
  try {
    (void)CoulombJoint(params);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_SUITE("contact/coulomb_joint") {
  TEST_CASE_TEMPLATE("a sticking point is two springs of slope w k_n and w k_s", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    const CoulombJoint law = joint();
    const CoulombJoint::State<dim> fresh;
    PointLoad<dim> load = point<dim>(1e5, -2e-5, 1e-5);
    load.initial.tangential = slip<dim>(3e3);
    const PointForce<dim> f = law.force(load, fresh);
    // N = N0 - w k_n g = 1e5 + 0.4 * 5e9 * 2e-5 = 1.4e5 N;  T = T0 - w k_s s = 3e3 - 2e3 = 1e3 N,
    // far below N tan(35 deg) = 98e3 N. A few roundings of the largest term each.
    CHECK(std::abs(f.normal - 1.4e5) <= 4 * eps * 1.4e5);
    CHECK((f.tangential - slip<dim>(1e3)).norm() <= 8 * eps * 3e3);
  }

  TEST_CASE_TEMPLATE("a fresh point that has not moved carries its in-situ force", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    PointLoad<dim> load = point<dim>(1e5, 0, 0);
    load.initial.tangential = slip<dim>(-6e4);  // below 1e5 tan(35 deg) = 7e4
    const PointForce<dim> f = joint().force(load, CoulombJoint::State<dim>{});
    CHECK(f.normal == load.initial.normal);
    CHECK(f.tangential == load.initial.tangential);
  }

  TEST_CASE_TEMPLATE("shear is shortened to N tan(phi), against the slip", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    for (const double opening : {-1e-5, 0.0, 1e-5}) {
      const PointForce<dim> f =
          joint().force(point<dim>(1e5, opening, 5e-3), CoulombJoint::State<dim>{});
      const double limit = (1e5 - 0.4 * kn * opening) * std::tan(phi);  // N depends on the opening
      CHECK((f.tangential + slip<dim>(limit)).norm() <= 8 * eps * limit);
    }
  }

  TEST_CASE_TEMPLATE("an open joint carries nothing, however far it slips", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    const CoulombJoint law = joint();
    const double opens = 1e5 / (0.4 * kn);  // where N0 - w k_n g = 0
    const CoulombJoint::State<dim> fresh;
    CHECK(law.force(point<dim>(1e5, 0.999 * opens, 0), fresh).normal > 0);
    const PointForce<dim> f = law.force(point<dim>(1e5, 1.001 * opens, 5e-3), fresh);
    CHECK(f.normal == 0);
    CHECK(f.tangential == Vec<dim - 1>::Zero());
  }

  TEST_CASE_TEMPLATE("committing does not change the force at the same motion", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    const CoulombJoint law = joint();
    const double sticks = 1e-5, slides = 5e-3, opens = 1e-4;
    for (const auto& load :
         {point<dim>(1e5, 0, sticks), point<dim>(1e5, 0, slides), point<dim>(1e5, opens, slides)}) {
      CoulombJoint::State<dim> state;
      const PointForce<dim> before = law.force(load, state);
      law.commit(load, state);
      const PointForce<dim> after = law.force(load, state);
      CHECK(after.normal == before.normal);
      // q = s + T/(w k_s) is rounded to the size of s, so T comes back within w k_s s eps.
      CHECK((after.tangential - before.tangential).norm() <= 4 * eps * 0.4 * ks * slides);
    }
  }

  TEST_CASE_TEMPLATE("committing a point that sticks leaves its state bit for bit", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    CoulombJoint::State<dim> state{slip<dim>(0.1 + 0.2)};
    const Vec<dim - 1> before = state.plastic_slip;
    joint().commit(point<dim>(1e5, 0, 0.3), state);
    CHECK(state.plastic_slip == before);
  }

  TEST_CASE_TEMPLATE("unloading returns along k_s and leaves a permanent slip", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    const CoulombJoint law = joint();
    CoulombJoint::State<dim> state;
    const double normal = 1e5, limit = normal * std::tan(phi), far = 5e-3;
    law.commit(point<dim>(normal, 0, far), state);
    // The spring is stretched by limit / (w k_s) when the point has slid to `far`.
    const double permanent = far - limit / (0.4 * ks), rounding = 8 * eps * 0.4 * ks * far;
    CHECK((state.plastic_slip - slip<dim>(permanent)).norm() <= 8 * eps * far);
    CHECK(law.force(point<dim>(normal, 0, permanent), state).tangential.norm() <= rounding);
    const double on_the_way = 0.3 * permanent + 0.7 * far;
    const Vec<dim - 1> t = law.force(point<dim>(normal, 0, on_the_way), state).tangential;
    CHECK((t + slip<dim>(0.7 * limit)).norm() <= rounding);
    // Pushed back further than the spring reaches, it slides the other way.
    const Vec<dim - 1> back = law.force(point<dim>(normal, 0, -far), state).tangential;
    CHECK((back - slip<dim>(limit)).norm() <= rounding);
  }

  TEST_CASE_TEMPLATE("a slip cycle dissipates 4 T (A - T / (w k_s))", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    const CoulombJoint law = joint();
    const double normal = 1e5, limit = normal * std::tan(phi), stretch = limit / (0.4 * ks);
    const double amplitude = 4 * stretch;
    CoulombJoint::State<dim> state;
    law.commit(point<dim>(normal, 0, -amplitude), state);  // start on the loop, sliding backwards
    // Steps of a quarter of the elastic stretch: the corners of the loop (2 stretches after each
    // turn) are then ends of steps, and the trapezoidal rule is exact.
    const int half = 32;  // 2 amplitude / (stretch / 4)
    double work = 0;
    double at = -amplitude, force = law.force(point<dim>(normal, 0, at), state).tangential.norm();
    for (int k = 1; k <= 2 * half; ++k) {
      const double next = -amplitude + 0.25 * stretch * (k <= half ? k : 2 * half - k);
      const PointLoad<dim> load = point<dim>(normal, 0, next);
      law.commit(load, state);
      const double now = law.force(load, state).tangential.dot(slip<dim>(1.0));
      work += 0.5 * (force + now) * (next - at);  // done on the rock; the joint takes it
      force = now;
      at = next;
    }
    const double exact = -4 * limit * (amplitude - stretch);
    CHECK(std::abs(work - exact) <= 1e-12 * std::abs(exact));  // 64 roundings
  }

  TEST_CASE_TEMPLATE("thousand readings and commits at one motion do not let the force drift", D,
                     Dimension<2>, Dimension<3>) {
    constexpr int dim = D::value;
    const CoulombJoint law = joint();
    const PointLoad<dim> load = point<dim>(1e5, 1e-6, 1.2345e-3);
    CoulombJoint::State<dim> state;
    law.commit(load, state);
    const PointForce<dim> first = law.force(load, state);
    for (int k = 0; k < 1000; ++k) law.commit(load, state);
    const PointForce<dim> last = law.force(load, state);
    CHECK(last.normal == first.normal);
    // One rounding of q, not a thousand: commit rewrites q from the force, it does not add to it.
    CHECK((last.tangential - first.tangential).norm() <= 4 * eps * 0.4 * ks * 1.2345e-3);
  }

  TEST_CASE("in 3-D the strength is the same in every direction") {
    const CoulombJoint law = joint();
    PointLoad<3> load{0.4, {}, {0, Vec<2>::Zero()}};
    load.initial.normal = 1e5;
    const double limit = 1e5 * std::tan(phi);
    for (int k = 0; k < 12; ++k) {
      const Vec<2> along(std::cos(0.5 * k), std::sin(0.5 * k));
      load.motion.slip = 1e-2 * along;
      const Vec<2> t = law.force(load, CoulombJoint::State<3>{}).tangential;
      CHECK((t + limit * along).norm() <= 8 * eps * limit);
    }
  }

  TEST_CASE("without friction a joint carries no shear, not even its initial one") {
    const CoulombJoint smooth({kn, ks, 0});
    PointLoad<2> load = point<2>(1e5, 0, 1e-6);
    load.initial.tangential[0] = 1e3;
    CHECK(smooth.force(load, CoulombJoint::State<2>{}).tangential[0] == 0);
  }

  TEST_CASE("the friction coefficient is the tangent of the angle") {
    CHECK(std::abs(joint().friction_coefficient() - 0.70020753820971) <= 1e-14);  // tan 35 deg
  }

  TEST_CASE("parameters out of range are refused with their name and value") {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();
    CHECK(refusal({kn, ks, phi}).empty());
    CHECK(refusal({kn, ks, 0}).empty());
    for (const double bad : {nan, infinite, 0.0, -1.0}) {
      CHECK(refusal({bad, ks, phi})
                .starts_with("joint_normal_stiffness = " + message_number(bad) + ": must be"));
      CHECK(refusal({kn, bad, phi})
                .starts_with("joint_shear_stiffness = " + message_number(bad) + ": must be"));
    }
    for (const double bad : {nan, infinite, -1e-9, 90 * degree, 2.0, 35.0})
      CHECK(
          refusal({kn, ks, bad}).starts_with("friction_angle = " + message_number(bad) + " rad ("));
  }

  TEST_CASE("GPa/m given for Pa/m and degrees for radians are refused with what was meant") {
    CHECK(
        refusal({5, 0.5, 0.6}) ==
        "joint_normal_stiffness = 5 Pa/m: must be >= 1000 Pa/m; did you mean 5 GPa/m = 5e9 Pa/m?");
    CHECK(refusal({5e9, 0.5, 0.6}) ==
          "joint_shear_stiffness = 0.5 Pa/m: must be >= 1000 Pa/m; did you mean 0.5 GPa/m = 5e8 "
          "Pa/m?");
    CHECK(refusal({5e9, 5e8, 35}) ==
          "friction_angle = 35 rad (2005.35 deg): must be >= 0 and < pi/2 rad; did you mean 35 deg "
          "= 0.610865 rad?");
    CHECK(refusal({5e9, 5e8, -0.1}) ==
          "friction_angle = -0.1 rad (-5.72958 deg): must be >= 0 and < pi/2 rad");
    CHECK(refusal({1000, 1000, 0.6}).empty());
    CHECK_THROWS_AS(CoulombJoint({999, 1000, 0.6}), InvalidInput);
    // Without units anything positive goes, and nothing else.
    CHECK(CoulombJoint({5, 0.5, 0.6}, any_units).joint_normal_stiffness() == 5);
    CHECK_THROWS_AS(CoulombJoint({0, 1, 0}, any_units), InvalidInput);
    CHECK_THROWS_AS(CoulombJoint({1, 1, 35}, any_units), InvalidInput);
  }
}

}  // namespace coulomb_joint_test
