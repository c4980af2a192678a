// SPDX-License-Identifier: MIT
// The detector against its long double twin, on blocks and positions made to be hard.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/rockmass/domain.hpp>

#include "support/pairs.hpp"
#include "support/separating_axes.hpp"
#include "support/solids.hpp"

namespace face_contacts_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

template <int Dim>
struct Dimensions {
  static constexpr int dim = Dim;
  /// Of a separation: blocks of about 1 m, some 100 m from the origin, where coordinates are
  /// rounded to 1.4e-14 m [m].
  static constexpr double tolerance = Dim == 2 ? 1e-13 : 1e-11;
  static constexpr int pairs = Dim == 2 ? 4000 : 800;
};

/// What the detector says, kept beyond its next query.
template <int Dim>
struct Answer {
  bool overlap = false;
  double separation = 0;
  Touch touch = Touch::none;
  Vec<Dim> normal = Vec<Dim>::Zero();
  double depth = 0, measure = 0;
  std::vector<Vec<Dim>> polygon;

  friend bool operator==(const Answer&, const Answer&) = default;  // bit for bit
};

template <class Pair, int Dim>
Answer<Dim> ask(Pair& pair, std::size_t a, std::size_t b, typename Pair::Memory memory,
                double reach = 0) {
  Answer<Dim> answer;
  typename Pair::Memory other = memory;
  answer.overlap = pair.overlap(a, b, other);
  other = memory;
  answer.separation = pair.separation(a, b, other);
  const Contact<Dim> contact = pair.contact(a, b, memory, reach);
  answer.touch = contact.touch;
  answer.normal = contact.normal;
  answer.depth = contact.separation;
  answer.measure = contact.measure;
  answer.polygon.assign(contact.polygon.begin(), contact.polygon.end());
  return answer;
}

/// A pair for the detector and for the reference.
template <int Dim, class Lanes = detail::VectorLanes>
class Twin {
 public:
  using Pair = FaceContacts::Pair<Dim, Lanes>;

  explicit Twin(const PlainPair<Dim>& pair)
      : a(long_shape(pair.a, pair.pose_a)), b(long_shape(pair.b, pair.pose_b)) {
    shapes_.add(convex(pair.a), Vec<Dim>::Zero());
    shapes_.add(convex(pair.b), Vec<Dim>::Zero());
    place(pair);
  }
  void place(const PlainPair<Dim>& pair) {
    shapes_.place(0, pair.pose_a);
    shapes_.place(1, pair.pose_b);
  }
  [[nodiscard]] Answer<Dim> cold(double reach = 0) const {
    Pair pair(shapes_);
    return ask<Pair, Dim>(pair, 0, 1, {}, reach);
  }
  [[nodiscard]] Answer<Dim> swapped(double reach = 0) const {
    Pair pair(shapes_);
    return ask<Pair, Dim>(pair, 1, 0, {}, reach);
  }
  [[nodiscard]] const PlacedShapes<Dim>& shapes() const { return shapes_; }

  LongShape<Dim> a, b;

 private:
  PlacedShapes<Dim> shapes_;
};

/// Calls `check(pair, twin, exact)` with random pairs of all families.
template <int Dim, class Check>
void for_pairs(std::uint64_t seed, int count, Check&& check) {
  Random random(seed);
  for (int k = 0; k < count; ++k) {
    const PlainPair<Dim> pair = random_pair<Dim>(random);
    const Twin<Dim> twin(pair);
    CAPTURE(k);
    check(pair, twin, separating_axes(twin.a, twin.b));
  }
}

/// Part of a face of `q` in front of face `f` of `p`: over it, and no higher than `reach`.
template <int Dim>
std::vector<LongVec<Dim>> part_over(const LongShape<Dim>& p, std::size_t f, const LongShape<Dim>& q,
                                    std::size_t face, double reach) {
  const LongVec<Dim>& n = p.normals[f];
  const auto rim = p.corners(p.faces[f]);
  auto part = clipped<Dim>(q.corners(q.faces[face]), [&](const LongVec<Dim>& x) {
    return n.dot(x - rim[0]) - static_cast<long double>(reach);
  });
  for (std::size_t k = 0; k < rim.size() && !part.empty(); ++k) {
    const LongVec<Dim>& next = rim[(k + 1) % rim.size()];
    LongVec<Dim> side;
    if constexpr (Dim == 2)
      side = rim[k] - next;
    else
      side = long_cross(next - rim[k], n);
    part = clipped<Dim>(part, [&](const LongVec<Dim>& x) { return side.dot(x - rim[k]); });
  }
  return part;
}

