// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <type_traits>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/bolt_anchors.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/rock_on_lining.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/detection/contact_detector.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/geometry/geometry_of.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/lining/beams.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/model/system.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>

namespace voussoir {

namespace detail {

/// The policy among `Policies` that fills `Role`, or `Default`.
template <class Role, class Default, class... Policies>
struct Pick {
  using type = Default;
};
template <class Role, class Default, class First, class... Rest>
struct Pick<Role, Default, First, Rest...> {
  using type = typename std::conditional_t<Fills<First, Role>, std::type_identity<First>,
                                           Pick<Role, Default, Rest...>>::type;
};

template <class Policy>
inline constexpr bool fills_some_role =
    Fills<Policy, roles::Geometry> || Fills<Policy, roles::ContactDetector> ||
    Fills<Policy, roles::ContactLaw> || Fills<Policy, roles::InterfaceLaw> ||
    Fills<Policy, roles::BoltAnchors> || Fills<Policy, roles::BoltLaw> ||
    Fills<Policy, roles::Lining> || Fills<Policy, roles::Equilibrium>;

/// A policy with the parts of one role that declares another would be asked for the parts of that.
template <class Policy, class Geometry>
consteval bool explain_declared_role() {
  constexpr int dim = Geometry::dim, dof = Geometry::dof;
  static_assert(!(HasContactState<Policy, dim> && HasContactForce<Policy, dim>) ||
                    Fills<Policy, roles::ContactLaw>,
                "Solver: a policy has the parts of a contact law and declares another role; give "
                "it `using role = voussoir::roles::ContactLaw`");
  static_assert(
      !(HasBoltState<Policy, dim> && HasBoltForce<Policy, dim>) || Fills<Policy, roles::BoltLaw>,
      "Solver: a policy has the parts of a bolt law and declares another role; give it "
      "`using role = voussoir::roles::BoltLaw`");
  static_assert(!HasAnchorDistances<Policy> || Fills<Policy, roles::BoltAnchors>,
                "Solver: a policy has the parts of bolt anchors and declares another role; give it "
                "`using role = voussoir::roles::BoltAnchors`");
  static_assert(!HasElementStiffness<Policy, dof> || Fills<Policy, roles::Lining>,
                "Solver: a policy has the parts of a lining and declares another role; give it "
                "`using role = voussoir::roles::Lining`");
  static_assert(!HasInitialContacts<Policy, RockMass<Geometry>, Geometry> ||
                    Fills<Policy, roles::ContactDetector>,
                "Solver: a policy has the parts of a contact detector and declares another role; "
                "give it `using role = voussoir::roles::ContactDetector`");
  return true;
}

template <class Role, class... Policies>
inline constexpr int fillers = (0 + ... + (Fills<Policies, Role> ? 1 : 0));

}  // namespace detail

/// One model for every role.
template <class GeometryModel, class DetectorModel, class JointLawModel, class InterfaceLawModel,
          class AnchorsModel, class BoltLawModel, class LiningModel, class MethodModel>
struct ModelsOfRoles {
  using Geometry = GeometryModel;
  using Detector = DetectorModel;
  using JointLaw = JointLawModel;
  using InterfaceLaw = InterfaceLawModel;
  using Anchors = AnchorsModel;
  using BoltLaw = BoltLawModel;
  using Lining = LiningModel;
  using Method = MethodModel;
};

/// The physics of a solver: one model per role, from policies in any order; a role left out has
/// its default. This is the one place where every requirement is spelled out to the user.
///
/// | role               | default                    |
/// |--------------------|----------------------------|
/// | geometry           | Planar                     |
/// | contact detector   | CutContacts                |
/// | contact law        | CoulombJoint               |
/// | interface law      | RockOnLining<CoulombJoint> |
/// | bolt anchors       | LorigAnchors               |
/// | bolt law           | AxialBolt                  |
/// | lining             | EulerBernoulliBeam         |
/// | equilibrium method | TwoLevel                   |
template <class... Policies>
struct Composition {
  static_assert((detail::fills_some_role<Policies> && ...),
                "Solver: a policy fills no role; give it `using role = voussoir::roles::...`");
  static_assert(detail::fillers<roles::Geometry, Policies...> <= 1, "Solver: two geometries given");
  static_assert(detail::fillers<roles::ContactDetector, Policies...> <= 1,
                "Solver: two contact detectors given");
  static_assert(detail::fillers<roles::ContactLaw, Policies...> <= 1,
                "Solver: two contact laws given");
  static_assert(detail::fillers<roles::InterfaceLaw, Policies...> <= 1,
                "Solver: two interface laws given");
  static_assert(detail::fillers<roles::BoltAnchors, Policies...> <= 1,
                "Solver: two kinds of bolt anchors given");
  static_assert(detail::fillers<roles::BoltLaw, Policies...> <= 1, "Solver: two bolt laws given");
  static_assert(detail::fillers<roles::Lining, Policies...> <= 1, "Solver: two linings given");
  static_assert(detail::fillers<roles::Equilibrium, Policies...> <= 1,
                "Solver: two equilibrium methods given");

  using Geometry = typename detail::Pick<roles::Geometry, Planar, Policies...>::type;
  using Detector = typename detail::Pick<roles::ContactDetector, CutContacts, Policies...>::type;
  using JointLaw = typename detail::Pick<roles::ContactLaw, CoulombJoint, Policies...>::type;
  using Interface =
      typename detail::Pick<roles::InterfaceLaw, RockOnLining<CoulombJoint>, Policies...>::type;
  using Anchors = typename detail::Pick<roles::BoltAnchors, LorigAnchors, Policies...>::type;
  using BoltLaw = typename detail::Pick<roles::BoltLaw, AxialBolt, Policies...>::type;
  using Lining = typename detail::Pick<roles::Lining, EulerBernoulliBeam, Policies...>::type;
  using Method = typename detail::Pick<roles::Equilibrium, TwoLevel, Policies...>::type;

  static_assert(explain_geometry<Geometry>());
  static_assert((detail::explain_declared_role<Policies, Geometry>() && ...));
  static_assert(explain_contact_detector<Detector, RockMass<Geometry>, Geometry>());
  static_assert(explain_pair_detector<typename NarrowPhaseOf<Detector>::type, Geometry::dim>());
  static_assert(explain_contact_law<JointLaw, Geometry::dim>());
  static_assert(explain_interface_law<Interface, Geometry::dim>());
  static_assert(explain_bolt_anchors<Anchors>());
  static_assert(explain_bolt_law<BoltLaw, Geometry::dim>());
  static_assert(explain_lining_model<Lining, Geometry::dof>());

  /// The same whatever the order in which the policies were named.
  using Models = ModelsOfRoles<Geometry, Detector, JointLaw, typename Interface::Law, Anchors,
                               BoltLaw, Lining, Method>;

  /// For the first line of every log: "Planar, CutContacts, CoulombJoint, ...".
  [[nodiscard]] static std::string describe() {
    std::string text = Geometry::name;
    // A name is whatever turns into a `const char*`.
    const char* const models[] = {Detector::name, JointLaw::name, Anchors::name, BoltLaw::name,
                                  Lining::name};
    for (const char* model : models) text.append(", ").append(model);
    const char* const others[] = {Interface::name, Method::name};
    return text.append(" on ").append(others[0]).append(", ").append(others[1]);
  }
};

}  // namespace voussoir
