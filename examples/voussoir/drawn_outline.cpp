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
  BoostPolygon polygon;
  for (const Point& p : points) bg::append(polygon.outer(), BoostPoint(p[0], p[1]));
  bg::correct(polygon);
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
  try {
    DxfLimits limits;
    limits.metres = unit;
    if (!layer.empty()) limits.layers = {layer};
    const DxfFile drawing = read_dxf(in, name, origin, limits);
    for (const Vec2& p : outline_from_lines(lines_of(drawing, layer)))
      points.push_back({p.x(), p.y()});
    layout = name + ": " + std::to_string(points.size()) + " points, in " + drawing.unit;
    for (const std::string& note : drawing.notes) layout += "; " + note;
  } catch (const InvalidInput& fault) {
    return refuse(std::string("cannot be used: ") + fault.what(),
                  layer.empty() ? "a closed outline; where there is more in the drawing, its layer"
                                : "a closed outline on that layer");
  }
  if (points.size() > 2000)
    return refuse("has an outline of " + std::to_string(points.size()) + " points",
                  "2000 or fewer");
  if (std::string fault = outline_fault(points, asked.holds_centre); !fault.empty()) {
    if (!asked.holds_centre) return refuse(fault, "a simple outline");
    double low = points[0][0], high = low, bottom = points[0][1], top = bottom;
    for (const Point& p : points) {
      low = std::min(low, p[0]);
      high = std::max(high, p[0]);
      bottom = std::min(bottom, p[1]);
      top = std::max(top, p[1]);
    }
    const auto on_site = [&](double middle, double from) {
      return "\"" + significant_text(middle + from, 9) + " m\"";
    };
    return refuse(fault,
                  "an outline about it; here model.origin = [" +
                      on_site(0.5 * (low + high), origin.x()) + ", " +
                      on_site(0.5 * (bottom + top), origin.y()) + "] is its middle" +
                      (high - low > 100 ? ", and unit = \"mm\" makes it " +
                                              metres((high - low) * (unit > 0 ? 1 : 1e-3)) + " wide"
                                        : ""));
  }
  return points;
}

}  // namespace voussoir::program
