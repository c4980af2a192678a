// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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
#include <voussoir/geometry/tangent_basis.hpp>
#include <voussoir/linear/interior_point.hpp>
#include <voussoir/linear/linear_programme.hpp>
#include <voussoir/model/support.hpp>

/// A bound on the factor of safety by limit analysis: rigid blocks whose joints dilate by their
/// friction.
///
/// Whatever stands with the strength of its joints over F is held by forces that balance every
/// block and that no joint refuses. The largest factor for which there are such forces therefore
/// bounds from above every factor that stands, whether slip dilates or not, by whatever path it was
/// come to. It is the limit load itself where dilation is the friction (the static theorem), and no
/// safe value elsewhere.
///
/// Forces act at the corners of every contact, its ends in 2-D: N >= -sigma_t A, |T| <= c A +
/// N tan(phi), A the corner's share of the area, all strengths over F. Every distribution of stress
/// over the contact, concentrated or not, has its force and moment in such forces, by its shares at
/// the corners: nothing that the model can do is left out.
///
/// In 2-D this is a linear programme, in 3-D one with a cone for each corner.
///
/// Source: Livesley (1978), Limit analysis of structures formed from rigid blocks, Int. J. Num.
/// Meth. Eng. 12, and (1992), A computational model for the limit analysis of three-dimensional
/// masonry structures, Meccanica 27; why it bounds joints without dilation: Radenkovic (1961),
/// Theoremes limites pour un materiau de Coulomb a dilatation non standardisee.
namespace voussoir::design {

/// What a joint bears, before it is divided.
struct JointStrength {
  double friction_coefficient = 0;  ///< tan(phi) [-], >= 0
  double cohesion = 0;              ///< [Pa], >= 0
  double tensile_strength = 0;      ///< [Pa], >= 0, <= c / tan(phi)
};

/// Rigid blocks and where they touch. In 2-D per metre of tunnel.
template <int Dim>
struct LimitProblem {
  struct Block {
    Vec<Dim> centre;
    double weight, gyration;  ///< [N], [m], > 0: what is missing of a balance is measured by them
    Load<Dim> load;           ///< all that acts on it but contacts: weight, surcharge, loads
    bool is_free = true;      ///< false: it bears any force
  };
  /// Of what two blocks share.
  struct Corner {
    int a, b;
    Vec<Dim> place;
    Vec<Dim> normal;  ///< from a to b, a unit vector
    double share;     ///< of its area [m^2], in 2-D of its length [m]
    JointStrength strength;
  };
  /// Of what a block shares with a smooth side of the model, which pushes as hard as it must.
  struct EdgeCorner {
    int block;
    Vec<Dim> place;
    Vec<Dim> outward;  ///< a unit vector
  };
  std::vector<Block> blocks;
  std::vector<Corner> corners;
  std::vector<EdgeCorner> edges;

  /// Those of a facet that two blocks share.
  /// @param facet   its corners in their order: two in 2-D, three or more of a convex one in 3-D
  /// @param normal  from a to b
  void add_contact(int a, int b, const std::vector<Vec<Dim>>& facet, const Vec<Dim>& normal,
                   const JointStrength& strength);
  /// Of a block and a smooth side.
  void add_edge(int block, const std::vector<Vec<Dim>>& facet, const Vec<Dim>& outward) {
    for (const Vec<Dim>& place : facet) edges.push_back({block, place, outward});
  }
};

/// How much is missing until all blocks are in balance: the least sum of the forces and moments
/// that would have to be added, each over the weight of its block and in moments its radius of
/// gyration. Unknowns are forces over the mean weight of the free blocks. Neither their number nor
/// the pattern depends on the strength, but that without any there are no cones.
/// @param strength_left  1 / F, >= 0
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LinearProgramme
balance_programme(const LimitProblem<2>& problem, double strength_left);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LinearProgramme
balance_programme(const LimitProblem<3>& problem, double strength_left);

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
  /// Of every block, velocities along the axes and of turning times the radius of gyration, to a
  /// common factor: three in 2-D, six in 3-D. Empty where there is none.
  std::vector<std::vector<double>> mechanism;

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
/// @cost  some 12 programmes of three rows a block and four columns a contact; in 3-D of six and
///        three for each corner
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LimitBound
limit_load(const LimitProblem<2>& problem, const LimitSearch& search = {},
           const std::function<bool(double)>& goes_on = {}, const LinearSolver& solve = {});
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LimitBound
limit_load(const LimitProblem<3>& problem, const LimitSearch& search = {},
           const std::function<bool(double)>& goes_on = {}, const LinearSolver& solve = {});

/// By the share of every corner a stress that is the same all over acts there with its own force
/// and moment, as any stress does with its own: triangles from the first corner on.
template <int Dim>
void LimitProblem<Dim>::add_contact(int a, int b, const std::vector<Vec<Dim>>& facet,
                                    const Vec<Dim>& normal, const JointStrength& strength) {
  const std::size_t first = corners.size();
  for (const Vec<Dim>& place : facet) corners.push_back({a, b, place, normal, 0, strength});
  if constexpr (Dim == 2) {
    for (std::size_t k = 0; k < 2; ++k)
      corners[first + k].share = 0.5 * length_of(facet[1] - facet[0]);
  } else {
    for (std::size_t k = 2; k < facet.size(); ++k) {
      const double area =
          0.5 * length_of(cross(Vec3(facet[k - 1] - facet[0]), Vec3(facet[k] - facet[0])));
      for (const std::size_t corner : {std::size_t{0}, k - 1, k})
        corners[first + corner].share += area / 3;
    }
  }
}

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

/// Writes the columns of forces between blocks.
template <int Dim>
class BalanceColumns {
 public:
  static constexpr int dof = Dim + spin_count<Dim>;

