// SPDX-License-Identifier: MIT
// A horseshoe in heading and bench, its lining an arch on feet that two legs carry on: built in two
// ways that come to one thing it is one thing, in every table and picture.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/contact/rock_on_lining.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/geometry/tunnel_axis.hpp>
#include <voussoir/io/solved_picture.hpp>
#include <voussoir/io/tunnel_tables.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/joined_openings.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "support/faults.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"
#include "support/transformed.hpp"

namespace heading_and_bench_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::mirrored_2d;
using voussoir_test::moved;
using voussoir_test::paper_sets;
using voussoir_test::says;
using voussoir_test::Transform;

namespace {

// The arch ends on the walls of the heading, half a metre above its floor: the rock beside and
// under its ends stays, and their feet would if nothing took them.
const SimplePolygon whole = horseshoe_opening(6, 2.5, 36);
constexpr double heading_floor = -1, arch_end = -0.5;
const SimplePolygon bench({{-3, -2.5}, {3, -2.5}, {3, heading_floor}, {-3, heading_floor}});
const double shoulder = std::atan2(-arch_end, 3), foot_angle = std::atan2(2.2, 3);

SimplePolygon heading() {
  std::vector<Vec2> corners = whole.vertices();
  for (Vec2& v : corners) v.y() = std::max(v.y(), heading_floor);
  return SimplePolygon(corners);
}

const CoulombJoint joints({5e9, 5e8, 40 * degree}), wall({5e9, 5e9, 20 * degree});
const FootBearing foot({.width = 0.2, .stiffness = 5e9, .friction_angle = 30 * degree});
const AxialBolt bolt({.axial_stiffness = 2e8});

/// Neither opens nor slips.
const MohrCoulombJoint strong({.joint_normal_stiffness = 5e9,
                               .joint_shear_stiffness = 2e9,
                               .friction_angle = 60 * degree,
                               .cohesion = 1e9,
                               .tensile_strength = 5e8});
const InSitu in_situ{.density = 2700, .k0 = 0.8, .surcharge = 5e5};
const auto ground = domain_around(whole, 20, 7, 6);

template <class Tunnel>
Tunnel rock(std::uint64_t seed, const Transform<2>& map = {}) {
  return Tunnel(
      slice(map(ground), moved(joint_network(paper_sets(), ground, seed), map), {0.25, 5}), joints,
      in_situ);
}

template <class Tunnel>
LiningInstallation<Tunnel> lining(double from, double to, double thickness = 0.2) {
  LiningSection shotcrete = LiningSection::rectangular(thickness, 25e9);
  shotcrete.mass = 2500 * thickness;
  return {{.from = from, .to = to}, {shotcrete}, wall, whole, foot};
}
template <class Tunnel>
LiningInstallation<Tunnel> arch() {
  return lining<Tunnel>(-shoulder, 180 * degree + shoulder);
}
template <class Tunnel>
std::vector<LiningInstallation<Tunnel>> legs(double thickness = 0.2) {
  return {lining<Tunnel>(180 * degree + shoulder, 180 * degree + foot_angle, thickness),
          lining<Tunnel>(-foot_angle, -shoulder, thickness)};
}

/// Heading, arch and bolts, bench and legs.
template <class Tunnel>
Construction<Tunnel> plan(const Transform<2>& map = {}) {
  Construction<Tunnel> made;
  made.add_stage("heading", 0.5).excavate(moved(heading(), map));
  std::vector<Segment> bars;
  for (const Segment& bar : bolt_bars(
           {.length = 2, .angular_spacing = 40 * degree, .from = 50 * degree, .to = 130 * degree},
           whole))
    bars.push_back(moved(bar, map));
  made.add_stage("arch", 0.3).install_bolts({bars, bolt}).install_lining(arch<Tunnel>());
  auto& last = made.add_stage("bench").excavate(moved(bench, map));
  for (const auto& leg : legs<Tunnel>()) last.install_lining(leg);
  return made;
}

template <class Tunnel>
ConstructionResult<Planar> built(Tunnel& tunnel, const Construction<Tunnel>& made) {
  auto result = construct(tunnel, made);
  INFO(result.last().reason);
  REQUIRE(result.verdict() == Verdict::stable);
  return result;
}

double largest_thrust(const std::vector<LiningForce>& forces) {
  double most = 0;
  for (const LiningForce& at : forces) most = std::max(most, at.thrust);
  return most;
}

/// The largest of thrust, and of moment over the thickness, by which two linings differ, over the
/// largest thrust.
double difference(const std::vector<LiningForce>& a, const std::vector<LiningForce>& b) {
  REQUIRE(a.size() == b.size());
  double apart = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    CHECK((a[k].position - b[k].position).norm() < 1e-9);
    apart = std::max(
        {apart, std::abs(a[k].thrust - b[k].thrust), std::abs(a[k].moment - b[k].moment) / 0.2});
  }
  return apart / largest_thrust(a);
}

}  // namespace

