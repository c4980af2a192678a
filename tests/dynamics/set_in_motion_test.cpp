// SPDX-License-Identifier: MIT
// One model at rest and in motion: a tunnel that is set in motion where it is in equilibrium stays
// there, and one that is taken back goes on from where the run has left it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/detection/analytic_centre.hpp>
#include <voussoir/dynamics/set_in_motion.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ribs.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/support_forces.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"
#include "support/small_tunnel.hpp"

namespace set_in_motion_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::small_in_situ;
using voussoir_test::small_opening;
using voussoir_test::small_rock;

namespace {

const DynamicsSettings damped{.local_damping = 0.8};

/// Relaxed to 0.6, bolted and lined, and in equilibrium at 0.
/// @param stiff  times as stiff as usual are joints, bolts and lining
template <class Geometry>
[[nodiscard]] Solver<Geometry> supported(double friction, double stiff = 1) {
  Solver<Geometry> tunnel(small_rock<Geometry>(),
                          CoulombJoint({stiff * 5e9, stiff * 5e8, friction}), small_in_situ);
  tunnel.excavate(small_opening<Geometry>(), 0.02);
  REQUIRE(tunnel.equilibrium(0.6).verdict == Verdict::stable);
  const BoltPattern pattern{.length = 2, .angular_spacing = 30 * degree};
  std::vector<typename Geometry::Line> bars;
  std::vector<LiningSection> sections{LiningSection::rectangular(0.15, stiff * 25e9)};
  LiningFrame<Geometry> frame;
  if constexpr (Geometry::dim == 2) {
    bars = bolt_bars(pattern, small_opening<Geometry>());
    frame = lining_frame(tunnel.mass(), {.nodes = 24});
  } else {
    bars = bolt_bars(pattern, small_opening<Geometry>(), 1, 0, 3);
    frame = lining_frame(tunnel.mass(), LiningRibs{.ring = {.nodes = 24}, .spacing = 1});
    sections.assign(2, LiningSection::strip(0.15, 1, stiff * 25e9));
  }
  for (LiningSection& section : sections) section.mass = 360;
  for (const auto& bar : bars)
    tunnel.install_bolt(bar, AxialBolt({.axial_stiffness = stiff * 2e8}));
  tunnel.install_lining(frame, sections, CoulombJoint({stiff * 5e9, stiff * 5e8, 30 * degree}));
  REQUIRE(
      tunnel.equilibrium(0, {}, {.error_estimate = 1e-6, .unbalance_over_weight = 1e-5}).verdict ==
      Verdict::stable);
  return tunnel;
}

template <class Tunnel>
[[nodiscard]] double unbalance(Tunnel& tunnel) {
  return tunnel.out_of_balance_ratio();
}
template <class Tunnel>
[[nodiscard]] double farthest(const Tunnel& tunnel, const Eigen::VectorXd& from) {
  const auto& system = tunnel.system();
  double most = 0;
  for (int b = 0; b < system.body_count(); ++b)
    most = std::max(most, (part<Tunnel::dim>(system.displacement, Tunnel::dof * b) -
                           part<Tunnel::dim>(from, Tunnel::dof * b))
                              .norm());
  return most;
}

}  // namespace

