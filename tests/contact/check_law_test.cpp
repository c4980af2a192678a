// SPDX-License-Identifier: MIT
// `check_law` passes the laws of the toolkit, and names what is wrong with one that is broken on
// purpose: one property at a time.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/contact/burgers_joint.hpp>
#include <voussoir/contact/check_law.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/contact/smooth_wall.hpp>

#include "support/degree.hpp"

namespace check_law_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

enum class Fault {
  none,
  bound_in_giga,        ///< stiffnesses returned in GPa/m
  shear_bound_in_tera,  ///< the shear stiffness says 1000 times what the force does
  stress_for_force,     ///< Pa, not N
  forgets_in_situ,      ///< nothing at first
  opening_negative,     ///< sign of the opening
  soft_normal_bound,    ///< half of what the force has
  soft_shear_bound,
  jump,             ///< cohesion that is lost at once when slip begins
  commit_raises,    ///< a commit that winds the spring up
  forgets_slip,     ///< one that remembers half of the slip
  never_rests,      ///< a commit that slips on each time
  counts_twice,     ///< energy at every commit, moved or not
  gives_energy,     ///< a negative loss
  books_nothing,    ///< no loss at all
  makes_energy,     ///< friction along the slip, not against it
  tension_unsaid,   ///< tension without a `BondRelease`
  gap_unsaid,       ///< lets go before the opening that k_n says
  tells_otherwise,  ///< `describe` of other forces
};

/// Coulomb's joint with a fault.
template <Fault F>
struct Joint {
  using role = roles::ContactLaw;
  static constexpr const char* name = "Joint";
  static constexpr double kn = 5e9, ks = 2e9, mu = 0.6;

  template <int Dim>
  struct State {
    Vec<Dim - 1> slip = zeros<Vec<Dim - 1>>();
  };
  template <int Dim>
  static Vec<Dim - 1> elastic(const PointLoad<Dim>& load, const State<Dim>& state) {
    return load.initial.tangential - ks * load.weight * (load.motion.slip - state.slip);
  }
  template <int Dim>
  PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double sign = F == Fault::opening_negative ? -1 : 1;
    double opening = sign * load.motion.opening;
    if (F == Fault::gap_unsaid && opening > 0) opening *= 2;
    double normal = (F == Fault::forgets_in_situ ? 0 : load.initial.normal) -
                    kn * (F == Fault::stress_for_force ? 1 : load.weight) * opening;
    const double least = F == Fault::tension_unsaid ? -1e5 * load.weight : 0;
    if (normal < least) normal = 0;
    double limit = mu * std::max(0.0, normal);
    Vec<Dim - 1> shear = elastic(load, state);
    const double length = shear.norm();
    if (F == Fault::jump && length < limit + 1e5 * load.weight && normal > 0)
      limit += 1e5 * load.weight;
    if (length > limit) shear *= limit / length;
    if (F == Fault::makes_energy && length > limit) shear = -shear;
    return {normal, shear};
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    const PointForce<Dim> now = force(load, state);
    const Vec<Dim - 1> before = state.slip;
    const bool slides = !(now.tangential == elastic(load, state));
    if (slides)
      state.slip =
          load.motion.slip + (now.tangential - load.initial.tangential) / (ks * load.weight);
    if (F == Fault::forgets_slip && slides) state.slip = 0.5 * (before + state.slip);
    if (F == Fault::commit_raises) state.slip -= 0.1 * (load.motion.slip - state.slip);
    if (F == Fault::never_rests) state.slip += 0.1 * (load.motion.slip - state.slip);
    const double lost = -now.tangential.dot(state.slip - before);
    if (F == Fault::counts_twice) return lost + 1e-3 * now.normal;
    if (F == Fault::gives_energy) return -lost;
    return F == Fault::books_nothing ? 0 : lost;
  }
  template <int Dim>
  double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const PointForce<Dim> now = force(load, state);
    return 0.5 / load.weight * (now.normal * now.normal / kn + now.tangential.squaredNorm() / ks);
  }
  double joint_normal_stiffness() const {
    return kn * (F == Fault::bound_in_giga ? 1e-9 : F == Fault::soft_normal_bound ? 0.5 : 1);
  }
  double joint_shear_stiffness() const {
    return ks * (F == Fault::bound_in_giga         ? 1e-9
                 : F == Fault::soft_shear_bound    ? 0.5
                 : F == Fault::shear_bound_in_tera ? 1000
                                                   : 1);
  }
  template <int Dim>
  ContactReport describe(const PointLoad<Dim>& load, const State<Dim>& state) const {
    ContactReport report;
    const PointForce<Dim> now = force(load, state);
    report.normal = now.normal;
    report.shear = F == Fault::tells_otherwise ? 0 : now.tangential.norm();
    return report;
  }
};

