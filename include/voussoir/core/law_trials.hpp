// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// What a check has found wrong with a law: sentences that begin with its name, one for each
/// property, the first case of it.
class LawFindings {
 public:
  explicit LawFindings(const char* law) : law_(law) {}

  /// @param sentence  as it is written in the source up to its first digit it names the property
  void add(const std::string& sentence) {
    std::string property = sentence.substr(0, sentence.find_first_of("0123456789"));
    if (std::find(properties_.begin(), properties_.end(), property) != properties_.end()) return;
    properties_.push_back(std::move(property));
    sentences_.push_back(law_ + ": " + sentence);
  }
  [[nodiscard]] const std::vector<std::string>& all() const { return sentences_; }

 private:
  std::string law_;
  std::vector<std::string> properties_, sentences_;
};

/// A vector whose entries are drawn from -size to size.
template <int Size>
[[nodiscard]] Vec<Size> drawn_vector(Random& random, double size) {
  Vec<Size> v;
  for (int k = 0; k < Size; ++k) v[k] = size * (2 * random.uniform() - 1);
  return v;
}

}  // namespace voussoir
