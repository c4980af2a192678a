// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/mapped_traces.hpp>

/// Trace maps as surveys have them, drawn by a seed.
namespace voussoir_test {

using voussoir::MappedTrace;
using voussoir::Vec2;

/// To a tenth of a millimetre, as coordinates are written.
inline Vec2 written(const Vec2& p) {
  return {std::round(1e4 * p.x()) / 1e4, std::round(1e4 * p.y()) / 1e4};
}

/// Three sets: twenty long ones right through the domain, and shorter ones of which many end on
/// others, a little before or beyond; a third are polylines, a tenth is there twice, the copy moved
/// by some millimetres.
inline std::vector<MappedTrace> trace_map(std::size_t count, std::uint64_t seed,
                                          const voussoir::Domain<2>& domain) {
  voussoir::Random random(seed, 7);
  std::vector<MappedTrace> traces;
  const Vec2 size = domain.size();
  const double typical = std::sqrt(size.x() * size.y() / static_cast<double>(count));
  int long_ones = 0;
  while (traces.size() < count) {
    const int set = static_cast<int>(3 * random.uniform());
    const double turn =
        std::array{0.2, 1.3, 2.4}[static_cast<std::size_t>(set)] + 0.1 * (random.uniform() - 0.5);
    const bool is_long = set == 0 && long_ones < 20 && random.uniform() < 0.5;
    long_ones += is_long;
    const double length = is_long ? 2 * size.x() : typical * (1.5 + 3 * random.uniform());
    const Vec2 middle = domain.low + Vec2(size.x() * random.uniform(), size.y() * random.uniform()),
               along(std::cos(turn), std::sin(turn));
    MappedTrace trace{{}, set};
    const int pieces = random.uniform() < 0.3 ? 2 + static_cast<int>(6 * random.uniform()) : 1;
    for (int k = 0; k <= pieces; ++k) {
      const double bend = pieces == 1 ? 0 : 0.02 * length * (random.uniform() - 0.5);
      trace.points.push_back(middle + length * (1.0 * k / pieces - 0.5) * along +
                             Vec2(-bend * along.y(), bend * along.x()));
    }
    // The far end on an earlier trace, up to 3 cm before or beyond it.
    if (!is_long && !traces.empty() && random.uniform() < 0.7) {
      const auto& other =
          traces[static_cast<std::size_t>(random.uniform() * static_cast<double>(traces.size()))];
      const Vec2 foot = other.points[0] + random.uniform() * (other.points[1] - other.points[0]);
      if ((foot - trace.points.front()).norm() < 6 * typical) {
        const Vec2 way = voussoir::normalized(Vec2(foot - trace.points.front()));
        trace.points = {trace.points.front(), foot + 0.06 * (random.uniform() - 0.5) * way};
      }
    }
    for (Vec2& p : trace.points) p = written(p);
    if ((trace.points.back() - trace.points.front()).norm() < 0.1) continue;
    traces.push_back(trace);
    if (random.uniform() < 0.1) {
      for (Vec2& p : trace.points) p = written(p + Vec2(0.004 * random.uniform(), 0.003));
      traces.push_back(trace);
    }
  }
  return traces;
}

/// In another order.
inline std::vector<MappedTrace> shuffled(std::vector<MappedTrace> traces, std::uint64_t seed) {
  voussoir::Random(seed, 1).shuffle(traces);
  return traces;
}

/// Every other trace drawn from its other end.
inline std::vector<MappedTrace> turned(std::vector<MappedTrace> traces) {
  for (std::size_t k = 0; k < traces.size(); k += 2)
    std::reverse(traces[k].points.begin(), traces[k].points.end());
  return traces;
}

/// Every third trace in pieces that touch: at its points, and in the middle between two of them.
inline std::vector<MappedTrace> in_pieces(const std::vector<MappedTrace>& traces) {
  std::vector<MappedTrace> split;
  for (std::size_t k = 0; k < traces.size(); ++k) {
    const auto& [points, set] = traces[k];
    if (k % 3 != 0) {
      split.push_back(traces[k]);
      continue;
    }
    const Vec2 middle = written(0.4 * points[0] + 0.6 * points[1]);
    split.push_back({{points[0], middle}, set});
    MappedTrace rest{{middle}, set};
    rest.points.insert(rest.points.end(), points.begin() + 1, points.end());
    split.push_back(std::move(rest));
  }
  return split;
}

/// A table `id,x,y,set`, on a site grid.
inline std::string table_of(const std::vector<MappedTrace>& traces, const Vec2& site_origin) {
  std::string text = "id,x,y,set\n";
  char line[128];
  for (std::size_t k = 0; k < traces.size(); ++k)
    for (const Vec2& p : traces[k].points) {
      std::snprintf(line, sizeof line, "%zu,%.4f,%.4f,%d\n", k + 1, p.x() + site_origin.x(),
                    p.y() + site_origin.y(), traces[k].set);
      text += line;
    }
  return text;
}

}  // namespace voussoir_test
