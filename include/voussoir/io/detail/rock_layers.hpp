// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/drawing/colour_map.hpp>
#include <voussoir/drawing/round_ticks.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/blocks_picture_data.hpp>

namespace voussoir::detail {

// The rock of a blocks picture, layer by layer. Black and strong colours only on top of the pale
// map of displacements, and every pair told apart by shape or width too: it prints in grey.
inline constexpr const char* slipped_colour = "#d7261e";
inline constexpr const char* opened_colour = "#6a1b9a";
inline constexpr const char* fallen_colour = "#8c2d04";
inline constexpr const char* foot_colour = "#0b5d3b";
inline constexpr const char* filled_colour = "#c3c9ce";

/// Colours of displacement in steps, each of which is one path in the file.
class DisplacementScale {
 public:
  static constexpr int step_count = 40;

  /// The scale ends where 98 % of the standing blocks are below: one loosened wedge must not paint
  /// everything else in a single colour. `is_cut` says that some are beyond.
  explicit DisplacementScale(const std::vector<PictureBlock>& blocks) {
    std::vector<double> values;
    for (const PictureBlock& block : blocks) {
      if (!block.is_fallen && std::isfinite(block.displacement)) {
        values.push_back(block.displacement);
      }
    }
    is_empty_ = values.empty();
    if (is_empty_) return;
    std::sort(values.begin(), values.end());
    const double typical =
        values[static_cast<std::size_t>(0.98 * static_cast<double>(values.size() - 1))];
    is_cut_ = values.back() > 1.6 * typical && typical > 0;
    const double reach = is_cut_ ? typical : values.back();
    const RoundTicks ticks = round_ticks(0, reach, 8);  // the end is a round number too
    top_ = reach > 0 ? ticks.step * std::ceil(reach / ticks.step - 1e-9) : 1e-3;
  }

  [[nodiscard]] double top() const { return top_; }  ///< [m]
  [[nodiscard]] bool is_cut() const { return is_cut_; }
  /// No block has a displacement: nothing has been computed.
  [[nodiscard]] bool is_empty() const { return is_empty_; }
  /// @return  0 to step_count - 1; step_count for NaN
  [[nodiscard]] int step(double displacement) const {
    if (!std::isfinite(displacement)) return step_count;
    return std::clamp(static_cast<int>(std::min(displacement / top_, 1.0) * step_count), 0,
                      step_count - 1);
  }
  [[nodiscard]] std::string colour(int step) const {
    static const ColourMap map = ColourMap::straw_to_blue();
    if (step >= step_count) return is_empty_ ? "#f1eee3" : "#bdbdbd";
    return map((step + 0.5) / step_count).hex();
  }

