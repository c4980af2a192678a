// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>
#include <voussoir/design/analysis.hpp>

#include "input.hpp"

/// What a design has to comply with: [criteria], and what nobody wants.
namespace voussoir::program {

/// Something about a tunnel that is decided, and the limit it should keep.
struct DesignLimit {
  std::string what;  ///< what breaks it: "rockfall", "crown convergence above 20 mm"
  std::function<bool(const TunnelResult&)> is_exceeded;
  /// The value over its limit [-], infinite where a tunnel has none left; empty: it happens or not.
  std::function<double(const TunnelResult&)> ratio = {};
};

/// That rock falls, that the tunnel collapses, the convergence where it is limited, and supports
/// whose strength is given: to what [criteria] allow of it, else to their strength.
[[nodiscard]] std::vector<DesignLimit> limits_of(const Input& input);

/// Of a tunnel that is decided: its value, or worse than any where it has none.
[[nodiscard]] double ranked(const TunnelResult& result, double value);

[[nodiscard]] bool has_bolt_strength(const Input& input);
[[nodiscard]] bool has_lining_strength(const Input& input);

}  // namespace voussoir::program
