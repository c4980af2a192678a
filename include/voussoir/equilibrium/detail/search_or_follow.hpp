// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <utility>
#include <vector>
#include <voussoir/core/message.hpp>
#include <voussoir/core/message_number.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/equilibrium/detached_blocks.hpp>
#include <voussoir/equilibrium/displacement_limits.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/unloading_in_motion.hpp>

namespace voussoir::detail {

/// `decided` with a verdict, or with a reason to stop; `open`: something falls, or no end is found.
enum class SearchEnd { decided, open };

/// Whether a search ends `open` as soon as a block has moved further than one seldom does where
/// rock stands (`SearchContext::seldom_moved`); as soon as one comes off; or takes it out and goes
/// on.
enum class AtAFall { gives_up_early, gives_up, goes_on };

/// One stage by a solution procedure of its own and, where rock fails, in motion: the same for all
/// procedures, so that all have the same answer.
///
/// The search gives up where a block comes off or no end is found. The stage is then carried out
/// once more from its beginning, in motion (`UnloadingInMotion`), which tells what comes off; and
/// from its beginning again by the search, without that, so that the state found has neither the
/// overshoot nor the rounding of the motion in it. Only where more would then come off that has
/// been caught in motion does the search go on from where the motion came to rest. A model that
/// cannot be set in motion is searched as it is.
/// @param context  its limits are numbers
/// @param search   search(AtAFall, start, report): the procedure, from where the system is, which
///                 is the state `start`
template <class System, class Search>
void search_or_follow(System& system, const SearchContext& context, const MotionTuning* tuning,
                      Search&& search, EquilibriumReport& report) {
  const auto say_why = [&] {
    if (report.verdict != Verdict::stable) return;
    if (!report.held_at_edge.empty())
      report.reason += message({"; ", report.held_at_edge.size(),
                                report.held_at_edge.size() == 1 ? " block" : " blocks",
                                " that only the edge of the domain touches held there"});
    if (!report.fallen.empty()) report.reason = "within all limits after blocks had detached";
    if (!report.lost_nodes.empty()) report.reason = "within all limits, but " + report.lost_lining;
  };
  if (tuning == nullptr || !can_be_set_in_motion(system, context)) {
    (void)search(AtAFall::goes_on, system, report);
    return say_why();
  }
  const System start(system);
  const std::vector<int> fallen_before = report.fallen;
  const double measure_before = report.fallen_measure;
  if (search(AtAFall::gives_up, start, report) == SearchEnd::decided) return say_why();
  // What the search has taken out on its way is not yet known to have come off.
  const auto back_to = [&](const System& state, std::vector<int> fallen, double measure) {
    system = System(state);
    report.fallen = std::move(fallen);
    report.fallen_measure = measure;
    report.verdict = Verdict::undecided;
    report.reason.clear();
    report.error_estimate = report.unbalance_over_weight = std::numeric_limits<double>::quiet_NaN();
  };
  back_to(start, fallen_before, measure_before);
  UnloadingInMotion<System> stage(system, start, context, *tuning);
  const auto settle = [&] {
    const System moved(system);
    const std::vector<int> fallen = report.fallen;
    const double measure = report.fallen_measure;
    const auto stands_without_them = [&] {
      return report.verdict == Verdict::stable && report.fallen.size() == fallen.size();
    };
    back_to(start, fallen_before, measure_before);
    if (fallen.size() == fallen_before.size() && report.lost_nodes.empty()) {
      // Nothing comes off: the search may take its time, for the shaking of the run breaks joints
      // that a gradual unloading spares.
      (void)search(AtAFall::goes_on, start, report);
      if (stands_without_them()) return;
    } else {
      std::vector<int> off = report.lost_nodes;
      off.insert(off.end(), fallen.begin() + static_cast<std::ptrdiff_t>(fallen_before.size()),
                 fallen.end());
      drop(system, off, context, report);
      if (report.fallen.size() == fallen.size() &&
          search(AtAFall::gives_up, System(system), report) == SearchEnd::decided &&
          stands_without_them())
        return;
    }
    back_to(moved, fallen, measure);
    report.is_from_motion = true;
    if (search(AtAFall::goes_on, moved, report) == SearchEnd::open)
      report.reason =
          "rock came to rest in motion, but no equilibrium within the limits was found there" +
          (report.reason.empty() ? "" : ": " + report.reason) + "; an error_estimate above " +
          message_number(context.acceptance.error_estimate, 3) + " may accept it";
  };
  try {
    if (stage.go(report)) settle();
    report.rockfall = stage.range(report);
  } catch (const Stopped&) {
    back_to(start, fallen_before, measure_before);
    throw;
  }
  say_why();
  if (report.rockfall && report.rockfall->is_near_collapse)
    report.reason +=
        "; near to a collapse: the verdict is another with a tenth more or less than " +
        message_number(context.acceptance.collapse_measure * context.open_length, 3) +
        (System::dim == 2 ? " m2" : " m3") + " as its limit";
}

/// A stage from its beginning, for every solution procedure: what nothing holds is taken out, the
/// limits are chosen, the stage is searched or followed.
/// @param given   the context; its limits may be left to the rock
/// @param solve   solve(f, tolerance) turns forces into elastic displacements, in place, and
/// returns
///                their error [m]
/// @param motion  how it is followed where rock fails; null: it is not
/// @param search  search(context, AtAFall, start, report)
template <class System, class Solve, class Search>
void carry_out_stage(System& system, const SearchContext& given, Solve&& solve,
                     const DetachmentTuning& detachment, const MotionTuning* motion,
                     Search&& search, EquilibriumReport& report) {
  drop(system, {}, given, report);
  if (has_collapsed<System::dim>(report, given)) return;
  const ElasticOutlook outlook = look_ahead(system, given, solve, detachment);
  if (moves_beyond_reason(system, given, outlook.far, report)) return;
  const SearchContext context = limits_by_the_rock(system, given, outlook.far);
  report.displacement_limit = context.acceptance.displacement_limit;
  report.contact_update_limit = context.acceptance.contact_update_limit;
  if (moves_too_far(system, context, outlook.far, report, detachment)) return;
  if (has_collapsed<System::dim>(report, context)) return;  // by what nothing holds
  search_or_follow(
      system, context, motion,
      [&](AtAFall at_a_fall, const System& start, EquilibriumReport& to) {
        return search(context, at_a_fall, start, to);
      },
      report);
}

}  // namespace voussoir::detail
