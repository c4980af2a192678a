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
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/detail/mass_layers.hpp>
#include <voussoir/rockmass/orientation.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// How a rock mass in 3-D is to be drawn.
struct MassPicture {
  PictureHeader header;
  std::vector<std::string> set_names;       ///< by number of the set; "set 3" where there is none
  double azimuth = 1.2 * std::numbers::pi;  ///< where the viewer stands, from North [rad]
  double elevation = std::numbers::pi / 6;  ///< above the horizontal [rad]
  double explosion = 0;  ///< blocks moved from the centre by this part of their distance, >= 0
  /// Blocks left out at the upper corner next to the viewer: the part of each side, 0 to 1.
  double corner_left_out = 0;
  std::array<std::string, 3> axes = detail::compass;  ///< what they are called
  double y_azimuth = 0;  ///< of the second axis, clockwise from North [rad], 0 to 2 pi
};

/// "75/010": dip and dip direction in degrees, as geologists write a plane.
[[nodiscard]] VOUSSOIR_INLINE std::string orientation_text(const Orientation& plane);

namespace detail {

/// Blocks whose centroid lies in the corner are left out.
[[nodiscard]] VOUSSOIR_INLINE MassScene mass_scene(const RockMass<Spatial>& mass,
                                                   const MassPicture& picture,
                                                   const AxonometricView& view);

/// The sets whose joints are in the mass, each with its name and mean orientation.
[[nodiscard]] VOUSSOIR_INLINE std::vector<LegendItem> mass_legend(const RockMass<Spatial>& mass,
                                                                  const MassPicture& picture);

}  // namespace detail

/// The blocks of a rock mass as a viewer from afar sees them, shaded, their faces in the colour of
/// the joint set that made them. Blocks may be moved apart, and a corner left out, to show those
/// inside: whole blocks, so that every face drawn is a joint or a side of the model.
///
/// @return  an SVG document, 190 mm wide; about 180 bytes a face
/// @throws InvalidInput  no block, or a value out of the range given in MassPicture
[[nodiscard]] VOUSSOIR_INLINE std::string draw_mass_picture(const RockMass<Spatial>& mass,
                                                            const MassPicture& picture);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::string orientation_text(const Orientation& plane) {
  constexpr double degrees = 180 / std::numbers::pi;
  const auto padded = [](long value, std::size_t digits) {
    const std::string text = std::to_string(value);
    return std::string(digits - std::min(digits, text.size()), '0') + text;
  };
  return padded(std::lround(plane.dip * degrees), 2) + '/' +
         padded(std::lround(plane.dip_direction * degrees) % 360, 3);
}

VOUSSOIR_INLINE std::string draw_mass_picture(const RockMass<Spatial>& mass,
                                              const MassPicture& picture) {
  using namespace detail;
  if (mass.bodies.empty()) throw InvalidInput("draw_mass_picture: needs at least one block");
  require(picture.explosion >= 0 && std::isfinite(picture.explosion), "explosion",
          picture.explosion, ">= 0");
  require(picture.corner_left_out >= 0 && picture.corner_left_out <= 1, "corner_left_out",
          picture.corner_left_out, "0 to 1");
  const AxonometricView view(picture.azimuth, picture.elevation);
  const MassScene scene = mass_scene(mass, picture, view);
  const std::vector<VisibleFace> faces = visible_faces(mass, scene, view);
  std::vector<Vec2> seen;
  for (const VisibleFace& face : faces)
    seen.insert(seen.end(), face.corners.begin(), face.corners.end());
  const ViewRect world = bounding_rect(seen).value_or(ViewRect{{0, 0}, {1, 1}});

  const double top = picture.header.height();
  const double width = picture_width - 2 * picture_margin;
  const double height = std::clamp(width * world.height() / world.width(), 200.0, 860.0);
  const ViewRect frame{{picture_margin, top}, {picture_margin + width, top + height}};
  const PageMap map = PageMap::equal_scales(world, frame.grown(-20));  // room for the lengths
  const Legend legend(mass_legend(mass, picture), width - 330);
  const double foot = frame.high.y() + 12, foot_height = std::max(96.0, legend.height() + 10);

  SvgCanvas canvas(picture_width, foot + foot_height, picture_printed_width, picture.header.title);
  picture.header.draw(canvas);
  canvas.begin_layer("blocks");
  // As wide as a fiftieth of a block of mean size, within what prints.
  const double block = std::cbrt(mass.domain.measure() / static_cast<double>(mass.bodies.size()));
  draw_faces(canvas, faces, map, std::clamp(0.02 * block * map.scale(), 0.25, 1.0));
  canvas.end_layer();
  canvas.begin_layer("extent");
  if (picture.explosion == 0) draw_extent(canvas, mass.domain, picture.corner_left_out, view, map);
  canvas.end_layer();
  canvas.begin_layer("axes");
  draw_axes(canvas, {frame.low.x() + 60, foot + 58}, 44, view, picture.axes);
  draw_scale_bar(canvas, {frame.low.x() + 150, foot + 52}, 130, map.scale());
  canvas.end_layer();
  legend.draw(canvas, {frame.low.x() + 330, foot + 30});
  return canvas.document();
}

namespace detail {

VOUSSOIR_INLINE MassScene mass_scene(const RockMass<Spatial>& mass, const MassPicture& picture,
                                     const AxonometricView& view) {
  MassScene scene{std::vector<bool>(mass.bodies.size(), true), picture.explosion};
  if (!(picture.corner_left_out > 0)) return scene;
  const Vec3 size = mass.domain.size();
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const Vec3& at = mass.bodies[b].properties.centroid;
    bool is_in_corner = true;
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_high_side = axis == 2 || view.towards()[axis] > 0;
      const double inside =
          is_high_side ? mass.domain.high[axis] - at[axis] : at[axis] - mass.domain.low[axis];
      is_in_corner = is_in_corner && inside < picture.corner_left_out * size[axis];
    }
    scene.is_drawn[b] = !is_in_corner;
  }
  return scene;
}

VOUSSOIR_INLINE std::vector<LegendItem> mass_legend(const RockMass<Spatial>& mass,
                                                    const MassPicture& picture) {
  std::vector<std::vector<Vec3>> normals;  // by set
  bool any_other = false;
  for (const SpatialJoint& joint : mass.joints) {
    any_other = any_other || joint.set < 0;
    if (joint.set < 0) continue;
    const auto set = static_cast<std::size_t>(joint.set);
    if (normals.size() <= set) normals.resize(set + 1);
    normals[set].push_back(joint.trace.plane.normal);
  }
  const auto box = [](const Colour& colour) {
    return [=](SvgCanvas& canvas, const Vec2& c) {
      canvas.rectangle({c - Vec2(12, 6), c + Vec2(12, 6)},
                       {.fill = colour.hex(), .stroke = "#444", .stroke_width = 0.8});
    };
  };
  std::vector<LegendItem> items;
  for (std::size_t set = 0; set < normals.size(); ++set) {
    if (normals[set].empty()) continue;
    const std::string name =
        set < picture.set_names.size() ? picture.set_names[set] : "set " + std::to_string(set + 1);
    Orientation mean = mean_orientation(normals[set]);
    mean.dip_direction += picture.y_azimuth;
    items.push_back({name + ", " + orientation_text(mean), box(set_colour(static_cast<int>(set)))});
  }
  if (any_other) items.push_back({"other joints", box(set_colour(-1))});
  items.push_back({"side of the model", box(side_colour)});
  return items;
}

}  // namespace detail

#endif

}  // namespace voussoir
