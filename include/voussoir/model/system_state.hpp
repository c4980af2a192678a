// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/linear/elastic_solver.hpp>
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

/// All of a mechanical system that no contact law has to do with: bodies, where they are, what acts
/// on them, supports. It is the same type for all laws, and compiled once.
template <class Geometry>
class SystemState {
 public:
  using GeometryType = Geometry;
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;
  using Body = SystemBody<dim>;
  using Shape = typename PlacedShapes<dim>::Shape;
  using Shapes = std::vector<std::span<const Shape>>;

  SupportSet<dim> supports;
  std::vector<InstalledLining<Geometry>> linings;
  /// For every body its convex parts in the in-situ state; bodies behind the last have none. Null:
  /// contacts cannot be updated. What it points to, it keeps alive.
  std::shared_ptr<const Shapes> shapes;
  /// Of factors of the elastic stiffness; copies of a system share them.
  std::shared_ptr<PatternStore> patterns = std::make_shared<PatternStore>();
  /// For every label of their faces the index of the joint law; null: the first for all.
  std::shared_ptr<const std::vector<int>> law_of_cut;

  /// From now on the body stays where it is, but for what is prescribed.
  void fix(int b) { bodies_[static_cast<std::size_t>(b)].movable = false; }

  int add_body(const Body& body) { return add_bodies({&body, 1}); }
  /// @return  number of the first
  int add_bodies(std::span<const Body> bodies);

  /// Becomes the other, and the other this.
  void exchange_state(SystemState& other);

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
  /// Takes note that contacts and supports are now those of this displacement.
  /// @param turned  how every body lies there
  void set_updated(Eigen::VectorXd updated_at, std::vector<Rotation<dim>> turned) {
    turned_ = std::move(turned);
    updated_at_ = std::move(updated_at);
  }
  /// How far the block that has moved most has done so since contacts were last updated; turning
  /// counts at the radius of gyration [m].
  [[nodiscard]] double moved_since_update() const;
  /// By how much the block that has turned most has since contacts were last updated, of those that
  /// weigh half as much as the mean or more: slivers turn further, and carry little [rad].
  [[nodiscard]] double turned_since_update() const;

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

  /// What acts on a body from outside: weight, surcharge, walls.
  [[nodiscard]] Fixed<dof, 1> load_on(int b) const {
    Fixed<dof, 1> sum = part<dof>(load, dof * b) + wall_fraction * part<dof>(wall_load, dof * b);
    if (wall_held.size() > 0) sum += part<dof>(wall_held, dof * b);
    return sum;
  }

  /// What the forces on a body without weight are held against: the lightest block, or where a
  /// lining has many nodes under such a block, the part of it that stands on one of them. With the
  /// whole block for each, a lining of 800 nodes may miss a block's weight and be called balanced.
  struct WeightScale {
    double weight;  ///< of the lightest block that can move [N]; infinite without any
    double edge;    ///< of a cube or square with its radius of gyration [m]

