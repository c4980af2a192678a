// SPDX-License-Identifier: MIT
// One bolt law and one way of anchoring of several types: what they do is what the type does.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <voussoir/bolt/any_anchors.hpp>
#include <voussoir/bolt/any_bolt.hpp>
#include <voussoir/bolt/check_bolt_law.hpp>
#include <voussoir/core/random.hpp>

namespace any_bolt_test {

using namespace voussoir;

namespace {

const AxialBolt axial({.axial_stiffness = 2e8,
                       .pretension = 1e4,
                       .yield_force = 1e5,
                       .rupture_force = 1.3e5,
                       .hardening_ratio = 0.05});
const AxialShearBolt dowelled(
    {.axial = {.axial_stiffness = 1e8, .yield_force = 8e4, .rupture_force = 9e4},
     .shear_stiffness = 3e7});

/// Pulls and does not say what it is: a state of its own type, and no `describe`.
class Friction {
 public:
  using role = roles::BoltLaw;
  static constexpr const char* name = "Friction";
  struct State {
    double slid = 0;  ///< [m]
  };
  template <int Dim>
  [[nodiscard]] BoltForce<Dim> force(const BoltSpan<Dim>& span, const State& state) const {
    const double pull = axial_at(span, state);
    return {pull * span.axis, pull};
  }
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    const double over = stiffness_ * (span.axis.dot(span.motion) - state.slid) - grip_;
    if (over > 0) state.slid += over / stiffness_;
    return false;
  }
  template <int Dim>
  [[nodiscard]] BoltStiffness<Dim> stiffness(const BoltSpan<Dim>& span) const {
    return {stiffness_ * outer(span.axis, span.axis)};
  }
  template <int Dim>
  [[nodiscard]] double energy(const BoltSpan<Dim>& span, const State& state) const {
    const double pull = axial_at(span, state);
    State then = state;
    (void)commit(span, then);
    return 0.5 * pull * pull / stiffness_ + grip_ * then.slid;
  }

 private:
  template <int Dim>
  [[nodiscard]] double axial_at(const BoltSpan<Dim>& span, const State& state) const {
    const double pull = stiffness_ * (span.axis.dot(span.motion) - state.slid);
    return pull < 0 ? 0 : pull > grip_ ? grip_ : pull;
  }
  double stiffness_ = 2e8, grip_ = 5e4;
};
using WithFriction = AnyBoltOf<AxialBolt, AxialShearBolt, Friction>;
static_assert(BoltLaw<WithFriction, 2> && BoltLaw<WithFriction, 3>);
static_assert(!HasBoltReport<Friction, 2> && HasBoltReport<WithFriction, 2>);
static_assert(!std::is_constructible_v<AnyBolt, Friction>);
static_assert(!std::is_constructible_v<AnyAnchors, AxialBolt>);

/// A path of pulling, shearing and letting go under which the type and what holds it do the same at
/// every step.
template <class Any, int Dim, class Law>
bool follow(const Law& law, std::uint64_t seed) {
  const Any any(law);
  typename Law::State own;
  typename Any::State held;
  Random random(seed, 7);
  BoltSpan<Dim> span{zeros<Vec<Dim>>(), zeros<Vec<Dim>>(), zeros<Vec<Dim>>()};
  span.axis[0] = 0.6;
  span.axis[1] = 0.8;
  span.initial = 0.07 * span.axis;
  bool broken = false;
  for (int step = 0; step < 100; ++step) {
    for (int m = 0; m < Dim; ++m) {
      span.motion[m] += 1e-4 * random.normal() + 8e-5 * span.axis[m];
      span.jump[m] += 1e-4 * random.normal();
    }
    const BoltForce<Dim> a = law.force(span, own), b = any.force(span, held);
    REQUIRE(a.pull == b.pull);
    REQUIRE(a.axial == b.axial);
    REQUIRE(a.dowel == b.dowel);
    REQUIRE(law.stiffness(span).pull == any.stiffness(span).pull);
    REQUIRE(law.stiffness(span).dowel == any.stiffness(span).dowel);
    REQUIRE(law.energy(span, own) == any.energy(span, held));
    const bool breaks = law.commit(span, own);
    REQUIRE(any.commit(span, held) == breaks);
    broken = broken || breaks;
    REQUIRE(law.energy(span, own) == any.energy(span, held));
    const BoltReport x = report_of(law, span, own, broken), y = report_of(any, span, held, broken);
    REQUIRE(x.axial == y.axial);
    REQUIRE(x.shear == y.shear);
    REQUIRE(x.plastic_extension == y.plastic_extension);
    REQUIRE(x.is_yielding == y.is_yielding);
    REQUIRE(x.is_broken == y.is_broken);
  }
  return broken;
}
template <class Any, class Law>
int broken_of(const Law& law) {
  int broken = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    broken += follow<Any, 2>(law, seed) + follow<Any, 3>(law, seed);
  return broken;
}

}  // namespace

