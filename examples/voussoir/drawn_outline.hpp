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

/// An outline in a drawing, and how it is to be read.
struct DrawnOutline {
  std::string layer;  ///< of the drawing; empty: all
  double unit = 0;    ///< of the drawing [m]; 0: as it says itself
  Point centre;       ///< on the site, to which its points are relative [m]
  bool holds_centre;  ///< it must
};

/// The points of an outline as it is drawn; empty where it is none, which is noted at the key
/// `file`.
/// @param layout  takes how it was read, in words
[[nodiscard]] std::vector<Point> drawn_outline(Section& s, std::string& layout,
                                               const std::filesystem::path& file,
                                               const DrawnOutline& asked);

/// What keeps points from being the outline of an opening, and where; empty if they are one.
/// @param holds_centre  it must contain (0, 0)
[[nodiscard]] std::string outline_fault(const std::vector<Point>& points, bool holds_centre = true);

/// Whether an outline has a level side on top and an arch below: a horseshoe on its head, as a
/// drawing in which y counts downwards shows it. One with a curved floor, or level on both sides,
/// does not tell.
/// @param points  anticlockwise, simple
[[nodiscard]] bool is_flat_above_an_arch(const std::vector<Point>& points);

}  // namespace voussoir::program
