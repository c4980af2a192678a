// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/theory/bolts_and_lining.hpp>
#include <voussoir/theory/elastic_ground.hpp>
#include <voussoir/theory/equivalent_moduli.hpp>

#include "section.hpp"
#include "study.hpp"

/// What several analyses do alike.
namespace voussoir::paper {

/// The equivalent grounds of Table 3: lower and upper estimate, and as measured.
struct NamedGround {
  const char* name;
  ElasticGround ground;
};
[[nodiscard]] inline const std::vector<NamedGround>& elastic_grounds() {
  static const JointedModuli one_set =
      goodman_moduli({normal_stiffness, shear_stiffness}, joint_spacing);
  static const std::vector<NamedGround> grounds{
      {"G_1", {one_set.shear_modulus, 0.2}},
      {"G_2", {shear_modulus_from(one_set.youngs_modulus, 0.2), 0.2}},
      {"G_3", {5.27e8, 0.37}}};
  return grounds;
}
[[nodiscard]] inline SmearedBoltPattern smeared(const Bolts& bolts) {
  return {radius, bolts.length, bolts.spacing, bolts.stiffness * joint_spacing, 1};
}
[[nodiscard]] inline ThinLining thin(const Lining& lining) {
  return {radius, lining.thickness, lining_modulus, lining.interface_stiffness};
}

using Quantity = std::function<double(const Outcome&)>;
[[nodiscard]] inline double crown(const Outcome& o) { return o.convergence.crown; }
/// Mean of the two sides [m].
[[nodiscard]] inline double springing(const Outcome& o) {
  return 0.5 * (o.convergence.left_springing + o.convergence.right_springing);
}
/// The paper's normalisation of bolt forces, F / (p0 D), with bolts one metre apart along the
/// tunnel [-].
inline constexpr double force_unit = ground_pressure * diameter;

/// A series over variants along an axis: mean and deviation over the realisations that stand.
struct Swept {
  Series series;
  Series failed;  ///< where a realisation has no value: at the mean of the others, NaN if there are
                  ///< none
  std::vector<Measured> measured;
};
/// @param scale  of the values for the plot
[[nodiscard]] inline Swept swept(Study& study, const std::string& name,
                                 const std::vector<double>& axis,
                                 const std::function<Variant(double)>& variant_at,
                                 const Quantity& quantity, double scale,
                                 Mark mark = Mark::linked_points) {
  std::vector<Variant> variants;
  for (const double x : axis) variants.push_back(variant_at(x));
  study.prepare(variants);
  Swept result;
  result.series = {name, mark, {}, {}, {}};
  result.failed = {"not all realisations stand", Mark::failed, {}, {}, {}};
  for (std::size_t k = 0; k < axis.size(); ++k) {
    const Measured m = study.measure(variants[k], quantity);
    result.measured.push_back(m);
    if (!m.values.empty()) {
      result.series.x.push_back(axis[k]);
      result.series.y.push_back(scale * m.mean());
      result.series.spread.push_back(scale * m.deviation());
    }
    if (!m.complete()) {
      result.failed.x.push_back(axis[k]);
      result.failed.y.push_back(scale * m.mean());
    }
  }
  return result;
}

/// Draws a series into a plot; where a realisation has no value a red cross joins the others of the
/// plot.
/// @param none  where crosses lie that have no value at all: on the axis
inline void draw(Plot& plot, const Swept& swept, double none = 0) {
  plot.series.push_back(swept.series);
  if (swept.failed.x.empty()) return;
  Series* crosses = nullptr;
  for (Series& s : plot.series)
    if (s.mark == Mark::failed) crosses = &s;
  if (!crosses)
    crosses = &plot.series.emplace_back(Series{swept.failed.name, Mark::failed, {}, {}, {}});
  const auto placed = [none](double value) { return std::isfinite(value) ? value : none; };
  for (const double x : swept.failed.x) crosses->x.push_back(placed(x));
  for (const double y : swept.failed.y) crosses->y.push_back(placed(y));
}

/// What a plot of curves without crosses must say: "Collapsed: bare 3 of 5 realisations." Empty if
/// none.
[[nodiscard]] inline std::string collapsed_text(
    Study& study, const std::vector<std::pair<std::string, Variant>>& variants) {
  std::string text;
  for (const auto& [name, variant] : variants) {
    const Measured m = study.measure(variant, [](const Outcome&) { return 0.0; });
    if (m.collapsed == 0) continue;
    text += (text.empty() ? "Collapsed: " : "; ") + name + " " + std::to_string(m.collapsed) +
            " of " + std::to_string(m.samples) +
            (m.samples == 1 ? " realisation" : " realisations");
  }
  return text.empty() ? text : text + ".";
}

/// The same at the end of a caption.
inline void say_collapsed(Plot& plot, Study& study,
                          const std::vector<std::pair<std::string, Variant>>& variants) {
  const std::string text = collapsed_text(study, variants);
  plot.caption += (plot.caption.empty() || text.empty() ? "" : " ") + text;
}

/// A comparison of two variants realisation by realisation, where both stand.
[[nodiscard]] inline Measured paired(
    Study& study, const Variant& first, const Variant& second,
    const std::function<double(const Outcome&, const Outcome&)>& compare) {
  study.prepare({first, second});
  const std::vector<Outcome>&a = study.of(first), &b = study.of(second);
  Measured m;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k].stable())
      m.add(b[k].report, b[k].stable() ? compare(a[k], b[k]) : 0.0);
    else
      m.add(a[k].report, 0.0);
  }
  return m;
}
/// second / first of a quantity.
[[nodiscard]] inline Measured ratio(Study& study, const Variant& first, const Variant& second,
                                    const Quantity& quantity) {
  return paired(study, first, second,
                [&](const Outcome& a, const Outcome& b) { return quantity(b) / quantity(a); });
}

