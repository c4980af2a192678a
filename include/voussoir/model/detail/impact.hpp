// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contact.hpp>

namespace voussoir::detail {

/// Length or area of the points of a contact together [m], [m^2].
template <class Points>
[[nodiscard]] double area_of(const Points& points) {
  double sum = 0;
  for (const auto& p : points) sum += p.weight;
  return sum;
}

/// The dashpot of a joint of which a part is pressed, over that of the same weight in a closed one.
///
/// An edge that is driven in by d is pressed over a width in proportion to d: its force goes with
/// d^2, and a dashpot of zeta sqrt(2 (n + 1) / n) times the root of mass and tangent stiffness
/// damps a force that goes with d^n as the one of 2 zeta does a spring. (In 3-D a corner has n = 3;
/// its factor is 6 % less.)
template <int Dim>
[[nodiscard]] double dashpot_of_part(const PointLoad<Dim>& load) {
  constexpr double of_edge = 0.8660254037844386;  // sqrt(3) / 2, for n = 2
  if (load.whole_over_part == 1) return 1;
  return std::sqrt(load.whole_over_part) * (of_edge + (1 - of_edge) / load.whole_over_part);
}

/// The impact of two bodies at a contact, along its normal, at the place where they meet.
template <int Dim>
struct Impact {
  double mass;   ///< of both against each other, turning included: 1 / m = sum of n . M^-1 n [kg]
  double speed;  ///< at which they come nearer [m/s]

  /// @param middle  where they meet, from the centre of body b, world axes [m]
  /// @pre  a body moves
  [[nodiscard]] static Impact at(const MovingContact<Dim>& contact, const Vec<Dim>& middle,
                                 const std::vector<MovingBody<Dim>>& bodies) {
    const MovingBody<Dim>&a = bodies[static_cast<std::size_t>(contact.a)],
          &b = bodies[static_cast<std::size_t>(contact.b)];
    const Vec<Dim> normal = a.pose.rotation * column(contact.frame, 0);
    double inverse = 0, speed = 0;
    const auto add = [&](const MovingBody<Dim>& body, const Vec<Dim>& arm, double sign) {
      if (!body.movable()) return;
      const Spin<Dim> lever = body.to_body(moment_of(arm, normal));
      inverse += 1 / body.mass + lever.dot(quotients(lever, body.inertia));
      speed += sign * (normal.dot(body.velocity) + lever.dot(body.spin()));
    };
    add(a, middle + b.pose.position - a.pose.position, 1);
    add(b, middle, -1);
    return {1 / inverse, std::max(0.0, speed)};
  }

  /// The least area (2-D: length) on which the bodies are stopped within the area's own width
  /// [m^2], [m]: a sharper corner crushes until it is as wide as it has been driven in.
  ///
  /// The depth is v sqrt(m / (k_n A)) = A^(1 / (Dim - 1)).
  [[nodiscard]] double least_area(double joint_normal_stiffness) const {
    const double square = speed * speed * mass / joint_normal_stiffness;
    return Dim == 2 ? elementary::cube_root(square) : std::sqrt(square);
  }
  /// Dashpot over stiffness of a contact that damps the impact with a ratio to critical:
  /// c / k = 2 zeta sqrt(m / k) [s].
  /// @param normal_stiffness  k, of the whole contact [N/m]
  [[nodiscard]] double viscosity(double ratio, double normal_stiffness) const {
    return 2 * ratio * std::sqrt(mass / normal_stiffness);
  }
};

/// Gives the points of an impact on less than the contact's least area what is missing; none with
/// in-situ stress.
template <int Dim, class Points>
void widen(const MovingContact<Dim>& contact, Points& points) {
  const double area = area_of(points);
  if (!(area < contact.least_area)) return;
  for (const auto& p : points)
    if (p.initial.normal != 0) return;
  for (auto& p : points) p.weight *= contact.least_area / area;
}

}  // namespace voussoir::detail
