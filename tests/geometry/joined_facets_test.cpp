// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/joined_facets.hpp>
#include <voussoir/geometry/part_of.hpp>

#include "support/shapes.hpp"
#include "support/solids.hpp"

namespace joined_facets_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

constexpr double tolerance = 1e-9;

SpatialFacet facet_of(const std::vector<Vec2>& outline, const Pose<3>& pose) {
  SpatialFacet facet;
  for (const Vec2& p : outline) facet.vertices.push_back(pose({p.x(), p.y(), 0}));
  return facet;
}

/// Cut at random, part by part, as carving does.
std::vector<SpatialFacet> parts_of(Random& random, const SpatialFacet& whole, int cuts) {
  std::vector<SpatialFacet> parts{whole};
  const Vec3 normal = normalized(whole.area_vector());
  for (int k = 0; k < cuts; ++k) {
    const std::size_t n = random.below(parts.size());
    const Vec3 way =
        normalized(cross(normal, Vec3(random.normal(), random.normal(), random.normal())));
    const auto side = HalfSpace<3>::through(parts[n].centre(), way);
    const auto one = part_of(parts[n], side, tolerance),
               other = part_of(parts[n], HalfSpace<3>{-side.normal, -side.offset}, tolerance);
    REQUIRE(one);
    REQUIRE(other);
    parts[n] = *one;
    parts.push_back(*other);
  }
  return parts;
}

}  // namespace

TEST_SUITE("geometry/joined_facets") {
  TEST_CASE("a segment in parts of any order is one again, a gap and a corner stay") {
    Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
      const Segment whole{{random.normal(), random.normal()}, {5 + random.normal(), 0}};
      std::vector<double> ends{0, 1};
      for (std::size_t k = random.below(6); k > 0; --k) ends.push_back(random.uniform());
      std::sort(ends.begin(), ends.end());
      std::vector<Segment> parts;
      for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        parts.push_back({whole.at(ends[k]), whole.at(ends[k + 1])});
      const Vec2 aside = perpendicular(whole.end - whole.start);
      parts.push_back({whole.end, whole.end + aside});  // round a corner
      parts.push_back({whole.at(1.5), whole.at(2)});    // behind a gap
      parts.push_back({whole.start, whole.at(-0.5)});   // looks the other way
      random.shuffle(parts);
      const auto made = joined_facets(parts, tolerance);
      REQUIRE(made.size() == 4);
      // The ends are those of the parts, to the last digit.
      CHECK(std::count_if(made.begin(), made.end(), [&](const Segment& s) {
              return s.start == whole.at(0) && s.end == whole.at(1);
            }) == 1);
    }
  }

  TEST_CASE("a convex polygon in parts of any order is one again, with its own corners alone") {
    Random random(2);
    for (int trial = 0; trial < 200; ++trial) {
      Pose<3> pose;
      pose.rotation = random_rotation(random);
      pose.position = 10 * random_direction(random);
      const auto outline = random_convex(random, 12, 3, 1 + random.uniform()).vertices();
      const SpatialFacet whole = facet_of(outline, pose);
      auto parts = parts_of(random, whole, static_cast<int>(random.below(8)));
      random.shuffle(parts);
      const auto made = joined_facets(parts, tolerance);
      REQUIRE(made.size() == 1);
      CHECK(made[0].vertices.size() == whole.vertices.size());
      // A few roundings of coordinates up to some 10 m.
      CHECK(length_of(made[0].area_vector() - whole.area_vector()) < 1e-12);
      CHECK(length_of(made[0].centre() - whole.centre()) < 1e-12);
    }
  }

  TEST_CASE("other planes, other sides, gaps and what is not convex stay, whichever comes first") {
    Pose<3> pose;
    pose.position = {3, -2, 1};
    const auto box = [&](double x, double y, double width, double height) {
      return facet_of({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, pose);
    };
    const auto count_of = [](std::vector<SpatialFacet> facets) {
      const std::size_t made = joined_facets(facets, tolerance).size();
      std::reverse(facets.begin(), facets.end());
      CHECK(joined_facets(facets, tolerance).size() == made);
      return made;
    };
    CHECK(count_of({box(0, 0, 1, 1), box(1, 0, 1, 1)}) == 1);
    CHECK(count_of({box(0, 0, 1, 1), box(1.01, 0, 1, 1)}) == 2);                // a gap
    CHECK(count_of({box(0, 0, 1, 1), box(1, 0, 1, 2)}) == 2);                   // an L
    CHECK(count_of({box(0, 0, 1, 1), box(1, 0, 1, 1), box(0, 1, 1, 1)}) == 2);  // an L of three
    SpatialFacet behind = box(1, 0, 1, 1), lower = box(1, 0, 1, 1);
    std::reverse(behind.vertices.begin(), behind.vertices.end());
    for (Vec3& v : lower.vertices) v.z() -= 1e-3;
    CHECK(count_of({box(0, 0, 1, 1), behind}) == 2);
    CHECK(count_of({box(0, 0, 1, 1), lower}) == 2);
    // A sliver and a speck that the tolerance makes a line and a point stay what they are.
    for (const SpatialFacet& small : {box(0, 0, 1, tolerance), box(0, 0, tolerance, tolerance)}) {
      const auto made = joined_facets(std::vector<SpatialFacet>{small}, tolerance);
      REQUIRE(made.size() == 1);
      CHECK(made[0].measure() == small.measure());
    }
    CHECK(joined_facets(std::vector<SpatialFacet>{}, tolerance).empty());
  }
}

}  // namespace joined_facets_test
