// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/law_trials.hpp>
#include <voussoir/core/message_number.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// How hard `check_law` tries a contact law.
struct ContactLawTrial {
  double largest_stress = 2e6;  ///< to which points are pressed in situ [Pa]
  int paths = 200;              ///< random ones, of 60 steps each
  double shear_over_normal =
      1;  ///< largest in-situ shear over normal force, where the law bears it
};

namespace detail {

template <class Law, int Dim>
class ContactLawCheck {
 public:
  using State = typename Law::template State<Dim>;

  ContactLawCheck(const Law& law, const ContactLawTrial& trial)
      : law_(law), trial_(trial), findings_(Law::name), random_(77, Dim) {}

  [[nodiscard]] std::vector<std::string> run() {
    if (!check_units()) return findings_.all();  // every length below comes from the stiffness
    closure_ = trial_.largest_stress / law_.joint_normal_stiffness();
    check_fresh_point();
    check_edge();
    for (int n = 0; n < trial_.paths; ++n) follow_path();
    check_what_was_seen();
    return findings_.all();
  }

 private:
  bool check_units() {
    const double normal = law_.joint_normal_stiffness(), shear = law_.joint_shear_stiffness();
    bool sound = true;
    const auto check = [&](const char* name, double value, bool may_be_zero) {
      if (may_be_zero && value == 0) return;
      if (value >= least_stiffness && value <= largest_stiffness) return;
      sound = false;
      findings_.add(std::string(name) + " = " + message_number(value, 3) +
                    " Pa/m: of rock joints it is 1e8 to 1e12 Pa/m, and " +
                    message_number(least_stiffness, 1) + " to " +
                    message_number(largest_stiffness, 1) + " are taken; is it in MPa/m or GPa/m?");
    };
    check("joint_normal_stiffness()", normal, false);
    check("joint_shear_stiffness()", shear, true);
    return sound;
  }

  /// A point that has not moved has its in-situ force; one that stands for twice as much has twice
  /// the force.
  void check_fresh_point() {
    for (const double part : {0.1, 0.5, 1.0}) {
      PointLoad<Dim> load = point(0.7, part * trial_.largest_stress);
      const PointForce<Dim> now = law_.force(load, State{});
      if (!(std::abs(now.normal - load.initial.normal) <= rounding * load.initial.normal) ||
          !(now.tangential.norm() <= rounding * load.initial.normal))
        findings_.add("with a fresh state and no motion `force` returns " +
                      message_number(now.normal, 3) + " N where the in-situ force is " +
                      message_number(load.initial.normal, 3) +
                      " N: the rock would move before anything is excavated");
      load.motion.opening = -0.2 * closure_;
      load.motion.slip[0] = 0.3 * closure_;
      PointLoad<Dim> twice = load;
      twice.weight *= 2;
      twice.initial.normal *= 2;
      const PointForce<Dim> once = law_.force(load, State{}), both = law_.force(twice, State{});
      if (!(std::abs(both.normal - 2 * once.normal) <= rounding * std::abs(both.normal)) ||
          !((both.tangential - 2 * once.tangential).norm() <= rounding * std::abs(both.normal)))
        findings_.add(
            "a point of twice the weight and twice the in-situ force has not twice the force: "
            "`force` returns N, not Pa; multiply stresses by `load.weight`");
    }
  }

  /// Where the law says that a point lets go, it does: joints that open from an edge rest on it.
  void check_edge() {
    for (const double part : {0.1, 1.0}) {
      PointLoad<Dim> load = point(0.7, part * trial_.largest_stress);
      const double release = opening_of(release_opening<Dim>(law_, load, State{}));
      if (!std::isfinite(release)) continue;  // points of the whole, whatever opens
      const double step = 1e-4 * closure_;
      load.motion.opening = release - step;
      const bool holds_before = law_.force(load, State{}).normal > 0;
      load.motion.opening = release + step;
      const double beyond = law_.force(load, State{}).normal;
      if (holds_before && (HasBond<Law, Dim> ? beyond <= 0 : beyond == 0)) continue;
      findings_.add(
          "edge rule: pressed by " + message_number(load.initial.normal, 3) +
          " N a point lets go at an opening of " + message_number(1e6 * release, 4) + " um, " +
          (HasRelease<Law, Dim> ? "as `release_opening` says" : "as k_n says") +
          ", and `force` there is " + (holds_before ? "not" : "already") +
          " zero: say where with `release_opening`, and with a `BondRelease` how far tension holds");
    }
  }

