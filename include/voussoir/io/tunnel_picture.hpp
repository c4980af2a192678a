// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/io/blocks_picture.hpp>
#include <voussoir/io/tunnel_view.hpp>
#include <voussoir/io/view_from.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/tunnel/joined_openings.hpp>
#include <voussoir/tunnel/placed_load.hpp>
#include <voussoir/tunnel/tunnel_state.hpp>

namespace voussoir {

// From a tunnel, at rest or in motion, to what `draw_blocks_picture` (2-D) and `draw_tunnel_view`
// (3-D) draw. Title, key numbers and banner are for the caller to add.

/// A joint counts as slipped from here on: one hundredth of a millimetre [m].
inline constexpr double visible_slip = 1e-5;

namespace detail {

[[nodiscard]] inline PictureCrossing::State picture_state(const BoltReport& report) {
  if (report.is_broken) return PictureCrossing::State::ruptured;
  return report.has_yielded() ? PictureCrossing::State::yielded : PictureCrossing::State::elastic;
}

/// Of the last opening and those that it is joined to; nothing before one was carved.
[[nodiscard]] inline std::optional<ViewRect> rect_of_tunnel(const RockMass<Planar>& mass) {
  std::vector<Vec2> corners;
  for (const SimplePolygon& opening : joined_openings(mass))
    corners.insert(corners.end(), opening.vertices().begin(), opening.vertices().end());
  return bounding_rect(corners);
}

/// Members that follow one another, as the nodes between them.
struct LiningChain {
  std::vector<std::size_t> nodes;
  bool is_ring = false;  ///< the last member leads back to the first node
};
/// All members, each in one chain; a chain ends where none goes on, or one of another thickness.
/// @param thickness  thickness(node)
template <class Thickness>
[[nodiscard]] std::vector<LiningChain> chains_of(const std::vector<LiningLink>& links,
                                                 Thickness&& thickness) {
  std::vector<char> is_used(links.size(), 0);
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  // An unused member to or from a node that goes on with the one given.
  const auto other = [&](const LiningLink& link, bool is_before) {
    for (std::size_t k = 0; k < links.size(); ++k)
      if (is_used[k] == 0 && &links[k] != &link &&
          (is_before ? links[k].to == link.from : links[k].from == link.to) &&
          thickness(links[k]) == thickness(link))
        return k;
    return none;
  };
  std::vector<LiningChain> chains;
  const auto follow = [&](std::size_t k) {
    LiningChain& chain = chains.emplace_back();
    chain.nodes.push_back(static_cast<std::size_t>(links[k].from));
    for (; k != none; k = other(links[k], false)) {
      is_used[k] = 1;
      chain.nodes.push_back(static_cast<std::size_t>(links[k].to));
    }
    chain.is_ring = chain.nodes.front() == chain.nodes.back();
    if (chain.is_ring) chain.nodes.pop_back();
  };
  for (std::size_t k = 0; k < links.size(); ++k)
    if (is_used[k] == 0 && other(links[k], true) == none) follow(k);
  for (std::size_t k = 0; k < links.size(); ++k)  // what is left are rings
    if (is_used[k] == 0) follow(k);
  return chains;
}

// What the parts of a picture say to who points at them.

/// In mm, kN or kN m; what is left of rounding, as in the moment of a hinge, is nothing.
[[nodiscard]] inline std::string told(double value) {
  if (!std::isfinite(value)) return "–";
  return std::abs(value) < 0.005 ? "0" : printed_text(value);
}

/// @param measure  of the block [m^2], [m^3]
template <int Dim>
[[nodiscard]] std::string words_of(std::size_t block, const BlockState<Dim>& state,
                                   double measure) {
  return "block " + std::to_string(block) + "\n" +
         (state.is_gone ? "came off" : "moved " + told(1e3 * state.displacement.norm()) + " mm") +
         "\n" + readable_text(measure) + (Dim == 2 ? " m²" : " m³");
}
[[nodiscard]] inline std::string words_of(const LiningForce& at) {
  return "lining " + std::to_string(at.lining + 1) + "\nthrust " + told(1e-3 * at.thrust) +
         " kN/m\nmoment " + told(1e-3 * at.moment) + " kN m/m";
}
/// @param bolt  its number, from 0
[[nodiscard]] inline std::string words_of(std::size_t bolt, const PictureBolt& drawn) {
  std::string words = "bolt " + std::to_string(bolt + 1);
  const PictureCrossing* most = nullptr;
  for (const PictureCrossing& crossing : drawn.crossings)
    if (most == nullptr || crossing.force > most->force) most = &crossing;
  if (most == nullptr) return words + "\ncrosses no joint";
  words.append("\n").append(told(1e-3 * most->force)).append(" kN, ");
  words.append(readable_text((most->point - drawn.head).norm(), 2)).append(" m from its head");
  if (most->state == PictureCrossing::State::yielded) words += ", yielded";
  if (most->state == PictureCrossing::State::ruptured) words += ", ruptured";
  return words;
}

/// @param lining_thickness  of all of them [m]; 0: what the state knows
[[nodiscard]] inline std::vector<PictureLining> picture_linings(const TunnelState<Planar>& state,
                                                                double lining_thickness) {
  const auto thickness = [&](const LiningLink& link) {
    if (lining_thickness > 0) return lining_thickness;
    // What joins one lining to another is of the later one.
    const auto k =
        static_cast<std::size_t>(std::max(state.lining[static_cast<std::size_t>(link.from)].lining,
                                          state.lining[static_cast<std::size_t>(link.to)].lining));
    return k < state.thicknesses.size() ? state.thicknesses[k] : 0.0;
  };
  std::vector<PictureLining> linings;
  for (const LiningChain& chain : chains_of(state.links, thickness)) {
    PictureLining& drawn = linings.emplace_back();
    drawn.is_ring = chain.is_ring;
    const std::size_t n = chain.nodes.size();
    const auto at = [&](std::size_t k) -> const LiningForce& {
      return state.lining[chain.nodes[k]];
    };
    const auto before = static_cast<int>(chain.nodes[0]), after = static_cast<int>(chain.nodes[1]);
    for (const LiningLink& link : state.links)
      if (link.from == before && link.to == after) drawn.thickness = thickness(link);
    for (std::size_t k = 0; k < n; ++k) {
      // Across the line through the neighbours: right for corners as for circles.
      const Vec2& back = at(drawn.is_ring ? (k + n - 1) % n : (k > 0 ? k - 1 : 0)).position;
      const Vec2& front = at(drawn.is_ring ? (k + 1) % n : std::min(k + 1, n - 1)).position;
      drawn.nodes.push_back({at(k).position, -perpendicular(front - back).normalized(),
                             at(k).thrust, at(k).moment, chain.nodes[k], words_of(at(k))});
    }
  }
  // A foot is drawn with the end that it is under.
  for (const FootForce<2>& foot : state.feet) {
    PictureLining* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (PictureLining& lining : linings)
      for (const PictureLiningNode* node : {&lining.nodes.front(), &lining.nodes.back()})
        if (const double away = length_of(Vec2(node->point - foot.place)); away < least) {
          least = away;
          nearest = &lining;
        }
    if (nearest != nullptr)
      nearest->feet.push_back({foot.place, foot.direction, foot.width, foot.bearing});
  }
  return linings;
}

}  // namespace detail

/// Loads as they lie on blocks that have moved; without those on blocks that have come off.
/// @throws InvalidInput  see `loaded_block`
[[nodiscard]] inline std::vector<PictureLoad> picture_loads(
    const TunnelState<Planar>& state, const RockMass<Planar>& mass,
    const std::vector<PlacedLoad<2>>& loads) {
  std::vector<PictureLoad> drawn;
  for (const PlacedLoad<2>& load : loads) {
    const auto& block = state.blocks[static_cast<std::size_t>(loaded_block(mass, load))];
    if (block.is_gone) continue;
    PictureLoad& made = drawn.emplace_back();
    made = {block.motion(load.at), load.load.force, load.load.moment[0]};
    made.says = detail::words_of(made);
  }
  return drawn;
}

/// @param bars  of the bolts, in the order in which they were installed
/// @param lining_thickness  [m]; 0: that of their sections, or where the state does not know it a
///                          line
[[nodiscard]] inline BlocksPicture picture_of(const TunnelState<Planar>& state,
                                              const RockMass<Planar>& mass,
                                              const std::vector<Segment>& bars = {},
                                              double lining_thickness = 0) {
  VOUSSOIR_ASSERT(state.blocks.size() == mass.bodies.size(),
                  "a state is of the rock that is drawn");
  BlocksPicture picture;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const BlockState<2>& block = state.blocks[b];
    for (const ConvexPolygon& part : mass.bodies[b].parts) {
      std::vector<Vec2> corners;
      for (const Vec2& v : part.vertices()) corners.push_back(block.motion(v));
      picture.blocks.push_back({std::move(corners), block.displacement.norm(), block.is_gone,
                                detail::words_of(b, block, mass.bodies[b].properties.measure)});
    }
  }
  for (const JointState<2>& joint : state.joints) {
    const bool slipped = joint.report.plastic_slip > visible_slip;
    if (!joint.report.is_open && !slipped) continue;
    const Vec2 half = 0.5 * joint.measure * perpendicular(joint.normal);
    picture.joints.push_back(
        {joint.centre - half, joint.centre + half,
         joint.report.is_open ? PictureJoint::State::opened : PictureJoint::State::slipped});
  }
  if (!mass.openings.empty()) picture.outline = mass.openings.back().vertices();
  for (std::size_t k = 0; k + 1 < mass.openings.size(); ++k)
    picture.other_openings.push_back(mass.openings[k].vertices());
  if (const auto tunnel = detail::rect_of_tunnel(mass)) picture.centre = tunnel->centre();
  picture.ground_surface = mass.domain.surface();
  for (const Segment& bar : bars) picture.bolts.push_back({bar.start, bar.end, {}});
  for (const CrossingForce& at : state.bolts) {
    PictureBolt& bolt = picture.bolts.at(static_cast<std::size_t>(at.bolt));
    const Segment bar{bolt.head, bolt.tip};
    VOUSSOIR_ASSERT(at.position >= 0 && at.position <= bar.length() * (1 + 1e-9),
                    "a bolt crosses joints along its bar");
    bolt.crossings.push_back(
        {bar.at(at.position / bar.length()), at.report.axial, detail::picture_state(at.report)});
  }
  for (std::size_t k = 0; k < picture.bolts.size(); ++k)
    picture.bolts[k].says = detail::words_of(k, picture.bolts[k]);
  picture.linings = detail::picture_linings(state, lining_thickness);
  for (const ConvexPolygon& fill : state.fills) picture.fills.push_back(fill.vertices());
  return picture;
}

