// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/drawing/colour_map.hpp>
#include <voussoir/drawing/round_ticks.hpp>
#include <voussoir/drawing/svg.hpp>

namespace voussoir {

// What the pictures share. Lengths on the page in px; a page is 1000 px wide and printed 190 mm
// wide, so that 13 px are 7 point, the smallest type that is read with ease.

inline constexpr double picture_width = 1000;         ///< [px]
inline constexpr double picture_printed_width = 190;  ///< [mm]
inline constexpr double picture_margin = 20;          ///< [px]

/// Breaks a text at blanks into lines that fit `width` [px]; a longer word stays whole.
[[nodiscard]] VOUSSOIR_INLINE std::vector<std::string> wrapped_lines(std::string_view text,
                                                                     double width,
                                                                     const TextStyle& style);

/// A number at the head of a picture: {"crown convergence", "12.4 mm"}.
struct KeyNumber {
  std::string name;
  std::string value;  ///< with its unit
};

/// Title, text and key numbers over the full width of a page.
struct PictureHeader {
  std::string title;
  std::vector<std::string> lines;  ///< the verdict in words; each is wrapped as needed
  std::vector<KeyNumber> key_numbers;

  static constexpr double inner_width = picture_width - 2 * picture_margin;

  [[nodiscard]] double height() const {
    return 14 + 27 * count(title, title_style()) + 19 * line_count() + key_row_count() * 48 + 8;
  }
  void draw(SvgCanvas& canvas) const {
    canvas.begin_layer("header");
    double y = 14;
    for (const std::string& line : wrapped_lines(title, inner_width, title_style())) {
      canvas.text({picture_margin, y + 20}, line, title_style());
      y += 27;
    }
    for (const std::string& paragraph : lines) {
      for (const std::string& line : wrapped_lines(paragraph, inner_width, {.size = 14.5})) {
        canvas.text({picture_margin, y + 14}, line, {.size = 14.5});
        y += 19;
      }
    }
    const double cell = inner_width / static_cast<double>(keys_per_row);
    for (std::size_t k = 0; k < key_numbers.size(); ++k) {
      const double x = picture_margin + cell * static_cast<double>(k % keys_per_row);
      const double top = y + 6 + 48 * std::floor(static_cast<double>(k) / keys_per_row);
      canvas.line({x, top + 2}, {x, top + 40}, {.stroke = "#2c5f8a", .stroke_width = 3});
      TextStyle large{.size = 18, .bold = true}, small{.fill = "#444"};
      for (const auto& [text, style] :
           {std::pair{&key_numbers[k].value, &large}, std::pair{&key_numbers[k].name, &small}}) {
        style->size *= std::min(1.0, (cell - 18) / std::max(1.0, text_width(*text, *style)));
        canvas.text({x + 9, top + (style->bold ? 19 : 37)}, *text, *style);
      }
    }
    canvas.end_layer();
  }

 private:
  static constexpr std::size_t keys_per_row = 5;
  static TextStyle title_style() { return {.size = 22, .bold = true}; }
  static double count(const std::string& text, const TextStyle& style) {
    return static_cast<double>(wrapped_lines(text, inner_width, style).size());
  }
  [[nodiscard]] double line_count() const {
    double sum = 0;
    for (const std::string& line : lines) sum += count(line, {.size = 14.5});
    return sum;
  }
  [[nodiscard]] double key_row_count() const {
    return std::ceil(static_cast<double>(key_numbers.size()) / keys_per_row);
  }
};

/// A word across a picture that must not be taken for that of a sound tunnel.
struct PictureBanner {
  std::string word;                ///< "UNDECIDED"
  std::string line;                ///< what that means, in one line
  std::string colour = "#c8102e";  ///< of the band, dark enough for white letters

  static constexpr double height = 54;  ///< [px]

