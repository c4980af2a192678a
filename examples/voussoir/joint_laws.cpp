// SPDX-License-Identifier: MIT
#include "joint_laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <voussoir/contact/law_in_situ.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/drawing/number_text.hpp>

namespace voussoir::program {

namespace {

constexpr double degree = std::numbers::pi / 180;

// Far outside of these ranges one spring drowns another in the 16 digits of a number. What is
// common is by judgement, from values in use, for filled and for fresh joints.
constexpr Range stiffness_range{.low = 1e3, .high = 1e12};  // [Pa/m]
constexpr Range strength_range{.low = 0, .high = 1e9};      // [Pa]
const Range friction_range = angle_below_90();

const LawParameter kn{.key = "kn",
                      .dimension = dimension::stiffness_per_area,
                      .range = stiffness_range,
                      .common_low = 0.25e9,
                      .common_high = 200e9,
                      .sentence = "normal stiffness per area, such as `\"5 GPa/m\"`"};
const LawParameter ks{.key = "ks",
                      .dimension = dimension::stiffness_per_area,
                      .range = stiffness_range,
                      .common_low = 0.01,
                      .common_high = 1.5,
                      .beside = "kn",
                      .sentence = "shear stiffness per area"};
const LawParameter friction{.key = "friction",
                            .dimension = dimension::angle,
                            .range = friction_range,
                            .common_low = 5 * degree,
                            .common_high = 75 * degree,
                            .sentence = "angle of friction"};

std::string at_most(double value, const Dimension& dimension, const char* key) {
  return "at most " + format_quantity(value, dimension) + ", the " + key;
}

std::optional<LawFault> no_fault(const JointLawInput&) { return std::nullopt; }

std::optional<LawFault> mohr_coulomb_fault(const JointLawInput& law) {
  const auto above = [&](const char* key, const char* other,
                         const Dimension& of) -> std::optional<LawFault> {
    if (!(law.at(key) > law.at(other) * (1 + 1e-12))) return std::nullopt;
    return LawFault{key, std::string("is more than ") + other, at_most(law.at(other), of, other)};
  };
  const double most = law.at("cohesion") / elementary::tangent(law.at("friction"));
  if (law.at("tensile_strength") > most * (1 + 1e-12))
    return LawFault{"tensile_strength", "is more than cohesion / tan(friction)",
                    "at most " + format_quantity(most, dimension::pressure)};
  if (auto fault = above("residual_friction", "friction", dimension::angle)) return fault;
  if (auto fault = above("residual_cohesion", "cohesion", dimension::pressure)) return fault;
  // A joint that lifts more steeply than it rubs makes energy as it slips.
  if (auto fault = above("dilation", "residual_friction", dimension::angle)) return fault;
  if (law.at("dilation") > 0 && law.at("dilation_limit") == 0)
    return LawFault{"dilation", "has no end: a joint that lifts without end carries any load",
                    R"(dilation_limit = "5 mm" besides it, the slip after which it ends)"};
  return std::nullopt;
}

AnyJoint mohr_coulomb(const JointLawInput& law) {
  return MohrCoulombJoint({.joint_normal_stiffness = law.at("kn"),
                           .joint_shear_stiffness = law.at("ks"),
                           .friction_angle = law.at("friction"),
                           .cohesion = law.at("cohesion"),
                           .tensile_strength = law.at("tensile_strength"),
                           .dilation_angle = law.at("dilation"),
                           .dilation_limit = law.at("dilation_limit"),
                           .residual_friction_angle = law.at("residual_friction"),
                           .residual_cohesion = law.at("residual_cohesion")},
                          any_units);
}

std::optional<LawFault> barton_bandis_fault(const JointLawInput& law) {
  if (law.at("joint_length") < law.at("sample_length"))
    return LawFault{"joint_length", "is shorter than sample_length",
                    "at least " + format_quantity(law.at("sample_length"), dimension::length) +
                        ", from crossing joint to crossing joint"};
  return std::nullopt;
}

AnyJoint barton_bandis(const JointLawInput& law) {
  return BartonBandisJoint({.roughness = law.at("JRC"),
                            .wall_strength = law.at("JCS"),
                            .residual_friction_angle = law.at("residual_friction"),
                            .initial_stiffness = law.at("initial_stiffness"),
                            .maximum_closure = law.at("maximum_closure"),
                            .sample_length = law.at("sample_length"),
                            .joint_length = law.at("joint_length"),
                            .largest_stress = law.at("largest_stress"),
                            .damage_coefficient = law.at("damage")});
}

constexpr double day = 86400;                                           // [s]
constexpr Range viscosity_range{.low = 1e6 * day, .high = 1e18 * day};  // [Pa s/m]
constexpr double infinity = std::numeric_limits<double>::infinity();

std::optional<LawFault> burgers_fault(const JointLawInput& law) {
  const bool is_delayed = std::isfinite(law.at("kelvin_stiffness")),
             has_rate = std::isfinite(law.at("kelvin_viscosity"));
  if (is_delayed != has_rate)
    return LawFault{is_delayed ? "kelvin_stiffness" : "kelvin_viscosity",
                    is_delayed ? "says how far delayed slip goes, and nothing how fast"
                               : "says how fast delayed slip goes, and nothing how far",
                    is_delayed ? R"(kelvin_viscosity = "20 GPa d/m" besides it)"
                               : R"(kelvin_stiffness = "1 GPa/m" besides it)"};
  if (!is_delayed && std::isinf(law.at("maxwell_viscosity")))
    return LawFault{
        "law", "creeps in no way: it is a Coulomb joint",
        R"(maxwell_viscosity = "500 GPa d/m", or kelvin_stiffness and kelvin_viscosity, or law = "coulomb")"};
  return std::nullopt;
}

AnyJoint burgers(const JointLawInput& law) {
  return BurgersJoint({.joint_normal_stiffness = law.at("kn"),
                       .joint_shear_stiffness = law.at("ks"),
                       .friction_angle = law.at("friction"),
                       .maxwell_viscosity = law.at("maxwell_viscosity"),
                       .kelvin_stiffness = law.at("kelvin_stiffness"),
                       .kelvin_viscosity = law.at("kelvin_viscosity")});
}

std::vector<JointLawRow> made_rows() {
  constexpr Range positive{.low = 0, .low_included = false};
  const Dimension pressure = dimension::pressure, length = dimension::length,
                  angle = dimension::angle, number = dimension::number;
  const auto strength = [&](std::string_view key, std::string_view sentence) {
    return LawParameter{.key = key,
                        .dimension = pressure,
                        .range = strength_range,
                        .common_low = 20e3,
                        .common_high = 10e6,
                        .is_common_at_zero = true,
                        .sentence = sentence,
                        .otherwise = 0.0};
  };
  return {
      {"coulomb",
       "Linear springs across and along the joint, no tension, friction.",
       {kn, ks, friction},
       no_fault,
       [](const JointLawInput& law) {
         return AnyJoint(CoulombJoint({law.at("kn"), law.at("ks"), law.at("friction")}));
       }},
      {"mohr-coulomb",
       "Coulomb's joint with cohesion and tensile strength, which dilates as it slips and is weaker "
       "once it has failed.",
       {kn,
        ks,
        friction,
        strength("cohesion", "left out: none"),
        strength("tensile_strength",
                 "at most `cohesion` / tan(`friction`); a joint breaks from where it opens most"),
        {.key = "dilation",
         .dimension = angle,
         .range = friction_range,
         .common_low = 0.1 * degree,
         .common_high = 30 * degree,
         .is_common_at_zero = true,
         .sentence = "angle at which the joint lifts as it slips, at most `residual_friction`",
         .otherwise = 0.0},
        {.key = "dilation_limit",
         .dimension = length,
         .range = {.low = 0, .high = 1, .low_included = false},
         .common_low = 0.5e-3,
         .common_high = 0.1,
         .is_common_at_zero = true,
         .sentence = "slip after which it lifts no more; with `dilation`",
         .otherwise = 0.0},
        {.key = "residual_friction",
         .dimension = angle,
         .range = friction_range,
         .common_low = 5 * degree,
         .common_high = 75 * degree,
         .sentence = "once the joint has failed, at most `friction`",
         .as = "friction"},
        strength("residual_cohesion", "once the joint has failed, at most `cohesion`")},
       mohr_coulomb_fault,
       mohr_coulomb},
      {"barton-bandis",
       "A rough, unfilled joint by what is logged in the field: its roughness is mobilised as it "
       "slips, lifts it, and is worn; it closes along a hyperbola.",
       {{.key = "JRC",
         .dimension = number,
         .range = {.low = 0, .high = 20},
         .common_low = 0.5,
         .common_high = 20,
         .is_common_at_zero = true,
         .sentence = "joint roughness coefficient of the sample"},
        {.key = "JCS",
         .dimension = pressure,
         .range = {.low = 1e4, .high = 1e10},
         .common_low = 1e6,
         .common_high = 400e6,
         .sentence = "strength of the joint's walls, of the sample"},
        {.key = "residual_friction",
         .dimension = angle,
         .range = {.low = 0, .high = radians(90), .low_included = false, .high_included = false},
         .common_low = 5 * degree,
         .common_high = 45 * degree,
         .sentence = "from tilt tests on the weathered walls"},
        {.key = "initial_stiffness",
         .dimension = dimension::stiffness_per_area,
         .range = stiffness_range,
         .common_low = 1e9,
         .common_high = 400e9,
         .sentence = "K_ni, across the unloaded joint"},
        {.key = "maximum_closure",
         .dimension = length,
         .range = {.low = 1e-6, .high = 0.1},
         .common_low = 10e-6,
         .common_high = 5e-3,
         .sentence = "V_m, by which it closes at most"},
        {.key = "sample_length",
         .dimension = length,
         .range = positive,
         .common_low = 0.03,
         .common_high = 3,
         .sentence = "of which `JRC` and `JCS` are",
         .otherwise = 0.1},
        {.key = "joint_length",
         .dimension = length,
         .range = positive,
         .common_low = 0.05,
         .common_high = 40,
         .sentence = "from crossing joint to crossing joint, for the scale effect; as the sample: "
                     "none",
         .as = "sample_length"},
        {.key = "largest_stress",
         .dimension = pressure,
         .range = {.low = 1e3, .high = 1e10},
         .common_low = 0.5e6,
         .common_high = 300e6,
         .sentence = "up to which the closure curve is followed; beyond it goes on along its "
                     "tangent",
         .otherwise = 5e6},
        {.key = "damage",
         .dimension = number,
         .range = {.low = 1, .high = 1e6},
         .common_low = 1,
         .common_high = 2,
         .sentence = "M: it lifts by 1/M of the angle of its roughness",
         .otherwise = 2.0}},
       barton_bandis_fault,
       barton_bandis},
      {"burgers",
       "Coulomb's joint that creeps in shear, for as long as stages last (`stage.duration`): "
       "weathered or clay-coated joints. Under a constant shear stress it slips at once, by what is "
       "delayed (Kelvin), and without end (Maxwell). All of the shear that it carries makes it "
       "creep, that of the rock in situ included.",
       {kn,
        ks,
        friction,
        {.key = "maxwell_viscosity",
         .dimension = dimension::viscosity_per_area,
         .range = viscosity_range,
         .common_low = 1e9 * day,
         .common_high = 900e9 * day,
         .sentence = "shear stress over the rate of slip that goes on, such as "
                     "`\"500 GPa d/m\"`; left out: none goes on",
         .otherwise = infinity},
        {.key = "kelvin_stiffness",
         .dimension = dimension::stiffness_per_area,
         .range = stiffness_range,
         .common_low = 20e6,
         .common_high = 15e9,
         .sentence = "shear stress over the slip that is delayed; left out: none is",
         .otherwise = infinity},
        {.key = "kelvin_viscosity",
         .dimension = dimension::viscosity_per_area,
         .range = viscosity_range,
         .common_low = 1e9 * day,
         .common_high = 900e9 * day,
         .sentence = "that times the time in which it comes; with `kelvin_stiffness`",
         .otherwise = infinity}},
       burgers_fault,
       burgers},
  };
}

/// A parameter of one law or of several, with the words of these.
struct Declared {
  const LawParameter* parameter;
  std::string words;
};

}  // namespace

double JointLawInput::at(std::string_view key) const {
  const auto found = values.find(key);
  if (found == values.end())
    throw std::logic_error("no parameter " + std::string(key) + " of joint law " + law);
  return found->second;
}

const LawParameter* JointLawRow::find(std::string_view key) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const LawParameter& p) { return p.key == key; });
  return found == parameters.end() ? nullptr : &*found;
}

