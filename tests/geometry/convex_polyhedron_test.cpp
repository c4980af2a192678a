// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>

#include "support/solids.hpp"

namespace convex_polyhedron_test {

using namespace voussoir;
using voussoir_test::box_faces;
using voussoir_test::box_vertices;
using voussoir_test::Faces;
using voussoir_test::solid;

namespace {

std::string refusal(const std::vector<Vec3>& vertices, const Faces& faces) {
  try {
    (void)solid(vertices, faces);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::vector<Vec3> cube = box_vertices({0, 0, 0}, {1, 1, 1});

}  // namespace

TEST_SUITE("geometry/convex_polyhedron") {
  TEST_CASE("vertices that cannot be used are refused with number, place and rule") {
    CHECK(refusal(cube, box_faces()) == "accepted");
    CHECK(contains(refusal({}, {}), "has 0 vertices, needs at least 4"));
    CHECK(contains(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}),
                   "has 3 vertices, needs at least 4"));
    CHECK(contains(refusal(cube, {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}}),
                   "has 3 faces, needs at least 4"));
    const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 8; ++k)
      for (const double bad : {nan, inf, -inf}) {
        CAPTURE(k);
        CAPTURE(bad);
        std::vector<Vec3> vertices = cube;
        vertices[k].z() = bad;
        const std::string text = refusal(vertices, box_faces());
        CHECK(contains(text, "vertex " + std::to_string(k) + " at ("));
        CHECK(contains(text, "coordinates must be finite"));
      }
    for (const double apart : {0.0, 1e-12, 1e-10}) {
      CAPTURE(apart);
      std::vector<Vec3> vertices = cube;
      vertices[7] = vertices[2] + Vec3(apart, 0, 0);
      const std::string text = refusal(vertices, box_faces());
      CHECK(contains(text, "vertex 7 at (0, 1, 0) repeats vertex 2: they are "));
      CHECK(contains(text, "m apart, must be more than 1.73e-09 m"));  // 1e-9 of sqrt(3) m
    }
    std::vector<Vec3> nine = cube;
    nine.emplace_back(0.5, 0.5, 0.5);
    CHECK(contains(refusal(nine, box_faces()),
                   "vertex 8 at (0.5, 0.5, 0.5) belongs to no face, must belong to 3"));
  }

  TEST_CASE("a face that is no polygon is refused by its number") {
    const auto with_face = [](std::size_t f, const std::vector<int>& loop) {
      Faces faces = box_faces();
      faces[f] = loop;
      return faces;
    };
    CHECK(contains(refusal(cube, with_face(2, {})), "face 2 has 0 vertices, needs at least 3"));
    CHECK(contains(refusal(cube, with_face(2, {0, 1})), "face 2 has 2 vertices"));
    CHECK(contains(refusal(cube, with_face(3, {2, 6, 8, 3})),
                   "face 3 names vertex 8, must be 0 to 7"));
    CHECK(contains(refusal(cube, with_face(3, {2, 6, -1, 3})), "face 3 names vertex -1"));
    CHECK(contains(refusal(cube, with_face(4, {0, 2, 3, 2})), "face 4 names vertex 2 twice"));
    CHECK(contains(refusal(cube, with_face(5, {4, 5, 6, 7})), "face 5 has the area 0 m^2"));
    CHECK_THROWS_AS(ConvexPolyhedron(cube, box_faces(), {0, 1, 2, 3, 4}), InvalidInput);
    CHECK_THROWS_AS(ConvexPolyhedron(cube, box_faces(), {0, 1, 2, 3, 4, 5, 6}), InvalidInput);

    std::vector<Vec3> lifted = cube;
    lifted[7].z() = 1.1;
    const std::string text = refusal(lifted, box_faces());
    CHECK(contains(text, "face 5 is not planar: vertex "));
    CHECK(contains(text, "m off its plane, may lie 1.79e-09 m off"));
  }

  TEST_CASE("a face that is not convex or crosses itself is refused") {
    // An L and a pentagram as the base of a prism.
    const std::vector<Vec2> angle = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    std::vector<Vec2> star;
    for (int k = 0; k < 5; ++k) {
      const double turn = 4 * std::numbers::pi / 5 * k;
      star.emplace_back(std::cos(turn), std::sin(turn));
    }
    for (const auto& base : {angle, star}) {
      const int count = static_cast<int>(base.size());
      std::vector<Vec3> vertices;
      Faces faces(2);
      for (int k = 0; k < count; ++k) {
        const Vec2& p = base[static_cast<std::size_t>(k)];
        vertices.emplace_back(p.x(), p.y(), 0);
        vertices.emplace_back(p.x(), p.y(), 1);
        faces[0].insert(faces[0].begin(), 2 * k);
        faces[1].push_back(2 * k + 1);
        const int next = (k + 1) % count;
        faces.push_back({2 * k, 2 * next, 2 * next + 1, 2 * k + 1});
      }
      const std::string text = refusal(vertices, faces);
      CHECK(contains(text, "face 0 is not convex or crosses itself: at vertex "));
    }
  }

  TEST_CASE("a dent, a face or all faces clockwise, no volume, an open side: each by its rule") {
    // The top of the cube pressed in to a pyramid.
    std::vector<Vec3> nine = cube;
    nine.emplace_back(0.5, 0.5, 0.5);
    Faces dented = box_faces();
    dented.pop_back();
    for (const auto& side : {std::pair{4, 5}, {5, 7}, {7, 6}, {6, 4}})
      dented.push_back({side.first, side.second, 8});
    CHECK(contains(refusal(nine, dented), "is not convex: vertex "));
    nine.back().z() = 1.5;  // pulled out
    CHECK(refusal(nine, dented) == "accepted");

    for (std::size_t f = 0; f < 6; ++f) {
      Faces faces = box_faces();
      std::reverse(faces[f].begin(), faces[f].end());
      const std::string text = refusal(cube, faces);
      CHECK(contains(text, "face " + std::to_string(f) + " is clockwise seen from outside"));
      CHECK(contains(text, "lies 1 m above it, must lie below"));
    }
    Faces inside_out = box_faces();
    for (auto& loop : inside_out) std::reverse(loop.begin(), loop.end());
    CHECK(contains(refusal(cube, inside_out), "face 0 is clockwise"));

    for (const double height : {0.0, 1e-12}) {
      const std::string text = refusal({{0, 0, 0}, {1, 0, 0}, {1, 1, height}, {0, 1, 0}},
                                       {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
      CHECK(contains(text, "has no volume: all vertices lie within "));
    }

    for (std::size_t f = 0; f < 6; ++f) {
      Faces faces = box_faces();
      faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(f));
      const std::string text = refusal(cube, faces);
      CHECK(contains(text, "is open: the edge of face "));
      CHECK(contains(text, "has no second face"));
    }
    Faces doubled = box_faces();
    doubled.push_back(doubled[4]);
    CHECK(contains(refusal(cube, doubled), "faces 4 and 6 both run from vertex 0 to 2"));
  }

  TEST_CASE("the number of the block is put in front by whoever builds a list, which stays whole") {
    std::vector<ConvexPolyhedron> blocks = {solid(cube, box_faces())};
    std::vector<Vec3> bad = cube;
    bad[3].x() = std::nan("");
    std::string text;
    try {
      blocks.push_back(naming("block 17", [&] { return solid(bad, box_faces()); }));
    } catch (const InvalidInput& error) {
      text = error.what();
    }
    CHECK(text.starts_with("block 17: convex polyhedron: vertex 3 at ("));
    CHECK(blocks.size() == 1);
  }

  TEST_CASE("needles, plates and small blocks a thousand kilometres away are accepted") {
    Random random(1);
    for (const ConvexPolyhedron& shape :
         {voussoir_test::needle(), voussoir_test::plate(),
          voussoir_test::box({0, 0, 0}, {0.1, 0.2, 0.1}), voussoir_test::regular_prism(7, 0.3, 1)})
      for (int trial = 0; trial < 20; ++trial) {
        Pose<3> pose;
        pose.rotation = voussoir_test::random_rotation(random);
        // The thinnest is 1e-4 m, and coordinates of 1e6 m are rounded to 1.2e-10 m.
        pose.position = 1e6 * voussoir_test::random_direction(random);
        CHECK_NOTHROW((void)voussoir_test::placed(shape, pose));
      }
  }

  TEST_CASE("a box: planes, loops, edges, area and diameter") {
    const ConvexPolyhedron shape = voussoir_test::box({1, 2, 3}, {3, 5, 7});
    REQUIRE(shape.size() == 6);
    CHECK(shape.diameter() == std::sqrt(4.0 + 9 + 16));
    CHECK(shape.surface_area() == 2 * (2 * 3 + 3 * 4 + 4 * 2));
    for (std::size_t k = 0; k < 6; ++k) {
      const int axis = static_cast<int>(k) / 2;
      const HalfSpace<3> side = shape.half_space(k);
      CHECK(side.normal == (k % 2 == 0 ? Vec3(-Vec3::Unit(axis)) : Vec3(Vec3::Unit(axis))));
      CHECK(side.offset == std::vector<double>{-1, 3, -2, 5, -3, 7}[k]);
      CHECK(shape.cut(k) == static_cast<int>(k));
      for (const int v : shape.loop(k))
        CHECK(side.distance(shape.vertex(static_cast<std::size_t>(v))) == 0);
      CHECK(shape.distance(k, {2, 3, 5}) == -std::vector<double>{1, 1, 1, 2, 2, 2}[k]);
    }
    const auto edges = shape.edges();
    REQUIRE(edges.size() == 12);
    CHECK(shape.edge_count() == 12);
    std::set<std::pair<int, int>> seen;
    for (const auto& edge : edges) {
      seen.emplace(std::min(edge.from, edge.to), std::max(edge.from, edge.to));
      // The left face runs along the edge, the right one against it; the edge is that of their
      // planes: left normal x right normal points along it where the solid is convex.
      const Vec3 along = shape.vertex(static_cast<std::size_t>(edge.to)) -
                         shape.vertex(static_cast<std::size_t>(edge.from));
      const Vec3 axis = cross(shape.half_space(static_cast<std::size_t>(edge.left)).normal,
                              shape.half_space(static_cast<std::size_t>(edge.right)).normal);
      CHECK(axis.dot(along) == along.norm());
    }
    CHECK(seen.size() == 12);
  }

  TEST_CASE("normals point outwards and no vertex is above a plane, near and far") {
    Random random(2);
    for (const double far : {0.0, 1e6}) {
      for (int trial = 0; trial < 30; ++trial) {
        Pose<3> pose;
        pose.rotation = voussoir_test::random_rotation(random);
        pose.position = far * voussoir_test::random_direction(random);
        const auto shape =
            voussoir_test::placed(voussoir_test::random_solid(random, trial % 12), pose);
        // One rounding of the largest coordinate, and a few of the size.
        const double rounding = 4e-16 * (far + 2);
        for (std::size_t k = 0; k < shape.size(); ++k) {
          CHECK(std::abs(shape.half_space(k).normal.norm() - 1) < 1e-15);
          for (const Vec3& v : shape.vertices()) {
            CHECK(shape.half_space(k).distance(v) <= rounding);
            // Between vertices only their own rounding counts, which turns the planes of faces
            // 1e-4 m across by 1e-6.
            CHECK(shape.distance(k, v) <= (far > 0 ? 1e-9 : 1e-13));
          }
        }
      }
    }
  }

  TEST_CASE("the support is the farthest vertex in any direction, near and far") {
    Random random(3);
    for (const double far : {0.0, 1e6})
      for (int trial = 0; trial < 50; ++trial) {
        Pose<3> pose;
        pose.position = far * voussoir_test::random_direction(random);
        const auto shape =
            voussoir_test::placed(voussoir_test::random_solid(random, trial % 10), pose);
        const Vec3 direction = (1 + trial) * voussoir_test::random_direction(random);
        long double farthest = -1e30L;
        std::size_t expected = 0;
        for (std::size_t k = 0; k < shape.vertices().size(); ++k) {
          long double along = 0;
          for (int i = 0; i < 3; ++i)
            along += static_cast<long double>(direction[i]) * shape.vertex(k)[i];
          if (along > farthest) {
            farthest = along;
            expected = k;
          }
        }
        CHECK(shape.support(direction) == expected);
      }
    // Of equals the first, for the same answer everywhere.
    CHECK(voussoir_test::box({0, 0, 0}, {1, 1, 1}).support({0, 0, 1}) == 4);
    CHECK(voussoir_test::box({0, 0, 0}, {1, 1, 1}).support({0, 0, 0}) == 0);
  }

  TEST_CASE("a point is inside where it is a mixture of the vertices, and not beyond a face") {
    Random random(4);
    for (int trial = 0; trial < 50; ++trial) {
      const auto shape = voussoir_test::random_solid(random, trial % 10);
      Vec3 mixture = Vec3::Zero();
      double total = 0;
      for (const Vec3& v : shape.vertices()) {
        const double share = random.uniform();
        total += share;
        mixture += share * v;
      }
      mixture /= total;
      CHECK(shape.contains(mixture));
      for (std::size_t k = 0; k < shape.size(); ++k) {
        const Vec3 on_face = shape.face(k).centre(), normal = shape.half_space(k).normal;
        CHECK(shape.contains(on_face, 1e-15));
        CHECK_FALSE(shape.contains(on_face + 1e-9 * normal));
        CHECK(shape.contains(on_face + 1e-9 * normal, 2e-9));
      }
    }
  }

  TEST_CASE(
      "vertices welded into one take the faces between them away, and the rest stays closed") {
    // The top edge 5-7 of the cube shortened to nothing: the face x = 1 becomes a triangle, and so
    // does the top; no face is lost. Then the top is shrunk to a point: it goes.
    ConvexPolyhedron wedge = voussoir_test::box({0, 0, 0}, {1, 1, 1});
    CHECK(wedge.move_vertices([](const Vec3& v) { return v; }) == 0);
    CHECK(wedge.vertices().size() == 8);
    const auto merge = [](ConvexPolyhedron& shape, const Vec3& from, const Vec3& to) {
      return shape.move_vertices([&](const Vec3& v) { return v == from ? to : v; });
    };
    CHECK(merge(wedge, {1, 1, 1}, {1, 0, 1}) == 0);
    CHECK(wedge.vertices().size() == 7);
    CHECK(wedge.edge_count() == 11);
    CHECK(merge(wedge, {0, 1, 1}, {0, 0, 1}) == 1);  // y high and top now meet along one edge
    CHECK(wedge.vertices().size() == 6);
    CHECK(wedge.size() == 5);
    CHECK(wedge.edge_count() == 9);  // a wedge
    std::set<int> labels;
    for (std::size_t k = 0; k < wedge.size(); ++k) labels.insert(wedge.cut(k));
    CHECK(labels == std::set<int>{0, 1, 2, 3, 4});
    CHECK(wedge.edges().size() == 9);

    // What would leave nothing is not done.
    ConvexPolyhedron gone = voussoir_test::box({0, 0, 0}, {1, 1, 1});
    CHECK(gone.move_vertices([](const Vec3&) { return Vec3(0, 0, 0); }) == 0);
    CHECK(gone.size() == 6);
    ConvexPolyhedron flat = voussoir_test::box({0, 0, 0}, {1, 1, 1});
    CHECK(flat.move_vertices([](const Vec3& v) { return Vec3(v.x(), v.y(), 0); }) == 0);
    CHECK(flat.size() == 6);
  }
}

}  // namespace convex_polyhedron_test
