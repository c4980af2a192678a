// SPDX-License-Identifier: MIT
// All keys that the readers of an input file ask for: each at the ends of its range and beyond, on
// docs/input.md, in the schema, explained and completed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/drawing/number_text.hpp>

#include "harness.hpp"
#include "input.hpp"
#include "input_page.hpp"
#include "joint_laws.hpp"
#include "key_catalogue.hpp"

namespace keys_test {

using namespace voussoir_test;
using namespace voussoir::program;
using Kind = KeyForm::Kind;

namespace {

bool is_table(const DeclaredKey& key) {
  return key.form.kind == Kind::table || key.form.kind == Kind::tables ||
         key.form.kind == Kind::one_or_more;
}
bool has_numbers(const DeclaredKey& key) {
  return key.form.kind == Kind::quantity || key.form.kind == Kind::number ||
         key.form.kind == Kind::integer;
}

const std::string ground = R"(
[model]
width = "40 m"
below_invert = "12 m"
length = "12 m"
[rock]
density = "2700 kg/m^3"
[stress]
K0 = 1
K0_minor = 0.8
K0_trend = "30 deg"
[blocks]
min_inscribed_radius = "0.4 m"
)";
const std::string joints = R"(
[joint]
kn = "5 GPa/m"
ks = "0.5 GPa/m"
friction = "35 deg"
[[joint_set]]
dip = "60 deg"
dip_direction = "130 deg"
spacing = "2 m"
spacing_law = "lognormal"
spacing_sd = "1 m"
)";
const std::string horseshoe = R"(
[tunnel]
shape = "horseshoe"
width = "8 m"
wall_height = "4 m"
cover = "12 m"
trend = "40 deg"
)";
const std::string supports = R"(
[support.bolts]
length = "3 m"
spacing = "20 deg"
stiffness = "0.2 GN/m"
law = "axial-shear"
shear_stiffness = "0.2 GN/m"
bond_strength = "300 kN/m"
plate_strength = "100 kN"
plate_width = "20 cm"
[support.lining]
thickness = "20 cm"
E = "25 GPa"
interface = { kn = "1 GPa/m", friction = "35 deg", shear_bond = "1 MPa", tensile_bond = "0.5 MPa" }
arc = ["0 deg", "180 deg"]
feet = { stiffness = "2 GPa/m", beam = { depth = "30 cm", E = "30 GPa", spacing = "1 m" } }
concrete = { fck = "30 MPa", adhesion = "0.5 MPa" }
)";
const std::string ribs =
    "ribs = { area = \"34 cm^2\", I = \"864 cm^4\", W = \"144 cm^3\", spacing = \"1 m\", "
    "yield = \"235 MPa\" }\n";
const std::string age = "concrete = { fck = \"30 MPa\", age = \"7 d\", age_law = ";

/// Bolts by their bar.
const std::string spring =
                      "stiffness = \"0.2 GN/m\"\nlaw = \"axial-shear\"\n"
                      "shear_stiffness = \"0.2 GN/m\"\nbond_strength = \"300 kN/m\"\n",
                  cable =
                      "bond_stiffness = \"112 MN/m/m\"\nbond_strength = \"300 kN/m\"\n"
                      "area = \"181 mm^2\"\nyield_force = \"200 kN\"\n"
                      "rupture_elongation = \"5 cm\"\n",
                  end_anchored =
                      "type = \"end-anchored\"\nanchor_stiffness = \"20 MN/m\"\n"
                      "anchor_strength = \"90 kN\"\n";

/// A file, and where the paths in it begin.
struct Base {
  std::string text, directory = ".";
};

