// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <voussoir/motion/dynamics.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/solver/in_situ.hpp>

namespace voussoir {

namespace detail {

/// Blocks that stand for the edge of the domain, outside it, on every side but the top.
template <int Dim>
[[nodiscard]] auto edge_slabs(const Domain<Dim>& domain) {
  using Shape = decltype(as_block(domain));
  const double thickness = 0.1 * domain.size().maxCoeff();
  std::vector<Shape> slabs;
  for (int axis = 0; axis < Dim; ++axis)
    for (const bool upper : {false, true}) {
      if (upper && axis == Dim - 1) continue;
      Domain<Dim> slab = domain;
      slab.low.array() -= thickness;
      slab.high.array() += thickness;
      if (upper)
        slab.low[axis] = domain.high[axis];
      else
        slab.high[axis] = domain.low[axis];
      slabs.push_back(as_block(slab));
    }
  return slabs;
}

}  // namespace detail

/// A rock mass whose blocks can move by any amount, in its in-situ stress, nothing moved yet.
///
/// What an opening carved out of it has taken away is put back as a load on its wall
/// (`Dynamics::hold`); `set_held(0)` takes it off at once. Block b of the mass is body b.
template <class Geometry, class JointLaw>
[[nodiscard]] Dynamics<Geometry::dim, JointLaw> moving_rock(const RockMass<Geometry>& mass,
                                                            const JointLaw& law,
                                                            const InSitu& in_situ,
                                                            DynamicsSettings settings = {}) {
  constexpr int dim = Geometry::dim;
  in_situ.check();
  settings.gravity = in_situ.gravity;
  Dynamics<dim, JointLaw> run(law, settings);
  for (const auto& body : mass.bodies) run.add_block(body.parts, in_situ.density);
  for (const auto& slab : detail::edge_slabs(mass.domain)) run.add_wall(slab);
  if (in_situ.surcharge > 0)
    for (const auto& f : boundary_facets(mass))
      if (f.side == SideOf<dim>::top) {
        const Vec<dim> push = -in_situ.surcharge * f.facet.area_vector();
        run.add_load(f.body, push, moment_of(f.facet.centre_from(run.position(f.body)), push));
      }
  run.prescribe(
      [&](const Vec<dim>& point) { return in_situ.template stress<dim>(mass.domain.depth(point)); },
      10 * mass.domain.tolerance());
  run.hold();
  return run;
}

}  // namespace voussoir
