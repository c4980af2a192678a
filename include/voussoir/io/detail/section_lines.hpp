// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/axonometric_view.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/geometry/convex_polyhedron.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/io/detail/rock_layers.hpp>

namespace voussoir {

/// Where two blocks have slipped on each other or come apart, for a view in 3-D.
struct SlippedJoint {
  std::vector<Vec3> corners;  ///< of the flat area over which they touch, in order round it [m]
  double slip = 0;            ///< plastic [m]; decides the width of the line
  bool is_open = false;
  int a = -1, b = -1;  ///< blocks, as in the rock mass
};

namespace detail {

/// Area of a flat polygon over half its perimeter: of a long one its width [m].
[[nodiscard]] VOUSSOIR_INLINE double mean_width(const std::vector<Vec3>& corners);

/// A line in which a joint, or the wall of the tunnel, is seen.
struct SeenLine {
  Vec3 from, to;
  double slip = 0;  ///< [m]
  bool is_open = false;
};

/// The direction out of the rock into an opening, of a point on the surface of one; none: the point
/// lies on no surface.
/// @param tolerance  points this close to a surface are on it [m]
[[nodiscard]] VOUSSOIR_INLINE std::optional<Vec3> into_opening(
    const std::vector<PrismaticOpening>& openings, const Vec3& p, double tolerance);

/// The stretch in which a plane meets a convex polygon; none: it does not, or in a corner alone.
[[nodiscard]] VOUSSOIR_INLINE std::optional<std::pair<Vec3, Vec3>> line_in_plane(
    const std::vector<Vec3>& corners, const HalfSpace<3>& plane);

/// Where joints are seen: in the section, and behind it on walls and faces of openings that are
/// turned to the viewer.
[[nodiscard]] VOUSSOIR_INLINE std::vector<SeenLine> seen_lines(
    const std::vector<SlippedJoint>& joints, const std::vector<PrismaticOpening>& openings,
    const HalfSpace<3>& section, const AxonometricView& view);

/// Where the wall of the tunnel is cut: those edges of a section through a block that lie on the
/// surface of an opening.
/// @param part  of a block, behind the section;  @param face  of it, in the section
VOUSSOIR_INLINE void add_wall_lines(const ConvexPolyhedron& part, std::size_t face,
                                    const std::vector<PrismaticOpening>& openings, double tolerance,
                                    std::vector<SeenLine>& lines);

/// Widths of lines by slip. The scale ends as that of displacements does, where 98 % of the joints
/// are below.
class SlipScale {
 public:
  /// @param is_loose  is_loose(block): its displacement is beyond the scale of displacements. Its
  ///                  joints set no scale, or one loose block with ten of them would
  template <class IsLoose>
  SlipScale(const std::vector<SlippedJoint>& joints, IsLoose&& is_loose)
      : scale_(settled(joints, is_loose)) {
    for (const SlippedJoint& joint : joints) {
      if (joint.is_open) continue;
      is_empty_ = false;
      is_cut_ = is_cut_ || joint.slip > scale_.top() * (1 + 1e-9);
    }
  }
  [[nodiscard]] double top() const { return scale_.top(); }  ///< [m]
  /// Some joints have slipped further.
  [[nodiscard]] bool is_cut() const { return is_cut_; }
  /// No joint has slipped.
  [[nodiscard]] bool is_empty() const { return is_empty_; }
  [[nodiscard]] double width(double slip) const {  ///< [px]
    return thinnest + (widest - thinnest) * std::clamp(slip / top(), 0.0, 1.0);
  }

 private:
  static constexpr double thinnest = 0.9, widest = 4.6;

  template <class IsLoose>
  static DisplacementScale settled(const std::vector<SlippedJoint>& joints, IsLoose&& is_loose) {
    std::vector<PictureBlock> values, all;
    for (const SlippedJoint& joint : joints) {
      if (joint.is_open) continue;
      all.push_back({{}, joint.slip, false});
      if (!is_loose(joint.a) && !is_loose(joint.b)) values.push_back(all.back());
    }
    return DisplacementScale(values.empty() ? all : values);
  }

