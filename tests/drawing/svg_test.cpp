// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>
#include <voussoir/drawing/svg.hpp>

#include "io/xml_check.hpp"
#include "support/near.hpp"

namespace svg_test {

using namespace voussoir;

TEST_SUITE("drawing/svg") {
  TEST_CASE("text is escaped, and bytes that XML forbids are replaced") {
    CHECK(xml_escaped("a < b & \"c\" 'd' >") == "a &lt; b &amp; &quot;c&quot; &#39;d&#39; &gt;");
    CHECK(xml_escaped("φ = 35°, 𝜎 −") == "φ = 35°, 𝜎 −");
    const std::string replaced = "\xEF\xBF\xBD";
    CHECK(xml_escaped("\xFC"
                      "ber") == replaced + "ber");  // Latin-1
    CHECK(xml_escaped(std::string("a\0b\x1B", 4)) == "a" + replaced + "b" + replaced);
    CHECK(xml_escaped("\xC0\xAF") == replaced + replaced);     // "/" written too long
    CHECK(xml_escaped("\xED\xA0\x80").starts_with(replaced));  // half of a surrogate pair
    CHECK(xml_escaped("\xE2\x82") == replaced + replaced);     // cut off
  }

  TEST_CASE("paths are steps between rounded points") {
    SvgPath path;
    path.add_polygon(std::vector<Vec2>{{10, 10}, {10.125, 10}, {10.5, 9.25}});
    path.add_line({0, 0}, {-1, 0.004});
    CHECK(path.data() == "m10 10l.13 0 .37-.75zm-10-10l-1 0");
  }

  TEST_CASE("rounding does not pile up along a path") {
    SvgPath path;
    std::vector<Vec2> points;
    for (int i = 0; i <= 1000; ++i) points.emplace_back(i * 0.0149, 0);  // each step would be 0.01
    path.add_polyline(points);
    double x = 0;
    const std::string steps = path.data().substr(path.data().find('l') + 1);
    for (std::size_t i = 0; i < steps.size();) {
      std::size_t used = 0;
      x += std::stod(steps.substr(i), &used);
      i += used;
      (void)std::stod(steps.substr(i), &used);  // y
      i += used;
    }
    CHECK(std::abs(x - 14.9) < 0.006);
  }

  TEST_CASE("coordinates that are not finite are refused") {
    const Vec2 bad(std::numeric_limits<double>::quiet_NaN(), 0);
    SvgPath path;
    CHECK_THROWS_AS(path.move_to(bad), InvalidInput);
    SvgCanvas canvas(100, 50, 190, "");
    CHECK_THROWS_AS(canvas.circle(bad, 1, {}), InvalidInput);
    CHECK(xml_fault(canvas.document()) == "");
  }

  TEST_CASE("a document with everything in it is well-formed") {
    SvgCanvas canvas(100, 50, 190, "<\"Tünnel\" & Söhne>");
    canvas.clip_rectangle("frame", {{0, 0}, {10, 10}});
    canvas.hatch_pattern("hatch", "red", 6, 1);
    canvas.begin_layer("outer", "frame");
    canvas.begin_layer("inner");
    canvas.polygon(std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}},
                   {.fill = "url(#hatch)", .opacity = 0.5});
    canvas.polyline(std::vector<Vec2>{{0, 0}, {1, 0}},
                    {.stroke = "#123456", .dash = "3 2", .round_ends = true});
    canvas.path(SvgPath(), {});  // nothing
    CHECK_THROWS_AS((void)canvas.document(), std::logic_error);
    canvas.end_layer();
    canvas.text({5, 5}, "a < b & c",
                {.anchor = TextAnchor::end, .bold = true, .rotation = -90, .halo = true});
    canvas.end_layer();
    CHECK_THROWS_AS(canvas.end_layer(), std::logic_error);
    const std::string text = canvas.document();
    CHECK(xml_fault(text) == "");
    CHECK(text.find("width=\"190mm\" height=\"95mm\" viewBox=\"0 0 100 50\"") != std::string::npos);
    CHECK(text.find("font-family=\"sans-serif\"") != std::string::npos);
  }

  TEST_CASE("the check itself finds faults") {
    CHECK(xml_fault("<a><b></a></b>") != "");
    CHECK(xml_fault("<a x=\"1\" x=\"2\"/>") != "");
    CHECK(xml_fault("<a>R&D</a>") != "");
    CHECK(xml_fault("<a><b id=\"1\"/><b id=\"1\"/></a>") != "");
    CHECK(xml_fault("<a x=\"1\"><b/>text</a>\n") == "");
  }
}

TEST_SUITE("io/page_map") {
  TEST_CASE("up in the world is up on the page, with one scale") {
    // 10 m x 10 m in 200 px x 100 px: 10 px a metre, centred, world y up.
    const PageMap map = PageMap::equal_scales({{0, 0}, {10, 10}}, {{0, 0}, {200, 100}});
    CHECK(map.scale() == voussoir_test::near(10));
    CHECK(map({0, 0}).isApprox(Vec2(50, 100)));
    CHECK(map({10, 10}).isApprox(Vec2(150, 0)));
    CHECK(map.vector({1, 1}).isApprox(Vec2(10, -10)));
  }

  TEST_CASE("a triangle over the corner of a window is cut to what is inside") {
    const ViewRect window{{0, 0}, {2, 2}};
    const std::vector<Vec2> triangle = {{-1, -1}, {3, -1}, {-1, 3}};  // x + y <= 2 inside
    const std::vector<Vec2> inside = clip_polygon(triangle, window);
    double area = 0;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      area += cross(inside[i], inside[(i + 1) % inside.size()]) / 2;
      CHECK(window.grown(1e-12).contains(inside[i]));
    }
    CHECK(area == voussoir_test::near(2));  // half of the window
    CHECK(clip_polygon(std::vector<Vec2>{{5, 5}, {6, 5}, {5, 6}}, window).empty());
    const std::vector<Vec2> within = {{0.5, 0.5}, {1, 0.5}, {0.5, 1}};
    CHECK(clip_polygon(within, window) == within);
  }

  TEST_CASE("segments are cut at the window") {
    const ViewRect window{{0, 0}, {2, 2}};
    const auto across = clip_segment({-1, 1}, {3, 1}, window);
    REQUIRE(across);
    CHECK(across->first.isApprox(Vec2(0, 1)));
    CHECK(across->second.isApprox(Vec2(2, 1)));
    CHECK_FALSE(clip_segment({-1, 3}, {3, 3}, window));
    CHECK_FALSE(clip_segment({3, 0}, {0, -3}, window));  // passes the corner outside
    CHECK(clip_segment({1, 0.5}, {1, 1.5}, window)->second == Vec2(1, 1.5));
  }
}

}  // namespace svg_test
