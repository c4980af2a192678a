// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>
#include <voussoir/contact/any_joint.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/limit_load.hpp>
#include <voussoir/design/models.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/model/reference_contact.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>

/// The blocks of a tunnel, or laid ones, as limit analysis sees them.
namespace voussoir::design {

/// What a joint bears before it slips for the first time: no less than it does later.
/// @throws InvalidInput  of a law whose strength is no sum of friction and cohesion
[[nodiscard]] VOUSSOIR_DESIGN_INLINE JointStrength strength_of(const AnyJoint& joint);

/// What the sides of a model can do, the base apart, which bears what it must.
enum class SideForces {
  /// Rollers push as hard as they must, at right angles; elastic ground bears any force. How hard
  /// they do hangs on how far the rock moves, which rigid blocks do not tell. What the model does
  /// is among it: the bound is one.
  any,
  /// They push as in situ and no harder. A bound where the in-situ stress goes on acting, and an
  /// estimate elsewhere: rock that arches may press its sides harder.
  in_situ
};

/// Blocks, their contacts where they were last updated and what acts on them now: weight,
/// surcharge, loads, the residual wall traction: the equilibrium that the solver has found is one
/// of its states. Blocks that have fallen are left out; fixed ones bear any force.
/// @param joint_laws  whose strength is to be divided, in the place of those of the tunnel
/// @throws InvalidInput  it has bolts or linings; a law has no such strength
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LimitProblem<2> limit_problem_of(
    const Tunnel& tunnel, const LawsBySet<AnyJoint>& joint_laws,
    SideForces sides = SideForces::any);
/// In 3-D.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LimitProblem<3> limit_problem_of(
    const SpatialTunnel& tunnel, const LawsBySet<AnyJoint>& joint_laws,
    SideForces sides = SideForces::any);

#if VOUSSOIR_DESIGN_BODIES

VOUSSOIR_DESIGN_INLINE JointStrength strength_of(const AnyJoint& joint) {
  return joint.visit([](const auto& law) -> JointStrength {
    using Law = std::decay_t<decltype(law)>;
    if constexpr (std::is_same_v<Law, CoulombJoint>) {
      return {law.friction_coefficient(), 0, 0};
    } else if constexpr (std::is_same_v<Law, MohrCoulombJoint>) {
      const auto& p = law.params();
      return {elementary::tangent(p.friction_angle), p.cohesion, p.tensile_strength};
    } else if constexpr (std::is_same_v<Law, BurgersJoint>) {
      return {elementary::tangent(law.params().friction_angle), 0, 0};
    } else {
      throw InvalidInput(message({"limit load: the strength of ", law.name,
                                  " is no sum of friction and cohesion; must be CoulombJoint, "
                                  "MohrCoulombJoint or BurgersJoint"}));
    }
  });
}

