// SPDX-License-Identifier: MIT
// A member whose material gets stiffer: what it carries stays, what comes meets the new stiffness.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/lining/beams.hpp>
#include <voussoir/lining/frame_element.hpp>

#include "support/near.hpp"

namespace ageing_element_test {
namespace {

using namespace voussoir;

template <class Geometry>
FrameElement<Geometry> element() {
  constexpr int dim = Geometry::dim, dof = Geometry::dof;
  Vec<dim> along = zeros<Vec<dim>>(), outward = zeros<Vec<dim>>();
  along[0] = 2;
  outward[1] = 1;
  return {0, 1, 2.0, frame_axes<dim>(along, outward),
          TimoshenkoBeam::stiffness<dof>(LiningSection::strip(0.2, 1, 25e9), 2.0)};
}

/// A displacement of both ends, and where their nodes are then. Turns about the first axis and out
/// of the plane are left out: they are the same thing in other axes.
template <class Geometry>
struct Motion {
  static constexpr int dim = Geometry::dim, dof = Geometry::dof;
  std::vector<double> u = std::vector<double>(2 * dof, 0.0);
  Pose<dim> a, b;

  Motion(double stretch, double turn) {
    u[dof] = stretch;
    u[static_cast<std::size_t>(dof + dof - 1)] = turn;
    b.position[0] = 2 + stretch;
    Spin<dim> spin = zeros<Spin<dim>>();
    spin[spin_count<dim> - 1] = turn;
    b.rotation = rotation_by(spin);
  }
};

}  // namespace

TEST_SUITE("lining/ageing_element") {
  TEST_CASE_TEMPLATE("N = E1 e1 + E2 (e2 - e1), M alike, by displacements and by poses", Geometry,
                     Planar, Spatial) {
    constexpr int dof = Geometry::dof;
    FrameElement<Geometry> aged = element<Geometry>();
    const FrameElement<Geometry> young = aged;
    const Motion<Geometry> first(-1e-5, 2e-6), second(-3e-5, 5e-6);
    const auto before = young.end_forces(first.u.data());
    aged.stiffen(3, first.a, first.b, first.u.data());
    // Nothing has moved. Poses know turns to their square, 1e-12 of 1e-6.
    const auto close = [](const auto& one, const auto& other, double size) {
      return (one - other).norm() < 1e-9 * size;
    };
    const double size = before.norm();
    CHECK(close(aged.end_forces(first.u.data()), before, size));
    CHECK((aged.end_forces(first.a, first.b) - young.end_forces(first.a, first.b)).norm() <
          1e-9 * size);
    // E A = 5e9 N over 2 m: 25 kN from the first motion, 3 x 50 kN from what is added.
    CHECK(aged.end_forces(second.u.data())[dof] == voussoir_test::near(-175e3).epsilon(1e-9));
    CHECK(aged.end_forces(second.a, second.b)[dof] == voussoir_test::near(-175e3).epsilon(1e-6));
    const auto later = young.end_forces(second.u.data());
    CHECK(close(aged.end_forces(second.u.data()), before + 3 * (later - before), later.norm()));
    CHECK((aged.end_forces(second.a, second.b) - before - 3 * (later - before)).norm() <
          1e-5 * later.norm());
    // Turned along with its nodes it keeps them.
    FrameElement<Geometry> followed = aged;
    followed.follow(second.a, second.b, second.u.data());
    CHECK(close(followed.end_forces(second.u.data()), aged.end_forces(second.a, second.b),
                later.norm()));
  }
}

}  // namespace ageing_element_test
