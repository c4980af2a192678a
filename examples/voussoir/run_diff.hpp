// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// What differs between two runs: `voussoir diff`.
namespace voussoir::program {

/// A line for every number and word of run.json that is in one of two runs alone or differs by more
/// than rounding, with both values and the change; times and identifiers are left out.
/// @param first, second  folders of results, or their run.json
/// @throws InvalidInput  one cannot be read, or is no run
[[nodiscard]] std::string run_diff(const std::string& first, const std::string& second);

}  // namespace voussoir::program
