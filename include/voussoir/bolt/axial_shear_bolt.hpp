// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// Lorig's bolt: the axial spring and a second, elastic one across the bar (dowel action).
///
///   t = K_s * (jump across the bar),  lost together with the axial spring on rupture.
///
/// The dowel acts where the bar crosses the joint, on the motion of the two blocks there. Between
/// the anchors it would feel the rock turn as a whole: theta d of shear, 0.01 mm around a tunnel.
///
/// For a grouted bar K_s = E_b I beta^3 (two beams on an elastic foundation in series).
/// Source: Lorig (1985), A simple numerical representation of fully bonded passive rock
/// reinforcement for hard rocks, Comput. Geotech. 1(2), 79-97.
class AxialShearBolt {
 public:
  using role = roles::BoltLaw;
  static constexpr const char* name = "AxialShearBolt";

  struct Params {
    AxialBolt::Params axial;
    double shear_stiffness;  ///< K_s, across one joint [N/m], 0 or >= 1e3
  };
  using State = AxialBolt::State;

  /// @throws InvalidInput  a parameter is outside the range given in Params
  explicit AxialShearBolt(const Params& params)
      : AxialShearBolt(AxialBolt(params.axial), params.shear_stiffness) {
    if (shear_stiffness_ > 0)
      require_plausible(shear_stiffness_, "shear_stiffness", "N/m", 1e3, "MN/m", 1e6);
  }
  /// The same for values that are not in SI units.
  AxialShearBolt(const Params& params, AnyUnits)
      : AxialShearBolt(AxialBolt(params.axial, any_units), params.shear_stiffness) {}

  template <int Dim>
  [[nodiscard]] BoltForce<Dim> force(const BoltSpan<Dim>& span, const State& state) const {
    BoltForce<Dim> result = axial_.force(span, state);
    if (!state.ruptured) result.dowel = shear_stiffness_ * across(span);
    return result;
  }
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    const bool breaks = axial_.commit(span, state);
    if (breaks) state.lost += dowel_energy(span);
    return breaks;
  }
  template <int Dim>
  [[nodiscard]] BoltStiffness<Dim> stiffness(const BoltSpan<Dim>& span) const {
    BoltStiffness<Dim> bound = axial_.stiffness(span);
    bound.dowel = shear_stiffness_ * (diagonal_of<Dim>(1) - outer(span.axis, span.axis));
    return bound;
  }
  /// That of the axial spring and K_s t^2 / 2 of the dowel, lost with it.
  template <int Dim>
  [[nodiscard]] double energy(const BoltSpan<Dim>& span, const State& state) const {
    return axial_.energy(span, state) + (state.ruptured ? 0.0 : dowel_energy(span));
  }

  template <int Dim>
  [[nodiscard]] BoltReport describe(const BoltSpan<Dim>& span, const State& state) const {
    BoltReport report = axial_.describe(span, state);
    report.shear = force(span, state).dowel.norm();
    return report;
  }

 private:
  AxialShearBolt(const AxialBolt& axial, double shear_stiffness)
      : axial_(axial), shear_stiffness_(shear_stiffness) {
    require(shear_stiffness_ >= 0 && std::isfinite(shear_stiffness_), "shear_stiffness",
            shear_stiffness_, ">= 0 N/m");
  }

  template <int Dim>
  [[nodiscard]] static Vec<Dim> across(const BoltSpan<Dim>& span) {
    return span.jump - span.axis.dot(span.jump) * span.axis;
  }

  template <int Dim>
  [[nodiscard]] double dowel_energy(const BoltSpan<Dim>& span) const {
    return 0.5 * shear_stiffness_ * across(span).squaredNorm();
  }

  AxialBolt axial_;
  double shear_stiffness_;
};

static_assert(BoltLaw<AxialShearBolt, 2> && BoltLaw<AxialShearBolt, 3>);

}  // namespace voussoir
