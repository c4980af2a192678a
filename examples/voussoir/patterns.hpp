// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>
#include <voussoir/core/vec.hpp>

/// How unsupported tunnels fail: the 24 cases of Table 1 of Boon, Houlsby & Utili (2015), every
/// block moving, and what can be measured of each collapse.
namespace voussoir::program {

/// A joint set as the table gives it.
struct PatternSet {
  double dip;  ///< [degrees]
  bool east;   ///< dips to the right
};

/// What a roof fall is called, by the paper and by the measurement.
enum class RoofFall { none, minor, wedge, steepest, second_steepest, shallowest, mixed };
/// What happens at the walls.
enum class WallFailure { none, sliding, toppling, both_ways, other };

[[nodiscard]] const char* to_string(RoofFall fall);
[[nodiscard]] const char* to_string(WallFailure failure);

struct PatternCase {
  int number;
  std::array<PatternSet, 3> sets;
  double friction;   ///< [degrees]
  RoofFall roof;     ///< the paper's first mechanism
  WallFailure wall;  ///< the paper's second
};
[[nodiscard]] const std::vector<PatternCase>& pattern_cases();

/// What was measured of one collapse. Sets are numbered 0, 1, 2 as A, B, C.
struct PatternResult {
  int number = 0;
  std::uint64_t seed = 0;
  int blocks = 0;
  double time = 0;                      ///< simulated after the excavation [s]
  double imbalance = 0;                 ///< of energy [-]
  double roof_area = 0, wall_area = 0;  ///< rock that has moved by more than 0.3 m [m^2]
  std::array<double, 3> roof_slides{}, wall_slides{};  ///< part of it that moved along a set [-]
  double roof_free = 0;                  ///< part that fell without touching a set [-]
  double toppled = 0;                    ///< part at the walls that turned more than it moved [-]
  std::array<double, 3> bounds{};        ///< part of the edge of the roof fall made by each set [-]
  double height = 0;                     ///< of the roof fall above the crown [m]
  double left_area = 0, right_area = 0;  ///< of `wall_area`
  /// Parts of these that moved along a set [-].
  std::array<double, 3> left_slides{}, right_slides{};
  /// Lost rock by the direction it was in from the centre, in eighths of the circle from the
  /// right-hand springing [m^2].
  std::array<double, 8> by_direction{};
  /// Largest displacement of blocks within half a radius of the wall over its mean, both weighted
  /// by area; 1 where the opening closes evenly [-].
  double wall_unevenness = 0;
  std::array<int, 2> widest_pair{};  ///< sets of the largest acute angle
  RoofFall roof = RoofFall::none;
  WallFailure wall = WallFailure::none;
  std::string note;  ///< why the run ended early, if it did
  /// Pictures of the collapse: outlines of all blocks near the tunnel, and whether each has been
  /// released.
  struct Stage {
    double time;
    std::vector<std::vector<Vec2>> outlines;
    std::vector<char> released;
  };
  std::vector<Stage> stages;
};

struct PatternOptions {
  double cover = 50;    ///< [m]
  double duration = 1;  ///< simulated after the excavation [s]
  /// Over which the wall traction goes [s]; 0: at once, as in the paper.
  double unloading = 0;
  double local_damping = 0;
  double viscous_damping = 0.3;
};

/// Runs one case with one random rock mass.
[[nodiscard]] PatternResult run_pattern(const PatternCase& the_case, std::uint64_t seed,
                                        const PatternOptions& options);

/// True where paper and measurement give the same name; a wedge also if it slides on one of its two
/// planes.
[[nodiscard]] bool roof_agrees(const PatternCase& the_case, const PatternResult& result);
[[nodiscard]] bool wall_agrees(const PatternCase& the_case, const PatternResult& result);

[[nodiscard]] std::string patterns_csv(const std::vector<PatternResult>& results);
/// One collapse in stages.
[[nodiscard]] std::string pattern_svg(const PatternResult& result);
/// The last stage of every case with its description, seed by seed one column.
[[nodiscard]] std::string patterns_sheet(const std::vector<PatternResult>& results);
/// A line of description: "wedge B-C 41 m2, 8.2 m high (B 46 %, C 48 % of its edge); walls: ..."
[[nodiscard]] std::string description(const PatternResult& result);

}  // namespace voussoir::program