  /// Opening, closing and sliding at random from an in-situ state that the law bears.
  void follow_path() {
    const double weight = 0.1 + random_.uniform();
    PointLoad<Dim> load = point(weight, trial_.largest_stress * random_.uniform());
    load.initial.tangential = drawn(trial_.shear_over_normal * load.initial.normal);
    load.initial.tangential = 0.9 * law_.force(load, State{}).tangential;
    State state{};
    const double size = closure_ * std::pow(10.0, -2 + 3 * random_.uniform());
    double stored = law_.stored_energy(load, state);
    Balance balance;
    for (int k = 0; k < steps; ++k) {
      const PointMotion<Dim> from = load.motion;
      load.motion.opening = 0.9 * load.motion.opening + size * (2 * random_.uniform() - 1);
      load.motion.slip = Vec<Dim - 1>(0.9 * load.motion.slip + drawn(size));
      check_tangents(load, state);
      const PointForce<Dim> trial = law_.force(load, state);
      const double opened = load.motion.opening - from.opening;
      const Vec<Dim - 1> slipped = load.motion.slip - from.slip;
      (void)law_.commit(load, state);
      const double now = law_.stored_energy(load, state);
      // The work of the force at the end of the step: of a law with a potential that is convex it
      // is never less than what is stored, however long the step.
      const double work = -trial.normal * opened - trial.tangential.dot(slipped);
      balance.turned_over += std::abs(work) + std::abs(now - stored);
      balance.made = std::max(balance.made, now - stored - work);
      stored = now;
      check_commit(load, state, trial);
      check_report(load, state);
      if (!HasBond<Law, Dim> && trial.normal < 0)
        findings_.add(
            "edge rule: `force` returns tension, and no `release_opening` says how far it holds: "
            "return a `BondRelease` from one");
    }
    const double allowed = 1e-9 * balance.turned_over;
    if (!(balance.made <= allowed))
      findings_.add("a step of a random path makes " + message_number(balance.made, 3) +
                    " J from nothing, " +
                    message_number(100 * balance.made / balance.turned_over, 2) +
                    " % of what is turned over: `stored_energy` grows by more than the work done "
                    "on the point");
    check_booking(size);
  }

  /// In fine steps, of opening and of slip in turn, what `commit` returns is what the work leaves
  /// over, and no step changes the force by more than the bounds allow.
  void check_booking(double size) {
    PointLoad<Dim> load = point(0.5, 0.5 * trial_.largest_stress);
    State state{};
    const double stored = law_.stored_energy(load, state);
    double work = 0, lost = 0, given = 0, turned_over = 0;
    const double opening = size * (2 * random_.uniform() - 1);
    const Vec<Dim - 1> slip = drawn(10 * size);
    for (int k = 1; k <= fine_steps; ++k) {
      const PointForce<Dim> before = law_.force(load, state);
      const PointMotion<Dim> from = load.motion;
      const double t = static_cast<double>(k) / fine_steps;
      if (k % 2 == 0)
        load.motion.opening = std::sin(5 * t) * opening;
      else
        load.motion.slip = std::sin(8 * t) * slip;
      const PointForce<Dim> now = law_.force(load, state);
      const double opened = load.motion.opening - from.opening;
      const Vec<Dim - 1> slipped = load.motion.slip - from.slip;
      // A bond that breaks lets go at once.
      if (!HasBond<Law, Dim> || before.normal >= 0)
        check_jump(load.weight, std::abs(now.normal - before.normal),
                   (now.tangential - before.tangential).norm(), std::abs(opened), slipped.norm());
      const double step = -0.5 * (before.normal + now.normal) * opened -
                          0.5 * (before.tangential + now.tangential).dot(slipped);
      work += step;
      turned_over += std::abs(step);
      const double lost_now = law_.commit(load, state);
      lost += lost_now;
      given += std::max(0.0, -lost_now);
    }
    if (!(given <= booking * turned_over))
      findings_.add("`commit` returns less than nothing, " + message_number(-given, 3) +
                    " J in all on one path: what slip and damage use up is never negative");
    const double left = work - (law_.stored_energy(load, state) - stored);
    if (!(std::abs(left - lost) <= booking * turned_over))
      findings_.add("`commit` returns " + message_number(lost, 3) + " J on a path that uses up " +
                    message_number(left, 3) +
                    " J, work less what `stored_energy` grows by: energy is not booked");
  }

