// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/outline_overlap.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

// What is wrong with an opening before rock is taken out, and with the rock after it. Messages name
// the place and what helps.

/// A point that an opening and one before it would both take out, or nothing.
///
/// Openings along one direction must not overlap: rounds meet in a face, a bench in the floor of
/// its heading. An enlargement may have all of the earlier one inside, with rock around it.
/// Openings that cross at an angle may overlap, or a cross-drift could not reach the curved wall of
/// a tunnel.
/// @param tolerance  what overlaps by less, touches [m]
[[nodiscard]] VOUSSOIR_INLINE std::optional<Vec2> common_rock(const SimplePolygon& opening,
                                                              const SimplePolygon& before,
                                                              double tolerance);
[[nodiscard]] VOUSSOIR_INLINE std::optional<Vec3> common_rock(const PrismaticOpening& opening,
                                                              const PrismaticOpening& before,
                                                              double tolerance);

/// @throws InvalidInput  the opening leaves the domain (2-D), lies beside it (3-D), or overlaps one
///                       along the same direction that has been taken out
VOUSSOIR_INLINE void check_opening(const SimplePolygon& opening, const RockMass<Planar>& mass);
VOUSSOIR_INLINE void check_opening(const PrismaticOpening& opening, const RockMass<Spatial>& mass);

/// True if openings that meet a side of the domain with their section could part the rock.
[[nodiscard]] inline bool may_part(const SimplePolygon&, const Domain<2>&) { return false; }
[[nodiscard]] VOUSSOIR_INLINE bool may_part(const PrismaticOpening& opening,
                                            const Domain<3>& domain);

/// @throws InvalidInput  openings that meet the sides of the domain have left rock in parts that
/// both
///                       reach a side other than the top, and are more than a hundredth of the
///                       domain. Less is a splinter: it stands, or the rock outside holds it
/// @cost  contacts from the cuts, where an opening could have done so; else nothing
template <class Geometry>
void check_in_one_piece(const RockMass<Geometry>& mass);

namespace detail {

template <class Opening>
void check_taken_out(const Opening& opening, double measure) {
  if (measure > 0) return;
  if constexpr (std::is_same_v<Opening, PrismaticOpening>)
    throw InvalidInput(
        message({"opening: there is no rock in it, around ",
                 text_of<3>(opening.in_space(opening.section().vertices().front(),
                                             std::isfinite(opening.from()) ? opening.from() : 0)),
                 " m; excavate a round once, and where rock is"}));
  else
    throw InvalidInput(
        message({"opening: there is no rock in it, around ", text_of<2>(opening.vertices().front()),
                 " m; excavate a round once, and where rock is"}));
}

/// "round 2 (the first is 1)" of the opening with an index.
[[nodiscard]] inline std::string round_name(std::size_t index) {
  return "round " + std::to_string(index + 1);
}

/// @throws InvalidInput
template <class Geometry>
void check_no_overlap(const typename Geometry::Opening& opening, const RockMass<Geometry>& mass) {
  constexpr int dim = Geometry::dim;
  // What is written with ten digits still touches.
  const double tolerance = 1e3 * mass.domain.tolerance();
  for (std::size_t k = 0; k < mass.openings.size(); ++k)
    if (const auto place = common_rock(opening, mass.openings[k], tolerance))
      throw InvalidInput(
          message({"opening: at ", text_of<dim>(*place), " m it overlaps ", round_name(k),
                   ", which has been excavated: let it begin where that ends, or leave it out"}));
}

/// Groups of bodies that hang together, by union of contacts.
class RockGroups {
 public:
  explicit RockGroups(std::size_t count) : up_(count) {
    std::iota(up_.begin(), up_.end(), std::size_t{0});
  }
  void link(std::size_t a, std::size_t b) { up_[root(a)] = root(b); }
  [[nodiscard]] std::size_t root(std::size_t b) {
    while (up_[b] != b) b = up_[b] = up_[up_[b]];
    return b;
  }

 private:
  std::vector<std::size_t> up_;
};

}  // namespace detail

