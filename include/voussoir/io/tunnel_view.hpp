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
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/io/detail/mass_layers.hpp>
#include <voussoir/io/detail/rib_strips.hpp>
#include <voussoir/io/detail/rock_layers.hpp>
#include <voussoir/io/detail/section_lines.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// A line of the support: a bolt, a member of the lining.
struct SupportLine {
  Vec3 from, to;          ///< [m]
  double force;           ///< [N]; decides the width
  std::string says = {};  ///< to who points at it; empty: nothing
};

/// A tunnel in 3-D, cut open, as it is to be drawn. `look_from` chooses section and viewer.
struct TunnelView {
  PictureHeader header;
  std::vector<double> displacement;  ///< of every body of the mass [m]; colours the rock
  std::vector<char> is_gone;         ///< bodies that are detached; none if empty
  std::vector<SupportLine> bolts, lining;
  std::vector<ConvexPolyhedron> fills{};     ///< holes in the wall that the lining fills
  std::vector<SlippedJoint> joints{};        ///< that have slipped or opened
  HalfSpace<3> section{Vec3::UnitX(), 0};    ///< the rock outside of it is left out [m]
  bool shows_bolts_before = false;           ///< those outside are drawn, dashed
  bool shows_lining_before = false;          ///< the same of the lining
  double azimuth = 0.62 * std::numbers::pi;  ///< where the viewer stands, from North [rad]
  double elevation = 0.12 * std::numbers::pi;
  std::optional<PictureBanner> banner = {};  ///< above the rock; none: a tunnel that stands
  std::array<std::string, 3> axes = detail::compass;  ///< what they are called
  UnrolledLining unrolled = {};  ///< thrust and moment of its ribs, below the view; none: no panels
};

namespace detail {

/// Of a part that the section does not cut: true if it lies outside. A body may have parts on
/// either side of an opening, so its centroid does not tell.
[[nodiscard]] VOUSSOIR_INLINE bool lies_before(const ConvexPolyhedron& part,
                                               const HalfSpace<3>& section);

/// The part of a line inside the section, its boundary included, and that outside.
struct PartedLine {
  std::optional<SupportLine> behind, before;
};
[[nodiscard]] VOUSSOIR_INLINE PartedLine parted_line(const SupportLine& line,
                                                     const HalfSpace<3>& section, double tolerance);

// Black and grey as in a section, where red is slip.
inline constexpr const char* bolt_colour = "#111";
inline constexpr const char* lining_colour = "#4a5a68";
inline constexpr const char* before_dash = "5 4";
inline constexpr double thinnest_support = 0.8, widest_support = 3;  // [px]

/// What the key of a view says, under the rock.
struct ViewKey {
  const DisplacementScale& displacement;
  const SlipScale& slip;
  std::vector<LegendItem> items;
};
/// @param px_per_metre  of the view
[[nodiscard]] VOUSSOIR_INLINE double view_key_height(const ViewKey& key,
                                                     const AxonometricView& view);
VOUSSOIR_INLINE void draw_view_key(SvgCanvas& canvas, const Vec2& corner, const ViewKey& key,
                                   const AxonometricView& view, const AxisNames& axes,
                                   double px_per_metre);

}  // namespace detail

/// The rock on the far side of the section with its blocks, the wall of the tunnel, bolts and
/// lining; colours show displacement. Their scale ends where 98 % of the standing blocks are below
/// (`DisplacementScale`), at "≥" where one loose block is far beyond. Joints that have slipped are
/// red lines in the section and on the wall, as wide as they have slipped, opened ones violet; the
/// wall is a bold line where the section cuts it. Below the view the ribs of the lining, unrolled.
///
/// @return  an SVG document, 190 mm wide
/// @throws InvalidInput  no block, a displacement for each is missing, or nothing behind the
/// section
[[nodiscard]] VOUSSOIR_INLINE std::string draw_tunnel_view(const RockMass<Spatial>& mass,
                                                           const TunnelView& scene);

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE bool lies_before(const ConvexPolyhedron& part, const HalfSpace<3>& section) {
  double lowest = 0, highest = 0;
  for (const Vec3& p : part.vertices()) {
    lowest = std::min(lowest, section.distance(p));
    highest = std::max(highest, section.distance(p));
  }
  return highest > -lowest;
}

VOUSSOIR_INLINE PartedLine parted_line(const SupportLine& line, const HalfSpace<3>& section,
                                       double tolerance) {
  SupportLine inner = line;
  if (section.distance(inner.from) > section.distance(inner.to)) std::swap(inner.from, inner.to);
  const double near = section.distance(inner.from), far = section.distance(inner.to);
  if (near > tolerance) return {std::nullopt, line};
  if (far <= tolerance) return {line, std::nullopt};
  const Vec3 met = inner.from - near / (far - near) * (inner.to - inner.from);
  return {SupportLine{inner.from, met, line.force, line.says},
          SupportLine{met, inner.to, line.force, line.says}};
}

