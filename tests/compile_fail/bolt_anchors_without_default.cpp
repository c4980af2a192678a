// expect: bolt anchors: add a default constructor (the documented default placement)
// SPDX-License-Identifier: MIT
// Bolts are installed without naming the placement, so it needs a default.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Anchors {
  using role = roles::BoltAnchors;
  static constexpr const char* name = "Anchors";
  [[nodiscard]] AnchorDistances distances(const BoltCrossing& crossing) const {
    return {0.25 * crossing.before, 0.25 * crossing.after};
  }
  explicit Anchors(double) {}
};

}  // namespace

template struct voussoir::Composition<Anchors>;
