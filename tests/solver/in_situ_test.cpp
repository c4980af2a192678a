// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"

namespace in_situ_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;

namespace {

/// Worst out-of-balance force over the weight of its block; worst moment over weight times
/// gyration.
struct Unbalance {
  double force = 0, moment = 0;
};

Unbalance unbalance(Solver<>& solver) {
  auto& system = detail::SystemOf::in(solver);
  Eigen::VectorXd f;
  system.forces(system.displacement, f);
  Unbalance worst;
  for (int b = 0; b < system.body_count(); ++b) {
    const auto& body = system.body(b);
    if (!body.movable) continue;
    worst.force = std::max(worst.force, f.segment<2>(3 * b).norm() / body.weight);
    worst.moment = std::max(worst.moment, std::abs(f[3 * b + 2]) / (body.weight * body.gyration));
  }
  return worst;
}

/// Sum over the contacts with one side of the domain of the force on the rock [N/m].
Vec2 reaction(const Solver<>& solver, const Vec2& outward) {
  Vec2 sum = Vec2::Zero();
  const auto& system = solver.system();
  system.boundary.visit(system.displacement.data(),
                        [&](const auto& contact, const auto&, const auto&, const PointForce<2>& f) {
                          if (contact.normal.dot(outward) > 0.999) sum -= f.normal * contact.normal;
                        });
  return sum;
}

}  // namespace

TEST_SUITE("solver/in_situ") {
  TEST_CASE("every block is in equilibrium before anything is built, to rounding") {
    // Whatever the block size, joint extent, K0 and surcharge. Rounding: a traction of 1 MPa over
    // 1 m is 1e6 N with an ulp of 1e-10, on blocks of 1e3 N and more: 1e-13. Measured over these
    // six: 3e-13 of the weight in force, 6e-13 in moment.
    Random random(2024);
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const double radius = 0.2 + 0.4 * random.uniform();
      const double extent =
          seed % 3 == 0 ? std::numeric_limits<double>::infinity() : 1 + 4 * random.uniform();
      const double k0 = 0.3 + 1.7 * random.uniform();
      const double surcharge = seed % 2 == 0 ? 5e5 * random.uniform() : 0.0;
      CAPTURE(seed);
      CAPTURE(radius);
      CAPTURE(extent);
      CAPTURE(k0);
      CAPTURE(surcharge);
      auto rock = jointed_rock({{-10, -20}, {10, 10}}, seed, {radius, 8}, extent);
      REQUIRE(rock.bodies.size() > 100);
      // K0 = 0.3 asks for sin(phi) = 0.7 / 1.3, 33 degrees; 60 carries any K0 here.
      Solver<> solver(std::move(rock), CoulombJoint({5e9, 5e8, 60 * degree}),
                      {.density = 2700, .k0 = k0, .surcharge = surcharge});
      const Unbalance now = unbalance(solver);
      CHECK(now.force < 1e-12);
      CHECK(now.moment < 1e-12);
    }
  }

  TEST_CASE(
      "with more friction than the Mohr circle asks for the stress is carried, with less not") {
    const InSitu in_situ{.density = 2700, .k0 = 0.5};
    // sin(phi) = 0.5 / 1.5
    CHECK(std::abs(in_situ.required_friction_angle() - std::asin(1.0 / 3)) <= 1e-15);
    const auto rock = jointed_rock({{-10, -20}, {10, 10}}, 1);
    const auto worst = [&](double friction) {
      Solver<> solver(rock, CoulombJoint({5e9, 5e8, friction}), in_situ);
      return unbalance(solver).force;
    };
    CHECK(worst(in_situ.required_friction_angle()) < 1e-12);
    CHECK(worst(5 * degree) > 1);  // the 75 degree joints slip, by far more than a block's weight
  }

  TEST_CASE("the base carries the weight and the surcharge, the sides K0 of it") {
    const double k0 = 0.6, surcharge = 2e5, density = 2700;
    const Domain<2> ground{{-10, -20}, {10, 10}};
    Solver<> solver(jointed_rock(ground, 3), CoulombJoint({5e9, 5e8, 60 * degree}),
                    {.density = density, .k0 = k0, .surcharge = surcharge});
    const double base = surcharge * 20 + density * 9.81 * 20 * 30;         // 20 m x 30 m
    const double side = k0 * (surcharge * 30 + density * 9.81 * 30 * 15);  // mean depth 15 m
    CHECK((reaction(solver, {0, -1}) - Vec2(0, base)).norm() <= 1e-12 * base);
    CHECK((reaction(solver, {1, 0}) - Vec2(-side, 0)).norm() <= 1e-12 * base);
    CHECK((reaction(solver, {-1, 0}) - Vec2(side, 0)).norm() <= 1e-12 * base);
  }

  TEST_CASE("the wall traction replaces the excavated rock: only blocks at the wall feel it") {
    const auto opening = circular_opening(5);
    Solver<> solver(jointed_rock(domain_around(opening, 20, 8, 8), 1),
                    CoulombJoint({5e9, 5e8, 60 * degree}), {.density = 2700, .k0 = 0.7});
    solver.excavate(opening, 0.01);
    const auto& system = solver.system();
    CHECK(unbalance(solver).force < 1e-12);  // with the whole wall traction
    std::vector<char> at_wall(static_cast<std::size_t>(system.body_count()), 0);
    Vec2 wall_force = Vec2::Zero();
    for (const auto& piece : wall_pieces(solver.mass()))
      at_wall[static_cast<std::size_t>(piece.body)] = 1;
    double elsewhere = 0;
    for (int b = 0; b < system.body_count(); ++b) {
      const Vec<3> load = system.wall_load.segment<3>(3 * b);
      if (at_wall[static_cast<std::size_t>(b)] == 0 && system.body(b).movable)
        elsewhere = std::max(elsewhere, load.norm() / system.body(b).weight);
      wall_force += load.head<2>();
    }
    // Dropped slivers below 0.01 m^2 leave a wall of their own; none fell away from the outline
    // here.
    REQUIRE(solver.mass().carving.dropped_measure < 0.02);
    CHECK(elsewhere < 1e-12);
    // The rock in the opening had its weight carried: the traction on the wall adds up to it,
    // downwards, by the equilibrium of the excavated piece. What was dropped went with it.
    const double excavated = 2700 * 9.81 * (opening.area() + solver.mass().carving.dropped_measure);
    CHECK((wall_force - Vec2(0, -excavated)).norm() <= 1e-10 * excavated);
  }

  TEST_CASE("in-situ values out of range are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {nan, 0.0, -1.0}) {
      CHECK_THROWS_AS((InSitu{.density = bad}.check()), InvalidInput);
      CHECK_THROWS_AS((InSitu{.density = 2700, .gravity = bad}.check()), InvalidInput);
    }
    for (const double bad : {nan, -0.1, std::numeric_limits<double>::infinity()}) {
      CHECK_THROWS_AS((InSitu{.density = 2700, .k0 = bad}.check()), InvalidInput);
      CHECK_THROWS_AS((InSitu{.density = 2700, .surcharge = bad}.check()), InvalidInput);
    }
    CHECK_THROWS_AS(Solver<>(RockMass<Planar>{}, CoulombJoint({5e9, 5e8, 0.5}), {.density = 2700}),
                    InvalidInput);
  }
}

}  // namespace in_situ_test
