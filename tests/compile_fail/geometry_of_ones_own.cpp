// expect: geometry: it is `Planar` or `Spatial`; there are no others
// SPDX-License-Identifier: MIT
// Shapes under the same names are not enough.
#include <voussoir/solver/composition.hpp>

namespace {

using namespace voussoir;

struct Flat : Planar {
  static constexpr const char* name = "Flat";
};

}  // namespace

static_assert(sizeof(voussoir::Composition<Flat>) > 0);
