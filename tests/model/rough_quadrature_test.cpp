// SPDX-License-Identifier: MIT
// What two points (four in 3-D) on the pressed part of a rough joint miss of its force, moment and
// shear: against 20 000 fibres, each with the law to itself.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/model/contact_group.hpp>

#include "support/degree.hpp"

namespace rough_quadrature_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

/// The closure curve goes on beyond any stress of the test: K_ni V_m is 4 MPa. Without dilation,
/// which lifts every fibre by its own amount.
const BartonBandisJoint law({.roughness = 10,
                             .wall_strength = 100e6,
                             .residual_friction_angle = 28 * degree,
                             .initial_stiffness = 2e10,
                             .maximum_closure = 2e-4,
                             .largest_stress = 50e6,
                             .damage_coefficient = std::numeric_limits<double>::infinity()});
constexpr double closes = 2e-4, length = 2;
constexpr int fibre_count = 20000;

/// A joint 2 m long of body 1 on body 0, whose centres lie in its middle.
ContactGroup<Planar> line_joint() {
  ContactGroup<Planar> group({law});
  const Segment line{Vec2(1, 0), Vec2(-1, 0)};
  const auto points = line.gauss_points();
  group.add(0, 1, line, zeros<Vec2>(), zeros<Vec2>(), {points.begin(), points.end()});
  return group;
}
ContactGroup<Spatial> square_joint() {
  ContactGroup<Spatial> group({law});
  const SpatialFacet square{{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}};
  const auto points = square.gauss_points();
  group.add(0, 1, square, zeros<Vec3>(), zeros<Vec3>(), {points.begin(), points.end()});
  return group;
}

/// How a joint is pressed: deepest closure over V_m, and the part of its length that is pressed.
struct Pressed {
  double deepest, part;

  /// opening(x) = lift + turn x, deepest at x = -1 [m], [rad]
  [[nodiscard]] double turn() const { return deepest * closes / (part * length); }
  [[nodiscard]] double lift() const { return turn() * (0.5 * length - part * length); }
};

/// Errors of the two points over what 20 000 fibres bear [-].
struct Error {
  double force, moment, shear;
};
Error error_of(const Pressed& pressed, int steps) {
  auto group = line_joint();
  Eigen::VectorXd u = Eigen::VectorXd::Zero(6), f;
  u[4] = pressed.lift();
  u[5] = pressed.turn();
  std::vector<BartonBandisJoint::State<2>> states(fibre_count);
  Error error{};
  double normal = 0, moment = 0, shear = 0;
  for (int k = 0; k <= steps; ++k) {
    u[3] = steps > 0 ? 2 * law.peak_slip() * k / steps : 0.0;
    f = Eigen::VectorXd::Zero(6);
    group.add_forces<Frozen>(u.data(), f.data());
    normal = moment = shear = 0;
    for (int i = 0; i < fibre_count; ++i) {
      const double x = length * ((i + 0.5) / fibre_count - 0.5);
      PointLoad<2> load{.weight = length / fibre_count, .initial = {}, .motion = {}};
      load.motion.opening = u[4] + u[5] * x;
      load.motion.slip[0] = u[3];
      auto& state = states[static_cast<std::size_t>(i)];
      const PointForce<2> force = law.force(load, state);
      normal += force.normal;
      moment += force.normal * x;
      shear += std::abs(force.tangential[0]);
      if (steps > 0) (void)law.commit(load, state);
    }
    if (steps > 0) group.commit(u.data());
  }
  error.force = f[4] / normal - 1;
  error.moment = (f[5] - moment) / (0.5 * normal * length);
  error.shear = shear > 0 ? std::abs(f[3]) / shear - 1 : 0.0;
  return error;
}

