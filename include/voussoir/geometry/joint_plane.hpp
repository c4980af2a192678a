// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/repeatable.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/tangent_basis.hpp>

namespace voussoir {

/// The extent of a joint in 3-D: a convex polygon in its plane, or the whole plane.
struct JointPlane {
  HalfSpace<3> plane;         ///< its normal points out of the rock below the joint
  std::vector<Vec3> corners;  ///< anticlockwise seen against the normal [m]; none: without end

  [[nodiscard]] bool is_unbounded() const { return corners.empty(); }

  /// Area [m^2]; infinite for a fully persistent joint.
  [[nodiscard]] double area() const {
    if (is_unbounded()) return std::numeric_limits<double>::infinity();
    double doubled = 0;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      doubled += dot_product(
          plane.normal, cross(Vec3(corners[k] - corners[0]), Vec3(corners[k + 1] - corners[0])));
    return 0.5 * doubled;
  }
};

/// The plane through `point` without end.
/// @param normal  of any length > 0
/// @throws InvalidInput  not finite, or a normal of no length
[[nodiscard]] VOUSSOIR_INLINE JointPlane unbounded_joint(const Vec3& point, const Vec3& normal);

/// Rectangle with the half sides `along` and `across`, which must be perpendicular [m]; its normal
/// is along x across.
/// @throws InvalidInput  not finite, no area, or sides that are not perpendicular
[[nodiscard]] VOUSSOIR_INLINE JointPlane joint_rectangle(const Vec3& centre, const Vec3& along,
                                                         const Vec3& across);

/// Corners of the polygon that stands for a disc.
inline constexpr int disc_corners = 32;
/// Circumscribed radius of that polygon over the radius of the disc: both have the same area.
[[nodiscard]] inline double disc_reach() {
  const double step = 2 * std::numbers::pi / disc_corners;
  return std::sqrt(step / repeatable::sine(step));
}

/// A disc as a regular polygon of the same area, so that the area of joints per volume is that of
/// discs; its corners lie 0.32 % outside the circle, the middles of its sides 0.16 % inside.
/// @param diameter  [m]
/// @throws InvalidInput  not finite, a diameter that is not > 0, a normal of no length
[[nodiscard]] VOUSSOIR_INLINE JointPlane joint_disc(const Vec3& centre, const Vec3& normal,
                                                    double diameter);

/// A joint of any convex outline, as a survey gives it.
/// @param corners  in either direction; the first must not be repeated at the end [m]
/// @throws InvalidInput  fewer than 3, not finite, no area, a corner further than 1e-6 of the
///                       joint's size from the common plane, or a corner that is not convex
[[nodiscard]] VOUSSOIR_INLINE JointPlane joint_polygon(std::vector<Vec3> corners);

/// The part of a fully persistent joint that covers the ball given; other joints as they are.
[[nodiscard]] inline JointPlane covering(const JointPlane& joint, const Vec3& centre,
                                         double radius) {
  if (!joint.is_unbounded()) return joint;
  const Vec3 foot = centre - joint.plane.distance(centre) * joint.plane.normal;
  const TangentBasis<3> axes = radius * tangent_basis(joint.plane.normal);
  const Vec3 u = column(axes, 0), v = column(axes, 1);
  return {joint.plane, {foot - u - v, foot + u - v, foot + u + v, foot - u + v}};
}

/// The parts of a joint on the two sides of a plane.
struct JointPlaneSplit {
  std::optional<JointPlane> below, above;  ///< inside and outside the half space
};

/// Clips a bounded joint by a plane. The joint is passed on where it lies on one side.
/// @param tolerance  a part that reaches less far than this from the plane is not counted [m]
/// @cost  linear in the corners; allocates only where the plane crosses the joint
[[nodiscard]] VOUSSOIR_INLINE JointPlaneSplit split(JointPlane&& joint, const HalfSpace<3>& side,
                                                    double tolerance);
[[nodiscard]] inline JointPlaneSplit split(const JointPlane& joint, const HalfSpace<3>& side,
                                           double tolerance) {
  return split(JointPlane(joint), side, tolerance);
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE JointPlane unbounded_joint(const Vec3& point, const Vec3& normal) {
  const double length = repeatable::norm<3>(normal);
  if (!(is_finite(point) && std::isfinite(length) && length > 0))
    throw InvalidInput("joint plane through " + text_of<3>(point) +
                       " m: needs a finite point and a normal of length > 0, not " +
                       text_of<3>(normal));
  const Vec3 unit = normal / length;
  return {{unit, repeatable::dot<3>(unit, point)}, {}};
}

VOUSSOIR_INLINE JointPlane joint_rectangle(const Vec3& centre, const Vec3& along,
                                           const Vec3& across) {
  JointPlane joint = unbounded_joint(centre, repeatable::cross(along, across));
  if (!(std::abs(dot_product(along, across)) <= 1e-9 * length_of(along) * length_of(across)))
    throw InvalidInput("joint rectangle at " + text_of<3>(centre) +
                       " m: its sides must be perpendicular");
  joint.corners = {centre - along - across, centre + along - across, centre + along + across,
                   centre - along + across};
  return joint;
}

VOUSSOIR_INLINE JointPlane joint_disc(const Vec3& centre, const Vec3& normal, double diameter) {
  JointPlane joint = unbounded_joint(centre, normal);
  if (!(diameter > 0 && std::isfinite(diameter)))
    throw InvalidInput("joint disc at " + text_of<3>(centre) + " m: diameter " +
                       message_number(diameter) + " m must be > 0 and finite");
  using namespace repeatable;
  // As tangent_basis does it.
  const Vec3& n = joint.plane.normal;
  const Vec3 s(2.0 / 7, 3.0 / 7, 6.0 / 7), u(6.0 / 7, 2.0 / 7, -3.0 / 7);
  const Vec3 h = sum<3>(s, n);
  const double squared = dot<3>(h, h);
  Vec3 first = squared > 0 ? along<3>(u, -2 * dot<3>(h, u) / squared, h) : u;
  first = along<3>(first, -dot<3>(n, first), n);
  first /= norm<3>(first);
  const Vec3 second = repeatable::cross(n, first);
  static const std::array<Vec2, disc_corners> circle = [] {
    std::array<Vec2, disc_corners> points;
    for (int k = 0; k < disc_corners; ++k) {
      const auto [y, x] = sine_cosine(2 * std::numbers::pi * k / disc_corners);
      points[static_cast<std::size_t>(k)] = Vec2(x, y);
    }
    return points;
  }();
  const double radius = 0.5 * diameter * disc_reach();
  joint.corners.reserve(circle.size());
  for (const Vec2& at : circle) {
    const Vec3 out = along<3>(scaled<3>(at.x(), first), at.y(), second);
    joint.corners.push_back(along<3>(centre, radius, out));
  }
  return joint;
}

VOUSSOIR_INLINE JointPlane joint_polygon(std::vector<Vec3> corners) {
  const auto fail = [](std::size_t k, const char* rule) {
    throw InvalidInput("joint polygon: corner " + std::to_string(k) + " " + rule);
  };
  if (corners.size() < 3) throw InvalidInput("joint polygon: needs at least 3 corners");
  Vec3 area = zeros<Vec3>(), centre = zeros<Vec3>();
  double size = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (!is_finite(corners[k])) fail(k, "is not finite");
    centre += (corners[k] - corners[0]) / static_cast<double>(corners.size());
    size = std::fmax(size, length_of(corners[k] - corners[0]));
    if (k > 0)
      area += 0.5 * cross(Vec3(corners[k - 1] - corners[0]), Vec3(corners[k] - corners[0]));
  }
  if (!(length_of(area) > 1e-12 * size * size))
    throw InvalidInput("joint polygon: encloses no area");
  JointPlane joint = unbounded_joint(corners[0] + centre, area);
  double turning = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 in = corners[k] - corners[k == 0 ? corners.size() - 1 : k - 1];
    const Vec3 out = corners[(k + 1) % corners.size()] - corners[k];
    if (!(length_of(out) > 0)) fail(k, "is repeated");
    if (!(std::abs(joint.plane.distance(corners[k])) <= 1e-6 * size))
      fail(k, "is not in the plane");
    const double sine = dot_product(joint.plane.normal, cross(in, out));
    if (!(sine >= 0)) fail(k, "is not convex");
    turning += elementary::angle_of(sine, dot_product(in, out));
  }
  if (turning > 7) throw InvalidInput("joint polygon: the outline crosses itself");
  joint.corners = std::move(corners);
  return joint;
}

