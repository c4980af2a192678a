// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/lining/lining_frame.hpp>
#include <voussoir/rockmass/carving_limits.hpp>
#include <voussoir/tunnel/lining_ring.hpp>

namespace voussoir {

/// A lining in 3-D: ribs, lattice girders or strips of shotcrete across an opening, and what joins
/// them along it. Ribs next to some that stand, at the same spacing, are joined to them.
struct LiningRibs {
  LiningRing ring{};   ///< one rib, in the coordinates of the section
  double spacing = 1;  ///< of the ribs along the axis [m], > 0
  bool tied = true;    ///< longitudinal members join the nodes of neighbouring ribs
  /// The lined stretch: places along the axis [m], as far as the opening is inside the domain.
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();  ///< see `from`
};

/// Nodes and members of ribs: members across the opening have section 0, members along it
/// section 1. Every rib stands for the rock up to half its spacing on both sides; each piece of
/// wall there touches its node at one point.
///
/// @param opening  that is lined; it may be one that was taken out in rounds
/// @param fallen   bodies that have fallen before, see `lining_frame` of a ring
/// @throws InvalidInput  as `lining_frame` of a ring; the stretch lies outside; spacing out of
/// range
///                       or longer than the stretch
[[nodiscard]] VOUSSOIR_INLINE LiningFrame<Spatial> lining_frame(
    const RockMass<Spatial>& mass, const PrismaticOpening& opening, const LiningRibs& ribs,
    const std::vector<int>& fallen = {});
/// The same on the wall of the last opening.
[[nodiscard]] VOUSSOIR_INLINE LiningFrame<Spatial> lining_frame(
    const RockMass<Spatial>& mass, const LiningRibs& ribs, const std::vector<int>& fallen = {});

#if VOUSSOIR_BODIES

namespace detail {

/// Puts the frame of ribs together, piece by piece.
class RibBuilder {
 public:
  RibBuilder(const RockMass<Spatial>& mass, const PrismaticOpening& opening, const LiningRibs& ribs)
      : mass_(mass),
        opening_(opening),
        nodes_(ring_nodes(opening.section(), ribs.ring)),
        fill_depth_(ribs.ring.fill_depth) {
    const auto [low, high] = stretch_inside(opening, mass.domain);
    from_ = std::max(ribs.from, low);
    const double to = std::min(ribs.to, high);
    require(
        to > from_, "end of the lined stretch", to,
        message({"beyond its beginning at ", from_, " m: the opening is inside the domain from ",
                 low, " to ", high, " m along its axis"})
            .c_str());
    require(ribs.spacing > 0 && ribs.spacing <= (to - from_) * (1 + 1e-9), "spacing of ribs",
            ribs.spacing, "> 0 m and no longer than the tunnel");
    rows_ = static_cast<int>(std::floor((to - from_) / ribs.spacing + 1e-9));
    width_ = (to - from_) / rows_;
    ring_ = static_cast<int>(nodes_.places.size());
  }

  [[nodiscard]] LiningFrame<Spatial> build(bool tied, const std::vector<int>& fallen) {
    frame_.perimeter = opening_.section().perimeter();
    for (int row = 0; row < rows_; ++row)
      for (int n = 0; n < ring_; ++n) {
        const auto here = static_cast<std::size_t>(n);
        const int next = n + 1 == ring_ ? 0 : n + 1;
        frame_.nodes.push_back(opening_.in_space(nodes_.places[here], middle(row)));
        if (nodes_.joined[here])
          frame_.members.push_back(
              {number(row, n), number(row, next),
               outward(nodes_.places[static_cast<std::size_t>(next)] - nodes_.places[here]), 0});
        if (nodes_.is_bare[here]) frame_.bare.push_back(number(row, n));
        if (tied && row > 0 && !nodes_.is_bare[here])  // ties stand for stretches of the wall
          frame_.members.push_back({number(row - 1, n), number(row, n), outward(chord_at(n)), 1});
      }
    add_neighbours(tied);
    add_panels();
    LiningOnWall<Spatial>(mass_, opening_, nodes_, fill_depth_, fallen)
        .put_on(frame_, [this](int ring_node, const SpatialFacet& facet, auto&& add) {
          each_row(ring_node, facet, add);
        });
    return std::move(frame_);
  }

 private:
  [[nodiscard]] int number(int row, int n) const { return row * ring_ + n; }
  [[nodiscard]] double middle(int row) const { return from_ + (row + 0.5) * width_; }
  /// Out of the section, at right angles to a chord that runs anticlockwise.
  [[nodiscard]] Vec3 outward(const Vec2& chord) const {
    return opening_.axis().direction(Vec2(-perpendicular(chord)));
  }
  /// From the node before one to the node behind it.
  [[nodiscard]] Vec2 chord_at(int n) const {
    const auto here = static_cast<std::size_t>(n);
    const std::size_t before = n == 0 ? nodes_.places.size() - 1 : here - 1;
    const std::size_t next = n + 1 == ring_ ? 0 : here + 1;
    return (nodes_.joined[here] ? nodes_.places[next] : nodes_.places[here]) -
           (nodes_.joined[before] ? nodes_.places[before] : nodes_.places[here]);
  }
  /// @return  the number of the neighbour at a place
  int add_neighbour(const Vec2& place, double along) {
    frame_.neighbours.push_back(opening_.in_space(place, along));
    return static_cast<int>(frame_.nodes.size() + frame_.neighbours.size()) - 1;
  }

