// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/smooth_wall.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/model/contact_tracker.hpp>
#include <voussoir/model/detail/body_rates.hpp>
#include <voussoir/model/detail/contact_shares.hpp>
#include <voussoir/model/detail/contact_springs.hpp>
#include <voussoir/model/detail/contact_sums.hpp>
#include <voussoir/model/detail/former_contacts.hpp>
#include <voussoir/model/detail/law_model.hpp>
#include <voussoir/model/detail/left_contact.hpp>
#include <voussoir/model/moving_bodies.hpp>
#include <voussoir/model/moving_contacts.hpp>

namespace voussoir {

/// Energy that contact updates give to springs [J].
struct UpdateEnergy {
  double given = 0;  ///< < 0: lost
  double made = 0;   ///< of it, to contacts that got more than those of their bodies had: rounding
  double held = 0;   ///< by the contacts that were updated, before: what rounding is of
};

/// What a contact update has changed: nothing; contacts in their places; or these, too.
enum class ContactChange { none, in_place, renumbered };

/// All contacts of bodies that move, in three groups: joints between blocks, smooth walls around
/// them, and the interface between rock and lining.
///
/// Contacts are numbered in one row, group after group. Every body has the list of its contacts, in
/// which their forces are summed: always in the same order.
/// @tparam Detector  the narrow phase
template <int Dim, class Detector = FaceContacts>
class ContactNetwork {
 public:
  using Body = MovingBody<Dim>;
  using Bodies = std::vector<Body>;
  using Group = MovingContacts<Dim>;
  using Law = AnyLaw<Dim>;
  using Tracker = ContactTracker<Dim, Detector>;
  using Former = detail::FormerContacts<Dim>;
  using CutOf = std::function<int(std::size_t, const Vec<Dim>&)>;

  /// @param laws  of the joints;  @param wall_stiffness  of the walls [Pa/m]
  /// @param interface_laws  of linings that there are already
  /// @param law_of_cut  for every label of the blocks' faces the index of its law; empty: the first
  /// @param viscous_damping  ratio to critical of the dashpots [-]
  /// @param joint_fibres  see `DynamicsSettings`
  ContactNetwork(std::vector<Law> laws, double wall_stiffness, std::vector<Law> interface_laws,
                 std::vector<int> law_of_cut, double viscous_damping, bool joint_fibres = false)
      : groups_{Group(std::move(laws)), Group({SmoothWall(wall_stiffness)}),
                Group(std::move(interface_laws))},
        law_of_cut_(std::move(law_of_cut)),
        viscous_damping_(viscous_damping),
        joint_fibres_(joint_fibres) {}

  [[nodiscard]] const Group& joints() const { return groups_[0]; }
  [[nodiscard]] const Group& walls() const { return groups_[1]; }
  [[nodiscard]] const Group& interface() const { return groups_[2]; }
  [[nodiscard]] std::size_t size() const {
    std::size_t sum = 0;
    for (const Group& group : groups_) sum += group.size();
    return sum;
  }

  /// Calls visit(group, contact) for every contact of all groups.
  template <class Visit>
  void each(Visit&& visit) {
    for (Group& group : groups_)
      for (auto& c : group.contacts()) visit(group, c);
  }
  template <class Visit>
  void each(Visit&& visit) const {
    for (const Group& group : groups_)
      for (const auto& c : group.contacts()) visit(group, c);
  }

  /// @return  its index
  int add_interface_law(const Law& law) { return groups_[2].add_law(law); }
  /// Rock touches these bodies, nodes of one lining, by this law.
  /// @param number  of the law;  @param first  of the bodies;  @param count  of them
  void set_interface_law(int number, int first, int count) {
    interface_law_of_.resize(index(first + count), -1);
    std::fill(interface_law_of_.begin() + first, interface_law_of_.end(), number);
  }

  /// The contacts of a model that is set in motion: those that are found first carry them on, and
  /// hold no more energy than they do where the bodies are then; what is found besides exerts
  /// nothing as it lies.
  /// @param interface  laws numbered as by `set_interface_law`
  void carry_on(Former joints, Former walls, Former interface) {
    former_ = {std::move(joints), std::move(walls), std::move(interface)};
    for (std::size_t kind = 0; kind < groups_.size(); ++kind)
      groups_[kind].adopt(std::move(former_[kind].states));
    carries_on_ = true;
  }

  /// Gives every contact that is open by no more than `closed` [m] the traction of a stress field,
  /// and makes it the one without opening.
  template <class StressAt>
  void prescribe(const Bodies& bodies, StressAt&& stress_at, double closed);