const std::vector<JointLawRow>& joint_law_rows() {
  static const std::vector<JointLawRow> rows = made_rows();
  return rows;
}

const JointLawRow& joint_law_row(std::string_view word) {
  for (const JointLawRow& row : joint_law_rows())
    if (row.word == word) return row;
  throw std::logic_error("no joint law " + std::string(word));
}

namespace {

/// Reads one parameter where the table has it; otherwise what holds in its place.
void read_parameter(Section& s, const LawParameter& parameter, const JointLawInput* common,
                    JointLawInput& law) {
  const auto inherited = common != nullptr ? common->values.find(parameter.key) : law.values.end();
  const bool is_inherited = common != nullptr && inherited != common->values.end();
  // What is missing in [joint] is said there, once.
  const bool is_missed_there =
      common != nullptr && joint_law_row(common->law).find(parameter.key) != nullptr;
  const bool is_required =
      !is_inherited && !is_missed_there && !parameter.otherwise && parameter.as.empty();
  const Need need = is_required ? Need::required : Need::optional;
  std::optional<double> value;
  if (parameter.dimension == dimension::number) {
    if (const auto found = s.find(parameter.key, need, KeyForm::number(parameter.range)))
      value = found->as_number(parameter.range);
  } else if (const auto found = s.find(parameter.key, need,
                                       KeyForm::quantity(parameter.dimension, parameter.range))) {
    value = found->as_quantity(parameter.dimension, parameter.range);
  }
  if (s.has(parameter.key)) law.given.emplace_back(parameter.key);
  if (value)
    law.values.emplace(parameter.key, *value);
  else if (is_inherited)
    law.values.emplace(parameter.key, inherited->second);
  else if (parameter.otherwise)
    law.values.emplace(parameter.key, *parameter.otherwise);
  else if (const auto other = law.values.find(parameter.as); other != law.values.end())
    law.values.emplace(parameter.key, other->second);
}

}  // namespace

