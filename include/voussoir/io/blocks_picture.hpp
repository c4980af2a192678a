// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/blocks_picture_data.hpp>
#include <voussoir/io/detail/bolt_layers.hpp>
#include <voussoir/io/detail/load_layer.hpp>
#include <voussoir/io/detail/rock_layers.hpp>
#include <voussoir/io/detail/side_column.hpp>

namespace voussoir {

namespace detail {

/// Bar of colours with round numbers in mm.
VOUSSOIR_INLINE void draw_displacement_bar(SvgCanvas& canvas, const ViewRect& bar,
                                           const DisplacementScale& scale);

/// Samples of what the picture holds, and of nothing else.
VOUSSOIR_INLINE std::vector<LegendItem> blocks_legend(const BlocksPicture& picture,
                                                      const ForceScale& forces);

VOUSSOIR_INLINE void draw_rock(SvgCanvas& canvas, const BlocksPicture& picture, const PageMap& map,
                               const DisplacementScale& scale, const ForceScale& forces);

/// What blocks, lining and bolts say, bolts on top.
VOUSSOIR_INLINE void draw_spots(SvgCanvas& canvas, const BlocksPicture& picture,
                                const PageMap& map);

}  // namespace detail

/// The page that an engineer's report shows of one calculation: the rock around the opening with
/// displacements, slipped joints, bolts and their forces, lining; beside it thrust and moment
/// around the lining (or the bolts' forces where there is none) and the whole model.
///
/// Where its parts say something, so does the picture, in a browser: to who points at them.
///
/// @return  an SVG document, 190 mm wide; about 80 bytes a block, and as many again for what it
/// says
///
/// Never fails on the values of a calculation gone bad: what has coordinates that are not finite is
/// left out, and the picture says how much that is.
/// @throws InvalidInput  `picture.view` is empty
[[nodiscard]] VOUSSOIR_INLINE std::string draw_blocks_picture(const BlocksPicture& picture);

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE void draw_displacement_bar(SvgCanvas& canvas, const ViewRect& bar,
                                           const DisplacementScale& scale) {
  const PageMap map({{0, 0}, {scale.top() * 1e3, 1}}, bar);
  const double step_width = bar.width() / DisplacementScale::step_count;
  for (int step = 0; step < DisplacementScale::step_count; ++step) {
    const double x = bar.low.x() + step * step_width;  // a little overlap: no hairlines
    canvas.rectangle(
        {{x, bar.low.y()}, {std::min(x + step_width + 0.5, bar.high.x()), bar.high.y()}},
        {.fill = scale.colour(step)});
  }
  canvas.rectangle(bar, {.stroke = "#111", .stroke_width = 0.8});
  const RoundTicks ticks = round_ticks(0, scale.top() * 1e3, 8);
  for (const double value : ticks.values) {
    const Vec2 foot = map({value, 0});
    canvas.line(foot, foot + Vec2(0, 4), {.stroke = "#111"});
    const bool is_last = value > ticks.values.back() - ticks.step / 2;
    canvas.text(foot + Vec2(0, 17), (is_last && scale.is_cut() ? "≥ " : "") + ticks.label(value),
                {.anchor = TextAnchor::middle});
  }
  canvas.text(bar.low - Vec2(0, 6), "displacement of blocks [mm]");
}

VOUSSOIR_INLINE std::vector<LegendItem> blocks_legend(const BlocksPicture& picture,
                                                      const ForceScale& forces) {
  const auto dash = [](const char* colour, double width) {
    return [=](SvgCanvas& canvas, const Vec2& c) {
      canvas.line(c - Vec2(12, 0), c + Vec2(12, 0),
                  {.stroke = colour, .stroke_width = width, .round_ends = true});
    };
  };
  const auto box = [](const char* fill, const char* stroke) {
    return [=](SvgCanvas& canvas, const Vec2& c) {
      canvas.rectangle({c - Vec2(12, 6), c + Vec2(12, 6)},
                       {.fill = fill, .stroke = stroke, .stroke_width = 1.4});
    };
  };
  const auto has_joint = [&](PictureJoint::State state) {
    return std::any_of(picture.joints.begin(), picture.joints.end(),
                       [&](const PictureJoint& joint) { return joint.state == state; });
  };
  const auto has_crossing = [&](PictureCrossing::State state) {
    for (const PictureBolt& bolt : picture.bolts) {
      for (const PictureCrossing& crossing : bolt.crossings) {
        if (crossing.state == state) return true;
      }
    }
    return false;
  };
  std::vector<LegendItem> items;
  if (has_joint(PictureJoint::State::slipped))
    items.push_back({"slipped joint", dash(slipped_colour, 1.7)});
  if (has_joint(PictureJoint::State::opened))
    items.push_back({"opened joint", dash(opened_colour, 3.1)});
  std::vector<std::string> thicknesses;
  double most = -1;
  for (const PictureLining& lining : picture.linings) {
    const std::string text = trimmed_text(lining.thickness * 100, 1);
    if (std::find(thicknesses.begin(), thicknesses.end(), text) == thicknesses.end())
      thicknesses.push_back(text);
    for (const PictureFoot& foot : lining.feet) most = std::max(most, foot.bearing);
  }
  if (!thicknesses.empty()) {
    std::string text = "lining, " + thicknesses.front();
    for (std::size_t k = 1; k < thicknesses.size(); ++k)
      text += (k + 1 < thicknesses.size() ? ", " : " and ") + thicknesses[k];
    items.push_back({text + " cm", box("#9aa3ab", "#222")});
  }
  if (!picture.fills.empty())
    items.push_back({"hole filled with lining", box(filled_colour, filled_colour)});
  if (most >= 0) {
    items.push_back({"foot on rock, up to " + readable_text(most / 1e3) + " kN/m",
                     [](SvgCanvas& canvas, const Vec2& c) {
                       draw_foot(canvas, c - Vec2(0, 3), {0, 1}, 10);
                     }});
  }
  if (std::any_of(picture.blocks.begin(), picture.blocks.end(),
                  [](const PictureBlock& block) { return block.is_fallen; })) {
    items.push_back({"detached block", box("url(#hatch)", fallen_colour)});
  }
  if (!picture.bolts.empty()) items.push_back({"bolt", dash("black", 2)});
  if (forces.sample() > 0) {
    const double length = forces.sample() * forces.px_per_newton();
    items.push_back({"force in bolt, " + readable_text(forces.sample() / 1e3, 1) + " kN",
                     [=](SvgCanvas& canvas, const Vec2& c) {
                       const Vec2 left = c - Vec2(13, 0);
                       canvas.line(left + Vec2(0, -7), left + Vec2(0, 7),
                                   {.stroke = "black", .stroke_width = 2});
                       canvas.line(left, left + Vec2(length, 0),
                                   {.stroke = "black", .stroke_width = 3.4});
                     },
                     std::max(0.0, length - 26)});
  }
  for (const auto& [state, text] : {std::pair{PictureCrossing::State::yielded, "bolt yields"},
                                    std::pair{PictureCrossing::State::ruptured, "bolt ruptured"}}) {
    if (!has_crossing(state)) continue;
    items.push_back({text, [state = state](SvgCanvas& canvas, const Vec2& c) {
                       draw_crossing_state(canvas, c, state);
                     }});
  }
  for (LegendItem& item : loads_legend(picture.loads)) items.push_back(std::move(item));
  return items;
}

VOUSSOIR_INLINE void draw_rock(SvgCanvas& canvas, const BlocksPicture& picture, const PageMap& map,
                               const DisplacementScale& scale, const ForceScale& forces) {
  canvas.clip_rectangle("rock-frame", map.page());
  canvas.begin_layer("rock", "rock-frame");
  canvas.begin_layer("blocks");
  draw_blocks(canvas, picture, map, scale, std::clamp(0.024 * map.scale(), 0.25, 0.5), 2);
  canvas.end_layer();
  canvas.begin_layer("joints");
  draw_joints(canvas, picture, map, std::clamp(0.075 * map.scale(), 0.6, 1.6));
  canvas.end_layer();
  canvas.begin_layer("detached-blocks");
  draw_fallen_blocks(canvas, picture, map);
  canvas.end_layer();
  canvas.begin_layer("opening");
  for (const std::vector<Vec2>& other : picture.other_openings)
    canvas.polygon(on_page(other, map), {.stroke = "#111", .stroke_width = 1.6});
  canvas.polygon(on_page(picture.outline, map), {.stroke = "#111", .stroke_width = 1.6});
  if (picture.ground_surface) draw_ground(canvas, *picture.ground_surface, map, 8);
  canvas.end_layer();
  canvas.begin_layer("lining");
  for (const std::vector<Vec2>& fill : picture.fills)
    canvas.polygon(on_page(clip_polygon(fill, map.world()), map), {.fill = filled_colour});
  for (const PictureLining& lining : picture.linings) draw_lining(canvas, lining, map);
  canvas.end_layer();
  canvas.begin_layer("bolts");
  draw_bolts(canvas, picture, map, forces);
  canvas.end_layer();
  if (!picture.loads.empty()) {
    canvas.begin_layer("loads");
    draw_loads(canvas, picture.loads, map);
    canvas.end_layer();
  }
  canvas.end_layer();
  canvas.rectangle(map.page(), {.stroke = "#111"});
}

VOUSSOIR_INLINE void draw_spots(SvgCanvas& canvas, const BlocksPicture& picture,
                                const PageMap& map) {
  constexpr double lining_width = 10, bolt_width = 8, load_width = 10;  // [px]
  canvas.begin_spots();
  for (const PictureBlock& block : picture.blocks)
    if (!block.says.empty() && is_drawable(block))
      canvas.spot(on_page(clip_polygon(block.corners, map.world()), map), block.says);
  for (const PictureLining& lining : picture.linings) {
    const std::size_t n = lining.nodes.size();
    const auto is_sound = [&](std::size_t k) { return lining.nodes[k].point.allFinite(); };
    for (std::size_t k = 0; k < n; ++k) {
      // From half way to the node before to half way to the one behind.
      const std::size_t before = k > 0 ? k - 1 : (lining.is_ring ? n - 1 : k),
                        behind = k + 1 < n ? k + 1 : (lining.is_ring ? 0 : k);
      if (!is_sound(before) || !is_sound(k) || !is_sound(behind)) continue;
      const auto half_way = [&](std::size_t other) {
        return Vec2(0.5 * (lining.nodes[k].point + lining.nodes[other].point));
      };
      if (const auto seen = clip_segment(half_way(before), half_way(behind), map.world()))
        canvas.spot(map(seen->first), map(seen->second), lining_width, lining.nodes[k].says);
    }
  }
  for (const PictureBolt& bolt : picture.bolts)
    if (is_drawable(bolt))
      if (const auto seen = clip_segment(bolt.head, bolt.tip, map.world()))
        canvas.spot(map(seen->first), map(seen->second), bolt_width, bolt.says);
  const double largest = largest_force(picture.loads);
  for (const PictureLoad& load : picture.loads) {
    if (!is_drawable(load) || !map.world().contains(load.at)) continue;
    if (const auto arrow = arrow_of(load, largest, map))
      canvas.spot(arrow->front(), arrow->back(), load_width, load.says);
    else
      canvas.spot(map(load.at) - Vec2(turn_radius, 0), map(load.at) + Vec2(turn_radius, 0),
                  2 * turn_radius, load.says);
  }
  canvas.end_layer();
}

}  // namespace detail

