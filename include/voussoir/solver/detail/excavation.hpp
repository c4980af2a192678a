// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/model/detail/next_round.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/carving_limits.hpp>
#include <voussoir/rockmass/opening_checks.hpp>
#include <voussoir/solver/composed_solver.hpp>

namespace voussoir {

// The rounds that a solver takes out of its rock.

template <class Models>
void ComposedSolver<Models>::excavate(const typename Geometry::Opening& opening,
                                      double smallest_piece, const Progress& progress) {
  if (smallest_piece == of_the_rock) smallest_piece = smallest_piece_of(*mass_);
  if (is_loaded_)
    throw InvalidInput(
        "excavate: blocks have been loaded or fixed, which the rock that is left after a round "
        "would not know: excavate first");
  if (started_ || walls_.count() > 0) return excavate_further(opening, smallest_piece, progress);
  check_opening(opening, *mass_);
  // A small mass is copied, and one that may be cut in two: if that is refused the solver stays as
  // it was. The mass is held by its shapes, too.
  const bool is_kept =
      mass_.use_count() > 2 || mass_->bodies.size() < 10000 || may_part(opening, mass_->domain);
  if (!is_kept) system_.shapes.reset();
  mass_ = std::make_shared<RockMass<Geometry>>(
      carve(is_kept ? *mass_ : std::move(*mass_), opening, smallest_piece, progress));
  system_ = new_system();
  build(progress);
  hold_wall();
}

template <class Models>
void ComposedSolver<Models>::excavate_further(const typename Geometry::Opening& opening,
                                              double smallest_piece, const Progress& progress) {
  const auto mass = std::make_shared<RockMass<Geometry>>(
      carve(RockMass<Geometry>(*mass_), opening, smallest_piece, progress));
  SystemType next = new_system();
  detail::AfterRound<dim> after = detail::go_on_after_round<Detector>(
      system_, next, mass, joint_laws_.of_cuts(*mass), opening, in_situ_, far_field_, update_limit_,
      walls_, fallen_, progress);
  mass_ = mass;
  measures_ = std::move(after.measures);
  fallen_ = std::move(after.fallen);
  hold_wall(&after.touched);
  opened_.insert(opened_.end(), after.opened.begin(), after.opened.end());
}

}  // namespace voussoir
