// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/round_ticks.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/statistics/confidence.hpp>
#include <voussoir/statistics/goodness_of_fit.hpp>
#include <voussoir/statistics/sample.hpp>

namespace voussoir {

/// One quantity over the realisations of the rock.
struct DistributionPanel {
  std::string name;                           ///< "crown convergence"
  std::string unit;                           ///< "mm"
  std::vector<double> values;                 ///< in that unit, finite
  std::size_t realisations = 0;               ///< all, those without a value too
  std::optional<Interval> mean_between = {};  ///< confidence interval of the mean
  std::optional<double> limit = {};           ///< that it should keep
  std::string note = {};                      ///< under the axis: realisations without a value
};

/// How strongly keys of the input decide one quantity.
struct InfluencePanel {
  std::string name;                  ///< "crown convergence"
  std::vector<std::string> keys;     ///< from above
  std::vector<double> correlations;  ///< rank correlation of each, -1 to 1; not a number: none
  double limit = 0;                  ///< what chance alone does not exceed
};

/// Empirical distributions side by side, two in a row, and below them what decides them.
struct DistributionPicture {
  PictureHeader header;
  std::vector<DistributionPanel> panels;
  std::vector<InfluencePanel> influences = {};
};

namespace detail {

inline constexpr const char* band_colour = "#d7e4f0";
inline constexpr const char* step_colour = "#2c5f8a";
inline constexpr const char* mean_colour = "#b3541e";
inline constexpr const char* mean_band_colour = "#f2d7b6";
inline constexpr const char* limit_colour = "#c8102e";

inline void draw_panel_title(SvgCanvas& canvas, const std::string& title, const ViewRect& frame) {
  canvas.text({frame.low.x(), frame.low.y() - 12}, title, {.size = 14.5, .bold = true});
}

inline void draw_axis_across(SvgCanvas& canvas, const PageMap& map, const ViewRect& frame) {
  canvas.line({frame.low.x(), frame.high.y()}, frame.high, {.stroke = "#111"});
  const RoundTicks across = round_ticks(map.world().low.x(), map.world().high.x(), 6);
  for (const double value : across.values) {
    const double x = map({value, 0}).x();
    canvas.line({x, frame.high.y()}, {x, frame.high.y() + 5}, {.stroke = "#111"});
    canvas.text({x, frame.high.y() + 20}, across.label(value), {.anchor = TextAnchor::middle});
  }
}

/// The part of all realisations with at most a value [%], and the band in which it lies.
inline void draw_distribution(SvgCanvas& canvas, const DistributionPanel& panel,
                              const ViewRect& frame) {
  draw_panel_title(canvas, panel.name + (panel.unit.empty() ? "" : " [" + panel.unit + "]"), frame);
  if (panel.values.empty()) {
    canvas.text(frame.centre(), "no realisation has a value",
                {.size = 14.5, .anchor = TextAnchor::middle});
    return;
  }
  const Sample sample(panel.values);
  const double total = static_cast<double>(std::max(panel.realisations, sample.size())),
               band = distribution_band(static_cast<std::size_t>(total));
  double low = sample.smallest(), high = sample.largest();
  // Of one value, or of equal ones, something about them.
  const double spread = high > low ? high - low : std::max(0.1 * std::abs(high), 1e-9);
  // A limit far beyond would press all values into a corner: it is said below.
  const bool shows_limit =
      panel.limit && *panel.limit > low - 2 * spread && *panel.limit < high + 2 * spread;
  if (shows_limit) {
    low = std::min(low, *panel.limit);
    high = std::max(high, *panel.limit);
  }
  const PageMap map({{low - 0.06 * spread, 0}, {high + 0.06 * spread, 104}}, frame);
  const double left = map.world().low.x(), right = map.world().high.x();
  // Corners of the steps, from the left.
  std::vector<Vec2> steps{{left, 0}}, upper{{left, 100 * std::min(1.0, band)}}, lower{{left, 0}};
  for (std::size_t k = 0; k <= sample.size(); ++k) {
    const double x = k < sample.size() ? sample.values()[k] : right;
    const double above = static_cast<double>(std::min(k + 1, sample.size())) / total;
    const auto corner = [&](std::vector<Vec2>& line, double share) {
      line.push_back({x, line.back().y()});
      line.push_back({x, 100 * std::clamp(share, 0.0, 1.0)});
    };
    corner(steps, above);
    corner(upper, above + band);
    corner(lower, above - band);
  }
  const auto on_page = [&](std::vector<Vec2> line) {
    for (Vec2& p : line) p = map(p);
    return line;
  };
  std::vector<Vec2> outline = upper;
  outline.insert(outline.end(), lower.rbegin(), lower.rend());
  canvas.polygon(on_page(outline), {.fill = band_colour, .opacity = 0.75});
  for (const int percent : {0, 25, 50, 75, 90, 100}) {
    const double y = map({left, static_cast<double>(percent)}).y();
    canvas.line({frame.low.x(), y}, {frame.high.x(), y}, {.stroke = "#ccc", .stroke_width = 0.6});
    canvas.text({frame.low.x() - 6, y + 4.5}, std::to_string(percent), {.anchor = TextAnchor::end});
  }
  // On the axis: over the full height it would hide the band.
  if (panel.mean_between)
    canvas.rectangle({{map({std::max(panel.mean_between->low, left), 0}).x(), frame.high.y() - 9},
                      {map({std::min(panel.mean_between->high, right), 0}).x(), frame.high.y()}},
                     {.fill = mean_band_colour, .stroke = mean_colour, .stroke_width = 0.6});
  const double mean = map({sample.mean(), 0}).x();
  canvas.line({mean, frame.low.y()}, {mean, frame.high.y()},
              {.stroke = mean_colour, .stroke_width = 2});
  canvas.polyline(on_page(steps), {.stroke = step_colour, .stroke_width = 1.6});
  constexpr std::size_t most_dots = 200;
  if (sample.size() <= most_dots)
    for (std::size_t k = 0; k < sample.size(); ++k)
      canvas.circle(map({sample.values()[k], 100 * static_cast<double>(k + 1) / total}), 2.6,
                    {.fill = step_colour});
  std::string note = panel.note;
  if (panel.limit) {
    const std::string text = "limit " + readable_text(*panel.limit) + " " + panel.unit;
    if (shows_limit) {
      const double x = map({*panel.limit, 0}).x();
      const bool is_right = x > frame.centre().x();
      canvas.line({x, frame.low.y()}, {x, frame.high.y()},
                  {.stroke = limit_colour, .stroke_width = 2, .dash = "7 4"});
      canvas.text({x + (is_right ? -6.0 : 6.0), frame.high.y() - 16}, text,
                  {.anchor = is_right ? TextAnchor::end : TextAnchor::start,
                   .fill = limit_colour,
                   .halo = true});
    } else {
      note += (note.empty() ? "" : "; ") + text +
              (*panel.limit > high ? ", far to the right" : ", far to the left");
    }
  }
  draw_axis_across(canvas, map, frame);
  canvas.text({frame.low.x(), frame.high.y() + 40}, note, {.fill = "#444"});
}

/// A bar for every key, from 0 to its rank correlation.
inline void draw_influence(SvgCanvas& canvas, const InfluencePanel& panel, const ViewRect& frame) {
  draw_panel_title(canvas, "what decides: " + panel.name, frame);
  const PageMap map({{-1, 0}, {1, static_cast<double>(panel.keys.size())}}, frame);
  const auto x_of = [&](double correlation) { return map({correlation, 0}).x(); };
  canvas.rectangle({{x_of(-panel.limit), frame.low.y()}, {x_of(panel.limit), frame.high.y()}},
                   {.fill = "#eee"});
  const double pitch = frame.height() / static_cast<double>(panel.keys.size());
  for (std::size_t k = 0; k < panel.keys.size(); ++k) {
    const double y = frame.low.y() + (static_cast<double>(k) + 0.5) * pitch,
                 half = std::min(9.0, 0.32 * pitch), c = panel.correlations[k];
    if (std::isfinite(c)) {
      const bool is_sure = std::abs(c) > panel.limit;
      canvas.rectangle({{x_of(std::min(0.0, c)), y - half}, {x_of(std::max(0.0, c)), y + half}},
                       {.fill = is_sure ? step_colour : "#a9bccd"});
    }
    // Beside the end of the bar that is free.
    const bool is_left = std::isfinite(c) && c > 0;
    canvas.text({x_of(0) + (is_left ? -6.0 : 6.0), y + 4.5},
                panel.keys[k] + (std::isfinite(c) ? "" : ": all the same"),
                {.anchor = is_left ? TextAnchor::end : TextAnchor::start, .halo = true});
  }
  canvas.line({x_of(0), frame.low.y()}, {x_of(0), frame.high.y()}, {.stroke = "#111"});
  draw_axis_across(canvas, map, frame);
}

}  // namespace detail

/// Empirical distributions: of each quantity a step and a dot for every value, the band in which
/// the distribution lies with 95 % confidence, the mean as a line with its confidence interval, and
/// the limit that it should keep. Of realisations without a value the steps lack so much of 100 %.
///
/// @return  an SVG document, 190 mm wide
/// @throws InvalidInput  no panel, or a value that is not finite
[[nodiscard]] inline std::string draw_distribution_picture(const DistributionPicture& picture) {
  if (picture.panels.empty()) throw InvalidInput("distribution picture: needs at least one panel");
  constexpr double left = 66, gap = 76, height = 190, below = 96;
  constexpr double width = (picture_width - left - gap - picture_margin) / 2;
  const double top = picture.header.height() + 40;
  const auto rectangle = [](const char* colour) {
    return [colour](SvgCanvas& c, const Vec2& at) {
      c.rectangle({at - Vec2(11, 6), at + Vec2(11, 6)}, {.fill = colour});
    };
  };
  const auto upright = [](const char* colour, const char* dash) {
    return [colour, dash](SvgCanvas& c, const Vec2& at) {
      c.line(at - Vec2(0, 7), at + Vec2(0, 7), {.stroke = colour, .stroke_width = 2, .dash = dash});
    };
  };
  std::vector<LegendItem> items{
      {"realisations with at most this value [%]",
       [](SvgCanvas& c, const Vec2& at) {
         c.line(at - Vec2(11, 0), at + Vec2(11, 0),
                {.stroke = detail::step_colour, .stroke_width = 1.6});
         c.circle(at, 2.6, {.fill = detail::step_colour});
       }},
      {"where the distribution lies (95 %)", rectangle(detail::band_colour)},
      {"mean", upright(detail::mean_colour, "")},
      {"its 95 % confidence interval", rectangle(detail::mean_band_colour)}};
  if (std::any_of(picture.panels.begin(), picture.panels.end(),
                  [](const DistributionPanel& panel) { return panel.limit.has_value(); }))
    items.push_back({"limit", upright(detail::limit_colour, "5 3")});
  if (!picture.influences.empty()) {
    items.push_back({"rank correlation", rectangle(detail::step_colour)});
    items.push_back({"what chance alone may do (95 %)", rectangle("#eee")});
  }
  const Legend legend(items, picture_width - 2 * picture_margin);
  // Distributions first; what decides them begins a row of its own.
  const std::size_t first = (picture.panels.size() + 1) / 2 * 2,
                    places = first + picture.influences.size();
  const double rows = std::ceil(static_cast<double>(places) / 2);
  const double bottom = top + rows * (height + below) - 20;
  SvgCanvas canvas(picture_width, bottom + legend.height() + 20, picture_printed_width,
                   picture.header.title);
  picture.header.draw(canvas);
  const auto frame_of = [&](std::size_t place) {
    const Vec2 corner(left + static_cast<double>(place % 2) * (width + gap),
                      top + std::floor(static_cast<double>(place) / 2) * (height + below));
    return ViewRect{corner, corner + Vec2(width, height)};
  };
  for (std::size_t k = 0; k < picture.panels.size(); ++k) {
    canvas.begin_layer(picture.panels[k].name);
    detail::draw_distribution(canvas, picture.panels[k], frame_of(k));
    canvas.end_layer();
  }
  for (std::size_t k = 0; k < picture.influences.size(); ++k) {
    canvas.begin_layer("what decides: " + picture.influences[k].name);
    detail::draw_influence(canvas, picture.influences[k], frame_of(first + k));
    canvas.end_layer();
  }
  legend.draw(canvas, {left, bottom});
  return canvas.document();
}

}  // namespace voussoir
