// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/drawing/colour_map.hpp>
#include <voussoir/drawing/contour.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/smooth_grid.hpp>
#include <voussoir/drawing/svg.hpp>

namespace voussoir::detail {

/// Levels of a contour picture with a colour for each band between two of them.
class ContourBands {
 public:
  /// @param levels  ascending, two or more
  explicit ContourBands(std::vector<double> levels) : levels_(std::move(levels)) {}
  [[nodiscard]] std::size_t count() const { return levels_.size() - 1; }
  [[nodiscard]] double lower(std::size_t band) const { return levels_[band]; }
  [[nodiscard]] const std::vector<double>& levels() const { return levels_; }
  [[nodiscard]] std::string colour(std::size_t band) const {
    static const ColourMap map = ColourMap::straw_to_blue();
    return map((static_cast<double>(band) + 0.5) / static_cast<double>(count())).hex();
  }

 private:
  std::vector<double> levels_;
};

/// Places on the page that are taken by labels and marks.
class TakenPlaces {
 public:
  [[nodiscard]] bool is_free(const ViewRect& rect) const {
    return std::none_of(taken_.begin(), taken_.end(),
                        [&](const ViewRect& other) { return other.overlaps(rect); });
  }
  /// From a point to the middle of the nearest taken place [px].
  [[nodiscard]] double distance(const Vec2& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const ViewRect& rect : taken_) nearest = std::min(nearest, (rect.centre() - p).norm());
    return nearest;
  }
  void take(const ViewRect& rect) { taken_.push_back(rect); }

 private:
  std::vector<ViewRect> taken_;
};

/// Room of a text whose base line has its middle at `at`.
inline ViewRect text_room(const Vec2& at, const std::string& text, const TextStyle& style) {
  const double half = text_width(text, style) / 2 + 2;
  return {at + Vec2(-half, -style.size), at + Vec2(half, 0.3 * style.size)};
}

/// Writes the level on a contour where most room is; not at all where there is none.
VOUSSOIR_INLINE void label_contour(SvgCanvas& canvas, const std::vector<Vec2>& line,
                                   const std::string& text, const ViewRect& frame,
                                   TakenPlaces& taken);

/// Filled bands and lines of the levels over a smoothed grid; NaN are left white. `mark` stands
/// behind the numbers on the lines.
VOUSSOIR_INLINE void draw_contours(SvgCanvas& canvas, const ContourGrid& grid, const PageMap& map,
                                   const ContourBands& bands, TakenPlaces& taken,
                                   const std::string& mark);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void label_contour(SvgCanvas& canvas, const std::vector<Vec2>& line,
                                   const std::string& text, const ViewRect& frame,
                                   TakenPlaces& taken) {
  const TextStyle style{
      .size = 12.5, .anchor = TextAnchor::middle, .bold = true, .fill = "#123", .halo = true};
  const Vec2 to_base_line(0, 0.36 * style.size);
  std::optional<Vec2> best;
  double best_distance = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const int steps = std::max(1, static_cast<int>((line[i + 1] - line[i]).norm() / 6));
    for (int k = 0; k < steps; ++k) {
      const Vec2 at = line[i] + (static_cast<double>(k) / steps) * (line[i + 1] - line[i]);
      const ViewRect room = text_room(at + to_base_line, text, style).grown(3);
      if (!frame.contains(room.low) || !frame.contains(room.high) || !taken.is_free(room)) continue;
      const double distance = std::min(taken.distance(at), 200.0);
      if (distance > best_distance) {
        best = at;
        best_distance = distance;
      }
    }
  }
  if (!best) return;
  canvas.text(*best + to_base_line, text, style);
  taken.take(text_room(*best + to_base_line, text, style));
}

VOUSSOIR_INLINE void draw_contours(SvgCanvas& canvas, const ContourGrid& grid, const PageMap& map,
                                   const ContourBands& bands, TakenPlaces& taken,
                                   const std::string& mark) {
  const ContourGrid fine = refined(grid, 12);
  std::vector<std::pair<double, std::vector<Vec2>>> lines;
  for (std::size_t band = 0; band < bands.count(); ++band) {
    // Painted one over the other: all that is known first, then what is above the first level, ...
    const double level = band == 0 ? -std::numeric_limits<double>::infinity() : bands.lower(band);
    const Contour contour = contour_at(fine, level);
    SvgPath region(1);
    for (const std::vector<Vec2>& loop : contour.region) region.add_polygon(on_page(loop, map));
    canvas.path(region, {.fill = bands.colour(band)});
    for (const std::vector<Vec2>& line : contour.lines)
      lines.emplace_back(level, on_page(line, map));
  }
  SvgPath drawn(1);
  for (const auto& [level, line] : lines) drawn.add_polyline(line);
  canvas.path(drawn, {.stroke = "#1d3b53", .stroke_width = 1.1});
  // Long lines choose their place first.
  const auto length = [](const std::vector<Vec2>& line) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) sum += (line[i + 1] - line[i]).norm();
    return sum;
  };
  std::stable_sort(lines.begin(), lines.end(), [&](const auto& a, const auto& b) {
    return length(a.second) > length(b.second);
  });
  for (const auto& [level, line] : lines) {
    if (length(line) > 40) {
      label_contour(canvas, line, trimmed_text(level, 6) + mark, map.page(), taken);
    }
  }
}

#endif

}  // namespace voussoir::detail
