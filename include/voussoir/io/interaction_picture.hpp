// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/round_ticks.hpp>
#include <voussoir/io/detail/contour_panel.hpp>
#include <voussoir/io/detail/interaction_panel.hpp>
#include <voussoir/io/interaction_picture_data.hpp>

namespace voussoir {

namespace detail {

/// One box a band, with its limits as on contours and as at points.
VOUSSOIR_INLINE void draw_band_bar(SvgCanvas& canvas, const ViewRect& bar,
                                   const ContourBands& bands, const InteractionQuantity& shown);

/// @param panel  of thicknesses > 0
VOUSSOIR_INLINE void draw_thickness_axes(SvgCanvas& canvas, const InteractionPicture& picture,
                                         const InteractionPanel& panel, double top, double bottom);

/// Two slanting strokes: the axis is interrupted here.
/// @param is_across  it is one from left to right
inline void draw_axis_break(SvgCanvas& canvas, const Vec2& at, bool is_across) {
  for (const double shift : {-3.0, 3.0}) {
    const Vec2 middle = at + (is_across ? Vec2(shift, 0) : Vec2(0, shift)),
               half = is_across ? Vec2(3, -6) : Vec2(6, -3);
    canvas.line(middle - half, middle + half, {.stroke = "#111"});
  }
}

}  // namespace detail

/// Bolt spacing against lining thickness with contours of the crown convergence in % of the radius
/// a = D / 2 (Boon et al. 2015, Fig. 24), or of another quantity. The row without bolts and the
/// column without lining lie beyond a break of their axis, and no contour leads there. Contours run
/// through smoothed values (see `refined`); the numbers at the points are the computed ones. Levels
/// are round numbers.
///
/// @return  an SVG document, 190 mm wide
/// @throws InvalidInput  fewer than 2 x 2 points, axes that do not ascend, tables of another size,
///                       diameter not > 0
[[nodiscard]] VOUSSOIR_INLINE std::string draw_interaction_picture(
    const InteractionPicture& picture);

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE void draw_band_bar(SvgCanvas& canvas, const ViewRect& bar,
                                   const ContourBands& bands, const InteractionQuantity& shown) {
  const double step = bar.height() / static_cast<double>(bands.count());
  canvas.begin_layer("colour-bar");
  for (std::size_t band = 0; band < bands.count(); ++band) {
    const double low = bar.high.y() - step * static_cast<double>(band);
    canvas.rectangle({{bar.low.x(), low - step}, {bar.high.x(), low}},
                     {.fill = bands.colour(band), .stroke = "#1d3b53", .stroke_width = 0.8});
  }
  for (std::size_t k = 0; k < bands.levels().size(); ++k) {
    const double y = bar.high.y() - step * static_cast<double>(k) + 4.5, level = bands.levels()[k];
    if (!shown.has_one_unit())
      canvas.text({bar.low.x() - 6, y}, trimmed_text(level, 6), {.anchor = TextAnchor::end});
    canvas.text({bar.high.x() + 6, y},
                trimmed_text(level / shown.contour_scale * shown.point_scale, 3));
  }
  if (!shown.has_one_unit())
    canvas.text({bar.low.x() - 6, bar.low.y() - 14}, shown.contour_unit,
                {.anchor = TextAnchor::end, .bold = true});
  canvas.text({bar.high.x() + 6, bar.low.y() - 14}, shown.point_unit, {.bold = true});
  canvas.end_layer();
}

VOUSSOIR_INLINE void draw_thickness_axes(SvgCanvas& canvas, const InteractionPicture& picture,
                                         const InteractionPanel& panel, double top, double bottom) {
  const PageMap map = panel.map();
  const double diameter = picture.diameter;
  const TextStyle title{.size = 14.5, .anchor = TextAnchor::middle};
  const double middle = panel.page.centre().x();
  canvas.text({middle, bottom + 42}, "lining thickness t [cm]", title);
  canvas.text({middle, top - 30}, "lining thickness over diameter t / D", title);
  if (panel.is_column()) {  // one thickness has no scale
    const double thickness = picture.thicknesses[panel.columns[0]];
    canvas.text({middle, bottom + 20}, trimmed_text(100 * thickness, 3),
                {.anchor = TextAnchor::middle});
    canvas.text({middle, top - 10}, trimmed_text(thickness / diameter, 4),
                {.anchor = TextAnchor::middle});
    return;
  }
  const double low = std::max(0.0, map.world().low.x()), high = map.world().high.x();
  const RoundTicks cm = round_ticks(low * 100, high * 100, 10);
  const RoundTicks ratio = round_ticks(low / diameter, high / diameter, 8);
  for (const double value : cm.values) {
    const double x = map({value / 100, 0}).x();
    canvas.line({x, bottom}, {x, bottom + 5}, {.stroke = "#111"});
    canvas.text({x, bottom + 20}, cm.label(value), {.anchor = TextAnchor::middle});
  }
  for (const double value : ratio.values) {
    const double x = map({value * diameter, 0}).x();
    canvas.line({x, top - 5}, {x, top}, {.stroke = "#111"});
    canvas.text({x, top - 10}, ratio.label(value), {.anchor = TextAnchor::middle});
  }
}

}  // namespace detail

