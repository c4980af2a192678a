// SPDX-License-Identifier: MIT
// Two arcs of shotcrete without bond and a gap between them at the crown, in rock that does not
// hold: what falls, and whether the arcs slide off, by every procedure and by all bodies in motion.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/set_in_motion.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"

namespace gapped_lining_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;

namespace {

constexpr double collapse = 3;  // [m^2]

struct Outcome {
  std::string verdict;
  std::vector<int> fallen, lost_nodes;  ///< in the order of their numbers
  bool operator==(const Outcome&) const = default;
};

template <class Method>
Solver<Method> tunnel(int seed, double friction) {
  const auto opening = circular_opening(4, 24);
  Solver<Method> made(
      jointed_rock(domain_around(opening, 14, 5, 5), static_cast<std::uint64_t>(seed)),
      CoulombJoint({5e9, 1e9, friction}), {.density = 2700, .k0 = 1});
  made.excavate(opening);
  for (const auto& [from, to] : {std::pair{0.0, 80.0}, {100.0, 180.0}})
    made.install_lining(
        lining_frame(made.mass(), {.nodes = 48, .from = from * degree, .to = to * degree}),
        LiningSection::rectangular(0.1, 25e9), CoulombJoint({1e9, 1e9, 25 * degree}));
  return made;
}

template <class Method>
std::pair<Outcome, EquilibriumReport> outcome_of(int seed, double friction) {
  auto rock = tunnel<Method>(seed, friction);
  EquilibriumReport report = rock.equilibrium(0, Method(), {.collapse_measure = collapse});
  Outcome outcome{to_string(report), report.fallen, report.lost_nodes};
  std::sort(outcome.fallen.begin(), outcome.fallen.end());
  std::sort(outcome.lost_nodes.begin(), outcome.lost_nodes.end());
  return {outcome, report};
}

/// All bodies, as inert as they are; a block, or an arc, that has moved further than the limit is
/// taken out.
Outcome in_motion(int seed, double friction, double limit) {
  const auto rock = tunnel<TwoLevel>(seed, friction);
  auto run = set_in_motion(rock, {.local_damping = 0.7});
  const double duration = 2 * std::sqrt(2 * limit / 9.81);
  Outcome outcome;
  double area = 0;
  while (run.time() < 30) {
    const double done = std::min(run.time() / duration, 1.0);
    run.set_held(1 - done);
    run.advance_steps(50);
    std::vector<int> off;
    bool rests = done == 1 && run.unbalance_over_weight() < 1e-2;
    const auto has_left = [&](int b) {
      return run.body(b).movable() &&
             (run.position(b) - rock.system().body(b).centre).norm() > limit;
    };
    for (int b = 0; b < run.body_count(); ++b) {
      rests = rests && (!run.body(b).movable() || run.velocity(b).norm() * 2 < limit);
      if (!rock.system().body(b).is_block || !has_left(b)) continue;
      off.push_back(b);
      outcome.fallen.push_back(b);
      area += rock.mass().bodies[static_cast<std::size_t>(b)].properties.measure;
    }
    for (const auto* lining : rock.linings()) {
      const int first = lining->first_node(), end = first + lining->node_count();
      bool is_lost = false;
      for (int b = first; b < end; ++b) is_lost = is_lost || has_left(b);
      for (int b = first; is_lost && b < end; ++b) {
        off.push_back(b);
        outcome.lost_nodes.push_back(b);
      }
    }
    run.remove(off);
    if (!rests && area <= collapse) continue;
    outcome.verdict = to_string(area > collapse ? Verdict::collapse : Verdict::stable, area,
                                !outcome.lost_nodes.empty());
    std::sort(outcome.fallen.begin(), outcome.fallen.end());
    std::sort(outcome.lost_nodes.begin(), outcome.lost_nodes.end());
    return outcome;
  }
  return {"undecided", {}, {}};
}

}  // namespace

TEST_SUITE("solver/gapped_lining") {
  // Seeds whose verdict is the same however the compiler rounds; of 16 tried, six lose an arc or
  // not, or another block, by that. Seed 3 at 20 degrees is another close call: its arc rests, by
  // the damping, at 0.88 to 0.97 of the limit, or comes off.
  TEST_CASE("arcs that nothing holds are lost, by every procedure and in motion alike") {
    using Case = std::tuple<int, double, std::string>;
    for (const auto& [seed, friction, verdict] :
         {Case{7, 20 * degree, "stable without its lining"},
          Case{4, 20 * degree, "stable without its lining"}, Case{6, 20 * degree, "collapse"},
          Case{6, 30 * degree, "stable"}}) {
      CAPTURE(seed);
      CAPTURE(verdict);
      const auto [two_level, report] = outcome_of<TwoLevel>(seed, friction);
      CHECK(two_level.verdict == verdict);
      CHECK(outcome_of<Relaxation>(seed, friction).first == two_level);
      CHECK(outcome_of<Explicit>(seed, friction).first == two_level);
      // In a collapse what is counted at its end hangs on when one looks.
      const Outcome moved = in_motion(seed, friction, report.displacement_limit);
      CHECK(moved.verdict == two_level.verdict);
      if (verdict != "collapse") CHECK(moved == two_level);
      // An arc goes as a whole, and the sentence says so.
      CHECK(two_level.lost_nodes.size() % 11 == 0);  // nodes of either arc
      if (two_level.verdict == "stable without its lining") {
        CHECK_FALSE(two_level.lost_nodes.empty());
        CHECK(report.reason.find("the lining comes off the wall") != std::string::npos);
      }
    }
  }
}

}  // namespace gapped_lining_test
