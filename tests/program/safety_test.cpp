// SPDX-License-Identifier: MIT
// `voussoir safety`: closed forms from files by every procedure, a bracket whose ends `run` agrees
// with, strength divided from the start and on the way, 2-D and 3-D.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "run_results.hpp"
#include "support/laid_problem.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace safety_test {

using namespace voussoir_test;
using Json = nlohmann::json;

namespace {

struct Safety {
  Outcome outcome;
  Json json;
  std::map<std::string, std::string> files;
  [[nodiscard]] double stands() const { return json.at("stands_over").get<double>(); }
  [[nodiscard]] double falls() const { return json.at("falls_over").get<double>(); }
};

Safety safety_of(const std::string& text, const std::vector<std::string>& more = {}) {
  const Folder folder;
  std::vector<std::string> arguments{"safety", write_file(folder / "case.toml", text), "--out",
                                     folder / "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Safety safety;
  safety.outcome = run_program(arguments);
  INFO(safety.outcome.out);
  INFO(safety.outcome.err);
  REQUIRE((safety.outcome.status == 0 || safety.outcome.status == 3));
  for (const auto& [path, content] : contents(folder / "out"))
    safety.files[std::filesystem::path(path).filename().string()] = content;
  safety.json = Json::parse(safety.files.at("safety.json"));
  return safety;
}

/// Blocks as a file has them, turned anticlockwise.
std::string blocks_text(const LaidProblem& problem, double turned, const std::string& joint) {
  char number[64];
  std::string out =
      "[rock]\ndensity = \"" + std::to_string(problem.density) + " kg/m^3\"\n[joint]\n" + joint;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    out +=
        std::string("[[block]]\n") + (problem.is_fixed(b) ? "fixed = true\n" : "") + "vertices = [";
    for (const voussoir::Vec2& v : problem.blocks[b].vertices()) {
      std::snprintf(number, sizeof number, "[\"%.15g m\", \"%.15g m\"], ",
                    std::cos(turned) * v.x() - std::sin(turned) * v.y(),
                    std::sin(turned) * v.x() + std::cos(turned) * v.y());
      out += number;
    }
    out += "]\n";
  }
  return out;
}

/// A block 2 m long and 0.4 m high on an incline of 30 degrees.
LaidProblem block_on_plane() {
  return {.blocks = {rectangle({1, -0.5}, 8, 1), rectangle({0, 0.2}, 2, 0.4)}, .fixed = {0}};
}

const std::vector<std::string> procedures{"two-level", "relaxation", "explicit"};

}  // namespace

