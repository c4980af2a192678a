// SPDX-License-Identifier: MIT
#include "geojson_traces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>

#include "input_document.hpp"

namespace voussoir::program {

namespace {

using Json = nlohmann::json;

class Reader {
 public:
  Reader(const std::string& name, const Vec2& origin, const TraceFileLimits& limits)
      : name_(name), origin_(origin), limits_(limits) {}

  [[nodiscard]] TraceFile read(std::istream& in) {
    const std::string text(std::istreambuf_iterator<char>(in), {});
    if (text.size() > limits_.bytes)
      fail("is larger than " + std::to_string(limits_.bytes) + " bytes");
    Json json;
    try {
      json = Json::parse(text);
    } catch (const Json::parse_error& error) {
      fail(std::string("is no JSON: ") + error.what());
    }
    if (!json.is_object() || !json.contains("type")) fail("is no GeoJSON: it has no \"type\"");
    check_grid(json);
    if (json.at("type") == "FeatureCollection" && json.contains("features") &&
        json.at("features").is_array()) {
      std::size_t number = 0;
      for (const Json& feature : json.at("features")) add_feature(feature, ++number);
    } else {
      add_feature(json, 1);
    }
    for (const auto& [type, count] : ignored_)
      file_.notes.push_back(std::to_string(count) + " of type " + type +
                            " are no lines and not read");
    if (file_.traces.empty()) fail("has no line strings");
    if (is_within_degrees_ && !is_grid_told_)
      fail(
          "has no reference system, and its coordinates may be degrees: all are within 180 and 90");
    number_sets();
    file_.layout = "line strings of GeoJSON, in metres";
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw InvalidInput("joints.file: " + name_ + " " + why +
                       "\n   = accepted: GeoJSON with LineString or MultiLineString in metres on "
                       "the site grid, its \"crs\" said");
  }
  /// GeoJSON without "crs" is in degrees by its standard; who maps a tunnel exports a grid.
  void check_grid(const Json& json) {
    if (!json.contains("crs")) return;
    const std::string crs = json.at("crs").dump();
    if (crs.find("CRS84") != std::string::npos || crs.find("4326") != std::string::npos)
      fail("is in degrees of latitude and longitude");
    is_grid_told_ = true;
  }
  void add_feature(const Json& feature, std::size_t number) {
    const std::string which = "feature " + std::to_string(number);
    const Json* geometry = &feature;
    if (feature.is_object() && feature.value("type", "") == "Feature") {
      if (!feature.contains("geometry") || feature.at("geometry").is_null()) return;
      geometry = &feature.at("geometry");
    }
    if (!geometry->is_object() || !geometry->contains("type") || !geometry->at("type").is_string())
      fail(which + " has no geometry");
    const auto type = geometry->at("type").get<std::string>();
    const Json properties =
        feature.is_object() ? feature.value("properties", Json::object()) : Json::object();
    if (type != "LineString" && type != "MultiLineString") {
      ++ignored_[type];
      return;
    }
    if (!geometry->contains("coordinates") || !geometry->at("coordinates").is_array())
      fail(which + " has no coordinates");
    const Json& coordinates = geometry->at("coordinates");
    if (type == "LineString")
      add_line(coordinates, properties, which);
    else
      for (const Json& line : coordinates) add_line(line, properties, which);
  }
  void add_line(const Json& line, const Json& properties, const std::string& which) {
    MappedTrace trace;
    if (!line.is_array()) fail(which + " has no list of points");
    for (const Json& point : line) {
      if (!point.is_array() || point.size() < 2 || !point[0].is_number() || !point[1].is_number())
        fail(which + " has a point that is not two numbers: " + point.dump());
      const Vec2 p(point[0].get<double>(), point[1].get<double>());
      if (!p.allFinite()) fail(which + " has a point that is not finite");
      is_within_degrees_ = is_within_degrees_ && std::abs(p.x()) <= 180 && std::abs(p.y()) <= 90;
      trace.points.emplace_back(p - origin_);
    }
    if (trace.points.size() < 2 ||
        std::all_of(trace.points.begin(), trace.points.end(),
                    [&](const Vec2& p) { return p == trace.points.front(); }))
      fail(which + " is a line without length");
    file_.traces.push_back(std::move(trace));
    sets_.push_back(set_in(properties));
    if (file_.traces.size() > limits_.traces)
      fail("has more than " + std::to_string(limits_.traces) + " lines");
  }
  /// As it is written; empty: none.
  [[nodiscard]] static std::string set_in(const Json& properties) {
    if (!properties.is_object()) return "";
    for (const auto& [key, value] : properties.items()) {
      const std::string low = lower_case(key);
      if (low != "set" && low != "joint_set" && low != "jointset" && low != "layer" &&
          low != "name")
        continue;
      if (value.is_string()) return value.get<std::string>();
      if (value.is_number_integer()) return std::to_string(value.get<long long>());
    }
    return "";
  }
  void number_sets() {
    const auto is_number = [](const std::string& text) {
      return !text.empty() && text.size() < 7 &&
             text.find_first_not_of("0123456789") == std::string::npos;
    };
    const auto named = [&](const std::string& text) {
      for (std::size_t k = 0; k < limits_.set_names.size(); ++k)
        if (lower_case(limits_.set_names[k]) == lower_case(text)) return static_cast<int>(k);
      return -1;
    };
    bool has_zero = false;
    for (const std::string& set : sets_)
      has_zero = has_zero || (is_number(set) && std::stoi(set) == 0);
    const int first = limits_.first_set.value_or(has_zero ? 0 : 1);
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const std::string& set = sets_[k];
      if (set.empty()) continue;
      int index = named(set);
      if (index < 0 && is_number(set)) index = std::stoi(set) - first;
      if (index < 0 || (limits_.sets && index >= *limits_.sets))
        throw InvalidInput("joints.file: " + name_ + ": line " + std::to_string(k + 1) +
                           " names the set \"" + set +
                           "\"\n   = accepted: " + detail::accepted_sets(limits_, first));
      file_.traces[k].set = index;
    }
  }

  const std::string& name_;
  Vec2 origin_;
  const TraceFileLimits& limits_;
  TraceFile file_;
  std::vector<std::string> sets_;  ///< of each trace, as it is written
  std::map<std::string, std::size_t> ignored_;
  bool is_within_degrees_ = true, is_grid_told_ = false;
};

}  // namespace

TraceFile geojson_traces(std::istream& in, const std::string& name, const Vec2& site_origin,
                         const TraceFileLimits& limits) {
  return Reader(name, site_origin, limits).read(in);
}

}  // namespace voussoir::program
