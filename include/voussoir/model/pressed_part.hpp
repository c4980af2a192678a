// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/contact_outline.hpp>

namespace voussoir {

/// Of a joint that is open from an edge on, the part that is pressed, and where its points are.
///
/// Two rigid bodies part along a joint by an opening that is linear over its area, and so is the
/// stress of a linear normal spring, until it is cut off where the joint lets go. The points of the
/// part that is left, with the second moments of that part, then give force and moment exactly:
/// k_n L^3 / 12 against turning of a closed joint, and a lever that ends at the edge of one that
/// turns about it. Both are continuous in the motion, since the points move with the part.
///
/// Every point keeps its history. The shear spring of its law has the weight of the part
/// (`ShearSpring`).
template <int Dim>
struct PressedPart;

/// In 2-D the part reaches from an end of the joint to where it lets go. Places are told along the
/// joint, -1 and 1 at Gauss's two points of the whole: its ends are at -sqrt(3) and sqrt(3). A
/// contact in facets with a gap between them is taken for the one segment that has its second
/// moment: exact while it is closed, approximate once it opens.
template <>
struct PressedPart<2> {
  static constexpr std::size_t count = 2;             ///< of points
  static constexpr double root = 1.7320508075688772;  ///< of 3

  double share = 1;  ///< of the whole length; 1 also where all is open: laws know that
  double place[2] = {-1, 1};

  [[nodiscard]] bool is_whole() const { return share == 1; }
  /// What is linear along the joint, at point k of the part.
  /// @param of_first, of_second  at the points of the whole
  template <class Value>
  [[nodiscard]] Value at(int k, const Value& of_first, const Value& of_second) const {
    return 0.5 * (of_first + of_second) + (0.5 * place[k]) * (of_second - of_first);
  }
  template <class Values>
  [[nodiscard]] auto at(std::size_t k, const Values& of) const {
    return at(static_cast<int>(k), of(std::size_t{0}), of(std::size_t{1}));
  }

  /// @param at_first, at_second  how far the points of the whole are pressed in, < 0: open [m]; or
  ///                             anything in proportion to that
  [[nodiscard]] static PressedPart of(double at_first, double at_second) {
    const double mean = 0.5 * (at_first + at_second);
    const double at_end = root * (0.5 * (at_second - at_first));
    const double steep = std::abs(at_end);
    if (!(std::abs(mean) < steep)) return {};
    const double share = 0.5 * (steep + mean) / steep;
    const double middle = std::copysign(root * (1 - share), at_end);
    return {share, {middle - share, middle + share}};
  }
  /// The part with these moments.
  /// @param length  > 0;  @param first, second  moments of place [-]
  [[nodiscard]] static PressedPart with_moments(double length, double first, double second) {
    const double middle = first / length,
                 radius = std::sqrt(std::max(0.0, second / length - middle * middle));
    return {std::min(1.0, length / (2 * root)), {middle - radius, middle + radius}};
  }
  [[nodiscard]] static PressedPart of(const double* pressed_in, const detail::KeptOutline<2>&) {
    return of(pressed_in[0], pressed_in[1]);
  }
  /// How far the joint is pressed in where that is most [m].
  [[nodiscard]] static double deepest(const double* pressed_in, const detail::KeptOutline<2>&) {
    return 0.5 * (pressed_in[0] + pressed_in[1]) +
           0.5 * root * std::abs(pressed_in[1] - pressed_in[0]);
  }
};

/// In 3-D the part is what a straight line cuts off the outline. Its points are those of the whole
/// moved to its centroid and stretched by the root of its second moments.
template <>
struct PressedPart<3> {
  static constexpr std::size_t count = 4;

  double share = 1;
  double middle[2] = {0, 0};      ///< in the coordinates of `ContactOutline`
  double stretch[3] = {1, 0, 1};  ///< symmetric: first, mixed, second

  [[nodiscard]] bool is_whole() const { return share == 1; }
  /// What is linear over the joint, at point k of the part; what is not goes with the point.
  /// @param of  of(k) at point k of the whole
  template <class Values>
  [[nodiscard]] auto at(std::size_t k, const Values& of) const {
    const auto a = of(0), b = of(1), c = of(2), d = of(3);
    using Value = std::decay_t<decltype(a)>;
    const double sign = k % 2 == 0 ? root : -root;
    const double x = middle[0] + sign * (k < 2 ? stretch[0] : stretch[1]),
                 y = middle[1] + sign * (k < 2 ? stretch[1] : stretch[2]);
    const double side = k < 2 ? 0.25 : -0.25;
    return Value(0.25 * (a + b + c + d) + side * ((a + b) - (c + d)) + (0.5 * x / root) * (a - b) +
                 (0.5 * y / root) * (c - d));
  }

