// SPDX-License-Identifier: MIT
#include "case_plan.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <voussoir/core/version.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/journal.hpp>
#include <voussoir/statistics/latin_hypercube.hpp>

#include "input_document.hpp"
#include "run_folder.hpp"

namespace voussoir::program {

namespace {

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(" \t") - begin + 1));
}

const char* const forms =
    "\n   = accepted: --vary \"support.lining.thickness=10 cm, 20 cm\" (a list) or --vary "
    "\"joint.friction=25..35 deg:5\" (five values at equal steps)";

/// At commas outside quotes and brackets.
std::vector<std::string> listed(const std::string& text) {
  std::vector<std::string> values(1);
  char quote = 0;
  int depth = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += c;
  }
  for (std::string& value : values) value = trimmed(value);
  return values;
}

/// A number at the start of a text, which is cut off.
std::optional<double> leading_number(std::string_view& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// `10..30 cm:5`; nothing if it has another form.
std::optional<std::vector<std::string>> stepped(std::string_view text, const std::string& whole) {
  const std::size_t dots = text.find(".."), colon = text.rfind(':');
  if (dots == std::string_view::npos) return std::nullopt;
  const auto refuse = [&](const std::string& reason) {
    throw InvalidInput("--vary " + printable(whole) + ": " + reason + forms);
  };
  std::string_view rest = text;
  // "10." is a number too: what stands before the dots is read by itself.
  std::string_view first = text.substr(0, dots);
  const auto low = leading_number(first);
  if (!low || !trimmed(first).empty()) return std::nullopt;
  rest = text.substr(dots + 2);
  // 1...2 may end with 2 or with .2: nobody should have to know our rule.
  if (rest.starts_with(".")) refuse("a range has two dots between its ends, and this has three");
  const auto high = leading_number(rest);
  if (!high) refuse("a range ends with a number");
  if (colon == std::string_view::npos || colon < dots)
    refuse("a range says how many values it has");
  std::string_view count_text = text.substr(colon + 1);
  const auto count = leading_number(count_text);
  if (!count || !trimmed(count_text).empty() || *count != std::floor(*count) || *count < 2 ||
      *count > 10000)
    refuse("a range has 2 to 10000 values");
  if (*low == *high) refuse("a range begins and ends with different numbers");
  const std::string unit = trimmed(rest.substr(0, rest.rfind(':')));
  std::vector<std::string> values;
  for (int k = 0; k < static_cast<int>(*count); ++k) {
    const double part = k / (*count - 1);
    values.push_back(significant_text((1 - part) * *low + part * *high, 12) +
                     (unit.empty() ? "" : " " + unit));
  }
  return values;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

/// "a.b[3]" of " a.b[03] = 5 m", whatever is in front of the `=`.
std::string key_of(std::string_view text) {
  std::string key;
  for (const char c : trimmed(text.substr(0, text.find('=')))) {
    if (key.ends_with("[0") && c >= '0' && c <= '9') key.pop_back();
    key += c;
  }
  return key;
}

/// Whether a value of `key` holds that of `other`, as joint holds joint.kn.
bool holds(const std::string& key, const std::string& other) {
  return other.starts_with(key) &&
         (other.size() == key.size() || other[key.size()] == '.' || other[key.size()] == '[');
}

/// What is laid over a value that was asked for would take its place without a word.
void check_keys(const PlanParts& parts) {
  for (auto varied = parts.varied.begin(); varied != parts.varied.end(); ++varied) {
    const std::string key = key_of(varied->key), of_key = "--vary " + printable(varied->key);
    for (auto other = parts.varied.begin(); other != varied; ++other) {
      const std::string other_key = key_of(other->key);
      if (key == other_key)
        throw InvalidInput(of_key + " is given twice\n   = accepted: one list of all its values");
      if (holds(key, other_key) || holds(other_key, key))
        throw InvalidInput(of_key + " and --vary " + printable(other->key) +
                           " give the same key a value\n   = accepted: either");
    }
    for (const std::string& set : parts.overrides)
      if (holds(key, key_of(set)))
        throw InvalidInput(of_key + ": --set " + printable(set) +
                           " gives the same key a value, which would not count\n   = accepted: "
                           "either");
    if (key == "model.seed")
      throw InvalidInput(
          "--vary model.seed: seeds are counted by --realisations\n   = accepted: --realisations " +
          std::to_string(varied->values.size()) +
          " and --set model.seed=" + varied->values.front());
  }
}

std::string head_of(const std::string& line) { return line.substr(0, line.find(" = ")); }
std::string value_of(const std::string& line) {
  const std::size_t at = line.find(" = ");
  return at == std::string::npos ? "" : line.substr(at + 3);
}

}  // namespace

bool is_of_support(std::string_view key) {
  for (const char* const head :
       {"support", "stage", "run.", "diagram", "title", "criteria", "costs"})
    if (key.starts_with(head)) return true;
  return false;
}

bool is_of_choice(std::string_view line) {
  return line.starts_with("criteria.") || line.starts_with("costs.");
}

const char* to_string(PlanVerb verb) {
  switch (verb) {
    case PlanVerb::diagram:
      return "diagram";
    case PlanVerb::realisations:
      return "realisations";
    case PlanVerb::sweep:
      return "sweep";
  }
  return "sweep";
}

const char* word_of(Sampling sampling) { return sampling == Sampling::latin ? "latin" : "random"; }

VariedKey varied_key(const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto refuse = [&](const std::string& reason) {
    throw InvalidInput("--vary " + printable(text) + ": " + reason + forms);
  };
  if (equals == std::string::npos) refuse("no `=` between key and values");
  VariedKey varied{trimmed(std::string_view(text).substr(0, equals)), {}};
  if (varied.key.empty()) refuse("no key before the `=`");
  const std::string values = trimmed(std::string_view(text).substr(equals + 1));
  const auto range = stepped(values, text);
  varied.values = range ? *range : listed(values);
  std::set<std::string> seen;
  for (const std::string& value : varied.values) {
    if (value.empty()) refuse("a value is empty");
    if (!seen.insert(value).second) refuse("the value " + printable(value) + " stands there twice");
  }
  return varied;
}

CasePlan::CasePlan(PlanParts parts) : parts_(std::move(parts)) {
  const PlanParts& p = parts_;
  require(p.realisations >= 1 && p.realisations <= most_realisations, "--realisations",
          p.realisations, "1 to 10000");
  check_keys(p);
  input_ = read(p.overrides);
  if (input_.laid)
    throw InvalidInput(p.file +
                       ": diagram, realisations and sweep are of tunnels, and this is a model of "
                       "blocks that are laid\n   = accepted: voussoir run, with --set for each "
                       "value");
  if (p.verb == PlanVerb::diagram && !input_.diagram)
    throw InvalidInput(
        "no [diagram] in " + p.file +
        "\n  accepted: spacing = [\"11.25 deg\", \"15 deg\", \"none\"] and thickness = [\"0 cm\", \"10 cm\"]");
  if (p.verb == PlanVerb::sweep && p.varied.empty())
    throw InvalidInput(std::string("a sweep varies nothing") + forms);
  if (p.verb == PlanVerb::realisations || p.realisations > 1)
    for (const UncertainKey& key : input_.uncertain)
      if (std::none_of(p.varied.begin(), p.varied.end(), [&](const VariedKey& varied) {
            return holds(key_of(varied.key), key.key) || holds(key.key, key_of(varied.key));
          }))
        uncertain_.push_back(key);
  double count = p.realisations;
  for (const VariedKey& varied : p.varied) count *= static_cast<double>(varied.values.size());
  if (p.verb == PlanVerb::diagram) count *= static_cast<double>(combinations());
  if (count > static_cast<double>(most_cases))
    throw InvalidInput("the " + std::string(to_string(p.verb)) + " has " + fixed_text(count, 0) +
                       " cases\n   = accepted: at most " + std::to_string(most_cases));
  names_.reserve(static_cast<std::size_t>(count));
  std::map<std::string, std::size_t> indices;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const Case the_case = at(k);
    std::optional<Input> input;
    std::string joints;
    try {
      input = input_of(the_case);
      joints = joints_of(*input);
      check_bolt_ends(*input, {supports_of(the_case, *input).spacing});
    } catch (const InputErrors& found) {
      std::vector<InputError> errors = found.errors();
      for (InputError& error : errors) error.message += ", in the case " + label(the_case);
      throw InputErrors(std::move(errors), found.more());
    } catch (const InvalidInput& error) {
      throw InvalidInput(std::string(error.what()) + "\n   = in the case " + label(the_case));
    }
    RunId id("case");
    id.add(sources_hash).add(joints);
    for (const std::string& line : input->content)
      if (!names_a_file(line) && !line.starts_with("diagram.") && !line.starts_with("title = ") &&
          !is_of_choice(line))
        id.add(line);
    id.add(std::to_string(the_case.seed));
    if (the_case.place) {
      const SupportChoice supports = supports_of(the_case, *input);
      id.add(supports.spacing ? (supports.spacing->is_angle ? "rad" : "m") : "none");
      id.add(supports.spacing ? supports.spacing->value : 0.0).add(supports.thickness);
    }
    names_.push_back(id.text());
    // Keys differ, so it is two files that do not.
    const auto [same, is_new] = indices.try_emplace(names_.back(), k);
    if (!is_new)
      throw InvalidInput("two cases are the same: " + label(at(same->second)) + " and " +
                         label(the_case) + "\n   = accepted: files of joints that differ");
  }

  content_ = {std::string("version = ") + VOUSSOIR_VERSION_STRING,
              std::string("program = ") + sources_hash, std::string("verb = ") + to_string(p.verb),
              std::string(realisations_line) + std::to_string(p.realisations)};
  std::vector<std::string> hashes;
  for (const PlannedFile& file : files_) hashes.push_back(file.hash);
  if (!hashes.empty()) content_.push_back("joints.file (its content) = " + joined(hashes));
  if (!uncertain_.empty() && p.sampling == Sampling::random)
    content_.emplace_back("--sampling = random");
  for (const VariedKey& varied : p.varied)
    content_.push_back("--vary " + varied.key + " = " + joined(varied.values));
  for (const std::string& line : input_.content)
    if (!names_a_file(line)) content_.push_back(line);
  std::sort(content_.begin(), content_.end());
  std::string of_run, of_work;
  for (const std::string& line : content_) {
    if (!line.starts_with("program = ")) of_run += line + "\n";
    if (!line.starts_with(realisations_line) && !is_of_choice(line)) of_work += line + "\n";
  }
  run_id_ = text_hash(of_run);
  work_id_ = text_hash(of_work);
}

