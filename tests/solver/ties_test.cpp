// SPDX-License-Identifier: MIT
// Tunnels whose joints end on corners and lie on planes of symmetry, so that roundings would have a
// word wherever something is chosen: moved by a nanometre, to another site grid, mirrored, their
// traces in pieces. Every figure of every table must stay.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/io/tunnel_tables.hpp>
#include <voussoir/rockmass/mapped_slicing.hpp>
#include <voussoir/rockmass/statistics.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "support/degree.hpp"
#include "support/same_figures.hpp"
#include "support/tied_tunnels.hpp"
#include "support/transformed.hpp"

namespace ties_test {

using namespace voussoir;
using namespace voussoir_test;
using namespace voussoir_test::tied;

namespace {

const CoulombJoint interface_law({1e10, 1e10, 35 * degree});
const AxialBolt bolt({.axial_stiffness = 2e8, .yield_force = 1.5e5});

template <class Method>
using TunnelBy = Solver<CoulombJoint, AxialBolt, Method>;

/// What is asked of a procedure; the tightest that it reaches.
template <class Method>
Method patient() {
  if constexpr (std::is_same_v<Method, TwoLevel>) {
    TwoLevel::Params params;
    params.max_bursts = 60;
    return TwoLevel(params);
  } else if constexpr (std::is_same_v<Method, Relaxation>) {
    return Relaxation(Relaxation::Params{.max_steps = 600000});
  } else {
    return Explicit(Explicit::Params{.max_steps = 600000});
  }
}

/// Where a search ends.
template <class Method>
Acceptance tight() {
  return {.error_estimate = 1e-12, .unbalance_over_weight = 1e-8};
}

/// Every table, by its name.
using Tables = std::map<std::string, std::string>;

template <class Made>
Tables tables_of(const Made& tunnel, const EquilibriumReport& report,
                 const std::vector<Segment>& bars, bool is_mirrored) {
  Tables tables;
  const auto rows = [](const std::vector<std::pair<std::string, double>>& values) {
    CsvTable table({"figure", "value"}, 10);
    for (const auto& [name, value] : values) table.add_row(name, value);
    return table.text();
  };
  tables["verdict"] = std::string("word\n") + to_string(report) + "\n";
  const Convergence c = convergence(tunnel);
  tables["convergence"] = rows({{"crown", c.crown},
                                {"right", is_mirrored ? c.left_springing : c.right_springing},
                                {"left", is_mirrored ? c.right_springing : c.left_springing},
                                {"invert", c.invert},
                                {"rise", c.rise}});
  const SupportDemand demand = support_demand(tunnel);
  tables["bolt demand"] =
      rows({{"largest", demand.largest_bolt_force}, {"mean", demand.mean_bolt_force}});
  tables["thrust"] = rows({{"largest", demand.largest_thrust}, {"mean", demand.mean_thrust}});
  tables["moment"] = rows({{"largest", demand.largest_moment}});
  const BlockSizes sizes = block_sizes(tunnel.mass());
  tables["blocks"] = rows({{"count", static_cast<double>(sizes.count)},
                           {"smallest", sizes.smallest},
                           {"median", sizes.median},
                           {"mean", sizes.mean},
                           {"largest", sizes.largest}});
  tables["dropped"] = rows({{"pieces", static_cast<double>(tunnel.mass().carving.dropped_pieces)},
                            {"measure", tunnel.mass().carving.dropped_measure}});
  tables["fallen"] = rows({{"blocks", static_cast<double>(tunnel.fallen().size())},
                           {"measure", report.fallen_measure}});
  tables["spacing"] =
      rows({{"joint spacing",
             radial_spacing(tunnel.mass(), centre_of(tunnel.mass().openings.back()), 2, 4)}});
  tables["intensity"] = rows({{"P21", joint_intensity(tunnel.mass())}});
  const BlockSizeCurve curve(tunnel.mass());
  tables["size curve"] =
      rows({{"V20", curve.size_at(0.2)}, {"V50", curve.size_at(0.5)}, {"V80", curve.size_at(0.8)}});
  tables["bolts"] = bolt_table(bolt_forces(tunnel), bars, 2e5);
  tables["lining"] = lining_table(lining_forces(tunnel));
  CsvTable feet({"x_m", "y_m", "bearing_kN", "shear_kN", "of_its_strength", "settlement_mm"}, 10);
  for (const auto& foot : foot_forces(tunnel))
    feet.add_row(foot.place.x(), foot.place.y(), 1e-3 * foot.bearing, 1e-3 * foot.shear,
                 foot.utilisation, 1e3 * foot.settlement);
  tables["feet"] = feet.text();
  tables["joints"] = joint_table(joint_states(tunnel));
  return tables;
}

/// Rock cut by the traces alone.
RockMass<Planar> rock_of(const Drawn& d, const Image& image, const SimplePolygon& opening) {
  const Domain<2> ground = image.map(d.ground);
  const MappedJoints joints = mapped_joints(traces_of(d, image), ground, {.snap = 0.05});
  return slice_mapped(ground, joints, {}, {0.1}, {opening}).mass;
}

struct Answer {
  Tables tables;
  bool has_fallen = false;  ///< rock has come off, in motion
};

template <class Method>
Answer answer(const Drawn& d, const Image& image) {
  const bool is_mirrored = image.map.turn(0, 0) < 0;
  const SimplePolygon opening = moved(d.opening, image.map);
  FarField<2> field;
  if (d.is_on_elastic_ground) field = FarField<2>::elastic(elastic_matrix<2>({2e9, 0.25}));
  TunnelBy<Method> tunnel(rock_of(d, image, opening),
                          LawsBySet<CoulombJoint>(CoulombJoint({5e9, 5e8, d.friction * degree})),
                          {.density = 2700, .k0 = 0.8, .surcharge = 3e5}, opening, of_the_rock, {},
                          field);
  std::vector<Segment> bars;
  if (d.has_bolts) {
    bars = bolt_bars({.length = 2, .angular_spacing = 25 * degree}, opening);
    for (const Segment& bar : bars) tunnel.install_bolt(bar, bolt);
  }
  if (d.lining > 0) {
    LiningRing ring{.nodes = 36};
    std::optional<FootBearing> feet;
    if (d.lining == 2) {  // lopsided, so that it is not its own image
      const double from = -20 * degree, to = 170 * degree;
      ring.from = is_mirrored ? std::numbers::pi - to : from;
      ring.to = is_mirrored ? std::numbers::pi - from : to;
      feet.emplace(FootBearing::Params{0.3, 1e9, 5e6, 30 * degree});
    }
    tunnel.install_lining(lining_frame(tunnel.mass(), ring), LiningSection::rectangular(0.1, 25e9),
                          interface_law, feet);
  }
  const EquilibriumReport report = tunnel.equilibrium(0, patient<Method>(), tight<Method>());
  return {tables_of(tunnel, report, bars, is_mirrored),
          report.is_from_motion || !tunnel.fallen().empty()};
}

WorstFigure worst_of(const Tables& one, const Tables& image, const Transform<2>& map,
                     double floor) {
  WorstFigure worst;
  for (const auto& [name, text] : one)
    worst.take(worst_figure(name, text, image.at(name), map, floor));
  return worst;
}

Transform<2> far(double x, double y) { return {Eigen::Matrix2d::Identity(), {x, y}}; }

std::vector<Image> images() {
  return {{"moved by a nanometre", {}, {}, {0.6e-9, 0.8e-9}},
          {"moved by a nanometre the other way", {}, {}, {-0.8e-9, -0.6e-9}},
          {"on another grid", far(12345.678, -9876.543), far(32, -20)},
          {"mirrored", mirrored_2d()},
          {"in pieces", {}, {}, zeros<Vec2>(), true}};
}

/// From the first answer to the image.
Transform<2> between(const Image& image) {
  return {image.map.turn, image.map.shift - image.from.shift};
}

}  // namespace

TEST_SUITE("solver/ties") {
  // A figure may change by a millionth of itself, or by a tenth of that of the largest of its
  // column: shears of a lining are differences of what is large, and a facet that a nanometre moves
  // by 1e-8 of its length moves all forces by as much. Searches end where one more correction is
  // 1e-12 of the displacements; with the tolerance of the product, 1e-3, that is what its figures
  // are good for.
  constexpr double within = 1e-6, next_to_nothing = 0.1;

  template <class Method>
  void check(std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t seed = first; seed <= last; ++seed) {
      const Drawn d = drawn(seed);
      const Answer one = answer<Method>(d, {"as drawn"});
      for (const Image& image : images()) {
        if (is_known(seed, image.name)) continue;
        const bool is_beside = image.from.shift.x() != 0;
        const Answer other = is_beside ? answer<Method>(d, {"beside", image.from}) : one;
        const Answer made = answer<Method>(d, image);
        // Of rock that comes off in motion: docs/decisions.md, "One truth where rock fails".
        if (one.has_fallen || made.has_fallen) continue;
        const WorstFigure worst =
            worst_of(other.tables, made.tables, between(image), next_to_nothing);
        CAPTURE(seed);
        CAPTURE(std::string(image.name));
        CAPTURE(worst.where);
        CHECK(worst.difference <= within);
      }
    }
  }