JointLawInput read_joint_law(Section& s, const JointLawInput* common) {
  JointLawInput law;
  if (common != nullptr) law.law = common->law;
  std::vector<std::string> words;
  for (const JointLawRow& row : joint_law_rows()) words.emplace_back(row.word);
  bool is_known = true;
  if (const auto value = s.find("law", Need::optional, KeyForm::word(words))) {
    const auto word = value->as_word(words);
    is_known = word.has_value();
    if (word) law.law = words[*word];
    law.given.emplace_back("law");
  }
  const JointLawRow& row = joint_law_row(law.law);
  for (const LawParameter& parameter : row.parameters) {
    if (is_known)
      read_parameter(s, parameter, common, law);
    else
      s.unread([&] { (void)s.find(parameter.key, Need::optional); });
  }
  std::vector<Declared> others;
  for (const JointLawRow& other : joint_law_rows())
    for (const LawParameter& parameter : other.parameters) {
      if (row.find(parameter.key) != nullptr) continue;
      const std::string word = "law = \"" + std::string(other.word) + "\"";
      const auto same = std::find_if(others.begin(), others.end(), [&](const Declared& declared) {
        return declared.parameter->key == parameter.key;
      });
      if (same == others.end())
        others.push_back({&parameter, word});
      else
        same->words.append(" or ").append(word);
    }
  for (const Declared& other : others) {
    const auto declare = [&] { (void)s.find(other.parameter->key, Need::optional); };
    if (is_known)
      s.only_with(false, other.words, declare);
    else
      s.unread(declare);
  }
  if (!is_known || law.values.size() < row.parameters.size()) return law;
  for (const LawParameter& parameter : row.parameters)
    if (s.faulty(parameter.key)) return law;
  if (const auto fault = row.fault(law))
    s.complain(fault->key, fault->complaint, fault->accepted);
  else
    law.is_sound = true;
  return law;
}

