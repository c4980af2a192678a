// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/solver/block_cholesky.hpp>
#include <voussoir/solver/system.hpp>

namespace voussoir {

/// What one-dimensional compression says about a rock mass. Compression positive; 1: the direction
/// of loading, 3: across it.
struct OedometerResult {
  double stress_axial;         ///< sigma_1 [Pa]
  double stress_lateral;       ///< sigma_3, mean over the lateral walls [Pa]
  double strain;               ///< eps_1 [-]
  double shear_modulus;        ///< G = (sigma_1 - sigma_3) / (2 eps_1) [Pa]
  double poisson_ratio;        ///< nu = sigma_3 / (sigma_1 + sigma_3) [-]
  double constrained_modulus;  ///< M = sigma_1 / eps_1 [Pa]
};

struct OedometerParams {
  Side loaded = Side::top;          ///< where the platen presses; the side opposite is the base
  double platen_strain = 1e-4;      ///< motion of the platen / length of the sample [-], > 0
  double wall_stiffness_ratio = 1;  ///< platen, base and walls / k_n of the joints [-], > 0
};

/// Equivalent elastic moduli of a jointed mass from one-dimensional compression (an oedometer): a
/// platen moves against one side, all other sides are fixed, all walls are smooth.
///
///   eps_3 = 0:  G = (sigma_1 - sigma_3) / (2 eps_1),  nu = sigma_3 / (sigma_1 + sigma_3),
///               M = sigma_1 / eps_1
///
/// Source: Boon, Houlsby & Utili (2015), section 5.1, eqs (10)-(12). They load the mass in a time
/// stepping run; here it is one linear solve. Assumed: rigid blocks and the elastic stiffness of
/// every joint, that is, no joint opens or slips, at any stress. The moduli therefore depend
/// neither on the stress level nor on friction (the paper's G rises by 0.4 % from 35 to 89
/// degrees).
///
/// eps_1 is the motion of the platen less the closure sigma_1 / k of its contacts and of those of
/// the base, over the length of the sample; the walls give way by sigma_3 / k, 1 % of eps_1 in 70
/// m.
///
/// The blocks along a flat wall are held better than those inside. G of the paper's joint sets, 0.6
/// m apart on a scanline, pressed vertically in samples 35, 70, 140 and 210 m wide, is 0.567,
/// 0.554, 0.543 and 0.536 GPa; with walls 1000 times as stiff 0.596, 0.569, 0.550 and 0.541.
///
/// @throws InvalidInput    no bodies, an opening was carved, or a parameter out of range
/// @throws NumericalFault  some body can move without resistance
/// @cost   one factorisation: about 0.1 s for 6 000 blocks in 2-D
template <class Detector = CutContacts, class Geometry, class JointLaw>
[[nodiscard]] OedometerResult oedometer(const RockMass<Geometry>& mass, const JointLaw& joint_law,
                                        const OedometerParams& params = {}) {
  constexpr int dim = Geometry::dim, dof = Geometry::dof;
  if (mass.bodies.empty()) throw InvalidInput("oedometer: the rock mass has no bodies");
  if (!mass.openings.empty()) throw InvalidInput("oedometer: the rock mass has an opening");
  require(params.platen_strain > 0 && std::isfinite(params.platen_strain), "platen_strain",
          params.platen_strain, "> 0");
  require(params.wall_stiffness_ratio > 0 && std::isfinite(params.wall_stiffness_ratio),
          "wall_stiffness_ratio", params.wall_stiffness_ratio, "> 0");
  const double wall_stiffness = params.wall_stiffness_ratio * joint_law.joint_normal_stiffness();

  // There are neither bolts nor a lining: the laws named for them are never used.
  System<Geometry, JointLaw, AxialBolt> system(
      joint_law, wall_stiffness,
      CoulombJoint({.joint_normal_stiffness = 1, .joint_shear_stiffness = 1, .friction_angle = 0}));
  for (const auto& body : mass.bodies) system.add_body({body.properties.centroid, 0.0, 1.0, true});
  const int ground = system.add_body({Vec<dim>::Zero(), 0.0, 1.0, false});
  const int platen = system.add_body({Vec<dim>::Zero(), 0.0, 1.0, false});
  for (const auto& c : Detector::find(mass)) {
    const auto points = c.facet.gauss_points();
    system.joints.add(c.a, c.b, c.facet, system.body(c.a).centre, system.body(c.b).centre, points);
  }
  Vec<dim> outward = Vec<dim>::Zero();  // of the loaded side
  const auto boundary = boundary_facets(mass);
  for (const auto& f : boundary)
    if (f.side == params.loaded) outward += f.facet.area_vector();
  const double platen_area = outward.norm();
  outward /= platen_area;
  double lateral_area = 0;
  for (const auto& f : boundary) {
    const int wall = f.side == params.loaded ? platen : ground;
    const auto points = f.facet.gauss_points();
    system.boundary.add(f.body, wall, f.facet, system.body(f.body).centre, system.body(wall).centre,
                        points);
    const Vec<dim> area = f.facet.area_vector();
    if (std::abs(area.dot(outward)) < 0.5 * area.norm()) lateral_area += area.norm();
  }

  // The platen is a body that cannot move by itself; moved by hand it pushes the blocks at it. The
  // other contacts are at rest, so these forces are linear in the motion.
  const double length = mass.domain.size().cwiseProduct(outward).norm();
  const double motion = params.platen_strain * length;
  Eigen::VectorXd& u = system.displacement;
  u.template segment<dim>(dof * platen) = -motion * outward;
  Eigen::VectorXd push;
  system.forces(u, push);
  BlockCholesky<dof>(system.elastic_stiffness()).solve_in_place(push);
  push.template segment<dof>(dof * platen) = u.template segment<dof>(dof * platen);
  u = push;

  double axial = 0, lateral = 0;  // forces on the walls [N]
  system.boundary.visit(u.data(),
                        [&](const auto& contact, const auto&, const auto& load, const auto&) {
                          // Not the force of the law, which would end at an opening.
                          const double force = -wall_stiffness * load.weight * load.motion.opening;
                          if (contact.b == platen) axial += force;
                          if (std::abs(contact.normal.dot(outward)) < 0.5) lateral += force;
                        });
  OedometerResult result{};
  result.stress_axial = axial / platen_area;
  result.stress_lateral = lateral / lateral_area;
  result.strain = (motion - 2 * result.stress_axial / wall_stiffness) / length;
  result.shear_modulus = (result.stress_axial - result.stress_lateral) / (2 * result.strain);
  result.poisson_ratio = result.stress_lateral / (result.stress_axial + result.stress_lateral);
  result.constrained_modulus = result.stress_axial / result.strain;
  return result;
}

}  // namespace voussoir
