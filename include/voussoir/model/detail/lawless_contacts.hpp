// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/geometry/cut_facing.hpp>
#include <voussoir/model/contact_group.hpp>
#include <voussoir/model/contact_renewal.hpp>
#include <voussoir/model/contact_tracker.hpp>
#include <voussoir/model/detail/contact_shares.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contacts.hpp>

namespace voussoir::detail {

/// The point of the former contacts whose memory a point inherits.
struct FormerPoint {
  std::int32_t number = -1;  ///< -1: none
};

/// Contacts of one kind without their laws: what a law remembers follows its point by number.
template <int Dim>
struct LawlessContacts {
  bool has_many_laws = false;
  std::vector<ReferenceContact<Dim>> contacts;
  std::vector<ReferencePoint<Dim>> points;
  std::vector<FormerPoint> former;  ///< for every point
};

/// Finds the contacts of bodies where they are now, and makes that the reference configuration.
///
/// Bodies that would hang on nothing keep all points of what is nearest, also those beyond the
/// reach: without a spring the elastic equations of the rock that is left have no solution.
///
/// It is the same for all contact laws, and compiled once.
template <int Dim>
class ContactUpdate {
 public:
  using Contacts = LawlessContacts<Dim>;
  using Tracker = ContactTracker<Dim>;
  using Shape = typename Tracker::Shape;

  /// @param reach         contacts may be so far open [m]
  /// @param displacement  present, `dof` values a body
  /// @param found_at      that of the reference configuration so far; empty: the in-situ state
  /// @param law_of_cut    for every label of a face the index of the joint law; null: the first
  /// @pre the vectors outlive this, and do not change
  ContactUpdate(double reach, const Eigen::VectorXd& displacement, const Eigen::VectorXd& found_at,
                const std::vector<int>* law_of_cut)
      : displacement_(displacement),
        found_at_(found_at),
        law_of_cut_(law_of_cut),
        tracker_(reach, 0, 4 * reach) {}

  /// @param then, now  in the reference configuration so far, and at present
  void add_body(const Pose<Dim>& then, const Pose<Dim>& now, bool is_movable, bool is_block) {
    then_.push_back(then);
    MovingBody<Dim> body;
    body.pose = now;
    body.mass = is_movable ? 1 : 0;
    bodies_.push_back(body);
    is_block_.push_back(is_block);
    part_count_.push_back(0);
  }
  /// A convex part of a body in the in-situ state. @pre it outlives this
  /// @param centre  of the body then [m]
  void add_part(int body, const Shape& part, const Vec<Dim>& centre);

  [[nodiscard]] const Pose<Dim>& now(int b) const { return bodies_[index(b)].pose; }
  [[nodiscard]] const Pose<Dim>& then(int b) const { return then_[index(b)]; }
  /// How a body has turned since contacts were found.
  [[nodiscard]] Rotation<Dim> turn_of(int b) const {
    return now(b).rotation * transposed(then(b).rotation);
  }

  /// Replaces the contacts of all bodies. Those with a lining are not looked for again: they turn
  /// with the rock.
  /// @param progress  asked now and then whether to go on
  /// @throws Stopped  with contacts that are of no more use
  void run(Contacts& joints, Contacts& boundary, Contacts& interface, const Progress& progress);

 private:
  using Contact = MovingContact<Dim>;
  using Point = MovingContactPoint<Dim, FormerPoint>;
  using Pair = typename Tracker::Pair;
  static constexpr double gaping = 0.01;  ///< of two bodies against each other [rad], about

  /// Contacts with their points fixed in bodies that may move by any amount.
  struct Springs {
    bool has_many_laws;
    std::vector<Contact> contacts;
    std::vector<Point> points;
    std::vector<std::pair<int, int>> bodies;  ///< the lower first
    std::vector<int> order;                   ///< of contacts, by their bodies
  };

  template <class Number>
  [[nodiscard]] static std::size_t index(Number i) {
    return static_cast<std::size_t>(i);
  }

