// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/edge_slabs.hpp>
#include <voussoir/rockmass/in_situ.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// How rock is brought to its in-situ stress by a simulation.
struct GenerationSettings {
  double segment = 1;             ///< of the sides, each pushed by its share of the stress [m], > 0
  double local_damping = 0.7;     ///< meanwhile [-]
  double unbalance = 1e-2;        ///< over the weight of the worst block, at which it ends [-], > 0
  double longest = 20;            ///< it is given up [s], > 0
  double smallest_piece = 0.074;  ///< at the wall; those below are left out [m^2], as in `carve`
};

/// Rock under gravity, with the rock of the opening still in it: ready to be excavated.
template <class JointLaw>
struct GeneratedRock {
  Dynamics<2, JointLaw> run;
  RockMass<Planar> mass;    ///< as sliced and carved; block b of it is body b of the run
  std::vector<int> inside;  ///< bodies in the opening
  std::vector<int> sides;   ///< bodies that push on the sides
  double unbalance = 0;     ///< left at the end, over the weight of the worst block [-]

  /// Holds the sides where they are, so that an excavation unloads against them.
  void fix_sides() {
    for (const int b : sides) run.fix(b);
  }
  /// Takes out the rock of the opening at once.
  void excavate() {
    for (const int b : inside) run.remove(b);
  }
};

/// Lets gravity and forces on the sides press a rock mass together from zero stress, as the paper
/// did: smooth base, sides in smooth segments that follow the rock with K0 times the vertical
/// stress of their depth.
///
/// The rock moves by decimetres on the way (its stress over its modulus times its size), slips, and
/// ends with stresses that scatter from block to block; `moving_rock` prescribes them instead.
/// @param loading  the law of all joints meanwhile: its friction should be the least that the
///                 stress needs (`InSitu::required_friction_angle`), lest shear stays in the joints
/// @throws InvalidInput    a value out of range; the opening does not fit or is not convex
/// @throws NumericalFault  the run went bad, or there is no rest after `longest`
/// @cost   some 10 s for 2 000 blocks
template <class JointLaw>
[[nodiscard]] GeneratedRock<JointLaw> generation_stage(
    const RockMass<Planar>& sliced, const SimplePolygon& opening, const JointLaw& loading,
    const InSitu& in_situ, DynamicsSettings settings = {}, const GenerationSettings& how = {}) {
  in_situ.check();
  require(how.segment > 0, "segment of the sides", how.segment, "> 0 m");
  require(how.unbalance > 0, "out-of-balance force ratio at the end of the generation",
          how.unbalance, "> 0");
  require(how.longest > 0, "longest generation", how.longest, "> 0 s");
  settings.gravity = in_situ.gravity;
  settings.local_damping = how.local_damping;
  const Domain<2>& domain = sliced.domain;
  GeneratedRock<JointLaw> rock{
      Dynamics<2, JointLaw>(loading, settings), carve(sliced, opening, how.smallest_piece), {}, {}};
  auto& run = rock.run;
  for (const auto& body : rock.mass.bodies) run.add_block(body.parts, in_situ.density);
  for (const auto& body : sliced.bodies)
    for (const ConvexPolygon& part : body.parts) {
      std::optional<ConvexPolygon> piece = part;
      for (std::size_t k = 0; piece && k < opening.size(); ++k) {
        const Segment edge = opening.edge(k);
        const Vec2 outward = -normalized(perpendicular(edge.end - edge.start));
        if (dot_product(opening.edge(k + 1 == opening.size() ? 0 : k + 1).end, outward) >
            dot_product(edge.end, outward) + domain.tolerance())
          throw InvalidInput("generation stage: the opening is not convex");
        const auto side = HalfSpace<2>::through(edge.start, outward);
        const auto parts = piece->split(side, 0, domain.tolerance());
        if (parts)
          piece = parts->first;
        else if (side.distance(mass_properties(*piece).centroid) > 0)
          piece.reset();
      }
      if (piece && mass_properties(*piece).measure > 0.1 * how.smallest_piece)
        rock.inside.push_back(run.add_block(*piece, in_situ.density));
    }
  run.add_wall(edge_slabs(domain)[2]);  // below
  const double height = domain.size().y();
  const int count = std::max(1, static_cast<int>(std::lround(height / how.segment)));
  const double thickness = how.segment;
  for (const bool right : {false, true})
    for (int k = 0; k < count; ++k) {
      const double low = domain.low.y() + height * k / count,
                   high = domain.low.y() + height * (k + 1) / count,
                   x = right ? domain.high.x() : domain.low.x() - thickness;
      const Domain<2> slab{{x, low}, {x + thickness, high}};
      const int b = run.add_wall(as_block(slab), in_situ.density);
      const double depth = domain.depth(Vec2(x, 0.5 * (low + high)));
      const double push = in_situ.stress<2>(depth)(0, 0) * (high - low);
      run.add_load(b, {right ? -push : push, run.body(b).mass * in_situ.gravity});
      rock.sides.push_back(b);
    }
  if (in_situ.surcharge > 0)
    for (const auto& f : boundary_facets(rock.mass))
      if (f.side == SideOf<2>::top) {
        const Vec2 push = -in_situ.surcharge * f.facet.area_vector();
        run.add_load(f.body, push, moment_of(f.facet.centre_from(run.position(f.body)), push));
      }
  while (true) {
    run.advance(0.1);
    rock.unbalance = run.unbalance_over_weight();
    if (rock.unbalance < how.unbalance) break;
    if (run.time() > how.longest)
      throw NumericalFault("generation stage: after " + message_number(run.time(), 3) +
                           " s a block is out of balance by " + message_number(rock.unbalance, 3) +
                           " of its weight, more than " + message_number(how.unbalance, 3));
  }
  return rock;
}

}  // namespace voussoir
