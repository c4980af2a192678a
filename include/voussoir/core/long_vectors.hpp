// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <voussoir/core/errors.hpp>

/// What is done with vectors of all bodies' values, by plain loops: every expression of Eigen's is
/// a type of its own, and the compiler of whoever includes the headers pays for it.
namespace voussoir {

[[nodiscard]] inline Eigen::VectorXd constants(Eigen::Index size, double value) {
  Eigen::VectorXd vector(size);
  std::fill(vector.data(), vector.data() + size, value);
  return vector;
}
[[nodiscard]] inline Eigen::VectorXd zeros(Eigen::Index size) { return constants(size, 0); }

[[nodiscard]] inline Eigen::VectorXd opposite(const Eigen::VectorXd& a) {
  Eigen::VectorXd vector(a.size());
  for (Eigen::Index k = 0; k < a.size(); ++k) vector.data()[k] = -a.data()[k];
  return vector;
}
[[nodiscard]] inline double dot_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  VOUSSOIR_ASSERT(a.size() == b.size(), "a product is of vectors of one size");
  // Four sums side by side: one alone would wait for every addition.
  double sums[4] = {0, 0, 0, 0};
  Eigen::Index k = 0;
  for (; k + 4 <= a.size(); k += 4)
    for (int l = 0; l < 4; ++l) sums[l] += a.data()[k + l] * b.data()[k + l];
  for (; k < a.size(); ++k) sums[0] += a.data()[k] * b.data()[k];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}
/// factor / a, entry by entry.
[[nodiscard]] inline Eigen::VectorXd inverses(const Eigen::VectorXd& a, double factor = 1) {
  Eigen::VectorXd vector(a.size());
  for (Eigen::Index k = 0; k < a.size(); ++k) vector.data()[k] = factor / a.data()[k];
  return vector;
}
/// target = a + factor * b
inline void set_to_sum(Eigen::VectorXd& target, const Eigen::VectorXd& a, double factor,
                       const Eigen::VectorXd& b) {
  VOUSSOIR_ASSERT(a.size() == b.size(), "a sum is of vectors of one size");
  target.resize(a.size());
  for (Eigen::Index k = 0; k < a.size(); ++k) target.data()[k] = a.data()[k] + factor * b.data()[k];
}
/// target += a
inline void add_to(Eigen::VectorXd& target, const Eigen::VectorXd& a) {
  VOUSSOIR_ASSERT(target.size() == a.size(), "a sum is of vectors of one size");
  for (Eigen::Index k = 0; k < a.size(); ++k) target.data()[k] += a.data()[k];
}
/// The largest entry of a over that of b. @pre neither is empty, every entry of b > 0
[[nodiscard]] inline double largest_quotient(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  VOUSSOIR_ASSERT(a.size() == b.size() && a.size() > 0, "quotients are of vectors of one size");
  double largest = a.data()[0] / b.data()[0];
  for (Eigen::Index k = 1; k < a.size(); ++k)
    largest = std::max(largest, a.data()[k] / b.data()[k]);
  return largest;
}

}  // namespace voussoir
