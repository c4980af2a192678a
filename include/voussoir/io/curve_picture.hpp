// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/round_ticks.hpp>
#include <voussoir/drawing/svg.hpp>

namespace voussoir {

/// Points, joined by straight lines unless these are left out.
struct Curve {
  std::string name;  ///< for the legend
  std::vector<Vec2> points;
  std::string colour = "#1f4e79";
  std::string dash = {};  ///< see `SvgStyle::dash`
  bool is_marked = true;  ///< a dot at each point
  bool is_joined = true;
};

/// Curves over one pair of axes.
struct CurvePicture {
  PictureHeader header;
  std::string across, up;  ///< names of the axes with their units
  std::vector<Curve> curves;
  bool begins_at_zero = true;  ///< both axes have zero on them
};

/// @return  an SVG document, 190 mm wide
/// @throws InvalidInput  no point, or one that is not finite
[[nodiscard]] VOUSSOIR_INLINE std::string draw_curve_picture(const CurvePicture& picture);

#if VOUSSOIR_BODIES

namespace detail {

/// What the axes span: all points and, if asked for, zero, with room at the upper ends.
[[nodiscard]] VOUSSOIR_INLINE ViewRect span_of(const CurvePicture& picture) {
  std::vector<Vec2> points;
  for (const Curve& curve : picture.curves)
    points.insert(points.end(), curve.points.begin(), curve.points.end());
  if (points.empty()) throw InvalidInput("curve picture: needs at least one point");
  for (const Vec2& p : points)
    require(std::isfinite(p.x()) && std::isfinite(p.y()), "point of a curve",
            std::isfinite(p.x()) ? p.y() : p.x(), "finite");
  if (picture.begins_at_zero) points.push_back(zeros<Vec2>());
  ViewRect span = *bounding_rect(points);
  for (int k = 0; k < 2; ++k) {
    double size = span.high[k] - span.low[k];
    if (!(size > 0)) size = std::max(std::abs(span.high[k]), 1.0);
    span.high[k] += 0.06 * size;
    if (span.low[k] < 0 || !picture.begins_at_zero) span.low[k] -= 0.06 * size;
  }
  return span;
}

VOUSSOIR_INLINE void draw_axes(SvgCanvas& canvas, const CurvePicture& picture, const PageMap& map,
                               const ViewRect& frame) {
  const ViewRect& world = map.world();
  const RoundTicks across = round_ticks(world.low.x(), world.high.x(), 8),
                   up = round_ticks(world.low.y(), world.high.y(), 6);
  for (const double value : across.values) {
    const double x = map({value, world.low.y()}).x();
    canvas.line({x, frame.low.y()}, {x, frame.high.y()}, {.stroke = "#ddd", .stroke_width = 0.6});
    canvas.text({x, frame.high.y() + 20}, across.label(value), {.anchor = TextAnchor::middle});
  }
  for (const double value : up.values) {
    const double y = map({world.low.x(), value}).y();
    canvas.line({frame.low.x(), y}, {frame.high.x(), y}, {.stroke = "#ddd", .stroke_width = 0.6});
    canvas.text({frame.low.x() - 6, y + 4.5}, up.label(value), {.anchor = TextAnchor::end});
  }
  canvas.rectangle(frame, {.stroke = "#111"});
  canvas.text({frame.centre().x(), frame.high.y() + 42}, picture.across,
              {.size = 14.5, .anchor = TextAnchor::middle});
  canvas.text({frame.low.x() - 50, frame.centre().y()}, picture.up,
              {.size = 14.5, .anchor = TextAnchor::middle, .rotation = -90});
}

}  // namespace detail

VOUSSOIR_INLINE std::string draw_curve_picture(const CurvePicture& picture) {
  constexpr double left = 78, height = 380;
  std::vector<LegendItem> items;
  for (const Curve& curve : picture.curves)
    items.push_back({curve.name, [curve](SvgCanvas& c, const Vec2& at) {
                       if (curve.is_joined)
                         c.line(at - Vec2(12, 0), at + Vec2(12, 0),
                                {.stroke = curve.colour, .stroke_width = 2, .dash = curve.dash});
                       if (curve.is_marked) c.circle(at, 3.2, {.fill = curve.colour});
                     }});
  const Legend legend(items, picture_width - 2 * picture_margin);
  const double top = picture.header.height() + 20, bottom = top + height;
  const PageMap map(detail::span_of(picture),
                    {{left, top}, {picture_width - picture_margin, bottom}});
  SvgCanvas canvas(picture_width, bottom + 60 + legend.height(), picture_printed_width,
                   picture.header.title);
  picture.header.draw(canvas);
  canvas.begin_layer("axes");
  detail::draw_axes(canvas, picture, map, {{left, top}, {picture_width - picture_margin, bottom}});
  canvas.end_layer();
  for (const Curve& curve : picture.curves) {
    canvas.begin_layer(curve.name);
    std::vector<Vec2> points;
    for (const Vec2& p : curve.points) points.push_back(map(p));
    if (curve.is_joined)
      canvas.polyline(points, {.stroke = curve.colour, .stroke_width = 2, .dash = curve.dash});
    if (curve.is_marked)
      for (const Vec2& p : points) canvas.circle(p, 3.2, {.fill = curve.colour});
    canvas.end_layer();
  }
  legend.draw(canvas, {picture_margin, bottom + 54});
  return canvas.document();
}

#endif

}  // namespace voussoir
