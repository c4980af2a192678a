// SPDX-License-Identifier: MIT
// Contact points in flat arrays: what is stored is what was given, and forces from the arrays are
// those of the law, one point at a time.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <type_traits>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/core/lane_pair.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/model/contact_group.hpp>

namespace contact_arrays_test {

using namespace voussoir;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// A law as a user may write it: its own state, and nothing that is optional.
struct CountingSpring {
  using role = roles::ContactLaw;
  static constexpr const char* name = "CountingSpring";
  template <int Dim>
  struct State {
    int commits = 0;
    Vec<Dim - 1> last = zeros<Vec<Dim - 1>>();
  };
  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    return {load.initial.normal - 1e9 * load.weight * load.motion.opening,
            load.initial.tangential - 1e8 * load.weight * (load.motion.slip - 0.5 * state.last)};
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    ++state.commits;
    state.last = load.motion.slip;
    return 0;
  }
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>&, const State<Dim>&) const {
    return 0;
  }
  [[nodiscard]] double joint_normal_stiffness() const { return 1e9; }
  [[nodiscard]] double joint_shear_stiffness() const { return 1e8; }
};
static_assert(ContactLaw<CountingSpring, 2> && ContactLaw<CountingSpring, 3>);

template <class Law>
Law law_of();
template <>
CoulombJoint law_of() {
  return CoulombJoint({5e9, 5e8, 35 * degree});
}
template <>
MohrCoulombJoint law_of() {
  return MohrCoulombJoint({.joint_normal_stiffness = 5e9,
                           .joint_shear_stiffness = 5e8,
                           .friction_angle = 35 * degree,
                           .cohesion = 1e5});
}
template <>
CountingSpring law_of() {
  return {};
}

class Numbers {
 public:
  /// Between -1 and 1.
  double operator()() { return 2 * random_.uniform() - 1; }
  template <int Size>
  Vec<Size> vector() {
    Vec<Size> v;
    for (int k = 0; k < Size; ++k) v[k] = (*this)();
    return v;
  }

 private:
  Random random_{11};
};

constexpr int body_count = 23;

/// Contacts of one to five points, half of them pressed so little that they open or slip.
template <class Geometry, class Law>
ContactGroup<Geometry> random_contacts(bool shifted) {
  constexpr int dim = Geometry::dim;
  using Group = ContactGroup<Geometry>;
  Numbers number;
  Group group({law_of<Law>()});
  for (int k = 0; k < 200; ++k) {
    typename Group::Contact c{};
    const Vec<dim> normal = normalized(number.vector<dim>());
    TangentBasis<dim> tangents = tangent_basis(normal);
    // The other hand, as a contact update may leave it.
    if constexpr (dim == 3)
      if (k % 3 == 0) set_column(tangents, 1, Vec3(-column(tangents, 1)));
    c.set_frame(normal, tangents);
    c.arm_a = number.vector<dim>();
    c.arm_b = number.vector<dim>();
    c.a = k % body_count;
    c.b = (k * 7 + 1 + k / 7) % body_count;
    if (c.a == c.b) c.b = (c.b + 1) % body_count;
    std::vector<typename Group::Point> points(static_cast<std::size_t>(1 + k % 5));
    const double weight = 0.5 + 0.4 * number();  // one for all, as contacts have it
    for (auto& p : points) {
      p.offset = number.vector<dim>();
      if (!shifted) p.offset[0] = 0;
      p.weight = weight;
      p.initial.normal = 1e5 * (1 + number());
      p.initial.tangential = 3e4 * number.vector<dim - 1>();
      if (shifted) p.start = 1e-5 * number.vector<dim>();
    }
    group.add(c, points);
  }
  return group;
}

template <int Dof>
Eigen::VectorXd random_displacement() {
  Numbers number;
  Eigen::VectorXd u(Dof * body_count);
  for (Eigen::Index k = 0; k < u.size(); ++k) u[k] = 2e-5 * number();
  return u;
}