/// Its length or area as seen along the normal of the face.
template <int Dim>
double measure_over(const LongShape<Dim>& p, std::size_t f, const LongShape<Dim>& q,
                    std::size_t face, double reach) {
  const auto part = part_over(p, f, q, face, reach);
  if constexpr (Dim == 2) {
    if (part.size() < 2) return 0;
    const LongVec<2> along(-p.normals[f][1], p.normals[f][0]);
    return static_cast<double>(std::abs(along.dot(part.back() - part.front())));
  } else {
    return part.size() < 3 ? 0
                           : static_cast<double>(std::abs(area_vector_of(part).dot(p.normals[f])));
  }
}

/// Area of the section of both shapes by the plane through `point` perpendicular to `normal`.
double section_area(const LongShape<3>& a, const LongShape<3>& b, const LongVec<3>& point,
                    const LongVec<3>& normal) {
  const LongVec<3> helper = std::abs(normal[0]) < 0.6L ? LongVec<3>::UnitX() : LongVec<3>::UnitY();
  const LongVec<3> u = 10 * long_cross(normal, helper).normalized(), v = long_cross(normal, u);
  std::vector<LongVec<3>> part{point - u - v, point + u - v, point + u + v, point - u + v};
  for (const LongShape<3>* shape : {&a, &b})
    for (std::size_t f = 0; f < shape->faces.size() && !part.empty(); ++f)
      part = clipped<3>(part, [&](const LongVec<3>& x) {
        return shape->normals[f].dot(x - shape->at(shape->faces[f][0]));
      });
  return static_cast<double>(measure_of<3>(part));
}

/// The faces of a shape along which another is kept away nearly (1e-9 m) as far as by the best.
template <int Dim>
std::vector<std::size_t> best_faces(const LongShape<Dim>& p, const LongShape<Dim>& q) {
  std::vector<long double> rooms;
  for (const auto& n : p.normals) rooms.push_back(room_along<Dim>(p, q, n));
  const long double best = *std::max_element(rooms.begin(), rooms.end());
  std::vector<std::size_t> faces;
  for (std::size_t f = 0; f < rooms.size(); ++f)
    if (rooms[f] > best - 1e-9L) faces.push_back(f);
  return faces;
}

/// Faces of q at its deepest vertices (to 1e-9 m) under direction n.
template <int Dim>
std::vector<std::size_t> facing_faces(const LongShape<Dim>& q, const LongVec<Dim>& n) {
  long double deepest = std::numeric_limits<long double>::infinity();
  for (const auto& vertex : q.vertices) deepest = std::min(deepest, n.dot(vertex));
  std::vector<std::size_t> faces;
  for (std::size_t f = 0; f < q.faces.size(); ++f)
    if (std::any_of(q.faces[f].begin(), q.faces[f].end(),
                    [&](int vertex) { return n.dot(q.at(vertex)) < deepest + 1e-9L; }))
      faces.push_back(f);
  return faces;
}

/// The pair seen in a mirror at x = 0.
template <int Dim>
PlainPair<Dim> mirror_image(PlainPair<Dim> pair) {
  Rotation<Dim> mirror = Rotation<Dim>::Identity();
  mirror(0, 0) = -1;
  for (PlainShape<Dim>* shape : {&pair.a, &pair.b}) {
    for (auto& vertex : shape->vertices) vertex[0] = -vertex[0];
    if constexpr (Dim == 2)
      std::reverse(shape->vertices.begin(), shape->vertices.end());
    else
      for (auto& face : shape->faces) std::reverse(face.begin(), face.end());
  }
  for (Pose<Dim>* pose : {&pair.pose_a, &pair.pose_b})
    *pose = {mirror * pose->position, mirror * pose->rotation * mirror};
  return pair;
}

/// Two answers about one pair, `normal` that of the second in the frame of the first. Where two
/// directions are equally good either may be taken; each must then be as good as the other.
template <int Dim>
void check_same(const Twin<Dim>& twin, const Answer<Dim>& one, const Answer<Dim>& other,
                const Vec<Dim>& normal) {
  constexpr double tolerance = Dimensions<Dim>::tolerance;
  // Apart, nearly parallel edges may count or not: only that they are apart is certain.
  if (one.separation <= 0 || other.separation <= 0)
    CHECK(std::abs(one.separation - other.separation) < 2 * tolerance);
  if (std::abs(one.separation) < 4 * tolerance) return;  // a rounding may decide whether they touch
  CHECK((one.touch == Touch::none) == (other.touch == Touch::none));
  if (one.touch == Touch::none) return;
  CHECK(std::abs(static_cast<double>(
                     room_along<Dim>(twin.a, twin.b, normal.template cast<long double>())) -
                 one.separation) < 4 * tolerance);
  const bool one_of_edges = one.touch == Touch::edge_edge;
  if (one_of_edges != (other.touch == Touch::edge_edge)) return;
  if (!one_of_edges && (one.normal - normal).norm() < 1e-9)
    CHECK(std::abs(one.measure - other.measure) < 1e-9);
}

}  // namespace

