// SPDX-License-Identifier: MIT
// The solver in 3-D: equilibrium before excavation, prismatic openings, a slice against the plane
// analysis, bolts and linings.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/geometry/inscribed_ball.hpp>
#include <voussoir/geometry/principal_axes.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/carving_limits.hpp>
#include <voussoir/rockmass/orientation.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/rockmass/wall_pieces.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ribs.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"
#include "support/near.hpp"

namespace spatial_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

using Cavern = Solver<Spatial>;
const CoulombJoint joint({5e9, 5e8, 35 * degree});

RockMass<Spatial> blocks(const Domain<3>& ground, double spacing) {
  SpatialJointSet a{"J1", 75 * degree, 80 * degree}, b{"J2", 25 * degree, 100 * degree},
      c{"J3", 80 * degree, 5 * degree};
  for (SpatialJointSet* set : {&a, &b, &c}) {
    set->fisher_concentration = 500;
    set->spacing = spacing;
  }
  return slice<Spatial>(ground, joint_network({a, b, c}, ground, 1),
                        {.min_inscribed_radius = 0.15});
}
const Domain<3> cube{{-8, 0, -8}, {8, 6, 10}};

/// Measured stress: major 8 MPa plunging by 20 degrees, at 200 m.
const PrincipalStresses measured{
    {8e6, 6e6, 5.5e6},
    {{30 * degree, 20 * degree}, {120 * degree, 0}, {210 * degree, 70 * degree}}};

/// The plane mass, drawn out 1 m along y.
RockMass<Spatial> drawn_out(const Domain<2>& plane, const std::vector<Joint>& joints,
                            double smallest) {
  const Domain<3> space{{plane.low.x(), 0, plane.low.y()}, {plane.high.x(), 1, plane.high.y()}};
  std::vector<SpatialJoint> planes;
  for (const Joint& j : joints) {
    const Vec3 a(j.trace.start.x(), -1, j.trace.start.y()), b(j.trace.end.x(), -1, j.trace.end.y());
    const Vec3 along(0, 3, 0);
    planes.push_back({joint_polygon({a, b, b + along, a + along}), j.set});
  }
  return slice<Spatial>(space, planes, {.min_inscribed_radius = smallest});
}

const Domain<3> nasty_ground{{-6, -6, -6}, {6, 6, 6}};
struct NastyRock {
  RockMass<Spatial> mass;
  InSitu in_situ;
};

/// @param smallest  inscribed radius [m]; 0: no limit
NastyRock three_sets_of_joints(std::uint64_t seed, double smallest) {
  Random random(900 + seed);
  const double k0 = 0.3 + 1.7 * random.uniform(),
               surcharge = seed % 2 == 0 ? 2e6 * random.uniform() : 0,
               spacing = 0.8 + 1.5 * random.uniform();
  auto sets = voussoir_test::three_sets(spacing);
  if (seed % 3 == 0)
    for (SpatialJointSet& set : sets) set.dip_deviation = 10 * degree;
  return {slice<Spatial>(nasty_ground, joint_network(sets, nasty_ground, seed),
                         {.min_inscribed_radius = smallest}),
          {.density = 2700, .k0 = k0, .surcharge = surcharge}};
}

/// Every third of them 1e-4 rad from the one before.
NastyRock random_planes(std::uint64_t seed) {
  Random random(900 + seed);
  const auto vector = [&](double size) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    return Vec3(size * (x - 0.5), size * (y - 0.5), size * (z - 0.5));
  };
  const double k0 = 0.3 + 1.7 * random.uniform(),
               surcharge = seed % 2 == 0 ? 2e6 * random.uniform() : 0;
  std::vector<SpatialJoint> planes;
  for (std::uint64_t k = 0; k < 24 + 2 * seed; ++k) {
    Vec3 normal = vector(1);
    if (k % 3 == 2) normal = Vec3(planes.back().trace.plane.normal + 1e-4 * normal);
    planes.push_back({unbounded_joint(vector(10), normal), 0});
  }
  return {slice<Spatial>(nasty_ground, planes, {.min_inscribed_radius = 0}),
          {.density = 2700, .k0 = k0, .surcharge = surcharge}};
}

