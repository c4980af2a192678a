// SPDX-License-Identifier: MIT
// What a report says of where its numbers come from: what the verdict rests on, inputs, checks,
// limits, how to compute it again.
#include <algorithm>
#include <cmath>
#include <vector>

#include "input_page.hpp"
#include "output_parts.hpp"
#include "report_sections.hpp"

namespace voussoir::program {

namespace {

using html::Column;
using html::Kind;
using html::Section;
using html::Table;
using html::Tone;

/// What the page of inputs says of a word such as a verdict; empty: nothing.
std::string meaning_of(const std::string& word, const char* column) {
  for (const PageRow& row : page_rows())
    if (std::find(row.names.begin(), row.names.end(), word) != row.names.end())
      if (const std::string cell = row.cell(column); !cell.empty()) return plain_cell(cell);
  return "";
}

/// Joints by their source with what is known of their law, a column for every parameter.
std::string joints_table(const Json& run) {
  const Json sources = list_at(run, "/rock/joints_by_source");
  if (sources.empty()) return "";
  struct Quantity {
    const char *key, *name, *unit;
    double scale;
  };
  constexpr Quantity quantities[] = {{"kn_Pa_per_m", "normal stiffness", "GPa/m", 1e-9},
                                     {"ks_Pa_per_m", "shear stiffness", "GPa/m", 1e-9},
                                     {"friction_deg", "friction", "°", 1},
                                     {"cohesion_Pa", "cohesion", "kPa", 1e-3},
                                     {"tensile_strength_Pa", "tensile strength", "kPa", 1e-3},
                                     {"dilation_deg", "dilation", "°", 1}};
  std::vector<Quantity> there;
  for (const Quantity& quantity : quantities)
    if (std::any_of(sources.begin(), sources.end(), [&](const Json& source) {
          return std::isfinite(number_at(source, std::string("/") + quantity.key));
        }))
      there.push_back(quantity);
  std::vector<Column> columns{
      {"joints", "", Kind::text}, {"law", "", Kind::text}, {"asked"}, {"used"}, {"no room"}};
  for (const Quantity& quantity : there) columns.push_back({quantity.name, quantity.unit});
  Table table("Joints, by where they come from", columns);
  for (const Json& source : sources) {
    std::vector<std::string> cells{
        words_at(source, "/source"), words_at(source, "/law"), shown(number_at(source, "/asked")),
        shown(number_at(source, "/used")), shown(number_at(source, "/refused"))};
    for (const Quantity& quantity : there)
      cells.push_back(
          shown_given(quantity.scale * number_at(source, std::string("/") + quantity.key)));
    table.add(cells);
  }
  return table.text();
}

std::string boundary_sentence(const Json& run) {
  if (const std::string words = words_at(run, "/boundary"); !words.empty())
    return "Boundary: " + words + ".";
  if (!run.contains("boundary") || !run["boundary"].is_object()) return "";
  std::string text = "Boundary: " + words_at(run, "/boundary/sides") + " at the sides, " +
                     words_at(run, "/boundary/base") + " at the base, " +
                     words_at(run, "/boundary/top") + " on top, " +
                     (holds_at(run, "/boundary/chosen_by_the_program") ? "chosen by the program"
                                                                       : "as the input says");
  const double upright = number_at(run, "/boundary/bias_of_closure/upright"),
               across = number_at(run, "/boundary/bias_of_closure/across");
  if (std::isfinite(upright))
    text += "; against ground that goes on, rollers would change the elastic closure by " +
            shown_percent(upright) + " in height and " + shown_percent(across) + " in width";
  return text + ".";
}

/// The key of an override, "joint.friction=30 deg"; without the "!" that takes one away.
std::string overridden_key(const std::string& text) {
  std::string key = text.substr(text.starts_with("!") ? 1 : 0, text.find('='));
  while (!key.empty() && key.back() == ' ') key.pop_back();
  return key;
}

/// "joint_set[].dip" for "joint_set[0].dip".
std::string key_of_page(std::string key) {
  for (std::size_t at = 0; (at = key.find('[', at)) != std::string::npos; ++at)
    key.erase(at + 1, key.find(']', at) - at - 1);
  return key;
}

/// A key of the input with its value, of a list all of them.
struct InputRow {
  std::string table, name;  ///< "joint_set[0]", "dip"
  std::vector<std::string> values;
  bool is_set = false;  ///< on the command line

