// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/drawing/axonometric_view.hpp>
#include <voussoir/drawing/colour_map.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/io/detail/face_rim.hpp>
#include <voussoir/io/detail/painting_order.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir::detail {

/// Colour of a joint set: told apart by all, also by those who do not see red and green alike, and
/// of about one lightness, which is left to the shading. After six sets they repeat.
[[nodiscard]] inline Colour set_colour(int set) {
  constexpr std::array<Colour, 6> colours = {Colour{206, 124, 72}, Colour{82, 143, 188},
                                             Colour{148, 158, 72}, Colour{172, 118, 168},
                                             Colour{214, 172, 66}, Colour{78, 162, 146}};
  if (set < 0) return {150, 150, 150};
  return colours[static_cast<std::size_t>(set) % colours.size()];
}
/// Sides of the domain: no joint.
inline constexpr Colour side_colour{226, 223, 216};

/// A colour in the light that falls on a face: from above, over the viewer's left shoulder. Dark
/// faces are greyer too, or they would seem to be of a stronger colour than the legend's.
[[nodiscard]] VOUSSOIR_INLINE Colour shaded(const Colour& colour, const Vec3& normal,
                                            const AxonometricView& view);

/// Something of a block that the viewer sees.
struct VisibleFace {
  std::vector<Vec2> corners;  ///< in the picture [m]
  Colour fill;
  /// Of one of several parts of a block: its edges but the seams to the others.
  std::vector<std::pair<Vec2, Vec2>> rim = {};
  bool is_of_part = false;
  std::string says = {};  ///< to who points at it; empty: nothing
};

/// Which blocks are drawn, and how far from their place.
struct MassScene {
  std::vector<bool> is_drawn;
  double explosion = 0;  ///< shift of a block over its distance from the centre
};

/// The faces to paint, in order.
///
/// Blocks in their place hide each other's faces but for those on a side of the domain and those
/// laid bare where blocks are left out; only these are drawn then.
[[nodiscard]] VOUSSOIR_INLINE std::vector<VisibleFace> visible_faces(const RockMass<Spatial>& mass,
                                                                     const MassScene& scene,
                                                                     const AxonometricView& view);

/// Paints faces over each other; outlines of `width` px.
VOUSSOIR_INLINE void draw_faces(SvgCanvas& canvas, const std::vector<VisibleFace>& faces,
                                const PageMap& map, double width);

/// The edges of the model where a corner is left out, dashed, and the lengths of its sides along
/// the three edges that the viewer sees below and at the left.
VOUSSOIR_INLINE void draw_extent(SvgCanvas& canvas, const Domain<3>& domain, double corner_left_out,
                                 const AxonometricView& view, const PageMap& map);

/// What the axes of space are called in a picture.
using AxisNames = std::array<std::string, 3>;
inline const AxisNames compass{"E", "N", "up"};

/// Arrows along the axes as the viewer sees them, `length` px where seen at full length.
VOUSSOIR_INLINE void draw_axes(SvgCanvas& canvas, const Vec2& origin, double length,
                               const AxonometricView& view, const AxisNames& names);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE Colour shaded(const Colour& colour, const Vec3& normal,
                              const AxonometricView& view) {
  const Vec3 light = (0.5 * view.towards() - 0.5 * view.right() + 0.8 * Vec3::UnitZ()).normalized();
  const double brightness = 0.84 + 0.19 * std::max(-0.5, normal.dot(light));
  PerceptualColour seen = perceptual(colour);
  seen.lightness *= brightness;
  seen.a *= brightness;
  seen.b *= brightness;
  return screen_colour(seen);
}

VOUSSOIR_INLINE std::vector<VisibleFace> visible_faces(const RockMass<Spatial>& mass,
                                                       const MassScene& scene,
                                                       const AxonometricView& view) {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  VOUSSOIR_ASSERT(scene.is_drawn.size() == mass.bodies.size(),
                  "it is known which blocks are drawn");
  std::vector<bool> is_bare(mass.cuts.size(), scene.explosion > 0);
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const ConvexPolyhedron& part : mass.bodies[b].parts)
      for (std::size_t k = 0; k < part.size(); ++k)
        if (!scene.is_drawn[b] || mass.cuts[at(part.cut(k))].kind == Cut::Kind::boundary)
          is_bare[at(part.cut(k))] = true;
  const Vec3 centre = 0.5 * (mass.domain.low + mass.domain.high);
  std::vector<VisibleFace> faces;
  for (const int b : painting_order(mass, view.towards())) {
    if (!scene.is_drawn[at(b)]) continue;
    const Body<Spatial>& body = mass.bodies[at(b)];
    const Vec3 shift = scene.explosion * (body.properties.centroid - centre);
    for (const ConvexPolyhedron& part : body.parts)
      for (std::size_t k = 0; k < part.size(); ++k) {
        const Vec3& normal = part.half_space(k).normal;
        if (normal.dot(view.towards()) <= 1e-9 || !is_bare[at(part.cut(k))]) continue;
        const Cut& cut = mass.cuts[at(part.cut(k))];
        const Colour colour = cut.kind == Cut::Kind::joint
                                  ? set_colour(mass.joints[at(cut.source)].set)
                                  : side_colour;
        VisibleFace face{{}, shaded(colour, normal, view)};
        for (const int v : part.loop(k)) face.corners.push_back(view(part.vertex(at(v)) + shift));
        face.is_of_part = body.parts.size() > 1;
        if (face.is_of_part)
          for (const auto& [start, end] : face_rim(body, part, k, 10 * mass.domain.tolerance()))
            face.rim.emplace_back(view(start + shift), view(end + shift));
        faces.push_back(std::move(face));
      }
  }
  return faces;
}

