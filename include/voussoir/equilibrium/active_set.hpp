// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/core/invariants.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/linear/tangent_solver.hpp>
#include <voussoir/model/system.hpp>

namespace voussoir {

/// The bodies that are not yet in equilibrium, their neighbours, and all elements that touch them.
///
/// After an elastic solve only blocks near slip and openings are out of balance. Relaxing those
/// alone, everything else fixed, gives the same equilibrium for a fraction of the work; the
/// certification afterwards is always on the whole system.
template <class System>
class ActiveSet {
 public:
  static constexpr int dim = System::dim;
  static constexpr int dof = System::dof;

  /// @param f          out-of-balance forces of the whole system
  /// @param elsewhere  what of them an elastic solve has left and the next will take
  /// @param threshold  a body is active if its out-of-balance force ratio exceeds this
  /// @param rings      how many generations of neighbours to add
  ActiveSet(System& system, const Eigen::VectorXd& f, const Eigen::VectorXd& elsewhere,
            double threshold, int rings)
      : system_(&system),
        active_(static_cast<std::size_t>(system.body_count()), 0),
        number_(active_.size(), -1) {
    VOUSSOIR_ASSERT(f.size() == dof * static_cast<Eigen::Index>(system.body_count()),
                    "forces are those of all bodies");
    VOUSSOIR_ASSERT(threshold >= 0 && rings >= 0, "who is out of balance can be told");
    scale_ = system.weight_scale();
    Eigen::VectorXd own;
    set_to_sum(own, f, -1, elsewhere);
    for (int b = 0; b < system.body_count(); ++b)
      active_[static_cast<std::size_t>(b)] = system.unbalance_of(own, b, scale_) > threshold;
    for (int ring = 0; ring < rings; ++ring) grow();
    for (int b = 0; b < system.body_count(); ++b)
      if (active(b) && system.body(b).movable) {
        number_[static_cast<std::size_t>(b)] = static_cast<int>(bodies_.size());
        bodies_.push_back(b);
      }
    collect(system.joints.contacts(), joints_);
    collect(system.boundary.contacts(), boundary_);
    collect(system.interface.contacts(), interface_);
    VOUSSOIR_ASSERT(detail::never_descends(bodies_), "active bodies are in their order");
  }

  [[nodiscard]] const std::vector<int>& bodies() const { return bodies_; }

  /// Out-of-balance forces on the active bodies at displacement `u`; the entries of other bodies
  /// are left without meaning.
  template <class History = Frozen>
  void forces(const Eigen::VectorXd& u, Eigen::VectorXd& f) {
    VOUSSOIR_ASSERT(u.size() == f.size(), "a force for every displacement");
    for (const int b : bodies_) set_part<dof>(f, dof * b, system_->load_on(b));
    system_->joints.template add_forces<History>(joints_, u.data(), f.data());
    system_->boundary.template add_forces<History>(boundary_, u.data(), f.data());
    system_->interface.template add_forces<History>(interface_, u.data(), f.data());
    system_->template add_support_forces<History>(u.data(), f.data(), &active_);
  }

  /// Largest out-of-balance force ratio of an active body.
  [[nodiscard]] double worst_unbalance(const Eigen::VectorXd& f) const {
    double worst = 0;
    for (const int b : bodies_) worst = std::max(worst, system_->unbalance_of(f, b, scale_));
    return worst;
  }
  /// Sum of the squared out-of-balance force ratios: what the Newton steps bring down.
  [[nodiscard]] double squared_unbalance(const Eigen::VectorXd& f) const {
    double sum = 0;
    for (const int b : bodies_) {
      const double one = system_->unbalance_of(f, b, scale_);
      sum += one * one;
    }
    return sum;
  }
  /// Largest translation of an active block [m].
  [[nodiscard]] double largest_translation(const Eigen::VectorXd& u) const {
    double squared = 0;
    for (const int b : bodies_)
      if (system_->body(b).is_block)
        squared = std::max(squared, part<dim>(u, dof * b).squaredNorm());
    return std::sqrt(squared);
  }

