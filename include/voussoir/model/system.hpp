// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/contact/smooth_wall.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/linear/block_matrix.hpp>
#include <voussoir/linear/elastic_solver.hpp>
#include <voussoir/model/contact_group.hpp>
#include <voussoir/model/detail/law_model.hpp>
#include <voussoir/model/lining_surface.hpp>
#include <voussoir/model/support.hpp>
#include <voussoir/model/system_state.hpp>

namespace voussoir {

/// Everything that moves and every force between: the mechanical state that the equilibrium
/// methods work on. It knows neither shapes nor tunnels.
///
/// Displacements and forces are flat vectors with `dof` values per body: translations, rotations.
/// Rotations are small and the contact topology is that of the reference position.
///
/// A copy is a full snapshot: about 2 kB per block.
/// @tparam DetectorModel  the narrow phase by which contacts are updated
template <class Geometry, class DetectorModel = FaceContacts>
class System : public SystemState<Geometry> {
  using Base = SystemState<Geometry>;

 public:
  using Detector = DetectorModel;
  using Contacts = ContactGroup<Geometry>;
  using Base::dim;
  using Base::displacement;
  using Base::dof;
  using Base::load;
  using Base::patterns;
  using Base::supports;
  using Base::wall_fraction;
  using Base::wall_held;
  using Base::wall_load;
  using Matrix = BlockMatrix<dof>;
  using Law = AnyLaw<dim>;

  /// @param joint_laws          of rock on rock
  /// @param boundary_stiffness  of the edge of the domain, which is smooth [Pa/m]
  /// @param interface_laws      of linings that there are already
  System(std::vector<Law> joint_laws, double boundary_stiffness,
         std::vector<Law> interface_laws = {})
      : joints(std::move(joint_laws)),
        boundary({SmoothWall(boundary_stiffness)}),
        interface(std::move(interface_laws)) {}
  System(const Law& joint_law, double boundary_stiffness)
      : System(std::vector<Law>{joint_law}, boundary_stiffness) {}
  System(const Law& joint_law, double boundary_stiffness, const Law& interface_law)
      : System(std::vector<Law>{joint_law}, boundary_stiffness, {interface_law}) {}

  Contacts joints;     ///< rock on rock
  Contacts boundary;   ///< rock on the fixed edge of the domain
  Contacts interface;  ///< rock on lining

  /// Out-of-balance force at displacement `u`; zero for bodies that cannot move.
  template <class History = Frozen>
  void forces(const Eigen::VectorXd& u, Eigen::VectorXd& f);

  /// Those of the supports alone, on chosen bodies (null: all).
  template <class History>
  void add_support_forces(const double* u, double* f, const BodyMarks* chosen) {
    for (const auto& support : supports) {
      // First: a bolt that breaks here holds nothing any more.
      if constexpr (std::is_same_v<History, Committing>) support->commit(u, chosen);
      support->add_forces(u, f, chosen);
    }
  }

  /// Brings all history up to date with the present displacement.
  /// @return  bolts that broke and contact points that weakened: equilibrium must then be sought
  ///          again
  int commit() {
    int changed = joints.commit(displacement.data()) + boundary.commit(displacement.data()) +
                  interface.commit(displacement.data());
    for (const auto& support : supports) changed += support->commit(displacement.data(), nullptr);
    return changed;
  }

  /// Stiffness with every contact closed and sticking, supports included but for broken bolts.
  /// Bodies that cannot move get a unit diagonal.
  /// @param progress  asked now and then whether to go on
  /// @throws Stopped
  [[nodiscard]] Matrix elastic_stiffness(const Progress& progress = {}) const;

  /// Forces on bodies that can move, where those that cannot are displaced so far: all contacts
  /// closed and sticking, no other body moved.
  [[nodiscard]] Eigen::VectorXd forces_of_displaced(const Eigen::VectorXd& fixed) const;

  /// Solves with that stiffness. @throws FreeBody, NotEnoughMemory, Stopped
  [[nodiscard]] ElasticSolver<dof> elastic_solver(const LinearSettings& settings,
                                                  const Progress& progress = {}) const {
    return ElasticSolver<dof>(elastic_stiffness(progress), this->centres(), settings, progress,
                              patterns);
  }

  /// Takes bodies out for good: their contacts and what supports were to them go, and they stop
  /// moving.
  void remove(const std::vector<int>& gone);

  /// Movable bodies without a chain of contacts and lining members to a body that cannot move: they
  /// fall whatever the forces, alone or as a group that holds nothing but itself. Bolts alone do
  /// not hold: a block could still turn about them. Nor do the upright edges of the domain, which
  /// are smooth.
  [[nodiscard]] std::vector<int> unsupported() const;

  /// Of bodies that nothing holds, those that the edge of the domain has cut, and what they touch
  /// among the others: the rest of them lies outside, whole, and does not let go.
  [[nodiscard]] std::vector<int> cut_by_edge(const std::vector<int>& loose) const;

 private:
  /// sink(a, b, aa, ab, bb) of every contact and support, all closed and sticking.
  template <class Sink>
  void visit_stiffness(const Sink& sink) const {
    joints.add_stiffness(sink);
    boundary.add_stiffness(sink);
    interface.add_stiffness(sink);
    for (const auto& support : supports)
      support->add_stiffness([&](int a, int b, const auto& aa, const auto& ab, const auto&,
                                 const auto& bb) { sink(a, b, aa, ab, bb); });
  }

