// SPDX-License-Identifier: MIT
#include "design_criteria.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <voussoir/core/units.hpp>
#include <voussoir/design/bolt_strength.hpp>
#include <voussoir/drawing/number_text.hpp>

namespace voussoir::program {

double ranked(const TunnelResult& result, double value) {
  const bool stands = result.verdict == Verdict::stable;
  return stands && std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
}

bool has_bolt_strength(const Input& input) {
  return std::any_of(input.bolts.begin(), input.bolts.end(), is_checked);
}

bool has_lining_strength(const Input& input) {
  return std::any_of(input.linings.begin(), input.linings.end(),
                     [](const LiningInput& lining) { return lining.concrete.has_value(); });
}

std::vector<DesignLimit> limits_of(const Input& input) {
  const CriteriaInput& criteria = input.criteria;
  std::vector<DesignLimit> limits{
      {"rockfall",
       [](const TunnelResult& r) { return r.verdict == Verdict::collapse || r.fallen > 0; }},
      {"collapse", [](const TunnelResult& r) { return r.verdict == Verdict::collapse; }}};
  const auto add = [&](const std::string& what, double most,
                       const std::function<double(const TunnelResult&)>& value) {
    limits.push_back({what, [=](const TunnelResult& r) { return value(r) > most; },
                      [=](const TunnelResult& r) { return value(r) / most; }});
  };
  if (const auto most = criteria.convergence)
    add("crown convergence above " + format_quantity(*most, dimension::length), *most,
        [](const TunnelResult& r) { return ranked(r, r.convergence.crown); });
  // Supports that a place of a diagram leaves out carry nothing.
  const auto carried = [](const TunnelResult& r, double utilisation) {
    return r.verdict == Verdict::stable && std::isnan(utilisation) ? 0 : ranked(r, utilisation);
  };
  if (has_bolt_strength(input)) {
    const double most = criteria.bolt_utilisation.value_or(1);
    add("bolt utilisation above " + trimmed_text(most, 3), most,
        [=](const TunnelResult& r) { return carried(r, r.of_bolt_strength); });
  }
  if (has_lining_strength(input)) {
    const double most = criteria.utilisation.value_or(1);
    add("lining utilisation above " + trimmed_text(most, 3), most,
        [=](const TunnelResult& r) { return carried(r, r.of_lining_strength); });
  }
  return limits;
}

}  // namespace voussoir::program
