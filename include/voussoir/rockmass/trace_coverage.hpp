// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/joint.hpp>
#include <voussoir/rockmass/mapped_trace.hpp>

namespace voussoir {

/// The part of a trace that lies in the domain, if any.
[[nodiscard]] VOUSSOIR_INLINE std::optional<Segment> inside_of(const Domain<2>& domain,
                                                               const Segment& trace);

/// How mapped traces lie to the ground that is modelled.
struct TraceCoverage {
  std::size_t count = 0;   ///< of traces
  std::size_t inside = 0;  ///< of them, those that reach into the domain
  Vec2 low, high;          ///< extent of all traces, on the site grid [m]
};

/// @pre  at least one trace
[[nodiscard]] VOUSSOIR_INLINE TraceCoverage trace_coverage(const std::vector<MappedTrace>& traces,
                                                           const Domain<2>& domain);

/// Says how many traces reach the domain, where both lie, and what is probably wrong: the unit of
/// the coordinates, or the site coordinates of the model's origin.
/// @param origin_name  what the user calls the latter
[[nodiscard]] VOUSSOIR_INLINE std::string coverage_text(const TraceCoverage& found,
                                                        const Domain<2>& domain,
                                                        const std::string& origin_name);

/// How many blocks joints will cut, before any is cut: one for each, and one for each crossing of
/// two, but no more than blocks of the smallest inscribed circle have room. Within a factor of two
/// for networks in which joints do not end in whole rock; three joints through one point count as
/// three crossings, where they make two.
///
/// @cost  linear in the joints: crossings are not looked for one by one but taken from the length
///        and the direction of what runs through each of 24 x 24 cells
[[nodiscard]] VOUSSOIR_INLINE double estimated_blocks(const std::vector<Joint>& joints,
                                                      const Domain<2>& domain,
                                                      double min_inscribed_radius);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::optional<Segment> inside_of(const Domain<2>& domain, const Segment& trace) {
  std::optional<Segment> inside = trace;
  for (int axis = 0; axis < 2; ++axis)
    for (const double sign : {1.0, -1.0}) {
      if (!inside) return inside;
      const HalfSpace<2> side{sign * axis_vector<2>(axis),
                              sign > 0 ? domain.high[axis] : -domain.low[axis]};
      inside = split(*inside, side, domain.tolerance()).below;
    }
  return inside;
}

VOUSSOIR_INLINE TraceCoverage trace_coverage(const std::vector<MappedTrace>& traces,
                                             const Domain<2>& domain) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  TraceCoverage found{traces.size(), 0, Vec2(inf, inf), Vec2(-inf, -inf)};
  for (const MappedTrace& trace : traces) {
    bool is_inside = false;
    for (std::size_t k = 1; k < trace.points.size(); ++k)
      is_inside = is_inside || inside_of(domain, {trace.points[k - 1], trace.points[k]});
    found.inside += is_inside;
    for (const Vec2& end : trace.points)
      for (int axis = 0; axis < 2; ++axis) {
        const double at = end[axis] + domain.site_origin[axis];
        found.low[axis] = std::min(found.low[axis], at);
        found.high[axis] = std::max(found.high[axis], at);
      }
  }
  return found;
}

