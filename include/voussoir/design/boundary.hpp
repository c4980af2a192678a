// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/models.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/laboratory/elastic_moduli.hpp>
#include <voussoir/tunnel/boundary_bias.hpp>

/// What the sides of the domain meet: as the input says, or chosen by what rollers would do.
namespace voussoir::design {

/// Of the larger closure: rollers that change it by more are not taken where the choice is free.
inline constexpr double tolerated_bias = 0.02;

struct ChosenBoundary {
  FarField<2> field;
  bool is_automatic = false;
  /// Of the ground beyond, given or measured on the rock [Pa]; none: they could not be measured, or
  /// nobody asked.
  std::optional<ElasticMatrix<2>> moduli;
  /// Of the boundary as it is, against elastic ground on all sides; where that was chosen, of the
  /// rollers that were not. None where nothing is known to compare with.
  std::optional<BoundaryBias> bias;
};

/// Makes the tunnel of a boundary, excavated but not moved.
using TunnelOf = std::function<Tunnel(const FarField<2>&)>;

struct BoundedTunnel {
  Tunnel tunnel;
  ChosenBoundary boundary;
};

/// @param mass     not excavated; its moduli are measured where the input gives none
/// @param wants_bias  false: the bias of a boundary that the input has chosen is not asked for
/// @throws InvalidInput  elastic ground is asked for, and the moduli of the rock cannot be measured
[[nodiscard]] VOUSSOIR_DESIGN_INLINE BoundedTunnel bounded_tunnel(
    const AnalysisInput& input, const RockMass<Planar>& mass, const LawsBySet<AnyJoint>& laws,
    const TunnelOf& tunnel_of, bool wants_bias, const Progress& progress);

/// "elastic ground at sides and base, chosen because ..."
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::string boundary_text(const ChosenBoundary& boundary);

/// Of every analysis in 3-D.
inline constexpr const char* spatial_boundary_text = "rollers at the four sides and the base";

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

VOUSSOIR_DESIGN_INLINE std::string percent(double part) {
  char text[32];
  std::snprintf(text, sizeof text, "%+.1f %%", 100 * part);
  return text;
}

VOUSSOIR_DESIGN_INLINE std::string closure_text(const BoundaryBias& bias) {
  return detail::percent(bias.upright) + " in height, " + detail::percent(bias.across) +
         " in width";
}

VOUSSOIR_DESIGN_INLINE FarField<2> on_all_sides(const ElasticMatrix<2>& moduli,
                                                const BoundaryInput& input) {
  FarField<2> field = FarField<2>::elastic(moduli);
  return input.ground_above ? field.with(Side::top, Boundary::elastic) : field;
}

VOUSSOIR_DESIGN_INLINE FarField<2> as_asked(const std::optional<ElasticMatrix<2>>& moduli,
                                            const BoundaryInput& input) {
  FarField<2> field = moduli ? detail::on_all_sides(*moduli, input) : FarField<2>();
  const Boundary sides = input.sides.value_or(Boundary::rollers);
  return field.with(Side::left, sides)
      .with(Side::right, sides)
      .with(Side::bottom, input.base.value_or(Boundary::rollers));
}

/// @param why  set where there are none
VOUSSOIR_DESIGN_INLINE std::optional<ElasticMatrix<2>> moduli_of(const BoundaryInput& input,
                                                                 const RockMass<Planar>& mass,
                                                                 const LawsBySet<AnyJoint>& laws,
                                                                 std::string& why,
                                                                 const Progress& progress) {
  if (input.young_modulus)
    return elastic_matrix<2>(
        {*input.young_modulus / (2 * (1 + input.poisson_ratio)), input.poisson_ratio});
  try {
    const ElasticMatrix<2> moduli = elastic_moduli(mass, laws, {}, progress);
    FarField<2>::elastic(moduli).check();
    return moduli;
  } catch (const InvalidInput&) {
    why = "its blocks are too few, or its joints of too few directions, to give way in all of them";
  } catch (const NumericalFault& fault) {
    why = fault.what();
  }
  return std::nullopt;
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE BoundedTunnel bounded_tunnel(const AnalysisInput& input,
                                                    const RockMass<Planar>& mass,
                                                    const LawsBySet<AnyJoint>& laws,
                                                    const TunnelOf& tunnel_of, bool wants_bias,
                                                    const Progress& progress) {
  const BoundaryInput& asked = input.boundary;
  const bool is_elastic =
      asked.sides == Boundary::elastic || asked.base == Boundary::elastic || asked.ground_above;
  ChosenBoundary chosen;
  chosen.is_automatic = !asked.sides;
  std::string why;
  if (is_elastic || chosen.is_automatic || wants_bias)
    chosen.moduli = detail::moduli_of(asked, mass, laws, why, progress);
  if (is_elastic && !chosen.moduli)
    throw InvalidInput("boundary: the moduli of the rock cannot be measured: " + why +
                       "\n   = accepted: E and nu of the ground beyond, or rollers at sides and "
                       "base");
  chosen.field = detail::as_asked(chosen.moduli, asked);
  Tunnel tunnel = tunnel_of(chosen.field);
  if (!chosen.moduli || !(chosen.is_automatic || wants_bias)) return {std::move(tunnel), chosen};
  const FarField<2> everywhere = detail::on_all_sides(*chosen.moduli, asked);
  const bool is_reference = asked.sides == Boundary::elastic && asked.base == Boundary::elastic;
  if (is_reference) return {std::move(tunnel), chosen};
  const auto found = elastic_wall_motion(tunnel, {}, progress);
  Tunnel reference = tunnel_of(everywhere);
  chosen.bias = boundary_bias(found, elastic_wall_motion(reference, {}, progress));
  if (!std::isfinite(chosen.bias->largest())) chosen.bias.reset();
  if (!chosen.is_automatic || !chosen.bias || chosen.bias->largest() <= tolerated_bias)
    return {std::move(tunnel), chosen};
  chosen.field = everywhere;
  return {std::move(reference), chosen};
}

VOUSSOIR_DESIGN_INLINE std::string boundary_text(const ChosenBoundary& boundary) {
  const Boundary sides = boundary.field.at(Side::left), base = boundary.field.at(Side::bottom);
  const auto named = [](Boundary b) {
    return b == Boundary::rollers ? "rollers" : b == Boundary::stress ? "stress" : "elastic ground";
  };
  std::string text =
      sides == base ? std::string(named(sides)) + " at sides and base"
                    : std::string(named(sides)) + " at the sides, " + named(base) + " at the base";
  if (boundary.field.at(Side::top) == Boundary::elastic) text += ", ground above";
  if (boundary.bias && base == Boundary::elastic && sides == Boundary::elastic)
    text += ", chosen: with rollers there the closure would be off by " +
            detail::closure_text(*boundary.bias);
  else if (boundary.bias)
    text += ": against ground that goes on the closure is off by " +
            detail::closure_text(*boundary.bias);
  else if (boundary.is_automatic)
    text +=
        ": what they do to the closure is not known, for the moduli of the rock cannot be "
        "measured";
  return text;
}

#endif

}  // namespace voussoir::design
