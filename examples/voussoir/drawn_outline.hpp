// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>
#include <voussoir/rockmass/dxf_file.hpp>

#include "input.hpp"
#include "input_section.hpp"

/// What engineers have as a drawing: the outline of the opening, and mapped joints.
namespace voussoir::program {

/// Whether a file is a drawing (.dxf), or a map (.geojson, .json), by the end of its name.
[[nodiscard]] bool is_drawing(const std::filesystem::path& file);
[[nodiscard]] bool is_geojson(const std::filesystem::path& file);

/// Reads the key `unit` beside a file that is a drawing.
/// @param unit  of the drawing [m]; 0: as it says itself
void read_drawing_unit(Section& s, double& unit);

/// The outline of the opening as it is drawn, relative to `model.origin`; empty where it is none,
/// which is noted at the key `file`.
/// @param layer  of the drawing; empty: all
[[nodiscard]] std::vector<Point> drawn_outline(Section& s, Input& input,
                                               const std::filesystem::path& file,
                                               const std::string& layer, double unit);

/// What keeps points from being the outline of an opening about (0, 0), and where; empty if they
/// are one.
[[nodiscard]] std::string outline_fault(const std::vector<Point>& points);

}  // namespace voussoir::program
