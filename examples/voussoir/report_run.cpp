// SPDX-License-Identifier: MIT
// What a report says of a run: picture, blocks that came off, stages.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>
#include <voussoir/io/curve_picture.hpp>

#include "output_parts.hpp"
#include "report_pictures.hpp"
#include "report_sections.hpp"

namespace voussoir::program {

namespace {

using html::Column;
using html::Kind;
using html::Section;
using html::Table;
using html::Tone;

constexpr std::size_t listed_blocks = 40;  ///< that came off

/// A line over the stages for each measured part of the wall.
std::string history_figure(const Json& stages) {
  struct Line {
    const char *key, *name, *colour, *dash;
  };
  constexpr Line lines[] = {{"crown_mm", "crown", "#1f4e79", ""},
                            {"right_springing_mm", "right springing", "#b3541e", "7 3"},
                            {"left_springing_mm", "left springing", "#5b8c3e", "2 3"},
                            {"invert_mm", "invert", "#7a4f9a", "9 3 2 3"}};
  CurvePicture picture;
  picture.header.title = "Convergence over the stages";
  picture.across = "stage";
  picture.up = "convergence [mm]";
  for (const Line& line : lines) {
    Curve curve{.name = line.name, .points = {}, .colour = line.colour, .dash = line.dash};
    for (std::size_t k = 0; k < stages.size(); ++k)
      if (const double value = number_at(stages[k], std::string("/convergence/") + line.key);
          std::isfinite(value))
        curve.points.emplace_back(static_cast<double>(k + 1), value);
    if (!curve.points.empty()) picture.curves.push_back(std::move(curve));
  }
  if (picture.curves.empty()) return "";
  return html::figure(draw_curve_picture(picture), "history-figure",
                      "Convergence of the wall at the end of each stage, positive into the "
                      "opening. The stages are numbered as in the table.");
}

}  // namespace

std::string marginal_sentence(const RunResults& r) {
  if (!r.run.contains("rockfall"))
    return r.detached() > 0 ? "Whether that depends on how it is looked for was not tried." : "";
  const std::string measure = r.is_spatial() ? "volume_m3" : "area_m2";
  if (!holds_at(r.run, "/rockfall/marginal"))
    return "With half and three times the displacement limit, other damping and slower unloading "
           "the same rock comes off.";
  return "What comes off depends on how it is looked for: " +
         shown(number_at(r.run, "/rockfall/least_detached_" + measure)) + " to " +
         shown(number_at(r.run, "/rockfall/most_detached_" + measure)) + " " + r.measure() +
         " with half and three times the displacement limit, other damping and slower unloading" +
         (holds_at(r.run, "/rockfall/another_verdict") ? ", and another verdict." : ".");
}

namespace {

/// "Stage 2, bolts: stable."
std::string stage_words(const Json& stages, std::size_t number) {
  std::string words = "Stage " + std::to_string(number);
  if (number >= 1 && number <= stages.size())
    words += ", " + words_at(stages[number - 1], "/name") + ": " +
             words_at(stages[number - 1], "/equilibrium/verdict");
  return words + ".";
}

/// The stages before the last, as many as a page has room for.
std::string stage_figures(const RunResults& r) {
  constexpr std::size_t room = 3'000'000;  // bytes
  const std::vector<std::string> names = r.files.stage_pictures();
  std::size_t bytes = 0;
  for (const std::string& name : names) bytes += r.files.text(name).size();
  const std::size_t stride = bytes / room + 1;  // those that are left lie evenly
  const Json stages = list_at(r.run, "/stages");
  std::string out;
  for (std::size_t k = 0; k < names.size(); k += stride) {
    const std::size_t from = names[k].find('_') + 1;
    const std::string digits = names[k].substr(from, names[k].find('.') - from);
    if (digits.empty() || digits.size() > 9 ||
        digits.find_first_not_of("0123456789") != std::string::npos)
      continue;  // is called otherwise than we do
    const std::size_t number = std::stoul(digits);
    out += html::figure(r.files.text(names[k]), "stage-" + std::to_string(number) + "-figure",
                        stage_words(stages, number), true);
  }
  return out;
}

std::string caption_of_picture(const RunResults& r) {
  const std::string point = " On screen, point at a part of it for its values.";
  if (r.is_laid())
    return "The blocks where they lie, the forces between them and where these act." + point;
  const bool has_bolts = r.run.contains("bolts"), has_lining = r.run.contains("lining");
  std::string text = r.is_spatial() ? "The tunnel cut open along its axis: blocks by their "
                                      "displacement, joints that have slipped or opened"
                                    : "The rock around the tunnel: blocks by their displacement, "
                                      "joints that have slipped or opened";
  if (has_bolts)
    text += r.is_spatial() ? ", bolts by their forces"
                           : ", bolts with their forces at every joint as bars";
  if (has_lining && r.is_spatial())
    text += ", lining; below it thrust and moment of every rib on the unrolled wall";
  else if (has_lining)
    text += ", lining; beside it its thrust and moment";
  return text + "." + point;
}

}  // namespace

Section picture_section(const RunResults& r) {
  Section section{"picture", "Picture", ""};
  if (!r.files.has("blocks.svg")) return section;
  const std::string last =
      html::figure(r.files.text("blocks.svg"), "blocks-figure", caption_of_picture(r), true);
  const std::string before = stage_figures(r);
  const Json stages = list_at(r.run, "/stages");
  section.body = before.empty() ? last
                                : "<div class=\"stages\" data-last=\"" +
                                      html::escaped(stage_words(stages, stages.size())) + "\">\n" +
                                      last + "<details><summary>The stages before</summary>\n" +
                                      before + "</details>\n</div>\n";
  if (r.files.has("stereonet.svg"))
    section.body += html::figure(r.files.text("stereonet.svg"), "stereonet-figure",
                                 "Joints of the survey: poles, sets and the axis of the tunnel.");
  return section;
}

Section detached_section(const RunResults& r) {
  Section section{"detached", r.is_laid() ? "Fallen blocks" : "Detached blocks", ""};
  if (r.is_laid()) {
    const ReportTable blocks = r.files.table("blocks.csv");
    Table table("Blocks that fell; where their centroids lay",
                {{"block", "", Kind::name}, {"x", "m"}, {"y", "m"}, {"area", "m²"}});
    std::size_t fallen = 0;
    for (std::size_t k = 0; k < blocks.size(); ++k)
      if (blocks.cell(k, "state") == "fallen" && ++fallen <= listed_blocks)
        table.add({std::string(blocks.cell(k, "block")), shown_fixed(blocks.number(k, "x_m"), 2),
                   shown_fixed(blocks.number(k, "y_m"), 2),
                   shown_fixed(blocks.number(k, "area_m2"), 3)});
    section.body = table.empty() ? html::paragraph("No block has fallen.")
                                 : table.text() + left_out(fallen, listed_blocks, "blocks.csv");
    return section;
  }
  const Json all = list_at(r.run, "/detached_blocks");
  if (all.empty()) {
    section.body = html::paragraph("No block came off.");
    return section;
  }
  const std::string size = r.is_spatial() ? "/volume_m3" : "/area_m2",
                    weight = r.is_spatial() ? "/weight_kN" : "/weight_kN_per_m",
                    of_weight = r.is_spatial() ? "kN" : "kN per m";
  std::vector<Json> blocks(all.begin(), all.end());
  std::stable_sort(blocks.begin(), blocks.end(), [&](const Json& a, const Json& b) {
    return number_at(a, size) > number_at(b, size);
  });
  double total = 0;
  for (const Json& block : blocks) total += number_at(block, weight);
  std::vector<Column> columns{{"block"}, {"from", "", Kind::text}, {"x", "m"}, {"y", "m"}};
  if (r.is_spatial()) columns.push_back({"z", "m"});
  columns.insert(columns.end(),
                 {{r.is_spatial() ? "volume" : "area", r.measure()}, {"weight", of_weight}});
  Table table("Blocks that came off, the largest first; where their centroids lay", columns);
  for (std::size_t k = 0; k < std::min(blocks.size(), listed_blocks); ++k) {
    const Json& block = blocks[k];
    std::vector<std::string> cells{shown(number_at(block, "/block")), words_at(block, "/from"),
                                   shown_fixed(number_at(block, "/x_m"), 2),
                                   shown_fixed(number_at(block, "/y_m"), 2)};
    if (r.is_spatial()) cells.push_back(shown_fixed(number_at(block, "/z_m"), 2));
    cells.push_back(shown_fixed(number_at(block, size), 3));
    cells.push_back(shown_fixed(number_at(block, weight), 1));
    table.add(cells);
  }
  section.body =
      html::paragraph(shown_count(blocks.size(), "block") + " came off: " + shown(r.detached()) +
                      " " + r.measure() + ", " + shown(total) + " " + of_weight +
                      (r.is_spatial() ? "." : " of tunnel.")) +
      table.text() + left_out(blocks.size(), listed_blocks, "run.json") +
      html::paragraph(marginal_sentence(r));
  if (r.verdict() == "stable after rockfall")
    section.body += html::paragraph(
        "The rest stands without them. Where nothing may fall, they are to be scaled down or "
        "supported.");
  return section;
}

Section history_section(const RunResults& r) {
  Section section{"history", "Stages and equilibrium", ""};
  const Json stages = list_at(r.run, "/stages");
  if (stages.empty()) return section;
  const double error = number_at(r.run, "/acceptance/error_estimate"),
               ratio = number_at(r.run, "/acceptance/out_of_balance_force_ratio");
  section.body = html::paragraph(
      "A stage is in equilibrium where the estimated error of the displacements is at most " +
      shown_power(error) +
      " of the largest of them, and the worst block is out of balance by at "
      "most " +
      shown_power(ratio) +
      " of its weight, without a block beyond its limit of "
      "displacement.");
  std::vector<Column> columns{{"no."}, {"stage", "", Kind::name}};
  if (!r.is_laid()) columns.push_back({"traction left", "%"});
  columns.insert(columns.end(), {{"error estimate"}, {"out of balance"}, {"largest move", "mm"}});
  if (!r.is_laid())
    for (const char* const place : {"crown", "right", "left", "invert"})
      columns.push_back({place, "mm"});
  columns.push_back({"verdict", "", Kind::text});
  Table table("", columns);
  std::vector<std::string> reasons;
  constexpr std::size_t most = 60;  // laid blocks may be loaded in thousands of steps
  const std::size_t left_out_of_them = stages.size() > most ? stages.size() - most : 0;
  if (left_out_of_them > 0)
    section.body +=
        html::paragraph("The first stage and the last " + std::to_string(most - 1) + " of " +
                        std::to_string(stages.size()) + "; all of them are in run.json.");
  for (std::size_t k = 0; k < stages.size(); ++k) {
    if (k > 0 && k <= left_out_of_them) continue;
    const Json& stage = stages[k];
    const std::string verdict = words_at(stage, "/equilibrium/verdict");
    std::vector<std::string> cells{std::to_string(k + 1), words_at(stage, "/name")};
    if (!r.is_laid()) cells.push_back(shown(100 * number_at(stage, "/residual_wall_traction")));
    cells.insert(cells.end(),
                 {shown_power(number_at(stage, "/equilibrium/error_estimate")),
                  shown_power(number_at(stage, "/equilibrium/out_of_balance_force_ratio")),
                  shown_fixed(number_at(stage, "/equilibrium/largest_displacement_mm"), 2)});
    if (!r.is_laid())
      for (const char* const place :
           {"crown_mm", "right_springing_mm", "left_springing_mm", "invert_mm"})
        cells.push_back(shown_fixed(number_at(stage, std::string("/convergence/") + place), 2));
    cells.push_back(verdict);
    table.add(cells, verdict == "stable"             ? Tone::good
                     : verdict.starts_with("stable") ? Tone::doubtful
                                                     : Tone::bad);
    if (verdict != "stable")
      reasons.push_back("Stage " + std::to_string(k + 1) + ", " + words_at(stage, "/name") + ": " +
                        with_superscripts(words_at(stage, "/equilibrium/reason")) + ".");
  }
  section.body += table.text() + html::list(reasons);
  if (!r.is_laid() && stages.size() > 2) section.body += history_figure(stages);
  return section;
}

}  // namespace voussoir::program
