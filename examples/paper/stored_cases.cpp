// SPDX-License-Identifier: MIT
#include "stored_cases.hpp"

#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <voussoir/drawing/number_text.hpp>

namespace voussoir::paper {

using Json = nlohmann::ordered_json;

namespace {

constexpr auto replace = Json::error_handler_t::replace;

double number_of(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}
double number_at(const Json& json, const char* key) { return number_of(json.at(key)); }

template <class Enum>
Enum enum_at(const Json& json, const char* key, Enum last) {
  const int value = json.at(key);
  if (value < 0 || value > static_cast<int>(last))
    throw std::runtime_error(std::string("a stored case has no ") + key + " " +
                             std::to_string(value));
  return static_cast<Enum>(value);
}

template <class Read>
auto reading(const std::string& text, const Read& read) {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& error) {
    throw std::runtime_error(std::string("a stored case cannot be read: ") + error.what());
  }
}

template <std::size_t N>
std::array<double, N> numbers_at(const Json& json, const char* key) {
  std::array<double, N> values{};
  for (std::size_t k = 0; k < N; ++k) values[k] = number_of(json.at(key).at(k));
  return values;
}

}  // namespace

std::string case_text(const Variant& v, std::uint64_t seed) {
  std::string text = "tunnel";
  const auto add = [&](const char* name, double value) {
    text += std::string(" ") + name + "=" + shortest_text(value);
  };
  if (v.bolts) {
    const Bolts& b = *v.bolts;
    add("bolts", b.length);
    add("spacing", b.spacing);
    add("from", b.from);
    add("to", b.to);
    add("pretension", b.pretension);
    add("stiffness", b.stiffness);
    add("shear", b.shear_stiffness);
    add("anchors", static_cast<int>(b.anchors));
  }
  if (v.lining) {
    add("lining", v.lining->thickness);
    add("nodes", v.lining->nodes);
    add("interface", v.lining->interface_stiffness);
    add("bending", v.lining->bending_factor);
  }
  add("k0", v.k0);
  add("friction", v.friction);
  add("held", v.held);
  add("at_support", v.held_at_support);
  add("way", static_cast<int>(v.way));
  add("width", v.extent.width);
  add("below", v.extent.below);
  add("tolerance", v.tolerance);
  return text + " seed=" + std::to_string(seed);
}

std::string case_text(const program::PatternCase& the_case, std::uint64_t seed,
                      const program::PatternOptions& options) {
  std::string text = "collapse " + std::to_string(the_case.number);
  for (const double value : {options.cover, options.duration, options.unloading,
                             options.local_damping, options.viscous_damping})
    text.append(" ").append(shortest_text(value));  // g++ 12 warns of a sum here under -O3
  return text + " seed=" + std::to_string(seed);
}

std::string outcome_json(const Outcome& o) {
  Json wall = Json::array(), bolts = Json::array(), lining = Json::array();
  for (const WallMotion& w : o.wall)
    wall.push_back({w.angle, w.length, w.convergence, w.moved.x(), w.moved.y()});
  for (const BoltOutcome& b : o.bolts) {
    Json crossings = Json::array();
    for (const auto& c : b.crossings) crossings.push_back({c.distance, c.force});
    bolts.push_back({b.angle, b.largest, crossings});
  }
  for (const LiningOutcome& l : o.lining) lining.push_back({l.angle, l.thrust, l.moment});
  const EquilibriumReport& r = o.report;
  const Json json = {{"seed", o.seed},
                     {"verdict", static_cast<int>(r.verdict)},
                     {"reason", r.reason},
                     {"error_estimate", r.error_estimate},
                     {"unbalance", r.unbalance_over_weight},
                     {"fallen", r.fallen_measure},
                     {"fallen_blocks", r.fallen},
                     {"lost_nodes", r.lost_nodes},
                     {"convergence",
                      {o.convergence.crown, o.convergence.right_springing,
                       o.convergence.left_springing, o.convergence.invert, o.convergence.rise}},
                     {"mean_convergence", o.mean_convergence},
                     {"boundary_change", o.boundary_change},
                     {"wall", wall},
                     {"bolts", bolts},
                     {"lining", lining}};
  return json.dump(-1, ' ', false, replace);
}

