// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir::detail {

/// The edges of a face of a block without those where the block goes on in another of its convex
/// parts: rock around an opening is cut into many, and their seams are no joints.
/// @param part  of the body
/// @param k     a face of it
/// @param tolerance  within which points meet [m]
[[nodiscard]] VOUSSOIR_INLINE std::vector<std::pair<Vec3, Vec3>> face_rim(
    const Body<Spatial>& body, const ConvexPolyhedron& part, std::size_t k, double tolerance);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::vector<std::pair<Vec3, Vec3>> face_rim(const Body<Spatial>& body,
                                                            const ConvexPolyhedron& part,
                                                            std::size_t k, double tolerance) {
  // Other parts with a face on the same cut.
  std::vector<std::pair<const ConvexPolyhedron*, std::size_t>> beside;
  for (const ConvexPolyhedron& other : body.parts)
    for (std::size_t j = 0; j < other.size() && &other != &part; ++j)
      if (other.cut(j) == part.cut(k)) beside.emplace_back(&other, j);
  const auto is_seam = [&](const Vec3& at) {
    return std::any_of(beside.begin(), beside.end(), [&](const auto& face) {
      for (std::size_t j = 0; j < face.first->size(); ++j)
        if (face.first->half_space(j).distance(at) > tolerance) return false;
      return true;
    });
  };
  std::vector<std::pair<Vec3, Vec3>> rim;
  const auto& loop = part.loop(k);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 &a = part.vertex(static_cast<std::size_t>(loop[i])),
               &b = part.vertex(static_cast<std::size_t>(loop[(i + 1) % loop.size()]));
    const Vec3 along = b - a;
    // A seam may end within an edge: at a corner of another part.
    std::vector<double> ends{0, 1};
    for (const auto& [other, j] : beside)
      for (const int v : other->loop(j)) {
        const Vec3 to = other->vertex(static_cast<std::size_t>(v)) - a;
        const double at = to.dot(along) / along.squaredNorm();
        if (at > 0 && at < 1 && (to - at * along).norm() <= tolerance) ends.push_back(at);
      }
    std::sort(ends.begin(), ends.end());
    double from = -1;  // of a stretch that is no seam; -1: none is begun
    for (std::size_t e = 1; e < ends.size(); ++e) {
      const bool seam = is_seam(a + 0.5 * (ends[e - 1] + ends[e]) * along);
      if (!seam && from < 0) from = ends[e - 1];
      if (from < 0 || (!seam && e + 1 < ends.size())) continue;
      rim.emplace_back(a + from * along, a + (seam ? ends[e - 1] : ends[e]) * along);
      from = -1;
    }
  }
  return rim;
}

#endif

}  // namespace voussoir::detail
