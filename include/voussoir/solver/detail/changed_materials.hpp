// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/model/lining_members.hpp>
#include <voussoir/solver/composed_solver.hpp>

// Materials of `ComposedSolver` that become others while it stands.
namespace voussoir {

template <class Models>
void ComposedSolver<Models>::change_joint_laws(LawsBySet<JointLaw> joint_laws) {
  if (!joint_laws.has_sets_of(joint_laws_))
    throw InvalidInput("other joint laws: must be of the sets that have laws of their own");
  for (std::size_t k = 0; k < joint_laws.all().size(); ++k) {
    const JointLaw &now = joint_laws.all()[k], &before = joint_laws_.all()[k];
    require(now.joint_normal_stiffness() == before.joint_normal_stiffness(),
            "normal stiffness of another joint law", now.joint_normal_stiffness(),
            "what it was [Pa/m]");
    require(now.joint_shear_stiffness() == before.joint_shear_stiffness(),
            "shear stiffness of another joint law", now.joint_shear_stiffness(),
            "what it was [Pa/m]");
  }
  system_.joints.replace_laws(detail::any_laws<dim>(joint_laws.all()));
  joint_laws_ = std::move(joint_laws);
  started_ = true;
}

template <class Models>
void ComposedSolver<Models>::stiffen_lining(int lining, double factor) {
  require(factor > 0 && std::isfinite(factor), "factor of the stiffness of a lining", factor,
          "> 0");
  const int count = static_cast<int>(linings().size());
  if (lining < 0 || lining >= count)
    throw InvalidInput(message({"lining ", lining, ": is not there; must be below ", count}));
  const auto stiffen = [&](auto& members) {
    members.stiffen(
        factor, [this](int body) { return system_.pose(body); }, system_.displacement.data());
  };
  int number = -1;
  for (const auto& support : system_.supports) {
    if (auto* const members = dynamic_cast<LiningType*>(support.get())) {
      if (++number == lining) stiffen(*members);
    } else if (auto* const joints = dynamic_cast<LiningJoints<Geometry>*>(support.get())) {
      if (joints->lining() == lining) stiffen(*joints);
    }
  }
  started_ = true;
}

}  // namespace voussoir
