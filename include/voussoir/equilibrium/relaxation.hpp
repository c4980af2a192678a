// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/equilibrium/active_set.hpp>
#include <voussoir/equilibrium/detached_blocks.hpp>
#include <voussoir/equilibrium/detail/search_or_follow.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/fire.hpp>
#include <voussoir/equilibrium/search_tuning.hpp>
#include <voussoir/equilibrium/update_when_due.hpp>
#include <voussoir/linear/elastic_solver.hpp>
#include <voussoir/model/contact_group.hpp>

namespace voussoir {

/// Follows detached blocks: damped motion that commits slip at every step and removes
/// them, on the blocks that are out of balance and their neighbours only.
///
/// A stage begins with the elastic displacements that it causes: what is long-ranged is then where
/// it belongs, and only slip, openings and falls are left to be followed. Without them a domain on
/// elastic ground sways, slips while it does, and stays so.
///
/// Local damping acts on every unknown by itself, so a block that slides past rattling neighbours
/// keeps its speed; methods that stop all motion at once (FIRE, kinetic damping) hold it up for
/// ever. The answer overshoots a little (about 2 %), because slip made on the way stays: `TwoLevel`
/// uses it to learn which blocks detach and then starts anew without them.
class Relaxation {
 public:
  using role = roles::Equilibrium;
  static constexpr const char* name = "Relaxation";

  struct Params {
    int max_steps = 60000;
    int check_every = 40;     ///< steps between looks at the whole system
    double damping = 0.7;     ///< local damping [-], 0 <= damping < 1
    double safety = 0.9;      ///< of the stable step [-]
    int rings = 3;            ///< generations of neighbours that move with a body out of balance
    LinearSettings linear{};  ///< of the elastic solve that says whether blocks can be told apart
    /// Bodies out of balance by more than this part of the accepted out-of-balance force ratio move
    /// [-], > 0 and <= 1.
    double active_above = 0.3;
    DetachmentTuning detachment{};
    MotionTuning motion{};  ///< of a stage in which rock fails
  };
  Relaxation() = default;
  /// @throws InvalidInput  a parameter out of range
  explicit Relaxation(const Params& params) : params_(params) {
    require(params.max_steps > 0, "max_steps", params.max_steps, "> 0");
    require(params.check_every > 0, "check_every", params.check_every, "> 0");
    require(params.damping >= 0 && params.damping < 1, "damping", params.damping, ">= 0 and < 1");
    require(params.safety > 0 && params.safety <= 1, "safety", params.safety, "> 0 and <= 1");
    require(params.rings >= 0, "rings", params.rings, ">= 0");
    require(params.active_above > 0 && params.active_above <= 1, "active_above",
            params.active_above, "> 0 and <= 1");
    params.detachment.check();
    params.motion.check();
  }

  /// Accepts when the out-of-balance test has passed and no block is beyond the displacement limit;
  /// no error estimate, because the slip made on the way is not in it.
  template <class System>
  [[nodiscard]] EquilibriumReport find(System& system, const SearchContext& context) const;

  /// The same of a stage that has begun and whose limits are numbers; blocks that come off are
  /// taken out on the way. Adds to what is in the report.
  template <class System>
  void follow(System& system, const SearchContext& context, EquilibriumReport& report) const;

 private:
  template <class System>
  [[nodiscard]] detail::SearchEnd step_on(System& system, const SearchContext& context,
                                          detail::AtAFall at_a_fall,
                                          EquilibriumReport& report) const;
  template <class System>
  static void finish(const System& system, EquilibriumReport& report);