  DisplacementScale scale_;
  bool is_cut_ = false, is_empty_ = true;
};

/// Slipped joints red, as wide as they have slipped, and opened ones violet, as in a section.
VOUSSOIR_INLINE void draw_seen_lines(SvgCanvas& canvas, std::vector<SeenLine> lines,
                                     const SlipScale& scale, const AxonometricView& view,
                                     const PageMap& map);

/// A wedge from no slip to the end of the scale.
/// @param corner  upper left, of the title;  @param length  [px]
VOUSSOIR_INLINE void draw_slip_key(SvgCanvas& canvas, const Vec2& corner, double length,
                                   const SlipScale& scale);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE double mean_width(const std::vector<Vec3>& corners) {
  Vec3 doubled = zeros<Vec3>();
  double perimeter = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 &p = corners[k], &q = corners[(k + 1) % corners.size()];
    doubled += cross(Vec3(p - corners[0]), Vec3(q - corners[0]));
    perimeter += length_of(Vec3(q - p));
  }
  return perimeter > 0 ? length_of(doubled) / perimeter : 0;
}

VOUSSOIR_INLINE std::optional<Vec3> into_opening(const std::vector<PrismaticOpening>& openings,
                                                 const Vec3& p, double tolerance) {
  for (const PrismaticOpening& opening : openings) {
    const Vec3 seen = opening.axis().local(p);
    if (seen.z() < opening.from() - tolerance || seen.z() > opening.to() + tolerance) continue;
    const Vec2 across(seen.x(), seen.y());
    const SimplePolygon& section = opening.section();
    for (std::size_t e = 0; e < section.size(); ++e) {
      const Segment edge = section.edge(e);
      const Vec2 along = (edge.end - edge.start) / edge.length();
      const double s = dot_product(along, Vec2(across - edge.start));
      const double aside = cross(along, Vec2(across - edge.start));
      if (s >= -tolerance && s <= edge.length() + tolerance && std::abs(aside) <= tolerance)
        return opening.axis().direction(perpendicular(along));
    }
    if (!section.contains(across)) continue;
    if (std::abs(seen.z() - opening.to()) <= tolerance) return Vec3(-opening.axis().along());
    if (std::abs(seen.z() - opening.from()) <= tolerance) return opening.axis().along();
  }
  return std::nullopt;
}

VOUSSOIR_INLINE std::optional<std::pair<Vec3, Vec3>> line_in_plane(const std::vector<Vec3>& corners,
                                                                   const HalfSpace<3>& plane) {
  std::vector<Vec3> met;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 &p = corners[k], &q = corners[(k + 1) % corners.size()];
    const double at_p = plane.distance(p), at_q = plane.distance(q);
    if (at_p == 0) met.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
      met.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  std::optional<std::pair<Vec3, Vec3>> longest;
  double most = 0;
  for (std::size_t i = 0; i < met.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const double length = length_of(Vec3(met[i] - met[j])); length > most) {
        most = length;
        longest = std::pair(met[j], met[i]);
      }
  return longest;
}

VOUSSOIR_INLINE std::vector<SeenLine> seen_lines(const std::vector<SlippedJoint>& joints,
                                                 const std::vector<PrismaticOpening>& openings,
                                                 const HalfSpace<3>& section,
                                                 const AxonometricView& view) {
  std::vector<SeenLine> lines;
  for (const SlippedJoint& joint : joints) {
    if (const auto line = line_in_plane(joint.corners, section))
      lines.push_back({line->first, line->second, joint.slip, joint.is_open});
    double size = 0;
    for (const Vec3& p : joint.corners)
      size = std::max(size, length_of(Vec3(p - joint.corners[0])));
    for (std::size_t k = 0; k < joint.corners.size(); ++k) {
      Vec3 p = joint.corners[k], q = joint.corners[(k + 1) % joint.corners.size()];
      if (section.distance(p) > section.distance(q)) std::swap(p, q);
      if (section.distance(p) >= 0) continue;
      // Joints have moved by less than a hundredth of their size.
      const double tolerance = 0.01 * size;
      const Vec3 middle = 0.5 * (p + q);
      if (length_of(Vec3(q - p)) <= tolerance) continue;
      const auto out = into_opening(openings, middle, 0.1 * tolerance);
      if (!out || dot_product(*out, view.towards()) <= 1e-9) continue;
      if (!into_opening(openings, p, tolerance) || !into_opening(openings, q, tolerance)) continue;
      if (const double beyond = section.distance(q); beyond > 0)
        q = p + section.distance(p) / (section.distance(p) - beyond) * (q - p);
      lines.push_back({p, q, joint.slip, joint.is_open});
    }
  }
  return lines;
}

VOUSSOIR_INLINE void add_wall_lines(const ConvexPolyhedron& part, std::size_t face,
                                    const std::vector<PrismaticOpening>& openings, double tolerance,
                                    std::vector<SeenLine>& lines) {
  const auto is_on_wall = [&](const Vec3& p) {
    return into_opening(openings, p, tolerance).has_value();
  };
  // An edge may go on into the rock, where a body is in parts: what lies on the wall is found by
  // halving.
  const auto add = [&](const auto& self, const Vec3& p, const Vec3& q, int halvings) -> void {
    const Vec3 middle = 0.5 * (p + q);
    const int found = is_on_wall(p) + is_on_wall(middle) + is_on_wall(q);
    if (found == 3) return lines.push_back({p, q});
    if (found == 0 || halvings == 0) return;
    self(self, p, middle, halvings - 1);
    self(self, middle, q, halvings - 1);
  };
  const auto& loop = part.loop(face);
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const auto at = [&](std::size_t n) {
      return part.vertex(static_cast<std::size_t>(loop[n % loop.size()]));
    };
    add(add, at(k), at(k + 1), 7);
  }
}

