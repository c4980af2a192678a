// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/vec.hpp>
#include <voussoir/dynamics/energy_balance.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contacts.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir::detail {

/// Work done on bodies in some steps [J].
struct StepWork {
  double gravity = 0;
  double loads = 0;
  double damping = 0;  ///< taken away by local damping
};

/// What one member of a team has summed up in some steps; apart in memory from the others.
template <int Dim>
struct alignas(64) MemberSums {
  Dissipation lost;              ///< `viscosity` only within a step
  StepCrossings<Dim> crossings;  ///< of the present step
  double viscosity = 0;          ///< [J]
  StepWork work;
  double fastest = 0;  ///< no point of its bodies is faster in the present step [m/s]

  void add_to(EnergyBalance& audit) const {
    audit.friction += lost.friction;
    audit.viscosity += viscosity;
    audit.gravity += work.gravity;
    audit.loads += work.loads;
    audit.damping += work.damping;
  }
};

/// What acts on a body, kept between the two half kicks of a step, and what they do.
template <int Dim>
class Kick {
 public:
  /// Takes what acts on a body at its present place.
  /// @param total          all forces but local damping, world axes
  /// @param local_damping  alpha [-]; opposes the motion of every unknown with alpha |f|
  void set(const MovingBody<Dim>& body, Load<Dim> total, double local_damping) {
    torque_ = body.to_body(total.moment);
    if (local_damping > 0) {
      damping_ = opposed(total.force, body.velocity, local_damping);
      damping_torque_ = opposed(torque_, body.momentum, local_damping);
      total.force += damping_;
      torque_ += damping_torque_;
    }
    acceleration_ = total.force / body.mass;
  }

  /// No point of the body gets faster at a higher rate, from what acts on it now [m/s^2].
  [[nodiscard]] double fastest_gain(const MovingBody<Dim>& body) const {
    return acceleration_.norm() + quotients(torque_, body.inertia).norm() * body.radius;
  }
  /// K M^-1 K: h^2/8 of it is by how much the kinetic energy at the end of a step h is above that
  /// of the velocities half a step before and after, v- M v+ / 2, which velocity Verlet keeps
  /// [J/s^2].
  [[nodiscard]] double kinetic_rate(const MovingBody<Dim>& body) const {
    return body.mass * acceleration_.squaredNorm() + torque_.dot(quotients(torque_, body.inertia));
  }
  [[nodiscard]] const Vec<Dim>& acceleration() const { return acceleration_; }  ///< [m/s^2]
  [[nodiscard]] const Spin<Dim>& torque() const { return torque_; }  ///< frame of the body [N m]
  /// Half a step of velocity.
  void kick(MovingBody<Dim>& body, double step) const {
    body.velocity += 0.5 * step * acceleration_;
    body.momentum += 0.5 * step * torque_;
  }

  /// Adds the work of the present forces over half the way of this step, with the velocity at its
  /// middle: of both halves together it is that of the mean force.
  /// @param load  other than weight, contacts and supports, world axes
  void add_work(const MovingBody<Dim>& body, double step, double gravity, const Load<Dim>& load,
                StepWork& work) const {
    const Vec<Dim> way = 0.5 * step * body.velocity;
    work.gravity -= body.mass * gravity * way[Dim - 1];
    work.loads += load.force.dot(way);
    const bool turns = !is_zero(load.moment) || !is_zero(damping_torque_);
    if (turns) {
      const Spin<Dim> turn = 0.5 * step * body.spin();
      work.loads += body.to_body(load.moment).dot(turn);
      work.damping -= damping_torque_.dot(turn);
    }
    work.damping -= damping_.dot(way);
  }

 private:
  template <class V>
  [[nodiscard]] static V opposed(const V& force, const V& velocity, double local_damping) {
    V damping = zeros<V>();
    for (Eigen::Index k = 0; k < force.size(); ++k)
      if (velocity[k] != 0)
        damping[k] = -local_damping * std::copysign(std::abs(force[k]), velocity[k]);
    return damping;
  }

  Vec<Dim> acceleration_ = zeros<Vec<Dim>>();  ///< [m/s^2]
  Spin<Dim> torque_ = zeros<Spin<Dim>>();      ///< frame of the body [N m]
  Vec<Dim> damping_ = zeros<Vec<Dim>>();       ///< local damping, part of the above [N]
  Spin<Dim> damping_torque_ = zeros<Spin<Dim>>();
};

}  // namespace voussoir::detail
