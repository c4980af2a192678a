// SPDX-License-Identifier: MIT
#include "mapped_rock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <voussoir/core/units.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/io/operating_system.hpp>
#include <voussoir/rockmass/trace_coverage.hpp>
#include <voussoir/rockmass/trace_file.hpp>

#include "drawn_outline.hpp"
#include "geojson_traces.hpp"
#include "joint_laws.hpp"

namespace voussoir::program {

namespace {

/// Of the metres mapped: what is not cut, or is cut beyond, is warned of from here on.
constexpr double share_said = 0.25;

std::string metres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f m", length);
  return text;
}

/// What of a set is not as it was mapped.
void warn_of(const Input& input, const MappedSet& set, std::vector<std::string>& warnings) {
  const std::string of = "joints.file, " + set_name(input, set.set) + ": ";
  if (set.mapped - set.cut > share_said * set.mapped)
    warnings.push_back(
        of + "of " + metres(set.mapped) + " mapped " + metres(set.cut) +
        " part blocks; the rest ends in whole rock, or would part blocks smaller than "
        "blocks.min_inscribed_radius" +
        (input.mapped.dead_ends == DeadEnds::cut_through
             ? ""
             : R"(; joints.dead_ends = "cut_through" draws dead ends on to the next joint)"));
  if (set.made > share_said * set.mapped)
    warnings.push_back(of + metres(set.made) + " of joint are made where none was mapped, of " +
                       metres(set.mapped) +
                       R"( mapped: dead ends are drawn on to the next joint; )" +
                       R"(joints.dead_ends = "do_not_cut" leaves them out)");
}

/// The lines of a drawing, those of a layer of the joint set of its name.
TraceFile drawn_traces(std::istream& in, const std::string& name, const Input& input,
                       const Vec2& origin, const Progress& progress) {
  DxfLimits limits;
  limits.metres = input.trace_file.unit;
  DxfFile drawing;
  try {
    drawing = read_dxf(in, name, origin, limits, progress);
  } catch (const InvalidInput& fault) {
    throw InvalidInput(std::string("joints.file: ") + fault.what());
  }
  std::vector<std::string> names;
  std::vector<int> sets;
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k) {
    const JointSetInput& set = input.joint_sets[k];
    const bool has_layer = detail::dxf_layer_index(drawing.layers, set.name) >= 0;
    if (!has_layer && set.is_random()) continue;
    names.push_back(set.name);
    sets.push_back(static_cast<int>(k));
  }
  if (names.empty() && !input.joint_sets.empty())
    throw InvalidInput("joints.file: " + name + ": no layer has the name of a joint set; layers: " +
                       detail::dxf_layer_list(drawing));
  DxfTraces drawn;
  try {
    drawn = traces_of(drawing, names);
  } catch (const InvalidInput& fault) {
    throw InvalidInput(std::string("joints.file: ") + fault.what());
  }
  TraceFile read{std::move(drawn.traces), "lines of a drawing in " + drawing.unit, drawing.notes};
  for (MappedTrace& trace : read.traces)
    if (trace.set >= 0) trace.set = sets[static_cast<std::size_t>(trace.set)];
  for (const DxfLayerCount& left : drawn.left_out)
    read.notes.push_back("layer " + left.layer + " (" + counted(left.lines, "line") +
                         ") names no joint set and is left out");
  return read;
}

}  // namespace

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string set_name(const Input& input, int set) {
  return set < 0 ? std::string("no set") : input.joint_sets[static_cast<std::size_t>(set)].name;
}

std::vector<MappedTrace> read_mapped_traces(const Input& input, const Domain<2>& domain,
                                            const Progress& progress, DescribedRock& rock) {
  const std::string name = utf8_text(input.joints_file);
  const std::string accepted =
      "\n   = accepted: the name of a file of traces, relative to the input file";
  std::error_code error;
  const auto kind = std::filesystem::status(input.joints_file, error).type();
  // A device or a pipe may never end, and to open one may take for ever.
  if (kind != std::filesystem::file_type::regular &&
      std::filesystem::exists(input.joints_file, error))
    throw InvalidInput("joints.file: cannot read " + name + ": it is not a regular file" +
                       accepted);
  std::ifstream file(input.joints_file, std::ios::binary);
  if (!file) throw InvalidInput("joints.file: cannot read " + name + accepted);
  TraceFileLimits limits;
  limits.sets = static_cast<int>(input.joint_sets.size());
  for (const JointSetInput& set : input.joint_sets) limits.set_names.push_back(set.name);
  limits.first_set = input.trace_file.first_set;
  limits.first_set_key = "joints.first_set";
  TraceFile read = is_drawing(input.joints_file)
                       ? drawn_traces(file, name, input, domain.site_origin, progress)
                   : is_geojson(input.joints_file)
                       ? geojson_traces(file, name, domain.site_origin, limits)
                       : read_traces(file, name, domain.site_origin, limits, progress);
  rock.joints_read = name + ": " + counted(read.traces.size(), "trace") + ", " + read.layout;
  for (const std::string& note : read.notes) rock.joints_read += "; " + note;
  const TraceCoverage coverage = trace_coverage(read.traces, domain);
  if (2 * coverage.inside < coverage.count) {
    const std::string text =
        "joints.file: " + name + ": " + coverage_text(coverage, domain, "model.origin");
    if (coverage.inside == 0) throw InvalidInput(text);
    rock.warnings.push_back(text);
  }
  return std::move(read.traces);
}

void report_mapped(const Input& input, const JointedRock<Planar>& made, DescribedRock& rock) {
  if (made.duplicates > 0)
    rock.warnings.push_back("joints.file: " + counted(made.duplicates, "trace") +
                            " left out: a longer one runs within joints.snap = " +
                            format_quantity(snap_of(input), dimension::length) + " all along");
  for (const MappedSet& set : made.mapped) {
    JointSource source{"joints.file, " + set_name(input, set.set)};
    source.asked = set.joints;
    source.used = set.used;
    source.outside = set.outside;
    source.refused = set.joints - set.used - set.outside;
    source.law = law_of_set(input, set.set);
    source.mapped = set;
    rock.joints.push_back(std::move(source));
    warn_of(input, set, rock.warnings);
  }
}

}  // namespace voussoir::program
