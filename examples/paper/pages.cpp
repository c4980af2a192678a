// SPDX-License-Identifier: MIT
#include "pages.hpp"

#include <cstddef>
#include <voussoir/drawing/number_text.hpp>

#include "claims.hpp"
#include "report.hpp"
#include "scoreboard.hpp"

namespace voussoir::paper {

namespace {

/// A row of a table in Markdown.
std::string markdown_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) {
    row += ' ';
    for (const char c : cell) {
      if (c == '|' || c == '*' || c == '_') row += '\\';
      row += c;
    }
    row += " |";
  }
  return row + "\n";
}
std::string markdown_table(const std::vector<std::string>& columns,
                           const std::vector<std::vector<std::string>>& rows) {
  std::string table = markdown_row(columns) + "|";
  for (std::size_t k = 0; k < columns.size(); ++k) table += " --- |";
  table += "\n";
  for (const auto& row : rows) table += markdown_row(row);
  return table + "\n";
}

std::string page_of(const Section& section) {
  std::string page = "# " + section.title + "\n\n" + section.source() + ". `paper_" + section.name +
                     "`; what is assumed, and all other analyses: [index](README.md).\n\n";
  for (const std::string& paragraph : section.text) page += paragraph + "\n\n";
  const auto show = [&](const std::string& title, const std::string& name,
                        const std::string& caption) {
    page += "![" + title + "](" + name + ".svg)\n\n";
    if (!caption.empty()) page += "*" + caption + "*\n\n";
  };
  for (const Plot& plot : section.plots) show(plot.title, plot.name, plot.caption);
  for (const Picture& picture : section.pictures)
    show(picture.caption, picture.name, picture.caption);
  for (const Table& table : section.tables)
    page += "**" + table.title + "**\n\n" + markdown_table(table.columns, table.rows);
  if (section.findings.empty()) return page;
  std::vector<std::vector<std::string>> rows;
  for (const Finding& f : section.findings)
    rows.push_back(
        {f.claim, claim_of(f).statement, f.measured, second_column(f), verdict_word(f), cause(f)});
  return page + "## Against the paper\n\n" +
         markdown_table({"claim", "the paper", "measured", "as the paper ran it", "", "cause"},
                        rows);
}

std::string index_of(const std::vector<Section>& sections, const Study& study) {
  const auto found = findings_by_claim(sections);
  const std::vector<Score> board = scores(sections);
  const std::string samples = std::to_string(study.samples());
  std::string page =
      "# The paper, reproduced\n\n"
      "Every analysis of C. W. Boon, G. T. Houlsby and S. Utili, *Designing tunnel support in "
      "jointed rock masses via the DEM*, Rock Mech. Rock Eng. 48, 603-632 (2015), and what became "
      "of 104 of its statements: " +
      std::to_string(board.back().agrees) + " agree, " + std::to_string(board.back().differs) +
      " differ, " + std::to_string(board.back().not_testable) + " cannot be tested, " +
      std::to_string(board.back().restated) +
      " restate what was put in. Realisations of the rock: " + samples + ". " +
      std::to_string(study.tunnels_solved()) + " supported tunnels and " +
      std::to_string(24 * study.samples()) +
      " collapses. This page and those it leads to are written by the last of these commands, the report "
      "and the data behind every plot by the first:\n\n"
      "```sh\n"
      "sudo apt-get install -y gnuplot-nox\n"
      "cmake --workflow --preset release\n"
      "build/release/voussoir paper --samples " +
      samples +
      " --out paper     # paper.html, scoreboard.csv, plots\n"
      "build/release/examples/paper_bolt_spacing                # one analysis by its name\n"
      "build/release/voussoir paper --samples " +
      samples + " --out paper --pages docs/paper\n```\n\n## What is assumed\n\n";
  for (const std::string& line : assumptions()) page += "- " + line + "\n";
  page += "\n## Scoreboard\n\n";
  std::vector<std::vector<std::string>> rows;
  for (const Score& s : board)
    rows.push_back({s.chapter, std::to_string(s.agrees), std::to_string(s.differs),
                    std::to_string(s.not_testable), std::to_string(s.restated)});
  page += markdown_table({"claims", "agrees", "differs", "not testable", "as put in"}, rows);
  page += restated_text() + "\n\n";
  page += second_column_text(sections) + "\n\n## Analyses\n\n";
  for (const Section& s : sections)
    page +=
        "- [" + s.title + "](" + s.name + ".md)" + (s.paper.empty() ? "" : ": " + s.paper) + "\n";
  page += "\n";
  rows.clear();
  std::string open;
  for (const Claim& claim : claims()) {
    const Finding& f = *found.at(claim.id);
    if (f.agreement == Agreement::differs)
      rows.push_back({claim.id, claim.statement, f.measured, second_column(f), cause(f)});
    if (f.agreement == Agreement::not_testable)
      open += std::string("- ") + claim.id + ", \"" + claim.statement + "\": " + cause(f) + "\n";
  }
  page += "## Where it differs, and why\n\n" +
          markdown_table({"claim", "the paper", "measured", "as the paper ran it", "cause"}, rows);
  return page + "## What cannot be tested\n\n" + open;
}

}  // namespace

std::map<std::string, std::string> documentation_pages(const std::vector<Section>& sections,
                                                       const Drawings& drawings,
                                                       const Study& study) {
  std::map<std::string, std::string> files{{"README.md", index_of(sections, study)}};
  for (const Section& section : sections) {
    files[section.name + ".md"] = page_of(section);
    for (const Plot& plot : section.plots) files[plot.name + ".svg"] = drawings.at(plot.name);
    for (const Picture& picture : section.pictures) files[picture.name + ".svg"] = picture.svg;
  }
  return files;
}

}  // namespace voussoir::paper
