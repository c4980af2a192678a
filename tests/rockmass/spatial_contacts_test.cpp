// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>

#include "support/jointed_mass.hpp"
#include "support/solids.hpp"

namespace spatial_contacts_test {

using namespace voussoir;
using voussoir_test::jointed_mass;
using voussoir_test::moved;
using voussoir_test::random_direction;
using voussoir_test::random_point;

namespace {

constexpr double degree = std::numbers::pi / 180;
const Domain<3> cube{{-5, -5, -5}, {5, 5, 5}};

std::size_t index(int i) { return static_cast<std::size_t>(i); }

SpatialJoint plane_through(const Vec3& point, const Vec3& normal) {
  return {unbounded_joint(point, normal), 0};
}
SpatialJoint upright(int axis, double at) {
  return plane_through(at * Vec3::Unit(axis), Vec3::Unit(axis));
}

struct Case {
  BlockLimits limits;
  JointShape shape;
};

/// The worst of all bodies: area vectors around it that do not add up to zero, and the area of its
/// surface that contacts and boundary do not cover (or cover twice).
struct Gaps {
  double open = 0, uncovered = 0;
};

Gaps gaps(const RockMass<Spatial>& mass, const std::vector<ContactFacet<Spatial>>& contacts) {
  const std::size_t n = mass.bodies.size();
  std::vector<Vec3> sum(n, Vec3::Zero());
  std::vector<double> covered(n, 0.0);
  for (const auto& c : contacts) {
    const Vec3 area = c.facet.area_vector();
    sum[index(c.a)] += area;
    sum[index(c.b)] -= area;
    covered[index(c.a)] += area.norm();
    covered[index(c.b)] += area.norm();
  }
  for (const auto& f : boundary_facets(mass)) {
    sum[index(f.body)] += f.facet.area_vector();
    covered[index(f.body)] += f.facet.measure();
  }
  Gaps worst;
  for (std::size_t b = 0; b < n; ++b) {
    worst.open = std::max(worst.open, sum[b].norm());
    worst.uncovered = std::max(worst.uncovered,
                               std::abs(covered[b] / mass.bodies[b].parts[0].surface_area() - 1));
  }
  return worst;
}

/// Contact area of every pair of bodies, the lower number first.
using PairAreas = std::map<std::pair<int, int>, double>;

PairAreas areas(const std::vector<ContactFacet<Spatial>>& contacts) {
  PairAreas result;
  for (const auto& c : contacts) result[std::minmax(c.a, c.b)] += c.facet.measure();
  return result;
}

/// The plain way: what every face of one block has in the plane of an opposite face of another,
/// clipped by all faces of the other block but that one.
PairAreas areas_of_all_pairs(const RockMass<Spatial>& mass) {
  PairAreas result;
  const double near = 1e-9;
  for (std::size_t i = 0; i < mass.bodies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const ConvexPolyhedron &p = mass.bodies[i].parts[0], &q = mass.bodies[j].parts[0];
      double sum = 0;
      for (std::size_t f = 0; f < p.size(); ++f)
        for (std::size_t g = 0; g < q.size(); ++g) {
          const HalfSpace<3>&a = p.half_space(f), &b = q.half_space(g);
          if ((a.normal + b.normal).norm() > near || std::abs(a.offset + b.offset) > near) continue;
          std::optional<JointPlane> common = JointPlane{a, p.face(f).vertices};
          for (std::size_t k = 0; common && k < q.size(); ++k)
            if (k != g) common = split(*common, q.half_space(k), near).below;
          if (common) sum += common->area();
        }
      if (sum > 10 * near) result[{static_cast<int>(j), static_cast<int>(i)}] = sum;
    }
  return result;
}

}  // namespace

TEST_SUITE("rockmass/spatial_contacts") {
  TEST_CASE("contacts and boundary cover and close every block") {
    for (const Case& c : {Case{{}, PersistentJoints{}}, Case{{0.1, 8}, DiscJoints{4}},
                          Case{{0, 6}, RectangularJoints{5, 3}}})
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        CAPTURE(seed);
        CAPTURE(c.limits.max_elongation);
        const auto mass = jointed_mass(cube, seed, 1.5, c.limits, c.shape);
        CHECK(mass.bodies.size() > 60);
        const Gaps worst = gaps(mass, CutContacts::find(mass));
        // Corners are shared or computed to a rounding at 5 m, 1e-15 m; areas are some square
        // metres: the surface of a block closes to a few 1e-15 m times its outline.
        CHECK(worst.open < 1e-13);
        CHECK(worst.uncovered < 1e-12);
      }
  }

