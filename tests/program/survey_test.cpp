// SPDX-License-Identifier: MIT
// Joints as they were surveyed, and the outline as it was drawn, from an input file: the same rock
// as by numbers in the file, sets by name, what is said of them, and what is refused.
#include "survey.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/drawing/number_text.hpp>

#include "drawn_outline.hpp"
#include "harness.hpp"
#include "input.hpp"
#include "plausibility.hpp"
#include "run_results.hpp"
#include "support/near.hpp"

namespace survey_test {

using namespace voussoir_test;
using namespace voussoir::program;

namespace {

constexpr double degree = std::numbers::pi / 180;
const std::string head = "Set,Dip,Dip direction\n";
const std::string planes = head +
                           "A,30,100\nA,33,104\nA,28,95\nA,31,99\n"
                           "B,75,280\nB,70,285\nB,78,276\nB,74,281\n";

const std::string model = R"(
[model]
length = "2 m"
width = "24 m"
below_invert = "8 m"
[tunnel]
shape = "circle"
diameter = "4 m"
cover = "9 m"
facets = 24
trend = "10 deg"
[rock]
density = "2700 kg/m^3"
[stress]
K0 = 1
surcharge = "300 kPa"
[joint]
kn = "5 GPa/m"
ks = "0.5 GPa/m"
friction = "65 deg"
[blocks]
min_inscribed_radius = "0.2 m"
[boundary]
sides = "rollers"
base = "rollers"
)";
const std::string of_survey = "[joints]\norientations = \"survey.csv\"\n";
const std::string two_sets = R"(
[[joint_set]]
name = "A"
spacing = "1.6 m"
[[joint_set]]
name = "B"
spacing = "1.8 m"
)";

/// What is said of a file beside a table of planes; empty if it is read.
std::string faults_of(const std::string& text, const std::string& table,
                      const std::vector<std::string>& overrides = {}) {
  const Folder folder;
  (void)write_file(folder / "survey.csv", table);
  try {
    (void)read_input(write_file(folder / "case.toml", text), overrides);
  } catch (const InputErrors& errors) {
    return errors.what();
  }
  return "";
}
Input input_of(const std::string& text, const std::string& table,
               const std::vector<std::string>& overrides = {}) {
  const Folder folder;
  (void)write_file(folder / "survey.csv", table);
  return read_input(write_file(folder / "case.toml", text), overrides);
}

Results standing(const std::string& text, const std::string& table,
                 const std::vector<std::string>& more = {}, const std::string& drawing = "") {
  Results results = results_of(text, more, {{"survey.csv", table}, {"section.dxf", drawing}});
  REQUIRE((results.outcome.status == 0 || results.outcome.status == 6));
  return results;
}

double crown(const Results& results) {
  return results.json.at("convergence").at("crown_mm").get<double>();
}

std::string with_numbers(const Input& surveyed) {
  std::string text = model;
  for (const JointSetInput& set : surveyed.joint_sets)
    text += "[[joint_set]]\nname = \"" + set.name + "\"\nspacing = \"" +
            voussoir::shortest_text(*set.spacing) + " m\"\ndip = \"" +
            voussoir::shortest_text(set.plane.dip) + " rad\"\ndip_direction = \"" +
            voussoir::shortest_text(set.plane.dip_direction) +
            " rad\"\nK = " + voussoir::shortest_text(*set.fisher) + "\n";
  return text;
}

