// expect: bolt anchors: add `static constexpr const char* name` for the log
// SPDX-License-Identifier: MIT
// The solver prints what it is made of.
#include <voussoir/bolt/bolt_anchors.hpp>

namespace {

using namespace voussoir;

struct Anchors {
  using role = roles::BoltAnchors;
  [[nodiscard]] AnchorDistances distances(const BoltCrossing& crossing) const {
    return {0.25 * crossing.before, 0.25 * crossing.after};
  }
};

}  // namespace

static_assert(voussoir::explain_bolt_anchors<Anchors>());
