// SPDX-License-Identifier: MIT
// Linings whose nodes move: vibration and static forces against closed forms, rock that lands on
// them, and the same ring as at rest.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/slab_behind.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/lining/beams.hpp>
#include <voussoir/model/lining_members.hpp>
#include <voussoir/tunnel/measurements.hpp>

#include "support/blocks.hpp"
#include "support/faults.hpp"
#include "support/near.hpp"

namespace lining_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::fault_of;
using voussoir_test::rectangle;
using voussoir_test::says;

namespace {

using Run = Dynamics<2, CoulombJoint>;
const CoulombJoint joint({5e9, 5e8, 35 * degree});

/// A ring of shotcrete of radius 2.5 m, thickness 0.1 m, 72 nodes, without rock.
struct Ring {
  static constexpr int count = 72;
  static constexpr double radius = 2.5, thickness = 0.1, density = 2400;
  LiningSection section = LiningSection::rectangular(thickness, 30e9);
  Run run;
  std::shared_ptr<LiningMembers<Planar>> lining;

  explicit Ring(const DynamicsSettings& settings) : run(joint, settings) {
    section.mass = density * thickness;
    std::vector<LiningNode<2>> nodes;
    const double length = 2 * radius * std::sin(std::numbers::pi / count);
    for (int k = 0; k < count; ++k)
      nodes.push_back({place(k), {}, section.mass * length, Spin<2>(section.mass * length * 1e-3)});
    const int first = run.add_lining_nodes(nodes, joint);
    std::vector<FrameElement<Planar>> members;
    for (int k = 0; k < count; ++k) {
      const int next = (k + 1) % count;
      const Vec2 along = place(next) - place(k);
      members.push_back({first + k, first + next, length, frame_axes<2>(along, Vec2::Zero()),
                         EulerBernoulliBeam::stiffness<3>(section, length)});
    }
    lining = std::make_shared<LiningMembers<Planar>>(members, first, count);
    run.add_support(lining);
  }
  [[nodiscard]] static Vec2 place(int k) {
    const double angle = 2 * std::numbers::pi * k / count;
    return radius * Vec2(std::cos(angle), std::sin(angle));
  }
};

/// A beam of shotcrete from x = -2 to 2 m, clamped in fixed nodes, upper side at y = 0.
struct Beam {
  static constexpr int elements = 16;
  static constexpr double span = 4, thickness = 0.2;
  LiningSection section = LiningSection::rectangular(thickness, 30e9);
  Run run;
  int middle;
  std::shared_ptr<LiningMembers<Planar>> lining;

  /// @param density  small against that of what falls on it, where closed forms leave it out
  Beam(const DynamicsSettings& settings, double density) : run(joint, settings) {
    const double length = span / elements;
    section.mass = density * thickness;
    std::vector<LiningNode<2>> nodes;
    for (int k = 0; k <= elements; ++k) {
      const Vec2 at(-0.5 * span + k * length, 0);
      // The upper side of a tile: rock above it, the node below.
      const Segment top{at + Vec2(0.5 * length, 0), at - Vec2(0.5 * length, 0)};
      nodes.push_back({at,
                       {slab_behind(top, thickness)},
                       section.mass * length,
                       Spin<2>(section.mass * length * (length * length) / 12)});
    }
    const int first = run.add_lining_nodes(nodes, joint);
    middle = first + elements / 2;
    std::vector<FrameElement<Planar>> members;
    for (int k = 0; k < elements; ++k)
      members.push_back({first + k, first + k + 1, length, Rotation<2>::Identity(),
                         EulerBernoulliBeam::stiffness<3>(section, length)});
    lining = std::make_shared<LiningMembers<Planar>>(members, first, elements + 1);
    run.add_support(lining);
    run.fix(first);
    run.fix(first + elements);
  }
  [[nodiscard]] double deflection() const { return -run.position(middle).y(); }
};

}  // namespace

