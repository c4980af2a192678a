// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/lining/beams.hpp>
#include <voussoir/model/bolt_set.hpp>
#include <voussoir/model/lining_members.hpp>
#include <voussoir/model/system.hpp>

#include "linear/dense_matrix.hpp"
#include "support/dense_algebra.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace system_test {

using namespace voussoir;
using voussoir_test::dense;
using voussoir_test::reference;

namespace {

constexpr double degree = std::numbers::pi / 180;

using PlaneSystem = System<Planar>;

Stress<2> turn_by(double angle) {
  Stress<2> turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return turn;
}

/// A wall of two unit blocks side by side on the ground, a third one held fast at their left, a
/// strip of lining on top, and a bolt through all three: one of every element there is.
///
///     n0---n1        nodes on the middles of B and C
///   +---+---+---+
///   | A | B | C |    A fixed; B and C on a smooth base
///   +---+---+---+
///
/// Everything is under 1 MPa all round, and turned by `angle`.
template <class Bolt>
struct Wall {
  using Bolts = BoltSet<2, Bolt>;

  explicit Wall(const Bolt& bolt, double friction = 80 * degree, double angle = 0,
                bool isolated = false)
      : turn(turn_by(angle)),
        system(CoulombJoint({5e9, 5e8, friction}), 5e9, CoulombJoint({1e9, 1e9, friction})) {
    for (const double x : {-1.0, 0.0, 1.0})
      system.add_body({turn * Vec2(x, 0), 25e3, std::sqrt(1.0 / 6), isolated || x >= 0});
    const int ground = system.add_body({Vec2::Zero(), 0, 1, false});
    for (const double x : {0.0, 1.0}) system.add_body({turn * Vec2(x, 0.5), 0, 1, true});
    const auto facet = [&](double x0, double y0, double x1, double y1) {
      return Segment{turn * Vec2(x0, y0), turn * Vec2(x1, y1)};
    };
    const auto touch = [&](auto& group, int a, int b, const Segment& s) {
      group.add(a, b, s, system.body(a).centre, system.body(b).centre, s.gauss_points());
    };
    // Body a lies on the left of the facet.
    touch(system.joints, 0, 1, facet(-0.5, -0.5, -0.5, 0.5));
    touch(system.joints, 1, 2, facet(0.5, -0.5, 0.5, 0.5));
    if (!isolated) {
      touch(system.boundary, 1, ground, facet(-0.5, -0.5, 0.5, -0.5));
      touch(system.boundary, 2, ground, facet(0.5, -0.5, 1.5, -0.5));
    }
    touch(system.interface, 4, 1, facet(-0.5, 0.5, 0.5, 0.5));
    touch(system.interface, 5, 2, facet(0.5, 0.5, 1.5, 0.5));
    const auto pressure = [](const auto&, const Vec2&) {
      return Stress<2>(1e6 * Stress<2>::Identity());
    };
    system.joints.set_initial(pressure);
    system.boundary.set_initial(pressure);
    system.interface.set_initial(pressure);
    const Vec2 a = system.body(4).centre, b = system.body(5).centre;
    const FrameElement<Planar> member{
        4, 5, (b - a).norm(), frame_axes<2>(b - a, Vec2::Zero()),
        EulerBernoulliBeam::stiffness<3>(LiningSection::rectangular(0.1, 25e9), (b - a).norm())};
    system.supports.add(std::make_shared<LiningMembers<Planar>>(std::vector{member}, 4, 2));
    auto through = std::make_shared<Bolts>(bolt);
    through->add(bolt_between(0, 1, -0.5));
    through->add(bolt_between(1, 2, 0.5));
    system.supports.add(through);
  }

  /// A bolt that crosses the joint at x under 20 degrees, gripping 0.2 m on either side of it.
  [[nodiscard]] typename Bolts::Spring bolt_between(int a, int b, double x) const {
    const Vec2 axis = turn * Vec2(std::cos(20 * degree), std::sin(20 * degree));
    const Vec2 at = turn * Vec2(x, 0.1);
    typename Bolts::Spring spring{};
    spring.a = a;
    spring.b = b;
    spring.arm_a = at - 0.2 * axis - system.body(a).centre;
    spring.arm_b = at + 0.2 * axis - system.body(b).centre;
    spring.joint_a = at - system.body(a).centre;
    spring.joint_b = at - system.body(b).centre;
    spring.span = {0.4 * axis, axis, Vec2::Zero()};
    spring.share = 1 / 1.25;
    return spring;
  }