Input CasePlan::read(const std::vector<std::string>& overrides) const {
  Input input = read_input_text(parts_.text, parts_.file, parts_.directory, overrides);
  for (const std::string& line : input.content)
    if (const auto copy = parts_.copies.find(line); copy != parts_.copies.end())
      input.joints_file = copy->second;
  return input;
}

std::string CasePlan::joints_of(const Input& input) {
  if (input.joints_file.empty()) return "";
  const auto known = std::find_if(files_.begin(), files_.end(), [&](const PlannedFile& file) {
    return file.path == input.joints_file;
  });
  if (known != files_.end()) return known->hash;
  const std::string hash = joints_hash(input);
  if (hash.empty())
    throw InvalidInput(
        "joints.file: " + utf8_text(input.joints_file) +
        " is no file that can be read again and again\n   = accepted: a regular file");
  const auto line =
      std::find_if(input.content.begin(), input.content.end(),
                   [](const std::string& text) { return text.starts_with("joints.file = "); });
  std::string name;  // in quotes, with a backslash before what would end them
  const std::string value = value_of(*line);
  for (std::size_t k = 1; k + 1 < value.size(); ++k)
    if (value[k] != '\\' || ++k + 1 < value.size()) name += value[k];
  files_.push_back({*line, name, input.joints_file, hash});
  return hash;
}

