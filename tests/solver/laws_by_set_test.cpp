// SPDX-License-Identifier: MIT
// Joint sets with laws of their own: every contact has the law of its joint, however it was found,
// and what it does is that law's.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>
#include <voussoir/contact/laws_by_set.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/model/contact_update.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/solver/solver.hpp>

#include "support/degree.hpp"

namespace laws_by_set_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

const Domain<2> ground{{-4, -4}, {4, 4}};
const InSitu in_situ{.density = 2700, .k0 = 1, .surcharge = 1e6};

CoulombJoint joint(double normal_stiffness, double friction = 35 * degree) {
  return CoulombJoint({normal_stiffness, 0.5 * normal_stiffness, friction});
}

/// Two sets that dip by 10 and 80 degrees, without scatter; the second has its own law.
RockMass<Planar> two_sets() {
  const std::vector<JointSet> sets{{"flat", 10 * degree, DipDirection::east, 0, 0.4, 0, 3},
                                   {"steep", 80 * degree, DipDirection::west, 0, 0.4, 0, 3}};
  return slice(ground, joint_network(sets, ground, 1), {.min_inscribed_radius = 0.1});
}
LawsBySet<CoulombJoint> two_laws() {
  LawsBySet<CoulombJoint> laws(joint(1e9));
  laws.add(1, joint(3e9));
  return laws;
}

/// Contacts whose law is not that of the joint set with their direction.
template <class Contacts, class NormalOf>
int mistaken(const Contacts& contacts, NormalOf&& normal_of) {
  int wrong = 0;
  for (const auto& c : contacts) {
    const Vec2 normal = normal_of(c);
    const double steepness = std::atan2(std::abs(normal.x()), std::abs(normal.y()));
    wrong += c.law != (steepness > 45 * degree ? 1 : 0);
  }
  return wrong;
}

template <class Detector>
void check_laws() {
  Solver<Detector> rock(two_sets(), two_laws(), in_situ);
  const auto of_system = [](const auto& c) { return c.normal; };
  const auto& joints = rock.system().joints;
  REQUIRE(joints.contacts().size() > 50);
  REQUIRE(joints.laws().size() == 2);
  CHECK(mistaken(joints.contacts(), of_system) == 0);
  update_contacts(detail::SystemOf::in(rock), 1e-4);
  CHECK(mistaken(joints.contacts(), of_system) == 0);
}

}  // namespace

TEST_SUITE("solver/laws_by_set") {
  TEST_CASE("every contact has the law of its joint set, from cuts, by search, and in motion") {
    check_laws<CutContacts>();
    check_laws<FaceContacts>();
    auto run = moving_rock(two_sets(), two_laws(), in_situ);
    (void)run.stable_step();  // contacts are found
    int rubbing = 0;
    std::vector<typename std::decay_t<decltype(run.joints())>::Contact> touching;
    for (const auto& c : run.joints().contacts()) {
      // Corners that only meet belong to either joint.
      double length = 0;
      for (int k = c.first; k < c.last; ++k)
        length += run.joints().points()[static_cast<std::size_t>(k)].weight;
      if (length < 1e-3) continue;
      touching.push_back(c);
      ++rubbing;
    }
    REQUIRE(rubbing > 50);
    CHECK(mistaken(touching, [&](const auto& c) {
            return Vec2(run.body(c.a).pose.rotation * c.frame.col(0));
          }) == 0);
  }

  TEST_CASE("a stack of slabs closes by the sum of its joints") {
    const std::vector<Joint> joints{{{{-5, -1}, {5, -1}}, 0}, {{{-5, 1}, {5, 1}}, 7}};
    LawsBySet<CoulombJoint> laws(joint(1e9));
    laws.add(7, joint(4e9));
    Solver<> stack(slice(ground, joints, {}), laws, in_situ);
    int top = 0;
    for (int b = 1; b < 3; ++b)
      if (stack.system().body(b).centre.y() > stack.system().body(top).centre.y()) top = b;
    const double more = 1e5;
    detail::SystemOf::in(stack).load[3 * top + 1] -= more;
    CHECK(stack.equilibrium().verdict == Verdict::stable);
    // The edge of the domain is as stiff as the stiffest joint; 8 m of each. The error estimate.
    const double closure = more / 8 * (1 / 1e9 + 1 / 4e9 + 1 / 4e9);
    CHECK(std::abs(-stack.system().displacement[3 * top + 1] - closure) <= 1e-3 * closure);
  }

  TEST_CASE("a set has one law, and sets are counted from 0") {
    LawsBySet<CoulombJoint> laws(joint(1e9));
    laws.add(2, joint(2e9));
    CHECK_THROWS_AS(laws.add(2, joint(3e9)), InvalidInput);
    CHECK_THROWS_AS(laws.add(-1, joint(3e9)), InvalidInput);
    CHECK(laws.all().size() == 2);
    CHECK(laws.stiffest() == 2e9);
  }
}

}  // namespace laws_by_set_test
