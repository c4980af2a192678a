// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/dynamics/added_inertia.hpp>
#include <voussoir/dynamics/dynamics_settings.hpp>
#include <voussoir/dynamics/energy_balance.hpp>
#include <voussoir/dynamics/run_diagnostics.hpp>
#include <voussoir/dynamics/run_sizes.hpp>
#include <voussoir/dynamics/run_state.hpp>
#include <voussoir/dynamics/stepping.hpp>
#include <voussoir/dynamics/time_step.hpp>
#include <voussoir/geometry/cut_facing.hpp>
#include <voussoir/model/contact_network.hpp>
#include <voussoir/model/contact_tracker.hpp>
#include <voussoir/model/detail/moving_contacts_view.hpp>
#include <voussoir/model/moving_bodies.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir {

/// Blocks that move: finite displacements and rotations, contact updates as they move.
///
/// Velocity Verlet (kick, drift, kick) with a step that is stable for the masses and stiffnesses
/// there are. Forces of contacts are computed first and then summed body by body in a fixed order:
/// the result does not depend on the number of threads, to the last bit.
///
/// Local damping is evaluated with the velocity at half steps. Source: Cundall (1987); velocity
/// Verlet: Swope et al. (1982), J. Chem. Phys. 76, 637.
/// @tparam Detector  the narrow phase by which contacts are updated
template <int Dim, class Detector = FaceContacts>
class Motion : public MovingBodies<Dim> {
  using Base = MovingBodies<Dim>;
  using MovingPart = detail::MovingPart;

 public:
  using typename Base::Body;
  using typename Base::Shape;
  using Network = ContactNetwork<Dim, Detector>;
  using State = detail::RunState<Dim, Network, ContactTracker<Dim, Detector>>;

  /// @param wall_stiffness  of smooth walls [Pa/m]
  /// @param interface_laws  of linings
  /// @param law_of_cut      for every label of the blocks' faces the index of its law
  /// @throws InvalidInput  a setting out of range
  Motion(std::vector<AnyLaw<Dim>> laws, double wall_stiffness,
         std::vector<AnyLaw<Dim>> interface_laws, std::vector<int> law_of_cut,
         const DynamicsSettings& settings)
      : settings_(settings),
        network_(std::move(laws), wall_stiffness, std::move(interface_laws), std::move(law_of_cut),
                 settings.viscous_damping, settings.joint_fibres),
        stepping_(settings.threads) {
    settings.check();
    if (Dim == 3 && settings.joint_fibres)
      throw InvalidInput("joint_fibres: joints are of fibres in 2-D alone");
  }

  // ---- what there is ---------------------------------------------------------------------------

