// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/smooth_wall.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/thread_team.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/motion/contact_points.hpp>
#include <voussoir/motion/contact_tracker.hpp>
#include <voussoir/motion/energy_audit.hpp>
#include <voussoir/motion/moving_body.hpp>
#include <voussoir/motion/moving_contacts.hpp>

namespace voussoir {

/// How a dynamic run is stepped. Lengths that are 0 are chosen from the size of the blocks.
struct DynamicsSettings {
  double gravity = 9.81;       ///< downwards [m/s^2], >= 0
  double local_damping = 0;    ///< alpha [-], 0 <= alpha < 1: opposes motion with alpha |f|
  double viscous_damping = 0;  ///< dashpots at contacts, ratio to critical [-], >= 0
  double safety = 0.5;         ///< of the stable step [-], 0 < safety <= 1
  double time_step = 0;        ///< [s]; 0: safety times the stable step
  ContactPoints points = ContactPoints::corners;
  bool find_contacts = true;  ///< false: the contacts stay those of the beginning
  double reach = 0;           ///< contacts are listed up to this gap [m]; 0: 2 % of the mean block
  double refresh = 0;         ///< bodies of a contact move so far before it is found again [m];
                              ///< 0: a tenth of the reach
  double overlap_limit = 0.05;  ///< of the smaller block's radius, beyond which the run stops [-]
  int check_every = 100;        ///< steps between looks at the health of the run
  unsigned threads = 1;
};

/// Blocks that move: finite displacements and rotations, contacts found again as they go.
///
/// Velocity Verlet (kick, drift, kick) with a step that is stable for the masses and stiffnesses
/// there are. Forces of contacts are computed first and then summed body by body in a fixed order:
/// the result does not depend on the number of threads, to the last bit.
///
/// Local damping is evaluated with the velocity at half steps. Source: Cundall (1987); velocity
/// Verlet: Swope et al. (1982), J. Chem. Phys. 76, 637.
template <int Dim, class JointLaw>
class Dynamics {
 public:
  using Body = MovingBody<Dim>;
  using Shape = typename PlacedShapes<Dim>::Shape;
  using Joints = MovingContacts<Dim, JointLaw>;
  using Walls = MovingContacts<Dim, SmoothWall>;

  /// @throws InvalidInput  a setting out of range
  explicit Dynamics(JointLaw law, const DynamicsSettings& settings = {})
      : settings_(settings),
        joints_(std::move(law)),
        walls_(SmoothWall(joints_.law().joint_normal_stiffness())),
        team_(std::make_unique<ThreadTeam>(settings.threads)) {
    require(settings.gravity >= 0 && std::isfinite(settings.gravity), "gravity", settings.gravity,
            ">= 0 m/s^2");
    require(settings.local_damping >= 0 && settings.local_damping < 1, "local damping",
            settings.local_damping, ">= 0 and < 1");
    require(settings.viscous_damping >= 0 && std::isfinite(settings.viscous_damping),
            "viscous damping", settings.viscous_damping, ">= 0");
    require(settings.safety > 0 && settings.safety <= 1, "safety of the step", settings.safety,
            "> 0 and <= 1");
    require(settings.time_step >= 0 && std::isfinite(settings.time_step), "time step",
            settings.time_step, ">= 0 s (0: computed)");
    require(settings.reach >= 0 && std::isfinite(settings.reach), "reach of contacts",
            settings.reach, ">= 0 m (0: computed)");
    require(settings.refresh >= 0 && std::isfinite(settings.refresh), "refresh of contacts",
            settings.refresh, ">= 0 m (0: computed)");
    require(settings.overlap_limit > 0, "overlap limit", settings.overlap_limit, "> 0");
    require(settings.check_every > 0, "check_every", settings.check_every, "> 0");
  }

  /// Adds a block of uniform density where its shape lies, at rest.
  /// @param density  [kg/m^3], > 0
  /// @return  its number, from 0
  /// @throws InvalidInput  density, or the run has begun
  int add_block(const Shape& shape, double density) {
    return add_block(std::vector<Shape>{shape}, density);
  }
  /// The same of several convex parts that move as one.
  int add_block(const std::vector<Shape>& parts, double density) {
    require(density > 0 && std::isfinite(density), "density", density, "> 0 kg/m^3");
    return add(parts, moving_body(mass_properties(parts), density));
  }
  /// Adds a block that stays where it is.
  int add_fixed_block(const Shape& shape) {
    Body body;
    body.pose.position = mass_properties(shape).centroid;
    return add({shape}, body);
  }
  /// Adds a smooth wall: a block that stays, and against which nothing rubs.
  int add_wall(const Shape& shape) {
    const int b = add_fixed_block(shape);
    is_wall_[index(b)] = 1;
    return b;
  }

