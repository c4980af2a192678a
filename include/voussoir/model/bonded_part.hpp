// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/bodies.hpp>
#include <voussoir/model/contact_outline.hpp>
#include <voussoir/model/pressed_part.hpp>

namespace voussoir::detail {

/// Of a joint with a bond, the part that is pressed or bonded, and what is left of the bond.
///
/// The bond holds over what has never opened by more than it stretches; there the joint carries
/// tension, elsewhere it is pressed or open. Stress is linear over both, so that two (four) points
/// with area, centroid and second moments of both together give force and moment exactly, as those
/// of `PressedPart` do without a bond.
///
/// What has cracked is remembered from each point's side as what lies beyond a straight front: all
/// of it in 2-D. In 3-D the front of a crack that comes on in another direction from the same side
/// is laid so that nothing heals: it may cut off more than has cracked.
///
/// @param pressed_in  by points of the whole: how far the joint is closed, < 0: open [m]
/// @param of          what the law says of these points
/// @param now         is written: the bond of these points as it is then
/// @return  whole also where nothing is pressed or bonded: laws know from the bond
[[nodiscard]] VOUSSOIR_INLINE PressedPart<2> bonded_part(const double* pressed_in,
                                                         const KeptOutline<2>& outline,
                                                         const BondRelease<2>* of,
                                                         PointBond<2>* now);
[[nodiscard]] VOUSSOIR_INLINE PressedPart<3> bonded_part(const double* pressed_in,
                                                         const KeptOutline<3>& outline,
                                                         const BondRelease<3>* of,
                                                         PointBond<3>* now);

#if VOUSSOIR_BODIES

/// A bond over less than this part of a joint is lost [-]: its moments would be differences of
/// others' to 12 digits, and the points be anywhere.
constexpr double least_bond = 1e-4;

/// What all points together say of the bond: it is one over the joint. One that has failed in shear
/// lets all of it go in tension.
template <int Dim>
[[nodiscard]] PointBond<Dim> common_bond(const BondRelease<Dim>* of, PointBond<Dim>* now) {
  PointBond<Dim> all{1, of[0].stretch, {}};
  for (std::size_t k = 0; k < PressedPart<Dim>::count; ++k) {
    all.area = std::min(all.area, of[k].area);
    all.stretch = std::min(all.stretch, of[k].stretch);
  }
  for (std::size_t k = 0; k < PressedPart<Dim>::count; ++k)
    now[k] = {all.area, all.stretch, of[k].front};
  return all;
}

/// Length and moments of what lies between two places.
struct LengthMoments {
  double length = 0, first = 0, second = 0;

  void add(double from, double to, double sign = 1) {
    if (!(to > from)) return;
    length += sign * (to - from);
    first += sign * (to * to - from * from) / 2;
    second += sign * (to * to * to - from * from * from) / 3;
  }
};

VOUSSOIR_INLINE PressedPart<2> bonded_part(const double* pressed_in, const KeptOutline<2>&,
                                           const BondRelease<2>* of, PointBond<2>* now) {
  constexpr double end = PressedPart<2>::root;
  const PointBond<2> bond = common_bond(of, now);
  const double mean = 0.5 * (pressed_in[0] + pressed_in[1]),
               slope = 0.5 * (pressed_in[1] - pressed_in[0]);
  const double least = mean - end * std::abs(slope);
  const double from = std::max(-end, -of[0].front.reach), to = std::min(end, of[1].front.reach);
  const bool is_cracked = from > -end || to < end;
  if (least >= 0 || (!is_cracked && least >= -bond.stretch && bond.area > 0)) return {};
  if (bond.area == 0) return PressedPart<2>::of(pressed_in[0], pressed_in[1]);
  // Where it is closed farther than this: [from, to] becomes part of it.
  const auto above = [&](double closed, double& low, double& high) {
    if (slope == 0) {
      if (!(mean > closed)) high = low;
    } else if (slope > 0) {
      low = std::max(low, (closed - mean) / slope);
    } else {
      high = std::min(high, (closed - mean) / slope);
    }
  };
  double pressed_from = -end, pressed_to = end, held_from = from, held_to = to;
  above(0, pressed_from, pressed_to);
  above(-bond.stretch, held_from, held_to);
  const double area = std::min(bond.area, (held_to - held_from) / (2 * end));
  now[0].area = now[1].area = area > least_bond ? area : 0;
  if (now[0].area == 0) return PressedPart<2>::of(pressed_in[0], pressed_in[1]);
  if (held_from > from) now[0].front.reach = -held_from;
  if (held_to < to) now[1].front.reach = held_to;
  LengthMoments sum;
  sum.add(pressed_from, pressed_to);
  sum.add(held_from, held_to);
  sum.add(std::max(held_from, pressed_from), std::min(held_to, pressed_to), -1);
  return PressedPart<2>::with_moments(sum.length, sum.first, sum.second);
}

/// Area and moments of what directed edges enclose.
struct AreaMoments {
  double area = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;

