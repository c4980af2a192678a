// SPDX-License-Identifier: MIT
#include "rock_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/design/construction_plan.hpp>
#include <voussoir/design/shotcrete_blocks.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/csv_table.hpp>
#include <voussoir/rockmass/carving.hpp>

#include "mapped_rock.hpp"
#include "plausibility.hpp"
#include "survey.hpp"

namespace voussoir::program {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr std::size_t most_on_screen = 8;

std::string figure(double value) { return significant_text(value, 3); }
std::string size_unit(const Input& input) { return input.is_spatial() ? "m3" : "m2"; }
std::string weight_unit(const Input& input) { return input.is_spatial() ? "kN" : "kN/m"; }

/// Joints of the rock in situ.
template <class Geometry>
void add_joints(const Input& input, const RockMass<Geometry>& mass, RockBlocks& rock) {
  constexpr int dim = Geometry::dim;
  // Fine enough for some hundred crossings in each direction.
  constexpr int count = dim == 2 ? 40 : 8;
  const std::vector<std::string> names =
      dim == 2 ? std::vector<std::string>{"across", "upright"}
               : std::vector<std::string>{"across", "along", "upright"};
  for (int axis = 0; axis < dim; ++axis) {
    const auto lines = lines_along<Geometry>(mass.domain, axis, count);
    rock.scans.push_back({names[static_cast<std::size_t>(axis)], lines.size(),
                          scan_line_log<Geometry>(mass, lines),
                          mean_frequency<Geometry>(mass, axis_vector<dim>(axis))});
  }
  const auto sets = set_frequencies(mass);
  for (const auto& set : sets)
    rock.sets.push_back({set_name(input, set.set), set.frequency, set.area_density});
  if constexpr (dim == 3) rock.volumetric_count = volumetric_joint_count(sets);
}

template <class Geometry>
void add_wall(const Input& input, const RockMass<Geometry>& mass, const Progress& progress,
              RockBlocks& rock) {
  constexpr int dim = Geometry::dim;
  const WallBlocks<Geometry> wall = wall_blocks(mass, progress);
  rock.cut_at_wall = wall.cut_count;
  std::vector<RemovableBlock> found;
  std::vector<double> sizes;
  for (const WallBlock<Geometry>& block : wall.blocks) {
    const BlockMotion<dim>& motion = block.motion;
    ++rock.of_mode[static_cast<std::size_t>(motion.mode)];
    if (!motion.is_removable()) {
      rock.barely_tapered +=
          block_motion(block.normals, Vec<dim>(-axis_vector<dim>(dim - 1)), small_taper)
              .is_removable();
      continue;
    }
    const double x = block.place[0], y = block.place[dim - 1], down = -motion.direction[dim - 1];
    const double angle = elementary::angle_of(y, x);
    found.push_back({block.body, motion.mode, block.size,
                     input.rock.density * input.model.gravity * block.size, block.free_measure,
                     block.depth, x, y, angle < 0 ? angle + 2 * std::numbers::pi : angle,
                     dim == 3 ? block.place[1] : 0,
                     elementary::angle_of(down, std::sqrt(std::max(0.0, (1 - down) * (1 + down)))),
                     motion.needed_friction});
    sizes.push_back(-block.size);
  }
  // What falls comes first, then what slides, then what rests; of each the largest first.
  const std::vector<std::size_t> by_size = order_of_values(sizes);
  const auto take = [&](auto&& wanted) {
    for (const std::size_t k : by_size)
      if (wanted(found[k].mode)) rock.removable.push_back(found[k]);
  };
  take([](BlockMode mode) { return mode == BlockMode::falls; });
  take([](BlockMode mode) { return mode > BlockMode::rests && mode < BlockMode::falls; });
  take([](BlockMode mode) { return mode == BlockMode::rests; });
}

template <class Geometry>
RockBlocks blocks_of(const Input& input, RockIn<Geometry> made,
                     const typename Geometry::Opening& opening, double smallest,
                     const Progress& progress) {
  RockBlocks rock{made.mass.bodies.size(),
                  WholeBlockSizes(made.mass),
                  {},
                  {},
                  {},
                  {},
                  {},
                  0,
                  0,
                  std::move(made.warnings),
                  {}};
  add_joints(input, made.mass, rock);
  RockMass<Geometry> excavated = carve(std::move(made.mass), opening, smallest, progress);
  add_wall(input, excavated, progress, rock);
  if (const CarvingReport& carving = excavated.carving; carving.dropped_pieces > 0)
    rock.warnings.push_back(counted(carving.dropped_pieces, "piece") + " at the wall below " +
                            figure(smallest) + " " + size_unit(input) +
                            " (blocks.min_wall_area) left out, " + figure(carving.dropped_measure) +
                            " " + size_unit(input) + " in all; the wall is the rock behind");
  for (std::string& text : warnings_about_values(input)) rock.warnings.push_back(std::move(text));
  if (!input.loads.empty())
    rock.warnings.emplace_back(
        "[[load]] is left out: single blocks at the wall carry their own weight; `run` knows loads");
  if (input.survey && !input.survey->left_out.empty())
    rock.warnings.push_back(left_out_text(*input.survey));
  rock.excavated = std::move(excavated);
  return rock;
}

/// What a block that falls or slides does, and the friction that would hold it.
std::string mode_text(const RemovableBlock& block) {
  std::string text = to_string(block.mode);
  if (block.mode != BlockMode::falls)
    text += ", held by " + fixed_text(block.needed_friction / degree, 0) + " deg of friction";
  return text;
}

/// Of what shotcrete holds: the weight along the way that the block would take, without friction;
/// none: it rests, or nothing is checked.
std::optional<ShotcreteUse> use_of(const Input& input, const RemovableBlock& block) {
  if (block.mode == BlockMode::rests) return std::nullopt;
  return shotcrete_use(input, block.angle, block.weight * elementary::sine(block.plunge),
                       block.free_measure);
}

/// How many fall or slide: the first ones of the list.
std::size_t driven_count(const RockBlocks& rock) {
  return rock.of_mode[static_cast<std::size_t>(BlockMode::falls)] +
         rock.of_mode[static_cast<std::size_t>(BlockMode::slides_on_one_face)] +
         rock.of_mode[static_cast<std::size_t>(BlockMode::slides_on_two_faces)];
}
std::string sizes_line(const Input& input, const RockBlocks& rock) {
  const WholeBlockSizes& sizes = rock.sizes;
  const std::string unit = message({" ", size_unit(input)});
  std::string out =
      message({"blocks   ", rock.block_count, " in situ, of which ", sizes.cut_count(),
               " touch the sides of the model and are left out\n"});
  if (sizes.count() == 0) return out + "sizes    none: no block lies whole in the model\n";
  out += "sizes    mean " + figure(sizes.mean()) + unit + ", median " + figure(sizes.median()) +
         unit + "; by " + (input.is_spatial() ? "volume" : "area") + " D10 " +
         figure(sizes.size_at(0.1)) + ", D50 " + figure(sizes.size_at(0.5)) + ", D90 " +
         figure(sizes.size_at(0.9)) + unit + "\n";
  out += "sizes    edge-corrected: D10 " + figure(sizes.true_size_at(0.1)) + ", D50 " +
         figure(sizes.true_size_at(0.5)) + ", D90 " + figure(sizes.true_size_at(0.9)) + unit + "\n";
  return out;
}

}  // namespace

