// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace voussoir {

/// Where the energy of a dynamic run has gone since it began [J]; per metre in 2-D.
///
/// What bodies and springs hold is a difference to the beginning; the rest is summed up step by
/// step. What is left over when all is added up, the imbalance, is the error of the time steps: it
/// shrinks with the square of the step while nothing slides; with the step itself where dashpots
/// act, whose velocity is half a step old.
struct EnergyBalance {
  /// Stored in the bodies, difference to the beginning; without damping that of the velocities half
  /// a step before and after, which the steps keep (`Kick::kinetic_rate`).
  double kinetic = 0;
  double contacts = 0;         ///< stored in the springs of joints, difference to the beginning
  double supports = 0;         ///< stored in bolts and lining, or lost by yielding bolts
  double gravity = 0;          ///< work done by the weight
  double loads = 0;            ///< work done by all other loads
  double friction = 0;         ///< lost to slip
  double viscosity = 0;        ///< lost to dashpots at contacts
  double damping = 0;          ///< lost to local damping
  double contact_updates = 0;  ///< given to the springs of contacts by updates; < 0: lost by them
  /// Of that, what contacts got beyond what those of their two bodies had: rounding.
  double made_by_updates = 0;
  double highest_kinetic = 0;  ///< of the differences seen at checks so far: what has been at stake

  /// What is stored and lost, less the work done: zero but for the error of the steps.
  [[nodiscard]] double imbalance() const {
    return kinetic + contacts + supports + friction + viscosity + damping - gravity - loads -
           contact_updates;
  }
  /// What is stored now beyond what was stored in the beginning and brought since: less than zero
  /// by what has been lost, and never above it in a sound run but for the error of the steps.
  [[nodiscard]] double above_start() const {
    return kinetic + contacts + supports - gravity - loads;
  }
  /// The largest of the amounts that should balance, now or at the height of the motion.
  [[nodiscard]] double scale() const {
    return std::max({std::abs(kinetic), std::abs(contacts), std::abs(supports), std::abs(gravity),
                     std::abs(loads), friction, viscosity, damping, highest_kinetic});
  }
  /// Imbalance over the largest amount [-]; 0 where nothing has happened.
  [[nodiscard]] double relative_imbalance() const {
    return scale() > 0 ? imbalance() / scale() : 0.0;
  }
};

}  // namespace voussoir