  [[nodiscard]] std::string key() const { return table.empty() ? name : table + "." + name; }
  [[nodiscard]] std::string text() const {
    constexpr std::size_t most = 16;
    std::string all;
    for (std::size_t k = 0; k < std::min(values.size(), most); ++k)
      all += (k > 0 ? ", " : "") + values[k];
    if (values.size() > most) all += ", … (" + std::to_string(values.size()) + " values)";
    return all + (is_set ? "  (set on the command line)" : "");
  }
};

/// Tables as they follow one another in an input file.
std::size_t rank_of_table(const std::string& table) {
  constexpr std::string_view order[] = {
      "model",    "tunnel",    "opening", "block", "blocks",  "rock",   "stress",  "gravity",
      "boundary", "joint_set", "joints",  "joint", "support", "load",   "seismic", "displacement",
      "loading",  "stage",     "round",   "run",   "picture", "diagram"};
  const std::string_view first = std::string_view(table).substr(0, table.find_first_of(".["));
  return static_cast<std::size_t>(std::find(std::begin(order), std::end(order), first) -
                                  std::begin(order));
}

/// Whether a key comes from what was set: of a list any of its places.
bool is_of(const std::string& key, const std::string& overridden) {
  return key.starts_with(overridden) &&
         (key.size() == overridden.size() || key[overridden.size()] == '[' ||
          key[overridden.size()] == '.');
}

/// @param keys  of run.json: every key with its value, lists place by place
std::vector<InputRow> input_rows(const Json& keys, const std::vector<std::string>& overridden) {
  // Places of a list by their numbers, not by their digits: 10 stands behind 9.
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [key, value] : keys.items())
    if (value.is_string() && key != "schema" && key != "title")
      all.emplace_back(key, value.get<std::string>());
  const auto padded = [](const std::string& key) {
    std::string text;
    for (std::size_t k = 0; k < key.size(); ++k) {
      text += key[k];
      if (key[k] == '[') text.append(8 - std::min<std::size_t>(8, key.find(']', k) - k), '0');
    }
    return text;
  };
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) {
    const std::size_t x = rank_of_table(a.first), y = rank_of_table(b.first);
    return x != y ? x < y : padded(a.first) < padded(b.first);
  });
  std::vector<InputRow> rows;
  for (const auto& [key, value] : all) {
    std::string name = key;
    while (name.ends_with("]")) name.resize(name.rfind('['));
    const std::size_t dot = name.rfind('.');
    InputRow row{dot == std::string::npos ? "" : name.substr(0, dot),
                 dot == std::string::npos ? name : name.substr(dot + 1),
                 {value}};
    for (const std::string& set : overridden) row.is_set = row.is_set || is_of(key, set);
    if (!rows.empty() && rows.back().key() == row.key()) {
      rows.back().values.push_back(value);
      rows.back().is_set = rows.back().is_set || row.is_set;
    } else {
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

/// One number against its limit.
struct Check {
  std::string what, value, limit;
  Tone tone;
};
const char* word_of(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "passed";
    case Tone::bad:
      return "failed";
    case Tone::doubtful:
      return "to be judged";
    case Tone::plain:
      break;
  }
  return "not checked";
}

Tone tone_of(double value, double limit) {
  if (!std::isfinite(value)) return Tone::plain;
  return std::abs(value) <= limit ? Tone::good : Tone::bad;
}

/// Equilibrium of every stage, the worst of them in one row each.
void add_equilibrium(const RunResults& r, std::vector<Check>& checks) {
  const Json stages = list_at(r.run, "/stages");
  const auto worst = [&](const char* pointer) {
    double most = NAN;
    for (const Json& stage : stages)
      if (const double value = number_at(stage, pointer); !(value <= most)) most = value;
    return most;
  };
  const double error = worst("/equilibrium/error_estimate"),
               ratio = worst("/equilibrium/out_of_balance_force_ratio"),
               error_limit = number_at(r.run, "/acceptance/error_estimate"),
               ratio_limit = number_at(r.run, "/acceptance/out_of_balance_force_ratio"),
               in_situ = number_at(r.run, "/rock/in_situ_out_of_balance_force_ratio");
  if (!r.is_laid())
    checks.push_back({"rock before excavation in equilibrium, worst block", shown_power(in_situ),
                      "≤ " + shown_power(ratio_limit), tone_of(in_situ, ratio_limit)});
  checks.push_back({"error estimate of the displacements, worst stage", shown_power(error),
                    "≤ " + shown_power(error_limit), tone_of(error, error_limit)});
  checks.push_back({"out-of-balance force over weight, worst block and stage", shown_power(ratio),
                    "≤ " + shown_power(ratio_limit), tone_of(ratio, ratio_limit)});
  if (r.is_laid() || stages.empty()) return;
  const double left = number_at(stages.back(), "/residual_wall_traction"),
               asked = number_at(stages.back(), "/residual_wall_traction_asked");
  checks.push_back({"wall unloaded as far as asked for, traction left", shown_percent(left),
                    shown_percent(asked), left <= asked + 1e-9 ? Tone::good : Tone::bad});
}

void add_supports(const RunResults& r, std::vector<Check>& checks) {
  const auto add = [&](const std::string& what, double use) {
    checks.push_back({what, std::isfinite(use) ? shown_percent(use) : "no strength given",
                      "≤ 100\u00a0%", tone_of(use, 1)});
  };
  if (r.run.contains("bolts"))
    add("bolts, tension over strength", number_at(r.run, "/bolts/of_its_strength"));
  if (!r.run.contains("lining")) return;
  const double use = number_at(r.run, "/lining/of_its_strength");
  if (!words_at(r.run, "/lining/governing/place").empty() && !std::isfinite(use))
    checks.push_back(
        {"lining, thrust and moment over strength", "beyond", "≤ 100\u00a0%", Tone::bad});
  else
    add("lining, thrust and moment over strength", use);
  for (const Json& foot : list_at(r.run, "/lining/feet"))
    add("foot of the lining at x " + shown_fixed(number_at(foot, "/x_m"), 2) + " m",
        number_at(foot, "/of_its_strength"));
}

void add_rock(const RunResults& r, std::vector<Check>& checks) {
  const double detached = r.detached();
  if (std::isfinite(detached))
    checks.push_back({"rock that came off", shown(detached) + " " + r.measure(), "none",
                      r.verdict() == "collapse" ? Tone::bad
                      : detached > 0            ? Tone::doubtful
                                                : Tone::good});
  if (r.run.contains("rockfall"))
    checks.push_back({"detached rock by other ways of looking for it",
                      holds_at(r.run, "/rockfall/marginal") ? "differs" : "agrees", "agrees",
                      holds_at(r.run, "/rockfall/marginal") ? Tone::doubtful : Tone::good});
  const double upright = number_at(r.run, "/boundary/bias_of_closure/upright"),
               across = number_at(r.run, "/boundary/bias_of_closure/across");
  if (std::isfinite(upright)) {
    const bool is_elastic = words_at(r.run, "/boundary/sides") == "elastic" ||
                            words_at(r.run, "/boundary/base") == "elastic";
    const double bias = std::max(std::abs(upright), std::abs(across));
    checks.push_back(
        {"rollers at the boundary, change of the elastic closure",
         is_elastic ? shown_percent(bias) + ", elastic ground taken instead" : shown_percent(bias),
         "≤ 2\u00a0%", is_elastic || bias <= 0.02 ? Tone::good : Tone::doubtful});
  }
}

}  // namespace

