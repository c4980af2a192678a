// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/block_lu.hpp>
#include <voussoir/linear/incomplete_lu.hpp>
#include <voussoir/linear/tangent_matrix.hpp>

namespace voussoir {

/// Solves A x = b by generalised minimal residuals, preconditioned from the right by an incomplete
/// factor.
///
/// @param x  b; the answer
/// @return   whether the residual came down to `tolerance` of b within `most` steps
/// @throws Stopped
///
/// Source: Saad and Schultz (1986), GMRES, SIAM J. Sci. Stat. Comput. 7(3), 856-869.
template <int Dof>
[[nodiscard]] bool minimal_residuals(const TangentMatrix<Dof>& matrix, Eigen::VectorXd& x,
                                     double tolerance, int most, const Progress& progress = {}) {
  StopCheck stop(progress, 1);
  const IncompleteLU<Dof> factor(matrix);
  const auto multiply = [&matrix](const Eigen::VectorXd& u, Eigen::VectorXd& f) {
    for (std::size_t i = 0; i < matrix.diagonal.size(); ++i)
      set_part<Dof>(f, Dof * static_cast<Eigen::Index>(i),
                    matrix.diagonal[i] * part<Dof>(u, Dof * static_cast<Eigen::Index>(i)));
    for (std::size_t p = 0; p < matrix.pairs.size(); ++p) {
      const auto& [i, j] = matrix.pairs[p];
      add_at<Dof>(f.data() + Dof * i, matrix.forward[p] * part<Dof>(u, Dof * j));
      add_at<Dof>(f.data() + Dof * j, matrix.backward[p] * part<Dof>(u, Dof * i));
    }
  };
  VOUSSOIR_ASSERT(tolerance > 0 && tolerance < 1, "a residual is brought down");
  const double length = std::sqrt(dot_product(x, x));
  if (!(length > 0)) return length == 0;
  std::vector<Eigen::VectorXd> basis;
  std::vector<std::vector<double>> columns;  // of the Hessenberg matrix, turned upper triangular
  std::vector<double> cosines, sines, right{length};
  const Eigen::VectorXd none = zeros(x.size());
  basis.emplace_back();
  set_to_sum(basis.back(), none, 1 / length, x);
  Eigen::VectorXd next(x.size()), u;
  bool converged = false;
  while (!converged && static_cast<int>(columns.size()) < most) {
    stop();
    u = basis.back();
    factor.solve_in_place(u);
    multiply(u, next);
    std::vector<double> column;
    for (const Eigen::VectorXd& v : basis) {
      column.push_back(dot_product(v, next));
      set_to_sum(next, next, -column.back(), v);
    }
    double below = std::sqrt(dot_product(next, next));
    if (!std::isfinite(below)) return false;
    for (std::size_t k = 0; k < cosines.size(); ++k) {
      const double upper = column[k], lower = column[k + 1];
      column[k] = cosines[k] * upper + sines[k] * lower;
      column[k + 1] = cosines[k] * lower - sines[k] * upper;
    }
    const double diagonal = elementary::length(column.back(), below);
    if (!(diagonal > 0)) return false;
    cosines.push_back(column.back() / diagonal);
    sines.push_back(below / diagonal);
    column.back() = diagonal;
    columns.push_back(std::move(column));
    right.push_back(-sines.back() * right.back());
    right[right.size() - 2] *= cosines.back();
    converged = std::abs(right.back()) <= tolerance * length;
    if (below > 0) {
      basis.emplace_back();
      set_to_sum(basis.back(), none, 1 / below, next);
    } else {
      converged = true;
    }
  }
  if (!converged) return false;
  u = none;
  for (std::size_t k = columns.size(); k-- > 0;) {
    right[k] /= columns[k][k];
    for (std::size_t l = 0; l < k; ++l) right[l] -= columns[k][l] * right[k];
    set_to_sum(u, u, right[k], basis[k]);
  }
  factor.solve_in_place(u);
  x = u;
  return true;
}

/// Solves A x = b, in place: by a factor where that is cheap, else by minimal residuals to a
/// thousandth of b, and where these do not get there by a factor again, as long as it is one of
/// seconds.
///
/// A Newton step need not be exact; of 10 000 blocks in 3-D it takes 0.2 s instead of 3. Nor is it
/// needed: the search goes on without.
///
/// @param x  b, then the solution; not finite where A is singular or none was found
/// @throws Stopped
/// @cost  memory for up to 100 vectors: 2.4 kB a body in 2-D, 4.8 kB in 3-D
template <int Dof>
void solve_tangent(const TangentMatrix<Dof>& matrix, Eigen::VectorXd& x,
                   const Progress& progress = {}) {
  constexpr std::size_t cheap = Dof == 3 ? 3000 : 300, dear = Dof == 3 ? 200000 : 10000;  // bodies
  const std::size_t bodies = matrix.diagonal.size();
  VOUSSOIR_ASSERT(x.size() == Dof * static_cast<Eigen::Index>(bodies),
                  "a vector has the unknowns of the matrix");
  if (bodies > cheap && minimal_residuals(matrix, x, 1e-3, 100, progress)) return;
  if (bodies > dear) {
    x = Eigen::VectorXd::Constant(x.size(), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  BlockLU<Dof>(matrix, progress).solve_in_place(x);
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE void solve_tangent(const TangentMatrix<3>&, Eigen::VectorXd&,
                                            const Progress&);
VOUSSOIR_SPATIAL_TEMPLATE void solve_tangent(const TangentMatrix<6>&, Eigen::VectorXd&,
                                             const Progress&);
#endif

}  // namespace voussoir
