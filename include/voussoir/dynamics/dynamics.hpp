// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/laws_by_set.hpp>
#include <voussoir/dynamics/dynamics_settings.hpp>
#include <voussoir/dynamics/motion.hpp>
#include <voussoir/model/any_law.hpp>

namespace voussoir {

/// Blocks that move, their contacts by laws of these types: see `Motion`.
/// @tparam Detector  the narrow phase by which contacts are updated
template <int Dim, class JointLaw, class InterfaceLaw = CoulombJoint, class Detector = FaceContacts>
class Dynamics : public Motion<Dim, Detector> {
  static_assert(explain_contact_law<JointLaw, Dim>());
  static_assert(explain_contact_law<InterfaceLaw, Dim>());

 public:
  using Base = Motion<Dim, Detector>;

  /// @throws InvalidInput  a setting out of range
  explicit Dynamics(const JointLaw& law, const DynamicsSettings& settings = {})
      : Dynamics(LawsBySet<JointLaw>(law), {}, settings) {}
  /// The same with joints of several laws.
  /// @param law_of_cut  for every label of the blocks' faces the index of its law
  Dynamics(const LawsBySet<JointLaw>& laws, std::vector<int> law_of_cut,
           const DynamicsSettings& settings = {})
      : Dynamics(laws.all(), laws.stiffest(), {}, std::move(law_of_cut), settings) {}
  /// @param wall_stiffness  of smooth walls [Pa/m]
  /// @param interface_laws  of linings
  Dynamics(const std::vector<JointLaw>& laws, double wall_stiffness,
           const std::vector<InterfaceLaw>& interface_laws, std::vector<int> law_of_cut,
           const DynamicsSettings& settings)
      : Base(detail::any_laws<Dim>(laws), wall_stiffness, detail::any_laws<Dim>(interface_laws),
             std::move(law_of_cut), settings) {}
  /// A run as it is, whose laws are of these types.
  explicit Dynamics(Base&& run) : Base(std::move(run)) {}

  using Base::add_lining_nodes;
  /// @param interface_law  rock on lining
  int add_lining_nodes(const std::vector<LiningNode<Dim>>& nodes,
                       const InterfaceLaw& interface_law) {
    return Base::add_lining_nodes(nodes, this->network_.add_interface_law(interface_law));
  }
  /// Other joint laws from now on, as many as there are; what the springs then hold differently is
  /// no work of the run.
  void set_laws(const LawsBySet<JointLaw>& laws) {
    Base::set_laws(detail::any_laws<Dim>(laws.all()));
  }

  /// Contacts, with their laws as types.
  [[nodiscard]] auto joints() const { return MovingContactsView<Dim, JointLaw>(Base::joints()); }
  [[nodiscard]] auto walls() const { return MovingContactsView<Dim, SmoothWall>(Base::walls()); }
  [[nodiscard]] auto interface() const {
    return MovingContactsView<Dim, InterfaceLaw>(Base::interface());
  }
};

}  // namespace voussoir