/// What blocks of several masses are out of balance by before anything is excavated, at worst.
struct Rounding {
  double ulps = 0, over_weight = 0, moment_over_weight = 0, thinnest = 1;
  std::size_t fewest = 1000000, most = 0;

  void add(NastyRock rock) {
    Cavern cavern(std::move(rock.mass), CoulombJoint({5e9, 5e8, 75 * degree}), rock.in_situ);
    const auto& system = cavern.system();
    Eigen::VectorXd f;
    detail::SystemOf::in(cavern).forces(system.displacement, f);
    fewest = std::min(fewest, cavern.mass().bodies.size());
    most = std::max(most, cavern.mass().bodies.size());
    for (int b = 0; b < cavern.ground(); ++b) {
      const ConvexPolyhedron& block =
          cavern.mass().bodies[static_cast<std::size_t>(b)].parts.front();
      double surface = 0;
      for (std::size_t face = 0; face < block.size(); ++face) surface += block.face(face).measure();
      const double deepest = 6 - system.body(b).centre.z() + block.diameter();
      const double pressure = rock.in_situ.vertical(deepest) * std::max(1.0, rock.in_situ.k0);
      const double ulp =
          std::numeric_limits<double>::epsilon() / 2 * pressure * (surface + 6 * block.diameter());
      const double force = f.segment<3>(6 * b).norm(), weight = system.body(b).weight;
      ulps = std::max(ulps, force / ulp);
      over_weight = std::max(over_weight, force / weight);
      moment_over_weight = std::max(
          moment_over_weight, f.segment<3>(6 * b + 3).norm() / (weight * system.body(b).gyration));
      thinnest = std::min(thinnest, inscribed_ball(block).radius);
    }
  }
};

}  // namespace

