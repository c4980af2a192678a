// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <stdexcept>
#include <voussoir/bolt/any_anchors.hpp>
#include <voussoir/bolt/any_bolt.hpp>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/bolt/bar_in_rock.hpp>
#include <voussoir/bolt/bolt_anchors.hpp>
#include <voussoir/bolt/bolt_curve.hpp>
#include <voussoir/bolt/curve_bolt.hpp>
#include <voussoir/contact/any_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/contact/rock_on_lining.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/design/analysis_input.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/equilibrium/any_method.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/linear/linear_method.hpp>
#include <voussoir/lining/any_lining.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/solver/solver.hpp>

/// The physics of an analysis whose models are chosen at run time, as policies.
///
/// A program that knows its physics composes exactly that (see examples/minimal.cpp). Where it is
/// data, the choices are made inside the policies, and one solver type serves every input:
/// `AnyJoint` is any contact law, `AnyBolt` any bolt, `AnyAnchors` any way of gripping the rock,
/// `AnyLining` any lining, `AnyMethod` any solution procedure; each joint set, pattern and lining
/// has its own. An interface with `MohrCoulombJoint` without cohesion is one with `CoulombJoint`.
namespace voussoir::design {

template <class Geometry>
using TunnelIn = Solver<Geometry, AnyJoint, RockOnLining<MohrCoulombJoint>, AnyAnchors, AnyBolt,
                        AnyLining, AnyMethod>;
using Tunnel = TunnelIn<Planar>;
using SpatialTunnel = TunnelIn<Spatial>;

[[nodiscard]] VOUSSOIR_DESIGN_INLINE AnyAnchors anchors_of(const BoltsInput& bolts);
/// What its bar bears.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE BarStrength bar_strength_of(const BoltsInput& bolts);
/// A bolt that is given by its bar and how the rock holds it; none: by its stiffness at a joint.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE std::optional<BarInRock> bar_in_rock_of(
    const BoltsInput& bolts);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE AnyBolt bolt_of(const BoltsInput& bolts);
/// Rock on lining: friction, and a bond until it fails, which leaves the friction.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE MohrCoulombJoint interface_of(const LiningInput& lining);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LiningSection section_of(const LiningInput& lining,
                                                              double thickness);
/// @param linear  what the computer has for elastic equations; how they are solved is the input's
/// choice; as many threads as make a factor follow a stage in which rock fails
[[nodiscard]] VOUSSOIR_DESIGN_INLINE AnyMethod method_of(const AnalysisInput& input,
                                                         LinearSettings linear, RangeSought range);

/// 3-D: of a strip of the lining, of its concrete alone, and with the steel ribs that it has across
/// the tunnel.
/// @param width  along the tunnel; of those that run along it, around the section [m]
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LiningSection rib_strip_of(const LiningInput& lining,
                                                                double thickness, double width);
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LiningSection strip_of(const LiningInput& lining,
                                                            double thickness, double width);

#if VOUSSOIR_DESIGN_BODIES

VOUSSOIR_DESIGN_INLINE AnyAnchors anchors_of(const BoltsInput& bolts) {
  if (bolts.type == BoltType::end_anchored) return EndAnchors{};
  switch (bolts.anchors) {
    case AnchorKind::lorig:
      return LorigAnchors{bolts.anchor_offset};
    case AnchorKind::garga_wang:
      return GargaWangAnchors{};
    case AnchorKind::joint_face:
      return JointFaceAnchors{};
  }
  throw std::logic_error("unknown bolt anchors");
}

VOUSSOIR_DESIGN_INLINE BarStrength bar_strength_of(const BoltsInput& bolts) {
  constexpr double unlimited = BarStrength::unlimited;
  return {.yield_force = bolts.yield_force.value_or(unlimited),
          .rupture_force = bolts.rupture_force.value_or(unlimited),
          .rupture_extension = bolts.rupture_elongation.value_or(unlimited)};
}

VOUSSOIR_DESIGN_INLINE std::optional<BarInRock> bar_in_rock_of(const BoltsInput& bolts) {
  constexpr double unlimited = BarStrength::unlimited;
  if (bolts.type == BoltType::end_anchored)
    return EndAnchoredBolt{.axial_stiffness = bolts.axial_rigidity(),
                           .anchor_stiffness = bolts.anchor_stiffness.value_or(unlimited),
                           .anchor_strength = bolts.anchor_strength.value_or(unlimited),
                           .plate_strength = bolts.plate_strength.value_or(unlimited),
                           .strength = bar_strength_of(bolts)};
  if (bolts.bond_stiffness && bolts.bond_strength)
    return BondedBolt{.axial_stiffness = bolts.axial_rigidity(),
                      .bond_stiffness = *bolts.bond_stiffness,
                      .bond_strength = *bolts.bond_strength,
                      .plate_strength = bolts.plate_strength.value_or(0),
                      .strength = bar_strength_of(bolts)};
  return std::nullopt;
}

