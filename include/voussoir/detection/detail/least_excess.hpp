// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/detail/plane_pair.hpp>

namespace voussoir::detail {

/// Planes on which the linear program rests, by their numbers in a `PlanePair`.
template <int Dim>
using ActivePlanes = std::array<std::uint16_t, Dim + 1>;
inline constexpr std::uint16_t no_plane = std::numeric_limits<std::uint16_t>::max();
template <int Dim>
inline constexpr ActivePlanes<Dim> no_planes = [] {
  ActivePlanes<Dim> planes{};
  for (auto& plane : planes) plane = no_plane;
  return planes;
}();

/// When the linear program may stop before its optimum.
enum class Until : unsigned char {
  sign,    ///< as soon as the sign of the least excess is known
  optimum  ///< never
};

/// The linear program of Boon et al. (2012): the least s such that some point x has
///
///   normal_i . x - s <= offset_i   for all planes of both shapes.
///
/// s < 0: x lies inside both shapes by -s; it is the centre of the largest ball in their
/// intersection. s > 0: they are apart, and touch when all planes of both are moved outwards by s.
///
/// A dual simplex method. It goes from one set of Dim + 1 active planes to the next. Their normals
/// have a convex combination that is 0, so no point does better than the s at which they meet: s
/// is a lower bound and only rises. Hence s > 0 at any time proves the shapes apart, and a point
/// met on the way with room to all planes proves that they overlap.
template <int Dim>
class LeastExcess {
 public:
  /// @param region  their intersection, if any, lies within this distance of where the planes are
  ///                seen from [m]
  /// @param start   active planes of an earlier time; used if they still hold up a lower bound
  /// @param enough  where s is above this it may be any value above [m]
  LeastExcess(const PlanePair<Dim>& planes, double region, const ActivePlanes<Dim>& start,
              Until until, double enough = std::numeric_limits<double>::infinity())
      : planes_(&planes), active_(start) {
    if (until == Until::sign) enough = 0;
    if (!take_start()) take_walls(1000 * region);
    const double tolerance = 1e-15 * region;
    for (int round = 0; round < 100; ++round) {
      const bool by_number = round >= 40;  // Bland's rule: slow, but never runs in circles
      const PlaneExcess worst = by_number ? first_above(excess() + tolerance) : largest();
      if (until == Until::sign && worst.excess < 0) {
        solution_[Dim] = worst.excess;
        return;
      }
      // An active plane is beyond s by a rounding only.
      const bool done = worst.excess <= excess() + tolerance || is_active(worst.plane) ||
                        (excess() > enough && walls_ == 0);
      if (done && exact_) return;
      if (done)
        invert();
      else if (!exchange(worst, by_number))
        return;
    }
  }

  /// s, or with `Until::sign` a number of its sign [m].
  [[nodiscard]] double excess() const { return solution_[Dim]; }
  /// x, as a step from where the planes are seen from [m].
  [[nodiscard]] Vec<Dim> point() const { return solution_.template head<Dim>(); }
  /// `no_plane` where the search ended at a wall, far away.
  [[nodiscard]] const ActivePlanes<Dim>& active() const { return active_; }

 private:
  static constexpr int N = Dim + 1;
  using Column = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  struct PlaneExcess {
    std::size_t plane;
    double excess;  ///< normal . x - offset: positive outside [m]
  };

  /// Multiplied by (x, s): normal . x - s.
  [[nodiscard]] Column row_of(std::size_t plane) const {
    const Vec<Dim> normal = planes_->normal_of(plane);
    Column row;  // component by component: g++ 12 warns of what operator<< makes of it
    for (int axis = 0; axis < Dim; ++axis) row[axis] = normal[axis];
    row[Dim] = -1;
    return row;
  }
  void activate(int k, std::size_t plane) {
    rows_.row(k) = row_of(plane).transpose();
    sides_[k] = planes_->room_of(plane);
    active_[static_cast<std::size_t>(k)] = static_cast<std::uint16_t>(plane);
  }
  [[nodiscard]] bool is_active(std::size_t plane) const {
    return std::find(active_.begin(), active_.end(), plane) != active_.end();
  }
  /// Of active plane k in the convex combination that is 0.
  [[nodiscard]] double weight(int k) const { return -inverse_(Dim, k); }

  bool take_start() {
    for (const std::uint16_t plane : active_)
      if (plane >= planes_->count()) return false;
    for (int k = 0; k < N; ++k) activate(k, active_[static_cast<std::size_t>(k)]);
    invert();
    for (int k = 0; k < N; ++k)
      if (!(weight(k) >= 0)) return false;  // also of planes that have become dependent
    return true;
  }

