// SPDX-License-Identifier: MIT
#include "blocks_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>
#include <voussoir/core/version.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/blocks_picture.hpp>
#include <voussoir/io/csv_table.hpp>

#include "output_parts.hpp"

namespace voussoir::program {

namespace {

/// What acts between two blocks.
struct ContactForces {
  int a, b;
  Vec2 centre, normal;         ///< of the joint where contacts were last updated; from a to b
  Vec2 at;                     ///< where the force acts; the centre where there is none [m]
  Vec2 force = zeros<Vec2>();  ///< on b [N/m]
  double normal_force = 0, shear_force = 0;  ///< compression, along the tangent on b [N/m]
  JointState<2> state;
};

std::vector<ContactForces> contact_forces(const Tunnel& solver) {
  const auto& system = solver.system();
  const auto& joints = system.joints;
  std::vector<ContactForces> all;
  const std::vector<JointState<2>> states = joint_states(solver);
  for (const auto& c : joints.contacts()) {
    const Vec2 centre = system.pose_at_update(c.a).position + c.arm_a;
    all.push_back({c.a, c.b, centre, c.normal, centre, zeros<Vec2>(), 0, 0, states[all.size()]});
  }
  std::vector<double> moments(all.size(), 0.0);
  const auto* first = joints.contacts().data();
  joints.visit(system.displacement.data(),
               [&](const auto& c, const auto& point, const auto&, const PointForce<2>& force) {
                 const auto k = static_cast<std::size_t>(&c - first);
                 all[k].normal_force += force.normal;
                 all[k].shear_force += force.tangential[0];
                 moments[k] += force.normal * point.offset[1];
               });
  for (std::size_t k = 0; k < all.size(); ++k) {
    ContactForces& c = all[k];
    const Vec2 along = perpendicular(c.normal);
    c.force = c.normal_force * c.normal + c.shear_force * along;
    if (c.normal_force > 0) c.at += moments[k] / c.normal_force * along;
  }
  return all;
}

std::string name_of(const Input& input, int block) {
  return input.laid->blocks[static_cast<std::size_t>(block)].name;
}

std::string shown(const char* format, double value) {
  if (!std::isfinite(value)) {
    std::string without = format;
    const std::size_t at = without.find('%');
    return without.replace(at, without.find_first_of("efg", at) + 1 - at, "not computed");
  }
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

const char* state_of_contact(const ContactForces& c) {
  if (c.state.report.is_open) return "open";
  if (c.state.report.is_slipping) return "slipping";
  return c.state.report.opening > 0 ? "open at an edge" : "closed";
}

double degrees(double angle) { return angle * 180 / std::numbers::pi; }

double turned(const Tunnel& solver, int block) {
  return solver.system().displacement[3 * block + 2];
}

/// "stands", and up to which part of its loading.
std::string verdict_text(const Input& input, const BlocksRun& run) {
  std::string text = run.word();
  if (run.steps.empty()) return text + " under its weight";
  if (run.reached == 1) return text + " under all of its loading";
  const double next = run.reached + 1.0 / input.laid->steps;
  return text + shown(" at %.4g of its loading", next) +
         (run.reached > 0 ? shown("; it stands up to %.4g of it", run.reached) : "");
}

}  // namespace

std::string blocks_run_json(const Input& input, const BlocksRun& run) {
  const LaidInput& laid = *input.laid;
  const auto& system = run.solver.system();
  nlohmann::json fallen = nlohmann::json::array();
  for (const int b : run.solver.fallen()) fallen.push_back(name_of(input, b));
  nlohmann::json stages = nlohmann::json::array();
  stages.push_back({{"name", "weight"}, {"equilibrium", report_json(run.weight)}});
  for (std::size_t k = 0; k < run.steps.size(); ++k)
    stages.push_back({{"name", "loading"},
                      {"part_of_loading", static_cast<double>(k + 1) / laid.steps},
                      {"equilibrium", report_json(run.steps[k])}});
  std::vector<Vec2> force(laid.blocks.size(), zeros<Vec2>());
  std::vector<double> moment(laid.blocks.size(), 0.0);
  for (const ContactForces& c : contact_forces(run.solver))
    for (const auto& [block, sign] : {std::pair{c.a, -1.0}, std::pair{c.b, 1.0}}) {
      const auto k = static_cast<std::size_t>(block);
      force[k] += sign * c.force;
      moment[k] += sign * cross(Vec2(c.at - system.pose(block).position), c.force);
    }
  // What the others exert on it, without its own weight; the moment about its centroid.
  nlohmann::json reactions = nlohmann::json::array();
  for (std::size_t b = 0; b < laid.blocks.size(); ++b)
    if (laid.blocks[b].fixed)
      reactions.push_back({{"block", laid.blocks[b].name},
                           {"force_x_kN_per_m", 1e-3 * force[b].x()},
                           {"force_y_kN_per_m", 1e-3 * force[b].y()},
                           {"moment_kNm_per_m", 1e-3 * moment[b]}});
  nlohmann::json json = {
      {"schema", 1},
      {"program", std::string("voussoir ") + VOUSSOIR_VERSION_STRING},
      {"title", input.title},
      {"models", composition_of(input)},
      {"verdict", run.word()},
      {"reason", run.last().reason},
      {"fallen_blocks", fallen},
      {"fallen_area_m2",
       run.weight.fallen_measure + (run.steps.empty() ? 0.0 : run.steps.back().fallen_measure)},
      {"error_estimate", run.last().error_estimate},
      {"acceptance", acceptance_json(input)},
      {"stages", stages},
      {"loads_on_fixed_blocks", reactions},
      {"blocks",
       {{"count", laid.blocks.size()},
        {"fixed", reactions.size()},
        {"contacts", system.joints.contacts().size()}}},
      {"warnings", run.warnings},
      {"time_s", {{"equilibrium", run.seconds}}}};
  if (!run.steps.empty()) json["stands_up_to_part_of_loading"] = run.reached;
  return run_json_text(input, std::move(json));
}

std::string blocks_csv(const Input& input, const BlocksRun& run) {
  CsvTable table({"block", "x_m", "y_m", "area_m2", "state", "dx_mm", "dy_mm", "rotation_deg"}, 8);
  const auto& system = run.solver.system();
  for (int b = 0; b < run.solver.ground(); ++b) {
    const auto& body = system.body(b);
    const auto k = static_cast<std::size_t>(b);
    const Vec2 moved = run.solver.displacement_of(b, body.centre);
    const double none = std::numeric_limits<double>::quiet_NaN();
    table.add_row(name_of(input, b), body.centre.x(), body.centre.y(),
                  run.solver.mass().bodies[k].properties.measure,
                  body.is_gone ? "fallen" : (body.movable ? "stands" : "fixed"),
                  body.is_gone ? none : 1e3 * moved.x(), body.is_gone ? none : 1e3 * moved.y(),
                  body.is_gone ? none : degrees(turned(run.solver, b)));
  }
  return table.text();
}

std::string contacts_csv(const Input& input, const BlocksRun& run) {
  CsvTable table(
      {"block_a", "block_b", "x_m", "y_m", "length_m", "normal_kN_per_m", "shear_kN_per_m",
       "force_at_x_m", "force_at_y_m", "opening_mm", "slip_mm", "state"},
      8);
  for (const ContactForces& c : contact_forces(run.solver))
    table.add_row(name_of(input, c.a), name_of(input, c.b), c.centre.x(), c.centre.y(),
                  c.state.measure, 1e-3 * c.normal_force, 1e-3 * c.shear_force, c.at.x(), c.at.y(),
                  1e3 * std::max(c.state.report.opening, 0.0), 1e3 * c.state.report.plastic_slip,
                  state_of_contact(c));
  return table.text();
}

std::string laid_blocks_svg(const Input& input, const BlocksRun& run) {
  const auto& system = run.solver.system();
  BlocksPicture picture;
  std::vector<std::vector<Vec2>> fixed;
  for (int b = 0; b < run.solver.ground(); ++b) {
    const auto& body = system.body(b);
    const Pose<2> motion = body.is_gone ? Pose<2>{} : system.motion_of(b);
    std::vector<Vec2> corners;
    for (const Vec2& v : run.solver.mass().bodies[static_cast<std::size_t>(b)].parts[0].vertices())
      corners.push_back(motion(v));
    if (input.laid->blocks[static_cast<std::size_t>(b)].fixed) fixed.push_back(corners);
    const double moved = run.solver.displacement_of(b, body.centre).norm(),
                 area = run.solver.mass().bodies[static_cast<std::size_t>(b)].properties.measure;
    picture.blocks.push_back({std::move(corners), moved, body.is_gone,
                              name_of(input, b) + "\n" +
                                  (body.is_gone ? "fell" : shown("moved %.3g mm", 1e3 * moved)) +
                                  shown("\n%.3g m²", area)});
  }
  const std::vector<ContactForces> contacts = contact_forces(run.solver);
  double largest = 0;
  for (const ContactForces& c : contacts) {
    const Vec2 half = 0.5 * c.state.measure * perpendicular(c.normal);
    const bool opened = c.state.report.is_open || c.state.report.opening > 1e-5;
    if (opened || c.state.report.plastic_slip > 1e-5)
      picture.joints.push_back(
          {c.centre - half, c.centre + half,
           opened ? PictureJoint::State::opened : PictureJoint::State::slipped});
    largest = std::max(largest, c.force.norm());
  }
  for (const BlockLoadInput& load : input.laid->loads) {
    const auto& body = system.body(load.block);
    if (body.is_gone) continue;
    const Vec2 at = load.at ? Vec2((*load.at)[0], (*load.at)[1]) : body.centre;
    PictureLoad& drawn = picture.loads.emplace_back();
    drawn = {system.motion_of(load.block)(at), Vec2(load.force[0], load.force[1]), load.moment};
    drawn.says =
        detail::words_of(drawn) + (load.is_proportional ? "\ncomes on with the loading" : "");
  }
  PictureHeader header;
  header.title = input.title.empty() ? "Blocks" : input.title;
  header.lines = {"Verdict: " + verdict_text(input, run) + ". " + run.last().reason + "."};
  std::vector<Vec2> seen;
  for (const PictureBlock& block : picture.blocks)
    seen.insert(seen.end(), block.corners.begin(), block.corners.end());
  const ViewRect world = bounding_rect(seen).value_or(ViewRect{{0, 0}, {1, 1}});
  // Room for arrows outside of the blocks.
  const double margin = picture.loads.empty() ? 0.02 : 0.1;
  const ViewRect wanted = world.grown(margin * std::max(world.width(), world.height()));
  const double width = picture_width - 2 * picture_margin;
  const double height = std::clamp(width * wanted.height() / wanted.width(), 200.0, 800.0);
  const double top = header.height() + 4;
  const ViewRect frame{{picture_margin, top}, {picture_margin + width, top + height}};
  const PageMap map = PageMap::equal_scales(wanted, frame);
  const detail::DisplacementScale scale(picture.blocks);
  constexpr const char* force_colour = "#0b5d3b";
  std::vector<LegendItem> items{
      {"fixed block", [](SvgCanvas& canvas, const Vec2& c) {
         canvas.rectangle({c - Vec2(12, 6), c + Vec2(12, 6)},
                          {.fill = "url(#fixed)", .stroke = "#444", .stroke_width = 1});
       }}};
  items.push_back(
      {"contact force, largest " + readable_text(1e-3 * largest) + " kN/m, and where it acts",
       [](SvgCanvas& canvas, const Vec2& c) {
         canvas.line(c - Vec2(12, 0), c + Vec2(12, 0), {.stroke = force_colour, .stroke_width = 3});
         canvas.circle(c, 3, {.fill = force_colour});
       }});
  const auto line_item = [&](const char* text, const char* colour, double thickness) {
    items.push_back({text, [=](SvgCanvas& canvas, const Vec2& c) {
                       canvas.line(c - Vec2(12, 0), c + Vec2(12, 0),
                                   {.stroke = colour, .stroke_width = thickness});
                     }});
  };
  line_item("line of thrust", "#111", 1.4);
  line_item("slipped joint", detail::slipped_colour, 1.7);
  line_item("joint open, at an edge at least", detail::opened_colour, 3.1);
  if (!run.solver.fallen().empty())
    items.push_back({"fallen block, where it was", [](SvgCanvas& canvas, const Vec2& c) {
                       canvas.rectangle({c - Vec2(12, 6), c + Vec2(12, 6)},
                                        {.fill = "url(#hatch)", .stroke = detail::fallen_colour});
                     }});
  for (LegendItem& item : detail::loads_legend(picture.loads)) items.push_back(std::move(item));
  const Legend legend(std::move(items), width);
  const double foot = frame.high.y();
  SvgCanvas canvas(picture_width, foot + 74 + legend.height(), picture_printed_width, header.title);
  canvas.hatch_pattern("hatch", detail::fallen_colour, 6, 1.6);
  canvas.hatch_pattern("fixed", "#444", 5, 1);
  header.draw(canvas);
  canvas.begin_layer("blocks");
  detail::draw_blocks(canvas, picture, map, scale, 0.8, 2);
  detail::draw_fallen_blocks(canvas, picture, map);
  for (const auto& corners : fixed)
    canvas.polygon(on_page(corners, map),
                   {.fill = "url(#fixed)", .stroke = "#444", .stroke_width = 1});
  detail::draw_joints(canvas, picture, map, 1.4);
  canvas.end_layer();
  canvas.begin_layer("line-of-thrust");
  for (int b = 0; b < run.solver.ground(); ++b) {
    std::vector<Vec2> on;
    for (const ContactForces& c : contacts)
      if ((c.a == b || c.b == b) && c.normal_force > 0) on.push_back(map(c.at));
    if (on.size() == 2) canvas.polyline(on, {.stroke = "#111", .stroke_width = 1.4});
  }
  canvas.end_layer();
  canvas.begin_layer("contact-forces");
  for (const ContactForces& c : contacts) {
    if (!(c.normal_force > 0)) continue;
    const Vec2 half = 30 / largest * Vec2(c.force.x(), -c.force.y());
    canvas.line(map(c.at) - half, map(c.at) + half, {.stroke = force_colour, .stroke_width = 3});
    canvas.circle(map(c.at), 3, {.fill = force_colour});
  }
  canvas.end_layer();
  if (!picture.loads.empty()) {
    canvas.begin_layer("loads");
    detail::draw_loads(canvas, picture.loads, map);
    canvas.end_layer();
  }
  detail::draw_spots(canvas, picture, map);
  canvas.rectangle(frame, {.stroke = "#111"});
  detail::draw_displacement_bar(
      canvas, {{frame.low.x() + 4, foot + 28}, {frame.low.x() + 324, foot + 41}}, scale);
  draw_scale_bar(canvas, {frame.low.x() + 400, foot + 38}, 200, map.scale());
  legend.draw(canvas, {frame.low.x(), foot + 64});
  return canvas.document();
}

std::string blocks_summary(const Input& input, const BlocksRun& run) {
  const LaidInput& laid = *input.laid;
  std::string out = "models   " + composition_of(input) + "\n";
  const std::size_t contacts = run.solver.system().joints.contacts().size();
  out += "blocks   " + std::to_string(laid.blocks.size()) + ", " + std::to_string(contacts) +
         (contacts == 1 ? " contact\n" : " contacts\n");
  out += std::string("stage    weight: ") + to_string(run.weight.verdict) + "\n";
  if (!run.steps.empty())
    out += "stage    loading: " + std::to_string(run.steps.size()) + " of " +
           std::to_string(laid.steps) + " steps\n";
  out += "verdict  " + verdict_text(input, run) + ": " + run.last().reason + "\n";
  out += shown("         error estimate %.1e", run.last().error_estimate) +
         shown(", worst out-of-balance force ratio %.1e", run.last().unbalance_over_weight) +
         shown(", %.2f s\n", run.seconds);
  if (!run.solver.fallen().empty()) {
    out += "fallen  ";
    for (std::size_t k = 0; k < run.solver.fallen().size() && k < 12; ++k)
      out += (k == 0 ? " " : ", ") + name_of(input, run.solver.fallen()[k]);
    out += run.solver.fallen().size() > 12
               ? ", ... (" + std::to_string(run.solver.fallen().size()) + " in all)\n"
               : "\n";
  }
  int most = -1;
  double farthest = -1;
  for (int b = 0; b < run.solver.ground(); ++b) {
    const auto& body = run.solver.system().body(b);
    const double moved = run.solver.displacement_of(b, body.centre).norm();
    if (body.movable && moved > farthest) {
      farthest = moved;
      most = b;
    }
  }
  if (most >= 0)
    out +=
        "moved    " + name_of(input, most) + " farthest, by " + shown("%.3g mm\n", 1e3 * farthest);
  for (const std::string& warning : run.warnings) out += "warning  " + warning + "\n";
  return out;
}

}  // namespace voussoir::program
