// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/motion/moving_body.hpp>

namespace voussoir {

/// A force and a moment about the centre of a body, world axes.
template <int Dim>
struct Load {
  Vec<Dim> force = Vec<Dim>::Zero();     ///< [N]
  Spin<Dim> moment = Spin<Dim>::Zero();  ///< [N m]
};

/// What holds moving bodies besides contacts: bolts, a lining, a spring of a test.
///
/// Few against the contacts: a virtual call a step costs nothing, and any of them can join a run.
template <int Dim>
class Support {
 public:
  using Bodies = std::vector<MovingBody<Dim>>;
  virtual ~Support() = default;
  /// The bodies that it acts on; always the same.
  [[nodiscard]] virtual std::vector<int> bodies() const = 0;
  /// Adds its forces to `loads`, one for every body of the run, and brings its history up to date.
  virtual void act(const Bodies& bodies, std::vector<Load<Dim>>& loads) = 0;
  /// Energy that it holds, and has lost to yield [J].
  [[nodiscard]] virtual double energy(const Bodies& bodies) const = 0;
  /// Adds to every body's number a bound on the largest eigenvalue of M^-1 K [1/s^2], K its own
  /// stiffness with all other bodies held.
  virtual void add_stiffness_over_mass(const Bodies& bodies, std::vector<double>& sums) const = 0;
};

}  // namespace voussoir