/// How far arrows of one px along the axes reach on the page, from their origin.
[[nodiscard]] inline ViewRect arrow_rect(const AxonometricView& view) {
  std::vector<Vec2> tips{zeros<Vec2>()};
  for (int axis = 0; axis < 3; ++axis) {
    const Vec2 seen = view(Vec3::Unit(axis));
    tips.emplace_back(seen.x(), -seen.y());
  }
  return bounding_rect(tips).value_or(ViewRect{{0, 0}, {1, 1}});
}

inline constexpr double arrow_length = 40;  // [px]

VOUSSOIR_INLINE double view_key_height(const ViewKey& key, const AxonometricView& view) {
  const double arrows = 44 + arrow_length * arrow_rect(view).height();
  return std::max({96.0, arrows, 70 + Legend(key.items, picture_width - 350).height()}) + 6;
}

VOUSSOIR_INLINE void draw_view_key(SvgCanvas& canvas, const Vec2& corner, const ViewKey& key,
                                   const AxonometricView& view, const AxisNames& axes,
                                   double px_per_metre) {
  const double y = corner.y();
  const ViewRect arrows = arrow_rect(view);
  canvas.begin_layer("key");
  draw_axes(canvas, corner + Vec2(30, 22) - arrow_length * arrows.low, arrow_length, view, axes);
  draw_scale_bar(canvas, {corner.x() + 150, y + 38}, 120, px_per_metre);
  const double bar = corner.x() + 330, length = 220;
  const ColourMap colours = ColourMap::straw_to_blue();
  constexpr int steps = 60;
  for (int k = 0; k < steps; ++k)  // each to the end: no gaps between them
    canvas.rectangle({{bar + length * k / steps, y + 22}, {bar + length, y + 36}},
                     {.fill = colours((k + 0.5) / steps).hex()});
  canvas.text({bar, y + 15}, "Displacement of blocks [mm]");
  const double top = 1e3 * key.displacement.top();
  const auto label = [&](double part, const std::string& text) {
    const double x = bar + part * length;
    canvas.line({x, y + 36}, {x, y + 40}, {.stroke = "#111"});
    canvas.text({x, y + 53}, text, {.anchor = TextAnchor::middle});
  };
  label(0, "0");
  label(0.5, readable_text(0.5 * top, 2));
  label(1, (key.displacement.is_cut() ? "≥ " : "") + readable_text(top));
  if (!key.slip.is_empty()) draw_slip_key(canvas, {bar + 290, y + 15}, length, key.slip);
  canvas.end_layer();
  if (!key.items.empty()) Legend(key.items, picture_width - 350).draw(canvas, {bar - 2, y + 64});
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
  const HalfSpace<3>& section = scene.section;
  const double tolerance = mass.domain.tolerance();
  const auto is_gone = [&](std::size_t b) { return !scene.is_gone.empty() && scene.is_gone[b]; };
  std::vector<PictureBlock> blocks;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    blocks.push_back({{}, scene.displacement[b], is_gone(b)});
  const DisplacementScale scale(blocks);
  const ColourMap colours = ColourMap::straw_to_blue();
  const Colour filled{0x9a, 0xa3, 0xab};

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
  std::vector<SeenLine> wall;
  const auto add_faces = [&](const ConvexPolyhedron& whole, const Colour& colour, bool is_rock,
                             const std::string& says) {
    ConvexPolyhedron part = whole;
    if (auto halves = whole.split(section, -1, tolerance))
      part = std::move(halves->first);
    else if (lies_before(whole, section))
      return;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Vec3& normal = part.half_space(k).normal;
      const bool is_section = part.cut(k) < 0;
      if (normal.dot(view.towards()) <= 1e-9 ||
          !(is_section || is_bare[static_cast<std::size_t>(part.cut(k))]))
        continue;
      if (is_section && is_rock) add_wall_lines(part, k, mass.openings, 1e3 * tolerance, wall);
      VisibleFace face{{}, is_section ? colour : shaded(colour, normal, view)};
      face.says = says;
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
    const std::string says =
        "block " + std::to_string(b) + "\nmoved " +
        (scene.displacement[b] < 5e-6 ? "0" : readable_text(1e3 * scene.displacement[b])) +
        " mm\n" + readable_text(mass.bodies[b].properties.measure) + " m³";
    for (const ConvexPolyhedron& whole : mass.bodies[b].parts) add_faces(whole, colour, true, says);
  }
  for (const ConvexPolyhedron& fill : scene.fills)
    add_faces(fill, filled, false, "hole filled with lining");
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
  const auto is_block = [&](int b) {
    return b >= 0 && static_cast<std::size_t>(b) < mass.bodies.size();
  };
  std::vector<SlippedJoint> joints = scene.joints;
  std::erase_if(joints, [&](const SlippedJoint& joint) {  // where a block is gone no joint is left
    const auto is_lost = [&](int b) { return is_block(b) && is_gone(static_cast<std::size_t>(b)); };
    return is_lost(joint.a) || is_lost(joint.b);
  });
  const SlipScale slip(joints, [&](int b) {
    return is_block(b) && scene.displacement[static_cast<std::size_t>(b)] > scale.top();
  });
  const auto strongest = [](const std::vector<SupportLine>& lines) {
    double most = 0;
    for (const SupportLine& line : lines) most = std::max(most, std::abs(line.force));
    return most;
  };
  const bool has_opened = std::any_of(joints.begin(), joints.end(),
                                      [](const SlippedJoint& joint) { return joint.is_open; });
  const auto sample = [](const char* stroke, double stroke_width, const char* dash = "") {
    return [=](SvgCanvas& page, const Vec2& c) {
      page.line(c - Vec2(13, 0), c + Vec2(13, 0),
                {.stroke = stroke, .stroke_width = stroke_width, .dash = dash});
    };
  };
  ViewKey key{scale, slip, {}};
  if (has_opened) key.items.push_back({"opened joint", sample(opened_colour, 3.1)});
  if (!scene.bolts.empty())
    key.items.push_back({"bolt, up to " + readable_text(1e-3 * strongest(scene.bolts)) + " kN",
                         sample(bolt_colour, widest_support)});
  if (!scene.lining.empty())
    key.items.push_back({"lining, up to " + readable_text(1e-3 * strongest(scene.lining)) + " kN",
                         sample(lining_colour, widest_support)});
  if ((scene.shows_bolts_before && !scene.bolts.empty()) ||
      (scene.shows_lining_before && !scene.lining.empty()))
    key.items.push_back({"before the section", sample("#111", 1.6, before_dash)});
  if (!scene.fills.empty())
    key.items.push_back(
        {"hole filled with lining", [&](SvgCanvas& page, const Vec2& c) {
           page.rectangle({c - Vec2(13, 6), c + Vec2(13, 6)}, {.fill = filled.hex()});
         }});
  const double key_height = view_key_height(key, view);
  SvgCanvas canvas(picture_width, foot + key_height + panels + (panels > 0 ? 14 : 0),
                   picture_printed_width, scene.header.title);
  scene.header.draw(canvas);
  if (scene.banner) {
    const double y = scene.header.height();
    scene.banner->draw(
        canvas, {{picture_margin, y}, {picture_margin + width, y + PictureBanner::height}}, y);
  }
  canvas.begin_layer("rock");
  draw_faces(canvas, ordered, map, 0.5);
  canvas.end_layer();
  canvas.begin_layer("wall");
  for (const SeenLine& line : wall)
    canvas.line(map(view(line.from)), map(view(line.to)),
                {.stroke = "#111", .stroke_width = 1.8, .round_ends = true});
  canvas.end_layer();
  canvas.begin_layer("joints");
  draw_seen_lines(canvas, seen_lines(joints, mass.openings, section, view), slip, view, map);
  canvas.end_layer();
  // The strongest on top.
  const auto draw_lines = [&](const char* layer, std::vector<SupportLine> lines, const char* stroke,
                              bool has_rim, bool shows_before) {
    const double most = strongest(lines);
    std::stable_sort(lines.begin(), lines.end(), [](const SupportLine& p, const SupportLine& q) {
      return std::abs(p.force) < std::abs(q.force);
    });
    canvas.begin_layer(layer);
    const auto draw_line = [&](const std::optional<SupportLine>& line, bool is_before) {
      if (!line) return;
      const double part = most > 0 ? std::abs(line->force) / most : 0;
      const double thickness = thinnest_support + part * (widest_support - thinnest_support);
      const Vec2 from = map(view(line->from)), to = map(view(line->to));
      if (has_rim && !is_before)
        canvas.line(from, to, {.stroke = "white", .stroke_width = thickness + 1.6});
      canvas.line(
          from, to,
          {.stroke = stroke, .stroke_width = thickness, .dash = is_before ? before_dash : ""});
    };
    for (const SupportLine& line : lines) {
      const PartedLine parted = parted_line(line, section, tolerance);
      if (shows_before) draw_line(parted.before, true);
      draw_line(parted.behind, false);
    }
    canvas.end_layer();
  };
  draw_lines("lining", scene.lining, lining_colour, false, scene.shows_lining_before);
  draw_lines("bolts", scene.bolts, bolt_colour, true, scene.shows_bolts_before);
  canvas.begin_spots();
  for (const VisibleFace& face : ordered) canvas.spot(on_page(face.corners, map), face.says);
  constexpr double line_width = 8;  // [px]
  for (const std::vector<SupportLine>* lines : {&scene.lining, &scene.bolts})
    for (const SupportLine& line : *lines)
      if (const PartedLine parted = parted_line(line, section, tolerance); parted.behind)
        canvas.spot(map(view(parted.behind->from)), map(view(parted.behind->to)), line_width,
                    line.says);
  canvas.end_layer();
  draw_view_key(canvas, {frame.low.x(), foot}, key, view, scene.axes, map.scale());
  const double below = foot + key_height;
  draw_unrolled_lining(canvas, {{picture_margin, below}, {picture_margin + width, below + panels}},
                       scene.unrolled);
  return canvas.document();
}

#endif

}  // namespace voussoir
