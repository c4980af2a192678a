// SPDX-License-Identifier: MIT
// Contact updates of whole tunnels: where nothing has moved far, nothing may change.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/equilibrium/update_when_due.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/model/contact_update.hpp>
#include <voussoir/model/point_loads.hpp>

#include "support/bolted_tunnel.hpp"
#include "support/jointed_mass.hpp"
#include "support/near.hpp"

namespace found_again_test {

using namespace voussoir_test;
using voussoir::update_contacts;

namespace {

template <class Tunnel>
double unbalance(Tunnel& tunnel) {
  return tunnel.out_of_balance_ratio();
}

/// Which points are of contacts that are open by more than the reach wherever they are, and of
/// these which carry on none of the contacts before: none of the same two bodies, turned by less
/// than 60 degrees, had a point there, as near as one point's share of the area is long.
/// @param moved  by how much points have moved against their bodies' centres at most [m]
struct OpenPoints {
  int all = 0, new_ones = 0;
};

template <class Group>
OpenPoints open_points(const Group& now, const Eigen::VectorXd& u, const Group& before,
                       double reach, double moved) {
  constexpr int dim = Group::dim;
  OpenPoints open;
  for (const auto& c : now.contacts()) {
    std::vector<double> pressed_in;
    for (const auto& p : now.points_of(c))
      pressed_in.push_back(-c.motion(p, c.offset_of(p), u.data()).opening);
    const double deepest = pressed_in.size() == PressedPart<dim>::count
                               ? PressedPart<dim>::deepest(pressed_in.data(), c.outline)
                               : *std::max_element(pressed_in.begin(), pressed_in.end());
    if (deepest >= -1.001 * reach) continue;  // the reach itself is met to rounding
    for (int k = c.first; k < c.last(); ++k) {
      const auto& p = now.points()[static_cast<std::size_t>(k)];
      ++open.all;
      bool known = false;
      for (const auto& old : before.contacts()) {
        if (std::minmax(old.a, old.b) != std::minmax(c.a, c.b)) continue;
        const bool same = old.a == c.a;
        if ((same ? 1 : -1) * old.normal.dot(c.normal) < 0.5) continue;
        const Vec<dim> arm = (same ? c.arm_a : c.arm_b) + c.offset_of(p);
        for (int l = old.first; l < old.last(); ++l) {
          const auto& q = before.points()[static_cast<std::size_t>(l)];
          Vec<dim> way = old.arm_a + old.offset_of(q) - arm;
          way -= way.dot(c.normal) * c.normal;
          known = known || way.norm() <= std::pow(q.weight, 1.0 / (dim - 1)) + moved;
        }
      }
      open.new_ones += !known;
    }
  }
  return open;
}

template <class Group>
double stored_energy(const Group& group, const double* u) {
  double sum = 0;
  group.visit(u, [&](const auto& c, const auto& p, const auto& load, const auto&) {
    sum += group.law_of(c).stored_energy(load, p.state);
  });
  return sum;
}

/// Moves and turns every movable body at random, by up to these amounts [m], [rad].
template <class System>
void shake(System& system, std::uint64_t seed, double shift, double turn) {
  constexpr int dim = System::dim, dof = System::dof;
  Random random(seed);
  for (int b = 0; b < system.body_count(); ++b)
    for (int k = 0; k < dof; ++k) {
      const double amount = (k < dim ? shift : turn) * (2 * random.uniform() - 1);
      if (system.body(b).movable) system.displacement[dof * b + k] += amount;
    }
}

}  // namespace

TEST_SUITE("model/contact_update") {
  TEST_CASE("no contact point is made where two blocks are open beyond the reach") {
    // Blocks that share an edge only, with another one between them, or whose corners look past
    // each other, would have contacts that gape by decimetres.
    for (const double turn : {1e-3, 0.03}) {
      CAPTURE(turn);
      Solver<> tunnel = bolted_tunnel();
      Solver<Spatial> rock(jointed_mass({{-5, 0, -5}, {5, 4, 5}}, 1, 1.5),
                           CoulombJoint({5e9, 5e8, 35 * degree}), {.density = 2700, .k0 = 1.2});
      const auto check = [&](auto& system) {
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
          const auto before = system.joints;
          shake(system, seed, 2e-3, turn);
          update_contacts(system, 0.02);
          const OpenPoints open =
              open_points(system.joints, system.displacement, before, 0.02, 0.01 + 3 * turn);
          CAPTURE(seed);
          CHECK(open.new_ones == 0);
          CHECK(open.all < static_cast<int>(system.joints.points().size()) / 2);
        }
      };
      check(detail::SystemOf::in(tunnel));
      check(detail::SystemOf::in(rock));
    }
  }

