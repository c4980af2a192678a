// SPDX-License-Identifier: MIT
#include "boundary.hpp"

#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>
#include <voussoir/laboratory/elastic_moduli.hpp>

namespace voussoir::program {

namespace {

std::string percent(double part) {
  char text[32];
  std::snprintf(text, sizeof text, "%+.1f %%", 100 * part);
  return text;
}

std::string closure_text(const BoundaryBias& bias) {
  return percent(bias.upright) + " in height, " + percent(bias.across) + " in width";
}

FarField<2> on_all_sides(const ElasticMatrix<2>& moduli, const BoundaryInput& input) {
  FarField<2> field = FarField<2>::elastic(moduli);
  return input.ground_above ? field.with(Side::top, Boundary::elastic) : field;
}

FarField<2> as_asked(const std::optional<ElasticMatrix<2>>& moduli, const BoundaryInput& input) {
  FarField<2> field = moduli ? on_all_sides(*moduli, input) : FarField<2>();
  const Boundary sides = input.sides.value_or(Boundary::rollers);
  return field.with(Side::left, sides)
      .with(Side::right, sides)
      .with(Side::bottom, input.base.value_or(Boundary::rollers));
}

/// @param why  set where there are none
std::optional<ElasticMatrix<2>> moduli_of(const BoundaryInput& input, const RockMass<Planar>& mass,
                                          const LawsBySet<AnyJoint>& laws, std::string& why,
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

}  // namespace

BoundedTunnel bounded_tunnel(const Input& input, const RockMass<Planar>& mass,
                             const LawsBySet<AnyJoint>& laws, const TunnelOf& tunnel_of,
                             bool wants_bias, const Progress& progress) {
  const BoundaryInput& asked = input.boundary;
  const bool is_elastic =
      asked.sides == Boundary::elastic || asked.base == Boundary::elastic || asked.ground_above;
  ChosenBoundary chosen;
  chosen.is_automatic = !asked.sides;
  std::string why;
  if (is_elastic || chosen.is_automatic || wants_bias)
    chosen.moduli = moduli_of(asked, mass, laws, why, progress);
  if (is_elastic && !chosen.moduli)
    throw InvalidInput("boundary: the moduli of the rock cannot be measured: " + why +
                       "\n   = accepted: boundary.E and boundary.nu of the ground beyond, or "
                       "rollers at sides and base");
  chosen.field = as_asked(chosen.moduli, asked);
  Tunnel tunnel = tunnel_of(chosen.field);
  if (!chosen.moduli || !(chosen.is_automatic || wants_bias)) return {std::move(tunnel), chosen};
  const FarField<2> everywhere = on_all_sides(*chosen.moduli, asked);
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

std::string boundary_text(const ChosenBoundary& boundary) {
  const Boundary sides = boundary.field.at(Side::left), base = boundary.field.at(Side::bottom);
  const auto named = [](Boundary b) {
    return b == Boundary::rollers ? "rollers" : b == Boundary::stress ? "stress" : "elastic ground";
  };
  std::string text =
      sides == base ? std::string(named(sides)) + " at sides and base"
                    : std::string(named(sides)) + " at the sides, " + named(base) + " at the base";
  if (boundary.field.at(Side::top) == Boundary::elastic) text += ", ground above";
  if (boundary.bias && base == Boundary::elastic && sides == Boundary::elastic)
    text +=
        ", chosen: with rollers there the closure would be off by " + closure_text(*boundary.bias);
  else if (boundary.bias)
    text += ": against ground that goes on the closure is off by " + closure_text(*boundary.bias);
  else if (boundary.is_automatic)
    text +=
        ": what they do to the closure is not known, for the moduli of the rock cannot be "
        "measured";
  return text;
}

}  // namespace voussoir::program
