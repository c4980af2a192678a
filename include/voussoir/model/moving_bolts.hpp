// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir {

/// Bolts in rock that moves and turns: at every joint a spring between two anchors, fixed in the
/// blocks on either side.
///
/// The span at installation turns with the first block, so that turning the rock as a whole does
/// not strain the bolt.
template <int Dim, class Law>
class MovingBolts : public Support<Dim> {
 public:
  using Bodies = typename Support<Dim>::Bodies;

  /// One joint that a bolt crosses. Places in the frames of the two bodies, the span in that of a.
  struct Spring {
    int a = 0, b = 0, bolt = 0;
    double position = 0;  ///< of the joint, from the head [m]
    Vec<Dim> anchor_a = zeros<Vec<Dim>>(), anchor_b = zeros<Vec<Dim>>();  ///< [m]
    Vec<Dim> joint_a = zeros<Vec<Dim>>(), joint_b = zeros<Vec<Dim>>();    ///< [m]
    Vec<Dim> initial = zeros<Vec<Dim>>(), axis = zeros<Vec<Dim>>();       ///< [m], [-]
    double share = 1;  ///< 1 / spacing along the tunnel in 2-D [1/m]
    typename Law::State state{};
    bool broken = false;
    Vec<Dim> pull = zeros<Vec<Dim>>();  ///< on anchor a, at the last step, shared [N]
    Vec<Dim> now = zeros<Vec<Dim>>();   ///< from anchor to anchor, then [m]
    bool seen = false;
    double axial = 0;  ///< then, of the bolt [N]
    double work = 0;   ///< done on the bolt so far, shared [J]
  };

  explicit MovingBolts(Law law) : law_(std::move(law)) {}

  void add(Spring spring) { springs_.push_back(std::move(spring)); }
  [[nodiscard]] const std::vector<Spring>& springs() const { return springs_; }

  [[nodiscard]] std::vector<int> bodies() const override {
    std::vector<int> held;
    for (const Spring& s : springs_) {
      held.push_back(s.a);
      held.push_back(s.b);
    }
    std::sort(held.begin(), held.end());
    held.erase(std::unique(held.begin(), held.end()), held.end());
    return held;
  }

  void act(const Bodies& bodies, std::vector<Load<Dim>>& loads) override {
    for (Spring& s : springs_) {
      const auto &a = bodies[index(s.a)], &b = bodies[index(s.b)];
      const BoltSpan<Dim> span = span_of(s, a.pose, b.pose);
      if (law_.commit(span, s.state)) s.broken = true;
      const BoltForce<Dim> force = law_.force(span, s.state);
      const Vec<Dim> pull = s.share * force.pull, dowel = s.share * force.dowel;
      // The force on a does the bolt's work with the opposite sign; dowels have a span of their own
      // but move with the same joint.
      const Vec<Dim> now = span.initial + span.motion;
      if (s.seen) s.work += 0.5 * (s.pull + pull).dot(now - s.now);
      s.seen = true;
      s.now = now;
      s.pull = pull;
      s.axial = force.axial;
      push(loads[index(s.a)], a.pose.rotation * s.anchor_a, pull);
      push(loads[index(s.b)], b.pose.rotation * s.anchor_b, -pull);
      push(loads[index(s.a)], a.pose.rotation * s.joint_a, dowel);
      push(loads[index(s.b)], b.pose.rotation * s.joint_b, -dowel);
    }
  }

  [[nodiscard]] std::function<void()> keep() override {
    return [this, springs = springs_] { springs_ = springs; };
  }

  [[nodiscard]] double energy(const Bodies&) const override {
    double sum = 0;
    for (const Spring& s : springs_) sum += s.work;
    return sum;
  }

  void add_stiffness_over_mass(const Bodies& bodies, std::vector<double>& sums) const override {
    for (const Spring& s : springs_) {
      if (s.broken) continue;
      const BoltSpan<Dim> span{s.initial, s.axis, zeros<Vec<Dim>>()};
      // Of a symmetric matrix without negative eigenvalues the trace bounds the largest; a dowel
      // may be as stiff again.
      const double stiffness = 2 * s.share * law_.stiffness(span).trace();
      for (const auto& [b, arm] : {std::pair{s.a, &s.anchor_a}, std::pair{s.b, &s.anchor_b}}) {
        const auto& body = bodies[index(b)];
        if (body.movable())
          sums[index(b)] +=
              stiffness * (1 / body.mass + arm->squaredNorm() / smallest_entry(body.inertia));
      }
    }
  }

 private:
  [[nodiscard]] static std::size_t index(int b) { return static_cast<std::size_t>(b); }
  [[nodiscard]] static BoltSpan<Dim> span_of(const Spring& s, const Pose<Dim>& a,
                                             const Pose<Dim>& b) {
    BoltSpan<Dim> span;
    span.initial = a.rotation * s.initial;
    span.axis = a.rotation * s.axis;
    span.motion = b(s.anchor_b) - a(s.anchor_a) - span.initial;
    span.jump = b(s.joint_b) - a(s.joint_a);
    return span;
  }
  static void push(Load<Dim>& load, const Vec<Dim>& arm, const Vec<Dim>& force) {
    load.force += force;
    load.moment += moment_of(arm, force);
  }

  Law law_;
  std::vector<Spring> springs_;
};

}  // namespace voussoir
