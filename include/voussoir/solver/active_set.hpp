// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <voussoir/solver/system.hpp>

namespace voussoir {

/// The bodies that are not yet in equilibrium, their neighbours, and all elements that touch them.
///
/// After an elastic solve only blocks near slip and openings are out of balance. Relaxing those
/// alone, everything else held, gives the same equilibrium for a fraction of the work; the
/// certification afterwards is always on the whole system.
template <class System>
class ActiveSet {
 public:
  static constexpr int dim = System::dim;
  static constexpr int dof = System::dof;

  /// @param f          out-of-balance forces of the whole system
  /// @param threshold  a body is active if its unbalance over its weight exceeds this
  /// @param rings      how many generations of neighbours to add
  ActiveSet(System& system, const Eigen::VectorXd& f, double threshold, int rings)
      : system_(&system), active_(static_cast<std::size_t>(system.body_count()), 0) {
    const double lightest = system.lightest_weight();
    for (int b = 0; b < system.body_count(); ++b)
      active_[static_cast<std::size_t>(b)] = system.unbalance_of(f, b, lightest) > threshold;
    for (int ring = 0; ring < rings; ++ring) grow();
    for (int b = 0; b < system.body_count(); ++b)
      if (active(b) && system.body(b).movable) bodies_.push_back(b);
    collect(system.joints.contacts(), joints_);
    collect(system.boundary.contacts(), boundary_);
    collect(system.interface.contacts(), interface_);
    for (std::size_t k = 0; k < system.bolts.size(); ++k)
      if (active(system.bolts[k].a) || active(system.bolts[k].b)) bolts_.push_back(k);
    for (std::size_t k = 0; k < system.frames.size(); ++k)
      if (active(system.frames[k].i) || active(system.frames[k].j)) frames_.push_back(k);
  }

  [[nodiscard]] const std::vector<int>& bodies() const { return bodies_; }

  /// Out-of-balance forces on the active bodies at displacement `u`, history frozen; the entries of
  /// other bodies are left without meaning.
  void forces(const Eigen::VectorXd& u, Eigen::VectorXd& f) {
    for (const int b : bodies_)
      f.segment<dof>(dof * b) = system_->load.template segment<dof>(dof * b) +
                                system_->wall_fraction *
                                    system_->wall_load.template segment<dof>(dof * b);
    system_->joints.add_forces(joints_, u.data(), f.data());
    system_->boundary.add_forces(boundary_, u.data(), f.data());
    system_->interface.add_forces(interface_, u.data(), f.data());
    for (const std::size_t k : bolts_) {
      const auto& bolt = system_->bolts[k];
      bolt.add_force(system_->bolt_laws[static_cast<std::size_t>(bolt.law)], u.data(), f.data());
    }
    for (const std::size_t k : frames_) system_->frames[k].add_force(u.data(), f.data());
  }

 private:
  [[nodiscard]] bool active(int b) const { return active_[static_cast<std::size_t>(b)] != 0; }

  void grow() {
    std::vector<char> wider = active_;
    const auto spread = [&](int a, int b) {
      if (active(a)) wider[static_cast<std::size_t>(b)] = 1;
      if (active(b)) wider[static_cast<std::size_t>(a)] = 1;
    };
    for (const auto& c : system_->joints.contacts()) spread(c.a, c.b);
    for (const auto& c : system_->interface.contacts()) spread(c.a, c.b);
    for (const auto& e : system_->frames) spread(e.i, e.j);
    active_ = std::move(wider);
  }

  template <class Contacts>
  void collect(const Contacts& contacts, std::vector<int>& which) const {
    for (std::size_t k = 0; k < contacts.size(); ++k)
      if (active(contacts[k].a) || active(contacts[k].b)) which.push_back(static_cast<int>(k));
  }

  System* system_;
  std::vector<char> active_;
  std::vector<int> bodies_, joints_, boundary_, interface_;
  std::vector<std::size_t> bolts_, frames_;
};

}  // namespace voussoir
