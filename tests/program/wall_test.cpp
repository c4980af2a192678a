// SPDX-License-Identifier: MIT
// A joint that runs along a wall, on it or a little to either side: pieces in between are dropped,
// and the answer is that of the rock behind them.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/tunnel/support_demand.hpp>

#include "analysis.hpp"
#include "harness.hpp"
#include "outputs.hpp"
#include "support/degree.hpp"
#include "support/folder.hpp"
#include "support/near.hpp"

namespace wall_test {

namespace {

using namespace voussoir_test;
using namespace voussoir::program;
using voussoir::Vec2;

/// The edge of an outline that faces the rock in a direction.
struct Wall {
  Vec2 middle, outward = {0, 0};  ///< `outward` is of length 1

  Wall(const voussoir::SimplePolygon& outline, double degrees) {
    const Vec2 direction(std::cos(degrees * degree), std::sin(degrees * degree));
    double best = 0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const auto edge = outline.edge(k);
      const Vec2 along = (edge.end - edge.start).normalized(), normal(along.y(), -along.x());
      if (!(normal.dot(direction) > best + 1e-9)) continue;
      best = normal.dot(direction);
      middle = 0.5 * (edge.start + edge.end);
      outward = normal;
    }
  }
};

/// Joints along a wall, 2 m apart, every second course moved by half a block of 2 m; one of them on
/// the wall, or `behind` it. With `ends` joints across it end the slab in between 2 m from the
/// middle of the wall, or 4, else it is an arm of the blocks beside the opening.
std::string beds(const Wall& wall, double behind, bool ends) {
  std::string text = "x1,y1,x2,y2\n";
  const Vec2 along(wall.outward.y(), -wall.outward.x());
  const auto add = [&](double u, double v, double to_u, double to_v) {
    const Vec2 a = wall.middle + u * along + v * wall.outward,
               b = wall.middle + to_u * along + to_v * wall.outward;
    char line[128];
    std::snprintf(line, sizeof line, "%.12f,%.12f,%.12f,%.12f\n", a.x(), a.y(), b.x(), b.y());
    text += line;
  };
  for (int k = -12; k <= 12; ++k) {
    const double low = k == 0 ? behind : 2.0 * k;
    const double high = k == -1 ? behind : 2.0 * (k + 1);
    add(-30, low, 30, low);
    for (double u = (k % 2 == 0) == ends ? -29 : -30; u < 30; u += 2) add(u, low, u, high);
  }
  return text;
}

/// A shape of tunnel, as in a file.
struct Shape {
  const char *name, *text;
};
constexpr Shape box{
    "box",
    "shape = \"polygon\"\n"
    "vertices = [[\"-4 m\",\"-3 m\"],[\"4 m\",\"-3 m\"],[\"4 m\",\"3 m\"],[\"-4 m\",\"3 m\"]]\n"};
constexpr Shape horseshoe{"horseshoe",
                          "shape = \"horseshoe\"\nwidth = \"8 m\"\nwall_height = \"4 m\"\n"};
constexpr Shape circle{"circle", "shape = \"circle\"\ndiameter = \"8 m\"\n"};

struct Answer {
  double thrust, moment, crown;
};

/// @param degrees  which way the wall faces that the joint runs along
Answer answer_of(const Shape& shape, double degrees, const std::string& edge, bool ends,
                 double behind) {
  const Folder folder;
  std::string text = read_file(VOUSSOIR_TEST_DATA "/walls/bedding-above-flat-roof.toml");
  const std::size_t from = text.find("shape = "), to = text.find("cover = ");
  REQUIRE(to < text.size());
  text.replace(from, to - from, shape.text);
  const Input input = read_input_text(
      text, "walls", folder / ".",
      {"boundary.sides=\"" + edge + '"', "boundary.base=\"" + edge + '"', "model.width=36 m",
       "model.below_invert=10 m", "tunnel.cover=14 m", "joints.file=beds.csv"});
  write_file(folder / "beds.csv", beds(Wall(opening_of(input), degrees), behind, ends));
  const RunResult run = run_of(input, [](const std::string&, double) { return true; });
  CHECK(run.verdict() == voussoir::Verdict::stable);
  // What a reader of run.json and of the screen sees: numbers, and a wall that is all there.
  const auto json = nlohmann::json::parse(run_json(input, run));
  for (const char* key : {"crown_mm", "right_springing_mm", "left_springing_mm", "invert_mm"})
    CHECK(json.at("convergence").at(key).is_number());
  for (const char* key :
       {"largest_thrust_kN_per_m", "mean_thrust_kN_per_m", "largest_moment_kNm_per_m"})
    CHECK(json.at("lining").at(key).is_number());
  CHECK(run_summary(input, run).find("detached") == std::string::npos);
  const auto demand = voussoir::support_demand(run.tunnel);
  return {demand.largest_thrust, demand.largest_moment, run.convergence().crown};
}

/// From a centimetre inside of the wall to a centimetre behind it.
std::vector<Answer> answers_of(const Shape& shape, double degrees, const std::string& edge,
                               bool ends) {
  CAPTURE(std::string(shape.name));
  CAPTURE(degrees);
  CAPTURE(edge);
  CAPTURE(ends);
  std::vector<Answer> answers;
  for (const double behind : {-1e-2, -1e-3, -1e-6, -1e-9, 0.0, 1e-9, 1e-6, 1e-3, 1e-2}) {
    CAPTURE(behind);
    const Answer here = answer_of(shape, degrees, edge, ends, behind);
    const Answer before = answers.empty() ? here : answers.back();
    // What is asked of neighbours (3 %): a slab of a centimetre weighs a hundredth of the load.
    CHECK(here.thrust == near(before.thrust).epsilon(0.03));
    CHECK(here.moment == near(before.moment).epsilon(0.03));
    CHECK(here.crown == near(before.crown).epsilon(0.03));
    answers.push_back(here);
  }
  return answers;
}

}  // namespace

TEST_SUITE("program/wall") {
  TEST_CASE("a joint along a wall or a little beside it changes nothing that it should not") {
    (void)answers_of(box, 90, "rollers", false);
    (void)answers_of(box, 90, "elastic", true);
    (void)answers_of(horseshoe, 0, "elastic", true);
    (void)answers_of(circle, 47.5, "rollers", true);
  }

  TEST_CASE("the same of every wall, left as right [long]") {
    for (const bool ends : {true, false}) {
      const std::string edge = ends ? "rollers" : "elastic";
      (void)answers_of(box, 90, edge, ends);
      (void)answers_of(horseshoe, 270, edge, ends);
      (void)answers_of(circle, 87.5, edge, ends);
      for (const auto& [shape, degrees] :
           {std::pair(box, 0.0), std::pair(horseshoe, 0.0), std::pair(horseshoe, 47.5),
            std::pair(circle, 2.5), std::pair(circle, 47.5)}) {
        const std::vector<Answer> right = answers_of(shape, degrees, edge, ends),
                                  left = answers_of(shape, 180 - degrees, edge, ends);
        for (std::size_t k = 0; k < right.size(); ++k) {
          // Searches end with an error of 1e-3 of the displacements; forces come of differences of
          // them (0.4 % as measured).
          CHECK(left[k].thrust == near(right[k].thrust).epsilon(0.01));
          CHECK(left[k].moment == near(right[k].moment).epsilon(0.01));
          CHECK(left[k].crown == near(right[k].crown).epsilon(1e-3));
        }
      }
    }
  }
}

}  // namespace wall_test
