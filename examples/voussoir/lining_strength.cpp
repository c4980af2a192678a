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

}  // namespace

void read_concrete(Section& s, LiningInput& lining) {
  ConcreteSection& concrete = lining.concrete.emplace();
  s.quantity("fck", concrete.strength, dimension::pressure, between(1e6, 90e6), Need::required);
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
}

void add_lining_strength(const Input& input, const std::vector<NodeUtilisation>& nodes,
                         nlohmann::json& lining) {
  const NodeUtilisation* const most = governing(nodes);
  if (most == nullptr) {
    lining["strength"] = not_checked;
    lining["of_its_strength"] = nullptr;
    return;
  }
  const double width = input.is_spatial() ? strip_width(input) : 1.0;
  lining["strength"] = std::string("thrust and moment by ") + to_string(most->method) +
                       "; shear by EN 1992-1-1, 6.2.2 and 12.6.3";
  lining["of_its_strength"] = number_json(utilisation_of(*most));
  lining["bears_it"] = utilisation_of(*most) <= 1;
  nlohmann::json at = {{"lining", most->lining + 1},
                       {"angle_deg", most->angle * 180 / std::numbers::pi},
                       {"place", lining_place(most->angle)},
                       {"mode", to_string(most->use.mode)},
                       {"thrust_kN_per_m", 1e-3 * most->load.thrust / width},
                       {"moment_kNm_per_m", 1e-3 * most->load.moment / width},
                       {"shear_kN_per_m", 1e-3 * most->load.shear / width}};
  if (input.is_spatial()) at["along_m"] = most->along;
  lining["governing"] = std::move(at);
}

std::string lining_strength_line(const Input& input, const std::vector<NodeUtilisation>& nodes) {
  const NodeUtilisation* const most = governing(nodes);
  if (most == nullptr) return "";
  const double width = input.is_spatial() ? strip_width(input) : 1.0;
  const double value = utilisation_of(*most);
  return "         " +
         (std::isinf(value) ? std::string("beyond its strength")
                            : text("%.0f %% of its strength", 100 * value)) +
         " at the " + lining_place(most->angle) +
         text(", %.0f deg", most->angle * 180 / std::numbers::pi) +
         (input.is_spatial() ? text(", %.3g m along", most->along) : std::string()) + ": " +
         to_string(most->use.mode) + text(", thrust %.0f kN/m", 1e-3 * most->load.thrust / width) +
         text(", moment %.1f kN m/m", 1e-3 * most->load.moment / width) +
         (most->use.mode == SectionMode::shear
              ? text(", shear force %.0f kN/m", 1e-3 * most->load.shear / width)
              : std::string()) +
         "\n";
}

std::string lining_strength_svg(const Input& input, const std::vector<NodeUtilisation>& nodes) {
  const auto installed = linings_as_installed(input, supports_of(input));
  const double width = input.is_spatial() ? strip_width(input) : 1.0;
  const auto place = [&](const SectionForces& forces) {
    return Vec2(1e-3 * forces.moment / width, 1e-3 * forces.thrust / width);
  };
  const char* const colours[] = {"#1f4e79", "#b3541e", "#5b8c3e", "#7a4f9a"};
  CurvePicture picture;
  picture.header.title = input.title.empty() ? "Strength of the lining" : input.title;
  picture.header.lines = {
      "Thrust and moment at every node, and what its section bears of them (" +
      std::string(to_string(governing(nodes)->method)) +
      "). A moment is positive where the outer fibre is in tension; shear is checked besides."};
  picture.across = "moment [kN m/m]";
  picture.up = "thrust [kN/m], compression positive";
  for (std::size_t k = 0; k < input.linings.size(); ++k) {
    const LiningInput& lining = input.linings[k];
    const auto section = section_of_lining(input, lining, supports_of(input));
    Curve points{.name = lining.name + ": nodes",
                 .points = {},
                 .colour = colours[k % std::size(colours)],
                 .is_joined = false};
    for (const NodeUtilisation& node : nodes)
      if (installed[static_cast<std::size_t>(node.lining)] == &lining)
        points.points.push_back(place(node.load));
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
                                 ", " + to_string(most.use.mode) + ".");
  return draw_curve_picture(picture);
}

std::string lining_strength_warning(const std::vector<NodeUtilisation>& nodes) {
  const auto over = std::count_if(nodes.begin(), nodes.end(), [](const NodeUtilisation& node) {
    return utilisation_of(node) > 1;
  });
  if (over == 0) return "";
  const NodeUtilisation& most = *governing(nodes);
  return "the lining carries more than its section bears at " + std::to_string(over) + " of " +
         std::to_string(nodes.size()) + " nodes, most at the " + lining_place(most.angle) + " (" +
         to_string(most.use.mode) +
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
