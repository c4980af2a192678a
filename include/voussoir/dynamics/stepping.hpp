// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/thread_team.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/dynamics/detail/crossing_kicks.hpp>
#include <voussoir/dynamics/energy_balance.hpp>
#include <voussoir/dynamics/kick.hpp>
#include <voussoir/dynamics/moving_part.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contacts.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir::detail {

/// Force and moment out of balance over the weight [-]; a moment counts as a force at the radius. 0
/// for a body that cannot move or has no shape.
template <int Dim>
[[nodiscard]] double unbalance_of(const MovingBody<Dim>& body, const Load<Dim>& out_of_balance,
                                  double gravity) {
  if (!body.movable() || body.radius == 0) return 0;
  return (out_of_balance.force.norm() + out_of_balance.moment.norm() / body.radius) /
         (body.mass * gravity);
}

/// The bodies of a run and all that acts on them; nothing is owned.
template <int Dim, class Network>
struct ForcesOnBodies {
  std::vector<MovingBody<Dim>>& bodies;
  Network& network;
  SupportSet<Dim>& supports;
  const std::vector<Load<Dim>>& loads;  ///< given to each body
  const std::vector<Load<Dim>>& held;   ///< what would keep each body in equilibrium
  double held_fraction;                 ///< of it, that acts [-]
  double gravity;                       ///< [m/s^2], against the last axis
  double local_damping;                 ///< alpha [-]
  const MovingPart& part;               ///< who moves

  /// What acts besides weight, contacts and supports, world axes.
  [[nodiscard]] Load<Dim> applied(std::size_t b) const {
    return {loads[b].force + held_fraction * held[b].force,
            loads[b].moment + held_fraction * held[b].moment};
  }
  /// All that acts on a body but local damping, world axes. @pre contacts and supports are up to
  /// date
  [[nodiscard]] Load<Dim> total(std::size_t b) const {
    auto [force, moment] = network.gather(b);
    const Load<Dim> given = applied(b);
    force += given.force;
    force[Dim - 1] -= bodies[b].mass * gravity;
    moment += given.moment;
    supports.add_load_on(b, force, moment);
    return {force, moment};
  }
  [[nodiscard]] double unbalance_of(std::size_t b) const {
    return detail::unbalance_of(bodies[b], total(b), gravity);
  }
  /// The same of the worst block [-].
  [[nodiscard]] double unbalance_over_weight() const {
    double worst = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) worst = std::max(worst, unbalance_of(b));
    return worst;
  }
};

/// Steps of velocity Verlet, shared by a team of threads: kick, drift, forces at the new place,
/// kick.
///
/// Contacts are computed first and then summed body by body in a fixed order: the result does not
/// depend on the number of threads, to the last bit.
template <int Dim, class Network>
class Stepping {
 public:
  using Forces = ForcesOnBodies<Dim, Network>;

  explicit Stepping(unsigned threads)
      : team_(std::make_unique<ThreadTeam>(threads)), alone_(std::make_unique<ThreadTeam>(1)) {}

  void resize(std::size_t bodies) {
    acting_.resize(bodies);
    crossing_kicks_.resize(bodies);
  }
  /// What acts on each body, when it was last computed.
  [[nodiscard]] const std::vector<Kick<Dim>>& acting() const { return acting_; }

  /// Brings what acts on the bodies up to date, with nothing moving.
  /// @return  what contacts lose by that: of bodies that were moved by hand
  Dissipation freshen(const Forces& forces) {
    ThreadTeam& team = team_for(forces);
    sums_.assign(team.size(), {});
    team.run([&](unsigned member) {
      respond(forces, team, member, sums_[member].lost, nullptr);
      forces.part.each_body(team, member, forces.bodies.size(),
                            [&](std::size_t b) { settle(forces, b); });
    });
    Dissipation lost;
    for (const MemberSums<Dim>& of_member : sums_) lost.friction += of_member.lost.friction;
    return lost;
  }

  /// The same where contacts and supports do what they did.
  void settle(const Forces& forces) {
    forces.part.each_body(forces.bodies.size(), [&](std::size_t b) { settle(forces, b); });
  }

  /// How far bodies may move, by the speeds of the fastest summed up step by step, before contacts
  /// must be looked for again [m].
  struct Ways {
    double travel;  ///< with one more step like the last
    double reach;   ///< with one and a half: in the next step bodies may be faster, and a pair that
                    ///< was apart must not come to touch
  };
  /// Makes `count` steps, or fewer where a body comes as far as `ways`; at least one.
  /// @param step  [s]
  /// @pre   what acts on the bodies is up to date, and is again afterwards
  /// @return  the number of steps made; what they did to the energy is added to `audit`
  int run(const Forces& forces, int count, double step, const Ways& ways, EnergyBalance& audit);

