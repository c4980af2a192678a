// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>
#include <voussoir/dynamics/energy_balance.hpp>
#include <voussoir/dynamics/moving_part.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir::detail {

/// A copy of all that a run consists of, to go back to: when it goes bad, or to go on from there in
/// another way.
template <int Dim, class Network, class Tracker>
struct RunState {
  std::vector<MovingBody<Dim>> bodies;
  Network network;
  Tracker tracker;
  EnergyBalance audit;
  SupportSet<Dim> supports;
  double kinetic_given, time;  ///< [J], [s]
  std::int64_t steps;
  double held_fraction;
  MovingPart part;
};

}  // namespace voussoir::detail
