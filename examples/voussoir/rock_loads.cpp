// SPDX-License-Identifier: MIT
#include "rock_loads.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/design/placed_loads.hpp>
#include <voussoir/tunnel/placed_load.hpp>
namespace voussoir::program {

namespace {

using Json = nlohmann::json;

constexpr Range load_range{.low = -1e12, .high = 1e12};  // [N], [N m], or per metre

/// A list of two or three forces, or of three moments.
void read_list(Section& s, const char* key, const Dimension& dimension, const char* what,
               std::size_t count, const std::string& form, Vec3& out) {
  const auto value = s.find(key, Need::optional, form);
  const auto parts = value ? value->as_list(count, count, form) : std::nullopt;
  for (std::size_t k = 0; parts && k < count; ++k)
    if (const auto part = load_value(parts->at(k), dimension, what, form))
      out[static_cast<Eigen::Index>(k)] = *part;
}

void read_load(Section& s, Input& input) {
  LoadInput& load = input.loads.emplace_back();
  const bool is_spatial = input.is_spatial();
  s.only_with(false, "blocks that are laid", [&] {
    for (const char* const key : {"block", "kind"}) (void)s.find(key, Need::optional);
  });
  if (const auto value = s.find("at", Need::required, point_form))
    load.at = value->as_point().value_or(load.at);
  s.quantity("place", load.place, dimension::length, at_least(0),
             is_spatial ? Need::required : Need::optional);
  if (!is_spatial) note_unused(input, s, "place");
  const std::string force_form =
      is_spatial
          ? R"(three forces, to the right, along the model and up, such as ["0 kN", "0 kN", "-50 kN"])"
          : R"(two forces per metre of tunnel, to the right and up, such as ["10 kN/m", "-5 kN/m"])";
  const std::string moment_form =
      is_spatial ? R"(three moments about these axes, such as ["0 kN m", "5 kN m", "0 kN m"])"
                 : R"(a moment per metre of tunnel, anticlockwise, such as "5 kN m/m")";
  if (is_spatial) {
    read_list(s, "force", dimension::force, "a force", 3, force_form, load.force);
    read_list(s, "moment", dimension::moment, "a moment", 3, moment_form, load.moment);
  } else {
    read_list(s, "force", dimension::stiffness, "a force per metre", 2, force_form, load.force);
    if (const auto value = s.find("moment", Need::optional, moment_form))
      if (const auto moment =
              load_value(*value, dimension::force, "a moment per metre", moment_form))
        load.moment[0] = *moment;
  }
  if (!s.has("force") && !s.has("moment"))
    s.complain("force", "is missing, and so is moment", force_form + ", or " + moment_form);
  KeyForm form = "the name of a [[stage]] or [[round]]";
  form.otherwise = "the last";
  std::vector<std::string> names;
  for (const StageInput& stage : input.stages) names.push_back(stage.name);
  if (const auto value = s.find("stage", Need::optional, form)) {
    if (names.empty())
      value->refuse("names a stage, and the file has none", "no key stage, or [[stage]] tables");
    else if (const auto word = value->as_word(names))
      load.stage = *word;
  }
}

/// Axes of the model, without what is not there.
Json vector_json(const Vec3& values, double unit, bool is_spatial) {
  Json list = Json::array({unit * values[0], unit * values[1]});
  if (is_spatial) list.push_back(unit * values[2]);
  return list;
}

/// A construction that ended before has loaded nothing.
bool has_come_on(const Input& input, const LoadInput& load, std::size_t built) {
  return stage_of(input, load, planned_stages(input, supports_of(input)).size()) < built;
}

template <class Run>
Json loads_of(const Input& input, const Run& run) {
  constexpr int dim = std::decay_t<decltype(run.tunnel)>::dim;
  constexpr bool is_spatial = dim == 3;
  Json list = Json::array();
  for (const LoadInput& load : input.loads) {
    const PlacedLoad<dim> placed = placed_load<dim>(input, load);
    Json& told = list.emplace_back();
    for (int k = 0; k < dim; ++k) told["at_m"].push_back(placed.at[k]);
    told[is_spatial ? "force_kN" : "force_kN_per_m"] = vector_json(load.force, 1e-3, is_spatial);
    if (is_spatial)
      told["moment_kNm"] = vector_json(load.moment, 1e-3, true);
    else
      told["moment_kNm_per_m"] = 1e-3 * load.moment[0];
    told["came_on"] = has_come_on(input, load, run.built.stages.size());
    if (!told["came_on"].template get<bool>()) continue;
    const int block = loaded_block(run.tunnel.mass(), placed);
    told["block"] = block;
    told["came_off"] = run.tunnel.system().body(block).is_gone;
    const Vec<dim> moved = run.tunnel.displacement_of(block, placed.at);
    for (int k = 0; k < dim; ++k) told["displacement_mm"].push_back(1e3 * moved[k]);
  }
  return list;
}

}  // namespace

std::optional<double> load_value(const Value& value, const Dimension& dimension, const char* what,
                                 const std::string& form) {
  if (value.node().kind != Node::Kind::text) {
    value.refuse("has no unit", form);
    return std::nullopt;
  }
  try {
    const Quantity quantity = parse_quantity(value.node().text);
    if (quantity.dimension != dimension)
      value.refuse(std::string("is not ") + what, form);
    else if (!load_range.contains(quantity.value))
      value.refuse("is outside the accepted range", "up to 1e12 N; " + form);
    else
      return quantity.value;
  } catch (const UnitError& error) {
    value.refuse(error.complaint(), form);
  }
  return std::nullopt;
}

void read_rock_loads(Section& file, Input& input) {
  file.tables("load", [&](Section& s, std::size_t) { read_load(s, input); });
  for (const char* key : {"block", "displacement", "seismic", "loading"})
    if (file.find(key, Need::optional))
      file.complain(key, "needs blocks that are laid: blocks that joints cut have no names",
                    "[[block]] or [blocks] file in place of [tunnel]; a [[load]] on a block of a "
                    "tunnel says by `at` which");
}

void check_rock_loads(Checker& checker, const Input& input) {
  if (input.loads.empty()) return;
  for (const char* key : {"model", "tunnel", "opening", "round", "stage", "load"})
    if (checker.faulty(key)) return;
  const auto fault = fault_of_loads(input);
  if (!fault) return;
  const std::string table = "load[" + std::to_string(fault->load) + "]";
  if (fault->is_of_its_stage)
    checker.report(table + ".stage", "cannot take it: " + fault->text,
                   "a stage after the last excavation, or no key stage");
  else
    checker.report(table + ".at", "is no place for it: " + fault->text,
                   "a point of the rock that stays");
}

std::vector<PlacedLoad<2>> loads_in_section(const Input& input, std::size_t built) {
  std::vector<PlacedLoad<2>> loads;
  for (const LoadInput& load : input.loads)
    if (has_come_on(input, load, built)) loads.push_back(placed_load<2>(input, load));
  return loads;
}

Json loads_json(const Input& input, const RunResult& run) { return loads_of(input, run); }
Json loads_json(const Input& input, const SpatialRunResult& run) { return loads_of(input, run); }

}  // namespace voussoir::program
