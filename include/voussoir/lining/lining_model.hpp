// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// What a lining is made of where that is known at run time only, see `AnyLining`.
enum class LiningElement { euler_bernoulli, timoshenko, pinned, bonded_chain };

/// Section of a lining, per metre of tunnel in 2-D; of one member in 3-D.
struct LiningSection {
  double axial_stiffness;    ///< E A [N]
  double bending_stiffness;  ///< E I [N m^2]
  double shear_stiffness;    ///< kappa G A [N]
  double mass = 0;           ///< per length of lining [kg/m]; 0: weightless, as in the paper
  double lateral_bending_stiffness = 0;  ///< in 3-D: E I out of the plane of the section [N m^2]
  double torsional_stiffness = 0;        ///< in 3-D: G J [N m^2]
  /// Read by `AnyLining` alone: every other lining is of one kind of element.
  LiningElement element = LiningElement::euler_bernoulli;

  /// Of the rectangle with these stiffnesses: sqrt(12 I / A) [m].
  [[nodiscard]] double thickness() const {
    return std::sqrt(12 * bending_stiffness / axial_stiffness);
  }

  /// A rectangular section: shotcrete or concrete of thickness t, one metre wide, kappa = 5/6.
  /// @param thickness      [m], > 0 and <= 10
  /// @param young_modulus  E [Pa], >= 1e6;  @param poisson_ratio  -1 < nu < 0.5
  /// @throws InvalidInput  a value out of range
  [[nodiscard]] static LiningSection rectangular(double thickness, double young_modulus,
                                                 double poisson_ratio = 0.2) {
    require(thickness > 0 && std::isfinite(thickness), "lining thickness", thickness, "> 0 m");
    require(young_modulus > 0 && std::isfinite(young_modulus), "lining modulus", young_modulus,
            "> 0 Pa");
    // Values without units: give the members of the section themselves.
    if (thickness > 10)
      throw InvalidInput(
          message({"lining thickness = ", thickness, " m: must be <= 10 m; did you mean ",
                   thickness, " mm = ", 1e-3 * thickness, " m?"}));
    require_plausible(young_modulus, "lining modulus", "Pa", 1e6, "GPa", 1e9);
    require(poisson_ratio > -1 && poisson_ratio < 0.5, "lining Poisson ratio", poisson_ratio,
            "> -1 and < 0.5");
    return {young_modulus * thickness, young_modulus * thickness * thickness * thickness / 12,
            5.0 / 6.0 * young_modulus / (2 * (1 + poisson_ratio)) * thickness};
  }
  /// In 3-D: a strip of shotcrete of this thickness and width, or a rectangular rib.
  ///
  /// Torsion of a thin rectangle, width b >= thickness t: J = b t^3 (1/3 - 0.21 t/b (1 - t^4/(12
  /// b^4))). Source: Roark's formulas for stress and strain.
  /// @param width  along the tunnel [m], > 0; the rest as above
  [[nodiscard]] static LiningSection strip(double thickness, double width, double young_modulus,
                                           double poisson_ratio = 0.2) {
    require(width > 0 && std::isfinite(width), "width of a lining strip", width, "> 0 m");
    LiningSection s = rectangular(thickness, young_modulus, poisson_ratio);
    s.axial_stiffness *= width;
    s.bending_stiffness *= width;
    s.shear_stiffness *= width;
    s.lateral_bending_stiffness = young_modulus * thickness * width * width * width / 12;
    const double t = std::fmin(thickness, width), b = std::fmax(thickness, width), r = t / b;
    const double torsion = b * t * t * t * (1.0 / 3 - 0.21 * r * (1 - r * r * r * r / 12));
    s.torsional_stiffness = young_modulus / (2 * (1 + poisson_ratio)) * torsion;
    return s;
  }
};

/// Stiffness of one straight element in its own axes: first node, then second; translations, then
/// rotations; x along the element.
template <int Dof>
using ElementMatrix = Fixed<2 * Dof, 2 * Dof>;

