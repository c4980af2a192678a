// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>
#include <voussoir/equilibrium/equilibrium.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/io/view_from.hpp>
#include <voussoir/linear/linear_method.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/rockmass/mapped_traces.hpp>
#include <voussoir/rockmass/orientation.hpp>
#include <voussoir/rockmass/orientation_sets.hpp>
#include <voussoir/rockmass/spacing_law.hpp>
#include <voussoir/theory/foot_beam.hpp>
#include <voussoir/tunnel/lined_part.hpp>
#include <voussoir/tunnel/ring_nodes.hpp>
#include <voussoir/tunnel/section_part.hpp>

#include "input_errors.hpp"
#include "laid_blocks.hpp"

/// The input file of the program: what is in it, and how to read it.
///
/// SI and radians throughout. Axes of the section: x right, y up, both from the tunnel centre,
/// looking along the tunnel; angles anticlockwise from the right-hand springing. In 3-D the tunnel
/// runs along the second axis, from the face of the domain where it begins. A member without a
/// remark on its default must be given in the file.
/// The keys of the file are declared in rock_input.cpp, support_input.cpp, joint_laws.cpp and
/// input.cpp, one line each.
namespace voussoir::program {

enum class TunnelShape { circle, horseshoe, polygon };
enum class BoltAnchors { lorig, garga_wang, joint_face };
enum class BoltLaw { axial, axial_shear };
enum class RunMethod { two_level, relaxation, explicit_ };

/// [model] The block of ground that is modelled.
struct ModelInput {
  int dimension = 2;          ///< 2: a section in plane strain; 3
  double length = 0;          ///< 3-D: along the tunnel [m], > 0
  double width = 0;           ///< of the whole domain, the tunnel in its middle [m], > 0
  double below_invert = 0;    ///< ground under the invert [m], > 0
  std::uint64_t seed = 1;     ///< of the random joints
  double gravity = 9.81;      ///< [m/s^2], 1 to 1000
  Point origin = {0.0, 0.0};  ///< site coordinates of the tunnel centre, for files of joints [m]
};

/// The outline of an opening. Its centre is that of the circle; of the roof's half circle for the
/// horseshoe (so the springing is at y = 0 and the floor at -wall_height); (0, 0) of the polygon.
struct OutlineInput {
  TunnelShape shape = TunnelShape::circle;
  double diameter = 0;          ///< circle [m], > 0
  double width = 0;             ///< horseshoe: between its walls, = diameter of its roof [m], > 0
  double wall_height = 0;       ///< horseshoe: floor to springing [m], > 0
  std::vector<Point> vertices;  ///< polygon: simple, anticlockwise whatever the file's order
  std::string drawn = {};  ///< how these were read from a drawing, in words; empty: they were not
  int facets = 72;         ///< chords on a full circle, for the curved parts, 12 to 720

  [[nodiscard]] double half_width() const;  ///< half the breadth of the opening [m]
  [[nodiscard]] double crown() const;       ///< y of the highest point [m]
  [[nodiscard]] double invert() const;      ///< y of the lowest point [m]
};

/// [tunnel] The first opening, in whose centre the model has its origin.
struct TunnelInput : OutlineInput {
  double cover = 0;  ///< crown to ground surface, where it begins [m], > 0
  /// Of its axis, clockwise from North [rad], 0 to 2 pi; none: to the North, and only "E" and "W"
  /// say where joints dip.
  std::optional<double> trend;
  double plunge = 0;  ///< of its axis below the horizontal [rad], -pi/4 to pi/4
  /// 3-D: it is driven in rounds of this length [m], > 0; none: its whole length at once.
  std::optional<double> round_length;
  /// 3-D: rounds driven, 1 to 1000; none: as many as the domain has room for.
  std::optional<int> rounds;
};

/// [[opening]] Another tunnel, a cross-drift, a shaft or a niche.
struct OpeningInput : OutlineInput {
  std::string name;       ///< default "opening 1", ...
  Point at = {0.0, 0.0};  ///< of its centre, or of the point where its axis begins [m]
  double place = 0;       ///< 3-D: of that point along the tunnel [m]
  double turn = 0;        ///< of its axis against the tunnel's, clockwise from above [rad]
  /// Of its axis below the horizontal [rad], -pi/2 to pi/2; none: that of the tunnel for one that
  /// has no turn against it, else level.
  std::optional<double> plunge;
  /// 3-D: where it begins and ends along its axis [m]; none, of one along the tunnel: at the ends
  /// of the domain.
  std::optional<double> from, to;
  std::optional<double> round_length;  ///< 3-D: of its own rounds [m]; none: all at once

