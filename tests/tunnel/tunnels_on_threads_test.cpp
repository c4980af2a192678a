// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstddef>
#include <vector>
#include <voussoir/tunnel/interaction_diagram.hpp>
#include <voussoir/tunnel/lining_ring.hpp>

#include "support/bolted_tunnel.hpp"

namespace tunnels_on_threads_test {

namespace {

using namespace voussoir_test;

/// A diagram as the program computes it: every tunnel is a copy of one that is excavated already.
std::vector<DiagramPoint> diagram(unsigned threads) {
  const Solver<>& excavated = bolted_tunnel();
  return interaction_diagram(2, 2, threads, [&](std::size_t i, std::size_t j) {
    Solver<> tunnel = excavated;
    tunnel.install_lining(
        lining_frame(tunnel.mass(), {}),
        LiningSection::rectangular(0.05 * static_cast<double>(j + 1), i == 0 ? 25e9 : 15e9),
        CoulombJoint({1e9, 1e9, 30 * degree}));
    DiagramPoint point{};
    point.report = tunnel.equilibrium();
    point.crown_convergence = convergence(tunnel).crown;
    return point;
  });
}

}  // namespace

TEST_SUITE("tunnel/tunnels_on_threads") {
  TEST_CASE("tunnels in the same rock, computed on two threads, have the bits of one thread") {
    const auto one = diagram(1), two = diagram(2);
    for (std::size_t k = 0; k < 4; ++k) {
      REQUIRE(one[k].report.verdict == Verdict::stable);
      CHECK(one[k].crown_convergence > 1e-4);
      CHECK(two[k].crown_convergence == one[k].crown_convergence);  // bit for bit
      CHECK(two[k].report.error_estimate == one[k].report.error_estimate);
    }
    CHECK(one[0].crown_convergence != one[3].crown_convergence);
  }
}

}  // namespace tunnels_on_threads_test