TEST_SUITE("program/safety") {
  TEST_CASE("a block on an incline, by friction and by cohesion, by every procedure") {
    const double weight = 2500 * 9.81 * 2 * 0.4, slope = 30 * degree;
    const double by_friction = std::tan(50 * degree) / std::tan(slope),
                 by_cohesion = (4e3 * 2 + weight * std::cos(slope) * std::tan(25 * degree)) /
                               (weight * std::sin(slope));
    const std::string stiff = "kn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\n";
    for (const std::string& procedure : procedures) {
      CAPTURE(procedure);
      const std::vector<std::string> set{"--set", "run.method=" + procedure, "--width", "0.5"};
      const Safety rough =
          safety_of(blocks_text(block_on_plane(), slope, stiff + "friction = \"50 deg\"\n"), set);
      // Half of a percent between its ends, and as much for what may be out of balance.
      CHECK(rough.stands() == near(by_friction).epsilon(0.01));
      CHECK(rough.falls() == near(by_friction).epsilon(0.01));
      CHECK(rough.falls() <= rough.stands() * 1.005 * (1 + 1e-9));
      CHECK(rough.json.at("mechanism").at("detached_m2").get<double>() == near(0.8).epsilon(1e-6));
      // The limit load is the same closed form, within its own gap of half a percent.
      const Json& limit = rough.json.at("limit_load");
      CHECK(limit.at("holds_over").get<double>() <= by_friction * (1 + 1e-4));
      CHECK(limit.at("fails_over").get<double>() >= by_friction * (1 - 1e-4));
      CHECK(limit.at("gap_percent").get<double>() <= 0.5);
      CHECK(limit.at("mechanism_m2").get<double>() == near(0.8).epsilon(1e-6));
      CHECK(limit.at("in_situ_sides").is_null());
      const Safety glued = safety_of(blocks_text(block_on_plane(), slope,
                                                 "law = \"mohr-coulomb\"\n" + stiff +
                                                     "friction = \"25 deg\"\ncohesion = \"4 kPa\"\n"
                                                     "residual_cohesion = \"4 kPa\"\n"),
                                     set);
      CHECK(glued.stands() == near(by_cohesion).epsilon(0.01));
      CHECK(glued.falls() == near(by_cohesion).epsilon(0.01));
      CHECK(glued.json.at("limit_load").at("bound").get<double>() ==
            near(by_cohesion).epsilon(5.1e-3));
    }
  }

  TEST_CASE("a block on a rough joint slides at what Barton's strength is over its shear") {
    // 2 m long on 45 degrees: stress and shear are its weight / 2 m by the cosine and the sine.
    constexpr double slope = 45 * degree, JRC = 8, JCS = 50e6, residual = 28;
    const double stress = 2500 * 9.81 * 0.4 * std::cos(slope);
    const double expected =
        std::tan((residual + JRC * std::log10(JCS / stress)) * degree) / std::tan(slope);
    const std::string text = blocks_text(block_on_plane(), slope,
                                         "law = \"barton-bandis\"\nJRC = 8\nJCS = \"50 MPa\"\n"
                                         "residual_friction = \"28 deg\"\n"
                                         "initial_stiffness = \"20 GPa/m\"\n"
                                         "maximum_closure = \"0.2 mm\"\n");
    // Beyond its peak the joint has less strength, and a block that is let go at once slides
    // through it: weight comes on step by step by `two-level` alone, and the others need damping.
    for (const std::string& procedure : procedures) {
      CAPTURE(procedure);
      const Safety rough = safety_of(text, {"--set", "run.method=" + procedure});
      CHECK(rough.stands() <= 1.015 * expected);
      if (procedure == "two-level") CHECK(rough.falls() == near(expected).epsilon(0.015));
      if (procedure == "explicit") {
        const Safety damped =
            safety_of(text, {"--set", "run.method=explicit", "--set", "run.damping=0.95"});
        // The bracket, and 1 %: it still overshoots a little.
        CHECK(damped.falls() == near(expected).epsilon(0.02));
      }
      if (procedure != "two-level") CHECK(rough.stands() >= 0.8 * expected);
      CHECK(rough.json.at("limit_load").at("bound").is_null());
      CHECK(rough.outcome.out.find("limit    not sought: of Barton and Bandis' joints") !=
            std::string::npos);
    }
  }

  TEST_CASE("the bound is left out when asked, and of what it does not know") {
    const std::string text =
        blocks_text(block_on_plane(), 30 * degree,
                    "kn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\nfriction = \"50 deg\"\n");
    const Safety without = safety_of(text, {"--no-limit", "--width", "20"});
    CHECK(without.json.at("limit_load").at("bound").is_null());
    CHECK(without.json.at("limit_load").at("reason") == "not asked for");
    // Nothing stands: a slim block on a steep plane.
    const LaidProblem slim{.blocks = {rectangle({1, -0.5}, 8, 1), rectangle({0, 1}, 0.5, 2)},
                           .fixed = {0}};
    const Safety none =
        safety_of(blocks_text(slim, 30 * degree,
                              "kn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\nfriction = \"50 deg\"\n"),
                  {"--width", "20"});
    CHECK(none.outcome.out.find("limit    not sought: nothing stands") != std::string::npos);
  }

  TEST_CASE("Goodman and Bray's slope topples at their friction") {
    const std::string text =
        blocks_text(toppling_slope(), 30 * degree,
                    "kn = \"100 GPa/m\"\nks = \"100 GPa/m\"\nfriction = \"45 deg\"\n");
    const double expected = 1 / reference("F.gb.tanphi_limit");
    for (const std::string& procedure : procedures) {
      CAPTURE(procedure);
      const Safety slope =
          safety_of(text, {"--falls-where", "rockfall", "--set", "run.method=" + procedure});
      // Joints of 100 GPa/m give: half a percent beside the bracket's one.
      CHECK(slope.stands() == near(expected).epsilon(0.015));
      CHECK(slope.falls() == near(expected).epsilon(0.015));
      // Limit analysis is no safe bound here: blocks that topple would have to lift one another.
      const double bound = slope.json.at("limit_load").at("bound").get<double>();
      CHECK(bound > 1.15 * slope.falls());
      CHECK(bound < 1.25 * slope.falls());
      CHECK(slope.files.at("safety.svg").find("<svg") != std::string::npos);
    }
  }

  TEST_CASE("the ends of a bracket are what `run` says of them") {
    CircleInRock rock{.surcharge = "100 kPa"};
    const auto joint = [](double tangent) {
      char text[128];
      std::snprintf(text, sizeof text,
                    "kn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\nfriction = \"%.15g deg\"\n",
                    std::atan(tangent) / degree);
      return std::string(text);
    };
    constexpr double tangent = 1.4;
    rock.joint = joint(tangent);
    const std::vector<std::string> options{"--falls-where", "rockfall", "--width", "5"};
    std::vector<std::string> from_start = options;
    from_start.emplace_back("--from-start");
    const Safety whole = safety_of(rock.text(), from_start),
                 further = safety_of(rock.text(), options);
    REQUIRE(whole.outcome.status == 0);
    for (const double factor : {whole.stands(), whole.falls()}) {
      CircleInRock weaker = rock;
      weaker.joint = joint(tangent / factor);
      const Results run = results_of(weaker.text(), {"--set", "run.out_of_balance=0.005"});
      CAPTURE(run.outcome.out);
      CHECK((run.json.at("verdict") == "stable") == (factor == whole.stands()));
    }
    // Rock that has loosened before its strength goes: two paths, one answer, within two brackets.
    CHECK(further.stands() == near(whole.stands()).epsilon(0.1));
    // Every row of the table is a trial.
    const std::string& table = whole.files.at("safety.csv");
    CHECK(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')) ==
          whole.json.at("trials").size() + 1);
    CHECK(whole.outcome.out.find("safety   " + whole.json.at("text").get<std::string>()) !=
          std::string::npos);
    // Both sides of the truth: whatever stands, stands within the limit load. Rollers push as hard
    // as they must, which is more than they do in situ.
    const Json& limit = further.json.at("limit_load");
    if (!limit.at("is_infinite").get<bool>()) {
      CHECK(limit.at("bound").get<double>() >= 0.99 * further.stands());
      CHECK(limit.at("bound").get<double>() >=
            limit.at("in_situ_sides").at("holds_over").get<double>());
    }
    CHECK(further.outcome.out.find("\nlimit    ") != std::string::npos);
    // More of a mechanism than the first block that came off.
    CHECK(whole.json.at("mechanism").at("detached_m2").get<double>() > 0);
    CHECK(whole.files.at("safety.svg").find("strength of joints over") != std::string::npos);
  }

  TEST_CASE("a support at its strength is not said to fall") {
    CircleInRock rock{.surcharge = "100 kPa"};
    const std::string bolts =
        "[support.bolts]\nlength = \"2 m\"\nspacing = \"30 deg\"\nstiffness = \"0.2 GN/m\"\n"
        "yield_force = \"10 kN\"\n";
    // What rock moves elastically is too much for them, however strong its joints are.
    const Safety weak = safety_of(rock.text() + bolts, {"--falls-where", "supports"});
    CHECK(weak.json.at("text") ==
          "less than 0.05: a support is at its strength over every factor tried");
    CHECK(weak.outcome.out.find("strength over 1       exceeds: stable, bolts yielded") !=
          std::string::npos);
    CHECK(weak.json.at("mechanism").at("detached_m2") == 0.0);
  }

  TEST_CASE("a section and a slice of the same rock have one limit load") {
    // Joints that run along the tunnel: the slice, 2 m thick, is the section made thick. One is a
    // linear programme, the other has a cone for each corner of a contact.
    CircleInRock rock{.surcharge = "100 kPa"};
    rock.joint = "kn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\nfriction = \"54.46 deg\"\n";
    const std::vector<std::string> options{"--largest", "1", "--set"};
    const auto limit = [&](const char* dimension) {
      std::vector<std::string> with = options;
      with.push_back(std::string("model.dimension=") + dimension);
      return safety_of(rock.text(), with).json.at("limit_load");
    };
    const Json section = limit("2"), slice = limit("3");
    for (const char* sides : {"any", "in situ"}) {
      CAPTURE(sides);
      const auto of = [&](const Json& json) {
        return sides == std::string("any") ? json : json.at("in_situ_sides");
      };
      // Both brackets hold the one limit; what blocks have moved until rest is 0.7 mm.
      const double most = of(section).at("fails_over").get<double>();
      CHECK(of(slice).at("holds_over").get<double>() <= most * (1 + 1e-3));
      CHECK(of(slice).at("fails_over").get<double>() >=
            of(section).at("holds_over").get<double>() * (1 - 1e-3));
    }
    CHECK(slice.at("mechanism_m3").get<double>() ==
          near(2 * section.at("mechanism_m2").get<double>()).epsilon(1e-3));
  }

  TEST_CASE("bad input") {
    const auto refused = [](const std::string& text, const std::vector<std::string>& more,
                            const std::vector<std::string>& parts) {
      const Folder folder;
      std::vector<std::string> arguments{"safety", write_file(folder / "case.toml", text), "--out",
                                         folder / "out"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = run_program(arguments);
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      for (const std::string& part : parts) CHECK(outcome.err.find(part) != std::string::npos);
      CHECK_FALSE(std::filesystem::exists(folder / "out/safety.json"));
    };
    refused(CircleInRock{}.text(), {"--falls-where", "sliding"}, {"--falls-where", "rockfall"});
    refused(CircleInRock{}.text(), {"--width", "0"}, {"--width", "0.1", "50"});
    refused(CircleInRock{}.text(), {"--with-supports"}, {"--from-start"});
  }
}

}  // namespace safety_test
