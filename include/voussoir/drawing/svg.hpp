// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/drawing/xml_text.hpp>

namespace voussoir {

/// Outlines of any number of polygons and lines in one SVG path element.
///
/// Thousands of blocks of one colour are one element, written in steps relative to the last point:
/// a third of the size of separate polygons. Steps are taken between rounded positions, so that
/// rounding does not pile up along the path.
class SvgPath {
 public:
  /// @param decimals  of a pixel, 0 to 4
  explicit SvgPath(int decimals = 2) : unit_(std::pow(10.0, decimals)), decimals_(decimals) {}

  /// @throws InvalidInput  a coordinate is not finite
  void move_to(const Vec2& p) { go('m', p); }
  void line_to(const Vec2& p) { go('l', p); }
  void close() {
    data_ += 'z';
    last_ = start_;  // the pen returns to the first corner
    command_ = 'z';
  }

  void add_polyline(std::span<const Vec2> points) {
    for (std::size_t i = 0; i < points.size(); ++i)
      i == 0 ? move_to(points[i]) : line_to(points[i]);
  }
  void add_polygon(std::span<const Vec2> corners) {
    if (corners.empty()) return;
    add_polyline(corners);
    close();
  }
  void add_line(const Vec2& p, const Vec2& q) {
    move_to(p);
    line_to(q);
  }

  [[nodiscard]] bool empty() const { return data_.empty(); }
  [[nodiscard]] const std::string& data() const { return data_; }

 private:
  void go(char command, const Vec2& p) {
    if (!p.allFinite()) throw InvalidInput("SvgPath: a coordinate is not finite");
    const Vec2 position(std::round(p.x() * unit_), std::round(p.y() * unit_));
    const bool is_first = data_.empty();  // a relative move from nowhere is absolute
    if (command == 'm') start_ = position;
    if (command == 'l' && position == last_) return;
    if (command != command_ || command == 'm') data_ += command;
    append(position.x() - (is_first ? 0 : last_.x()));
    append(position.y() - (is_first ? 0 : last_.y()));
    last_ = position;
    command_ = command;
  }
  void append(double steps) {
    std::string text = trimmed_text(steps / unit_, decimals_);
    if (text.starts_with("0.")) text.erase(0, 1);
    if (text.starts_with("-0.")) text.erase(1, 1);
    const char last = data_.back();
    if (last != 'm' && last != 'l' && text.front() != '-') data_ += ' ';
    data_ += text;
  }

