// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/design/section_capacity.hpp>

/// Whether a section of a lining bears thrust, moment and shear: the check of thrust and moment
/// that its `method` asks for, and shear beside it.
namespace voussoir::design {

/// Stresses of an elastic, uncracked section at its edges, N/A +- M/W, against f_cd and f_ctd: the
/// check that practice uses for shotcrete. Bars and fibres do not count.
[[nodiscard]] inline SectionUtilisation edge_stress_utilisation(const ConcreteSection& section,
                                                                const SectionForces& load) {
  const double h = section.thickness, area = section.width * h;
  const double mean = load.thrust / area, bent = std::abs(load.moment) / (area * h / 6);
  const double pressed = (mean + bent) / section.design_strength(),
               cracked = (bent - mean) / section.design_tension();
  if (cracked > pressed) return {cracked, SectionMode::cracked_edge};
  return {std::max(pressed, 0.0), SectionMode::pressed_edge};
}

/// Of plain concrete, EN 1992-1-1 12.6.3: 1.5 V / A_cc against f_cvd, the shear stress at which the
/// principal tension comes to f_ctd, less where the compression is high. Of a section that cracks,
/// A_cc is what a constant stress presses, h - 2 M / N deep; fibres, which pull f over the rest,
/// make that h - 2 M / (N + f h). An elastic section is whole.
[[nodiscard]] inline double plain_shear_resistance(const ConcreteSection& s,
                                                   const SectionForces& load) {
  constexpr double uneven = 1.5;  // k, recommended value
  const double h = s.thickness, tension = s.design_tension(), compression = s.design_strength();
  double depth = h, thrust = load.thrust;
  if (s.method == SectionMethod::en1992 && (load.moment != 0 || load.thrust < 0)) {
    const double pull = s.fibre_strength / s.fibre_partial_factor * s.width;
    const double held = load.thrust + pull * h;
    depth = held > 0 ? h - 2 * std::abs(load.moment) / held : 0.0;
    thrust += pull * (h - depth);
    if (!(depth > 0) || thrust < 0) return 0;
  }
  const double stress = thrust / (s.width * depth);
  const double limit = compression - 2 * std::sqrt(tension * (tension + compression));
  const double over = 0.5 * std::max(0.0, stress - limit);
  const double squared = tension * tension + stress * tension - over * over;
  return std::sqrt(std::max(0.0, squared)) * s.width * depth / uneven;
}

/// With bars on the side in tension, EN 1992-1-1 6.2.2 with the recommended values; 0: no bars
/// there.
[[nodiscard]] inline double barred_shear_resistance(const ConcreteSection& s,
                                                    const SectionForces& load) {
  const double h = s.thickness;
  double area = 0, depth = 0;
  for (const BarLayer& bars : s.bars) {
    const double below = load.moment >= 0 ? bars.depth : h - bars.depth;  // the pressed face
    if (below <= 0.5 * h) continue;
    area += bars.area;
    depth += bars.area * below;
  }
  if (!(area > 0)) return 0;
  depth /= area;
  const double size = std::min(2.0, 1 + std::sqrt(0.2 / depth)), f = 1e-6 * s.strength,
               share = std::min(0.02, area / (s.width * depth));
  const double stress =
      1e-6 * std::min(load.thrust / (s.width * h), 0.2 * s.design_strength());  // MPa
  const double borne = std::max(0.18 / s.partial_factor * size * std::cbrt(100 * share * f),
                                0.035 * std::sqrt(size * size * size * f));
  return std::max(0.0, 1e6 * (borne + 0.15 * stress)) * s.width * depth;
}

/// Shear force that a section without links bears under a thrust and a moment [N]: as plain
/// concrete or, where that gives more, by the bars on its side in tension. What plain concrete
/// alone bears in equilibrium, bars do not take away.
[[nodiscard]] inline double shear_resistance(const ConcreteSection& section,
                                             const SectionForces& load) {
  return std::max(plain_shear_resistance(section, load), barred_shear_resistance(section, load));
}

/// Of a shear force that grows together with its thrust and moment, as all utilisations; it is 1
/// where V = V_Rd.
/// @cost  60 to 120 resistances
[[nodiscard]] inline SectionUtilisation shear_utilisation(const ConcreteSection& section,
                                                          const SectionForces& load) {
  const double shear = std::abs(load.shear);
  if (!(shear > 0)) return {0, SectionMode::shear};
  const auto bears = [&](double factor) {
    return factor * shear <=
           shear_resistance(section, {factor * load.thrust, factor * load.moment, 0});
  };
  double low = 0, high = 1e-9;
  if (!bears(high)) return {std::numeric_limits<double>::infinity(), SectionMode::shear};
  while (bears(high) && high < 1e12) {
    low = high;
    high *= 8;
  }
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (bears(middle) ? low : high) = middle;
  }
  return {1 / low, SectionMode::shear};
}

/// All that is checked of a section.
class SectionCheck {
 public:
  /// @throws InvalidInput  a value out of range
  explicit SectionCheck(ConcreteSection section) : capacity_(std::move(section)) {}

  [[nodiscard]] const ConcreteSection& section() const { return capacity_.section(); }

  /// Of thrust and moment by the method of the section, or of shear if that is more. Nothing, of
  /// forces below a millionth of f_cd b h, in moments times h: what an equilibrium leaves over in a
  /// lining that carries nothing may be tension, of which plain concrete bears no part.
  [[nodiscard]] SectionUtilisation utilisation(const SectionForces& load) const {
    const ConcreteSection& s = section();
    const double least = 1e-6 * s.design_strength() * s.width * s.thickness;
    if (std::max({std::abs(load.thrust), std::abs(load.moment) / s.thickness,
                  std::abs(load.shear)}) <= least)
      return {};
    const SectionUtilisation bent = section().method == SectionMethod::en1992
                                        ? capacity_.utilisation(load)
                                        : edge_stress_utilisation(section(), load);
    const SectionUtilisation sheared = shear_utilisation(section(), load);
    return sheared.value > bent.value ? sheared : bent;
  }

  /// Thrusts and moments that it bears, as a polygon: see `SectionCapacity::envelope`; of edge
  /// stresses a rhombus.
  [[nodiscard]] std::vector<SectionForces> envelope() const {
    const ConcreteSection& s = section();
    if (s.method == SectionMethod::en1992) return capacity_.envelope();
    const double area = s.width * s.thickness, f = s.design_strength(), t = s.design_tension();
    const double thrust = 0.5 * (f - t) * area, moment = 0.5 * (f + t) * area * s.thickness / 6;
    return {{f * area, 0}, {thrust, moment}, {-t * area, 0}, {thrust, -moment}};
  }

 private:
  SectionCapacity capacity_;
};

}  // namespace voussoir::design
