// SPDX-License-Identifier: MIT
#include "drawn_outline.hpp"

#include <algorithm>
#include <boost/geometry/algorithms/append.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/covered_by.hpp>
#include <boost/geometry/algorithms/envelope.hpp>
#include <boost/geometry/algorithms/intersects.hpp>
#include <boost/geometry/algorithms/is_valid.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/geometry/outline_from_lines.hpp>
#include <voussoir/io/operating_system.hpp>

#include "regular_file.hpp"

namespace voussoir::program {

namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostPolygon = bg::model::polygon<BoostPoint, false>;  // anticlockwise

BoostPolygon polygon_of(const std::vector<Point>& points) {
  BoostPolygon polygon;
  for (const Point& p : points) bg::append(polygon.outer(), BoostPoint(p[0], p[1]));
  bg::correct(polygon);
  return polygon;
}

/// "(1.5, 2)", of the first place that a message of Boost.Geometry names; empty if it names none.
std::string place_in(const std::string& message) {
  const std::size_t open = message.find('('), close = message.find(')', open);
  if (open == std::string::npos || close == std::string::npos) return "";
  return " at " + message.substr(open, close - open + 1);
}

std::string ending_of(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

std::string metres(double value) { return format_quantity(value, dimension::length); }

/// Names of the layers that have lines, for a message.
std::string layers_with_lines(const DxfFile& drawing) {
  constexpr std::size_t most = 30;
  std::vector<bool> has_lines(drawing.layers.size(), false);
  for (const DxfPolyline& line : drawing.lines)
    has_lines[static_cast<std::size_t>(line.layer)] = true;
  std::string text;
  std::size_t named = 0;
  for (std::size_t k = 0; k < has_lines.size(); ++k)
    if (has_lines[k] && ++named <= most)
      text += (text.empty() ? "\"" : ", \"") + drawing.layers[k] + "\"";
  return text;
}

/// How a drawing comes to lie about the place asked for; follows "accepted: an outline about it".
/// Units first: a drawing in millimetres that is read in metres lies nowhere near.
/// @param points  relative to `asked.centre` [m]
/// @param unit    in which it was read [m]
std::string way_to_centre(const std::vector<Point>& points, const DrawnOutline& asked,
                          double unit) {
  bg::model::box<BoostPoint> box;
  bg::envelope(polygon_of(points), box);
  const BoostPoint &low = box.min_corner(), &high = box.max_corner();
  const Point& at = asked.centre;
  struct NamedUnit {
    const char* name;
    double metres;
  };
  // By what is most likely; 1: as it was read.
  const NamedUnit units[] = {{"", unit},   {"mm", 1e-3},   {"m", 1},
                             {"cm", 1e-2}, {"ft", 0.3048}, {"in", 0.0254}};
  const auto in_unit = [&](const NamedUnit& other) {
    const double scale = other.metres / unit;
    return std::string("unit = \"") + other.name + "\", with which it is " +
           metres(scale * (high.x() - low.x())) + " wide";
  };
  for (const NamedUnit& other : units)
    for (const double up : {1.0, -1.0}) {
      const double scale = other.metres / unit;
      std::vector<Point> moved = points;
      for (Point& p : moved)
        p = {scale * (p[0] + at[0]) - at[0], up * scale * (p[1] + at[1]) - at[1]};
      if (!outline_fault(moved).empty()) continue;
      std::string way = other.metres == unit ? "" : in_unit(other) + " and lies about model.origin";
      if (up < 0)
        way += std::string(way.empty() ? "" : "; ") +
               "it seems to be drawn with y downwards; mirror it about y = 0 in the "
               "drawing, and it lies about model.origin";
      return way;
    }
  double scale = 1;
  std::string way;
  for (const NamedUnit& other : units) {
    const double width = other.metres / unit * (high.x() - low.x());
    if (!(width > 1 && width < 60)) continue;  // as wide as an adit or a cavern
    scale = other.metres / unit;
    if (other.metres != unit) way = in_unit(other) + ", and ";
    break;
  }
  const auto on_site = [&](double middle, double from) {
    return "\"" + significant_text(scale * (middle + from), 9) + " m\"";
  };
  return way + "model.origin = [" + on_site(0.5 * (low.x() + high.x()), at[0]) + ", " +
         on_site(0.5 * (low.y() + high.y()), at[1]) + "], its middle";
}

}  // namespace

bool is_drawing(const std::filesystem::path& file) { return ending_of(file) == ".dxf"; }

bool is_geojson(const std::filesystem::path& file) {
  return ending_of(file) == ".geojson" || ending_of(file) == ".json";
}

void read_drawing_unit(Section& s, double& unit) {
  (void)s.choice<double>("unit", unit,
                         {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"ft", 0.3048}, {"in", 0.0254}},
                         Need::optional);
}

