// SPDX-License-Identifier: MIT
// The other joint laws and linings in whole tunnels: convergence against time, cohesion that is
// lost, roughness, membranes and bonded chains.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/contact/burgers_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/lining/beams.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/solver/creep.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace joint_laws_long {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;

namespace {

template <class Tunnel, class Law>
Tunnel tunnel_with(const Law& law) {
  const SimplePolygon outline = circular_opening(5, 36);
  Tunnel tunnel(jointed_rock(domain_around(outline, 30, 10, 12), 1, {0.3, 5}), law,
                {.density = 2700, .surcharge = 3e5});
  tunnel.excavate(outline, 0.05);
  return tunnel;
}
template <class Tunnel>
double crown(const Tunnel& tunnel) {
  return convergence(tunnel).crown;
}
/// The crown of a lined tunnel and the mean thrust of its members.
struct Lined {
  double crown, thrust;
};
template <class Lining>
Lined lined() {
  using Tunnel = Solver<Lining>;
  auto tunnel = tunnel_with<Tunnel>(CoulombJoint({5e9, 5e8, 35 * degree}));
  tunnel.install_lining(lining_frame(tunnel.mass(), {.nodes = 72}),
                        LiningSection::rectangular(0.1, 25e9),
                        CoulombJoint({1e10, 1e10, 30 * degree}));
  const auto report = tunnel.equilibrium();
  CHECK(report.verdict == Verdict::stable);
  double sum = 0;
  for (const auto& frame : tunnel.lining()->members())
    sum += frame.end_forces(tunnel.system().displacement.data())[0];
  return {crown(tunnel), sum / static_cast<double>(tunnel.lining()->members().size())};
}

}  // namespace

TEST_SUITE("solver/joint_laws_long") {
  TEST_CASE("a creeping tunnel closes with time, and comes to rest where creep is delayed only") {
    using Tunnel = Solver<BurgersJoint>;
    constexpr double day = 86400, infinite = std::numeric_limits<double>::infinity();
    // Kelvin's spring as stiff as the joint's: in the end every stuck joint has twice its slip.
    const BurgersJoint law({.joint_normal_stiffness = 5e9,
                            .joint_shear_stiffness = 5e8,
                            .friction_angle = 60 * degree,
                            .maxwell_viscosity = infinite,
                            .kelvin_stiffness = 5e8,
                            .kelvin_viscosity = 5e8 * 10 * day});
    auto tunnel = tunnel_with<Tunnel>(law);
    REQUIRE(tunnel.equilibrium().verdict == Verdict::stable);
    const double before = crown(tunnel);
    std::vector<double> times, crowns;
    const auto states = creep(tunnel, 60 * day, [&](const auto& state) {
      times.push_back(state.time);
      crowns.push_back(crown(tunnel));
      return true;
    });
    REQUIRE(states.size() == times.size());
    CHECK(times.back() == 60 * day);
    for (std::size_t k = 1; k < crowns.size(); ++k) CHECK(crowns[k] > crowns[k - 1] - 1e-7);
    // The end is that of a joint half as stiff in shear from the beginning, the in-situ stress
    // apart, which has crept before: K0 = 1 leaves no shear in it.
    auto soft = tunnel_with<Solver<>>(CoulombJoint({5e9, 2.5e8, 60 * degree}));
    REQUIRE(soft.equilibrium().verdict == Verdict::stable);
    CHECK(crowns.back() > 1.1 * before);
    CHECK(crowns.back() == voussoir_test::near(crown(soft)).epsilon(0.02));
    CHECK_THROWS_AS((void)creep(tunnel, 0, [](const auto&) { return true; }), InvalidInput);
  }

  TEST_CASE("cohesion holds the crown up; where it is lost the crown comes down with the rest") {
    const auto moved = [](const MohrCoulombJoint::Params& params) {
      auto tunnel = tunnel_with<Solver<MohrCoulombJoint>>(MohrCoulombJoint(params));
      const auto report = tunnel.equilibrium();
      CHECK(report.verdict == Verdict::stable);
      int failed = 0;
      for (const auto& p : tunnel.system().joints.points())
        failed += p.history<MohrCoulombJoint>().failed;
      return std::pair{crown(tunnel), failed};
    };
    auto plain = tunnel_with<Solver<>>(CoulombJoint({5e9, 5e8, 30 * degree}));
    REQUIRE(plain.equilibrium().verdict == Verdict::stable);
    const auto same = moved({5e9, 5e8, 30 * degree});
    CHECK(same.first == voussoir_test::near(crown(plain)).epsilon(2e-3));
    const auto strong = moved({5e9, 5e8, 30 * degree, 1e6, 1e6});
    CHECK(strong.first < 0.97 * same.first);
    CHECK(strong.second == 0);
    // Brittle: some joints reach 50 kPa and drop to friction alone.
    const auto brittle = moved({5e9, 5e8, 30 * degree, 5e4, 5e4});
    CHECK(brittle.second > 0);
    CHECK(brittle.second < same.second);
    CHECK(brittle.first > strong.first);
    CHECK(brittle.first < same.first * 1.01);
  }

  TEST_CASE("a Barton-Bandis tunnel stands, and moves more where joints are softer") {
    const auto moved = [](double stiffness) {
      auto tunnel = tunnel_with<Solver<BartonBandisJoint>>(
          BartonBandisJoint({.roughness = 8,
                             .wall_strength = 80e6,
                             .residual_friction_angle = 28 * degree,
                             .initial_stiffness = stiffness,
                             .maximum_closure = 3e-4,
                             .sample_length = 0.1,
                             .joint_length = 0.5,
                             .largest_stress = 2e6}));
      CHECK(tunnel.equilibrium().verdict == Verdict::stable);
      return crown(tunnel);
    };
    CHECK(moved(5e9) > moved(20e9));
  }

  TEST_CASE("a chain of bonds is a Timoshenko ring; pinned bars carry the thrust of one") {
    const Lined beam = lined<TimoshenkoBeam>(), chain = lined<BondedChain>(),
                pinned = lined<PinnedBar>();
    CHECK(chain.crown == voussoir_test::near(beam.crown).epsilon(5e-3));
    CHECK(chain.thrust == voussoir_test::near(beam.thrust).epsilon(5e-3));
    CHECK(pinned.thrust == voussoir_test::near(beam.thrust).epsilon(0.03));
    // A ring of 5 m and 10 cm has little bending to lose.
    CHECK(pinned.crown == voussoir_test::near(beam.crown).epsilon(0.03));
  }
}

}  // namespace joint_laws_long
