// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/repeatable.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/joint.hpp>
#include <voussoir/rockmass/spacing_law.hpp>

namespace voussoir {

/// The direction in which a joint dips, in the plane of the section.
enum class DipDirection { east, west };  ///< east: down to the right; west: down to the left

/// A family of joints of similar orientation, as borehole and scanline surveys describe it.
struct JointSet {
  std::string name;
  double dip;  ///< from the horizontal [rad], 0 to pi/2
  DipDirection dip_direction = DipDirection::east;
  double dip_deviation = 0;  ///< standard deviation of the dip, normal [rad], 0 to pi/4
  /// Joint centres per area [1/m^2], of joints with an extent; 0: use `spacing`.
  double intensity = 0;
  double spacing = 0;  ///< normal spacing [m]; 0: use `intensity`
  double extent = std::numeric_limits<double>::infinity();  ///< full length of a trace [m], > 0
  SpacingLaw spacing_law = SpacingLaw::fixed;  ///< of joints without end, by their spacing
  double spacing_deviation =
      0;  ///< lognormal: standard deviation of the spacing over `spacing` [-]

  /// @throws InvalidInput  a value out of range, not exactly one of intensity and spacing, or an
  ///                       intensity of endless joints
  void check() const {
    const std::string of = message({"joint set ", name, ": "});
    constexpr double pi = std::numbers::pi;
    if (dip > 0.5 * pi && dip <= pi)
      throw InvalidInput(
          message({of, "dip = ", dip, " rad (", dip * 180 / pi,
                   " deg): must be 0 to 1.5708 rad (0 to 90 deg); the same joint dips ",
                   (pi - dip) * 180 / pi, " deg to the other side"}));
    require_angle(message({of, "dip"}), dip, 0, 0.5 * pi);
    require_angle(message({of, "dip_deviation"}), dip_deviation, 0, 0.25 * pi);
    const bool is_one = (intensity > 0) != (spacing > 0);
    if (!is_one || !std::isfinite(intensity) || !std::isfinite(spacing))
      throw InvalidInput(
          message({of, "intensity = ", intensity, " /m^2 and spacing = ", spacing,
                   " m: ", is_one ? "must be finite" : "one of the two must be > 0, the other 0"}));
    if (!(extent > 0)) throw InvalidInput(message({of, "extent = ", extent, " m: must be > 0"}));
    detail::check_spacing_law(spacing_law, spacing_deviation, spacing > 0 && std::isinf(extent),
                              of);
    // Of endless joints more reach into a large domain than into a small one.
    if (intensity > 0 && std::isinf(extent))
      throw InvalidInput(message({of, "intensity = ", intensity,
                                  " /m^2 counts centres per area, and how far apart endless joints "
                                  "lie would hang on the size of the domain: give them an extent, "
                                  "or a spacing in place of the intensity"}));
  }
};

namespace detail {

/// Unit vector down the dip.
[[nodiscard]] inline Vec2 dip_vector(double dip, DipDirection direction) {
  const auto [fall, level] = repeatable::sine_cosine(dip);
  return {direction == DipDirection::east ? level : -level, -fall};
}

/// The joints of all sets in one random order.
template <class Set, int Dim>
[[nodiscard]] std::vector<JointOf<Dim>> shuffled_joints(const std::vector<Set>& sets,
                                                        const Domain<Dim>& domain,
                                                        std::uint64_t seed,
                                                        const Progress& progress) {
  domain.check();
  std::vector<JointOf<Dim>> all;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    for (auto& joint : generate(sets[k], static_cast<int>(k), domain, seed, progress))
      all.push_back(std::move(joint));
  }
  Random(seed, 0).shuffle(all);
  return all;
}

}  // namespace detail

/// Joints of one set inside the domain.
///
/// With an intensity (or a spacing and a finite extent, which amounts to 1/(spacing * extent)
/// centres per area) centres are uniform over the domain and their number is the expected one,
/// rounded. With a spacing and no end the joints are as far apart as `spacing_law` says.
[[nodiscard]] VOUSSOIR_INLINE std::vector<Joint> generate(const JointSet& set, int index,
                                                          const Domain<2>& domain,
                                                          std::uint64_t seed,
                                                          const Progress& progress = {});

/// The joints of all sets in one random order. Slicing set by set would be wrong: the first set
/// would use up the block sizes that the minimum allows.
///
/// The joints of a seed are the same to the last bit whatever compiler and flags (see
/// repeatable.hpp).
/// @param progress  asked now and then whether to go on
/// @throws InvalidInput, Stopped
[[nodiscard]] inline std::vector<Joint> joint_network(const std::vector<JointSet>& sets,
                                                      const Domain<2>& domain, std::uint64_t seed,
                                                      const Progress& progress = {}) {
  return detail::shuffled_joints(sets, domain, seed, progress);
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<Joint> generate(const JointSet& set, int index, const Domain<2>& domain,
                                            std::uint64_t seed, const Progress& progress) {
  using repeatable::along, repeatable::product;
  set.check();
  StopCheck stop(progress);
  Random random(seed, static_cast<std::uint64_t>(index) + 1);
  const double half = 0.5 * std::fmin(set.extent, 2.1 * domain.diameter());
  VOUSSOIR_ASSERT(half > 0 && std::isfinite(half), "a trace has a length");
  std::vector<Joint> joints;
  const auto add = [&](const Vec2& centre) {
    stop();
    const double dip = set.dip + product(set.dip_deviation, random.normal());
    const Vec2 down = detail::dip_vector(dip, set.dip_direction);
    joints.push_back({{along<2>(centre, -half, down), along<2>(centre, half, down)}, index});
  };
  if (set.spacing > 0 && std::isinf(set.extent)) {
    const Vec2 centre = 0.5 * (domain.low + domain.high);
    const Vec2 normal = perpendicular(detail::dip_vector(set.dip, set.dip_direction));
    const double reach = 0.5 * domain.diameter();
    for (const double place :
         detail::joint_places(set.spacing_law, set.spacing, set.spacing_deviation, reach, random))
      add(along<2>(centre, place, normal));
    return joints;
  }
  const double intensity = set.intensity > 0 ? set.intensity : 1.0 / (set.spacing * set.extent);
  const auto count = static_cast<std::size_t>(std::llround(intensity * domain.measure()));
  joints.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double x = random.uniform(), y = random.uniform();
    add(domain.low + Vec2(product(domain.size().x(), x), product(domain.size().y(), y)));
  }
  return joints;
}

#endif

}  // namespace voussoir