std::size_t shown_count(const RockBlocks& rock) {
  return std::min(driven_count(rock), most_on_screen);
}

RockBlocks rock_blocks(const Input& input, const Report& report) {
  const Progress progress = [&](double fraction) { return report("blocks", fraction); };
  const SimplePolygon section = opening_of(input);
  const double smallest = input.blocks.min_wall_area;
  if (input.is_spatial())
    return blocks_of<Spatial>(input, described_spatial_rock(input, progress), driven_tunnel(input),
                              smallest * std::sqrt(smallest), progress);
  return blocks_of<Planar>(input, described_rock(input, progress), section, smallest, progress);
}

std::string rock_blocks_text(const Input& input, const RockBlocks& rock) {
  std::string out = survey_lines(input) + sizes_line(input, rock);
  for (const ScanDirection& scan : rock.scans) {
    const ScanLineLog& log = scan.log;
    out += "scan     " + scan.name + ", " + counted(scan.lines, "line") + ": " +
           figure(log.frequency()) + " joints/m, mean spacing " +
           (log.spacings > 0 ? figure(log.mean_spacing()) + " m" : std::string("none")) + ", RQD " +
           fixed_text(log.rqd(), 0) + " % counted, " + fixed_text(log.theoretical_rqd(), 0) +
           " % by Priest & Hudson\n";
  }
  for (const SetCount& set : rock.sets)
    out += "set      " + set.name + ": " + figure(set.frequency) + " joints/m across it, " +
           (input.is_spatial() ? "P32 " : "P21 ") + figure(set.area_density) + " 1/m\n";
  if (rock.volumetric_count)
    out += "Jv       " + figure(*rock.volumetric_count) + " joints/m3, by Palmstrom RQD " +
           fixed_text(rqd_by_volumetric_count(*rock.volumetric_count), 0) + " %\n";
  const auto of = [&](BlockMode mode) {
    return std::to_string(rock.of_mode[static_cast<std::size_t>(mode)]);
  };
  std::size_t at_wall = 0;
  for (const std::size_t count : rock.of_mode) at_wall += count;
  out += "wall     " + counted(at_wall, "block") + " at it: " + of(BlockMode::falls) + " fall, " +
         of(BlockMode::slides_on_one_face) + " slide on one face, " +
         of(BlockMode::slides_on_two_faces) + " on two, " + of(BlockMode::rests) + " rest, " +
         of(BlockMode::tapered) + " are wedged in";
  if (rock.barely_tapered > 0)
    out += ", " + std::to_string(rock.barely_tapered) + " of them by less than " +
           fixed_text(small_taper / degree, 0) + " deg";
  if (rock.cut_at_wall > 0)
    out += "; " + std::to_string(rock.cut_at_wall) +
           " more touch the sides of the model and are left out";
  out += "\n";
  const std::size_t driven = driven_count(rock), shown = shown_count(rock);
  for (std::size_t k = 0; k < shown; ++k) {
    const RemovableBlock& block = rock.removable[k];
    out +=
        "block    " + std::to_string(k + 1) + " at " + fixed_text(block.angle / degree, 0) + " deg";
    if (input.is_spatial()) out += ", " + fixed_text(block.along, 1) + " m along";
    out += ": " + figure(block.size) + " " + size_unit(input) + ", " + figure(1e-3 * block.weight) +
           " " + weight_unit(input) + ", " + figure(block.depth) + " m deep; " + mode_text(block);
    if (const auto use = use_of(input, block))
      out += "; " + fixed_text(100 * use->value, 0) + " % of what the shotcrete holds, " +
             to_string(use->mode);
    out += "\n";
  }
  if (driven > shown)
    out += "block    and " + std::to_string(driven - shown) +
           " more that slide or fall: removable.csv\n";
  for (const std::string& warning : rock.warnings) out += "warning  " + warning + "\n";
  return out + "note     kinematics alone: single blocks, no rotation, no stress, no cohesion\n";
}