template <class Geometry>
void check_in_one_piece(const RockMass<Geometry>& mass) {
  constexpr int dim = Geometry::dim;
  if (std::none_of(mass.openings.begin(), mass.openings.end(),
                   [&](const auto& opening) { return may_part(opening, mass.domain); }))
    return;
  detail::RockGroups groups(mass.bodies.size());
  for (const auto& c : CutContacts::find(mass))
    groups.link(static_cast<std::size_t>(c.a), static_cast<std::size_t>(c.b));
  std::vector<double> held(mass.bodies.size(), 0.0);
  for (const auto& edge : boundary_facets(mass))
    if (edge.side != SideOf<dim>::top) held[groups.root(static_cast<std::size_t>(edge.body))] = 1;
  std::vector<double> measure(mass.bodies.size(), 0.0);
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    measure[groups.root(b)] += mass.bodies[b].properties.measure;
  std::vector<std::size_t> parts;  // a body of each
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    if (groups.root(b) == b && held[b] > 0 && measure[b] > 0.01 * mass.domain.measure())
      parts.push_back(b);
  if (parts.size() < 2) return;
  const auto place = [&](std::size_t k) {
    return text_of<dim>(mass.bodies[parts[k]].properties.centroid);
  };
  throw InvalidInput(
      message({"opening: it cuts the domain in ", parts.size(), " parts, ", measure[parts[0]],
               " m^", dim, " with ", place(0), " m in it and ", measure[parts[1]], " m^", dim,
               " with ", place(1), " m: enlarge the domain, or end the opening inside it"}));
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::optional<Vec2> common_rock(const SimplePolygon& opening,
                                                const SimplePolygon& before, double tolerance) {
  std::optional<Vec2> place = overlap_of(opening, before, tolerance);
  if (place && encloses(opening, before, tolerance) && !encloses(before, opening, tolerance))
    return {};
  return place;
}

VOUSSOIR_INLINE std::optional<Vec3> common_rock(const PrismaticOpening& opening,
                                                const PrismaticOpening& before, double tolerance) {
  const TunnelAxis& axis = opening.axis();
  if (!axis.is_parallel_to(before.axis())) return {};
  const double way = dot_product(axis.along(), before.axis().along()) < 0 ? -1 : 1;
  const double shift = opening.along(before.axis().origin());
  double low = shift + way * before.from(), high = shift + way * before.to();
  if (way < 0) std::swap(low, high);
  const double from = std::max(low, opening.from()), to = std::min(high, opening.to());
  if (!(to - from > tolerance)) return {};
  std::vector<Vec2> corners;
  for (const Vec2& v : before.section().vertices())
    corners.push_back(opening.across(before.in_space(v, 0)));
  const SimplePolygon seen(std::move(corners));
  const auto place = overlap_of(opening.section(), seen, tolerance);
  if (!place) return {};
  const bool is_longer = opening.from() < low - tolerance || opening.to() > high + tolerance,
             is_shorter = opening.from() > low + tolerance || opening.to() < high - tolerance;
  if (!is_shorter && encloses(opening.section(), seen, tolerance) &&
      (is_longer || !encloses(seen, opening.section(), tolerance)))
    return {};
  const bool begins = std::isfinite(from), ends = std::isfinite(to);
  return opening.in_space(*place,
                          begins && ends ? 0.5 * (from + to) : (begins ? from : (ends ? to : 0)));
}

VOUSSOIR_INLINE void check_opening(const SimplePolygon& opening, const RockMass<Planar>& mass) {
  const Domain<2>& domain = mass.domain;
  for (const Vec2& v : opening.vertices())
    if (!(all_less(domain.low, v) && all_less(v, domain.high)))
      throw InvalidInput(
          message({"opening: its outline touches or leaves the domain at ", text_of<2>(v), " m"}));
  detail::check_no_overlap(opening, mass);
}

VOUSSOIR_INLINE void check_opening(const PrismaticOpening& opening, const RockMass<Spatial>& mass) {
  const Domain<3>& domain = mass.domain;
  const auto [low, high] = opening.local_box();
  const ConvexPolyhedron ground = as_block(domain);
  Vec3 from = opening.axis().local(ground.vertices().front()), to = from;
  for (const Vec3& v : ground.vertices()) {
    const Vec3 seen = opening.axis().local(v);
    from = smaller_of(from, seen);
    to = larger_of(to, seen);
  }
  const double tolerance = domain.tolerance();
  for (int k = 0; k < 3; ++k)
    if (!(high[k] > from[k] + tolerance && low[k] < to[k] - tolerance)) {
      static constexpr std::array names{"across its axis, to the right,",
                                        "across its axis, upwards,", "along its axis"};
      throw InvalidInput(
          message({"opening: it lies beside the domain, which ", names[static_cast<std::size_t>(k)],
                   " reaches from ", from[k], " to ", to[k], " m; the opening from ", low[k],
                   " to ", high[k], " m"}));
    }
  detail::check_no_overlap(opening, mass);
}

VOUSSOIR_INLINE bool may_part(const PrismaticOpening& opening, const Domain<3>& domain) {
  const double reach = 2 * domain.diameter() + length_of(opening.axis().origin()) +
                       largest_entry(larger_of(magnitudes(domain.low), magnitudes(domain.high)));
  const double from = std::max(opening.from(), -reach), to = std::min(opening.to(), reach);
  // Of a prism that leaves the domain by its ends alone all edges along the axis go through the
  // same two sides.
  int way = -1;
  for (int k = 0; k < 3; ++k)
    if (std::abs(opening.axis().along()[k]) > 0.999) way = k;
  for (const Vec2& v : opening.section().vertices())
    for (const double s : {from, to}) {
      const Vec3 p = opening.in_space(v, s);
      for (int k = 0; k < 3; ++k)
        if (k != way && !(p[k] > domain.low[k] && p[k] < domain.high[k])) return true;
    }
  return false;
}

#endif

}  // namespace voussoir