  /// Gives every closed contact the traction of a stress field, in which the blocks as they lie now
  /// are in equilibrium: before the first step.
  /// @param stress_at  stress_at(point) [Pa], compression positive
  /// @param closed     contacts open by no more than this are closed [m]
  template <class StressAt>
  void prescribe(StressAt&& stress_at, double closed) {
    begin();
    const auto set = [&](auto& group) {
      for (const auto& c : group.contacts()) {
        const Body &a = bodies_[index(c.a)], &b = bodies_[index(c.b)];
        const auto at = group.place_of(c, a.pose, b.pose);
        bool touches = true;
        for (auto i = index(c.first); i < index(c.last); ++i)
          touches = touches && std::abs(group.motion_of(group.points()[i], at).opening) <= closed;
        if (!touches) continue;
        const Rotation<Dim> frame = a.pose.rotation * c.frame;
        for (auto i = index(c.first); i < index(c.last); ++i) {
          auto& p = group.points()[i];
          const Vec<Dim> force = frame.transpose() *
                                 (stress_at(Vec<Dim>(b.pose(p.place) + origin_)) * frame.col(0)) *
                                 p.weight;
          p.initial = {force[0], force.template tail<Dim - 1>()};
          p.zero[0] += group.motion_of(p, at).opening;
        }
      }
    };
    set(joints_);
    set(walls_);
    fresh_ = false;
    start_audit();
  }
  /// Loads every block with what it needs to be in equilibrium now, besides its other loads; the
  /// part `set_held(fraction)` of it goes on acting. This is what an excavation takes away.
  void hold() {
    begin();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const auto [force, moment] = gather(b);
      held_[b] = {-force - loads_[b].force, -moment - loads_[b].moment};
      held_[b].force[Dim - 1] += bodies_[b].mass * settings_.gravity;
    }
    set_held(1);
  }
  void set_held(double fraction) {
    held_fraction_ = fraction;
    fresh_ = false;
  }

  [[nodiscard]] int body_count() const { return static_cast<int>(bodies_.size()); }
  [[nodiscard]] const Body& body(int b) const { return bodies_[index(b)]; }
  [[nodiscard]] double time() const { return time_; }  ///< [s]
  [[nodiscard]] std::int64_t steps() const { return steps_; }
  [[nodiscard]] double step() const { return step_; }  ///< of the last `advance` [s]
  [[nodiscard]] const Joints& joints() const { return joints_; }
  [[nodiscard]] const DynamicsSettings& settings() const { return settings_; }

  /// Centre of mass [m].
  [[nodiscard]] Vec<Dim> position(int b) const { return bodies_[index(b)].pose.position + origin_; }
  [[nodiscard]] const Vec<Dim>& velocity(int b) const { return bodies_[index(b)].velocity; }
  /// Angular velocity, world axes [rad/s].
  [[nodiscard]] Spin<Dim> spin(int b) const { return to_world(b, bodies_[index(b)].spin()); }
  /// Angular momentum about the centre of mass, world axes [kg m^2/s].
  [[nodiscard]] Spin<Dim> angular_momentum(int b) const {
    return to_world(b, bodies_[index(b)].momentum);
  }

  /// @param spin  world axes [rad/s]
  void set_velocity(int b, const Vec<Dim>& velocity, const Spin<Dim>& spin = Spin<Dim>::Zero()) {
    Body& body = bodies_[index(b)];
    body.velocity = velocity;
    body.momentum = body.inertia.cwiseProduct(to_body(b, spin));
    fresh_ = false;
  }
  /// A force that acts on the centre of mass from now on, besides the weight [N], and a moment,
  /// both in world axes.
  void add_load(int b, const Vec<Dim>& force, const Spin<Dim>& moment = Spin<Dim>::Zero()) {
    loads_[index(b)].force += force;
    loads_[index(b)].moment += moment;
    fresh_ = false;
  }

