// SPDX-License-Identifier: MIT
// The solver in 3-D: equilibrium before excavation, prismatic openings, a slice against the plane
// analysis, bolts and linings.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_rock.hpp"

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

}  // namespace

TEST_SUITE("solver/spatial") {
  TEST_CASE("any in-situ stress tensor leaves every block in equilibrium to rounding") {
    for (const InSitu& in_situ :
         {InSitu{.density = 2700}, InSitu{.density = 2700, .k0 = 1.6, .surcharge = 3e5},
          InSitu{.density = 2700, .k0 = 0.7, .surcharge = 1e5, .k0_y = 1.4, .k0_xy = 0.3}}) {
      Cavern cavern(blocks(cube, 1.5), joint, in_situ);
      Eigen::VectorXd f;
      cavern.system().forces(cavern.system().displacement, f);
      CHECK(cavern.system().unbalance_over_weight(f) < 2e-11);
    }
  }

  TEST_CASE("principal horizontal stresses give the tensor in the axes of the tunnel") {
    // Major 2 towards N 90 E (x): k_x = 2, k_y = 0.5; towards N 45 E: mean on both, shear 0.75.
    const InSitu east = InSitu{.density = 2700}.with_horizontal(2, 0.5, 90 * degree);
    CHECK(east.k0 == doctest::Approx(2));
    CHECK(east.k0_y == doctest::Approx(0.5));
    CHECK(std::abs(east.k0_xy) < 1e-15);
    const InSitu between = InSitu{.density = 2700}.with_horizontal(2, 0.5, 45 * degree);
    CHECK(between.k0 == doctest::Approx(1.25));
    CHECK(between.k0_y == doctest::Approx(1.25));
    CHECK(between.k0_xy == doctest::Approx(0.75));
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
      CHECK(mass.carving.removed_measure == doctest::Approx(volume).epsilon(1e-12));
      double left = 0;
      for (const auto& body : mass.bodies) left += body.properties.measure;
      CHECK(left + volume == doctest::Approx(cube.measure()).epsilon(1e-12));
      double wall = 0;
      for (const auto& piece : wall_pieces(mass)) wall += piece.facet.measure();
      CHECK(wall == doctest::Approx(opening.section().perimeter() * length).epsilon(1e-9));
    }
  }

  TEST_CASE("openings that do not fit are refused, with the place") {
    CHECK_THROWS_WITH_AS((void)carve(blocks(cube, 3), PrismaticOpening(circular_opening(17)), 0.1),
                         "opening: its section touches or leaves the domain at x, z = (8.5, 0) m",
                         InvalidInput);
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
    flat.system().wall_fraction = deep.system().wall_fraction = 0;
    flat.system().forces(flat.system().displacement, u);
    deep.system().forces(deep.system().displacement, v);
    BlockCholesky<3>(flat.system().elastic_stiffness()).solve_in_place(u);
    BlockCholesky<6>(deep.system().elastic_stiffness()).solve_in_place(v);
    CHECK(difference(u, v) < 1e-9);
    flat.system().wall_fraction = deep.system().wall_fraction = 1;
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
    double area = 0, wall = 0;
    for (const auto& c : frame.contacts) {
      area += c.facet.measure();
      // The rock is outside: the area vector points away from the axis of the tunnel.
      const Vec3 p = c.facet.centre();
      CHECK(c.facet.area_vector().dot(Vec3(p.x(), 0, p.z())) > 0);
      CHECK((frame.nodes[static_cast<std::size_t>(c.node)] - p).norm() < 0.8);
    }
    for (const auto& piece : wall_pieces(bare.mass())) wall += piece.facet.measure();
    CHECK(area == doctest::Approx(wall).epsilon(1e-6));
    double panels = 0;
    for (const auto& panel : frame.panels) {
      panels += panel.facet.measure();
      const Vec3 p = panel.facet.centre();
      CHECK(panel.facet.area_vector().dot(Vec3(p.x(), 0, p.z())) > 0);
      CHECK((frame.nodes[static_cast<std::size_t>(panel.node)] - p).norm() < 0.8);
    }
    CHECK(panels == doctest::Approx(6 * opening.section().perimeter()).epsilon(1e-9));
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
