// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/dynamics/energy_balance.hpp>
#include <voussoir/equilibrium/rockfall_range.hpp>
#include <voussoir/linear/linear_method.hpp>
#include <voussoir/model/contact_update_report.hpp>

namespace voussoir {

/// What is known about a state after equilibrium was sought.
enum class Verdict {
  stable,     ///< all three tests passed, possibly after blocks detached: see `to_string(report)`
  collapse,   ///< more rock detached than the limit
  undecided,  ///< no answer was found, or none was sought: the reason says why
};

[[nodiscard]] constexpr const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::stable:
      return "stable";
    case Verdict::collapse:
      return "collapse";
    case Verdict::undecided:
      return "undecided";
  }
  return "undecided";
}

/// The verdict as people read it. A tunnel that stands after rock has detached from it, or without
/// the lining that it was to have, is other news than one that stands: everything that is shown or
/// written takes its word from here.
/// @param fallen_measure  rock that detached on the way, over all stages [m^2], [m^3]
/// @param lost_lining     a lining came off its wall
[[nodiscard]] constexpr const char* to_string(Verdict verdict, double fallen_measure,
                                              bool lost_lining) {
  if (verdict != Verdict::stable) return to_string(verdict);
  if (lost_lining) return "stable without its lining";
  return fallen_measure > 0 ? "stable after rockfall" : to_string(verdict);
}

/// A limit of displacements that is chosen from the size of the blocks and the elastic movement of
/// the rock (see `detail::limits_by_the_rock`), which must itself be small (see
/// `detail::moves_beyond_reason`).
inline constexpr double by_the_rock = -1;

/// When a state counts as an equilibrium.
struct Acceptance {
  double error_estimate = 1e-3;         ///< largest elastic correction / largest displacement [-]
  double unbalance_over_weight = 1e-2;  ///< of the worst body [-]
  /// A block that moved further has come off [m].
  double displacement_limit = by_the_rock;
  /// Contacts are updated when a block has moved so far since they were last updated [m]. Without
  /// effect unless below the displacement limit. A block that has lost all contacts within twice
  /// this is detached.
  double contact_update_limit = by_the_rock;
  /// More detached rock than this is a collapse, per metre of tunnel: the area lost in the section
  /// [m^2], in 3-D as in 2-D (see `SearchContext::open_length`).
  double collapse_measure = 20;

  /// @throws InvalidInput  a limit out of range
  void check() const {
    require(error_estimate > 0, "error_estimate", error_estimate, "> 0");
    require(unbalance_over_weight > 0, "unbalance_over_weight", unbalance_over_weight, "> 0");
    const auto is_limit = [](double value) { return value > 0 || value == by_the_rock; };
    require(is_limit(displacement_limit), "displacement_limit", displacement_limit, "> 0 m");
    require(is_limit(contact_update_limit), "contact_update_limit", contact_update_limit, "> 0 m");
    require(collapse_measure >= 0, "collapse_measure", collapse_measure, ">= 0");
  }
};

/// The outcome of one search for equilibrium, with the numbers that decided it.
struct EquilibriumReport {
  Verdict verdict = Verdict::undecided;
  std::string reason;  ///< one sentence
  /// Largest elastic correction / largest displacement; not a number if it was not computed.
  double error_estimate = std::numeric_limits<double>::quiet_NaN();
  double unbalance_over_weight = std::numeric_limits<double>::quiet_NaN();
  double largest_displacement = 0;  ///< [m]
  /// Those of the acceptance; where they were to be chosen by the rock, what was chosen [m].
  double displacement_limit = by_the_rock, contact_update_limit = by_the_rock;
  int steps = 0;  ///< force evaluations
  int elastic_solves = 0;
  int factorisations = 0;     ///< times that the elastic stiffness was prepared for solving
  LinearReport linear;        ///< how the elastic solves were done
  std::vector<int> fallen;    ///< blocks removed because they detached, in this search
  double fallen_measure = 0;  ///< [m^2] or [m^3]
  /// Blocks that nothing but a smooth edge of the domain touched: parts of blocks that go on
  /// outside, and are held where they are from this search on.
  std::vector<int> held_at_edge;
  /// Nodes of linings that came off their wall and were taken out, in this search; what happened,
  /// in a sentence.
  std::vector<int> lost_nodes;
  std::string lost_lining;
  /// A lining has come off its wall, in this search or, as a solver knows, before: what stands,
  /// stands without it.
  bool lacks_lining = false;
  int broken_bolts = 0;                 ///< bolt springs that ruptured
  ContactUpdateReport contact_updates;  ///< what they gave to the springs, and how forces jumped
  /// The state is where blocks came to rest in motion: some were caught on their way, and their
  /// displacements are those of that way, its overshoot and its rounding in them.
  bool is_from_motion = false;
  EnergyBalance motion;  ///< of a stage that was followed in motion, to its end; else nothing
  /// Where it was asked for (`MotionTuning::range`) and blocks came off in motion, or nearly.
  std::optional<RockfallRange> rockfall;
  bool stopped = false;  ///< the caller asked to stop
};

