// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <numeric>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir::detail {

/// A face of a body, by name.
struct FaceRef {
  int cut, body, part, face;
};

/// All faces, ordered by the cut that made them; those of one cut as the bodies come.
/// @param facets  if given, the faces themselves in the same order: looked up here, body by body,
///                that costs a third of what it does cut by cut
/// @throws InvalidInput  a face without a cut, as shapes have that were not sliced
template <class Geometry>
[[nodiscard]] std::vector<FaceRef> faces_by_cut(
    const RockMass<Geometry>& mass, std::vector<typename Geometry::Facet>* facets = nullptr) {
  std::vector<std::size_t> next(mass.cuts.size() + 1, 0);  // where the next face of a cut goes
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (const auto& part : mass.bodies[b].parts)
      for (std::size_t k = 0; k < part.size(); ++k) {
        const auto cut = static_cast<std::size_t>(part.cut(k));  // no_cut is the largest of all
        if (cut >= mass.cuts.size())
          throw InvalidInput(message(
              {"contacts from cuts: body ", b, ", face ", k, " has the cut label ", part.cut(k),
               ": must be 0 to ", mass.cuts.size(),
               " - 1, as sliced rock has; search contacts of other shapes ", "(FaceContacts)"}));
        ++next[cut + 1];
      }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<FaceRef> faces(next.back());
  if (facets != nullptr) facets->resize(faces.size());
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    for (std::size_t p = 0; p < mass.bodies[b].parts.size(); ++p) {
      const auto& part = mass.bodies[b].parts[p];
      for (std::size_t k = 0; k < part.size(); ++k) {
        const std::size_t at = next[static_cast<std::size_t>(part.cut(k))]++;
        VOUSSOIR_ASSERT(at < faces.size(), "faces of a cut are as many as were counted");
        faces[at] = {part.cut(k), static_cast<int>(b), static_cast<int>(p), static_cast<int>(k)};
        if (facets != nullptr) (*facets)[at] = part.face(k);
      }
    }
  return faces;
}

}  // namespace voussoir::detail
