// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/rockmass/detail/trace_table.hpp>

namespace voussoir::detail {

#if VOUSSOIR_BODIES

/// The sets that a column of a table names, each with an index.
class SetNames {
 public:
  /// In the order of appearance; -1: the text is a word for none.
  [[nodiscard]] int index_of(const std::string& text) {
    const std::string low = lower(text);
    for (const char* none : {"", "-", "--", "none", "nan", "na", "n/a", "null", "-1"})
      if (low == none) return -1;
    const WrittenNumber read = written_number(low);
    const bool is_number = read.fault.empty();
    // 1, 01 and 1.0 are one set.
    const auto [at, is_new] =
        known_.emplace(is_number ? shortest_text(read.value) : low, static_cast<int>(size()));
    if (is_new) {
      names_.push_back(text);
      values_.push_back(is_number ? std::optional<double>(read.value) : std::nullopt);
    }
    return at->second;
  }
  [[nodiscard]] std::size_t size() const { return names_.size(); }

  /// Puts the names in order of value, if all are numbers.
  /// @return  the new index of each
  [[nodiscard]] std::vector<int> sort() {
    std::vector<std::size_t> order(size());
    for (std::size_t k = 0; k < size(); ++k) order[k] = k;
    if (std::all_of(values_.begin(), values_.end(), [](const auto& v) { return v.has_value(); }))
      std::sort(order.begin(), order.end(),
                [&](std::size_t a, std::size_t b) { return *values_[a] < *values_[b]; });
    std::vector<int> place(size());
    std::vector<std::string> names;
    for (std::size_t k = 0; k < size(); ++k) {
      place[order[k]] = static_cast<int>(k);
      names.push_back(names_[order[k]]);
    }
    names_ = std::move(names);
    return place;
  }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  std::map<std::string, int> known_;
  std::vector<std::string> names_;
  std::vector<std::optional<double>> values_;  ///< of names that are numbers
};

#endif

}  // namespace voussoir::detail
