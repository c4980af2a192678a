// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/linear/block_matrix.hpp>
#include <voussoir/linear/cholesky_pattern.hpp>
#include <voussoir/linear/detail/dense_front.hpp>
#include <voussoir/linear/detail/front_schedule.hpp>
#include <voussoir/linear/detail/front_solve.hpp>
#include <voussoir/linear/free_body.hpp>

namespace voussoir {

/// Sparse Cholesky factor A = L L^T by blocks of one body each, and solves with it.
///
/// Multifrontal: the columns of L are made in dense fronts (CholeskyPattern), which work on tiles
/// that stay in the registers. The bits are the same for any number of threads.
template <int Dof>
class BlockCholesky {
 public:
  using Block = Fixed<Dof, Dof>;

  /// @param progress  asked now and then whether to go on, by the thread that calls this
  /// @throws Stopped
  /// @throws FreeBody  not positive definite: some body can move without resistance
  /// @cost   about 0.01 s for 5 000 bodies in 2-D; grows as n^1.5
  explicit BlockCholesky(const BlockMatrix<Dof>& matrix, const Progress& progress = {},
                         unsigned threads = 1)
      : BlockCholesky(
            matrix,
            std::make_shared<const CholeskyPattern>(Dof, matrix.size(), matrix.pairs(), progress),
            progress, threads) {}

  /// With a pattern that was made for the same pairs: order and analysis are done once for all.
  /// @throws InvalidInput  the pairs are others
  BlockCholesky(const BlockMatrix<Dof>& matrix, std::shared_ptr<const CholeskyPattern> pattern,
                const Progress& progress = {}, unsigned threads = 1);

  /// Blocks that the factor keeps, with the zeros that it stores.
  [[nodiscard]] std::size_t block_count() const {
    return static_cast<std::size_t>(pattern_->stored_numbers()) / (Dof * Dof);
  }
  [[nodiscard]] const std::shared_ptr<const CholeskyPattern>& pattern() const { return pattern_; }

  /// Solves A x = b in place.
  void solve_in_place(Eigen::VectorXd& x) const;

 private:
  struct Work;
  void factor_front(std::size_t index, const BlockMatrix<Dof>& matrix, Work& work,
                    std::vector<double>& packed, const detail::FrontMember& member);
  void fill_panel(std::size_t index, const BlockMatrix<Dof>& matrix,
                  const detail::FrontMember& member);
  void add_updates(std::size_t index, const Work& work, bool to_panel,
                   const detail::FrontMember& member);

  void solve_forward(const CholeskyPattern::Front& front, const Eigen::VectorXd& x,
                     std::vector<double>& mine, std::vector<double>& left,
                     Eigen::VectorXd& y) const;
  void solve_backward(const CholeskyPattern::Front& front, std::vector<double>& mine,
                      Eigen::VectorXd& y) const;

