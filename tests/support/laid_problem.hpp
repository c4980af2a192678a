// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/rockmass/laid_blocks.hpp>
#include <voussoir/solver/solver.hpp>

#include "support/blocks.hpp"

/// Blocks of textbooks, laid one by one: said once, and given to `Solver`, to `Dynamics` and to
/// limit analysis.
namespace voussoir_test {

using Load2 = voussoir::Load<2>;

/// In 2-D, per metre.
struct LaidProblem {
  std::vector<voussoir::ConvexPolygon> blocks;
  std::vector<int> fixed;
  double density = 2500;      ///< [kg/m^3]
  double gravity = 9.81;      ///< downwards [m/s^2]
  std::vector<Load2> dead{};  ///< besides the weight [N], [N m]; empty: none

  [[nodiscard]] bool is_fixed(std::size_t b) const {
    return std::find(fixed.begin(), fixed.end(), static_cast<int>(b)) != fixed.end();
  }
  [[nodiscard]] voussoir::Vec2 centre(std::size_t b) const {
    return voussoir::mass_properties(blocks[b]).centroid;
  }
  [[nodiscard]] double weight(std::size_t b) const {
    return density * gravity * voussoir::mass_properties(blocks[b]).measure;
  }
  /// Weight and dead load.
  [[nodiscard]] Load2 dead_load(std::size_t b) const {
    Load2 load = dead.empty() ? Load2{} : dead[b];
    load.force.y() -= weight(b);
    return load;
  }
  /// A part of its weight along this unit vector on every block that is not fixed.
  [[nodiscard]] std::vector<Load2> pushed(const voussoir::Vec2& along, double part = 1) const {
    std::vector<Load2> loads(blocks.size());
    for (std::size_t b = 0; b < blocks.size(); ++b)
      if (!is_fixed(b)) loads[b].force = part * weight(b) * along;
    return loads;
  }
  void add(const std::vector<Load2>& loads) {
    if (dead.empty()) dead.resize(blocks.size());
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      dead[b].force += loads[b].force;
      dead[b].moment += loads[b].moment;
    }
  }

  /// @return  a solver whose blocks carry nothing yet
  template <class Solver, class Law>
  [[nodiscard]] Solver solver(const Law& law) const {
    Solver made(voussoir::laid_blocks<voussoir::Planar>(blocks), law,
                {.density = density, .gravity = gravity, .is_laid = true});
    for (const int b : fixed) made.fix(b);
    for (std::size_t b = 0; b < dead.size(); ++b)
      if (!is_fixed(b)) made.add_load(static_cast<int>(b), dead[b]);
    return made;
  }
  /// Blocks have the same numbers as here.
  template <class Law>
  [[nodiscard]] voussoir::Dynamics<2, Law> run(const Law& law,
                                               voussoir::DynamicsSettings settings) const {
    settings.gravity = gravity;
    voussoir::Dynamics<2, Law> made(law, settings);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const int n =
          is_fixed(b) ? made.add_fixed_block(blocks[b]) : made.add_block(blocks[b], density);
      if (b < dead.size() && !is_fixed(b)) made.add_load(n, dead[b].force, dead[b].moment);
    }
    return made;
  }
};

/// True if the blocks of a run come to rest: speeds below `still` [m/s] before any has moved by
/// `far` [m].
/// @throws std::runtime_error  neither
template <class Run>
[[nodiscard]] bool comes_to_rest(Run& run, double far, double still) {
  std::vector<voussoir::Vec2> start;
  for (int b = 0; b < run.body_count(); ++b) start.push_back(run.position(b));
  for (int look = 0; look < 20000; ++look) {
    run.advance_steps(200);
    double moved = 0, speed = 0;
    for (int b = 0; b < run.body_count(); ++b) {
      moved = std::max(moved, (run.position(b) - start[static_cast<std::size_t>(b)]).norm());
      speed = std::max(speed, run.velocity(b).norm());
    }
    if (moved > far) return false;
    if (look > 2 && speed < still) return true;
  }
  throw std::runtime_error("neither rest nor collapse");
}

