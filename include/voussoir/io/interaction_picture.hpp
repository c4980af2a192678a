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

VOUSSOIR_INLINE void draw_thickness_axes(SvgCanvas& canvas, const PageMap& map, double top,
                                         double bottom, double diameter);

/// Two slanting strokes: the axis is interrupted here.
inline void draw_axis_break(SvgCanvas& canvas, double x, double y) {
  for (const double shift : {-3.0, 3.0}) {
    canvas.line({x - 6, y + shift + 3}, {x + 6, y + shift - 3}, {.stroke = "#111"});
  }
}

}  // namespace detail

/// Bolt spacing against lining thickness with contours of the crown convergence in % of the radius
/// a = D / 2 (Boon et al. 2015, Fig. 24), or of another quantity. The row without bolts lies above
/// a break of the axis. Contours run through smoothed values (see `refined`); the numbers at the
/// points are the computed ones. Levels are round numbers.
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

VOUSSOIR_INLINE void draw_thickness_axes(SvgCanvas& canvas, const PageMap& map, double top,
                                         double bottom, double diameter) {
  const double low = std::max(0.0, map.world().low.x()), high = map.world().high.x();
  const double middle = map.page().centre().x();
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
  const TextStyle title{.size = 14.5, .anchor = TextAnchor::middle};
  canvas.text({middle, bottom + 42}, "lining thickness t [cm]", title);
  canvas.text({middle, top - 30}, "lining thickness over diameter t / D", title);
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
      any_missing = any_missing || (!std::isfinite(value) && !picture.is_failed(i, j) &&
                                    !picture.is_undecided(i, j));
      if (!std::isfinite(value)) continue;
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  const ContourBands bands(contour_levels(lowest, highest, 12));

  // From the top: header, axis of t / D, the row without bolts, the rest, axis in cm, legend.
  const double left = 112, right = 826, strip_height = 62, gap = 16;
  std::vector<std::size_t> spaced;
  for (std::size_t j = 0; j < picture.spacings.size(); ++j) {
    if (picture.spacings[j].value) spaced.push_back(j);
  }
  const bool has_row_without = spaced.size() < picture.spacings.size();
  const double banner_room = picture.banner ? PictureBanner::height + 12 : 0;
  const double top = picture.header.height() + banner_room + 58;
  const double main_top = has_row_without ? top + strip_height + gap : top;
  const double bottom = main_top + (spaced.size() > 1 ? 440 : strip_height);
  std::vector<InteractionPanel> panels;
  panels.push_back(interaction_panel(picture, spaced, {{left, main_top}, {right, bottom}}));
  if (has_row_without) {
    panels.push_back(interaction_panel(picture, {picture.spacings.size() - 1},
                                       {{left, top}, {right, top + strip_height}}));
  }
  std::vector<LegendItem> items = {
      {"computed, " + shown.point_unit,
       [](SvgCanvas& canvas, const Vec2& c) { canvas.circle(c, 3, {.fill = "#111"}); }}};
  if (any_shedding) items.push_back({"rock falls, the rest stands", draw_shedding_mark});
  if (any_failed)
    items.push_back(
        {picture.collapsed.size() > 0 ? "collapse" : "blocks detach", draw_failed_mark});
  if (any_marginal) items.push_back({"marginal: limits and rates decide", draw_marginal_mark});
  if (any_undecided) items.push_back({"undecided: no result", draw_undecided_mark});
  if (any_missing) items.push_back({"not computed", draw_missing_mark});
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
  draw_thickness_axes(canvas, panels[0].map(), top, bottom, picture.diameter);
  canvas.begin_spots();
  for (const InteractionPanel& panel : panels)
    for (std::size_t k = 0; k < panel.rows.size(); ++k)
      for (std::size_t i = 0; i < picture.thicknesses.size(); ++i) {
        const Vec2 at = panel.map()({picture.thicknesses[i], panel.row_y(k)});
        canvas.spot(at - Vec2(9, 0), at + Vec2(9, 0), 18, words_of(picture, i, panel.rows[k]));
      }
  canvas.end_layer();
  if (has_row_without) {
    draw_axis_break(canvas, left, main_top - gap / 2);
    draw_axis_break(canvas, right, main_top - gap / 2);
  }
  canvas.text({30, (main_top + bottom) / 2}, picture.spacing_axis,
              {.size = 14.5, .anchor = TextAnchor::middle, .rotation = -90});
  draw_band_bar(canvas, {{900, top + 30}, {928, bottom}}, bands, shown);
  legend.draw(canvas, {left - 8, bottom + 58});
  return canvas.document();
}

#endif

}  // namespace voussoir
