// SPDX-License-Identifier: MIT
// A wedge on two planes in rock under stress that is laid bare: it stands down to the limit load of
// the static theorem, far below the closed form of sliding without shear across the way.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/design/limit_load.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/model/system.hpp>

#include "support/degree.hpp"
#include "support/near.hpp"

namespace stressed_wedge_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::near;

namespace {

/// A prism in a trough of two planes, 1 m long, its edges 1 m up both.
struct Trough {
  double plunge;  ///< psi, of the line of intersection [degrees]
  double open;    ///< eta, between each plane and the vertical plane through that line [degrees]

  /// tan(phi) = tan(psi) sin(eta): no shear across the way.
  [[nodiscard]] double sliding() const {
    return std::atan(std::tan(plunge * degree) * std::sin(open * degree));
  }
  /// The least friction for which there are forces in balance. Shear Q across the way on each plane
  /// presses the wedge into the trough. Of a plane, w = W cos(psi) / 2:
  ///   N = (w + Q cos(eta)) / sin(eta),  S = w tan(psi),  S^2 + Q^2 <= N^2 tan^2(phi).
  /// N^2 tan^2(phi) - Q^2 is largest at Q = w tan^2(phi) cos(eta) / (sin^2(eta) - tan^2(phi)
  /// cos^2(eta)), where that is S^2 if
  ///   tan(phi) = tan(psi) sin(eta) / sqrt(1 + tan^2(psi) cos^2(eta)) < tan(eta).
  [[nodiscard]] double least() const {
    const double t = std::tan(plunge * degree), s = std::sin(open * degree),
                 c = std::cos(open * degree);
    return std::atan(t * s / std::sqrt(1 + t * t * c * c));
  }

  [[nodiscard]] double weight() const { return 26e3 * 0.5 * std::sin(2 * open * degree); }
  [[nodiscard]] Rotation<3> dip() const { return rotation_by(Spin<3>(0, plunge * degree, 0)); }
  [[nodiscard]] Vec3 centre() const { return dip() * Vec3(0, 0, 2 * std::cos(open * degree) / 3); }
  /// Their areas point out of the wedge.
  [[nodiscard]] std::vector<SpatialFacet> planes() const {
    std::vector<SpatialFacet> made;
    for (const double side : {-1.0, 1.0}) {
      const Vec3 up(0, side * std::sin(open * degree), std::cos(open * degree)), half(0.5, 0, 0);
      std::vector<Vec3> corners;
      for (const Vec3& p : {Vec3(-half), half, Vec3(half + up), Vec3(up - half)})
        corners.push_back(dip() * p);
      if (side > 0) std::reverse(corners.begin(), corners.end());
      made.push_back({corners});
      if (made.back().area_vector().dot(made.back().centre() - centre()) < 0) {
        std::reverse(corners.begin(), corners.end());
        made.back() = {corners};
      }
    }
    return made;
  }

