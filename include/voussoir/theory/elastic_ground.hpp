// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// Linear elastic, isotropic ground: what the closed forms of this folder put in place of the
/// jointed rock.
struct ElasticGround {
  double shear_modulus;  ///< G [Pa], > 0; infinite: rigid
  double poisson_ratio;  ///< nu [-], > -1 and < 0.5 (at 0.5 the ground is incompressible)

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(shear_modulus > 0, "shear modulus G", shear_modulus, "> 0 Pa");
    require(poisson_ratio > -1 && poisson_ratio < 0.5, "Poisson's ratio nu", poisson_ratio,
            "> -1 and < 0.5");
  }

  /// E = 2 G (1 + nu) [Pa]
  [[nodiscard]] double youngs_modulus() const { return 2 * shear_modulus * (1 + poisson_ratio); }
  /// lambda = 2 G nu / (1 - 2 nu), Lame's first constant [Pa]
  [[nodiscard]] double lame_constant() const {
    return 2 * shear_modulus * poisson_ratio / (1 - 2 * poisson_ratio);
  }
  /// M = lambda + 2 G, stress over strain where no strain occurs sideways [Pa]
  [[nodiscard]] double constrained_modulus() const {
    return 2 * shear_modulus * (1 - poisson_ratio) / (1 - 2 * poisson_ratio);
  }
};

}  // namespace voussoir