  /// It runs beside the tunnel: the section shows its outline.
  [[nodiscard]] bool is_along_tunnel(const TunnelInput& tunnel) const {
    return turn == 0 && plunge.value_or(tunnel.plunge) == tunnel.plunge;
  }
};

/// [rock]
struct RockInput {
  double density = 0;  ///< [kg/m^3], 1 to 1e5
};

/// [stress] In situ: vertical from depth, horizontal = K0 times vertical + a constant.
struct StressInput {
  double K0 = 0;  ///< horizontal / vertical [-], 0 to 10; with `K0_minor` of the major one
  std::optional<double> K0_minor;  ///< of the minor horizontal stress [-], 0 to K0
  std::optional<double>
      K0_trend;           ///< of the major one, clockwise from North [rad], with `K0_minor`
  double horizontal = 0;  ///< constant, in all directions [Pa], 0 to 1e9
  double surcharge = 0;   ///< on the ground surface [Pa], 0 to 1e9
};

/// [boundary] What the sides of the domain meet. Sides and base are given together.
struct BoundaryInput {
  std::optional<Boundary> sides;  ///< none: rollers, or elastic where these would bias the closure
  std::optional<Boundary> base;   ///< the same; rollers or elastic
  bool ground_above = false;      ///< top: the ground goes on, stress.surcharge is its weight
  /// E of the ground beyond [Pa], 1e3 to 1e13; none: moduli are measured on the rock.
  std::optional<double> young_modulus;
  double poisson_ratio = 0;  ///< nu, with E [-], -1 < . < 0.5
};

/// [joint] The mechanics of all joints whose set does not say otherwise: a contact law by its word
/// and its parameters, see joint_laws.cpp.
struct JointLawInput {
  std::string law = "coulomb";
  std::map<std::string, double, std::less<>> values;  ///< by their keys, in SI
  std::vector<std::string> given;                     ///< keys that the file has

  /// @pre the law has such a parameter
  [[nodiscard]] double at(std::string_view key) const;
};

/// [[joint_set]] One family of joints: random ones, of which exactly one of intensity, spacing, P32
/// and P30 is given; or, with none, those that joints.file has of it.
struct JointSetInput {
  std::string name;                 ///< default "set 1", "set 2", ...
  Orientation plane{};              ///< as a compass reads it; of random joints
  bool is_azimuth = false;          ///< dip_direction is neither "E" nor "W"
  double sd = 0;                    ///< standard deviation of the dip [rad], 0 to pi/4
  std::optional<double> fisher;     ///< K, in place of sd [-], 5 to 1e6
  std::optional<double> intensity;  ///< trace centres per area of the section [1/m^2], > 0, <= 1e4
  std::optional<double> spacing;    ///< mean, across the joints [m], > 0
  /// Of joints that go right through, by their spacing; its standard deviation, lognormal [m], > 0.
  SpacingLaw spacing_law = SpacingLaw::fixed;
  std::optional<double> spacing_sd;
  std::optional<double> p32;  ///< area of joints per volume [1/m], > 0, <= 1e4
  std::optional<double> p30;  ///< joints per volume, with `extent` [1/m^3], > 0, <= 1e6
  /// Part of its planes that is parted, of joints by their spacing, with `extent` [-], > 0, <= 1.
  std::optional<double> persistence;
  double extent = std::numeric_limits<double>::infinity();  ///< trace length [m], > 0
  /// 3-D: along the strike, of rectangles that reach as far as `extent` down the dip [m], > 0;
  /// none: discs.
  std::optional<double> strike_extent;
  std::optional<JointLawInput> law;  ///< of its own; none: that of [joint]

  /// Says nothing of its orientation, which `joints.orientations` has.
  bool wants_survey = false;
  int surveyed = -1;  ///< set of the survey from which that was taken; -1: none

