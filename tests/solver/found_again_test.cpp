// SPDX-License-Identifier: MIT
// Contact updates of whole tunnels: where nothing has moved far, nothing may change.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/solver/found_again.hpp>

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

TEST_SUITE("solver/found_again") {
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
