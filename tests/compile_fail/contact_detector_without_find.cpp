// expect: contact detector: add `static std::vector<ContactFacet<Geometry>> find
// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

namespace {
struct Detector {
  using role = voussoir::roles::ContactDetector;
  static constexpr const char* name = "Detector";
};
}  // namespace

using Broken = voussoir::Composition<Detector>;
static_assert(sizeof(Broken) > 0);