  /// Updates contacts where bodies have moved.
  /// @param moved   see `ContactTracker::update`
  /// @param roles   of every body
  /// @param cut_of  cut_of(shape, outward): label of the face of a shape that looks there
  /// @param energy  what springs gain by their new form is added to it
  /// @param progress  asked now and then whether to go on
  /// @throws Stopped  with contacts that are of no more use
  [[nodiscard]] ContactChange find(Tracker& tracker, const Bodies& bodies,
                                   const std::vector<std::uint32_t>* moved,
                                   const std::vector<BodyRole>& roles, const CutOf& cut_of,
                                   UpdateEnergy& energy, const Progress& progress = {});

  /// Other laws for the joints from now on: as many, of the same kind.
  void set_laws(std::vector<Law> laws) { groups_[0].set_laws(std::move(laws)); }

  /// Computes what contacts first, ..., last - 1 do, history brought up to date.
  /// @param crossings  see `MovingContacts::react`
  void react(std::size_t first, std::size_t last, const Bodies& bodies, Dissipation& lost,
             StepCrossings<Dim>* crossings = nullptr) {
    std::size_t before = 0;
    for (Group& group : groups_) {
      const std::size_t begin = std::max(first, before),
                        end = std::min(last, before + group.size());
      if (begin < end)
        group.react(begin - before, end - before, bodies, &sums_.reaction(begin), lost, crossings);
      before += group.size();
    }
  }
  /// The same of these contacts, in ascending order.
  void react(std::span<const std::uint32_t> which, const Bodies& bodies, Dissipation& lost,
             StepCrossings<Dim>* crossings = nullptr) {
    std::size_t before = 0;
    auto next = which.begin();
    for (Group& group : groups_) {
      const std::size_t end = before + group.size();
      while (next != which.end() && *next < end) {
        const std::size_t first = *next;
        std::size_t last = first;
        for (; next != which.end() && *next == last && last < end; ++next) ++last;
        group.react(first - before, last - before, bodies, &sums_.reaction(first), lost, crossings);
      }
      before = end;
    }
  }
  /// All contacts of some bodies, each once, in ascending order.
  [[nodiscard]] std::vector<std::uint32_t> contacts_of(
      const std::vector<std::uint32_t>& bodies) const {
    std::vector<char> marks(size(), 0);  // faster than to sort them
    for (const std::uint32_t b : bodies)
      for (const auto& end : sums_.ends_of(b)) marks[end.contact] = 1;
    std::vector<std::uint32_t> all;
    for (std::uint32_t k = 0; k < marks.size(); ++k)
      if (marks[k] != 0) all.push_back(k);
    return all;
  }
  /// Calls visit(other) for every body that a contact joins to this one.
  template <class Visit>
  void each_neighbour(std::size_t b, Visit&& visit) const {
    for (const auto& end : sums_.ends_of(b)) {
      const auto [group, k] = place_of(end.contact);
      const auto& c = group->contacts()[k];
      visit(end.end == 0 ? c.b : c.a);
    }
  }
  /// Force and moment of all contacts on a body, as last computed; world axes.
  [[nodiscard]] std::pair<Vec<Dim>, Spin<Dim>> gather(std::size_t b) const {
    return sums_.gather(b);
  }

  [[nodiscard]] double stored_energy(const Bodies& bodies) const {
    double sum = 0;
    for (const Group& group : groups_)
      for (std::size_t k = 0; k < group.size(); ++k) sum += group.stored_energy(k, bodies);
    return sum;
  }

  /// Bodies have other masses from now on.
  void forget_masses() { rates_.forget(); }
  /// How stiffly contacts hold every body, up to date.
  const detail::BodyRates<Dim>& rates(const Bodies& bodies) {
    rates_.update(bodies, [&](std::size_t b, auto& stiffness, auto& damping) {
      for (const auto& end : sums_.ends_of(b)) {
        const auto [group, k] = place_of(end.contact);
        detail::add_springs<Dim>(*group, k, end.end == 1, bodies, stiffness, damping);
      }
    });
    return rates_;
  }

 private:
  template <class T>
  [[nodiscard]] static std::size_t index(T i) {
    return static_cast<std::size_t>(i);
  }

  /// The group of a contact, and its number there.
  [[nodiscard]] std::pair<const Group*, std::size_t> place_of(std::size_t contact) const {
    const Group* group = groups_.data();
    for (; contact >= group->size(); ++group) contact -= group->size();
    return {group, contact};
  }

