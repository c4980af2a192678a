// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include <voussoir/contact/laws_by_set.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/linear/elastic_solver.hpp>
#include <voussoir/model/detail/initial_model.hpp>
#include <voussoir/model/joined_contacts.hpp>
#include <voussoir/model/system.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/in_situ.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

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

/// @tparam Dim  2: a section, under plane strain; 3: a block of rock
template <int Dim>
struct OedometerParamsOf {
  /// Where the platen presses; the side opposite is the base.
  SideOf<Dim> loaded = SideOf<Dim>::top;
  double platen_strain = 1e-4;      ///< motion of the platen / length of the sample [-], > 0
  double wall_stiffness_ratio = 1;  ///< platen, base and walls / k_n of the joints [-], > 0
};
using OedometerParams = OedometerParamsOf<2>;

namespace detail {

/// A rock mass between smooth walls of which one, the platen, can be moved by hand.
template <class Geometry, class JointLaw>
struct Press {
  static constexpr int dim = Geometry::dim, dof = Geometry::dof;

  System<Geometry> system;       // there are no supports
  std::vector<double> measures;  ///< of the bodies [m^2], [m^3]
  int platen = -1;
  Vec<dim> outward = zeros<Vec<dim>>();  ///< of the loaded side
  double platen_area = 0, lateral_area = 0, length = 0, wall_stiffness;

  template <class Detector>
  Press(const RockMass<Geometry>& mass, const JointLaw& joint_law,
        const OedometerParamsOf<dim>& params, const Detector&)
      : system(joint_law, params.wall_stiffness_ratio * joint_law.joint_normal_stiffness()),
        wall_stiffness(params.wall_stiffness_ratio * joint_law.joint_normal_stiffness()) {
    // The stress is that of the platen alone; the weight is what an out-of-balance force is
    // compared with, that of the stresses that are meant.
    const InSitu meant{.density = 1e4, .gravity = 1};
    const FarField<dim> rollers;
    InitialModel<Detector, System<Geometry>> model(mass, meant, rollers, system);
    model.add_bodies(measures);
    model.add_contacts(LawsBySet<JointLaw>(joint_law).of_cuts(mass));
    std::fill(system.load.data(), system.load.data() + system.load.size(), 0.0);
    const int ground = system.body_count() - 1;
    platen = system.add_body({zeros<Vec<dim>>(), 0.0, 1.0, false});
    measures.push_back(0.0);
    const auto boundary = boundary_facets(mass);
    for (const auto& f : boundary)
      if (f.side == params.loaded) outward += f.facet.area_vector();
    platen_area = outward.norm();
    outward /= platen_area;
    visit_joined(boundary, [&](int body, SideOf<dim> side, const auto& area) {
      const int wall = side == params.loaded ? platen : ground;
      const auto points = area.gauss_points();
      system.boundary.add(body, wall, area, system.body(body).centre, system.body(wall).centre,
                          points);
      const Vec<dim> whole = area.area_vector();
      if (std::abs(whole.dot(outward)) < 0.5 * whole.norm()) lateral_area += whole.norm();
    });
    length = scaled_by(mass.domain.size(), outward).norm();
  }

  void move_platen(double motion) {
    set_part<dim>(system.displacement, dof * platen, -motion * outward);
  }