  [[nodiscard]] bool is_random() const { return intensity || spacing || p32 || p30; }
};

/// [joints] orientations: what was measured with a compass, by sets.
struct SurveyInput {
  std::filesystem::path file;           ///< resolved
  double declination = 0;               ///< added to its azimuths [rad], -pi/2 to pi/2
  bool strike_is_right_handed = false;  ///< a column of strikes that says nothing of its rule
  std::string name;                     ///< of the file, for messages
  std::vector<SurveyedPlane> planes;
  std::vector<std::string> set_names;  ///< empty: the file names none
  bool has_one_set = false;            ///< for that
  std::vector<FittedSet> fits;         ///< one for each set
  std::string layout;                  ///< how it was read, in words
  std::vector<std::string> notes;      ///< what was not taken as it stands
  std::vector<std::string> left_out;   ///< sets that no joint set takes
};

/// [joints] Mapped joints.
struct MappedInput {
  std::optional<int> first_set;  ///< number of the first set in the file, 0 or 1; none: what fits
  /// What ends closer to another joint ends on it [m], > 0, at most blocks.min_inscribed_radius;
  /// none: half of that.
  std::optional<double> snap;
  DeadEnds dead_ends = DeadEnds::cut_through;
  double unit = 0;  ///< of a drawing [m]; 0: as it says itself
};

/// [blocks] What is too small or too slender to become a block.
struct BlocksInput {
  double min_inscribed_radius = 0;                                  ///< [m], > 0
  double max_elongation = std::numeric_limits<double>::infinity();  ///< length / width, >= 2
  double min_wall_area = 0.074;  ///< pieces cut by the opening's wall below this are left out [m^2]
};

/// Distance between bolts along the wall: an angle at the tunnel centre or a length, as given.
struct BoltSpacing {
  double value = 0;       ///< [rad] or [m], > 0
  bool is_angle = false;  ///< whether `value` is in radians
};

/// From one angle anticlockwise to another, from the right-hand springing [rad].
struct ArcInput {
  double from = 0;
  double to = 0;  ///< > from, <= from + 2 pi
};

/// [support.bolts], or one of [[support.bolts]].
struct BoltsInput {
  std::string name;         ///< default "bolts 1", "bolts 2", ...
  std::size_t opening = 0;  ///< in which they are: 0 the tunnel, else one of `Input::openings`
  /// Head and tip of each bar of the section, in place of length, spacing and arc [m].
  std::vector<std::array<Point, 2>> bars = {};
  double length = 0;  ///< [m], > 0
  BoltSpacing spacing;
  ArcInput arc;             ///< default 0 to pi: the roof
  double out_of_plane = 1;  ///< distance between bolts along the tunnel [m], 0.01 to 1000
  /// 3-D: forepoles, which lie at this angle to the axis over the rock ahead [rad], 1 to 45 deg;
  /// none: bolts at right angles to it.
  std::optional<double> ahead;
  double diameter = 0.028;  ///< [m], > 0
  double stiffness = 0;     ///< axial, of one bolt across one joint [N/m], 1e3 to 1e12
  double shear_stiffness =
      0;                  ///< of one bolt across one joint, law axial_shear only [N/m], 1e3 to 1e12
  double pretension = 0;  ///< [N], 0 to 1e9
  std::optional<double> yield_force;    ///< of one bolt [N], > 0, <= 1e9
  std::optional<double> rupture_force;  ///< of one bolt [N], > 0, <= 1e9
  BoltAnchors anchors = BoltAnchors::lorig;
  double anchor_offset = 0;  ///< joint to anchor, lorig only [m], > 0; default 1.2 diameters
  BoltLaw law = BoltLaw::axial;
};

/// [support.lining.feet] On which the ends of an arc stand.
struct FeetInput {
  double width = 0;                ///< [m], 1e-3 to 10; default: the thickness of the lining
  double stiffness = 0;            ///< bearing pressure over settlement [Pa/m], 1e3 to 1e12
  std::optional<double> strength;  ///< bearing [Pa], 1e3 to 1e12; none: no end to it
  double friction_angle = 0;       ///< [rad], 0 <= . < pi/2; default interface.friction
  /// A beam along the tunnel on which ribs stand, as wide as the feet; none: the lining stands on
  /// the rock all along. depth [m], 1e-3 to 10; E [Pa], 1e6 to 1e12; spacing [m], 0.01 to 1000.
  std::optional<FootBeam> beam;