  [[nodiscard]] Springs as_moving(const Contacts& group) const;
  /// The contact of these bodies that is nearest to a place, its normal turned by less than 60
  /// degrees; or null.
  [[nodiscard]] const Contact* nearest(const Springs& group, int a, int b, const Vec<Dim>& normal,
                                       const Vec<Dim>& place) const;
  /// Marks bodies that no chain of contacts, of `Dim` points at least, joins to a fixed one.
  /// @return  whether there are any
  bool find_loose(const Contacts& joints, const Contacts& boundary,
                  std::vector<char>& is_loose) const;
  /// @param reach, joined  see ContactRenewal
  void renew(const Springs& group, const Pair& pair, const voussoir::Contact<Dim>& found,
             const ContactArea<Dim>* joined, double reach, Contacts& to) const;
  /// Whether the shapes may have but a share of a contact.
  [[nodiscard]] bool is_share(const Pair& pair, const voussoir::Contact<Dim>& found) const {
    return found.touch != Touch::edge_edge && (part_count_[index(tracker_.body_of(pair.a))] > 1 ||
                                               part_count_[index(tracker_.body_of(pair.b))] > 1);
  }
  /// The label of the faces that touch if they are of one cut, else -1.
  [[nodiscard]] int cut_of(const Pair& pair, const voussoir::Contact<Dim>& found) const;
  /// Of a contact that is new: the law of the face that is touched.
  [[nodiscard]] int law_of(std::size_t owner, int a, const Vec<Dim>& normal) const;
  /// Adds the contact where it is now, for small displacements from there.
  void add(const Contact& c, std::span<const Point> points, Contacts& to) const;

