// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/placed_shapes.hpp>

namespace voussoir {

/// A box whose sides are parallel to the axes.
template <int Dim>
struct Box {
  Vec<Dim> low, high;  ///< corners [m]

  [[nodiscard]] bool meets(const Box& other, double margin) const {
    return all_less_equal(low, shifted_by(other.high, margin)) &&
           all_less_equal(other.low, shifted_by(high, margin));
  }
  [[nodiscard]] bool contains(const Box& other) const {
    return all_less_equal(low, other.low) && all_less_equal(other.high, high);
  }
};

/// @param from  what the coordinates of the box are to be counted from: a grid point [m]
template <int Dim>
[[nodiscard]] Box<Dim> bounding_box(const PlacedShapes<Dim>& shapes, std::size_t k,
                                    const Vec<Dim>& from) {
  const PlacedShape<Dim> shape = shapes[k];
  const Vec<Dim> shift = shapes.grid_point(k) - from;
  Box<Dim> box;
  for (int axis = 0; axis < Dim; ++axis) {
    const double* const x = shape.vertices(axis);
    box.low[axis] = *std::min_element(x, x + shape.vertex_count) + shift[axis];
    box.high[axis] = *std::max_element(x, x + shape.vertex_count) + shift[axis];
  }
  return box;
}

/// The broad phase: pairs of shapes that are near each other, kept until shapes have moved.
///
/// Every pair whose boxes are nearer than `reach` is in the list, and others that may come so near
/// soon: boxes are enlarged by half the margin, and the list holds good until one leaves its
/// enlarged box. Boxes are found in a grid of cells about as large as they are.
///
/// Within a pair the shape whose reference position lies lower in x (then y, z) comes first, so
/// that what is computed from a pair depends neither on how shapes are numbered nor on where they
/// have been.
template <int Dim>
class NeighbourList {
 public:
  struct Pair {
    std::uint32_t a, b;
    friend bool operator==(const Pair&, const Pair&) = default;
  };

  /// @param margin  how much nearer two shapes may come before the list is made anew [m], >= 0
  /// @param reach   how far apart the boxes of a wanted pair may be [m], >= 0
  explicit NeighbourList(double margin, double reach = 0) : margin_(margin), reach_(reach) {
    require(margin >= 0 && std::isfinite(margin), "margin of the neighbour list", margin, ">= 0 m");
    require(reach >= 0 && std::isfinite(reach), "reach of the neighbour list", reach, ">= 0 m");
  }

  /// @return  true if the list was made anew
  /// @throws InvalidInput  a shape has a coordinate that is not finite
  /// @cost    O(vertices) where it still holds; O(shapes) to make it, for shapes of like size
  bool update(const PlacedShapes<Dim>& shapes) {
    bool holds = boxes_.size() == shapes.size();
    for (std::size_t k = 0; holds && k < shapes.size(); ++k)
      holds = boxes_[k].contains(bounding_box(shapes, k, base_));
    if (holds) return false;
    make(shapes);
    return true;
  }

  /// Ordered by the smaller number, then the larger.
  [[nodiscard]] const std::vector<Pair>& pairs() const { return pairs_; }

 private:
  using Cell = std::array<std::int64_t, Dim>;
  struct Entry {
    Cell cell;
    std::uint32_t shape;
    friend auto operator<=>(const Entry&, const Entry&) = default;
  };

  void make(const PlacedShapes<Dim>& shapes);

  /// Adds the pair if its boxes meet, and if this cell is the first they have in common.
  void add(const PlacedShapes<Dim>& shapes, std::uint32_t i, std::uint32_t j, const Cell& cell);

  [[nodiscard]] double entries_needed() const {
    double sum = 0;
    for (const Box<Dim>& box : boxes_)
      sum += product_of_entries(shifted_by(quotients<Dim>(box.high - box.low, size_), 2.0));
    return sum;
  }
  [[nodiscard]] Cell cell_of(const Vec<Dim>& point) const {
    Cell cell;
    for (int axis = 0; axis < Dim; ++axis)
      cell[index(axis)] =
          static_cast<std::int64_t>(std::floor((point[axis] - origin_[axis]) / size_[axis]));
    return cell;
  }
  [[nodiscard]] static std::size_t index(int axis) { return static_cast<std::size_t>(axis); }

