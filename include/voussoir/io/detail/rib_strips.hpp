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
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/colour_map.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/drawing/round_ticks.hpp>
#include <voussoir/drawing/svg.hpp>

namespace voussoir {

/// A node of a rib on the unrolled wall.
struct UnrolledNode {
  double along;   ///< place along the tunnel [m]
  double angle;   ///< anticlockwise from the right-hand springing [deg], -90 to 270
  double thrust;  ///< compression positive [N/m], or where strips have no width of a rib [N]
  double moment;  ///< positive: outer fibre in tension [N m/m] or [N m]
};

/// The ribs or strips of a lining in 3-D, the wall cut open along the invert and laid flat.
struct UnrolledLining {
  std::vector<UnrolledNode> nodes;  ///< in any order
  double strip_width = 0;           ///< what forces are per metre of [m]; 0: they are of a rib
};

namespace detail {

/// Where an angle is on the wall: "crown".
[[nodiscard]] VOUSSOIR_INLINE std::string place_on_wall(double angle);

/// What stands for a node on the unrolled wall: [m] along, [deg] around.
struct UnrolledCell {
  ViewRect rect;
  std::size_t node;
};
/// Every node with its rib's width and halfway to its neighbours; one that reaches over the invert
/// is in two pieces, and none reaches over a gap in its rib.
[[nodiscard]] VOUSSOIR_INLINE std::vector<UnrolledCell> unrolled_cells(
    const UnrolledLining& lining);

/// One quantity on the unrolled wall with its scale; largest and smallest value are marked, and
/// told with their places.
/// @param values  one a node
VOUSSOIR_INLINE void draw_unrolled_panel(SvgCanvas& canvas, const ViewRect& frame,
                                         const UnrolledLining& lining,
                                         const std::vector<double>& values,
                                         const std::string& title, const std::string& unit,
                                         const std::string& meaning);

/// Height of both panels [px]; 0 where there is no node.
[[nodiscard]] inline double unrolled_height(const UnrolledLining& lining) {
  return lining.nodes.empty() ? 0 : 400;
}
/// Thrust and moment side by side.
VOUSSOIR_INLINE void draw_unrolled_lining(SvgCanvas& canvas, const ViewRect& frame,
                                          const UnrolledLining& lining);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::string place_on_wall(double angle) {
  static const char* const names[] = {"invert",         "lower right", "right springing",
                                      "right shoulder", "crown",       "left shoulder",
                                      "left springing", "lower left",  "invert"};
  const double turn = std::clamp((angle + 90) / 45, 0.0, 8.0);
  return names[static_cast<std::size_t>(std::floor(turn + 0.5))];
}

[[nodiscard]] inline std::string whole_degrees(double angle) {
  const std::string text = fixed_text(angle, 0);
  return (text.starts_with('-') ? "\u2212" + text.substr(1) : text) + "°";
}

VOUSSOIR_INLINE std::vector<UnrolledCell> unrolled_cells(const UnrolledLining& lining) {
  const std::vector<UnrolledNode>& nodes = lining.nodes;
  std::vector<std::size_t> order(nodes.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t p, std::size_t q) { return nodes[p].along < nodes[q].along; });
  // Ribs; without a width they are as wide as the two nearest are apart.
  constexpr double same = 1e-6;
  double width = lining.strip_width;
  if (!(width > 0)) {
    width = std::numeric_limits<double>::infinity();
    for (std::size_t n = 1; n < order.size(); ++n)
      if (const double gap = nodes[order[n]].along - nodes[order[n - 1]].along; gap > same)
        width = std::min(width, gap);
    if (!std::isfinite(width)) width = 1;
  }
  std::vector<UnrolledCell> cells;
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && nodes[order[end]].along - nodes[order[begin]].along < 0.25 * width)
      ++end;
    std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
                     order.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](std::size_t p, std::size_t q) { return nodes[p].angle < nodes[q].angle; });
    const std::size_t count = end - begin;
    // To the next node, the last one to the first.
    std::vector<double> gaps(count);
    for (std::size_t k = 0; k < count; ++k) {
      const double next = nodes[order[begin + (k + 1) % count]].angle + (k + 1 == count ? 360 : 0);
      gaps[k] = next - nodes[order[begin + k]].angle;
    }
    std::vector<double> sorted = gaps;
    std::sort(sorted.begin(), sorted.end());
    const double usual = sorted[(count - 1) / 2];
    // Nodes stand evenly along the wall: seen from the middle, those on it furthest away lie half
    // as far apart as the nearest. What is wider is no part of the rib.
    const auto half_of = [&](double gap) { return 0.5 * (gap > 3 * usual ? usual : gap); };
    for (std::size_t k = 0; k < count; ++k) {
      const UnrolledNode& node = nodes[order[begin + k]];
      const double low = node.angle - half_of(gaps[(k + count - 1) % count]),
                   high = node.angle + half_of(gaps[k]);
      const auto add = [&](double from, double to) {
        if (to > from)
          cells.push_back({{{node.along - 0.5 * width, from}, {node.along + 0.5 * width, to}},
                           order[begin + k]});
      };
      add(std::max(low, -90.0), std::min(high, 270.0));
      if (low < -90) add(low + 360, 270);
      if (high > 270) add(-90, high - 360);
    }
    begin = end;
  }
  return cells;
}

