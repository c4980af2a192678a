// SPDX-License-Identifier: MIT
// Contact updates of whole tunnels: where nothing has moved far, nothing may change.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/model/contact_update.hpp>

#include "support/bolted_tunnel.hpp"
#include "support/jointed_mass.hpp"

namespace found_again_test {

using namespace voussoir_test;
using voussoir::find_contacts_again;

namespace {

template <class Tunnel>
double unbalance(Tunnel& tunnel) {
  Eigen::VectorXd f;
  tunnel.system().forces(tunnel.system().displacement, f);
  return tunnel.system().unbalance_over_weight(f);
}

}  // namespace

TEST_SUITE("model/contact_update") {
  TEST_CASE("rock in its in-situ stress stays in equilibrium, whatever the reach") {
    // Facets come from the detector instead of the cuts: they differ by its tolerance, 1e-8 m. In
    // 3-D it also finds slivers along edges, 2e-5 of the area, that no cut was made for.
    for (const double reach : {1e-6, 0.04}) {
      Solver<> tunnel = bolted_tunnel();
      const std::size_t before = tunnel.system().joints.contacts().size();
      find_contacts_again(tunnel.system(), reach);
      CHECK(tunnel.system().joints.contacts().size() >= before);
      CHECK(unbalance(tunnel) <= 1e-7);
      Solver<Spatial> rock(jointed_mass({{-5, 0, -5}, {5, 4, 5}}, 1, 1.5),
                           CoulombJoint({5e9, 5e8, 35 * degree}), {.density = 2700, .k0 = 1.2});
      find_contacts_again(rock.system(), reach);
      CHECK(unbalance(rock) <= 5e-5);
    }
  }

  TEST_CASE("an equilibrium stays where it is") {
    Solver<> tunnel = bolted_tunnel();
    CHECK(find(tunnel, TwoLevel{}).verdict == Verdict::stable);
    for (const double reach : {1e-3, 0.04}) {
      find_contacts_again(tunnel.system(), reach);
      CHECK(tunnel.system().has_found_again());
      CHECK(find(tunnel, TwoLevel{}).verdict == Verdict::stable);
      CHECK(error_of(tunnel) <= 1e-3);  // the error estimate of a search; measured 1.3e-4
    }
  }

  TEST_CASE("what a joint remembers goes with its points") {
    // Slips are made by a displacement that is then taken back: their forces are all that is left.
    // Without the memory of the points the rock would be in its in-situ equilibrium.
    Solver<> tunnel = bolted_tunnel();
    auto& system = tunnel.system();
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
    find_contacts_again(system, 1e-6);
    system.forces(system.displacement, after);
    // Facets come from the detector, up to 1e-8 m off those of the cuts, which are 0.1 to 1 m long.
    CHECK((after - before).norm() <= 1e-7 * (before - in_situ).norm());
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
    CHECK_THROWS_AS(find_contacts_again(after.system(), 0.04, [](double) { return false; }),
                    Stopped);
    const auto &old = before.system(), &now = after.system();
    CHECK(!now.has_found_again());
    CHECK(now.displacement == old.displacement);
    REQUIRE(now.joints.points().size() == old.joints.points().size());
    REQUIRE(now.joints.contacts().size() == old.joints.contacts().size());
    for (std::size_t k = 0; k < old.joints.contacts().size(); ++k) {
      const auto &x = old.joints.contacts()[k], &y = now.joints.contacts()[k];
      CHECK((x.a == y.a && x.b == y.b && x.first == y.first && x.last == y.last));
      CHECK(x.arm_a == y.arm_a);
    }
    find_contacts_again(after.system(), 0.04, [](double) { return true; });
    CHECK(now.has_found_again());
  }

  TEST_CASE("limits out of range are refused") {
    Solver<> tunnel = bolted_tunnel();
    for (const Acceptance& bad :
         {Acceptance{.error_estimate = 0}, Acceptance{.unbalance_over_weight = -1},
          Acceptance{.displacement_limit = 0}, Acceptance{.refind_limit = 0},
          Acceptance{.collapse_measure = -1}})
      CHECK_THROWS_AS((void)tunnel.equilibrium(0, TwoLevel{}, bad), InvalidInput);
  }

  TEST_CASE("to update them often during the search changes nothing") {
    for (const double limit : {1e-3, 2e-4}) {
      CAPTURE(limit);
      Solver<> tunnel = bolted_tunnel();
      const auto report = tunnel.equilibrium(0, TwoLevel{}, {.refind_limit = limit});
      CHECK(report.verdict == Verdict::stable);
      CHECK(report.factorisations > 1);
      CHECK(error_of(tunnel) <= 1e-3);  // as above; measured 1.9e-4
      CHECK(std::abs(crown_ratio(tunnel) - 1) <= 1e-3);
    }
  }
}

}  // namespace found_again_test
