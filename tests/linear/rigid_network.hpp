// SPDX-License-Identifier: MIT
#pragma once
// Rigid bodies on a grid, each joined to its neighbours by joints that resist opening, shear and
// rotation, as blocks of rock are: the matrices that the solvers are for, without any rock.
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/linear/block_matrix.hpp>
#include <voussoir/linear/rigid_aggregates.hpp>

namespace voussoir_test {

/// For tests in 2-D and 3-D.
template <int Dof>
using Dofs = std::integral_constant<int, Dof>;

template <int Dof>
struct RigidNetwork {
  static constexpr int dim = voussoir::dimension_of<Dof>;
  static constexpr int spins = Dof - dim;

  voussoir::BlockMatrix<Dof> matrix;
  voussoir::BodyCentres<Dof> centres;

  explicit RigidNetwork(int bodies) : matrix(bodies) {}

  /// A joint at a point between two bodies, with a stiffness along each axis and against rotation;
  /// b < 0: between a body and the ground.
  void join(int a, int b, const voussoir::Vec<dim>& point, const voussoir::Vec<dim>& stiffness,
            double rotational) {
    // Of the point along the axis, by the body's values.
    const auto shift = [&](int body, int axis) {
      voussoir::Fixed<Dof, 1> row = voussoir::zeros<voussoir::Fixed<Dof, 1>>();
      const voussoir::Vec<dim> unit = voussoir::axis_vector<dim>(axis);
      const voussoir::Vec<dim> arm = point - centres[static_cast<std::size_t>(body)];
      const voussoir::Spin<dim> moment = voussoir::moment_of(arm, unit);
      for (int d = 0; d < dim; ++d) row[d] = unit[d];
      for (int d = 0; d < spins; ++d) row[dim + d] = moment[d];
      return row;
    };
    for (int k = 0; k < Dof; ++k) {
      const double spring = k < dim ? stiffness[k] : rotational;
      const auto of = [&](int body) {
        return k < dim ? shift(body, k) : voussoir::axis_vector<Dof>(k);
      };
      const auto left = of(a);
      matrix.add(a, spring * voussoir::outer(left, left));
      if (b < 0) continue;
      const auto right = of(b);
      matrix.add(b, spring * voussoir::outer(right, right));
      matrix.add(a, b, -spring * voussoir::outer(left, right));
    }
  }
};

/// What a network is made of.
struct NetworkKind {
  int side = 8;           ///< bodies along each axis
  bool held = true;       ///< the bodies at the bottom on the ground
  double contrast = 1;    ///< of the stiffness of joints, the stiffest over the softest
  double disorder = 0.3;  ///< of the bodies about the grid [spacings]
};

template <int Dof>
[[nodiscard]] RigidNetwork<Dof> rigid_network(voussoir::Random& random, const NetworkKind& kind) {
  constexpr int dim = voussoir::dimension_of<Dof>;
  int count = 1;
  for (int d = 0; d < dim; ++d) count *= kind.side;
  RigidNetwork<Dof> network(count);
  for (int k = 0; k < count; ++k) {
    voussoir::Vec<dim> centre;
    for (int d = 0, rest = k; d < dim; ++d, rest /= kind.side) {
      const double shake = 2 * random.uniform() - 1;
      centre[d] = rest % kind.side + kind.disorder * shake;
    }
    network.centres.push_back(centre);
  }
  const auto joint = [&](int a, int b, const voussoir::Vec<dim>& point) {
    voussoir::Vec<dim> stiffness;
    const double size = 5e9 * std::pow(kind.contrast, -random.uniform());
    for (int d = 0; d < dim; ++d) stiffness[d] = size * (0.1 + random.uniform());
    network.join(a, b, point, stiffness, 0.05 * size);
  };
  for (int k = 0; k < count; ++k)
    for (int d = 0, step = 1; d < dim; ++d, step *= kind.side) {
      const auto& here = network.centres[static_cast<std::size_t>(k)];
      const int at = k / step % kind.side;
      if (at + 1 < kind.side) {
        const int next = k + step;
        joint(k, next, 0.5 * (here + network.centres[static_cast<std::size_t>(next)]));
      }
      if (kind.held && d == dim - 1 && at == 0)
        joint(k, -1, here - 0.5 * voussoir::axis_vector<dim>(d));
    }
  network.matrix.compress();
  return network;
}

/// Forces and moments between -1 and 1 MN.
[[nodiscard]] inline Eigen::VectorXd random_forces(voussoir::Random& random, Eigen::Index size) {
  Eigen::VectorXd f(size);
  for (Eigen::Index k = 0; k < size; ++k) f[k] = 1e6 * (2 * random.uniform() - 1);
  return f;
}

}  // namespace voussoir_test
