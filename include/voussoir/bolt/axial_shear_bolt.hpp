// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// Lorig's bolt: the axial spring and a second, elastic one across the bar (dowel action).
///
///   t = K_s * (motion across the bar),  lost together with the axial spring on rupture.
///
/// The motion is that of the anchors: turning the whole rock by a small angle theta counts as
/// theta d_init of it, which vanishes for anchors on the joint and is about 0.01 mm for the default
/// ones around a supported tunnel.
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
    double shear_stiffness;  ///< K_s, across one joint [N/m], >= 0
  };
  using State = AxialBolt::State;

  /// @throws InvalidInput  a parameter is outside the range given in Params
  explicit AxialShearBolt(const Params& params)
      : axial_(params.axial), shear_stiffness_(params.shear_stiffness) {
    require(shear_stiffness_ >= 0 && std::isfinite(shear_stiffness_), "shear_stiffness",
            shear_stiffness_, ">= 0 N/m");
  }

  template <int Dim>
  [[nodiscard]] BoltForce<Dim> force(const BoltSpan<Dim>& span, const State& state) const {
    BoltForce<Dim> result = axial_.force(span, state);
    if (!state.ruptured) result.pull += shear_stiffness_ * across(span);
    return result;
  }
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    return axial_.commit(span, state);
  }
  template <int Dim>
  [[nodiscard]] Stress<Dim> stiffness(const BoltSpan<Dim>& span) const {
    return axial_.stiffness(span) +
           shear_stiffness_ * (Stress<Dim>::Identity() - span.axis * span.axis.transpose());
  }

 private:
  template <int Dim>
  [[nodiscard]] static Vec<Dim> across(const BoltSpan<Dim>& span) {
    return span.motion - span.axis.dot(span.motion) * span.axis;
  }

  AxialBolt axial_;
  double shear_stiffness_;
};

static_assert(BoltLaw<AxialShearBolt, 2> && BoltLaw<AxialShearBolt, 3>);

}  // namespace voussoir