VOUSSOIR_INLINE void draw_seen_lines(SvgCanvas& canvas, std::vector<SeenLine> lines,
                                     const SlipScale& scale, const AxonometricView& view,
                                     const PageMap& map) {
  // The widest on top.
  std::stable_sort(lines.begin(), lines.end(), [](const SeenLine& p, const SeenLine& q) {
    return std::pair(p.is_open, p.slip) < std::pair(q.is_open, q.slip);
  });
  for (const SeenLine& line : lines) {
    const Vec2 from = map(view(line.from)), to = map(view(line.to));
    if (length_of(Vec2(to - from)) < 2) continue;  // a dot tells nothing
    canvas.line(from, to,
                {.stroke = line.is_open ? opened_colour : slipped_colour,
                 .stroke_width = line.is_open ? 3.1 : scale.width(line.slip),
                 .round_ends = true});
  }
}

VOUSSOIR_INLINE void draw_slip_key(SvgCanvas& canvas, const Vec2& corner, double length,
                                   const SlipScale& scale) {
  canvas.text(corner, "Slip of joints [mm]");
  const Vec2 from = corner + Vec2(0, 15), to = from + Vec2(length, 0);
  const double low = 0.5 * scale.width(0), high = 0.5 * scale.width(scale.top());
  const std::vector<Vec2> wedge{from - Vec2(0, low), to - Vec2(0, high), to + Vec2(0, high),
                                from + Vec2(0, low)};
  canvas.polygon(wedge, {.fill = slipped_colour});
  const auto label = [&](double part, const std::string& text) {
    const Vec2 at = from + part * (to - from);
    canvas.line(at + Vec2(0, 5), at + Vec2(0, 10), {.stroke = "#111"});
    canvas.text(at + Vec2(0, 24), text, {.anchor = TextAnchor::middle});
  };
  label(0, "0");
  label(0.5, readable_text(0.5e3 * scale.top(), 2));
  label(1, (scale.is_cut() ? "≥ " : "") + readable_text(1e3 * scale.top()));
}

#endif

}  // namespace detail
}  // namespace voussoir
