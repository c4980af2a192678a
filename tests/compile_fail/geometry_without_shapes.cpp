// expect: geometry: add the types `Shape`, `Facet`, `Trace`, `Line` and `Opening`
// SPDX-License-Identifier: MIT
// Blocks, facets, joints, bolts and openings have a type each.
#include <voussoir/geometry/geometry_model.hpp>

namespace {

using namespace voussoir;

struct Flat {
  using role = roles::Geometry;
  static constexpr const char* name = "Flat";
  static constexpr int dim = 2, dof = 3, tangents = 1;
};

}  // namespace

static_assert(voussoir::explain_geometry<Flat>());