/// Two numbers closer than this part of them differ by roundings and searches, not by the rock.
inline constexpr double same_number = 1e-9;
/// A block that moves less than this has not moved: a millionth of what the stress of the ground
/// closes a joint by [m].
inline constexpr double no_motion = 1e-6 * ground_pressure / normal_stiffness;

/// PF-009: blocks stay where they are with the angle of friction that the stress needs, and move
/// with less. Not testable where they do not move with less either.
/// @param enough, short_of  how far they move with the angle needed, with four fifths of it [m]
[[nodiscard]] inline Agreement needed_friction_agrees(double enough, double short_of) {
  if (!(short_of > no_motion)) return Agreement::not_testable;
  return agrees_if(enough < std::max(no_motion, 1e-3 * short_of));
}

/// Whether the means go up (or down) along the axis; equal steps count as going.
[[nodiscard]] inline bool rises(const std::vector<Measured>& values,
                                double tolerance = same_number) {
  for (std::size_t k = 0; k + 1 < values.size(); ++k)
    if (!(values[k + 1].mean() >= values[k].mean() - tolerance * std::abs(values[k].mean())))
      return false;
  return true;
}
[[nodiscard]] inline bool falls(const std::vector<Measured>& values,
                                double tolerance = same_number) {
  for (std::size_t k = 0; k + 1 < values.size(); ++k)
    if (!(values[k + 1].mean() <= values[k].mean() + tolerance * std::abs(values[k].mean())))
      return false;
  return true;
}
/// "3.17, 2.80, 1.71 mm"
[[nodiscard]] inline std::string means(const std::vector<Measured>& values, double scale,
                                       const std::string& unit, int digits = 3) {
  std::string text;
  for (const Measured& m : values)
    text +=
        (text.empty() ? "" : ", ") +
        (m.values.empty() ? std::string("none stands") : printed_text(scale * m.mean(), digits));
  return text + (unit.empty() ? "" : " " + unit);
}
/// "3.7e-05"
[[nodiscard]] inline std::string power_text(double value, int decimals = 1) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*e", decimals, value);
  return text;
}
[[nodiscard]] inline std::string percent(double part, int digits = 2) {
  return printed_text(100 * part, digits) + " %";
}

}  // namespace voussoir::paper