 private:
  /// A member's share of what contacts and supports do to the bodies where they are; all of it is
  /// done when it returns.
  void respond(const Forces& forces, ThreadTeam& team, unsigned member, Dissipation& lost,
               StepCrossings<Dim>* crossings) {
    const MovingPart& part = forces.part;
    if (part.is_all) {
      const auto contacts = team.share(forces.network.size(), member);
      forces.network.react(contacts.first, contacts.last, forces.bodies, lost, crossings);
    } else {
      const auto share = team.share(part.contacts.size(), member);
      forces.network.react(std::span(part.contacts).subspan(share.first, share.last - share.first),
                           forces.bodies, lost, crossings);
    }
    if (member == 0) forces.supports.act(forces.bodies);
    team.meet();
  }
  /// First half kick, and the drift.
  void start(const Forces& forces, std::size_t b, double step, MemberSums<Dim>& sums) {
    MovingBody<Dim>& body = forces.bodies[b];
    acting_[b].kick(body, step);
    acting_[b].add_work(body, step, forces.gravity, forces.applied(b), sums.work);
    body.drift(step);
    sums.fastest = std::max(sums.fastest, body.fastest_point());
  }
  /// Forces at the new place.
  void settle(const Forces& forces, std::size_t b) {
    const MovingBody<Dim>& body = forces.bodies[b];
    if (body.movable()) acting_[b].set(body, forces.total(b), forces.local_damping);
  }
  /// Second half kick.
  void finish(const Forces& forces, std::size_t b, double step, MemberSums<Dim>& sums) {
    MovingBody<Dim>& body = forces.bodies[b];
    acting_[b].add_work(body, step, forces.gravity, forces.applied(b), sums.work);
    acting_[b].kick(body, step);
  }

  /// What contacts whose pressed part has changed in this step need to keep energy: the same for
  /// any number of members.
  /// @pre what acts on the bodies is up to date for this member's
  /// @return  whether any does
  bool meet_crossings(const Forces& forces, ThreadTeam& team, unsigned member, double step) {
    const bool any = std::any_of(sums_.begin(), sums_.end(), [](const MemberSums<Dim>& of_member) {
      return !of_member.crossings.entries.empty();
    });
    if (!any) return false;
    team.meet();
    if (member == 0) {
      crossing_kicks_.clear();
      for (const MemberSums<Dim>& of_member : sums_)
        for (const auto& entry : of_member.crossings.entries)
          crossing_kicks_.add(entry, step, forces.bodies, acting_);
    }
    team.meet();
    return true;
  }

  /// Where few bodies move, a step is over before the members of a team have met.
  [[nodiscard]] ThreadTeam& team_for(const Forces& forces) {
    constexpr std::size_t few = 300;
    return forces.part.is_all || forces.part.bodies.size() > few ? *team_ : *alone_;
  }

  std::unique_ptr<ThreadTeam> team_, alone_;
  std::vector<Kick<Dim>> acting_;
  CrossingKicks<Dim> crossing_kicks_;
  std::vector<MemberSums<Dim>> sums_;
};

template <int Dim, class Network>
int Stepping<Dim, Network>::run(const Forces& forces, int count, double step, const Ways& ways,
                                EnergyBalance& audit) {
  std::vector<MovingBody<Dim>>& bodies = forces.bodies;
  ThreadTeam& team = team_for(forces);
  sums_.assign(team.size(), {});
  // Damping takes more than contacts can make that close or open within a step.
  const bool keeps_energy = forces.local_damping == 0;
  int made = 0;
  team.run([&](unsigned member) {
    MemberSums<Dim>& sums = sums_[member];
    const auto each = [&](auto&& visit) {
      forces.part.each_body(team, member, bodies.size(), [&](std::size_t b) {
        if (bodies[b].movable()) visit(b);
      });
    };
    double way = 0;  // of the fastest body of each step: the same for all members
    for (int k = 0; k < count; ++k) {
      sums.fastest = 0;
      each([&](std::size_t b) { start(forces, b, step, sums); });
      team.meet();
      double fastest = 0;
      for (const MemberSums<Dim>& of_member : sums_) fastest = std::max(fastest, of_member.fastest);
      way += step * fastest;
      sums.crossings.step = step;
      sums.crossings.entries.clear();
      respond(forces, team, member, sums.lost, keeps_energy ? &sums.crossings : nullptr);
      sums.viscosity += step * std::exchange(sums.lost.viscosity, 0.0);
      if (keeps_energy) {
        each([&](std::size_t b) { settle(forces, b); });
        const bool any = meet_crossings(forces, team, member, step);
        each([&](std::size_t b) {
          finish(forces, b, step, sums);
          if (any) crossing_kicks_.kick(bodies[b], b, step);
        });
      } else {
        each([&](std::size_t b) {
          settle(forces, b);
          finish(forces, b, step, sums);
        });
      }
      if (member == 0) made = k + 1;
      if (way + step * fastest > ways.travel || way + 1.5 * step * fastest > ways.reach) break;
    }
    each([&](std::size_t b) { bodies[b].straighten(); });
  });
  for (const MemberSums<Dim>& sums : sums_) sums.add_to(audit);
  return made;
}

}  // namespace voussoir::detail
