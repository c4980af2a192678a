// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/contact/foot_bearing.hpp>
#include <voussoir/contact/laws_by_set.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/dynamics/set_in_motion.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/farfield/ground_around.hpp>
#include <voussoir/lining/lining_frame.hpp>
#include <voussoir/lining/node_spacing.hpp>
#include <voussoir/model/bolt_installation.hpp>
#include <voussoir/model/bolt_set.hpp>
#include <voussoir/model/detail/initial_model.hpp>
#include <voussoir/model/lining_feet.hpp>
#include <voussoir/model/lining_members.hpp>
#include <voussoir/model/lining_surface.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/in_situ.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// A rock mass whose blocks can move by any amount, in its in-situ stress, nothing moved yet.
///
/// What an opening carved out of it has taken away is put back as a load on its wall
/// (`Dynamics::hold`); `set_held(0)` takes it off at once. Block b of the mass is body b, the
/// ground around it the last.
///
/// @tparam InterfaceLaw  of the linings that it may get
/// @tparam Detector      of contacts, as in a solver
/// @param far_field      what the sides of the domain meet
template <class InterfaceLaw = CoulombJoint, class Detector = CutContacts, class Geometry,
          class JointLaw>
[[nodiscard]] auto moving_rock(const RockMass<Geometry>& mass, const LawsBySet<JointLaw>& laws,
                               const InSitu& in_situ, DynamicsSettings settings = {},
                               const FarField<Geometry::dim>& far_field = {}) {
  in_situ.check();
  far_field.check();
  settings.gravity = in_situ.gravity;
  using Narrow = typename NarrowPhaseOf<Detector>::type;
  System<Geometry, Narrow> system(detail::any_laws<Geometry::dim>(laws.all()), laws.stiffest());
  std::vector<double> measures;
  const auto around = ground_around<Geometry::dim>(mass.domain, far_field);
  detail::make_model<Detector>(system, std::make_shared<const RockMass<Geometry>>(mass), in_situ,
                               far_field, laws.of_cuts(mass), around, measures, {});
  Dynamics<Geometry::dim, JointLaw, InterfaceLaw, Narrow> run(set_in_motion(system, settings));
  run.hold();
  return run;
}

template <class InterfaceLaw = CoulombJoint, class Detector = CutContacts, class Geometry,
          class JointLaw>
[[nodiscard]] auto moving_rock(const RockMass<Geometry>& mass, const JointLaw& law,
                               const InSitu& in_situ, DynamicsSettings settings = {},
                               const FarField<Geometry::dim>& far_field = {}) {
  return moving_rock<InterfaceLaw, Detector>(mass, LawsBySet<JointLaw>(law), in_situ, settings,
                                             far_field);
}

/// The bodies of a run, for `install_bolt`.
template <class Run>
struct BodiesInMotion {
  const Run& run;

  [[nodiscard]] bool is_gone(int b) const { return run.body(b).is_gone; }
  [[nodiscard]] auto frame(int b) const { return run.home(b); }
  template <class Spring>
  [[nodiscard]] BoltSpan<Spring::dim> span(const Spring& spring) const {
    const Pose<Spring::dim> a = run.pose(spring.a);
    BoltSpan<Spring::dim> span = spring.span_at(a, run.pose(spring.b));
    span.motion = transposed_product(a.rotation, span.motion);
    span.jump = transposed_product(a.rotation, span.jump);
    return span;
  }
};

/// Installs bolts in the rock as it lies now, free of force but for their pretension.
/// @param run     made from the same mass, whose body b is its body b
/// @param bars    where the rock was sliced; a bar has moved with every block that it passes
/// @param spacing  between bolts along the tunnel (2-D) [m], > 0
/// @return  the bolts, which the run holds too: forces are read there
/// @throws InvalidInput  see `install_bolt`
template <class Geometry, class BoltLaw, class Anchors, class... Parts>
std::shared_ptr<BoltSet<Geometry::dim, BoltLaw>> add_bolts(
    Dynamics<Geometry::dim, Parts...>& run, const RockMass<Geometry>& mass,
    const std::vector<typename Geometry::Line>& bars, const BoltLaw& law, double spacing,
    const Anchors& anchors) {
  constexpr int dim = Geometry::dim;
  static_assert(explain_bolt_law<BoltLaw, dim>());
  auto bolts = std::make_shared<BoltSet<dim, BoltLaw>>(law);
  const BodiesInMotion<Dynamics<dim, Parts...>> bodies{run};
  int number = 0;
  for (const auto& bar : bars)
    install_bolt(*bolts, mass, bar, 0, number++, spacing, anchors, bodies);
  run.add_support(bolts);
  return bolts;
}

