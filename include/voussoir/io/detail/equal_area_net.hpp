// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/contour.hpp>
#include <voussoir/rockmass/orientation.hpp>
#include <voussoir/rockmass/orientation_sets.hpp>

namespace voussoir {

/// Where a line through the centre of a sphere is in the equal-area net of its lower hemisphere:
/// x East, y North, at most 1 from the centre. A line of the angle theta from the vertical is at
///
///   r = sqrt(2) sin(theta / 2)
///
/// so that equal solid angles have equal areas (Schmidt net).
/// @param direction  unit vector along the line, of either sense; a level one is where it points
/// Source: Lambert (1772); Priest (1985), Hemispherical projection methods in rock mechanics.
[[nodiscard]] inline Vec2 equal_area_point(const Vec3& direction) {
  // sqrt(2) sin(theta / 2) / sin(theta) without the quotient of two small numbers at the centre.
  const double factor = (direction.z() > 0 ? -1 : 1) / std::sqrt(1 + std::abs(direction.z()));
  return {factor * direction.x(), factor * direction.y()};
}

/// The downward unit vector at a point of the net. Beyond its rim, up to sqrt(2) from the centre,
/// the projection goes on into the upper hemisphere.
/// @param point  farther out it is taken to be at sqrt(2), straight up
[[nodiscard]] inline Vec3 equal_area_direction(const Vec2& point) {
  const double square = point.x() * point.x() + point.y() * point.y();
  if (square >= 2) return {0, 0, 1};
  const double factor = std::sqrt(2 - square);
  return {factor * point.x(), factor * point.y(), square - 1};
}

/// How many times denser poles are about a direction than they would be without any preferred one.
///
///   d(x) = k / sinh(k) sum w cosh(k x.n) / sum w
///
/// Fisher's distribution about each pole and its opposite, of which the mean over the hemisphere is
/// 1 whatever the poles.
///
/// Source: Vollmer (1995), Computers & Geosciences 21, 31-49, whose k = 2 (1 + N / 9) is that of
/// Kamb's counting circle at three standard deviations; not above 100, the width of a circle of 2 %
/// of the net, or many planes would show every single one.
class PoleDensity {
 public:
  /// @pre  at least one plane
  explicit PoleDensity(std::span<const SurveyedPlane> planes);

  [[nodiscard]] double operator()(const Vec3& direction) const {
    double sum = 0;
    for (const Pole& pole : poles_) {
      const double c = std::abs(dot_product(direction, pole.normal));
      if (k_ * (1 - c) < 40)
        sum += pole.weight * (std::exp(-k_ * (1 - c)) + std::exp(-k_ * (1 + c)));
    }
    return factor_ * sum;
  }
  [[nodiscard]] double concentration() const { return k_; }  ///< k of each pole [-]

  /// The density over the square about the net, `parts` intervals from its centre to its rim.
  [[nodiscard]] ContourGrid grid(int parts) const;

 private:
  struct Pole {
    Vec3 normal;
    double weight;
  };
  std::vector<Pole> poles_;
  double k_, factor_;
};

namespace detail {

/// The great circle of a plane in the net, from its strike to the opposite.
[[nodiscard]] VOUSSOIR_INLINE std::vector<Vec2> great_circle(const Orientation& plane);

/// The plane at right angles to a line.
[[nodiscard]] inline Orientation plane_across(double trend, double plunge) {
  return orientation_of(line_vector(trend, plunge));
}

/// Multiples of uniform density at which contours are drawn: 2, 4, 6 ..., or a step of 1, 2 or 5
/// times a power of ten where there would be more than seven.
[[nodiscard]] VOUSSOIR_INLINE std::vector<double> density_levels(double largest);

}  // namespace detail

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE PoleDensity::PoleDensity(std::span<const SurveyedPlane> planes) {
  k_ = std::min(2 * (1 + detail::effective_count(planes) / 9), 100.0);
  double weight = 0;
  for (const SurveyedPlane& surveyed : planes) weight += surveyed.weight;
  factor_ = k_ / (weight * -std::expm1(-2 * k_));
  constexpr std::size_t most = 4000;  // poles one by one; more are put together by the half degree
  if (planes.size() <= most) {
    for (const SurveyedPlane& surveyed : planes)
      poles_.push_back({upward_normal(surveyed.plane), surveyed.weight});
    return;
  }
  std::map<std::pair<int, int>, double> cells;
  constexpr double size = 0.01;
  for (const SurveyedPlane& surveyed : planes) {
    const Vec2 at = equal_area_point(upward_normal(surveyed.plane));
    cells[{static_cast<int>(std::floor(at.x() / size)),
           static_cast<int>(std::floor(at.y() / size))}] += surveyed.weight;
  }
  for (const auto& [cell, sum] : cells)
    poles_.push_back(
        {equal_area_direction({(cell.first + 0.5) * size, (cell.second + 0.5) * size}), sum});
}

VOUSSOIR_INLINE ContourGrid PoleDensity::grid(int parts) const {
  // A few lines beyond the rim, for contours that go on across it.
  const int reach = parts + 2, lines = 2 * reach + 1;
  ContourGrid grid;
  for (int k = -reach; k <= reach; ++k)
    grid.x.push_back(static_cast<double>(k) / static_cast<double>(parts));
  grid.y = grid.x;
  grid.value.resize(lines, lines);
  for (int i = 0; i < lines; ++i)
    for (int j = 0; j < lines; ++j)
      grid.value(i, j) = (*this)(equal_area_direction(
          {grid.x[static_cast<std::size_t>(i)], grid.y[static_cast<std::size_t>(j)]}));
  return grid;
}

namespace detail {

VOUSSOIR_INLINE std::vector<Vec2> great_circle(const Orientation& plane) {
  constexpr int parts = 90;
  const Vec3 strike = strike_vector(plane), down = dip_vector(plane);
  std::vector<Vec2> points;
  for (int k = 0; k <= parts; ++k) {
    const double rake = std::numbers::pi * k / parts;
    // Both ends are level; rounding must not send one of them across the net.
    Vec3 along = std::cos(rake) * strike + std::sin(rake) * down;
    if (k == 0 || k == parts) along.z() = 0;
    along.z() = std::min(along.z(), 0.0);
    points.push_back(equal_area_point(along));
  }
  return points;
}

VOUSSOIR_INLINE std::vector<double> density_levels(double largest) {
  double step = 2;
  for (const double next : {4.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
    if (largest <= 7.5 * step) break;
    step = next;
  }
  std::vector<double> levels;
  for (int k = 1; k * step < largest; ++k) levels.push_back(k * step);
  return levels;
}

}  // namespace detail

#endif

}  // namespace voussoir
