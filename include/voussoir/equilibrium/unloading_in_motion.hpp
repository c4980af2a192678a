// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/dynamics/set_in_motion.hpp>
#include <voussoir/equilibrium/detached_blocks.hpp>
#include <voussoir/equilibrium/detail/elastic_balance.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>

namespace voussoir {

/// What is true where rock fails: the stage as it happens, in time.
///
/// The walls are unloaded slowly, along a ramp of twice the time in which a block falls through the
/// displacement limit. A block that has moved further than that limit has come off and is taken
/// out: what it held up may follow. The stage is over when the blocks that are left are in balance
/// and so slow that none would come off within `patience`; or when more has come off than a
/// collapse needs. Local damping takes the energy out; contacts follow the blocks wherever they go.
/// The smaller half of the blocks is made as inert as the larger, which halves the number of steps;
/// and of thousands of blocks only the few that move are stepped.
///
/// Held against all blocks in motion, and the same with half the step and half the rate:
/// tests/equilibrium/rock_failure_test.cpp, bench/failure_table.cpp.
struct MotionTuning {
  double local_damping = 0.7;  ///< [-], >= 0 and < 1
  double safety = 0.9;         ///< of the stable step [-], > 0 and <= 1
  double inert_share = 0.5;    ///< of the bodies get more inertia, for longer steps [-]
  double ramp = 2;             ///< its duration over the time of a fall through the limit [-], > 0
  double rest_ratio = 1e-2;    ///< out-of-balance force ratio at rest [-], > 0
  double patience = 2;         ///< at rest nothing would come off within so long [s], > 0
  double longest = 30;         ///< after which no end is expected [s], > 0
  int looks_in_ramp = 200;     ///< times that the load is changed, and what has come off looked for
  int check_every = 50;        ///< steps between two looks afterwards
  // Who is stepped: bodies that are fast or out of balance, and rings around them. All others are
  // brought to balance elastically (`detail::ElasticBalance`).
  double quiet_speed =
      0.3;                ///< of the speed that comes off within `patience`: faster is fast, >= 0
  int rings = 2;          ///< of bodies that those touch; < 0: all bodies are stepped
  double looseness = 10;  ///< times `rest_ratio`, at which one that is not stepped is seen to, >= 1
  int batches = 20;       ///< of `check_every` steps, after which all are seen to in any case
  unsigned threads = 1;   ///< that share the steps; the result does not depend on it

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(local_damping >= 0 && local_damping < 1, "local_damping", local_damping,
            ">= 0 and < 1");
    require(safety > 0 && safety <= 1, "safety", safety, "> 0 and <= 1");
    require(inert_share >= 0 && inert_share < 1, "inert_share", inert_share, ">= 0 and < 1");
    require(ramp > 0, "ramp", ramp, "> 0");
    require(rest_ratio > 0, "rest_ratio", rest_ratio, "> 0");
    require(patience > 0, "patience", patience, "> 0 s");
    require(longest > 0, "longest", longest, "> 0 s");
    require(looks_in_ramp > 0, "looks_in_ramp", looks_in_ramp, "> 0");
    require(check_every > 0, "check_every", check_every, "> 0");
    require(looseness >= 1, "looseness", looseness, ">= 1");
    require(batches > 0, "batches", batches, "> 0");
    require(quiet_speed >= 0, "quiet_speed", quiet_speed, ">= 0");
  }
};

namespace detail {

/// Whether a model can be set in motion: it knows the shapes of its blocks, and their masses.
template <class System>
[[nodiscard]] bool can_be_set_in_motion(const System& system, const SearchContext& context) {
  for (int b = 0; b < system.body_count(); ++b)
    if (system.body(b).is_block && !(system.body(b).weight > 0)) return false;
  return system.shapes != nullptr && context.gravity > 0 &&
         std::all_of(system.linings.begin(), system.linings.end(),
                     [](const auto& lining) { return lining.thickness > 0; });
}

/// One stage in motion, see `MotionTuning`.
template <class System>
class UnloadingInMotion {
 public:
  static constexpr int dim = System::dim, dof = System::dof;
  using Run = typename MotionOf<System>::type;

