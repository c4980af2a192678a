// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/joint_plane.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/geometry/tunnel_axis.hpp>

namespace voussoir {

/// An opening in 3-D: a section of any outline, drawn along a straight axis.
///
/// A tunnel, a heading, a cross-drift, a shaft, a slot. Of unlimited length it goes through all the
/// rock; one that ends has a face there, at right angles to its axis. Where it leaves the domain
/// rock ends: a section that reaches beyond the surface is an open cut.
class PrismaticOpening {
 public:
  static constexpr double endless = std::numeric_limits<double>::infinity();

  /// Along y: the section's x and y are x and z in 3-D.
  /// @param from, to  where it begins and ends along its axis [m]
  /// @throws InvalidInput  from is not below to
  explicit PrismaticOpening(SimplePolygon section, double from = -endless, double to = endless)
      : PrismaticOpening(std::move(section), TunnelAxis(), from, to) {}
  /// Along any axis; the origin of the section lies on it.
  PrismaticOpening(SimplePolygon section, const TunnelAxis& axis, double from = -endless,
                   double to = endless)
      : section_(std::move(section)), axis_(axis), from_(from), to_(to) {
    require(from < to, "beginning of the tunnel along its axis", from, "below its end");
  }

  [[nodiscard]] const SimplePolygon& section() const { return section_; }
  [[nodiscard]] const TunnelAxis& axis() const { return axis_; }
  [[nodiscard]] double from() const { return from_; }
  [[nodiscard]] double to() const { return to_; }
  [[nodiscard]] double length() const { return to_ - from_; }

  /// A point, or a displacement, as it is seen in the section.
  [[nodiscard]] Vec2 across(const Vec3& p) const {
    const Vec3 seen = axis_.local(p);
    return {seen.x(), seen.y()};
  }
  [[nodiscard]] Vec2 across_direction(const Vec3& d) const {
    const Vec3 seen = axis_.local_direction(d);
    return {seen.x(), seen.y()};
  }
  /// Place of a point along the axis [m].
  [[nodiscard]] double along(const Vec3& p) const { return axis_.local(p).z(); }
  /// The point at a place of the section, `s` along the axis [m].
  [[nodiscard]] Vec3 in_space(const Vec2& p, double s) const { return axis_.point(p, s); }

  [[nodiscard]] bool contains(const Vec3& p) const {
    const Vec3 seen = axis_.local(p);
    return seen.z() > from_ && seen.z() < to_ && section_.contains({seen.x(), seen.y()});
  }
  /// The box around it in the coordinates of its axis (`TunnelAxis::local`).
  [[nodiscard]] std::pair<Vec3, Vec3> local_box() const;

  /// Pieces of its surface: one for every edge of the section, then the faces at its ends.
  [[nodiscard]] std::size_t size() const { return section_.size() + ends().size(); }
  /// Piece k as a polygon that covers it, at most `reach` to both sides of the axis' origin. The
  /// half space of its plane is what lies to the left of the edge, as in the section: inside the
  /// opening next to it.
  [[nodiscard]] JointPlane side(std::size_t k, double reach) const;

 private:
  [[nodiscard]] std::vector<double> ends() const {
    std::vector<double> found;
    for (const double s : {from_, to_})
      if (std::isfinite(s)) found.push_back(s);
    return found;
  }

  SimplePolygon section_;
  TunnelAxis axis_;
  double from_, to_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE auto PrismaticOpening::local_box() const -> std::pair<Vec3, Vec3> {
  Vec2 low = section_.vertices().front(), high = low;
  for (const Vec2& v : section_.vertices()) {
    low = smaller_of(low, v);
    high = larger_of(high, v);
  }
  return {Vec3(low.x(), low.y(), from_), Vec3(high.x(), high.y(), to_)};
}

VOUSSOIR_INLINE auto PrismaticOpening::side(std::size_t k, double reach) const -> JointPlane {
  const double from = std::max(from_, -reach), to = std::min(to_, reach);
  if (k < section_.size()) {
    const Segment edge = section_.edge(k);
    const HalfSpace<2> line = left_of(edge.start, edge.end);
    const Vec3 normal = axis_.direction(line.normal);
    return {{normal, line.offset + dot_product(normal, axis_.origin())},
            {in_space(edge.start, from), in_space(edge.start, to), in_space(edge.end, to),
             in_space(edge.end, from)}};
  }
  // The rectangle around the section: what it cuts beside the face stays one body.
  const auto [low, high] = local_box();
  const double s = ends()[k - section_.size()];
  return {{axis_.along(), s + dot_product(axis_.along(), axis_.origin())},
          {in_space({low.x(), low.y()}, s), in_space({low.x(), high.y()}, s),
           in_space({high.x(), high.y()}, s), in_space({high.x(), low.y()}, s)}};
}

#endif

}  // namespace voussoir
