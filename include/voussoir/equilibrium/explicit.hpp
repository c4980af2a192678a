// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/equilibrium/detached_blocks.hpp>
#include <voussoir/equilibrium/detail/search_or_follow.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/fire.hpp>
#include <voussoir/equilibrium/update_when_due.hpp>
#include <voussoir/linear/elastic_solver.hpp>
#include <voussoir/model/contact_group.hpp>

namespace voussoir {

/// Explicit time stepping with local damping, as distinct element codes do it.
///
/// Here to compare with the paper and to show what dynamics do to the answer: a sudden, lightly
/// damped excavation overshoots, slips on the way, and ends with a crown that has moved 10 to 50 %
/// further although its out-of-balance force is as small as after any other. The wall traction is
/// therefore taken away along a ramp unless `ramp_steps` is zero: blocks that come off on that path
/// are taken out on the way, and nothing is said of a slow one.
///
/// Masses are density-scaled so that the critical step is the same for every unknown (quarter of
/// the Gershgorin row sums): steps are no physical time; `Dynamics` has true ones. Local damping
/// shrinks the stable step: an unknown with damping alpha behaves as if (1 + alpha) times as stiff,
/// so the step is safety / sqrt(1 + alpha) of the undamped critical one.
///
/// Source: Cundall (1987), Distinct element models of rock and soil structure (local damping).
class Explicit {
 public:
  using role = roles::Equilibrium;
  static constexpr const char* name = "Explicit";

  struct Params {
    double damping = 0.7;   ///< local damping alpha [-], 0 <= alpha < 1
    int ramp_steps = 8000;  ///< over which the wall traction goes; 0: sudden
    double safety = 0.9;    ///< of the stable step [-], 0 < safety <= 1
    int max_steps = 200000;
    int check_every = 50;
    LinearSettings linear{};  ///< of the elastic solves: error estimate and a look ahead
    MotionTuning motion{};    ///< of a stage in which rock fails
  };
  Explicit() = default;
  /// @throws InvalidInput  a parameter is outside the range given in Params
  explicit Explicit(const Params& params) : params_(params) {
    require(params.damping >= 0 && params.damping < 1, "damping", params.damping, ">= 0 and < 1");
    require(params.ramp_steps >= 0, "ramp_steps", params.ramp_steps, ">= 0");
    require(params.safety > 0 && params.safety <= 1, "safety", params.safety, "> 0 and <= 1");
    require(params.max_steps > params.ramp_steps, "max_steps", params.max_steps, "> ramp_steps");
    require(params.check_every > 0, "check_every", params.check_every, "> 0");
    params.motion.check();
  }

  /// Accepts on the same three tests as `TwoLevel`; a factor is made for the estimate alone, when
  /// the out-of-balance test has passed.
  template <class System>
  [[nodiscard]] EquilibriumReport find(System& system, const SearchContext& context) const;

  /// The largest stable time step of the undamped system with these masses, from Gershgorin's bound
  /// on every row: 2 / omega, omega^2 <= row sum / mass [s].
  template <class System>
  [[nodiscard]] static double critical_step(const System& system, const Eigen::VectorXd& mass) {
    const Eigen::VectorXd sums = system.elastic_stiffness().absolute_row_sums();
    return 2.0 / std::sqrt(largest_quotient(sums, mass));
  }

 private:
  template <class System>
  [[nodiscard]] double stable_step(const System& system, const Eigen::VectorXd& mass) const {
    return params_.safety * critical_step(system, mass) / std::sqrt(1 + params_.damping);
  }

  template <class System>
  [[nodiscard]] static Eigen::VectorXd masses(const System& system) {
    return critical_mass_share * system.elastic_stiffness().absolute_row_sums();
  }

  template <class System>
  [[nodiscard]] detail::SearchEnd step_on(System& system, const SearchContext& context,
                                          detail::AtAFall at_a_fall,
                                          EquilibriumReport& report) const;

