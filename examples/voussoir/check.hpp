// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis.hpp"

/// What can be known of an input before equilibrium is sought: `voussoir check`.
namespace voussoir::program {

/// The rock of an input and its supports in it, nothing moved.
struct CheckedModel {
  RockInSitu rock;
  std::optional<Tunnel> section = {};  ///< 2-D: all of it excavated, with its bolts
  int bolts = 0;                       ///< that are installed
  int joints_crossed = 0;              ///< by all of them
  double seconds = 0;                  ///< that it took
  std::vector<std::string> warnings = {};
};

/// What a run is expected to take, by what others took (docs/performance.md): one processor at
/// 2.6 GHz of an optimised build, within a factor of two or three.
struct ExpectedCost {
  double memory;          ///< [bytes]
  double standing_stage;  ///< a stage in which all rock stands [s]
  double falling_stage;   ///< one in which some comes off, and is followed in motion [s]
};
[[nodiscard]] ExpectedCost expected_cost(int dimension, std::size_t blocks);

/// @throws as `run_of`, but for what only a search finds
/// @pre  the input has a tunnel
[[nodiscard]] CheckedModel checked_model(const Input& input, const Report& report);

/// For a terminal, in the units of an engineer.
[[nodiscard]] std::string check_text(const Input& input, const CheckedModel& model);
/// For a program.
[[nodiscard]] std::string check_json(const Input& input, const CheckedModel& model);
/// The rock with its joints, and in 2-D the bolts and the limits of the rounds.
[[nodiscard]] std::string check_svg(const Input& input, const CheckedModel& model);

}  // namespace voussoir::program