  using Base::bodies_;
};

template <class Geometry, class DetectorModel>
template <class History>
void System<Geometry, DetectorModel>::forces(const Eigen::VectorXd& u, Eigen::VectorXd& f) {
  set_to_sum(f, load, wall_fraction, wall_load);
  if (wall_held.size() > 0) add_to(f, wall_held);
  joints.template add_forces<History>(u.data(), f.data());
  boundary.template add_forces<History>(u.data(), f.data());
  interface.template add_forces<History>(u.data(), f.data());
  add_support_forces<History>(u.data(), f.data(), nullptr);
  for (int b = 0; b < this->body_count(); ++b)
    if (!this->body(b).movable) set_part<dof>(f, dof * b, zeros<Fixed<dof, 1>>());
}

template <class Geometry, class DetectorModel>
auto System<Geometry, DetectorModel>::elastic_stiffness(const Progress& progress) const -> Matrix {
  StopCheck stop(progress);
  Matrix k(this->body_count());
  visit_stiffness([&](int a, int b, const auto& aa, const auto& ab, const auto& bb) {
    stop();
    const bool a_moves = this->body(a).movable, b_moves = this->body(b).movable;
    if (a_moves) k.add(a, aa);
    if (b_moves) k.add(b, bb);
    if (a_moves && b_moves) k.add(a, b, ab);
  });
  for (int b = 0; b < this->body_count(); ++b)
    if (!this->body(b).movable) k.add(b, diagonal_of<dof>(1));
  k.compress();
  return k;
}

template <class Geometry, class DetectorModel>
Eigen::VectorXd System<Geometry, DetectorModel>::forces_of_displaced(
    const Eigen::VectorXd& fixed) const {
  Eigen::VectorXd f = zeros(fixed.size());
  using Part = Fixed<dof, 1>;
  visit_stiffness([&](int a, int b, const auto&, const auto& ab, const auto&) {
    const bool a_moves = this->body(a).movable, b_moves = this->body(b).movable;
    if (a_moves && !b_moves)
      add_at<dof>(f.data() + dof * a, Part(-(ab * part<dof>(fixed, dof * b))));
    if (b_moves && !a_moves)
      add_at<dof>(f.data() + dof * b, Part(-transposed_product(ab, part<dof>(fixed, dof * a))));
  });
  return f;
}

template <class Geometry, class DetectorModel>
void System<Geometry, DetectorModel>::remove(const std::vector<int>& gone) {
  BodyMarks is_gone(bodies_.size(), 0);
  for (const int b : gone) {
    is_gone[static_cast<std::size_t>(b)] = 1;
    bodies_[static_cast<std::size_t>(b)].movable = false;
    bodies_[static_cast<std::size_t>(b)].is_gone = true;
    set_part<dof>(displacement, dof * b, zeros<Fixed<dof, 1>>());
  }
  const auto test = [&](int b) { return is_marked(is_gone, b); };
  joints.remove(test);
  boundary.remove(test);
  interface.remove(test);
  for (const auto& support : supports) support->remove(is_gone);
}

template <class Geometry, class DetectorModel>
std::vector<int> System<Geometry, DetectorModel>::unsupported() const {
  // Groups as trees: every body points towards the root of its group, that of the ground is
  // `fixed`.
  const std::size_t fixed = bodies_.size();
  std::vector<std::size_t> up(bodies_.size() + 1);
  std::iota(up.begin(), up.end(), std::size_t{0});
  const auto root = [&](std::size_t b) {
    while (up[b] != b) b = up[b] = up[up[b]];
    return b;
  };
  const auto link = [&](int a, int b) {
    up[root(static_cast<std::size_t>(a))] = root(static_cast<std::size_t>(b));
  };
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (!bodies_[b].movable) up[b] = fixed;
  for (const auto& c : joints.contacts()) link(c.a, c.b);
  // Edges of the domain are smooth: a side holds nothing up, what stands on the bottom is held.
  for (const auto& c : boundary.contacts())
    if (std::abs(c.normal[dim - 1]) > 1e-3) link(c.a, c.b);
  for (const auto& c : interface.contacts()) link(c.a, c.b);
  for (const auto& support : supports)
    for (const auto& [a, b] : support->links()) link(a, b);
  std::vector<int> loose;
  for (int b = 0; b < this->body_count(); ++b)
    if (root(static_cast<std::size_t>(b)) != root(fixed)) loose.push_back(b);
  return loose;
}

template <class Geometry, class DetectorModel>
std::vector<int> System<Geometry, DetectorModel>::cut_by_edge(const std::vector<int>& loose) const {
  if (loose.empty()) return {};
  BodyMarks is_loose(bodies_.size(), 0), is_cut(bodies_.size(), 0);
  for (const int b : loose) is_loose[static_cast<std::size_t>(b)] = 1;
  for (const auto& c : boundary.contacts())
    for (const int b : {c.a, c.b})
      if (is_marked(is_loose, b)) is_cut[static_cast<std::size_t>(b)] = 1;
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (const auto& c : joints.contacts()) {
      if (!is_marked(is_loose, c.a) || !is_marked(is_loose, c.b) ||
          is_marked(is_cut, c.a) == is_marked(is_cut, c.b))
        continue;
      is_cut[static_cast<std::size_t>(c.a)] = is_cut[static_cast<std::size_t>(c.b)] = 1;
      goes_on = true;
    }
  }
  std::vector<int> held;
  for (const int b : loose)
    if (is_marked(is_cut, b)) held.push_back(b);
  return held;
}

}  // namespace voussoir