  /// Adds what holds bodies besides contacts; at any time.
  void add_support(std::shared_ptr<Support<Dim>> support) {
    begin();
    supports_.add(std::move(support), bodies_);
    forget();
  }
  /// Adds the nodes of a lining; what joins them is a support.
  /// @return  number of the first
  /// @throws InvalidInput  a node without mass or inertia
  /// @param law  index into those of the rock-lining interface
  int add_lining_nodes(const std::vector<LiningNode<Dim>>& nodes, int law) {
    for (const auto& node : nodes) node.check();
    const int first = this->body_count();
    network_.set_interface_law(law, first, static_cast<int>(nodes.size()));
    for (const auto& node : nodes) this->add_node(node, BodyRole::lining);
    return first;
  }
  /// Takes a body out, with its contacts and what supports are to it: an excavation. Its energy
  /// goes with it.
  void remove(int b) { remove(std::vector<int>{b}); }
  void remove(const std::vector<int>& gone) {
    if (gone.empty()) return;
    begin();
    BodyMarks marks(bodies_.size(), 0);
    for (const int b : gone) marks[index(b)] = 1;
    supports_.remove(marks, bodies_);
    for (const int b : gone) leave_out(b);
    forget();
    find_contacts();
  }
  /// The same before anything is computed.
  void leave_out(int b) {
    this->stop(b);
    bodies_[index(b)].is_gone = true;
  }
  /// Contacts of a model that is set in motion, before anything is computed (see
  /// `ContactNetwork::carry_on`).
  void carry_on(typename Network::Former joints, typename Network::Former walls,
                typename Network::Former interface) {
    network_.carry_on(std::move(joints), std::move(walls), std::move(interface));
  }
  /// Holds a block where it is from now on.
  void fix(int b) {
    begin();
    this->stop(b);
    forget();
  }
  /// See `detail::add_inertia`: what rests, rests as before; what moves, moves later.
  /// @param share  of all bodies, that are the first to be made so [-], >= 0 and < 1
  void add_inertia(double share);
  /// Other joint laws from now on, as many as there are; what the springs then hold differently is
  /// no work of the run.
  void set_laws(std::vector<AnyLaw<Dim>> laws) {
    begin();
    const double before = network_.stored_energy(bodies_);
    network_.set_laws(std::move(laws));
    contacts_at_start_ += network_.stored_energy(bodies_) - before;
    forget();
  }
  /// @param alpha  local damping from now on [-], 0 <= alpha < 1
  void set_local_damping(double alpha) {
    DynamicsSettings settings = settings_;
    settings.local_damping = alpha;
    settings.check();
    settings_ = settings;
    stable_step_ = 0;
  }
  /// Gives every closed contact the traction of a stress field in which the blocks as they lie now
  /// are in equilibrium: before the first step.
  /// @param stress_at  stress_at(point) [Pa], compression positive
  /// @param closed     contacts open by no more than this are closed [m]
  template <class StressAt>
  void prescribe(StressAt&& stress_at, double closed) {
    begin();
    network_.prescribe(
        bodies_, [&](const Vec<Dim>& p) { return stress_at(Vec<Dim>(p + origin_)); }, closed);
    start_audit();
  }
  /// Loads every block with what it needs to be in equilibrium now, besides its other loads. This
  /// is what an excavation takes away: `set_held(fraction)` leaves a part of it.
  void hold();
  /// The same with these loads, one for every body.
  void hold(std::vector<Load<Dim>> loads) {
    held_ = std::move(loads);
    set_held(1);
  }
  void set_held(double fraction) {
    held_fraction_ = fraction;
    are_loads_fresh_ = false;  // contacts know nothing of it
  }
  [[nodiscard]] double held() const { return held_fraction_; }
  /// Lets these bodies alone move from now on; all others stay where they are, and what they had of
  /// velocity is taken from them as damping would. A step costs what these bodies and their
  /// contacts cost; forces on all bodies stay up to date.
  void move_only(const std::vector<int>& bodies);
  /// Lets all bodies move.
  void move_all() { move(MovingPart{}); }
  [[nodiscard]] bool moves(int b) const {
    return part_.is_all || std::binary_search(part_.bodies.begin(), part_.bodies.end(),
                                              static_cast<std::uint32_t>(b));
  }
  /// Moves bodies by hand, a little, and takes away the energy that this sets free: a step of a
  /// search for equilibrium amid the motion. Joints slip on the way as they would.
  /// @param step  for every body its shift [m] and turn [rad], world axes; those that are fixed or
  ///              gone stay
  /// @return  that energy [J]; < 0: the step went too far, and has given some
  double displace(const Eigen::VectorXd& step);

  // ---- what it does ----------------------------------------------------------------------------

  [[nodiscard]] const DynamicsSettings& settings() const { return settings_; }
  [[nodiscard]] const auto& joints() const { return network_.joints(); }
  [[nodiscard]] const auto& walls() const { return network_.walls(); }
  [[nodiscard]] const auto& interface() const { return network_.interface(); }
  [[nodiscard]] const SupportSet<Dim>& supports() const { return supports_; }
  [[nodiscard]] double time() const { return time_; }  ///< [s]
  [[nodiscard]] std::int64_t steps() const { return steps_; }
  [[nodiscard]] double step() const { return step_; }  ///< the last one [s]