TEST_SUITE("bolt/any_bolt") {
  TEST_CASE("a law does what its type does, bit for bit, in 2-D and 3-D, until it breaks") {
    CHECK(broken_of<AnyBolt>(axial) > 0);
    CHECK(broken_of<AnyBolt>(dowelled) > 0);
    CHECK(broken_of<WithFriction>(axial) > 0);
    CHECK(broken_of<WithFriction>(dowelled) > 0);
    CHECK(broken_of<WithFriction>(Friction()) == 0);
  }
  TEST_CASE("it knows its type") {
    CHECK(AnyBolt(axial).type_name() == std::string("AxialBolt"));
    CHECK(AnyBolt(dowelled).type_name() == std::string("AxialShearBolt"));
    CHECK(AnyBolt(dowelled).as<AxialShearBolt>() != nullptr);
    CHECK(AnyBolt(dowelled).as<AxialBolt>() == nullptr);
    CHECK(WithFriction(Friction()).type_name() == std::string("Friction"));
  }
  TEST_CASE("states of one type in two laws are each their own") {
    // What another law has left, which no bolt ever has: as if nothing had happened.
    BoltSpan<2> span{Vec2(0.07, 0), Vec2(1, 0), Vec2(1e-3, 0)};
    AnyBolt::State state;
    REQUIRE(!AnyBolt(axial).commit(BoltSpan<2>{Vec2(0.07, 0), Vec2(1, 0), Vec2(6e-4, 0)}, state));
    CHECK(AnyBolt(axial).describe(span, state).plastic_extension > 0);
    CHECK(AnyBolt(dowelled).describe(span, state).plastic_extension == 0);
  }
  TEST_CASE("it is sound where its type is") {
    for (const AnyBolt& law : {AnyBolt(axial), AnyBolt(dowelled)}) {
      CHECK(check_law<2>(law).empty());
      CHECK(check_law<3>(law).empty());
    }
  }

  TEST_CASE("anchors are where their type has them; Lorig's by default") {
    const LorigAnchors near{0.05};
    const JointFaceAnchors face;
    const GargaWangAnchors middle;
    for (const BoltCrossing& crossing : {BoltCrossing{0.02, 3}, {1, 0.7}, {0, 2}}) {
      const auto same = [&](const AnyAnchors& any, const auto& type) {
        const AnchorDistances a = any.distances(crossing), b = type.distances(crossing);
        CHECK(a.before == b.before);
        CHECK(a.after == b.after);
      };
      same(near, near);
      same(face, face);
      same(middle, middle);
      same({}, LorigAnchors{});
    }
    CHECK(AnyAnchors().type_name() == std::string("LorigAnchors"));
    CHECK(AnyAnchors(middle).type_name() == std::string("GargaWangAnchors"));
    CHECK(AnyAnchors(face).type_name() == std::string("JointFaceAnchors"));
    CHECK(AnyAnchors(near).as<LorigAnchors>()->distance == 0.05);
    CHECK(AnyAnchors(near).as<GargaWangAnchors>() == nullptr);
    CHECK_THROWS_AS((void)AnyAnchors(LorigAnchors{0}).distances({1, 1}), InvalidInput);
  }
}

}  // namespace any_bolt_test