const JointLawInput& law_of_set(const Input& input, int set) {
  if (set < 0) return input.joint_law;
  const auto& own = input.set_files[static_cast<std::size_t>(set)].law;
  return own ? *own : input.joint_law;
}

std::vector<const JointLawInput*> laws_in_use(const Input& input) {
  std::vector<const JointLawInput*> laws;
  bool has_own = input.joints_file.empty() && !input.set_files.empty();
  for (const JointSetFile& set : input.set_files) {
    if (set.law) laws.push_back(&*set.law);
    has_own = has_own && set.law;
  }
  if (!has_own) laws.insert(laws.begin(), &input.joint_law);
  return laws;
}

AnyJoint joint_of(const JointLawInput& law) { return joint_law_row(law.law).make(law); }

double least_friction_angle(const Input& input, double stress) {
  double least = 0.5 * std::numbers::pi;
  for (const JointLawInput* law : laws_in_use(input))
    least = std::min(least, friction_angle_at(joint_of(*law), stress));
  return least;
}

std::string law_text(const JointLawInput& law) {
  const JointLawRow& row = joint_law_row(law.law);
  std::string text;
  if (&row != &joint_law_rows().front()) text.append(law.law).append(": ");
  bool is_first = true;
  for (const LawParameter& parameter : row.parameters) {
    const double value = law.at(parameter.key);
    const bool is_default = parameter.otherwise
                                ? value == *parameter.otherwise
                                : !parameter.as.empty() && value == law.at(parameter.as);
    if (is_default) continue;
    text.append(is_first ? "" : ", ").append(parameter.key).append(" ");
    text += parameter.dimension == dimension::number ? significant_text(value, 4)
                                                     : format_quantity(value, parameter.dimension);
    is_first = false;
  }
  return text;
}

