// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/lining/lining_frame.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>
#include <voussoir/tunnel/ring_nodes.hpp>

namespace voussoir::detail {

/// Gives every node of a lining its contacts with the wall behind its stretch of the outline.
///
/// Where a piece of rock was dropped or a block has fallen, the lining fills the hole: it bears on
/// the body behind, at the outline and at right angles to it, over what of the outline is in front
/// of that body. So a hole changes neither the area on which the rock presses nor the way it
/// presses, and fills do not key a smooth lining to the rock.
template <class Geometry>
class LiningOnWall {
 public:
  static constexpr int dim = Geometry::dim;
  using Facet = typename Geometry::Facet;
  using Shape = typename Geometry::Shape;

  LiningOnWall(const RockMass<Geometry>& mass, const typename Geometry::Opening& opening,
               const RingNodes& nodes, double fill_depth, const std::vector<int>& fallen)
      : wall_(wall_of(mass, opening, fallen)),
        outline_(opening),
        nodes_(nodes),
        fill_depth_(fill_depth),
        tolerance_(mass.domain.tolerance()) {
    if constexpr (dim == 3) opening_ = &opening;
  }

  /// @param frame   has its nodes and panels
  /// @param divide  divide(node of the ring, facet behind it, add): calls add(node of the frame,
  ///                part) for every part, in 3-D between the ribs
  template <class Divide>
  void put_on(LiningFrame<Geometry>& frame, Divide&& divide) {
    std::vector<LiningContact<Geometry>> of_holes;
    for (const WallPiece<Geometry>& piece : wall_.pieces) {
      const auto e = static_cast<std::size_t>(piece.edge);
      for (const Facet& on_outline : in_front_of(piece)) {
        const auto [from, to] = places(e, on_outline);
        each_stretch(on_outline, e, from, to, [&](int ring_node, const Facet& part) {
          divide(ring_node, part, [&](int node, const Facet& facet) {
            if (piece.hole < 0) {
              frame.contacts.push_back({node, piece.body, facet});
            } else {
              of_holes.push_back({node, piece.body, facet});
              add_fills(frame, piece, node, facet);
            }
          });
        });
      }
    }
    if constexpr (dim == 2) join_neighbours(of_holes);
    frame.contacts.insert(frame.contacts.end(), of_holes.begin(), of_holes.end());
    add_gaps(frame);
  }