/// Files that run, in which between them every key has its place.
std::vector<Base> bases() {
  const std::string examples = VOUSSOIR_TEST_EXAMPLES;
  std::vector<Base> files{
      {ground + joints + horseshoe + supports +
       "[boundary]\nsides = \"elastic\"\nbase = \"elastic\"\nE = \"5 GPa\"\nnu = 0.2\n"
       "[run]\nmethod = \"explicit\"\n[diagram]\nspacing = [\"20 deg\", \"none\"]\n"
       "thickness = [\"0 cm\", \"20 cm\"]\n[criteria]\nconvergence = \"20 mm\"\n"
       "[costs]\nbolt_per_metre = 20\nconcrete_per_m3 = 400\n"},
      {ground + joints + horseshoe + replaced(supports, spring, cable) +
       "[[load]]\nat = [\"0 m\", \"9 m\"]\nforce = [\"1 kN/m\", \"0 kN/m\"]\n"},
      {ground + joints + horseshoe + replaced(supports, spring, end_anchored)},
      {ground + joints + horseshoe + supports + ribs +
       "[[stage]]\nwall_traction = 0.5\n"
       "[[stage]]\nwall_traction = 0\n"},
      {replaced(ground, "width = \"40 m\"", "dimension = 3\nwidth = \"40 m\"") +
       "[joint]\nkn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\nfriction = \"35 deg\"\n[[joint_set]]\n"
       "dip = \"60 deg\"\ndip_direction = \"130 deg\"\nP32 = \"0.5 m^2/m^3\"\nextent = \"4 m\"\n"
       "strike_extent = \"8 m\"\nK = 100\n" +
       horseshoe + "round_length = \"2 m\"\nrounds = 3\n" +
       replaced(replaced(supports,
                         "feet = { stiffness = \"2 GPa/m\", beam = { depth = \"30 cm\", E = "
                         "\"30 GPa\", spacing = \"1 m\" } }\n",
                         "rib_spacing = \"1 m\"\n"),
                "{ fck = \"30 MPa\", adhesion = \"0.5 MPa\" }",
                "{ fck = \"30 MPa\", bars = [{ diameter = \"8 mm\", spacing = \"15 cm\", depth = "
                "\"5 cm\" }] }") +
       "[[round]]\nabove = \"-1 m\"\n[[round]]\nbelow = \"-1 m\"\nbehind = 1\n"
       "[picture]\nfrom = \"face\"\n"},
      {replaced(ground + joints,
                "spacing = \"2 m\"\nspacing_law = \"lognormal\"\nspacing_sd = "
                "\"1 m\"\n",
                "intensity = \"0.1 /m^2\"\nextent = \"4 m\"\nsd = \"5 deg\"\n") +
       "[tunnel]\nshape = \"circle\"\ndiameter = \"6 m\"\ncover = \"10 m\"\ntrend = \"0 deg\"\n"
       "[joints]\nfile = \"traces.csv\"\nfirst_set = 0\nsnap = \"0.1 m\"\n"},
      {replaced(ground, "width = \"40 m\"", "dimension = 3\nwidth = \"60 m\"") + joints +
       horseshoe +
       "round_length = \"2 m\"\n[[opening]]\nshape = \"circle\"\ndiameter = \"4 m\"\n"
       "at = [\"18 m\", \"0 m\"]\nround_length = \"3 m\"\n"
       "[[round]]\n[[round]]\nopening = \"opening 1\"\n"},
      {replaced(ground, "width = \"40 m\"", "width = \"60 m\"") + joints + horseshoe +
       "[[opening]]\nshape = \"horseshoe\"\nwidth = \"4 m\"\nwall_height = \"2 m\"\n"
       "at = [\"18 m\", \"0 m\"]\n[[round]]\n[[round]]\nopening = \"opening 1\"\n"},
      {ground + joints + horseshoe +
       replaced(supports, "concrete = { fck = \"30 MPa\",", age + "\"en1992\",")},
      {ground + joints + horseshoe +
       replaced(supports, "concrete = { fck = \"30 MPa\",",
                age + "\"tested\", tests = [{ age = \"1 d\", fck = \"12 MPa\" }],")},
      {read_file(examples + "/survey/tunnel.toml"), examples + "/survey"},
      {replaced(read_file(examples + "/survey/tunnel.toml"), "orientations = \"joints.csv\"",
                "orientations = \"joints.csv\"\nfile = \"faces.dxf\""),
       examples + "/survey"},
      // A stretch ahead of the last face, of the same section.
      {replaced(read_file(examples + "/survey/tunnel.toml"), "name = \"full face\"\n",
                "name = \"full face\"\nfile = \"section.dxf\"\nlayer = \"PROFILE\"\n") +
           "[[opening]]\nshape = \"polygon\"\nfile = \"section.dxf\"\nlayer = \"PROFILE\"\n"
           "at = [\"0 m\", \"0 m\"]\nplace = \"9 m\"\nfrom = \"0 m\"\nto = \"3 m\"\n"
           "[[round]]\nopening = \"opening 1\"\nbehind = 3\n",
       examples + "/survey"},
      {R"([rock]
density = "2700 kg/m^3"
[joint]
kn = "5 GPa/m"
ks = "0.5 GPa/m"
friction = "35 deg"
[[block]]
vertices = [["0 m", "0 m"], ["2 m", "0 m"], ["2 m", "1 m"], ["0 m", "1 m"]]
fixed = true
[[block]]
vertices = [["0.5 m", "1 m"], ["1.5 m", "1 m"], ["1.5 m", "2 m"], ["0.5 m", "2 m"]]
[[load]]
block = 2
force = ["1 kN/m", "0 kN/m"]
[[displacement]]
block = 1
by = ["1 mm", "0 mm"]
[seismic]
kh = 0.1
[loading]
steps = 2
)"}};
  for (const JointLawRow& row : joint_law_rows()) {
    std::string law = "[joint]\nlaw = \"" + std::string(row.word) + "\"\n",
                set = "[[joint_set]]\ndip = \"60 deg\"\ndip_direction = \"E\"\nspacing = \"2 m\"\n";
    for (const LawParameter& parameter : row.parameters)
      if (!parameter.otherwise && parameter.as.empty()) {
        // In the middle of what is common, of the order of kn where it is a part of that.
        const double middle = std::sqrt(parameter.common_low * parameter.common_high) *
                              (parameter.beside.empty() ? 1 : 1e9);
        const std::string value = voussoir::shortest_text(middle);
        law +=
            std::string(parameter.key) + " = " +
            (parameter.dimension == voussoir::dimension::number
                 ? value
                 : "\"" + value + " " + voussoir::detail::base_units(parameter.dimension) + "\"") +
            "\n";
      }
    files.push_back(
        {replaced(ground, "K0_minor = 0.8\nK0_trend = \"30 deg\"\n", "") + law + set + horseshoe});
  }
  return files;
}

/// As `--set` takes it: an entry of a list by its number.
std::string first_of_lists(std::string key) {
  for (std::size_t at; (at = key.find("[]")) != std::string::npos;) key.insert(at + 1, "0");
  return key;
}

std::string value_text(const DeclaredKey& key, double value) {
  if (key.form.kind == Kind::integer) return std::to_string(static_cast<std::int64_t>(value));
  std::string text = voussoir::shortest_text(value);
  if (key.form.kind == Kind::number || key.form.dimension == voussoir::dimension::number)
    return text;
  return text + " " + voussoir::detail::base_units(key.form.dimension);
}

std::vector<InputError> errors_with(const Base& base, const std::string& key,
                                    const std::string& value) {
  try {
    (void)read_input_text(base.text, "case.toml", base.directory, {key + "=" + value});
  } catch (const InputErrors& errors) {
    return errors.errors();
  }
  return {};
}

/// Whether it was said of the key what it accepts. @param complaint  that is made; empty: any
bool is_refused(const std::vector<InputError>& errors, const std::string& key,
                const std::string& complaint = "") {
  return std::any_of(errors.begin(), errors.end(), [&](const InputError& error) {
    return error.key == key && error.message.find(key) != std::string::npos &&
           error.message.find(complaint) != std::string::npos && !error.accepted.empty();
  });
}

/// Just beyond a bound, in its own digits; whole numbers by one.
double beyond(const DeclaredKey& key, double bound, double sense) {
  if (key.form.kind == Kind::integer) return bound + sense;
  return bound == 0 ? sense * 1e-12 : bound + sense * 1e-9 * std::abs(bound);
}

/// A distribution between two values.
std::string between(const DeclaredKey& key, double low, double high) {
  const auto value = [&](double x) {
    const std::string text = value_text(key, x);
    return text.find(' ') == std::string::npos ? text : "\"" + text + "\"";
  };
  return "{min = " + value(low) + ", max = " + value(high) + "}";
}

/// From end to end of its range, and beyond either.
void try_distributions(const Base& base, const DeclaredKey& declared, const std::string& key) {
  const Range& range = declared.form.range;
  const bool starts = std::isfinite(range.low), ends = std::isfinite(range.high);
  const double low = !starts ? -1 : range.low_included ? range.low : beyond(declared, range.low, 1);
  const double high = !ends                 ? std::max(2 * low, low + 1)
                      : range.high_included ? range.high
                                            : beyond(declared, range.high, -1);
  const auto errors = errors_with(base, key, between(declared, low, high));
  INFO(key, " = ", between(declared, low, high));
  for (const char* const complaint :
       {"reaches", "distribution", ", not a", "outside the accepted range"})
    CHECK_FALSE(is_refused(errors, key, complaint));
  const auto refused = [&](const std::string& value) {
    INFO(key, " = ", value);
    CHECK(is_refused(errors_with(base, key, value), key, "reaches"));
  };
  if (starts)
    refused(between(declared, range.low_included ? beyond(declared, low, -1) : range.low, high));
  if (ends)
    refused(between(declared, low, range.high_included ? beyond(declared, high, 1) : range.high));
}

}  // namespace

