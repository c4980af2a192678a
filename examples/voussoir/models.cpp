// SPDX-License-Identifier: MIT
#include "models.hpp"

#include "joint_laws.hpp"

namespace voussoir::program {

AnyAnchors anchors_of(const BoltsInput& bolts) {
  switch (bolts.anchors) {
    case BoltAnchors::lorig:
      return LorigAnchors{bolts.anchor_offset};
    case BoltAnchors::garga_wang:
      return GargaWangAnchors{};
    case BoltAnchors::joint_face:
      return JointFaceAnchors{};
  }
  throw std::logic_error("unknown bolt anchors");
}

AnyBolt bolt_of(const BoltsInput& bolts) {
  AxialBolt::Params axial{.axial_stiffness = bolts.stiffness, .pretension = bolts.pretension};
  if (bolts.yield_force) axial.yield_force = *bolts.yield_force;
  if (bolts.rupture_force) axial.rupture_force = *bolts.rupture_force;
  // The file's quantities have their units: a pretension of 500 N is meant.
  switch (bolts.law) {
    case BoltLaw::axial:
      return AxialBolt(axial, any_units);
    case BoltLaw::axial_shear:
      return AxialShearBolt({.axial = axial, .shear_stiffness = bolts.shear_stiffness}, any_units);
  }
  throw std::logic_error("unknown bolt law");
}

MohrCoulombJoint interface_of(const LiningInput& lining) {
  return MohrCoulombJoint({.joint_normal_stiffness = lining.interface_normal_stiffness,
                           .joint_shear_stiffness = lining.interface_shear_stiffness,
                           .friction_angle = lining.interface_friction_angle,
                           .cohesion = lining.shear_bond,
                           .tensile_strength = lining.tensile_bond},
                          any_units);
}

LiningSection section_of(const LiningInput& lining, double thickness) {
  LiningSection section =
      LiningSection::rectangular(thickness, lining.young_modulus, lining.poisson_ratio);
  section.element = lining.beam;
  return section;
}

LiningSection strip_of(const LiningInput& lining, double thickness, double width) {
  LiningSection section =
      LiningSection::strip(thickness, width, lining.young_modulus, lining.poisson_ratio);
  section.element = lining.beam;
  return section;
}

ChosenMethod method_of(const Input& input, LinearSettings linear, RangeSought range) {
  const RunInput& run = input.run;
  const MotionTuning motion{.threads = linear.threads, .range = range};
  linear.method = run.linear_solver;
  switch (run.method) {
    case RunMethod::two_level: {
      TwoLevel::Params params;
      params.linear = linear;
      params.motion = motion;
      if (run.max_steps) params.fallback.max_steps = static_cast<int>(*run.max_steps);
      return ChosenMethod(TwoLevel(params));
    }
    case RunMethod::relaxation: {
      Relaxation::Params params;
      params.linear = linear;
      params.motion = motion;
      if (run.max_steps) params.max_steps = static_cast<int>(*run.max_steps);
      return ChosenMethod(Relaxation(params));
    }
    case RunMethod::explicit_: {
      Explicit::Params params;
      params.linear = linear;
      params.motion = motion;
      params.damping = run.damping;
      params.ramp_steps = run.ramp_steps;
      if (run.max_steps) params.max_steps = static_cast<int>(*run.max_steps);
      return ChosenMethod(Explicit(params));
    }
  }
  throw std::logic_error("unknown equilibrium method");
}

std::string composition_of(const Input& input) {
  std::string text =
      std::string(input.is_spatial() ? Spatial::name : Planar::name) + ", " + CutContacts::name;
  for (const JointLawInput* law : laws_in_use(input)) {
    const std::string name = joint_of(*law).type_name();
    if (text.find(", " + name) == std::string::npos) text.append(", ").append(name);
  }
  for (const BoltsInput* bolts : input.bolt_patterns()) {
    const std::string before = text;
    text.append(", ").append(anchors_of(*bolts).type_name());
    text.append(", ").append(bolt_of(*bolts).type_name());
    // Patterns that are alike are named once.
    if (before.ends_with(text.substr(before.size()))) text = before;
  }
  for (const LiningInput* lining : input.linings()) {
    const std::string before = text;
    text.append(", ")
        .append(AnyLining::type_name(lining->beam))
        .append(" on ")
        .append(lining->shear_bond > 0 ? MohrCoulombJoint::name : CoulombJoint::name);
    if (before.ends_with(text.substr(before.size()))) text = before;
  }
  switch (input.run.method) {
    case RunMethod::two_level:
      return text + ", " + TwoLevel::name;
    case RunMethod::relaxation:
      return text + ", " + Relaxation::name;
    case RunMethod::explicit_:
      return text + ", " + Explicit::name;
  }
  return text;
}

}  // namespace voussoir::program

template class voussoir::ComposedSolver<voussoir::program::Tunnel::Parts::Models>;
