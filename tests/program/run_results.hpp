// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "harness.hpp"

namespace voussoir_test {

/// A tunnel of 4 m without supports in two sets of joints that go right through and strike along
/// it, between rollers: one rock in 2-D and 3-D.
struct CircleInRock {
  std::string length = "2 m", K0 = "1", surcharge = "500 kPa", spacing = "0.9 m";
  std::string of_first = "", of_second = "";  ///< what else is said of the joints of a set
  std::string joint = "kn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\nfriction = \"55 deg\"\n";

  [[nodiscard]] std::string text() const {
    const auto set = [&](const char* dip, const char* towards, const std::string& more) {
      return std::string("[[joint_set]]\ndip = \"") + dip + "\"\ndip_direction = \"" + towards +
             "\"\nspacing = \"" + spacing + "\"\n" + more + "\n";
    };
    return "[model]\nlength = \"" + length +
           "\"\nwidth = \"20 m\"\nbelow_invert = \"8 m\"\n[tunnel]\nshape = \"circle\"\n"
           "diameter = \"4 m\"\ncover = \"8 m\"\nfacets = 24\n[rock]\n"
           "density = \"2700 kg/m^3\"\n[stress]\nK0 = " +
           K0 + "\nsurcharge = \"" + surcharge + "\"\n" + set("70 deg", "E", of_first) +
           set("20 deg", "W", of_second) +
           "[blocks]\nmin_inscribed_radius = \"0.2 m\"\nmin_wall_area = \"0 m^2\"\n[boundary]\n"
           "sides = \"rollers\"\nbase = \"rollers\"\n[joint]\n" +
           joint + "\n";
  }
};

/// What `voussoir run` made of an input.
struct Results {
  Outcome outcome;
  nlohmann::json json;                       ///< run.json; null: it was not written
  std::map<std::string, std::string> files;  ///< name -> content
};

/// Runs an input in a folder of its own; it must be readable, and end with a verdict.
/// @param more    arguments behind the file's
/// @param beside  files beside it, by name
inline Results results_of(const std::string& text, const std::vector<std::string>& more = {},
                          const std::map<std::string, std::string>& beside = {}) {
  const Folder folder;
  const std::string out = folder / "out";
  for (const auto& [name, content] : beside) (void)write_file(folder / name, content);
  std::vector<std::string> arguments{"run", write_file(folder / "case.toml", text), "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Results results;
  results.outcome = run_program(arguments);
  INFO(results.outcome.out);
  INFO(results.outcome.err);
  for (const auto& [path, content] : contents(out))
    results.files[std::filesystem::path(path).filename().string()] = content;
  REQUIRE(results.files.contains("run.json"));
  results.json = nlohmann::json::parse(results.files.at("run.json"));
  return results;
}

}  // namespace voussoir_test