  /// What the beam makes of the feet; nothing without one.
  [[nodiscard]] FeetOnBeam on_beam() const {
    return beam ? feet_on_beam(stiffness, *beam) : FeetOnBeam{1, 0};
  }
};

/// [support.lining], or one of [[support.lining]].
struct LiningInput {
  std::string name;            ///< default "lining 1", "lining 2", ...
  std::size_t opening = 0;     ///< as of bolts
  double thickness = 0;        ///< [m], 1e-3 to 10, less than half the opening's width
  double young_modulus = 0;    ///< E [Pa], 1e6 to 1e12
  double poisson_ratio = 0.2;  ///< nu [-], -1 < . < 0.5
  LiningElement beam = LiningElement::euler_bernoulli;
  double interface_normal_stiffness = 0;  ///< interface.kn [Pa/m], 1e3 to 1e12
  double interface_shear_stiffness = 0;   ///< interface.ks [Pa/m], 1e3 to 1e12; default kn
  double interface_friction_angle = 0;    ///< interface.friction [rad], 0 <= . < pi/2
  /// Bond to the rock until it fails [Pa], 100 to 1e9; 0: none. In tension no more than friction
  /// makes of the shear bond, c / tan(phi).
  double shear_bond = 0, tensile_bond = 0;
  /// On the full ring, 8 to 2000, for a tensile bond no farther apart than
  /// `coarsest_bonded_spacing`; left out: as many as facets, or more where joints are closer or the
  /// bond needs them.
  std::optional<int> nodes;
  /// How far behind the outline it fills the holes of dropped pieces [m], 0 to 10.
  double fill_depth = default_fill_depth;
  std::optional<ArcInput> arc;  ///< none: the full ring
  /// 3-D: width of a strip along the tunnel [m], 0.01 to 1000; none: 1 m, or a shorter round.
  std::optional<double> rib_spacing;
  std::optional<LinedPart> part;  ///< arc as a word, of which `arc` then has the angles
  std::optional<FeetInput> feet;  ///< of an arc alone

  /// Its nodes have to see the bond fail at the edge of a block, see `require_nodes_for_bond`.
  [[nodiscard]] bool bends_on_bond() const {
    return tensile_bond > 0 && beam != LiningElement::pinned;
  }
};

/// [[stage]] or [[round]] One step of the construction, in the order of the file.
struct StageInput {
  std::string name;         ///< default "stage 1", "round 1", ...
  std::size_t opening = 0;  ///< in which it works: 0 the tunnel, else one of `Input::openings`
  /// What of the section is excavated at the start; none: nothing. Of stages the first excavates
  /// all of it.
  std::optional<SectionPart> part;
  std::vector<Point> outline = {};  ///< in place of limits: what of the section lies in it [m]
  bool is_drawn = false;            ///< that is from a drawing
  bool takes_rest = false;          ///< what rounds before it have left of the section
  /// 3-D, with tunnel.round_length: so many rounds behind the face, 0 to 1000.
  int behind = 0;
  double wall_traction = 0;  ///< left on the wall at the end / in-situ traction [-], 0 to 1
  double duration = 0;       ///< for which joints creep at its end [s], >= 0
  std::vector<std::size_t> bolts = {};    ///< patterns installed at the start of the stage
  std::vector<std::size_t> linings = {};  ///< the same
};

/// [run] How equilibrium is sought.
struct RunInput {
  RunMethod method = RunMethod::two_level;
  LinearMethod linear_solver = LinearMethod::automatic;  ///< of elastic equations
  double tolerance = 1e-3;  ///< accepted error estimate [-], 1e-6 to 0.1
  /// A block that moved further has come off [m], > 0; left out: chosen by the rock.
  double displacement_limit = by_the_rock;
  /// Moved so far, contacts are updated [m], > 0; left out: chosen by the rock.
  double contact_update_limit = by_the_rock;
  double damping = 0.7;   ///< local damping, explicit only [-], 0 to 0.95
  int ramp_steps = 8000;  ///< steps over which the wall is unloaded, explicit only; 0 = at once
  std::optional<std::int64_t> max_steps;  ///< > 0
};

/// [picture] Of a run.
struct PictureInput {
  ViewFrom from = ViewFrom::axis;  ///< 3-D
};

/// [diagram] The axes of the interaction diagram, each rising, with two or more entries.
struct DiagramInput {
  std::vector<std::optional<BoltSpacing>> spacing;  ///< none: no bolts, always last
  std::vector<double> thickness;                    ///< 0: no lining; otherwise 1e-3 to 10 [m]
};

/// A whole input file, checked: every number is in the range given above, and they fit together.
struct Input {
  std::string title;
  ModelInput model;
  TunnelInput tunnel;
  std::vector<OpeningInput> openings;
  RockInput rock;
  StressInput stress;
  BoundaryInput boundary;
  std::vector<JointSetInput> joint_sets;
  std::filesystem::path joints_file;  ///< measured traces, resolved, not opened; empty: none
  MappedInput mapped;
  std::optional<SurveyInput> survey;
  JointLawInput joint;
  BlocksInput blocks;
  std::optional<BoltsInput> bolts;           ///< the first pattern, which a diagram varies
  std::vector<BoltsInput> further_bolts;     ///< patterns behind it
  bool lists_bolts = false;                  ///< as [[support.bolts]]
  std::optional<LiningInput> lining;         ///< the first, which a diagram varies
  std::vector<LiningInput> further_linings;  ///< behind it
  bool lists_linings = false;                ///< as [[support.lining]]
  std::vector<StageInput> stages;  ///< never empty; the last leaves no traction on the wall
  bool has_rounds = false;         ///< stages are given as [[round]]
  RunInput run;
  PictureInput picture;
  std::optional<DiagramInput> diagram;
  /// Blocks in place of a tunnel: of the others model.gravity, rock, joint and run are then given.
  std::optional<LaidInput> laid;
  /// Keys of the file that have a meaning in the other dimension alone.
  std::vector<std::string> unused;
  /// Names them, and says why; empty: there are none.
  [[nodiscard]] std::string unused_text() const;
  /// Every key with its value, `stress.K0 = 1`, overrides included, sorted: for the run id.
  std::vector<std::string> content;

