// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <vector>
#include <voussoir/core/roles.hpp>
#include <voussoir/geometry/contact_facet.hpp>

namespace voussoir {

template <class Detector, class Mass, class Geometry>
concept HasInitialContacts = requires(const Mass& mass) {
  { Detector::find(mass) } -> std::same_as<std::vector<ContactFacet<Geometry>>>;
};

/// Finds the contacts between the bodies of a rock mass.
///
/// What the compiler cannot check: contacts between parts of one body are left out, the result does
/// not depend on anything but the mass, and the facets of a body cover its faces exactly where it
/// has neighbours.
///
/// Models: CutContacts (rockmass/cut_contacts.hpp).
template <class Detector, class Mass, class Geometry>
concept ContactDetector =
    Fills<Detector, roles::ContactDetector> && HasInitialContacts<Detector, Mass, Geometry>;

template <class Detector, class Mass, class Geometry>
consteval bool explain_contact_detector() {
  static_assert(HasInitialContacts<Detector, Mass, Geometry>,
                "contact detector: add `static std::vector<ContactFacet<Geometry>> find(const "
                "RockMass<Geometry>&)`");
  return true;
}

}  // namespace voussoir
