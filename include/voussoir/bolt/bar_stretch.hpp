// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// A bar between its anchors as it lies now.
template <int Dim>
struct BarStretch {
  Vec<Dim> direction;      ///< from the first anchor to the second, a unit vector
  double extension;        ///< of their distance since installation [m]
  double closing = 0;      ///< along the axis, of a strut between anchors that coincide, <= 0 [m]
  bool may_press = false;  ///< along its direction
};

namespace detail {

/// Anchors that coincide have no line between them: the bar starts out along its axis, as long as
/// the pretension has stretched it, and the joint's motion bends it from there. Closing the joint
/// slackens it; it does not pull the bar out on the other side. A strut is pressed along its axis
/// then, and pulled across it as before: with one length for both the force would jump where a
/// joint closes on a bolt that has yielded.
template <int Dim>
[[nodiscard]] BarStretch<Dim> stretch_from_joint(const BoltSpan<Dim>& span, double seat,
                                                 bool carries_compression) {
  Vec<Dim> bar = seat * span.axis + span.motion;
  const double along = std::min(0.0, span.axis.dot(bar));
  bar -= along * span.axis;
  const double length = bar.norm(), closing = carries_compression ? along : 0.0;
  if (!(length > 0)) return {span.axis, -seat, closing};
  return {bar / length, length - seat, closing};
}

}  // namespace detail

/// @param seat  by which pretension has stretched the bar before [m], >= 0
template <int Dim>
[[nodiscard]] BarStretch<Dim> bar_stretch(const BoltSpan<Dim>& span, double seat,
                                          bool carries_compression) {
  VOUSSOIR_ASSERT(detail::is_unit(span.axis), "the axis of a bolt is a direction");
  const double initial = span.initial.norm();
  if (!(initial > 0)) return detail::stretch_from_joint(span, seat, carries_compression);
  const Vec<Dim> now = span.initial + span.motion;
  const double length = now.norm();
  if (!(length > 0)) return {span.axis, -initial, 0, carries_compression};
  // l - d = (m^2 + 2 d.m)/(l + d) keeps its digits where the motion is tiny beside the span.
  const double extension =
      (span.motion.squaredNorm() + 2 * span.initial.dot(span.motion)) / (length + initial);
  return {now / length, extension, 0, carries_compression};
}

}  // namespace voussoir
