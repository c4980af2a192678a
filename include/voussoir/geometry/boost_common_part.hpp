// SPDX-License-Identifier: MIT
#pragma once

// g++ 12 sees a variable of its intersection without a value, which is set before it is read.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/geometry/algorithms/append.hpp>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/intersection.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/simple_polygon.hpp>

namespace voussoir {

/// What of a polygon lies in an outline, by Boost.Geometry. Splinters below 1e-9 of its area, as
/// rounding leaves them where the two run along each other, do not count.
/// @param outline  simple, either way around, closed or not [m]
/// @throws InvalidInput  nothing, or several pieces
[[nodiscard]] inline SimplePolygon common_part(const SimplePolygon& section,
                                               const std::vector<Vec2>& outline) {
  namespace bg = boost::geometry;
  using BoostPoint = bg::model::d2::point_xy<double>;
  using BoostPolygon = bg::model::polygon<BoostPoint, false>;  // anticlockwise
  BoostPolygon a, b;
  for (const Vec2& v : section.vertices()) bg::append(a.outer(), BoostPoint(v.x(), v.y()));
  for (const Vec2& p : outline) bg::append(b.outer(), BoostPoint(p.x(), p.y()));
  bg::correct(a);
  bg::correct(b);
  bg::model::multi_polygon<BoostPolygon> pieces;
  bg::intersection(a, b, pieces);
  std::erase_if(pieces, [&](const BoostPolygon& piece) {
    return !(bg::area(piece) > 1e-9 * section.area());
  });
  if (pieces.empty()) throw InvalidInput("no part of the section lies in it");
  if (pieces.size() > 1)
    throw InvalidInput("takes " + std::to_string(pieces.size()) + " pieces of the section at once");
  std::vector<Vec2> corners;
  const double apart = 1e-9 * section.perimeter();
  for (const BoostPoint& p : pieces.front().outer()) {
    const Vec2 corner(p.x(), p.y());
    if (corners.empty() || length_of(Vec2(corner - corners.back())) > apart)
      corners.push_back(corner);
  }
  while (corners.size() > 1 && length_of(Vec2(corners.front() - corners.back())) <= apart)
    corners.pop_back();
  return SimplePolygon(std::move(corners));
}

}  // namespace voussoir
