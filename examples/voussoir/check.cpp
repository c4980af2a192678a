// SPDX-License-Identifier: MIT
#include "check.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>
#include <voussoir/core/units.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/blocks_picture.hpp>
#include <voussoir/io/mass_picture.hpp>
#include <voussoir/io/solved_picture.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/statistics.hpp>

#include "boundary.hpp"
#include "construction_plan.hpp"
#include "joint_laws.hpp"
#include "mapped_rock.hpp"
#include "output_parts.hpp"
#include "plausibility.hpp"
#include "spatial_analysis.hpp"
#include "survey.hpp"

namespace voussoir::program {

namespace {

std::string metres(double value) { return significant_text(value, 4) + " m"; }

/// Installs all bolts of the section where the rock is now.
/// @return  how many, and joints that they cross
std::pair<int, int> install_bolts(Tunnel& tunnel, const Input& input) {
  std::pair<int, int> made{0, 0};
  for (const BoltsInput* pattern : input.bolt_patterns())
    for (const Segment& bar : bars_of_pattern(*pattern, pattern->spacing, opening_of(input))) {
      made.second +=
          tunnel.install_bolt(bar, bolt_of(*pattern), pattern->out_of_plane, anchors_of(*pattern));
      ++made.first;
    }
  return made;
}

/// With all taken out that the rounds take out.
Tunnel whole_section(const Input& input, const Tunnel& in_situ) {
  Tunnel whole = in_situ;
  if (input.has_rounds) whole.excavate(opening_of(input), input.blocks.min_wall_area);
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

std::string tunnel_line(const Input& input) {
  const TunnelInput& t = input.tunnel;
  const char* const shapes[] = {"circle", "horseshoe", "outline"};
  std::string text = std::string("tunnel   ") + shapes[static_cast<int>(t.shape)] + " " +
                     metres(2 * t.half_width()) + " wide, " + metres(t.crown() - t.invert()) +
                     " high, " + metres(t.cover) + " under the surface of the model\n";
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
  const double area = opening_of(input).area();
  for (const StageInput& stage : input.stages) {
    out += "stage    " + stage.name + ": ";
    std::vector<std::string> does;
    if (stage.part) {
      const double part = outline_of_part(opening_of(input), *stage.part)->area();
      does.push_back("excavates " + significant_text(part, 3) + " m2" +
                     (part < area * (1 - 1e-9) ? " of " + significant_text(area, 3) : ""));
    }
    const std::vector<const BoltsInput*> patterns = input.bolt_patterns();
    for (const std::size_t k : stage.bolts)
      does.push_back("installs " +
                     (patterns.size() > 1 ? patterns[k]->name : std::string("bolts")));
    for (const std::size_t k : stage.linings)
      does.emplace_back(input.linings().size() > 1 ? "installs " + input.linings()[k]->name
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
  if (input.bolts) check_bolts(input, {input.bolts->spacing});
  CheckedModel model{excavated_rock(input, false, report)};
  if (auto* section = std::get_if<Tunnel>(&model.rock.tunnel)) {
    Tunnel whole = whole_section(input, *section);
    std::tie(model.bolts, model.joints_crossed) = install_bolts(whole, input);
    model.section = std::move(whole);
  } else {
    for (const BoltsInput* pattern : input.bolt_patterns())
      model.bolts += static_cast<int>(bars_of_pattern(input, *pattern, pattern->spacing,
                                                      driven_opening(input, model.rock.opening))
                                          .size());
  }
  model.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  model.warnings = model.rock.warnings;
  for (std::string& text : unusual_values(input)) model.warnings.push_back(std::move(text));
  if (!input.unused.empty()) model.warnings.push_back(input.unused_text());
  if (input.survey && !input.survey->left_out.empty())
    model.warnings.push_back(left_out_text(*input.survey));
  return model;
}

std::string check_text(const Input& input, const CheckedModel& model) {
  std::string out = "models   " + composition_of(input) + "\n" + tunnel_line(input);
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
  out += stage_plan(input);
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
  if (model.section) json["joints_crossed_by_bolts"] = model.joints_crossed;
  if (input.survey) json["survey"] = survey_json(input);
  for (const StageInput& stage : input.stages)
    json["stages"].push_back({{"name", stage.name},
                              {"wall_traction", stage.wall_traction},
                              {"rounds_behind_face", stage.behind},
                              {"duration_d", stage.duration / 86400}});
  return json.dump(2) + "\n";
}

std::string check_svg(const Input& input, const CheckedModel& model) {
  const std::string title = input.title.empty() ? "Tunnel in jointed rock" : input.title;
  const std::string line = "The rock as it is before anything moves: no verdict, no forces.";
  const SimplePolygon outline = opening_of(input);
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
  return draw_mass_picture(carve(tunnel.mass(), driven_opening(input, outline), smallest), picture);
}

}  // namespace voussoir::program
