// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/bar_in_opening.hpp>
#include <voussoir/model/support.hpp>
#include <voussoir/rockmass/domain.hpp>

namespace voussoir {

// Loads on blocks that joints have cut: numbers of blocks change with the seed and with what is
// excavated, points of the rock do not.

/// A load on the block of rock in which a point lies, as the rock is before anything has moved.
template <int Dim>
struct PlacedLoad {
  Vec<Dim> at;     ///< where the force acts [m]
  Load<Dim> load;  ///< [N], [N m], world axes; per metre of tunnel in 2-D
};

/// @throws InvalidInput  the point is outside the domain or in an opening, or something is not
///                       finite
/// @param openings  those that are excavated when the load comes on
template <int Dim, class Openings>
void check_load(const PlacedLoad<Dim>& load, const Domain<Dim>& domain, const Openings& openings) {
  require(std::isfinite(load.at.squaredNorm()), "point of a load", load.at.norm(),
          "finite coordinates");
  require(std::isfinite(load.load.force.squaredNorm() + load.load.moment.squaredNorm()),
          "load on a block", load.load.force.norm(), "a finite force and moment");
  const std::string here = "load at " + text_of<Dim>(load.at) + " m: ";
  if (any_less(load.at, domain.low) || any_less(domain.high, load.at))
    throw InvalidInput(here + "it is outside the rock; must lie within " +
                       text_of<Dim>(domain.low) + " and " + text_of<Dim>(domain.high) + " m");
  for (const auto& opening : openings)
    if (opening.contains(load.at))
      throw InvalidInput(here + "it is in an opening; must lie in rock that stays: in the wall");
}

/// The block of rock that bears a load.
/// @throws InvalidInput  see `check_load`; or the point lies on a joint between blocks, or where a
///                       piece at the wall was left out
/// @cost  the number of blocks
template <class Mass, int Dim>
[[nodiscard]] int loaded_block(const Mass& mass, const PlacedLoad<Dim>& load) {
  check_load(load, mass.domain, mass.openings);
  const double tolerance = 1e3 * mass.domain.tolerance();
  int found = -1;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const auto& parts = mass.bodies[b].parts;
    if (std::none_of(parts.begin(), parts.end(),
                     [&](const auto& part) { return part.contains(load.at, tolerance); }))
      continue;
    if (found >= 0)
      throw InvalidInput("load at " + text_of<Dim>(load.at) +
                         " m: it lies on a joint, between two blocks; must lie inside of one");
    found = static_cast<int>(b);
  }
  if (found < 0)
    throw InvalidInput("load at " + text_of<Dim>(load.at) +
                       " m: no block is there, for what was there is too small a piece of the "
                       "wall; must lie in a block");
  return found;
}

/// Puts a load on the block in which its point lies; see `ComposedSolver::add_load`.
/// @return  the block
/// @throws InvalidInput  see `loaded_block`; or the block has come off
template <class Solver>
int add_load_at(Solver& solver, const PlacedLoad<Solver::dim>& load) {
  constexpr int dim = Solver::dim;
  const int block = loaded_block(solver.mass(), load);
  if (solver.system().body(block).is_gone)
    throw InvalidInput("load at " + text_of<dim>(load.at) +
                       " m: the block there has come off before; must be a block that stands, or "
                       "an earlier stage");
  Load<dim> about_centre = load.load;
  about_centre.moment +=
      moment_of(Vec<dim>(load.at - solver.system().body(block).centre), load.load.force);
  solver.add_load(block, about_centre);
  return block;
}

}  // namespace voussoir
