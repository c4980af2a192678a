// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <voussoir/core/errors.hpp>
#include <voussoir/solver/active_set.hpp>
#include <voussoir/solver/block_cholesky.hpp>
#include <voussoir/solver/equilibrium.hpp>
#include <voussoir/solver/fire.hpp>
#include <voussoir/solver/relaxation.hpp>

namespace voussoir {

/// The default way to equilibrium: short relaxations corrected by elastic solves.
///
///   factor K (all contacts closed and sticking);  u += K^-1 F(u)
///   repeat  FIRE for a burst of steps, history frozen;  d = K^-1 F(u);  estimate = max|d| / max|u|
///           accept if the estimate, the unbalance of every block and the displacements pass
///           u += d
///   commit slip
///
/// FIRE settles what is local (slip, opened joints), the elastic solve what is long-ranged, and its
/// correction d measures the error of the displacements. The history is frozen during the search,
/// so the answer does not depend on the path the search took.
///
/// d is blind to mechanisms: a key block that falls has a tiny elastic correction. Hence the test
/// on every block's unbalance, and `Relaxation` as a fallback that finds out which blocks fall; the
/// search then starts again from the initial state without them.
class TwoLevel {
 public:
  using role = roles::Equilibrium;
  static constexpr const char* name = "TwoLevel";

  struct Params {
    int burst_steps = 60;      ///< relaxation steps between elastic solves
    int burst_bodies = 2400;   ///< bursts on fewer bodies than this are longer, up to 20 times
    int rings = 2;             ///< generations of neighbours relaxed with a body out of balance
    int separate_below = 1000; ///< up to so many bodies each one stops on its own account
    int max_bursts = 30;       ///< then the slip is followed step by step
    int max_restarts = 8;      ///< searches without the blocks that fell in the one before
    Fire::Params fire{};
    Relaxation::Params fallback{};
  };
  TwoLevel() = default;
  explicit TwoLevel(const Params& params) : params_(params), fallback_(params.fallback) {
    require(params.burst_steps > 0, "burst_steps", params.burst_steps, "> 0");
    require(params.max_bursts > 0, "max_bursts", params.max_bursts, "> 0");
  }

  template <class System>
  [[nodiscard]] EquilibriumReport find(System& system, const SearchContext& context) const {
    EquilibriumReport report;
    const Acceptance& accept = context.acceptance;
    detail::drop(system, system.unsupported(), context, report);
    const System start = system;  // where a search without the fallen blocks begins
    std::vector<int> gone;
    for (int attempt = 0; attempt <= params_.max_restarts; ++attempt) {
      if (search(system, context, report)) break;
      if (!report.reason.empty()) break;  // stopped by the user
      const EquilibriumReport fall = fallback_.find(system, context);
      report.steps += fall.steps;
      report.fallen.insert(report.fallen.end(), fall.fallen.begin(), fall.fallen.end());
      report.fallen_measure += fall.fallen_measure;
      report.largest_displacement = fall.largest_displacement;
      report.unbalance_over_weight = fall.unbalance_over_weight;
      if (fall.verdict == Verdict::collapsing || report.fallen_measure > accept.collapse_measure) {
        report.verdict = Verdict::collapsing;
        report.reason = detail::collapse_sentence(report, accept);
        break;
      }
      if (fall.verdict == Verdict::undecided) {
        report.reason = "falling blocks were followed without end: " + fall.reason;
        break;
      }
      gone.insert(gone.end(), fall.fallen.begin(), fall.fallen.end());
      if (fall.fallen.empty()) {
        // Nothing fell: the relaxed state is an equilibrium reached on a longer path.
        report.verdict = Verdict::stable;
        report.error_estimate = estimate_at(system, report);
        report.reason = "equilibrium found by following the slip step by step";
        if (!(report.error_estimate < accept.error_estimate)) {
          report.verdict = Verdict::undecided;
          report.reason = "the error estimate stays above its limit";
        }
        break;
      }
      system = start;
      system.remove(gone);
    }
    if (report.verdict == Verdict::undecided && report.reason.empty())
      report.reason = "blocks keep falling after " + std::to_string(params_.max_restarts) + " restarts";
    for (const auto& bolt : system.bolts) report.broken_bolts += bolt.state.ruptured;
    return report;
  }

