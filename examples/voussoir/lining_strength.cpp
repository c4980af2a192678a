// SPDX-License-Identifier: MIT
#include "lining_strength.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <voussoir/core/units.hpp>
#include <voussoir/design/analysis.hpp>
#include <voussoir/design/bolt_strength.hpp>
#include <voussoir/io/curve_picture.hpp>

#include "output_parts.hpp"

namespace voussoir::program {

namespace {

constexpr Range factor_range{.low = 1, .high = 3};

/// Bars by their diameter and distance: their area per metre of lining.
void read_bars(Section& s, BarLayer& bars, double thickness) {
  double diameter = 0, spacing = 0;
  s.quantity("diameter", diameter, dimension::length, between(1e-3, 0.06), Need::required);
  s.quantity("spacing", spacing, dimension::length, between(0.01, 2), Need::required);
  s.quantity("depth", bars.depth, dimension::length, above(0), Need::required);
  s.quantity("yield", bars.yield_strength, dimension::pressure, between(1e8, 2e9), Need::optional);
  s.quantity("E", bars.modulus, dimension::pressure, between(5e10, 3e11), Need::optional);
  s.number("gamma", bars.partial_factor, factor_range, Need::optional);
  if (s.faulty("diameter") || s.faulty("spacing") || !(spacing > 0)) return;
  bars.area = 0.25 * std::numbers::pi * diameter * diameter / spacing;
  if (spacing < diameter)
    s.complain("spacing", "is less than their diameter", "more than the diameter of the bars");
  if (!s.faulty("depth") && thickness > 0 && !(bars.depth + 0.5 * diameter < thickness))
    s.complain("depth", "is outside of the lining",
               "from its inner face, within " + format_quantity(thickness, dimension::length));
}

double utilisation_of(const NodeUtilisation& node) { return node.use.value; }

/// How old concrete is when it is loaded, and how it grows.
void read_age(Section& s, LiningInput& lining) {
  std::optional<double> loaded;
  s.quantity("age", loaded, dimension::time, between(one_day / 24, 28 * one_day));
  ConcreteAge age;
  s.only_with(loaded.has_value() || s.faulty("age"), "age", [&] {
    const bool law_known = s.choice<AgeLaw>("age_law", age.law,
                                            {{"chang-stille", AgeLaw::chang_stille},
                                             {"en1992", AgeLaw::en1992},
                                             {"tested", AgeLaw::tested}},
                                            Need::optional);
    s.flag("E_grows", age.has_growing_modulus);
    const auto read_cement = [&] {
      s.number("cement", age.cement, between(0.1, 0.5), Need::optional);
    };
    if (law_known)
      s.only_with(age.law == AgeLaw::en1992, "age_law = \"en1992\"", read_cement);
    else
      s.unread(read_cement);
    s.tables("tests", [&](Section& table, std::size_t k) {
      TestedStrength& test = age.tests.emplace_back();
      table.quantity("age", test.age, dimension::time, between(one_day / 240, 28 * one_day),
                     Need::required);
      table.quantity("fck", test.strength, dimension::pressure, between(1e4, 90e6), Need::required);
      if (k == 0 || table.faulty("age") || table.faulty("fck")) return;
      const TestedStrength& before = age.tests[k - 1];
      if (!(test.age > before.age))
        table.complain("age", "is not above that before", "rising ages");
      if (!(test.strength >= before.strength))
        table.complain("fck", "is below that before", "strengths that do not fall");
    });
    if (law_known && (age.law == AgeLaw::tested) == age.tests.empty())
      s.complain(age.tests.empty() ? "age_law" : "tests",
                 age.tests.empty() ? "has no [[support.lining.concrete.tests]]"
                                   : "are of age_law = \"tested\"",
                 "both or neither");
  });
  for (const char* key : {"age", "age_law", "cement", "tests"})
    if (!loaded || s.faulty(key)) return;
  age.when_loaded = *loaded;
  lining.age = age;
}

/// Nothing is left of concrete that is too young.
void check_age(Section& s, const LiningInput& lining) {
  const ConcreteAge& age = *lining.age;
  if (!(age.when_loaded >= age.youngest()))
    return s.complain("age", std::string("is younger than ") + to_string(age.law) + " says",
                      "from " + format_quantity(age.youngest(), dimension::time) + " to 28 d");
  const double strength = age.strength_at(age.when_loaded, lining.concrete->strength);
  if (strength < 1e6)
    s.complain("age",
               "leaves " + format_quantity(strength, dimension::pressure) + " of " +
                   format_quantity(lining.concrete->strength, dimension::pressure) + " by " +
                   to_string(age.law),
               "an age at which 1 MPa is there");
}

}  // namespace

void read_concrete(Section& s, LiningInput& lining) {
  ConcreteSection& concrete = lining.concrete.emplace();
  s.quantity("fck", concrete.strength, dimension::pressure, between(1e6, 90e6), Need::required);
  read_age(s, lining);
  s.number("alpha_cc", concrete.long_term_factor, between(0.5, 1), Need::optional);
  s.number("gamma", concrete.partial_factor, factor_range, Need::optional);
  s.quantity("fctk", concrete.tensile_strength, dimension::pressure, between(1e5, 1e7));
  s.number("alpha_ct", concrete.tensile_factor, between(0.5, 1), Need::optional);
  s.quantity("fibre_strength", concrete.fibre_strength, dimension::pressure, between(0, 2e7),
             Need::optional);
  s.number("gamma_fibre", concrete.fibre_partial_factor, factor_range, Need::optional);
  s.tables("bars", [&](Section& bars, std::size_t) {
    read_bars(bars, concrete.bars.emplace_back(), lining.thickness);
  });
  s.quantity("adhesion", lining.adhesion, dimension::pressure, between(1e3, 1e7));
  s.only_with(lining.adhesion.has_value() || s.faulty("adhesion"), "adhesion", [&] {
    s.quantity("adhesion_width", lining.adhesion_width, dimension::length, between(1e-3, 1),
               Need::optional);
  });
  const bool method_known = s.choice<SectionMethod>(
      "check", concrete.method,
      {{"en1992", SectionMethod::en1992}, {"elastic", SectionMethod::elastic}}, Need::optional);
  const auto read_limit = [&] {
    s.number("largest_eccentricity", concrete.largest_eccentricity, between(0, 0.5),
             Need::optional);
  };
  if (method_known)
    s.only_with(concrete.method == SectionMethod::en1992, "check = \"en1992\"", read_limit);
  else
    s.unread(read_limit);
  if (concrete.largest_eccentricity < 0.5 &&
      (!concrete.bars.empty() || concrete.fibre_strength > 0))
    s.complain("largest_eccentricity", "is of concrete without bars and fibres",
               "no such key, or neither bars nor fibre_strength");
  if (lining.age && !s.faulty("fck")) check_age(s, lining);
}

void read_ribs(Section& s, LiningInput& lining) {
  SteelRibs& ribs = lining.ribs.emplace();
  s.quantity("area", ribs.area, dimension::area, between(1e-5, 1), Need::required);
  s.quantity("I", ribs.second_moment, dimension::second_moment, between(1e-10, 0.1),
             Need::required);
  s.quantity("W", ribs.section_modulus, dimension::section_modulus, between(1e-8, 1),
             Need::required);
  s.quantity("spacing", ribs.spacing, dimension::length, between(0.01, 1000), Need::required);
  s.quantity("yield", ribs.yield_strength, dimension::pressure, between(1e8, 2e9), Need::required);
  s.quantity("E", ribs.modulus, dimension::pressure, between(5e10, 3e11), Need::optional);
  s.number("gamma", ribs.partial_factor, factor_range, Need::optional);
  const double half = ribs.second_moment / ribs.section_modulus;
  if (!s.faulty("I") && !s.faulty("W") && ribs.section_modulus > 0 && lining.thickness > 0 &&
      half > lining.thickness)
    s.complain("W", "makes ribs " + format_quantity(2 * half, dimension::length) + " deep, 2 I / W",
               "ribs within twice the thickness of the lining");
}

double concrete_stress(const LiningInput& lining, const SectionForces& forces) {
  const double t = lining.thickness;
  const SectionForces own =
      lining.ribs ? shared_forces(*lining.ribs, lining.first_modulus(), t, forces, 1).on_concrete
                  : forces;
  return std::abs(own.thrust) / t + 6 * std::abs(own.moment) / (t * t);
}

void add_lining_strength(const Input& input, const LiningStrength& strength,
                         nlohmann::json& lining) {
  const NodeUtilisation* const most = strength.most();
  if (most == nullptr) {
    lining["strength"] = not_checked;
    lining["of_its_strength"] = nullptr;
    return;
  }
  const double width = input.is_spatial() ? strip_width(input) : 1.0;
  lining["strength"] = std::string("thrust and moment by ") + to_string(most->method) +
                       "; shear by EN 1992-1-1, 6.2.2 and 12.6.3" +
                       (most->on_rib ? "; yield of steel ribs" : "");
  lining["of_its_strength"] = number_json(utilisation_of(*most));
  lining["bears_it"] = utilisation_of(*most) <= 1;
  nlohmann::json at = {{"lining", most->lining + 1},
                       {"angle_deg", most->angle * 180 / std::numbers::pi},
                       {"place", lining_place(most->angle)},
                       {"mode", mode_text(*most)},
                       {"thrust_kN_per_m", 1e-3 * most->load.thrust / width},
                       {"moment_kNm_per_m", 1e-3 * most->load.moment / width},
                       {"shear_kN_per_m", 1e-3 * most->load.shear / width}};
  if (input.is_spatial()) at["along_m"] = most->along;
  if (most->on_rib) {
    at["rib_thrust_kN"] = 1e-3 * most->on_rib->thrust;
    at["rib_moment_kNm"] = 1e-3 * most->on_rib->moment;
  }
  if (const StageUtilisation* const stage = governing(strength.history)) {
    at["stage"] = stage->stage;
    at["age_d"] = number_json(stage->age / one_day);
  }
  lining["governing"] = std::move(at);
  for (const StageUtilisation& stage : strength.history)
    lining["by_stage"].push_back({{"stage", stage.stage},
                                  {"age_d", number_json(stage.age / one_day)},
                                  {"of_its_strength", number_json(utilisation_of(stage.most))},
                                  {"governing", governed_by(stage.most)}});
}

std::string lining_strength_line(const Input& input, const LiningStrength& strength) {
  const NodeUtilisation* const most = strength.most();
  if (most == nullptr) return "";
  const double width = input.is_spatial() ? strip_width(input) : 1.0;
  const double value = utilisation_of(*most);
  const StageUtilisation* const stage = governing(strength.history);
  return "         " +
         (std::isinf(value) ? std::string("beyond its strength")
                            : text("%.0f %% of its strength", 100 * value)) +
         (stage != nullptr
              ? " in " + stage->stage +
                    (std::isfinite(stage->age) ? text(", %.3g d old,", stage->age / one_day)
                                               : std::string())
              : std::string()) +
         " at the " + lining_place(most->angle) +
         text(", %.0f deg", most->angle * 180 / std::numbers::pi) +
         (input.is_spatial() ? text(", %.3g m along", most->along) : std::string()) + ": " +
         mode_text(*most) + text(", thrust %.0f kN/m", 1e-3 * most->load.thrust / width) +
         text(", moment %.1f kN m/m", 1e-3 * most->load.moment / width) +
         (most->use.mode == SectionMode::shear
              ? text(", shear force %.0f kN/m", 1e-3 * most->load.shear / width)
              : std::string()) +
         "\n";
}

std::string lining_strength_svg(const Input& input, const LiningStrength& strength) {
  const std::vector<NodeUtilisation>& nodes = strength.nodes;
  const auto installed = linings_as_installed(input, supports_of(input));
  const double width = input.is_spatial() ? strip_width(input) : 1.0;
  const auto place = [&](const SectionForces& forces) {
    return Vec2(1e-3 * forces.moment / width, 1e-3 * forces.thrust / width);
  };
  const auto stages = planned_stages(input, supports_of(input));
  const std::vector<double> ages = lining_ages(stages, stages.size() - 1);
  // Strips of several rounds are drawn in one: what the youngest bears.
  const auto youngest = [&](const LiningInput& lining) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < ages.size(); ++k)
      if (installed[k] == &lining) least = std::min(least, ages[k]);
    return least;
  };
  const char* const colours[] = {"#1f4e79", "#b3541e", "#5b8c3e", "#7a4f9a"};
  CurvePicture picture;
  picture.header.title = input.title.empty() ? "Strength of the lining" : input.title;
  picture.header.lines = {
      "Thrust and moment at every node, and what its section bears of them (" +
      std::string(to_string(governing(nodes)->method)) +
      "). A moment is positive where the outer fibre is in tension; shear is checked besides."};
  if (std::any_of(nodes.begin(), nodes.end(), [](const auto& node) { return node.on_rib; }))
    picture.header.lines.emplace_back(
        "Of linings with steel ribs it is the part of the shotcrete; ribs are checked besides.");
  if (!strength.history.empty())
    picture.header.lines.emplace_back("Concrete as old as when the last stage began.");
  picture.across = "moment [kN m/m]";
  picture.up = "thrust [kN/m], compression positive";
  for (std::size_t k = 0; k < input.linings.size(); ++k) {
    const LiningInput& lining = input.linings[k];
    const auto section = section_of_lining(input, lining, supports_of(input), youngest(lining));
    Curve points{.name = lining.name + ": nodes",
                 .points = {},
                 .colour = colours[k % std::size(colours)],
                 .is_joined = false};
    for (const NodeUtilisation& node : nodes)
      if (installed[static_cast<std::size_t>(node.lining)] == &lining)
        points.points.push_back(place(node.on_section));
    if (points.points.empty() || !section) continue;
    Curve envelope{.name = lining.name + ": strength",
                   .points = {},
                   .colour = colours[k % std::size(colours)],
                   .is_marked = false};
    for (const SectionForces& at : SectionCheck(*section).envelope())
      envelope.points.push_back(place(at));
    envelope.points.push_back(envelope.points.front());
    picture.curves.push_back(std::move(envelope));
    picture.curves.push_back(std::move(points));
  }
  const NodeUtilisation& most = *governing(nodes);
  picture.header.lines.push_back("Most of its strength at the " + lining_place(most.angle) + ": " +
                                 (std::isinf(most.use.value)
                                      ? std::string("beyond it")
                                      : text("%.0f %%", 100 * most.use.value)) +
                                 ", " + mode_text(most) + ".");
  return draw_curve_picture(picture);
}

