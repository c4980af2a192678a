// SPDX-License-Identifier: MIT
// A joint law of one's own: Patton's teeth, tan(phi + i) at low stress. A block slides on a plane
// of 40 degrees with friction 30 degrees alone, and stays with teeth of 15 degrees on top; above
// the stress at which they are sheared off it would slide again. The law then serves a whole
// tunnel.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <voussoir/voussoir.hpp>
using namespace voussoir;

constexpr double deg = std::numbers::pi / 180;

/// |T| <= min( N tan(phi + i), c w + N tan(phi) ). Source: Patton (1966), 1st ISRM Congress.
class PattonJoint {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "PattonJoint";
  template <int Dim>
  struct State {
    Vec<Dim - 1> plastic_slip = Vec<Dim - 1>::Zero();  ///< [m]
  };
  PattonJoint(double friction, double teeth, double cohesion)
      : friction_(std::tan(friction)), toothed_(std::tan(friction + teeth)), cohesion_(cohesion) {
    require(friction >= 0 && teeth >= 0 && friction + teeth < 90 * deg, "phi + i", friction + teeth,
            ">= 0 and < pi/2 rad");
    require(cohesion >= 0, "c", cohesion, ">= 0 Pa");
  }
  // Reading: depends on the arguments alone.
  template <int Dim>
  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const double normal =
        std::max(0.0, load.initial.normal - kn * load.weight * load.motion.opening);
    const double limit = std::min(normal * toothed_, cohesion_ * load.weight + normal * friction_);
    Vec<Dim - 1> shear = spring(load, state);
    if (const double length = shear.norm(); length > limit) shear *= limit / length;
    return {normal, shear};
  }
  // Remembering: the force at the same motion is the same afterwards; returns the friction work.
  template <int Dim>
  double commit(const PointLoad<Dim>& load, State<Dim>& state) const {
    const Vec<Dim - 1> now = force(load, state).tangential;
    if (now == spring(load, state)) return 0;
    const Vec<Dim - 1> from = state.plastic_slip;
    state.plastic_slip = load.motion.slip + (now - load.initial.tangential) / (ks * load.weight);
    return -now.dot(state.plastic_slip - from);
  }
  // What the springs would give back, for the energy balance of dynamic runs.
  template <int Dim>
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const State<Dim>& state) const {
    const PointForce<Dim> f = force(load, state);
    return 0.5 / load.weight * (f.normal * f.normal / kn + f.tangential.squaredNorm() / ks);
  }
  // Per area [Pa/m]; no tangent may be stiffer: stable steps come from them.
  [[nodiscard]] double joint_normal_stiffness() const { return kn; }
  [[nodiscard]] double joint_shear_stiffness() const { return ks; }

 private:
  static constexpr double kn = 5e9, ks = 5e8;
  template <int Dim>
  [[nodiscard]] static Vec<Dim - 1> spring(const PointLoad<Dim>& load, const State<Dim>& state) {
    return load.initial.tangential - ks * load.weight * (load.motion.slip - state.plastic_slip);
  }
  double friction_, toothed_, cohesion_;
};

/// Speed after half a second on a plane of 40 degrees [m/s].
double speed(const PattonJoint& law) {
  const Vec2 up(std::sin(40 * deg), std::cos(40 * deg)), down(up.y(), -up.x());
  const auto box = [&](const Vec2& middle, double width, double height) {
    const Vec2 x = 0.5 * width * down, y = 0.5 * height * up;
    return ConvexPolygon({middle - x - y, middle + x - y, middle + x + y, middle - x + y},
                         {0, 1, 2, 3});
  };
  Dynamics<2, PattonJoint> run(law, {.local_damping = 0, .viscous_damping = 0.5});
  run.add_fixed_block(box(-0.5 * up, 20, 1));
  const int block = run.add_block(box(0.1 * up, 1, 0.2), 2700);
  run.advance(0.5);
  return run.velocity(block).dot(down);
}

int main() {
  const double smooth = speed(PattonJoint(30 * deg, 0, 1e6)),
               toothed = speed(PattonJoint(30 * deg, 15 * deg, 1e6));
  const double exact = 9.81 * (std::sin(40 * deg) - std::tan(30 * deg) * std::cos(40 * deg)) * 0.5;

  // The same law in a tunnel: one line.
  using Tunnel = Solver<PattonJoint>;
  std::printf("%s\nsmooth %.3f m/s (exact %.3f), toothed %.4f m/s\n", Tunnel::composition().c_str(),
              smooth, exact, toothed);
  return std::abs(smooth - exact) < 0.02 * exact && std::abs(toothed) < 0.02 ? 0 : 1;
}
