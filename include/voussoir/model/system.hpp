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
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/laws_by_set.hpp>
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
#include <voussoir/model/lining_surface.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir {

/// A body of the mechanical system: a rock body, a lining node, or the fixed ground.
template <int Dim>
struct SystemBody {
  Vec<Dim> centre;  ///< in the in-situ state [m]
  double weight;    ///< m g [N]
  double gyration;  ///< radius of gyration: turns a moment into a force for comparison [m]
  bool movable = true;
  bool is_block =
      true;  ///< false: a lining node or the edge of the domain, not judged by its motion
  bool is_gone = false;  ///< taken out for good
};

/// Everything that moves and every force between: the mechanical state that the equilibrium
/// methods work on. It knows neither shapes nor tunnels.
///
/// Displacements and forces are flat vectors with `dof` values per body: translations, rotations.
/// Rotations are small and the contact topology is that of the reference position.
///
/// A copy is a full snapshot: about 2 kB per block.
/// @tparam DetectorModel  the narrow phase by which contacts are updated
template <class Geometry, class JointLaw, class InterfaceLaw = CoulombJoint,
          class DetectorModel = FaceContacts>
class System {
 public:
  using Detector = DetectorModel;
  using GeometryType = Geometry;
  using InterfaceLawType = InterfaceLaw;
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;
  using Body = SystemBody<dim>;
  using Matrix = BlockMatrix<dof>;
  using Joints = ContactGroup<Geometry, JointLaw>;
  using Boundary = ContactGroup<Geometry, SmoothWall>;
  using Interface = ContactGroup<Geometry, InterfaceLaw>;
  using Shape = typename PlacedShapes<dim>::Shape;
  using Shapes = std::vector<std::span<const Shape>>;

  System(const LawsBySet<JointLaw>& joint_laws, double boundary_stiffness)
      : joints(joint_laws.all()), boundary({SmoothWall(boundary_stiffness)}), interface({}) {}
  System(const LawsBySet<JointLaw>& joint_laws, double boundary_stiffness,
         const InterfaceLaw& interface_law)
      : System(joint_laws, boundary_stiffness) {
    interface.add_law(interface_law);
  }

  Joints joints;        ///< rock on rock
  Boundary boundary;    ///< rock on the fixed edge of the domain
  Interface interface;  ///< rock on lining
  SupportSet<dim> supports;
  std::vector<InstalledLining<Geometry>> linings;
  /// For every body its convex parts in the in-situ state; bodies behind the last have none. Null:
  /// contacts cannot be updated. What it points to, it keeps alive.
  std::shared_ptr<const Shapes> shapes;
  /// Of factors of the elastic stiffness; copies of a system share them.
  std::shared_ptr<PatternStore> patterns = std::make_shared<PatternStore>();
  /// For every label of their faces the index of the joint law; null: the first for all.
  std::shared_ptr<const std::vector<int>> law_of_cut;

  int add_body(const Body& body) { return add_bodies({&body, 1}); }
  /// @return  number of the first
  int add_bodies(std::span<const Body> bodies);

  [[nodiscard]] int body_count() const { return static_cast<int>(bodies_.size()); }
  [[nodiscard]] const Body& body(int b) const { return bodies_[static_cast<std::size_t>(b)]; }

