// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/design/section_capacity.hpp>

/// Strength and modulus of concrete and shotcrete that is younger than 28 days. Nothing is counted
/// on that is gained later.
namespace voussoir::design {

inline constexpr double one_day = 86400;  ///< [s]

/// How strength and modulus grow.
enum class AgeLaw {
  /// EN 1992-1-1, 3.1.2(5) and (6), 3.1.3(3), from 3 days on:
  ///   beta = exp(s (1 - sqrt(28 d / t))),  f_cm = f_ck + 8 MPa,
  ///   f_ck(t) = beta f_cm - 8 MPa,  f_ctk(t) = beta f_ctk,  E(t) = beta^0.3 E
  en1992,
  /// Chang & Stille (1993), of shotcrete with accelerator, as later works cite it (t in days):
  ///   f(t) = 1.105 f_28 exp(-0.743 t^-0.7),  E(t) = 1.062 E_28 exp(-0.446 t^-0.6)
  /// These come to 1.028 f_28 and 0.9998 E_28 at 28 days; more than 1 is not counted on.
  chang_stille,
  /// Strengths of tests, between them straight over the logarithm of age; E(t) = E (f(t)/f_ck)^0.3
  /// as in EN 1992-1-1, 3.1.3(3).
  tested
};
[[nodiscard]] inline const char* to_string(AgeLaw law) {
  constexpr const char* words[] = {"EN 1992-1-1, 3.1.2", "Chang and Stille (1993)",
                                   "tested strengths"};
  return words[static_cast<std::size_t>(law)];
}

/// Strength at an age.
struct TestedStrength {
  double age = 0;       ///< [s], > 0
  double strength = 0;  ///< characteristic, cylinder [Pa], > 0
};

/// Of concrete that is loaded before it is 28 days old.
struct ConcreteAge {
  double when_loaded = 28 * one_day;  ///< in the stage that installs it [s], see `youngest`
  AgeLaw law = AgeLaw::chang_stille;
  /// s of EN 1992-1-1, 3.1.2(6) [-], 0.1 to 0.5: cement of class R 0.20, N 0.25, S 0.38.
  double cement = 0.2;
  std::vector<TestedStrength> tests = {};  ///< of `tested`, ages and strengths rising
  bool has_growing_modulus = true;         ///< false: E is what is given, at every age

  /// From which the law holds [s]. Chang and Stille: an hour, of which nothing is left.
  [[nodiscard]] double youngest() const {
    if (law == AgeLaw::en1992) return 3 * one_day;
    return law == AgeLaw::tested && !tests.empty() ? tests.front().age : one_day / 24;
  }

  /// Part of the mean strength of 28 days that is there [-], at most 1.
  /// @param strength  f_ck of 28 days [Pa]
  /// @throws InvalidInput  the age is below `youngest`, or nothing was tested
  [[nodiscard]] double maturity(double age, double strength) const {
    if (law == AgeLaw::tested && tests.empty())
      throw InvalidInput("tested strengths of concrete: there are none; must be one or more");
    if (!(age >= youngest()))
      throw InvalidInput(message({"age of concrete = ", age / one_day, " d: must be >= ",
                                  youngest() / one_day, " d by ", to_string(law)}));
    const double days = age / one_day;
    double part = 1;
    if (law == AgeLaw::en1992)
      part = std::exp(cement * (1 - std::sqrt(28 / days)));
    else if (law == AgeLaw::chang_stille)
      part = 1.105 * std::exp(-0.743 * std::pow(days, -0.7));
    else
      part = tested_strength(age, strength) / strength;
    return std::min(part, 1.0);
  }

  /// f_ck(t) [Pa]; of EN 1992-1-1 nothing is left where the mean comes to 8 MPa.
  [[nodiscard]] double strength_at(double age, double strength) const {
    const double part = maturity(age, strength);
    constexpr double scatter = 8e6;  // f_cm - f_ck
    if (law == AgeLaw::en1992 && part < 1)
      return std::max(0.0, part * (strength + scatter) - scatter);
    return part * strength;
  }

  /// E(t) / E [-], at most 1.
  [[nodiscard]] double modulus_part(double age, double strength) const {
    if (!has_growing_modulus) return 1;
    if (law == AgeLaw::chang_stille) {
      (void)maturity(age, strength);  // asks for the age
      return std::min(1.0, 1.062 * std::exp(-0.446 * std::pow(age / one_day, -0.6)));
    }
    return std::pow(maturity(age, strength), 0.3);
  }

  /// The section at an age: strength in compression by the law, in tension and of fibres by
  /// `maturity`. Bars are as they are: that young concrete bonds to them is not asked.
  [[nodiscard]] ConcreteSection aged(ConcreteSection section, double age) const {
    const double part = maturity(age, section.strength);
    if (part == 1) return section;
    section.tensile_strength = part * section.characteristic_tension();
    section.fibre_strength *= part;
    section.strength = strength_at(age, section.strength);
    return section;
  }

 private:
  [[nodiscard]] double tested_strength(double age, double strength) const {
    TestedStrength before = tests.front();
    for (const TestedStrength& test : tests) {
      if (age < test.age) return between(before, test, age);
      before = test;
    }
    const TestedStrength full{28 * one_day, strength};
    return before.age < full.age && age < full.age ? between(before, full, age) : strength;
  }
  [[nodiscard]] static double between(const TestedStrength& a, const TestedStrength& b,
                                      double age) {
    return a.strength + (b.strength - a.strength) * std::log(age / a.age) / std::log(b.age / a.age);
  }
};

}  // namespace voussoir::design
