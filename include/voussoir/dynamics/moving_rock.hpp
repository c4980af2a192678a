// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/geometry/slab_behind.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/lining/lining_frame.hpp>
#include <voussoir/model/bolt_crossings.hpp>
#include <voussoir/model/bolt_set.hpp>
#include <voussoir/model/lining_members.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/edge_slabs.hpp>
#include <voussoir/rockmass/in_situ.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

namespace detail {

/// The edge of the domain is smooth: where the in-situ stress has shear on it, that goes on acting
/// as a load, as at rest.
template <class Run>
void add_edge_shear(Run& run, const RockMass<Spatial>& mass, const InSitu& in_situ) {
  for (const auto& f : boundary_facets(mass)) {
    const Vec3 normal = f.facet.area_vector().normalized();
    const Vec3 centre = run.position(f.body), middle = f.facet.centre_from(centre);
    for (const FacetPoint<3>& p : f.facet.gauss_points()) {
      const Vec3 arm = middle + p.offset;
      const Vec3 traction = in_situ.stress<3>(mass.domain.depth(Vec3(centre + arm))) * normal;
      const Vec3 push = -p.weight * (traction - normal.dot(traction) * normal);
      if (push.squaredNorm() > 0) run.add_load(f.body, push, moment_of(arm, push));
    }
  }
}

}  // namespace detail

/// A rock mass whose blocks can move by any amount, in its in-situ stress, nothing moved yet.
///
/// What an opening carved out of it has taken away is put back as a load on its wall
/// (`Dynamics::hold`); `set_held(0)` takes it off at once. Block b of the mass is body b.
///
/// @tparam InterfaceLaw  of the linings that it may get
template <class InterfaceLaw = CoulombJoint, class Geometry, class JointLaw>
[[nodiscard]] Dynamics<Geometry::dim, JointLaw, InterfaceLaw> moving_rock(
    const RockMass<Geometry>& mass, const LawsBySet<JointLaw>& laws, const InSitu& in_situ,
    DynamicsSettings settings = {}) {
  constexpr int dim = Geometry::dim;
  in_situ.check();
  settings.gravity = in_situ.gravity;
  Dynamics<dim, JointLaw, InterfaceLaw> run(
      laws, laws.all().size() > 1 ? laws.of_cuts(mass) : std::vector<int>{}, settings);
  for (const auto& body : mass.bodies) run.add_block(body.parts, in_situ.density);
  for (const auto& slab : edge_slabs(mass.domain)) run.add_wall(slab);
  if (in_situ.surcharge > 0)
    for (const auto& f : boundary_facets(mass))
      if (f.side == SideOf<dim>::top) {
        const Vec<dim> push = -in_situ.surcharge * f.facet.area_vector();
        run.add_load(f.body, push, moment_of(f.facet.centre_from(run.position(f.body)), push));
      }
  if constexpr (dim == 3) detail::add_edge_shear(run, mass, in_situ);
  run.prescribe(
      [&](const Vec<dim>& point) { return in_situ.template stress<dim>(mass.domain.depth(point)); },
      10 * mass.domain.tolerance());
  run.hold();
  return run;
}

template <class InterfaceLaw = CoulombJoint, class Geometry, class JointLaw>
[[nodiscard]] Dynamics<Geometry::dim, JointLaw, InterfaceLaw> moving_rock(
    const RockMass<Geometry>& mass, const JointLaw& law, const InSitu& in_situ,
    DynamicsSettings settings = {}) {
  return moving_rock<InterfaceLaw>(mass, LawsBySet<JointLaw>(law), in_situ, settings);
}

