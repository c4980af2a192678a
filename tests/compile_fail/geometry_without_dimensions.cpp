// expect: geometry: add `static constexpr int dim, dof, tangents`: 2, 3, 1 or 3, 6, 2
// SPDX-License-Identifier: MIT
// How many numbers describe a motion is asked for everywhere.
#include <voussoir/geometry/geometry_model.hpp>

namespace {

using namespace voussoir;

struct Flat {
  using role = roles::Geometry;
  static constexpr const char* name = "Flat";
  using Shape = int;
  using Facet = int;
  using Trace = int;
  using Line = int;
  using Opening = int;
};

}  // namespace

static_assert(voussoir::explain_geometry<Flat>());
