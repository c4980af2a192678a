// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/repeatable.hpp>

namespace voussoir {

/// How the distances between neighbouring joints of a set that go right through vary about their
/// mean: not at all; as those of joints that lie independently of each other; or as surveys fit
/// them most often besides.
///
/// Source: Priest & Hudson (1976), Int. J. Rock Mech. Min. Sci. 13, 135-148, for the negative
/// exponential.
enum class SpacingLaw { fixed, exponential, lognormal };

namespace detail {

/// Checks what a set says of its spacing.
/// @param deviation  standard deviation over the mean, of the lognormal law alone [-], > 0, <= 3
/// @throws InvalidInput
VOUSSOIR_INLINE void check_spacing_law(SpacingLaw law, double deviation, bool is_persistent,
                                       const std::string& set);

/// Where the joints of a set cross a line, from -reach to reach [m]. Every stretch of the line has
/// as many in the mean, those next to its ends included.
///
/// The first joint of a fixed spacing is uniform over one spacing. That of the others is where a
/// process without beginning has it: a place falls into a spacing with a probability in proportion
/// to its length, and a lognormal law weighted by the length is one of the same shape.
/// @param mean  spacing [m], > 0
[[nodiscard]] VOUSSOIR_INLINE std::vector<double> joint_places(SpacingLaw law, double mean,
                                                               double deviation, double reach,
                                                               Random& random);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void check_spacing_law(SpacingLaw law, double deviation, bool is_persistent,
                                       const std::string& set) {
  const auto refuse = [&](const char* accepted) {
    throw InvalidInput(message({set, "spacing_deviation = ", deviation, ": must be ", accepted}));
  };
  if (law == SpacingLaw::lognormal && !(deviation > 0 && deviation <= 3)) refuse("> 0 and <= 3");
  if (law != SpacingLaw::lognormal && deviation != 0) refuse("0, but for a lognormal spacing");
  if (law != SpacingLaw::fixed && !is_persistent)
    throw InvalidInput(
        set +
        "a spacing law is of joints that go right through, by their spacing: those "
        "with an end, and those by area per volume, lie independently of each other");
}

VOUSSOIR_INLINE std::vector<double> joint_places(SpacingLaw law, double mean, double deviation,
                                                 double reach, Random& random) {
  using repeatable::product;
  std::vector<double> places;
  if (law == SpacingLaw::fixed) {
    const double first = -reach + product(random.uniform(), mean);
    const auto count = static_cast<int>(std::floor((reach - first) / mean)) + 1;
    for (int k = 0; k < count; ++k) places.push_back(first + product(k, mean));
    return places;
  }
  const bool is_exponential = law == SpacingLaw::exponential;
  const double square = repeatable::log1p(product(deviation, deviation)),  // variance of ln
      spread = std::sqrt(square), lowered = -0.5 * square;
  const auto spacing = [&](double raised) {
    if (is_exponential) return product(-mean, repeatable::log1p(-random.uniform()));
    return product(mean, 1 + repeatable::expm1(raised + product(spread, random.normal())));
  };
  double place = -reach;
  place += is_exponential ? spacing(0) : product(random.uniform(), spacing(lowered + square));
  for (; place <= reach; place += spacing(lowered)) places.push_back(place);
  return places;
}

#endif

}  // namespace detail

}  // namespace voussoir
