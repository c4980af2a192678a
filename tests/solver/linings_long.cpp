// SPDX-License-Identifier: MIT
// Which law rock touches a lining by, and linings beside and upon each other: two ways of saying
// the same lining must carry the same.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/contact/rock_on_lining.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"

namespace linings_long {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;

namespace {

/// Tight, so that what is left of the searches' errors is far below the tolerances.
const Acceptance tight{.error_estimate = 1e-6};
/// Equilibrium at that share of the wall traction, found as tightly as that.
template <class Tunnel>
void settle(Tunnel& tunnel, double wall_traction, const Acceptance& acceptance = tight) {
  const EquilibriumReport report = tunnel.equilibrium(wall_traction, {}, acceptance);
  INFO(report.reason);
  REQUIRE(report.verdict == Verdict::stable);
}

const LiningSection shell = LiningSection::rectangular(0.1, 20e9);

template <class Tunnel>
Tunnel excavated() {
  const auto opening = circular_opening(5, 36);
  Tunnel tunnel(jointed_rock(domain_around(opening, 20, 7, 7), 4),
                CoulombJoint({5e9, 5e8, 40 * degree}), {.density = 2700});
  tunnel.excavate(opening);
  return tunnel;
}

LiningSection share_of(const LiningSection& whole, double share) {
  LiningSection part = whole;
  part.axial_stiffness *= share;
  part.bending_stiffness *= share;
  part.shear_stiffness *= share;
  part.mass *= share;
  return part;
}

double largest_thrust(const std::vector<LiningForce>& forces) {
  double most = 0;
  for (const LiningForce& f : forces) most = std::max(most, f.thrust);
  return most;
}

template <class Tunnel>
std::vector<LiningForce> of_lining(const Tunnel& tunnel, int number) {
  auto forces = lining_forces(tunnel);
  std::erase_if(forces, [&](const LiningForce& at) { return at.lining != number; });
  return forces;
}

/// With an interface of this law.
template <class Law>
std::vector<LiningForce> thrusts(const Law& law) {
  auto tunnel = excavated<Solver<RockOnLining<Law>>>();
  tunnel.install_lining(lining_frame(tunnel.mass(), LiningRing{}), shell, law);
  settle(tunnel, 0);
  return lining_forces(tunnel);
}

}  // namespace

TEST_SUITE("solver/linings_long") {
  TEST_CASE("an interface that is Mohr-Coulomb without cohesion carries what a Coulomb one does") {
    const auto coulomb = thrusts(CoulombJoint({1e9, 1e9, 20 * degree}));
    const auto mohr = thrusts(MohrCoulombJoint({.joint_normal_stiffness = 1e9,
                                                .joint_shear_stiffness = 1e9,
                                                .friction_angle = 20 * degree}));
    REQUIRE(coulomb.size() == mohr.size());
    const double scale = largest_thrust(coulomb);
    REQUIRE(scale > 1e5);
    // Two searches, to an error of 1e-6 of the largest displacement each.
    for (std::size_t k = 0; k < mohr.size(); ++k)
      CHECK(std::abs(coulomb[k].thrust - mohr[k].thrust) <= 1e-6 * scale);
  }

  TEST_CASE("a bonded interface holds the lining where a slippery one lets it go") {
    // Cohesion keeps shear on the interface that friction of 5 degrees cannot.
    const auto bonded = thrusts(MohrCoulombJoint({.joint_normal_stiffness = 1e9,
                                                  .joint_shear_stiffness = 1e9,
                                                  .friction_angle = 5 * degree,
                                                  .cohesion = 1e6}));
    const auto slippery = thrusts(CoulombJoint({1e9, 1e9, 5 * degree}));
    double apart = 0;
    for (std::size_t k = 0; k < bonded.size(); ++k)
      apart = std::max(apart, std::abs(bonded[k].thrust - slippery[k].thrust));
    CHECK(apart > 0.02 * largest_thrust(bonded));
  }

  TEST_CASE("a lining laid in two layers of a third and two thirds carries what the whole does") {
    const CoulombJoint law({1e9, 1e9, 20 * degree});
    auto one = excavated<Solver<>>();
    auto two = one;
    const auto frame = lining_frame(one.mass(), LiningRing{});
    one.install_lining(frame, shell, law);
    for (const double share : {1.0 / 3, 2.0 / 3})
      two.install_lining(frame, share_of(shell, share),
                         CoulombJoint({1e9 * share, 1e9 * share, 20 * degree}));
    settle(one, 0);
    settle(two, 0);
    REQUIRE(two.linings().size() == 2);
    const auto whole = lining_forces(one);
    const auto first = of_lining(two, 0), second = of_lining(two, 1);
    REQUIRE(first.size() == whole.size());
    REQUIRE(second.size() == whole.size());
    const double scale = largest_thrust(whole);
    for (std::size_t k = 0; k < whole.size(); ++k) {
      CHECK(std::abs(first[k].thrust - whole[k].thrust / 3) <= 1e-6 * scale);
      CHECK(std::abs(second[k].thrust - 2 * whole[k].thrust / 3) <= 1e-6 * scale);
      CHECK(std::abs(first[k].moment + second[k].moment - whole[k].moment) <= 1e-6 * scale);
    }
    CHECK(std::abs(convergence(one).crown - convergence(two).crown) <=
          1e-6 * convergence(one).crown);
  }

  TEST_CASE("an invert closed after the arch leaves the arch where it is") {
    const CoulombJoint law({1e9, 1e9, 20 * degree});
    auto tunnel = excavated<Solver<>>();
    const auto arch = [&](double from, double to) {
      return lining_frame(tunnel.mass(), LiningRing{.from = from, .to = to});
    };
    tunnel.install_lining(arch(-60 * degree, 240 * degree), shell, law);
    settle(tunnel, 0.5, {});
    const auto before = lining_forces(tunnel);
    const auto members = lining_members(tunnel);
    REQUIRE(largest_thrust(before) > 40);  // little: its ends rest on nothing
    tunnel.install_lining(arch(235 * degree, 305 * degree), shell, law);
    // Nothing has moved: the first carries what it did, the second nothing.
    const auto after = lining_members(tunnel);
    for (std::size_t k = 0; k < members.size(); ++k) CHECK(after[k].thrust == members[k].thrust);
    // Displacements of 1e-3 m are rounded at 1e-19 m, times 2e9 N/m.
    for (std::size_t k = members.size(); k < after.size(); ++k)
      CHECK(std::abs(after[k].thrust) <= 1e-9);
    settle(tunnel, 0.3, {});
    CHECK(largest_thrust(lining_forces(tunnel)) > largest_thrust(before));
    CHECK(largest_thrust(of_lining(tunnel, 1)) > 1e-2);
  }
}

}  // namespace linings_long
