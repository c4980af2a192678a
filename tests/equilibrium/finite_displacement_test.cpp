// SPDX-License-Identifier: MIT
// Equilibrium after displacements that are not small: contact updates during the search, by every
// method; and turning everything as a whole changes nothing.
#include <doctest/doctest.h>

#include <cmath>
#include <deque>
#include <memory>
#include <vector>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/lining/beams.hpp>
#include <voussoir/model/bolt_set.hpp>
#include <voussoir/model/bolt_spring.hpp>
#include <voussoir/model/contact_update.hpp>
#include <voussoir/model/lining_members.hpp>
#include <voussoir/model/system.hpp>
#include <voussoir/rockmass/domain.hpp>

#include "support/degree.hpp"
#include "support/near.hpp"

namespace finite_displacement_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

using Plane = System<Planar>;

constexpr double kn = 5e9, ks = 5e8, density = 2700, gravity = 9.81;

/// Blocks where they are given; the ground is body 0.
class Scene {
 public:
  explicit Scene(double friction_angle)
      : system(CoulombJoint({kn, ks, friction_angle}), kn, CoulombJoint({1, 1, 0}, any_units)) {}

  int block(Vec2 low, Vec2 high, bool movable, bool is_wall = false) {
    const ConvexPolygon shape = as_block(Domain<2>{low, high});
    const auto p = mass_properties(shape);
    const double weight = movable ? density * gravity * p.measure : 0;
    const double gyration = std::sqrt(p.second_moment(0, 0) / p.measure);
    rock_->blocks.push_back(shape);
    rock_->of_body.emplace_back(&rock_->blocks.back(), 1);
    measures.push_back(p.measure);
    return system.add_body({p.centroid, weight, gyration, movable, !is_wall});
  }
  /// Weights act along this direction instead of downwards.
  void finish(Vec2 down) {
    for (int b = 0; b < system.body_count(); ++b)
      system.load.segment<2>(3 * b) = system.body(b).weight * down;
    system.shapes = {rock_, &rock_->of_body};
    update_contacts(system, 0.02);
  }
  [[nodiscard]] SearchContext context(double displacement_limit,
                                      double contact_update_limit) const {
    SearchContext given;
    given.measures = &measures;
    given.acceptance.displacement_limit = displacement_limit;
    given.acceptance.contact_update_limit = contact_update_limit;
    given.acceptance.unbalance_over_weight = 1e-4;
    return given;
  }

  Plane system;
  std::vector<double> measures;

 private:
  struct Rock {
    std::deque<ConvexPolygon> blocks;
    Plane::Shapes of_body;
  };
  std::shared_ptr<Rock> rock_ = std::make_shared<Rock>();
};

}  // namespace

