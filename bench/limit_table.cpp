// SPDX-License-Identifier: MIT
// Given blocks at the limit of what they bear, and roof beams, by every procedure and in motion,
// against limit analysis, closed forms and fibres: the table of docs/validation.md. CSV, one line a
// problem; minutes.
//   limit_table [FOLDER]
//   limit_table balance RATIO
// With RATIO: the limits alone, at rest, blocks balanced to so much of their weight.
// With FOLDER: pictures of an arch that falls and of a beam that stands, in a second, and no table.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/io/atomic_file.hpp>
#include <voussoir/io/blocks_picture.hpp>
#include <voussoir/solver/solver.hpp>

#include "support/fibre_beam.hpp"
#include "support/laid_problem.hpp"
#include "support/limit_analysis.hpp"

namespace {

using namespace voussoir;
using namespace voussoir_test;

constexpr double stiff = 1e12;  ///< k_n and k_s of blocks at their limit [Pa/m]

/// What may be out of balance at rest, over the weight of a block [-]; none: the default.
std::optional<double> balance;

template <class Method>
bool stands_at_rest(const LaidProblem& problem, double stiffness, double tan_friction) {
  auto solver =
      problem.solver<Solver<Method>>(CoulombJoint({stiffness, stiffness, std::atan(tan_friction)}));
  Acceptance acceptance;
  if (balance) acceptance.unbalance_over_weight = *balance;
  return solver.equilibrium(0, Method{}, acceptance).verdict == Verdict::stable &&
         solver.fallen().empty();
}

double fastest_of(const LaidProblem& problem, const auto& run) {
  double fastest = 0;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b)
    fastest = std::max(fastest, run.velocity(static_cast<int>(b)).norm());
  return fastest;
}
double farthest_of(const LaidProblem& problem, const auto& run) {
  double farthest = 0;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b)
    farthest = std::max(farthest, (run.position(static_cast<int>(b)) - problem.centre(b)).norm());
  return farthest;
}
/// The load comes on slowly: at once it would overshoot.
void let_go_slowly(auto& run) {
  constexpr int looks = 400;
  run.hold();
  for (int look = 1; look <= looks; ++look) {
    run.set_held(1 - static_cast<double>(look) / looks);
    run.advance_steps(100);
  }
}
/// Near the limit blocks sway about hinges for long: not at rest after a million steps counts as
/// not standing, which is safe by some per cent.
bool stands_in_motion(const LaidProblem& problem, double stiffness, double tan_friction) {
  auto run = problem.run(CoulombJoint({stiffness, stiffness, std::atan(tan_friction)}),
                         {.local_damping = 0.1, .viscous_damping = 0.3});
  let_go_slowly(run);
  for (int look = 0; look < 5000; ++look) {
    run.advance_steps(200);
    if (farthest_of(problem, run) > 0.05) return false;
    if (fastest_of(problem, run) < 1e-6) return true;
  }
  return false;
}

using Stands = std::function<bool(const LaidProblem&, double stiffness, double tan_friction)>;
const std::array<Stands, 4> procedures{stands_at_rest<TwoLevel>, stands_at_rest<Relaxation>,
                                       stands_at_rest<Explicit>, stands_in_motion};

/// Where `stands` changes, to 0.2 % of it.
template <class StandsAt>
double limit_between(double falls, double stands, StandsAt&& stands_at) {
  if (stands_at(falls) || !stands_at(stands)) return NAN;
  while (std::abs(stands - falls) > 2e-3 * std::abs(stands)) {
    const double middle = 0.5 * (falls + stands);
    (stands_at(middle) ? stands : falls) = middle;
  }
  return 0.5 * (falls + stands);
}

void print(const std::string& problem, double reference, const std::array<double, 4>& found) {
  std::printf("%s,%.5g", problem.c_str(), reference);
  for (const double value : found) std::printf(",%.5g,%+.1f", value, 100 * (value / reference - 1));
  std::printf("\n");
  std::fflush(stdout);
}
/// @param limit_of  limit_of(stands) for one procedure
void compare(const std::string& problem, double reference, auto&& limit_of) {
  std::array<double, 4> found{};
  for (std::size_t k = 0; k < found.size(); ++k) {
    const bool is_asked = !balance || k + 1 < found.size();
    found[k] = is_asked ? limit_of(procedures[k]) : NAN;
  }
  print(problem, reference, found);
}
void compare_push(const std::string& name, const LaidProblem& problem, double tan_friction) {
  const double limit = limit_factor(problem, tan_friction, problem.pushed(Vec2(1, 0))).value();
  compare(name, limit, [&](const Stands& stands) {
    return limit_between(1.15 * limit, 0.8 * limit, [&](double part) {
      LaidProblem pushed = problem;
      pushed.add(problem.pushed(Vec2(1, 0), part));
      return stands(pushed, stiff, tan_friction);
    });
  });
}

/// Least thickness over radius by limit analysis.
double least_thickness(int voussoirs, double tan_friction) {
  double falls = 0.08, stands = 0.12;
  while (stands - falls > 1e-7) {
    const double middle = 0.5 * (falls + stands);
    const LaidProblem arch = circular_arch(voussoirs, 10 * middle);
    const std::vector<Load2> none(arch.blocks.size());
    (limit_factor(arch, tan_friction, none) ? stands : falls) = middle;
  }
  return stands;
}