VOUSSOIR_INLINE JointPlaneSplit split(JointPlane&& joint, const HalfSpace<3>& side,
                                      double tolerance) {
  VOUSSOIR_ASSERT(!joint.is_unbounded(), "a fully persistent joint is covered before it is split");
  const auto snapped = [&](const Vec3& corner) {
    const double d = side.distance(corner);
    return std::abs(d) <= tolerance ? 0.0 : d;
  };
  bool reaches_below = false, reaches_above = false;
  for (const Vec3& corner : joint.corners) {
    const double d = snapped(corner);
    reaches_below = reaches_below || d < 0;
    reaches_above = reaches_above || d > 0;
  }
  JointPlaneSplit parts;
  if (reaches_below && reaches_above) {
    JointPlane below{joint.plane, {}}, above{joint.plane, {}};
    below.corners.reserve(joint.corners.size() + 1);
    above.corners.reserve(joint.corners.size() + 1);
    const Vec3* from = &joint.corners.back();
    double here = snapped(*from);
    for (const Vec3& to : joint.corners) {
      const double there = snapped(to);
      if (here * there < 0) {
        const Vec3 crossing = *from + (here / (here - there)) * (to - *from);
        below.corners.push_back(crossing);
        above.corners.push_back(crossing);
      }
      if (there <= 0) below.corners.push_back(to);
      if (there >= 0) above.corners.push_back(to);
      from = &to;
      here = there;
    }
    VOUSSOIR_ASSERT(below.corners.size() >= 3 && above.corners.size() >= 3,
                    "both parts of a joint have an area");
    parts.below = std::move(below);
    parts.above = std::move(above);
  } else if (reaches_below) {
    parts.below = std::move(joint);
  } else if (reaches_above) {
    parts.above = std::move(joint);
  }
  return parts;
}

#endif

}  // namespace voussoir