  /// @param context  its displacement limit is a number
  UnloadingInMotion(System& system, const SearchContext& context, const MotionTuning& tuning)
      : system_(system),
        context_(context),
        tuning_(tuning),
        limit_(context.acceptance.displacement_limit),
        from_(system.wall_fraction),
        run_(set_in_motion(system, {.gravity = context.gravity,
                                    .local_damping = tuning.local_damping,
                                    .safety = tuning.safety,
                                    .points = ContactPoints::gauss,
                                    .overlap_limit = 0.5,
                                    .check_every = sound_every,
                                    .threads = tuning.threads})) {
    duration_ = tuning.ramp * std::sqrt(2 * limit_ / context.gravity);
    run_.add_inertia(tuning.inert_share);
    if (tuning.rings >= 0) rest_of_rock_.emplace(system, context);
    settled_at_ = tuning.rest_ratio;
  }

  /// Carries the stage out, and leaves the model where it ends.
  /// @return  true if the rock has come to rest; else the report says what has become of it
  /// @throws Stopped  the model is as it was
  bool go(EquilibriumReport& report) {
    bool rests = false;
    try {
      rests = follow(report);
    } catch (const NumericalFault& fault) {
      report.reason = std::string("the stage could not be followed in motion: ") + fault.what();
    }
    bring_to_rest(run_, system_, gone_);
    report.steps += static_cast<int>(run_.steps());
    report.largest_displacement = system_.largest_translation(system_.displacement);
    return rests;
  }

 private:
  [[nodiscard]] static std::size_t index(int b) { return static_cast<std::size_t>(b); }

  bool follow(EquilibriumReport& report) {
    double done = 0;
    while (run_.time() < tuning_.longest) {
      if (done < 1) {
        // Where nothing moves the load may change by more at a time.
        const double now =
            std::min(done + (quiet_looks_ > 0 ? 4.0 : 1.0) / tuning_.looks_in_ramp, 1.0);
        run_.set_held(from_ + (context_.wall_fraction - from_) * now);
        choose_who_moves(report);
        run_.advance(duration_ * (now - done));
        quiet_looks_ = moving_.empty() ? quiet_looks_ + 1 : 0;
        done = now;
      } else {
        if (is_to_choose()) choose_who_moves(report);
        run_.advance_steps(tuning_.check_every);
      }
      ask_to_go_on(context_);
      take_out(report);
      take_out_linings(report);
      if (has_collapsed<dim>(report, context_)) return false;
      if (done >= 1 && rests(report)) return true;
    }
    report.reason =
        message({"rock was still moving ", tuning_.longest,
                 " s after the walls were unloaded: it neither comes off nor comes to rest"});
    return false;
  }

  [[nodiscard]] bool is_fast(int b, double share) const {
    return run_.velocity(b).norm() * tuning_.patience > share * limit_;
  }
  [[nodiscard]] bool is_restless(int b) {
    return is_fast(b, tuning_.quiet_speed) ||
           run_.unbalance_of(b) > (run_.moves(b) ? tuning_.rest_ratio : settled_at_);
  }
  /// Whether those that move have brought others out of balance, or have come to rest themselves.
  [[nodiscard]] bool is_to_choose() {
    if (moving_.empty() || ++batches_ >= tuning_.batches) return true;
    const auto is_restless = [this](int b) { return this->is_restless(b); };
    if (std::none_of(moving_.begin(), moving_.end(), is_restless) ||
        std::any_of(fringe_.begin(), fringe_.end(), is_restless))
      return true;
    // A bolt or a lining reaches further than contacts do.
    for (const auto& support : run_.supports())
      for (const int b : support->bodies())
        if (!run_.moves(b) && is_restless(b)) return true;
    return false;
  }

