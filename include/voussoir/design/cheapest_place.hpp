// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>

/// The cheapest of many supports without computing all of them.
namespace voussoir::design {

/// On a grid of supports: which bolt spacing, rising, and which thickness of lining, rising.
struct SupportPlace {
  std::size_t spacing = 0, thickness = 0;
  bool operator==(const SupportPlace&) const = default;
};

/// The cheapest place of a grid that holds, where more support never fails what less of it holds:
/// denser bolts under the same lining, a thicker lining over the same bolts. Walks along the edge
/// of what holds, from the fewest bolts under the thickest lining; what is no cheaper than the best
/// so far is not asked about.
/// @param costs  (spacing, thickness), falling with the spacing and rising with the thickness
/// @param holds  holds(place) -> bool; asked once for each place on the way
/// @return  nothing: none holds
/// @cost  no more than the sum of rows and columns of the grid
template <class Holds>
requires std::same_as < std::invoke_result_t<Holds&, const SupportPlace&>,
bool > [[nodiscard]] std::optional<SupportPlace> cheapest_place(const Eigen::MatrixXd& costs,
                                                                Holds&& holds) {
  std::optional<SupportPlace> best;
  double least = 0;
  Eigen::Index i = costs.rows() - 1, j = costs.cols() - 1;
  while (i >= 0 && j >= 0) {
    const SupportPlace place{static_cast<std::size_t>(i), static_cast<std::size_t>(j)};
    if (best && costs(i, j) >= least) {
      --j;
    } else if (holds(place)) {
      best = place;
      least = costs(i, j);
      --j;
    } else {
      --i;
    }
  }
  return best;
}

}  // namespace voussoir::design
