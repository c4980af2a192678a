// expect: geometry: add `static constexpr const char* name` for the log
// SPDX-License-Identifier: MIT
// The solver prints what it is made of.
#include <voussoir/geometry/geometry_model.hpp>

namespace {

using namespace voussoir;

struct Flat {
  using role = roles::Geometry;
  static constexpr int dim = 2, dof = 3, tangents = 1;
  using Shape = int;
  using Facet = int;
  using Trace = int;
  using Line = int;
  using Opening = int;
};

}  // namespace

static_assert(voussoir::explain_geometry<Flat>());
