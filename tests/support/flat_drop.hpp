// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/dynamics/dynamics.hpp>

#include "support/blocks.hpp"
#include "support/degree.hpp"

namespace voussoir_test {

/// A block of 0.4 to 2 m that comes down flat on a floor from 1 mm to 1 m, half of them near the
/// edge of the floor and half along it at up to 2 m/s, without any damping; friction 0 to 45
/// degrees. A function of the number alone.
template <int Dim>
struct FlatDrop {
  voussoir::Dynamics<Dim, voussoir::CoulombJoint> run;
  double stake;  ///< what it has to begin with: of motion, and of height above the floor [J]

  /// @param safety        of the stable step;  @param has_friction  false: none
  explicit FlatDrop(int number, double safety, bool has_friction = true)
      : FlatDrop(voussoir::Random(static_cast<std::uint64_t>(number), 5100 + Dim), safety,
                 has_friction) {}

  /// The most above its beginning that is seen every 100 steps, over the stake [-].
  /// @throws NumericalFault  the run finds it too much
  [[nodiscard]] double most_above(int hundreds) {
    double most = 0;
    for (int k = 0; k < hundreds; ++k) {
      run.advance_steps(100);
      most = std::max(most, run.energy().above_start() / stake);
    }
    return most;
  }

 private:
  FlatDrop(voussoir::Random random, double safety, bool has_friction)
      : run(joint(random, has_friction), {.safety = safety}), stake(0) {
    using voussoir::Vec;
    Vec<Dim> size, middle = voussoir::zeros<Vec<Dim>>(), floor = voussoir::all_entries<Dim>(8),
                   below = middle;
    for (int k = 0; k < Dim; ++k) size[k] = between(random, 0.4, 2);
    floor[Dim - 1] = 1;
    below[Dim - 1] = -0.5;
    for (int k = 0; k < Dim - 1; ++k) middle[k] = between(random, -1, 1);
    const double height = std::pow(10.0, between(random, -3, 0));
    middle[Dim - 1] = 0.5 * size[Dim - 1] + height;
    if (random.below(2) == 0) middle[0] = 4 - 0.45 * size[0] * random.uniform();
    const auto box = [](const Vec<Dim>& centre, const Vec<Dim>& lengths) {
      if constexpr (Dim == 2)
        return rectangle(centre, lengths[0], lengths[1]);
      else
        return brick(centre, lengths);
    };
    constexpr double density = 2700;
    run.add_fixed_block(box(below, floor));
    const int block = run.add_block(box(middle, size), density);
    Vec<Dim> velocity = voussoir::zeros<Vec<Dim>>();
    if (random.below(2) == 0) velocity[0] = between(random, -2, 2);
    run.set_velocity(block, velocity);
    stake = run.kinetic_energy() + density * size.prod() * run.settings().gravity * height;
  }
  [[nodiscard]] static double between(voussoir::Random& random, double low, double high) {
    return low + (high - low) * random.uniform();
  }
  [[nodiscard]] static voussoir::CoulombJoint joint(voussoir::Random& random, bool has_friction) {
    const double normal = std::pow(10.0, between(random, 9, 10)),
                 shear = normal * between(random, 0.1, 1), angle = between(random, 0, 45);
    return voussoir::CoulombJoint({normal, shear, has_friction ? angle * degree : 0.0});
  }
};

}  // namespace voussoir_test
