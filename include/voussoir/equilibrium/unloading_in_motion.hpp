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
#include <voussoir/equilibrium/motion_tuning.hpp>

namespace voussoir::detail {

/// Local damping is no property of rock: an answer that hangs on it is marginal [-].
[[nodiscard]] constexpr double other_damping(double local_damping) {
  return local_damping > 0.5 ? 0.1 : 0.7;
}

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
  using Run = Motion<System::dim, typename System::Detector>;

  /// @param start    what the system is now, and stays
  /// @param context  its displacement limit is a number
  UnloadingInMotion(System& system, const System& start, const SearchContext& context,
                    const MotionTuning& tuning)
      : system_(system),
        start_(start),
        context_(context),
        tuning_(tuning),
        limit_(context.acceptance.displacement_limit),
        reach_(limit_ - context.carried),
        rest_ratio_(std::min(tuning.rest_ratio, context.acceptance.unbalance_over_weight)),
        run_(set_in_motion(system, {.gravity = context.gravity,
                                    .local_damping = tuning.local_damping,
                                    .viscous_damping = tuning.viscous_damping,
                                    .safety = tuning.safety,
                                    .overlap_limit = 0.5,
                                    .check_every = sound_every,
                                    .goes_back = false,
                                    .threads = tuning.threads})) {
    duration_ = tuning.ramp * std::sqrt(2 * reach_ / context.gravity);
    run_.add_inertia(tuning.inert_share);
    if (tuning.rings >= 0) rest_of_rock_.emplace(start_, context);
    way_.limit = limit_;
    way_.settled_at = rest_ratio_;
  }

  /// Carries the stage out, and leaves the model where it ends.
  /// @return  true if the rock has come to rest; else the report says what has become of it, and
  ///          where the run went bad, the model is where it was, without what had come off
  /// @throws Stopped  the model is as it was
  bool go(EquilibriumReport& report) {
    bool rests = false;
    try {
      rests = follow(report);
      report.motion = run_.energy();
      bring_to_rest(run_, system_, way_.gone);
    } catch (const NumericalFault& fault) {
      report.reason = std::string("the stage could not be followed in motion: ") + fault.what();
      system_.remove(way_.gone);
    }
    report.steps += static_cast<int>(run_.steps());
    report.largest_displacement = system_.largest_translation(system_.displacement);
    return rests;
  }

  /// Follows the stage in other ways, as `RangeSought` says; leaves the model alone. None where no
  /// block has come half as far as the limit.
  /// @param report  of the stage, with its verdict; its effort is counted on
  /// @throws Stopped
  [[nodiscard]] std::optional<RockfallRange> range(EquilibriumReport& report) {
    if (!half_) return std::nullopt;
    is_varied_ = true;
    RockfallRange range{report.fallen_measure, report.fallen_measure};
    range.is_collapse = report.verdict == Verdict::collapse;
    if (tuning_.range == RangeSought::all) range.is_near_collapse = is_near_collapse(report);
    const auto vary = [&](const std::optional<Fork>& fork, double limit, double slowness,
                          double damping) {
      if (!fork || (tuning_.range == RangeSought::until_marginal && range.is_marginal())) return;
      EquilibriumReport varied = go_back_to(*fork);
      way_.limit = limit;
      way_.slowness = slowness;
      run_.set_local_damping(damping);
      const auto before = run_.steps();
      try {
        if (follow(varied)) varied.verdict = Verdict::stable;
      } catch (const NumericalFault&) {
        varied.verdict = Verdict::undecided;
      }
      report.steps += static_cast<int>(run_.steps() - before);
      report.elastic_solves += varied.elastic_solves;
      range.low = std::min(range.low, varied.fallen_measure);
      range.high = std::max(range.high, varied.fallen_measure);
      range.has_other_verdict = range.has_other_verdict || varied.verdict != report.verdict;
    };
    // The cheap ones first.
    const double damping = tuning_.local_damping;
    vary(half_, context_.carried + 0.5 * reach_, 1, damping);
    vary(slow_ ? slow_ : half_, limit_, 1, other_damping(damping));
    vary(off_, context_.carried + 3 * reach_, 1, damping);
    vary(slow_, limit_, 2, damping);
    return range;
  }

 private:
  /// What there is to know about a stage on its way, besides the run.
  struct Way {
    double limit = 0;           ///< beyond which a block has come off [m]
    double slowness = 1;        ///< of the ramp, times its duration
    double collapse_share = 1;  ///< of what counts as a collapse, at which the way ends
    double done = 0;            ///< of the ramp
    std::vector<int> gone;
    std::vector<int> moving, fringe;  ///< and those that they touch
    double settled_at = 0;            ///< ratio up to which one that does not move is in balance
    int batches = 0;                  ///< since who moves was chosen
  };
  /// Where another way begins.
  struct Fork {
    Way way;
    typename Run::State run;
    EquilibriumReport report;
  };

