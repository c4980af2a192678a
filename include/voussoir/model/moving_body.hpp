// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/geometry/principal_axes.hpp>

namespace voussoir {

/// A rotation by about `angle` round axis `axis` of a frame (2-D: the only one), without
/// trigonometric functions: by 2 atan(angle / 2), orthogonal to rounding. The difference,
/// angle^3 / 12, is of the order of the error of the time step.
template <int Dim>
[[nodiscard]] Rotation<Dim> small_rotation(double angle, int axis = 2) {
  const double half = 0.5 * angle, scale = 1 / (1 + half * half);
  const double c = (1 - half * half) * scale, s = 2 * half * scale;
  if constexpr (Dim == 2) {
    return by_rows<2, 2>({c, -s, s, c});
  } else {
    Rotation<3> turn = diagonal_of<3>(1);
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    turn(j, j) = turn(k, k) = c;
    turn(k, j) = s;
    turn(j, k) = -s;
    return turn;
  }
}

/// A rigid body that moves: finite displacements and rotations.
///
/// The frame of the body has its origin in the centre of mass and, in 3-D, the principal axes of
/// inertia. Per metre out of plane in 2-D.
template <int Dim>
struct MovingBody {
  Pose<Dim> pose;                                       ///< from the body's frame to the world
  Vec<Dim> velocity = zeros<Vec<Dim>>();                ///< of the centre of mass [m/s]
  Spin<Dim> momentum = zeros<Spin<Dim>>();              ///< angular, in the body's frame [kg m^2/s]
  double mass = 0;                                      ///< [kg]; 0: the body cannot move
  Spin<Dim> inertia = all_entries<spin_count<Dim>>(1);  ///< principal moments [kg m^2]
  double radius = 0;     ///< of the farthest vertex from the centre [m]
  double angle = 0;      ///< 2-D: turned so far, whole turns included [rad]
  bool is_gone = false;  ///< taken out: it touches nothing

  [[nodiscard]] bool movable() const { return mass > 0; }
  /// Angular velocity in the body's frame [rad/s].
  [[nodiscard]] Spin<Dim> spin() const { return quotients(momentum, inertia); }
  [[nodiscard]] double kinetic_energy() const {
    return 0.5 * (mass * velocity.squaredNorm() + momentum.dot(spin()));
  }
  /// No point of the body is faster [m/s].
  [[nodiscard]] double fastest_point() const {
    double linear = 0, angular = 0;
    for (int k = 0; k < Dim; ++k) linear += velocity[k] * velocity[k];
    for (int k = 0; k < spin_count<Dim>; ++k) {
      const double rate = momentum[k] / inertia[k];
      angular += rate * rate;
    }
    return std::sqrt(linear) + std::sqrt(angular) * radius;
  }
  /// A spin or moment from the world's axes to the body's, and back; in 2-D there is one.
  [[nodiscard]] Spin<Dim> to_body(const Spin<Dim>& v) const {
    if constexpr (Dim == 2)
      return v;
    else
      return transposed_product(pose.rotation, v);
  }
  [[nodiscard]] Spin<Dim> to_world(const Spin<Dim>& v) const {
    if constexpr (Dim == 2)
      return v;
    else
      return pose.rotation * v;
  }
  /// Velocity of the point that lies at `place` in the body's frame [m/s].
  [[nodiscard]] Vec<Dim> velocity_at(const Vec<Dim>& place) const {
    return velocity + pose.rotation * turned(spin(), place);
  }

  /// Moves freely for a time `step` with the present velocity and angular momentum.
  ///
  /// In 3-D the turn is composed of turns about the principal axes, 3-2-1-2-3, each with the
  /// angular momentum about it held: symmetric, hence of second order and reversible; it keeps the
  /// angular momentum in 3-D to rounding.
  ///
  /// Source: Dullweber, Leimkuhler & McLachlan (1997), J. Chem. Phys. 107, 5840-5851.
  void drift(double step) {
    pose.position += step * velocity;
    if constexpr (Dim == 2) {
      const double turn = step * momentum[0] / inertia[0];
      pose.rotation = pose.rotation * small_rotation<2>(turn);
      angle += turn * (1 - turn * turn / 12);  // 2 atan(turn / 2) but for the fifth order
    } else {
      if (is_zero(momentum)) return;
      turn_about(2, 0.5 * step);
      turn_about(1, 0.5 * step);
      turn_about(0, step);
      turn_about(1, 0.5 * step);
      turn_about(2, 0.5 * step);
    }
  }

  /// Brings the rotation back from the roundings of many products: one Newton step to orthogonal.
  void straighten() {
    const Rotation<Dim>& r = pose.rotation;
    pose.rotation = 0.5 * r * (diagonal_of<Dim>(3) - transposed_product(r, r));
  }

 private:
  void turn_about(int axis, double step) {
    const Rotation<3> turn = small_rotation<3>(step * momentum[axis] / inertia[axis], axis);
    pose.rotation = pose.rotation * turn;
    momentum = transposed_product(turn, momentum);
  }
};

/// The body of a shape of uniform density, at rest where the shape lies.
/// @param properties  of unit density
template <int Dim>
[[nodiscard]] MovingBody<Dim> moving_body(const MassProperties<Dim>& properties, double density) {
  MovingBody<Dim> body;
  body.pose.position = properties.centroid;
  body.mass = density * properties.measure;
  if constexpr (Dim == 2) {
    body.inertia[0] = density * properties.second_moment(0, 0);
  } else {
    const PrincipalAxes axes = principal_axes(properties.second_moment);
    body.inertia = density * axes.moments;
    body.pose.rotation = axes.directions;
  }
  return body;
}

}  // namespace voussoir
