// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
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
  /// Rollers push as hard as they must, at right angles; elastic ground bears any force: how much
  /// they do hangs on how far the rock moves, which rigid blocks do not tell. What the model does
  /// is
  /// among that: the bound is one.
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
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LimitProblem
limit_problem_of(const Tunnel& tunnel, const LawsBySet<AnyJoint>& joint_laws,
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
[[nodiscard]] std::array<Vec2, 2> ends_of(const Group& group, const ReferenceContact<2>& contact,
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
  return {middle - half, middle + half};
}

/// What the edges of the domain do to the blocks there.
inline void add_edges(const Tunnel& tunnel, SideForces sides, LimitProblem& problem) {
  const auto& mass = tunnel.mass();
  const auto& system = tunnel.system();
  const auto is_base = [](const Vec2& outward) { return outward.y() < -0.5; };
  for (const ReferenceContact<2>& c : system.boundary.contacts()) {
    // The ground is the other body, on either side once contacts have been updated.
    const bool is_a = c.b == tunnel.ground();
    const int body = is_a ? c.a : c.b;
    const Vec2 outward = is_a ? c.normal : Vec2(-c.normal);
    if (sides == SideForces::in_situ && !is_base(outward)) continue;
    const Vec2 centre =
        problem.blocks[static_cast<std::size_t>(body)].centre + (is_a ? c.arm_a : c.arm_b);
    const auto ends = ends_of(system.boundary, c, centre);
    problem.edges.push_back({body, ends[0], ends[1], outward});
  }
  for (const auto& [body, facet, side] : boundary_facets(mass)) {
    LimitProblem::Block& block = problem.blocks[static_cast<std::size_t>(body)];
    const Boundary meets = tunnel.far_field().at(side);
    const bool is_any = sides == SideForces::any || side == Side::bottom;
    if (!block.is_free) continue;
    // The load on a block has the in-situ stress of its edges but for that across rollers.
    if (meets == Boundary::elastic && is_any) block.is_free = false;
    if (meets != Boundary::rollers || is_any) continue;
    const Vec2 outward = facet.area_vector().normalized();
    for (const FacetPoint<2>& p : facet.gauss_points()) {
      const Vec2 place = facet.centre() + p.offset;
      const Stress<2> stress = tunnel.in_situ().stress<2>(mass.domain.depth(place));
      const Vec2 force = -p.weight * outward.dot(stress * outward) * outward;
      block.load.force += force;
      block.load.moment += moment_of(Vec2(place - system.body(body).centre), force);
    }
  }
}

}  // namespace detail

VOUSSOIR_DESIGN_INLINE LimitProblem limit_problem_of(const Tunnel& tunnel,
                                                     const LawsBySet<AnyJoint>& joint_laws,
                                                     SideForces sides) {
  if (tunnel.bolt_count() > 0 || tunnel.lining() != nullptr)
    throw InvalidInput(
        "limit load: must be of rock without bolts and linings, whose strength it does not know");
  LimitProblem problem;
  const auto& system = tunnel.system();
  std::vector<JointStrength> strengths;
  for (const AnyJoint& law : joint_laws.all()) strengths.push_back(strength_of(law));
  for (int b = 0; b < tunnel.ground(); ++b) {
    const auto& body = system.body(b);
    const auto load = system.load_on(b);
    problem.blocks.push_back({system.pose_at_update(b).position,
                              body.weight,
                              body.gyration,
                              {Vec2(load[0], load[1]), Spin<2>(load[2])},
                              body.movable});
  }
  for (const ReferenceContact<2>& c : system.joints.contacts()) {
    const Vec2 centre = problem.blocks[static_cast<std::size_t>(c.a)].centre + c.arm_a;
    const auto ends = detail::ends_of(system.joints, c, centre);
    problem.contacts.push_back({c.a, c.b, ends[0], ends[1], c.normal, strengths[c.law]});
  }
  detail::add_edges(tunnel, sides, problem);
  return problem;
}

#endif

}  // namespace voussoir::design
