// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/io/blocks_picture.hpp>
#include <voussoir/io/interaction_picture.hpp>

#include "io/xml_check.hpp"
#include "support/near.hpp"

namespace pictures_test {

using namespace voussoir;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Square blocks of 1 m around a square opening of 4 m, with a ring, one bolt and one of each
/// state.
BlocksPicture small_picture() {
  BlocksPicture picture;
  picture.header = {"Case <A> & B", {"Stable."}, {{"crown convergence", "3 mm"}}};
  for (int i = -8; i < 8; ++i) {
    for (int j = -8; j < 8; ++j) {
      if (i >= -2 && i < 2 && j >= -2 && j < 2) continue;
      const double x = i, y = j;
      picture.blocks.push_back(
          {{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}, 0.01 / (1 + x * x + y * y)});
    }
  }
  picture.blocks.front().is_fallen = true;
  picture.outline = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  picture.joints = {{{0, 2}, {0, 3}, PictureJoint::State::slipped},
                    {{1, 2}, {1, 3}, PictureJoint::State::opened},
                    {{2, 2}, {2, 3}, PictureJoint::State::closed}};
  picture.bolts = {{{0, 2},
                    {0, 5},
                    {{{0, 3}, 50e3, PictureCrossing::State::yielded},
                     {{0, 4}, 20e3, PictureCrossing::State::ruptured}}}};
  picture.ground_surface = 8;
  return picture;
}

PictureLining ring(double thrust, double moment) {
  PictureLining lining;
  lining.thickness = 0.1;
  for (int i = 0; i < 24; ++i) {
    const double angle = i * std::numbers::pi / 12;
    const Vec2 out(std::cos(angle), std::sin(angle));
    lining.nodes.push_back({2 * out, out, thrust, moment * std::cos(2 * angle)});
  }
  return lining;
}

InteractionPicture small_diagram() {
  InteractionPicture picture;
  picture.diameter = 10;
  picture.thicknesses = {0, 0.02, 0.1};
  picture.spacings = {{"7.5°", 7.5}, {"15°", 15.0}, {"no bolts", {}}};
  picture.values.resize(3, 3);
  picture.values << 0.0204, 0.03, not_a_number, 0.01, 0.012, 0.013, 0.004, 0.0041, 0.0042;
  picture.failed.setConstant(3, 3, false);
  picture.failed(0, 2) = true;
  return picture;
}

}  // namespace

