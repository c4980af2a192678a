// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/equilibrium/detached_blocks.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/linear/elastic_solver.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir::detail {

/// Brings the bodies of a run that do not move to balance, by elastic solves: what a few moving
/// blocks do to all others is small and long-ranged, and the time steps that would carry it through
/// the rock are many.
///
/// The stiffness is that of the model where it was set in motion, all contacts closed and sticking:
/// factored once. A body for which that is no longer true stays out of balance, and is to be
/// stepped. Where much has closed since, the rock is stiffer than that, and a step may go too far:
/// one that gives the rock energy is taken back.
template <class System>
class ElasticBalance {
 public:
  static constexpr int dim = System::dim, dof = System::dof;

  ElasticBalance(const System& system, const SearchContext& context)
      : model_(system), context_(context) {}

  /// @param is_fast     is_fast(body): it is on its way, and is left to the steps
  /// @param settled_at  ratio up to which a body is in balance [-]
  /// @throws Stopped
  template <class Run, class IsFast>
  void balance(Run& run, IsFast&& is_fast, double settled_at, EquilibriumReport& report) {
    Eigen::VectorXd f = zeros(model_.displacement.size());
    double worst = 0;
    for (int b = 0; b < run.body_count(); ++b) {
      if (!model_.body(b).movable || is_fast(b)) continue;
      const Load<dim> load = run.out_of_balance(b);
      set_part<dof>(f, dof * b, stacked(load.force, load.moment));
      worst = std::max(worst, run.unbalance_of(b, load));
    }
    if (worst <= settled_at) return;
    if (!solver_) {
      prepare_without_free_bodies(model_, context_, dropped_, [&] {
        solver_.emplace(model_.elastic_solver({}, context_.progress));
      });
      ++report.factorisations;
      for (int b = 0; b < model_.body_count(); ++b)
        if (!model_.body(b).movable) set_part<dof>(f, dof * b, zeros<Fixed<dof, 1>>());
    }
    (void)solver_->solve_in_place(f, {.relative = exactness}, context_.progress);
    ++report.elastic_solves;
    if (run.displace(f) >= 0) return;
    set_to_sum(f, f, -2, f);
    (void)run.displace(f);
  }

 private:
  static constexpr double exactness = 0.05;

  System model_;
  const SearchContext& context_;
  std::optional<ElasticSolver<dof>> solver_;
  EquilibriumReport dropped_;  ///< bodies that nothing holds: they are stepped
};

}  // namespace voussoir::detail
