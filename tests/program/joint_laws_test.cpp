// SPDX-License-Identifier: MIT
// Contact laws of joints from an input file, one for each set: against each other, against closed
// forms on an incline, key by key, and against docs/input.md.
#include "joint_laws.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include <voussoir/contact/law_in_situ.hpp>
#include <voussoir/core/dimension.hpp>
#include <voussoir/drawing/number_text.hpp>

#include "harness.hpp"
#include "input.hpp"
#include "plausibility.hpp"
#include "run_results.hpp"
#include "support/degree.hpp"

namespace joint_laws_test {

using namespace voussoir_test;
using namespace voussoir::program;
using voussoir::InvalidInput;

namespace {

/// A tunnel of 4 m; the joints of its sets go on along it.
std::string tunnel(const std::string& joint, const std::string& of_first,
                   const std::string& of_second) {
  return CircleInRock{
      .spacing = "1.5 m", .of_first = of_first, .of_second = of_second, .joint = joint}
      .text();
}

const std::string coulomb = "kn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\nfriction = \"55 deg\"\n";
const std::string rough = R"(law = "barton-bandis"
JRC = 10
JCS = "60 MPa"
residual_friction = "30 deg"
initial_stiffness = "5 GPa/m"
maximum_closure = "1 mm"
)";

/// A complete table of each law.
std::string table_of(const JointLawRow& row) {
  if (row.word == "barton-bandis") return rough;
  const std::string creep = row.word == "burgers" ? "maxwell_viscosity = \"100 GPa d/m\"\n" : "";
  return "law = \"" + std::string(row.word) + "\"\n" + coulomb + creep;
}

double crown(const Results& results) {
  return results.json.at("convergence").at("crown_mm").get<double>();
}

/// A slab that lies on an incline, of rock of 2500 kg/m^3.
std::string incline(double angle, double length, double height, const std::string& joint) {
  const auto point = [&](double along, double up) {
    return "[\"" + voussoir::shortest_text(along * std::cos(angle) - up * std::sin(angle)) +
           " m\", \"" + voussoir::shortest_text(along * std::sin(angle) + up * std::cos(angle)) +
           " m\"]";
  };
  const auto block = [&](double from, double to, double low, double high) {
    return "vertices = [" + point(from, low) + ", " + point(to, low) + ", " + point(to, high) +
           ", " + point(from, high) + "]\n";
  };
  return "[rock]\ndensity = \"2500 kg/m^3\"\n[joint]\n" + joint + "[[block]]\nfixed = true\n" +
         block(-4 * length, 4 * length, -1, 0) + "[[block]]\n" + block(0, length, 0, height);
}
std::string verdict(const std::string& text) {
  return results_of(text).json.at("verdict").get<std::string>();
}
constexpr double weight = 2500 * 9.81;  // [N/m^3]

/// Messages of a file that is refused, or what is called unusual of one that is read.
std::string said_of(const std::string& text) {
  std::string said;
  try {
    for (const std::string& line : unusual_values(read_input_text(text, "case.toml", ".")))
      said += line + "\n";
  } catch (const InputErrors& errors) {
    for (const InputError& error : errors.errors()) said += error.text() + "\n";
  }
  return said;
}

std::string value_text(const LawParameter& parameter, double value) {
  if (parameter.dimension == voussoir::dimension::number) return voussoir::shortest_text(value);
  const std::string unit = voussoir::detail::base_units(parameter.dimension);
  return "\"" + voussoir::shortest_text(value) + " " + unit + "\"";
}

}  // namespace