/// Pairs of group code and value.
std::string dxf(std::initializer_list<std::pair<int, std::string>> groups) {
  std::string text;
  for (const auto& [code, value] : groups) text += std::to_string(code) + "\n" + value + "\n";
  return text;
}
std::string line(double x1, double y1, double x2, double y2, const std::string& layer) {
  const auto number = [](double value) { return voussoir::shortest_text(value); };
  return dxf({{0, "LINE"},
              {8, layer},
              {10, number(x1)},
              {20, number(y1)},
              {11, number(x2)},
              {21, number(y2)}});
}
/// A square of `side` about a point, in the unit that $INSUNITS has as a number.
std::string square(double side, double x, double y, const std::string& unit) {
  const double h = side / 2;
  return dxf({{0, "SECTION"},
              {2, "HEADER"},
              {9, "$INSUNITS"},
              {70, unit},
              {0, "ENDSEC"},
              {0, "SECTION"},
              {2, "ENTITIES"}}) +
         line(x - h, y - h, x + h, y - h, "WALL") + line(x + h, y + h, x + h, y - h, "WALL") +
         line(x - h, y + h, x + h, y + h, "WALL") + line(x - h, y + h, x - h, y - h, "WALL") +
         line(x, y, x + h, y, "AXIS") + dxf({{0, "ENDSEC"}, {0, "EOF"}});
}
/// Walls, a floor and an arch of 4 m span: its floor below for `upwards` 1, above for -1.
/// @param rise  of the arch, an ellipse, over half its span
/// @return  anticlockwise
std::vector<Point> horseshoe(int chords, double rise, double wall, double upwards) {
  std::vector<Point> points{{-2, -wall}, {2, -wall}};
  for (int k = 0; k <= chords; ++k) {
    const double angle = 180.0 * k / chords * degree;
    points.push_back({2 * std::cos(angle), 2 * rise * std::sin(angle)});
  }
  for (Point& p : points) p[1] *= upwards;
  if (upwards < 0) std::reverse(points.begin(), points.end());
  return points;
}
std::string outline_drawing(const std::vector<Point>& points) {
  std::string lines;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point &a = points[k], &b = points[(k + 1) % points.size()];
    lines += line(a[0], a[1], b[0], b[1], "WALL");
  }
  return dxf({{0, "SECTION"}, {2, "ENTITIES"}}) + lines + dxf({{0, "ENDSEC"}, {0, "EOF"}});
}
const std::string drawn = R"(
shape = "polygon"
file = "section.dxf"
layer = "wall")";
std::string with_drawing() {
  return replaced(model, "\nshape = \"circle\"\ndiameter = \"4 m\"", drawn) + two_sets + of_survey;
}

}  // namespace

