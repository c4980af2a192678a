// SPDX-License-Identifier: MIT
#pragma once

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

/// Blocks, their contacts in the in-situ state and what acts on them now: weight, surcharge, loads,
/// the residual wall traction. Blocks that have fallen are left out; fixed ones bear any force.
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

/// What the edges of the domain do to the blocks there.
inline void add_edges(const Tunnel& tunnel, SideForces sides, LimitProblem& problem) {
  const auto& mass = tunnel.mass();
  for (const auto& [body, facet, side] : boundary_facets(mass)) {
    LimitProblem::Block& block = problem.blocks[static_cast<std::size_t>(body)];
    const Boundary meets = tunnel.far_field().at(side);
    // The load on a block has the in-situ stress of its edges but for that across rollers.
    if (!block.is_free || meets == Boundary::stress) continue;
    const Vec2 outward = facet.area_vector().normalized();
    if (sides == SideForces::any || side == Side::bottom) {
      if (meets == Boundary::rollers)
        problem.edges.push_back({body, facet.start, facet.end, outward});
      else
        block.is_free = false;
    } else if (meets == Boundary::rollers) {
      for (const FacetPoint<2>& p : facet.gauss_points()) {
        const Vec2 place = facet.centre() + p.offset;
        const Stress<2> stress = tunnel.in_situ().stress<2>(mass.domain.depth(place));
        const Vec2 force = -p.weight * outward.dot(stress * outward) * outward;
        block.load.force += force;
        block.load.moment += moment_of(Vec2(place - block.centre), force);
      }
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
  const auto& mass = tunnel.mass();
  std::vector<JointStrength> strengths;
  for (const AnyJoint& law : joint_laws.all()) strengths.push_back(strength_of(law));
  const std::vector<int> law_of_cut = joint_laws.of_cuts(mass);
  for (int b = 0; b < tunnel.ground(); ++b) {
    const auto& body = system.body(b);
    const auto load = system.load_on(b);
    problem.blocks.push_back({body.centre,
                              body.weight,
                              body.gyration,
                              {Vec2(load[0], load[1]), Spin<2>(load[2])},
                              body.movable});
  }
  const auto is_gone = [&](int b) { return system.body(b).is_gone; };
  for (const auto& contact : CutContacts::find(mass)) {
    if (is_gone(contact.a) || is_gone(contact.b)) continue;
    const int law = contact.cut >= 0 ? law_of_cut[static_cast<std::size_t>(contact.cut)] : 0;
    problem.contacts.push_back({contact.a, contact.b, contact.facet.start, contact.facet.end,
                                contact.facet.area_vector().normalized(),
                                strengths[static_cast<std::size_t>(law)]});
  }
  detail::add_edges(tunnel, sides, problem);
  return problem;
}

#endif

}  // namespace voussoir::design
