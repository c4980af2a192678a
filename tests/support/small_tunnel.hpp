// SPDX-License-Identifier: MIT
#pragma once
// One small tunnel in 2-D and 3-D, for what must not depend on the kind of geometry.

#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/in_situ.hpp>
#include <voussoir/tunnel/opening.hpp>

#include "support/jointed_mass.hpp"
#include "support/jointed_rock.hpp"

namespace voussoir_test {

/// A circle 4 m wide; in 3-D it runs through the whole domain, 3 m along y.
template <class Geometry>
[[nodiscard]] typename Geometry::Opening small_opening() {
  if constexpr (Geometry::dim == 2)
    return voussoir::circular_opening(4, 24);
  else
    return voussoir::PrismaticOpening(voussoir::circular_opening(4, 24));
}

/// The rock around it, not excavated yet.
template <class Geometry>
[[nodiscard]] voussoir::RockMass<Geometry> small_rock() {
  if constexpr (Geometry::dim == 2)
    return jointed_rock(voussoir::domain_around(small_opening<Geometry>(), 14, 5, 5), 3, {0.25, 5});
  else
    return jointed_mass({{-5, 0, -5}, {5, 3, 6}}, 1, 1.9, {.min_inscribed_radius = 0.25});
}

inline const voussoir::InSitu small_in_situ{.density = 2700, .k0 = 0.8, .surcharge = 3e5};

}  // namespace voussoir_test
