// SPDX-License-Identifier: MIT
// Where the domain ends must not decide what a tunnel does.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/dynamics/set_in_motion.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/laboratory/elastic_moduli.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/theory/circular_opening.hpp>
#include <voussoir/tunnel/boundary_bias.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/elastic_tunnel.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"
#include "support/small_tunnel.hpp"
#include "support/squares.hpp"

namespace far_field_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::glued;
using voussoir_test::ground_of_squares;
using voussoir_test::paper_sets;
using voussoir_test::small_in_situ;
using voussoir_test::small_opening;
using voussoir_test::small_rock;
using voussoir_test::squares;

namespace {

using Elastic = Solver<Planar, MohrCoulombJoint>;

/// Displacements without slip: one elastic solve.
template <class Tunnel>
Eigen::VectorXd elastic_displacement(const Tunnel& tunnel) {
  auto system = tunnel.system();
  system.wall_fraction = 0;
  Eigen::VectorXd u;
  system.forces(system.displacement, u);
  (void)system.elastic_solver({}).solve_in_place(u, {.relative = 1e-10});
  return u;
}

const double young = 1e10;
/// A hole of radius 1 in squares, without gravity that would be felt.
SectionClosure hole_in_squares(double half_width, double side, double turn, double k0) {
  const Domain<2> box{{-half_width, -half_width}, {half_width, half_width}};
  Elastic tunnel(squares(box, side, turn), glued(young / side, young / side),
                 {.density = 0.01, .k0 = k0, .surcharge = 1e6}, {}, ground_of_squares(young));
  tunnel.excavate(circular_opening(2, 360), 1e-9);
  return section_closure(elastic_wall_motion(tunnel));
}

template <class Tunnel>
double unbalance(Tunnel& tunnel) {
  return tunnel.out_of_balance_ratio();
}

/// In 3-D the opening runs through the ends of the domain, which stay planes of symmetry.
template <class Geometry>
FarField<Geometry::dim> around_tunnel() {
  auto field = FarField<Geometry::dim>::elastic(
      elastic_moduli(small_rock<Geometry>(), CoulombJoint({5e9, 5e8, 0.7})));
  if constexpr (Geometry::dim == 3)
    field = field.with(SpatialSide::south, Boundary::rollers)
                .with(SpatialSide::north, Boundary::rollers);
  return field;
}

}  // namespace

