// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/roles.hpp>

namespace voussoir {

/// A joint that a bolt crosses: how far the bolt runs in the two blocks beside it [m].
struct BoltCrossing {
  double before, after;  ///< length inside the block towards the head, towards the tip
};

/// Where the bolt grips the two blocks: distances from the joint along the bolt [m].
struct AnchorDistances {
  double before, after;
};

template <class Anchors>
concept HasAnchorDistances = requires(const Anchors anchors, const BoltCrossing& crossing) {
  { anchors.distances(crossing) } -> std::same_as<AnchorDistances>;
};

/// Optional: whether the bolt is held by its ends alone, and grips at no joint between them.
template <class Anchors>
concept HasTiesEnds = requires(const Anchors anchors) {
  { anchors.ties_ends() } -> std::same_as<bool>;
};
template <class Anchors>
[[nodiscard]] bool ties_ends(const Anchors& anchors) {
  if constexpr (HasTiesEnds<Anchors>)
    return anchors.ties_ends();
  else
    return false;
}

/// Chooses the two anchors of a bolt at every joint it crosses.
///
/// What the compiler cannot check: anchors stay inside the intersections, 0 <= distance <= length.
///
/// Models: LorigAnchors, GargaWangAnchors, JointFaceAnchors, EndAnchors; AnyAnchors (one of them,
/// known at run time).
template <class Anchors>
concept BoltAnchors = Fills<Anchors, roles::BoltAnchors> && HasName<Anchors> && Copyable<Anchors> &&
    DefaultConstructible<Anchors> && HasAnchorDistances<Anchors>;

template <class Anchors>
consteval bool explain_bolt_anchors() {
  static_assert(Fills<Anchors, roles::BoltAnchors>,
                "bolt anchors: add `using role = voussoir::roles::BoltAnchors`");
  static_assert(HasName<Anchors>,
                "bolt anchors: add `static constexpr const char* name` for the log");
  static_assert(Copyable<Anchors>, "bolt anchors: must be copyable");
  static_assert(HasAnchorDistances<Anchors>,
                "bolt anchors: add `AnchorDistances distances(const BoltCrossing&) const` [m]");
  static_assert(DefaultConstructible<Anchors>,
                "bolt anchors: add a default constructor (the documented default placement)");
  return true;
}

/// Anchors at a fixed distance from the joint, by default 1.2 bolt diameters of a 28 mm bar.
///
/// Where a block is thinner than twice the distance the anchor sits in its middle.
///
/// Source: Lorig (1985); Boon, Houlsby & Utili (2015), Fig. 4a and section 5.2.
struct LorigAnchors {
  using role = roles::BoltAnchors;
  static constexpr const char* name = "LorigAnchors";

  double distance = 1.2 * 0.028;  ///< [m], > 0

  /// @throws InvalidInput  distance not > 0
  [[nodiscard]] AnchorDistances distances(const BoltCrossing& crossing) const {
    require(distance > 0 && std::isfinite(distance), "anchor distance", distance, "> 0 m");
    VOUSSOIR_ASSERT(crossing.before >= 0 && crossing.after >= 0, "a bolt runs through its blocks");
    return {std::min(distance, 0.5 * crossing.before), std::min(distance, 0.5 * crossing.after)};
  }
};

/// Anchors midway in the blocks. Source: Garga & Wang (1993); Boon et al. (2015), Fig. 4b.
struct GargaWangAnchors {
  using role = roles::BoltAnchors;
  static constexpr const char* name = "GargaWangAnchors";
  [[nodiscard]] AnchorDistances distances(const BoltCrossing& crossing) const {
    return {0.5 * crossing.before, 0.5 * crossing.after};
  }
};

/// Anchors on the joint itself: in shear the force is along the joint only, without clamping it.
/// Source: Moosavi & Grayeli (2006); Boon et al. (2015), Fig. 4c.
struct JointFaceAnchors {
  using role = roles::BoltAnchors;
  static constexpr const char* name = "JointFaceAnchors";
  [[nodiscard]] AnchorDistances distances(const BoltCrossing&) const { return {0.0, 0.0}; }
};

/// A plate at the head and an anchor at the tip, nothing between them: one spring from the block at
/// the head to that at the tip, however many joints the bar crosses.
struct EndAnchors {
  using role = roles::BoltAnchors;
  static constexpr const char* name = "EndAnchors";
  [[nodiscard]] AnchorDistances distances(const BoltCrossing& crossing) const {
    return {crossing.before, crossing.after};
  }
  [[nodiscard]] bool ties_ends() const { return true; }
};

static_assert(BoltAnchors<EndAnchors> && HasTiesEnds<EndAnchors>);
static_assert(BoltAnchors<LorigAnchors> && BoltAnchors<GargaWangAnchors> &&
              BoltAnchors<JointFaceAnchors>);

}  // namespace voussoir
