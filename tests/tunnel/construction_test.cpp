// SPDX-License-Identifier: MIT
// A construction given as data is what the same calls by hand are, bit for bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/construction_checks.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/rib_forces.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace tunnel_construction_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::jointed_mass;
using voussoir_test::jointed_rock;
using voussoir_test::near;

namespace {

using Tunnel = Solver<>;
using Cavern = Solver<Spatial>;
const CoulombJoint joints({5e9, 5e8, 40 * degree}), interface({1e9, 1e9, 30 * degree});
const SimplePolygon circle = circular_opening(5, 36);
const LiningSection shell = LiningSection::rectangular(0.1, 25e9);
const AxialBolt bolt({.axial_stiffness = 2e8, .pretension = 1e4});
const std::vector<Segment> bars = bolt_bars({.length = 3, .angular_spacing = 30 * degree}, circle);

const Tunnel& rock() {
  static const Tunnel in_situ(jointed_rock(domain_around(circle, 20, 7, 7), 4), joints,
                              {.density = 2700});
  return in_situ;
}

Construction<Tunnel> plan() {
  Construction<Tunnel> made;
  made.add_stage("heading", 0.5).excavate(circle);
  made.add_stage("support").install_bolts({bars, bolt}).install_lining({{}, {shell}, interface});
  return made;
}

/// Built once, for the tests that look at it.
struct Built {
  Tunnel tunnel = rock();
  ConstructionResult<Planar> result = construct(tunnel, plan());
};
const Built& built() {
  static const Built once;
  return once;
}

template <class Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_SUITE("tunnel/construction") {
  TEST_CASE("2-D: two stages as data and by hand have the same bits") {
    Tunnel by_hand = rock();
    by_hand.excavate(circle);
    const EquilibriumReport first = by_hand.equilibrium(0.5);
    const double half_way = convergence(by_hand).crown;
    std::vector<int> crossings, by_plan;
    for (const Segment& bar : bars) crossings.push_back(by_hand.install_bolt(bar, bolt));
    by_hand.install_lining(lining_frame(by_hand.mass(), {}), shell, interface);
    const EquilibriumReport second = by_hand.equilibrium();

    const auto& [tunnel, result] = built();
    CHECK(tunnel.system().displacement == by_hand.system().displacement);
    REQUIRE(result.stages.size() == 2);
    for (const auto& installed : tunnel.installed_bolts()) by_plan.push_back(installed.crossings);
    CHECK(by_plan == crossings);
    CHECK(bars_of(tunnel).size() == bars.size());
    CHECK(result.stages[0].name == "heading");
    CHECK(result.stages[0].wall_traction == 0.5);
    CHECK(result.stages[0].convergence.crown == half_way);
    CHECK(result.stages[0].report.steps == first.steps);
    CHECK(result.last().error_estimate == second.error_estimate);
    CHECK(result.verdict() == Verdict::stable);
    CHECK(result.stages[1].fully_unloaded());
    CHECK(result.fallen_measure() == first.fallen_measure + second.fallen_measure);
  }

  TEST_CASE("the convergence given is that of the opening asked for, whatever is driven after it") {
    const SimplePolygon drift({{4, -3}, {6, -3}, {6, -1}, {4, -1}});
    Construction<Tunnel> made;
    made.add_stage("tunnel").excavate(circle);
    made.add_stage("drift").excavate(drift);
    Tunnel last = rock(), first = rock();
    const auto of_last = construct(last, made);
    made.measured = circle;
    const auto of_first = construct(first, made);
    REQUIRE(of_last.stages.size() == 2);
    REQUIRE(of_first.stages.size() == 2);
    CHECK(of_first.stages[0].convergence.crown == of_last.stages[0].convergence.crown);
    CHECK(of_first.stages[1].convergence.crown == convergence(first, circle).crown);
    CHECK(of_last.stages[1].convergence.crown == convergence(last, drift).crown);
    CHECK(of_first.stages[1].convergence.crown != of_last.stages[1].convergence.crown);
    REQUIRE(of_first.measured);
    CHECK_FALSE(of_last.measured);
  }

  TEST_CASE("3-D: bolts and ribs as data and by hand have the same bits") {
    const PrismaticOpening opening(circular_opening(4, 12));
    const Domain<3> ground{{-6, 0, -6}, {6, 4, 7}};
    const Cavern in_situ(jointed_mass(ground, 2, 1.5), joints, {.density = 2700, .surcharge = 5e5});
    const auto rows = bolt_bars({.length = 2, .angular_spacing = 45 * degree}, opening, 2, 0, 4);
    const LiningRibs ribs{.ring = {.nodes = 24}, .spacing = 2};
    const std::vector sections{LiningSection::strip(0.15, 2, 25e9),
                               LiningSection::strip(0.15, 0.5, 25e9)};
    Cavern by_hand = in_situ, by_plan = in_situ;
    by_hand.excavate(opening);
    for (const SpatialLine& bar : rows) (void)by_hand.install_bolt(bar, bolt);
    by_hand.install_lining(lining_frame(by_hand.mass(), ribs), sections, interface);
    const EquilibriumReport report = by_hand.equilibrium();

    Construction<Cavern> made;
    made.add_stage("all")
        .excavate(opening)
        .install_bolts({rows, bolt})
        .install_lining({ribs, sections, interface});
    const auto result = construct(by_plan, made);
    CHECK(by_plan.system().displacement == by_hand.system().displacement);
    CHECK(result.last().error_estimate == report.error_estimate);
    REQUIRE(result.verdict() == Verdict::stable);
    const SupportDemand demand = support_demand(by_plan);
    // At every node the mean of the members that meet there across the tunnel, which runs along y.
    const auto members = lining_members(by_plan);
    double largest = 0, sum = 0;
    const auto nodes = rib_forces(by_plan);
    CHECK(static_cast<int>(nodes.size()) == by_plan.linings().front()->node_count());
    for (const RibForce& node : nodes) {
      double thrust = 0, moment = 0, shear = 0;
      int met = 0;
      for (const auto& m : members) {
        if (std::abs(m.to.y() - m.from.y()) > 1e-9 ||
            (m.from != node.position && m.to != node.position))
          continue;
        ++met;
        thrust += m.thrust;
        moment = std::max(moment, m.moment);
        shear = std::max(shear, m.shear);
      }
      REQUIRE(met == 2);
      CHECK(node.thrust == near(0.5 * thrust).epsilon(1e-9));
      CHECK(std::abs(node.moment) <= moment);
      // Radial, where that of a member has its part along the tunnel, too.
      CHECK(node.largest_shear <= shear * (1 + 1e-9));
      CHECK(node.largest_shear >= std::abs(node.shear));
      CHECK(node.largest_shear > 0);
      largest = std::max(largest, node.thrust);
      sum += node.thrust;
    }
    CHECK(demand.largest_thrust == largest);
    CHECK(demand.mean_thrust == near(sum / static_cast<double>(nodes.size())));
    CHECK(demand.mean_thrust > 0);
    CHECK(demand.mean_thrust < demand.largest_thrust);
  }

  TEST_CASE("a stage that does not end stable ends the construction") {
    Tunnel tunnel = rock();
    Construction<Tunnel> made = plan();
    made.acceptance.displacement_limit = 1e-6;  // the rock moves further: nothing can be told
    const auto result = construct(tunnel, made);
    REQUIRE(result.stages.size() == 1);
    CHECK(result.verdict() == Verdict::undecided);
    CHECK(tunnel.bolt_count() == 0);
    CHECK_FALSE(result.stages[0].fully_unloaded());
  }

  TEST_CASE("the end of every stage is shown, with the solver as it is then") {
    std::vector<std::string> names;
    std::vector<std::size_t> bolts;
    std::vector<double> crowns;
    Tunnel tunnel = rock();
    const auto observer = [&](const Tunnel& at, const StageResult& stage) {
      names.push_back(stage.name);
      bolts.push_back(static_cast<std::size_t>(at.bolt_count()));
      crowns.push_back(convergence(at).crown);
    };
    const auto result = construct(tunnel, plan(), {}, observer);
    CHECK(names == std::vector<std::string>{"heading", "support"});
    CHECK(bolts == std::vector<std::size_t>{0, bars.size()});
    REQUIRE(crowns.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) CHECK(crowns[k] == result.stages[k].convergence.crown);
    CHECK(crowns[0] < crowns[1]);
    // It changes nothing, and sees a stage that does not end stable as well.
    CHECK(result.stages[1].convergence.crown == built().result.stages[1].convergence.crown);
    Tunnel other = rock();
    Construction<Tunnel> failing = plan();
    failing.acceptance.displacement_limit = 1e-6;
    names.clear();
    CHECK(construct(other, failing, {}, observer).verdict() == Verdict::undecided);
    CHECK(names == std::vector<std::string>{"heading"});
  }

  TEST_CASE("a construction can be stopped in every stage, and told which it is") {
    for (const std::string at : {"heading", "support"}) {
      Tunnel tunnel = rock();
      const auto stop = [&](const std::string& stage, double) { return stage != at; };
      try {
        const auto result = construct(tunnel, plan(), stop);
        CHECK(result.last().stopped);
        CHECK(result.stages.back().name == at);
      } catch (const Stopped&) {
        CHECK(tunnel.linings().empty());
      }
    }
  }

  TEST_CASE("what cannot be carried out is refused by the name of its stage") {
    Tunnel tunnel = rock();
    CHECK(refusal([&] { (void)construct(tunnel, Construction<Tunnel>{}); }) ==
          "construction: has no stages; accepted: at least one");
    Construction<Tunnel> made;
    made.add_stage("more than all", 1.5).excavate(circle);
    CHECK(refusal([&] { (void)construct(tunnel, made); })
              .find("stage \"more than all\": wall "
                    "traction = 1.5") == 0);
    Construction<Tunnel> lined;
    lined.add_stage("lining").install_lining({{.nodes = 3}, {shell}, interface});
    CHECK(refusal([&] { (void)construct(tunnel, lined); }).find("stage \"lining\": lining nodes") ==
          0);
  }
}

TEST_SUITE("tunnel/support_demand") {
  TEST_CASE("the demand is the extreme of forces, the point of a diagram the same") {
    const auto& [tunnel, result] = built();
    const SupportDemand demand = support_demand(tunnel);
    double pull = 0, thrust = 0, moment = 0;
    for (const CrossingForce& c : bolt_forces(tunnel)) pull = std::max(pull, c.report.axial);
    for (const LiningForce& at : lining_forces(tunnel)) {
      thrust = std::max(thrust, at.thrust);
      moment = std::max(moment, std::abs(at.moment));
    }
    CHECK(demand.largest_bolt_force == pull);
    CHECK(demand.largest_thrust == thrust);
    CHECK(demand.largest_moment == moment);
    CHECK(demand.mean_bolt_force > 1e4);  // pretension
    const DiagramPoint point = diagram_point_of(tunnel, result);
    CHECK(point.largest_moment == moment);
    CHECK(point.crown_convergence == result.stages[1].convergence.crown);
    CHECK_FALSE(point.failed());
  }

  TEST_CASE("bolts that hold nothing, and joints at which they broke, are counted and said") {
    CHECK(remarks_on(support_condition(built().tunnel)).empty());
    // A bolt of 1 mm crosses no joint; one that breaks at half its pretension crosses some.
    const Segment& whole = bars[2];
    const Segment stub{whole.start, whole.at(1e-3 / whole.length())};
    Construction<Tunnel> made;
    made.add_stage("all")
        .excavate(circle)
        .install_bolts({{stub}, bolt})
        .install_bolts(
            {{whole},
             AxialBolt({.axial_stiffness = 2e8, .pretension = 1e4, .rupture_force = 1.0001e4})});
    Tunnel tunnel = rock();
    const auto result = construct(tunnel, made);
    REQUIRE(result.stages.size() == 1);
    REQUIRE(tunnel.installed_bolts()[0].crossings == 0);
    REQUIRE(tunnel.installed_bolts()[1].crossings > 0);
    const SupportCondition condition = support_condition(tunnel);
    CHECK(condition.bolts == 2);
    CHECK(condition.idle == 1);
    CHECK(condition.ruptured > 0);
    const std::vector<std::string> remarks = remarks_on(condition);
    REQUIRE(remarks.size() == 2);
    CHECK(remarks[0] == "1 of 2 bolts cross no joint and hold nothing");
    CHECK(remarks[1] == "bolts ruptured at " + std::to_string(condition.ruptured) + " joints");
  }

  TEST_CASE("a stage that lasts is refused where no joint creeps") {
    Tunnel tunnel = rock();
    for (const double duration : {3600.0, -1.0, std::nan("")}) {
      CAPTURE(duration);
      Construction<Tunnel> lasting = plan();
      lasting.stages.back().duration = duration;
      const std::string said = refusal([&] { (void)construct(tunnel, lasting); });
      CHECK(said.find("stage \"support\": duration") != std::string::npos);
      CHECK(tunnel.mass().openings.empty());
    }
  }

  TEST_CASE("a plan that cannot be carried out is refused before anything is done") {
    const SimplePolygon heading({{-2, 0}, {2, 0}, {2, 2}, {-2, 2}}),
        bench({{-2, -2}, {2, -2}, {2, 0}, {-2, 0}}), wide({{-3, -2}, {3, -2}, {3, 1}, {-3, 1}});
    const auto said = [&](const Construction<Tunnel>& made) {
      Tunnel tunnel = rock();
      const std::string why = refusal([&] { (void)construct(tunnel, made); });
      CHECK(tunnel.mass().openings.empty());
      return why;
    };
    Construction<Tunnel> core, twice, overlap, sound;
    core.add_stage("top", 0.5)
        .excavate(heading)
        .install_bolts({{{{-2, 1}, {-4, 1}}, {{1, 0}, {1, -3}}}, bolt});
    core.add_stage("bottom").excavate(bench);
    const std::string bolts = said(core);
    CHECK(bolts.find("stage \"top\": bolt 2 runs at (1, -1) m") != std::string::npos);
    CHECK(bolts.find("\"bottom\" takes out: install it after that") != std::string::npos);
    twice.add_stage("first").excavate(heading);
    twice.add_stage("second").excavate(heading);
    CHECK(said(twice).find("stage \"second\": opening: at ") != std::string::npos);
    CHECK(said(twice).find("it overlaps round 1") != std::string::npos);
    overlap.add_stage("all").excavate(heading).excavate(bench).excavate(wide);
    CHECK(said(overlap).find("it overlaps round 1") != std::string::npos);
    // A bolt along the floor of the heading, on the wall that is to go, and beside it: sound.
    sound.add_stage("top", 0.5)
        .excavate(heading)
        .install_bolts({{{{-2, 1}, {-4, 1}}, {{2, 0}, {2, -3}}, {{0, 2}, {0, 4}}}, bolt});
    sound.add_stage("bottom", 0.5)
        .excavate(bench)
        .install_lining({{.nodes = 24},
                         {shell},
                         interface,
                         SimplePolygon({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}})});
    CHECK_NOTHROW(check_construction(sound, rock().mass()));
  }

  TEST_CASE("3-D: places of bars in an opening, and of those that only touch it") {
    const PrismaticOpening drift(circular_opening(4, 12), 0, 3);
    const auto inside = [&](const Vec3& head, const Vec3& tip) {
      const auto place = place_inside(SpatialLine{head, tip}, drift, 1e-6);
      if (place) CHECK(drift.contains(*place));
      return place.has_value();
    };
    CHECK(inside({0, -2, 0}, {0, 5, 0}));       // ahead of the face, along the axis
    CHECK(inside({0, -2, 1}, {1, 1, 1}));       // at an angle
    CHECK(inside({-5, 1, 0}, {5, 1, 0}));       // across
    CHECK(!inside({0, -2, 0}, {0, 0, 0}));      // ends at the face
    CHECK(!inside({-5, -1, 0}, {5, -0.1, 0}));  // before it begins
    CHECK(!inside({2.1, 0, 0}, {2.1, 3, 0}));   // beside it
    CHECK(!inside({0, 1, 2}, {0, 1, 5}));       // from its crown
    CHECK(!inside({0, -2, 1}, {0, -0.5, 1.5}));
  }
}

}  // namespace tunnel_construction_test
