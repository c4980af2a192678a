// SPDX-License-Identifier: MIT
// Every contact detector and solution procedure, the default law, and what is no part of a tunnel.
#include "models/every_model.hpp"

namespace methods_long {

using namespace every_model;

TEST_SUITE("models/methods_long") {
  constexpr const char* no_method = "a run has time steps, no solution procedure";

  TEST_CASE("CoulombJoint") { in_all_settings<CoulombJoint>().print(); }

  TEST_CASE("TwoLevel") { at_rest_only<TwoLevel>(no_method).print(); }
  TEST_CASE("Relaxation") { at_rest_only<Relaxation>(no_method).print(); }
  TEST_CASE("AnyMethod") { at_rest_only<AnyMethod>(no_method).print(); }
  TEST_CASE("Explicit") { at_rest_only<Explicit>(no_method).print(); }

  TEST_CASE("CutContacts") { in_all_settings<CutContacts>().print(); }
  TEST_CASE("FaceContacts") { in_all_settings<FaceContacts>().print(); }
  TEST_CASE("AnalyticCentre") { in_all_settings<AnalyticCentre>().print(); }

  TEST_CASE(
      "SmoothWall is the edge of every domain above, and no joint: it has no shear stiffness") {
    CHECK(ContactLaw<SmoothWall, 2>);
    CHECK(ContactLaw<SmoothWall, 3>);
    CHECK(SmoothWall(5e9).joint_shear_stiffness() == 0);
    const char* const why = "the edge of the domain in every row";
    Row{"contact law", SmoothWall::name, why, why, why, why}.print();
  }
}

}  // namespace methods_long
