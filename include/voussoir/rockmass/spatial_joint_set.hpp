// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/repeatable.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/joint.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/orientation.hpp>
#include <voussoir/rockmass/spacing_law.hpp>

namespace voussoir {

/// Fully persistent joints.
struct PersistentJoints {};
/// Joints as circular discs.
struct DiscJoints {
  double diameter;  ///< [m], > 0
};
/// Joints as rectangles with two level sides.
struct RectangularJoints {
  double strike_length;  ///< level side [m], > 0
  double dip_length;     ///< side down the dip [m], > 0
};
using JointShape = std::variant<PersistentJoints, DiscJoints, RectangularJoints>;

/// A family of joints of similar orientation in 3-D, as borehole and scanline surveys describe
/// it. Exactly one of `spacing`, `area_per_volume` and `count_per_volume` says how many there are;
/// orientations scatter in one of two ways, or not at all.
struct SpatialJointSet {
  std::string name;
  double dip;            ///< mean, from the horizontal [rad], 0 to pi/2
  double dip_direction;  ///< mean, azimuth clockwise from North (y) [rad], 0 to 2 pi

  double dip_deviation = 0;            ///< standard deviation, normal [rad], 0 to pi/4
  double dip_direction_deviation = 0;  ///< standard deviation, normal [rad], 0 to pi
  double fisher_concentration = 0;     ///< kappa of Fisher's distribution [-], > 0; 0: none

  double spacing = 0;           ///< along the mean normal [m], > 0
  double area_per_volume = 0;   ///< P32, volumetric intensity [m^2/m^3], > 0
  double count_per_volume = 0;  ///< P30, joint centres per volume [1/m^3], > 0; not if persistent

  JointShape shape = PersistentJoints{};
  SpacingLaw spacing_law = SpacingLaw::fixed;  ///< of persistent joints, by their spacing
  double spacing_deviation =
      0;  ///< lognormal: standard deviation of the spacing over `spacing` [-]

