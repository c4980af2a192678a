// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/equilibrium/active_set.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/fire.hpp>
#include <voussoir/equilibrium/search_tuning.hpp>
#include <voussoir/equilibrium/update_when_due.hpp>

namespace voussoir::detail {

/// Nobody goes further at a time.
[[nodiscard]] inline double longest_move(const Acceptance& accept) {
  return std::min(accept.displacement_limit, accept.contact_update_limit);
}

/// How much a local search may do.
struct LocalEffort {
  int burst_steps;      ///< of FIRE
  int newton_steps;     ///< at most
  double newton_below;  ///< error estimate from which on they are tried [-]
  int rings;            ///< generations of neighbours searched with a body out of balance
};

/// Settles the bodies that are out of balance, all others fixed: a burst of FIRE, then Newton steps
/// with the unsymmetric tangent.
///
/// Newton steps are damped as Levenberg and Marquardt do, but body by body: its reach is how far
/// one that nothing holds may move in a step. It grows while steps succeed; when one fails it
/// shrinks for the bodies that ran into something, and the others fall on. It is kept from one
/// local search to the next.
template <class System>
class LocalSearch {
 public:
  static constexpr int dim = System::dim;
  static constexpr int dof = System::dof;

  LocalSearch(System& system, const LocalEffort& effort, const LocalSearchTuning& tuning,
              const SearchContext& context)
      : system_(system),
        effort_(effort),
        tuning_(tuning),
        context_(context),
        reach_(
            constants(system.body_count(), tuning.first_reach * longest_move(context.acceptance))) {
    VOUSSOIR_ASSERT(is_positive(reach_), "a body can move");
  }

  /// @param estimate  of the error so far [-]
  /// @param left      what elastic solves have left of the forces: for the next to take
  /// @param f         room for forces
  /// @throws Stopped
  void settle(Fire& fire, double estimate, const Eigen::VectorXd& left, Eigen::VectorXd& f,
              EquilibriumReport& report) {
    StopCheck stop(context_.progress, 1);
    Eigen::VectorXd& u = system_.displacement;
    system_.forces(u, f);
    ++report.steps;
    ActiveSet<System> active(system_, f, left, settled_at(), effort_.rings);
    fire.rest();
    for (int step = 0; step < effort_.burst_steps; ++step) {
      stop();
      fire.template advance<dof>(active.bodies(), f, u);
      active.forces(u, f);
      ++report.steps;
    }
    if (estimate < effort_.newton_below) newton_steps(active, f, stop, report);
  }

 private:
  /// Out-of-balance force ratio below which a body is left alone [-].
  [[nodiscard]] double settled_at() const {
    return tuning_.active_above * context_.acceptance.unbalance_over_weight;
  }

  void newton_steps(ActiveSet<System>& active, Eigen::VectorXd& f, StopCheck& stop,
                    EquilibriumReport& report) {
    const Acceptance& accept = context_.acceptance;
    Eigen::VectorXd& u = system_.displacement;
    double now = active.squared_unbalance(f);
    Eigen::VectorXd before, worse;
    for (int k = 0; k < effort_.newton_steps; ++k) {
      if (active.worst_unbalance(f) < settled_at()) break;
      const Eigen::VectorXd step = active.newton_step(u, f, reach_, context_.progress);
      before = u;
      double share = voussoir::is_finite(step) ? 1.0 : 0.0, next = now;
      for (; share > tuning_.shortest_step; share *= 0.5) {
        stop();
        move(active.bodies(), before, step, share);
        active.forces(u, f);
        ++report.steps;
        next = active.squared_unbalance(f);
        if (next <= tuning_.accepted_growth * now) break;
      }
      if (share <= tuning_.shortest_step) {
        worse = f;
        u = before;
        active.forces(u, f);
        hold_back(active.bodies(), f, worse);
        continue;
      }
      VOUSSOIR_ASSERT(next <= tuning_.accepted_growth * now, "a step that is kept has succeeded");
      now = next;
      if (share == 1.0)
        for (const int b : active.bodies())
          reach_[b] = std::min(tuning_.reach_growth * reach_[b], longest_move(accept));
      if (active.largest_translation(u) > accept.displacement_limit || is_due(system_, accept))
        break;
    }
  }

  /// Puts the bodies where a part of a step leads, none further than the longest step.
  void move(const std::vector<int>& bodies, const Eigen::VectorXd& before,
            const Eigen::VectorXd& step, double share) {
    const double longest = tuning_.longest_step * longest_move(context_.acceptance);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      Fixed<dof, 1> move = share * part<dof>(step, dof * static_cast<Eigen::Index>(b));
      const double length = part<dim>(move, 0).norm();
      if (length > longest) move = move * (longest / length);
      set_part<dof>(system_.displacement, dof * bodies[b],
                    part<dof>(before, dof * bodies[b]) + move);
    }
  }

  /// After a step that failed: shortens the reach of the bodies whose balance it has spoilt, or of
  /// all if none stands out. `f` forces before the step, `worse` after it.
  void hold_back(const std::vector<int>& bodies, const Eigen::VectorXd& f,
                 const Eigen::VectorXd& worse) {
    const auto scale = system_.weight_scale();
    bool found = false;
    for (const bool everybody : {false, true}) {
      if (found) return;
      for (const int b : bodies) {
        if (!everybody &&
            !(system_.unbalance_of(worse, b, scale) >
              tuning_.spoilt_factor * system_.unbalance_of(f, b, scale) + tuning_.spoilt_addition))
          continue;
        reach_[b] = std::max(tuning_.reach_shrinkage * reach_[b], tuning_.shortest_reach);
        VOUSSOIR_ASSERT(reach_[b] > 0, "a body that is held back can still move");
        found = true;
      }
    }
  }

  System& system_;
  const LocalEffort effort_;
  const LocalSearchTuning& tuning_;
  const SearchContext& context_;
  Eigen::VectorXd reach_;  ///< of every body [m]
};

}  // namespace voussoir::detail