TEST_SUITE("detection/face_contacts") {
  TEST_CASE_TEMPLATE("depth, decision and normal are those of all axes in long double", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    int overlaps = 0;
    for_pairs<dim>(1, D::pairs, [&](const auto&, const Twin<dim>& twin, const auto& exact) {
      const Answer<dim> found = twin.cold();
      const double value = static_cast<double>(exact.value);
      if (std::abs(value) > D::tolerance) CHECK(found.overlap == (value < 0));
      CHECK((found.touch != Touch::none) == (found.separation <= 0));
      if (value > 0) {
        // Apart: not less than the axes that are beyond doubt, not more than the distance.
        const auto sure = separating_axes(twin.a, twin.b, 1e-6L);
        CHECK(found.separation > static_cast<double>(sure.value) - D::tolerance);
        CHECK(found.separation <
              static_cast<double>(distance_apart(twin.a, twin.b)) + D::tolerance);
      } else {
        ++overlaps;
        CHECK(std::abs(found.separation - value) < D::tolerance);
      }
      if (found.touch == Touch::none) return;
      CHECK(found.depth == found.separation);
      CHECK(std::abs(found.normal.norm() - 1) < 1e-15);
      // Moving b by the depth along the normal leaves no overlap.
      const LongVec<dim> normal = found.normal.template cast<long double>();
      CHECK(std::abs(static_cast<double>(room_along<dim>(twin.a, twin.b, normal)) -
                     found.separation) < 4 * D::tolerance);
    });
    CHECK(overlaps > D::pairs / 3);
  }

  TEST_CASE("lenses, with many axes nearly as good as the best") {
    Random random(10);
    int faces = 0, edges = 0;
    for (int k = 0; k < 20000; ++k) {
      const Twin<3> twin(lens_pair(random));
      CAPTURE(k);
      const double value = static_cast<double>(separating_axes(twin.a, twin.b).value);
      const Answer<3> found = twin.cold();
      if (std::abs(value) > Dimensions<3>::tolerance) CHECK(found.overlap == (value < 0));
      if (value > 0) continue;
      CHECK(std::abs(found.separation - value) < Dimensions<3>::tolerance);
      const LongVec<3> normal = found.normal.cast<long double>();
      const bool of_face =
          std::any_of(twin.a.normals.begin(), twin.a.normals.end(),
                      [&](const auto& n) { return (n - normal).norm() < 1e-9L; }) ||
          std::any_of(twin.b.normals.begin(), twin.b.normals.end(),
                      [&](const auto& n) { return (n + normal).norm() < 1e-9L; });
      ++(of_face ? faces : edges);
    }
    CHECK(faces > 1000);
    CHECK(edges > 1000);
  }

  TEST_CASE_TEMPLATE("how far one looks decides whether there is a contact, not how deep it is", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(9);
    int gaps = 0, edges = 0;
    for_pairs<dim>(9, D::pairs, [&](const auto&, const Twin<dim>& twin, const auto&) {
      const double reach = random_power(random, -6, 0);
      const Answer<dim> found = twin.cold(reach);
      if (std::abs(found.separation - reach) < D::tolerance) return;  // a rounding decides
      CHECK((found.touch != Touch::none) == (found.separation < reach));
      if (found.touch == Touch::none) return;
      CHECK(std::abs(found.depth - found.separation) < D::tolerance);
      gaps += found.separation > 0;
      edges += found.separation > 0 && found.touch == Touch::edge_edge;
    });
    CHECK(gaps > D::pairs / 10);
    if (dim == 3) CHECK(edges > D::pairs / 100);
  }

  TEST_CASE_TEMPLATE("what is remembered of a pair never changes an answer, to the last bit", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    using Pair = FaceContacts::Pair<dim>;
    Random random(2);
    for_pairs<dim>(2, D::pairs / 2, [&](const auto& pair, Twin<dim> twin, const auto&) {
      const double reach = random.below(2) == 0 ? 0 : random_power(random, -9, -2);
      const Answer<dim> cold = twin.cold(reach);
      // Somewhere near, or where the other side of the block is nearest.
      PlainPair<dim> before = pair;
      const double step = random.below(4) == 0 ? 2.0 : random_power(random, -9, -2);
      before.pose_b.position += step * random_vector<dim>(random);
      twin.place(before);
      Pair detector(twin.shapes());
      typename Pair::Memory after_overlap, after_separation, after_contact;
      (void)detector.overlap(0, 1, after_overlap);
      (void)detector.separation(0, 1, after_separation);
      (void)detector.contact(0, 1, after_contact, reach);
      twin.place(pair);
      for (const auto& memory : {after_overlap, after_separation, after_contact})
        CHECK(ask<Pair, dim>(detector, 0, 1, memory, reach) == cold);
    });
  }

  TEST_CASE("a point that is remembered of an overlap lies in both polyhedra") {
    int remembered = 0, overlaps = 0;
    for_pairs<3>(11, Dimensions<3>::pairs, [&](const auto&, const Twin<3>& twin, const auto&) {
      FaceContacts::Pair<3> detector(twin.shapes());
      FaceContacts::Pair<3>::Memory memory;
      if (!detector.overlap(0, 1, memory)) return;
      ++overlaps;
      if (memory.inside == std::array<float, 3>{}) return;
      ++remembered;
      const Vec3 point =
          twin.shapes()[0].vertex(0) + Vec3(memory.inside[0], memory.inside[1], memory.inside[2]);
      for (const LongShape<3>* shape : {&twin.a, &twin.b})
        for (const LongVec<3>& normal : shape->normals) {
          long double reach = -std::numeric_limits<long double>::infinity();
          for (const LongVec<3>& vertex : shape->vertices)
            reach = std::max(reach, normal.dot(vertex));
          CHECK(normal.dot(point.cast<long double>()) < reach);
        }
      // Moved away by more than b is long, the point proves nothing.
      PlacedShapes<3> moved = twin.shapes();
      Pose<3> away;
      away.position.setConstant(1e3);
      moved.place(1, away);
      CHECK_FALSE(FaceContacts::Pair<3>(moved).overlap(0, 1, memory));
    });
    CHECK(overlaps > Dimensions<3>::pairs / 3);
    CHECK(remembered > overlaps / 2);
  }

  TEST_CASE("a remembered point proves nothing where a face is as uneven as the point is deep") {
    // The plane passes the corner (1, 1) of the cube at 0.4 mm, which is taken for 0: the corner
    // is a vertex of the cut face and 0.4 mm below its plane.
    const Vec3 normal = Vec3(1, -0.5005, 0).normalized();
    const auto parts =
        box({0, 0, 0}, {1, 1, 1}).split({normal, normal.dot(Vec3(0.5, 0, 0))}, 6, 1e-3);
    REQUIRE(parts.has_value());
    const ConvexPolyhedron& wedge = parts->first;
    // A cube that looks at the edge from (0.5, 0) to (1, 1) across a gap of 0.1 mm, near its end.
    const Vec3 out = Vec3(1, -0.5, 0).normalized(), along(-out.y(), out.x(), 0);
    const Vec3 near(0.99, 0.98, 0.5);
    const ConvexPolyhedron cube = box({0, 0, 0}, {0.01, 0.01, 0.01});
    PlacedShapes<3> shapes;
    shapes.add(wedge, Vec3::Zero());
    shapes.add(cube, Vec3::Zero());
    Pose<3> pose;
    pose.rotation << out, along, Vec3::UnitZ();
    pose.position = near + 1e-4 * out - 0.005 * along;
    shapes.place(1, pose);
    const Vec3 point = near + 2e-4 * out + Vec3(0, 0, 0.005);
    FaceContacts::Pair<3> detector(shapes);
    FaceContacts::Pair<3>::Memory memory;
    // Roundings of 1e-16 m of coordinates of 1 m, with room.
    CHECK(std::abs(detector.separation(0, 1, memory) - 1e-4) < 1e-14);
    for (std::size_t k = 0; k < wedge.size(); ++k) REQUIRE(wedge.distance(k, point) < -1e-4);
    memory.apart = false;
    const Vec3 arm = point - shapes[0].vertex(0);
    for (std::size_t k = 0; k < 3; ++k)
      memory.inside[k] = static_cast<float>(arm[static_cast<int>(k)]);
    CHECK_FALSE(detector.overlap(0, 1, memory));
  }

  TEST_CASE_TEMPLATE("vector lanes and plain numbers give the same bits", D, Dimensions<2>,
                     Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(3);
    for_pairs<dim>(3, D::pairs / 2, [&](const auto& pair, const Twin<dim>& twin, const auto&) {
      const double reach = random.below(2) == 0 ? 0 : random_power(random, -9, -2);
      CHECK(Twin<dim, detail::PlainLanes>(pair).cold(reach) == twin.cold(reach));
    });
  }

  TEST_CASE_TEMPLATE("the other shapes, and which came before, do not matter", D, Dimensions<2>,
                     Dimensions<3>) {
    constexpr int dim = D::dim;
    using Pair = FaceContacts::Pair<dim>;
    Random random(4);
    // One detector object for all, so that what it keeps in memory is of other pairs.
    PlacedShapes<dim> all;
    std::vector<PlainPair<dim>> pairs;
    for (int k = 0; k < D::pairs / 6; ++k) {
      pairs.push_back(random_pair<dim>(random));
      for (const auto* shape : {&pairs.back().b, &pairs.back().a})
        all.add(convex(*shape), Vec<dim>::Zero());
      all.place(all.size() - 2, pairs.back().pose_b);
      all.place(all.size() - 1, pairs.back().pose_a);
    }
    Pair detector(all);
    for (std::size_t k = pairs.size(); k-- > 0;)
      CHECK(ask<Pair, dim>(detector, 2 * k + 1, 2 * k, {}, 1e-3) == Twin<dim>(pairs[k]).cold(1e-3));
  }

  TEST_CASE_TEMPLATE("b against a is a against b turned round", D, Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    for_pairs<dim>(5, D::pairs / 2, [&](const auto&, const Twin<dim>& twin, const auto&) {
      const Answer<dim> found = twin.cold(), swapped = twin.swapped();
      check_same<dim>(twin, found, swapped, Vec<dim>(-swapped.normal));
    });
  }

  TEST_CASE_TEMPLATE("mirrored and turned input gives mirrored and turned output", D, Dimensions<2>,
                     Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(6);
    for_pairs<dim>(6, D::pairs / 2, [&](const auto& pair, const Twin<dim>& twin, const auto&) {
      const Answer<dim> found = twin.cold();
      Rotation<dim> mirror = Rotation<dim>::Identity();
      mirror(0, 0) = -1;
      const Answer<dim> mirrored = Twin<dim>(mirror_image(pair)).cold();
      check_same<dim>(twin, found, mirrored, Vec<dim>(mirror * mirrored.normal));

      const Pose<dim> motion{10 * random_vector<dim>(random), random_rotation<dim>(random)};
      PlainPair<dim> moved = pair;
      for (Pose<dim>* pose : {&moved.pose_a, &moved.pose_b})
        *pose = {motion(pose->position), motion.rotation * pose->rotation};
      const Answer<dim> turned = Twin<dim>(moved).cold();
      check_same<dim>(twin, found, turned, Vec<dim>(motion.rotation.transpose() * turned.normal));
    });
  }

  TEST_CASE_TEMPLATE("the polygon is the part of one face before the other, and has its measure", D,
                     Dimensions<2>, Dimensions<3>) {
    constexpr int dim = D::dim;
    Random random(7);
    int faces = 0, edges = 0, gaps = 0;
    for_pairs<dim>(7, D::pairs, [&](const auto&, const Twin<dim>& twin, const auto&) {
      const double reach = random.below(2) == 0 ? 0 : random_power(random, -9, -1);
      const Answer<dim> found = twin.cold(reach);
      if (found.touch == Touch::none) return;
      gaps += found.separation > 0;
      REQUIRE(!found.polygon.empty());
      std::vector<LongVec<dim>> polygon;
      for (const auto& point : found.polygon) polygon.push_back(point.template cast<long double>());
      const LongVec<dim> normal = found.normal.template cast<long double>();
      if (found.touch == Touch::edge_edge) {
        if constexpr (dim == 3) {
          ++edges;
          const LongVec<3> area = area_vector_of(polygon);
          CHECK(std::abs(static_cast<double>(area.dot(normal)) - found.measure) < 1e-11);
          CHECK(std::abs(section_area(twin.a, twin.b, polygon[0], normal) - found.measure) < 1e-9);
          // A section lies in both. Without one there is a point midway between the edges, which a
          // thin block may not reach; apart, edges that do not pass each other are further away.
          const double depth = polygon.size() > 2 ? 0 : std::abs(found.separation);
          if (found.separation < 0)
            for (const auto& point : polygon)
              for (const LongShape<3>* shape : {&twin.a, &twin.b})
                CHECK(static_cast<double>(outside(*shape, point)) < 0.5 * depth + 1e-11);
        }
        return;
      }
      ++faces;
      const bool of_a = found.touch == Touch::face_a;
      const LongShape<dim>&p = of_a ? twin.a : twin.b, &q = of_a ? twin.b : twin.a;
      // On the surface of q and within reach of p's face.
      const auto references = best_faces(p, q);
      for (const auto& point : polygon) {
        CHECK(std::abs(static_cast<double>(outside(q, point))) < 1e-11);
        double height = std::numeric_limits<double>::infinity();
        for (const std::size_t f : references)
          height =
              std::min(height, static_cast<double>(p.normals[f].dot(point - p.at(p.faces[f][0]))));
        CHECK(height < reach + 1e-9);
      }
      // Where the face lies within a rounding of the reach, a rounding decides how much is below.
      const bool at_the_brink = std::abs(found.separation - reach) < 1e-10;
      double off = std::numeric_limits<double>::infinity(), most = 0;
      for (const std::size_t f : references)
        for (const std::size_t g : facing_faces<dim>(q, p.normals[f])) {
          off = std::min(off, std::abs(measure_over(p, f, q, g, reach) - found.measure));
          most = std::max(most, measure_over(p, f, q, g, reach + 1e-10));
        }
      if (at_the_brink)
        CHECK(found.measure < most + 1e-9);
      else
        CHECK(off < 1e-9);
      // It runs as `Contact` says.
      if constexpr (dim == 2) {
        REQUIRE(polygon.size() == 2);
        CHECK(static_cast<double>(cross(found.polygon[1] - found.polygon[0], found.normal)) <=
              1e-12);
      } else if (polygon.size() > 2) {
        const LongVec<3> area = area_vector_of(polygon);
        CHECK(static_cast<double>(area.dot(normal)) > -1e-12);
      }
    });
    CHECK(faces > D::pairs / 4);
    CHECK(gaps > D::pairs / 50);
    if (dim == 3) CHECK(edges > D::pairs / 100);
  }
}