/// By the formulas, point by point and in world axes: the normal force where the contact is pressed
/// (model/pressed_part_test.cpp), the shear where its slip is. `largest` gets the sum of the
/// magnitudes.
template <class Group>
Eigen::VectorXd point_by_point(const Group& group, const Eigen::VectorXd& u, double& largest) {
  constexpr int dim = Group::dim, dof = Group::dof;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(u.size());
  largest = 0;
  std::size_t k = 0;
  group.visit(u.data(), [&](const auto& c, const auto& p, const auto&, const auto& at) {
    const auto add = [&](const ReferencePoint<dim>& point, const Vec<dim>& force) {
      const Vec<dim> offset = c.offset_of(point);
      add_force_at<dim>(f.data() + dof * c.b, c.arm_b + offset, force);
      add_force_at<dim>(f.data() + dof * c.a, c.arm_a + offset, -force);
      largest += force.norm();
    };
    add(p, at.normal * c.normal);
    add(group.points().place(k++), c.tangents() * at.tangential);
  });
  return f;
}

template <class Point>
void check_same(const Point& p, const Point& q) {
  CHECK(p.offset == q.offset);
  CHECK(p.weight == q.weight);
  CHECK(p.initial.normal == q.initial.normal);
  CHECK(p.initial.tangential == q.initial.tangential);
  CHECK(p.start == q.start);
}

template <class Geometry, class Law>
struct Of {
  using GeometryType = Geometry;
  using LawType = Law;
};

}  // namespace

