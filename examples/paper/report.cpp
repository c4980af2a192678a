// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <voussoir/core/version.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/xml_text.hpp>

#include "claims.hpp"
#include "scoreboard.hpp"

namespace voussoir::paper {

namespace {

std::string css_class(Agreement agreement) {
  switch (agreement) {
    case Agreement::agrees:
      return "agrees";
    case Agreement::differs:
      return "differs";
    case Agreement::not_testable:
      return "open";
  }
  return "";
}

std::string element(const std::string& tag, const std::string& text) {
  return "<" + tag + ">" + xml_escaped(text) + "</" + tag + ">";
}
std::string verdict_cell(const Finding& f) {
  const std::string word = verdict_word(f);
  return "<td class=\"" + (word == "as put in" ? "open" : css_class(f.agreement)) + "\">" + word +
         "</td>";
}

/// An SVG document as part of a page: without its head, its ids its own.
std::string inlined(std::string svg, const std::string& name) {
  if (const auto start = svg.find("<svg"); start != std::string::npos) svg.erase(0, start);
  const auto prefix = [&](const std::string& before) {
    for (auto at = svg.find(before); at != std::string::npos;
         at = svg.find(before, at + before.size()))
      svg.insert(at + before.size(), name + "-");
  };
  for (const char* before : {"id=\"", "id='", "href=\"#", "href='#", "url(#"}) prefix(before);
  return svg;
}

std::string html_table(const Table& table) {
  std::string html = "<h4>" + xml_escaped(table.title) + "</h4>\n<table><tr>";
  for (const std::string& column : table.columns) html += element("th", column);
  html += "</tr>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (const std::string& cell : row) html += element("td", cell);
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

constexpr const char* style = R"(<style>
body { font: 15px/1.45 Helvetica, Arial, sans-serif; color: #1a1a1a; max-width: 1080px; margin: 2em auto; padding: 0 1.2em; }
h1 { font-size: 1.7em; } h2 { font-size: 1.3em; margin-top: 2.2em; border-top: 2px solid #1d3b53; padding-top: .6em; }
h3 { font-size: 1.1em; } h4 { margin: 1.2em 0 .3em; }
table { border-collapse: collapse; margin: .4em 0 1em; font-size: 13px; }
th, td { border: 1px solid #c8c8c8; padding: .28em .55em; text-align: left; vertical-align: top; }
th { background: #eef2f5; }
.claims td:first-child { white-space: nowrap; }
td.agrees { background: #dff2e1; } td.differs { background: #fbe0d8; } td.open { background: #ececec; }
figure { margin: 1em 0; } figcaption { font-size: 13px; color: #444; max-width: 760px; }
figure svg { max-width: 100%; height: auto; }
.where { color: #555; font-size: 13px; }
@media print { h2 { page-break-before: always; } body { max-width: none; } }
</style>
)";

}  // namespace

const std::vector<std::string>& assumptions() {
  static const std::vector<std::string> all{
      "Rock: mass A, one joint centre per square metre and set (75E, 25E, 25W, standard deviation 1 "
      "degree), joints of 1 m that cut every block they reach, inscribed radius 0.25 m or more, "
      "elongation 5 or less. It has the moduli that the paper measured; its spacing is 0.62 m, not "
      "0.77 m. The paper does not print the length of joints.",
      "Section of 70 m × 60 m, sides and base smooth and fixed after the in-situ state; gravity, "
      "K0 = 1 unless said.",
      "In-situ stress prescribed at the contacts: no generation stage, no friction angle for it.",
      "Contacts integrated exactly over the part that is pressed; blocks are rigid, joints linear "
      "with Coulomb friction and no dilation.",
      "Equilibrium by a search without dynamics (TwoLevel), accepted with an estimated error below "
      "0.1 % of the largest displacement and every block out of balance by less than 1 % of its "
      "weight. Support is wished in place before the rock moves.",
      "A block that has moved by 20 mm is detached and taken out, with its area counted; where a "
      "lining may catch it it is followed to 100 mm, with contact updates every 20 mm. More than a "
      "quarter of the opening's area is a collapse.",
      "Bolts one metre apart along the tunnel, anchors 1.2 diameters from each joint; a lining of 72 "
      "Euler-Bernoulli beams, weightless.",
      "\"As the paper ran it\": explicit stepping with all rock taken out at once, local damping of "
      "0.1 (the paper prints none); blocks are detached at 50 mm. The second column, where the answer "
      "depends on it.",
      "The 24 unsupported tunnels move with their true masses and contact updates "
      "(Dynamics), normal dashpots of 0.3 of critical.",
      "Nothing was tuned to agree. Tolerances were proposed before the toolkit was written and are "
      "not the paper's."};
  return all;
}

std::string report_html(const std::vector<Section>& sections, const Drawings& drawings,
                        const Study& study) {
  const auto found = findings_by_claim(sections);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<title>Boon, Houlsby &amp; Utili (2015), reproduced</title>\n" +
      std::string(style) + "</head><body>\n";
  html += "<h1>Designing tunnel support in jointed rock masses via the DEM, reproduced</h1>\n";
  html +=
      "<p>Every analysis of C. W. Boon, G. T. Houlsby and S. Utili (Rock Mech. Rock Eng. 48, "
      "603-632, 2015), run with Voussoir " VOUSSOIR_VERSION_STRING " on " +
      std::to_string(study.samples()) +
      (study.samples() == 1 ? " random realisation" : " random realisations") +
      " of the rock: " + std::to_string(study.tunnels_solved()) + " supported tunnels and " +
      std::to_string(24 * study.samples()) +
      " collapses. 104 statements of the paper, in our words, are compared with what was measured.</p>\n";
  html += "<h3>What is assumed</h3>\n<ul>\n";
  for (const std::string& line : assumptions()) html += element("li", line) + "\n";
  html +=
      "</ul>\n<h3>Scoreboard</h3>\n<table><tr><th>claims</th><th>agrees</th><th>differs</th>"
      "<th>not testable</th><th>as put in</th></tr>\n";
  for (const Score& s : scores(sections))
    html += "<tr>" + element("td", s.chapter) + "<td class=\"agrees\">" + std::to_string(s.agrees) +
            "</td><td class=\"differs\">" + std::to_string(s.differs) + "</td><td class=\"open\">" +
            std::to_string(s.not_testable) + "</td><td class=\"open\">" +
            std::to_string(s.restated) + "</td></tr>\n";
  html += "</table>\n" + element("p", restated_text()) +
          element("p", second_column_text(sections)) + "\n<h3>Analyses</h3>\n<ol>\n";
  for (const Section& section : sections)
    html += "<li><a href=\"#" + section.name + "\">" + xml_escaped(section.title) +
            "</a> <span class=\"where\">" + xml_escaped(section.paper) + "</span></li>\n";
  html +=
      "</ol>\n<h3>Where it differs</h3>\n<table class=\"claims\"><tr><th>claim</th><th>the paper</th>"
      "<th>measured</th><th>as the paper ran it</th><th>cause</th></tr>\n";
  for (const Claim& claim : claims()) {
    const Finding& f = *found.at(claim.id);
    if (f.agreement != Agreement::differs) continue;
    html += "<tr>" + element("td", claim.id) + element("td", claim.statement) +
            element("td", f.measured) + element("td", second_column(f)) + element("td", cause(f)) +
            "</tr>\n";
  }
  html += "</table>\n";

  for (const Section& section : sections) {
    html += "<h2 id=\"" + section.name + "\">" + xml_escaped(section.title) + "</h2>\n";
    html += "<p class=\"where\">" + xml_escaped(section.source()) + "</p>\n";
    for (const std::string& paragraph : section.text) html += element("p", paragraph) + "\n";
    for (const Plot& plot : section.plots)
      html += "<figure>" + inlined(drawings.at(plot.name), plot.name) +
              element("figcaption", plot.caption) + "</figure>\n";
    for (const Picture& picture : section.pictures)
      html += "<figure>" + inlined(picture.svg, picture.name) +
              element("figcaption", picture.caption) + "</figure>\n";
    for (const Table& table : section.tables) html += html_table(table);
    if (section.findings.empty()) continue;
    html +=
        "<table class=\"claims\"><tr><th>claim</th><th>the paper</th><th>measured</th><th>as the paper ran it"
        "</th><th></th></tr>\n";
    for (const Finding& f : section.findings) {
      html += "<tr>" + element("td", f.claim) + element("td", claim_of(f).statement) +
              element("td", f.measured) + element("td", second_column(f)) + verdict_cell(f) +
              "</tr>\n";
    }
    html += "</table>\n";
  }
  html +=
      "<h2>All claims</h2>\n<table class=\"claims\"><tr><th>claim</th><th>where</th><th>the paper</th>"
      "<th>how it is tested</th><th>measured</th><th>as the paper ran it</th><th></th>"
      "<th>cause</th></tr>\n";
  for (const Claim& claim : claims()) {
    const Finding& f = *found.at(claim.id);
    html += "<tr>" + element("td", claim.id) + element("td", claim.where) +
            element("td", claim.statement) + element("td", claim.test) + element("td", f.measured) +
            element("td", second_column(f)) + verdict_cell(f) + element("td", cause(f)) + "</tr>\n";
  }
  return html + "</table>\n</body></html>\n";
}

}  // namespace voussoir::paper
