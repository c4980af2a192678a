// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>
#include <voussoir/core/small_algebra.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/moving_contacts.hpp>

namespace voussoir::detail {

/// What contacts do to bodies, summed body by body, always in the same order: the sums are then the
/// same bits for any number of threads.
template <int Dim>
class ContactSums {
 public:
  /// One end of a contact, as its body sees it.
  struct End {
    std::uint32_t contact;
    std::uint32_t end;  ///< 0: body a, 1: body b
    [[nodiscard]] double sign() const { return 2.0 * end - 1.0; }
  };

  /// Lists every body's contacts.
  /// @param each  each(visit) calls visit(a, b, is_listed) for every contact, in order of numbers
  template <class Each>
  void list(std::size_t body_count, std::size_t contact_count, Each&& each) {
    const auto index = [](auto b) { return static_cast<std::size_t>(b); };
    reactions_.resize(contact_count);
    first_.assign(body_count + 1, 0);
    each([&](int a, int b, bool is_listed) {
      if (!is_listed) return;
      ++first_[index(a) + 1];
      ++first_[index(b) + 1];
    });
    for (std::size_t b = 0; b < body_count; ++b) first_[b + 1] += first_[b];
    ends_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    std::uint32_t k = 0;
    each([&](int a, int b, bool is_listed) {
      const std::uint32_t contact = k++;
      if (!is_listed) return;
      ends_[next[index(a)]++] = {contact, 0};
      ends_[next[index(b)]++] = {contact, 1};
    });
  }
  [[nodiscard]] bool is_listed(std::size_t body_count) const {
    return first_.size() == body_count + 1;
  }

  /// What a contact does, to be set.
  [[nodiscard]] Reaction<Dim>& reaction(std::size_t contact) { return reactions_[contact]; }
  [[nodiscard]] std::span<const End> ends_of(std::size_t b) const {
    return {ends_.data() + first_[b], first_[b + 1] - first_[b]};
  }
  /// Force and moment of all its contacts on a body.
  [[nodiscard]] std::pair<Vec<Dim>, Spin<Dim>> gather(std::size_t b) const {
    Vec<Dim> force = zeros<Vec<Dim>>();
    Spin<Dim> moment = zeros<Spin<Dim>>();
    for (const End& it : ends_of(b)) {
      const Reaction<Dim>& r = reactions_[it.contact];
      // No branch: which end of a contact a body is cannot be foreseen.
      force += it.sign() * r.force;
      moment += r.moment[it.end];
    }
    return {force, moment};
  }

 private:
  std::vector<Reaction<Dim>> reactions_;
  std::vector<std::uint32_t> first_;  ///< of every body in `ends_`, and one more
  std::vector<End> ends_;
};

}  // namespace voussoir::detail
