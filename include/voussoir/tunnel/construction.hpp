// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/foot_bearing.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/rockmass/carving_limits.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/solver/creep.hpp>
#include <voussoir/tunnel/chosen_nodes.hpp>
#include <voussoir/tunnel/construction_checks.hpp>
#include <voussoir/tunnel/lining_ribs.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/placed_load.hpp>

namespace voussoir {

// How a tunnel is built, as plain data, and the function that carries it out on a solver: excavate,
// support, let the rock come to rest, stage by stage.

/// Rock that is taken out at once.
template <class Geometry>
struct Round {
  typename Geometry::Opening opening;
  double smallest_piece = of_the_rock;  ///< see `ComposedSolver::excavate`
};

/// Bolts of one law. `bolt_bars` makes the bars of a pattern.
template <class Solver>
struct BoltInstallation {
  std::vector<typename Solver::Geometry::Line> bars;  ///< head first [m]
  typename Solver::BoltLaw law;
  double spacing = 1;  ///< between bolts along the tunnel (2-D) [m], > 0
  typename Solver::Anchors anchors = typename Solver::Anchors();
};

/// A lining on the wall of an opening.
template <class Solver>
struct LiningInstallation {
  /// Where nodes and members lie: `LiningRing` in 2-D, `LiningRibs` in 3-D.
  using Layout = std::conditional_t<Solver::dim == 2, LiningRing, LiningRibs>;
  Layout layout = {};
  std::vector<LiningSection> sections;  ///< those that the members of the layout name
  typename Solver::InterfaceLaw interface_law;
  /// That is lined: the last one, unless another is given, or the section that several rounds make.
  std::optional<typename Solver::Geometry::Opening> opening = {};
  /// On which ends of an arc stand that do not go on in a lining; none: they hang free.
  std::optional<FootBearing> feet = {};
};

/// A lining that stands and whose material has aged, see `ComposedSolver::stiffen_lining`.
struct LiningStiffening {
  int lining = 0;     ///< in the order of installation, from 0
  double factor = 1;  ///< new over old stiffness [-], > 0
};

/// One stage, in this order: linings that stand age; rock is taken out; bolts and linings are
/// installed where the rock is then, free of force but for pretension; the walls lose traction
/// until the stage's part of it is left, loads on blocks come on as far as that, and the rock and
/// its supports come to rest; then joints creep for as long as it lasts.
template <class Solver>
struct ConstructionStage {
  using Opening = typename Solver::Geometry::Opening;
  std::string name;
  /// Part of the in-situ traction that is left on the walls at the end [-], 0 to 1.
  double wall_traction = 0;
  double duration = 0;  ///< for which joints then creep [s], >= 0
  std::vector<LiningStiffening> stiffened = {};
  std::vector<Round<typename Solver::Geometry>> rounds;
  std::vector<BoltInstallation<Solver>> bolts;
  std::vector<LiningInstallation<Solver>> linings;
  std::vector<PlacedLoad<Solver::dim>> loads;  ///< after these nothing more is excavated

  ConstructionStage& excavate(Opening opening, double smallest_piece = of_the_rock) {
    rounds.push_back({std::move(opening), smallest_piece});
    return *this;
  }
  ConstructionStage& install_bolts(BoltInstallation<Solver> pattern) {
    bolts.push_back(std::move(pattern));
    return *this;
  }
  ConstructionStage& install_lining(LiningInstallation<Solver> lining) {
    linings.push_back(std::move(lining));
    return *this;
  }
  ConstructionStage& load_block(PlacedLoad<Solver::dim> load) {
    loads.push_back(std::move(load));
    return *this;
  }
};

/// All stages, and how equilibrium is found in each.
///
///   Construction<Tunnel> plan;
///   plan.add_stage("excavation", 0.4).excavate(opening);
///   plan.add_stage("support").install_bolts({bolt_bars(pattern, opening), bolt});
///   const auto built = construct(tunnel, plan);
template <class Solver>
struct Construction {
  std::vector<ConstructionStage<Solver>> stages;
  typename Solver::Method method = typename Solver::Method();
  Acceptance acceptance;
  /// Whose convergence is given, whatever is taken out besides; none: of the last opening and those
  /// that it is joined to.
  std::optional<typename Solver::Geometry::Opening> measured = {};
  /// Durations may be those in which linings age, and no joint creeps.
  bool ages = false;

  /// @param wall_traction  part of the in-situ traction left at the end [-], 0 to 1
  /// @return  the new stage, until the next is added
  ConstructionStage<Solver>& add_stage(const std::string& name, double wall_traction = 0) {
    ConstructionStage<Solver>& stage = stages.emplace_back();
    stage.name = name;
    stage.wall_traction = wall_traction;
    return stage;
  }
};

/// What counts as a collapse of an opening, for `Acceptance::collapse_measure` [m^2]: a quarter of
/// its own area, more than any spalling and less than any cave.
[[nodiscard]] inline double collapse_measure_of(const SimplePolygon& opening) {
  return 0.25 * opening.area();
}

/// Where joints have crept to in a stage.
struct CreptState {
  double time;  ///< since the stage came to rest [s]
  EquilibriumReport report;
  Convergence convergence;  ///< [m]; in 3-D of the whole length
};

/// A stage and what came of it.
struct StageResult {
  std::string name;
  double wall_traction = 0;        ///< residual, the largest of all rounds, when it ended [-]
  double wall_traction_asked = 0;  ///< at its end; reached unless the stage ended before [-]
  EquilibriumReport report = {};
  Convergence convergence = {};  ///< at its end [m]; in 3-D of the whole length
  /// While joints crept, the last at the end of the stage unless one was not stable; empty where
  /// none do.
  std::vector<CreptState> crept = {};

