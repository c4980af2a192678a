// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <vector>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>

#include "support/degree.hpp"

namespace voussoir_test {

/// The paper's joint sets: 75 E, 25 E, 25 W, one centre per square metre and set. Endless ones,
/// which have no centres per area, are 100 m long here: right through any ground of the tests.
[[nodiscard]] inline std::vector<voussoir::JointSet> paper_sets(double extent = 1) {
  using enum voussoir::DipDirection;
  extent = std::min(extent, 100.0);
  return {{"J1", 75 * degree, east, 1 * degree, 1, 0, extent},
          {"J2", 25 * degree, east, 1 * degree, 1, 0, extent},
          {"J3", 25 * degree, west, 1 * degree, 1, 0, extent}};
}

/// Rock with these sets in the ground given. The limits are those of reference mass A: inscribed
/// radius 0.25 m, elongation 5.
[[nodiscard]] inline voussoir::RockMass<voussoir::Planar> jointed_rock(
    const voussoir::Domain<2>& ground, std::uint64_t seed,
    const voussoir::BlockLimits& limits = {0.25, 5}, double extent = 1) {
  return voussoir::slice(ground, voussoir::joint_network(paper_sets(extent), ground, seed), limits);
}

}  // namespace voussoir_test