  double margin_, reach_;
  Vec<Dim> base_ = zeros<Vec<Dim>>();  ///< what boxes are counted from: near them [m]
  Vec<Dim> origin_ = zeros<Vec<Dim>>(), size_ = all_entries<Dim>(1);
  std::vector<Box<Dim>> boxes_;  ///< enlarged
  std::vector<Pair> pairs_;
};

template <int Dim>
void NeighbourList<Dim>::make(const PlacedShapes<Dim>& shapes) {
  boxes_.clear();
  if (shapes.size() > 0) base_ = shapes.grid_point(0);
  Vec<Dim> extent = zeros<Vec<Dim>>();
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    Box<Dim> box = bounding_box(shapes, k, base_);
    if (!(is_finite(box.low) && is_finite(box.high)))
      throw InvalidInput(
          message({"neighbour list: shape ", k, " has a coordinate that is not finite"}));
    extent += box.high - box.low;
    box.low = shifted_by(box.low, -0.5 * margin_);
    box.high = shifted_by(box.high, 0.5 * margin_);
    VOUSSOIR_ASSERT(!any_less(box.high, box.low), "a box is from low to high");
    boxes_.push_back(box);
  }
  pairs_.clear();
  if (boxes_.empty()) return;
  // Cells as large as the mean box; larger while large boxes fill too many of them.
  origin_ = boxes_.front().low;
  size_ = shifted_by(extent / static_cast<double>(boxes_.size()), margin_ + reach_);
  size_ = larger_of(size_, all_entries<Dim>(1e-3 * largest_entry(size_)));
  if (!(largest_entry(size_) > 0)) size_ = all_entries<Dim>(1);
  while (entries_needed() > 32.0 * static_cast<double>(boxes_.size())) size_ *= 2;
  std::vector<Entry> entries;
  for (std::size_t k = 0; k < boxes_.size(); ++k) {
    const Cell low = cell_of(shifted_by(boxes_[k].low, -0.5 * reach_));
    const Cell high = cell_of(shifted_by(boxes_[k].high, 0.5 * reach_));
    for (Cell cell = low;;) {
      entries.push_back({cell, static_cast<std::uint32_t>(k)});
      int axis = 0;
      while (axis < Dim && cell[index(axis)] == high[index(axis)]) {
        cell[index(axis)] = low[index(axis)];
        ++axis;
      }
      if (axis == Dim) break;
      ++cell[index(axis)];
    }
  }
  std::sort(entries.begin(), entries.end());
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (std::size_t j = i + 1; j < entries.size() && entries[j].cell == entries[i].cell; ++j)
      add(shapes, entries[i].shape, entries[j].shape, entries[i].cell);
  std::vector<std::pair<int, int>> shapes_of;
  shapes_of.reserve(pairs_.size());
  for (const Pair& pair : pairs_)
    shapes_of.emplace_back(std::minmax(static_cast<int>(pair.a), static_cast<int>(pair.b)));
  const std::vector<Pair> found = std::move(pairs_);
  pairs_.clear();
  pairs_.reserve(found.size());
  for (const int k : order_of_pairs(shapes_of, static_cast<int>(boxes_.size())))
    pairs_.push_back(found[static_cast<std::size_t>(k)]);
  VOUSSOIR_ASSERT(pairs_.size() == found.size(), "putting pairs in order loses none");
}

template <int Dim>
void NeighbourList<Dim>::add(const PlacedShapes<Dim>& shapes, std::uint32_t i, std::uint32_t j,
                             const Cell& cell) {
  VOUSSOIR_ASSERT(i != j && i < boxes_.size() && j < boxes_.size(), "a pair is of two shapes");
  const Box<Dim>&a = boxes_[i], &b = boxes_[j];
  if (!a.meets(b, reach_)) return;
  if (cell_of(shifted_by(larger_of(a.low, b.low), -0.5 * reach_)) != cell) return;
  const Vec<Dim>&home_i = shapes.home(i), &home_j = shapes.home(j);
  bool swap = j < i;
  for (int axis = Dim; axis-- > 0;)
    if (home_i[axis] != home_j[axis]) swap = home_i[axis] > home_j[axis];
  pairs_.push_back(swap ? Pair{j, i} : Pair{i, j});
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class NeighbourList<2>;
VOUSSOIR_SPATIAL_TEMPLATE class NeighbourList<3>;
#endif

}  // namespace voussoir
