// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/colour_map.hpp>
#include <voussoir/drawing/contour.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/detail/equal_area_net.hpp>
#include <voussoir/io/detail/label_places.hpp>
#include <voussoir/io/detail/mass_layers.hpp>
#include <voussoir/rockmass/orientation.hpp>
#include <voussoir/rockmass/orientation_sets.hpp>

namespace voussoir {

/// How a line lies in 3-D, as a geologist's compass reads it.
struct LineOrientation {
  double trend;   ///< azimuth of its horizontal projection, clockwise from North [rad], 0 to 2 pi
  double plunge;  ///< below the horizontal [rad], -pi/2 to pi/2
};

namespace detail {

/// Planes with the sets that a picture of so many colours them by.
[[nodiscard]] VOUSSOIR_INLINE std::vector<SurveyedPlane> planes_by_set(
    std::vector<SurveyedPlane> planes, std::size_t sets);

/// "045\u00B0": whole degrees, at least so many digits; 360 is 000.
[[nodiscard]] VOUSSOIR_INLINE std::string whole_degrees(double angle, std::size_t digits);

/// A mark whose shape tells sets apart where colours do not print.
[[nodiscard]] VOUSSOIR_INLINE std::vector<Vec2> set_marker(int set, const Vec2& at, double size);

/// Darker, for lines and letters on a light ground.
[[nodiscard]] VOUSSOIR_INLINE Colour line_colour(int set);

/// Of the level number k of n.
[[nodiscard]] VOUSSOIR_INLINE Colour density_colour(std::size_t k, std::size_t n);

VOUSSOIR_INLINE void draw_density(SvgCanvas& canvas, std::span<const Contour> contours,
                                  const NetFrame& net);
/// The rim with its marks, white beyond.
VOUSSOIR_INLINE void draw_rim(SvgCanvas& canvas, const NetFrame& net);
VOUSSOIR_INLINE void draw_poles(SvgCanvas& canvas, std::span<const SurveyedPlane> planes,
                                const NetFrame& net, LabelPlaces& places);
VOUSSOIR_INLINE void draw_mean(SvgCanvas& canvas, const FittedSet& fit, int set,
                               const NetFrame& net, LabelPlaces& places);
VOUSSOIR_INLINE void draw_mean_marker(SvgCanvas& canvas, int set, const Vec2& at, double size);
VOUSSOIR_INLINE void draw_tunnel(SvgCanvas& canvas, const LineOrientation& tunnel,
                                 const NetFrame& net, LabelPlaces& places);
VOUSSOIR_INLINE void draw_axis_marker(SvgCanvas& canvas, const Vec2& at);

inline const SvgStyle section_line{.stroke = "#111", .stroke_width = 1.6, .dash = "7 4"};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<SurveyedPlane> planes_by_set(std::vector<SurveyedPlane> planes,
                                                         std::size_t sets) {
  const bool is_named =
      std::any_of(planes.begin(), planes.end(), [](const SurveyedPlane& p) { return p.set >= 0; });
  for (SurveyedPlane& surveyed : planes)
    surveyed.set = sets == 0 ? -1 : sets == 1 && !is_named ? 0 : std::max(surveyed.set, -1);
  return planes;
}

VOUSSOIR_INLINE std::string whole_degrees(double angle, std::size_t digits) {
  const std::string text = std::to_string(std::lround(angle * 180 / std::numbers::pi) % 360);
  return std::string(digits - std::min(digits, text.size()), '0') + text + "\u00B0";
}

VOUSSOIR_INLINE std::vector<Vec2> set_marker(int set, const Vec2& at, double size) {
  struct Shape {
    int corners;
    double first, size;  ///< angle of a corner from the right [rad]; for about the same area
  };
  constexpr double pi = std::numbers::pi;
  constexpr Shape shapes[] = {
      {16, 0, 1}, {4, 0.25 * pi, 1.25}, {3, -0.5 * pi, 1.5}, {4, 0, 1.3}, {3, 0.5 * pi, 1.5}};
  const Shape& shape = shapes[set < 0 ? 0 : set % 5];
  std::vector<Vec2> corners;
  for (int k = 0; k < shape.corners; ++k) {
    const double angle = shape.first + 2 * pi * k / shape.corners;
    corners.push_back(at + size * shape.size * Vec2(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

VOUSSOIR_INLINE Colour line_colour(int set) {
  const auto darker = [](int channel) { return static_cast<std::uint8_t>(0.68 * channel); };
  const Colour colour = set_colour(set);
  return {darker(colour.red), darker(colour.green), darker(colour.blue)};
}

VOUSSOIR_INLINE Colour density_colour(std::size_t k, std::size_t n) {
  static const ColourMap greys({{239, 237, 231}, {158, 156, 150}});
  return greys(n < 2 ? 0 : static_cast<double>(k) / static_cast<double>(n - 1));
}

VOUSSOIR_INLINE void draw_density(SvgCanvas& canvas, std::span<const Contour> contours,
                                  const NetFrame& net) {
  for (std::size_t k = 0; k < contours.size(); ++k) {
    SvgPath region;
    for (const std::vector<Vec2>& outline : contours[k].region) {
      std::vector<Vec2> corners;
      for (const Vec2& point : outline) corners.push_back(net(point));
      region.add_polygon(corners);
    }
    canvas.path(region, {.fill = density_colour(k, contours.size()).hex(),
                         .stroke = "#8f8c85",
                         .stroke_width = 0.6});
  }
}

VOUSSOIR_INLINE void draw_rim(SvgCanvas& canvas, const NetFrame& net) {
  constexpr double pi = std::numbers::pi, beyond = 1.05;
  const auto at = [&](double azimuth, double r) {
    return net(r * Vec2(std::sin(azimuth), std::cos(azimuth)));
  };
  // Circle and square turn opposite ways: what is between them is filled.
  SvgPath ring;
  std::vector<Vec2> circle;
  for (int k = 0; k < 240; ++k) circle.push_back(at(2 * pi * k / 240, 1));
  ring.add_polygon(circle);
  ring.add_polygon(std::vector<Vec2>{net({-beyond, beyond}), net({-beyond, -beyond}),
                                     net({beyond, -beyond}), net({beyond, beyond})});
  canvas.path(ring, {.fill = "white"});
  canvas.circle(net.centre, net.radius, {.stroke = "#111", .stroke_width = 1.5});
  SvgPath ticks;
  for (int k = 0; k < 36; ++k) {
    const double length = k % 9 == 0 ? 10 : k % 3 == 0 ? 7 : 4;
    ticks.add_line(at(k * pi / 18, 1), at(k * pi / 18, 1 + length / net.radius));
  }
  ticks.add_line(net.centre - Vec2(5, 0), net.centre + Vec2(5, 0));
  ticks.add_line(net.centre - Vec2(0, 5), net.centre + Vec2(0, 5));
  canvas.path(ticks, {.stroke = "#111"});
  const TextStyle middle{.size = 16, .anchor = TextAnchor::middle, .bold = true};
  const double r = net.radius;
  canvas.text(net.centre + Vec2(0, -r - 14), "N", middle);
  canvas.text(net.centre + Vec2(0, r + 26), "S", middle);
  canvas.text(net.centre + Vec2(r + 21, 6), "E", middle);
  canvas.text(net.centre + Vec2(-r - 21, 6), "W", middle);
}

VOUSSOIR_INLINE void draw_poles(SvgCanvas& canvas, std::span<const SurveyedPlane> planes,
                                const NetFrame& net, LabelPlaces& places) {
  const double size = planes.size() <= 300 ? 3.6 : planes.size() <= 800 ? 2.6 : 1.7;
  int sets = 0;
  for (const SurveyedPlane& surveyed : planes) sets = std::max(sets, surveyed.set + 1);
  std::vector<SvgPath> paths(static_cast<std::size_t>(sets) + 1);
  std::set<std::tuple<int, long, long>> drawn;  // marks half a pixel apart are one
  for (const SurveyedPlane& surveyed : planes) {
    const Vec2 at = net(equal_area_point(upward_normal(surveyed.plane)));
    if (!drawn.emplace(surveyed.set, std::lround(2 * at.x()), std::lround(2 * at.y())).second)
      continue;
    places.keep_off_point(at);
    paths[static_cast<std::size_t>(surveyed.set + 1)].add_polygon(
        set_marker(surveyed.set, at, size));
  }
  for (int set = -1; set < sets; ++set)
    canvas.path(paths[static_cast<std::size_t>(set + 1)],
                {.fill = set_colour(set).hex(), .stroke = "#333", .stroke_width = 0.5});
}

VOUSSOIR_INLINE void draw_mean_marker(SvgCanvas& canvas, int set, const Vec2& at, double size) {
  canvas.polygon(set_marker(set, at, size), {.stroke = "white", .stroke_width = 5});
  canvas.polygon(set_marker(set, at, size),
                 {.fill = set_colour(set).hex(), .stroke = "#111", .stroke_width = 1.6});
}

VOUSSOIR_INLINE void draw_mean(SvgCanvas& canvas, const FittedSet& fit, int set,
                               const NetFrame& net, LabelPlaces& places) {
  std::vector<Vec2> circle;
  for (const Vec2& point : great_circle(fit.mean)) circle.push_back(net(point));
  canvas.polyline(circle, {.stroke = "white", .stroke_width = 4, .opacity = 0.7});
  canvas.polyline(circle, {.stroke = line_colour(set).hex(), .stroke_width = 2});
  const Vec2 pole = net(equal_area_point(upward_normal(fit.mean)));
  draw_mean_marker(canvas, set, pole, 7.5);
  places.keep_off(pole, 10);
  places.keep_off_line(circle);
  std::string name = fit.name;
  if (name.size() > 18) name = std::to_string(set + 1);  // as the table numbers them
  const TextStyle style{.size = 15, .bold = true, .fill = line_colour(set).hex()};
  places.beside(pole, 11, name, style);
  places.along(circle, name, style);
}

VOUSSOIR_INLINE void draw_axis_marker(SvgCanvas& canvas, const Vec2& at) {
  canvas.circle(at, 8, {.fill = "white", .stroke = "#111", .stroke_width = 1.8});
  canvas.circle(at, 3, {.fill = "#111"});
}

VOUSSOIR_INLINE void draw_tunnel(SvgCanvas& canvas, const LineOrientation& tunnel,
                                 const NetFrame& net, LabelPlaces& places) {
  std::vector<Vec2> section;
  for (const Vec2& point : great_circle(plane_across(tunnel.trend, tunnel.plunge)))
    section.push_back(net(point));
  canvas.polyline(section, {.stroke = "white", .stroke_width = 3.4, .opacity = 0.7});
  canvas.polyline(section, section_line);
  places.keep_off_line(section);
  Vec3 axis = line_vector(tunnel.trend, tunnel.plunge);
  const TextStyle style{.size = 14, .bold = true};
  const bool is_level = std::abs(tunnel.plunge) < 1e-9;
  if (is_level) axis.z() = 0;
  const Vec2 end = net(equal_area_point(axis));
  draw_axis_marker(canvas, end);
  places.keep_off(end, 10);
  if (is_level) {  // both ends are on the rim
    const Vec2 other = net(equal_area_point(-axis));
    draw_axis_marker(canvas, other);
    places.keep_off(other, 10);
  }
  places.beside(end, 12, "axis", style);
  places.along(section, "section", style);
}

#endif

}  // namespace detail

}  // namespace voussoir
