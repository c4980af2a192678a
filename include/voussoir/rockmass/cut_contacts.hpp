// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>
#include <voussoir/core/roles.hpp>
#include <voussoir/geometry/contact_facet.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

namespace detail {

/// A face of a body, by name.
struct FaceRef {
  int cut, body, part, face;
};

/// All faces, ordered by the cut that made them.
template <class Geometry>
[[nodiscard]] std::vector<FaceRef> faces_by_cut(const RockMass<Geometry>& mass) {
  std::vector<FaceRef> faces;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (std::size_t p = 0; p < mass.bodies[b].parts.size(); ++p) {
      const auto& part = mass.bodies[b].parts[p];
      for (std::size_t k = 0; k < part.size(); ++k)
        faces.push_back(
            {part.cut(k), static_cast<int>(b), static_cast<int>(p), static_cast<int>(k)});
    }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const FaceRef& x, const FaceRef& y) { return x.cut < y.cut; });
  return faces;
}

template <class Geometry>
[[nodiscard]] typename Geometry::Facet facet_of(const RockMass<Geometry>& mass, const FaceRef& f) {
  return mass.bodies[static_cast<std::size_t>(f.body)].parts[static_cast<std::size_t>(f.part)].face(
      static_cast<std::size_t>(f.face));
}

/// Overlaps of the faces on the two sides of one cut: sort both sides along it and sweep.
/// Contact ends are vertices of one side or the other, taken as they are.
inline void match_cut(const RockMass<Planar>& mass, const FaceRef* first, const FaceRef* last,
                      double tolerance, std::vector<ContactFacet<Planar>>& contacts) {
  struct Interval {
    double from, to;
    Segment facet;  ///< in the direction of the cut
    int body;
  };
  // The longest face gives the best direction, and is not one that welding has shrunk to a point.
  Segment reference = facet_of(mass, *first);
  for (const FaceRef* f = first + 1; f != last; ++f)
    if (const Segment s = facet_of(mass, *f); s.length() > reference.length()) reference = s;
  const Vec2 along = (reference.end - reference.start).normalized();
  thread_local std::vector<Interval> left, right;
  left.clear();
  right.clear();
  for (const FaceRef* f = first; f != last; ++f) {
    const Segment s = facet_of(mass, *f);
    const double from = along.dot(s.start), to = along.dot(s.end);
    if (from < to) {
      left.push_back({from, to, s, f->body});
    } else {
      right.push_back({to, from, {s.end, s.start}, f->body});
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

}  // namespace detail

/// Initial contacts from the cuts that made the faces: exact, no search, 0.3 microseconds each.
///
/// Valid only for the rock as it was sliced; once blocks have moved, contacts must be searched.
struct CutContacts {
  using role = roles::ContactDetector;
  static constexpr const char* name = "CutContacts";

  template <class Geometry>
  [[nodiscard]] static std::vector<ContactFacet<Geometry>> find(const RockMass<Geometry>& mass) {
    const std::vector<detail::FaceRef> faces = detail::faces_by_cut(mass);
    std::vector<ContactFacet<Geometry>> contacts;
    contacts.reserve(faces.size() / 2);
    for (std::size_t i = 0; i < faces.size();) {
      std::size_t end = i;
      while (end < faces.size() && faces[end].cut == faces[i].cut) ++end;
      if (mass.cuts[static_cast<std::size_t>(faces[i].cut)].kind != Cut::Kind::boundary)
        detail::match_cut(mass, &faces[i], faces.data() + end, mass.domain.tolerance(), contacts);
      i = end;
    }
    return contacts;
  }
};

/// Where a body touches the edge of the domain.
template <class Geometry>
struct BoundaryFacet {
  int body;
  typename Geometry::Facet facet;  ///< body on its left
  Side side;
};

/// The faces of the rock on the edge of the domain.
template <class Geometry>
[[nodiscard]] std::vector<BoundaryFacet<Geometry>> boundary_facets(const RockMass<Geometry>& mass) {
  std::vector<BoundaryFacet<Geometry>> facets;
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const auto& part : mass.bodies[b].parts)
      for (std::size_t k = 0; k < part.size(); ++k) {
        const Cut& cut = mass.cuts[static_cast<std::size_t>(part.cut(k))];
        if (cut.kind == Cut::Kind::boundary)
          facets.push_back({static_cast<int>(b), part.face(k), static_cast<Side>(cut.source)});
      }
  return facets;
}

}  // namespace voussoir