  [[nodiscard]] bool is_spatial() const { return model.dimension == 3; }
  /// All patterns of bolts, the first one first.
  [[nodiscard]] std::vector<const BoltsInput*> bolt_patterns() const;
  /// All linings, the first one first.
  [[nodiscard]] std::vector<const LiningInput*> linings() const;
  /// The table of a lining: "support.lining", or "support.lining[1]" of several.
  [[nodiscard]] std::string lining_key(std::size_t lining) const;
  /// The table of a pattern: "support.bolts", or "support.bolts[1]" of several.
  [[nodiscard]] std::string bolts_key(std::size_t pattern) const;
  /// Horizontal over vertical stress across the tunnel, without the constant part [-].
  [[nodiscard]] double K0_across() const;
  /// 3-D: of the tunnel in the domain, along its axis [m].
  [[nodiscard]] double tunnel_length() const;
  /// 3-D: what is excavated at a time along the tunnel [m].
  [[nodiscard]] double stretch() const { return tunnel.round_length.value_or(tunnel_length()); }
  /// 3-D: how often, one behind the other.
  [[nodiscard]] int round_count() const;
  [[nodiscard]] double domain_top() const;     ///< y of the ground surface [m]
  [[nodiscard]] double domain_bottom() const;  ///< y of the lower boundary [m]
};

/// Whether a line of `Input::content` names a file: what that holds decides the results, wherever
/// it lies and whatever it is called.
[[nodiscard]] bool names_a_file(std::string_view line);

/// An outline about its own centre. @pre its keys are read without fault
[[nodiscard]] SimplePolygon outline_of(const OutlineInput& outline);
/// That of the tunnel.
[[nodiscard]] inline SimplePolygon opening_of(const Input& input) {
  return outline_of(input.tunnel);
}

/// Of joints and of blocks: minutes and gigabytes beyond.
inline constexpr double largest_count = 1e6;

/// What the joint sets will come to, before anything is generated.
struct SizeEstimate {
  double joints = 0;  ///< traces to be drawn
  double blocks = 0;
};

/// @return  joints = sum of intensity x area; blocks from the crossings of the sets, but no more
///          than the minimum inscribed radius lets there be (within a factor of two of generated
///          masses). Joints of a file are counted when they are read, with the same limits.
[[nodiscard]] SizeEstimate estimate_size(const Input& input);

/// Reads a file and checks all of it.
///
/// @param overrides  "key=value" as given behind --set: dotted keys with indices from 0
///                   (`joint_set[0].dip=75 deg`), the value as in the file, quotes optional.
///                   Later ones win. They may add keys, tables and, at the end, array entries;
///                   "!key" takes a key, a table or an array entry away.
/// @throws InputErrors  the file cannot be read or is no TOML, a key is unknown, missing, of the
///                      wrong kind or out of range, or the parts do not fit together
[[nodiscard]] Input read_input(const std::filesystem::path& file,
                               const std::vector<std::string>& overrides = {});

/// The same from a text already read, for pipes and tests.
///
/// @param name       what to call the text in messages
/// @param directory  where paths in the text are relative to
[[nodiscard]] Input read_input_text(std::string_view text, const std::string& name,
                                    const std::filesystem::path& directory,
                                    const std::vector<std::string>& overrides = {});

}  // namespace voussoir::program