  void add(const std::vector<ContactOutline::Edge>& edges, double sign = 1) {
    for (const ContactOutline::Edge& e : edges) {
      const double u0 = e.from[0], v0 = e.from[1], u1 = e.to[0], v1 = e.to[1];
      const double c = sign * (u0 * v1 - u1 * v0);
      area += c / 2;
      u += c * (u0 + u1) / 6;
      v += c * (v0 + v1) / 6;
      uu += c * (u0 * u0 + u0 * u1 + u1 * u1) / 12;
      uv += c * (2 * (u0 * v0 + u1 * v1) + u0 * v1 + u1 * v0) / 24;
      vv += c * (v0 * v0 + v0 * v1 + v1 * v1) / 12;
    }
  }
};

/// A straight line on a joint: n . x = reach, n a unit vector.
struct StraightFront {
  double n[2];
  double reach;

  [[nodiscard]] double beyond(const double* x) const { return n[0] * x[0] + n[1] * x[1] - reach; }
  /// The least n . x of an area with these edges.
  [[nodiscard]] double least_of(const std::vector<ContactOutline::Edge>& edges) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& e : edges) least = std::min(least, n[0] * e.from[0] + n[1] * e.from[1]);
    return least;
  }
};

/// What of an area lies on the near side of a line.
[[nodiscard]] inline std::vector<ContactOutline::Edge> within(
    const std::vector<ContactOutline::Edge>& edges, const StraightFront& line) {
  std::vector<ContactOutline::Edge> kept;
  // Where edges leave and where they come back: what joins these lies on the line, so that any one
  // may be joined to any other.
  std::vector<std::array<double, 2>> out, in;
  for (const ContactOutline::Edge& e : edges) {
    const double a = line.beyond(e.from), b = line.beyond(e.to);
    if (a <= 0 && b <= 0) kept.push_back(e);
    if ((a > 0) == (b > 0)) continue;
    const double t = a / (a - b);
    const std::array<double, 2> x{e.from[0] + t * (e.to[0] - e.from[0]),
                                  e.from[1] + t * (e.to[1] - e.from[1])};
    if (a > 0) {
      in.push_back(x);
      kept.push_back({{x[0], x[1]}, {e.to[0], e.to[1]}});
    } else {
      out.push_back(x);
      kept.push_back({{e.from[0], e.from[1]}, {x[0], x[1]}});
    }
  }
  for (std::size_t k = 0; k < std::min(out.size(), in.size()); ++k)
    kept.push_back({{out[k][0], out[k][1]}, {in[k][0], in[k][1]}});
  return kept;
}
[[nodiscard]] inline double area_within(const std::vector<ContactOutline::Edge>& edges,
                                        const StraightFront& line) {
  AreaMoments sum;
  sum.add(within(edges, line));
  return sum.area;
}

/// On which axis of the outline, and to which side, point k of a joint in 3-D lies.
[[nodiscard]] inline std::array<double, 2> axis_towards(std::size_t k) {
  const double sign = k % 2 == 0 ? 1.0 : -1.0;
  return k < 2 ? std::array{sign, 0.0} : std::array{0.0, sign};
}
[[nodiscard]] inline StraightFront front_towards(std::size_t k, const BondFront<3>& front) {
  const auto axis = axis_towards(k);
  const double c = std::cos(front.slant), s = std::sin(front.slant);
  return {{c * axis[0] - s * axis[1], c * axis[1] + s * axis[0]}, front.reach};
}

