// SPDX-License-Identifier: MIT
// A wedge on two planes through `Solver` in 3-D by every procedure: the friction below which it
// slides along their line of intersection. Closed forms f.1; skew ones from the same balance.
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

struct Trough {
  double plunge;       ///< of the line of intersection [degrees]
  double left, right;  ///< between each plane and the vertical plane through that line [degrees]

  /// Limiting friction of a wedge that slides along the line with no shear across it [rad]: weight,
  /// and the forces that the planes need to balance it across the line.
  [[nodiscard]] double limit() const {
    const double l = left * degree, r = right * degree;
    return std::atan(std::tan(plunge * degree) * std::sin(l + r) / (std::cos(l) + std::cos(r)));
  }
};

template <class Method>
Verdict verdict(const Trough& it, double friction, bool* is_whole) {
  const Rotation<3> dip = rotation_by(Spin<3>(0, it.plunge * degree, 0));
  const double left = it.left * degree, right = it.right * degree;
  std::vector<ConvexPolyhedron> blocks;
  for (const double side : {-1.0, 1.0}) {
    const double open = side < 0 ? left : right;
    const Vec3 along_wall(0, side * std::sin(open), std::cos(open));
    const Vec3 outward(0, side * std::cos(open), -std::sin(open));
    Rotation<3> turn;
    turn << Vec3::UnitX(), along_wall, Vec3(cross(Vec3::UnitX(), along_wall));
    blocks.push_back(brick(dip * (1.5 * along_wall + 0.5 * outward), {6, 3, 1}, dip * turn));
  }
  // A prism that fits the trough, 1 m long, edges 1 m up both walls.
  std::vector<Vec3> corners;
  for (const double x : {-0.5, 0.5})
    for (const auto& [cy, cz] : {std::pair{0.0, 0.0},
                                 {-std::sin(left), std::cos(left)},
                                 {std::sin(right), std::cos(right)}})
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
  const Verdict found = trough.equilibrium(0, Method{}, close).verdict;
  *is_whole = trough.fallen().empty();
  return found;
}

template <class Method>
bool stays(const Trough& trough, double friction) {
  bool is_whole = false;
  return verdict<Method>(trough, friction, &is_whole) == Verdict::stable && is_whole;
}
template <class Method>
bool falls(const Trough& trough, double friction) {
  bool is_whole = true;
  return verdict<Method>(trough, friction, &is_whole) == Verdict::stable && !is_whole;
}

}  // namespace

TEST_SUITE("solver/trough_wedge") {
  TEST_CASE_TEMPLATE_DEFINE("it slides below tan phi = sin eta tan psi", Method, slides) {
    // 1e-4 of its weight that may be out of balance are less than 0.01 degrees.
    for (const Trough& trough : {Trough{40, 45, 45}, {50, 60, 60}, {35, 30, 30}}) {
      CAPTURE(trough.plunge);
      CHECK(stays<Method>(trough, trough.limit() + 0.02 * degree));
      CHECK(!stays<Method>(trough, trough.limit() - 0.02 * degree));
    }
  }
  TEST_CASE_TEMPLATE_APPLY(slides, Procedures);

  TEST_CASE_TEMPLATE_DEFINE("wedges nobody picked: none is stable below its limit", Method,
                            nobody) {
    // Steep and blunt ones, skew and in the mirror. At 0.1 degrees below the limit 0.3 % of the
    // weight is missing, 30 times what may be out of balance; slid once, a wedge carries no shear
    // across its way, and nothing but a jam would hold it. Of the steepest the resultant leaves the
    // middle third, and they chatter on their way.
    for (const Trough& trough : {Trough{30, 45, 60},
                                 {45, 30, 50},
                                 {45, 50, 30},
                                 {55, 40, 40},
                                 {60, 35, 35},
                                 {60, 50, 35},
                                 {60, 35, 50},
                                 {65, 40, 55},
                                 {65, 55, 40},
                                 {68, 30, 45},
                                 {70, 40, 40},
                                 {70, 45, 35},
                                 {70, 35, 45},
                                 {70, 55, 55}}) {
      CAPTURE(trough.plunge);
      CAPTURE(trough.left);
      CAPTURE(trough.right);
      for (const double below : {2.0, 0.6, 0.3, 0.1}) {
        CAPTURE(below);
        // Undecided is no answer.
        CHECK(falls<Method>(trough, trough.limit() - below * degree));
      }
      CHECK(stays<Method>(trough, trough.limit() + 0.05 * degree));
    }
  }
  TEST_CASE_TEMPLATE_APPLY(nobody, Procedures);
}

}  // namespace trough_wedge_test
