// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/farfield/ground_around.hpp>
#include <voussoir/model/small_displacement.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir {

/// A point of the rock on an elastic side of the domain, glued to the ground beyond by a spring
/// that has one stiffness in all directions.
///
/// The arm is in the axes of the reference configuration; in a run, in those of the body's frame.
template <int Dim>
struct EdgeSpring {
  using Nodes = std::array<int, EdgeMesh<Dim>::corners>;

  int rock = 0;  ///< body
  Vec<Dim> arm = zeros<Vec<Dim>>();
  Nodes nodes{};  ///< bodies
  std::array<double, EdgeMesh<Dim>::corners> shares{};
  double stiffness = 0;  ///< [N/m]
  /// Of the ground from the rock besides what displacements (in a run: places) give [m].
  Vec<Dim> offset = zeros<Vec<Dim>>();

  /// value(node) interpolated.
  template <class Value>
  [[nodiscard]] Vec<Dim> of_ground(Value&& value) const {
    Vec<Dim> sum = zeros<Vec<Dim>>();
    for (std::size_t k = 0; k < nodes.size(); ++k) sum += shares[k] * value(nodes[k]);
    return sum;
  }
};

/// The elastic ground around the domain, at rest and in motion: its nodes are bodies, which the
/// rock on the edge is glued to and which the ground beyond holds (`GroundAround`). The in-situ
/// stress is no part of it: on the edge that acts as a load.
template <int Dim>
class ElasticEdge : public SupportModel<ElasticEdge<Dim>, Dim> {
  using Base = Support<Dim>;

 public:
  using typename Base::Block;
  using typename Base::Bodies;
  using typename Base::Poses;
  using typename Base::StiffnessSink;
  using Spring = EdgeSpring<Dim>;
  static constexpr int dof = Base::dof;

  /// @param ground      number of the fixed ground
  /// @param first_node  of the nodes among the bodies, one for every node of the mesh, in its order
  ElasticEdge(std::shared_ptr<const GroundAround<Dim>> around, std::vector<Spring> springs,
              int ground, int first_node)
      : around_(std::move(around)),
        springs_(std::move(springs)),
        ground_(ground),
        first_(first_node),
        offsets_(static_cast<std::size_t>(node_count()), zeros<Vec<Dim>>()) {
    // Much stiffer than the ground, but not so much that rounding or the time step would suffer.
    const Eigen::MatrixXd& k = around_->stiffness();
    double largest = 0;
    for (Eigen::Index i = 0; i < k.rows(); ++i) largest = std::max(largest, k(i, i));
    holding_ = 10 * largest;
    turning_ = largest * cell_length() * cell_length();
    stiffen();
  }

  [[nodiscard]] const GroundAround<Dim>& around() const { return *around_; }
  [[nodiscard]] const std::vector<Spring>& springs() const { return springs_; }
  [[nodiscard]] int first_node() const { return first_; }
  [[nodiscard]] int node_count() const { return around_->mesh().node_count(); }
  /// Of the cells of the mesh [m].
  [[nodiscard]] double cell_length() const {
    const auto& mesh = around_->mesh();
    const auto& cell = mesh.cells().front();
    return (mesh.nodes()[index(cell.back())] - mesh.nodes()[index(cell.front())]).norm();
  }

  [[nodiscard]] std::vector<int> bodies() const override {
    std::vector<int> held(index(node_count()));
    std::iota(held.begin(), held.end(), first_);
    for (const Spring& s : springs_) held.push_back(s.rock);
    std::sort(held.begin(), held.end());
    held.erase(std::unique(held.begin(), held.end()), held.end());
    return held;
  }
  [[nodiscard]] std::vector<std::pair<int, int>> links() const override {
    std::vector<std::pair<int, int>> pairs;
    pairs.reserve(index(node_count()) + springs_.size());
    for (int k = 0; k < node_count(); ++k) pairs.emplace_back(first_ + k, ground_);
    for (const Spring& s : springs_) pairs.emplace_back(s.rock, s.nodes.front());
    return pairs;
  }
  void remove(const BodyMarks& gone) override {
    std::erase_if(springs_, [&](const Spring& s) { return is_marked(gone, s.rock); });
    stiffen();
  }
  /// Rock that an excavation takes away at the edge leaves the ground beyond alone there.
  void take_over(const Heirs<Dim>& heirs) override {
    const auto number = [&](int b) { return heirs(b, zeros<Vec<Dim>>()).body; };
    ground_ = number(ground_);
    first_ = number(first_);
    std::erase_if(springs_, [&](Spring& s) {
      const Heir<Dim> rock = heirs(s.rock, s.arm);
      if (rock.body < 0) return true;
      s.rock = rock.body;
      s.arm = rock.arm;
      for (int& node : s.nodes) node = number(node);
      return false;
    });
    stiffen();
  }

