// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// What excavated rock exerted on the walls that it has left, round by round, and how much of it
/// still acts.
class WallTractions {
 public:
  /// @param load  on all bodies, all of it acting
  void add(Eigen::VectorXd load) { walls_.push_back({std::move(load), 1}); }
  /// Replaces the loads: load = carry(load), where bodies have other numbers now.
  template <class Carry>
  void carry_over(Carry&& carry) {
    for (Wall& wall : walls_)
      if (wall.fraction > 0) wall.load = carry(wall.load);
  }

  [[nodiscard]] int count() const { return static_cast<int>(walls_.size()); }
  /// Of every round, the part of its traction that acts [-].
  [[nodiscard]] std::vector<double> fractions() const {
    std::vector<double> all;
    for (const Wall& wall : walls_) all.push_back(wall.fraction);
    return all;
  }
  /// The largest of them; 1 before anything is excavated.
  [[nodiscard]] double largest() const {
    double most = walls_.empty() ? 1 : 0;
    for (const Wall& wall : walls_) most = std::max(most, wall.fraction);
    return most;
  }

  /// A stage that brings the walls to other fractions, all at the same pace, as equilibrium methods
  /// go through it: loads held + s * going, s falling from `from` to `to`.
  struct Stage {
    Eigen::VectorXd going, held;  ///< `held` is empty where nothing is
    double from, to;
  };
  /// @param goals  one for every round
  /// @throws InvalidInput  of another number, or above what still acts
  [[nodiscard]] Stage stage_to(const std::vector<double>& goals, Eigen::Index size) {
    require(goals.size() == walls_.size(), "number of wall tractions",
            static_cast<double>(goals.size()), "one for every round that was excavated");
    Stage stage{Eigen::VectorXd(size), {}, largest(), 0};
    std::fill(stage.going.data(), stage.going.data() + size, 0.0);
    for (std::size_t k = 0; k < goals.size(); ++k) {
      require(goals[k] >= 0 && goals[k] <= walls_[k].fraction, "wall traction", goals[k],
              "0 to 1 and no more than was left before");
      stage.to = std::max(stage.to, goals[k]);
    }
    if (walls_.empty()) stage.to = stage.from;
    for (std::size_t k = 0; k < goals.size(); ++k) {
      Wall& wall = walls_[k];
      // Acting: at_zero + slope * s. The walls that lead take s itself, to the last bit.
      if (wall.fraction == stage.from && goals[k] == stage.to) {
        wall.at_zero = 0;
        wall.slope = 1;
      } else {
        wall.slope =
            stage.from == stage.to ? 0 : (wall.fraction - goals[k]) / (stage.from - stage.to);
        wall.at_zero = goals[k] - wall.slope * stage.to;
      }
      if (wall.slope != 0) add_times(wall.slope, wall.load, stage.going);
      if (wall.at_zero == 0) continue;
      if (stage.held.size() == 0) {
        stage.held.resize(size);
        std::fill(stage.held.data(), stage.held.data() + size, 0.0);
      }
      add_times(wall.at_zero, wall.load, stage.held);
    }
    return stage;
  }
  /// Takes note how far the stage has got. What acts no more is forgotten.
  void reach(double s) {
    for (Wall& wall : walls_) {
      wall.fraction = wall.at_zero + wall.slope * s;
      if (wall.fraction <= 0) wall = {{}, 0};
    }
  }

 private:
  struct Wall {
    Eigen::VectorXd load;
    double fraction;
    double at_zero = 0, slope = 0;
  };

  static void add_times(double factor, const Eigen::VectorXd& load, Eigen::VectorXd& sum) {
    for (Eigen::Index i = 0; i < load.size(); ++i) sum[i] += factor * load[i];
  }

  std::vector<Wall> walls_;
};

}  // namespace voussoir