 private:
  /// One search with the present bodies. @return true if it ended in a verdict
  template <class System>
  bool search(System& system, const SearchContext& context, EquilibriumReport& report) const {
    const Acceptance& accept = context.acceptance;
    system.wall_fraction = context.wall_fraction;
    std::optional<BlockCholesky<System::dof>> factor;
    std::optional<Fire> fire;
    const auto prepare = [&] {
      const auto stiffness = system.elastic_stiffness();
      factor.emplace(stiffness);
      fire.emplace(stiffness.absolute_row_sums(), params_.fire);
      ++report.factorisations;
    };
    prepare();
    Eigen::VectorXd& u = system.displacement;
    Eigen::VectorXd f, d, trial;
    system.forces(u, f);
    d = f;
    factor->solve_in_place(d);
    ++report.elastic_solves;
    u += d;
    for (int burst = 1; burst <= params_.max_bursts; ++burst) {
      const double moved = relax(system, *fire, accept, burst <= 2, f, report);
      if (moved > accept.displacement_limit) {
        const std::vector<int> fallen = detail::fallen_bodies(system, accept.displacement_limit);
        detail::drop(system, fallen, context, report);
        if (report.fallen_measure > accept.collapse_measure) {
          report.verdict = Verdict::collapsing;
          report.reason = detail::collapse_sentence(report, accept);
          return true;
        }
        prepare();
      }
      system.forces(u, f);
      d = f;
      factor->solve_in_place(d);
      ++report.elastic_solves;
      report.largest_displacement = System::largest_translation(u);
      const double correction = System::largest_translation(d);
      report.error_estimate =
          correction > 0 ? correction / report.largest_displacement : 0.0;
      report.unbalance_over_weight = system.unbalance_over_weight(f);
      if (!std::isfinite(report.error_estimate))
        throw NumericalFault("two-level search: displacements are not finite in burst " +
                             std::to_string(burst));
      if (report.error_estimate < accept.error_estimate &&
          report.unbalance_over_weight < accept.unbalance_over_weight) {
        if (system.commit() > 0) continue;  // a bolt broke: look again without it
        report.verdict = Verdict::stable;
        report.reason = "error estimate, unbalance and displacements are within their limits";
        return true;
      }
      if (context.progress && !context.progress(progress_of(report, accept, burst))) {
        report.reason = "stopped by the user";
        return false;
      }
      correct(system, u, d, f, trial);
    }
    return false;
  }

  /// Relaxes the bodies that are out of balance, all others held.
  /// @return  the largest translation among them, or 0 if all went by without a body falling [m]
  template <class System>
  double relax(System& system, Fire& fire, const Acceptance& accept, bool opening_burst,
               Eigen::VectorXd& f, EquilibriumReport& report) const {
    constexpr int check_every = 20;
    Eigen::VectorXd& u = system.displacement;
    system.forces(u, f);
    ++report.steps;
    ActiveSet<System> active(system, f, 0.1 * accept.unbalance_over_weight, params_.rings);
    const std::vector<int>& bodies = active.bodies();
    const auto count = static_cast<int>(bodies.size());
    // Few bodies are cheap: give them the work of a burst on many.
    const int steps = opening_burst ? params_.burst_steps
                                    : std::clamp(params_.burst_steps * params_.burst_bodies /
                                                     std::max(count, 1),
                                                 params_.burst_steps, 20 * params_.burst_steps);
    const double lightest = system.lightest_weight();
    fire.rest();
    for (int step = 0; step < steps; ++step) {
      if (step > 0) {
        active.forces(u, f);
        ++report.steps;
      }
      if (step % check_every == check_every - 1) {
        double worst = 0, far = 0;
        for (const int b : bodies) {
          worst = std::max(worst, system.unbalance_of(f, b, lightest));
          far = std::max(far, u.template segment<System::dim>(System::dof * b).norm());
        }
        if (far > accept.displacement_limit || worst < 0.2 * accept.unbalance_over_weight) return far;
      }
      if (count > params_.separate_below) {
        fire.template advance<System::dof>(bodies, f, u);
      } else {
        fire.template advance_separately<System::dof>(bodies, f, u);
      }
    }
    return 0;
  }

  /// Adds the elastic correction, halved while it would make the scaled residual four times larger.
  template <class System>
  static void correct(System& system, Eigen::VectorXd& u, const Eigen::VectorXd& d,
                      Eigen::VectorXd& f, Eigen::VectorXd& trial) {
    const double before = f.squaredNorm();
    for (double part = 1; part > 0.2; part *= 0.5) {
      trial = u + part * d;
      system.forces(trial, f);
      if (f.squaredNorm() <= 16 * before) {
        u = trial;
        return;
      }
    }
  }

  template <class System>
  [[nodiscard]] static double estimate_at(System& system, EquilibriumReport& report) {
    const BlockCholesky<System::dof> factor(system.elastic_stiffness());
    ++report.factorisations;
    ++report.elastic_solves;
    Eigen::VectorXd d;
    system.forces(system.displacement, d);
    factor.solve_in_place(d);
    const double moved = System::largest_translation(system.displacement);
    return moved > 0 ? System::largest_translation(d) / moved : 0.0;
  }

  /// How far the estimate has come down, on a logarithmic scale; never quite there.
  [[nodiscard]] double progress_of(const EquilibriumReport& report, const Acceptance& accept,
                                   int burst) const {
    const double left = std::log(std::max(report.error_estimate / accept.error_estimate, 1.0)) /
                        std::log(1.0 / accept.error_estimate);
    const double spent = static_cast<double>(burst) / params_.max_bursts;
    return std::clamp(std::max(1 - left, spent), 0.0, 0.99);
  }

  Params params_;
  Relaxation fallback_;
};

}  // namespace voussoir
