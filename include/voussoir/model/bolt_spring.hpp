// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/contact_group.hpp>

namespace voussoir {

/// A bolt at one joint: a spring between its anchors in two bodies, and its dowel at the joint.
template <class Geometry, class Law>
struct BoltSpring {
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;

  int a, b;                   ///< body towards the head, body towards the tip
  int bolt;                   ///< number of the bolt
  double position;            ///< of the joint, from the head [m]
  Vec<dim> arm_a, arm_b;      ///< from the centres of the bodies to the anchors [m]
  Vec<dim> joint_a, joint_b;  ///< from there to where the bar crosses the joint [m]
  BoltSpan<dim> span;         ///< at installation; `motion`, `jump`: those then present, negated
  double share;               ///< 1 / bolt spacing along the tunnel in 2-D [1/m], 1 in 3-D
  int law;                    ///< index into the laws of the system
  typename Law::State state{};
  bool broken = false;  ///< it has no stiffness any more

  [[nodiscard]] BoltSpan<dim> span_at(const double* u) const {
    const double *ua = u + dof * a, *ub = u + dof * b;
    BoltSpan<dim> now = span;
    now.motion += displacement_at<dim>(ub, arm_b) - displacement_at<dim>(ua, arm_a);
    now.jump += displacement_at<dim>(ub, joint_b) - displacement_at<dim>(ua, joint_a);
    return now;
  }
  void add_force(const Law& spring, const double* u, double* f) const {
    const BoltForce<dim> force = spring.force(span_at(u), state);
    add_force_at<dim>(f + dof * a, arm_a, share * force.pull);
    add_force_at<dim>(f + dof * b, arm_b, -share * force.pull);
    add_force_at<dim>(f + dof * a, joint_a, share * force.dowel);
    add_force_at<dim>(f + dof * b, joint_b, -share * force.dowel);
  }

  /// @return  true if it breaks now
  bool commit(const Law& spring, const double* u) {
    const bool breaks = spring.commit(span_at(u), state);
    broken = broken || breaks;
    return breaks;
  }

  using Block = Fixed<dof, dof>;
  /// The stiffness at installation, none if broken: sink(a, b, aa, ab, bb).
  template <class Sink>
  void add_stiffness(const Law& spring, Sink&& sink) const {
    if (broken) return;
    const Stress<dim> pull = share * spring.stiffness(span),
                      dowel = derivative(spring, span, {}, &BoltSpan<dim>::jump,
                                         &BoltForce<dim>::dowel);
    hand_over(pull, dowel, [&](const Block& aa, const Block& ab, const Block&, const Block& bb) {
      sink(a, b, aa, ab, bb);
    });
  }
  /// The negative derivative of the forces at `u`, by differences (see ContactGroup::add_tangent):
  /// sink(a, b, aa, ab, ba, bb).
  template <class Sink>
  void add_tangent(const Law& spring, const double* u, Sink&& sink) const {
    const BoltSpan<dim> now = span_at(u);
    hand_over(derivative(spring, now, state, &BoltSpan<dim>::motion, &BoltForce<dim>::pull),
              derivative(spring, now, state, &BoltSpan<dim>::jump, &BoltForce<dim>::dowel),
              [&](const Block& aa, const Block& ab, const Block& ba, const Block& bb) {
                sink(a, b, aa, ab, ba, bb);
              });
  }

 private:
  using Lever = Fixed<dof, dim>;
  [[nodiscard]] static Lever lever(const Vec<dim>& arm) {
    Lever l;
    for (int k = 0; k < dim; ++k) {
      const Vec<dim> axis = axis_vector<dim>(k);
      set_column(l, k, stacked(axis, moment_of(arm, axis)));
    }
    return l;
  }
  /// Of a part of the force with respect to a part of the span, times the share.
  [[nodiscard]] Stress<dim> derivative(const Law& spring, const BoltSpan<dim>& at,
                                       const typename Law::State& remembered,
                                       Vec<dim> BoltSpan<dim>::*in,
                                       Vec<dim> BoltForce<dim>::*out) const {
    constexpr double step = 1e-8;
    Stress<dim> k;
    for (int l = 0; l < dim; ++l) {
      BoltSpan<dim> more = at, less = at;
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
  void hand_over(const Stress<dim>& pull, const Stress<dim>& dowel, Sink&& sink) const {
    const Lever pa = lever(arm_a), pb = lever(arm_b), da = lever(joint_a), db = lever(joint_b);
    const auto block = [&](const Lever& p, const Lever& q, const Lever& d, const Lever& e) {
      return Block(p * pull * transposed(q) + d * dowel * transposed(e));
    };
    sink(block(pa, pa, da, da), Block(-block(pa, pb, da, db)), Block(-block(pb, pa, db, da)),
         block(pb, pb, db, db));
  }
};

}  // namespace voussoir
