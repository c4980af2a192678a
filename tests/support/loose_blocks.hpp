// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/geometry/half_space.hpp>

#include "support/blocks.hpp"

/// Loose blocks that nobody picked, let go above a floor or poured into a bin.
namespace voussoir_test {

/// The draws are a function of the number alone, the same on every machine.
///
///   blocks   one (even numbers) or 48; boxes of 0.4 to 1 m, half of them with corners cut off,
///            turned by any angle, 1 mm to 1 m above what is below; half the cases thrown at up to
///            2 m/s and 2 rad/s
///   contact  k_n 1 to 10 GPa/m, k_s 0.1 to 1 of it, friction 0 to 45 degrees
///   damping  dashpots of ratio 0 (a third of the cases) to 1, local damping 0 (two thirds) to 0.8
template <int Dim>
class LooseBlocks {
 public:
  using Run = voussoir::Dynamics<Dim, voussoir::CoulombJoint>;

  /// @param settings  whose damping is drawn unless `given`
  explicit LooseBlocks(int number, voussoir::DynamicsSettings settings = {}, bool given = false)
      : random_(static_cast<std::uint64_t>(number), 7000 + Dim), run_(make(settings, given)) {
    const bool many = number % 2 == 1;
    fill(many);
    kinetic_ = run_.kinetic_energy();
  }

  [[nodiscard]] Run& run() { return run_; }

  /// What a run has done to the energy.
  struct Account {
    double made = 0;     ///< kinetic, elastic and of height, above the start, the most over `stake`
    double stake = 0;    ///< initial kinetic energy and the most that gravity has done [J]
    double updates = 0;  ///< what contact updates have given in the end, over `stake`; < 0: lost
    double given = 0;    ///< of it, what they made (`EnergyBalance::made_by_updates`)
  };
  /// Advances and looks every 100 steps.
  Account advance(int steps) {
    Account account;
    double most = 0;
    for (int done = 0; done < steps; done += 100) {
      run_.advance_steps(100);
      const voussoir::EnergyBalance now = run_.energy();
      account.stake = std::max(account.stake, kinetic_ + now.gravity);
      most = std::max(most, now.kinetic + now.contacts - now.gravity);
      if (account.stake > 0) account.made = std::max(account.made, most / account.stake);
      account.updates = now.contact_updates / account.stake;
      account.given = now.made_by_updates / account.stake;
    }
    return account;
  }

 private:
  using Vec = voussoir::Vec<Dim>;

  [[nodiscard]] double between(double low, double high) {
    return low + (high - low) * random_.uniform();
  }

  [[nodiscard]] Run make(voussoir::DynamicsSettings settings, bool given) {
    const double normal = std::pow(10.0, between(9, 10));
    const double shear = normal * between(0.1, 1);
    const voussoir::CoulombJoint joint({normal, shear, between(0, 45) * degree});
    const double viscous = std::max(0.0, between(-0.5, 1));
    const double local = std::max(0.0, between(-1.6, 0.8));
    if (!given) {
      settings.viscous_damping = viscous;
      settings.local_damping = local;
    }
    return Run(joint, settings);
  }

  /// A box with its middle at `centre`, at least 0.4 and at most 1 m long, perhaps cut.
  [[nodiscard]] auto block(const Vec& centre) {
    Vec size;
    for (int k = 0; k < Dim; ++k) size[k] = between(0.4, 1);
    voussoir::Spin<Dim> turn;
    for (int k = 0; k < turn.size(); ++k) turn[k] = between(-3, 3);
    auto shape = [&] {
      if constexpr (Dim == 2)
        return rectangle(centre, size[0], size[1], turn[0]);
      else
        return brick(centre, size, voussoir::rotation_by(turn));
    }();
    const int cuts = static_cast<int>(random_.below(2)) * static_cast<int>(random_.below(5));
    for (int k = 0; k < cuts; ++k) {
      Vec normal;
      for (int i = 0; i < Dim; ++i) normal[i] = random_.normal();
      normal /= normal.norm();
      const double offset = normal.dot(centre) + between(0.15, 0.35);
      if (auto parts = shape.split({normal, offset}, 0, 1e-9)) shape = std::move(parts->first);
    }
    return shape;
  }

  void wall(const Vec& centre, const Vec& size) {
    if constexpr (Dim == 2)
      run_.add_fixed_block(rectangle(centre, size[0], size[1]));
    else
      run_.add_fixed_block(brick(centre, size));
  }

  void fill(bool many) {
    constexpr double pitch = 1.75;  // a block's diagonal in 3-D is 1.74 at most
    const int wide = !many ? 1 : Dim == 2 ? 6 : 4, layers = !many ? 1 : Dim == 2 ? 8 : 3;
    const double half = many ? 0.5 * pitch * wide : 10, high = 2 * pitch * (layers + 1);
    Vec size = voussoir::all_entries<Dim>(2 * half + 2), centre = voussoir::zeros<Vec>();
    size[Dim - 1] = 1;
    centre[Dim - 1] = -0.5;
    wall(centre, size);
    for (int axis = 0; axis < Dim - 1 && many; ++axis)
      for (const double side : {-1.0, 1.0}) {
        Vec middle = voussoir::zeros<Vec>(), of_wall = voussoir::all_entries<Dim>(2 * half + 2);
        middle[axis] = side * (half + 0.5);
        middle[Dim - 1] = 0.5 * high;
        of_wall[axis] = 1;
        of_wall[Dim - 1] = high;
        wall(middle, of_wall);
      }
    const double gap = std::pow(10.0, between(-3, 0));
    const bool thrown = random_.below(2) == 1;
    const int per_layer = Dim == 2 ? wide : wide * wide;
    for (int k = 0; k < layers * per_layer; ++k) {
      Vec place = voussoir::zeros<Vec>();
      const int cell = k % per_layer;
      place[0] = (cell % wide - 0.5 * (wide - 1)) * pitch;
      if constexpr (Dim == 3) place[1] = (cell / wide - 0.5 * (wide - 1)) * pitch;
      place[Dim - 1] = (k / per_layer + 0.5) * pitch;
      auto shape = block(place);
      double lowest = place[Dim - 1];
      for (const auto& v : shape.vertices()) lowest = std::min(lowest, v[Dim - 1]);
      if (!many) {  // the one block is let go `gap` above the floor
        std::vector<Vec> corners;
        shape.move_vertices([&](Vec v) {
          v[Dim - 1] += gap - lowest;
          return v;
        });
      }
      const int b = run_.add_block(shape, 2700);
      if (!thrown) continue;
      Vec velocity;
      voussoir::Spin<Dim> spin;
      for (int i = 0; i < Dim; ++i) velocity[i] = between(-2, 2);
      for (int i = 0; i < spin.size(); ++i) spin[i] = between(-2, 2);
      run_.set_velocity(b, velocity, spin);
    }
  }

  voussoir::Random random_;
  Run run_;
  double kinetic_ = 0;
};

}  // namespace voussoir_test
