// expect: Solver: a policy has the parts of a contact detector and declares another role
// SPDX-License-Identifier: MIT
// Both have a `find`.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Detector {
  using role = roles::Equilibrium;
  static constexpr const char* name = "Detector";
  template <class Geometry>
  static std::vector<ContactFacet<Geometry>> find(const RockMass<Geometry>&) {
    return {};
  }
};

}  // namespace

template struct voussoir::Composition<Detector>;
