// SPDX-License-Identifier: MIT
#include "input.hpp"

#include <algorithm>
#include <cmath>
#include <voussoir/core/elementary.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/io/journal.hpp>
#include <voussoir/io/operating_system.hpp>

#include "blocks_input.hpp"
#include "input_checks.hpp"
#include "input_document.hpp"
#include "input_section.hpp"
#include "joint_laws.hpp"
#include "key_catalogue.hpp"
#include "plausibility.hpp"
#include "regular_file.hpp"
#include "rock_input.hpp"
#include "rock_loads.hpp"
#include "support_input.hpp"
#include "survey.hpp"

namespace voussoir::program {

namespace {

constexpr Range density_range{.low = 1, .high = 1e5};       // [kg/m^3]
constexpr Range tolerance_range{.low = 1e-6, .high = 0.1};  // below it rounding decides

void read_run(Section& s, RunInput& run) {
  const bool known = s.choice<MethodKind>("method", run.method,
                                          {{"two-level", MethodKind::two_level},
                                           {"relaxation", MethodKind::relaxation},
                                           {"explicit", MethodKind::explicit_}},
                                          Need::optional);
  s.choice<LinearMethod>("linear_solver", run.linear_solver,
                         {{"automatic", LinearMethod::automatic},
                          {"direct", LinearMethod::direct},
                          {"iterative", LinearMethod::iterative}},
                         Need::optional);
  s.number("tolerance", run.tolerance, tolerance_range, Need::optional);
  s.number("out_of_balance", run.out_of_balance, tolerance_range, Need::optional);
  std::optional<double> displacement_limit, contact_update_limit;
  s.quantity("displacement_limit", displacement_limit, dimension::length, above(0));
  run.displacement_limit = displacement_limit.value_or(run.displacement_limit);
  s.quantity("contact_update_limit", contact_update_limit, dimension::length, above(0));
  run.contact_update_limit = contact_update_limit.value_or(run.contact_update_limit);
  if (contact_update_limit && displacement_limit && *contact_update_limit >= *displacement_limit)
    s.complain("contact_update_limit",
               "is never reached: a block that has moved so far is detached (displacement_limit: " +
                   format_quantity(*displacement_limit, dimension::length) + ")",
               "a length below displacement_limit");
  s.integer("max_steps", run.max_steps, 1, 2'000'000'000);
  const auto of_explicit = [&] {
    s.number("damping", run.damping, between(0, 0.95), Need::optional);
    s.integer("ramp_steps", run.ramp_steps, 0, 1'000'000'000);
  };
  if (known) {
    s.only_with(run.method == MethodKind::explicit_, "method = \"explicit\"", of_explicit);
  } else {
    s.unread(of_explicit);
  }
  const std::int64_t most = run.max_steps.value_or(voussoir::Explicit::Params{}.max_steps);
  if (known && run.method == MethodKind::explicit_ && most <= run.ramp_steps)
    s.complain(run.max_steps ? "max_steps" : "ramp_steps",
               "leaves no step after the ramp: max_steps = " + std::to_string(most) +
                   ", ramp_steps = " + std::to_string(run.ramp_steps),
               "max_steps above ramp_steps");
}

void read_picture(Section& s, Input& input) {
  (void)s.choice<ViewFrom>(
      "from", input.picture.from,
      {{"axis", ViewFrom::axis}, {"face", ViewFrom::face}, {"above", ViewFrom::above}},
      Need::optional);
  s.flag("history", input.picture.history);
  if (input.is_spatial()) return;
  note_unused(input, s, "from");
}

void read_criteria(Section& s, CriteriaInput& criteria) {
  s.quantity("convergence", criteria.convergence, dimension::length, above(0));
  s.number("utilisation", criteria.utilisation, above(0));
  s.number("bolt_utilisation", criteria.bolt_utilisation, above(0));
  s.quantity("probability", criteria.probability, dimension::number,
             {.low = 0, .high = 1, .low_included = false, .high_included = false});
}

void read_costs(Section& s, CostsInput& costs) {
  s.text("currency", costs.currency);
  s.number("bolt_per_metre", costs.bolt_per_metre, at_least(0), Need::optional);
  s.number("bolt_per_hole", costs.bolt_per_hole, at_least(0), Need::optional);
  s.number("concrete_per_m3", costs.concrete_per_m3, at_least(0), Need::optional);
  s.quantity("rebound", costs.rebound, dimension::number, between(0, 0.9), Need::optional);
  s.number("steel_per_kg", costs.steel_per_kg, at_least(0), Need::optional);
}

void read_all(Section& file, Input& input, const std::filesystem::path& directory) {
  int schema = 1;
  file.integer("schema", schema, 1, 1);
  file.text("title", input.title);
  const auto rock = [&] {
    file.table("rock", [&](Section& s) {
      s.quantity("density", input.rock.density, dimension::density, density_range, Need::required);
    });
    file.table("joint", [&](Section& s) {
      input.joint_law = read_joint_law(s, nullptr);
      if (input.joint_law.is_sound) input.joint = joint_of(input.joint_law);
    });
    file.table("run", [&](Section& s) { read_run(s, input.run); });
  };
  if (has_laid_blocks(file)) {
    rock();
    read_laid_blocks(file, input, directory);
    return file.finish();
  }
  file.table("model", [&](Section& s) { read_model(s, input); });
  file.table("tunnel", [&](Section& s) { read_tunnel(s, input, directory); });
  file.tables("opening", [&](Section& s, std::size_t i) {
    OpeningInput& opening = input.openings.emplace_back();
    opening.name = "opening " + std::to_string(i + 1);
    read_opening(s, input, opening, directory);
    if (!is_modelled(input, i + 1)) input.unused.push_back(opening_key(i + 1));
  });
  rock();
  file.table("stress", [&](Section& s) { read_stress(s, input); });
  file.table("boundary", [&](Section& s) { read_boundary(s, input.boundary); });
  file.tables("joint_set", [&](Section& s, std::size_t i) {
    JointSetInput& set = input.joint_sets.emplace_back();
    JointSetFile& set_file = input.set_files.emplace_back();
    set.name = "set " + std::to_string(i + 1);
    const bool is_surveyed = file.has("joints", "orientations");
    read_joint_set(s, input, set, set_file,
                   file.has("joints") && (file.has("joints", "file") || !is_surveyed), is_surveyed);
  });
  file.optional_table("joints", [&](Section& s) { read_mapped(s, input, directory); });
  read_survey(file, input);
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k)
    if (input.joint_sets[k].is_azimuth && input.joint_sets[k].is_random() && !input.tunnel.trend)
      file.complain("joint_set[" + std::to_string(k) + "].dip_direction",
                    "is an azimuth, and the file does not say where the tunnel goes",
                    R"(tunnel.trend = "0 deg", clockwise from North, looking along the tunnel)");
  file.table("blocks", [&](Section& s) { read_blocks(s, input.blocks); });
  file.table("support", [&](Section& support) {
    input.lists_bolts = support.has_list("bolts");
    support.table_or_tables("bolts", [&](Section& s, std::size_t k) {
      BoltsInput& pattern = input.bolts.emplace_back();
      pattern.name = "bolts " + std::to_string(k + 1);
      read_bolts(s, input, pattern);
    });
    input.lists_linings = support.has_list("lining");
    support.table_or_tables("lining", [&](Section& s, std::size_t k) {
      LiningInput& lining = input.linings.emplace_back();
      lining.name = "lining " + std::to_string(k + 1);
      read_lining(s, input, lining);
    });
  });
  input.has_rounds = file.has("round");
  for (const char* const table : {"stage", "round"})
    file.tables(table, [&](Section& s, std::size_t i) {
      const bool is_round = table == std::string_view("round");
      if (!is_round && input.has_rounds && i == 0)
        file.complain(
            "stage", "is given besides round, and nothing says which comes first",
            R"([[round]] alone; a stage without excavation is one with excavate = "nothing")");
      StageInput& stage = input.stages.emplace_back();
      stage.name = std::string(table).append(" ").append(std::to_string(i + 1));
      read_stage(s, input, stage, is_round, directory);
      if (!is_round && i == 0) stage.part = SectionPart{};
    });
  file.table("picture", [&](Section& s) { read_picture(s, input); });
  read_rock_loads(file, input);
  file.optional_table("diagram", [&](Section& s) { read_diagram(s, input.diagram.emplace()); });
  file.optional_table("criteria", [&](Section& s) { read_criteria(s, input.criteria); });
  file.optional_table("costs", [&](Section& s) { read_costs(s, input.costs.emplace()); });
  file.finish();
}

}  // namespace

bool names_a_file(std::string_view line) {
  for (const std::string_view table : {"opening[", "round["})
    if (line.starts_with(table) && line.substr(0, line.find(" = ")).ends_with("].file"))
      return true;
  for (const std::string_view key :
       {"joints.file", "joints.orientations", "blocks.file", "tunnel.file"})
    if (line.starts_with(std::string(key).append(" = "))) return true;
  return false;
}

std::string Input::bolts_key(std::size_t pattern) const {
  const std::string key = "support.bolts";
  return !lists_bolts ? key : key + "[" + std::to_string(pattern) + "]";
}

std::string Input::lining_key(std::size_t number) const {
  const std::string key = "support.lining";
  return !lists_linings ? key : key + "[" + std::to_string(number) + "]";
}

std::string opening_key(std::size_t opening) {
  return opening == 0 ? "tunnel" : "opening[" + std::to_string(opening - 1) + "]";
}

std::string Input::unused_text() const {
  if (unused.empty()) return "";
  std::string text = is_spatial() ? "not used in 3-D, where the rock ahead of the face is there: "
                                  : "not used in a section (model.dimension = 2): ";
  for (const std::string& key : unused) text += (&key == &unused.front() ? "" : ", ") + key;
  return text;
}

std::string Input::uncertain_text() const {
  if (uncertain.empty()) return "";
  std::string text;
  for (const UncertainKey& key : uncertain)
    text += (text.empty() ? "" : ", ") + key.key + " = " + key.text_at(0.5);
  return "keys with a distribution are at their medians: " + text +
         "; `voussoir realisations` takes all of their values";
}

namespace {

InputSource source_of(std::string_view text, const std::string& name,
                      const std::filesystem::path& directory,
                      const std::vector<std::string>& overrides,
                      const std::vector<std::string>& content) {
  InputSource source{utf8_text(utf8_path(name).filename()), text_hash(text), overrides, {}};
  for (const std::string& line : content) {
    if (!names_a_file(line)) continue;
    const std::size_t at = line.find(" = ");
    std::string file = line.substr(at + 3);
    if (file.size() > 1 && file.front() == '"' && file.back() == '"')
      file = file.substr(1, file.size() - 2);
    source.files.push_back({line.substr(0, at), file, file_hash(directory / utf8_path(file))});
  }
  return source;
}

}  // namespace

Input read_input_text(std::string_view text, const std::string& name,
                      const std::filesystem::path& directory,
                      const std::vector<std::string>& overrides) {
  const Document document = read_document(text, name, overrides);
  Checker checker(document);
  Input input;
  input.uncertain = uncertain_keys(document);
  Section file(checker, &document.root, "");
  read_all(file, input, directory);
  if (!input.laid) check_together(checker, input);
  checker.finish();
  input.content = canonical_lines(document);
  input.source = source_of(text, name, directory, overrides, input.content);
  if (input.laid) return input;
  // What a survey comes to decides the rock, wherever its file lies.
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k)
    if (const JointSetInput& set = input.joint_sets[k]; input.set_files[k].surveyed >= 0)
      input.content.push_back(set.name + " (surveyed) = " + shortest_text(set.plane.dip) + ", " +
                              shortest_text(set.plane.dip_direction) + ", " +
                              shortest_text(set.fisher.value_or(0)));
  const auto add_points = [&](const std::string& key, const std::vector<Vec2>& points) {
    for (const Vec2& p : points)
      input.content.push_back(key + " (a point) = " + shortest_text(p[0]) + ", " +
                              shortest_text(p[1]));
  };
  for (std::size_t k = 0; k <= input.openings.size(); ++k)
    if (const OutlineInput& outline = outline_input(input, k); !outline.drawn.empty())
      add_points(opening_key(k) + ".file", outline.vertices);
  for (const std::size_t k : input.drawn_rounds)
    add_points("round[" + std::to_string(k) + "].file", input.stages[k].outline);
  return input;
}

std::vector<DeclaredKey> keys_of_readers(std::string_view text) {
  const Document document = read_document(text, "keys", {});
  std::vector<DeclaredKey> keys;
  Checker checker(document, &keys);
  Input input;
  Section file(checker, &document.root, "");
  read_all(file, input, {});
  return keys;
}

Input read_input(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return read_input_text(read_text(file), utf8_text(file), file.parent_path(), overrides);
}

}  // namespace voussoir::program
