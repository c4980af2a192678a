// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>

/// Graphs of bodies for the tests of orders and factors, and what a factor is by plain elimination.
namespace voussoir_test {

struct BodyPairs {
  int size;
  std::vector<std::pair<int, int>> pairs;  ///< each once, the greater number first
};

[[nodiscard]] inline BodyPairs each_once(int size, std::vector<std::pair<int, int>> pairs) {
  for (auto& [i, j] : pairs)
    if (i < j) std::swap(i, j);
  std::erase_if(pairs, [](const auto& p) { return p.first == p.second; });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return {size, pairs};
}

[[nodiscard]] inline BodyPairs random_pairs(voussoir::Random& random, int size, int count) {
  std::vector<std::pair<int, int>> pairs;
  const auto any = [&] { return static_cast<int>(random.below(static_cast<std::uint64_t>(size))); };
  for (int k = 0; k < count; ++k) {
    const int i = any();
    pairs.emplace_back(i, any());
  }
  return each_once(size, pairs);
}

/// Neighbours in a grid of nx * ny * nz points; with `diagonal` also across a square or cube.
[[nodiscard]] inline BodyPairs grid_pairs(int nx, int ny, int nz, bool diagonal) {
  std::vector<std::pair<int, int>> pairs;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        for (int dz = 0; dz <= 1; ++dz)
          for (int dy = -dz; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
              if (!diagonal && std::abs(dx) + std::abs(dy) + dz != 1) continue;
              const int u = x + dx, v = y + dy, w = z + dz;
              if (u < 0 || u >= nx || v < 0 || v >= ny || w >= nz) continue;
              pairs.emplace_back((z * ny + y) * nx + x, (w * ny + v) * nx + u);
            }
  return each_once(nx * ny * nz, pairs);
}

/// Body 0 and its neighbours, which have no others.
[[nodiscard]] inline BodyPairs star_pairs(int size) {
  std::vector<std::pair<int, int>> pairs;
  for (int i = 1; i < size; ++i) pairs.emplace_back(i, 0);
  return each_once(size, pairs);
}

[[nodiscard]] inline BodyPairs path_pairs(int size) { return grid_pairs(size, 1, 1, false); }

[[nodiscard]] inline BodyPairs all_pairs(int size) {
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < i; ++j) pairs.emplace_back(i, j);
  return each_once(size, pairs);
}

/// Side by side, without a coupling between them.
[[nodiscard]] inline BodyPairs both(const BodyPairs& a, const BodyPairs& b) {
  BodyPairs sum{a.size + b.size, a.pairs};
  for (const auto& [i, j] : b.pairs) sum.pairs.emplace_back(a.size + i, a.size + j);
  return sum;
}

/// Every kind that an order or a factor may meet: none, single, apart, in a row, all to all.
[[nodiscard]] inline std::vector<BodyPairs> graphs_of_all_kinds() {
  voussoir::Random random(31);
  std::vector<BodyPairs> all{{0, {}},
                             {1, {}},
                             {7, {}},
                             star_pairs(40),
                             path_pairs(50),
                             all_pairs(25),
                             grid_pairs(12, 11, 1, false),
                             grid_pairs(9, 9, 1, true),
                             grid_pairs(5, 4, 6, false),
                             grid_pairs(4, 4, 4, true)};
  for (int k = 1; k < 8; ++k) all.push_back(random_pairs(random, 30 * k, 25 * k * (1 + k % 4)));
  all.push_back(both(both(star_pairs(9), all_pairs(12)), both({3, {}}, path_pairs(20))));
  return all;
}

/// The rows of every column of the factor, the diagonal included, by elimination of one body after
/// the other.
[[nodiscard]] inline std::vector<std::vector<int>> columns_of_factor(
    const BodyPairs& graph, const std::vector<int>& order) {
  const auto size = static_cast<std::size_t>(graph.size);
  std::vector<std::size_t> place(size);
  for (std::size_t k = 0; k < size; ++k) place[static_cast<std::size_t>(order[k])] = k;
  std::vector<std::vector<char>> is_coupled(size, std::vector<char>(size, 0));
  for (const auto& [i, j] : graph.pairs) {
    const std::size_t a = place[static_cast<std::size_t>(i)],
                      b = place[static_cast<std::size_t>(j)];
    is_coupled[std::min(a, b)][std::max(a, b)] = 1;
  }
  std::vector<std::vector<int>> columns(size);
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t i = k; i < size; ++i)
      if (i == k || is_coupled[k][i]) columns[k].push_back(static_cast<int>(i));
    for (const int i : columns[k])
      for (const int j : columns[k])
        if (static_cast<std::size_t>(i) > k && j > i)
          is_coupled[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = 1;
  }
  return columns;
}

}  // namespace voussoir_test
