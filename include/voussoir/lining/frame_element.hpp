// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/lining/lining_model.hpp>

namespace voussoir {

/// The axes of an element, in rows. The first runs along it. In 3-D the second lies in the plane
/// of the element and `outward`, on its side.
/// @param along  from the first node to the second, of any length
template <int Dim>
[[nodiscard]] Rotation<Dim> frame_axes(const Vec<Dim>& along, const Vec<Dim>& outward) {
  const Vec<Dim> x = along.normalized();
  if constexpr (Dim == 2) {
    return by_rows<2, 2>({x.x(), x.y(), -x.y(), x.x()});
  } else {
    const Vec3 y = (outward - outward.dot(x) * x).normalized();
    Rotation<Dim> axes;
    set_row(axes, 0, x);
    set_row(axes, 1, y);
    set_row(axes, 2, cross(x, y));
    return axes;
  }
}

/// World axes to those of an element, for translations and rotations of both ends.
template <int Dim>
[[nodiscard]] ElementMatrix<Dim + spin_count<Dim>> in_element_axes(const Rotation<Dim>& axes) {
  constexpr int dof = Dim + spin_count<Dim>;
  ElementMatrix<dof> turn = zeros<ElementMatrix<dof>>();
  for (int end = 0; end < 2; ++end) {
    set_block(turn, dof * end, dof * end, axes);
    if constexpr (Dim == 2)
      turn(dof * end + 2, dof * end + 2) = 1;
    else
      set_block(turn, dof * end + 3, dof * end + 3, axes);
  }
  return turn;
}

/// Takes from an element all that resists the turns of one of its ends, whose node it then does not
/// turn: they follow from the other motions of its ends (static condensation).
template <int Dof>
void hinge(ElementMatrix<Dof>& stiffness, int end) {
  constexpr int dim = Dof == 3 ? 2 : 3, all = 2 * Dof;
  for (int r = Dof * end + dim; r < Dof * (end + 1); ++r) {
    const double own = stiffness(r, r);
    if (own > 0) {
      const ElementMatrix<Dof> before = stiffness;
      for (int i = 0; i < all; ++i)
        for (int j = 0; j < all; ++j) stiffness(i, j) -= before(i, r) * before(r, j) / own;
    }
    for (int i = 0; i < all; ++i) stiffness(i, r) = stiffness(r, i) = 0;
  }
}

/// Fixes the turns of a pin, which nothing loads, by springs to nowhere.
/// @param spring  [N m]
template <int Dof>
void fix_pin(ElementMatrix<Dof>& stiffness, int end, double spring) {
  for (int r = Dof * end + (Dof == 3 ? 2 : 3); r < Dof * (end + 1); ++r) stiffness(r, r) += spring;
}

/// A straight piece of lining between two nodes.
template <class Geometry>
struct FrameElement {
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;
  using Matrix = ElementMatrix<dof>;
  using Values = Fixed<2 * dof, 1>;

  /// @param axes  of the element, in rows (see `frame_axes`)
  FrameElement(int first, int second, double rest_length, const Rotation<dim>& axes,
               const Matrix& stiffness)
      : i(first),
        j(second),
        length(rest_length),
        at_rest(axes),
        turn(in_element_axes<dim>(axes)),
        local(stiffness) {
    VOUSSOIR_ASSERT(i != j && length > 0, "a member joins two nodes");
    VOUSSOIR_ASSERT(detail::is_symmetric(local), "a stiffness is symmetric");
  }

  int i, j;               ///< nodes, as bodies of the system
  double length;          ///< at rest [m]
  Rotation<dim> at_rest;  ///< its axes, in rows
  Matrix turn;            ///< world to element axes
  Matrix local;           ///< stiffness in element axes
  /// Forces on the ends at displacement zero, element axes: not zero once contacts have been
  /// updated and the element has turned.
  Values start = zeros<Values>();
  /// What `deformation` would find of it where it is free of force: not zero of a member between
  /// nodes that had moved when it was installed.
  Values unstrained = zeros<Values>();
  /// Its first end, its second: hinged to a node that turns as it likes, which strains it only
  /// where it cannot (the spring of a pin).
  std::array<bool, 2> is_hinged{};