  /// @throws InvalidInput  naming the set, the value and the rule
  void check() const;
};

namespace detail {

[[nodiscard]] inline double joint_area(const SpatialJointSet& set) {
  if (const auto* disc = std::get_if<DiscJoints>(&set.shape))
    return 0.25 * std::numbers::pi * disc->diameter * disc->diameter;
  const auto& sides = std::get<RectangularJoints>(set.shape);
  return sides.strike_length * sides.dip_length;
}

/// Farthest point of a joint from its centre [m].
[[nodiscard]] inline double joint_reach(const SpatialJointSet& set) {
  if (const auto* disc = std::get_if<DiscJoints>(&set.shape))
    return 0.5 * disc->diameter * disc_reach();
  const auto& sides = std::get<RectangularJoints>(set.shape);
  return 0.5 * repeatable::norm<2>(Vec2(sides.strike_length, sides.dip_length));
}

/// The directions of a plane in 3-D.
struct PlaneFrame {
  Vec3 normal;  ///< upward
  Vec3 down;    ///< down the dip
  Vec3 strike;  ///< level, the plane falling to its right
};
[[nodiscard]] inline PlaneFrame frame_of(const Orientation& plane) {
  return {upward_normal(plane), dip_vector(plane), strike_vector(plane)};
}

/// A random orientation about the mean of the set, the same on every platform to the last bit.
///
/// Fisher's distribution has density ~ exp(kappa cos theta) sin theta in the angle theta from the
/// mean normal; its distribution function is inverted (Fisher, Lewis & Embleton 1987, section
/// 3.6.2), written so that neither a small nor a large kappa cancels.
[[nodiscard]] VOUSSOIR_INLINE PlaneFrame random_frame(const SpatialJointSet& set, Random& random);

/// A joint of the set's shape about `centre`.
[[nodiscard]] VOUSSOIR_INLINE JointPlane joint_at(const SpatialJointSet& set, const Vec3& centre,
                                                  const PlaneFrame& plane);

/// True if some of the joint lies inside the domain, further than the tolerance.
[[nodiscard]] VOUSSOIR_INLINE bool reaches(const JointPlane& joint, const Domain<3>& domain);

}  // namespace detail

/// Joints of one set that reach the domain.
///
/// Joints of finite size have centres uniform over the domain and as far around it as a joint
/// reaches, so that the area of joints per volume is as given up to the sides, where centres inside
/// alone would leave too little. Their number is the expected one, rounded; a spacing s and a joint
/// area A amount to 1 / (s A) centres per volume, P32 to P32 / A.
///
/// Fully persistent joints are as far apart as `spacing_law` says if a spacing is given, and
/// placed independently of each other (uniform along the mean normal) if P32 is.
///
/// @param index  of the set: its stream of random numbers, and the label of its joints
/// @param progress  asked now and then whether to go on
/// @throws InvalidInput  see SpatialJointSet::check
/// @throws Stopped
///
/// Source: Dershowitz & Herda (1992), Interpretation of fracture spacing and intensity (P30, P32).
[[nodiscard]] VOUSSOIR_INLINE std::vector<SpatialJoint> generate(const SpatialJointSet& set,
                                                                 int index, const Domain<3>& domain,
                                                                 std::uint64_t seed,
                                                                 const Progress& progress = {});

/// The joints of all sets in one random order. Slicing set by set would be wrong: the first set
/// would use up the block sizes that the minimum allows.
[[nodiscard]] inline std::vector<SpatialJoint> joint_network(
    const std::vector<SpatialJointSet>& sets, const Domain<3>& domain, std::uint64_t seed,
    const Progress& progress = {}) {
  return detail::shuffled_joints(sets, domain, seed, progress);
}

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE PlaneFrame random_frame(const SpatialJointSet& set, Random& random) {
  using namespace repeatable;
  Orientation plane{set.dip, set.dip_direction};
  if (!(set.fisher_concentration > 0)) {
    if (set.dip_deviation > 0) plane.dip += product(set.dip_deviation, random.normal());
    if (set.dip_direction_deviation > 0)
      plane.dip_direction += product(set.dip_direction_deviation, random.normal());
    return frame_of(plane);
  }
  const PlaneFrame mean = frame_of(plane);
  const double kappa = set.fisher_concentration;
  const double versine =
      -repeatable::log1p(product(random.uniform(), repeatable::expm1(-2 * kappa))) / kappa;
  const double radius = std::sqrt(std::max(0.0, product(versine, 2 - versine)));
  const auto [aside, down] = sine_cosine(2 * std::numbers::pi * random.uniform());
  const Vec3 level = along<3>(scaled<3>(down, mean.down), aside, mean.strike);
  Vec3 normal = along<3>(scaled<3>(1 - versine, mean.normal), radius, level);
  if (normal.z() < 0) normal = -normal;
  normal /= norm<3>(normal);
  const double slope = norm<2>(Vec2(normal.x(), normal.y()));  // the sine of the dip
  if (!(slope > 0)) return frame_of({0, 0});
  const double east = normal.x() / slope, north = normal.y() / slope;
  return {
      normal, {product(normal.z(), east), product(normal.z(), north), -slope}, {-north, east, 0}};
}

VOUSSOIR_INLINE JointPlane joint_at(const SpatialJointSet& set, const Vec3& centre,
                                    const PlaneFrame& plane) {
  using repeatable::scaled;
  if (const auto* disc = std::get_if<DiscJoints>(&set.shape))
    return joint_disc(centre, plane.normal, disc->diameter);
  if (const auto* sides = std::get_if<RectangularJoints>(&set.shape))
    return joint_rectangle(centre, scaled<3>(0.5 * sides->dip_length, plane.down),
                           scaled<3>(0.5 * sides->strike_length, plane.strike));
  return unbounded_joint(centre, plane.normal);
}

VOUSSOIR_INLINE bool reaches(const JointPlane& joint, const Domain<3>& domain) {
  using namespace repeatable;
  const double tolerance = domain.tolerance();
  if (joint.is_unbounded()) {
    const Vec3 centre = 0.5 * (domain.low + domain.high), half = 0.5 * domain.size();
    const double distance = dot<3>(joint.plane.normal, centre) - joint.plane.offset;
    return std::abs(distance) < dot<3>(magnitudes(joint.plane.normal), half) - tolerance;
  }
  // Clipped by one side of the domain after the other.
  std::vector<Vec3> corners = joint.corners, inside;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool low : {true, false}) {
      const auto beyond = [&](const Vec3& p) {
        const double d = low ? domain.low[axis] - p[axis] : p[axis] - domain.high[axis];
        return std::abs(d) <= tolerance ? 0.0 : d;
      };
      inside.clear();
      bool any = false;
      const Vec3* from = &corners.back();
      double here = beyond(*from);
      for (const Vec3& to : corners) {
        const double there = beyond(to);
        if ((here < 0 && there > 0) || (here > 0 && there < 0))
          inside.push_back(along<3>(*from, here / (here - there), to - *from));
        if (there <= 0) inside.push_back(to);
        any = any || there < 0;
        from = &to;
        here = there;
      }
      if (!any) return false;
      corners.swap(inside);
    }
  return true;
}

}  // namespace detail