namespace detail {

/// The ends of a contact, from its two points: those of Gauss, or its corners where blocks have
/// turned against each other.
/// @param centre  of its area
template <class Group>
[[nodiscard]] std::vector<std::vector<Vec2>> facets_of(const Group& group,
                                                       const ReferenceContact<2>& contact,
                                                       const Vec2& centre) {
  ReferencePoint<2> low, high;
  double length = 0;
  for (int k = contact.first; k < contact.last(); ++k) {
    const ReferencePoint<2> point = group.points().place(static_cast<std::size_t>(k));
    if (k == contact.first || point.offset[1] < low.offset[1]) low = point;
    if (k == contact.first || point.offset[1] > high.offset[1]) high = point;
    length += point.weight;
  }
  const bool is_corners = high.offset[1] - low.offset[1] >= length * (1 - 1e-9);
  const Vec2 from = contact.offset_of(low), to = contact.offset_of(high),
             middle = centre + 0.5 * (from + to),
             half = (is_corners ? 0.5 : 0.5 * std::sqrt(3.0)) * (to - from);
  return {{middle - half, middle + half}};
}

/// The corners of its facets, from its outline, which counts them from the centre in parts of its
/// first and third point (see `ContactOutline`). Without one the points are what there is: corners
/// where blocks have turned against each other, or those of an area no wider than a line.
template <class Group>
[[nodiscard]] std::vector<std::vector<Vec3>> facets_of(const Group& group,
                                                       const ReferenceContact<3>& contact,
                                                       const Vec3& centre) {
  const auto arm = [&](int k) {
    return contact.offset_of(group.points().place(static_cast<std::size_t>(contact.first + k)));
  };
  std::vector<std::vector<Vec3>> facets(1);
  if (contact.outline.edges == nullptr) {
    for (int k = 0; k < contact.count; ++k) facets[0].push_back(centre + arm(k));
    return facets;
  }
  const Vec3 along = arm(0) / std::sqrt(2.0), across = arm(2) / std::sqrt(2.0);
  const std::vector<ContactOutline::Edge>& edges = contact.outline.edges->edges;
  const auto meet = [](const double(&p)[2], const double(&q)[2]) {
    return std::hypot(p[0] - q[0], p[1] - q[1]) <= 1e-9;
  };
  for (std::size_t k = 0, first = 0; k < edges.size(); ++k) {
    facets.back().push_back(centre + edges[k].from[0] * along + edges[k].from[1] * across);
    // Facets follow one another, each all the way round, this way or that.
    const bool forward = first + 1 < edges.size() && meet(edges[first].to, edges[first + 1].from);
    const bool closes =
        forward ? meet(edges[k].to, edges[first].from) : meet(edges[k].from, edges[first].to);
    if (!closes || k + 1 == edges.size()) continue;
    first = k + 1;
    facets.emplace_back();
  }
  return facets;
}

/// What the edges of the domain do to the blocks there.
template <int Dim, class TunnelType>
void add_edges(const TunnelType& tunnel, SideForces sides, LimitProblem<Dim>& problem) {
  const auto& mass = tunnel.mass();
  const auto& system = tunnel.system();
  const auto is_base = [](const Vec<Dim>& outward) { return outward[Dim - 1] < -0.5; };
  for (const ReferenceContact<Dim>& c : system.boundary.contacts()) {
    // The ground is the other body, on either side once contacts have been updated.
    const bool is_a = c.b == tunnel.ground();
    const int body = is_a ? c.a : c.b;
    const Vec<Dim> outward = is_a ? c.normal : Vec<Dim>(-c.normal);
    if (sides == SideForces::in_situ && !is_base(outward)) continue;
    const Vec<Dim> centre =
        problem.blocks[static_cast<std::size_t>(body)].centre + (is_a ? c.arm_a : c.arm_b);
    for (const auto& facet : facets_of(system.boundary, c, centre))
      problem.add_edge(body, facet, outward);
  }
  for (const auto& [body, facet, side] : boundary_facets(mass)) {
    auto& block = problem.blocks[static_cast<std::size_t>(body)];
    const Boundary meets = tunnel.far_field().at(side);
    const bool is_any = sides == SideForces::any || side == SideOf<Dim>::bottom;
    if (!block.is_free) continue;
    // The load on a block has the in-situ stress of its edges but for that across rollers.
    if (meets == Boundary::elastic && is_any) block.is_free = false;
    if (meets != Boundary::rollers || is_any) continue;
    const Vec<Dim> outward = facet.area_vector().normalized();
    for (const FacetPoint<Dim>& p : facet.gauss_points()) {
      const Vec<Dim> place = facet.centre() + p.offset;
      const Stress<Dim> stress = tunnel.in_situ().template stress<Dim>(mass.domain.depth(place));
      const Vec<Dim> force = -p.weight * outward.dot(stress * outward) * outward;
      block.load.force += force;
      block.load.moment += moment_of(Vec<Dim>(place - system.body(body).centre), force);
    }
  }
}

template <int Dim, class TunnelType>
[[nodiscard]] LimitProblem<Dim> problem_of(const TunnelType& tunnel,
                                           const LawsBySet<AnyJoint>& joint_laws,
                                           SideForces sides) {
  if (tunnel.bolt_count() > 0 || tunnel.lining() != nullptr)
    throw InvalidInput(
        "limit load: must be of rock without bolts and linings, whose strength it does not know");
  LimitProblem<Dim> problem;
  const auto& system = tunnel.system();
  std::vector<JointStrength> strengths;
  for (const AnyJoint& law : joint_laws.all()) strengths.push_back(strength_of(law));
  for (int b = 0; b < tunnel.ground(); ++b) {
    const auto& body = system.body(b);
    const auto load = system.load_on(b);
    problem.blocks.push_back({system.pose_at_update(b).position,
                              body.weight,
                              body.gyration,
                              {part<Dim>(load, 0), part<spin_count<Dim>>(load, Dim)},
                              body.movable});
  }
  for (const ReferenceContact<Dim>& c : system.joints.contacts()) {
    const Vec<Dim> centre = problem.blocks[static_cast<std::size_t>(c.a)].centre + c.arm_a;
    for (const auto& facet : facets_of(system.joints, c, centre))
      problem.add_contact(c.a, c.b, facet, c.normal, strengths[c.law]);
  }
  add_edges<Dim>(tunnel, sides, problem);
  return problem;
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE LimitProblem<2> limit_problem_of(const Tunnel& tunnel,
                                                        const LawsBySet<AnyJoint>& joint_laws,
                                                        SideForces sides) {
  return detail::problem_of<2>(tunnel, joint_laws, sides);
}
VOUSSOIR_DESIGN_INLINE LimitProblem<3> limit_problem_of(const SpatialTunnel& tunnel,
                                                        const LawsBySet<AnyJoint>& joint_laws,
                                                        SideForces sides) {
  return detail::problem_of<3>(tunnel, joint_laws, sides);
}

#endif

}  // namespace voussoir::design