Outcome outcome_from_json(const std::string& text) {
  return reading(text, [](const Json& json) {
    Outcome o;
    o.seed = json.at("seed");
    EquilibriumReport& r = o.report;
    r.verdict = enum_at(json, "verdict", Verdict::undecided);
    r.reason = json.at("reason");
    r.error_estimate = number_at(json, "error_estimate");
    r.unbalance_over_weight = number_at(json, "unbalance");
    r.fallen_measure = number_at(json, "fallen");
    json.at("fallen_blocks").get_to(r.fallen);
    json.at("lost_nodes").get_to(r.lost_nodes);
    const auto c = numbers_at<5>(json, "convergence");
    o.convergence = {c[0], c[1], c[2], c[3], c[4]};
    o.mean_convergence = number_at(json, "mean_convergence");
    o.boundary_change = number_at(json, "boundary_change");
    for (const Json& w : json.at("wall"))
      o.wall.push_back({number_of(w.at(0)), number_of(w.at(1)), number_of(w.at(2)),
                        Vec2(number_of(w.at(3)), number_of(w.at(4)))});
    for (const Json& b : json.at("bolts")) {
      BoltOutcome bolt{number_of(b.at(0)), number_of(b.at(1)), {}};
      for (const Json& c_json : b.at(2))
        bolt.crossings.push_back({number_of(c_json.at(0)), number_of(c_json.at(1))});
      o.bolts.push_back(std::move(bolt));
    }
    for (const Json& l : json.at("lining"))
      o.lining.push_back({number_of(l.at(0)), number_of(l.at(1)), number_of(l.at(2))});
    return o;
  });
}

std::string pattern_json(const program::PatternResult& p) {
  Json stages = Json::array();
  for (const auto& stage : p.stages) {
    Json outlines = Json::array();
    for (const auto& outline : stage.outlines) {
      Json points = Json::array();
      for (const Vec2& v : outline) {
        points.push_back(v.x());
        points.push_back(v.y());
      }
      outlines.push_back(std::move(points));
    }
    Json released = Json::array();
    for (const char is_released : stage.released) released.push_back(is_released != 0 ? 1 : 0);
    stages.push_back({{"time", stage.time}, {"outlines", outlines}, {"released", released}});
  }
  const Json json = {{"number", p.number},
                     {"seed", p.seed},
                     {"blocks", p.blocks},
                     {"time", p.time},
                     {"imbalance", p.imbalance},
                     {"roof_area", p.roof_area},
                     {"wall_area", p.wall_area},
                     {"roof_slides", p.roof_slides},
                     {"wall_slides", p.wall_slides},
                     {"roof_free", p.roof_free},
                     {"toppled", p.toppled},
                     {"bounds", p.bounds},
                     {"height", p.height},
                     {"left_area", p.left_area},
                     {"right_area", p.right_area},
                     {"left_slides", p.left_slides},
                     {"right_slides", p.right_slides},
                     {"by_direction", p.by_direction},
                     {"wall_unevenness", p.wall_unevenness},
                     {"widest_pair", p.widest_pair},
                     {"roof", static_cast<int>(p.roof)},
                     {"wall", static_cast<int>(p.wall)},
                     {"note", p.note},
                     {"stages", stages}};
  return json.dump(-1, ' ', false, replace);
}

program::PatternResult pattern_from_json(const std::string& text) {
  return reading(text, [](const Json& json) {
    program::PatternResult p;
    p.number = json.at("number");
    p.seed = json.at("seed");
    p.blocks = json.at("blocks");
    p.time = number_at(json, "time");
    p.imbalance = number_at(json, "imbalance");
    p.roof_area = number_at(json, "roof_area");
    p.wall_area = number_at(json, "wall_area");
    p.roof_slides = numbers_at<3>(json, "roof_slides");
    p.wall_slides = numbers_at<3>(json, "wall_slides");
    p.roof_free = number_at(json, "roof_free");
    p.toppled = number_at(json, "toppled");
    p.bounds = numbers_at<3>(json, "bounds");
    p.height = number_at(json, "height");
    p.left_area = number_at(json, "left_area");
    p.right_area = number_at(json, "right_area");
    p.left_slides = numbers_at<3>(json, "left_slides");
    p.right_slides = numbers_at<3>(json, "right_slides");
    p.by_direction = numbers_at<8>(json, "by_direction");
    p.wall_unevenness = number_at(json, "wall_unevenness");
    json.at("widest_pair").get_to(p.widest_pair);
    p.roof = enum_at(json, "roof", program::RoofFall::mixed);
    p.wall = enum_at(json, "wall", program::WallFailure::other);
    p.note = json.at("note");
    for (const Json& stage : json.at("stages")) {
      p.stages.push_back({number_at(stage, "time"), {}, {}});
      for (const Json& points : stage.at("outlines")) {
        auto& outline = p.stages.back().outlines.emplace_back();
        for (std::size_t k = 0; k + 1 < points.size(); k += 2)
          outline.emplace_back(number_of(points.at(k)), number_of(points.at(k + 1)));
      }
      for (const Json& released : stage.at("released"))
        p.stages.back().released.push_back(released.get<int>() != 0 ? 1 : 0);
    }
    return p;
  });
}

}  // namespace voussoir::paper
