// SPDX-License-Identifier: MIT
// A support answers the search for equilibrium and the time stepper from one state. Here both are
// asked the same: bodies displaced by little, once as small displacements, once as poses.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>
#include <voussoir/model/support.hpp>
#include <voussoir/voussoir.hpp>

using namespace voussoir;

namespace {

constexpr int bodies = 4;

template <int Dim>
Vec<Dim> centre(int b) {
  Vec<Dim> c = Vec<Dim>::Zero();
  c[0] = 1.1 * b;
  c[1] = 0.3 * b * b;
  return c;
}

template <int Dim>
double random_part(std::mt19937& random) {
  return std::uniform_real_distribution<double>(-1, 1)(random);
}

template <int Dim>
Vec<Dim> random_vector(std::mt19937& random) {
  Vec<Dim> v;
  for (int k = 0; k < Dim; ++k) v[k] = random_part<Dim>(random);
  return v;
}

template <int Dim, class Law>
std::shared_ptr<BoltSet<Dim, Law>> random_bolts(const Law& law, std::mt19937& random) {
  auto bolts = std::make_shared<BoltSet<Dim, Law>>(law);
  for (int b = 0; b + 1 < bodies; ++b) {
    const Vec<Dim> joint = 0.5 * (centre<Dim>(b) + centre<Dim>(b + 1));
    const Vec<Dim> axis = random_vector<Dim>(random).normalized();
    typename BoltSet<Dim, Law>::Spring s;
    s.a = b;
    s.b = b + 1;
    s.joint_a = joint - centre<Dim>(b);
    s.joint_b = joint - centre<Dim>(b + 1);
    s.arm_a = s.joint_a - 0.2 * axis;
    s.arm_b = s.joint_b + 0.3 * axis;
    s.span = {0.5 * axis, axis, Vec<Dim>::Zero()};
    s.share = 0.7;
    bolts->add(s);
  }
  return bolts;
}

template <class Geometry>
std::shared_ptr<LiningMembers<Geometry>> members() {
  constexpr int dim = Geometry::dim, dof = Geometry::dof;
  std::vector<FrameElement<Geometry>> all;
  LiningSection section = LiningSection::rectangular(0.2, 25e9);
  for (int b = 0; b + 1 < bodies; ++b) {
    const Vec<dim> along = centre<dim>(b + 1) - centre<dim>(b);
    Vec<dim> outward = Vec<dim>::Zero();
    outward[dim - 1] = 1;
    if constexpr (dim == 2)
      all.push_back({b, b + 1, along.norm(), frame_axes<2>(along, Vec2::Zero()),
                     EulerBernoulliBeam::stiffness<dof>(section, along.norm())});
    else
      all.push_back({b, b + 1, along.norm(), frame_axes<3>(along, outward),
                     EulerBernoulliBeam::stiffness<dof>(section, along.norm())});
  }
  return std::make_shared<LiningMembers<Geometry>>(all, 0, bodies);
}

/// Largest difference between the forces on bodies at rest and in motion, over the largest force.
template <int Dim>
double disagreement(Support<Dim>& support, double size, unsigned seed) {
  constexpr int dof = Dim + spin_count<Dim>;
  std::mt19937 random(seed);
  Eigen::VectorXd u(dof * bodies), f = Eigen::VectorXd::Zero(dof * bodies);
  for (Eigen::Index k = 0; k < u.size(); ++k) u[k] = size * random_part<Dim>(random);
  std::vector<MovingBody<Dim>> at(bodies);
  for (int b = 0; b < bodies; ++b) {
    auto& body = at[static_cast<std::size_t>(b)];
    body.mass = 1;
    body.pose.position = centre<Dim>(b) + part<Dim>(u, dof * b);
    body.pose.rotation = rotation_by(Spin<Dim>(part<dof - Dim>(u, dof * b + Dim)));
  }
  support.add_forces(u.data(), f.data(), nullptr);
  std::vector<Load<Dim>> loads(bodies);
  support.act(at, loads);
  double most = 0, apart = 0;
  for (int b = 0; b < bodies; ++b) {
    const Load<Dim>& load = loads[static_cast<std::size_t>(b)];
    const Fixed<dof, 1> moving = stacked(load.force, load.moment), resting = part<dof>(f, dof * b);
    most = std::max(most, resting.norm());
    apart = std::max(apart, (moving - resting).norm());
  }
  return apart / most;
}

/// The difference is the geometric one, of second order: over forces of first order it shrinks with
/// the size. (A support that treats the two alike only by chance of signs would keep its share.)
template <int Dim>
void check_agreement(Support<Dim>& support) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    // Of lengths of a metre and spans of half a metre, displaced by size: some size / 0.5 m.
    CHECK(disagreement(support, 1e-4, seed) <= 30 * 1e-4);
    CHECK(disagreement(support, 1e-6, seed) <= 30 * 1e-6);
  }
}

}  // namespace

TEST_SUITE("model/support") {
  TEST_CASE_TEMPLATE("bolts pull the same at rest and in motion", Geometry, Planar, Spatial) {
    constexpr int dim = Geometry::dim;
    std::mt19937 random(7);
    const AxialBolt::Params axial{.axial_stiffness = 2e8, .carries_compression = true};
    check_agreement<dim>(*random_bolts<dim>(AxialBolt(axial), random));
    check_agreement<dim>(
        *random_bolts<dim>(AxialShearBolt({.axial = axial, .shear_stiffness = 3e8}), random));
  }

  TEST_CASE_TEMPLATE("and so do the members of a lining", Geometry, Planar, Spatial) {
    check_agreement<Geometry::dim>(*members<Geometry>());
  }

  TEST_CASE("a copy of a set has a history of its own, and gives it back") {
    std::mt19937 random(3);
    SupportSet<2> supports;
    supports.add(
        random_bolts<2>(AxialBolt({.axial_stiffness = 2e8, .rupture_force = 1e5}), random));
    const SupportSet<2> kept = supports;
    const auto* const bolts = supports.first<BoltSet<2, AxialBolt>>();
    Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * bodies);
    for (int b = 0; b < bodies; ++b) u.segment<2>(3 * b) = 0.1 * b * Vec2(1, 1);
    for (const auto& support : supports) CHECK(support->commit(u.data(), nullptr) > 0);
    CHECK(supports.broken_count() > 0);
    CHECK(kept.broken_count() == 0);
    supports.restore(kept);
    CHECK(supports.broken_count() == 0);
    CHECK(supports.first<BoltSet<2, AxialBolt>>() == bolts);  // the same object
  }
}
