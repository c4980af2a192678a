// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/model/contact_update.hpp>

namespace voussoir {

namespace detail {

/// Whether blocks have moved so far that contacts are to be updated. Where the limit on that is
/// no shorter than the one beyond which a block is detached, they never are.
template <class System>
[[nodiscard]] bool is_due(const System& system, const Acceptance& acceptance, double share = 1) {
  return system.shapes != nullptr &&
         acceptance.contact_update_limit < acceptance.displacement_limit &&
         system.moved_since_update() > share * acceptance.contact_update_limit;
}

/// Updates contacts if it is due.
///
/// An equilibrium is looked at from near by, where contacts have been updated before or a block has
/// turned: rotations are finite, and linear ones, between updates, are off by half their square. A
/// roof beam of 15 blocks that turn by 6e-3 sags a tenth too little with those.
/// @param report   is told what the update has done
/// @param at_rest  the search is about to end here
/// @return  true if it has
/// @throws InvalidInput  after so many of a stage that a limit this short never comes to an end
/// @throws Stopped  the system is as it was
template <class System>
bool update_when_due(System& system, const SearchContext& context, EquilibriumReport& report,
                     bool at_rest = false) {
  constexpr int most = 500;              // a stage in which rock fails has some tens
  constexpr double linear_up_to = 1e-3;  // rotations at rest [rad]
  const Acceptance& acceptance = context.acceptance;
  const bool near_by =
      at_rest && (system.has_updated_contacts() || system.turned_since_update() > linear_up_to);
  if (!is_due(system, acceptance, near_by ? 0.05 : 1.0)) return false;
  if (report.contact_updates.count >= most)
    throw InvalidInput(
        message({"contact_update_limit of ", acceptance.contact_update_limit,
                 " m: contacts have been updated ", most,
                 " times in one stage, and there is no end to it; it wants a ",
                 "twentieth of the displacement limit, ", 0.05 * acceptance.displacement_limit,
                 " m, or more; left out, it is chosen by the rock"}));
  report.contact_updates.add(
      update_contacts(system, 2 * acceptance.contact_update_limit, context.progress));
  return true;
}

}  // namespace detail

}  // namespace voussoir