  /// A band over the full width of a frame, and the frame in its colour.
  /// @param top  of the band on the page [px]
  void draw(SvgCanvas& canvas, const ViewRect& frame, double top) const {
    canvas.begin_layer("banner");
    canvas.rectangle(frame, {.stroke = colour, .stroke_width = 5});
    canvas.rectangle({{frame.low.x(), top}, {frame.high.x(), top + height}}, {.fill = colour});
    TextStyle large{.size = 25, .anchor = TextAnchor::middle, .bold = true, .fill = "white"};
    TextStyle small{.size = 14.5, .anchor = TextAnchor::middle, .fill = "white"};
    const double x = frame.centre().x(), room = frame.width() - 20;
    large.size *= std::min(1.0, room / std::max(1.0, text_width(word, large)));
    small.size *= std::min(1.0, room / std::max(1.0, text_width(line, small)));
    canvas.text({x, top + (line.empty() ? 36 : 28)}, word, large);
    if (!line.empty()) canvas.text({x, top + 46}, line, small);
    canvas.end_layer();
  }
};

/// One sample with its explanation.
struct LegendItem {
  std::string text;
  std::function<void(SvgCanvas&, const Vec2&)> draw_sample;  ///< about a point, within 26 x 14 px
  double extra_width = 0;  ///< of a sample that reaches further to the right [px]
};

/// Samples in rows from left to right.
class Legend {
 public:
  Legend(std::vector<LegendItem> items, double width) : items_(std::move(items)) {
    double x = 0, y = 0;
    for (const LegendItem& item : items_) {
      const double needed = sample_width + item.extra_width + text_width(item.text, {}) + 14;
      if (x > 0 && x + needed > width) {
        x = 0;
        y += row_height;
      }
      places_.emplace_back(x, y);
      x += needed;
    }
    height_ = items_.empty() ? 0 : y + row_height;
  }
  [[nodiscard]] double height() const { return height_; }
  /// @param corner  upper left
  void draw(SvgCanvas& canvas, const Vec2& corner) const {
    canvas.begin_layer("legend");
    for (std::size_t i = 0; i < items_.size(); ++i) {
      const Vec2 middle = corner + places_[i] + Vec2(14, row_height / 2);
      items_[i].draw_sample(canvas, middle);
      canvas.text(middle + Vec2(20 + items_[i].extra_width, 4.5), items_[i].text);
    }
    canvas.end_layer();
  }

 private:
  static constexpr double row_height = 22, sample_width = 34;
  std::vector<LegendItem> items_;
  std::vector<Vec2> places_;
  double height_ = 0;
};

/// A scale of lengths: black and white like a map's, labelled in metres.
/// @param left      end of the bar on its lower edge
/// @param room      greatest length of the bar
VOUSSOIR_INLINE void draw_scale_bar(SvgCanvas& canvas, const Vec2& left, double room,
                                    double px_per_metre);

/// A shape in a few px.
inline void draw_cross(SvgCanvas& canvas, const Vec2& centre, double half_size,
                       const SvgStyle& style) {
  SvgPath path;
  path.add_line(centre - Vec2::Constant(half_size), centre + Vec2::Constant(half_size));
  path.add_line(centre + Vec2(-half_size, half_size), centre + Vec2(half_size, -half_size));
  canvas.path(path, style);
}
inline void draw_diamond(SvgCanvas& canvas, const Vec2& centre, double half_size,
                         const SvgStyle& style) {
  const std::vector<Vec2> corners = {centre - Vec2(half_size, 0), centre - Vec2(0, half_size),
                                     centre + Vec2(half_size, 0), centre + Vec2(0, half_size)};
  canvas.polygon(corners, style);
}

/// A slender triangle, 8 px long.
/// @param along  unit length
inline void draw_arrow_head(SvgCanvas& canvas, const Vec2& tip, const Vec2& along,
                            const char* colour) {
  const std::vector<Vec2> corners = {tip, tip - 8 * along + 3 * perpendicular(along),
                                     tip - 8 * along - 3 * perpendicular(along)};
  canvas.polygon(corners, {.fill = colour});
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<std::string> wrapped_lines(std::string_view text, double width,
                                                       const TextStyle& style) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string word(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string longer = lines.back().empty() ? word : lines.back() + ' ' + word;
    if (lines.back().empty() || text_width(longer, style) <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

VOUSSOIR_INLINE void draw_scale_bar(SvgCanvas& canvas, const Vec2& left, double room,
                                    double px_per_metre) {
  const double metres = round_down_125(room / px_per_metre), length = metres * px_per_metre;
  const ViewRect bar{left - Vec2(0, 7), left + Vec2(length, 0)};
  canvas.rectangle(bar, {.fill = "white", .stroke = "#111"});
  canvas.rectangle({bar.low, {bar.centre().x(), bar.high.y()}}, {.fill = "#111"});
  canvas.text(left + Vec2(0, 17), "0", {.anchor = TextAnchor::middle});
  canvas.text(left + Vec2(length, 17), trimmed_text(metres, 3) + " m",
              {.anchor = TextAnchor::middle});
}

#endif

}  // namespace voussoir
