// expect: contact detector: add `static std::vector<ContactFacet<Geometry>> find(const RockMass<Geometry>&)`
// SPDX-License-Identifier: MIT
// A contact detector that finds nothing, not even an empty list.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Detector {
  using role = roles::ContactDetector;
  static constexpr const char* name = "Detector";
};

}  // namespace

template struct voussoir::Composition<Detector>;