TEST_SUITE("program/survey") {
  TEST_CASE("surveyed sets are the sets whose numbers they come to, in 2-D and 3-D") {
    const Input surveyed = input_of(model + two_sets + of_survey, planes);
    REQUIRE(surveyed.joint_sets.size() == 2);
    // Four planes about a mean that is known: within the largest of their angles.
    CHECK(std::abs(surveyed.joint_sets[0].plane.dip - 30.5 * degree) < 1 * degree);
    CHECK(std::abs(surveyed.joint_sets[0].plane.dip_direction - 99.5 * degree) < 2 * degree);
    CHECK(surveyed.joint_sets[0].fisher.value_or(0) > 100);
    for (const char* dimension : {"model.dimension=2", "model.dimension=3"}) {
      const Results by_file = standing(model + two_sets + of_survey, planes, {"--set", dimension}),
                    by_number = standing(with_numbers(surveyed), "", {"--set", dimension});
      CHECK(crown(by_file) == crown(by_number));
      CHECK(by_file.json.at("verdict") == by_number.json.at("verdict"));
      CHECK(by_file.json.at("survey").at("sets").size() == 2);
      CHECK(by_file.outcome.out.find("survey   A: 4 planes, mean dip 30.5 deg") !=
            std::string::npos);
      CHECK(by_file.files.at("stereonet.svg").starts_with("<?xml"));
    }
  }

  TEST_CASE("another order of rows, separator or header is the same rock; another plane is not") {
    const auto id = [](const std::string& table) {
      return standing(model + two_sets + of_survey, table).json.at("run_id").get<std::string>();
    };
    const std::string first = id(planes);
    std::string semicolons = planes;
    for (char& c : semicolons)
      if (c == ',') c = ';';
    CHECK(id(replaced(semicolons, "Set;Dip;Dip direction", "FAMILY;dip;DipDir")) == first);
    CHECK(id(replaced(planes, "A,31,99", "A,32,99")) != first);
  }

  TEST_CASE("declination, strikes, one set without a column, a K of its own") {
    const std::string sets = model + two_sets + of_survey;
    const Input plain = input_of(sets, planes),
                turned = input_of(sets, planes, {"joints.declination=4 deg"});
    CHECK(std::abs(turned.joint_sets[0].plane.dip_direction -
                   plain.joint_sets[0].plane.dip_direction - 4 * degree) < 1e-9);
    CHECK(std::abs(*turned.joint_sets[0].fisher - *plain.joint_sets[0].fisher) <
          1e-6 * *plain.joint_sets[0].fisher);
    // A strike of 10 has its dip towards 100.
    const std::string strikes = "strike,dip\n10,30\n14,33\n5,28\n9,31\n";
    const std::string one_set =
        model + "[[joint_set]]\nspacing = \"1.6 m\"\n" + of_survey + "strike = \"right-hand\"\n";
    const Input by_strike = input_of(one_set, strikes);
    CHECK(std::abs(by_strike.joint_sets[0].plane.dip_direction -
                   plain.joint_sets[0].plane.dip_direction) < 1e-9);
    const Input own = input_of(sets, planes, {"joint_set[0].K=40"});
    CHECK(own.joint_sets[0].fisher == 40.0);
    const Input part = input_of(replaced(sets, "name = \"B\"",
                                         "dip = \"70 deg\"\n"
                                         "dip_direction = \"200 deg\"\nname = \"C\""),
                                planes);
    REQUIRE(part.survey->left_out.size() == 1);
    CHECK(part.survey->left_out[0] == "B");
  }

  TEST_CASE("bad input") {
    const std::string sets = model + two_sets + of_survey;
    const auto refused = [&](const std::string& text, const std::string& table,
                             std::initializer_list<const char*> words) {
      const std::string said = faults_of(text, table);
      CAPTURE(said);
      for (const char* word : words) CHECK(said.find(word) != std::string::npos);
    };
    CHECK(faults_of(sets, planes) == "");
    refused(sets, head + "A,95,100\n", {"joints.orientations", ":2", "95", "85"});
    refused(sets, "Set,Dip,Strike\nA,30,10\n",
            {"joints.orientations", "strike", "joints.strike = \"right-hand\""});
    refused(sets, "Set,Dip\nA,30\n", {"joints.orientations"});
    refused(sets, "Set,Dip,Dip,Dip direction\nA,30,30,100\n", {"joints.orientations"});
    refused(sets, "", {"joints.orientations"});
    refused(sets, head + "A,30,100\nA,30,105\nB,75,280\nB,75,281\nB,74,280\n",
            {"joint_set[0]", "has no K", "2 planes"});
    refused(sets, head + "A,30,100\nA,60,300\nA,80,10\nA,10,200\nB,75,280\nB,75,281\nB,74,280\n",
            {"joint_set[0]", "K = "});
    refused(replaced(sets, "name = \"B\"", "name = \"C\""), planes,
            {"joint_set[1]", "\"C\"", "A, B"});
    refused(replaced(sets, "trend = \"10 deg\"\n", ""), planes, {"tunnel.trend"});
    refused(replaced(sets, "name = \"A\"", "name = \"A\"\ndip = \"30 deg\""), planes,
            {"joint_set[0]", "dip_direction"});
    refused(replaced(sets, "survey.csv", "other.csv"), planes,
            {"joints.orientations", "no such file"});
    refused(model + two_sets + "[joints]\ndeclination = \"3 deg\"\n", planes,
            {"joints.file", "joints.declination"});
    refused(sets, "dip,dip direction\n30,100\n32,103\n29,98\n", {"names no sets"});
  }

  TEST_CASE("a survey without sets tells where its poles gather, and is drawn beside given dips") {
    std::string table = "No,Dip,Dip direction\n";
    for (const char* row :
         {"31,99", "75,280", "33,104", "70,285", "28,95", "78,276", "30,100", "74,281"})
      table += "1," + std::string(row) + "\n";
    const std::string sets = model + two_sets + of_survey, said = faults_of(sets, table);
    CAPTURE(said);
    for (const char* words :
         {"joints.orientations", "names no sets", "columns that are not read: No",
          "a column set in the file", "dip, dip_direction and K in every [[joint_set]]",
          "the poles gather about ", "/100 (4 planes)", "/280 (4 planes)"})
      CHECK(said.find(words) != std::string::npos);
    // One set that wants the mean of all of them is refused as well.
    const std::string one = model + "[[joint_set]]\nspacing = \"1.6 m\"\n" + of_survey;
    CHECK(faults_of(one, table).find("do not look like one set") != std::string::npos);
    CHECK(faults_of(one, table).find("the poles gather about ") != std::string::npos);
    const std::vector<std::string> dips{
        "joint_set[0].dip=31 deg", "joint_set[0].dip_direction=100 deg", "joint_set[0].K=200",
        "joint_set[1].dip=74 deg", "joint_set[1].dip_direction=281 deg", "joint_set[1].K=150"};
    const Input given = input_of(sets, table, dips);
    REQUIRE(given.survey);
    CHECK(given.survey->fits.empty());
    CHECK(given.survey->left_out.empty());
    CHECK(given.joint_sets[1].fisher == 150.0);
    CHECK(survey_lines(given).find("drawn, no mean and K fitted") != std::string::npos);
    CHECK(stereonet_svg(given).find("8 poles") != std::string::npos);
  }

  TEST_CASE("an outline as it is drawn: in millimetres, metres, on the site grid") {
    std::string points;
    for (const auto& [x, y] : {std::pair(-2, -2), {2, -2}, {2, 2}, {-2, 2}})
      points += "[\"" + std::to_string(x) + " m\", \"" + std::to_string(y) + " m\"], ";
    const std::string by_points = replaced(
        with_drawing(), "file = \"section.dxf\"\nlayer = \"wall\"", "vertices = [" + points + "]");
    const double expected = crown(standing(by_points, planes));
    CHECK(crown(standing(with_drawing(), planes, {}, square(4, 0, 0, "6"))) == expected);
    CHECK(crown(standing(with_drawing(), planes, {}, square(4000, 0, 0, "4"))) == expected);
    CHECK(crown(standing(with_drawing(), planes, {"--set", "tunnel.unit=mm"},
                         square(4000, 0, 0, "0"))) == expected);
    const Results on_site = standing(
        replaced(with_drawing(), "[model]\n", "[model]\norigin = [\"512300 m\", \"148 m\"]\n"),
        planes, {}, square(4, 512300, 148, "6"));
    CHECK(crown(on_site) == expected);
    CHECK(on_site.outcome.out.find("outline  ") != std::string::npos);
  }

  TEST_CASE("mapped joints are the same rock from CSV, DXF and GeoJSON") {
    struct Trace {
      double x1, y1, x2, y2;
      const char* set;
    };
    const std::vector<Trace> traces{{-12, 1, 12, 3, "A"},     {-12, -3, 12, -1, "A"},
                                    {-12, 5, 12, 7, "A"},     {-5, -12, -3, 12, "B"},
                                    {0.5, -12, 2.5, 12, "B"}, {5, -12, 7, 12, "B"}};
    std::string csv = "x1,y1,x2,y2,set\n", features, lines;
    for (const Trace& t : traces) {
      const auto n = [](double value) { return voussoir::shortest_text(value); };
      csv += n(t.x1) + "," + n(t.y1) + "," + n(t.x2) + "," + n(t.y2) + "," + t.set + "\n";
      lines += line(1000 * t.x1, 1000 * t.y1, 1000 * t.x2, 1000 * t.y2, t.set);
      features += std::string(features.empty() ? "" : ",") +
                  R"({"type":"Feature","properties":{"set":")" + t.set +
                  R"("},"geometry":{"type":"LineString","coordinates":[[)" + n(t.x1) + "," +
                  n(t.y1) + "],[" + n(t.x2) + "," + n(t.y2) + "]]}}";
    }
    const std::string grid = R"("crs":{"type":"name","properties":{"name":"EPSG:25832"}},)";
    const auto geojson = [&](const std::string& crs, const std::string& of) {
      return R"({"type":"FeatureCollection",)" + crs + R"("features":[)" + of + "]}";
    };
    const std::string drawing = dxf({{0, "SECTION"},
                                     {2, "HEADER"},
                                     {9, "$INSUNITS"},
                                     {70, "4"},
                                     {0, "ENDSEC"},
                                     {0, "SECTION"},
                                     {2, "ENTITIES"}}) +
                                lines + line(0, 0, 500, 500, "NOTES") +
                                dxf({{0, "ENDSEC"}, {0, "EOF"}});
    const auto with = [&](const std::string& file) {
      return model +
             "[[joint_set]]\nname = \"A\"\n[[joint_set]]\nname = \"B\"\nkn = \"8 GPa/m\"\n" +
             "[joints]\nfile = \"" + file + "\"\n";
    };
    const auto answer = [&](const std::string& file, const std::string& content) {
      const Folder folder;
      (void)write_file(folder / file, content);
      const Outcome outcome = run_program(
          {"run", write_file(folder / "case.toml", with(file)), "--out", folder / "out"});
      if (outcome.status == 2) return outcome.err;
      const auto json = nlohmann::json::parse(read_file(folder / "out/run.json"));
      return json.at("convergence").dump() + json.at("rock").at("bodies").dump() +
             json.at("rock").at("joints_by_source").dump();
    };
    const std::string expected = answer("joints.csv", csv);
    CHECK(expected.find("crown_mm") != std::string::npos);
    CHECK(answer("joints.dxf", drawing) == expected);
    CHECK(answer("joints.geojson", geojson(grid, features)) == expected);
    const auto refused = [&](const std::string& file, const std::string& content,
                             std::initializer_list<const char*> words) {
      const std::string said = answer(file, content);
      CAPTURE(said);
      for (const char* word : words) CHECK(said.find(word) != std::string::npos);
    };
    refused("j.json", geojson("", features), {"joints.file", "degrees"});
    refused("j.json", geojson(R"("crs":"urn:ogc:def:crs:OGC:1.3:CRS84",)", features), {"degrees"});
    refused("j.json", "{\"type\":", {"joints.file", "no JSON"});
    refused("j.json", geojson(grid, ""), {"no line strings"});
    refused("j.json", geojson(grid, replaced(features, "\"A\"", "\"C\"")), {"\"C\"", "A, B"});
    refused("j.json", geojson(grid, replaced(features, "[-12,1]", "[\"x\",1]")), {"feature 1"});
    refused("j.dxf", replaced(drawing, "\n8\nB\n", "\n0\nSPLINE\n8\nB\n"), {"joints.file"});
    std::string other = drawing;
    for (std::size_t at; (at = other.find("\n8\nB\n")) != std::string::npos;)
      other.replace(at, 5, "\n8\nD\n");
    refused("j.dxf", other, {"joints.file", "\"B\"", "layers"});
  }

  TEST_CASE("an outline by points may be closed, or have a point twice") {
    const auto vertices = [](const std::string& points) {
      const std::string text = replaced(model, "shape = \"circle\"\ndiameter = \"4 m\"",
                                        "shape = \"polygon\"\nvertices = [" + points + "]");
      return read_input_text(text, "case.toml", ".").tunnel.vertices;
    };
    const std::string a = "[\"-2 m\", \"-2 m\"], ", b = "[\"2 m\", \"-2 m\"], ",
                      c = "[\"0 m\", \"3 m\"], ";
    const auto expected = vertices(a + b + c);
    CHECK(expected.size() == 3);
    CHECK(vertices(a + b + c + a) == expected);
    CHECK(vertices(a + b + b + c) == expected);
    CHECK(vertices(c + b + a).size() == 3);
    CHECK(outline_fault({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}) == "");
    CHECK(outline_fault({{-2, -2}, {2, 4}, {2, -2}, {-2, 2}}).starts_with("crosses itself at ("));
    CHECK(outline_fault({{-2, -2}, {2, -2}, {2, 2}, {0, -2}, {-2, 2}})
              .starts_with("crosses itself at (0, -2)"));
    CHECK(outline_fault({{-2, 0}, {0, 0}, {2, 0}}) != "");
    CHECK(outline_fault({{3, -2}, {5, -2}, {4, 2}}).find("x 3 m to 5 m, y -2 m to 2 m") !=
          std::string::npos);
  }

  TEST_CASE("an outline on its head is known by its level side over an arch") {
    for (const int chords : {4, 12, 37, 180})
      for (const double rise : {0.2, 0.5, 1.0})  // of the arch over half its span
        for (const double wall : {0.2, 2.0}) {
          CAPTURE(chords);
          CAPTURE(rise);
          CAPTURE(wall);
          CHECK_FALSE(is_flat_above_an_arch(horseshoe(chords, rise, wall, 1)));
          CHECK(is_flat_above_an_arch(horseshoe(chords, rise, wall, -1)));
        }
    // A floor that falls by 3 % to one side.
    auto sloping = horseshoe(36, 1, 2, -1);
    for (auto& p : sloping)
      if (p[1] > 1.9) p[1] += 0.03 * p[0];
    CHECK(is_flat_above_an_arch(sloping));
    // Level on both sides, or on neither; a drain, and an uneven floor under a level roof.
    const auto is_said = [](std::vector<Point> points) { return is_flat_above_an_arch(points); };
    CHECK_FALSE(is_said({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}));
    CHECK_FALSE(is_said({{-1, -2}, {1, -2}, {2, 2}, {-2, 2}}));
    CHECK_FALSE(is_said(
        {{-2, -1.5}, {1.5, -1.5}, {1.5, -2}, {1.9, -2}, {1.9, -1.5}, {2, -1.5}, {2, 2}, {-2, 2}}));
    CHECK_FALSE(is_said({{-2, -1.8}, {-1, -2}, {0, -1.8}, {1, -2}, {2, -1.8}, {2, 2}, {-2, 2}}));
    std::vector<Point> round;
    for (int k = 0; k < 72; ++k)
      round.push_back({3 * std::cos(5 * k * degree), 3 * std::sin(5 * k * degree)});
    CHECK_FALSE(is_said(round));
  }

  TEST_CASE("an outline on its head is named by check and run, and stays as it was drawn") {
    const auto checked = [](double upwards, const std::vector<std::string>& more) {
      const Folder folder;
      (void)write_file(folder / "survey.csv", planes);
      (void)write_file(folder / "section.dxf", outline_drawing(horseshoe(12, 1, 1.5, upwards)));
      std::vector<std::string> arguments{"check", write_file(folder / "case.toml", with_drawing())};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = run_program(arguments);
      CHECK(outcome.status == 0);
      return outcome.out;
    };
    const std::string warned =
        "warning  tunnel.file has its flat side on top and its arch below, as where y counts "
        "downwards; it is read upwards: unless it is meant so, mirror it about a level line in the "
        "drawing";
    for (const char* dimension : {"model.dimension=2", "model.dimension=3"}) {
      CHECK(checked(-1, {"--set", dimension}).find(warned) != std::string::npos);
      CHECK(checked(1, {"--set", dimension}).find("flat side") == std::string::npos);
    }
    const auto read = [](double upwards) {
      std::string points;
      for (const Point& p : horseshoe(12, 1, 1.5, upwards))
        points += "[\"" + voussoir::shortest_text(p[0]) + " m\", \"" +
                  voussoir::shortest_text(p[1]) + " m\"], ";
      return read_input_text(replaced(model, "shape = \"circle\"\ndiameter = \"4 m\"",
                                      "shape = \"polygon\"\nvertices = [" + points + "]"),
                             "case.toml", ".");
    };
    const Input turned = read(-1);
    CHECK(turned.tunnel.crown() == near(1.5));
    CHECK(turned.tunnel.invert() == near(-2.0));
    REQUIRE(unusual_values(turned).size() == 1);
    CHECK(unusual_values(turned)[0].starts_with("tunnel.vertices has its flat side on top"));
    CHECK(unusual_values(read(1)).empty());
  }

  TEST_CASE("drawings that are no outline are refused, with what to do") {
    const auto said = [](const std::string& drawing,
                         const std::vector<std::string>& overrides = {}) {
      const Folder folder;
      (void)write_file(folder / "survey.csv", planes);
      (void)write_file(folder / "section.dxf", drawing);
      try {
        (void)read_input(write_file(folder / "case.toml", with_drawing()), overrides);
      } catch (const InputErrors& errors) {
        return std::string(errors.what());
      }
      return std::string();
    };
    const auto has = [&](const std::string& text, std::initializer_list<const char*> words) {
      CAPTURE(text);
      for (const char* word : words) CHECK(text.find(word) != std::string::npos);
    };
    has(said(square(4, 50, 0, "6")),
        {"tunnel.file", "does not contain", "model.origin = [\"50 m\""});
    const std::string place = "model.origin=[\"512300 m\", \"148 m\"]";
    // In millimetres, which the drawing does not say: the unit, and no place on another planet.
    has(said(square(4000, 512300e3, 148e3, "0"), {place}),
        {"does not contain",
         "unit = \"mm\", with which it is 4 m wide and lies about model.origin"});
    has(said(square(4000, 512300e3, 148e3, "0")),
        {"unit = \"mm\", with which it is 4 m wide, and model.origin = [\"512300 m\", \"148 m\"]"});
    has(said(square(4, 512300, 148, "6"), {place, "tunnel.unit=mm"}),
        {"unit = \"m\", with which it is 4 m wide and lies about model.origin"});
    // All that is drawn is no outline: its layers.
    has(said(square(4, 0, 0, "6"), {"tunnel.layer=axis"}),
        {"it is open: a gap of 2 m", "places from model.origin", "whose ends meet within 1 mm"});
    const std::string all = replaced(with_drawing(), "layer = \"wall\"\n", "");
    const Folder folder;
    (void)write_file(folder / "survey.csv", planes);
    (void)write_file(folder / "section.dxf", square(4, 0, 0, "6"));
    try {
      (void)read_input(write_file(folder / "case.toml", all), {});
      CHECK(false);
    } catch (const InputErrors& errors) {
      has(errors.what(), {"it is open", "its layer: \"WALL\", \"AXIS\""});
    }
    has(said(square(4000, 0, 0, "6")), {"model.width"});
    has(said(square(4, 512300, -148, "6"), {"model.origin=[\"512300 m\", \"148 m\"]"}),
        {"tunnel.file", "y -298 m to -294 m", "drawn with y downwards; mirror it about y = 0"});
    CHECK(said(square(4, 512300, -140, "6"), {"model.origin=[\"512300 m\", \"148 m\"]"})
              .find("downwards") == std::string::npos);
    has(said(square(4, 0, 0, "6"), {"tunnel.layer=lining"}), {"tunnel.file", "layer", "AXIS"});
    has(said(replaced(square(4, 0, 0, "6"), "ENDSEC\n0\nEOF\n", "")), {"tunnel.file"});
    has(said("AutoCAD Binary DXF\r\n"), {"tunnel.file"});
    has(said(square(4, 0, 0, "6"), {"tunnel.vertices=[[\"0 m\",\"0 m\"]]"}),
        {"tunnel.vertices", "tunnel.file"});
    has(said(square(4, 0, 0, "6"), {"tunnel.file=section.pdf"}), {"tunnel.file", ".dxf"});
    has(said(square(4, 0, 0, "6"), {"tunnel.file=none.dxf"}), {"tunnel.file", "no such file"});
  }
}

}  // namespace survey_test
