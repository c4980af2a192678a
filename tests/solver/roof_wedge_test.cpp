// SPDX-License-Identifier: MIT
// A symmetric wedge in the roof under horizontal stress, against Crawford and Bray (1983): it drops
// on its springs until both faces slip, and then for good.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/model/system.hpp>

#include "support/reference.hpp"

namespace roof_wedge_test {

using namespace voussoir;
using voussoir_test::reference;

namespace {

constexpr double degree = std::numbers::pi / 180;

struct Case {
  const char* row;
  double semi_apical, friction;  ///< [deg]
  double normal, shear, thrust;  ///< k_n A, k_s A [N/m], H0 [N]
};

/// Faces of 1 m between two fixed abutments (0, 1) and the wedge (2), under a total load P.
System<Planar> wedge(const Case& c, double load) {
  System<Planar> system(CoulombJoint({c.normal, c.shear, c.friction * degree}), 1,
                        CoulombJoint({1, 1, 0}, any_units));
  const double a = c.semi_apical * degree;
  const Vec2 apex(0, std::cos(a)), toe(std::sin(a), 0);
  system.add_body({Vec2(-1, 0.5), 1, 1, false});
  system.add_body({Vec2(1, 0.5), 1, 1, false});
  system.add_body({Vec2(0, 0.3), load, 0.3, true});
  const Segment left{Vec2(-toe.x(), 0), apex}, right{apex, toe};
  // Wedge on the right of its left face going up, and of its right face going down.
  const auto touch = [&](int abutment, const Segment& face) {
    system.joints.add(abutment, 2, face, system.body(abutment).centre, system.body(2).centre,
                      face.gauss_points());
  };
  touch(0, left);
  touch(1, right);
  Stress<2> horizontal = Stress<2>::Zero();
  horizontal(0, 0) = c.thrust / std::cos(a);  // on the height of the wedge, cos(a): H0
  system.joints.set_initial([&](const auto&, const Vec2&) { return horizontal; });
  system.load[3 * 2 + 1] = -load;
  system.wall_load[3 * 2 + 1] = load;  // the stage lets it come on
  return system;
}

}  // namespace

TEST_SUITE("solver/roof_wedge") {
  TEST_CASE_TEMPLATE_DEFINE("it drops elastically up to the slip load, and falls beyond it", Method,
                            drops) {
    for (const Case& c : {Case{"F.wedge.20.35.0.1", 20, 35, 5e9, 5e8, 1e6},
                          Case{"F.wedge.15.30.0.1", 15, 30, 5e9, 5e8, 1e6},
                          Case{"F.wedge.30.40.0.1", 30, 40, 1e10, 1e9, 5e5},
                          Case{"F.wedge.20.35.1", 20, 35, 5e9, 5e9, 1e6}}) {
      CAPTURE(c.row);
      SearchContext close;
      close.acceptance.unbalance_over_weight = 1e-5;
      const double load = reference(std::string(c.row) + ".P");
      auto before = wedge(c, 0.999 * load);
      const EquilibriumReport stays = Method{}.find(before, close);
      CHECK(stays.verdict == Verdict::stable);
      CHECK(stays.fallen.empty());
      // Linear up to slip; the weight is carried to 1e-9 by one elastic solve. Steps end where the
      // balance does.
      const double drop = 0.999 * reference(std::string(c.row) + ".u");
      CHECK(std::abs(-before.displacement[7] - drop) <=
            (std::is_same_v<Method, Explicit> ? 1e-3 : 1e-9) * drop);
      auto after = wedge(c, 1.001 * load);
      CHECK(Method{}.find(after, close).fallen == std::vector<int>{2});
    }
  }
  TEST_CASE_TEMPLATE_APPLY(drops, std::tuple<TwoLevel, Relaxation, Explicit>);
}

}  // namespace roof_wedge_test