  /// Solves (tangent + anchor) du = f on the active bodies, all others fixed.
  ///
  /// @param reach  every body is anchored by a spring that yields its weight at this displacement
  ///               of its own [m]: nothing beside a joint's stiffness, but it keeps a block that
  ///               nothing else holds from going to infinity in one step
  /// @param progress  asked now and then whether to go on
  /// @return  the step, in the order of `bodies`; may be not finite where the tangent is singular
  /// @throws Stopped
  [[nodiscard]] Eigen::VectorXd newton_step(const Eigen::VectorXd& u, const Eigen::VectorXd& f,
                                            const Eigen::VectorXd& reach,
                                            const Progress& progress = {}) const {
    using Block = typename TangentMatrix<dof>::Block;
    TangentMatrix<dof> matrix;
    for (const int b : bodies_) {
      const auto& body = system_->body(b);
      const double spring = (body.weight > 0 ? body.weight : scale_.weight) / reach[b];
      VOUSSOIR_ASSERT(spring > 0 && std::isfinite(spring), "an anchor holds a body");
      Block anchor = diagonal_of<dof>(spring);
      for (int k = dim; k < dof; ++k) anchor(k, k) *= body.gyration * body.gyration;
      matrix.diagonal.push_back(anchor);
    }
    std::vector<std::pair<int, int>> places;  // (j, i) of couplings, i > j
    std::vector<Block> forward, backward;     // (i, j) and (j, i)
    const std::size_t couplings = joints_.size() + interface_.size();
    places.reserve(couplings);
    forward.reserve(couplings);
    backward.reserve(couplings);
    const auto sink = [&](int a, int b, const Block& aa, const Block& ab, const Block& ba,
                          const Block& bb) {
      const int i = number_[static_cast<std::size_t>(a)], j = number_[static_cast<std::size_t>(b)];
      if (i >= 0) matrix.diagonal[static_cast<std::size_t>(i)] += aa;
      if (j >= 0) matrix.diagonal[static_cast<std::size_t>(j)] += bb;
      if (i < 0 || j < 0) return;
      VOUSSOIR_ASSERT(i != j, "a coupling is of two bodies");
      places.emplace_back(std::minmax(i, j));
      forward.push_back(i > j ? ab : ba);
      backward.push_back(i > j ? ba : ab);
    };
    system_->joints.add_tangent(joints_, u.data(), sink);
    system_->boundary.add_tangent(boundary_, u.data(), sink);
    system_->interface.add_tangent(interface_, u.data(), sink);
    for (const auto& support : system_->supports) support->add_tangent(u.data(), &active_, sink);
    for (const int number : order_of_pairs(places, static_cast<int>(bodies_.size()))) {
      const auto k = static_cast<std::size_t>(number);
      const std::pair<int, int> pair(places[k].second, places[k].first);
      if (matrix.pairs.empty() || matrix.pairs.back() != pair) {
        matrix.pairs.push_back(pair);
        matrix.forward.push_back(forward[k]);
        matrix.backward.push_back(backward[k]);
      } else {
        matrix.forward.back() += forward[k];
        matrix.backward.back() += backward[k];
      }
    }
    VOUSSOIR_ASSERT(matrix.diagonal.size() == bodies_.size(), "an active body has its block");
    Eigen::VectorXd step(dof * static_cast<Eigen::Index>(bodies_.size()));
    for (std::size_t k = 0; k < bodies_.size(); ++k)
      set_part<dof>(step, dof * static_cast<Eigen::Index>(k), part<dof>(f, dof * bodies_[k]));
    solve_tangent(matrix, step, progress);
    return step;
  }

 private:
  [[nodiscard]] bool active(int b) const { return is_marked(active_, b); }

  void grow() {
    BodyMarks wider = active_;
    const auto spread = [&](int a, int b) {
      if (active(a)) wider[static_cast<std::size_t>(b)] = 1;
      if (active(b)) wider[static_cast<std::size_t>(a)] = 1;
    };
    for (const auto& c : system_->joints.contacts()) spread(c.a, c.b);
    for (const auto& c : system_->interface.contacts()) spread(c.a, c.b);
    for (const auto& support : system_->supports)
      for (const auto& [a, b] : support->links()) spread(a, b);
    active_ = std::move(wider);
  }

  template <class Contacts>
  void collect(const Contacts& contacts, std::vector<int>& which) const {
    for (std::size_t k = 0; k < contacts.size(); ++k)
      if (active(contacts[k].a) || active(contacts[k].b)) which.push_back(static_cast<int>(k));
  }

  System* system_;
  typename System::WeightScale scale_{};
  BodyMarks active_;
  std::vector<int> number_;  ///< among the active bodies, -1: fixed
  std::vector<int> bodies_, joints_, boundary_, interface_;
};

}  // namespace voussoir
