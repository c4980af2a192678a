// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/lining/frame_element.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir {

/// The members of a lining whose nodes are bodies of a run: elastic, strained by the change of
/// their chord and the turns of their nodes against it, however far the lining as a whole moves.
///
/// Nodes do not lie turned when they are added (see `MovingBodies::add_node`).
template <class Geometry>
class MovingLining : public Support<Geometry::dim> {
  static constexpr int dim = Geometry::dim, dof = Geometry::dof;

 public:
  using Element = FrameElement<Geometry>;
  using Bodies = typename Support<dim>::Bodies;

  /// @param members  between bodies of the run, free of force where these are now
  /// @param first    body that is the first node;  @param count  of nodes
  MovingLining(std::vector<Element> members, int first, int count)
      : members_(std::move(members)), first_(first), count_(count) {}

  [[nodiscard]] const std::vector<Element>& members() const { return members_; }
  [[nodiscard]] int first_node() const { return first_; }
  [[nodiscard]] int node_count() const { return count_; }

  [[nodiscard]] std::vector<int> bodies() const override {
    std::vector<int> held(static_cast<std::size_t>(count_));
    for (int k = 0; k < count_; ++k) held[static_cast<std::size_t>(k)] = first_ + k;
    return held;
  }

  void act(const Bodies& bodies, std::vector<Load<dim>>& loads) override {
    for (const Element& m : members_) {
      const auto push = m.push(pose(bodies, m.i), pose(bodies, m.j));
      for (const int end : {0, 1}) {
        Load<dim>& load = loads[index(end == 0 ? m.i : m.j)];
        load.force += part<dim>(push, dof * end);
        load.moment += part<dof - dim>(push, dof * end + dim);
      }
    }
  }

  [[nodiscard]] double energy(const Bodies& bodies) const override {
    double sum = 0;
    for (const Element& m : members_) sum += m.energy(pose(bodies, m.i), pose(bodies, m.j));
    return sum;
  }

  void add_stiffness_over_mass(const Bodies& bodies, std::vector<double>& sums) const override {
    for (const Element& m : members_)
      for (const int end : {0, 1}) {
        const std::size_t b = index(end == 0 ? m.i : m.j);
        if (!bodies[b].movable()) continue;
        const double by_mass = 1 / std::sqrt(bodies[b].mass);
        const double by_inertia = 1 / std::sqrt(smallest_entry(bodies[b].inertia));
        const auto root = [&](int k) { return k < dim ? by_mass : by_inertia; };
        double largest = 0;
        for (int r = 0; r < dof; ++r) {
          double sum = 0;
          for (int c = 0; c < dof; ++c)
            sum += std::abs(root(r) * m.local(dof * end + r, dof * end + c) * root(c));
          largest = std::max(largest, sum);
        }
        sums[b] += largest;
      }
  }

 private:
  [[nodiscard]] static std::size_t index(int b) { return static_cast<std::size_t>(b); }
  [[nodiscard]] static const Pose<dim>& pose(const Bodies& bodies, int b) {
    return bodies[index(b)].pose;
  }

  std::vector<Element> members_;
  int first_, count_;
};

}  // namespace voussoir
