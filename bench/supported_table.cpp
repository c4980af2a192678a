// SPDX-License-Identifier: MIT
// Supported tunnels that nobody picked: the rock of failure_cases.hpp with bolts and linings drawn
// from the number of the case, built in two stages, by TwoLevel, by Explicit and by the varied
// reference (all_blocks_in_motion.hpp). One line a case as CSV; counts at the end on the error
// stream.
//   supported_table [FIRST] [COUNT] [THREADS] [STEPS] [REFERENCES] [EVERY]
//                                             default: 0 200 1 1 2 1; hours
//   supported_table counts FILE...    of pieces that were written before: cases FIRST, FIRST +
//   EVERY
// With STEPS each of the two stages is unloaded in so many equal steps: what hangs on the path.
// REFERENCES: 0 none, minutes; 1 with nothing varied; 2 varied; 3 with joints of fibres, too.
//
//   bolts    in three of four cases: 0.3 to 0.6 spans long, 0.8 to 2 m apart, over the roof
//   lining   closed ring, arch on feet, or two arcs with a gap at the crown; 5 to 30 cm of 10 to 30
//            GPa, friction 20 to 40 degrees, bond in half of the cases
//   stages   the wall relaxes to 0.4 to 0.9 of its traction, then it is supported
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/contact/rock_on_lining.hpp>
#include <voussoir/core/parallel.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "all_blocks_in_motion.hpp"
#include "failure_cases.hpp"
#include "reference_counts.hpp"
#include "whole_number.hpp"

