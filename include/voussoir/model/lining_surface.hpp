// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/slab_behind.hpp>
#include <voussoir/geometry/spatial_facet.hpp>
#include <voussoir/lining/frame_element.hpp>
#include <voussoir/lining/lining_frame.hpp>
#ifdef VOUSSOIR_COMPILED
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#endif

namespace voussoir {

namespace detail {

/// A facet as it is after a motion.
[[nodiscard]] inline Segment moved(const Segment& facet, const Pose<2>& motion) {
  return {motion(facet.start), motion(facet.end)};
}
[[nodiscard]] inline SpatialFacet moved(SpatialFacet facet, const Pose<3>& motion) {
  for (Vec3& v : facet.vertices) v = motion(v);
  return facet;
}

}  // namespace detail

/// What rock touches of a lining where bodies move freely, node by node, as it lies when it is
/// installed.
///
/// On rock, and on what fills a hole in it, lies a slab for every piece of wall, as sprayed; where
/// rock is missing, or is further away than the thickness, a slab on the whole panel of the node,
/// set back by a fifth of the thickness so that what touches the one does not touch the other.
template <class Geometry>
class LiningSurface {
 public:
  static constexpr int dim = Geometry::dim;
  using Shape = typename Geometry::Shape;

  /// @param thickness  of the lining [m]
  /// @param motion_of  motion_of(body): how a body has moved since the in-situ state
  /// @param is_gone    is_gone(body)
  template <class MotionOf, class IsGone>
  LiningSurface(const LiningFrame<Geometry>& frame, double thickness, MotionOf&& motion_of,
                IsGone&& is_gone)
      : tiles_(frame.nodes.size()),

        shift_(frame.nodes.size(), zeros<Vec<dim>>()) {
    std::vector<double> covered(frame.nodes.size(), 0.0), whole(frame.nodes.size(), 0.0);

    for (const auto& c : frame.contacts) {
      const Pose<dim> motion = motion_of(c.body);
      auto facet = detail::moved(c.facet, motion);
      if (is_gone(c.body) || (facet.centre() - c.facet.centre()).norm() > thickness) continue;
      const auto k = static_cast<std::size_t>(c.node);
      covered[k] += facet.measure();
      shift_[k] += facet.measure() * (motion(frame.nodes[k]) - frame.nodes[k]);
      tiles_[k].push_back({std::move(facet), thickness});
    }
    for (std::size_t k = 0; k < shift_.size(); ++k)
      if (covered[k] > 0) shift_[k] /= covered[k];
    for (const auto& panel : frame.panels)
      whole[static_cast<std::size_t>(panel.node)] += panel.facet.measure();
    for (const auto& panel : frame.panels) {
      const auto k = static_cast<std::size_t>(panel.node);
      if (covered[k] > 0.99 * whole[k]) continue;
      Pose<dim> back;
      back.position = shift_[k] - 0.2 * thickness * panel.facet.area_vector().normalized();
      tiles_[k].push_back({detail::moved(panel.facet, back), 0.8 * thickness});
    }
  }

  [[nodiscard]] std::size_t node_count() const { return tiles_.size(); }
  /// The tiles of a node. @throws InvalidInput  the lining has no thickness
  [[nodiscard]] std::vector<Shape> tiles(std::size_t node) const {
    std::vector<Shape> slabs;
    for (const Tile& tile : tiles_[node]) {
      require(tile.thickness > 0, "thickness of a lining in motion", tile.thickness,
              "> 0 m: its section needs a bending stiffness");
      slabs.push_back(slab_behind(tile.facet, tile.thickness));
    }

    return slabs;
  }
  /// @param is_out  is_out(middle of the face that rock touches)
  template <class IsOut>
  void remove_tiles(IsOut&& is_out) {
    for (auto& of_node : tiles_)
      std::erase_if(of_node, [&](const Tile& tile) { return is_out(tile.facet.centre()); });
  }
  /// How far a node has come with the wall.
  [[nodiscard]] const Vec<dim>& shift(std::size_t node) const { return shift_[node]; }

