// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <memory>
#include <utility>
#include <vector>
#include <voussoir/core/parallel.hpp>
#include <voussoir/linear/elastic_solver.hpp>
#include <voussoir/linear/pattern_store.hpp>

#include "linear/rigid_network.hpp"

namespace pattern_store_test {

using namespace voussoir;
using namespace voussoir_test;

TEST_SUITE("linear/pattern_store") {
  TEST_CASE("the same pairs have the same pattern, others or other unknowns another") {
    PatternStore store;
    const std::vector<std::pair<int, int>> pairs{{1, 0}, {2, 1}}, others{{1, 0}, {2, 0}};
    const auto first = store.pattern(3, 3, pairs);
    CHECK(store.pattern(3, 3, pairs) == first);
    CHECK(store.pattern(6, 3, pairs) != first);
    CHECK(store.pattern(3, 4, pairs) != first);
    CHECK(store.pattern(3, 3, others) != first);
    CHECK(store.pattern(3, 3, pairs) == first);  // the fourth pattern has not put it out
    const std::vector<std::pair<int, int>> fifth{{2, 0}};
    (void)store.pattern(3, 3, fifth);
    CHECK(store.pattern(3, 3, pairs) != first);  // the fifth has
  }

  TEST_CASE("a kept pattern changes no bit of an answer, on one thread or many") {
    Random random(61);
    const auto network = rigid_network<3>(random, {.side = 25});
    const Eigen::VectorXd f = random_forces(random, 3 * network.matrix.size());
    const auto answer = [&](std::shared_ptr<PatternStore> store) {
      Eigen::VectorXd u = f;
      ElasticSolver<3> solver(network.matrix, network.centres, {.method = LinearMethod::direct}, {},
                              std::move(store));
      (void)solver.solve_in_place(u, {});
      return u;
    };
    const Eigen::VectorXd alone = answer(nullptr);
    const auto store = std::make_shared<PatternStore>();
    std::vector<Eigen::VectorXd> all(8);
    parallel_for(all.size(), 3, [&](std::size_t k) { all[k] = answer(store); });
    for (const Eigen::VectorXd& u : all) CHECK(u == alone);
  }
}

}  // namespace pattern_store_test
