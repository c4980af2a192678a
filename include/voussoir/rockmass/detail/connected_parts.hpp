// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir::detail {

/// True if two faces of one cut touch over more than `tolerance`.
[[nodiscard]] inline bool overlap(const Segment& a, const Segment& b, double tolerance) {
  const Vec2 along = normalized(a.end - a.start);
  const double a1 = a.length(), b0 = dot_product(along, b.start - a.start),
               b1 = dot_product(along, b.end - a.start);
  return std::min(a1, std::max(b0, b1)) - std::max(0.0, std::min(b0, b1)) > tolerance;
}
/// The part of a face inside the prism over another, which faces the other way.
[[nodiscard]] VOUSSOIR_INLINE std::optional<JointPlane> common_part(const SpatialFacet& a,
                                                                    const SpatialFacet& b,
                                                                    double tolerance);
[[nodiscard]] inline bool overlap(const SpatialFacet& a, const SpatialFacet& b, double tolerance) {
  const auto common = common_part(a, b, tolerance);
  return common && common->area() > tolerance * std::sqrt(a.measure());
}

/// Sorts parts into connected groups: parts are connected if they share a piece of face that no
/// joint made.
/// @param cuts  of the rock that the parts are from
/// @return  indices of parts
/// @cost    faces of one cut are compared in pairs
template <class Shape>
[[nodiscard]] std::vector<std::vector<std::size_t>> connected_indices(
    const std::vector<Shape>& parts, const std::vector<Cut>& cuts, double tolerance) {
  struct Face {
    int cut;
    std::size_t part, face;
  };
  std::vector<Face> faces;
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t k = 0; k < parts[p].size(); ++k)
      if (const int cut = parts[p].cut(k);
          cut >= 0 && cuts[static_cast<std::size_t>(cut)].kind != Cut::Kind::joint)
        faces.push_back({cut, p, k});
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return std::tuple(a.cut, a.part, a.face) < std::tuple(b.cut, b.part, b.face);
  });
  std::vector<std::pair<std::size_t, std::size_t>> touching;  // the later part first
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = i + 1; j < faces.size() && faces[j].cut == faces[i].cut; ++j)
      if (faces[i].part != faces[j].part &&
          overlap(parts[faces[j].part].face(faces[j].face),
                  parts[faces[i].part].face(faces[i].face), tolerance))
        touching.emplace_back(faces[j].part, faces[i].part);
  std::sort(touching.begin(), touching.end());
  std::vector<std::size_t> group(parts.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto root = [&](std::size_t k) {
    while (group[k] != k) k = group[k] = group[group[k]];
    return k;
  };
  for (const auto& [later, earlier] : touching) {
    const std::size_t from = root(later), to = root(earlier);
    group[from] = to;
  }
  std::vector<std::vector<std::size_t>> members(parts.size()), groups;
  for (std::size_t p = 0; p < parts.size(); ++p) members[root(p)].push_back(p);
  for (auto& each : members)
    if (!each.empty()) groups.push_back(std::move(each));
  return groups;
}

/// The same groups, of the parts themselves.
template <class Shape>
[[nodiscard]] std::vector<std::vector<Shape>> connected_groups(const std::vector<Shape>& parts,
                                                               const std::vector<Cut>& cuts,
                                                               double tolerance) {
  std::vector<std::vector<Shape>> groups;
  for (const auto& indices : connected_indices(parts, cuts, tolerance)) {
    groups.emplace_back();
    for (const std::size_t p : indices) groups.back().push_back(parts[p]);
  }
  return groups;
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::optional<JointPlane> common_part(const SpatialFacet& a, const SpatialFacet& b,
                                                      double tolerance) {
  const Vec3 normal = normalized(a.area_vector());
  std::optional<JointPlane> rest =
      JointPlane{HalfSpace<3>::through(a.vertices.front(), normal), a.vertices};
  const Vec3 other = normalized(b.area_vector());
  for (std::size_t k = 0; rest && k < b.vertices.size(); ++k) {
    const Vec3 &from = b.vertices[k], &to = b.vertices[k + 1 == b.vertices.size() ? 0 : k + 1];
    const Vec3 out = cross(Vec3(to - from), other);
    if (!(length_of(out) > tolerance)) continue;
    rest = split(std::move(*rest), HalfSpace<3>::through(from, normalized(out)), tolerance).below;
  }
  return rest;
}

#endif

}  // namespace voussoir::detail
