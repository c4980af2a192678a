// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/geometry/contact_facet.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/rockmass/detail/faces_by_cut.hpp>

namespace voussoir::detail {

/// Overlaps of the faces on the two sides of one cut: sort both sides along it and sweep.
/// Contact ends are vertices of one side or the other, taken as they are.
/// @param faces   all of the cut
/// @param facets  the same
VOUSSOIR_INLINE void match_cut(std::span<const FaceRef> faces, std::span<const Segment> facets,
                               double tolerance, std::vector<ContactFacet<Planar>>& contacts);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void match_cut(std::span<const FaceRef> faces, std::span<const Segment> facets,
                               double tolerance, std::vector<ContactFacet<Planar>>& contacts) {
  struct Interval {
    double from, to;
    Segment facet;  ///< in the direction of the cut
    int body;
  };
  VOUSSOIR_ASSERT(!faces.empty() && faces.size() == facets.size(), "a cut has faces");
  // The longest face gives the best direction, and is not one that welding has shrunk to a point.
  Segment reference = facets[0];
  for (std::size_t k = 1; k < faces.size(); ++k)
    if (facets[k].length() > reference.length()) reference = facets[k];
  const Vec2 along = normalized(reference.end - reference.start);
  thread_local std::vector<Interval> left, right;
  left.clear();
  right.clear();
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Segment& s = facets[k];
    const double from = dot_product(along, s.start), to = dot_product(along, s.end);
    if (from < to) {
      left.push_back({from, to, s, faces[k].body});
    } else {
      right.push_back({to, from, {s.end, s.start}, faces[k].body});
    }
  }
  const auto by_start = [](const Interval& x, const Interval& y) { return x.from < y.from; };
  std::sort(left.begin(), left.end(), by_start);
  std::sort(right.begin(), right.end(), by_start);
  for (std::size_t i = 0, j = 0; i < left.size() && j < right.size();) {
    const Interval &l = left[i], &r = right[j];
    const double from = std::max(l.from, r.from), to = std::min(l.to, r.to);
    if (to - from > tolerance && l.body != r.body)
      contacts.push_back({l.body,
                          r.body,
                          {l.from >= r.from ? l.facet.start : r.facet.start,
                           l.to <= r.to ? l.facet.end : r.facet.end}});
    ++(l.to <= r.to ? i : j);
  }
}

#endif

}  // namespace voussoir::detail
