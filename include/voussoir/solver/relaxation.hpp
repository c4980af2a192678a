// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/solver/active_set.hpp>
#include <voussoir/solver/contact_group.hpp>
#include <voussoir/solver/equilibrium.hpp>

namespace voussoir {

namespace detail {

/// Bodies that moved beyond the limit, or that nothing touches any more.
template <class System>
[[nodiscard]] std::vector<int> fallen_bodies(const System& system, double limit) {
  std::vector<int> fallen = system.unsupported();
  for (int b = 0; b < system.body_count(); ++b)
    if (system.body(b).movable &&
        !(system.displacement.template segment<System::dim>(System::dof * b).norm() <= limit))
      fallen.push_back(b);
  std::sort(fallen.begin(), fallen.end());
  fallen.erase(std::unique(fallen.begin(), fallen.end()), fallen.end());
  return fallen;
}

template <class System>
void drop(System& system, const std::vector<int>& bodies, const SearchContext& context,
          EquilibriumReport& report) {
  for (const int b : bodies) {
    report.fallen.push_back(b);
    if (context.measures != nullptr)
      report.fallen_measure += (*context.measures)[static_cast<std::size_t>(b)];
  }
  if (!bodies.empty()) system.remove(bodies);
}

/// The reason not to tell falling blocks from the others by how far they moved.
[[nodiscard]] inline std::string moves_too_far(double elastic, double limit) {
  char text[200];
  std::snprintf(text, sizeof text,
                "with joints that neither slip nor open the rock moves %.3g mm, more than half the "
                "displacement limit of %.3g mm: raise displacement_limit",
                1e3 * elastic, 1e3 * limit);
  return text;
}

/// True, with the verdict, if more has fallen than a tunnel can lose.
template <int Dim>
[[nodiscard]] bool has_collapsed(EquilibriumReport& report, const Acceptance& acceptance) {
  if (!(report.fallen_measure > acceptance.collapse_measure)) return false;
  const char* unit = Dim == 2 ? "m2" : "m3";
  char text[160];
  std::snprintf(
      text, sizeof text,
      "%zu block%s of %.3g %s fell before the others came to rest; more than %.3g %s is a "
      "collapse",
      report.fallen.size(), report.fallen.size() == 1 ? "" : "s", report.fallen_measure, unit,
      acceptance.collapse_measure, unit);
  report.verdict = Verdict::collapsing;
  report.reason = text;
  return true;
}

}  // namespace detail

/// Follows falling blocks: damped motion that commits slip at every step and removes what has
/// fallen, on the blocks that are out of balance and their neighbours only.
///
/// Local damping acts on every unknown by itself, so a block that slides past rattling neighbours
/// keeps its speed; methods that stop all motion at once (FIRE, kinetic damping) hold it up for
/// ever. The answer overshoots a little (about 2 %), because slip made on the way stays: `TwoLevel`
/// uses it to learn which blocks fall and then starts anew without them.
class Relaxation {
 public:
  using role = roles::Equilibrium;
  static constexpr const char* name = "Relaxation";

  struct Params {
    int max_steps = 60000;
    int check_every = 40;  ///< steps between looks at the whole system
    double damping = 0.7;  ///< local damping [-], 0 <= damping < 1
    double safety = 0.9;   ///< of the stable step [-]
    int rings = 3;         ///< generations of neighbours that move with a body out of balance
  };
  Relaxation() = default;
  /// @throws InvalidInput  a parameter out of range
  explicit Relaxation(const Params& params) : params_(params) {
    require(params.max_steps > 0, "max_steps", params.max_steps, "> 0");
    require(params.check_every > 0, "check_every", params.check_every, "> 0");
    require(params.damping >= 0 && params.damping < 1, "damping", params.damping, ">= 0 and < 1");
  }

  /// Accepts when the unbalance test has passed and no body is beyond the displacement limit; no
  /// error estimate, for lack of a factor.
  template <class System>
  [[nodiscard]] EquilibriumReport find(System& system, const SearchContext& context) const {
    constexpr int dof = System::dof;
    EquilibriumReport report;
    const Acceptance& accept = context.acceptance;
    system.wall_fraction = context.wall_fraction;
    detail::drop(system, system.unsupported(), context, report);
    Eigen::VectorXd& u = system.displacement;
    Eigen::VectorXd velocity = Eigen::VectorXd::Zero(u.size()), f;
    // Masses of a quarter of the row sums make the critical step 1 for every unknown.
    Eigen::VectorXd mass = 0.25 * system.elastic_stiffness().absolute_row_sums();
    const double step = params_.safety / std::sqrt(1 + params_.damping);
    while (report.steps < params_.max_steps) {
      system.template forces<Committing>(u, f);
      const std::vector<int> fallen = detail::fallen_bodies(system, accept.displacement_limit);
      if (!fallen.empty()) {
        for (const int b : fallen) velocity.template segment<dof>(dof * b).setZero();
        detail::drop(system, fallen, context, report);
        if (detail::has_collapsed<System::dim>(report, accept)) break;
        mass = 0.25 * system.elastic_stiffness().absolute_row_sums();
        continue;
      }
      report.unbalance_over_weight = system.unbalance_over_weight(f);
      if (report.unbalance_over_weight < accept.unbalance_over_weight) {
        report.verdict = Verdict::stable;
        report.reason = "every block is in equilibrium within the unbalance limit";
        break;
      }
      if (context.progress && !context.progress(-1.0)) {
        report.reason = "stopped by the user";
        report.stopped = true;
        break;
      }
      ActiveSet<System> active(system, f, 0.3 * accept.unbalance_over_weight, params_.rings);
      for (int k = 0; k < params_.check_every && report.steps < params_.max_steps; ++k) {
        if (k > 0) active.template forces<Committing>(u, f);
        ++report.steps;
        for (const int b : active.bodies())
          for (int i = dof * b; i < dof * (b + 1); ++i) {
            const double against = velocity[i] > 0 ? 1.0 : (velocity[i] < 0 ? -1.0 : 0.0);
            velocity[i] += step * (f[i] - params_.damping * std::abs(f[i]) * against) / mass[i];
            u[i] += step * velocity[i];
          }
      }
    }
    if (report.verdict == Verdict::undecided && report.reason.empty())
      report.reason = "step limit of " + std::to_string(params_.max_steps) + " reached";
    for (const auto& bolt : system.bolts) report.broken_bolts += bolt.state.ruptured;
    report.largest_displacement = System::largest_translation(u);
    return report;
  }

 private:
  Params params_;
};

}  // namespace voussoir
