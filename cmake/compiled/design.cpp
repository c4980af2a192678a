// SPDX-License-Identifier: MIT
// One of the sources of voussoir::design: its functions that are no templates.
#define VOUSSOIR_DESIGN_SOURCE
#include <voussoir/design/analysis.hpp>
#include <voussoir/design/bolt_strength.hpp>
#include <voussoir/design/factor_of_safety.hpp>
#include <voussoir/design/limit_problem.hpp>
#include <voussoir/design/lining_utilisation.hpp>
#include <voussoir/design/size_estimate.hpp>
#include <voussoir/design/support_costs.hpp>
