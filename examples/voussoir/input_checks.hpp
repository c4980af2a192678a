// SPDX-License-Identifier: MIT
#pragma once

#include "input.hpp"
#include "input_section.hpp"

/// What two or more keys of an input must agree on.
namespace voussoir::program {

constexpr Range thickness_range{.low = 1e-3, .high = 10};  // of a lining [m]

/// Looks only at keys that were read without fault. Puts the angles of a lined part in the place of
/// its word, and one stage where the file has none.
void check_together(Checker& checker, Input& input);

}  // namespace voussoir::program
