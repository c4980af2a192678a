// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <voussoir/design/limit_load.hpp>
#include <voussoir/geometry/mass_properties.hpp>

#include "support/laid_problem.hpp"

namespace voussoir_test {

/// Blocks that are laid, as the product's limit analysis has them. Contacts are found face by face,
/// as those of the simplex are.
[[nodiscard]] inline voussoir::design::LimitProblem<2> limit_problem(
    const LaidProblem& laid, const voussoir::design::JointStrength& strength) {
  voussoir::design::LimitProblem<2> problem;
  for (std::size_t b = 0; b < laid.blocks.size(); ++b) {
    const auto properties = voussoir::mass_properties(laid.blocks[b]);
    problem.blocks.push_back({properties.centroid, laid.weight(b),
                              std::sqrt(properties.second_moment.trace() / properties.measure),
                              laid.dead_load(b), !laid.is_fixed(b)});
  }
  for (const FlatJoint& joint : joints_of(laid))
    problem.add_contact(joint.a, joint.b, {joint.p, joint.q}, joint.normal, strength);
  return problem;
}

}  // namespace voussoir_test