  TEST_CASE("the contacts of each cut have the area of either side of it") {
    const auto mass = jointed_mass(cube, 3, 1.3, {0.1, 10}, DiscJoints{4});
    std::map<int, std::array<double, 2>> sides;  // of each cut: below and above
    for (const auto& body : mass.bodies)
      for (std::size_t k = 0; k < body.parts[0].size(); ++k) {
        const int label = body.parts[0].cut(k);
        const Cut& cut = mass.cuts[index(label)];
        if (cut.kind != Cut::Kind::joint) continue;
        const Vec3& up = mass.joints[index(cut.source)].trace.plane.normal;
        const bool is_below = body.parts[0].half_space(k).normal.dot(up) > 0;
        sides[label][is_below ? 0 : 1] += body.parts[0].face(k).measure();
      }
    double all = 0;
    for (const auto& [label, areas_of] : sides) {
      CHECK(std::abs(areas_of[0] - areas_of[1]) < 1e-13 * (1 + areas_of[0]));
      all += areas_of[0];
    }
    double contacts = 0;
    for (const auto& c : CutContacts::find(mass)) contacts += c.facet.measure();
    CHECK(sides.size() == mass.slicing.cuts);
    CHECK(std::abs(contacts / all - 1) < 1e-13);
  }

  TEST_CASE("all pairs of faces, clipped in turn, give the same pairs and areas") {
    for (const auto& [limits, shape] :
         {std::pair<BlockLimits, JointShape>{{}, PersistentJoints{}}, {{0.1, 8}, DiscJoints{5}}}) {
      const auto mass = jointed_mass({{-2, -2.5, -2}, {2, 2, 2.5}}, 4, 1.1, limits, shape);
      CHECK(mass.bodies.size() > 30);
      const PairAreas ours = areas(CutContacts::find(mass)), theirs = areas_of_all_pairs(mass);
      CHECK(ours.size() == theirs.size());
      double worst = 0;
      for (const auto& [pair, area] : theirs) {
        const auto found = ours.find(pair);
        REQUIRE(found != ours.end());
        worst = std::max(worst, std::abs(found->second - area));
      }
      CHECK(worst < 1e-12);
    }
  }

  TEST_CASE("the area vector points from body a to body b, and the facet is convex") {
    const auto mass = jointed_mass(cube, 5, 1.6, {0.1, 8}, DiscJoints{5});
    for (const auto& c : CutContacts::find(mass)) {
      CHECK(c.a != c.b);
      const Vec3 area = c.facet.area_vector(), normal = area.normalized();
      if (area.norm() < 1e-4) continue;
      const Vec3 middle = c.facet.centre();
      CHECK(mass.bodies[index(c.a)].parts[0].contains(middle - 1e-6 * normal));
      CHECK(mass.bodies[index(c.b)].parts[0].contains(middle + 1e-6 * normal));
      const auto& v = c.facet.vertices;
      for (std::size_t k = 0; k < v.size(); ++k) {
        const Vec3 in = v[(k + 1) % v.size()] - v[k];
        const Vec3 out = v[(k + 2) % v.size()] - v[(k + 1) % v.size()];
        CHECK(in.norm() > 0);
        CHECK(normal.dot(cross(in, out)) > -1e-14);
        CHECK(std::abs(normal.dot(v[k] - middle)) < 1e-13);
      }
    }
  }

  TEST_CASE("corners that are those of a block are so bit for bit") {
    const auto mass = jointed_mass(cube, 9, 1.6, {0.1, 8}, DiscJoints{5});
    const double tolerance = cube.tolerance();
    std::size_t shared = 0, of_edges = 0, different = 0;
    for (const auto& c : CutContacts::find(mass))
      for (const Vec3& corner : c.facet.vertices) {
        bool is_vertex = false;
        for (const int body : {c.a, c.b})
          for (const Vec3& v : mass.bodies[index(body)].parts[0].vertices()) {
            if ((v - corner).norm() > tolerance) continue;
            is_vertex = true;
            different += v == corner ? 0 : 1;
          }
        ++(is_vertex ? shared : of_edges);
      }
    CHECK(different == 0);
    CHECK(shared > 1000);
    CHECK(of_edges > 10);  // where edges of the two sides cross
  }

