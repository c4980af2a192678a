// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/drawing/axonometric_view.hpp>
#include <voussoir/drawing/colour_map.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/detail/mass_layers.hpp>
#include <voussoir/io/detail/rib_strips.hpp>
#include <voussoir/io/detail/rock_layers.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// A line of the support: a bolt, a member of the lining.
struct SupportLine {
  Vec3 from, to;  ///< [m]
  double force;   ///< [N]; decides the width
};

/// A tunnel in 3-D, cut open along a vertical plane, as it is to be drawn.
struct TunnelView {
  PictureHeader header;
  std::vector<double> displacement;  ///< of every body of the mass [m]; colours the rock
  std::vector<char> is_gone;         ///< bodies that are detached; none if empty
  std::vector<SupportLine> bolts, lining;
  std::vector<ConvexPolyhedron> fills{};     ///< holes in the wall that the lining fills
  double section_x = 0;                      ///< the rock at higher x is left out [m]
  double azimuth = 0.62 * std::numbers::pi;  ///< where the viewer stands, from North [rad]
  double elevation = 0.12 * std::numbers::pi;
  std::optional<PictureBanner> banner = {};  ///< above the rock; none: a tunnel that stands
  std::array<std::string, 3> axes = detail::compass;  ///< what they are called
  UnrolledLining unrolled = {};  ///< thrust and moment of its ribs, below the view; none: no panels
};

namespace detail {

/// Of a part that the section does not cut: true if it lies at higher x. A body may have parts on
/// either side of an opening, so its centroid does not tell.
[[nodiscard]] VOUSSOIR_INLINE bool lies_before(const ConvexPolyhedron& part, double section_x);

/// The part of a line at or below the section, if there is any.
[[nodiscard]] VOUSSOIR_INLINE std::optional<SupportLine> behind_section(SupportLine line,
                                                                        double section_x,
                                                                        double tolerance);

}  // namespace detail

/// The rock on the far side of the section with its blocks, the wall of the tunnel, bolts and
/// lining; colours show displacement. Their scale ends where 98 % of the standing blocks are below
/// (`DisplacementScale`), at "≥" where one loose block is far beyond. Below it the ribs of the
/// lining, unrolled.
///
/// @return  an SVG document, 190 mm wide
/// @throws InvalidInput  no block, a displacement for each is missing, or nothing behind the
/// section
[[nodiscard]] VOUSSOIR_INLINE std::string draw_tunnel_view(const RockMass<Spatial>& mass,
                                                           const TunnelView& scene);

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE bool lies_before(const ConvexPolyhedron& part, double section_x) {
  double lowest = section_x, highest = section_x;
  for (const Vec3& p : part.vertices()) {
    lowest = std::min(lowest, p.x());
    highest = std::max(highest, p.x());
  }
  return highest - section_x > section_x - lowest;
}

VOUSSOIR_INLINE std::optional<SupportLine> behind_section(SupportLine line, double section_x,
                                                          double tolerance) {
  if (line.from.x() > line.to.x()) std::swap(line.from, line.to);
  if (line.from.x() > section_x + tolerance) return std::nullopt;
  if (line.to.x() > section_x + tolerance)
    line.to = line.from +
              (section_x - line.from.x()) / (line.to.x() - line.from.x()) * (line.to - line.from);
  return line;
}

}  // namespace detail