/// The same in 3-D: the rock stays where it was sliced, its colours show displacement; a bolt and a
/// member of the lining show their largest force.
[[nodiscard]] inline TunnelView picture_of(const TunnelState<Spatial>& state,
                                           const std::vector<SpatialLine>& bars = {}) {
  TunnelView view;
  for (const BlockState<3>& block : state.blocks) {
    view.displacement.push_back(block.displacement.norm());
    view.is_gone.push_back(block.is_gone);
  }
  const auto pull = largest_bolt_forces(state.bolts, static_cast<int>(bars.size()));
  for (std::size_t k = 0; k < bars.size(); ++k)
    view.bolts.push_back(
        {bars[k].start, bars[k].end, pull[k],
         "bolt " + std::to_string(k + 1) + "\n" + detail::told(1e-3 * pull[k]) + " kN"});
  for (const MemberForces<3>& m : state.members)
    view.lining.push_back(
        {m.from, m.to, m.thrust, "lining\nthrust " + detail::told(1e-3 * m.thrust) + " kN"});
  view.fills = state.fills;
  return view;
}

/// Gives a view of excavated rock its section and its viewer, by the axis of the last opening,
/// whatever its trend.
///
/// From the axis the section is upright through the middle of the tunnel. The face is that of the
/// opening which reaches furthest along the axis; the section lies half a round before it, and
/// where the tunnel goes through all the rock in the middle of its length. From above the section
/// goes through the origin of the tunnel's outline, of a horseshoe or a circle the springing; of a
/// shaft it is level, through the middle of the rock.
/// @param measured  in place of the last opening: the tunnel among several
/// @return  what is seen, for the head of the picture; empty: the view from the axis, or no opening
VOUSSOIR_INLINE std::string look_from(ViewFrom from, const RockMass<Spatial>& mass,
                                      TunnelView& view,
                                      const std::optional<PrismaticOpening>& measured = {});

