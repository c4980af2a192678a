// SPDX-License-Identifier: MIT
// The head of a report: the verdict in one sentence, and its three numbers.
#include <cmath>
#include <limits>
#include <voussoir/drawing/number_text.hpp>

#include "output_parts.hpp"
#include "report_sections.hpp"

namespace voussoir::program {

namespace {

using html::Card;
using html::Tone;

struct Wall {
  const char *key, *name;
};
constexpr Wall walls[] = {{"crown_mm", "crown"},
                          {"right_springing_mm", "right springing"},
                          {"left_springing_mm", "left springing"},
                          {"invert_mm", "invert"}};

std::string capitalised(std::string sentence) {
  if (!sentence.empty() && sentence[0] >= 'a' && sentence[0] <= 'z')
    sentence[0] = static_cast<char>(sentence[0] - 'a' + 'A');
  return sentence;
}

/// A verdict in words, and how it is meant.
struct Word {
  Tone tone;
  std::string text;
};

Word word_of(const RunResults& r) {
  const std::string verdict = r.verdict();
  if (r.is_laid()) {
    if (verdict == "stands") return {Tone::good, "The blocks stand"};
    if (verdict == "falls") return {Tone::bad, "The blocks fall"};
    if (verdict == "part of it falls") return {Tone::bad, "A part of the blocks falls"};
    return {Tone::doubtful, "Undecided: no equilibrium was found"};
  }
  if (verdict == "collapse") return {Tone::bad, "The tunnel collapses"};
  if (verdict == "stable without its lining")
    return {Tone::doubtful, "The tunnel stands without its lining, which came off"};
  if (verdict == "undecided") return {Tone::doubtful, "Undecided: no equilibrium was found"};
  const auto is_over = [&](const char* pointer) { return number_at(r.run, pointer) > 1; };
  const bool lining_fails = r.run.contains("lining") && r.run["lining"].is_object() &&
                            r.run["lining"].contains("bears_it") &&
                            !holds_at(r.run, "/lining/bears_it");
  const bool is_exceeded = lining_fails || is_over("/bolts/of_its_strength");
  const std::string exceeded = " a support carries more than it bears";
  if (verdict == "stable after rockfall") {
    const std::string stands = "The tunnel stands after rockfall";
    return is_exceeded ? Word{Tone::bad, stands + ", and" + exceeded}
                       : Word{Tone::doubtful, stands};
  }
  if (is_exceeded) return {Tone::bad, "The tunnel stands, but" + exceeded};
  if (verdict == "stable") return {Tone::good, "The tunnel stands"};
  return {Tone::plain, "Verdict: " + verdict};
}

Card convergence_card(const Json& run, std::string& sentence) {
  const LargestConvergence most = largest_convergence(run);
  const double width = number_at(run, "/tunnel/width_m");
  Card card{"Largest convergence", shown_fixed(most.millimetres, 2), "mm", most.place};
  if (!std::isfinite(most.millimetres)) {
    card.unit.clear();
    card.remark = "no wall is left to be measured";
    sentence = "no wall is left whose convergence could be measured";
    return card;
  }
  const std::string part = shown_percent(1e-3 * most.millimetres / width);
  card.remark += ", " + part + " of the width of " + shown(width) + "\u00a0m";
  sentence = "the wall comes in by " + card.value + "\u00a0mm at most (" + most.place + ", " +
             part + " of the width)";
  return card;
}

Card bolts_card(const Json& run, std::string& sentence) {
  const double force = number_at(run, "/bolts/largest_force_kN"),
               use = number_at(run, "/bolts/of_its_strength");
  if (!run.contains("bolts")) {
    sentence = run.contains("lining") ? "there are no bolts" : "it has no supports";
    return {"Largest bolt force", "–", "", "no bolts"};
  }
  Card card{"Largest bolt force", shown(force), "kN", ""};
  if (std::isfinite(use)) {
    card.remark = shown_percent(use) + " of the strength of " + words_at(run, "/bolts/strength");
    card.tone = use > 1 ? Tone::bad : use >= 0.999 ? Tone::doubtful : Tone::good;
    sentence = "the most loaded bolt carries " + card.value + "\u00a0kN, " + shown_percent(use) +
               " of its strength";
  } else {
    card.remark = "not checked: no strength was given";
    card.tone = Tone::doubtful;
    sentence = "the most loaded bolt carries " + card.value + "\u00a0kN";
  }
  return card;
}

Card lining_card(const Json& run, std::string& sentence) {
  const double use = number_at(run, "/lining/of_its_strength"),
               thrust = number_at(run, "/lining/largest_thrust_kN_per_m");
  if (!run.contains("lining")) {
    if (run.contains("bolts")) sentence = "there is no lining";
    return {"Largest utilisation of the lining", "–", "", "no lining"};
  }
  const std::string place = words_at(run, "/lining/governing/place"),
                    mode = words_at(run, "/lining/governing/mode");
  if (!place.empty() && !std::isfinite(use)) {  // more than any multiple of its strength
    sentence = "the lining is beyond its strength at the " + place;
    return {"Largest utilisation of the lining", "beyond", "", place + ", " + mode, Tone::bad};
  }
  if (std::isfinite(use)) {
    sentence = "the lining has " + shown_percent(use) + " of its strength at the " + place + " (" +
               mode + ")";
    return {"Largest utilisation of the lining", shown(100 * use, 2), "%", place + ", " + mode,
            use > 1 ? Tone::bad : Tone::good};
  }
  sentence = "the thrust in the lining is up to " + shown(thrust) +
             "\u00a0kN/m; its strength was not given, and is not checked";
  return {"Largest utilisation of the lining", "–", "",
          "not checked: no strength was given; thrust up to " + shown(thrust) + "\u00a0kN/m",
          Tone::doubtful};
}

void add_tunnel_head(const RunResults& r, html::Page& page) {
  std::string convergence, bolts, lining;
  page.cards = {convergence_card(r.run, convergence), bolts_card(r.run, bolts),
                lining_card(r.run, lining)};
  std::string before;
  const Json stages = list_at(r.run, "/stages");
  const std::string reason =
      stages.empty() ? "" : with_superscripts(words_at(stages.back(), "/equilibrium/reason"));
  if (r.verdict() == "collapse" || r.verdict() == "undecided")
    before = reason + ". Where the run ended: ";
  if (r.detached() > 0) {
    const std::string rock = shown(r.detached()) + "\u00a0" + r.measure() +
                             " of rock came off in " +
                             shown_count(list_at(r.run, "/detached_blocks").size(), "block");
    before += before.empty() ? rock + " before the rest came to rest; " : rock + "; ";
  }
  page.sentence = before + convergence + "; " + bolts + (lining.empty() ? "" : "; " + lining) + ".";
  page.sentence = capitalised(page.sentence);
}

void add_laid_head(const RunResults& r, html::Page& page) {
  const double part = number_at(r.run, "/stands_up_to_part_of_loading"),
               blocks = number_at(r.run, "/blocks/count");
  const std::size_t fallen = list_at(r.run, "/fallen_blocks").size();
  page.sentence = capitalised(with_superscripts(words_at(r.run, "/reason"))) + ".";
  page.cards.push_back(
      {"Blocks", shown(blocks), "", shown(number_at(r.run, "/blocks/fixed")) + " of them fixed"});
  page.cards.push_back({"Fallen", std::to_string(fallen), "",
                        shown(number_at(r.run, "/fallen_area_m2")) + "\u00a0m²",
                        fallen > 0 ? Tone::bad : Tone::good});
  if (std::isfinite(part))
    page.cards.push_back({"Stands up to", shown(100 * part), "%", "of its loading",
                          part < 1 ? Tone::doubtful : Tone::good});
}

}  // namespace

LargestConvergence largest_convergence(const Json& run) {
  LargestConvergence most{std::numeric_limits<double>::quiet_NaN(), ""};
  for (const Wall& wall : walls) {
    const double value = number_at(run, std::string("/convergence/") + wall.key);
    if (std::isfinite(value) && !(value <= most.millimetres)) most = {value, wall.name};
  }
  return most;
}

html::Page run_head(const RunResults& r) {
  html::Page page;
  const std::string title = words_at(r.run, "/title");
  page.title = !title.empty() ? title : r.is_laid() ? "Blocks" : "Tunnel in jointed rock";
  const double blocks = number_at(r.run, r.is_laid() ? "/blocks/count" : "/rock/bodies");
  page.subtitle = std::string(r.is_laid()      ? "Laid blocks in 2-D, "
                              : r.is_spatial() ? "Tunnel in 3-D, "
                                               : "Section of a tunnel in 2-D, ") +
                  shown(blocks) + " blocks";
  if (const std::string file = words_at(r.run, "/input/file"); !file.empty())
    page.subtitle += " · " + file;
  const Word word = word_of(r);
  page.tone = word.tone;
  page.word = word.text;
  if (r.is_laid())
    add_laid_head(r, page);
  else
    add_tunnel_head(r, page);
  return page;
}

}  // namespace voussoir::program