 private:
  double top_ = 1e-3;
  bool is_cut_ = false, is_empty_ = false;
};

inline bool is_drawable(const PictureBlock& block) {
  return block.corners.size() >= 3 && std::all_of(block.corners.begin(), block.corners.end(),
                                                  [](const Vec2& p) { return p.allFinite(); });
}

/// @param edge_width  of the outlines [px]; 0: outlines in the colour of the block
/// @param decimals    of a px in the file
VOUSSOIR_INLINE void draw_blocks(SvgCanvas& canvas, const BlocksPicture& picture,
                                 const PageMap& map, const DisplacementScale& scale,
                                 double edge_width, int decimals);

VOUSSOIR_INLINE void draw_fallen_blocks(SvgCanvas& canvas, const BlocksPicture& picture,
                                        const PageMap& map);

/// Closed joints are the outlines of the blocks already; drawn only where there are no blocks.
VOUSSOIR_INLINE void draw_joints(SvgCanvas& canvas, const BlocksPicture& picture,
                                 const PageMap& map, double width);

VOUSSOIR_INLINE void draw_lining(SvgCanvas& canvas, const PictureLining& lining,
                                 const PageMap& map);

/// A bar under the end of a lining, with the strokes of what it bears on.
/// @param place  [px];  @param direction  on the page, into the rock;  @param half  of its width
VOUSSOIR_INLINE void draw_foot(SvgCanvas& canvas, const Vec2& place, const Vec2& direction,
                               double half);

/// Line of the ground with the strokes that say "earth below".
VOUSSOIR_INLINE void draw_ground(SvgCanvas& canvas, double y, const PageMap& map,
                                 double stroke_length);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void draw_blocks(SvgCanvas& canvas, const BlocksPicture& picture,
                                 const PageMap& map, const DisplacementScale& scale,
                                 double edge_width, int decimals) {
  std::vector<SvgPath> paths(DisplacementScale::step_count + 1, SvgPath(decimals));
  for (const PictureBlock& block : picture.blocks) {
    if (block.is_fallen || !is_drawable(block)) continue;
    const std::vector<Vec2> visible = clip_polygon(block.corners, map.world());
    paths[static_cast<std::size_t>(scale.step(block.displacement))].add_polygon(
        on_page(visible, map));
  }
  for (int step = 0; step <= DisplacementScale::step_count; ++step) {
    const std::string fill = scale.colour(step);
    canvas.path(paths[static_cast<std::size_t>(step)],
                {.fill = fill,
                 .stroke = edge_width > 0 ? "#5c6670" : fill,  // own colour: no white hairlines
                 .stroke_width = edge_width > 0 ? edge_width : 0.4});
  }
}

VOUSSOIR_INLINE void draw_fallen_blocks(SvgCanvas& canvas, const BlocksPicture& picture,
                                        const PageMap& map) {
  SvgPath path;
  for (const PictureBlock& block : picture.blocks) {
    if (block.is_fallen && is_drawable(block)) {
      path.add_polygon(on_page(clip_polygon(block.corners, map.world()), map));
    }
  }
  canvas.path(path, {.fill = "white"});
  canvas.path(path, {.fill = "url(#hatch)", .stroke = fallen_colour, .stroke_width = 1.3});
}

VOUSSOIR_INLINE void draw_joints(SvgCanvas& canvas, const BlocksPicture& picture,
                                 const PageMap& map, double width) {
  std::array<SvgPath, 3> paths;
  for (const PictureJoint& joint : picture.joints) {
    if (!joint.p.allFinite() || !joint.q.allFinite()) continue;
    if (joint.state == PictureJoint::State::closed && !picture.blocks.empty()) continue;
    if (const auto visible = clip_segment(joint.p, joint.q, map.world())) {
      paths[static_cast<std::size_t>(joint.state)].add_line(map(visible->first),
                                                            map(visible->second));
    }
  }
  canvas.path(paths[0], {.stroke = "#5c6670", .stroke_width = 0.5});
  canvas.path(paths[1], {.stroke = slipped_colour, .stroke_width = width, .round_ends = true});
  canvas.path(paths[2], {.stroke = opened_colour, .stroke_width = 1.8 * width, .round_ends = true});
}

VOUSSOIR_INLINE void draw_lining(SvgCanvas& canvas, const PictureLining& lining,
                                 const PageMap& map) {
  // True to scale, but never thinner than is seen: 5 cm of shotcrete would be one px.
  const double half = std::max(lining.thickness, 3.5 / map.scale()) / 2;
  std::vector<Vec2> inner, outer;
  for (const PictureLiningNode& node : lining.nodes) {
    if (!node.point.allFinite() || !node.outward_normal.allFinite()) continue;
    inner.push_back(node.point - half * node.outward_normal);
    outer.push_back(node.point + half * node.outward_normal);
  }
  if (inner.size() < 2) return;
  const SvgStyle concrete{.fill = "#9aa3ab", .stroke = "#222"};
  for (const PictureFoot& foot : lining.feet) {
    if (!foot.place.allFinite() || !foot.direction.allFinite()) continue;
    // From the node at that end, which is half a stretch before it.
    const Vec2 front = 0.5 * (inner.front() + outer.front()),
               back = 0.5 * (inner.back() + outer.back());
    const bool is_front = length_of(front - foot.place) < length_of(back - foot.place);
    const Vec2& from_outer = is_front ? outer.front() : outer.back();
    const Vec2& from_inner = is_front ? inner.front() : inner.back();
    Vec2 across = half * perpendicular(foot.direction);
    if (dot_product(across, Vec2(from_outer - from_inner)) < 0) across = -across;
    const std::vector<Vec2> stem = {from_inner, from_outer, foot.place + across,
                                    foot.place - across};
    canvas.polygon(on_page(stem, map), concrete);
  }
  SvgPath band;
  std::reverse(inner.begin(), inner.end());  // a ring's inner side turns the other way: a hole
  if (lining.is_ring) {
    band.add_polygon(on_page(outer, map));
    band.add_polygon(on_page(inner, map));
  } else {
    outer.insert(outer.end(), inner.begin(), inner.end());
    band.add_polygon(on_page(outer, map));
  }
  canvas.path(band, concrete);
  for (const PictureFoot& foot : lining.feet) {
    if (!foot.place.allFinite() || !foot.direction.allFinite()) continue;
    const double across = std::max(foot.width, 10 / map.scale()) / 2;
    draw_foot(canvas, map(foot.place), map(foot.place + foot.direction) - map(foot.place),
              across * map.scale());
  }
}

VOUSSOIR_INLINE void draw_foot(SvgCanvas& canvas, const Vec2& place, const Vec2& direction,
                               double half) {
  const Vec2 into = normalized(direction), along = perpendicular(into);
  SvgPath rock;
  for (const double at : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    const Vec2 from = place + at * half * along;
    rock.add_line(from, from + 5 * into - 3 * along);
  }
  canvas.path(rock, {.stroke = foot_colour});
  canvas.line(place - half * along, place + half * along,
              {.stroke = foot_colour, .stroke_width = 3.2});
}

VOUSSOIR_INLINE void draw_ground(SvgCanvas& canvas, double y, const PageMap& map,
                                 double stroke_length) {
  const ViewRect& world = map.world();
  if (y < world.low.y() || y > world.high.y()) return;
  const Vec2 left = map({world.low.x(), y}), right = map({world.high.x(), y});
  SvgPath strokes;
  for (double x = left.x() + 2 * stroke_length; x < right.x(); x += 2.5 * stroke_length) {
    strokes.add_line({x, left.y()}, {x - stroke_length, left.y() + stroke_length});
  }
  canvas.line(left, right, {.stroke = "#3e2a14", .stroke_width = 2});
  canvas.path(strokes, {.stroke = "#3e2a14"});
}

#endif

}  // namespace voussoir::detail
