// SPDX-License-Identifier: MIT
// The ground beyond the domain, against closed forms of what it does to the domain's edge.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/farfield/edge_mesh.hpp>
#include <voussoir/farfield/ground_around.hpp>
#include <voussoir/theory/circular_opening.hpp>

#include "support/near.hpp"

namespace ground_around_test {

using namespace voussoir;

namespace {

Vec2 kirsch_motion(const FarStress& far, const ElasticGround& ground, const Vec2& p) {
  const double theta = std::atan2(p.y(), p.x());
  const OpeningField at = kirsch(1, far, ground, p.norm(), theta);
  const Vec2 outward = p.normalized(), along(-outward.y(), outward.x());
  return Vec2(-at.inward * outward + at.tangential * along);
}

/// Of the hole alone: without the stress that was there before.
Vec2 kirsch_traction(const FarStress& far, const ElasticGround& ground, const Vec2& p,
                     const Vec2& normal) {
  const double theta = std::atan2(p.y(), p.x());
  const OpeningField at = kirsch(1, far, ground, p.norm(), theta);
  const Vec2 outward = p.normalized(), along(-outward.y(), outward.x());
  const double across = outward.dot(normal), tangential = along.dot(normal);
  const Vec2 whole = (at.radial_stress * across + at.shear_stress * tangential) * outward +
                     (at.shear_stress * across + at.hoop_stress * tangential) * along;
  return Vec2(-(whole - Vec2(far.horizontal() * normal.x(), far.vertical * normal.y())));
}

/// Work that the edge of a box does on the ground around it when it moves as Kirsch says: half the
/// sum of traction times displacement. Midpoint rule, 4 000 pieces a side: within 1e-6.
double kirsch_energy(const FarStress& far, const ElasticGround& ground, const Domain<2>& box) {
  constexpr int pieces = 4000;
  double energy = 0;
  for (int axis = 0; axis < 2; ++axis)
    for (const bool upper : {false, true})
      for (int k = 0; k < pieces; ++k) {
        Vec2 p;
        p[axis] = upper ? box.high[axis] : box.low[axis];
        const double length = box.size()[1 - axis];
        p[1 - axis] = box.low[1 - axis] + length * (k + 0.5) / pieces;
        Vec2 into_box = zeros<Vec2>();
        into_box[axis] = upper ? -1 : 1;
        energy += 0.5 * length / pieces *
                  kirsch_traction(far, ground, p, into_box).dot(kirsch_motion(far, ground, p));
      }
  return energy;
}

template <int Dim, class Motion>
Eigen::VectorXd motion_of(const EdgeMesh<Dim>& mesh, Motion&& motion) {
  Eigen::VectorXd u(Dim * mesh.node_count());
  for (int k = 0; k < mesh.node_count(); ++k)
    u.segment<Dim>(Dim * k) = motion(mesh.nodes()[static_cast<std::size_t>(k)]);
  return u;
}

template <int Dim, class Motion>
double energy(const GroundAround<Dim>& ground, Motion&& motion) {
  const Eigen::VectorXd u = motion_of<Dim>(ground.mesh(), motion);
  return 0.5 * u.dot(ground.stiffness() * u);
}

FarField<2> all_round(const ElasticGround& ground) {
  return FarField<2>::elastic(elastic_matrix<2>(ground)).with(Side::top, Boundary::elastic);
}

}  // namespace

TEST_SUITE("farfield/ground_around") {
  // Linear elements with 12 cells on the longest side: their error goes with the square of the
  // angle a cell is seen under, 7.5 degrees in the worst place, and grows towards nu = 0.5; what
  // that makes of the opening's own convergence is a tenth of it (solver/far_field).
  TEST_CASE("a hole's displacements meet the stiffness that Kirsch says") {
    for (const double half_width : {6.0, 12.0, 48.0})
      for (const double nu : {0.0, 0.2, 0.35})
        for (const double k0 : {0.5, 1.0, 2.0}) {
          CAPTURE(half_width);
          CAPTURE(nu);
          CAPTURE(k0);
          const Domain<2> box{{-half_width, -6}, {half_width, 6}};
          const ElasticGround ground{1e9, nu};
          const FarStress far{1e6, k0};
          const GroundAround<2> around(box, all_round(ground));
          const double found =
              energy(around, [&](const Vec2& p) { return kirsch_motion(far, ground, p); });
          CHECK(found / kirsch_energy(far, ground, box) == voussoir_test::near(1).epsilon(0.02));
        }
  }

  // A cavity under pressure in 3-D: u = A r / r^3, and all that is stored outside a surface is half
  // the work on it: traction -2 G (A / r^3) (3 r r / r^2 - 1) n.
  TEST_CASE("in 3-D a cavity's displacements meet the stiffness that Lame says") {
    constexpr int pieces = 200;
    const double g = 1e9, amplitude = 1;
    const Domain<3> box{{-1, -1, -1}, {1, 1, 1}};
    double exact = 0;
    for (int i = 0; i < pieces; ++i)
      for (int j = 0; j < pieces; ++j) {
        const Vec3 p(1, -1 + 2 * (i + 0.5) / pieces, -1 + 2 * (j + 0.5) / pieces);
        const double r = p.norm();
        const Vec3 u = amplitude / (r * r * r) * p;
        const Vec3 traction =
            2 * g * amplitude / (r * r * r) *
            Vec3(3 * p.x() / (r * r) * p - Vec3(1, 0, 0));  // on the ground, whose normal is -x
        exact += 6 * 0.5 * 4.0 / (pieces * pieces) * u.dot(traction);
      }
    const auto field =
        FarField<3>::elastic(elastic_matrix<3>({g, 0.2})).with(SpatialSide::top, Boundary::elastic);
    const GroundAround<3> around(box, field);
    const double found = energy(around, [&](const Vec3& p) {
      const double r = p.norm();
      return Vec3(amplitude / (r * r * r) * p);
    });
    // 6 cells a side: four times the error of 12.
    CHECK(found / exact == voussoir_test::near(1).epsilon(0.06));
  }

  TEST_CASE("between rollers a strip beyond the side is pressed as in an oedometer") {
    const ElasticGround ground{1e9, 0.3};
    const Domain<2> box{{-10, -4}, {10, 6}};
    const FarField<2> field = FarField<2>::elastic(elastic_matrix<2>(ground))
                                  .with(Side::bottom, Boundary::rollers)
                                  .with(Side::left, Boundary::rollers);
    // Sideways it grows from the rollers at x = -10: the strip is 19 times 20 m long. Its top is
    // free, so that it is pressed under plane stress upwards: E' = E / (1 - nu^2). Exact, for the
    // stress is uniform.
    const GroundAround<2> around(box, field);
    const double modulus = ground.youngs_modulus() / (1 - 0.3 * 0.3), length = 19 * 20;
    // What is pressed uniformly moves up as it likes: the least energy over such motions.
    const auto& mesh = around.mesh();
    const double nu = 0.3 / (1 - 0.3), strain = -1 / length;
    const double found = energy(
        around, [&](const Vec2& p) { return Vec2(1, -nu * strain * (p.y() - box.low.y())); });
    CHECK(mesh.node_count() == mesh.cells_along(1) + 1);
    // The far end cannot widen: that costs a piece of the strip as long as it is high, of 380 m.
    CHECK(found / (0.5 * modulus / length * 10) == voussoir_test::near(1).epsilon(0.03));
    CHECK(found > 0.5 * modulus / length * 10);
  }

  TEST_CASE("turned by a right angle it is the same ground, turned") {
    // Of no symmetry: pressed along x it shears.
    ElasticMatrix<2> m;
    m << 3e9, 1e9, 0.2e9, 1e9, 2e9, -0.1e9, 0.2e9, -0.1e9, 0.6e9;
    ElasticMatrix<2> turned;  // by 90 degrees: xx and yy change places, xy its sign
    turned << 2e9, 1e9, 0.1e9, 1e9, 3e9, -0.2e9, 0.1e9, -0.2e9, 0.6e9;
    const auto field = FarField<2>::elastic(m).with(Side::top, Boundary::elastic);
    const auto field_turned = FarField<2>::elastic(turned).with(Side::top, Boundary::elastic);
    const GroundAround<2> around({{-5, -3}, {5, 3}}, field),
        other({{-3, -5}, {3, 5}}, field_turned);
    const auto motion = [](const Vec2& p) {
      return Vec2(std::sin(p.x()) + 0.3 * p.y(), std::cos(p.y() + 0.4 * p.x()));
    };
    const double one = energy(around, motion), two = energy(other, [&](const Vec2&p) {
                                                 const Vec2 before = motion(Vec2(p.y(), -p.x()));
                                                 return Vec2(-before.y(), before.x());
                                               });
    CHECK(one == voussoir_test::near(two).epsilon(1e-12));
  }

  TEST_CASE("half of it between rollers is half of the whole") {
    const ElasticGround ground{1e9, 0.2};
    const FarStress far{1e6, 0.5};
    const GroundAround<2> whole({{-6, -6}, {6, 6}}, all_round(ground)),
        half({{0, -6}, {6, 6}}, all_round(ground).with(Side::left, Boundary::rollers));
    const auto motion = [&](const Vec2& p) { return kirsch_motion(far, ground, p); };
    // To rounding: the layers are the same, for both have 12 cells on their longest side.
    CHECK(energy(half, motion) == voussoir_test::near(0.5 * energy(whole, motion)).epsilon(1e-9));
    for (int k = 0; k < half.mesh().node_count(); ++k)
      if (half.mesh().is_held(k, 0)) CHECK(half.stiffness()(2 * k, 2 * k) == 0);
  }

  TEST_CASE("a place on the edge is the mean of nodes around it") {
    const Domain<3> box{{-1, -2, -3}, {3, 4, 2}};
    const auto field = FarField<3>::elastic(elastic_matrix<3>({1e9, 0.2}))
                           .with(SpatialSide::south, Boundary::rollers);
    const EdgeMesh<3> mesh(box, field);
    for (const auto& [side, p] : {std::pair{SpatialSide::east, Vec3(3, 1.3, -0.7)},
                                  std::pair{SpatialSide::bottom, Vec3(-0.2, 3.9, -3)},
                                  std::pair{SpatialSide::north, Vec3(-1, 4, 2)}}) {
      const auto place = mesh.place_of_point(side, p);
      Vec3 mean = zeros<Vec3>();
      for (std::size_t k = 0; k < place.nodes.size(); ++k)
        mean += place.shares[k] * mesh.nodes()[static_cast<std::size_t>(place.nodes[k])];
      CHECK((mean - p).norm() < 1e-12);
    }
  }

  TEST_CASE("sides that contradict each other are refused by name") {
    const auto elastic = FarField<2>::elastic(elastic_matrix<2>({1e9, 0.2}));
    const auto says_of = [](const FarField<2>& field, const char* text) {
      try {
        field.check();
      } catch (const InvalidInput& fault) {
        return std::string(fault.what()).find(text) != std::string::npos;
      }
      return false;
    };
    CHECK_NOTHROW(FarField<2>().check());
    CHECK_NOTHROW(elastic.check());
    CHECK(says_of(elastic.with(Side::top, Boundary::rollers), "contradict the ground surface"));
    CHECK(says_of(elastic.with(Side::bottom, Boundary::stress), "contradicts gravity"));
    const auto loose =
        FarField<2>().with(Side::left, Boundary::stress).with(Side::right, Boundary::stress);
    CHECK(says_of(loose, "free to slide"));
    CHECK(says_of(FarField<2>().with(Side::left, Boundary::elastic), "positive definite"));
    CHECK_THROWS_AS((void)elastic_matrix<2>({1e9, 0.5}), InvalidInput);
  }
}

}  // namespace ground_around_test