std::size_t CasePlan::combinations() const {
  if (parts_.verb == PlanVerb::diagram)
    return input_.diagram->spacing.size() * input_.diagram->thickness.size();
  std::size_t count = 1;
  for (const VariedKey& varied : parts_.varied) count *= varied.values.size();
  return count;
}

Case CasePlan::at(std::size_t index) const {
  const auto seeds = static_cast<std::size_t>(parts_.realisations);
  Case the_case;
  the_case.index = index;
  the_case.seed = input_.model.seed + index % seeds;
  const GrowingLatinHypercube points(input_.model.seed);
  for (const UncertainKey& key : uncertain_) {
    // By its name: what is drawn for one key does not hang on which others are uncertain.
    const std::uint64_t variable = std::stoull(text_hash(key.key), nullptr, 16);
    the_case.drawn.push_back(key.value_at(parts_.sampling == Sampling::latin
                                              ? points.at(index % seeds, variable)
                                              : points.independent(index % seeds, variable)));
  }
  std::size_t rest = index / seeds;
  if (parts_.verb == PlanVerb::diagram) {
    const std::size_t thicknesses = input_.diagram->thickness.size();
    the_case.place = {rest / thicknesses, rest % thicknesses};
    return the_case;
  }
  for (auto varied = parts_.varied.rbegin(); varied != parts_.varied.rend(); ++varied) {
    the_case.overrides.insert(the_case.overrides.begin(),
                              varied->key + "=" + varied->values[rest % varied->values.size()]);
    rest /= varied->values.size();
  }
  return the_case;
}

