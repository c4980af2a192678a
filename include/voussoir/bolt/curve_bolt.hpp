// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <voussoir/bolt/bar_in_rock.hpp>
#include <voussoir/bolt/bar_stretch.hpp>
#include <voussoir/bolt/bolt_curve.hpp>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/invariants.hpp>

namespace voussoir {

/// A bolt by its curve of force over extension, along the line between the anchors: a cable whose
/// bond slips, a bolt that yields until its elongation is used up, one held by its ends alone, or
/// what a test has measured.
///
///   f = F(w) where w = w_0 + l - d_init grows beyond what it was,  else  K (w - p) >= 0,
///   p = w_max - F(w_max) / K
///
/// F the curve, K its first slope, w_0 where it carries the pretension, l the present distance of
/// the anchors. At the end of a curve that breaks the bolt is lost at this joint. Tension only.
///
/// Of a bar in rock (see `BondedBolt`, `EndAnchoredBolt`) the curve is that of the joint at which
/// it is installed. Bond that slips to and fro is not followed: it is let go and pulled again with
/// K.
class CurveBolt {
 public:
  using role = roles::BoltLaw;
  static constexpr const char* name = "CurveBolt";

  struct State {
    double reached = 0;  ///< w_max [m]
    bool ruptured = false;
    double lost = 0;  ///< with the bolt when it broke [J]
  };

  /// @param pretension  T0 [N], >= 0; more than bond or an anchor holds is that
  /// @throws InvalidInput  out of range, or the bolt would break of it
  explicit CurveBolt(BoltCurve curve, double pretension = 0)
      : curve_(std::make_shared<BoltCurve>(std::move(curve))), pretension_(pretension) {
    require(pretension >= 0 && std::isfinite(pretension), "pretension", pretension, ">= 0 N");
    const double strength = curve_->strength();
    if (curve_->breaks())
      require(pretension < strength, "pretension", pretension, "below what breaks the bolt");
    seat_ = curve_->extension_at(std::min(pretension, strength));
  }
  /// @throws InvalidInput  a value out of range
  explicit CurveBolt(const BarInRock& bar, double pretension = 0)
      : CurveBolt(curve_of(bar, long_bolt(bar)), pretension) {
    bar_ = bar;
  }

  [[nodiscard]] const BoltCurve& curve() const { return *curve_; }
  /// Of a bar in rock where it crosses a joint; none: the same everywhere.
  [[nodiscard]] std::optional<CurveBolt> at_joint(const BoltJoint& joint) const {
    if (!bar_) return std::nullopt;
    return CurveBolt(curve_of(*bar_, joint), pretension_);
  }

  template <int Dim>
  [[nodiscard]] BoltForce<Dim> force(const BoltSpan<Dim>& span, const State& state) const {
    if (state.ruptured) return {};
    const BarStretch<Dim> now = bar_stretch(span, seat_, false);
    const double axial = tension(seat_ + now.extension, state);
    return {axial * now.direction, axial};
  }
  template <int Dim>
  bool commit(const BoltSpan<Dim>& span, State& state) const {
    if (state.ruptured) return false;
    const double now = seat_ + bar_stretch(span, seat_, false).extension;
    if (curve_->breaks() && now >= curve_->last().extension) {
      state.lost = energy(span, state);
      state.ruptured = true;
    }
    state.reached = std::max(reached(state), now);
    return state.ruptured;
  }
  template <int Dim>
  [[nodiscard]] BoltStiffness<Dim> stiffness(const BoltSpan<Dim>& span) const {
    const double length = span.initial.norm();
    if (!(length > 0)) return {diagonal_of<Dim>(curve_->stiffness())};
    // A taut bar also resists being moved sideways, by T0 / d.
    const Stress<Dim> along = outer(span.axis, span.axis);
    return {curve_->stiffness() * along +
            curve_->force(seat_) / length * (diagonal_of<Dim>(1) - along)};
  }
  ///   E = f^2 / 2 K + integral of F to w_max - F(w_max)^2 / 2 K
  ///
  /// With what pretension holds at installation counted. Of a bolt that broke all of it is lost.
  template <int Dim>
  [[nodiscard]] double energy(const BoltSpan<Dim>& span, const State& state) const {
    if (state.ruptured) return state.lost;
    const double now = seat_ + bar_stretch(span, seat_, false).extension;
    const double most = std::max(reached(state), now), first = curve_->force(most),
                 f = tension(now, state);
    return curve_->work(most) + 0.5 * (f * f - first * first) / curve_->stiffness();
  }
  template <int Dim>
  [[nodiscard]] BoltReport describe(const BoltSpan<Dim>& span, const State& state) const {
    BoltReport report = report_from_force(*this, span, state);
    const double most = std::max(reached(state), seat_ + bar_stretch(span, seat_, false).extension);
    // What is left after rounding of an elastic bolt is nothing.
    const double plastic = plastic_extension(most);
    report.plastic_extension = plastic > 1e-9 * most ? plastic : 0;
    report.is_broken = state.ruptured;
    return report;
  }

 private:
  [[nodiscard]] double reached(const State& state) const { return std::max(state.reached, seat_); }
  [[nodiscard]] double plastic_extension(double most) const {
    return most - curve_->force(most) / curve_->stiffness();
  }
  [[nodiscard]] double tension(double now, const State& state) const {
    const double most = reached(state);
    if (now >= most) return curve_->force(now);
    return std::max(0.0, curve_->stiffness() * (now - plastic_extension(most)));
  }

  std::shared_ptr<const BoltCurve> curve_;
  double pretension_, seat_ = 0;  ///< T0 [N], w_0 [m]
  std::optional<BarInRock> bar_ = {};
};

static_assert(BoltLaw<CurveBolt, 2> && BoltLaw<CurveBolt, 3>);

}  // namespace voussoir
