// SPDX-License-Identifier: MIT
// Whatever a contact update finds, its springs are eased to the energy that they may hold.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/contact/burgers_joint.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/spatial_facet.hpp>
#include <voussoir/model/detail/limited_energy.hpp>

#include "support/degree.hpp"
#include "support/near.hpp"

namespace limited_energy_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

template <int Dim>
using Dimension = std::integral_constant<int, Dim>;

constexpr double k_n = 5e9;

/// Body 1 on body 0, the normal along x: a contact with a history of random motion.
template <int Dim, class Law>
class Joint {
 public:
  using Group = MovingContacts<Dim>;
  using Points = std::vector<typename Group::Point>;

  /// @param stress  in situ, normal [Pa];  @param size  of the motions [m], and of the turns [rad]
  Joint(const Law& law, double stress, double size, Random& random) : group_({law}) {
    bodies_[1].pose.position[0] = 0.7;
    bodies_[1].pose.rotation = diagonal_of<Dim>(1);
    bodies_[0].pose.rotation = diagonal_of<Dim>(1);
    typename Group::Contact contact{};
    contact.frame = diagonal_of<Dim>(1);
    contact.a = 0;
    contact.b = 1;
    const auto at = contact.place(bodies_[0].pose, bodies_[1].pose);
    const auto area = facet();
    Points points;
    std::vector<FacetPoint<Dim>> offsets;
    const double steep = 2 * random.uniform() - 1;
    for (const FacetPoint<Dim>& p : area.gauss_points()) {
      typename Group::Point point{};
      point.place = area.centre() + p.offset - bodies_[1].pose.position;
      point.zero = at.base + point.place;
      point.weight = p.weight;
      // Linear along the joint, as the stress of rock is taken to be.
      point.initial.normal = stress * p.weight * (1 + steep * p.offset[1]);
      for (int k = 0; k + 1 < Dim; ++k)
        point.initial.tangential[k] = 0.5 * stress * p.weight * (random.uniform() - 0.5);
      points.push_back(point);
      offsets.push_back(p);
    }
    if constexpr (Dim == 3)
      contact.outline = detail::kept_outline(area, area.centre(), offsets.data(), offsets.size());
    std::int32_t number = -1;
    (void)group_.put(number, contact, points);
    for (int k = 0; k < 8; ++k) {
      move(size, random);
      Reaction<Dim> reaction;
      Dissipation lost;
      group_.react(0, 1, bodies_, &reaction, lost);
    }
  }

  [[nodiscard]] Points points() const { return group_.points(); }
  /// Points with another history each.
  /// @param change  change(state of the law)
  template <class Change>
  [[nodiscard]] Points points_with_other_histories(Change&& change) {
    Points points = group_.points();
    detail::StateColumn states;
    states.set_model(group_.laws().front().model().states());
    for (std::size_t k = 0; k < points.size(); ++k) {
      auto state = *static_cast<const typename Law::template State<Dim>*>(group_.memory_of(k));
      change(state);
      states.push_back(static_cast<const void*>(&state));
      points[k].state.number = -2 - static_cast<int>(k);
    }
    group_.adopt(std::move(states));
    return points;
  }
  [[nodiscard]] double energy(const Points& points) const {
    const auto& c = group_.contacts().front();
    return group_.stored_energy(c, points, c.place(bodies_[0].pose, bodies_[1].pose));
  }
  /// @return  how much of the overlap is not counted [m]
  double limit(Points& points, double most, double uncounted = 0) const {
    auto contact = group_.contacts().front();
    contact.uncounted = uncounted;
    detail::limit_energy<Dim>(group_, contact, bodies_, points, most);
    return contact.uncounted;
  }

 private:
  [[nodiscard]] static auto facet() {
    if constexpr (Dim == 2)
      return Segment{{0, -0.5}, {0, 0.7}};
    else
      return SpatialFacet{
          {Vec3(0, -0.5, -0.4), Vec3(0, 0.7, -0.3), Vec3(0, 0.6, 0.5), Vec3(0, -0.1, 0.8)}};
  }
  void move(double size, Random& random) {
    Pose<Dim>& pose = bodies_[1].pose;
    for (int k = 0; k < Dim; ++k) pose.position[k] += size * (random.uniform() - 0.55);
    Spin<Dim> turn;
    for (int k = 0; k < turn.size(); ++k) turn[k] = size * (2 * random.uniform() - 1);
    pose.rotation = rotation_by(turn) * pose.rotation;
  }

  Group group_;
  std::vector<MovingBody<Dim>> bodies_{2};
};

