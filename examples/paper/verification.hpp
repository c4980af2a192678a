// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "study.hpp"

namespace voussoir::paper {

/// A value of ours beside one that came from somewhere else.
struct Check {
  enum class Kind {
    closed_form,  ///< a formula of theory/ against finite elements, quadrature or algebra
    solver,       ///< blocks, joints, bolts and linings against a closed form
    solution      ///< the same tunnel found in another way
  };
  Kind kind;
  std::string what;
  double value, reference;
  double limit;        ///< of the deviation [-]
  std::string reason;  ///< where the limit comes from

  /// |value / reference - 1|; |value| where the reference is 0; NaN stays NaN.
  [[nodiscard]] double deviation() const;
  [[nodiscard]] bool passes() const { return deviation() <= limit; }
};

/// Everything that is checked, in order; a minute or less.
/// @throws Study::Stopped  if the progress of the study says so
[[nodiscard]] std::vector<Check> verification(Study& study);

/// A table for the terminal: value, reference, deviation, limit, PASS or FAIL.
[[nodiscard]] std::string verification_text(const std::vector<Check>& checks);

}  // namespace voussoir::paper
