// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/geometry/tunnel_axis.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/opening_checks.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/section_part.hpp>

#if VOUSSOIR_DESIGN_BODIES
#include <voussoir/geometry/boost_common_part.hpp>
#endif

/// The openings of an analysis, by number: 0 is the tunnel, then come the others. Where each
/// lies, what of it a round takes out, and in which stretches it is driven.
namespace voussoir::design {

[[nodiscard]] VOUSSOIR_DESIGN_INLINE const OutlineInput& outline_input(const AnalysisInput& input,
                                                                       std::size_t opening);
/// "tunnel", or the name of another.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::string opening_name(const AnalysisInput& input,
                                                              std::size_t opening);
/// False for one that a section does not show.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE bool is_modelled(const AnalysisInput& input,
                                                      std::size_t opening);

/// The same of bolts: forepoles are in 3-D alone.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE bool is_modelled(const AnalysisInput& input,
                                                      const BoltsInput& bolts);

/// The ground of a section; the same of 3-D, in which the tunnel begins at the face of the domain.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE Domain<2> section_domain(const AnalysisInput& input);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE Domain<3> spatial_domain(const AnalysisInput& input);

/// Centre of its outline in the section [m].
[[nodiscard]] VOUSSOIR_DESIGN_INLINE Vec2 centre_in_section(const AnalysisInput& input,
                                                            std::size_t opening);
/// An outline about the centre of an opening, where it lies in the section.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE SimplePolygon in_section(const AnalysisInput& input,
                                                              std::size_t opening,
                                                              const SimplePolygon& outline);
/// The outline of an opening where it lies in the section.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE SimplePolygon opening_in_section(const AnalysisInput& input,
                                                                      std::size_t opening);

/// What a round excavates of its opening, about the centre of that; none: nothing of it.
/// @pre  the round excavates
/// @throws InvalidInput  it takes several pieces, or leaves some out of which it is made up
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::optional<SimplePolygon> outline_of_round(
    const AnalysisInput& input, const StageInput& round);

/// How an opening is driven along its axis, in 3-D.
struct Drive {
  double from, to;      ///< places along the axis [m]
  double stretch;       ///< what is excavated at a time [m]; the last may be shorter
  int count;            ///< of stretches
  bool has_open_start;  ///< it begins where the domain does
  bool has_open_end;    ///< no rock is left ahead of it

  [[nodiscard]] double length() const { return to - from; }
  [[nodiscard]] double begin_of(int k) const { return from + k * stretch; }
  [[nodiscard]] double end_of(int k) const {
    return k + 1 == count ? to : from + (k + 1) * stretch;
  }
};
/// @pre  the opening ends somewhere, see `OpeningInput::to`
[[nodiscard]] VOUSSOIR_DESIGN_INLINE Drive drive_of(const AnalysisInput& input,
                                                    std::size_t opening);
/// Advances of the tunnel's face until all of its rounds, and those of other openings, are done.
/// @pre  it is driven in rounds
[[nodiscard]] VOUSSOIR_DESIGN_INLINE int advance_count(const AnalysisInput& input);
/// What lies within an outline, all along an opening as far as it is driven, or one stretch of it.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE PrismaticOpening
opening_in_space(const AnalysisInput& input, std::size_t opening, const SimplePolygon& outline);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE PrismaticOpening stretch_in_space(const AnalysisInput& input,
                                                                       std::size_t opening,
                                                                       const SimplePolygon& outline,
                                                                       int stretch);

/// Strips of a lining on one stretch of an opening, 3-D.
struct StripsOfStretch {
  int count;
  double width;  ///< of each along the opening [m]
};
/// @pre  there is a lining
[[nodiscard]] VOUSSOIR_DESIGN_INLINE StripsOfStretch strips_of(const AnalysisInput& input,
                                                               std::size_t opening);
/// Of all linings, which have strips of one width [m]. @pre  there is a lining
[[nodiscard]] VOUSSOIR_DESIGN_INLINE double strip_width(const AnalysisInput& input);

/// What is wrong with where openings lie: beside the domain, or two in one place.
struct OpeningFault {
  std::size_t opening;
  std::string text;
};
/// @pre  every opening is without fault by itself
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::optional<OpeningFault> fault_of_openings(
    const AnalysisInput& input);

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

