// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/bolt/any_anchors.hpp>
#include <voussoir/bolt/any_bolt.hpp>
#include <voussoir/contact/any_joint.hpp>
#include <voussoir/contact/rock_on_lining.hpp>
#include <voussoir/lining/any_lining.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/solver/solver.hpp>

#include "design_rock.hpp"

/// The design case of Boon, Houlsby & Utili (2015), Table 2, for the benchmarks: a 10 m tunnel
/// under 20 m of rock with three joint sets. Compiled once, because the solver is most of it.
namespace voussoir_bench {

using Tunnel = voussoir::Solver<>;
/// The same physics by models that are known at run time, as an input file has them.
using AnyTunnel =
    voussoir::Solver<voussoir::AnyJoint, voussoir::RockOnLining<voussoir::MohrCoulombJoint>,
                     voussoir::AnyAnchors, voussoir::AnyBolt, voussoir::AnyLining>;
using voussoir::paper::degree;

/// @param scale  of both sides of the paper's 70 m x 60 m
[[nodiscard]] voussoir::RockMass<voussoir::Planar> generate(
    const voussoir::paper::RockReading& rock, double scale = 1);
/// Mass A in its in-situ stress with the opening carved, nothing moved; `scale` of the width, the
/// blocks stay as they are.
[[nodiscard]] Tunnel excavated(double scale = 1);
[[nodiscard]] AnyTunnel excavated_of_variants(double scale = 1);
/// The same rock under the same cover, in a domain `width` wide and 6/7 of that deep [m]: 5 660
/// blocks at 70 m, 105 130 at 300 m, 860 619 at 858 m, with the lining nodes.
[[nodiscard]] Tunnel excavated_square(double width);
/// 4 m bolts over the roof, a concrete ring; nothing where a value is 0.
void support(Tunnel& tunnel, double bolt_spacing, double lining_thickness);
void support(AnyTunnel& tunnel, double bolt_spacing, double lining_thickness);
/// `Tunnel::equilibrium()` with its default method.
voussoir::EquilibriumReport equilibrium(Tunnel& tunnel);
voussoir::EquilibriumReport equilibrium(AnyTunnel& tunnel);
/// Of the crown [m].
[[nodiscard]] double crown(const Tunnel& tunnel);
[[nodiscard]] double crown(const AnyTunnel& tunnel);

}  // namespace voussoir_bench
