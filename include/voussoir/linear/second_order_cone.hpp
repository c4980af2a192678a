// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>
#include <voussoir/core/vec.hpp>

/// The cone of all vectors whose first entry is at least as long as the other two, and what an
/// interior point needs of it.
///
/// Source: Nesterov and Todd (1997), Self-scaled barriers and interior-point methods for convex
/// programming, Math. Oper. Res. 22; written out for this cone by Andersen, Roos and Terlaky
/// (2003), On implementing a primal-dual interior-point method for conic quadratic optimization,
/// Math. Program. 95.
namespace voussoir::detail::second_order_cone {

/// Along the axis of the cone: the unit of `product`.
[[nodiscard]] inline Vec3 unit() { return {1, 0, 0}; }

/// By how much u is inside, along the axis; negative outside.
[[nodiscard]] inline double depth(const Vec3& u) { return u[0] - std::hypot(u[1], u[2]); }

/// u0^2 - u1^2 - u2^2, without cancellation near the cone.
[[nodiscard]] inline double determinant(const Vec3& u) {
  return depth(u) * (u[0] + std::hypot(u[1], u[2]));
}

/// Jordan's product: of two vectors of the cone what products are of two positive numbers.
[[nodiscard]] inline Vec3 product(const Vec3& u, const Vec3& v) {
  return {dot_product(u, v), u[0] * v[1] + v[0] * u[1], u[0] * v[2] + v[0] * u[2]};
}

/// v of product(u, v) = of. @param u  inside the cone
[[nodiscard]] inline Vec3 quotient(const Vec3& of, const Vec3& u) {
  const double first = (u[0] * of[0] - u[1] * of[1] - u[2] * of[2]) / determinant(u);
  return {first, (of[1] - first * u[1]) / u[0], (of[2] - first * u[2]) / u[0]};
}

/// How far u can go along `step` until it is at the cone, in steps; infinite where it never is.
/// @param u  inside the cone
[[nodiscard]] inline double steps_to_edge(const Vec3& u, const Vec3& step) {
  // determinant(u + t step) = a t^2 + 2 b t + c
  const double a = step[0] * step[0] - step[1] * step[1] - step[2] * step[2],
               b = u[0] * step[0] - u[1] * step[1] - u[2] * step[2], c = determinant(u);
  if (b >= 0 && a >= 0) return std::numeric_limits<double>::infinity();
  // The root that comes first, without cancellation: there always is one, but for rounding.
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  return b <= 0 ? c / (root - b) : -(b + root) / a;
}

/// Scales two vectors inside the cone so that they are the same: W z = s over W.
class Scaling {
 public:
  Scaling() = default;
  Scaling(const Vec3& s, const Vec3& z) {
    const double of_s = std::sqrt(determinant(s)), of_z = std::sqrt(determinant(z));
    const Vec3 mirrored(z[0] / of_z, -z[1] / of_z, -z[2] / of_z);
    const Vec3 sum = s / of_s + mirrored;
    size_ = std::sqrt(of_s / of_z);
    w_ = sum / std::sqrt(determinant(sum));
  }

  [[nodiscard]] Vec3 times(const Vec3& v) const { return size_ * turned(v, 1); }
  [[nodiscard]] Vec3 over(const Vec3& v) const { return turned(v, -1) / size_; }
  [[nodiscard]] Fixed<3, 3> matrix() const {
    Fixed<3, 3> w;
    for (int c = 0; c < 3; ++c) set_column(w, c, times(axis_vector<3>(c)));
    return w;
  }
  /// The last two rows and columns of 1 / W^2 have this square root of their inverse.
  [[nodiscard]] Fixed<2, 2> root_across() const {
    const Vec2 across(w_[1], w_[2]);
    const double square = squared_length_of(across), shrunk = std::sqrt(1 + 2 * square);
    // 1 - 1 / shrunk over the square, without cancellation
    const double part = 2 / (shrunk * (1 + shrunk));
    return size_ * (diagonal_of<2>(1) - part * outer(across, across));
  }

 private:
  /// W over its size; with the sign -1 its inverse.
  [[nodiscard]] Vec3 turned(const Vec3& v, double sign) const {
    const double across = w_[1] * v[1] + w_[2] * v[2];
    const double along = sign * v[0] + across / (1 + w_[0]);
    return {w_[0] * v[0] + sign * across, v[1] + along * w_[1], v[2] + along * w_[2]};
  }

  double size_ = 1;
  Vec3 w_ = unit();  ///< of determinant 1
};

/// Three unknowns of a programme in the cone: s = (slope x0 + offset, x1, x2), and its multiplier
/// z.
struct Unknowns {
  std::size_t first;
  double slope, offset;  ///< of unknowns counted from their lower bounds
  Vec3 s = unit(), z = unit(), ds = zeros<Vec3>(), dz = zeros<Vec3>();
  Vec3 both = unit();        ///< s over W, W z
  Vec3 aim = zeros<Vec3>();  ///< what both shall move by, together
  Scaling w = {};
  Fixed<3, 3> root =
      diagonal_of<3>(1);  ///< its transpose times it is the weight of the three columns

  [[nodiscard]] Vec3 value(const std::vector<double>& x) const {
    return {slope * x[first] + offset, x[first + 1], x[first + 2]};
  }
  [[nodiscard]] Vec3 change(const std::vector<double>& dx) const {
    return {slope * dx[first], dx[first + 1], dx[first + 2]};
  }
  void subtract_transposed(const Vec3& v, std::vector<double>& from) const {
    from[first] -= slope * v[0];
    from[first + 1] -= v[1];
    from[first + 2] -= v[2];
  }
  void multiply_by_weight(std::vector<double>& v) const {
    write_at(&v[first], Vec3(transposed_product(root, Vec3(root * vector_at<3>(&v[first])))));
  }
  /// @param of_bounds  weight of the first unknown by its own bounds
  void scale(double of_bounds) {
    w = Scaling(s, z);
    both = w.times(z);
    // The inverse of G' W^-2 G + 1 / of_bounds, G = diag(slope, 1, 1): by its root, for W itself
    // has half of the digits that W^2 would lose at the edge of the cone.
    if (slope > 0) {
      root = w.matrix();
      for (int r = 0; r < 3; ++r) root(r, 0) /= slope;
      const Vec3 axis = column(root, 0);
      const double square = squared_length_of(axis), stretched = std::sqrt(1 + square / of_bounds);
      root -= (1 - 1 / stretched) / square * outer(axis, Vec3(transposed_product(root, axis)));
    } else {
      root = zeros<Fixed<3, 3>>();
      root(0, 0) = std::sqrt(of_bounds);
      set_block(root, 1, 1, w.root_across());
    }
  }
  /// The corrector, after a step (ds, dz) without one.
  void aim_at(double centre) {
    aim = quotient(centre * unit() - product(both, both) - product(w.over(ds), w.times(dz)), both);
  }
};

}  // namespace voussoir::detail::second_order_cone
