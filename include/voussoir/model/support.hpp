// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/moving_body.hpp>

namespace voussoir {

/// A force and a moment about the centre of a body, world axes.
template <int Dim>
struct Load {
  Vec<Dim> force = zeros<Vec<Dim>>();     ///< [N]
  Spin<Dim> moment = zeros<Spin<Dim>>();  ///< [N m]
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
  /// What brings its history back to what it is now, where it has one.
  [[nodiscard]] virtual std::function<void()> keep() {
    return [] {};
  }
  /// Adds to every body's number a bound on the largest eigenvalue of M^-1 K [1/s^2], K its own
  /// stiffness with all other bodies fixed.
  virtual void add_stiffness_over_mass(const Bodies& bodies, std::vector<double>& sums) const = 0;
};

/// All supports of a run, and what they do to its bodies.
template <int Dim>
class SupportSet {
 public:
  using Bodies = typename Support<Dim>::Bodies;

  void add(std::shared_ptr<Support<Dim>> support, const Bodies& bodies) {
    at_start_ += support->energy(bodies);
    supports_.push_back(std::move(support));
  }
  /// Computes the loads on all bodies, histories brought up to date.
  void act(const Bodies& bodies) {
    if (supports_.empty()) return;
    loads_.resize(bodies.size());
    for (const auto& support : supports_)
      for (const int b : support->bodies()) loads_[static_cast<std::size_t>(b)] = {};
    for (const auto& support : supports_) support->act(bodies, loads_);
  }
  /// Adds the load on body b, as last computed.
  void add_load_on(std::size_t b, Vec<Dim>& force, Spin<Dim>& moment) const {
    if (b >= loads_.size()) return;
    force += loads_[b].force;
    moment += loads_[b].moment;
  }
  /// Stored, and lost to yield, since each of them was added or `start` was called [J].
  [[nodiscard]] double energy(const Bodies& bodies) const { return sum(bodies) - at_start_; }
  void start(const Bodies& bodies) { at_start_ = sum(bodies); }
  /// What brings all histories back to what they are now.
  [[nodiscard]] std::function<void()> keep() const {
    std::vector<std::function<void()>> kept;
    for (const auto& support : supports_) kept.push_back(support->keep());
    return [kept = std::move(kept)] {
      for (const auto& restore : kept) restore();
    };
  }
  void add_stiffness_over_mass(const Bodies& bodies, std::vector<double>& sums) const {
    for (const auto& support : supports_) support->add_stiffness_over_mass(bodies, sums);
  }

 private:
  [[nodiscard]] double sum(const Bodies& bodies) const {
    double energy = 0;
    for (const auto& support : supports_) energy += support->energy(bodies);
    return energy;
  }

  std::vector<std::shared_ptr<Support<Dim>>> supports_;
  std::vector<Load<Dim>> loads_;
  double at_start_ = 0;
};

}  // namespace voussoir
