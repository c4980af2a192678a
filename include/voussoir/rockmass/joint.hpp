// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>
#include <voussoir/geometry/joint_plane.hpp>
#include <voussoir/geometry/segment.hpp>

namespace voussoir {

/// A discontinuity: where it runs and how far it reaches.
template <int Dim>
struct JointOf {
  std::conditional_t<Dim == 2, Segment, JointPlane> trace;  ///< [m]
  int set;                                                  ///< index of its joint set; -1: none
};

/// A joint in the plane of a section: its trace.
using Joint = JointOf<2>;
/// A joint in space: a piece of plane.
using SpatialJoint = JointOf<3>;

}  // namespace voussoir
