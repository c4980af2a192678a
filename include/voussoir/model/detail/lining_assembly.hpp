// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/foot_bearing.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/lining/frame_element.hpp>
#include <voussoir/lining/lining_frame.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/lining/node_spacing.hpp>
#include <voussoir/model/lining_feet.hpp>
#include <voussoir/model/lining_members.hpp>
#include <voussoir/model/lining_surface.hpp>
#include <voussoir/model/reference_contact.hpp>
#include <voussoir/model/system.hpp>

namespace voussoir::detail {

/// Puts nodes, members and contacts of a lining into a model at rest, on the wall in its present
/// position, free of force. It joins the linings that stand.
/// @tparam Lining  the model of its members
template <class Lining, class System>
class LiningAssembly {
 public:
  using Geometry = typename System::GeometryType;
  using InterfaceLaw = typename System::Law;
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;

  /// @param system   must outlive this
  /// @param gravity  [m/s^2]
  /// @param near     nodes of two linings this near to each other are one [m]
  LiningAssembly(System& system, double gravity, double near)
      : system_(system), gravity_(gravity), near_(near) {}

  /// @param feet  on which ends stand that do not go on in a lining; none: they hang free
  /// @return  ends without a foot because the rock under them has fallen [m]
  /// @throws InvalidInput  a member has no length, no rock touches the lining, or was ever under
  ///                       its feet; nodes are too far apart for a bond; some sections are pinned
  ///                       and some are not
  std::vector<Vec<dim>> run(const LiningFrame<Geometry>& given,
                            const std::vector<LiningSection>& sections,
                            const InterfaceLaw& interface_law,
                            const std::optional<FootBearing>& feet) {
    is_pinned_ = is_pinned_lining<Lining>(sections);
    const LiningFrame<Geometry> wanted = is_pinned_ ? without_bare_nodes(given) : given;
    if (std::none_of(wanted.contacts.begin(), wanted.contacts.end(),
                     [this](const auto& c) { return !system_.body(c.body).is_gone; }))
      throw InvalidInput("lining: no rock touches it");
    if (!is_pinned_ && holds_tension<dim>(interface_law))
      require_nodes_for_bond(wanted, sections, interface_law.joint_normal_stiffness());
    LiningFrame<Geometry> beside = with_shared_ends(
        wanted, [this](const Vec<dim>& place) { return standing_node(place) >= 0; });
    std::vector<int> there(beside.neighbours.size()), standing;
    for (std::size_t m = 0; m < there.size(); ++m) there[m] = standing_node(beside.neighbours[m]);
    std::vector<FreeEnd<dim>> free;
    for (const LiningEnd<Geometry>& end : beside.ends) {
      const auto m = static_cast<std::size_t>(end.neighbour);
      const FreeEnd<dim> here{end.node, beside.neighbours[m], end.direction};
      there[m] = node_before(here);
      if (there[m] >= 0)
        beside.neighbours[m] = system_.body(there[m]).centre;
      else
        free.push_back(here);
    }
    const LiningFrame<Geometry> frame = with_neighbours(beside, [&](std::size_t m) {
      if (there[m] >= 0) standing.push_back(there[m]);
      return there[m] >= 0;
    });
    first_node_ = system_.body_count();
    std::vector<LiningFootSpring<dim>> springs;
    std::vector<Vec<dim>> hanging;
    if (feet) springs = feet_of(wanted, frame, *feet, first_node_, hanging);
    const std::vector<LiningNodeShare> shares = node_shares(frame, sections);
    leave_out_feet_before(wanted);
    add_nodes(frame, shares, standing);
    add_members(frame, sections, standing);
    if (feet) add_feet(*feet, std::move(springs));
    add_surface(frame, sections, interface_law, std::move(free));
    system_.linings.back().hanging_ends = hanging;
    return hanging;
  }

 private:
  /// The node of a lining that stands at a place; -1: there is none.
  [[nodiscard]] int standing_node(const Vec<dim>& place) const {
    for (const auto* lining : system_.supports.template all<LiningMembers<Geometry>>())
      for (int n = lining->first_node(); n < lining->first_node() + lining->node_count(); ++n)
        if (system_.body(n).movable && (system_.body(n).centre - place).norm() < near_) return n;
    return -1;
  }

