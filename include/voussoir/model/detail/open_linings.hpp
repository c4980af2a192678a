// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/geometry/bar_in_opening.hpp>
#include <voussoir/model/lining_members.hpp>
#include <voussoir/model/opened_lining.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir::detail {

/// Opens the linings of a model where a round has been taken out. What goes: a node that lies in
/// the opening, or whose rock has all gone with it; a member of such a node, or one that runs
/// through the opening between two that stay; a node that is left without members, or that turns
/// and is left with hinged ones alone. A member is cut at the node that stays: half of its weight
/// goes on hanging there.
///
/// The force that a member carried is then out of balance at its nodes, as that of the rock is at
/// the wall: both go with the wall's traction.
template <class System>
class LiningOpener {
 public:
  using Geometry = typename System::GeometryType;
  using Opening = typename Geometry::Opening;
  static constexpr int dim = Geometry::dim;

  /// @param model  with the supports, contacts and numbers that it goes on with
  /// @param had_rock  marks nodes that touched rock before the round
  /// @param tolerance  what reaches into the opening no further than this touches it [m]
  LiningOpener(System& model, const BodyMarks& had_rock, const Opening& opening, double tolerance)
      : model_(model),
        opening_(opening),
        tolerance_(tolerance),
        cut_(count(), 0),
        touched_(count(), 0),
        lining_of_(count(), -1) {
    BodyMarks has_rock(count(), 0);
    for (const auto& c : model.interface.contacts()) has_rock[node_of(c)] = 1;
    for (std::size_t k = 0; k < model.linings.size(); ++k) {
      const auto& lining = model.linings[k];
      for (std::size_t n = 0; n < lining.surface.node_count(); ++n) {
        const std::size_t node = index(lining.first) + n;
        lining_of_[node] = static_cast<int>(k);
        if (!model.body(static_cast<int>(node)).movable) continue;
        cut_[node] = (had_rock[node] != 0 && has_rock[node] == 0) ||
                     lies_within(model.body(static_cast<int>(node)).centre, opening, tolerance);
      }
    }
  }

  /// @return  the linings that are opened, in their order
  [[nodiscard]] std::vector<OpenedLining<dim>> run() {
    cut_lonely_nodes();
    std::vector<OpenedLining<dim>> opened(model_.linings.size());
    BodyMarks is_end(count(), 0);
    each_member([&](const auto& member) {
      const int i = member.i, j = member.j;
      if (!is_parted(i, j)) return;
      ++of(opened, cut_[index(i)] != 0 ? i : j).members;
      for (const int node : {i, j}) {
        if (cut_[index(node)] != 0) continue;
        touched_[index(node)] = 1;
        if (std::exchange(is_end[index(node)], char{1}) == 0)
          of(opened, node).ends.push_back(model_.body(node).centre);
      }
    });
    std::vector<int> gone;
    for (std::size_t node = 0; node < count(); ++node)
      if (cut_[node] != 0) {
        gone.push_back(static_cast<int>(node));
        ++of(opened, static_cast<int>(node)).nodes;
      }
    for (const auto& c : model_.interface.contacts())
      if (cut_[node_of(c)] != 0) touched_[index(std::min(c.a, c.b))] = 1;
    for (const auto& support : model_.supports)
      support->sever([this](int i, int j) { return is_parted(i, j); });
    if (!gone.empty()) model_.remove(gone);
    open_surfaces();
    return those_opened(std::move(opened));
  }

  /// Marks bodies on which that acts. @pre  it has run
  [[nodiscard]] const BodyMarks& touched() const { return touched_; }

 private:
  [[nodiscard]] static std::size_t index(int b) { return static_cast<std::size_t>(b); }
  [[nodiscard]] std::size_t count() const { return index(model_.body_count()); }
  /// Nodes come behind the blocks.
  template <class Contact>
  [[nodiscard]] static std::size_t node_of(const Contact& c) {
    return index(std::max(c.a, c.b));
  }
  [[nodiscard]] OpenedLining<dim>& of(std::vector<OpenedLining<dim>>& opened, int node) const {
    return opened[index(lining_of_[index(node)])];
  }

  template <class Visit>
  void each_member(Visit&& visit) const {
    for (const auto* lining : model_.supports.template all<LiningMembers<Geometry>>())
      for (const auto& m : lining->members()) visit(m);
    for (const auto* joints : model_.supports.template all<LiningJoints<Geometry>>())
      for (const auto& m : joints->members()) visit(m);
  }
  /// Its turns are fixed, whatever members it has.
  [[nodiscard]] bool is_pin(int node) const {
    return model_.linings[index(lining_of_[index(node)])].is_pinned;
  }
  [[nodiscard]] bool is_parted(int i, int j) const {
    return cut_[index(i)] != 0 || cut_[index(j)] != 0 ||
           place_inside(typename Geometry::Line{model_.body(i).centre, model_.body(j).centre},
                        opening_, tolerance_)
               .has_value();
  }
  void cut_lonely_nodes() {
    std::vector<int> before(count(), 0), left(count(), 0);
    each_member([&](const auto& member) {
      const bool stays = !is_parted(member.i, member.j);
      for (const auto& [node, is_hinged] :
           {std::pair(member.i, member.is_hinged[0]), std::pair(member.j, member.is_hinged[1])}) {
        ++before[index(node)];
        left[index(node)] += stays && (!is_hinged || is_pin(node));
      }
    });
    for (std::size_t node = 0; node < count(); ++node)
      if (before[node] > 0 && left[node] == 0) cut_[node] = 1;
  }

  /// Rock that lands there finds no lining, and nothing that it has filled.
  void open_surfaces() {
    for (auto& lining : model_.linings) {
      const auto is_cut = [&](int node) { return cut_[index(lining.first + node)] != 0; };
      std::erase_if(lining.fills, [&](const auto& fill) {
        return is_cut(fill.node) || opening_.contains(mass_properties(fill.shape).centroid);
      });
      std::erase_if(lining.gaps, [&](const LiningGap& gap) { return is_cut(gap.node); });
      lining.surface.remove_tiles(
          [this](const Vec<dim>& middle) { return opening_.contains(middle); });
    }
  }

  [[nodiscard]] std::vector<OpenedLining<dim>> those_opened(
      std::vector<OpenedLining<dim>> opened) const {
    for (std::size_t k = 0; k < opened.size(); ++k) {
      const auto& lining = model_.linings[k];
      opened[k].lining = static_cast<int>(k);
      opened[k].is_gone = true;
      for (std::size_t n = 0; n < lining.surface.node_count(); ++n)
        if (model_.body(lining.first + static_cast<int>(n)).movable) opened[k].is_gone = false;
    }
    std::erase_if(opened, [](const auto& o) { return o.nodes == 0 && o.members == 0; });
    return opened;
  }

  System& model_;
  const Opening& opening_;
  double tolerance_;
  BodyMarks cut_, touched_;
  std::vector<int> lining_of_;  ///< index for every node, -1 for other bodies
};

}  // namespace voussoir::detail
