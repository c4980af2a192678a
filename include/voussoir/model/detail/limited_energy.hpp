// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contacts.hpp>
#include <voussoir/model/point_loads.hpp>

namespace voussoir::detail {

/// Moves the faces of a contact apart along its normal by a way that is not counted of their
/// overlap [m]; or together, < 0.
template <class Contact, class Points>
void uncount(double way, Contact& contact, Points& points) {
  for (auto& p : points) p.zero[0] -= way;
  contact.uncounted += way;
}

/// A contact whose springs are eased: first the normal ones, then, if they must be, those in shear.
///
/// Its faces are moved apart along the normal: what is open stays open, and shear is what friction
/// lets act. A joint that is bonded cannot be let go like that without pulling at the bond; its
/// points are each moved towards where their normal spring carries nothing, and then their shear is
/// taken away.
template <int Dim, class Group>
class EasedContact {
 public:
  using Contact = typename Group::Contact;
  using Points = std::vector<typename Group::Point>;

  EasedContact(const Group& group, const Contact& contact,
               const std::vector<MovingBody<Dim>>& bodies, const Points& points)
      : group_(group),
        contact_(contact),
        at_(contact.place(bodies[static_cast<std::size_t>(contact.a)].pose,
                          bodies[static_cast<std::size_t>(contact.b)].pose)),
        points_(points) {}

  /// Finds by how much each point can be eased.
  void prepare() {
    eased_ = points_;
    constexpr std::size_t count = PressedPart<Dim>::count;
    double most = -std::numeric_limits<double>::infinity();
    bool is_bonded = false;
    for (const auto& p : points_) {
      const PointLoad<Dim> load = p.load(at_);
      const auto release = group_.release_of(contact_, load, p.state);
      normal_.push_back(opening_of(release) - load.motion.opening);
      most = std::max(most, normal_.back());
      is_bonded = is_bonded || holds_tension(release);
    }
    if (points_.size() == count) most = PressedPart<Dim>::deepest(normal_.data(), contact_.outline);
    full_ = is_bonded ? 1 : std::max(0.0, most) + rounding;
    gap_ = std::max(0.0, -most - rounding);
    if (!is_bonded) normal_.assign(points_.size(), 1);
    is_bonded_ = is_bonded;
    shear_.assign(points_.size(), zeros<Vec<Dim - 1>>());
    group_.visit_loads(contact_, points_, at_,
                       [&](std::size_t k, const auto& p, const PointLoad<Dim>& load) {
                         shear_[k] = load.whole_over_part * shear_taking(load, p.state);
                       });
  }

  /// Root of the energy of the springs as they are [J^0.5].
  [[nodiscard]] double root() const { return root_of(points_); }
  /// Root of the energy, eased: where all points are closed it falls in proportion to the way.
  /// @param way    0 to `full`: all of what the normal springs carry
  /// @param shear  part of the shear that is left, 0 to 1
  /// @pre  prepared
  [[nodiscard]] double root_at(double way, double shear) {
    for (std::size_t k = 0; k < eased_.size(); ++k) {
      eased_[k].zero[0] = points_[k].zero[0] - way * normal_[k];
      eased_[k].initial.tangential = points_[k].initial.tangential - (1 - shear) * shear_[k];
    }
    return root_of(eased_);
  }
  /// Root of the energy with all faces moved apart by a way, or together, < 0 [m].
  /// @pre  prepared
  [[nodiscard]] double root_apart(double way) {
    for (std::size_t k = 0; k < eased_.size(); ++k) eased_[k].zero[0] = points_[k].zero[0] - way;
    return root_of(eased_);
  }
  /// The points as eased last.
  [[nodiscard]] const Points& points() const { return eased_; }
  [[nodiscard]] double full() const { return full_; }
  /// Between faces that touch nowhere [m].
  [[nodiscard]] double gap() const { return gap_; }
  [[nodiscard]] bool is_bonded() const { return is_bonded_; }

 private:
  [[nodiscard]] double root_of(const Points& points) const {
    return std::sqrt(std::max(0.0, group_.stored_energy(contact_, points, at_)));
  }
  [[nodiscard]] static bool holds_tension(double) { return false; }
  [[nodiscard]] static bool holds_tension(const BondRelease<Dim>& release) {
    return release.stretch > 0 && release.area > 0;
  }

  /// The initial shear without which a point carries none [N]. Of a spring that shares what it
  /// carried with what has closed since (`ShearSpring`) its shear follows by a half at least.
  [[nodiscard]] Vec<Dim - 1> shear_taking(PointLoad<Dim> load,
                                          const typename Group::State& state) const {
    const Vec<Dim - 1> now = group_.force(contact_, load, state).tangential;
    const double squared = now.squaredNorm();
    if (!(squared > 0)) return now;
    load.initial.tangential -= now;
    const double follows = 1 - group_.force(contact_, load, state).tangential.dot(now) / squared;
    return follows >= 0.5 ? Vec<Dim - 1>(now / follows) : now;
  }

