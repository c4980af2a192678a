// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/rockmass/detail/place_order.hpp>
#include <voussoir/rockmass/domain.hpp>

namespace voussoir::detail {

/// Joins convex cells of one block across seams where what comes of it is convex: the longest seams
/// first, of equals by `PlaceOrder`. Corners in the middle of a straight face are left out.
///
/// @param cells    with shared corners the same, bit for bit; those that went into others are empty
/// @param body     of every cell
/// @param is_seam  of every label
/// @param domain   its tolerance is that of what is straight
/// @return  for every cell, the one that it went into
[[nodiscard]] VOUSSOIR_INLINE std::vector<std::size_t> join_cells(
    std::vector<ConvexPolygon>& cells, const std::vector<std::size_t>& body,
    const std::vector<bool>& is_seam, const Domain<2>& domain, StopCheck& stop);

#if VOUSSOIR_BODIES

/// Leaves out corners between two faces of one label.
VOUSSOIR_INLINE void straighten(std::vector<Vec2>& corners, std::vector<int>& labels) {
  for (std::size_t k = labels.size(); k-- > 0 && labels.size() > 3;) {
    // The cut of a face is on one line: two faces of one cut, one after the other, are one.
    const std::size_t before = k == 0 ? labels.size() - 1 : k - 1;
    if (labels[before] != labels[k]) continue;
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(k));
    labels.erase(labels.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

VOUSSOIR_INLINE std::vector<std::size_t> join_cells(std::vector<ConvexPolygon>& cells,
                                                    const std::vector<std::size_t>& body,
                                                    const std::vector<bool>& is_seam,
                                                    const Domain<2>& domain, StopCheck& stop) {
  const double tolerance = domain.tolerance();
  const PlaceOrder order(domain);
  struct Part {
    std::vector<Vec2> corners;
    std::vector<int> labels;
  };
  std::vector<Part> parts;
  std::vector<std::size_t> into(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    into[c] = c;
    Part part{cells[c].vertices(), {}};
    for (std::size_t k = 0; k < cells[c].size(); ++k) part.labels.push_back(cells[c].cut(k));
    straighten(part.corners, part.labels);
    parts.push_back(std::move(part));
  }
  using Edge = std::tuple<std::size_t, double, double, double, double>;
  const auto edge_of = [&](std::size_t c, std::size_t k) {
    const Part& part = parts[c];
    const Vec2 &a = part.corners[k], &b = part.corners[k + 1 == part.corners.size() ? 0 : k + 1];
    return Edge(body[c], a.x(), a.y(), b.x(), b.y());
  };
  const auto convex_at = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 in = b - a, out = c - b;
    const double turn = cross(in, out);
    // Straight to the tolerance is straight; back on itself is not, as beside the end of a slit.
    const bool is_straight = std::abs(turn) <= tolerance * std::max(length_of(in), length_of(out));
    return is_straight ? dot_product(in, out) > 0 : turn > 0;
  };
  const auto join = [&](std::size_t a, std::size_t i, std::size_t b, std::size_t j) {
    const Part &p = parts[a], &q = parts[b];
    const std::size_t n = p.corners.size(), m = q.corners.size();
    const auto of = [](const Part& part, std::size_t k) {
      return part.corners[k % part.corners.size()];
    };
    // The seam runs from corner i to i + 1 of one, from j to j + 1 of the other, the other way.
    if (!convex_at(of(p, i + n - 1), of(p, i), of(q, j + 2)) ||
        !convex_at(of(q, j + m - 1), of(q, j), of(p, i + 2)))
      return false;
    Part joined;
    for (std::size_t k = 1; k < n; ++k) {
      joined.corners.push_back(of(p, i + k));
      joined.labels.push_back(p.labels[(i + k) % n]);
    }
    for (std::size_t k = 1; k < m; ++k) {
      joined.corners.push_back(of(q, j + k));
      joined.labels.push_back(q.labels[(j + k) % m]);
    }
    straighten(joined.corners, joined.labels);
    parts[a] = std::move(joined);
    parts[b] = {};
    into[b] = a;
    return true;
  };
  for (bool has_joined = true; has_joined;) {
    has_joined = false;
    std::map<Edge, std::pair<std::size_t, std::size_t>> edges;
    for (std::size_t c = 0; c < parts.size(); ++c)
      for (std::size_t k = 0; k < parts[c].corners.size(); ++k)
        if (is_seam[static_cast<std::size_t>(parts[c].labels[k])])
          edges.emplace(edge_of(c, k), std::pair(c, k));
    std::vector<std::tuple<double, PlaceOrder::Key, Edge, Edge>> seams;
    for (const auto& [edge, place] : edges) {
      const auto& [b, ax, ay, bx, by] = edge;
      const Edge back(b, bx, by, ax, ay);
      if (edges.contains(back) && edge < back)
        seams.emplace_back(-to_micrometre(std::hypot(bx - ax, by - ay)),
                           order(0.5 * Vec2(ax + bx, ay + by)), edge, back);
    }
    std::sort(seams.begin(), seams.end());
    std::vector<char> is_touched(parts.size(), 0);
    for (const auto& [length, place, edge, back] : seams) {
      stop();
      const auto [a, i] = edges.at(edge);
      const auto [b, j] = edges.at(back);
      if (a == b || is_touched[a] || is_touched[b] || !join(a, i, b, j)) continue;
      is_touched[a] = is_touched[b] = 1;
      has_joined = true;
    }
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (parts[c].corners.empty()) {
      cells[c] = {};
      continue;
    }
    cells[c] = ConvexPolygon::trusted(std::move(parts[c].corners), std::move(parts[c].labels));
  }
  for (std::size_t c = 0; c < into.size(); ++c)
    while (into[into[c]] != into[c]) into[c] = into[into[c]];
  return into;
}

#endif

}  // namespace voussoir::detail
