// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/small_algebra.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/moving_body.hpp>

namespace voussoir::detail {

/// Adds M^-1/2 G^T K G M^-1/2 of one contact that is closed and sticks to the matrix of body a or
/// b, in the body's frame [1/s^2], and the same of its dashpots to `damping` [1/s].
template <int Dim, class Group, int Dof>
void add_springs(const Group& group, std::size_t k, bool on_b,
                 const std::vector<MovingBody<Dim>>& bodies, Fixed<Dof, Dof>& sum,
                 Fixed<Dof, Dof>& damping) {
  const auto& c = group.contacts()[k];
  const MovingBody<Dim>&a = bodies[static_cast<std::size_t>(c.a)],
        &b = bodies[static_cast<std::size_t>(c.b)], &body = on_b ? b : a;
  const Rotation<Dim> frame =
      on_b ? Rotation<Dim>(transposed(b.pose.rotation) * (a.pose.rotation * c.frame)) : c.frame;
  const double root = 1 / std::sqrt(body.mass);
  for (auto i = static_cast<std::size_t>(c.first); i < static_cast<std::size_t>(c.last); ++i) {
    const auto& p = group.points()[i];
    const Vec<Dim> place =
        on_b ? p.place
             : Vec<Dim>(transposed(a.pose.rotation) * (b.pose(p.place) - a.pose.position));
    for (int axis = 0; axis < Dim; ++axis) {
      const Vec<Dim> along = column(frame, axis);
      Fixed<Dof, 1> g;
      const Spin<Dim> moment = moment_of(place, along);
      for (int row = 0; row < Dim; ++row) g[row] = root * along[row];
      for (int row = 0; row < spin_count<Dim>; ++row)
        g[Dim + row] = moment[row] / std::sqrt(body.inertia[row]);
      const double stiffness = p.weight * (axis == 0 ? group.law_of(c).joint_normal_stiffness()
                                                     : group.law_of(c).joint_shear_stiffness());
      sum += outer<Dof, Dof>(stiffness * g, g);
      if (axis == 0 && c.viscosity > 0) damping += outer<Dof, Dof>(c.viscosity * stiffness * g, g);
    }
  }
}

/// The largest sum of absolute values in a row: a bound on the largest eigenvalue.
template <int Size>
[[nodiscard]] double largest_row(const Fixed<Size, Size>& matrix) {
  double largest = 0;
  for (int r = 0; r < Size; ++r) {
    double absolute = 0;
    for (int k = 0; k < Size; ++k) absolute += std::abs(matrix(r, k));
    largest = std::max(largest, absolute);
  }
  return largest;
}

}  // namespace voussoir::detail