TEST_SUITE("model/contact_arrays") {
  TEST_CASE_TEMPLATE("forces from the arrays are those of the law, one point at a time", T,
                     Of<Planar, CoulombJoint>, Of<Spatial, CoulombJoint>,
                     Of<Planar, MohrCoulombJoint>, Of<Spatial, MohrCoulombJoint>,
                     Of<Planar, CountingSpring>, Of<Spatial, CountingSpring>) {
    using Geometry = typename T::GeometryType;
    for (const bool shifted : {false, true}) {
      CAPTURE(shifted);
      auto group = random_contacts<Geometry, typename T::LawType>(shifted);
      REQUIRE(group.points().has_shifts() == shifted);
      const Eigen::VectorXd u = random_displacement<Geometry::dof>();
      for (int round = 0; round < 3; ++round) {
        double largest = 0;
        const Eigen::VectorXd by_point = point_by_point(group, (1 + round) * u, largest);
        Eigen::VectorXd f = Eigen::VectorXd::Zero(u.size());
        const Eigen::VectorXd moved = (1 + round) * u;
        group.template add_forces<Frozen>(moved.data(), f.data());
        REQUIRE(largest > 1e6);
        // k_n w times the motion's rounding: stiffness 5e9 on motions of 1e-5 of levers near 1, so
        // 1e5 N to some ten roundings; that of the sum is less.
        CHECK((f - by_point).norm() <= 1e-13 * largest);
        // Committing gives the same force and leaves what one commit of each point leaves.
        auto plain = group;
        plain.commit(moved.data());
        Eigen::VectorXd g = Eigen::VectorXd::Zero(u.size());
        group.template add_forces<Committing>(moved.data(), g.data());
        CHECK((g - by_point).norm() <= 1e-13 * largest);
        double once = 0;
        const Eigen::VectorXd after = point_by_point(group, 0.5 * moved, largest);
        CHECK((after - point_by_point(plain, 0.5 * moved, once)).norm() <= 1e-13 * largest);
      }
    }
  }

  TEST_CASE("the forces of two points at once are those of each, bit for bit") {
    Numbers number;
    const CoulombJoint joint = law_of<CoulombJoint>();
    int open = 0, sliding = 0, sticking = 0;
    for (int round = 0; round < 1000; ++round) {
      CoulombJoint::State<2> two[2];
      PointLoad<2> load[2];
      for (int k = 0; k < 2; ++k) {
        two[k].plastic_slip = Vec<1>(1e-5 * number());
        load[k] = {0.5 + 0.4 * number(),
                   {1e5 * (1 + number()), Vec<1>(3e4 * number())},
                   {4e-5 * number(), Vec<1>(4e-5 * number())}};
      }
      const auto both = [&](auto&& of) { return LanePair(of(load[0]), of(load[1])); };
      PairLoad pair{both([](const auto& l) { return l.weight; }),
                    both([](const auto& l) { return l.initial.normal; }),
                    both([](const auto& l) { return l.initial.tangential[0]; }),
                    both([](const auto& l) { return l.motion.opening; }),
                    both([](const auto& l) { return l.motion.slip[0]; })};
      const PairForce force = joint.pair_force(pair, two);
      for (int k = 0; k < 2; ++k) {
        const PointForce<2> one = joint.force(load[k], two[k]);
        CHECK(force.normal[k] == one.normal);
        CHECK(force.shear[k] == one.tangential[0]);
        const double limit = joint.friction_coefficient() * one.normal;
        ++(one.normal == 0 ? open : std::abs(one.tangential[0]) == limit ? sliding : sticking);
      }
    }
    CHECK((open > 100 && sliding > 100 && sticking > 100));
  }

  TEST_CASE("lanes choose as std::max and std::min do, also what is not a number") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double a : {-1.0, 0.0, 2.0, nan})
      for (const double b : {-1.0, 0.0, 2.0, nan}) {
        const LanePair most = larger(LanePair(a, b), LanePair(b, a)),
                       least = smaller(LanePair(a, b), LanePair(b, a));
        const auto same = [](double x, double y) { return x == y || (x != x && y != y); };
        CHECK(same(most[0], std::max(a, b)));
        CHECK(same(most[1], std::max(b, a)));
        CHECK(same(least[0], std::min(a, b)));
        CHECK(same(least[1], std::min(b, a)));
      }
  }

  TEST_CASE_TEMPLATE("points come back bit for bit, whenever the first of them is shifted", T,
                     std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
    constexpr int dim = T::value;
    using Arrays = ContactArrays<dim>;
    const auto& model = detail::StateModelOf<CountingSpring::State<dim>>::one();
    const auto commits_of = [](const auto& p) {
      return p.template history<CountingSpring>().commits;
    };
    Numbers number;
    std::vector<typename Arrays::Point> given(40);
    Arrays arrays;
    arrays.states().set_model(model);
    for (std::size_t k = 0; k < given.size(); ++k) {
      auto& p = given[k];
      p.offset = number.vector<dim>();
      p.weight = number();
      p.initial = {number(), number.vector<dim - 1>()};
      const CountingSpring::State<dim> state{static_cast<int>(k), {}};
      p.state = AnyState(model, &state);
      if (k < 17) p.offset[0] = 0;
      if (k >= 17) p.start = number.vector<dim>();
      arrays.push_back(p);
      CHECK(arrays.has_shifts() == (k >= 17));
    }
    REQUIRE(arrays.size() == given.size());
    std::size_t seen = 0;
    for (const auto& p : arrays) {
      check_same(p, given[seen]);
      CHECK(commits_of(p) == commits_of(given[seen++]));
    }
    CHECK(seen == given.size());
    // Points 30, ..., 33 move to 2, ..., 5; the rest goes.
    arrays.move_down(30, 2, 4);
    arrays.truncate(6);
    REQUIRE(arrays.size() == 6);
    check_same(arrays[1], given[1]);
    for (std::size_t k = 2; k < 6; ++k) {
      check_same(arrays[k], given[k + 28]);
      CHECK(commits_of(arrays[k]) == static_cast<int>(k) + 28);
    }
    arrays.set(0, given[39]);
    check_same(arrays[0], given[39]);
    CHECK(commits_of(arrays[0]) == 39);
    CHECK_THROWS_AS((void)arrays[0].template history<CoulombJoint>(), InvalidInput);
  }

  TEST_CASE("a contact and its points take few bytes") {
    CHECK(sizeof(ReferenceContact<2>) + 2 * sizeof(PointRecord<2>) == 128);
    CHECK(sizeof(ReferenceContact<3>) + 4 * sizeof(PointRecord<3>) == 352);
  }

  TEST_CASE("a contact with more points than its record can count is refused") {
    ReferenceContact<2> c{};
    c.set_points(5, 65535);
    CHECK(c.last() == 5 + 65535);
    CHECK_THROWS_AS(c.set_points(0, 65536), InvalidInput);
    CHECK_THROWS_AS(c.set_law(65536), InvalidInput);
    CHECK_THROWS_AS(c.set_law(-1), InvalidInput);
  }
}

}  // namespace contact_arrays_test