  /// Where a body is: from axes of the in-situ state with their origin in its centre to the world.
  [[nodiscard]] Pose<dim> pose(int b) const;
  /// How a body has moved since the in-situ state: a point p then is now at motion_of(b)(p).
  [[nodiscard]] Pose<dim> motion_of(int b) const {
    Pose<dim> motion = pose(b);
    motion.position -= motion.rotation * body(b).centre;
    return motion;
  }
  /// The same when contacts were last updated.
  [[nodiscard]] Pose<dim> pose_at_update(int b) const;
  /// The lever of a point that was there in the in-situ state, when contacts were last updated [m].
  [[nodiscard]] Vec<dim> arm(int b, const Vec<dim>& point) const {
    const Vec<dim> arm = point - body(b).centre;
    return has_updated_contacts() ? Vec<dim>(turned_[static_cast<std::size_t>(b)] * arm) : arm;
  }
  /// Where a body was in the in-situ state, in the axes that are the world's in the reference
  /// configuration.
  [[nodiscard]] Pose<dim> frame_at_start(int b) const {
    Pose<dim> frame;
    frame.position = body(b).centre;
    if (has_updated_contacts()) frame.rotation = transposed(turned_[static_cast<std::size_t>(b)]);
    return frame;
  }
  /// Whether contacts have been updated since the in-situ state.
  [[nodiscard]] bool has_updated_contacts() const { return updated_at_.size() > 0; }
  /// The displacement at which they were; empty if never.
  [[nodiscard]] const Eigen::VectorXd& updated_at() const { return updated_at_; }
  /// Takes note that contacts and supports are now those of the present displacement.
  void set_updated() {
    std::vector<Rotation<dim>> turned;
    for (int b = 0; b < body_count(); ++b) turned.push_back(pose(b).rotation);
    set_updated(displacement, std::move(turned));
  }
  /// The same of another displacement.
  /// @param turned  how every body lay there
  void set_updated(Eigen::VectorXd updated_at, std::vector<Rotation<dim>> turned) {
    turned_ = std::move(turned);
    updated_at_ = std::move(updated_at);
  }
  /// How far the block that has moved most has done so since contacts were last updated; turning
  /// counts at the radius of gyration [m].
  [[nodiscard]] double moved_since_update() const;

  [[nodiscard]] std::vector<int> movable_bodies() const {
    std::vector<int> movable;
    for (int b = 0; b < body_count(); ++b)
      if (body(b).movable) movable.push_back(b);
    return movable;
  }

  /// Of all bodies, where contacts were last updated [m].
  [[nodiscard]] std::vector<Vec<dim>> centres() const {
    std::vector<Vec<dim>> all;
    for (int b = 0; b < body_count(); ++b) all.push_back(pose_at_update(b).position);
    return all;
  }

  Eigen::VectorXd displacement;  ///< since the in-situ state
  Eigen::VectorXd load;          ///< weight, surcharge
  /// What the excavated rock exerted on the walls that this stage unloads: with all of it the
  /// in-situ state is in equilibrium. Where joints cannot carry the in-situ shear
  /// (`InSitu::required_friction_angle`) it also holds the blocks beside them, away from the wall,
  /// and they move when it goes.
  Eigen::VectorXd wall_load;
  double wall_fraction = 1;   ///< part of `wall_load` still acting
  Eigen::VectorXd wall_held;  ///< what acts on walls whatever that is; empty: nothing

  /// Out-of-balance force at displacement `u`; zero for bodies that cannot move.
  template <class History = Frozen>
  void forces(const Eigen::VectorXd& u, Eigen::VectorXd& f) {
    set_to_sum(f, load, wall_fraction, wall_load);
    if (wall_held.size() > 0) add_to(f, wall_held);
    joints.template add_forces<History>(u.data(), f.data());
    boundary.template add_forces<History>(u.data(), f.data());
    interface.template add_forces<History>(u.data(), f.data());
    add_support_forces<History>(u.data(), f.data(), nullptr);
    for (int b = 0; b < body_count(); ++b)
      if (!body(b).movable) set_part<dof>(f, dof * b, zeros<Fixed<dof, 1>>());
  }

  /// What acts on a body from outside: weight, surcharge, walls.
  [[nodiscard]] Fixed<dof, 1> load_on(int b) const {
    Fixed<dof, 1> sum = part<dof>(load, dof * b) + wall_fraction * part<dof>(wall_load, dof * b);
    if (wall_held.size() > 0) sum += part<dof>(wall_held, dof * b);
    return sum;
  }

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

