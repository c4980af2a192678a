// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/bodies.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/solver/solver.hpp>

/// What the library `voussoir::compiled` holds of the solver: the common compositions, compiled
/// once. A program that links it has VOUSSOIR_COMPILED defined; `solver.hpp` then includes this
/// list, and the compiler leaves what stands in it to the library. Any other composition is
/// compiled where it is used, as without the library: it saves time and changes no answer.

/// The searches for equilibrium in one kind of system.
#define VOUSSOIR_SEARCHES(WORD, ...)                                                           \
  WORD class System<__VA_ARGS__>;                                                              \
  WORD EquilibriumReport TwoLevel::find(System<__VA_ARGS__>&, const SearchContext&) const;     \
  WORD EquilibriumReport Relaxation::find(System<__VA_ARGS__>&, const SearchContext&) const;   \
  WORD void Relaxation::follow(System<__VA_ARGS__>&, const SearchContext&, EquilibriumReport&) \
      const;                                                                                   \
  WORD EquilibriumReport Explicit::find(System<__VA_ARGS__>&, const SearchContext&) const;

/// Rock: its blocks, the opening in it, its contacts.
#define VOUSSOIR_ROCK(WORD, GEOMETRY)                                                           \
  WORD RockMass<GEOMETRY> slice<GEOMETRY>(const Domain<GEOMETRY::dim>&,                         \
                                          const std::vector<JointOf<GEOMETRY::dim>>&,           \
                                          const BlockLimits&, const Progress&);                 \
  WORD RockMass<GEOMETRY> carve<GEOMETRY>(RockMass<GEOMETRY>, const GEOMETRY::Opening&, double, \
                                          const Progress&);

namespace voussoir {

VOUSSOIR_ROCK(VOUSSOIR_PLANAR_TEMPLATE, Planar)
VOUSSOIR_ROCK(VOUSSOIR_SPATIAL_TEMPLATE, Spatial)

// The contacts of one system: between blocks, at the edge of the domain.
VOUSSOIR_PLANAR_TEMPLATE class ContactGroup<Planar, CoulombJoint>;
VOUSSOIR_PLANAR_TEMPLATE class ContactGroup<Planar, SmoothWall>;
VOUSSOIR_SPATIAL_TEMPLATE class ContactGroup<Spatial, CoulombJoint>;
VOUSSOIR_SPATIAL_TEMPLATE class ContactGroup<Spatial, SmoothWall>;

VOUSSOIR_SEARCHES(VOUSSOIR_PLANAR_TEMPLATE, Planar, CoulombJoint)
VOUSSOIR_PLANAR_TEMPLATE class ComposedSolver<
    ModelsOfRoles<Planar, CutContacts, CoulombJoint, CoulombJoint, LorigAnchors, AxialBolt,
                  EulerBernoulliBeam, TwoLevel>>;

VOUSSOIR_SEARCHES(VOUSSOIR_SPATIAL_TEMPLATE, Spatial, CoulombJoint)
VOUSSOIR_SPATIAL_TEMPLATE class ComposedSolver<
    ModelsOfRoles<Spatial, CutContacts, CoulombJoint, CoulombJoint, LorigAnchors, AxialBolt,
                  EulerBernoulliBeam, TwoLevel>>;
VOUSSOIR_SPATIAL_TEMPLATE class ComposedSolver<
    ModelsOfRoles<Spatial, CutContacts, CoulombJoint, CoulombJoint, LorigAnchors, AxialBolt,
                  TimoshenkoBeam, TwoLevel>>;

}  // namespace voussoir

#undef VOUSSOIR_ROCK
#undef VOUSSOIR_SEARCHES