  /// Of its end.
  [[nodiscard]] const EquilibriumReport& last() const {
    return crept.empty() ? report : crept.back().report;
  }
  /// Rock that came off in it [m^2], [m^3].
  [[nodiscard]] double fallen_measure() const {
    double sum = report.fallen_measure;
    for (const CreptState& state : crept) sum += state.report.fallen_measure;
    return sum;
  }

  /// False where blocks detached or the search ended while the wall was still being unloaded.
  [[nodiscard]] bool fully_unloaded() const {
    return std::abs(wall_traction - wall_traction_asked) < 1e-9;
  }
};

/// What came of a construction.
template <class Geometry>
struct ConstructionResult {
  std::vector<StageResult> stages;  ///< those that were begun
  double fallen_before = 0;         ///< rock that had detached before it began [m^2], [m^3]
  /// Whose convergence was given, see `Construction::measured`.
  std::optional<typename Geometry::Opening> measured = {};

  /// Of the last stage that was begun. @pre there is one
  [[nodiscard]] const EquilibriumReport& last() const { return stages.back().last(); }
  /// That of the last stage; a stage that does not end stable ends the construction. In words:
  /// `to_string(verdict(), fallen_measure(), has_lost_lining())`.
  [[nodiscard]] Verdict verdict() const { return last().verdict; }
  /// Over all stages, and what had detached before [m^2], [m^3].
  [[nodiscard]] double fallen_measure() const {
    double sum = fallen_before;
    for (const StageResult& stage : stages) sum += stage.fallen_measure();
    return sum;
  }
  /// How that varies, over all stages; none where no stage says (`EquilibriumReport::rockfall`).
  [[nodiscard]] std::optional<RockfallRange> rockfall_range() const {
    std::optional<RockfallRange> sum;
    double exact = fallen_before;
    const auto add = [&](const EquilibriumReport& report) {
      if (!report.rockfall)
        exact += report.fallen_measure;
      else if (sum)
        sum->add(*report.rockfall);
      else
        sum = report.rockfall;
    };
    for (const StageResult& stage : stages) {
      add(stage.report);
      for (const CreptState& state : stage.crept) add(state.report);
    }
    if (sum) sum->add({exact, exact, false, 0});
    return sum;
  }
  /// Whether a lining came off its wall, in any stage or before.
  [[nodiscard]] bool has_lost_lining() const { return last().lacks_lining; }
};

/// What is being done and how far it is, 0 to 1, or a negative number where that is unknown.
/// Returns false to stop.
using StageProgress = std::function<bool(const std::string& stage, double fraction)>;

/// Shown the solver at the end of every stage that was begun, whatever its verdict, and what came
/// of it: what later stages change can be kept. `paraview_files.hpp` has an example.
template <class Solver>
using StageObserver = std::function<void(const Solver& solver, const StageResult& stage)>;

namespace detail {

/// The frame of a lining, with as many nodes as its bond needs where it gives no number.
/// @throws InvalidInput  see `lining_frame`, `with_chosen_nodes`; some sections are pinned and some
///                       are not
template <class Solver>
[[nodiscard]] LiningFrame<typename Solver::Geometry> frame_of(
    const Solver& solver, const LiningInstallation<Solver>& lining) {
  const auto& mass = solver.mass();
  if (mass.openings.empty() || lining.sections.empty() ||
      is_pinned_lining<typename Solver::Lining>(lining.sections))
    return lining_frame(mass, lining.layout, solver.fallen());
  const auto& opening = lining.opening ? *lining.opening : mass.openings.back();
  auto layout = lining.layout;
  const LiningSection& across = lining.sections.front();
  if constexpr (Solver::dim == 2)
    layout = with_chosen_nodes<2>(layout, opening, across, lining.interface_law);
  else
    layout.ring = with_chosen_nodes<3>(layout.ring, opening.section(), across, lining.interface_law,
                                       layout.spacing);
  return lining_frame(mass, opening, layout, solver.fallen());
}

/// Of the opening that is looked at.
template <class Solver>
[[nodiscard]] Convergence measured_convergence(const Solver& solver,
                                               const Construction<Solver>& construction) {
  return construction.measured ? convergence(solver, *construction.measured) : convergence(solver);
}

template <class Solver>
[[nodiscard]] bool has_creeping_joints(const Solver& solver) {
  if constexpr (CreepingLaw<typename Solver::JointLaw, Solver::dim>)
    return std::isfinite(longest_creep_step(solver.joint_laws()));
  else
    return false;
}

/// @throws InvalidInput  a stage lasts where nothing creeps or ages, or not for 0 s or more
template <class Solver>
void check_durations(const Solver& solver, const Construction<Solver>& construction) {
  const bool lasts = construction.ages || has_creeping_joints(solver);
  for (const ConstructionStage<Solver>& stage : construction.stages)
    naming("stage \"" + stage.name + "\"", [&] {
      require(stage.duration >= 0 && std::isfinite(stage.duration), "duration", stage.duration,
              ">= 0 s");
      require(lasts || stage.duration == 0, "duration", stage.duration,
              "0 s, for no joint law creeps");
    });
}

/// Lets the joints creep for the duration of a stage that has come to rest.
template <class Solver>
void let_creep(Solver& solver, const ConstructionStage<Solver>& stage,
               const Construction<Solver>& construction, const Progress& progress,
               StageResult& end) {
  if constexpr (CreepingLaw<typename Solver::JointLaw, Solver::dim>) {
    const auto seen = [&](const CreepState& state) {
      end.convergence = measured_convergence(solver, construction);
      end.crept.push_back({state.time, state.report, end.convergence});
      const bool goes_on = !progress || progress(std::min(state.time / stage.duration, 1.0));
      if (!goes_on && state.time < stage.duration) {
        end.crept.back().report.verdict = Verdict::undecided;
        end.crept.back().report.stopped = true;
      }
      return goes_on;
    };
    const auto states =
        creep(solver, stage.duration, seen, construction.method, construction.acceptance);
    if (end.crept.size() < states.size())  // one that is not stable is not shown
      end.crept.push_back(
          {states.back().time, states.back().report, measured_convergence(solver, construction)});
  } else {
    (void)solver, (void)stage, (void)construction, (void)progress, (void)end;
  }
}

/// @throws InvalidInput  see the calls; Stopped
template <class Solver>
void carry_out(Solver& solver, const ConstructionStage<Solver>& stage, const Progress& progress) {
  for (const LiningStiffening& aged : stage.stiffened)
    solver.stiffen_lining(aged.lining, aged.factor);
  for (const auto& round : stage.rounds)
    solver.excavate(round.opening, round.smallest_piece, progress);
  StopCheck stop(progress, 1);  // in a million blocks a bolt takes a tenth of a second
  for (const auto& bolts : stage.bolts)
    for (const auto& bar : bolts.bars) {
      stop();
      (void)solver.install_bolt(bar, bolts.law, bolts.spacing, bolts.anchors);
    }
  for (const auto& lining : stage.linings)
    (void)solver.install_lining(frame_of(solver, lining), lining.sections, lining.interface_law,
                                lining.feet);
  for (const auto& load : stage.loads) (void)add_load_at(solver, load);
}

}  // namespace detail

/// Carries out a construction on rock in its in-situ state, or goes on where the solver is: a plan
/// that is cut in two says what the whole plan says. A stage that does not end stable is the last.
///
/// @param progress  asked now and then whether to go on. A search that it stops is undecided, with
///                  `report.stopped`
/// @param observer  see `StageObserver`; what it throws ends the construction
/// @throws InvalidInput    no stages, or what `check_construction` refuses, and nothing has been
///                         done; or a stage that cannot be carried out: the message names it, those
///                         before it have been
/// @throws NumericalFault  see the method
/// @throws Stopped         while rock was taken out or bolts were installed
template <class Solver>
ConstructionResult<typename Solver::Geometry> construct(
    Solver& solver, const Construction<Solver>& construction, const StageProgress& progress = {},
    const std::type_identity_t<StageObserver<Solver>>& observer = {}) {
  if (construction.stages.empty())
    throw InvalidInput("construction: has no stages; accepted: at least one");
  check_construction(construction, solver.mass());
  detail::check_durations(solver, construction);
  ConstructionResult<typename Solver::Geometry> result;
  result.fallen_before = solver.fallen_measure();
  result.measured = construction.measured;
  for (const ConstructionStage<Solver>& stage : construction.stages) {
    Progress asked;
    if (progress) asked = [&](double fraction) { return progress(stage.name, fraction); };
    naming("stage \"" + stage.name + "\"", [&] {
      detail::carry_out(solver, stage, asked);
      StageResult& end = result.stages.emplace_back();
      end.name = stage.name;
      end.wall_traction_asked = stage.wall_traction;
      end.report = solver.equilibrium(stage.wall_traction, construction.method,
                                      construction.acceptance, asked);
      for (const double left : solver.wall_fractions())
        end.wall_traction = std::max(end.wall_traction, left);
      end.convergence = detail::measured_convergence(solver, construction);
      if (stage.duration > 0 && end.report.verdict == Verdict::stable &&
          detail::has_creeping_joints(solver))
        detail::let_creep(solver, stage, construction, asked, end);
    });
    if (observer) observer(solver, result.stages.back());
    if (result.verdict() != Verdict::stable) break;
  }
  return result;
}

}  // namespace voussoir
