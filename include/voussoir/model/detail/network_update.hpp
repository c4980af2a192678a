// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/model/contact_network.hpp>
#include <voussoir/model/contact_renewal.hpp>
#include <voussoir/model/detail/contact_shares.hpp>
#include <voussoir/model/detail/impact.hpp>
#include <voussoir/model/detail/kept_shear.hpp>
#include <voussoir/model/detail/left_contact.hpp>
#include <voussoir/model/detail/limited_energy.hpp>

// How the contacts of `ContactNetwork` come to be and are updated.
namespace voussoir {

template <int Dim, class Detector>
template <class StressAt>
void ContactNetwork<Dim, Detector>::prescribe(const Bodies& bodies, StressAt&& stress_at,
                                              double closed) {
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

template <int Dim, class Detector>
template <class CutOf>
ContactChange ContactNetwork<Dim, Detector>::find(Tracker& tracker, const Bodies& bodies,
                                                  const std::vector<std::uint32_t>* moved,
                                                  const std::vector<BodyRole>& roles,
                                                  CutOf&& cut_of, UpdateEnergy& energy) {
  // Bodies may have come since.
  rates_.resize(bodies.size());
  Update<std::decay_t<CutOf>> update{tracker, bodies, roles,
                                     cut_of,  energy, !sums_.is_listed(bodies.size())};
  detail::ContactShares<Dim, Tracker> shares(tracker);
  std::vector<Left> left;
  const auto leave = [&](Pair& pair) {
    if (pair.contact >= 0)
      left.push_back({std::minmax(tracker.body_of(pair.a), tracker.body_of(pair.b)),
                      update.kind_of(pair), pair.contact, energy_of(update, pair)});
    pair.contact = -1;
  };
  tracker.update(
      bodies, moved,
      [&](Pair& pair, const Contact<Dim>& found) {
        if (tracker.is_shared(pair)) {
          leave(pair);
          shares.add(pair, found, update.common_cut(pair, found));
        } else {
          renew(update, pair, found, nullptr, energy_of(update, pair));
        }
      },
      leave);
  std::sort(left.begin(), left.end());
  // A contact may hold what it held, and what those of the same two bodies held that are no more.
  std::pair<int, int> bodies_of_last{-1, -1};
  double spare = 0;
  shares.join(
      [&](Pair& pair, const Contact<Dim>& found, const ContactArea<Dim>* area) {
        const std::pair<int, int> both =
            std::minmax(tracker.body_of(pair.a), tracker.body_of(pair.b));
        if (std::exchange(bodies_of_last, both) != both) spare = detail::energy_left(left, both);
        take_nearest(update, left, pair, found, area);
        spare = std::max(0.0, spare - energy_of(update, pair));
      },
      [&](Pair& pair, const Contact<Dim>& found, const ContactArea<Dim>* area) {
        const double held = energy_of(update, pair) + spare;
        renew(update, pair, found, area, held);
        spare = std::max(0.0, held - energy_of(update, pair));
      });
  for (const Left& it : left)
    if (it.contact >= 0) drop(update, it);
  former_ = {};
  is_everything_new_ = has_started_ = true;
  if (update.relisted) {
    if (unused_ > size() / 16)
      tidy(tracker, [&](const Pair& pair) { return update.kind_of(pair); });
    list(bodies.size());
  }
  return update.relisted  ? ContactChange::renumbered
         : update.changed ? ContactChange::in_place
                          : ContactChange::none;
}

template <int Dim, class Detector>
template <class U>
void ContactNetwork<Dim, Detector>::take_nearest(const U& update, std::vector<Left>& left,
                                                 Pair& pair, const Contact<Dim>& found,
                                                 const ContactArea<Dim>* joined) {
  const std::pair<int, int> wanted =
      std::minmax(update.tracker.body_of(pair.a), update.tracker.body_of(pair.b));
  const Vec<Dim> place =
      detail::middle_of<Dim>(found, joined) + update.tracker.shapes().grid_point(pair.a);
  auto best = left.end();
  double least = std::numeric_limits<double>::infinity();
  const Group& group = groups_[update.kind_of(pair)];
  auto it = std::lower_bound(left.begin(), left.end(), wanted,
                             [](const Left& x, const auto& value) { return x.bodies < value; });
  for (; it != left.end() && it->bodies == wanted; ++it) {
    if (it->contact < 0) continue;
    const double distance = detail::squared_distance<Dim>(
        update.bodies, group.contacts()[index(it->contact)], group.points(), found.normal, place);
    if (distance >= least) continue;
    least = distance;
    best = it;
  }
  if (best != left.end()) pair.contact = std::exchange(best->contact, -1);
}

template <int Dim, class Detector>
template <class U>
void ContactNetwork<Dim, Detector>::drop(U& update, const Left& it) {
  Group& group = groups_[it.kind];
  update.energy.given -= group.stored_energy(index(it.contact), update.bodies);
  auto& contact = group.contacts()[index(it.contact)];
  contact.last = contact.first;
  ++unused_;
  for (const int b : {it.bodies.first, it.bodies.second}) rates_.forget(b);
  update.relisted = update.changed = true;
}

template <int Dim, class Detector>
template <class U>
void ContactNetwork<Dim, Detector>::renew(U& update, Pair& pair, const Contact<Dim>& found,
                                          const ContactArea<Dim>* joined, double held) {
  const Tracker& tracker = update.tracker;
  const Bodies& bodies = update.bodies;
  const std::size_t kind = update.kind_of(pair);
  Group& group = groups_[kind];
  const Former& former = former_[kind];
  const bool of_a = found.touch != Touch::face_b, known = pair.contact >= 0;
  const std::size_t owner = of_a ? pair.a : pair.b;
  const int a = tracker.body_of(owner), b = tracker.body_of(of_a ? pair.b : pair.a);
  const Vec<Dim>& from = tracker.shapes().grid_point(pair.a);
  std::vector<typename Group::Point> points;
  const typename Group::Contact* const old =
      known ? &group.contacts()[index(pair.contact)]
            : former.nearest(bodies, a, b, found.normal,
                             detail::middle_of<Dim>(found, joined) + from);
  const std::vector<typename Group::Point>& old_points = known ? group.points() : former.points();
  detail::ContactRenewal<Dim> renewal(bodies, old_points);
  if (!is_everything_new_) renewal.start_at_rest();
  const bool is_centred =
      known ? old->is_centred : kind == 2 && old != nullptr && old->last - old->first == 1;
  typename Group::Contact contact = renewal.run(found, from, tracker.shapes(), owner, a, b,
                                                is_centred, tracker.reach(), old, points, joined);
  contact.is_centred = is_centred;
  if (old != nullptr)
    contact.law = old->law;
  else if (kind == 0)
    contact.law = law_of(update.cut_of(owner, of_a ? found.normal : Vec<Dim>(-found.normal)));
  else if (kind == 2)
    contact.law = std::max(interface_law_of(a), interface_law_of(b));  // one of the two is rock
  // As far in as it was: what shear there is depends on how much of it is pressed.
  if (known && renewal.keeps_history()) detail::uncount(old->uncounted, contact, points);
  if (renewal.keeps_history())
    detail::keep_shear<Dim>(group, *old, known ? group.points_of(*old) : former.points_of(*old),
                            !known, contact, bodies, points);
  if (!points.empty()) {
    const auto impact = detail::Impact<Dim>::at(contact, renewal.meeting_place(), bodies);
    const double per_area = group.law_of(contact).joint_normal_stiffness();
    if (has_started_) {
      contact.least_area = known && held > 0 ? old->least_area : impact.least_area(per_area);
      detail::widen(contact, points);
      detail::limit_energy<Dim>(group, contact, bodies, points, held);
    }
    if (viscous_damping_ > 0 && !points.empty())
      contact.viscosity = impact.viscosity(viscous_damping_, per_area * detail::area_of(points));
  }
  const bool in_place = put(update, group, pair, contact, points, held);
  update.relisted = update.relisted || !in_place;
  update.changed = true;
}

template <int Dim, class Detector>
template <class U>
bool ContactNetwork<Dim, Detector>::put(U& update, Group& group, Pair& pair,
                                        const typename Group::Contact& contact,
                                        const std::vector<typename Group::Point>& points,
                                        double held) {
  const Bodies& bodies = update.bodies;
  const bool known = pair.contact >= 0;
  const typename Group::Contact* const old =
      known ? &group.contacts()[index(pair.contact)] : nullptr;
  const bool same_side = known && contact.a == old->a;
  if (known) update.energy.given -= group.stored_energy(index(pair.contact), bodies);
  const bool fits = group.put(pair.contact, contact, points);
  if (known && !fits) ++unused_;
  const double now = group.stored_energy(index(pair.contact), bodies);
  update.energy.given += now;
  if (has_started_) {
    update.energy.held += held;
    update.energy.made += std::max(0.0, now - held);
  }
  for (const int b : {contact.a, contact.b}) rates_.forget(b);
  return same_side && fits;
}

}  // namespace voussoir
