// SPDX-License-Identifier: MIT
// Blocks without in-situ stress at the limit of equilibrium, through `Solver` by every procedure:
// what stands and what does not follows from statics alone where friction does not let go.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/laid_blocks.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/tunnel_state.hpp>

#include "support/blocks.hpp"
#include "support/dense_algebra.hpp"
#include "support/faults.hpp"
#include "support/laid_problem.hpp"
#include "support/limit_analysis.hpp"
#include "support/near.hpp"

namespace limit_problems_test {

using namespace voussoir;
using voussoir_test::brick;
using voussoir_test::circular_arch;
using voussoir_test::degree;
using voussoir_test::joints_of;
using voussoir_test::LaidProblem;
using voussoir_test::limit_factor;
using voussoir_test::random_stack;
using voussoir_test::rectangle;

namespace {

using Procedures = std::tuple<TwoLevel, Relaxation, Explicit>;

/// All of it: rest after blocks have fallen is none.
template <class Tunnel>
bool stands(Tunnel& tunnel) {
  return tunnel.equilibrium().verdict == Verdict::stable && tunnel.fallen().empty();
}

/// Hinges form inside of the edges by l / 3 of what is pressed there; the stiffness makes that a
/// per mille of a joint.
constexpr double stiff = 1e12;

/// @param push  part of the weight to the right
template <class Method>
bool stands_pushed(LaidProblem problem, double push, double tan_friction) {
  problem.add(problem.pushed(Vec2(1, 0), push));
  auto solver = problem.template solver<Solver<Method>>(
      CoulombJoint({stiff, stiff, std::atan(tan_friction)}));
  return stands(solver);
}
template <class Method>
bool arch_stands(const LaidProblem& arch, double sideways) {
  REQUIRE(joints_of(arch).size() + 1 == arch.blocks.size());
  return stands_pushed<Method>(arch, sideways, std::tan(60 * degree));
}

/// Equal blocks on each other, pushed.
template <class Method>
bool stack_stands(int count, double slenderness, double sideways) {
  std::vector<ConvexPolygon> blocks{rectangle({0, -0.5}, 4, 1)};
  const double height = slenderness / count;
  for (int k = 0; k < count; ++k) blocks.push_back(rectangle({0, (k + 0.5) * height}, 1, height));
  Solver<Method> stack(laid_blocks<Planar>(blocks), CoulombJoint({stiff, stiff, 60 * degree}),
                       {.density = 2500, .is_laid = true});
  stack.fix(0);
  stack.add_body_force(Vec2(sideways, 0));
  return stands(stack);
}

/// A column of 1 m x 1 m x 3 m, pushed in this direction.
template <class Method>
bool column_stands(double direction, double sideways) {
  Solver<Method, Spatial> column(
      laid_blocks<Spatial>({brick({0, 0, -0.5}, {3, 3, 1}), brick({0, 0, 1.5}, {1, 1, 3})}),
      CoulombJoint({stiff, stiff, 60 * degree}), {.density = 2500, .is_laid = true});
  column.fix(0);
  column.add_body_force(Vec3(sideways * std::cos(direction), sideways * std::sin(direction), 0));
  return stands(column);
}

MohrCoulombJoint glue(double tensile_strength) {
  return MohrCoulombJoint({.joint_normal_stiffness = stiff,
                           .joint_shear_stiffness = stiff,
                           .friction_angle = 30 * degree,
                           .cohesion = 1e6,
                           .tensile_strength = tensile_strength});
}

/// A block of 1 m by `height`, glued to a plane of 60 degrees.
template <class Method>
bool glued_block_stands(double height, double tensile_strength) {
  const double slope = 60 * degree;
  const auto on_plane = [&](double along, double above) {
    return Vec2(std::cos(slope) * along - std::sin(slope) * above,
                std::sin(slope) * along + std::cos(slope) * above);
  };
  const auto laid = [&](double half, double from, double to) {
    return ConvexPolygon(
        {on_plane(-half, from), on_plane(half, from), on_plane(half, to), on_plane(-half, to)});
  };
  Solver<Method, MohrCoulombJoint> incline(
      laid_blocks<Planar>({laid(2, -1, 0), laid(0.5, 0, height)}), glue(tensile_strength),
      {.density = 2700, .is_laid = true});
  incline.fix(0);
  return stands(incline);
}

/// A column of 1 m x 1 m x 3 m, glued to its base and pushed by its weight in this direction.
template <class Method>
bool glued_column_stands(double direction, double tensile_strength) {
  Solver<Method, Spatial, MohrCoulombJoint> column(
      laid_blocks<Spatial>({brick({0, 0, -0.5}, {3, 3, 1}), brick({0, 0, 1.5}, {1, 1, 3})}),
      glue(tensile_strength), {.density = 2700, .is_laid = true});
  column.fix(0);
  column.add_body_force(Vec3(std::cos(direction), std::sin(direction), 0));
  return stands(column);
}

/// Tension in front of a crack that has taken a corner of the base of such a column, over the
/// pressure of its weight: beam theory of what is left of the square, pushed along its diagonal.
/// @param crack  along the diagonal [m]
double stress_before_crack(double crack) {
  const double half = std::sqrt(0.5), eccentricity = 1.5;  // from the middle, of the resultant
  const double corner = crack * crack, at = -half + 2 * crack / 3;
  const double area = 1 - corner, centroid = -corner * at / area;
  const double second = 1.0 / 12 - corner * (crack * crack / 18 + at * at);
  const double about_centroid = second - area * centroid * centroid;
  return (eccentricity - centroid) * (centroid + half - crack) / about_centroid - 1 / area;
}
/// The bond with which the crack still comes to rest, over that pressure.
double least_stress() {
  double least = stress_before_crack(0);
  for (double crack = 0; crack < 0.5; crack += 1e-4)
    least = std::min(least, stress_before_crack(crack));
  return least;
}

/// Where a slab rests on a base: a rectangle.
struct Rest {
  Vec2 middle, size;
};

/// Forces of a linear joint under a slab that is pressed by a unit weight in the origin: the slab
/// settles by a plane, and force and both moments balance.
/// @pre  no corner of a rest lifts: the joint is linear all over
std::vector<double> forces_on(const std::vector<Rest>& rests) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Rest& rest : rests) {
    const Eigen::Vector3d place(1, rest.middle.x(), rest.middle.y());
    const Vec2 own = rest.size.cwiseProduct(rest.size) / 12;
    moments +=
        rest.size.prod() * (place * place.transpose() +
                            Eigen::Vector3d(0, own.x(), own.y()).asDiagonal().toDenseMatrix());
  }
  const Eigen::Vector3d plane = voussoir_test::solve(moments, Eigen::Vector3d(1, 0, 0));
  std::vector<double> forces;
  for (const Rest& rest : rests) {
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) {
        const Vec2 corner = rest.middle + Vec2(x * rest.size.x(), y * rest.size.y());
        REQUIRE(plane.dot(Eigen::Vector3d(1, corner.x(), corner.y())) > 0);
      }
    forces.push_back(rest.size.prod() *
                     plane.dot(Eigen::Vector3d(1, rest.middle.x(), rest.middle.y())));
  }
  return forces;
}