/// Installs bolts in the rock as it lies now, free of force but for their pretension.
/// @param run     made from the same mass, whose body b is its body b
/// @param bars    where the rock was sliced; a bar has moved with every block that it passes
/// @param spacing  between bolts along the tunnel (2-D) [m], > 0
/// @return  the bolts, which the run holds too: forces are read there
/// @throws InvalidInput  spacing out of range, or a bar without length
template <class Geometry, class JointLaw, class InterfaceLaw, class BoltLaw, class Anchors>
std::shared_ptr<BoltSet<Geometry::dim, BoltLaw>> add_bolts(
    Dynamics<Geometry::dim, JointLaw, InterfaceLaw>& run, const RockMass<Geometry>& mass,
    const std::vector<typename Geometry::Line>& bars, const BoltLaw& law, double spacing,
    const Anchors& anchors) {
  constexpr int dim = Geometry::dim;
  static_assert(explain_bolt_law<BoltLaw, dim>());
  require(spacing > 0 && std::isfinite(spacing), "bolt spacing along the tunnel", spacing, "> 0 m");
  auto bolts = std::make_shared<BoltSet<dim, BoltLaw>>(law);
  int number = 0;
  for (const auto& bar : bars) {
    require(bar.length() > 0 && std::isfinite(bar.length()), "bolt length", bar.length(), "> 0 m");
    const Vec<dim> axis = (bar.end - bar.start) / bar.length();
    for (const auto& at :
         bolt_crossings(block_intersections(mass, bar), bar, anchors, mass.domain.tolerance())) {
      const Pose<dim> a = run.home(at.a), b = run.home(at.b);
      const auto in = [](const Pose<dim>& pose, const Vec<dim>& p) {
        return transposed(pose.rotation) * (p - pose.position);
      };
      typename BoltSet<dim, BoltLaw>::Spring spring{};
      spring.a = at.a;
      spring.b = at.b;
      spring.bolt = number;
      spring.position = at.position;
      spring.arm_a = in(a, at.joint_a - at.before * axis);
      spring.arm_b = in(b, at.joint_b + at.after * axis);
      spring.joint_a = in(a, at.joint_a);
      spring.joint_b = in(b, at.joint_b);
      spring.span.initial = transposed(a.rotation) * at.initial;
      if (run.steps() > 0)
        spring.span.initial = transposed(run.pose(at.a).rotation) *
                              (run.pose(at.b)(spring.arm_b) - run.pose(at.a)(spring.arm_a));
      spring.span.axis = transposed(a.rotation) * axis;
      spring.span.motion = zeros<Vec<dim>>();
      spring.share = dim == 2 ? 1 / spacing : 1;
      bolts->add(spring);
    }
    ++number;
  }
  run.add_support(bolts);
  return bolts;
}

namespace detail {

/// A facet as it is after a motion.
[[nodiscard]] inline Segment moved(const Segment& facet, const Pose<2>& motion) {
  return {motion(facet.start), motion(facet.end)};
}
[[nodiscard]] inline SpatialFacet moved(SpatialFacet facet, const Pose<3>& motion) {
  for (Vec3& v : facet.vertices) v = motion(v);
  return facet;
}

/// What rock touches of a lining that is installed now, node by node, and how far a node has come
/// with the wall.
///
/// On rock lies a slab for every piece of wall, as sprayed; where rock is missing, or is further
/// away than the thickness, a slab on the whole panel of the node, set back by a fifth of the
/// thickness so that what touches the one does not touch the other.
template <class Geometry, class Run>
class LiningTiles {
  static constexpr int dim = Geometry::dim;

 public:
  using Shape = typename Run::Shape;

  LiningTiles(const Run& run, const LiningFrame<Geometry>& frame, double thickness)
      : tiles_(frame.nodes.size()), shift_(frame.nodes.size(), zeros<Vec<dim>>()) {
    std::vector<double> covered(frame.nodes.size(), 0.0), whole(frame.nodes.size(), 0.0);
    for (const auto& c : frame.contacts) {
      const Pose<dim> motion = run.motion(c.body);
      const auto facet = moved(c.facet, motion);
      if (run.body(c.body).is_gone || (facet.centre() - c.facet.centre()).norm() > thickness)
        continue;
      const auto k = static_cast<std::size_t>(c.node);
      covered[k] += facet.measure();
      shift_[k] += facet.measure() * (motion(frame.nodes[k]) - frame.nodes[k]);
      tiles_[k].push_back(slab_behind(facet, thickness));
    }
    for (std::size_t k = 0; k < shift_.size(); ++k)
      if (covered[k] > 0) shift_[k] /= covered[k];
    for (const auto& panel : frame.panels)
      whole[static_cast<std::size_t>(panel.node)] += panel.facet.measure();
    for (const auto& panel : frame.panels) {
      const auto k = static_cast<std::size_t>(panel.node);
      if (covered[k] > 0.99 * whole[k]) continue;
      Pose<dim> back;
      back.position = shift_[k] - 0.2 * thickness * panel.facet.area_vector().normalized();
      tiles_[k].push_back(slab_behind(moved(panel.facet, back), 0.8 * thickness));
    }
  }