  Params params_;
};

template <class System>
EquilibriumReport Explicit::find(System& system, const SearchContext& context) const {
  EquilibriumReport report;
  const auto solve = [&](Eigen::VectorXd& f, const SolveTolerance& tolerance) {
    return detail::solve_elastically(system, context, params_.linear, tolerance, f, report);
  };
  const auto search = [&](const SearchContext& stage, detail::AtAFall at_a_fall, const System&,
                          EquilibriumReport& to) { return step_on(system, stage, at_a_fall, to); };
  detail::until_stopped(report, [&] {
    // A sudden excavation is a path of its own.
    const MotionTuning* motion = params_.ramp_steps > 0 ? &params_.motion : nullptr;
    detail::carry_out_stage(system, context, solve, {}, motion, search, report);
  });
  report.broken_bolts = system.supports.broken_count();
  return report;
}

template <class System>
detail::SearchEnd Explicit::step_on(System& system, const SearchContext& context,
                                    detail::AtAFall at_a_fall, EquilibriumReport& report) const {
  constexpr int dof = System::dof;
  const Acceptance& accept = context.acceptance;
  const auto solve = [&](Eigen::VectorXd& f, const SolveTolerance& tolerance) {
    return detail::solve_elastically(system, context, params_.linear, tolerance, f, report);
  };
  const double from = system.wall_fraction, to = context.wall_fraction;
  Eigen::VectorXd& u = system.displacement;
  Eigen::VectorXd velocity = zeros(u.size()), f;
  Eigen::VectorXd mass = masses(system), inverse_mass = inverses(mass);
  double step = stable_step(system, mass);
  double next_estimate = 1e300;  // look again only once the force ratio is well below
  const auto goes_on_without_the_fallen = [&] {
    for (int b = 0; b < system.body_count(); ++b)
      if (!system.body(b).movable) set_part<dof>(velocity, dof * b, zeros<Fixed<dof, 1>>());
    report.largest_displacement = system.largest_translation(u);
    if (detail::has_collapsed<System::dim>(report, context)) return false;
    mass = masses(system);
    inverse_mass = inverses(mass);
    step = stable_step(system, mass);
    return true;
  };
  StopCheck stop(context.progress, 1);
  // Without a load that goes there is nothing to do slowly.
  const int ramp_steps = from == to ? 0 : params_.ramp_steps;
  for (int made = 0; made < params_.max_steps;) {
    const bool ramping = made < ramp_steps;
    const double done = ramping ? static_cast<double>(made + 1) / ramp_steps : 1.0;
    stop();
    VOUSSOIR_ASSERT(done > 0 && done <= 1, "a ramp goes from its beginning to its end");
    VOUSSOIR_ASSERT(step > 0, "time goes on");
    // Without a jump in the rate at either end, which would set the rock swinging.
    system.wall_fraction = from + (to - from) * done * done * (3 - 2 * done);
    system.template forces<Committing>(u, f);
    ++report.steps;
    ++made;
    // Velocity Verlet in its leapfrog form: velocities live at half steps.
    // A loop: Eigen's sign() is not made of vector instructions.
    for (Eigen::Index k = 0; k < u.size(); ++k) {
      const double along = velocity[k] > 0 ? 1.0 : velocity[k] < 0 ? -1.0 : 0.0;
      velocity[k] += step * inverse_mass[k] * (f[k] - params_.damping * std::abs(f[k]) * along);
      u[k] += step * velocity[k];
    }
    // What moves fast must not get by more than the reach of contacts into another block.
    constexpr int look_every = 10;
    const bool is_due = made % look_every == 0 && detail::is_due(system, accept);
    if (made % params_.check_every != 0 && !is_due) continue;
    report.largest_displacement = system.largest_translation(u);
    if (!is_finite(u))  // a maximum does not tell: it passes over what is not a number
      throw NumericalFault(message({"explicit stepping: displacements are not finite at step ",
                                    report.steps, "; lower the safety factor of the step"}));
    detail::ask_to_go_on(context, ramping ? done : -1.0);
    const std::vector<int> fallen = detail::fallen_bodies(system, accept.displacement_limit);
    if (at_a_fall == detail::AtAFall::gives_up && !fallen.empty()) return detail::SearchEnd::open;
    const bool found = detail::update_when_due(system, context, report);
    if (found || !fallen.empty()) {
      detail::drop(system, fallen, context, report);
      if (!goes_on_without_the_fallen()) return detail::SearchEnd::decided;
      continue;
    }
    if (ramping) continue;
    report.unbalance_over_weight = system.unbalance_over_weight(f);
    if (report.unbalance_over_weight >= accept.unbalance_over_weight ||
        report.unbalance_over_weight > next_estimate)
      continue;
    Eigen::VectorXd d = f;
    const std::size_t fallen_before = report.fallen.size();
    const double inexact = solve(d, detail::tolerance_of_correction(system, accept));
    if (report.fallen.size() > fallen_before) {  // nothing has held them
      if (!goes_on_without_the_fallen()) return detail::SearchEnd::decided;
      continue;
    }
    report.error_estimate = system.relative_correction(d, u, inexact);
    if (report.error_estimate < accept.error_estimate) {
      if (detail::update_when_due(system, context, report, true)) continue;
      report.verdict = Verdict::stable;
      report.reason =
          "error estimate, out-of-balance force ratio and displacements are within their limits";
      return detail::SearchEnd::decided;
    }
    next_estimate = 0.5 * report.unbalance_over_weight;
  }
  report.reason = message({"step limit of ", params_.max_steps, " reached"});
  return detail::SearchEnd::open;
}

}  // namespace voussoir