/// Of a slab of 1 m x 1 m x 0.2 m over its weight, as a solver has them.
template <class Method>
std::vector<double> found_on(const std::vector<Rest>& rests) {
  std::vector<ConvexPolyhedron> blocks{brick({0, 0, 0.1}, {1, 1, 0.2})};
  for (const Rest& rest : rests)
    blocks.push_back(
        brick({rest.middle.x(), rest.middle.y(), -0.5}, {rest.size.x(), rest.size.y(), 1}));
  Solver<Method, Spatial> slab(laid_blocks<Spatial>(blocks), CoulombJoint({1e10, 1e10, 0.6}),
                               {.density = 2500, .is_laid = true});
  for (std::size_t k = 1; k < blocks.size(); ++k) slab.fix(static_cast<int>(k));
  REQUIRE(stands(slab));
  std::vector<double> forces(rests.size());
  for (const auto& at : joint_states(slab))
    if (at.a == 0 || at.b == 0)
      forces[static_cast<std::size_t>(at.a + at.b - 1)] += at.report.normal / (2500 * 9.81 * 0.2);
  return forces;
}

}  // namespace

TEST_SUITE("solver/limit_problems") {
  TEST_CASE_TEMPLATE_DEFINE("a glued block stands until the stress at its heel breaks the bond",
                            Method, bonds) {
    // rho g h (3 (h/b) sin a - cos a), by beam theory of the base; what has cracked there leaves
    // less of it, and all of it goes.
    for (const double height : {1.0, 2.0}) {
      CAPTURE(height);
      const double heel =
          2700 * 9.81 * height * (3 * height * std::sin(60 * degree) - std::cos(60 * degree));
      CHECK(glued_block_stands<Method>(height, 1.01 * heel));
      CHECK(!glued_block_stands<Method>(height, 0.98 * heel));
    }
    // In 3-D along a side: rho g h (3 h/b - 1), in all of the edge at once.
    const double weight = 2700 * 9.81 * 3;
    CHECK(glued_column_stands<Method>(0, 1.01 * 8 * weight));
    CHECK(!glued_column_stands<Method>(0, 0.98 * 8 * weight));
    // Along a diagonal the corner cracks first and bears little: the crack comes to rest.
    const double corner = weight * stress_before_crack(0), least = weight * least_stress();
    CHECK(corner == voussoir_test::near(weight * (9 * std::sqrt(2) - 1)));
    CHECK(least == voussoir_test::near(0.872 * corner).epsilon(1e-3));
    CHECK(glued_column_stands<Method>(45 * degree, 1.02 * least));
    CHECK(!glued_column_stands<Method>(45 * degree, 0.98 * least));
  }
  TEST_CASE_TEMPLATE_APPLY(bonds, Procedures);

  TEST_CASE_TEMPLATE_DEFINE("arch, stack and column stand up to where statics says", Method,
                            limits) {
    // Thickness over radius that 31 voussoirs need: 0.1072 (closed forms f.5). Sideways: limit
    // analysis of the same blocks.
    const double tan_friction = std::tan(60 * degree);
    const LaidProblem whole = circular_arch(31, 1.5);
    const double most = limit_factor(whole, tan_friction, whole.pushed(Vec2(1, 0))).value();
    CHECK(arch_stands<Method>(whole, 0));
    // `Relaxation` sways for longer than its 60 000 steps allow from 0.87 on: whether it then finds
    // the rest hangs on where the motion has left the arch (undecided at 0.9, stable at 0.92).
    const double sure = std::is_same_v<Method, Relaxation> ? 0.85 : 0.98;
    CHECK(arch_stands<Method>(whole, sure * most));
    CHECK(!arch_stands<Method>(whole, 1.02 * most));
    CHECK(!arch_stands<Method>(circular_arch(31, 1.0), 0));
    // Oppenheim (1992): seven voussoirs over 157.5 degrees, 0.37 g. Hinges a per mille inside of
    // the edges, and 1 % of a block's weight that may be out of balance.
    const LaidProblem seven = circular_arch(7, 1.5, 157.5 * degree);
    const double g_part = limit_factor(seven, tan_friction, seven.pushed(Vec2(1, 0))).value();
    CHECK(g_part == voussoir_test::near(0.37).epsilon(0.01));
    CHECK(arch_stands<Method>(seven, 0.98 * g_part));
    CHECK(!arch_stands<Method>(seven, 1.02 * g_part));
    // Blocks that nobody picked on one another.
    for (const int number : {6, 8}) {
      CAPTURE(number);
      const LaidProblem stack = random_stack(number);
      const double tips = limit_factor(stack, tan_friction, stack.pushed(Vec2(1, 0))).value();
      CHECK(stands_pushed<Method>(stack, 0.97 * tips, tan_friction));
      CHECK(!stands_pushed<Method>(stack, 1.03 * tips, tan_friction));
    }
    // About the lower edge: b / h.
    CHECK(stack_stands<Method>(5, 3, 0.97 / 3));
    CHECK(!stack_stands<Method>(5, 3, 1.03 / 3));
    CHECK(column_stands<Method>(0, 0.97 / 3));
    // A state is accepted that is out of balance by 1 % of a weight, 2 % of this moment.
    CHECK(!column_stands<Method>(0, 1.04 / 3));
    // About a corner.
    CHECK(column_stands<Method>(45 * degree, 0.97 * std::sqrt(2) / 3));
    CHECK(!column_stands<Method>(45 * degree, 1.04 * std::sqrt(2) / 3));
  }
  TEST_CASE_TEMPLATE_APPLY(limits, Procedures);

  TEST_CASE_TEMPLATE_DEFINE("a block that nothing carries falls, and lands on nothing", Method,
                            falls_freely) {
    // Between two walls of its own height: where the blocks end there is no floor.
    Solver<Method> gap(laid_blocks<Planar>({rectangle({-1, 0}, 2, 1), rectangle({2, 0}, 2, 1),
                                            rectangle({0.5, 0}, 1, 1)}),
                       CoulombJoint({3e9, 3e9, 1 * degree}), {.density = 2500, .is_laid = true});
    gap.fix(0);
    gap.fix(1);
    (void)gap.equilibrium();
    CHECK(gap.fallen() == std::vector<int>{2});
  }
  TEST_CASE_TEMPLATE_APPLY(falls_freely, Procedures);

  TEST_CASE_TEMPLATE_DEFINE(
      "a slab on three posts, on an L, on a foot 10^6 times as large as another", Method, slabs) {
    const std::vector<std::vector<Rest>> all = {
        {{{-0.4, -0.4}, {0.05, 0.05}}, {{0.4, -0.35}, {0.05, 0.05}}, {{0.05, 0.42}, {0.05, 0.05}}},
        {{{0, -0.15}, {1, 0.7}}, {{-0.25, 0.35}, {0.5, 0.3}}},
        {{{0.03, 0.02}, {0.6, 0.6}}, {{-0.45, 0.45}, {6e-4, 6e-4}}, {{0.4, -0.4}, {0.05, 0.01}}}};
    for (const auto& rests : all) {
      const std::vector<double> expected = forces_on(rests), found = found_on<Method>(rests);
      for (std::size_t k = 0; k < rests.size(); ++k) {
        CAPTURE(rests.size());
        CAPTURE(k);
        // A state is accepted with displacements, and so forces, that are 1e-3 off.
        CHECK(found[k] == voussoir_test::near(expected[k]).epsilon(1e-3));
      }
    }
  }
  TEST_CASE_TEMPLATE_APPLY(slabs, Procedures);

  TEST_CASE_TEMPLATE_DEFINE("a block on an edge or on a corner has no joint, and falls", Method,
                            edges) {
    const Rotation<3> edge = rotation_by(Spin<3>(45 * degree, 0, 0));
    // The diagonal (1, 1, 1) becomes upright.
    const Rotation<3> corner =
        rotation_by(Spin<3>(std::acos(std::sqrt(1.0 / 3)) * Vec3(1, -1, 0).normalized()));
    for (const auto& [turn, height] :
         {std::pair(edge, std::sqrt(0.5)), {corner, std::sqrt(0.75)}}) {
      Solver<Method, Spatial> cube(laid_blocks<Spatial>({brick({0, 0, -0.5}, {4, 4, 1}),
                                                         brick({0, 0, height}, {1, 1, 1}, turn)}),
                                   CoulombJoint({1e10, 1e10, 0.6}),
                                   {.density = 2500, .is_laid = true});
      cube.fix(0);
      (void)cube.equilibrium();
      CHECK(cube.fallen() == std::vector<int>{1});
    }
  }
  TEST_CASE_TEMPLATE_APPLY(edges, Procedures);

  TEST_CASE("loads and supports that make no sense are refused") {
    using voussoir_test::refusal_of;
    using voussoir_test::says;
    Solver<> wall(laid_blocks<Planar>({rectangle({0, -0.5}, 4, 1), rectangle({0, 0.5}, 1, 1)}),
                  CoulombJoint({1e10, 1e10, 0.6}), {.density = 2500, .is_laid = true});
    CHECK(says(refusal_of([&] { wall.fix(2); }), "0 to 1"));
    CHECK(says(refusal_of([&] { wall.add_load(-1, {}); }), "0 to 1"));
    wall.fix(0);
    CHECK(says(refusal_of([&] { wall.add_load(0, {Vec2(1, 0)}); }), "is fixed"));
    CHECK(says(refusal_of([&] { wall.add_load(1, {Vec2(NAN, 0)}); }), "finite"));
    CHECK(says(refusal_of([&] { wall.excavate(circular_opening(1, 12)); }), "excavate first"));
    CHECK(says(refusal_of([] { (void)laid_blocks<Planar>({}); }), "no block"));
    CHECK(
        says(refusal_of([] { InSitu{.density = 2000, .surcharge = 1e5, .is_laid = true}.check(); }),
             "laid"));
  }
}

}  // namespace limit_problems_test
