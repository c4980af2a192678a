// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>

namespace voussoir {

/// A Latin hypercube that grows: points of the unit cube of which the first n are the same however
/// many follow, and any of them is had without the others.
///
/// In every variable the first 5, 10, 50, 100, 500, 1000, ... points lie one in each of as many
/// equal parts of 0 to 1, and so do the next as many, and the next. Between two of these numbers
/// the design is as even as their common parts let it be: 30 points lie three in each tenth.
/// Variables are independent of each other, and of how many there are.
///
/// The point k = d_1 + 5 (d_2 + 2 (d_3 + 5 (d_4 + ...))) lies in the part s_1 of 5, of that in the
/// part s_2 of 2, of that in s_3 of 5, ...: each s_j is d_j after a random permutation that hangs
/// on the variable, on the parts s_1 to s_(j-1) and on the digits behind d_j. For given digits
/// behind, d_1 to d_j thereby go to all parts, each to one.
///
/// Source: the idea of Qian (2009), Nested Latin hypercube designs, Biometrika 96, and Qian (2012),
/// Sliced Latin hypercube designs, J. Am. Stat. Assoc. 107, with the digits of a (0,1)-sequence.
class GrowingLatinHypercube {
 public:
  static constexpr std::uint64_t most_points = 1000000;

  /// @param seed  another one, another design
  explicit GrowingLatinHypercube(std::uint64_t seed) : seed_(seed) {}

  /// @param point     from 0
  /// @param variable  any number that tells it from the others
  /// @return  above 0 and below 1
  /// @throws InvalidInput  point >= `most_points`
  [[nodiscard]] double at(std::uint64_t point, std::uint64_t variable) const {
    require(point < most_points, "point of a Latin hypercube", static_cast<double>(point),
            "below 1 000 000");
    std::uint64_t part = 0, parts = 1, behind = point;
    for (std::uint32_t level = 0; parts < most_points; ++level) {
      const std::uint32_t base = level % 2 == 0 ? 5 : 2;
      const auto digit = static_cast<std::uint32_t>(behind % base);
      behind /= base;
      part = base * part + permuted(digit, base, variable, level, part, behind);
      parts *= base;
    }
    return (static_cast<double>(part) + fraction(variable, inside, point)) /
           static_cast<double>(parts);
  }

  /// Plain Monte Carlo under the same seed, to compare with: uniform, every point independent.
  [[nodiscard]] double independent(std::uint64_t point, std::uint64_t variable) const {
    return fraction(variable, apart, point);
  }

 private:
  static constexpr std::uint32_t inside = 30, apart = 31;  // besides the 12 levels

  [[nodiscard]] std::array<std::uint32_t, 4> numbers(std::uint64_t variable, std::uint32_t level,
                                                     std::uint64_t part,
                                                     std::uint64_t behind) const {
    // part < 10^6 < 2^20 and behind < 10^6: all of it has room in the counter.
    return Random::philox(
        {static_cast<std::uint32_t>(variable), static_cast<std::uint32_t>(variable >> 32),
         (level << 24) | static_cast<std::uint32_t>(part), static_cast<std::uint32_t>(behind)},
        {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)});
  }
  /// The digit after a random permutation of 0 to base - 1 (Fisher-Yates).
  [[nodiscard]] std::uint32_t permuted(std::uint32_t digit, std::uint32_t base,
                                       std::uint64_t variable, std::uint32_t level,
                                       std::uint64_t part, std::uint64_t behind) const {
    const auto random = numbers(variable, level, part, behind);
    std::array<std::uint32_t, 5> places{0, 1, 2, 3, 4};
    for (std::uint32_t left = base, k = 0; left > 1; --left, ++k) {
      // A number of 32 bits for each of at most four choices: none is likelier by more than 2^-30.
      const auto chosen = static_cast<std::size_t>((std::uint64_t{random[k]} * left) >> 32);
      std::swap(places[left - 1], places[chosen]);
    }
    return places[digit];
  }
  /// Of 24 bits, which no division by 10^6 rounds up to 1.
  [[nodiscard]] double fraction(std::uint64_t variable, std::uint32_t use,
                                std::uint64_t point) const {
    return (static_cast<double>(numbers(variable, use, 0, point)[0] >> 8) + 0.5) * 0x1p-24;
  }

  std::uint64_t seed_;
};

}  // namespace voussoir
