// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/detail/contact_springs.hpp>
#include <voussoir/model/moving_body.hpp>

namespace voussoir::detail {

/// How stiffly every body is held by its contacts, all others fixed, these closed and sticking:
/// bounds on the largest eigenvalues of M^-1 K and, of the dashpots, M^-1 C, the largest sum of a
/// row. Kept until the contacts or the mass of a body change.
template <int Dim>
class BodyRates {
 public:
  static constexpr int dof = Dim + spin_count<Dim>;

  void resize(std::size_t bodies) {
    is_stale_.resize(bodies, 1);
    stiffness_.resize(bodies, 0);
    damping_.resize(bodies, 0);
  }
  void forget(int body) { is_stale_[static_cast<std::size_t>(body)] = 1; }
  void forget() { std::fill(is_stale_.begin(), is_stale_.end(), char{1}); }

  /// @param add_contacts  add_contacts(body, stiffness, damping): those of all its contacts
  template <class AddContacts>
  void update(const std::vector<MovingBody<Dim>>& bodies, AddContacts&& add_contacts) {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!is_stale_[b]) continue;
      is_stale_[b] = 0;
      Fixed<dof, dof> stiffness = zeros<Fixed<dof, dof>>(), damping = stiffness;
      if (bodies[b].movable()) add_contacts(b, stiffness, damping);
      stiffness_[b] = largest_row(stiffness);
      damping_[b] = largest_row(damping);
    }
  }
  [[nodiscard]] const std::vector<double>& stiffness() const { return stiffness_; }  ///< [1/s^2]
  [[nodiscard]] const std::vector<double>& damping() const { return damping_; }      ///< [1/s]

 private:
  std::vector<char> is_stale_;
  std::vector<double> stiffness_, damping_;
};

}  // namespace voussoir::detail