 private:
  struct Tile {
    typename Geometry::Facet facet;  ///< the face that rock touches
    double thickness;                ///< [m]
  };
  std::vector<std::vector<Tile>> tiles_;

  std::vector<Vec<dim>> shift_;
};

/// Where a lining that stands ends.
template <int Dim>
struct FreeEnd {
  int node;            ///< the last, counted from the first
  Vec<Dim> place;      ///< of the end [m]
  Vec<Dim> direction;  ///< in which it would go on, a unit vector
};

/// A lining among the bodies of a model.
template <class Geometry>
struct InstalledLining {
  int first;         ///< body that is its first node
  int law;           ///< of its interface with the rock, an index
  bool is_pinned;    ///< its nodes do not turn
  double thickness;  ///< [m]
  LiningSurface<Geometry> surface;
  std::vector<LiningFill<Geometry>> fills;  ///< of holes in the wall
  std::vector<LiningGap> gaps;              ///< nodes are counted from the first
  std::vector<FreeEnd<Geometry::dim>> ends{};
  /// Ends without the foot that they were to have: the rock there had fallen [m].
  std::vector<Vec<Geometry::dim>> hanging_ends{};
  bool came_off = false;  ///< off its wall, and was taken out
};

/// The members of a lining between its nodes. Where one that bends ends on a pin, or a pinned one
/// on a node that turns, it is hinged there.
/// @param places  of the nodes, and of the neighbours behind them [m]
/// @param bodies  that they are
/// @param is_pin  is_pin(k): whether the node at place k is one of a pinned lining
/// @throws InvalidInput  a member without length, or of a section that is not given
template <class Lining, class Geometry, class IsPin>
[[nodiscard]] std::vector<FrameElement<Geometry>> lining_elements(
    const LiningFrame<Geometry>& frame, const std::vector<LiningSection>& sections,
    const std::vector<Vec<Geometry::dim>>& places, const std::vector<int>& bodies, IsPin&& is_pin) {
  std::vector<FrameElement<Geometry>> elements;
  elements.reserve(frame.members.size());
  for (const auto& member : frame.members) {
    const Vec<Geometry::dim> along = places[static_cast<std::size_t>(member.second)] -
                                     places[static_cast<std::size_t>(member.first)];
    const double length = along.norm();
    require(length > 0, "length of a lining member", length, "> 0 m");
    const LiningSection& section = sections[static_cast<std::size_t>(member.section)];
    const bool is_pinned = is_pinned_lining<Lining>(section);
    auto stiffness = Lining::template stiffness<Geometry::dof>(section, length);
    const std::array<bool, 2> on_pin{is_pin(member.first), is_pin(member.second)};
    for (const int end : {0, 1}) {
      const bool has_pin = on_pin[static_cast<std::size_t>(end)];
      if (has_pin != is_pinned) hinge<Geometry::dof>(stiffness, end);
      // As its bars do: they may be taken out, and what is hinged to it stays.
      if (has_pin && !is_pinned)
        fix_pin<Geometry::dof>(stiffness, end, section.axial_stiffness * length);
    }
    elements.push_back({bodies[static_cast<std::size_t>(member.first)],
                        bodies[static_cast<std::size_t>(member.second)], length,
                        frame_axes<Geometry::dim>(along, member.outward), stiffness});
    elements.back().is_hinged = {is_pinned || on_pin[0], is_pinned || on_pin[1]};
  }
  return elements;
}

/// Moment of inertia of a node of a lining: that of a tile as long as its stretch. A pin is pushed
/// by the rock in its middle: it is given no reason to turn.
/// @param length  of the stretch [m];  @return  about every axis [kg m^2]
[[nodiscard]] inline double node_inertia(double mass, double length, double thickness,
                                         bool is_pinned) {
  return mass * (length * length + thickness * thickness) / 12 * (is_pinned ? 1e12 : 1.0);
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class LiningSurface<Planar>;
VOUSSOIR_SPATIAL_TEMPLATE class LiningSurface<Spatial>;
#endif

}  // namespace voussoir
