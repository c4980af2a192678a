// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/bolt/bolt_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/model/bolt_crossings.hpp>
#include <voussoir/model/bolt_spring.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir {

/// Bolts: at every joint that one crosses a spring between two anchors, fixed in the blocks on
/// either side.
template <int Dim, class Law>
class BoltSet : public SupportModel<BoltSet<Dim, Law>, Dim> {
  using Base = Support<Dim>;

 public:
  using typename Base::Bodies;
  using typename Base::Poses;
  using typename Base::StiffnessSink;
  using Spring = BoltSpring<Dim, Law>;

  BoltSet() = default;
  explicit BoltSet(Law law) { add_law(std::move(law)); }

  /// @return  its index
  int add_law(Law law) {
    laws_.push_back(std::move(law));
    return static_cast<int>(laws_.size()) - 1;
  }
  void add(Spring spring) {
    springs_.push_back(std::move(spring));
    axial_.push_back(0);
  }
  /// Installs a bolt where bodies are now, free of force but for its pretension.
  /// @param crossings  of its bar with joints, in the in-situ state
  /// @param axis       of the bar there, towards its tip
  /// @param share      1 / bolt spacing along the tunnel in 2-D [1/m], 1 in 3-D
  /// @param frame_of   frame_of(body): its pose in the in-situ state, in the axes in which the set
  ///                   knows it
  /// @param span_of    span_of(spring): as it is now, in the axes of body a
  template <class FrameOf, class SpanOf>
  void install(const std::vector<BoltCrossingPoint<Dim>>& crossings, const Vec<Dim>& axis,
               int number, int law, double share, FrameOf&& frame_of, SpanOf&& span_of) {
    for (const BoltCrossingPoint<Dim>& at : crossings) {
      const Pose<Dim> a = frame_of(at.a), b = frame_of(at.b);
      Spring spring{};
      spring.a = at.a;
      spring.b = at.b;
      spring.bolt = number;
      spring.position = at.position;
      spring.joint_a = transposed_product(a.rotation, Vec<Dim>(at.joint_a - a.position));
      spring.joint_b = transposed_product(b.rotation, Vec<Dim>(at.joint_b - b.position));
      spring.arm_a = spring.joint_a - at.before * transposed_product(a.rotation, axis);
      spring.arm_b = spring.joint_b + at.after * transposed_product(b.rotation, axis);
      spring.span = {transposed_product(a.rotation, at.initial),
                     transposed_product(a.rotation, axis), zeros<Vec<Dim>>()};
      const BoltSpan<Dim> present = span_of(spring);
      spring.span.motion = -present.motion;
      spring.span.jump = -present.jump;
      spring.share = share;
      spring.law = law_at(law, {at.position, at.beyond});
      add(spring);
    }
  }
  [[nodiscard]] const std::vector<Spring>& springs() const { return springs_; }
  [[nodiscard]] const Law& law_of(const Spring& s) const {
    return laws_[static_cast<std::size_t>(s.law)];
  }
  /// Axial force of a spring at the last step of a run, of the bolt [N].
  [[nodiscard]] double axial_force(std::size_t spring) const { return axial_[spring]; }

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
  void remove(const BodyMarks& gone) override {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < springs_.size(); ++k) {
      if (is_marked(gone, springs_[k].a) || is_marked(gone, springs_[k].b)) continue;
      springs_[kept] = springs_[k];
      axial_[kept++] = axial_[k];
    }
    springs_.resize(kept, Spring{});
    axial_.resize(kept);
  }
  void take_over(const Heirs<Dim>& heirs) override {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < springs_.size(); ++k) {
      Spring& s = springs_[k];
      const auto follow = [&](int& body, Vec<Dim>& joint, Vec<Dim>& anchor) {
        const Heir<Dim> at_joint = heirs(body, joint), at_anchor = heirs(body, anchor);
        if (at_joint.is_excavated || at_anchor.is_excavated)
          throw InvalidInput(
              message({"excavate: bolt ", s.bolt, " holds rock at ", text_of<Dim>(at_anchor.place),
                       " m that is to be excavated: install it afterwards, or end it outside"}));
        body = at_joint.body;
        joint = at_joint.arm;
        anchor = at_anchor.arm;
      };
      follow(s.a, s.joint_a, s.arm_a);
      follow(s.b, s.joint_b, s.arm_b);
      if (s.a < 0 || s.b < 0) continue;
      springs_[kept] = springs_[k];
      axial_[kept++] = axial_[k];
    }
    springs_.resize(kept, Spring{});
    axial_.resize(kept);
  }
  void list_broken(std::vector<bool>& broken) const override {
    for (const Spring& s : springs_) broken.push_back(s.broken);
  }

  void add_forces(const double* u, double* f, const BodyMarks* chosen) const override {
    for (const Spring& s : springs_)
      if (is_chosen(s, chosen)) s.add_force(law_of(s), u, f);
  }
  int commit(const double* u, const BodyMarks* chosen) override {
    int broke = 0;
    for (Spring& s : springs_)
      if (is_chosen(s, chosen)) broke += s.commit(law_of(s), s.span_at(u));
    return broke;
  }
  void add_stiffness(const StiffnessSink& sink) const override {
    for (const Spring& s : springs_) s.add_stiffness(law_of(s), sink);
  }
  void add_tangent(const double* u, const BodyMarks* chosen,
                   const StiffnessSink& sink) const override {
    for (const Spring& s : springs_)
      if (is_chosen(s, chosen)) s.add_tangent(law_of(s), u, sink);
  }
  void to_frames(const Poses& frames, const double* u) override {
    for (Spring& s : springs_) s.to_frames(frames[index(s.a)], frames[index(s.b)], u);
  }
  void from_frames(const Poses& frames, const double* u) override {
    for (Spring& s : springs_) s.from_frames(frames[index(s.a)], frames[index(s.b)], u);
  }

  void act(const Bodies& bodies, std::vector<Load<Dim>>& loads) override {
    for (std::size_t k = 0; k < springs_.size(); ++k) {
      Spring& s = springs_[k];
      const Pose<Dim>&a = bodies[index(s.a)].pose, &b = bodies[index(s.b)].pose;
      const BoltSpan<Dim> span = s.span_at(a, b);
      s.commit(law_of(s), span);
      const BoltForce<Dim> force = law_of(s).force(span, s.state);
      axial_[k] = force.axial;
      for (const auto& [pull, arm] : {std::pair{s.share * force.pull, &s.arm_b},
                                      std::pair{s.share * force.dowel, &s.joint_b}}) {
        // On both where it meets b, wherever it is fixed in a: the span turns with a, and what the
        // law states as energy is the work of these forces, whatever turns.
        const Vec<Dim> place = b(*arm);
        push(loads[index(s.a)], place - a.position, pull);
        push(loads[index(s.b)], place - b.position, -pull);
      }
    }
  }
  [[nodiscard]] double energy(const Bodies& bodies) const override {
    double sum = 0;
    for (const Spring& s : springs_)
      sum += s.share *
             law_of(s).energy(s.span_at(bodies[index(s.a)].pose, bodies[index(s.b)].pose), s.state);
    return sum;
  }
  void add_stiffness_over_mass(const Bodies& bodies, std::vector<double>& sums) const override {
    for (const Spring& s : springs_) {
      if (s.broken) continue;
      const BoltSpan<Dim> span{s.span.initial, s.span.axis, zeros<Vec<Dim>>()};
      const BoltStiffness<Dim> bound = law_of(s).stiffness(span);
      const Pose<Dim>& at_b = bodies[index(s.b)].pose;
      // Of a symmetric matrix without negative eigenvalues the trace bounds the largest.
      for (const auto& [stiffness, arm] : {std::pair{s.share * bound.pull.trace(), &s.arm_b},
                                           std::pair{s.share * bound.dowel.trace(), &s.joint_b}})
        for (const int b : {s.a, s.b}) {
          const auto& body = bodies[index(b)];
          if (!body.movable()) continue;
          const double lever = (at_b(*arm) - body.pose.position).squaredNorm();
          sums[index(b)] += stiffness * (1 / body.mass + lever / smallest_entry(body.inertia));
        }
    }
  }

 private:
  /// That of the bolt, or its own at this joint.
  [[nodiscard]] int law_at(int law, const BoltJoint& joint) {
    if constexpr (HasLawAtJoint<Law>)
      if (auto own = laws_[static_cast<std::size_t>(law)].at_joint(joint))
        return add_law(std::move(*own));
    return law;
  }
  [[nodiscard]] static std::size_t index(int b) { return static_cast<std::size_t>(b); }
  [[nodiscard]] static bool is_chosen(const Spring& s, const BodyMarks* chosen) {
    return chosen == nullptr || is_marked(*chosen, s.a) || is_marked(*chosen, s.b);
  }
  static void push(Load<Dim>& load, const Vec<Dim>& arm, const Vec<Dim>& force) {
    load.force += force;
    load.moment += moment_of(arm, force);
  }

  std::vector<Law> laws_;
  std::vector<Spring> springs_;
  std::vector<double> axial_;  ///< of each spring at the last step of a run, of the bolt [N]
};

}  // namespace voussoir