  /// Forces on the two ends in element axes at displacement `u`.
  [[nodiscard]] Values end_forces(const double* u) const {
    const Values q = stacked(vector_at<dof>(u + dof * i), vector_at<dof>(u + dof * j));
    return start + local * (turn * q);
  }
  /// The forces of its ends as sections of a lining have them: `end_forces`, without what the
  /// spring of a pin makes of roundings.
  [[nodiscard]] Values section_forces(const double* u) const {
    Values f = end_forces(u);
    for (const int end : {0, 1})
      for (int r = dim; r < dof && is_hinged[static_cast<std::size_t>(end)]; ++r)
        f[dof * end + r] = 0;
    return f;
  }
  /// The same with the nodes anywhere: from the length of the chord and the turns of the nodes
  /// against it, which are small.
  /// @param a, b  of the nodes; turned from how they were at rest
  [[nodiscard]] Values end_forces(const Pose<dim>& a, const Pose<dim>& b) const {
    return local * deformation(a, b);
  }
  /// Forces and moments that it puts on its nodes then, world axes.
  [[nodiscard]] Values push(const Pose<dim>& a, const Pose<dim>& b) const {
    const Rotation<dim> now = axes_along(b.position - a.position, a);
    return -(transposed(in_element_axes<dim>(now)) * end_forces(a, b));
  }
  /// Energy that it holds then [J].
  [[nodiscard]] double energy(const Pose<dim>& a, const Pose<dim>& b) const {
    const Values q = deformation(a, b);
    return 0.5 * q.dot(local * q);
  }
  /// Turns the element to where its nodes are now; it keeps its forces.
  void follow(const Pose<dim>& a, const Pose<dim>& b, const double* u) {
    const Values forces = end_forces(a, b);
    turn = in_element_axes<dim>(axes_along(b.position - a.position, a));
    start = zeros<Values>();
    start = forces - end_forces(u);
  }

  /// Makes it free of force where its nodes are now.
  /// @param u  their displacement
  void install_at(const Pose<dim>& a, const Pose<dim>& b, const double* u) {
    unstrained = zeros<Values>();
    unstrained = deformation(a, b);
    start = zeros<Values>();
    start = -end_forces(u);
  }

  /// Gives it another stiffness: what it carries stays, and what strains it from now on meets the
  /// new one (concrete that ages: dN = E(t) A d(epsilon), which is not N = E(t) A epsilon).
  /// @param factor  new over old, > 0
  /// @param u       displacement of its nodes, which are at the poses now
  void stiffen(double factor, const Pose<dim>& a, const Pose<dim>& b, const double* u) {
    VOUSSOIR_ASSERT(factor > 0, "a member has a stiffness");
    const Values carried = end_forces(u), strain = deformation(a, b);
    local *= factor;
    unstrained += (1 - 1 / factor) * strain;
    start = zeros<Values>();
    start = carried - end_forces(u);
  }

  void add_force(const double* u, double* f) const {
    const Values push = -(transposed(turn) * end_forces(u));
    add_at<dof>(f + dof * i, part<dof>(push, 0));
    add_at<dof>(f + dof * j, part<dof>(push, dof));
  }
  template <class Sink>
  void add_stiffness(Sink&& sink) const {
    const Matrix k = transposed(turn) * local * turn;
    sink(i, j, block_at<dof, dof>(k, 0, 0), block_at<dof, dof>(k, 0, dof),
         block_at<dof, dof>(k, dof, dof));
  }

 private:
  /// Displacements of the ends that strain it, element axes: the second node along the chord, and
  /// the turns of those that are not hinged against it.
  [[nodiscard]] Values deformation(const Pose<dim>& a, const Pose<dim>& b) const {
    const Vec<dim> along = b.position - a.position;
    const Rotation<dim> now = axes_along(along, a);
    Values q = zeros<Values>();
    q[dof] = along.norm() - length - unstrained[dof];
    if (!is_hinged[0])
      write_at(q.data() + dim, Spin<dim>(small_turn(now * a.rotation * transposed(at_rest)) -
                                         part<dof - dim>(unstrained, dim)));
    if (!is_hinged[1])
      write_at(q.data() + dof + dim, Spin<dim>(small_turn(now * b.rotation * transposed(at_rest)) -
                                               part<dof - dim>(unstrained, dof + dim)));
    return q;
  }
  /// Axes of the element along a chord, its second axis turned with node a.
  [[nodiscard]] Rotation<dim> axes_along(const Vec<dim>& along, const Pose<dim>& a) const {
    return frame_axes<dim>(along, a.rotation * row(at_rest, 1));
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
