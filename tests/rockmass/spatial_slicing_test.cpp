// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/rockmass/statistics.hpp>

#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"
#include "support/solids.hpp"

namespace spatial_slicing_test {

using namespace voussoir;
using voussoir_test::difference;
using voussoir_test::jointed_mass;
using voussoir_test::moved;
using voussoir_test::random_direction;
using voussoir_test::random_point;
using voussoir_test::sorted_volumes;
using voussoir_test::total_volume;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double degree = std::numbers::pi / 180;
const Domain<3> cube{{-5, -5, -5}, {5, 5, 5}};

SpatialJoint plane_through(const Vec3& point, const Vec3& normal, int set = 0) {
  return {unbounded_joint(point, normal), set};
}

/// A persistent joint x[axis] = at.
SpatialJoint upright(int axis, double at) {
  return plane_through(at * Vec3::Unit(axis), Vec3::Unit(axis), axis);
}

struct Case {
  BlockLimits limits;
  JointShape shape;
};

/// What must hold of every sliced mass.
void check_mass(const RockMass<Spatial>& mass, const BlockLimits& limits) {
  const double whole = mass.domain.measure(), size = mass.domain.diameter();
  // Hundreds of volumes, each known to 1e-15 of its own.
  CHECK(std::abs(total_volume(mass) / whole - 1) < 1e-12);
  CHECK(mass.bodies.size() == mass.slicing.cuts + 1);
  CHECK(mass.cuts.size() == mass.slicing.cuts + 6);
  CHECK(mass.slicing.joints == mass.joints.size());
  for (const auto& body : mass.bodies) {
    REQUIRE(body.parts.size() == 1);
    const ConvexPolyhedron& block = body.parts[0];
    CHECK(body.properties.measure > 0);
    double worst = 0, off_joint = 0;
    for (std::size_t k = 0; k < block.size(); ++k) {
      for (const Vec3& v : block.vertices()) worst = std::max(worst, block.distance(k, v));
      const Cut& cut = mass.cuts[static_cast<std::size_t>(block.cut(k))];
      for (const int v : block.loop(k)) {
        const Vec3& corner = block.vertex(static_cast<std::size_t>(v));
        if (cut.kind == Cut::Kind::joint) {
          const auto& plane = mass.joints[static_cast<std::size_t>(cut.source)].trace.plane;
          off_joint = std::max(off_joint, std::abs(plane.distance(corner)));
        } else {
          const Vec3 out = block.half_space(k).normal;
          const Vec3 limit = out.sum() > 0 ? mass.domain.high : mass.domain.low;
          CHECK(std::abs(std::abs(out.sum()) - 1) < 1e-14);
          off_joint = std::max(off_joint, std::abs(out.dot(corner - limit)));
        }
      }
    }
    // Convex, and on its joints, to a few roundings of coordinates - but where a vertex lay within
    // the tolerance of a joint and was taken to lie on it; such a chance is one in millions.
    CHECK(worst < 1e-14 * size);
    CHECK(off_joint < 1e-14 * size);
    if (limits.min_inscribed_radius > 0 || std::isfinite(limits.max_elongation)) {
      const double radius = inscribed_ball(block).radius;
      CHECK(radius >= limits.min_inscribed_radius - 1e-13);
      CHECK(block.diameter() <= 2 * radius * limits.max_elongation * (1 + 1e-12));
    }
  }
}

// ---- the plain loop that the tree must agree with ----------------------------------------------

/// Largest distance from the joint's plane that a block would have if the joint were the only
/// thing, and whether the joint's polygon has a part inside it: clipped by every face of the block.
bool reaches_into(const JointPlane& joint, const ConvexPolyhedron& block) {
  std::optional<JointPlane> inside = joint;
  for (std::size_t k = 0; inside && k < block.size(); ++k)
    inside = split(*inside, block.half_space(k), 1e-9).below;
  return inside && inside->area() > 1e-9;
}

std::vector<ConvexPolyhedron> plain_slicing(const Domain<3>& ground,
                                            const std::vector<SpatialJoint>& joints,
                                            const BlockLimits& limits) {
  std::vector<ConvexPolyhedron> blocks = {as_block(ground)};
  for (const SpatialJoint& joint : joints) {
    const JointPlane extent = covering(joint.trace, Vec3::Zero(), 100);
    const std::size_t before = blocks.size();
    for (std::size_t b = 0; b < before; ++b) {
      if (!reaches_into(extent, blocks[b])) continue;
      auto parts = blocks[b].split(joint.trace.plane, 0, 1e-9);
      if (!parts) continue;
      bool allowed = true;
      for (const ConvexPolyhedron* part : {&parts->first, &parts->second}) {
        const double radius = inscribed_ball(*part).radius;
        allowed = allowed && radius >= limits.min_inscribed_radius &&
                  part->diameter() <= 2 * radius * limits.max_elongation;
      }
      if (!allowed) continue;
      blocks[b] = parts->first;
      blocks.push_back(parts->second);
    }
  }
  return blocks;
}

}  // namespace

