// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/page_map.hpp>
#include <voussoir/drawing/svg.hpp>

namespace voussoir::detail {

/// A net on the page.
struct NetFrame {
  Vec2 centre;    ///< [px]
  double radius;  ///< [px], > 0
  /// @param point  of the net: x East, y North, 1 at the rim
  [[nodiscard]] Vec2 operator()(const Vec2& point) const {
    return {centre.x() + radius * point.x(), centre.y() - radius * point.y()};
  }
};

/// Puts names inside a net where they cover each other and what is marked least.
class LabelPlaces {
 public:
  explicit LabelPlaces(const NetFrame& net) : net_(net) {}

  /// Keeps names off a mark.
  void keep_off(const Vec2& at, double half_size) {
    taken_.push_back({at - Vec2::Constant(half_size), at + Vec2::Constant(half_size)});
  }
  /// Keeps names off a line as far as there is room elsewhere.
  void keep_off_line(std::span<const Vec2> points) {
    lines_.insert(lines_.end(), points.begin(), points.end());
  }
  /// Keeps names off one of many small marks as far as there is room elsewhere.
  void keep_off_point(const Vec2& at) { points_.push_back(at); }
  /// A name beside a mark.
  void beside(const Vec2& at, double distance, const std::string& text, const TextStyle& style) {
    Request request{text, style, {}};
    for (const double away : {distance, distance + 9, distance + 20, distance + 34})
      for (const Vec2& side : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, -1), Vec2(0, 1), Vec2(0.7, -0.7),
                               Vec2(-0.7, -0.7), Vec2(0.7, 0.7), Vec2(-0.7, 0.7)})
        request.centres.push_back(centre_of(request, at, side, away));
    requests_.push_back(std::move(request));
  }
  /// A name along a line, in its middle if there is room.
  void along(std::span<const Vec2> line, const std::string& text, const TextStyle& style) {
    Request request{text, style, {}};
    const std::size_t middle = line.size() / 2;
    for (std::size_t step = 0; step + 6 < middle; step += 2)
      for (const std::size_t k : {middle + step, middle - step}) {
        const Vec2 towards = line[k + 1] - line[k - 1];
        const double length = std::sqrt(dot_product(towards, towards));
        if (!(length > 0)) continue;
        const Vec2 aside = perpendicular(towards) / length;
        for (const double sign : {1.0, -1.0})
          request.centres.push_back(centre_of(request, line[k], sign * aside, 5));
      }
    requests_.push_back(std::move(request));
  }

  /// Draws the names, the first requested at the best place.
  void draw(SvgCanvas& canvas) {
    for (const Request& request : requests_) {
      double best = std::numeric_limits<double>::infinity();
      Vec2 place = net_.centre;
      for (std::size_t k = 0; k < request.centres.size(); ++k) {
        const double cost =
            hindrance(box_of(request, request.centres[k])) + 0.02 * static_cast<double>(k);
        if (cost >= best) continue;
        best = cost;
        place = request.centres[k];
      }
      taken_.push_back(box_of(request, place).grown(2));
      TextStyle style = request.style;
      style.anchor = TextAnchor::middle;
      style.halo = true;
      canvas.text(place + Vec2(0, 0.35 * style.size), request.text, style);
    }
  }

 private:
  struct Request {
    std::string text;
    TextStyle style;
    std::vector<Vec2> centres;  ///< where it may be, the best first
  };

  [[nodiscard]] static Vec2 half_size(const Request& request) {
    return {0.5 * text_width(request.text, request.style), 0.45 * request.style.size};
  }
  /// Centre of a name whose box begins at some distance from a point.
  [[nodiscard]] static Vec2 centre_of(const Request& request, const Vec2& at, const Vec2& side,
                                      double away) {
    const Vec2 half = half_size(request);
    return at + Vec2(side.x() * (away + half.x()), side.y() * (away + half.y()));
  }
  [[nodiscard]] static ViewRect box_of(const Request& request, const Vec2& centre) {
    const Vec2 half = half_size(request);
    return {centre - half, centre + half};
  }
  [[nodiscard]] double hindrance(const ViewRect& box) const {
    double cost = 0;
    for (const ViewRect& other : taken_) cost += box.overlaps(other) ? 100 : 0;
    for (const Vec2& point : lines_) cost += box.contains(point) ? 1 : 0;
    const ViewRect wider = box.grown(3);
    for (const Vec2& point : points_) cost += wider.contains(point) ? 1 : 0;
    for (const double x : {box.low.x(), box.high.x()})
      for (const double y : {box.low.y(), box.high.y()}) {
        const Vec2 away = Vec2(x, y) - net_.centre;
        if (dot_product(away, away) > (net_.radius - 5) * (net_.radius - 5)) cost += 40;
      }
    return cost;
  }

  NetFrame net_;
  std::vector<ViewRect> taken_;
  std::vector<Vec2> lines_, points_;
  std::vector<Request> requests_;
};

}  // namespace voussoir::detail