  TEST_CASE("rock in its in-situ stress stays in equilibrium, whatever the reach") {
    // Facets come from the detector instead of the cuts: they differ by its tolerance, 1e-8 m. In
    // 3-D it also finds slivers along edges, 2e-5 of the area, that no cut was made for.
    for (const double reach : {1e-6, 0.04}) {
      Solver<> tunnel = bolted_tunnel();
      const std::size_t before = tunnel.system().joints.contacts().size();
      update_contacts(detail::SystemOf::in(tunnel), reach);
      CHECK(tunnel.system().joints.contacts().size() >= before);
      CHECK(unbalance(tunnel) <= 1e-7);
      Solver<Spatial> rock(jointed_mass({{-5, 0, -5}, {5, 4, 5}}, 1, 1.5),
                           CoulombJoint({5e9, 5e8, 35 * degree}), {.density = 2700, .k0 = 1.2});
      update_contacts(detail::SystemOf::in(rock), reach);
      CHECK(unbalance(rock) <= 5e-5);
    }
  }

  TEST_CASE("an equilibrium stays where it is") {
    Solver<> tunnel = bolted_tunnel();
    CHECK(find(tunnel, TwoLevel{}).verdict == Verdict::stable);
    for (const double reach : {1e-3, 0.04}) {
      update_contacts(detail::SystemOf::in(tunnel), reach);
      CHECK(tunnel.system().has_updated_contacts());
      CHECK(find(tunnel, TwoLevel{}).verdict == Verdict::stable);
      CHECK(error_of(tunnel) <= 1e-3);  // the error estimate of a search; measured 1.3e-4
    }
  }