std::string json_name(const LawParameter& parameter) {
  const auto with = [&](const char* unit) { return std::string(parameter.key) + unit; };
  if (parameter.dimension == dimension::stiffness_per_area) return with("_Pa_per_m");
  if (parameter.dimension == dimension::viscosity_per_area) return with("_Pa_s_per_m");
  if (parameter.dimension == dimension::angle) return with("_deg");
  if (parameter.dimension == dimension::pressure) return with("_Pa");
  if (parameter.dimension == dimension::length) return with("_m");
  return with("");
}

double json_value(const LawParameter& parameter, double value) {
  return parameter.dimension == dimension::angle ? value * 180 / std::numbers::pi : value;
}

std::string joint_law_page() {
  std::string page;
  for (const JointLawRow& row : joint_law_rows()) {
    page.append("### `law = \"").append(row.word).append("\"`\n\n").append(row.sentence);
    page += "\n\n| key | meaning | range | common | default |\n| --- | --- | --- | --- | --- |\n";
    for (const LawParameter& parameter : row.parameters) {
      const bool is_number = parameter.dimension == dimension::number;
      const auto value = [&](double v) {
        return is_number || !parameter.beside.empty() ? significant_text(v, 3)
                                                      : format_quantity(v, parameter.dimension);
      };
      page.append("| `").append(parameter.key).append("` | ").append(parameter.sentence);
      page.append(" | ").append(parameter.range.text(is_number ? nullptr : &parameter.dimension));
      page.append(" | ").append(parameter.is_common_at_zero ? "0, or " : "");
      page.append(value(parameter.common_low)).append(" to ").append(value(parameter.common_high));
      if (!parameter.beside.empty()) page.append(" of `").append(parameter.beside).append("`");
      page += " | ";
      if (parameter.otherwise)
        page += std::isinf(*parameter.otherwise) ? "none"
                : is_number                      ? significant_text(*parameter.otherwise, 4)
                : *parameter.otherwise == 0
                    ? "0"
                    : format_quantity(*parameter.otherwise, parameter.dimension);
      else if (!parameter.as.empty())
        page.append("`").append(parameter.as).append("`");
      else
        page += "–";
      page += " |\n";
    }
    page += "\n";
  }
  return page;
}

}  // namespace voussoir::program