  /// Brings the bodies that are quiet to balance, and lets the others move.
  void choose_who_moves(EquilibriumReport& report) {
    if (!rest_of_rock_) return;
    balance(settled_at_, report);
    batches_ = 0;
    moving_.clear();
    fringe_.clear();
    BodyMarks marks(index(run_.body_count()), 0);
    for (int b = 0; b < run_.body_count(); ++b)
      if (run_.body(b).movable() && is_restless(b)) {
        marks[index(b)] = 1;
        moving_.push_back(b);
      }
    // A lining goes as a whole: held by those of its nodes that are not stepped it would never
    // slide.
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      for (const auto& support : run_.supports())
        for (const auto& [a, b] : support->links()) {
          if (marks[index(a)] == marks[index(b)]) continue;
          const int other = marks[index(a)] != 0 ? b : a;
          marks[index(other)] = 1;
          moving_.push_back(other);
          goes_on = true;
        }
    }
    // Ring after ring of those that they touch; the last is watched.
    std::size_t first = 0;
    for (int ring = 0; ring <= tuning_.rings; ++ring) {
      const std::size_t last = moving_.size();
      std::vector<int>& next = ring < tuning_.rings ? moving_ : fringe_;
      for (; first < last; ++first)
        run_.each_neighbour(moving_[first], [&](int other) {
          if (std::exchange(marks[index(other)], char{1}) == 0) next.push_back(other);
        });
    }
    run_.move_only(moving_);
    settled_at_ = (run_.time() < duration_ ? 1 : tuning_.looseness) * tuning_.rest_ratio;
  }
  void balance(double settled_at, EquilibriumReport& report) {
    rest_of_rock_->balance(
        run_, [this](int b) { return is_fast(b, tuning_.quiet_speed); }, settled_at, report);
  }

  void leave_out(const std::vector<int>& off) {
    if (off.empty()) return;
    run_.remove(off);
    batches_ = tuning_.batches;
  }

  /// Takes out what has come off.
  void take_out(EquilibriumReport& report) {
    std::vector<int> off;
    for (int b = 0; b < run_.body_count(); ++b)
      if (run_.body(b).movable() && system_.body(b).is_block &&
          (run_.position(b) - system_.body(b).centre).norm() > limit_)
        off.push_back(b);
    for (const int b : off) {
      gone_.push_back(b);
      report.fallen.push_back(b);
      if (context_.measures != nullptr) report.fallen_measure += (*context_.measures)[index(b)];
    }
    leave_out(off);
  }

  /// Takes out linings that have come off: one that slides off its wall carries nothing, and holds
  /// nothing that could be taken for support.
  void take_out_linings(EquilibriumReport& report) {
    std::vector<int> off;
    for (const auto& lining : system_.linings) {
      const int count = static_cast<int>(lining.surface.node_count());
      for (int b = lining.first; b < lining.first + count; ++b) {
        if (!run_.body(b).movable()) continue;
        const double moved = (run_.position(b) - system_.body(b).centre).norm();
        if (!(moved > limit_)) continue;
        report.lost_lining =
            message({"the lining comes off the wall: at ", text_of<dim>(system_.body(b).centre),
                     " m it has moved ", moved,
                     " m, more than the displacement limit; give its ends feet, "
                     "close it, bond it to the rock, or make it stiffer"});
        for (int node = lining.first; node < lining.first + count; ++node) off.push_back(node);
        break;
      }
    }
    report.lost_nodes.insert(report.lost_nodes.end(), off.begin(), off.end());
    gone_.insert(gone_.end(), off.begin(), off.end());
    leave_out(off);
  }

  [[nodiscard]] bool rests(EquilibriumReport& report) {
    const auto rests = [this](int b) {
      return !is_fast(b, 1) && run_.unbalance_of(b) < tuning_.rest_ratio;
    };
    if (rest_of_rock_) {
      if (!std::all_of(moving_.begin(), moving_.end(), rests)) return false;
      settled_at_ = tuning_.rest_ratio;
      balance(settled_at_, report);
    }
    for (int b = 0; b < run_.body_count(); ++b)
      if (run_.body(b).movable() && !rests(b)) return false;
    return true;
  }

  System& system_;
  const SearchContext& context_;
  const MotionTuning& tuning_;
  double limit_;         ///< [m]
  double from_;          ///< wall fraction at the start
  double duration_ = 0;  ///< of the ramp [s]
  Run run_;
  std::optional<ElasticBalance<System>> rest_of_rock_;
  std::vector<int> gone_;
  std::vector<int> moving_, fringe_;  ///< and those that they touch
  double settled_at_ = 0;             ///< ratio up to which one that does not move is in balance
  int quiet_looks_ = 0;               ///< in the ramp: one after the other with nothing that moves
  int batches_ = 0;                   ///< since who moves was chosen
  static constexpr int sound_every = 2000;  ///< steps between run diagnostics, which look at all
};

}  // namespace detail

}  // namespace voussoir
