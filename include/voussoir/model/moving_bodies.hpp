// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir {

/// What a body is to those that touch it.
enum class BodyRole : char {
  block,   ///< rock: joints between two of them
  wall,    ///< smooth: nothing rubs against it
  lining,  ///< a node of a lining: rock touches it by a law of its own, no other node does
};

/// A node of a lining as a body that moves.
template <int Dim>
struct LiningNode {
  Vec<Dim> place;                                        ///< [m]
  std::vector<typename PlacedShapes<Dim>::Shape> tiles;  ///< what rock touches
  double mass = 0;                                       ///< [kg], > 0
  Spin<Dim> inertia = zeros<Spin<Dim>>();                ///< about its place [kg m^2], > 0

  /// @throws InvalidInput  a value out of range
  void check() const {
    require(mass > 0 && std::isfinite(mass), "mass of a node", mass, "> 0 kg");
    require(smallest_entry(inertia) > 0, "inertia of a node", smallest_entry(inertia),
            "> 0 kg m^2");
  }
};

/// The bodies of a run: their shapes, where they were added, where they are now, how they move, and
/// the loads given to them.
///
/// Positions are kept near 0, whatever the site's coordinates.
template <int Dim>
class MovingBodies {
 public:
  using Body = MovingBody<Dim>;
  using Shape = typename PlacedShapes<Dim>::Shape;

  // ---- adding ----------------------------------------------------------------------------------

  /// Adds a block of uniform density where its shape lies, at rest.
  /// @param density  [kg/m^3], > 0
  /// @return  its number, from 0
  /// @throws InvalidInput  density
  int add_block(const Shape& shape, double density) {
    return add_block(std::vector<Shape>{shape}, density);
  }
  /// The same of several convex parts that move as one.
  int add_block(const std::vector<Shape>& parts, double density) {
    require(density > 0 && std::isfinite(density), "density", density, "> 0 kg/m^3");
    return add(parts, moving_body(mass_properties(parts), density));
  }
  /// What linings touch of a body besides its shape, where it was added: it has no mass.
  void add_filling(int b, const Shape& part) {
    Body& body = bodies_[index(b)];
    for (const auto& v : part.vertices())
      body.radius = std::max(body.radius, (v - origin_ - home_[index(b)].position).norm());
    shapes_.emplace_back(part, b);
    is_filling_.push_back(1);
    fresh_ = false;
  }
  /// Adds a block that stays where it is.
  int add_fixed_block(const Shape& shape) { return add_fixed({shape}, BodyRole::block); }
  /// Adds a smooth wall: a block that stays, and against which nothing rubs.
  int add_wall(const Shape& shape) { return add_fixed({shape}, BodyRole::wall); }
  /// The same of several convex parts.
  /// @param centre  from which levers are counted [m]
  int add_wall(const std::vector<Shape>& parts, const Vec<Dim>& centre) {
    Body body;
    body.pose.position = centre;
    return add(parts, body, BodyRole::wall);
  }
  /// The same of one that moves, until it is fixed.
  int add_wall(const Shape& shape, double density) {
    const int b = add_block(shape, density);
    roles_[index(b)] = BodyRole::wall;
    return b;
  }
  /// Adds a body without shape, which touches nothing.
  /// @param mass  [kg], > 0;  @param inertia  principal moments, along the axes [kg m^2], > 0
  int add_node(const Vec<Dim>& place, double mass, const Spin<Dim>& inertia) {
    return add_node({place, {}, mass, inertia}, BodyRole::block);
  }

  // ---- changing --------------------------------------------------------------------------------

  /// A force on the centre of mass from now on, besides the weight [N], and a moment [N m], both in
  /// world axes.
  void add_load(int b, const Vec<Dim>& force, const Spin<Dim>& moment = zeros<Spin<Dim>>()) {
    loads_[index(b)].force += force;
    loads_[index(b)].moment += moment;
    fresh_ = false;
  }
  /// @param spin  world axes [rad/s]
  void set_velocity(int b, const Vec<Dim>& velocity, const Spin<Dim>& spin = zeros<Spin<Dim>>()) {
    Body& body = bodies_[index(b)];
    const double before = body.kinetic_energy();
    body.velocity = velocity;
    body.momentum = scaled_by(body.inertia, body.to_body(spin));
    kinetic_given_ += body.kinetic_energy() - before;
    fresh_ = false;
  }

  /// Puts a block where a motion brings it from where it was added, before anything is computed.
  void place(int b, const Pose<Dim>& motion) {
    Pose<Dim>& pose = bodies_[index(b)].pose;
    const Pose<Dim>& then = home_[index(b)];
    pose.position = motion(then.position + origin_) - origin_;
    pose.rotation = motion.rotation * then.rotation;
    fresh_ = false;
  }

