// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/foot_bearing.hpp>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/tangent_basis.hpp>
#include <voussoir/lining/lining_frame.hpp>
#include <voussoir/model/small_displacement.hpp>
#include <voussoir/model/support.hpp>

namespace voussoir {

/// A foot of a lining: its end bears on a body of rock, at a point that is fixed in both.
///
/// Arms and frame are in the axes of the reference configuration; in a run, those of its bodies'
/// frames.
template <int Dim>
struct LiningFootSpring {
  static constexpr int dof = Dim + spin_count<Dim>;
  using Lever = Fixed<dof, Dim>;

  int node = 0, rock = 0;                                               ///< bodies
  Vec<Dim> arm_node = zeros<Vec<Dim>>(), arm_rock = zeros<Vec<Dim>>();  ///< from centres [m]
  Rotation<Dim> frame = diagonal_of<Dim>(1);  ///< columns: from the lining into the rock, tangents
  double area = 0;                            ///< [m], [m^2]
  /// Opening and slip besides what the bodies' displacements (in a run: places) give [m].
  Vec<Dim> offset = zeros<Vec<Dim>>();
  FootBearing::State<Dim> state{};

  [[nodiscard]] PointLoad<Dim> load(const Vec<Dim>& motion) const {
    return {area, {}, {motion[0], part<Dim - 1>(motion, 1)}};
  }
  /// Opening and slip at small displacements.
  [[nodiscard]] Vec<Dim> motion_at(const double* u) const {
    const Vec<Dim> apart = displacement_at<Dim>(u + dof * rock, arm_rock) -
                           displacement_at<Dim>(u + dof * node, arm_node);
    return transposed_product(frame, apart) + offset;
  }
  /// The same with the bodies anywhere.
  [[nodiscard]] Vec<Dim> motion_at(const Pose<Dim>& of_node, const Pose<Dim>& of_rock) const {
    const Rotation<Dim> now = of_node.rotation * frame;
    return transposed_product(now, Vec<Dim>(of_rock(arm_rock) - of_node(arm_node))) + offset;
  }
  /// Brings it where bodies are now free of force.
  void install_at(const double* u) { offset -= motion_at(u); }

  /// On the rock, along the axes of the frame; the node gets the opposite [N].
  [[nodiscard]] Vec<Dim> force(const FootBearing& law, const Vec<Dim>& motion) const {
    const PointForce<Dim> f = law.force(load(motion), state);
    return stacked(f.normal, f.tangential);
  }
  void add_force(const FootBearing& law, const double* u, double* f) const {
    const Vec<Dim> on_rock = frame * force(law, motion_at(u));
    add_force_at<Dim>(f + dof * rock, arm_rock, on_rock);
    add_force_at<Dim>(f + dof * node, arm_node, Vec<Dim>(-on_rock));
  }
  /// @param local  minus the derivative of the force by the motion, along the axes of the frame
  template <class Sink>
  void hand_over(const Stress<Dim>& local, Sink&& sink) const {
    const Stress<Dim> k = frame * local * transposed(frame);
    const Lever n = lever_matrix<Dim>(arm_node), r = lever_matrix<Dim>(arm_rock);
    using Block = Fixed<dof, dof>;
    const auto block = [&](const Lever& p, const Lever& q) { return Block(p * k * transposed(q)); };
    sink(node, rock, block(n, n), Block(-block(n, r)), Block(-block(r, n)), block(r, r));
  }
  [[nodiscard]] Stress<Dim> elastic(const FootBearing& law) const {
    return area * law.params().stiffness * diagonal_of<Dim>(1);
  }
  /// By differences, see `ContactGroup::add_tangent`.
  [[nodiscard]] Stress<Dim> tangent(const FootBearing& law, const Vec<Dim>& motion) const {
    constexpr double step = 1e-9;
    Stress<Dim> k;
    for (int axis = 0; axis < Dim; ++axis) {
      Vec<Dim> more = motion, less = motion;
      more[axis] += step;
      less[axis] -= step;
      set_column(k, axis, Vec<Dim>((force(law, less) - force(law, more)) / (2 * step)));
    }
    return k;
  }