template <class Lining, int Dof>
concept HasElementStiffness = requires(const LiningSection& section, double length) {
  { Lining::template stiffness<Dof>(section, length) } -> std::same_as<ElementMatrix<Dof>>;
};

/// Optional: `static constexpr bool is_pinned = true` for bars on pins, which the rock pushes in
/// the middle of the nodes, wherever on its stretch it touches, and which do not turn.
template <class Lining>
concept NamesPins = requires {
  Lining::is_pinned;
}
|| requires { &Lining::is_pinned; };
template <class Lining>
concept HasPins = requires {
  requires std::same_as<decltype(Lining::is_pinned), const bool>;
  typename std::bool_constant<Lining::is_pinned>;
};
/// The same for a lining whose section says it: `static bool is_pinned(const LiningSection&)`.
template <class Lining>
concept ChoosesPins = requires(const LiningSection& section) {
  { Lining::is_pinned(section) } -> std::same_as<bool>;
};
/// Of a kind of lining that is always one or the other.
template <class Lining>
requires(!ChoosesPins<Lining>) [[nodiscard]] constexpr bool is_pinned_lining() {
  if constexpr (HasPins<Lining>)
    return Lining::is_pinned;
  else
    return false;
}
/// Of a lining with this section.
template <class Lining>
[[nodiscard]] constexpr bool is_pinned_lining(const LiningSection& section) {
  if constexpr (ChoosesPins<Lining>)
    return Lining::is_pinned(section);
  else
    return is_pinned_lining<Lining>();
}
/// Of a lining whose members have these sections.
/// @throws InvalidInput  some are pinned and some are not; two linings of one model may differ
template <class Lining>
[[nodiscard]] bool is_pinned_lining(const std::vector<LiningSection>& sections) {
  if constexpr (ChoosesPins<Lining>) {
    const bool is_pinned = !sections.empty() && Lining::is_pinned(sections.front());
    for (std::size_t k = 1; k < sections.size(); ++k)
      if (Lining::is_pinned(sections[k]) != is_pinned)
        throw InvalidInput(message({"lining: section 0 is ", is_pinned ? "pinned" : "not pinned",
                                    " and section ", k, is_pinned ? " is not" : " is",
                                    "; accepted: sections of one lining that are all pinned, or "
                                    "none of them"}));
    return is_pinned;
  } else {
    return is_pinned_lining<Lining>();
  }
}

/// The straight elements that a lining is made of, between nodes that move and turn.
///
/// What the compiler cannot check: the matrix is symmetric and does not resist rigid motion.
///
/// Optional: `static constexpr bool is_pinned` (see `HasPins`), or a function of the section (see
/// `ChoosesPins`).
///
/// Models: EulerBernoulliBeam, TimoshenkoBeam, PinnedBar, BondedChain; AnyLining (one of them,
/// known at run time).
template <class Lining, int Dof>
concept LiningModel = Fills<Lining, roles::Lining> && HasName<Lining> &&
    HasElementStiffness<Lining, Dof> &&
    (HasPins<Lining> || ChoosesPins<Lining> || !NamesPins<Lining>);

template <class Lining, int Dof>
consteval bool explain_lining_model() {
  static_assert(Fills<Lining, roles::Lining>, "lining: add `using role = voussoir::roles::Lining`");
  static_assert(HasName<Lining>, "lining: add `static constexpr const char* name` for the log");
  static_assert(HasElementStiffness<Lining, Dof>,
                "lining: add `template <int Dof> static ElementMatrix<Dof> stiffness(const "
                "LiningSection&, double length)`");
  static_assert(HasPins<Lining> || ChoosesPins<Lining> || !NamesPins<Lining>,
                "lining: `is_pinned` must be `static constexpr bool is_pinned` or `static bool "
                "is_pinned(const LiningSection&)`, or be left out");
  return true;
}

}  // namespace voussoir