TEST_SUITE("equilibrium/finite_displacement") {
  TEST_CASE_TEMPLATE("a block slides to a stop and leans against it", Method, TwoLevel, Relaxation,
                     Explicit) {
    const double slope = 30 * degree, gap = 0.06;
    Scene scene(0);
    scene.block({-2, -1}, {4, 0}, false);
    const int b = scene.block({-0.5, 0}, {0.5, 0.2}, true);
    scene.block({0.5 + gap, 0}, {1.5, 0.2}, false);
    scene.finish({std::sin(slope), -std::cos(slope)});
    // Half a limit of contacts is more than what is left to the stop when it comes into reach.
    const auto report = Method{}.find(scene.system, scene.context(0.2, 0.01));
    INFO(report.reason);
    REQUIRE(report.verdict == Verdict::stable);
    CHECK(report.fallen.empty());
    // The block comes to rest where the stop's spring k_n h carries W sin a. Nothing rubs, so the
    // way there does not matter; the out-of-balance force of 1e-4 W leaves 2e-4 of the spring's
    // closure.
    const double weight = scene.system.body(b).weight;
    const double closure = weight * std::sin(slope) / (kn * 0.2);
    CHECK(std::abs(scene.system.displacement[3 * b] - gap - closure) <= 1e-3 * closure);
  }

  TEST_CASE_TEMPLATE("a column tips and leans against a wall", Method, TwoLevel, Relaxation,
                     Explicit) {
    for (const double gap : {0.11, 0.13, 0.15, 0.18}) {
      CAPTURE(gap);
      const double slope = 20 * degree, w = 0.2, h = 1, update_limit = 0.005;
      Scene scene(60 * degree);
      scene.block({-2, -1}, {4, 0}, false);
      const int b = scene.block({-0.5 * w, 0}, {0.5 * w, h}, true);
      const int wall = scene.block({0.5 * w + gap, 0.1}, {1.5, 2}, false, true);
      scene.finish({std::sin(slope), -std::cos(slope)});
      const auto report = Method{}.find(scene.system, scene.context(0.3, update_limit));
      INFO(report.reason);
      REQUIRE(report.verdict == Verdict::stable);
      // How far its foot slides as it falls is a matter of the way there. Where it ends is not: one
      // edge on the plane, one at the wall, driven in over a width that goes with the depth,
      // N = k_n d^2 / (2 tan theta).
      const Pose<2> at = scene.system.pose(b);
      const Vec2 foot = at(Vec2(0.5 * w, -0.5 * h)), top = at(Vec2(0.5 * w, 0.5 * h));
      CHECK(std::abs(foot.x() - 0.5 * w) <= 0.03);
      const double weight = scene.system.body(b).weight;
      const double tilt = std::atan((top.x() - foot.x()) / (top.y() - foot.y()));
      const auto depth_of = [&](double force) {
        return std::sqrt(2 * force * std::tan(tilt) / kn);
      };
      CHECK(-foot.y() == voussoir_test::near(depth_of(weight * std::cos(slope))).epsilon(0.02));
      const Vec2 arm = at.position - foot;
      const double expected =
          weight * (std::sin(slope) * arm.y() + std::cos(slope) * arm.x()) / (top.y() - foot.y());
      double push = 0;
      scene.system.boundary.visit(
          scene.system.displacement.data(),
          [&](const auto& c, const auto&, const auto&, const PointForce<2>& f) {
            if (c.a == wall || c.b == wall) push += f.normal;
          });
      // A wall that is met between two updates, by the top, which moves twice as far as the centre,
      // presses on no spring as far as it is overlapped then.
      double uncounted = 0;
      const auto& walls = scene.system.boundary;
      for (std::size_t n = 0; n < walls.contacts().size(); ++n)
        if (walls.contacts()[n].a == wall || walls.contacts()[n].b == wall)
          uncounted = walls.uncounted(n);
      CHECK(uncounted <= 2 * update_limit);
      CHECK(top.x() - (0.5 * w + gap) - uncounted ==
            voussoir_test::near(depth_of(push)).epsilon(0.02));
      // Forces act a third of these widths inside of the edges, 1.2 mm of 1 m under six times the
      // push, and arms are those of the last contact update, up to 2.5 mm ago.
      CHECK(std::abs(push - expected) <= 0.03 * expected);
    }
  }

  TEST_CASE("turned as a whole in small steps, nothing changes") {
    Scene scene(30 * degree);
    scene.block({-1, -1}, {1, 0}, true);
    scene.block({-1, 0}, {1, 1}, true);
    scene.finish({0, 0});
    Plane& system = scene.system;
    system.joints.set_initial([](const auto&, const Vec2&) {
      return Stress<2>{{1e6, 2e5}, {2e5, 1e6}};
    });
    auto bolts = std::make_shared<BoltSet<2, AxialBolt>>(
        AxialBolt({.axial_stiffness = 1e8, .pretension = 3e4}));
    BoltSpring<2, AxialBolt> bolt{};
    bolt.a = 0;
    bolt.b = 1;
    bolt.arm_a = {0.1, 0.3};
    bolt.arm_b = {0.2, -0.2};
    bolt.span.axis = Vec2(0.1, 0.5).normalized();
    bolt.span.initial = Vec2(0.1, 0.5);
    bolt.joint_a = bolt.joint_b = bolt.span.motion = Vec2::Zero();
    bolt.share = 1;
    bolts->add(bolt);
    system.supports.add(bolts);
    const auto node = [&](Vec2 at) { return system.add_body({at, 0, 1, true, false}); };
    const int i = node({1.2, -0.5}), j = node({1.3, 0.6});
    const Vec2 along = system.body(j).centre - system.body(i).centre;
    const FrameElement<Planar> member{
        i, j, along.norm(), frame_axes<2>(along, Vec2::Zero()),
        EulerBernoulliBeam::stiffness<3>(LiningSection::rectangular(0.1, 25e9), along.norm())};
    system.supports.add(std::make_shared<LiningMembers<Planar>>(std::vector{member}, i, 2));
    Eigen::VectorXd& u = system.displacement;
    // A strain besides, so that bolt and frame have forces: 1 mm of the upper block and node.
    u.segment<3>(3) = Vec<3>(2e-4, 1e-3, 1e-4);
    u.segment<3>(3 * j) = Vec<3>(-3e-4, 1e-3, 2e-3);
    update_contacts(system, 0.02);
    Eigen::VectorXd before, after;
    system.forces(u, before);
    REQUIRE(before.segment<3>(0).norm() > 1e5);
    REQUIRE(before.segment<3>(3 * i).norm() > 1e5);
    constexpr int steps = 50;
    const double step = 1.0 / steps;
    const Vec2 pivot(3, 4);
    const Rotation<2> turn = rotation_by(Spin<2>(step));
    for (int k = 0; k < steps; ++k) {
      for (int b = 0; b < system.body_count(); ++b) {
        const Vec2 at = system.pose(b).position;
        u.segment<2>(3 * b) += turn * (at - pivot) + pivot - at;
        u[3 * b + 2] += step;
      }
      update_contacts(system, 0.02);
    }
    system.forces(u, after);
    const Rotation<2> whole = rotation_by(Spin<2>(1.0));
    // Rotations and positions are exact; what is left is the rounding of 50 products, on springs
    // that turn 1e-15 m into 1e-5 N.
    for (int b = 0; b < system.body_count(); ++b) {
      CAPTURE(b);
      const Vec2 expected = whole * before.segment<2>(3 * b);
      CHECK((after.segment<2>(3 * b) - expected).norm() <= 1e-6 * before.norm());
      CHECK(std::abs(after[3 * b + 2] - before[3 * b + 2]) <= 1e-6 * before.norm());
    }
  }

  TEST_CASE("a system without shapes says so") {
    Plane system(CoulombJoint({kn, ks, 0.5}), kn, CoulombJoint({1, 1, 0}, any_units));
    system.add_body({Vec2::Zero(), 1, 1, true});
    CHECK_THROWS_WITH_AS(update_contacts(system, 0.02),
                         "update_contacts: the system does not know the shapes of its bodies",
                         InvalidInput);
  }
}

}  // namespace finite_displacement_test
