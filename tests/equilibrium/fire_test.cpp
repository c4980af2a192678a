// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <numeric>
#include <vector>
#include <voussoir/equilibrium/fire.hpp>

#include "support/dense_algebra.hpp"

namespace fire_test {

using namespace voussoir;

namespace {

/// A chain of bodies with three unknowns each, coupled, held at one end, of stiffnesses that spread
/// over a factor of 100: a quadratic energy u K u / 2 - b u with one minimum.
struct Bowl {
  static constexpr int bodies = 20;
  Bowl() : stiffness(Eigen::MatrixXd::Zero(3 * bodies, 3 * bodies)), load(3 * bodies) {
    for (int i = 0; i < bodies; ++i)
      for (int d = 0; d < 3; ++d) {
        const double k = d == 0 ? 1e9 : (d == 1 ? 1e8 : 1e7);
        const int here = 3 * i + d, before = 3 * (i - 1) + d;
        stiffness(here, here) += k;
        if (i > 0) {
          stiffness(before, before) += k;
          stiffness(here, before) = stiffness(before, here) = -k;
        }
        load[here] = 1e3 * ((7 * here) % 11 - 5);
      }
    minimum = voussoir_test::solve(stiffness, load);
  }
  [[nodiscard]] Eigen::VectorXd force(const Eigen::VectorXd& u) const {
    return load - stiffness * u;
  }
  [[nodiscard]] Fire fire() const { return {stiffness.cwiseAbs().rowwise().sum(), Fire::Params{}}; }
  Eigen::MatrixXd stiffness;
  Eigen::VectorXd load, minimum;
};

std::vector<int> all_bodies() {
  std::vector<int> all(Bowl::bodies);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

TEST_SUITE("equilibrium/fire") {
  TEST_CASE("it finds the minimum of a quadratic energy") {
    const Bowl bowl;
    Fire fire = bowl.fire();
    Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * Bowl::bodies);
    for (int step = 0; step < 3000; ++step) fire.advance<3>(all_bodies(), bowl.force(u), u);
    // The slowest mode turns once in about 2 pi 20 / 0.8 = 160 steps; 3000 steps are many.
    CHECK((u - bowl.minimum).norm() <= 1e-8 * bowl.minimum.norm());
  }

  TEST_CASE("bodies that are not named stay where they are") {
    const Bowl bowl;
    Fire fire = bowl.fire();
    Eigen::VectorXd u = Eigen::VectorXd::Constant(3 * Bowl::bodies, 1e-4);
    const Eigen::VectorXd start = u;
    std::vector<int> few{3, 11};
    for (int step = 0; step < 50; ++step) {
      const Eigen::VectorXd f = bowl.force(u);
      fire.advance<3>(few, f, u);
    }
    for (int b = 0; b < Bowl::bodies; ++b)
      CHECK((u.segment<3>(3 * b) == start.segment<3>(3 * b)) == (b != 3 && b != 11));
  }

  TEST_CASE("rest forgets all momentum: from the minimum nothing moves") {
    const Bowl bowl;
    Fire fire = bowl.fire();
    Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * Bowl::bodies);
    for (int step = 0; step < 20; ++step) fire.advance<3>(all_bodies(), bowl.force(u), u);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(3 * Bowl::bodies);
    u = bowl.minimum;
    fire.rest();
    for (int step = 0; step < 20; ++step) fire.advance<3>(all_bodies(), none, u);
    CHECK(u == bowl.minimum);
  }

  TEST_CASE("the search does not depend on the unit of stiffness") {
    // Masses come from the stiffness, so a power of two in stiffness and load changes no bit of u.
    const Bowl bowl;
    Bowl soft;
    soft.stiffness /= 1024;
    soft.load /= 1024;
    Fire fire = bowl.fire(), other = soft.fire();
    Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * Bowl::bodies), v = u;
    for (int step = 0; step < 200; ++step) {
      fire.advance<3>(all_bodies(), bowl.force(u), u);
      other.advance<3>(all_bodies(), soft.force(v), v);
    }
    CHECK(u == v);
  }
}

}  // namespace fire_test
