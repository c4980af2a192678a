// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/lining/lining_model.hpp>
#ifdef VOUSSOIR_COMPILED
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#endif

namespace voussoir {

/// Where a lining touches the rock: node `node` and body `body` share this facet of the wall.
template <class Geometry>
struct LiningContact {
  int node, body;
  typename Geometry::Facet facet;  ///< node on its left (2-D): anticlockwise round the opening
};

/// Where a lining fills a hole in the wall: from the outline to the body behind. It sticks to that
/// body, and the node bears on it as on rock.
template <class Geometry>
struct LiningFill {
  int node, body;
  typename Geometry::Shape shape;
};

/// Where a node has no rock behind it as far as it fills holes.
struct LiningGap {
  int node;
  double share;  ///< of what stands for the node, 0 to 1
};

/// A straight member of a lining.
template <class Geometry>
struct LiningMember {
  int first, second;  ///< node numbers
  /// In 3-D: towards the rock, about perpendicular to the member; bending in the plane of this
  /// and the member is that of `LiningSection::bending_stiffness`.
  Vec<Geometry::dim> outward = zeros<Vec<Geometry::dim>>();
  int section = 0;  ///< index into the sections given
};

/// The part of a lining's outer side that stands for a node, whether rock is there or not.
template <class Geometry>
struct LiningPanel {
  int node;
  typename Geometry::Facet facet;  ///< node on its left, as in `LiningContact`
};

/// Where an end of a lining may stand on rock.
template <class Geometry>
struct LiningEnd {
  static constexpr int dim = Geometry::dim;
  int node;
  int neighbour;             ///< index of the place where the lining ends, and would go on
  int body;                  ///< of the rock that is there; -1: none
  Vec<dim> place;            ///< where the foot acts [m]
  Vec<dim> direction;        ///< from the lining into the rock, a unit vector
  double length = 1;         ///< of the tunnel that it stands for; 1 in 2-D [m]
  std::string refusal = {};  ///< why no foot can stand there, whatever the rock; empty: one can
};

/// A lining as solvers take it: nodes, the members between them, and its contact with the rock.
template <class Geometry>
struct LiningFrame {
  std::vector<Vec<Geometry::dim>> nodes;  ///< [m]
  std::vector<LiningMember<Geometry>> members;
  std::vector<LiningContact<Geometry>> contacts;
  std::vector<LiningPanel<Geometry>> panels;  ///< needed where rock can land on the lining
  std::vector<LiningFill<Geometry>> fills{};
  std::vector<LiningGap> gaps{};  ///< in the order of the nodes
  /// Nodes at corners, that touch no rock: what bends goes round the corner with them; bars on pins
  /// do without (`without_bare_nodes`).
  std::vector<int> bare{};
  /// Its ends, which may be those of a lining that stands, and places beside it where nodes of one
  /// may be [m].
  std::vector<Vec<Geometry::dim>> neighbours{};
  /// Members that join it to those: the number of neighbour m is nodes.size() + m. Where nothing
  /// stands there is no such member.
  std::vector<LiningMember<Geometry>> joints{};
  /// Its ends; one that goes on in a lining that stands is none.
  std::vector<LiningEnd<Geometry>> ends{};
  /// Of the full outline, of which it may be an arc [m]; 0: it was made in another way.
  double perimeter = 0;
  /// In 2-D: about which angles along it and its convergence are counted [m].
  Vec<Geometry::dim> centre = zeros<Vec<Geometry::dim>>();

