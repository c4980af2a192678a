// SPDX-License-Identifier: MIT
#pragma once
// One bolted tunnel, for every solution procedure: a 5 m opening under 10 m of cover in 35 m x
// 30 m of rock like reference mass A, 1420 blocks, seed 2. Differences are relative L2 norms over
// the displacements of all blocks.
#include <doctest/doctest.h>

#include <vector>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"

namespace voussoir_test {

using namespace voussoir;

/// The tunnel, excavated and bolted, not yet relaxed.
inline const Solver<>& bolted_tunnel() {
  static const Solver<> tunnel = [] {
    const auto opening = circular_opening(5, 36);
    Solver<> made(jointed_rock(domain_around(opening, 35, 10, 15), 2),
                  CoulombJoint({5e9, 5e8, 35 * degree}), {.density = 2700});
    made.excavate(opening);
    for (const auto& bar : bolt_bars({.length = 3,
                           .angular_spacing = 22.5 * degree,
                           .from = -22.5 * degree,
                           .to = 202.5 * degree},
                                     opening))
      made.install_bolt(bar, AxialBolt({.axial_stiffness = 2e8}));
    return made;
  }();
  return tunnel;
}

/// The answer to compare with: the default method, a thousand times tighter than usual.
inline const Solver<>& exact_tunnel() {
  static const Solver<> tunnel = [] {
    Solver<> made = bolted_tunnel();
    const EquilibriumReport report =
        made.equilibrium(0, {}, {.error_estimate = 1e-7, .unbalance_over_weight = 1e-5});
    REQUIRE(report.verdict == Verdict::stable);
    REQUIRE(report.fallen.empty());
    return made;
  }();
  return tunnel;
}

inline Eigen::VectorXd translations(const Solver<>& tunnel) {
  Eigen::VectorXd u = tunnel.system().displacement;
  for (Eigen::Index k = 2; k < u.size(); k += 3) u[k] = 0;
  return u;
}

/// Relative L2 distance from the exact displacements.
inline double error_of(const Solver<>& tunnel) {
  const Eigen::VectorXd exact = translations(exact_tunnel());
  return (translations(tunnel) - exact).norm() / exact.norm();
}
inline double crown_ratio(const Solver<>& tunnel) {
  return convergence(tunnel).crown / convergence(exact_tunnel()).crown;
}

/// Another method than the solver's own, on its system.
template <class Method>
EquilibriumReport find(Solver<>& tunnel, const Method& method, double wall_fraction = 0) {
  std::vector<double> measures;
  for (const auto& body : tunnel.mass().bodies) measures.push_back(body.properties.measure);
  measures.resize(static_cast<std::size_t>(tunnel.system().body_count()), 0.0);
  SearchContext context;
  context.measures = &measures;
  context.wall_fraction = wall_fraction;
  return method.find(detail::SystemOf::in(tunnel), context);
}

}  // namespace voussoir_test
