// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/small_displacement.hpp>

namespace voussoir {

/// A bolt at one joint: a spring between its anchors in two bodies, and its dowel at the joint.
///
/// Arms and spans are in the axes of the reference configuration; in a run, those of its body's
/// frame. The span at installation turns with the first body, so that turning the rock as a whole
/// does not strain the bolt.
template <int Dim, class Law>
struct BoltSpring {
  static constexpr int dim = Dim;
  static constexpr int dof = Dim + spin_count<Dim>;
  using Block = Fixed<dof, dof>;

  int a = 0, b = 0;     ///< body towards the head, body towards the tip
  int bolt = 0;         ///< number of the bolt
  double position = 0;  ///< of the joint, from the head [m]
  /// From the centres of the bodies to the anchors [m].
  Vec<Dim> arm_a = zeros<Vec<Dim>>(), arm_b = zeros<Vec<Dim>>();
  /// From there to where the bar crosses the joint [m].
  Vec<Dim> joint_a = zeros<Vec<Dim>>(), joint_b = zeros<Vec<Dim>>();
  /// At installation; `motion`, `jump`: those then present, negated.
  BoltSpan<Dim> span{zeros<Vec<Dim>>(), zeros<Vec<Dim>>(), zeros<Vec<Dim>>()};
  double share = 1;  ///< 1 / bolt spacing along the tunnel in 2-D [1/m], 1 in 3-D
  int law = 0;       ///< index into the laws of the set
  typename Law::State state{};
  bool broken = false;  ///< it has no stiffness any more

  /// At small displacements `u`.
  [[nodiscard]] BoltSpan<Dim> span_at(const double* u) const {
    const double *ua = u + dof * a, *ub = u + dof * b;
    BoltSpan<Dim> now = span;
    now.motion += displacement_at<Dim>(ub, arm_b) - displacement_at<Dim>(ua, arm_a);
    now.jump += displacement_at<Dim>(ub, joint_b) - displacement_at<Dim>(ua, joint_a);
    return now;
  }
  /// With the bodies anywhere.
  [[nodiscard]] BoltSpan<Dim> span_at(const Pose<Dim>& at_a, const Pose<Dim>& at_b) const {
    BoltSpan<Dim> now;
    now.initial = at_a.rotation * span.initial;
    now.axis = at_a.rotation * span.axis;
    now.motion = at_b(arm_b) - at_a(arm_a) - now.initial + at_a.rotation * span.motion;
    now.jump = at_b(joint_b) - at_a(joint_a) + at_a.rotation * span.jump;
    return now;
  }
  void add_force(const Law& spring, const double* u, double* f) const {
    const BoltForce<Dim> force = spring.force(span_at(u), state);
    add_force_at<Dim>(f + dof * a, arm_a, share * force.pull);
    add_force_at<Dim>(f + dof * b, arm_b, -share * force.pull);
    add_force_at<Dim>(f + dof * a, joint_a, share * force.dowel);
    add_force_at<Dim>(f + dof * b, joint_b, -share * force.dowel);
  }

  /// What its law says of it there.
  [[nodiscard]] BoltReport report(const Law& spring, const BoltSpan<Dim>& now) const {
    return report_of(spring, now, state, broken);
  }

  /// Brings its history up to date. @return  true if it breaks now
  bool commit(const Law& spring, const BoltSpan<Dim>& now) {
    const bool breaks = spring.commit(now, state);
    broken = broken || breaks;
    return breaks;
  }

  /// The stiffness at installation, none if broken: sink(a, b, aa, ab, ba, bb).
  template <class Sink>
  void add_stiffness(const Law& spring, Sink&& sink) const {
    if (broken) return;
    const BoltStiffness<Dim> stiffness = spring.stiffness(span);
    hand_over(share * stiffness.pull, share * stiffness.dowel, sink);
  }
  /// The negative derivative of the forces at `u`, by differences (see ContactGroup::add_tangent).
  template <class Sink>
  void add_tangent(const Law& spring, const double* u, Sink&& sink) const {
    const BoltSpan<Dim> now = span_at(u);
    hand_over(derivative(spring, now, state, &BoltSpan<Dim>::motion, &BoltForce<Dim>::pull),
              derivative(spring, now, state, &BoltSpan<Dim>::jump, &BoltForce<Dim>::dowel), sink);
  }

  /// See `Support::to_frames`.
  /// @param at_a, at_b  of its bodies
  void to_frames(const Pose<Dim>& at_a, const Pose<Dim>& at_b, const double* u) {
    const BoltSpan<Dim> was = u != nullptr ? span_at(u) : span;
    const Vec<Dim> apart = at_b.position - at_a.position;
    span.motion = in_axes_of(at_a, was.initial + was.motion - (apart + arm_b - arm_a));
    span.jump = in_axes_of(at_a, was.jump - (apart + joint_b - joint_a));
    span.initial = in_axes_of(at_a, was.initial);
    span.axis = in_axes_of(at_a, was.axis);
    for (Vec<Dim>* arm : {&arm_a, &joint_a}) *arm = in_axes_of(at_a, *arm);
    for (Vec<Dim>* arm : {&arm_b, &joint_b}) *arm = in_axes_of(at_b, *arm);
  }
  /// See `Support::from_frames`.
  void from_frames(const Pose<Dim>& at_a, const Pose<Dim>& at_b, const double* u) {
    const BoltSpan<Dim> now = span_at(at_a, at_b);
    for (Vec<Dim>* arm : {&arm_a, &joint_a}) *arm = at_a.rotation * *arm;
    for (Vec<Dim>* arm : {&arm_b, &joint_b}) *arm = at_b.rotation * *arm;
    span = {now.initial, now.axis, zeros<Vec<Dim>>()};
    const BoltSpan<Dim> linear = span_at(u);
    span.motion = now.motion - linear.motion;
    span.jump = now.jump - linear.jump;
  }

 private:
  [[nodiscard]] static Vec<Dim> in_axes_of(const Pose<Dim>& frame, const Vec<Dim>& v) {
    return transposed_product(frame.rotation, v);
  }
  using Lever = Fixed<dof, Dim>;
  /// Of a part of the force with respect to a part of the span, times the share.
  [[nodiscard]] Stress<Dim> derivative(const Law& spring, const BoltSpan<Dim>& at,
                                       const typename Law::State& remembered,
                                       Vec<Dim> BoltSpan<Dim>::*in,
                                       Vec<Dim> BoltForce<Dim>::*out) const {
    constexpr double step = 1e-8;
    Stress<Dim> k;
    for (int l = 0; l < Dim; ++l) {
      BoltSpan<Dim> more = at, less = at;
      (more.*in)[l] += step;
      (less.*in)[l] -= step;
      set_column(k, l,
                 share *
                     (spring.force(more, remembered).*out - spring.force(less, remembered).*out) /
                     (2 * step));
    }
    return k;
  }
  template <class Sink>
  void hand_over(const Stress<Dim>& pull, const Stress<Dim>& dowel, Sink&& sink) const {
    const Lever pa = lever_matrix<Dim>(arm_a), pb = lever_matrix<Dim>(arm_b),
                da = lever_matrix<Dim>(joint_a), db = lever_matrix<Dim>(joint_b);
    const auto block = [&](const Lever& p, const Lever& q, const Lever& d, const Lever& e) {
      return Block(p * pull * transposed(q) + d * dowel * transposed(e));
    };
    sink(a, b, block(pa, pa, da, da), Block(-block(pa, pb, da, db)), Block(-block(pb, pa, db, da)),
         block(pb, pb, db, db));
  }
};

}  // namespace voussoir
