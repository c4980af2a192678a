// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/model/contact_group.hpp>
#include <voussoir/model/contact_update_report.hpp>
#include <voussoir/model/detail/kept_shear.hpp>
#include <voussoir/model/detail/lawless_contacts.hpp>
#include <voussoir/model/system.hpp>

namespace voussoir {

namespace detail {

/// Makes a system small-displacement again at the place where its bodies are.
template <class System>
class SystemUpdate {
 public:
  static constexpr int dim = System::dim;

  SystemUpdate(System& system, double reach)
      : system_(system),
        update_(reach, system.displacement, system.updated_at(), system.law_of_cut.get()) {
    // Positions are kept near 0, whatever the site's coordinates.
    const auto near = [origin = system.body(0).centre](Pose<dim> pose) {
      pose.position -= origin;
      return pose;
    };
    for (int b = 0; b < system.body_count(); ++b)
      update_.add_body(near(system.pose_at_update(b)), near(system.pose(b)), system.body(b).movable,
                       system.body(b).is_block);
    for (int b = 0; b < static_cast<int>(system.shapes->size()); ++b) {
      if (system.body(b).is_gone) continue;
      for (const auto& part : (*system.shapes)[static_cast<std::size_t>(b)])
        update_.add_part(b, part, system.body(b).centre);
    }
  }

  ContactUpdateReport run(const Progress& progress) {
    Contacts joints = without_laws(system_.joints), boundary = without_laws(system_.boundary),
             interface = without_laws(system_.interface);
    update_.run(joints, boundary, interface, progress);
    // From here on nothing stops: the system is as it was or as it will be.
    Eigen::VectorXd before, after;
    system_.forces(system_.displacement, before);
    ContactUpdateReport report{1, -stored_energy(), 0};
    turn_supports();
    replace(system_.joints, joints);
    replace(system_.boundary, boundary);
    replace(system_.interface, interface);
    system_.set_updated();
    report.energy += stored_energy();
    system_.forces(system_.displacement, after);
    report.largest_jump = system_.unbalance_over_weight(after - before);
    return report;
  }

 private:
  using Contacts = LawlessContacts<dim>;

  template <class Group>
  [[nodiscard]] static Contacts without_laws(const Group& group) {
    Contacts contacts{group.laws().size() > 1, group.contacts(), {}, {}};
    contacts.points.reserve(group.points().size());
    for (const auto& p : group.points()) contacts.points.push_back(p);
    return contacts;
  }

  /// Of all contacts, as they are now [J].
  [[nodiscard]] double stored_energy() const {
    double sum = 0;
    const auto add = [&](const auto& group) {
      group.visit(system_.displacement.data(),
                  [&](const auto& c, const auto& p, const auto& load, const auto&) {
                    sum += group.law_of(c).stored_energy(load, p.state);
                  });
    };
    add(system_.joints);
    add(system_.boundary);
    add(system_.interface);
    return sum;
  }

  template <class Group>
  void replace(Group& group, const Contacts& by) const {
    Group next(group.laws());
    std::vector<typename Group::Point> points;
    points.reserve(by.points.size());
    for (std::size_t k = 0; k < by.points.size(); ++k) {
      points.push_back({by.points[k], {}});
      const int former = by.former[k].number;
      if (former >= 0) points[k].state = group.points()[static_cast<std::size_t>(former)].state;
    }
    keep_shear(group, by, points);
    for (const int n : order_by_bodies(
             by.contacts, [](const auto& c) { return std::pair<int, int>(c.a, c.b); })) {
      const ReferenceContact<dim>& c = by.contacts[static_cast<std::size_t>(n)];
      next.add(c, points_of<typename Group::Point>(points, c));
    }
    group = std::move(next);
  }

  template <class Point>
  [[nodiscard]] static std::span<const Point> points_of(const std::vector<Point>& points,
                                                        const ReferenceContact<dim>& c) {
    return {points.data() + c.first, c.count};
  }