  [[nodiscard]] const std::vector<typename Bolts::Spring>& springs() const {
    return system.supports.template first<Bolts>()->springs();
  }
  /// With other bolts, all of the same law, in place of those there are.
  void replace_bolts(const Bolt& law, const std::vector<typename Bolts::Spring>& springs) {
    SupportSet<2> others;
    others.add(system.supports.template first<LiningMembers<Planar>>()->copy());
    auto bolts = std::make_shared<Bolts>(law);
    for (const auto& spring : springs) bolts->add(spring);
    others.add(bolts);
    system.supports = others;
  }

  /// A displacement of this size that is as good as random, the same for every angle but turned.
  [[nodiscard]] Eigen::VectorXd motion(double size) const {
    Eigen::VectorXd u(3 * system.body_count());
    for (Eigen::Index k = 0; k < u.size(); ++k)
      u[k] = size * std::sin(1.0 + 12.9 * static_cast<double>(k));
    for (int b = 0; b < system.body_count(); ++b) {
      if (system.body(b).movable) {
        u.segment<2>(3 * b) = turn * u.segment<2>(3 * b);
      } else {
        u.segment<3>(3 * b).setZero();
      }
    }
    return u;
  }

  Stress<2> turn;
  PlaneSystem system;
};

AxialBolt bar() { return AxialBolt({.axial_stiffness = 2e8, .carries_compression = true}); }

/// Plastic slips of all points, joints and lining interface.
template <class SystemType>
std::vector<double> history(const SystemType& system) {
  std::vector<double> slips;
  for (const auto& p : system.joints.points())
    slips.push_back(p.template history<CoulombJoint>().plastic_slip[0]);
  for (const auto& p : system.interface.points())
    slips.push_back(p.template history<CoulombJoint>().plastic_slip[0]);
  for (const auto& b : system.supports.template first<BoltSet<2, AxialBolt>>()->springs())
    slips.push_back(b.state.plastic_extension);
  return slips;
}

/// Moment about the origin of everything that acts on the bodies, at their reference positions.
template <class SystemType>
double total_moment(const SystemType& system, const Eigen::VectorXd& f) {
  double moment = 0;
  for (int b = 0; b < system.body_count(); ++b)
    moment += f[3 * b + 2] + cross(system.body(b).centre, Vec2(f.segment<2>(3 * b)));
  return moment;
}
Vec2 total_force(const Eigen::VectorXd& f) {
  Vec2 sum = Vec2::Zero();
  for (Eigen::Index k = 0; k < f.size(); k += 3) sum += f.segment<2>(k);
  return sum;
}

}  // namespace