  BalanceColumns(const LimitProblem<Dim>& problem, LinearProgramme& programme)
      : problem_(problem), programme_(programme) {
    double sum = 0;
    int count = 0;
    first_row_.assign(problem.blocks.size(), -1);
    for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
      const auto& block = problem.blocks[b];
      if (!block.is_free) continue;
      first_row_[b] = dof * count++;
      sum += block.weight;
      for (int d = 0; d < Dim; ++d) programme.right.push_back(-block.load.force[d] / block.weight);
      for (int d = 0; d < dof - Dim; ++d)
        programme.right.push_back(-block.load.moment[d] / block.gyration / block.weight);
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
  void add(int a, int b, const Vec<Dim>& place, const Vec<Dim>& on_b, double low, double high) {
    add_entries(b, place, on_b);
    if (a >= 0) add_entries(a, place, Vec<Dim>(-on_b));
    programme_.close_column(0, low, high);
  }
  /// The same as a given force [N].
  void load(int a, int b, const Vec<Dim>& place, const Vec<Dim>& on_b) {
    each_row(b, place, on_b, [&](int row, double part) { programme_.right[at(row)] -= part; });
    if (a >= 0)
      each_row(a, place, Vec<Dim>(-on_b),
               [&](int row, double part) { programme_.right[at(row)] -= part; });
  }

 private:
  [[nodiscard]] static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  void add_entries(int block, const Vec<Dim>& place, const Vec<Dim>& force) {
    each_row(block, place, force, [&](int row, double part) { programme_.add(row, unit_ * part); });
  }
  /// take(row, what the force brings to it)
  template <class Take>
  void each_row(int block, const Vec<Dim>& place, const Vec<Dim>& force, const Take& take) {
    const int row = first_row(block);
    if (row < 0) return;
    const auto& it = problem_.blocks[at(block)];
    for (int d = 0; d < Dim; ++d) take(row + d, force[d] / it.weight);
    const Spin<Dim> moment = moment_of(Vec<Dim>(place - it.centre), force);
    for (int d = 0; d < dof - Dim; ++d) take(row + Dim + d, moment[d] / (it.weight * it.gyration));
  }

  const LimitProblem<Dim>& problem_;
  LinearProgramme& programme_;
  std::vector<int> first_row_;
  double unit_ = 1;
};

/// What a corner bears, of strength over a factor.
struct CornerStrength {
  double friction = 0, cohesion = 0, tension = 0;  ///< [-], [N], [N]: no more than lets some shear

