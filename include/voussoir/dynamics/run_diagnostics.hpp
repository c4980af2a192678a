// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/core/message_number.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/dynamics/energy_balance.hpp>
#include <voussoir/model/moving_bodies.hpp>
#include <voussoir/model/point_loads.hpp>

namespace voussoir::detail {

/// What is wrong with a dynamic run, in words that name the block, the place, the likely cause and
/// the remedy; nothing if it is sound.
template <int Dim>
class RunDiagnostics {
 public:
  using Bodies = std::vector<MovingBody<Dim>>;

  RunDiagnostics(const Bodies& bodies, const std::vector<BodyRole>& roles, const Vec<Dim>& origin,
                 double speed_limit, bool speed_is_given, double overlap_limit)
      : bodies_(bodies),
        roles_(roles),
        origin_(origin),
        speed_limit_(speed_limit),
        speed_is_given_(speed_is_given),
        overlap_limit_(overlap_limit) {}

  /// @param energy  so far;  @param given  to the bodies as velocity [J]
  /// @param unnoticed  energy that is nothing here [J]
  template <class Network>
  [[nodiscard]] std::string fault(const Network& network, const EnergyBalance& energy, double given,
                                  double unnoticed, double step) const {
    std::size_t fastest = 0;
    double highest = -1;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const MovingBody<Dim>& body = bodies_[b];
      if (!body.movable()) continue;
      const double speed = body.velocity.norm() + body.spin().norm() * body.radius;
      if (!std::isfinite(speed + body.pose.position.sum()))
        return "position or velocity of block " + std::to_string(b) +
               " is not a number; a load or velocity given is not, or a law of contact or bolt "
               "returned none";
      if (!(speed > highest)) continue;
      highest = speed;
      fastest = b;
    }
    const double made = energy.above_start(), stake = std::max(energy.scale(), given);
    if (made > made_limit * stake + unnoticed)
      return "the run has made " + message_number(made, 3) +
             " J that nothing has brought (what gravity, loads and springs have done: " +
             message_number(stake, 3) + " J), and " + name_of(fastest) + " moves at " +
             message_number(highest, 3) + " m/s; the step of " + message_number(step, 3) +
             " s is too long for its springs, or a law of contact or bolt is stiffer than it says: "
             "lower the safety factor";
    if (highest > speed_limit_)
      return name_of(fastest) + " moves at " + message_number(highest, 3) +
             " m/s, faster than anything here falls or was thrown at first (" +
             (speed_is_given_ ? "speed_limit " : "at most ") + message_number(speed_limit_, 3) +
             " m/s), and the energy balances; it was given this velocity, hit by what is much "
             "heavier, or is a splinter that a load drives: " +
             (speed_is_given_ ? "raise speed_limit if it is meant to"
                              : "drop pieces of its size (smallest_piece), or hold it");
    return overlap(network);
  }

 private:
  /// A block that lies in another.
  template <class Network>
  [[nodiscard]] std::string overlap(const Network& network) const {
    std::string text;
    network.each([&](const auto& group, const auto& c) {
      if (!text.empty()) return;
      const auto ia = static_cast<std::size_t>(c.a), ib = static_cast<std::size_t>(c.b);
      const MovingBody<Dim>&a = bodies_[ia], &b = bodies_[ib];
      const double size = a.movable() && b.movable() ? std::min(a.radius, b.radius)
                          : a.movable()              ? a.radius
                                                     : b.radius;
      const auto at = c.place(a.pose, b.pose);
      if (c.first == c.last) return;
      const auto points = group.points_of(c);
      const double overlap =
          c.uncounted + detail::deepest<Dim>(c, points.data(), points.size(), at);
      if (overlap > overlap_limit_ * size)
        text = name_of(ib) + " overlaps " + name_of(ia) + " by " +
               message_number(1e3 * overlap, 3) + " mm, more than " +
               message_number(100 * overlap_limit_, 3) + " % of its radius of " +
               message_number(size, 3) +
               " m; the joint is too soft for what presses on it or strikes it (raise "
               "joint_normal_stiffness), or the blocks overlapped from the beginning";
    });
    return text;
  }

  [[nodiscard]] std::string name_of(std::size_t b) const {
    const std::string what = roles_[b] == BodyRole::lining ? "lining node "
                             : bodies_[b].movable()        ? "block "
                                                           : "fixed block ";
    return what + std::to_string(b) + " at " + text_of<Dim>(bodies_[b].pose.position + origin_) +
           " m";
  }

  static constexpr double made_limit = 0.1;

  const Bodies& bodies_;
  const std::vector<BodyRole>& roles_;
  Vec<Dim> origin_;
  double speed_limit_;
  bool speed_is_given_;  ///< else it was computed: nobody could raise it
  double overlap_limit_;
};

}  // namespace voussoir::detail
