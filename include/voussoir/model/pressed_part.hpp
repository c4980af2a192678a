// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/contact_outline.hpp>
#include <voussoir/model/moving_contact.hpp>
#include <voussoir/model/reference_contact.hpp>

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

 private:
  static constexpr double root = 1.4142135623730951;  ///< of 2

  /// mean, x and y of what is mean + x s + y t, s and t the coordinates of `ContactOutline`.
  [[nodiscard]] static std::array<double, 3> plane_through(const double* at) {
    return {0.25 * ((at[0] + at[1]) + (at[2] + at[3])), 0.5 / root * (at[0] - at[1]),
            0.5 / root * (at[2] - at[3])};
  }
  [[nodiscard]] static bool may_be_cut(double mean, double x, double y,
                                       const detail::KeptOutline<3>& outline) {
    return mean * mean < outline.radius * outline.radius * (x * x + y * y);
  }
  /// @param mean, x, y  pressed in by mean + x s + y t
  [[nodiscard]] VOUSSOIR_INLINE static PressedPart cut(double mean, double x, double y,
                                                       const ContactOutline& outline);
};

namespace detail {

/// Moves the loads of the points of a contact to its pressed part. Normal stress and opening are
/// those there; shear stress and slip go with the point.
VOUSSOIR_INLINE void move_loads(const PressedPart<2>& part, PointLoad<2>* loads);
VOUSSOIR_INLINE void move_loads(const PressedPart<3>& part, PointLoad<3>* loads);

/// Finds the pressed part, and moves the loads there.
/// @param release  release(k, load): opening at which point k lets go [m]
template <int Dim, class Release>
[[nodiscard]] PressedPart<Dim> press(PointLoad<Dim>* loads, const KeptOutline<Dim>& outline,
                                     const Release& release) {
  double pressed_in[PressedPart<Dim>::count];
  for (std::size_t k = 0; k < PressedPart<Dim>::count; ++k)
    pressed_in[k] = release(k, loads[k]) - loads[k].motion.opening;
  const PressedPart<Dim> part = PressedPart<Dim>::of(pressed_in, outline);
  if (!part.is_whole()) move_loads(part, loads);
  return part;
}

/// How far the faces of a contact in motion overlap where that is most [m].
template <int Dim, class State>
[[nodiscard]] double deepest(const MovingContact<Dim>& c,
                             const MovingContactPoint<Dim, State>* points, std::size_t count,
                             const typename MovingContact<Dim>::Place& at) {
  double pressed_in[PressedPart<Dim>::count], most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k) {
    const double one = -points[k].motion(at).opening;
    most = std::max(most, one);
    if (k < PressedPart<Dim>::count) pressed_in[k] = one;
  }
  return count == PressedPart<Dim>::count ? PressedPart<Dim>::deepest(pressed_in, c.outline) : most;
}

/// The place of a contact point, to be moved along the joint.
template <int Dim>
[[nodiscard]] Vec<Dim>& place_in(ReferencePoint<Dim>& p) {
  return p.offset;
}
template <int Dim, class State>
[[nodiscard]] Vec<Dim>& place_in(MovingContactPoint<Dim, State>& p) {
  return p.place;
}

/// Calls visit(k, point, load) for the points of a contact, on its pressed part.
/// @param point_at  point_at(k) is point k as a value;  @param load_of  load_of(point)
/// @param release   see `press`
template <int Dim, class PointAt, class LoadOf, class Release, class Visit>
void visit_pressed(std::size_t count, const KeptOutline<Dim>& outline, const PointAt& point_at,
                   const LoadOf& load_of, const Release& release, Visit&& visit) {
  using Part = PressedPart<Dim>;
  if (count != Part::count) {
    for (std::size_t k = 0; k < count; ++k) {
      const auto p = point_at(k);
      visit(k, p, load_of(p));
    }
    return;
  }
  using Point = std::decay_t<decltype(point_at(std::size_t{0}))>;
  std::array<Point, Part::count> points;
  std::array<PointLoad<Dim>, Part::count> loads;
  for (std::size_t k = 0; k < count; ++k) {
    points[k] = point_at(k);
    loads[k] = load_of(points[k]);
  }
  const Part part = press<Dim>(loads.data(), outline, release);
  std::array<Vec<Dim>, Part::count> places;
  for (std::size_t k = 0; k < count; ++k) places[k] = place_in(points[k]);
  for (std::size_t k = 0; k < count; ++k) {
    Point& p = points[k];
    if (!part.is_whole()) {
      place_in(p) = part.at(k, [&](std::size_t i) -> const Vec<Dim>& { return places[i]; });
      p.weight = loads[k].weight;
      p.initial = loads[k].initial;
    }
    visit(k, p, loads[k]);
  }
}

}  // namespace detail

#if VOUSSOIR_BODIES

namespace detail {

template <int Dim>
void move_to(const PressedPart<Dim>& part, PointLoad<Dim>* loads) {
  constexpr std::size_t count = PressedPart<Dim>::count;
  double opening[count], stress[count];
  for (std::size_t k = 0; k < count; ++k) {
    opening[k] = loads[k].motion.opening;
    stress[k] = loads[k].initial.normal / loads[k].weight;
  }
  for (std::size_t k = 0; k < count; ++k) {
    PointLoad<Dim>& load = loads[k];
    load.motion.opening = part.at(k, [&](std::size_t i) { return opening[i]; });
    load.weight *= part.share;
    load.initial.normal = load.weight * part.at(k, [&](std::size_t i) { return stress[i]; });
    for (int m = 0; m < Dim - 1; ++m) load.initial.tangential.data()[m] *= part.share;
    load.whole_over_part = 1 / part.share;
  }
}
VOUSSOIR_INLINE void move_loads(const PressedPart<2>& part, PointLoad<2>* loads) {
  move_to<2>(part, loads);
}
VOUSSOIR_INLINE void move_loads(const PressedPart<3>& part, PointLoad<3>* loads) {
  move_to<3>(part, loads);
}

}  // namespace detail

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
  // The root of a symmetric matrix of two rows: (M + sqrt(det M)) / sqrt(trace M + 2 sqrt(det M)).
  const double det = std::sqrt(std::max(0.0, uu * vv - uv * uv)),
               scale = 1 / std::sqrt(std::max(uu + vv + 2 * det, 1e-300));
  const double su = scale * (uu + det), sv = scale * (vv + det), mixed = scale * uv;
  PressedPart part;
  part.share = std::min(1.0, 0.5 * area / outline.area);
  const double from_centre = u - from_line;
  part.middle[0] = e[0] * from_centre - e[1] * v;
  part.middle[1] = e[1] * from_centre + e[0] * v;
  part.stretch[0] = e[0] * e[0] * su - 2 * e[0] * e[1] * mixed + e[1] * e[1] * sv;
  part.stretch[1] = e[0] * e[1] * (su - sv) + (e[0] * e[0] - e[1] * e[1]) * mixed;
  part.stretch[2] = e[1] * e[1] * su + 2 * e[0] * e[1] * mixed + e[0] * e[0] * sv;
  return part;
}

#endif

}  // namespace voussoir
