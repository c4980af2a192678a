// SPDX-License-Identifier: MIT
#include "limit_answer.hpp"

#include <chrono>
#include <cmath>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/design/limit_problem.hpp>
#include <voussoir/drawing/number_text.hpp>

#include "output_parts.hpp"

namespace voussoir::program {

namespace {

using Json = nlohmann::ordered_json;

/// Of the blocks that the mechanism moves: more than a thousandth of that which moves most.
template <class Geometry>
double moving_measure(const TunnelIn<Geometry>& tunnel, const LimitBound& bound) {
  const auto speed = [](const std::vector<double>& v) {
    double squares = 0;
    for (const double part : v) squares += part * part;
    return std::sqrt(squares);
  };
  double most = 0, measure = 0;
  for (const auto& velocity : bound.mechanism) most = std::max(most, speed(velocity));
  for (std::size_t b = 0; b < bound.mechanism.size(); ++b)
    if (speed(bound.mechanism[b]) > 1e-3 * most)
      measure += tunnel.mass().bodies[b].properties.measure;
  return measure;
}

/// Whether a side, or the top, can push harder than in situ.
template <int Dim>
bool can_push_harder(const FarField<Dim>& field) {
  if (field.at(SideOf<Dim>::top) != Boundary::stress) return true;
  for (int axis = 0; axis < Dim - 1; ++axis)
    for (const bool upper : {false, true})
      if (field.at(axis, upper) != Boundary::stress) return true;
  return false;
}

template <class Geometry>
LimitAnswer answer_of(const TunnelIn<Geometry>& stands, const LawsBySet<AnyJoint>& laws,
                      double first, const Report& report) {
  const auto start = std::chrono::steady_clock::now();
  LimitAnswer answer;
  answer.reason.clear();
  if constexpr (Geometry::dim == 3) answer.unit = "m3";
  if (stands.bolt_count() > 0 || stands.lining() != nullptr) {
    answer.reason = "not sought: it is of rock without bolts and linings";
    return answer;
  }
  for (const AnyJoint& law : laws.all())
    if (law.as<BartonBandisJoint>() != nullptr) {
      answer.reason =
          "not sought: of Barton and Bandis' joints the strength is no sum of friction and cohesion";
      return answer;
    }
  const LimitSearch search{.first = first, .least = std::min(LimitSearch{}.least, first)};
  const auto sought = [&](SideForces sides) {
    return limit_load(limit_problem_of(stands, laws, sides), search, [&](double factor) {
      return report("limit load, strength over " + significant_text(factor, 4), 0);
    });
  };
  try {
    answer.bound = sought(SideForces::any);
    answer.moving = moving_measure(stands, *answer.bound);
    if (!stands.in_situ().is_laid && can_push_harder(stands.far_field()))
      answer.in_situ_sides = sought(SideForces::in_situ);
  } catch (const NumericalFault& fault) {
    answer.reason = fault.what();
  }
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return answer;
}

std::string bracket_text(const LimitBound& bound) {
  if (std::isinf(bound.fails)) return "none: all blocks are held even without any strength";
  if (bound.holds == 0) return "less than " + significant_text(bound.fails, 4);
  return significant_text(bound.fails, 3) + ": forces hold all blocks over " +
         significant_text(bound.holds, 4) + ", a mechanism moves over " +
         significant_text(bound.fails, 4) + text(", gap %.2g %%", 100 * bound.gap());
}

Json bound_json(const LimitBound& bound) {
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  return {{"bound", number(bound.fails)},
          {"holds_over", bound.holds > 0 ? number(bound.holds) : Json()},
          {"fails_over", number(bound.fails)},
          {"gap_percent", bound.is_closed() ? Json(100 * bound.gap()) : Json()},
          {"unbalance_over_weight", bound.unbalance},
          {"missing_over_weight", bound.missing},
          {"programmes", bound.programmes}};
}

}  // namespace

LimitAnswer limit_of(const Tunnel& stands, const LawsBySet<AnyJoint>& laws, double first,
                     const Report& report) {
  return answer_of(stands, laws, first, report);
}
LimitAnswer limit_of(const SpatialTunnel& stands, const LawsBySet<AnyJoint>& laws, double first,
                     const Report& report) {
  return answer_of(stands, laws, first, report);
}

std::string limit_text(const LimitAnswer& answer, double stands) {
  std::string out;
  if (!answer.bound) return "limit    " + answer.reason + "\n";
  out += "limit    " + bracket_text(*answer.bound) + text(" (in %.1f s)\n", answer.seconds);
  out +=
      "         rigid blocks whose joints dilate by their friction: an upper bound, no safe "
      "value\n";
  if (answer.moving > 0 && std::isfinite(answer.bound->fails))
    out += text("         %.3g ", answer.moving) + answer.unit + " move\n";
  if (answer.in_situ_sides)
    out += "         with sides that push as in situ and no harder: " +
           bracket_text(*answer.in_situ_sides) + "\n";
  if (answer.bound->fails < stands)
    out +=
        "warning  the limit load lies below a factor over which it stands: the verdict of that "
        "trial, or the geometry in which blocks have moved, is in doubt\n";
  return out;
}

Json limit_json(const LimitAnswer& answer) {
  if (!answer.bound) return {{"bound", nullptr}, {"reason", answer.reason}};
  Json json = bound_json(*answer.bound);
  json["is_infinite"] = std::isinf(answer.bound->fails);
  json[std::string("mechanism_") + answer.unit] = answer.moving;
  json["in_situ_sides"] = answer.in_situ_sides ? bound_json(*answer.in_situ_sides) : Json();
  json["seconds"] = answer.seconds;
  return json;
}

}  // namespace voussoir::program
