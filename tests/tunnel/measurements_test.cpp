// SPDX-License-Identifier: MIT
// Signs and weights of what is measured, on systems made by hand.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/model/system.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "support/dense_algebra.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace measurements_test {

using namespace voussoir;
using voussoir_test::reference;

namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180, radius = 5;
constexpr int count = 32;
constexpr double half = pi / count;  // half the angle of a chord

/// A ring of frame elements alone, in the place of a solver: what the measurements ask of one.
struct RingAlone {
  static constexpr int dim = 2;
  using SystemType = System<Planar>;
  using LiningType = LiningMembers<Planar>;

  explicit RingAlone(const LiningSection& given) : section(given) {
    for (int k = 0; k < count; ++k) bodies.add_body({position(k), 0, 1, true});
    std::vector<FrameElement<Planar>> members;
    for (int k = 0; k < count; ++k) {
      const Vec2 a = position(k), b = position(k + 1);
      members.push_back({k, (k + 1) % count, (b - a).norm(), frame_axes<2>(b - a, Vec2::Zero()),
                         EulerBernoulliBeam::stiffness<3>(section, (b - a).norm())});
    }
    bodies.supports.add(std::make_shared<LiningMembers<Planar>>(members, 0, count));
  }
  [[nodiscard]] static double angle(int k) { return 2 * pi * k / count; }
  [[nodiscard]] static Vec2 position(int k) {
    return radius * Vec2(std::cos(angle(k)), std::sin(angle(k)));
  }
  [[nodiscard]] const SystemType& system() const { return bodies; }
  [[nodiscard]] const LiningMembers<Planar>* lining() const {
    return bodies.supports.first<LiningMembers<Planar>>();
  }
  [[nodiscard]] std::vector<const LiningMembers<Planar>*> linings() const { return {lining()}; }
  [[nodiscard]] const BoltSet<2, AxialBolt>* bolts() const { return nullptr; }
  [[nodiscard]] int bolt_count() const { return 0; }
  [[nodiscard]] Vec2 displacement_of(int body, const Vec2& point) const {
    return displacement_at<2>(bodies.displacement.data() + 3 * body,
                              Vec2(point - bodies.body(body).centre));
  }
  /// Deforms the ring by these radial loads, outwards positive, that balance each other: node 0 is
  /// held and feels no reaction. Distances between nodes then mean something, single ones do not.
  template <class Load>
  void load_radially(Load&& outward) {
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(3 * count, 3 * count);
    for (const auto& e : lining()->members())
      e.add_stiffness([&](int i, int j, const auto& ii, const auto& ij, const auto& jj) {
        k.block<3, 3>(3 * i, 3 * i) += ii;
        k.block<3, 3>(3 * j, 3 * j) += jj;
        k.block<3, 3>(3 * i, 3 * j) += ij;
        k.block<3, 3>(3 * j, 3 * i) += ij.transpose();
      });
    Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * count);
    for (int n = 0; n < count; ++n) load.segment<2>(3 * n) = outward(n) * position(n).normalized();
    constexpr Eigen::Index free = 3 * (count - 1);
    bodies.displacement.tail(free) =
        voussoir_test::solve(k.bottomRightCorner(free, free), load.tail(free));
  }

  LiningSection section;
  SystemType bodies{CoulombJoint({1, 1, 0}, any_units), 1, CoulombJoint({1, 1, 0}, any_units)};
};

LiningSection shotcrete() { return LiningSection::rectangular(0.1, 25e9); }

}  // namespace

