// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/model/contact_group.hpp>
#include <voussoir/model/detail/lawless_contacts.hpp>
#include <voussoir/model/system.hpp>

namespace voussoir {

namespace detail {

/// Makes a system small-displacement again at the place where its bodies are.
template <class System>
class FoundAgain {
 public:
  static constexpr int dim = System::dim;

  FoundAgain(System& system, double reach)
      : system_(system),
        update_(reach, system.displacement, system.found_at(), system.law_of_cut.get()) {
    // Positions are kept near 0, whatever the site's coordinates.
    const auto near = [origin = system.body(0).centre](Pose<dim> pose) {
      pose.position -= origin;
      return pose;
    };
    for (int b = 0; b < system.body_count(); ++b)
      update_.add_body(near(system.pose_when_found(b)), near(system.pose(b)),
                       system.body(b).movable, system.body(b).is_block);
    for (int b = 0; b < static_cast<int>(system.shapes->size()); ++b) {
      if (system.body(b).is_gone) continue;
      for (const auto& part : (*system.shapes)[static_cast<std::size_t>(b)])
        update_.add_part(b, part, system.body(b).centre);
    }
  }

  void run(const Progress& progress) {
    Contacts joints = without_laws(system_.joints), boundary = without_laws(system_.boundary),
             interface = without_laws(system_.interface);
    update_.run(joints, boundary, interface, progress);
    // From here on nothing stops: the system is as it was or as it will be.
    turn_supports();
    replace(system_.joints, joints);
    replace(system_.boundary, boundary);
    replace(system_.interface, interface);
    system_.set_found();
  }

 private:
  using Contacts = LawlessContacts<dim>;

  template <class Group>
  [[nodiscard]] static Contacts without_laws(const Group& group) {
    return {group.laws().size() > 1,
            group.contacts(),
            {group.points().begin(), group.points().end()},
            {}};
  }

  template <class Group>
  static void replace(Group& group, const Contacts& by) {
    Group next(group.laws());
    std::vector<typename Group::Point> points;
    for (const int n : order_by_bodies(
             by.contacts, [](const auto& c) { return std::pair<int, int>(c.a, c.b); })) {
      const ReferenceContact<dim>& c = by.contacts[static_cast<std::size_t>(n)];
      points.clear();
      for (auto k = static_cast<std::size_t>(c.first); k < static_cast<std::size_t>(c.last); ++k) {
        points.push_back({by.points[k], {}});
        const int former = by.former[k].number;
        if (former >= 0)
          points.back().state = group.points()[static_cast<std::size_t>(former)].state;
      }
      next.add(c, points);
    }
    group = std::move(next);
  }

  void turn_supports() const {
    std::vector<Pose<dim>> then, now;
    for (int b = 0; b < system_.body_count(); ++b) {
      then.push_back(update_.then(b));
      now.push_back(update_.now(b));
    }
    const double* found_at = system_.has_found_again() ? system_.found_at().data() : nullptr;
    for (const auto& support : system_.supports)
      support->set_reference(then, now, found_at, system_.displacement.data());
  }

  System& system_;
  ContactUpdate<dim> update_;
};

}  // namespace detail

/// Finds the contacts of a system again where its bodies are now, history carried over, and turns
/// supports with them: displacements from here on are small against this state.
///
/// A lining keeps its contacts with the rock, which turn with it; blocks that leave their place do
/// not find it elsewhere.
///
/// @param reach     contacts may be so far open [m]
/// @param progress  asked now and then whether to go on
/// @throws InvalidInput  the system does not know the shapes of its bodies
/// @throws Stopped       the system is as it was
/// @cost   about 3 microseconds a contact
template <class System>
void find_contacts_again(System& system, double reach, const Progress& progress = {}) {
  if (system.shapes == nullptr)
    throw InvalidInput("find_contacts_again: the system does not know the shapes of its bodies");
  detail::FoundAgain<System>(system, reach).run(progress);
}

}  // namespace voussoir
