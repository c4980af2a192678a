// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// The laws of the joints of a rock mass: one for all, or one for every joint set, in the order of
/// the sets. All are of one kind; what differs is their parameters.
template <class Law>
class LawsBySet {
 public:
  /// One for all joints, whatever their set.
  LawsBySet(Law law) : laws_{std::move(law)} {}  // NOLINT(google-explicit-constructor)
  /// Law k for the joints of set k. One alone is for all.
  /// @throws InvalidInput  none given
  explicit LawsBySet(std::vector<Law> laws) : laws_(std::move(laws)) {
    if (laws_.empty()) throw InvalidInput("joint laws: none given, needs one for every joint set");
  }

  [[nodiscard]] const std::vector<Law>& all() const { return laws_; }

  /// The largest normal stiffness [Pa/m].
  [[nodiscard]] double stiffest() const {
    double most = 0;
    for (const Law& law : laws_) most = std::max(most, law.joint_normal_stiffness());
    return most;
  }

  /// For every cut of a rock mass the index of its law; 0 for what is no joint.
  /// @throws InvalidInput  a joint of a set for which there is no law
  template <class Mass>
  [[nodiscard]] std::vector<int> of_cuts(const Mass& mass) const {
    std::vector<int> law(mass.cuts.size(), 0);
    if (laws_.size() == 1) return law;
    for (std::size_t k = 0; k < law.size(); ++k) {
      if (mass.cuts[k].kind != decltype(mass.cuts[k].kind)::joint) continue;
      law[k] = mass.joints[static_cast<std::size_t>(mass.cuts[k].source)].set;
      if (law[k] < 0 || static_cast<std::size_t>(law[k]) >= laws_.size())
        throw InvalidInput("joint laws: there are " + std::to_string(laws_.size()) +
                           ", none for the joints of set " + std::to_string(law[k]) +
                           "; sets are counted from 0");
    }
    return law;
  }

 private:
  std::vector<Law> laws_;
};

}  // namespace voussoir
