// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/joint_sets.hpp>
#include <voussoir/rockmass/orientation.hpp>

namespace voussoir::design {

/// Of joints and of blocks: minutes and gigabytes beyond.
inline constexpr double largest_count = 1e6;

/// What the joint sets will come to, before anything is generated.
struct SizeEstimate {
  double joints = 0;  ///< traces to be drawn
  double blocks = 0;
};

/// @return  joints = sum of intensity x area; blocks from the crossings of the sets, but no more
///          than the minimum inscribed radius lets there be (within a factor of two of generated
///          masses). Mapped traces are counted when the rock is made, with the same limits.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE SizeEstimate estimate_size(const AnalysisInput& input);

#if VOUSSOIR_DESIGN_BODIES

namespace detail {

/// In 3-D every crossing of three joints splits a block.
VOUSSOIR_DESIGN_INLINE SizeEstimate estimate_spatial_size(const AnalysisInput& input) {
  const double height = input.domain_top() - input.domain_bottom();
  const double volume = input.model.width * height * input.model.length;
  const double across = std::cbrt(volume);
  struct Set {
    double p32, area;  // 1/m; of a joint inside the domain, m^2
    Vec3 normal;
  };
  std::vector<Set> sets;
  for (const JointSetInput& set : input.joint_sets) {
    const double extent = std::min(mean_extent(set), across);
    sets.push_back({p32_of(set, input.tunnel),
                    extent * std::min(set.strike_extent.value_or(extent), across),
                    upward_normal(set.plane)});
  }
  SizeEstimate size{0, 1};
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const double joints = sets[i].p32 * volume / sets[i].area;
    size.joints += joints;
    size.blocks += joints;
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k)
        size.blocks += sets[i].p32 * sets[j].p32 * sets[k].p32 * volume *
                       std::abs(sets[i].normal.dot(cross(sets[j].normal, sets[k].normal)));
  }
  // Of cubes there would be 0.125 per cube of the inscribed radius.
  const double radius = input.blocks.min_inscribed_radius;
  size.blocks = std::min(size.blocks, 0.1 * volume / (radius * radius * radius));
  return size;
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE SizeEstimate estimate_size(const AnalysisInput& input) {
  const bool is_prismatic =
      std::all_of(input.joint_sets.begin(), input.joint_sets.end(),
                  [&](const JointSetInput& set) { return is_of_section(input, set); });
  if (input.is_spatial() && !is_prismatic) return detail::estimate_spatial_size(input);
  const double height = input.domain_top() - input.domain_bottom();
  const double area = input.model.width * height;
  struct Set {
    double intensity, frequency, angle;  // 1/m^2; length of trace per area, 1/m; rad
  };
  std::vector<Set> sets;
  for (const JointSetInput& set : input.joint_sets) {
    const auto shown = section_set(set, input.tunnel);
    if (!shown) continue;
    const double extent = std::min(shown->extent, std::max(input.model.width, height));
    const double frequency = shown->spacing > 0 ? 1 / shown->spacing : shown->intensity * extent;
    const double angle = shown->dip_direction == DipDirection::east ? -shown->dip : shown->dip;
    sets.push_back(
        {shown->intensity > 0 ? shown->intensity : frequency / extent, frequency, angle});
  }
  SizeEstimate size{0, 1};
  // Every trace splits a block, and so does every crossing of two traces.
  for (std::size_t i = 0; i < sets.size(); ++i) {
    size.joints += sets[i].intensity * area;
    size.blocks += sets[i].intensity * area;
    for (std::size_t j = 0; j < i; ++j)
      size.blocks += sets[i].frequency * sets[j].frequency * area *
                     std::abs(elementary::sine(sets[i].angle - sets[j].angle));
  }
  // Cutting stops when no child would hold the smallest circle. Random masses of three sets then
  // have 0.09 (short joints) to 0.13 (through-going ones) blocks per square of its radius.
  const double radius = input.blocks.min_inscribed_radius;
  size.blocks = std::min(size.blocks, 0.13 * area / (radius * radius));
  return size;
}

#endif

}  // namespace voussoir::design
