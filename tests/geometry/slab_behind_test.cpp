// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/geometry/slab_behind.hpp>

#include "support/near.hpp"

namespace slab_behind_test {

using namespace voussoir;

// The volume is the area times the thickness; the facet is a face of it that looks its own way.
TEST_SUITE("geometry/slab_behind") {
  TEST_CASE("a slab has its facet as a face, and lies behind it") {
    const Segment line{{1, 2}, {4, 6}};  // 5 m long
    const ConvexPolygon flat = slab_behind(line, 0.3);
    CHECK(mass_properties(flat).measure == voussoir_test::near(1.5).epsilon(1e-12));
    const Vec2 middle = line.centre() - 0.15 * line.area_vector().normalized();
    CHECK((mass_properties(flat).centroid - middle).norm() < 1e-12);

    for (const bool turned_over : {false, true}) {
      SpatialFacet facet{{Vec3(0, 0, 0), Vec3(2, 0, 1), Vec3(3, 2, 1.5), Vec3(0.5, 3, 0.25)}};
      if (turned_over) std::reverse(facet.vertices.begin(), facet.vertices.end());
      const ConvexPolyhedron slab = slab_behind(facet, 0.3);
      const Vec3 normal = facet.area_vector().normalized();
      CHECK(mass_properties(slab).measure ==
            voussoir_test::near(0.3 * facet.measure()).epsilon(1e-12));
      CHECK(slab.size() == 6);
      CHECK((slab.half_space(0).normal - normal).norm() < 1e-12);
      CHECK((slab.face(0).centre() - facet.centre()).norm() < 1e-12);
      CHECK(slab.contains(facet.centre() - 0.15 * normal));
      CHECK_FALSE(slab.contains(facet.centre() + 0.01 * normal));
    }
  }

  TEST_CASE("what is not a facet is refused") {
    const SpatialFacet line{{Vec3(0, 0, 0), Vec3(1, 0, 0)}};
    CHECK_THROWS_AS((void)slab_behind(line, 1), InvalidInput);
    const SpatialFacet dented{{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0.2, 0.2, 0), Vec3(0, 2, 0)}};
    CHECK_THROWS_AS((void)slab_behind(dented, 1), InvalidInput);
  }
}

}  // namespace slab_behind_test
