// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/linear/interior_point.hpp>
#include <voussoir/linear/linear_programme.hpp>
#include <voussoir/model/support.hpp>

/// A bound on the factor of safety by limit analysis: rigid blocks in 2-D whose joints dilate by
/// their friction.
///
/// Whatever stands with the strength of its joints over F is held by forces that balance every
/// block and that no joint refuses. The largest factor for which there are such forces therefore
/// bounds from above every factor that stands, whether slip dilates or not, by whatever path it was
/// come to. It is the limit load itself where dilation is the friction (the static theorem), and no
/// safe value elsewhere.
///
/// Forces act at both ends of every contact: N >= -sigma_t l / 2, |T| <= c l / 2 + N tan(phi), all
/// strengths over F. Every distribution of stress over the contact, concentrated or not, has its
/// force and moment in such two forces, by its shares at the ends: nothing that the model can do is
/// left out.
///
/// Source: Livesley (1978), Limit analysis of structures formed from rigid blocks, Int. J. Num.
/// Meth. Eng. 12; why it bounds joints without dilation: Radenkovic (1961), Theoremes limites pour
/// un materiau de Coulomb a dilatation non standardisee.
namespace voussoir::design {

/// What a joint bears, before it is divided.
struct JointStrength {
  double friction_coefficient = 0;  ///< tan(phi) [-], >= 0
  double cohesion = 0;              ///< [Pa], >= 0
  double tensile_strength = 0;      ///< [Pa], >= 0, <= c / tan(phi)
};

/// Rigid blocks and where they touch. Per metre of tunnel.
struct LimitProblem {
  struct Block {
    Vec2 centre;
    double weight, gyration;  ///< [N], [m], > 0: what is missing of a balance is measured by them
    Load<2> load;             ///< all that acts on it but contacts: weight, surcharge, loads
    bool is_free = true;      ///< false: it bears any force
  };
  /// Of two blocks.
  struct Contact {
    int a, b;
    Vec2 start, end;
    Vec2 normal;  ///< from a to b, a unit vector
    JointStrength strength;
  };
  /// Of a block and a smooth side of the model, which pushes as hard as it must.
  struct Edge {
    int block;
    Vec2 start, end;
    Vec2 outward;  ///< a unit vector
  };
  std::vector<Block> blocks;
  std::vector<Contact> contacts;
  std::vector<Edge> edges;
};

/// How much is missing until all blocks are in balance: the least sum of the forces and moments
/// that would have to be added, each over the weight of its block and in moments its radius of
/// gyration. Unknowns are forces over the mean weight of the free blocks. Neither their number nor
/// the pattern depends on the strength.
/// @param strength_left  1 / F, >= 0
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LinearProgramme balance_programme(const LimitProblem& problem,
                                                                       double strength_left);

/// How the bound is sought.
struct LimitSearch {
  double width = 5e-3;  ///< between the two factors in the end, relative [-], 1e-9 to 1
  double first = 1;     ///< factor that is tried first, > 0
  double least = 0.01;  ///< the smallest factor that is tried [-], > 0, <= first
  double step = 1.25;   ///< between factors until one holds and one fails, > 1
  /// What a mechanism must prove to be missing, and what forces that count as balanced may leave,
  /// of block weights [-], > 0. Between the two, at the limit, a mechanism is free to move, and all
  /// digits are gone: what is not proved to fail counts as held.
  double missing = 1e-6, unbalance = 1e-5;
};

/// Between which factors the limit load lies: both ends prove themselves.
struct LimitBound {
  /// Forces in balance were found with the strength over this; 0: none.
  double holds = 0;
  /// With the strength over this a mechanism lets the loads do more work than joints can take: the
  /// bound. Infinite: blocks are held even by joints without any strength.
  double fails = std::numeric_limits<double>::infinity();
  double unbalance = 0;  ///< what the forces at `holds` leave, over block weights [-]
  /// What is out of balance at `fails` at least, over block weights: so much the mechanism proves.
  double missing = 0;
  int programmes = 0;  ///< solved
  /// Of every block, velocities along x and y and of turning times the radius of gyration, to a
  /// common factor. Empty where there is none.
  std::vector<std::array<double, 3>> mechanism;

