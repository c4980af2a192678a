// SPDX-License-Identifier: MIT
// A tunnel driven in rounds in 3-D, and the convergence of its outline behind and ahead of the
// face.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/rockmass/isotropic_sets.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/theory/longitudinal_profile.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/outline_convergence.hpp>

namespace face_advance_test {

using namespace voussoir;

namespace {

/// Joints that neither open nor slip.
using Elastic = Solver<Spatial, MohrCoulombJoint>;
const MohrCoulombJoint elastic({.joint_normal_stiffness = 1e11,
                                .joint_shear_stiffness = 1e11 / 3,
                                .friction_angle = 1,
                                .cohesion = 2e9,
                                .tensile_strength = 1e9});
const InSitu deep{.density = 2700, .surcharge = 2e7};

/// Blocks of 2.5 m.
Elastic rock(double beside, double length) {
  const Domain<3> ground{{-beside, 0, -beside}, {beside, length, beside}};
  return {slice<Spatial>(ground, joint_network(isotropic_sets(5.4), ground, 1),
                         {.min_inscribed_radius = 0.3}),
          elastic, deep};
}

PrismaticOpening drift(double radius, double from, double to) {
  return PrismaticOpening(circular_opening(2 * radius, 24), from, to);
}

void settle(Elastic& tunnel, const Acceptance& acceptance, double wall_fraction = 0) {
  const EquilibriumReport report = tunnel.equilibrium(wall_fraction, {}, acceptance);
  INFO(report.reason);
  REQUIRE(report.verdict == Verdict::stable);
}

/// Centroids and displacements of all blocks, from west to east.
std::vector<std::pair<Vec3, Vec3>> moved(const Elastic& tunnel) {
  std::vector<std::pair<Vec3, Vec3>> all;
  for (std::size_t b = 0; b < tunnel.mass().bodies.size(); ++b) {
    const Vec3 centre = tunnel.mass().bodies[b].properties.centroid;
    all.emplace_back(centre, tunnel.displacement_of(static_cast<int>(b), centre));
  }
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return a.first.x() < b.first.x(); });
  return all;
}

}  // namespace

TEST_SUITE("tunnel/face_advance") {
  // Each of 13 searches ends with an elastic correction below 1e-8 of the largest displacement:
  // what they leave adds up to 1.3e-7 of it at most; 1e-6 is what is promised.
  TEST_CASE("elastic rock: twelve rounds end as one drift") {
    const Acceptance tight{.error_estimate = 1e-8};
    // Of the one every wall is unloaded at once; the other's keep 0.4 of their traction to the end,
    // handed on from round to round.
    Elastic in_rounds = rock(9, 17), held = in_rounds, at_once = in_rounds;
    const std::size_t block_count = at_once.mass().bodies.size();
    for (int k = 0; k < 12; ++k) {
      const PrismaticOpening round = drift(3, k == 0 ? -1 : k, k + 1);
      in_rounds.excavate(round, 0);
      settle(in_rounds, tight);
      held.excavate(round, 0);
      settle(held, tight, 0.4);
    }
    CHECK(held.wall_fractions() == std::vector<double>(12, 0.4));
    settle(held, tight);
    at_once.excavate(drift(3, -1, 12), 0);
    settle(at_once, tight);
    CHECK(at_once.mass().bodies.size() < block_count);
    const auto b = moved(at_once);
    for (const Elastic* tunnel : {&in_rounds, &held}) {
      const auto a = moved(*tunnel);
      REQUIRE(a.size() == b.size());
      double apart = 0, largest = 0;
      for (std::size_t k = 0; k < a.size(); ++k) {
        REQUIRE((a[k].first - b[k].first).norm() < 1e-9);
        apart = std::max(apart, (a[k].second - b[k].second).norm());
        largest = std::max(largest, b[k].second.norm());
      }
      CHECK(largest > 1e-4);
      CHECK(apart < 1e-6 * largest);
    }
  }

  // Blocks are half a radius large here. Where a rigid one spans the face, both sides of it have
  // one mean: with a slope of the profile of 1.6 per radius just behind the face that is up to
  // 0.2 at the stretches beside it and 0.07 in the mean of 18 of them. Sides at three radii add
  // some 0.03 (Lame's ring).
  TEST_CASE("the wall comes in along the tunnel as in a continuum") {
    Elastic driven = rock(15, 30), through = driven;
    driven.excavate(drift(5, -1, 17.5), 0);
    through.excavate(drift(5, -1, 31), 0);
    settle(driven, {});
    settle(through, {});
    const OutlineSampling sampling{.from = 2.5, .to = 25, .stretches = 18};
    const auto u = outline_convergence(driven, drift(5, 0, 1), sampling),
               all = outline_convergence(through, drift(5, 0, 1), sampling);
    double longest = 0, squared = 0;
    for (const double one : all) longest += one / sampling.stretches;
    for (int k = 0; k < sampling.stretches; ++k) {
      const double part = u[static_cast<std::size_t>(k)] / longest;
      const double x = (17.5 - sampling.middle(k)) / 5;
      squared += std::pow(part - elastic_longitudinal_profile(x, 0.19), 2) / sampling.stretches;
      if (x < -1) CHECK(part < 0.15);
      if (x > 1.5) CHECK(part > 0.8);
    }
    CHECK(longest > 0);
    CHECK(std::sqrt(squared) < 0.07);
  }
}

TEST_SUITE("tunnel/outline_convergence") {
  TEST_CASE("a rigid movement is no convergence; that of a ring is the mean of its wall") {
    Elastic tunnel = rock(9, 12);
    const PrismaticOpening whole = drift(3, -1, 13);
    tunnel.excavate(whole, 0);
    const OutlineSampling one{.from = 1, .to = 11, .stretches = 1, .around = 240, .along = 40};
    auto& system = detail::SystemOf::in(tunnel);
    for (int b = 0; b < tunnel.ground(); ++b) system.displacement.segment<3>(6 * b) << 3, -2, 1;
    // Normals of points evenly spaced on a regular polygon add up to nothing.
    for (const double u : outline_convergence(tunnel, whole, {.from = 1, .to = 11, .stretches = 5}))
      CHECK(std::abs(u) < 1e-12);
    system.displacement.setZero();
    settle(tunnel, {});
    double mean = 0, area = 0;
    for (const WallMotion& piece : wall_motion(tunnel, 6, 5)) {
      mean += piece.length * piece.convergence;
      area += piece.length;
    }
    CHECK(mean > 0);
    CHECK(std::abs(outline_convergence(tunnel, whole, one)[0] / (mean / area) - 1) < 0.05);
  }

  TEST_CASE("where there is no rock there is no number, and what makes no sense is refused") {
    const Elastic tunnel = rock(4, 6);
    const auto u =
        outline_convergence(tunnel, drift(2, 0, 1), {.from = 0, .to = 12, .stretches = 2});
    CHECK(u[0] == 0);
    CHECK(std::isnan(u[1]));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const OutlineSampling& bad : std::vector<OutlineSampling>{
             {2, 1, 1}, {0, nan, 1}, {0, 1, 0}, {0, 1, 1, 2}, {0, 1, 1, 72, 0}})
      CHECK_THROWS_AS((void)outline_convergence(tunnel, drift(2, 0, 1), bad), InvalidInput);
  }
}

}  // namespace face_advance_test
