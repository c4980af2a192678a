// SPDX-License-Identifier: MIT
// A lined tunnel in motion, slowly unloaded, against the search for its equilibrium: two programs
// that share the rock, the beam and the laws, but neither contacts, kinematics nor solution.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/lining_ribs.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace lined_rock_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;

namespace {

const CoulombJoint joint({5e9, 5e8, 35 * degree});
const CoulombJoint interface_law({5e9, 5e8, 30 * degree});
const InSitu in_situ{.density = 2700};

LiningSection shotcrete(double mass) {
  LiningSection section = LiningSection::rectangular(0.15, 25e9);
  section.mass = mass;
  return section;
}

/// Takes the load off the wall in steps and lets the rock come to rest after each.
/// @param rest  time steps in which it does: with fewer, thrusts still change
template <class Run>
void unload(Run& run, double from, double to, int steps, int rest = 2500) {
  for (int k = 1; k <= steps; ++k) {
    run.set_held(from + (to - from) * k / steps);
    run.advance_steps(rest);
  }
}

struct Mean {
  double thrust = 0, largest_moment = 0;
};
Mean mean_of(const std::vector<LiningForce>& forces) {
  Mean mean;
  for (const LiningForce& at : forces) {
    mean.thrust += at.thrust / static_cast<double>(forces.size());
    mean.largest_moment = std::max(mean.largest_moment, std::abs(at.moment));
  }
  return mean;
}

/// Of the members across the tunnel, of which there are `count`.
template <class Members, class EndForces>
double mean_thrust(const Members& members, int count, EndForces&& end_forces) {
  double sum = 0;
  int across = 0;
  for (const auto& member : members) {
    if (std::abs(member.at_rest(0, 1)) > 0.5) continue;  // along y
    sum += end_forces(member)[0];
    ++across;
  }
  CHECK(across == count);
  return sum / across;
}

}  // namespace

TEST_SUITE("solver/lined_rock") {
  TEST_CASE("a ring installed before and after the rock has moved carries what equilibrium says") {
    const auto opening = circular_opening(5, 36);
    const auto rock = jointed_rock(domain_around(opening, 20, 7, 7), 4);
    for (const double left : {1.0, 0.4}) {
      CAPTURE(left);
      Solver<> still(rock, joint, in_situ);
      still.excavate(opening);
      if (left < 1) (void)still.equilibrium(left);
      still.install_lining(lining_frame(still.mass(), {}), shotcrete(360), interface_law);
      REQUIRE(still.equilibrium(0).verdict == Verdict::stable);
      const auto at_rest = lining_forces(still);

      auto run = moving_rock(still.mass(), joint, in_situ, {.local_damping = 0.8});
      if (left < 1) unload(run, 1, left, 3);
      const auto lining = add_lining<EulerBernoulliBeam>(run, lining_frame(still.mass(), {}),
                                                         {shotcrete(360)}, interface_law, 0.15);
      unload(run, left, 0, 4);
      const auto moved = lining_forces(run, *lining);
      const Mean a = mean_of(at_rest), b = mean_of(moved);
      // One point of contact on every piece of wall there, two here; slip depends on the way: 1.1 %
      // and 2.2 % are seen.
      CHECK(b.thrust == voussoir_test::near(a.thrust).epsilon(0.02));
      CHECK(b.largest_moment == voussoir_test::near(a.largest_moment).epsilon(0.03));
      CHECK(std::abs(run.energy().relative_imbalance()) < 1e-3);
    }
  }

  // Bars between pins that the rock pushes in their middle, there and here.
  TEST_CASE("so does a ring of bars") {
    const auto opening = circular_opening(5, 36);
    Solver<PinnedBar> still(jointed_rock(domain_around(opening, 20, 7, 7), 4), joint, in_situ);
    still.excavate(opening);
    const auto frame = lining_frame(still.mass(), {.nodes = 36});
    still.install_lining(frame, shotcrete(360), interface_law);
    REQUIRE(still.equilibrium(0).verdict == Verdict::stable);
    auto run = moving_rock(still.mass(), joint, in_situ, {.local_damping = 0.8});
    const auto lining = add_lining<PinnedBar>(run, frame, {shotcrete(360)}, interface_law, 0.15);
    unload(run, 1, 0, 4);
    const Mean a = mean_of(lining_forces(still)), b = mean_of(lining_forces(run, *lining));
    CHECK(b.thrust == voussoir_test::near(a.thrust).epsilon(0.01));
    CHECK(b.largest_moment == 0);
  }

  TEST_CASE("so do ribs in 3-D") {
    const Domain<3> ground{{-6, 0, -6}, {6, 2, 7}};
    SpatialJointSet a{"J1", 75 * degree, 80 * degree}, b{"J2", 25 * degree, 100 * degree},
        c{"J3", 80 * degree, 5 * degree};
    for (SpatialJointSet* set : {&a, &b, &c}) set->spacing = 1.5;
    const PrismaticOpening opening(circular_opening(4, 20));
    const InSitu deep{.density = 2700, .surcharge = 4e5};
    const std::vector<LiningSection> sections = [] {
      LiningSection rib = LiningSection::strip(0.15, 1, 25e9),
                    tie = LiningSection::strip(0.15, 0.5, 25e9);
      rib.mass = 360;
      tie.mass = 180;
      return std::vector{rib, tie};
    }();
    const LiningRibs ribs{.ring = {.nodes = 20}, .spacing = 1};
    Solver<Spatial> still(
        slice<Spatial>(ground, joint_network({a, b, c}, ground, 1), {.min_inscribed_radius = 0.15}),
        joint, deep);
    still.excavate(opening, 0.02);
    const auto frame = lining_frame(still.mass(), ribs);
    still.install_lining(frame, sections, interface_law);
    REQUIRE(still.equilibrium().verdict == Verdict::stable);
    const double at_rest = mean_thrust(still.lining()->members(), 40, [&](const auto& member) {
      return member.end_forces(still.system().displacement.data());
    });
    auto run = moving_rock(still.mass(), joint, deep, {.local_damping = 0.8});
    const auto lining = add_lining<EulerBernoulliBeam>(run, frame, sections, interface_law, 0.15);
    unload(run, 1, 0, 4, 1250);
    const double moved = mean_thrust(lining->members(), 40, [&](const auto& member) {
      return member.end_forces(run.pose(member.i), run.pose(member.j));
    });
    // 0.2 % is seen, with twice the steps 0.5 %.
    CHECK(moved == voussoir_test::near(at_rest).epsilon(0.01));
    CHECK(std::abs(run.energy().relative_imbalance()) < 1e-3);
  }
}

}  // namespace lined_rock_test
