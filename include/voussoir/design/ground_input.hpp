// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/contact/any_joint.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/rockmass/mapped_traces.hpp>
#include <voussoir/rockmass/orientation.hpp>
#include <voussoir/rockmass/spacing_law.hpp>

/// The ground of an analysis as plain data: what is modelled, where it is opened, its joints, its
/// stress. What `AnalysisInput` is made of, with `support_input.hpp`.
///
/// SI and radians throughout. Axes of the section: x right, y up, both from the tunnel centre,
/// looking along the tunnel; angles anticlockwise from the right-hand springing. In 3-D the tunnel
/// runs along the second axis, from the face of the domain where it begins. A member without a
/// remark on its default must be set.
namespace voussoir::design {

enum class TunnelShape { circle, horseshoe, polygon };

/// The block of ground that is modelled.
struct ModelInput {
  int dimension = 2;           ///< 2: a section in plane strain; 3
  double length = 0;           ///< 3-D: along the tunnel [m], > 0
  double width = 0;            ///< of the whole domain, the tunnel in its middle [m], > 0
  double below_invert = 0;     ///< ground under the invert [m], > 0
  std::uint64_t seed = 1;      ///< of the random joints
  double gravity = 9.81;       ///< [m/s^2], 1 to 1000
  Vec2 origin = Vec2::Zero();  ///< site coordinates of the tunnel centre [m]
};

/// The outline of an opening. Its centre is that of the circle; of the roof's half circle for the
/// horseshoe (so the springing is at y = 0 and the floor at -wall_height); (0, 0) of the polygon.
struct OutlineInput {
  TunnelShape shape = TunnelShape::circle;
  double diameter = 0;     ///< circle [m], > 0
  double width = 0;        ///< horseshoe: between its walls, = diameter of its roof [m], > 0
  double wall_height = 0;  ///< horseshoe: floor to springing [m], > 0
  std::vector<Vec2> vertices = {};  ///< polygon: simple, anticlockwise [m]
  std::string drawn = {};  ///< how these were read from a drawing, in words; empty: they were not
  int facets = 72;         ///< chords on a full circle, for the curved parts, 12 to 720

  [[nodiscard]] double half_width() const {  ///< half the breadth of the opening [m]
    if (shape != TunnelShape::polygon)
      return shape == TunnelShape::circle ? diameter / 2 : width / 2;
    return vertices.empty() ? 0 : 0.5 * (most(0) + most(0, -1));
  }
  [[nodiscard]] double crown() const {  ///< y of the highest point [m]
    return shape != TunnelShape::polygon ? half_width() : most(1);
  }
  [[nodiscard]] double invert() const {  ///< y of the lowest point [m]
    if (shape == TunnelShape::polygon) return -most(1, -1);
    return shape == TunnelShape::circle ? -half_width() : -wall_height;
  }

 private:
  [[nodiscard]] double most(int axis, double sign = 1) const {
    double found = vertices.empty() ? 0 : sign * vertices.front()[axis];
    for (const Vec2& vertex : vertices) found = std::max(found, sign * vertex[axis]);
    return found;
  }
};

/// The first opening, in whose centre the model has its origin.
struct TunnelInput : OutlineInput {
  double cover = 0;  ///< crown to ground surface, where it begins [m], > 0
  /// Of its axis, clockwise from North [rad], 0 to 2 pi; none: to the North, and only "E" and "W"
  /// say where joints dip.
  std::optional<double> trend = {};
  double plunge = 0;  ///< of its axis below the horizontal [rad], -pi/4 to pi/4
  /// 3-D: it is driven in rounds of this length [m], > 0; none: its whole length at once.
  std::optional<double> round_length = {};
  /// 3-D: rounds driven, 1 to 1000; none: as many as the domain has room for.
  std::optional<int> rounds = {};
};

/// Another tunnel, a cross-drift, a shaft or a niche.
struct OpeningInput : OutlineInput {
  std::string name;
  Vec2 at = Vec2::Zero();  ///< of its centre, or of the point where its axis begins [m]
  double place = 0;        ///< 3-D: of that point along the tunnel [m]
  double turn = 0;         ///< of its axis against the tunnel's, clockwise from above [rad]
  /// Of its axis below the horizontal [rad], -pi/2 to pi/2; none: that of the tunnel for one that
  /// has no turn against it, else level.
  std::optional<double> plunge = {};
  /// 3-D: where it begins and ends along its axis [m]; none, of one along the tunnel: at the ends
  /// of the domain.
  std::optional<double> from = {}, to = {};
  std::optional<double> round_length = {};  ///< 3-D: of its own rounds [m]; none: all at once