void slope() {
  constexpr double soft = 1e11, tan_friction = 0.65, published = 2013e3;
  compare("slope: tan phi", 0.7855, [&](const Stands& stands) {
    return limit_between(0.7, 0.9, [&](double mu) { return stands(toppling_slope(), soft, mu); });
  });
  const double direction = -34 * degree;  // 4 degrees down into the slope
  compare("slope: toe force [N/m]", published, [&](const Stands& stands) {
    return limit_between(1.5e6, 2.5e6, [&](double force) {
      LaidProblem held = toppling_slope();
      held.dead[1].force += force * Vec2(std::cos(direction), std::sin(direction));
      return stands(held, soft, tan_friction);
    });
  });
}

double sag_of(const LaidProblem& beam, auto&& position) {
  double sag = 0;
  for (std::size_t b = 2; b < beam.blocks.size(); ++b)
    sag = std::max(sag, beam.centre(b).y() - position(b).y());
  return sag;
}
template <class Method>
double sag_at_rest(int span) {
  const LaidProblem beam = voussoir_beam(span);
  auto solver = beam.solver<Solver<Method, MohrCoulombJoint>>(roof_joint(span));
  Acceptance near;
  near.displacement_limit = 1;
  if (solver.equilibrium(0, Method{}, near).verdict != Verdict::stable) return NAN;
  return sag_of(beam, [&](std::size_t b) {
    const Vec2 centre = beam.centre(b);
    return Vec2(centre + solver.displacement_of(static_cast<int>(b), centre));
  });
}
/// Until it rests.
auto beam_in_motion(const LaidProblem& beam, int span) {
  auto run = beam.run(roof_joint(span), {.local_damping = 0.7});
  let_go_slowly(run);
  for (int look = 0; look < 1000; ++look) {
    run.advance_steps(200);
    if (fastest_of(beam, run) < 1e-7) break;
  }
  return run;
}
void beams() {
  for (const int span : {5, 10, 15, 18, 20}) {
    const double k = voussoir_beam_stiffness(span);
    FibreBeam fibres{.span = span, .normal = k, .shear = k, .weight = 3000 * 9.81};
    const LaidProblem beam = voussoir_beam(span);
    const auto run = beam_in_motion(beam, span);
    print("beam of " + std::to_string(span) + " m: sag [m]", fibres.sag().value_or(NAN),
          {sag_at_rest<TwoLevel>(span), sag_at_rest<Relaxation>(span), sag_at_rest<Explicit>(span),
           sag_of(beam, [&](std::size_t b) { return run.position(static_cast<int>(b)); })});
  }
}

void draw(const std::string& file, const LaidProblem& problem, const auto& run,
          PictureHeader header, const ViewRect& view) {
  BlocksPicture picture;
  picture.header = std::move(header);
  picture.view = view;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const int n = static_cast<int>(b);
    const Vec2 centre = problem.centre(b);
    PictureBlock block;
    for (const Vec2& corner : problem.blocks[b].vertices())
      block.corners.push_back(run.position(n) + run.body(n).pose.rotation * (corner - centre));
    block.displacement = (run.position(n) - centre).norm();
    picture.blocks.push_back(std::move(block));
  }
  write_atomically(file, draw_blocks_picture(picture));
}
void pictures(const std::string& folder) {
  {
    LaidProblem arch = circular_arch(7, 1.5, 157.5 * degree);
    arch.add(arch.pushed(Vec2(1, 0), 0.4));
    auto run = arch.run(CoulombJoint({stiff, stiff, 60 * degree}), {.local_damping = 0.7});
    while (farthest_of(arch, run) < 0.8) run.advance_steps(200);
    draw(folder + "/arch.svg", arch, run,
         {.title = "Seven voussoirs under 0.40 g to the right",
          .lines = {"It falls from 0.374 g on, about four hinges."},
          .key_numbers = {}},
         {{-13, -1}, {13, 12}});
  }
  const LaidProblem beam = voussoir_beam(18);
  const auto run = beam_in_motion(beam, 18);
  draw(folder + "/beam.svg", beam, run,
       {.title = "Roof beam of 18 blocks of 1 m",
        .lines = {"The middle has sunk by 117 mm, a ninth of the thickness: it stands."},
        .key_numbers = {}},
       {{-2, -3}, {20, 3}});
}

}  // namespace

int main(int count, char** arguments) try {
  if (count == 3 && std::string(arguments[1]) == "balance") {
    balance = std::stod(arguments[2]);
  } else if (count > 1) {
    pictures(arguments[1]);
    return 0;
  }
  std::printf(
      "problem,reference,TwoLevel,off [%%],Relaxation,off [%%],Explicit,off [%%],Dynamics,off [%%]\n");
  if (!balance) beams();
  slope();
  const double rough = std::tan(60 * degree);
  compare_push("arch of 7 over 157.5 degrees: push [g]", circular_arch(7, 1.5, 157.5 * degree),
               rough);
  for (const int voussoirs : {5, 7, 9, 15, 31, 61}) {
    const double least = least_thickness(voussoirs, rough);
    compare("arch of " + std::to_string(voussoirs) + ": t/R", least, [&](const Stands& stands) {
      return limit_between(0.93 * least, 1.07 * least, [&](double part) {
        return stands(circular_arch(voussoirs, 10 * part), stiff, rough);
      });
    });
  }
  for (int number = 0; number < 10; ++number)
    compare_push("stack " + std::to_string(number) + ": push [g]", random_stack(number), rough);
  for (const int courses : {4, 8})
    compare_push("wall of " + std::to_string(courses) + " courses: push [g]", dry_wall(courses, 4),
                 0.7);
} catch (const std::exception& error) {
  std::fprintf(stderr, "limit_table: %s\n", error.what());
  return 1;
}
