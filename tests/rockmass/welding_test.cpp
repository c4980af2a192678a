// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/welding.hpp>

#include "support/jointed_rock.hpp"
#include "support/shapes.hpp"

namespace welding_test {

using namespace voussoir;

TEST_SUITE("rockmass/welding") {
  TEST_CASE("points in a lattice of clusters: each cluster becomes its first point") {
    Random random(1);
    const double tolerance = 1e-9;
    Welder welder(tolerance);
    // Clusters 1e-7 apart, so that many lie across the borders of the welder's cells.
    std::vector<Vec2> first;
    for (int k = 0; k < 400; ++k) first.push_back(1e-7 * Vec2(k % 20 - 10, k / 20 - 10));
    for (const Vec2& p : first) CHECK(welder(p) == p);
    for (int k = 0; k < 4000; ++k) {
      const Vec2& centre = first[static_cast<std::size_t>(random.below(400))];
      const double angle = 2 * std::numbers::pi * random.uniform();
      const Vec2 near =
          centre + 0.99 * tolerance * random.uniform() * Vec2(std::cos(angle), std::sin(angle));
      CHECK(welder(near) == centre);
    }
    const Vec2 outside = first[0] + Vec2(1.01 * tolerance, 0);
    CHECK(welder(outside) == outside);
  }

  TEST_CASE(
      "in sliced and carved rock two vertices are the same or further apart than the tolerance") {
    const Domain<2> ground{{-10, -8}, {10, 9}};
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto sliced = voussoir_test::jointed_rock(ground, seed, {0.1, 20}, 3);
      const auto carved = carve(sliced, SimplePolygon(voussoir_test::regular(36, 3)), 0);
      for (const auto* mass : {&sliced, &carved}) {
        std::vector<Vec2> vertices;
        for (const auto& body : mass->bodies)
          for (const auto& part : body.parts)
            vertices.insert(vertices.end(), part.vertices().begin(), part.vertices().end());
        std::sort(vertices.begin(), vertices.end(), [](const Vec2& a, const Vec2& b) {
          return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
        });
        const double tolerance = ground.tolerance();
        std::size_t shared = 0;
        for (std::size_t i = 0; i < vertices.size(); ++i)
          for (std::size_t j = i + 1;
               j < vertices.size() && vertices[j].x() - vertices[i].x() <= tolerance; ++j) {
            const double distance = (vertices[i] - vertices[j]).norm();
            CHECK((distance == 0 || distance > tolerance));
            shared += distance == 0 ? 1 : 0;
          }
        CHECK(shared > vertices.size() / 2);
      }
    }
  }

  TEST_CASE("a face whose ends become one vertex is dropped, with its label") {
    // A square with a bevel of 1e-10 m at (1, 1): face 2.
    std::vector<Body<Planar>> bodies(1);
    bodies[0].parts.push_back(
        voussoir_test::polygon({{0, 0}, {1, 0}, {1, 1 - 1e-10}, {1 - 1e-10, 1}, {0, 1}}));
    CHECK(weld(bodies, 1e-9) == 1);
    const ConvexPolygon& square = bodies[0].parts[0];
    REQUIRE(square.size() == 4);
    std::vector<int> labels;
    for (std::size_t k = 0; k < 4; ++k) labels.push_back(square.cut(k));
    CHECK(labels == std::vector<int>{0, 1, 3, 4});
    CHECK(weld(bodies, 1e-9) == 0);
  }
}

}  // namespace welding_test
