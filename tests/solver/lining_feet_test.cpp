// SPDX-License-Identifier: MIT
// An arch on feet carries thrust down to them; one that nothing holds is said to come off the wall.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/model/lining_feet.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/lining_ribs.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/support_demand.hpp>
#include <voussoir/tunnel/support_forces.hpp>

#include "support/faults.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace lining_feet_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_rock;
using voussoir_test::says;

namespace {

const Acceptance tight{.error_estimate = 1e-6};
const CoulombJoint joint({5e9, 5e8, 40 * degree});
const CoulombJoint smooth({5e9, 5e9, 0}), rough({5e9, 5e9, 20 * degree});
const InSitu in_situ{.density = 2700, .surcharge = 1e6};
const FootBearing strong({.width = 0.2, .stiffness = 5e9, .friction_angle = 30 * degree});
const LiningRing arch{.from = 0, .to = 180 * degree};

LiningSection shotcrete() {
  LiningSection section = LiningSection::rectangular(0.2, 25e9);
  section.mass = 500;
  return section;
}

Solver<> excavated(const SimplePolygon& opening = circular_opening(5, 36), int seed = 4) {
  Solver<> tunnel(jointed_rock(domain_around(opening, 20, 7, 7), static_cast<std::uint64_t>(seed)),
                  joint, in_situ);
  tunnel.excavate(opening);
  return tunnel;
}

std::vector<const LiningFeet<2>*> feet_of(const Solver<>& tunnel) {
  return tunnel.system().supports.all<LiningFeet<2>>();
}

/// What the rock and the feet do to the nodes of the lining, less its weight [N].
Vec2 load_on_lining(const Solver<>& tunnel) {
  const auto& system = tunnel.system();
  const double* u = system.displacement.data();
  Vec2 sum(0, 0);
  const int first = tunnel.first_lining_node();
  system.interface.visit(u, [&](const auto& c, const auto&, const auto&, const auto& f) {
    const Vec2 on_b = f.normal * c.normal + Vec2(c.tangents() * f.tangential);
    sum += c.b >= first ? on_b : Vec2(-on_b);
  });
  for (const auto* feet : feet_of(tunnel))
    for (const auto& foot : feet->springs())
      sum -= foot.frame * foot.force(feet->law(), foot.motion_at(u));
  for (int n = 0; n < tunnel.lining()->node_count(); ++n) sum.y() -= system.body(first + n).weight;
  return sum;
}

}  // namespace

