// SPDX-License-Identifier: MIT
#include "key_catalogue.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <voussoir/core/version.hpp>

#include "distribution_input.hpp"
#include "input_page.hpp"
#include "joint_laws.hpp"

namespace voussoir::program {

namespace {

/// Documents whose readers ask for different things.
std::vector<std::string> asking_documents() {
  std::vector<std::string> documents{
      "schema = 1\n",
      "model.dimension = 3\n",
      "[tunnel]\nshape = \"polygon\"\nfile = \"\"\n[joints]\norientations = \"\"\n",
      "[[opening]]\nshape = \"polygon\"\nfile = \"\"\n[[round]]\nfile = \"\"\n",
      "[joints]\nfile = \"\"\n[[joint_set]]\nintensity = \"1 /m^2\"\n[[joint_set]]\n",
      "support.bolts.type = \"end-anchored\"\n",
      "[support.bolts]\nbond_strength = \"1 kN/m\"\nbond_stiffness = \"1 MPa\"\n",
      "support.bolts.yield_force = \"1 kN\"\n",
      "[[block]]\n[[load]]\nforce = [\"0 N/m\", \"0 N/m\"]\n"};
  for (const JointLawRow& row : joint_law_rows())
    documents.push_back("joint.law = \"" + std::string(row.word) + "\"\n");
  return documents;
}

/// One table or a list of them: the keys are the same.
std::string as_one_table(std::string key, const std::vector<std::string>& either) {
  for (const std::string& table : either)
    if (key.starts_with(table + "[].")) key.erase(table.size(), 2);
  return key;
}

/// More is known of a key where its own reader asks for it than where it does not belong.
void join(DeclaredKey& key, const DeclaredKey& other) {
  using Kind = KeyForm::Kind;
  const bool says_more =
      key.form.kind == Kind::other || key.form.kind == Kind::table || key.form.kind == Kind::tables;
  key.is_required = key.is_required && other.is_required;
  if (key.condition != other.condition && (key.condition.empty() || other.condition.empty()))
    key.condition = says_more && key.form.accepted.empty() ? other.condition : "";
  if (other.form.kind != Kind::other && says_more && other.form.kind > key.form.kind)
    key.form = other.form;
  else if (key.form.accepted.empty())
    key.form.accepted = other.form.accepted;
}

}  // namespace

const std::vector<DeclaredKey>& key_catalogue() {
  static const std::vector<DeclaredKey> catalogue = [] {
    std::map<std::string, DeclaredKey> found;
    for (const std::string& document : asking_documents()) {
      const std::vector<DeclaredKey> keys = keys_of_readers(document);
      std::vector<std::string> either;
      for (const DeclaredKey& key : keys)
        if (key.form.kind == KeyForm::Kind::one_or_more) either.push_back(key.key);
      for (DeclaredKey key : keys) {
        key.key = as_one_table(std::move(key.key), either);
        key.is_open = false;
        const auto [at, is_new] = found.emplace(key.key, key);
        if (!is_new) join(at->second, key);
      }
    }
    std::vector<DeclaredKey> sorted;
    for (auto& [name, key] : found) sorted.push_back(std::move(key));
    return sorted;
  }();
  return catalogue;
}

namespace {

using Json = nlohmann::ordered_json;

/// Where the schema of a key stands; made on the way.
Json& place_of(Json& schema, std::string_view key) {
  Json* at = &schema;
  while (!key.empty()) {
    const std::size_t dot = std::min(key.find('.'), key.size());
    std::string name(key.substr(0, dot));
    key.remove_prefix(std::min(dot + 1, key.size()));
    const bool is_list = name.ends_with("[]");
    if (is_list) name.resize(name.size() - 2);
    at = &(*at)["properties"][name];
    if (is_list) at = &(*at)["items"];
  }
  return *at;
}

void add_bounds(Json& schema, const Range& range) {
  if (std::isfinite(range.low))
    schema[range.low_included ? "minimum" : "exclusiveMinimum"] = range.low;
  if (std::isfinite(range.high) && range.high < 9e15)
    schema[range.high_included ? "maximum" : "exclusiveMaximum"] = range.high;
}

/// What the page says of a key, what to write, on what it depends and what holds without it.
std::string description(const DeclaredKey& key) {
  std::string text;
  const auto add = [&](const std::string& sentence) {
    if (sentence.empty()) return;
    text.append(text.empty() ? "" : "\n").append(sentence);
  };
  if (const auto row = page_row_of(key.key)) add(row->cell("meaning"));
  if (!key.form.accepted.empty()) add("Accepted: " + key.form.accepted);
  if (!key.condition.empty()) add("With " + key.condition);
  if (!key.form.otherwise.empty()) add("Left out: " + key.form.otherwise);
  return text;
}

void describe(Json& schema, const DeclaredKey& key) {
  using Kind = KeyForm::Kind;
  const KeyForm& form = key.form;
  switch (form.kind) {
    case Kind::table:
    case Kind::one_or_more:
      schema["type"] = "object";
      schema["additionalProperties"] = false;
      return;
    case Kind::tables:
      schema["type"] = "array";
      schema["items"]["type"] = "object";
      schema["items"]["additionalProperties"] = false;
      return;
    case Kind::quantity:
      schema["type"] = "string";
      if (form.dimension == dimension::number) schema["type"] = {"number", "string"};
      break;
    case Kind::number:
      schema["type"] = "number";
      add_bounds(schema, form.range);
      break;
    case Kind::integer:
      schema["type"] = "integer";
      add_bounds(schema, form.range);
      break;
    case Kind::word:
      schema["type"] = "string";
      schema["enum"] = form.words;
      break;
    case Kind::text:
      schema["type"] = "string";
      break;
    case Kind::flag:
      schema["type"] = "boolean";
      break;
    case Kind::other:
      break;
  }
  if (const std::string text = description(key); !text.empty()) schema["description"] = text;
  if (form.kind != Kind::quantity && form.kind != Kind::number) return;
  // Bounds are of numbers, and what is referred to is of tables: both stand beside each other.
  if (schema["type"].is_string()) schema["type"] = Json::array({schema["type"]});
  schema["type"].push_back("object");
  schema["allOf"] = Json::array({{{"$ref", "#/definitions/distribution"}}});
}

/// Of a table that stands in place of a number.
Json distribution_schema() {
  Json parts = Json::object();
  for (const std::string& name : UncertainKey::names())
    parts[name] = {{"type", Json::array({"number", "string"})}};
  parts["distribution"] = {{"enum", {"normal", "lognormal", "uniform", "triangular"}}};
  return {
      {"properties", parts}, {"additionalProperties", false}, {"description", distribution_form}};
}

}  // namespace

std::string schema_json() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", std::string("Input file of voussoir ") + VOUSSOIR_VERSION_STRING},
                 {"type", "object"},
                 {"additionalProperties", false},
                 {"definitions", {{"distribution", distribution_schema()}}}};
  for (const DeclaredKey& key : key_catalogue()) {
    describe(place_of(schema, key.key), key);
    const std::size_t dot = key.key.rfind('.');
    if (!key.is_required || !key.condition.empty() || dot == std::string::npos) continue;
    place_of(schema, std::string_view(key.key).substr(0, dot))["required"].push_back(
        key.key.substr(dot + 1));
  }
  for (const DeclaredKey& key : key_catalogue())
    if (key.form.kind == KeyForm::Kind::one_or_more) {
      Json& place = place_of(schema, key.key);
      const Json one = place;
      place = {{"anyOf", {one, {{"type", "array"}, {"items", one}}}}};
    }
  return schema.dump(1) + "\n";
}

}  // namespace voussoir::program
