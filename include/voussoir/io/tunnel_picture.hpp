// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/io/blocks_picture.hpp>
#include <voussoir/io/tunnel_view.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
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

[[nodiscard]] inline PictureLining picture_lining(const TunnelState<Planar>& state) {
  PictureLining drawn;
  std::vector<LiningForce> at = state.lining;
  drawn.is_ring = state.members.size() == at.size();
  std::erase_if(at, [](const LiningForce& node) { return node.is_lost; });
  const std::size_t n = at.size();
  for (std::size_t k = 0; k < n; ++k) {
    // Across the line through the neighbours: right for corners as for circles.
    const Vec2& before = at[drawn.is_ring ? (k + n - 1) % n : (k > 0 ? k - 1 : 0)].position;
    const Vec2& after = at[drawn.is_ring ? (k + 1) % n : std::min(k + 1, n - 1)].position;
    drawn.nodes.push_back(
        {at[k].position, -perpendicular(after - before).normalized(), at[k].thrust, at[k].moment});
  }
  return drawn;
}

}  // namespace detail

/// @param bars  of the bolts, in the order in which they were installed
/// @param lining_thickness  [m]; 0: drawn as a line
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
      picture.blocks.push_back({std::move(corners), block.displacement.norm(), block.is_gone});
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
  if (PictureLining lining = detail::picture_lining(state); !lining.nodes.empty()) {
    lining.thickness = lining_thickness;
    for (const FootForce<2>& foot : state.feet)
      lining.feet.push_back({foot.place, foot.direction, foot.width, foot.bearing});
    for (const ConvexPolygon& fill : state.fills) lining.fills.push_back(fill.vertices());
    picture.lining = std::move(lining);
  }
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
    view.bolts.push_back({bars[k].start, bars[k].end, pull[k]});
  for (const MemberForces<3>& m : state.members) view.lining.push_back({m.from, m.to, m.thrust});
  view.fills = state.fills;
  return view;
}

}  // namespace voussoir
