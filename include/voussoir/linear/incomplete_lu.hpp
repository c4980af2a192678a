// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/linear/small_inverse.hpp>
#include <voussoir/linear/tangent_matrix.hpp>

namespace voussoir {

/// Incomplete factor A = about L U by blocks, without any that A has not: a preconditioner.
///
/// Source: Saad (2003), Iterative Methods for Sparse Linear Systems, section 10.3.
template <int Dof>
class IncompleteLU {
 public:
  using Block = Fixed<Dof, Dof>;

  explicit IncompleteLU(const TangentMatrix<Dof>& matrix);

  /// x = about A^-1 x, in place; not finite where a pivot is singular.
  void solve_in_place(Eigen::VectorXd& x) const;

 private:
  struct Entry {
    int column;
    Block block;
  };
  [[nodiscard]] static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  std::vector<std::size_t> begin_, middle_;  ///< of rows; from `middle_` on right of the diagonal
  std::vector<Entry> entries_;               ///< row by row, columns growing
  std::vector<Block> inverse_;               ///< of the pivots
};

template <int Dof>
IncompleteLU<Dof>::IncompleteLU(const TangentMatrix<Dof>& matrix) {
  const std::size_t n = matrix.diagonal.size();
  VOUSSOIR_ASSERT(
      matrix.forward.size() == matrix.pairs.size() && matrix.backward.size() == matrix.pairs.size(),
      "a coupling has two blocks");
  begin_.assign(n + 1, 0);
  for (const auto& [i, j] : matrix.pairs) ++begin_[at(i) + 1], ++begin_[at(j) + 1];
  for (std::size_t i = 0; i < n; ++i) begin_[i + 1] += begin_[i];
  entries_.resize(begin_[n]);
  std::vector<std::size_t> end(begin_.begin(), begin_.end() - 1);
  for (std::size_t p = 0; p < matrix.pairs.size(); ++p) {
    const auto& [i, j] = matrix.pairs[p];
    entries_[end[at(i)]++] = {j, matrix.forward[p]};
    entries_[end[at(j)]++] = {i, matrix.backward[p]};
  }
  inverse_.resize(n);
  std::vector<std::ptrdiff_t> place(n, -1);  // of the present row's entries, by column
  for (std::size_t i = 0; i < n; ++i) {
    const auto first = entries_.begin() + static_cast<std::ptrdiff_t>(begin_[i]),
               last = entries_.begin() + static_cast<std::ptrdiff_t>(begin_[i + 1]);
    std::sort(first, last, [](const Entry& a, const Entry& b) { return a.column < b.column; });
    std::size_t middle = begin_[i];
    for (std::size_t p = begin_[i]; p < begin_[i + 1]; ++p) {
      place[at(entries_[p].column)] = static_cast<std::ptrdiff_t>(p);
      VOUSSOIR_ASSERT(entries_[p].column != static_cast<int>(i), "no body is coupled to itself");
      middle += entries_[p].column < static_cast<int>(i);
    }
    middle_.push_back(middle);
    Block pivot = matrix.diagonal[i];
    for (std::size_t p = begin_[i]; p < middle; ++p) {
      const std::size_t k = at(entries_[p].column);
      const Block lik = entries_[p].block * inverse_[k];
      entries_[p].block = lik;
      for (std::size_t q = middle_[k]; q < begin_[k + 1]; ++q) {
        const std::size_t j = at(entries_[q].column);
        if (j == i) {
          subtract_product(pivot, lik, entries_[q].block);
        } else if (place[j] >= 0) {
          subtract_product(entries_[static_cast<std::size_t>(place[j])].block, lik,
                           entries_[q].block);
        }
      }
    }
    for (std::size_t p = begin_[i]; p < begin_[i + 1]; ++p) place[at(entries_[p].column)] = -1;
    inverse_[i] = inverse_of<Dof>(pivot);
  }
}

template <int Dof>
void IncompleteLU<Dof>::solve_in_place(Eigen::VectorXd& x) const {
  const std::size_t n = inverse_.size();
  VOUSSOIR_ASSERT(x.size() == Dof * static_cast<Eigen::Index>(n),
                  "a vector has the unknowns of the factor");
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t p = begin_[i]; p < middle_[i]; ++p)
      add_at<Dof>(x.data() + Dof * i,
                  -(entries_[p].block * part<Dof>(x, Dof * entries_[p].column)));
  for (std::size_t i = n; i-- > 0;) {
    Fixed<Dof, 1> rest = part<Dof>(x, Dof * static_cast<Eigen::Index>(i));
    for (std::size_t p = middle_[i]; p < begin_[i + 1]; ++p)
      rest -= entries_[p].block * part<Dof>(x, Dof * entries_[p].column);
    set_part<Dof>(x, Dof * static_cast<Eigen::Index>(i), inverse_[i] * rest);
  }
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class IncompleteLU<3>;
VOUSSOIR_SPATIAL_TEMPLATE class IncompleteLU<6>;
#endif

}  // namespace voussoir
