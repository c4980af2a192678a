// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/laws_by_set.hpp>
#include <voussoir/contact/smooth_wall.hpp>
#include <voussoir/model/contact_points.hpp>
#include <voussoir/model/contact_renewal.hpp>
#include <voussoir/model/contact_tracker.hpp>
#include <voussoir/model/moving_bodies.hpp>
#include <voussoir/model/moving_contacts.hpp>

namespace voussoir {

/// All contacts of bodies that move, in three groups: joints between blocks, smooth walls around
/// them, and the interface between rock and lining.
///
/// Contacts are numbered in one row, group after group. Every body has the list of its contacts, in
/// which their forces are summed: always in the same order.
template <int Dim, class JointLaw, class InterfaceLaw = CoulombJoint>
class ContactNetwork {
 public:
  using Body = MovingBody<Dim>;
  using Bodies = std::vector<Body>;
  using Joints = MovingContacts<Dim, JointLaw>;
  using Walls = MovingContacts<Dim, SmoothWall>;
  using Interface = MovingContacts<Dim, InterfaceLaw>;
  using Tracker = ContactTracker<Dim>;
  static constexpr int dof = Dim + spin_count<Dim>;

  /// @param viscous_damping  ratio to critical of the dashpots [-]
  ContactNetwork(const LawsBySet<JointLaw>& laws, ContactPoints rule, double viscous_damping)
      : groups_(Joints(laws.all()), Walls({SmoothWall(laws.stiffest())}), Interface({})),
        rule_(rule),
        viscous_damping_(viscous_damping) {}

  [[nodiscard]] const Joints& joints() const { return std::get<0>(groups_); }
  [[nodiscard]] const Interface& interface() const { return std::get<2>(groups_); }
  [[nodiscard]] std::size_t size() const {
    std::size_t sum = 0;
    each_group([&](const auto& group) { sum += group.size(); });
    return sum;
  }

  /// Calls visit(group, contact) for every contact of all groups.
  template <class Visit>
  void each(Visit&& visit) {
    each_group([&](auto& group) {
      for (auto& c : group.contacts()) visit(group, c);
    });
  }
  template <class Visit>
  void each(Visit&& visit) const {
    each_group([&](const auto& group) {
      for (const auto& c : group.contacts()) visit(group, c);
    });
  }

  /// Rock touches these bodies, nodes of one lining, by this law.
  /// @param first  of the bodies;  @param count  of them
  void set_interface_law(const InterfaceLaw& law, int first, int count) {
    const std::int32_t number = std::get<2>(groups_).add_law(law);
    interface_law_of_.resize(index(first + count), -1);
    std::fill(interface_law_of_.begin() + first, interface_law_of_.end(), number);
  }

  /// Gives every contact that is open by no more than `closed` [m] the traction of a stress field,
  /// and makes it the one without opening.
  template <class StressAt>
  void prescribe(const Bodies& bodies, StressAt&& stress_at, double closed) {
    each([&](auto& group, const auto& c) {
      const Pose<Dim>&a = bodies[index(c.a)].pose, &b = bodies[index(c.b)].pose;
      const auto at = c.place(a, b);
      for (auto i = index(c.first); i < index(c.last); ++i)
        if (std::abs(group.points()[i].motion(at).opening) > closed) return;
      const Rotation<Dim> frame = a.rotation * c.frame;
      for (auto i = index(c.first); i < index(c.last); ++i) {
        auto& p = group.points()[i];
        const Vec<Dim> traction = stress_at(b(p.place)) * column(frame, 0);
        const Vec<Dim> force = p.weight * (transposed(frame) * traction);
        p.initial = {force[0], part<Dim - 1>(force, 1)};
        p.zero[0] += p.motion(at).opening;
      }
    });
  }

