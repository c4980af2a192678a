// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/round_ticks.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/blocks_picture_data.hpp>
#include <voussoir/io/detail/bolt_layers.hpp>

namespace voussoir::detail {

inline constexpr const char* positive_colour = "#2f6db3";
inline constexpr const char* negative_colour = "#d9622b";

/// Direction from the middle of the opening, anticlockwise from the horizontal, 0 to 360 [deg].
inline double direction_degrees(const Vec2& from, const Vec2& to) {
  const double angle = std::atan2(to.y() - from.y(), to.x() - from.x()) * 180 / std::numbers::pi;
  return angle < -0.5 ? angle + 360 : std::abs(angle);
}

/// One quantity along linings, drawn across them: positive values outside, negative inside.
struct LiningDiagram {
  std::string title;               ///< with unit
  std::string positive, negative;  ///< what the two sides mean
  std::string unit;                ///< for the scale bar
  std::vector<double> values;      ///< one a node, lining by lining, in that unit
  double negligible = 0;           ///< this value at least fills the diagram
  Vec2 centre = zeros<Vec2>();     ///< of the opening, from which directions are counted [m]
};

VOUSSOIR_INLINE void draw_lining_diagram(SvgCanvas& canvas, const ViewRect& frame,
                                         const std::vector<PictureLining>& linings,
                                         const LiningDiagram& diagram);

/// Greatest force of each bolt over the direction of its head.
VOUSSOIR_INLINE void draw_bolt_chart(SvgCanvas& canvas, const ViewRect& frame,
                                     const BlocksPicture& picture);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void draw_lining_diagram(SvgCanvas& canvas, const ViewRect& frame,
                                         const std::vector<PictureLining>& linings,
                                         const LiningDiagram& diagram) {
  std::vector<Vec2> axis, normals;
  std::vector<double> values;
  std::vector<std::size_t> begins;  // of every lining in these
  std::size_t given = 0;
  for (const PictureLining& lining : linings) {
    begins.push_back(axis.size());
    for (const PictureLiningNode& node : lining.nodes) {
      const double value = diagram.values[given++];
      if (!node.point.allFinite() || !node.outward_normal.allFinite()) continue;
      if (!std::isfinite(value)) continue;
      axis.push_back(node.point);
      normals.push_back(node.outward_normal);
      values.push_back(value);
    }
  }
  begins.push_back(axis.size());
  canvas.text({frame.low.x(), frame.low.y() + 13}, diagram.title, {.size = 14.5, .bold = true});
  if (axis.size() < 2) {
    canvas.text(frame.centre(), "no values", {.anchor = TextAnchor::middle});
    return;
  }
  const auto min_at = std::min_element(values.begin(), values.end());
  const auto max_at = std::max_element(values.begin(), values.end());
  const double largest =
      std::max({std::abs(*min_at), std::abs(*max_at), diagram.negligible, 1e-300});
  const bool has_positive = *max_at > 0, has_negative = *min_at < 0;

  // Bars take a third of the half width of the opening; the map leaves room for them outside.
  const ViewRect around = *bounding_rect(axis);
  const double bar = 0.36 * std::max(around.width(), around.height()) / 2;
  const double explained = 18 + (has_positive && has_negative ? 37 : 19);
  const ViewRect drawing{{frame.low.x(), frame.low.y() + 22},
                         {frame.high.x(), frame.high.y() - 24 - explained}};
  const PageMap map =
      PageMap::equal_scales(around.grown(1.08 * (has_positive ? bar : 0.1 * bar)), drawing);
  const auto end_of = [&](std::size_t i, double value) {
    return map(axis[i] + bar * value / largest * normals[i]);
  };

  SvgPath fill[2], bars[2], edge[2];  // 0 positive, 1 negative
  const auto draw_from = [&](std::size_t i, std::size_t next, bool is_joined) {
    bars[values[i] < 0 ? 1 : 0].add_line(map(axis[i]), end_of(i, values[i]));
    if (!is_joined) return;
    const double v = values[i], w = values[next];
    for (const int side : {0, 1}) {  // the part of each sign, which ends where the value is zero
      const double sign = side == 0 ? 1 : -1;
      if (sign * v <= 0 && sign * w <= 0) continue;
      const double t = v * w < 0 ? v / (v - w) : 0;
      const Vec2 zero = map(axis[i]) + t * (map(axis[next]) - map(axis[i]));
      const bool starts = sign * v >= 0, ends = sign * w >= 0;
      const Vec2 base_a = starts ? map(axis[i]) : zero, base_b = ends ? map(axis[next]) : zero;
      const Vec2 top_a = starts ? end_of(i, v) : zero, top_b = ends ? end_of(next, w) : zero;
      const std::vector<Vec2> part = {base_a, base_b, top_b, top_a};
      fill[side].add_polygon(part);
      edge[side].add_line(top_a, top_b);
    }
  };
  SvgPath ring;
  for (std::size_t k = 0; k < linings.size(); ++k) {
    const std::size_t begin = begins[k], end = begins[k + 1];
    for (std::size_t i = begin; i < end; ++i) {
      const bool is_last = i + 1 == end;
      draw_from(i, is_last ? begin : i + 1, !is_last || linings[k].is_ring);
    }
    const std::vector<Vec2> line = on_page({axis.begin() + static_cast<std::ptrdiff_t>(begin),
                                            axis.begin() + static_cast<std::ptrdiff_t>(end)},
                                           map);
    if (line.size() >= 2) linings[k].is_ring ? ring.add_polygon(line) : ring.add_polyline(line);
  }
  const char* colours[] = {positive_colour, negative_colour};
  for (const int side : {0, 1}) {
    canvas.path(fill[side], {.fill = colours[side], .opacity = 0.22});
    canvas.path(bars[side], {.stroke = colours[side], .stroke_width = 0.8});
    canvas.path(edge[side], {.stroke = colours[side], .stroke_width = 1.8, .round_ends = true});
  }
  canvas.path(ring, {.stroke = "#222", .stroke_width = 1.6});

  // The extremes: marked on the curve, their numbers below, where nothing can cover them.
  // What is small beside the full scale is given to a thousandth of it.
  const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(largest))));
  const auto number = [&](double value) {
    if (std::abs(value) >= 0.1 * largest) return printed_text(value);
    const std::string text = trimmed_text(value, decimals);
    return text.starts_with('-') ? "\u2212" + text.substr(1) : text;
  };
  const auto extreme_text = [&](const char* name, std::size_t i) {
    return std::string(name) + " " + number(values[i]) + " at " +
           fixed_text(direction_degrees(diagram.centre, axis[i]), 0) + "°";
  };
  const auto max_i = static_cast<std::size_t>(max_at - values.begin());
  const auto min_i = static_cast<std::size_t>(min_at - values.begin());
  const SvgStyle max_style{.fill = "#111", .stroke = "white"};
  const SvgStyle min_style{.fill = "white", .stroke = "#111", .stroke_width = 1.8};
  canvas.circle(end_of(max_i, values[max_i]), 4.2, max_style);
  canvas.circle(end_of(min_i, values[min_i]), 3.8, min_style);
  const double y = drawing.high.y() + 19;
  canvas.circle({frame.low.x() + 6, y - 4.5}, 4.2, max_style);
  canvas.text({frame.low.x() + 15, y}, extreme_text("max", max_i));
  canvas.circle({frame.centre().x() + 6, y - 4.5}, 3.8, min_style);
  canvas.text({frame.centre().x() + 15, y}, extreme_text("min", min_i));
  // How long a round value is drawn.
  double line_y = y + 18;
  const double sample = round_down_125(largest);
  const double length = bar * sample / largest * map.scale();
  const Vec2 left(frame.low.x() + 1, line_y - 5);
  SvgPath scale;
  scale.add_line(left, left + Vec2(length, 0));
  scale.add_line(left + Vec2(0, -4), left + Vec2(0, 4));
  scale.add_line(left + Vec2(length, -4), left + Vec2(length, 4));
  canvas.path(scale, {.stroke = "#111", .stroke_width = 1.6});
  canvas.text({left.x() + length + 8, line_y}, trimmed_text(sample, 6) + " " + diagram.unit);
  line_y += 18;
  for (const int side : {0, 1}) {
    if (side == 0 ? !has_positive : !has_negative) continue;
    canvas.rectangle({{frame.low.x() + 1, line_y - 10}, {frame.low.x() + 11, line_y}},
                     {.fill = colours[side], .opacity = 0.75});
    canvas.text({frame.low.x() + 17, line_y}, side == 0 ? diagram.positive : diagram.negative);
    line_y += 18;
  }
}

