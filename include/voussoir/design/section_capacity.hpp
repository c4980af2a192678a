// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>

/// A section of a lining, and how much thrust and moment it bears together by EN 1992-1-1. Thrust
/// is positive in compression, a moment where the outer fibre is in tension. Other checks, and
/// which of them is asked for: design/section_check.hpp.
namespace voussoir::design {

/// Bars or a mesh in one layer of a section.
struct BarLayer {
  double area = 0;   ///< in the width of the section [m^2], > 0
  double depth = 0;  ///< of its centre below the inner face of the lining [m], within the section
  double yield_strength = 500e6;  ///< f_yk [Pa], 1e8 to 2e9
  double modulus = 200e9;         ///< E_s [Pa], 5e10 to 3e11
  double partial_factor = 1.15;   ///< gamma_S [-], 1 to 3
};

/// By which thrust and moment are checked.
enum class SectionMethod {
  en1992,  ///< `SectionCapacity`
  elastic  ///< `edge_stress_utilisation`
};
[[nodiscard]] inline const char* to_string(SectionMethod method) {
  return method == SectionMethod::en1992 ? "EN 1992-1-1, 6.1" : "elastic edge stresses";
}

/// A rectangular section of concrete or shotcrete: plain, with fibres, with bars.
struct ConcreteSection {
  double thickness = 0;            ///< h [m], 1e-3 to 10
  double width = 1;                ///< b, along the tunnel [m], 1e-3 to 1000
  double strength = 0;             ///< f_ck, cylinder, characteristic [Pa], 1e6 to 90e6
  double long_term_factor = 0.85;  ///< alpha_cc [-], 0.5 to 1; EN 1992-1-1 12.3 for plain: 0.8
  double partial_factor = 1.5;     ///< gamma_C [-], 1 to 3
  /// f_Ftu, characteristic, of concrete with fibres once it has cracked [Pa], 0 to 2e7; 0: none.
  double fibre_strength = 0;
  double fibre_partial_factor = 1.5;  ///< of that [-], 1 to 3
  std::vector<BarLayer> bars = {};
  /// Of the thrust over the thickness, |M| / (N h) [-], 0 to 0.5; 0.5: no limit. For sections
  /// without bars and fibres.
  double largest_eccentricity = 0.5;
  SectionMethod method = SectionMethod::en1992;
  /// f_ctk,0.05, characteristic [Pa], 1e5 to 1e7; none: of f_ck, EN 1992-1-1 table 3.1.
  std::optional<double> tensile_strength = {};
  double tensile_factor = 0.8;  ///< alpha_ct [-], 0.5 to 1; 0.8 is of plain concrete, 12.3.1

  [[nodiscard]] double design_strength() const {  ///< f_cd [Pa]
    return long_term_factor * strength / partial_factor;
  }
  [[nodiscard]] double characteristic_tension() const {  ///< f_ctk,0.05 [Pa]
    const double f = 1e-6 * strength;
    return tensile_strength.value_or(
        0.7e6 * (f <= 50 ? 0.3 * std::cbrt(f * f) : 2.12 * std::log(1 + 0.1 * (f + 8))));
  }
  [[nodiscard]] double design_tension() const {  ///< f_ctd [Pa]
    return tensile_factor * characteristic_tension() / partial_factor;
  }
};

struct SectionForces {
  double thrust = 0;  ///< N [N]
  double moment = 0;  ///< M about the middle of the section [N m]
  double shear = 0;   ///< V, either sign [N]
};

/// Of what a section fails that is loaded beyond its capacity.
enum class SectionMode { compression, bending, tension, pressed_edge, cracked_edge, shear, yield };
[[nodiscard]] inline const char* to_string(SectionMode mode) {
  constexpr const char* words[] = {
      "compression",        "bending", "tension", "compression of an edge",
      "tension of an edge", "shear",   "yield"};
  return words[static_cast<std::size_t>(mode)];
}

struct SectionUtilisation {
  /// By how much all forces together may grow is its inverse [-]; infinite: the section does not
  /// bear any part of them.
  double value = 0;
  SectionMode mode = SectionMode::compression;
};

/// Thrusts and moments that a section bears: all strains of plane sections at the limit of EN
/// 1992-1-1, 6.1 (figure 6.1): the parabola-rectangle diagram of 3.1.7, bars elastic to f_yd and
/// then plastic without a limit of strain (3.2.7 b), fibres a constant tensile stress f_Ftu over
/// the cracked part (the rigid-plastic model of fib Model Code 2010, 5.6.4). Concrete that bars
/// displace is taken off. Exact: closed forms of the integrals, no strips.
class SectionCapacity {
 public:
  /// @throws InvalidInput  a value out of range
  explicit SectionCapacity(ConcreteSection section) : section_(std::move(section)) {
    check();
    const double f = section_.strength * 1e-6;  // MPa, as in table 3.1
    const double over = std::max(0.0, 90 - std::max(f, 50.0)) / 100;
    const bool is_high = f > 50;
    peak_ = is_high ? 1e-3 * (2.0 + 0.085 * std::pow(f - 50, 0.53)) : 2e-3;
    crushing_ = is_high ? 1e-3 * (2.6 + 35 * std::pow(over, 4)) : 3.5e-3;
    exponent_ = is_high ? 1.4 + 23.4 * std::pow(over, 4) : 2;
  }

