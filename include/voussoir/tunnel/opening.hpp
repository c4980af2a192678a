// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/rockmass/domain.hpp>

namespace voussoir {

/// A circle as a regular polygon with vertices on it, the first at the right-hand springing.
/// @param diameter  [m], > 0;  @param facets  12 to 720
/// @throws InvalidInput
[[nodiscard]] VOUSSOIR_INLINE SimplePolygon circular_opening(double diameter, int facets = 72);

/// A half circle on vertical walls and a flat floor; the springing is at y = 0.
/// @param width  [m], > 0;  @param wall_height  floor to springing [m], > 0
/// @param facets  chords on a full circle, 12 to 720
/// @throws InvalidInput
[[nodiscard]] VOUSSOIR_INLINE SimplePolygon horseshoe_opening(double width, double wall_height,
                                                              int facets = 72);

/// The ground around an opening: `width` wide with the tunnel centre in its middle.
/// @param cover  crown to surface [m], > 0;  @param below  invert to base [m], > 0
/// @throws InvalidInput
[[nodiscard]] VOUSSOIR_INLINE Domain<2> domain_around(const SimplePolygon& opening, double width,
                                                      double cover, double below);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE SimplePolygon circular_opening(double diameter, int facets) {
  require(diameter > 0 && std::isfinite(diameter), "tunnel diameter", diameter, "> 0 m");
  require(facets >= 12 && facets <= 720, "tunnel facets", facets, "12 to 720");
  std::vector<Vec2> vertices;
  for (int k = 0; k < facets; ++k) {
    const double angle = 2 * std::numbers::pi * k / facets;
    vertices.emplace_back(0.5 * diameter *
                          Vec2(elementary::cosine(angle), elementary::sine(angle)));
  }
  return SimplePolygon(std::move(vertices));
}

VOUSSOIR_INLINE SimplePolygon horseshoe_opening(double width, double wall_height, int facets) {
  require(width > 0 && std::isfinite(width), "tunnel width", width, "> 0 m");
  require(wall_height > 0 && std::isfinite(wall_height), "wall height", wall_height, "> 0 m");
  require(facets >= 12 && facets <= 720, "tunnel facets", facets, "12 to 720");
  std::vector<Vec2> vertices;
  const int chords = (facets + 1) / 2;
  for (int k = 0; k <= chords; ++k) {
    const double angle = std::numbers::pi * k / chords;
    vertices.emplace_back(0.5 * width * Vec2(elementary::cosine(angle), elementary::sine(angle)));
  }
  vertices.emplace_back(-0.5 * width, -wall_height);
  vertices.emplace_back(0.5 * width, -wall_height);
  return SimplePolygon(std::move(vertices));
}

VOUSSOIR_INLINE Domain<2> domain_around(const SimplePolygon& opening, double width, double cover,
                                        double below) {
  require(width > 0 && std::isfinite(width), "domain width", width, "> 0 m");
  require(cover > 0 && std::isfinite(cover), "cover", cover, "> 0 m");
  require(below > 0 && std::isfinite(below), "rock below the invert", below, "> 0 m");
  double crown = -1e300, invert = 1e300;
  for (const Vec2& v : opening.vertices()) {
    crown = std::max(crown, v.y());
    invert = std::min(invert, v.y());
  }
  return {{-0.5 * width, invert - below}, {0.5 * width, crown + cover}};
}

#endif

}  // namespace voussoir
