// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/vec.hpp>

namespace voussoir {

// Displacements and forces of bodies at rest are flat arrays: for every body its translation and
// its small rotation, or force and moment about its centre.

/// Small displacement of the point at `arm` from the centre of a body with these values [m].
template <int Dim>
[[nodiscard]] Vec<Dim> displacement_at(const double* body, const Vec<Dim>& arm) {
  return vector_at<Dim>(body) + turned(vector_at<spin_count<Dim>>(body + Dim), arm);
}

/// Adds a force that acts at `arm` from the centre to the force and moment of a body.
template <int Dim>
void add_force_at(double* body, const Vec<Dim>& arm, const Vec<Dim>& force) {
  add_at<Dim>(body, force);
  add_at<spin_count<Dim>>(body + Dim, moment_of(arm, force));
}

/// What unit forces along the axes at `arm` from the centre are to a body: force and moment.
template <int Dim>
[[nodiscard]] Fixed<Dim + spin_count<Dim>, Dim> lever_matrix(const Vec<Dim>& arm) {
  Fixed<Dim + spin_count<Dim>, Dim> lever;
  for (int k = 0; k < Dim; ++k) {
    const Vec<Dim> axis = axis_vector<Dim>(k);
    set_column(lever, k, stacked(axis, moment_of(arm, axis)));
  }
  return lever;
}

}  // namespace voussoir