  /// The node of a lining that stands from which an end goes on; -1: there is none. One that ends
  /// in the same place and direction lies below, and is not carried on.
  [[nodiscard]] int node_before(const FreeEnd<dim>& end) const {
    for (const auto& lining : system_.linings)
      for (const FreeEnd<dim>& other : lining.ends)
        if (system_.body(lining.first + other.node).movable &&
            (other.place - end.place).norm() < near_ &&
            dot_product(other.direction, end.direction) < 0.5)
          return lining.first + other.node;
    return -1;
  }

  /// Whether a node that stands is one of a pinned lining.
  [[nodiscard]] bool is_standing_pin(int body) const {
    return std::any_of(system_.linings.begin(), system_.linings.end(), [body](const auto& lining) {
      const int end = lining.first + static_cast<int>(lining.surface.node_count());
      return lining.is_pinned && body >= lining.first && body < end;
    });
  }

  /// Takes out the feet of the ends that go on in the new lining, which has to carry what they
  /// bore.
  void leave_out_feet_before(const LiningFrame<Geometry>& wanted) {
    for (const LiningEnd<Geometry>& end : wanted.ends) {
      const Vec<dim>& place = wanted.neighbours[static_cast<std::size_t>(end.neighbour)];
      for (const int node : {standing_node(wanted.nodes[static_cast<std::size_t>(end.node)]),
                             standing_node(place), node_before({end.node, place, end.direction})}) {
        if (node < 0) continue;
        for (const auto& support : system_.supports)
          if (auto* feet = dynamic_cast<LiningFeet<dim>*>(support.get()))
            feet->leave_out(node, end.direction);
      }
    }
  }

  /// @param shares    of the new nodes, then of those that stand
  /// @param standing  nodes that the new members reach
  void add_nodes(const LiningFrame<Geometry>& frame, const std::vector<LiningNodeShare>& shares,
                 const std::vector<int>& standing) {
    for (std::size_t k = 0; k < frame.nodes.size(); ++k) {
      const double weight = shares[k].mass * gravity_;
      const int node =
          system_.add_body({frame.nodes[k], weight, std::max(shares[k].length, 1e-3), true, false});
      system_.load[dof * node + dim - 1] = -weight;
    }
    for (std::size_t m = 0; m < standing.size(); ++m)
      system_.load[dof * standing[m] + dim - 1] -= shares[frame.nodes.size() + m].mass * gravity_;
  }

  /// Members between the nodes, and from these to some that stand.
  void add_members(const LiningFrame<Geometry>& frame, const std::vector<LiningSection>& sections,
                   const std::vector<int>& standing) {
    std::vector<int> bodies(frame.nodes.size());
    std::iota(bodies.begin(), bodies.end(), first_node_);
    bodies.insert(bodies.end(), standing.begin(), standing.end());
    std::vector<Vec<dim>> places = frame.nodes;
    places.insert(places.end(), frame.neighbours.begin(), frame.neighbours.end());
    std::vector<FrameElement<Geometry>> own, joints;
    const auto is_pin = [&](int place) {
      const int body = bodies[static_cast<std::size_t>(place)];
      return body >= first_node_ ? is_pinned_ : is_standing_pin(body);
    };
    for (FrameElement<Geometry>& e :
         lining_elements<Lining>(frame, sections, places, bodies, is_pin)) {
      const bool joins = e.i < first_node_ || e.j < first_node_;
      if (joins) e.install_at(system_.pose(e.i), system_.pose(e.j), system_.displacement.data());
      (joins ? joints : own).push_back(e);
    }
    system_.supports.add(std::make_shared<LiningMembers<Geometry>>(
        std::move(own), first_node_, static_cast<int>(frame.nodes.size()), frame.centre));
    if (!joints.empty())
      system_.supports.add(std::make_shared<LiningJoints<Geometry>>(
          std::move(joints),
          static_cast<int>(system_.supports.template all<LiningMembers<Geometry>>().size()) - 1));
  }

  /// @param first    body that the first node will be
  /// @param hanging  is told the ends under which the rock has fallen
  [[nodiscard]] std::vector<LiningFootSpring<dim>> feet_of(const LiningFrame<Geometry>& wanted,
                                                           const LiningFrame<Geometry>& frame,
                                                           const FootBearing& bearing, int first,
                                                           std::vector<Vec<dim>>& hanging) const {
    if (wanted.ends.empty())
      throw InvalidInput("lining: it is closed and has no ends that feet could stand under");
    std::vector<LiningFootSpring<dim>> springs;
    for (const LiningEnd<Geometry>& end : frame.ends) {
      if (end.body >= 0 && system_.body(end.body).is_gone) {
        hanging.push_back(end.place);
        continue;
      }
      springs.push_back(foot_spring(end, first + end.node, bearing));
      // A pin is pushed in its middle, by a foot too.
      if (!is_pinned_)
        springs.back().arm_node = end.place - frame.nodes[static_cast<std::size_t>(end.node)];
      springs.back().arm_rock = system_.arm(end.body, end.place);
    }
    return springs;
  }
  void add_feet(const FootBearing& bearing, std::vector<LiningFootSpring<dim>> springs) {
    if (springs.empty()) return;
    for (auto& spring : springs) spring.install_at(system_.displacement.data());
    system_.supports.add(std::make_shared<LiningFeet<dim>>(bearing, std::move(springs)));
  }

