// SPDX-License-Identifier: MIT
// Solvers are composed from policies in any order; a policy of the user's own takes part like ours.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <type_traits>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "linear/dense_matrix.hpp"
#include "support/dense_algebra.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace composition_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::dense;
using voussoir_test::jointed_rock;

namespace {

/// A joint that neither opens nor slips: two springs without end. Everything is linear with it, so
/// the answer is that of one dense solve.
class Welded {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "Welded";
  template <int Dim>
  struct State {};

  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>&) const {
    return {load.initial.normal - joint_normal_stiffness() * load.weight * load.motion.opening,
            load.initial.tangential - joint_shear_stiffness() * load.weight * load.motion.slip};
  }
  template <int Dim>
  double commit(const PointLoad<Dim>&, State<Dim>&) const {
    return 0;
  }
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>&, const State<Dim>&) const {
    return 0;
  }
  [[nodiscard]] double joint_normal_stiffness() const { return 5e9; }
  [[nodiscard]] double joint_shear_stiffness() const { return 5e8; }
};
static_assert(ContactLaw<Welded, 2>);

}  // namespace

TEST_SUITE("solver/composition") {
  TEST_CASE("a solver says what it is made of, defaults included") {
    CHECK(Solver<>::composition() ==
          "Planar, CutContacts, CoulombJoint, LorigAnchors, AxialBolt, EulerBernoulliBeam on "
          "CoulombJoint, TwoLevel");
    CHECK(Composition<Explicit, TimoshenkoBeam, RockOnLining<SmoothWall>, AxialShearBolt,
                      GargaWangAnchors, Welded>::describe() ==
          "Planar, CutContacts, Welded, GargaWangAnchors, AxialShearBolt, TimoshenkoBeam on "
          "SmoothWall, Explicit");
  }

  TEST_CASE("the order of the policies does not matter") {
    using One = Composition<GargaWangAnchors, Relaxation, TimoshenkoBeam, Welded>;
    using Other = Composition<Welded, TimoshenkoBeam, Relaxation, GargaWangAnchors>;
    static_assert(std::is_same_v<One::Geometry, Other::Geometry>);
    static_assert(std::is_same_v<One::Detector, Other::Detector>);
    static_assert(std::is_same_v<One::JointLaw, Other::JointLaw>);
    static_assert(std::is_same_v<One::Anchors, Other::Anchors>);
    static_assert(std::is_same_v<One::BoltLaw, Other::BoltLaw>);
    static_assert(std::is_same_v<One::Lining, Other::Lining>);
    static_assert(std::is_same_v<One::Method, Other::Method>);
    static_assert(std::is_same_v<One::JointLaw, Welded>);
    CHECK(One::describe() == Other::describe());
  }

  TEST_CASE("a joint law of the user's own: welded rock moves as one dense solve says") {
    const auto opening = circular_opening(4, 36);
    // The edge of the domain carries no tension: the surcharge keeps it closed up to the surface,
    // and the wall is unloaded by a part only.
    const double left = 0.7;
    Solver<Welded, GargaWangAnchors> tunnel(jointed_rock(domain_around(opening, 16, 5, 5), 2),
                                            Welded{},
                                            {.density = 2700, .k0 = 0.5, .surcharge = 1e6});
    tunnel.excavate(opening);
    auto& system = detail::SystemOf::in(tunnel);
    Eigen::VectorXd load;
    system.wall_fraction = left;
    system.forces(system.displacement, load);
    system.wall_fraction = 1;
    const Eigen::VectorXd exact = voussoir_test::solve(dense(system.elastic_stiffness()), load);
    const EquilibriumReport report =
        tunnel.equilibrium(left, {}, {.error_estimate = 1e-9, .unbalance_over_weight = 1e-6});
    CHECK(report.verdict == Verdict::stable);
    // Rounding: the condition of K, about 1e6, times 1e-16.
    CHECK((system.displacement - exact).norm() <= 1e-9 * exact.norm());
    CHECK(report.factorisations == 1);
    CHECK(exact.cwiseAbs().maxCoeff() > 1e-5);
  }

  TEST_CASE("anchors are those of the policy") {
    const auto opening = circular_opening(4, 36);
    const auto rock = jointed_rock(domain_around(opening, 16, 5, 5), 2);
    const Segment bar{{0, 2}, {0, 6}};
    const AxialBolt bolt({.axial_stiffness = 2e8});
    Solver<> near(rock, CoulombJoint({5e9, 5e8, 40 * degree}), {.density = 2700});
    Solver<Welded, GargaWangAnchors> midway(rock, Welded{}, {.density = 2700});
    near.excavate(opening);
    midway.excavate(opening);
    CHECK(near.install_bolt(bar, bolt) == midway.install_bolt(bar, bolt));
    REQUIRE(near.bolts()->springs().size() > 2);
    for (const auto& spring : near.bolts()->springs())
      CHECK(spring.span.initial.norm() <= 0.0672 + 1e-12);  // twice 1.2 diameters of 28 mm
    // Anchors midway in the blocks: between two joints lies one block, and an anchor in its middle.
    const auto& springs = midway.bolts()->springs();
    for (std::size_t k = 1; k < springs.size(); ++k) {
      const Vec2 before = midway.system().body(springs[k - 1].b).centre + springs[k - 1].arm_b;
      const Vec2 after = midway.system().body(springs[k].a).centre + springs[k].arm_a;
      CHECK((before - after).norm() <= 1e-12);
      CHECK(
          before.y() - 2 ==
          voussoir_test::near(0.5 * (springs[k - 1].position + springs[k].position)).epsilon(1e-9));
    }
  }
}

}  // namespace composition_test