 private:
  /// Makes one of contacts of a node and a body that lie side by side in front of holes: into how
  /// many parts these have been cut is no matter of the lining. Not of those on rock with these: in
  /// motion they are contacts of two shapes, of which one alone would go on from the one at rest.
  void join_neighbours(std::vector<LiningContact<Geometry>>& contacts) const {
    // Again and again: one that comes late may lie between two that did not meet.
    for (std::size_t before = contacts.size() + 1; contacts.size() < before;) {
      before = contacts.size();
      join_once(contacts);
    }
  }
  void join_once(std::vector<LiningContact<Geometry>>& contacts) const {
    std::vector<LiningContact<Geometry>> joined;
    for (LiningContact<Geometry>& contact : contacts) {
      bool is_taken = false;
      for (std::size_t k = joined.size(); !is_taken && k-- > 0;) {
        LiningContact<Geometry>& other = joined[k];
        if (other.node != contact.node || other.body != contact.body) continue;
        if (std::abs(dot_product(normalized(contact.facet.area_vector()),
                                 other.facet.end - other.facet.start)) > 2 * tolerance_)
          continue;
        const auto meet = [&](const Vec2& a, const Vec2& b) {
          return length_of(a - b) <= 2 * tolerance_;
        };
        is_taken = true;
        if (meet(other.facet.end, contact.facet.start))
          other.facet.end = contact.facet.end;
        else if (meet(contact.facet.end, other.facet.start))
          other.facet.start = contact.facet.start;
        else
          is_taken = false;
      }
      if (!is_taken) joined.push_back(std::move(contact));
    }
    contacts = std::move(joined);
  }
  /// What of the outline is in front of a piece of wall: itself, or what one sees it through if it
  /// lies behind a hole, where that is not too deep to be filled.
  [[nodiscard]] std::vector<Facet> in_front_of(const WallPiece<Geometry>& piece) const {
    if (piece.hole < 0) return {piece.facet};
    std::vector<Facet> seen;
    const auto e = static_cast<std::size_t>(piece.edge);
    const HalfSpace<dim> shallow = outline_.template in_space<dim>(outline_.within(e, fill_depth_));
    const auto filled = part_of(piece.facet, shallow, tolerance_);
    const HalfSpace<dim> outside = outline_.template in_space<dim>(outline_.within(e, 0));
    if (!filled) return seen;
    const Facet shadow = on_outline(*filled, e);
    if (!(dot_product(shadow.area_vector(), outside.normal) > 0)) return seen;  // it overhangs
    const int group = wall_.holes[static_cast<std::size_t>(piece.hole)].group;
    for (const WallHole<Geometry>& hole : wall_.holes) {
      if (hole.group != group || hole.edge != piece.edge) continue;
      for (std::size_t k = 0; k < hole.shape.size(); ++k) {
        const Facet face = hole.shape.face(k);
        const auto corners = corners_of(face);
        if (std::all_of(corners.begin(), corners.end(), [&](const Vec<dim>& p) {
              return std::abs(outside.distance(p)) <= 2 * tolerance_;
            }))
          if (auto part = shared_face(face, shadow, tolerance_)) seen.push_back(std::move(*part));
      }
    }
    return seen;
  }
  /// A facet brought to the outline, along the lines on which what is behind a place lies.
  [[nodiscard]] Facet on_outline(Facet facet, std::size_t e) const {
    const auto bring = [&](Vec<dim>& p) {
      const Vec2 there = outline_.point(e, outline_.place(e, outline_.in_section(p)));
      if constexpr (dim == 2)
        p = there;
      else
        p = opening_->in_space(there, opening_->along(p));
    };
    if constexpr (dim == 2) {
      bring(facet.start);
      bring(facet.end);
    } else {
      for (Vec3& v : facet.vertices) bring(v);
    }
    return facet;
  }
  /// The places of an edge where a facet on it begins and ends.
  [[nodiscard]] std::pair<double, double> places(std::size_t e, const Facet& facet) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& corner : corners_of(facet)) {
      const double s = outline_.place(e, outline_.in_section(corner));
      low = std::min(low, s);
      high = std::max(high, s);
    }
    return {low, high};
  }

  /// visit(node of the ring, part): of a facet on an edge, what lies in each stretch.
  template <class Visit>
  void each_stretch(const Facet& facet, std::size_t e, double from, double to,
                    Visit&& visit) const {
    constexpr double endless = std::numeric_limits<double>::infinity();
    const double start = outline_.start(e), end = outline_.start(e + 1) - start;
    nodes_.each_stretch(start + from, start + to, [&](int node, double begin, double high) {
      const double low = begin - start;
      high -= start;
      if (const auto part =
              outline_.template part_between<dim>(std::optional(facet), e, low > 0 ? low : -endless,
                                                  high < end ? high : endless, tolerance_))
        visit(node, *part);
    });
  }

  /// What of the holes lies behind a facet on the outline, as deep as it is filled.
  void add_fills(LiningFrame<Geometry>& frame, const WallPiece<Geometry>& piece, int node,
                 const Facet& facet) const {
    const auto e = static_cast<std::size_t>(piece.edge);
    const int group = wall_.holes[static_cast<std::size_t>(piece.hole)].group;
    const Vec2 middle = outline_.in_section(facet.centre());
    const Vec2 way = outline_.way_behind(e, outline_.place(e, middle));
    for (const WallHole<Geometry>& hole : wall_.holes) {
      if (hole.group != group || hole.edge != piece.edge) continue;
      auto shape = part_of(
          hole.shape, outline_.template in_space<dim>(outline_.within(e, fill_depth_)), tolerance_);
      if constexpr (dim == 2) {
        const auto [from, to] = places(e, facet);
        shape = outline_.part_between<2>(std::move(shape), e, from, to, tolerance_);
      } else {
        const Vec3 behind = opening_->axis().direction(way);
        for (std::size_t k = 0; shape && k < facet.vertices.size(); ++k) {
          const Vec3& here = facet.vertices[k];
          const Vec3& next = facet.vertices[k + 1 == facet.vertices.size() ? 0 : k + 1];
          const Vec3 out = cross(Vec3(next - here), behind);
          if (length_of(out) > tolerance_)
            shape = part_of(*shape, HalfSpace<3>::through(here, normalized(out)), tolerance_);
        }
      }
      if (shape) frame.fills.push_back({node, piece.body, std::move(*shape)});
    }
  }

  void add_gaps(LiningFrame<Geometry>& frame) const {
    std::vector<double> covered(frame.nodes.size(), 0.0), whole(frame.nodes.size(), 0.0);
    for (const auto& contact : frame.contacts)
      covered[static_cast<std::size_t>(contact.node)] += contact.facet.measure();
    for (const auto& panel : frame.panels)
      whole[static_cast<std::size_t>(panel.node)] += panel.facet.measure();
    for (std::size_t k = 0; k < whole.size(); ++k)
      if (const double open = whole[k] - covered[k]; open > 0.01 * whole[k])
        frame.gaps.push_back({static_cast<int>(k), open / whole[k]});
  }

  Wall<Geometry> wall_;
  WallOutline outline_;
  const RingNodes& nodes_;
  double fill_depth_, tolerance_;
  const PrismaticOpening* opening_ = nullptr;
};

}  // namespace voussoir::detail