  void to_frames(const Pose<Dim>& of_node, const Pose<Dim>& of_rock, const double* u) {
    const Vec<Dim> was = u != nullptr ? motion_at(u) : offset;
    const Vec<Dim> apart = of_rock.position + arm_rock - of_node.position - arm_node;
    offset = was - transposed_product(frame, apart);
    frame = transposed(of_node.rotation) * frame;
    arm_node = transposed_product(of_node.rotation, arm_node);
    arm_rock = transposed_product(of_rock.rotation, arm_rock);
  }
  void from_frames(const Pose<Dim>& of_node, const Pose<Dim>& of_rock, const double* u) {
    const Vec<Dim> now = motion_at(of_node, of_rock);
    frame = of_node.rotation * frame;
    arm_node = of_node.rotation * arm_node;
    arm_rock = of_rock.rotation * arm_rock;
    offset = zeros<Vec<Dim>>();
    offset = now - motion_at(u);
  }
};

/// The spring under an end of a lining, its arms left to be set.
/// @param node  that the end is, among the bodies
/// @throws InvalidInput  no rock there, or nothing that it could press on
template <class Geometry>
[[nodiscard]] LiningFootSpring<Geometry::dim> foot_spring(const LiningEnd<Geometry>& end, int node,
                                                          const FootBearing& bearing) {
  if (!end.refusal.empty()) throw InvalidInput(end.refusal);
  if (end.body < 0)
    throw InvalidInput(
        message({"lining: there is no rock under the foot at ", text_of<Geometry::dim>(end.place),
                 " m: end the arc on rock, or leave the feet out"}));
  LiningFootSpring<Geometry::dim> spring;
  spring.node = node;
  spring.rock = end.body;
  spring.frame << end.direction, tangent_basis(end.direction);
  spring.area = bearing.params().width * end.length;
  return spring;
}

/// The feet of linings.
template <int Dim>
class LiningFeet : public SupportModel<LiningFeet<Dim>, Dim> {
  using Base = Support<Dim>;

 public:
  using typename Base::Bodies;
  using typename Base::Poses;
  using typename Base::StiffnessSink;
  using Spring = LiningFootSpring<Dim>;

  LiningFeet(const FootBearing& law, std::vector<Spring> springs)
      : law_(law), springs_(std::move(springs)) {}

  [[nodiscard]] const FootBearing& law() const { return law_; }
  [[nodiscard]] const std::vector<Spring>& springs() const { return springs_; }

  [[nodiscard]] std::vector<int> bodies() const override {
    std::vector<int> held;
    for (const Spring& s : springs_) held.insert(held.end(), {s.node, s.rock});
    std::sort(held.begin(), held.end());
    held.erase(std::unique(held.begin(), held.end()), held.end());
    return held;
  }
  void remove(const BodyMarks& gone) override {
    std::erase_if(springs_, [&](const Spring& s) {
      return is_marked(gone, s.node) || is_marked(gone, s.rock);
    });
  }
  /// A foot whose rock is excavated stands on nothing any more.
  void take_over(const Heirs<Dim>& heirs) override {
    std::erase_if(springs_, [&](Spring& s) {
      const Heir<Dim> rock = heirs(s.rock, s.arm_rock);
      if (rock.body < 0) return true;
      s.rock = rock.body;
      s.arm_rock = rock.arm;
      s.node = heirs(s.node, zeros<Vec<Dim>>()).body;
      return false;
    });
  }

  /// An end that goes on in another lining has no foot any more.
  /// @param node  among the bodies
  /// @param other_end  direction in which the other lining ends there, as `LiningEnd::direction`:
  ///                   two layers that end together keep their feet
  void leave_out(int node, const Vec<Dim>& other_end) {
    std::erase_if(springs_, [&](const Spring& s) {
      return s.node == node && column(s.frame, 0).dot(other_end) < 0.5;
    });
  }

