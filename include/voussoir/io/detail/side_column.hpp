// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <voussoir/core/bodies.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/blocks_picture_data.hpp>
#include <voussoir/io/detail/bolt_layers.hpp>
#include <voussoir/io/detail/rock_layers.hpp>
#include <voussoir/io/detail/support_diagrams.hpp>

namespace voussoir::detail {

/// The whole model, small, with the frame of the large picture in it.
VOUSSOIR_INLINE void draw_overview(SvgCanvas& canvas, const ViewRect& frame,
                                   const BlocksPicture& picture, const ViewRect& seen,
                                   const DisplacementScale& scale);

/// Beside the rock: diagrams of the support, and the whole model in the room that is left.
/// @param seen  the part of the world in the large picture [m]
VOUSSOIR_INLINE void draw_side_column(SvgCanvas& canvas, const ViewRect& column,
                                      const BlocksPicture& picture, const ViewRect& seen,
                                      const DisplacementScale& scale);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void draw_overview(SvgCanvas& canvas, const ViewRect& frame,
                                   const BlocksPicture& picture, const ViewRect& seen,
                                   const DisplacementScale& scale) {
  const ViewRect everything = view_of_everything(picture);
  ViewRect drawing{frame.low + Vec2(0, 22), frame.high - Vec2(0, 22)};
  const double ratio = everything.width() / everything.height();
  const Vec2 size = Vec2(std::min(drawing.width(), drawing.height() * ratio),
                         std::min(drawing.height(), drawing.width() / ratio));
  drawing.high = drawing.low + size;
  const PageMap map(everything, drawing);
  canvas.text({frame.low.x(), frame.low.y() + 13}, "Whole model (dashed: view at left)",
              {.size = 14.5, .bold = true});
  canvas.clip_rectangle("overview-frame", drawing);
  canvas.begin_layer("overview", "overview-frame");
  draw_blocks(canvas, picture, map, scale, 0, 1);
  draw_joints(canvas, picture, map, 0.6);
  canvas.polygon(on_page(picture.outline, map), {.stroke = "#111"});
  if (picture.ground_surface) draw_ground(canvas, *picture.ground_surface, map, 4);
  canvas.rectangle({map({seen.low.x(), seen.high.y()}), map({seen.high.x(), seen.low.y()})},
                   {.stroke = "black", .stroke_width = 1.4, .dash = "5 3"});
  canvas.end_layer();
  canvas.rectangle(drawing, {.stroke = "#111"});
  const ViewRect extent = extent_of_everything(picture);
  canvas.text({frame.low.x(), drawing.high.y() + 17}, readable_text(extent.width(), 2) + " m × " +
                                                          readable_text(extent.height(), 2) + " m");
}

VOUSSOIR_INLINE void draw_side_column(SvgCanvas& canvas, const ViewRect& column,
                                      const BlocksPicture& picture, const ViewRect& seen,
                                      const DisplacementScale& scale) {
  const ViewRect everything = view_of_everything(picture);
  const bool has_overview =
      picture.shows_whole_model &&
      seen.width() * seen.height() < 0.8 * everything.width() * everything.height();
  double top = column.low.y();
  const double diagram_height = column.height() * (has_overview ? 0.36 : 0.47);
  const auto next_frame = [&](double height) {
    ViewRect frame{{column.low.x(), top}, {column.high.x(), top + height}};
    top += height + 14;
    return frame;
  };
  canvas.begin_layer("diagrams");
  std::vector<PictureLining> linings;
  for (const PictureLining& lining : picture.linings)
    if (!lining.is_elsewhere) linings.push_back(lining);
  if (std::any_of(linings.begin(), linings.end(),
                  [](const PictureLining& lining) { return lining.nodes.size() >= 2; })) {
    LiningDiagram thrust, moment;
    thrust.title = "Lining thrust N [kN/m]";
    thrust.unit = "kN/m";
    thrust.positive = "compression (+), drawn outside";
    thrust.negative = "tension (\u2212), drawn inside";
    moment.title = "Lining moment M [kN m/m]";
    moment.unit = "kN m/m";
    moment.positive = "outer fibre in tension (+), drawn outside";
    moment.negative = "inner fibre in tension (\u2212), drawn inside";
    // A thrust of no account, and the moment that it has at the edge of the core, t / 6.
    thrust.negligible = 0.005 * picture.reference_thrust / 1e3;
    for (const PictureLining& lining : linings) {
      moment.negligible = std::max(moment.negligible, thrust.negligible * lining.thickness / 6);
      for (const PictureLiningNode& node : lining.nodes) {
        thrust.values.push_back(node.thrust / 1e3);
        moment.values.push_back(node.moment / 1e3);
      }
    }
    thrust.centre = moment.centre = centre_of(picture);
    draw_lining_diagram(canvas, next_frame(diagram_height - 9), linings, thrust);
    draw_lining_diagram(canvas, next_frame(diagram_height + 9), linings, moment);
  } else if (std::any_of(picture.bolts.begin(), picture.bolts.end(), [](const PictureBolt& bolt) {
               return !bolt.is_elsewhere && !bolt.crossings.empty();
             })) {
    draw_bolt_chart(canvas, next_frame(1.25 * diagram_height), picture);
  }
  canvas.end_layer();
  if (has_overview) {
    draw_overview(canvas, next_frame(column.high.y() - top), picture, seen, scale);
  }
}

#endif

}  // namespace voussoir::detail