  TEST_CASE("an update that moves nothing changes no force and makes no energy") {
    // A first one takes up where the blocks are; the next finds the same faces again.
    double worst = 0;
    for (const double turn : {0.0, 1e-3, 0.03}) {
      CAPTURE(turn);
      Solver<> tunnel = bolted_tunnel();
      Solver<Spatial> rock(jointed_mass({{-5, 0, -5}, {5, 4, 5}}, 1, 1.5),
                           CoulombJoint({5e9, 5e8, 35 * degree}), {.density = 2700, .k0 = 1.2});
      const auto check = [&](auto& system, std::uint64_t seed) {
        CAPTURE(seed);
        shake(system, seed, 1e-3, turn);
        update_contacts(system, 0.02);
        system.commit();
        shake(system, seed + 10, 2e-4, 0.01 * turn);
        update_contacts(system, 0.02);
        system.commit();
        Eigen::VectorXd before, after;
        system.forces(system.displacement, before);
        double force = 0;
        const double* const u = system.displacement.data();
        system.joints.visit(u, [&](const auto&, const auto&, const auto&, const auto& f) {
          force = std::max(force, std::abs(f.normal) + f.tangential.norm());
        });
        const double stored = stored_energy(system.joints, u);
        const ContactUpdateReport report = update_contacts(system, 0.02);
        system.forces(system.displacement, after);
        const double jump = (after - before).cwiseAbs().maxCoeff() / force;
        worst = std::max(worst, jump);
        CHECK(report.count == 1);
        CHECK(jump <= 1e-9);
        CHECK(std::abs(report.energy) <= 1e-9 * stored);
        CHECK(report.largest_jump == system.unbalance_over_weight(after - before));
      };
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        check(detail::SystemOf::in(tunnel), seed);
        check(detail::SystemOf::in(rock), seed);
      }
    }
    MESSAGE("largest jump of a force over the largest contact force: ", worst);
  }

  TEST_CASE("an update after small movements hardly changes forces and energy") {
    // Openings are right but for half the square of 1e-4 rad times 1 m, 25 Pa of some 1e5 Pa. What
    // is left is shear: points that go elsewhere take the slip of the nearest. Measured: forces
    // 1.8e-4 in 2-D, 1.1e-2 in 3-D, energy 7e-5 and 9e-4. With the normals of two edges that decide
    // the depth between faces, forces in 3-D changed by 0.16 and the energy by 0.14.
    const auto check = [](auto system, double of_forces, double of_energy) {
      shake(system, 1, 2e-4, 1e-4);
      system.commit();
      Eigen::VectorXd before, after;
      system.forces(system.displacement, before);
      const double stored = stored_energy(system.joints, system.displacement.data());
      const ContactUpdateReport report = update_contacts(system, 0.02);
      system.forces(system.displacement, after);
      CHECK((after - before).norm() <= of_forces * before.norm());
      CHECK(std::abs(report.energy) <= of_energy * stored);
    };
    Solver<> tunnel = bolted_tunnel();
    check(tunnel.system(), 4e-4, 2e-4);
    Solver<Spatial> rock(jointed_mass({{-5, 0, -5}, {5, 4, 5}}, 1, 1.5),
                         CoulombJoint({5e9, 5e8, 35 * degree}), {.density = 2700, .k0 = 1.2});
    check(rock.system(), 0.02, 2e-3);
  }

  TEST_CASE("what a joint remembers goes with its points") {
    // Slips are made by a displacement that is then taken back: their forces are all that is left.
    // Without the memory of the points the rock would be in its in-situ equilibrium.
    Solver<> tunnel = bolted_tunnel();
    auto& system = detail::SystemOf::in(tunnel);
    Eigen::VectorXd in_situ, before, after;
    system.forces(system.displacement, in_situ);
    Random random(3);
    for (Eigen::Index k = 0; k < system.displacement.size(); ++k)
      if (k % 3 != 2 && system.body(static_cast<int>(k / 3)).movable)
        system.displacement[k] = 2e-3 * (random.uniform() - 0.5);
    system.commit();
    system.displacement.setZero();
    system.forces(system.displacement, before);
    REQUIRE((before - in_situ).norm() > 1e5);
    update_contacts(system, 1e-6);
    system.forces(system.displacement, after);
    // Facets come from the detector, up to 1e-8 m off those of the cuts, which are 0.1 to 1 m long.
    CHECK((after - before).norm() <= 1e-7 * (before - in_situ).norm());
  }

  TEST_CASE("the shear force of a contact that becomes two is that of both") {
    // A slit of 10 mm along the middle of a joint: its walls are no joint, but within reach.
    // Pressed down by 12 mm the upper block touches there as well, in a contact of its own that
    // carries on the one beside the slit.
    Solver<> rock(slice({{0, 0}, {4, 2}}, std::vector<Joint>{{{{-1, 1}, {5, 1}}, 0}}, {}),
                  CoulombJoint({1e7, 1e6, 60 * degree}, any_units), {.density = 2700});
    rock.excavate(SimplePolygon({{1.5, 1}, {2.5, 1}, {2.5, 1.01}, {1.5, 1.01}}));
    auto& system = detail::SystemOf::in(rock);
    const int upper = system.body(0).centre.y() > 1 ? 0 : 1;
    REQUIRE(system.body(upper).movable);
    system.displacement[3 * upper] = 1e-3;
    system.displacement[3 * upper + 1] = -0.012;
    system.commit();
    const auto shear = [&] {
      double sum = 0;  // of both blocks, whichever comes first in the contact
      system.joints.visit(
          system.displacement.data(),
          [&](const auto&, const auto&, const auto&, const auto& f) { sum += f.tangential[0]; });
      return sum;
    };
    const auto normal = [&] {
      double sum = 0;
      system.joints.visit(system.displacement.data(), [&](const auto&, const auto&, const auto&,
                                                          const auto& f) { sum += f.normal; });
      return sum;
    };
    REQUIRE(system.joints.contacts().size() == 1);
    const double before = shear();
    const auto energy = [&] { return stored_energy(system.joints, system.displacement.data()); };
    const double held = energy();
    // In its in-situ state there is none: it comes from 1 mm on the 3 m beside the slit.
    CHECK(std::abs(before) == near(1e6 * 3 * 1e-3));
    update_contacts(system, 0.02);
    REQUIRE(system.joints.contacts().size() == 2);
    CHECK(shear() == near(before).epsilon(1e-9));
    // What the second one is pressed in nobody has brought: both hold no more than the one did, and
    // later updates know that.
    CHECK(energy() <= (1 + 1e-12) * held);
    system.displacement[3 * upper + 1] -= 1e-4;
    const double pressed = normal(), deeper = energy();
    CHECK(deeper > 1.01 * held);
    update_contacts(system, 0.02);
    CHECK(normal() == near(pressed).epsilon(1e-9));
    CHECK(energy() == near(deeper).epsilon(1e-9));
  }

  TEST_CASE("an update that is stopped leaves everything as it was") {
    // 6 400 blocks: more than the 10 ms in which nothing is asked.
    std::vector<Joint> joints;
    for (int k = 1; k < 80; ++k) {
      joints.push_back({{{-1, k}, {81, k}}, 0});
      joints.push_back({{{k, -1}, {k, 81}}, 1});
    }
    const Solver<> before(slice({{0, 0}, {80, 80}}, joints, {}),
                          CoulombJoint({5e9, 5e8, 35 * degree}), {.density = 2700});
    Solver<> after = before;
    CHECK_THROWS_AS(
        update_contacts(detail::SystemOf::in(after), 0.04, [](double) { return false; }), Stopped);
    const auto &old = before.system(), &now = after.system();
    CHECK(!now.has_updated_contacts());
    CHECK(now.displacement == old.displacement);
    REQUIRE(now.joints.points().size() == old.joints.points().size());
    REQUIRE(now.joints.contacts().size() == old.joints.contacts().size());
    for (std::size_t k = 0; k < old.joints.contacts().size(); ++k) {
      const auto &x = old.joints.contacts()[k], &y = now.joints.contacts()[k];
      CHECK((x.a == y.a && x.b == y.b && x.first == y.first && x.count == y.count));
      CHECK(x.arm_a == y.arm_a);
    }
    update_contacts(detail::SystemOf::in(after), 0.04, [](double) { return true; });
    CHECK(now.has_updated_contacts());
  }

  TEST_CASE("limits out of range are refused") {
    Solver<> tunnel = bolted_tunnel();
    for (const Acceptance& bad :
         {Acceptance{.error_estimate = 0}, Acceptance{.unbalance_over_weight = -1},
          Acceptance{.displacement_limit = 0}, Acceptance{.contact_update_limit = 0},
          Acceptance{.collapse_measure = -1}})
      CHECK_THROWS_AS((void)tunnel.equilibrium(0, TwoLevel{}, bad), InvalidInput);
  }

  TEST_CASE("a limit so short that there is no end to updates is refused, and named") {
    // As if the 500 updates of a stage had been made; rock that fails takes some tens.
    Solver<> tunnel = bolted_tunnel();
    auto& system = detail::SystemOf::in(tunnel);
    shake(system, 1, 1e-4, 0);
    SearchContext context;
    context.acceptance = {.displacement_limit = 0.2, .contact_update_limit = 1e-5};
    EquilibriumReport report;
    CHECK(detail::update_when_due(system, context, report));
    CHECK(report.contact_updates.count == 1);
    shake(system, 2, 1e-4, 0);
    report.contact_updates.count = 500;
    CHECK_THROWS_WITH_AS(
        (void)detail::update_when_due(system, context, report),
        doctest::Contains("contact_update_limit of 1e-5 m: contacts have been updated 500 times"),
        InvalidInput);
    CHECK_THROWS_WITH_AS((void)detail::update_when_due(system, context, report),
                         doctest::Contains("a twentieth of the displacement limit, 0.01 m"),
                         InvalidInput);
  }

  TEST_CASE("updates make no energy, however short the way between them") {
    // Unsupported rock with updates at every 0.003 mm: springs only ever lose by them. Before they
    // were held to what the contact before had, they gained 2e9 J here.
    const auto opening = circular_opening(5, 36);
    Solver<> tunnel(jointed_rock(domain_around(opening, 30, 10, 8), 1),
                    CoulombJoint({5e9, 5e8, 30 * degree}), {.density = 2700});
    tunnel.excavate(opening);
    const auto report = tunnel.equilibrium(0, TwoLevel{}, {.contact_update_limit = 3e-6});
    CHECK(report.contact_updates.count > 5);
    CHECK(report.contact_updates.energy <= 0);
    // Rounding of what single contacts hold; 1e-21 J/m as it is.
    CHECK(report.contact_updates.made <= 1e-9);
  }

  TEST_CASE("to update them often during the search changes nothing") {
    for (const double limit : {1e-3, 2e-4}) {
      CAPTURE(limit);
      Solver<> tunnel = bolted_tunnel();
      const auto report = tunnel.equilibrium(0, TwoLevel{}, {.contact_update_limit = limit});
      CHECK(report.verdict == Verdict::stable);
      CHECK(report.factorisations > 1);
      CHECK(error_of(tunnel) <= 1e-3);  // as above; measured 1.9e-4
      CHECK(std::abs(crown_ratio(tunnel) - 1) <= 1e-3);
    }
  }
}

}  // namespace found_again_test