/// Where two blocks touch along faces of both.
struct FlatJoint {
  int a, b;
  voussoir::Vec2 p, q;    ///< its ends [m]
  voussoir::Vec2 normal;  ///< from a to b
};

/// All of them: every face against every other.
[[nodiscard]] inline std::vector<FlatJoint> joints_of(const LaidProblem& problem) {
  using voussoir::Vec2;
  std::vector<FlatJoint> joints;
  constexpr double near = 1e-7;  // [m]
  for (std::size_t a = 0; a < problem.blocks.size(); ++a)
    for (std::size_t b = a + 1; b < problem.blocks.size(); ++b)
      for (std::size_t i = 0; i < problem.blocks[a].size(); ++i)
        for (std::size_t j = 0; j < problem.blocks[b].size(); ++j) {
          const auto face = problem.blocks[a].face(i), other = problem.blocks[b].face(j);
          const Vec2 along = (face.end - face.start).normalized();
          const Vec2 outward(along.y(), -along.x());
          if (std::abs(outward.dot(other.start - face.start)) > near ||
              std::abs(outward.dot(other.end - face.start)) > near ||
              along.dot(other.end - other.start) > 0)
            continue;
          const double from = std::max(0.0, along.dot(other.end - face.start));
          const double to =
              std::min((face.end - face.start).norm(), along.dot(other.start - face.start));
          if (to - from > near)
            joints.push_back({static_cast<int>(a), static_cast<int>(b), face.start + from * along,
                              face.start + to * along, outward});
        }
  return joints;
}

/// Equal voussoirs of mean radius 10 m between springings that are fixed (blocks 0 and 1).
/// @param embrace  angle of the arch [rad]; pi: a semicircle, between level springings
[[nodiscard]] inline LaidProblem circular_arch(int voussoirs, double thickness,
                                               double embrace = std::numbers::pi) {
  using voussoir::Vec2;
  constexpr double radius = 10;
  const bool is_whole = embrace == std::numbers::pi;
  const double start = 0.5 * (std::numbers::pi - embrace);
  const auto corner = [&](double r, double k) {
    const double angle = start + embrace * k / voussoirs;
    // The springings of a semicircle are level to the last bit.
    const bool is_level = is_whole && (k == 0 || k == voussoirs);
    return Vec2(r * std::cos(angle), is_level ? 0.0 : r * std::sin(angle));
  };
  const double inner = radius - 0.5 * thickness, outer = radius + 0.5 * thickness;
  const auto springing = [&](double k, double beyond) {
    const Vec2 middle = corner(radius, k);
    const Vec2 across = is_whole ? Vec2(k == 0 ? 1 : -1, 0) : Vec2(middle / radius);
    const Vec2 down = beyond * Vec2(-across.y(), across.x());
    const Vec2 a = middle - thickness * across, b = middle + thickness * across;
    return beyond < 0 ? voussoir::ConvexPolygon({a, a + 2 * down, b + 2 * down, b})
                      : voussoir::ConvexPolygon({a, b, b + 2 * down, a + 2 * down});
  };
  LaidProblem arch{
      .blocks = {springing(0, -1), springing(voussoirs, 1)}, .fixed = {0, 1}, .density = 2000};
  for (int k = 0; k < voussoirs; ++k)
    arch.blocks.push_back(voussoir::ConvexPolygon(
        {corner(inner, k), corner(outer, k), corner(outer, k + 1), corner(inner, k + 1)}));
  return arch;
}