  CornerStrength(const JointStrength& strength, double share, double strength_left)
      : friction(strength_left * strength.friction_coefficient),
        cohesion(share * strength_left * strength.cohesion),
        tension(share * strength_left * strength.tensile_strength) {
    // As `weakened` has them: no more tension than friction and cohesion let be.
    if (friction > 0) tension = std::min(tension, cohesion / friction);
  }
  /// [N], >= 0
  [[nodiscard]] double shear_in_tension() const {
    return std::max(0.0, cohesion - friction * tension);
  }
};

/// Along both edges of what friction allows, and what is left of shear at the largest tension.
inline void add_corner(const LimitProblem<2>::Corner& c, const CornerStrength& strength,
                       BalanceColumns<2>& columns, LinearProgramme&) {
  constexpr double most = BalanceColumns<2>::largest_force;
  const Vec2 along = perpendicular(c.normal);
  const double friction = strength.friction, tension = strength.tension,
               shear = strength.shear_in_tension();
  columns.add(c.a, c.b, c.place, Vec2(c.normal + friction * along), 0, most);
  columns.add(c.a, c.b, c.place, Vec2(c.normal - friction * along), 0, most);
  if (tension > 0) columns.load(c.a, c.b, c.place, Vec2(-tension * c.normal));
  if (shear > 0)
    columns.add(c.a, c.b, c.place, along, -shear / columns.unit(), shear / columns.unit());
}

/// A normal force and two along the joint, in a cone.
inline void add_corner(const LimitProblem<3>::Corner& c, const CornerStrength& strength,
                       BalanceColumns<3>& columns, LinearProgramme& programme) {
  constexpr double most = BalanceColumns<3>::largest_force,
                   endless = std::numeric_limits<double>::infinity();
  const bool has_shear = strength.friction > 0 || strength.cohesion > 0;
  if (has_shear)
    programme.cones.push_back(
        {programme.columns(), strength.friction, strength.cohesion / columns.unit()});
  columns.add(c.a, c.b, c.place, c.normal, -strength.tension / columns.unit(), most);
  if (!has_shear) return;
  const auto along = tangent_basis(c.normal);
  for (int k = 0; k < 2; ++k) columns.add(c.a, c.b, c.place, column(along, k), -endless, endless);
}

template <int Dim>
[[nodiscard]] LinearProgramme programme_of(const LimitProblem<Dim>& problem, double strength_left) {
  LinearProgramme programme;
  BalanceColumns<Dim> columns(problem, programme);
  for (const auto& corner : problem.corners)
    if (columns.touches_free(corner.a, corner.b))
      add_corner(corner, CornerStrength(corner.strength, corner.share, strength_left), columns,
                 programme);
  for (const auto& edge : problem.edges)
    if (columns.first_row(edge.block) >= 0)
      columns.add(-1, edge.block, edge.place, Vec<Dim>(-edge.outward), 0,
                  BalanceColumns<Dim>::largest_force);
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

}  // namespace detail

VOUSSOIR_DESIGN_INLINE LinearProgramme balance_programme(const LimitProblem<2>& problem,
                                                         double strength_left) {
  return detail::programme_of(problem, strength_left);
}
VOUSSOIR_DESIGN_INLINE LinearProgramme balance_programme(const LimitProblem<3>& problem,
                                                         double strength_left) {
  return detail::programme_of(problem, strength_left);
}

namespace detail {

/// The search for the strength that is just enough.
template <int Dim>
class LimitLoadSearch {
 public:
  LimitLoadSearch(const LimitProblem<Dim>& problem, const LimitSearch& search,
                  const LinearSolver& solve, const std::function<bool(double)>& goes_on)
      : problem_(problem), search_(search), solve_(solve), goes_on_(goes_on) {}

  [[nodiscard]] LimitBound find() {
    if (holds(0)) return bound_;
    double part = 1 / search_.first;
    if (holds(part)) {
      while (holds(part / search_.step)) part /= search_.step;
    } else {
      // Where nothing holds them the smallest factor says so at once.
      if (search_.least == search_.first || !holds(1 / search_.least)) return bound_;
      while (!holds(part = std::min(part * search_.step, 1 / search_.least))) {
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
    constexpr auto dof = static_cast<std::size_t>(BalanceColumns<Dim>::dof);
    bound_.mechanism.assign(problem_.blocks.size(), std::vector<double>(dof, 0.0));
    std::size_t row = 0;
    for (std::size_t b = 0; b < problem_.blocks.size(); ++b)
      if (problem_.blocks[b].is_free)
        for (double& velocity : bound_.mechanism[b])
          velocity = -solution.multipliers[row++] / problem_.blocks[b].weight;
  }

  const LimitProblem<Dim>& problem_;
  const LimitSearch& search_;
  const LinearSolver& solve_;
  const std::function<bool(double)>& goes_on_;
  LimitBound bound_;
};

template <int Dim>
[[nodiscard]] LimitBound limit_load(const LimitProblem<Dim>& problem, const LimitSearch& search,
                                    const std::function<bool(double)>& goes_on,
                                    const LinearSolver& solve) {
  require(search.width >= 1e-9 && search.width <= 1, "width of a bound", search.width, "1e-9 to 1");
  require(search.first > 0 && std::isfinite(search.first), "first factor", search.first, "> 0");
  require(search.least > 0 && search.least <= search.first, "least factor", search.least,
          "> 0 and no more than the first");
  require(search.step > 1 && std::isfinite(search.step), "step of factors", search.step, "> 1");
  require(search.missing > 0 && search.missing <= search.unbalance, "force that is missing",
          search.missing, "> 0 and no more than the accepted unbalance");
  const LinearSolver own = InteriorPoint<BalanceColumns<Dim>::dof>(
      {.gap = std::min(1e-8, 0.01 * search.missing), .asked = search.missing});
  return LimitLoadSearch<Dim>(problem, search, solve ? solve : own, goes_on).find();
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE LimitBound limit_load(const LimitProblem<2>& problem,
                                             const LimitSearch& search,
                                             const std::function<bool(double)>& goes_on,
                                             const LinearSolver& solve) {
  return detail::limit_load(problem, search, goes_on, solve);
}
VOUSSOIR_DESIGN_INLINE LimitBound limit_load(const LimitProblem<3>& problem,
                                             const LimitSearch& search,
                                             const std::function<bool(double)>& goes_on,
                                             const LinearSolver& solve) {
  return detail::limit_load(problem, search, goes_on, solve);
}

#endif

}  // namespace voussoir::design