  /// Solves with that stiffness. @throws FreeBody, NotEnoughMemory, Stopped
  [[nodiscard]] ElasticSolver<dof> elastic_solver(const LinearSettings& settings,
                                                  const Progress& progress = {}) const {
    return ElasticSolver<dof>(elastic_stiffness(progress), centres(), settings, progress, patterns);
  }

  /// Takes bodies out for good: their contacts and what supports were to them go, and they stop
  /// moving.
  void remove(const std::vector<int>& gone);

  /// Movable bodies without a chain of contacts and lining members to a body that cannot move: they
  /// fall whatever the forces, alone or as a group that holds nothing but itself. Bolts alone do
  /// not hold: a block could still turn about them. Nor do the upright edges of the domain, which
  /// are smooth.
  [[nodiscard]] std::vector<int> unsupported() const;

  /// Weight of the lightest block: the scale for weightless lining nodes [N].
  [[nodiscard]] double lightest_weight() const {
    double lightest = std::numeric_limits<double>::infinity();
    for (const Body& b : bodies_)
      if (b.movable && b.weight > 0) lightest = std::min(lightest, b.weight);
    return lightest;
  }
  /// Out-of-balance force of one body over its weight; a moment counts as a force at the radius of
  /// gyration. Zero for a body that cannot move.
  [[nodiscard]] double unbalance_of(const Eigen::VectorXd& f, int b, double lightest) const {
    const Body& it = body(b);
    if (!it.movable) return 0.0;
    const double force = part<dim>(f, dof * b).norm();
    const double moment = part<dof - dim>(f, dof * b + dim).norm() / it.gyration;
    return (force + moment) / (it.weight > 0 ? it.weight : lightest);
  }
  [[nodiscard]] double unbalance_over_weight(const Eigen::VectorXd& f) const {
    const double lightest = lightest_weight();
    double worst = 0;
    for (int b = 0; b < body_count(); ++b) worst = std::max(worst, unbalance_of(f, b, lightest));
    return worst;
  }

  /// Largest elastic correction of any body over the largest displacement of a block: the error
  /// estimate [-]. Below a nanometre of displacement there is nothing to be in error.
  /// @param inexact  largest error of the correction itself [m]
  [[nodiscard]] double relative_correction(const Eigen::VectorXd& correction,
                                           const Eigen::VectorXd& u, double inexact = 0) const {
    double squared = 0;
    for (int b = 0; b < body_count(); ++b)
      squared = std::max(squared, part<dim>(correction, dof * b).squaredNorm());
    return (std::sqrt(squared) + inexact) / std::max(largest_translation(u), 1e-9);
  }

  /// Largest translation of a block [m].
  [[nodiscard]] double largest_translation(const Eigen::VectorXd& u) const {
    double squared = 0;
    for (int b = 0; b < body_count(); ++b)
      if (body(b).is_block) squared = std::max(squared, part<dim>(u, dof * b).squaredNorm());
    return std::sqrt(squared);
  }

 private:
  /// Lengthens a vector by zeros.
  static void grow(Eigen::VectorXd& vector, Eigen::Index size) {
    const Eigen::Index before = vector.size();
    vector.conservativeResize(size);
    std::fill(vector.data() + before, vector.data() + size, 0.0);
  }

  std::vector<Body> bodies_;
  Eigen::VectorXd updated_at_;         ///< displacement at which contacts were updated
  std::vector<Rotation<dim>> turned_;  ///< of bodies then
};

template <class Geometry, class JointLaw, class InterfaceLaw, class DetectorModel>
int System<Geometry, JointLaw, InterfaceLaw, DetectorModel>::add_bodies(
    std::span<const Body> bodies) {
  const int first = body_count();
  bodies_.insert(bodies_.end(), bodies.begin(), bodies.end());
  const auto size = static_cast<Eigen::Index>(dof * bodies_.size());
  grow(displacement, size);
  grow(load, size);
  if (has_updated_contacts()) {
    grow(updated_at_, size);
    turned_.resize(bodies_.size(), diagonal_of<dim>(1));
  }
  grow(wall_load, size);
  if (wall_held.size() > 0) grow(wall_held, size);
  return first;
}

