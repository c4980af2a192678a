// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/detail/contour_panel.hpp>
#include <voussoir/io/interaction_picture_data.hpp>

namespace voussoir::detail {

/// A part of the diagram: linings and spacings with a value, or what has no lining or no bolts, as
/// a strip of its own. Nothing is known between it and the first that has some.
struct InteractionPanel {
  std::vector<std::size_t> columns, rows;  ///< indices of thicknesses and spacings
  ContourGrid grid;                        ///< thickness [m], spacing, the quantity, as on contours
  ViewRect page;
  bool has_labels = true;  ///< of its spacings

  [[nodiscard]] bool is_row() const { return rows.size() == 1; }
  [[nodiscard]] bool is_column() const { return columns.size() == 1; }
  [[nodiscard]] double row_y(std::size_t k) const { return is_row() ? 0 : grid.y[k]; }
  [[nodiscard]] double column_x(std::size_t i) const { return is_column() ? 0 : grid.x[i]; }
  /// One of the diagram on it.
  struct Point {
    std::size_t i, j;  ///< thickness, spacing
    Vec2 at;           ///< on the page
  };
  [[nodiscard]] std::vector<Point> points() const {
    std::vector<Point> all;
    const PageMap to_page = map();
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (std::size_t i = 0; i < columns.size(); ++i)
        all.push_back({columns[i], rows[k], to_page({column_x(i), row_y(k)})});
    return all;
  }
  /// White margins about the grid, so that marks on its edge lie inside the frame.
  [[nodiscard]] PageMap map() const {
    const Vec2 low(grid.x.front(), grid.y.front()), high(grid.x.back(), grid.y.back());
    const Vec2 margin_px(is_column() ? 8 : 34, is_row() ? 8 : 26);
    const Vec2 inner = page.high - page.low - 2 * margin_px;
    const Vec2 margin = (high - low).cwiseQuotient(inner).cwiseProduct(margin_px);
    return {{low - margin, high + margin}, page};
  }
};

VOUSSOIR_INLINE InteractionPanel interaction_panel(const InteractionPicture& picture,
                                                   std::vector<std::size_t> columns,
                                                   std::vector<std::size_t> rows,
                                                   const ViewRect& page);

inline void draw_failed_mark(SvgCanvas& canvas, const Vec2& at) {
  canvas.circle(at, 7, {.fill = "white", .stroke = "#c8102e", .stroke_width = 2});
  draw_cross(canvas, at, 4.6, {.stroke = "#c8102e", .stroke_width = 2});
}
/// Rock that falls: what stands is told from a collapse by shape as well as by colour.
inline void draw_shedding_mark(SvgCanvas& canvas, const Vec2& at) {
  const SvgStyle style{.stroke = "#b45309", .stroke_width = 2};
  canvas.circle(at, 7, {.fill = "white", .stroke = "#b45309", .stroke_width = 2});
  canvas.line(at - Vec2(0, 4), at + Vec2(0, 4), style);
  canvas.line(at + Vec2(-3, 1), at + Vec2(0, 4), style);
  canvas.line(at + Vec2(3, 1), at + Vec2(0, 4), style);
}
inline void draw_missing_mark(SvgCanvas& canvas, const Vec2& at) {
  canvas.circle(at, 3.2, {.fill = "white", .stroke = "#666", .stroke_width = 1.2});
}

inline void draw_undecided_mark(SvgCanvas& canvas, const Vec2& at) {
  canvas.rectangle({at - Vec2(9, 9), at + Vec2(9, 9)},
                   {.fill = "#ffd400", .stroke = "#111", .stroke_width = 1.6});
  canvas.text(at + Vec2(0, 6), "?",
              {.size = 17, .anchor = TextAnchor::middle, .bold = true, .fill = "#111"});
}

/// About the mark of what became of it.
inline void draw_marginal_mark(SvgCanvas& canvas, const Vec2& at) {
  canvas.circle(at, 10.5, {.stroke = "#7a1fa2", .stroke_width = 1.8});
}

/// About the one that is recommended.
inline void draw_chosen_mark(SvgCanvas& canvas, const Vec2& at) {
  canvas.circle(at, 9, {.stroke = "#0b5d3b", .stroke_width = 3});
}

inline void draw_other_mark(SvgCanvas& canvas, const Vec2& at) {
  const SvgStyle style{.stroke = "#b45309", .stroke_width = 2};
  const Vec2 corners[4] = {at + Vec2(9, 0), at + Vec2(0, 9), at - Vec2(9, 0), at - Vec2(0, 9)};
  for (int k = 0; k < 4; ++k) canvas.line(corners[k], corners[(k + 1) % 4], style);
}

VOUSSOIR_INLINE void draw_interaction_panel(SvgCanvas& canvas, const InteractionPicture& picture,
                                            const InteractionPanel& panel,
                                            const ContourBands& bands);

/// What a design says to who points at it.
[[nodiscard]] VOUSSOIR_INLINE std::string words_of(const InteractionPicture& picture,
                                                   std::size_t thickness, std::size_t spacing);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::string words_of(const InteractionPicture& picture, std::size_t thickness,
                                     std::size_t spacing) {
  const InteractionPicture::Spacing& bolts = picture.spacings[spacing];
  const InteractionQuantity shown = picture.shown();
  const double value = picture.at(thickness, spacing);
  const double lining = picture.thicknesses[thickness];
  std::string words =
      (bolts.value ? "bolts " : "") + bolts.label +
      (lining > 0 ? ", lining " + trimmed_text(100 * lining, 2) + " cm" : ", no lining");
  if (std::isfinite(value))
    words +=
        "\n" + shown.name + " " + printed_text(value * shown.point_scale) + " " + shown.point_unit;
  if (picture.is_undecided(thickness, spacing))
    words += "\nundecided: no result";
  else if (picture.is_shedding(thickness, spacing))
    words += "\nrock falls, the rest stands";
  else if (picture.is_failed(thickness, spacing))
    words += "\n" + (picture.collapsed.size() > 0 ? "it does not stand" : picture.failed_name);
  else if (picture.is_assumed(thickness, spacing))
    words += "\nnot computed";
  if (picture.chosen == std::pair(thickness, spacing)) words += "\nrecommended";
  if (picture.is_marginal(thickness, spacing)) words += "\nmarginal: limits and rates decide";
  return words;
}

VOUSSOIR_INLINE InteractionPanel interaction_panel(const InteractionPicture& picture,
                                                   std::vector<std::size_t> columns,
                                                   std::vector<std::size_t> rows,
                                                   const ViewRect& page) {
  InteractionPanel panel{std::move(columns), std::move(rows), {}, page};
  // A strip has one value across it.
  const std::size_t across = panel.is_column() ? 2 : panel.columns.size(),
                    up = panel.is_row() ? 2 : panel.rows.size();
  const auto column = [&](std::size_t i) { return panel.columns[panel.is_column() ? 0 : i]; };
  const auto row = [&](std::size_t k) { return panel.rows[panel.is_row() ? 0 : k]; };
  const auto edge = [](std::size_t k) { return k == 0 ? -1.0 : 1.0; };
  for (std::size_t i = 0; i < across; ++i)
    panel.grid.x.push_back(panel.is_column() ? edge(i) : picture.thicknesses[column(i)]);
  for (std::size_t k = 0; k < up; ++k)
    panel.grid.y.push_back(panel.is_row() ? edge(k) : *picture.spacings[row(k)].value);
  const double scale = picture.shown().contour_scale;
  panel.grid.value.resize(static_cast<Eigen::Index>(across), static_cast<Eigen::Index>(up));
  for (std::size_t i = 0; i < across; ++i)
    for (std::size_t k = 0; k < up; ++k)
      panel.grid.value(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          picture.at(column(i), row(k)) * scale;
  return panel;
}

VOUSSOIR_INLINE void draw_interaction_panel(SvgCanvas& canvas, const InteractionPicture& picture,
                                            const InteractionPanel& panel,
                                            const ContourBands& bands) {
  const PageMap map = panel.map();
  const TextStyle small{.size = 11.5, .anchor = TextAnchor::middle, .fill = "#222", .halo = true};
  const InteractionQuantity shown = picture.shown();
  TakenPlaces taken;
  struct Label {
    Vec2 at;
    std::string text;
  };
  std::vector<Label> labels;
  using Point = InteractionPanel::Point;
  const std::vector<Point> points = panel.points();
  for (const Point& point : points) taken.take({point.at - Vec2(9, 9), point.at + Vec2(9, 9)});
  const TextStyle beside{.size = 11.5, .bold = true, .fill = "#8a3f06", .halo = true};
  std::vector<std::pair<Vec2, std::string>> others;  // place of the mark, text beside it
  const auto within = [](double x, const std::vector<double>& axis) {
    return x >= axis.front() && x <= axis.back();
  };
  if (!panel.is_row() && !panel.is_column())
    for (const InteractionPicture::Other& other : picture.others) {
      if (!within(other.thickness, panel.grid.x) || !within(other.spacing, panel.grid.y)) continue;
      const Vec2 at = map({other.thickness, other.spacing});
      const std::string value = std::isfinite(other.value)
                                    ? printed_text(other.value * shown.point_scale)
                                    : "blocks detach";
      others.emplace_back(at, other.label + ": " + value);
      taken.take(text_room(at + Vec2(13, 4), others.back().second, beside).grown(2));
    }
  for (const Point& point : points) {
    const double value = picture.at(point.i, point.j);
    if (!std::isfinite(value)) continue;
    const std::string text = printed_text(value * shown.point_scale);
    const double up = picture.is_marginal(point.i, point.j) ? 14
                      : picture.is_failed(point.i, point.j) ? 12
                                                            : 11;
    for (const double shift : {-up, up + 9}) {  // above the point, else below, else nowhere
      const Vec2 at = point.at + Vec2(0, shift);
      if (const ViewRect room = text_room(at, text, small).grown(-1.5); taken.is_free(room)) {
        taken.take(room);
        labels.push_back({at, text});
        break;
      }
    }
  }
  std::string layer = "contours";
  if (panel.is_row()) layer = "row-" + std::to_string(panel.rows[0]);
  if (panel.is_column()) layer += "-column-" + std::to_string(panel.columns[0]);
  canvas.begin_layer(layer);
  draw_contours(canvas, panel.grid, map, bands, taken, shown.contour_mark);
  for (const Point& point : points) {
    if (picture.is_undecided(point.i, point.j)) {
      draw_undecided_mark(canvas, point.at);
    } else if (picture.is_shedding(point.i, point.j)) {
      draw_shedding_mark(canvas, point.at);
    } else if (picture.is_failed(point.i, point.j)) {
      draw_failed_mark(canvas, point.at);
    } else if (std::isfinite(picture.at(point.i, point.j)) &&
               !picture.is_assumed(point.i, point.j)) {
      canvas.circle(point.at, 3, {.fill = "#111"});
    } else {
      draw_missing_mark(canvas, point.at);
    }
    if (picture.is_marginal(point.i, point.j)) draw_marginal_mark(canvas, point.at);
    if (picture.chosen == std::pair(point.i, point.j)) draw_chosen_mark(canvas, point.at);
  }
  for (const Label& label : labels) canvas.text(label.at, label.text, small);
  for (const auto& [at, text] : others) {
    draw_other_mark(canvas, at);
    canvas.text(at + Vec2(13, 4), text, beside);
  }
  canvas.rectangle(panel.page, {.stroke = "#111"});
  double last_y = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; panel.has_labels && k < panel.rows.size(); ++k) {  // upwards
    const double y = map({0, panel.row_y(k)}).y(), left = panel.page.low.x();
    canvas.line({left - 5, y}, {left, y}, {.stroke = "#111"});
    if (last_y - y < 14) continue;  // rows closer than the letters are high
    canvas.text({left - 9, y + 4.5}, picture.spacings[panel.rows[k]].label,
                {.anchor = TextAnchor::end});
    last_y = y;
  }
  canvas.end_layer();
}

#endif

}  // namespace voussoir::detail
