// SPDX-License-Identifier: MIT
#include "run_diff.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/operating_system.hpp>

#include "regular_file.hpp"

namespace voussoir::program {

namespace {

using Json = nlohmann::json;

/// run.json by its keys, "convergence.crown_mm", "stages[0].verdict".
std::map<std::string, Json> leaves_of(const std::string& place) {
  std::filesystem::path path = utf8_path(place);
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) path /= "run.json";
  std::ifstream file;
  if (const std::string fault = open_regular(path, file); !fault.empty())
    throw InvalidInput(utf8_text(path) + " " + fault +
                       "\n   = accepted: two folders of results of voussoir run");
  const Json json =
      Json::parse(std::string(std::istreambuf_iterator<char>(file), {}), nullptr, false);
  if (!json.is_object() || !json.contains("verdict"))
    throw InvalidInput(utf8_text(path) +
                       " is no run.json\n   = accepted: two folders of results of voussoir run");
  std::map<std::string, Json> leaves;
  const Json flat = json.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    std::string key;
    for (std::size_t k = 1; k < pointer.size(); ++k) {
      const std::size_t end = std::min(pointer.find('/', k), pointer.size());
      const std::string part = pointer.substr(k, end - k);
      const bool is_index = part.find_first_not_of("0123456789") == std::string::npos;
      key += is_index ? "[" + part + "]" : (key.empty() ? "" : ".") + part;
      k = end;
    }
    // A hash differs where anything does, and says no more; what was read is shown key by key.
    if (key != "run_id" && key != "result_hash" && key != "input.hash" && key != "input.file" &&
        !key.starts_with("build.") && !key.starts_with("time_s"))
      leaves[key] = value;
  }
  return leaves;
}

std::string shown(const Json* value) {
  if (value == nullptr) return "-";
  if (value->is_number_float()) return significant_text(value->get<double>(), 5);
  if (value->is_string()) {
    const auto& text = value->get_ref<const std::string&>();
    return text.size() <= 40 ? text : text.substr(0, 37) + "...";
  }
  return value->dump();
}

/// Empty where there is no number to compare.
std::string change(const Json* from, const Json* to) {
  if (from == nullptr || to == nullptr || !from->is_number() || !to->is_number()) return "";
  const double a = from->get<double>(), b = to->get<double>();
  if (a == 0) return "";
  const double percent = 100 * (b - a) / std::abs(a);
  std::string text = percent > 0 ? "+" : "";
  return text.append(significant_text(percent, 3)).append(" %");
}

bool is_same(const Json& a, const Json& b) {
  if (a.is_number() && b.is_number()) {
    const double x = a.get<double>(), y = b.get<double>();
    return std::abs(x - y) <= 1e-9 * std::max(std::abs(x), std::abs(y));
  }
  return a == b;
}

}  // namespace

std::string run_diff(const std::string& first, const std::string& second) {
  const std::map<std::string, Json> a = leaves_of(first), b = leaves_of(second);
  std::vector<std::string> keys;
  for (const auto& [key, value] : a) keys.push_back(key);
  for (const auto& [key, value] : b)
    if (!a.contains(key)) keys.push_back(key);
  // What an engineer asks first comes first.
  const std::vector<std::string_view> order{"verdict",  "reason", "convergence",
                                            "detached", "bolts",  "lining"};
  const auto rank = [&](const std::string& key) {
    return std::find_if(order.begin(), order.end(),
                        [&](std::string_view group) { return key.starts_with(group); }) -
           order.begin();
  };
  std::stable_sort(keys.begin(), keys.end(), [&](const std::string& x, const std::string& y) {
    return rank(x) != rank(y) ? rank(x) < rank(y) : x < y;
  });
  struct Row {
    std::string key, from, to, by;
  };
  std::vector<Row> rows;
  for (const std::string& key : keys) {
    const auto in_a = a.find(key), in_b = b.find(key);
    const Json *from = in_a == a.end() ? nullptr : &in_a->second,
               *to = in_b == b.end() ? nullptr : &in_b->second;
    if (from != nullptr && to != nullptr && is_same(*from, *to)) continue;
    rows.push_back({key, shown(from), shown(to), change(from, to)});
  }
  if (rows.empty()) return "the runs are the same\n";
  std::size_t wide[3] = {0, 0, 0};
  for (const Row& row : rows) {
    wide[0] = std::max(wide[0], row.key.size());
    wide[1] = std::max(wide[1], row.from.size());
    wide[2] = std::max(wide[2], row.to.size());
  }
  std::string out;
  for (const Row& row : rows) {
    out += row.key + std::string(wide[0] + 2 - row.key.size(), ' ') + row.from +
           std::string(wide[1] + 2 - row.from.size(), ' ') + row.to;
    if (!row.by.empty()) out += std::string(wide[2] + 2 - row.to.size(), ' ') + row.by;
    out += "\n";
  }
  return out;
}

}  // namespace voussoir::program
