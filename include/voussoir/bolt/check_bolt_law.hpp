// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/law_trials.hpp>
#include <voussoir/core/message_number.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// How hard `check_law` tries a bolt law.
struct BoltLawTrial {
  double largest_force = 3e5;  ///< to which an elastic bolt would be pulled, and ten times it [N]
  int paths = 200;             ///< random ones, of 60 steps each
};

namespace detail {

template <class Law, int Dim>
class BoltLawCheck {
 public:
  using State = typename Law::State;
  using Span = BoltSpan<Dim>;
  using Force = BoltForce<Dim>;

  BoltLawCheck(const Law& law, const BoltLawTrial& trial)
      : law_(law), trial_(trial), findings_(Law::name), random_(78, Dim) {}

  [[nodiscard]] std::vector<std::string> run() {
    for (int n = 0; n < trial_.paths; ++n) {
      const Span span = drawn_span();
      bound_ = law_.stiffness(span);
      if (!check_units(span)) break;  // every length below comes from the stiffness
      extension_ = trial_.largest_force / span.axis.dot(bound_.pull * span.axis);
      check_bound();
      check_fresh_bolt(span);
      follow_path(span);
      check_booking(span);
    }
    return findings_.all();
  }

 private:
  bool check_units(const Span& span) {
    const double along = span.axis.dot(bound_.pull * span.axis);
    if (along >= 1e3 && along <= 1e12) return true;
    findings_.add("`stiffness` along the bar is " + message_number(along, 3) +
                  " N/m: of rock bolts across a joint it is 1e7 to 1e9 N/m, and 1e3 to 1e12 are "
                  "taken; is it in MN/m or GN/m?");
    return false;
  }

  void check_bound() {
    const auto check = [&](const char* name, const Stress<Dim>& k) {
      const double size = k.trace();
      const Vec<Dim> way = drawn(1.0);
      if (!((k - transpose_of(k)).norm() <= rounding * std::abs(size)) ||
          !(way.dot(k * way) >= -rounding * size))
        findings_.add(std::string("`stiffness`: that of ") + name +
                      " is not symmetric, or negative in a direction");
    };
    check("`pull`", bound_.pull);
    check("`dowel`", bound_.dowel);
  }

  /// Pulled apart it pulls back; what is turned as a whole has its force turned with it.
  void check_fresh_bolt(Span span) {
    span.motion = span.jump = 0.1 * extension_ * span.axis;
    const Force pulled = law_.force(span, State{});
    if (!(pulled.pull.dot(span.axis) > 0) ||
        !(std::abs(pulled.axial - pulled.pull.norm()) <= 1e-6 * pulled.pull.norm()))
      findings_.add("pulled apart along its bar it has a pull of " +
                    message_number(pulled.pull.dot(span.axis), 3) +
                    " N along it and says axial = " + message_number(pulled.axial, 3) +
                    " N: tension is positive, and `pull` is the force on the first anchor");
    span.motion += drawn(0.3 * extension_);
    span.jump += drawn(0.3 * extension_);
    Spin<Dim> angle;
    for (int k = 0; k < spin_count<Dim>; ++k) angle[k] = 2 * random_.uniform() - 1;
    const Rotation<Dim> turn = rotation_by(angle);
    const Span turned_span{turn * span.initial, turn * span.axis, turn * span.motion,
                           turn * span.jump};
    const Force here = law_.force(span, State{}), there = law_.force(turned_span, State{});
    const double scale = 1e-6 * (here.pull.norm() + here.dowel.norm());
    if (!((there.pull - turn * here.pull).norm() <= scale) ||
        !((there.dowel - turn * here.dowel).norm() <= scale))
      findings_.add("a span that is turned as a whole has not its force turned with it");
  }

  void follow_path(Span span) {
    const double size = extension_ * std::pow(10.0, -3 + 4 * random_.uniform());
    State state{};
    for (int k = 0; k < steps; ++k) {
      span.motion = Vec<Dim>(0.9 * span.motion + drawn(size));
      span.jump = Vec<Dim>(span.motion + drawn(size));
      check_tangents(span, state, size);
      const Force before = law_.force(span, state);
      const double energy = law_.energy(span, state);
      const bool broke = law_.commit(span, state);
      check_commit(span, state, before, energy, broke);
      if (broke) return;
    }
  }

  void check_tangents(const Span& span, const State& state, double size) {
    const double step = 1e-6 * extension_;
    const Vec<Dim> way = drawn(1.0), shift = step * way;
    const Force here = law_.force(span, state);
    Span other = span;
    other.motion += shift;
    const Force moved = law_.force(other, state);
    other = span;
    other.jump += shift;
    const Force jumped = law_.force(other, state);
    const double noise = 1e-14 * (here.pull.norm() + here.dowel.norm()) * way.norm() / step;
    // Far from the initial span a bar has turned: there the bound is that of any direction.
    const bool is_near = size < 1e-2 * extension_;
    const auto check = [&](const char* name, double tangent, const Stress<Dim>& k) {
      const double any = k.trace() * way.squaredNorm();
      const double most = is_near ? way.dot(k * way) + 1e-2 * any : any * 1.001;
      if (tangent <= most + noise) return;
      findings_.add("stiffness bound: the tangent of " + std::string(name) + " is " +
                    message_number(tangent / way.squaredNorm(), 3) +
                    " N/m by differences, and `stiffness` says " +
                    message_number(most / way.squaredNorm(), 3) +
                    " N/m: time steps would be unstable");
    };
    check("`pull`", (moved.pull - here.pull).dot(way) / step, bound_.pull);
    check("`dowel`", (jumped.dowel - here.dowel).dot(way) / step, bound_.dowel);
    if (!((moved.dowel - here.dowel).norm() <= noise * step) ||
        !((jumped.pull - here.pull).norm() <= noise * step))
      findings_.add(
          "`pull` follows `motion` alone and `dowel` follows `jump` alone: `stiffness` and "
          "`energy` have no place for more");
  }

