// SPDX-License-Identifier: MIT
#include "outputs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/units.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/io/csv_table.hpp>
#include <voussoir/io/solved_picture.hpp>
#include <voussoir/io/tunnel_tables.hpp>

#include "bolts_strength.hpp"
#include "lining_strength.hpp"
#include "output_parts.hpp"
#include "rock_loads.hpp"
#include "survey.hpp"

namespace voussoir::program {

namespace {

/// Of the beam under feet, under a rib [N m].
/// @param bearing  of a foot [N/m]
double beam_moment(const FeetInput& feet, double bearing) {
  return feet.on_beam().moment * bearing * feet.beam->spacing * feet.beam->spacing;
}

/// The bolt whose bar is stressed most, in its steel or a bar of the diameter that the anchors
/// have.
struct BarStress {
  double stress = 0;                ///< [Pa]
  double diameter = 0;              ///< [m]
  std::optional<double> area = {};  ///< where it is given [m^2]

  [[nodiscard]] std::string bar() const {
    return area ? text("%.3g mm2", 1e6 * *area) : text("%.3g mm", 1e3 * diameter);
  }
};
BarStress bar_stress(const Input& input, const RunResult& run) {
  const std::vector<double> forces = largest_bolt_forces(run.tunnel);
  const auto patterns = patterns_of_bars(input, bars_of(run.tunnel));
  BarStress most;
  for (std::size_t k = 0; k < patterns.size(); ++k) {
    const double diameter = patterns[k]->diameter,
                 full = 0.25 * std::numbers::pi * diameter * diameter,
                 stress = forces[k] / patterns[k]->area.value_or(full);
    if (most.diameter == 0 || stress > most.stress) most = {stress, diameter, patterns[k]->area};
  }
  return most;
}
/// Of concrete at an edge, the largest of all linings [Pa].
double lining_stress(const Input& input, const RunResult& run) {
  const std::vector<const LiningInput*> linings = linings_as_installed(input, supports_of(input));
  double most = 0;
  for (const LiningForce& at : lining_forces(run.tunnel))
    most = std::max(most, concrete_stress(*linings.at(static_cast<std::size_t>(at.lining)),
                                          {at.thrust, at.moment}));
  return most;
}
/// Which supports nothing says of whether they bear what they carry; empty: none.
std::string strength_line(const Input& input, const RunResult& run) {
  std::string names;
  for (const std::string& name : unchecked_supports(input)) {
    const bool is_there =
        name == "bolts" ? run.tunnel.bolt_count() > 0 : run.tunnel.first_lining_node() >= 0;
    if (!is_there) continue;
    names += (names.empty() ? "" : ", ") + name;
    if (name == "bolts")
      names += text(" (up to %.3g MPa", 1e-6 * bar_stress(input, run).stress) + " in a bar of " +
               bar_stress(input, run).bar() + ")";
    if (name == "lining") names += text(" (up to %.3g MPa)", 1e-6 * lining_stress(input, run));
  }
  return names.empty() ? "" : "strength " + names + ": " + not_checked + "\n";
}

double opening_diameter(const RunResult& run) {
  double low = 0, high = 0;
  for (const Vec2& v : run.opening.vertices()) {
    low = std::min(low, v.x());
    high = std::max(high, v.x());
  }
  return high - low;
}

}  // namespace

namespace {

/// At the opening that is nearest by its centre.
std::string place_of(const Input& input, const Vec2& centre) {
  std::size_t nearest = 0;
  for (std::size_t k = 1; k <= input.openings.size(); ++k)
    if (is_modelled(input, k) && (centre - centre_in_section(input, k)).norm() <
                                     (centre - centre_in_section(input, nearest)).norm())
      nearest = k;
  return place_at(opening_in_section(input, nearest), centre) +
         (nearest > 0 ? " of the " + opening_name(input, nearest) : std::string());
}

nlohmann::json detached_json(const Input& input, const RunResult& run) {
  nlohmann::json blocks = nlohmann::json::array();
  for (const int b : run.tunnel.fallen()) {
    const Vec2 centre = run.tunnel.system().body(b).centre;
    const double area = run.tunnel.mass().bodies[static_cast<std::size_t>(b)].properties.measure;
    blocks.push_back(
        {{"block", b},
         {"x_m", centre.x()},
         {"y_m", centre.y()},
         {"area_m2", area},
         {"weight_kN_per_m", 1e-3 * run.tunnel.in_situ().density * input.model.gravity * area},
         {"from", place_of(input, centre)}});
  }
  return blocks;
}

/// How much rock has come off, where, whether the rest stands without it, and how sure that is.
std::string rockfall_sentence(const Input& input, const RunResult& run) {
  std::map<std::string, int> places;
  double largest = 0;
  for (const int b : run.tunnel.fallen()) {
    ++places[place_of(input, run.tunnel.system().body(b).centre)];
    largest =
        std::max(largest, run.tunnel.mass().bodies[static_cast<std::size_t>(b)].properties.measure);
  }
  const std::size_t count = run.tunnel.fallen().size();
  std::string out = text("%.2f m2 of rock in ", run.fallen_measure()) + std::to_string(count) +
                    (count == 1 ? " block (" : text(" blocks, the largest %.2f m2 (", largest));
  const char* separator = "";
  for (const auto& [place, blocks] : places) {
    out += separator + place + " " + std::to_string(blocks);
    separator = ", ";
  }
  out += ")";
  if (run.verdict() == Verdict::stable) {
    const double tonnes = 1e-3 * run.tunnel.in_situ().density * run.fallen_measure();
    out += std::string("; the rest stands without ") + (count == 1 ? "it" : "them") +
           ": where nothing may fall, scale " + text("%.1f t per metre down or support it", tonnes);
  }
  const std::string margin = margin_text(run.rockfall(), "m2");
  return margin.empty() ? out : out + "; marginal: " + margin;
}

nlohmann::json boundary_json(const ChosenBoundary& boundary) {
  nlohmann::json json = {{"sides", to_string(boundary.field.at(Side::left))},
                         {"base", to_string(boundary.field.at(Side::bottom))},
                         {"top", to_string(boundary.field.at(Side::top))},
                         {"chosen_by_the_program", boundary.is_automatic}};
  if (boundary.bias)
    json["bias_of_closure"] = {{"upright", boundary.bias->upright},
                               {"across", boundary.bias->across}};
  if (boundary.moduli) {
    nlohmann::json rows = nlohmann::json::array();
    for (int i = 0; i < 3; ++i) {
      nlohmann::json row = nlohmann::json::array();
      for (int j = 0; j < 3; ++j) row.push_back(1e-9 * (*boundary.moduli)(i, j));
      rows.push_back(row);
    }
    json["moduli_GPa_xx_yy_xy"] = rows;
  }
  return json;
}

}  // namespace

std::string run_json(const Input& input, const RunResult& run) {
  const SupportDemand e = support_demand(run.tunnel);
  const RockMass<Planar>& mass = run.tunnel.mass();
  const BlockSizes sizes = block_sizes(mass);
  const double diameter = opening_diameter(run);
  const double centre_stress = run.tunnel.in_situ().vertical(mass.domain.depth(Vec2::Zero()));
  nlohmann::json json = {
      {"schema", 1},
      {"program", std::string("voussoir ") + VOUSSOIR_VERSION_STRING},
      {"title", input.title},
      {"models", composition_of(input)},
      {"seed", input.model.seed},
      {"verdict", to_string(run.verdict(), run.fallen_measure(), run.built.has_lost_lining())},
      {"lost_lining", run.built.has_lost_lining()},
      {"error_estimate", run.last().error_estimate},
      {"detached_area_m2", run.fallen_measure()},
      {"detached_blocks", detached_json(input, run)},
      {"convergence", convergence_json(run.convergence())},
      {"boundary", boundary_json(run.boundary)},
      {"acceptance", acceptance_json(input)},
      {"stages", stages_json(run.built.stages, "area_m2")},
      {"tunnel",
       {{"width_m", 2 * input.tunnel.half_width()},
        {"height_m", input.tunnel.crown() - input.tunnel.invert()}}},
      {"rock",
       {{"joints", mass.slicing.joints},
        {"joints_by_source", joints_json(run.joints)},
        {"joints_read", run.joints_read},
        {"joints_in_section", run.in_section},
        {"bodies", sizes.count},
        {"contacts", run.tunnel.system().joints.contacts().size()},
        {"mean_block_area_m2", sizes.mean},
        {"median_block_area_m2", sizes.median},
        {"smallest_block_area_m2", sizes.smallest},
        {"largest_block_area_m2", sizes.largest},
        {"joint_spacing_m", radial_spacing(mass, Vec2::Zero(), 0.5 * diameter, diameter)},
        {"cuts_refused_too_small", mass.slicing.refused_too_small},
        {"cuts_refused_too_long", mass.slicing.refused_too_long},
        {"joints_that_cut_nothing", mass.slicing.unused_joints},
        {"cuts_merged_with_existing_joints", mass.slicing.coincident},
        {"faces_welded_away", mass.slicing.vanished_faces},
        {"pieces_dropped_at_wall", mass.carving.dropped_pieces},
        {"area_dropped_at_wall_m2", mass.carving.dropped_measure},
        {"blocks_separated_by_the_opening", mass.carving.separated_bodies},
        {"vertical_stress_at_centre_kPa", 1e-3 * centre_stress},
        {"in_situ_out_of_balance_force_ratio", run.in_situ_out_of_balance}}},
      {"warnings", run.warnings},
      {"time_s",
       {{"generation", run.generation_seconds}, {"equilibrium", run.equilibrium_seconds}}}};
  if (!input.openings.empty())
    json["openings"] = openings_json(other_convergences(input, run.tunnel));
  if (input.survey) json["survey"] = survey_json(input);
  if (!input.loads.empty()) json["loads"] = loads_json(input, run);
  if (const auto range = run.rockfall()) json["rockfall"] = rockfall_json(*range, "area_m2");
  if (run.tunnel.bolt_count() > 0)
    json["bolts"] = {
        {"strength", strength_json(bolt_strengths(input, run.tunnel))},
        {"of_its_strength", number_json(most_of_bolt_strength(input, run.tunnel))},
        {"largest_stress_in_bar_MPa", 1e-6 * bar_stress(input, run).stress},
        {"count", run.tunnel.bolt_count()},
        {"largest_force_kN", 1e-3 * e.largest_bolt_force},
        {"mean_of_largest_forces_kN", 1e-3 * e.mean_bolt_force},
        {"mean_over_p0_D_and_spacing",
         e.mean_bolt_force / (centre_stress * diameter * input.bolts.front().out_of_plane)}};
  if (run.tunnel.bolt_count() > 0)
    add_bolt_strength(bolt_utilisations(input, run.tunnel), json["bolts"]);
  if (run.tunnel.first_lining_node() >= 0)
    json["lining"] = {{"largest_stress_MPa", 1e-6 * lining_stress(input, run)},
                      {"largest_thrust_kN_per_m", 1e-3 * e.largest_thrust},
                      {"mean_thrust_kN_per_m", 1e-3 * e.mean_thrust},
                      {"largest_moment_kNm_per_m", 1e-3 * e.largest_moment}};
  if (run.tunnel.first_lining_node() >= 0)
    add_lining_strength(input, lining_strength_of(input, run), json["lining"]);
  if (run.bonded_nodes > 0) json["lining"]["nodes_chosen_for_the_bond"] = run.bonded_nodes;
  for (const auto& foot : foot_forces(run.tunnel)) {
    json["lining"]["feet"].push_back({{"x_m", foot.place.x()},
                                      {"y_m", foot.place.y()},
                                      {"bearing_kN_per_m", 1e-3 * foot.bearing},
                                      {"shear_kN_per_m", 1e-3 * foot.shear},
                                      {"of_its_strength", foot.utilisation},
                                      {"settlement_mm", 1e3 * foot.settlement},
                                      {"settlement_that_stays_mm", 1e3 * foot.plastic_settlement}});
    if (std::isnan(foot.utilisation)) json["lining"]["feet"].back()["strength"] = not_checked;
    if (input.linings.front().feet && input.linings.front().feet->beam)
      json["lining"]["feet"].back()["beam_moment_kNm"] =
          1e-3 * beam_moment(*input.linings.front().feet, foot.bearing);
  }
  return run_json_text(input, std::move(json));
}

std::string bolts_csv(const Input& input, const RunResult& run) {
  return bolt_table(bolt_forces(run.tunnel), bars_of(run.tunnel),
                    crossing_strengths(bolt_utilisations(input, run.tunnel)));
}

std::string lining_csv(const Input& input, const RunResult& run) {
  return lining_table(lining_forces(run.tunnel), strength_by_node(lining_utilisations(input, run)));
}

std::string blocks_svg(const Input& input, const RunResult& run) {
  TunnelPictureText text;
  if (!input.title.empty()) text.title = input.title;
  if (input.linings.size() == 1) text.lining_thickness = input.linings.front().thickness;
  if (run.fallen_measure() > 0) {
    text.remarks.push_back(with_superscripts(rockfall_sentence(input, run)));
  }
  if (run.boundary.field.at(Side::bottom) == Boundary::elastic)
    text.remarks.push_back(
        "On elastic ground: convergence is counted against the opening as a whole, which rises by " +
        millimetres_text(run.convergence().rise) + " mm; the colours have that in them.");
  for (const std::string& warning : run.rock_warnings) text.remarks.push_back("Rock: " + warning);
  for (const std::string& load : load_sentences(loads_json(input, run)))
    text.remarks.push_back("Load: " + load + ".");
  text.loads = loads_in_section(input, run.built.stages.size());
  text.bolt_strengths = bolt_strengths(input, run.tunnel);
  text.node_utilisations = strength_by_node(lining_utilisations(input, run));
  return draw_tunnel(run.tunnel, run.built, text);
}

std::string run_summary(const Input& input, const RunResult& run) {
  const SupportDemand e = support_demand(run.tunnel);
  const Convergence c = run.convergence();
  const EquilibriumReport& last = run.last();
  std::string out = "models   " + composition_of(input) + "\n";
  out += "rock     " + std::to_string(run.tunnel.mass().bodies.size()) + " blocks, " +
         std::to_string(run.tunnel.system().joints.contacts().size()) + " contacts, seed " +
         std::to_string(input.model.seed) + text("; generated in %.2f s\n", run.generation_seconds);
  if (!run.joints_read.empty()) out += "traces   " + run.joints_read + "\n";
  if (!input.tunnel.drawn.empty()) out += "outline  " + input.tunnel.drawn + "\n";
  out += survey_lines(input);
  out += joint_lines(run.joints);
  for (const std::string& line : run.in_section) out += "section  " + line + "\n";
  out += "boundary " + boundary_text(run.boundary) + "\n";
  const std::string margin = margin_text(run.rockfall(), "m2");
  out += stage_lines(run.built.stages);
  out += verdict_lines(last, {run.fallen_measure(), "m2", run.built.has_lost_lining(), margin},
                       run.equilibrium_seconds);
  if (run.fallen_measure() > 0)
    out += "detached " + rockfall_sentence(input, run) + "\n";
  else if (!margin.empty())
    out += "marginal " + margin + " come off\n";
  out += "wall     " + convergence_text(c);
  const bool has_gap = !std::isfinite(c.crown + c.right_springing + c.left_springing + c.invert);
  if (run.boundary.field.at(Side::bottom) == Boundary::elastic)
    out += ", against the opening as a whole, which rises by " + millimetres_text(c.rise) + " mm";
  if (has_gap)
    out += run.fallen_measure() > 0 ? " (-: the wall there is detached)"
                                    : " (-: there is no wall there)";
  out += "\n" + opening_lines(other_convergences(input, run.tunnel));
  for (const std::string& load : load_sentences(loads_json(input, run)))
    out += "load     " + load + "\n";
  if (run.tunnel.bolt_count() > 0)
    out += "bolts    " + std::to_string(run.tunnel.bolt_count()) + " with up to " +
           text("%.0f kN", 1e-3 * e.largest_bolt_force) +
           text(", mean of the largest %.0f kN\n", 1e-3 * e.mean_bolt_force) +
           bolt_strength_line(bolt_utilisations(input, run.tunnel));
  if (run.built.has_lost_lining()) out += "lining   came off the wall: it carries nothing\n";
  if (has_standing_lining(run.tunnel))
    out += "lining   thrust up to " + text("%.0f kN/m", 1e-3 * e.largest_thrust) +
           text(" (mean %.0f), ", 1e-3 * e.mean_thrust) +
           text("moment up to %.1f kN m/m\n", 1e-3 * e.largest_moment) +
           lining_strength_line(input, lining_strength_of(input, run));
  if (run.bonded_nodes > 0)
    out += "         " + std::to_string(run.bonded_nodes) + " nodes on the full ring, " +
           text("%.3g m apart, chosen for the bond\n", run.opening.perimeter() / run.bonded_nodes);
  if (const auto feet = foot_forces(run.tunnel); !feet.empty()) {
    out += "feet    ";
    for (const auto& foot : feet)
      out += (&foot == &feet.front() ? " " : ", ") + text("%.0f kN/m", 1e-3 * foot.bearing) +
             (std::isfinite(foot.utilisation)
                  ? text(" (%.0f %% of its strength)", 100 * foot.utilisation)
                  : std::string());
    if (input.linings.front().feet && input.linings.front().feet->beam) {
      const FeetInput& made = *input.linings.front().feet;
      double most = 0;
      for (const auto& foot : feet) most = std::max(most, beam_moment(made, foot.bearing));
      out += text("; beam under ribs %.3g m apart", made.beam->spacing) +
             text(": moment up to %.0f kN m, ", 1e-3 * most) +
             text("rock under a rib pressed by %.2f of the mean", made.on_beam().settlement);
    }
    out += "\n";
  }
  out += strength_line(input, run);
  for (const std::string& warning : run.warnings) out += "warning  " + warning + "\n";
  return out;
}

}  // namespace voussoir::program
