// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace voussoir::detail {

/// Drops corners of an outline until it has no dent, or three corners.
///
/// Where several cuts meet, the corners of a face may be hardly further apart than they are exact:
/// the line through two of them may run anywhere, and clipping along it would cut off what is
/// metres away. Without dents no line of a side cuts the outline itself.
///
/// @param outline   corners in their order round; those from `begin` on are of this outline, at
///                  least three
/// @param is_dent   whether the second of three corners that follow each other is one
/// @cost  O(corners) for an outline without dents
template <class Corner, class IsDent>
void remove_dents(std::vector<Corner>& outline, std::size_t begin, IsDent&& is_dent) {
  std::size_t n = outline.size() - begin;
  // Nearly all outlines have none: told without the divisions below.
  bool any = false;
  const Corner *before = &outline[outline.size() - 2], *corner = &outline[outline.size() - 1];
  for (std::size_t k = begin; k < outline.size(); ++k) {
    any = any || is_dent(*before, *corner, outline[k]);
    before = corner;
    corner = &outline[k];
  }
  if (!any) return;
  for (std::size_t k = 0, good = 0; good < n && n > 3;) {
    const auto at = [&](std::size_t i) -> const Corner& { return outline[begin + i % n]; };
    const std::size_t middle = (k + 1) % n;
    if (!is_dent(at(k), at(middle), at(k + 2))) {
      ++good;
      k = middle;
      continue;
    }
    outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(begin + middle));
    if (middle < k) --k;
    --n;
    good = 0;
    k = (k + n - 1) % n;  // the corner before may have become one
  }
}

}  // namespace voussoir::detail