  std::shared_ptr<const CholeskyPattern> pattern_;
  detail::FrontSchedule schedule_;
  unsigned threads_;
  std::shared_ptr<double[]> numbers_;  ///< the panels; shared by copies, for nobody changes them
};

/// What exists only while a factor is made.
template <int Dof>
struct BlockCholesky<Dof>::Work {
  detail::TileKernels kernels = detail::tile_kernels();
  std::vector<std::unique_ptr<double[]>> updates;
  std::vector<double> least;  ///< squared pivots, in the order of elimination
};

template <int Dof>
BlockCholesky<Dof>::BlockCholesky(const BlockMatrix<Dof>& matrix,
                                  std::shared_ptr<const CholeskyPattern> pattern,
                                  const Progress& progress, unsigned threads)
    : pattern_(std::move(pattern)), schedule_(*pattern_, threads), threads_(threads) {
  if (pattern_->dof() != Dof || !pattern_->is_for(matrix.size(), matrix.pairs()))
    throw InvalidInput("Cholesky factor: the pattern was made for other pairs of bodies");
  VOUSSOIR_ASSERT(threads >= 1, "somebody factors");
  const auto& fronts = pattern_->fronts();
  const std::size_t count = fronts.size();
  numbers_.reset(new double[static_cast<std::size_t>(pattern_->stored_numbers())]);
  Work work;
  work.updates.resize(count);
  work.least.resize(static_cast<std::size_t>(Dof) * static_cast<std::size_t>(matrix.size()));
  for (int k = 0; k < matrix.size(); ++k)
    for (int d = 0; d < Dof; ++d)
      work.least[static_cast<std::size_t>(Dof * k + d)] =
          1e-13 * matrix.diagonal(pattern_->original(k))(d, d);
  detail::FactorState state(progress);
  ThreadTeam team(threads);
  detail::SubtreeQueue queue(schedule_.subtrees().size());
  std::vector<double> shared;
  team.run([&](unsigned number) {
    std::vector<double> packed;
    const detail::FrontMember alone{state, nullptr, number};
    queue.work(
        team, number,
        [&](std::size_t k) {
          const int last = schedule_.subtrees()[k];
          for (int f = fronts[static_cast<std::size_t>(last)].youngest; f <= last; ++f) {
            alone.ask();
            if (!state.is_over(f))
              factor_front(static_cast<std::size_t>(f), matrix, work, packed, alone);
          }
        },
        [&] { alone.ask(); });
    for (const int f : schedule_.top())
      factor_front(static_cast<std::size_t>(f), matrix, work, shared, {state, &team, number});
  });
  state.rethrow();
  if (state.has_failed())
    throw FreeBody(pattern_->original(static_cast<int>(state.failed_column() / Dof)));
}

template <int Dof>
void BlockCholesky<Dof>::factor_front(std::size_t index, const BlockMatrix<Dof>& matrix, Work& work,
                                      std::vector<double>& packed,
                                      const detail::FrontMember& member) {
  const auto& front = pattern_->fronts()[index];
  const std::size_t height = Dof * static_cast<std::size_t>(front.rows()),
                    width = Dof * static_cast<std::size_t>(front.columns()), rest = height - width;
  if (member.leads()) try {
      work.updates[index].reset(new double[rest * rest]);
      const std::size_t size = detail::packed_size(height, width);
      if (packed.size() < size) packed.resize(size);
    } catch (...) {  // no memory: others must not wait for ever
      member.state.give_up();
    }
  fill_panel(index, matrix, member);
  add_updates(index, work, true, member);
  member.meet();
  detail::eliminate({static_cast<std::size_t>(Dof * front.first), static_cast<int>(index),
                     numbers_.get() + Dof * Dof * front.blocks, work.updates[index].get(), height,
                     width, work.least.data() + Dof * front.first},
                    packed.data(), work.kernels, member);
  add_updates(index, work, false, member);
  member.meet();
  if (member.leads())
    for (int c = front.child; c >= 0; c = pattern_->fronts()[static_cast<std::size_t>(c)].sibling)
      work.updates[static_cast<std::size_t>(c)].reset();
}

template <int Dof>
void BlockCholesky<Dof>::fill_panel(std::size_t index, const BlockMatrix<Dof>& matrix,
                                    const detail::FrontMember& member) {
  if (member.state.is_over(static_cast<int>(index))) return;
  const auto& front = pattern_->fronts()[index];
  const std::size_t height = Dof * static_cast<std::size_t>(front.rows());
  double* const panel = numbers_.get() + Dof * Dof * front.blocks;
  const auto add = [&](int row, int column, const Block& block) {
    double* const to = panel + static_cast<std::size_t>(Dof * column) * height +
                       static_cast<std::size_t>(Dof * row);
    for (int c = 0; c < Dof; ++c)
      for (int r = 0; r < Dof; ++r)
        to[static_cast<std::size_t>(c) * height + static_cast<std::size_t>(r)] =
            block.data()[Dof * c + r];
  };
  for (int j = 0; j < front.columns(); ++j) {
    if (!member.takes(static_cast<std::size_t>(j))) continue;
    double* const to = panel + static_cast<std::size_t>(Dof * j) * height;
    std::fill(to, to + Dof * height, 0.0);
    add(j, j, matrix.diagonal(pattern_->original(front.first + j)));
  }
  const auto& places = pattern_->places();
  for (std::size_t k = front.places; k < front.places_end; ++k) {
    const auto& place = places[k];
    if (!member.takes(static_cast<std::size_t>(place.column))) continue;
    if (place.pair >= 0) {
      add(place.row, place.column, matrix.below(place.pair));
    } else {
      add(place.row, place.column, transposed(matrix.below(~place.pair)));
    }
  }
}

template <int Dof>
void BlockCholesky<Dof>::add_updates(std::size_t index, const Work& work, bool to_panel,
                                     const detail::FrontMember& member) {
  const auto& front = pattern_->fronts()[index];
  const std::size_t columns = static_cast<std::size_t>(front.columns()),
                    height = Dof * static_cast<std::size_t>(front.rows()),
                    rest = height - Dof * columns;
  double* const panel = numbers_.get() + Dof * Dof * front.blocks;
  if (member.state.is_over(static_cast<int>(index))) return;
  for (int next = front.child; next >= 0;
       next = pattern_->fronts()[static_cast<std::size_t>(next)].sibling) {
    const auto child = static_cast<std::size_t>(next);
    const auto& from = pattern_->fronts()[child];
    const int* const place = pattern_->in_parent() + from.begin;
    const std::size_t rows = from.end - from.begin;
    VOUSSOIR_ASSERT(work.updates[child] != nullptr, "what a child leaves is there");
    for (std::size_t j = 0; j < rows; ++j) {
      const auto column = static_cast<std::size_t>(place[j]);
      if ((column < columns) != to_panel) {
        if (to_panel) break;
        continue;
      }
      if (!member.takes(column)) continue;
      const std::size_t above = to_panel ? 0 : columns, stride = to_panel ? height : rest;
      double* const base =
          (to_panel ? panel : work.updates[index].get()) + Dof * (column - above) * stride;
      const double* const block = work.updates[child].get() + Dof * j * Dof * rows;
      for (std::size_t c = 0; c < Dof; ++c) {
        double* const to = base + c * stride;
        const double* const values = block + c * Dof * rows;
        for (std::size_t i = j; i < rows; ++i)
          for (std::size_t r = 0; r < Dof; ++r)
            to[Dof * (static_cast<std::size_t>(place[i]) - above) + r] += values[Dof * i + r];
      }
    }
  }
}

template <int Dof>
void BlockCholesky<Dof>::solve_in_place(Eigen::VectorXd& x) const {
  // Each front has its unknowns and, for the rows below, the sums that it leaves to its parent.
  VOUSSOIR_ASSERT(x.size() == Dof * static_cast<Eigen::Index>(pattern_->size()),
                  "a vector has the unknowns of the factor");
  const auto& fronts = pattern_->fronts();
  std::vector<double> left(Dof * pattern_->row_count());
  Eigen::VectorXd y(x.size());
  ThreadTeam team(threads_);
  detail::SubtreeQueue forward(schedule_.subtrees().size()), backward(schedule_.subtrees().size());
  team.run([&](unsigned number) {
    std::vector<double> mine(Dof * pattern_->most_rows());
    forward.work(
        team, number,
        [&](std::size_t k) {
          const int last = schedule_.subtrees()[k];
          for (int f = fronts[static_cast<std::size_t>(last)].youngest; f <= last; ++f)
            solve_forward(fronts[static_cast<std::size_t>(f)], x, mine, left, y);
        },
        [] {});
    if (number == 0) {
      for (const int f : schedule_.top())
        solve_forward(fronts[static_cast<std::size_t>(f)], x, mine, left, y);
      for (std::size_t k = schedule_.top().size(); k-- > 0;)
        solve_backward(fronts[static_cast<std::size_t>(schedule_.top()[k])], mine, y);
    }
    team.meet();
    backward.work(
        team, number,
        [&](std::size_t k) {
          const int last = schedule_.subtrees()[schedule_.subtrees().size() - 1 - k];
          for (int f = last; f >= fronts[static_cast<std::size_t>(last)].youngest; --f)
            solve_backward(fronts[static_cast<std::size_t>(f)], mine, y);
        },
        [] {});
  });
  for (int k = 0; k < pattern_->size(); ++k)
    set_part<Dof>(x, Dof * pattern_->original(k), part<Dof>(y, Dof * k));
}

template <int Dof>
void BlockCholesky<Dof>::solve_forward(const CholeskyPattern::Front& front,
                                       const Eigen::VectorXd& x, std::vector<double>& mine,
                                       std::vector<double>& left, Eigen::VectorXd& y) const {
  const std::size_t height = Dof * static_cast<std::size_t>(front.rows()),
                    width = Dof * static_cast<std::size_t>(front.columns());
  for (int j = 0; j < front.columns(); ++j)
    write_at<Dof>(mine.data() + Dof * j, part<Dof>(x, Dof * pattern_->original(front.first + j)));
  std::fill(mine.data() + width, mine.data() + height, 0.0);
  for (int next = front.child; next >= 0;) {
    const auto& from = pattern_->fronts()[static_cast<std::size_t>(next)];
    for (std::size_t k = from.begin; k < from.end; ++k)
      add_at<Dof>(mine.data() + Dof * pattern_->in_parent()[k],
                  vector_at<Dof>(left.data() + Dof * k));
    next = from.sibling;
  }
  detail::solve_forward(numbers_.get() + Dof * Dof * front.blocks, height, width, mine.data());
  std::copy(mine.data(), mine.data() + width, y.data() + Dof * front.first);
  std::copy(mine.data() + width, mine.data() + height, left.data() + Dof * front.begin);
}

template <int Dof>
void BlockCholesky<Dof>::solve_backward(const CholeskyPattern::Front& front,
                                        std::vector<double>& mine, Eigen::VectorXd& y) const {
  const std::size_t height = Dof * static_cast<std::size_t>(front.rows()),
                    width = Dof * static_cast<std::size_t>(front.columns());
  for (std::size_t k = front.begin; k < front.end; ++k)
    write_at<Dof>(mine.data() + width + Dof * (k - front.begin),
                  vector_at<Dof>(y.data() + Dof * pattern_->row(k)));
  std::copy(y.data() + Dof * front.first, y.data() + Dof * front.last, mine.data());
  detail::solve_backward(numbers_.get() + Dof * Dof * front.blocks, height, width, mine.data());
  std::copy(mine.data(), mine.data() + width, y.data() + Dof * front.first);
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class BlockCholesky<3>;
VOUSSOIR_SPATIAL_TEMPLATE class BlockCholesky<6>;
#endif

}  // namespace voussoir
