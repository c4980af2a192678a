// SPDX-License-Identifier: MIT
// The order of elimination: what it must be where the least fill is known, and Eigen's elsewhere.
#include <doctest/doctest.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/linear/block_elimination.hpp>
#include <voussoir/linear/detail/quotient_graph.hpp>
#include <voussoir/linear/minimum_degree.hpp>

namespace minimum_degree_test {

using namespace voussoir;

namespace {

using Pairs = std::vector<std::pair<int, int>>;

struct Graph {
  int size;
  Pairs pairs;
};

int below(Random& random, int count) {
  return static_cast<int>(random.below(static_cast<std::uint64_t>(count)));
}

/// Each pair once, in either order.
Graph cleaned(int size, Pairs pairs) {
  for (auto& [i, j] : pairs)
    if (i > j) std::swap(i, j);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::erase_if(pairs, [](const auto& p) { return p.first == p.second; });
  for (std::size_t k = 0; k < pairs.size(); k += 2) std::swap(pairs[k].first, pairs[k].second);
  return {size, pairs};
}

Graph random_graph(Random& random, int size, int pairs) {
  Pairs all;
  for (int k = 0; k < pairs && size > 0; ++k)
    all.emplace_back(below(random, size), below(random, size));
  return cleaned(size, all);
}

/// Points of a square, neighbours within a distance.
Graph near_points(Random& random, int size, double mean_degree) {
  std::vector<std::pair<double, double>> at(static_cast<std::size_t>(size));
  for (auto& [x, y] : at) {
    x = random.uniform();
    y = random.uniform();
  }
  Pairs all;
  const double limit = mean_degree / 3.14 / size;
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::pow(at[i].first - at[j].first, 2) + std::pow(at[i].second - at[j].second, 2) < limit)
        all.emplace_back(i, j);
  return cleaned(size, all);
}

/// Every row is coupled to earlier ones with many neighbours rather than few.
Graph hubs(Random& random, int size, int each) {
  Pairs all;
  std::vector<int> ends{0};
  for (int i = 1; i < size; ++i)
    for (int k = 0; k < each; ++k) {
      const int j = ends[static_cast<std::size_t>(below(random, static_cast<int>(ends.size())))];
      all.emplace_back(i, j);
      ends.insert(ends.end(), {i, j});
    }
  return cleaned(size, all);
}

/// Points of a grid, coupled to those no further in any direction than 1 and in their sum `reach`.
Graph grid(int nx, int ny, int nz, int reach) {
  Pairs all;
  for (int i = 0; i < nx * ny * nz; ++i)
    for (int j = 0; j < i; ++j) {
      const int x = std::abs(i % nx - j % nx), y = std::abs(i / nx % ny - j / nx % ny),
                z = std::abs(i / nx / ny - j / nx / ny);
      if (std::max({x, y, z}) == 1 && x + y + z <= reach) all.emplace_back(i, j);
    }
  return cleaned(nx * ny * nz, all);
}

/// A clique of `width` + 1, and every further row coupled to `width` that are each other's
/// neighbours: no fill is needed. A tree for width 1. Numbered at random.
Graph k_tree(Random& random, int size, int width) {
  std::vector<int> name(static_cast<std::size_t>(size));
  std::iota(name.begin(), name.end(), 0);
  for (int i = size; i-- > 1;)
    std::swap(name[static_cast<std::size_t>(i)],
              name[static_cast<std::size_t>(below(random, i + 1))]);
  Pairs all;
  std::vector<std::vector<int>> cliques(1);
  for (int i = 0; i < size; ++i) {
    std::vector<int> to = cliques[static_cast<std::size_t>(
        i <= width ? 0 : below(random, static_cast<int>(cliques.size())))];
    for (const int j : to)
      all.emplace_back(name[static_cast<std::size_t>(i)], name[static_cast<std::size_t>(j)]);
    to.push_back(i);
    if (i < width) {
      cliques[0] = to;
      continue;
    }
    for (std::size_t out = 0; out + 1 < to.size(); ++out) {
      cliques.push_back(to);
      cliques.back().erase(cliques.back().begin() + static_cast<std::ptrdiff_t>(out));
    }
  }
  return cleaned(size, all);
}

/// Of all columns of L, below the diagonal; the rows are eliminated one by one.
struct Fill {
  std::size_t blocks = 0;
  double operations = 0;  ///< squares of the column counts with the diagonal
};
Fill fill(const Graph& graph, const std::vector<int>& order) {
  const auto size = static_cast<std::size_t>(graph.size);
  std::vector<std::vector<char>> is_coupled(size, std::vector<char>(size, 0));
  for (const auto& [i, j] : graph.pairs)
    is_coupled[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
        is_coupled[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] = 1;
  Fill result;
  std::vector<char> is_gone(size, 0);
  for (const int p : order) {
    is_gone[static_cast<std::size_t>(p)] = 1;
    std::vector<std::size_t> column;
    for (std::size_t i = 0; i < size; ++i)
      if (is_coupled[static_cast<std::size_t>(p)][i] && !is_gone[i]) column.push_back(i);
    for (const std::size_t i : column)
      for (const std::size_t j : column) is_coupled[i][j] = 1;
    result.blocks += column.size();
    result.operations += std::pow(column.size() + 1, 2);
  }
  return result;
}

std::vector<int> eigen_order(const Graph& graph) {
  std::vector<Eigen::Triplet<char>> entries;
  for (int i = 0; i < graph.size; ++i) entries.emplace_back(i, i, 1);
  for (const auto& [i, j] : graph.pairs) {
    entries.emplace_back(i, j, 1);
    entries.emplace_back(j, i, 1);
  }
  Eigen::SparseMatrix<char> matrix(graph.size, graph.size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(matrix, permutation);
  return {permutation.indices().data(), permutation.indices().data() + graph.size};
}

bool has_each_row_once(int size, std::vector<int> order) {
  std::sort(order.begin(), order.end());
  std::vector<int> rows(static_cast<std::size_t>(size));
  std::iota(rows.begin(), rows.end(), 0);
  return order == rows;
}

std::vector<Graph> many_graphs() {
  Random random(21);
  std::vector<Graph> all;
  for (const int size : {10, 40, 150})
    for (int k = 0; k < 12; ++k) {
      all.push_back(random_graph(random, size, size * (1 + k % 4) / 2));
      all.push_back(near_points(random, size, 3 + k % 6));
      all.push_back(hubs(random, size, 1 + k % 3));
    }
  all.push_back(grid(12, 12, 1, 1));
  all.push_back(grid(12, 12, 1, 2));
  all.push_back(grid(6, 6, 6, 1));
  all.push_back(grid(5, 6, 5, 3));
  return all;
}

}  // namespace

TEST_SUITE("linear/minimum_degree") {
  TEST_CASE("every row has its place, and L the blocks of an elimination row by row") {
    for (const Graph& graph : many_graphs()) {
      CAPTURE(graph.size);
      CAPTURE(graph.pairs.size());
      const std::vector<int> order = minimum_degree_order(graph.size, graph.pairs);
      REQUIRE(has_each_row_once(graph.size, order));
      const BlockElimination elimination(graph.size, graph.pairs);
      for (std::size_t k = 0; k < order.size(); ++k) CHECK(elimination.original(k) == order[k]);
      CHECK(elimination.block_count() == fill(graph, order).blocks);
    }
  }

  TEST_CASE("the operations by which orders are compared are those of the factor") {
    int exact = 0, all = 0;
    StopCheck never;
    for (const Graph& graph : many_graphs())
      for (const int first : {0, graph.size / 3}) {
        CAPTURE(graph.size);
        detail::QuotientGraph quotient(graph.size, graph.pairs, first);
        const std::vector<int> order = quotient.order(never);
        // A bound only where a variable is merged with the pivot that has all its neighbours.
        const double counted = fill(graph, order).operations;
        CHECK(counted <= quotient.operations());
        CHECK(counted > 0.85 * quotient.operations());
        exact += counted == quotient.operations();
        ++all;
      }
    CHECK(exact > 0.7 * all);
  }

  TEST_CASE("no fill where none is needed: trees, triangles; hardly any in thicker ones") {
    Random random(22);
    for (const int width : {1, 2, 3, 6})
      for (int k = 0; k < 20; ++k) {
        const Graph graph = k_tree(random, 8 + 10 * k, width);
        CAPTURE(width);
        CAPTURE(graph.size);
        const auto extra =
            BlockElimination(graph.size, graph.pairs).block_count() - graph.pairs.size();
        // From width 3 on the bound of a degree may miss a row that needs none.
        CHECK(extra <= (width < 3 ? 0 : 1 + graph.pairs.size() / 50));
      }
  }

  TEST_CASE("a ring needs one block more for every row but three") {
    for (const int size : {4, 5, 30, 1001}) {
      Pairs ring;
      for (int i = 0; i < size; ++i) ring.emplace_back(i, (i + 1) % size);
      CHECK(BlockElimination(size, ring).block_count() == static_cast<std::size_t>(2 * size - 3));
    }
  }

  TEST_CASE("nothing, one row, rows alone, a clique") {
    CHECK(minimum_degree_order(0, {}).empty());
    CHECK(minimum_degree_order(1, {}) == std::vector{0});
    CHECK(minimum_degree_order(4, {}) == std::vector{0, 1, 2, 3});
    CHECK(BlockElimination(0, {}).block_count() == 0);
    const Graph clique = grid(3, 3, 1, 2);  // of the nine the one in the middle has all others
    CHECK(has_each_row_once(9, minimum_degree_order(9, clique.pairs)));
    Random random(23);
    const Graph full = k_tree(random, 30, 29);
    CHECK(full.pairs.size() == 435);
    CHECK(BlockElimination(30, full.pairs).block_count() == 435);
  }

  TEST_CASE("parts that are not coupled do not change each other's fill, and stand together") {
    const Graph one = grid(7, 7, 1, 2);
    const auto alone = fill(one, minimum_degree_order(one.size, one.pairs)).blocks;
    Graph two{2 * one.size, one.pairs};
    for (const auto& [i, j] : one.pairs) two.pairs.emplace_back(one.size + i, one.size + j);
    const std::vector<int> order = minimum_degree_order(two.size, two.pairs);
    const double ratio =
        static_cast<double>(fill(two, order).blocks) / static_cast<double>(2 * alone);
    CHECK(ratio > 0.9);
    CHECK(ratio < 1.1);
    int changes = 0;
    for (std::size_t k = 1; k < order.size(); ++k)
      changes += (order[k] < one.size) != (order[k - 1] < one.size);
    CHECK(changes == 1);
  }

  TEST_CASE("a row that is coupled to all others goes last, at once if there are many") {
    for (const int size : {5, 20, 3000}) {
      CAPTURE(size);
      Pairs star;
      for (int i = 0; i < size; ++i)
        if (i != 2) star.emplace_back(2, i);
      CHECK(BlockElimination(size, star).block_count() == star.size());
      if (size < 3000) continue;
      // After a triangle too, although row 2 would be alone before that.
      star.insert(star.end(), {{size, size + 1}, {size, size + 2}, {size + 1, size + 2}});
      CHECK(minimum_degree_order(size + 3, star).back() == 2);
    }
    // Two such rows of a path, which keeps its order but for them.
    Pairs path;
    for (int i = 0; i + 1 < 2000; ++i) path.emplace_back(i, i + 1);
    for (int i = 0; i < 2000; ++i) path.insert(path.end(), {{2000, i}, {i, 2001}});
    path.emplace_back(2001, 2000);
    CHECK(BlockElimination(2002, path).block_count() == path.size());
  }

  TEST_CASE("the order is a function of the pairs, those given twice or turned round included") {
    for (const Graph& graph : many_graphs()) {
      const std::vector<int> order = minimum_degree_order(graph.size, graph.pairs);
      CHECK(minimum_degree_order(graph.size, graph.pairs) == order);
      Pairs twice = graph.pairs;
      for (const auto& [i, j] : graph.pairs) twice.emplace_back(j, i);
      twice.insert(twice.end(), graph.pairs.begin(), graph.pairs.end());
      CHECK(minimum_degree_order(graph.size, twice) == order);
    }
    // Row 0 goes first, being the first of four equals. Its neighbours 1 and 3 are then the same,
    // and 2 has no others: it goes before them.
    CHECK(minimum_degree_order(4, {{0, 1}, {1, 2}, {3, 2}, {3, 0}}) == std::vector{0, 2, 1, 3});
  }

  TEST_CASE("fill and operations are those of Eigen's order but for a few percent") {
    Random random(24);
    std::vector<Graph> graphs;
    for (int k = 0; k < 15; ++k) {
      graphs.push_back(random_graph(random, 300, 150 * (2 + k % 3)));
      graphs.push_back(near_points(random, 300, 4 + k % 4));
      graphs.push_back(hubs(random, 300, 1 + k % 3));
    }
    for (const int n : {10, 14, 17, 20}) {
      graphs.push_back(grid(n, n, 1, 1));
      graphs.push_back(grid(n, n + 1, 1, 2));
    }
    for (const int n : {4, 6, 8}) {
      graphs.push_back(grid(n, n, n, 1));
      graphs.push_back(grid(n, n, n - 1, 3));
    }
    double log_blocks = 0, log_operations = 0;
    for (const Graph& graph : graphs) {
      CAPTURE(graph.size);
      CAPTURE(graph.pairs.size());
      const Fill ours = fill(graph, minimum_degree_order(graph.size, graph.pairs)),
                 theirs = fill(graph, eigen_order(graph));
      const double blocks = static_cast<double>(ours.blocks) / static_cast<double>(theirs.blocks),
                   operations = ours.operations / theirs.operations;
      CHECK(blocks < 1.1);
      CHECK(operations < 1.3);
      log_blocks += std::log(blocks);
      log_operations += std::log(operations);
    }
    const auto count = static_cast<double>(graphs.size());
    CAPTURE(std::exp(log_blocks / count));
    CAPTURE(std::exp(log_operations / count));
    CHECK(log_blocks < 0.01 * count);
    CHECK(log_operations < 0.01 * count);
  }

  TEST_CASE("where operations are many the best of four orders is taken") {
    const Graph graph = grid(10, 10, 10, 1);
    const std::vector<int> taken = minimum_degree_order(graph.size, graph.pairs);
    std::vector<int> best;
    double first = 0, least = 1e300;
    StopCheck never;
    for (int quarter = 0; quarter < 4; ++quarter) {
      detail::QuotientGraph quotient(graph.size, graph.pairs, graph.size / 4 * quarter);
      const std::vector<int> order = quotient.order(never);
      if (quarter == 0) first = quotient.operations();
      if (quotient.operations() < least) best = order;
      least = std::min(least, quotient.operations());
    }
    CHECK(taken == best);
    CHECK(least < first);
    CHECK(first > 500.0 * static_cast<double>(1000 + graph.pairs.size()));
  }
}

}  // namespace minimum_degree_test