Section basis_section(const RunResults& r) {
  Section section{"basis", "What the verdict rests on", ""};
  const Json& run = r.run;
  const std::string verdict = r.verdict();
  std::vector<std::string> sentences;
  if (const std::string meaning = meaning_of(verdict, "meaning"); !meaning.empty())
    sentences.push_back("Verdict “" + verdict + "”: " + meaning + ".");
  const Json stages = list_at(run, "/stages");
  if (!stages.empty())
    sentences.push_back(
        "Reason: " + with_superscripts(words_at(stages.back(), "/equilibrium/reason")) + ".");
  if (const std::string marginal = marginal_sentence(r); !marginal.empty())
    sentences.push_back(marginal);
  if (!r.is_laid()) {
    sentences.push_back(
        "Rock: " + shown(number_at(run, "/rock/bodies")) + " blocks and " +
        shown(number_at(run, "/rock/contacts")) + " contacts, cut by " +
        shown(number_at(run, "/rock/joints")) + " joints; one realisation of the joints, seed " +
        shown(number_at(run, "/seed")) + ". Another realisation gives other numbers.");
    sentences.push_back("In-situ vertical stress at the centre of the tunnel: " +
                        shown(number_at(run, "/rock/vertical_stress_at_centre_kPa")) + " kPa.");
    if (const std::string boundary = boundary_sentence(run); !boundary.empty())
      sentences.push_back(boundary);
    for (const std::string& load : load_sentences(list_at(run, "/loads")))
      sentences.push_back("Load on a block: " + load + ".");
  }
  sentences.push_back("Models: " + words_at(run, "/models") + ".");
  for (const char* const place : {"/rock/joints_read"})
    if (const std::string words = words_at(run, place); !words.empty())
      sentences.push_back("Traces: " + words + ".");
  for (const Json& line : list_at(run, "/rock/joints_in_section"))
    if (line.is_string()) sentences.push_back("In the section: " + line.get<std::string>() + ".");
  section.body = html::list(sentences) + joints_table(run);
  return section;
}

