// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/dynamics/set_in_motion.hpp>
#include <voussoir/equilibrium/detached_blocks.hpp>
#include <voussoir/equilibrium/detail/search_or_follow.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>

namespace voussoir_bench {

/// The reference where rock fails: every block in motion, as inert as it is, the wall unloaded
/// within a second; what has moved beyond the displacement limit is taken out, and a lining that
/// has. It shares with the procedures the mechanics of joints and supports, and what a displacement
/// limit is; it has no search, no elastic balance, no choice of who moves, no added inertia.
///
/// What it varies is not physics: a tunnel whose answer hangs on it has no single answer.
class AllBlocksInMotion {
 public:
  using role = voussoir::roles::Equilibrium;
  static constexpr const char* name = "AllBlocksInMotion";

  struct Params {
    double local_damping = 0.1;  ///< besides dashpots at contacts
    double safety = 0.9;         ///< of the stable step
    double duration = 1;         ///< of the unloading [s]
    double limit_share = 1;      ///< of the displacement limit that the rock has
    bool joint_fibres = false;   ///< see `DynamicsSettings`
  };
  AllBlocksInMotion() = default;
  explicit AllBlocksInMotion(const Params& params) : params_(params) {}

  template <class System>
  [[nodiscard]] voussoir::EquilibriumReport find(System& system,
                                                 const voussoir::SearchContext& context) const {
    using namespace voussoir;
    EquilibriumReport report;
    const auto solve = [&](Eigen::VectorXd& f, const SolveTolerance& tolerance) {
      return detail::solve_elastically(system, context, {}, tolerance, f, report);
    };
    const auto search = [&](const SearchContext& stage, detail::AtAFall, const System&,
                            EquilibriumReport& to) {
      follow(system, stage, to);
      return detail::SearchEnd::decided;
    };
    detail::carry_out_stage(system, context, solve, {}, nullptr, search, report);
    return report;
  }

 private:
  static constexpr double rest_ratio = 1e-2;  ///< out-of-balance force ratio at rest
  static constexpr double patience = 2;   ///< at rest: nothing would come off within so long [s]
  static constexpr double longest = 30;   ///< after which no end is expected [s]
  static constexpr int check_every = 50;  ///< steps

  /// The stage, from where the system is; leaves it where the run ends.
  template <class System>
  void follow(System& system, const voussoir::SearchContext& context,
              voussoir::EquilibriumReport& report) const {
    using namespace voussoir;
    const double reach = context.acceptance.displacement_limit - context.carried;
    const double limit = context.carried + params_.limit_share * reach;
    const double from = system.wall_fraction, to = context.wall_fraction;
    auto run = set_in_motion(system, {.gravity = context.gravity,
                                      .local_damping = params_.local_damping,
                                      .viscous_damping = 0.3,
                                      .safety = params_.safety,
                                      .joint_fibres = params_.joint_fibres});
    std::vector<int> gone;
    const auto has_left = [&](int b) {
      return run.body(b).movable() && (run.position(b) - system.body(b).centre).norm() > limit;
    };
    const auto take_out = [&] {
      std::vector<int> off;
      for (int b = 0; b < run.body_count(); ++b)
        if (system.body(b).is_block && has_left(b)) {
          off.push_back(b);
          report.fallen.push_back(b);
          report.fallen_measure += (*context.measures)[static_cast<std::size_t>(b)];
        }
      for (const auto& lining : system.linings) {
        const int end = lining.first + static_cast<int>(lining.surface.node_count());
        bool is_lost = false;
        for (int b = lining.first; b < end; ++b) is_lost = is_lost || has_left(b);
        if (!is_lost) continue;
        report.lost_lining = "the lining comes off the wall";
        for (int b = lining.first; b < end; ++b) {
          off.push_back(b);
          report.lost_nodes.push_back(b);
        }
      }
      if (off.empty()) return;
      gone.insert(gone.end(), off.begin(), off.end());
      run.remove(off);
    };
    // The same with every limit: what rests is no part of what is varied.
    const auto rests = [&] {
      if (run.unbalance_over_weight() >= rest_ratio) return false;
      for (int b = 0; b < run.body_count(); ++b)
        if (run.body(b).movable() && run.velocity(b).norm() * patience > reach) return false;
      return true;
    };
    report.reason = "blocks neither come off nor come to rest";
    for (bool goes_on = true; goes_on && run.time() < longest;) {
      const double done = std::min(run.time() / params_.duration, 1.0);
      run.set_held(from + (to - from) * done);
      run.advance_steps(check_every);
      take_out();
      if (detail::has_collapsed<System::dim>(report, context)) {
        goes_on = false;
      } else if (done == 1 && rests()) {
        report.verdict = Verdict::stable;
        report.reason = "all blocks have come to rest";
        goes_on = false;
      }
    }
    bring_to_rest(run, system, gone);
    report.largest_displacement = system.largest_translation(system.displacement);
  }

  Params params_;
};

/// What is varied, each by itself, from the first on; the last is another rule for joints.
struct Variation {
  const char* name;
  AllBlocksInMotion::Params motion;
};
inline constexpr Variation variations[] = {
    {"reference", {}},
    {"damping_03", {.local_damping = 0.3}},
    {"damping_07", {.local_damping = 0.7}},
    {"half_step", {.safety = 0.45}},
    {"half_rate", {.duration = 2}},
    {"limit_x3", {.limit_share = 3}},
    {"fibres", {.joint_fibres = true}},
};
/// @param references  0: none, 1: the first, 2: all but the last, 3: all
[[nodiscard]] constexpr bool is_wanted(std::size_t variation, int references) {
  return variation == 0 ? references > 0
                        : references > (variation + 1 < std::size(variations) ? 1 : 2);
}

}  // namespace voussoir_bench
