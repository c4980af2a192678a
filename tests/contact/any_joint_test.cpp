// SPDX-License-Identifier: MIT
// One law of several types: what it does is what the type does, for a point and in a rock mass.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/contact/any_joint.hpp>
#include <voussoir/contact/check_law.hpp>
#include <voussoir/contact/laws_by_set.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/solver/creep.hpp>
#include <voussoir/solver/solver.hpp>

#include "support/degree.hpp"

namespace any_joint_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

const CoulombJoint coulomb({5e9, 5e8, 30 * degree});
const MohrCoulombJoint bonded({.joint_normal_stiffness = 5e9,
                               .joint_shear_stiffness = 5e8,
                               .friction_angle = 30 * degree,
                               .cohesion = 2e5,
                               .tensile_strength = 1e5,
                               .dilation_angle = 5 * degree,
                               .dilation_limit = 0.01});
const BartonBandisJoint rough({10, 50e6, 28 * degree, 2e10, 2e-4});
const BurgersJoint creeping({5e9, 5e8, 30 * degree, 1e16, 1e9, 1e15});
/// Without cohesion it is a Coulomb joint.
const MohrCoulombJoint like_coulomb({5e9, 5e8, 30 * degree});

/// A path of pressing, opening and sliding under which the type and the law that holds it do the
/// same at every step.
template <int Dim, class Law>
void follow(const Law& law, std::uint64_t seed) {
  const AnyJoint any(law);
  typename Law::template State<Dim> own;
  AnyJoint::State<Dim> held;
  Random random(seed, 1);
  PointLoad<Dim> load{0.7, {1e6, zeros<Vec<Dim - 1>>()}, {0, zeros<Vec<Dim - 1>>()}};
  load.initial.tangential[0] = 2e5;
  for (int step = 0; step < 200; ++step) {
    load.motion.opening += 3e-5 * random.normal();
    for (int m = 0; m < Dim - 1; ++m) load.motion.slip[m] += 4e-4 * random.normal();
    const auto a = law.force(load, own), b = any.force(load, held);
    REQUIRE(a.normal == b.normal);
    REQUIRE(a.tangential == b.tangential);
    REQUIRE(law.stored_energy(load, own) == any.stored_energy(load, held));
    REQUIRE(opening_of(release_opening<Dim>(law, load, own)) ==
            opening_of(any.release_opening(load, held)));
    const ContactReport x = report_of(law, load, own), y = report_of(any, load, held);
    REQUIRE(x.plastic_slip == y.plastic_slip);
    REQUIRE(x.damage == y.damage);
    REQUIRE(law.commit(load, own) == any.commit(load, held));
    if constexpr (CreepingLaw<Law, Dim>) {
      law.creep(load, own, 1e5);
      any.creep(load, held, 1e5);
    }
  }
}

const Domain<2> ground{{-4, -4}, {4, 4}};
const InSitu in_situ{.density = 2700, .k0 = 1, .surcharge = 1e6};

RockMass<Planar> two_sets() {
  const std::vector<JointSet> sets{{"flat", 10 * degree, DipDirection::east, 0, 0.5, 0, 5},
                                   {"steep", 80 * degree, DipDirection::west, 0, 0.5, 0, 5}};
  return slice(ground, joint_network(sets, ground, 1), {.min_inscribed_radius = 0.1});
}
const std::vector<Vec2> hole{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

/// Displacements and detached blocks of an unlined hole in rock of two sets.
struct Answer {
  Eigen::VectorXd displacement;
  Verdict verdict;
  std::size_t fallen;
};
template <class Law, class Method = TwoLevel>
Answer excavated(const LawsBySet<Law>& laws) {
  Solver<Law, Method> rock(two_sets(), laws, in_situ, SimplePolygon(hole));
  const EquilibriumReport report = rock.equilibrium();
  return {rock.system().displacement, report.verdict, rock.fallen().size()};
}

/// Two sets of Coulomb joints, against the second as a Mohr-Coulomb joint without cohesion.
template <class Method>
void check_against_one_type(double friction) {
  const CoulombJoint first({5e9, 5e8, friction});
  const MohrCoulombJoint second({3e9, 6e8, friction});
  const CoulombJoint second_by_coulomb({3e9, 6e8, friction});
  LawsBySet<CoulombJoint> one_type(first);
  one_type.add(1, second_by_coulomb);
  LawsBySet<AnyJoint> mixed{AnyJoint(first)}, alone{AnyJoint(first)};
  mixed.add(1, AnyJoint(second));
  alone.add(1, AnyJoint(second_by_coulomb));
  const Answer expected = excavated<CoulombJoint, Method>(one_type),
               same = excavated<AnyJoint, Method>(alone),
               other = excavated<AnyJoint, Method>(mixed);
  // Where all are of one type the contacts work with that: to the last bit.
  CHECK(same.displacement == expected.displacement);
  CHECK(same.verdict == expected.verdict);
  CHECK(other.verdict == expected.verdict);
  CHECK(other.fallen == expected.fallen);
  // Two types do the same sums in another order of operations; the search stops at its tolerance.
  if (expected.fallen == 0)
    CHECK((other.displacement - expected.displacement).norm() <=
          1e-3 * expected.displacement.norm());
}

}  // namespace

