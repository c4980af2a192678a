// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>

namespace voussoir {

/// A colour of the screen (sRGB, 0 to 255 a channel).
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend bool operator==(const Colour&, const Colour&) = default;

  /// "#rrggbb"
  [[nodiscard]] std::string hex() const {
    constexpr char digits[] = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t channel : {red, green, blue}) {
      text += digits[channel / 16];
      text += digits[channel % 16];
    }
    return text;
  }
};

/// A colour as the eye orders it: lightness and two opponent axes (green-red, blue-yellow).
/// Source: B. Ottosson (2020), "A perceptual color space for image processing" (OKLab).
struct PerceptualColour {
  double lightness = 0;  ///< 0 black to 1 white
  double a = 0, b = 0;
};

namespace detail {
inline double srgb_to_linear(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
inline double linear_to_srgb(double c) {
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}
}  // namespace detail

[[nodiscard]] VOUSSOIR_INLINE PerceptualColour perceptual(const Colour& colour);

/// The nearest screen colour; channels outside the screen's range are cut off.
[[nodiscard]] VOUSSOIR_INLINE Colour screen_colour(const PerceptualColour& colour);

/// Colours in an order that the eye, a photocopier and a colour-blind reader all see: the
/// lightness runs evenly from the first colour to the last, only the hue follows those between.
class ColourMap {
 public:
  /// @param anchors  two or more, evenly spaced from 0 to 1; the lightness of the inner ones is
  ///                 replaced
  explicit ColourMap(const std::vector<Colour>& anchors) {
    for (const Colour& colour : anchors) anchors_.push_back(perceptual(colour));
    while (anchors_.size() < 2) anchors_.push_back({});
    const double first = anchors_.front().lightness, last = anchors_.back().lightness;
    for (std::size_t i = 0; i < anchors_.size(); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(anchors_.size() - 1);
      anchors_[i].lightness = first + t * (last - first);
    }
  }

  /// Pale straw over green to blue. Never darker than half: black and red lines on it stay clear.
  [[nodiscard]] static ColourMap straw_to_blue() {
    return ColourMap({{253, 250, 226}, {205, 228, 170}, {120, 190, 170}, {62, 118, 178}});
  }
  /// Dark violet over green to yellow, in the manner of viridis: for pictures without lines.
  [[nodiscard]] static ColourMap violet_to_yellow() {
    return ColourMap({{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}});
  }

  /// @param t  0 to 1, cut off outside; NaN gives a neutral grey
  [[nodiscard]] Colour operator()(double t) const {
    if (std::isnan(t)) return {190, 190, 190};
    const double position = std::clamp(t, 0.0, 1.0) * static_cast<double>(anchors_.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(position), anchors_.size() - 2);
    const double f = position - static_cast<double>(i);
    const PerceptualColour &p = anchors_[i], &q = anchors_[i + 1];
    return screen_colour({p.lightness + f * (q.lightness - p.lightness), p.a + f * (q.a - p.a),
                          p.b + f * (q.b - p.b)});
  }

 private:
  std::vector<PerceptualColour> anchors_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE PerceptualColour perceptual(const Colour& colour) {
  const double r = detail::srgb_to_linear(colour.red / 255.0);
  const double g = detail::srgb_to_linear(colour.green / 255.0);
  const double b = detail::srgb_to_linear(colour.blue / 255.0);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

VOUSSOIR_INLINE Colour screen_colour(const PerceptualColour& colour) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(colour.lightness + 0.3963377774 * colour.a + 0.2158037573 * colour.b);
  const double m = cube(colour.lightness - 0.1055613458 * colour.a - 0.0638541728 * colour.b);
  const double s = cube(colour.lightness - 0.0894841775 * colour.a - 1.2914855480 * colour.b);
  const auto channel = [](double linear) {
    const double value = detail::linear_to_srgb(std::clamp(linear, 0.0, 1.0));
    return static_cast<std::uint8_t>(std::lround(255 * value));
  };
  return {channel(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          channel(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          channel(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

#endif

}  // namespace voussoir
