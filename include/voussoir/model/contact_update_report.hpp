// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace voussoir {

/// What contact updates of rock at rest have done to it. None moves a body: where the contacts that
/// are found carry the forces of those before exactly, all of it is 0.
struct ContactUpdateReport {
  int count = 0;  ///< updates
  /// Given to the springs of contacts; < 0: lost. With it what the small displacements since the
  /// update before were wrong by where blocks have turned [J]; 2-D: [J/m].
  double energy = 0;
  double made = 0;          ///< given to contacts that got more than those of their bodies held [J]
  double largest_jump = 0;  ///< of a body's out-of-balance force, over its weight [-]

  void add(const ContactUpdateReport& other) {
    count += other.count;
    energy += other.energy;
    made += other.made;
    largest_jump = std::max(largest_jump, other.largest_jump);
  }
};

}  // namespace voussoir
