// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/blocks_picture_data.hpp>

namespace voussoir::detail {

inline constexpr const char* load_colour = "#c2007a";
inline constexpr double turn_radius = 10;  ///< of the sign of a moment [px]

inline bool is_drawable(const PictureLoad& load) {
  return load.at.allFinite() && load.force.allFinite() && std::isfinite(load.moment);
}

/// The arrow of a force, its tip where it acts, on the page; none: it is a moment alone.
/// @param largest  of all loads of the picture, 46 px long; the least are 18 px [N/m]
[[nodiscard]] inline std::optional<std::array<Vec2, 2>> arrow_of(const PictureLoad& load,
                                                                 double largest,
                                                                 const PageMap& map) {
  constexpr double longest = 46, shortest = 18;  // [px]
  const double force = load.force.norm();
  if (!is_drawable(load) || !(force > 0)) return std::nullopt;
  const Vec2 tip = map(load.at);
  const double length = std::max(longest * force / largest, shortest);
  return std::array{Vec2(tip - length / force * Vec2(load.force.x(), -load.force.y())), tip};
}

[[nodiscard]] inline double largest_force(const std::vector<PictureLoad>& loads) {
  double largest = 0;
  for (const PictureLoad& load : loads)
    if (is_drawable(load)) largest = std::max(largest, load.force.norm());
  return largest;
}

/// To who points at it.
VOUSSOIR_INLINE std::string words_of(const PictureLoad& load);

/// Three quarters of a circle that turns as the moment does.
VOUSSOIR_INLINE void draw_turn(SvgCanvas& canvas, const Vec2& centre, bool is_anticlockwise);

/// Forces as arrows that end where they act, moments as turns about that place.
VOUSSOIR_INLINE void draw_loads(SvgCanvas& canvas, const std::vector<PictureLoad>& loads,
                                const PageMap& map);

/// Samples of what loads there are.
VOUSSOIR_INLINE std::vector<LegendItem> loads_legend(const std::vector<PictureLoad>& loads);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::string words_of(const PictureLoad& load) {
  std::string words = "load";
  if (load.force.norm() > 0)
    words += "\n" + printed_text(1e-3 * load.force.x()) + " kN/m to the right\n" +
             printed_text(1e-3 * load.force.y()) + " kN/m up";
  if (load.moment != 0) words += "\n" + printed_text(1e-3 * load.moment) + " kN m/m";
  return words;
}

VOUSSOIR_INLINE void draw_turn(SvgCanvas& canvas, const Vec2& centre, bool is_anticlockwise) {
  constexpr int steps = 24;
  std::vector<Vec2> arc;
  for (int k = 0; k <= steps; ++k) {
    const double angle = 1.5 * std::numbers::pi * k / steps;
    // Up is down on the page.
    arc.push_back(centre + turn_radius * Vec2(std::cos(angle),
                                              (is_anticlockwise ? -1 : 1) * std::sin(angle)));
  }
  canvas.polyline(arc, {.stroke = "white", .stroke_width = 4.4});
  canvas.polyline(arc, {.stroke = load_colour, .stroke_width = 2.2});
  const Vec2 end = arc.back();
  draw_arrow_head(canvas, end + Vec2(7, 0), {1, 0}, load_colour);
}

VOUSSOIR_INLINE void draw_loads(SvgCanvas& canvas, const std::vector<PictureLoad>& loads,
                                const PageMap& map) {
  const double largest = largest_force(loads);
  for (const PictureLoad& load : loads) {
    if (const auto arrow = arrow_of(load, largest, map)) {
      const auto& [tail, tip] = *arrow;
      const Vec2 along = (tip - tail).normalized();
      canvas.line(tail, tip, {.stroke = "white", .stroke_width = 5});
      canvas.line(tail, tip - 6 * along, {.stroke = load_colour, .stroke_width = 2.6});
      draw_arrow_head(canvas, tip, along, load_colour);
    }
    if (is_drawable(load) && load.moment != 0) draw_turn(canvas, map(load.at), load.moment > 0);
  }
}

VOUSSOIR_INLINE std::vector<LegendItem> loads_legend(const std::vector<PictureLoad>& loads) {
  std::vector<LegendItem> items;
  const auto add = [&](const char* name, auto&& size_of, const char* unit, const auto& draw) {
    double largest = 0;
    int count = 0;
    for (const PictureLoad& load : loads) {
      if (!is_drawable(load) || !(size_of(load) > 0)) continue;
      largest = std::max(largest, size_of(load));
      ++count;
    }
    if (count > 0)
      items.push_back(
          {name + std::string(count > 1 ? ", up to " : ", ") + readable_text(1e-3 * largest) + unit,
           draw});
  };
  add(
      "load", [](const PictureLoad& load) { return load.force.norm(); }, " kN/m",
      [](SvgCanvas& canvas, const Vec2& c) {
        canvas.line(c - Vec2(13, 0), c + Vec2(6, 0), {.stroke = load_colour, .stroke_width = 2.6});
        draw_arrow_head(canvas, c + Vec2(13, 0), {1, 0}, load_colour);
      });
  add(
      "moment", [](const PictureLoad& load) { return std::abs(load.moment); }, " kN m/m",
      [](SvgCanvas& canvas, const Vec2& c) { draw_turn(canvas, c, true); });
  return items;
}

#endif

}  // namespace voussoir::detail
