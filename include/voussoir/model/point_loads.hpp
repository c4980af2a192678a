// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/bonded_part.hpp>
#include <voussoir/model/contact_outline.hpp>
#include <voussoir/model/detail/root_of_lift.hpp>
#include <voussoir/model/moving_contact.hpp>
#include <voussoir/model/pressed_part.hpp>
#include <voussoir/model/reference_contact.hpp>

// The loads of the points of a joint that is open from an edge on.
namespace voussoir::detail {

/// Moves the loads of the points of a contact to its pressed part. Normal stress and opening are
/// those there; shear stress and slip go with the point.
VOUSSOIR_INLINE void move_loads(const PressedPart<2>& part, PointLoad<2>* loads);
VOUSSOIR_INLINE void move_loads(const PressedPart<3>& part, PointLoad<3>* loads);

/// Finds the part that is pressed or bonded, the joint lifted by so much, and moves the loads
/// there.
/// @param points  points.release(k, load): what `release_opening` says of point k
/// @param lift    since the last commit [m], >= 0
template <int Dim, class Points>
[[nodiscard]] PressedPart<Dim> press_lifted(PointLoad<Dim>* loads, const KeptOutline<Dim>& outline,
                                            const Points& points, double lift) {
  constexpr std::size_t count = PressedPart<Dim>::count;
  constexpr bool has_bond =
      std::is_same_v<decltype(points.release(std::size_t{0}, loads[0])), BondRelease<Dim>>;
  double pressed_in[count];
  PressedPart<Dim> part;
  if constexpr (has_bond) {
    BondRelease<Dim> of[count];
    for (std::size_t k = 0; k < count; ++k) {
      of[k] = points.release(k, loads[k]);
      pressed_in[k] = of[k].opening - loads[k].motion.opening + lift;
    }
    PointBond<Dim> bonds[count];
    part = bonded_part(pressed_in, outline, of, bonds);
    for (std::size_t k = 0; k < count; ++k) loads[k].bond = bonds[k];
  } else {
    for (std::size_t k = 0; k < count; ++k)
      pressed_in[k] = points.release(k, loads[k]) - loads[k].motion.opening + lift;
    part = PressedPart<Dim>::of(pressed_in, outline);
  }
  if (part.is_whole()) {
    if (lift > 0)
      for (std::size_t k = 0; k < count; ++k) loads[k].motion.opening -= lift;
    return part;
  }
  move_loads(part, loads);
  // What lets a point go may not be linear along the joint: how far it is pressed in is.
  if constexpr (has_bond)
    for (std::size_t k = 0; k < count; ++k)
      loads[k].motion.opening = opening_of(points.release(k, loads[k])) -
                                part.at(k, [&](std::size_t i) { return pressed_in[i]; });
  else
    for (std::size_t k = 0; k < count; ++k) loads[k].motion.opening -= lift;
  return part;
}

/// The part that is pressed or bonded of a joint that dilates. Slip lifts all of it at once, by the
/// mean of what its points would lift it: rigid bodies ride on it as one, and what each point rubs
/// pays for its share of that, wherever it is. The lift presses the joint shut, and the more it
/// does the less slips: it is found for all points together.
template <int Dim, class Points>
[[nodiscard]] PressedPart<Dim> press_dilating(PointLoad<Dim>* loads,
                                              const KeptOutline<Dim>& outline,
                                              const Points& points) {
  constexpr std::size_t count = PressedPart<Dim>::count;
  PointLoad<Dim> of_whole[count];
  std::copy_n(loads, count, of_whole);
  double bears = 0;
  PressedPart<Dim> part;
  const auto mean_at = [&](double lift) {
    std::copy_n(of_whole, count, loads);
    part = press_lifted<Dim>(loads, outline, points, lift);
    double sum = 0, plain = 0;
    bears = 0;
    for (std::size_t k = 0; k < count; ++k) {
      loads[k].lift = lift;
      const PointLift of = points.lift(k, loads[k]);
      bears += of.weight;
      sum += of.weight * of.lift;
      plain += of.lift / count;
    }
    return bears > 0 ? sum / bears : plain;
  };
  const double first = mean_at(0);
  if (!(first > 0)) return part;
  double deep = 0;
  for (std::size_t k = 0; k < count; ++k)
    deep = std::max(
        deep, std::abs(opening_of(points.release(k, of_whole[k])) - of_whole[k].motion.opening));
  const double rounding = 1e-13 * deep;
  if (first <= rounding) return part;
  (void)root_of_lift(first, rounding, mean_at);
  // What slips while it is open lifts nothing.
  if (!(bears > 0)) (void)mean_at(0);
  return part;
}

/// Finds the part that is pressed or bonded, and moves the loads there.
/// @param points  see `PointsOf`
template <int Dim, class Points>
[[nodiscard]] PressedPart<Dim> press(PointLoad<Dim>* loads, const KeptOutline<Dim>& outline,
                                     const Points& points) {
  if (points.dilates()) return press_dilating<Dim>(loads, outline, points);
  return press_lifted<Dim>(loads, outline, points, 0);
}

/// `press` for a contact in motion. In 3-D it is that.
///
/// In 2-D what is added to slips since the last commit is the slip of the rock that is at the
/// pressed part now, and shear acts there. The points of the closed joint will not do: as bodies
/// turn by t about a hinge, they move along the face of body a by their distance from the hinge
/// times (1 - cos t), and the hinge does not slip. Slip is linear along the joint, so the two tell
/// it.
/// @param loads  with the slips of the points of the closed joint; afterwards as laws have them:
///               who brings histories up to date moves `zero` by what these differ
/// @param at     at(k) is point k
template <class PointAt, class Points>
[[nodiscard]] PressedPart<2> press_in_motion(PointLoad<2>* loads, const KeptOutline<2>& outline,
                                             const PointAt& at, const Points& points) {
  PointLoad<2> of_whole[2] = {loads[0], loads[1]};
  const PressedPart<2> part = press<2>(loads, outline, points);
  if (part.is_whole()) return part;
  const double then[2] = {at(0).committed.slip, at(1).committed.slip};
  const double since[2] = {loads[0].motion.slip[0] - then[0], loads[1].motion.slip[0] - then[1]};
  for (int k = 0; k < 2; ++k) of_whole[k].motion.slip[0] = then[k] + part.at(k, since[0], since[1]);
  if (points.dilates()) {  // by its slip
    std::copy_n(of_whole, 2, loads);
    return press<2>(loads, outline, points);
  }
  for (int k = 0; k < 2; ++k) loads[k].motion.slip = of_whole[k].motion.slip;
  return part;
}
template <class PointAt, class Points>
[[nodiscard]] PressedPart<3> press_in_motion(PointLoad<3>* loads, const KeptOutline<3>& outline,
                                             const PointAt&, const Points& points) {
  return press<3>(loads, outline, points);
}

/// To be called when the points of a joint have brought their history up to date. Where one of them
/// has failed in shear by that, the joint lets go what it held in tension, and they do so again.
/// @param loads    as they were
/// @param load_of  load_of(k) of a point of the whole
/// @param points   see `PointsOf`;  @param commit  commit(k, load) is the energy that is lost [J]
/// @return  energy that is lost [J]
template <int Dim, class LoadOf, class Points, class Commit>
double let_go_of_bond(const PointLoad<Dim>* loads, const KeptOutline<Dim>& outline,
                      const LoadOf& load_of, const Points& points, const Commit& commit) {
  double lost = 0;
  if constexpr (std::is_same_v<decltype(points.release(std::size_t{0}, loads[0])),
                               BondRelease<Dim>>) {
    constexpr std::size_t count = PressedPart<Dim>::count;
    bool lets_go = false;
    for (std::size_t k = 0; k < count; ++k)
      lets_go = lets_go || (std::isfinite(loads[k].bond.stretch) &&
                            points.release(k, loads[k]).stretch < loads[k].bond.stretch);
    if (!lets_go) return lost;
    PointLoad<Dim> again[count];
    for (std::size_t k = 0; k < count; ++k) again[k] = load_of(k);
    (void)press<Dim>(again, outline, points);
    for (std::size_t k = 0; k < count; ++k) lost += commit(k, again[k]);
  }
  return lost;
}

/// Whether a contact in 3-D may be other than pressed, or open, all over: hardly ever.
/// @param points   see `PointsOf`;  @param load_of  load_of(k) of point k
/// @return  true, too, of a joint that dilates: all of its points lift it together
template <class Points, class LoadOf>
[[nodiscard]] bool may_be_cut(const KeptOutline<3>& outline, const Points& points,
                              const LoadOf& load_of) {
  if (points.dilates()) return true;
  double pressed_in[PressedPart<3>::count];
  for (std::size_t k = 0; k < PressedPart<3>::count; ++k) {
    const PointLoad<3> load = load_of(k);
    pressed_in[k] = opening_of(points.release(k, load)) - load.motion.opening;
  }
  constexpr bool has_bond =
      !std::is_same_v<decltype(points.release(std::size_t{0}, load_of(std::size_t{0}))), double>;
  return PressedPart<3>::may_be_cut(pressed_in, outline) || (has_bond && pressed_in[0] < 0);
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
/// @param of        see `PointsOf`
template <int Dim, class PointAt, class LoadOf, class Points, class Visit>
void visit_pressed(std::size_t count, const KeptOutline<Dim>& outline, const PointAt& point_at,
                   const LoadOf& load_of, const Points& of, Visit&& visit) {
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
  Part part;
  if constexpr (requires { points[0].committed; })
    part = press_in_motion(
        loads.data(), outline, [&](std::size_t k) -> const Point& { return points[k]; }, of);
  else
    part = press<Dim>(loads.data(), outline, of);
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

#if VOUSSOIR_BODIES

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

#endif

}  // namespace voussoir::detail
