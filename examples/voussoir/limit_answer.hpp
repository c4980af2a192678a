// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <voussoir/design/limit_load.hpp>

#include "analysis.hpp"

/// The bound by limit analysis beside a factor of safety.
namespace voussoir::program {

/// What limit analysis says of rock that stands.
struct LimitAnswer {
  std::optional<LimitBound> bound;  ///< none: see `reason`
  /// With sides that push as in situ, where they can do more than that; else none.
  std::optional<LimitBound> in_situ_sides;
  std::string reason = "not asked for";  ///< why there is no bound
  double moving = 0;                     ///< of the mechanism [m^2], in 3-D [m^3]
  const char* unit = "m2";               ///< of that
  double seconds = 0;
};

/// @param stands  under some factor
/// @param laws    undivided
/// @param first   factor that is tried first
/// @return  a reason instead of a bound: it has supports, a joint law has no strength that a bound
///          could take, or the programmes came to no end
/// @throws Stopped
[[nodiscard]] LimitAnswer limit_of(const Tunnel& stands, const LawsBySet<AnyJoint>& laws,
                                   double first, const Report& report);
/// In 3-D.
[[nodiscard]] LimitAnswer limit_of(const SpatialTunnel& stands, const LawsBySet<AnyJoint>& laws,
                                   double first, const Report& report);

/// Lines for a terminal.
/// @param stands  the largest factor that does
[[nodiscard]] std::string limit_text(const LimitAnswer& answer, double stands);
[[nodiscard]] nlohmann::ordered_json limit_json(const LimitAnswer& answer);

}  // namespace voussoir::program
