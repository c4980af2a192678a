// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// The laws of the joints of a rock mass: one for all but the joints of sets that have their own.
/// All are of one kind; what differs is their parameters.
template <class Law>
class LawsBySet {
 public:
  LawsBySet(Law common) : laws_{std::move(common)} {}  // NOLINT(google-explicit-constructor)

  /// Gives the joints of a set a law of their own.
  /// @param set  as in `JointOf::set`, >= 0
  /// @throws InvalidInput  set out of range, or it has a law already
  void add(int set, Law law) {
    require(set >= 0, "joint set of a law", set, ">= 0");
    if (std::find(sets_.begin(), sets_.end(), set) != sets_.end())
      require(false, "joint set of a law", set, "one law for each set, this has one already");
    sets_.push_back(set);
    laws_.push_back(std::move(law));
  }

  /// The common law, then those of the sets.
  [[nodiscard]] const std::vector<Law>& all() const { return laws_; }

  /// Whether the same sets have laws of their own, in the same order.
  [[nodiscard]] bool has_sets_of(const LawsBySet& other) const { return sets_ == other.sets_; }

  /// The largest normal stiffness [Pa/m].
  [[nodiscard]] double stiffest() const {
    double most = 0;
    for (const Law& law : laws_) most = std::max(most, law.joint_normal_stiffness());
    return most;
  }

  /// For every cut of a rock mass the index of its law among `all()`.
  template <class Mass>
  [[nodiscard]] std::vector<int> of_cuts(const Mass& mass) const {
    std::vector<int> law(mass.cuts.size(), 0);
    for (std::size_t k = 0; k < law.size(); ++k) {
      if (mass.cuts[k].kind != decltype(mass.cuts[k].kind)::joint) continue;
      const int set = mass.joints[static_cast<std::size_t>(mass.cuts[k].source)].set;
      const auto own = std::find(sets_.begin(), sets_.end(), set);
      if (own != sets_.end()) law[k] = static_cast<int>(own - sets_.begin()) + 1;
    }
    return law;
  }

 private:
  std::vector<Law> laws_;
  std::vector<int> sets_;  ///< law k + 1 is that of sets_[k]
};

}  // namespace voussoir
