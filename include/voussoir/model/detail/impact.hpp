// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contacts.hpp>

namespace voussoir::detail {

/// Length or area of the points of a contact together [m], [m^2].
template <class Points>
[[nodiscard]] double area_of(const Points& points) {
  double sum = 0;
  for (const auto& p : points) sum += p.weight;
  return sum;
}

/// The impact of two bodies at a contact, along its normal in the middle of its points.
template <int Dim>
struct Impact {
  double mass;   ///< of both against each other, turning included: 1 / m = sum of n . M^-1 n [kg]
  double speed;  ///< at which they come nearer [m/s]

  /// @pre  at least one point, and a body that moves
  template <class Points>
  [[nodiscard]] static Impact at(const MovingContact<Dim>& contact, const Points& points,
                                 const std::vector<MovingBody<Dim>>& bodies) {
    const MovingBody<Dim>&a = bodies[static_cast<std::size_t>(contact.a)],
          &b = bodies[static_cast<std::size_t>(contact.b)];
    const Vec<Dim> normal = a.pose.rotation * column(contact.frame, 0);
    Vec<Dim> middle = zeros<Vec<Dim>>();
    double weight = 0;
    for (const auto& p : points) {
      middle += p.weight * (b.pose.rotation * p.place);  // from the centre of b
      weight += p.weight;
    }
    middle /= weight;
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