TEST_SUITE("dynamics/set_in_motion") {
  TEST_CASE_TEMPLATE("where nothing slips, equilibrium at rest is equilibrium in motion", Geometry,
                     Planar, Spatial) {
    auto tunnel = supported<Geometry>(70 * degree);
    const Eigen::VectorXd u = tunnel.system().displacement;
    const double largest = tunnel.system().largest_translation(u);
    auto run = set_in_motion(tunnel, damped);
    REQUIRE(run.body_count() == tunnel.system().body_count());
    // Turned by 1e-4 over a metre: the square of it is 1e-8 m, on a square metre of joint with
    // 5 GPa/m some 50 N and ten contacts a block, where nodes of the lining weigh 2 kN. 0.08 to
    // 0.32 are seen.
    const double second_order = run.unbalance_over_weight();
    CHECK(second_order < 0.5);
    // Ten times as stiff, a hundredth of the square with ten times the force; but in 3-D some
    // joints are pressed at an edge alone, and that is where the faces end now: first order there.
    CHECK(set_in_motion(supported<Geometry>(70 * degree, 10), damped).unbalance_over_weight() <
          (Geometry::dim == 2 ? 0.15 : 0.6) * second_order);
    run.advance_steps(1500);
    CHECK(run.unbalance_over_weight() < 0.02);
    tunnel.take_back(run);
    CHECK(farthest(tunnel, u) < 2e-3 * largest);
    CHECK(unbalance(tunnel) < 0.02);
    // And the search has next to nothing left to do.
    const Eigen::VectorXd back = tunnel.system().displacement;
    REQUIRE(tunnel.equilibrium().verdict == Verdict::stable);
    CHECK(farthest(tunnel, back) < 1e-3 * largest);
  }

  TEST_CASE_TEMPLATE("bolts and lining carry the same at rest, in motion and back at rest",
                     Geometry, Planar, Spatial) {
    auto tunnel = supported<Geometry>(35 * degree);
    const auto bolts = largest_bolt_forces(tunnel);
    const auto members = lining_members(tunnel);
    auto run = set_in_motion(tunnel, damped);
    run.advance_steps(10);
    const auto* const moving = run.supports().template first<BoltSet<Geometry::dim, AxialBolt>>();
    REQUIRE(moving != nullptr);
    const auto pulled =
        largest_bolt_forces(bolt_forces(run, *moving), static_cast<int>(bolts.size()));
    tunnel.take_back(run);
    const auto back = largest_bolt_forces(tunnel);
    const auto members_back = lining_members(tunnel);
    const double most = *std::max_element(bolts.begin(), bolts.end());
    REQUIRE(most > 1e3);
    for (std::size_t k = 0; k < bolts.size(); ++k) {
      // Ten steps of blocks that are out of balance by a fraction of their weight: micrometres of
      // some 0.2 mm between anchors.
      CHECK(std::abs(pulled[k] - bolts[k]) < 0.01 * most);
      CHECK(std::abs(back[k] - pulled[k]) < 1e-6 * most);
    }
    double thrust = 0;
    for (const auto& m : members) thrust = std::max(thrust, m.thrust);
    REQUIRE(thrust > 1e4);
    for (std::size_t k = 0; k < members.size(); ++k)
      CHECK(std::abs(members_back[k].thrust - members[k].thrust) < 0.01 * thrust);
  }

  TEST_CASE("a run that unloads the wall ends where the search does") {
    // Without slip. With friction of 70 degrees one loose block at the wall comes to rest 0.04 to
    // 0.17 mm from where the search leaves it, and stays there: it has several places to lie.
    Solver<> moved(small_rock<Planar>(), CoulombJoint({5e9, 5e8, 89.9 * degree}), small_in_situ),
        sought = moved;
    for (Solver<>* tunnel : {&moved, &sought}) tunnel->excavate(small_opening<Planar>(), 0.02);
    auto run = set_in_motion(moved, {.local_damping = 0.8});
    CHECK(run.held() == 1);
    CHECK(run.unbalance_over_weight() < 1e-6);  // in-situ stress, all of the wall held
    for (int k = 1; k <= 8; ++k) {
      run.set_held(1 - k / 8.0);
      run.advance_steps(800);
    }
    moved.take_back(run);
    CHECK(moved.wall_fractions() == std::vector<double>{0});
    REQUIRE(sought.equilibrium().verdict == Verdict::stable);
    const double largest = sought.system().largest_translation(sought.system().displacement);
    // 0.13 mm are seen, 9 %, of one loose block at the wall, which stays there after the search has
    // gone on: joints open and close again on the way.
    CHECK(farthest(moved, sought.system().displacement) < 0.12 * largest);
    REQUIRE(moved.equilibrium().verdict == Verdict::stable);
    CHECK(farthest(moved, sought.system().displacement) < 0.12 * largest);
  }

  TEST_CASE("a run is composed of the policies of its solver, whatever their order") {
    using Run = RunOf<Solver<Spatial, MohrCoulombJoint, AnalyticCentre>>;
    CHECK(std::is_same_v<Run, RunOf<Solver<AnalyticCentre, Spatial, MohrCoulombJoint>>>);
    CHECK(std::is_same_v<Run, Dynamics<3, MohrCoulombJoint, CoulombJoint, AnalyticCentre>>);
    CHECK(std::is_same_v<RunOf<Solver<>>, Dynamics<2, CoulombJoint>>);
  }

  TEST_CASE(
      "bodies without shape cannot move; a lining without mass is as inert as a light block") {
    System<Planar> system(CoulombJoint({5e9, 5e8, 0.6}), 5e9);
    CHECK_THROWS_AS((void)set_in_motion(system, damped), InvalidInput);
    Solver<> tunnel(small_rock<Planar>(), CoulombJoint({5e9, 5e8, 0.6}), small_in_situ);
    tunnel.excavate(small_opening<Planar>(), 0.02);
    tunnel.install_lining(lining_frame(tunnel.mass(), {.nodes = 24}),
                          LiningSection::rectangular(0.15, 25e9), CoulombJoint({5e9, 5e8, 0.6}));
    auto run = set_in_motion(tunnel, damped);
    const auto& rest = tunnel.system();
    const int node = tunnel.first_lining_node();
    CHECK(rest.body(node).weight == 0);
    CHECK(run.body(node).mass * 9.81 == voussoir_test::near(rest.weight_scale().weight));
    // It still has no weight: in rock that is held in balance it does not fall.
    run.advance_steps(50);
    for (int n = node; n < run.body_count(); ++n)
      CHECK(run.velocity(n).norm() < 1e-3 * 9.81 * run.time());
  }
}

}  // namespace set_in_motion_test
