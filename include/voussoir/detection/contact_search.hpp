// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/parallel.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/contact.hpp>
#include <voussoir/detection/contact_detector.hpp>
#include <voussoir/detection/neighbour_list.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir {

/// All contacts of many shapes, with their polygons.
template <int Dim>
class ContactList {
 public:
  struct Item {
    std::uint32_t a, b;  ///< shapes
    Touch touch;
    Vec<Dim> normal;    ///< from a to b
    double separation;  ///< < 0: depth [m]
    double measure;     ///< length or area [m], [m^2]
    std::size_t first_point, point_count;
  };

  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] const Item& operator[](std::size_t k) const { return items_[k]; }
  [[nodiscard]] std::span<const Vec<Dim>> polygon(std::size_t k) const {
    VOUSSOIR_ASSERT(items_[k].first_point + items_[k].point_count <= points_.size(),
                    "a contact has its points");
    return {points_.data() + items_[k].first_point, items_[k].point_count};
  }
  void clear() {
    items_.clear();
    points_.clear();
  }
  void add(std::uint32_t a, std::uint32_t b, const Contact<Dim>& contact) {
    VOUSSOIR_ASSERT(a != b && contact.touch != Touch::none,
                    "a contact is of two shapes that touch");
    items_.push_back({a, b, contact.touch, contact.normal, contact.separation, contact.measure,
                      points_.size(), contact.polygon.size()});
    points_.insert(points_.end(), contact.polygon.begin(), contact.polygon.end());
  }
  void append(const ContactList& other) {
    const std::size_t shift = points_.size();
    for (Item item : other.items_) {
      item.first_point += shift;
      items_.push_back(item);
    }
    points_.insert(points_.end(), other.points_.begin(), other.points_.end());
  }

 private:
  std::vector<Item> items_;
  std::vector<Vec<Dim>> points_;
};

/// Finds the contacts of shapes that move: neighbour list, then each pair, with what decided it
/// last time remembered.
///
/// The contacts come ordered by shapes, and do not depend on the number of threads; nor, but for
/// that order, on how the shapes are numbered.
///
/// @tparam Detector  FaceContacts, AnalyticCentre or another PairDetector
template <class Detector, int Dim>
class ContactSearch {
  static_assert(explain_pair_detector<Detector, Dim>());

 public:
  /// @param reach   contacts may be so far open [m], >= 0
  /// @param margin  see NeighbourList
  explicit ContactSearch(double reach, double margin) : reach_(reach), neighbours_(margin, reach) {}

  /// @cost  per pair of the list some 40 ns (2-D) or 200 ns (3-D) with FaceContacts
  const ContactList<Dim>& run(const PlacedShapes<Dim>& shapes, unsigned threads = 1) {
    if (neighbours_.update(shapes)) carry_over();
    const auto& pairs = neighbours_.pairs();
    VOUSSOIR_ASSERT(memories_.size() == pairs.size(), "every pair of neighbours has its memory");
    const std::size_t chunks = std::max<std::size_t>(
        1, std::min<std::size_t>(threads <= 1 ? 1 : std::size_t{8} * threads, pairs.size() / 64));
    found_.resize(chunks);
    parallel_for(chunks, threads, [&](std::size_t chunk) {
      typename Detector::template Pair<Dim> detector(shapes);
      found_[chunk].clear();
      const std::size_t end = (chunk + 1) * pairs.size() / chunks;
      for (std::size_t k = chunk * pairs.size() / chunks; k < end; ++k) {
        const Contact<Dim> contact =
            detector.contact(pairs[k].a, pairs[k].b, memories_[k].second, reach_);
        if (contact.touch != Touch::none) found_[chunk].add(pairs[k].a, pairs[k].b, contact);
      }
    });
    contacts_.clear();
    for (const auto& part : found_) contacts_.append(part);
    return contacts_;
  }

  [[nodiscard]] const NeighbourList<Dim>& neighbours() const { return neighbours_; }

 private:
  using Neighbours = typename NeighbourList<Dim>::Pair;
  using Memory = typename Detector::template Pair<Dim>::Memory;

  /// What is remembered of a pair goes with it from the old list to the new one.
  void carry_over() {
    std::vector<std::pair<Neighbours, Memory>> kept;
    kept.reserve(neighbours_.pairs().size());
    const auto before = [](const Neighbours& x, const Neighbours& y) {
      return std::minmax(x.a, x.b) < std::minmax(y.a, y.b);
    };
    auto old = memories_.begin();
    for (const Neighbours& pair : neighbours_.pairs()) {
      while (old != memories_.end() && before(old->first, pair)) ++old;
      // A memory names faces of a and of b: it is of no use if these have changed places.
      const bool same = old != memories_.end() && old->first == pair;
      kept.emplace_back(pair, same ? old->second : Memory{});
    }
    memories_.swap(kept);
  }

  double reach_;
  NeighbourList<Dim> neighbours_;
  std::vector<std::pair<Neighbours, Memory>> memories_;
  std::vector<ContactList<Dim>> found_;
  ContactList<Dim> contacts_;
};

}  // namespace voussoir
