// SPDX-License-Identifier: MIT
#pragma once

namespace voussoir {

/// Two bodies and the facet in which they touch, as detection reports it.
template <class Geometry>
struct ContactFacet {
  int a, b;                        ///< bodies; the facet's area vector points from a to b
  typename Geometry::Facet facet;  ///< in 2-D: body a on its left
  int cut = -1;                    ///< label of the faces that touch
};

}  // namespace voussoir