TEST_SUITE("io/blocks_picture") {
  TEST_CASE("a full picture is well-formed and says what it shows") {
    BlocksPicture picture = small_picture();
    const std::string bolted = draw_blocks_picture(picture);
    CHECK(xml_fault(bolted) == "");
    for (const std::string text :
         {"Case &lt;A&gt; &amp; B", "Stable.", "slipped joint", "opened joint", "detached block",
          "bolt yields", "bolt ruptured", "force in bolt, 50 kN", "Greatest force in each bolt"}) {
      CAPTURE(text);
      CHECK(contains(bolted, text));
    }
    picture.linings = {ring(812e3, 4e3)};
    const std::string lined = draw_blocks_picture(picture);
    CHECK(xml_fault(lined) == "");
    for (const std::string text :
         {"max 812 at", "max 4.00 at 0°", "min −4.00 at 90°", "compression (+)", "lining, 10 cm"}) {
      CAPTURE(text);
      CHECK(contains(lined, text));
    }
    CHECK_FALSE(contains(lined, "Greatest force in each bolt"));
    CHECK_FALSE(contains(lined, "hole filled with lining"));
    picture.fills = {{{2, 0}, {2.3, 0}, {2, 0.5}}};
    CHECK(contains(draw_blocks_picture(picture), "hole filled with lining"));
  }

  TEST_CASE("diagrams have a scale bar, and forces of no account do not fill them") {
    BlocksPicture picture = small_picture();
    picture.linings = {ring(812e3, 4e3)};
    const std::string loaded = draw_blocks_picture(picture);
    CHECK(contains(loaded, ">500 kN/m<"));
    CHECK(contains(loaded, ">2 kN m/m<"));
    // The reference thrust is of no consequence for what is of the same order.
    picture.reference_thrust = 10e6;
    CHECK(draw_blocks_picture(picture) == loaded);

    // 0.6 kN/m where 10 MN/m are the scale: the diagram is that of 10 MN/m / 200 = 50 kN/m, the
    // moment's that of 50 kN/m at 0.1 m / 6, and the numbers say what there is.
    picture.linings = {ring(600, 3)};
    picture.reference_thrust = 10e6;
    const std::string idle = draw_blocks_picture(picture);
    CHECK(xml_fault(idle) == "");
    CHECK(contains(idle, ">50 kN/m<"));
    CHECK(contains(idle, ">0.5 kN m/m<"));
    CHECK(contains(idle, "max 0.6 at"));
    CHECK(contains(idle, "max 0.003 at"));

    // The bar across a bolt: 1 N is not drawn as 50 kN is.
    picture.linings.clear();
    for (PictureCrossing& c : picture.bolts[0].crossings) c.force = 1;
    CHECK(contains(draw_blocks_picture(picture), "force in bolt, 1 kN"));
  }

  TEST_CASE("a run gone bad is drawn as far as it goes, and the rest is counted") {
    BlocksPicture picture = small_picture();
    picture.blocks[3].corners[0].x() = not_a_number;
    picture.blocks[4].displacement = not_a_number;
    picture.bolts[0].crossings[0].force = std::numeric_limits<double>::infinity();
    picture.bolts.push_back({{not_a_number, 0}, {0, 1}, {}});
    picture.joints[0].p.y() = not_a_number;
    picture.linings = {ring(not_a_number, 1e3)};
    picture.linings[0].nodes[2].point.x() = not_a_number;
    const std::string text = draw_blocks_picture(picture);
    CHECK(xml_fault(text) == "");
    CHECK(contains(text, "not finite numbers: 1"));
    CHECK_FALSE(contains(text, "nan"));
    CHECK_FALSE(contains(text, "inf"));
  }

  TEST_CASE("what parts say is in the picture once, as text, and nothing of it is drawn") {
    BlocksPicture picture = small_picture();
    const std::string silent = draw_blocks_picture(picture);
    CHECK_FALSE(contains(silent, "</title></path>"));
    const auto block = std::find_if(picture.blocks.begin(), picture.blocks.end(),
                                    [](const auto& b) { return b.corners[0] == Vec2(2, 0); });
    REQUIRE(block != picture.blocks.end());
    block->says = "block <7>\nmoved 2 mm";
    picture.blocks[0].says = "far off";  // outside of the view
    picture.bolts[0].says = "bolt 1 & only";
    picture.linings = {ring(1e5, 1e3)};
    for (std::size_t k = 0; k < 24; ++k)
      picture.linings[0].nodes[k].says = "node " + std::to_string(k) + ".";
    const std::string text = draw_blocks_picture(picture);
    CHECK(xml_fault(text) == "");
    const auto count = [&](const std::string& part) {
      int found = 0;
      for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
      return found;
    };
    CHECK(count("<title>block &lt;7&gt;\nmoved 2 mm</title></path>") == 1);
    CHECK(count("<title>bolt 1 &amp; only</title></path>") == 1);
    CHECK(count("far off") == 0);
    for (int k = 0; k < 24; ++k) CHECK(count("<title>node " + std::to_string(k) + ".") == 1);
    // Its block of 1 m is as large as it is drawn: 640 px show 12 m.
    const std::size_t at = text.find("<title>block"), from = text.rfind(" d=\"m", at) + 5;
    const std::string outline = text.substr(from, text.find('"', from) - from);
    CHECK(contains(outline, "l53.3 0 0-53.3-53.3 0z"));
    // Nothing is painted: no place has a colour of its own.
    const std::size_t spots = text.find("<g id=\"spots\"");
    const std::string layer = text.substr(spots, text.find("</g>", spots) - spots);
    CHECK(contains(layer, "fill=\"none\" pointer-events=\"all\">"));
    CHECK_FALSE(contains(layer, "stroke=\""));
  }

  TEST_CASE("loads are arrows as long as they are large, which end where they act") {
    BlocksPicture picture = small_picture();
    const std::string without = draw_blocks_picture(picture);
    CHECK_FALSE(contains(without, detail::load_colour));
    picture.loads = {{{0, 3}, {0, -40e3}, 0, "the load"},
                     {{3, 0}, {-20e3, 0}, 5e3, "the other"},
                     {{0, not_a_number}, {1e9, 0}}};
    const std::string text = draw_blocks_picture(picture);
    CHECK(xml_fault(text) == "");
    for (const std::string word :
         {"load, up to 40.0 kN/m", "moment, 5.00 kN m/m", "<title>the load", "<title>the other"})
      CHECK(contains(text, word));
    const std::size_t from = text.find("<g id=\"loads\"");
    REQUIRE(from != std::string::npos);
    const std::string layer = text.substr(from, text.find("</g>", from) - from);
    // The white rims are whole arrows.
    std::vector<std::array<Vec2, 2>> arrows;
    for (std::size_t at = 0; (at = layer.find("<line ", at)) != std::string::npos; ++at) {
      const std::string line = layer.substr(at, layer.find("/>", at) - at);
      if (!contains(line, "white")) continue;
      const auto number = [&](const std::string& name) {
        return std::stod(line.substr(line.find(name + "=\"") + name.size() + 2));
      };
      arrows.push_back({Vec2(number("x1"), number("y1")), Vec2(number("x2"), number("y2"))});
    }
    REQUIRE(arrows.size() == 2);
    // Down is down on the page; 46 px are the largest, and lengths are written to 0.01 px.
    const auto& [down, left] = std::pair{arrows[0], arrows[1]};
    CHECK(Vec2(down[1] - down[0] - Vec2(0, 46)).norm() < 0.02);
    CHECK(Vec2(left[1] - left[0] - Vec2(-23, 0)).norm() < 0.02);
    // The tips are 3 m apart in both directions, at 640 px for 12 m.
    CHECK(Vec2(left[1] - down[1] - 640.0 / 12 * Vec2(3, 3)).norm() < 0.05);
    // Anticlockwise: from the right over the top. A turn the other way goes down first.
    const std::size_t turn = layer.rfind("<path d=\"", layer.find("stroke-width=\"4.4\""));
    REQUIRE(turn != std::string::npos);
    const std::string turns = layer.substr(turn, layer.find('"', turn + 9) - turn);
    picture.loads[1].moment = -5e3;
    const std::string clockwise = draw_blocks_picture(picture);
    CHECK(contains(text, turns));
    CHECK_FALSE(contains(clockwise, turns));
    const std::string step = turns.substr(turns.find('l') + 1);
    CHECK(std::stod(step.substr(step.find('-', 1))) < 0);
  }

  TEST_CASE("nothing at all is a picture too") {
    CHECK(xml_fault(draw_blocks_picture({})) == "");
    BlocksPicture picture;
    picture.linings.emplace_back();
    picture.bolts = {{}};
    CHECK(xml_fault(draw_blocks_picture(picture)) == "");
    picture.view = ViewRect{{0, 0}, {0, 1}};
    CHECK_THROWS_AS((void)draw_blocks_picture(picture), InvalidInput);
  }

  TEST_CASE("the view is three diameters about the opening, what is outside is not written") {
    const BlocksPicture picture = small_picture();
    const ViewRect view = view_around_opening(picture);
    CHECK(view.low.isApprox(Vec2(-6, -6)));
    CHECK(view.high.isApprox(Vec2(6, 6)));
    CHECK(view_of_everything(picture).contains({8, 8}));
    BlocksPicture larger = picture;
    for (int k = 0; k < 500; ++k) {
      const double x = 100 + k;
      larger.blocks.push_back({{{x, 0}, {x + 1, 0}, {x, 1}}, 0.0});
    }
    larger.view = view;
    // The overview alone grows: less than 40 bytes a block.
    CHECK(draw_blocks_picture(larger).size() < draw_blocks_picture(picture).size() + 500 * 40);
  }

  TEST_CASE("one loosened block does not use up the scale of colours") {
    std::vector<PictureBlock> blocks(200, PictureBlock{{}, 0.009});
    CHECK_FALSE(detail::DisplacementScale(blocks).is_cut());
    CHECK(detail::DisplacementScale(blocks).top() ==
          voussoir_test::near(0.01));  // round, in mm too
    blocks[7].displacement = 2;
    CHECK(detail::DisplacementScale(blocks).is_cut());
    CHECK(detail::DisplacementScale(blocks).top() == voussoir_test::near(0.01));
    blocks[7].is_fallen = true;
    CHECK_FALSE(detail::DisplacementScale(blocks).is_cut());
  }
}

