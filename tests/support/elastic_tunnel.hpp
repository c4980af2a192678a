// SPDX-License-Identifier: MIT
#pragma once
// Tunnels in rock whose joints neither open nor slip: built in two ways they must be one thing.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/rockmass/in_situ.hpp>

#include "support/jointed_rock.hpp"
#include "support/transformed.hpp"

namespace voussoir_test {

/// Two searches to this error each are compared within 1e-6 of the largest displacement.
inline const voussoir::Acceptance tight{.error_estimate = 1e-8, .unbalance_over_weight = 1e-6};

/// Joints that neither open nor slip.
inline const voussoir::MohrCoulombJoint elastic({.joint_normal_stiffness = 1e11,
                                                 .joint_shear_stiffness = 4e10,
                                                 .friction_angle = 60 * degree,
                                                 .cohesion = 2e9,
                                                 .tensile_strength = 1e9});
inline const voussoir::InSitu deep{.density = 2700, .k0 = 0.9, .surcharge = 2e7};

[[nodiscard]] inline voussoir::SimplePolygon box(double x0, double y0, double x1, double y1) {
  return voussoir::SimplePolygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

/// The largest difference between the displacements of blocks and of their images, over the
/// largest; infinite if a block has no image.
template <class Tunnel, int Dim = Tunnel::dim>
[[nodiscard]] double difference(const Tunnel& x, const Tunnel& y, const Transform<Dim>& map = {}) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const std::vector<int> twin = twins(x.mass(), y.mass(), map);
  if (x.mass().bodies.size() != y.mass().bodies.size()) return none;
  double apart = 0, largest = 0;
  for (std::size_t b = 0; b < twin.size(); ++b) {
    if (twin[b] < 0) return none;
    const Vec<Dim> centre = x.mass().bodies[b].properties.centroid;
    const Vec<Dim> u = map.turn * x.displacement_of(static_cast<int>(b), centre),
                   v = y.displacement_of(twin[b], map(centre));
    apart = std::max(apart, (u - v).norm());
    largest = std::max(largest, u.norm());
  }
  return apart / largest;
}

}  // namespace voussoir_test
