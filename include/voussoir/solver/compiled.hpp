// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
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

// The arguments are types and `extern template` or `template`, which no parentheses may enclose.
// NOLINTBEGIN(bugprone-macro-parentheses)

/// All that works on a model without knowing its laws: making it, going on after a round, updating
/// its contacts, the searches for equilibrium and with them motion.
#define VOUSSOIR_MODEL(WORD, GEOMETRY)                                                             \
  WORD class SystemState<GEOMETRY>;                                                                \
  WORD class ContactGroup<GEOMETRY>;                                                               \
  WORD class System<GEOMETRY>;                                                                     \
  WORD void System<GEOMETRY>::forces<Frozen>(const Eigen::VectorXd&, Eigen::VectorXd&);            \
  WORD void System<GEOMETRY>::forces<Committing>(const Eigen::VectorXd&, Eigen::VectorXd&);        \
  WORD EquilibriumReport TwoLevel::find(System<GEOMETRY>&, const SearchContext&) const;            \
  WORD EquilibriumReport Relaxation::find(System<GEOMETRY>&, const SearchContext&) const;          \
  WORD void Relaxation::follow(System<GEOMETRY>&, const SearchContext&, EquilibriumReport&) const; \
  WORD EquilibriumReport Explicit::find(System<GEOMETRY>&, const SearchContext&) const;            \
  WORD ContactUpdateReport update_contacts(System<GEOMETRY>&, double, const Progress&);            \
  WORD Motion<GEOMETRY::dim> detail::run_of(const System<GEOMETRY>&, const DynamicsSettings&);     \
  WORD void detail::take_from_run(Motion<GEOMETRY::dim>&, System<GEOMETRY>&,                       \
                                  const std::vector<int>&);                                        \
  WORD void detail::make_model<CutContacts>(                                                       \
      System<GEOMETRY>&, std::shared_ptr<const RockMass<GEOMETRY>>, const InSitu&,                 \
      const FarField<GEOMETRY::dim>&, std::vector<int>,                                            \
      std::shared_ptr<const GroundAround<GEOMETRY::dim>>, std::vector<double>&, const Progress&);  \
  WORD detail::AfterRound<GEOMETRY::dim> detail::go_on_after_round<CutContacts>(                   \
      System<GEOMETRY>&, System<GEOMETRY>&, const std::shared_ptr<const RockMass<GEOMETRY>>&,      \
      std::vector<int>, const GEOMETRY::Opening&, const InSitu&, const FarField<GEOMETRY::dim>&,   \
      double, WallTractions&, const std::vector<int>&, const Progress&);

/// A kind of lining.
#define VOUSSOIR_LINING(WORD, GEOMETRY, LINING)                         \
  WORD std::vector<Vec<GEOMETRY::dim>> detail::assemble_lining<LINING>( \
      System<GEOMETRY>&, double, double, const LiningFrame<GEOMETRY>&,  \
      const std::vector<LiningSection>&, const AnyLaw<GEOMETRY::dim>&,  \
      const std::optional<FootBearing>&);

/// Rock: its blocks, the opening in it, its contacts.
#define VOUSSOIR_ROCK(WORD, GEOMETRY)                                                           \
  WORD RockMass<GEOMETRY> slice<GEOMETRY>(const Domain<GEOMETRY::dim>&,                         \
                                          const std::vector<JointOf<GEOMETRY::dim>>&,           \
                                          const BlockLimits&, const Progress&);                 \
  WORD RockMass<GEOMETRY> carve<GEOMETRY>(RockMass<GEOMETRY>, const GEOMETRY::Opening&, double, \
                                          const Progress&);
// NOLINTEND(bugprone-macro-parentheses)

namespace voussoir {

VOUSSOIR_ROCK(VOUSSOIR_PLANAR_TEMPLATE, Planar)
VOUSSOIR_ROCK(VOUSSOIR_SPATIAL_TEMPLATE, Spatial)

VOUSSOIR_MODEL(VOUSSOIR_PLANAR_TEMPLATE, Planar)
VOUSSOIR_MODEL(VOUSSOIR_SPATIAL_TEMPLATE, Spatial)
VOUSSOIR_LINING(VOUSSOIR_PLANAR_TEMPLATE, Planar, EulerBernoulliBeam)
VOUSSOIR_LINING(VOUSSOIR_PLANAR_TEMPLATE, Planar, TimoshenkoBeam)
VOUSSOIR_LINING(VOUSSOIR_SPATIAL_TEMPLATE, Spatial, EulerBernoulliBeam)
VOUSSOIR_LINING(VOUSSOIR_SPATIAL_TEMPLATE, Spatial, TimoshenkoBeam)

// Bolts of the laws that are there.
VOUSSOIR_PLANAR_TEMPLATE class BoltSet<2, AxialBolt>;
VOUSSOIR_PLANAR_TEMPLATE class BoltSet<2, AxialShearBolt>;
VOUSSOIR_SPATIAL_TEMPLATE class BoltSet<3, AxialBolt>;
VOUSSOIR_SPATIAL_TEMPLATE class BoltSet<3, AxialShearBolt>;

// The laws that are there.
VOUSSOIR_PLANAR_TEMPLATE class detail::LawModelOf<2, CoulombJoint>;
VOUSSOIR_PLANAR_TEMPLATE class detail::LawModelOf<2, MohrCoulombJoint>;
VOUSSOIR_PLANAR_TEMPLATE class detail::LawModelOf<2, BartonBandisJoint>;
VOUSSOIR_PLANAR_TEMPLATE class detail::LawModelOf<2, SmoothWall>;
VOUSSOIR_SPATIAL_TEMPLATE class detail::LawModelOf<3, CoulombJoint>;
VOUSSOIR_SPATIAL_TEMPLATE class detail::LawModelOf<3, MohrCoulombJoint>;
VOUSSOIR_SPATIAL_TEMPLATE class detail::LawModelOf<3, BartonBandisJoint>;
VOUSSOIR_SPATIAL_TEMPLATE class detail::LawModelOf<3, SmoothWall>;

VOUSSOIR_PLANAR_TEMPLATE class ComposedSolver<
    ModelsOfRoles<Planar, CutContacts, CoulombJoint, CoulombJoint, LorigAnchors, AxialBolt,
                  EulerBernoulliBeam, TwoLevel>>;

VOUSSOIR_SPATIAL_TEMPLATE class ComposedSolver<
    ModelsOfRoles<Spatial, CutContacts, CoulombJoint, CoulombJoint, LorigAnchors, AxialBolt,
                  EulerBernoulliBeam, TwoLevel>>;
VOUSSOIR_SPATIAL_TEMPLATE class ComposedSolver<
    ModelsOfRoles<Spatial, CutContacts, CoulombJoint, CoulombJoint, LorigAnchors, AxialBolt,
                  TimoshenkoBeam, TwoLevel>>;

}  // namespace voussoir

#undef VOUSSOIR_ROCK
#undef VOUSSOIR_LINING
#undef VOUSSOIR_MODEL
