// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <span>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir::detail {

/// Right-handed axes in a plane and, over the area, the second moments about its centroid.
struct PlaneMoments {
  Vec3 first, second;
  double xx = 0, xy = 0, yy = 0;  ///< [m^2]
};

/// Adds a polygon's second moments about a point to those of a plane, divided by the whole area.
/// @param normal  from where the polygon is seen anticlockwise
/// @param about   from there to the first vertex of the polygon [m]
VOUSSOIR_INLINE void add_moments(std::span<const Vec3> polygon, const Vec3& normal,
                                 const Vec3& about, double whole_area, PlaneMoments& moments);

/// Integral of (x + i y)^4 over a polygon, axes and arguments as above [m^6].
[[nodiscard]] VOUSSOIR_INLINE std::complex<double> fourth_moment(std::span<const Vec3> polygon,
                                                                 const Vec3& normal,
                                                                 const Vec3& about,
                                                                 const PlaneMoments& moments);

/// Two arms p, q for which four points +- p, +- q with a quarter of the area each have these second
/// moments: along the principal axes, the longer one first, as long as sqrt(2) times the radius of
/// gyration.
VOUSSOIR_INLINE std::array<Vec3, 2> arms_of(const PlaneMoments& moments);

/// True where the moments do not tell the principal axes from others: they would be those of
/// roundings.
[[nodiscard]] inline bool is_round(const PlaneMoments& m) {
  constexpr double least_contrast = 1e-6;
  return elementary::length(0.5 * (m.xx - m.yy), m.xy) < least_contrast * 0.5 * (m.xx + m.yy);
}

/// The same where all axes are principal or nearly so.
///
/// Four points turned by 90 degrees are the same four points, so it is the fourth moment that
/// tells how to place them: a square has them along its sides. Of an outline that has none either
/// (a regular triangle or hexagon) they lie along strike and dip of the plane, in a horizontal one
/// along x and y: four points cannot have a symmetry of three or six, but mirrored in a vertical
/// plane or turned with the ground by 90 degrees about the vertical they are where they were.
/// @param fourth  the fourth moment over the area [m^4]
VOUSSOIR_INLINE std::array<Vec3, 2> arms_of_round(const PlaneMoments& moments,
                                                  const std::complex<double>& fourth);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void add_moments(std::span<const Vec3> polygon, const Vec3& normal,
                                 const Vec3& about, double whole_area, PlaneMoments& moments) {
  VOUSSOIR_ASSERT(whole_area > 0, "moments are over an area");
  // Of the triangles of a fan: (the sum over corners, and of the square of their sum) / 12.
  const double ox = dot_product(about, moments.first), oy = dot_product(about, moments.second);
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vec3 a = polygon[k] - polygon[0], b = polygon[k + 1] - polygon[0];
    const double share = dot_product(normal, cross(a, b - a)) / (2 * whole_area) / 12;
    const double ax = ox + dot_product(a, moments.first), ay = oy + dot_product(a, moments.second),
                 bx = ox + dot_product(b, moments.first), by = oy + dot_product(b, moments.second);
    const double sx = ox + ax + bx, sy = oy + ay + by;
    moments.xx += share * (ox * ox + ax * ax + bx * bx + sx * sx);
    moments.yy += share * (oy * oy + ay * ay + by * by + sy * sy);
    moments.xy += share * (ox * oy + ax * ay + bx * by + sx * sy);
  }
}

VOUSSOIR_INLINE std::complex<double> fourth_moment(std::span<const Vec3> polygon,
                                                   const Vec3& normal, const Vec3& about,
                                                   const PlaneMoments& moments) {
  using Complex = std::complex<double>;
  const auto flat = [&](const Vec3& v) {
    return Complex(dot_product(v, moments.first), dot_product(v, moments.second));
  };
  const Complex tip = flat(about);
  Complex sum = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vec3 a = polygon[k] - polygon[0], b = polygon[k + 1] - polygon[0];
    const std::array<Complex, 3> corners{tip, tip + flat(a), tip + flat(b)};
    // The integral of z^n over a triangle is 2 A n! / (n + 2)! times the sum of all products of n
    // corners, any of them repeated; that grows corner by corner.
    std::array<Complex, 5> products{1, 0, 0, 0, 0};
    for (const Complex& corner : corners)
      for (std::size_t n = 1; n < products.size(); ++n) products[n] += corner * products[n - 1];
    sum += dot_product(normal, cross(a, b - a)) / 30 * products[4];
  }
  return sum;
}

VOUSSOIR_INLINE std::array<Vec3, 2> arms_of(const PlaneMoments& m) {
  const double half_difference = 0.5 * (m.xx - m.yy), mean = 0.5 * (m.xx + m.yy);
  const double radius = elementary::length(half_difference, m.xy);
  const double angle = 0.5 * elementary::angle_of(m.xy, half_difference);
  const Vec3 major = elementary::cosine(angle) * m.first + elementary::sine(angle) * m.second;
  const Vec3 minor = elementary::cosine(angle) * m.second - elementary::sine(angle) * m.first;
  const double large = mean + radius;
  const double small = std::fmax(0.0, (m.xx * m.yy - m.xy * m.xy) / large);  // determinant / large
  return {std::sqrt(2 * large) * major, std::sqrt(2 * small) * minor};
}

VOUSSOIR_INLINE std::array<Vec3, 2> arms_of_round(const PlaneMoments& m,
                                                  const std::complex<double>& fourth) {
  const double mean = 0.5 * (m.xx + m.yy);
  double angle = 0;
  if (std::abs(fourth) > 1e-3 * mean * mean) {
    angle = 0.25 * std::arg(-fourth);
  } else {
    // Where strike is known to no more than roundings the plane is level.
    Vec3 along = cross(Vec3(0, 0, 1), cross(m.first, m.second));
    if (!(length_of(along) > 1e-6)) along = Vec3(1, 0, 0);
    angle = elementary::angle_of(dot_product(along, m.second), dot_product(along, m.first));
  }
  // Exact for any angle: the root of the matrix of moments, times two axes at right angles.
  const double root = std::sqrt(std::fmax(0.0, m.xx * m.yy - m.xy * m.xy));
  const double scale = std::sqrt(2 / (m.xx + m.yy + 2 * root));
  const auto arm = [&](double x, double y) -> Vec3 {
    return scale *
           (((m.xx + root) * x + m.xy * y) * m.first + (m.xy * x + (m.yy + root) * y) * m.second);
  };
  return {arm(elementary::cosine(angle), elementary::sine(angle)),
          arm(-elementary::sine(angle), elementary::cosine(angle))};
}

#endif

}  // namespace voussoir::detail