std::string rock_blocks_json(const Input& input, const RockBlocks& rock) {
  using nlohmann::json;
  const std::string unit = size_unit(input), measure = input.is_spatial() ? "volume" : "area";
  const auto key = [&](const std::string& name) { return name + "_" + unit; };
  // Not a number has no place in JSON.
  const auto number = [](double value) { return std::isfinite(value) ? json(value) : json(); };
  const WholeBlockSizes& sizes = rock.sizes;
  json curve = json::object(), corrected = json::object();
  for (const int percent : {10, 50, 90}) {
    const std::string name = key(message({"D", percent}));
    curve[name] = number(sizes.size_at(0.01 * percent));
    corrected[name] = number(sizes.true_size_at(0.01 * percent));
  }
  json scans = json::array(), sets = json::array(), removable = json::array();
  for (const ScanDirection& scan : rock.scans)
    scans.push_back({{"direction", scan.name},
                     {"lines", scan.lines},
                     {"length_m", scan.log.length},
                     {"joints", scan.log.joints},
                     {"joints_per_m", number(scan.log.frequency())},
                     {"joints_per_m_of_all_places", scan.mean_frequency},
                     {"mean_spacing_m", number(scan.log.mean_spacing())},
                     {"RQD_counted_percent", number(scan.log.rqd())},
                     {"RQD_Priest_Hudson_percent",
                      scan.log.length > 0 ? json(scan.log.theoretical_rqd()) : json()}});
  for (const SetCount& set : rock.sets)
    sets.push_back({{"set", set.name},
                    {"joints_per_m_across", set.frequency},
                    {input.is_spatial() ? "P32_per_m" : "P21_per_m", set.area_density}});
  for (const RemovableBlock& block : rock.removable) {
    json one{{"block", block.body},
             {"mode", to_string(block.mode)},
             {key(measure), block.size},
             {input.is_spatial() ? "weight_kN" : "weight_kN_per_m", 1e-3 * block.weight},
             {"angle_deg", block.angle / degree},
             {"depth_m", block.depth},
             {"needed_friction_deg", nullptr}};
    if (input.is_spatial()) one["along_m"] = block.along;
    if (const auto use = use_of(input, block)) {
      one["of_shotcrete"] = use->value;
      one["shotcrete_mode"] = to_string(use->mode);
    }
    if (block.mode != BlockMode::falls) one["needed_friction_deg"] = block.needed_friction / degree;
    removable.push_back(std::move(one));
  }
  json out = {{"schema", 1},
              {"program", std::string("voussoir ") + VOUSSOIR_VERSION_STRING},
              {"title", input.title},
              {"seed", input.model.seed},
              {"dimension", input.is_spatial() ? 3 : 2},
              {"sizes",
               {{"blocks", rock.block_count},
                {"left_out_at_sides", sizes.cut_count()},
                {key(measure + "_left_out"), sizes.cut_measure()},
                {key("mean_" + measure), number(sizes.mean())},
                {key("median_" + measure), number(sizes.median())},
                {"by_" + measure, std::move(curve)},
                {"by_" + measure + "_edge_corrected", std::move(corrected)}}},
              {"scan_lines", std::move(scans)},
              {"joint_sets", std::move(sets)},
              {"Jv_per_m", nullptr},
              {"wall",
               {{"fall", rock.of_mode[4]},
                {"slide_on_two_faces", rock.of_mode[3]},
                {"slide_on_one_face", rock.of_mode[2]},
                {"rest", rock.of_mode[1]},
                {"tapered", rock.of_mode[0]},
                {"tapered_by_less_than_2_deg", rock.barely_tapered},
                {"left_out_at_sides", rock.cut_at_wall}}},
              {"removable", std::move(removable)},
              {"warnings", rock.warnings}};
  if (rock.volumetric_count) {
    out["Jv_per_m"] = *rock.volumetric_count;
    out["RQD_Palmstrom_percent"] = rqd_by_volumetric_count(*rock.volumetric_count);
  }
  if (input.survey) out["survey"] = survey_json(input);
  return out.dump(2) + "\n";
}