#if VOUSSOIR_BODIES

namespace detail {

/// Where the rock begins and ends along an axis [m].
[[nodiscard]] inline std::pair<double, double> extent_along(const Domain<3>& domain,
                                                            const TunnelAxis& axis) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1) != 0 ? domain.high.x() : domain.low.x(),
                 (corner & 2) != 0 ? domain.high.y() : domain.low.y(),
                 (corner & 4) != 0 ? domain.high.z() : domain.low.z());
    low = std::min(low, axis.local(p).z());
    high = std::max(high, axis.local(p).z());
  }
  return {low, high};
}

/// @param is_shown  is_shown(opening): it is a part of the tunnel, among those along its axis
template <class IsShown>
std::string look_at_face(const RockMass<Spatial>& mass, const TunnelAxis& axis, TunnelView& view,
                         IsShown&& is_shown) {
  const auto [begin, end] = extent_along(mass.domain, axis);
  const double tolerance = 1e3 * mass.domain.tolerance();
  double face = -std::numeric_limits<double>::infinity(), portal = end, round = 0;
  for (const PrismaticOpening& opening : mass.openings) {
    if (!opening.axis().is_parallel_to(axis) ||
        dot_product(opening.axis().along(), axis.along()) < 0 || !is_shown(opening))
      continue;
    const double shift = axis.local(opening.axis().origin()).z();
    const double to = std::min(opening.to() + shift, end),
                 start = std::max(opening.from() + shift, begin);
    portal = std::min(portal, start);
    if (to > face + tolerance) round = to - start;
    face = std::max(face, to);
  }
  const bool has_face = face < end - tolerance;
  const double cut = has_face ? face - 0.5 * round : 0.5 * (portal + end);
  const Vec3 back = -axis.along();
  view.section = HalfSpace<3>::through(axis.point(zeros<Vec2>(), cut), back);
  view.azimuth = std::atan2(back.x(), back.y());
  view.elevation = std::asin(std::clamp(back.z(), -1.0, 1.0));
  const std::string place = trimmed_text(cut, 2) + " m along the axis";
  return has_face ? "Seen from the portal: cut across at " + place + ", the face is at " +
                        trimmed_text(face, 2) + " m."
                  : "Seen from the portal: cut across at " + place + ", there is no face.";
}

}  // namespace detail