  /// Walls of a simplex around the region: -x_k <= distance and sum x_k <= sqrt(Dim) distance.
  /// They are so far out that none is active at the end if the shapes overlap.
  void take_walls(double distance) {
    const double root = std::sqrt(static_cast<double>(Dim)), slanted = 1 / (1 + root);
    walls_ = N;
    active_ = no_planes<Dim>;
    rows_.setZero();
    rows_.template topLeftCorner<Dim, Dim>().diagonal().setConstant(-1);
    rows_.template block<1, Dim>(Dim, 0).setConstant(1 / root);
    rows_.col(Dim).setConstant(-1);
    sides_.setConstant(distance);
    inverse_.setConstant(slanted / root);
    inverse_.col(Dim).setConstant(slanted);
    inverse_.template topLeftCorner<Dim, Dim>().diagonal().array() -= 1;
    inverse_.row(Dim) *= -1;
    solution_ = Column::Unit(Dim) * -distance;
    exact_ = true;
  }

  /// Gauss-Jordan with partial pivoting, and one refinement of the solution.
  void invert() {
    Matrix left = rows_;
    inverse_.setIdentity();
    for (int k = 0; k < N; ++k) {
      int pivot = k;
      for (int i = k + 1; i < N; ++i)
        if (std::abs(left(i, k)) > std::abs(left(pivot, k))) pivot = i;
      left.row(k).swap(left.row(pivot));
      inverse_.row(k).swap(inverse_.row(pivot));
      const double scale = 1 / left(k, k);
      left.row(k) *= scale;
      inverse_.row(k) *= scale;
      for (int i = 0; i < N; ++i) {
        if (i == k) continue;
        const double factor = left(i, k);
        left.row(i) -= factor * left.row(k);
        inverse_.row(i) -= factor * inverse_.row(k);
      }
    }
    solution_ = inverse_ * sides_;
    solution_ += inverse_ * (sides_ - rows_ * solution_);
    exact_ = true;
  }

  [[nodiscard]] PlaneExcess largest() const {
    PlaneExcess worst{0, -std::numeric_limits<double>::infinity()};
    const Vec<Dim> x = point();
    for (std::size_t group = 0; group < planes_->padded_count(); group += lane_count) {
      double excesses[lane_count];
      (planes_->along(x, group) - planes_->room(group)).store(excesses);
      for (std::size_t lane = 0; lane < lane_count; ++lane)
        if (excesses[lane] > worst.excess) worst = {group + lane, excesses[lane]};
    }
    return worst;
  }
  [[nodiscard]] PlaneExcess first_above(double bound) const {
    for (std::size_t plane = 0; plane < planes_->count(); ++plane)
      if (const double excess = planes_->normal_of(plane).dot(point()) - planes_->room_of(plane);
          excess > bound && !is_active(plane))
        return {plane, excess};
    return largest();
  }

  /// Makes the plane active in place of the one whose weight is the first to reach 0.
  bool exchange(const PlaneExcess& entering, bool by_number) {
    const Column share = inverse_.transpose() * row_of(entering.plane);
    int leaving = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < N; ++k) {
      if (!(share[k] > 1e-12)) continue;
      const double ratio = std::fmax(weight(k), 0.0) / share[k];
      if (ratio < least ||
          (by_number && leaving >= 0 && ratio == least &&
           active_[static_cast<std::size_t>(k)] < active_[static_cast<std::size_t>(leaving)])) {
        leaving = k;
        least = ratio;
      }
    }
    if (leaving < 0) return false;
    if (active_[static_cast<std::size_t>(leaving)] == no_plane) --walls_;
    activate(leaving, entering.plane);
    inverse_.col(leaving) /= share[leaving];
    for (int k = 0; k < N; ++k)
      if (k != leaving) inverse_.col(k) -= share[k] * inverse_.col(leaving);
    solution_ -= (entering.excess - excess()) * inverse_.col(leaving);
    exact_ = false;
    return true;
  }

  const PlanePair<Dim>* planes_;
  ActivePlanes<Dim> active_;
  Matrix rows_, inverse_;  ///< of the active planes, and its inverse
  Column sides_, solution_;
  int walls_ = 0;
  bool exact_ =
      false;  ///< inverse and solution are of `rows_`, not brought up to date by exchanges
};

}  // namespace voussoir::detail
