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
#include <voussoir/model/moving_contact.hpp>
#include <voussoir/model/pressed_part.hpp>
#include <voussoir/model/reference_contact.hpp>

// The loads of the points of a joint that is open from an edge on.
namespace voussoir::detail {

/// Moves the loads of the points of a contact to its pressed part. Normal stress and opening are
/// those there; shear stress and slip go with the point.
VOUSSOIR_INLINE void move_loads(const PressedPart<2>& part, PointLoad<2>* loads);
VOUSSOIR_INLINE void move_loads(const PressedPart<3>& part, PointLoad<3>* loads);

/// Finds the part that is pressed or bonded, and moves the loads there.
/// @param release  release(k, load): what `release_opening` says of point k
template <int Dim, class Release>
[[nodiscard]] PressedPart<Dim> press(PointLoad<Dim>* loads, const KeptOutline<Dim>& outline,
                                     const Release& release) {
  constexpr std::size_t count = PressedPart<Dim>::count;
  constexpr bool has_bond =
      std::is_same_v<decltype(release(std::size_t{0}, loads[0])), BondRelease<Dim>>;
  double pressed_in[count];
  PressedPart<Dim> part;
  if constexpr (has_bond) {
    BondRelease<Dim> of[count];
    for (std::size_t k = 0; k < count; ++k) {
      of[k] = release(k, loads[k]);
      pressed_in[k] = of[k].opening - loads[k].motion.opening;
    }
    PointBond<Dim> bonds[count];
    part = bonded_part(pressed_in, outline, of, bonds);
    for (std::size_t k = 0; k < count; ++k) loads[k].bond = bonds[k];
  } else {
    for (std::size_t k = 0; k < count; ++k)
      pressed_in[k] = release(k, loads[k]) - loads[k].motion.opening;
    part = PressedPart<Dim>::of(pressed_in, outline);
  }
  if (part.is_whole()) return part;
  move_loads(part, loads);
  // What lets a point go may not be linear along the joint: how far it is pressed in is.
  if constexpr (has_bond)
    for (std::size_t k = 0; k < count; ++k)
      loads[k].motion.opening = opening_of(release(k, loads[k])) -
                                part.at(k, [&](std::size_t i) { return pressed_in[i]; });
  return part;
}

/// To be called when the points of a joint have brought their history up to date. Where one of them
/// has failed in shear by that, the joint lets go what it held in tension, and they do so again.
/// @param loads    as they were
/// @param load_of  load_of(k) of a point of the whole
/// @param release  see `press`;  @param commit  commit(k, load) is the energy that is lost [J]
/// @return  energy that is lost [J]
template <int Dim, class LoadOf, class Release, class Commit>
double let_go_of_bond(const PointLoad<Dim>* loads, const KeptOutline<Dim>& outline,
                      const LoadOf& load_of, const Release& release, const Commit& commit) {
  double lost = 0;
  if constexpr (std::is_same_v<decltype(release(std::size_t{0}, loads[0])), BondRelease<Dim>>) {
    constexpr std::size_t count = PressedPart<Dim>::count;
    bool lets_go = false;
    for (std::size_t k = 0; k < count; ++k)
      lets_go = lets_go || (std::isfinite(loads[k].bond.stretch) &&
                            release(k, loads[k]).stretch < loads[k].bond.stretch);
    if (!lets_go) return lost;
    PointLoad<Dim> again[count];
    for (std::size_t k = 0; k < count; ++k) again[k] = load_of(k);
    (void)press<Dim>(again, outline, release);
    for (std::size_t k = 0; k < count; ++k) lost += commit(k, again[k]);
  }
  return lost;
}

/// Whether a contact in 3-D may be other than pressed, or open, all over: hardly ever.
/// @param release  release(k): what `release_opening` says of point k, as it is loaded
/// @param opening  opening(k) of point k [m]
template <class Release, class Opening>
[[nodiscard]] bool may_be_cut(const KeptOutline<3>& outline, const Release& release,
                              const Opening& opening) {
  double pressed_in[PressedPart<3>::count];
  for (std::size_t k = 0; k < PressedPart<3>::count; ++k)
    pressed_in[k] = opening_of(release(k)) - opening(k);
  constexpr bool has_bond = !std::is_same_v<decltype(release(std::size_t{0})), double>;
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