  /// @param opens  walls pull at nothing that has left them; else the law without its end at an
  ///               opening, which is linear
  [[nodiscard]] OedometerResult read(double motion, bool opens) {
    double axial = 0, lateral = 0;  // forces on the walls [N]
    const auto add = [&](const auto& contact, double force) {
      if (contact.b == platen) axial += force;
      if (std::abs(contact.normal.dot(outward)) < 0.5) lateral += force;
    };
    if (opens) {
      system.boundary.visit(system.displacement.data(),
                            [&](const auto& contact, const auto&, const auto&, const auto& force) {
                              add(contact, force.normal);
                            });
    } else {
      for (const auto& contact : system.boundary.contacts())
        for (const auto& p : system.boundary.points_of(contact))
          add(contact,
              -wall_stiffness * p.weight *
                  contact.motion(p, contact.offset_of(p), system.displacement.data()).opening);
    }
    OedometerResult result{};
    result.stress_axial = axial / platen_area;
    result.stress_lateral = lateral / lateral_area;
    result.strain = (motion - 2 * result.stress_axial / wall_stiffness) / length;
    result.shear_modulus = (result.stress_axial - result.stress_lateral) / (2 * result.strain);
    result.poisson_ratio = result.stress_lateral / (result.stress_axial + result.stress_lateral);
    result.constrained_modulus = result.stress_axial / result.strain;
    return result;
  }
};

template <class Geometry>
void check_press(const RockMass<Geometry>& mass, const OedometerParamsOf<Geometry::dim>& params) {
  if (mass.bodies.empty()) throw InvalidInput("oedometer: the rock mass has no bodies");
  if (!mass.openings.empty()) throw InvalidInput("oedometer: the rock mass has an opening");
  require(params.platen_strain > 0 && std::isfinite(params.platen_strain), "platen_strain",
          params.platen_strain, "> 0");
  require(params.wall_stiffness_ratio > 0 && std::isfinite(params.wall_stiffness_ratio),
          "wall_stiffness_ratio", params.wall_stiffness_ratio, "> 0");
}

}  // namespace detail

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
/// The blocks along a flat wall are restrained more than those inside. G of the paper's joint sets,
/// 0.6 m apart on a scanline, pressed vertically in samples 35, 70, 140 and 210 m wide, is 0.567,
/// 0.554, 0.543 and 0.536 GPa; with walls 1000 times as stiff 0.596, 0.569, 0.550 and 0.541.
///
/// @throws InvalidInput    no bodies, an opening was carved, or a parameter out of range
/// @throws NumericalFault  some body can move without resistance
/// @throws NotEnoughMemory  for the elastic equations
/// @cost   one factorisation: about 0.1 s for 6 000 blocks in 2-D
template <class Detector = CutContacts, class Geometry, class JointLaw>
[[nodiscard]] OedometerResult oedometer(const RockMass<Geometry>& mass, const JointLaw& joint_law,
                                        const OedometerParamsOf<Geometry::dim>& params = {}) {
  detail::check_press(mass, params);
  detail::Press<Geometry, JointLaw> press(mass, joint_law, params, Detector{});
  // The platen is a body that cannot move by itself; moved by hand it pushes the blocks at it. The
  // other contacts are at rest, so these forces are linear in the motion.
  const double motion = params.platen_strain * press.length;
  press.move_platen(motion);
  Eigen::VectorXd push;
  press.system.forces(press.system.displacement, push);
  (void)press.system.elastic_solver({}).solve_in_place(push, {.relative = 1e-8});
  press.system.displacement = push;
  press.move_platen(motion);
  return press.read(motion, false);
}

/// The same with joints that slip and open, in steps from no stress: what friction does to the
/// moduli, and what unloading gives back.
///
/// @param motions  of the platen over the length of the sample, one after the other; each an
///                 equilibrium that `method` finds, its slip kept. From zero upwards: steps that
///                 are small against the whole; falling ones unload.
/// @return  the state after each
/// @throws InvalidInput, NumericalFault  as `oedometer`; no equilibrium found after a step
/// @cost   a fraction of a second per step for 6 000 blocks in 2-D
template <class Detector = CutContacts, class Geometry, class JointLaw, class Method>
[[nodiscard]] std::vector<OedometerResult> compression_path(
    const RockMass<Geometry>& mass, const JointLaw& joint_law, const std::vector<double>& motions,
    const Method& method, const OedometerParamsOf<Geometry::dim>& params = {}) {
  detail::check_press(mass, params);
  detail::Press<Geometry, JointLaw> press(mass, joint_law, params, Detector{});
  Acceptance acceptance;
  acceptance.displacement_limit = acceptance.contact_update_limit =
      press.length;                        // nothing falls here
  acceptance.unbalance_over_weight = 0.1;  // of 10 kPa in blocks of a metre: next to nothing
  std::vector<OedometerResult> path;
  for (const double motion : motions) {
    require(motion >= 0 && std::isfinite(motion), "motion of the platen over the length", motion,
            ">= 0");
    press.move_platen(motion * press.length);
    const EquilibriumReport report =
        method.find(press.system, SearchContext{acceptance, &press.measures, 0.0, {}});
    if (report.verdict != Verdict::stable)
      throw NumericalFault("compression: no equilibrium at a platen strain of " +
                           std::to_string(motion) + ": " + report.reason);
    path.push_back(press.read(motion * press.length, true));
  }
  return path;
}

}  // namespace voussoir
