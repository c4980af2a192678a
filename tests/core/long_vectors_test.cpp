// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/random.hpp>

namespace long_vectors_test {

TEST_SUITE("core/long_vectors") {
  TEST_CASE("what Eigen's own expressions give, bit by bit") {
    voussoir::Random random(3, 0);
    for (const Eigen::Index size : {1, 2, 7, 100}) {
      Eigen::VectorXd a(size), b(size), target(2);
      for (Eigen::Index k = 0; k < size; ++k) {
        a[k] = 2 * random.uniform() - 1;
        b[k] = 0.1 + random.uniform();
      }
      CHECK(voussoir::constants(size, 2.5) == Eigen::VectorXd::Constant(size, 2.5));
      CHECK(voussoir::zeros(size) == Eigen::VectorXd::Zero(size));
      CHECK(voussoir::opposite(a) == -a);
      CHECK(voussoir::inverses(b) == b.cwiseInverse());
      CHECK(voussoir::inverses(b, 4) == 4 * b.cwiseInverse());
      CHECK(voussoir::largest_quotient(a, b) == a.cwiseQuotient(b).maxCoeff());
      voussoir::set_to_sum(target, a, 1, b);
      CHECK(target == a + b);
      voussoir::set_to_sum(target, target, -1, b);  // also in place
      CHECK(target == Eigen::VectorXd(a + b) - b);
    }
    CHECK(voussoir::zeros(0).size() == 0);
  }
}

}  // namespace long_vectors_test