/// Installs a lining on the wall as it lies now, free of force.
///
/// Its nodes become bodies of the run. Their mass is that of the sections, their moment of inertia
/// that of a tile; rock touches tiles of the thickness given, and may land on them.
/// @param given      of the mass from which the run was made. It joins no other lining: those that
/// do
///                   are installed at rest, and set in motion
/// @param interface_law  rock on lining
/// @param thickness  [m], > 0
/// @param feet       on which its ends stand; none: they hang free
/// @return  the lining, which the run holds too: forces are read there
/// @throws InvalidInput  a thickness or mass out of range; a member without length or section; no
///                       rock at the wall; nodes too far apart for a bond; some sections are pinned
///                       and some are not
template <class Lining, class Geometry, class JointLaw, class InterfaceLaw, class Detector>
std::shared_ptr<LiningMembers<Geometry>> add_lining(
    Dynamics<Geometry::dim, JointLaw, InterfaceLaw, Detector>& run,
    const LiningFrame<Geometry>& given, const std::vector<LiningSection>& sections,
    const InterfaceLaw& interface_law, double thickness,
    const std::optional<FootBearing>& feet = {}) {
  constexpr int dim = Geometry::dim, dof = Geometry::dof;
  static_assert(explain_lining_model<Lining, dof>());
  require(thickness > 0 && std::isfinite(thickness), "thickness of the lining", thickness, "> 0 m");
  if (given.contacts.empty()) throw InvalidInput("lining: no rock touches it");
  for (const LiningSection& section : sections)
    require(section.mass > 0 && std::isfinite(section.mass), "mass of a lining that moves",
            section.mass, "> 0 kg per metre of it");
  const bool is_pinned = is_pinned_lining<Lining>(sections);
  const LiningFrame<Geometry> frame = is_pinned ? without_bare_nodes(given) : given;
  if (!is_pinned && holds_tension<dim>(interface_law))
    require_nodes_for_bond(frame, sections, interface_law.joint_normal_stiffness());
  const std::vector<LiningNodeShare> shares = node_shares(frame, sections);
  const LiningSurface<Geometry> surface(
      frame, thickness, [&](int b) { return run.motion(b); },
      [&](int b) { return run.body(b).is_gone; });
  std::vector<LiningNode<dim>> nodes;
  std::vector<Vec<dim>> places;
  for (std::size_t k = 0; k < frame.nodes.size(); ++k) {
    places.push_back(frame.nodes[k] + surface.shift(k));
    const double inertia = node_inertia(shares[k].mass, shares[k].length, thickness, is_pinned);
    nodes.push_back(
        {places.back(), surface.tiles(k), shares[k].mass, all_entries<dof - dim>(inertia)});
  }
  // Before the tiles: contacts of a body and a node are one only if all name the body first.
  for (const auto& fill : frame.fills) run.add_filling(fill.body, fill.shape);
  const int first = run.add_lining_nodes(nodes, interface_law);
  std::vector<int> numbers(nodes.size());
  std::iota(numbers.begin(), numbers.end(), first);
  auto lining = std::make_shared<LiningMembers<Geometry>>(
      lining_elements<Lining>(frame, sections, places, numbers, [&](int) { return is_pinned; }),
      first, static_cast<int>(nodes.size()), frame.centre);
  run.add_support(lining);
  if (!feet) return lining;
  std::vector<LiningFootSpring<dim>> springs;
  for (const LiningEnd<Geometry>& end : frame.ends) {
    if (end.body >= 0 && run.body(end.body).is_gone) continue;  // the end hangs free
    LiningFootSpring<dim> spring = foot_spring(end, first + end.node, *feet);
    const auto k = static_cast<std::size_t>(end.node);
    spring.arm_node = end.place - frame.nodes[k];
    const Pose<dim> rock = run.pose(end.body);
    spring.arm_rock =
        transposed_product(rock.rotation, Vec<dim>(end.place + surface.shift(k) - rock.position));
    springs.push_back(spring);
  }
  run.add_support(std::make_shared<LiningFeet<dim>>(*feet, std::move(springs)));
  return lining;
}

}  // namespace voussoir
