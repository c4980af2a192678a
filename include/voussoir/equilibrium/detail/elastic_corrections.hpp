// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/fire.hpp>
#include <voussoir/linear/elastic_solver.hpp>

namespace voussoir::detail {

/// Solves with the stiffness of all contacts closed and sticking, and the fictitious masses that go
/// with it.
///
/// Within one call of `find` it depends on the bodies and bolts that are left, not on where they
/// are: made anew only after some have gone, or are back because the search starts again.
template <class System>
class ElasticCorrections {
 public:
  /// @throws Stopped, FreeBody, NotEnoughMemory  it then has no solver; the next call makes one
  void prepare(const System& system, const Fire::Params& fire, const LinearSettings& linear,
               const Progress& progress, EquilibriumReport& report) {
    std::vector<int> bodies = system.movable_bodies();
    std::vector<bool> broken = system.supports.broken();
    const Eigen::VectorXd& updated_at = system.updated_at();
    const bool same_place = updated_at.size() == updated_at_.size() && updated_at == updated_at_;
    if (solver_ && bodies == bodies_ && broken == broken_ && same_place) return;
    // Not two of them at a time; without one it is made anew, whatever stops this.
    if (solver_) add_report(before_, solver_->report());
    solver_.reset();
    auto stiffness = system.elastic_stiffness(progress);
    fire_.emplace(stiffness.absolute_row_sums(), fire);
    solver_.emplace(std::move(stiffness), system.centres(), linear, progress, system.patterns);
    bodies_ = std::move(bodies);
    broken_ = std::move(broken);
    updated_at_ = updated_at;
    ++report.factorisations;
  }
  /// d = K^-1 f, in place.
  /// @return  estimate of its largest error [m]
  double solve(Eigen::VectorXd& d, const SolveTolerance& tolerance, const Progress& progress,
               EquilibriumReport& report) {
    VOUSSOIR_ASSERT(solver_.has_value(), "a solver is prepared before it solves");
    const double error = solver_->solve_in_place(d, tolerance, progress);
    ++report.elastic_solves;
    return error;
  }
  /// What the last solve has left of its forces.
  [[nodiscard]] const Eigen::VectorXd& residual() const { return solver_->residual(); }
  [[nodiscard]] LinearReport report() const {
    LinearReport all = before_;
    if (solver_) add_report(all, solver_->report());
    return all;
  }
  [[nodiscard]] Fire& fire() {
    VOUSSOIR_ASSERT(fire_.has_value(), "masses are made with the solver");
    return *fire_;
  }

 private:
  std::optional<ElasticSolver<System::dof>> solver_;
  std::optional<Fire> fire_;
  LinearReport before_;         ///< of solvers that are gone
  std::vector<int> bodies_;     ///< that could move when it was made
  std::vector<bool> broken_;    ///< supports then
  Eigen::VectorXd updated_at_;  ///< the displacement at which contacts had been found
};

}  // namespace voussoir::detail
