// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

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

/// The policy has a name, for the first line of a log.
template <class Policy>
concept HasName = requires {
  { Policy::name } -> std::convertible_to<const char*>;
};

}  // namespace voussoir