VOUSSOIR_DESIGN_INLINE AnyBolt bolt_of(const BoltsInput& bolts) {
  if (const auto bar = bar_in_rock_of(bolts)) return CurveBolt(*bar, bolts.pretension);
  if (bolts.rupture_elongation)
    return CurveBolt(bar_strength_of(bolts).limited(BoltCurve::straight(bolts.stiffness)),
                     bolts.pretension);
  AxialBolt::Params axial{.axial_stiffness = bolts.stiffness, .pretension = bolts.pretension};
  if (bolts.yield_force) axial.yield_force = *bolts.yield_force;
  if (bolts.rupture_force) axial.rupture_force = *bolts.rupture_force;
  // The quantities of an input have their units: a pretension of 500 N is meant.
  switch (bolts.law) {
    case BoltKind::axial:
      return AxialBolt(axial, any_units);
    case BoltKind::axial_shear:
      return AxialShearBolt({.axial = axial, .shear_stiffness = bolts.shear_stiffness}, any_units);
  }
  throw std::logic_error("unknown bolt law");
}

VOUSSOIR_DESIGN_INLINE MohrCoulombJoint interface_of(const LiningInput& lining) {
  return MohrCoulombJoint({.joint_normal_stiffness = lining.interface_normal_stiffness,
                           .joint_shear_stiffness = lining.interface_shear_stiffness,
                           .friction_angle = lining.interface_friction_angle,
                           .cohesion = lining.shear_bond,
                           .tensile_strength = lining.tensile_bond},
                          any_units);
}

namespace detail {

/// Steel ribs within a width along the tunnel; they add nothing to what resists shear and torsion.
inline void add_ribs(const LiningInput& lining, double width, LiningSection& section) {
  if (!lining.ribs) return;
  section.axial_stiffness += width * lining.ribs->axial_stiffness();
  section.bending_stiffness += width * lining.ribs->bending_stiffness();
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE LiningSection section_of(const LiningInput& lining, double thickness) {
  LiningSection section =
      LiningSection::rectangular(thickness, lining.first_modulus(), lining.poisson_ratio);
  detail::add_ribs(lining, 1, section);
  section.element = lining.beam;
  return section;
}

VOUSSOIR_DESIGN_INLINE LiningSection rib_strip_of(const LiningInput& lining, double thickness,
                                                  double width) {
  LiningSection section = strip_of(lining, thickness, width);
  detail::add_ribs(lining, width, section);
  return section;
}

VOUSSOIR_DESIGN_INLINE LiningSection strip_of(const LiningInput& lining, double thickness,
                                              double width) {
  LiningSection section =
      LiningSection::strip(thickness, width, lining.first_modulus(), lining.poisson_ratio);
  section.element = lining.beam;
  return section;
}

VOUSSOIR_DESIGN_INLINE AnyMethod method_of(const AnalysisInput& input, LinearSettings linear,
                                           RangeSought range) {
  const RunInput& run = input.run;
  const MotionTuning motion{.threads = linear.threads, .range = range};
  linear.method = run.linear_solver;
  switch (run.method) {
    case MethodKind::two_level: {
      TwoLevel::Params params;
      params.linear = linear;
      params.motion = motion;
      if (run.max_steps) params.fallback.max_steps = static_cast<int>(*run.max_steps);
      return AnyMethod(TwoLevel(params));
    }
    case MethodKind::relaxation: {
      Relaxation::Params params;
      params.linear = linear;
      params.motion = motion;
      if (run.max_steps) params.max_steps = static_cast<int>(*run.max_steps);
      return AnyMethod(Relaxation(params));
    }
    case MethodKind::explicit_: {
      Explicit::Params params;
      params.linear = linear;
      params.motion = motion;
      params.damping = run.damping;
      params.ramp_steps = run.ramp_steps;
      if (run.max_steps) params.max_steps = static_cast<int>(*run.max_steps);
      return AnyMethod(Explicit(params));
    }
  }
  throw std::logic_error("unknown equilibrium method");
}

#endif

}  // namespace voussoir::design

#ifdef VOUSSOIR_COMPILED
/// Compiled once, in voussoir::design.
#ifndef VOUSSOIR_DESIGN_PLANAR_TEMPLATE
#define VOUSSOIR_DESIGN_PLANAR_TEMPLATE extern template
#endif
#ifndef VOUSSOIR_DESIGN_SPATIAL_TEMPLATE
#define VOUSSOIR_DESIGN_SPATIAL_TEMPLATE extern template
#endif
VOUSSOIR_DESIGN_PLANAR_TEMPLATE class voussoir::ComposedSolver<
    voussoir::design::Tunnel::Parts::Models>;
VOUSSOIR_DESIGN_SPATIAL_TEMPLATE class voussoir::ComposedSolver<
    voussoir::design::SpatialTunnel::Parts::Models>;
#endif