  /// The largest step that is stable for the contacts there are, damping included [s]; infinite
  /// without contacts.
  ///
  /// The highest frequency is bounded body by body: omega^2 <= 2 max eigenvalue of M_b^-1 K_bb, for
  /// a contact's energy is at most twice that of its bodies moving alone. Local damping makes an
  /// unknown behave as if (1 + alpha) times as stiff; a dashpot of ratio zeta takes the factor
  /// sqrt(1 + zeta^2) - zeta.
  [[nodiscard]] double stable_step() {
    begin();
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      if (is_stale_[b]) {
        is_stale_[b] = 0;
        stiffest_[b] = bodies_[b].movable() ? stiffness_over_mass(b) : 0.0;
      }
    const double largest =
        bodies_.empty() ? 0.0 : *std::max_element(stiffest_.begin(), stiffest_.end());
    const double zeta = settings_.viscous_damping;
    return 2 / std::sqrt(2 * largest * (1 + settings_.local_damping)) *
           (std::sqrt(1 + zeta * zeta) - zeta);
  }

  /// Moves on by a time; the last step is shortened to meet it.
  /// @throws NumericalFault  the run went bad: see `check`
  void advance(double time) {
    require(time >= 0 && std::isfinite(time), "time to advance", time, ">= 0 s");
    const double end = time_ + time;
    while (end - time_ > 1e-12 * std::max(time, step_)) {
      const double step = choose_step();
      const double left = (end - time_) / step;
      const int steps = static_cast<int>(std::min(std::ceil(left - 1e-9), 1e9));
      const int batch = std::min(steps, batch_size(step));
      // A last step of another length would spoil the order of the scheme: all are shortened.
      run_batch(batch, batch == steps ? (end - time_) / steps : step);
    }
    time_ = end;
  }
  /// Moves on by a number of steps.
  void advance_steps(int count) {
    require(count >= 0, "steps to advance", count, ">= 0");
    while (count > 0) {
      const double step = choose_step();
      const int batch = std::min(count, batch_size(step));
      run_batch(batch, step);
      count -= batch;
    }
  }

  /// Energies at the present time.
  [[nodiscard]] EnergyAudit energy() {
    begin();
    EnergyAudit now = audit_;
    now.kinetic = kinetic_energy() - kinetic_at_start_;
    now.contacts = contact_energy() - contacts_at_start_;
    return now;
  }
  [[nodiscard]] double kinetic_energy() const {
    double sum = 0;
    for (const Body& body : bodies_)
      if (body.movable()) sum += body.kinetic_energy();
    return sum;
  }
  [[nodiscard]] double contact_energy() const {
    double sum = 0;
    for (std::size_t k = 0; k < joints_.size(); ++k) sum += joints_.stored_energy(k, bodies_);
    for (std::size_t k = 0; k < walls_.size(); ++k) sum += walls_.stored_energy(k, bodies_);
    return sum;
  }

  /// Force and moment of all contacts on a body at the present time, world axes.
  [[nodiscard]] std::pair<Vec<Dim>, Spin<Dim>> contact_force(int b) {
    begin();
    return gather(index(b));
  }

 private:
  static constexpr int dof = Dim + spin_count<Dim>;
  using Stiffness = Eigen::Matrix<double, dof, dof>;
  struct Load {
    Vec<Dim> force = Vec<Dim>::Zero();
    Spin<Dim> moment = Spin<Dim>::Zero();
  };
  /// What acts on a body, kept between the two halves of a step.
  struct Acting {
    Vec<Dim> acceleration = Vec<Dim>::Zero();  ///< [m/s^2]
    Spin<Dim> torque = Spin<Dim>::Zero();      ///< frame of the body [N m]
    Vec<Dim> damping = Vec<Dim>::Zero();       ///< local damping, part of the above [N]
    Spin<Dim> damping_torque = Spin<Dim>::Zero();
  };
  /// One end of a contact, as its body sees it.
  struct End {
    std::uint32_t contact;
    std::uint32_t end;  ///< 0: body a, 1: body b
    [[nodiscard]] double sign() const { return 2.0 * end - 1.0; }
  };
  /// Sums of one member of the team; apart in memory.
  struct alignas(64) Sums {
    Dissipation lost;
    double gravity = 0, loads = 0, damping = 0, viscosity = 0;
  };

  [[nodiscard]] static std::size_t index(int b) { return static_cast<std::size_t>(b); }
  [[nodiscard]] Spin<Dim> to_world(int b, const Spin<Dim>& v) const {
    if constexpr (Dim == 2)
      return v;
    else
      return bodies_[index(b)].pose.rotation * v;
  }
  [[nodiscard]] Spin<Dim> to_body(int b, const Spin<Dim>& v) const {
    if constexpr (Dim == 2)
      return v;
    else
      return bodies_[index(b)].pose.rotation.transpose() * v;
  }

