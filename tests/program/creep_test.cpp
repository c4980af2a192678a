// SPDX-License-Identifier: MIT
// Joints that creep while stages last, from an input file: where delayed slip ends, stages cut in
// two, supports that are loaded as time goes on, and what is refused.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "run_results.hpp"

namespace creep_test {

using namespace voussoir_test;

namespace {

/// A tunnel of 4 m under isotropic stress: no joint carries shear before it is excavated.
/// @param rest  stages and supports
std::string tunnel(const std::string& joint, const std::string& rest) {
  return CircleInRock{.surcharge = "800 kPa",
                      .spacing = "1.5 m",
                      .joint = "kn = \"5 GPa/m\"\nfriction = \"80 deg\"\n" + joint}
             .text() +
         rest;
}

std::string lasting(const std::vector<const char*>& durations) {
  std::string stages;
  for (const char* duration : durations)
    stages += std::string("[[stage]]\nwall_traction = 0\nduration = \"") + duration + "\"\n";
  return stages;
}

const std::string delayed =
    "law = \"burgers\"\nks = \"0.5 GPa/m\"\nkelvin_stiffness = \"0.5 GPa/m\"\n"
    "kelvin_viscosity = \"5 GPa d/m\"\n";
const std::string endless =
    "law = \"burgers\"\nks = \"0.5 GPa/m\"\nmaxwell_viscosity = \"50 GPa d/m\"\n";
const std::string lining = R"([support.lining]
thickness = "20 cm"
E = "25 GPa"
interface = { kn = "5 GPa/m", friction = "35 deg" }
)";

double crown(const nlohmann::json& json) {
  return json.at("convergence").at("crown_mm").get<double>();
}

}  // namespace

TEST_SUITE("program/creep") {
  TEST_CASE("delayed slip ends where a softer joint is at once, in 2-D and 3-D") {
    // 1 / ks + 1 / kK: 0.25 GPa/m. Ten times the time constant, 10 d: e^-10 is missing.
    for (const char* dimension : {"model.dimension=2", "model.dimension=3"}) {
      CAPTURE(dimension);
      const std::vector<std::string> set{"--set", dimension};
      const double at_once = crown(results_of(tunnel("ks = \"0.5 GPa/m\"\n", ""), set).json),
                   softer = crown(results_of(tunnel("ks = \"0.25 GPa/m\"\n", ""), set).json);
      const nlohmann::json run = results_of(tunnel(delayed, lasting({"100 d"})), set).json;
      const nlohmann::json& stage = run.at("stages")[0];
      REQUIRE(stage.contains("creep"));
      CHECK(run.at("verdict") == "stable");
      // Joints that do not creep and those that have not crept yet are alike; searches end at 1e-3.
      CHECK(std::abs(crown(stage.at("creep")[0]) - at_once) < 0.25 * at_once);
      CHECK(softer > 1.1 * at_once);
      CHECK(std::abs(crown(run) - softer) < 0.02 * softer);
      // In 3-D that of the run is of the middle third of the tunnel.
      CHECK(std::abs(crown(stage) - crown(run)) < 1e-3 * crown(run));
      CHECK(stage.at("creep").back().at("time_d") == 100);
    }
  }

  TEST_CASE("without a duration nothing creeps") {
    const Results burgers = results_of(tunnel(delayed, "")),
                  coulomb = results_of(tunnel("ks = \"0.5 GPa/m\"\n", ""));
    CHECK(crown(burgers.json) == crown(coulomb.json));
    CHECK_FALSE(burgers.json.at("stages")[0].contains("creep"));
    CHECK(burgers.outcome.out.find("creep") == std::string::npos);
  }

  TEST_CASE("a stage cut in two is the whole stage") {
    const Results whole = results_of(tunnel(endless, lasting({"200 d"}))),
                  parts = results_of(tunnel(endless, lasting({"80 d", "120 d"})));
    // The same steps of 20 d; searches end at 1e-3.
    CHECK(std::abs(crown(whole.json) - crown(parts.json)) < 2e-3 * crown(whole.json));
    CHECK(whole.json.at("stages")[0].at("creep").size() == 10);
    CHECK(parts.json.at("stages")[0].at("creep").size() == 4);
    CHECK(whole.outcome.out.find("after 200 d of creep, 10 steps: stable") != std::string::npos);
  }

  TEST_CASE("joints that creep load the lining that stands already") {
    const auto thrust = [](const nlohmann::json& run) {
      return run.at("lining").at("mean_thrust_kN_per_m").get<double>();
    };
    const auto after = [&](const char* duration) {
      return results_of(tunnel(endless, lining +
                                            "[[stage]]\nwall_traction = 0\n[[stage]]\n"
                                            "wall_traction = 0\ninstall = [\"lining\"]\n"
                                            "duration = \"" +
                                            std::string(duration) + "\"\n"))
          .json;
    };
    const nlohmann::json day = after("1 d"), month = after("30 d"), year = after("1 a");
    CHECK(thrust(day) > 0);
    CHECK(thrust(month) > 3 * thrust(day));
    CHECK(thrust(year) > thrust(month));
    CHECK(crown(year) > crown(month));
    // Without shear in its joints rock presses as a liquid: p R on a ring, p at the crown's depth.
    CHECK(thrust(year) < (0.8e3 + 2.7 * 9.81 * 10) * 2);
  }

  TEST_CASE("bad input") {
    const auto said = [](const std::string& joint, const char* duration) {
      const Folder folder;
      return run_program({"run",
                          write_file(folder / "case.toml", tunnel(joint, lasting({duration}))),
                          "--out", folder / "out"});
    };
    const auto refused = [&](const std::string& joint, const char* duration,
                             std::initializer_list<const char*> words) {
      const Outcome outcome = said(joint, duration);
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      CHECK(outcome.err.find("stage[0].duration") != std::string::npos);
      for (const char* word : words) CHECK(outcome.err.find(word) != std::string::npos);
    };
    refused("ks = \"0.5 GPa/m\"\n", "3 d", {"none does", "law = \"burgers\""});
    refused(endless, "1000 a", {"steps", "1000 steps"});
    refused(endless, "-1 d", {"outside the accepted range"});
    refused(endless, "3 months", {"months", "\"30 d\""});
    refused(endless, "3 days", {"did you mean `d`?"});
    const auto law = [&](const std::string& joint, const char* words) {
      const Outcome outcome = said("law = \"burgers\"\nks = \"0.5 GPa/m\"\n" + joint, "0 d");
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      CHECK(outcome.err.find(words) != std::string::npos);
    };
    law("", "creeps in no way");
    law("kelvin_stiffness = \"1 GPa/m\"\n", "nothing how fast");
    law("kelvin_viscosity = \"20 GPa d/m\"\n", "nothing how far");
    law("maxwell_viscosity = \"20 GPa/m\"\n", "a viscosity per area");
  }
}

}  // namespace creep_test
