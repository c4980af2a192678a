// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>
#include <voussoir/bolt/bolt_curve.hpp>

#include "input.hpp"

/// The pull-out test of the bolts of an input, on paper: `voussoir pullout`.
namespace voussoir::program {

/// Something that gives, or is lost, on the way.
struct PullOutEvent {
  std::string what;     ///< "bond begins to slip", "the bar yields", "the bolt is lost", ...
  double displacement;  ///< of the head against the rock [m]
  double force;         ///< [N]
};

/// One test: a bolt of a pattern, pulled at its head.
struct PullOutTest {
  std::string pattern;
  bool is_bonded = true;  ///< over `length`; else it is held by its anchor, so far away
  double length = 0;      ///< [m]
  double stiffness = 0;   ///< of the head, while all is elastic [N/m]
  std::vector<PullOutEvent> events;
  BoltCurve curve;   ///< ends beyond the last event
  double shown = 0;  ///< of it [m]
  /// Bonded: the length on which the bar yields or breaks before all of its bond slips [m]; none:
  /// nothing says what the bar bears.
  std::optional<double> enough = {};
};

struct PullOutTests {
  std::vector<PullOutTest> tests;
  std::vector<std::string> warnings;
};

/// Of every pattern that is given by its bar: bonded ones over each of `lengths` or, without any,
/// over the whole bolt; end-anchored ones over the whole bolt.
/// @param lengths  bonded [m], > 0
/// @throws InvalidInput  no pattern is
[[nodiscard]] PullOutTests pull_out_tests(const Input& input, const std::vector<double>& lengths);

[[nodiscard]] std::string pull_out_text(const PullOutTests& all);
[[nodiscard]] std::string pull_out_csv(const PullOutTests& all);
[[nodiscard]] std::string pull_out_json(const PullOutTests& all);
[[nodiscard]] std::string pull_out_svg(const Input& input, const PullOutTests& all);

}  // namespace voussoir::program
