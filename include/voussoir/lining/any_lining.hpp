// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/lining/beams.hpp>
#include <voussoir/lining/lining_model.hpp>

namespace voussoir {

/// A lining that is made of what its section says (`LiningSection::element`), known at run time:
/// every lining of a model may be made of its own, and so may the members of one, if all of its
/// sections are pinned or none is.
///
/// Where a pinned lining goes on in one that bends the joint is a hinge.
struct AnyLining {
  using role = roles::Lining;
  static constexpr const char* name = "AnyLining";

  /// Calls visit(model) with an object of the model that an element is of.
  /// @throws InvalidInput  there is no such element
  template <class Visit>
  static decltype(auto) visit(LiningElement element, Visit&& visit) {
    switch (element) {
      case LiningElement::euler_bernoulli:
        return visit(EulerBernoulliBeam{});
      case LiningElement::timoshenko:
        return visit(TimoshenkoBeam{});
      case LiningElement::pinned:
        return visit(PinnedBar{});
      case LiningElement::bonded_chain:
        return visit(BondedChain{});
    }
    throw InvalidInput(message({"lining: there is no element ", static_cast<int>(element)}));
  }
  /// The name of its model.
  [[nodiscard]] static const char* type_name(LiningElement element) {
    return visit(element, [](auto model) -> const char* { return decltype(model)::name; });
  }

  [[nodiscard]] static bool is_pinned(const LiningSection& section) {
    return visit(section.element, [](auto model) { return is_pinned_lining<decltype(model)>(); });
  }
  /// @param length  of the element [m], > 0
  template <int Dof>
  requires(Dof == 3 || Dof == 6)
      [[nodiscard]] static ElementMatrix<Dof> stiffness(const LiningSection& section,
                                                        double length) {
    return visit(section.element, [&](auto model) {
      return decltype(model)::template stiffness<Dof>(section, length);
    });
  }
};

static_assert(LiningModel<AnyLining, 3> && LiningModel<AnyLining, 6>);

}  // namespace voussoir
