// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>
#include <voussoir/statistics/bounded_distribution.hpp>

/// Values of the input that are not known, as distributions in their place:
///
///   friction = {mean = "35 deg", sd = "3 deg", min = "25 deg", max = "45 deg"}
///
/// The document puts the median in their place, so that no reader of a key needs to know of them.
namespace voussoir::program {

/// A key of the input and the distribution of its value.
struct UncertainKey {
  std::string key;                   ///< "joint_set[0].dip"
  std::string unit;                  ///< as written, "deg"; empty: a bare number
  std::string written;               ///< in words: "normal, mean 35 deg, sd 3 deg"
  BoundedDistribution distribution;  ///< of the number in front of the unit

  /// With seven digits, and never outside of the distribution: the same on machines whose functions
  /// differ in the last digits.
  /// @param probability  of smaller values, 0 to 1
  [[nodiscard]] double value_at(double probability) const;
  /// "34.9212 deg", as the input file has it.
  [[nodiscard]] std::string text_at(double probability) const;
  /// The text of a value in the unit of the key.
  [[nodiscard]] std::string text_of(double value) const;

  /// Of the parts of a distribution: mean, sd, min, max, mode, distribution.
  [[nodiscard]] static const std::vector<std::string>& names();
};

}  // namespace voussoir::program
