// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/round_ticks.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/statistics/confidence.hpp>
#include <voussoir/statistics/histogram.hpp>
#include <voussoir/statistics/sample.hpp>

namespace voussoir {

/// One quantity over the realisations of the rock.
struct HistogramPanel {
  std::string name;                           ///< "crown convergence"
  std::string unit;                           ///< "mm"
  std::vector<double> values;                 ///< in that unit, finite
  std::optional<Interval> mean_between = {};  ///< confidence interval of the mean
  std::string note = {};                      ///< under the axis: realisations without a value
};

/// Histograms side by side, two in a row.
struct HistogramPicture {
  PictureHeader header;
  std::vector<HistogramPanel> panels;
};

namespace detail {

inline void draw_histogram(SvgCanvas& canvas, const HistogramPanel& panel, const ViewRect& frame) {
  const std::string title = panel.name + (panel.unit.empty() ? "" : " [" + panel.unit + "]");
  canvas.begin_layer(panel.name);
  canvas.text({frame.low.x(), frame.low.y() - 12}, title, {.size = 14.5, .bold = true});
  canvas.line({frame.low.x(), frame.high.y()}, frame.high, {.stroke = "#111"});
  const bool has_spread =
      panel.values.size() > 1 && Sample(panel.values).smallest() < Sample(panel.values).largest();
  if (has_spread) {
    const Sample sample(panel.values);
    const Histogram bars = Histogram::of(sample);
    const std::size_t most = *std::max_element(bars.counts().begin(), bars.counts().end());
    const double margin = 0.04 * (sample.largest() - sample.smallest());
    const PageMap map({{sample.smallest() - margin, 0},
                       {sample.largest() + margin, 1.08 * static_cast<double>(most)}},
                      frame);
    if (panel.mean_between) {
      const double low = std::max(panel.mean_between->low, map.world().low.x()),
                   high = std::min(panel.mean_between->high, map.world().high.x());
      canvas.rectangle({{map({low, 0}).x(), frame.low.y()}, {map({high, 0}).x(), frame.high.y()}},
                       {.fill = "#f2d7b6"});
    }
    for (std::size_t k = 0; k < bars.counts().size(); ++k) {
      const double middle = bars.middle(k), half = 0.5 * bars.width();
      const Vec2 top = map({middle - half, static_cast<double>(bars.counts()[k])}),
                 foot = map({middle + half, 0});
      canvas.rectangle({top, foot}, {.fill = "#7fa8cc", .stroke = "white", .opacity = 0.85});
    }
    const double mean = map({sample.mean(), 0}).x();
    canvas.line({mean, frame.low.y()}, {mean, frame.high.y()},
                {.stroke = "#b3541e", .stroke_width = 2});
    const RoundTicks across = round_ticks(map.world().low.x(), map.world().high.x(), 6);
    for (const double value : across.values) {
      const double x = map({value, 0}).x();
      canvas.line({x, frame.high.y()}, {x, frame.high.y() + 5}, {.stroke = "#111"});
      canvas.text({x, frame.high.y() + 20}, across.label(value), {.anchor = TextAnchor::middle});
    }
    const RoundTicks up = round_ticks(0, map.world().high.y(), 4);
    for (const double value : up.values) {
      if (value != std::round(value)) continue;  // of realisations there are whole numbers
      const double y = map({map.world().low.x(), value}).y();
      canvas.line({frame.low.x(), y}, {frame.high.x(), y}, {.stroke = "#ddd", .stroke_width = 0.6});
      canvas.text({frame.low.x() - 6, y + 4.5}, up.label(value), {.anchor = TextAnchor::end});
    }
  } else {
    const std::string text = panel.values.empty() ? "no realisation has a value"
                                                  : readable_text(panel.values.front()) + " " +
                                                        panel.unit + " in all that have a value";
    canvas.text(frame.centre(), text, {.size = 14.5, .anchor = TextAnchor::middle});
  }
  canvas.text({frame.low.x(), frame.high.y() + 40}, panel.note, {.fill = "#444"});
  canvas.end_layer();
}

}  // namespace detail

/// Histograms with classes by Scott's rule, the mean as a line, its confidence interval as a band.
///
/// @return  an SVG document, 190 mm wide
/// @throws InvalidInput  no panel, or a value that is not finite
[[nodiscard]] inline std::string draw_histogram_picture(const HistogramPicture& picture) {
  if (picture.panels.empty()) throw InvalidInput("histogram picture: needs at least one panel");
  constexpr double left = 66, gap = 76, height = 190, below = 96;
  constexpr double width = (picture_width - left - gap - picture_margin) / 2;
  const double top = picture.header.height() + 40;
  const double rows = std::ceil(static_cast<double>(picture.panels.size()) / 2);
  const Legend legend({{"realisations in a class",
                        [](SvgCanvas& c, const Vec2& at) {
                          c.rectangle({at - Vec2(11, 6), at + Vec2(11, 6)}, {.fill = "#7fa8cc"});
                        }},
                       {"mean",
                        [](SvgCanvas& c, const Vec2& at) {
                          c.line(at - Vec2(0, 7), at + Vec2(0, 7),
                                 {.stroke = "#b3541e", .stroke_width = 2});
                        }},
                       {"its 95 % confidence interval",
                        [](SvgCanvas& c, const Vec2& at) {
                          c.rectangle({at - Vec2(11, 6), at + Vec2(11, 6)}, {.fill = "#f2d7b6"});
                        }}},
                      picture_width - 2 * picture_margin);
  const double bottom = top + rows * (height + below) - 20;
  SvgCanvas canvas(picture_width, bottom + legend.height() + 20, picture_printed_width,
                   picture.header.title);
  picture.header.draw(canvas);
  for (std::size_t k = 0; k < picture.panels.size(); ++k) {
    const Vec2 corner(left + static_cast<double>(k % 2) * (width + gap),
                      top + std::floor(static_cast<double>(k) / 2) * (height + below));
    detail::draw_histogram(canvas, picture.panels[k], {corner, corner + Vec2(width, height)});
  }
  legend.draw(canvas, {left, bottom});
  return canvas.document();
}

}  // namespace voussoir
