// SPDX-License-Identifier: MIT
// A joint that runs along a wall, on it or a little behind: pieces in between are dropped, and the
// answer is that of the rock behind them.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include <voussoir/tunnel/support_demand.hpp>

#include "analysis.hpp"
#include "harness.hpp"
#include "support/folder.hpp"
#include "support/near.hpp"

namespace wall_test {

namespace {

using namespace voussoir_test;
using namespace voussoir::program;

std::string line(double x0, double y0, double x1, double y1) {
  char text[128];
  std::snprintf(text, sizeof text, "%.12f,%.12f,%.12f,%.12f\n", x0, y0, x1, y1);
  return text;
}

/// Level joints 2 m apart, every second course moved by half a block of 2 m, with one level joint
/// at the roof of an 8 m x 6 m box, or `above` it. With `ends` upright joints below it end the slab
/// at both walls, else it is an arm of the blocks beside the opening.
std::string beds(double above, bool ends) {
  std::string text = "x1,y1,x2,y2\n";
  for (int k = -12; k <= 10; ++k) {
    const double low = k == 0 ? 3 + above : 3 + 2.0 * k;
    const double high = k == -1 ? 3 + above : 3 + 2.0 * (k + 1);
    text += line(-30, low, 30, low);
    for (double x = (k % 2 == 0) == ends ? -29 : -28; x < 30; x += 2) text += line(x, low, x, high);
  }
  return text;
}

struct Answer {
  double thrust, moment, crown;
};

Answer answer_of(const std::string& traces, const std::vector<std::string>& overrides) {
  const Folder folder;
  const std::string data = VOUSSOIR_TEST_DATA "/walls/";
  write_file(folder / "bedding-above-flat-roof.csv", traces);
  const Input input = read_input_text(read_file(data + "bedding-above-flat-roof.toml"), "walls",
                                      folder / ".", overrides);
  const RunResult run = run_tunnel(input, [](const std::string&, double) { return true; });
  const auto demand = voussoir::support_demand(run.tunnel);
  CHECK(run.verdict() == voussoir::Verdict::stable);
  return {demand.largest_thrust, demand.largest_moment, run.built.stages.back().convergence.crown};
}

}  // namespace

TEST_SUITE("program/wall") {
  TEST_CASE("a level joint a little above a flat roof changes nothing that it should not") {
    for (const char* edge : {"rollers", "elastic"})
      for (const bool ends : {true, false}) {
        CAPTURE(edge);
        CAPTURE(ends);
        const std::vector<std::string> keys = {std::string("boundary.sides=\"") + edge + '"',
                                               std::string("boundary.base=\"") + edge + '"'};
        const Answer on_roof = answer_of(beds(0, ends), keys);
        Answer before = on_roof;
        for (const double above : {1e-9, 1e-6, 1e-3, 1e-2}) {
          CAPTURE(above);
          const Answer here = answer_of(beds(above, ends), keys);
          // What is asked of neighbours (3 %): a slab of a centimetre weighs a hundredth of the
          // load.
          CHECK(here.thrust == near(before.thrust).epsilon(0.03));
          CHECK(here.moment == near(before.moment).epsilon(0.03));
          CHECK(here.crown == near(before.crown).epsilon(0.03));
          before = here;
        }
      }
  }
}

}  // namespace wall_test
