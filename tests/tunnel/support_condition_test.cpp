// SPDX-License-Identifier: MIT
// What is said of supports asks a law for nothing that its concept does not name.
#include <doctest/doctest.h>

#include <string>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/tunnel/construction.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/opening.hpp>
#include <voussoir/tunnel/support_demand.hpp>

#include "support/jointed_rock.hpp"

namespace support_condition_test {

using namespace voussoir;
using voussoir_test::degree;

namespace {

/// A bond that hides the one member which is no part of its concept.
struct OwnBond : MohrCoulombJoint {
  using MohrCoulombJoint::MohrCoulombJoint;
  static constexpr const char* name = "OwnBond";
  void params() const = delete;
};

constexpr MohrCoulombJoint::Params bond{.joint_normal_stiffness = 1e9,
                                        .joint_shear_stiffness = 1e9,
                                        .friction_angle = 30 * degree,
                                        .cohesion = 1e6,
                                        .tensile_strength = 5e5};

/// Of an arch without feet in rock that stands.
template <class Law>
std::vector<std::string> remarks(const Law& law) {
  using Tunnel = Solver<RockOnLining<Law>>;
  const auto opening = circular_opening(5, 36);
  Tunnel tunnel(voussoir_test::jointed_rock(domain_around(opening, 20, 7, 7), 1, {0.25, 5}),
                CoulombJoint({5e9, 5e8, 40 * degree}), {.density = 2700, .k0 = 1});
  Construction<Tunnel> plan;
  plan.add_stage("all", 0.0)
      .excavate(opening)
      .install_lining({LiningRing{.from = 0, .to = 180 * degree},
                       {LiningSection::rectangular(0.1, 25e9)},
                       law});
  const auto built = construct(tunnel, plan);
  CHECK(std::string(to_string(built.last())) == "stable");
  return remarks_on(support_condition(tunnel));
}

}  // namespace

TEST_SUITE("tunnel/support_condition") {
  TEST_CASE("an arch that is bonded to the rock stands on its bond, by whatever law") {
    CHECK(remarks(OwnBond(bond)).empty());
    CHECK(remarks(MohrCoulombJoint(bond)).empty());
    auto loose = bond;
    loose.cohesion = loose.tensile_strength = 0;
    loose.friction_angle = 65 * degree;  // or the arch slides off as a whole: from some 60 on
    const auto said = remarks(MohrCoulombJoint(loose));
    REQUIRE(said.size() == 1);
    CHECK(said[0].find("its ends stand on nothing") != std::string::npos);
    // The library knows no input file.
    CHECK(said[0].find("support.lining") == std::string::npos);
    CHECK(said[0].find("interface.") == std::string::npos);
  }

  TEST_CASE("a ring that a bench opens is said, with its cut ends") {
    const auto outline = [](double low, double high) {
      return SimplePolygon({{-3, low}, {3, low}, {3, high}, {-3, high}});
    };
    using Tunnel = Solver<>;
    Tunnel tunnel(
        voussoir_test::jointed_rock(domain_around(outline(-3, 3), 20, 7, 7), 1, {0.25, 5}),
        CoulombJoint({5e9, 5e8, 45 * degree}), {.density = 2700, .surcharge = 1e6});
    Construction<Tunnel> plan;
    plan.add_stage("heading", 0.5).excavate(outline(0, 3));
    plan.add_stage("ring", 0.3)
        .install_lining({LiningRing{.nodes = 36},
                         {LiningSection::rectangular(0.1, 25e9)},
                         CoulombJoint({1e9, 1e9, 45 * degree})});
    plan.add_stage("bench", 0.2).excavate(outline(-3, 0));
    const auto built = construct(tunnel, plan);
    CHECK(std::string(to_string(built.last())) == "stable");
    REQUIRE(tunnel.opened_linings().size() == 1);
    const auto said = remarks_on(support_condition(tunnel));
    bool is_said = false;
    for (const std::string& text : said) {
      CAPTURE(text);
      CHECK(text.find("was lost") == std::string::npos);
      is_said = is_said || text.find("lining 1 is opened where a later round meets it: ") == 0;
    }
    CHECK(is_said);
  }

  TEST_CASE("a bond is told by what it holds") {
    CHECK(holds_shear<2>(MohrCoulombJoint(bond)));
    CHECK(holds_shear<3>(MohrCoulombJoint(bond)));
    CHECK_FALSE(holds_shear<2>(CoulombJoint({5e9, 5e8, 40 * degree})));
    CHECK_FALSE(holds_shear<3>(CoulombJoint({5e9, 5e8, 40 * degree})));
  }
}

}  // namespace support_condition_test
