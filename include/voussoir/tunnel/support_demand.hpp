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
#include <voussoir/tunnel/support_forces.hpp>

namespace voussoir {

/// What the supports have to carry: the numbers that a design is chosen by. Zero where there is
/// no such support.
struct SupportDemand {
  double largest_bolt_force = 0;  ///< [N]
  double mean_bolt_force = 0;     ///< mean over bolts of each one's largest [N]
  double largest_thrust = 0;      ///< of all linings, compression positive, 2-D [N/m], 3-D [N]
  double mean_thrust = 0;         ///< over nodes (2-D), over members (3-D)
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
    std::vector<LiningForce> nodes;
    for (const auto* lining : solver.linings())
      for (const LiningForce& at : lining_forces(solver, *lining))
        if (!at.is_lost) nodes.push_back(at);
    add(nodes, nodes.size());
  } else {
    const auto members = lining_members(solver);
    add(members, members.size());
  }
  return demand;
}

/// A constructed tunnel as a point of an interaction diagram; `interaction_diagram` adds where in
/// it. Rock and linings lost count over all stages.
template <class Solver>
[[nodiscard]] DiagramPoint diagram_point_of(
    const Solver& solver, const ConstructionResult<typename Solver::Geometry>& result) {
  DiagramPoint point{};
  point.report = result.last();
  point.report.fallen_measure = result.fallen_measure();
  for (const StageResult& stage : result.stages)
    if (point.report.lost_nodes.empty()) point.report.lost_nodes = stage.report.lost_nodes;
  point.crown_convergence = result.stages.back().convergence.crown;
  const SupportDemand demand = support_demand(solver);
  point.largest_bolt_force = demand.largest_bolt_force;
  point.mean_bolt_force = demand.mean_bolt_force;
  point.largest_thrust = demand.largest_thrust;
  point.largest_moment = demand.largest_moment;
  return point;
}

/// What has become of the supports: nothing of this shows in the forces of those that are left.
struct SupportCondition {
  int bolts = 0;
  int idle = 0;                           ///< bolts that crossed no joint when they were installed
  int lost = 0;                           ///< bolts that went with the rock they held
  int ruptured = 0;                       ///< joints at which a bolt has broken
  int yielded = 0;                        ///< joints at which one has yielded and holds
  bool lining_lost = false;               ///< with the rock that held it; not: came off its wall
  bool lining_open = false;               ///< 2-D: an arc, of which the feet stand on nothing
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

template <class Solver>
[[nodiscard]] SupportCondition support_condition(
    const Solver& solver, const ConstructionResult<typename Solver::Geometry>& result) {
  SupportCondition condition;
  condition.bolts = static_cast<int>(result.bars.size());
  for (const auto& end : result.hanging_ends)
    condition.hanging_ends.push_back(text_of<Solver::dim>(end));
  for (const auto& opened : result.opened_linings)
    condition.opened.push_back(text_of_opened(opened));
  std::vector<int> held(result.bars.size(), 0);
  for (const CrossingForce& c : bolt_forces(solver)) {
    if (c.bolt < result.first_bolt) continue;
    ++held.at(static_cast<std::size_t>(c.bolt - result.first_bolt));
    condition.ruptured += c.report.is_broken;
    condition.yielded += c.report.has_yielded() && !c.report.is_broken;
  }
  for (std::size_t k = 0; k < held.size(); ++k) {
    VOUSSOIR_ASSERT(held[k] <= result.crossings[k], "a bolt holds where it crossed a joint");
    condition.idle += result.crossings[k] == 0;
    condition.lost += result.crossings[k] > 0 && held[k] == 0;
  }
  bool is_bonded = false;
  for (const auto& law : solver.system().interface.laws())
    is_bonded = is_bonded || holds_shear<Solver::dim>(law);
  const bool is_joined =
      solver.system().supports.template first<LiningJoints<typename Solver::Geometry>>() != nullptr;
  for (const auto& lining : solver.system().linings) {
    for (const LiningGap& gap : lining.gaps) {
      if (!solver.system().body(lining.first + gap.node).movable) continue;
      ++condition.gaps;
      if (!(gap.share > condition.widest_gap)) continue;
      condition.widest_gap = gap.share;
      condition.widest_place =
          text_of<Solver::dim>(solver.system().body(lining.first + gap.node).centre);
    }
  }
  for (const auto* lining : solver.linings()) {
    const std::size_t members = lining->members().size();
    bool stands = false;
    for (int n = 0; n < lining->node_count(); ++n)
      stands = stands || solver.system().body(lining->first_node() + n).movable;
    const bool is_taken_out = std::any_of(
        result.opened_linings.begin(), result.opened_linings.end(), [&](const auto& opened) {
          return opened.is_gone &&
                 solver.linings()[static_cast<std::size_t>(opened.lining)] == lining;
        });
    condition.lining_lost |= !stands && !is_taken_out && !result.has_lost_lining();
    condition.lining_open |= Solver::dim == 2 && !is_joined && !is_bonded &&
                             foot_forces(solver).empty() && members > 0 &&
                             members + 1 == static_cast<std::size_t>(lining->node_count());
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
  if (condition.lining_lost)
    remarks.emplace_back(
        "the lining was lost with the rock that held it: nothing touches it any "
        "more");
  if (condition.lining_open)
    remarks.emplace_back(
        "the lining is open and its ends stand on nothing: it carries what friction on the rock "
        "gives it, next to no thrust; give them feet, or bond it to the rock");
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
