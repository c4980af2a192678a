// SPDX-License-Identifier: MIT
// Rings of frame elements against the exact polygon solutions: the lining as it is really solved,
// with its real thickness. Where a reference holds for an inextensible ring, the part of the axial
// strain is known exactly and added in view.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/lining/beams.hpp>
#include <voussoir/lining/frame_element.hpp>

#include "support/dense_algebra.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace polygon_ring_test {

using namespace voussoir;
using voussoir_test::reference;

namespace {

constexpr double radius = 5, pi = std::numbers::pi;

/// A regular polygon of frame elements, anticlockwise, first node on the x axis.
template <class Beam>
struct Ring {
  explicit Ring(int count, const LiningSection& section) : nodes(count) {
    for (int k = 0; k < nodes; ++k) {
      const Vec2 a = position(k), b = position(k + 1);
      elements.push_back({k, (k + 1) % nodes, (b - a).norm(), frame_axes<2>(b - a, Vec2::Zero()),
                          Beam::template stiffness<3>(section, (b - a).norm())});
    }
  }
  [[nodiscard]] double angle(int k) const { return 2 * pi * k / nodes; }
  [[nodiscard]] Vec2 position(int k) const {
    return radius * Vec2(std::cos(angle(k)), std::sin(angle(k)));
  }
  [[nodiscard]] double chord() const { return 2 * radius * std::sin(pi / nodes); }

  /// Displacements under loads that balance each other: node 0 is clamped and feels no reaction.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& load) const {
    const Eigen::Index size = 3 * nodes;
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
    for (const auto& e : elements)
      e.add_stiffness([&](int i, int j, const auto& ii, const auto& ij, const auto& jj) {
        k.block<3, 3>(3 * i, 3 * i) += ii;
        k.block<3, 3>(3 * j, 3 * j) += jj;
        k.block<3, 3>(3 * i, 3 * j) += ij;
        k.block<3, 3>(3 * j, 3 * i) += ij.transpose();
      });
    Eigen::VectorXd u = Eigen::VectorXd::Zero(size);
    u.tail(size - 3) =
        voussoir_test::solve(k.bottomRightCorner(size - 3, size - 3), load.tail(size - 3));
    return u;
  }
  /// Radial loads `outward(angle)` at the nodes [N].
  template <class Load>
  [[nodiscard]] Eigen::VectorXd radial_load(Load&& outward) const {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * nodes);
    for (int k = 0; k < nodes; ++k)
      load.segment<2>(3 * k) = outward(angle(k)) * position(k) / radius;
    return load;
  }
  /// Thrust of the member after node k, compression positive.
  [[nodiscard]] double thrust(int k, const Eigen::VectorXd& u) const {
    return elements[static_cast<std::size_t>(k)].end_forces(u.data())[0];
  }
  /// Moment at node k, positive when the outer fibre is in tension. A member runs anticlockwise, so
  /// its left is inside; the moment on its start that bends it outwards is clockwise.
  [[nodiscard]] double moment(int k, const Eigen::VectorXd& u) const {
    return -elements[static_cast<std::size_t>(k)].end_forces(u.data())[2];
  }

  int nodes;
  std::vector<FrameElement<Planar>> elements;
};

LiningSection shotcrete() { return LiningSection::rectangular(0.1, 25e9, 0.2); }

/// Opposite inward loads P at nodes 0 and n/2.
template <class Beam>
Eigen::VectorXd pinch(const Ring<Beam>& ring, double force) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * ring.nodes);
  load[0] = -force;
  load[3 * (ring.nodes / 2)] = force;
  return load;
}

}  // namespace

