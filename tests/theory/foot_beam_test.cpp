// SPDX-License-Identifier: MIT
// Ribs on a beam on springs, against finite elements and the limits of stiff beams and single ribs.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <voussoir/core/errors.hpp>
#include <voussoir/theory/foot_beam.hpp>

#include "support/dense_algebra.hpp"

namespace foot_beam_test {

using namespace voussoir;

namespace {

/// Half a bay between two ribs, its ends held from turning: beam elements on a consistent
/// foundation, force 1 N and width 1 m.
/// They are short against the beam's wave, and no shorter: stiffness over foundation is what they
/// lose digits by.
FeetOnBeam by_elements(double k, const FootBeam& beam) {
  const double wave = std::pow(beam.modulus * std::pow(beam.depth, 3) / (3 * k), 0.25);
  const int count = std::max(4, static_cast<int>(std::ceil(10 * beam.spacing / wave)));
  const double h = 0.5 * beam.spacing / count;
  const double bending = beam.modulus * std::pow(beam.depth, 3) / 12;
  Eigen::Matrix4d element, foundation;
  element << 12, 6 * h, -12, 6 * h, 6 * h, 4 * h * h, -6 * h, 2 * h * h, -12, -6 * h, 12, -6 * h,
      6 * h, 2 * h * h, -6 * h, 4 * h * h;
  foundation << 156, 22 * h, 54, -13 * h, 22 * h, 4 * h * h, 13 * h, -3 * h * h, 54, 13 * h, 156,
      -22 * h, -13 * h, -3 * h * h, -22 * h, 4 * h * h;
  const Eigen::Matrix4d both = bending / (h * h * h) * element + k * h / 420 * foundation;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(2 * count + 2, 2 * count + 2);
  for (int e = 0; e < count; ++e) all.block<4, 4>(2 * e, 2 * e) += both;
  // Half of the rib's force at the one end; neither end turns: what holds it is the moment.
  Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * count + 2);
  load[0] = 0.5;
  Eigen::MatrixXd held = all;
  for (const int turn : {1, 2 * count + 1}) {
    held.row(turn).setZero();
    held(turn, turn) = all.diagonal().maxCoeff();
  }
  const Eigen::VectorXd moved = voussoir_test::solve(held, load);
  const double even = 1 / (k * beam.spacing);
  return {moved[0] / even, std::abs(all.row(1).dot(moved)) / beam.spacing};
}

}  // namespace

TEST_SUITE("theory/foot_beam") {
  TEST_CASE("settlement and moment are those of beam elements, from stiff beams to single ribs") {
    for (const double depth : {0.15, 0.3, 0.6, 1.2})
      for (const double spacing : {0.4, 1.0, 1.7, 6.0})
        for (const double k : {5e7, 1e9, 2e10}) {
          const FootBeam beam{depth, 25e9, spacing};
          const FeetOnBeam ours = feet_on_beam(k, beam), theirs = by_elements(k, beam);
          CAPTURE(depth);
          CAPTURE(spacing);
          CAPTURE(k);
          // Elements of a twentieth of the wave: 0.05^4 / 720 and its like, and rounding.
          CHECK(std::abs(ours.settlement / theirs.settlement - 1) <= 1e-6);
          CHECK(std::abs(ours.moment / theirs.moment - 1) <= 1e-6);
        }
  }

  TEST_CASE("where the series takes over nothing jumps, and both limits are met") {
    // x = 0.05 (1 -+ 1e-6): k = E h^3 x^4 / 3 for a spacing of 1 m.
    const auto at = [](double x) {
      return feet_on_beam(25e9 * std::pow(0.5, 3) * std::pow(x, 4) / 3, {0.5, 25e9, 1});
    };
    const FeetOnBeam below = at(0.05 * (1 - 1e-6)), above = at(0.05 * (1 + 1e-6));
    CHECK(std::abs(below.settlement - above.settlement) <= 1e-11);
    // sinh x - sin x is x^3 / 3 of what its two terms are: rounding grows by 3 / x^2 = 1200 twice.
    CHECK(std::abs(below.moment - above.moment) <= 1e-10);
    CHECK(std::abs(at(1e-3).settlement - 1) <= 1e-12);
    CHECK(std::abs(at(1e-3).moment - 1.0 / 12) <= 1e-12);
    CHECK(std::abs(at(40).settlement - 20) <= 1e-12);     // P lambda / (2 k)
    CHECK(std::abs(at(40).moment - 1.0 / 160) <= 1e-12);  // P / (4 lambda)
    CHECK(std::isfinite(at(5000).settlement));
  }

  TEST_CASE("what is no beam is refused") {
    CHECK_THROWS_AS((void)feet_on_beam(0, {0.5, 25e9, 1}), InvalidInput);
    CHECK_THROWS_AS((void)feet_on_beam(1e9, {-0.5, 25e9, 1}), InvalidInput);
    CHECK_THROWS_AS((void)feet_on_beam(1e9, {0.5, std::nan(""), 1}), InvalidInput);
    CHECK_THROWS_AS((void)feet_on_beam(1e9, {0.5, 25e9, 0}), InvalidInput);
  }
}

}  // namespace foot_beam_test
