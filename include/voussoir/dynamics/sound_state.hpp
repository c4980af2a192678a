// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>
#include <voussoir/dynamics/energy_balance.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir::detail {

/// All that a run goes back to when it goes bad: a copy of what it consisted of when it was last
/// found sound.
template <int Dim, class Network, class Tracker>
struct SoundState {
  std::vector<MovingBody<Dim>> bodies;
  Network network;
  Tracker tracker;
  EnergyBalance audit;
  SupportSet<Dim> supports;
  double kinetic_given, time;  ///< [J], [s]
  std::int64_t steps;
};

}  // namespace voussoir::detail
