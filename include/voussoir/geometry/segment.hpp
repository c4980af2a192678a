// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/half_space.hpp>

namespace voussoir {

/// One point of a numerical integration over a facet.
template <int Dim>
struct FacetPoint {
  Vec<Dim> offset = zeros<Vec<Dim>>();  ///< from the centre of the facet [m]
  double weight = 0;                    ///< length (2-D) or area (3-D) that the point stands for
};

/// A straight piece of line: a joint trace, a contact, a piece of tunnel wall.
struct Segment {
  Vec2 start, end;  ///< [m]

  [[nodiscard]] double length() const { return length_of(end - start); }
  /// What an integration point of the facet weighs in all: its length, one metre thick.
  [[nodiscard]] double measure() const { return length(); }
  [[nodiscard]] Vec2 centre() const { return 0.5 * (start + end); }
  /// Centre as seen from `origin`; exact where `origin` is near, wherever both are.
  [[nodiscard]] Vec2 centre_from(const Vec2& origin) const {
    return 0.5 * ((start - origin) + (end - origin));
  }
  [[nodiscard]] Vec2 at(double t) const { return start + t * (end - start); }

  /// Unit normal times length: the area vector of a facet with the body on its left. The sum over
  /// a closed chain of segments is zero to rounding, which is what puts blocks in equilibrium.
  [[nodiscard]] Vec2 area_vector() const { return -perpendicular(end - start); }

  /// The two Gauss points at +- length / (2 sqrt 3): exact for a linear traction, in force and
  /// moment.
  [[nodiscard]] std::array<FacetPoint<2>, 2> gauss_points() const {
    const Vec2 offset = (end - start) * (0.5 / std::sqrt(3.0));
    const double weight = 0.5 * length();
    return {FacetPoint<2>{-offset, weight}, FacetPoint<2>{offset, weight}};
  }

  /// Eight points by Lobatto's rule, two of them the ends: exact for tractions that are polynomials
  /// of degree 13. Source: Abramowitz and Stegun (1964), table 25.6.
  [[nodiscard]] std::array<FacetPoint<2>, 8> lobatto_points() const {
    constexpr std::array<std::array<double, 2>, 4> rule = {
        {{1, 1.0 / 28},
         {0.871740148509607, 0.210704227143506},
         {0.591700181433142, 0.341122692483504},
         {0.209299217902479, 0.412458794658704}}};
    const Vec2 half = 0.5 * (end - start);
    const double half_length = 0.5 * length();
    std::array<FacetPoint<2>, 8> points;
    for (std::size_t k = 0; k < rule.size(); ++k) {
      points[k] = {-rule[k][0] * half, rule[k][1] * half_length};
      points[points.size() - 1 - k] = {rule[k][0] * half, rule[k][1] * half_length};
    }
    return points;
  }
};

/// The parts of a segment on the two sides of a line.
struct SegmentSplit {
  std::optional<Segment> below, above;  ///< inside and outside the half space
};

/// @param tolerance  a part that reaches less far than this from the line is not counted [m]
[[nodiscard]] VOUSSOIR_INLINE SegmentSplit split(const Segment& segment, const HalfSpace<2>& side,
                                                 double tolerance);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE SegmentSplit split(const Segment& segment, const HalfSpace<2>& side,
                                   double tolerance) {
  VOUSSOIR_ASSERT(tolerance >= 0, "a tolerance is no less than 0");
  const double from = side.distance(segment.start), to = side.distance(segment.end);
  const bool below = from < -tolerance || to < -tolerance;
  const bool above = from > tolerance || to > tolerance;
  if (!above) return {below ? std::optional(segment) : std::nullopt, std::nullopt};
  if (!below) return {std::nullopt, segment};
  const Vec2 crossing = segment.at(from / (from - to));
  const Segment first{segment.start, crossing}, second{crossing, segment.end};
  if (from < to) return {first, second};
  return {second, first};
}

#endif

}  // namespace voussoir
