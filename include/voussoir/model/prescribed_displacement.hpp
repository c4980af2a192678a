// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/vec.hpp>

namespace voussoir {

/// How far a fixed block is moved: an abutment that yields, a base that settles or tilts.
template <int Dim>
struct PrescribedDisplacement {
  int block;
  Vec<Dim> by;                              ///< of its centroid [m]
  Spin<Dim> rotation = zeros<Spin<Dim>>();  ///< about its centroid [rad]
};

}  // namespace voussoir