TEST_SUITE("tunnel/measurements") {
  TEST_CASE("a pinched ring: thrust is compression, moment is positive with tension outside") {
    RingAlone ring(shotcrete());
    const double force = 1e4;
    ring.load_radially([&](int k) { return k == 0 || k == count / 2 ? -force : 0.0; });
    const std::vector<LiningForce> at = lining_forces(ring);
    REQUIRE(at.size() == count);
    // Under the load the ring sags inwards: tension inside, P R / (n tan(pi/n)).
    const double under = reference("D.pinch.polygon.n32.M_load") * force * radius;
    const double beside = 0.5 * force * radius - under;
    const double tolerance = 1e-8 * under;  // the condition of the ring, about 1e7, times 1e-16
    for (const std::size_t k : {std::size_t{0}, std::size_t{count / 2}}) {
      CHECK(std::abs(at[k].moment + under) <= tolerance);
      // The two chords there carry P/2 sin(half) each.
      CHECK(std::abs(at[k].thrust - 0.5 * force * std::sin(half)) <= 1e-8 * force);
      CHECK(std::abs(at[k].shear) <= 1e-8 * force);  // equal and opposite on the two sides
      CHECK(std::abs(at[k].largest_shear - 0.5 * force * std::cos(half)) <= 1e-8 * force);
    }
    for (const std::size_t k : {std::size_t{count / 4}, std::size_t{3 * count / 4}}) {
      CHECK(std::abs(at[k].moment - beside) <= tolerance);
      CHECK(std::abs(at[k].thrust - 0.5 * force * std::cos(half)) <= 1e-8 * force);
      CHECK(at[k].convergence < 0);  // bulges outwards
    }
    CHECK(at[count / 2].convergence > 0);
    const double pinch = at[0].convergence + at[count / 2].convergence;
    const double chord = 2 * radius * std::sin(half);
    const double expected = reference("D.pinch.polygon.n32.delta") * force * std::pow(radius, 3) /
                                ring.section.bending_stiffness +
                            force * count * chord / (8 * ring.section.axial_stiffness);
    CHECK(std::abs(pinch - expected) <= 1e-8 * expected);
    // Shear of a chord is the slope of the moment along it; a node shows the mean of its two
    // chords.
    for (std::size_t k = 1; k + 1 < count; ++k) {
      const double slope = (at[k + 1].moment - at[k - 1].moment) / (2 * chord);
      CHECK(std::abs(std::abs(at[k].shear) - std::abs(slope)) <= 1e-8 * force);
    }
    for (std::size_t k = 0; k < count; ++k)
      CHECK((at[k].position - RingAlone::position(static_cast<int>(k))).norm() == 0);
    // The largest moment is the one under the load, whatever its sign.
    REQUIRE(under > beside);
    CHECK(std::abs(support_demand(ring).largest_moment - under) <= tolerance);
  }

  TEST_CASE("a ring squeezed from all sides: thrust positive everywhere, no moment") {
    RingAlone ring(shotcrete());
    const double pressure = 1e5;
    ring.load_radially([&](int) { return -pressure * 2 * pi * radius / count; });
    const double thrust = reference("D.uniform.nodal.N"), inward = reference("D.uniform.nodal.u");
    const auto all = lining_forces(ring);
    for (std::size_t k = 0; k < count; ++k) {
      CHECK(std::abs(all[k].thrust - thrust) <= 1e-9 * thrust);
      CHECK(std::abs(all[k].moment) <= 1e-9 * thrust * radius);
      const double diameter = all[k].convergence + all[(k + count / 2) % count].convergence;
      CHECK(std::abs(diameter - 2 * inward) <= 1e-9 * inward);
    }
  }

  TEST_CASE("rock that moves in evenly squeezes the ring through its interface") {
    // Nodes on the middles of the facets of a polygon with vertices on the wall; each touches one
    // fixed block of rock that has come in by u0. Facet l, nodes on R cos(pi/n):
    //   P = K_L l (u0 - u),  N = P / (2 sin(pi/n)),  u = N R cos(pi/n) / (E A)
    const double modulus = 1e9, came_in = 2e-3;
    const LiningSection section = shotcrete();
    System<Planar> system(CoulombJoint({1, 1, 0}, any_units), 1,
                          CoulombJoint({modulus, modulus, 30 * degree}));
    const auto vertex = [](int k) { return RingAlone::position(k); };
    for (int k = 0; k < count; ++k)
      system.add_body({0.5 * (vertex(k) + vertex(k + 1)), 0, 1, true});
    for (int k = 0; k < count; ++k) system.add_body({1.2 * system.body(k).centre, 0, 1, false});
    std::vector<FrameElement<Planar>> members;
    for (int k = 0; k < count; ++k) {
      const Vec2 a = system.body(k).centre, b = system.body((k + 1) % count).centre;
      members.push_back({k, (k + 1) % count, (b - a).norm(), frame_axes<2>(b - a, Vec2::Zero()),
                         EulerBernoulliBeam::stiffness<3>(section, (b - a).norm())});
      const Segment facet{vertex(k), vertex(k + 1)};
      const FacetPoint<2> point{Vec2::Zero(), facet.length()};
      system.interface.add(k, count + k, facet, a, system.body(count + k).centre, {&point, 1});
      system.displacement.segment<2>(3 * (count + k)) = -came_in * a.normalized();
    }
    system.supports.add(std::make_shared<LiningMembers<Planar>>(members, 0, count));
    Eigen::VectorXd f;
    system.forces(system.displacement, f);
    BlockCholesky<3>(system.elastic_stiffness()).solve_in_place(f);
    system.displacement += f;
    system.forces(system.displacement, f);
    CHECK(f.norm() <= 1e-6 * modulus * came_in);  // linear: one solve is exact
    const double facet = 2 * radius * std::sin(half), stiffness = modulus * facet;
    const double thrust_per_force = 1 / (2 * std::sin(half));
    const double give = thrust_per_force * radius * std::cos(half) / section.axial_stiffness;
    const double force = stiffness * came_in / (1 + stiffness * give);
    for (const auto& frame : members) {
      const auto ends = frame.end_forces(system.displacement.data());
      CHECK(std::abs(ends[0] - thrust_per_force * force) <= 1e-9 * thrust_per_force * force);
      CHECK(std::abs(ends[2]) <= 1e-8 * force);
    }
  }

  TEST_CASE("convergence is the middle fifth within 12 degrees, each piece with its length") {
    const double up = 90 * degree;
    // 0.1 m of a loose corner do not count against 1 m of wall, nor does what lies further away.
    std::vector<WallMotion> wall = {{up - 0.1, 0.1, 50e-3},
                                    {up, 0.6, 2e-3},
                                    {up + 0.05, 0.3, 3e-3},
                                    {up + 13 * degree, 9.0, -1.0},
                                    {up - 13 * degree, 9.0, 1.0}};
    // 0.6 of 1 m converge by 2 mm or less: all of what lies between 0.4 and 0.6 m.
    CHECK(convergence_at(wall, up) == voussoir_test::near(2e-3));
    // 0.5 of 1 m by 2 mm, 0.4 by 3 mm: a half of what lies between is the one, a half the other.
    wall[1].length = 0.5;
    wall[2].length = 0.4;
    CHECK(convergence_at(wall, up) == voussoir_test::near(2.5e-3));
    // Two halves give their mean, whichever is the longer by a rounding.
    const double round = 1e-16;
    for (const double less : {-round, 0.0, round}) {
      const std::vector<WallMotion> halves = {{up - 0.05, 0.2 - less, 1e-3},
                                              {up + 0.05, 0.2, 3e-3}};
      CHECK(convergence_at(halves, up) == voussoir_test::near(2e-3));
    }
    CHECK(convergence_at(wall, up + 13 * degree, 2 * degree) == voussoir_test::near(-1.0));
  }

  TEST_CASE("the window reaches across the right-hand springing") {
    const std::vector<WallMotion> wall = {{2 * pi - 0.1, 1, 1e-3}, {0.1, 1, 2e-3}, {0.15, 1, 3e-3}};
    CHECK(convergence_at(wall, 0.0) == 2e-3);
    CHECK(convergence_at(wall, 2 * pi) == 2e-3);
    CHECK(convergence_at(wall, -4 * pi) == 2e-3);
  }

  TEST_CASE("where no wall is left there is no convergence") {
    CHECK(std::isnan(convergence_at({}, 0.0)));
    CHECK(std::isnan(convergence_at({{pi, 1, 1e-3}}, 0.0)));
  }
}

}  // namespace measurements_test