TEST_SUITE("dynamics/lining") {
  // Inextensional vibration of a thin ring in its plane, n = 2 lobes (Love, A treatise on the
  // mathematical theory of elasticity, art. 293b): omega^2 = n^2 (n^2 - 1)^2 / (n^2 + 1) E I / (m
  // R^4). Thin: (t/R)^2 = 0.16 %; 72 chords for the circle: their R is up to 0.1 % short.
  TEST_CASE("a ring rings with its period, energy kept") {
    Ring ring({.gravity = 0});
    for (int k = 0; k < Ring::count; ++k) {
      const double angle = 2 * std::numbers::pi * k / Ring::count;
      const Vec2 out(std::cos(angle), std::sin(angle));
      // Radial w cos 2 a, tangential -w/2 sin 2 a; a section turns by (v - w') / R.
      ring.run.set_velocity(
          k, 0.01 * (std::cos(2 * angle) * out - 0.5 * std::sin(2 * angle) * perpendicular(out)),
          Spin<2>(0.01 * 1.5 * std::sin(2 * angle) / Ring::radius));
    }
    const double omega = std::sqrt(36.0 / 5 * ring.section.bending_stiffness / ring.section.mass) /
                         (Ring::radius * Ring::radius);
    const double quarter = 0.5 * std::numbers::pi / omega;
    const double given = ring.run.kinetic_energy();
    double before = 1, turning = 0;
    for (int k = 0; k < 400 && turning == 0; ++k) {
      ring.run.advance(quarter / 200);
      const double now = ring.run.velocity(0).x();
      if (now < 0) turning = ring.run.time() - quarter / 200 * now / (now - before);
      before = now;
    }
    CHECK(turning == voussoir_test::near(quarter).epsilon(5e-3));
    CHECK(ring.run.energy().supports == voussoir_test::near(given).epsilon(5e-3));
    CHECK(std::abs(ring.run.energy().imbalance()) < 1e-4 * given);
  }

  TEST_CASE("a ring that turns about its axis is strained by nothing but the centrifugal force") {
    Ring ring({.gravity = 0});
    const double spin = 3;
    for (int k = 0; k < Ring::count; ++k)
      ring.run.set_velocity(k, turned(Spin<2>(spin), Ring::place(k)), Spin<2>(spin));
    // It breathes about a hoop force of m (spin R)^2, from 0 to twice that.
    const double hoop = ring.section.mass * spin * spin * Ring::radius * Ring::radius;
    double least = 0, largest_moment = 0;
    for (int k = 0; k < 200; ++k) {
      ring.run.advance(0.003);
      for (const LiningForce& at : lining_forces(ring.run, *ring.lining)) {
        least = std::min(least, at.thrust);
        largest_moment = std::max(largest_moment, std::abs(at.moment));
      }
    }
    CHECK(ring.run.body(0).angle == voussoir_test::near(1.8).epsilon(1e-3));
    CHECK(least == voussoir_test::near(-2 * hoop).epsilon(0.01));
    // Rigid turning by 1.8 rad would leave E I / R times that if it were strain: 1.8 MN m.
    CHECK(largest_moment < 1e-4 * hoop * Ring::radius);
    CHECK(std::abs(ring.run.energy().imbalance()) < 1e-4 * ring.run.kinetic_energy());
  }

  // A mass M that falls by h on a light spring k: deflection d (1 + sqrt(1 + 2 h / d)), d = M g /
  // k; k is that of a beam clamped at both ends, 192 E I / L^3, in a row with the joint, k_n b. The
  // beam has 1 % of the mass, whose impact may cost so much: sqrt of it in the deflection, 0.5 %.
  TEST_CASE("a block that lands on a beam bends it as much as its energy says") {
    for (const double height : {0.0, 0.02, 0.1}) {
      CAPTURE(height);
      Beam beam({.find_contacts = true}, 2400 / 200.0);
      const double width = 0.2, weight = 2700 * width * 1 * 9.81;
      const int block = beam.run.add_block(rectangle({0, 0.5 + height}, width, 1), 2700);
      const double of_beam = 192 * beam.section.bending_stiffness / std::pow(Beam::span, 3);
      const double spring = 1 / (1 / of_beam + 1 / (5e9 * width));
      const double still = weight / spring;
      const double deepest = still * (1 + std::sqrt(1 + 2 * height / still));
      double lowest = 0.5 + height, next = lowest;
      do {
        lowest = next;
        beam.run.advance(0.0005);
        next = beam.run.position(block).y();
      } while (next < lowest);  // it rebounds
      CHECK(0.5 - lowest == voussoir_test::near(deepest).epsilon(0.01));
      // It comes to rest: moments at the clamps and in the middle F L / 8.
      beam.run.set_local_damping(0.8);
      beam.run.advance(0.3);  // at rest within 1e-4 by then
      CHECK(beam.deflection() == voussoir_test::near(weight / of_beam).epsilon(0.01));
      const auto& member = beam.lining->members().front();
      const auto f = member.end_forces(beam.run.pose(member.i), beam.run.pose(member.j));
      CHECK(f[2] == voussoir_test::near(weight * Beam::span / 8).epsilon(0.02));
    }
  }

  TEST_CASE("a block thrown at a lining loads it and comes back") {
    Beam it({.speed_limit = 200}, 2400);
    const int block = it.run.add_block(rectangle({0, 1}, 0.5, 0.5), 2700);
    it.run.set_velocity(block, {0, -50});
    double deepest = 0, most = 0;
    for (int k = 0; k < 50; ++k) {
      it.run.advance(0.001);
      deepest = std::max(deepest, it.deflection());
      most = std::max(most, it.run.energy().above_start());
      // Its lower side and the upper one of the beam, each as stiff as 5 GPa/m on 0.25 m.
      CHECK(it.run.position(block).y() - 0.25 > -it.deflection() - 0.05);
    }
    CHECK(deepest > 0.05);
    CHECK(most < 0.01 * 0.5 * 2700 * 0.25 * 50 * 50);
    CHECK(it.run.velocity(block).y() > 10);
  }

  TEST_CASE("blocks that are thrown into a lining or past it are named") {
    Beam through({.overlap_limit = 0.02, .speed_limit = 200}, 2400);
    int block = through.run.add_block(rectangle({0, 1}, 0.5, 0.5), 2700);
    through.run.set_velocity(block, {0, -50});
    const std::string text = fault_of([&] { through.run.advance(0.5); });
    CAPTURE(text);
    CHECK(says(text, "overlaps"));
    CHECK(says(text, "lining node"));
    CHECK(says(text, "block " + std::to_string(block)));
    // The gap beside the beam: nothing is touched, but nothing here can be so fast.
    Beam past({}, 2400);
    block = past.run.add_block(rectangle({2.6, 1}, 0.5, 0.5), 2700);
    past.run.advance(0.01);
    past.run.set_velocity(block, {0, -50});
    const double before = past.run.time();
    const std::string other = fault_of([&] { past.run.advance(0.5); });
    CAPTURE(other);
    CHECK(says(other, "block " + std::to_string(block) + " at (2.6, "));
    CHECK(says(other, "moves at 50 m/s"));
    CHECK(past.run.time() <= before + 100 * past.run.step());
  }

  TEST_CASE_TEMPLATE("a member between nodes that have moved feels only what comes after", Geometry,
                     Planar, Spatial) {
    constexpr int dim = Geometry::dim, dof = Geometry::dof;
    const LiningSection section = LiningSection::strip(0.1, 1, 30e9);
    const double length = 0.5, stretch = 1e-5;
    const Vec<dim> x = Vec<dim>::UnitX(), y = Vec<dim>::UnitY();
    FrameElement<Geometry> member(0, 1, length, frame_axes<dim>(x, y),
                                  EulerBernoulliBeam::stiffness<dof>(section, length));
    // The rock has parted them by 3 mm, shifted them by 2 mm and turned them.
    Pose<dim> a, b;
    Spin<dim> spin = zeros<Spin<dim>>();
    spin[spin.size() - 1] = 4e-3;
    a.rotation = rotation_by(spin);
    b.rotation = rotation_by(Spin<dim>(-0.5 * spin));
    b.position = (length + 3e-3) * x + 2e-3 * y;
    const Fixed<2 * dof, 1> u = Fixed<2 * dof, 1>::Zero();
    member.install_at(a, b, u.data());
    CHECK(member.end_forces(a, b).norm() == 0);
    CHECK(member.energy(a, b) == 0);
    // EA / L per metre along the chord that it was installed on, and nothing else.
    b.position += stretch * b.position.normalized();
    const auto force = member.end_forces(a, b);
    const double pull = section.axial_stiffness * stretch / length;
    CHECK(force[dof] == voussoir_test::near(pull).epsilon(1e-9));
    CHECK(force[0] == voussoir_test::near(-pull).epsilon(1e-9));
    CHECK(std::abs(force.squaredNorm() - 2 * pull * pull) <= 1e-8 * pull * pull);
    CHECK(member.energy(a, b) == voussoir_test::near(0.5 * pull * stretch).epsilon(1e-9));
  }

  TEST_CASE("what is not a lining is refused") {
    Run run(joint);
    CHECK_THROWS_AS(run.add_lining_nodes({{{0, 0}, {}, 0, Spin<2>(1)}}, joint), InvalidInput);
    CHECK_THROWS_AS(run.add_lining_nodes({{{0, 0}, {}, 1, Spin<2>(0)}}, joint), InvalidInput);
    CHECK(run.body_count() == 0);
  }
}

}  // namespace lining_test
