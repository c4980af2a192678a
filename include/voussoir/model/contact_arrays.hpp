// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/any_law.hpp>
#include <voussoir/model/reference_contact.hpp>

namespace voussoir {

/// What the force of every point is made of: 32 bytes in 2-D, 48 in 3-D.
template <int Dim>
struct PointRecord {
  double along[Dim - 1];               ///< from the centre of the area, along the tangents [m]
  double weight;                       ///< [m] or [m^2]
  double initial_normal;               ///< in the in-situ state, compression positive [N]
  double initial_tangential[Dim - 1];  ///< [N]
};

/// What a contact update, or ground that had moved before the contact was made, adds to a point.
template <int Dim>
struct PointShift {
  double height = 0;                   ///< from the plane through the centre, along the normal [m]
  Vec<Dim> start = zeros<Vec<Dim>>();  ///< opening and slips at displacement zero [m]
};

/// The points of contacts as flat arrays: what forces read apart from what laws remember, and apart
/// from the shifts, which no point has before contacts are updated. Then there is no such array.
///
/// Bytes a point, of a `CoulombJoint` in 2-D and 3-D: 32 and 48, history 16 and 32, shifts 24 and
/// 32 where there are any; a struct of all of it had 80 and 112.
template <int Dim>
class ContactArrays {
 public:
  using Record = PointRecord<Dim>;
  using Shift = PointShift<Dim>;
  /// A point put together from the arrays, as a value.
  struct Point : ReferencePoint<Dim> {
    AnyState state{};  ///< what the contact law remembers of it

    /// That, as the law's own type.
    /// @throws InvalidInput  the point follows another law
    template <class Law>
    [[nodiscard]] const typename Law::template State<Dim>& history() const {
      return state.as<typename Law::template State<Dim>>();
    }
  };

  /// Goes through the points; what it points to is a value.
  class Iterator {
   public:
    using value_type = Point;
    using difference_type = std::ptrdiff_t;
    using reference = Point;
    using pointer = void;
    using iterator_category = std::input_iterator_tag;

    Iterator() = default;
    Iterator(const ContactArrays* of, std::size_t k) : of_(of), k_(k) {}
    [[nodiscard]] Point operator*() const { return (*of_)[k_]; }
    Iterator& operator++() {
      ++k_;
      return *this;
    }
    Iterator operator++(int) { return {of_, k_++}; }
    [[nodiscard]] bool operator==(const Iterator& other) const { return k_ == other.k_; }

   private:
    const ContactArrays* of_ = nullptr;
    std::size_t k_ = 0;
  };

  [[nodiscard]] std::size_t size() const { return records_.size(); }
  [[nodiscard]] bool empty() const { return records_.empty(); }
  [[nodiscard]] Iterator begin() const { return {this, 0}; }
  [[nodiscard]] Iterator end() const { return {this, size()}; }
  /// Whether any point has been shifted since the in-situ state.
  [[nodiscard]] bool has_shifts() const { return !shifts_.empty(); }

  [[nodiscard]] Point operator[](std::size_t k) const {
    VOUSSOIR_ASSERT(k < size(), "there is such a point");
    Point p;
    static_cast<ReferencePoint<Dim>&>(p) = place(k);
    p.state = states_.value(k);
    return p;
  }
  /// A point but for what the law remembers of it.
  [[nodiscard]] ReferencePoint<Dim> place(std::size_t k) const {
    const Record& r = records_[k];
    const Shift shift = has_shifts() ? shifts_[k] : Shift{};
    ReferencePoint<Dim> p;
    p.offset[0] = shift.height;
    p.weight = r.weight;
    p.initial.normal = r.initial_normal;
    for (int m = 0; m < Dim - 1; ++m) {
      p.offset[m + 1] = r.along[m];
      p.initial.tangential[m] = r.initial_tangential[m];
    }
    p.start = shift.start;
    return p;
  }
  /// Stores a point back, all of it.
  void set(std::size_t k, const Point& p) {
    states_.set(k, p.state);
    set_place(k, p);
  }
  /// The same but for what the law remembers of it.
  void set_place(std::size_t k, const ReferencePoint<Dim>& p) {
    VOUSSOIR_ASSERT(k < size(), "there is such a point");
    Record& r = records_[k];
    r.weight = p.weight;
    r.initial_normal = p.initial.normal;
    for (int m = 0; m < Dim - 1; ++m) {
      r.along[m] = p.offset[m + 1];
      r.initial_tangential[m] = p.initial.tangential[m];
    }
    const bool is_shifted = p.offset[0] != 0 || !(p.start == zeros<Vec<Dim>>());
    if (is_shifted && shifts_.empty()) shifts_.resize(size());
    if (!shifts_.empty()) shifts_[k] = {p.offset[0], p.start};
  }
  void push_back(const Point& p) {
    records_.emplace_back();
    states_.push_back(p.state);
    if (!shifts_.empty()) shifts_.emplace_back();
    set_place(size() - 1, p);
  }
  void reserve(std::size_t count) {
    records_.reserve(count);
    states_.reserve(count);
    if (!shifts_.empty()) shifts_.reserve(count);
  }
  /// Moves `count` points towards the front. @pre to <= from
  void move_down(std::size_t from, std::size_t to, std::size_t count) {
    VOUSSOIR_ASSERT(to <= from && from + count <= size(), "points move towards the front");
    if (from == to) return;
    const auto move = [&](auto& array) {
      for (std::size_t k = 0; k < count; ++k) array[to + k] = std::move(array[from + k]);
    };
    move(records_);
    states_.move_down(from, to, count);
    if (!shifts_.empty()) move(shifts_);
  }
  /// Forgets all points but the first `count`.
  void truncate(std::size_t count) {
    VOUSSOIR_ASSERT(count <= size(), "points are only taken away");
    const auto cut = [&](auto& array) {
      array.erase(array.begin() + static_cast<std::ptrdiff_t>(count), array.end());
    };
    cut(records_);
    states_.truncate(count);
    if (!shifts_.empty()) cut(shifts_);
  }

  // The arrays themselves, for the kernel of forces.
  [[nodiscard]] const Record* records() const { return records_.data(); }
  [[nodiscard]] const Shift* shifts() const { return shifts_.data(); }  ///< null: none is shifted
  [[nodiscard]] const detail::StateColumn& states() const { return states_; }
  [[nodiscard]] detail::StateColumn& states() { return states_; }

 private:
  std::vector<Record> records_;
  detail::StateColumn states_;
  std::vector<Shift> shifts_;  ///< empty: all are zero
};

}  // namespace voussoir
