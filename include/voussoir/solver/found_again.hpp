// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/pose.hpp>
#include <voussoir/geometry/cut_facing.hpp>
#include <voussoir/motion/contact_renewal.hpp>
#include <voussoir/motion/contact_tracker.hpp>
#include <voussoir/motion/moving_body.hpp>
#include <voussoir/motion/moving_contacts.hpp>
#include <voussoir/solver/equilibrium.hpp>
#include <voussoir/solver/system.hpp>

namespace voussoir {

namespace detail {

/// Makes a system small-displacement again at the place where its bodies are.
template <class System>
class FoundAgain {
 public:
  static constexpr int dim = System::dim, dof = System::dof;

  explicit FoundAgain(System& system) : system_(system), origin_(system.body(0).centre) {
    for (int b = 0; b < system.body_count(); ++b) {
      then_.push_back(near(system.pose_when_found(b)));
      MovingBody<dim> body;
      body.pose = near(system.pose(b));
      body.mass = system.body(b).movable ? 1 : 0;
      bodies_.push_back(body);
    }
  }

  void run(double reach) {
    for (auto& frame : system_.frames)
      frame.follow(now(frame.i), now(frame.j), system_.displacement.data());
    for (auto& bolt : system_.bolts) turn(bolt);
    auto joints = as_moving(system_.joints);
    auto boundary = as_moving(system_.boundary);
    const auto interface = as_moving(system_.interface);
    ContactTracker<dim> tracker(reach, 0, 4 * reach);
    for (int b = 0; b < static_cast<int>(system_.shapes->size()); ++b) {
      if (system_.body(b).is_gone) continue;
      for (const auto& part : (*system_.shapes)[index(b)]) {
        for (const auto& v : part.vertices())
          bodies_[index(b)].radius =
              std::max(bodies_[index(b)].radius, (v - system_.body(b).centre).norm());
        tracker.add(part, system_.body(b).centre, b, diagonal_of<dim>(1), b);
        parts_.push_back(&part);
      }
    }
    using Pair = typename ContactTracker<dim>::Pair;
    typename System::Joints new_joints(system_.joints.laws());
    typename System::Boundary new_boundary(system_.boundary.laws());
    typename System::Interface new_interface(system_.interface.laws());
    const ByBodies<decltype(joints)> of_joints(joints, bodies_);
    const ByBodies<decltype(boundary)> of_boundary(boundary, bodies_);
    system_.set_found();
    tracker.update(
        bodies_,
        [&](const Pair& pair, const Contact<dim>& found) {
          const bool of_block = system_.body(tracker.body_of(pair.a)).is_block &&
                                system_.body(tracker.body_of(pair.b)).is_block;
          if (of_block)
            renew(joints, of_joints, tracker, pair, found, new_joints);
          else
            renew(boundary, of_boundary, tracker, pair, found, new_boundary);
        },
        [](const Pair&) {});
    for (const auto& c : interface.contacts())
      add(interface, c, points_of(interface, c), new_interface);
    system_.joints = std::move(new_joints);
    system_.boundary = std::move(new_boundary);
    system_.interface = std::move(new_interface);
  }

 private:
  [[nodiscard]] static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  /// Positions are kept near 0, whatever the site's coordinates.
  [[nodiscard]] Pose<dim> near(Pose<dim> pose) const {
    pose.position -= origin_;
    return pose;
  }
  [[nodiscard]] const Pose<dim>& now(int b) const { return bodies_[index(b)].pose; }
  /// How a body has turned since contacts were found.
  [[nodiscard]] Rotation<dim> turn_of(int b) const {
    return now(b).rotation * transposed(then_[index(b)].rotation);
  }

  /// Contacts as points fixed in bodies that may move by any amount.
  template <class Law>
  [[nodiscard]] MovingContacts<dim, Law> as_moving(
      const ContactGroup<typename System::GeometryType, Law>& group) const {
    MovingContacts<dim, Law> moving(group.laws());
    const double* found_at = system_.has_found_again() ? system_.found_at().data() : nullptr;
    for (const auto& c : group.contacts()) {
      const Pose<dim>&a = then_[index(c.a)], &b = then_[index(c.b)];
      const Rotation<dim> frame = contact_frame<dim>(c.normal, c.tangents);
      typename MovingContacts<dim, Law>::Contact contact;
      contact.frame = transposed(a.rotation) * frame;
      contact.a = c.a;
      contact.b = c.b;
      contact.first = c.first;
      contact.last = c.last;
      contact.law = c.law;
      const auto at = MovingContacts<dim, Law>::place_of(contact, a, b);
      for (int k = c.first; k < c.last; ++k) {
        const auto& p = group.points()[index(k)];
        typename MovingContacts<dim, Law>::Point point{};
        point.place = transposed_product(b.rotation, Vec<dim>(c.arm_b + group.offset_of(c, p)));
        point.weight = p.weight;
        point.initial = p.initial;
        point.state = p.state;
        point.zero = zeros<Vec<dim>>();
        const PointMotion<dim> raw = MovingContacts<dim, Law>::motion_of(point, at);
        Vec<dim> motion = p.start;
        if (found_at != nullptr) motion += group.linear_motion(c, p, found_at);
        point.zero = stacked(raw.opening - motion[0], raw.slip - part<dim - 1>(motion, 1));
        moving.points().push_back(point);
      }
      moving.contacts().push_back(contact);
    }
    return moving;
  }

