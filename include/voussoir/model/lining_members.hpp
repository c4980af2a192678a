// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/lining/frame_element.hpp>
#include <voussoir/model/support.hpp>
#ifdef VOUSSOIR_COMPILED
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#endif

namespace voussoir {

/// Members between bodies, of a lining or from one lining to another: elastic, strained by the
/// change of their chord and the turns of their nodes against it, however far they move as a whole.
///
/// Nodes do not lie turned when members between them are added, but for `FrameElement::install_at`.
template <class Derived, class Geometry>
class FrameMembers : public SupportModel<Derived, Geometry::dim> {
 protected:
  static constexpr int dim = Geometry::dim, dof = Geometry::dof;
  using Base = Support<dim>;

 public:
  using Element = FrameElement<Geometry>;
  using typename Base::Block;
  using typename Base::Bodies;
  using typename Base::Poses;
  using typename Base::StiffnessSink;

  /// @param members  between bodies, free of force where these are now
  explicit FrameMembers(std::vector<Element> members) : members_(std::move(members)) {}

  [[nodiscard]] const std::vector<Element>& members() const { return members_; }

  /// See `FrameElement::stiffen`.
  /// @param pose_of  pose_of(body), now;  @param u  displacement of all bodies
  template <class PoseOf>
  void stiffen(double factor, PoseOf&& pose_of, const double* u) {
    for (Element& m : members_) m.stiffen(factor, pose_of(m.i), pose_of(m.j), u);
  }

  [[nodiscard]] std::vector<int> bodies() const override {
    std::vector<int> held;
    for (const Element& m : members_) {
      held.push_back(m.i);
      held.push_back(m.j);
    }
    std::sort(held.begin(), held.end());
    held.erase(std::unique(held.begin(), held.end()), held.end());
    return held;
  }
  [[nodiscard]] std::vector<std::pair<int, int>> links() const override {
    std::vector<std::pair<int, int>> pairs;
    for (const Element& m : members_) pairs.emplace_back(m.i, m.j);
    return pairs;
  }
  void remove(const BodyMarks& gone) override {
    std::erase_if(members_,
                  [&](const Element& m) { return is_marked(gone, m.i) || is_marked(gone, m.j); });
  }
  void sever(const std::function<bool(int a, int b)>& is_parted) override {
    std::erase_if(members_, [&](const Element& m) { return is_parted(m.i, m.j); });
  }

  void take_over(const Heirs<dim>& heirs) override {
    const auto number = [&](int b) { return heirs(b, zeros<Vec<dim>>()).body; };
    for (Element& m : members_) {
      m.i = number(m.i);
      m.j = number(m.j);
    }
  }

  void add_forces(const double* u, double* f, const BodyMarks* chosen) const override {
    for (const Element& m : members_)
      if (is_chosen(m, chosen)) m.add_force(u, f);
  }
  void add_stiffness(const StiffnessSink& sink) const override {
    add_tangent(nullptr, nullptr, sink);
  }
  void add_tangent(const double*, const BodyMarks* chosen,
                   const StiffnessSink& sink) const override {
    for (const Element& m : members_)
      if (is_chosen(m, chosen))
        m.add_stiffness([&](int i, int j, const Block& ii, const Block& ij, const Block& jj) {
          sink(i, j, ii, ij, transposed(ij), jj);
        });
  }
  /// What strains a member is told by the poses of its nodes.
  void to_frames(const Poses&, const double*) override {}
  void from_frames(const Poses& frames, const double* u) override {
    for (Element& m : members_) m.follow(frames[index(m.i)], frames[index(m.j)], u);
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
        if (bodies[b].movable()) sums[b] += largest_row(m, end, bodies[b]);
      }
  }

 private:
  [[nodiscard]] static std::size_t index(int b) { return static_cast<std::size_t>(b); }
  [[nodiscard]] static const Pose<dim>& pose(const Bodies& bodies, int b) {
    return bodies[index(b)].pose;
  }
  [[nodiscard]] static bool is_chosen(const Element& m, const BodyMarks* chosen) {
    return chosen == nullptr || is_marked(*chosen, m.i) || is_marked(*chosen, m.j);
  }
  /// Of M^-1/2 K M^-1/2 for one of its ends, by absolute values [1/s^2].
  [[nodiscard]] static double largest_row(const Element& m, int end, const MovingBody<dim>& body) {
    const double by_mass = 1 / std::sqrt(body.mass);
    const double by_inertia = 1 / std::sqrt(smallest_entry(body.inertia));
    const auto root = [&](int k) { return k < dim ? by_mass : by_inertia; };
    double largest = 0;
    for (int r = 0; r < dof; ++r) {
      double sum = 0;
      for (int c = 0; c < dof; ++c)
        sum += std::abs(root(r) * m.local(dof * end + r, dof * end + c) * root(c));
      largest = std::max(largest, sum);
    }
    return largest;
  }

  std::vector<Element> members_;
};

/// The members of a lining, whose nodes are bodies, one after the other.
template <class Geometry>
class LiningMembers : public FrameMembers<LiningMembers<Geometry>, Geometry> {
  using Base = FrameMembers<LiningMembers<Geometry>, Geometry>;

 public:
  using typename Base::Element;

  /// @param members  between its nodes, free of force where these are now
  /// @param first    body that is the first node;  @param count  of nodes
  /// @param centre   see `LiningFrame::centre`
  LiningMembers(std::vector<Element> members, int first, int count,
                const Vec<Geometry::dim>& centre = zeros<Vec<Geometry::dim>>())
      : Base(std::move(members)), first_(first), count_(count), centre_(centre) {}

  [[nodiscard]] int first_node() const { return first_; }
  [[nodiscard]] int node_count() const { return count_; }
  [[nodiscard]] const Vec<Geometry::dim>& centre() const { return centre_; }

  [[nodiscard]] std::vector<int> bodies() const override {
    std::vector<int> held(static_cast<std::size_t>(count_));
    for (int k = 0; k < count_; ++k) held[static_cast<std::size_t>(k)] = first_ + k;
    return held;
  }
  void take_over(const Heirs<Geometry::dim>& heirs) override {
    first_ = heirs(first_, zeros<Vec<Geometry::dim>>()).body;
    Base::take_over(heirs);
  }

 private:
  int first_, count_;
  Vec<Geometry::dim> centre_;
};

/// Members that join the end of a lining to one that stood before: what carries on an arch, a ring
/// or a row of ribs.
template <class Geometry>
class LiningJoints : public FrameMembers<LiningJoints<Geometry>, Geometry> {
  using Base = FrameMembers<LiningJoints<Geometry>, Geometry>;

 public:
  using typename Base::Element;

  /// @param lining  number of the one that came with them, in the order of installation
  LiningJoints(std::vector<Element> members, int lining)
      : Base(std::move(members)), lining_(lining) {}

  [[nodiscard]] int lining() const { return lining_; }

 private:
  int lining_;
};

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class LiningMembers<Planar>;
VOUSSOIR_SPATIAL_TEMPLATE class LiningMembers<Spatial>;
VOUSSOIR_PLANAR_TEMPLATE class LiningJoints<Planar>;
VOUSSOIR_SPATIAL_TEMPLATE class LiningJoints<Spatial>;
#endif

}  // namespace voussoir
