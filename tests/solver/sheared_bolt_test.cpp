// SPDX-License-Identifier: MIT
// A bolt across a joint that slips: dowel and axial force against the closed form of the law, by
// every procedure, under a known load and at a known displacement.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/bolt/bolt_anchors.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/solver/load_in_steps.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/support_forces.hpp>

#include "support/blocks.hpp"
#include "support/laid_problem.hpp"
#include "support/near.hpp"

namespace sheared_bolt_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

constexpr double width = 4, height = 1, normal_stiffness = 1e11, shear_stiffness = 1e10,
                 friction = 30 * degree, axial = 2e8, dowel = 5e7, grip = 0.3;
const Acceptance tight{.error_estimate = 1e-8,
                       .unbalance_over_weight = 1e-8,
                       .displacement_limit = 0.2,
                       .contact_update_limit = 0.15};
constexpr int steps = 20;

/// A block on a fixed one, and a bolt through the middle of their joint.
struct Sheared {
  double lean;        ///< of the bolt from the normal of the joint, towards the slip [rad]
  double pretension;  ///< [N]

  [[nodiscard]] Vec2 axis() const { return {std::sin(lean), std::cos(lean)}; }
  [[nodiscard]] AxialShearBolt law() const {
    return AxialShearBolt({{.axial_stiffness = axial, .pretension = pretension}, dowel});
  }
  [[nodiscard]] LaidProblem problem() const {
    return {.blocks = {rectangle({0, -0.5 * height}, width, height),
                       rectangle({0, 0.5 * height}, width, height)},
            .fixed = {0}};
  }
  /// Bolted when it has come to rest under its weight.
  template <class Method>
  [[nodiscard]] auto made() const {
    using Blocks = Solver<CoulombJoint, AxialShearBolt, LorigAnchors, Method>;
    auto blocks =
        problem().solver<Blocks>(CoulombJoint({normal_stiffness, shear_stiffness, friction}));
    REQUIRE(blocks.equilibrium(0, Method(), tight).verdict == Verdict::stable);
    blocks.install_bolt(Segment{-0.7 * axis(), 0.7 * axis()}, law(), 1.0, LorigAnchors{grip});
    return blocks;
  }

  struct State {
    double axial, dowel;  ///< [N]
    Vec2 on_block;        ///< both, of the bolt [N]
  };
  /// Where the upper block has moved by so much: anchors 0.6 m apart,
  ///   T = T0 + K_a (|2 d e + m| - 2 d) >= 0 along 2 d e + m,   Q = K_s |m - (m . e) e| across e.
  [[nodiscard]] State at(const Vec2& moved) const {
    const Vec2 e = axis(), span = 2 * grip * e + moved;
    const Vec2 across = moved - e.dot(moved) * e;
    const double pull = std::max(0.0, pretension + axial * (span.norm() - 2 * grip));
    return {pull, dowel * across.norm(), -pull / span.norm() * span - dowel * across};
  }
  /// How far it slides under a load along the joint: N = W - f_y, F + f_x = N tan(phi), and N
  /// presses the joint by N / k_n L.
  [[nodiscard]] Vec2 slides(double load) const {
    const double weight = problem().weight(1);
    double low = 0, high = 1;
    Vec2 moved = zeros<Vec2>();
    for (int k = 0; k < 100; ++k) {
      moved.x() = 0.5 * (low + high);
      for (int i = 0; i < 100; ++i) {
        const double pressed = weight - at(moved).on_block.y();
        moved.y() = -(pressed - weight) / (normal_stiffness * width);
      }
      const Vec2 bolt = at(moved).on_block;
      (load + bolt.x() > (weight - bolt.y()) * std::tan(friction) ? low : high) = moved.x();
    }
    return moved;
  }
};

}  // namespace

TEST_SUITE("solver/sheared_bolt") {
  TEST_CASE_TEMPLATE("under a load along the joint it slips until bolt and friction bear it",
                     Method, TwoLevel, Relaxation, Explicit) {
    for (const Sheared& sheared :
         {Sheared{0, 0}, Sheared{0, 50e3}, Sheared{30 * degree, 0}, Sheared{-20 * degree, 20e3}}) {
      CAPTURE(sheared.lean);
      auto blocks = sheared.made<Method>();
      const Vec2 before = blocks.displacement_of(1, zeros<Vec2>());
      // In the plane of the joint: nothing turns the block.
      const double load = 1e6;
      blocks.add_load(1, {Vec2(load, 0), Spin<2>(0.5 * height * load)});
      const auto reports = load_in_steps(blocks, {}, steps, Method(), tight);
      REQUIRE(reports.back().verdict == Verdict::stable);
      REQUIRE(reports.back().fallen.empty());
      const Vec2 expected = sheared.slides(load),
                 moved = blocks.displacement_of(1, zeros<Vec2>()) - before;
      // Relaxation moves under a step of load at once and overruns it: no further than under one
      // step more.
      const double over = std::is_same_v<Method, Relaxation>
                              ? sheared.slides(load * (1 + 1.0 / steps)).x() / expected.x() - 1
                              : 0.0;
      CAPTURE(expected.x());
      CHECK(moved.x() > expected.x() * (1 - 1e-4));
      CHECK(moved.x() < expected.x() * (1 + over + 1e-4));
      REQUIRE(bolt_forces(blocks).size() == 1);
      const BoltReport report = bolt_forces(blocks).front().report;
      const Sheared::State state = sheared.at(moved);
      CHECK(report.axial == near(state.axial).epsilon(1e-6).scale(1));
      CHECK(report.shear == near(state.dowel).epsilon(1e-6));
      CHECK(report.shear > 1e5);
    }
  }

  TEST_CASE("at a displacement that is given it carries what its law says") {
    for (const double lean : {0.0, 30 * degree, -20 * degree}) {
      CAPTURE(lean);
      const Sheared sheared{lean, 20e3};
      auto blocks = sheared.made<TwoLevel>();
      blocks.fix(1);
      const Vec2 start = blocks.displacement_of(1, zeros<Vec2>());
      for (const Vec2& by : {Vec2(0.002, 0), Vec2(0.01, 0.003), Vec2(-0.02, 0.001)}) {
        CAPTURE(by.x());
        const Vec2 then = blocks.displacement_of(1, zeros<Vec2>());
        blocks.displace({{1, by}});
        const Vec2 moved = blocks.displacement_of(1, zeros<Vec2>());
        CHECK((moved - then - by).norm() < 1e-15);
        const BoltReport report = bolt_forces(blocks).front().report;
        const Sheared::State state = sheared.at(moved - start);
        CHECK(report.axial == near(state.axial).epsilon(1e-9).scale(1));
        CHECK(report.shear == near(state.dowel).epsilon(1e-9));
      }
    }
  }
}

}  // namespace sheared_bolt_test
