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
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/geometry/spatial_line.hpp>
#include <voussoir/tunnel/opening_centre.hpp>

namespace voussoir {

/// Radial bolts along an arc of the wall. Angles run anticlockwise from the right-hand springing,
/// about the centre of the opening.
struct BoltPattern {
  double length;                 ///< [m], > 0
  double angular_spacing = 0;    ///< [rad]; 0: use `wall_spacing`
  double wall_spacing = 0;       ///< along the wall [m]; 0: use `angular_spacing`
  double from = 0;               ///< [rad]
  double to = std::numbers::pi;  ///< [rad], from < to <= from + 2 pi
  std::optional<Vec2> centre{};  ///< where bolts point away from [m]; none: see `centre_of`
};

/// The bars of a pattern, head (on the wall) first, in the order of their angle. As many as fit the
/// arc, centred in it; on a full circle the spacing is kept and the last gap takes what is left.
///
/// @throws InvalidInput  a value out of range, or the tunnel centre is not inside the opening
[[nodiscard]] VOUSSOIR_INLINE std::vector<Segment> bolt_bars(const BoltPattern& pattern,
                                                             const SimplePolygon& opening);

/// The bars of rows of bolts along an opening in 3-D, at right angles to its axis, row by row; the
/// first row lies half a spacing from its beginning.
/// @param row_spacing  along the axis [m], > 0
/// @param from, to     the stretch to bolt, places along the axis [m]
/// @throws InvalidInput  as above, or the spacing or stretch out of range
[[nodiscard]] VOUSSOIR_INLINE std::vector<SpatialLine> bolt_bars(const BoltPattern& pattern,
                                                                 const PrismaticOpening& opening,
                                                                 double row_spacing, double from,
                                                                 double to);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<Segment> bolt_bars(const BoltPattern& pattern,
                                               const SimplePolygon& opening) {
  require(pattern.length > 0 && std::isfinite(pattern.length), "bolt length", pattern.length,
          "> 0 m");
  const double arc = pattern.to - pattern.from, circle = 2 * std::numbers::pi;
  require(arc > 0 && arc <= circle * (1 + 1e-12), "bolt arc", arc, "> 0 and <= 2 pi rad");
  const bool angular = pattern.angular_spacing > 0;
  const double spacing = angular ? pattern.angular_spacing : pattern.wall_spacing;
  require(spacing > 0 && std::isfinite(spacing) && !(pattern.wall_spacing > 0 && angular),
          "bolt spacing", spacing, "> 0, either along the wall or as an angle");
  const Vec2 centre = pattern.centre.value_or(centre_of(opening));
  double reach = 0;
  for (const Vec2& v : opening.vertices()) reach = std::max(reach, length_of(Vec2(v - centre)));
  const auto wall_point = [&](double angle) {
    const Vec2 far = 2 * reach * Vec2(elementary::cosine(angle), elementary::sine(angle));
    const auto t = opening.last_crossing({centre, centre + far});
    if (!t)
      throw InvalidInput("bolts: the tunnel centre " + text_of<2>(centre) +
                         " m is not inside the opening: give `centre`");
    return Vec2(centre + *t * far);
  };
  // Arc length along the wall as a function of the angle, finely sampled; the identity if angular.
  constexpr int samples = 3600;
  std::vector<double> along{0.0};
  for (int k = 1; k <= samples; ++k) {
    const double step = angular ? arc / samples
                                : length_of(wall_point(pattern.from + arc * k / samples) -
                                            wall_point(pattern.from + arc * (k - 1) / samples));
    along.push_back(along.back() + step);
  }
  const double total = along.back();
  const bool closed = arc > circle * (1 - 1e-9);
  constexpr double most = 10000;
  if (!(total / spacing < most))
    throw InvalidInput("bolt spacing: so small that there would be more than 10000 bolts");
  const auto gaps = static_cast<int>(std::floor(total / spacing + 1e-9));
  const int count = closed ? std::max(gaps, 1) : gaps + 1;
  const double first = closed ? 0.0 : 0.5 * (total - gaps * spacing);
  std::vector<Segment> bars;
  for (int k = 0; k < count; ++k) {
    const double s = first + k * spacing;
    const auto above = std::lower_bound(along.begin() + 1, along.end() - 1, s);
    const double part = (s - *(above - 1)) / (*above - *(above - 1));
    const double place = static_cast<double>(above - along.begin()) - 1 + part;
    const double angle = pattern.from + arc * place / samples;
    const Vec2 head = wall_point(angle);
    bars.push_back(
        {head, head + pattern.length * Vec2(elementary::cosine(angle), elementary::sine(angle))});
  }
  return bars;
}

VOUSSOIR_INLINE std::vector<SpatialLine> bolt_bars(const BoltPattern& pattern,
                                                   const PrismaticOpening& opening,
                                                   double row_spacing, double from, double to) {
  require(row_spacing > 0 && std::isfinite(row_spacing), "spacing of bolt rows", row_spacing,
          "> 0 m");
  require(from < to && std::isfinite(to - from), "beginning of the bolted stretch", from,
          "below its end, both finite");
  const std::vector<Segment> row = bolt_bars(pattern, opening.section());
  std::vector<SpatialLine> bars;
  const auto rows = static_cast<int>(std::floor((to - from) / row_spacing + 1e-9));
  if (static_cast<double>(rows) * static_cast<double>(row.size()) > 1e5)
    throw InvalidInput("spacing of bolt rows: so small that there would be more than 1e5 bolts");
  for (int k = 0; k < rows; ++k)
    for (const Segment& bar : row) {
      const double y = from + (k + 0.5) * row_spacing;
      bars.push_back({opening.in_space(bar.start, y), opening.in_space(bar.end, y)});
    }
  return bars;
}

#endif

}  // namespace voussoir
