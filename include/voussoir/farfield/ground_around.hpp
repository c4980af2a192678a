// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/farfield/detail/dense_elimination.hpp>
#include <voussoir/farfield/edge_mesh.hpp>
#include <voussoir/farfield/elastic_matrix.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/linear/small_inverse.hpp>
#include <voussoir/rockmass/domain.hpp>

namespace voussoir {

/// Stiffness of the elastic ground around a domain, as the nodes of its edge feel it.
///
/// Linear finite elements fill the ground beyond the elastic sides, in layers that grow with the
/// distance: a layer is the edge itself, moved away from a centre by a factor. The farthest layer,
/// `reach` times as far as the edge, is fixed; all layers but the edge are eliminated. Planes of
/// rollers and the ground surface go on into that ground.
///
/// What moves as a whole, as an opening does whose rock weighs no more, has no end in 2-D: its
/// displacement grows with the logarithm of the reach. Differences of displacements do not.
template <int Dim>
class GroundAround {
 public:
  /// Distance of the fixed end over that of the edge, from the centre: the stiffness against what
  /// decays with the distance is then that of unlimited ground within 1 / reach^2.
  static constexpr double reach = 20;

  /// @throws InvalidInput  see `FarField::check`
  /// @cost  10 ms in 2-D (48 nodes), 0.2 s where a side is eight times as long as the other; 2 s in
  ///        3-D (170 nodes)
  GroundAround(const Domain<Dim>& domain, const FarField<Dim>& field)
      : mesh_((field.check(), domain), field), field_(field) {
    for (int axis = 0; axis < Dim; ++axis) {
      const bool vertical = axis == Dim - 1;
      const bool low = field.at(axis, false) != Boundary::rollers;
      const bool high = vertical ? field.at(axis, true) == Boundary::elastic
                                 : field.at(axis, true) != Boundary::rollers;
      grows_[at(axis)] = low || high;
      centre_[axis] = low && high ? 0.5 * (domain.low[axis] + domain.high[axis])
                      : low       ? domain.high[axis]
                                  : domain.low[axis];
    }
    // About as long outwards as along the edge of a square.
    const double growth = 1 + 2.0 / EdgeMesh<Dim>::least_cells;
    const int layers =
        static_cast<int>(std::ceil(elementary::logarithm(reach) / elementary::logarithm(growth)));
    std::vector<double> scale;
    for (int k = 0; k <= layers; ++k)
      scale.push_back(elementary::power(reach, static_cast<double>(k) / layers));
    for (int k = layers; k > 0; --k) add_layer(scale[at(k - 1)], scale[at(k)], k == layers);
  }

  [[nodiscard]] const EdgeMesh<Dim>& mesh() const { return mesh_; }
  /// Force over displacement, Dim values a node: symmetric [N/m], in 2-D per metre of tunnel.
  /// Where a node is held (`EdgeMesh::is_held`) its row and column are zero.
  [[nodiscard]] const Eigen::MatrixXd& stiffness() const { return stiffness_; }

 private:
  static constexpr int element_nodes = 1 << Dim;

  template <class T>
  [[nodiscard]] static std::size_t at(T k) {
    return static_cast<std::size_t>(k);
  }
  [[nodiscard]] Vec<Dim> moved_out(int node, double scale) const {
    Vec<Dim> place = mesh_.nodes()[at(node)];
    for (int k = 0; k < Dim; ++k)
      if (grows_[at(k)]) place[k] = centre_[k] + scale * (place[k] - centre_[k]);
    return place;
  }

  /// Puts a layer inside what there is already, and eliminates what was its edge.
  void add_layer(double inner, double outer, bool is_last) {
    const Eigen::Index size = Dim * mesh_.node_count();
    Eigen::MatrixXd inside = Eigen::MatrixXd::Zero(size, size), across = inside,
                    outside = is_last ? inside : stiffness_;
    for (const auto& cell : mesh_.cells()) add_element(cell, inner, outer, inside, across, outside);
    for (int node = 0; node < mesh_.node_count(); ++node)
      for (int axis = 0; axis < Dim; ++axis)
        if (mesh_.is_held(node, axis)) {
          const Eigen::Index k = Dim * node + axis;
          for (Eigen::Index i = 0; i < size; ++i) {
            inside(i, k) = inside(k, i) = across(i, k) = across(k, i) = 0;
            outside(i, k) = outside(k, i) = 0;
          }
          outside(k, k) = 1;
        }
    if (!is_last) detail::eliminate(outside, across, inside);
    stiffness_ = std::move(inside);
  }

