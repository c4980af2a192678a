// SPDX-License-Identifier: MIT
// A wedge on two planes through `Solver` in 3-D by every procedure: the friction below which it
// slides along their line of intersection. Closed forms f.1.
#include <doctest/doctest.h>

#include <cmath>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/laid_blocks.hpp>
#include <voussoir/solver/solver.hpp>

#include "support/blocks.hpp"

namespace trough_wedge_test {

using namespace voussoir;
using voussoir_test::brick;
using voussoir_test::degree;

namespace {

using Procedures = std::tuple<TwoLevel, Relaxation, Explicit>;

/// @param plunge  of the line of intersection [rad]
/// @param open    between each plane and the vertical plane through that line [rad]
template <class Method>
bool stays(double plunge, double open, double friction) {
  const Rotation<3> dip = rotation_by(Spin<3>(0, plunge, 0));
  std::vector<ConvexPolyhedron> blocks;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 along_wall(0, side * std::sin(open), std::cos(open));
    const Vec3 outward(0, side * std::cos(open), -std::sin(open));
    Rotation<3> turn;
    turn << Vec3::UnitX(), along_wall, Vec3(cross(Vec3::UnitX(), along_wall));
    blocks.push_back(brick(dip * (1.5 * along_wall + 0.5 * outward), {6, 3, 1}, dip * turn));
  }
  // A prism that fits the trough, 1 m long, edges 1 m up both walls.
  const double y = std::sin(open), z = std::cos(open);
  std::vector<Vec3> corners;
  for (const double x : {-0.5, 0.5})
    for (const auto& [cy, cz] : {std::pair{0.0, 0.0}, {-y, z}, {y, z}})
      corners.push_back(dip * Vec3(x, cy, cz));
  blocks.push_back(ConvexPolyhedron(
      corners, {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}, {0, 1, 2, 3, 4}));
  Solver<Method, Spatial> trough(laid_blocks<Spatial>(blocks), CoulombJoint({1e9, 1e9, friction}),
                                 {.density = 2700, .is_laid = true});
  REQUIRE(trough.system().joints.contacts().size() == 2);
  trough.fix(0);
  trough.fix(1);
  Acceptance close;
  close.unbalance_over_weight = 1e-4;
  return trough.equilibrium(0, Method{}, close).verdict == Verdict::stable &&
         trough.fallen().empty();
}

}  // namespace

TEST_SUITE("solver/trough_wedge") {
  TEST_CASE_TEMPLATE_DEFINE("it slides below tan phi = sin eta tan psi", Method, slides) {
    // 1e-4 of its weight that may be out of balance are less than 0.01 degrees.
    for (const auto& [psi, eta] : {std::pair{40, 45}, {50, 60}, {35, 30}}) {
      CAPTURE(psi);
      const double limit = std::atan(std::sin(eta * degree) * std::tan(psi * degree));
      CHECK(stays<Method>(psi * degree, eta * degree, limit + 0.02 * degree));
      CHECK(!stays<Method>(psi * degree, eta * degree, limit - 0.02 * degree));
    }
  }
  TEST_CASE_TEMPLATE_APPLY(slides, Procedures);
}

}  // namespace trough_wedge_test
