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
  double before, after;       ///< of the anchors from there, towards head and tip [m]
  Vec<Dim> joint_a, joint_b;  ///< where the bar leaves a and enters b: apart across a hole [m]
  Vec<Dim> initial;           ///< from the first anchor to the second [m]
};

/// The joints that a bar crosses on its way through these bodies.
///
/// Across a hole (a block that is detached) the bar goes on; at a joint the two faces are one
/// place, and the span exactly what the anchors say, not the rounding of two positions.
/// @param intersections   in the order of their distance from the head
/// @param tolerance  of the domain [m]
template <class Line, class Anchors>
[[nodiscard]] auto bolt_crossings(const std::vector<BlockIntersection>& intersections,
                                  const Line& bar, const Anchors& anchors, double tolerance) {
  constexpr int dim = decltype(bar.start)::RowsAtCompileTime;
  const Vec<dim> axis = (bar.end - bar.start) / bar.length();
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
    found.push_back({before.body, after.body, position, d.before, d.after, face_a, face_b,
                     (d.before + (is_joint ? 0.0 : gap) + d.after) * axis});
  }
  return found;
}

}  // namespace voussoir
