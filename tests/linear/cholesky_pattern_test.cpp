// SPDX-License-Identifier: MIT
// What a factor will be, beside an elimination of one body after the other.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <vector>
#include <voussoir/linear/cholesky_pattern.hpp>

#include "linear/graphs.hpp"

namespace cholesky_pattern_test {

using namespace voussoir;
using voussoir_test::BodyPairs, voussoir_test::graphs_of_all_kinds;

namespace {

std::vector<int> order_of(const CholeskyPattern& pattern) {
  std::vector<int> order;
  for (int k = 0; k < pattern.size(); ++k) order.push_back(pattern.original(k));
  return order;
}

std::vector<int> as_numbered(int size) {
  std::vector<int> order;
  for (int k = 0; k < size; ++k) order.push_back(k);
  return order;
}

}  // namespace

TEST_SUITE("linear/cholesky_pattern") {
  TEST_CASE("operations and blocks are those of an elimination, whatever the order") {
    for (const BodyPairs& graph : graphs_of_all_kinds())
      for (const int dof : {1, 3, 6}) {
        CAPTURE(graph.size);
        CAPTURE(graph.pairs.size());
        const CholeskyPattern found(dof, graph.size, graph.pairs),
            given(dof, as_numbered(graph.size), graph.pairs);
        for (const CholeskyPattern* pattern : {&found, &given}) {
          double operations = 0, blocks = 0;
          for (const auto& column : columns_of_factor(graph, order_of(*pattern))) {
            blocks += static_cast<double>(column.size());
            // The first of its columns of numbers has all rows, the next one less, ...
            for (std::size_t k = 0; k < static_cast<std::size_t>(dof); ++k) {
              const auto rows =
                  static_cast<double>(static_cast<std::size_t>(dof) * column.size() - k);
              operations += rows * rows;
            }
          }
          CHECK(pattern->operations() == operations);
          CHECK(pattern->block_count() == blocks);
        }
        // A postorder fills in as much as the order it was made from.
        double blocks = 0;
        for (const auto& column : columns_of_factor(graph, as_numbered(graph.size)))
          blocks += static_cast<double>(column.size());
        CHECK(given.block_count() == blocks);
      }
  }

  TEST_CASE("fronts hold the factor, and little else") {
    for (const BodyPairs& graph : graphs_of_all_kinds()) {
      CAPTURE(graph.size);
      CAPTURE(graph.pairs.size());
      const CholeskyPattern pattern(3, graph.size, graph.pairs);
      const auto columns = columns_of_factor(graph, order_of(pattern));
      int next = 0;
      std::size_t places = 0;
      double stored = 0;
      for (std::size_t f = 0; f < pattern.fronts().size(); ++f) {
        const auto& front = pattern.fronts()[f];
        CHECK(front.first == next);
        next = front.last;
        stored += 9.0 * front.columns() * front.rows();
        std::vector<int> rows;
        for (int k = front.first; k < front.last; ++k) rows.push_back(k);
        for (std::size_t k = front.begin; k < front.end; ++k) rows.push_back(pattern.row(k));
        CHECK(std::is_sorted(rows.begin(), rows.end()));
        // Just the rows of its columns, all taken together.
        std::set<int> all;
        for (int k = front.first; k < front.last; ++k) {
          const auto& column = columns[static_cast<std::size_t>(k)];
          all.insert(column.begin(), column.end());
        }
        CHECK(rows == std::vector<int>(all.begin(), all.end()));
        // The parent has the rows below, where it is said.
        if (front.parent < 0) {
          CHECK(front.begin == front.end);
        } else {
          const auto& parent = pattern.fronts()[static_cast<std::size_t>(front.parent)];
          CHECK(front.parent > static_cast<int>(f));
          CHECK(parent.youngest <= front.youngest);
          for (std::size_t k = front.begin; k < front.end; ++k) {
            const int at = pattern.in_parent()[k];
            CHECK(pattern.row(k) == (at < parent.columns()
                                         ? parent.first + at
                                         : pattern.row(parent.begin + static_cast<std::size_t>(
                                                                          at - parent.columns()))));
          }
        }
        for (std::size_t k = front.places; k < front.places_end; ++k) {
          const auto& place = pattern.places()[k];
          const auto& [i, j] =
              graph.pairs[static_cast<std::size_t>(place.pair < 0 ? ~place.pair : place.pair)];
          const int row = rows[static_cast<std::size_t>(place.row)],
                    column = front.first + place.column;
          CHECK(pattern.original(row) == (place.pair < 0 ? j : i));
          CHECK(pattern.original(column) == (place.pair < 0 ? i : j));
          CHECK(row > column);
          ++places;
        }
      }
      CHECK(next == graph.size);
      CHECK(places == graph.pairs.size());
      CHECK(pattern.stored_numbers() == stored);
      CHECK(pattern.most_numbers() >= stored);
    }
  }

  TEST_CASE("a pattern knows its pairs") {
    const BodyPairs grid = voussoir_test::grid_pairs(6, 5, 1, false);
    const CholeskyPattern pattern(3, grid.size, grid.pairs);
    CHECK(pattern.is_for(grid.size, grid.pairs));
    CHECK_FALSE(pattern.is_for(grid.size + 1, grid.pairs));
    auto others = grid.pairs;
    std::swap(others.front(), others.back());
    CHECK_FALSE(pattern.is_for(grid.size, others));
    others = grid.pairs;
    others.pop_back();
    CHECK_FALSE(pattern.is_for(grid.size, others));
  }
}

}  // namespace cholesky_pattern_test