  /// Gives the points that carry on those of a contact the shear force that it had; one contact may
  /// have become several.
  template <class Group>
  void keep_shear(const Group& group, const Contacts& by,
                  std::vector<typename Group::Point>& points) const {
    using Point = typename Group::Point;
    using Shear = Vec<dim - 1>;
    const auto shear_of = [&](const ReferenceContact<dim>& c, std::span<const Point> of) {
      return group.shear_of(c, of, system_.displacement.data());
    };
    std::vector<int> contact_of(group.points().size(), -1);
    for (std::size_t n = 0; n < group.contacts().size(); ++n)
      for (int k = group.contacts()[n].first; k < group.contacts()[n].last(); ++k)
        contact_of[static_cast<std::size_t>(k)] = static_cast<int>(n);
    std::vector<std::vector<int>> heirs(group.contacts().size());
    for (std::size_t n = 0; n < by.contacts.size(); ++n) {
      const int former = by.former[static_cast<std::size_t>(by.contacts[n].first)].number;
      if (former >= 0)
        heirs[static_cast<std::size_t>(contact_of[static_cast<std::size_t>(former)])].push_back(
            static_cast<int>(n));
    }
    std::vector<Point> together;
    for (std::size_t n = 0; n < heirs.size(); ++n) {
      if (heirs[n].empty()) continue;
      const auto each = [&](auto&& visit) {
        std::size_t first = 0;
        for (const int heir : heirs[n]) {
          const ReferenceContact<dim>& c = by.contacts[static_cast<std::size_t>(heir)];
          const std::size_t count = c.count;
          visit(c, first, count);
          first += count;
        }
      };
      together.clear();
      each([&](const auto& c, std::size_t, std::size_t) {
        const auto of = points_of(points, c);
        together.insert(together.end(), of.begin(), of.end());
      });
      const ReferenceContact<dim>& old = group.contacts()[n];
      match_shear<dim>(shear_of(old, group.points_of(old)), together, [&] {
        Shear sum = zeros<Shear>();
        each([&](const auto& c, std::size_t first, std::size_t count) {
          sum += shear_of(c, {together.data() + first, count});
        });
        return sum;
      });
      each([&](const auto& c, std::size_t first, std::size_t count) {
        std::copy_n(together.begin() + static_cast<std::ptrdiff_t>(first), count,
                    points.begin() + c.first);
      });
    }
  }

  void turn_supports() const {
    std::vector<Pose<dim>> then, now;
    for (int b = 0; b < system_.body_count(); ++b) {
      then.push_back(update_.then(b));
      now.push_back(update_.now(b));
    }
    const double* updated_at =
        system_.has_updated_contacts() ? system_.updated_at().data() : nullptr;
    for (const auto& support : system_.supports) {
      support->to_frames(then, updated_at);
      support->from_frames(now, system_.displacement.data());
    }
  }

  System& system_;
  ContactUpdate<dim, typename System::Detector> update_;
};

}  // namespace detail

/// Updates the contacts of a system to where its bodies are now, history carried over, and turns
/// supports with them: displacements from here on are small against this state.
///
/// A lining keeps its contacts with the rock, which turn with it; blocks that leave their place do
/// not find it elsewhere.
///
/// @param reach     contacts may be so far open [m]
/// @param progress  asked now and then whether to go on
/// @return  the energy that springs have gained by it, and the jump of the forces on bodies
/// @throws InvalidInput  the system does not know the shapes of its bodies
/// @throws Stopped       the system is as it was
/// @cost   about 3 microseconds a contact
template <class System>
ContactUpdateReport update_contacts(System& system, double reach, const Progress& progress = {}) {
  if (system.shapes == nullptr)
    throw InvalidInput("update_contacts: the system does not know the shapes of its bodies");
  return detail::SystemUpdate<System>(system, reach).run(progress);
}

}  // namespace voussoir
