// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/joint.hpp>

namespace voussoir {

/// What made a face: one cut of one block (or a side of the domain).
///
/// The two sides of a cut are tiled by faces that all carry its number, so initial contacts come
/// from sorting the faces of each cut, T-junctions included, without a search.
struct Cut {
  enum class Kind {
    boundary,
    joint,
    outline,
    seam,  ///< between parts of one body, where mapped joints leave it whole
  };
  Kind kind;
  int source;  ///< side of the domain, index of the joint, of the outline edge, of the joint beside
};

/// A rigid body: one or more convex parts that move as one.
///
/// Parts are kept in the coordinates of the domain, not of the body, so that neighbours share
/// vertices bit for bit: that is what makes the in-situ state balance to rounding.
template <class Geometry>
struct Body {
  std::vector<typename Geometry::Shape> parts;
  MassProperties<Geometry::dim> properties;  ///< of unit density
};

/// What became of a joint that was offered.
enum class JointFate : char {
  used,     ///< it cuts a block at least
  outside,  ///< it does not reach the domain
  refused,  ///< every cut was: a part too small or too long, or a joint is there already
};

/// What slicing did, for the report: nothing is dropped silently.
struct SlicingReport {
  std::size_t joints = 0;          ///< joints offered
  std::size_t cuts = 0;            ///< blocks cut in two
  std::size_t unused_joints = 0;   ///< joints that cut nothing
  std::size_t outside_joints = 0;  ///< of them, joints that do not reach the domain
  std::size_t coincident =
      0;  ///< cuts not made: the joint only touches the block, or runs along a face
  std::size_t refused_too_small = 0;  ///< cuts refused: a child's inscribed radius
  std::size_t refused_too_long = 0;   ///< cuts refused: a child's elongation
  std::size_t blocks_too_long = 0;    ///< blocks beyond the elongation limit: the domain is, too
  std::vector<JointFate> fates = {};  ///< of every joint offered, in their order
  std::size_t vanished_faces = 0;     ///< faces shorter (narrower) than the tolerance, welded away

  /// Times that a joint went into a block, whatever became of it.
  [[nodiscard]] std::size_t offered_cuts() const {
    return cuts + coincident + refused_too_small + refused_too_long;
  }
};

/// What carving an opening did.
struct CarvingReport {
  double removed_measure = 0;        ///< rock taken out [m^2] or [m^3]
  std::size_t removed_bodies = 0;    ///< bodies wholly inside the opening
  std::size_t cut_bodies = 0;        ///< bodies crossed by the outline
  std::size_t separated_bodies = 0;  ///< extra bodies where a cut block fell apart
  std::size_t dropped_pieces = 0;    ///< bodies at the wall below the smallest size, dropped
  double dropped_measure = 0;        ///< [m^2] or [m^3]
};

/// Jointed rock: the domain, the joints and the bodies between them.
template <class Geometry>
struct RockMass {
  Domain<Geometry::dim> domain;
  std::vector<JointOf<Geometry::dim>> joints;
  std::vector<Cut> cuts;  ///< indexed by the labels of the faces
  std::vector<Body<Geometry>> bodies;
  SlicingReport slicing;
  CarvingReport carving;
  std::vector<typename Geometry::Opening> openings;  ///< carved so far
  /// Bodies at the walls that carving dropped. No rock is there: the wall is what lies behind them.
  std::vector<Body<Geometry>> dropped;
  /// Of every body, its number before the last opening was carved, ascending; empty: none was.
  std::vector<int> origins;
};

}  // namespace voussoir