Input CasePlan::input_of(const Case& the_case) const {
  if (the_case.overrides.empty() && the_case.drawn.empty()) {  // the file differs in its seed alone
    Input input = input_;
    const std::string line = "model.seed = ";
    for (std::string& text : input.content)
      if (text.starts_with(line)) text = line + std::to_string(the_case.seed);
    input.model.seed = the_case.seed;
    return input;
  }
  std::vector<std::string> overrides = parts_.overrides;
  overrides.insert(overrides.end(), the_case.overrides.begin(), the_case.overrides.end());
  for (std::size_t k = 0; k < the_case.drawn.size(); ++k)
    overrides.push_back(uncertain_[k].key + "=" + uncertain_[k].text_of(the_case.drawn[k]));
  overrides.push_back("model.seed=" + std::to_string(the_case.seed));
  return read(overrides);
}

SupportChoice CasePlan::supports_of(const Case& the_case, const Input& input) const {
  if (!the_case.place) return program::supports_of(input);
  const auto [spacing, thickness] = *the_case.place;
  return {input.diagram->spacing[spacing], input.diagram->thickness[thickness]};
}

std::string CasePlan::label(const Case& the_case) const {
  std::string text = joined(the_case.overrides);
  if (the_case.place) {
    const SupportChoice supports = supports_of(the_case, input_);
    const auto& spacing = supports.spacing;
    text = "spacing " +
           (!spacing ? std::string("none")
                     : format_quantity(spacing->value,
                                       spacing->is_angle ? dimension::angle : dimension::length)) +
           ", thickness " + format_quantity(supports.thickness, dimension::length);
  }
  for (std::size_t k = 0; k < the_case.drawn.size(); ++k)
    text += (text.empty() ? "" : ", ") + uncertain_[k].key + "=" +
            uncertain_[k].text_of(the_case.drawn[k]);
  return text + (text.empty() ? "" : ", ") + "seed " + std::to_string(the_case.seed);
}

std::vector<std::size_t> CasePlan::work_order() const {
  // What the rock of a case is made of, as a number that is the same for the same rock: the keys
  // that it depends on, and the seed.
  const auto seeds = static_cast<std::size_t>(parts_.realisations);
  const auto rock_of = [&](std::size_t index) {
    std::size_t rock = index % seeds, factor = seeds, rest = index / seeds;
    if (parts_.verb == PlanVerb::diagram) return rock;
    for (auto varied = parts_.varied.rbegin(); varied != parts_.varied.rend(); ++varied) {
      const std::size_t digit = rest % varied->values.size();
      rest /= varied->values.size();
      if (is_of_support(varied->key)) continue;
      rock += factor * digit;
      factor *= varied->values.size();
    }
    return rock;
  };
  // Thicknesses of a diagram grow; spacings too, and "none" comes last.
  const auto support_of = [&](std::size_t index) {
    const auto place = at(index).place;
    const std::size_t spacings = place ? input_.diagram->spacing.size() : 0;
    return place ? (*place)[1] * spacings + spacings - 1 - (*place)[0] : index;
  };
  std::vector<std::array<std::size_t, 3>> order;
  order.reserve(size());
  for (std::size_t k = 0; k < size(); ++k) order.push_back({rock_of(k), support_of(k), k});
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> result;
  result.reserve(size());
  for (const auto& entry : order) result.push_back(entry[2]);
  return result;
}