  /// Contacts of one group, found by their bodies and their place.
  template <class Group>
  class ByBodies {
   public:
    ByBodies(const Group& group, const std::vector<MovingBody<dim>>& bodies)
        : group_(group), bodies_(bodies) {
      for (std::size_t k = 0; k < group.size(); ++k) order_.push_back(k);
      std::sort(order_.begin(), order_.end(), [&](std::size_t x, std::size_t y) {
        return std::pair(key(x), x) < std::pair(key(y), y);
      });
    }
    /// The contact of these bodies that is nearest to a place, its normal turned by less than 60
    /// degrees; or null.
    [[nodiscard]] const typename Group::Contact* nearest(int a, int b, const Vec<dim>& normal,
                                                         const Vec<dim>& place) const {
      const std::pair<int, int> wanted = std::minmax(a, b);
      auto it = std::lower_bound(order_.begin(), order_.end(), wanted,
                                 [&](std::size_t x, const auto& value) { return key(x) < value; });
      const typename Group::Contact* best = nullptr;
      double least = std::numeric_limits<double>::infinity();
      for (; it != order_.end() && key(*it) == wanted; ++it) {
        const auto& c = group_.contacts()[*it];
        const Vec<dim> was = bodies_[index(c.a)].pose.rotation * column(c.frame, 0);
        if (std::abs(was.dot(normal)) < 0.5) continue;
        for (int k = c.first; k < c.last; ++k) {
          const double distance =
              (bodies_[index(c.b)].pose(group_.points()[index(k)].place) - place).squaredNorm();
          if (distance >= least) continue;
          least = distance;
          best = &c;
        }
      }
      return best;
    }

   private:
    [[nodiscard]] std::pair<int, int> key(std::size_t k) const {
      const auto& c = group_.contacts()[k];
      return std::minmax(c.a, c.b);
    }
    const Group& group_;
    const std::vector<MovingBody<dim>>& bodies_;
    std::vector<std::size_t> order_;
  };

  template <class Group, class Tracker, class Pair, class NewGroup>
  void renew(const Group& group, const ByBodies<Group>& by_bodies, const Tracker& tracker,
             const Pair& pair, const Contact<dim>& found, NewGroup& to) const {
    const bool of_a = found.touch != Touch::face_b;
    const std::size_t owner = of_a ? pair.a : pair.b;
    const int a = tracker.body_of(owner), b = tracker.body_of(of_a ? pair.b : pair.a);
    Vec<dim> middle = zeros<Vec<dim>>();
    for (const Vec<dim>& p : found.polygon) middle += p;
    middle /= static_cast<double>(found.polygon.size());
    std::vector<typename Group::Point> points;
    // Where a joint gapes it closes at an edge: only corner points lie there.
    const Rotation<dim> turn = transposed(now(a).rotation) * now(b).rotation;
    const bool gapes = (turn - diagonal_of<dim>(1)).norm() > gaping;
    const ContactPoints rule = gapes ? ContactPoints::corners : ContactPoints::gauss;
    const typename Group::Contact* const old = by_bodies.nearest(a, b, found.normal, middle);
    auto contact = ContactRenewal<dim, Group>(bodies_, group)
                       .run(found, tracker.shapes()[owner], a, b, rule, old, points);
    contact.law = old != nullptr ? old->law : law_of(group, owner, a, of_a, found);
    if (!points.empty()) add(group, contact, points, to);
  }

  /// Of a contact that is new: the law of the face that is touched.
  template <class Group>
  [[nodiscard]] int law_of(const Group& group, std::size_t owner, int a, bool of_a,
                           const Contact<dim>& found) const {
    if (group.laws().size() < 2 || system_.law_of_cut == nullptr) return 0;
    const Vec<dim> normal =
        transposed(now(a).rotation) * (of_a ? found.normal : Vec<dim>(-found.normal));
    const int cut = cut_facing(*parts_[owner], normal);
    return cut >= 0 && index(cut) < system_.law_of_cut->size() ? (*system_.law_of_cut)[index(cut)]
                                                               : 0;
  }

  template <class Group>
  [[nodiscard]] static std::span<const typename Group::Point> points_of(
      const Group& group, const typename Group::Contact& c) {
    return {group.points().data() + c.first, static_cast<std::size_t>(c.last - c.first)};
  }