VOUSSOIR_INLINE void draw_faces(SvgCanvas& canvas, const std::vector<VisibleFace>& faces,
                                const PageMap& map, double width) {
  for (const VisibleFace& face : faces) {
    // The rim is a darker shade of the face: blocks stand out, and small ones do not turn black.
    PerceptualColour rim = perceptual(face.fill);
    rim.lightness *= 0.45;
    const std::string edge = screen_colour(rim).hex();
    // Where the block goes on the face is a little larger, or its ground would shine through.
    canvas.polygon(on_page(face.corners, map), {.fill = face.fill.hex(),
                                                .stroke = face.is_of_part ? face.fill.hex() : edge,
                                                .stroke_width = width});
    for (const auto& [a, b] : face.rim)
      canvas.line(map(a), map(b), {.stroke = edge, .stroke_width = width});
  }
}

VOUSSOIR_INLINE void draw_extent(SvgCanvas& canvas, const Domain<3>& domain, double corner_left_out,
                                 const AxonometricView& view, const PageMap& map) {
  // The corner next to the viewer, and how far it is along each axis to the opposite one.
  Vec3 near = domain.high, across = -domain.size();
  for (int axis = 0; axis < 2; ++axis)
    if (view.towards()[axis] <= 0) {
      near[axis] = domain.low[axis];
      across[axis] = -across[axis];
    }
  for (int axis = 0; axis < 3 && corner_left_out > 0; ++axis) {
    const Vec3 end = near + corner_left_out * across[axis] * Vec3::Unit(axis);
    canvas.line(map(view(near)), map(view(end)),
                {.stroke = "#555", .stroke_width = 0.9, .dash = "5 4"});
  }
  const auto label = [&](const Vec3& from, const Vec3& to, const Vec3& inside) {
    const Vec2 p = map(view(from)), q = map(view(to)), away = 0.5 * (p + q) - map(view(inside));
    const Vec2 along = (q - p).normalized();
    Vec2 out = perpendicular(along);
    if (out.dot(away) < 0) out = -out;
    double angle = std::atan2(along.y(), along.x());  // upright text, clockwise on the page
    if (angle > 0.49 * std::numbers::pi) angle -= std::numbers::pi;
    if (angle < -0.51 * std::numbers::pi) angle += std::numbers::pi;
    // The base line is to be near the edge where the letters point away from it, else their tops.
    const Vec2 upwards(std::sin(angle), -std::cos(angle));
    const Vec2 at = 0.5 * (p + q) + (out.dot(upwards) > 0 ? 7.0 : 17.0) * out;
    canvas.text(at, trimmed_text((to - from).norm(), 2) + " m",
                {.anchor = TextAnchor::middle, .rotation = angle * 180 / std::numbers::pi});
  };
  const bool is_from_above = view.towards().z() >= 0;
  const Vec3 foot = is_from_above ? Vec3(near + across.z() * Vec3::UnitZ()) : near;
  const Vec3 middle = 0.5 * (domain.low + domain.high);
  Vec3 left_end = foot;
  for (int axis = 0; axis < 2; ++axis) {
    const Vec3 end = foot + across[axis] * Vec3::Unit(axis);
    label(foot, end, middle);
    if (view(end).x() < view(left_end).x()) left_end = end;
  }
  label(left_end, left_end - (is_from_above ? across.z() : -across.z()) * Vec3::UnitZ(), middle);
}

VOUSSOIR_INLINE void draw_axes(SvgCanvas& canvas, const Vec2& origin, double length,
                               const AxonometricView& view, const AxisNames& names) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec2 seen = view(Vec3::Unit(axis));
    const Vec2 arrow = length * Vec2(seen.x(), -seen.y());
    const double size = arrow.norm();
    if (size < 3) continue;
    const Vec2 along = arrow / size, tip = origin + arrow;
    canvas.line(origin, tip, {.stroke = "#111", .stroke_width = 1.4});
    draw_arrow_head(canvas, tip, along, "#111");
    // A word beside an arrow begins behind its tip.
    const std::string& name = names[static_cast<std::size_t>(axis)];
    const bool is_aside = name.size() > 2 && along.x() > 0.5;
    canvas.text(tip + (is_aside ? 5 : 10) * along + Vec2(0, 4.5), name,
                {.anchor = is_aside ? TextAnchor::start : TextAnchor::middle});
  }
}

#endif

}  // namespace voussoir::detail
