// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/drawing/contour.hpp>

namespace voussoir {

namespace detail {

/// Slopes of a cubic that nowhere overshoots its data: harmonic means of the neighbouring chords,
/// zero at a turning point. Source: Fritsch & Butland (1984), SIAM J. Sci. Stat. Comput. 5,
/// 300-304. Straight data keep their slope exactly. At the ends the chord itself.
VOUSSOIR_INLINE std::vector<double> monotone_slopes(const std::vector<double>& x,
                                                    const std::vector<double>& v);

/// Values between the data, `parts` to an interval; NaN in every interval with a missing end.
VOUSSOIR_INLINE std::vector<double> refined_values(const std::vector<double>& x,
                                                   const std::vector<double>& v, std::size_t parts);

VOUSSOIR_INLINE std::vector<double> refined_lines(const std::vector<double>& lines,
                                                  std::size_t parts);

}  // namespace detail

/// A finer grid through the same values, for smooth contours: monotone cubics along x, then along
/// y. Passes through the data, makes no maximum between them, keeps linear data linear. In a cell
/// with one corner missing the half next to the other three corners is filled linearly.
///
/// @param parts  intervals of the result for one of `grid`, >= 1
/// @throws InvalidInput  parts < 1, fewer than 2 lines in x or y, value of another size
[[nodiscard]] VOUSSOIR_INLINE ContourGrid refined(const ContourGrid& grid, int parts);

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE std::vector<double> monotone_slopes(const std::vector<double>& x,
                                                    const std::vector<double>& v) {
  const std::size_t count = x.size();
  std::vector<double> slope(count, 0.0);
  const auto chord = [&](std::size_t i) { return (v[i + 1] - v[i]) / (x[i + 1] - x[i]); };
  slope.front() = chord(0);
  slope.back() = chord(count - 2);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double before = chord(i - 1), after = chord(i);
    if (before * after <= 0) continue;
    const double h = x[i] - x[i - 1], k = x[i + 1] - x[i];
    slope[i] = 3 * (h + k) / ((2 * k + h) / before + (k + 2 * h) / after);
  }
  return slope;
}

VOUSSOIR_INLINE std::vector<double> refined_values(const std::vector<double>& x,
                                                   const std::vector<double>& v,
                                                   std::size_t parts) {
  std::vector<double> result((x.size() - 1) * parts + 1, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t begin = 0; begin < x.size();) {  // runs without a gap
    std::size_t end = begin;
    while (end < x.size() && std::isfinite(v[end])) ++end;
    if (end - begin >= 2) {
      const auto from = static_cast<std::ptrdiff_t>(begin), to = static_cast<std::ptrdiff_t>(end);
      const std::vector<double> run_x(x.begin() + from, x.begin() + to);
      const std::vector<double> run_v(v.begin() + from, v.begin() + to);
      const std::vector<double> slope = monotone_slopes(run_x, run_v);
      for (std::size_t i = 0; i + 1 < run_x.size(); ++i) {
        const double width = run_x[i + 1] - run_x[i], rise = run_v[i + 1] - run_v[i];
        for (std::size_t k = 0; k <= parts; ++k) {
          const double t = static_cast<double>(k) / static_cast<double>(parts);
          // Hermite's cubic about the straight line, so that straight data stay straight.
          const double bend =
              t * (1 - t) *
              ((1 - t) * (slope[i] * width - rise) - t * (slope[i + 1] * width - rise));
          result[(begin + i) * parts + k] = k == parts ? run_v[i + 1] : run_v[i] + t * rise + bend;
        }
      }
    } else if (end - begin == 1) {
      result[begin * parts] = v[begin];
    }
    begin = end + 1;
  }
  return result;
}

VOUSSOIR_INLINE std::vector<double> refined_lines(const std::vector<double>& lines,
                                                  std::size_t parts) {
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    for (std::size_t k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(parts);
      result.push_back(lines[i] + t * (lines[i + 1] - lines[i]));
    }
  }
  result.push_back(lines.back());
  return result;
}

}  // namespace detail

VOUSSOIR_INLINE ContourGrid refined(const ContourGrid& grid, int parts) {
  const std::size_t columns = grid.x.size(), rows = grid.y.size();
  if (parts < 1 || columns < 2 || rows < 2 ||
      grid.value.rows() != static_cast<Eigen::Index>(columns) ||
      grid.value.cols() != static_cast<Eigen::Index>(rows)) {
    throw InvalidInput("refined: needs parts >= 1, 2 or more lines each way, a value a crossing");
  }
  const auto n = static_cast<std::size_t>(parts);
  ContourGrid fine{detail::refined_lines(grid.x, n), detail::refined_lines(grid.y, n), {}};
  const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };

  Eigen::MatrixXd along_x(fine.x.size(), rows);
  for (std::size_t j = 0; j < rows; ++j) {
    std::vector<double> row(columns);
    for (std::size_t i = 0; i < columns; ++i) row[i] = grid.value(at(i), at(j));
    const std::vector<double> values = detail::refined_values(grid.x, row, n);
    for (std::size_t i = 0; i < values.size(); ++i) along_x(at(i), at(j)) = values[i];
  }
  fine.value.resize(at(fine.x.size()), at(fine.y.size()));
  for (std::size_t i = 0; i < fine.x.size(); ++i) {
    std::vector<double> column(rows);
    for (std::size_t j = 0; j < rows; ++j) column[j] = along_x(at(i), at(j));
    const std::vector<double> values = detail::refined_values(grid.y, column, n);
    for (std::size_t j = 0; j < values.size(); ++j) fine.value(at(i), at(j)) = values[j];
  }

  for (std::size_t i = 0; i + 1 < columns; ++i) {
    for (std::size_t j = 0; j + 1 < rows; ++j) {
      const Eigen::Matrix2d corner = grid.value.block<2, 2>(at(i), at(j));
      if (corner.array().isFinite().count() != 3) continue;
      const int miss_x = std::isfinite(corner(1, 0)) && std::isfinite(corner(1, 1)) ? 0 : 1;
      const int miss_y = std::isfinite(corner(0, 1)) && std::isfinite(corner(1, 1)) ? 0 : 1;
      // s, t: distances from the corner opposite to the missing one, along the two full sides.
      const double origin = corner(1 - miss_x, 1 - miss_y);
      const double rise_x = corner(miss_x, 1 - miss_y) - origin;
      const double rise_y = corner(1 - miss_x, miss_y) - origin;
      for (int a = 0; a <= parts; ++a) {
        for (int b = 0; a + b <= parts; ++b) {
          double& value = fine.value(at(i) * parts + (miss_x == 0 ? parts - a : a),
                                     at(j) * parts + (miss_y == 0 ? parts - b : b));
          if (std::isfinite(value)) continue;  // on a side shared with a smooth cell
          value = origin + (a * rise_x + b * rise_y) / parts;
        }
      }
    }
  }
  return fine;
}

#endif

}  // namespace voussoir
