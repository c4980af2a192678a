// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <utility>
#include <voussoir/core/vec.hpp>
#include <voussoir/theory/elastic_ground.hpp>

namespace voussoir {

/// Components of a symmetric tensor: 3 in 2-D, 6 in 3-D.
template <int Dim>
inline constexpr int tensor_size = 3 * (Dim - 1);

/// Stress over strain of elastic ground, of any anisotropy: symmetric [Pa].
///
/// Components are in the order xx, yy, xy in 2-D (y upwards, plane strain) and xx, yy, zz, xy, yz,
/// xz in 3-D; shear strains are engineering ones, twice those of the tensor.
template <int Dim>
using ElasticMatrix = Fixed<tensor_size<Dim>, tensor_size<Dim>>;

/// The two axes of a component.
template <int Dim>
[[nodiscard]] constexpr std::pair<int, int> axes_of_component(int k) {
  if constexpr (Dim == 2) {
    constexpr std::array<std::pair<int, int>, 3> axes{{{0, 0}, {1, 1}, {0, 1}}};
    return axes[static_cast<std::size_t>(k)];
  } else {
    constexpr std::array<std::pair<int, int>, 6> axes{
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
    return axes[static_cast<std::size_t>(k)];
  }
}

/// That of isotropic ground: lambda on all pairs of normal components, 2 G more on the diagonal,
/// and G for shear.
/// @throws InvalidInput  a value out of range, or infinite
template <int Dim>
[[nodiscard]] ElasticMatrix<Dim> elastic_matrix(const ElasticGround& ground) {
  ground.check();
  require(std::isfinite(ground.shear_modulus), "shear modulus G", ground.shear_modulus,
          "finite [Pa]");
  ElasticMatrix<Dim> matrix = zeros<ElasticMatrix<Dim>>();
  for (int i = 0; i < tensor_size<Dim>; ++i) {
    if (i < Dim)
      for (int k = 0; k < Dim; ++k) matrix(i, k) = ground.lame_constant();
    matrix(i, i) += (i < Dim ? 2 : 1) * ground.shear_modulus;
  }
  return matrix;
}

/// Strain components of a displacement that grows by `gradient` in direction of one node's shape
/// function: column k is that of a displacement along axis k [1/m].
template <int Dim>
[[nodiscard]] Fixed<tensor_size<Dim>, Dim> strain_of(const Vec<Dim>& gradient) {
  Fixed<tensor_size<Dim>, Dim> strain = zeros<Fixed<tensor_size<Dim>, Dim>>();
  for (int k = 0; k < tensor_size<Dim>; ++k) {
    const auto [i, j] = axes_of_component<Dim>(k);
    strain(k, i) += gradient[j];
    if (i != j) strain(k, j) += gradient[i];
  }
  return strain;
}

}  // namespace voussoir
