// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/rockmass/domain.hpp>

namespace voussoir {

/// A regular grid on those sides of a domain that meet elastic ground: displacements of the edge
/// are interpolated between its nodes.
template <int Dim>
class EdgeMesh {
 public:
  static constexpr int corners = 1 << (Dim - 1);
  /// A part of a side, between grid lines: bit k of a corner's number says whether it is the upper
  /// one along the k-th axis of the side.
  using Cell = std::array<int, corners>;
  /// A place on the edge: nodes, and the part that each has in the displacement there; together 1.
  struct Place {
    Cell nodes;
    std::array<double, corners> shares;
  };

  /// Cells along the longest axis, at least and at most: with the least the stiffness for motions
  /// that vary once or twice round the opening is within a few percent (tests/farfield). A domain
  /// that is narrow one way is near to its opening there, and has more.
  static constexpr int least_cells = Dim == 2 ? 12 : 6, most_cells = Dim == 2 ? 48 : 10;
  /// The same along the shortest axis, if that is not too many along the longest.
  static constexpr int cells_of_shortest = Dim == 2 ? 6 : 3;

  /// @pre  field.check() has passed
  EdgeMesh(const Domain<Dim>& domain, const FarField<Dim>& field) : domain_(domain), field_(field) {
    const double longest = largest_entry(domain.size()), shortest = smallest_entry(domain.size());
    const double cell = std::max(longest / most_cells,
                                 std::min(longest / least_cells, shortest / cells_of_shortest));
    for (int axis = 0; axis < Dim; ++axis)
      cells_along_[at(axis)] =
          std::max(2, static_cast<int>(std::lround(domain.size()[axis] / cell)));
    for (int axis = 0; axis < Dim; ++axis)
      for (const bool upper : {false, true})
        if (field.at(axis, upper) == Boundary::elastic) add_side(axis, upper);
  }

  [[nodiscard]] const std::vector<Vec<Dim>>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  [[nodiscard]] int node_count() const { return static_cast<int>(nodes_.size()); }
  /// Cells along an axis.
  [[nodiscard]] int cells_along(int axis) const { return cells_along_[at(axis)]; }

  /// Whether a node cannot move along an axis: it lies on a plane of rollers at right angles to it.
  [[nodiscard]] bool is_held(int node, int axis) const {
    const int place = grid_of_node_[at(node)][at(axis)];
    return (place == 0 && field_.at(axis, false) == Boundary::rollers) ||
           (place == cells_along_[at(axis)] && field_.at(axis, true) == Boundary::rollers);
  }

  /// Where a point of an elastic side is.
  [[nodiscard]] Place place_of_point(SideOf<Dim> side, const Vec<Dim>& point) const {
    const auto [axis, upper] = place_of<Dim>(side);
    VOUSSOIR_ASSERT(field_.at(axis, upper) == Boundary::elastic, "elastic ground has nodes");
    Grid low{};
    std::array<double, Dim> along{};
    for (int k = 0; k < Dim; ++k) {
      const int count = cells_along_[at(k)];
      const double grid = count * (point[k] - domain_.low[k]) / domain_.size()[k];
      low[at(k)] = std::clamp(static_cast<int>(std::floor(grid)), 0, count - 1);
      along[at(k)] = grid - low[at(k)];
    }
    low[at(axis)] = upper ? cells_along_[at(axis)] : 0;
    Place place{};
    for (int corner = 0; corner < corners; ++corner) {
      Grid grid = low;
      double share = 1;
      for_axes_of_side(axis, [&](int k, int bit) {
        const bool is_upper = ((corner >> bit) & 1) != 0;
        grid[at(k)] += is_upper ? 1 : 0;
        share *= is_upper ? along[at(k)] : 1 - along[at(k)];
      });
      place.nodes[at(corner)] = node_at_.at(grid);
      place.shares[at(corner)] = share;
    }
    return place;
  }

 private:
  using Grid = std::array<int, Dim>;

  template <class T>
  [[nodiscard]] static std::size_t at(T k) {
    return static_cast<std::size_t>(k);
  }
  /// visit(axis, which of the side's axes it is)
  template <class Visit>
  static void for_axes_of_side(int normal_axis, Visit&& visit) {
    int bit = 0;
    for (int k = 0; k < Dim; ++k)
      if (k != normal_axis) visit(k, bit++);
  }

  void add_side(int axis, bool upper) {
    Grid grid{};
    grid[at(axis)] = upper ? cells_along_[at(axis)] : 0;
    add_cells(axis, 0, grid);
  }
  /// All cells of a side, by their lowest corners: axes `from` and higher run.
  void add_cells(int normal_axis, int from, Grid& grid) {
    if (from == normal_axis) return add_cells(normal_axis, from + 1, grid);
    if (from == Dim) return add_cell(normal_axis, grid);
    for (grid[at(from)] = 0; grid[at(from)] < cells_along_[at(from)]; ++grid[at(from)])
      add_cells(normal_axis, from + 1, grid);
    grid[at(from)] = 0;
  }
  void add_cell(int normal_axis, const Grid& low) {
    Cell cell{};
    for (int corner = 0; corner < corners; ++corner) {
      Grid grid = low;
      for_axes_of_side(normal_axis, [&](int k, int bit) { grid[at(k)] += (corner >> bit) & 1; });
      cell[at(corner)] = node(grid);
    }
    cells_.push_back(cell);
  }
  int node(const Grid& grid) {
    const auto [it, is_new] = node_at_.emplace(grid, node_count());
    if (is_new) {
      Vec<Dim> place;
      for (int k = 0; k < Dim; ++k)
        place[k] = domain_.low[k] + domain_.size()[k] * grid[at(k)] / cells_along_[at(k)];
      nodes_.push_back(place);
      grid_of_node_.push_back(grid);
    }
    return it->second;
  }

  Domain<Dim> domain_;
  FarField<Dim> field_;
  std::array<int, Dim> cells_along_{};
  std::map<Grid, int> node_at_;
  std::vector<Vec<Dim>> nodes_;
  std::vector<Grid> grid_of_node_;
  std::vector<Cell> cells_;
};

}  // namespace voussoir