  /// Contacts of both groups in one row: joints, then walls.
  [[nodiscard]] std::size_t contact_count() const { return joints_.size() + walls_.size(); }

  int add(const std::vector<Shape>& parts, Body body) {
    if (begun_) throw InvalidInput("dynamics: blocks must be added before the run begins");
    // Positions are kept near 0, whatever the site's coordinates.
    if (bodies_.empty()) origin_ = body.pose.position;
    for (const Shape& part : parts)
      for (const auto& v : part.vertices())
        body.radius = std::max(body.radius, (v - body.pose.position).norm());
    body.pose.position -= origin_;
    const int b = body_count();
    for (const Shape& part : parts) shapes_.push_back({moved_to_origin(part), b});
    bodies_.push_back(body);
    loads_.emplace_back();
    held_.emplace_back();
    acting_.emplace_back();
    is_wall_.push_back(0);
    is_stale_.push_back(1);
    stiffest_.push_back(0);
    return b;
  }
  [[nodiscard]] Shape moved_to_origin(const Shape& shape) const {
    auto vertices = shape.vertices();
    for (auto& v : vertices) v -= origin_;
    std::vector<int> cuts;
    for (std::size_t k = 0; k < shape.size(); ++k) cuts.push_back(shape.cut(k));
    if constexpr (Dim == 2) {
      return Shape(std::move(vertices), std::move(cuts));
    } else {
      std::vector<std::vector<int>> loops;
      for (std::size_t k = 0; k < shape.size(); ++k) {
        const auto loop = shape.loop(k);
        loops.emplace_back(loop.begin(), loop.end());
      }
      return Shape(std::move(vertices), loops, std::move(cuts));
    }
  }

  // ---- contacts --------------------------------------------------------------------------------

  /// Before the first step: sizes are chosen and contacts found.
  void begin() {
    if (!begun_) {
      begun_ = true;
      double size = 0;
      int count = 0;
      for (const Body& body : bodies_)
        if (body.movable()) {
          size += body.radius;
          ++count;
        }
      if (count == 0) throw InvalidInput("dynamics: there is no block that can move");
      size /= count;
      const double reach = settings_.reach > 0 ? settings_.reach : 0.02 * size;
      refresh_ = settings_.refresh > 0 ? settings_.refresh : 0.1 * reach;
      tracker_.emplace(reach, refresh_, 8 * reach);
      for (const auto& [shape, b] : shapes_) tracker_->add(shape, b, bodies_[index(b)].pose);
      find_contacts();
      tidy();
      start_audit();
    }
    if (!fresh_) {
      react(0, contact_count(), sums_[0].lost);
      for (std::size_t b = 0; b < bodies_.size(); ++b) settle(b, sums_[0]);
      sums_ = {};
      fresh_ = true;
    }
  }

  void start_audit() {
    kinetic_at_start_ = kinetic_energy();
    contacts_at_start_ = contact_energy();
    audit_ = {};
  }

  /// Follows the contacts to where the bodies are.
  void find_contacts() {
    using Pair = typename ContactTracker<Dim>::Pair;
    bool changed = false, relisted = false;
    tracker_->update(
        bodies_,
        [&](Pair& pair, const Contact<Dim>& contact) {
          const bool in_place =
              is_wall(pair) ? refresh(walls_, pair, contact) : refresh(joints_, pair, contact);
          relisted = relisted || !in_place;
          changed = true;
        },
        [&](Pair& pair) {
          if (is_wall(pair))
            audit_.refound -= walls_.stored_energy(index(pair.contact), bodies_);
          else
            audit_.refound -= joints_.stored_energy(index(pair.contact), bodies_);
          pair.contact = -1;
          is_stale_[index(tracker_->body_of(pair.a))] = 1;
          is_stale_[index(tracker_->body_of(pair.b))] = 1;
          relisted = changed = true;
        });
    if (relisted) tidy();
    if (!changed) return;
    stable_step_ = 0;
    fresh_ = false;
  }

  [[nodiscard]] bool is_wall(const typename ContactTracker<Dim>::Pair& pair) const {
    return is_wall_[index(tracker_->body_of(pair.a))] || is_wall_[index(tracker_->body_of(pair.b))];
  }

