// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/detail/bounded_lines.hpp>
#include <voussoir/rockmass/detail/trace_table.hpp>

namespace voussoir {

/// How a drawing is read, and what it may hold.
struct DxfLimits {
  double sagitta = 0.005;   ///< most that a chord may lie from its arc [m], > 0
  double flatness = 0.001;  ///< most that a section's points may differ across it [m], >= 0
  /// Of the drawing's unit [m], whatever the file says: 0.001 for millimetres. 0: as it says.
  double metres = 0;
  /// Layers that are read, in any case; what is on others is not looked at. None: all.
  std::vector<std::string> layers{};
  std::size_t points = 1'000'000;     ///< of all lines
  std::size_t line_length = 100'000;  ///< characters of a line of the file
  std::size_t bytes = 256'000'000;    ///< of the whole file
};

/// A line, polyline or curve of a drawing as straight pieces.
struct DxfPolyline {
  std::vector<Vec2> points;  ///< two or more, relative to the site origin [m]
  bool is_closed = false;    ///< from the last point to the first, which is not repeated
  int layer = 0;             ///< index into `layers`
  std::size_t line = 0;      ///< of the file, where it begins
};

/// What a drawing holds.
struct DxfFile {
  std::vector<DxfPolyline> lines;   ///< in the order of the file
  std::vector<std::string> layers;  ///< of all entities, by first appearance, as first written
  std::string unit;                 ///< of the drawing: "mm"
  double metres = 1;                ///< of that unit
  std::vector<std::string> notes;   ///< what was not taken as it stands
  std::string name;                 ///< of the source, for messages
};

namespace detail {

/// "0 (12 lines), WALL (none)": the layers of a drawing, for a message.
[[nodiscard]] VOUSSOIR_INLINE std::string dxf_layer_list(const DxfFile& file);

/// Index of a layer, in any case; -1: there is none.
[[nodiscard]] VOUSSOIR_INLINE int dxf_layer_index(const std::vector<std::string>& layers,
                                                  const std::string& name);

/// Index of a layer that has lines, in any case.
/// @throws InvalidInput  it has none, or there is no such layer; the message lists the layers
[[nodiscard]] VOUSSOIR_INLINE int dxf_layer_with_lines(const DxfFile& file,
                                                       const std::string& name);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE int dxf_layer_with_lines(const DxfFile& file, const std::string& name) {
  const int index = dxf_layer_index(file.layers, name);
  for (const DxfPolyline& line : file.lines)
    if (line.layer == index) return index;
  throw InvalidInput(
      message({file.name, index < 0 ? ": there is no layer \"" : ": no lines on layer \"",
               shown(name), "\"; layers: ", dxf_layer_list(file)}));
}

VOUSSOIR_INLINE int dxf_layer_index(const std::vector<std::string>& layers,
                                    const std::string& name) {
  const std::string wanted = lower(trimmed(name));
  for (std::size_t k = 0; k < layers.size(); ++k)
    if (lower(trimmed(layers[k])) == wanted) return static_cast<int>(k);
  return -1;
}

VOUSSOIR_INLINE std::string dxf_layer_list(const DxfFile& file) {
  constexpr std::size_t most = 30;
  std::vector<std::size_t> counts(file.layers.size());
  for (const DxfPolyline& line : file.lines) ++counts[static_cast<std::size_t>(line.layer)];
  std::string text;
  for (std::size_t k = 0; k < std::min(most, counts.size()); ++k)
    text += (k == 0 ? "" : ", ") + shown(file.layers[k]) +
            (counts[k] == 0   ? std::string(" (none)")
             : counts[k] == 1 ? std::string(" (1 line)")
                              : message({" (", counts[k], " lines)"}));
  if (counts.size() > most) text += message({" and ", counts.size() - most, " more"});
  return text.empty() ? "no layer at all" : text;
}

#endif

}  // namespace detail

}  // namespace voussoir