  static constexpr double rounding = 1e-12;  ///< of an opening [m]

  const Group& group_;
  const Contact& contact_;
  typename Contact::Place at_;
  const Points& points_;
  Points eased_;
  std::vector<double> normal_;       ///< how far it is moved by a way of 1 [m]
  std::vector<Vec<Dim - 1>> shear_;  ///< [N]
  double full_ = 0, gap_ = 0;
  bool is_bonded_ = false;
};

/// The largest part, 0 to 1, of which the root of the energy is at most `wanted`; 0 if there is
/// none.
/// @param at_1  the root at 1, > wanted;  @param root_at  root_at(part) is continuous
template <class RootAt>
[[nodiscard]] double part_with(double wanted, double at_1, const RootAt& root_at) {
  double low = 0, high = 1, at_low = root_at(0);
  double above = at_1 - wanted, below = wanted - at_low;
  // Regula falsi, the side that stays halved (Illinois), until the root is met from below.
  for (int last = 0; below > 0 && wanted - at_low > 1e-12 * wanted && high - low > 1e-14;) {
    const double part = high - (high - low) * above / (above + below);
    const double root = root_at(part);
    if (root > wanted) {
      high = part;
      above = root - wanted;
      if (std::exchange(last, 1) == 1) below *= 0.5;
    } else {
      low = part;
      at_low = root;
      below = wanted - root;
      if (std::exchange(last, -1) == -1) above *= 0.5;
    }
  }
  return low;
}

/// Eases a contact in motion until its springs hold no more energy than `most` [J]: by how much is
/// chosen anew at every contact update, and is nothing where the area or the depth have not grown
/// since the last one.
///
/// Between updates springs are conservative. An update that finds a larger area, another face or an
/// overlap that nobody has seen, or keeps a shear force on less area, would give the blocks energy
/// that nothing has brought; so it finds them as deep as what they have brought has pressed them.
/// @param contact  with the way that is not counted of its overlap, a guess: that of the contact
/// before
/// @param most  >= 0
/// @cost   some evaluations of the energy of all points; one where nothing is nor must be eased
template <int Dim, class Group>
void limit_energy(const Group& group, typename Group::Contact& contact,
                  const std::vector<MovingBody<Dim>>& bodies,
                  std::vector<typename Group::Point>& points, double most) {
  constexpr int most_rounds = 100;
  EasedContact<Dim, Group> eased(group, contact, bodies, points);
  const double wanted = std::sqrt(most);
  const double as_found = eased.root(), uncounted = contact.uncounted;
  if (as_found <= wanted) {
    // It may count more again, unless it holds what it did.
    if (uncounted == 0 || (wanted > 0 && wanted - as_found <= 1e-9 * wanted)) return;
    eased.prepare();
    // All of the contact comes back, where a bond holds at some of its points, too.
    const auto root_at = [&](double part) { return eased.root_apart(-part * uncounted); };
    const double all = root_at(1);
    double less = uncounted;
    if (all > wanted && wanted > 0) {
      less *= part_with(wanted, all, root_at);
    } else if (all > 0) {
      // Up to where they touch; a joint that slips may lift itself into contact before.
      const double part = std::min(1.0, eased.gap() / uncounted);
      less *= root_at(part) > 0 ? 0 : part;
    }
    uncount(-less, contact, points);
    return;
  }
  eased.prepare();
  const auto way = [&](double part) { return (1 - part) * eased.full(); };
  const double normal =
      part_with(wanted, as_found, [&](double part) { return eased.root_at(way(part), 1); });
  double left = eased.root_at(way(normal), 1);
  points = eased.points();
  if (!eased.is_bonded()) contact.uncounted += way(normal);
  // Where cohesion alone limits it, each round takes as much shear as that is.
  for (int round = 0; left > wanted && round < most_rounds; ++round) {
    EasedContact<Dim, Group> sheared(group, contact, bodies, points);
    sheared.prepare();
    const auto root_at = [&](double part) { return sheared.root_at(0, part); };
    const double part = part_with(wanted, left, root_at), now = root_at(part);
    points = sheared.points();
    if (now > (1 - 1e-9) * left) break;
    left = now;
  }
  // What is left has no spring that gives way, as delayed slip (`BurgersJoint`): it goes with the
  // area, and with nothing the contact begins anew.
  const double rounding = 1e-12 * as_found * as_found;
  for (int round = 0; left * left > most + rounding; ++round) {
    const double share = most / (left * left);
    if (share == 0 || round == most_rounds) {
      points.clear();
      return;
    }
    for (auto& p : points) {
      p.weight *= share;
      p.initial.normal *= share;
      p.initial.tangential *= share;
    }
    left = EasedContact<Dim, Group>(group, contact, bodies, points).root();
  }
}

}  // namespace voussoir::detail
