// SPDX-License-Identifier: MIT
// The cheapest place of a grid against all of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/design/cheapest_place.hpp>

namespace cheapest_place_test {
namespace {

using voussoir::Random;
using voussoir::design::cheapest_place;
using voussoir::design::SupportPlace;

}  // namespace

TEST_SUITE("design/cheapest_place") {
  TEST_CASE("the cheapest that holds, asking about few") {
    Random random(29, 0);
    int none = 0;
    for (int k = 0; k < 500; ++k) {
      const auto rows = static_cast<Eigen::Index>(1 + random.uniform() * 9),
                 columns = static_cast<Eigen::Index>(1 + random.uniform() * 9);
      // Costs of bolts and of linings, in any steps.
      Eigen::MatrixXd costs(rows, columns);
      std::vector<double> bolts, linings;
      for (Eigen::Index i = 0; i < rows; ++i) bolts.push_back(100 * random.uniform());
      for (Eigen::Index j = 0; j < columns; ++j) linings.push_back(100 * random.uniform());
      std::sort(bolts.rbegin(), bolts.rend());
      std::sort(linings.begin(), linings.end());
      for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index j = 0; j < columns; ++j)
          costs(i, j) = bolts[static_cast<std::size_t>(i)] + linings[static_cast<std::size_t>(j)];
      // Of every spacing the first thickness that holds, no thinner for wider spacings.
      std::vector<std::size_t> first;
      for (Eigen::Index i = 0; i < rows; ++i)
        first.push_back(
            static_cast<std::size_t>(random.uniform() * static_cast<double>(columns + 1)));
      std::sort(first.begin(), first.end());
      double least = std::numeric_limits<double>::infinity();
      for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index j = 0; j < columns; ++j)
          if (static_cast<std::size_t>(j) >= first[static_cast<std::size_t>(i)])
            least = std::min(least, costs(i, j));
      std::vector<SupportPlace> asked;
      const auto found = cheapest_place(costs, [&](const SupportPlace& place) {
        CHECK(std::find(asked.begin(), asked.end(), place) == asked.end());
        asked.push_back(place);
        return place.thickness >= first[place.spacing];
      });
      CHECK(asked.size() <= static_cast<std::size_t>(rows + columns - 1));
      REQUIRE(found.has_value() == (least < 1e9));
      none += !found;
      if (found)
        CHECK(costs(static_cast<Eigen::Index>(found->spacing),
                    static_cast<Eigen::Index>(found->thickness)) == least);
    }
    CHECK(none > 10);
  }
}

}  // namespace cheapest_place_test
