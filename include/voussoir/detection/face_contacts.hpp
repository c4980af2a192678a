// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>
#include <voussoir/core/roles.hpp>
#include <voussoir/detection/detail/contact_facets.hpp>
#include <voussoir/detection/detail/face_pair_2d.hpp>
#include <voussoir/detection/detail/face_pair_3d.hpp>
#include <voussoir/detection/detail/lanes.hpp>

namespace voussoir {

/// Contacts by separating axes and clipped faces: exact in double precision on sharp blocks.
///
/// The separation of a pair is the largest over all axes, so that of an overlap is minus the least
/// penetration depth; its error is a few roundings of the coordinates (1e-13 m at 100 m). The
/// contact polygon is the part of one block's face that lies over (under) the other's: the face of
/// the deeper block, clipped to the upright prism over the reference face, and no higher above it
/// than `reach`. A pair of edges that cross touches over the section of the overlap midway between
/// them. Its measure is the area seen along the reference normal.
struct FaceContacts {
  using role = roles::ContactDetector;
  static constexpr const char* name = "FaceContacts";

  /// The queries of one pair of shapes; one object per thread, since it holds scratch memory.
  ///
  ///  - `overlap(a, b, memory)`     true if they interpenetrate
  ///  - `separation(a, b, memory, enough)`  exact [m]; < 0: minus the least penetration depth; > 0:
  ///                                the largest over the axes, at most the distance. Shapes that
  ///                                are further apart than `enough` (default: infinity) may get
  ///                                any value above it, which is ten times faster
  ///  - `contact(a, b, memory, reach)`  how they touch; Touch::none if further apart than `reach`
  ///  - `contact_near(a, b, memory, reach)`  the same, points counted from the grid point of a: at
  ///                                the coordinates of a site nothing is rounded then
  ///  - `facing_contact(a, b, memory, reach)`  how they touch, for a model (see PairDetector): that
  ///                                of `contact_near`, with all of the face, however high
  ///
  /// `Memory` keeps, per pair, what decided last time. It never changes an answer, only its cost.
  template <int Dim, class Lanes = detail::VectorLanes>
  using Pair = std::conditional_t<Dim == 2, detail::FacePair2<Lanes>, detail::FacePair3<Lanes>>;

  /// The contacts of a rock mass as it lies, found by search: what CutContacts knows from the cuts.
  ///
  /// Faces nearer than some tolerances of the domain touch. Blocks that share no more than an edge
  /// or a corner do not.
  template <class Mass>
  [[nodiscard]] static auto find(const Mass& mass) {
    return detail::contact_facets<FaceContacts>(mass);
  }
};

}  // namespace voussoir