VOUSSOIR_INLINE std::string draw_blocks_picture(const BlocksPicture& picture) {
  using namespace detail;
  const double left_width = 640;
  const ViewRect wanted = picture.view.value_or(view_around_opening(picture));
  if (!(wanted.width() > 0 && wanted.height() > 0)) {
    throw InvalidInput("draw_blocks_picture: the view needs a positive width and height");
  }
  const double header = picture.header.height();
  const double rock_height =
      std::clamp(left_width * wanted.height() / wanted.width(), 400.0, 640.0);
  const ViewRect rock{{picture_margin, header},
                      {picture_margin + left_width, header + rock_height}};
  const PageMap map = PageMap::equal_scales(wanted, rock);
  const DisplacementScale scale(picture.blocks);
  const ForceScale forces(picture.bolts, map);
  const Legend legend(blocks_legend(picture, forces), left_width);
  const double legend_top = rock.high.y() + 66;
  const auto not_drawn = std::count_if(picture.blocks.begin(), picture.blocks.end(),
                                       [](const auto& block) { return !is_drawable(block); });
  const double height =
      std::max(legend_top + legend.height() + (not_drawn > 0 ? 40 : 16), header + 560);

  SvgCanvas canvas(picture_width, height, picture_printed_width, picture.header.title);
  canvas.hatch_pattern("hatch", fallen_colour, 6, 1.6);
  picture.header.draw(canvas);
  draw_rock(canvas, picture, map, scale, forces);
  draw_spots(canvas, picture, map);
  if (picture.banner) picture.banner->draw(canvas, rock, rock.low.y());
  if (!scale.is_empty())
    draw_displacement_bar(
        canvas, {{rock.low.x() + 4, rock.high.y() + 28}, {rock.low.x() + 324, rock.high.y() + 41}},
        scale);
  draw_scale_bar(canvas, {rock.low.x() + 400, rock.high.y() + 38}, 200, map.scale());
  legend.draw(canvas, {rock.low.x(), legend_top});
  if (not_drawn > 0) {
    canvas.text({rock.low.x(), height - 14},
                "Blocks not drawn, because their coordinates are not finite numbers: " +
                    std::to_string(not_drawn),
                {.bold = true, .fill = "#c00000"});
  }

  draw_side_column(canvas, {{692, header}, {picture_width - picture_margin, height - 10}}, picture,
                   map.world(), scale);
  return canvas.document();
}

#endif

}  // namespace voussoir