VOUSSOIR_INLINE std::string draw_tunnel_view(const RockMass<Spatial>& mass,
                                             const TunnelView& scene) {
  using namespace detail;
  if (mass.bodies.empty()) throw InvalidInput("draw_tunnel_view: needs at least one block");
  if (scene.displacement.size() != mass.bodies.size())
    throw InvalidInput("draw_tunnel_view: has " + std::to_string(scene.displacement.size()) +
                       " displacements for " + std::to_string(mass.bodies.size()) + " blocks");
  const AxonometricView view(scene.azimuth, scene.elevation);
  const HalfSpace<3> section{Vec3::UnitX(), scene.section_x};
  const double tolerance = mass.domain.tolerance();
  const auto is_gone = [&](std::size_t b) { return !scene.is_gone.empty() && scene.is_gone[b]; };
  std::vector<PictureBlock> blocks;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    blocks.push_back({{}, scene.displacement[b], is_gone(b)});
  const DisplacementScale scale(blocks);
  const ColourMap colours = ColourMap::straw_to_blue();

  // What can be seen: the section, the wall of the tunnel, the sides of the model, and where a
  // block is detached or was dropped the faces around it.
  std::vector<char> is_bare(mass.cuts.size(), 0);
  for (std::size_t c = 0; c < mass.cuts.size(); ++c)
    is_bare[c] = mass.cuts[c].kind != Cut::Kind::joint;
  const auto lay_bare = [&](const Body<Spatial>& body) {
    for (const auto& part : body.parts)
      for (std::size_t k = 0; k < part.size(); ++k)
        is_bare[static_cast<std::size_t>(part.cut(k))] = 1;
  };
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    if (is_gone(b)) lay_bare(mass.bodies[b]);
  for (const Body<Spatial>& body : mass.dropped) lay_bare(body);
  std::vector<std::pair<double, VisibleFace>> faces;
  const auto add_faces = [&](const ConvexPolyhedron& whole, const Colour& colour) {
    ConvexPolyhedron part = whole;
    if (auto halves = whole.split(section, -1, tolerance))
      part = std::move(halves->first);
    else if (lies_before(whole, scene.section_x))
      return;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Vec3& normal = part.half_space(k).normal;
      const bool is_section = part.cut(k) < 0;
      if (normal.dot(view.towards()) <= 1e-9 ||
          !(is_section || is_bare[static_cast<std::size_t>(part.cut(k))]))
        continue;
      VisibleFace face{{}, is_section ? colour : shaded(colour, normal, view)};
      double depth = 0;
      for (const int v : part.loop(k)) {
        const Vec3& p = part.vertex(static_cast<std::size_t>(v));
        face.corners.push_back(view(p));
        depth += view.towards().dot(p);
      }
      faces.emplace_back(depth / static_cast<double>(face.corners.size()), std::move(face));
    }
  };
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    if (is_gone(b)) continue;
    const Colour colour = colours(scene.displacement[b] / scale.top());
    for (const ConvexPolyhedron& whole : mass.bodies[b].parts) add_faces(whole, colour);
  }
  const Colour filled{0x9a, 0xa3, 0xab};
  for (const ConvexPolyhedron& fill : scene.fills) add_faces(fill, filled);
  if (faces.empty()) throw InvalidInput("draw_tunnel_view: no rock lies behind the section");
  std::stable_sort(faces.begin(), faces.end(),
                   [](const auto& p, const auto& q) { return p.first < q.first; });
  std::vector<VisibleFace> ordered;
  std::vector<Vec2> seen;
  for (auto& [depth, face] : faces) {
    seen.insert(seen.end(), face.corners.begin(), face.corners.end());
    ordered.push_back(std::move(face));
  }
  const ViewRect world = bounding_rect(seen).value_or(ViewRect{{0, 0}, {1, 1}});
  const double banner_room = scene.banner ? PictureBanner::height + 10 : 0;
  const double top = scene.header.height() + banner_room;
  const double width = picture_width - 2 * picture_margin;
  const double height = std::clamp(width * world.height() / world.width(), 200.0, 900.0);
  const ViewRect frame{{picture_margin, top}, {picture_margin + width, top + height}};
  const PageMap map = PageMap::equal_scales(world, frame.grown(-8));
  const double foot = frame.high.y() + 10;
  const double panels = unrolled_height(scene.unrolled);
  SvgCanvas canvas(picture_width, foot + 100 + panels, picture_printed_width, scene.header.title);
  scene.header.draw(canvas);
  if (scene.banner) {
    const double y = scene.header.height();
    scene.banner->draw(
        canvas, {{picture_margin, y}, {picture_margin + width, y + PictureBanner::height}}, y);
  }
  canvas.begin_layer("rock");
  draw_faces(canvas, ordered, map, 0.5);
  canvas.end_layer();
  const auto draw_lines = [&](const char* layer, const std::vector<SupportLine>& lines,
                              const char* stroke, double thinnest, double widest) {
    double strongest = 0;
    for (const SupportLine& line : lines) strongest = std::max(strongest, std::abs(line.force));
    canvas.begin_layer(layer);
    for (const SupportLine& line : lines) {
      const auto seen_line = behind_section(line, scene.section_x, tolerance);
      if (!seen_line) continue;
      const double part = strongest > 0 ? std::abs(line.force) / strongest : 0;
      canvas.line(map(view(seen_line->from)), map(view(seen_line->to)),
                  {.stroke = stroke, .stroke_width = thinnest + part * (widest - thinnest)});
    }
    canvas.end_layer();
    return strongest;
  };
  const double thrust = draw_lines("lining", scene.lining, "#222", 0.6, 2.6);
  const double pull = draw_lines("bolts", scene.bolts, "#b2182b", 0.6, 2.6);

  canvas.begin_layer("key");
  draw_axes(canvas, {frame.low.x() + 36, foot + 60}, 40, view, scene.axes);
  draw_scale_bar(canvas, {frame.low.x() + 130, foot + 62}, 130, map.scale());
  const double bar = frame.low.x() + 330;
  constexpr int steps = 60;
  for (int k = 0; k < steps; ++k)  // each to the end: no gaps between them
    canvas.rectangle({{bar + 220.0 * k / steps, foot + 22}, {bar + 220.0, foot + 38}},
                     {.fill = colours((k + 0.5) / steps).hex()});
  canvas.text({bar, foot + 15}, "Displacement [mm]");
  canvas.text({bar, foot + 54}, "0", {.anchor = TextAnchor::middle});
  canvas.text({bar + 220, foot + 54},
              (scale.is_cut() ? "≥ " : "") + readable_text(1e3 * scale.top()),
              {.anchor = TextAnchor::middle});
  double x = bar + 270;
  const auto key = [&](const char* stroke, const std::string& text) {
    canvas.line({x, foot + 30}, {x + 26, foot + 30}, {.stroke = stroke, .stroke_width = 2.6});
    canvas.text({x + 34, foot + 35}, text);
    x += 60 + text_width(text, {});
  };
  if (!scene.bolts.empty()) key("#b2182b", "bolt, " + readable_text(pull / 1e3) + " kN");
  if (!scene.lining.empty()) key("#222", "lining, " + readable_text(thrust / 1e3) + " kN");
  if (!scene.fills.empty()) {
    const double second = bar + 270;  // below the others: the row is full
    canvas.rectangle({{second, foot + 50}, {second + 26, foot + 62}}, {.fill = filled.hex()});
    canvas.text({second + 34, foot + 61}, "hole filled with lining");
  }
  canvas.end_layer();
  draw_unrolled_lining(canvas,
                       {{picture_margin, foot + 96}, {picture_margin + width, foot + 96 + panels}},
                       scene.unrolled);
  return canvas.document();
}

#endif

}  // namespace voussoir
