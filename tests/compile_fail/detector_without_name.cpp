// expect: contact detector: add `static constexpr const char* name` for the log
// SPDX-License-Identifier: MIT
// The solver prints what it is made of.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Detector {
  using role = roles::ContactDetector;
  template <class Geometry>
  static std::vector<ContactFacet<Geometry>> find(const RockMass<Geometry>&) {
    return {};
  }
};

}  // namespace

template struct voussoir::Composition<Detector>;
