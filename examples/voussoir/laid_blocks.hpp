// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/vec.hpp>

/// A model of blocks that are laid one by one, as an input file describes it.
namespace voussoir::program {

/// x, y [m]
using Point = Vec2;

/// [[block]], or one of [blocks] file: a block that is laid.
struct LaidBlockInput {
  std::string name;                  ///< default "1", "2", ...
  std::vector<Point> vertices = {};  ///< convex, anticlockwise whatever the file's order [m]
  bool fixed = false;
};

/// [[load]] on a laid block. Per metre out of plane.
struct BlockLoadInput {
  int block = -1;
  Point force = Vec2::Zero();   ///< [N/m]
  std::optional<Point> at;      ///< where it acts; none: in the centroid [m]
  double moment = 0;            ///< anticlockwise [N]
  bool is_proportional = true;  ///< comes on with the loading; false: with the weight
};

/// [[displacement]] of a fixed block.
struct BlockDisplacementInput {
  int block = -1;
  Point by = Vec2::Zero();  ///< of its centroid [m]
  double rotation = 0;      ///< about it, anticlockwise [rad]
};

/// A model of blocks that are laid one by one, in place of rock around a tunnel.
struct LaidInput {
  std::vector<LaidBlockInput> blocks;  ///< those of [[block]] first
  std::filesystem::path file;          ///< [blocks] file, resolved; empty: none
  std::vector<BlockLoadInput> loads;
  std::vector<BlockDisplacementInput> displacements;
  double kh = 0, kv = 0;  ///< [seismic] forces to the right and up, over the weight [-], -10 to 10
  int steps = 10;         ///< [loading] in which it comes on, 1 to 10000
  std::vector<std::string> warnings;

  /// Whether anything comes on after the weight.
  [[nodiscard]] bool has_loading() const {
    return kh != 0 || kv != 0 || !displacements.empty() ||
           std::any_of(loads.begin(), loads.end(),
                       [](const BlockLoadInput& load) { return load.is_proportional; });
  }
};

}  // namespace voussoir::program
