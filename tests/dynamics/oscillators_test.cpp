// SPDX-License-Identifier: MIT
// A mass on a spring that rubs on the ground: Coulomb's damping, and stick-slip where friction at
// rest exceeds that in motion. Closed forms f.9.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>

#include "support/blocks.hpp"
#include "support/near.hpp"
#include "support/reference.hpp"

namespace oscillators_test {

using namespace voussoir;
using voussoir_test::rectangle;
using voussoir_test::reference;

namespace {

constexpr double mass = 1000, gravity = 9.81, spring = 1e6;
// The joint's shear spring is in series with the other, 1 / 20 000 of its softness.
constexpr double kn = 2e10, ks = 2e10;

/// A spring along x between two bodies, in tension and compression, at the level of the ground.
class LevelSpring : public SupportModel<LevelSpring, 2> {
 public:
  LevelSpring(int from, int to, double rest) : from_(from), to_(to), rest_(rest) {}
  [[nodiscard]] double extension(const Bodies& bodies) const {
    return bodies[at(to_)].pose.position.x() - bodies[at(from_)].pose.position.x() - rest_;
  }
  [[nodiscard]] std::vector<int> bodies() const override { return {from_, to_}; }
  void act(const Bodies& bodies, std::vector<Load<2>>& loads) override {
    const double pull = spring * extension(bodies);
    loads[at(from_)].force.x() += pull;
    loads[at(from_)].moment[0] += pull * height;  // below the centre of the block
    loads[at(to_)].force.x() -= pull;
  }
  [[nodiscard]] double energy(const Bodies& bodies) const override {
    return 0.5 * spring * extension(bodies) * extension(bodies);
  }
  void add_stiffness_over_mass(const Bodies& bodies, std::vector<double>& sums) const override {
    const auto& body = bodies[at(from_)];
    sums[at(from_)] += spring * (1 / body.mass + height * height / body.inertia[0]);
  }
  // Nothing here is at rest.
  void remove(const BodyMarks&) override {}
  void take_over(const Heirs<2>&) override {}
  void add_forces(const double*, double*, const BodyMarks*) const override {}
  void add_stiffness(const StiffnessSink&) const override {}
  void add_tangent(const double*, const BodyMarks*, const StiffnessSink&) const override {}
  void to_frames(const Poses&, const double*) override {}
  void from_frames(const Poses&, const double*) override {}
  static constexpr double height = 0.002;  ///< of the centre: low, so that it does not rock

 private:
  [[nodiscard]] static std::size_t at(int b) { return static_cast<std::size_t>(b); }
  int from_, to_;
  double rest_;
};

/// Friction mu_s until it slides, mu_d until it has come to rest: then its spring slackens below
/// what it slid with.
class TwoFrictions {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "TwoFrictions";
  template <int Dim>
  struct State {
    Vec<Dim - 1> plastic_slip = Vec<Dim - 1>::Zero();
    bool slides = false;
  };
  TwoFrictions(double at_rest, double in_motion) : at_rest_(at_rest), in_motion_(in_motion) {}
  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double normal =
        std::max(0.0, load.initial.normal - kn * load.weight * load.motion.opening);
    Vec<Dim - 1> shear = elastic(load, state);
    if (const double length = shear.norm(); length > limit(state) * normal)
      shear *= in_motion_ * normal / length;
    return {normal, shear};
  }
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    const PointForce<Dim> now = force(load, state);
    const Vec<Dim - 1> from = state.plastic_slip;
    state.slides = now.tangential != elastic(load, state);
    if (!state.slides) return 0;
    state.plastic_slip =
        load.motion.slip + (now.tangential - load.initial.tangential) / (ks * load.weight);
    return -now.tangential.dot(state.plastic_slip - from);
  }
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const PointForce<Dim> f = force(load, state);
    return 0.5 / load.weight * (f.normal * f.normal / kn + f.tangential.squaredNorm() / ks);
  }
  [[nodiscard]] double joint_normal_stiffness() const { return kn; }
  [[nodiscard]] double joint_shear_stiffness() const { return ks; }

 private:
  template <int Dim>
  [[nodiscard]] double limit(const State<Dim>& state) const {
    return state.slides ? in_motion_ : at_rest_;
  }
  template <int Dim>
  [[nodiscard]] static Vec<Dim - 1> elastic(const PointLoad<Dim>& load, const State<Dim>& state) {
    return load.initial.tangential - ks * load.weight * (load.motion.slip - state.plastic_slip);
  }
  double at_rest_, in_motion_;
};

/// Ground (0), the mass (1) lying on it with its weight, and where the spring is held (2).
template <class Law>
struct Oscillator {
  Oscillator(const Law& law, double extension, double local_damping = 0)
      : run(law, {.gravity = gravity, .local_damping = local_damping, .viscous_damping = 0.5}) {
    run.add_fixed_block(rectangle({0, -1}, 20, 2));
    block = run.add_block(rectangle({0, LevelSpring::height}, 1, 2 * LevelSpring::height),
                          mass / (2 * LevelSpring::height));
    // So heavy that the spring does not slow it down; its weight is held.
    holder = run.add_node({3, LevelSpring::height}, heavy, Spin<2>(heavy));
    run.add_load(holder, {0, heavy * gravity});
    run.prescribe(
        [](const Vec2&) {
          Stress<2> s = Stress<2>::Zero();
          s(1, 1) = mass * gravity;
          return s;
        },
        1e-6);
    pull = std::make_shared<LevelSpring>(block, holder, 3 - extension);
    run.add_support(pull);
  }
  [[nodiscard]] double extension() const {
    return run.position(holder).x() - run.position(block).x() - rest;
  }
  static constexpr double heavy = 1e12;
  Dynamics<2, Law> run;
  int block, holder;
  std::shared_ptr<LevelSpring> pull;
  double rest = 3;
};

}  // namespace