  using Pair = typename Tracker::Pair;
  /// What one update of contacts goes by, and what comes of it.
  struct Update {
    Tracker& tracker;
    const Bodies& bodies;
    const std::vector<BodyRole>& roles;
    const CutOf& cut_of;
    UpdateEnergy& energy;
    bool relisted;         ///< contacts have other places in the lists
    bool changed = false;  ///< anything has

    /// 0: joints, 1: walls, 2: interface
    [[nodiscard]] std::size_t kind_of(const Pair& pair) const {
      const BodyRole a = roles[index(tracker.body_of(pair.a))],
                     b = roles[index(tracker.body_of(pair.b))];
      if (a == BodyRole::wall || b == BodyRole::wall) return 1;
      return a == BodyRole::lining || b == BodyRole::lining ? 2 : 0;
    }
    /// -1 for the tiles of a lining, whose labels mean nothing.
    [[nodiscard]] int common_cut(const Pair& pair, const Contact<Dim>& found) const {
      if (kind_of(pair) == 2) return -1;
      return detail::common_cut<Dim>(
          tracker, pair, found, [this](int b) { return roles[index(b)] == BodyRole::block; },
          cut_of);
    }
  };
  using Left = detail::LeftContact;
  /// A contact that carries on a former one: their numbers.
  struct Heir {
    std::size_t former;
    std::int32_t contact;
    bool has_points;  ///< of it, at places where it had some
  };

  /// Of the springs of a pair's contact [J]; 0 without.
  [[nodiscard]] double energy_of(const Update& update, const Pair& pair) {
    return pair.contact < 0
               ? 0.0
               : groups_[update.kind_of(pair)].stored_energy(index(pair.contact), update.bodies);
  }
  /// Gives a pair the contact of its bodies that was nearest to the one found, if any is left.
  void take_nearest(const Update& update, std::vector<Left>& left, Pair& pair,
                    const Contact<Dim>& found, const ContactArea<Dim>* joined);

  void drop(Update& update, const Left& it);

  /// Gives a pair the contact that was found.
  /// @param joined  what several pairs have of it, see ContactRenewal
  /// @param held    energy that its springs may have [J]
  void renew(Update& update, Pair& pair, const Contact<Dim>& found, const ContactArea<Dim>* joined,
             double held);

  /// Puts a contact in the place of the pair's old one, or behind all others.
  /// @param held  energy that its springs may have [J]
  /// @return  true if the contact has kept its place in the lists
  bool put(Update& update, Group& group, Pair& pair, const typename Group::Contact& contact,
           const std::vector<typename Group::Point>& points, double held);

  /// Of a joint: the index of its law.
  [[nodiscard]] std::int32_t law_of(int cut) const {
    return cut >= 0 && index(cut) < law_of_cut_.size() ? law_of_cut_[index(cut)] : 0;
  }

  /// -1: no node of a lining.
  [[nodiscard]] std::int32_t interface_law_of(int body) const {
    return index(body) < interface_law_of_.size() ? interface_law_of_[index(body)] : -1;
  }

  /// Lists every body's contacts; those without points are on no list.
  void list(std::size_t body_count) {
    sums_.list(body_count, size(), [this](auto&& visit) {
      this->each([&](const auto&, const auto& c) { visit(c.a, c.b, c.first < c.last); });
    });
  }
  /// Drops what is no longer used, and puts contacts in the order of the pairs.
  void tidy(Update& update) {
    for (std::size_t kind = 0; kind < groups_.size(); ++kind)
      groups_[kind].keep([&](auto&& visit) {
        for (Pair& pair : update.tracker.pairs())
          if (pair.contact >= 0 && update.kind_of(pair) == kind) visit(pair.contact);
      });
    unused_ = 0;
  }
  /// Gives the contacts that carry on a former one the shear force that it had, as far as its
  /// energy goes; one may have become several.
  void share_out(Update& update);

  std::array<Group, 3> groups_;             ///< joints, walls, interface
  std::array<Former, 3> former_;            ///< that these carry on
  std::array<std::vector<Heir>, 3> heirs_;  ///< of these, at the update that carries them on
  bool carries_on_ = false;                 ///< contacts of another store, at the next update
  bool has_started_ = false;  ///< contacts have been found once: what overlaps then is given
  std::vector<int> law_of_cut_;
  std::vector<std::int32_t> interface_law_of_;  ///< of every body; -1: it is no node of a lining
  double viscous_damping_;
  bool joint_fibres_;
  std::size_t unused_ = 0;  ///< contacts without points, and points without contact (as runs)
  detail::ContactSums<Dim> sums_;
  detail::BodyRates<Dim> rates_;
};

}  // namespace voussoir

#include <voussoir/model/detail/network_update.hpp>