VOUSSOIR_INLINE void draw_unrolled_panel(SvgCanvas& canvas, const ViewRect& frame,
                                         const UnrolledLining& lining,
                                         const std::vector<double>& values,
                                         const std::string& title, const std::string& unit,
                                         const std::string& meaning) {
  canvas.text({frame.low.x(), frame.low.y() + 14}, title, {.size = 14.5, .bold = true});
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double reached = std::max(std::abs(*least), std::abs(*most));
  const bool is_zero = !(reached > 0);  // moments of pinned ribs
  const double largest = is_zero ? 1 : reached;
  const bool has_both = *least < -1e-3 * largest;  // less is rounding, and has no colour
  static const ColourMap positive({{250, 250, 250}, {150, 190, 225}, {33, 82, 145}}),
      negative({{250, 250, 250}, {240, 180, 140}, {178, 70, 20}});
  const auto colour = [&](double value) {
    const double part = value / largest;
    return (part < 0 ? negative(-part) : positive(part)).hex();
  };
  const std::vector<UnrolledCell> cells = unrolled_cells(lining);
  double from = std::numeric_limits<double>::infinity(), to = -from;
  for (const UnrolledCell& cell : cells) {
    from = std::min(from, cell.rect.low.x());
    to = std::max(to, cell.rect.high.x());
  }
  const ViewRect plot{{frame.low.x() + 112, frame.low.y() + 26},
                      {frame.high.x() - 8, frame.high.y() - 128}};
  const PageMap map({{from, -90}, {to, 270}}, plot);
  canvas.rectangle(plot, {.fill = "#e4e4e4"});  // no lining
  for (const UnrolledCell& cell : cells) {
    const Vec2 a = map(cell.rect.low), b = map(cell.rect.high);
    const std::string fill = colour(values[cell.node]);
    canvas.rectangle({{a.x(), b.y()}, {b.x(), a.y()}},
                     {.fill = fill, .stroke = fill, .stroke_width = 0.4});
  }
  for (const double angle : {-90.0, 0.0, 90.0, 180.0, 270.0}) {
    const double y = map({from, angle}).y();
    canvas.line({plot.low.x() - 5, y}, {plot.high.x(), y}, {.stroke = "#777", .stroke_width = 0.6});
    canvas.text({plot.low.x() - 9, y + 4.5}, place_on_wall(angle), {.anchor = TextAnchor::end});
  }
  canvas.rectangle(plot, {.stroke = "#111"});
  const RoundTicks ticks = round_ticks(from, to, 8);
  for (const double s : ticks.values) {
    const double x = map({s, -90}).x();
    canvas.line({x, plot.high.y()}, {x, plot.high.y() + 5}, {.stroke = "#111"});
    canvas.text({x, plot.high.y() + 19}, ticks.label(s), {.anchor = TextAnchor::middle});
  }
  canvas.text({plot.centre().x(), plot.high.y() + 36}, "along the tunnel [m]",
              {.anchor = TextAnchor::middle});

  const double bar_y = plot.high.y() + 48;
  if (is_zero) {
    canvas.text({plot.low.x(), bar_y + 11}, "0 " + unit + " everywhere");
    return;
  }
  // The scale, with what its two sides mean.
  const double low = has_both ? -largest : 0;
  constexpr int steps = 60;
  for (int k = 0; k < steps; ++k)  // each to the end: no gaps between them
    canvas.rectangle(
        {{plot.low.x() + plot.width() * k / steps, bar_y}, {plot.high.x(), bar_y + 12}},
        {.fill = colour(low + (largest - low) * (k + 0.5) / steps)});
  const auto shown = [&](double value) {
    return printed_text(std::abs(value) < 1e-3 * largest ? 0 : value);
  };
  const auto label = [&](double value, TextAnchor anchor, double x) {
    canvas.text({x, bar_y + 27}, shown(value), {.anchor = anchor});
  };
  label(low, TextAnchor::start, plot.low.x());
  label(largest, TextAnchor::end, plot.high.x());
  if (has_both) label(0, TextAnchor::middle, plot.centre().x());
  canvas.text({plot.low.x() - 9, bar_y + 11}, unit, {.anchor = TextAnchor::end});

  // Where its largest and its smallest value is: one may be next to the other, so the smaller disc
  // is drawn last.
  const auto mark = [&](const char* name, std::ptrdiff_t k, double y, double radius,
                        const SvgStyle& style) {
    const auto at = static_cast<std::size_t>(k);
    const UnrolledNode& node = lining.nodes[at];
    canvas.circle(map({node.along, node.angle}), radius, style);
    canvas.circle({frame.low.x() + 6, y - 4.5}, radius, style);
    canvas.text({frame.low.x() + 16, y}, std::string(name) + " " + shown(values[at]) + " " + unit +
                                             " at " + trimmed_text(node.along, 2) + " m, " +
                                             place_on_wall(node.angle) + " (" +
                                             whole_degrees(node.angle) + ")");
  };
  mark("smallest", least - values.begin(), bar_y + 65, 5,
       {.fill = "white", .stroke = "#111", .stroke_width = 1.8});
  mark("largest", most - values.begin(), bar_y + 47, 3.6, {.fill = "#111", .stroke = "white"});
  canvas.text({frame.low.x(), bar_y + 83}, meaning);
}

VOUSSOIR_INLINE void draw_unrolled_lining(SvgCanvas& canvas, const ViewRect& frame,
                                          const UnrolledLining& lining) {
  if (lining.nodes.empty()) return;
  const std::string per_metre = lining.strip_width > 0 ? "/m" : "";
  std::vector<double> thrust, moment;
  for (const UnrolledNode& node : lining.nodes) {
    thrust.push_back(1e-3 * node.thrust);
    moment.push_back(1e-3 * node.moment);
  }
  const double middle = frame.centre().x();
  const std::string wall = per_metre.empty() ? " of each rib, wall unrolled" : ", wall unrolled";
  canvas.begin_layer("unrolled-lining");
  draw_unrolled_panel(canvas, {frame.low, {middle - 10, frame.high.y()}}, lining, thrust,
                      "Lining thrust N [kN" + per_metre + "]" + wall, "kN" + per_metre,
                      "positive: compression");
  draw_unrolled_panel(canvas, {{middle + 10, frame.low.y()}, frame.high}, lining, moment,
                      "Lining moment M [kN m" + per_metre + "]" + wall, "kN m" + per_metre,
                      "positive: outer fibre in tension");
  canvas.end_layer();
}

#endif

}  // namespace detail
}  // namespace voussoir