TEST_SUITE("model/system") {
  TEST_CASE("while everything sticks the elastic stiffness is minus the derivative of the forces") {
    Wall wall(bar());
    const Eigen::MatrixXd k = dense(wall.system.elastic_stiffness());
    const double step = 1e-7;
    Eigen::VectorXd u = wall.motion(1e-6), ahead, behind;
    for (Eigen::Index column = 0; column < u.size(); ++column) {
      if (!wall.system.body(static_cast<int>(column / 3)).movable) continue;
      Eigen::VectorXd moved = u;
      moved[column] += step;
      wall.system.forces(moved, ahead);
      moved[column] -= 2 * step;
      wall.system.forces(moved, behind);
      const Eigen::VectorXd slope = (behind - ahead) / (2 * step);
      Eigen::VectorXd expected = k.col(column);
      for (int b = 0; b < wall.system.body_count(); ++b)
        if (!wall.system.body(b).movable) expected.segment<3>(3 * b).setZero();
      CAPTURE(column);
      // Rounding of 1 MN over 2e-7 m is 1e-3 N/m... of 5e9: 1e-12; the bars turn by 1e-6 / 0.4 and
      // their share of 2e8 with them: 1e-7 of the column.
      CHECK((slope - expected).norm() <= 1e-6 * expected.norm());
    }
  }

  TEST_CASE("bodies that cannot move take part in nothing but their unit diagonal") {
    Wall wall(bar());
    const Eigen::MatrixXd k = dense(wall.system.elastic_stiffness());
    for (const int b : {0, 3}) {
      CHECK(k.block<3, 3>(3 * b, 3 * b) == Eigen::Matrix3d::Identity());
      CHECK(k.middleRows<3>(3 * b).cwiseAbs().sum() == 3);
    }
    Eigen::VectorXd f;
    wall.system.forces(wall.motion(1e-3), f);
    CHECK(f.segment<3>(0).norm() == 0);
    CHECK(f.segment<3>(9).norm() == 0);
  }

  TEST_CASE("the forces between the bodies of an isolated system cancel, slipping and opening") {
    AxialBolt tensioned({.axial_stiffness = 2e8, .pretension = 1e5});
    Wall wall(tensioned, 30 * degree, 0.3, true);
    for (const double size : {1e-6, 1e-4, 1e-3}) {  // sticks, slips, opens here and there
      Eigen::VectorXd f;
      wall.system.forces(wall.motion(size), f);
      CHECK(f.norm() > 1e4);
      CHECK(total_force(f).norm() <= 1e-15 * 8 * 5e9 * 1e-3);  // rounding of the largest force
    }
  }

  TEST_CASE("contacts and lining balance in moment at the reference positions") {
    Wall wall(bar(), 30 * degree, 0.3, true);
    wall.replace_bolts(bar(), {});
    for (const double size : {1e-6, 1e-4, 1e-3}) {
      Eigen::VectorXd f;
      wall.system.forces(wall.motion(size), f);
      CHECK(std::abs(total_moment(wall.system, f)) <= 1e-15 * 8 * 5e9 * 1e-3);
    }
  }

  TEST_CASE("an axial bolt balances in moment where its anchors are now") {
    // It pulls along the line of the displaced anchors, so blocks shifted without turning must be
    // taken at their shifted centres; at the reference positions F times the shear would be left.
    Wall wall(bar(), 30 * degree, 0, true);
    PlaneSystem bare(CoulombJoint({1, 1, 0}, any_units), 1, CoulombJoint({1, 1, 0}, any_units));
    for (int b = 0; b < 3; ++b) bare.add_body(wall.system.body(b));
    bare.supports.add(wall.system.supports.first<BoltSet<2, AxialBolt>>()->copy());
    Eigen::VectorXd u = Eigen::VectorXd::Zero(9), f;
    u.segment<2>(3) = Vec2(2e-3, -1e-3);
    u.segment<2>(6) = Vec2(5e-3, 3e-3);
    bare.forces(u, f);
    double moment = 0;
    for (int b = 0; b < 3; ++b)
      moment += f[3 * b + 2] +
                cross(Vec2(bare.body(b).centre + u.segment<2>(3 * b)), Vec2(f.segment<2>(3 * b)));
    CHECK(f.norm() > 1e5);
    CHECK(std::abs(moment) <= 1e-14 * f.norm());
  }

  TEST_CASE("turning all blocks together by a small angle raises no force") {
    Wall<AxialBolt> wall(bar(), 80 * degree, 0, true);
    const Eigen::MatrixXd k = dense(wall.system.elastic_stiffness());
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(3 * wall.system.body_count());
    for (int b = 0; b < wall.system.body_count(); ++b)
      if (wall.system.body(b).movable)
        turn.segment<3>(3 * b) << perpendicular(wall.system.body(b).centre), 1;
    CHECK((k * turn).norm() <= 1e-14 * k.norm() * turn.norm());
  }

  TEST_CASE("nor does a dowel feel it, however far from the joint the bolt grips") {
    const AxialShearBolt dowel(
        {.axial = {.axial_stiffness = 2e8, .carries_compression = true}, .shear_stiffness = 3e8});
    Wall<AxialShearBolt> wall(dowel, 80 * degree, 0, true);
    const Eigen::MatrixXd k = dense(wall.system.elastic_stiffness());
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(3 * wall.system.body_count());
    for (int b = 0; b < wall.system.body_count(); ++b)
      if (wall.system.body(b).movable)
        turn.segment<3>(3 * b) << perpendicular(wall.system.body(b).centre), 1;
    CHECK((k * turn).norm() <= 1e-14 * k.norm() * turn.norm());
    // The blocks sheared past each other it does feel: by K_s s across the bar.
    Eigen::VectorXd shear = Eigen::VectorXd::Zero(turn.size());
    shear[3 * 2 + 1] = 1e-5;
    Wall<AxialShearBolt> without(
        AxialShearBolt(
            {.axial = {.axial_stiffness = 2e8, .carries_compression = true}, .shear_stiffness = 0}),
        80 * degree, 0, true);
    const Eigen::VectorXd felt = (k - dense(without.system.elastic_stiffness())) * shear;
    const Vec2 bar_axis = wall.springs()[1].span.axis;
    const Vec2 across = Vec2(0, 1e-5) - bar_axis * bar_axis.y() * 1e-5;
    CHECK((felt.segment<2>(3 * 2) - 3e8 / 1.25 * across).norm() <= 1e-9 * felt.norm());
  }

  TEST_CASE("a system turned in 3-D feels turned forces") {
    const AxialBolt tensioned({.axial_stiffness = 2e8, .pretension = 1e5});
    Wall upright(tensioned, 30 * degree), turned(tensioned, 30 * degree, 0.7);
    for (const double size : {1e-6, 1e-4, 1e-3}) {
      Eigen::VectorXd f, g;
      upright.system.forces(upright.motion(size), f);
      turned.system.forces(turned.motion(size), g);
      for (int b = 0; b < upright.system.body_count(); ++b) {
        const Vec2 expected = turned.turn * f.segment<2>(3 * b);
        CHECK((g.segment<2>(3 * b) - expected).norm() <= 1e-13 * f.norm());
        CHECK(std::abs(g[3 * b + 2] - f[3 * b + 2]) <= 1e-13 * f.norm());
      }
    }
  }

  TEST_CASE("reading forces leaves the history bit for bit, committing does not") {
    const AxialBolt soft({.axial_stiffness = 2e8, .yield_force = 1e3});
    Wall wall(soft, 20 * degree);
    const std::vector<double> fresh = history(wall.system);
    Eigen::VectorXd f, again;
    const Eigen::VectorXd u = wall.motion(1e-3);
    wall.system.forces(u, f);
    wall.system.forces(wall.motion(5e-3), again);
    wall.system.forces(u, again);
    CHECK(history(wall.system) == fresh);
    CHECK(again == f);
    wall.system.displacement = u;
    (void)wall.system.commit();
    CHECK(history(wall.system) != fresh);
    // With the slip remembered the forces at the same place are what they were: rounding of
    // k_s s = 5e8 * 1e-3 N.
    wall.system.forces(u, again);
    CHECK((again - f).norm() <= 1e-15 * 8 * 5e5);
  }

  TEST_CASE("committing twice is committing once, and so is committing while reading") {
    const AxialBolt soft({.axial_stiffness = 2e8, .yield_force = 1e3});
    Wall wall(soft, 20 * degree), other(soft, 20 * degree);
    wall.system.displacement = other.system.displacement = wall.motion(1e-3);
    (void)wall.system.commit();
    const std::vector<double> once = history(wall.system);
    (void)wall.system.commit();
    Eigen::VectorXd f;
    other.system.forces<Committing>(other.system.displacement, f);
    const std::vector<double> twice = history(wall.system), reading = history(other.system);
    for (std::size_t k = 0; k < once.size(); ++k) {
      CHECK(std::abs(twice[k] - once[k]) <= 1e-16 * 4 * 1e-3);  // q is rounded anew: a slip of 1 mm
      CHECK(std::abs(reading[k] - once[k]) <= 1e-16 * 4 * 1e-3);
    }
  }

  TEST_CASE("commit says how many bolts broke, once") {
    Wall wall(AxialBolt({.axial_stiffness = 2e8, .rupture_force = 1e5}));
    wall.system.displacement = Eigen::VectorXd::Zero(3 * wall.system.body_count());
    wall.system.displacement[3 * 1] = 1e-3;  // B leaves A by 1 mm; C leaves B by 2 mm more
    wall.system.displacement[3 * 2] = 3e-3;
    CHECK(wall.system.commit() == 2);  // 0.94 mm of extension times 2e8 N/m is beyond 1e5 N
    CHECK(wall.system.commit() == 0);
  }

  TEST_CASE("three springs in series pull with a third of K_a") {
    const double stiffness = 0.2e9, load = 1e5;
    PlaneSystem chain(CoulombJoint({1, 1, 0}, any_units), 1, CoulombJoint({1, 1, 0}, any_units));
    for (int b = 0; b < 4; ++b) chain.add_body({Vec2(0.5 * b, 0), 1, 1, b > 0});
    auto bolts = std::make_shared<BoltSet<2, AxialBolt>>(AxialBolt({.axial_stiffness = stiffness}));
    for (int b = 0; b < 3; ++b) {
      BoltSpring<2, AxialBolt> spring{};
      spring.a = b;
      spring.b = b + 1;
      spring.arm_a = {0.2, 0};
      spring.arm_b = {-0.2, 0};
      spring.joint_a = {0.25, 0};
      spring.joint_b = {-0.25, 0};
      spring.span = {{0.1, 0}, {1, 0}, {0, 0}};
      spring.share = 1;
      bolts->add(spring);
    }
    chain.supports.add(bolts);
    const Eigen::MatrixXd k = dense(chain.elastic_stiffness());
    Eigen::Matrix3d along;  // the bolts resist nothing but motion along them
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) along(i, j) = k(3 * (i + 1), 3 * (j + 1));
    const Vec<3> u = voussoir_test::solve(along, Vec<3>(0, 0, load));
    CHECK(std::abs(load / u[2] - reference("F.pull.series3")) <=
          1e-11 * reference("F.pull.series3"));
    chain.displacement << 0, 0, 0, u[0], 0, 0, u[1], 0, 0, u[2], 0, 0;
    chain.load[9] = load;
    Eigen::VectorXd f;
    chain.forces(chain.displacement, f);
    CHECK(f.norm() <= 1e-9 * load);  // in equilibrium; extension 0.5 mm beside 0.1 m of span
  }

  TEST_CASE("a bolt spaced further apart acts less per metre, in proportion") {
    Wall wall(bar()), sparse(bar());
    auto halved = sparse.springs();
    for (auto& b : halved) b.share = 0.5 * wall.springs().front().share;
    sparse.replace_bolts(bar(), halved);
    Wall none(bar());
    none.replace_bolts(bar(), {});
    const Eigen::VectorXd u = wall.motion(1e-3);
    Eigen::VectorXd f, half, zero;
    wall.system.forces(u, f);
    sparse.system.forces(u, half);
    none.system.forces(u, zero);
    CHECK((f - zero).norm() > 1e4);
    CHECK((half - zero - 0.5 * (f - zero)).norm() <= 1e-15 * 8 * f.norm());
  }

  TEST_CASE("contacts installed on ground that has moved are free of force there") {
    Wall wall(bar());
    auto& lining = wall.system.interface;
    const Eigen::VectorXd u = wall.motion(1e-3);
    lining.touch_at(u.data(), 0);
    Eigen::VectorXd f = Eigen::VectorXd::Zero(u.size());
    lining.template add_forces<Frozen>(u.data(), f.data());
    CHECK(f.norm() <= 1e-15 * 8 * 1e9 * 1e-3);  // rounding of k w u
    // From there on a block that comes 0.1 mm nearer to its node presses with k_n times the length.
    Eigen::VectorXd closer = u;
    closer[3 * 2 + 1] += 1e-4;
    f.setZero();
    lining.template add_forces<Frozen>(closer.data(), f.data());
    CHECK(std::abs(f[3 * 5 + 1] - 1e9 * 1e-4) <= 1e-9 * 1e5);
    CHECK(std::abs(f[3 * 2 + 1] + 1e9 * 1e-4) <= 1e-9 * 1e5);
    closer[3 * 2 + 1] -= 2e-4;  // and one that goes away leaves it alone
    f.setZero();
    lining.template add_forces<Frozen>(closer.data(), f.data());
    CHECK(f.segment<3>(15).norm() <= 1e-15 * 8 * 1e9 * 1e-3);
  }

  TEST_CASE("the part of the wall traction still acting is added in proportion") {
    Wall wall(bar());
    wall.system.wall_load.setOnes();
    Eigen::VectorXd all, none, third;
    const Eigen::VectorXd u = wall.motion(1e-4);
    wall.system.wall_fraction = 1;
    wall.system.forces(u, all);
    wall.system.wall_fraction = 0;
    wall.system.forces(u, none);
    wall.system.wall_fraction = 0.3;
    wall.system.forces(u, third);
    CHECK((third - (none + 0.3 * (all - none))).norm() <= 1e-15 * 8 * none.norm());
    CHECK((all - none).segment<3>(3).isApprox(Vec<3>::Ones(), 1e-9));
  }

  TEST_CASE("a removed block takes its contacts and bolts with it and leaves the others alone") {
    Wall wall(bar());
    wall.system.displacement = wall.motion(1e-3);
    const Vec<3> kept = wall.system.displacement.segment<3>(3);
    wall.system.remove({2});
    CHECK(!wall.system.body(2).movable);
    CHECK(wall.system.displacement.segment<3>(6).norm() == 0);
    CHECK(wall.system.displacement.segment<3>(3) == kept);
    CHECK(wall.system.joints.contacts().size() == 1);  // A-B
    CHECK(wall.system.joints.points().size() == 2);
    CHECK(wall.system.boundary.contacts().size() == 1);
    CHECK(wall.system.interface.contacts().size() == 1);
    CHECK(wall.springs().size() == 1);
    CHECK(wall.system.unsupported().empty());  // B stands on the base; the node hangs on the frame
    wall.system.remove({0});
    CHECK(wall.system.movable_bodies() == std::vector<int>{1, 4, 5});
  }

  TEST_CASE("a block that touches nothing is unsupported") {
    Wall wall(bar());
    const int loose = wall.system.add_body({Vec2(5, 5), 1e4, 0.3, true});
    CHECK(wall.system.unsupported() == std::vector<int>{loose});
  }

  TEST_CASE("so are two blocks that touch nothing but each other, and a ring that nothing holds") {
    Wall wall(bar());
    auto& system = wall.system;
    const int one = system.add_body({Vec2(5, 5), 1e4, 0.3, true});
    const int other = system.add_body({Vec2(6, 5), 1e4, 0.3, true});
    const Segment face{Vec2(5.5, 4.5), Vec2(5.5, 5.5)};
    const auto points = face.gauss_points();
    system.joints.add(one, other, face, system.body(one).centre, system.body(other).centre, points);
    CHECK(system.unsupported() == std::vector<int>{one, other});
    system.remove({1, 2});  // the blocks under the lining: its two nodes hang on each other
    CHECK(system.unsupported() == std::vector<int>{4, 5, one, other});
    const auto& members = system.supports.first<LiningMembers<Planar>>()->members();
    CHECK(members.size() == 1);
    system.remove({4});
    CHECK(members.empty());
  }

  TEST_CASE("a broken bolt has no stiffness") {
    Wall wall(AxialBolt({.axial_stiffness = 2e8, .rupture_force = 1e5}));
    const Eigen::MatrixXd whole = dense(wall.system.elastic_stiffness());
    wall.system.displacement[3 * 2] = 3e-3;  // C away from B: the second bolt breaks
    REQUIRE(wall.system.commit() == 1);
    const Eigen::MatrixXd rest = dense(wall.system.elastic_stiffness());
    wall.replace_bolts(bar(), {wall.springs().front()});
    CHECK(rest == dense(wall.system.elastic_stiffness()));
    CHECK((whole - rest).norm() > 1e7);
  }

  TEST_CASE("how far lining nodes move is not how far the rock moves") {
    PlaneSystem system(CoulombJoint({1, 1, 0}, any_units), 1, CoulombJoint({1, 1, 0}, any_units));
    const int block = system.add_body({Vec2(0, 0), 1e4, 0.3, true});
    const int node = system.add_body({Vec2(1, 0), 0, 0.3, true, false});
    Eigen::VectorXd u = Eigen::VectorXd::Zero(6);
    u[3 * block] = 1e-3;
    u[3 * node] = 1;
    CHECK(system.largest_translation(u) == 1e-3);
    // An error of a node is one all the same, measured by the motion of the rock.
    CHECK(system.relative_correction(u, u) == voussoir_test::near(1e3));
  }

  TEST_CASE("the out-of-balance force ratio is force plus moment over gyration, over the weight") {
    Wall wall(bar());
    Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * wall.system.body_count());
    f.segment<3>(3) << 300, -400, -20;  // on B: 500 N and 20 N m at a gyration of sqrt(1/6) m
    f.segment<3>(0) << 1e6, 0, 0;       // A is fixed and does not count
    const double expected = (500 + 20 * std::sqrt(6.0)) / 25e3;
    CHECK(std::abs(wall.system.unbalance_over_weight(f) - expected) <= 1e-15);
    f.segment<3>(12) << 0, 1000, 0;  // a weightless node is measured by the lightest block
    CHECK(std::abs(wall.system.unbalance_over_weight(f) - 1000 / 25e3) <= 1e-15);
  }
}

}  // namespace system_test