VOUSSOIR_INLINE std::string draw_interaction_picture(const InteractionPicture& picture) {
  using namespace detail;
  check_interaction(picture);
  const InteractionQuantity shown = picture.shown();
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  bool any_missing = false, any_failed = false, any_shedding = false, any_undecided = false;
  bool any_marginal = false;
  for (std::size_t i = 0; i < picture.thicknesses.size(); ++i) {
    for (std::size_t j = 0; j < picture.spacings.size(); ++j) {
      const double value = picture.at(i, j) * shown.contour_scale;
      any_shedding = any_shedding || picture.is_shedding(i, j);
      any_failed = any_failed || (picture.is_failed(i, j) && !picture.is_shedding(i, j));
      any_marginal = any_marginal || picture.is_marginal(i, j);
      any_undecided = any_undecided || picture.is_undecided(i, j);
      any_missing =
          any_missing || picture.is_assumed(i, j) ||
          (!std::isfinite(value) && !picture.is_failed(i, j) && !picture.is_undecided(i, j));
      if (!std::isfinite(value)) continue;
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  const ContourBands bands(contour_levels(lowest, highest, 12));

  // From the top: header, axis of t / D, the row without bolts, the rest, axis in cm, legend.
  const double left = 112, right = 826, strip_height = 62, strip_width = 74, gap = 16;
  std::vector<std::size_t> spaced;
  for (std::size_t j = 0; j < picture.spacings.size(); ++j) {
    if (picture.spacings[j].value) spaced.push_back(j);
  }
  const bool has_row_without = spaced.size() < picture.spacings.size();
  const double banner_room = picture.banner ? PictureBanner::height + 12 : 0;
  const double top = picture.header.height() + banner_room + 58;
  const double main_top = has_row_without ? top + strip_height + gap : top;
  const double bottom = main_top + (spaced.size() > 1 ? 440 : strip_height);
  std::vector<std::size_t> lined;
  for (std::size_t i = 0; i < picture.thicknesses.size(); ++i)
    if (picture.thicknesses[i] > 0) lined.push_back(i);
  const bool has_column_without = lined.size() < picture.thicknesses.size();
  const double main_left = has_column_without ? left + strip_width + gap : left;
  std::vector<InteractionPanel> panels;
  const auto add = [&](const std::vector<std::size_t>& columns, double from, double to) {
    panels.push_back(interaction_panel(picture, columns, spaced, {{from, main_top}, {to, bottom}}));
    panels.back().has_labels = from == left;
    if (!has_row_without) return;
    panels.push_back(interaction_panel(picture, columns, {picture.spacings.size() - 1},
                                       {{from, top}, {to, top + strip_height}}));
    panels.back().has_labels = from == left;
  };
  add(lined, main_left, right);
  if (has_column_without) add({0}, left, left + strip_width);
  std::vector<LegendItem> items = {
      {picture.computed_name + ", " + shown.point_unit,
       [](SvgCanvas& canvas, const Vec2& c) { canvas.circle(c, 3, {.fill = "#111"}); }}};
  if (any_shedding) items.push_back({"rock falls, the rest stands", draw_shedding_mark});
  if (any_failed)
    items.push_back(
        {picture.collapsed.size() > 0 ? "collapse" : picture.failed_name, draw_failed_mark});
  if (any_marginal) items.push_back({"marginal: limits and rates decide", draw_marginal_mark});
  if (any_undecided) items.push_back({"undecided: no result", draw_undecided_mark});
  if (any_missing) items.push_back({"not computed", draw_missing_mark});
  if (picture.chosen) items.push_back({"recommended", draw_chosen_mark});
  if (!picture.others.empty()) items.push_back({picture.others_name, draw_other_mark});
  items.push_back({shown.name + ", " + shown.contour_unit, [](SvgCanvas& canvas, const Vec2& c) {
                     canvas.line(c - Vec2(12, 0), c + Vec2(12, 0),
                                 {.stroke = "#1d3b53", .stroke_width = 1.1});
                   }});
  const Legend legend(std::move(items), right - left + 120);

  SvgCanvas canvas(picture_width, bottom + 64 + legend.height() + 14, picture_printed_width,
                   picture.header.title);
  picture.header.draw(canvas);
  if (picture.banner) {
    const double y = picture.header.height() + 2;
    picture.banner->draw(
        canvas, {{picture_margin, y}, {picture_width - picture_margin, y + PictureBanner::height}},
        y);
  }
  for (const InteractionPanel& panel : panels)
    draw_interaction_panel(canvas, picture, panel, bands);
  draw_thickness_axes(canvas, picture, panels[0], top, bottom);
  canvas.begin_spots();
  for (const InteractionPanel& panel : panels)
    for (const InteractionPanel::Point& point : panel.points())
      canvas.spot(point.at - Vec2(9, 0), point.at + Vec2(9, 0), 18,
                  words_of(picture, point.i, point.j));
  canvas.end_layer();
  if (has_row_without)
    for (const double x : {left, right}) draw_axis_break(canvas, {x, main_top - gap / 2}, false);
  if (has_column_without) {
    for (const double y : {top, bottom}) draw_axis_break(canvas, {main_left - gap / 2, y}, true);
    canvas.text({left + 0.5 * strip_width, bottom + 18}, "no lining",
                {.size = 12, .anchor = TextAnchor::middle});
  }
  canvas.text({30, (main_top + bottom) / 2}, picture.spacing_axis,
              {.size = 14.5, .anchor = TextAnchor::middle, .rotation = -90});
  draw_band_bar(canvas, {{900, top + 30}, {928, bottom}}, bands, shown);
  legend.draw(canvas, {left - 8, bottom + 58});
  return canvas.document();
}

#endif

}  // namespace voussoir
