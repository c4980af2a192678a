// SPDX-License-Identifier: MIT
#include "support/dense_algebra.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace voussoir_test {

namespace {

using LU = Eigen::FullPivLU<Eigen::MatrixXd>;

}  // namespace

Eigen::VectorXd solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) { return LU(a).solve(b); }

std::optional<Eigen::VectorXd> solve_if_regular(const Eigen::MatrixXd& a,
                                                const Eigen::VectorXd& b) {
  const LU lu(a);
  if (!lu.isInvertible()) return {};
  return lu.solve(b);
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& a) { return LU(a).inverse(); }

double determinant(const Eigen::MatrixXd& a) { return LU(a).determinant(); }

Eigen::MatrixXd inverse_of_lower_factor(const Eigen::MatrixXd& a) {
  return inverse(Eigen::LLT<Eigen::MatrixXd>(a).matrixL());
}

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& a) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace voussoir_test