  const Eigen::VectorXd &displacement_, &found_at_;
  const std::vector<int>* law_of_cut_;
  Tracker tracker_;
  std::vector<MovingBody<Dim>> bodies_;  ///< where they are
  std::vector<Pose<Dim>> then_;          ///< when contacts were found
  std::vector<bool> is_block_;
  std::vector<const Shape*> parts_;  ///< in the order of the tracker's shapes
  std::vector<int> part_count_;      ///< of every body
};

template <int Dim>
void ContactUpdate<Dim>::add_part(int body, const Shape& part, const Vec<Dim>& centre) {
  double& radius = bodies_[index(body)].radius;
  for (const Vec<Dim>& v : part.vertices()) radius = std::max(radius, (v - centre).norm());
  tracker_.add(part, centre, body, diagonal_of<Dim>(1), body);
  parts_.push_back(&part);
  ++part_count_[index(body)];
}

template <int Dim>
void ContactUpdate<Dim>::run(Contacts& joints, Contacts& boundary, Contacts& interface,
                             const Progress& progress) {
  struct Seen {
    Pair pair;
    voussoir::Contact<Dim> found;
    std::vector<Vec<Dim>> polygon;
    ContactArea<Dim> area;  ///< if several pairs share the contact, else empty
    bool of_blocks;
  };
  std::vector<Seen> seen;
  const auto note = [&](const Pair& pair, const voussoir::Contact<Dim>& found,
                        const ContactArea<Dim>* area, bool of_blocks) {
    seen.push_back({pair,
                    found,
                    {found.polygon.begin(), found.polygon.end()},
                    area != nullptr ? *area : ContactArea<Dim>{},
                    of_blocks});
  };
  StopCheck stop(progress);
  const Springs of_joints = as_moving(joints), of_boundary = as_moving(boundary),
                of_interface = as_moving(interface);
  for (Contacts* group : {&joints, &boundary, &interface}) {
    group->contacts.clear();
    group->points.clear();
    group->former.clear();
  }
  ContactShares<Dim> shares_of_joints(tracker_), shares_of_boundary(tracker_);
  tracker_.update(
      bodies_,
      [&](const Pair& pair, const voussoir::Contact<Dim>& found) {
        stop();
        const bool of_blocks = is_block_[index(tracker_.body_of(pair.a))] &&
                               is_block_[index(tracker_.body_of(pair.b))];
        if (is_share(pair, found))
          (of_blocks ? shares_of_joints : shares_of_boundary).add(pair, found, cut_of(pair, found));
        else
          note(pair, found, nullptr, of_blocks);
      },
      [](const Pair&) {});
  shares_of_joints.join([&](const auto& pair, const auto& found, const auto* area) {
    note(pair, found, area, true);
  });
  shares_of_boundary.join([&](const auto& pair, const auto& found, const auto* area) {
    note(pair, found, area, false);
  });
  const auto renew_all = [&](const std::vector<char>& is_loose) {
    for (Contacts* group : {&joints, &boundary}) *group = {group->has_many_laws, {}, {}, {}};
    for (Seen& it : seen) {
      stop();
      const bool loose = is_loose[index(tracker_.body_of(it.pair.a))] != 0 ||
                         is_loose[index(tracker_.body_of(it.pair.b))] != 0;
      it.found.polygon = it.polygon;
      renew(it.of_blocks ? of_joints : of_boundary, it.pair, it.found,
            it.area.facets().empty() ? nullptr : &it.area,
            loose ? std::numeric_limits<double>::infinity() : tracker_.reach(),
            it.of_blocks ? joints : boundary);
    }
  };
  std::vector<char> is_loose(bodies_.size(), 0);
  renew_all(is_loose);
  if (find_loose(joints, boundary, is_loose)) renew_all(is_loose);
  for (const Contact& c : of_interface.contacts)
    add(c, {of_interface.points.data() + c.first, index(c.last - c.first)}, interface);
}

template <int Dim>
bool ContactUpdate<Dim>::find_loose(const Contacts& joints, const Contacts& boundary,
                                    std::vector<char>& is_loose) const {
  std::vector<int> group(bodies_.size());
  for (std::size_t b = 0; b < group.size(); ++b) group[b] = static_cast<int>(b);
  const auto root = [&](int b) {
    while (group[index(b)] != b) b = group[index(b)] = group[index(group[index(b)])];
    return b;
  };
  for (const Contacts* contacts : {&joints, &boundary})
    for (const ReferenceContact<Dim>& c : contacts->contacts)
      if (c.last - c.first >= Dim) group[index(root(c.a))] = root(c.b);
  std::vector<char> is_held(bodies_.size(), 0);
  for (std::size_t b = 0; b < group.size(); ++b)
    if (!bodies_[b].movable()) is_held[index(root(static_cast<int>(b)))] = 1;
  bool any = false;
  for (std::size_t b = 0; b < group.size(); ++b) {
    is_loose[b] = is_held[index(root(static_cast<int>(b)))] == 0;
    any = any || is_loose[b] != 0;
  }
  return any;
}

template <int Dim>
auto ContactUpdate<Dim>::as_moving(const Contacts& group) const -> Springs {
  Springs moving{group.has_many_laws, {}, {}, {}, {}};
  for (const ReferenceContact<Dim>& c : group.contacts) {
    const Pose<Dim>&a = then(c.a), &b = then(c.b);
    Contact contact;
    contact.frame = transposed(a.rotation) * contact_frame<Dim>(c.normal, c.tangents);
    contact.a = c.a;
    contact.b = c.b;
    contact.first = c.first;
    contact.last = c.last;
    contact.law = c.law;
    const auto at = contact.place(a, b);
    for (int k = c.first; k < c.last; ++k) {
      const ReferencePoint<Dim>& p = group.points[index(k)];
      Point point{};
      point.place = transposed_product(b.rotation, Vec<Dim>(c.arm_b + c.offset_of(p)));
      point.weight = p.weight;
      point.initial = p.initial;
      point.state.number = k;
      point.zero = zeros<Vec<Dim>>();
      const PointMotion<Dim> raw = point.motion(at);
      Vec<Dim> motion = p.start;
      if (found_at_.size() > 0) motion += c.linear_motion(p, found_at_.data());
      point.zero = stacked(raw.opening - motion[0], raw.slip - part<Dim - 1>(motion, 1));
      moving.points.push_back(point);
    }
    moving.contacts.push_back(contact);
    moving.bodies.emplace_back(std::minmax(c.a, c.b));
  }
  moving.order = order_of_pairs(moving.bodies, static_cast<int>(bodies_.size()));
  return moving;
}

template <int Dim>
auto ContactUpdate<Dim>::nearest(const Springs& group, int a, int b, const Vec<Dim>& normal,
                                 const Vec<Dim>& place) const -> const Contact* {
  const std::pair<int, int> wanted = std::minmax(a, b);
  auto it = std::lower_bound(
      group.order.begin(), group.order.end(), wanted,
      [&](int x, const std::pair<int, int>& value) { return group.bodies[index(x)] < value; });
  const Contact* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (; it != group.order.end() && group.bodies[index(*it)] == wanted; ++it) {
    const Contact& c = group.contacts[index(*it)];
    const Vec<Dim> was = now(c.a).rotation * column(c.frame, 0);
    if (std::abs(was.dot(normal)) < 0.5) continue;
    for (int k = c.first; k < c.last; ++k) {
      const double distance = (now(c.b)(group.points[index(k)].place) - place).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      best = &c;
    }
  }
  return best;
}

template <int Dim>
void ContactUpdate<Dim>::renew(const Springs& group, const Pair& pair,
                               const voussoir::Contact<Dim>& found, const ContactArea<Dim>* joined,
                               double reach, Contacts& to) const {
  const Vec<Dim>& from = tracker_.shapes().grid_point(pair.a);
  const bool of_a = found.touch != Touch::face_b;
  const std::size_t owner = of_a ? pair.a : pair.b;
  const int a = tracker_.body_of(owner), b = tracker_.body_of(of_a ? pair.b : pair.a);
  Vec<Dim> middle = zeros<Vec<Dim>>();
  for (const Vec<Dim>& p : found.polygon) middle += p;
  middle /= static_cast<double>(found.polygon.size());
  middle += from;
  // Where a joint gapes it closes at an edge: only corner points lie there.
  const Rotation<Dim> turn = transposed(now(a).rotation) * now(b).rotation;
  const bool gapes = (turn - diagonal_of<Dim>(1)).norm() > gaping;
  const ContactPoints rule = gapes ? ContactPoints::corners : ContactPoints::gauss;
  const Contact* const old = nearest(group, a, b, found.normal, middle);
  std::vector<Point> points;
  using Renewal = ContactRenewal<Dim, FormerPoint>;
  Contact contact = Renewal(bodies_, group.points)
                        .run(found, from, tracker_.shapes(), owner, a, b, rule, reach,
                             Renewal::Gaping::known, old, points, joined);
  contact.law = old != nullptr ? old->law
                : group.has_many_laws
                    ? law_of(owner, a, of_a ? found.normal : Vec<Dim>(-found.normal))
                    : 0;
  if (!points.empty()) add(contact, points, to);
}

template <int Dim>
int ContactUpdate<Dim>::cut_of(const Pair& pair, const voussoir::Contact<Dim>& found) const {
  const auto facing = [&](std::size_t shape, const Vec<Dim>& outward) {
    const Rotation<Dim>& turn = now(tracker_.body_of(shape)).rotation;
    return cut_facing(*parts_[shape], Vec<Dim>(transposed(turn) * outward));
  };
  // Both sides of a cut have its label; the edge of the domain has that of the block at it. What
  // else is within reach are faces that lie one behind the other.
  if (!is_block_[index(tracker_.body_of(pair.a))]) return facing(pair.b, -found.normal);
  const int cut = facing(pair.a, found.normal);
  if (!is_block_[index(tracker_.body_of(pair.b))]) return cut;
  return cut == facing(pair.b, -found.normal) ? cut : -1;
}

template <int Dim>
int ContactUpdate<Dim>::law_of(std::size_t owner, int a, const Vec<Dim>& normal) const {
  if (law_of_cut_ == nullptr) return 0;
  const int cut = cut_facing(*parts_[owner], Vec<Dim>(transposed(now(a).rotation) * normal));
  return cut >= 0 && index(cut) < law_of_cut_->size() ? (*law_of_cut_)[index(cut)] : 0;
}

template <int Dim>
void ContactUpdate<Dim>::add(const Contact& c, std::span<const Point> points, Contacts& to) const {
  const Pose<Dim>&a = now(c.a), &b = now(c.b);
  const Rotation<Dim> frame = a.rotation * c.frame;
  ReferenceContact<Dim> contact{};
  contact.normal = column(frame, 0);
  contact.tangents = frame.template rightCols<Dim - 1>();
  contact.a = c.a;
  contact.b = c.b;
  contact.first = static_cast<int>(to.points.size());
  contact.last = contact.first + static_cast<int>(points.size());
  contact.law = c.law;
  Vec<Dim> middle = zeros<Vec<Dim>>();
  double whole = 0;
  for (const Point& p : points) {
    middle += p.weight * b(p.place);
    whole += p.weight;
  }
  middle /= whole;
  contact.arm_a = middle - a.position;
  contact.arm_b = middle - b.position;
  const auto at = c.place(a, b);
  for (const Point& p : points) {
    ReferencePoint<Dim> point{};
    point.offset = transposed(frame) * (b(p.place) - middle);
    point.weight = p.weight;
    point.initial = p.initial;
    const PointMotion<Dim> motion = p.motion(at);
    point.start = stacked(motion.opening, motion.slip);
    point.start -= contact.linear_motion(point, displacement_.data());
    to.points.push_back(point);
    to.former.push_back(p.state);
  }
  to.contacts.push_back(contact);
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class ContactUpdate<2>;
VOUSSOIR_SPATIAL_TEMPLATE class ContactUpdate<3>;
#endif

}  // namespace voussoir::detail
