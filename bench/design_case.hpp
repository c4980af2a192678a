// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <numbers>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/solver/solver.hpp>

/// The design case of Boon, Houlsby & Utili (2015), Table 2, for the benchmarks: a 10 m tunnel
/// under 20 m of rock with three joint sets. Compiled once, because the solver is most of it.
namespace voussoir_bench {

using Tunnel = voussoir::Solver<>;
inline constexpr double degree = std::numbers::pi / 180;

/// Two readings of the paper's rock mass.
struct Rock {
  voussoir::BlockLimits limits;
  double extent;  ///< of the joints [m]
};
inline constexpr Rock mass_a{{0.25, 5}, 1};  ///< reproduces the moduli that the paper measured
inline constexpr Rock mass_b{{0.36, 5}, 2};  ///< reproduces the mean joint spacing, 0.77 m

/// @param scale  of both sides of the paper's 70 m x 60 m
[[nodiscard]] voussoir::RockMass<voussoir::Planar> generate(const Rock& rock, double scale = 1,
                                                            std::uint64_t seed = 1);
/// Mass A in its in-situ stress with the opening carved, nothing moved; `scale` of the width, the
/// blocks stay as they are.
[[nodiscard]] Tunnel excavated(double scale = 1, std::uint64_t seed = 1);
/// 4 m bolts over the roof, a concrete ring; nothing where a value is 0.
void support(Tunnel& tunnel, double bolt_spacing, double lining_thickness);
/// `Tunnel::equilibrium()` with its default method.
voussoir::EquilibriumReport equilibrium(Tunnel& tunnel);
/// Of the crown [m].
[[nodiscard]] double crown(const Tunnel& tunnel);

}  // namespace voussoir_bench
