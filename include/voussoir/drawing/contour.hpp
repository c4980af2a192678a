// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// Values on a grid with uneven lines; NaN where there is none.
struct ContourGrid {
  std::vector<double> x, y;  ///< grid lines, strictly ascending
  Eigen::MatrixXd value;     ///< value(i, j) at (x[i], y[j])
};

/// Where the surface over a grid lies at or above a level, and the lines that bound it.
struct Contour {
  std::vector<std::vector<Vec2>> lines;   ///< on the level; closed ones repeat their first point
  std::vector<std::vector<Vec2>> region;  ///< closed outlines of {value >= level}; holes turn round
};

namespace detail {

/// Traces one level over triangles. A corner of the outline is a grid node (a, a), or the point
/// where the level crosses the edge (a, b): named by nodes, not by position, so that the outlines
/// of neighbouring triangles fit exactly whatever the rounding.
class ContourTracer {
 public:
  ContourTracer(const std::vector<Vec2>& points, const std::vector<double>& values, double level)
      : points_(points), values_(values), level_(level) {}

  void add_triangle(const std::array<int, 3>& nodes) {
    std::vector<Corner> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = nodes[k], b = nodes[(k + 1) % 3];
      if (is_high(a)) corners.emplace_back(a, a);
      if (is_high(a) != is_high(b)) corners.emplace_back(std::min(a, b), std::max(a, b));
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Corner &p = corners[k], &q = corners[(k + 1) % corners.size()];
      if (p.first != p.second && q.first != q.second) {
        level_edges_[p] = q;  // each crossing is left by one triangle and entered by one
      }
      // An edge that a neighbour walks the other way is inside the region: drop both.
      auto& neighbour = outline_edges_[q];
      if (const auto twin = std::find(neighbour.begin(), neighbour.end(), p);
          twin != neighbour.end()) {
        neighbour.erase(twin);
      } else {
        outline_edges_[p].push_back(q);
      }
    }
  }

  [[nodiscard]] Contour finish() {
    Contour contour;
    for (auto& [corner, next] : outline_edges_) {
      while (!next.empty()) contour.region.push_back(tidied(walk_outline(corner), true));
    }
    std::map<Corner, int> entered;
    for (const auto& [from, to] : level_edges_) ++entered[to];
    while (!level_edges_.empty()) {
      auto start = std::find_if(level_edges_.begin(), level_edges_.end(),
                                [&](const auto& edge) { return !entered.contains(edge.first); });
      if (start == level_edges_.end()) start = level_edges_.begin();  // closed lines are left
      contour.lines.push_back(tidied(walk_level(start->first), false));
    }
    std::erase_if(contour.lines, [](const auto& line) { return line.size() < 2; });
    std::erase_if(contour.region, [](const auto& loop) { return loop.size() < 3; });
    return contour;
  }

 private:
  using Corner = std::pair<int, int>;

  [[nodiscard]] double value(int node) const { return values_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] const Vec2& point(int node) const {
    return points_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] bool is_high(int node) const { return value(node) >= level_; }

  [[nodiscard]] Vec2 position(const Corner& corner) const {
    const auto [a, b] = corner;
    if (a == b) return point(a);
    return point(a) + (level_ - value(a)) / (value(b) - value(a)) * (point(b) - point(a));
  }

  std::vector<Vec2> walk_outline(const Corner& start) {
    std::vector<Vec2> loop;
    Corner corner = start;
    do {
      loop.push_back(position(corner));
      auto& next = outline_edges_[corner];
      const Corner to = next.back();
      next.pop_back();
      corner = to;
    } while (corner != start);
    return loop;
  }

  std::vector<Vec2> walk_level(const Corner& start) {
    std::vector<Vec2> line = {position(start)};
    for (auto edge = level_edges_.find(start); edge != level_edges_.end();) {
      const Corner to = edge->second;
      level_edges_.erase(edge);
      line.push_back(position(to));
      edge = level_edges_.find(to);
    }
    return line;
  }

  /// Without points that repeat or lie on the straight line between their neighbours.
  static std::vector<Vec2> tidied(const std::vector<Vec2>& points, bool is_closed) {
    std::vector<Vec2> result;
    for (const Vec2& p : points) {
      if (!result.empty() && (p - result.back()).norm() == 0) continue;
      while (result.size() >= 2 && is_straight(result[result.size() - 2], result.back(), p)) {
        result.pop_back();
      }
      result.push_back(p);
    }
    while (is_closed && result.size() > 3 &&
           is_straight(result[result.size() - 2], result.back(), result.front())) {
      result.pop_back();
    }
    return result;
  }
  static bool is_straight(const Vec2& p, const Vec2& middle, const Vec2& q) {
    const Vec2 before = middle - p, after = q - middle;
    return std::abs(cross(before, after)) <= 1e-10 * before.norm() * after.norm() &&
           before.dot(after) >= 0;
  }

  const std::vector<Vec2>& points_;
  const std::vector<double>& values_;
  double level_;
  std::map<Corner, std::vector<Corner>> outline_edges_;
  std::map<Corner, Corner> level_edges_;
};

}  // namespace detail

/// Contour of a surface made of triangles: each cell is split from its centre, whose value is the
/// mean of the four corners. Straight where the data are linear. A cell with one corner missing
/// counts as the triangle of the other three, with more missing it is left out.
///
/// @throws InvalidInput  fewer than 2 lines in x or y, lines not ascending, value of another size
[[nodiscard]] VOUSSOIR_INLINE Contour contour_at(const ContourGrid& grid, double level);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE Contour contour_at(const ContourGrid& grid, double level) {
  const auto columns = static_cast<int>(grid.x.size()), rows = static_cast<int>(grid.y.size());
  const auto ascends = [](const std::vector<double>& lines) {
    return std::adjacent_find(lines.begin(), lines.end(),
                              [](double a, double b) { return !(a < b); }) == lines.end();
  };
  if (columns < 2 || rows < 2 || grid.value.rows() != columns || grid.value.cols() != rows ||
      !ascends(grid.x) || !ascends(grid.y)) {
    throw InvalidInput("contour_at: needs 2 or more ascending lines each way, a value a crossing");
  }
  std::vector<Vec2> points;
  std::vector<double> values;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      points.emplace_back(grid.x[static_cast<std::size_t>(i)], grid.y[static_cast<std::size_t>(j)]);
      values.push_back(grid.value(i, j));
    }
  }
  const int node_count = columns * rows;
  for (int j = 0; j + 1 < rows; ++j) {  // the centres follow the nodes
    for (int i = 0; i + 1 < columns; ++i) {
      const int low = j * columns + i, high = low + columns + 1;
      const Vec2 centre =
          (points[static_cast<std::size_t>(low)] + points[static_cast<std::size_t>(high)]) / 2;
      points.push_back(centre);
      values.push_back(grid.value.block<2, 2>(i, j).mean());
    }
  }
  detail::ContourTracer tracer(points, values, level);
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const int corner = j * columns + i;
      const std::array<int, 4> all = {corner, corner + 1, corner + columns + 1, corner + columns};
      std::vector<int> known;  // anticlockwise
      for (const int node : all) {
        if (std::isfinite(values[static_cast<std::size_t>(node)])) known.push_back(node);
      }
      if (known.size() == 3) tracer.add_triangle({known[0], known[1], known[2]});
      if (known.size() < 4) continue;
      const int centre = node_count + j * (columns - 1) + i;
      for (std::size_t k = 0; k < 4; ++k) tracer.add_triangle({all[k], all[(k + 1) % 4], centre});
    }
  }
  return tracer.finish();
}

#endif

}  // namespace voussoir