  /// @param opened, slipped  one of them is zero [m]
  void check_jump(double weight, double normal, double shear, double opened, double slipped) {
    const double noise = 1e-12 * trial_.largest_stress * weight;
    if ((slipped > 0 || normal <= 1.05 * law_.joint_normal_stiffness() * weight * opened + noise) &&
        (opened > 0 || shear <= 1.05 * law_.joint_shear_stiffness() * weight * slipped + noise))
      return;
    findings_.add("the force jumps on a path of fine steps, by " +
                  message_number(opened > 0 ? normal : shear, 3) + " N where " +
                  message_number(1e6 * (opened + slipped), 3) +
                  " um and the stiffness that the law states allow less: no method can balance a "
                  "block on it");
  }

  void check_tangents(const PointLoad<Dim>& load, const State& state) {
    const double step = 1e-6 * closure_;
    const PointForce<Dim> here = law_.force(load, state);
    PointLoad<Dim> other = load;
    other.motion.opening -= step;
    const double normal = (law_.force(other, state).normal - here.normal) / (step * load.weight);
    other = load;
    const Vec<Dim - 1> way = drawn(1.0);
    if (!(way.norm() > 0)) return;
    other.motion.slip += step / way.norm() * way;
    const double shear =
        (law_.force(other, state).tangential - here.tangential).norm() / (step * load.weight);
    // Differences of forces of 1e4 times what the step makes leave 1e-12 of them.
    const double noise =
        1e-15 * (std::abs(here.normal) + here.tangential.norm()) / (step * load.weight);
    steepest_normal_ = std::max(steepest_normal_, normal);
    steepest_shear_ = std::max(steepest_shear_, shear);
    largest_shear_ = std::max(largest_shear_, here.tangential.norm());
    const auto check = [&](const char* what, const char* bound, double tangent, double most) {
      if (tangent <= most + noise) return;
      findings_.add("stiffness bound: " + std::string(what) + " is " + message_number(tangent, 3) +
                    " Pa/m by differences, and " + bound + " says " + message_number(most, 3) +
                    " Pa/m: time steps would be unstable");
    };
    check("dN/dg", "joint_normal_stiffness()", normal,
          law_.joint_normal_stiffness() * (1 + rounding));
    // A joint that lifts as it slips is pressed more, and its shear rises with that, too: by 2 % of
    // the bound in a BartonBandisJoint with M = 1. Steps are a part of the stable one.
    check("dT/ds", "joint_shear_stiffness()", shear, law_.joint_shear_stiffness() * 1.05);
    if (normal < -noise - 1e-6 * law_.joint_normal_stiffness())
      findings_.add(
          "a point that is closed further is pressed less, dN/dg = " + message_number(normal, 3) +
          " Pa/m: opening is positive, and so is compression");
  }

  void check_commit(const PointLoad<Dim>& load, const State& state, const PointForce<Dim>& trial) {
    const PointForce<Dim> after = law_.force(load, state);
    const double scale = std::max({std::abs(trial.normal), trial.tangential.norm(),
                                   1e-9 * trial_.largest_stress * load.weight});
    // A law that weakens drops to what it still carries, in the commit itself. What it then slips
    // on may lift it, and press it more.
    const double raised = after.tangential.norm() - trial.tangential.norm(),
                 pressed = std::abs(after.normal) - std::abs(trial.normal);
    if (!(raised <= rounding * scale) || !(pressed <= rounding * scale || raised < 0))
      findings_.add("`commit` raises the force at the same motion, by " +
                    message_number(raised, 3) + " N of shear and " + message_number(pressed, 3) +
                    " N of normal force: it must stay as it was, or weaken");
    State again = state;
    const double lost = law_.commit(load, again);
    const PointForce<Dim> twice = law_.force(load, again);
    const double energy = law_.stored_energy(load, state);
    if (!(std::abs(twice.normal - after.normal) <= rounding * scale) ||
        !((twice.tangential - after.tangential).norm() <= rounding * scale))
      findings_.add(
          "a second `commit` at the same motion changes the force: it never comes to rest");
    if (!(std::abs(lost) <= rounding * (std::abs(energy) + scale * closure_)))
      findings_.add("a second `commit` at the same motion returns " + message_number(lost, 3) +
                    " J: what was used up is counted twice");
  }

