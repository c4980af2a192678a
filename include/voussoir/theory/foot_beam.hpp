// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// A beam along the tunnel between the feet of ribs and the rock: a wall plate, a footing beam. As
/// wide as the foot.
struct FootBeam {
  double depth;    ///< [m], > 0
  double modulus;  ///< E of the beam [Pa], > 0
  double spacing;  ///< of the ribs that stand on it [m], > 0
};

/// What a beam makes of feet that stand on it, in terms of those whose force is spread evenly along
/// the tunnel.
struct FeetOnBeam {
  double settlement;  ///< under a rib, over that of an even load; so is the bearing pressure [-]
  double moment;      ///< of the beam under a rib, over the rib's force times the spacing [-]
};

/// Equal forces at equal distances on an endless elastic beam on springs: x = spacing (3 k / (E
/// h^3))^(1/4), h the depth, k the bearing stiffness;
///
///   settlement = x/2 (sinh x + sin x) / (cosh x - cos x)       from 1 (stiff) to x/2 (single ribs)
///   moment = (sinh x - sin x) / (4 x (cosh x - cos x))         from 1/12 to 1 / (4 x)
///
/// @param bearing_stiffness  pressure over settlement of the rock under the beam [Pa/m], > 0
/// @throws InvalidInput  a value out of range
/// Source: Hetenyi (1946), Beams on elastic foundation; single forces added up along the beam.
[[nodiscard]] inline FeetOnBeam feet_on_beam(double bearing_stiffness, const FootBeam& beam) {
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  require(positive(bearing_stiffness), "bearing stiffness of a foot", bearing_stiffness,
          "> 0 Pa/m");
  require(positive(beam.depth), "depth of the beam under feet", beam.depth, "> 0 m");
  require(positive(beam.modulus), "modulus of the beam under feet", beam.modulus, "> 0 Pa");
  require(positive(beam.spacing), "spacing of the ribs on a beam", beam.spacing, "> 0 m");
  const double x = beam.spacing * std::sqrt(std::sqrt(3 * bearing_stiffness / beam.modulus) /
                                            (beam.depth * std::sqrt(beam.depth)));
  if (x < 0.05) {  // where the quotients lose their digits; the next terms are x^8 / 1e5
    const double fourth = x * x * x * x;
    return {1 + fourth / 180, (1 - fourth / 630) / 12};
  }
  const double e = std::exp(-x), below = 1 + e * e - 2 * e * std::cos(x);
  return {0.5 * x * (1 - e * e + 2 * e * std::sin(x)) / below,
          (1 - e * e - 2 * e * std::sin(x)) / (4 * x * below)};
}

}  // namespace voussoir