TEST_SUITE("program/joint_laws") {
  TEST_CASE("a law of its own for every set, in 2-D and 3-D, at rest and in motion") {
    for (const JointLawRow& first : joint_law_rows())
      for (const JointLawRow& second : joint_law_rows()) {
        const std::string text = tunnel(coulomb, table_of(first), table_of(second));
        for (const char* dimension : {"model.dimension=2", "model.dimension=3"}) {
          CAPTURE(text);
          const Results run = results_of(text, {"--set", dimension});
          CHECK(run.json.at("verdict") == "stable");
          const auto& joints = run.json.at("rock").at("joints_by_source");
          REQUIRE(joints.size() == 2);
          CHECK(joints[0].at("law") == first.word);
          CHECK(joints[1].at("law") == second.word);
          CHECK(crown(run) > 0.1);
        }
      }
    const Results moving = results_of(tunnel(coulomb, rough, ""), {"--set", "run.method=explicit"});
    const Results resting = results_of(tunnel(coulomb, rough, ""));
    // Both stop at an error estimate of 1e-3.
    CHECK(std::abs(crown(moving) - crown(resting)) < 5e-3 * crown(resting));
  }

  TEST_CASE("without cohesion a Mohr-Coulomb joint is Coulomb's, alone and beside it") {
    const std::string bare = "law = \"mohr-coulomb\"\n";
    const double expected = crown(results_of(tunnel(coulomb, "", "")));
    CHECK(std::abs(crown(results_of(tunnel(bare + coulomb, "", ""))) - expected) < 2e-3 * expected);
    CHECK(std::abs(crown(results_of(tunnel(coulomb, bare, ""))) - expected) < 2e-3 * expected);
    const std::vector<std::string> spatial{"--set", "model.dimension=3"};
    CHECK(std::abs(crown(results_of(tunnel(coulomb, "", bare), spatial)) -
                   crown(results_of(tunnel(coulomb, "", ""), spatial))) < 2e-3 * expected);
  }

  TEST_CASE("cohesion holds rock that falls without it") {
    const std::string weak = "kn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\nfriction = \"8 deg\"\n";
    CHECK(results_of(tunnel(weak, "", "")).json.at("verdict") != "stable");
    const std::string held = "law = \"mohr-coulomb\"\n" + weak +
                             "cohesion = \"1 MPa\"\ntensile_strength = \"500 kPa\"\n";
    CHECK(results_of(tunnel(held, "", "")).json.at("verdict") == "stable");
  }

  TEST_CASE("a bonded block on an incline cracks at its heel") {
    // Linear stress under it: gamma h (cos a - 3 h / b sin a) at the heel is in tension.
    const double angle = 60 * degree, height = 1, length = 1;
    const double tension =
        weight * height * (3 * height / length * std::sin(angle) - std::cos(angle));
    const auto with = [&](double strength) {
      return verdict(incline(angle, length, height,
                             "law = \"mohr-coulomb\"\nkn = \"10 GPa/m\"\nks = \"10 GPa/m\"\n"
                             "friction = \"45 deg\"\ncohesion = \"1 MPa\"\ntensile_strength = \"" +
                                 voussoir::shortest_text(strength) + " Pa\"\n"));
    };
    CHECK(with(1.005 * tension) == "stands");
    CHECK(with(0.995 * tension) != "stands");
  }

  TEST_CASE("a rough slab slides at the angle of its peak strength") {
    // tan of phi_r + JRC log10(JCS / sigma), sigma = gamma h cos a: by a fixed point.
    const double height = 0.02, length = 1;
    double peak = 60 * degree;
    for (int k = 0; k < 100; ++k)
      peak = 28 * degree + 4 * degree * std::log10(50e6 / (weight * height * std::cos(peak)));
    const std::string joint =
        "law = \"barton-bandis\"\nJRC = 4\nJCS = \"50 MPa\"\nresidual_friction = \"28 deg\"\n"
        "initial_stiffness = \"10 GPa/m\"\nmaximum_closure = \"0.1 mm\"\n"
        "largest_stress = \"10 kPa\"\n";
    CHECK(verdict(incline(peak - 1 * degree, length, height, joint)) == "stands");
    CHECK(verdict(incline(peak + 1 * degree, length, height, joint)) == "falls");
  }

  TEST_CASE("every parameter: good, at the ends of its range, beyond them, unusual, left out") {
    for (const JointLawRow& row : joint_law_rows()) {
      const std::string good = tunnel(table_of(row), "", "");
      CAPTURE(good);
      CHECK(said_of(good) == "");
      for (const LawParameter& parameter : row.parameters) {
        const std::string key = "joint." + std::string(parameter.key);
        CAPTURE(key);
        const auto with = [&](double value) {
          std::string table = table_of(row), line = std::string(parameter.key) + " = ";
          if (const auto at = table.find("\n" + line); at != std::string::npos)
            table.erase(at + 1, table.find('\n', at + 1) - at);
          return said_of(tunnel(table + line + value_text(parameter, value) + "\n", "", ""));
        };
        const Range& range = parameter.range;
        const auto is_refused = [&](const std::string& said) {
          return said.find(key + " = ") != std::string::npos &&
                 said.find("accepted: ") != std::string::npos;
        };
        for (const auto& [bound, included] : {std::pair(range.low, range.low_included),
                                              std::pair(range.high, range.high_included)}) {
          if (!std::isfinite(bound)) continue;
          const bool is_low = bound == range.low;
          const double step = bound == 0 ? 1e-300 : 1e-9 * std::abs(bound);
          const std::string beyond = with(is_low ? bound - step : bound + step);
          CAPTURE(beyond);
          CHECK(is_refused(beyond));
          if (!included) CHECK(is_refused(with(bound)));
          // Inside it may be unusual, or not fit the others; it is not outside of its range.
          const std::string inside = with(included ? bound : is_low ? bound + step : bound - step);
          CHECK(inside.find("outside") == std::string::npos);
        }
        if (parameter.beside.empty()) {
          const double usual = std::sqrt(
              std::max(parameter.common_low, 1e-3 * parameter.common_high) * parameter.common_high);
          if (range.contains(usual * 1000))
            CHECK(with(usual * 1000).find(key + " = ") != std::string::npos);
          CHECK(parameter.common_high < 1000 * std::max(parameter.common_low, 1e-30));
        }
        if (!parameter.otherwise && parameter.as.empty()) {
          std::string table = table_of(row);
          const auto at = table.find("\n" + std::string(parameter.key) + " = ");
          table.erase(at + 1, table.find('\n', at + 1) - at);
          const std::string said = said_of(tunnel(table, "", ""));
          CAPTURE(said);
          CHECK(said.find(key) != std::string::npos);
          CHECK(said.find("missing") != std::string::npos);
        }
      }
    }
  }

  TEST_CASE("stiffness and friction of a law at a stress are those of its formulas") {
    const auto law_of = [](const std::string& joint) {
      return read_input_text(tunnel(joint, "", ""), "case.toml", ".").joint.value();
    };
    for (const double stress : {0.2e6, 1e6, 3e6}) {
      CAPTURE(stress);
      const voussoir::AnyJoint plain = law_of(coulomb);
      CHECK(std::abs(voussoir::normal_stiffness_at(plain, stress) / 5e9 - 1) < 1e-9);
      CHECK(std::abs(voussoir::friction_angle_at(plain, stress) - 55 * degree) < 1e-9);
      const voussoir::AnyJoint bonded =
          law_of("law = \"mohr-coulomb\"\n" + coulomb + "cohesion = \"300 kPa\"\n");
      CHECK(std::abs(std::tan(voussoir::friction_angle_at(bonded, stress)) -
                     (std::tan(55 * degree) + 0.3e6 / stress)) < 1e-9);
      // K_ni / (1 - V / V_m)^2 = K_ni (1 + sigma / (K_ni V_m))^2, over a hundredth of the closure.
      const voussoir::AnyJoint hyperbolic = law_of(rough);
      const double ratio = 1 + stress / (5e9 * 1e-3);
      CHECK(std::abs(voussoir::normal_stiffness_at(hyperbolic, stress) / (5e9 * ratio * ratio) -
                     1) < 0.01);
      // The peak, between two slips a tenth apart; one step there dilates as a curve in small
      // steps does to within a degree.
      const double peak = 30 * degree + 10 * degree * std::log10(60e6 / stress);
      const double found = voussoir::friction_angle_at(hyperbolic, stress);
      CAPTURE(found / degree);
      CAPTURE(peak / degree);
      CHECK(found < peak + 1e-9);
      CHECK(found > peak - 1 * degree);
    }
  }

  TEST_CASE("bad input") {
    const auto refused = [](const std::string& joint, const std::string& of_set,
                            std::initializer_list<const char*> words) {
      const std::string said = said_of(tunnel(joint, of_set, ""));
      CAPTURE(said);
      for (const char* word : words) CHECK(said.find(word) != std::string::npos);
    };
    refused("law = \"hoek\"\n" + coulomb, "", {"joint.law", "\"coulomb\", \"mohr-coulomb\""});
    refused(coulomb + "cohesion = \"1 MPa\"\n", "", {"joint.cohesion", "law = \"mohr-coulomb\""});
    refused(coulomb, "law = \"barton-bandis\"\nJRC = 8\n",
            {"joint_set[0]", "JCS", "residual_friction", "initial_stiffness", "maximum_closure"});
    refused(coulomb, "JRC = 8\n", {"joint_set[0].JRC", "law = \"barton-bandis\""});
    const std::string bonded = "law = \"mohr-coulomb\"\n" + coulomb + "cohesion = \"1 MPa\"\n";
    refused(bonded + "tensile_strength = \"2 MPa\"\n", "",
            {"tensile_strength", "cohesion / tan(friction)", "700.2"});
    refused(bonded + "residual_cohesion = \"2 MPa\"\n", "", {"residual_cohesion", "cohesion"});
    refused(bonded + "residual_friction = \"56 deg\"\n", "", {"residual_friction", "friction"});
    refused(bonded + "dilation = \"5 deg\"\n", "", {"dilation", "dilation_limit"});
    refused(bonded + "dilation = \"56 deg\"\ndilation_limit = \"5 mm\"\n", "",
            {"dilation", "residual_friction"});
    refused(rough + "joint_length = \"5 cm\"\n", "", {"joint_length", "sample_length"});
    // One fault, not one more for every set that takes it over.
    const std::string said = said_of(tunnel("ks = \"1 GPa/m\"\nfriction = \"30 deg\"\n", "", ""));
    CHECK(said.find("joint_set") == std::string::npos);
  }

  TEST_CASE("docs/input.md has the tables of the laws as the program reads them") {
    const std::string page = read_file(VOUSSOIR_TEST_DATA "/../../docs/input.md");
    const std::string begin = "tests/program/joint_laws_test.cpp -->\n";
    const auto from = page.find(begin);
    REQUIRE(from != std::string::npos);
    const auto to = page.find("<!-- end -->", from);
    CHECK(page.substr(from + begin.size(), to - from - begin.size()) == "\n" + joint_law_page());
  }
}

}  // namespace joint_laws_test