  /// Between two walls that do not give way, under in-situ stress; the stage takes away what the
  /// rock over the wedge and at its ends has pressed it with.
  /// @param vertical  [Pa]
  [[nodiscard]] System<Spatial> system(double friction, double vertical, double k0) const {
    System<Spatial> made(CoulombJoint({1e9, 1e9, friction}), 1, CoulombJoint({1, 1, 0}, any_units));
    const std::vector<SpatialFacet> faces = planes();
    for (const SpatialFacet& face : faces) made.add_body({3 * face.centre(), 1, 1, false});
    const int block = made.add_body({centre(), weight(), 0.3, true});
    for (int k = 0; k < 2; ++k) {
      const SpatialFacet& face = faces[static_cast<std::size_t>(k)];
      made.joints.add(block, k, face, made.body(block).centre, made.body(k).centre,
                      face.gauss_points());
    }
    Stress<3> stress = Stress<3>::Zero();
    stress(0, 0) = stress(1, 1) = k0 * vertical;
    stress(2, 2) = vertical;
    if (vertical > 0) made.joints.set_initial([&](const auto&, const Vec3&) { return stress; });
    made.load[6 * block + 2] = -weight();
    made.wall_fraction = 0;
    Eigen::VectorXd pressed;
    made.forces(made.displacement, pressed);
    for (int k = 0; k < 6; ++k) made.wall_load[6 * block + k] = -pressed[6 * block + k];
    made.wall_fraction = 1;
    return made;
  }
  [[nodiscard]] design::LimitProblem<3> rigid() const {
    design::LimitProblem<3> problem;
    const Load<3> pull{Vec3(0, 0, -weight())};
    problem.blocks = {{centre(), 1, 1, {}, false},
                      {centre(), 1, 1, {}, false},
                      {centre(), weight(), 0.3, pull, true}};
    const std::vector<SpatialFacet> faces = planes();
    for (int k = 0; k < 2; ++k) {
      const SpatialFacet& face = faces[static_cast<std::size_t>(k)];
      problem.add_contact(2, k, face.vertices, face.area_vector().normalized(), {1, 0, 0});
    }
    return problem;
  }
};

enum class Outcome { stands, falls, undecided };

template <class Method>
Outcome outcome(const Trough& trough, double friction, double vertical, double k0) {
  auto system = trough.system(friction, vertical, k0);
  SearchContext context;
  context.acceptance.unbalance_over_weight = 1e-4;
  context.wall_fraction = 0;
  const EquilibriumReport report = Method{}.find(system, context);
  if (report.verdict != Verdict::stable) return Outcome::undecided;
  return report.fallen.empty() ? Outcome::stands : Outcome::falls;
}

const std::vector<Trough> troughs{{40, 45}, {50, 60}, {60, 35}, {70, 40}};

}  // namespace

TEST_SUITE("design/stressed_wedge") {
  TEST_CASE("limit analysis gives the closed form with shear across the way") {
    for (const Trough& trough : troughs) {
      CAPTURE(trough.plunge);
      // Of tan(phi) = 1: what it may be divided by.
      const design::LimitBound bound = design::limit_load(trough.rigid(), {.width = 1e-4});
      REQUIRE(bound.is_closed());
      CHECK(1 / bound.holds == near(std::tan(trough.least())).epsilon(2e-4));
      CHECK(1 / bound.fails == near(std::tan(trough.least())).epsilon(2e-4));
      CHECK(trough.least() < trough.sliding() - 3 * degree);
    }
  }

  TEST_CASE_TEMPLATE_DEFINE("it falls below that, and above it stands by the stress it had", Method,
                            stressed) {
    // Rock that is unloaded by and by keeps its shear across the way. `Relaxation` lets it go at
    // once: on its way a wedge in a blunt trough turns that shear into its way, and slides.
    constexpr bool is_gradual = !std::is_same_v<Method, Relaxation>;
    for (const Trough& trough : troughs) {
      CAPTURE(trough.plunge);
      const double least = trough.least(), slides = trough.sliding();
      const bool is_steep = trough.plunge >= 60;
      const double stands_from = is_gradual ? least + 0.4 * degree
                                 : is_steep ? least + 5 * degree
                                            : slides + 0.5 * degree;
      for (const double k0 : {0.5, 1.0}) {
        CAPTURE(k0);
        // 1e-4 of its weight that may be out of balance are less than 0.01 degrees.
        CHECK(outcome<Method>(trough, least - 0.1 * degree, 1e6, k0) == Outcome::falls);
        CHECK(outcome<Method>(trough, stands_from, 1e6, k0) == Outcome::stands);
      }
      // One that comes to bear its weight from nothing has no such shear: it slides.
      CHECK(outcome<Method>(trough, slides - 0.1 * degree, 0, 1) != Outcome::stands);
      CHECK(outcome<Method>(trough, slides + 0.1 * degree, 0, 1) == Outcome::stands);
    }
  }
  TEST_CASE_TEMPLATE_APPLY(stressed, std::tuple<TwoLevel, Relaxation, Explicit>);
}

}  // namespace stressed_wedge_test
