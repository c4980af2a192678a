// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/joint.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/orientation.hpp>

namespace voussoir {

/// Joints without end.
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

/// A family of joints of similar orientation in space, as borehole and scanline surveys describe
/// it. Exactly one of `spacing`, `area_per_volume` and `count_per_volume` says how many there are;
/// orientations scatter in one of two ways, or not at all.
struct SpatialJointSet {
  std::string name;
  double dip;            ///< mean, from the horizontal [rad], 0 to pi/2
  double dip_direction;  ///< mean, azimuth clockwise from North (y) [rad], 0 to 2 pi

  double dip_deviation = 0;            ///< standard deviation, normal [rad], >= 0
  double dip_direction_deviation = 0;  ///< standard deviation, normal [rad], >= 0
  double fisher_concentration = 0;     ///< kappa of Fisher's distribution [-], > 0; 0: none

  double spacing = 0;           ///< along the mean normal [m], > 0
  double area_per_volume = 0;   ///< P32, volumetric intensity [m^2/m^3], > 0
  double count_per_volume = 0;  ///< P30, joint centres per volume [1/m^3], > 0; not if persistent

  JointShape shape = PersistentJoints{};

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
  return 0.5 * std::hypot(sides.strike_length, sides.dip_length);
}

/// A random orientation about the mean of the set. The numbers drawn are the same on every
/// platform; the sine, cosine and logarithm are the mathematical library's, so that the last digit
/// may not be.
///
/// Fisher's distribution has density ~ exp(kappa cos theta) sin theta in the angle theta from the
/// mean normal; its distribution function is inverted (Fisher, Lewis & Embleton 1987, section
/// 3.6.2), written so that neither a small nor a large kappa cancels.
[[nodiscard]] inline Orientation random_orientation(const SpatialJointSet& set, Random& random) {
  const Orientation mean{set.dip, set.dip_direction};
  if (!(set.fisher_concentration > 0)) {
    Orientation plane = mean;
    if (set.dip_deviation > 0) plane.dip += set.dip_deviation * random.normal();
    if (set.dip_direction_deviation > 0)
      plane.dip_direction += set.dip_direction_deviation * random.normal();
    return plane;
  }
  const double kappa = set.fisher_concentration;
  const double versine = -std::log1p(random.uniform() * std::expm1(-2 * kappa)) / kappa;
  const double sine = std::sqrt(std::max(0.0, versine * (2 - versine)));
  const double azimuth = 2 * std::numbers::pi * random.uniform();
  const Vec3 normal =
      (1 - versine) * upward_normal(mean) +
      sine * (std::cos(azimuth) * dip_vector(mean) + std::sin(azimuth) * strike_vector(mean));
  return orientation_of(normal);
}

/// A joint of the set's shape about `centre`.
[[nodiscard]] inline JointPlane joint_at(const SpatialJointSet& set, const Vec3& centre,
                                         const Orientation& plane) {
  const Vec3 normal = upward_normal(plane);
  if (const auto* disc = std::get_if<DiscJoints>(&set.shape))
    return joint_disc(centre, normal, disc->diameter);
  if (const auto* sides = std::get_if<RectangularJoints>(&set.shape))
    return joint_rectangle(centre, 0.5 * sides->dip_length * dip_vector(plane),
                           0.5 * sides->strike_length * strike_vector(plane));
  return unbounded_joint(centre, normal);
}

/// True if some of the joint lies inside the domain.
[[nodiscard]] inline bool reaches(const JointPlane& joint, const Domain<3>& domain) {
  const Vec3 centre = 0.5 * (domain.low + domain.high);
  std::optional<JointPlane> inside = covering(joint, centre, domain.diameter());
  for (int axis = 0; axis < 3; ++axis)
    for (const HalfSpace<3>& side : {HalfSpace<3>{Vec3::Unit(axis), domain.high[axis]},
                                     HalfSpace<3>{-Vec3::Unit(axis), -domain.low[axis]}})
      if (inside) inside = split(std::move(*inside), side, domain.tolerance()).below;
  return inside.has_value();
}

}  // namespace detail

