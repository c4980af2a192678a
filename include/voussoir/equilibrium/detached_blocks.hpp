// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/small_algebra.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/search_tuning.hpp>
#include <voussoir/linear/conjugate_gradients.hpp>
#include <voussoir/linear/elastic_solver.hpp>
#include <voussoir/linear/free_body.hpp>
#include <voussoir/linear/linear_method.hpp>

namespace voussoir::detail {

// What is detached, and whether that can be told: one answer for every equilibrium method.

/// Blocks that moved beyond the limit.
template <class System>
[[nodiscard]] std::vector<int> fallen_bodies(const System& system, double limit) {
  std::vector<int> fallen;
  for (int b = 0; b < system.body_count(); ++b)
    if (system.body(b).movable && system.body(b).is_block &&
        !(part<System::dim>(system.displacement, System::dof * b).norm() <= limit))
      fallen.push_back(b);
  return fallen;
}

/// Removes these bodies, and those that then hang on nothing. Where the edge of the domain has cut
/// one of the latter, it is held: fixed where it is.
/// @return  those that hung on nothing and are removed; those that are held
template <class System>
std::pair<std::vector<int>, std::vector<int>> remove_with_loose(System& system,
                                                                const std::vector<int>& bodies) {
  if (!bodies.empty()) system.remove(bodies);
  std::vector<int> loose = system.unsupported(), held = system.cut_by_edge(loose);
  for (const int b : held) {
    system.fix(b);
    std::erase(loose, b);
  }
  if (!loose.empty()) system.remove(loose);
  return {std::move(loose), std::move(held)};
}

/// The same, entered in the report as fallen, or held.
template <class System>
void drop(System& system, const std::vector<int>& bodies, const SearchContext& context,
          EquilibriumReport& report) {
  const auto enter = [&](int b) {
    if (!system.body(b).is_block) return;
    report.fallen.push_back(b);
    VOUSSOIR_ASSERT(context.measures == nullptr || is_index(b, context.measures->size()),
                    "every block has its area or volume");
    if (context.measures != nullptr)
      report.fallen_measure += (*context.measures)[static_cast<std::size_t>(b)];
  };
  for (const int b : bodies) enter(b);
  const auto [loose, held] = remove_with_loose(system, bodies);
  for (const int b : loose) enter(b);
  report.held_at_edge.insert(report.held_at_edge.end(), held.begin(), held.end());
}

/// Prepares a solver of the elastic stiffness. A body that can move without resistance though all
/// contacts are closed is held by nothing: it is dropped, or held where the edge of the domain has
/// cut it, and the solver prepared again.
///
/// Not where contacts have one point each: that lets blocks turn that real contacts hold.
/// @throws FreeBody  in such a model, or after more than `most` bodies: it is the model that is
/// free
template <class System, class Prepare>
void prepare_without_free_bodies(System& system, const SearchContext& context,
                                 EquilibriumReport& report, Prepare&& prepare, int most = 100) {
  const auto& contacts = system.joints.contacts();
  for (int dropped = 0;; ++dropped) {
    try {
      return prepare();
    } catch (const FreeBody& free) {
      if (dropped == most || !system.body(free.body()).movable ||
          std::all_of(contacts.begin(), contacts.end(),
                      [](const auto& c) { return c.last() - c.first == 1; }))
        throw;
      if (system.cut_by_edge({free.body()}).empty()) {
        drop(system, {free.body()}, context, report);
      } else {
        system.fix(free.body());
        report.held_at_edge.push_back(free.body());
      }
    }
  }
}

/// How exact the correction of an error estimate must be.
template <class System>
[[nodiscard]] SolveTolerance tolerance_of_correction(const System& system, const Acceptance& accept,
                                                     const CorrectionTuning& tuning = {}) {
  return {.relative = tuning.exactness,
          .absolute = tuning.share_of_error * accept.error_estimate *
                      system.largest_translation(system.displacement)};
}

/// u = K^-1 f, in place, once. A body that nothing holds is dropped first, and has u = 0.
/// @return  estimate of its largest error [m]
template <class System>
double solve_elastically(System& system, const SearchContext& context,
                         const LinearSettings& settings, const SolveTolerance& tolerance,
                         Eigen::VectorXd& f, EquilibriumReport& report) {
  std::optional<ElasticSolver<System::dof>> solver;
  prepare_without_free_bodies(system, context, report, [&] {
    solver.emplace(system.elastic_solver(settings, context.progress));
  });
  for (int b = 0; b < system.body_count(); ++b)
    if (!system.body(b).movable)
      set_part<System::dof>(f, System::dof * b, zeros<Fixed<System::dof, 1>>());
  const double error = solver->solve_in_place(f, tolerance, context.progress);
  ++report.factorisations;
  ++report.elastic_solves;
  add_report(report.linear, solver->report());
  return error;
}

/// True, with the verdict, if more is detached than a tunnel can lose.
/// @param share  of what that is [-], > 0
template <int Dim>
[[nodiscard]] bool has_collapsed(EquilibriumReport& report, const SearchContext& context,
                                 double share = 1) {
  VOUSSOIR_ASSERT(context.open_length > 0, "rock is lost over a length");
  const double limit = share * context.acceptance.collapse_measure * context.open_length;
  if (!(report.fallen_measure > limit)) return false;
  const char* unit = Dim == 2 ? "m2" : "m3";
  char text[160];
  std::snprintf(
      text, sizeof text,
      "%zu block%s of %.3g %s detached before the others came to rest; more than %.3g %s is "
      "a collapse",
      report.fallen.size(), report.fallen.size() == 1 ? "" : "s", report.fallen_measure, unit,
      limit, unit);
  report.verdict = Verdict::collapse;
  report.reason = text;
  return true;
}

}  // namespace voussoir::detail