  void add_forces(const double* u, double* f, const BodyMarks* chosen) const override {
    for (const Spring& s : springs_)
      if (is_chosen(s, chosen)) s.add_force(law_, u, f);
  }
  int commit(const double* u, const BodyMarks* chosen) override {
    for (Spring& s : springs_)
      if (is_chosen(s, chosen)) law_.commit(s.load(s.motion_at(u)), s.state);
    return 0;
  }
  void add_stiffness(const StiffnessSink& sink) const override {
    for (const Spring& s : springs_) s.hand_over(s.elastic(law_), sink);
  }
  void add_tangent(const double* u, const BodyMarks* chosen,
                   const StiffnessSink& sink) const override {
    for (const Spring& s : springs_)
      if (is_chosen(s, chosen)) s.hand_over(s.tangent(law_, s.motion_at(u)), sink);
  }
  void to_frames(const Poses& frames, const double* u) override {
    for (Spring& s : springs_) s.to_frames(frames[index(s.node)], frames[index(s.rock)], u);
  }
  void from_frames(const Poses& frames, const double* u) override {
    for (Spring& s : springs_) s.from_frames(frames[index(s.node)], frames[index(s.rock)], u);
  }

  void act(const Bodies& bodies, std::vector<Load<Dim>>& loads) override {
    for (Spring& s : springs_) {
      const Pose<Dim>&node = bodies[index(s.node)].pose, &rock = bodies[index(s.rock)].pose;
      const Vec<Dim> motion = s.motion_at(node, rock);
      lost_ += law_.commit(s.load(motion), s.state);
      const Vec<Dim> on_rock = node.rotation * (s.frame * s.force(law_, motion));
      // Both where the rock's point is, so that no moment is made as the foot settles.
      const Vec<Dim> arm = rock.rotation * s.arm_rock;
      push(loads[index(s.rock)], arm, on_rock);
      push(loads[index(s.node)], Vec<Dim>(arm + rock.position - node.position), Vec<Dim>(-on_rock));
    }
  }
  [[nodiscard]] double energy(const Bodies& bodies) const override {
    double sum = lost_;
    for (const Spring& s : springs_)
      sum += law_.stored_energy(
          s.load(s.motion_at(bodies[index(s.node)].pose, bodies[index(s.rock)].pose)), s.state);
    return sum;
  }
  void add_stiffness_over_mass(const Bodies& bodies, std::vector<double>& sums) const override {
    for (const Spring& s : springs_) {
      const double stiffness = Dim * s.area * law_.params().stiffness;
      for (const auto& [b, arm] :
           {std::pair{s.node, &s.arm_node}, std::pair{s.rock, &s.arm_rock}}) {
        const auto& body = bodies[index(b)];
        if (body.movable())
          sums[index(b)] +=
              stiffness * (1 / body.mass + arm->squaredNorm() / smallest_entry(body.inertia));
      }
    }
  }

 private:
  [[nodiscard]] static std::size_t index(int b) { return static_cast<std::size_t>(b); }
  [[nodiscard]] static bool is_chosen(const Spring& s, const BodyMarks* chosen) {
    return chosen == nullptr || is_marked(*chosen, s.node) || is_marked(*chosen, s.rock);
  }
  static void push(Load<Dim>& load, const Vec<Dim>& arm, const Vec<Dim>& force) {
    load.force += force;
    load.moment += moment_of(arm, force);
  }

  FootBearing law_;
  std::vector<Spring> springs_;
  double lost_ = 0;  ///< in a run: to settling and slip [J]
};

#ifdef VOUSSOIR_COMPILED
VOUSSOIR_PLANAR_TEMPLATE class LiningFeet<2>;
VOUSSOIR_SPATIAL_TEMPLATE class LiningFeet<3>;
#endif

}  // namespace voussoir
