// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/outline_from_lines.hpp>
#include <voussoir/rockmass/detail/dxf_reader.hpp>
#include <voussoir/rockmass/dxf_drawing.hpp>
#include <voussoir/rockmass/mapped_trace.hpp>

namespace voussoir {

/// Reads the lines of a drawing, an ASCII DXF of R12 to 2018: LINE, LWPOLYLINE, POLYLINE, ARC,
/// CIRCLE and ELLIPSE of the section ENTITIES. Arcs and bulges become chords between points on the
/// arc. A section is drawn in x and y, or in x and z (with one y), of which the second is up.
///
/// What is in paper space, invisible, on a layer that was not asked for, or of a type that holds no
/// lines (texts, dimensions, hatches, points) is counted in a note. Layers that are off or frozen
/// are read. Coordinates are taken relative to the site origin to the digits that they are written
/// with, in metres by the header's $INSUNITS (in, ft, mm, cm, m, km, dm); without one they are
/// metres, which a note says.
///
/// @param name         of the source, for messages
/// @param site_origin  on the site grid [m], taken off all points
/// @param progress     asked now and then whether to go on
/// @throws InvalidInput  the first five faults at once, each with its line: no DXF, a binary one, a
///                       DWG, UTF-16; cut off; a group that is no number or missing; a spline, a
///                       block or a mesh; a tilted entity or a drawing that is no flat section; no
///                       line, or none on a layer asked for, with the layers that there are; more
///                       than `limits`, or limits out of range
/// @throws Stopped
/// Source: Autodesk, DXF Reference (2018).
[[nodiscard]] VOUSSOIR_INLINE DxfFile read_dxf(std::istream& in, const std::string& name,
                                               const Vec2& site_origin = zeros<Vec2>(),
                                               const DxfLimits& limits = {},
                                               const Progress& progress = {});

/// A layer that gave no traces, and how many lines it has.
struct DxfLayerCount {
  std::string layer;
  std::size_t lines = 0;
};

/// The mapped joints of a drawing.
struct DxfTraces {
  std::vector<MappedTrace> traces;      ///< in the order of the file
  std::vector<DxfLayerCount> left_out;  ///< layers with lines that name no set
};

/// The lines of a drawing as traces: those of a layer belong to the joint set of its name, in any
/// case (of letters of ASCII). A closed line ends where it begins.
///
/// @param set_names  of all joint sets, in their order; none: every line is a trace, of no set
/// @throws InvalidInput  there is no line on the layer of a set; the message lists the layers
[[nodiscard]] VOUSSOIR_INLINE DxfTraces traces_of(const DxfFile& file,
                                                  const std::vector<std::string>& set_names);

/// The lines of one layer of a drawing, in any case, for `outline_from_lines`; of all layers if its
/// name is empty.
/// @throws InvalidInput  there is no line on that layer; the message lists the layers
[[nodiscard]] VOUSSOIR_INLINE std::vector<LooseLine> lines_of(const DxfFile& file,
                                                              const std::string& layer);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE DxfFile read_dxf(std::istream& in, const std::string& name, const Vec2& site_origin,
                                 const DxfLimits& limits, const Progress& progress) {
  require(limits.sagitta > 0 && limits.sagitta < 1e9, "sagitta", limits.sagitta, "> 0 m");
  require(limits.flatness >= 0 && limits.flatness < 1e9, "flatness", limits.flatness, ">= 0 m");
  require(limits.metres >= 0 && limits.metres <= 1e6, "metres of the drawing's unit", limits.metres,
          "0 to 1e6");
  require(is_finite(site_origin), "site origin", length_of(site_origin), "finite");
  StopCheck stop(progress);
  return detail::DxfReader(in, name, site_origin, limits, stop).read();
}

VOUSSOIR_INLINE DxfTraces traces_of(const DxfFile& file,
                                    const std::vector<std::string>& set_names) {
  DxfTraces result;
  std::vector<int> set_of(file.layers.size(), -1);
  for (std::size_t k = 0; k < set_names.size(); ++k)
    set_of[static_cast<std::size_t>(detail::dxf_layer_with_lines(file, set_names[k]))] =
        static_cast<int>(k);
  std::vector<std::size_t> left(file.layers.size());
  for (const DxfPolyline& line : file.lines) {
    const auto layer = static_cast<std::size_t>(line.layer);
    if (set_of[layer] < 0 && !set_names.empty()) {
      ++left[layer];
      continue;
    }
    result.traces.push_back({line.points, set_of[layer]});
    if (line.is_closed) result.traces.back().points.push_back(line.points.front());
  }
  for (std::size_t k = 0; k < left.size(); ++k)
    if (left[k] > 0) result.left_out.push_back({file.layers[k], left[k]});
  return result;
}

VOUSSOIR_INLINE std::vector<LooseLine> lines_of(const DxfFile& file, const std::string& layer) {
  const int wanted = layer.empty() ? -1 : detail::dxf_layer_with_lines(file, layer);
  std::vector<LooseLine> lines;
  for (const DxfPolyline& line : file.lines)
    if (wanted < 0 || line.layer == wanted) lines.push_back({line.points, line.is_closed});
  return lines;
}

#endif

}  // namespace voussoir