TEST_SUITE("detection/face_contacts: known contacts") {
  TEST_CASE("boxes on a grid touch at exactly 0 and overlap by exactly what they do") {
    Random random(8);
    int touching = 0;
    for (int k = 0; k < 500; ++k) {
      const Twin<2> flat(grid_pair<2>(random));
      const Twin<3> space(grid_pair<3>(random));
      CHECK(flat.cold().separation == static_cast<double>(separating_axes(flat.a, flat.b).value));
      CHECK(space.cold().separation ==
            static_cast<double>(separating_axes(space.a, space.b).value));
      touching += space.cold().separation == 0;
    }
    CHECK(touching > 20);
  }

  TEST_CASE("corner on edge in 2-D: the part of the corner's side that has entered") {
    // A square on its corner, 0.01 m deep in the middle of a side: 0.01 m of its side, seen along
    // the normal.
    PlainPair<2> pair{plain(rectangle(4, 2)), plain(rectangle(1, 1)), {}, {}};
    pair.pose_b = {Vec2(0.3, 1 + std::sqrt(0.5) - 0.01),
                   rotation_by(Spin<2>(std::numbers::pi / 4))};
    const Answer<2> found = Twin<2>(pair).cold();
    CHECK(found.touch == Touch::face_a);
    CHECK(std::abs(found.separation + 0.01) < 1e-15);
    CHECK(std::abs(found.measure - 0.01) < 1e-15);
    CHECK((found.normal - Vec2(0, 1)).norm() < 1e-15);
  }

  TEST_CASE("cubes: corner, edge and face on a face, edge across edge") {
    const PlainShape<3> cube = prism(rectangle(1, 1), Vec3(0, 0, 1));
    const PlainShape<3> table = prism(rectangle(4, 4), Vec3(0, 0, 2));
    const double pi = std::numbers::pi, d = 1e-3;
    PlainPair<3> pair{table, cube, {}, {}};
    const auto lower = [&pair](const Vec3& position, const Spin<3>& spin) {
      pair.pose_b = {position, rotation_by(spin)};
    };
    SUBCASE("corner: a third of the triangle that the corner cuts out of the table's top") {
      const double tilt = std::acos(1 / std::sqrt(3.0));
      lower({0.1, 0.2, 1 + std::sqrt(0.75) - d}, Spin<3>(tilt * Vec3(1, -1, 0).normalized()));
      const Answer<3> found = Twin<3>(pair).cold();
      CHECK(found.touch == Touch::face_a);
      CHECK(std::abs(found.separation + d) < 1e-15);
      CHECK(std::abs(found.measure - std::sqrt(0.75) * d * d) < 1e-15);
    }
    SUBCASE("edge: one of its two faces, as far as it has entered") {
      lower({0.1, 0.2, 1 + std::sqrt(0.5) - d}, Spin<3>(pi / 4, 0, 0));
      const Answer<3> found = Twin<3>(pair).cold();
      CHECK(found.touch == Touch::face_a);
      CHECK(std::abs(found.separation + d) < 1e-15);
      CHECK(std::abs(found.measure - d) < 1e-14);
    }
    SUBCASE("face turned by 45 degrees: the whole face; of its equal, an octagon") {
      lower({0.1, 0.2, 1.5 - d}, Spin<3>(0, 0, pi / 4));
      Answer<3> found = Twin<3>(pair).cold();
      CHECK((found.touch == Touch::face_a || found.touch == Touch::face_b));
      CHECK((found.normal - Vec3(0, 0, 1)).norm() < 1e-15);
      CHECK(std::abs(found.measure - 1) < 1e-14);
      pair.a = cube;
      lower({0, 0, 1 - d}, Spin<3>(0, 0, pi / 4));
      found = Twin<3>(pair).cold();
      CHECK(found.polygon.size() == 8);
      CHECK(std::abs(found.measure - 2 * (std::sqrt(2.0) - 1)) < 1e-14);
    }
    SUBCASE("ridge across ridge: a square as wide as the overlap is deep") {
      pair.a = cube;
      pair.pose_a.rotation = rotation_by(Spin<3>(pi / 4, 0, 0));
      lower({0, 0, std::sqrt(2.0) - d}, Spin<3>(0, pi / 4, 0));
      const Answer<3> found = Twin<3>(pair).cold();
      CHECK(found.touch == Touch::edge_edge);
      CHECK(std::abs(found.separation + d) < 1e-15);
      CHECK((found.normal - Vec3(0, 0, 1)).norm() < 1e-14);
      CHECK(std::abs(found.measure - d * d) < 1e-15);
    }
    SUBCASE("ridges that are nearly parallel still cross") {
      // Crossing at an angle t and overlapping by t / 10 they are t / 10 deep, while along the best
      // face they are 0.42 t deep. Far from the origin, where t is known to 1e-14.
      const Vec3 far(40, -50, 60);
      pair.a = cube;
      for (double t = 0.1; t > 1e-10; t /= 7) {
        const Rotation<3> ridge = rotation_by(Spin<3>(pi / 4, 0, 0));
        pair.pose_a = {far, ridge};
        pair.pose_b = {far + Vec3(0, 0, std::sqrt(2.0) - t / 10),
                       rotation_by(Spin<3>(0, 0, t)) * ridge};
        const Answer<3> found = Twin<3>(pair).cold();
        CHECK(std::abs(found.separation + t / 10) < 1e-12);
        CHECK(found.touch == Touch::edge_edge);
      }
    }
    SUBCASE("apart, but within reach") {
      lower({1.75, 0.2, 1.5 + d}, Spin<3>(0, 0, 0));
      CHECK(Twin<3>(pair).cold(0.9 * d).touch == Touch::none);
      const Answer<3> found = Twin<3>(pair).cold(1.1 * d);
      CHECK(found.touch == Touch::face_a);
      CHECK(std::abs(found.separation - d) < 1e-15);
      CHECK(std::abs(found.measure - 0.75) < 1e-14);
    }
  }

  TEST_CASE("edges of both blocks that are nearly parallel, elsewhere, do not place a contact") {
    // A cube with a corner cut off; where the cut meets its lower side an upright edge of another
    // cube crosses. Both have more upright edges: turned by 1e-11 they have a product, which may be
    // the same normal.
    Random random(31);
    const ConvexPolyhedron cube = as_block(Domain<3>{Vec3(-1, -1, -1), Vec3(1, 1, 1)});
    int edges = 0;
    for (int k = 0; k < 4000; ++k) {
      CAPTURE(k);
      const double sum = random.uniform() - 0.5, at = random.uniform(), height = random.uniform(),
                   entered = 0.05 * random.uniform(),
                   angle = std::pow(10, -8 - 6 * random.uniform());
      const auto parts =
          cube.split(HalfSpace<3>::through(Vec3(sum, 0, 0), Vec3(1, 1, 1).normalized()), 6, 1e-12);
      REQUIRE(parts);
      // The cut's lower edge runs from (1, sum) to (sum, 1), at z = -1.
      const Vec3 crossing(sum + at * (1 - sum) - entered, 1 - at * (1 - sum) - entered, -1);
      Vec3 spin;
      for (int axis = 0; axis < 3; ++axis)
        spin[axis] = angle * (std::floor(3 * random.uniform()) - 1);
      const Pose<3> upright{Vec3(crossing + Vec3(1, 1, 1.9 * height - 0.95)),
                            Rotation<3>::Identity()},
          turned{upright.position, rotation_by(Spin<3>(spin))};
      PlacedShapes<3> shapes;
      shapes.add(parts->first, zeros<Vec3>());
      shapes.add(cube, zeros<Vec3>());
      FaceContacts::Pair<3> pair(shapes);
      const auto ask_at = [&](const Pose<3>& there) {
        shapes.place(0, {});
        shapes.place(1, there);
        return ask<FaceContacts::Pair<3>, 3>(pair, 0, 1, {});
      };
      const Answer<3> exact = ask_at(upright), found = ask_at(turned);
      if (exact.touch != Touch::edge_edge) continue;
      ++edges;
      REQUIRE(found.touch == Touch::edge_edge);
      // Turned by up to 1.7e-8 rad, at 2 m, the sides of the section, shorter than 1 m, move by
      // 4e-8 m.
      CHECK(std::abs(found.measure - exact.measure) < 1e-7);
      const LongShape<3> a = reference_of<3>(parts->first, {}), b = reference_of<3>(cube, turned);
      for (const Vec3& point : found.polygon) {
        const LongVec<3> x = point.cast<long double>();
        CHECK(static_cast<double>(std::max(outside(a, x), outside(b, x))) < 1e-12);
      }
    }
    CHECK(edges > 1000);
  }

  TEST_CASE("a contact is in the plane of its face, however short the sides of that") {
    Random random(32);
    int faces = 0;
    for (int k = 0; k < 4000; ++k) {
      CAPTURE(k);
      // A corner is cut off, all but a nanometre: the face of the cut may start with a side so
      // long.
      Vec3 corner, normal;
      for (int axis = 0; axis < 3; ++axis) {
        corner[axis] = random.uniform() < 0.5 ? -1 : 1;
        normal[axis] = (2 * random.uniform() - 1);
      }
      normal.normalize();
      const ConvexPolyhedron cube = as_block(Domain<3>{Vec3(-1, -1, -1), Vec3(1, 1, 1)});
      const auto parts = cube.split(
          HalfSpace<3>::through(Vec3(corner + 1e-9 * (2 * random.uniform() - 1) * normal), normal),
          6, 1e-12);
      if (!parts) continue;
      PlacedShapes<3> shapes;
      shapes.add(parts->first, zeros<Vec3>());
      shapes.add(cube, zeros<Vec3>());
      const Vec3 lift = 0.98 * normal * normal.cwiseAbs().sum();
      const Pose<3> there{Vec3(corner.dot(normal) * normal + lift), Rotation<3>::Identity()};
      shapes.place(0, {});
      shapes.place(1, there);
      FaceContacts::Pair<3> pair(shapes);
      const Answer<3> found = ask<FaceContacts::Pair<3>, 3>(pair, 0, 1, {});
      if (found.touch != Touch::face_a && found.touch != Touch::face_b) continue;
      ++faces;
      const LongShape<3> a = reference_of<3>(parts->first, {}), b = reference_of<3>(cube, there);
      // Points lie in the face that is clipped, the other block's.
      const LongShape<3>& own = found.touch == Touch::face_a ? b : a;
      for (const Vec3& point : found.polygon)
        CHECK(static_cast<double>(outside(own, LongVec<3>(point.cast<long double>()))) < 1e-13);
    }
    CHECK(faces > 1000);
  }

  TEST_CASE("deep crossing edges touch over an area, midway in the overlap") {
    // Boxes, wedges, hulls and skewed boxes of about 1 m that are pushed into one another by up to
    // half a metre: edges may then be out on the far side of the other block.
    Random random(33);
    const std::array<int, 4> kinds{0, 1, 2, 7};
    int edges = 0, beyond = 0;
    for (int k = 0; k < 12000; ++k) {
      CAPTURE(k);
      PlainPair<3> pair{shape_of_kind<3>(random, kinds[random.below(4)]),
                        shape_of_kind<3>(random, kinds[random.below(4)]),
                        {},
                        {}};
      pair.pose_a.rotation = random_rotation<3>(random);
      pair.pose_b = {0.5 * random_vector<3>(random), random_rotation<3>(random)};
      const Twin<3> twin(pair);
      const Answer<3> found = twin.cold();
      if (found.touch == Touch::none || found.separation > -1e-6) continue;
      CHECK(found.measure > 0);
      REQUIRE(found.polygon.size() >= 3);
      if (found.touch != Touch::edge_edge) continue;
      ++edges;
      const LongVec<3> normal = found.normal.cast<long double>();
      long double low = std::numeric_limits<long double>::infinity(), high = -low;
      for (const auto& [own, other] : {std::pair{&twin.a, &twin.b}, {&twin.b, &twin.a}})
        for (const auto& face : own->faces) {
          auto part = own->corners(face);
          for (std::size_t f = 0; f < other->faces.size() && !part.empty(); ++f)
            part = clipped<3>(part, [&, other = other](const LongVec<3>& x) {
              return other->normals[f].dot(x - other->at(other->faces[f][0]));
            });
          for (const LongVec<3>& x : part) {
            low = std::min(low, normal.dot(x));
            high = std::max(high, normal.dot(x));
          }
        }
      beyond += static_cast<double>(high - low) < -found.separation - 1e-9;
      const LongVec<3> point = found.polygon[0].cast<long double>();
      // Roundings of coordinates of some metres, over the sine of the angle between edge and face.
      CHECK(std::abs(static_cast<double>(normal.dot(point) - (low + high) / 2)) < 1e-12);
      CHECK(std::abs(section_area(twin.a, twin.b, point, normal) - found.measure) < 1e-11);
    }
    CHECK(edges > 1000);
    CHECK(beyond > 30);
  }
}

}  // namespace face_contacts_test