TEST_SUITE("io/interaction_picture") {
  TEST_CASE("computed values, failures and the row without bolts are shown") {
    const std::string text = draw_interaction_picture(small_diagram());
    CHECK(xml_fault(text) == "");
    for (const std::string part :
         {">20.4<", ">4.20<", ">no bolts<", ">7.5°<", "blocks detach", "% of a", "t / D"}) {
      CAPTURE(part);
      CHECK(contains(text, part));
    }
    CHECK_FALSE(contains(text, "nan"));
    CHECK_FALSE(contains(text, "not computed"));  // the only gap is a failure
  }

  TEST_CASE("what is no result has a banner and marks of its own") {
    BlocksPicture rock = small_picture();
    CHECK_FALSE(contains(draw_blocks_picture(rock), "banner"));
    rock.banner = PictureBanner{"UNDECIDED", "no <equilibrium>"};
    const std::string text = draw_blocks_picture(rock);
    CHECK(xml_fault(text).empty());
    CHECK(contains(text, "id=\"banner\""));
    CHECK(contains(text, ">UNDECIDED<"));
    CHECK(contains(text, ">no &lt;equilibrium&gt;<"));
    // Over the rock: what comes later lies on top.
    CHECK(text.find("id=\"banner\"") > text.find("id=\"bolts\""));

    InteractionPicture picture = small_diagram();
    CHECK_FALSE(contains(draw_interaction_picture(picture), "undecided"));
    picture.undecided.setConstant(3, 3, false);
    picture.undecided(1, 1) = true;
    picture.values(1, 1) = not_a_number;
    picture.banner = PictureBanner{"1 OF 9 TUNNELS UNDECIDED", ""};
    const std::string diagram = draw_interaction_picture(picture);
    CHECK(xml_fault(diagram).empty());
    CHECK(contains(diagram, "undecided: no result"));
    CHECK_FALSE(contains(diagram, "not computed"));
    CHECK(contains(diagram, ">?</text>"));
    CHECK(contains(diagram, ">1 OF 9 TUNNELS UNDECIDED<"));
    picture.undecided.setConstant(2, 3, false);
    CHECK_THROWS_AS((void)draw_interaction_picture(picture), InvalidInput);
  }

  TEST_CASE("rock that falls from a tunnel that stands is told from a collapse") {
    InteractionPicture picture = small_diagram();
    picture.failed(1, 2) = true;
    const std::string alike = draw_interaction_picture(picture);
    CHECK(contains(alike, ">blocks detach<"));
    picture.collapsed.setConstant(3, 3, false);
    picture.collapsed(0, 2) = true;
    const std::string apart = draw_interaction_picture(picture);
    CHECK(xml_fault(apart) == "");
    CHECK(contains(apart, ">collapse<"));
    CHECK(contains(apart, ">rock falls, the rest stands<"));
    CHECK_FALSE(contains(apart, ">blocks detach<"));
    picture.collapsed.setConstant(2, 3, false);
    CHECK_THROWS_AS((void)draw_interaction_picture(picture), InvalidInput);
  }

  TEST_CASE("what is marginal has a ring of its own, and the legend says so") {
    InteractionPicture picture = small_diagram();
    const auto rings = [&] {
      const std::string text = draw_interaction_picture(picture);
      std::size_t count = 0;
      for (auto at = text.find("r=\"10.5\""); at != std::string::npos;
           at = text.find("r=\"10.5\"", at + 1))
        ++count;
      return count;
    };
    CHECK(rings() == 0);
    CHECK_FALSE(contains(draw_interaction_picture(picture), "marginal"));
    picture.marginal.setConstant(3, 3, false);
    picture.marginal(1, 2) = picture.marginal(0, 0) = true;
    CHECK(rings() == 3);  // one in the legend
    const std::string text = draw_interaction_picture(picture);
    CHECK(xml_fault(text) == "");
    CHECK(contains(text, ">marginal: limits and rates decide<"));
    picture.marginal.setConstant(2, 3, false);
    CHECK_THROWS_AS((void)draw_interaction_picture(picture), InvalidInput);
  }

  TEST_CASE("another quantity has its own name and unit") {
    InteractionPicture picture = small_diagram();
    picture.values *= 1e7;  // 40 to 300 kN
    picture.quantity = InteractionQuantity::in("bolt force", 1e-3, "kN");
    const std::string text = draw_interaction_picture(picture);
    CHECK(xml_fault(text) == "");
    CHECK(text.find("bolt force, kN") != std::string::npos);
    CHECK(text.find(">204<") != std::string::npos);  // 0.0204 e7 N at its point
    CHECK(text.find("% of a") == std::string::npos);
    CHECK(text.find(">kN<") == text.rfind(">kN<"));  // one scale beside the colours
    CHECK(draw_interaction_picture(small_diagram()).find("% of a") != std::string::npos);
  }

  TEST_CASE("results from elsewhere are drawn where they belong, outside the axes not at all") {
    InteractionPicture picture = small_diagram();
    picture.others = {{0.05, 10, 0.0123, "stiffer <bar>"},
                      {0.05, 5, 0.02, "beyond the axis"},
                      {0.02, 12, not_a_number, "bare"}};
    picture.others_name = "other bars";
    const std::string text = draw_interaction_picture(picture);
    CHECK(xml_fault(text) == "");
    CHECK(contains(text, "stiffer &lt;bar&gt;: 12.3"));
    CHECK_FALSE(contains(text, "beyond the axis"));
    CHECK(contains(text, "bare: blocks detach"));
    CHECK_FALSE(contains(text, "nan"));
    CHECK(contains(text, "other bars"));
    CHECK_FALSE(contains(draw_interaction_picture(small_diagram()), "other"));
  }

  TEST_CASE("between no lining and the first that there is nothing is drawn") {
    // No contour, no colour: what was not computed is not shown. With the thinnest lining at 2 cm,
    // three quarters of what one grid would have between 0 and 10 cm.
    const std::string text = draw_interaction_picture(small_diagram());
    CHECK(contains(text, ">no lining<"));
    CHECK(contains(text, "id=\"contours\""));
    CHECK(contains(text, "id=\"contours-column-0\""));
    CHECK(contains(text, "id=\"row-2\""));
    CHECK(contains(text, "id=\"row-2-column-0\""));
    // The lined part alone draws the same contours: it knows nothing of what has no lining.
    const auto layer = [](const std::string& picture, const char* name) {
      const std::size_t from = picture.find(std::string("id=\"") + name + "\"");
      REQUIRE(from != std::string::npos);
      return picture.substr(from, picture.find("</g>", from) - from);
    };
    InteractionPicture other = small_diagram();
    other.values.row(0) << 0.0205, 0.0299, not_a_number;
    const std::string changed = draw_interaction_picture(other);
    CHECK(layer(changed, "contours") == layer(text, "contours"));
    CHECK(layer(changed, "contours-column-0") != layer(text, "contours-column-0"));
    InteractionPicture lined = small_diagram();
    lined.thicknesses = {0.01, 0.02, 0.1};
    CHECK_FALSE(contains(draw_interaction_picture(lined), "no lining"));
  }

  TEST_CASE("grids from two by two, without values, or without contours are drawn") {
    InteractionPicture picture = small_diagram();
    picture.thicknesses = {0, 0.1};
    picture.spacings = {{"15°", 15.0}, {"no bolts", {}}};
    picture.failed.resize(0, 0);
    picture.values = Eigen::Matrix2d::Constant(0.01);
    CHECK(xml_fault(draw_interaction_picture(picture)) == "");
    picture.values.setConstant(not_a_number);
    const std::string empty = draw_interaction_picture(picture);
    CHECK(xml_fault(empty) == "");
    CHECK(contains(empty, "not computed"));
    picture.values.setZero();
    CHECK(xml_fault(draw_interaction_picture(picture)) == "");
  }

  TEST_CASE("tables that do not fit their axes are refused") {
    InteractionPicture picture = small_diagram();
    picture.thicknesses = {0, 0.1, 0.1};
    CHECK_THROWS_AS((void)draw_interaction_picture(picture), InvalidInput);
    picture = small_diagram();
    picture.spacings[1].value = {};
    CHECK_THROWS_AS((void)draw_interaction_picture(picture), InvalidInput);
    picture = small_diagram();
    picture.values.resize(2, 3);
    CHECK_THROWS_AS((void)draw_interaction_picture(picture), InvalidInput);
    picture = small_diagram();
    picture.diameter = 0;
    CHECK_THROWS_AS((void)draw_interaction_picture(picture), InvalidInput);
  }
}

}  // namespace pictures_test
