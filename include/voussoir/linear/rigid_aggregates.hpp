// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/linear/block_matrix.hpp>

namespace voussoir {

/// Space in which bodies with so many degrees of freedom move.
template <int Dof>
inline constexpr int dimension_of = Dof == 3 ? 2 : 3;

/// Where the bodies of a stiffness matrix are: what it takes to say how they move as one.
template <int Dof>
using BodyCentres = std::vector<Vec<dimension_of<Dof>>>;

namespace detail {

/// Which bodies move as one on the next coarser level, by how strongly they are coupled.
///
/// An aggregate grows from the first body that is in none yet: next comes the neighbour that is
/// coupled most strongly to all members together. What is left over in ones and twos joins the
/// aggregate to which it is coupled most. But no body joins others to which it is coupled by less
/// than a twentieth of its strongest coupling: an aggregate on both sides of a soft joint would
/// hold together what can move apart, and no coarser level would ever see that motion.
///
/// @param row_begin, column  couplings below the diagonal, by rows, as in `BlockMatrix`
/// @param strength           of every coupling, > 0
/// @param largest            members of an aggregate, but for those that join at the end
/// @param count              how many aggregates there are
/// @return  the aggregate of every body; -1 for a body coupled to none
/// @cost    O(bodies + couplings)
[[nodiscard]] VOUSSOIR_INLINE std::vector<int> aggregates_by_strength(
    const std::vector<int>& row_begin, const std::vector<int>& column,
    const std::vector<double>& strength, int largest, int& count);

}  // namespace detail

/// Bodies that move as one, and the stiffness of the aggregates: the next coarser level.
///
/// An aggregate has the degrees of freedom of a body, with its centre in the mean of its members';
/// a member moves with it as part of a rigid body. Rigid motion is therefore exact on every level,
/// and an aggregate's stiffness is that of the contacts on its outside.
template <int Dof>
struct RigidAggregates {
  static constexpr int dim = dimension_of<Dof>;
  using Block = Fixed<Dof, Dof>;
  using Values = Fixed<Dof, 1>;

  std::vector<int> of_body;       ///< -1: coupled to nothing, in none
  std::vector<Vec<dim>> arms;     ///< of bodies, from the centre of their aggregate
  std::vector<Vec<dim>> centres;  ///< of aggregates
  std::vector<int> first_body;    ///< of aggregates

  /// @param largest  bodies in an aggregate, see `aggregates_by_strength`
  RigidAggregates(const BlockMatrix<Dof>& matrix, const BodyCentres<Dof>& bodies, int largest) {
    const int n = matrix.size();
    std::vector<int> row_begin, column;
    std::vector<double> strength;
    row_begin.reserve(static_cast<std::size_t>(n) + 1);
    for (int i = 0; i <= n; ++i) row_begin.push_back(matrix.row_begin(i));
    const auto couplings = static_cast<std::size_t>(row_begin.back());
    column.reserve(couplings);
    strength.reserve(couplings);
    for (int k = 0; k < row_begin.back(); ++k) {
      // Of contacts and beams it is the sum of the stiffnesses along the axes.
      double trace = 0;
      for (int d = 0; d < dim; ++d) trace -= matrix.below(k)(d, d);
      column.push_back(matrix.column(k));
      strength.push_back(trace > 0 ? trace : 1e-300);
    }
    int count = 0;
    of_body = detail::aggregates_by_strength(row_begin, column, strength, largest, count);
    place(bodies, count);
  }

  [[nodiscard]] int count() const { return static_cast<int>(centres.size()); }

  /// How a body moves with its aggregate.
  [[nodiscard]] Values prolonged(std::size_t body, const Values& aggregate) const {
    Values values = aggregate;
    const Vec<dim> shift = turned(part<Dof - dim>(aggregate, dim), arms[body]);
    for (int d = 0; d < dim; ++d) values[d] += shift[d];
    return values;
  }
  /// Force and moment of a body on the centre of its aggregate.
  [[nodiscard]] Values restricted(std::size_t body, const Values& force) const {
    Values values = force;
    const Spin<dim> moment = moment_of(arms[body], part<dim>(force, 0));
    for (int d = 0; d < Dof - dim; ++d) values[dim + d] += moment[d];
    return values;
  }
  /// What couples body i to body j, as a coupling of their aggregates: P_i^T B P_j.
  [[nodiscard]] Block between_aggregates(int i, int j, const Block& block) const {
    Block right;
    for (int r = 0; r < Dof; ++r)  // (B P_j)^T = P_j^T B^T, column by column
      set_row(right, r, restricted(static_cast<std::size_t>(j), row(block, r)));
    Block both;
    for (int c = 0; c < Dof; ++c)
      set_column(both, c, restricted(static_cast<std::size_t>(i), column_of(right, c)));
    return both;
  }

  /// The stiffness of the aggregates: P^T A P.
  [[nodiscard]] BlockMatrix<Dof> stiffness(const BlockMatrix<Dof>& matrix) const {
    BlockMatrix<Dof> coarse(count());
    for (int i = 0; i < matrix.size(); ++i) {
      const int a = of_body[static_cast<std::size_t>(i)];
      if (a < 0) continue;
      coarse.add(a, between_aggregates(i, i, matrix.diagonal(i)));
      for (int k = matrix.row_begin(i); k < matrix.row_begin(i + 1); ++k) {
        const int j = matrix.column(k), b = of_body[static_cast<std::size_t>(j)];
        const Block block = between_aggregates(i, j, matrix.below(k));
        if (a != b)
          coarse.add(a, b, block);
        else
          coarse.add(a, block + transposed(block));
      }
    }
    coarse.compress();
    return coarse;
  }

