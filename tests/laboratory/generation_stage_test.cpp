// SPDX-License-Identifier: MIT
// Stress that a simulation builds up from nothing, against that of the depth; excavation and sides
// that are held.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/laboratory/generation_stage.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/blocks.hpp"
#include "support/near.hpp"

namespace generation_stage_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::rectangle;

namespace {

CoulombJoint joint(double friction) { return CoulombJoint({1e9, 5e8, friction}); }
const InSitu shallow{.density = 2700, .k0 = 1};
const SimplePolygon opening = circular_opening(3, 24);

RockMass<Planar> rock() {
  const Domain<2> ground{{-7, -6}, {7, 6}};
  const std::vector<JointSet> sets{{"a", 70 * degree, DipDirection::east, 2 * degree, 1, 0, 3},
                                   {"b", 20 * degree, DipDirection::west, 2 * degree, 1, 0, 3}};
  return slice(ground, joint_network(sets, ground, 4), {.min_inscribed_radius = 0.2});
}

/// The mean stress of the blocks within a circle: contact forces times the way between centres.
template <class Run>
Stress<2> mean_stress(const Run& run, double radius) {
  Stress<2> sum = Stress<2>::Zero();
  double area = 0;
  const auto inside = [&](int b) {
    return run.body(b).movable() && run.position(b).norm() < radius;
  };
  for (int b = 0; b < run.body_count(); ++b)
    if (inside(b)) area += run.body(b).mass / 2700;
  for (const auto& c : run.joints().contacts()) {
    const auto &a = run.body(c.a), &b = run.body(c.b);
    const Rotation<2> frame = a.pose.rotation * c.frame;
    const auto at = c.place(a.pose, b.pose);
    for (int k = c.first; k < c.last; ++k) {
      const auto& p = run.joints().points()[static_cast<std::size_t>(k)];
      const auto f = run.joints().law_of(c).force(p.load(at), p.state);
      const Vec2 force = frame.col(0) * f.normal + frame.col(1) * f.tangential[0];
      const Vec2 place = b.pose(p.place);
      // Each block its own share: from its centre to the point.
      if (inside(c.a)) sum += (place - a.pose.position) * force.transpose();
      if (inside(c.b)) sum += (b.pose.position - place) * force.transpose();
    }
  }
  return sum / area;
}

}  // namespace

TEST_SUITE("laboratory/generation_stage") {
  TEST_CASE("gravity and forces on the sides build up the stress of the depth") {
    auto made =
        generation_stage(rock(), opening, joint(1 * degree), shallow, {}, {.unbalance = 0.02});
    CHECK(made.unbalance < 0.02);
    const Stress<2> s = mean_stress(made.run, 5);
    const double expected = shallow.vertical(6);
    // Stress scatters from block to block; over some hundred of them the mean is that of the
    // depth to a few per cent, what friction of 1 degree and the settlement leave.
    CHECK(s(0, 0) == voussoir_test::near(expected).epsilon(0.03));
    CHECK(s(1, 1) == voussoir_test::near(expected).epsilon(0.03));
    CHECK(std::abs(s(0, 1)) <= 0.03 * expected);
  }

  TEST_CASE("a tunnel taken out of it converges; sides that are fixed do not move") {
    auto made =
        generation_stage(rock(), opening, joint(1 * degree), shallow, {}, {.unbalance = 0.02});
    made.fix_sides();
    made.run.set_laws(joint(35 * degree));
    const auto bars = bolt_bars({.length = 3, .angular_spacing = 30 * degree}, opening);
    const auto bolts = add_bolts(made.run, made.mass, bars, AxialBolt({.axial_stiffness = 1e8}), 1,
                                 LorigAnchors{});
    REQUIRE(!bolts->springs().empty());
    (void)made.run.contact_load(0);  // forces are computed
    const std::size_t count = bolts->springs().size();
    for (std::size_t k = 0; k < count; ++k) CHECK(std::abs(bolts->axial_force(k)) < 1);  // [N]
    std::vector<Vec2> before;
    for (const int b : made.sides) before.push_back(made.run.position(b));
    made.excavate();
    made.run.advance(0.3);
    for (std::size_t k = 0; k < before.size(); ++k)
      CHECK(made.run.position(made.sides[k]) == before[k]);
    double most = 0;
    for (std::size_t k = 0; k < count; ++k) most = std::max(most, bolts->axial_force(k));
    CHECK(most > 1e3);
    CHECK(most < 2e5);
    // What is out of the way holds nothing and does not move.
    const Vec2 gone = made.run.position(made.inside.front());
    CHECK(made.run.contact_load(made.inside.front()).force.norm() == 0);
    made.run.advance(0.01);
    CHECK(made.run.position(made.inside.front()) == gone);
    // A fault right after a block was fixed is found before anything moves.
    made.run.fix(0);
    const double time = made.run.time();
    made.run.set_velocity(1, {std::nan(""), 0});
    CHECK_THROWS_AS(made.run.advance(0.1), NumericalFault);
    CHECK(made.run.time() == time);
  }

  TEST_CASE("bad settings are named") {
    const auto with = [](GenerationSettings how) {
      (void)generation_stage(rock(), opening, joint(1 * degree), shallow, {}, how);
    };
    CHECK_THROWS_AS(with({.segment = 0}), InvalidInput);
    CHECK_THROWS_AS(with({.unbalance = 0}), InvalidInput);
    CHECK_THROWS_AS(with({.longest = -1}), InvalidInput);
    CHECK_THROWS_AS(with({.local_damping = 1}), InvalidInput);
    CHECK_THROWS_AS(with({.unbalance = 1e-9, .longest = 0.15}), NumericalFault);
    const SimplePolygon notched({{-1, -1}, {1, -1}, {1, 1}, {0, 0}, {-1, 1}});
    CHECK_THROWS_AS((void)generation_stage(rock(), notched, joint(0), shallow), InvalidInput);
  }
}

}  // namespace generation_stage_test