std::string CasePlan::copy_name(PlanVerb verb, std::size_t file) {
  std::string name = std::string(to_string(verb)) + ".joints";
  if (file > 0) name.append("-").append(std::to_string(file + 1));
  return name + ".csv";
}

std::string CasePlan::json() const {
  nlohmann::ordered_json varied = nlohmann::ordered_json::array();
  for (const VariedKey& key : parts_.varied)
    varied.push_back({{"key", key.key}, {"values", key.values}});
  nlohmann::ordered_json copies = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < files_.size(); ++k)
    copies[files_[k].line] = copy_name(parts_.verb, k);
  const nlohmann::ordered_json json = {{"schema", 1},
                                       {"verb", to_string(parts_.verb)},
                                       {"run_id", run_id_},
                                       {"cases", size()},
                                       {"realisations", parts_.realisations},
                                       {"sampling", word_of(parts_.sampling)},
                                       {"varied", varied},
                                       {"overrides", parts_.overrides},
                                       {"copies", copies},
                                       {"content", content_},
                                       {"input_name", parts_.file},
                                       {"input", parts_.text}};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

CasePlan CasePlan::from_json(const std::string& text, const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& reason) {
    throw std::runtime_error("'" + utf8_text(path) + "' " + reason);
  };
  std::vector<std::string> content;
  std::optional<CasePlan> plan;
  try {
    const auto json = nlohmann::json::parse(text);
    if (json.at("schema") != 1)
      refuse("is a plan of schema " + json.at("schema").dump() + "\n   = accepted: schema 1");
    PlanParts parts;
    bool known = false;
    for (const PlanVerb verb : {PlanVerb::diagram, PlanVerb::realisations, PlanVerb::sweep})
      if (json.at("verb") == to_string(verb)) {
        parts.verb = verb;
        known = true;
      }
    if (!known) refuse("is a plan of the unknown verb " + json.at("verb").dump());
    json.at("input_name").get_to(parts.file);
    json.at("input").get_to(parts.text);
    json.at("overrides").get_to(parts.overrides);
    json.at("realisations").get_to(parts.realisations);
    parts.sampling =
        json.at("sampling") == word_of(Sampling::random) ? Sampling::random : Sampling::latin;
    for (const auto& varied : json.at("varied"))
      parts.varied.push_back({varied.at("key"), varied.at("values")});
    json.at("content").get_to(content);
    parts.directory = path.parent_path();
    for (const auto& [line, name] : json.at("copies").items())
      parts.copies[line] = parts.directory / utf8_path(name.get<std::string>());
    plan.emplace(std::move(parts));
  } catch (const nlohmann::json::exception& error) {
    refuse(std::string("is no plan: ") + error.what());
  }
  const auto different = differences(plan->content(), content);
  if (!different.empty()) {
    std::string all;
    for (const std::string& line : different) all += "\n   | " + line;
    refuse("is not what this program would compute:" + all +
           "\n   = accepted: a plan made by this program, with its files beside it");
  }
  return *std::move(plan);
}

std::vector<std::string> differences(const std::vector<std::string>& now,
                                     const std::vector<std::string>& before) {
  std::map<std::string, std::array<std::string, 2>> values;
  for (const std::string& line : now) values[head_of(line)][0] = value_of(line);
  for (const std::string& line : before) values[head_of(line)][1] = value_of(line);
  std::vector<std::string> result;
  for (const auto& [key, value] : values) {
    if (value[0] == value[1]) continue;
    result.push_back(value[0].empty()   ? key + " is not there, was " + value[1]
                     : value[1].empty() ? key + " = " + value[0] + ", was not there"
                                        : key + " = " + value[0] + ", was " + value[1]);
  }
  return result;
}

}  // namespace voussoir::program