  double unit_;
  int decimals_;
  char command_ = 'z';
  Vec2 last_ = zeros<Vec2>(), start_ = zeros<Vec2>();  ///< in rounded steps
  std::string data_;
};

/// How a shape is painted. Colours as in CSS ("#rrggbb", "black", "none", "url(#pattern)").
struct SvgStyle {
  std::string fill = "none";
  std::string stroke = "none";
  double stroke_width = 1;  ///< [px]
  std::string dash = {};    ///< lengths of dashes and gaps [px], "6 3"; empty: solid
  double opacity = 1;
  bool round_ends = false;
};

enum class TextAnchor { start, middle, end };

/// How a text is set: always in the reader's sans-serif font.
struct TextStyle {
  double size = 13;  ///< [px]
  TextAnchor anchor = TextAnchor::start;
  bool bold = false;
  std::string fill = "#111";
  double rotation = 0;  ///< [degrees], clockwise on the page about the anchor
  bool halo = false;    ///< white rim, for text on a picture
};

/// Room that a text takes [px]. Fonts differ by a fifth; this is for a wide one (DejaVu Sans).
[[nodiscard]] VOUSSOIR_INLINE double text_width(std::string_view text, const TextStyle& style);

/// A page in Scalable Vector Graphics. Coordinates in px from the top left corner, y down; use a
/// PageMap for world coordinates. Elements appear in the order of the calls, later ones on top.
class SvgCanvas {
 public:
  /// @param width, height  of the page [px], > 0
  /// @param printed_width  on paper [mm]
  /// @param title          shown by browsers and read out to the blind
  SvgCanvas(double width, double height, double printed_width, std::string_view title) {
    const double mm = printed_width / width;
    text_ = R"(<?xml version="1.0" encoding="UTF-8"?>)"
            "\n"
            R"(<svg xmlns="http://www.w3.org/2000/svg" )"
            R"(xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width=")" +
            trimmed_text(width * mm, 2) + R"(mm" height=")" + trimmed_text(height * mm, 2) +
            R"(mm" viewBox="0 0 )" + trimmed_text(width, 2) + ' ' + trimmed_text(height, 2) +
            R"(" font-family="sans-serif" stroke-linejoin="round">)"
            "\n<title>" +
            xml_escaped(title) + "</title>\n";
    rectangle({zeros<Vec2>(), Vec2(width, height)}, {.fill = "white"});
  }

  /// A named layer, which a drawing program can hide. Layers may lie in layers.
  /// @param clip  name of a `clip_rectangle`; empty: nothing is cut off
  void begin_layer(std::string_view id, std::string_view clip = {}) {
    text_ += "<g id=\"" + xml_escaped(id) + "\" inkscape:groupmode=\"layer\" inkscape:label=\"" +
             xml_escaped(id) + '"';
    if (!clip.empty()) text_ += " clip-path=\"url(#" + xml_escaped(clip) + ")\"";
    text_ += ">\n";
    ++open_layers_;
  }
  /// @throws std::logic_error  no layer is open
  void end_layer() {
    if (open_layers_ == 0) throw std::logic_error("SvgCanvas: end_layer without begin_layer");
    text_ += "</g>\n";
    --open_layers_;
  }
  /// Begins a layer of places that say something to a reader who points at them. Nothing of it is
  /// drawn; `end_layer` ends it. Later places lie on top.
  void begin_spots() {
    text_ +=
        "<g id=\"spots\" inkscape:groupmode=\"layer\" inkscape:label=\"spots\" fill=\"none\" "
        "pointer-events=\"all\">\n";
    ++open_layers_;
  }
  /// @param says  plain; more than one line if it has line breaks
  void spot(std::span<const Vec2> corners, std::string_view says) {
    SvgPath outline(1);
    outline.add_polygon(corners);
    write_spot(outline, says, "");
  }
  /// @param width  of what can be pointed at [px]
  void spot(const Vec2& p, const Vec2& q, double width, std::string_view says) {
    SvgPath line(1);
    line.add_line(p, q);
    write_spot(line, says, " stroke-width=\"" + trimmed_text(width, 1) + '"');
  }
  /// Names a rectangle outside which a layer is cut off.
  void clip_rectangle(std::string_view id, const ViewRect& rect) {
    text_ += "<clipPath id=\"" + xml_escaped(id) + "\">";
    rectangle(rect, {.fill = "black"});
    text_ += "</clipPath>\n";
  }
  /// Names a pattern of slanting lines, to be used as fill "url(#id)".
  void hatch_pattern(std::string_view id, std::string_view colour, double distance, double width) {
    const std::string d = trimmed_text(distance, 2);
    text_ += "<pattern id=\"" + xml_escaped(id) + "\" patternUnits=\"userSpaceOnUse\" width=\"" +
             d + "\" height=\"" + d + "\" patternTransform=\"rotate(45)\">";
    line(Vec2(distance / 2, 0), Vec2(distance / 2, distance),
         {.stroke = std::string(colour), .stroke_width = width});
    text_ += "</pattern>\n";
  }

  void path(const SvgPath& path, const SvgStyle& style) {
    if (!path.empty()) element("path", "d=\"" + path.data() + '"', style);
  }
  void polygon(std::span<const Vec2> corners, const SvgStyle& style) {
    SvgPath outline;
    outline.add_polygon(corners);
    path(outline, style);
  }
  void polyline(std::span<const Vec2> points, const SvgStyle& style) {
    SvgPath outline;
    outline.add_polyline(points);
    path(outline, style);
  }
  void line(const Vec2& p, const Vec2& q, const SvgStyle& style) {
    element("line", pair("x1", "y1", p) + ' ' + pair("x2", "y2", q), style);
  }
  void rectangle(const ViewRect& r, const SvgStyle& style) {
    element("rect", pair("x", "y", r.low) + ' ' + pair("width", "height", r.high - r.low), style);
  }
  void circle(const Vec2& centre, double radius, const SvgStyle& style) {
    element("circle", pair("cx", "cy", centre) + " r=\"" + trimmed_text(radius, 2) + '"', style);
  }

  /// @param at    the anchor, on the base line of the letters [px]
  /// @param utf8  any text; it is escaped here
  void text(const Vec2& at, std::string_view utf8, const TextStyle& style = {}) {
    if (style.halo) {  // two copies: not every program knows how to paint the rim first
      write_text(at, utf8, style, R"( stroke="white" stroke-width="3" fill="white")");
    }
    write_text(at, utf8, style, " fill=\"" + xml_escaped(style.fill) + '"');
  }

  /// The whole document.
  /// @throws std::logic_error  a layer is still open
  [[nodiscard]] std::string document() const {
    if (open_layers_ != 0) throw std::logic_error("SvgCanvas: a layer is still open");
    return text_ + "</svg>\n";
  }

 private:
  static std::string pair(std::string_view x_name, std::string_view y_name, const Vec2& p) {
    if (!p.allFinite()) throw InvalidInput("SvgCanvas: a coordinate is not finite");
    return std::string(x_name) + "=\"" + trimmed_text(p.x(), 2) + "\" " + std::string(y_name) +
           "=\"" + trimmed_text(p.y(), 2) + '"';
  }
  void element(std::string_view name, const std::string& geometry, const SvgStyle& style) {
    text_ += '<' + std::string(name) + ' ' + geometry + " fill=\"" + xml_escaped(style.fill) + '"';
    if (style.stroke != "none") {
      text_ += " stroke=\"" + xml_escaped(style.stroke) + "\" stroke-width=\"" +
               trimmed_text(style.stroke_width, 2) + '"';
      if (!style.dash.empty()) text_ += " stroke-dasharray=\"" + xml_escaped(style.dash) + '"';
      if (style.round_ends) text_ += " stroke-linecap=\"round\"";
    }
    if (style.opacity < 1) text_ += " opacity=\"" + trimmed_text(style.opacity, 2) + '"';
    text_ += "/>\n";
  }
  void write_spot(const SvgPath& outline, std::string_view says, const std::string& attributes) {
    if (outline.empty() || says.empty()) return;
    text_ += "<path d=\"" + outline.data() + '"' + attributes + "><title>" + xml_escaped(says) +
             "</title></path>\n";
  }
  void write_text(const Vec2& at, std::string_view utf8, const TextStyle& style,
                  const std::string& paint) {
    text_ += "<text " + pair("x", "y", at) + " font-size=\"" + trimmed_text(style.size, 2) + '"';
    if (style.anchor == TextAnchor::middle) text_ += " text-anchor=\"middle\"";
    if (style.anchor == TextAnchor::end) text_ += " text-anchor=\"end\"";
    if (style.bold) text_ += " font-weight=\"bold\"";
    if (style.rotation != 0) {
      text_ += " transform=\"rotate(" + trimmed_text(style.rotation, 2) + ' ' +
               trimmed_text(at.x(), 2) + ' ' + trimmed_text(at.y(), 2) + ")\"";
    }
    text_ += paint + '>' + xml_escaped(utf8) + "</text>\n";
  }

  std::string text_;
  int open_layers_ = 0;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE double text_width(std::string_view text, const TextStyle& style) {
  double width = 0;  // in units of the font size
  for (const char c : text) {
    if (static_cast<std::uint8_t>(c) >= 0x80 && static_cast<std::uint8_t>(c) < 0xC0) continue;
    const bool is_narrow =
        std::string_view(" .,:;'|!()[]/-ijltfrI").find(c) != std::string_view::npos;
    const bool is_wide = std::string_view("mwMW%@=+<>").find(c) != std::string_view::npos;
    const bool is_capital = c >= 'A' && c <= 'Z';
    width += is_narrow ? 0.38 : is_wide ? 0.94 : is_capital ? 0.71 : 0.635;
  }
  return width * style.size * (style.bold ? 1.12 : 1.0);
}

#endif

}  // namespace voussoir