  void add_neighbours(bool tied) {
    for (int row = 0; row < rows_; ++row)
      for (const RingEnd& end : nodes_.ends) {
        const int there = add_neighbour(end.place, middle(row)), here = number(row, end.node);
        frame_.ends.push_back(
            founded<Spatial>(mass_,
                             {here, static_cast<int>(frame_.neighbours.size()) - 1, -1,
                              opening_.in_space(end.place, middle(row)),
                              opening_.axis().direction(end.direction), width_, end.refusal},
                             opening_.axis().direction(end.inward()), nodes_.stretch));
        if (end.is_after)
          frame_.joints.push_back({here, there, outward(end.direction), 0});
        else
          frame_.joints.push_back({there, here, outward(Vec2(-end.direction)), 0});
      }
    for (int n = 0; tied && n < ring_; ++n) {
      if (nodes_.is_bare[static_cast<std::size_t>(n)]) continue;
      const Vec2& place = nodes_.places[static_cast<std::size_t>(n)];
      const int before = add_neighbour(place, middle(-1)),
                after = add_neighbour(place, middle(rows_));
      frame_.joints.push_back({before, number(0, n), outward(chord_at(n)), 1});
      frame_.joints.push_back({number(rows_ - 1, n), after, outward(chord_at(n)), 1});
    }
  }

  void add_panels() {
    const double inwards = 1e-6 * opening_.section().perimeter();
    for (const OutlinePart& part :
         outline_parts(opening_.section(), nodes_, mass_.domain.tolerance()))
      for (int row = 0; row < rows_; ++row) {
        const auto at = [&](const Vec2& p, int end) {
          return opening_.in_space(p, from_ + (row + end) * width_);
        };
        const Vec2 &a = part.edge.start, &b = part.edge.end;
        if (part.edge.length() > 4 * inwards)
          require_excavated(
              mass_, opening_.in_space(
                         part.edge.centre() + inwards * normalized(perpendicular(Vec2(b - a))),
                         middle(row)));
        frame_.panels.push_back(
            {number(row, part.node), {{at(a, 0), at(a, 1), at(b, 1), at(b, 0)}}});
      }
  }

  /// Parts a facet in a stretch of the ring among the ribs: add(number of the node, part).
  template <class Add>
  void each_row(int ring_node, const SpatialFacet& facet, Add&& add) const {
    const double tolerance = mass_.domain.tolerance();
    const Vec3 &axis = opening_.axis().along(), &origin = opening_.axis().origin();
    const auto side = [&](double s, double way) {
      return HalfSpace<3>::through(origin + s * axis, Vec3(way * axis));
    };
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& v : facet.vertices) {
      low = std::min(low, opening_.along(v));
      high = std::max(high, opening_.along(v));
    }
    for (int row = 0; row < rows_; ++row) {
      if (from_ + (row + 1) * width_ <= low || from_ + row * width_ >= high) continue;
      auto part = part_of(facet, side(from_ + row * width_, -1), tolerance);
      if (part) part = part_of(*part, side(from_ + (row + 1) * width_, 1), tolerance);
      if (part) add(number(row, ring_node), *part);
    }
  }

  const RockMass<Spatial>& mass_;
  const PrismaticOpening& opening_;
  RingNodes nodes_;
  double fill_depth_, from_ = 0, width_ = 0;
  int rows_ = 0, ring_ = 0;
  LiningFrame<Spatial> frame_;
};

}  // namespace detail

VOUSSOIR_INLINE LiningFrame<Spatial> lining_frame(const RockMass<Spatial>& mass,
                                                  const PrismaticOpening& opening,
                                                  const LiningRibs& ribs,
                                                  const std::vector<int>& fallen) {
  if (mass.openings.empty()) throw InvalidInput("lining: there is no opening to line");
  return detail::RibBuilder(mass, opening, ribs).build(ribs.tied, fallen);
}

VOUSSOIR_INLINE LiningFrame<Spatial> lining_frame(const RockMass<Spatial>& mass,
                                                  const LiningRibs& ribs,
                                                  const std::vector<int>& fallen) {
  if (mass.openings.empty()) throw InvalidInput("lining: there is no opening to line");
  return lining_frame(mass, mass.openings.back(), ribs, fallen);
}

#endif

}  // namespace voussoir
