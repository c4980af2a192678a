// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <voussoir/solver/composed_solver.hpp>
#include <voussoir/solver/composition.hpp>

namespace voussoir {

/// A solver composed from policies in any order (see `Composition`). Whatever the order, the type
/// behind it is the same one, so that a program which spells a composition in two ways pays for it
/// once.
template <class... Policies>
class Solver : public ComposedSolver<typename Composition<Policies...>::Models> {
 public:
  using Parts = Composition<Policies...>;
  using Base = ComposedSolver<typename Parts::Models>;
  using Base::Base;
  using SystemType = typename Base::SystemType;
  static_assert(explain_equilibrium_method<typename Parts::Method, SystemType>());
  static_assert(
      ((!HasEquilibriumSearch<Policies, SystemType> || Fills<Policies, roles::Equilibrium>)&&...),
      "Solver: a policy has the parts of an equilibrium method and declares another role; "
      "give it `using role = voussoir::roles::Equilibrium`");

  /// The models this solver is made of, by name.
  [[nodiscard]] static std::string composition() { return Parts::describe(); }
};

}  // namespace voussoir

#ifdef VOUSSOIR_COMPILED
#include <voussoir/solver/compiled.hpp>
#endif
