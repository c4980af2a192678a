// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "design_case.hpp"
#include "patterns.hpp"

/// What the analyses compute of one realisation of the rock, as it stands in a journal.
namespace voussoir::paper {

/// Where finished cases are kept. Both are called from several threads.
struct CaseStore {
  /// The result of a case; nothing if it is not finished.
  std::function<std::optional<std::string>(const std::string& what)> find;
  std::function<void(const std::string& what, const std::string& result)> add;
};

/// Everything that decides an outcome, in words.
[[nodiscard]] std::string case_text(const Variant& variant, std::uint64_t seed);
[[nodiscard]] std::string case_text(const program::PatternCase& the_case, std::uint64_t seed,
                                    const program::PatternOptions& options);

/// To JSON, and back: equal to the last bit in all that an analysis reads.
[[nodiscard]] std::string outcome_json(const Outcome& outcome);
/// @throws std::runtime_error  no outcome
[[nodiscard]] Outcome outcome_from_json(const std::string& text);
[[nodiscard]] std::string pattern_json(const program::PatternResult& result);
/// @throws std::runtime_error  no collapse
[[nodiscard]] program::PatternResult pattern_from_json(const std::string& text);

}  // namespace voussoir::paper
