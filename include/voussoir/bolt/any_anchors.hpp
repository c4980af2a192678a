// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>
#include <variant>
#include <voussoir/bolt/bolt_anchors.hpp>
#include <voussoir/core/roles.hpp>

namespace voussoir {

/// Anchors that are of one of several types, which is known at run time: every bolt of a model may
/// have a type of its own. Asked once at every joint that a bolt crosses, when it is installed.
///
/// @tparam First  the type by default
template <class First, class... Others>
class AnyAnchorsOf {
 public:
  using role = roles::BoltAnchors;
  static constexpr const char* name = "AnyAnchors";

  /// As `First` is by default.
  AnyAnchorsOf() = default;
  template <class Anchors>
  requires(std::same_as<Anchors, First> || (std::same_as<Anchors, Others> || ...))
      AnyAnchorsOf(const Anchors& anchors)  // NOLINT(google-explicit-constructor): any is one
      : anchors_(anchors) {}

  /// The anchors as their type; null if they are of another.
  template <class Anchors>
  [[nodiscard]] const Anchors* as() const {
    return std::get_if<Anchors>(&anchors_);
  }
  /// Calls visit(anchors) with the anchors as their type.
  template <class Visit>
  decltype(auto) visit(Visit&& visit) const {
    return std::visit(std::forward<Visit>(visit), anchors_);
  }
  /// The name of their type.
  [[nodiscard]] const char* type_name() const {
    return visit([](const auto& anchors) -> const char* { return anchors.name; });
  }

  /// @throws InvalidInput  as the type does
  [[nodiscard]] AnchorDistances distances(const BoltCrossing& crossing) const {
    return visit([&](const auto& anchors) { return anchors.distances(crossing); });
  }
  /// What its type says; if it says nothing, no.
  [[nodiscard]] bool ties_ends() const {
    return visit([](const auto& anchors) { return voussoir::ties_ends(anchors); });
  }

 private:
  std::variant<First, Others...> anchors_;
};

/// Any of the ways in which a bolt may grip the blocks beside a joint; Lorig's by default.
using AnyAnchors = AnyAnchorsOf<LorigAnchors, GargaWangAnchors, JointFaceAnchors, EndAnchors>;

static_assert(BoltAnchors<AnyAnchors>);

}  // namespace voussoir
