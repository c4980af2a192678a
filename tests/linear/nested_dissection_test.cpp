// SPDX-License-Identifier: MIT
// Orders by dissection: every body once, parts that no coupling joins, and as few operations as
// minimum degree needs.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>
#include <voussoir/linear/detail/dissection.hpp>
#include <voussoir/linear/detail/elimination_tree.hpp>
#include <voussoir/linear/nested_dissection.hpp>

#include "linear/graphs.hpp"

namespace nested_dissection_test {

using namespace voussoir;
using voussoir_test::BodyPairs, voussoir_test::grid_pairs, voussoir_test::graphs_of_all_kinds;

namespace {

bool has_each_once(int size, std::vector<int> order) {
  std::sort(order.begin(), order.end());
  std::vector<int> bodies(static_cast<std::size_t>(size));
  std::iota(bodies.begin(), bodies.end(), 0);
  return order == bodies;
}

detail::WeightedGraph weighted(const BodyPairs& bodies) {
  const detail::BodyGraph graph(bodies.size, bodies.pairs);
  detail::WeightedGraph all;
  all.begin = graph.begin;
  all.next = graph.next;
  all.ties = detail::ByIndex<int>(graph.next.size(), 1);
  all.weight = detail::ByIndex<int>(bodies.size, 1);
  all.total = bodies.size;
  return all;
}

double operations(const BodyPairs& bodies, const std::vector<int>& order) {
  const detail::BodyGraph graph(bodies.size, bodies.pairs);
  const detail::EliminationTree tree(graph, order);
  double sum = 0;
  for (const double count : tree.count.all()) sum += count * count;
  return sum;
}

std::vector<BodyPairs> large_graphs() {
  std::vector<BodyPairs> all{grid_pairs(50, 50, 1, false), grid_pairs(40, 60, 1, true),
                             grid_pairs(13, 13, 13, false), voussoir_test::path_pairs(3000),
                             voussoir_test::star_pairs(2000)};
  all.push_back(both(grid_pairs(30, 45, 1, true), grid_pairs(10, 10, 12, false)));
  all.push_back({1500, {}});
  Random random(5);
  all.push_back(voussoir_test::random_pairs(random, 1200, 5000));
  return all;
}

std::vector<BodyPairs> graphs_of_all_kinds_and_sizes() {
  auto all = graphs_of_all_kinds();
  for (const BodyPairs& large : large_graphs()) all.push_back(large);
  return all;
}

}  // namespace

TEST_SUITE("linear/nested_dissection") {
  TEST_CASE("every body has its place, the same one when asked again") {
    StopCheck never;
    for (const BodyPairs& bodies : graphs_of_all_kinds_and_sizes()) {
      CAPTURE(bodies.size);
      CAPTURE(bodies.pairs.size());
      const detail::BodyGraph graph(bodies.size, bodies.pairs);
      const std::vector<int> order = detail::Dissection(graph).order(never);
      CHECK(has_each_once(bodies.size, order));
      CHECK(detail::Dissection(graph).order(never) == order);
      for (const int dof : {3, 6})
        CHECK(has_each_once(bodies.size, nested_dissection_order(dof, bodies.size, bodies.pairs)));
    }
  }

  TEST_CASE("no coupling joins the parts, and little lies between them") {
    StopCheck never;
    for (const BodyPairs& bodies : graphs_of_all_kinds_and_sizes()) {
      CAPTURE(bodies.size);
      CAPTURE(bodies.pairs.size());
      const detail::ByIndex<char> side = detail::separate(weighted(bodies), never);
      REQUIRE(side.size() == bodies.size);
      for (const auto& [i, j] : bodies.pairs) CHECK(side[i] + side[j] != 1);
      for (int i = 0; i < bodies.size; ++i) CHECK((side[i] >= 0 && side[i] <= 2));
    }
    // A line across a square of 50 x 50 is the least that leaves parts of up to 70 % of it.
    const auto between = [&](const BodyPairs& bodies) {
      const detail::ByIndex<char> side = detail::separate(weighted(bodies), never);
      int count[3] = {0, 0, 0};
      for (const char s : side.all()) ++count[static_cast<int>(s)];
      CHECK(std::max(count[0], count[1]) <= 0.7 * bodies.size + 1);
      return count[2];
    };
    CHECK(between(grid_pairs(50, 50, 1, false)) <= 50);
    CHECK(between(grid_pairs(20, 100, 1, true)) <= 22);
    CHECK(between(grid_pairs(13, 13, 13, false)) <= 13 * 13 + 20);
    CHECK(between(voussoir_test::path_pairs(3000)) == 1);
    CHECK(between({1500, {}}) == 0);
  }

  TEST_CASE("a coarser graph has the same bodies and couplings, merged") {
    for (const BodyPairs& bodies : graphs_of_all_kinds()) {
      const detail::WeightedGraph fine = weighted(bodies);
      const detail::CoarserGraph coarse(fine, 2);
      int bodies_sum = 0;
      for (const int w : coarse.graph.weight.all()) {
        CHECK((w == 1 || w == 2));
        bodies_sum += w;
      }
      CHECK(bodies_sum == bodies.size);
      std::vector<std::vector<int>> ties(
          static_cast<std::size_t>(coarse.graph.size()),
          std::vector<int>(static_cast<std::size_t>(coarse.graph.size())));
      const auto tie = [&](int i, int j) -> int& {
        return ties[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      };
      for (const auto& [i, j] : bodies.pairs) {
        const int a = coarse.node_of[i], b = coarse.node_of[j];
        if (a == b) continue;
        ++tie(a, b);
        ++tie(b, a);
      }
      for (int i = 0; i < coarse.graph.size(); ++i)
        for (int k = coarse.graph.begin[i]; k < coarse.graph.begin[i + 1]; ++k) {
          CHECK(tie(i, coarse.graph.next[k]) == coarse.graph.ties[k]);
          tie(i, coarse.graph.next[k]) = 0;
        }
      for (const auto& row : ties)
        for (const int left : row) CHECK(left == 0);
    }
  }

  TEST_CASE("minimum degree of a part knows of what is around it, and leaves that out") {
    StopCheck never;
    // A row of four bodies; body 4, which is eliminated later, is coupled to the first three.
    const std::vector<std::pair<int, int>> pairs{{1, 0}, {2, 1}, {3, 2}, {4, 0}, {4, 1}, {4, 2}};
    detail::QuotientGraph part(5, pairs, 0, 4);
    // Body 3 has one neighbour; 0 and then 2 have two, and their elimination couples nothing new.
    CHECK(part.order(never).front() == 3);
    for (const BodyPairs& bodies : graphs_of_all_kinds())
      for (const int count : {bodies.size / 3, bodies.size / 2, bodies.size}) {
        CAPTURE(bodies.size);
        CAPTURE(count);
        detail::QuotientGraph some(bodies.size, bodies.pairs, 0, count);
        CHECK(has_each_once(count, some.order(never)));
      }
  }

  TEST_CASE("never more operations than minimum degree, in 3-D far fewer") {
    StopCheck never;
    for (const BodyPairs& bodies : large_graphs()) {
      CAPTURE(bodies.size);
      detail::QuotientGraph whole(bodies.size, bodies.pairs, 0);
      const double by_degree = operations(bodies, whole.order(never));
      for (const int dof : {3, 6})
        CHECK(operations(bodies, nested_dissection_order(dof, bodies.size, bodies.pairs)) <=
              by_degree);
    }
    const BodyPairs cube = grid_pairs(14, 14, 14, true);
    detail::QuotientGraph whole(cube.size, cube.pairs, 0);
    CHECK(operations(cube, nested_dissection_order(6, cube.size, cube.pairs)) <
          0.75 * operations(cube, whole.order(never)));
  }

  TEST_CASE("can be stopped") {
    const BodyPairs cube = grid_pairs(25, 25, 25, true);
    int asked = 0;
    CHECK_THROWS_AS((void)nested_dissection_order(6, cube.size, cube.pairs,
                                                  [&](double) { return ++asked < 5; }),
                    Stopped);
    CHECK(asked == 5);
  }
}

}  // namespace nested_dissection_test