/// A tenth of the paths of a call by default: without optimisation all of them take 45 s.
constexpr ContactLawTrial few{.paths = 20};

/// One of its findings has these words.
template <Fault F>
void check_named(const std::string& words) {
  for (const auto& findings : {check_law<2>(Joint<F>{}, few), check_law<3>(Joint<F>{}, few)}) {
    std::string all;
    bool named = false;
    for (const std::string& finding : findings) {
      CHECK(finding.rfind("Joint: ", 0) == 0);
      named = named || finding.find(words) != std::string::npos;
      all += finding + "\n";
    }
    CAPTURE(words);
    CAPTURE(all);
    CHECK(named);
  }
}

template <class Law>
void check_sound(const Law& law) {
  for (const auto& findings : {check_law<2>(law, few), check_law<3>(law, few)})
    for (const std::string& finding : findings) FAIL_CHECK(finding);
}

}  // namespace

TEST_SUITE("contact/check_law") {
  TEST_CASE("the laws of the toolkit are sound") {
    check_sound(CoulombJoint({5e9, 1e9, 35 * degree}));
    check_sound(CoulombJoint({5e9, 5e9, 0}));
    check_sound(SmoothWall(5e9));
    for (const double damage : {1.0, 2.0, std::numeric_limits<double>::infinity()})
      check_sound(BartonBandisJoint({.roughness = 10,
                                     .wall_strength = 100e6,
                                     .residual_friction_angle = 28 * degree,
                                     .initial_stiffness = 20e9,
                                     .maximum_closure = 2e-4,
                                     .damage_coefficient = damage}));
    check_sound(BurgersJoint({.joint_normal_stiffness = 5e9,
                              .joint_shear_stiffness = 5e8,
                              .friction_angle = 35 * degree,
                              .maxwell_viscosity = 1e15,
                              .kelvin_stiffness = 5e8,
                              .kelvin_viscosity = 1e14}));
    check_sound(MohrCoulombJoint({5e9, 1e9, 35 * degree, 5e5, 2e5}));
    check_sound(MohrCoulombJoint({.joint_normal_stiffness = 5e9,
                                  .joint_shear_stiffness = 1e9,
                                  .friction_angle = 40 * degree,
                                  .cohesion = 3e5,
                                  .tensile_strength = 1e5,
                                  .dilation_angle = 12 * degree,
                                  .dilation_limit = 5e-3,
                                  .residual_friction_angle = 25 * degree,
                                  .residual_cohesion = 5e4}));
    check_sound(Joint<Fault::none>{});
  }

  TEST_CASE("what is broken is named") {
    check_named<Fault::bound_in_giga>("is it in MPa/m or GPa/m?");
    check_named<Fault::shear_bound_in_tera>("are both in the same unit?");
    check_named<Fault::stress_for_force>("not twice the force");
    check_named<Fault::forgets_in_situ>("the rock would move before anything is excavated");
    check_named<Fault::opening_negative>("closed further is pressed less");
    check_named<Fault::soft_normal_bound>("stiffness bound: dN/dg");
    check_named<Fault::soft_shear_bound>("stiffness bound: dT/ds");
    check_named<Fault::jump>("the force jumps");
    check_named<Fault::commit_raises>("`commit` raises the force");
    check_named<Fault::forgets_slip>("counted twice");
    check_named<Fault::never_rests>("never comes to rest");
    check_named<Fault::counts_twice>("counted twice");
    check_named<Fault::gives_energy>("never negative");
    check_named<Fault::books_nothing>("energy is not booked");
    check_named<Fault::makes_energy>("J from nothing");
    check_named<Fault::tension_unsaid>("edge rule: `force` returns tension");
    check_named<Fault::gap_unsaid>("edge rule: pressed by");
    check_named<Fault::tells_otherwise>("`describe` tells other forces");
  }
}

}  // namespace check_law_test