/// The verdict of one search as people read it.
[[nodiscard]] inline const char* to_string(const EquilibriumReport& report) {
  return to_string(report.verdict, report.fallen_measure,
                   report.lacks_lining || !report.lost_nodes.empty());
}

/// What the movement of a rock mass is measured by, and what it may be blamed on.
struct GroundScale {
  double span = 0;      ///< of the opening, the longer side of its section; 0: there is none [m]
  double pressure = 0;  ///< in situ, at the opening: mean of the normal stresses [Pa]
  /// Of elastic ground beyond the domain: mean of its moduli under normal strain [Pa].
  double modulus = std::numeric_limits<double>::infinity();
};

/// The context of a search: what counts as equilibrium, how heavy bodies are, whom to tell.
struct SearchContext {
  Acceptance acceptance;
  /// Area or volume of each body: what is lost if it detaches [m^2], [m^3]; 0 for lining nodes.
  const std::vector<double>* measures = nullptr;
  double wall_fraction = 0;  ///< residual wall traction at the end, over the in-situ one
  Progress progress;
  /// Length of tunnel over which lost rock is counted: 1 in 2-D, where all is per metre; in 3-D the
  /// open length, but no more than the width of the section, lest a chimney in a long tunnel be
  /// overlooked [m].
  double open_length = 1;
  double gravity = 9.81;  ///< of the weights of bodies [m/s^2]
  /// How far fixed blocks that have been displaced have carried the others [m]: limits count what
  /// blocks move beyond that.
  double carried = 0;
  /// What a block seldom moves in a stage that stands: a search in one step gives up where one
  /// moves further. Set by the stage [m].
  double seldom_moved = std::numeric_limits<double>::infinity();
  GroundScale ground = {};
};

namespace detail {

/// Runs a search or a part of one; if the caller stops it, its report says so.
template <class Search>
void until_stopped(EquilibriumReport& report, Search&& search) {
  try {
    search();
  } catch (const Stopped&) {
    report.verdict = Verdict::undecided;
    report.reason = "stopped by the user";
    report.stopped = true;
  }
}

/// What a search asks at each of its longer steps. @throws Stopped
inline void ask_to_go_on(const SearchContext& context, double fraction = -1) {
  if (context.progress && !context.progress(fraction)) throw Stopped();
}

}  // namespace detail

template <class Method, class System>
concept HasEquilibriumSearch = requires(const Method method, System& system,
                                        const SearchContext& context) {
  { method.find(system, context) } -> std::same_as<EquilibriumReport>;
};

/// Finds the equilibrium of a system after its load or its supports have changed.
///
/// What the compiler cannot check: on return `system.displacement` holds the state that the report
/// speaks of, and `system.wall_fraction` the traction at which it was reached. Only a stable state
/// has the wall fraction of the context and its history committed for certain.
///
/// Models: TwoLevel, Relaxation, Explicit.
template <class Method, class System>
concept EquilibriumMethod = Fills<Method, roles::Equilibrium> && HasName<Method> &&
    Copyable<Method> && DefaultConstructible<Method> && HasEquilibriumSearch<Method, System>;

template <class Method, class System>
consteval bool explain_equilibrium_method() {
  static_assert(Fills<Method, roles::Equilibrium>,
                "equilibrium method: add `using role = voussoir::roles::Equilibrium`");
  static_assert(HasName<Method>,
                "equilibrium method: add `static constexpr const char* name` for the log");
  static_assert(Copyable<Method>, "equilibrium method: must be copyable");
  static_assert(HasEquilibriumSearch<Method, System>,
                "equilibrium method: add `template <class System> EquilibriumReport find(System&, "
                "const SearchContext&) const`");
  static_assert(DefaultConstructible<Method>,
                "equilibrium method: add a default constructor (documented default settings)");
  return true;
}

}  // namespace voussoir