/// Contacts of which an update finds another area, pressed farther in, and sheared by what it kept.
/// @param from  part of the energy from which on it is continuous as they are eased [-]
template <int Dim, class Law>
void check(const Law& law, double from) {
  Random random(3901, Dim), opening(3902, Dim);
  int eased = 0, counted_again = 0;
  for (int n = 0; n < 200; ++n) {
    CAPTURE(n);
    const double stress = n % 3 == 0 ? 0.0 : 2e6 * random.uniform(),
                 size = 1e-5 * std::pow(30, random.uniform());
    Joint<Dim, Law> joint(law, stress, size, random);
    auto found = joint.points();
    if constexpr (std::is_same_v<Law, BurgersJoint>)
      found = joint.points_with_other_histories(
          [&](auto& state) { state.delayed_slip[0] = size * random.uniform(); });
    const double area = 0.3 + 2 * random.uniform(), deeper = size * random.uniform();
    for (auto& p : found) {
      p.weight *= area;
      p.initial.normal *= area;
      p.initial.tangential *= 1 + random.uniform();
      p.zero[0] += deeper;
    }
    const double before = joint.energy(found);
    // A contact of which something is not counted, open at some points, and perhaps torn there.
    auto ajar = found;
    for (auto& p : ajar) p.zero[0] -= 2 * size * opening.uniform();
    for (const double part : {1e-3, 0.1, 1.0}) {
      CAPTURE(part);
      auto points = ajar;
      const double most = part * before;
      (void)joint.limit(points, most, 3 * size * opening.uniform());
      CHECK(joint.energy(points) <= std::max(most, joint.energy(ajar)) + 1e-11 * before);
    }
    for (const double part : {0.0, 1e-6, 0.3, 0.999, 1.0, 2.0}) {
      CAPTURE(part);
      const double most = part * before;
      auto points = found;
      const double uncounted = joint.limit(points, most);
      const double after = joint.energy(points);
      REQUIRE(std::isfinite(after));
      // Rounding of roots.
      CHECK(after <= most + 1e-11 * before);
      CHECK(uncounted >= 0);
      if (part >= 1) CHECK(after == before);
      // No more is taken than must be.
      if (part < 1 && part >= from) CHECK(after >= (1 - 1e-6) * most);
      eased += part < 1 && before > 0 ? 1 : 0;
      // Once more with the same: it stays, to the last bit.
      if (part == 0.3) {
        auto again = points;
        CHECK(joint.limit(again, joint.energy(points), uncounted) == uncounted);
        CHECK(joint.energy(again) == joint.energy(points));
        // It may hold more: it is let in as far as that goes.
        CHECK(joint.limit(again, most + 0.1 * before, uncounted) <= uncounted);
        CHECK(joint.energy(again) <= most + 0.1 * before + 1e-11 * before);
        // What has parted touches where it touches: nothing is left out of the overlap any more.
        auto parted = points;
        for (auto& p : parted) p.zero[0] -= 1;
        const bool has_let_go = joint.energy(parted) == 0;
        if (has_let_go) CHECK(joint.limit(parted, 0, uncounted) == 0);
        // What is counted as farther apart than it need be comes to touch again.
        auto touching = found;
        if (const double way = joint.limit(touching, 0); has_let_go && way > 0) {
          auto apart = found;
          for (auto& p : apart) p.zero[0] -= way + 1e-6;
          const double left = joint.limit(apart, 0, way + 1e-6);
          // The slip of one that dilates may lift it into contact before they touch.
          if constexpr (HasLift<Law, Dim>)
            CHECK((law.dilates() ? left >= way * (1 - 1e-6)
                                 : left == voussoir_test::near(way).epsilon(1e-6)));
          else
            CHECK(left == voussoir_test::near(way).epsilon(1e-6));
          CHECK(joint.energy(apart) == 0);
        }
        counted_again += joint.energy(again) > (1 + 1e-3) * most ? 1 : 0;
      }
    }
  }
  CHECK(eased > 400);
  CHECK(counted_again > 5);
}

template <class Law>
void check_in_both(const Law& law, double from = 0) {
  check<2>(law, from);
  check<3>(law, from);
}

}  // namespace

TEST_SUITE("model/limited_energy") {
  TEST_CASE("of Coulomb joints, in situ or not") { check_in_both(CoulombJoint({k_n, 1e9, 0.6})); }
  TEST_CASE("of joints with cohesion, bonds and dilation") {
    // Cohesion is lost at once where the joint opens: no part is met from below.
    constexpr double from = 1;
    MohrCoulombJoint::Params params{.joint_normal_stiffness = k_n,
                                    .joint_shear_stiffness = 1e9,
                                    .friction_angle = 35 * degree,
                                    .cohesion = 2e5,
                                    .residual_cohesion = 5e4};
    check_in_both(MohrCoulombJoint(params), from);
    params.tensile_strength = 2e5;
    check_in_both(MohrCoulombJoint(params), from);
    params.dilation_angle = 10 * degree;
    params.dilation_limit = 5e-3;
    check_in_both(MohrCoulombJoint(params), from);
  }
  TEST_CASE("of joints whose delayed slip holds energy that no motion gives back") {
    check_in_both(BurgersJoint({.joint_normal_stiffness = k_n,
                                .joint_shear_stiffness = 1e9,
                                .friction_angle = 0.6,
                                .maxwell_viscosity = 1e15,
                                .kelvin_stiffness = 5e8,
                                .kelvin_viscosity = 1e14}));
  }
  TEST_CASE("of rough joints") {
    check_in_both(
        BartonBandisJoint({.roughness = 10,
                           .wall_strength = 100e6,
                           .residual_friction_angle = 28 * degree,
                           .initial_stiffness = 20e9,
                           .maximum_closure = 2e-4,
                           .damage_coefficient = std::numeric_limits<double>::infinity()}));
  }
}

}  // namespace limited_energy_test
