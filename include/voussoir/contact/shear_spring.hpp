// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// What a point remembers of a linear shear spring that slips, in a joint that may open from an
/// edge on and close again.
///
///   T = w tau,  tau = T0 / w - k_s (s - q),  shortened by the law to what its strength allows
///
/// w weight of the point, s slip, q plastic slip. Where the pressed part of the joint gets less, so
/// does w: what has opened takes its shear with it. Where it gets more, from w_c at the last
/// commit, what has closed since then has slipped half of the increment on average:
///
///   T = w_c tau + (w - w_c) (tau - tau_c) / 2
///
/// and at the commit this force is spread over all that is closed. That dissipates energy: on the
/// random paths of tests/model/pressed_part none is made.
template <int Dim>
struct ShearSpring {
  Vec<Dim - 1> plastic_slip = zeros<Vec<Dim - 1>>();  ///< q [m]
  Vec<Dim - 1> shear = zeros<Vec<Dim - 1>>();         ///< T at the last commit [N]
  /// Weight that carried it; infinity: there is no shear that more weight would share [m], [m^2].
  double pressed = std::numeric_limits<double>::infinity();

  /// Part of the weight that carried the shear at the last commit, too.
  [[nodiscard]] double held(const PointLoad<Dim>& load) const {
    return pressed < load.weight ? pressed / load.weight : 1.0;
  }
  /// Of the spring, before the law shortens it [N].
  /// @param initial    T0 [N];  @param stiffness  k_s [Pa/m]
  [[nodiscard]] Vec<Dim - 1> force(const PointLoad<Dim>& load, const Vec<Dim - 1>& initial,
                                   double stiffness) const {
    // Number by number: g++ 12 loads as a pair what was just stored as two, and waits for it.
    const double of_point = stiffness * load.weight;
    Vec<Dim - 1> elastic;
    for (int k = 0; k < Dim - 1; ++k)
      elastic.data()[k] =
          initial.data()[k] - of_point * (load.motion.slip.data()[k] - plastic_slip.data()[k]);
    const double part = held(load);
    if (part == 1) return elastic;
    const double of_closed = 0.5 * (1 - part);
    for (int k = 0; k < Dim - 1; ++k)
      elastic.data()[k] =
          (part + of_closed) * elastic.data()[k] - of_closed / part * shear.data()[k];
    return elastic;
  }
  /// Energy that it holds with a force [J]: T^2 / (2 k_s w).
  [[nodiscard]] static double stored_energy(const PointLoad<Dim>& load, const Vec<Dim - 1>& now,
                                            double stiffness) {
    return 0.5 * now.squaredNorm() / (stiffness * load.weight);
  }
  /// Brings it up to date with the force that the law has made of it.
  /// @return  energy that is lost to slip, and to what has opened and closed: the work done on the
  ///          spring since the last commit less what its stored energy has grown by [J]
  double commit(const PointLoad<Dim>& load, const Vec<Dim - 1>& initial, double stiffness,
                const Vec<Dim - 1>& now) {
    const double part = held(load);
    const bool slips = !(now == force(load, initial, stiffness));
    // Only a point that slips moves its spring: q stays bit for bit where it was otherwise.
    if (!slips && load.weight == pressed) {
      shear = now;
      return 0;
    }
    const double of_point = stiffness * load.weight, then = stiffness * pressed;
    const Vec<Dim - 1> start = initial / of_point;  // slip at which it carries nothing, but for q
    const Vec<Dim - 1> slipped = load.motion.slip - (plastic_slip + start - shear / then);
    const double lost = -0.5 * (shear + now).dot(slipped) -
                        0.5 * (now.squaredNorm() / of_point - shear.squaredNorm() / then);
    if (slips || part < 1) plastic_slip = load.motion.slip + now / of_point - start;
    shear = now;
    // Elastic slip below 1e-12 m is rounding: there is no spring to be spread.
    pressed = now.squaredNorm() < of_point * of_point * 1e-24
                  ? std::numeric_limits<double>::infinity()
                  : load.weight;
    return lost;
  }
};

}  // namespace voussoir