 private:
  [[nodiscard]] static Values column_of(const Block& block, int c) {
    return voussoir::column(block, c);
  }

  void place(const BodyCentres<Dof>& bodies, int count) {
    VOUSSOIR_ASSERT(of_body.size() == bodies.size(), "every body has an aggregate or none");
    centres.assign(static_cast<std::size_t>(count), zeros<Vec<dim>>());
    first_body.assign(static_cast<std::size_t>(count), -1);
    std::vector<int> members(static_cast<std::size_t>(count), 0);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (of_body[b] < 0) continue;
      const auto a = static_cast<std::size_t>(of_body[b]);
      VOUSSOIR_ASSERT(a < members.size(), "an aggregate is one of those counted");
      if (members[a]++ == 0) first_body[a] = static_cast<int>(b);
      // Near the first member: site coordinates lose no digits.
      centres[a] += bodies[b] - bodies[static_cast<std::size_t>(first_body[a])];
    }
    VOUSSOIR_ASSERT(detail::is_positive(members), "no aggregate is empty");
    for (std::size_t a = 0; a < centres.size(); ++a)
      centres[a] = bodies[static_cast<std::size_t>(first_body[a])] +
                   centres[a] / static_cast<double>(members[a]);
    arms.assign(bodies.size(), zeros<Vec<dim>>());
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (of_body[b] >= 0) arms[b] = bodies[b] - centres[static_cast<std::size_t>(of_body[b])];
  }
};

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE std::vector<int> aggregates_by_strength(const std::vector<int>& row_begin,
                                                        const std::vector<int>& column,
                                                        const std::vector<double>& strength,
                                                        int largest, int& count) {
  const std::size_t n = row_begin.size() - 1;
  const auto each_coupling = [&](auto&& visit) {
    for (std::size_t i = 0; i < n; ++i)
      for (auto k = static_cast<std::size_t>(row_begin[i]);
           k < static_cast<std::size_t>(row_begin[i + 1]); ++k)
        visit(i, static_cast<std::size_t>(column[k]), strength[k]);
  };
  struct Neighbour {
    std::size_t body;
    double strength;
  };
  std::vector<std::size_t> begin(n + 1, 0);
  each_coupling([&](std::size_t i, std::size_t j, double) { ++begin[i + 1], ++begin[j + 1]; });
  for (std::size_t i = 0; i < n; ++i) begin[i + 1] += begin[i];
  std::vector<Neighbour> neighbours(begin[n]);
  std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
  each_coupling([&](std::size_t i, std::size_t j, double s) {
    neighbours[end[i]++] = {j, s};
    neighbours[end[j]++] = {i, s};
  });

  std::vector<int> of_body(n, -1);
  std::vector<double> to_members(n, 0.0);  // coupling of a candidate to all members together
  constexpr double weak = 0.05;
  std::vector<double> least(n, 0.0);  // coupling that is not weak, of every body
  each_coupling([&](std::size_t i, std::size_t j, double s) {
    least[i] = std::max(least[i], weak * s);
    least[j] = std::max(least[j], weak * s);
  });
  std::vector<std::size_t> members, candidates;
  count = 0;
  const auto take = [&](std::size_t body) {
    of_body[body] = count;
    members.push_back(body);
    for (std::size_t k = begin[body]; k < begin[body + 1]; ++k) {
      const Neighbour& near = neighbours[k];
      if (of_body[near.body] >= 0) continue;
      if (to_members[near.body] == 0) candidates.push_back(near.body);
      to_members[near.body] += near.strength;
    }
  };
  const auto join_others = [&](std::size_t body) {
    int into = -1;
    double most = least[body];
    for (std::size_t k = begin[body]; k < begin[body + 1]; ++k) {
      const int other = of_body[neighbours[k].body];
      if (other < 0 || other == count || !(neighbours[k].strength >= most)) continue;
      most = neighbours[k].strength;
      into = other;
    }
    if (into >= 0) of_body[body] = into;
    return into >= 0;
  };
  for (std::size_t seed = 0; seed < n; ++seed) {
    if (of_body[seed] >= 0 || begin[seed] == begin[seed + 1]) continue;
    members.clear();
    candidates.clear();
    take(seed);
    while (members.size() < static_cast<std::size_t>(largest)) {
      std::size_t best = n;
      for (const std::size_t c : candidates)
        if (of_body[c] < 0 && to_members[c] >= least[c] &&
            (best == n || to_members[c] > to_members[best]))
          best = c;
      if (best == n) break;
      take(best);
    }
    for (const std::size_t c : candidates) to_members[c] = 0;
    bool stays = members.size() > 2;
    if (!stays)
      for (const std::size_t m : members) stays = !join_others(m) || stays;
    count += stays;
  }
  return of_body;
}

}  // namespace detail

#endif

}  // namespace voussoir
