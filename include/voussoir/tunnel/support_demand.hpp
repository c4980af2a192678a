// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message_number.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/interaction_diagram.hpp>
#include <voussoir/tunnel/rib_forces.hpp>
#include <voussoir/tunnel/support_forces.hpp>

namespace voussoir {

/// What the supports have to carry: the numbers that a design is chosen by. Zero where there is
/// no such support.
struct SupportDemand {
  double largest_bolt_force = 0;  ///< [N]
  double mean_bolt_force = 0;     ///< mean over bolts of each one's largest [N]
  double largest_thrust = 0;      ///< of all linings, compression positive, 2-D [N/m], 3-D [N]
  double mean_thrust = 0;         ///< over nodes
  double largest_moment = 0;      ///< absolute value, 2-D [N m/m], 3-D [N m]
};

template <class Solver>
[[nodiscard]] SupportDemand support_demand(const Solver& solver) {
  SupportDemand demand;
  const std::vector<double> bolts = largest_bolt_forces(solver);
  for (const double force : bolts) {
    demand.largest_bolt_force = std::max(demand.largest_bolt_force, force);
    demand.mean_bolt_force += force / static_cast<double>(bolts.size());
  }
  const auto add = [&](const auto& forces, std::size_t count) {
    for (const auto& at : forces) {
      demand.largest_thrust = std::max(demand.largest_thrust, at.thrust);
      demand.largest_moment = std::max(demand.largest_moment, std::abs(at.moment));
      demand.mean_thrust += at.thrust / static_cast<double>(count);
    }
  };
  if constexpr (Solver::dim == 2) {
    std::vector<LiningForce> nodes = lining_forces(solver);
    std::erase_if(nodes, [](const LiningForce& at) { return at.is_lost; });
    add(nodes, nodes.size());
  } else {
    const std::vector<RibForce> nodes = rib_forces(solver);
    add(nodes, nodes.size());
  }
  return demand;
}

/// A constructed tunnel as a point of an interaction diagram; `interaction_diagram` adds where in
/// it. Rock and linings lost count over all stages, and before.
template <class Solver>
[[nodiscard]] DiagramPoint diagram_point_of(
    const Solver& solver, const ConstructionResult<typename Solver::Geometry>& result) {
  DiagramPoint point{};
  point.report = result.last();
  point.report.fallen_measure = result.fallen_measure();
  point.crown_convergence = result.stages.back().convergence.crown;
  const SupportDemand demand = support_demand(solver);
  point.largest_bolt_force = demand.largest_bolt_force;
  point.mean_bolt_force = demand.mean_bolt_force;
  point.largest_thrust = demand.largest_thrust;
  point.largest_moment = demand.largest_moment;
  return point;
}

namespace detail {

/// Whether anything is left of a lining.
template <class System, class Lining>
[[nodiscard]] bool stands(const System& system, const Lining& lining) {
  for (std::size_t n = 0; n < lining.surface.node_count(); ++n)
    if (system.body(lining.first + static_cast<int>(n)).movable) return true;
  return false;
}

}  // namespace detail

/// Whether a lining stands: has been installed and not lost.
template <class Solver>
[[nodiscard]] bool has_standing_lining(const Solver& solver) {
  const auto& system = solver.system();
  return std::any_of(system.linings.begin(), system.linings.end(),
                     [&](const auto& lining) { return detail::stands(system, lining); });
}

/// What has become of the supports: nothing of this shows in the forces of those that are left.
struct SupportCondition {
  int bolts = 0;
  int idle = 0;                   ///< bolts that crossed no joint when they were installed
  int lost = 0;                   ///< bolts that went with the rock they held
  int ruptured = 0;               ///< joints at which a bolt has broken
  int yielded = 0;                ///< joints at which one has yielded and holds
  int linings = 0;                ///< installed, as numbered from 1 in what follows
  std::vector<int> lost_linings;  ///< with the rock that held it; not: came off its wall
  /// 2-D: where a lining and those that it goes on in make an open arc, of which no end stands on
  /// anything: the first of them.
  std::vector<int> open_linings;
  double open_thrust = 0;                 ///< largest of all linings, where one is open [N/m]
  std::vector<std::string> hanging_ends;  ///< where a foot was left out: the rock had fallen
  std::vector<std::string> opened;        ///< linings that a later round went through: what is left
  int gaps = 0;           ///< nodes of linings that stand with a gap behind them, too deep to fill
  double widest_gap = 0;  ///< share of the widest of what stands for its node, 0 to 1
  std::string widest_place;               ///< of that node
  std::vector<std::string> yielded_feet;  ///< where one has reached its bearing strength
};

/// "lining 1 is opened ...: 8 nodes and 22 members are out; it ends at (2.46, 5.5, 0.32) m, ..."
template <int Dim>
[[nodiscard]] std::string text_of_opened(const OpenedLining<Dim>& opened) {
  std::string text = message({"lining ", opened.lining + 1,
                              opened.is_gone ? " is taken out by a later round: "
                                             : " is opened where a later round meets it: ",
                              opened.nodes, " nodes and ", opened.members, " members are out"});
  if (opened.ends.empty()) return text;
  constexpr std::size_t most = 4;
  text += message({"; ", opened.ends.size(), " nodes at the cut hang free there, at "});
  for (std::size_t k = 0; k < std::min(most, opened.ends.size()); ++k)
    text += (k > 0 ? ", " : "") + text_of<Dim>(opened.ends[k]);
  return text + (opened.ends.size() > most ? " m and further on" : " m");
}

namespace detail {

/// Numbers, from 1, of linings in 2-D that are open and whose ends stand on nothing, nor are they
/// bonded. Those that go on in one another are one, told by the first of them.
template <class Solver>
[[nodiscard]] std::vector<int> open_linings(const Solver& solver) {
  struct Whole {
    std::size_t number;       ///< of the whole that it is part of: its first lining
    std::ptrdiff_t cuts = 0;  ///< nodes that stand less members
    std::size_t members = 0;
    bool is_held = false;
  };
  const auto& system = solver.system();
  const auto linings = solver.linings();
  std::vector<Whole> wholes;
  for (std::size_t k = 0; k < linings.size(); ++k) wholes.push_back({k});
  const auto lining_of = [&](int body) {
    std::size_t k = linings.size() - 1;
    while (body < linings[k]->first_node()) --k;
    return k;
  };
  const auto whole_of = [&](std::size_t k) -> Whole& { return wholes[wholes[k].number]; };
  const auto joints = system.supports.template all<LiningJoints<typename Solver::Geometry>>();
  for (const auto* joint : joints)
    for (const auto& member : joint->members()) {
      const std::size_t a = wholes[lining_of(member.i)].number,
                        b = wholes[lining_of(member.j)].number;
      for (Whole& whole : wholes)
        if (whole.number == std::max(a, b)) whole.number = std::min(a, b);
    }
  for (const auto* joint : joints)
    for (const auto& member : joint->members()) --whole_of(lining_of(member.i)).cuts;
  for (std::size_t k = 0; k < linings.size(); ++k) {
    const std::size_t members = linings[k]->members().size();
    for (int n = 0; n < linings[k]->node_count(); ++n)
      whole_of(k).cuts += system.body(linings[k]->first_node() + n).movable ? 1 : 0;
    whole_of(k).cuts -= static_cast<std::ptrdiff_t>(members);
    whole_of(k).members += members;
    const auto& law = system.interface.laws()[static_cast<std::size_t>(system.linings[k].law)];
    whole_of(k).is_held |= holds_shear<Solver::dim>(law);
  }
  for (const auto* feet : system.supports.template all<LiningFeet<Solver::dim>>())
    for (const auto& foot : feet->springs()) whole_of(lining_of(foot.node)).is_held = true;
  std::vector<int> open;
  for (std::size_t k = 0; k < wholes.size(); ++k)
    if (wholes[k].number == k && wholes[k].cuts >= 1 && wholes[k].members > 0 && !wholes[k].is_held)
      open.push_back(static_cast<int>(k) + 1);
  return open;
}

}  // namespace detail

template <class Solver>
[[nodiscard]] SupportCondition support_condition(const Solver& solver) {
  SupportCondition condition;
  condition.bolts = solver.bolt_count();
  for (const auto& opened : solver.opened_linings())
    condition.opened.push_back(text_of_opened(opened));
  std::vector<int> held(solver.installed_bolts().size(), 0);
  for (const CrossingForce& c : bolt_forces(solver)) {
    ++held.at(static_cast<std::size_t>(c.bolt));
    condition.ruptured += c.report.is_broken;
    condition.yielded += c.report.has_yielded() && !c.report.is_broken;
  }
  for (std::size_t k = 0; k < held.size(); ++k) {
    const int crossings = solver.installed_bolts()[k].crossings;
    VOUSSOIR_ASSERT(held[k] <= crossings, "a bolt holds where it crossed a joint");
    condition.idle += crossings == 0;
    condition.lost += crossings > 0 && held[k] == 0;
  }
  for (const auto& lining : solver.system().linings) {
    ++condition.linings;
    for (const auto& end : lining.hanging_ends)
      condition.hanging_ends.push_back(text_of<Solver::dim>(end));
    if (!detail::stands(solver.system(), lining)) {
      const bool is_taken_out = std::any_of(
          solver.opened_linings().begin(), solver.opened_linings().end(), [&](const auto& opened) {
            return opened.is_gone && opened.lining + 1 == condition.linings;
          });
      if (!lining.came_off && !is_taken_out) condition.lost_linings.push_back(condition.linings);
      continue;
    }
    for (const LiningGap& gap : lining.gaps) {
      if (!solver.system().body(lining.first + gap.node).movable) continue;
      ++condition.gaps;
      if (!(gap.share > condition.widest_gap)) continue;
      condition.widest_gap = gap.share;
      condition.widest_place =
          text_of<Solver::dim>(solver.system().body(lining.first + gap.node).centre);
    }
  }
  if constexpr (Solver::dim == 2) {
    condition.open_linings = detail::open_linings(solver);
    if (!condition.open_linings.empty())
      condition.open_thrust = support_demand(solver).largest_thrust;
  }
  for (const auto& foot : foot_forces(solver))
    if (foot.has_yielded())
      condition.yielded_feet.push_back(text_of<Solver::dim>(foot.place) + " m (now at " +
                                       message_number(100 * foot.utilisation, 3) + " % of it)");
  return condition;
}

/// The same in sentences, one for each thing that a reader should know; none if all is well.
[[nodiscard]] inline std::vector<std::string> remarks_on(const SupportCondition& condition) {
  std::vector<std::string> remarks;
  const auto lining = [&](int number) {
    return condition.linings > 1 ? message({"lining ", number, " of ", condition.linings})
                                 : std::string("the lining");
  };
  for (const int number : condition.lost_linings)
    remarks.push_back(lining(number) +
                      " was lost with the rock that held it: nothing touches it any more");
  for (const int number : condition.open_linings)
    remarks.push_back(
        lining(number) +
        " is open and its ends stand on nothing: friction on the rock is all that gives it thrust, "
        "now at most " +
        message_number(condition.open_thrust / 1e3, 3) +
        " kN/m; give them feet, or bond it to the rock");
  for (const std::string& opened : condition.opened) remarks.push_back(opened);
  for (const std::string& place : condition.hanging_ends)
    remarks.push_back("the lining has no foot at " + place +
                      " m: the rock there had fallen before it was installed; that end hangs free");
  if (condition.gaps > 0)
    remarks.push_back(
        message({"the lining has no rock behind ", condition.gaps,
                 " of its nodes, or behind a part of what stands for them: a hole in the wall is "
                 "deeper than it is filled, or another opening is there; the widest, ",
                 std::round(100 * condition.widest_gap), " % of its node, at ",
                 condition.widest_place, " m"}));
  const std::string of_all = " of " + std::to_string(condition.bolts) + " bolts ";
  if (condition.idle > 0)
    remarks.push_back(std::to_string(condition.idle) + of_all + "cross no joint and hold nothing");
  if (condition.lost > 0)
    remarks.push_back(std::to_string(condition.lost) + of_all +
                      "were lost with the rock they held");
  if (condition.ruptured > 0)
    remarks.push_back("bolts ruptured at " + std::to_string(condition.ruptured) + " joints");
  if (condition.yielded > 0)
    remarks.push_back("bolts yielded at " + std::to_string(condition.yielded) + " joints");
  for (const std::string& place : condition.yielded_feet)
    remarks.push_back("a foot of the lining has reached its bearing strength at " + place +
                      ": it settles without bearing more");
  return remarks;
}

}  // namespace voussoir
