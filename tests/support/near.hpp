// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

namespace voussoir_test {

/// Equal to `value` to a relative error: `x == near(3e-4).epsilon(0.01)`; 1.2e-5 unless told.
///
/// doctest's own `Approx` adds 1 to the larger of the two, so that a displacement of 1e-5 m agrees
/// with any other: no test uses it (rules/tests). Only zero is near zero: elsewhere an absolute
/// bound is written, or `scale`.
[[nodiscard]] inline doctest::Approx near(double value) {
  constexpr double nothing = 1e-290;  // doctest asks for less than the tolerance, not for as much
  return doctest::Approx(value).scale(nothing);
}

}  // namespace voussoir_test
