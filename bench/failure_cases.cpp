// SPDX-License-Identifier: MIT
#include "failure_cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <voussoir/core/random.hpp>
#include <voussoir/tunnel/opening.hpp>

namespace voussoir_bench {

namespace {

using namespace voussoir;

constexpr double degree = std::numbers::pi / 180;
constexpr std::uint64_t seed_of_all = 19;

double between(Random& random, double low, double high) {
  return low + (high - low) * random.uniform();
}
double between_by_ratio(Random& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

SimplePolygon opening_of(const std::string& shape, double span, double wall) {
  if (shape == "circle") return circular_opening(span);
  if (shape == "horseshoe") return horseshoe_opening(span, wall);
  return SimplePolygon({{-0.5 * span, -0.5 * wall},
                        {0.5 * span, -0.5 * wall},
                        {0.5 * span, 0.5 * wall},
                        {-0.5 * span, 0.5 * wall}});
}

/// Dips towards the right, 0 to 180 degrees: beyond 90 the joint dips to the left.
std::vector<double> dips(Random& random, int count) {
  constexpr double apart = 20 * degree, half_turn = std::numbers::pi;
  std::vector<double> all;
  while (static_cast<int>(all.size()) < count) {
    const double dip = between(random, 0, half_turn);
    const bool is_new = std::all_of(all.begin(), all.end(), [&](double other) {
      const double between_them = std::abs(dip - other);
      return std::min(between_them, half_turn - between_them) >= apart;
    });
    if (is_new) all.push_back(dip);
  }
  return all;
}

}  // namespace

FailureCase failure_case(int number) {
  Random random(seed_of_all, static_cast<std::uint64_t>(number));
  const char* shapes[] = {"circle", "horseshoe", "chamber"};
  const std::string shape = shapes[random.below(3)];
  const double span = between(random, 4, 12);
  const double wall =
      shape == "chamber" ? between(random, 0.4, 1.2) * span : between(random, 0.2, 0.6) * span;
  const double cover = between_by_ratio(random, 10, 300);
  const double k0 = between(random, 0.5, 2);
  const int set_count = random.below(4) == 0 ? 2 : 3;
  const double spacing = span / between(random, 5, 11);
  const bool persistent = random.below(2) == 0;
  std::vector<JointSet> sets;
  for (const double dip : dips(random, set_count)) {
    const bool is_right = dip <= 0.5 * std::numbers::pi;
    JointSet& set = sets.emplace_back();
    set.name = std::string("J").append(std::to_string(sets.size()));
    set.dip = is_right ? dip : std::numbers::pi - dip;
    set.dip_direction = is_right ? DipDirection::east : DipDirection::west;
    set.dip_deviation = between(random, 1, 5) * degree;
    set.spacing = spacing;
    if (!persistent) set.extent = between(random, 2, 8) * spacing;
  }
  const double normal_stiffness = between_by_ratio(random, 2e9, 20e9);
  const CoulombJoint::Params joint{normal_stiffness, between(random, 0.1, 0.5) * normal_stiffness,
                                   between(random, 20, 45) * degree};
  const SimplePolygon opening = opening_of(shape, span, wall);
  const double rock_above = std::min(cover, 2.5 * span);
  constexpr double density = 2700, gravity = 9.81;
  return {number,
          shape,
          span,
          cover,
          k0,
          spacing,
          persistent,
          opening,
          domain_around(opening, 6 * span, rock_above, 2 * span),
          sets,
          {.min_inscribed_radius = 0.15 * spacing, .max_elongation = 5},
          joint,
          {.density = density,
           .k0 = k0,
           .surcharge = density * gravity * (cover - rock_above),
           .gravity = gravity}};
}

RockMass<Planar> rock_of(const FailureCase& from) {
  return slice(from.ground,
               joint_network(from.sets, from.ground, static_cast<std::uint64_t>(from.number)),
               from.limits);
}

}  // namespace voussoir_bench
