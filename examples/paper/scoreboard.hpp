// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "claims.hpp"
#include "section.hpp"

/// What became of the paper's claims, for terminal, table, report and pages.
namespace voussoir::paper {

[[nodiscard]] const Claim& claim_of(const Finding& finding);

/// Every claim's finding.
/// @throws std::logic_error  a claim that no section or more than one section decides
[[nodiscard]] std::map<std::string, const Finding*> findings_by_claim(
    const std::vector<Section>& sections);

/// What the paper's own way of running says: "agrees: 0.0222"; empty where it does not matter.
[[nodiscard]] std::string second_column(const Finding& finding);

/// Why the answer is not the paper's; empty where it agrees.
[[nodiscard]] std::string cause(const Finding& finding);

/// How many claims agree, differ and cannot be tested, by chapter; apart from them those that are
/// met because they restate the input (`restates_the_input`).
struct Score {
  std::string chapter;
  int agrees = 0, differs = 0, not_testable = 0, restated = 0;
};
/// The verdict of a finding as a word: "agrees", "as put in", "differs", "not testable".
[[nodiscard]] std::string verdict_word(const Finding& finding);
/// The last entry is the sum of all.
/// @throws std::logic_error  see `findings_by_claim`
[[nodiscard]] std::vector<Score> scores(const std::vector<Section>& sections);
/// What "as put in" means, as a sentence.
[[nodiscard]] std::string restated_text();
/// Of the claims whose answer depends on the solution procedure: what the paper's own way says, as
/// a sentence.
[[nodiscard]] std::string second_column_text(const std::vector<Section>& sections);
/// As a table for the terminal.
[[nodiscard]] std::string score_text(const std::vector<Score>& scores);

/// The scoreboard as a table: one claim a row.
[[nodiscard]] std::string scoreboard_csv(const std::vector<Section>& sections);

}  // namespace voussoir::paper