  void add_forces(const double* u, double* f, const BodyMarks* chosen) const override {
    const auto moved = [&](int node) { return vector_at<Dim>(u + dof * node); };
    for (const Spring& s : springs_) {
      if (!is_chosen(s, chosen)) continue;
      const Vec<Dim> apart =
          s.of_ground(moved) - displacement_at<Dim>(u + dof * s.rock, s.arm) + s.offset;
      const Vec<Dim> on_rock = s.stiffness * apart;
      add_force_at<Dim>(f + dof * s.rock, s.arm, on_rock);
      for (std::size_t k = 0; k < s.nodes.size(); ++k)
        add_at<Dim>(f + dof * s.nodes[k], Vec<Dim>(-s.shares[k] * on_rock));
    }
    if (!has_chosen_node(chosen)) return;
    each_push([&](int k) { return Vec<Dim>(moved(first_ + k) + offsets_[index(k)]); },
              [&](int k, const Vec<Dim>& force) { add_at<Dim>(f + dof * (first_ + k), force); });
    for (int k = 0; k < node_count(); ++k)
      for (int turn = Dim; turn < dof; ++turn)
        f[dof * (first_ + k) + turn] -= turning_ * u[dof * (first_ + k) + turn];
  }
  void add_stiffness(const StiffnessSink& sink) const override {
    add_tangent(nullptr, nullptr, sink);
  }
  void add_tangent(const double*, const BodyMarks* chosen,
                   const StiffnessSink& sink) const override {
    const Block none = zeros<Block>();
    for (const Spring& s : springs_) {
      if (!is_chosen(s, chosen)) continue;
      const auto lever = lever_matrix<Dim>(s.arm);
      Block own = s.stiffness * (lever * transposed(lever));
      for (std::size_t k = 0; k < s.nodes.size(); ++k) {
        Block across = zeros<Block>();
        for (int j = 0; j < Dim; ++j)
          for (int i = 0; i < dof; ++i) across(i, j) = -s.stiffness * s.shares[k] * lever(i, j);
        sink(s.rock, s.nodes[k], own, across, transposed(across), none);
        own = none;
      }
    }
    if (!has_chosen_node(chosen)) return;
    for (int k = 0; k < node_count(); ++k)
      for (int l = k + 1; l < node_count(); ++l) {
        const Block across = block(k, l);
        sink(first_ + k, first_ + l, l == k + 1 ? block(k, k) : none, across, transposed(across),
             k + 2 == node_count() ? block(l, l) : none);
      }
  }
  void to_frames(const Poses& frames, const double* u) override {
    const auto place = [&](int node) { return frames[index(node)].position; };
    for (Spring& s : springs_) {
      const Pose<Dim>& rock = frames[index(s.rock)];
      if (u != nullptr)
        s.offset += s.of_ground([&](int node) { return vector_at<Dim>(u + dof * node); }) -
                    displacement_at<Dim>(u + dof * s.rock, s.arm);
      s.offset -= s.of_ground(place) - rock.position - s.arm;
      s.arm = transposed_product(rock.rotation, s.arm);
    }
    for (int k = 0; k < node_count(); ++k) {
      if (u != nullptr) offsets_[index(k)] += vector_at<Dim>(u + dof * (first_ + k));
      offsets_[index(k)] -= place(first_ + k);
    }
  }
  void from_frames(const Poses& frames, const double* u) override {
    const auto place = [&](int node) { return frames[index(node)].position; };
    for (Spring& s : springs_) {
      const Pose<Dim>& rock = frames[index(s.rock)];
      s.arm = rock.rotation * s.arm;
      s.offset += s.of_ground(place) - rock.position - s.arm;
      s.offset -= s.of_ground([&](int node) { return vector_at<Dim>(u + dof * node); }) -
                  displacement_at<Dim>(u + dof * s.rock, s.arm);
    }
    for (int k = 0; k < node_count(); ++k)
      offsets_[index(k)] += place(first_ + k) - vector_at<Dim>(u + dof * (first_ + k));
  }