namespace {

using namespace voussoir;
using namespace voussoir_bench;

constexpr double degree = std::numbers::pi / 180;

struct SupportCase {
  std::string lining;      ///< ring, arch or gap
  double thickness;        ///< [m]
  double modulus;          ///< [Pa]
  double friction, bond;   ///< of the interface [rad], [Pa]
  double bolt_length = 0;  ///< [m]; 0: no bolts
  double bolt_spacing = 0;
  double relaxed;  ///< wall traction when the support comes [-]
};

SupportCase support_case(const FailureCase& rock) {
  Random random(20, static_cast<std::uint64_t>(rock.number));
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  SupportCase made;
  const char* linings[] = {"ring", "arch", "gap"};
  made.lining = linings[random.below(3)];
  made.thickness = between(0.05, 0.3);
  made.modulus = between(10e9, 30e9);
  made.friction = between(20, 40) * degree;
  made.bond = random.below(2) == 0 ? 0.0 : between(0.2e6, 1e6);
  if (random.below(4) != 0) {
    made.bolt_length = between(0.3, 0.6) * rock.span;
    made.bolt_spacing = between(0.8, 2);
  }
  made.relaxed = between(0.4, 0.9);
  return made;
}

struct Answer {
  std::string verdict = "-";
  double fallen = 0, crown = 0, thrust = 0, bolts = 0;
  double seconds = 0;
  std::optional<RockfallRange> range;
};

/// The same with every stage in equal steps of its traction.
template <class Tunnel>
Construction<Tunnel> in_steps(const Construction<Tunnel>& plan, int steps) {
  Construction<Tunnel> divided = plan;
  divided.stages.clear();
  double from = 1;
  for (auto stage : plan.stages) {
    const double to = stage.wall_traction;
    for (int k = 1; k <= steps; ++k) {
      stage.wall_traction = k == steps ? to : from + (to - from) * k / steps;
      divided.stages.push_back(stage);
      stage.rounds.clear();
      stage.bolts.clear();
      stage.linings.clear();
    }
    from = to;
  }
  return divided;
}

template <class Method>
Answer build(const FailureCase& rock, const SupportCase& support, int steps,
             const Method& method = Method()) {
  using Tunnel = Solver<Planar, CoulombJoint, RockOnLining<MohrCoulombJoint>, Method>;
  const auto start = std::chrono::steady_clock::now();
  Answer answer;
  answer.verdict = "fault";
  try {
    Tunnel tunnel(rock_of(rock), CoulombJoint(rock.joint), rock.in_situ);
    Construction<Tunnel> plan;
    plan.method = method;
    plan.acceptance.collapse_measure = collapse_measure_of(rock.opening);
    plan.add_stage("excavation", support.relaxed).excavate(rock.opening);
    auto& stage = plan.add_stage("support");
    if (support.bolt_length > 0)
      stage.install_bolts(
          {bolt_bars({.length = support.bolt_length, .wall_spacing = support.bolt_spacing},
                     rock.opening),
           AxialBolt({.axial_stiffness = 2e8, .rupture_force = 3e5}), 1.0});
    const double friction = support.friction, bond = support.bond;
    const MohrCoulombJoint interface(
        {.joint_normal_stiffness = 2e9,
         .joint_shear_stiffness = 2e9,
         .friction_angle = friction,
         .cohesion = bond,
         .tensile_strength = std::min(0.5 * bond, bond / std::tan(friction))},
        any_units);
    const LiningSection section = LiningSection::rectangular(support.thickness, support.modulus);
    // Of 72 nodes, and more where the bond needs them.
    const auto line = [&](double from, double to, bool has_feet) {
      LiningInstallation<Tunnel> lining{
          {.from = from * degree, .to = to * degree}, {section}, interface};
      if (has_feet)
        lining.feet.emplace(FootBearing::Params{
            .width = support.thickness, .stiffness = 2e9, .friction_angle = friction});
      stage.install_lining(lining);
    };
    if (support.lining == "ring") line(0, 360, false);
    if (support.lining == "arch") line(0, 180, true);
    if (support.lining == "gap") {
      line(0, 80, false);
      line(100, 180, false);
    }
    const auto built = construct(tunnel, in_steps(plan, steps));
    const SupportDemand demand = support_demand(tunnel);
    answer.verdict = to_string(built.verdict(), built.fallen_measure(), built.has_lost_lining());
    if (built.verdict() == Verdict::undecided)
      std::fprintf(stderr, "case %d: %s\n", rock.number, built.last().reason.c_str());
    answer.fallen = built.fallen_measure();
    answer.range = built.rockfall_range();
    answer.crown = built.stages.back().convergence.crown;
    answer.thrust = demand.mean_thrust;
    answer.bolts = demand.mean_bolt_force;
  } catch (const NumericalFault& fault) {
    std::fprintf(stderr, "case %d: %s\n", rock.number, fault.what());
  } catch (const InvalidInput& fault) {
    answer.verdict = "refused";
    std::fprintf(stderr, "case %d: %s\n", rock.number, fault.what());
  }
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return answer;
}

/// Of two values, over the larger, but no less than a floor: a hundredth of next to nothing is no
/// difference. Not a number in both (no block at the crown) is none.
double apart(double a, double b, double floor) {
  if (std::isnan(a) && std::isnan(b)) return 0;
  const double largest = std::max({std::abs(a), std::abs(b), floor});
  return std::abs(a - b) / largest;
}

TwoLevel with_range() {
  TwoLevel::Params params;
  params.motion.range = RangeSought::all;
  return TwoLevel(params);
}

const std::vector<std::string> procedure_names = {"two_level", "explicit"};

std::string head() {
  std::string text =
      "case,shape,span_m,cover_m,k0,friction_deg,lining,thickness_m,bond_MPa,bolt_length_m,relaxed";
  for (const std::string& name : procedure_names)
    for (const char* part : {"", "_m2", "_crown_mm", "_thrust_kN", "_bolts_kN", "_s"})
      text.append(",").append(name).append(part);
  text += ",marginal,least_m2,most_m2,another_verdict,marginal_s";
  for (const Variation& variation : variations)
    for (const char* part : {"", "_m2", "_s"}) text.append(",").append(variation.name).append(part);
  return text;
}

/// How the two procedures agree with each other.
struct Agreement {
  int same = 0, undecided = 0, stable = 0, close = 0, near = 0;