  void check_commit(const Span& span, const State& state, const Force& before, double energy,
                    bool broke) {
    const Force after = law_.force(span, state);
    const double scale = rounding * (before.pull.norm() + before.dowel.norm() + 1),
                 change = (after.pull - before.pull).norm() + (after.dowel - before.dowel).norm();
    if (!broke && !(change <= scale))
      findings_.add("`commit` changes the force at the same motion by " +
                    message_number(change, 3) + " N, and does not say that the bolt broke");
    const double kept = law_.energy(span, state);
    if (!(std::abs(kept - energy) <= rounding * (std::abs(energy) + scale * extension_)))
      findings_.add("`commit` changes `energy` by " + message_number(kept - energy, 3) +
                    " J: what is lost is counted on");
    State again = state;
    const bool broke_again = law_.commit(span, again);
    const Force twice = law_.force(span, again);
    if (broke_again || !((twice.pull - after.pull).norm() <= scale) ||
        !((twice.dowel - after.dowel).norm() <= scale))
      findings_.add(
          "a second `commit` at the same motion changes something: equilibrium would be "
          "sought for ever");
    const BoltReport report = report_of(law_, span, state, broke);
    if (!(std::abs(report.axial - after.axial) <= scale) ||
        !(std::abs(report.shear - after.dowel.norm()) <= scale))
      findings_.add("`describe` tells other forces than `force`");
  }

  /// In fine steps the work done on it is what its energy grows by.
  void check_booking(Span span) {
    State state{};
    const double size = extension_ * std::pow(10.0, -1 + 2 * random_.uniform());
    const Vec<Dim> motion = drawn(size), jump = drawn(size);
    const double start = law_.energy(span, state);
    double work = 0, turned_over = 0, longest = 0;
    for (int k = 1; k <= fine_steps; ++k) {
      const Force before = law_.force(span, state);
      const Span from = span;
      const double t = static_cast<double>(k) / fine_steps;
      span.motion = std::sin(5 * t) * motion;
      span.jump = Vec<Dim>(span.motion + std::sin(8 * t) * jump);
      const Force now = law_.force(span, state);
      const double step = 0.5 * (before.pull + now.pull).dot(span.motion - from.motion) +
                          0.5 * (before.dowel + now.dowel).dot(span.jump - from.jump);
      work += step;
      turned_over += std::abs(step);
      longest = std::max(longest, std::abs(step));
      (void)law_.commit(span, state);
    }
    const double grown = law_.energy(span, state) - start;
    if (!(std::abs(work - grown) <= booking * turned_over + longest))
      findings_.add("`energy` grows by " + message_number(grown, 3) +
                    " J on a path whose work is " + message_number(work, 3) +
                    " J: energy is not booked");
  }

  /// Anchors near the joint, in the middle of blocks, or on the joint.
  [[nodiscard]] Span drawn_span() {
    const double distances[] = {0.0672, 0.77, 0.0};
    Vec<Dim> axis = drawn(1.0);
    while (!(axis.norm() > 0.1)) axis = drawn(1.0);
    axis /= axis.norm();
    return {distances[random_.below(3)] * axis, axis, zeros<Vec<Dim>>()};
  }
  [[nodiscard]] static Stress<Dim> transpose_of(const Stress<Dim>& k) { return transposed(k); }
  [[nodiscard]] Vec<Dim> drawn(double size) { return drawn_vector<Dim>(random_, size); }

  static constexpr double rounding = 1e-9;
  /// Of what is turned over; and of the step in which a bolt breaks all.
  static constexpr double booking = 5e-3;
  static constexpr int steps = 60, fine_steps = 2000;

  const Law& law_;
  BoltLawTrial trial_;
  LawFindings findings_;
  Random random_;
  BoltStiffness<Dim> bound_{};
  double extension_ = 0;  ///< at the largest force, if it stays elastic [m]
};

}  // namespace detail

/// Tries what the compiler cannot check of a bolt law (see `BoltLaw`): units, signs, that a span
/// turned as a whole has its force turned with it, that a commit changes neither force nor energy
/// but where the bolt breaks, tangents of pull and dowel against differences and the bounds that it
/// states, and on random paths that its energy grows by the work done.
/// @return  what is wrong, a sentence for each property; nothing of a sound law
/// @cost    a tenth of a second
template <int Dim = 2, class Law>
requires BoltLaw<Law, Dim>
[[nodiscard]] std::vector<std::string> check_law(const Law& law, const BoltLawTrial& trial = {}) {
  return detail::BoltLawCheck<Law, Dim>(law, trial).run();
}

}  // namespace voussoir
