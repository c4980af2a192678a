// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/geometry/contact_facet.hpp>
#include <voussoir/rockmass/detail/faces_by_cut.hpp>
#include <voussoir/rockmass/detail/match_cut_planar.hpp>
#include <voussoir/rockmass/detail/match_cut_spatial.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

struct FaceContacts;

/// Initial contacts from the cuts that made the faces: exact, no search, 0.3 microseconds each in
/// 2-D and 0.8 to 1.8 in 3-D.
///
/// Valid only for the rock as it was sliced; once blocks have moved, `FaceContacts` finds them.
struct CutContacts {
  using role = roles::ContactDetector;
  using NarrowPhase = FaceContacts;
  static constexpr const char* name = "CutContacts";

  /// @throws Stopped
  template <class Geometry>
  [[nodiscard]] static std::vector<ContactFacet<Geometry>> find(const RockMass<Geometry>& mass,
                                                                const Progress& progress = {}) {
    StopCheck stop(progress);
    std::vector<typename Geometry::Facet> facets;  // in 3-D they are made only where they touch
    const std::vector<detail::FaceRef> faces =
        detail::faces_by_cut(mass, Geometry::dim == 2 ? &facets : nullptr);
    std::vector<ContactFacet<Geometry>> contacts;
    contacts.reserve(faces.size() / 2);
    for (std::size_t i = 0; i < faces.size();) {
      stop();
      std::size_t end = i;
      while (end < faces.size() && faces[end].cut == faces[i].cut) ++end;
      const std::size_t before = contacts.size();
      if (mass.cuts[static_cast<std::size_t>(faces[i].cut)].kind != Cut::Kind::boundary)
        match(mass, faces, facets, i, end, contacts);
      for (std::size_t k = before; k < contacts.size(); ++k) {
        VOUSSOIR_ASSERT(contacts[k].a != contacts[k].b, "a contact is of two bodies");
        contacts[k].cut = faces[i].cut;
      }
      i = end;
    }
    return contacts;
  }

 private:
  /// Adds the contacts across the cut whose faces are first, ..., last - 1.
  template <class Geometry>
  static void match(const RockMass<Geometry>& mass, const std::vector<detail::FaceRef>& faces,
                    const std::vector<typename Geometry::Facet>& facets, std::size_t first,
                    std::size_t last, std::vector<ContactFacet<Geometry>>& contacts) {
    const auto of_cut = std::span(faces).subspan(first, last - first);
    if constexpr (Geometry::dim == 2)
      detail::match_cut(of_cut, std::span(facets).subspan(first, last - first),
                        mass.domain.tolerance(), contacts);
    else
      detail::match_cut(mass, of_cut.data(), of_cut.data() + of_cut.size(), mass.domain.tolerance(),
                        contacts);
  }
};

/// Where a body touches the edge of the domain.
template <class Geometry>
struct BoundaryFacet {
  int body;
  typename Geometry::Facet facet;  ///< its area vector points out of the body
  SideOf<Geometry::dim> side;
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
          facets.push_back(
              {static_cast<int>(b), part.face(k), static_cast<SideOf<Geometry::dim>>(cut.source)});
      }
  return facets;
}

}  // namespace voussoir