  Params params_;
};

template <class System>
EquilibriumReport Relaxation::find(System& system, const SearchContext& context) const {
  EquilibriumReport report;
  const auto solve = [&](Eigen::VectorXd& f, const SolveTolerance& tolerance) {
    return detail::solve_elastically(system, context, params_.linear, tolerance, f, report);
  };
  const auto search = [&](const SearchContext& stage, detail::AtAFall at_a_fall, const System&,
                          EquilibriumReport& to) {
    Eigen::VectorXd f;
    system.wall_fraction = stage.wall_fraction;
    system.forces(system.displacement, f);
    (void)solve(f, {.relative = 1e-3});
    add_to(system.displacement, f);
    return step_on(system, stage, at_a_fall, to);
  };
  detail::until_stopped(report, [&] {
    detail::carry_out_stage(system, context, solve, params_.detachment, &params_.motion, search,
                            report);
  });
  finish(system, report);
  return report;
}

template <class System>
void Relaxation::follow(System& system, const SearchContext& context,
                        EquilibriumReport& report) const {
  detail::until_stopped(report,
                        [&] { (void)step_on(system, context, detail::AtAFall::goes_on, report); });
  finish(system, report);
}

template <class System>
void Relaxation::finish(const System& system, EquilibriumReport& report) {
  report.broken_bolts = system.supports.broken_count();
  report.largest_displacement = system.largest_translation(system.displacement);
}

template <class System>
detail::SearchEnd Relaxation::step_on(System& system, const SearchContext& context,
                                      detail::AtAFall at_a_fall, EquilibriumReport& report) const {
  constexpr int dof = System::dof;
  const Acceptance& accept = context.acceptance;
  system.wall_fraction = context.wall_fraction;
  Eigen::VectorXd& u = system.displacement;
  Eigen::VectorXd velocity = zeros(u.size()), f;
  const auto masses = [&] {
    return Eigen::VectorXd(critical_mass_share *
                           system.elastic_stiffness(context.progress).absolute_row_sums());
  };
  Eigen::VectorXd mass = masses();
  const double step = params_.safety / std::sqrt(1 + params_.damping);
  StopCheck stop(context.progress, 1);
  for (int made = 0; made < params_.max_steps;) {
    system.template forces<Committing>(u, f);
    if (!is_finite(f))
      throw NumericalFault(message({"relaxation: forces are not finite at step ", report.steps}));
    const std::vector<int> fallen = detail::fallen_bodies(system, accept.displacement_limit);
    if (at_a_fall == detail::AtAFall::gives_up && !fallen.empty()) return detail::SearchEnd::open;
    const bool found = detail::update_when_due(system, context, report);
    if (found || !fallen.empty()) {
      detail::drop(system, fallen, context, report);
      if (detail::has_collapsed<System::dim>(report, context)) return detail::SearchEnd::decided;
      mass = masses();
      continue;
    }
    report.unbalance_over_weight = system.unbalance_over_weight(f);
    if (report.unbalance_over_weight < accept.unbalance_over_weight) {
      if (detail::update_when_due(system, context, report, true)) continue;
      report.verdict = Verdict::stable;
      report.reason = "every block is in equilibrium within the out-of-balance force ratio limit";
      return detail::SearchEnd::decided;
    }
    detail::ask_to_go_on(context);
    ActiveSet<System> active(system, f, zeros(f.size()),
                             params_.active_above * accept.unbalance_over_weight, params_.rings);
    VOUSSOIR_ASSERT(mass.size() == u.size() && velocity.size() == u.size(),
                    "every unknown has a mass and a velocity");
    for (int k = 0; k < params_.check_every && made < params_.max_steps; ++k) {
      stop();
      if (k > 0) active.template forces<Committing>(u, f);
      ++report.steps;
      ++made;
      for (const int b : active.bodies())
        for (int i = dof * b; i < dof * (b + 1); ++i) {
          const double against = velocity[i] > 0 ? 1.0 : (velocity[i] < 0 ? -1.0 : 0.0);
          velocity[i] += step * (f[i] - params_.damping * std::abs(f[i]) * against) / mass[i];
          u[i] += step * velocity[i];
        }
    }
  }
  report.reason = message({"step limit of ", params_.max_steps, " reached"});
  return detail::SearchEnd::open;
}

}  // namespace voussoir
