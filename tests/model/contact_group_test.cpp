// SPDX-License-Identifier: MIT
// The contacts of a model: their order, what they add up to, and the rock that they come from.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/contact/smooth_wall.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/model/contact_update.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/tunnel/lining_ring.hpp>

#include "support/bolted_tunnel.hpp"
#include "support/jointed_mass.hpp"
#include "support/near.hpp"

namespace contact_group_test {

using namespace voussoir_test;

namespace {

template <class Contacts>
bool in_order(const Contacts& contacts) {
  return std::is_sorted(contacts.begin(), contacts.end(), [](const auto& x, const auto& y) {
    return std::minmax(x.a, x.b) < std::minmax(y.a, y.b);
  });
}

template <class System>
void check_order(const System& system) {
  CHECK(in_order(system.joints.contacts()));
  CHECK(in_order(system.boundary.contacts()));
  CHECK(in_order(system.interface.contacts()));
  // Their points follow each other without a gap.
  int next = 0;
  for (const auto& c : system.joints.contacts()) {
    CHECK(c.first == next);
    next = c.last();
  }
  CHECK(static_cast<std::size_t>(next) == system.joints.points().size());
}

/// A displacement of every body of up to 0.1 mm or 0.1 mrad.
template <class System>
Eigen::VectorXd shaken(const System& system) {
  Random random(7);
  Eigen::VectorXd u(system.displacement.size());
  for (Eigen::Index k = 0; k < u.size(); ++k) u[k] = 2e-4 * (random.uniform() - 0.5);
  return u;
}

/// The forces of a group by the formulas of its points: on b the force at the point, on a the
/// opposite, moments about their centres.
template <class Group, class System>
Eigen::VectorXd point_by_point(const Group& group, const System& system, const Eigen::VectorXd& u) {
  constexpr int dim = System::dim, dof = System::dof;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(system.displacement.size());
  const ReferenceContact<dim>* last = nullptr;
  std::size_t k = 0;
  group.visit(u.data(), [&](const auto& c, const auto& p, const auto&, const auto& at) {
    // On a joint that is open from an edge the normal force acts on the part that is pressed, the
    // shear where the slip of the point is.
    if (&c != last) k = static_cast<std::size_t>(c.first);
    last = &c;
    const auto add = [&](const ReferencePoint<dim>& point, const Vec<dim>& force) {
      const Vec<dim> offset = c.offset_of(point);
      add_force_at<dim>(f.data() + dof * c.b, c.arm_b + offset, force);
      add_force_at<dim>(f.data() + dof * c.a, c.arm_a + offset, -force);
    };
    add(p, at.normal * c.normal);
    add(group.points().place(k++), c.tangents() * at.tangential);
  });
  return f;
}

template <class Tunnel>
void check_sum(Tunnel& tunnel) {
  auto& system = detail::SystemOf::in(tunnel);
  const Eigen::VectorXd u = shaken(system);
  // Points with a height and a start of their own, as contact updates make them.
  voussoir::update_contacts(system, 1e-3);
  system.displacement = u;
  voussoir::update_contacts(system, 1e-3);
  const Eigen::VectorXd moved = 1.3 * u;
  const Eigen::VectorXd expected = point_by_point(system.joints, system, moved);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(expected.size());
  system.joints.template add_forces<Frozen>(moved.data(), f.data());
  REQUIRE(expected.norm() > 1e6);
  // A few roundings of the forces that a body gets, which are larger than their sum.
  CHECK((f - expected).norm() <= 1e-11 * expected.norm());
}

Solver<Spatial> jointed_cube() {
  return {jointed_mass({{-5, 0, -5}, {5, 4, 5}}, 1, 1.5),
          CoulombJoint({5e9, 5e8, 35 * degree}),
          {.density = 2700, .k0 = 1.2}};
}

}  // namespace

TEST_SUITE("model/contact_group") {
  TEST_CASE("points stand for the length or area of a contact, its middle and its second moment") {
    // By hand: L^3/12 of a segment about its middle, a^4/12 of a square about an axis.
    const Segment ends{Vec2(3, 1), Vec2(3, 3)};
    double length = 0, first = 0, second = 0;
    for (const auto& p : ends.gauss_points()) {
      CHECK(p.offset.x() == near(0));
      length += p.weight;
      first += p.weight * p.offset.y();
      second += p.weight * p.offset.y() * p.offset.y();
    }
    CHECK(length == near(2));
    CHECK(std::abs(first) < 1e-15);
    CHECK(second == near(8.0 / 12));
    const SpatialFacet square{{Vec3(0, 0, 5), Vec3(2, 0, 5), Vec3(2, 2, 5), Vec3(0, 2, 5)}};
    Vec3 moment = Vec3::Zero();
    double area = 0, along_x = 0, along_y = 0;
    for (const auto& p : square.gauss_points()) {
      area += p.weight;
      moment += p.weight * p.offset;
      along_x += p.weight * p.offset.x() * p.offset.x();
      along_y += p.weight * p.offset.y() * p.offset.y();
    }
    CHECK(area == near(4));
    CHECK(moment.norm() < 1e-14);
    CHECK(along_x == near(16.0 / 12));
    CHECK(along_y == near(16.0 / 12));
  }

  TEST_CASE("contacts are in the order of their lower body when built, updated and removed") {
    Solver<> tunnel = bolted_tunnel();
    REQUIRE(!in_order(CutContacts::find(tunnel.mass())));  // as they are found they are not
    tunnel.install_lining(lining_frame(tunnel.mass(), {}), LiningSection::rectangular(0.1, 25e9),
                          CoulombJoint({1e9, 1e9, 30 * degree}));
    auto& system = detail::SystemOf::in(tunnel);
    REQUIRE(system.interface.contacts().size() > 20);
    check_order(system);
    update_contacts(system, 1e-3);
    check_order(system);
    const std::size_t before = system.joints.contacts().size();
    system.remove({3, 700, 11});
    CHECK(system.joints.contacts().size() < before);
    check_order(system);
    Solver<Spatial> rock = jointed_cube();
    REQUIRE(!in_order(CutContacts::find(rock.mass())));
    check_order(rock.system());
    update_contacts(detail::SystemOf::in(rock), 1e-3);
    check_order(rock.system());
  }

  TEST_CASE("several contacts of the same two bodies stay as they were found") {
    const std::vector<std::array<int, 3>> found{{4, 2, 0}, {0, 9, 1}, {2, 4, 2}, {2, 3, 3},
                                                {4, 2, 4}, {9, 0, 5}, {1, 0, 6}};
    const std::vector<int> order =
        order_by_bodies(found, [](const auto& c) { return std::pair<int, int>(c[0], c[1]); });
    CHECK(order == std::vector<int>{6, 1, 5, 3, 0, 2, 4});
  }

  TEST_CASE("contacts that are left keep their points and what these remember") {
    Solver<> tunnel = bolted_tunnel();
    auto& system = detail::SystemOf::in(tunnel);
    system.displacement = 20 * shaken(system);
    system.commit();
    const auto before = system.joints;
    system.remove({3, 700, 11});
    std::size_t left = 0;
    for (const auto& c : before.contacts()) {
      if (system.body(c.a).is_gone || system.body(c.b).is_gone) continue;
      const auto& now = system.joints.contacts()[left++];
      REQUIRE((now.a == c.a && now.b == c.b && now.count == c.count));
      for (int k = 0; k < c.count; ++k) {
        const auto& was = before.points()[static_cast<std::size_t>(c.first + k)];
        const auto& is = system.joints.points()[static_cast<std::size_t>(now.first + k)];
        CHECK(is.offset == was.offset);
        CHECK(is.history<CoulombJoint>().plastic_slip == was.history<CoulombJoint>().plastic_slip);
      }
    }
    CHECK(left == system.joints.contacts().size());
  }

  TEST_CASE("a law of another type than the others of its group is refused, and nothing changes") {
    ContactGroup<Planar> group({CoulombJoint({5e9, 5e8, 35 * degree})});
    CHECK(group.add_law(CoulombJoint({5e9, 5e8, 30 * degree})) == 1);
    CHECK_THROWS_AS((void)group.add_law(MohrCoulombJoint({5e9, 5e8, 35 * degree})), InvalidInput);
    CHECK(group.laws().size() == 2);
    CHECK(group.laws()[0].as<MohrCoulombJoint>() == nullptr);
    REQUIRE(group.laws()[1].as<CoulombJoint>() != nullptr);
    CHECK(group.laws()[1].as<CoulombJoint>()->friction_coefficient() ==
          CoulombJoint({5e9, 5e8, 30 * degree}).friction_coefficient());
    CHECK_THROWS_AS(ContactGroup<Planar>({CoulombJoint({5e9, 5e8, 35 * degree}), SmoothWall(5e9)}),
                    InvalidInput);
  }

  TEST_CASE("the force of a contact is the sum over its points, in 2-D and 3-D") {
    Solver<> tunnel = bolted_tunnel();
    check_sum(tunnel);
    Solver<Spatial> rock = jointed_cube();
    check_sum(rock);
  }

  TEST_CASE("a tunnel excavated in rock is, bit for bit, one in rock that was carved beforehand") {
    const auto opening = circular_opening(5, 36);
    const auto mass = jointed_rock(domain_around(opening, 35, 10, 15), 2);
    const CoulombJoint joint({5e9, 5e8, 35 * degree});
    const InSitu in_situ{.density = 2700, .k0 = 0.7, .surcharge = 1e5};
    Solver<> dug(mass, joint, in_situ);
    // Until then it is the whole rock, and its fixed ground.
    CHECK(dug.system().body_count() == static_cast<int>(mass.bodies.size()) + 1);
    CHECK(dug.system().wall_load.norm() == 0);
    const Solver<> whole = dug;
    dug.excavate(opening, 0.05);
    const Solver<> carved(carve(mass, opening, 0.05), joint, in_situ);
    const Solver<> at_once(mass, joint, in_situ, opening, 0.05);
    CHECK(at_once.system().wall_load == dug.system().wall_load);
    CHECK(at_once.system().load == dug.system().load);
    CHECK(at_once.mass().openings.size() == 1);
    const auto &x = dug.system(), &y = carved.system();
    CHECK(x.wall_load.norm() > 1e5);
    REQUIRE(x.body_count() == y.body_count());
    CHECK(x.body_count() != whole.system().body_count());
    CHECK(x.load == y.load);
    for (int b = 0; b < x.body_count(); ++b) {
      CHECK(x.body(b).centre == y.body(b).centre);
      CHECK(x.body(b).weight == y.body(b).weight);
    }
    const auto same = [](const auto& one, const auto& two) {
      REQUIRE(one.contacts().size() == two.contacts().size());
      REQUIRE(one.points().size() == two.points().size());
      for (std::size_t k = 0; k < one.contacts().size(); ++k) {
        const auto &c = one.contacts()[k], &d = two.contacts()[k];
        CHECK((c.a == d.a && c.b == d.b && c.first == d.first && c.count == d.count));
        CHECK(c.law == d.law);
        CHECK(c.normal == d.normal);
        CHECK(c.arm_a == d.arm_a);
        CHECK(c.arm_b == d.arm_b);
      }
      for (std::size_t k = 0; k < one.points().size(); ++k) {
        const auto &p = one.points()[k], &q = two.points()[k];
        CHECK(p.offset == q.offset);
        CHECK(p.weight == q.weight);
        CHECK(p.initial.normal == q.initial.normal);
        CHECK(p.initial.tangential == q.initial.tangential);
      }
    };
    same(x.joints, y.joints);
    same(x.joints, at_once.system().joints);
    same(x.boundary, y.boundary);
  }

  TEST_CASE("a solver keeps its rock when the one it was copied from is excavated, or is gone") {
    const auto opening = circular_opening(5, 36);
    auto first =
        std::make_unique<Solver<>>(jointed_rock(domain_around(opening, 35, 10, 15), 2),
                                   CoulombJoint({5e9, 5e8, 35 * degree}), InSitu{.density = 2700});
    Solver<> second = *first;
    const std::size_t blocks = second.mass().bodies.size();
    const double area = second.mass().bodies[700].properties.measure;
    first->excavate(opening);
    CHECK(first->mass().bodies.size() != blocks);
    first.reset();
    CHECK(second.mass().bodies.size() == blocks);
    CHECK(second.mass().openings.empty());
    CHECK(mass_properties(second.mass().bodies[700].parts).measure == area);
    update_contacts(detail::SystemOf::in(second), 1e-3);
    CHECK(in_order(second.system().joints.contacts()));
    second.excavate(opening);
    CHECK(second.mass().openings.size() == 1);
  }

  TEST_CASE("an excavation that is stopped says so, and copies made before go on") {
    // 32 400 blocks: several times the 10 ms in which nothing is asked.
    std::vector<Joint> joints;
    for (int k = 1; k < 180; ++k) {
      joints.push_back({{{-1, k}, {181, k}}, 0});
      joints.push_back({{{k, -1}, {k, 181}}, 1});
    }
    const SimplePolygon opening({{88.5, 88.5}, {92.5, 88.5}, {92.5, 92.5}, {88.5, 92.5}});
    Solver<> first(slice({{0, 0}, {180, 180}}, joints, {}), CoulombJoint({5e9, 5e8, 35 * degree}),
                   {.density = 2700});
    Solver<> second = first;
    CHECK_THROWS_AS(first.excavate(opening, 0.05, [](double) { return false; }), Stopped);
    CHECK_THROWS_AS(Solver<>(second.mass(), CoulombJoint({5e9, 5e8, 35 * degree}),
                             {.density = 2700}, opening, 0.05, [](double) { return false; }),
                    Stopped);
    int asked = 0;
    second.excavate(opening, 0.05, [&](double) { return ++asked > 0; });
    CHECK(asked > 0);
    CHECK(second.system().body_count() < 32400 + 1);
    CHECK(second.system().wall_load.norm() > 1e5);
  }
}

}  // namespace contact_group_test