TEST_SUITE("rockmass/spatial_slicing") {
  TEST_CASE("blocks fill the domain, are convex, lie on their joints and obey the limits") {
    for (std::uint64_t seed = 1; seed <= 2; ++seed)
      for (const Case& c :
           {Case{{}, PersistentJoints{}}, Case{{0.2, 4}, PersistentJoints{}},
            Case{{0.15, inf}, DiscJoints{4}}, Case{{0, 6}, RectangularJoints{5, 3}}}) {
        CAPTURE(seed);
        CAPTURE(c.limits.min_inscribed_radius);
        const auto mass = jointed_mass(cube, seed, 1.8, c.limits, c.shape);
        CHECK(mass.bodies.size() > 30);
        check_mass(mass, c.limits);
      }
  }

  TEST_CASE("orthogonal sets cut bricks of the exact number and volume, in any order") {
    std::vector<SpatialJoint> joints;
    for (int k = 1; k < 5; ++k) joints.push_back(upright(0, k));
    for (int k = 1; k < 6; ++k) joints.push_back(upright(1, 0.5 * k));
    for (int k = 1; k < 4; ++k) joints.push_back(upright(2, 2 * k));
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      Random(seed).shuffle(joints);
      const auto mass = slice<Spatial>({{0, 0, 0}, {5, 3, 8}}, joints, {0.25, inf});
      REQUIRE(mass.bodies.size() == 5 * 6 * 4);
      for (const auto& body : mass.bodies) {
        CHECK(body.parts[0].size() == 6);
        CHECK(body.parts[0].vertices().size() == 8);
        CHECK(std::abs(body.properties.measure - 1) < 1e-14);  // 1 m x 0.5 m x 2 m
      }
      check_mass(mass, {0.25, inf});
    }
  }

  TEST_CASE("persistent joints cut the same blocks in whatever order") {
    auto joints = joint_network(voussoir_test::three_sets(1.5), cube, 3);
    const auto volumes = sorted_volumes(slice<Spatial>(cube, joints, {}));
    CHECK(volumes.size() > 200);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      Random(seed).shuffle(joints);
      CHECK(difference(sorted_volumes(slice<Spatial>(cube, joints, {})), volumes) < 1e-12);
    }
  }

  TEST_CASE("upright joints cut in 3-D what their traces cut in 2-D") {
    // The section's rock, 20 m thick: a trace from a to b is a rectangle on a - b and all of y.
    const Domain<2> section{{-5, -4}, {6, 5}};
    const Domain<3> ground{{-5, -10, -4}, {6, 10, 5}};
    for (const double extent : {1.0, 4.0, inf}) {
      CAPTURE(extent);
      const auto planar = voussoir_test::jointed_rock(section, 2, {0.25, inf}, extent);
      std::vector<SpatialJoint> joints;
      for (const Joint& joint : planar.joints) {
        const Segment& t = joint.trace;
        const auto lift = [](const Vec2& p) { return Vec3(p.x(), 0, p.y()); };
        joints.push_back(
            {joint_rectangle(lift(t.centre()), lift(0.5 * (t.end - t.start)), Vec3(0, 11, 0)),
             joint.set});
      }
      // No inscribed sphere is larger than 10 m, no circle of the section either.
      const auto mass = slice<Spatial>(ground, joints, {0.25, inf});
      std::vector<double> areas;
      for (const auto& body : planar.bodies) areas.push_back(body.properties.measure);
      std::sort(areas.begin(), areas.end());
      auto volumes = sorted_volumes(mass);
      for (double& volume : volumes) volume /= 20;
      CHECK(areas.size() > 100);
      CHECK(difference(volumes, areas) < 1e-12);
    }
  }

  TEST_CASE("a plain loop over all blocks and joints gives the same blocks") {
    const Domain<3> ground{{-2.5, -2, -2}, {2, 2.5, 3}};
    for (const Case& c : {Case{{0.1, 8}, DiscJoints{2}}, Case{{0.2, inf}, RectangularJoints{3, 1}},
                          Case{{0, 4}, PersistentJoints{}}, Case{{}, DiscJoints{1.5}}})
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        CAPTURE(seed);
        CAPTURE(c.limits.max_elongation);
        const auto mass = jointed_mass(ground, seed, 1.2, c.limits, c.shape);
        const auto plain = plain_slicing(ground, mass.joints, c.limits);
        REQUIRE(mass.bodies.size() == plain.size());
        CHECK(plain.size() > 15);
        std::vector<std::array<double, 4>> ours, theirs;
        const auto key = [](const MassProperties<3>& p) {
          return std::array{p.measure, p.centroid.x(), p.centroid.y(), p.centroid.z()};
        };
        for (const auto& body : mass.bodies) ours.push_back(key(body.properties));
        for (const auto& block : plain) theirs.push_back(key(mass_properties(block)));
        std::sort(ours.begin(), ours.end());
        std::sort(theirs.begin(), theirs.end());
        double worst = 0;
        for (std::size_t k = 0; k < ours.size(); ++k)
          for (std::size_t i = 0; i < 4; ++i)
            worst = std::max(worst, std::abs(ours[k][i] - theirs[k][i]));
        CHECK(worst < 1e-12);
      }
  }

  TEST_CASE("a disc cuts right through every block it reaches and leaves the others whole") {
    const std::vector<SpatialJoint> columns = {upright(0, -1), upright(0, 1)};
    const auto with = [&](const JointPlane& joint) {
      auto joints = columns;
      joints.push_back({joint, 7});
      return slice<Spatial>(cube, joints, {});
    };
    // A level disc of 1.5 m reach in the middle column of 2 m: two columns, three halved ones.
    const double reach = disc_reach();
    CHECK(with(joint_disc({0, 0, 0}, {0, 0, 1}, 1)).bodies.size() == 4);
    CHECK(with(joint_disc({0.2, 3, 0.5}, {0.2, 0.3, 1}, 1)).bodies.size() == 4);
    CHECK(with(joint_disc({0, 0, 0}, {0, 0, 1}, 3)).bodies.size() == 6);
    CHECK(with(joint_disc({-1, 0, 0}, {0, 0, 1}, 1)).bodies.size() == 5);
    CHECK(with(joint_disc({0, 0, 4.9}, {1, 0, 0}, 0.1)).bodies.size() == 4);
    // Rectangles that end on the column's side, and a hair behind it.
    const auto ending = [&](double beyond) {
      return with(joint_rectangle({0.5 * beyond, 0, 0}, {1 + 0.5 * beyond, 0, 0}, {0, 0.5, 0}));
    };
    CHECK(ending(0).bodies.size() == 4);
    CHECK(ending(1e-6).bodies.size() == 5);
    // The cut goes right through: its faces have the whole section, not the disc's size.
    const auto mass = with(joint_disc({0, 0, 0}, {0, 0, 1}, 0.5));
    CHECK(std::abs(joint_intensity(mass, 7) * 1000 - 2 * 10) < 1e-11);
    // A joint wholly outside the domain is not used.
    const auto outside = with(joint_disc({0, 0, 6}, {0.1, 0, 1}, 1.5 / reach));
    CHECK(outside.bodies.size() == 3);
    CHECK(outside.slicing.unused_joints == 1);
  }

  TEST_CASE("n planes in general position divide space into 1 + n + C(n,2) + C(n,3) parts") {
    Random random(5);
    for (int n = 1; n <= 12; ++n) {
      CAPTURE(n);
      // Every three of them meet near the middle of a large domain, so that no part is outside.
      std::vector<SpatialJoint> joints;
      std::vector<HalfSpace<3>> planes;
      while (static_cast<int>(planes.size()) < n) {
        const Vec3 normal = random_direction(random),
                   point = random_point(random, {-1, -1, -1}, {1, 1, 1});
        bool good = true;
        for (const auto& p : planes) good = good && cross(p.normal, normal).norm() > 0.2;
        for (std::size_t i = 0; i < planes.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
            good = good && std::abs(planes[i].normal.dot(cross(planes[j].normal, normal))) > 0.02;
        if (!good) continue;
        joints.push_back(plane_through(point, normal));
        planes.push_back(joints.back().trace.plane);
      }
      const Domain<3> ground{{-300, -300, -300}, {300, 300, 300}};
      const auto mass = slice<Spatial>(ground, joints, {});
      const int parts = 1 + n + n * (n - 1) / 2 + n * (n - 1) * (n - 2) / 6;
      CHECK(mass.bodies.size() == static_cast<std::size_t>(parts));
      check_mass(mass, {});
    }
  }

  TEST_CASE("n planes through one line make 2 n wedges, through one point n (n - 1) + 2 cones") {
    Random random(6);
    const Vec3 meet(0.25, -0.5, 1.0 / 3);
    for (const int n : {2, 3, 5, 8, 16}) {
      CAPTURE(n);
      const Vec3 axis = random_direction(random);
      const Vec3 u = cross(axis, random_direction(random)).normalized(), v = cross(axis, u);
      std::vector<SpatialJoint> through_line, through_point;
      for (int k = 0; k < n; ++k) {
        const double angle = std::numbers::pi * (k + 0.4) / n;
        // Given by another point of the line each: the offsets differ by roundings.
        through_line.push_back(
            plane_through(meet + (k - 3) * axis, std::cos(angle) * u + std::sin(angle) * v));
        const double cone = 2 * std::numbers::pi * (k + 0.1) / n;
        through_point.push_back(
            plane_through(meet, Vec3(std::cos(cone), std::sin(cone), 0.6 + 0.02 * k)));
      }
      const auto wedges = slice<Spatial>(cube, through_line, {});
      CHECK(wedges.bodies.size() == static_cast<std::size_t>(2 * n));
      check_mass(wedges, {});
      for (const auto& body : wedges.bodies) CHECK(body.properties.measure > 1e-3);
      const auto cones = slice<Spatial>(cube, through_point, {});
      CHECK(cones.bodies.size() == static_cast<std::size_t>(n * (n - 1) + 2));
      check_mass(cones, {});
      for (const auto& body : cones.bodies) CHECK(body.properties.measure > 1e-6);
    }
  }

  TEST_CASE("joints 0.1 degrees apart make slivers, and no volume is lost") {
    // Nine pairs of planes that cross inside the ground, and level ones across.
    std::vector<SpatialJoint> joints;
    for (int k = -4; k <= 4; ++k) {
      for (const double dip : {50.0, 50.1})
        joints.push_back(
            plane_through({1.0 * k, 0.1, 0}, upward_normal({dip * degree, 100 * degree}), 0));
      joints.push_back(upright(2, k + 0.3));
    }
    Random(1).shuffle(joints);
    const auto mass = slice<Spatial>(cube, joints, {});
    CHECK(mass.bodies.size() > 150);
    CHECK(std::abs(total_volume(mass) / 1000 - 1) < 1e-12);
    double thinnest = inf;
    for (const auto& body : mass.bodies)
      thinnest = std::min(thinnest, inscribed_ball(body.parts[0]).radius);
    CHECK(thinnest > 0);
    CHECK(thinnest < 0.001);  // tan(0.1 degrees) times half a metre, halved
    // With a limit the same joints leave no sliver.
    check_mass(slice<Spatial>(cube, joints, {0.1, inf}), {0.1, inf});
  }

  TEST_CASE("coincident joints cut once; joints along the sides or outside cut nothing") {
    const Vec3 normal(0.3, -0.4, 1), point(0.1, 0.2, 0.3);
    for (const SpatialJoint& other :
         {plane_through(point, normal), plane_through(point, -2 * normal),
          plane_through(point + Vec3(4, 3, 0), normal),
          plane_through(point, Vec3(0.3, -0.4, 1 + 1e-11)),
          SpatialJoint{joint_disc(point, normal, 2), 1}}) {
      const auto mass = slice<Spatial>(cube, {plane_through(point, normal), other}, {});
      CHECK(mass.bodies.size() == 2);
      CHECK(mass.slicing.unused_joints == 1);
      CHECK(std::abs(total_volume(mass) - 1000) < 1e-12 * 1000);
    }
    for (const SpatialJoint& joint :
         {upright(0, -5), upright(1, 5), upright(2, 5 + 1e-11), upright(2, 7),
          plane_through({5, 5, 5}, {1, 1, 1}), plane_through({5, 5, 0}, {1, 1, 0})}) {
      const auto mass = slice<Spatial>(cube, {joint}, {});
      CHECK(mass.bodies.size() == 1);
      CHECK(mass.slicing.unused_joints == 1);
    }
    CHECK(slice<Spatial>(cube, {upright(2, 5 - 1e-6)}, {}).bodies.size() == 2);
  }

  TEST_CASE("the limits decide at their very value") {
    const Domain<3> ground{{0, 0, 0}, {4, 1, 1}};
    const auto at = [&](double x, const BlockLimits& limits) {
      return slice<Spatial>(ground, {upright(0, x)}, limits).bodies.size();
    };
    // The left part is x long: inscribed radius x/2 for x <= 1.
    CHECK(at(0.5, {0.2500001, inf}) == 1);
    CHECK(at(0.5, {0.2499999, inf}) == 2);
    CHECK(at(3.5, {0.2500001, inf}) == 1);  // the other child counts as well
    // The left part is 0.2 x 1 x 1: diagonal sqrt(2.04) over diameter 0.2 is 7.1414; the ground has
    // sqrt(18).
    CHECK(at(0.2, {0, 7.141}) == 1);
    CHECK(at(0.2, {0, 7.142}) == 2);
  }

  TEST_CASE("without limits no block is smaller than the tolerance") {
    const double tolerance = cube.tolerance();
    for (const double size : {0.9, 1.1}) {  // inscribed radius of the tetrahedron, in tolerances
      // Three joints and one across their corner; a tetrahedron with legs s has r = s / (3 +
      // 3^0.5).
      const double leg = size * tolerance * (3 + std::sqrt(3.0));
      std::vector<SpatialJoint> joints{upright(0, 0), upright(1, 0), upright(2, 0)};
      joints.push_back(plane_through(leg * Vec3::UnitX(), Vec3(1, 1, 1)));
      const auto mass = slice<Spatial>(cube, joints, {});
      double smallest = inf;
      for (const auto& body : mass.bodies)
        smallest = std::min(smallest, inscribed_ball(body.parts[0]).radius);
      // Of the eight octants the last joint cuts seven: all but that of negative coordinates.
      CHECK(mass.bodies.size() == (size < 1 ? 14 : 15));
      CHECK(mass.slicing.refused_too_small == (size < 1 ? 1 : 0));
      CHECK(smallest > tolerance);
    }
  }

  TEST_CASE("a domain longer than the limit allows is cut like any other") {
    const auto set = [](const char* name, double dip, double direction) {
      return SpatialJointSet{.name = name,
                             .dip = dip * degree,
                             .dip_direction = direction * degree,
                             .dip_deviation = 5 * degree,
                             .count_per_volume = 0.5,
                             .shape = DiscJoints{2}};
    };
    const std::vector sets{set("A", 80, 90), set("B", 85, 0), set("C", 5, 90)};
    // Elongation 1.9 (within the limit), 18.9 and 9.5.
    std::vector<double> densities;
    for (const Vec3& size : {Vec3(12, 10, 10), Vec3(150, 8, 8), Vec3(20, 20, 3)}) {
      CAPTURE(size.x());
      const Domain<3> ground{-0.5 * size, 0.5 * size};
      const auto mass = slice<Spatial>(ground, joint_network(sets, ground, 2), {0.25, 4});
      const auto count = static_cast<double>(mass.bodies.size());
      densities.push_back(count / ground.measure());
      CHECK(std::abs(densities.back() / densities.front() - 1) < 0.1);
      std::size_t too_long = 0;
      for (const auto& body : mass.bodies)
        too_long += detail::elongation(body.parts[0]) > 4 * (1 + 1e-12);
      CHECK(too_long == mass.slicing.blocks_too_long);
      CHECK(static_cast<double>(too_long) < 0.01 * count);
      if (size.x() == 12) CHECK(too_long == 0);
    }
    // A plate of 8 x 8 x 1 (11.4) may be cut across, not split.
    const Domain<3> plate{{0, 0, 0}, {8, 8, 1}};
    CHECK(slice<Spatial>(plate, {upright(0, 4)}, {0, 5}).slicing.cuts == 1);
    CHECK(slice<Spatial>(plate, {upright(2, 0.5)}, {0, 5}).slicing.refused_too_long == 1);
  }

  TEST_CASE("V / S <= inscribed radius <= 3 V / S; a tetrahedron and a slab reach the ends") {
    const auto ratio = [](const ConvexPolyhedron& block) {
      return inscribed_ball(block).radius * block.surface_area() / mass_properties(block).measure;
    };
    double least = inf, most = 0;
    for (const auto& body : jointed_mass(cube, 7, 1.5).bodies) {
      least = std::min(least, ratio(body.parts[0]));
      most = std::max(most, ratio(body.parts[0]));
    }
    CHECK(least > 1);
    CHECK(most <= 3 + 1e-12);
    CHECK(ratio(ConvexPolyhedron({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                 {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {0, 1, 2, 3})) ==
          voussoir_test::near(3).epsilon(1e-13));
    CHECK(ratio(as_block(Domain<3>{{0, 0, 0}, {1e4, 1e4, 1}})) ==
          voussoir_test::near(1 + 2e-4).epsilon(1e-12));  // r S / V = (1 + 2e-4) for this slab
  }

  TEST_CASE("without joints the ground is one block, its faces labelled by side") {
    const auto mass = slice<Spatial>({{0, 0, 0}, {2, 3, 4}}, {}, {0.25, 5});
    REQUIRE(mass.bodies.size() == 1);
    const ConvexPolyhedron& block = mass.bodies[0].parts.at(0);
    CHECK(mass.bodies[0].properties.measure == 24);
    REQUIRE(block.size() == 6);
    const std::map<SpatialSide, Vec3> outward = {
        {SpatialSide::west, -Vec3::UnitX()},   {SpatialSide::east, Vec3::UnitX()},
        {SpatialSide::south, -Vec3::UnitY()},  {SpatialSide::north, Vec3::UnitY()},
        {SpatialSide::bottom, -Vec3::UnitZ()}, {SpatialSide::top, Vec3::UnitZ()}};
    for (std::size_t k = 0; k < 6; ++k) {
      const Cut cut = mass.cuts.at(static_cast<std::size_t>(block.cut(k)));
      CHECK(cut.kind == Cut::Kind::boundary);
      CHECK(block.half_space(k).normal == outward.at(static_cast<SpatialSide>(cut.source)));
    }
  }

  TEST_CASE("turned and mirrored joints cut turned and mirrored blocks") {
    const auto joints = joint_network(voussoir_test::three_sets(1.7, DiscJoints{5}), cube, 4);
    const BlockLimits limits{0.1, 10};
    const auto base = slice<Spatial>(cube, joints, limits);
    CHECK(base.bodies.size() > 60);
    // The cube is carried into itself by permutations of the axes with any signs.
    Eigen::Matrix3d quarter_turn, mirror, third;
    quarter_turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    mirror << -1, 0, 0, 0, 1, 0, 0, 0, 1;
    third << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    for (const Eigen::Matrix3d& turn : {quarter_turn, mirror, third}) {
      std::vector<SpatialJoint> turned;
      for (const SpatialJoint& joint : joints) turned.push_back(moved(joint, turn, Vec3::Zero()));
      const auto mass = slice<Spatial>(cube, turned, limits);
      REQUIRE(mass.bodies.size() == base.bodies.size());
      // The tree, and with it the order of the blocks, does not depend on the axes.
      double worst = 0;
      for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
        const auto &p = base.bodies[b].properties, &q = mass.bodies[b].properties;
        worst = std::max(
            {worst, std::abs(p.measure - q.measure), (turn * p.centroid - q.centroid).norm()});
      }
      CHECK(worst < 1e-12);
    }
  }

  TEST_CASE("one metre or one kilometre, near or 1e6 m from the origin: the same blocks") {
    const auto joints = joint_network(voussoir_test::three_sets(1.6, DiscJoints{5}), cube, 5);
    const auto base = slice<Spatial>(cube, joints, {0.1, 10});
    const auto changed = [&](double scale, const Vec3& shift) {
      std::vector<SpatialJoint> others;
      for (const SpatialJoint& joint : joints)
        others.push_back(moved(joint, scale * Eigen::Matrix3d::Identity(), shift));
      for (SpatialJoint& joint : others) {
        const double length = joint.trace.plane.normal.norm();  // scaled with the rest
        joint.trace.plane.normal /= length;
        joint.trace.plane.offset /= length;
      }
      return slice<Spatial>({scale * cube.low + shift, scale * cube.high + shift}, others,
                            {0.1 * scale, 10});
    };
    const auto volumes = sorted_volumes(base);
    for (const double scale : {1e-2, 100.0}) {
      auto found = sorted_volumes(changed(scale, {0, 0, 0}));
      for (double& volume : found) volume /= scale * scale * scale;
      CHECK(difference(found, volumes) < 1e-12);
    }
    // Vertices are rounded to 1e-10 m there, planes too: a block of 1 m2 faces is off by that.
    const auto far = changed(1, {1e6, -2e6, 5e5});
    CHECK(difference(sorted_volumes(far), volumes) < 2e-8);
    CHECK(std::abs(total_volume(far) / 1000 - 1) < 1e-10);
  }

  TEST_CASE("the same seed gives the same rock bit for bit, another seed another") {
    const auto one = jointed_mass(cube, 1, 2), again = jointed_mass(cube, 1, 2),
               other = jointed_mass(cube, 2, 2);
    REQUIRE(again.bodies.size() == one.bodies.size());
    for (std::size_t b = 0; b < one.bodies.size(); ++b)
      CHECK(again.bodies[b].parts[0].vertices() == one.bodies[b].parts[0].vertices());
    CHECK((other.bodies.size() != one.bodies.size() ||
           other.bodies[0].properties.centroid != one.bodies[0].properties.centroid));
  }

  TEST_CASE("vertices of sliced rock are the same or further apart than the tolerance") {
    const auto mass = jointed_mass(cube, 6, 1.3);
    std::vector<Vec3> vertices;
    for (const auto& body : mass.bodies)
      vertices.insert(vertices.end(), body.parts[0].vertices().begin(),
                      body.parts[0].vertices().end());
    std::sort(vertices.begin(), vertices.end(),
              [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
    const double tolerance = cube.tolerance();
    std::size_t shared = 0, near = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (std::size_t j = i + 1;
           j < vertices.size() && vertices[j].x() - vertices[i].x() <= tolerance; ++j) {
        const double distance = (vertices[i] - vertices[j]).norm();
        shared += distance == 0 ? 1 : 0;
        near += distance > 0 && distance <= tolerance ? 1 : 0;
      }
    CHECK(near == 0);
    // Eight blocks meet in a vertex where three joints do: 28 pairs for 8 vertices.
    CHECK(shared > 2 * vertices.size());
  }

  TEST_CASE("limits and domains out of range are refused") {
    const double nan = std::nan("");
    for (const BlockLimits& limits :
         {BlockLimits{-0.1, 5}, BlockLimits{nan, 5}, BlockLimits{0.1, 1.9}})
      CHECK_THROWS_AS((void)slice<Spatial>(cube, {}, limits), InvalidInput);
    for (const Domain<3>& bad :
         {Domain<3>{{0, 0, 0}, {0, 4, 4}}, Domain<3>{{0, 0, 0}, {4, 4, -1}},
          Domain<3>{{0, nan, 0}, {4, 4, 4}}, Domain<3>{{0, 0, 0}, {inf, 4, 4}}})
      CHECK_THROWS_AS((void)slice<Spatial>(bad, {}, {}), InvalidInput);
  }
}

}  // namespace spatial_slicing_test