  /// Updates contacts where bodies have moved.
  /// @param roles   of every body
  /// @param law_of  law_of(shape, normal): index of the law of the face of a shape that looks
  /// there
  /// @param gained  energy that springs gain by their new form is added to it [J]
  /// @return  true if anything has changed
  template <class LawOf>
  bool find(Tracker& tracker, const Bodies& bodies, const std::vector<BodyRole>& roles,
            LawOf&& law_of, double& gained) {
    // Bodies may have come since.
    is_stale_.resize(bodies.size(), 1);
    stiffest_.resize(bodies.size(), 0);
    bool changed = false, relisted = first_end_.size() != bodies.size() + 1;
    const auto kind_of = [&](const typename Tracker::Pair& pair) {
      const BodyRole a = roles[index(tracker.body_of(pair.a))],
                     b = roles[index(tracker.body_of(pair.b))];
      if (a == BodyRole::wall || b == BodyRole::wall) return std::size_t{1};
      return a == BodyRole::lining || b == BodyRole::lining ? std::size_t{2} : std::size_t{0};
    };
    tracker.update(
        bodies,
        [&](typename Tracker::Pair& pair, const Contact<Dim>& found) {
          group_of_kind(kind_of(pair), [&](auto& group, std::size_t kind) {
            const bool in_place = renew(group, tracker, pair, found, bodies, kind, law_of, gained);
            relisted = relisted || !in_place;
          });
          changed = true;
        },
        [&](typename Tracker::Pair& pair) {
          group_of_kind(kind_of(pair), [&](auto& group, std::size_t) {
            gained -= group.stored_energy(index(pair.contact), bodies);
            auto& contact = group.contacts()[index(pair.contact)];
            contact.last = contact.first;
          });
          pair.contact = -1;
          ++unused_;
          is_stale_[index(tracker.body_of(pair.a))] = 1;
          is_stale_[index(tracker.body_of(pair.b))] = 1;
          relisted = changed = true;
        });
    if (relisted) {
      if (unused_ > size() / 16) tidy(tracker, kind_of);
      list(bodies.size());
    }
    return changed;
  }

  /// Other laws for the joints from now on: as many, of the same kind.
  void set_laws(const LawsBySet<JointLaw>& laws) { std::get<0>(groups_).set_laws(laws.all()); }

  /// Computes what contacts first, ..., last - 1 do, history brought up to date.
  void react(std::size_t first, std::size_t last, const Bodies& bodies, Dissipation& lost);
  /// Force and moment of all contacts on a body, as last computed; world axes.
  [[nodiscard]] std::pair<Vec<Dim>, Spin<Dim>> gather(std::size_t b) const;

  [[nodiscard]] double stored_energy(const Bodies& bodies) const {
    double sum = 0;
    each_group([&](const auto& group) {
      for (std::size_t k = 0; k < group.size(); ++k) sum += group.stored_energy(k, bodies);
    });
    return sum;
  }

  /// A bound on the largest eigenvalue of M^-1 K of every body, all others fixed, its contacts
  /// closed and sticking: the largest sum of a row [1/s^2].
  [[nodiscard]] const std::vector<double>& stiffness_over_mass(const Bodies& bodies) {
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (is_stale_[b]) {
        is_stale_[b] = 0;
        stiffest_[b] = bodies[b].movable() ? largest_row(b, bodies) : 0.0;
      }
    return stiffest_;
  }

 private:
  using Stiffness = Fixed<dof, dof>;
  /// One end of a contact, as its body sees it.
  struct End {
    std::uint32_t contact;
    std::uint32_t end;  ///< 0: body a, 1: body b
    [[nodiscard]] double sign() const { return 2.0 * end - 1.0; }
  };

  template <class T>
  [[nodiscard]] static std::size_t index(T i) {
    return static_cast<std::size_t>(i);
  }

  template <class Visit>
  void each_group(Visit&& visit) {
    std::apply([&](auto&... group) { (visit(group), ...); }, groups_);
  }
  template <class Visit>
  void each_group(Visit&& visit) const {
    std::apply([&](const auto&... group) { (visit(group), ...); }, groups_);
  }
  /// Calls visit(group, kind).
  /// @param kind  0: joints, 1: walls, 2: interface
  template <class Visit>
  void group_of_kind(std::size_t kind, Visit&& visit) {
    std::size_t k = 0;
    each_group([&](auto& group) {
      if (k++ == kind) visit(group, kind);
    });
  }