  [[nodiscard]] bool is_closed() const { return holds > 0 && std::isfinite(fails); }
  /// Between the two, over `holds` [-]: the duality gap.
  [[nodiscard]] double gap() const { return is_closed() ? fails / holds - 1 : 0.0; }
};

/// The largest factor over which forces hold all blocks.
/// @param solve    see `LinearSolver`; by default `InteriorPoint`, which stops as soon as it knows
///                 on which side of the limit a factor lies
/// @param goes_on  goes_on(factor): asked before each programme
/// @throws InvalidInput    a setting out of range, or no block is free
/// @throws NumericalFault  a programme came to neither of the two ends
/// @throws Stopped
/// @cost  some 12 programmes of three rows a block and four columns a contact
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LimitBound
limit_load(const LimitProblem& problem, const LimitSearch& search = {},
           const std::function<bool(double)>& goes_on = {}, const LinearSolver& solve = {});

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

/// Writes the columns of forces between blocks.
class BalanceColumns {
 public:
  BalanceColumns(const LimitProblem& problem, LinearProgramme& programme)
      : problem_(problem), programme_(programme) {
    double sum = 0;
    int count = 0;
    first_row_.assign(problem.blocks.size(), -1);
    for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
      const LimitProblem::Block& block = problem.blocks[b];
      if (!block.is_free) continue;
      first_row_[b] = 3 * count++;
      sum += block.weight;
      for (const double load :
           {block.load.force.x(), block.load.force.y(), block.load.moment[0] / block.gyration})
        programme.right.push_back(-load / block.weight);
    }
    if (count == 0) throw InvalidInput("limit load: no block is free");
    unit_ = sum / count;
  }

  [[nodiscard]] double unit() const { return unit_; }  ///< of unknown forces [N]
  /// No force of any equilibrium is as large, in that unit. What has an end proves itself [-].
  static constexpr double largest_force = 1e6;
  [[nodiscard]] int first_row(int block) const { return first_row_[at(block)]; }
  [[nodiscard]] bool touches_free(int a, int b) const {
    return first_row(a) >= 0 || first_row(b) >= 0;
  }

  /// A force of this direction on block b, the opposite on a. @param a  -1: the ground
  void add(int a, int b, const Vec2& place, const Vec2& on_b, double low, double high) {
    add_entries(b, place, on_b);
    if (a >= 0) add_entries(a, place, Vec2(-on_b));
    programme_.close_column(0, low, high);
  }
  /// The same as a given force [N].
  void load(int a, int b, const Vec2& place, const Vec2& on_b) {
    each_row(b, place, on_b, [&](int row, double part) { programme_.right[at(row)] -= part; });
    if (a >= 0)
      each_row(a, place, Vec2(-on_b),
               [&](int row, double part) { programme_.right[at(row)] -= part; });
  }

 private:
  [[nodiscard]] static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  void add_entries(int block, const Vec2& place, const Vec2& force) {
    each_row(block, place, force, [&](int row, double part) { programme_.add(row, unit_ * part); });
  }
  /// take(row, what the force brings to it)
  template <class Take>
  void each_row(int block, const Vec2& place, const Vec2& force, const Take& take) {
    const int row = first_row(block);
    if (row < 0) return;
    const LimitProblem::Block& it = problem_.blocks[at(block)];
    take(row, force.x() / it.weight);
    take(row + 1, force.y() / it.weight);
    take(row + 2, cross(Vec2(place - it.centre), force) / (it.weight * it.gyration));
  }

  const LimitProblem& problem_;
  LinearProgramme& programme_;
  std::vector<int> first_row_;
  double unit_ = 1;
};

}  // namespace detail

VOUSSOIR_DESIGN_INLINE LinearProgramme balance_programme(const LimitProblem& problem,
                                                         double strength_left) {
  LinearProgramme programme;
  detail::BalanceColumns columns(problem, programme);
  constexpr double most = detail::BalanceColumns::largest_force;
  for (const LimitProblem::Contact& c : problem.contacts) {
    if (!columns.touches_free(c.a, c.b)) continue;
    const Vec2 along = perpendicular(c.normal);
    // Over the factor, as `weakened` has them: no more tension than friction and cohesion let be.
    const double half = 0.5 * length_of(c.end - c.start),
                 friction = strength_left * c.strength.friction_coefficient,
                 cohesion = half * strength_left * c.strength.cohesion;
    double tension = half * strength_left * c.strength.tensile_strength;
    if (friction > 0) tension = std::min(tension, cohesion / friction);
    const double shear = std::max(0.0, cohesion - friction * tension);  // left at that tension
    for (const Vec2& place : {c.start, c.end}) {
      columns.add(c.a, c.b, place, Vec2(c.normal + friction * along), 0, most);
      columns.add(c.a, c.b, place, Vec2(c.normal - friction * along), 0, most);
      if (tension > 0) columns.load(c.a, c.b, place, Vec2(-tension * c.normal));
      if (shear > 0)
        columns.add(c.a, c.b, place, along, -shear / columns.unit(), shear / columns.unit());
    }
  }
  for (const LimitProblem::Edge& e : problem.edges) {
    if (columns.first_row(e.block) < 0) continue;
    for (const Vec2& place : {e.start, e.end}) {
      columns.add(-1, e.block, place, Vec2(-e.outward), 0, most);
    }
  }
  // Where nothing else acts the loads themselves are missing: no more than that ever is.
  double loads = 1;
  for (const double load : programme.right) loads += std::abs(load);
  for (int row = 0; row < programme.rows(); ++row)
    for (const double sign : {1.0, -1.0}) {
      programme.add(row, sign);
      programme.close_column(1, 0, loads);
    }
  return programme;
}