TEST_SUITE("solver/lining_feet") {
  void arches(const std::vector<int>& seeds) {
    for (const int seed : seeds) {
      CAPTURE(seed);
      auto on_feet = excavated(circular_opening(5, 36), seed);
      auto hung = on_feet;
      const auto frame = lining_frame(on_feet.mass(), arch);
      REQUIRE(frame.ends.size() == 2);
      on_feet.install_lining(frame, shotcrete(), rough, strong);
      hung.install_lining(frame, shotcrete(), rough);
      REQUIRE(on_feet.equilibrium(0, {}, tight).verdict == Verdict::stable);
      // Nothing holds the other: it slides off the wall and is taken out. The report says what is
      // missing, and the rock is what it is without a lining.
      auto bare = excavated(circular_opening(5, 36), seed);
      const EquilibriumReport report = hung.equilibrium(), without = bare.equilibrium();
      CHECK(report.verdict == without.verdict);
      CHECK(report.fallen_measure == without.fallen_measure);
      CHECK(report.lost_nodes.size() == frame.nodes.size());
      if (report.verdict == Verdict::stable)
        CHECK(std::string(to_string(report)) == "stable without its lining");
      CAPTURE(report.reason);
      CHECK(says(report.reason, "the lining comes off the wall: at ("));
      CHECK(says(report.reason, "give its ends feet"));
      for (const LiningForce& at : lining_forces(hung)) {
        CHECK(at.is_lost);
        CHECK(at.thrust == 0);
      }
      for (const LiningForce& at : lining_forces(on_feet)) CHECK_FALSE(at.is_lost);
      CHECK(support_demand(hung).mean_thrust == 0);
      const auto feet = foot_forces(on_feet);
      REQUIRE(feet.size() == 2);
      REQUIRE(feet_of(hung).empty());
      // By the other way: what the rock, the feet and the weight do to it is nothing together.
      double bearing = 0;
      for (const auto& foot : feet) bearing += foot.bearing;
      CHECK(bearing > 1e5);
      CHECK(load_on_lining(on_feet).norm() < 1e-3 * bearing);
      // The thrust beside a foot is what the foot bears, but for half a stretch of wall.
      const auto members = lining_members(on_feet);
      CHECK(members.front().thrust == voussoir_test::near(feet.front().bearing).epsilon(0.15));
      CHECK(members.back().thrust == voussoir_test::near(feet.back().bearing).epsilon(0.15));
      for (const auto& foot : feet) {
        CHECK(std::abs(foot.place.y()) < 1e-3);  // at the springing
        CHECK(foot.direction.y() < -0.99);       // down
        CHECK(std::isnan(foot.utilisation));     // no strength was given: not checked
        CHECK(foot.plastic_settlement == 0);
        CHECK_FALSE(foot.has_yielded());
        // All of it is elastic: the bearing over stiffness and width.
        CHECK(foot.settlement == voussoir_test::near(foot.bearing / (5e9 * 0.2)).epsilon(1e-9));
        CHECK(foot.shear <= std::tan(30 * degree) * foot.bearing * (1 + 1e-9));
      }
    }
  }

  TEST_CASE("an arch carries its load to its feet, and comes off the wall without them") {
    arches({1});
  }
  TEST_CASE("an arch carries its load to its feet, in other rock [long]") { arches({2, 3}); }

  TEST_CASE("a foot bears no more than its strength, and settles") {
    auto tunnel = excavated();
    const auto frame = lining_frame(tunnel.mass(), arch);
    auto weak = tunnel;
    tunnel.install_lining(frame, shotcrete(), smooth, strong);
    REQUIRE(tunnel.equilibrium(0, {}, tight).verdict == Verdict::stable);
    const auto full = foot_forces(tunnel);
    const double most = 0.5 * std::min(full[0].bearing, full[1].bearing);
    // In one step: on its way a foot that has yielded may be relieved again.
    const TwoLevel in_one_step({.increments = 1});
    weak.install_lining(frame, shotcrete(), smooth,
                        FootBearing({.width = 0.2,
                                     .stiffness = 5e9,
                                     .strength = most / 0.2,
                                     .friction_angle = 30 * degree}));
    REQUIRE(weak.equilibrium(0, in_one_step, tight).verdict == Verdict::stable);
    for (const auto& foot : foot_forces(weak)) {
      CHECK(foot.bearing == voussoir_test::near(most).epsilon(1e-9));
      CHECK(foot.utilisation == voussoir_test::near(1).epsilon(1e-9));
      CHECK(foot.plastic_settlement > 0);
      CHECK(foot.has_yielded());
      // What stays, and what the strength does to the spring under it.
      CHECK(foot.settlement ==
            voussoir_test::near(foot.plastic_settlement + most / (5e9 * 0.2)).epsilon(1e-9));
    }
    CHECK(load_on_lining(weak).norm() < 1e-3 * most);
  }

  TEST_CASE("a foot presses and never pulls; it turns with what it stands under") {
    const FootBearing::State<2> fresh{};
    const auto at = [](double opening, double slip) {
      return PointLoad<2>{0.2, {}, {opening, Vec<1>(slip)}};
    };
    CHECK(strong.force(at(1e-3, 0), fresh).normal == 0);
    CHECK(strong.force(at(-1e-3, 0), fresh).normal == voussoir_test::near(5e9 * 0.2 * 1e-3));
    CHECK(strong.force(at(-1e-3, 5e-3), fresh).tangential[0] ==
          voussoir_test::near(-std::tan(30 * degree) * 1e6));
    // A node above rock, pressed by 1 mm and sheared by 0.1 mm; then all is turned by 50 degrees.
    LiningFootSpring<2> spring;
    spring.node = 0;
    spring.rock = 1;
    spring.arm_node = {0.1, -0.2};
    spring.arm_rock = {0.1, 0.8};
    spring.frame << 0, 1, -1, 0;  // down, to the right
    spring.area = 0.2;
    spring.offset = {-1e-3, 1e-4};
    LiningFeet<2> feet(strong, {spring});
    const Eigen::VectorXd still = Eigen::VectorXd::Zero(6);
    const auto on_rock = [&] {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(6);
      feet.add_forces(still.data(), f.data(), nullptr);
      CHECK((f.segment<2>(0) + f.segment<2>(3)).norm() < 1e-6);
      return Vec2(f.segment<2>(3));
    };
    const Vec2 before = on_rock();
    CHECK(before.x() == voussoir_test::near(-1e5));
    CHECK(before.y() == voussoir_test::near(-1e6));
    Pose<2> node, rock, turn;
    node.position = {0, 1};
    turn.rotation = rotation_by(Spin<2>(50 * degree));
    feet.to_frames({node, rock}, still.data());
    for (Pose<2>* pose : {&node, &rock}) {
      pose->position = turn.rotation * pose->position;
      pose->rotation = turn.rotation * pose->rotation;
    }
    feet.from_frames({node, rock}, still.data());
    CHECK((on_rock() - turn.rotation * before).norm() < 1e-6 * before.norm());
  }

  TEST_CASE("set in motion, and back at rest, feet bear what they bore") {
    auto tunnel = excavated();
    tunnel.install_lining(lining_frame(tunnel.mass(), arch), shotcrete(), smooth, strong);
    REQUIRE(tunnel.equilibrium(0.3, {}, tight).verdict == Verdict::stable);
    const auto before = foot_forces(tunnel);
    auto run = set_in_motion(tunnel, {.local_damping = 0.7});
    tunnel.take_back(run);
    const auto after = foot_forces(tunnel);
    for (std::size_t k = 0; k < 2; ++k) {
      // Turns of 1e-3 rad, whose square a small displacement leaves out.
      CHECK(after[k].bearing == voussoir_test::near(before[k].bearing).epsilon(1e-4));
      CHECK(after[k].shear == voussoir_test::near(before[k].shear).epsilon(0.01));
      CHECK((after[k].place - before[k].place).norm() < 1e-9);
    }
    // Installed in rock that moves, it comes to bear the same as at rest.
    auto still = excavated();
    // Holes of dropped pieces are spanned here. Filled, the motion is 1.1 % below the lower of the
    // two at rest, where 1 % is asked.
    LiningRing spanning = arch;
    spanning.fill_depth = 0;
    const auto frame = lining_frame(still.mass(), spanning);
    still.install_lining(frame, shotcrete(), smooth, strong);
    REQUIRE(still.equilibrium(0, {}, tight).verdict == Verdict::stable);
    auto moving = moving_rock(still.mass(), joint, in_situ, {.local_damping = 0.8});
    const auto lining =
        add_lining<EulerBernoulliBeam>(moving, frame, {shotcrete()}, smooth, 0.2, strong);
    for (int k = 1; k <= 4; ++k) {
      moving.set_held(1 - 0.25 * k);
      moving.advance_steps(8000);
    }
    // Friction remembers the path: procedures at rest differ by up to 8 %, and the motion, at rest
    // within 1e-2 by then, is between them.
    const SimplePolygon opening = circular_opening(5, 36);
    Solver<Relaxation> relaxed(jointed_rock(domain_around(opening, 20, 7, 7), std::uint64_t{4}),
                               joint, in_situ);
    relaxed.excavate(opening);
    relaxed.install_lining(frame, shotcrete(), smooth, strong);
    REQUIRE(relaxed.equilibrium(0, {}, tight).verdict == Verdict::stable);
    const auto moved = lining_members(moving, *lining), by_steps = lining_members(still),
               by_shaking = lining_members(relaxed);
    for (const std::size_t k : {std::size_t{0}, moved.size() - 1}) {
      const auto [low, high] = std::minmax(by_steps[k].thrust, by_shaking[k].thrust);
      CHECK(high < 1.1 * low);
      CHECK(moved[k].thrust > 0.99 * low);
      CHECK(moved[k].thrust < 1.01 * high);
    }
    CHECK(std::abs(moving.energy().relative_imbalance()) < 1e-3);
  }

  TEST_CASE("a foot whose rock is excavated is gone, and the others go on") {
    const auto section = horseshoe_opening(5, 3);
    Solver<> tunnel(jointed_rock(domain_around(section, 20, 8, 8), 3), joint, in_situ);
    tunnel.excavate(section);
    tunnel.install_lining(lining_frame(tunnel.mass(), arch), shotcrete(), rough, strong);
    REQUIRE(tunnel.equilibrium(0.5).verdict == Verdict::stable);
    const auto before = foot_forces(tunnel);
    REQUIRE(before.size() == 2);
    const std::size_t right = before[0].place.x() > 0 ? 0 : 1;
    CHECK((before[right].place - Vec2(2.5, 0)).norm() < 1e-3);
    // A niche in the wall, from 1 m below the foot to the end of the lining.
    tunnel.excavate(SimplePolygon({{2.5, -1}, {3.5, -1}, {3.5, 0}, {2.5, 0}}));
    const auto after = foot_forces(tunnel);
    REQUIRE(after.size() == 1);
    CHECK(after[0].place.x() < 0);
    CHECK(after[0].bearing == voussoir_test::near(before[1 - right].bearing).epsilon(1e-9));
  }

  TEST_CASE("an end that goes on in a lining that stands has no foot") {
    auto tunnel = excavated();
    tunnel.install_lining(lining_frame(tunnel.mass(), arch), shotcrete(), smooth, strong);
    REQUIRE(tunnel.equilibrium(0.5).verdict == Verdict::stable);
    tunnel.install_lining(lining_frame(tunnel.mass(), {.from = 180 * degree, .to = 270 * degree}),
                          shotcrete(), smooth, strong);
    // What is left: the right foot of the arch, and one at the other end of what goes on.
    REQUIRE(feet_of(tunnel).size() == 2);
    CHECK(feet_of(tunnel)[0]->springs().size() == 1);
    CHECK(feet_of(tunnel)[1]->springs().size() == 1);
    CHECK(foot_forces(tunnel)[0].place.x() > 0);
  }

  TEST_CASE("feet without ends or without rock are refused, and nothing is installed") {
    auto tunnel = excavated();
    const int bodies = tunnel.system().body_count();
    const auto refusal = [&](const LiningFrame<Planar>& frame) -> std::string {
      try {
        tunnel.install_lining(frame, shotcrete(), smooth, strong);
      } catch (const InvalidInput& refused) {
        return refused.what();
      }
      return "";
    };
    CHECK(says(refusal(lining_frame(tunnel.mass(), LiningRing{})), "closed and has no ends"));
    CHECK(tunnel.system().body_count() == bodies);
    auto undercut = lining_frame(tunnel.mass(), arch);
    undercut.ends[1].body = -1;
    const std::string text = refusal(undercut);
    CAPTURE(text);
    CHECK(says(text, "no rock under the foot at (-2.5"));
    CHECK(tunnel.system().body_count() == bodies);
    CHECK_THROWS_AS(FootBearing({.width = 0, .stiffness = 1e9, .friction_angle = 0}), InvalidInput);
    CHECK_THROWS_AS(FootBearing({.width = 1, .stiffness = 1e9, .strength = 0, .friction_angle = 0}),
                    InvalidInput);
  }

  TEST_CASE(
      "where a piece at the wall is too small for a block, the foot stands on what is behind") {
    int ends = 0, beside_a_hole = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(seed);
      const auto opening = horseshoe_opening(2.2, 2, 36);
      Solver<> tunnel(jointed_rock(domain_around(opening, 12, 5, 5), seed), joint, in_situ);
      tunnel.excavate(opening);
      const auto frame = lining_frame(tunnel.mass(), arch);
      const double stretch = opening.perimeter() / 72;
      for (const auto& end : frame.ends) {
        ++ends;
        REQUIRE(end.body >= 0);
        const Vec2 outward = Vec2(end.place.x() > 0 ? 1 : -1, 0);
        beside_a_hole += detail::body_at<Planar>(
                             tunnel.mass(), Vec2(end.place + 0.06 * stretch * outward)) != end.body;
        // The rock is no further than the corner of a stretch: brute force over a fine grid.
        double nearest = 10 * stretch;
        for (int i = -40; i <= 40; ++i)
          for (int k = -40; k <= 40; ++k) {
            const Vec2 way(i * stretch / 20, k * stretch / 20);
            if (way.norm() < nearest &&
                detail::body_at<Planar>(tunnel.mass(), Vec2(end.place + way)) == end.body)
              nearest = way.norm();
          }
        CHECK(nearest <= std::sqrt(2) * stretch);
      }
    }
    CHECK(ends == 40);
    CHECK(beside_a_hole >= 3);
  }

  TEST_CASE(
      "a foot whose rock has fallen is left out, is told, and the construction goes on [long]") {
    Construction<Solver<>> plan;
    plan.acceptance.collapse_measure = 1e3;
    const auto opening = circular_opening(5, 36);
    plan.add_stage("excavation", 0).excavate(opening);
    const auto loose = [&] {
      return Solver<>(jointed_rock(domain_around(opening, 20, 7, 7), 4),
                      CoulombJoint({5e9, 5e8, 20 * degree}), {.density = 2700});
    };
    auto bare = loose();
    REQUIRE(construct(bare, plan).verdict() == Verdict::stable);
    REQUIRE(!bare.fallen().empty());
    // An arc that begins on the wall of a block that has fallen, and ends where none has.
    const auto is_gone = [&](int body) {
      return std::count(bare.fallen().begin(), bare.fallen().end(), body) > 0;
    };
    const auto hanging_at = [&](double from) {
      const auto frame = lining_frame(bare.mass(), {.from = from, .to = from + 120 * degree});
      const auto standing =
          std::count_if(frame.contacts.begin(), frame.contacts.end(),
                        [&](const auto& contact) { return !is_gone(contact.body); });
      return is_gone(frame.ends[0].body) && frame.ends[1].body >= 0 &&
             !is_gone(frame.ends[1].body) && 2 * standing > std::ssize(frame.contacts);
    };
    double angle = 0;
    while (angle < 360 * degree && !hanging_at(angle)) angle += 1 * degree;
    REQUIRE(hanging_at(angle));
    plan.add_stage("support").install_lining(
        {{.from = angle, .to = angle + 120 * degree}, {shotcrete()}, rough, {}, strong});
    auto tunnel = loose();
    const auto built = construct(tunnel, plan);
    REQUIRE(built.stages.size() == 2);
    CHECK(foot_forces(tunnel).size() == 1);
    const auto& hanging = tunnel.system().linings[0].hanging_ends;
    REQUIRE(hanging.size() == 1);
    CHECK((hanging[0] - Vec2(2.5 * std::cos(angle), 2.5 * std::sin(angle))).norm() <
          0.02);  // the chord of a node is 36 facets of the circle, 1 cm inside
    const auto remarks = remarks_on(support_condition(tunnel));
    CHECK(std::any_of(remarks.begin(), remarks.end(), [](const std::string& text) {
      return says(text, "the rock there had fallen before it was installed");
    }));
  }

  TEST_CASE("ribs in 3-D stand on feet, each for its stretch of the tunnel") {
    const Domain<3> ground{{-6, 0, -6}, {6, 2, 7}};
    SpatialJointSet a{"J1", 75 * degree, 80 * degree}, b{"J2", 25 * degree, 100 * degree},
        c{"J3", 80 * degree, 5 * degree};
    for (SpatialJointSet* set : {&a, &b, &c}) set->spacing = 1.5;
    Solver<Spatial> tunnel(
        slice<Spatial>(ground, joint_network({a, b, c}, ground, 1), {.min_inscribed_radius = 0.15}),
        CoulombJoint({5e9, 5e8, 40 * degree}), {.density = 2700, .surcharge = 4e5});
    tunnel.excavate(PrismaticOpening(circular_opening(4, 20)), 0.02);
    LiningSection rib = LiningSection::strip(0.15, 1, 25e9),
                  tie = LiningSection::strip(0.15, 0.5, 25e9);
    rib.mass = 360;
    tie.mass = 180;
    tunnel.install_lining(
        lining_frame(tunnel.mass(), LiningRibs{.ring = {.nodes = 20, .from = 0, .to = 180 * degree},
                                               .spacing = 1}),
        {rib, tie}, smooth, strong);
    REQUIRE(tunnel.equilibrium(0.2, {}, tight).verdict == Verdict::stable);
    const auto feet = foot_forces(tunnel);
    REQUIRE(feet.size() == 4);
    for (const auto& foot : feet) {
      CHECK(foot.bearing > 1e4);
      CHECK(std::abs(foot.place.z()) < 0.7);
    }
    auto run = set_in_motion(tunnel, {.local_damping = 0.7});
    tunnel.take_back(run);
    const auto after = foot_forces(tunnel);
    for (std::size_t k = 0; k < feet.size(); ++k)
      CHECK(after[k].bearing == voussoir_test::near(feet[k].bearing).epsilon(1e-4));
  }
}

}  // namespace lining_feet_test