  /// Force and moment of all contacts on a body, world axes [N], [N m].
  [[nodiscard]] Load<Dim> contact_load(int b) {
    begin();
    const auto [force, moment] = network_.gather(index(b));
    return {force, moment};
  }
  /// Force and moment that nothing balances, world axes [N], [N m]; zero for one that is fixed.
  [[nodiscard]] Load<Dim> out_of_balance(int b) {
    begin();
    return bodies_[index(b)].movable() ? forces().total(index(b)) : Load<Dim>{};
  }
  /// See `detail::ForcesOnBodies::unbalance_of` [-].
  [[nodiscard]] double unbalance_of(int b) {
    begin();
    return forces().unbalance_of(index(b));
  }
  /// The same, with what is out of balance on it.
  [[nodiscard]] double unbalance_of(int b, const Load<Dim>& out_of_balance) const {
    return detail::unbalance_of(bodies_[index(b)], out_of_balance, settings_.gravity);
  }
  /// The same of the worst body [-].
  [[nodiscard]] double unbalance_over_weight() {
    begin();
    return forces().unbalance_over_weight();
  }
  /// Calls visit(other) for every body that a contact joins to this one.
  template <class Visit>
  void each_neighbour(int b, Visit&& visit) const {
    network_.each_neighbour(index(b), visit);
  }

  /// Where energy has gone since the beginning.
  [[nodiscard]] EnergyBalance energy() {
    begin();
    EnergyBalance now = audit_;
    now.kinetic = this->kinetic_energy() - kinetic_given_;
    now.kinetic -= 0.125 * step_ * step_ * (kinetic_rates() - kinetic_rates_at_start_);
    now.contacts = network_.stored_energy(bodies_) - contacts_at_start_;
    now.supports = supports_.energy(bodies_);
    return now;
  }

  /// The largest step that is stable for the contacts there are, damping included [s]; infinite
  /// without contacts (`detail::stable_time_step`).
  [[nodiscard]] double stable_step() {
    begin();
    return longest_step();
  }

  /// All that the run consists of now. A copy: of thousands of blocks it takes as long as a hundred
  /// steps.
  [[nodiscard]] State state() {
    begin();
    return {bodies_,        network_, *tracker_, audit_,         supports_,
            kinetic_given_, time_,    steps_,    held_fraction_, part_};
  }
  /// Goes back to where the run was, and on from there as it would have gone.
  /// @param state  of this run, with the bodies and supports that it has now
  void go_back_to(const State& state) {
    take(state);
    forget();
  }

  /// Moves on by a time; steps are shortened a little so that a whole number of them meets it.
  /// @throws NumericalFault  the run went bad (see `RunDiagnostics`): it is back in the last sound
  /// state
  void advance(double time);
  /// Moves on by a number of steps.
  void advance_steps(int count) {
    require(count >= 0, "steps to advance", count, ">= 0");
    while (count > 0) {
      const double step = choose_step();
      count -= run_batch(std::min(count, settings_.check_every), step);
    }
  }

 private:
  /// Before anything is asked: bodies that are new are taken in, and forces computed.
  void begin() {
    take_in();
    if (fresh_ && is_part_fresh_ && are_loads_fresh_) return;
    if (fresh_ && is_part_fresh_)
      stepping_.settle(forces());
    else
      (void)freshen();
    are_loads_fresh_ = true;
    if (steps_ == 0) kinetic_rates_at_start_ = kinetic_rates();
  }
  /// Of what moves without damping, see `Kick::kinetic_rate` [J/s^2].
  [[nodiscard]] double kinetic_rates() const {
    double sum = 0;
    if (settings_.local_damping == 0 && settings_.viscous_damping == 0)
      part_.each_body(bodies_.size(), [&](std::size_t b) {
        if (bodies_[b].movable()) sum += stepping_.acting()[b].kinetic_rate(bodies_[b]);
      });
    return sum;
  }
  /// @return  what contacts lose by that: of bodies that were moved by hand
  Dissipation freshen() {
    if (!fresh_) {
      part_.contacts = network_.contacts_of(part_.bodies);  // they may have other numbers
      const MovingPart all;
      return freshen(all);
    }
    return freshen(part_);
  }
  Dissipation freshen(const MovingPart& part) {
    const Dissipation lost = stepping_.freshen(forces(part));
    fresh_ = is_part_fresh_ = true;
    return lost;
  }
  void move(MovingPart part) {
    begin();
    only_part_has_moved_ = false;
    part_ = std::move(part);
    stable_step_ = 0;
    (void)freshen();  // what acts on those that move anew
  }