  void act(const Bodies& bodies, std::vector<Load<Dim>>& loads) override {
    for (const Spring& s : springs_) {
      const Pose<Dim>& rock = bodies[index(s.rock)].pose;
      const Vec<Dim> arm = rock.rotation * s.arm, on_rock = s.stiffness * apart(s, bodies);
      Load<Dim>& load = loads[index(s.rock)];
      load.force += on_rock;
      load.moment += moment_of(arm, on_rock);
      for (std::size_t k = 0; k < s.nodes.size(); ++k)
        loads[index(s.nodes[k])].force -= s.shares[k] * on_rock;
    }
    each_push([&](int k) { return moved(bodies, k); },
              [&](int k, const Vec<Dim>& force) { loads[index(first_ + k)].force += force; });
  }
  [[nodiscard]] double energy(const Bodies& bodies) const override {
    double twice = 0;
    for (const Spring& s : springs_) twice += s.stiffness * apart(s, bodies).squaredNorm();
    each_push([&](int k) { return moved(bodies, k); },
              [&](int k, const Vec<Dim>& force) { twice -= force.dot(moved(bodies, k)); });
    return 0.5 * twice;
  }
  void add_stiffness_over_mass(const Bodies& bodies, std::vector<double>& sums) const override {
    for (const Spring& s : springs_) {
      const auto& rock = bodies[index(s.rock)];
      if (rock.movable())
        sums[index(s.rock)] +=
            s.stiffness * (1 / rock.mass + s.arm.squaredNorm() / smallest_entry(rock.inertia));
    }
    for (int k = 0; k < node_count(); ++k) {
      const auto& node = bodies[index(first_ + k)];
      if (!node.movable()) continue;
      const Block own = block(k, k);
      double largest = 0;
      for (int i = 0; i < Dim; ++i) {
        double row = 0;
        for (int j = 0; j < Dim; ++j) row += std::abs(own(i, j));
        largest = std::max(largest, row);
      }
      sums[index(first_ + k)] += largest / node.mass;
    }
  }

 private:
  template <class T>
  [[nodiscard]] static std::size_t index(T b) {
    return static_cast<std::size_t>(b);
  }
  [[nodiscard]] bool is_chosen(const Spring& s, const BodyMarks* chosen) const {
    return chosen == nullptr || is_marked(*chosen, s.rock) ||
           std::any_of(s.nodes.begin(), s.nodes.end(),
                       [&](int node) { return is_marked(*chosen, node); });
  }
  [[nodiscard]] bool has_chosen_node(const BodyMarks* chosen) const {
    if (chosen == nullptr) return true;
    const auto from = chosen->begin() + first_;
    return std::any_of(from, from + node_count(), [](char mark) { return mark != 0; });
  }
  [[nodiscard]] Vec<Dim> moved(const Bodies& bodies, int k) const {
    return bodies[index(first_ + k)].pose.position + offsets_[index(k)];
  }
  [[nodiscard]] Vec<Dim> apart(const Spring& s, const Bodies& bodies) const {
    return s.of_ground([&](int node) { return bodies[index(node)].pose.position; }) -
           bodies[index(s.rock)].pose(s.arm) + s.offset;
  }
  /// take(k, what the ground beyond does to node k), moved(k) being its displacement.
  template <class Moved, class Take>
  void each_push(Moved&& moved, Take&& take) const {
    const Eigen::MatrixXd& stiffness = around_->stiffness();
    const Eigen::Index size = stiffness.rows();
    Eigen::VectorXd force = Eigen::VectorXd::Zero(size);
    for (int k = 0; k < node_count(); ++k) {
      const Vec<Dim> u = moved(k);
      for (int axis = 0; axis < Dim; ++axis) {
        const Eigen::Index c = Dim * k + axis;
        const double* const column = stiffness.data() + c * size;
        for (Eigen::Index i = 0; i < size; ++i) force[i] -= column[i] * u[axis];
        if (around_->mesh().is_held(k, axis)) force[c] -= holding_ * u[axis];
      }
    }
    for (int k = 0; k < node_count(); ++k) take(k, part<Dim>(force, Dim * k));
  }
  /// Of node k for a displacement of node l, springs included.
  [[nodiscard]] Block block(int k, int l) const {
    Block b = zeros<Block>();
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) b(i, j) = stiffness_(Dim * k + i, Dim * l + j);
    for (int turn = Dim; k == l && turn < dof; ++turn) b(turn, turn) = turning_;
    return b;
  }
  /// Sums the stiffness that its nodes have from the ground beyond and from the springs.
  void stiffen() {
    stiffness_ = around_->stiffness();
    for (int k = 0; k < node_count(); ++k)
      for (int axis = 0; axis < Dim; ++axis)
        if (around_->mesh().is_held(k, axis)) stiffness_(Dim * k + axis, Dim * k + axis) = holding_;
    for (const Spring& s : springs_)
      for (std::size_t k = 0; k < s.nodes.size(); ++k)
        for (std::size_t l = 0; l < s.nodes.size(); ++l)
          for (int axis = 0; axis < Dim; ++axis)
            stiffness_(Dim * (s.nodes[k] - first_) + axis, Dim * (s.nodes[l] - first_) + axis) +=
                s.stiffness * s.shares[k] * s.shares[l];
  }

  std::shared_ptr<const GroundAround<Dim>> around_;
  std::vector<Spring> springs_;
  int ground_, first_;
  /// Displacement of nodes since the in-situ state besides their own (in a run: places) [m].
  std::vector<Vec<Dim>> offsets_;
  double holding_ = 0, turning_ = 0;  ///< of held nodes [N/m], against turning [N m]
  Eigen::MatrixXd stiffness_;
};

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class ElasticEdge<2>;
VOUSSOIR_SPATIAL_TEMPLATE class ElasticEdge<3>;
#endif

}  // namespace voussoir