VOUSSOIR_INLINE void SpatialJointSet::check() const {
  const auto rule = [this](bool holds, const char* what, double value, const char* text) {
    if (!holds)
      throw InvalidInput("joint set " + name + ": " + what + " = " + message_number(value) +
                         " must be " + text);
  };
  constexpr double pi = std::numbers::pi;
  const auto angle = [this](const char* what, double value, double most) {
    require_angle("joint set " + name + ": " + what, value, 0, most);
  };
  if (dip > 0.5 * pi && dip <= pi && dip_direction >= 0 && dip_direction <= 2 * pi) {
    const Orientation same = upright({dip, dip_direction});
    throw InvalidInput(
        message({"joint set ", name, ": dip = ", dip, " rad (", dip * 180 / pi,
                 " deg): must be 0 to 1.5708 rad (0 to 90 deg); the same plane dips ",
                 same.dip * 180 / pi, " deg towards ", same.dip_direction * 180 / pi, " deg"}));
  }
  angle("dip", dip, 0.5 * pi);
  angle("dip_direction", dip_direction, 2 * pi);
  angle("dip_deviation", dip_deviation, 0.25 * pi);
  angle("dip_direction_deviation", dip_direction_deviation, pi);
  const auto not_negative = [&rule](const char* what, double value) {
    rule(value >= 0 && std::isfinite(value), what, value, ">= 0 and finite");
  };
  not_negative("fisher_concentration", fisher_concentration);
  rule(!(fisher_concentration > 0 && (dip_deviation > 0 || dip_direction_deviation > 0)),
       "fisher_concentration", fisher_concentration,
       "0 where deviations of dip or dip direction are given: one kind of scatter");
  not_negative("spacing", spacing);
  not_negative("area_per_volume", area_per_volume);
  not_negative("count_per_volume", count_per_volume);
  if ((spacing > 0) + (area_per_volume > 0) + (count_per_volume > 0) != 1)
    throw InvalidInput("joint set " + name + ": spacing = " + message_number(spacing) +
                       ", area_per_volume = " + message_number(area_per_volume) +
                       ", count_per_volume = " + message_number(count_per_volume) +
                       ": exactly one must be > 0");
  const auto length = [&rule](const char* what, double value) {
    rule(value > 0 && std::isfinite(value), what, value, "> 0 and finite");
  };
  if (const auto* disc = std::get_if<DiscJoints>(&shape)) length("diameter", disc->diameter);
  if (const auto* sides = std::get_if<RectangularJoints>(&shape)) {
    length("strike_length", sides->strike_length);
    length("dip_length", sides->dip_length);
  }
  detail::check_spacing_law(spacing_law, spacing_deviation,
                            spacing > 0 && std::holds_alternative<PersistentJoints>(shape),
                            "joint set " + name + ": ");
  if (std::holds_alternative<PersistentJoints>(shape))
    rule(!(count_per_volume > 0), "count_per_volume", count_per_volume,
         "0 for fully persistent joints, which have no centre: give spacing or area_per_volume");
}

VOUSSOIR_INLINE std::vector<SpatialJoint> generate(const SpatialJointSet& set, int index,
                                                   const Domain<3>& domain, std::uint64_t seed,
                                                   const Progress& progress) {
  using repeatable::along, repeatable::product;
  set.check();
  StopCheck stop(progress);
  Random random(seed, static_cast<std::uint64_t>(index) + 1);
  std::vector<SpatialJoint> joints;
  const auto add = [&](const Vec3& centre, const detail::PlaneFrame& plane) {
    stop();
    JointPlane joint = detail::joint_at(set, centre, plane);
    if (detail::reaches(joint, domain)) joints.push_back({std::move(joint), index});
  };
  if (std::holds_alternative<PersistentJoints>(set.shape)) {
    const Vec3 centre = 0.5 * (domain.low + domain.high);
    const double reach = 0.5 * domain.diameter();
    if (set.spacing > 0) {
      const Vec3 normal = upward_normal({set.dip, set.dip_direction});
      for (const double place :
           detail::joint_places(set.spacing_law, set.spacing, set.spacing_deviation, reach, random))
        add(along<3>(centre, place, normal), detail::random_frame(set, random));
    } else {
      // A plane at a uniform offset within the reach has on average the area volume / (2 reach),
      // whatever its orientation.
      const auto count = static_cast<int>(std::llround(set.area_per_volume * 2 * reach));
      for (int k = 0; k < count; ++k) {
        const detail::PlaneFrame plane = detail::random_frame(set, random);
        add(along<3>(centre, product(reach, 2 * random.uniform() - 1), plane.normal), plane);
      }
    }
    return joints;
  }
  const double per_volume = set.count_per_volume > 0 ? set.count_per_volume
                            : set.area_per_volume > 0
                                ? set.area_per_volume / detail::joint_area(set)
                                : 1 / (set.spacing * detail::joint_area(set));
  const Vec3 reach = all_entries<3>(detail::joint_reach(set));
  const Vec3 low = domain.low - reach, size = domain.size() + 2 * reach;
  const auto count = static_cast<std::size_t>(std::llround(per_volume * product_of_entries(size)));
  for (std::size_t k = 0; k < count; ++k) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    add(low + Vec3(product(size.x(), x), product(size.y(), y), product(size.z(), z)),
        detail::random_frame(set, random));
  }
  return joints;
}

#endif

}  // namespace voussoir
