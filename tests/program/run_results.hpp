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
