// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>
#include <voussoir/core/progress.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/model/contact_update.hpp>
#include <voussoir/model/detail/carry_over.hpp>
#include <voussoir/model/detail/initial_model.hpp>
#include <voussoir/model/opened_lining.hpp>
#include <voussoir/model/wall_tractions.hpp>
#include <voussoir/rockmass/in_situ.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir::detail {

/// What a solver knows beside the system, after a further round.
template <int Dim>
struct AfterRound {
  std::vector<double> measures;  ///< of bodies [m^2 or m^3]
  std::vector<int> fallen;       ///< bodies that had detached before
  BodyMarks touched;             ///< bodies on which the round has acted
  std::vector<OpenedLining<Dim>> opened;
};

/// Puts the model of rock from which a further round has been taken out in the place of the one
/// before, history carried over. Compiled once for all laws.
/// @param mass          what is left of the rock
/// @param next          without bodies; holds the model before afterwards
/// @param update_limit  of contact updates, of the last search [m]
/// @param walls, fallen  of the model before; the walls are carried over
/// @throws InvalidInput, Stopped  `system` and `walls` are as they were
template <class Detector, class System>
[[nodiscard]] AfterRound<System::dim> go_on_after_round(
    System& system, System& next,
    const std::shared_ptr<const RockMass<typename System::GeometryType>>& mass,
    std::vector<int> law_of_cut, const typename System::GeometryType::Opening& opening,
    const InSitu& in_situ, const FarField<System::dim>& far_field, double update_limit,
    WallTractions& walls, const std::vector<int>& fallen, const Progress& progress) {
  AfterRound<System::dim> after;
  InitialModel<Detector, System> model(*mass, in_situ, far_field, next, progress);
  model.add_bodies(after.measures);
  model.add_contacts(std::move(law_of_cut));
  model.add_edges();
  next.shapes = shapes_of<System>(mass, far_field);
  CarryOver<System> carry(system, mass->origins, next, mass->domain.tolerance(), opening);
  carry.run();
  if (system.has_updated_contacts())
    update_contacts(next, 2 * update_limit, progress);
  else
    model.set_initial_stress();
  // From here on nothing throws.
  walls.carry_over([&](const Eigen::VectorXd& load) { return carry.carry_load(load); });
  after.touched = carry.touched();
  after.opened = carry.opened();
  for (const int b : fallen)
    for (int piece = carry.pieces(b).first; piece < carry.pieces(b).second; ++piece)
      after.fallen.push_back(piece);
  after.measures.resize(static_cast<std::size_t>(next.body_count()), 0.0);
  std::swap(system, next);
  return after;
}

}  // namespace voussoir::detail