std::string block_sizes_csv(const Input& input, const RockBlocks& rock) {
  CsvTable table({"block", input.is_spatial() ? "volume_m3" : "area_m2", "side_m",
                  "passing_percent", "passing_edge_corrected_percent"},
                 6);
  for (const WholeBlock& block : rock.sizes.blocks())
    table.add_row(block.body, block.size,
                  input.is_spatial() ? elementary::cube_root(block.size) : std::sqrt(block.size),
                  100 * block.passing, 100 * block.true_passing);
  return table.text();
}

std::string removable_csv(const Input& input, const RockBlocks& rock) {
  const bool is_spatial = input.is_spatial();
  CsvTable table({"number", "block", "mode", is_spatial ? "volume_m3" : "area_m2",
                  is_spatial ? "weight_kN" : "weight_kN_per_m", "angle_deg", "x_m", "y_m",
                  "along_m", "depth_m", is_spatial ? "free_face_m2" : "free_face_m",
                  "plunge_of_motion_deg", "needed_friction_deg", "of_shotcrete", "shotcrete_mode"},
                 6);
  int number = 0;
  for (const RemovableBlock& block : rock.removable) {
    const auto use = use_of(input, block);
    table.add_row(
        ++number, block.body, to_string(block.mode), block.size, 1e-3 * block.weight,
        block.angle / degree, block.x, block.y,
        is_spatial ? significant_text(block.along, 6) : std::string("-"), block.depth,
        block.free_measure, block.plunge / degree,
        block.mode == BlockMode::falls ? std::string("-")
                                       : significant_text(block.needed_friction / degree, 6),
        use ? significant_text(use->value, 6) : std::string("-"), use ? to_string(use->mode) : "-");
  }
  return table.text();
}

}  // namespace voussoir::program
