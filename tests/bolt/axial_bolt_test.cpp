// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <voussoir/bolt/axial_bolt.hpp>

#include "support/dense_algebra.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace axial_bolt_test {

using namespace voussoir;
using voussoir_test::reference;

namespace {

constexpr double stiffness = 0.2e9, degree = std::numbers::pi / 180;
constexpr double infinity = std::numeric_limits<double>::infinity();

template <int Dim>
using Dimension = std::integral_constant<int, Dim>;

/// Anchors `distance` apart on a bar at `angle` to the normal of a joint along x; the joint opens
/// along y and shears along x [m].
BoltSpan<2> across_joint(double distance, double angle, double shear, double opening) {
  const Vec2 axis(std::sin(angle), std::cos(angle));
  return {distance * axis, axis, {shear, opening}};
}

/// Anchors 0.5 m apart along the first axis, pulled apart by `extension`.
template <int Dim>
BoltSpan<Dim> pulled(double extension) {
  return {0.5 * Vec<Dim>::UnitX(), Vec<Dim>::UnitX(), extension * Vec<Dim>::UnitX()};
}

/// d(pull)/d(motion) by central differences.
template <int Dim, class Law>
Stress<Dim> tangent(const Law& law, BoltSpan<Dim> span, double step) {
  Stress<Dim> k;
  const Vec<Dim> at = span.motion;
  for (int j = 0; j < Dim; ++j) {
    span.motion = at + step * Vec<Dim>::Unit(j);
    const Vec<Dim> ahead = law.force(span, {}).pull;
    span.motion = at - step * Vec<Dim>::Unit(j);
    k.col(j) = (ahead - law.force(span, {}).pull) / (2 * step);
  }
  return k;
}

}  // namespace

