// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/block_cholesky.hpp>
#include <voussoir/linear/block_matrix.hpp>
#include <voussoir/linear/free_body.hpp>
#include <voussoir/linear/rigid_aggregates.hpp>
#include <voussoir/linear/small_inverse.hpp>

namespace voussoir {

/// An approximate inverse of a stiffness matrix at a cost that grows with the number of bodies:
/// one cycle of multigrid whose coarser levels are aggregates that move as rigid bodies.
///
/// On every level: a forward Gauss-Seidel sweep by bodies, the correction from the next coarser
/// level, a backward sweep. Rigid aggregates are stiffer than the rock they stand for, so that a
/// correction taken once would fall short, more with every level; the coarser level is therefore
/// solved by up to two steps of conjugate gradients, preconditioned by its own cycle (K-cycle).
/// About eight bodies move as one, so the levels together cost some 1.4 times the finest. The
/// coarsest is factored.
///
/// Because of those inner steps the cycle is not quite linear: use it with `conjugate_gradients`,
/// which allows for that.
///
/// Source: Notay (2010), An aggregation-based algebraic multigrid method, Electron. Trans. Numer.
/// Anal. 37, 123-146. Rigid aggregates instead of constants are ours.
template <int Dof>
class Multigrid {
 public:
  using Matrix = BlockMatrix<Dof>;
  using Block = Fixed<Dof, Dof>;
  using Values = Fixed<Dof, 1>;

  struct Params {
    int largest_aggregate = 8;  ///< bodies that move as one on the next level
    int direct_below = 300;     ///< bodies: a level with fewer is factored
  };

  /// @param matrix   the finest level; must outlive this
  /// @param centres  of its bodies, one each
  /// @param progress  asked now and then whether to go on
  /// @throws FreeBody  a body, or bodies that hold nothing but each other
  /// @throws Stopped
  /// @cost   as much as some ten products with the matrix; memory for the coarser levels, a third
  ///         of the matrix
  Multigrid(const Matrix& matrix, const BodyCentres<Dof>& centres, const Params& params = {},
            const Progress& progress = {});

  /// x = about K^-1 b
  void apply(const Eigen::VectorXd& b, Eigen::VectorXd& x) { cycle(0, b, x); }

  /// Levels, the finest included.
  [[nodiscard]] int level_count() const { return static_cast<int>(levels_.size()); }
  /// Blocks on all levels together over those of the finest [-].
  [[nodiscard]] double complexity() const;

 private:
  struct Level {
    std::optional<Matrix> own;   ///< of all levels but the finest
    std::vector<Block> inverse;  ///< of the blocks on the diagonal
    std::vector<Values> scale;   ///< what the diagonal was before rigid motion had been taken out
    std::vector<int> body;       ///< of the finest level, one that moves with this one
    std::optional<RigidAggregates<Dof>> coarser;
    // Of one application.
    Eigen::VectorXd residual, prolonged;  ///< in its own sweeps
    Eigen::VectorXd load, correction;     ///< from and for the finer level
    Eigen::VectorXd first_step, first_force, second_step, second_force;
  };

  [[nodiscard]] const Matrix& matrix(std::size_t level) const {
    return level == 0 ? *finest_ : *levels_[level].own;
  }
  void invert_diagonal(std::size_t level, StopCheck& stop);
  void coarsen(const BodyCentres<Dof>& centres, int largest, StopCheck& stop);
  void factor_coarsest(const Progress& progress);

  void cycle(std::size_t level, const Eigen::VectorXd& b, Eigen::VectorXd& x);
  void solve_coarser(std::size_t level);
  void forward_sweep(std::size_t level, const Eigen::VectorXd& b, Eigen::VectorXd& x);
  void backward_sweep(std::size_t level, Eigen::VectorXd& x);

