// SPDX-License-Identifier: MIT
#include "scoreboard.hpp"

#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <voussoir/io/csv_table.hpp>

namespace voussoir::paper {

namespace {

void count(Score& score, Agreement agreement, bool restates = false) {
  score.agrees += agreement == Agreement::agrees && !restates;
  score.restated += agreement == Agreement::agrees && restates;
  score.differs += agreement == Agreement::differs;
  score.not_testable += agreement == Agreement::not_testable;
}

}  // namespace

const Claim& claim_of(const Finding& finding) {
  return claims()[static_cast<std::size_t>(std::stoi(finding.claim.substr(3)) - 1)];
}

std::map<std::string, const Finding*> findings_by_claim(const std::vector<Section>& sections) {
  std::map<std::string, const Finding*> found;
  for (const Section& section : sections)
    for (const Finding& finding : section.findings)
      if (!found.emplace(finding.claim, &finding).second)
        throw std::logic_error("claim " + finding.claim + " is decided twice");
  for (const Claim& claim : claims())
    if (!found.contains(claim.id))
      throw std::logic_error(std::string("claim ") + claim.id + " is not decided");
  return found;
}

std::string verdict_word(const Finding& f) {
  const bool restated = f.agreement == Agreement::agrees && restates_the_input(claim_of(f));
  return restated ? "as put in" : to_string(f.agreement);
}

std::string second_column(const Finding& f) {
  if (!f.agreement_as_the_paper) return f.as_the_paper;
  return std::string(to_string(*f.agreement_as_the_paper)) + ": " + f.as_the_paper;
}

std::string cause(const Finding& f) {
  if (f.agreement == Agreement::agrees) return "";
  return f.why.empty()
             ? "The cause has not been looked into; on the realisations of docs/paper the claim "
               "holds."
             : f.why;
}

std::vector<Score> scores(const std::vector<Section>& sections) {
  const auto found = findings_by_claim(sections);
  std::vector<Score> result;
  Score all{"all"};
  for (const ClaimChapter& chapter : claim_chapters()) {
    Score score{chapter.title};
    for (int k = chapter.first; k <= chapter.last; ++k) {
      const Claim& claim = claims()[static_cast<std::size_t>(k - 1)];
      const Agreement a = found.at(claim.id)->agreement;
      count(score, a, restates_the_input(claim));
      count(all, a, restates_the_input(claim));
    }
    result.push_back(score);
  }
  result.push_back(all);
  return result;
}

std::string restated_text() {
  return "As put in: statements of what the paper has put in or how it went about it. A program that "
         "does the same cannot differ but by a fault, so they are no evidence and are not counted "
         "among those that agree.";
}

std::string second_column_text(const std::vector<Section>& sections) {
  Score ours, theirs;
  for (const Section& section : sections)
    for (const Finding& f : section.findings)
      if (f.agreement_as_the_paper) {
        count(ours, f.agreement);
        count(theirs, *f.agreement_as_the_paper);
      }
  return std::to_string(ours.agrees + ours.differs + ours.not_testable) +
         " of the claims depend on the solution procedure. Quasi-statically " +
         std::to_string(ours.agrees) + " of these agree and " + std::to_string(ours.differs) +
         " differ; as the paper ran it " + std::to_string(theirs.agrees) + " agree, " +
         std::to_string(theirs.differs) + " differ, and " + std::to_string(theirs.not_testable) +
         " have no answer because tunnels collapse.";
}

std::string score_text(const std::vector<Score>& scores) {
  std::string text;
  char line[160];
  std::snprintf(line, sizeof line, "%-36s %7s %8s %13s %10s\n", "claims", "agrees", "differs",
                "not testable", "as put in");
  text += line;
  for (const Score& s : scores) {
    std::snprintf(line, sizeof line, "%-36s %7d %8d %13d %10d\n", s.chapter.c_str(), s.agrees,
                  s.differs, s.not_testable, s.restated);
    text += line;
  }
  return text;
}

std::string scoreboard_csv(const std::vector<Section>& sections) {
  const auto found = findings_by_claim(sections);
  CsvTable table({"claim", "where", "kind", "statement", "test", "verdict", "measured",
                  "as_the_paper_ran_it", "why"});
  for (const Claim& claim : claims()) {
    const Finding& f = *found.at(claim.id);
    table.add_row(std::string(claim.id), std::string(claim.where),
                  std::string(to_string(claim.kind)), std::string(claim.statement),
                  std::string(claim.test), verdict_word(f), f.measured, second_column(f), cause(f));
  }
  return table.text();
}

}  // namespace voussoir::paper
