// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>

namespace voussoir {

/// Fictitious masses of this share of the Gershgorin row sums of the stiffness make the critical
/// step 1 for every unknown: omega^2 <= row sum / mass = 4, and the critical step is 2 / omega. No
/// parameter: it follows.
inline constexpr double critical_mass_share = 0.25;

/// Fast inertial relaxation engine: fictitious dynamics that stops whenever it would run uphill.
///
/// Masses are fictitious: a quarter of the Gershgorin row sums, so the critical step is 1 for every
/// unknown alike, blocks, lining nodes and rotations.
///
/// Source: Bitzek et al. (2006), Structural relaxation made simple, Phys. Rev. Lett. 97, 170201.
class Fire {
 public:
  struct Params {
    double largest_step = 0.8;  ///< in critical steps; 0.95 and mixing 0.2 need 10 times the work
    double first_step = 0.4;
    double mixing = 0.1;
    int patience = 5;  ///< downhill steps before the time step grows
    // As published:
    double step_growth = 1.1;    ///< [-], >= 1
    double step_cut = 0.5;       ///< where it would run uphill [-], > 0 and < 1
    double mixing_decay = 0.99;  ///< [-], > 0 and <= 1

    /// @throws InvalidInput  a value out of range
    void check() const {
      require(largest_step > 0 && largest_step < 1, "largest_step", largest_step, "> 0 and < 1");
      require(first_step > 0 && first_step <= largest_step, "first_step", first_step,
              "> 0 and <= largest_step");
      require(mixing >= 0 && mixing <= 1, "mixing", mixing, "0 to 1");
      require(patience >= 0, "patience", patience, ">= 0");
      require(step_growth >= 1, "step_growth", step_growth, ">= 1");
      require(step_cut > 0 && step_cut < 1, "step_cut", step_cut, "> 0 and < 1");
      require(mixing_decay > 0 && mixing_decay <= 1, "mixing_decay", mixing_decay, "> 0 and <= 1");
    }
  };

  /// @param row_sums  Gershgorin row sums of the stiffness, > 0
  Fire(const Eigen::VectorXd& row_sums, const Params& params)
      : params_(params), inverse_mass_(inverses(row_sums, 1 / critical_mass_share)) {
    rest();
  }

  /// Forgets all momentum.
  void rest() {
    velocity_ = zeros(inverse_mass_.size());
    step_ = params_.first_step;
    mixing_ = params_.mixing;
    downhill_ = 0;
  }

  /// Moves these bodies, `Dof` values each, one step under the forces `f` that act on them.
  template <int Dof>
  void advance(const std::vector<int>& bodies, const Eigen::VectorXd& f, Eigen::VectorXd& u) {
    VOUSSOIR_ASSERT(f.size() == velocity_.size() && u.size() == velocity_.size(),
                    "every unknown has a mass");
    double power = 0, speed = 0, force = 0;
    for (const int b : bodies)
      for (int k = Dof * b; k < Dof * (b + 1); ++k) {
        power += f[k] * velocity_[k];
        speed += velocity_[k] * velocity_[k] / inverse_mass_[k];
        force += f[k] * f[k] * inverse_mass_[k];
      }
    double keep = 1 - mixing_, turn = force > 0 ? mixing_ * std::sqrt(speed / force) : 0.0;
    if (power > 0) {
      if (++downhill_ > params_.patience) {
        step_ = std::min(params_.step_growth * step_, params_.largest_step);
        mixing_ *= params_.mixing_decay;
      }
    } else {
      keep = turn = 0;
      downhill_ = 0;
      if (speed > 0) step_ *= params_.step_cut;
      mixing_ = params_.mixing;
    }
    VOUSSOIR_ASSERT(step_ <= params_.largest_step && mixing_ <= params_.mixing,
                    "steps stay stable");
    const double push = turn + step_;
    for (const int b : bodies)
      for (int k = Dof * b; k < Dof * (b + 1); ++k) {
        velocity_[k] = keep * velocity_[k] + push * inverse_mass_[k] * f[k];
        u[k] += step_ * velocity_[k];
      }
  }

 private:
  Params params_;
  Eigen::VectorXd inverse_mass_, velocity_;
  double step_ = 0, mixing_ = 0;
  int downhill_ = 0;
};

}  // namespace voussoir
