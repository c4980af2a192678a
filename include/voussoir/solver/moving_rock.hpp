// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <memory>
#include <utility>
#include <vector>
#include <voussoir/motion/dynamics.hpp>
#include <voussoir/motion/moving_bolts.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/edge_slabs.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/solver/bolt_crossings.hpp>
#include <voussoir/solver/in_situ.hpp>

namespace voussoir {

/// A rock mass whose blocks can move by any amount, in its in-situ stress, nothing moved yet.
///
/// What an opening carved out of it has taken away is put back as a load on its wall
/// (`Dynamics::hold`); `set_held(0)` takes it off at once. Block b of the mass is body b.
template <class Geometry, class JointLaw>
[[nodiscard]] Dynamics<Geometry::dim, JointLaw> moving_rock(const RockMass<Geometry>& mass,
                                                            const LawsBySet<JointLaw>& laws,
                                                            const InSitu& in_situ,
                                                            DynamicsSettings settings = {}) {
  constexpr int dim = Geometry::dim;
  in_situ.check();
  settings.gravity = in_situ.gravity;
  Dynamics<dim, JointLaw> run(laws, laws.all().size() > 1 ? laws.of_cuts(mass) : std::vector<int>{},
                              settings);
  for (const auto& body : mass.bodies) run.add_block(body.parts, in_situ.density);
  for (const auto& slab : edge_slabs(mass.domain)) run.add_wall(slab);
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

template <class Geometry, class JointLaw>
[[nodiscard]] Dynamics<Geometry::dim, JointLaw> moving_rock(const RockMass<Geometry>& mass,
                                                            const JointLaw& law,
                                                            const InSitu& in_situ,
                                                            DynamicsSettings settings = {}) {
  return moving_rock(mass, LawsBySet<JointLaw>(law), in_situ, settings);
}

/// Installs bolts in the rock as it lies now, free of force but for their pretension.
/// @param run     made from the same mass, whose body b is its body b
/// @param bars    where the rock was sliced; a bar has moved with every block that it passes
/// @param spacing  between bolts along the tunnel (2-D) [m], > 0
/// @return  the bolts, which the run holds too: forces are read there
/// @throws InvalidInput  spacing out of range, or a bar without length
template <class Geometry, class JointLaw, class BoltLaw, class Anchors>
std::shared_ptr<MovingBolts<Geometry::dim, BoltLaw>> add_bolts(
    Dynamics<Geometry::dim, JointLaw>& run, const RockMass<Geometry>& mass,
    const std::vector<typename Geometry::Line>& bars, const BoltLaw& law, double spacing,
    const Anchors& anchors) {
  constexpr int dim = Geometry::dim;
  require(spacing > 0 && std::isfinite(spacing), "bolt spacing along the tunnel", spacing, "> 0 m");
  auto bolts = std::make_shared<MovingBolts<dim, BoltLaw>>(law);
  int number = 0;
  for (const auto& bar : bars) {
    require(bar.length() > 0 && std::isfinite(bar.length()), "bolt length", bar.length(), "> 0 m");
    const Vec<dim> axis = (bar.end - bar.start) / bar.length();
    for (const auto& at :
         bolt_crossings(pierce(mass, bar), bar, anchors, mass.domain.tolerance())) {
      const Pose<dim> a = run.home(at.a), b = run.home(at.b);
      const auto in = [](const Pose<dim>& pose, const Vec<dim>& p) {
        return Vec<dim>(pose.rotation.transpose() * (p - pose.position));
      };
      typename MovingBolts<dim, BoltLaw>::Spring spring{};
      spring.a = at.a;
      spring.b = at.b;
      spring.bolt = number;
      spring.position = at.position;
      spring.anchor_a = in(a, at.joint_a - at.before * axis);
      spring.anchor_b = in(b, at.joint_b + at.after * axis);
      spring.joint_a = in(a, at.joint_a);
      spring.joint_b = in(b, at.joint_b);
      spring.initial = a.rotation.transpose() * at.initial;
      if (run.steps() > 0)
        spring.initial = run.pose(at.a).rotation.transpose() *
                         (run.pose(at.b)(spring.anchor_b) - run.pose(at.a)(spring.anchor_a));
      spring.axis = a.rotation.transpose() * axis;
      spring.share = dim == 2 ? 1 / spacing : 1;
      bolts->add(spring);
    }
    ++number;
  }
  run.add_support(bolts);
  return bolts;
}

}  // namespace voussoir
