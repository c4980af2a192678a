// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/model/any_law.hpp>
#include <voussoir/model/detail/contact_reaction.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contact.hpp>
#include <voussoir/model/point_loads.hpp>

namespace voussoir {

/// Contacts that follow laws of one kind, between bodies that move and turn by any amount.
///
/// A contact point is fixed in body b, and touches the face of body a: its opening and slip are its
/// coordinates in a frame that turns with that face, less what they were when the joint was closed.
/// Forces on both bodies act in the same place, so that momentum and angular momentum are kept to
/// rounding.
template <int Dim, class Law>
class MovingContacts {
 public:
  using State = typename Law::template State<Dim>;

  using Point = MovingContactPoint<Dim, State>;
  using Contact = MovingContact<Dim>;

  explicit MovingContacts(std::vector<Law> laws) : laws_(std::move(laws)) {}

  [[nodiscard]] const std::vector<Law>& laws() const { return laws_; }
  /// @return  its index
  std::int32_t add_law(Law law) {
    laws_.push_back(std::move(law));
    return static_cast<std::int32_t>(laws_.size()) - 1;
  }
  /// @throws InvalidInput  not as many as there are
  void set_laws(std::vector<Law> laws) {
    require(laws.size() == laws_.size(), "number of contact laws", static_cast<double>(laws.size()),
            "as many as before");
    laws_ = std::move(laws);
  }
  [[nodiscard]] const Law& law_of(const Contact& c) const {
    return laws_[static_cast<std::size_t>(c.law)];
  }
  [[nodiscard]] std::vector<Contact>& contacts() { return contacts_; }
  [[nodiscard]] const std::vector<Contact>& contacts() const { return contacts_; }
  [[nodiscard]] std::vector<Point>& points() { return points_; }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] std::size_t size() const { return contacts_.size(); }
  [[nodiscard]] std::span<const Point> points_of(const Contact& c) const {
    return {points_.data() + c.first, static_cast<std::size_t>(c.last - c.first)};
  }

  /// Puts a contact with its points in the place of another, or behind all.
  /// @param number  of the other, which leaves its points behind if they are fewer or more; -1:
  ///                none. The number of the new one afterwards
  /// @return  true if its points lie where those of the other did
  bool put(std::int32_t& number, Contact contact, const std::vector<Point>& points) {
    const auto count = static_cast<std::int32_t>(points.size());
    const bool is_new = number < 0;
    if (is_new) {
      number = static_cast<std::int32_t>(contacts_.size());
      contacts_.emplace_back();
    }
    Contact& place = contacts_[static_cast<std::size_t>(number)];
    const bool fits = !is_new && place.last - place.first == count;
    contact.first = fits ? place.first : static_cast<std::int32_t>(points_.size());
    contact.last = contact.first + count;
    if (fits)
      std::copy(points.begin(), points.end(), points_.begin() + contact.first);
    else
      points_.insert(points_.end(), points.begin(), points.end());
    place = contact;
    return fits;
  }
  /// Keeps these contacts and their points alone, in this order, and numbers them anew.
  /// @param each  each(visit) calls visit(number) for every one, to be changed
  template <class Each>
  void keep(Each&& each) {
    std::vector<Contact> contacts;
    std::vector<Point> points;
    contacts.reserve(contacts_.size());
    points.reserve(points_.size());
    each([&](std::int32_t& number) {
      Contact c = contacts_[static_cast<std::size_t>(number)];
      const std::span<const Point> own = points_of(c);
      c.first = static_cast<std::int32_t>(points.size());
      points.insert(points.end(), own.begin(), own.end());
      c.last = static_cast<std::int32_t>(points.size());
      number = static_cast<std::int32_t>(contacts.size());
      contacts.push_back(c);
    });
    contacts_.swap(contacts);
    points_.swap(points);
  }

  /// Forces of contacts first, ..., last - 1 with the bodies at these poses, history brought up to
  /// date.
  /// @param reactions  of these contacts, to be written
  void react(std::size_t first, std::size_t last, const std::vector<MovingBody<Dim>>& bodies,
             Reaction<Dim>* reactions, Dissipation& lost) {
    for (std::size_t k = first; k < last; ++k) {
      const Contact& c = contacts_[k];
      *reactions++ = detail::reaction(law_of(c), c, points_.data(), detail::StatesOfPoints{},
                                      bodies[static_cast<std::size_t>(c.a)],
                                      bodies[static_cast<std::size_t>(c.b)], lost);
    }
  }
  /// Of a point as this contact has it.
  [[nodiscard]] PointForce<Dim> force(const Contact& c, const PointLoad<Dim>& load,
                                      const State& state) const {
    return law_of(c).force(load, state);
  }
  [[nodiscard]] double stored_energy(const Contact& c, const PointLoad<Dim>& load,
                                     const State& state) const {
    return law_of(c).stored_energy(load, state);
  }
  /// Where such a point lets go: see `release_opening`.
  [[nodiscard]] auto release_of(const Contact& c, const PointLoad<Dim>& load,
                                const State& state) const {
    return release_opening<Dim>(law_of(c), load, state);
  }
  /// Calls visit(k, point, load) for points of a contact, here or to be, on its pressed part.
  template <class Visit>
  void visit_loads(const Contact& c, std::span<const Point> points,
                   const typename Contact::Place& at, Visit&& visit) const {
    detail::visit_pressed<Dim>(
        points.size(), c.outline, [&](std::size_t k) { return points[k]; },
        [&](const Point& p) { return p.load(at); },
        [&](std::size_t k, const PointLoad<Dim>& load) {
          return release_of(c, load, points[k].state);
        },
        visit);
  }
  /// Points and loads of a contact of this group, on its pressed part.
  template <class Visit>
  void visit_loads(const Contact& c, const typename Contact::Place& at, Visit&& visit) const {
    visit_loads(c, points_of(c), at, visit);
  }
  /// Sum of the shear forces of such points [N].
  [[nodiscard]] Vec<Dim - 1> shear_of(const Contact& c, std::span<const Point> points,
                                      const typename Contact::Place& at) const {
    Vec<Dim - 1> sum = zeros<Vec<Dim - 1>>();
    visit_loads(c, points, at, [&](std::size_t, const Point& p, const PointLoad<Dim>& load) {
      sum += force(c, load, p.state).tangential;
    });
    return sum;
  }
  /// Energy that the springs of such points hold [J].
  [[nodiscard]] double stored_energy(const Contact& c, std::span<const Point> points,
                                     const typename Contact::Place& at) const {
    double sum = 0;
    visit_loads(c, points, at, [&](std::size_t, const Point& p, const PointLoad<Dim>& load) {
      sum += stored_energy(c, load, p.state);
    });
    return sum;
  }
  /// What is remembered of a point.
  [[nodiscard]] const State& state_of(std::size_t point) const { return points_[point].state; }

  /// Energy that the springs of contact `k` hold [J].
  template <class Bodies>
  [[nodiscard]] double stored_energy(std::size_t k, const Bodies& bodies) const {
    const Contact& c = contacts_[k];
    const auto at = c.place(bodies[static_cast<std::size_t>(c.a)].pose,
                            bodies[static_cast<std::size_t>(c.b)].pose);
    return stored_energy(c, points_of(c), at);
  }

 private:
  std::vector<Law> laws_;
  std::vector<Contact> contacts_;
  std::vector<Point> points_;
};

}  // namespace voussoir