  /// Gives a pair the contact that was found.
  /// @return  true if the contact has kept its place in the lists
  template <class Group>
  bool refresh(Group& group, typename ContactTracker<Dim>::Pair& pair, const Contact<Dim>& found) {
    const auto& shapes = tracker_->shapes();
    const bool of_a = found.touch != Touch::face_b;
    const std::size_t owner = of_a ? pair.a : pair.b;
    const int a = tracker_->body_of(owner), b = tracker_->body_of(of_a ? pair.b : pair.a);
    const Vec<Dim> normal = of_a ? found.normal : Vec<Dim>(-found.normal);
    const Pose<Dim>&pose_a = bodies_[index(a)].pose, &pose_b = bodies_[index(b)].pose;
    // Height of the face of a; crossing edges touch at one depth.
    double height = 0;
    if (found.touch != Touch::edge_edge) {
      const PlacedShape<Dim> shape = shapes[owner];
      height = -std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < shape.vertex_count; ++k)
        height = std::max(height, normal.dot(shape.vertex(k)));
    }
    if (found.touch == Touch::edge_edge) {
      // The section of the overlap would be a spring that grows with the depth. A corner's share of
      // a face as large as the blocks is taken instead.
      Vec<Dim> middle = Vec<Dim>::Zero();
      for (const Vec<Dim>& p : found.polygon) middle += p;
      places_ = {{middle / static_cast<double>(found.polygon.size()),
                  bodies_[index(a)].radius * bodies_[index(b)].radius / 16}};
    } else {
      place_points(settings_.points, found.polygon, found.measure, places_);
    }
    typename Group::Contact contact;
    contact.a = a;
    contact.b = b;
    Rotation<Dim> frame;
    const bool known = pair.contact >= 0;
    const auto old = known ? group.contacts()[index(pair.contact)] : typename Group::Contact{};
    bool keeps = false;
    if (known) {
      const double sign = old.a == a ? 1.0 : -1.0;
      const Rotation<Dim> was = bodies_[index(old.a)].pose.rotation * old.frame;
      frame = carried(Rotation<Dim>(sign * was), normal);
      keeps = normal.dot(sign * was.col(0)) > 0.5;
    }
    if (!keeps) frame << normal, tangent_basis(normal);
    contact.frame = pose_a.rotation.transpose() * frame;
    contact.first = static_cast<std::int32_t>(group.points().size());
    const auto at = Group::place_of(contact, pose_a, pose_b);
    for (const WeightedPoint<Dim>& it : places_) {
      if (!(it.weight > 0)) continue;
      typename Group::Point point{};
      point.place = pose_b.rotation.transpose() * (it.place - pose_b.position);
      point.weight = it.weight;
      point.zero.setZero();
      const PointMotion<Dim> now = Group::motion_of(point, at);
      point.zero[0] =
          now.opening -
          (found.touch == Touch::edge_edge ? found.separation : normal.dot(it.place) - height);
      point.zero.template tail<Dim - 1>() = now.slip;
      if (keeps) inherit(group, old, it.place, point);
      group.points().push_back(point);
    }
    contact.last = static_cast<std::int32_t>(group.points().size());
    if (settings_.viscous_damping > 0)
      contact.viscosity =
          viscosity_of(contact, group.law().joint_normal_stiffness() * found.measure);
    if (known) {
      audit_.refound -= group.stored_energy(index(pair.contact), bodies_);
    } else {
      pair.contact = static_cast<std::int32_t>(group.size());
      group.contacts().emplace_back();
    }
    const bool in_place =
        known && a == old.a && contact.last - contact.first == old.last - old.first;
    if (in_place) {
      std::copy(group.points().begin() + contact.first, group.points().end(),
                group.points().begin() + old.first);
      group.points().resize(index(contact.first));
      contact.first = old.first;
      contact.last = old.last;
    }
    is_stale_[index(a)] = is_stale_[index(b)] = 1;
    group.contacts()[index(pair.contact)] = contact;
    audit_.refound += group.stored_energy(index(pair.contact), bodies_);
    return in_place;
  }

  /// The old frame turned the shortest way so that its first column is the new normal.
  [[nodiscard]] static Rotation<Dim> carried(const Rotation<Dim>& old, const Vec<Dim>& normal) {
    Rotation<Dim> frame;
    frame.col(0) = normal;
    for (int k = 1; k < Dim; ++k) {
      Vec<Dim> t = old.col(k);
      for (int l = 0; l < k; ++l) t -= t.dot(frame.col(l)) * frame.col(l);
      frame.col(k) = t.normalized();
    }
    return frame;
  }

  /// Takes over stress, slip and memory from the nearest point of the contact as it was.
  template <class Group>
  void inherit(const Group& group, const typename Group::Contact& old, const Vec<Dim>& place,
               typename Group::Point& point) const {
    const Pose<Dim>& pose = bodies_[index(old.b)].pose;
    const typename Group::Point* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (auto i = index(old.first); i < index(old.last); ++i) {
      const double distance = (pose(group.points()[i].place) - place).squaredNorm();
      if (distance < least) {
        least = distance;
        nearest = &group.points()[i];
      }
    }
    if (nearest == nullptr) return;
    const auto at = Group::place_of(old, bodies_[index(old.a)].pose, bodies_[index(old.b)].pose);
    // Bodies a and b may have changed places, and with them all signs: slip, opening and force on
    // b along the axes of the contact are the same either way.
    point.zero.template tail<Dim - 1>() -= Group::motion_of(*nearest, at).slip;
    const double share = point.weight / nearest->weight;
    point.initial.normal = share * nearest->initial.normal;
    point.initial.tangential = share * nearest->initial.tangential;
    point.state = nearest->state;
  }

  /// Dashpot over stiffness so that two blocks on this contact's normal springs are damped with the
  /// ratio wanted: c / k = 2 zeta sqrt(m / k).
  template <class Contact>
  [[nodiscard]] double viscosity_of(const Contact& c, double stiffness) const {
    const double ma = bodies_[index(c.a)].mass, mb = bodies_[index(c.b)].mass;
    const double mass = ma > 0 && mb > 0 ? ma * mb / (ma + mb) : std::max(ma, mb);
    return 2 * settings_.viscous_damping * std::sqrt(mass / stiffness);
  }

  /// Drops what is no longer used, puts contacts in the order of the pairs, and lists every body's.
  void tidy() {
    tidy(joints_, false);
    tidy(walls_, true);
    reactions_.resize(contact_count());
    first_end_.assign(bodies_.size() + 1, 0);
    const auto each = [this](auto&& visit) {
      std::uint32_t k = 0;
      for (const auto& c : joints_.contacts()) visit(k++, c.a, c.b);
      for (const auto& c : walls_.contacts()) visit(k++, c.a, c.b);
    };
    each([this](std::uint32_t, int a, int b) {
      ++first_end_[index(a) + 1];
      ++first_end_[index(b) + 1];
    });
    for (std::size_t b = 0; b < bodies_.size(); ++b) first_end_[b + 1] += first_end_[b];
    ends_.resize(2 * contact_count());
    std::vector<std::uint32_t> next(first_end_.begin(), first_end_.end() - 1);
    each([&](std::uint32_t k, int a, int b) {
      ends_[next[index(a)]++] = {k, 0};
      ends_[next[index(b)]++] = {k, 1};
    });
  }
  template <class Group>
  void tidy(Group& group, bool of_walls) {
    std::vector<typename Group::Contact> contacts;
    std::vector<typename Group::Point> points;
    contacts.reserve(group.size());
    points.reserve(group.points().size());
    for (auto& pair : tracker_->pairs()) {
      if (pair.contact < 0 || is_wall(pair) != of_walls) continue;
      typename Group::Contact c = group.contacts()[index(pair.contact)];
      const auto first = group.points().begin() + c.first, last = group.points().begin() + c.last;
      c.first = static_cast<std::int32_t>(points.size());
      points.insert(points.end(), first, last);
      c.last = static_cast<std::int32_t>(points.size());
      pair.contact = static_cast<std::int32_t>(contacts.size());
      contacts.push_back(c);
    }
    group.contacts().swap(contacts);
    group.points().swap(points);
  }

  /// A bound on the largest eigenvalue of M^-1 K of one body, all others held, its contacts closed
  /// and sticking: the largest sum of a row [1/s^2].
  [[nodiscard]] double stiffness_over_mass(std::size_t b) const {
    Stiffness sum = Stiffness::Zero();
    for (std::uint32_t e = first_end_[b]; e < first_end_[b + 1]; ++e) {
      const std::size_t k = ends_[e].contact;
      if (k < joints_.size())
        add_springs(joints_, k, ends_[e].end == 1, sum);
      else
        add_springs(walls_, k - joints_.size(), ends_[e].end == 1, sum);
    }
    return sum.rowwise().template lpNorm<1>().maxCoeff();
  }
  template <class Group>
  void add_springs(const Group& group, std::size_t k, bool on_b, Stiffness& sum) const {
    const double kn = group.law().joint_normal_stiffness(),
                 ks = group.law().joint_shear_stiffness();
    const auto& c = group.contacts()[k];
    const Body &a = bodies_[index(c.a)], &b = bodies_[index(c.b)];
    const Rotation<Dim> frame =
        on_b ? Rotation<Dim>(b.pose.rotation.transpose() * (a.pose.rotation * c.frame)) : c.frame;
    for (auto i = index(c.first); i < index(c.last); ++i) {
      const auto& p = group.points()[i];
      const Vec<Dim> place =
          on_b ? p.place
               : Vec<Dim>(a.pose.rotation.transpose() * (b.pose(p.place) - a.pose.position));
      add_spring(sum, on_b ? b : a, frame, place, kn * p.weight, ks * p.weight);
    }
  }
  /// Adds M^-1/2 G^T K G M^-1/2 of one point to the matrix of its body, in the body's frame.
  static void add_spring(Stiffness& sum, const Body& body, const Rotation<Dim>& frame,
                         const Vec<Dim>& place, double kn, double ks) {
    const double root = 1 / std::sqrt(body.mass);
    for (int k = 0; k < Dim; ++k) {
      const Vec<Dim> axis = frame.col(k);
      Eigen::Matrix<double, dof, 1> g;
      g << root * axis, moment_of(place, axis).cwiseQuotient(body.inertia.cwiseSqrt());
      sum += (k == 0 ? kn : ks) * g * g.transpose();
    }
  }

  // ---- steps -----------------------------------------------------------------------------------

  [[nodiscard]] double choose_step() {
    begin();
    if (settings_.time_step > 0) return step_ = settings_.time_step;
    if (stable_step_ == 0) stable_step_ = stable_step();
    double step = settings_.safety * stable_step_;
    if (!std::isfinite(step)) step = 1e-3;  // nothing touches
    return step_ = step;
  }

  /// Steps that can be made before contacts must be looked at again.
  [[nodiscard]] int batch_size(double step) const {
    if (!settings_.find_contacts) return settings_.check_every;
    double fastest = settings_.gravity * step;
    for (const Body& body : bodies_)
      if (body.movable())
        fastest = std::max(fastest, body.velocity.norm() + body.spin().norm() * body.radius);
    const double steps = std::min(refresh_, 0.1 * tracker_->reach()) / (fastest * step);
    return static_cast<int>(std::clamp(steps, 1.0, static_cast<double>(settings_.check_every)));
  }

  void run_batch(int count, double step) {
    begin();
    step_ = step;
    sums_.assign(team_->size(), {});
    team_->run([&](unsigned member) {
      Sums& sums = sums_[member];
      const auto bodies = team_->share(bodies_.size(), member);
      const auto contacts = team_->share(contact_count(), member);
      for (int k = 0; k < count; ++k) {
        for (std::size_t b = bodies.first; b < bodies.last; ++b)
          if (bodies_[b].movable()) start(b, step, sums);
        team_->meet();
        react(contacts.first, contacts.last, sums.lost);
        sums.viscosity += step * std::exchange(sums.lost.viscosity, 0.0);
        team_->meet();
        for (std::size_t b = bodies.first; b < bodies.last; ++b)
          if (bodies_[b].movable()) {
            settle(b, sums);
            finish(b, step, sums);
          }
      }
    });
    for (const Sums& sums : sums_) {
      audit_.friction += sums.lost.friction;
      audit_.viscosity += sums.viscosity;
      audit_.gravity += sums.gravity;
      audit_.loads += sums.loads;
      audit_.damping += sums.damping;
    }
    steps_ += count;
    time_ += count * step;
    for (Body& body : bodies_)
      if (body.movable()) body.straighten();
    if (settings_.find_contacts) find_contacts();
  }

  void react(std::size_t first, std::size_t last, Dissipation& lost) {
    const std::size_t joints = joints_.size();
    for (std::size_t k = first; k < std::min(last, joints); ++k)
      reactions_[k] = joints_.react(k, bodies_, lost);
    for (std::size_t k = std::max(first, joints); k < last; ++k)
      reactions_[k] = walls_.react(k - joints, bodies_, lost);
  }

  [[nodiscard]] std::pair<Vec<Dim>, Spin<Dim>> gather(std::size_t b) const {
    Vec<Dim> force = Vec<Dim>::Zero();
    Spin<Dim> moment = Spin<Dim>::Zero();
    for (std::uint32_t k = first_end_[b]; k < first_end_[b + 1]; ++k) {
      const Reaction<Dim>& r = reactions_[ends_[k].contact];
      // No branch: which end of a contact a body is cannot be foreseen.
      force += ends_[k].sign() * r.force;
      moment += r.moment[ends_[k].end];
    }
    return {force, moment};
  }

  /// First half kick, and the drift.
  void start(std::size_t b, double step, Sums& sums) {
    Body& body = bodies_[b];
    const Acting& now = acting_[b];
    body.velocity += 0.5 * step * now.acceleration;
    body.momentum += 0.5 * step * now.torque;
    add_work(b, step, sums);
    body.drift(step);
  }
  /// Forces at the new place.
  void settle(std::size_t b, Sums&) {
    const Body& body = bodies_[b];
    if (!body.movable()) return;
    auto [force, moment] = gather(b);
    force += loads_[b].force + held_fraction_ * held_[b].force;
    force[Dim - 1] -= body.mass * settings_.gravity;
    moment += loads_[b].moment + held_fraction_ * held_[b].moment;
    Acting& now = acting_[b];
    now.torque = to_body(static_cast<int>(b), moment);
    if (settings_.local_damping > 0) {
      now.damping = opposed(force, body.velocity);
      now.damping_torque = opposed(now.torque, body.momentum);
      force += now.damping;
      now.torque += now.damping_torque;
    }
    now.acceleration = force / body.mass;
  }
  /// Second half kick.
  void finish(std::size_t b, double step, Sums& sums) {
    Body& body = bodies_[b];
    const Acting& now = acting_[b];
    add_work(b, step, sums);
    body.velocity += 0.5 * step * now.acceleration;
    body.momentum += 0.5 * step * now.torque;
  }
  /// Work of the present forces over half the way of this step.
  void add_work(std::size_t b, double step, Sums& sums) const {
    const Body& body = bodies_[b];
    const Vec<Dim> way = 0.5 * step * body.velocity;
    sums.gravity -= body.mass * settings_.gravity * way[Dim - 1];
    if (settings_.local_damping > 0)
      sums.damping -=
          acting_[b].damping.dot(way) + 0.5 * step * acting_[b].damping_torque.dot(body.spin());
    sums.loads += (loads_[b].force + held_fraction_ * held_[b].force).dot(way);
    const Spin<Dim> moment = loads_[b].moment + held_fraction_ * held_[b].moment;
    if (!moment.isZero(0))
      sums.loads += 0.5 * step * to_body(static_cast<int>(b), moment).dot(body.spin());
  }
  template <class V>
  [[nodiscard]] V opposed(const V& force, const V& velocity) const {
    V damping = V::Zero();
    for (Eigen::Index k = 0; k < force.size(); ++k)
      if (velocity[k] != 0)
        damping[k] = -settings_.local_damping * std::copysign(std::abs(force[k]), velocity[k]);
    return damping;
  }

  DynamicsSettings settings_;
  Joints joints_;
  Walls walls_;
  std::unique_ptr<ThreadTeam> team_;
  Vec<Dim> origin_ = Vec<Dim>::Zero();
  std::vector<std::pair<Shape, int>> shapes_;
  std::vector<Body> bodies_;
  std::vector<Load> loads_, held_;
  double held_fraction_ = 0;
  std::vector<char> is_wall_;
  std::vector<char> is_stale_;    ///< its contacts have changed since `stiffest_` was computed
  std::vector<double> stiffest_;  ///< stiffness over mass of every body [1/s^2]
  std::vector<Acting> acting_;
  std::optional<ContactTracker<Dim>> tracker_;
  std::vector<WeightedPoint<Dim>> places_;
  std::vector<Reaction<Dim>> reactions_;
  std::vector<std::uint32_t> first_end_;
  std::vector<End> ends_;
  std::vector<Sums> sums_{1};
  EnergyAudit audit_;
  double kinetic_at_start_ = 0, contacts_at_start_ = 0;
  double refresh_ = 0;
  double time_ = 0, step_ = 0, stable_step_ = 0;
  std::int64_t steps_ = 0;
  bool begun_ = false, fresh_ = false;
};

}  // namespace voussoir