TEST_SUITE("dynamics/oscillators") {
  TEST_CASE("a mass that rubs swings less by a constant at every turn, and stops off its middle") {
    // Let go 20 mm from the middle. Half cycles of pi sqrt(m / k), ended where the speed turns.
    Oscillator<CoulombJoint> o(CoulombJoint({kn, ks, std::atan(0.3)}), -0.02);
    const double start = o.run.position(o.block).x(), middle = start - 0.02;
    const double half = std::numbers::pi * std::sqrt(mass / spring);
    const double decay = reference("F.coulomb.decay");
    const int halves = static_cast<int>(reference("F.coulomb.halfcycles"));
    double amplitude = 0.02;
    for (int k = 1; k <= halves; ++k) {
      o.run.advance(half);
      amplitude -= 0.5 * decay;
      const double x = (k % 2 == 1 ? -1 : 1) * (o.run.position(o.block).x() - middle);
      // The shear spring takes mu m g / k_s, 1.5e-7 m, at every turn; and the block rests on it
      // while the step of 2e-5 s passes.
      CHECK(std::abs(x - amplitude) <= 1e-5);
    }
    o.run.advance(2 * half);
    CHECK(std::abs(o.run.position(o.block).x() - middle - reference("F.coulomb.rest")) <= 1e-5);
    CHECK(o.run.velocity(o.block).norm() <= 1e-3);
    CHECK(std::abs(o.run.energy().relative_imbalance()) <= 1e-3);
  }

  // Against a force F that is out of balance acts alpha |F|: inwards (1 - alpha) k x moves the
  // mass, outwards (1 + alpha) k x brakes it, and a half cycle leaves (1 - alpha) / (1 + alpha) of
  // the energy.
  TEST_CASE("local damping takes the same part of the energy at every half cycle, and says so") {
    const double alpha = 0.1, kept = (1 - alpha) / (1 + alpha), given = 0.5 * spring * 0.02 * 0.02;
    Oscillator<CoulombJoint> o(CoulombJoint({kn, ks, 0}), -0.02, alpha);
    const double start = o.run.position(o.block).x(), middle = start - 0.02;
    const double quarter = 0.5 * std::numbers::pi * std::sqrt(mass / spring);
    double left = 1;
    for (int k = 1; k <= 3; ++k) {
      o.run.advance(quarter / std::sqrt(1 - alpha) + quarter / std::sqrt(1 + alpha));
      left *= kept;
      const double x = (k % 2 == 1 ? -1 : 1) * (o.run.position(o.block).x() - middle);
      // Steps of 2e-5 s, 5 000 to a half cycle; at a turn damping changes sign within one.
      CHECK(x == voussoir_test::near(0.02 * std::sqrt(left)).epsilon(1e-3));
      CHECK(o.run.energy().damping == voussoir_test::near((1 - left) * given).epsilon(1e-3));
      CHECK(std::abs(o.run.energy().imbalance()) <= 1e-3 * given);
    }
  }

  TEST_CASE("a spring that is pulled steadily moves its mass by sticking and slipping") {
    const double speed = 0.05, at_rest = 0.6, in_motion = 0.4;
    // The stop leaves the mass swinging on the joint's shear spring, and it would slip too early
    // for it. Local damping ends that, but only well before it slips: of that it would take a part.
    const double damping = 0.5;
    Oscillator<TwoFrictions> o(TwoFrictions(at_rest, in_motion), 0);
    o.run.set_velocity(o.holder, {speed, 0});
    // It slips first when the spring carries mu_s m g, then sticks, and so on: two cycles.
    const double seen_from = 0.02 * speed, slips_at = at_rest * mass * gravity / spring;
    std::vector<double> turns;  // times at which it begins or ceases to slip
    double least = 1;
    bool slips = false;
    while (turns.size() < 5 && o.run.time() < 2) {
      o.run.advance_steps(1);
      const bool now = o.run.velocity(o.block).x() > seen_from;
      if (now != slips) turns.push_back(o.run.time());
      slips = now;
      o.run.set_local_damping(slips || o.extension() > 0.9 * slips_at ? 0 : damping);
      if (turns.size() > 1) least = std::min(least, o.extension());
    }
    REQUIRE(turns.size() == 5);
    // It is seen too late, and to stop as much too early: it begins and ends with this
    // acceleration. Braked at its base, the block presses on its front: the two points of the joint
    // do not slip together, which is 3e-3 of the times (3e-2 where it is ten times as high).
    const double late = seen_from / ((at_rest - in_motion) * gravity);
    const double slip = reference("F.stickslip.tslip") - 2 * late,
                 stick = reference("F.stickslip.tstick") + 2 * late;
    CHECK(turns[1] - turns[0] == voussoir_test::near(slip).epsilon(5e-3));
    CHECK(turns[2] - turns[1] == voussoir_test::near(stick).epsilon(5e-3));
    CHECK(turns[3] - turns[2] == voussoir_test::near(slip).epsilon(5e-3));
    CHECK(turns[4] - turns[3] == voussoir_test::near(stick).epsilon(5e-3));
    CHECK(least == voussoir_test::near(reference("F.stickslip.xmin")).epsilon(5e-3));
  }
}

}  // namespace oscillators_test
