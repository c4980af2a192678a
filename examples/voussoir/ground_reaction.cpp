// SPDX-License-Identifier: MIT
#include "ground_reaction.hpp"

#include <algorithm>
#include <cmath>
#include <voussoir/core/units.hpp>
#include <voussoir/design/construction_plan.hpp>
#include <voussoir/io/csv_table.hpp>
#include <voussoir/io/curve_picture.hpp>
#include <voussoir/io/solved_picture.hpp>

#include "output_parts.hpp"

namespace voussoir::program {

namespace {

std::vector<ReactionPoint> points_of(const ConstructionResult<Planar>& built) {
  std::vector<ReactionPoint> points;
  double fallen = built.fallen_before;
  for (const StageResult& stage : built.stages) {
    fallen += stage.fallen_measure();
    points.push_back({stage.name, stage.wall_traction, stage.convergence, stage.last().verdict,
                      fallen, stage.last().lacks_lining});
  }
  return points;
}

/// The file without its supports, the section out at once and its wall unloaded in even steps.
Input bare(const Input& input, int steps) {
  Input made = input;
  made.bolts.clear();
  made.linings.clear();
  made.has_rounds = false;
  made.openings.clear();
  made.stages.clear();
  for (int k = 1; k <= steps; ++k) {
    StageInput& stage = made.stages.emplace_back();
    stage.wall_traction = 1.0 - static_cast<double>(k) / steps;
    stage.name = format_quantity(stage.wall_traction, dimension::number);
    if (k == 1) stage.part = SectionPart{};
  }
  return made;
}

/// Between two points of the ground; none beyond its ends, or where it is loose.
std::optional<double> traction_at(const std::vector<ReactionPoint>& ground, double crown) {
  double before = 1, from = 0;
  for (const ReactionPoint& point : ground) {
    const double to = point.convergence.crown;
    if (point.verdict != Verdict::stable || point.fallen > 0 || !std::isfinite(to)) break;
    if (crown >= from && crown <= to && to > from)
      return before + (point.traction - before) * (crown - from) / (to - from);
    before = point.traction;
    from = to;
  }
  return std::nullopt;
}

double percent(double part) { return 100 * part; }
double millimetres(double length) { return 1e3 * length; }

std::string word_of(const ReactionPoint& point) {
  return to_string(point.verdict, point.fallen, point.lost_lining);
}

}  // namespace

GroundReaction ground_reaction(const Input& given, int steps, const Report& report) {
  // Loads act on single blocks, and come on with stages that the bare rock does not have.
  Input input = given;
  input.loads.clear();
  GroundReaction reaction;
  const RunResult alone = run_of(bare(input, steps), report);
  reaction.ground = points_of(alone.built);
  reaction.warnings = alone.rock_warnings;
  if (!input.uncertain.empty()) reaction.warnings.push_back(input.uncertain_text());
  if (!given.loads.empty())
    reaction.warnings.emplace_back(
        "[[load]] is left out, with and without support: a ground reaction is of the rock alone; "
        "`run` knows loads");
  if (input.has_rounds)
    reaction.warnings.emplace_back(
        "the rock without support is taken out at once, not in the rounds of the file");
  if (!input.openings.empty())
    reaction.warnings.emplace_back("the rock without support has the tunnel alone in it");
  reaction.stress =
      alone.tunnel.in_situ().vertical(alone.tunnel.mass().domain.depth(zeros<Vec2>()));
  if (input.bolts.empty() && input.linings.empty()) return reaction;
  const RunResult supported = run_of(input, report);
  reaction.supported = points_of(supported.built);
  const ReactionPoint& end = reaction.supported.back();
  if (end.verdict == Verdict::stable && !end.lost_lining)
    reaction.equivalent = traction_at(reaction.ground, end.convergence.crown);
  return reaction;
}

std::string grc_text(const GroundReaction& reaction) {
  std::string out;
  const auto rows = [&](const char* head, const std::vector<ReactionPoint>& points) {
    for (const ReactionPoint& p : points)
      out += head + text("%5.1f %% of the wall's traction left: crown ", percent(p.traction)) +
             millimetres_text(p.convergence.crown) + " mm, springings " +
             millimetres_text(p.convergence.right_springing) + " and " +
             millimetres_text(p.convergence.left_springing) + " mm, invert " +
             millimetres_text(p.convergence.invert) + " mm; " + word_of(p) + "\n";
  };
  rows("ground   ", reaction.ground);
  rows("support  ", reaction.supported);
  if (reaction.equivalent)
    out +=
        text("equal    the bare crown moves as far under %.1f %% ", percent(*reaction.equivalent)) +
        "of its traction: supports do what " +
        format_quantity(*reaction.equivalent * reaction.stress, dimension::pressure) +
        " on the crown would\n";
  else if (!reaction.supported.empty())
    out +=
        "equal    no traction moves the bare crown as far as the supported one while all of "
        "its rock stands\n";
  for (const std::string& warning : reaction.warnings) out += "warning  " + warning + "\n";
  return out;
}

std::string grc_csv(const GroundReaction& reaction) {
  CsvTable table({"curve", "stage", "wall_traction_percent", "crown_mm", "right_springing_mm",
                  "left_springing_mm", "invert_mm", "verdict", "detached_area_m2"},
                 6);
  const auto rows = [&](const char* curve, const std::vector<ReactionPoint>& points) {
    for (const ReactionPoint& p : points)
      table.add_row(curve, p.stage, percent(p.traction), millimetres(p.convergence.crown),
                    millimetres(p.convergence.right_springing),
                    millimetres(p.convergence.left_springing), millimetres(p.convergence.invert),
                    word_of(p), p.fallen);
  };
  rows("ground", reaction.ground);
  rows("supported", reaction.supported);
  return table.text();
}

std::string grc_json(const GroundReaction& reaction) {
  const auto rows = [](const std::vector<ReactionPoint>& points) {
    nlohmann::json list = nlohmann::json::array();
    for (const ReactionPoint& p : points)
      list.push_back({{"stage", p.stage},
                      {"wall_traction", p.traction},
                      {"convergence", convergence_json(p.convergence)},
                      {"verdict", word_of(p)},
                      {"detached_area_m2", p.fallen}});
    return list;
  };
  nlohmann::json json = {{"schema", 1},
                         {"ground", rows(reaction.ground)},
                         {"supported", rows(reaction.supported)},
                         {"vertical_stress_at_centre_kPa", 1e-3 * reaction.stress},
                         {"equivalent_wall_traction", number_json(reaction.equivalent)},
                         {"warnings", reaction.warnings}};
  return json.dump(2) + "\n";
}

std::string grc_svg(const Input& input, const GroundReaction& reaction) {
  CurvePicture picture;
  picture.header.title = input.title.empty() ? "Ground reaction" : input.title;
  picture.across = "crown convergence [mm]";
  picture.up = "traction left on the wall [% of that in situ]";
  const auto curve = [&](const char* name, const std::vector<ReactionPoint>& points,
                         const char* colour) {
    Curve made{.name = name, .points = {}, .colour = colour};
    for (const ReactionPoint& p : points)
      if (std::isfinite(p.convergence.crown))
        made.points.push_back({millimetres(p.convergence.crown), percent(p.traction)});
    return made;
  };
  Curve ground = curve("rock without support", reaction.ground, "#1f4e79");
  ground.points.insert(ground.points.begin(), Vec2(0, 100));
  picture.curves.push_back(ground);
  if (!reaction.supported.empty())
    picture.curves.push_back(curve("stages of the file, supported", reaction.supported, "#b3541e"));
  const auto loose = std::find_if(reaction.ground.begin(), reaction.ground.end(),
                                  [](const ReactionPoint& p) { return p.fallen > 0; });
  if (loose != reaction.ground.end())
    picture.header.lines.push_back("Without support rock comes off at " + loose->stage +
                                   " of the traction.");
  if (reaction.equivalent) {
    const double at = millimetres(reaction.supported.back().convergence.crown);
    picture.curves.push_back({.name = "what supports do for the wall",
                              .points = {{at, 0}, {at, percent(*reaction.equivalent)}},
                              .colour = "#555",
                              .dash = "6 4",
                              .is_marked = false});
    picture.header.lines.push_back(
        "Supports do what " +
        format_quantity(*reaction.equivalent * reaction.stress, dimension::pressure) +
        " on the crown would.");
  }
  return draw_curve_picture(picture);
}

LongitudinalProfile longitudinal_profile(const Input& input, const Report& report) {
  const SpatialRunResult run = spatial_run_of(input, report);
  LongitudinalProfile profile;
  profile.verdict = run.verdict();
  profile.fallen = run.fallen_measure();
  profile.warnings = run.rock_warnings;
  if (!input.uncertain.empty()) profile.warnings.push_back(input.uncertain_text());
  const double driven = input.round_count() * input.stretch();
  const PrismaticOpening opening = driven_tunnel(input);
  // Twice a round, each over as much wall as lies between two.
  const double step = 0.5 * std::min(input.stretch(), driven / 6);
  const int count = std::max(1, static_cast<int>(std::floor(driven / step + 1e-9)));
  for (int k = 0; k < count; ++k) {
    const double behind = (k + 0.5) * driven / count;
    profile.points.push_back(
        {behind, convergence(run.tunnel, opening, driven - behind, 0.5 * driven / count)});
  }
  return profile;
}

std::string profile_text(const LongitudinalProfile& profile) {
  std::string out;
  for (const ProfilePoint& p : profile.points)
    out += text("profile  %5.2f m behind the face: crown ", p.behind_face) +
           millimetres_text(p.convergence.crown) + " mm, springings " +
           millimetres_text(p.convergence.right_springing) + " and " +
           millimetres_text(p.convergence.left_springing) + " mm\n";
  out += std::string("verdict  ") + to_string(profile.verdict, profile.fallen, false) + "\n";
  for (const std::string& warning : profile.warnings) out += "warning  " + warning + "\n";
  return out;
}

std::string profile_csv(const LongitudinalProfile& profile) {
  CsvTable table(
      {"behind_face_m", "crown_mm", "right_springing_mm", "left_springing_mm", "invert_mm"}, 6);
  for (const ProfilePoint& p : profile.points)
    table.add_row(p.behind_face, millimetres(p.convergence.crown),
                  millimetres(p.convergence.right_springing),
                  millimetres(p.convergence.left_springing), millimetres(p.convergence.invert));
  return table.text();
}

std::string profile_json(const LongitudinalProfile& profile) {
  nlohmann::json json = {{"schema", 1},
                         {"verdict", to_string(profile.verdict, profile.fallen, false)},
                         {"detached_volume_m3", profile.fallen},
                         {"profile", nlohmann::json::array()},
                         {"warnings", profile.warnings}};
  for (const ProfilePoint& p : profile.points)
    json["profile"].push_back(
        {{"behind_face_m", p.behind_face}, {"convergence", convergence_json(p.convergence)}});
  return json.dump(2) + "\n";
}

std::string profile_svg(const Input& input, const LongitudinalProfile& profile) {
  CurvePicture picture;
  picture.header.title = input.title.empty() ? "Along the tunnel" : input.title;
  picture.across = "behind the face [m]";
  picture.up = "convergence [mm]";
  const auto curve = [&](const char* name, const char* colour, const auto& value_of) {
    Curve made{.name = name, .points = {}, .colour = colour};
    for (const ProfilePoint& p : profile.points)
      if (const double value = value_of(p.convergence); std::isfinite(value))
        made.points.push_back({p.behind_face, millimetres(value)});
    return made;
  };
  picture.curves = {
      curve("crown", "#1f4e79", [](const Convergence& c) { return c.crown; }),
      curve("springings", "#b3541e",
            [](const Convergence& c) { return 0.5 * (c.right_springing + c.left_springing); }),
      curve("invert", "#5b8c3e", [](const Convergence& c) { return c.invert; })};
  return draw_curve_picture(picture);
}

}  // namespace voussoir::program