VOUSSOIR_INLINE std::string look_from(ViewFrom from, const RockMass<Spatial>& mass,
                                      TunnelView& view,
                                      const std::optional<PrismaticOpening>& measured) {
  if (mass.openings.empty()) return "";
  const TunnelAxis& axis = measured ? measured->axis() : mass.openings.back().axis();
  const Vec3 middle =
      axis.point(measured ? centre_of(*measured) : centre_of(joined_openings(mass)), 0);
  // Rounds of the tunnel lie within its section.
  const auto is_shown = [&](const PrismaticOpening& opening) {
    if (!measured) return true;
    const ViewRect around = *bounding_rect(measured->section().vertices());
    return around.contains(measured->across(opening.in_space(centre_of(std::vector{opening}), 0)));
  };
  const Vec3& along = axis.along();
  const double trend = std::atan2(along.x(), along.y());
  view.shows_bolts_before = from != ViewFrom::axis;
  view.shows_lining_before = from == ViewFrom::face;  // on a plan its ribs lie on each other
  if (from == ViewFrom::face) return detail::look_at_face(mass, axis, view, is_shown);
  if (from == ViewFrom::axis) {
    view.section = HalfSpace<3>::through(middle, axis.right());
    view.azimuth = trend + 0.62 * std::numbers::pi;
    return "";
  }
  const bool is_shaft = axis.up().z() < 0.5;
  view.section =
      HalfSpace<3>::through(is_shaft ? Vec3(0.5 * (mass.domain.low + mass.domain.high)) : middle,
                            is_shaft ? Vec3(Vec3::UnitZ()) : axis.up());
  view.azimuth = trend + 0.5 * std::numbers::pi;
  view.elevation = 0.5 * std::numbers::pi;
  return is_shaft ? "Seen from above, cut open at half its depth."
                  : "Seen from above, cut open at the springing.";
}

#endif

}  // namespace voussoir
