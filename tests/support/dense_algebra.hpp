// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

/// Eigen's decompositions as a reference, compiled once for all tests: each of another fixed size
/// is seconds of compile time in the file that asks for it.
namespace voussoir_test {

/// x of A x = b, by complete pivoting.
[[nodiscard]] Eigen::VectorXd solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
/// The same, or nothing if A is singular.
[[nodiscard]] std::optional<Eigen::VectorXd> solve_if_regular(const Eigen::MatrixXd& a,
                                                              const Eigen::VectorXd& b);
[[nodiscard]] Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
[[nodiscard]] double determinant(const Eigen::MatrixXd& a);
/// L^-1 of A = L L^T.
[[nodiscard]] Eigen::MatrixXd inverse_of_lower_factor(const Eigen::MatrixXd& a);
/// Of a symmetric matrix, from the least to the largest.
[[nodiscard]] Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& a);

}  // namespace voussoir_test
