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
#include <voussoir/core/pose.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/geometry/cut_facing.hpp>
#include <voussoir/model/any_law.hpp>
#include <voussoir/model/contact_group.hpp>
#include <voussoir/model/contact_renewal.hpp>
#include <voussoir/model/contact_tracker.hpp>
#include <voussoir/model/detail/contact_frames.hpp>
#include <voussoir/model/detail/contact_shares.hpp>
#include <voussoir/model/detail/former_contacts.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contacts.hpp>

namespace voussoir::detail {

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
template <int Dim, class Detector>
class ContactUpdate {
 public:
  using Contacts = LawlessContacts<Dim>;
  using Tracker = ContactTracker<Dim, Detector>;
  using Shape = typename Tracker::Shape;

  /// @param reach         contacts may be so far open [m]
  /// @param displacement  present, `dof` values a body
  /// @param updated_at      that of the reference configuration so far; empty: the in-situ state
  /// @param law_of_cut    for every label of a face the index of the joint law; null: the first
  /// @pre the vectors outlive this, and do not change
  ContactUpdate(double reach, const Eigen::VectorXd& displacement,
                const Eigen::VectorXd& updated_at, const std::vector<int>* law_of_cut)
      : displacement_(displacement),
        updated_at_(updated_at),
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
  }
  /// A convex part of a body in the in-situ state. @pre it outlives this
  /// @param centre  of the body then [m]
  void add_part(int body, const Shape& part, const Vec<Dim>& centre);

  [[nodiscard]] const Pose<Dim>& now(int b) const { return bodies_[index(b)].pose; }
  [[nodiscard]] const Pose<Dim>& then(int b) const { return then_[index(b)]; }
  /// How a body has turned since contacts were last updated.
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

  using Former = FormerContacts<Dim>;

  template <class Number>
  [[nodiscard]] static std::size_t index(Number i) {
    return static_cast<std::size_t>(i);
  }

  [[nodiscard]] Former former(const Contacts& group) const {
    return {group.contacts, group.points, then_,
            updated_at_.size() > 0 ? updated_at_.data() : nullptr};
  }
  /// Marks bodies that no chain of contacts, of `Dim` points at least, joins to a fixed one.
  /// @return  whether there are any
  bool find_loose(const Contacts& joints, const Contacts& boundary,
                  std::vector<char>& is_loose) const;
  /// @param reach, joined  see ContactRenewal
  void renew(const Former& former, const Pair& pair, const voussoir::Contact<Dim>& found,
             const ContactArea<Dim>* joined, double reach, Contacts& to) const;
  [[nodiscard]] int cut_of(std::size_t shape, const Vec<Dim>& outward) const {
    const Rotation<Dim>& turn = now(tracker_.body_of(shape)).rotation;
    return cut_facing(*parts_[shape], Vec<Dim>(transposed(turn) * outward));
  }
  [[nodiscard]] int cut_of(const Pair& pair, const voussoir::Contact<Dim>& found) const {
    return common_cut<Dim>(
        tracker_, pair, found, [this](int b) { return bool(is_block_[index(b)]); },
        [this](std::size_t shape, const Vec<Dim>& outward) { return cut_of(shape, outward); });
  }
  /// Of a contact that is new: the law of the face that is touched.
  [[nodiscard]] int law_of(std::size_t owner, const Vec<Dim>& normal) const;
  /// Adds the contact where it is now, for small displacements from there.
  void add(const Contact& c, std::span<const Point> points, Contacts& to) const {
    const auto first = static_cast<int>(to.points.size());
    to.contacts.push_back(from_frames(c, now(c.a), now(c.b), displacement_.data(), points,
                                      [&](const auto& p) { to.points.push_back(p); }));
    to.contacts.back().set_points(first, points.size());
    for (const Point& p : points)
      to.former.push_back({p.state.number < -1 ? -2 - p.state.number : -1});
  }