  TEST_CASE("bricks: twelve contacts of eight bricks, none across an edge or a corner") {
    const auto mass =
        slice<Spatial>({{0, 0, 0}, {2, 4, 6}}, {upright(0, 1), upright(1, 2), upright(2, 3)}, {});
    REQUIRE(mass.bodies.size() == 8);
    std::map<double, int> found;
    for (const auto& c : CutContacts::find(mass)) {
      ++found[c.facet.measure()];
      CHECK(c.facet.vertices.size() == 4);
    }
    CHECK(found == std::map<double, int>{{2, 4}, {3, 4}, {6, 4}});  // 1x2, 1x3, 2x3
  }

  TEST_CASE("boards laid crosswise: every crossing is a contact of its own") {
    // Below the bed boards run along y, above it along x; half spaces end the joints at the bed.
    const Domain<3> ground{{0, 0, 0}, {5, 4, 2}};
    std::vector<SpatialJoint> joints = {upright(2, 1)};
    for (int k = 1; k < 5; ++k)
      joints.push_back({joint_rectangle({1.0 * k, 2, 0.5}, {0, 3, 0}, {0, 0, 0.5}), 1});
    for (int k = 1; k < 4; ++k)
      joints.push_back({joint_rectangle({2.5, 1.0 * k, 1.5}, {3, 0, 0}, {0, 0, 0.5}), 2});
    const auto mass = slice<Spatial>(ground, joints, {});
    REQUIRE(mass.bodies.size() == 9);
    int on_bed = 0;
    for (const auto& c : CutContacts::find(mass)) {
      if (std::abs(c.facet.area_vector().normalized().z()) < 0.5) continue;
      ++on_bed;
      CHECK(std::abs(c.facet.measure() - 1) < 1e-14);
    }
    CHECK(on_bed == 20);
    CHECK(gaps(mass, CutContacts::find(mass)).uncovered < 1e-14);
  }

