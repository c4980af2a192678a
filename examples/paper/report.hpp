// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

/// What all analyses assume, one a line: the first page of the report.
[[nodiscard]] const std::vector<std::string>& assumptions();

/// How many claims agree, differ and cannot be tested, by chapter.
struct Score {
  std::string chapter;
  int agrees = 0, differs = 0, not_testable = 0;
};
/// The last entry is the sum of all.
/// @throws std::logic_error  a claim that no section or more than one section decides
[[nodiscard]] std::vector<Score> scores(const std::vector<Section>& sections);
/// As a table for the terminal.
[[nodiscard]] std::string score_text(const std::vector<Score>& scores);

/// The scoreboard as a table: one claim a row.
[[nodiscard]] std::string scoreboard_csv(const std::vector<Section>& sections);

/// One page that needs no other file.
/// @param drawings  of the plots of all sections, in their order (see `drawn`)
[[nodiscard]] std::string report_html(const std::vector<Section>& sections,
                                      const std::vector<std::string>& drawings, const Study& study,
                                      double seconds);

/// One analysis as a page of documentation, beside the pictures of its plots (NAME.svg).
/// @param command  that made it
[[nodiscard]] std::string page_markdown(const Section& section, const std::string& command);

}  // namespace voussoir::paper
