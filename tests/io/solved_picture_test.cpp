// SPDX-License-Identifier: MIT
// From a constructed tunnel to a finished picture in one call.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/io/solved_picture.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "io/xml_check.hpp"
#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"

namespace solved_picture_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

const CoulombJoint joints({5e9, 5e8, 40 * degree});
const AxialBolt bolt({.axial_stiffness = 2e8, .pretension = 1e4});

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

}  // namespace

TEST_SUITE("io/solved_picture") {
  TEST_CASE("2-D: title, verdict, numbers of what is installed; a banner where none was found") {
    const SimplePolygon opening = circular_opening(5, 36);
    Solver<> tunnel(voussoir_test::jointed_rock(domain_around(opening, 20, 7, 7), 4), joints,
                    {.density = 2700});
    Solver<> other = tunnel;
    Construction<Solver<>> plan;
    plan.add_stage("all")
        .excavate(opening)
        .install_bolts({bolt_bars({.length = 3, .angular_spacing = 30 * degree}, opening), bolt})
        .install_lining({{}, {LiningSection::rectangular(0.1, 25e9)}, joints});
    const auto built = construct(tunnel, plan);
    REQUIRE(built.verdict() == Verdict::stable);
    const std::string picture =
        draw_tunnel(tunnel, built, {.title = "Station <12>", .lining_thickness = 0.1});
    CHECK(xml_fault(picture) == "");
    for (const std::string text :
         {"Station &lt;12&gt;", "Verdict: stable. Estimated error", "crown convergence",
          "largest bolt force", "largest thrust", "largest moment", "lining, 10 cm"}) {
      CAPTURE(text);
      CHECK(count_of(picture, text) >= 1);
    }
    CHECK(count_of(picture, "id=\"banner\"") == 0);

    plan.acceptance.displacement_limit = 1e-6;  // the rock moves further: nothing can be told
    const auto undecided = construct(other, plan);
    const std::string marked = draw_tunnel(other, undecided);
    CHECK(xml_fault(marked) == "");
    CHECK(count_of(marked, ">UNDECIDED<") == 1);
    CHECK(count_of(marked, "raise displacement_limit") == 1);
  }

  TEST_CASE("an arch shows its feet and what they bear; one that came off its wall is not drawn") {
    const SimplePolygon opening = circular_opening(5, 24);
    const Solver<> rock(voussoir_test::jointed_rock(domain_around(opening, 15, 7, 6), 3), joints,
                        {.density = 2700});
    const auto picture_with = [&](const std::optional<FootBearing>& feet, bool comes_off) {
      Solver<> tunnel = rock;
      Construction<Solver<>> plan;
      LiningInstallation<Solver<>> arch{{.nodes = 36, .from = 0, .to = 180 * degree},
                                        {LiningSection::rectangular(0.1, 25e9)},
                                        CoulombJoint({1e9, 1e9, 30 * degree})};
      arch.feet = feet;
      plan.add_stage("all").excavate(opening).install_lining(arch);
      const auto built = construct(tunnel, plan);
      REQUIRE(built.verdict() == Verdict::stable);
      CHECK(built.has_lost_lining() == comes_off);
      return draw_tunnel(tunnel, built, {.lining_thickness = 0.1});
    };
    const std::string stands = picture_with(
        FootBearing({.width = 0.2, .stiffness = 2e9, .friction_angle = 30 * degree}), false);
    CHECK(xml_fault(stands) == "");
    CHECK(count_of(stands, "foot on rock, up to ") == 1);
    CHECK(count_of(stands, "lining, 10 cm") == 1);
    const std::string lost = picture_with(std::nullopt, true);
    CHECK(xml_fault(lost) == "");
    CHECK(count_of(lost, "foot on rock") == 0);
    CHECK(count_of(lost, "lining, 10 cm") == 0);
    CHECK(count_of(lost, "largest thrust") == 0);
    CHECK(count_of(lost, "STABLE WITHOUT ITS LINING") == 1);
  }

  TEST_CASE("3-D: the same call, a banner that covers no rock, and a file for ParaView") {
    const PrismaticOpening opening(circular_opening(3, 12));
    const Domain<3> ground{{-4, 0, -4}, {4, 3, 5}};
    Solver<Spatial> tunnel(voussoir_test::jointed_mass(ground, 2, 1.5), joints, {.density = 2700});
    Solver<Spatial> other = tunnel;
    Construction<Solver<Spatial>> plan;
    plan.add_stage("all").excavate(opening).install_bolts(
        {bolt_bars({.length = 2, .angular_spacing = 45 * degree}, opening, 2, 0, 3), bolt});
    const auto built = construct(tunnel, plan);
    REQUIRE(built.verdict() == Verdict::stable);
    const std::string picture = draw_tunnel(tunnel, built, {.title = "Cavern"});
    CHECK(xml_fault(picture) == "");
    CHECK(count_of(picture, "largest bolt force") == 1);
    CHECK(count_of(picture, "largest thrust") == 0);

    plan.acceptance.displacement_limit = 1e-6;
    const std::string marked = draw_tunnel(other, construct(other, plan));
    CHECK(xml_fault(marked) == "");
    CHECK(count_of(marked, ">UNDECIDED<") == 1);

    const std::string grid = vtu_of(state_of(tunnel), tunnel.mass());
    std::size_t parts = 0;
    for (std::size_t b = 0; b < tunnel.mass().bodies.size(); ++b)
      if (tunnel.system().body(static_cast<int>(b)).movable)
        parts += tunnel.mass().bodies[b].parts.size();
    CHECK(xml_fault(grid) == "");
    CHECK(grid.find("NumberOfCells=\"" + std::to_string(parts) + "\"") != std::string::npos);
  }

  TEST_CASE("3-D: ribs on the unrolled wall, each where it is, with its force per metre") {
    const TunnelAxis axis({0, 0, 0}, 30 * degree);
    const PrismaticOpening opening(circular_opening(3, 12), axis);
    Solver<Spatial> tunnel(voussoir_test::jointed_mass({{-6, -2, -5}, {6, 2, 6}}, 2, 1.5), joints,
                           {.density = 2700, .surcharge = 5e5});
    CHECK(unrolled_lining(tunnel, 2).nodes.empty());
    Construction<Solver<Spatial>> plan;
    plan.add_stage("all").excavate(opening).install_lining(
        {{.ring = {.nodes = 24}, .spacing = 0.5, .from = -1, .to = 1},
         {LiningSection::strip(0.1, 0.5, 25e9), LiningSection::strip(0.1, 0.4, 25e9)},
         CoulombJoint({5e9, 5e9, 35 * degree})});
    const auto built = construct(tunnel, plan);
    REQUIRE(built.verdict() == Verdict::stable);
    const UnrolledLining unrolled = unrolled_lining(tunnel, 0.5);
    const auto forces = rib_forces(tunnel);
    REQUIRE(forces.size() == 4 * 24);
    REQUIRE(unrolled.nodes.size() == forces.size());
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const UnrolledNode& node = unrolled.nodes[k];
      CHECK(node.angle >= -90);
      CHECK(node.angle <= 270);
      // The nodes lie on the polygon, between its inner and its outer radius.
      const double angle = node.angle * degree, radius = 1.5;
      const Vec3 place = axis.point(radius * Vec2(std::cos(angle), std::sin(angle)), node.along);
      CHECK((place - forces[k].position).norm() < radius * (1 - std::cos(15 * degree)) + 0.05);
      CHECK(node.thrust == 2 * forces[k].thrust);  // on half a metre
      CHECK(node.moment == 2 * forces[k].moment);
    }
    const std::string picture = draw_tunnel(tunnel, built, {.strip_width = 0.5});
    CHECK(xml_fault(picture) == "");
    double largest = 0;
    for (const RibForce& at : forces) largest = std::max(largest, 2e-3 * at.thrust);
    CHECK(count_of(picture, ">largest " + printed_text(largest) + " kN/m at ") == 1);
    CHECK(count_of(picture, ">" + fixed_text(largest, 0) + " kN/m<") == 1);  // a key number
    CHECK(count_of(draw_tunnel(tunnel, built), "of each rib") == 2);
  }

  TEST_CASE("the words for every verdict") {
    EquilibriumReport report;
    report.verdict = Verdict::stable;
    report.error_estimate = 1e-4;
    report.unbalance_over_weight = 2e-3;
    CHECK(verdict_sentence(report, 0, "m²") ==
          "Verdict: stable. Estimated error of the displacements 0.01 %; the worst block is out of "
          "balance by 0.2 % of its weight.");
    CHECK_FALSE(banner_of(report.verdict, 0, "m²").has_value());
    CHECK(banner_of(report.verdict, 1.234, "m²")->word == "STABLE AFTER ROCKFALL");
    CHECK(banner_of(report.verdict, 0, "m²", true)->word == "STABLE WITHOUT ITS LINING");
    CHECK(verdict_sentence(report, 1.234, "m²", true)
              .starts_with("Verdict: stable without its lining, after rockfall of 1.23 m²"));
    CHECK(banner_of(report.verdict, 1.234, "m³")->line ==
          "1.23 m³ of rock detached before the rest came to rest");
    report.error_estimate = std::numeric_limits<double>::quiet_NaN();
    CHECK(verdict_sentence(report, 1.234, "m²")
              .find("stable after rockfall of 1.23 m². Error of the displacements not estimated") !=
          std::string::npos);
    report.verdict = Verdict::collapse;
    report.reason = "too much of it";
    CHECK(verdict_sentence(report, 20, "m²") == "Verdict: collapse: too much of it.");
    CHECK(banner_of(report.verdict, 20, "m²")->line == "20.00 m² of rock detached: no equilibrium");
    CHECK(millimetres_text(3.2949e-3) == "3.29");
    CHECK(millimetres_text(std::numeric_limits<double>::quiet_NaN()) == "-");
  }
}

}  // namespace solved_picture_test
