// expect: bolt anchors: add `AnchorDistances distances(const BoltCrossing&) const` [m]
// SPDX-License-Identifier: MIT
// Bolt anchors that do not say where they grip.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Anchors {
  using role = roles::BoltAnchors;
  static constexpr const char* name = "Anchors";
};

}  // namespace

template struct voussoir::Composition<Anchors>;