  /// Between a cell of the edge moved out by one factor and by another.
  /// @param across  rows: of the inner nodes, columns: of the outer ones
  void add_element(const typename EdgeMesh<Dim>::Cell& cell, double inner, double outer,
                   Eigen::MatrixXd& inside, Eigen::MatrixXd& across,
                   Eigen::MatrixXd& outside) const {
    // Bits of a node's number: those of the cell's corner, and whether it is an outer one.
    constexpr int outer_bit = Dim - 1;
    std::array<Vec<Dim>, element_nodes> places;
    std::array<Eigen::Index, element_nodes> first;
    for (int n = 0; n < element_nodes; ++n) {
      const int node = cell[at(n & (EdgeMesh<Dim>::corners - 1))];
      places[at(n)] = moved_out(node, (n >> outer_bit) != 0 ? outer : inner);
      first[at(n)] = Dim * node;
    }
    for (int point = 0; point < element_nodes; ++point) {
      std::array<Vec<Dim>, element_nodes> gradients;
      const double measure = gradients_at(point, places, gradients);
      for (int a = 0; a < element_nodes; ++a) {
        const auto stress = measure * (field_.moduli() * strain_of<Dim>(gradients[at(a)]));
        for (int b = 0; b < element_nodes; ++b) {
          const Fixed<Dim, Dim> k = transposed(strain_of<Dim>(gradients[at(b)])) * stress;
          const bool a_outside = (a >> outer_bit) != 0, b_outside = (b >> outer_bit) != 0;
          if (b_outside && !a_outside) continue;  // its transpose is taken
          Eigen::MatrixXd& target = b_outside ? outside : a_outside ? across : inside;
          for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j) target(first[at(b)] + i, first[at(a)] + j) += k(i, j);
        }
      }
    }
  }

  /// Gradients of the shape functions at a Gauss point [1/m].
  /// @return  the area or volume that belongs to the point [m^2], [m^3]
  static double gradients_at(int point, const std::array<Vec<Dim>, element_nodes>& places,
                             std::array<Vec<Dim>, element_nodes>& gradients) {
    const double gauss = 0.5 / std::sqrt(3.0);
    std::array<Vec<Dim>, element_nodes> by_local;
    Fixed<Dim, Dim> jacobian = zeros<Fixed<Dim, Dim>>();  // row: local axis
    for (int n = 0; n < element_nodes; ++n) {
      for (int k = 0; k < Dim; ++k) {
        double product = ((n >> k) & 1) != 0 ? 1 : -1;
        for (int other = 0; other < Dim; ++other) {
          if (other == k) continue;
          const double x = 0.5 + (((point >> other) & 1) != 0 ? gauss : -gauss);
          product *= ((n >> other) & 1) != 0 ? x : 1 - x;
        }
        by_local[at(n)][k] = product;
      }
      jacobian += outer<Dim, Dim>(by_local[at(n)], places[at(n)]);
    }
    const Fixed<Dim, Dim> inverse = inverse_of<Dim>(jacobian);
    for (int n = 0; n < element_nodes; ++n) gradients[at(n)] = inverse * by_local[at(n)];
    return std::abs(determinant_of(jacobian)) / element_nodes;
  }
  [[nodiscard]] static double determinant_of(const Fixed<Dim, Dim>& m) {
    if constexpr (Dim == 2)
      return m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
    else
      return dot_product(column(m, 0), cross(column(m, 1), column(m, 2)));
  }

  EdgeMesh<Dim> mesh_;
  FarField<Dim> field_;
  std::array<bool, Dim> grows_{};
  Vec<Dim> centre_ = zeros<Vec<Dim>>();
  Eigen::MatrixXd stiffness_;
};

/// The ground beyond a domain; null where the far field has none that is elastic.
template <int Dim>
[[nodiscard]] std::shared_ptr<const GroundAround<Dim>> ground_around(
    const Domain<Dim>& domain, const FarField<Dim>& far_field) {
  if (!far_field.has(Boundary::elastic)) return nullptr;
  return std::make_shared<const GroundAround<Dim>>(domain, far_field);
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class GroundAround<2>;
VOUSSOIR_PLANAR_TEMPLATE std::shared_ptr<const GroundAround<2>> ground_around(const Domain<2>&,
                                                                              const FarField<2>&);
VOUSSOIR_SPATIAL_TEMPLATE class GroundAround<3>;
VOUSSOIR_SPATIAL_TEMPLATE std::shared_ptr<const GroundAround<3>> ground_around(const Domain<3>&,
                                                                               const FarField<3>&);
#endif

}  // namespace voussoir