namespace detail {

/// The search for the strength that is just enough.
class LimitLoadSearch {
 public:
  LimitLoadSearch(const LimitProblem& problem, const LimitSearch& search, const LinearSolver& solve,
                  const std::function<bool(double)>& goes_on)
      : problem_(problem), search_(search), solve_(solve), goes_on_(goes_on) {}

  [[nodiscard]] LimitBound find() {
    if (holds(0)) return bound_;
    double part = 1 / search_.first;
    if (holds(part)) {
      while (holds(part / search_.step)) part /= search_.step;
    } else {
      while (part * search_.least < 1 &&
             !holds(part = std::min(part * search_.step, 1 / search_.least))) {
      }
    }
    while (bound_.is_closed() && bound_.fails > bound_.holds * (1 + search_.width))
      (void)holds(1 / std::sqrt(bound_.holds * bound_.fails));
    return bound_;
  }

 private:
  /// Whether this part of the strength holds all blocks: unless a mechanism proves that it does
  /// not.
  bool holds(double part) {
    const double factor = 1 / part;
    if (goes_on_ && !goes_on_(factor)) throw Stopped();
    const LinearProgramme programme = balance_programme(problem_, part);
    const LinearSolution solution = solve_(programme);
    ++bound_.programmes;
    const LinearProof proof = proof_of(programme, solution);
    if (proof.bound > search_.missing && proof.price_fault == 0) {
      bound_.fails = factor;
      bound_.missing = proof.bound;
      keep_mechanism(solution);
      return false;
    }
    const double unbalance = std::max({proof.cost, proof.row_fault, proof.bound_fault});
    if (!(unbalance <= search_.unbalance))
      throw NumericalFault(message({"limit load: with the strength over ", factor,
                                    " neither forces in balance nor a mechanism were found"}));
    bound_.holds = factor;
    bound_.unbalance = unbalance;
    return true;
  }

  void keep_mechanism(const LinearSolution& solution) {
    bound_.mechanism.assign(problem_.blocks.size(), {});
    std::size_t row = 0;
    for (std::size_t b = 0; b < problem_.blocks.size(); ++b)
      if (problem_.blocks[b].is_free)
        for (double& velocity : bound_.mechanism[b])
          velocity = -solution.multipliers[row++] / problem_.blocks[b].weight;
  }

  const LimitProblem& problem_;
  const LimitSearch& search_;
  const LinearSolver& solve_;
  const std::function<bool(double)>& goes_on_;
  LimitBound bound_;
};

}  // namespace detail

VOUSSOIR_DESIGN_INLINE LimitBound limit_load(const LimitProblem& problem, const LimitSearch& search,
                                             const std::function<bool(double)>& goes_on,
                                             const LinearSolver& solve) {
  require(search.width >= 1e-9 && search.width <= 1, "width of a bound", search.width, "1e-9 to 1");
  require(search.first > 0 && std::isfinite(search.first), "first factor", search.first, "> 0");
  require(search.least > 0 && search.least <= search.first, "least factor", search.least,
          "> 0 and no more than the first");
  require(search.step > 1 && std::isfinite(search.step), "step of factors", search.step, "> 1");
  require(search.missing > 0 && search.missing <= search.unbalance, "force that is missing",
          search.missing, "> 0 and no more than the accepted unbalance");
  const LinearSolver own =
      InteriorPoint<3>({.gap = std::min(1e-8, 0.01 * search.missing), .asked = search.missing});
  return detail::LimitLoadSearch(problem, search, solve ? solve : own, goes_on).find();
}

#endif

}  // namespace voussoir::design