std::string outline_fault(const std::vector<Point>& points, bool holds_centre) {
  const BoostPolygon polygon = polygon_of(points);
  bg::validity_failure_type failure{};
  std::string message;
  (void)bg::is_valid(polygon, message);
  if (bg::is_valid(polygon, failure)) {
    if (!holds_centre || bg::covered_by(BoostPoint(0, 0), polygon)) return "";
    bg::model::box<BoostPoint> box;
    bg::envelope(polygon, box);
    const BoostPoint &low = box.min_corner(), &high = box.max_corner();
    return "does not contain its centre (0, 0): it lies at x " + metres(low.x()) + " to " +
           metres(high.x()) + ", y " + metres(low.y()) + " to " + metres(high.y());
  }
  switch (failure) {
    case bg::failure_duplicate_points:
      return "has the same point twice" + place_in(message);
    case bg::failure_spikes:
      return "folds back on itself" + place_in(message);
    case bg::failure_self_intersections:
      return "crosses itself" + place_in(message);
    case bg::failure_few_points:
    case bg::failure_wrong_topological_dimension:
      return "encloses no area";
    case bg::failure_wrong_orientation:  // neither way round: as much area to the left as right
      return bg::intersects(polygon.outer()) ? "crosses itself" : "encloses no area";
    default:
      return "is no simple polygon: " + message;
  }
}

bool is_flat_above_an_arch(const std::vector<Point>& points) {
  bg::model::box<BoostPoint> box;
  bg::envelope(polygon_of(points), box);
  const double left = box.min_corner().x(), bottom = box.min_corner().y(),
               width = box.max_corner().x() - left, height = box.max_corner().y() - bottom;
  // A floor may fall to a drain by a few per cent; of an arch hardly a chord is as level.
  constexpr double slope = 0.05;
  const double near_bottom = bottom + std::min(0.05 * height, 0.03 * width);
  double level_on_top = 0, level_below = 0, low = left + width, high = left;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point &a = points[k], &b = points[(k + 1) % points.size()];
    const double run = b[0] - a[0], rise = b[1] - a[1];
    const bool is_level = std::abs(rise) <= slope * std::abs(run);
    if (is_level && run > 0) level_below += run;
    if (is_level && run < 0 && std::min(a[1], b[1]) > bottom + 0.9 * height) level_on_top -= run;
    if ((a[1] < near_bottom) == (b[1] < near_bottom)) continue;
    const double x = a[0] + run * (near_bottom - a[1]) / rise;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  // The last: the uneven floor of a drift under a bedding plane is no arch, nor is a drain.
  return level_on_top > 0.5 * width && level_below < 0.3 * width && high - low < 0.75 * width;
}

std::vector<Point> drawn_outline(Section& s, std::string& layout, const std::filesystem::path& file,
                                 const DrawnOutline& asked) {
  const auto refuse = [&](const std::string& why, const std::string& accepted) {
    s.complain("file", why, accepted);
    return std::vector<Point>{};
  };
  const std::string form = "an ASCII DXF, R12 to 2018, relative to the input file";
  std::ifstream in;
  if (!is_drawing(file))
    return refuse("is no drawing that is read", form + ": its name ends in .dxf");
  if (const std::string fault = open_regular(file, in); !fault.empty()) return refuse(fault, form);
  const std::string name = utf8_text(file);
  const std::string& layer = asked.layer;
  const double unit = asked.unit;
  const Vec2 origin(asked.centre[0], asked.centre[1]);
  std::vector<Point> points;
  std::string layers;
  double read_in = 1;
  try {
    DxfLimits limits;
    limits.metres = unit;
    if (!layer.empty()) limits.layers = {layer};
    const DxfFile drawing = read_dxf(in, name, origin, limits);
    read_in = drawing.metres;
    layers = layers_with_lines(drawing);
    for (const Vec2& p : outline_from_lines(lines_of(drawing, layer)))
      points.push_back({p.x(), p.y()});
    layout = name + ": " + std::to_string(points.size()) + " points, in " + drawing.unit;
    for (const std::string& note : drawing.notes) layout += "; " + note;
  } catch (const InvalidInput& fault) {
    // What the library accepts, a tolerance, is no key of this file; places are as it reads them.
    std::string why = fault.what();
    const bool is_of_outline = why.starts_with("outline: ");
    if (is_of_outline) why = why.substr(0, why.find("; accepted:"));
    if (is_of_outline && why.find('(') != std::string::npos) why += ", places from model.origin";
    std::string accepted = "one closed outline";
    if (!layer.empty()) accepted += " on that layer";
    if (is_of_outline) accepted += ", whose ends meet within 1 mm";
    if (layer.empty() && !layers.empty())
      accepted += "; where there is more in the drawing, its layer: " + layers;
    return refuse("cannot be used: " + why, accepted);
  }
  if (points.size() > 2000)
    return refuse("has an outline of " + std::to_string(points.size()) + " points",
                  "2000 or fewer");
  if (std::string fault = outline_fault(points, asked.holds_centre); !fault.empty()) {
    if (!fault.starts_with("does not contain")) return refuse(fault, "a simple outline");
    return refuse(fault, "an outline about it: " + way_to_centre(points, asked, read_in));
  }
  return points;
}

}  // namespace voussoir::program