  [[nodiscard]] const std::vector<Shape>& tiles(std::size_t node) const { return tiles_[node]; }
  [[nodiscard]] const Vec<dim>& shift(std::size_t node) const { return shift_[node]; }

 private:
  std::vector<std::vector<Shape>> tiles_;
  std::vector<Vec<dim>> shift_;
};

}  // namespace detail

/// Installs a lining on the wall as it lies now, free of force.
///
/// Its nodes become bodies of the run. Their mass is that of the sections, their moment of inertia
/// that of a tile; rock touches tiles of the thickness given, and may land on them.
/// @param frame      of the mass from which the run was made
/// @param interface_law  rock on lining
/// @param thickness  [m], > 0
/// @return  the lining, which the run holds too: forces are read there
/// @throws InvalidInput  a thickness or mass out of range; a member without
///                       length or section; no rock at the wall
template <class Lining, class Geometry, class JointLaw, class InterfaceLaw>
std::shared_ptr<LiningMembers<Geometry>> add_lining(
    Dynamics<Geometry::dim, JointLaw, InterfaceLaw>& run, const LiningFrame<Geometry>& frame,
    const std::vector<LiningSection>& sections, const InterfaceLaw& interface_law,
    double thickness) {
  constexpr int dim = Geometry::dim, dof = Geometry::dof;
  static_assert(explain_lining_model<Lining, dof>());
  require(thickness > 0 && std::isfinite(thickness), "thickness of the lining", thickness, "> 0 m");
  if (frame.contacts.empty()) throw InvalidInput("lining: no rock touches it");
  for (const LiningSection& section : sections)
    require(section.mass > 0 && std::isfinite(section.mass), "mass of a lining that moves",
            section.mass, "> 0 kg per metre of it");
  constexpr bool is_pinned = is_pinned_lining<Lining>();
  const std::vector<LiningNodeShare> shares = node_shares(frame, sections);
  const detail::LiningTiles<Geometry, std::remove_reference_t<decltype(run)>> tiles(run, frame,
                                                                                    thickness);
  std::vector<LiningNode<dim>> nodes;
  for (std::size_t k = 0; k < frame.nodes.size(); ++k) {
    const double length = shares[k].length;
    // A pin is pushed by the rock in its middle: it is given no reason to turn.
    const double inertia =
        shares[k].mass * (length * length + thickness * thickness) / 12 * (is_pinned ? 1e12 : 1.0);
    nodes.push_back({frame.nodes[k] + tiles.shift(k), tiles.tiles(k), shares[k].mass,
                     all_entries<dof - dim>(inertia)});
  }
  std::vector<FrameElement<Geometry>> members;
  const int first = run.body_count();
  for (const auto& member : frame.members) {
    const Vec<dim> along = nodes[static_cast<std::size_t>(member.second)].place -
                           nodes[static_cast<std::size_t>(member.first)].place;
    const LiningSection& section = sections[static_cast<std::size_t>(member.section)];
    ElementMatrix<dof> stiffness = Lining::template stiffness<dof>(section, along.norm());
    if (is_pinned)
      for (int row = 0; row < 2 * dof; ++row)
        if (row % dof >= dim) set_row(stiffness, row, all_entries<2 * dof>(0));
    members.push_back({first + member.first, first + member.second, along.norm(),
                       frame_axes<dim>(along, member.outward), stiffness});
  }
  run.add_lining_nodes(nodes, interface_law);
  auto lining = std::make_shared<LiningMembers<Geometry>>(std::move(members), first,
                                                          static_cast<int>(nodes.size()));
  run.add_support(lining);
  return lining;
}

}  // namespace voussoir
