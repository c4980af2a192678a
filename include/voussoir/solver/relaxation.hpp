// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <voussoir/core/errors.hpp>
#include <voussoir/solver/contact_group.hpp>
#include <voussoir/solver/equilibrium.hpp>
#include <voussoir/solver/fire.hpp>

namespace voussoir {

namespace detail {

/// Bodies that moved beyond the limit, and the rock that is lost with them.
template <class System>
[[nodiscard]] std::vector<int> fallen_bodies(const System& system, double limit) {
  std::vector<int> fallen = system.unsupported();
  for (int b = 0; b < system.body_count(); ++b)
    if (system.body(b).movable &&
        !(system.displacement.template segment<System::dim>(System::dof * b).norm() <= limit))
      fallen.push_back(b);
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
  system.remove(bodies);
}

[[nodiscard]] inline std::string collapse_sentence(const EquilibriumReport& report,
                                                   const Acceptance& acceptance) {
  return std::to_string(report.fallen.size()) + " bodies (" + std::to_string(report.fallen_measure) +
         ") fell; more than " + std::to_string(acceptance.collapse_measure) + " is a collapse";
}

}  // namespace detail

/// Follows falling blocks: FIRE that commits slip at every step and removes what has fallen.
///
/// The answer of a committing relaxation overshoots a little (about 2 %), because slip made on the
/// way stays; `TwoLevel` uses it to learn which blocks fall and then starts anew without them.
class Relaxation {
 public:
  using role = roles::Equilibrium;
  static constexpr const char* name = "Relaxation";

  struct Params {
    int max_steps = 40000;
    int check_every = 20;  ///< steps between looks at displacements and forces
    Fire::Params fire{};
  };
  Relaxation() = default;
  explicit Relaxation(const Params& params) : params_(params) {
    require(params.max_steps > 0, "max_steps", params.max_steps, "> 0");
  }

  /// Accepts when the unbalance test has passed and no body is beyond the displacement limit; no
  /// error estimate, for lack of a factor.
  template <class System>
  [[nodiscard]] EquilibriumReport find(System& system, const SearchContext& context) const {
    EquilibriumReport report;
    const Acceptance& accept = context.acceptance;
    system.wall_fraction = context.wall_fraction;
    detail::drop(system, system.unsupported(), context, report);
    Fire fire(system.elastic_stiffness().absolute_row_sums(), params_.fire);
    std::vector<int> movable = system.movable_bodies();
    Eigen::VectorXd f;
    while (report.steps < params_.max_steps) {
      system.template forces<Committing>(system.displacement, f);
      ++report.steps;
      if (report.steps % params_.check_every == 0) {
        const std::vector<int> fallen = detail::fallen_bodies(system, accept.displacement_limit);
        if (!fallen.empty()) {
          detail::drop(system, fallen, context, report);
          if (report.fallen_measure > accept.collapse_measure) {
            report.verdict = Verdict::collapsing;
            report.reason = detail::collapse_sentence(report, accept);
            break;
          }
          movable = system.movable_bodies();
          fire = Fire(system.elastic_stiffness().absolute_row_sums(), params_.fire);
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
          break;
        }
      }
      fire.template advance<System::dof>(movable, f, system.displacement);
    }
    if (report.verdict == Verdict::undecided && report.reason.empty())
      report.reason = "step limit of " + std::to_string(params_.max_steps) + " reached";
    for (const auto& bolt : system.bolts) report.broken_bolts += bolt.state.ruptured;
    report.largest_displacement = System::largest_translation(system.displacement);
    return report;
  }

 private:
  Params params_;
};

}  // namespace voussoir