  /// What rock touches: here at a point for every piece of wall, at two (in 3-D four) where the
  /// interface holds tension; in motion the surface.
  void add_surface(const LiningFrame<Geometry>& frame, const std::vector<LiningSection>& sections,
                   const InterfaceLaw& interface_law, std::vector<FreeEnd<dim>> free) {
    const int law = system_.interface.add_law(interface_law);
    const bool is_bonded = holds_tension<dim>(interface_law);
    double thickness = 0;
    for (const LiningSection& section : sections)
      thickness = std::max(thickness, section.thickness());
    system_.linings.push_back({first_node_, law, is_pinned_, thickness,
                               LiningSurface<Geometry>(
                                   frame, thickness, [this](int b) { return system_.motion_of(b); },
                                   [this](int b) { return system_.body(b).is_gone; }),
                               frame.fills, gaps_behind(frame), std::move(free)});
    const std::size_t before = system_.interface.contacts().size();
    for (const int k : order_by_bodies(frame.contacts, [&](const LiningContact<Geometry>& c) {
           return std::pair<int, int>(c.body, first_node_ + c.node);
         })) {
      const LiningContact<Geometry>& c = frame.contacts[static_cast<std::size_t>(k)];
      if (system_.body(c.body).is_gone) continue;
      const int node = first_node_ + c.node;
      const auto touch = [&](const Vec<dim>& centre, std::span<const FacetPoint<dim>> points) {
        system_.interface.add(node, c.body, c.facet, centre, system_.body(c.body).centre, points,
                              law);
      };
      const FacetPoint<dim> middle{zeros<Vec<dim>>(), c.facet.measure()};
      if (is_pinned_) {
        // A pin is pushed in its middle, wherever on its stretch the rock touches it.
        touch(c.facet.centre(), {&middle, 1});
      } else if (is_bonded) {
        // Bond fails at the edge of a block: the stress must be linear along the piece of wall.
        const auto points = c.facet.gauss_points();
        touch(system_.body(node).centre, points);
      } else {
        touch(system_.body(node).centre, {&middle, 1});
      }
    }
    system_.interface.touch_at(system_.displacement.data(), before);
  }

  /// Those of the frame, and those over fallen blocks, which a frame may take to be there.
  [[nodiscard]] std::vector<LiningGap> gaps_behind(const LiningFrame<Geometry>& frame) const {
    std::vector<double> open(frame.nodes.size(), 0.0), whole(frame.nodes.size(), 0.0);
    for (const auto& panel : frame.panels)
      whole[static_cast<std::size_t>(panel.node)] += panel.facet.measure();
    for (const auto& c : frame.contacts)
      if (system_.body(c.body).is_gone) open[static_cast<std::size_t>(c.node)] += c.facet.measure();
    for (const LiningGap& gap : frame.gaps) {
      const auto node = static_cast<std::size_t>(gap.node);
      open[node] += gap.share * whole[node];
    }
    std::vector<LiningGap> gaps;
    for (std::size_t k = 0; k < open.size(); ++k)
      if (whole[k] > 0 && open[k] > 0.01 * whole[k])
        gaps.push_back({static_cast<int>(k), open[k] / whole[k]});
    return gaps;
  }

  System& system_;
  double gravity_, near_;
  int first_node_ = 0;
  bool is_pinned_ = false;  ///< the lining that is put in
};

/// See `LiningAssembly::run`. Compiled once for all laws.
template <class Lining, class System>
std::vector<Vec<System::dim>> assemble_lining(
    System& system, double gravity, double near,
    const LiningFrame<typename System::GeometryType>& frame,
    const std::vector<LiningSection>& sections, const typename System::Law& interface_law,
    const std::optional<FootBearing>& feet) {
  return LiningAssembly<Lining, System>(system, gravity, near)
      .run(frame, sections, interface_law, feet);
}

}  // namespace voussoir::detail
