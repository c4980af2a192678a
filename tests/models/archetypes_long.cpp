// SPDX-License-Identifier: MIT
// The archetypes of all roles together, in a tunnel that is bolted and lined: in 2-D and 3-D, at
// rest and in motion, with tables and pictures. What code asks of a policy beyond its concept does
// not compile here.
#include <string>
#include <voussoir/io/solved_picture.hpp>

#include "models/archetypes.hpp"
#include "models/every_model.hpp"

namespace every_model {

template <>
inline archetypes::LeastJoint law() {
  return {5e9, 5e8, std::tan(35 * degree)};
}
template <>
inline archetypes::FullJoint law() {
  return archetypes::FullJoint(law<CoulombJoint>());
}
template <>
inline archetypes::FullBond interface_law() {
  return archetypes::FullBond(interface_law<MohrCoulombJoint>());
}
template <>
inline archetypes::LeastBolt law() {
  return {2e8, 1.5e4};
}
template <>
inline archetypes::FullBolt law() {
  return archetypes::FullBolt(law<AxialShearBolt>());
}

}  // namespace every_model

namespace archetypes_long {

using namespace every_model;
using namespace archetypes;

namespace {

/// In stages, with all that is said of it; then loaded in steps and, if its joints creep, in time.
template <class Geometry, class... Policies>
void construct_in_stages() {
  using Tunnel = Solver<Geometry, Policies...>;
  CAPTURE(Tunnel::composition());
  using Parts = typename Tunnel::Parts;
  Tunnel tunnel(rock<Geometry>(), law<typename Parts::JointLaw>(), in_situ);
  Construction<Tunnel> plan;
  plan.add_stage("excavation", 0.5).excavate(opening<Geometry>(), smallest_piece);
  typename LiningInstallation<Tunnel>::Layout layout;
  if constexpr (Geometry::dim == 2)
    layout = {.nodes = 24};
  else
    layout = {.ring = {.nodes = 24}, .spacing = 1};
  plan.add_stage("support")
      .install_bolts({bars(opening<Geometry>()), law<typename Parts::BoltLaw>()})
      .install_lining(
          {layout, sections<Geometry>(), interface_law<typename Parts::Models::InterfaceLaw>()});
  const auto built = construct(tunnel, plan);
  CHECK(built.last().verdict == Verdict::stable);
  const SupportDemand demand = support_demand(tunnel);
  CHECK(demand.largest_bolt_force > 10);
  CHECK(demand.largest_thrust > 10);
  for (const std::string& remark : remarks_on(support_condition(tunnel))) CHECK(remark != "");
  CHECK(diagram_point_of(tunnel, built).largest_thrust == demand.largest_thrust);
  CHECK(xml_fault(draw_tunnel(tunnel, built)) == "");
  tunnel.add_body_force(-1e-4 * Vec<Geometry::dim>::UnitX());
  CHECK(load_in_steps(tunnel, {}, 1).back().verdict == Verdict::stable);
  if constexpr (CreepingLaw<typename Parts::JointLaw, Geometry::dim>)
    CHECK(creep(tunnel, 1e5, [](const CreepState&) { return true; }).back().time == 1e5);
}

}  // namespace

TEST_SUITE("models/archetypes_long") {
  TEST_CASE("the least that satisfies each concept") {
    in_all_settings<LeastJoint, LeastInterface, LeastBolt, LeastAnchors, LeastBeam, LeastDetector,
                    LeastMethod>()
        .print();
  }
  TEST_CASE("everything optional, too") {
    in_all_settings<FullJoint, FullInterface, FullBolt, FullAnchors, FullBars, FullDetector,
                    FullMethod>()
        .print();
  }
  TEST_CASE("in stages, and what is said of it") {
    construct_in_stages<Planar, LeastJoint, LeastInterface, LeastBolt, LeastAnchors, LeastBeam,
                        LeastDetector, LeastMethod>();
    construct_in_stages<Spatial, LeastJoint, LeastInterface, LeastBolt, LeastAnchors, LeastBeam,
                        LeastDetector, LeastMethod>();
    construct_in_stages<Planar, FullJoint, FullInterface, FullBolt, FullAnchors, FullBars,
                        FullDetector, FullMethod>();
    construct_in_stages<Spatial, FullJoint, FullInterface, FullBolt, FullAnchors, FullBars,
                        FullDetector, FullMethod>();
  }
  TEST_CASE("they are sound laws: what the compiler cannot check of them holds") {
    for (const auto& faults :
         {check_law(law<LeastJoint>()), check_law<3>(law<LeastJoint>()),
          check_law(law<FullJoint>()), check_law<3>(law<FullJoint>()),
          check_law(interface_law<FullBond>()), check_law<3>(interface_law<FullBond>()),
          check_law(law<LeastBolt>()), check_law<3>(law<LeastBolt>()), check_law(law<FullBolt>()),
          check_law<3>(law<FullBolt>())})
      for (const std::string& fault : faults) FAIL_CHECK(fault);
  }
}

}  // namespace archetypes_long