  [[nodiscard]] const ConcreteSection& section() const { return section_; }

  /// A point of the envelope.
  /// @param bending  +1: the inner face is compressed most; -1: the outer face
  /// @param place    0: all of the section is compressed alike; to 1/2: all of it is compressed;
  ///                 to 1: the neutral axis moves up to the compressed face, at which all is in
  ///                 tension [-]
  [[nodiscard]] SectionForces at(int bending, double place) const {
    const double h = section_.thickness;
    if (place <= 0.5) {
      const double other = peak_ * (1 - 2 * place), pivot = (1 - peak_ / crushing_) * h;
      const double most = peak_ + (peak_ - other) * pivot / (h - pivot);
      return forces(bending, most, (most - other) / h);
    }
    const double axis = 2 * h * (1 - place);
    return forces(bending, crushing_,
                  axis > 0 ? crushing_ / axis : std::numeric_limits<double>::infinity());
  }

  /// The envelope as a polygon, from pure compression with the inner face compressed most to pure
  /// tension and back along the other side.
  /// @param points  on each side, 3 or more
  [[nodiscard]] std::vector<SectionForces> envelope(int points = 61) const {
    std::vector<SectionForces> all;
    for (int k = 0; k < points; ++k) all.push_back(at(1, static_cast<double>(k) / (points - 1)));
    for (int k = points - 1; k-- > 1;) all.push_back(at(-1, static_cast<double>(k) / (points - 1)));
    return all;
  }

  /// Of a thrust and a moment that grow together; shear is not asked.
  /// @cost  60 points of the envelope
  [[nodiscard]] SectionUtilisation utilisation(const SectionForces& load) const {
    const double size = std::max(std::abs(load.thrust), std::abs(load.moment) / section_.thickness);
    if (!(size > 0)) return {};
    const auto turned = [&](const SectionForces& point) {  // > 0: beyond the load, towards bending
      return load.thrust * point.moment - load.moment * point.thrust;
    };
    // Bars that lie on one side bend a section that is compressed alike.
    const int bending = turned(at(1, 0)) <= 0 ? 1 : -1;
    double low = 0, high = 1;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (bending * turned(at(bending, middle)) <= 0 ? low : high) = middle;
    }
    const SectionForces limit = at(bending, low);
    const double h = section_.thickness;
    const double growth = (limit.thrust * load.thrust + limit.moment * load.moment / (h * h)) /
                          (load.thrust * load.thrust + load.moment * load.moment / (h * h));
    SectionUtilisation found{growth > 1e-9 * limit_thrust() / size
                                 ? 1 / growth
                                 : std::numeric_limits<double>::infinity(),
                             low <= 0.5                          ? SectionMode::compression
                             : load.thrust < 0 && low > 1 - 1e-9 ? SectionMode::tension
                                                                 : SectionMode::bending};
    if (std::abs(load.moment) > section_.largest_eccentricity * load.thrust * h &&
        section_.largest_eccentricity < 0.5)
      found = {std::numeric_limits<double>::infinity(), SectionMode::bending};
    return found;
  }

 private:
  /// Of the section compressed alike, without its bars [N].
  [[nodiscard]] double limit_thrust() const {
    return section_.design_strength() * section_.width * section_.thickness;
  }

  /// Integrals of the stress over the strain and of their product, from 0 [f_cd].
  [[nodiscard]] double stress_area(double strain) const {
    const double u = std::max(0.0, 1 - strain / peak_);
    return strain - peak_ / (exponent_ + 1) * (1 - std::pow(u, exponent_ + 1));
  }
  [[nodiscard]] double stress_moment(double strain) const {
    const double u = std::max(0.0, 1 - strain / peak_), n = exponent_;
    return 0.5 * strain * strain -
           peak_ * peak_ *
               ((1 - std::pow(u, n + 1)) / (n + 1) - (1 - std::pow(u, n + 2)) / (n + 2));
  }
  [[nodiscard]] double stress(double strain) const {
    if (strain <= 0) return 0;
    return 1 - std::pow(std::max(0.0, 1 - strain / peak_), exponent_);
  }