  void take_in();
  /// After a change by hand: the last sound state knows nothing of it, nor does what was computed.
  void forget() {
    sound_.reset();
    stable_step_ = 0;
    fresh_ = only_part_has_moved_ = false;
  }

  void start_audit() {
    kinetic_given_ = this->kinetic_energy();
    contacts_at_start_ = network_.stored_energy(bodies_);
    supports_.start(bodies_);
    audit_ = {};
    forget();
  }

  void find_contacts();

  /// Looks whether the run is sound; if not, goes back to when it was, and says what is wrong.
  void check();
  void take(const State& state);

  // ---- steps -----------------------------------------------------------------------------------

  [[nodiscard]] double longest_step() {
    const std::vector<double> sums = stiffness_over_mass();
    const std::vector<double>& damping = network_.rates(bodies_).damping();
    return detail::stable_time_step(*std::max_element(sums.begin(), sums.end()),
                                    *std::max_element(damping.begin(), damping.end()), settings_);
  }
  /// Of every body, all others fixed [1/s^2].
  [[nodiscard]] std::vector<double> stiffness_over_mass() {
    std::vector<double> sums = network_.rates(bodies_).stiffness();
    supports_.add_stiffness_over_mass(bodies_, sums);
    return sums;
  }
  [[nodiscard]] double choose_step();
  [[nodiscard]] detail::ForcesOnBodies<Dim, Network> forces(const MovingPart& part) {
    return {bodies_, network_,       supports_,         loads_,
            held_,   held_fraction_, settings_.gravity, settings_.local_damping,
            part};
  }
  [[nodiscard]] detail::ForcesOnBodies<Dim, Network> forces() { return forces(part_); }

  /// Makes `count` steps, or fewer: contacts are looked for again before a body can have moved
  /// further than they are listed for. The way is summed up step by step, with the speeds there
  /// are: what gravity, loads or a blow give to a body within the batch counts.
  /// @return  the number of steps made
  int run_batch(int count, double step);

  DynamicsSettings settings_;

 protected:
  Network network_;

 private:
  detail::Stepping<Dim, Network> stepping_;
  static constexpr int lining_family = -1;

  using Base::bodies_;
  using Base::fresh_;
  using Base::home_;
  using Base::index;
  using Base::is_filling_;
  using Base::kinetic_given_;
  using Base::loads_;
  using Base::origin_;
  using Base::roles_;
  using Base::shapes_;
  std::vector<Load<Dim>> held_;
  double held_fraction_ = 0;
  MovingPart part_;
  bool is_part_fresh_ = true;         ///< what acts on those that move is known, as all else is
  bool are_loads_fresh_ = true;       ///< so is what else acts on them
  bool only_part_has_moved_ = false;  ///< since contacts were last looked for
  SupportSet<Dim> supports_;
  std::optional<ContactTracker<Dim, Detector>> tracker_;
  EnergyBalance audit_;
  double contacts_at_start_ = 0;
  double kinetic_rates_at_start_ = 0;  ///< see `kinetic_rates` [J/s^2]
  detail::RunSizes sizes_{};
  double time_ = 0, step_ = 0, stable_step_ = 0;
  std::int64_t steps_ = 0, checked_ = 0;
  std::optional<State> sound_;                       ///< when it was last found sound
  std::size_t known_bodies_ = 0, known_shapes_ = 0;  ///< to the tracker
};

}  // namespace voussoir

#include <voussoir/dynamics/detail/motion_steps.hpp>