  const Matrix* finest_;
  std::vector<Level> levels_;
  std::optional<BlockCholesky<Dof>> coarsest_;
};

template <int Dof>
Multigrid<Dof>::Multigrid(const Matrix& matrix, const BodyCentres<Dof>& centres,
                          const Params& params, const Progress& progress)
    : finest_(&matrix) {
  VOUSSOIR_ASSERT(centres.size() == static_cast<std::size_t>(matrix.size()),
                  "every body has a centre");
  VOUSSOIR_ASSERT(params.largest_aggregate >= 2, "aggregates make a level smaller");
  StopCheck stop(progress, 1);
  Level finest;
  for (int i = 0; i < matrix.size(); ++i) {
    Values scale;
    for (int d = 0; d < Dof; ++d) scale[d] = matrix.diagonal(i)(d, d);
    finest.scale.push_back(scale);
    finest.body.push_back(i);
  }
  levels_.push_back(std::move(finest));
  invert_diagonal(0, stop);
  BodyCentres<Dof> now = centres;
  for (int before = 2 * matrix.size(), size = matrix.size();
       size >= params.direct_below && size < 0.8 * before;) {
    coarsen(now, params.largest_aggregate, stop);
    now = levels_[levels_.size() - 2].coarser->centres;
    before = size;
    size = this->matrix(levels_.size() - 1).size();
  }
  factor_coarsest(progress);
}

template <int Dof>
double Multigrid<Dof>::complexity() const {
  double all = 0, first = 0;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const double blocks =
        static_cast<double>(matrix(l).row_begin(matrix(l).size())) + matrix(l).size();
    if (l == 0) first = blocks;
    all += blocks;
  }
  return all / first;
}

template <int Dof>
void Multigrid<Dof>::invert_diagonal(std::size_t level, StopCheck& stop) {
  Level& l = levels_[level];
  l.inverse.reserve(l.scale.size());
  for (int i = 0; i < matrix(level).size(); ++i) {
    if (i % 1024 == 0) stop();
    const auto at = static_cast<std::size_t>(i);
    const auto root = inverse_cholesky_factor<Dof>(matrix(level).diagonal(i), 1e-13 * l.scale[at]);
    if (!root) throw FreeBody(l.body[at]);
    l.inverse.push_back(transposed_product(*root, *root));
  }
}

template <int Dof>
void Multigrid<Dof>::coarsen(const BodyCentres<Dof>& centres, int largest, StopCheck& stop) {
  constexpr int dim = dimension_of<Dof>;
  stop();
  const std::size_t fine = levels_.size() - 1;
  Level next;
  {
    Level& l = levels_[fine];
    l.coarser.emplace(matrix(fine), centres, largest);
    stop();
    const RigidAggregates<Dof>& aggregates = *l.coarser;
    next.own.emplace(aggregates.stiffness(matrix(fine)));
    stop();
    next.scale.assign(static_cast<std::size_t>(aggregates.count()), zeros<Values>());
    for (std::size_t b = 0; b < l.scale.size(); ++b) {
      if (aggregates.of_body[b] < 0) continue;
      Values& sum = next.scale[static_cast<std::size_t>(aggregates.of_body[b])];
      sum += l.scale[b];
      const double turning = aggregates.arms[b].squaredNorm() * largest_entry(l.scale[b]);
      for (int d = dim; d < Dof; ++d) sum[d] += turning;
    }
    for (const int member : aggregates.first_body)
      next.body.push_back(l.body[static_cast<std::size_t>(member)]);
  }
  VOUSSOIR_ASSERT(next.own->size() <= matrix(fine).size(), "a coarser level is no larger");
  VOUSSOIR_ASSERT(next.body.size() == static_cast<std::size_t>(next.own->size()),
                  "an aggregate has a first member");
  levels_.push_back(std::move(next));
  invert_diagonal(fine + 1, stop);
}

template <int Dof>
void Multigrid<Dof>::factor_coarsest(const Progress& progress) {
  const Level& last = levels_.back();
  try {
    coarsest_.emplace(matrix(levels_.size() - 1), progress);
  } catch (const FreeBody& free) {
    throw FreeBody(last.body[static_cast<std::size_t>(free.body())]);
  }
}

template <int Dof>
void Multigrid<Dof>::cycle(std::size_t level, const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  VOUSSOIR_ASSERT(b.size() == Dof * static_cast<Eigen::Index>(matrix(level).size()),
                  "a vector has the unknowns of its level");
  if (level + 1 == levels_.size()) {
    x = b;
    coarsest_->solve_in_place(x);
    return;
  }
  forward_sweep(level, b, x);
  solve_coarser(level);
  backward_sweep(level, x);
}

/// x = (D + L)^-1 b; the residual b - K x, which is -L^T x, in the same pass.
template <int Dof>
void Multigrid<Dof>::forward_sweep(std::size_t level, const Eigen::VectorXd& b,
                                   Eigen::VectorXd& x) {
  const Matrix& k = matrix(level);
  Level& l = levels_[level];
  x.resize(b.size());
  l.residual.resize(b.size());
  double* const r = l.residual.data();
  for (int i = 0; i < k.size(); ++i) {
    const int begin = k.row_begin(i), end = k.row_begin(i + 1);
    double rest[Dof], own[Dof];
    for (int d = 0; d < Dof; ++d) {
      rest[d] = b.data()[Dof * i + d];
      own[d] = r[Dof * i + d] = 0;
    }
    for (int at = begin; at < end; ++at)
      detail::subtract_block<Dof>(k.below(at), x.data() + Dof * k.column(at), rest);
    detail::subtract_block<Dof>(l.inverse[static_cast<std::size_t>(i)], rest, own);
    for (int d = 0; d < Dof; ++d) x.data()[Dof * i + d] = own[d] = -own[d];
    for (int at = begin; at < end; ++at)
      detail::subtract_block_transposed<Dof>(k.below(at), own, r + Dof * k.column(at));
  }
}