TEST_SUITE("solver/spatial") {
  TEST_CASE("any in-situ stress tensor leaves every block in equilibrium to rounding") {
    for (const InSitu& in_situ :
         {InSitu{.density = 2700}, InSitu{.density = 2700, .k0 = 1.6, .surcharge = 3e5},
          InSitu{.density = 2700, .k0 = 0.7, .surcharge = 1e5, .k0_y = 1.4, .k0_xy = 0.3}}) {
      Cavern cavern(blocks(cube, 1.5), joint, in_situ);
      Eigen::VectorXd f;
      detail::SystemOf::in(cavern).forces(cavern.system().displacement, f);
      CHECK(cavern.system().unbalance_over_weight(f) < 2e-11);
    }
  }

  // Tractions are rounded, and so are the places of a block's vertices, counted from the middle of
  // the ground: a force is off by an ulp of pressure x (surface + size of the ground x perimeter).
  // Measured: 2.3 ulps. Over the weight that is up to 2e-9, since a sliver has much surface and no
  // weight.
  constexpr double ulps = 8;

  TEST_CASE("slivers too: what a block is out of balance by is the rounding of forces on it") {
    Rounding seen;
    for (const std::uint64_t seed : {3u, 8u, 18u, 19u}) seen.add(three_sets_of_joints(seed, 0));
    for (const std::uint64_t seed : {1u, 5u}) seen.add(random_planes(seed));
    CHECK(seen.ulps < ulps);
    CHECK(seen.thinnest < 1e-4);
    CHECK(seen.over_weight < 1e-8);
  }

  // The figures of docs/decisions.md: --no-skip -tc='table of*'
  TEST_CASE("table of what blocks are out of balance by in nasty masses" * doctest::skip()) {
    Rounding none, limited, planes;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      none.add(three_sets_of_joints(seed, 0));
      limited.add(three_sets_of_joints(seed, 0.1));
      if (seed <= 10) planes.add(random_planes(seed));
    }
    for (const auto& [name, row] : {std::pair{std::string("three sets"), none},
                                    std::pair{std::string("the same, limited"), limited},
                                    std::pair{std::string("random planes"), planes}}) {
      CHECK(row.ulps < ulps);
      MESSAGE(name << ": " << row.fewest << " to " << row.most << " blocks, " << row.ulps
                   << " ulps, over the weight " << row.over_weight << ", moment "
                   << row.moment_over_weight << ", thinnest " << row.thinnest << " m");
    }
  }

  TEST_CASE("principal horizontal stresses give the tensor in the axes of the tunnel") {
    // Major 2 towards N 90 E (x): k_x = 2, k_y = 0.5; towards N 45 E: mean on both, shear 0.75.
    const InSitu east = InSitu{.density = 2700}.with_horizontal(2, 0.5, 90 * degree);
    CHECK(east.k0 == voussoir_test::near(2));
    CHECK(east.k0_y == voussoir_test::near(0.5));
    CHECK(std::abs(east.k0_xy) < 1e-15);
    const InSitu between = InSitu{.density = 2700}.with_horizontal(2, 0.5, 45 * degree);
    CHECK(between.k0 == voussoir_test::near(1.25));
    CHECK(between.k0_y == voussoir_test::near(1.25));
    CHECK(between.k0_xy == voussoir_test::near(0.75));
  }

  TEST_CASE("principal stresses in any direction are met where they were measured") {
    const InSitu in_situ = InSitu{.density = 2700, .k0 = 0.8}.with_measured(measured, 200);
    const Stress<3> there = in_situ.stress<3>(200);
    const Vec3 found = principal_axes(there).moments;
    CHECK(found[0] == voussoir_test::near(5.5e6).epsilon(1e-12));
    CHECK(found[1] == voussoir_test::near(6e6).epsilon(1e-12));
    CHECK(found[2] == voussoir_test::near(8e6).epsilon(1e-12));
    for (int k = 0; k < 3; ++k) {
      const Vec3 axis = measured.axes[k].direction();
      CHECK(axis.dot(there * axis) == voussoir_test::near(measured.values[k]).epsilon(1e-12));
    }
    // The major one dips to the north-east: it presses a plane that faces there.
    CHECK(measured.axes[0].direction().x() > 0);
    CHECK(measured.axes[0].direction().y() > 0);
    CHECK(measured.axes[0].direction().z() < 0);
    // With depth rho g times the ratios, and no more.
    const Stress<3> more = in_situ.stress<3>(210) - there;
    const double weight = 2700 * 9.81 * 10;
    CHECK(more(2, 2) == voussoir_test::near(weight).epsilon(1e-9));
    CHECK(more(0, 0) == voussoir_test::near(0.8 * weight).epsilon(1e-9));
    CHECK(more(1, 1) == voussoir_test::near(0.8 * weight).epsilon(1e-9));
    CHECK(std::abs(more(0, 1)) + std::abs(more(0, 2)) + std::abs(more(1, 2)) < 1e-6 * weight);
    // What ratios alone can say comes out the same.
    const InSitu plain{.density = 2700, .k0 = 2, .surcharge = 1e6, .k0_y = 0.5};
    const double v = plain.vertical(50);
    const InSitu told = InSitu{.density = 2700, .k0 = 2, .k0_y = 0.5}.with_measured(
        {{2 * v, 0.5 * v, v}, {{90 * degree, 0}, {0, 0}, {0, 90 * degree}}}, 50);
    for (const double depth : {0.0, 50.0, 120.0})
      CHECK((told.stress<3>(depth) - plain.stress<3>(depth)).norm() < 1e-12 * v);
  }

  TEST_CASE("a measured stress puts every block in equilibrium, at rest and in motion") {
    const InSitu in_situ = InSitu{.density = 2700, .k0 = 0.8}.with_measured(measured, 200);
    Cavern cavern(blocks(cube, 1.5), CoulombJoint({5e9, 5e8, 60 * degree}), in_situ);
    Eigen::VectorXd f;
    detail::SystemOf::in(cavern).forces(cavern.system().displacement, f);
    // 2.6 MPa on blocks of a few kN: 1e3 times the weight, rounded as above.
    CHECK(cavern.system().unbalance_over_weight(f) < 2e-10);
    // In motion nothing is left to be held where nothing was excavated.
    for (const InSitu& stress :
         {in_situ,
          InSitu{.density = 2700, .k0 = 0.7, .surcharge = 1e5, .k0_y = 1.4, .k0_xy = 0.3}}) {
      auto run = moving_rock(cavern.mass(), CoulombJoint({5e9, 5e8, 60 * degree}), stress);
      run.set_held(0);
      CHECK(run.unbalance_over_weight() < 1e-6);
    }
  }

  TEST_CASE("the friction that the in-situ stress asks for is that of its largest Mohr circle") {
    const InSitu plain{.density = 2700, .k0 = 0.5};
    CHECK(plain.required_friction_angle<3>() ==
          voussoir_test::near(plain.required_friction_angle()).epsilon(1e-12));
    // Along y alone: the plane x, z sees nothing of it.
    const InSitu along{.density = 2700, .k0 = 1, .k0_y = 2};
    CHECK(along.required_friction_angle() == 0);
    CHECK(along.required_friction_angle<3>() == voussoir_test::near(std::asin(1.0 / 3)));
    // sigma_xy 0.3: horizontal principal stresses 1.3 and 0.7.
    const InSitu turned{.density = 2700, .k0 = 1, .k0_y = 1, .k0_xy = 0.3};
    CHECK(turned.required_friction_angle<3>() == voussoir_test::near(std::asin(0.6 / 2)));
    CHECK(turned.required_friction_angle<3>(0) == voussoir_test::near(std::asin(0.6 / 2)));
    // By brute force over directions of joints, in a measured stress.
    const InSitu in_situ = InSitu{.density = 2700}.with_measured(measured, 200);
    const Stress<3> s = in_situ.stress<3>(200);
    double most = 0;
    for (double dip = 0; dip <= 90; dip += 1)
      for (double towards = 0; towards < 360; towards += 1) {
        const Vec3 n = upward_normal({dip * degree, towards * degree});
        const double normal = n.dot(s * n);
        most = std::max(most, std::atan((s * n - normal * n).norm() / normal));
      }
    const double needed = in_situ.required_friction_angle<3>(200);
    CHECK(most <= needed * (1 + 1e-12));
    CHECK(most > 0.999 * needed);  // a degree beside the worst plane, cos of two degrees
  }

  TEST_CASE("measured stresses that cannot be are refused by name") {
    PrincipalStresses bent = measured;
    bent.axes[1].trend = 125 * degree;
    CHECK_THROWS_AS((void)bent.tensor(), InvalidInput);
    PrincipalStresses pulled = measured;
    pulled.values[2] = -1;
    CHECK_THROWS_WITH_AS((void)pulled.tensor(), "principal stress = -1: must be >= 0 Pa",
                         InvalidInput);
    // Whole degrees are no fault, and do not change the sum of the stresses.
    PrincipalStresses rounded = measured;
    rounded.axes[1] = {120.6 * degree, 0.4 * degree};
    CHECK(rounded.tensor().trace() == voussoir_test::near(19.5e6).epsilon(1e-12));
    CHECK_THROWS_AS((void)InSitu{.density = 2700}.with_measured(measured, 1000), InvalidInput);
    // More is taken off on the way up than there is.
    CHECK_THROWS_AS((InSitu{.density = 2700, .k0 = 3}.with_measured(measured, 200).check()),
                    InvalidInput);
  }

  TEST_CASE("convergence of a section in 3-D is that of the plane tunnel it is drawn out of") {
    const Domain<2> plane{{-10, -10}, {10, 10}};
    std::vector<JointSet> sets = voussoir_test::paper_sets(6);
    for (JointSet& set : sets) set.intensity = 0.5;
    const auto joints = joint_network(sets, plane, 2);
    const InSitu in_situ{.density = 2700, .k0 = 0.8, .surcharge = 5e5};
    Solver<> flat(slice(plane, joints, {.min_inscribed_radius = 0.3}), joint, in_situ);
    Cavern deep(drawn_out(plane, joints, 0.3), joint, in_situ);
    const SimplePolygon outline = circular_opening(5, 36);
    flat.excavate(outline, 0.05);
    deep.excavate(PrismaticOpening(outline), 0.05);
    // The same rigid motion of every block by its place: what is measured is the same, piece by
    // piece; 1e-9 covers the digits of the cuts.
    const auto move = [](auto& tunnel, auto&& at) {
      for (int b = 0; b + 1 < tunnel.system().body_count(); ++b)
        at(detail::SystemOf::in(tunnel).displacement, b, tunnel.system().body(b).centre);
    };
    move(flat, [](Eigen::VectorXd& u, int b, const Vec2& c) {
      u.segment<2>(3 * b) = -1e-3 * Vec2(2 + c.x() / 10, 1 + c.y() / 20).cwiseProduct(c) / 5;
    });
    move(deep, [](Eigen::VectorXd& u, int b, const Vec3& c) {
      u[6 * b] = -1e-3 * (2 + c.x() / 10) * c.x() / 5;
      u[6 * b + 1] = 7e-3;  // along the tunnel: no convergence
      u[6 * b + 2] = -1e-3 * (1 + c.z() / 20) * c.z() / 5;
    });
    const Convergence one = convergence(flat), all = convergence(deep),
                      part = convergence(deep, 0.5, 0.6);
    for (const auto place : {&Convergence::crown, &Convergence::right_springing,
                             &Convergence::left_springing, &Convergence::invert}) {
      CHECK(std::isfinite(one.*place));
      CHECK(std::abs(one.*place - all.*place) <= 1e-9);
      CHECK(all.*place == part.*place);
    }
    CHECK(std::isnan(convergence(deep, 5).crown));  // there is no wall
    CHECK_THROWS_AS((void)convergence(deep, 0.5, 0), InvalidInput);
  }

  TEST_CASE("what is dropped at the wall, and what is a collapse, follow the rock and the tunnel") {
    // Of blocks of a metre what a cube of 0.272 m is; of small blocks a tenth.
    const auto coarse = blocks(cube, 2.5);
    CHECK(smallest_piece_of(coarse) == voussoir_test::near(std::pow(0.074, 1.5)));
    RockMass<Spatial> fine = coarse;
    while (fine.bodies.size() < 20000)
      fine.bodies.insert(fine.bodies.end(), coarse.bodies.begin(), coarse.bodies.end());
    CHECK(smallest_piece_of(fine) ==
          voussoir_test::near(0.1 * cube.measure() / static_cast<double>(fine.bodies.size())));
    CHECK(smallest_piece_of(voussoir_test::jointed_rock({{-5, -5}, {5, 5}}, 1)) == 0.074);
    // Rock lost is counted over the open length, but no more than the width.
    CHECK(open_length(coarse) == 1);
    CHECK(open_length(carve(coarse, PrismaticOpening(circular_opening(4)), 0.1)) ==
          voussoir_test::near(4));
    CHECK(open_length(carve(coarse, PrismaticOpening(circular_opening(4), 3.5), 0.1)) ==
          voussoir_test::near(2.5));
    // Asked for nothing, the solver drops what this says.
    Cavern by_default(coarse, joint, {.density = 2700}), told = by_default;
    by_default.excavate(PrismaticOpening(circular_opening(5, 30)));
    told.excavate(PrismaticOpening(circular_opening(5, 30)), std::pow(0.074, 1.5));
    CHECK(by_default.mass().carving.dropped_pieces == told.mass().carving.dropped_pieces);
    CHECK(by_default.mass().bodies.size() == told.mass().bodies.size());
  }

  TEST_CASE("an opening of any section takes out section times length, to rounding") {
    const SimplePolygon notched({{-2, -2}, {2, -2}, {2, 1}, {0.5, 1}, {0.5, 2}, {-2, 2}});
    for (const auto& [opening, length] :
         {std::pair{PrismaticOpening(circular_opening(6, 24)), 6.0},
          {PrismaticOpening(horseshoe_opening(5, 2)), 6.0},
          {PrismaticOpening(notched), 6.0},
          {PrismaticOpening(notched, 2.5), 3.5},
          {PrismaticOpening(circular_opening(6, 24), 1, 4.25), 3.25}}) {
      const auto mass = carve(blocks(cube, 1.5), opening, 0.0);
      const double volume = opening.section().area() * length;
      CHECK(mass.carving.removed_measure == voussoir_test::near(volume).epsilon(1e-12));
      double left = 0;
      for (const auto& body : mass.bodies) left += body.properties.measure;
      CHECK(left + volume == voussoir_test::near(cube.measure()).epsilon(1e-12));
      double wall = 0;
      for (const auto& piece : wall_pieces(mass)) wall += piece.facet.measure();
      CHECK(wall == voussoir_test::near(opening.section().perimeter() * length).epsilon(1e-9));
    }
  }

  TEST_CASE("openings that do not fit are refused, with the place") {
    CHECK_THROWS_WITH_AS((void)carve(blocks(cube, 3), PrismaticOpening(circular_opening(17)), 0.1),
                         doctest::Contains("opening: it cuts the domain in "), InvalidInput);
    CHECK_THROWS_AS((void)carve(blocks(cube, 3), PrismaticOpening(circular_opening(4), 7, 9), 0.1),
                    InvalidInput);
    CHECK_THROWS_AS(PrismaticOpening(circular_opening(4), 3, 3), InvalidInput);
  }

  TEST_CASE("a slice one metre thick does what the plane analysis does") {
    const Domain<2> plane{{-12, -12}, {12, 12}};
    std::vector<JointSet> sets = voussoir_test::paper_sets(6);
    for (JointSet& set : sets) set.intensity = 0.6;
    const auto joints = joint_network(sets, plane, 1);
    const InSitu in_situ{.density = 2700, .k0 = 0.8, .surcharge = 5e5};
    Solver<> flat(slice(plane, joints, {.min_inscribed_radius = 0.3}), joint, in_situ);
    Cavern deep(drawn_out(plane, joints, 0.3), joint, in_situ);
    const SimplePolygon outline = circular_opening(5, 36);
    flat.excavate(outline, 0.05);
    deep.excavate(PrismaticOpening(outline), 0.05);
    REQUIRE(flat.system().body_count() == deep.system().body_count());
    // The same blocks in another order: found by their place.
    std::vector<int> twin;
    for (int b = 0; b + 1 < flat.system().body_count(); ++b) {
      const Vec2& centre = flat.system().body(b).centre;
      for (int q = 0; q + 1 < deep.system().body_count(); ++q) {
        const Vec3& other = deep.system().body(q).centre;
        if ((Vec2(other.x(), other.z()) - centre).norm() < 1e-9) twin.push_back(q);
      }
      REQUIRE(twin.size() == static_cast<std::size_t>(b) + 1);
    }
    const auto difference = [&](const Eigen::VectorXd& u, const Eigen::VectorXd& v) {
      double squared = 0, size = 0, across = 0;
      for (std::size_t b = 0; b < twin.size(); ++b) {
        const Vec3 w = v.segment<3>(6 * twin[b]);
        const Vec2 here = u.segment<2>(3 * static_cast<Eigen::Index>(b));
        squared += (Vec2(w.x(), w.z()) - here).squaredNorm();
        size += here.squaredNorm();
        across = std::max(across, std::abs(w.y()));
      }
      CHECK(across < 1e-12);
      return std::sqrt(squared / size);
    };
    // Elastic: the same to rounding, for the points of a contact have the same moments.
    Eigen::VectorXd u, v;
    detail::SystemOf::in(flat).wall_fraction = detail::SystemOf::in(deep).wall_fraction = 0;
    detail::SystemOf::in(flat).forces(flat.system().displacement, u);
    detail::SystemOf::in(deep).forces(deep.system().displacement, v);
    BlockCholesky<3>(flat.system().elastic_stiffness()).solve_in_place(u);
    BlockCholesky<6>(deep.system().elastic_stiffness()).solve_in_place(v);
    CHECK(difference(u, v) < 1e-9);
    detail::SystemOf::in(flat).wall_fraction = detail::SystemOf::in(deep).wall_fraction = 1;
    // With slip and opening not quite: four points on a rectangle, two of them in its middle, let
    // go one after the other at other places than two points on a line do.
    const auto first = flat.equilibrium(), second = deep.equilibrium();
    REQUIRE(first.verdict == Verdict::stable);
    REQUIRE(second.verdict == Verdict::stable);
    std::vector<int> fell;
    for (const int b : first.fallen) fell.push_back(twin[static_cast<std::size_t>(b)]);
    std::vector<int> fell_in_space = second.fallen;
    std::sort(fell.begin(), fell.end());
    std::sort(fell_in_space.begin(), fell_in_space.end());
    CHECK(fell == fell_in_space);
    CHECK(difference(flat.system().displacement, deep.system().displacement) < 0.03);
  }

  TEST_CASE("ribs touch the whole wall, bolts hold at every joint, and both help") {
    Cavern bare(blocks(cube, 1.2), joint, {.density = 2700, .surcharge = 4e5});
    const PrismaticOpening opening(circular_opening(5, 30));
    bare.excavate(opening, 0.02);
    Cavern bolted = bare, lined = bare;
    const LiningRibs ribs{.ring = {.nodes = 30}, .spacing = 1};
    const auto frame = lining_frame(bare.mass(), ribs);
    CHECK(frame.nodes.size() == 6 * 30);
    CHECK(frame.members.size() == 6 * 30 + 5 * 30);
    double area = 0;
    for (const auto& c : frame.contacts) {
      area += c.facet.measure();
      // The rock is outside: the area vector points away from the axis of the tunnel.
      const Vec3 p = c.facet.centre();
      CHECK(c.facet.area_vector().dot(Vec3(p.x(), 0, p.z())) > 0);
      CHECK((frame.nodes[static_cast<std::size_t>(c.node)] - p).norm() < 0.8);
    }
    // Where pieces were dropped, too: 0.05 m2 at least would be missing.
    CHECK(bare.mass().carving.dropped_pieces > 0);
    CHECK(area == voussoir_test::near(opening.section().perimeter() * 6).epsilon(1e-6));
    double panels = 0;
    for (const auto& panel : frame.panels) {
      panels += panel.facet.measure();
      const Vec3 p = panel.facet.centre();
      CHECK(panel.facet.area_vector().dot(Vec3(p.x(), 0, p.z())) > 0);
      CHECK((frame.nodes[static_cast<std::size_t>(panel.node)] - p).norm() < 0.8);
    }
    CHECK(panels == voussoir_test::near(6 * opening.section().perimeter()).epsilon(1e-9));
    lined.install_lining(frame,
                         {LiningSection::strip(0.1, 1, 25e9), LiningSection::strip(0.1, 0.5, 25e9)},
                         CoulombJoint({1e10, 1e10, 35 * degree}));
    int crossings = 0;
    for (const SpatialLine& bar :
         bolt_bars({.length = 3, .angular_spacing = 20 * degree}, opening, 1, 0, 6))
      crossings += bolted.install_bolt(bar, AxialBolt({.axial_stiffness = 2e8}));
    CHECK(crossings == static_cast<int>(bolted.bolts()->springs().size()));
    CHECK(crossings > 60);
    const auto moved = [](Cavern& cavern) {
      const auto report = cavern.equilibrium();
      CHECK(report.verdict == Verdict::stable);
      double sum = 0, weight = 0;
      for (const auto& piece : wall_pieces(cavern.mass())) {
        if (!cavern.system().body(piece.body).movable) continue;
        const Vec3 p = piece.facet.centre();
        sum -= piece.facet.measure() *
               cavern.displacement_of(piece.body, p).dot(Vec3(p.x(), 0, p.z()).normalized());
        weight += piece.facet.measure();
      }
      return sum / weight;
    };
    const double without = moved(bare), with_bolts = moved(bolted), with_lining = moved(lined);
    CHECK(with_bolts < without);
    CHECK(with_lining < 0.9 * without);
  }
}

}  // namespace spatial_test
