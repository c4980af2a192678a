// SPDX-License-Identifier: MIT
#pragma once
// Tunnels drawn by a seed whose joints end on corners and lie on planes of symmetry, so that
// roundings would have a word wherever something is chosen; and how each is given anew.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/mapped_traces.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/degree.hpp"
#include "support/transformed.hpp"

namespace voussoir_test::tied {

using namespace voussoir;

/// What is drawn by a seed, about the origin.
struct Drawn {
  SimplePolygon opening;
  Domain<2> ground;
  std::vector<MappedTrace> traces;
  bool has_bolts = false;
  int lining = 0;  ///< 1: all round, 2: an arch on feet
  bool is_on_elastic_ground = false;
  double friction = 0;  ///< [degrees]
};

[[nodiscard]] inline SimplePolygon box(double width, double floor, double roof) {
  const double x = 0.5 * width;
  return SimplePolygon({{x, floor}, {x, roof}, {-x, roof}, {-x, floor}});
}

[[nodiscard]] inline SimplePolygon outline(Random& random) {
  switch (random.below(5)) {
    case 0:
      return circular_opening(4, 24);
    case 1:
      return circular_opening(4, 36);
    case 2:
      return horseshoe_opening(4, 1.5, 24);
    case 3:
      return box(4, -1.5, 1.5);
    default:  // with a sloping roof
      return SimplePolygon({{2, -1.5}, {2, 1}, {-2, 2}, {-2, -1.5}});
  }
}

[[nodiscard]] inline MappedTrace trace(const Vec2& from, const Vec2& to, int set) {
  return {{from, to}, set};
}

/// Beds at even distances, one of them through the springing, the roof or between; courses of
/// upright joints that end on them, a line in the middle.
inline void add_beds(Random& random, std::vector<MappedTrace>& traces) {
  const double distance = std::array{1.0, 1.5, 2.0}[random.below(3)],
               width = std::array{1.0, 2.0}[random.below(2)];
  const double shift = random.below(2) == 0 ? 0 : 0.5 * distance;
  const bool is_staggered = random.below(2) == 0;
  for (int k = -9; k <= 9; ++k) {
    const double y = shift + distance * k;
    traces.push_back(trace({-12, y}, {12, y}, 0));
    const double from = is_staggered && k % 2 != 0 ? 0.5 * width : 0;
    for (int i = -8; i <= 8; ++i)
      traces.push_back(trace({from + width * i, y}, {from + width * i, y + distance}, 1));
  }
}
/// Two sets of endless joints that are each other's image.
inline void add_wedges(Random& random, std::vector<MappedTrace>& traces) {
  const double dip = std::array{30.0, 45.0, 60.0}[random.below(3)] * degree, distance = 1.5;
  const double shift = random.below(2) == 0 ? 0 : 0.5 * distance;
  for (const double side : {-1.0, 1.0})
    for (int k = -8; k <= 8; ++k) {
      const Vec2 along(std::cos(dip), side * std::sin(dip)), across(-along.y(), along.x());
      const Vec2 middle = side * (shift + distance * k) * across;
      traces.push_back(trace(middle - 20 * along, middle + 20 * along, side < 0 ? 0 : 1));
    }
}
/// Nothing of it is even; traces end anywhere.
inline void add_scattered(Random& random, std::vector<MappedTrace>& traces) {
  for (int k = 0; k < 90; ++k) {
    const int set = static_cast<int>(random.below(3));
    const double turn = (std::array{5.0, 65.0, 120.0}[static_cast<std::size_t>(set)] +
                         6 * (random.uniform() - 0.5)) *
                        degree;
    const Vec2 along(std::cos(turn), std::sin(turn)),
        middle(16 * (random.uniform() - 0.5), 14 * (random.uniform() - 0.5));
    const double half = 1 + 3 * random.uniform();
    traces.push_back(trace(middle - half * along, middle + half * along, set));
  }
}

[[nodiscard]] inline Drawn drawn(std::uint64_t seed) {
  Random random(seed, 40);
  Drawn d{outline(random), {}, {}};
  d.ground = domain_around(d.opening, 16, 5, 4);
  switch (random.below(3)) {
    case 0:
      add_beds(random, d.traces);
      break;
    case 1:
      add_wedges(random, d.traces);
      break;
    default:
      add_scattered(random, d.traces);
  }
  d.has_bolts = random.below(2) == 0;
  d.lining = static_cast<int>(random.below(3));
  d.is_on_elastic_ground = random.below(2) == 0;
  d.friction = std::array{35.0, 45.0, 60.0}[random.below(3)];
  return d;
}

/// How a problem is given anew: moved, its joints by a little more, its traces in pieces.
struct Image {
  const char* name;
  Transform<2> map = {};
  /// Of the first answer; angles count from the origin where it lies in the opening, else from the
  /// centroid, so what is moved away is compared with what lies beside it.
  Transform<2> from = {};
  Vec2 joints = zeros<Vec2>();  ///< of joints alone [m]
  bool in_pieces = false;
};

[[nodiscard]] inline std::vector<MappedTrace> traces_of(const Drawn& d, const Image& image) {
  std::vector<MappedTrace> traces;
  for (const MappedTrace& whole : d.traces) {
    const Vec2 from = image.map(whole.points.front()) + image.joints,
               to = image.map(whole.points.back()) + image.joints;
    if (!image.in_pieces) {
      traces.push_back({{from, to}, whole.set});
      continue;
    }
    // Some as polylines, some as traces of their own, turned; the last comes first.
    const Vec2 third = from + (to - from) / 3, half = from + 0.5 * (to - from);
    if (traces.size() % 2 == 0)
      traces.push_back({{to, half, third, from}, whole.set});
    else
      for (const auto& [a, b] :
           {std::pair(from, third), std::pair(half, third), std::pair(half, to)})
        traces.push_back({{a, b}, whole.set});
  }
  if (image.in_pieces) std::reverse(traces.begin(), traces.end());
  return traces;
}

/// What of the tunnel of a seed is known not to agree.
[[nodiscard]] inline bool is_known(std::uint64_t seed, const std::string& image) {
  const bool is_mirrored = image == "mirrored";
  // So much slips that the unloading goes in increments, of which each leaves its slip behind.
  if (seed == 10 || seed == 22) return image != "in pieces";
  // A block that is too small stands on the middle of the domain between two that are each
  // other's image: it has to go to one of them.
  return is_mirrored && (seed == 28 || seed == 42);
}

}  // namespace voussoir_test::tied