  /// Of a node, or of a neighbour behind them.
  [[nodiscard]] const Vec<Geometry::dim>& place(int k) const {
    const auto at = static_cast<std::size_t>(k);
    return at < nodes.size() ? nodes[at] : neighbours[at - nodes.size()];
  }
};

/// The frame with those neighbours that are there; what joins them is among its members.
/// @param is_there  is_there(index of the neighbour), asked once for each, in their order
template <class Geometry, class IsThere>
[[nodiscard]] LiningFrame<Geometry> with_neighbours(LiningFrame<Geometry> frame,
                                                    IsThere&& is_there) {
  const int nodes = static_cast<int>(frame.nodes.size());
  std::vector<int> number(frame.neighbours.size(), -1);
  std::size_t kept = 0;
  for (std::size_t m = 0; m < number.size(); ++m)
    if (is_there(m)) {
      number[m] = nodes + static_cast<int>(kept);
      frame.neighbours[kept++] = frame.neighbours[m];
    }
  frame.neighbours.resize(kept, zeros<Vec<Geometry::dim>>());
  std::erase_if(frame.ends, [&](const LiningEnd<Geometry>& end) {
    return number[static_cast<std::size_t>(end.neighbour)] >= 0;
  });
  for (LiningMember<Geometry> joint : frame.joints) {
    for (int* end : {&joint.first, &joint.second})
      if (*end >= nodes) *end = number[static_cast<std::size_t>(*end - nodes)];
    if (joint.first >= 0 && joint.second >= 0) frame.members.push_back(joint);
  }
  frame.joints.clear();
  return frame;
}

/// The frame whose ends begin at nodes that stand: these become neighbours, with the members that
/// lead to them as joints. What lies on a standing lining as a whole, a second layer, stays.
/// @param stands  stands(place): whether a lining has a node there
template <class Geometry, class Stands>
[[nodiscard]] LiningFrame<Geometry> with_shared_ends(const LiningFrame<Geometry>& frame,
                                                     Stands&& stands) {
  const std::size_t count = frame.nodes.size();
  std::vector<char> is_end(count, 0), is_standing(count, 0), leads_on(count, 0);
  for (const auto& joint : frame.joints)
    for (const int end : {joint.first, joint.second})
      if (static_cast<std::size_t>(end) < count) is_end[static_cast<std::size_t>(end)] = 1;
  for (std::size_t k = 0; k < count; ++k) is_standing[k] = is_end[k] && stands(frame.nodes[k]);
  for (const auto& m : frame.members) {
    const auto i = static_cast<std::size_t>(m.first), j = static_cast<std::size_t>(m.second);
    if (is_standing[i] != is_standing[j]) leads_on[i] = leads_on[j] = 1;
  }
  LiningFrame<Geometry> rest;
  rest.centre = frame.centre;
  std::vector<int> number(count + frame.neighbours.size(), -1);
  const auto is_shared = [&](int k) {
    const auto at = static_cast<std::size_t>(k);
    return at < count && is_standing[at] && leads_on[at];
  };
  for (std::size_t k = 0; k < count; ++k)
    if (!is_shared(static_cast<int>(k))) {
      number[k] = static_cast<int>(rest.nodes.size());
      rest.nodes.push_back(frame.nodes[k]);
    }
  for (std::size_t k = 0; k < number.size(); ++k)
    if (number[k] < 0) {
      number[k] = static_cast<int>(rest.nodes.size() + rest.neighbours.size());
      rest.neighbours.push_back(frame.place(static_cast<int>(k)));
    }
  const auto renumbered = [&](LiningMember<Geometry> m) {
    m.first = number[static_cast<std::size_t>(m.first)];
    m.second = number[static_cast<std::size_t>(m.second)];
    return m;
  };
  for (const auto& m : frame.members) {
    if (is_shared(m.first) && is_shared(m.second)) continue;
    (is_shared(m.first) || is_shared(m.second) ? rest.joints : rest.members)
        .push_back(renumbered(m));
  }
  for (const auto& m : frame.joints)
    if (!is_shared(m.first) && !is_shared(m.second)) rest.joints.push_back(renumbered(m));
  for (auto end : frame.ends) {
    const int neighbour = static_cast<int>(count) + end.neighbour;
    if (is_shared(end.node)) continue;
    end.node = number[static_cast<std::size_t>(end.node)];
    end.neighbour =
        number[static_cast<std::size_t>(neighbour)] - static_cast<int>(rest.nodes.size());
    rest.ends.push_back(end);
  }
  for (auto c : frame.contacts)
    if (!is_shared(c.node)) {
      c.node = number[static_cast<std::size_t>(c.node)];
      rest.contacts.push_back(c);
    }
  for (auto f : frame.fills) {
    if (is_shared(f.node)) continue;  // it stands already
    f.node = number[static_cast<std::size_t>(f.node)];
    rest.fills.push_back(std::move(f));
  }
  for (auto g : frame.gaps)
    if (!is_shared(g.node)) {
      g.node = number[static_cast<std::size_t>(g.node)];
      rest.gaps.push_back(g);
    }
  for (auto p : frame.panels)
    if (!is_shared(p.node)) {
      p.node = number[static_cast<std::size_t>(p.node)];
      rest.panels.push_back(p);
    }
  return rest;
}

/// The frame without its bare nodes: their members lead from one neighbour to the other, and an end
/// is that of the last node that touches rock. A pin at a corner would be held by nothing.
template <class Geometry>
[[nodiscard]] LiningFrame<Geometry> without_bare_nodes(LiningFrame<Geometry> frame) {
  if (frame.bare.empty()) return frame;
  const int count = static_cast<int>(frame.nodes.size());
  std::vector<int> number(frame.nodes.size() + frame.neighbours.size());
  std::iota(number.begin(), number.end(), 0);
  std::vector<int> into = number;
  for (const int bare : frame.bare) {
    const auto member =
        std::find_if(frame.members.begin(), frame.members.end(),
                     [&](const auto& m) { return m.first == bare || m.second == bare; });
    VOUSSOIR_ASSERT(member != frame.members.end(), "a bare node is joined to others");
    into[static_cast<std::size_t>(bare)] = member->first == bare ? member->second : member->first;
    frame.members.erase(member);
  }
  std::vector<Vec<Geometry::dim>> nodes;
  int kept = 0;
  for (std::size_t k = 0; k < number.size(); ++k) {
    const bool is_bare = into[k] != static_cast<int>(k);
    number[k] = kept;
    kept += is_bare ? 0 : 1;
    if (!is_bare && static_cast<int>(k) < count) nodes.push_back(frame.nodes[k]);
  }
  const auto renumber = [&](int& k) {
    k = number[static_cast<std::size_t>(into[static_cast<std::size_t>(k)])];
  };
  frame.nodes = std::move(nodes);
  frame.bare.clear();
  for (auto* members : {&frame.members, &frame.joints})
    for (auto& m : *members) {
      renumber(m.first);
      renumber(m.second);
    }
  const auto renumber_nodes = [&](auto& things) {
    for (auto& thing : things) renumber(thing.node);
  };
  renumber_nodes(frame.contacts);
  renumber_nodes(frame.panels);
  renumber_nodes(frame.fills);
  renumber_nodes(frame.gaps);
  renumber_nodes(frame.ends);
  return frame;
}

/// What a node has of the members that meet there.
struct LiningNodeShare {
  double length = 0;  ///< half of every member [m]
  double mass = 0;    ///< [kg]
};

/// @return  one for every node and neighbour; of the latter what the members that join them add
/// @throws InvalidInput  a member without length, or of a section that is not given
template <class Geometry>
[[nodiscard]] std::vector<LiningNodeShare> node_shares(const LiningFrame<Geometry>& frame,
                                                       const std::vector<LiningSection>& sections) {
  std::vector<LiningNodeShare> shares(frame.nodes.size() + frame.neighbours.size());
  for (const auto& member : frame.members) {
    const auto i = static_cast<std::size_t>(member.first),
               j = static_cast<std::size_t>(member.second);
    VOUSSOIR_ASSERT(i < shares.size() && j < shares.size(), "a member joins nodes of its frame");
    const double length = (frame.place(member.second) - frame.place(member.first)).norm();
    require(length > 0, "length of a lining member", length, "> 0 m");
    require(member.section >= 0 && static_cast<std::size_t>(member.section) < sections.size(),
            "section of a lining member", member.section, "the index of a section given");
    for (const std::size_t node : {i, j}) {
      shares[node].length += 0.5 * length;
      shares[node].mass += 0.5 * length * sections[static_cast<std::size_t>(member.section)].mass;
    }
  }
  return shares;
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE std::vector<LiningNodeShare> node_shares<Planar>(
    const LiningFrame<Planar>&, const std::vector<LiningSection>&);
VOUSSOIR_SPATIAL_TEMPLATE std::vector<LiningNodeShare> node_shares<Spatial>(
    const LiningFrame<Spatial>&, const std::vector<LiningSection>&);
#endif

}  // namespace voussoir
