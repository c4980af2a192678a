// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/tunnel/boundary_bias.hpp>

#include "input.hpp"
#include "models.hpp"

/// What the sides of the domain meet: as the file says, or chosen by what rollers would do.
namespace voussoir::program {

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

/// @param mass     not excavated; its moduli are measured where the file gives none
/// @param wants_bias  false: the bias of a boundary that the file has chosen is not asked for
/// @throws InvalidInput  elastic ground is asked for, and the moduli of the rock cannot be measured
[[nodiscard]] BoundedTunnel bounded_tunnel(const Input& input, const RockMass<Planar>& mass,
                                           const LawsBySet<AnyJoint>& laws,
                                           const TunnelOf& tunnel_of, bool wants_bias,
                                           const Progress& progress);

/// "elastic ground at sides and base, chosen because ..."
[[nodiscard]] std::string boundary_text(const ChosenBoundary& boundary);

}  // namespace voussoir::program
