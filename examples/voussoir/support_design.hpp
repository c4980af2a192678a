// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/design/cheapest_place.hpp>
#include <voussoir/design/support_costs.hpp>

#include "case_plan.hpp"
#include "case_statistics.hpp"

/// `voussoir design`: of the supports on the axes of a diagram the cheapest that complies with
/// [criteria] in the realisations of the rock.
namespace voussoir::program {

/// One criterion at one place of the grid.
struct CriterionAt {
  std::string what;  ///< what breaks it: "crown convergence above 20 mm"
  Share broken;      ///< in which realisations
  /// Of the realisation that is worst the value over its limit [-]; infinite where it has none
  /// left, not a number for what only happens or not.
  double worst = std::numeric_limits<double>::quiet_NaN();
};

/// Supports, and what is known of them.
struct SupportAt {
  SupportPlace place;
  SupportChoice supports;
  double cost = 0;  ///< [currency/m]
  bool is_computed = false, holds = false;
  int undecided = 0;  ///< realisations without a verdict, with which it does not hold
  std::vector<CriterionAt> criteria = {};
  Share broken = {};  ///< any of them

  /// Of the criteria with a value that which is nearest to its limit; null: there is none.
  [[nodiscard]] const CriterionAt* nearest() const;
};

struct SupportDesign {
  std::vector<SupportAt> all;   ///< spacing by spacing, thicknesses rising
  std::size_t thicknesses = 0;  ///< on the axis
  std::optional<SupportPlace> cheapest;
  std::vector<SupportPlace> surer;  ///< one step stronger than that, each way

  [[nodiscard]] SupportAt& at(const SupportPlace& place) {
    return all[place.spacing * thicknesses + place.thickness];
  }
  [[nodiscard]] const SupportAt& at(const SupportPlace& place) const {
    return all[place.spacing * thicknesses + place.thickness];
  }
  [[nodiscard]] const SupportAt& strongest() const {
    return all[thicknesses - 1];  // densest bolts under the thickest lining
  }
  [[nodiscard]] int computed() const;
};

/// Results of all realisations of a place, in their order.
using PlaceResults = std::function<std::vector<TunnelResult>(const SupportPlace&)>;

/// @param plan     a diagram's, of an input with [costs]
/// @param results  computes what is asked for
/// @param is_sure  criteria.probability is kept with 95 % confidence, not only by the share found
/// @throws InvalidInput  no costs, or no criterion
[[nodiscard]] SupportDesign cheapest_support(const CasePlan& plan, const PlaceResults& results,
                                             bool is_sure);

/// Lines for a terminal.
[[nodiscard]] std::string design_text(const CasePlan& plan, const SupportDesign& design);
[[nodiscard]] std::string design_json(const CasePlan& plan, const SupportDesign& design);
/// One row for every place.
[[nodiscard]] std::string design_csv(const CasePlan& plan, const SupportDesign& design);
/// Costs over spacing and thickness, what holds and what does not, the one recommended.
[[nodiscard]] std::string design_svg(const CasePlan& plan, const SupportDesign& design);

}  // namespace voussoir::program