  /// Gives a pair the contact that was found.
  /// @return  true if the contact has kept its place in the lists
  template <class Group, class LawOf>
  bool renew(Group& group, const Tracker& tracker, typename Tracker::Pair& pair,
             const Contact<Dim>& found, const Bodies& bodies, std::size_t kind, LawOf&& law_of,
             double& gained) {
    const bool of_a = found.touch != Touch::face_b, known = pair.contact >= 0;
    const std::size_t owner = of_a ? pair.a : pair.b;
    const int a = tracker.body_of(owner), b = tracker.body_of(of_a ? pair.b : pair.a);
    std::vector<typename Group::Point> points;
    const typename Group::Contact* const old =
        known ? &group.contacts()[index(pair.contact)] : nullptr;
    detail::ContactRenewal<Dim, typename Group::State> renewal(bodies, group.points());
    typename Group::Contact contact =
        renewal.run(found, tracker.shapes().grid_point(pair.a), tracker.shapes(), owner, a, b,
                    rule_, tracker.reach(), decltype(renewal)::Gaping::facing, old, points);
    if (known)
      contact.law = old->law;
    else if (kind == 0)
      contact.law = law_of(owner, of_a ? found.normal : Vec<Dim>(-found.normal));
    else if (kind == 2)
      contact.law = std::max(interface_law_of(a), interface_law_of(b));  // one of the two is rock
    if (renewal.keeps_history()) keep_shear(group, *old, contact, bodies, points);
    if (viscous_damping_ > 0)
      contact.viscosity = viscosity(
          bodies[index(a)], bodies[index(b)],
          group.law_of(contact).joint_normal_stiffness() * std::max(found.measure, 1e-12));
    const auto count = static_cast<std::int32_t>(points.size());
    const bool in_place = known && a == old->a && count == old->last - old->first;
    if (known) gained -= group.stored_energy(index(pair.contact), bodies);
    if (in_place) {
      contact.first = old->first;
      std::copy(points.begin(), points.end(), group.points().begin() + contact.first);
    } else {
      if (known) ++unused_;
      contact.first = static_cast<std::int32_t>(group.points().size());
      group.points().insert(group.points().end(), points.begin(), points.end());
    }
    contact.last = contact.first + count;
    if (!known) {
      pair.contact = static_cast<std::int32_t>(group.size());
      group.contacts().emplace_back();
    }
    group.contacts()[index(pair.contact)] = contact;
    gained += group.stored_energy(index(pair.contact), bodies);
    is_stale_[index(a)] = is_stale_[index(b)] = 1;
    return in_place;
  }

  /// -1: no node of a lining.
  [[nodiscard]] std::int32_t interface_law_of(int body) const {
    return index(body) < interface_law_of_.size() ? interface_law_of_[index(body)] : -1;
  }

  /// Gives the new points of a contact the shear force of the old ones.
  template <class Group>
  static void keep_shear(const Group& group, const typename Group::Contact& old,
                         const typename Group::Contact& contact, const Bodies& bodies,
                         std::vector<typename Group::Point>& points) {
    const auto shear_of = [&](const typename Group::Contact& c, const auto& of) {
      const auto at = c.place(bodies[index(c.a)].pose, bodies[index(c.b)].pose);
      Vec<Dim - 1> sum = zeros<Vec<Dim - 1>>();
      for (const auto& p : of) sum += group.law_of(c).force(p.load(at), p.state).tangential;
      return sum;
    };
    const Vec<Dim - 1> before = shear_of(
        old,
        std::span(group.points()).subspan(index(old.first), index(old.last) - index(old.first)));
    detail::match_shear<Dim>(before, points, [&] { return shear_of(contact, points); });
  }

  /// Dashpot over stiffness so that two blocks on this contact's normal springs are damped with the
  /// ratio wanted: c / k = 2 zeta sqrt(m / k) [s].
  [[nodiscard]] double viscosity(const Body& a, const Body& b, double stiffness) const {
    const double mass =
        a.movable() && b.movable() ? a.mass * b.mass / (a.mass + b.mass) : std::max(a.mass, b.mass);
    return 2 * viscous_damping_ * std::sqrt(mass / stiffness);
  }

