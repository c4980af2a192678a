// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/outline_overlap.hpp>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/geometry/spatial_line.hpp>
#include <voussoir/rockmass/opening_checks.hpp>

namespace voussoir {

// What is wrong with a construction before any of it is carried out.

/// A place on a bar that lies in an opening, or nothing: a bar that ends on its wall touches it.
/// @param tolerance  what lies inside over no more than this does not count [m], > 0
[[nodiscard]] VOUSSOIR_INLINE std::optional<Vec2> place_inside(const Segment& bar,
                                                               const SimplePolygon& opening,
                                                               double tolerance);
[[nodiscard]] VOUSSOIR_INLINE std::optional<Vec3> place_inside(const SpatialLine& bar,
                                                               const PrismaticOpening& opening,
                                                               double tolerance);

/// @param mass  in which it is to be carried out
/// @throws InvalidInput  an opening that does not fit, rounds that overlap or come twice; bolts of
/// an
///                       earlier stage in rock that a later one takes out. The message names stage,
///                       place and remedy
/// @cost  rounds^2 x edges^2, bolts x later rounds x edges
template <class Plan, class Mass>
void check_construction(const Plan& plan, const Mass& mass) {
  const double tolerance = 1e3 * mass.domain.tolerance();
  Mass planned;  // of which only the openings count
  planned.domain = mass.domain;
  planned.openings = mass.openings;
  for (const auto& stage : plan.stages)
    naming("stage \"" + stage.name + "\"", [&] {
      for (const auto& round : stage.rounds) {
        check_opening(round.opening, planned);
        planned.openings.push_back(round.opening);
      }
    });
  for (std::size_t s = 0; s < plan.stages.size(); ++s)
    for (std::size_t later = s + 1; later < plan.stages.size(); ++later)
      for (const auto& round : plan.stages[later].rounds) {
        int number = 0;
        for (const auto& bolts : plan.stages[s].bolts)
          for (const auto& bar : bolts.bars) {
            ++number;
            const auto place = place_inside(bar, round.opening, tolerance);
            if (!place) continue;
            using Place = std::decay_t<decltype(*place)>;
            throw InvalidInput(
                message({"stage \"", plan.stages[s].name, "\": bolt ", number, " runs at ",
                         text_of<static_cast<int>(Place::RowsAtCompileTime)>(*place),
                         " m through rock that stage \"", plan.stages[later].name,
                         "\" takes out: install it after that, or end it outside"}));
          }
      }
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::optional<Vec2> place_inside(const Segment& bar, const SimplePolygon& opening,
                                                 double tolerance) {
  const std::vector<double> at = detail::meetings(bar, opening);
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    if ((at[k + 1] - at[k]) * bar.length() <= 2 * tolerance) continue;
    const Vec2 middle = bar.at(0.5 * (at[k] + at[k + 1]));
    // Not along the wall: on both sides of the bar the opening goes on.
    const Vec2 beside = tolerance * normalized(perpendicular(bar.end - bar.start));
    if (opening.contains(middle + beside) && opening.contains(middle - beside)) return middle;
  }
  return {};
}

VOUSSOIR_INLINE std::optional<Vec3> place_inside(const SpatialLine& bar,
                                                 const PrismaticOpening& opening,
                                                 double tolerance) {
  const Vec3 a = opening.axis().local(bar.start), b = opening.axis().local(bar.end);
  // The part of the bar between the ends of the opening.
  double from = 0, to = 1;
  const double rise = b.z() - a.z();
  const auto keep = [&](double end, double sign) {  // sign * place <= sign * end
    const double above = sign * (a.z() - end) + tolerance, climb = sign * rise;
    if (climb == 0) {
      if (above > 0) to = -1;
    } else {
      (climb > 0 ? to : from) =
          climb > 0 ? std::min(to, -above / climb) : std::max(from, -above / climb);
    }
  };
  if (std::isfinite(opening.to())) keep(opening.to(), 1);
  if (std::isfinite(opening.from())) keep(opening.from(), -1);
  if (!((to - from) * bar.length() > 2 * tolerance)) return {};
  const Vec3 p = a + from * Vec3(b - a), q = a + to * Vec3(b - a);
  const Segment seen{{p.x(), p.y()}, {q.x(), q.y()}};
  if (seen.length() <= 4 * tolerance) {  // along the axis
    const Vec2 middle = seen.centre();
    if (!opening.section().contains(middle)) return {};
    return opening.in_space(middle, 0.5 * (p.z() + q.z()));
  }
  const auto place = place_inside(seen, opening.section(), tolerance);
  if (!place) return {};
  const double part = length_of(Vec2(*place - seen.start)) / seen.length();
  return opening.in_space(*place, p.z() + part * (q.z() - p.z()));
}

#endif

}  // namespace voussoir
