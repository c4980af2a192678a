// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>
#include <voussoir/bolt/bolt_anchors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/block_intersections.hpp>

namespace voussoir {

/// Where a bar crosses a joint, and its anchors on either side.
template <int Dim>
struct BoltCrossingPoint {
  int a, b;                   ///< body towards the head, body towards the tip
  double position;            ///< of the joint, from the head [m]
  double beyond;              ///< of the bolt beyond the joint, to its tip [m]
  double before, after;       ///< of the anchors from there, towards head and tip [m]
  Vec<Dim> joint_a, joint_b;  ///< where the bar leaves a and enters b: apart across a hole [m]
  Vec<Dim> initial;           ///< from the first anchor to the second [m]
};

/// A bar that ties the block at its head and the block at its tip, and no joint between them: its
/// anchors and places at the joint are its ends. Nothing where both are in one block.
template <class Line>
[[nodiscard]] auto ends_of_bar(const std::vector<BlockIntersection>& intersections,
                               const Line& bar) {
  constexpr int dim = decltype(bar.start)::RowsAtCompileTime;
  std::vector<BoltCrossingPoint<dim>> found;
  if (intersections.empty() || intersections.front().body == intersections.back().body)
    return found;
  const Vec<dim> axis = (bar.end - bar.start) / bar.length();
  const BlockIntersection &head = intersections.front(), &tip = intersections.back();
  // Of a bar that begins over a hole the plate is set on the rock behind it.
  const Vec<dim> from = bar.start + head.from * axis, to = bar.start + tip.to * axis;
  found.push_back(
      {head.body, tip.body, head.to, bar.length() - head.to, 0, 0, from, to, to - from});
  return found;
}

/// The joints that a bar crosses on its way through these bodies.
///
/// Across a hole (a block that is detached) the bar goes on; at a joint the two faces are one
/// place, and the span exactly what the anchors say, not the rounding of two positions. A bolt held
/// by its ends alone ties these in place of joints (`ends_of_bar`).
/// @param intersections   in the order of their distance from the head
/// @param tolerance  of the domain [m]
template <class Line, class Anchors>
[[nodiscard]] auto bolt_crossings(const std::vector<BlockIntersection>& intersections,
                                  const Line& bar, const Anchors& anchors, double tolerance) {
  constexpr int dim = decltype(bar.start)::RowsAtCompileTime;
  const Vec<dim> axis = (bar.end - bar.start) / bar.length();
  if (ties_ends(anchors)) return ends_of_bar(intersections, bar);
  std::vector<BoltCrossingPoint<dim>> found;
  for (std::size_t k = 1; k < intersections.size(); ++k) {
    const BlockIntersection &before = intersections[k - 1], &after = intersections[k];
    if (before.body == after.body) continue;  // round a corner of the opening and back
    const AnchorDistances d = anchors.distances({before.to - before.from, after.to - after.from});
    const double gap = after.from - before.to, position = 0.5 * (before.to + after.from);
    const bool is_joint = gap < same_point * tolerance;
    const Vec<dim> joint = bar.start + position * axis;
    const Vec<dim> face_a = is_joint ? joint : Vec<dim>(bar.start + before.to * axis);
    const Vec<dim> face_b = is_joint ? joint : Vec<dim>(bar.start + after.from * axis);
    found.push_back({before.body, after.body, position, bar.length() - position, d.before, d.after,
                     face_a, face_b, (d.before + (is_joint ? 0.0 : gap) + d.after) * axis});
  }
  return found;
}

}  // namespace voussoir
