// SPDX-License-Identifier: MIT
#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <voussoir/core/units.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/io/paraview_files.hpp>
#include <voussoir/io/solved_picture.hpp>
#include <voussoir/io/tunnel_tables.hpp>

#include "bolts_strength.hpp"
#include "lining_strength.hpp"
#include "mapped_rock.hpp"
#include "output_parts.hpp"
#include "outputs.hpp"
#include "rock_loads.hpp"
#include "survey.hpp"

// What the program writes of a run in 3-D.
namespace voussoir::program {

namespace {

/// Of the middle third; the whole tunnel where that has no wall.
Convergence shown_convergence(const Input& input, const SpatialRunResult& run) {
  return middle_convergence(input, run.tunnel);
}

/// Of the lining [m]; 0: there is none.
double strip_width_of(const Input& input) {
  return input.linings.empty() ? 0.0 : strip_width(input);
}

double driven_length(const Input& input) { return input.round_count() * input.stretch(); }

/// The axis of the tunnel.
const TunnelAxis& axis_of(const SpatialRunResult& run) {
  return run.built.measured ? run.built.measured->axis()
                            : run.tunnel.mass().openings.front().axis();
}

nlohmann::json detached_json(const Input& input, const SpatialRunResult& run) {
  nlohmann::json blocks = nlohmann::json::array();
  for (const int b : run.tunnel.fallen()) {
    const Vec3 centre = run.tunnel.system().body(b).centre;
    const Vec3 seen = axis_of(run).local(centre);
    const double volume = run.tunnel.mass().bodies[static_cast<std::size_t>(b)].properties.measure;
    blocks.push_back(
        {{"block", b},
         {"x_m", centre.x()},
         {"y_m", centre.y()},
         {"z_m", centre.z()},
         {"volume_m3", volume},
         {"weight_kN", 1e-3 * run.tunnel.in_situ().density * input.model.gravity * volume},
         {"along_m", seen.z()},
         {"from", place_at(opening_of(input), Vec2(seen.x(), seen.y()))}});
  }
  return blocks;
}

std::string rockfall_sentence(const SpatialRunResult& run) {
  double largest = 0;
  for (const int b : run.tunnel.fallen())
    largest =
        std::max(largest, run.tunnel.mass().bodies[static_cast<std::size_t>(b)].properties.measure);
  const std::size_t count = run.tunnel.fallen().size();
  std::string out = text("%.2f m3 of rock in ", run.fallen_measure()) + counted(count, "block");
  if (count > 1) out += text(", the largest %.2f m3", largest);
  if (run.verdict() == Verdict::stable)
    out += std::string("; the rest stands without ") + (count == 1 ? "it" : "them") +
           ": where nothing may fall, scale " +
           text("%.1f t down or support it",
                1e-3 * run.tunnel.in_situ().density * run.fallen_measure());
  const std::string margin = margin_text(run.rockfall(), "m3");
  if (!run.rockfall()) return out + "; whether that is marginal was not looked for";
  return margin.empty() ? out : out + "; marginal: " + margin;
}

}  // namespace

std::string run_json(const Input& input, const SpatialRunResult& run) {
  const SupportDemand e = per_metre(input, support_demand(run.tunnel));
  const RockMass<Spatial>& mass = run.tunnel.mass();
  const BlockSizes sizes = block_sizes(mass);
  const double centre_stress = run.tunnel.in_situ().vertical(mass.domain.depth(Vec3(0, 0, 0)));
  nlohmann::json json = {
      {"schema", 1},
      {"dimension", 3},
      {"program", std::string("voussoir ") + VOUSSOIR_VERSION_STRING},
      {"title", input.title},
      {"models", composition_of(input)},
      {"seed", input.model.seed},
      {"verdict", to_string(run.verdict(), run.fallen_measure(), run.built.has_lost_lining())},
      {"lost_lining", run.built.has_lost_lining()},
      {"error_estimate", run.last().error_estimate},
      {"detached_volume_m3", run.fallen_measure()},
      {"detached_blocks", detached_json(input, run)},
      {"convergence", convergence_json(shown_convergence(input, run))},
      {"convergence_of_the_whole_length", convergence_json(run.convergence())},
      {"boundary", spatial_boundary_text},
      {"acceptance", acceptance_json(input)},
      {"stages", stages_json(run.built.stages, "volume_m3")},
      {"tunnel",
       {{"width_m", 2 * input.tunnel.half_width()},
        {"height_m", input.tunnel.crown() - input.tunnel.invert()},
        {"driven_m", driven_length(input)},
        {"rounds", input.round_count()},
        {"round_length_m", input.stretch()}}},
      {"rock",
       {{"joints", mass.slicing.joints},
        {"joints_by_source", joints_json(run.joints)},
        {"bodies", sizes.count},
        {"contacts", run.tunnel.system().joints.contacts().size()},
        {"mean_block_volume_m3", sizes.mean},
        {"median_block_volume_m3", sizes.median},
        {"smallest_block_volume_m3", sizes.smallest},
        {"largest_block_volume_m3", sizes.largest},
        {"cuts_refused_too_small", mass.slicing.refused_too_small},
        {"cuts_refused_too_long", mass.slicing.refused_too_long},
        {"pieces_dropped_at_wall", mass.carving.dropped_pieces},
        {"volume_dropped_at_wall_m3", mass.carving.dropped_measure},
        {"vertical_stress_at_centre_kPa", 1e-3 * centre_stress},
        {"in_situ_out_of_balance_force_ratio", run.in_situ_out_of_balance}}},
      {"warnings", run.warnings},
      {"time_s",
       {{"generation", run.generation_seconds}, {"equilibrium", run.equilibrium_seconds}}}};
  if (!input.openings.empty())
    json["openings"] = openings_json(other_convergences(input, run.tunnel));
  if (input.survey) json["survey"] = survey_json(input);
  if (!input.loads.empty()) json["loads"] = loads_json(input, run);
  if (const auto range = run.rockfall()) json["rockfall"] = rockfall_json(*range, "volume_m3");
  if (run.tunnel.bolt_count() > 0)
    json["bolts"] = {{"strength", strength_json(bolt_strengths(input, run.tunnel))},
                     {"of_its_strength", number_json(most_of_bolt_strength(input, run.tunnel))},
                     {"count", run.tunnel.bolt_count()},
                     {"largest_force_kN", 1e-3 * e.largest_bolt_force},
                     {"mean_of_largest_forces_kN", 1e-3 * e.mean_bolt_force}};
  if (run.tunnel.bolt_count() > 0)
    add_bolt_strength(bolt_utilisations(input, run.tunnel), json["bolts"]);
  if (run.tunnel.first_lining_node() >= 0)
    json["lining"] = {{"strip_width_m", strip_width(input)},
                      {"largest_thrust_kN_per_m", 1e-3 * e.largest_thrust},
                      {"mean_thrust_kN_per_m", 1e-3 * e.mean_thrust},
                      {"largest_moment_kNm_per_m", 1e-3 * e.largest_moment}};
  if (run.tunnel.first_lining_node() >= 0)
    add_lining_strength(input, lining_strength_of(input, run), json["lining"]);
  for (const auto& foot : foot_forces(run.tunnel))
    json["lining"]["feet"].push_back({{"x_m", foot.place.x()},
                                      {"y_m", foot.place.y()},
                                      {"z_m", foot.place.z()},
                                      {"bearing_kN", 1e-3 * foot.bearing},
                                      {"shear_kN", 1e-3 * foot.shear},
                                      {"of_its_strength", foot.utilisation},
                                      {"settlement_mm", 1e3 * foot.settlement}});
  return run_json_text(input, std::move(json));
}

std::string bolts_csv(const Input& input, const SpatialRunResult& run) {
  return bolt_table(bolt_forces(run.tunnel), bars_of(run.tunnel),
                    crossing_strengths(bolt_utilisations(input, run.tunnel)));
}

std::string lining_csv(const Input& input, const SpatialRunResult& run) {
  const auto members = lining_members(run.tunnel);
  return lining_table(members, strength_by_member(members, rib_forces(run.tunnel),
                                                  lining_utilisations(input, run)));
}

std::string blocks_svg(const Input& input, const SpatialRunResult& run) {
  TunnelPictureText words;
  if (!input.title.empty()) words.title = input.title;
  words.axes = {"right", "along", "up"};
  words.from = input.picture.from;
  words.crown = shown_convergence(input, run).crown;
  words.crown_name = "crown, middle third";
  words.strip_width = strip_width_of(input);
  if (run.fallen_measure() > 0) words.remarks.push_back(with_superscripts(rockfall_sentence(run)));
  for (const std::string& warning : run.rock_warnings) words.remarks.push_back("Rock: " + warning);
  for (const std::string& load : load_sentences(loads_json(input, run)))
    words.remarks.push_back("Load: " + load + ".");
  words.bolt_strengths = bolt_strengths(input, run.tunnel);
  return draw_tunnel(run.tunnel, run.built, words);
}

std::vector<NamedDocument> paraview_files(const Input& input, const SpatialRunResult& run) {
  return voussoir::paraview_files(run.tunnel, strip_width_of(input));
}

HistoryFiles::HistoryFiles(const Input& input, std::function<void(const NamedDocument&)> write)
    : input_(&input), write_(std::move(write)) {}

void HistoryFiles::add(const SpatialTunnel& tunnel) {
  if (!input_->picture.history) return;
  const int stage = static_cast<int>(stages_.size()) + 1;
  std::vector<NamedDocument> files = stage_files(tunnel, stage, strip_width_of(*input_));
  for (NamedDocument& file : files) file.name = folder + ("/" + file.name);
  stages_.push_back({static_cast<double>(stage), files.back().name});
  for (NamedDocument& file : files)
    if (stage == 1)
      first_.push_back(std::move(file));
    else
      write_(file);
  if (stage != 2) return;
  for (const NamedDocument& file : first_) write_(file);
  first_.clear();
}

bool HistoryFiles::finish() {
  if (stages_.size() < 2) return false;
  write_({collection, pvd_document(stages_)});
  return true;
}

std::string run_summary(const Input& input, const SpatialRunResult& run) {
  const SupportDemand e = per_metre(input, support_demand(run.tunnel));
  const Convergence c = shown_convergence(input, run);
  std::string out = "models   " + composition_of(input) + "\n";
  out += "rock     " + std::to_string(run.tunnel.mass().bodies.size()) + " blocks, " +
         std::to_string(run.tunnel.system().joints.contacts().size()) + " contacts, seed " +
         std::to_string(input.model.seed) + text("; generated in %.2f s\n", run.generation_seconds);
  if (!input.tunnel.drawn.empty()) out += "outline  " + input.tunnel.drawn + "\n";
  out += survey_lines(input);
  out += joint_lines(run.joints);
  out += std::string("boundary ") + spatial_boundary_text + "\n";
  out += "tunnel   " + text("%.3g m", driven_length(input)) +
         text(" of %.3g m driven", input.model.length);
  if (input.tunnel.round_length)
    out += " in " + counted(static_cast<std::size_t>(input.round_count()), "round") +
           text(" of %.3g m", input.stretch());
  out += "\n" + stage_lines(run.built.stages, " in the mean of all that is driven");
  const std::string margin = margin_text(run.rockfall(), "m3");
  out +=
      verdict_lines(run.last(), {run.fallen_measure(), "m3", run.built.has_lost_lining(), margin},
                    run.equilibrium_seconds);
  if (run.fallen_measure() > 0)
    out += "detached " + rockfall_sentence(run) + "\n";
  else if (!margin.empty())
    out += "marginal " + margin + " come off\n";
  out += "wall     of the middle third: " + convergence_text(c) + "\n" +
         opening_lines(other_convergences(input, run.tunnel));
  for (const std::string& load : load_sentences(loads_json(input, run)))
    out += "load     " + load + "\n";
  if (run.tunnel.bolt_count() > 0)
    out += "bolts    " + std::to_string(run.tunnel.bolt_count()) + " with up to " +
           text("%.0f kN", 1e-3 * e.largest_bolt_force) +
           text(", mean of the largest %.0f kN\n", 1e-3 * e.mean_bolt_force) +
           bolt_strength_line(bolt_utilisations(input, run.tunnel));
  if (run.built.has_lost_lining()) out += "lining   came off the wall: it carries nothing\n";
  if (has_standing_lining(run.tunnel))
    out += text("lining   strips %.3g m wide: thrust up to ", strip_width(input)) +
           text("%.0f kN/m", 1e-3 * e.largest_thrust) +
           text(" (mean %.0f), ", 1e-3 * e.mean_thrust) +
           text("moment up to %.1f kN m/m\n", 1e-3 * e.largest_moment) +
           lining_strength_line(input, lining_strength_of(input, run));
  std::string names;
  for (const std::string& name : unchecked_supports(input))
    names += (names.empty() ? "" : ", ") + name;
  if (!names.empty()) out += "strength " + names + ": " + not_checked + "\n";
  for (const std::string& warning : run.warnings) out += "warning  " + warning + "\n";
  return out;
}

}  // namespace voussoir::program