VOUSSOIR_INLINE std::string coverage_text(const TraceCoverage& found, const Domain<2>& domain,
                                          const std::string& origin_name) {
  const Vec2 low = domain.low + domain.site_origin, high = domain.high + domain.site_origin;
  const auto meets = [&](const Vec2& a, const Vec2& b) {
    return a.x() < high.x() && b.x() > low.x() && a.y() < high.y() && b.y() > low.y();
  };
  const double span = std::max(found.high.x() - found.low.x(), found.high.y() - found.low.y());
  std::string cause;
  struct Unit {
    const char* name;
    double metres;
  };
  // A guess is said where it fits: traces that are then as large as the domain, and lie on it.
  for (const Unit& unit : {Unit{"", 1}, Unit{"millimetres", 1e-3}, Unit{"centimetres", 1e-2},
                           Unit{"feet", 0.3048}, Unit{"kilometres", 1e3}})
    for (const bool is_down : {false, true}) {
      const bool is_metres = unit.metres == 1;
      if (!cause.empty() || (is_metres && !is_down)) continue;
      if (found.inside > 0 && (is_metres || unit.metres != 1e-3)) continue;
      const double size = unit.metres * span / domain.diameter();
      Vec2 a = unit.metres * found.low, b = unit.metres * found.high;
      if (is_down) {
        a = Vec2(a.x(), -unit.metres * found.high.y());
        b = Vec2(b.x(), -unit.metres * found.low.y());
      }
      if (!(size > 0.1 && size < 10 && meets(a, b))) continue;
      if (!is_metres)
        cause = std::string("coordinates in ") + unit.name + ", where metres are read";
      if (is_down)
        cause += std::string(is_metres ? "" : ", and ") +
                 "y counted downwards, where it is read upwards";
    }
  const std::string middle = text_of<2>(Vec2(0.5 * (found.low + found.high))) + " m";
  const double size = span / domain.diameter();
  if (cause.empty() && size > 100)
    cause = "coordinates that are not in metres, or a map of a far larger area";
  if (cause.empty() && size > 0.02)
    cause = origin_name + ", the place of the model on the site grid, which is " +
            text_of<2>(domain.site_origin) + " m: the middle of the traces is " + middle;
  if (cause.empty())
    cause = "none that fits: the traces are far smaller than the domain and lie around " + middle;
  return std::to_string(found.inside) + " of " + std::to_string(found.count) +
         (found.count == 1 ? " trace reaches" : " traces reach") +
         " into the domain: on the site grid the traces lie within " + text_of<2>(found.low) +
         " and " + text_of<2>(found.high) + " m, the domain within " + text_of<2>(low) + " and " +
         text_of<2>(high) + " m; probable cause: " + cause;
}

VOUSSOIR_INLINE double estimated_blocks(const std::vector<Joint>& joints, const Domain<2>& domain,
                                        double min_inscribed_radius) {
  constexpr int cells = 24, directions = 90;
  std::vector<double> lengths(std::size_t{cells} * cells * directions, 0.0);
  double blocks = 1;
  std::vector<double> at;
  for (const Joint& joint : joints) {
    const auto inside = inside_of(domain, joint.trace);
    if (!inside) continue;
    ++blocks;
    const Vec2 run = inside->end - inside->start, size = domain.size();
    double angle = elementary::angle_of(run.y(), run.x()) / std::numbers::pi;
    angle -= std::floor(angle);  // a line has no sense: 0 to 1 is half a turn
    const auto direction = static_cast<std::size_t>(angle * directions) % directions;
    at.assign({0.0, 1.0});  // where it passes from cell to cell
    for (int axis = 0; axis < 2; ++axis) {
      if (run[axis] == 0) continue;
      const double from = (inside->start[axis] - domain.low[axis]) / size[axis] * cells;
      const double to = (inside->end[axis] - domain.low[axis]) / size[axis] * cells;
      for (double k = std::floor(std::min(from, to)) + 1; k < std::max(from, to); ++k)
        at.push_back((k - from) / (to - from));
    }
    std::sort(at.begin(), at.end());
    for (std::size_t k = 1; k < at.size(); ++k) {
      const Vec2 middle = inside->start + 0.5 * (at[k - 1] + at[k]) * run;
      std::array<std::size_t, 2> cell{};
      for (int axis = 0; axis < 2; ++axis)
        cell[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(
            std::clamp((middle[axis] - domain.low[axis]) / size[axis] * cells, 0.0, cells - 1.0));
      lengths[(cell[1] * cells + cell[0]) * directions + direction] +=
          (at[k] - at[k - 1]) * length_of(run);
    }
  }
  const double cell_area = domain.measure() / (cells * cells);
  for (std::size_t cell = 0; cell < std::size_t{cells} * cells; ++cell) {
    const double* of = &lengths[cell * directions];
    for (std::size_t i = 0; i < directions; ++i)
      for (std::size_t j = 0; of[i] > 0 && j < i; ++j)
        if (of[j] > 0)
          blocks += of[i] * of[j] / cell_area *
                    elementary::sine(std::numbers::pi * static_cast<double>(i - j) / directions);
  }
  // A grid of squares has one block to 4 r^2.
  return std::min(blocks, 0.25 * domain.measure() / (min_inscribed_radius * min_inscribed_radius));
}

#endif

}  // namespace voussoir
