// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/bar_in_opening.hpp>
#include <voussoir/rockmass/opening_checks.hpp>
#include <voussoir/tunnel/placed_load.hpp>

namespace voussoir {

// What is wrong with a construction before any of it is carried out.

/// @param mass  in which it is to be carried out
/// @throws InvalidInput  an opening that does not fit, rounds that overlap or come twice; bolts of
///                       an earlier stage in rock that a later one takes out; a load outside of
///                       rock, or before a round. The message names stage, place and remedy
/// @cost  rounds^2 x edges^2, bolts x later rounds x edges
template <class Plan, class Mass>
void check_construction(const Plan& plan, const Mass& mass) {
  const double tolerance = 1e3 * mass.domain.tolerance();
  Mass planned;  // of which only the openings count
  planned.domain = mass.domain;
  planned.openings = mass.openings;
  const std::string* loading = nullptr;  // the name of a stage before that loads blocks
  for (const auto& stage : plan.stages)
    naming("stage \"" + stage.name + "\"", [&] {
      for (const auto& round : stage.rounds) {
        check_opening(round.opening, planned);
        planned.openings.push_back(round.opening);
      }
      if (loading != nullptr && !stage.rounds.empty())
        throw InvalidInput("it excavates after stage \"" + *loading +
                           "\" has loaded blocks; must come before: load them in the last stage");
      for (const auto& load : stage.loads) check_load(load, planned.domain, planned.openings);
      if (!stage.loads.empty()) loading = &stage.name;
    });
  for (std::size_t s = 0; s < plan.stages.size(); ++s)
    for (std::size_t later = s + 1; later < plan.stages.size(); ++later)
      for (const auto& round : plan.stages[later].rounds) {
        int number = 0;
        for (const auto& bolts : plan.stages[s].bolts)
          for (const auto& bar : bolts.bars) {
            ++number;
            const auto place = place_inside(bar, round.opening, tolerance);
            if (!place) continue;
            using Place = std::decay_t<decltype(*place)>;
            throw InvalidInput(
                message({"stage \"", plan.stages[s].name, "\": bolt ", number, " runs at ",
                         text_of<static_cast<int>(Place::RowsAtCompileTime)>(*place),
                         " m through rock that stage \"", plan.stages[later].name,
                         "\" takes out: install it after that, or end it outside"}));
          }
      }
}

}  // namespace voussoir
