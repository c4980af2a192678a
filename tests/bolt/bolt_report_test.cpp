// SPDX-License-Identifier: MIT
// What bolt laws say of a bolt: the same whether the law says it or its force tells.
#include <doctest/doctest.h>

#include <cmath>
#include <type_traits>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/axial_shear_bolt.hpp>

#include "support/near.hpp"

namespace bolt_report_test {

using namespace voussoir;

namespace {

constexpr double stiffness = 2e8, yield = 1e5, rupture = 1.2e5;
template <int Dim>
using Dimension = std::integral_constant<int, Dim>;

template <int Dim>
BoltSpan<Dim> pulled(double along, double across) {
  BoltSpan<Dim> span{0.5 * Vec<Dim>::UnitX(), Vec<Dim>::UnitX(), along * Vec<Dim>::UnitX()};
  span.motion[Dim - 1] = across;
  span.jump = span.motion;
  return span;
}

}  // namespace

TEST_SUITE("bolt/bolt_report") {
  TEST_CASE_TEMPLATE("a bolt is pulled to yield, let go and broken", D, Dimension<2>,
                     Dimension<3>) {
    constexpr int dim = D::value;
    const AxialShearBolt law(
        {.axial = {.axial_stiffness = stiffness, .yield_force = yield, .rupture_force = rupture},
         .shear_stiffness = 1e7});
    AxialShearBolt::State state;
    const auto at = [&](double along, double across) {
      const auto span = pulled<dim>(along, across);
      const bool breaks = law.commit(span, state);
      const BoltReport report = report_of(law, span, state, false);
      // What the force tells by itself must agree with what the law says.
      const BoltReport told = report_from_force(law, span, state);
      CHECK(told.axial == report.axial);
      CHECK(told.shear == report.shear);
      CHECK(told.is_yielding == report.is_yielding);
      CHECK(report.axial == law.force(span, state).axial);
      CHECK(report.is_broken == breaks);
      return report;
    };
    const double at_yield = yield / stiffness;
    const BoltReport elastic = at(0.5 * at_yield, 1e-3);
    CHECK(!elastic.has_yielded());
    CHECK(elastic.shear == voussoir_test::near(1e7 * 1e-3));
    const BoltReport yielding = at(4 * at_yield, 0);
    CHECK(yielding.is_yielding);
    CHECK(yielding.plastic_extension > 2.5 * at_yield);
    // Back by what is elastic it carries nothing: the rest stays, as reported.
    const BoltReport let_go = at(yielding.plastic_extension, 0);
    CHECK(let_go.axial <= 1e-9 * yield);
    CHECK(let_go.plastic_extension == yielding.plastic_extension);
    CHECK(!let_go.is_yielding);
    CHECK(let_go.has_yielded());
    const BoltReport broken = at(40 * at_yield, 1e-3);
    CHECK(broken.is_broken);
    CHECK(!broken.is_yielding);
    CHECK(broken.axial == 0);
    CHECK(broken.shear == 0);
  }

  TEST_CASE("that it broke is known to whoever holds it, too") {
    const AxialBolt law({.axial_stiffness = stiffness});
    const BoltReport report = report_of(law, pulled<2>(1e-3, 0), AxialBolt::State{}, true);
    CHECK(report.is_broken);
    CHECK(!report_of(law, pulled<2>(1e-3, 0), AxialBolt::State{}, false).is_broken);
  }

  TEST_CASE("the extension is that of the line between the anchors, or of the joint") {
    CHECK(extension_of(pulled<2>(3e-4, 0)) == voussoir_test::near(3e-4).epsilon(1e-10));
    // Across: s^2 / 2 d.
    CHECK(extension_of(pulled<2>(0, 1e-2)) == voussoir_test::near(1e-4).epsilon(1e-3));
    BoltSpan<3> on_joint{Vec3::Zero(), Vec3::UnitX(), Vec3(2e-4, 1, 0)};
    CHECK(extension_of(on_joint) == 2e-4);
  }
}

}  // namespace bolt_report_test