TEST_SUITE("lining/polygon_ring") {
  TEST_CASE_TEMPLATE("two opposite point loads shorten a polygon by the chord integrals", Beam,
                     EulerBernoulliBeam, TimoshenkoBeam) {
    const LiningSection s = shotcrete();
    const double force = 1e4;
    for (const int n : {8, 16, 32, 64, 128}) {
      CAPTURE(n);
      const Ring<Beam> ring(n, s);
      const Eigen::VectorXd u = ring.solve(pinch(ring, force));
      const double shortening = u[3 * (n / 2)] - u[0];
      const std::string row = "D.pinch.polygon.n" + std::to_string(n);
      const double bending =
          reference(row + ".delta") * force * std::pow(radius, 3) / s.bending_stiffness;
      // Castigliano: chord k carries P/2 sin(theta_k) along and P/2 cos(theta_k) across, and the
      // sum of sin^2 over the n chords is n/2, so each of the two adds P n l / 8 over its
      // stiffness.
      const double axial = force * n * ring.chord() / (8 * s.axial_stiffness);
      const double shear = std::is_same_v<Beam, TimoshenkoBeam>
                               ? force * n * ring.chord() / (8 * s.shear_stiffness)
                               : 0.0;
      // 12 printed digits; the condition of the clamped ring (about 1e9 at n = 128) times 1e-16.
      CHECK(std::abs(shortening - (bending + axial + shear)) <= 1e-7 * bending);
    }
  }

  TEST_CASE("the moment under a point load is P R / (n tan(pi/n)), tension inside") {
    for (const int n : {8, 16, 32, 64, 128}) {
      CAPTURE(n);
      const Ring<EulerBernoulliBeam> ring(n, shotcrete());
      const double force = 1e4;
      const Eigen::VectorXd u = ring.solve(pinch(ring, force));
      const double expected =
          reference("D.pinch.polygon.n" + std::to_string(n) + ".M_load") * force * radius;
      CHECK(std::abs(ring.moment(n / 2, u) + expected) <= 1e-7 * expected);
      // 90 degrees away the outer fibre is in tension: M0 - P R / 2 of closed form d.4.
      if (n % 4 == 0)
        CHECK(std::abs(ring.moment(n / 4, u) - (0.5 * force * radius - expected)) <=
              1e-7 * expected);
    }
  }

  TEST_CASE("the polygon approaches the circle with the square of the number of its sides") {
    const LiningSection s = shotcrete();
    const double unit = std::pow(radius, 3) / s.bending_stiffness;
    const auto error = [&](int n) {
      const Ring<EulerBernoulliBeam> ring(n, s);
      const Eigen::VectorXd u = ring.solve(pinch(ring, 1.0));
      const double axial = n * ring.chord() / (8 * s.axial_stiffness);
      return reference("D.pinch.delta") - (u[3 * (n / 2)] - u[0] - axial) / unit;
    };
    // The next term of the error is smaller by (pi/n)^2, 1 % at n = 32.
    CHECK(error(32) / error(64) == voussoir_test::near(4).epsilon(0.01));
  }

  TEST_CASE("a uniform pressure at the nodes gives thrust alone") {
    const int n = 32;
    const double pressure = 1e5;
    const Ring<EulerBernoulliBeam> ring(n, shotcrete());
    const Eigen::VectorXd u =
        ring.solve(ring.radial_load([&](double) { return -pressure * 2 * pi * radius / n; }));
    const double thrust = reference("D.uniform.nodal.N");
    for (int k = 0; k < n; ++k) {
      CHECK(std::abs(ring.thrust(k, u) - thrust) <= 1e-9 * thrust);
      // Zero by symmetry: the rounding of u (1e-3 m, condition 1e7) times E I / l^2.
      CHECK(std::abs(ring.moment(k, u) - reference("D.uniform.nodal.M")) <=
            1e-9 * thrust * ring.chord());
    }
    // Node 0 is held, so the node opposite moves towards it by twice the inward displacement.
    const double inward = 0.5 * (u[3 * (n / 2)] - u[0]);
    const double expected = reference("D.uniform.nodal.u");
    CHECK(std::abs(inward - expected) <= 1e-9 * expected);
  }

  TEST_CASE("harmonic loads at the nodes give the circle's moment times the polygon factor") {
    const double pressure = 1e5;
    const std::vector<std::pair<int, std::vector<int>>> cases = {
        {8, {2, 3}}, {16, {2, 3, 4}}, {32, {2, 3, 4}}, {64, {2, 3, 4}}, {128, {2, 3, 4}}};
    for (const auto& of : cases) {
      const int n = of.first;  // clang++ 14 captures no structured binding
      const Ring<EulerBernoulliBeam> ring(n, shotcrete());
      for (const int m : of.second) {
        CAPTURE(n);
        CAPTURE(m);
        // Outward where cos(m theta) > 0: there the ring bulges and the outer fibre is in tension.
        const Eigen::VectorXd u = ring.solve(ring.radial_load(
            [&](double angle) { return pressure * std::cos(m * angle) * 2 * pi * radius / n; }));
        const double factor = reference("D.harm.n" + std::to_string(n) + ".m" + std::to_string(m));
        const double circle = pressure * radius * radius / (m * m - 1);
        // The moments follow from equilibrium alone: axial strain does not touch them.
        for (const int k : {0, n / 8, n / 2})
          CHECK(std::abs(ring.moment(k, u) - factor * circle * std::cos(m * ring.angle(k))) <=
                1e-7 * circle);
      }
    }
  }

  TEST_CASE("the forces of a deformed ring balance each other, in sum and in moment") {
    const int n = 24;
    const Ring<TimoshenkoBeam> ring(n, shotcrete());
    Eigen::VectorXd u(3 * n);
    for (Eigen::Index k = 0; k < u.size(); ++k)
      u[k] = 1e-3 * std::sin(1.0 + 7.3 * static_cast<double>(k));
    Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * n);
    for (const auto& e : ring.elements) e.add_force(u.data(), f.data());
    Vec2 sum = Vec2::Zero();
    double moment = 0;
    for (int k = 0; k < n; ++k) {
      sum += f.segment<2>(3 * k);
      moment += f[3 * k + 2] + cross(ring.position(k), Vec2(f.segment<2>(3 * k)));
    }
    CHECK(f.norm() > 1e3);  // there is something to balance
    CHECK(sum.norm() <= 1e-14 * f.norm());
    CHECK(std::abs(moment) <= 1e-14 * radius * f.norm());
  }
}

}  // namespace polygon_ring_test