/// With e, the coarser correction on this level: x += e + (D + L^T)^-1 (residual - K e), which is
/// x += (D + L^T)^-1 (residual - L e); in one pass from the last body to the first.
template <int Dof>
void Multigrid<Dof>::backward_sweep(std::size_t level, Eigen::VectorXd& x) {
  const Matrix& k = matrix(level);
  Level& l = levels_[level];
  const RigidAggregates<Dof>& aggregates = *l.coarser;
  const Eigen::VectorXd& coarse = levels_[level + 1].correction;
  Eigen::VectorXd& e = l.prolonged;
  e.resize(x.size());
  for (int i = 0; i < k.size(); ++i) {
    const auto body = static_cast<std::size_t>(i);
    const int a = aggregates.of_body[body];
    set_part<Dof>(e, Dof * i,
                  a < 0 ? zeros<Values>() : aggregates.prolonged(body, part<Dof>(coarse, Dof * a)));
  }
  double* const r = l.residual.data();
  for (int i = k.size(); i-- > 0;) {
    const int begin = k.row_begin(i), end = k.row_begin(i + 1);
    double rest[Dof], step[Dof] = {};
    for (int d = 0; d < Dof; ++d) rest[d] = r[Dof * i + d];
    for (int at = end; at-- > begin;)
      detail::subtract_block<Dof>(k.below(at), e.data() + Dof * k.column(at), rest);
    detail::subtract_block<Dof>(l.inverse[static_cast<std::size_t>(i)], rest, step);
    for (int d = 0; d < Dof; ++d) x.data()[Dof * i + d] += step[d] = -step[d];
    for (int at = end; at-- > begin;)
      detail::subtract_block_transposed<Dof>(k.below(at), step, r + Dof * k.column(at));
  }
}

/// The correction of the next coarser level for the residual of this one: up to two steps of
/// conjugate gradients, the second only where the first has left more than a quarter.
template <int Dof>
void Multigrid<Dof>::solve_coarser(std::size_t level) {
  const RigidAggregates<Dof>& aggregates = *levels_[level].coarser;
  const Eigen::VectorXd& residual = levels_[level].residual;
  Level& c = levels_[level + 1];
  c.load = zeros(Dof * static_cast<Eigen::Index>(aggregates.count()));
  for (std::size_t b = 0; b < aggregates.of_body.size(); ++b)
    if (aggregates.of_body[b] >= 0)
      add_at<Dof>(
          c.load.data() + Dof * aggregates.of_body[b],
          aggregates.restricted(b, part<Dof>(residual, Dof * static_cast<Eigen::Index>(b))));
  if (level + 2 == levels_.size()) {
    cycle(level + 1, c.load, c.correction);
    return;
  }
  // Every step as long as makes the error smallest in energy; the second conjugate to the first.
  const auto shorten = [&](const Eigen::VectorXd& step, const Eigen::VectorXd& force) {
    const double work = dot_product(step, force);
    const double length = work > 0 ? dot_product(step, c.load) / work : 0;
    set_to_sum(c.correction, c.correction, length, step);
    set_to_sum(c.load, c.load, -length, force);
    return work;
  };
  const double before = dot_product(c.load, c.load);
  c.correction = zeros(c.load.size());
  cycle(level + 1, c.load, c.first_step);
  matrix(level + 1).multiply(c.first_step, c.first_force);
  const double work = shorten(c.first_step, c.first_force);
  if (!(work > 0) || dot_product(c.load, c.load) <= 0.0625 * before) return;
  cycle(level + 1, c.load, c.second_step);
  set_to_sum(c.second_step, c.second_step, -dot_product(c.second_step, c.first_force) / work,
             c.first_step);
  matrix(level + 1).multiply(c.second_step, c.second_force);
  (void)shorten(c.second_step, c.second_force);
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class Multigrid<3>;
VOUSSOIR_SPATIAL_TEMPLATE class Multigrid<6>;
#endif

}  // namespace voussoir
