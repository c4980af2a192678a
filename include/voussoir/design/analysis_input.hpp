// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>
#include <voussoir/contact/any_joint.hpp>
#include <voussoir/contact/laws_by_set.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/design/bodies.hpp>
#include <voussoir/design/ground_input.hpp>
#include <voussoir/design/support_input.hpp>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/linear/linear_method.hpp>
#include <voussoir/rockmass/in_situ.hpp>
#include <voussoir/tunnel/opening.hpp>

namespace voussoir::design {

enum class MethodKind { two_level, relaxation, explicit_ };

/// How equilibrium is sought.
struct RunInput {
  MethodKind method = MethodKind::two_level;
  LinearMethod linear_solver = LinearMethod::automatic;  ///< of elastic equations
  double tolerance = 1e-3;  ///< accepted error estimate [-], 1e-6 to 0.1
  /// Accepted of the worst block over its weight [-], > 0, <= 0.1.
  double out_of_balance = 1e-2;
  /// A block that moved further has come off [m], > 0.
  double displacement_limit = by_the_rock;
  /// Moved so far, contacts are updated [m], > 0.
  double contact_update_limit = by_the_rock;
  double damping = 0.7;   ///< local damping, explicit only [-], 0 to 0.95
  int ramp_steps = 8000;  ///< steps over which the wall is unloaded, explicit only; 0 = at once
  std::optional<std::int64_t> max_steps;  ///< > 0
};

/// A load on the block of rock in which a point lies: a hanger, a prop, a footing.
struct LoadInput {
  Vec2 at = Vec2::Zero();  ///< where the force acts: of the section, from the tunnel's centre [m]
  double place = 0;        ///< 3-D: along the axis of the tunnel, 0 or more [m]
  /// 2-D: to the right and up [N/m]. 3-D: to the right, along the model, up [N].
  Vec3 force = Vec3::Zero();
  /// 2-D: the first, anticlockwise [N m/m]. 3-D: about these axes, right-handed [N m].
  Vec3 moment = Vec3::Zero();
  /// With which it comes on, after which nothing is excavated; none: the last, and in rounds along
  /// the tunnel the last advance.
  std::optional<std::size_t> stage = {};
};

/// A whole analysis of a tunnel in jointed rock, in 2-D or 3-D, as plain data: what the program
/// reads from a file, and what a program of one's own may fill in. `run_tunnel` and
/// `run_spatial_tunnel` compute it.
///
///   AnalysisInput input;
///   input.model.width = 70;
///   input.tunnel.diameter = 10;
///   ...
///   const auto run = run_tunnel(input);
struct AnalysisInput {
  ModelInput model;
  TunnelInput tunnel;
  std::vector<OpeningInput> openings;
  RockInput rock;
  StressInput stress;
  BoundaryInput boundary;
  std::vector<JointSetInput> joint_sets;
  TracesInput mapped;
  std::optional<AnyJoint> joint = {};  ///< of all joints whose set has no law of its own
  BlocksInput blocks;
  std::vector<BoltsInput> bolts;     ///< the first is what a diagram varies
  std::vector<LiningInput> linings;  ///< the first is what a diagram varies
  std::vector<StageInput> stages;    ///< never empty; the last leaves no traction on the wall
  /// Stages excavate the section in parts. Otherwise the first excavates all of it, and the others
  /// nothing.
  bool has_rounds = false;
  std::vector<LoadInput> loads;
  RunInput run;

  [[nodiscard]] bool is_spatial() const { return model.dimension == 3; }
  [[nodiscard]] double domain_top() const {  ///< y of the ground surface [m]
    return tunnel.crown() + tunnel.cover;
  }
  [[nodiscard]] double domain_bottom() const {  ///< y of the lower boundary [m]
    return tunnel.invert() - model.below_invert;
  }
  /// 3-D: of the tunnel in the domain, along its axis [m].
  [[nodiscard]] double tunnel_length() const {
    return model.length / elementary::cosine(tunnel.plunge);
  }
  /// 3-D: what is excavated at a time along the tunnel [m].
  [[nodiscard]] double stretch() const { return tunnel.round_length.value_or(tunnel_length()); }
  /// 3-D: how often, one behind the other.
  [[nodiscard]] int round_count() const {
    if (!tunnel.round_length) return 1;
    const double most = std::floor(tunnel_length() / *tunnel.round_length * (1 + 1e-9));
    return tunnel.rounds.value_or(static_cast<int>(std::clamp(most, 1.0, 1e9)));
  }
  /// Horizontal over vertical stress across the tunnel, without the constant part [-].
  [[nodiscard]] double K0_across() const {
    if (!stress.K0_minor) return stress.K0;
    // The section's right is a quarter turn clockwise from the tunnel.
    const double along = elementary::cosine(stress.K0_trend.value_or(0) - tunnel.trend.value_or(0));
    return stress.K0 + (*stress.K0_minor - stress.K0) * along * along;
  }
};

/// An outline about its own centre.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE SimplePolygon outline_of(const OutlineInput& outline);
/// That of the tunnel.
[[nodiscard]] inline SimplePolygon opening_of(const AnalysisInput& input) {
  return outline_of(input.tunnel);
}

/// The stress in situ; in 3-D with two horizontal principal stresses, if they are given.
[[nodiscard]] VOUSSOIR_DESIGN_INLINE InSitu in_situ_of(const AnalysisInput& input);

/// The law of all joints, and of those sets that differ.
/// @throws InvalidInput  there is none
[[nodiscard]] VOUSSOIR_DESIGN_INLINE LawsBySet<AnyJoint> laws_of(const AnalysisInput& input);

#if VOUSSOIR_DESIGN_BODIES

VOUSSOIR_DESIGN_INLINE SimplePolygon outline_of(const OutlineInput& outline) {
  switch (outline.shape) {
    case TunnelShape::circle:
      return circular_opening(outline.diameter, outline.facets);
    case TunnelShape::horseshoe:
      return horseshoe_opening(outline.width, outline.wall_height, outline.facets);
    case TunnelShape::polygon:
      return SimplePolygon(outline.vertices);
  }
  throw std::logic_error("unknown tunnel shape");
}

VOUSSOIR_DESIGN_INLINE InSitu in_situ_of(const AnalysisInput& input) {
  const StressInput& stress = input.stress;
  InSitu made{.density = input.rock.density,
              .k0 = input.K0_across(),
              .surcharge = stress.surcharge,
              .gravity = input.model.gravity};
  if (stress.K0_minor && input.is_spatial())
    made = made.with_horizontal(stress.K0, *stress.K0_minor,
                                stress.K0_trend.value_or(0) - input.tunnel.trend.value_or(0));
  return stress.horizontal > 0 ? made.with_constant_horizontal(stress.horizontal) : made;
}

VOUSSOIR_DESIGN_INLINE LawsBySet<AnyJoint> laws_of(const AnalysisInput& input) {
  if (!input.joint)
    throw InvalidInput("analysis: its joints have no law; must be given, `AnalysisInput::joint`");
  LawsBySet<AnyJoint> laws(*input.joint);
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k)
    if (const auto& own = input.joint_sets[k].law) laws.add(static_cast<int>(k), *own);
  return laws;
}

#endif

}  // namespace voussoir::design
