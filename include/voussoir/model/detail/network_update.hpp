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
ContactChange ContactNetwork<Dim, Detector>::find(Tracker& tracker, const Bodies& bodies,
                                                  const std::vector<std::uint32_t>* moved,
                                                  const std::vector<BodyRole>& roles,
                                                  const CutOf& cut_of, UpdateEnergy& energy,
                                                  const Progress& progress) {
  StopCheck stop(progress);
  // Bodies may have come since.
  rates_.resize(bodies.size());
  Update update{tracker, bodies, roles, cut_of, energy, !sums_.is_listed(bodies.size())};
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
        stop();
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
        stop();
        const double held = energy_of(update, pair) + spare;
        renew(update, pair, found, area, held);
        spare = std::max(0.0, held - energy_of(update, pair));
      });
  for (const Left& it : left)
    if (it.contact >= 0) drop(update, it);
  share_out(update);
  former_ = {};
  carries_on_ = false;
  has_started_ = true;
  if (update.relisted) {
    if (unused_ > size() / 16) tidy(update);
    list(bodies.size());
  }
  return update.relisted  ? ContactChange::renumbered
         : update.changed ? ContactChange::in_place
                          : ContactChange::none;
}

template <int Dim, class Detector>
void ContactNetwork<Dim, Detector>::take_nearest(const Update& update, std::vector<Left>& left,
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
void ContactNetwork<Dim, Detector>::drop(Update& update, const Left& it) {
  Group& group = groups_[it.kind];
  update.energy.given -= group.stored_energy(index(it.contact), update.bodies);
  auto& contact = group.contacts()[index(it.contact)];
  contact.last = contact.first;
  ++unused_;
  for (const int b : {it.bodies.first, it.bodies.second}) rates_.forget(b);
  update.relisted = update.changed = true;
}

template <int Dim, class Detector>
void ContactNetwork<Dim, Detector>::renew(Update& update, Pair& pair, const Contact<Dim>& found,
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
  detail::ContactRenewal<Dim> renewal(bodies, old_points, kind == 0 && joint_fibres_);
  const bool is_centred =
      known ? old->is_centred : kind == 2 && old != nullptr && old->last - old->first == 1;
  std::vector<Vec<Dim - 1>> slips;
  if (old != nullptr)
    group.visit_loads(*old, known ? group.points_of(*old) : former.points_of(*old),
                      old->place(bodies[index(old->a)].pose, bodies[index(old->b)].pose),
                      [&](std::size_t, const auto&, const PointLoad<Dim>& load) {
                        slips.push_back(load.motion.slip);
                      });
  typename Group::Contact contact =
      renewal.run(found, from, tracker.shapes(), owner, a, b, is_centred, tracker.reach(), old,
                  slips, points, joined);
  contact.is_centred = is_centred;
  if (old != nullptr)
    contact.law = old->law;
  else if (kind == 0)
    contact.law = law_of(update.cut_of(owner, of_a ? found.normal : Vec<Dim>(-found.normal)));
  else if (kind == 2)
    contact.law = std::max(interface_law_of(a), interface_law_of(b));  // one of the two is rock
  const bool is_heir = !known && renewal.keeps_history();
  // As far in as it was: what shear there is depends on how much of it is pressed.
  if (renewal.keeps_history()) detail::uncount(old->uncounted, contact, points);
  if (known && renewal.keeps_history())
    detail::keep_shear<Dim>(group, *old, group.points_of(*old), contact, bodies, points);
  if (!points.empty()) {
    const auto impact = detail::Impact<Dim>::at(contact, renewal.meeting_place(), bodies);
    const double per_area = group.law_of(contact).joint_normal_stiffness();
    if (has_started_) {
      contact.least_area = known && held > 0 ? old->least_area : impact.least_area(per_area);
      detail::widen(contact, points);
    }
    if ((has_started_ || carries_on_) && !is_heir)
      detail::limit_energy<Dim>(group, contact, bodies, points, held);
    if (viscous_damping_ > 0 && !points.empty())
      contact.viscosity = impact.viscosity(viscous_damping_, per_area * detail::area_of(points));
  }
  const bool in_place = put(update, group, pair, contact, points, held);
  if (is_heir)
    heirs_[kind].push_back({index(old - former.contacts().data()), pair.contact,
                            std::any_of(points.begin(), points.end(),
                                        [](const auto& p) { return p.state.number != -1; })});
  update.relisted = update.relisted || !in_place;
  update.changed = true;
}

template <int Dim, class Detector>
void ContactNetwork<Dim, Detector>::share_out(Update& update) {
  using Shear = Vec<Dim - 1>;
  using Points = std::vector<typename Group::Point>;
  const auto place = [&](const typename Group::Contact& c) {
    return c.place(update.bodies[index(c.a)].pose, update.bodies[index(c.b)].pose);
  };
  Points points;
  for (std::size_t kind = 0; kind < groups_.size(); ++kind) {
    Group& group = groups_[kind];
    const Former& former = former_[kind];
    std::vector<Heir> heirs = std::exchange(heirs_[kind], {});
    std::stable_sort(heirs.begin(), heirs.end(),
                     [](const Heir& x, const Heir& y) { return x.former < y.former; });
    const auto shear_of = [&](const typename Group::Contact& c, const auto& of) {
      return group.shear_of(c, of, place(c));
    };
    const auto store = [&](const typename Group::Contact& c, std::size_t at) {
      std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(at), c.last - c.first,
                  group.points().begin() + c.first);
    };
    for (auto first = heirs.begin(), last = first; first != heirs.end(); first = last) {
      while (last != heirs.end() && last->former == first->former) ++last;
      const auto& old = former.contacts()[first->former];
      // visit(contact, where its points begin among those of all)
      const auto each = [&](auto&& visit) {
        std::size_t at = 0;
        for (auto heir = first; heir != last; ++heir) {
          const auto& c = group.contacts()[index(heir->contact)];
          if (!heir->has_points) continue;
          visit(c, at);
          at += index(c.last - c.first);
        }
      };
      points.clear();
      each([&](const auto& c, std::size_t) {
        const auto of = group.points_of(c);
        points.insert(points.end(), of.begin(), of.end());
      });
      detail::match_shear<Dim>(shear_of(old, former.points_of(old)), points, [&] {
        Shear sum = zeros<Shear>();
        each([&](const auto& c, std::size_t at) {
          sum += shear_of(c, std::span<const typename Group::Point>(points).subspan(
                                 at, index(c.last - c.first)));
        });
        return sum;
      });
      each(store);
      double held = group.stored_energy(old, former.points_of(old), place(old));
      for (auto heir = first; heir != last; ++heir) {
        auto& c = group.contacts()[index(heir->contact)];
        const auto of = group.points_of(c);
        if (of.empty()) continue;
        points.assign(of.begin(), of.end());
        detail::limit_energy<Dim>(group, c, update.bodies, points, held);
        if (points.empty()) {
          c.last = c.first;
          ++unused_;
          continue;
        }
        store(c, 0);
        const double now = group.stored_energy(c, group.points_of(c), place(c));
        update.energy.held += held;
        update.energy.made += std::max(0.0, now - held);
        held = std::max(0.0, held - now);
      }
    }
  }
}

template <int Dim, class Detector>
bool ContactNetwork<Dim, Detector>::put(Update& update, Group& group, Pair& pair,
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
