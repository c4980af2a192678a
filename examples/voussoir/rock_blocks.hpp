// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>
#include <voussoir/rockmass/block_size_curve.hpp>
#include <voussoir/rockmass/removable_blocks.hpp>
#include <voussoir/rockmass/scan_line.hpp>

#include "analysis.hpp"

/// What there is to know of the blocks of a rock mass before any mechanics: `voussoir blocks`.
namespace voussoir::program {

/// A taper that a survey does not know for sure: what it holds is said apart [rad], 2 degrees.
inline constexpr double small_taper = 0.0349065850398866;

/// Scan lines in one direction.
struct ScanDirection {
  std::string name;       ///< "across", "along", "upright"
  std::size_t lines;      ///< from side to side of the model
  ScanLineLog log;        ///< of all together
  double mean_frequency;  ///< over all places, from the areas of the joints [1/m]
};

/// Joints of one set.
struct SetCount {
  std::string name;
  double frequency;     ///< across the set [1/m]
  double area_density;  ///< P32, or P21 in a section [1/m]
};

/// A block at the wall that can be moved out.
struct RemovableBlock {
  int body;             ///< its number in the rock; its own here is its place in the list, from 1
  BlockMode mode;       ///< never tapered
  double size;          ///< [m^2] or [m^3]
  double weight;        ///< [N/m] or [N]
  double free_measure;  ///< of its free face [m] or [m^2]
  double depth;         ///< of its farthest corner behind the wall [m]
  double x, y;          ///< of the middle of its free face in the section [m]
  double angle;         ///< of that, anticlockwise from the right-hand springing [rad], 0 to 2 pi
  double along;         ///< along the tunnel [m]; 0 in a section
  double plunge;        ///< of its motion below the horizontal [rad]
  double needed_friction;  ///< see `BlockMotion` [rad]
};

/// The rock of an input, in situ and with the tunnel taken out of it, nothing moved.
struct RockBlocks {
  std::size_t block_count;  ///< in situ
  WholeBlockSizes sizes;    ///< in situ
  std::vector<ScanDirection> scans;
  std::vector<SetCount> sets;
  std::optional<double> volumetric_count;  ///< Jv [1/m]; none in a section
  std::vector<RemovableBlock> removable;   ///< falls, slides, rests; of each the largest first
  std::array<std::size_t, 5> of_mode{};    ///< blocks at the wall, by `BlockMode`
  std::size_t barely_tapered = 0;          ///< tapered by less than `small_taper`
  std::size_t cut_at_wall = 0;             ///< by the sides of the model, left out of those
  std::vector<std::string> warnings = {};  ///< about the rock
  /// With the tunnel: all of it, as far as it is driven.
  std::variant<RockMass<Planar>, RockMass<Spatial>> excavated;
};

/// @throws as `described_rock`, `described_spatial_rock`
/// @pre  the input has a tunnel
[[nodiscard]] RockBlocks rock_blocks(const Input& input, const Report& report);

/// Of the list, how many fall or slide and are shown one by one: the first ones.
[[nodiscard]] std::size_t shown_count(const RockBlocks& rock);

/// For a terminal, in the units of an engineer.
[[nodiscard]] std::string rock_blocks_text(const Input& input, const RockBlocks& rock);
/// All of it but the blocks one by one (schema 1).
[[nodiscard]] std::string rock_blocks_json(const Input& input, const RockBlocks& rock);
/// One row per whole block, ascending.
[[nodiscard]] std::string block_sizes_csv(const Input& input, const RockBlocks& rock);
/// The share of the rock in blocks up to a size.
[[nodiscard]] std::string block_sizes_svg(const Input& input, const RockBlocks& rock);
/// One row per removable block: what falls, then what slides, then what rests; of each the largest
/// first.
[[nodiscard]] std::string removable_csv(const Input& input, const RockBlocks& rock);
/// The rock around the tunnel, in 2-D with the removable blocks by their mode and, of the first
/// that fall or slide, their numbers in removable.csv.
[[nodiscard]] std::string rock_svg(const Input& input, const RockBlocks& rock);
/// The wall of the tunnel unrolled, seen from inside, with the same.
/// @pre the input is one in 3-D
[[nodiscard]] std::string wall_svg(const Input& input, const RockBlocks& rock);

}  // namespace voussoir::program
