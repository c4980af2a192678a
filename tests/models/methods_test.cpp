// SPDX-License-Identifier: MIT
// Every contact detector and solution procedure, the default law, and what is no part of a tunnel.
#include "models/every_model.hpp"

namespace methods_test {

using namespace every_model;

TEST_SUITE("models/methods") {
  constexpr const char* no_method = "a run has time steps, no solution procedure";
  constexpr const char* own_search = "a run finds its contacts by FaceContacts";

  TEST_CASE("CoulombJoint") { in_all_settings<CoulombJoint>().print(); }

  TEST_CASE("TwoLevel") { at_rest_only<TwoLevel>(no_method).print(); }
  TEST_CASE("Relaxation") { at_rest_only<Relaxation>(no_method).print(); }
  TEST_CASE("Explicit") { at_rest_only<Explicit>(no_method).print(); }

  TEST_CASE("CutContacts") { at_rest_only<CutContacts>(own_search).print(); }
  TEST_CASE("FaceContacts") { at_rest_only<FaceContacts>(own_search).print(); }

  /// Rows of themselves as soon as they fill the role; until then the reason stands in the table.
  template <class Detector>
  Row row_of_detector() {
    if constexpr (ContactDetector<Detector, RockMass<Planar>, Planar> &&
                  ContactDetector<Detector, RockMass<Spatial>, Spatial>) {
      return at_rest_only<Detector>(own_search);
    } else {
      const char* const why = "answers for pairs of shapes alone: it has no `find(mass)`";
      CHECK(PairDetector<Detector, 2>);
      CHECK(PairDetector<Detector, 3>);
      return {Detector::role::name, Detector::name, why, own_search, why, own_search};
    }
  }
  TEST_CASE("AnalyticCentre") { row_of_detector<AnalyticCentre>().print(); }

  TEST_CASE(
      "SmoothWall is the edge of every domain above, and no joint: it has no shear stiffness") {
    CHECK(ContactLaw<SmoothWall, 2>);
    CHECK(ContactLaw<SmoothWall, 3>);
    CHECK(SmoothWall(5e9).joint_shear_stiffness() == 0);
    const char* const why = "the edge of the domain in every row";
    Row{"contact law", SmoothWall::name, why, why, why, why}.print();
  }
}

}  // namespace methods_test
