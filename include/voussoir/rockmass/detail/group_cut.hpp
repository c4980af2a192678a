// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/geometry/convex_polygon.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/rockmass/detail/circle_between.hpp>
#include <voussoir/rockmass/detail/connected_parts.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir::detail {

/// What a joint makes of a block of several parts.
struct GroupCut {
  struct Halves {
    std::size_t part;  ///< which of them is cut
    ConvexPolygon below, above;
  };
  std::vector<Halves> halves;
  /// What hangs together: part k of those given is k, the half above of `halves[i]` is the number
  /// of parts plus i; k is then its half below.
  std::vector<std::vector<std::size_t>> groups;
  bool is_too_small = false;  ///< one of them is
};

/// Cuts a block of several convex parts by the line of a joint, as far as the rock reaches to both
/// sides of the part that the joint reaches without leaving the block.
///
/// @param label   of the new faces
/// @param radius  of the circle that has room in every block [m]
/// @return  nothing if the line does not cut the part; one group: the block stays whole, as a
///          hollow one may
[[nodiscard]] VOUSSOIR_INLINE std::optional<GroupCut> cut_group(
    const std::vector<const ConvexPolygon*>& parts, std::size_t reached, const HalfSpace<2>& line,
    int label, const std::vector<Cut>& cuts, double radius, double tolerance);

#if VOUSSOIR_BODIES

/// Whether a circle of this radius has room in a block of several parts.
[[nodiscard]] VOUSSOIR_INLINE bool has_room(const std::vector<const ConvexPolygon*>& parts,
                                            const std::vector<Cut>& cuts, double radius) {
  std::vector<Segment> sides;
  for (const ConvexPolygon* part : parts)
    for (std::size_t k = 0; k < part->size(); ++k)
      if (cuts[static_cast<std::size_t>(part->cut(k))].kind != Cut::Kind::seam)
        sides.push_back(part->face(k));
  return holds_circle(parts, sides, radius);
}

VOUSSOIR_INLINE std::optional<GroupCut> cut_group(const std::vector<const ConvexPolygon*>& parts,
                                                  std::size_t reached, const HalfSpace<2>& line,
                                                  int label, const std::vector<Cut>& cuts,
                                                  double radius, double tolerance) {
  struct Chord {
    double from, to;  ///< along the line [m]
    GroupCut::Halves halves;
  };
  const Vec2 along = perpendicular(line.normal);
  std::vector<Chord> chords;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    auto halves = parts[k]->split(line, label, tolerance);
    if (!halves) continue;
    Chord chord{0, 0, {k, std::move(halves->first), std::move(halves->second)}};
    for (std::size_t f = 0; f < chord.halves.below.size(); ++f)
      if (chord.halves.below.cut(f) == label) {
        const Segment face = chord.halves.below.face(f);
        chord.from = dot_product(along, face.start);
        chord.to = dot_product(along, face.end);
        if (chord.to < chord.from) std::swap(chord.from, chord.to);
      }
    chords.push_back(std::move(chord));
  }
  std::sort(chords.begin(), chords.end(),
            [](const Chord& a, const Chord& b) { return a.from < b.from; });
  const auto here = std::find_if(chords.begin(), chords.end(),
                                 [&](const Chord& c) { return c.halves.part == reached; });
  if (here == chords.end()) return std::nullopt;
  auto first = here, last = here + 1;
  while (first != chords.begin() && (first - 1)->to > first->from - tolerance) --first;
  while (last != chords.end() && last->from < (last - 1)->to + tolerance) ++last;
  GroupCut made;
  std::vector<ConvexPolygon> pieces;
  for (const ConvexPolygon* part : parts) pieces.push_back(*part);
  for (auto chord = first; chord != last; ++chord) {
    pieces[chord->halves.part] = chord->halves.below;
    pieces.push_back(chord->halves.above);
    made.halves.push_back(std::move(chord->halves));
  }
  made.groups = connected_indices(pieces, cuts, tolerance);
  if (made.groups.size() < 2) return made;
  for (const auto& group : made.groups) {
    std::vector<const ConvexPolygon*> of_group;
    for (const std::size_t k : group) of_group.push_back(&pieces[k]);
    made.is_too_small = made.is_too_small || !has_room(of_group, cuts, radius);
  }
  return made;
}

#endif

}  // namespace voussoir::detail
