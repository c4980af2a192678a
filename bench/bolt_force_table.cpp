// SPDX-License-Identifier: MIT
// What bolt forces depend on. Boon, Houlsby & Utili (2015) report a mean of 0.030 +- 0.009 of p0 D
// over the bolts of their reference pattern; a quasi-static search finds little more than half of
// it. Here the same tunnel is brought to equilibrium in the ways that explicit codes do, one choice
// changed at a time: how the rock came to its stress, how suddenly it is excavated and damped, and
// how many points a contact has. Arguments: seeds of the rock mass (default 1). A minute each.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>
#include <voussoir/voussoir.hpp>

#include "design_rock.hpp"
using namespace voussoir;

namespace {

using paper::degree;
const InSitu in_situ{.density = paper::density, .k0 = 1};
const CoulombJoint joint({paper::normal_stiffness, paper::shear_stiffness, paper::friction});
const AxialBolt bolt({.axial_stiffness = 2e8, .rupture_force = 5e5});
const SimplePolygon opening = circular_opening(paper::diameter);
/// 21 bolts of 7 m, from below one springing over the crown to below the other.
const BoltPattern pattern{
    .length = 7, .angular_spacing = 11.25 * degree, .from = -22.5 * degree, .to = 202.5 * degree};

/// Mean and standard deviation over bolts of each bolt's largest force, over p0 D.
struct Force {
  double mean, deviation;
};
Force statistics(const std::vector<double>& largest) {
  double sum = 0, squares = 0;
  for (const double force : largest) {
    sum += force;
    squares += force * force;
  }
  const double n = static_cast<double>(largest.size()), mean = sum / n;
  const double scale = paper::ground_pressure * paper::diameter;
  return {mean / scale, std::sqrt(std::max(0.0, squares / n - mean * mean)) / scale};
}
void print(const std::string& what, const Force& f, double crown, double unbalance,
           std::chrono::steady_clock::time_point start) {
  std::printf("| %-56s | %.4f +- %.4f | %5.2f | %7.1e | %5.1f |\n", what.c_str(), f.mean,
              f.deviation, 1e3 * crown, unbalance,
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  std::fflush(stdout);
}

template <class Method>
void search(const std::string& what, const RockMass<Planar>& rock, const Method& method,
            const CoulombJoint& law = joint) {
  const auto start = std::chrono::steady_clock::now();
  Solver<Method> tunnel(rock, law, in_situ);
  tunnel.excavate(opening);
  for (const auto& bar : bolt_bars(pattern, opening)) tunnel.install_bolt(bar, bolt);
  // Overshoots of softer joints are no falls.
  const auto report =
      tunnel.equilibrium(0, method, {.displacement_limit = 0.05, .contact_update_limit = 0.05});
  print(what, statistics(largest_bolt_forces(tunnel)), convergence(tunnel).crown,
        report.unbalance_over_weight, start);
}

/// The block whose centre lies nearest above the crown, in [0.2 m, 2 m].
int crown_block(const RockMass<Planar>& mass) {
  int best = 0;
  double least = 1e9;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const double away = (mass.bodies[b].properties.centroid - Vec2(0, paper::radius + 0.3)).norm();
    if (away < least) {
      least = away;
      best = static_cast<int>(b);
    }
  }
  return best;
}

/// Lets a run whose tunnel is open come to rest, and reads the bolts.
template <class Bolts>
void settle(const std::string& what, Dynamics<2, CoulombJoint>& run, const Bolts& bolts, int crown,
            std::chrono::steady_clock::time_point start) {
  const Vec2 before = run.position(crown);
  double unbalance = 1;
  for (int k = 0; k < 40 && unbalance > 0.01; ++k) {
    run.advance(0.05);
    unbalance = run.unbalance_over_weight();
  }
  const std::vector<double> largest = largest_bolt_forces(
      bolt_forces(run, *bolts), static_cast<int>(bolt_bars(pattern, opening).size()));
  print(what, statistics(largest), (before - run.position(crown)).y(), unbalance, start);
}

void in_motion(const std::string& what, const RockMass<Planar>& rock, double damping) {
  const auto start = std::chrono::steady_clock::now();
  const auto mass = carve(rock, opening, 0.074);
  auto run = moving_rock(mass, joint, in_situ, {.local_damping = damping});
  const auto bolts = add_bolts(run, mass, bolt_bars(pattern, opening), bolt, 1, LorigAnchors{});
  run.set_held(0);
  settle(what, run, bolts, crown_block(mass), start);
}

void generated(const std::string& what, const RockMass<Planar>& rock, double damping) {
  const auto start = std::chrono::steady_clock::now();
  const CoulombJoint smooth(
      {.joint_normal_stiffness = 5e9, .joint_shear_stiffness = 5e8, .friction_angle = 1 * degree});
  auto made = generation_stage(rock, opening, smooth, in_situ, {}, {.unbalance = 0.05});
  made.fix_sides();
  made.run.set_laws(joint);
  made.run.set_local_damping(damping);
  const auto bolts =
      add_bolts(made.run, made.mass, bolt_bars(pattern, opening), bolt, 1, LorigAnchors{});
  made.excavate();
  settle(what, made.run, bolts, crown_block(made.mass), start);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::uint64_t> seeds;
  for (int k = 1; k < argc; ++k) {
    char* end = nullptr;
    const long seed = std::strtol(argv[k], &end, 10);
    if (*end != '\0' || seed < 1) {
      std::fprintf(stderr, "bolt_force_table: '%s' is no seed; accepted: whole numbers from 1\n",
                   argv[k]);
      return 2;
    }
    seeds.push_back(static_cast<std::uint64_t>(seed));
  }
  if (seeds.empty()) seeds.push_back(1);
  try {
    for (const std::uint64_t seed : seeds) {
      const auto rock = paper::sliced_rock(paper::mass_a, seed);
      std::printf("seed %d, %zu blocks, p0 = %.3f MPa\n", static_cast<int>(seed),
                  rock.bodies.size(), 1e-6 * paper::ground_pressure);
      std::printf("| %-56s | %-16s | crown | ratio   | wall  |\n", "solution procedure",
                  "F / (p0 D)");
      std::printf("|%s|%s|-------|---------|-------|\n", std::string(58, '-').c_str(),
                  std::string(18, '-').c_str());
      search("quasi-static: TwoLevel", rock, TwoLevel{});
      for (const double alpha : {0.7, 0.3, 0.1}) {
        char text[80];
        std::snprintf(text, sizeof text, "sudden, alpha %.1f: Explicit, scaled masses", alpha);
        search(text, rock, Explicit({.damping = alpha, .ramp_steps = 0}));
      }
      const CoulombJoint soft({.joint_normal_stiffness = 2.5e9,
                               .joint_shear_stiffness = 2.5e8,
                               .friction_angle = 35 * degree});
      search("quasi-static, joints half as stiff", rock, TwoLevel{}, soft);
      search("sudden, alpha 0.1, joints half as stiff", rock,
             Explicit({.damping = 0.1, .ramp_steps = 0}), soft);
      for (const double alpha : {0.7, 0.3, 0.1}) {
        char text[80];
        std::snprintf(text, sizeof text, "sudden, alpha %.1f: in motion, true masses", alpha);
        in_motion(text, rock, alpha);
      }
      for (const double alpha : {0.7, 0.1}) {
        char text[80];
        std::snprintf(text, sizeof text, "stress simulated, sudden, alpha %.1f: in motion", alpha);
        generated(text, rock, alpha);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bolt_force_table: %s\n", error.what());
    return 1;
  }
  return 0;
}
