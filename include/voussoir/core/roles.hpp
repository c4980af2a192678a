// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

/// The roles that the policies of a `Solver` fill. A policy says which one with `using role = ...`.
namespace voussoir::roles {

struct Geometry {
  static constexpr const char* name = "geometry";
};
struct ContactDetector {
  static constexpr const char* name = "contact detector";
};
struct ContactLaw {
  static constexpr const char* name = "contact law";
};
struct InterfaceLaw {
  static constexpr const char* name = "interface law";
};
struct BoltAnchors {
  static constexpr const char* name = "bolt anchors";
};
struct BoltLaw {
  static constexpr const char* name = "bolt law";
};
struct Lining {
  static constexpr const char* name = "lining";
};
struct Equilibrium {
  static constexpr const char* name = "equilibrium method";
};

}  // namespace voussoir::roles

namespace voussoir {

/// The policy type says that it fills this role.
template <class Policy, class Role>
concept Fills = requires {
  typename Policy::role;
}
&&std::same_as<typename Policy::role, Role>;

/// Copied and assigned as a value. (std::copyable also looks for swaps and common references, which
/// the compiler pays for at every policy; the same goes for std::default_initializable.)
template <class Policy>
concept Copyable = std::is_copy_constructible_v<Policy> && std::is_copy_assignable_v<Policy>;

template <class Policy>
concept DefaultConstructible = std::is_default_constructible_v<Policy>;

/// The policy has a name, for the first line of a log.
template <class Policy>
concept HasName = requires {
  { Policy::name } -> std::convertible_to<const char*>;
};

namespace detail {

struct NamedDescribe {
  int describe;
};
template <class Policy>
struct WithNamedDescribe : Policy, NamedDescribe {};

}  // namespace detail

/// The policy has a member `describe`, whatever it is: one that does not fit its concept would else
/// be passed over as if it were not there. (Two of one name in two bases: the name is ambiguous. A
/// final class cannot be asked.)
template <class Policy>
concept NamesDescribe = std::is_class_v<Policy> && !std::is_final_v<Policy> && !requires {
  &detail::WithNamedDescribe<Policy>::describe;
};

}  // namespace voussoir