  const Eigen::VectorXd &displacement_, &updated_at_;
  const std::vector<int>* law_of_cut_;
  Tracker tracker_;
  std::vector<MovingBody<Dim>> bodies_;  ///< where they are
  std::vector<Pose<Dim>> then_;          ///< when contacts were last updated
  std::vector<bool> is_block_;
  std::vector<const Shape*> parts_;  ///< in the order of the tracker's shapes
};

template <int Dim, class Detector>
void ContactUpdate<Dim, Detector>::add_part(int body, const Shape& part, const Vec<Dim>& centre) {
  double& radius = bodies_[index(body)].radius;
  for (const Vec<Dim>& v : part.vertices()) radius = std::max(radius, (v - centre).norm());
  tracker_.add(part, centre, body, diagonal_of<Dim>(1), body);
  parts_.push_back(&part);
}

template <int Dim, class Detector>
void ContactUpdate<Dim, Detector>::run(Contacts& joints, Contacts& boundary, Contacts& interface,
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
  const Former of_joints = former(joints), of_boundary = former(boundary),
               of_interface = former(interface);
  for (Contacts* group : {&joints, &boundary, &interface}) {
    group->contacts.clear();
    group->points.clear();
    group->former.clear();
  }
  ContactShares<Dim, Tracker> shares_of_joints(tracker_), shares_of_boundary(tracker_);
  tracker_.update(
      bodies_, nullptr,
      [&](Pair& pair, const voussoir::Contact<Dim>& found) {
        stop();
        const bool of_blocks = is_block_[index(tracker_.body_of(pair.a))] &&
                               is_block_[index(tracker_.body_of(pair.b))];
        if (tracker_.is_shared(pair))
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
  for (const Contact& c : of_interface.contacts()) add(c, of_interface.points_of(c), interface);
}

template <int Dim, class Detector>
bool ContactUpdate<Dim, Detector>::find_loose(const Contacts& joints, const Contacts& boundary,
                                              std::vector<char>& is_loose) const {
  std::vector<int> group(bodies_.size());
  for (std::size_t b = 0; b < group.size(); ++b) group[b] = static_cast<int>(b);
  const auto root = [&](int b) {
    while (group[index(b)] != b) b = group[index(b)] = group[index(group[index(b)])];
    return b;
  };
  for (const Contacts* contacts : {&joints, &boundary})
    for (const ReferenceContact<Dim>& c : contacts->contacts)
      if (c.count >= Dim) group[index(root(c.a))] = root(c.b);
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

template <int Dim, class Detector>
void ContactUpdate<Dim, Detector>::renew(const Former& former, const Pair& pair,
                                         const voussoir::Contact<Dim>& found,
                                         const ContactArea<Dim>* joined, double reach,
                                         Contacts& to) const {
  const Vec<Dim>& from = tracker_.shapes().grid_point(pair.a);
  const bool of_a = found.touch != Touch::face_b;
  const std::size_t owner = of_a ? pair.a : pair.b;
  const int a = tracker_.body_of(owner), b = tracker_.body_of(of_a ? pair.b : pair.a);
  const Contact* const old =
      former.nearest(bodies_, a, b, found.normal, middle_of<Dim>(found, joined) + from);
  std::vector<Point> points;
  using Renewal = ContactRenewal<Dim>;
  Contact contact =
      Renewal(bodies_, former.points())
          .run(found, from, tracker_.shapes(), owner, a, b, false, reach, old, points, joined);
  contact.law = old != nullptr     ? old->law
                : to.has_many_laws ? law_of(owner, of_a ? found.normal : Vec<Dim>(-found.normal))
                                   : 0;
  if (!points.empty()) add(contact, points, to);
}

template <int Dim, class Detector>
int ContactUpdate<Dim, Detector>::law_of(std::size_t owner, const Vec<Dim>& normal) const {
  if (law_of_cut_ == nullptr) return 0;
  const int cut = cut_of(owner, normal);
  return cut >= 0 && index(cut) < law_of_cut_->size() ? (*law_of_cut_)[index(cut)] : 0;
}

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class ContactUpdate<2, FaceContacts>;
VOUSSOIR_SPATIAL_TEMPLATE class ContactUpdate<3, FaceContacts>;
#endif

}  // namespace voussoir::detail
