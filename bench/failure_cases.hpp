// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/rockmass/in_situ.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>

/// Unsupported tunnels that nobody picked, to hold the solution procedures against each other where
/// rock fails: shape, size, cover, stress and joints are drawn from the number of the case.
namespace voussoir_bench {

struct FailureCase {
  int number;
  std::string shape;       ///< circle, horseshoe or chamber (flat roof)
  double span, cover, k0;  ///< [m], crown to ground surface [m], [-]
  double spacing;          ///< of every set [m]
  bool persistent;         ///< joints without ends; else some spacings long
  voussoir::SimplePolygon opening;
  voussoir::Domain<2> ground;  ///< rock above two and a half spans is a surcharge
  std::vector<voussoir::JointSet> sets;
  voussoir::BlockLimits limits;
  voussoir::CoulombJoint::Params joint;
  voussoir::InSitu in_situ;
};

/// The draws are a function of the number alone, the same on every machine.
///
///   shape    circle, horseshoe, chamber: a third each; span 4 to 12 m
///   cover    10 to 300 m, logarithmically uniform; K0 0.5 to 2
///   joints   three sets (three in four cases) or two, dips 20 degrees apart at least, 1 to 5
///            degrees of deviation; spacing a fifth to an eleventh of the span; half the cases
///            persistent, half 2 to 8 spacings long
///   contact  k_n 2 to 20 GPa/m, k_s 0.1 to 0.5 of it, friction 20 to 45 degrees
///   domain   six spans wide, two below the invert
[[nodiscard]] FailureCase failure_case(int number);

/// The rock of a case, without the opening.
[[nodiscard]] voussoir::RockMass<voussoir::Planar> rock_of(const FailureCase& from);

}  // namespace voussoir_bench
