// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/half_space.hpp>

namespace voussoir::detail {

/// The closed surface of a polyhedron as half-edges.
///
/// Half-edge h starts at vertex `loops[h]` and runs to the start of the next one of its face's
/// loop, anticlockwise seen from outside; `twins[h]` is the half-edge of the neighbour face that
/// runs the other way. Four arrays in all, whatever the number of faces.
struct Surface {
  struct Face {
    HalfSpace<3> plane;      ///< normal out of the body
    int cut = 0;             ///< label of what made the face
    int begin = 0, end = 0;  ///< its half-edges
  };
  std::vector<Vec3> vertices;  ///< [m]
  std::vector<int> loops;
  std::vector<int> twins;
  std::vector<Face> faces;

  [[nodiscard]] std::span<const int> loop(const Face& face) const {
    return {loops.data() + face.begin, static_cast<std::size_t>(face.end - face.begin)};
  }
};

/// A half-edge that cannot be paired: another runs the same way, or (-1) none the other way.
struct PairingFault {
  int half, other;
};

/// Finds the twin of every half-edge from the loops alone.
[[nodiscard]] VOUSSOIR_INLINE std::optional<PairingFault> find_twins(Surface& surface);

/// Twice area times unit normal of the polygon through these vertices, relative to the first one,
/// so that coordinates of 1e6 m lose nothing.
template <class Corner>
[[nodiscard]] Vec3 doubled_area(std::size_t count, Corner&& corner) {
  Vec3 sum = zeros<Vec3>();
  if (count < 3) return sum;
  const Vec3& origin = corner(0);
  Vec3 previous = corner(1) - origin;
  for (std::size_t k = 2; k < count; ++k) {
    const Vec3 next = corner(k) - origin;
    sum += cross(previous, next - previous);  // the edge: exact to its own size, if short
    previous = next;
  }
  return sum;
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::optional<PairingFault> find_twins(Surface& surface) {
  const auto at = [](int index) { return static_cast<std::size_t>(index); };
  std::vector<std::array<int, 3>> halves;  // from, to, half-edge
  halves.reserve(surface.loops.size());
  for (const Surface::Face& face : surface.faces)
    for (int h = face.begin; h < face.end; ++h)
      halves.push_back(
          {surface.loops[at(h)], surface.loops[at(h + 1 == face.end ? face.begin : h + 1)], h});
  std::sort(halves.begin(), halves.end());
  for (std::size_t k = 1; k < halves.size(); ++k)
    if (halves[k - 1][0] == halves[k][0] && halves[k - 1][1] == halves[k][1])
      return PairingFault{halves[k - 1][2], halves[k][2]};
  surface.twins.assign(surface.loops.size(), -1);
  for (const auto& half : halves) {
    const std::array<int, 3> wanted{half[1], half[0], 0};
    const auto found = std::lower_bound(halves.begin(), halves.end(), wanted);
    if (found == halves.end() || (*found)[0] != half[1] || (*found)[1] != half[0])
      return PairingFault{half[2], -1};
    surface.twins[at(half[2])] = (*found)[2];
  }
  return std::nullopt;
}

#endif

}  // namespace voussoir::detail
