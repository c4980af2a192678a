// SPDX-License-Identifier: MIT
// A row of blocks between two walls that bears itself as a flat arch (Diederichs and Kaiser 1999),
// by every procedure and in motion, against joints of many fibres in a program of its own.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/solver/solver.hpp>

#include "support/fibre_beam.hpp"
#include "support/laid_problem.hpp"
#include "support/near.hpp"

namespace voussoir_beam_test {

using namespace voussoir;
using voussoir_test::FibreBeam;
using voussoir_test::LaidProblem;
using voussoir_test::roof_joint;
using voussoir_test::voussoir_beam;
using voussoir_test::voussoir_beam_stiffness;

namespace {

using Procedures = std::tuple<TwoLevel, Relaxation, Explicit>;

double by_fibres(int span, int fibres = 64) {
  const double k = voussoir_beam_stiffness(span);
  FibreBeam beam{.span = span, .normal = k, .shear = k, .weight = 3000 * 9.81, .fibres = fibres};
  return beam.sag().value();
}

template <class Method>
double at_rest(int span) {
  const LaidProblem beam = voussoir_beam(span);
  auto solver = beam.solver<Solver<Method, MohrCoulombJoint>>(roof_joint(span));
  Acceptance near;
  near.displacement_limit = 1;  // it sags by a quarter of its height before it snaps through
  REQUIRE(solver.equilibrium(0, Method{}, near).verdict == Verdict::stable);
  REQUIRE(solver.fallen().empty());
  double sag = 0;
  for (std::size_t b = 2; b < beam.blocks.size(); ++b)
    sag = std::max(sag, -solver.displacement_of(static_cast<int>(b), beam.centre(b)).y());
  return sag;
}

double in_motion(int span) {
  const LaidProblem beam = voussoir_beam(span);
  auto run = beam.run(roof_joint(span), {.local_damping = 0.7});
  double sag = 0;
  for (int look = 0; look < 1000; ++look) {
    run.advance_steps(200);
    double fastest = 0;
    sag = 0;
    for (std::size_t b = 2; b < beam.blocks.size(); ++b) {
      const int n = static_cast<int>(b);
      sag = std::max(sag, beam.centre(b).y() - run.position(n).y());
      fastest = std::max(fastest, run.velocity(n).norm());
    }
    if (look > 2 && fastest < 1e-6) return sag;
  }
  FAIL("it comes to no rest");
  return sag;
}

/// What the iteration of Diederichs and Kaiser makes of E = 10/3 GPa [m].
constexpr std::pair<int, double> spans[] = {
    {5, 0.669e-3}, {10, 10.4e-3}, {15, 51.9e-3}, {18, 109e-3}, {20, 174e-3}};

/// Their iteration: an arch of thrust whose depth at the middle and the walls is the part of the
/// thickness that makes its stress least, shortened by the mean stress along it.
/// @return  sag [m]
double by_their_iteration(double span, double modulus) {
  double least_stress = 1e300, sag = 0;
  for (int percent = 1; percent < 100; ++percent) {
    const double part = 0.01 * percent, lever = 1 - 2 * part / 3;
    const double length = span + 8 * lever * lever / (3 * span);
    double now = lever, stress = 0;
    for (int iteration = 0; iteration < 500 && now > 0; ++iteration) {
      stress = 3000 * 9.81 * span * span / (4 * part * now);
      const double mean = stress / 3 * (2.0 / 3 + part);
      const double left = 8 * lever * lever / (3 * span) - mean / modulus * length;
      now = left > 0 ? std::sqrt(3 * span / 8 * left) : 0;  // it snaps through
    }
    if (!(now > 0) || stress >= least_stress) continue;
    least_stress = stress;
    sag = lever - now;
  }
  return sag;
}

}  // namespace

TEST_SUITE("solver/voussoir_beam") {
  TEST_CASE("the published sags are those of 10/3 GPa") {
    for (const auto& [span, published] : spans)
      CHECK(by_their_iteration(span, 1e10 / 3) == voussoir_test::near(published).epsilon(3e-3));
  }

  TEST_CASE("the fibres are enough of them") {
    for (const auto& [span, published] : spans)
      CHECK(by_fibres(span) == voussoir_test::near(by_fibres(span, 256)).epsilon(2e-3));
    // Of 21 m the middle is to snap through.
    FibreBeam wide{.span = 21,
                   .normal = voussoir_beam_stiffness(21),
                   .shear = voussoir_beam_stiffness(21),
                   .weight = 3000 * 9.81};
    CHECK(!wide.sag().has_value());
  }

  TEST_CASE_TEMPLATE_DEFINE("it sags as a row with 64 fibres in every joint does", Method, sags) {
    for (const auto& [span, published] : spans) {
      CAPTURE(span);
      // An arch whose joints close to a third; how far hangs on rotations of finite size, which are
      // linear since the last contact update. States are 1 % of a block's weight out of balance at
      // most. `Relaxation` slips on its way, which stays. 20 m are near to where it snaps through:
      // blocks may move by 5 mm of 229 between the last update and rest.
      const double slip = std::is_same_v<Method, Relaxation> && span == 5 ? 0.06 : 0;
      const double near_snap = span == 20 ? 0.005 : 0;
      CHECK(at_rest<Method>(span) ==
            voussoir_test::near(by_fibres(span)).epsilon(0.02 + slip + near_snap));
    }
  }
  TEST_CASE_TEMPLATE_APPLY(sags, Procedures);

  TEST_CASE("it sags so in motion, too") {
    for (const auto& [span, published] : spans) {
      CAPTURE(span);
      CHECK(in_motion(span) == voussoir_test::near(by_fibres(span)).epsilon(0.02));
    }
  }
}

}  // namespace voussoir_beam_test
