// SPDX-License-Identifier: MIT
// Bolts, their anchors and linings of a model that are known at run time only: what they do is what
// the types do, and several of a model do not mix.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/bolt/any_anchors.hpp>
#include <voussoir/bolt/any_bolt.hpp>
#include <voussoir/contact/foot_bearing.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/contact/rock_on_lining.hpp>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/dynamics/set_in_motion.hpp>
#include <voussoir/equilibrium/any_method.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/lining/any_lining.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/lining_ribs.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/rib_forces.hpp>
#include <voussoir/tunnel/support_demand.hpp>
#include <voussoir/tunnel/support_forces.hpp>

#include "support/degree.hpp"
#include "support/faults.hpp"
#include "support/near.hpp"
#include "support/small_tunnel.hpp"

namespace any_supports_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::near;
using voussoir_test::refusal_of;
using voussoir_test::says;
using voussoir_test::small_in_situ;
using voussoir_test::small_opening;
using voussoir_test::small_rock;

namespace {

const CoulombJoint joint({5e9, 5e8, 35 * degree});
const CoulombJoint interface({1e9, 1e9, 30 * degree});
const AxialBolt axial({.axial_stiffness = 2e8, .yield_force = 1.5e4});
const AxialShearBolt dowelled({.axial = {.axial_stiffness = 1e8}, .shear_stiffness = 3e7});

template <int Dim>
std::vector<LiningSection> sections(LiningElement element, double thickness = 0.1) {
  std::vector<LiningSection> made{LiningSection::rectangular(thickness, 25e9)};
  if constexpr (Dim == 3)
    made = {LiningSection::strip(thickness, 1, 25e9), LiningSection::strip(thickness, 0.5, 25e9)};
  for (LiningSection& section : made) section.element = element;
  return made;
}
template <class Geometry>
LiningFrame<Geometry> frame_of(const RockMass<Geometry>& mass, const LiningRing& ring) {
  if constexpr (Geometry::dim == 2)
    return lining_frame(mass, ring);
  else
    return lining_frame(mass, LiningRibs{.ring = ring, .spacing = 1});
}
template <class Geometry>
auto bars() {
  const BoltPattern pattern{.length = 2, .angular_spacing = 45 * degree};
  if constexpr (Geometry::dim == 2)
    return bolt_bars(pattern, small_opening<Geometry>());
  else
    return bolt_bars(pattern, small_opening<Geometry>(), 1, 0, 3);
}

/// All that there is to differ.
struct Answer {
  Eigen::VectorXd displacement;
  Verdict verdict;
  std::vector<double> bolts, members;  ///< [N], [N], [N m]
  std::string composition;
};
template <class Tunnel>
Answer answer_of(const Tunnel& tunnel, const EquilibriumReport& report) {
  Answer answer{tunnel.system().displacement, report.verdict, {}, {}, Tunnel::composition()};
  for (const CrossingForce& at : bolt_forces(tunnel))
    for (const double value : {at.report.axial, at.report.shear, at.report.plastic_extension})
      answer.bolts.push_back(value);
  for (const auto& m : lining_members(tunnel))
    for (const double value : {m.thrust, m.shear, m.moment}) answer.members.push_back(value);
  return answer;
}

/// The small tunnel with a policy of each kind, in two stages: before support, and to the end.
template <class Geometry, class Bolt, class Anchors, class Lining, class BoltValue,
          class AnchorsValue>
Answer supported(const BoltValue& bolt, const AnchorsValue& anchors, LiningElement element,
                 const AnyMethod& method) {
  Solver<Geometry, Bolt, Anchors, Lining, AnyMethod> tunnel(small_rock<Geometry>(), joint,
                                                            small_in_situ);
  tunnel.excavate(small_opening<Geometry>(), 0.02);
  REQUIRE(tunnel.equilibrium(0.6, method).verdict == Verdict::stable);
  for (const auto& bar : bars<Geometry>()) tunnel.install_bolt(bar, bolt, 1.5, anchors);
  tunnel.install_lining(frame_of<Geometry>(tunnel.mass(), {.nodes = 24}),
                        sections<Geometry::dim>(element), interface);
  return answer_of(tunnel, tunnel.equilibrium(0, method));
}

/// What is known at run time against the types, to the last bit. @return  of the types
template <class Geometry, class Bolt, class Anchors, class Lining>
Answer check_same(const Bolt& bolt, const Anchors& anchors, LiningElement element,
                  const AnyMethod& method) {
  // A plain lining does not read the element: it is given another one.
  const LiningElement unread =
      element == LiningElement::pinned ? LiningElement::timoshenko : LiningElement::pinned;
  const Answer plain = supported<Geometry, Bolt, Anchors, Lining>(bolt, anchors, unread, method);
  const Answer any =
      supported<Geometry, AnyBolt, AnyAnchors, AnyLining>(bolt, anchors, element, method);
  CAPTURE(plain.composition);
  CHECK(plain.verdict == Verdict::stable);
  CHECK(any.verdict == plain.verdict);
  REQUIRE(any.displacement.size() == plain.displacement.size());
  CHECK(any.displacement == plain.displacement);
  CHECK(any.bolts == plain.bolts);
  CHECK(any.members == plain.members);
  // Bolts pull and linings press: there is something to compare.
  CHECK(*std::max_element(plain.bolts.begin(), plain.bolts.end()) > 1e3);
  CHECK(*std::max_element(plain.members.begin(), plain.members.end()) > 1e3);
  CHECK(any.composition.find("AnyAnchors, AnyBolt, AnyLining") != std::string::npos);
  return plain;
}
/// Every bolt, every way of anchoring, every lining.
template <class Geometry>
void check_every_choice(const AnyMethod& method) {
  const std::vector<Answer> answers{
      check_same<Geometry, AxialBolt, LorigAnchors, EulerBernoulliBeam>(
          axial, LorigAnchors{}, LiningElement::euler_bernoulli, method),
      check_same<Geometry, AxialShearBolt, GargaWangAnchors, TimoshenkoBeam>(
          dowelled, GargaWangAnchors{}, LiningElement::timoshenko, method),
      check_same<Geometry, AxialBolt, JointFaceAnchors, PinnedBar>(axial, JointFaceAnchors{},
                                                                   LiningElement::pinned, method),
      check_same<Geometry, AxialShearBolt, LorigAnchors, BondedChain>(
          dowelled, LorigAnchors{0.1}, LiningElement::bonded_chain, method)};
  for (std::size_t k = 1; k < answers.size(); ++k)
    CHECK(answers[k].displacement != answers[0].displacement);
}

/// Half of the load off, supported, then the rest: by the types and known at run time. The bolts
/// and the members where each is last.
template <class Geometry, class Bolt, class Lining>
void moving(const Bolt& bolt, LiningElement element) {
  const auto mass = carve(small_rock<Geometry>(), small_opening<Geometry>(), 0.02);
  const auto go = [&](const auto& law, auto lining, const auto& anchors) {
    auto run =
        moving_rock<CoulombJoint, CutContacts>(mass, joint, small_in_situ, {.local_damping = 0.3});
    run.set_held(0.5);
    run.advance_steps(10);
    const auto bolts = add_bolts(run, mass, bars<Geometry>(), law, 1.0, anchors);
    auto strips = sections<Geometry::dim>(element);
    for (LiningSection& section : strips) section.mass = 240;
    const auto members = add_lining<typename decltype(lining)::type>(
        run, frame_of<Geometry>(mass, {.nodes = 24}), strips, interface, 0.1);
    run.set_held(0);
    run.advance_steps(60);
    std::vector<double> values;
    for (const auto& m : lining_members(run, *members))
      for (const double value : {m.thrust, m.shear, m.moment}) values.push_back(value);
    for (const CrossingForce& at : bolt_forces(run, *bolts))
      for (const double value : {at.report.axial, at.report.shear}) values.push_back(value);
    return values;
  };
  const auto plain = go(bolt, std::type_identity<Lining>(), GargaWangAnchors{});
  CHECK(go(AnyBolt(bolt), std::type_identity<AnyLining>(), AnyAnchors(GargaWangAnchors{})) ==
        plain);
  CHECK(*std::max_element(plain.begin(), plain.end()) > 1e3);
}

/// Of the members of a lining.
template <class Tunnel>
double largest_moment(const Tunnel& tunnel, int lining) {
  double largest = 0;
  for (const auto& m : lining_members(tunnel))
    if (m.lining == lining) largest = std::max(largest, m.moment);
  return largest;
}

// ---- two tunnels in one rock, held between them ------------------------------------------------

const Domain<2> twin_ground{{-14, -6}, {14, 6}};
SimplePolygon tunnel_at(double x) {
  std::vector<Vec2> vertices;
  for (int k = 0; k < 24; ++k) {
    const double angle = 15 * k * degree;
    vertices.emplace_back(x + 2 * std::cos(angle), 2 * std::sin(angle));
  }
  return SimplePolygon(vertices);
}
const Acceptance exact{.error_estimate = 1e-8, .unbalance_over_weight = 1e-7};

/// Joints that neither open nor slip: where they do the answer is one of several.
const MohrCoulombJoint tied({.joint_normal_stiffness = 5e9,
                             .joint_shear_stiffness = 2e9,
                             .friction_angle = 60 * degree,
                             .cohesion = 2e9,
                             .tensile_strength = 1e9});

/// The left tunnel, the right tunnel: neither knows of the other, for what lies between is held.
template <class Bolt, class Anchors, class Lining>
struct Twins {
  Solver<MohrCoulombJoint, Bolt, Anchors, Lining> solver;
  std::vector<LiningFrame<Planar>> frames;