VOUSSOIR_DESIGN_INLINE TunnelAxis axis_of(const AnalysisInput& input, std::size_t opening) {
  const TunnelAxis tunnel(zeros<Vec3>(), 0, input.tunnel.plunge);
  if (opening == 0) return tunnel;
  const OpeningInput& o = input.openings[opening - 1];
  return TunnelAxis(tunnel.point(o.at, o.place), o.turn,
                    o.plunge.value_or(o.turn == 0 ? input.tunnel.plunge : 0));
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE const OutlineInput& outline_input(const AnalysisInput& input,
                                                         std::size_t opening) {
  if (opening == 0) return input.tunnel;
  return input.openings[opening - 1];
}

VOUSSOIR_DESIGN_INLINE std::string opening_name(const AnalysisInput& input, std::size_t opening) {
  return opening == 0 ? "tunnel" : input.openings[opening - 1].name;
}

VOUSSOIR_DESIGN_INLINE bool is_modelled(const AnalysisInput& input, std::size_t opening) {
  return opening == 0 || input.is_spatial() ||
         input.openings[opening - 1].is_along_tunnel(input.tunnel);
}

VOUSSOIR_DESIGN_INLINE bool is_modelled(const AnalysisInput& input, const BoltsInput& bolts) {
  return is_modelled(input, bolts.opening) && (input.is_spatial() || !bolts.ahead);
}

VOUSSOIR_DESIGN_INLINE Domain<2> section_domain(const AnalysisInput& input) {
  Domain<2> domain = domain_around(opening_of(input), input.model.width, input.tunnel.cover,
                                   input.model.below_invert);
  domain.site_origin = input.model.origin;
  return domain;
}

VOUSSOIR_DESIGN_INLINE Domain<3> spatial_domain(const AnalysisInput& input) {
  const Domain<2> section = section_domain(input);
  // Under the invert is ground all along, however far it goes down.
  const double fall = input.model.length * elementary::tangent(std::max(input.tunnel.plunge, 0.0));
  return {{section.low.x(), 0, section.low.y() - fall},
          {section.high.x(), input.model.length, section.high.y()},
          {input.model.origin[0], 0, input.model.origin[1]}};
}

VOUSSOIR_DESIGN_INLINE Vec2 centre_in_section(const AnalysisInput& input, std::size_t opening) {
  return opening == 0 ? Vec2(Vec2::Zero()) : input.openings[opening - 1].at;
}

VOUSSOIR_DESIGN_INLINE SimplePolygon in_section(const AnalysisInput& input, std::size_t opening,
                                                const SimplePolygon& outline) {
  if (opening == 0) return outline;
  const Vec2 centre = centre_in_section(input, opening);
  std::vector<Vec2> corners = outline.vertices();
  for (Vec2& corner : corners) corner += centre;
  return SimplePolygon(std::move(corners));
}

VOUSSOIR_DESIGN_INLINE SimplePolygon opening_in_section(const AnalysisInput& input,
                                                        std::size_t opening) {
  return in_section(input, opening, outline_of(outline_input(input, opening)));
}

VOUSSOIR_DESIGN_INLINE std::optional<SimplePolygon> outline_of_round(const AnalysisInput& input,
                                                                     const StageInput& round) {
  const SimplePolygon section = outline_of(outline_input(input, round.opening));
  if (!round.outline.empty()) return common_part(section, round.outline);
  return outline_of_part(section, *round.part);
}

VOUSSOIR_DESIGN_INLINE Drive drive_of(const AnalysisInput& input, std::size_t opening) {
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

VOUSSOIR_DESIGN_INLINE int advance_count(const AnalysisInput& input) {
  int advances = input.round_count();
  for (const StageInput& entry : input.stages)
    advances = std::max(advances, drive_of(input, entry.opening).count + entry.behind);
  return advances;
}

VOUSSOIR_DESIGN_INLINE PrismaticOpening opening_in_space(const AnalysisInput& input,
                                                         std::size_t opening,
                                                         const SimplePolygon& outline) {
  constexpr double endless = PrismaticOpening::endless;
  const Drive drive = drive_of(input, opening);
  return {outline, detail::axis_of(input, opening), drive.has_open_start ? -endless : drive.from,
          drive.has_open_end ? endless : drive.to};
}

VOUSSOIR_DESIGN_INLINE PrismaticOpening stretch_in_space(const AnalysisInput& input,
                                                         std::size_t opening,
                                                         const SimplePolygon& outline,
                                                         int stretch) {
  constexpr double endless = PrismaticOpening::endless;
  const Drive drive = drive_of(input, opening);
  const bool is_first = stretch == 0, is_last = stretch == drive.count - 1;
  return {outline, detail::axis_of(input, opening),
          is_first && drive.has_open_start ? -endless : drive.begin_of(stretch),
          is_last && drive.has_open_end ? endless : drive.end_of(stretch)};
}

VOUSSOIR_DESIGN_INLINE StripsOfStretch strips_of(const AnalysisInput& input, std::size_t opening) {
  const double stretch = drive_of(input, opening).stretch;
  const double asked = input.linings.front().rib_spacing.value_or(std::min(1.0, stretch));
  const int count = std::max(1, static_cast<int>(std::floor(stretch / asked + 1e-9)));
  return {count, stretch / count};
}

VOUSSOIR_DESIGN_INLINE double strip_width(const AnalysisInput& input) {
  return strips_of(input, input.linings.front().opening).width;
}

namespace detail {

/// @param before  openings that are there, with their numbers
template <class Geometry>
VOUSSOIR_DESIGN_INLINE std::string fault_beside(
    const AnalysisInput& input, const typename Geometry::Opening& opening,
    const RockMass<Geometry>& ground,
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
VOUSSOIR_DESIGN_INLINE std::optional<OpeningFault> fault_among(const AnalysisInput& input,
                                                               const Domain& domain,
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

}  // namespace detail

VOUSSOIR_DESIGN_INLINE std::optional<OpeningFault> fault_of_openings(const AnalysisInput& input) {
  if (input.is_spatial())
    return detail::fault_among<Spatial>(input, spatial_domain(input), [&](std::size_t k) {
      return opening_in_space(input, k, outline_of(outline_input(input, k)));
    });
  return detail::fault_among<Planar>(input, section_domain(input),
                                     [&](std::size_t k) { return opening_in_section(input, k); });
}

#endif

}  // namespace voussoir::design