  // ---- looking ---------------------------------------------------------------------------------

  [[nodiscard]] int body_count() const { return static_cast<int>(bodies_.size()); }
  [[nodiscard]] const Body& body(int b) const { return bodies_[index(b)]; }
  [[nodiscard]] BodyRole role(int b) const { return roles_[index(b)]; }
  /// All shapes, where they were added, with their body; where one is now: motion(body).
  [[nodiscard]] const std::vector<std::pair<Shape, int>>& shapes() const { return shapes_; }

  /// Where a body is: from its own frame to the world.
  [[nodiscard]] Pose<Dim> pose(int b) const { return in_world(bodies_[index(b)].pose); }
  /// Where it was added.
  [[nodiscard]] Pose<Dim> home(int b) const { return in_world(home_[index(b)]); }
  /// Centre of mass [m].
  [[nodiscard]] Vec<Dim> position(int b) const { return bodies_[index(b)].pose.position + origin_; }
  /// How a body has moved from where it was added: a point p there is now at motion(b)(p).
  [[nodiscard]] Pose<Dim> motion(int b) const {
    const Pose<Dim>&now = bodies_[index(b)].pose, &then = home_[index(b)];
    Pose<Dim> motion;
    motion.rotation = now.rotation * transposed(then.rotation);
    motion.position = position(b) - motion.rotation * (then.position + origin_);
    return motion;
  }
  /// Of the centre of mass [m/s].
  [[nodiscard]] const Vec<Dim>& velocity(int b) const { return bodies_[index(b)].velocity; }
  /// Angular velocity, world axes [rad/s].
  [[nodiscard]] Spin<Dim> spin(int b) const {
    return bodies_[index(b)].to_world(bodies_[index(b)].spin());
  }
  /// Angular momentum about the centre of mass, world axes [kg m^2/s].
  [[nodiscard]] Spin<Dim> angular_momentum(int b) const {
    return bodies_[index(b)].to_world(bodies_[index(b)].momentum);
  }
  [[nodiscard]] double kinetic_energy() const {
    double sum = 0;
    for (const Body& body : bodies_)
      if (body.movable()) sum += body.kinetic_energy();
    return sum;
  }

 protected:
  [[nodiscard]] static std::size_t index(int b) { return static_cast<std::size_t>(b); }

  int add_node(const LiningNode<Dim>& node, BodyRole role) {
    node.check();
    Body body;
    body.pose.position = node.place;
    body.mass = node.mass;
    body.inertia = node.inertia;
    return add(node.tiles, body, role);
  }

  /// Holds a body where it is from now on.
  void stop(int b) {
    Body& body = bodies_[index(b)];
    if (body.movable()) kinetic_given_ -= body.kinetic_energy();
    body.mass = 0;
    body.velocity = zeros<Vec<Dim>>();
    body.momentum = zeros<Spin<Dim>>();
    fresh_ = false;
  }

  Vec<Dim> origin_ = zeros<Vec<Dim>>();
  std::vector<std::pair<Shape, int>> shapes_;  ///< where they were added, with their body
  std::vector<char> is_filling_;               ///< of every shape
  std::vector<Body> bodies_;
  std::vector<Pose<Dim>> home_;  ///< where they were added
  std::vector<BodyRole> roles_;
  std::vector<Load<Dim>> loads_;
  double kinetic_given_ = 0;  ///< by hand, not by the run [J]
  bool fresh_ = false;        ///< what acts on the bodies is known where they are now

 private:
  [[nodiscard]] Pose<Dim> in_world(Pose<Dim> pose) const {
    pose.position += origin_;
    return pose;
  }
  int add_fixed(const std::vector<Shape>& parts, BodyRole role) {
    Body body;
    body.pose.position = mass_properties(parts).centroid;
    return add(parts, body, role);
  }
  int add(const std::vector<Shape>& parts, Body body, BodyRole role = BodyRole::block);
};

template <int Dim>
int MovingBodies<Dim>::add(const std::vector<Shape>& parts, Body body, BodyRole role) {
  if (bodies_.empty()) origin_ = body.pose.position;
  for (const Shape& part : parts)
    for (const auto& v : part.vertices())
      body.radius = std::max(body.radius, (v - body.pose.position).norm());
  body.pose.position -= origin_;
  const int b = body_count();
  for (const Shape& part : parts) {
    shapes_.emplace_back(part, b);
    is_filling_.push_back(0);
  }
  bodies_.push_back(body);
  home_.push_back(body.pose);
  roles_.push_back(role);
  loads_.emplace_back();
  fresh_ = false;
  return b;
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class MovingBodies<2>;
VOUSSOIR_SPATIAL_TEMPLATE class MovingBodies<3>;
#endif

}  // namespace voussoir