template <class Geometry, class JointLaw, class InterfaceLaw, class DetectorModel>
auto System<Geometry, JointLaw, InterfaceLaw, DetectorModel>::pose(int b) const -> Pose<dim> {
  Pose<dim> at = pose_at_update(b);
  if (!body(b).movable) return at;
  at.position = body(b).centre + part<dim>(displacement, dof * b);
  Spin<dim> turn = part<dof - dim>(displacement, dof * b + dim);
  if (has_updated_contacts()) turn -= part<dof - dim>(updated_at_, dof * b + dim);
  at.rotation = rotation_by(turn) * at.rotation;
  return at;
}

template <class Geometry, class JointLaw, class InterfaceLaw, class DetectorModel>
auto System<Geometry, JointLaw, InterfaceLaw, DetectorModel>::pose_at_update(int b) const
    -> Pose<dim> {
  Pose<dim> at;
  at.position = body(b).centre;
  if (static_cast<std::size_t>(b) < turned_.size()) {
    at.position += part<dim>(updated_at_, dof * b);
    at.rotation = turned_[static_cast<std::size_t>(b)];
  }
  return at;
}

template <class Geometry, class JointLaw, class InterfaceLaw, class DetectorModel>
double System<Geometry, JointLaw, InterfaceLaw, DetectorModel>::moved_since_update() const {
  double farthest = 0;
  for (int b = 0; b < body_count(); ++b) {
    if (!body(b).movable || !body(b).is_block) continue;
    Fixed<dof, 1> u = part<dof>(displacement, dof * b);
    if (has_updated_contacts()) u -= part<dof>(updated_at_, dof * b);
    farthest = std::max(farthest,
                        part<dim>(u, 0).norm() + body(b).gyration * part<dof - dim>(u, dim).norm());
  }
  return farthest;
}

template <class Geometry, class JointLaw, class InterfaceLaw, class DetectorModel>
auto System<Geometry, JointLaw, InterfaceLaw, DetectorModel>::elastic_stiffness(
    const Progress& progress) const -> Matrix {
  StopCheck stop(progress);
  Matrix k(body_count());
  const auto sink = [&](int a, int b, const auto& aa, const auto& ab, const auto& bb) {
    stop();
    const bool a_moves = body(a).movable, b_moves = body(b).movable;
    if (a_moves) k.add(a, aa);
    if (b_moves) k.add(b, bb);
    if (a_moves && b_moves) k.add(a, b, ab);
  };
  joints.add_stiffness(sink);
  boundary.add_stiffness(sink);
  interface.add_stiffness(sink);
  for (const auto& support : supports)
    support->add_stiffness([&](int a, int b, const auto& aa, const auto& ab, const auto&,
                               const auto& bb) { sink(a, b, aa, ab, bb); });
  for (int b = 0; b < body_count(); ++b)
    if (!body(b).movable) k.add(b, diagonal_of<dof>(1));
  k.compress();
  return k;
}

template <class Geometry, class JointLaw, class InterfaceLaw, class DetectorModel>
void System<Geometry, JointLaw, InterfaceLaw, DetectorModel>::remove(const std::vector<int>& gone) {
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

template <class Geometry, class JointLaw, class InterfaceLaw, class DetectorModel>
std::vector<int> System<Geometry, JointLaw, InterfaceLaw, DetectorModel>::unsupported() const {
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
  for (int b = 0; b < body_count(); ++b)
    if (root(static_cast<std::size_t>(b)) != root(fixed)) loose.push_back(b);
  return loose;
}

}  // namespace voussoir
