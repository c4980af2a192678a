// expect: bolt anchors: add `AnchorDistances distances
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
struct Anchors {
  using role = voussoir::roles::BoltAnchors;
  static constexpr const char* name = "Anchors";
};
}  // namespace

using Broken = voussoir::Composition<Anchors>;
static_assert(sizeof(Broken) > 0);