  void check_report(const PointLoad<Dim>& load, const State& state) {
    const ContactReport report = report_of(law_, load, state);
    const PointForce<Dim> now = law_.force(load, state);
    const double scale = rounding * (std::abs(now.normal) + now.tangential.norm());
    if (!(std::abs(report.normal - now.normal) <= scale) ||
        !(std::abs(report.shear - now.tangential.norm()) <= scale))
      findings_.add("`describe` tells other forces than `force`");
    if (!(report.damage >= 0 && report.damage <= 1) || !(report.plastic_slip >= 0))
      findings_.add("`describe` tells a damage outside 0 to 1, or a negative plastic slip");
    if constexpr (Dim == 2 && HasPairForce<Law>) check_pair(load, state);
  }

  void check_pair(const PointLoad<2>& load, const State& state) {
    const State two[2] = {state, State{}};
    PointLoad<2> other = load;
    other.motion.opening *= 0.5;
    const PairLoad pair{LanePair(load.weight, other.weight),
                        LanePair(load.initial.normal, other.initial.normal),
                        LanePair(load.initial.tangential[0], other.initial.tangential[0]),
                        LanePair(load.motion.opening, other.motion.opening),
                        LanePair(load.motion.slip[0], other.motion.slip[0])};
    const PairForce both = law_.pair_force(pair, two);
    const PointForce<2> one[2] = {law_.force(load, two[0]), law_.force(other, two[1])};
    for (int k = 0; k < 2; ++k)
      if (both.normal[k] != one[k].normal || both.shear[k] != one[k].tangential[0])
        findings_.add("`pair_force` is not bit for bit what `force` returns");
  }

  /// A bound that nothing comes near is in another unit.
  void check_what_was_seen() {
    const auto check = [&](const char* name, double said, double seen) {
      if (seen >= 0.01 * said) return;
      findings_.add(std::string(name) + " = " + message_number(said, 3) +
                    " Pa/m, and the steepest rise of `force` is " + message_number(seen, 3) +
                    " Pa/m: are both in the same unit?");
    };
    check("joint_normal_stiffness()", law_.joint_normal_stiffness(), steepest_normal_);
    if (largest_shear_ > 0)
      check("joint_shear_stiffness()", law_.joint_shear_stiffness(), steepest_shear_);
  }

  [[nodiscard]] static PointLoad<Dim> point(double weight, double stress) {
    return {weight, {stress * weight, zeros<Vec<Dim - 1>>()}, {0, zeros<Vec<Dim - 1>>()}};
  }
  [[nodiscard]] Vec<Dim - 1> drawn(double size) { return drawn_vector<Dim - 1>(random_, size); }

  struct Balance {
    double turned_over = 0, made = 0;  ///< [J]
  };
  static constexpr double least_stiffness = 1e6, largest_stiffness = 1e14;  // [Pa/m]
  static constexpr double rounding = 1e-9;
  /// Of what is turned over: ten times what the laws of the toolkit miss by the length of steps.
  static constexpr double booking = 2e-3;
  static constexpr int steps = 60, fine_steps = 2000;

  const Law& law_;
  ContactLawTrial trial_;
  LawFindings findings_;
  Random random_;
  double closure_ = 0;  ///< of the largest stress [m]
  double steepest_normal_ = 0, steepest_shear_ = 0, largest_shear_ = 0;
};

}  // namespace detail

/// Tries what the compiler cannot check of a contact law (see `ContactLaw`): units, what a fresh
/// point carries, that a commit changes nothing and a second one nothing at all, tangents against
/// differences and the bounds that it states, where it lets go (the edge rule), and on random paths
/// that it makes no energy and books what it uses up.
/// @return  what is wrong, a sentence for each property; nothing of a sound law
/// @cost    milliseconds
template <int Dim = 2, class Law>
requires ContactLaw<Law, Dim>
[[nodiscard]] std::vector<std::string> check_law(const Law& law,
                                                 const ContactLawTrial& trial = {}) {
  return detail::ContactLawCheck<Law, Dim>(law, trial).run();
}

}  // namespace voussoir