/// Moves the fronts of a bond to where it has cracked now, so that nothing heals.
inline void crack(const std::vector<ContactOutline::Edge>& outline, StraightFront next,
                  PointBond<3>* now) {
  const std::size_t k = std::abs(next.n[0]) >= std::abs(next.n[1]) ? (next.n[0] > 0 ? 0U : 1U)
                                                                   : (next.n[1] > 0 ? 2U : 3U);
  BondFront<3>& front = now[k].front;
  const auto axis = axis_towards(k);
  const double slant = std::atan2(axis[0] * next.n[1] - axis[1] * next.n[0],
                                  axis[0] * next.n[0] + axis[1] * next.n[1]);
  if (!std::isfinite(front.reach)) {
    front = {next.reach, slant};
    return;
  }
  StraightFront old = front_towards(k, front);
  const auto beyond = [&](const StraightFront& line) {
    return within(outline, {{-line.n[0], -line.n[1]}, -line.reach});
  };
  StraightFront as_next = next, as_old = old;
  as_next.reach = std::min(next.reach, next.least_of(beyond(old)));
  as_old.reach = std::min(old.reach, old.least_of(beyond(next)));
  front = area_within(outline, as_next) >= area_within(outline, as_old)
              ? BondFront<3>{as_next.reach, slant}
              : BondFront<3>{as_old.reach, front.slant};
}

VOUSSOIR_INLINE PressedPart<3> bonded_part(const double* pressed_in, const KeptOutline<3>& outline,
                                           const BondRelease<3>* of, PointBond<3>* now) {
  const PointBond<3> bond = common_bond(of, now);
  if (outline.edges == nullptr) return {};
  const std::array<double, 3> plane = PressedPart<3>::plane_through(pressed_in);
  const double mean = plane[0], x = plane[1], y = plane[2];
  const double steep = std::sqrt(x * x + y * y);
  if (mean >= outline.radius * steep) return {};
  if (bond.area == 0) return PressedPart<3>::of(pressed_in, outline);
  const std::vector<ContactOutline::Edge>& all = outline.edges->edges;
  bool is_cracked = false;
  const auto within_fronts = [&] {
    std::vector<ContactOutline::Edge> edges = all;
    for (std::size_t k = 0; k < PressedPart<3>::count; ++k) {
      if (!std::isfinite(now[k].front.reach)) continue;
      edges = within(edges, front_towards(k, now[k].front));
      is_cracked = true;
    }
    return edges;
  };
  std::vector<ContactOutline::Edge> held = within_fronts();
  // Towards where it opens, and where it is closed no farther than this.
  const double e[2] = {steep > 0 ? -x / steep : 1.0, steep > 0 ? -y / steep : 0.0};
  const auto closed_by = [&](double way) {
    const double reach =
        steep > 0 ? (mean - way) / steep : std::copysign(2 * outline.radius, mean - way);
    return StraightFront{{e[0], e[1]}, reach};
  };
  const StraightFront torn = closed_by(-bond.stretch), released = closed_by(0);
  const bool cracks = std::any_of(held.begin(), held.end(),
                                  [&](const auto& edge) { return torn.beyond(edge.from) > 0; });
  if (!cracks && !is_cracked) return {};
  if (cracks) {
    crack(all, torn, now);
    held = within_fronts();
  }
  AreaMoments bonded, sum;
  bonded.add(held);
  const double area = std::min(bond.area, bonded.area / outline.edges->area);
  for (std::size_t k = 0; k < PressedPart<3>::count; ++k)
    now[k].area = area > least_bond ? area : 0;
  if (now[0].area == 0) return PressedPart<3>::of(pressed_in, outline);
  sum.add(within(all, released));
  sum.add(held);
  sum.add(within(held, released), -1);
  // In axes along e, about the centroid: a part that is thin along it keeps its width.
  const double u = sum.u / sum.area, v = sum.v / sum.area;
  const double xx = sum.uu / sum.area - u * u, xy = sum.uv / sum.area - u * v,
               yy = sum.vv / sum.area - v * v;
  return PressedPart<3>::with_moments(
      sum.area / outline.edges->area, e, e[0] * u + e[1] * v, e[0] * v - e[1] * u,
      std::max(0.0, e[0] * e[0] * xx + 2 * e[0] * e[1] * xy + e[1] * e[1] * yy),
      e[0] * e[1] * (yy - xx) + (e[0] * e[0] - e[1] * e[1]) * xy,
      std::max(0.0, e[1] * e[1] * xx - 2 * e[0] * e[1] * xy + e[0] * e[0] * yy));
}

#endif

}  // namespace voussoir::detail
