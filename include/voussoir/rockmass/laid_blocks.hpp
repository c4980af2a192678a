// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/half_space.hpp>
#include <voussoir/geometry/mass_properties.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// Blocks that are given one by one in place of ground that joints cut: masonry, a dry wall, blocks
/// on a slope. They touch where faces of two lie in one plane (2-D: on one line) and look at each
/// other. Nothing holds them but what `ComposedSolver::fix` fixes.
///
/// Goes with `InSitu::is_laid`.
/// @param blocks  convex; in contact they touch to within the tolerance of the domain around all
///                (`Domain::tolerance`, 1e-10 of its diagonal), else not at all; an overlap is not
///                looked for
/// @throws InvalidInput  no block, or one without a measure
/// @cost   faces times the planes that they lie in
template <class Geometry>
[[nodiscard]] RockMass<Geometry> laid_blocks(std::vector<typename Geometry::Shape> blocks) {
  constexpr int dim = Geometry::dim;
  RockMass<Geometry> mass;
  if (blocks.empty()) throw InvalidInput("laid blocks: there is no block");
  Vec<dim> low = blocks.front().vertices().front(), high = low;
  for (const auto& block : blocks)
    for (const Vec<dim>& v : block.vertices()) {
      low = smaller_of(low, v);
      high = larger_of(high, v);
    }
  // Nothing is there where the domain ends, and a block that falls must come off before it lands on
  // that: the edge is farther away than any block goes while it counts as one that stands.
  const Vec<dim> margin = all_entries<dim>(Domain<dim>{low, high}.diameter());
  mass.domain = {Vec<dim>(low - margin), Vec<dim>(high + margin)};
  mass.domain.check();
  const double tolerance = mass.domain.tolerance();
  std::vector<HalfSpace<dim>> planes;
  const auto plane_of = [&](const HalfSpace<dim>& face, const Vec<dim>& on_it) {
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const double along = std::abs(dot_product(planes[k].normal, face.normal));
      if (1 - along < 1e-12 && std::abs(planes[k].distance(on_it)) < tolerance)
        return static_cast<int>(k);
    }
    planes.push_back(face);
    mass.cuts.push_back({Cut::Kind::joint, 0});
    return static_cast<int>(planes.size()) - 1;
  };
  mass.joints.emplace_back().set = -1;  // it has no trace
  for (auto& block : blocks) {
    for (std::size_t k = 0; k < block.size(); ++k)
      block.set_cut(k, plane_of(block.half_space(k), block.face(k).centre()));
    const auto properties = mass_properties(block);
    require(properties.measure > 0, "area or volume of a laid block", properties.measure, "> 0");
    mass.bodies.push_back({{std::move(block)}, properties});
  }
  return mass;
}

}  // namespace voussoir
