// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/construction_plan.hpp>

/// What the supports of a tunnel cost, per metre of it.
namespace voussoir::design {

inline constexpr double steel_density = 7850;  ///< EN 1991-1-1, table A.4 [kg/m^3]

/// What is installed, per metre of the opening that it is in.
struct SupportQuantities {
  double holes = 0;        ///< [1/m]
  double bolt_length = 0;  ///< [m/m]
  double concrete = 0;     ///< in place [m^3/m]
  double steel = 0;        ///< of bars and ribs in linings [kg/m]
};

/// Of all patterns and linings that stages install, each once.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE SupportQuantities
support_quantities(const AnalysisInput& input, const SupportChoice& supports);

/// Per metre [currency/m]. Of what is sprayed the rebound is paid for.
[[nodiscard]] inline double cost_of(const CostsInput& costs, const SupportQuantities& quantities) {
  return costs.bolt_per_hole * quantities.holes + costs.bolt_per_metre * quantities.bolt_length +
         costs.concrete_per_m3 * quantities.concrete / (1 - costs.rebound) +
         costs.steel_per_kg * quantities.steel;
}

/// The length of an outline that is seen from the origin between two angles [m].
[[nodiscard]] VOUSSOIR_DESIGN_INLINE double length_within(const SimplePolygon& outline,
                                                          const ArcInput& arc);

#if VOUSSOIR_DESIGN_BODIES

VOUSSOIR_DESIGN_INLINE double length_within(const SimplePolygon& outline, const ArcInput& arc) {
  const double whole = 2 * std::numbers::pi;
  const auto is_within = [&](const Vec2& point) {
    const double turned = elementary::angle_of(point.y(), point.x()) - arc.from;
    return turned - whole * std::floor(turned / whole) <= arc.to - arc.from;
  };
  double sum = 0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 from = outline.vertices()[k],
               way = outline.vertices()[(k + 1) % outline.size()] - from;
    // Where the ray of an angle cuts the edge; 1: it does not.
    const auto cut = [&](double angle) {
      const Vec2 ray(elementary::cosine(angle), elementary::sine(angle));
      const double across = cross(way, ray);
      if (across == 0) return 1.0;
      const double at = -cross(from, ray) / across;
      return at > 0 && at < 1 && (from + at * way).dot(ray) > 0 ? at : 1.0;
    };
    const double one = cut(arc.from), other = cut(arc.to);
    const double ends[] = {0, std::min(one, other), std::max(one, other), 1};
    for (std::size_t part = 0; part < 3; ++part)
      if (is_within(from + 0.5 * (ends[part] + ends[part + 1]) * way))
        sum += (ends[part + 1] - ends[part]) * way.norm();
  }
  return sum;
}

VOUSSOIR_DESIGN_INLINE SupportQuantities support_quantities(const AnalysisInput& input,
                                                            const SupportChoice& supports) {
  SupportQuantities sum;
  std::vector<char> has_bolts(input.bolts.size(), 0), has_lining(input.linings.size(), 0);
  for (const StageInput& stage : input.stages) {
    for (const std::size_t k : stage.bolts) has_bolts[k] = 1;
    for (const std::size_t k : stage.linings) has_lining[k] = 1;
  }
  for (std::size_t k = 0; k < input.bolts.size(); ++k) {
    const BoltsInput& pattern = input.bolts[k];
    const auto spacing = detail::spacing_of(pattern, k, supports);
    if (has_bolts[k] == 0 || !spacing) continue;
    for (const Segment& bar : bars_of_pattern(input, pattern, *spacing)) {
      sum.holes += 1 / pattern.out_of_plane;
      sum.bolt_length += bar.length() / pattern.out_of_plane;
    }
  }
  for (std::size_t k = 0; k < input.linings.size(); ++k) {
    const LiningInput& lining = input.linings[k];
    const double thickness = thickness_of(input, lining, supports);
    if (has_lining[k] == 0 || !(thickness > 0)) continue;
    const SimplePolygon outline = outline_of(outline_input(input, lining.opening));
    const ArcInput arc = lining.arc.value_or(ArcInput{0, 2 * std::numbers::pi});
    // On the inside of the wall: its middle turns as the wall does, half a thickness further in.
    const double wall = lining.arc ? length_within(outline, arc) : outline.perimeter();
    const double length = wall - 0.5 * thickness * (arc.to - arc.from);
    sum.concrete += thickness * length;
    if (lining.concrete)
      for (const BarLayer& bars : lining.concrete->bars)
        sum.steel += steel_density * bars.area * length;
    if (lining.ribs) sum.steel += steel_density * lining.ribs->area / lining.ribs->spacing * length;
  }
  return sum;
}

#endif

}  // namespace voussoir::design
