// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/roles.hpp>

namespace voussoir {

/// Rock on lining follows this contact law: `Solver<BartonBandisJoint,
/// RockOnLining<CoulombJoint>>` has rough joints and a smooth bond of the shotcrete. Any contact
/// law will do; its stiffnesses are those of the interface, per area [Pa/m].
template <class ContactLaw>
struct RockOnLining {
  using role = roles::InterfaceLaw;
  using Law = ContactLaw;
  static constexpr const char* name = ContactLaw::name;
};

template <class Interface>
concept HasInterfaceLaw = requires {
  typename Interface::Law;
};

/// Names the contact law between rock and lining. Model: RockOnLining.
template <class Interface, int Dim>
concept InterfaceLaw = Fills<Interface, roles::InterfaceLaw> && HasName<Interface> &&
    HasInterfaceLaw<Interface> && ContactLaw<typename Interface::Law, Dim>;

template <class Interface, int Dim>
consteval bool explain_interface_law() {
  static_assert(Fills<Interface, roles::InterfaceLaw>,
                "interface law: add `using role = voussoir::roles::InterfaceLaw`");
  static_assert(HasName<Interface>,
                "interface law: add `static constexpr const char* name` for the log");
  static_assert(HasInterfaceLaw<Interface>,
                "interface law: add `using Law = ...`, the contact law between rock and lining");
  return explain_contact_law<typename Interface::Law, Dim>();
}

}  // namespace voussoir