  /// @param most   strain at the compressed face
  /// @param slope  by which it falls, per depth below that [1/m]; may be infinite
  [[nodiscard]] SectionForces forces(int bending, double most, double slope) const {
    const double h = section_.thickness, f = section_.design_strength() * section_.width;
    double thrust = 0, lever = 0;  // and moment about the compressed face
    const double other = most - slope * h;
    if (slope * h < 1e-7 * peak_) {
      thrust = f * h;
      lever = 0.5 * f * h * h;
    } else if (std::isfinite(slope)) {
      const double least = std::max(other, 0.0);
      const double area = stress_area(most) - stress_area(least),
                   moment = stress_moment(most) - stress_moment(least);
      thrust = f * area / slope;
      lever = f * (most * area - moment) / (slope * slope);
    }
    const double axis = std::isfinite(slope) ? (slope > 0 ? most / slope : h) : 0.0;
    if (axis < h && section_.fibre_strength > 0) {
      const double pull =
          section_.fibre_strength / section_.fibre_partial_factor * section_.width * (h - axis);
      thrust -= pull;
      lever -= 0.5 * pull * (h + axis);
    }
    for (const BarLayer& bars : section_.bars) {
      const double depth = bending > 0 ? bars.depth : h - bars.depth;
      const double yield = bars.yield_strength / bars.partial_factor;
      const double strain =
          std::isfinite(slope) ? most - slope * depth : -std::numeric_limits<double>::infinity();
      const double force = bars.area * (std::clamp(bars.modulus * strain, -yield, yield) -
                                        section_.design_strength() * stress(strain));
      thrust += force;
      lever += force * depth;
    }
    return {thrust, bending * (0.5 * h * thrust - lever)};
  }

  void check() const {
    const auto within = [](double value, const char* what, double low, double high,
                           const char* range) {
      require(value >= low && value <= high, what, value, range);
    };
    within(section_.thickness, "thickness of a section", 1e-3, 10, "1e-3 to 10 m");
    within(section_.width, "width of a section", 1e-3, 1000, "1e-3 to 1000 m");
    within(section_.strength, "strength of concrete", 1e6, 90e6, "1e6 to 9e7 Pa");
    within(section_.long_term_factor, "long-term factor of concrete", 0.5, 1, "0.5 to 1");
    within(section_.partial_factor, "partial factor of concrete", 1, 3, "1 to 3");
    within(section_.fibre_strength, "residual strength of fibres", 0, 2e7, "0 to 2e7 Pa");
    within(section_.fibre_partial_factor, "partial factor of fibres", 1, 3, "1 to 3");
    within(section_.largest_eccentricity, "largest eccentricity", 0, 0.5, "0 to 0.5");
    within(section_.characteristic_tension(), "tensile strength of concrete", 1e5, 1e7,
           "1e5 to 1e7 Pa");
    within(section_.tensile_factor, "factor of the tensile strength of concrete", 0.5, 1,
           "0.5 to 1");
    if (section_.largest_eccentricity < 0.5 &&
        (!section_.bars.empty() || section_.fibre_strength > 0))
      throw InvalidInput(message({"largest eccentricity = ", section_.largest_eccentricity,
                                  ": is of sections without bars and fibres; must be 0.5 here"}));
    for (const BarLayer& bars : section_.bars) {
      require(bars.area > 0 && bars.area < section_.width * section_.thickness, "area of bars",
              bars.area, "> 0 m2 and less than the section");
      require(bars.depth > 0 && bars.depth < section_.thickness, "depth of bars", bars.depth,
              "> 0 m and less than the thickness");
      within(bars.yield_strength, "yield strength of bars", 1e8, 2e9, "1e8 to 2e9 Pa");
      within(bars.modulus, "modulus of bars", 5e10, 3e11, "5e10 to 3e11 Pa");
      within(bars.partial_factor, "partial factor of bars", 1, 3, "1 to 3");
    }
  }

  ConcreteSection section_;
  double peak_, crushing_, exponent_;  ///< epsilon_c2, epsilon_cu2 and n of table 3.1
};

}  // namespace voussoir::design