VOUSSOIR_INLINE void draw_bolt_chart(SvgCanvas& canvas, const ViewRect& frame,
                                     const BlocksPicture& picture) {
  std::vector<std::pair<double, const PictureBolt*>> bars;
  const Vec2 centre = centre_of(picture);
  for (const PictureBolt& bolt : picture.bolts) {
    if (is_drawable(bolt) && !bolt.is_elsewhere)
      bars.emplace_back(direction_degrees(centre, bolt.head), &bolt);
  }
  canvas.text({frame.low.x(), frame.low.y() + 13}, "Greatest force in each bolt [kN]",
              {.size = 14.5, .bold = true});
  if (bars.empty()) return;
  std::sort(bars.begin(), bars.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  double largest = 0, gap = 30;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    largest = std::max(largest, max_force(*bars[i].second) / 1e3);
    if (i > 0 && bars[i].first - bars[i - 1].first > 0.5) {
      gap = std::min(gap, bars[i].first - bars[i - 1].first);
    }
  }
  largest = std::max(largest, 1e-3 * negligible_bolt_force);
  const RoundTicks force_ticks = round_ticks(0, largest, 8);
  const double top =
      force_ticks.step * std::ceil(std::max(largest, 1e-9) / force_ticks.step - 1e-9);
  const PageMap map({{bars.front().first - gap, 0}, {bars.back().first + gap, top}},
                    {frame.low + Vec2(46, 56), frame.high - Vec2(4, 62)});
  const ViewRect& plot = map.page();
  for (const double force : round_ticks(0, top, 8).values) {
    const double y = map({0, force}).y();
    canvas.line({plot.low.x(), y}, {plot.high.x(), y}, {.stroke = "#ccc", .stroke_width = 0.8});
    canvas.text({plot.low.x() - 6, y + 4.5}, force_ticks.label(force), {.anchor = TextAnchor::end});
  }
  const PictureBolt* highest = bars.front().second;
  for (const auto& [angle, bolt] : bars) {
    const double half = 0.36 * gap, force = max_force(*bolt) / 1e3;
    const ViewRect bar{map({angle - half, force}), map({angle + half, 0})};
    canvas.rectangle(bar, {.fill = positive_colour});
    auto worst = PictureCrossing::State::elastic;
    for (const PictureCrossing& c : bolt->crossings) worst = std::max(worst, c.state);
    draw_crossing_state(canvas, {bar.centre().x(), bar.low.y() - 9}, worst);
    if (max_force(*bolt) > max_force(*highest)) highest = bolt;
  }
  const double range = map.world().width();
  const double step = range > 240 ? 90 : range > 120 ? 45 : range > 60 ? 30 : 15;
  for (double angle = step * std::ceil(map.world().low.x() / step); angle <= map.world().high.x();
       angle += step) {
    const double x = map({angle, 0}).x();
    canvas.line({x, plot.high.y()}, {x, plot.high.y() + 5}, {.stroke = "#111"});
    canvas.text({x, plot.high.y() + 19}, fixed_text(angle, 0) + "°",
                {.anchor = TextAnchor::middle});
  }
  canvas.line({plot.low.x(), plot.high.y()}, plot.high, {.stroke = "#111", .stroke_width = 1.2});
  canvas.text({plot.centre().x(), plot.high.y() + 37}, "direction of the bolt head (crown 90°)",
              {.anchor = TextAnchor::middle});
  canvas.text(frame.low + Vec2(0, 32),
              "max " + readable_text(max_force(*highest) / 1e3) + " kN at " +
                  fixed_text(direction_degrees(centre, highest->head), 0) + "°; tension positive");
}

#endif

}  // namespace voussoir::detail
