// expect: Solver: a policy has the parts of bolt anchors and declares another role
// SPDX-License-Identifier: MIT
// Anchors are not the law of a bolt.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Anchors {
  using role = roles::BoltLaw;
  static constexpr const char* name = "Anchors";
  [[nodiscard]] AnchorDistances distances(const BoltCrossing& crossing) const {
    return {0.25 * crossing.before, 0.25 * crossing.after};
  }
};

}  // namespace

template struct voussoir::Composition<Anchors>;
