// SPDX-License-Identifier: MIT
// Tunnels of other laws than the default: dowels, and a joint law with a fault.
#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"

namespace laws_of_ones_own_long {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;

namespace {

CoulombJoint joints(double friction_angle) { return CoulombJoint({5e9, 5e8, friction_angle}); }

/// A joint law with a fault: no number beyond a hundredth of a millimetre of slip.
class FaultyJoint {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "FaultyJoint";
  template <int Dim>
  using State = CoulombJoint::State<Dim>;

  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    PointForce<Dim> f = sound_.force(load, state);
    if (load.motion.slip.norm() > 1e-5) f.normal = std::numeric_limits<double>::quiet_NaN();
    return f;
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    return sound_.commit(load, state);
  }
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return sound_.stored_energy(load, state);
  }
  [[nodiscard]] double joint_normal_stiffness() const { return sound_.joint_normal_stiffness(); }
  [[nodiscard]] double joint_shear_stiffness() const { return sound_.joint_shear_stiffness(); }

 private:
  CoulombJoint sound_ = joints(40 * degree);
};

}  // namespace

TEST_SUITE("equilibrium/laws_of_ones_own_long") {
  TEST_CASE("a dowel installed in rock that has moved is free of force") {
    const auto opening = circular_opening(4, 36);
    Solver<AxialShearBolt> tunnel(jointed_rock(domain_around(opening, 22, 7, 7), 5),
                                  joints(40 * degree), {.density = 2700});
    tunnel.excavate(opening);
    (void)tunnel.equilibrium(0.4);
    Eigen::VectorXd before, after;
    auto& system = detail::SystemOf::in(tunnel);
    system.forces(system.displacement, before);
    const AxialShearBolt law(
        {.axial = {.axial_stiffness = 2e8, .carries_compression = true}, .shear_stiffness = 3e8});
    for (const auto& bar : bolt_bars({.length = 2, .angular_spacing = 30 * degree}, opening))
      tunnel.install_bolt(bar, law);
    const auto* bolts = tunnel.bolts();
    REQUIRE(bolts != nullptr);
    REQUIRE(!bolts->springs().empty());
    system.forces(system.displacement, after);
    // Displacements of 1e-4 m are rounded at 1e-20 m, times 3e8 N/m.
    CHECK((after - before).norm() <= 1e-9);
    // And the tangent of a dowel is that of its force.
    const auto& bolt = bolts->springs().front();
    const auto& spring = bolts->law_of(bolt);
    Eigen::VectorXd u = system.displacement;
    const double step = 1e-6;
    bolt.add_tangent(spring, u.data(),
                     [&](int a, int b, const auto& aa, const auto&, const auto& ba, const auto&) {
                       for (int k = 0; k < 3; ++k) {
                         Eigen::VectorXd up = Eigen::VectorXd::Zero(u.size()), down = up, moved = u;
                         moved[3 * a + k] += step;
                         bolt.add_force(spring, moved.data(), up.data());
                         moved[3 * a + k] -= 2 * step;
                         bolt.add_force(spring, moved.data(), down.data());
                         const Eigen::VectorXd slope = (down - up) / (2 * step);
                         // Both are differences; rounding of 3e8 N/m * 1e-4 m over 1e-8 m.
                         CHECK((slope.segment<3>(3 * a) - aa.col(k)).norm() <= 1e-6 * aa.norm());
                         CHECK((slope.segment<3>(3 * b) - ba.col(k)).norm() <= 1e-6 * aa.norm());
                       }
                     });
  }

  TEST_CASE("forces that are no numbers are a fault, never an equilibrium") {
    const auto opening = circular_opening(4, 36);
    Solver<FaultyJoint> tunnel(jointed_rock(domain_around(opening, 22, 7, 7), 5), FaultyJoint{},
                               {.density = 2700});
    tunnel.excavate(opening);
    CHECK(tunnel.composition().find(FaultyJoint::name) != std::string::npos);
    Solver<FaultyJoint> second = tunnel, third = tunnel;
    CHECK_THROWS_AS((void)tunnel.equilibrium(), NumericalFault);
    CHECK_THROWS_AS((void)Relaxation().find(detail::SystemOf::in(second), {}), NumericalFault);
    CHECK_THROWS_AS((void)Explicit().find(detail::SystemOf::in(third), {}), NumericalFault);
  }
}

}  // namespace laws_of_ones_own_long
