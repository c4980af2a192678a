// SPDX-License-Identifier: MIT
// Views and ParaView files of tunnels in 3-D.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>
#include <string>
#include <vector>
#include <voussoir/io/tunnel_picture.hpp>
#include <voussoir/io/tunnel_view.hpp>
#include <voussoir/io/view_from.hpp>
#include <voussoir/io/vtu.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "io/xml_check.hpp"
#include "support/blocks.hpp"
#include "support/jointed_mass.hpp"
#include "support/near.hpp"

namespace space_pictures_test {

using namespace voussoir;
using voussoir_test::brick;
using voussoir_test::jointed_mass;
using voussoir_test::near;
using voussoir_test::rectangle;

namespace {

/// The numbers of a data array.
std::vector<double> array_of(const std::string& document, const std::string& name) {
  const std::size_t at = document.find("Name=\"" + name + "\"");
  REQUIRE(at != std::string::npos);
  const std::size_t from = document.find('>', at) + 1, to = document.find("</DataArray>", at);
  std::vector<double> numbers;
  std::string text = document.substr(from, to - from);
  char* p = text.data();
  for (char* end = nullptr;; p = end) {
    const double x = std::strtod(p, &end);
    if (end == p) return numbers;
    numbers.push_back(x);
  }
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++found;
  return found;
}
std::string layer_of(const std::string& picture, const std::string& name) {
  const std::size_t from = picture.find("<g id=\"" + name + "\"");
  REQUIRE(from != std::string::npos);
  return picture.substr(from, picture.find("</g>", from) - from);
}
/// Bolts have a white rim, a line of its own.
std::size_t lines_in(const std::string& picture, const std::string& layer) {
  const std::string text = layer_of(picture, layer);
  return count(text, "<line ") - count(text, "stroke=\"white\"");
}
/// Widths of the lines of a colour in a layer, ascending [px].
std::vector<double> widths_in(const std::string& layer, const std::string& colour) {
  std::vector<double> widths;
  const std::regex line("<line [^>]*stroke=\"" + colour + "\" stroke-width=\"([0-9.]+)\"");
  for (std::sregex_iterator at(layer.begin(), layer.end(), line), end; at != end; ++at)
    widths.push_back(std::stod((*at)[1]));
  std::sort(widths.begin(), widths.end());
  return widths;
}

/// A square of 1 m about a point, upright and across y.
SlippedJoint square(const Vec3& p, double slip, int a, int b) {
  return {{p + Vec3(-0.5, 0, -0.5), p + Vec3(0.5, 0, -0.5), p + Vec3(0.5, 0, 0.5),
           p + Vec3(-0.5, 0, 0.5)},
          slip,
          false,
          a,
          b};
}

}  // namespace

TEST_SUITE("io/space_pictures") {
  TEST_CASE("a .vtu holds every cell, its points and faces, and its values") {
    VtuGrid grid;
    Pose<3> lifted;
    lifted.position = Vec3(0, 0, 2);
    grid.add(brick({0, 0, 0}, {1, 2, 3}), lifted);
    grid.add(rectangle({5, 5}, 1, 1));
    grid.add_line({0, 0, 0}, {1, 1, 1});
    grid.add_values("force <N>", 1, {1.5, 2, 3});
    CHECK_THROWS_AS(grid.add_values("u", 3, {1, 2, 3}), InvalidInput);
    const std::string text = grid.document();
    CHECK(xml_fault(text) == "");
    CHECK(array_of(text, "types") == std::vector<double>{42, 7, 3});
    CHECK(array_of(text, "offsets") == std::vector<double>{8, 12, 14});
    // VTK: number of faces, then for each its number of points and the points.
    const auto faces = array_of(text, "faces");
    CHECK(faces.size() == 1 + 6 * 5);
    CHECK(faces.front() == 6);
    CHECK(array_of(text, "faceoffsets") == std::vector<double>{31, -1, -1});
    const auto points = array_of(text, "Points");
    CHECK(points.size() == 3 * (8 + 4 + 2));
    double low = 1e9, high = -1e9;
    for (std::size_t k = 2; k < 24; k += 3) {
      low = std::min(low, points[k]);
      high = std::max(high, points[k]);
    }
    CHECK(low == 0.5);
    CHECK(high == 3.5);
    CHECK(array_of(text, "force &lt;N&gt;") == std::vector<double>{1.5, 2, 3});
  }

  TEST_CASE("the view of a tunnel shows the section, leaves out what lies before it") {
    const Domain<3> ground{{-4, -3, -4}, {4, 3, 4}};
    const auto mass =
        carve(jointed_mass(ground, 1, 1.5), PrismaticOpening(circular_opening(3, 24)), 0.0);
    TunnelView scene;
    scene.header.title = "view";
    CHECK_THROWS_AS((void)draw_tunnel_view(mass, scene), InvalidInput);
    scene.displacement.assign(mass.bodies.size(), 1e-3);
    scene.displacement.front() = 1.5e-3;
    scene.bolts = {{{-2, 0, 0}, {-3, 0, 0}, 5e4}, {{2, 0, 0}, {3, 0, 0}, 9e4}};
    const std::string half = draw_tunnel_view(mass, scene);
    CHECK(xml_fault(half) == "");
    CHECK(half.find(">1.60<") != std::string::npos);  // the scale ends above the largest
    CHECK(half.find(">bolt, up to 90.0 kN<") != std::string::npos);
    CHECK(half.find("hole filled with lining") == std::string::npos);
    scene.fills = {brick({-2, -1, 0}, {0.5, 1, 1})};
    CHECK(draw_tunnel_view(mass, scene).find("hole filled with lining") != std::string::npos);
    scene.fills.clear();
    CHECK(lines_in(half, "bolts") == 1);  // the one behind the section
    scene.section.offset = 4;
    CHECK(lines_in(draw_tunnel_view(mass, scene), "bolts") == 2);
    // One that crosses the section is drawn up to it, one that lies in it whole.
    scene.section.offset = 0;
    scene.bolts = {{{-2, 0, 0}, {2, 0, 0}, 5e4}, {{0, 0, 2}, {1e-16, 0, 3}, 5e4}};
    const std::string cut = draw_tunnel_view(mass, scene);
    CHECK(lines_in(cut, "bolts") == 2);
    scene.bolts[0].to = {0, 0, 0};
    CHECK(draw_tunnel_view(mass, scene) == cut);
    // What lies before the section is dashed where it is shown.
    scene.bolts[0].to = {2, 0, 0};
    scene.shows_bolts_before = true;
    const std::string all = draw_tunnel_view(mass, scene);
    CHECK(lines_in(all, "bolts") == 3);
    CHECK(count(layer_of(all, "bolts"), "dasharray") == 1);
    CHECK(all.find(">before the section<") != std::string::npos);
    CHECK(cut.find(">before the section<") == std::string::npos);
    scene.section.offset = -5;
    CHECK_THROWS_AS((void)draw_tunnel_view(mass, scene), InvalidInput);
  }

  TEST_CASE("one loose block does not set the scale of displacement of all others") {
    const Domain<3> ground{{-4, -3, -4}, {4, 3, 4}};
    const auto mass = jointed_mass(ground, 1, 1.5);
    REQUIRE(mass.bodies.size() > 100);  // one is less than 2 % of them
    TunnelView scene;
    scene.section.offset = 4;
    scene.displacement.assign(mass.bodies.size(), 1e-3);
    const std::string before = draw_tunnel_view(mass, scene);
    CHECK(before.find(">1.00<") != std::string::npos);
    scene.displacement.front() = 0.3;
    const std::string loose = draw_tunnel_view(mass, scene);
    CHECK(loose.find(">≥ 1.00<") != std::string::npos);
    // One that has come off counts for nothing.
    scene.is_gone.assign(mass.bodies.size(), 0);
    scene.is_gone.front() = 1;
    CHECK(draw_tunnel_view(mass, scene).find(">1.00<") != std::string::npos);
  }

  TEST_CASE("an unrolled lining covers its ribs all round, an arc no more than itself") {
    const auto area_of = [](const UnrolledLining& lining) {
      double sum = 0;
      for (const auto& cell : detail::unrolled_cells(lining)) {
        CHECK(cell.rect.low.y() >= -90);
        CHECK(cell.rect.high.y() <= 270);
        const UnrolledNode& node = lining.nodes[cell.node];
        CHECK(std::abs(cell.rect.centre().x() - node.along) < 1e-12);
        sum += cell.rect.width() * cell.rect.height();
      }
      return sum;
    };
    UnrolledLining ring{{}, 0.8}, arc{{}, 0.8};
    for (int rib = 0; rib < 3; ++rib)
      for (int k = 0; k < 36; ++k)
        ring.nodes.push_back({0.4 + 0.8 * rib, -90.0 + 10 * k, 1e5, 1e3});
    for (int k = 0; k <= 18; ++k) arc.nodes.push_back({0.4, 10.0 * k, 1e5, 1e3});
    // Sums of a hundred numbers that are exact to 1e-16 of them.
    CHECK(area_of(ring) == near(3 * 0.8 * 360).epsilon(1e-13));
    CHECK(area_of(arc) == near(0.8 * 190).epsilon(1e-13));
    std::reverse(ring.nodes.begin(), ring.nodes.end());
    CHECK(area_of(ring) == near(3 * 0.8 * 360).epsilon(1e-13));
    ring.strip_width = 0;  // as wide as they stand apart
    CHECK(area_of(ring) == near(3 * 0.8 * 360).epsilon(1e-13));
  }

  TEST_CASE("below the view thrust and moment of every rib, the largest told with its place") {
    const Domain<3> ground{{-4, -3, -4}, {4, 3, 4}};
    const auto mass =
        carve(jointed_mass(ground, 1, 1.5), PrismaticOpening(circular_opening(3, 24)), 0.0);
    TunnelView scene;
    scene.displacement.assign(mass.bodies.size(), 1e-3);
    CHECK(draw_tunnel_view(mass, scene).find("unrolled") == std::string::npos);
    scene.unrolled.strip_width = 1;
    for (int rib = 0; rib < 3; ++rib)
      for (int k = 0; k < 24; ++k)
        scene.unrolled.nodes.push_back({0.5 + rib, -90.0 + 15 * k, 2e5 + 1e3 * rib, 1e3});
    scene.unrolled.nodes[12].thrust = 4.56e5;       // first rib, 90 degrees
    scene.unrolled.nodes[24 + 3].moment = -7.89e3;  // second rib, -45 degrees
    const std::string picture = draw_tunnel_view(mass, scene);
    CHECK(xml_fault(picture) == "");
    for (const char* const text :
         {"Lining thrust N [kN/m], wall unrolled", "Lining moment M [kN m/m], wall unrolled",
          "largest 456 kN/m at 0.5 m, crown (90°)",
          "smallest \u22127.89 kN m/m at 1.5 m, lower right (\u221245°)", ">along the tunnel [m]<",
          ">\u22127.89<"}) {
      CAPTURE(text);
      CHECK(picture.find(text) != std::string::npos);
    }
    scene.unrolled.strip_width = 0;
    CHECK(draw_tunnel_view(mass, scene).find("Lining thrust N [kN] of each rib") !=
          std::string::npos);
    // Of pinned ribs there is nothing to scale by.
    for (UnrolledNode& node : scene.unrolled.nodes) node.moment = 0;
    const std::string pinned = draw_tunnel_view(mass, scene);
    CHECK(pinned.find(">0 kN m everywhere<") != std::string::npos);
    CHECK(pinned.find("largest 456 kN at") != std::string::npos);
    CHECK(pinned.find("00000000") == std::string::npos);
  }

  TEST_CASE("joints that have slipped are lines in the section, as wide as they have slipped") {
    const Domain<3> ground{{-4, -3, -4}, {4, 3, 4}};
    const auto mass = jointed_mass(ground, 1, 1.5);
    REQUIRE(mass.bodies.size() > 100);
    TunnelView scene;
    scene.displacement.assign(mass.bodies.size(), 1e-3);
    CHECK(draw_tunnel_view(mass, scene).find("Slip of joints") == std::string::npos);
    scene.joints = {square({0, 0, 0}, 2e-3, 0, 1), square({0, 1, 0}, 1e-3, 2, 3),
                    square({2, 2, 0}, 2e-3, 4, 5),  // reaches no section
                    square({0, -1, 0}, 0, 6, 7)};
    scene.joints.back().is_open = true;
    const std::string picture = draw_tunnel_view(mass, scene);
    CHECK(xml_fault(picture) == "");
    const std::string joints = layer_of(picture, "joints");
    const auto widths = widths_in(joints, detail::slipped_colour);
    REQUIRE(widths.size() == 2);
    const detail::SlipScale scale(scene.joints, [](int) { return false; });
    CHECK(scale.top() == 2e-3);                             // a round number already
    CHECK(std::abs(widths[0] - scale.width(1e-3)) < 0.01);  // two decimals in the file
    CHECK(std::abs(widths[1] - scale.width(2e-3)) < 0.01);
    CHECK(widths_in(joints, detail::opened_colour).size() == 1);
    for (const char* const text : {">Slip of joints [mm]<", ">2.00<", ">opened joint<"})
      CHECK(picture.find(text) != std::string::npos);
  }

  TEST_CASE("one loose block with ten joints does not set the scale of slip") {
    const Domain<3> ground{{-4, -3, -4}, {4, 3, 4}};
    const auto mass = jointed_mass(ground, 1, 1.5);
    TunnelView scene;
    scene.displacement.assign(mass.bodies.size(), 1e-3);
    for (int k = 0; k < 40; ++k) scene.joints.push_back(square({0, 0, 0}, 1e-3, k, k + 1));
    const auto widest = [&] {
      return widths_in(layer_of(draw_tunnel_view(mass, scene), "joints"), detail::slipped_colour);
    };
    const auto before = widest();
    scene.displacement[60] = 0.2;
    for (int k = 0; k < 10; ++k) scene.joints.push_back(square({0, 0, 0}, 0.2, 60, k));
    const std::string loose = draw_tunnel_view(mass, scene);
    CHECK(loose.find(">≥ 1.00<") != std::string::npos);
    const auto after = widest();
    REQUIRE(after.size() == before.size() + 10);
    CHECK(after.front() == before.front());  // of those that have slipped by 1 mm
    CHECK(after.back() == before.back());    // no wider than the end of the scale
  }

  TEST_CASE("a joint is seen on the wall that is turned to the viewer, and on the face") {
    // A square tunnel along y with its face at y = 2.
    const std::vector<PrismaticOpening> openings{PrismaticOpening(
        SimplePolygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}), -PrismaticOpening::endless, 2)};
    const AxonometricView from_right(0.5 * std::numbers::pi, 0.2), from_portal(std::numbers::pi, 0);
    const HalfSpace<3> section{Vec3::UnitX(), 0};
    const auto seen = [&](const std::vector<Vec3>& corners, const HalfSpace<3>& cut,
                          const AxonometricView& view) {
      return detail::seen_lines({{corners, 1e-3, false, 0, 1}}, openings, cut, view);
    };
    // A level joint left of the tunnel, whose right-hand edge lies on its left wall.
    const std::vector<Vec3> left{{-3, 0, 0.5}, {-1, 0, 0.5}, {-1, 1, 0.5}, {-3, 1, 0.5}};
    const auto on_wall = seen(left, section, from_right);
    REQUIRE(on_wall.size() == 1);
    CHECK((on_wall[0].from - Vec3(-1, 0, 0.5)).norm() + (on_wall[0].to - Vec3(-1, 1, 0.5)).norm() <
          1e-12);
    CHECK(seen(left, section, AxonometricView(1.5 * std::numbers::pi, 0.2)).empty());
    CHECK(seen(left, {Vec3::UnitX(), -2}, from_right).size() == 1);  // the section alone
    // One that is cut by the face.
    const std::vector<Vec3> ahead{{-0.5, 2, 0}, {0.5, 2, 0}, {0.5, 4, 0}, {-0.5, 4, 0}};
    const HalfSpace<3> across{-Vec3::UnitY(), -1};
    const auto on_face = seen(ahead, across, from_portal);
    REQUIRE(on_face.size() == 1);
    CHECK(std::abs(on_face[0].from.y() - 2) + std::abs(on_face[0].to.y() - 2) < 1e-12);
    CHECK(seen({{-0.5, 3, 0}, {0.5, 3, 0}, {0.5, 4, 0}}, across, from_portal).empty());
  }

  TEST_CASE("section and viewer by the axis of the tunnel, whatever its trend") {
    const Domain<3> ground{{-6, -6, -6}, {6, 6, 6}};
    for (const double trend : {0.0, 0.5, 2.5, 4.0}) {
      CAPTURE(trend);
      const TunnelAxis axis({0.5, 0, 0}, trend);
      RockMass<Spatial> mass;
      mass.domain = ground;
      TunnelView view;
      CHECK(look_from(ViewFrom::face, mass, view) == "");  // no opening yet
      CHECK(view.azimuth == TunnelView{}.azimuth);
      const double infinite = PrismaticOpening::endless;
      mass.openings = {PrismaticOpening(circular_opening(3, 24), axis, -infinite, -1),
                       PrismaticOpening(circular_opening(3, 24), axis, -1, 2)};
      CHECK(look_from(ViewFrom::axis, mass, view) == "");
      CHECK_FALSE(view.shows_bolts_before);
      CHECK((view.section.normal - axis.right()).norm() < 1e-12);
      CHECK(std::abs(view.section.distance(axis.origin())) < 1e-12);
      // A quarter turn clockwise from the axis is the section's right.
      CHECK(std::cos(view.azimuth - trend - 0.62 * std::numbers::pi) == near(1));

      const std::string seen = look_from(ViewFrom::face, mass, view);
      CHECK(seen ==
            "Seen from the portal: cut across at 0.5 m along the axis, the face is at 2 m.");
      const AxonometricView from_portal(view.azimuth, view.elevation);
      CHECK((from_portal.towards() + axis.along()).norm() < 1e-12);
      CHECK((from_portal.right() - axis.right()).norm() < 1e-12);
      CHECK(std::abs(view.section.distance(axis.point({0, 0}, 0.5))) < 1e-12);
      CHECK(view.section.distance(axis.point({0, 0}, 1)) < 0);  // what lies ahead is kept

      CHECK(look_from(ViewFrom::above, mass, view) ==
            "Seen from above, cut open at the springing.");
      const AxonometricView plan(view.azimuth, view.elevation);
      CHECK((plan.right() - axis.along()).norm() < 1e-12);
      CHECK((plan.towards() - Vec3::UnitZ()).norm() < 1e-12);
      CHECK((view.section.normal - Vec3::UnitZ()).norm() < 1e-12);
      CHECK(view.shows_bolts_before);
      CHECK_FALSE(view.shows_lining_before);

      mass.openings = {PrismaticOpening(circular_opening(3, 24), axis)};
      CHECK(look_from(ViewFrom::face, mass, view).find("there is no face") != std::string::npos);
    }
    // A shaft.
    RockMass<Spatial> mass;
    mass.domain = {{-6, -6, -6}, {6, 6, 10}};
    mass.openings = {PrismaticOpening(circular_opening(3, 24),
                                      TunnelAxis({0, 0, 10}, 0, 0.5 * std::numbers::pi), 0, 6)};
    TunnelView view;
    CHECK(look_from(ViewFrom::above, mass, view) == "Seen from above, cut open at half its depth.");
    CHECK(view.section.offset == 2);
    (void)look_from(ViewFrom::face, mass, view);
    CHECK((AxonometricView(view.azimuth, view.elevation).towards() - Vec3::UnitZ()).norm() < 1e-12);
    CHECK(view.section.distance({0, 0, 7}) == near(0).scale(1));
  }

  TEST_CASE("of a body with parts on both sides of the section only those behind it are drawn") {
    // A block of which an excavation left two pieces: the larger one lies behind the section.
    RockMass<Spatial> mass;
    mass.domain = {{-4, -4, -4}, {4, 4, 4}};
    for (int side = 0; side < 6; ++side) mass.cuts.push_back({Cut::Kind::boundary, side});
    const auto behind = brick({-2.5, 0, 0}, {3, 1, 1}), before = brick({2, 0, 0}, {1, 1, 1});
    mass.bodies.push_back({{behind, before}, mass_properties(std::vector{behind, before})});
    TunnelView scene;
    scene.displacement = {1e-3};
    const std::string both = draw_tunnel_view(mass, scene);
    mass.bodies[0].parts.pop_back();
    CHECK(both == draw_tunnel_view(mass, scene));
    // The smaller one behind it is drawn though the centroid lies before.
    mass.bodies[0].parts = {brick({2.5, 0, 0}, {3, 1, 1}), brick({-2, 0, 0}, {1, 1, 1})};
    mass.bodies[0].properties = mass_properties(mass.bodies[0].parts);
    CHECK_NOTHROW((void)draw_tunnel_view(mass, scene));
  }
}

}  // namespace space_pictures_test
