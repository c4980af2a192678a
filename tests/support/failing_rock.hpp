// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/dynamics/set_in_motion.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/degree.hpp"
#include "support/jointed_mass.hpp"

/// Unsupported tunnels that shed rock, and what all blocks in motion make of them.
namespace voussoir_test {

using namespace voussoir;

/// A tunnel in 3-D, 2.4 to 3.4 m wide, blocks of about a metre, weak joints, drawn from a number; a
/// good half of them sheds rock.
struct DrawnInSpace {
  SimplePolygon section = circular_opening(4, 36);
  Solver<Spatial> tunnel;
};
/// @param size  of the blocks, over that drawn [-], > 0
[[nodiscard]] inline DrawnInSpace drawn_tunnel_in_space(std::uint64_t number, double size = 1) {
  Random random(1910, number);
  const double span = 2.4 + random.uniform(), spacing = 0.9 + 0.2 * random.uniform();
  const SimplePolygon section =
      number % 2 == 0 ? circular_opening(span, 16) : horseshoe_opening(span, 0.4 * span, 16);
  const double friction = (10 + 10 * random.uniform()) * degree;
  const double k0 = 0.5 + random.uniform(), cover = 8 + 40 * random.uniform();
  const double half = 1.45 * span, above = half - 0.5 * span;
  Solver<Spatial> tunnel(
      jointed_mass({{-half, 0, -half}, {half, 0.9 * span, half}}, number, size * spacing,
                   {.min_inscribed_radius = size * 0.2}),
      CoulombJoint({5e9, 1e9, friction}),
      {.density = 2700, .k0 = k0, .surcharge = 9.81 * 2700 * std::max(cover - above, 0.0)});
  tunnel.excavate(PrismaticOpening(section));
  return {section, std::move(tunnel)};
}

/// What a procedure, or the reference, says of a tunnel.
struct FailureAnswer {
  Verdict verdict;
  std::vector<int> fallen;  ///< in the order of their numbers
  double area;              ///< of them [m^2], in 3-D their volume [m^3]
  bool operator==(const FailureAnswer&) const = default;
};

template <class Tunnel>
[[nodiscard]] double area_of(const Tunnel& tunnel, const std::vector<int>& blocks) {
  double sum = 0;
  for (const int b : blocks)
    sum += tunnel.mass().bodies[static_cast<std::size_t>(b)].properties.measure;
  return sum;
}

/// By one procedure; the blocks in the order of their numbers.
/// @param collapse  area, in 3-D per metre of tunnel, beyond which it is one [m^2]
template <class Method, class Tunnel>
[[nodiscard]] EquilibriumReport report_by(Tunnel tunnel, double collapse,
                                          const Method& method = Method()) {
  std::vector<double> measures;
  for (const auto& body : tunnel.mass().bodies) measures.push_back(body.properties.measure);
  measures.resize(static_cast<std::size_t>(tunnel.system().body_count()), 0.0);
  SearchContext context;
  context.acceptance.collapse_measure = collapse;
  context.measures = &measures;
  context.open_length = open_length(tunnel.mass());
  EquilibriumReport report = method.find(detail::SystemOf::in(tunnel), context);
  std::sort(report.fallen.begin(), report.fallen.end());
  return report;
}

/// All blocks in motion, as inert as they are: nothing of the procedures but what a block that has
/// come off is.
/// @param collapse  area, in 3-D volume, beyond which it is one
/// @param energy    of the run, to be written; null: nobody asks
template <class Tunnel>
[[nodiscard]] FailureAnswer all_blocks_in_motion(const Tunnel& tunnel, double limit,
                                                 double collapse, double duration, double safety,
                                                 EnergyBalance* energy = nullptr) {
  auto run =
      set_in_motion(tunnel, {.local_damping = 0.1, .viscous_damping = 0.3, .safety = safety});
  std::vector<int> fallen;
  while (run.time() < 30) {
    const double done = std::min(run.time() / duration, 1.0);
    run.set_held(1 - done);
    run.advance_steps(50);
    bool rests = done == 1 && run.unbalance_over_weight() < 1e-2;
    for (int b = 0; b < run.body_count(); ++b) {
      if (!run.body(b).movable()) continue;
      rests = rests && run.velocity(b).norm() * 2 < limit;
      if ((run.position(b) - tunnel.system().body(b).centre).norm() <= limit) continue;
      run.remove(b);
      fallen.push_back(b);
    }
    const bool collapses = area_of(tunnel, fallen) > collapse;
    if (energy != nullptr) *energy = run.energy();
    if (!rests && !collapses) continue;
    std::sort(fallen.begin(), fallen.end());
    return {collapses ? Verdict::collapse : Verdict::stable, fallen, area_of(tunnel, fallen)};
  }
  return {Verdict::undecided, {}, 0};
}

}  // namespace voussoir_test