/// A square of 2 m that is pressed up to a line across it at an angle. Errors of force and of the
/// larger of its moments over force times half its side.
Error square_error(const Pressed& pressed, double angle) {
  auto group = square_joint();
  const double c = std::cos(angle), s = std::sin(angle), reach = c + s;  // of a corner
  const double slope = pressed.deepest * closes / (2 * reach * pressed.part),
               lift = slope * reach * (1 - 2 * pressed.part);
  // opening = lift + slope (c x + s y): turned about y by -slope c, about x by slope s.
  Eigen::VectorXd u = Eigen::VectorXd::Zero(12), f = Eigen::VectorXd::Zero(12);
  u[8] = lift;
  u[9] = slope * s;
  u[10] = -slope * c;
  group.add_forces<Frozen>(u.data(), f.data());
  constexpr int side = 142;  // 20 164 fibres
  double normal = 0, about_x = 0, about_y = 0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double x = 2 * (i + 0.5) / side - 1, y = 2 * (j + 0.5) / side - 1;
      const double force = 4.0 / (side * side) * law.stress(-(lift + slope * (c * x + s * y)));
      normal += force;
      about_x += force * y;
      about_y -= force * x;
    }
  return {f[8] / normal - 1, std::hypot(f[9] - about_x, f[10] - about_y) / normal, 0};
}

}  // namespace

TEST_SUITE("model/rough_quadrature") {
  // Closure grows along the pressed part from 0 to r V_m, whatever its length and the turn. The
  // mean of sigma = K V / (1 - V / V_m) over it is -K V_m (1 + ln(1 - r) / r); the points lie at (1
  // -+ 1/sqrt(3)) / 2 of the way. The fibres have that mean to 1e-8.
  TEST_CASE("2-D: the force errs by a function of the deepest closure alone, to the soft side") {
    const auto expected = [](double r) {
      const auto at = [r](double part) { return part * r / (1 - part * r); };
      const double mean = -(1 + std::log1p(-r) / r);
      return 0.5 * (at(0.5 - std::sqrt(1.0 / 12)) + at(0.5 + std::sqrt(1.0 / 12))) / mean - 1;
    };
    struct Row {
      double deepest, force, moment, shear;  ///< the largest errors, as in docs/theory.md
    };
    for (const Row& row : {Row{0.2, 1.4e-4, 1.3e-3, 2e-3}, Row{0.5, 4.4e-3, 0.0131, 1.5e-3},
                           Row{0.7, 0.0235, 0.0437, 0.0154}, Row{0.9, 0.14, 0.171, 0.103}}) {
      CAPTURE(row.deepest);
      for (const double part : {0.05, 0.3, 0.7, 1.0}) {
        CAPTURE(part);
        const Error error = error_of({row.deepest, part}, 0);
        CHECK(std::abs(error.force - expected(row.deepest)) < 1e-5);
        CHECK(error.force < 0);
        CHECK(error.force > -row.force);
        CHECK(std::abs(error.moment) < row.moment);
      }
      // Of the shear at twice the peak slip.
      CHECK(std::abs(error_of({row.deepest, 0.3}, 4).shear) < row.shear);
    }
  }

  TEST_CASE("3-D: four points on the pressed part of a square") {
    struct Row {
      double deepest, soft, stiff, moment;
    };
    for (const Row& row : {Row{0.2, 1.2e-3, 5e-4, 8.5e-3}, Row{0.5, 0.0128, 2e-3, 0.0362},
                           Row{0.7, 0.0396, 6.1e-3, 0.0798}, Row{0.9, 0.124, 0.0098, 0.193}}) {
      CAPTURE(row.deepest);
      for (const double part : {0.1, 0.3, 0.5, 0.8, 1.0})
        for (const double angle : {0.0, 0.3, 0.7}) {
          CAPTURE(part);
          CAPTURE(angle);
          const Error error = square_error({row.deepest, part}, angle);
          CHECK(error.force > -row.soft);
          CHECK(error.force < row.stiff);
          CHECK(error.moment < row.moment);
        }
    }
  }
}

}  // namespace rough_quadrature_test
