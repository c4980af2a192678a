// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/contact_outline.hpp>

namespace voussoir {

/// What a contact does to its two bodies at one instant.
template <int Dim>
struct Reaction {
  Vec<Dim> force;       ///< on b; a gets the opposite [N]
  Spin<Dim> moment[2];  ///< on a and on b, about their centres, world axes [N m]
};

/// Contacts whose pressed part has changed within a step: velocity Verlet does not keep their
/// energy
/// (`detail::CrossingKicks`).
template <int Dim>
struct StepCrossings {
  struct Entry {
    std::int32_t a, b;    ///< bodies
    Reaction<Dim> of[2];  ///< normal forces at both ends of the step
    double power[2];      ///< of these, with the velocities of the step [W]
    double gained;        ///< by the normal springs in the step [J]
  };
  double step = 0;             ///< at whose velocities the bodies came where they are [s]
  std::vector<Entry> entries;  ///< in the order of contacts
};

/// What contacts turn into heat.
struct Dissipation {
  double friction = 0;   ///< slip and damage, as the law says [J]
  double viscosity = 0;  ///< dashpots, per time [W]
};

/// A contact between bodies that move and turn by any amount.
template <int Dim>
struct MovingContact {
  Rotation<Dim> frame;       ///< columns: normal from a to b, tangents; in the frame of body a
  std::int32_t a, b;         ///< bodies; a owns the face
  std::int32_t first, last;  ///< points
  std::int32_t law = 0;      ///< index into the laws of the group
  bool is_centred = false;   ///< touches in the middle alone: a lining that was installed at rest
  double viscosity = 0;      ///< damping force over (stiffness times velocity) [s]
  double uncounted = 0;      ///< of the overlap, that presses on no spring (`limit_energy`) [m]
  double least_area = 0;     ///< its points' together, since the impact (`Impact`) [m], [m^2]
  [[no_unique_address]] detail::KeptOutline<Dim> outline;

  /// Where its frame is with its bodies at these poses, and what follows from that.
  struct Place {
    Rotation<Dim> frame_b;  ///< columns: normal and tangents in the frame of b
    Vec<Dim> base;          ///< centre of b less centre of a, in the contact's frame
  };
  [[nodiscard]] Place place(const Pose<Dim>& at_a, const Pose<Dim>& at_b) const {
    const Rotation<Dim> now = at_a.rotation * frame;
    return {transposed_product(at_b.rotation, now),
            transposed_product(now, Vec<Dim>(at_b.position - at_a.position))};
  }
};

namespace detail {

/// What a point remembers of its slip, besides its law: in 2-D alone (`press_in_motion`).
template <int Dim>
struct CommittedSlip {
  void commit(const Vec<Dim - 1>&) {}
};
template <>
struct CommittedSlip<2> {
  double slip = 0;  ///< at the last commit, as the law has it [m]

  void commit(const Vec<1>& now) { slip = now[0]; }
};

}  // namespace detail

/// A point of a contact, fixed in body b.
/// @tparam State  what the contact law remembers of it, or where that lies
template <int Dim, class State>
struct MovingContactPoint {
  Vec<Dim> place;  ///< in the frame of body b [m]
  Vec<Dim> zero;   ///< coordinates in the contact's frame at which opening and slip are zero [m]
  double weight;   ///< length or area [m], [m^2]
  PointForce<Dim> initial;
  [[no_unique_address]] State state;
  [[no_unique_address]] detail::CommittedSlip<Dim> committed;

  [[nodiscard]] PointMotion<Dim> motion(const typename MovingContact<Dim>::Place& at) const {
    const Vec<Dim> m = at.base + transposed_product(at.frame_b, place) - zero;
    return {m[0], part<Dim - 1>(m, 1)};
  }
  [[nodiscard]] PointLoad<Dim> load(const typename MovingContact<Dim>::Place& at) const {
    return {weight, initial, motion(at)};
  }
};

}  // namespace voussoir