Section inputs_section(const RunResults& r) {
  Section section{"inputs", "Inputs", ""};
  if (!r.run.contains("input") || !r.run["input"].is_object() || !r.run["input"].contains("keys") ||
      !r.run["input"]["keys"].is_object())
    return section;
  std::vector<std::string> overrides;
  for (const Json& text : list_at(r.run, "/input/overrides"))
    if (text.is_string()) overrides.push_back(overridden_key(text.get<std::string>()));
  Table table("",
              {{"key", "", Kind::name}, {"value", "", Kind::text}, {"meaning", "", Kind::text}});
  std::string heading;
  for (const InputRow& input : input_rows(r.run["input"]["keys"], overrides)) {
    if (input.table != heading) table.add_heading(input.table);
    heading = input.table;
    const auto row = page_row_of(key_of_page(input.key()));
    const std::string meaning = row ? plain_cell(row->cell("meaning")) : "";
    table.add({input.name, input.text(), meaning.substr(0, meaning.find(". "))});
  }
  Table files("Files it names",
              {{"key", "", Kind::text}, {"file", "", Kind::text}, {"hash", "", Kind::text}});
  for (const Json& file : list_at(r.run, "/input/other_files"))
    files.add({words_at(file, "/key"), words_at(file, "/name"), words_at(file, "/hash")});
  section.body =
      html::paragraph("As they were read from " + words_at(r.run, "/input/file") +
                      (overrides.empty() ? "" : ", with what was set on the command line") +
                      "; keys that are left out have their default.") +
      table.text() + files.text();
  return section;
}

