// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iterator>
#include <vector>
#include <voussoir/model/any_law.hpp>
#include <voussoir/model/detail/law_model.hpp>
#include <voussoir/model/moving_contact.hpp>
#include <voussoir/model/moving_contacts.hpp>

namespace voussoir {

/// Contacts in motion whose law is known at run time, to be read with the law as a type. It owns
/// nothing.
template <int Dim, class Law>
class MovingContactsView {
 public:
  using Group = MovingContacts<Dim>;
  using State = typename Law::template State<Dim>;
  using Point = MovingContactPoint<Dim, State>;
  using Contact = MovingContact<Dim>;

  /// A range of points as values.
  class Points {
   public:
    class Iterator {
     public:
      using value_type = Point;
      using difference_type = std::ptrdiff_t;
      using reference = Point;
      using pointer = void;
      using iterator_category = std::input_iterator_tag;

      Iterator() = default;
      Iterator(const Group* of, std::size_t k) : of_(of), k_(k) {}
      [[nodiscard]] Point operator*() const { return Points(*of_)[k_]; }
      Iterator& operator++() {
        ++k_;
        return *this;
      }
      Iterator operator++(int) { return {of_, k_++}; }
      [[nodiscard]] bool operator==(const Iterator& other) const { return k_ == other.k_; }

     private:
      const Group* of_ = nullptr;
      std::size_t k_ = 0;
    };

    explicit Points(const Group& of) : of_(&of) {}
    [[nodiscard]] std::size_t size() const { return of_->points().size(); }
    [[nodiscard]] Iterator begin() const { return {of_, 0}; }
    [[nodiscard]] Iterator end() const { return {of_, size()}; }
    [[nodiscard]] Point operator[](std::size_t k) const {
      const auto& p = of_->points()[k];
      return {p.place, p.zero, p.weight, p.initial, *static_cast<const State*>(of_->memory_of(k))};
    }

   private:
    const Group* of_;
  };

  explicit MovingContactsView(const Group& of) : of_(&of) {}

  /// @pre the contact is one of these
  [[nodiscard]] const Law& law_of(const Contact& c) const {
    return detail::LawModelOf<Dim, Law>::of_type(of_->law_of(c));
  }
  [[nodiscard]] std::vector<Law> laws() const {
    std::vector<Law> all;
    for (const AnyLaw<Dim>& law : of_->laws())
      all.push_back(detail::LawModelOf<Dim, Law>::of_type(law));
    return all;
  }
  [[nodiscard]] const std::vector<Contact>& contacts() const { return of_->contacts(); }
  [[nodiscard]] Points points() const { return Points(*of_); }
  [[nodiscard]] std::size_t size() const { return of_->size(); }
  /// Calls visit(k, point, load) for the points of a contact, on its pressed part.
  template <class Visit>
  void visit_loads(const Contact& c, const typename Contact::Place& at, Visit&& visit) const {
    const auto first = static_cast<std::size_t>(c.first);
    of_->visit_loads(c, of_->points_of(c), at,
                     [&](std::size_t k, const auto& p, const PointLoad<Dim>& load) {
                       const auto* state = static_cast<const State*>(of_->memory_of(first + k));
                       visit(k, Point{p.place, p.zero, p.weight, p.initial, *state}, load);
                     });
  }

 private:
  const Group* of_;
};

}  // namespace voussoir