  TEST_CASE("tunnels and their images: every figure of every table stays") {
    check<TwoLevel>(1, 9);
  }
  TEST_CASE("50 tunnels and their images: every figure of every table stays [long]") {
    check<TwoLevel>(1, 50);
  }

  /// Procedures that keep the slip which they make on the way: how blocks rattle while they are
  /// damped is another matter after a nanometre, and what a joint has slipped is the sum of it.
  template <class Method>
  void check_loosely(std::uint64_t seed) {
    const Drawn d = drawn(seed);
    const Answer one = answer<Method>(d, {"as drawn"});
    for (const Image& image : images()) {
      if (image.from.shift.x() != 0) continue;
      const Answer made = answer<Method>(d, image);
      for (const char* name : {"verdict", "convergence", "bolt demand", "thrust", "moment"}) {
        const WorstFigure worst = worst_figure(name, one.tables.at(name), made.tables.at(name),
                                               image.map, next_to_nothing);
        CAPTURE(seed);
        CAPTURE(std::string(image.name));
        CAPTURE(worst.where);
        CHECK(worst.difference <= 0.02);  // the overshoot that they say of themselves
      }
    }
  }
  TEST_CASE("what depends on the way keeps its figures to two per cent") {
    check_loosely<Relaxation>(2);
    check_loosely<Relaxation>(4);
    check_loosely<Explicit>(4);
  }