TEST_SUITE("contact/any_joint") {
  TEST_CASE("a law does what its type does, bit for bit, in 2-D and 3-D") {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      follow<2>(coulomb, seed);
      follow<3>(coulomb, seed);
      follow<2>(bonded, seed);
      follow<3>(bonded, seed);
      follow<2>(rough, seed);
      follow<3>(rough, seed);
      follow<2>(creeping, seed);
      follow<3>(creeping, seed);
    }
    CHECK(AnyJoint(rough).type_name() == std::string("BartonBandisJoint"));
    CHECK(AnyJoint(rough).as<BartonBandisJoint>() != nullptr);
    CHECK(AnyJoint(rough).as<CoulombJoint>() == nullptr);
    CHECK(AnyJoint(creeping).creep_time() == creeping.creep_time());
    CHECK(std::isinf(AnyJoint(coulomb).creep_time()));
  }

  TEST_CASE("what another law remembered is known by its shear spring") {
    // Slides by 3 mm under one law and is found anew under another of the same stiffness: it
    // carries what it carried.
    AnyJoint::State<2> state;
    PointLoad<2> load{1, {1e6, zeros<Vec<1>>()}, {0, Vec<1>(-3e-3)}};
    const double before = AnyJoint(coulomb).force(load, state).tangential[0];
    AnyJoint(coulomb).commit(load, state);
    CHECK(std::abs(before - 1e6 * std::tan(30 * degree)) < 1e-6 * before);
    load.motion.slip[0] += 1e-4;
    const double unloaded = before - 5e8 * 1e-4;
    for (const AnyJoint& law : {AnyJoint(coulomb), AnyJoint(like_coulomb), AnyJoint(creeping)})
      CHECK(std::abs(law.force(load, state).tangential[0] - unloaded) < 1e-9 * before);
  }

  TEST_CASE("sets of several types in one rock mass, by every procedure") {
    check_against_one_type<TwoLevel>(60 * degree);
    check_against_one_type<Relaxation>(60 * degree);
    check_against_one_type<Explicit>(60 * degree);
  }
  TEST_CASE("sets of several types where rock falls") {
    check_against_one_type<TwoLevel>(25 * degree);
  }

  TEST_CASE("sets of several types in 3-D") {
    const Domain<3> box{{-3, -3, -3}, {3, 3, 3}};
    SpatialJointSet flat{"flat", 5 * degree, 0}, steep{"steep", 80 * degree, 90 * degree},
        across{"across", 85 * degree, 0};
    for (SpatialJointSet* set : {&flat, &steep, &across}) set->spacing = 1.1;
    const auto solved = [&](const LawsBySet<AnyJoint>& laws) {
      Solver<Spatial, AnyJoint> rock(
          slice<Spatial>(box, joint_network(std::vector{flat, steep, across}, box, 3),
                         {.min_inscribed_radius = 0.1}),
          laws, in_situ, PrismaticOpening(SimplePolygon(hole)));
      CHECK(rock.equilibrium().verdict == Verdict::stable);
      return Eigen::VectorXd(rock.system().displacement);
    };
    LawsBySet<AnyJoint> one{AnyJoint(CoulombJoint({5e9, 5e8, 60 * degree}))}, mixed = one;
    one.add(2, AnyJoint(CoulombJoint({3e9, 6e8, 60 * degree})));
    mixed.add(2, AnyJoint(MohrCoulombJoint({3e9, 6e8, 60 * degree})));
    const Eigen::VectorXd expected = solved(one), found = solved(mixed);
    CHECK((found - expected).norm() <= 1e-3 * expected.norm());
  }

  TEST_CASE("the joints that creep do, beside others that do not") {
    const auto crown = [](const AnyJoint& second, double time) {
      LawsBySet<AnyJoint> laws{AnyJoint(coulomb)};
      laws.add(1, second);
      Solver<AnyJoint> rock(two_sets(), laws, in_situ, SimplePolygon(hole));
      REQUIRE(rock.equilibrium().verdict == Verdict::stable);
      const Eigen::VectorXd before = rock.system().displacement;
      if (time > 0) (void)creep(rock, time, [](const CreepState&) { return true; });
      return (rock.system().displacement - before).norm();
    };
    const BurgersJoint slow({5e9, 5e8, 60 * degree, 1e16});
    // Without creep the search goes on by what its tolerance had left.
    const double moved = crown(AnyJoint(slow), 1e6);
    CHECK(moved > 1e-6);
    CHECK(crown(AnyJoint(CoulombJoint({5e9, 5e8, 60 * degree})), 1e6) < 0.01 * moved);
  }

  TEST_CASE("the check of laws finds in a law what it finds in its type") {
    // Coulomb's joint has no findings; one that lifts has, see tests/contact/check_law_test.
    CHECK(check_law<2>(AnyJoint(coulomb), {}).empty());
    CHECK(check_law<3>(AnyJoint(coulomb), {}).empty());
    CHECK(check_law<2>(AnyJoint(bonded), {}).size() == check_law<2>(bonded, {}).size());
    CHECK(check_law<2>(AnyJoint(rough), {}).size() == check_law<2>(rough, {}).size());
  }
}

}  // namespace any_joint_test