  [[nodiscard]] static std::size_t index(int b) { return static_cast<std::size_t>(b); }

  bool follow(EquilibriumReport& report) {
    const double from = start_.wall_fraction;
    while (run_.time() < tuning_.longest) {
      if (way_.done < 1) {
        const double speed = fastest();
        if (speed > quiet_speed()) fork(slow_, report);
        const double now = std::min(
            way_.done + (speed <= tuning_.slow * quiet_speed() ? tuning_.looks_at_once : 1.0) /
                            tuning_.looks_in_ramp,
            1.0);
        run_.set_held(from + (context_.wall_fraction - from) * now);
        choose_who_moves(report);
        run_.advance(way_.slowness * duration_ * (now - way_.done));
        way_.done = now;
      } else {
        if (is_to_choose()) choose_who_moves(report);
        run_.advance_steps(tuning_.check_every);
      }
      ask_to_go_on(context_);
      take_out(report);
      if (has_collapsed<dim>(report, context_, way_.collapse_share)) return false;
      if (way_.done >= 1 && rests(report)) return true;
    }
    report.reason =
        message({"blocks were still moving ", tuning_.longest,
                 " s after the change of load: they neither come off nor come to rest"});
    return false;
  }

  /// Goes on with a collapse until much more has come off than it takes.
  /// @param report  its effort is counted on
  [[nodiscard]] bool is_near_collapse(EquilibriumReport& report) {
    constexpr double near = RockfallRange::near_collapse;
    const double limit = context_.acceptance.collapse_measure * context_.open_length;
    if (report.verdict != Verdict::collapse) return report.fallen_measure >= (1 - near) * limit;
    EquilibriumReport further = report;
    way_.collapse_share = 1 + near;
    const auto before = run_.steps();
    try {
      if (!has_collapsed<dim>(further, context_, way_.collapse_share)) (void)follow(further);
    } catch (const NumericalFault&) {
      return false;  // nothing is known
    }
    report.steps += static_cast<int>(run_.steps() - before);
    report.elastic_solves = further.elastic_solves;
    return further.fallen_measure <= way_.collapse_share * limit;
  }

  /// @return  the report of that moment, without the elastic solves before it
  [[nodiscard]] EquilibriumReport go_back_to(const Fork& fork) {
    way_ = fork.way;
    run_.go_back_to(fork.run);
    return fork.report;
  }
  void fork(std::optional<Fork>& fork, const EquilibriumReport& report) {
    if (tuning_.range == RangeSought::none || is_varied_ || fork) return;
    fork.emplace(Fork{way_, run_.state(), report});
    fork->report.elastic_solves = 0;
  }