std::string lining_strength_warning(const LiningStrength& strength) {
  const std::vector<NodeUtilisation>& nodes = strength.nodes;
  const NodeUtilisation* const most = strength.most();
  if (most == nullptr || !(utilisation_of(*most) > 1)) return "";
  const auto over = std::count_if(nodes.begin(), nodes.end(), [](const NodeUtilisation& node) {
    return utilisation_of(node) > 1;
  });
  std::string text = "the lining carries more than its section bears ";
  if (over > 0)
    text += "at " + std::to_string(over) + " of " + std::to_string(nodes.size()) + " nodes, most ";
  if (const StageUtilisation* const stage = governing(strength.history))
    text += "in " + stage->stage + " ";
  return text + "at the " + lining_place(most->angle) + " (" + mode_text(*most) +
         "): it stays elastic in the model, where it would crack or yield";
}

std::vector<double> strength_by_member(const std::vector<MemberForces<3>>& members,
                                       const std::vector<RibForce>& ribs,
                                       const std::vector<NodeUtilisation>& nodes) {
  // Members hold the very places of their nodes.
  const auto place = [](const Vec3& p) { return std::array{p.x(), p.y(), p.z()}; };
  std::map<std::array<double, 3>, std::vector<const NodeUtilisation*>> at;
  for (const NodeUtilisation& node : nodes) at[place(ribs[node.node].position)].push_back(&node);
  std::vector<double> values;
  for (const MemberForces<3>& member : members) {
    double most = std::numeric_limits<double>::quiet_NaN();
    const auto from = at.find(place(member.from)), to = at.find(place(member.to));
    if (from != at.end() && to != at.end())
      for (const NodeUtilisation* a : from->second)
        for (const NodeUtilisation* b : to->second) {
          const double length = length_of(member.to - member.from);
          if (std::abs(a->along - b->along) > 1e-6 * length) continue;
          for (const NodeUtilisation* node : {a, b})
            if (node->lining == member.lining && !(utilisation_of(*node) <= most))
              most = utilisation_of(*node);
        }
    values.push_back(most);
  }
  return values;
}

std::vector<double> strength_by_node(const std::vector<NodeUtilisation>& nodes) {
  std::vector<double> values;
  for (const NodeUtilisation& node : nodes) {
    values.resize(std::max(values.size(), node.node + 1), std::numeric_limits<double>::quiet_NaN());
    values[node.node] = utilisation_of(node);
  }
  return values;
}

}  // namespace voussoir::program
