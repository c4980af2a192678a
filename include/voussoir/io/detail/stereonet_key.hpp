// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/detail/stereonet_layers.hpp>
#include <voussoir/rockmass/orientation_sets.hpp>

namespace voussoir {

/// "dip 45\u00B0 towards 270\u00B0", to whole degrees.
[[nodiscard]] VOUSSOIR_INLINE std::string dip_text(const Orientation& plane);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::string dip_text(const Orientation& plane) {
  return "dip " + detail::whole_degrees(plane.dip, 1) + " towards " +
         detail::whole_degrees(plane.dip_direction, 3);
}

#endif

namespace detail {

/// What stands beside a stereonet.
struct StereonetKey {
  std::vector<const FittedSet*> sets;
  std::size_t planes = 0, of_no_set = 0;
  std::vector<double> levels;  ///< times uniform
  double concentration = 0;    ///< k of the density [-]
  std::optional<LineOrientation> tunnel;
};

/// @param canvas  none: nothing is drawn
/// @param corner  upper left
/// @return  height [px]
VOUSSOIR_INLINE double draw_key(SvgCanvas* canvas, const StereonetKey& key, const Vec2& corner,
                                double width);

#if VOUSSOIR_BODIES

/// Writes one line below the other.
class KeyColumn {
 public:
  KeyColumn(SvgCanvas* canvas, const Vec2& corner, double width)
      : canvas_(canvas), corner_(corner), width_(width) {}

  [[nodiscard]] double height() const { return y_; }
  void skip(double by) { y_ += by; }
  void rule() {
    if (canvas_ != nullptr)
      canvas_->line(corner_ + Vec2(0, y_), corner_ + Vec2(width_, y_), {.stroke = "#999"});
  }
  /// Text at `x`, or ending there, on the line that ends at the present height.
  void text(double x, const std::string& words, const TextStyle& style = {}) {
    if (canvas_ != nullptr) canvas_->text(corner_ + Vec2(x, y_ - 5), words, style);
  }
  void paragraph(double x, const std::string& words, const TextStyle& style = {}) {
    for (const std::string& line : wrapped_lines(words, width_ - x, style)) {
      skip(1.4 * style.size);
      text(x, line, style);
    }
  }
  /// A sample left of the line that ends `below` the present height.
  template <class Draw>
  void sample(double below, const Draw& draw) {
    if (canvas_ != nullptr) draw(*canvas_, Vec2(corner_ + Vec2(13, y_ + below - 9.5)));
  }
  [[nodiscard]] SvgCanvas* canvas() { return canvas_; }
  [[nodiscard]] Vec2 at(double x) const { return corner_ + Vec2(x, y_); }
  [[nodiscard]] double width() const { return width_; }

