// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>
#include <voussoir/core/thread_team.hpp>

namespace voussoir::detail {

/// Who moves in the steps to come: all bodies, or a few while the others stay where they are.
struct MovingPart {
  bool is_all = true;
  std::vector<std::uint32_t> bodies;    ///< else these, in ascending order
  std::vector<std::uint32_t> contacts;  ///< and all contacts of theirs

  /// Calls visit(number) for every body that may move.
  /// @param all  number of all bodies
  template <class Visit>
  void each_body(std::size_t all, Visit&& visit) const {
    each_body({0, is_all ? all : bodies.size()}, visit);
  }
  /// The same for a member's share of them.
  template <class Visit>
  void each_body(const ThreadTeam& team, unsigned member, std::size_t all, Visit&& visit) const {
    each_body(team.share(is_all ? all : bodies.size(), member), visit);
  }

 private:
  template <class Visit>
  void each_body(const ThreadTeam::Range& share, Visit&& visit) const {
    for (std::size_t k = share.first; k < share.last; ++k)
      visit(is_all ? k : std::size_t{bodies[k]});
  }
};

}  // namespace voussoir::detail
