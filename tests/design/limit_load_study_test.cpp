// SPDX-License-Identifier: MIT
// Strength reduction against the limit load on the same blocks: small unsupported tunnels whose
// joints dilate by their friction, and the same ones without dilation. docs/validation.md has what
// they print.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/design/factor_of_safety.hpp>
#include <voussoir/design/limit_problem.hpp>

namespace limit_load_study_test {
namespace {

using namespace voussoir;
using namespace voussoir::design;

constexpr double degree = std::numbers::pi / 180;

/// Two joint sets across each other and a circle of 4 to 5 m, all drawn by the number.
/// @param dilates  by the friction angle, without end
AnalysisInput drawn_tunnel(int number, bool dilates) {
  Random random(static_cast<std::uint64_t>(number), 42);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  AnalysisInput input;
  input.model = {.width = 20, .below_invert = 6, .seed = static_cast<std::uint64_t>(number)};
  input.tunnel.diameter = between(4, 5);
  input.tunnel.facets = 24;
  input.tunnel.cover = between(6, 10);
  input.rock.density = 2600;
  input.stress.K0 = between(0.6, 1.6);
  input.boundary.sides = input.boundary.base = Boundary::rollers;
  for (const double dip : {between(50, 85), between(5, 40)}) {
    JointSetInput& set = input.joint_sets.emplace_back();
    set.name = dip > 45 ? "steep" : "flat";
    set.plane = {dip * degree, dip > 45 ? 90 * degree : 270 * degree};
    set.sd = 3 * degree;
    set.spacing = between(1.0, 1.6);
  }
  const double friction = 50 * degree;
  if (dilates)
    input.joint = MohrCoulombJoint({.joint_normal_stiffness = 5e9,
                                    .joint_shear_stiffness = 5e8,
                                    .friction_angle = friction,
                                    .dilation_angle = friction,
                                    .dilation_limit = 1});
  else
    input.joint = CoulombJoint({5e9, 5e8, friction});
  input.blocks.min_inscribed_radius = 0.2;
  input.stages.push_back({.name = "excavation", .part = SectionPart{}});
  return input;
}

struct Compared {
  int number;
  std::size_t blocks = 0;
  FactorBracket bracket;
  LimitBound limit, in_situ_sides;
};

/// Rock falls from a factor on; the limit load of all blocks.
Compared compared(int number, bool dilates) {
  const AnalysisInput input = drawn_tunnel(number, dilates);
  const auto safety = factor_of_safety(input, rock_of(input), {.limit = SafetyLimit::rockfall});
  Compared found{number, 0, safety.bracket, {}, {}};
  if (!safety.standing) return found;
  const Tunnel& tunnel = safety.standing->tunnel;
  found.blocks = tunnel.mass().bodies.size();
  REQUIRE(tunnel.fallen().empty());
  found.limit = limit_load(limit_problem_of(tunnel, laws_of(input)));
  found.in_situ_sides = limit_load(limit_problem_of(tunnel, laws_of(input), SideForces::in_situ));
  return found;
}

std::string quantiles(std::vector<double> ratios) {
  std::sort(ratios.begin(), ratios.end());
  char text[160];
  const std::size_t n = ratios.size();
  if (n == 0) return "none";
  std::snprintf(text, sizeof text,
                "%zu: least %.3f, quarter %.3f, median %.3f, three quarters %.3f, most %.3f", n,
                ratios.front(), ratios[n / 4], ratios[n / 2], ratios[3 * n / 4], ratios.back());
  return text;
}

/// @return  how many have a bound
int study(int tunnels, bool dilates) {
  std::vector<double> ratios, in_situ;
  int endless = 0, none = 0;
  for (int number = 1; number <= tunnels; ++number) {
    CAPTURE(number);
    const Compared c = compared(number, dilates);
    char row[200];
    std::snprintf(row, sizeof row, "%d,%zu,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f", number, c.blocks,
                  c.bracket.stands, c.bracket.falls, c.limit.holds, c.limit.fails,
                  c.in_situ_sides.holds, c.in_situ_sides.fails);
    MESSAGE(row);
    if (c.bracket.stands == 0) {
      ++none;
      continue;
    }
    // The bracket's width, and half of it for the bound's.
    CHECK(c.limit.fails >= c.bracket.stands * 0.99);
    CHECK(c.in_situ_sides.holds <= c.limit.fails);
    if (std::isinf(c.limit.fails))
      ++endless;
    else
      ratios.push_back(c.limit.fails / c.bracket.stands);
    if (std::isfinite(c.in_situ_sides.fails))
      in_situ.push_back(c.in_situ_sides.fails / c.bracket.stands);
  }
  MESSAGE(std::string(dilates ? "dilation = friction" : "no dilation")
          << ", bound over factor: " << quantiles(ratios) << "; without end " << endless
          << ", nothing stands " << none << "; sides as in situ: " << quantiles(in_situ));
  return static_cast<int>(ratios.size());
}

}  // namespace

TEST_SUITE("design/limit_load_study") {
  TEST_CASE("a few tunnels do not stand beyond their limit load") { CHECK(study(3, true) >= 1); }

  TEST_CASE("50 tunnels do not stand beyond their limit load, dilating or not [long]") {
    CHECK(study(50, true) >= 25);
    CHECK(study(50, false) >= 25);
  }
}

}  // namespace limit_load_study_test
