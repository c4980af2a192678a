// SPDX-License-Identifier: MIT
// A block on a plane of slope a: it stays while tan a < mu, and its displacement is then that of
// the joint's springs; it slides for tan a > mu, with g (sin a - mu cos a). The plane is kept
// horizontal and the weight tilted instead.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/model/system.hpp>

#include "support/reference.hpp"

namespace incline_test {

using namespace voussoir;
using voussoir_test::reference;

namespace {

using Incline = System<Planar>;

constexpr double degree = std::numbers::pi / 180, gravity = 9.81;
constexpr double kn = 5e9, ks = 5e8, width = 1.0, height = 0.2, weight = 2700 * gravity * 0.2;
const std::vector<double> measures{0, width* height};

/// Body 0 is the fixed plane, body 1 a block of 1.0 m x 0.2 m on it. Nothing has moved yet.
Incline block_on_plane(double slope, double friction_angle) {
  Incline system(CoulombJoint({kn, ks, friction_angle}), kn, CoulombJoint({1, 1, 0}, any_units));
  system.add_body({Vec2(0, -1), 1e6, 1, false});
  system.add_body(
      {Vec2(0, 0.5 * height), weight, std::sqrt((width * width + height * height) / 12), true});
  const Segment base{{0.5 * width, 0}, {-0.5 * width, 0}};  // plane on its left, normal upwards
  system.joints.add(0, 1, base, system.body(0).centre, system.body(1).centre, base.gauss_points());
  system.load.segment<2>(3) = weight * Vec2(std::sin(slope), -std::cos(slope));
  return system;
}

SearchContext context() {
  SearchContext given;
  given.measures = &measures;
  return given;
}

}  // namespace

TEST_SUITE("solver/incline") {
  TEST_CASE_TEMPLATE("it stays while tan a < mu, where the springs of the joint let it", Method,
                     TwoLevel, Relaxation) {
    const double friction = 35 * degree;
    for (const double slope : {10 * degree, 25 * degree}) {
      CAPTURE(slope);
      Incline system = block_on_plane(slope, friction);
      SearchContext tight = context();
      tight.acceptance.unbalance_over_weight = 1e-9;
      const EquilibriumReport report = Method{}.find(system, tight);
      CHECK(report.verdict == Verdict::stable);
      CHECK(report.fallen.empty());
      // The normal spring is k_n b, the shear spring k_s b, and the joint resists turning with
      // k_n b^3 / 12 (two Gauss points give it exactly). The weight acts h/2 above the joint.
      const double along = weight * std::sin(slope), down = weight * std::cos(slope);
      const double turn = -0.5 * height * along / (kn * std::pow(width, 3) / 12);
      const Vec<3> expected(along / (ks * width) - 0.5 * height * turn, -down / (kn * width), turn);
      // Every point must stick for this to hold: N of the lighter one is W cos a / 2 less the
      // moment over the distance of the points, and T half of W sin a.
      const double lighter = 0.5 * down - 0.5 * height * along / (width / std::sqrt(3.0));
      REQUIRE(0.5 * along < lighter * std::tan(friction));
      CHECK(system.displacement.segment<3>(0).norm() == 0);
      // An out-of-balance force of 1e-9 of the weight leaves 1e-9 of the displacement, over the
      // softest spring. A relaxation swings past it and may slip on the way; it only has to hold
      // the block.
      if constexpr (std::is_same_v<Method, TwoLevel>)
        CHECK((system.displacement.segment<3>(3) - expected).norm() <= 1e-8 * expected.norm());
      CHECK(system.displacement[3] >= (1 - 1e-8) * expected[0]);
    }
  }

  TEST_CASE("it also stays where one edge of the joint slips before the other") {
    // At 33 degrees the uphill point is beyond its strength when both share the shear; it slips,
    // and the downhill point takes over. The block as a whole is still held.
    const double slope = 33 * degree, friction = 35 * degree;
    const double along = weight * std::sin(slope), down = weight * std::cos(slope);
    const double lighter = 0.5 * down - 0.5 * height * along / (width / std::sqrt(3.0));
    REQUIRE(0.5 * along > lighter * std::tan(friction));
    Incline system = block_on_plane(slope, friction);
    const EquilibriumReport report = TwoLevel{}.find(system, context());
    CHECK(report.verdict == Verdict::stable);
    CHECK(report.fallen.empty());
    double shear = 0;
    system.joints.visit(system.displacement.data(),
                        [&](const auto&, const auto&, const auto&, const PointForce<2>& f) {
                          shear += std::abs(f.tangential[0]);
                        });
    CHECK(std::abs(shear - along) <= 0.01 * weight);  // the acceptance on the force ratio
  }

  TEST_CASE_TEMPLATE("it does not stay for tan a > mu: it detaches, is removed and counted", Method,
                     TwoLevel, Relaxation, Explicit) {
    Incline system = block_on_plane(40 * degree, 35 * degree);
    const EquilibriumReport report = Method{}.find(system, context());
    CHECK(report.fallen == std::vector<int>{1});
    CHECK(report.fallen_measure == width * height);
    CHECK(!system.body(1).movable);
    // 0.2 m^2 are no collapse of the slope by the default limit of 20 m^2.
    CHECK(report.verdict == Verdict::stable);
  }

  TEST_CASE_TEMPLATE("detached rock beyond the limit is a collapse", Method, TwoLevel, Relaxation,
                     Explicit) {
    Incline system = block_on_plane(40 * degree, 35 * degree);
    SearchContext strict = context();
    strict.acceptance.collapse_measure = 0.1;
    const EquilibriumReport report = Method{}.find(system, strict);
    CHECK(report.verdict == Verdict::collapse);
    CHECK(report.reason.find("1 block of") != std::string::npos);
  }

  TEST_CASE("a degree on either side of the friction angle decides") {
    Incline below = block_on_plane(34 * degree, 35 * degree);
    Incline above = block_on_plane(36 * degree, 35 * degree);
    CHECK(TwoLevel{}.find(below, context()).fallen.empty());
    CHECK(TwoLevel{}.find(above, context()).fallen.size() == 1);
  }

  TEST_CASE("once it slides, what is left to accelerate it is g (sin a - mu cos a)") {
    struct Row {
      const char* id;
      double slope, friction;
    };
    for (const Row& row :
         {Row{"F.incline.th30.phi20", 30, 20}, Row{"F.incline.th36.phi35", 36, 35},
          Row{"F.incline.th40.phi35", 40, 35}, Row{"F.incline.th60.phi30", 60, 30}}) {
      CAPTURE(row.id);
      Incline system = block_on_plane(row.slope * degree, row.friction * degree);
      // On the way down, with the normal springs at their equilibrium, and the slip committed.
      const double sunk = weight * std::cos(row.slope * degree) / (kn * width);
      system.displacement.segment<3>(3) << 0.01, -sunk, 0;
      (void)system.commit();
      Eigen::VectorXd f;
      system.forces(system.displacement, f);
      const double acceleration = f[3] / (weight / gravity);
      // 12 printed digits; the last row but one is a small difference of large terms.
      CHECK(std::abs(acceleration - reference(row.id)) <= 1e-11 * gravity);
      CHECK(std::abs(f[4]) <= 1e-12 * weight);
      // Friction acts h/2 below the centre: it turns the block, head over toe.
      const double friction =
          weight * std::cos(row.slope * degree) * std::tan(row.friction * degree);
      CHECK(std::abs(f[5] + 0.5 * height * friction) <= 1e-12 * weight);
    }
  }

  TEST_CASE("a search that may not take long enough is undecided and says why") {
    Incline system = block_on_plane(40 * degree, 35 * degree);
    Relaxation::Params few;
    few.max_steps = 3;
    few.check_every = 1;
    const EquilibriumReport relaxed = Relaxation(few).find(system, context());
    CHECK(relaxed.verdict == Verdict::undecided);
    CHECK(relaxed.reason.find("step limit of 3") != std::string::npos);
    CHECK(relaxed.steps == 3);
    Incline again = block_on_plane(40 * degree, 35 * degree);
    Explicit::Params steps;
    steps.ramp_steps = 0;
    steps.max_steps = 3;
    CHECK(Explicit(steps).find(again, context()).verdict == Verdict::undecided);
  }
}

}  // namespace incline_test
