// SPDX-License-Identifier: MIT
#include "verification.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/laboratory/oedometer.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/statistics/confidence.hpp>
#include <voussoir/statistics/distribution_fit.hpp>
#include <voussoir/statistics/goodness_of_fit.hpp>
#include <voussoir/statistics/normal_update.hpp>
#include <voussoir/theory/circular_opening.hpp>
#include <voussoir/theory/ground_reaction.hpp>
#include <voussoir/theory/grouted_bolt.hpp>
#include <voussoir/theory/initial_friction.hpp>
#include <voussoir/theory/lining_in_ground.hpp>
#include <voussoir/theory/longitudinal_profile.hpp>
#include <voussoir/theory/polygon_ring.hpp>

#include "analysis_parts.hpp"

namespace voussoir::paper {

namespace {

using Kind = Check::Kind;

/// Values on the right: tests/data/reference-values.csv, which says how each was derived.
void closed_forms(std::vector<Check>& checks) {
  const auto add = [&](const std::string& what, double value, double reference) {
    checks.push_back({Kind::closed_form, what, value, reference, 1e-8,
                      "derived independently to 1e-8 or better, 12 digits kept"});
  };
  const ElasticGround g1{3.85e8, 0.2}, g3{5.27e8, 0.37};
  const double p0 = ground_pressure, up = 0.5 * std::numbers::pi;
  add("Kirsch: crown, K0 = 0.5 [m]", kirsch(radius, {p0, 0.5}, g1, radius, up).inward,
      0.00558978896104);
  const auto field = kirsch(radius, {p0, 0.5}, g1, 8, 30 * degree);
  add("Kirsch: radial stress at 8 m, 30 degrees [Pa]", field.radial_stress, 311303.890228);
  add("Kirsch: shear stress there [Pa]", field.shear_stress, 189741.740433);
  const SmearedBolts bolts(smeared(reference_bolts), g1, p0);
  add("smeared bolts: wall [m]", bolts.convergence(), 0.00405915278865);
  add("smeared bolts: F / (p0 D) at the wall", bolts.bolt_force(5) / force_unit, 0.0171064502329);
  add("smeared bolts: F / (p0 D) at the end", bolts.bolt_force(12) / force_unit, 0.0032811796435);
  add("thin lining, eq. (13): thrust [N/m]", thin_lining(thin({}), p0, 5.27e8).thrust,
      997612.088707);
  const auto both = elastic_support(radius, smeared({}), thin({}), g3, p0);
  add("bolts and lining: wall [m]", both.convergence, 0.00214949026106);
  add("bolts and lining: thrust [N/m]", both.thrust, 977041.027756);
  const RingLining ring = RingLining::rectangular(radius, 0.1, lining_modulus);
  const auto stuck = einstein_schwartz(ring, {p0, 0.5}, g1, LiningInterface::no_slip);
  add("Einstein-Schwartz, no slip: thrust at the springing [N/m]", stuck.thrust_at(0),
      1417548.00692);
  add("Einstein-Schwartz, no slip: moment there [N m/m]", stuck.moment_at(0), 505.426353881);
  add("Einstein-Schwartz, no slip: crown [m]", stuck.convergence_at(up), 0.003976920898);
  add("Curtis, full slip: moment [N m/m]",
      curtis(ring, {p0, 0.5}, g1, LiningInterface::full_slip).moment_amplitude, 591.081827211);
  add("Curtis, no slip: moment [N m/m]",
      curtis(ring, {p0, 0.5}, g1, LiningInterface::no_slip).moment_amplitude, 454.69058998);
  const GroundReactionCurve curve(5, 5e6, {{1e9 / 2.6, 0.3}, 5e5, 30 * degree, 10 * degree});
  add("ground reaction curve: plastic ring [m]", curve.plastic_radius(0), 9.20156419576);
  add("ground reaction curve: wall [m]", curve.convergence(0), 0.0934497841968);
  add("longitudinal profile at 2 a, r_p = 2 a", longitudinal_profile(2, 2), 0.831969469259);
  add("fictitious support pressure at X = a [Pa]",
      fictitious_pressure(p0, longitudinal_profile(1, 1)), 105360.997716);
  const double s = 6 * joint_spacing / std::numbers::pi;
  const auto compliance = joint_compliance({{75 * degree, s}, {25 * degree, s}, {-25 * degree, s}},
                                           {normal_stiffness, shear_stiffness});
  add("three joint sets: G, vertical [Pa]",
      oedometer_of(compliance, CompressedAlong::vertical, ShearCondition::prevented).shear_modulus,
      442942948.778);
  add("three joint sets: G, horizontal [Pa]",
      oedometer_of(compliance, CompressedAlong::horizontal, ShearCondition::prevented)
          .shear_modulus,
      544178422.519);
  add("joints of all orientations: G [Pa]",
      isotropic_joint_moduli({normal_stiffness, shear_stiffness}, joint_spacing).shear_modulus,
      445633840.657);
  add("friction for K0 = 0.5, 25 degrees [degrees]", initial_friction(0.5, 25 * degree) / degree,
      11.8757318772);
  add("grouted bolt: shear stiffness [N/m]",
      grouted_bolt_stiffness({0.028, 0.042, 200e9, 10e9, 4e9}).shear, 278713499.912);
  add("polygon of 32 chords: moment factor, m = 2", polygon_moment_factor(32, 2), 1.0097194898);
  add("polygon of 32 chords, squeezed: shortening", squeezed_polygon(32).shortening,
      0.147597291592);
  const Sample ten({0.021, 0.034, 0.028, 0.041, 0.019, 0.033, 0.030, 0.025, 0.037, 0.032});
  const NormalFit fit = fit_normal(ten);
  add("Kolmogorov-Smirnov distance",
      kolmogorov_smirnov(ten, [&](double x) { return fit.probability_below(x); }), 0.113841575624);
  add("confidence interval of a mean, upper end", mean_interval(ten).high, 0.0349446521757);
  add("Bayesian update: beta", NormalBelief{0.028, 2, 3, 2e-4}.after(ten).beta, 0.000418333333333);
}

ConvexPolygon block(const Vec2& centre, double wide, double high, double angle = 0) {
  const Vec2 along(std::cos(angle), std::sin(angle)), up = perpendicular(along);
  std::vector<Vec2> corners;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    corners.emplace_back(centre + 0.5 * wide * x * along + 0.5 * high * y * up);
  return {std::move(corners), {0, 1, 2, 3}};
}

void blocks_in_motion(std::vector<Check>& checks) {
  // Down a plane: what is left of the first bounce after 0.2 s is below 1e-6.
  const double slope = 40 * degree, phi = 35 * degree;
  Dynamics<2, CoulombJoint> run(CoulombJoint({5e9, 5e8, phi}), {.viscous_damping = 0.5});
  const Vec2 up(std::sin(slope), std::cos(slope)), down(std::cos(slope), -std::sin(slope));
  run.add_fixed_block(block(-0.5 * up, 40, 1, -slope));
  const int sliding = run.add_block(block(0.1 * up - 10 * down, 1, 0.2, -slope), density);
  const double pressure = density * gravity * 0.2 / std::cos(slope);
  run.prescribe(
      [&](const Vec2&) { return Stress<2>(pressure * Vec2(0, 1) * Vec2(0, 1).transpose()); }, 1e-9);
  run.advance(0.2);
  const double before = run.velocity(sliding).dot(down);
  run.advance(0.3);
  checks.push_back({Kind::solver, "block on an incline: acceleration [m/s2]",
                    (run.velocity(sliding).dot(down) - before) / 0.3,
                    gravity * (std::sin(slope) - std::tan(phi) * std::cos(slope)), 1e-3,
                    "friction lags by a time step"});
  // Two blocks meet.
  Dynamics<2, CoulombJoint> knock(CoulombJoint({5e9, 5e8, phi}), {.gravity = 0, .safety = 0.05});
  const int a = knock.add_block(block({0, 0}, 1, 1), density);
  const int b = knock.add_block(block({1.001, 0}, 1, 1), density);
  knock.set_velocity(a, {1, 0});
  knock.advance(0.02);
  checks.push_back({Kind::solver, "impact of two blocks: velocity handed over [m/s]",
                    knock.velocity(b).x(), 1, 2e-3, "second order in the time step"});
  checks.push_back({Kind::solver, "impact of two blocks: momentum [m/s]",
                    knock.velocity(a).x() + knock.velocity(b).x(), 1, 1e-12, "rounding"});
}

/// A wedge in the roof between two abutments under a total load: whether it stays.
bool wedge_stays(double load) {
  const double alpha = 20 * degree, thrust = 1e6;
  System<Planar> system(CoulombJoint({5e9, 5e8, 35 * degree}), 1,
                        CoulombJoint({1, 1, 0}, any_units));
  const Vec2 apex(0, std::cos(alpha)), toe(std::sin(alpha), 0);
  system.add_body({Vec2(-1, 0.5), 1, 1, false});
  system.add_body({Vec2(1, 0.5), 1, 1, false});
  system.add_body({Vec2(0, 0.3), load, 0.3, true});
  const Segment faces[2] = {{Vec2(-toe.x(), 0), apex}, {apex, toe}};
  for (int side = 0; side < 2; ++side)
    system.joints.add(side, 2, faces[side], system.body(side).centre, system.body(2).centre,
                      faces[side].gauss_points());
  Stress<2> horizontal = Stress<2>::Zero();
  horizontal(0, 0) = thrust / std::cos(alpha);
  system.joints.set_initial([&](const auto&, const Vec2&) { return horizontal; });
  system.load[3 * 2 + 1] = -load;
  const EquilibriumReport report = TwoLevel{}.find(system, SearchContext{});
  return report.verdict == Verdict::stable && report.fallen.empty();
}

void solvers(Study& study, std::vector<Check>& checks) {
  const InSituState state = in_situ_state(1, 1, friction);
  checks.push_back({Kind::solver, "in situ: worst block out of balance over its weight",
                    state.unbalance, 0, 1e-11, "rounding, 5 700 blocks"});
  checks.push_back({Kind::solver, "in situ: stress around the tunnel centre [Pa]", state.vertical,
                    ground_pressure, 0.01,
                    "blocks within 5 m: their mean depth is not the centre's"});
  const InSituState half = in_situ_state(1, 0.5, largest_initial_friction(0.5) * (1 + 1e-9));
  checks.push_back({Kind::solver, "in situ, K0 = 0.5, least friction: drift over 1 mm",
                    half.drift / 1e-3, 0, 1e-9, "rounding"});
  const JointSet flat{"", 0, DipDirection::east, 0, 0, 0.77};
  const Domain<2> ground{{0, 0}, {5, 7.7}};
  const auto layers = slice(ground, joint_network({flat}, ground, 1), {});
  checks.push_back({Kind::solver, "layers pressed: constrained modulus [Pa]",
                    oedometer(layers, CoulombJoint({5e9, 5e8, friction})).constrained_modulus,
                    goodman_moduli({5e9, 5e8}, 0.77).youngs_modulus, 1e-9, "one elastic solve"});
  // Bray's wedge: the load at which it slips, between one that it bears and one that it does not.
  double low = 1e4, high = 1e7;
  while (high / low > 1 + 1e-5) {
    const double middle = std::sqrt(low * high);
    (wedge_stays(middle) ? low : high) = middle;
  }
  const double alpha = 20 * degree, phi = 35 * degree, kn = 5e9, ks = 5e8;
  const double bray =
      2 * 1e6 * (ks * std::cos(alpha) * std::cos(alpha) + kn * std::sin(alpha) * std::sin(alpha)) *
      std::sin(phi - alpha) /
      (ks * std::cos(alpha) * std::cos(phi) + kn * std::sin(alpha) * std::sin(phi));
  checks.push_back({Kind::solver, "roof wedge under horizontal stress: load at slip [N]",
                    std::sqrt(low * high), bray, 1e-3, "bisection to 1e-5, balance to 1e-3"});
  blocks_in_motion(checks);

  // Tunnels against elastic ground whose modulus is measured on the same rock.
  const Variant hole{.friction = 89 * degree}, ring{.lining = Lining{}};
  const Variant design{.bolts = Bolts{}, .lining = Lining{}};
  Variant slow = design;
  slow.way = Way::slow_explicit;
  study.prepare({hole, ring, design, slow});
  double modulus = 0;
  for (int k = 1; k <= study.samples(); ++k)
    modulus += oedometer(sliced_rock(mass_a, static_cast<std::uint64_t>(k)),
                         CoulombJoint({normal_stiffness, shear_stiffness, friction}))
                   .shear_modulus /
               study.samples();
  const auto mean_wall = [](const Outcome& o) {
    return 0.25 * (o.convergence.crown + o.convergence.left_springing +
                   o.convergence.right_springing + o.convergence.invert);
  };
  checks.push_back({Kind::solver, "hole without slip: mean convergence [m]",
                    study.measure(hole, mean_wall).mean(), ground_pressure * radius / (2 * modulus),
                    0.15,
                    "edges that are fixed at 7 radii hold back 9 % (Lame's ring, nu = 0.37); three "
                    "realisations scatter by 8 % / sqrt(3)"});
  checks.push_back(
      {Kind::solver, "ring of 10 cm: mean thrust [N/m], eq. (13)",
       study.measure(ring, [](const Outcome& o) { return o.mean_thrust(); }).mean(),
       thin_lining(thin({}), ground_pressure, modulus).thrust, 0.1,
       "as above times 0.71, the part of p0 that the ground bears, and 3 % / sqrt(3)"});
  checks.push_back({Kind::solution, "design case by explicit stepping: crown [m]",
                    study.measure(slow, crown).mean(), study.measure(design, crown).mean(), 0.005,
                    "estimates of 0.1 % each, overshoot of the ramp"});
  checks.push_back({Kind::solution, "the same: mean thrust [N/m]",
                    study.measure(slow, [](const Outcome& o) { return o.mean_thrust(); }).mean(),
                    study.measure(design, [](const Outcome& o) { return o.mean_thrust(); }).mean(),
                    0.005, "the same"});
  checks.push_back({Kind::solution, "the same: mean bolt force [N]",
                    study.measure(slow, [](const Outcome& o) { return o.mean_force(); }).mean(),
                    study.measure(design, [](const Outcome& o) { return o.mean_force(); }).mean(),
                    0.01, "the same"});
}

}  // namespace

double Check::deviation() const {
  return reference == 0 ? std::abs(value) : std::abs(value / reference - 1);
}

std::vector<Check> verification(Study& study) {
  std::vector<Check> checks;
  closed_forms(checks);
  solvers(study, checks);
  return checks;
}

std::string verification_text(const std::vector<Check>& checks) {
  std::string text;
  char line[240];
  const Kind* last = nullptr;
  int passed = 0;
  for (const Check& c : checks) {
    if (!last || *last != c.kind) {
      const char* title = c.kind == Kind::closed_form
                              ? "closed forms, against values derived elsewhere"
                          : c.kind == Kind::solver ? "toolkit against closed forms"
                                                   : "the same solution found in another way";
      std::snprintf(line, sizeof line, "%s%-60s %16s %16s %10s %8s\n", last ? "\n" : "", title,
                    "value", "reference", "deviation", "limit");
      text += line;
      last = &c.kind;
    }
    passed += c.passes();
    std::snprintf(line, sizeof line, "  %-58s %16.10g %16.10g %10.1e %8.2g %s\n", c.what.c_str(),
                  c.value, c.reference, c.deviation(), c.limit, c.passes() ? "PASS" : "FAIL");
    text += line;
    if (!c.passes()) text += "    limit: " + c.reason + "\n";
  }
  std::snprintf(line, sizeof line, "\n%d of %d pass\n", passed, static_cast<int>(checks.size()));
  return text + line;
}

}  // namespace voussoir::paper
