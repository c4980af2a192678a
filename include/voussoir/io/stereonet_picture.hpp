// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/contour.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/detail/equal_area_net.hpp>
#include <voussoir/io/detail/label_places.hpp>
#include <voussoir/io/detail/stereonet_key.hpp>
#include <voussoir/io/detail/stereonet_layers.hpp>
#include <voussoir/rockmass/orientation.hpp>
#include <voussoir/rockmass/orientation_sets.hpp>

namespace voussoir {

/// A stereonet: lower hemisphere, equal area, North up.
struct StereonetPicture {
  PictureHeader header;
  std::vector<SurveyedPlane> planes;  ///< drawn by their poles; may be none if there are sets
  std::vector<FittedSet> sets;        ///< by index; the mean of each as pole and great circle
  std::optional<LineOrientation> tunnel = {};  ///< its axis, and the section across it
  bool contours = true;                        ///< of the density of poles
};

/// Poles of measured planes in the equal-area net of the lower hemisphere, contours of their
/// density in multiples of that of planes without a preferred direction, the mean of each set with
/// its great circle, and the tunnel's axis with the section across it. Beside it a table of the
/// sets. The pole of a plane is where its normal meets the lower hemisphere: that of a level plane
/// is the centre. Where there is one set and no plane names one, all planes are of it.
///
/// @return  an SVG document, 190 mm wide; about 60 bytes for each pole that is seen apart
/// @throws InvalidInput  nothing to draw; a plane of a set that is not there; an angle or a weight
///                       out of range
/// Source: see `equal_area_point`, `PoleDensity`.
[[nodiscard]] VOUSSOIR_INLINE std::string draw_stereonet_picture(const StereonetPicture& picture);

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE void check_stereonet(const StereonetPicture& picture) {
  constexpr double pi = std::numbers::pi;
  if (picture.planes.empty() && picture.sets.empty())
    throw InvalidInput("stereonet picture: needs at least one plane or one set");
  check_planes(picture.planes, "stereonet picture");
  const int sets = static_cast<int>(picture.sets.size());
  for (std::size_t k = 0; k < picture.planes.size(); ++k)
    if (sets > 0 && picture.planes[k].set >= sets)
      throw InvalidInput(
          message({"stereonet picture, plane ", k + 1, ": set = ", picture.planes[k].set,
                   ": must be below ", sets, ", the number of sets, or -1"}));
  for (const FittedSet& set : picture.sets) {
    const std::string what = "stereonet picture, set " + set.name + ": ";
    require_angle(what + "dip", set.mean.dip, 0, 0.5 * pi);
    require_angle(what + "dip direction", set.mean.dip_direction, 0, 2 * pi);
  }
  if (!picture.tunnel) return;
  require_angle("stereonet picture: trend of the tunnel", picture.tunnel->trend, 0, 2 * pi);
  require_angle("stereonet picture: plunge of the tunnel", picture.tunnel->plunge, -0.5 * pi,
                0.5 * pi);
}

}  // namespace detail

VOUSSOIR_INLINE std::string draw_stereonet_picture(const StereonetPicture& picture) {
  using namespace detail;
  check_stereonet(picture);
  const std::vector<SurveyedPlane> planes = planes_by_set(picture.planes, picture.sets.size());
  const double top = picture.header.height() + 30;
  constexpr double radius = 280, left = picture_margin + 32;
  const Vec2 centre(left + radius, top + radius);
  const NetFrame net{centre, radius};
  constexpr double column = left + 2 * radius + 58, room = picture_width - picture_margin - column;

  std::vector<Contour> contours;
  std::vector<double> levels;
  std::optional<PoleDensity> density;
  if (picture.contours && !planes.empty()) {
    density.emplace(planes);
    const ContourGrid grid = density->grid(60);
    levels = density_levels(grid.value.maxCoeff());
    for (const double level : levels) contours.push_back(contour_at(grid, level));
  }
  StereonetKey key;
  key.planes = planes.size();
  key.levels = levels;
  key.tunnel = picture.tunnel;
  if (density) key.concentration = density->concentration();
  for (const FittedSet& set : picture.sets) key.sets.push_back(&set);
  for (const SurveyedPlane& surveyed : planes) key.of_no_set += surveyed.set < 0;
  const double key_height = draw_key(nullptr, key, {column, top}, room);
  const double height = top + std::max(2 * radius + 30, key_height) + 16;

  SvgCanvas canvas(picture_width, height, picture_printed_width, picture.header.title);
  canvas.begin_layer("density");
  draw_density(canvas, contours, net);
  canvas.end_layer();
  // Over what the contours have beyond the rim, and so before the header.
  canvas.begin_layer("net");
  draw_rim(canvas, net);
  canvas.end_layer();
  picture.header.draw(canvas);

  LabelPlaces places(net);
  canvas.begin_layer("poles");
  draw_poles(canvas, planes, net, places);
  canvas.end_layer();
  canvas.begin_layer("sets");
  for (std::size_t k = 0; k < picture.sets.size(); ++k)
    draw_mean(canvas, picture.sets[k], static_cast<int>(k), net, places);
  if (picture.tunnel) draw_tunnel(canvas, *picture.tunnel, net, places);
  places.draw(canvas);
  canvas.end_layer();
  canvas.begin_layer("key");
  draw_key(&canvas, key, {column, top}, room);
  canvas.end_layer();
  return canvas.document();
}

#endif

}  // namespace voussoir
