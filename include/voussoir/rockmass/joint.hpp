// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/joint_plane.hpp>
#include <voussoir/geometry/segment.hpp>

namespace voussoir {

/// A discontinuity: where it runs and how far it reaches.
template <int Dim>
struct JointOf {
  std::conditional_t<Dim == 2, Segment, JointPlane> trace;  ///< [m]
  int set;                                                  ///< index of its joint set; -1: none
};

namespace detail {

/// And its length too, which overflows where coordinates are beyond 1e150 m.
[[nodiscard]] inline bool is_finite(const Segment& trace) {
  return voussoir::is_finite(trace.start) && voussoir::is_finite(trace.end) &&
         std::isfinite(squared_length_of(Vec2(trace.end - trace.start)));
}
[[nodiscard]] inline bool is_finite(const JointPlane& trace) {
  return voussoir::is_finite(trace.plane.normal) && std::isfinite(trace.plane.offset) &&
         std::all_of(trace.corners.begin(), trace.corners.end(),
                     [](const Vec3& corner) { return voussoir::is_finite(corner); });
}

}  // namespace detail

/// A joint in the plane of a section: its trace.
using Joint = JointOf<2>;
/// A joint in 3-D: a piece of plane.
using SpatialJoint = JointOf<3>;

}  // namespace voussoir
