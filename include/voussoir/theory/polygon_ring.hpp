// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// A thin ring, inextensible where bending alone is meant, and the regular polygon that a lining of
/// straight beams makes of it: what the corners cost. phi = pi / n is half the angle of a chord.
namespace detail {
[[nodiscard]] inline double half_chord_angle(int chords, int fewest = 3) {
  require(chords >= fewest, "number of chords n", chords, fewest == 3 ? ">= 3" : ">= 4");
  return std::numbers::pi / chords;
}
}  // namespace detail

/// A thin ring squeezed by two opposite inward point loads P; moments and shortening over P R and
/// P R^3 / EI.
struct SqueezedRing {
  double moment_at_load;  ///< |M| / (P R), tension inside
  double moment_between;  ///< |M| / (P R) at 90 degrees, tension outside
  double shortening;      ///< of the loaded diameter, EI / (P R^3)
  double widening;        ///< of the other, EI / (P R^3); of the polygon: not given (NaN)
};
/// M(theta) = P R (1 / pi - |sin theta| / 2). Source: ring theory, e.g. Timoshenko.
[[nodiscard]] inline SqueezedRing squeezed_circle() {
  constexpr double pi = std::numbers::pi;
  return {1 / pi, 0.5 - 1 / pi, pi / 4 - 2 / pi, 2 / pi - 0.5};
}
/// The same for n chords with the loads at two vertices: M = M0 - (P / 2) R sin(theta_i) at a
/// vertex, M0 = P R / (n tan phi), and the shortening from the chord integrals of M^2 (second order
/// in 1 / n).
/// @throws InvalidInput  n < 4 or not a multiple of 4 (a vertex must lie at 90 degrees)
[[nodiscard]] VOUSSOIR_INLINE SqueezedRing squeezed_polygon(int chords);

/// M of the vertices over M of the circle, for radial loads p cos(m theta) put at the vertices.
///
///   (m^2 - 1) phi sin(phi) cos(phi) / (sin((m + 1) phi) sin((m - 1) phi))
///
/// Multiply computed moments of a polygonal lining by the inverse (m = 2: ovalling).
/// @param harmonic  m >= 2, with (m + 1) below the number of chords
/// @throws InvalidInput  a value out of range
[[nodiscard]] inline double polygon_moment_factor(int chords, int harmonic) {
  const double phi = detail::half_chord_angle(chords);
  require(harmonic >= 2 && harmonic + 1 < chords, "harmonic m", harmonic, ">= 2 and < n - 1");
  const double m = harmonic;
  return (m * m - 1) * phi * std::sin(phi) * std::cos(phi) /
         (std::sin((m + 1) * phi) * std::sin((m - 1) * phi));
}

/// A regular polygon of chords under pressure; per unit of pressure and radius.
struct PressedPolygon {
  double thrust;            ///< N / (p R)
  double moment_at_vertex;  ///< M / (p R^2), tension outside positive
  double moment_at_middle;  ///< of a chord, M / (p R^2)
};
/// Loads p 2 pi R / n at the vertices: N = p R phi / sin(phi), no moment.
/// @throws InvalidInput  n < 3
[[nodiscard]] inline PressedPolygon pressed_at_vertices(int chords) {
  const double phi = detail::half_chord_angle(chords);
  return {phi / std::sin(phi), 0, 0};
}
/// Pressure spread along the chords: N = p R cos(phi), M = p l^2 / 12 at a vertex and -p l^2 / 24
/// in the middle of a chord, l = 2 R sin(phi). The whole of M comes from the chord being straight.
/// @throws InvalidInput  n < 3
[[nodiscard]] inline PressedPolygon pressed_on_chords(int chords) {
  const double phi = detail::half_chord_angle(chords), length = 2 * std::sin(phi);
  return {std::cos(phi), length * length / 12, -length * length / 24};
}

/// The part of a moment that comes from a chord being straight, to be taken off it where the load
/// is spread along the chords: N (x^2 - l^2 / 12) / (2 h), h = R cos(phi) [N m/m].
/// @param thrust  N of the chord [N/m]
/// @param radius  R of the vertices [m], > 0
/// @param from_middle  x along the chord [m], |x| <= l / 2
/// @throws InvalidInput  a value out of range
[[nodiscard]] VOUSSOIR_INLINE double chord_moment(double thrust, double radius, int chords,
                                                  double from_middle);

/// A circular ring under radial pressure p cos(m theta): M = p R^2 cos(m theta) / (m^2 - 1),
/// w = p R^4 cos(m theta) / (EI (m^2 - 1)^2). Here M / (p R^2) and w EI / (p R^4).
struct HarmonicRing {
  double moment, displacement;
};
/// @throws InvalidInput  m < 2
[[nodiscard]] inline HarmonicRing harmonic_ring(int harmonic) {
  require(harmonic >= 2, "harmonic m", harmonic, ">= 2");
  const double k = static_cast<double>(harmonic) * harmonic - 1;
  return {1 / k, 1 / (k * k)};
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE SqueezedRing squeezed_polygon(int chords) {
  const double phi = detail::half_chord_angle(chords, 4);
  require(chords % 4 == 0, "number of chords n", chords, "a multiple of 4");
  const double first = 1 / (chords * std::tan(phi));
  const auto moment = [&](int i) { return first - 0.5 * std::sin(2 * phi * i); };
  // U = sum over chords of l (m_i^2 + m_i m_j + m_j^2) / (6 EI); the shortening is dU / dP = 2U/P.
  double energy = 0;
  for (int i = 0; i < chords / 2; ++i) {
    const double m = moment(i), next = moment(i + 1);
    energy += m * m + m * next + next * next;
  }
  const double length = 2 * std::sin(phi);
  return {first, 0.5 - first, 2 * 2 * energy * length / 6, std::nan("")};
}

VOUSSOIR_INLINE double chord_moment(double thrust, double radius, int chords, double from_middle) {
  const double phi = detail::half_chord_angle(chords);
  require(radius > 0 && std::isfinite(radius), "radius R", radius, "> 0 m");
  const double length = 2 * radius * std::sin(phi);
  require(std::abs(from_middle) <= 0.5 * length * (1 + 1e-12), "place along the chord x",
          from_middle, "within half its length");
  return thrust * (from_middle * from_middle - length * length / 12) / (2 * radius * std::cos(phi));
}

#endif

}  // namespace voussoir
