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
/// In every variable the first 10, 50, 100, 500, 1000, ... points lie one in each of as many equal
/// parts of 0 to 1, and so do the next as many, and the next. Between two of these numbers the
/// design is as even as their common parts let it be: 30 points lie three in each tenth. Variables
/// are independent of each other, and of how many there are.
///
/// The point k = d_1 + 10 (d_2 + 5 (d_3 + 2 (d_4 + ...))) lies in the part s_1 of 10, of that in
/// the part s_2 of 5, of that in s_3 of 2, ...: each s_j is d_j after a random permutation that
/// hangs on the variable, on the parts s_1 to s_(j-1) and on the digits behind d_j. For given
/// digits behind, d_1 to d_j thereby go to all parts, each to one.
///
/// The mean of a function that is a sum of functions of one variable each is surer than from
/// independent points by far; of what two variables do only jointly it is less sure, by 10/9 in
/// variance at most: ten points that share no tenth are not quite independent. (With a first part
/// of 5 or 2 it would be 5/4 or 2.)
///
/// Source: the idea of Qian (2009), Nested Latin hypercube designs, Biometrika 96, and Qian (2012),
/// Sliced Latin hypercube designs, J. Am. Stat. Assoc. 107, with the digits of a (0,1)-sequence;
/// McKay, Beckman & Conover (1979), Technometrics 21, and Stein (1987), Technometrics 29, for what
/// it is good for.
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
      const std::uint32_t base = level == 0 ? 10 : level % 2 == 1 ? 5 : 2;
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
  static constexpr std::uint32_t inside = 30, apart = 31;  // besides the 11 levels

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
    // 64 bits choose one of at most 10! = 3 628 800 permutations: none is likelier by 1e-12.
    std::uint64_t choice = random[0] | (std::uint64_t{random[1]} << 32);
    std::array<std::uint32_t, 10> places{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    for (std::uint32_t left = base; left > 1; --left) {
      std::swap(places[left - 1], places[static_cast<std::size_t>(choice % left)]);
      choice /= left;
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