    [[nodiscard]] double of(const Body& body) const {
      return body.weight > 0 ? body.weight : weight * std::min(1.0, body.gyration / edge);
    }
  };
  [[nodiscard]] WeightScale weight_scale() const {
    WeightScale least{std::numeric_limits<double>::infinity(), 1};
    for (const Body& b : bodies_)
      if (b.movable && b.weight > 0 && b.weight < least.weight)
        least = {b.weight, std::sqrt(dim == 2 ? 6.0 : 12.0) * b.gyration};
    return least;
  }
  /// Out-of-balance force of one body over its weight; a moment counts as a force at the radius of
  /// gyration. Zero for a body that cannot move.
  [[nodiscard]] double unbalance_of(const Eigen::VectorXd& f, int b,
                                    const WeightScale& scale) const {
    const Body& it = body(b);
    if (!it.movable) return 0.0;
    const double force = part<dim>(f, dof * b).norm();
    const double moment = part<dof - dim>(f, dof * b + dim).norm() / it.gyration;
    return (force + moment) / scale.of(it);
  }
  [[nodiscard]] double unbalance_over_weight(const Eigen::VectorXd& f) const {
    const WeightScale scale = weight_scale();
    double worst = 0;
    for (int b = 0; b < body_count(); ++b) worst = std::max(worst, unbalance_of(f, b, scale));
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

  /// Largest translation of a block that can move [m].
  [[nodiscard]] double largest_translation(const Eigen::VectorXd& u) const {
    double squared = 0;
    for (int b = 0; b < body_count(); ++b)
      if (body(b).is_block && body(b).movable)
        squared = std::max(squared, part<dim>(u, dof * b).squaredNorm());
    return std::sqrt(squared);
  }

 protected:
  // Defined below: a class with so many vectors is copied in one place.
  SystemState();
  SystemState(const SystemState&);
  SystemState(SystemState&&) noexcept;
  SystemState& operator=(const SystemState&);
  SystemState& operator=(SystemState&&) noexcept;
  ~SystemState();

  std::vector<Body> bodies_;

 private:
  /// Lengthens a vector by zeros.
  static void grow(Eigen::VectorXd& vector, Eigen::Index size) {
    const Eigen::Index before = vector.size();
    vector.conservativeResize(size);
    std::fill(vector.data() + before, vector.data() + size, 0.0);
  }

  Eigen::VectorXd updated_at_;         ///< displacement at which contacts were updated
  std::vector<Rotation<dim>> turned_;  ///< of bodies then
};

template <class Geometry>
SystemState<Geometry>::SystemState() = default;
template <class Geometry>
SystemState<Geometry>::SystemState(const SystemState&) = default;
template <class Geometry>
SystemState<Geometry>::SystemState(SystemState&&) noexcept = default;
template <class Geometry>
SystemState<Geometry>& SystemState<Geometry>::operator=(const SystemState&) = default;
template <class Geometry>
SystemState<Geometry>& SystemState<Geometry>::operator=(SystemState&&) noexcept = default;
template <class Geometry>
SystemState<Geometry>::~SystemState() = default;

template <class Geometry>
void SystemState<Geometry>::exchange_state(SystemState& other) {
  SystemState kept(std::move(*this));
  *this = std::move(other);
  other = std::move(kept);
}

template <class Geometry>
int SystemState<Geometry>::add_bodies(std::span<const Body> bodies) {
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

template <class Geometry>
auto SystemState<Geometry>::pose(int b) const -> Pose<dim> {
  Pose<dim> at = pose_at_update(b);
  if (body(b).is_gone) return at;
  at.position = body(b).centre + part<dim>(displacement, dof * b);
  Spin<dim> turn = part<dof - dim>(displacement, dof * b + dim);
  if (has_updated_contacts()) turn -= part<dof - dim>(updated_at_, dof * b + dim);
  at.rotation = rotation_by(turn) * at.rotation;
  return at;
}

template <class Geometry>
auto SystemState<Geometry>::pose_at_update(int b) const -> Pose<dim> {
  Pose<dim> at;
  at.position = body(b).centre;
  if (static_cast<std::size_t>(b) < turned_.size()) {
    at.position += part<dim>(updated_at_, dof * b);
    at.rotation = turned_[static_cast<std::size_t>(b)];
  }
  return at;
}

template <class Geometry>
double SystemState<Geometry>::moved_since_update() const {
  double farthest = 0;
  for (int b = 0; b < body_count(); ++b) {
    if (body(b).is_gone || !body(b).is_block) continue;
    Fixed<dof, 1> u = part<dof>(displacement, dof * b);
    if (has_updated_contacts()) u -= part<dof>(updated_at_, dof * b);
    farthest = std::max(farthest,
                        part<dim>(u, 0).norm() + body(b).gyration * part<dof - dim>(u, dim).norm());
  }
  return farthest;
}

template <class Geometry>
double SystemState<Geometry>::turned_since_update() const {
  double weight = 0;
  int count = 0;
  const auto is_there = [this](int b) { return !body(b).is_gone && body(b).is_block; };
  for (int b = 0; b < body_count(); ++b)
    if (is_there(b)) {
      weight += body(b).weight;
      ++count;
    }
  double most = 0;
  for (int b = 0; b < body_count(); ++b) {
    if (!is_there(b) || 2 * count * body(b).weight < weight) continue;
    Spin<dim> turn = part<dof - dim>(displacement, dof * b + dim);
    if (has_updated_contacts()) turn -= part<dof - dim>(updated_at_, dof * b + dim);
    most = std::max(most, turn.norm());
  }
  return most;
}

}  // namespace voussoir