  Twins()
      : solver(voussoir_test::jointed_rock(twin_ground, 4), tied,
               {.density = 2700, .k0 = 0.8, .surcharge = 1e6}) {
    for (const double x : {-7.0, 7.0}) solver.excavate(tunnel_at(x), 0.02);
    for (std::size_t b = 0; b < solver.mass().bodies.size(); ++b)
      if (std::abs(solver.system().body(static_cast<int>(b)).centre.x()) < 2.5)
        solver.fix(static_cast<int>(b));
    for (const double x : {-7.0, 7.0})
      frames.push_back(lining_frame(solver.mass(), tunnel_at(x), {.nodes = 24}));
  }
  /// @param side  0: left, 1: right
  void support(int side, const Bolt& bolt, const Anchors& anchors, LiningElement element) {
    const double x = side == 0 ? -7 : 7;
    for (const double angle : {30, 70, 110, 150}) {
      const Vec2 out(std::cos(angle * degree), std::sin(angle * degree));
      solver.install_bolt({Vec2(x, 0) + 1.9 * out, Vec2(x, 0) + 4 * out}, bolt, 1, anchors);
    }
    solver.install_lining(frames[static_cast<std::size_t>(side)], sections<2>(element), interface);
  }
};

}  // namespace

TEST_SUITE("solver/any_supports") {
  TEST_CASE("every bolt, anchor and lining by TwoLevel: to the last bit those of its type") {
    check_every_choice<Planar>(AnyMethod(TwoLevel()));
    check_every_choice<Spatial>(AnyMethod(TwoLevel()));
  }
  TEST_CASE("by Relaxation") {
    check_every_choice<Planar>(AnyMethod(Relaxation()));
    check_every_choice<Spatial>(AnyMethod(Relaxation()));
  }
  TEST_CASE("by Explicit, 2-D") { check_every_choice<Planar>(AnyMethod(Explicit())); }
  TEST_CASE("by Explicit, 3-D [long]") { check_every_choice<Spatial>(AnyMethod(Explicit())); }

  TEST_CASE("in motion, 2-D") {
    moving<Planar, AxialBolt, EulerBernoulliBeam>(axial, LiningElement::euler_bernoulli);
    moving<Planar, AxialShearBolt, PinnedBar>(dowelled, LiningElement::pinned);
  }
  TEST_CASE("in motion, 3-D") {
    moving<Spatial, AxialShearBolt, BondedChain>(dowelled, LiningElement::bonded_chain);
    moving<Spatial, AxialBolt, PinnedBar>(axial, LiningElement::pinned);
  }

  TEST_CASE("a beam without shear deformation is that of Euler and Bernoulli") {
    // What the section says where every lining is a Timoshenko beam; bit for bit, for 12 E I over
    // an infinite stiffness is 0.
    const auto solved = [](auto tunnel, LiningSection section) {
      tunnel.install_lining(lining_frame(tunnel.mass(), {.nodes = 24}), section, interface);
      return answer_of(tunnel, tunnel.equilibrium());
    };
    const auto made = [](auto type) {
      typename decltype(type)::type tunnel(small_rock<Planar>(), joint, small_in_situ);
      tunnel.excavate(small_opening<Planar>(), 0.02);
      return tunnel;
    };
    LiningSection section = LiningSection::rectangular(0.1, 25e9);
    const Answer any = solved(made(std::type_identity<Solver<AnyLining>>()), section);
    section.shear_stiffness = std::numeric_limits<double>::infinity();
    const Answer stiff = solved(made(std::type_identity<Solver<TimoshenkoBeam>>()), section);
    CHECK(any.displacement == stiff.displacement);
    CHECK(any.members == stiff.members);
  }

  TEST_CASE("two patterns and two linings of a model are each their own") {
    // The left one and the right one as the only ones of a model of their types.
    Twins<AnyBolt, AnyAnchors, AnyLining> both;
    both.support(0, axial, GargaWangAnchors{}, LiningElement::pinned);
    both.support(1, dowelled, LorigAnchors{}, LiningElement::timoshenko);
    REQUIRE(both.solver.equilibrium(0, {}, exact).verdict == Verdict::stable);
    Twins<AxialBolt, GargaWangAnchors, PinnedBar> left;
    left.support(0, axial, {}, {});
    REQUIRE(left.solver.equilibrium(0, {}, exact).verdict == Verdict::stable);
    Twins<AxialShearBolt, LorigAnchors, TimoshenkoBeam> right;
    right.support(1, dowelled, {}, {});
    REQUIRE(right.solver.equilibrium(0, {}, exact).verdict == Verdict::stable);

    // Both searches end at 1e-8 of the largest displacement; forces are differences of these.
    constexpr double tolerance = 1e-5;
    const auto all = bolt_forces(both.solver);
    const auto compare_bolts = [&](const auto& alone, std::size_t first) {
      const auto expected = bolt_forces(alone.solver);
      double largest = 0, worst = 0;
      for (std::size_t k = 0; k < expected.size(); ++k) {
        largest = std::max(largest, expected[k].report.axial);
        worst = std::max({worst, std::abs(expected[k].report.axial - all[first + k].report.axial),
                          std::abs(expected[k].report.shear - all[first + k].report.shear)});
      }
      CHECK(largest > 1e3);
      CHECK(worst <= tolerance * largest);
      return first + expected.size();
    };
    CHECK(compare_bolts(right, compare_bolts(left, 0)) == all.size());

    const auto members = lining_members(both.solver);
    const auto compare_linings = [&](const auto& alone, std::size_t first) {
      const auto expected = lining_members(alone.solver);
      double thrust = 0, moment = 0, of_thrust = 0, of_moment = 0;
      for (std::size_t k = 0; k < expected.size(); ++k) {
        const auto &a = expected[k], &b = members[first + k];
        thrust = std::max(thrust, std::abs(a.thrust));
        moment = std::max(moment, a.moment);
        of_thrust = std::max(of_thrust, std::abs(a.thrust - b.thrust));
        of_moment = std::max(of_moment, std::abs(a.moment - b.moment));
      }
      CHECK(thrust > 1e4);
      CHECK(of_thrust <= tolerance * thrust);
      CHECK(of_moment <= tolerance * moment);
      return first + expected.size();
    };
    CHECK(compare_linings(right, compare_linings(left, 0)) == members.size());
    CHECK(largest_moment(both.solver, 0) == 0);
    CHECK(largest_moment(both.solver, 1) > 100);
    REQUIRE(both.solver.system().linings.size() == 2);
    CHECK(both.solver.system().linings[0].is_pinned);
    CHECK(!both.solver.system().linings[1].is_pinned);
  }

  TEST_CASE("patterns that differ in law and anchors, against one type that can be both") {
    // Without shear stiffness the one law is the other, and anchors of Lorig's very far from the
    // joint are in the middle of the blocks: to the last bit.
    const auto solved = [](auto tunnel, const auto& first, const auto& near_joint,
                           const auto& second, const auto& mid_block) {
      tunnel.excavate(small_opening<Planar>(), 0.02);
      const auto all = bars<Planar>();
      for (std::size_t k = 0; k < all.size(); ++k)
        if (k % 2 == 0)
          tunnel.install_bolt(all[k], first, 1, near_joint);
        else
          tunnel.install_bolt(all[k], second, 1, mid_block);
      return answer_of(tunnel, tunnel.equilibrium());
    };
    const AxialShearBolt like_axial(
        {.axial = {.axial_stiffness = 2e8, .yield_force = 1.5e4}, .shear_stiffness = 0});
    const Answer any =
                     solved(Solver<AnyBolt, AnyAnchors>(small_rock<Planar>(), joint, small_in_situ),
                            AnyBolt(axial), AnyAnchors(LorigAnchors{}), AnyBolt(dowelled),
                            AnyAnchors(GargaWangAnchors{})),
                 one = solved(Solver<AxialShearBolt, LorigAnchors>(small_rock<Planar>(), joint,
                                                                   small_in_situ),
                              like_axial, LorigAnchors{}, dowelled, LorigAnchors{1e9}),
                 swapped =
                     solved(Solver<AnyBolt, AnyAnchors>(small_rock<Planar>(), joint, small_in_situ),
                            AnyBolt(dowelled), AnyAnchors(LorigAnchors{}), AnyBolt(axial),
                            AnyAnchors(GargaWangAnchors{}));
    CHECK(any.displacement == one.displacement);
    CHECK(any.bolts == one.bolts);
    CHECK(any.bolts != swapped.bolts);
  }

  TEST_CASE("where a pinned lining goes on in one that bends the joint is a hinge") {
    for (const bool pinned_first : {true, false}) {
      CAPTURE(pinned_first);
      Solver<AnyLining> tunnel(small_rock<Planar>(), joint, small_in_situ);
      tunnel.excavate(small_opening<Planar>(), 0.02);
      const LiningRing roof{.nodes = 24, .from = 0, .to = 180 * degree},
          floor{.nodes = 24, .from = 180 * degree, .to = 360 * degree};
      const int pinned = pinned_first ? 0 : 1;
      for (const int k : {0, 1})
        tunnel.install_lining(
            frame_of<Planar>(tunnel.mass(), k == 0 ? roof : floor),
            sections<2>(k == pinned ? LiningElement::pinned : LiningElement::timoshenko, 0.2),
            interface);
      REQUIRE(tunnel.equilibrium(0, {}, exact).verdict == Verdict::stable);
      const auto joints =
          tunnel.system().supports.all<LiningJoints<Planar>>();  // those of the later lining
      REQUIRE(joints.size() == 1);
      REQUIRE(joints[0]->members().size() == 2);
      double thrust = 0;
      for (const auto& member : joints[0]->members()) {
        const auto f = member.end_forces(tunnel.system().displacement.data());
        thrust = std::max(thrust, f[0]);
        const auto is_pin = [&](int body) {
          const auto& lining = tunnel.system().linings[static_cast<std::size_t>(pinned)];
          return body >= lining.first &&
                 body < lining.first + static_cast<int>(lining.surface.node_count());
        };
        REQUIRE(is_pin(member.i) != is_pin(member.j));
        // Roundings of the turn of a pin, times its spring to nowhere.
        CHECK(std::abs(f[is_pin(member.i) ? 2 : 5]) < 1e-9);  // no moment on the pin
        if (pinned_first)
          CHECK(std::abs(f[is_pin(member.i) ? 5 : 2]) > 1);  // the beam bends up to it
        else
          CHECK(f[is_pin(member.i) ? 5 : 2] == 0);  // a bar between a pin and the beam
      }
      CHECK(thrust > 1e4);
      const auto pin_moments = [&] {
        double largest = 0;
        for (const auto* lining : tunnel.linings())
          for (const auto& e : lining->members())
            if (e.is_hinged[0] && e.is_hinged[1]) {
              const auto f = e.end_forces(tunnel.system().displacement.data());
              largest = std::max({largest, std::abs(f[2]), std::abs(f[5])});
            }
        return largest;
      };
      CHECK(pin_moments() < 1e-9);
      CHECK(support_demand(tunnel).largest_moment > 100);

      // In motion it stays where it is: the hinge is the same there.
      const double before = support_demand(tunnel).largest_thrust;
      auto run = set_in_motion(tunnel);
      const int first = tunnel.first_lining_node();
      const Vec2 place = run.position(first);
      run.advance_steps(500);
      // A search ends at a part of the displacements, some 0.1 mm, that is not nothing in motion.
      CHECK((run.position(first) - place).norm() < 1e-6);
      tunnel.take_back(run);
      REQUIRE(tunnel.equilibrium(0, {}, exact).verdict == Verdict::stable);
      CHECK(support_demand(tunnel).largest_thrust == near(before).epsilon(1e-3));
    }
  }
  TEST_CASE("ribs that bend beside pinned ones, in 3-D") {
    Solver<Spatial, AnyLining> tunnel(small_rock<Spatial>(), joint, small_in_situ);
    tunnel.excavate(small_opening<Spatial>(), 0.02);
    const LiningRing ring{.nodes = 24};
    const LiningRibs front{.ring = ring, .spacing = 0.75, .to = 1.5},
        back{.ring = ring, .spacing = 0.75, .from = 1.5};
    tunnel.install_lining(lining_frame(tunnel.mass(), front), sections<3>(LiningElement::pinned),
                          interface);
    tunnel.install_lining(lining_frame(tunnel.mass(), back),
                          sections<3>(LiningElement::bonded_chain), interface);
    REQUIRE(tunnel.equilibrium().verdict == Verdict::stable);
    double pinned = 0, chain = 0, thrust = 0;
    for (const RibForce& at : rib_forces(tunnel)) {
      (at.lining == 0 ? pinned : chain) =
          std::max(at.lining == 0 ? pinned : chain, std::abs(at.moment));
      if (at.lining == 0) thrust = std::max(thrust, at.thrust);
    }
    CHECK(pinned == 0);
    CHECK(thrust > 1e3);
    CHECK(chain > 10);
    int hinged = 0;
    for (const auto* joints : tunnel.system().supports.all<LiningJoints<Spatial>>())
      for (const auto& e : joints->members()) {
        const bool first_is_pin = e.i < tunnel.system().linings[1].first;
        CHECK(e.is_hinged == std::array<bool, 2>{first_is_pin, !first_is_pin});
        ++hinged;
      }
    CHECK(hinged == 24);  // a tie for each node of a rib
  }

  TEST_CASE(
      "of two linings a round leaves two nodes of one: a node that is hinged to nothing goes with it") {
    // The rock goes from behind the floor but for the facets next to the springings, where one of
    // its nodes stays each side.
    std::vector<Vec2> wall;
    const auto small = small_opening<Planar>();
    for (const Vec2& vertex : small.vertices())
      if (vertex.y() < -0.3) wall.push_back(vertex);
    std::sort(wall.begin(), wall.end(), [](const Vec2& p, const Vec2& q) { return p.x() > q.x(); });
    std::vector<Vec2> vertices{{-2.5, -3.5}, {2.5, -3.5}};
    vertices.insert(vertices.end(), wall.begin(), wall.end());
    const SimplePolygon bench(vertices);
    for (const auto& choice :
         {std::pair(true, true), {true, false}, {false, true}, {false, false}}) {
      const bool pinned_floor = choice.first, floor_first = choice.second;
      CAPTURE(pinned_floor);
      CAPTURE(floor_first);
      Solver<AnyLining> tunnel(small_rock<Planar>(), CoulombJoint({5e9, 5e8, 60 * degree}),
                               small_in_situ);
      tunnel.excavate(small_opening<Planar>(), 0.02);
      for (const bool is_floor : {floor_first, !floor_first})
        tunnel.install_lining(
            frame_of<Planar>(tunnel.mass(), {.nodes = 24,
                                             .from = (is_floor ? 180 : 0) * degree,
                                             .to = (is_floor ? 360 : 180) * degree}),
            sections<2>(
                is_floor == pinned_floor ? LiningElement::pinned : LiningElement::timoshenko, 0.2),
            interface);
      REQUIRE(tunnel.equilibrium().verdict == Verdict::stable);
      tunnel.excavate(bench, 0.02);
      const EquilibriumReport report = tunnel.equilibrium();
      CAPTURE(report.reason);
      CHECK(report.verdict == Verdict::stable);
      CHECK(report.lost_nodes.empty());
      REQUIRE(tunnel.opened_linings().size() >= 1);
      // A pin is fixed and stays. So does a node whose beam is hinged to the roof; the one that
      // would have a bar of the roof alone, on a hinge, goes.
      int standing = 0;
      const auto& floor = tunnel.system().linings[floor_first ? 0 : 1];
      for (int n = 0; n < static_cast<int>(floor.surface.node_count()); ++n)
        standing += tunnel.system().body(floor.first + n).movable;
      CHECK(standing == (!pinned_floor && floor_first ? 0 : 2));
    }
  }

  TEST_CASE("a pinned arch on feet has no moments") {
    Solver<AnyLining> tunnel(small_rock<Planar>(), joint, small_in_situ);
    tunnel.excavate(small_opening<Planar>(), 0.02);
    tunnel.install_lining(
        frame_of<Planar>(tunnel.mass(), {.nodes = 24, .from = -10 * degree, .to = 190 * degree}),
        sections<2>(LiningElement::pinned), interface,
        FootBearing({.width = 0.1, .stiffness = 5e9, .friction_angle = 30 * degree}));
    REQUIRE(tunnel.equilibrium().verdict == Verdict::stable);
    REQUIRE(foot_forces(tunnel).size() == 2);
    for (const auto& foot : foot_forces(tunnel)) CHECK(foot.bearing > 1e3);
    CHECK(support_demand(tunnel).largest_moment == 0);
    CHECK(support_demand(tunnel).largest_thrust > 1e3);
    // Nothing turns a pin: an arm of the foot would, by some 1e-6 rad.
    const auto* lining = tunnel.lining();
    for (int n = lining->first_node(); n < lining->first_node() + lining->node_count(); ++n)
      CHECK(std::abs(tunnel.system().displacement[3 * n + 2]) < 1e-15);
  }
  TEST_CASE("a bond needs close nodes where the lining bends, and none where it is pinned") {
    using Tunnel = Solver<RockOnLining<MohrCoulombJoint>, AnyLining>;
    Tunnel tunnel(small_rock<Planar>(), joint, small_in_situ);
    tunnel.excavate(small_opening<Planar>(), 0.02);
    const MohrCoulombJoint bond({1e9, 1e9, 35 * degree, 5e5, 2e5});
    const auto frame = frame_of<Planar>(tunnel.mass(), {.nodes = 24});
    Tunnel other = tunnel;
    CHECK(says(refusal_of([&] {
                 (void)other.install_lining(frame, sections<2>(LiningElement::bonded_chain), bond);
               }),
               "too far to see its bond"));
    CHECK_NOTHROW((void)tunnel.install_lining(frame, sections<2>(LiningElement::pinned), bond));
    // As many nodes as the bond of a beam needs are chosen for a beam alone.
    const auto nodes_of = [&](LiningElement element) {
      const LiningInstallation<Tunnel> lining{{}, sections<2>(element), bond};
      return detail::frame_of(tunnel, lining).nodes.size();
    };
    CHECK(nodes_of(LiningElement::pinned) == static_cast<std::size_t>(default_lining_nodes));
    CHECK(nodes_of(LiningElement::timoshenko) > static_cast<std::size_t>(default_lining_nodes));
  }
}

}  // namespace any_supports_test