  /// Lists every body's contacts; those without points are on no list.
  void list(std::size_t body_count);
  /// Drops what is no longer used, and puts contacts in the order of the pairs.
  template <class KindOf>
  void tidy(Tracker& tracker, KindOf&& kind_of) {
    std::size_t kind = 0;
    each_group([&](auto& group) {
      tidy(group, tracker, [&](const auto& pair) { return kind_of(pair) == kind; });
      ++kind;
    });
    unused_ = 0;
  }
  template <class Group, class Belongs>
  static void tidy(Group& group, Tracker& tracker, Belongs&& belongs) {
    std::vector<typename Group::Contact> contacts;
    std::vector<typename Group::Point> points;
    contacts.reserve(group.size());
    points.reserve(group.points().size());
    for (auto& pair : tracker.pairs()) {
      if (pair.contact < 0 || !belongs(pair)) continue;
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

  [[nodiscard]] double largest_row(std::size_t b, const Bodies& bodies) const;
  /// Adds M^-1/2 G^T K G M^-1/2 of one contact to the matrix of body a or b, in the body's frame.
  template <class Group>
  static void add_springs(const Group& group, std::size_t k, bool on_b, const Bodies& bodies,
                          Stiffness& sum) {
    const auto& c = group.contacts()[k];
    const Body &a = bodies[index(c.a)], &b = bodies[index(c.b)], &body = on_b ? b : a;
    const Rotation<Dim> frame =
        on_b ? Rotation<Dim>(transposed(b.pose.rotation) * (a.pose.rotation * c.frame)) : c.frame;
    const double root = 1 / std::sqrt(body.mass);
    for (auto i = index(c.first); i < index(c.last); ++i) {
      const auto& p = group.points()[i];
      const Vec<Dim> place =
          on_b ? p.place
               : Vec<Dim>(transposed(a.pose.rotation) * (b.pose(p.place) - a.pose.position));
      for (int axis = 0; axis < Dim; ++axis) {
        const Vec<Dim> along = column(frame, axis);
        Fixed<dof, 1> g;
        const Spin<Dim> moment = moment_of(place, along);
        for (int row = 0; row < Dim; ++row) g[row] = root * along[row];
        for (int row = 0; row < spin_count<Dim>; ++row)
          g[Dim + row] = moment[row] / std::sqrt(body.inertia[row]);
        const double stiffness = p.weight * (axis == 0 ? group.law_of(c).joint_normal_stiffness()
                                                       : group.law_of(c).joint_shear_stiffness());
        sum += outer<dof, dof>(stiffness * g, g);
      }
    }
  }

  std::tuple<Joints, Walls, Interface> groups_;
  std::vector<std::int32_t> interface_law_of_;  ///< of every body; -1: it is no node of a lining
  ContactPoints rule_;
  double viscous_damping_;
  std::size_t unused_ = 0;  ///< contacts without points, and points without contact (as runs)
  std::vector<Reaction<Dim>> reactions_;
  std::vector<std::uint32_t> first_end_;  ///< of every body in `ends_`, and one more
  std::vector<End> ends_;
  std::vector<char> is_stale_;    ///< contacts of the body have changed since `stiffest_`
  std::vector<double> stiffest_;  ///< [1/s^2]
};

template <int Dim, class JointLaw, class InterfaceLaw>
void ContactNetwork<Dim, JointLaw, InterfaceLaw>::react(std::size_t first, std::size_t last,
                                                        const Bodies& bodies, Dissipation& lost) {
  std::size_t before = 0;
  each_group([&](auto& group) {
    const std::size_t end = std::min(last, before + group.size());
    for (std::size_t k = std::max(first, before); k < end; ++k)
      reactions_[k] = group.react(k - before, bodies, lost);
    before += group.size();
  });
}

template <int Dim, class JointLaw, class InterfaceLaw>
auto ContactNetwork<Dim, JointLaw, InterfaceLaw>::gather(std::size_t b) const
    -> std::pair<Vec<Dim>, Spin<Dim>> {
  Vec<Dim> force = zeros<Vec<Dim>>();
  Spin<Dim> moment = zeros<Spin<Dim>>();
  for (std::uint32_t k = first_end_[b]; k < first_end_[b + 1]; ++k) {
    const Reaction<Dim>& r = reactions_[ends_[k].contact];
    // No branch: which end of a contact a body is cannot be foreseen.
    force += ends_[k].sign() * r.force;
    moment += r.moment[ends_[k].end];
  }
  return {force, moment};
}

template <int Dim, class JointLaw, class InterfaceLaw>
void ContactNetwork<Dim, JointLaw, InterfaceLaw>::list(std::size_t body_count) {
  reactions_.resize(size());
  first_end_.assign(body_count + 1, 0);
  each([this](const auto&, const auto& c) {
    if (c.first == c.last) return;
    ++first_end_[index(c.a) + 1];
    ++first_end_[index(c.b) + 1];
  });
  for (std::size_t b = 0; b < body_count; ++b) first_end_[b + 1] += first_end_[b];
  ends_.resize(first_end_.back());
  std::vector<std::uint32_t> next(first_end_.begin(), first_end_.end() - 1);
  std::uint32_t k = 0;
  each([&](const auto&, const auto& c) {
    const std::uint32_t contact = k++;
    if (c.first == c.last) return;
    ends_[next[index(c.a)]++] = {contact, 0};
    ends_[next[index(c.b)]++] = {contact, 1};
  });
}

template <int Dim, class JointLaw, class InterfaceLaw>
double ContactNetwork<Dim, JointLaw, InterfaceLaw>::largest_row(std::size_t b,
                                                                const Bodies& bodies) const {
  Stiffness sum = zeros<Stiffness>();
  for (std::uint32_t e = first_end_[b]; e < first_end_[b + 1]; ++e) {
    std::size_t before = 0;
    each_group([&](const auto& group) {
      const std::size_t k = ends_[e].contact - before;  // wraps where it is of a group before
      if (k < group.size()) add_springs(group, k, ends_[e].end == 1, bodies, sum);
      before += group.size();
    });
  }
  double largest = 0;
  for (int r = 0; r < dof; ++r) {
    double absolute = 0;
    for (int k = 0; k < dof; ++k) absolute += std::abs(sum(r, k));
    largest = std::max(largest, absolute);
  }
  return largest;
}

}  // namespace voussoir
