// SPDX-License-Identifier: MIT
// Many blocks at the limit of equilibrium: a slope that topples, an arch without tension, a wedge
// in a roof. Closed forms f.3, f.4, f.5.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>

#include "support/blocks.hpp"
#include "support/reference.hpp"

namespace structures_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::rectangle;
using voussoir_test::reference;

namespace {

using Run = Dynamics<2, CoulombJoint>;

/// True if the blocks come to rest: speeds below `still` before any has moved by `far`.
bool comes_to_rest(Run& run, double far, double still) {
  std::vector<Vec2> start;
  for (int b = 0; b < run.body_count(); ++b) start.push_back(run.position(b));
  for (int look = 0; look < 20000; ++look) {
    run.advance_steps(200);
    double moved = 0, speed = 0;
    for (int b = 0; b < run.body_count(); ++b) {
      moved = std::max(moved, (run.position(b) - start[static_cast<std::size_t>(b)]).norm());
      speed = std::max(speed, run.velocity(b).norm());
    }
    if (moved > far) return false;
    if (look > 2 && speed < still) return true;
  }
  FAIL("neither rest nor collapse");
  return false;
}

/// Goodman & Bray (1976): 16 blocks on a base in steps that dips by 30 degrees.
bool slope_stands(double tan_phi) {
  constexpr double dip = 30 * degree, width = 10, step = 1;
  constexpr double heights[] = {4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 34, 28, 22, 16, 10, 4};
  // Stiff joints: the blocks tip by what the springs give.
  Run run(CoulombJoint({1e11, 1e11, std::atan(tan_phi)}), {.local_damping = 0.7});
  // The base is horizontal here and the weight turned: x up the slope.
  for (int k = 0; k < 16; ++k) {
    const double x = width * k, base = step * k, height = heights[k];
    run.add_fixed_block(rectangle({x + 0.5 * width, base - 5}, width, 10));
    const int b = run.add_block(rectangle({x + 0.5 * width, base + 0.5 * height}, width, height),
                                25e3 / 9.81);
    const double weight = 25e3 * width * height;
    // Gravity acts along -y already: what is missing turns it.
    run.add_load(b, weight * Vec2(-std::sin(dip), 1 - std::cos(dip)));
  }
  return comes_to_rest(run, 0.02, 1e-6);  // settlement on the springs: 1e-4 m
}

/// A semicircle of equal voussoirs of mean radius 10 m on two abutments.
bool arch_stands(int voussoirs, double thickness) {
  constexpr double radius = 10;
  const double inner = radius - 0.5 * thickness, outer = radius + 0.5 * thickness;
  const auto at = [](double r, double angle) {
    return Vec2(r * std::cos(angle), r * std::sin(angle));
  };
  Run run(CoulombJoint({2e12, 2e12, 45 * degree}), {.local_damping = 0.7});
  for (const double side : {-1.0, 1.0})
    run.add_fixed_block(rectangle({side * radius, -1}, 3 * thickness, 2));
  const double share = std::numbers::pi / voussoirs;
  for (int k = 0; k < voussoirs; ++k)
    run.add_block(ConvexPolygon({at(inner, k * share), at(outer, k * share),
                                 at(outer, (k + 1) * share), at(inner, (k + 1) * share)},
                                {0, 1, 2, 3}),
                  2000);
  return comes_to_rest(run, 0.05, 1e-5);
}

struct Wedge {
  const char* row;
  double semi_apical, friction;  ///< [deg]
  double normal, shear, thrust;  ///< k_n A, k_s A [N/m], H0 [N]
};

/// How far a wedge with faces of 1 m between two abutments has dropped when it is at rest under
/// this part of its slip load [m]; negative if it falls. Closed form f.4.
double wedge_drop(const Wedge& c, double part) {
  const double a = c.semi_apical * degree, load = part * reference(std::string(c.row) + ".P");
  const Vec2 apex(0, std::cos(a)), toe(std::sin(a), 0), left(-toe.x(), 0);
  const ConvexPolygon rock({left, toe, apex}, {0, 1, 2});
  // Weight alone cannot be raised: the load acts in the centre of mass, and gravity not at all.
  Run run(CoulombJoint({c.normal, c.shear, c.friction * degree}),
          {.gravity = 0, .local_damping = 0.7, .speed_limit = 100});
  run.add_fixed_block(ConvexPolygon({left, apex, Vec2(-2, apex.y()), Vec2(-2, 0)}, {0, 1, 2, 3}));
  run.add_fixed_block(ConvexPolygon({toe, Vec2(2, 0), Vec2(2, apex.y()), apex}, {0, 1, 2, 3}));
  const int wedge = run.add_block(rock, 2700);
  Stress<2> horizontal = Stress<2>::Zero();
  horizontal(0, 0) = c.thrust / std::cos(a);
  run.prescribe([&](const Vec2&) { return horizontal; }, 1e-9);
  const double start = run.position(wedge).y();
  // In small steps: a load at once would overshoot, and slip on the way.
  for (int k = 0; k < 200; ++k) {
    run.add_load(wedge, {0, -load / 200});
    run.advance_steps(50);
  }
  return comes_to_rest(run, 0.02, 1e-7) ? start - run.position(wedge).y() : -1;
}

}  // namespace