TEST_SUITE("solver/far_field") {
  // Blocks of a fifth and a tenth of the radius, extrapolated to none: the remainder goes with
  // their square, 0.3 % (docs/validation.md).
  TEST_CASE("a hole in uniform stress moves as Kirsch says, however near the edge") {
    for (const bool is_near : {false, true})
      for (const double k0 : {0.5, 2.0}) {
        const double half_width = is_near ? 3 : 6, turn = is_near ? 20 * degree : 0;
        CAPTURE(half_width);
        CAPTURE(k0);
        const FarStress far{1e6, k0};
        const double shear_modulus = 0.5 * young, exact_mean = far.mean() / (2 * shear_modulus),
                     exact_cos2 = 3 * far.deviator() / (2 * shear_modulus);
        const SectionClosure coarse = hole_in_squares(half_width, 0.2, turn, k0),
                             fine = hole_in_squares(half_width, 0.1, turn, k0);
        const double upright = 2 * fine.upright - coarse.upright,
                     across = 2 * fine.across - coarse.across;
        CHECK(0.25 * (across + upright) / exact_mean == voussoir_test::near(1).epsilon(0.01));
        CHECK(0.25 * (across - upright) / exact_cos2 == voussoir_test::near(1).epsilon(0.01));
      }
  }

  TEST_CASE("jointed rock under gravity: the same in a wider and a deeper domain") {
    const SimplePolygon opening = circular_opening(6, 48);
    const auto joints = joint_network(paper_sets(), domain_around(opening, 70, 12, 40), 3);
    const auto motion = [&](double width, double below, bool is_elastic) {
      const auto rock = slice(domain_around(opening, width, 12, below), joints, {0.25, 5});
      const MohrCoulombJoint law = glued(5e9, 5e8);
      const FarField<2> field =
          is_elastic ? FarField<2>::elastic(elastic_moduli(rock, law)) : FarField<2>();
      Elastic tunnel(rock, law, {.density = 2700, .k0 = 0.7}, {}, field);
      tunnel.excavate(opening, 0.02);
      return elastic_wall_motion(tunnel);
    };
    const auto near = motion(40, 15, true), deep = motion(40, 40, true);
    const SectionClosure of_near = section_closure(near), of_deep = section_closure(deep);
    CHECK(of_near.upright == voussoir_test::near(of_deep.upright).epsilon(0.01));
    CHECK(of_near.across == voussoir_test::near(of_deep.across).epsilon(0.01));
    CHECK(convergence_of(near, mean_displacement(near)).crown ==
          voussoir_test::near(convergence_of(deep, mean_displacement(deep)).crown).epsilon(0.01));
    // Moved as a whole it is the same wall.
    auto shifted = near;
    const Vec2 by(0.3, -0.7);
    for (WallMotion& piece : shifted) {
      piece.moved += by;
      piece.convergence -= by.dot(Vec2(std::cos(piece.angle), std::sin(piece.angle)));
    }
    const Convergence is = convergence_of(near, mean_displacement(near)),
                      was = convergence_of(shifted, mean_displacement(shifted));
    // Within the window of 12 degrees the direction turns: 0.2 of the shift, and less in the
    // median.
    CHECK(std::abs(is.crown - was.crown) < 0.15);
    CHECK(std::abs(is.invert - was.invert) < 0.15);
    CHECK(std::abs(is.left_springing - was.left_springing) < 0.15);
    CHECK(std::abs(is.right_springing - was.right_springing) < 0.15);
    CHECK(was.rise - is.rise == voussoir_test::near(by.y()).epsilon(1e-9));
    // Rollers do not have that.
    CHECK(boundary_bias(motion(24, 9, false), motion(24, 9, true)).largest() > 0.03);
  }

  TEST_CASE_TEMPLATE("set in motion it rests, and comes back as it was", Geometry, Planar,
                     Spatial) {
    const Acceptance tight{.error_estimate = 1e-6, .unbalance_over_weight = 1e-5};
    const DynamicsSettings settings{.local_damping = 0.8};
    Solver<Geometry> tunnel(small_rock<Geometry>(), CoulombJoint({5e9, 5e8, 40 * degree}),
                            small_in_situ, {}, around_tunnel<Geometry>());
    CHECK(unbalance(tunnel) < 1e-9);
    tunnel.excavate(small_opening<Geometry>(), 0.02);
    REQUIRE(tunnel.equilibrium(0.3, {}, tight).verdict == Verdict::stable);
    const Eigen::VectorXd at_rest = tunnel.system().displacement;
    auto run = set_in_motion(tunnel, settings);
    // Of second order in the displacements, as it is between rollers: a contact update turns
    // levers.
    Solver<Geometry> held(small_rock<Geometry>(), CoulombJoint({5e9, 5e8, 40 * degree}),
                          small_in_situ);
    held.excavate(small_opening<Geometry>(), 0.02);
    REQUIRE(held.equilibrium(0.3, {}, tight).verdict == Verdict::stable);
    const double with_rollers = set_in_motion(held, settings).unbalance_over_weight();
    CHECK(run.unbalance_over_weight() < 1.2 * with_rollers);
    run.advance_steps(500);
    tunnel.take_back(run);
    const Eigen::VectorXd moved = tunnel.system().displacement - at_rest;
    CHECK(moved.cwiseAbs().maxCoeff() < 0.01 * at_rest.cwiseAbs().maxCoeff());
    CHECK(unbalance(tunnel) < 0.05);
  }

  TEST_CASE("excavated in rounds it ends as excavated at once") {
    using voussoir_test::difference;
    using voussoir_test::elastic;
    using voussoir_test::tight;
    const Domain<2> domain{{-8, -8}, {8, 8}};
    const auto rock = voussoir_test::jointed_rock(domain, 2);
    const auto field = FarField<2>::elastic(elastic_moduli(rock, elastic));
    const SimplePolygon heading = voussoir_test::box(-2, 0, 2, 2),
                        bench = voussoir_test::box(-2, -2, 2, 0),
                        whole = voussoir_test::box(-2, -2, 2, 2);
    Elastic at_once(rock, elastic, voussoir_test::deep, {}, field), in_rounds = at_once;
    at_once.excavate(whole, 1e-6);
    REQUIRE(at_once.equilibrium(0, {}, tight).verdict == Verdict::stable);
    in_rounds.excavate(heading, 1e-6);
    REQUIRE(in_rounds.equilibrium(0, {}, tight).verdict == Verdict::stable);
    in_rounds.excavate(bench, 1e-6);
    REQUIRE(in_rounds.equilibrium(0, {}, tight).verdict == Verdict::stable);
    CHECK(difference(at_once, in_rounds) < 1e-5);
  }

  TEST_CASE("a stress boundary is elastic ground without stiffness") {
    const Domain<2> domain{{-8, -8}, {8, 8}};
    const auto rock = voussoir_test::jointed_rock(domain, 2);
    const auto moduli = elastic_moduli(rock, voussoir_test::elastic);
    const auto crown = [&](const FarField<2>& field) {
      Elastic tunnel(rock, voussoir_test::elastic, voussoir_test::deep, {}, field);
      CHECK(unbalance(tunnel) < 1e-8);
      tunnel.excavate(voussoir_test::box(-2, -2, 2, 2), 1e-6);
      return elastic_displacement(tunnel);
    };
    const auto on_rollers = [&](const ElasticMatrix<2>& m) {
      return FarField<2>::elastic(m)
          .with(Side::left, Boundary::rollers)
          .with(Side::bottom, Boundary::rollers);
    };
    const Eigen::VectorXd stress = crown(on_rollers(moduli).with(Side::right, Boundary::stress)),
                          soft = crown(on_rollers(1e-7 * moduli)).head(stress.size()),
                          ground = crown(on_rollers(moduli)).head(stress.size());
    const double largest = stress.cwiseAbs().maxCoeff();
    // Not quite: blocks between two nodes of the edge are held to a straight line.
    CHECK((stress - soft).cwiseAbs().maxCoeff() < 0.04 * largest);
    CHECK((stress - ground).cwiseAbs().maxCoeff() > 0.15 * largest);
  }

  TEST_CASE("far from the origin it is the same") {
    const auto crown = [](const Vec2& shift) {
      const Domain<2> domain{Vec2(-8, -8) + shift, Vec2(8, 8) + shift};
      const auto field = FarField<2>::elastic(elastic_matrix<2>({1e9, 0.2}));
      std::vector<Joint> joints;
      for (int set = 0; set < 2; ++set)
        for (int k = -12; k <= 12; ++k) {
          const Vec2 normal = set == 0 ? Vec2(0.6, 0.8) : Vec2(-0.8, 0.6),
                     along(-normal.y(), normal.x()),
                     middle = Vec2((0.9 * k + 0.2) * normal) + shift;
          joints.push_back({Segment{middle - 40 * along, middle + 40 * along}, set});
        }
      Elastic tunnel(slice(domain, joints, {.min_inscribed_radius = 0.01}), glued(5e9, 5e8),
                     {.density = 2700, .surcharge = 1e6}, {}, field);
      tunnel.excavate(SimplePolygon({Vec2(-2, -2) + shift, Vec2(2, -2) + shift, Vec2(2, 2) + shift,
                                     Vec2(-2, 2) + shift}),
                      0.01);
      return elastic_displacement(tunnel);
    };
    const Eigen::VectorXd here = crown(Vec2(0, 0)), there = crown(Vec2(4e5, -6e5));
    REQUIRE(here.size() == there.size());
    // Rounding of coordinates, 1e-10 m, over the smallest blocks.
    CHECK((here - there).cwiseAbs().maxCoeff() < 1e-6 * here.cwiseAbs().maxCoeff());
  }
}

}  // namespace far_field_test
