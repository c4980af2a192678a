// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/solver/contact_group.hpp>

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

  using Block = Eigen::Matrix<double, dof, dof>;
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
  using Lever = Eigen::Matrix<double, dof, dim>;
  [[nodiscard]] static Lever lever(const Vec<dim>& arm) {
    Lever l;
    for (int k = 0; k < dim; ++k) {
      const Vec<dim> axis = Vec<dim>::Unit(k);
      l.col(k) << axis, moment_of(arm, axis);
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
      k.col(l) = share *
                 (spring.force(more, remembered).*out - spring.force(less, remembered).*out) /
                 (2 * step);
    }
    return k;
  }
  template <class Sink>
  void hand_over(const Stress<dim>& pull, const Stress<dim>& dowel, Sink&& sink) const {
    const Lever pa = lever(arm_a), pb = lever(arm_b), da = lever(joint_a), db = lever(joint_b);
    const auto block = [&](const Lever& p, const Lever& q, const Lever& d, const Lever& e) {
      return Block(p * pull * q.transpose() + d * dowel * e.transpose());
    };
    sink(block(pa, pa, da, da), Block(-block(pa, pb, da, db)), Block(-block(pb, pa, db, da)),
         block(pb, pb, db, db));
  }
};

/// The axes of an element, in rows. The first runs along it. In space the second lies in the plane
/// of the element and `outward`, on its side.
/// @param along  from the first node to the second, of any length
template <int Dim>
[[nodiscard]] Rotation<Dim> frame_axes(const Vec<Dim>& along, const Vec<Dim>& outward) {
  const Vec<Dim> x = along.normalized();
  Rotation<Dim> axes;
  if constexpr (Dim == 2) {
    axes << x.x(), x.y(), -x.y(), x.x();
  } else {
    const Vec3 y = (outward - outward.dot(x) * x).normalized();
    axes << x.transpose(), y.transpose(), cross(x, y).transpose();
  }
  return axes;
}

/// World axes to those of an element, for translations and rotations of both ends.
template <int Dim>
[[nodiscard]] ElementMatrix<Dim + spin_count<Dim>> in_element_axes(const Rotation<Dim>& axes) {
  constexpr int dof = Dim + spin_count<Dim>;
  ElementMatrix<dof> turn = ElementMatrix<dof>::Zero();
  for (int end = 0; end < 2; ++end) {
    turn.template block<Dim, Dim>(dof * end, dof * end) = axes;
    if constexpr (Dim == 2)
      turn(dof * end + 2, dof * end + 2) = 1;
    else
      turn.template block<3, 3>(dof * end + 3, dof * end + 3) = axes;
  }
  return turn;
}

/// A straight piece of lining between two nodes.
template <class Geometry>
struct FrameElement {
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;
  using Matrix = ElementMatrix<dof>;
  using Values = Eigen::Matrix<double, 2 * dof, 1>;

  /// @param axes  of the element, in rows (see `frame_axes`)
  FrameElement(int first, int second, double rest_length, const Rotation<dim>& axes,
               const Matrix& stiffness)
      : i(first),
        j(second),
        length(rest_length),
        at_rest(axes),
        turn(in_element_axes<dim>(axes)),
        local(stiffness) {}

  int i, j;               ///< nodes, as bodies of the system
  double length;          ///< at rest [m]
  Rotation<dim> at_rest;  ///< its axes, in rows
  Matrix turn;            ///< world to element axes
  Matrix local;           ///< stiffness in element axes
  /// Forces on the ends at displacement zero, element axes: not zero once contacts have been found
  /// again, and the element has turned.
  Values start = Values::Zero();

  /// Forces on the two ends in element axes at displacement `u`.
  [[nodiscard]] Values end_forces(const double* u) const {
    Values q;
    q << Eigen::Map<const Eigen::Matrix<double, dof, 1>>(u + dof * i),
        Eigen::Map<const Eigen::Matrix<double, dof, 1>>(u + dof * j);
    return start + local * (turn * q);
  }
  /// The same with the nodes anywhere: from the length of the chord and the turns of the nodes
  /// against it, which are small.
  /// @param a, b  of the nodes; turned from how they were at rest
  [[nodiscard]] Values end_forces(const Pose<dim>& a, const Pose<dim>& b) const {
    const Vec<dim> along = b.position - a.position;
    const Rotation<dim> now = axes_along(along, a);
    Values q = Values::Zero();
    q[dof] = along.norm() - length;
    q.template segment<dof - dim>(dim) = small_turn(now * a.rotation * at_rest.transpose());
    q.template segment<dof - dim>(dof + dim) = small_turn(now * b.rotation * at_rest.transpose());
    return local * q;
  }
  /// Turns the element to where its nodes are now; it keeps its forces.
  void follow(const Pose<dim>& a, const Pose<dim>& b, const double* u) {
    const Values forces = end_forces(a, b);
    turn = in_element_axes<dim>(axes_along(b.position - a.position, a));
    start.setZero();
    start = forces - end_forces(u);
  }

  void add_force(const double* u, double* f) const {
    const Values back = turn.transpose() * end_forces(u);
    Eigen::Map<Eigen::Matrix<double, dof, 1>>{f + dof* i} -= back.template head<dof>();
    Eigen::Map<Eigen::Matrix<double, dof, 1>>{f + dof* j} -= back.template tail<dof>();
  }
  template <class Sink>
  void add_stiffness(Sink&& sink) const {
    const Matrix k = turn.transpose() * local * turn;
    using Block = Eigen::Matrix<double, dof, dof>;
    sink(i, j, Block(k.template topLeftCorner<dof, dof>()),
         Block(k.template topRightCorner<dof, dof>()),
         Block(k.template bottomRightCorner<dof, dof>()));
  }

 private:
  /// Axes of the element along a chord, its second axis turned with node a.
  [[nodiscard]] Rotation<dim> axes_along(const Vec<dim>& along, const Pose<dim>& a) const {
    return frame_axes<dim>(along, a.rotation * Vec<dim>(at_rest.row(1).transpose()));
  }
  /// The vector of a rotation that is small [rad].
  [[nodiscard]] static Spin<dim> small_turn(const Rotation<dim>& r) {
    if constexpr (dim == 2)
      return Spin<2>(0.5 * (r(1, 0) - r(0, 1)));
    else
      return 0.5 * Spin<3>(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  }
};

}  // namespace voussoir
