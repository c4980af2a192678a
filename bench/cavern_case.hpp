// SPDX-License-Identifier: MIT
#pragma once
// A supported tunnel in 3-D: 10 m wide, 12 m of it, under 20 m of rock, 36 k m3 around it; 4 m
// bolts, 0.15 m of shotcrete with ribs.
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/solver/solver.hpp>

namespace voussoir_bench {

using Cavern = voussoir::Solver<voussoir::Spatial, voussoir::TimoshenkoBeam>;

/// Excavated, not yet relaxed.
[[nodiscard]] Cavern excavated_cavern(double spacing);
/// Excavated and supported, not yet relaxed.
/// @param spacing  of the joints of each of the three sets [m]: 1 makes 10 472 bodies, 0.45 85 967
[[nodiscard]] Cavern cavern(double spacing);

}  // namespace voussoir_bench
