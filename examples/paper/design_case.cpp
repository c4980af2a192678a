// SPDX-License-Identifier: MIT
#include "design_case.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <voussoir/core/elementary.hpp>
#include <voussoir/design/models.hpp>
#include <voussoir/voussoir.hpp>

namespace voussoir::paper {

namespace {

using design::Tunnel;

const SimplePolygon& opening() {
  static const SimplePolygon circle = circular_opening(diameter);
  return circle;
}

AnyAnchors anchors_at(AnchorPlace place) {
  switch (place) {
    case AnchorPlace::mid_block:
      return GargaWangAnchors{};
    case AnchorPlace::on_joint:
      return JointFaceAnchors{};
    case AnchorPlace::near_joint:
      break;
  }
  return LorigAnchors{1.2 * bolt_diameter};
}

AnyMethod method_of(Way way) {
  switch (way) {
    case Way::as_the_paper:
      return AnyMethod(Explicit({.damping = 0.1, .ramp_steps = 0}));
    case Way::slow_explicit:
      return AnyMethod(Explicit{});
    case Way::quasi_static:
      break;
  }
  return AnyMethod(TwoLevel{});
}

BoltInstallation<Tunnel> bolts_of(const Bolts& b) {
  return {bolt_bars({.length = b.length, .angular_spacing = b.spacing, .from = b.from, .to = b.to},
                    opening()),
          AxialShearBolt({.axial = {.axial_stiffness = b.stiffness,
                                    .pretension = b.pretension,
                                    .rupture_force = bolt_strength},
                          .shear_stiffness = b.shear_stiffness}),
          1.0, anchors_at(b.anchors)};
}

LiningInstallation<Tunnel> lining_of(const Lining& lining) {
  LiningSection section = LiningSection::rectangular(lining.thickness, lining_modulus);
  section.bending_stiffness *= lining.bending_factor;
  return {{.nodes = lining.nodes},
          {section},
          MohrCoulombJoint({.joint_normal_stiffness = lining.interface_stiffness,
                            .joint_shear_stiffness = lining.interface_stiffness,
                            .friction_angle = interface_friction})};
}

Construction<Tunnel> construction_of(const Variant& variant) {
  Construction<Tunnel> construction;
  construction.method = method_of(variant.way);
  Acceptance& acceptance = construction.acceptance;
  acceptance.error_estimate = variant.tolerance;
  acceptance.unbalance_over_weight = 10 * variant.tolerance;
  acceptance.collapse_measure = collapse_measure_of(opening());
  acceptance.displacement_limit = variant.lining ? lined_fall_limit : fall_limit;
  // The overshoot of an explicit run is no fall.
  if (variant.way == Way::as_the_paper)
    acceptance.displacement_limit = acceptance.contact_update_limit = 0.05;
  if (variant.held_at_support < 1)
    construction.add_stage("before support", variant.held_at_support);
  auto& supported = construction.add_stage("supported", variant.held);
  if (variant.bolts) supported.install_bolts(bolts_of(*variant.bolts));
  if (variant.lining) supported.install_lining(lining_of(*variant.lining));
  return construction;
}

/// Mean of a quantity over the entries within half a window of an angle.
template <class Entries, class Value>
double mean_near(const Entries& entries, double angle, const Value& value) {
  constexpr double half_window = 15 * degree;
  double sum = 0;
  int count = 0;
  for (const auto& e : entries)
    if (std::abs(std::remainder(e.angle - angle, 2 * std::numbers::pi)) <= half_window) {
      sum += value(e);
      ++count;
    }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

InSituState in_situ_state(std::uint64_t seed, double k0, double friction_angle, double surcharge) {
  const auto mass = sliced_rock(mass_a, seed);
  Tunnel tunnel(mass, CoulombJoint({normal_stiffness, shear_stiffness, friction_angle}),
                {.density = density, .k0 = k0, .surcharge = surcharge, .gravity = gravity});
  const auto& system = tunnel.system();
  // The stress in a block is the sum of (place of a contact force) x (force) over its area.
  std::vector<Stress<2>> stress(mass.bodies.size(), Stress<2>::Zero());
  const auto collect = [&](const auto& group) {
    group.visit(system.displacement.data(), [&](const auto& c, const auto& point, const auto&,
                                                const auto& force) {
      // On b: along the normal from a to b, and along the tangent.
      const Vec2 on_b = force.normal * c.normal + c.tangents() * force.tangential;
      const Vec2 offset = c.offset_of(point);
      for (const auto& [body, arm, f] : {std::tuple(c.a, Vec2(c.arm_a + offset), Vec2(-on_b)),
                                         {c.b, Vec2(c.arm_b + offset), on_b}})
        if (body < static_cast<int>(stress.size()))
          stress[static_cast<std::size_t>(body)] -= arm * f.transpose();
    });
  };
  collect(system.joints);
  collect(system.boundary);
  const auto mean_around = [&](const Vec2& centre, double reach) {
    Stress<2> sum = Stress<2>::Zero();
    double area = 0;
    for (std::size_t b = 0; b < mass.bodies.size(); ++b)
      if ((mass.bodies[b].properties.centroid - centre).norm() < reach) {
        sum += stress[b];
        area += mass.bodies[b].properties.measure;
      }
    return Stress<2>(sum / area);
  };
  InSituState state{};
  const Stress<2> middle = mean_around(Vec2::Zero(), 5);
  state.vertical = middle(1, 1);
  state.horizontal = middle(0, 0);
  state.gradient = (mean_around(Vec2(0, -5), 4)(1, 1) - mean_around(Vec2(0, 5), 4)(1, 1)) / 10;
  state.unbalance = tunnel.out_of_balance_ratio();
  (void)tunnel.equilibrium(1.0);
  state.drift = system.largest_translation(system.displacement);
  return state;
}

std::vector<double> Outcome::largest_forces() const {
  std::vector<double> forces;
  for (const BoltOutcome& b : bolts) forces.push_back(b.largest);
  return forces;
}
double Outcome::mean_force() const {
  double sum = 0;
  for (const BoltOutcome& b : bolts) sum += b.largest / static_cast<double>(bolts.size());
  return sum;
}
double Outcome::largest_force() const {
  double largest = 0;
  for (const BoltOutcome& b : bolts) largest = std::max(largest, b.largest);
  return largest;
}
double Outcome::mean_thrust() const {
  double sum = 0;
  for (const LiningOutcome& l : lining) sum += l.thrust / static_cast<double>(lining.size());
  return sum;
}
double Outcome::largest_thrust() const {
  double largest = 0;
  for (const LiningOutcome& l : lining) largest = std::max(largest, l.thrust);
  return largest;
}
double Outcome::largest_moment() const {
  double largest = 0;
  for (const LiningOutcome& l : lining) largest = std::max(largest, std::abs(l.moment));
  return largest;
}
double Outcome::thrust_near(double angle) const {
  return mean_near(lining, angle, [](const LiningOutcome& l) { return l.thrust; });
}
double Outcome::moment_near(double angle) const {
  return mean_near(lining, angle, [](const LiningOutcome& l) { return l.moment; });
}

struct ExcavatedRock::Parts {
  std::uint64_t seed;
  Tunnel tunnel;
};

ExcavatedRock::ExcavatedRock(std::uint64_t seed, const Variant& variant) {
  Tunnel tunnel(sliced_rock(mass_a, seed, domain(variant.extent)),
                AnyJoint(CoulombJoint({normal_stiffness, shear_stiffness, variant.friction})),
                {.density = density, .k0 = variant.k0, .gravity = gravity}, opening(), 0.074);
  parts_ = std::make_unique<Parts>(Parts{seed, std::move(tunnel)});
}
ExcavatedRock::~ExcavatedRock() = default;
ExcavatedRock::ExcavatedRock(ExcavatedRock&&) noexcept = default;
ExcavatedRock& ExcavatedRock::operator=(ExcavatedRock&&) noexcept = default;

Outcome ExcavatedRock::run(const Variant& variant) const {
  Tunnel tunnel = parts_->tunnel;
  Outcome outcome;
  outcome.seed = parts_->seed;
  const auto built = construct(tunnel, construction_of(variant));
  outcome.report = built.last();
  outcome.report.fallen_measure = built.fallen_measure();
  outcome.convergence = built.stages.back().convergence;
  outcome.wall = wall_motion(tunnel);
  double length = 0;
  for (const WallMotion& piece : outcome.wall)
    if (piece.angle <= std::numbers::pi) {
      outcome.mean_convergence += piece.length * piece.convergence;
      length += piece.length;
    }
  outcome.mean_convergence /= length;
  double change = 0, before = 0;
  tunnel.system().boundary.visit(
      tunnel.system().displacement.data(),
      [&](const auto&, const auto& point, const auto&, const auto& force) {
        change += std::abs(force.normal - point.initial.normal);
        before += point.initial.normal;
      });
  outcome.boundary_change = change / before;
  for (const Segment& bar : bars_of(tunnel)) {
    BoltOutcome& bolt = outcome.bolts.emplace_back(
        BoltOutcome{elementary::angle_of(bar.start.y(), bar.start.x()), 0, {}});
    if (bolt.angle < -90 * degree) bolt.angle += 360 * degree;
  }
  for (const CrossingForce& c : bolt_forces(tunnel)) {
    BoltOutcome& bolt = outcome.bolts[static_cast<std::size_t>(c.bolt)];
    bolt.largest = std::max(bolt.largest, c.report.axial);
    bolt.crossings.push_back({radius + c.position, c.report.axial});
  }
  for (const LiningForce& at : lining_forces(tunnel))
    outcome.lining.push_back(
        {elementary::angle_of(at.position.y(), at.position.x()), at.thrust, at.moment});
  return outcome;
}

}  // namespace voussoir::paper