  /// Of those that are stepped [m/s].
  [[nodiscard]] double fastest() const {
    double most = 0;
    for (const int b : way_.moving) most = std::max(most, run_.velocity(b).norm());
    return most;
  }
  /// Faster is fast [m/s].
  [[nodiscard]] double quiet_speed() const {
    return tuning_.quiet_speed * reach_ / tuning_.patience;
  }
  [[nodiscard]] bool is_fast(int b) const { return run_.velocity(b).norm() > quiet_speed(); }
  [[nodiscard]] bool is_restless(int b) {
    return is_fast(b) || run_.unbalance_of(b) > (run_.moves(b) ? rest_ratio_ : way_.settled_at);
  }
  /// Whether those that move have brought others out of balance, or have come to rest themselves.
  [[nodiscard]] bool is_to_choose() {
    if (way_.moving.empty() || ++way_.batches >= tuning_.batches) return true;
    const auto is_restless = [this](int b) { return this->is_restless(b); };
    if (std::none_of(way_.moving.begin(), way_.moving.end(), is_restless) ||
        std::any_of(way_.fringe.begin(), way_.fringe.end(), is_restless))
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
    balance(way_.settled_at, report);
    way_.batches = 0;
    way_.moving.clear();
    way_.fringe.clear();
    BodyMarks marks(index(run_.body_count()), 0);
    for (int b = 0; b < run_.body_count(); ++b)
      if (run_.body(b).movable() && is_restless(b)) {
        marks[index(b)] = 1;
        way_.moving.push_back(b);
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
          way_.moving.push_back(other);
          goes_on = true;
        }
    }
    // Ring after ring of those that they touch; the last is watched.
    std::size_t first = 0;
    for (int ring = 0; ring <= tuning_.rings; ++ring) {
      const std::size_t last = way_.moving.size();
      std::vector<int>& next = ring < tuning_.rings ? way_.moving : way_.fringe;
      for (; first < last; ++first)
        run_.each_neighbour(way_.moving[first], [&](int other) {
          if (std::exchange(marks[index(other)], char{1}) == 0) next.push_back(other);
        });
    }
    run_.move_only(way_.moving);
    way_.settled_at = (way_.done < 1 ? 1 : tuning_.looseness) * rest_ratio_;
  }
  void balance(double settled_at, EquilibriumReport& report) {
    rest_of_rock_->balance(
        run_, [this](int b) { return is_fast(b); }, settled_at, report);
  }

  /// Takes out what has come off: blocks, and linings.
  void take_out(EquilibriumReport& report) {
    if (comes_off(context_.carried + 0.5 * reach_)) fork(half_, report);
    if (!comes_off(way_.limit)) return;
    fork(off_, report);
    std::vector<int> off;
    for (int b = 0; b < run_.body_count(); ++b)
      if (is_rock(b) && has_left(b, way_.limit)) {
        off.push_back(b);
        report.fallen.push_back(b);
        if (context_.measures != nullptr) report.fallen_measure += (*context_.measures)[index(b)];
      }
    take_out_linings(off, report);
    way_.gone.insert(way_.gone.end(), off.begin(), off.end());
    run_.remove(off);
    way_.batches = tuning_.batches;
  }
  /// A lining that slides off its wall carries nothing, and holds nothing that could be taken for
  /// support.
  void take_out_linings(std::vector<int>& off, EquilibriumReport& report) {
    for (const auto& lining : start_.linings) {
      const int end = lining.first + static_cast<int>(lining.surface.node_count());
      for (int b = lining.first; b < end; ++b) {
        if (!has_left(b, way_.limit)) continue;
        report.lost_lining =
            message({"the lining comes off the wall: at ", text_of<dim>(start_.body(b).centre),
                     " m it has moved ", way_of(b),
                     " m, more than the displacement limit; give its ends feet, "
                     "close it, bond it to the rock, or make it stiffer"});
        for (int node = lining.first; node < end; ++node) {
          off.push_back(node);
          report.lost_nodes.push_back(node);
        }
        break;
      }
    }
  }
  [[nodiscard]] bool is_rock(int b) const { return start_.body(b).is_block; }
  /// From where it was in situ [m].
  [[nodiscard]] double way_of(int b) const {
    return (run_.position(b) - start_.body(b).centre).norm();
  }
  [[nodiscard]] bool has_left(int b, double limit) const {
    return run_.body(b).movable() && way_of(b) > limit;
  }
  [[nodiscard]] bool comes_off(double limit) const {
    for (int b = 0; b < run_.body_count(); ++b)
      if (is_rock(b) && has_left(b, limit)) return true;
    for (const auto& lining : start_.linings)
      for (int k = 0; k < static_cast<int>(lining.surface.node_count()); ++k)
        if (has_left(lining.first + k, limit)) return true;
    return false;
  }

  [[nodiscard]] bool rests(EquilibriumReport& report) {
    const auto rests = [this](int b) {
      return run_.velocity(b).norm() * tuning_.patience <= reach_ &&
             run_.unbalance_of(b) < rest_ratio_;
    };
    if (rest_of_rock_) {
      if (!std::all_of(way_.moving.begin(), way_.moving.end(), rests)) return false;
      way_.settled_at = rest_ratio_;
      balance(way_.settled_at, report);
    }
    for (int b = 0; b < run_.body_count(); ++b)
      if (run_.body(b).movable() && !rests(b)) return false;
    return true;
  }

  System& system_;
  const System& start_;  ///< what the stage begins with
  const SearchContext& context_;
  const MotionTuning& tuning_;
  double limit_;  ///< [m]
  double reach_;  ///< of which a block moves itself, beyond what it is carried [m]
  /// A block that slides, out of balance by less than the tuning's ratio, is not at rest where that
  /// much is more than is accepted [-].
  double rest_ratio_;
  double duration_ = 0;  ///< of the ramp [s]
  Run run_;
  std::optional<ElasticBalance<System>> rest_of_rock_;
  Way way_;
  std::optional<Fork> half_, off_, slow_;
  bool is_varied_ = false;                  ///< the stage itself is over
  static constexpr int sound_every = 2000;  ///< steps between run diagnostics, which look at all
};

}  // namespace voussoir::detail
