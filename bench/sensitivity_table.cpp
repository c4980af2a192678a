// SPDX-License-Identifier: MIT
// How much answers and times depend on the numbers inside the search for equilibrium. Each is
// halved and doubled, as far as its range goes, the others left alone, over tunnels with and
// without rockfall, supported, in 3-D, and with contact updates. Prints the table of
// docs/sensitivity.md; with --all every run as CSV. A third of an hour.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <vector>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "cavern_case.hpp"
#include "design_case.hpp"

namespace {

using namespace voussoir;
using namespace voussoir_bench;

struct Setting {
  TwoLevel::Params params = {};
  Acceptance acceptance = {};
};

/// A number inside the search.
struct Knob {
  const char* group;
  const char* name;
  double usual, low, high;
  std::function<void(Setting&, double)> set;
};

int whole(double value) { return static_cast<int>(std::lround(value)); }

/// Of a number that counts something.
Knob counted(Knob made) {
  made.low = whole(made.low);
  return made;
}

/// Halved and doubled, within a range.
template <class Set>
Knob knob(const char* group, const char* name, double usual, Set set, double least = 0,
          double most = 1e300) {
  return {group, name, usual, std::max(least, 0.5 * usual), std::min(most, 2 * usual), set};
}

void add_two_level(std::vector<Knob>& all) {
  const TwoLevel::Params p;
  const auto add = [&](const char* name, int TwoLevel::Params::*member, int least) {
    all.push_back(counted(knob(
        "TwoLevel", name, p.*member, [=](Setting& s, double x) { s.params.*member = whole(x); },
        least)));
  };
  add("burst_steps", &TwoLevel::Params::burst_steps, 1);
  add("newton_steps", &TwoLevel::Params::newton_steps, 0);
  all.push_back(knob("TwoLevel", "newton_below", p.newton_below,
                     [](Setting& s, double x) { s.params.newton_below = x; }));
  add("rings", &TwoLevel::Params::rings, 0);
  add("max_bursts", &TwoLevel::Params::max_bursts, 1);
  add("increments", &TwoLevel::Params::increments, 1);
  add("max_restarts", &TwoLevel::Params::max_restarts, 0);
}

/// Members of one of the parts of `TwoLevel::Params`.
template <class Part>
struct Members {
  std::vector<Knob>& all;
  const char* group;
  Part TwoLevel::Params::*part;