TEST_SUITE("program/keys") {
  TEST_CASE("every key with a range or words: at its ends, just beyond, of another kind") {
    std::set<std::string> tried;
    for (const Base& base : bases()) {
      CAPTURE(base.text);
      for (const DeclaredKey& declared : keys_of_readers(base.text)) {
        if (!declared.is_open || tried.contains(declared.key)) continue;
        if (!has_numbers(declared) && declared.form.kind != Kind::word) continue;
        tried.insert(declared.key);
        const std::string key = first_of_lists(declared.key);
        const auto refused = [&](const std::string& value) {
          INFO(key, " = ", value);
          CHECK(is_refused(errors_with(base, key, value), key));
        };
        const auto accepted = [&](const std::string& value) {
          INFO(key, " = ", value);
          // Other keys of the file may make it too much.
          const auto errors = errors_with(base, key, value);
          CHECK_FALSE(is_refused(errors, key, "outside the accepted range"));
          CHECK_FALSE(is_refused(errors, key, "not one of its words"));
          CHECK_FALSE(is_refused(errors, key, ", not a"));
        };
        refused("true");
        if (declared.form.kind == Kind::word) {
          refused("nonsense");
          for (const std::string& word : declared.form.words) accepted(word);
          continue;
        }
        refused("[1, 2]");
        if (declared.form.kind == Kind::quantity) {
          if (declared.form.dimension != voussoir::dimension::number) refused("5");
          refused("5 cd");
        }
        const Range& range = declared.form.range;
        if (declared.form.kind != Kind::integer) try_distributions(base, declared, key);
        if (std::isfinite(range.low)) {
          refused(value_text(declared,
                             range.low_included ? beyond(declared, range.low, -1) : range.low));
          accepted(value_text(declared,
                              range.low_included ? range.low : beyond(declared, range.low, 1)));
        }
        if (std::isfinite(range.high) && range.high < 9e18) {
          refused(value_text(declared,
                             range.high_included ? beyond(declared, range.high, 1) : range.high));
          accepted(value_text(declared,
                              range.high_included ? range.high : beyond(declared, range.high, -1)));
        }
      }
    }
    for (const DeclaredKey& key : key_catalogue()) {
      CAPTURE(key.key);
      std::string in_list = key.key;  // one table in the catalogue, several in a file
      for (const std::string either : {"support.bolts", "support.lining"})
        if (in_list.starts_with(either + ".")) in_list.insert(either.size(), "[]");
      if (has_numbers(key) || key.form.kind == Kind::word)
        CHECK((tried.contains(key.key) || tried.contains(in_list)));
    }
  }

  TEST_CASE("docs/input.md has every key, its range, words and default, and no other key") {
    for (const DeclaredKey& key : key_catalogue()) {
      if (is_table(key)) continue;
      CAPTURE(key.key);
      const auto row = page_row_of(key.key);
      REQUIRE(row.has_value());
      CHECK(!row->cell("default").empty());
      const KeyForm& form = key.form;
      const bool is_bare = form.kind != Kind::quantity;
      if (has_numbers(key) && form.range.high < 9e18 && form.range.low < form.range.high) {
        CAPTURE(row->cell("range"));
        // Whole: "from 1 mm to 10 m" is no part of "from 1 mm to 10 mm".
        const std::string range = form.range.text(is_bare ? nullptr : &form.dimension);
        const std::string cell = row->cell("range") + " ";
        const std::size_t at = cell.find(range);
        REQUIRE(at != std::string::npos);
        CHECK(std::string(" ,;:").find(cell[at + range.size()]) != std::string::npos);
      }
      for (const std::string& word : form.words) {
        CAPTURE(word);
        CHECK(std::any_of(row->cells.begin(), row->cells.end(), [&](const std::string& cell) {
          return cell.find("\"" + word + "\"") != std::string::npos;
        }));
      }
      // Nothing is 0 in any unit, or in words.
      if (form.otherwise.empty() || form.otherwise.starts_with("0 ") ||
          form.otherwise.find("inf") != std::string::npos)
        continue;
      CAPTURE(row->cell("default"));
      CHECK(row->cell("default").find(form.otherwise) != std::string::npos);
    }
    for (const PageRow& row : page_rows()) {
      if (row.tables.empty()) continue;
      CAPTURE(row.heading);
      for (const std::string& name : row.names) {
        CAPTURE(name);
        PageRow alone = row;
        alone.names = {name};
        CHECK(std::any_of(key_catalogue().begin(), key_catalogue().end(),
                          [&](const DeclaredKey& key) { return alone.is_of(key.key); }));
      }
    }
  }

  TEST_CASE("the schema has what the readers have") {
    const Outcome printed = run_program({"schema"});
    REQUIRE(printed.status == 0);
    CHECK(printed.out == schema_json());
    const auto schema = nlohmann::json::parse(printed.out);
    const auto at = [&](const char* path) { return schema.at(nlohmann::json::json_pointer(path)); };
    CHECK(at("/properties/stress/properties/K0/minimum") == 0);
    CHECK(at("/properties/stress/properties/K0/maximum") == 10);
    CHECK(at("/properties/stress/required") == nlohmann::json({"K0"}));
    CHECK(at("/properties/boundary/properties/nu/exclusiveMaximum") == 0.5);
    CHECK(at("/properties/joint_set/items/properties/law/enum").size() == joint_law_rows().size());
    CHECK(at("/properties/model/properties/seed/type") == "integer");
    CHECK(at("/properties/support/properties/bolts/anyOf/1/items/additionalProperties") == false);
    const auto density = at("/properties/rock/properties/density");
    CHECK(density.at("type") == nlohmann::json({"string", "object"}));
    CHECK(density.at("allOf")[0].at("$ref") == "#/definitions/distribution");
    CHECK(at("/definitions/distribution/properties").size() == UncertainKey::names().size());
    CHECK(at("/properties/stress/properties/K0/type") == nlohmann::json({"number", "object"}));
    CHECK(density.at("description").get<std::string>().find("a density, not a unit weight") !=
          std::string::npos);
    // As many leaves as there are keys.
    const auto leaves = [](const nlohmann::json& node, const auto& self) -> std::size_t {
      if (node.contains("anyOf")) return self(node.at("anyOf")[0], self);
      if (node.contains("items")) return self(node.at("items"), self);
      if (!node.contains("properties")) return 1;
      std::size_t sum = 0;
      for (const auto& inner : node.at("properties")) sum += self(inner, self);
      return sum;
    };
    const auto keys = std::count_if(key_catalogue().begin(), key_catalogue().end(),
                                    [](const DeclaredKey& key) { return !is_table(key); });
    CHECK(leaves(schema, leaves) == static_cast<std::size_t>(keys));
  }

  TEST_CASE("explain says what a key, a verdict and an exit status mean") {
    const auto said = [](const char* name) {
      const Outcome outcome = run_program({"explain", name});
      CHECK(outcome.status == 0);
      return outcome.out;
    };
    const auto has = [](const std::string& text, const char* words) {
      INFO(text);
      CHECK(text.find(words) != std::string::npos);
    };
    has(said("stress.K0"), "horizontal / vertical stress in situ");
    has(said("stress.K0"), "a bare number from 0 to 10");
    has(said("joint_set[].dip"), "from the horizontal");
    has(said("joint_set.dip"), "from the horizontal");
    has(said("dip"), "[[joint_set]]");
    has(said("support.bolts.shear_stiffness"), "law = \"axial-shear\"");
    has(said("6"), "stable after rockfall");
    has(said("collapse"), "a quarter of the opening's own area");
    has(said("run.json"), "verdict");
    const std::string limit = said("run.displacement_limit");
    CHECK(limit.find('`') == std::string::npos);
    CHECK(limit.find("](") == std::string::npos);
    has(limit, "by the rock: a fifth of the mean block");
    const Outcome unknown = run_program({"explain", "stress.KO"});
    CHECK(unknown.status == 2);
    has(unknown.err, "did you mean `stress.K0`?");
    CHECK(unknown.out.empty());
    for (const DeclaredKey& key : key_catalogue())
      if (!is_table(key)) CHECK(!explanation(key.key).empty());
  }

  TEST_CASE("a shell completes verbs, options and keys") {
    const Folder folder;
    const Outcome script = run_program({"completion", "bash"});
    REQUIRE(script.status == 0);
    const std::string file = write_file(folder / "completion", script.out);
    const auto completed = [&](const std::string& words, int at) {
      const std::string out = folder / "out";
      const std::string command = "bash -c 'source \"$1\"; COMP_WORDS=(voussoir " + words +
                                  "); COMP_CWORD=" + std::to_string(at) +
                                  "; _voussoir; echo \"${COMPREPLY[*]}\"' - " + file + " > " + out;
      REQUIRE(std::system(command.c_str()) == 0);
      return read_file(out);
    };
    CHECK(completed("dia", 1) == "diagram\n");
    CHECK(completed("run --se", 2) == "--set\n");
    CHECK(completed("run x.toml --set model.gr", 4) == "model.gravity=\n");
    CHECK(completed("run x.toml --set joint_set[0].dip_", 4) == "joint_set[0].dip_direction=\n");
    CHECK(run_program({"completion", "zsh"}).out.find("bashcompinit") != std::string::npos);
    CHECK(run_program({"completion", "fish"}).status == 2);
  }
}

}  // namespace keys_test
