// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/tangent_basis.hpp>
#include <voussoir/model/any_law.hpp>
#include <voussoir/model/moving_contacts.hpp>
#include <voussoir/model/reference_contact.hpp>

namespace voussoir::detail {

// A contact is known in two ways: at rest by the axes of the reference configuration, in which
// displacements are small; in a run by the frames of its two bodies, which may move by any amount.
// Here it goes from one to the other and back, slip, opening and forces kept.

/// @param a  where body a is in the reference configuration
template <int Dim>
[[nodiscard]] MovingContact<Dim> to_frames(const ReferenceContact<Dim>& c, const Pose<Dim>& a) {
  MovingContact<Dim> contact;
  contact.frame = transposed_product(a.rotation, contact_frame<Dim>(c.normal, c.tangents()));
  contact.a = c.a;
  contact.b = c.b;
  contact.first = c.first;
  contact.last = c.last();
  contact.law = c.law;
  contact.outline = c.outline;
  return contact;
}

/// A point of it.
/// @param at     where the contact is in the reference configuration
/// @param b      where body b is
/// @param u      displacement there; null: zero
/// @param state  what the law remembers of the point
template <int Dim>
[[nodiscard]] MovingContactPoint<Dim, FormerPoint> to_frames(
    const ReferenceContact<Dim>& c, const ReferencePoint<Dim>& p,
    const typename MovingContact<Dim>::Place& at, const Pose<Dim>& b, const double* u,
    FormerPoint state) {
  MovingContactPoint<Dim, FormerPoint> point{};
  point.place = transposed_product(b.rotation, Vec<Dim>(c.arm_b + c.offset_of(p)));
  point.weight = p.weight;
  point.initial = p.initial;
  point.state = state;
  point.zero = zeros<Vec<Dim>>();
  const PointMotion<Dim> raw = point.motion(at);
  Vec<Dim> motion = p.start;
  if (u != nullptr) motion += c.linear_motion(p, u);
  point.zero = stacked(raw.opening - motion[0], raw.slip - part<Dim - 1>(motion, 1));
  point.committed.commit(part<Dim - 1>(motion, 1));
  return point;
}

/// A contact with its points as the reference configuration has it in which its bodies are now.
/// @param a, b    its bodies
/// @param u       displacement of all bodies, from wherever it is counted
/// @param points  of the contact, at least one
/// @param shear_at  where their shear acts, if that is not there: in the frame of body b
/// @param take    take(point): every point, in the order of those given
template <int Dim, class Points, class Take>
[[nodiscard]] ReferenceContact<Dim> from_frames(const MovingContact<Dim>& c, const Pose<Dim>& a,
                                                const Pose<Dim>& b, const double* u,
                                                const Points& points,
                                                const std::vector<Vec<Dim>>& shear_at,
                                                Take&& take) {
  const Rotation<Dim> frame = a.rotation * c.frame;
  ReferenceContact<Dim> contact{};
  contact.set_frame(column(frame, 0), TangentBasis<Dim>(frame.template rightCols<Dim - 1>()));
  contact.a = c.a;
  contact.b = c.b;
  contact.set_law(c.law);
  contact.outline = c.outline;
  Vec<Dim> middle = zeros<Vec<Dim>>();
  double whole = 0;
  for (const auto& p : points) {
    middle += p.weight * b(p.place);
    whole += p.weight;
  }
  middle /= whole;
  contact.arm_a = middle - a.position;
  contact.arm_b = middle - b.position;
  const auto at = c.place(a, b);
  auto shear_place = shear_at.begin();
  for (const auto& p : points) {
    ReferencePoint<Dim> point{};
    point.offset = transposed_product(frame, Vec<Dim>(b(p.place) - middle));
    // Heights are levers of shear alone.
    if (!shear_at.empty())
      point.offset[0] = column(frame, 0).dot(Vec<Dim>(b(*shear_place++) - middle));
    point.weight = p.weight;
    point.initial = p.initial;
    const PointMotion<Dim> motion = p.motion(at);
    point.start = stacked(motion.opening, motion.slip);
    point.start -= contact.linear_motion(point, u);
    take(point);
  }
  return contact;
}

}  // namespace voussoir::detail