  void add(const char* name, double Part::*member, double least = 0, double most = 1e300) const {
    const auto p = part;
    all.push_back(knob(
        group, name, Part{}.*member, [=](Setting& s, double x) { s.params.*p.*member = x; }, least,
        most));
  }
  void add(const char* name, int Part::*member, int least = 0) const {
    const auto p = part;
    all.push_back(counted(knob(
        group, name, Part{}.*member, [=](Setting& s, double x) { s.params.*p.*member = whole(x); },
        least)));
  }
  /// A number near 1: its distance from 1 is halved and doubled.
  void add_distance(const char* name, double Part::*member) const {
    const auto p = part;
    const double usual = Part{}.*member, away = usual - 1;
    all.push_back({group, name, usual, 1 + 0.5 * away, 1 + 2 * away,
                   [=](Setting& s, double x) { s.params.*p.*member = x; }});
  }
};

void add_parts(std::vector<Knob>& all) {
  const Members<Fire::Params> fire{all, "Fire", &TwoLevel::Params::fire};
  fire.add("largest_step", &Fire::Params::largest_step, 0, 0.95);
  fire.add("first_step", &Fire::Params::first_step);
  fire.add("mixing", &Fire::Params::mixing);
  fire.add("patience", &Fire::Params::patience);
  fire.add_distance("step_growth", &Fire::Params::step_growth);
  fire.add("step_cut", &Fire::Params::step_cut, 0, 0.9);
  fire.add_distance("mixing_decay", &Fire::Params::mixing_decay);

  const Members<LocalSearchTuning> local{all, "LocalSearchTuning", &TwoLevel::Params::local};
  using L = LocalSearchTuning;
  local.add("active_above", &L::active_above);
  local.add("first_reach", &L::first_reach);
  local.add("longest_step", &L::longest_step);
  local.add("reach_growth", &L::reach_growth);
  local.add("reach_shrinkage", &L::reach_shrinkage);
  local.add("shortest_reach", &L::shortest_reach);
  local.add("shortest_step", &L::shortest_step);
  local.add_distance("accepted_growth", &L::accepted_growth);
  local.add("spoilt_factor", &L::spoilt_factor);
  local.add("spoilt_addition", &L::spoilt_addition);

  const Members<CorrectionTuning> correction{all, "CorrectionTuning",
                                             &TwoLevel::Params::correction};
  using C = CorrectionTuning;
  correction.add("exactness", &C::exactness);
  correction.add("share_of_error", &C::share_of_error);
  correction.add("residual_growth", &C::residual_growth);
  correction.add("shortest", &C::shortest);

  const Members<DetachmentTuning> detachment{all, "DetachmentTuning",
                                             &TwoLevel::Params::detachment};
  using D = DetachmentTuning;
  detachment.add("far_limit", &D::far_limit);
  detachment.add("far_blocks", &D::far_blocks);
  detachment.add("first_look", &D::first_look);
  detachment.add("second_look", &D::second_look);

  const Members<RestartTuning> restart{all, "RestartTuning", &TwoLevel::Params::restart};
  using R = RestartTuning;
  restart.add("follow_to", &R::follow_to);
  restart.add("follow_closer", &R::follow_closer);
  restart.add("updates", &R::updates);
  restart.add("updates_on_the_way", &R::updates_on_the_way);

  const Members<PathTuning> path{all, "PathTuning", &TwoLevel::Params::path};
  using P = PathTuning;
  path.add("one_step_share", &P::one_step_share);
  path.add("looseness", &P::looseness, 1);
  path.add("burst_steps", &P::burst_steps, 1);
  path.add("turn", &P::turn);
  path.add("halvings", &P::halvings, 1);

  const Members<MotionTuning> motion{all, "MotionTuning", &TwoLevel::Params::motion};
  using M = MotionTuning;
  motion.add("viscous_damping", &M::viscous_damping);
  motion.add("local_damping", &M::local_damping, 0, 0.9);
  motion.add("safety", &M::safety, 0, 1);
  motion.add("inert_share", &M::inert_share, 0, 0.9);
  motion.add("ramp", &M::ramp);
  motion.add("rest_ratio", &M::rest_ratio);
  motion.add("patience", &M::patience);
  motion.add("longest", &M::longest);
  motion.add("looks_in_ramp", &M::looks_in_ramp, 1);
  motion.add("check_every", &M::check_every, 1);

  const Members<Relaxation::Params> fallback{all, "Relaxation", &TwoLevel::Params::fallback};
  using F = Relaxation::Params;
  fallback.add("max_steps", &F::max_steps);
  fallback.add("check_every", &F::check_every);
  fallback.add("damping", &F::damping, 0, 0.9);
  fallback.add("safety", &F::safety, 0, 1);
  fallback.add("rings", &F::rings);
  fallback.add("active_above", &F::active_above);
}

/// What is wanted of an answer, for comparison: these are meant to matter.
void add_acceptance(std::vector<Knob>& all) {
  const auto add = [&](const char* name, double Acceptance::*member, double usual) {
    all.push_back(
        knob("Acceptance", name, usual, [=](Setting& s, double x) { s.acceptance.*member = x; }));
  };
  const Acceptance usual;
  add("error_estimate", &Acceptance::error_estimate, usual.error_estimate);
  add("unbalance_over_weight", &Acceptance::unbalance_over_weight, usual.unbalance_over_weight);
  // A fifth of a block of these tunnels, which is what the rock chooses.
  add("displacement_limit", &Acceptance::displacement_limit, 0.12);
}

struct Answer {
  double crown, fallen, bolt;
  std::string verdict;
  double seconds;  ///< of the processor
};

/// A tunnel to be solved: returns the answer for a setting.
struct Case {
  std::string name;
  std::function<Answer(Setting)> solve;
};

template <class Tunnel>
Case case_of(std::string name, const Tunnel& before, double contact_update_limit = 0) {
  return {std::move(name), [before, contact_update_limit](Setting setting) {
            if (contact_update_limit > 0) {
              setting.acceptance.contact_update_limit = contact_update_limit;
            }
            Tunnel tunnel = before;
            const std::clock_t start = std::clock();
            const EquilibriumReport report =
                tunnel.equilibrium(0, TwoLevel(setting.params), setting.acceptance);
            Answer answer{};
            answer.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
            if constexpr (Tunnel::dim == 2)
              answer.crown = convergence(tunnel).crown;
            else
              answer.crown = convergence(tunnel, 6, 4).crown;
            answer.fallen = report.fallen_measure;
            answer.bolt = support_demand(tunnel).largest_bolt_force;
            answer.verdict = to_string(report);
            return answer;
          }};
}

const SimplePolygon opening = circular_opening(5, 36);

/// A 5 m tunnel under 10 m of rock like that of the design case, 1400 blocks.
Tunnel small_tunnel(std::uint64_t seed) {
  return {paper::sliced_rock(paper::mass_a, seed, domain_around(opening, 35, 10, 15)),
          CoulombJoint({paper::normal_stiffness, paper::shear_stiffness, paper::friction}),
          {.density = paper::density, .k0 = 1},
          opening};
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::uint64_t seed : {1, 2, 3, 4})
    all.push_back(case_of("bare, seed " + std::to_string(seed), small_tunnel(seed)));
  const Tunnel bare = small_tunnel(1);
  all.push_back(case_of("bare, seed 1, contact updates", bare, 0.02));
  Tunnel bolted = bare;
  const AxialBolt bolt({.axial_stiffness = 2e8, .rupture_force = 5e5});
  for (const auto& bar : bolt_bars({.length = 3, .angular_spacing = 22.5 * degree}, opening))
    bolted.install_bolt(bar, bolt);
  all.push_back(case_of("bolts", bolted));
  bolted.install_lining(lining_frame(bolted.mass(), {}), LiningSection::rectangular(0.1, 25e9),
                        CoulombJoint({1e9, 1e9, 30 * degree}));
  all.push_back(case_of("bolts, 10 cm lining", bolted));
  all.push_back(case_of("3-D, bare", excavated_cavern(3)));
  all.push_back(case_of("3-D, bolts and ribs", cavern(3)));
  return all;
}