TEST_SUITE("bolt/axial_bolt") {
  TEST_CASE("a bolt across a sheared joint pulls as the lengths of its anchors say") {
    const AxialBolt bolt({.axial_stiffness = stiffness});
    struct Place {
      const char* name;
      double distance;
    };
    for (const Place& place : {Place{"near", 0.0672}, Place{"mid", 0.77}, Place{"at", 0.0}})
      for (const int angle : {0, 30})
        for (const char* shear : {"0.001", "0.01"}) {
          const std::string row =
              std::string("F.bolt.") + place.name + ".th" + std::to_string(angle) + ".s" + shear;
          CAPTURE(row);
          const BoltForce<2> f =
              bolt.force(across_joint(place.distance, angle * degree, std::stod(shear), 0), {});
          const double force = reference(row + ".F");
          // The table has its components from a difference of lengths: an ulp of 0.77 m (1e-16 m)
          // over the smallest extension, 6.5e-7 m, is 1.7e-10.
          const double tolerance = 1.7e-10 * force;
          CHECK(std::abs(f.axial - force) <= tolerance);
          CHECK(std::abs(f.pull.x() - reference(row + ".Fs")) <= tolerance);
          CHECK(std::abs(f.pull.y() - reference(row + ".Fn")) <= tolerance);
        }
  }

  TEST_CASE("shear at which a bolt near the joint reaches 500 kN") {
    const AxialBolt bolt({.axial_stiffness = stiffness, .rupture_force = 500e3});
    const double shear = reference("F.bolt.near.yield_shear");
    for (const double part : {1 - 1e-9, 1 + 1e-9}) {
      AxialBolt::State state;
      CHECK(bolt.commit(across_joint(0.0672, 0, part * shear, 0), state) == (part > 1));
    }
  }

  TEST_CASE("opening at which a bolt reaches 500 kN, with and without pretension") {
    const double plain = reference("F.pull.yield_open"), tight = reference("F.pull.pretension150");
    const AxialBolt bolt({.axial_stiffness = stiffness, .rupture_force = 500e3});
    const AxialBolt tensioned(
        {.axial_stiffness = stiffness, .pretension = 150e3, .rupture_force = 500e3});
    for (const double part : {1 - 1e-9, 1 + 1e-9}) {
      AxialBolt::State a, b;
      CHECK(bolt.commit(across_joint(0.0672, 0, 0, part * plain), a) == (part > 1));
      CHECK(tensioned.commit(across_joint(0.0672, 0, 0, part * tight), b) == (part > 1));
    }
  }

  TEST_CASE("pretension acts along the bar before anything moves") {
    const AxialBolt bolt({.axial_stiffness = stiffness, .pretension = 150e3});
    const BoltForce<2> f = bolt.force(across_joint(0.0672, 30 * degree, 0, 0), {});
    CHECK(f.axial == 150e3);
    CHECK((f.pull - 150e3 * Vec2(0.5, std::sqrt(0.75))).norm() <= 1e-15 * 4 * 150e3);
  }

  TEST_CASE_TEMPLATE("a bolt is slack in compression unless asked to carry it", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    const AxialBolt cable({.axial_stiffness = stiffness});
    CHECK(cable.force(pulled<dim>(-1e-3), {}).axial == 0);
    CHECK(cable.force(pulled<dim>(-1e-3), {}).pull == Vec<dim>::Zero());
    const AxialBolt strut({.axial_stiffness = stiffness, .carries_compression = true});
    const BoltForce<dim> f = strut.force(pulled<dim>(-1e-3), {});
    CHECK(std::abs(f.axial + 2e5) <= 1e-12 * 2e5);  // K_a * 1 mm
    CHECK((f.pull + 2e5 * Vec<dim>::UnitX()).norm() <= 1e-12 * 2e5);
  }

  TEST_CASE_TEMPLATE("beyond yield the slope is the hardening ratio times K_a", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    const double ratio = 0.05, yield = 300e3, first = yield / stiffness;  // 1.5 mm
    const AxialBolt bolt(
        {.axial_stiffness = stiffness, .yield_force = yield, .hardening_ratio = ratio});
    AxialBolt::State state;
    CHECK(!bolt.commit(pulled<dim>(0.999 * first), state));
    CHECK(state.plastic_extension == 0);
    for (const double extension : {2.0 * first, 3.0 * first, 5.0 * first}) {
      const double force = yield + ratio * stiffness * (extension - first);
      CHECK(std::abs(bolt.force(pulled<dim>(extension), state).axial - force) <= 1e-12 * force);
      CHECK(!bolt.commit(pulled<dim>(extension), state));
      // Reading again after the commit, and from the grown yield force on: the same line.
      CHECK(std::abs(bolt.force(pulled<dim>(extension), state).axial - force) <= 1e-12 * force);
    }
  }

  TEST_CASE("a yielded bolt unloads along K_a, is slack early and yields again where it left") {
    const double ratio = 0.05, yield = 300e3, first = yield / stiffness, far = 5 * first;
    const AxialBolt bolt(
        {.axial_stiffness = stiffness, .yield_force = yield, .hardening_ratio = ratio});
    AxialBolt::State state;
    (void)bolt.commit(pulled<2>(far), state);
    const double top = yield + ratio * stiffness * (far - first);
    const double back = 1e-3;  // of extension: 200 kN less
    CHECK(std::abs(bolt.force(pulled<2>(far - back), state).axial - (top - 2e5)) <= 1e-12 * top);
    const double slack = far - top / stiffness;
    CHECK(std::abs(state.plastic_extension - slack) <= 1e-12 * far);
    CHECK(bolt.force(pulled<2>(0.99 * slack), state).axial == 0);
    (void)bolt.commit(pulled<2>(0.5 * slack),
                      state);  // slackness does not change what is remembered
    CHECK(std::abs(bolt.force(pulled<2>(far), state).axial - top) <= 1e-12 * top);
    const double further = far + back;
    CHECK(std::abs(bolt.force(pulled<2>(further), state).axial - (top + ratio * 2e5)) <=
          1e-12 * top);
  }

  TEST_CASE("without hardening the force stays at the yield force") {
    const AxialBolt bolt(
        {.axial_stiffness = stiffness, .yield_force = 300e3, .hardening_ratio = 0});
    CHECK(std::abs(bolt.force(pulled<2>(0.1), {}).axial - 300e3) <= 1e-9 * 300e3);  // 20 MN trial
  }

  TEST_CASE("a brittle bolt breaks at its rupture force, reports it once, and is gone") {
    const AxialBolt bolt(
        {.axial_stiffness = stiffness, .yield_force = 500e3, .rupture_force = 200e3});
    AxialBolt::State state;
    CHECK(!bolt.commit(pulled<2>(0.99e-3), state));            // 198 kN
    CHECK(bolt.force(pulled<2>(2e-3), state).axial == 200e3);  // read before the break is committed
    CHECK(!state.ruptured);
    CHECK(bolt.commit(pulled<2>(2e-3), state));
    CHECK(state.ruptured);
    CHECK(bolt.force(pulled<2>(0.5e-3), state).axial == 0);
    CHECK(bolt.force(pulled<2>(0.5e-3), state).pull == Vec2::Zero());
    CHECK(!bolt.commit(pulled<2>(3e-3), state));
  }

  TEST_CASE("a ductile bolt breaks after yield, at the extension its hardening leads to") {
    const double ratio = 0.1, yield = 300e3, rupture = 330e3;
    const AxialBolt bolt({.axial_stiffness = stiffness,
                          .yield_force = yield,
                          .rupture_force = rupture,
                          .hardening_ratio = ratio});
    // 1.5 mm to yield, then 30 kN at a tenth of 0.2 GN/m: 1.5 mm more.
    const double breaks = yield / stiffness + (rupture - yield) / (ratio * stiffness);
    CHECK(std::abs(breaks - 3e-3) <= 1e-15);
    AxialBolt::State state;
    CHECK(!bolt.commit(pulled<2>(breaks - 1e-9), state));
    CHECK(!bolt.commit(pulled<2>(0), state));
    CHECK(bolt.commit(pulled<2>(breaks + 1e-9), state));
  }

  TEST_CASE("reading the force changes nothing") {
    const AxialBolt bolt({.axial_stiffness = stiffness, .yield_force = 1e5, .rupture_force = 2e5});
    const AxialBolt::State state;
    const double first = bolt.force(pulled<2>(0.8e-3), state).axial;
    (void)bolt.force(pulled<2>(1.0), state);
    CHECK(bolt.force(pulled<2>(0.8e-3), state).axial == first);
    CHECK(state.plastic_extension == 0);
  }

  TEST_CASE_TEMPLATE("the stiffness is the derivative of the force at the initial span", D,
                     Dimension<2>, Dimension<3>) {
    constexpr int dim = D::value;
    const AxialBolt bolt({.axial_stiffness = stiffness, .carries_compression = true});
    Vec<dim> axis = Vec<dim>::LinSpaced(1, 2).normalized();
    const BoltSpan<dim> span{0.0672 * axis, axis, Vec<dim>::Zero()};
    // Across the bar the force is K_a s^3 / (2 d^2): 1e-10 of K_a s at s = 1e-6 m.
    const Stress<dim> k = bolt.stiffness(span).pull;
    CHECK((tangent<dim>(bolt, span, 1e-6) - k).norm() <= 2e-10 * stiffness);
    CHECK((k - k.transpose()).norm() <= 1e-15 * stiffness);
  }

  TEST_CASE("the stiffness bounds the tangent at the initial span, pretension included") {
    // A taut bolt also resists being moved sideways, by T0 / d; the time steps rest on this bound.
    const AxialBolt bolt(
        {.axial_stiffness = stiffness, .pretension = 150e3, .carries_compression = true});
    const BoltSpan<2> span = across_joint(0.0672, 30 * degree, 0, 0);
    const Stress<2> excess = tangent<2>(bolt, span, 1e-6) - bolt.stiffness(span).pull;
    const Eigen::VectorXd modes = voussoir_test::eigenvalues(0.5 * (excess + excess.transpose()));
    // Differences of 1e-6 m leave 1e-9 of K_a (rounding of 150 kN over 1e-6 m, curvature).
    CHECK(modes.maxCoeff() <= 1e-8 * stiffness);
  }

  TEST_CASE(
      "anchors on the joint pull along the way they part, with K_a in every direction that opens") {
    const AxialBolt bolt({.axial_stiffness = stiffness});
    const Vec2 away(3e-3, 4e-3);
    const BoltForce<2> f = bolt.force<2>({Vec2::Zero(), Vec2::UnitY(), away}, {});
    CHECK((f.pull - stiffness * away).norm() <= 1e-15 * 4 * stiffness * away.norm());
    CHECK(bolt.stiffness<2>({Vec2::Zero(), Vec2::UnitY(), Vec2::Zero()}).pull ==
          Stress<2>(stiffness * Stress<2>::Identity()));
    CHECK(bolt.force<2>({Vec2::Zero(), Vec2::UnitY(), Vec2::Zero()}, {}).pull == Vec2::Zero());
  }

  TEST_CASE("closing a joint slackens a bolt that grips on it, opening or shearing it pulls") {
    const AxialBolt cable({.axial_stiffness = stiffness});
    const auto pull = [](const AxialBolt& bolt, const Vec2& motion) {
      return bolt.force<2>({Vec2::Zero(), Vec2::UnitY(), motion}, {}).pull;
    };
    CHECK(pull(cable, {0, -1e-3}) == Vec2::Zero());
    // Closed and sheared: the shear alone stretches it. Continuous where closing turns to opening.
    CHECK((pull(cable, {2e-3, -1e-3}) - Vec2(stiffness * 2e-3, 0)).norm() <= 1e-9);
    CHECK((pull(cable, {2e-3, -1e-12}) - pull(cable, {2e-3, 1e-12})).norm() <= stiffness * 2e-12);
    const AxialBolt strut({.axial_stiffness = stiffness, .carries_compression = true});
    CHECK((pull(strut, {2e-3, -1e-3}) - stiffness * Vec2(2e-3, -1e-3)).norm() <= 1e-9);
    // In compression a strut knows no yield: 1 mm is 2e5 N, beyond the yield force.
    const AxialBolt limited({.axial_stiffness = stiffness,
                             .yield_force = 1e5,
                             .rupture_force = 1.5e5,
                             .carries_compression = true});
    const BoltSpan<2> closed{Vec2::Zero(), Vec2::UnitY(), {0, -1e-3}};
    AxialBolt::State state;
    CHECK(limited.force(closed, state).axial == voussoir_test::near(-stiffness * 1e-3));
    CHECK_FALSE(limited.commit(closed, state));
    CHECK(state.plastic_extension == 0);
  }

  TEST_CASE(
      "a pretension between anchors on the joint acts along the bar, from the first motion on") {
    const double tension = 5e4;
    const AxialBolt bolt({.axial_stiffness = stiffness, .pretension = tension});
    const auto pull = [&](const Vec2& motion) {
      return bolt.force<2>({Vec2::Zero(), Vec2::UnitY(), motion}, {}).pull;
    };
    CHECK((pull({0, 0}) - Vec2(0, tension)).norm() <= 1e-15 * 4 * tension);
    for (const Vec2& way : {Vec2(1e-9, 0), Vec2(-1e-9, 0), Vec2(0, -1e-9)})
      CHECK((pull(way) - Vec2(0, tension) - stiffness * way).norm() <= 1e-15 * 8 * tension);
    // A joint that closes by T0 / K_a takes the tension away, and by more none comes back.
    CHECK(pull({0, -tension / stiffness}).norm() <= 1e-15 * 4 * tension);
    CHECK(pull({0, -2 * tension / stiffness}).norm() <= 1e-15 * 4 * tension);
  }

  TEST_CASE("a bolt that yields, turned with its motion, pulls the turned way") {
    const AxialBolt bolt({.axial_stiffness = stiffness, .pretension = 5e4, .yield_force = 1e5});
    const double angle = 0.7;
    Stress<2> turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const BoltSpan<2> span{{0.03, 0.06}, Vec2(0.03, 0.06).normalized(), {2e-3, 1e-3}};
    const BoltSpan<2> turned{turn * span.initial, turn * span.axis, turn * span.motion};
    const Vec2 pull = bolt.force(span, {}).pull;
    CHECK((bolt.force(turned, {}).pull - turn * pull).norm() <= 1e-12 * pull.norm());
  }

  TEST_CASE("parameters out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_NOTHROW(AxialBolt({.axial_stiffness = stiffness}));
    for (const double bad : {nan, infinity, 0.0, -1.0})
      CHECK_THROWS_AS(AxialBolt({.axial_stiffness = bad}), InvalidInput);
    for (const double bad : {nan, infinity, -1.0})
      CHECK_THROWS_AS(AxialBolt({.axial_stiffness = stiffness, .pretension = bad}), InvalidInput);
    for (const double bad : {nan, 0.0, 150e3}) {  // must exceed the pretension
      CHECK_THROWS_AS(
          AxialBolt({.axial_stiffness = stiffness, .pretension = 150e3, .yield_force = bad}),
          InvalidInput);
      CHECK_THROWS_AS(
          AxialBolt({.axial_stiffness = stiffness, .pretension = 150e3, .rupture_force = bad}),
          InvalidInput);
    }
    for (const double bad : {nan, -0.01, 1.0})
      CHECK_THROWS_AS(AxialBolt({.axial_stiffness = stiffness, .hardening_ratio = bad}),
                      InvalidInput);
    // A perfectly plastic bolt never reaches a rupture force above its yield force.
    CHECK_THROWS_AS(AxialBolt({.axial_stiffness = stiffness,
                               .yield_force = 1e5,
                               .rupture_force = 2e5,
                               .hardening_ratio = 0}),
                    InvalidInput);
  }
}

}  // namespace axial_bolt_test
