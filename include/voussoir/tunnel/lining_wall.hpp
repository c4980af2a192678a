// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/joined_facets.hpp>
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
    // Apart: in motion rock and what fills holes are contacts of two shapes, of which one alone
    // would go on from one at rest that is of both.
    ByNodeAndBody of_rock, of_holes;
    for (const WallPiece<Geometry>& piece : wall_.pieces) {
      const auto e = static_cast<std::size_t>(piece.edge);
      for (const Facet& on_outline : in_front_of(piece)) {
        const auto [from, to] = places(e, on_outline);
        each_stretch(on_outline, e, from, to, [&](int ring_node, const Facet& part) {
          divide(ring_node, part, [&](int node, const Facet& facet) {
            (piece.hole < 0 ? of_rock : of_holes)[{node, piece.body}].push_back(facet);
            if (piece.hole >= 0) add_fills(frame, piece, node, facet);
          });
        });
      }
    }
    add_joined(frame, of_rock);
    add_joined(frame, of_holes);
    add_gaps(frame);
  }

 private:
  using ByNodeAndBody = std::map<std::array<int, 2>, std::vector<Facet>>;

  /// Makes one contact of what a node and a body share side by side: into how many parts it has
  /// been cut is no matter of the lining.
  void add_joined(LiningFrame<Geometry>& frame, ByNodeAndBody& shared) const {
    for (auto& [who, facets] : shared)
      for (Facet& facet : joined_facets(std::move(facets), tolerance_))
        frame.contacts.push_back({who[0], who[1], std::move(facet)});
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
