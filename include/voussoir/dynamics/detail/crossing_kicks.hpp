// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/dynamics/kick.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contact.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir::detail {

/// Energy that a step makes with a part v of a force R more in its second half kick: where forces
/// are not linear within a step, velocity Verlet does not keep energy.
///
/// It does the work of the mean of the forces R0 and R1 at both ends, and makes
/// D = h (R0 + R1) V / 2 + U1 - U0, U what springs store, V the velocity at the middle of the step
/// h. With all forces K it keeps E - h^2/8 K M^-1 K. By the part v of R this grows by
///
///   h^2/8 R M^-1 R v^2 + (h/2 R V + h^2/4 R M^-1 K1) v + D
struct EnergyOfPart {
  double square, linear, made;

  [[nodiscard]] double at(double part) const { return (square * part + linear) * part + made; }
  /// The part, -1 to 1, of which none is made, or near to it.
  [[nodiscard]] double zero() const {
    if (linear == 0) return 0;
    const double root = std::sqrt(std::max(0.0, linear * linear - 4 * square * made));
    return std::clamp(-2 * made / (linear + std::copysign(root, linear)), -1.0, 1.0);
  }
};

/// What contacts whose pressed part has changed within a step do to bodies in its second half kick,
/// beside their reactions, for the step to keep energy. Two faces that meet flat are open at one
/// end of a step and pressed at the other: the mean of both forces is then wrong by up to a quarter
/// of the energy of an impact that takes three steps.
template <int Dim>
class CrossingKicks {
 public:
  using Entry = typename StepCrossings<Dim>::Entry;
  using Bodies = std::vector<MovingBody<Dim>>;

  void resize(std::size_t bodies) { more_.assign(bodies, Load<Dim>{}); }
  /// Forgets those of the step before.
  void clear() {
    for (const std::size_t b : touched_) more_[b] = {};
    touched_.clear();
  }
  /// Adds what a contact needs, those before it given.
  /// @param acting  what acts on each body at the end of the step
  void add(const Entry& entry, double step, const Bodies& bodies,
           const std::vector<Kick<Dim>>& acting) {
    const double half = 0.5 * step;
    const double made = half * (entry.power[0] + entry.power[1]) + entry.gained;
    // R is the sum of both forces or their difference: what does more work, or else the other.
    Reaction<Dim> best;
    double left = std::abs(made);
    const double first = entry.power[0] * entry.power[1] < 0 ? -1 : 1;
    for (const double sign : {first, -first}) {
      Reaction<Dim> r;
      r.force = entry.of[0].force + sign * entry.of[1].force;
      for (int k = 0; k < 2; ++k)
        r.moment[k] = entry.of[0].moment[k] + sign * entry.of[1].moment[k];
      EnergyOfPart energy{0, half * (entry.power[0] + sign * entry.power[1]), made};
      for (int k = 0; k < 2; ++k) {
        const auto b = static_cast<std::size_t>(k == 0 ? entry.a : entry.b);
        const MovingBody<Dim>& body = bodies[b];
        if (!body.movable()) continue;
        const Vec<Dim> force = k == 0 ? Vec<Dim>(-r.force) : r.force;
        const Spin<Dim> torque = body.to_body(r.moment[k]);
        energy.square +=
            0.5 * half * half *
            (force.squaredNorm() / body.mass + torque.dot(quotients(torque, body.inertia)));
        energy.linear +=
            half * half *
            (force.dot(acting[b].acceleration() + more_[b].force / body.mass) +
             torque.dot(quotients(Spin<Dim>(acting[b].torque() + body.to_body(more_[b].moment)),
                                  body.inertia)));
      }
      const double part = energy.zero(), made_now = std::abs(energy.at(part));
      if (!(made_now < left)) continue;
      left = made_now;
      best = r;
      best.force *= part;
      for (Spin<Dim>& of_body : best.moment) of_body = part * of_body;
      if (left <= 1e-9 * std::abs(made)) break;
    }
    if (!(left < std::abs(made))) return;
    for (int k = 0; k < 2; ++k) {
      const auto b = static_cast<std::size_t>(k == 0 ? entry.a : entry.b);
      touched_.push_back(b);
      more_[b].force += k == 0 ? Vec<Dim>(-best.force) : best.force;
      more_[b].moment += best.moment[k];
    }
  }
  /// Half a step of velocity of a body that can move.
  void kick(MovingBody<Dim>& body, std::size_t b, double step) const {
    body.velocity += 0.5 * step / body.mass * more_[b].force;
    body.momentum += 0.5 * step * body.to_body(more_[b].moment);
  }

 private:
  std::vector<Load<Dim>> more_;
  std::vector<std::size_t> touched_;
};

}  // namespace voussoir::detail