/// Goodman and Bray (1976): 16 blocks of 10 m on a base in steps of 1 m that dips by 30 degrees.
/// Block 0 is the base under block 1, 1 is the block at the toe, 2 the base under the next, ...
///
/// The base is horizontal here and gravity turned: x up the slope.
[[nodiscard]] inline LaidProblem toppling_slope() {
  using voussoir::Vec2;
  constexpr double dip = 30 * degree, width = 10, step = 1;
  constexpr double heights[] = {4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 34, 28, 22, 16, 10, 4};
  LaidProblem slope{.blocks = {}, .fixed = {}, .density = 25e3 / 9.81};
  for (int k = 0; k < 16; ++k) {
    const double x = width * k, base = step * k, height = heights[k];
    slope.fixed.push_back(2 * k);
    slope.blocks.push_back(rectangle({x + 0.5 * width, base - 5}, width, 10));
    slope.blocks.push_back(rectangle({x + 0.5 * width, base + 0.5 * height}, width, height));
    slope.dead.emplace_back();
    // Gravity acts along -y already: what is missing turns it.
    slope.dead.push_back({Vec2(25e3 * width * height * Vec2(-std::sin(dip), 1 - std::cos(dip)))});
  }
  return slope;
}

/// Equal blocks in a row between abutments that are fixed (0 and 1), 1 m high and 1 m long: what is
/// left of a roof stratum with vertical joints (Diederichs and Kaiser 1999).
[[nodiscard]] inline LaidProblem voussoir_beam(int span) {
  LaidProblem beam{.blocks = {rectangle({-1, 0}, 2, 3), rectangle({span + 1.0, 0}, 2, 3)},
                   .fixed = {0, 1},
                   .density = 3000};
  for (int k = 0; k < span; ++k) beam.blocks.push_back(rectangle({k + 0.5, 0}, 1, 1));
  return beam;
}

/// k_n that makes its span + 1 joints as soft as span metres of rock of 10/3 GPa: of 10 GPa with
/// joints of 5 GPa/m every metre [Pa/m]
[[nodiscard]] constexpr double voussoir_beam_stiffness(int span) {
  return 1e10 / 3 * (span + 1) / span;
}
/// Joints of the beam, which cannot slip as long as they are pressed: without thrust yet, nothing
/// else keeps the row from sliding out as a whole.
[[nodiscard]] inline voussoir::MohrCoulombJoint roof_joint(int span) {
  const double k = voussoir_beam_stiffness(span);
  return voussoir::MohrCoulombJoint({.joint_normal_stiffness = k,
                                     .joint_shear_stiffness = k,
                                     .friction_angle = 60 * degree,
                                     .cohesion = 1e7,
                                     .residual_cohesion = 1e7});
}

/// A wall of courses in running bond on a base that is fixed (0): blocks 1 m x 0.5 m, every second
/// course with halves at its ends.
[[nodiscard]] inline LaidProblem dry_wall(int courses, int blocks_a_course) {
  const double width = blocks_a_course;
  LaidProblem wall{.blocks = {rectangle({0.5 * width, -0.5}, 3 * width, 1)}, .fixed = {0}};
  for (int c = 0; c < courses; ++c) {
    const double y = 0.5 * c + 0.25;
    if (c % 2 == 0) {
      for (int k = 0; k < blocks_a_course; ++k)
        wall.blocks.push_back(rectangle({k + 0.5, y}, 1, 0.5));
      continue;
    }
    wall.blocks.push_back(rectangle({0.25, y}, 0.5, 0.5));
    for (int k = 1; k < blocks_a_course; ++k)
      wall.blocks.push_back(rectangle({static_cast<double>(k), y}, 1, 0.5));
    wall.blocks.push_back(rectangle({width - 0.25, y}, 0.5, 0.5));
  }
  return wall;
}

/// Blocks of random widths and heights on one another, each with its middle over that below to
/// within a quarter of its width; the number of the stack draws them. Block 0 is fixed.
[[nodiscard]] inline LaidProblem random_stack(int number) {
  voussoir::Random random(static_cast<std::uint64_t>(number), 31);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  LaidProblem stack{.blocks = {rectangle({0, -0.5}, 6, 1)}, .fixed = {0}};
  double x = 0, y = 0;
  const int count = 3 + static_cast<int>(random.below(5));
  for (int k = 0; k < count; ++k) {
    const double width = between(0.6, 1.4), height = between(0.2, 0.8);
    if (k > 0) x += between(-0.1, 0.1);
    stack.blocks.push_back(rectangle({x, y + 0.5 * height}, width, height));
    y += height;
  }
  return stack;
}

}  // namespace voussoir_test
