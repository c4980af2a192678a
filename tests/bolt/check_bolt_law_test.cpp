// SPDX-License-Identifier: MIT
// `check_law` passes the bolts of the toolkit, and names what is wrong with one that is broken on
// purpose: one property at a time.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/bolt/check_bolt_law.hpp>

namespace check_bolt_law_test {

using namespace voussoir;

namespace {

enum class Fault {
  none,
  bound_in_giga,    ///< stiffness returned in GN/m
  dowel_unsaid,     ///< a dowel whose stiffness is not stated
  dowel_unbooked,   ///< or whose energy is not
  soft_bound,       ///< half of what the pull has
  skew_bound,       ///< not symmetric
  pushes,           ///< pulled apart it pushes
  world_axes,       ///< pulls along x, however the bar lies
  pull_of_jump,     ///< its pull follows the joint, not the anchors
  forgets,          ///< a commit that takes slip back
  slips_on,         ///< a commit that slips on each time
  loses,            ///< energy that is gone once it has slipped
  tells_otherwise,  ///< `describe` of another force
};

/// A bolt that slides at its grip, with an elastic dowel.
template <Fault F>
struct Bolt {
  using role = roles::BoltLaw;
  static constexpr const char* name = "Bolt";
  static constexpr double along = 2e8, across = 5e7, grip = 1e5;

  struct State {
    double slid = 0;
  };
  template <int Dim>
  static double opening(const BoltSpan<Dim>& span) {
    return span.axis.dot(F == Fault::pull_of_jump ? span.jump : span.motion);
  }
  template <int Dim>
  static Vec<Dim> shear(const BoltSpan<Dim>& span) {
    return span.jump - span.axis.dot(span.jump) * span.axis;
  }
  static double tension(double opening, const State& state) {
    return std::clamp(along * (opening - state.slid), 0.0, grip);
  }
  template <int Dim>
  BoltForce<Dim> force(const BoltSpan<Dim>& span, const State& state) const {
    const double axial = tension(opening(span), state);
    Vec<Dim> axis = span.axis;
    if (F == Fault::world_axes) axis = Vec<Dim>::UnitX();
    if (F == Fault::pushes) axis = -axis;
    return {axial * axis, axial, across * shear(span)};
  }
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    state.slid = std::max(state.slid, opening(span) - grip / along);
    if (F == Fault::forgets) state.slid *= 0.5;
    if (F == Fault::slips_on) state.slid += 0.1 * std::abs(opening(span));
    return false;
  }
  template <int Dim>
  BoltStiffness<Dim> stiffness(const BoltSpan<Dim>& span) const {
    const double part = F == Fault::soft_bound ? 0.5 : F == Fault::bound_in_giga ? 1e-9 : 1;
    BoltStiffness<Dim> bound{part * along * outer(span.axis, span.axis)};
    if (F == Fault::skew_bound) bound.pull(0, 1) += along;
    if (F != Fault::dowel_unsaid)
      bound.dowel = across * (diagonal_of<Dim>(1) - outer(span.axis, span.axis));
    return bound;
  }
  template <int Dim>
  double energy(const BoltSpan<Dim>& span, const State& state) const {
    const double axial = tension(opening(span), state);
    const double slid = std::max(state.slid, opening(span) - grip / along);
    return 0.5 * axial * axial / along + (F == Fault::loses ? 0 : grip * slid) +
           (F == Fault::dowel_unbooked ? 0 : 0.5 * across * shear(span).squaredNorm());
  }
  template <int Dim>
  BoltReport describe(const BoltSpan<Dim>& span, const State& state) const {
    BoltReport report = report_from_force(*this, span, state);
    if (F == Fault::tells_otherwise) report.axial = 0;
    return report;
  }
};

/// Paths of a seed: what the first ones find, or would find, the 200 of the default do, too.
constexpr BoltLawTrial few{.paths = 20};

template <Fault F>
void check_named(const std::string& words) {
  for (const auto& findings : {check_law<2>(Bolt<F>{}, few), check_law<3>(Bolt<F>{}, few)}) {
    std::string all;
    bool named = false;
    for (const std::string& finding : findings) {
      CHECK(finding.rfind("Bolt: ", 0) == 0);
      named = named || finding.find(words) != std::string::npos;
      all += finding + "\n";
    }
    CAPTURE(words);
    CAPTURE(all);
    CHECK(named);
  }
}

template <class Law>
void check_sound(const Law& law, const BoltLawTrial& trial) {
  for (const auto& findings : {check_law<2>(law, trial), check_law<3>(law, trial)})
    for (const std::string& finding : findings) FAIL_CHECK(finding);
}

void check_all_sound(const BoltLawTrial& trial) {
  for (const bool strut : {false, true}) {
    AxialBolt::Params bolt{.axial_stiffness = 2e8, .carries_compression = strut};
    check_sound(AxialBolt(bolt), trial);
    bolt.pretension = 5e4;
    check_sound(AxialBolt(bolt), trial);
    bolt.yield_force = 1e5;
    check_sound(AxialBolt(bolt), trial);
    bolt.hardening_ratio = 0;
    check_sound(AxialBolt(bolt), trial);
    bolt.hardening_ratio = 0.1;
    bolt.rupture_force = 2e5;
    check_sound(AxialBolt(bolt), trial);
    check_sound(AxialShearBolt({.axial = bolt, .shear_stiffness = 1e8}), trial);
    bolt.rupture_force = 0.9e5;  // brittle
    check_sound(AxialBolt(bolt), trial);
    check_sound(AxialShearBolt({.axial = bolt, .shear_stiffness = 1e9}), trial);
  }
  check_sound(Bolt<Fault::none>{}, trial);
}

}  // namespace

TEST_SUITE("bolt/check_bolt_law") {
  TEST_CASE("the bolts of the toolkit are sound") { check_all_sound(few); }
  TEST_CASE("the bolts of the toolkit are sound on all paths [long]") { check_all_sound({}); }

  TEST_CASE("what is broken is named") {
    check_named<Fault::bound_in_giga>("is it in MN/m or GN/m?");
    check_named<Fault::dowel_unsaid>("stiffness bound: the tangent of `dowel`");
    check_named<Fault::dowel_unbooked>("energy is not booked");
    check_named<Fault::soft_bound>("stiffness bound: the tangent of `pull`");
    check_named<Fault::skew_bound>("that of `pull` is not symmetric");
    check_named<Fault::pushes>("tension is positive");
    check_named<Fault::world_axes>("has not its force turned with it");
    check_named<Fault::pull_of_jump>("follows `motion` alone");
    check_named<Fault::forgets>("`commit` changes the force");
    check_named<Fault::slips_on>("a second `commit`");
    check_named<Fault::loses>("energy is not booked");
    check_named<Fault::tells_otherwise>("`describe` tells other forces");
  }
}

}  // namespace check_bolt_law_test