  TEST_CASE("joints through one line, through one point, and 0.1 degrees apart") {
    std::vector<SpatialJoint> line, cone, close;
    const Vec3 meet(0.3, -0.2, 0.7), axis = Vec3(1, 2, 3).normalized();
    const TangentBasis<3> across = tangent_basis(axis);
    for (int k = 0; k < 7; ++k) {
      const double angle = std::numbers::pi * (k + 0.2) / 7;
      line.push_back(plane_through(meet + (k - 3) * axis, std::cos(angle) * across.col(0) +
                                                              std::sin(angle) * across.col(1)));
      cone.push_back(
          plane_through(meet, Vec3(std::cos(2 * angle), std::sin(2 * angle), 0.6 + 0.02 * k)));
      for (const double dip : {50.0, 50.1})
        close.push_back(
            plane_through({k - 3.0, 0, 0}, upward_normal({dip * degree, 100 * degree})));
      line.push_back(plane_through((k - 3.3) * axis, axis));
      close.push_back(upright(2, k - 3.3));
    }
    for (auto* joints : {&line, &cone, &close})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        Random(seed).shuffle(*joints);
        const auto mass = slice<Spatial>(cube, *joints, {});
        CHECK(mass.bodies.size() > 40);
        const Gaps worst = gaps(mass, CutContacts::find(mass));
        CHECK(worst.open < 1e-12);  // where joints meet at 0.1 degrees, roundings grow 600 times
        CHECK(worst.uncovered < 1e-12);
      }
  }

  TEST_CASE("turned and mirrored rock has the same contacts, turned and mirrored") {
    const auto joints = joint_network(voussoir_test::three_sets(1.6, DiscJoints{5}), cube, 6);
    const BlockLimits limits{0.1, 10};
    const auto base = areas(CutContacts::find(slice<Spatial>(cube, joints, limits)));
    Eigen::Matrix3d mirror, third;
    mirror << 1, 0, 0, 0, -1, 0, 0, 0, 1;
    third << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    for (const Eigen::Matrix3d& turn : {mirror, third}) {
      std::vector<SpatialJoint> turned;
      for (const SpatialJoint& joint : joints) turned.push_back(moved(joint, turn, Vec3::Zero()));
      const auto found = areas(CutContacts::find(slice<Spatial>(cube, turned, limits)));
      REQUIRE(found.size() == base.size());
      for (const auto& [pair, area] : base) {
        REQUIRE(found.count(pair) == 1);
        CHECK(std::abs(found.at(pair) - area) < 1e-12);
      }
    }
  }

  TEST_CASE("at 10 000 m from the origin blocks close as well as the coordinates allow") {
    const Vec3 shift(1e4, -2e4, 3e3);
    std::vector<SpatialJoint> joints;
    for (const SpatialJoint& joint : joint_network(voussoir_test::three_sets(1.6), cube, 7))
      joints.push_back(moved(joint, Eigen::Matrix3d::Identity(), shift));
    const auto mass = slice<Spatial>({cube.low + shift, cube.high + shift}, joints, {});
    const Gaps worst = gaps(mass, CutContacts::find(mass));
    // Coordinates are rounded to 4e-12 m.
    CHECK(worst.open < 1e-10);
    CHECK(worst.uncovered < 1e-10);
  }

  TEST_CASE("six joints through one point, but for a few tolerances: no contact is lost") {
    Random random(11);
    for (const double shift : {0.0, 1e4, 1e6})
      for (const double near : {1.0, 3.0, 10.0})
        for (int k = 0; k < 40; ++k) {
          CAPTURE(shift);
          CAPTURE(near);
          CAPTURE(k);
          const Vec3 centre = Vec3::Constant(shift), half = Vec3::Constant(5);
          const Domain<3> ground{centre - half, centre + half};
          const double tolerance = ground.tolerance();
          const Vec3 point = random_point(random, centre - half / 5, centre + half / 5);
          std::vector<SpatialJoint> joints;
          for (int j = 0; j < 6; ++j) {
            const Vec3 normal = random_direction(random);
            const Vec3 off = near * tolerance * random_direction(random);
            joints.push_back(plane_through(point + off, normal));
          }
          const auto mass = slice<Spatial>(ground, joints, {});
          for (const auto& body : mass.bodies) CHECK(body.properties.centroid.allFinite());
          // Vertices lie up to a few tolerances off the planes, along outlines of some 30 m, and
          // what is narrower than a tolerance is no contact. A face lost is 1e9 tolerances.
          const auto contacts = CutContacts::find(mass);
          CHECK(gaps(mass, contacts).open < 100 * tolerance);
          // Nearer together, blocks that share an edge are told from those that touch by less.
          if (near < 10) continue;
          const PairAreas known = areas(contacts);
          PairAreas found = areas(FaceContacts::find(mass));
          for (const auto& [pair, area] : known)
            CHECK(std::abs(found[pair] - area) < 1000 * tolerance);
          for (const auto& [pair, area] : found)
            if (!known.contains(pair)) CHECK(area < 1000 * tolerance);
        }
  }

  TEST_CASE("boundary facets: every side of the domain in full, the area vector outwards") {
    const Domain<3> ground{{-2, -3, -4}, {4, 3, 1}};
    std::map<SpatialSide, double> found;
    for (const auto& f : boundary_facets(jointed_mass(ground, 8, 1.4))) {
      found[f.side] += f.facet.measure();
      const std::map<SpatialSide, Vec3> outward = {
          {SpatialSide::west, -Vec3::UnitX()},   {SpatialSide::east, Vec3::UnitX()},
          {SpatialSide::south, -Vec3::UnitY()},  {SpatialSide::north, Vec3::UnitY()},
          {SpatialSide::bottom, -Vec3::UnitZ()}, {SpatialSide::top, Vec3::UnitZ()}};
      CHECK((f.facet.area_vector().normalized() - outward.at(f.side)).norm() < 1e-9);
    }
    CHECK(std::abs(found[SpatialSide::west] - 30) < 1e-12);
    CHECK(std::abs(found[SpatialSide::east] - 30) < 1e-12);
    CHECK(std::abs(found[SpatialSide::south] - 30) < 1e-12);
    CHECK(std::abs(found[SpatialSide::north] - 30) < 1e-12);
    CHECK(std::abs(found[SpatialSide::bottom] - 36) < 1e-12);
    CHECK(std::abs(found[SpatialSide::top] - 36) < 1e-12);
  }
}

}  // namespace spatial_contacts_test
