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
#include <voussoir/model/detail/law_model.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contact.hpp>
#include <voussoir/model/point_loads.hpp>

namespace voussoir {

/// Contacts of one kind between bodies that move and turn by any amount.
///
/// A contact point is fixed in body b, and touches the face of body a: its opening and slip are its
/// coordinates in a frame that turns with that face, less what they were when the joint was closed.
/// Forces on both bodies act in the same place, so that momentum and angular momentum are kept to
/// rounding.
///
/// What the laws remember lies in a column beside the points; in a point that is stored is its
/// number there, in one that is to be stored that of the point whose memory it inherits: among the
/// contacts here, or among former ones that were taken over (`adopt`), which are numbered downwards
/// from -2.
template <int Dim>
class MovingContacts {
 public:
  using Law = AnyLaw<Dim>;
  using State = detail::FormerPoint;
  using Point = MovingContactPoint<Dim, State>;
  using Contact = MovingContact<Dim>;

  /// @throws InvalidInput  laws of different types
  explicit MovingContacts(std::vector<Law> laws) { take(std::move(laws)); }

  [[nodiscard]] const std::vector<Law>& laws() const { return laws_; }
  /// @return  its index
  /// @throws InvalidInput  it is not of the type of those that there are
  std::int32_t add_law(Law law) {
    std::vector<Law> laws = laws_;
    laws.push_back(std::move(law));
    take(std::move(laws));
    return static_cast<std::int32_t>(laws_.size()) - 1;
  }
  /// @throws InvalidInput  not as many as there are, or of another type
  void set_laws(std::vector<Law> laws) {
    require(laws.size() == laws_.size(), "number of contact laws", static_cast<double>(laws.size()),
            "as many as before");
    take(std::move(laws));
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

  /// Memories that points may inherit from now on, by the numbers -2, -3, ...
  void adopt(detail::StateColumn former) { former_ = std::move(former); }

  /// Puts a contact with its points in the place of another, or behind all.
  /// @param number  of the other, which leaves its points behind if they are fewer or more; -1:
  ///                none. The number of the new one afterwards
  /// @return  true if its points lie where those of the other did
  bool put(std::int32_t& number, Contact contact, const std::vector<Point>& points);

  /// Keeps these contacts and their points alone, in this order, and numbers them anew.
  /// @param each  each(visit) calls visit(number) for every one, to be changed
  template <class Each>
  void keep(Each&& each) {
    std::vector<Contact> contacts;
    std::vector<Point> points;
    detail::StateColumn states;
    contacts.reserve(contacts_.size());
    points.reserve(points_.size());
    if (!laws_.empty()) states.set_model(detail::states_of(laws_));
    states.reserve(points_.size());
    each([&](std::int32_t& number) {
      Contact c = contacts_[static_cast<std::size_t>(number)];
      const auto first = static_cast<std::int32_t>(points.size());
      for (std::int32_t k = c.first; k < c.last; ++k) {
        Point p = points_[static_cast<std::size_t>(k)];
        p.state.number = static_cast<std::int32_t>(points.size());
        points.push_back(p);
        states.push_back(states_.at(static_cast<std::size_t>(k)));
      }
      c.first = first;
      c.last = static_cast<std::int32_t>(points.size());
      number = static_cast<std::int32_t>(contacts.size());
      contacts.push_back(c);
    });
    contacts_.swap(contacts);
    points_.swap(points);
    states_.swap(states);
  }

  /// Forces of contacts first, ..., last - 1 with the bodies at these poses, history brought up to
  /// date.
  /// @param reactions  of these contacts, to be written
  /// @param crossings  to which those are added that closed or opened in the last step; null: none
  void react(std::size_t first, std::size_t last, const std::vector<MovingBody<Dim>>& bodies,
             Reaction<Dim>* reactions, Dissipation& lost, StepCrossings<Dim>* crossings = nullptr) {
    if (!(first < last)) return;
    laws_.front().model().react({laws_.data(), contacts_.data(), first, last, points_.data(),
                                 states_.data(), bodies.data(), reactions, &lost, crossings});
  }
  /// Of a point as this contact has it.
  [[nodiscard]] PointForce<Dim> force(const Contact& c, const PointLoad<Dim>& load,
                                      State state) const {
    return law_of(c).model().force(load, memory(state));
  }
  [[nodiscard]] double stored_energy(const Contact& c, const PointLoad<Dim>& load,
                                     State state) const {
    return law_of(c).model().stored_energy(load, memory(state));
  }
  /// Where such a point lets go: see `release_opening`.
  [[nodiscard]] BondRelease<Dim> release_of(const Contact& c, const PointLoad<Dim>& load,
                                            State state) const {
    return law_of(c).model().release_opening(load, memory(state));
  }
  /// Calls visit(k, point, load) for points of a contact, here or to be, on its pressed part.
  template <class Visit>
  void visit_loads(const Contact& c, std::span<const Point> points,
                   const typename Contact::Place& at, Visit&& visit) const {
    detail::visit_pressed<Dim>(
        points.size(), c.outline, [&](std::size_t k) { return points[k]; },
        [&](const Point& p) { return p.load(at); },
        detail::PointsOfAny(law_of(c).model(),
                            [&](std::size_t k) { return memory(points[k].state); }),
        visit);
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
  [[nodiscard]] AnyState state_of(std::size_t point) const { return states_.value(point); }
  [[nodiscard]] const void* memory_of(std::size_t point) const { return states_.at(point); }

  /// Energy that the springs of contact `k` hold [J].
  template <class Bodies>
  [[nodiscard]] double stored_energy(std::size_t k, const Bodies& bodies) const {
    const Contact& c = contacts_[k];
    const auto at = c.place(bodies[static_cast<std::size_t>(c.a)].pose,
                            bodies[static_cast<std::size_t>(c.b)].pose);
    return stored_energy(c, points_of(c), at);
  }

 private:
  [[nodiscard]] const void* memory(State state) const {
    if (state.number >= 0) return states_.at(static_cast<std::size_t>(state.number));
    if (state.number < -1) return former_.at(static_cast<std::size_t>(-2 - state.number));
    return laws_.front().model().states().fresh();
  }
  void take(std::vector<Law> laws) {
    if (!laws.empty()) {
      states_.set_model(detail::states_of(laws));
      inherited_.set_model(detail::states_of(laws));
    }
    laws_ = std::move(laws);
  }

  std::vector<Law> laws_;
  std::vector<Contact> contacts_;
  std::vector<Point> points_;
  detail::StateColumn states_, former_;
  detail::StateColumn inherited_;  ///< room for `put`
};

template <int Dim>
bool MovingContacts<Dim>::put(std::int32_t& number, Contact contact,
                              const std::vector<Point>& points) {
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
  // First all memories, then their places: one point may inherit from where another goes.
  inherited_.truncate(0);
  for (const Point& p : points) inherited_.push_back(memory(p.state));
  if (!fits) points_.resize(points_.size() + points.size());
  for (std::int32_t k = 0; k < count; ++k) {
    const std::int32_t at = contact.first + k;
    Point& p = points_[static_cast<std::size_t>(at)];
    p = points[static_cast<std::size_t>(k)];
    p.state.number = at;
    const void* state = inherited_.at(static_cast<std::size_t>(k));
    if (fits)
      states_.set(static_cast<std::size_t>(at), state);
    else
      states_.push_back(state);
  }
  place = contact;
  return fits;
}

}  // namespace voussoir
