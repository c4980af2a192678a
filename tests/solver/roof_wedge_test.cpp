// SPDX-License-Identifier: MIT
// A symmetric wedge in the roof under horizontal stress, against Crawford and Bray (1983): it drops
// on its springs until both faces slip, and then for good.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <type_traits>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>

#include "support/reference.hpp"
#include "support/roof_blocks.hpp"

namespace roof_wedge_test {

using namespace voussoir;
using namespace voussoir_test;

TEST_SUITE("solver/roof_wedge") {
  TEST_CASE_TEMPLATE_DEFINE("it drops elastically up to the slip load, and falls beyond it", Method,
                            drops) {
    for (const RoofWedge& c : {RoofWedge{"F.wedge.20.35.0.1", 20, 35, 5e9, 5e8, 1e6},
                               RoofWedge{"F.wedge.15.30.0.1", 15, 30, 5e9, 5e8, 1e6},
                               RoofWedge{"F.wedge.30.40.0.1", 30, 40, 1e10, 1e9, 5e5},
                               RoofWedge{"F.wedge.20.35.1", 20, 35, 5e9, 5e9, 1e6}}) {
      CAPTURE(c.row);
      SearchContext close;
      close.acceptance.unbalance_over_weight = 1e-5;
      const double load = reference(std::string(c.row) + ".P");
      auto before = roof_wedge(c, 0.999 * load);
      const EquilibriumReport stays = Method{}.find(before, close);
      CHECK(stays.verdict == Verdict::stable);
      CHECK(stays.fallen.empty());
      // Linear up to slip; the weight is carried to 1e-9 by one elastic solve. Steps end where the
      // balance does.
      const double drop = 0.999 * reference(std::string(c.row) + ".u");
      CHECK(std::abs(-before.displacement[7] - drop) <=
            (std::is_same_v<Method, Explicit> ? 1e-3 : 1e-9) * drop);
      auto after = roof_wedge(c, 1.001 * load);
      CHECK(Method{}.find(after, close).fallen == std::vector<int>{2});
    }
  }
  TEST_CASE_TEMPLATE_APPLY(drops, std::tuple<TwoLevel, Relaxation, Explicit>);
}

}  // namespace roof_wedge_test