 private:
  SvgCanvas* canvas_;
  Vec2 corner_;
  double width_, y_ = 0;
};

VOUSSOIR_INLINE void draw_set_table(KeyColumn& column, const StereonetKey& key) {
  constexpr double indent = 34, of_k = 62;
  const TextStyle right{.anchor = TextAnchor::end}, grey{.fill = "#444"};
  const TextStyle grey_right{.anchor = TextAnchor::end, .fill = "#444"};
  column.skip(16);
  column.text(0, "set, mean plane \u00B1 95 % cone", grey);
  column.text(column.width() - of_k, "K", grey_right);
  column.text(column.width(), "planes", grey_right);
  column.skip(2);
  column.rule();
  column.skip(4);
  for (std::size_t k = 0; k < key.sets.size(); ++k) {
    const FittedSet& fit = *key.sets[k];
    const int set = static_cast<int>(k);
    column.sample(
        28, [&](SvgCanvas& canvas, const Vec2& at) { draw_mean_marker(canvas, set, at, 7.5); });
    const TextStyle bold{.size = 14.5, .bold = true, .fill = line_colour(set).hex()};
    const std::string name =
        fit.name.size() > 18 ? std::to_string(k + 1) + ": " + fit.name : fit.name;
    bool is_first = true;
    for (const std::string& line : wrapped_lines(name, column.width() - indent - of_k - 40, bold)) {
      column.skip(20);
      column.text(indent, line, bold);
      if (!is_first) continue;
      is_first = false;
      column.text(column.width() - of_k,
                  fit.concentration ? readable_text(*fit.concentration, 2) : "\u2013", right);
      column.text(column.width(), std::to_string(fit.count), right);
    }
    column.skip(19);
    column.text(
        indent,
        dip_text(fit.mean) +
            (fit.cone_95
                 ? " \u00B1 " + readable_text(*fit.cone_95 * 180 / std::numbers::pi, 2) + "\u00B0"
                 : std::string()));
    column.skip(6);
  }
  column.rule();
}

VOUSSOIR_INLINE void draw_density_scale(KeyColumn& column, const StereonetKey& key) {
  column.paragraph(0, "pole density, multiples of uniform");
  column.skip(8);
  const double count = static_cast<double>(key.levels.size());
  const double step = std::min(46.0, (column.width() - 20) / count);
  for (std::size_t k = 0; k < key.levels.size(); ++k) {
    const double x = step * static_cast<double>(k);
    if (column.canvas() == nullptr) break;
    column.canvas()->rectangle({column.at(x), column.at(x + step) + Vec2(0, 14)},
                               {.fill = density_colour(k, key.levels.size()).hex(),
                                .stroke = "#8f8c85",
                                .stroke_width = 0.6});
    column.canvas()->text(column.at(x) + Vec2(0, 29), trimmed_text(key.levels[k], 1),
                          {.anchor = k == 0 ? TextAnchor::start : TextAnchor::middle});
  }
  column.skip(44);
}

VOUSSOIR_INLINE double draw_key(SvgCanvas* canvas, const StereonetKey& key, const Vec2& corner,
                                double width) {
  constexpr double indent = 34;
  KeyColumn column(canvas, corner, width);
  if (!key.sets.empty()) draw_set_table(column, key);
  column.skip(8);
  const auto item = [&](const std::string& words, const auto& sample) {
    column.sample(18, sample);
    column.paragraph(indent, words);
    column.skip(5);
  };
  if (!key.sets.empty())
    item("great circle of the mean plane; its pole as in the table",
         [](SvgCanvas& c, const Vec2& at) {
           c.line(at - Vec2(12, 0), at + Vec2(12, 0),
                  {.stroke = line_colour(0).hex(), .stroke_width = 2});
         });
  if (key.of_no_set > 0)
    item(key.sets.empty() ? "poles of planes" : "poles of planes of no set",
         [](SvgCanvas& c, const Vec2& at) {
           c.polygon(set_marker(-1, at, 3.6),
                     {.fill = set_colour(-1).hex(), .stroke = "#333", .stroke_width = 0.5});
         });
  if (key.tunnel) {
    const double plunge = key.tunnel->plunge;
    item("tunnel axis, trend " + whole_degrees(key.tunnel->trend, 3) +
             (plunge < 0 ? ", rising " : ", plunge ") + whole_degrees(std::abs(plunge), 1),
         [](SvgCanvas& c, const Vec2& at) { draw_axis_marker(c, at); });
    item("section across the axis", [](SvgCanvas& c, const Vec2& at) {
      c.line(at - Vec2(13, 0), at + Vec2(13, 0), section_line);
    });
  }
  if (!key.levels.empty()) {
    column.skip(8);
    draw_density_scale(column, key);
  }
  std::string note = "Lower hemisphere, equal area; " + std::to_string(key.planes) + " poles.";
  if (!key.levels.empty())
    note += " Density: Fisher's distribution with k = " + readable_text(key.concentration, 2) +
            " about each pole (Vollmer 1995).";
  column.paragraph(0, note, {.fill = "#444"});
  return column.height() + 6;
}

#endif

}  // namespace detail

}  // namespace voussoir
