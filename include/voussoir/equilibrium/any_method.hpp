// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>
#include <utility>
#include <variant>
#include <voussoir/core/roles.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>

namespace voussoir {

/// Any of the equilibrium methods, chosen at run time: what it finds is what the method finds.
class AnyMethod {
 public:
  using role = roles::Equilibrium;
  static constexpr const char* name = "AnyMethod";
  AnyMethod() = default;      ///< `TwoLevel`
  AnyMethod(TwoLevel method)  // NOLINT(google-explicit-constructor): any of them is one
      : method_(std::move(method)) {}
  AnyMethod(Relaxation method)  // NOLINT(google-explicit-constructor)
      : method_(std::move(method)) {}
  AnyMethod(Explicit method)  // NOLINT(google-explicit-constructor)
      : method_(std::move(method)) {}

  template <class System>
  [[nodiscard]] EquilibriumReport find(System& system, const SearchContext& context) const {
    return std::visit([&](const auto& method) { return method.find(system, context); }, method_);
  }

  /// Of the one that it holds.
  [[nodiscard]] const char* type_name() const {
    return std::visit([](const auto& method) { return std::decay_t<decltype(method)>::name; },
                      method_);
  }

 private:
  std::variant<TwoLevel, Relaxation, Explicit> method_;
};

}  // namespace voussoir
