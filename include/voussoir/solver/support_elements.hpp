// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/solver/contact_group.hpp>

namespace voussoir {

/// A bolt at one joint: a spring between points of two bodies.
template <class Geometry, class Law>
struct BoltSpring {
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;

  int a, b;                ///< body towards the head, body towards the tip
  int bolt;                ///< number of the bolt
  double position;         ///< of the joint, from the head [m]
  Vec<dim> arm_a, arm_b;   ///< from the centres of the bodies to the anchors [m]
  BoltSpan<dim> span;      ///< at installation; `motion` holds the jump then present, negated
  double share;            ///< 1 / bolt spacing along the tunnel in 2-D [1/m], 1 in 3-D
  int law;                 ///< index into the laws of the system
  typename Law::State state{};

  [[nodiscard]] BoltSpan<dim> span_at(const double* u) const {
    BoltSpan<dim> now = span;
    now.motion += displacement_at<dim>(u + dof * b, arm_b) - displacement_at<dim>(u + dof * a, arm_a);
    return now;
  }
  void add_force(const Law& spring, const double* u, double* f) const {
    const Vec<dim> pull = share * spring.force(span_at(u), state).pull;
    add_force_at<dim>(f + dof * a, arm_a, pull);
    add_force_at<dim>(f + dof * b, arm_b, -pull);
  }
  using Block = Eigen::Matrix<double, dof, dof>;
  template <class Sink>
  void add_stiffness(const Law& spring, Sink&& sink) const {
    const Stress<dim> k = share * spring.stiffness(span);
    const Lever to_a = lever(arm_a), to_b = lever(arm_b);
    sink(a, b, Block(to_a * k * to_a.transpose()), Block(-to_a * k * to_b.transpose()),
         Block(to_b * k * to_b.transpose()));
  }
  /// The negative derivative of the forces at `u`, by differences (see ContactGroup::add_tangent).
  template <class Sink>
  void add_tangent(const Law& spring, const double* u, Sink&& sink) const {
    constexpr double step = 1e-8;
    Stress<dim> k;
    for (int l = 0; l < dim; ++l) {
      BoltSpan<dim> more = span_at(u), less = more;
      more.motion[l] += step;
      less.motion[l] -= step;
      k.col(l) = share * (spring.force(more, state).pull - spring.force(less, state).pull) / (2 * step);
    }
    const Lever to_a = lever(arm_a), to_b = lever(arm_b);
    sink(a, b, Block(to_a * k * to_a.transpose()), Block(-to_a * k * to_b.transpose()),
         Block(-to_b * k * to_a.transpose()), Block(to_b * k * to_b.transpose()));
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
};

/// A straight piece of lining between two nodes.
template <class Geometry>
struct FrameElement {
  static constexpr int dof = Geometry::dof;
  using Matrix = ElementMatrix<dof>;
  using Values = Eigen::Matrix<double, 2 * dof, 1>;

  int i, j;      ///< nodes, as bodies of the system
  double length; ///< [m]
  Matrix turn;   ///< world to element axes
  Matrix local;  ///< stiffness in element axes

  /// Forces on the two ends in element axes at displacement `u`.
  [[nodiscard]] Values end_forces(const double* u) const {
    Values q;
    q << Eigen::Map<const Eigen::Matrix<double, dof, 1>>(u + dof * i),
        Eigen::Map<const Eigen::Matrix<double, dof, 1>>(u + dof * j);
    return local * (turn * q);
  }
  void add_force(const double* u, double* f) const {
    const Values back = turn.transpose() * end_forces(u);
    Eigen::Map<Eigen::Matrix<double, dof, 1>>{f + dof * i} -= back.template head<dof>();
    Eigen::Map<Eigen::Matrix<double, dof, 1>>{f + dof * j} -= back.template tail<dof>();
  }
  template <class Sink>
  void add_stiffness(Sink&& sink) const {
    const Matrix k = turn.transpose() * local * turn;
    using Block = Eigen::Matrix<double, dof, dof>;
    sink(i, j, Block(k.template topLeftCorner<dof, dof>()),
         Block(k.template topRightCorner<dof, dof>()),
         Block(k.template bottomRightCorner<dof, dof>()));
  }
};

/// World axes to the axes of a plane element from `a` to `b`.
[[nodiscard]] inline ElementMatrix<3> element_axes(const Vec2& a, const Vec2& b) {
  const Vec2 x = (b - a).normalized();
  ElementMatrix<3> turn = ElementMatrix<3>::Zero();
  for (int end = 0; end < 2; ++end) {
    turn.block<2, 2>(3 * end, 3 * end) << x.x(), x.y(), -x.y(), x.x();
    turn(3 * end + 2, 3 * end + 2) = 1;
  }
  return turn;
}

}  // namespace voussoir
