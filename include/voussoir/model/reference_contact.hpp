// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/tangent_basis.hpp>
#include <voussoir/model/contact_outline.hpp>
#include <voussoir/model/small_displacement.hpp>

namespace voussoir {

/// A point of a contact in the reference configuration, but for what the contact law remembers.
template <int Dim>
struct ReferencePoint {
  Vec<Dim> offset;          ///< from the centre of the area, along normal and tangents [m]
  double weight;            ///< [m] or [m^2]
  PointForce<Dim> initial;  ///< in the in-situ state
  /// Opening and slips at displacement zero: not zero once contacts have been updated, or where
  /// the contact has been made on ground that had already moved [m].
  Vec<Dim> start = zeros<Vec<Dim>>();
};

namespace detail {

/// In 2-D there is one tangent, the normal turned by 90 degrees: it need not be kept.
template <int Dim>
struct KeptTangents {};
template <>
struct KeptTangents<3> {
  Vec3 first, second;  ///< not a matrix, which would be padded
};

[[nodiscard]] inline TangentBasis<3> basis_of(const KeptTangents<3>& kept) {
  TangentBasis<3> basis;
  set_column(basis, 0, kept.first);
  set_column(basis, 1, kept.second);
  return basis;
}

}  // namespace detail

/// What body a shares with body b on one plane, in the reference configuration: where the bodies
/// were when contacts were last updated.
///
/// Forces read all of it, so it is as small as it can be: 64 bytes in 2-D, 160 in 3-D.
template <int Dim>
struct ReferenceContact {
  static constexpr int dof = Dim + spin_count<Dim>;

  Vec<Dim> normal;  ///< from a to b
  [[no_unique_address]] detail::KeptTangents<Dim> kept_tangents;
  Vec<Dim> arm_a, arm_b;  ///< from the centres of the bodies to the centre of the area [m]
  std::int32_t a, b;
  std::int32_t first;       ///< of its points
  std::uint16_t count = 0;  ///< of its points
  std::uint16_t law = 0;    ///< index into the laws of the group
  [[no_unique_address]] detail::KeptOutline<Dim> outline;

  /// One behind its last point.
  [[nodiscard]] int last() const { return first + count; }
  /// With the normal a frame: right-handed, but in 3-D left-handed where a contact update has found
  /// the bodies the other way round and turned all its axes about.
  [[nodiscard]] TangentBasis<Dim> tangents() const {
    if constexpr (Dim == 2)
      return perpendicular(normal);
    else
      return detail::basis_of(kept_tangents);
  }
  void set_frame(const Vec<Dim>& to_b, [[maybe_unused]] const TangentBasis<Dim>& along) {
    normal = to_b;
    if constexpr (Dim == 3) kept_tangents = {column(along, 0), column(along, 1)};
  }
  /// @throws InvalidInput  more points or laws than the record has room for: 65 535
  void set_points(int first_point, std::size_t how_many) {
    require(how_many <= most, "points of a contact", static_cast<double>(how_many), "<= 65535");
    first = first_point;
    count = static_cast<std::uint16_t>(how_many);
  }
  void set_law(int number) {
    require(number >= 0 && number <= most, "number of a contact law", number, "0 to 65535");
    law = static_cast<std::uint16_t>(number);
  }

  /// From the centre of the area to a point, world axes [m].
  [[nodiscard]] Vec<Dim> offset_of(const ReferencePoint<Dim>& p) const {
    return p.offset[0] * normal + tangents() * part<Dim - 1>(p.offset, 1);
  }
  /// Displacement `u` of body b against body a at an offset from the centre, world axes [m].
  [[nodiscard]] Vec<Dim> jump(const Vec<Dim>& offset, const double* u) const {
    return displacement_at<Dim>(u + dof * b, arm_b + offset) -
           displacement_at<Dim>(u + dof * a, arm_a + offset);
  }
  /// Opening and slips of a point at displacement `u`.
  [[nodiscard]] PointMotion<Dim> motion(const ReferencePoint<Dim>& p, const Vec<Dim>& offset,
                                        const double* u) const {
    const Vec<Dim> jump = this->jump(offset, u);
    return {p.start[0] + normal.dot(jump),
            part<Dim - 1>(p.start, 1) + transposed_product(tangents(), jump)};
  }
  /// Opening and slips of a point that displacement `u` makes, besides those at the start [m].
  [[nodiscard]] Vec<Dim> linear_motion(const ReferencePoint<Dim>& p, const double* u) const {
    const Vec<Dim> jump = this->jump(offset_of(p), u);
    return stacked(normal.dot(jump), transposed_product(tangents(), jump));
  }

 private:
  static constexpr int most = std::numeric_limits<std::uint16_t>::max();
};
static_assert(sizeof(ReferenceContact<2>) == 64 && sizeof(ReferenceContact<3>) == 160);

/// The order in which contacts that have been found go into their group: by the lower of their two
/// bodies, then by the other one; several of the same two as they were found.
///
/// Neighbours in the rock have numbers near each other, so forces go through the memory of bodies
/// from front to back: in 2-D 40 instead of 140 ns a contact for a million blocks and 46 instead of
/// 62 for 105 000, when each had 256 bytes.
/// @param bodies_of  bodies_of(contact) are the two bodies, either first
/// @return  indices into `contacts`
template <class Contacts, class BodiesOf>
[[nodiscard]] std::vector<int> order_by_bodies(const Contacts& contacts, BodiesOf&& bodies_of) {
  std::vector<std::pair<int, int>> bodies;
  bodies.reserve(contacts.size());
  int limit = 0;
  for (const auto& contact : contacts) {
    const std::pair<int, int> two = bodies_of(contact);
    bodies.emplace_back(std::minmax(two.first, two.second));
    limit = std::max(limit, bodies.back().second + 1);
  }
  return order_of_pairs(bodies, limit);
}

}  // namespace voussoir
