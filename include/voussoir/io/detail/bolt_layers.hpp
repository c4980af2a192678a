// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/drawing/picture_parts.hpp>
#include <voussoir/drawing/svg.hpp>
#include <voussoir/io/blocks_picture_data.hpp>

namespace voussoir::detail {

inline bool is_drawable(const PictureBolt& bolt) {
  return bolt.head.allFinite() && bolt.tip.allFinite() && bolt.head != bolt.tip;
}

/// Greatest tension along a bolt [N]; 0 without crossings.
inline double max_force(const PictureBolt& bolt) {
  double force = 0;
  for (const PictureCrossing& crossing : bolt.crossings) {
    if (std::isfinite(crossing.force)) force = std::max(force, crossing.force);
  }
  return force;
}

/// A smaller force is drawn as short as it is, not as if it were the largest there can be [N].
inline constexpr double negligible_bolt_force = 1e3;

/// Length of a force bar on the page, such that bars do not reach the next bolt.
class ForceScale {
 public:
  ForceScale(const std::vector<PictureBolt>& bolts, const PageMap& map) {
    double largest = 0;
    std::vector<double> gaps;
    for (const PictureBolt& bolt : bolts) {
      if (!is_drawable(bolt)) continue;
      for (const PictureCrossing& crossing : bolt.crossings) {
        if (std::isfinite(crossing.force)) largest = std::max(largest, std::abs(crossing.force));
      }
      double nearest = 60 / map.scale();
      for (const PictureBolt& other : bolts) {
        const double gap = (bolt.head + bolt.tip - other.head - other.tip).norm() / 2;
        if (&other != &bolt && gap > 0) nearest = std::min(nearest, gap);
      }
      gaps.push_back(nearest * map.scale());
    }
    if (gaps.empty() || largest == 0) return;
    largest = std::max(largest, negligible_bolt_force);
    std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2),
                     gaps.end());
    px_per_newton_ = std::clamp(0.85 * gaps[gaps.size() / 2], 14.0, 50.0) / largest;
    sample_ = round_down_125(largest);
  }
  [[nodiscard]] double px_per_newton() const { return px_per_newton_; }
  [[nodiscard]] double sample() const { return sample_; }  ///< force of the legend's bar [N]; or 0

 private:
  double px_per_newton_ = 0, sample_ = 0;
};

VOUSSOIR_INLINE void draw_crossing_state(SvgCanvas& canvas, const Vec2& at,
                                         PictureCrossing::State state);

/// Bolts as lines with a plate, and at each crossing a bar across the bolt as long as the force
/// (Boon et al. 2015, Fig. 9). Compression, which few bolts carry, is drawn to the other side.
VOUSSOIR_INLINE void draw_bolts(SvgCanvas& canvas, const BlocksPicture& picture, const PageMap& map,
                                const ForceScale& scale);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void draw_crossing_state(SvgCanvas& canvas, const Vec2& at,
                                         PictureCrossing::State state) {
  if (state == PictureCrossing::State::yielded) {
    draw_diamond(canvas, at, 5, {.fill = "#ffb000", .stroke = "black", .stroke_width = 1.2});
  } else if (state == PictureCrossing::State::ruptured) {
    draw_cross(canvas, at, 5, {.stroke = "white", .stroke_width = 5.5, .round_ends = true});
    draw_cross(canvas, at, 5, {.stroke = "#c00000", .stroke_width = 2.8, .round_ends = true});
  }
}

VOUSSOIR_INLINE void draw_bolts(SvgCanvas& canvas, const BlocksPicture& picture, const PageMap& map,
                                const ForceScale& scale) {
  SvgPath lines, bars;
  for (const PictureBolt& bolt : picture.bolts) {
    if (!is_drawable(bolt)) continue;
    const Vec2 head = map(bolt.head), along = (map(bolt.tip) - head).normalized();
    lines.add_line(head, map(bolt.tip));
    lines.add_line(head - 4.5 * perpendicular(along), head + 4.5 * perpendicular(along));
    for (const PictureCrossing& crossing : bolt.crossings) {
      const double length = crossing.force * scale.px_per_newton();
      if (!crossing.point.allFinite() || !std::isfinite(length) || std::abs(length) < 0.3) continue;
      const Vec2 foot = map(crossing.point);
      bars.add_line(foot, foot + length * perpendicular(along));
    }
  }
  canvas.path(lines, {.stroke = "white", .stroke_width = 4.2});
  canvas.path(bars, {.stroke = "white", .stroke_width = 5.2});
  canvas.path(lines, {.stroke = "black", .stroke_width = 2});
  canvas.path(bars, {.stroke = "black", .stroke_width = 3.4});
  for (const PictureBolt& bolt : picture.bolts) {
    for (const PictureCrossing& crossing : bolt.crossings) {
      if (crossing.point.allFinite() && map.world().contains(crossing.point)) {
        draw_crossing_state(canvas, map(crossing.point), crossing.state);
      }
    }
  }
}

#endif

}  // namespace voussoir::detail