  TEST_CASE("the rock of the mirror is the mirror of the rock") {
    const Image image{"mirrored", mirrored_2d()};
    int off = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
      const Drawn d = drawn(seed);
      const auto one = rock_of(d, {"as drawn"}, d.opening),
                 made = rock_of(d, image, moved(d.opening, image.map));
      const std::vector<int> twin = twins(one, made, image.map);
      bool is_same = one.bodies.size() == made.bodies.size();
      for (std::size_t b = 0; is_same && b < twin.size(); ++b)
        is_same = twin[b] >= 0 && made.bodies[static_cast<std::size_t>(twin[b])].parts.size() ==
                                      one.bodies[b].parts.size();
      off += !is_same;
    }
    CHECK(off <= 4);  // small blocks on the middle of the domain, see is_known; 25 were, before
  }

  TEST_CASE("a bed at the springing, or a little above it: the walls move as much") {
    // As measured first: springings were 0.35 and 0.32, and 0.30 and 0.36 mm where the bed lay 1 um
    // higher.
    std::vector<double> before;
    for (const double above : {0.0, 1e-9, 1e-6}) {
      Drawn d{circular_opening(10), {}, {}};
      d.ground = domain_around(d.opening, 60, 17.5, 17.5);
      for (int k = -9; k <= 9; ++k) {
        const double y = 2 * k + (k == 0 ? above : 0);
        d.traces.push_back(trace({-30, y}, {30, y}, 0));
      }
      for (int k = 0; k < 23; ++k)
        d.traces.push_back(trace({-27.1 + 2.5 * k, -25}, {-27.1 + 2.5 * k, 25}, 0));
      d.traces.push_back(trace({-30, -14}, {30, 13}, 0));
      TunnelBy<TwoLevel> tunnel(rock_of(d, {"as drawn"}, d.opening),
                                LawsBySet<CoulombJoint>(CoulombJoint({5e9, 5e8, 80 * degree})),
                                {.density = 2600, .k0 = 0.6}, d.opening);
      (void)tunnel.equilibrium(0, patient<TwoLevel>(), tight<TwoLevel>());
      const Convergence c = convergence(tunnel);
      const std::vector<double> here{c.crown, c.right_springing, c.left_springing, c.invert};
      // A block that is higher by one part in two million moves by less than as much more; what it
      // shows of itself at the wall, a micrometre in a metre, weighs as much.
      for (std::size_t k = 0; k < before.size(); ++k)
        CHECK(std::abs(here[k] - before[k]) <= 1e-6 * std::abs(before[k]) + 1e-12);
      if (before.empty()) before = here;
    }
  }
}

}  // namespace ties_test
