// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/contact.hpp>
#include <voussoir/geometry/contact_area.hpp>
#include <voussoir/model/contact_group.hpp>
#include <voussoir/model/detail/contact_frames.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contacts.hpp>

namespace voussoir::detail {

/// The middle of a contact that has been found, counted as that is.
/// @param joined  all of it where several pairs of shapes share it, or null
template <int Dim>
[[nodiscard]] Vec<Dim> middle_of(const Contact<Dim>& found, const ContactArea<Dim>* joined) {
  if (joined != nullptr) return joined->centre();
  Vec<Dim> sum = zeros<Vec<Dim>>();
  for (const Vec<Dim>& p : found.polygon) sum += p;
  return sum / static_cast<double>(found.polygon.size());
}

/// Squared distance of a place from the middle of a contact [m^2]; infinite if its normal has
/// turned by more than 60 degrees from the one given: it is another contact then. Not from its
/// nearest point: a sliver between the points of a large contact would be taken for that.
template <int Dim, class Points>
[[nodiscard]] double squared_distance(const std::vector<MovingBody<Dim>>& bodies,
                                      const MovingContact<Dim>& c, const Points& points,
                                      const Vec<Dim>& normal, const Vec<Dim>& place) {
  constexpr double another = std::numeric_limits<double>::infinity();
  const auto index = [](auto i) { return static_cast<std::size_t>(i); };
  const Vec<Dim> was = bodies[index(c.a)].pose.rotation * column(c.frame, 0);
  if (std::abs(was.dot(normal)) < 0.5) return another;
  Vec<Dim> middle = zeros<Vec<Dim>>();
  double whole = 0;
  for (auto k = index(c.first); k < index(c.last); ++k) {
    middle += points[k].weight * points[k].place;
    whole += points[k].weight;
  }
  if (!(whole > 0)) return another;
  return (bodies[index(c.b)].pose(middle / whole) - place).squaredNorm();
}

/// The contacts of one kind that bodies had before, in their frames, to be carried on by those that
/// are found now.
///
/// What is remembered of point k is named by the number -2 - k, and lies in `states`.
template <int Dim>
class FormerContacts {
 public:
  using Contact = MovingContact<Dim>;
  using Point = MovingContactPoint<Dim, FormerPoint>;
  using Bodies = std::vector<MovingBody<Dim>>;

  FormerContacts() = default;

  /// @param frames  of all bodies: where they are in the reference configuration of the group
  /// @param u       displacement there; null: zero
  template <class Geometry>
  FormerContacts(const ContactGroup<Geometry>& group, const std::vector<Pose<Dim>>& frames,
                 const double* u)
      : states(group.points().states()) {
    contacts_.reserve(group.contacts().size());
    points_.reserve(group.points().size());
    for (std::size_t n = 0; n < group.contacts().size(); ++n) {
      const ReferenceContact<Dim>& c = group.contacts()[n];
      const Pose<Dim>&a = frames[index(c.a)], &b = frames[index(c.b)];
      Contact contact = to_frames(c, a);
      contact.uncounted = group.uncounted(n);
      const auto at = contact.place(a, b);
      contact.first = static_cast<std::int32_t>(points_.size());
      for (int k = c.first; k < c.last(); ++k)
        points_.push_back(
            to_frames<Dim>(c, group.points().place(index(k)), at, b, u, FormerPoint{-2 - k}));
      contact.last = static_cast<std::int32_t>(points_.size());
      contacts_.push_back(contact);
      bodies_.emplace_back(std::minmax(c.a, c.b));
    }
    order_ = order_of_pairs(bodies_, static_cast<int>(frames.size()));
  }

  StateColumn states;

  [[nodiscard]] const std::vector<Contact>& contacts() const { return contacts_; }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] std::span<const Point> points_of(const Contact& c) const {
    return {points_.data() + c.first, index(c.last - c.first)};
  }

  /// What is remembered of a point, if the states are here.
  [[nodiscard]] AnyState state_of(std::size_t point) const {
    return states.value(index(-2 - points_[point].state.number));
  }

  /// The contact of these bodies that is nearest to a place, its normal turned by less than 60
  /// degrees; or null.
  [[nodiscard]] const Contact* nearest(const Bodies& bodies, int a, int b, const Vec<Dim>& normal,
                                       const Vec<Dim>& place) const {
    const std::pair<int, int> wanted = std::minmax(a, b);
    auto it = std::lower_bound(
        order_.begin(), order_.end(), wanted,
        [&](int x, const std::pair<int, int>& value) { return bodies_[index(x)] < value; });
    const Contact* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (; it != order_.end() && bodies_[index(*it)] == wanted; ++it) {
      const Contact& c = contacts_[index(*it)];
      const double distance = squared_distance(bodies, c, points_, normal, place);
      if (distance >= least) continue;
      least = distance;
      best = &c;
    }
    return best;
  }

 private:
  template <class Number>
  [[nodiscard]] static std::size_t index(Number i) {
    return static_cast<std::size_t>(i);
  }

  std::vector<Contact> contacts_;
  std::vector<Point> points_;
  std::vector<std::pair<int, int>> bodies_;  ///< of every contact, the lower first
  std::vector<int> order_;                   ///< of contacts, by their bodies
};

}  // namespace voussoir::detail