inline void SpatialJointSet::check() const {
  const auto rule = [this](bool holds, const char* what, double value, const char* text) {
    if (!holds)
      throw InvalidInput("joint set " + name + ": " + what + " = " + message_number(value) +
                         " must be " + text);
  };
  constexpr double pi = std::numbers::pi, degrees = 180 / pi;
  rule(dip >= 0 && dip <= 0.5 * pi, "dip", dip * degrees, "0 to 90 deg");
  rule(dip_direction >= 0 && dip_direction <= 2 * pi, "dip_direction", dip_direction * degrees,
       "0 to 360 deg");
  const auto not_negative = [&rule](const char* what, double value) {
    rule(value >= 0 && std::isfinite(value), what, value, ">= 0 and finite");
  };
  not_negative("dip_deviation", dip_deviation);
  not_negative("dip_direction_deviation", dip_direction_deviation);
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
  if (std::holds_alternative<PersistentJoints>(shape))
    rule(!(count_per_volume > 0), "count_per_volume", count_per_volume,
         "0 for joints without end, which have no centre: give spacing or area_per_volume");
}

/// Joints of one set that reach the domain.
///
/// Joints of finite size have centres uniform over the domain and as far around it as a joint
/// reaches, so that the area of joints per volume is as given up to the sides, where centres inside
/// alone would leave too little. Their number is the expected one, rounded; a spacing s and a joint
/// area A amount to 1 / (s A) centres per volume, P32 to P32 / A.
///
/// Joints without end are equidistant with a random first one if a spacing is given, and placed
/// independently of each other (uniform along the mean normal) if P32 is.
///
/// @param index  of the set: its stream of random numbers, and the label of its joints
/// @throws InvalidInput  see SpatialJointSet::check
///
/// Source: Dershowitz & Herda (1992), Interpretation of fracture spacing and intensity (P30, P32).
[[nodiscard]] inline std::vector<SpatialJoint> generate(const SpatialJointSet& set, int index,
                                                        const Domain<3>& domain,
                                                        std::uint64_t seed) {
  set.check();
  Random random(seed, static_cast<std::uint64_t>(index) + 1);
  std::vector<SpatialJoint> joints;
  const auto add = [&](const Vec3& centre, const Orientation& plane) {
    JointPlane joint = detail::joint_at(set, centre, plane);
    if (detail::reaches(joint, domain)) joints.push_back({std::move(joint), index});
  };
  if (std::holds_alternative<PersistentJoints>(set.shape)) {
    const Vec3 centre = 0.5 * (domain.low + domain.high);
    const double reach = 0.5 * domain.diameter();
    if (set.spacing > 0) {
      const Vec3 normal = upward_normal({set.dip, set.dip_direction});
      const double first = -reach + random.uniform() * set.spacing;
      const auto count = static_cast<int>(std::floor((reach - first) / set.spacing)) + 1;
      for (int k = 0; k < count; ++k)
        add(centre + (first + k * set.spacing) * normal, detail::random_orientation(set, random));
    } else {
      // A plane at a uniform offset within the reach has on average the area volume / (2 reach),
      // whatever its orientation.
      const auto count = static_cast<int>(std::llround(set.area_per_volume * 2 * reach));
      for (int k = 0; k < count; ++k) {
        const Orientation plane = detail::random_orientation(set, random);
        add(centre + reach * (2 * random.uniform() - 1) * upward_normal(plane), plane);
      }
    }
    return joints;
  }
  const double per_volume = set.count_per_volume > 0 ? set.count_per_volume
                            : set.area_per_volume > 0
                                ? set.area_per_volume / detail::joint_area(set)
                                : 1 / (set.spacing * detail::joint_area(set));
  const Vec3 reach = Vec3::Constant(detail::joint_reach(set));
  const Vec3 low = domain.low - reach, size = domain.size() + 2 * reach;
  const auto count = static_cast<std::size_t>(std::llround(per_volume * size.prod()));
  for (std::size_t k = 0; k < count; ++k) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    add(low + size.cwiseProduct(Vec3(x, y, z)), detail::random_orientation(set, random));
  }
  return joints;
}

/// The joints of all sets in one random order. Slicing set by set would be wrong: the first set
/// would use up the block sizes that the minimum allows.
[[nodiscard]] inline std::vector<SpatialJoint> joint_network(
    const std::vector<SpatialJointSet>& sets, const Domain<3>& domain, std::uint64_t seed) {
  return detail::shuffled_joints(sets, domain, seed);
}

}  // namespace voussoir