Section checks_section(const RunResults& r) {
  Section section{"checks", "Checks", ""};
  std::vector<Check> checks;
  add_equilibrium(r, checks);
  add_supports(r, checks);
  add_rock(r, checks);
  Table table("", {{"check", "", Kind::text}, {"value"}, {"limit"}, {"result", "", Kind::text}});
  for (const Check& check : checks)
    table.add({check.what, check.value, check.limit, word_of(check.tone)},
              check.tone == Tone::plain ? Tone::doubtful : check.tone);
  std::vector<std::string> warnings;
  for (const Json& warning : list_at(r.run, "/warnings"))
    if (warning.is_string()) warnings.push_back(with_superscripts(warning.get<std::string>()));
  section.body = table.text();
  section.body += "<h3>Warnings of the run</h3>\n" +
                  (warnings.empty() ? html::paragraph("None.") : html::list(warnings));
  return section;
}

Section limits_section(const RunResults& r) {
  std::vector<std::string> limits{
      "Blocks are rigid: joints, bolts and linings deform. Rock that fails inside a block is "
      "outside the model."};
  if (r.is_laid()) {
    limits.emplace_back("The section is in plane strain, per metre out of the plane.");
  } else if (r.is_spatial()) {
    limits.emplace_back("The openings are straight, and the sides of the model are rollers.");
  } else {
    limits.emplace_back(
        "A section in plane strain, per metre of tunnel: joints strike along it. What the rock "
        "ahead of the face carries is in the model as wall traction that is left, which the input "
        "chooses.");
  }
  if (!r.is_laid()) {
    limits.emplace_back("Dry rock: neither water nor blasting nor earthquakes.");
    const bool ages = !list_at(r.run, "/lining/by_stage").empty();
    limits.emplace_back(
        std::string("Supports are wished in place: they act in full from the stage in which they "
                    "are installed. Concrete ") +
        (ages ? "hardens from stage to stage; it neither shrinks nor creeps."
              : "neither hardens, shrinks nor creeps."));
    limits.emplace_back(
        "Not checked: adhesion of the lining to the rock; shear of steel ribs; bond and plates of "
        "bolts whose strength is not given; the ground surface. Forces are those of the model, "
        "without partial factors on loads.");
    limits.emplace_back(
        "A block that came off is taken out; where it lands, and what it hits, is not followed.");
  }
  return {"limits", "Limits of the model", html::list(limits)};
}

Section reproduce_section(const RunResults& r) {
  Section section{"reproduce", "How to compute it again", ""};
  const Json& run = r.run;
  std::string command = "voussoir run " + words_at(run, "/input/file");
  for (const Json& text : list_at(run, "/input/overrides")) {
    if (!text.is_string()) continue;
    const std::string word = text.get<std::string>();
    command +=
        word.starts_with("!") ? " --unset '" + word.substr(1) + "'" : " --set '" + word + "'";
  }
  Table table("", {{"what", "", Kind::text}, {"value", "", Kind::text}});
  const auto add = [&](const std::string& what, const std::string& value) {
    if (!value.empty()) table.add({what, value});
  };
  add("program", words_at(run, "/program"));
  add("hash of its sources", words_at(run, "/build/sources"));
  add("compiler",
      words_at(run, "/build/compiler") +
          (run.contains("build") && !holds_at(run, "/build/optimised") ? ", not optimised" : ""));
  add("input file", words_at(run, "/input/file"));
  add("hash of the input file", words_at(run, "/input/hash"));
  add("seed of the joints",
      std::isfinite(number_at(run, "/seed"))
          ? std::to_string(static_cast<std::uint64_t>(number_at(run, "/seed")))
          : "");
  add("id of the run (version, input, seed)", words_at(run, "/run_id"));
  add("hash of the results", words_at(run, "/result_hash"));
  section.body = html::preformatted(command + " --out results") + table.text() +
                 html::paragraph(
                     "The same version with the same input has the same id; the same build gives "
                     "the same hash of the results, whatever the number of threads. Another build "
                     "adds the same numbers with other roundings: its results differ by less than "
                     "the error estimate, and its hash is another.");
  return section;
}

}  // namespace voussoir::program
