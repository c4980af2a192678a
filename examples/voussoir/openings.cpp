// SPDX-License-Identifier: MIT
#include "openings.hpp"

// g++ 12 sees a variable of its intersection without a value, which is set before it is read.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/geometry/algorithms/append.hpp>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/intersection.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <algorithm>
#include <cmath>
#include <utility>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/rockmass/opening_checks.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/section_part.hpp>

namespace voussoir::program {

namespace {

TunnelAxis axis_of(const Input& input, std::size_t opening) {
  const TunnelAxis tunnel(zeros<Vec3>(), 0, input.tunnel.plunge);
  if (opening == 0) return tunnel;
  const OpeningInput& o = input.openings[opening - 1];
  return TunnelAxis(tunnel.point(Vec2(o.at[0], o.at[1]), o.place), o.turn,
                    o.plunge.value_or(o.turn == 0 ? input.tunnel.plunge : 0));
}

/// What of a section lies in an outline, by Boost.Geometry.
SimplePolygon common_part(const SimplePolygon& section, const std::vector<Point>& outline) {
  namespace bg = boost::geometry;
  using BoostPoint = bg::model::d2::point_xy<double>;
  using BoostPolygon = bg::model::polygon<BoostPoint, false>;  // anticlockwise
  BoostPolygon a, b;
  for (const Vec2& v : section.vertices()) bg::append(a.outer(), BoostPoint(v.x(), v.y()));
  for (const Point& p : outline) bg::append(b.outer(), BoostPoint(p[0], p[1]));
  bg::correct(a);
  bg::correct(b);
  bg::model::multi_polygon<BoostPolygon> pieces;
  bg::intersection(a, b, pieces);
  // Where the two run along each other rounding leaves splinters.
  std::erase_if(pieces, [&](const BoostPolygon& piece) {
    return !(bg::area(piece) > 1e-9 * section.area());
  });
  if (pieces.empty()) throw InvalidInput("no part of the section lies in it");
  if (pieces.size() > 1)
    throw InvalidInput("takes " + std::to_string(pieces.size()) + " pieces of the section at once");
  std::vector<Vec2> corners;
  const double apart = 1e-9 * section.perimeter();
  for (const BoostPoint& p : pieces.front().outer()) {
    const Vec2 corner(p.x(), p.y());
    if (corners.empty() || length_of(Vec2(corner - corners.back())) > apart)
      corners.push_back(corner);
  }
  while (corners.size() > 1 && length_of(Vec2(corners.front() - corners.back())) <= apart)
    corners.pop_back();
  return SimplePolygon(std::move(corners));
}

}  // namespace

const OutlineInput& outline_input(const Input& input, std::size_t opening) {
  if (opening == 0) return input.tunnel;
  return input.openings[opening - 1];
}

std::string opening_key(std::size_t opening) {
  return opening == 0 ? "tunnel" : "opening[" + std::to_string(opening - 1) + "]";
}

std::string opening_name(const Input& input, std::size_t opening) {
  return opening == 0 ? "tunnel" : input.openings[opening - 1].name;
}

bool is_modelled(const Input& input, std::size_t opening) {
  return opening == 0 || input.is_spatial() ||
         input.openings[opening - 1].is_along_tunnel(input.tunnel);
}

bool is_modelled(const Input& input, const BoltsInput& bolts) {
  return is_modelled(input, bolts.opening) && (input.is_spatial() || !bolts.ahead);
}

Domain<2> section_domain(const Input& input) {
  Domain<2> domain = domain_around(opening_of(input), input.model.width, input.tunnel.cover,
                                   input.model.below_invert);
  domain.site_origin = Vec2(input.model.origin[0], input.model.origin[1]);
  return domain;
}

Domain<3> spatial_domain(const Input& input) {
  const Domain<2> section = section_domain(input);
  // Under the invert is ground all along, however far it goes down.
  const double fall = input.model.length * elementary::tangent(std::max(input.tunnel.plunge, 0.0));
  return {{section.low.x(), 0, section.low.y() - fall},
          {section.high.x(), input.model.length, section.high.y()},
          {input.model.origin[0], 0, input.model.origin[1]}};
}

Vec2 centre_in_section(const Input& input, std::size_t opening) {
  if (opening == 0) return Vec2::Zero();
  const Point& at = input.openings[opening - 1].at;
  return {at[0], at[1]};
}

SimplePolygon in_section(const Input& input, std::size_t opening, const SimplePolygon& outline) {
  if (opening == 0) return outline;
  const Vec2 centre = centre_in_section(input, opening);
  std::vector<Vec2> corners = outline.vertices();
  for (Vec2& corner : corners) corner += centre;
  return SimplePolygon(std::move(corners));
}

SimplePolygon opening_in_section(const Input& input, std::size_t opening) {
  return in_section(input, opening, outline_of(outline_input(input, opening)));
}

std::optional<SimplePolygon> outline_of_round(const Input& input, const StageInput& round) {
  const SimplePolygon section = outline_of(outline_input(input, round.opening));
  if (!round.outline.empty()) return common_part(section, round.outline);
  return outline_of_part(section, *round.part);
}

Drive drive_of(const Input& input, std::size_t opening) {
  const double tunnel_end = input.round_count() * input.stretch();
  const bool goes_through = !(tunnel_end < input.tunnel_length() * (1 - 1e-9));
  if (opening == 0)
    return {0, tunnel_end, input.stretch(), input.round_count(), true, goes_through};
  const OpeningInput& o = input.openings[opening - 1];
  const bool is_along = o.is_along_tunnel(input.tunnel);
  Drive drive{};
  drive.has_open_start = is_along && !o.from;
  drive.has_open_end = is_along && !o.to && goes_through;
  drive.from = o.from.value_or(is_along ? -o.place : 0);
  drive.to = o.to.value_or(tunnel_end - o.place);
  drive.stretch = o.round_length.value_or(drive.length());
  // More than a thousand are refused; no more than a number holds.
  drive.count =
      static_cast<int>(std::clamp(std::ceil(drive.length() / drive.stretch - 1e-9), 1.0, 1e9));
  return drive;
}

int advance_count(const Input& input) {
  int advances = input.round_count();
  for (const StageInput& entry : input.stages)
    advances = std::max(advances, drive_of(input, entry.opening).count + entry.behind);
  return advances;
}

PrismaticOpening opening_in_space(const Input& input, std::size_t opening,
                                  const SimplePolygon& outline) {
  constexpr double endless = PrismaticOpening::endless;
  const Drive drive = drive_of(input, opening);
  return {outline, axis_of(input, opening), drive.has_open_start ? -endless : drive.from,
          drive.has_open_end ? endless : drive.to};
}

PrismaticOpening stretch_in_space(const Input& input, std::size_t opening,
                                  const SimplePolygon& outline, int stretch) {
  constexpr double endless = PrismaticOpening::endless;
  const Drive drive = drive_of(input, opening);
  const bool is_first = stretch == 0, is_last = stretch == drive.count - 1;
  return {outline, axis_of(input, opening),
          is_first && drive.has_open_start ? -endless : drive.begin_of(stretch),
          is_last && drive.has_open_end ? endless : drive.end_of(stretch)};
}

StripsOfStretch strips_of(const Input& input, std::size_t opening) {
  const double stretch = drive_of(input, opening).stretch;
  const double asked = input.lining->rib_spacing.value_or(std::min(1.0, stretch));
  const int count = std::max(1, static_cast<int>(std::floor(stretch / asked + 1e-9)));
  return {count, stretch / count};
}

double strip_width(const Input& input) { return strips_of(input, input.lining->opening).width; }

namespace {

/// @param before  openings that are there, with their numbers
template <class Geometry>
std::string fault_beside(
    const Input& input, const typename Geometry::Opening& opening, const RockMass<Geometry>& ground,
    const std::vector<std::pair<std::size_t, typename Geometry::Opening>>& before) {
  try {
    check_opening(opening, ground);
  } catch (const InvalidInput& fault) {
    const std::string text = fault.what(), begin = "opening: it ";
    return text.starts_with(begin) ? text.substr(begin.size())
                                   : text.substr(sizeof "opening: " - 1);
  }
  // What is written with ten digits still touches.
  const double tolerance = 1e3 * ground.domain.tolerance();
  for (const auto& [number, other] : before)
    if (const auto place = common_rock(opening, other, tolerance))
      return "takes out rock of the " + opening_name(input, number) + ", at " +
             text_of<Geometry::dim>(*place) + " m";
  return "";
}

template <class Geometry, class Domain, class Place>
std::optional<OpeningFault> fault_among(const Input& input, const Domain& domain,
                                        const Place& place) {
  RockMass<Geometry> ground;
  ground.domain = domain;
  std::vector<std::pair<std::size_t, typename Geometry::Opening>> before;
  for (std::size_t k = 0; k <= input.openings.size(); ++k) {
    if (!is_modelled(input, k)) continue;
    const typename Geometry::Opening opening = place(k);
    if (std::string text = fault_beside(input, opening, ground, before); !text.empty())
      return OpeningFault{k, std::move(text)};
    before.emplace_back(k, opening);
  }
  return std::nullopt;
}

}  // namespace

std::optional<OpeningFault> fault_of_openings(const Input& input) {
  if (input.is_spatial())
    return fault_among<Spatial>(input, spatial_domain(input), [&](std::size_t k) {
      return opening_in_space(input, k, outline_of(outline_input(input, k)));
    });
  return fault_among<Planar>(input, section_domain(input),
                             [&](std::size_t k) { return opening_in_section(input, k); });
}

}  // namespace voussoir::program
