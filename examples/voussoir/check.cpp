// SPDX-License-Identifier: MIT
#include "check.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>
#include <voussoir/core/units.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/design/boundary.hpp>
#include <voussoir/design/construction_plan.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/blocks_picture.hpp>
#include <voussoir/io/mass_picture.hpp>
#include <voussoir/io/solved_picture.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/statistics.hpp>
#include <voussoir/tunnel/construction_checks.hpp>

#include "joint_laws.hpp"
#include "mapped_rock.hpp"
#include "output_parts.hpp"
#include "plausibility.hpp"
#include "survey.hpp"

namespace voussoir::program {

namespace {

std::string metres(double value) { return significant_text(value, 4) + " m"; }

/// Installs all bolts of the section where the rock is now.
/// @return  how many, and joints that they cross
std::pair<int, int> install_bolts(Tunnel& tunnel, const Input& input) {
  std::pair<int, int> made{0, 0};
  for (const BoltsInput& pattern : input.bolts) {
    if (!is_modelled(input, pattern)) continue;
    for (const Segment& bar : bars_of_pattern(input, pattern, pattern.spacing)) {
      made.second +=
          tunnel.install_bolt(bar, bolt_of(pattern), pattern.out_of_plane, anchors_of(pattern));
      ++made.first;
    }
  }
  return made;
}

/// With all taken out that the rounds take out.
Tunnel whole_section(const Input& input, const Tunnel& in_situ) {
  Tunnel whole = in_situ;
  if (!input.has_rounds) return whole;
  for (std::size_t k = 0; k <= input.openings.size(); ++k)
    if (is_modelled(input, k))
      whole.excavate(opening_in_section(input, k), input.blocks.min_wall_area);
  return whole;
}

template <class Solver>
std::string rock_line(const Solver& tunnel, const char* unit, double seconds) {
  const BlockSizes sizes = block_sizes(tunnel.mass());
  return "rock     " + counted(sizes.count, "block") + " of " +
         significant_text(sizes.smallest, 3) + " to " + significant_text(sizes.largest, 3) + " " +
         unit + ", mean " + significant_text(sizes.mean, 3) + ", " +
         counted(tunnel.system().joints.contacts().size(), "contact") + "; made in " +
         fixed_text(seconds, 2) + " s\n";
}

std::string shape_text(const OutlineInput& outline) {
  const char* const shapes[] = {"circle", "horseshoe", "outline"};
  return std::string(shapes[static_cast<int>(outline.shape)]) + " " +
         metres(2 * outline.half_width()) + " wide, " + metres(outline.crown() - outline.invert()) +
         " high";
}

std::string degrees(double angle) {
  return significant_text(angle * 180 / std::numbers::pi, 3) + " deg";
}

std::string opening_lines(const Input& input) {
  std::string out;
  for (std::size_t k = 1; k <= input.openings.size(); ++k) {
    const OpeningInput& opening = input.openings[k - 1];
    out += "opening  " + opening.name + ": " + shape_text(opening) + ", at " +
           text_of<2>(centre_in_section(input, k)) + " m";
    if (!is_modelled(input, k)) {
      out += ": turns away from the tunnel, and is not in the section";
    } else if (input.is_spatial()) {
      const Drive drive = drive_of(input, k);
      if (opening.turn != 0) out += ", turned by " + degrees(opening.turn);
      if (opening.plunge) out += ", plunging " + degrees(*opening.plunge);
      out += ", " + metres(drive.length()) + " along its axis from " +
             metres(drive.from + (opening.is_along_tunnel(input.tunnel) ? opening.place : 0)) +
             ", in " + counted(static_cast<std::size_t>(drive.count), "round");
    }
    out += "\n";
  }
  return out;
}

std::string tunnel_line(const Input& input) {
  const TunnelInput& t = input.tunnel;
  std::string text =
      "tunnel   " + shape_text(t) + ", " + metres(t.cover) + " under the surface of the model";
  if (t.plunge != 0) text += ", plunging " + degrees(t.plunge);
  text += "\n";
  text += "model    " + metres(input.model.width) + " wide, " +
          metres(input.domain_top() - input.domain_bottom()) + " high";
  if (input.is_spatial()) {
    text += ", " + metres(input.model.length) + " long, of which " +
            metres(input.round_count() * input.stretch()) + " are driven in " +
            counted(static_cast<std::size_t>(input.round_count()), "round") + " of " +
            metres(input.stretch());
  }
  return text + "\n";
}

std::string stress_line(const Input& input) {
  const Stress<3> at_centre = in_situ_of(input).stress<3>(input.domain_top());
  const auto stress = [](double value) { return format_quantity(value, dimension::pressure); };
  std::string text =
      "stress   " + stress(at_centre(2, 2)) + " upright, " + stress(at_centre(0, 0)) + " across";
  if (input.is_spatial()) text += ", " + stress(at_centre(1, 1)) + " along";
  if (input.is_spatial() && input.stress.K0_minor)
    text += ", " + stress(std::abs(at_centre(0, 1))) + " of shear between these";
  return text + ": in situ, at the centre of the tunnel\n";
}

std::string stage_plan(const Input& input) {
  std::string out;
  std::vector<double> taken(input.openings.size() + 1, 0.0);  // of the area of each opening
  for (const StageInput& stage : input.stages) {
    out += "stage    " + stage.name + ": ";
    std::vector<std::string> does;
    if (stage.part) {
      const double area = outline_of(outline_input(input, stage.opening)).area();
      const double part =
          stage.takes_rest ? area - taken[stage.opening] : outline_of_round(input, stage)->area();
      taken[stage.opening] += part;
      does.push_back("excavates " + significant_text(part, 3) + " m2" +
                     (part < area * (1 - 1e-9) ? " of " + significant_text(area, 3) : "") +
                     (stage.opening > 0 ? " of the " + opening_name(input, stage.opening) : ""));
    }
    if (!is_modelled(input, stage.opening)) does.emplace_back("not in the section");
    const std::vector<BoltsInput>& patterns = input.bolts;
    for (const std::size_t k : stage.bolts)
      does.push_back("installs " + (patterns.size() > 1 ? patterns[k].name : std::string("bolts")));
    for (const std::size_t k : stage.linings)
      does.emplace_back(input.linings.size() > 1 ? "installs " + input.linings[k].name
                                                 : std::string("installs the lining"));
    if (input.is_spatial() && input.tunnel.round_length)
      does.push_back(stage.behind == 0 ? std::string("at the face")
                                       : counted(static_cast<std::size_t>(stage.behind), "round") +
                                             " behind the face");
    else
      does.push_back("to " + significant_text(100 * stage.wall_traction, 3) +
                     " % of the wall traction");
    for (const std::string& what : does) out += (&what == &does.front() ? "" : ", ") + what;
    out += "\n";
  }
  return out;
}

}  // namespace

CheckedModel checked_model(const Input& input, const Report& report) {
  const auto start = std::chrono::steady_clock::now();
  check_bolt_ends(input, {supports_of(input).spacing});
  CheckedModel model{rock_in_situ(input, false, report)};
  if (auto* section = std::get_if<Tunnel>(&model.rock.tunnel)) {
    check_construction(construction_of(input, *section, !input.has_rounds, supports_of(input), {},
                                       RangeSought::none),
                       section->mass());
    Tunnel whole = whole_section(input, *section);
    std::tie(model.bolts, model.joints_crossed) = install_bolts(whole, input);
    model.section = std::move(whole);
  } else {
    check_construction(construction_of(input, supports_of(input), {}, RangeSought::none),
                       std::get<SpatialTunnel>(model.rock.tunnel).mass());
    for (const BoltsInput& pattern : input.bolts)
      model.bolts += static_cast<int>(rows_of_pattern(input, pattern, pattern.spacing).size());
  }
  model.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  model.warnings = model.rock.warnings;
  for (std::string& text : unusual_values(input)) model.warnings.push_back(std::move(text));
  if (!input.unused.empty()) model.warnings.push_back(input.unused_text());
  if (!input.uncertain.empty()) model.warnings.push_back(input.uncertain_text());
  if (input.survey && !input.survey->left_out.empty())
    model.warnings.push_back(left_out_text(*input.survey));
  return model;
}

ExpectedCost expected_cost(int dimension, std::size_t blocks) {
  const auto n = static_cast<double>(blocks);
  if (dimension == 2) return {1e7 + 3100 * n, 8e-6 * n, 1.3e-3 * n};
  return {1.5e7 + 9000 * n, 4e-5 * n, 1.7e-2 * n};
}

namespace {

std::size_t block_count(const CheckedModel& model) {
  return std::visit([](const auto& tunnel) { return tunnel.mass().bodies.size(); },
                    model.rock.tunnel);
}

/// Steps at whose end the rock comes to rest.
std::size_t stage_count(const Input& input) {
  if (!input.is_spatial() || !input.tunnel.round_length) return input.stages.size();
  return static_cast<std::size_t>(advance_count(input));
}

std::string cost_line(const Input& input, const CheckedModel& model) {
  const ExpectedCost cost = expected_cost(input.model.dimension, block_count(model));
  const auto two_digits = [](double value) {
    const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
    return shortest_text(unit >= 1 ? unit * std::round(value / unit)
                                   : std::round(value / unit) / (1 / unit));
  };
  const auto seconds = [&](double value) { return two_digits(std::max(value, 0.01)) + " s"; };
  const std::size_t stages = stage_count(input);
  return "expected some " + two_digits(1e-6 * cost.memory) + " MB; " +
         seconds(static_cast<double>(stages) * cost.standing_stage) + " for " +
         counted(stages, "stage") + " while all rock stands, " + seconds(cost.falling_stage) +
         " for one in which rock comes off\n";
}

}  // namespace

std::string check_text(const Input& input, const CheckedModel& model) {
  std::string out =
      "models   " + composition_of(input) + "\n" + tunnel_line(input) + opening_lines(input);
  if (!input.tunnel.drawn.empty()) out += "outline  " + input.tunnel.drawn + "\n";
  out += survey_lines(input);
  if (!model.rock.joints_read.empty()) out += "traces   " + model.rock.joints_read + "\n";
  out += joint_lines(model.rock.joints);
  for (const std::string& line : model.rock.in_section) out += "section  " + line + "\n";
  out += stress_line(input);
  if (const auto* section = std::get_if<Tunnel>(&model.rock.tunnel)) {
    out += rock_line(*section, "m2", model.seconds);
    out += "boundary " + boundary_text(model.rock.boundary) + "\n";
  } else {
    out += rock_line(std::get<SpatialTunnel>(model.rock.tunnel), "m3", model.seconds);
    out += std::string("boundary ") + spatial_boundary_text + "\n";
  }
  if (model.bolts > 0)
    out += "bolts    " + std::to_string(model.bolts) +
           (model.section ? ", which cross " +
                                counted(static_cast<std::size_t>(model.joints_crossed), "joint")
                          : " in all rows") +
           "\n";
  out += stage_plan(input) + cost_line(input, model);
  for (const std::string& warning : model.warnings) out += "warning  " + warning + "\n";
  return out + "checked  the file can be run\n";
}

std::string check_json(const Input& input, const CheckedModel& model) {
  const Stress<3> stress = in_situ_of(input).stress<3>(input.domain_top());
  const bool is_spatial = input.is_spatial();
  nlohmann::json json = {
      {"schema", 1},
      {"program", std::string("voussoir ") + VOUSSOIR_VERSION_STRING},
      {"title", input.title},
      {"dimension", input.model.dimension},
      {"seed", input.model.seed},
      {"models", composition_of(input)},
      {"tunnel",
       {{"width_m", 2 * input.tunnel.half_width()},
        {"height_m", input.tunnel.crown() - input.tunnel.invert()},
        {"area_m2", opening_of(input).area()}}},
      {"stress_at_centre_kPa",
       {{"upright", 1e-3 * stress(2, 2)},
        {"across", 1e-3 * stress(0, 0)},
        {"along", is_spatial ? nlohmann::json(1e-3 * stress(1, 1)) : nlohmann::json()}}},
      {"joints", joints_json(model.rock.joints)},
      {"boundary", is_spatial ? spatial_boundary_text : boundary_text(model.rock.boundary)},
      {"bolts", model.bolts},
      {"stages", nlohmann::json::array()},
      {"warnings", model.warnings}};
  std::visit(
      [&](const auto& tunnel) {
        const BlockSizes sizes = block_sizes(tunnel.mass());
        const std::string measure = is_spatial ? "volume_m3" : "area_m2";
        json["rock"] = {{"blocks", sizes.count},
                        {"contacts", tunnel.system().joints.contacts().size()},
                        {"smallest_block_" + measure, sizes.smallest},
                        {"mean_block_" + measure, sizes.mean},
                        {"largest_block_" + measure, sizes.largest}};
      },
      model.rock.tunnel);
  const ExpectedCost cost = expected_cost(input.model.dimension, block_count(model));
  json["expected"] = {{"memory_MB", 1e-6 * cost.memory},
                      {"stages", stage_count(input)},
                      {"time_s_of_a_stage_that_stands", cost.standing_stage},
                      {"time_s_of_a_stage_with_rockfall", cost.falling_stage}};
  if (model.section) json["joints_crossed_by_bolts"] = model.joints_crossed;
  if (input.survey) json["survey"] = survey_json(input);
  for (const StageInput& stage : input.stages)
    json["stages"].push_back({{"name", stage.name},
                              {"wall_traction", stage.wall_traction},
                              {"opening", opening_name(input, stage.opening)},
                              {"rounds_behind_face", stage.behind},
                              {"duration_d", stage.duration / 86400}});
  return json.dump(2) + "\n";
}

std::string check_svg(const Input& input, const CheckedModel& model) {
  const std::string title = input.title.empty() ? "Tunnel in jointed rock" : input.title;
  const std::string line = "The rock as it is before anything moves: no verdict, no forces.";
  if (model.section) {
    BlocksPicture picture =
        picture_of(state_of(*model.section), model.section->mass(), bars_of(*model.section), 0.0);
    for (PictureBlock& block : picture.blocks)
      block.displacement = std::numeric_limits<double>::quiet_NaN();
    for (PictureBolt& bolt : picture.bolts) bolt.crossings.clear();  // nothing pulls yet
    picture.header.title = title;
    picture.header.lines = {line};
    return draw_blocks_picture(picture);
  }
  const auto& tunnel = std::get<SpatialTunnel>(model.rock.tunnel);
  MassPicture picture;
  picture.header.title = title;
  picture.header.lines = {line};
  picture.axes = {"right", "along", "up"};
  picture.y_azimuth = input.tunnel.trend.value_or(0);
  for (const JointSetInput& set : input.joint_sets) picture.set_names.push_back(set.name);
  if (!input.has_rounds) return draw_mass_picture(tunnel.mass(), picture);
  const double smallest = input.blocks.min_wall_area * std::sqrt(input.blocks.min_wall_area);
  RockMass<Spatial> mass = tunnel.mass();
  for (std::size_t k = 0; k <= input.openings.size(); ++k)
    mass = carve(std::move(mass), opening_in_space(input, k, outline_of(outline_input(input, k))),
                 smallest);
  return draw_mass_picture(mass, picture);
}

}  // namespace voussoir::program