  [[nodiscard]] static PressedPart of(const double* pressed_in,
                                      const detail::KeptOutline<3>& outline) {
    const auto [mean, x, y] = plane_through(pressed_in);
    if (!may_be_cut(mean, x, y, outline)) return {};
    return cut(mean, x, y, *outline.edges);
  }
  /// False where all is closed or all is open, as nearly everywhere.
  [[nodiscard]] static bool may_be_cut(const double* pressed_in,
                                       const detail::KeptOutline<3>& outline) {
    const auto [mean, x, y] = plane_through(pressed_in);
    return may_be_cut(mean, x, y, outline);
  }
  /// How far the joint is pressed in where that is most [m].
  [[nodiscard]] static double deepest(const double* pressed_in,
                                      const detail::KeptOutline<3>& outline) {
    if (outline.edges == nullptr) return *std::max_element(pressed_in, pressed_in + count);
    const auto [mean, x, y] = plane_through(pressed_in);
    double most = -std::numeric_limits<double>::infinity();
    for (const auto& edge : outline.edges->edges)
      most = std::max(most, mean + x * edge.from[0] + y * edge.from[1]);
    return most;
  }

  /// The part with these moments of the coordinates of `ContactOutline`, turned by an angle.
  /// @param e           cosine and sine of the angle
  /// @param u, v        of the centroid
  /// @param uu, uv, vv  second moments over the area, about the centroid
  [[nodiscard]] VOUSSOIR_INLINE static PressedPart with_moments(double area_share, const double* e,
                                                                double u, double v, double uu,
                                                                double uv, double vv);
  /// mean, x and y of what is mean + x s + y t, s and t the coordinates of `ContactOutline`.
  [[nodiscard]] static std::array<double, 3> plane_through(const double* at) {
    return {0.25 * ((at[0] + at[1]) + (at[2] + at[3])), 0.5 / root * (at[0] - at[1]),
            0.5 / root * (at[2] - at[3])};
  }

 private:
  static constexpr double root = 1.4142135623730951;  ///< of 2

  [[nodiscard]] static bool may_be_cut(double mean, double x, double y,
                                       const detail::KeptOutline<3>& outline) {
    return mean * mean < outline.radius * outline.radius * (x * x + y * y);
  }
  /// @param mean, x, y  pressed in by mean + x s + y t
  [[nodiscard]] VOUSSOIR_INLINE static PressedPart cut(double mean, double x, double y,
                                                       const ContactOutline& outline);
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE PressedPart<3> PressedPart<3>::cut(double mean, double x, double y,
                                                   const ContactOutline& outline) {
  const double steep = std::sqrt(x * x + y * y);
  const double e[2] = {x / steep, y / steep};
  const double from_line = mean / steep;
  // Coordinates u along the slope, from the line where the joint lets go, and v along that line.
  // Seen from a point of the line, the edge along it adds nothing to any moment.
  double area = 0, first_u = 0, first_v = 0, uu = 0, uv = 0, vv = 0;
  bool is_cut = false, is_pressed = false;
  for (const ContactOutline::Edge& edge : outline.edges) {
    double u0 = e[0] * edge.from[0] + e[1] * edge.from[1] + from_line,
           v0 = e[0] * edge.from[1] - e[1] * edge.from[0],
           u1 = e[0] * edge.to[0] + e[1] * edge.to[1] + from_line,
           v1 = e[0] * edge.to[1] - e[1] * edge.to[0];
    if (u0 < 0 || u1 < 0) {
      is_cut = true;
      if (!(u0 > 0 || u1 > 0)) continue;
      const double t = u0 / (u0 - u1), v = v0 + t * (v1 - v0);
      (u0 < 0 ? u0 : u1) = 0;
      (u0 == 0 ? v0 : v1) = v;
    }
    is_pressed = true;
    const double c = u0 * v1 - u1 * v0;
    area += c;
    first_u += c * (u0 + u1);
    first_v += c * (v0 + v1);
    uu += c * (u0 * u0 + u0 * u1 + u1 * u1);
    uv += c * (2 * (u0 * v0 + u1 * v1) + u0 * v1 + u1 * v0);
    vv += c * (v0 * v0 + v0 * v1 + v1 * v1);
  }
  if (!is_cut || !is_pressed || !(area > 0)) return {};
  const double u = first_u / (3 * area), v = first_v / (3 * area);
  uu = std::max(0.0, uu / (6 * area) - u * u);
  vv = std::max(0.0, vv / (6 * area) - v * v);
  uv = uv / (12 * area) - u * v;
  return with_moments(0.5 * area / outline.area, e, u - from_line, v, uu, uv, vv);
}

VOUSSOIR_INLINE PressedPart<3> PressedPart<3>::with_moments(double area_share, const double* e,
                                                            double u, double v, double uu,
                                                            double uv, double vv) {
  // The root of a symmetric matrix of two rows: (M + sqrt(det M)) / sqrt(trace M + 2 sqrt(det M)).
  const double det = std::sqrt(std::max(0.0, uu * vv - uv * uv)),
               scale = 1 / std::sqrt(std::max(uu + vv + 2 * det, 1e-300));
  const double su = scale * (uu + det), sv = scale * (vv + det), mixed = scale * uv;
  PressedPart part;
  part.share = std::min(1.0, area_share);
  part.middle[0] = e[0] * u - e[1] * v;
  part.middle[1] = e[1] * u + e[0] * v;
  part.stretch[0] = e[0] * e[0] * su - 2 * e[0] * e[1] * mixed + e[1] * e[1] * sv;
  part.stretch[1] = e[0] * e[1] * (su - sv) + (e[0] * e[0] - e[1] * e[1]) * mixed;
  part.stretch[2] = e[1] * e[1] * su + 2 * e[0] * e[1] * mixed + e[0] * e[0] * sv;
  return part;
}

#endif

}  // namespace voussoir