  /// The contact where it is now, for small displacements from there.
  template <class Group, class NewGroup>
  void add(const Group&, const typename Group::Contact& c,
           std::span<const typename Group::Point> points, NewGroup& to) const {
    const Pose<dim>&a = now(c.a), &b = now(c.b);
    const Rotation<dim> frame = a.rotation * c.frame;
    typename NewGroup::Contact contact{};
    contact.normal = column(frame, 0);
    contact.tangents = frame.template rightCols<dim - 1>();
    contact.a = c.a;
    contact.b = c.b;
    contact.law = c.law;
    Vec<dim> middle = zeros<Vec<dim>>();
    double whole = 0;
    for (const auto& p : points) {
      middle += p.weight * b(p.place);
      whole += p.weight;
    }
    middle /= whole;
    contact.arm_a = middle - a.position;
    contact.arm_b = middle - b.position;
    const auto at = Group::place_of(c, a, b);
    std::vector<typename NewGroup::Point> flat;
    for (const auto& p : points) {
      typename NewGroup::Point point{};
      point.offset = transposed(frame) * (b(p.place) - middle);
      point.weight = p.weight;
      point.initial = p.initial;
      point.state = p.state;
      const PointMotion<dim> motion = Group::motion_of(p, at);
      point.start = stacked(motion.opening, motion.slip);
      point.start -= to.linear_motion(contact, point, system_.displacement.data());
      flat.push_back(point);
    }
    to.add(contact, flat);
  }

  template <class Bolt>
  void turn(Bolt& bolt) const {
    const double* u = system_.displacement.data();
    const double* found_at = system_.has_found_again() ? system_.found_at().data() : nullptr;
    const BoltSpan<dim> was = found_at != nullptr ? bolt.span_at(found_at) : bolt.span;
    const Vec<dim> initial = was.initial;
    const Rotation<dim> turn_a = turn_of(bolt.a), turn_b = turn_of(bolt.b);
    // Of a point of b against one of a, since contacts were found.
    const auto moved = [&](const Vec<dim>& on_a, const Vec<dim>& on_b) {
      return Vec<dim>(
          (now(bolt.b).position + turn_b * on_b) - (then_[index(bolt.b)].position + on_b) -
          (now(bolt.a).position + turn_a * on_a) + (then_[index(bolt.a)].position + on_a));
    };
    const Vec<dim> span = initial + was.motion + moved(bolt.arm_a, bolt.arm_b);
    const Vec<dim> jump = was.jump + moved(bolt.joint_a, bolt.joint_b);
    for (Vec<dim>* arm : {&bolt.arm_a, &bolt.joint_a}) *arm = turn_a * *arm;
    for (Vec<dim>* arm : {&bolt.arm_b, &bolt.joint_b}) *arm = turn_b * *arm;
    bolt.span = {turn_a * initial, turn_a * was.axis, zeros<Vec<dim>>()};
    const BoltSpan<dim> linear = bolt.span_at(u);
    bolt.span.motion = span - bolt.span.initial - linear.motion;
    bolt.span.jump = jump - linear.jump;
  }

  static constexpr double gaping = 0.01;  ///< of two bodies against each other [rad], about

  System& system_;
  Vec<dim> origin_;
  std::vector<MovingBody<dim>> bodies_;               ///< where they are
  std::vector<Pose<dim>> then_;                       ///< when contacts were found
  std::vector<const typename System::Shape*> parts_;  ///< in the order of the tracker's shapes
};

}  // namespace detail

/// Finds the contacts of a system again where its bodies are now, history carried over, and turns
/// bolts and frames with them: displacements from here on are small against this state.
///
/// A lining keeps its contacts with the rock, which turn with it; blocks that leave their place do
/// not find it elsewhere.
///
/// @param reach  contacts may be so far open [m]
/// @throws InvalidInput  the system does not know the shapes of its bodies
/// @cost   about 3 microseconds a contact
template <class System>
void find_contacts_again(System& system, double reach) {
  if (system.shapes == nullptr)
    throw InvalidInput("find_contacts_again: the system does not know the shapes of its bodies");
  detail::FoundAgain<System>(system).run(reach);
}

namespace detail {

/// Whether blocks have moved so far that contacts are to be updated. Where the limit on that is
/// no shorter than the one beyond which a block is detached, they never are.
template <class System>
[[nodiscard]] bool is_due(const System& system, const Acceptance& acceptance, double share = 1) {
  return system.shapes != nullptr && acceptance.refind_limit < acceptance.displacement_limit &&
         system.moved_since_found() > share * acceptance.refind_limit;
}

/// Updates contacts if it is due.
///
/// Where contacts have been updated before, an equilibrium is looked at from near by: rotations
/// are finite there, and linear ones are off by half their square.
/// @param at_rest  the search is about to end here
/// @return  true if it has
template <class System>
bool find_when_due(System& system, const Acceptance& acceptance, bool at_rest = false) {
  const bool near_by = at_rest && system.has_found_again();
  if (!is_due(system, acceptance, near_by ? 0.05 : 1.0)) return false;
  find_contacts_again(system, 2 * acceptance.refind_limit);
  return true;
}

}  // namespace detail

}  // namespace voussoir