TEST_SUITE("dynamics/structures") {
  TEST_CASE(
      "a roof wedge under horizontal stress drops on its springs, and falls beyond its load") {
    for (const Wedge& c : {Wedge{"F.wedge.20.35.0.1", 20, 35, 5e9, 5e8, 1e6},
                           Wedge{"F.wedge.30.40.0.1", 30, 40, 1e10, 1e9, 5e5},
                           Wedge{"F.wedge.20.35.1", 20, 35, 5e9, 5e9, 1e6}}) {
      CAPTURE(c.row);
      // The closed form keeps lengths and angles: 0.2 mm of drop on 1 m.
      CHECK(wedge_drop(c, 0.98) ==
            doctest::Approx(0.98 * reference(std::string(c.row) + ".u")).epsilon(2e-3));
      CHECK(wedge_drop(c, 1.02) < 0);
    }
  }

  TEST_CASE("Goodman and Bray's slope topples where limit equilibrium says") {
    // Bisection on tan(phi). In the closed form every face is at its limit at once; in a slope of
    // elastic joints they need not be: 2 degrees are allowed (closed forms f.3).
    double falls = 0.70, stands = 0.90;
    REQUIRE(!slope_stands(falls));
    REQUIRE(slope_stands(stands));
    while (stands - falls > 0.01) {
      const double middle = 0.5 * (falls + stands);
      (slope_stands(middle) ? stands : falls) = middle;
    }
    MESSAGE("limit friction " << 0.5 * (falls + stands) << ", closed form "
                              << reference("F.gb.tanphi_limit"));
    CHECK(std::abs(std::atan(0.5 * (falls + stands)) - std::atan(reference("F.gb.tanphi_limit"))) <
          2 * degree);
  }

  TEST_CASE("a semicircular arch needs the thickness of Milankovitch for its number of joints") {
    // Bisection to 1 %; the springs give by 1e-5 of the radius. The voussoirs of the closed form
    // have curved backs, these are chords, a little lighter outside than inside.
    for (const int voussoirs : {7, 11, 17}) {
      CAPTURE(voussoirs);
      const double exact = 10 * reference("F.arch.N" + std::to_string(voussoirs));
      double falls = 0.96 * exact, stands = 1.04 * exact;
      REQUIRE(!arch_stands(voussoirs, falls));
      REQUIRE(arch_stands(voussoirs, stands));
      while (stands - falls > 0.01 * exact) {
        const double middle = 0.5 * (falls + stands);
        (arch_stands(voussoirs, middle) ? stands : falls) = middle;
      }
      MESSAGE("N " << voussoirs << " thickness/R " << 0.05 * (falls + stands) << ", closed form "
                   << 0.1 * exact);
      CHECK(0.5 * (falls + stands) == doctest::Approx(exact).epsilon(0.015));
    }
  }
}

}  // namespace structures_test