double change(double value, double usual) {
  if (std::isnan(value) && std::isnan(usual)) return 0;
  return usual == value ? 0 : std::abs(value / usual - 1);
}

/// The largest changes over all cases and both values.
struct Summary {
  double crown = 0, fallen = 0, bolt = 0, least_time = 1e300, most_time = 0;
  std::string verdicts;

  void add(const Case& of, const Answer& usual, const Answer& answer) {
    least_time = std::min(least_time, answer.seconds / usual.seconds);
    most_time = std::max(most_time, answer.seconds / usual.seconds);
    if (answer.verdict != usual.verdict) {
      verdicts += (verdicts.empty() ? "" : "; ") + of.name + ": " + answer.verdict;
      return;  // other states are not compared
    }
    crown = std::max(crown, change(answer.crown, usual.crown));
    if (const double change = std::abs(answer.fallen - usual.fallen);
        change > 1e-9)  // of adding up
      fallen = std::max(fallen, change);
    bolt = std::max(bolt, change(answer.bolt, usual.bolt));
  }
  void print(const Knob& k) const {
    std::printf("| `%s::%s` | %g | %g, %g | %.2g | %.2g | %.2g | %.2f to %.2f | %s |\n", k.group,
                k.name, k.usual, k.low, k.high, 100 * crown, fallen, 100 * bolt, least_time,
                most_time, verdicts.empty() ? "same" : verdicts.c_str());
  }
};

void print_run(const std::string& knob, double value, const Case& of, const Answer& a) {
  std::printf("%s,%g,\"%s\",%s,%.5g,%.5g,%.5g,%.3g\n", knob.c_str(), value, of.name.c_str(),
              a.verdict.c_str(), 1e3 * a.crown, a.fallen, 1e-3 * a.bolt, a.seconds);
}

void run(bool every_run) {
  std::vector<Knob> knobs;
  add_acceptance(knobs);
  add_two_level(knobs);
  add_parts(knobs);
  const std::vector<Case> all = cases();
  std::vector<Answer> usual;
  if (every_run)
    std::printf("number,value,tunnel,verdict,crown_mm,fallen,largest_bolt_force_kN,cpu_s\n");
  else
    std::printf(
        "| tunnel | verdict | crown [mm] | fallen [m², m³] | largest bolt force [kN] |\n"
        "|---|---|---|---|---|\n");
  for (const Case& c : all) {
    (void)c.solve({});  // the first pays for memory
    const Answer a = c.solve({});
    usual.push_back(a);
    if (every_run)
      print_run("default", 0, c, a);
    else
      std::printf("| %s | %s | %.3f | %.3g | %.1f |\n", c.name.c_str(), a.verdict.c_str(),
                  1e3 * a.crown, a.fallen, 1e-3 * a.bolt);
  }
  if (!every_run)
    std::printf(
        "\n| number | default | tried | crown [%%] | fallen [m², m³] | bolt force [%%] | "
        "time | verdicts |\n|---|---|---|---|---|---|---|---|\n");
  for (const Knob& k : knobs) {
    Summary summary;
    for (const double value : {k.low, k.high}) {
      Setting setting;
      k.set(setting, value);
      for (std::size_t c = 0; c < all.size(); ++c) {
        const Answer answer = all[c].solve(setting);
        summary.add(all[c], usual[c], answer);
        if (every_run) print_run(std::string(k.group) + "::" + k.name, value, all[c], answer);
      }
    }
    if (!every_run) summary.print(k);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool every_run = argc == 2 && std::strcmp(argv[1], "--all") == 0;
  if (argc > 1 && !every_run) {
    std::fprintf(stderr, "usage: sensitivity_table [--all]\n");
    return 2;
  }
  run(every_run);
  return 0;
}
