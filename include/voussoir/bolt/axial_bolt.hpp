// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <voussoir/bolt/bar_stretch.hpp>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/invariants.hpp>

namespace voussoir {

/// Axial spring along the line between the anchors: elastic, yielding, breaking, pretensioned.
///
///   f = T0 + K_a (l - d_init - p),   l the present distance of the anchors,
///
/// up to the yield force; beyond it the plastic extension p grows and the force with a fraction of
/// the stiffness; at the rupture force the bolt is lost at this joint. Tension only unless asked.
///
/// Source: Boon, Houlsby & Utili (2015), eqs (1), (2); yield and rupture are ours.
class AxialBolt {
 public:
  using role = roles::BoltLaw;
  static constexpr const char* name = "AxialBolt";
  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  struct Params {
    double axial_stiffness;            ///< K_a, across one joint [N/m], >= 1e3
    double pretension = 0;             ///< T0 [N], 0 or >= 1e3
    double yield_force = unlimited;    ///< [N], > pretension and >= 1e3
    double rupture_force = unlimited;  ///< [N], as above; below the yield force: brittle
    double hardening_ratio = 0.02;     ///< stiffness after / before yield [-], 0 <= ratio < 1
    bool carries_compression = false;  ///< then without limit: it yields in tension only
  };
  struct State {
    double plastic_extension = 0;  ///< p [m]
    bool ruptured = false;
    double lost = 0;  ///< with the bolt when it broke [J]
  };

  /// @throws InvalidInput  a parameter is outside the range given in Params
  explicit AxialBolt(const Params& params) : AxialBolt(params, any_units) {
    require_plausible(params.axial_stiffness, "axial_stiffness", "N/m", 1e3, "MN/m", 1e6);
    if (params.pretension > 0)
      require_plausible(params.pretension, "pretension", "N", 1e3, "kN", 1e3);
    require_plausible(params.yield_force, "yield_force", "N", 1e3, "kN", 1e3);
    require_plausible(params.rupture_force, "rupture_force", "N", 1e3, "kN", 1e3);
  }
  /// The same for values that are not in SI units: > 0, pretension >= 0.
  AxialBolt(const Params& params, AnyUnits) : params_(params) {
    require(params.axial_stiffness > 0 && std::isfinite(params.axial_stiffness), "axial_stiffness",
            params.axial_stiffness, "> 0 N/m");
    require(params.pretension >= 0 && std::isfinite(params.pretension), "pretension",
            params.pretension, ">= 0 N");
    require(params.yield_force > params.pretension, "yield_force", params.yield_force,
            "> pretension");
    require(params.rupture_force > params.pretension, "rupture_force", params.rupture_force,
            "> pretension");
    require(params.hardening_ratio >= 0 && params.hardening_ratio < 1, "hardening_ratio",
            params.hardening_ratio, ">= 0 and < 1");
    require(params.hardening_ratio > 0 || params.rupture_force <= params.yield_force ||
                std::isinf(params.rupture_force),
            "hardening_ratio", params.hardening_ratio,
            "> 0, or the rupture force can never be reached beyond yield");
  }

  template <int Dim>
  [[nodiscard]] BoltForce<Dim> force(const BoltSpan<Dim>& span, const State& state) const {
    if (state.ruptured) return {};
    const BarStretch<Dim> now = stretch(span);
    const double axial = std::min(returned(now, state).force, params_.rupture_force);
    BoltForce<Dim> force{axial * now.direction, axial};
    if (now.closing < 0) {
      force.pull += params_.axial_stiffness * now.closing * span.axis;
      force.axial = -force.pull.norm();
    }
    return force;
  }

  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    if (state.ruptured) return false;
    const Return now = returned(stretch(span), state);
    VOUSSOIR_ASSERT(!(now.plastic_extension < state.plastic_extension),
                    "what has yielded is not taken back");
    if (now.force >= params_.rupture_force) {
      state.lost = energy(span, state);
      state.ruptured = true;
    }
    state.plastic_extension = now.plastic_extension;
    return state.ruptured;
  }

  template <int Dim>
  [[nodiscard]] BoltStiffness<Dim> stiffness(const BoltSpan<Dim>& span) const {
    // Anchors that coincide resist motion in every direction that stretches the bar.
    const double length = span.initial.norm();
    if (!(length > 0)) return {diagonal_of<Dim>(params_.axial_stiffness)};
    // A taut bar also resists being moved sideways, by T0 / d.
    const Stress<Dim> along = outer(span.axis, span.axis);
    return {params_.axial_stiffness * along +
            params_.pretension / length * (diagonal_of<Dim>(1) - along)};
  }

  ///   E = f^2 / 2 K_a + (f_y + H p / 2) p,   H p: by which the yield force has grown
  ///
  /// With what pretension holds at installation, T0^2 / 2 K_a, counted. A bolt that broke keeps
  /// what it had at the rupture force: all of that is lost.
  template <int Dim>
  [[nodiscard]] double energy(const BoltSpan<Dim>& span, const State& state) const {
    if (state.ruptured) return state.lost;
    const BarStretch<Dim> at = stretch(span);
    Return now = returned(at, state);
    // Of a step that passed the rupture force no more than the way to there.
    if (const double rupture = params_.rupture_force; now.force >= rupture)
      now = {rupture, rupture > params_.yield_force ? (rupture - params_.yield_force) / hardening()
                                                    : state.plastic_extension};
    const double growth = now.plastic_extension, pressed = params_.axial_stiffness * at.closing;
    const double yielded =
        growth > 0 ? (params_.yield_force + 0.5 * hardening() * growth) * growth : 0.0;
    return 0.5 * (now.force * now.force + pressed * pressed) / params_.axial_stiffness + yielded;
  }

  template <int Dim>
  [[nodiscard]] BoltReport describe(const BoltSpan<Dim>& span, const State& state) const {
    BoltReport report = report_from_force(*this, span, state);
    report.plastic_extension = state.plastic_extension;
    report.is_broken = state.ruptured;
    return report;
  }

 private:
  struct Return {
    double force, plastic_extension;
  };

  template <int Dim>
  [[nodiscard]] BarStretch<Dim> stretch(const BoltSpan<Dim>& span) const {
    return bar_stretch(span, params_.pretension / params_.axial_stiffness,
                       params_.carries_compression);
  }

  /// H: by which the yield force grows with the plastic extension [N/m].
  [[nodiscard]] double hardening() const {
    return params_.axial_stiffness * params_.hardening_ratio / (1 - params_.hardening_ratio);
  }
  template <int Dim>
  [[nodiscard]] Return returned(const BarStretch<Dim>& now, const State& state) const {
    const double stiffness = params_.axial_stiffness;
    const double trial = params_.pretension + stiffness * (now.extension - state.plastic_extension);
    if (trial < 0 && !now.may_press) return {0.0, state.plastic_extension};
    const double yield = params_.yield_force + hardening() * state.plastic_extension;
    if (trial <= yield) return {trial, state.plastic_extension};
    const double growth = (trial - yield) / (stiffness + hardening());
    // Not a number where a run is not stable; the run finds that out.
    VOUSSOIR_ASSERT(!(growth < 0), "yield makes a bolt longer");
    return {trial - stiffness * growth, state.plastic_extension + growth};
  }

  Params params_;
};

static_assert(BoltLaw<AxialBolt, 2> && BoltLaw<AxialBolt, 3>);

}  // namespace voussoir