  /// It runs beside the tunnel: the section shows its outline.
  [[nodiscard]] bool is_along_tunnel(const TunnelInput& tunnel) const {
    return turn == 0 && plunge.value_or(tunnel.plunge) == tunnel.plunge;
  }
};

struct RockInput {
  double density = 0;  ///< [kg/m^3], 1 to 1e5
};

/// In situ: vertical from depth, horizontal = K0 times vertical + a constant.
struct StressInput {
  double K0 = 0;  ///< horizontal / vertical [-], 0 to 10; with `K0_minor` of the major one
  std::optional<double> K0_minor = {};  ///< of the minor horizontal stress [-], 0 to K0
  std::optional<double> K0_trend =
      {};                 ///< of the major one, clockwise from North [rad], with `K0_minor`
  double horizontal = 0;  ///< constant, in all directions [Pa], 0 to 1e9
  double surcharge = 0;   ///< on the ground surface [Pa], 0 to 1e9
};

/// What the sides of the domain meet. Sides and base are given together. In 3-D there are rollers.
struct BoundaryInput {
  std::optional<Boundary> sides =
      {};  ///< none: rollers, or elastic where these would bias the closure
  std::optional<Boundary> base = {};  ///< the same; rollers or elastic
  bool ground_above = false;          ///< top: the ground goes on, the surcharge is its weight
  /// E of the ground beyond [Pa], 1e3 to 1e13; none: moduli are measured on the rock.
  std::optional<double> young_modulus = {};
  double poisson_ratio = 0;  ///< nu, with E [-], -1 < . < 0.5
};

/// One family of joints: random ones, of which exactly one of intensity, spacing, P32 and P30 is
/// given; or, with none, those that the mapped traces have of it.
struct JointSetInput {
  std::string name;
  Orientation plane{};                ///< as a compass reads it; of random joints
  bool is_azimuth = false;            ///< dip_direction is neither "E" nor "W"
  double sd = 0;                      ///< standard deviation of the dip [rad], 0 to pi/4
  std::optional<double> fisher = {};  ///< K, in place of sd [-], 5 to 1e6
  std::optional<double> intensity =
      {};  ///< trace centres per area of the section [1/m^2], > 0, <= 1e4
  std::optional<double> spacing = {};  ///< mean, across the joints [m], > 0
  /// Of joints that go right through, by their spacing; its standard deviation, lognormal [m], > 0.
  SpacingLaw spacing_law = SpacingLaw::fixed;
  std::optional<double> spacing_sd = {};
  std::optional<double> p32 = {};  ///< area of joints per volume [1/m], > 0, <= 1e4
  std::optional<double> p30 = {};  ///< joints per volume, with `extent` [1/m^3], > 0, <= 1e6
  /// Part of its planes that is parted, of joints by their spacing, with `extent` [-], > 0, <= 1.
  std::optional<double> persistence = {};
  double extent = std::numeric_limits<double>::infinity();  ///< trace length [m], > 0
  /// 3-D: along the strike, of rectangles that reach as far as `extent` down the dip [m], > 0;
  /// none: discs.
  std::optional<double> strike_extent = {};
  std::optional<AnyJoint> law = {};  ///< of its own; none: that of all joints

  [[nodiscard]] bool is_random() const { return intensity || spacing || p32 || p30; }
};

/// What is too small or too slender to become a block.
struct BlocksInput {
  double min_inscribed_radius = 0;                                  ///< [m], > 0
  double max_elongation = std::numeric_limits<double>::infinity();  ///< length / width, >= 2
  double min_wall_area = 0.074;  ///< pieces cut by the opening's wall below this are left out [m^2]
};

/// Joints that were mapped in a section; in 3-D there are none.
struct TracesInput {
  std::vector<MappedTrace> traces = {};  ///< `MappedTrace::set`: index of their joint set
  /// What ends closer to another joint ends on it [m], > 0; none: half of
  /// `BlocksInput::min_inscribed_radius`, which is the most.
  std::optional<double> snap = {};
  DeadEnds dead_ends = DeadEnds::cut_through;
};

}  // namespace voussoir::design
