// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/contact_group.hpp>
#include <voussoir/model/detail/contact_frames.hpp>
#include <voussoir/model/detail/former_contacts.hpp>
#include <voussoir/model/reference_contact.hpp>

// A model at rest is told by the axes of its reference configuration. To find its contacts where
// bodies are now, to update them or to set it in motion, it is told by the frames of its bodies,
// and afterwards by the axes of the configuration in which these are then.
namespace voussoir::detail {

/// The contacts of a model by the frames of its bodies: joints, edges of the domain, linings.
/// @param frames  of all bodies: where they are in the reference configuration
template <class System>
[[nodiscard]] std::array<FormerContacts<System::dim>, 3> contacts_by_frames(
    const System& system, const std::vector<Pose<System::dim>>& frames) {
  const double* u = system.has_updated_contacts() ? system.updated_at().data() : nullptr;
  using Former = FormerContacts<System::dim>;
  return {Former(system.joints, frames, u), Former(system.boundary, frames, u),
          Former(system.interface, frames, u)};
}

/// Supports the same way. Those given are changed.
template <class System, class Supports>
void to_frames(const System& system, const std::vector<Pose<System::dim>>& frames,
               const Supports& supports) {
  const double* u = system.has_updated_contacts() ? system.updated_at().data() : nullptr;
  for (const auto& support : supports) support->to_frames(frames, u);
}

/// Replaces the contacts of a group by those of bodies in these frames, in the order of the bodies.
/// Contacts without points are left out.
/// @param moving  `MovingContacts` or `FormerContacts`
/// @param u       displacement of all bodies, from the in-situ state
template <class Group, class Moving>
void take_contacts(const Moving& moving, const std::vector<Pose<Group::dim>>& frames,
                   const Eigen::VectorXd& u, Group& group) {
  using Point = typename Group::Point;
  const auto at = [](auto i) { return static_cast<std::size_t>(i); };
  Group next(group.laws());
  std::vector<Point> points;
  std::vector<Vec<Group::dim>> shear_at;
  for (const int n : order_by_bodies(moving.contacts(),
                                     [](const auto& c) { return std::pair<int, int>(c.a, c.b); })) {
    const auto& c = moving.contacts()[at(n)];
    if (c.first == c.last) continue;
    points.clear();
    shear_at.clear();
    const Pose<Group::dim>&a = frames[at(c.a)], &b = frames[at(c.b)];
    if constexpr (Group::dim == 2 && requires { moving.laws(); })
      moving.visit_loads(
          c, moving.points_of(c), c.place(a, b),
          [&](std::size_t, const auto& p, const auto&) { shear_at.push_back(p.place); });
    const auto contact = from_frames(c, a, b, u.data(), moving.points_of(c), shear_at,
                                     [&](const ReferencePoint<Group::dim>& p) {
                                       points.push_back({p, {}});
                                     });
    for (std::size_t k = 0; k < points.size(); ++k)
      points[k].state = moving.state_of(at(c.first) + k);
    next.add(contact, points, c.uncounted);
  }
  group = std::move(next);
}

/// Makes the configuration in which bodies are now the one from which a model's displacements are
/// small: with contacts that have been found there, and supports that are told by frames.
/// @param contacts  joints, edges, linings
/// @param frames    of all bodies
/// @param turned    how they lie there
template <class System, class Joints, class Edges, class Interface>
void take_from_frames(System& system, const Joints& joints, const Edges& edges,
                      const Interface& interface, const std::vector<Pose<System::dim>>& frames,
                      std::vector<Rotation<System::dim>> turned) {
  take_contacts(joints, frames, system.displacement, system.joints);
  take_contacts(edges, frames, system.displacement, system.boundary);
  take_contacts(interface, frames, system.displacement, system.interface);
  for (const auto& support : system.supports)
    support->from_frames(frames, system.displacement.data());
  system.set_updated(system.displacement, std::move(turned));
}

}  // namespace voussoir::detail
