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

namespace voussoir {

/// A tunnel in 3-D: a section of any outline, drawn along y.
///
/// The section's x and y are x and z in 3-D. A tunnel of unlimited length goes through all the
/// rock; one that ends has a face there.
class PrismaticOpening {
 public:
  static constexpr double endless = std::numeric_limits<double>::infinity();

  /// @param from, to  where it begins and ends along y [m]
  /// @throws InvalidInput  from is not below to
  explicit PrismaticOpening(SimplePolygon section, double from = -endless, double to = endless)
      : section_(std::move(section)), from_(from), to_(to) {
    require(from < to, "beginning of the tunnel along y", from, "below its end");
  }

  [[nodiscard]] const SimplePolygon& section() const { return section_; }
  [[nodiscard]] double from() const { return from_; }
  [[nodiscard]] double to() const { return to_; }

  /// A point of the section, and its place along the tunnel.
  [[nodiscard]] static Vec2 across(const Vec3& p) { return {p.x(), p.z()}; }
  [[nodiscard]] static Vec3 in_space(const Vec2& p, double y) { return {p.x(), y, p.y()}; }

  [[nodiscard]] bool contains(const Vec3& p) const {
    return p.y() > from_ && p.y() < to_ && section_.contains(across(p));
  }

  /// Pieces of its surface: one for every edge of the section, then the faces at its ends.
  [[nodiscard]] std::size_t size() const { return section_.size() + ends().size(); }
  /// Piece k as a polygon that covers it, at most `reach` long. The half space of its plane is what
  /// lies to the left of the edge, as in the section: inside the opening next to it.
  [[nodiscard]] JointPlane side(std::size_t k, double reach) const;

 private:
  [[nodiscard]] std::vector<double> ends() const {
    std::vector<double> found;
    for (const double y : {from_, to_})
      if (std::isfinite(y)) found.push_back(y);
    return found;
  }

  SimplePolygon section_;
  double from_, to_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE auto PrismaticOpening::side(std::size_t k, double reach) const -> JointPlane {
  const double from = std::max(from_, -reach), to = std::min(to_, reach);
  if (k < section_.size()) {
    const Segment edge = section_.edge(k);
    const HalfSpace<2> line = left_of(edge.start, edge.end);
    const Vec3 normal = in_space(line.normal, 0);
    return {{normal, line.offset},
            {in_space(edge.start, from), in_space(edge.start, to), in_space(edge.end, to),
             in_space(edge.end, from)}};
  }
  // The rectangle around the section: what it cuts beside the face stays one body.
  Vec2 low = section_.vertices().front(), high = low;
  for (const Vec2& v : section_.vertices()) {
    low = smaller_of(low, v);
    high = larger_of(high, v);
  }
  const double y = ends()[k - section_.size()];
  return {{Vec3(0, 1, 0), y},
          {in_space(low, y), in_space({low.x(), high.y()}, y), in_space(high, y),
           in_space({high.x(), low.y()}, y)}};
}

#endif

}  // namespace voussoir
