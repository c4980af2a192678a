// SPDX-License-Identifier: MIT
// The laws of docs/write-your-own.md, taken from the page when this was configured, in a solver.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/io/tunnel_picture.hpp>
#include <voussoir/io/tunnel_tables.hpp>
#include <write_your_own.hpp>

#include "io/xml_check.hpp"
#include "support/jointed_rock.hpp"

namespace write_your_own_long {

using voussoir_test::degree;

namespace {

/// A 5 m opening in some 500 blocks.
template <class Tunnel, class Law>
Tunnel excavated(const Law& law) {
  const auto opening = circular_opening(5, 36);
  Tunnel tunnel(voussoir_test::jointed_rock(domain_around(opening, 25, 10, 10), 2), law,
                {.density = 2700});
  tunnel.excavate(opening);
  return tunnel;
}

}  // namespace

TEST_SUITE("solver/write_your_own_long") {
  TEST_CASE("the joint law of the page carries a tunnel; without teeth it is CoulombJoint") {
    const CoulombJoint plain({5e9, 5e8, 35 * degree});
    auto rough = excavated<RoughTunnel>(PattonJoint({5e9, 5e8, 35 * degree, 10 * degree, 1e5}));
    CHECK(rough.equilibrium().verdict == Verdict::stable);

    // One point, pressed shut and slid far beyond its strength, then back.
    const PattonJoint smooth({5e9, 5e8, 35 * degree, 0, 0});
    PattonJoint::State<2> ours;
    CoulombJoint::State<2> theirs;
    for (const double slip : {1e-5, 2e-3, 1e-3, -1e-3}) {
      const PointLoad<2> load{0.4, {1e5, Vec<1>(2e4)}, {-1e-5, Vec<1>(slip)}};
      const PointForce<2> a = smooth.force(load, ours), b = plain.force(load, theirs);
      CHECK(a.normal == b.normal);
      CHECK(std::abs(a.tangential[0] - b.tangential[0]) <= 1e-12 * b.normal);
      smooth.commit(load, ours);
      plain.commit(load, theirs);
      // It says nothing of itself: its force tells the slip that it remembers. Slips of 2 mm.
      const ContactReport told = report_of(smooth, load, ours);
      CHECK(std::abs(told.plastic_slip - ours.plastic_slip.norm()) <= 1e-17);
      CHECK(told.is_slipping == report_of(plain, load, theirs).is_slipping);
      CHECK(std::abs(smooth.force(load, ours).tangential[0] - a.tangential[0]) <= 1e-12 * b.normal);
    }
  }

  TEST_CASE("the laws of the page are sound, in 3-D too") {
    for (const auto& faults :
         {faults_of_this_page(), check_law<3>(PattonJoint({5e9, 5e8, 0.6, 0.17, 1e5})),
          check_law<3>(FrictionBolt({2e8, 1e5}))})
      for (const std::string& fault : faults) FAIL_CHECK(fault);
  }

  TEST_CASE("the bolt law of the page holds a tunnel, and slides at its grip") {
    const auto hold = [](double grip) {
      auto tunnel = excavated<BoltedTunnel>(CoulombJoint({5e9, 5e8, 35 * degree}));
      const BoltPattern pattern{
          .length = 3, .angular_spacing = 22.5 * degree, .from = 0, .to = 180 * degree};
      for (const auto& bar : bolt_bars(pattern, circular_opening(5, 36)))
        tunnel.install_bolt(bar, FrictionBolt({2e8, grip}));
      CHECK(tunnel.equilibrium().verdict != Verdict::undecided);
      const std::vector<double> forces = largest_bolt_forces(tunnel);
      int sliding = 0;
      for (const CrossingForce& c : bolt_forces(tunnel)) {
        CHECK(c.report.has_yielded() == (c.report.plastic_extension > 0));
        if (c.report.is_yielding) CHECK(c.report.axial >= (1 - 1e-9) * grip);
        sliding += c.report.is_yielding;
      }
      CHECK((sliding > 0) == (longest_slide(tunnel) > 0));
      const TunnelState<Planar> state = state_of(tunnel);
      const auto bars = bolt_bars(pattern, circular_opening(5, 36));
      const std::string table = bolt_table(state.bolts, bars);
      CHECK((table.find("yielded") != std::string::npos) == (sliding > 0));
      const BlocksPicture picture = picture_of(state, tunnel.mass(), bars);
      int marked = 0;
      for (const PictureBolt& bolt : picture.bolts)
        for (const PictureCrossing& c : bolt.crossings)
          marked += c.state == PictureCrossing::State::yielded;
      CHECK((marked > 0) == (sliding > 0));
      CHECK(xml_fault(draw_blocks_picture(picture)) == "");
      return *std::max_element(forces.begin(), forces.end());
    };
    const double strong = hold(1e6);
    CHECK(strong > 1e3);
    CHECK(strong < 1e6);
    CHECK(hold(0.5 * strong) == 0.5 * strong);
  }
}

}  // namespace write_your_own_long