TEST_SUITE("tunnel/heading_and_bench") {
  template <class Tunnel, class Law>
  LiningInstallation<Tunnel> weightless(double from, double to, const Law& interface_law) {
    return {{.nodes = 144, .from = from, .to = to},
            {LiningSection::rectangular(0.2, 25e9)},
            interface_law,
            whole,
            FootBearing({.width = 0.2, .stiffness = 5e9, .friction_angle = 80 * degree})};
  }

  /// Arch in the heading, legs in the bench, against all three in the section excavated at once:
  /// the difference of the linings.
  template <class Tunnel>
  double difference_of_ways(const Tunnel& start,
                            const typename Tunnel::InterfaceLaw& interface_law) {
    const auto crown = weightless<Tunnel>(-shoulder, 180 * degree + shoulder, interface_law),
               left = weightless<Tunnel>(180 * degree + shoulder, 180 * degree + foot_angle,
                                         interface_law),
               right = weightless<Tunnel>(-foot_angle, -shoulder, interface_law);
    Construction<Tunnel> at_once, in_rounds;
    at_once.acceptance =
        in_rounds.acceptance = {.error_estimate = 1e-9, .unbalance_over_weight = 1e-7};
    at_once.add_stage("all")
        .excavate(whole)
        .install_lining(crown)
        .install_lining(left)
        .install_lining(right);
    in_rounds.add_stage("heading", 1).excavate(heading()).install_lining(crown);
    in_rounds.add_stage("bench").excavate(bench).install_lining(left).install_lining(right);
    Tunnel one = start, two = start;
    built(one, at_once);
    built(two, in_rounds);
    CHECK(foot_forces(two).size() == 2);
    const Convergence b = convergence(two), c = convergence(two, whole);
    CHECK(b.crown == voussoir_test::near(convergence(one).crown).epsilon(1e-3));
    CHECK(b.crown == voussoir_test::near(c.crown).epsilon(1e-9));
    CHECK(b.invert == voussoir_test::near(c.invert).epsilon(1e-9));
    // Where the walls of the rounds part, a piece of wall is two, each with its own middle.
    CHECK(b.right_springing == voussoir_test::near(c.right_springing).epsilon(0.02));
    CHECK(b.left_springing == voussoir_test::near(c.left_springing).epsilon(0.02));
    return difference(lining_forces(one), lining_forces(two));
  }

  // Nothing moves while all walls are held: the lining of both ways is then the same members and
  // contacts, free of force, under feet that bear nothing, and one stage unloads both. What is left
  // of a foot that should be gone shows, as does a contact that got lost when the bench cut its
  // block.
  TEST_CASE("arch in the heading, legs in the bench: the lining of the section at once") {
    using Linear = Solver<MohrCoulombJoint, RockOnLining<MohrCoulombJoint>>;
    for (const std::uint64_t seed : {1, 2, 3}) {
      CAPTURE(seed);
      const auto mass = voussoir_test::jointed_rock(ground, seed);
      // One answer: rounding, 1e-14 measured, times the condition of a stiff lining.
      CHECK(difference_of_ways(Linear(mass, strong, in_situ), strong) < 1e-11);
    }
  }

  TEST_CASE("arch in the heading, legs in the bench, where joints slip [long]") {
    // A face that the floor of the heading has cut has two points where it had one, and contact
    // updates come at other moments: measured 6e-6, 1.4e-3, 3e-14.
    for (const std::uint64_t seed : {1, 2, 3}) {
      CAPTURE(seed);
      CHECK(difference_of_ways(rock<Solver<>>(seed), wall) < 5e-3);
    }
  }

  TEST_CASE("the foot of an end that goes on is gone, and what it bore goes down the legs") {
    for (const std::uint64_t seed : {1, 2}) {
      CAPTURE(seed);
      using Tunnel = Solver<>;
      Construction<Tunnel> first = plan<Tunnel>(), second = first;
      second.stages.erase(second.stages.begin(), second.stages.begin() + 2);
      first.stages.pop_back();
      Tunnel tunnel = rock<Tunnel>(seed);
      built(tunnel, first);
      const auto on_arch = foot_forces(tunnel);
      REQUIRE(on_arch.size() == 2);
      for (const auto& at : on_arch) CHECK(at.bearing > 1e4);
      // Excavating the bench alone takes no foot: the rock that they stand on stays.
      Tunnel undercut = tunnel;
      undercut.excavate(bench);
      CHECK(foot_forces(undercut).size() == 2);
      built(tunnel, second);
      const auto on_legs = foot_forces(tunnel);
      REQUIRE(on_legs.size() == 2);
      double bearing = 0;
      for (const auto& at : on_legs) {
        CHECK(at.place.y() < heading_floor);
        bearing += at.bearing;
      }
      CHECK(bearing > 1e5);
      // By the other way: what rock, feet and weight do to all nodes is nothing together.
      const auto& system = tunnel.system();
      const double* u = system.displacement.data();
      const int node = tunnel.first_lining_node();
      Vec2 sum(0, 0);
      system.interface.visit(u, [&](const auto& c, const auto&, const auto&, const auto& f) {
        const Vec2 on_b = f.normal * c.normal + Vec2(c.tangents() * f.tangential);
        sum += c.b >= node ? on_b : Vec2(-on_b);
      });
      for (const auto* feet : system.supports.all<LiningFeet<2>>())
        for (const auto& at : feet->springs())
          sum -= at.frame * at.force(feet->law(), at.motion_at(u));
      for (const auto* one : tunnel.linings())
        for (int n = 0; n < one->node_count(); ++n)
          sum.y() += system.load[3 * (one->first_node() + n) + 1];
      CHECK(sum.norm() < 1e-3 * bearing);
      // Across the joint only what friction takes over a stretch is lost.
      const auto members = lining_members(tunnel);
      const auto joints_between = system.supports.all<LiningJoints<Planar>>();
      REQUIRE(joints_between.size() == 2);
      for (std::size_t k = 0; k < 2; ++k) {
        const double across = members[members.size() - 2 + k].thrust;
        double beside = 0, least = 1e9;
        for (std::size_t m = 0; m + 2 < members.size(); ++m) {
          const Vec2 there =
              0.5 * (members[members.size() - 2 + k].from + members[members.size() - 2 + k].to);
          const Vec2 here = 0.5 * (members[m].from + members[m].to);
          if (members[m].lining != 0 || (here - there).norm() > least) continue;
          least = (here - there).norm();
          beside = members[m].thrust;
        }
        CHECK(across == voussoir_test::near(beside).epsilon(0.15));
      }
      // In motion there is no such foot either.
      auto run = set_in_motion(tunnel, {.local_damping = 0.7});
      int in_motion = 0;
      for (const auto& support : run.supports())
        if (const auto* feet = dynamic_cast<const LiningFeet<2>*>(support.get()))
          in_motion += static_cast<int>(feet->springs().size());
      CHECK(in_motion == 2);
      tunnel.take_back(run);
      CHECK(foot_forces(tunnel).size() == 2);
    }
  }

  TEST_CASE("a second layer that ends with the first leaves it its feet") {
    using Tunnel = Solver<>;
    Tunnel tunnel = rock<Tunnel>(1);
    Construction<Tunnel> layers;
    layers.add_stage("heading", 0.5).excavate(heading()).install_lining(arch<Tunnel>());
    layers.add_stage("layer", 0.3).install_lining(arch<Tunnel>());
    built(tunnel, layers);
    int of_first = 0;
    for (const auto* feet : tunnel.system().supports.all<LiningFeet<2>>())
      for (const auto& at : feet->springs())
        of_first += at.node < tunnel.linings()[1]->first_node();
    CHECK(of_first == 2);
  }

  TEST_CASE("every table, picture and figure is of all linings") {
    using Tunnel = Solver<>;
    // Legs of another thickness: a moment is then largest where the lining is thickest.
    auto made = plan<Tunnel>();
    made.stages.back().linings = legs<Tunnel>(0.4);
    Tunnel tunnel = rock<Tunnel>(1);
    const auto result = built(tunnel, made);
    const auto forces = lining_forces(tunnel);
    std::size_t nodes = 0;
    for (const auto* one : tunnel.linings()) nodes += static_cast<std::size_t>(one->node_count());
    REQUIRE(forces.size() == nodes);
    const SupportDemand demand = support_demand(tunnel);
    double thrust = 0, moment = 0, of_arch = 0;
    for (const LiningForce& at : forces) {
      thrust = std::max(thrust, at.thrust);
      moment = std::max(moment, std::abs(at.moment));
      if (at.lining == 0) of_arch = std::max(of_arch, std::abs(at.moment));
    }
    CHECK(demand.largest_thrust == thrust);
    CHECK(demand.largest_moment == moment);
    CHECK(moment > of_arch);  // or this test tells nothing
    CHECK(diagram_point_of(tunnel, result).largest_moment == moment);
    // Rows by lining and node.
    const std::string table = lining_table(forces);
    CHECK(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')) == nodes + 1);
    CHECK(says(table, "lining,node,angle_deg"));
    for (const char* row : {"\n1,1,", "\n2,1,", "\n3,1,"}) CHECK(says(table, row));
    // The picture: arch and legs, drawn each in its thickness, all of its nodes.
    const BlocksPicture picture = picture_of(state_of(tunnel), tunnel.mass(), bars_of(tunnel));
    REQUIRE(picture.linings.size() == 3);
    std::vector<double> thicknesses;
    std::size_t drawn = 0, feet = 0;
    double largest = 0;
    for (const PictureLining& one : picture.linings) {
      CHECK_FALSE(one.is_ring);
      thicknesses.push_back(one.thickness);
      drawn += one.nodes.size();
      feet += one.feet.size();
      for (const PictureLiningNode& at : one.nodes)
        largest = std::max(largest, std::abs(at.moment));
    }
    std::sort(thicknesses.begin(), thicknesses.end());
    CHECK(thicknesses[0] == voussoir_test::near(0.2));
    CHECK(thicknesses[1] == voussoir_test::near(0.4));
    CHECK(drawn == nodes + 2);  // the node where legs go on is drawn with both
    CHECK(feet == 2);
    CHECK(largest == moment);
    const std::string page = draw_tunnel(tunnel, result);
    CHECK(says(page, "lining, 20 and 40 cm") != says(page, "lining, 40 and 20 cm"));
    // Of one thickness they are one.
    Tunnel even = rock<Tunnel>(1);
    built(even, plan<Tunnel>());
    const BlocksPicture one = picture_of(state_of(even), even.mass(), bars_of(even));
    REQUIRE(one.linings.size() == 1);
    CHECK(one.linings[0].nodes.size() == lining_forces(even).size());
    CHECK(one.linings[0].feet.size() == 2);
  }

  TEST_CASE("a plan that is cut in two says what the whole plan says") {
    using Tunnel = Solver<>;
    for (const bool on_feet : {true, false}) {
      CAPTURE(on_feet);
      const auto made = [&] {
        auto all = plan<Tunnel>();
        if (!on_feet)  // the arch comes off its wall
          for (auto& stage : all.stages)
            for (auto& one : stage.linings) one.feet.reset();
        return all;
      };
      Tunnel one = rock<Tunnel>(1), two = one;
      const auto in_one = built(one, made());
      Construction<Tunnel> first = made(), second = first;
      first.stages.pop_back();
      second.stages.erase(second.stages.begin(), second.stages.begin() + 2);
      const auto begun = built(two, first), ended = built(two, second);
      CHECK(std::string(to_string(ended.last())) == to_string(in_one.last()));
      CHECK(ended.has_lost_lining() == in_one.has_lost_lining());
      CHECK(ended.fallen_measure() == in_one.fallen_measure());
      CHECK(lining_table(lining_forces(one)) == lining_table(lining_forces(two)));
      CHECK(bolt_table(bolt_forces(one), bars_of(one)) ==
            bolt_table(bolt_forces(two), bars_of(two)));
      CHECK(remarks_on(support_condition(one)) == remarks_on(support_condition(two)));
      CHECK(draw_tunnel(one, in_one) == draw_tunnel(two, ended));
      CHECK(picture_of(state_of(two), two.mass(), bars_of(two)).bolts.size() == 3);
      if (on_feet) continue;
      REQUIRE(begun.has_lost_lining());
      // It says so of every stage that follows, for none has that lining again.
      for (std::size_t k = 1; k < in_one.stages.size(); ++k)
        CHECK(std::string(to_string(in_one.stages[k].report)) == "stable without its lining");
      CHECK(says(draw_tunnel(two, ended), "STABLE WITHOUT ITS LINING"));
    }
  }

  TEST_CASE("linings that go on in one another are open or held together") {
    using Tunnel = Solver<>;
    const auto open_of = [](bool first_on_feet, bool last_on_feet) {
      Tunnel tunnel = rock<Tunnel>(1);
      tunnel.excavate(whole);
      auto pieces = legs<Tunnel>();
      pieces.push_back(arch<Tunnel>());  // joins the two
      // Of its own, from corner to corner of the floor.
      const double corner = std::atan2(2.5, 3);
      pieces.push_back(lining<Tunnel>(180 * degree + corner, 360 * degree - corner));
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        const bool on_feet = k == 0 ? first_on_feet : k == 3 && last_on_feet;
        tunnel.install_lining(lining_frame(tunnel.mass(), whole, pieces[k].layout),
                              pieces[k].sections, wall,
                              on_feet ? std::optional(foot) : std::nullopt);
      }
      return support_condition(tunnel);
    };
    CHECK(open_of(false, false).open_linings == std::vector<int>{1, 4});
    CHECK(open_of(true, false).open_linings == std::vector<int>{4});
    CHECK(open_of(false, true).open_linings == std::vector<int>{1});
    CHECK(open_of(true, true).open_linings.empty());
    const auto said = remarks_on(open_of(true, false));
    REQUIRE(!said.empty());
    CHECK(said[0].starts_with("lining 4 of 4 is open and its ends stand on nothing"));
  }

  TEST_CASE("the tunnel as it stands is measured, whatever is excavated last") {
    using Tunnel = Solver<>;
    Tunnel tunnel = rock<Tunnel>(2);
    Construction<Tunnel> made;
    made.add_stage("heading", 0.5).excavate(heading());
    made.add_stage("bench", 0.2).excavate(bench);
    // A niche in the left wall, and rock taken out far from there.
    made.add_stage("niche", 0.2)
        .excavate(SimplePolygon({{-4, -1.5}, {-3, -1.5}, {-3, -0.5}, {-4, -0.5}}));
    const auto result = built(tunnel, made);
    for (const StageResult& stage : result.stages) {
      const Convergence& c = stage.convergence;
      CHECK(c.crown > 0);
      CHECK(c.invert > 0);
      CHECK(std::isfinite(c.right_springing + c.left_springing));
    }
    // More rock is let go, the crown comes in: figures of stages follow one another.
    CHECK(result.stages[1].convergence.crown > result.stages[0].convergence.crown);
    CHECK(result.stages[2].convergence.crown ==
          voussoir_test::near(convergence(tunnel, whole).crown).epsilon(1e-9));
    CHECK(joined_openings(tunnel.mass()).size() == 3);
    double length = 0;
    for (const WallMotion& part : wall_motion(tunnel)) length += part.length;
    // The outline, with the niche's three sides for the one that it has opened; where pieces of
    // rock were dropped at corners of the niche, less.
    CHECK(length > whole.perimeter() + 1.5);
    CHECK(length < whole.perimeter() + 2.1);
    tunnel.excavate(SimplePolygon({{6, 2}, {8, 2}, {8, 4}, {6, 4}}));
    CHECK(joined_openings(tunnel.mass()).size() == 1);
  }

  TEST_CASE("3-D: what is open over one stretch of one axis is a section, rounds are none") {
    RockMass<Spatial> mass;
    mass.domain = {{-6, 0, -6}, {6, 8, 6}};
    CHECK(joined_openings(mass).empty());
    for (const double from : {0.0, 4.0}) mass.openings.emplace_back(heading(), from, from + 4);
    CHECK(joined_openings(mass).size() == 1);                        // the second round
    mass.openings.emplace_back(bench, TunnelAxis({0, 1, 0}), 0, 2);  // under the first, from y = 1
    const auto section = joined_openings(mass);
    REQUIRE(section.size() == 2);
    CHECK(section[0].from() == 0);
    CHECK(centre_of(section) == Vec2(0, 0));
    mass.openings.emplace_back(bench, TunnelAxis({0, 4, 0}, 90 * degree), 0, 6);  // a cross-drift
    CHECK(joined_openings(mass).size() == 1);
  }

  TEST_CASE("the floor of a heading that runs through the centre is its invert") {
    std::vector<Vec2> corners;
    for (const Vec2& v : whole.vertices())
      if (v.y() >= 0) corners.push_back(v);
    Solver<> tunnel = rock<Solver<>>(2);
    tunnel.excavate(SimplePolygon(corners));
    REQUIRE(tunnel.equilibrium(0.3).verdict == Verdict::stable);
    double floor = 0;
    for (const WallMotion& part : wall_motion(tunnel))
      if (std::abs(part.angle - 270 * degree) < 1e-9) floor += part.length;
    CHECK(floor == voussoir_test::near(6).epsilon(1e-9));
    const Convergence c = convergence(tunnel);
    CHECK(c.invert > 0);
    // That of the walls alone, as the whole section tells it.
    const Convergence of_whole = convergence(tunnel, whole);
    CHECK(c.right_springing == voussoir_test::near(of_whole.right_springing).epsilon(1e-9));
    CHECK(c.left_springing == voussoir_test::near(of_whole.left_springing).epsilon(1e-9));
  }

  /// Mean thrust, what the feet bear (ascending), crown, invert.
  template <class Tunnel>
  std::vector<double> figures_of(Tunnel tunnel, const Construction<Tunnel>& made) {
    const auto result = built(tunnel, made);
    std::vector<double> figures;
    for (const auto& at : foot_forces(tunnel)) figures.push_back(at.bearing);
    std::sort(figures.begin(), figures.end());
    const Convergence& walls = result.stages.back().convergence;
    figures.insert(figures.end(), {support_demand(tunnel).mean_thrust, walls.crown, walls.invert});
    return figures;
  }
  template <class Method>
  std::vector<double> figures_by() {
    using Tunnel = Solver<Method>;
    return figures_of(rock<Tunnel>(3), plan<Tunnel>());
  }
  /// In rock that neither opens nor slips, bonded to a lining on feet that do not slip.
  template <class Method>
  std::vector<double> linear_figures_by() {
    using Tunnel = Solver<MohrCoulombJoint, RockOnLining<MohrCoulombJoint>, Method>;
    Construction<Tunnel> made;
    made.acceptance = {.error_estimate = 1e-6, .unbalance_over_weight = 1e-4};
    made.add_stage("heading", 0.5).excavate(heading());
    made.add_stage("arch", 0.3)
        .install_lining(weightless<Tunnel>(-shoulder, 180 * degree + shoulder, strong));
    made.add_stage("bench")
        .excavate(bench)
        .install_lining(
            weightless<Tunnel>(180 * degree + shoulder, 180 * degree + foot_angle, strong))
        .install_lining(weightless<Tunnel>(-foot_angle, -shoulder, strong));
    return figures_of(Tunnel(voussoir_test::jointed_rock(ground, 3), strong, in_situ), made);
  }

  TEST_CASE("three solution procedures build the same tunnel, where nothing slips") {
    // There is one answer, and each is as near to it as it is asked to be: 1e-6 measured, for feet
    // that bear little beside the thrust 1e-5.
    const auto straight = linear_figures_by<TwoLevel>();
    for (const auto& figures : {linear_figures_by<Relaxation>(), linear_figures_by<Explicit>()})
      for (std::size_t k = 0; k < figures.size(); ++k)
        CHECK(figures[k] == voussoir_test::near(straight[k]).epsilon(1e-4));
  }

  TEST_CASE("three solution procedures build the same tunnel, where joints slip [long]") {
    // Friction remembers the path. By increments and by slow unloading it is one: within 0.3 %
    // measured. Relaxation takes a stage in one: what its feet bear is 8 and 11 % less, thrust 4 %
    // more, the walls within 4 %.
    const auto by_two_level = figures_by<TwoLevel>(), by_explicit = figures_by<Explicit>(),
               by_relaxation = figures_by<Relaxation>();
    for (std::size_t k = 0; k < by_two_level.size(); ++k) {
      CHECK(by_explicit[k] == voussoir_test::near(by_two_level[k]).epsilon(0.01));
      CHECK(by_relaxation[k] == voussoir_test::near(by_two_level[k]).epsilon(k < 2 ? 0.15 : 0.06));
    }
  }

  TEST_CASE("in the mirror all of it is mirrored") {
    using Tunnel = Solver<>;
    const auto map = mirrored_2d();
    Tunnel one = rock<Tunnel>(2), image = rock<Tunnel>(2, map);
    const auto a = built(one, plan<Tunnel>()), b = built(image, plan<Tunnel>(map));
    for (std::size_t k = 0; k < a.stages.size(); ++k) {
      const Convergence &x = a.stages[k].convergence, &y = b.stages[k].convergence;
      CHECK(y.crown == voussoir_test::near(x.crown).epsilon(1e-3));
      CHECK(y.invert == voussoir_test::near(x.invert).epsilon(1e-3));
      CHECK(y.right_springing == voussoir_test::near(x.left_springing).epsilon(1e-3));
      CHECK(y.left_springing == voussoir_test::near(x.right_springing).epsilon(1e-3));
    }
    // To the error that is asked for of displacements, times what a moment magnifies it by.
    CHECK(support_demand(image).largest_moment ==
          voussoir_test::near(support_demand(one).largest_moment).epsilon(0.01));
    CHECK(support_demand(image).largest_thrust ==
          voussoir_test::near(support_demand(one).largest_thrust).epsilon(2e-3));
  }
}

}  // namespace heading_and_bench_test
