// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/message_number.hpp>
#include <voussoir/core/small_algebra.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/equilibrium/search_tuning.hpp>
#include <voussoir/linear/conjugate_gradients.hpp>

namespace voussoir::detail {

/// Edge of a square or cube as large as the mean block [m]. Where areas and volumes are not known,
/// from the radii of gyration: edge / sqrt(6) of a square as of a cube.
template <class System>
[[nodiscard]] double mean_block_edge(const System& system, const std::vector<double>* measures) {
  double sum = 0;
  int count = 0;
  for (int b = 0; b < system.body_count(); ++b) {
    const auto& body = system.body(b);
    if (!body.is_block || !(body.weight > 0)) continue;
    sum += measures != nullptr ? (*measures)[static_cast<std::size_t>(b)] : body.gyration;
    ++count;
  }
  if (count == 0) return 0;
  return measures != nullptr
             ? (System::dim == 2 ? std::sqrt(sum / count) : elementary::cube_root(sum / count))
             : std::sqrt(6.0) * sum / count;
}

/// The displacement that one block in a hundred is beyond: about that of the walls of an opening,
/// whatever a few loose blocks do [m].
template <class System>
[[nodiscard]] double far_displacement(const System& system, const Eigen::VectorXd& u,
                                      double far_blocks) {
  std::vector<double> moved;
  for (int b = 0; b < system.body_count(); ++b)
    if (system.body(b).movable && system.body(b).is_block)
      moved.push_back(part<System::dim>(u, System::dof * b).norm());
  if (moved.empty()) return 0;
  const auto place = moved.begin() + static_cast<std::ptrdiff_t>(
                                         (1 - far_blocks) * static_cast<double>(moved.size() - 1));
  std::nth_element(moved.begin(), place, moved.end());
  return *place;
}

/// Where bodies would be after one elastic step to the end of the stage, all contacts closed and
/// sticking.
struct ElasticOutlook {
  Eigen::VectorXd displacement;
  double far = 0;  ///< displacement that one block in a hundred is beyond there [m]
};

/// @param solve  solve(f, tolerance) turns forces into elastic displacements, in place, and returns
///               their error [m]
/// @throws NumericalFault  displacements are not finite
template <class System, class Solve>
[[nodiscard]] ElasticOutlook look_ahead(System& system, const SearchContext& context, Solve&& solve,
                                        const DetachmentTuning& tuning = {}) {
  const double now = system.wall_fraction, limit = context.acceptance.displacement_limit;
  Eigen::VectorXd forces;
  system.wall_fraction = context.wall_fraction;
  system.forces(system.displacement, forces);
  system.wall_fraction = now;
  ElasticOutlook outlook;
  // Once more where the error of the first solve leaves open whether a limit that is given is long
  // enough.
  for (const double tolerance : {tuning.first_look, tuning.second_look}) {
    Eigen::VectorXd& u = outlook.displacement = forces;
    const double error = solve(u, SolveTolerance{.relative = tolerance});
    if (!voussoir::is_finite(u))
      throw NumericalFault("elastic step to the end of the stage: displacements are not finite");
    u += system.displacement;
    outlook.far = far_displacement(system, u, tuning.far_blocks);
    if (limit == by_the_rock ||
        std::abs(outlook.far - context.carried - tuning.far_limit * limit) > error)
      break;
  }
  return outlook;
}

/// The limits as given; where they are left to the rock: of displacements the larger of a fifth of
/// a block and four times what the walls move elastically, so that a block has come off when it has
/// lost its place among the others, deep below the ground as well as near to it; of contact updates
/// the larger of a twenty-fifth of a block and twice the elastic movement.
///
/// A fifth of a block: where rock fails the answer does not depend on it (docs/theory.md). A block
/// that has slid less far still stands in the notch that it came from.
/// @param far  elastic displacement at the walls [m]
template <class System>
[[nodiscard]] SearchContext limits_by_the_rock(const System& system, const SearchContext& context,
                                               double far) {
  constexpr double block_share = 0.2, elastic_movements = 4;
  constexpr double update_block_share = 0.04, update_elastic_movements = 2;
  SearchContext chosen = context;
  const double edge = mean_block_edge(system, context.measures);
  far = std::max(far - context.carried, 0.0);
  chosen.seldom_moved = std::max({update_block_share * edge, update_elastic_movements * far, 1e-9});
  Acceptance& limits = chosen.acceptance;
  if (limits.displacement_limit == by_the_rock)
    limits.displacement_limit = std::max({block_share * edge, elastic_movements * far, 1e-9});
  if (limits.contact_update_limit == by_the_rock) limits.contact_update_limit = chosen.seldom_moved;
  // Who gives a longer limit expects that blocks go further.
  chosen.seldom_moved =
      std::max(chosen.seldom_moved, update_block_share / block_share * limits.displacement_limit);
  limits.displacement_limit += context.carried;
  return chosen;
}

/// "5 MPa/m"
[[nodiscard]] inline std::string stiffness_text(double stiffness) {
  const bool giga = stiffness >= 1e9, mega = stiffness >= 1e6, kilo = stiffness >= 1e3;
  return message_number(stiffness / (giga   ? 1e9
                                     : mega ? 1e6
                                     : kilo ? 1e3
                                            : 1),
                        3) +
         (giga   ? " GPa/m"
          : mega ? " MPa/m"
          : kilo ? " kPa/m"
                 : " Pa/m");
}
/// "530 mm", "5.7 m"
[[nodiscard]] inline std::string movement_text(double length) {
  return length < 1 ? message_number(1e3 * length, 3) + " mm" : message_number(length, 3) + " m";
}

/// Stiffnesses of a joint that is as soft as all of them are on average [Pa/m].
struct MeanJoint {
  double normal, shear;
  [[nodiscard]] std::string text() const {
    return "the joint stiffness (k_n = " + stiffness_text(normal) +
           ", k_s = " + stiffness_text(shear) + ")";
  }
};
/// Over contacts: a soft fault among joints of rock does not make all of it soft.
template <class System>
[[nodiscard]] MeanJoint mean_joint(const System& system) {
  double normal = 0, shear = 0;
  const auto& contacts = system.joints.contacts();
  for (const auto& c : contacts) {
    normal += 1 / system.joints.law_of(c).joint_normal_stiffness();
    shear += 1 / system.joints.law_of(c).joint_shear_stiffness();
  }
  const auto count = static_cast<double>(contacts.size());
  return {count / normal, count / shear};
}

/// True, with the reason, if limits that are left to the rock would follow an elastic movement that
/// is none: more than a fortieth of the span of the opening, or a quarter of a block, so that four
/// times it is more than a whole one; or joints that the in-situ stress alone closes by a tenth of
/// a block (docs/decisions.md). Joints a thousandfold too soft would else be stable at whatever
/// depth the crown has come to.
///
/// The value to blame is the one that the in-situ stress strains most: joints, or elastic ground
/// beyond the domain.
/// @param given  with the limits as they are given: one that is a number is taken at its word
/// @param far    elastic displacement at the walls [m]
template <class System>
[[nodiscard]] bool moves_beyond_reason(const System& system, const SearchContext& given, double far,
                                       EquilibriumReport& report) {
  constexpr double span_share = 1.0 / 40, block_share = 0.25, closure_share = 0.1;
  if (given.acceptance.displacement_limit != by_the_rock) return false;
  const double moved = far - given.carried, edge = mean_block_edge(system, given.measures),
               span = given.ground.span, pressure = given.ground.pressure;
  if (!(edge > 0) || system.joints.contacts().empty()) return false;
  const MeanJoint joint = mean_joint(system);
  const double closure = pressure / joint.normal, strain = pressure / given.ground.modulus;
  const bool by_span = span > 0 && span_share * span < block_share * edge;
  const bool moves = moved > (by_span ? span_share * span : block_share * edge);
  if (!moves && !(closure > closure_share * edge)) return false;

  const std::string block = "a block of " + message_number(edge, 2) + " m",
                    under = " under the in-situ stress of " + message_number(1e-6 * pressure, 3) +
                            " MPa";
  std::string& why = report.reason;
  why = moves ? "with joints that slip and open no further the rock would have moved " +
                    movement_text(moved) + ", more than " +
                    (by_span ? "a fortieth of the span of " + message_number(span, 3) + " m"
                             : "a quarter of " + block)
              : "joints close by more than a tenth of " + block;
  if (!(pressure > 0))
    why += "; to blame is " + joint.text() + ", of rock 0.1 to 1000 GPa/m, or a load";
  else if (strain > closure / edge)
    why += "; to blame is the modulus of the ground around (" +
           message_number(1e-9 * given.ground.modulus, 3) + " GPa): it is strained by " +
           message_number(100 * strain, 2) + " %" + under;
  else
    why += "; to blame is " + joint.text() +
           ": a joint closes by p0/k_n = " + movement_text(closure) + under + ", " +
           message_number(100 * closure / edge, 3) + " % of " + block + ", in rock less than 1 %";
  why += "; if it is meant, give a displacement_limit";
  report.largest_displacement = system.largest_translation(system.displacement);
  return true;
}

/// True, with the reason, if the rock as a whole is about to move so far that detached blocks
/// cannot be told by a limit that was given: if more than one block in a hundred would have moved
/// beyond half of it after one elastic step to the end of the stage. Blocks that slid so far in an
/// earlier stage count too: fewer than that do not matter.
template <class System>
[[nodiscard]] bool moves_too_far(const System& system, const SearchContext& context, double far,
                                 EquilibriumReport& report, const DetachmentTuning& tuning = {}) {
  const double limit = context.acceptance.displacement_limit - context.carried;
  far -= context.carried;
  if (!(far > tuning.far_limit * limit)) return false;
  const std::string moved = message_number(1e3 * far, 3), most = message_number(1e3 * limit, 3),
                    least = message_number(1e3 * far / tuning.far_limit, 2);
  report.reason = "with joints that slip and open no further the rock would have moved " + moved +
                  " mm, more than half the displacement limit of " + most +
                  " mm that was given, and detached blocks could not be told from it: raise " +
                  "displacement_limit to " + least +
                  " mm at least, or leave it out to have it chosen";
  report.largest_displacement = system.largest_translation(system.displacement);
  return true;
}

}  // namespace voussoir::detail
