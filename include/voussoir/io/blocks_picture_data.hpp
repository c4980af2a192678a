// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/drawing/picture_parts.hpp>

namespace voussoir {

// What a picture of the rock around a tunnel is made of: plain values, filled by whoever has them.
// Metres and newtons; world axes x right, y up; everything per metre out of plane.

/// A block where it now lies.
struct PictureBlock {
  std::vector<Vec2> corners;  ///< of a convex polygon [m]
  double displacement = 0;    ///< magnitude [m]; NaN: unknown, drawn grey
  bool is_fallen = false;     ///< left the rock: hatched, and outside the scale of colours
  std::string says = {};      ///< to who points at it; empty: nothing
};

/// A stretch of joint between two blocks.
struct PictureJoint {
  enum class State { closed, slipped, opened };
  Vec2 p = zeros<Vec2>(), q = zeros<Vec2>();  ///< ends [m]
  State state = State::closed;
};

/// Where a bolt crosses a joint.
struct PictureCrossing {
  enum class State { elastic, yielded, ruptured };
  Vec2 point = zeros<Vec2>();  ///< [m]
  double force = 0;            ///< axial, tension positive [N]
  State state = State::elastic;
};

struct PictureBolt {
  Vec2 head = zeros<Vec2>(), tip = zeros<Vec2>();  ///< at the opening, in the rock [m]
  std::vector<PictureCrossing> crossings;          ///< from head to tip
  bool is_elsewhere = false;  ///< in another opening: in no diagram, whose directions are of one
  std::string says = {};      ///< as of blocks
};

struct PictureLiningNode {
  Vec2 point = zeros<Vec2>();           ///< on the axis of the beam [m]
  Vec2 outward_normal = zeros<Vec2>();  ///< towards the rock, unit length
  double thrust = 0;                    ///< N [N/m], compression positive
  double moment = 0;                    ///< M [N m/m], positive: outer fibre in tension
  std::size_t number = 0;               ///< of the node, among those of all linings
  std::string says = {};                ///< as of blocks
};

/// An end of a lining that bears on rock.
struct PictureFoot {
  Vec2 place = zeros<Vec2>(), direction = zeros<Vec2>();  ///< [m]; into the rock, unit length
  double width = 0;                                       ///< [m]
  double bearing = 0;                                     ///< on the rock [N/m]
};

/// A lining, or several of one thickness that go on in one another.
struct PictureLining {
  std::vector<PictureLiningNode> nodes;  ///< in order along the beam
  bool is_ring = true;                   ///< the last node is joined to the first
  double thickness = 0;                  ///< [m]
  std::vector<PictureFoot> feet{};
  bool is_elsewhere = false;  ///< as of bolts
};

/// A force, a moment, or both, on a block.
struct PictureLoad {
  Vec2 at = zeros<Vec2>();     ///< where it acts, on the block as it now lies [m]
  Vec2 force = zeros<Vec2>();  ///< [N/m]
  double moment = 0;           ///< anticlockwise [N]
  std::string says = {};       ///< as of blocks
};

/// All that `draw_blocks_picture` shows.
struct BlocksPicture {
  PictureHeader header;              ///< title, verdict in words, key numbers
  std::vector<PictureBlock> blocks;  ///< or convex parts of blocks
  std::vector<PictureJoint> joints;
  std::vector<Vec2> outline;  ///< of the opening, closed, first point not repeated [m]
  std::vector<std::vector<Vec2>> other_openings{};  ///< excavated before it, the same
  /// Of the tunnel, about which directions are counted [m]; none: the middle of the outline.
  std::optional<Vec2> centre{};
  std::optional<double> ground_surface;  ///< y [m]; none: too far up to matter
  std::vector<PictureBolt> bolts;
  std::vector<PictureLining> linings;
  std::vector<PictureLoad> loads{};
  std::vector<std::vector<Vec2>> fills{};  ///< outlines of holes in the wall that they fill [m]
  /// In-situ stress times radius [N/m]: thrust in linings of less than 1/200 of it, and moments of
  /// such a thrust at the edge of the core of the section, are drawn as small as they are; 0: the
  /// largest value fills the diagram, whatever it is.
  double reference_thrust = 0;
  /// What is seen [m]; none: `view_around_opening`. Made wider or higher to fill its frame.
  std::optional<ViewRect> view;
  bool shows_whole_model = true;             ///< small, beside what is seen
  std::optional<PictureBanner> banner = {};  ///< over the rock; none: a tunnel that stands
};

/// All blocks, the opening and the ground surface, without a margin.
[[nodiscard]] VOUSSOIR_INLINE ViewRect extent_of_everything(const BlocksPicture& picture);

/// The same with a margin, to be drawn.
[[nodiscard]] inline ViewRect view_of_everything(const BlocksPicture& picture) {
  const ViewRect rect = extent_of_everything(picture);
  return rect.grown(1e-3 + 0.01 * std::max(rect.width(), rect.height()));
}

/// From where directions are counted [m].
[[nodiscard]] inline Vec2 centre_of(const BlocksPicture& picture) {
  if (picture.centre) return *picture.centre;
  return bounding_rect(picture.outline).value_or(view_of_everything(picture)).centre();
}

/// Three diameters (or what is asked) of rock, the openings in the middle.
/// @return  the whole model if there is no opening
[[nodiscard]] inline ViewRect view_around_opening(const BlocksPicture& picture,
                                                  double diameters = 3) {
  std::vector<Vec2> corners = picture.outline;
  for (const std::vector<Vec2>& other : picture.other_openings)
    corners.insert(corners.end(), other.begin(), other.end());
  const std::optional<ViewRect> opening = bounding_rect(corners);
  if (!opening) return view_of_everything(picture);
  const double half = std::max(opening->width(), opening->height()) * diameters / 2;
  // Where that is more than there is, as around twin tunnels, all that there is in the middle.
  const ViewRect all = view_of_everything(picture);
  Vec2 centre = opening->centre();
  for (int k = 0; k < 2; ++k)
    if (2 * half > all.high[k] - all.low[k]) centre[k] = all.centre()[k];
  const double seen =
      std::min(half, 0.5 * std::max(std::max(all.width(), all.height()), opening->width()));
  return {centre - Vec2::Constant(seen), centre + Vec2::Constant(seen)};
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE ViewRect extent_of_everything(const BlocksPicture& picture) {
  std::vector<Vec2> points = picture.outline;
  for (const PictureBlock& block : picture.blocks) {
    if (block.is_fallen) continue;  // may be anywhere
    points.insert(points.end(), block.corners.begin(), block.corners.end());
  }
  for (const PictureBolt& bolt : picture.bolts) {
    points.push_back(bolt.head);
    points.push_back(bolt.tip);
  }
  for (const PictureJoint& joint : picture.joints) {
    points.push_back(joint.p);
    points.push_back(joint.q);
  }
  ViewRect rect = bounding_rect(points).value_or(ViewRect{{-1, -1}, {1, 1}});
  if (picture.ground_surface && !points.empty()) {
    rect.high.y() = std::max(rect.high.y(), *picture.ground_surface);
  }
  return rect;
}

#endif

}  // namespace voussoir
