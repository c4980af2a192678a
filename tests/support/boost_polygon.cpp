// SPDX-License-Identifier: MIT
#include "support/boost_polygon.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

namespace voussoir_test::boost_polygon {

namespace {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point, false, false>;  // anticlockwise, open

Polygon to_boost(const Outline& outline) {
  Polygon result;
  for (const voussoir::Vec2& v : outline) result.outer().emplace_back(v.x(), v.y());
  return result;
}

}  // namespace

bool is_valid(const Outline& outline) { return bg::is_valid(to_boost(outline)); }

bool is_valid_either_way(const Outline& outline) {
  Polygon polygon = to_boost(outline);
  bg::correct(polygon);
  return bg::is_valid(polygon);
}

double area(const Outline& outline) { return bg::area(to_boost(outline)); }

double area_of_convex_hull(const Outline& outline) {
  Polygon hull;
  bg::convex_hull(to_boost(outline), hull);
  return bg::area(hull);
}

bool contains(const Outline& outline, const voussoir::Vec2& point) {
  return bg::within(Point(point.x(), point.y()), to_boost(outline));
}

}  // namespace voussoir_test::boost_polygon