  void add(const FailureCase& rock, const Answer& a, const Answer& b) {
    same += a.verdict == b.verdict;
    undecided += (a.verdict == "undecided") + (b.verdict == "undecided");
    if (a.verdict != "stable" || b.verdict != "stable") return;
    ++stable;
    // Forces are counted from the weight of a mean block on.
    const double weight = 9.81 * rock.in_situ.density * rock.spacing * rock.spacing;
    const double worst = std::max({apart(a.crown, b.crown, 0), apart(a.thrust, b.thrust, weight),
                                   apart(a.bolts, b.bolts, weight)});
    close += worst <= 0.01;
    near += worst <= 0.05;
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 && std::strcmp(argv[1], "counts") == 0) {
    print_counts(lines_of({argv + 2, argv + argc}), procedure_names);
    return 0;
  }
  const int first = argc > 1 ? number_of(argv[1]) : 0, count = argc > 2 ? number_of(argv[2]) : 200,
            threads = argc > 3 ? number_of(argv[3]) : 1, steps = argc > 4 ? number_of(argv[4]) : 1,
            references = argc > 5 ? number_of(argv[5]) : 2,
            every = argc > 6 ? number_of(argv[6]) : 1;
  if (argc > 7 || first < 0 || count < 1 || threads < 1 || steps < 1 || references < 0 ||
      references > 3 || every < 1)
    return std::fputs(
               "usage: supported_table [FIRST >= 0] [COUNT >= 1] [THREADS >= 1] [STEPS >= 1] "
               "[REFERENCES 0 to 3] [EVERY >= 1]\n       supported_table counts FILE...\n",
               stderr),
           2;
  std::vector<std::string> lines = {head()};
  std::puts(lines.front().c_str());
  std::mutex guard;
  Agreement agreement;
  parallel_for(static_cast<std::size_t>(count), static_cast<unsigned>(threads), [&](std::size_t k) {
    const FailureCase rock = failure_case(first + every * static_cast<int>(k));
    const SupportCase support = support_case(rock);
    const Answer a = build<TwoLevel>(rock, support, steps),
                 b = build<Explicit>(rock, support, steps),
                 ranged = build<TwoLevel>(rock, support, steps, with_range());
    std::vector<Answer> motion(std::size(variations));
    for (std::size_t v = 0; v < motion.size(); ++v)
      if (is_wanted(v, references))
        motion[v] =
            build<AllBlocksInMotion>(rock, support, steps, AllBlocksInMotion(variations[v].motion));
    char text[200];
    std::snprintf(text, sizeof text, "%d,%s,%.2f,%.1f,%.2f,%.1f,%s,%.3f,%.2f,%.2f,%.2f",
                  rock.number, rock.shape.c_str(), rock.span, rock.cover, rock.k0,
                  rock.joint.friction_angle / degree, support.lining.c_str(), support.thickness,
                  1e-6 * support.bond, support.bolt_length, support.relaxed);
    std::string line = text;
    for (const Answer* it : {&a, &b}) {
      std::snprintf(text, sizeof text, ",%s,%.3g,%.4f,%.2f,%.3f,%.2f", it->verdict.c_str(),
                    it->fallen, 1e3 * it->crown, 1e-3 * it->thrust, 1e-3 * it->bolts, it->seconds);
      line += text;
    }
    const RockfallRange range = ranged.range.value_or(RockfallRange{ranged.fallen, ranged.fallen});
    std::snprintf(text, sizeof text, ",%d,%.4g,%.4g,%d,%.3g", range.is_marginal(), range.low,
                  range.high, range.has_other_verdict, ranged.seconds);
    line += text;
    for (const Answer& it : motion) {
      std::snprintf(text, sizeof text, ",%s,%.4g,%.3g", it.verdict.c_str(), it.fallen, it.seconds);
      line += text;
    }
    const std::scoped_lock lock(guard);
    lines.push_back(line);
    std::puts(line.c_str());
    std::fflush(stdout);
    agreement.add(rock, a, b);
  });
  std::fprintf(stderr,
               "%d cases: same verdict in %d, undecided answers %d; stable in both %d, crown, mean "
               "thrust and bolts within 1 %% in %d of these, within 5 %% in %d\n",
               count, agreement.same, agreement.undecided, agreement.stable, agreement.close,
               agreement.near);
  if (references > 1) print_counts(lines, procedure_names);
  return 0;
}
