// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/design/composite_support.hpp>
#include <voussoir/design/concrete_age.hpp>
#include <voussoir/design/section_capacity.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/theory/foot_beam.hpp>
#include <voussoir/tunnel/lined_part.hpp>
#include <voussoir/tunnel/ring_nodes.hpp>
#include <voussoir/tunnel/section_part.hpp>

/// What is built in the ground, as plain data: bolts, linings, and the stages in which they and the
/// openings come. Axes and units as in `ground_input.hpp`.
namespace voussoir::design {

enum class AnchorKind { lorig, garga_wang, joint_face };
enum class BoltKind { axial, axial_shear };
/// Along all of it in grout, or by plate and anchor alone.
enum class BoltType { grouted, end_anchored };

/// Distance between bolts along the wall: an angle at the tunnel centre or a length.
struct BoltSpacing {
  double value = 0;       ///< [rad] or [m], > 0
  bool is_angle = false;  ///< whether `value` is in radians
};

/// From one angle anticlockwise to another, from the right-hand springing [rad].
struct ArcInput {
  double from = 0;
  double to = 0;  ///< > from, <= from + 2 pi
};

/// A pattern of bolts.
struct BoltsInput {
  std::string name;
  std::size_t opening = 0;  ///< in which they are: 0 the tunnel, else one behind it
  /// Each bar of the section from head to tip, in place of length, spacing and arc [m].
  std::vector<Segment> bars = {};
  double length = 0;  ///< [m], > 0
  BoltSpacing spacing;
  ArcInput arc;             ///< default 0 to pi: the roof
  double out_of_plane = 1;  ///< distance between bolts along the tunnel [m], 0.01 to 1000
  /// 3-D: forepoles, which lie at this angle to the axis over the rock ahead [rad], 1 to 45 deg;
  /// none: bolts at right angles to it.
  std::optional<double> ahead = {};
  BoltType type = BoltType::grouted;
  double diameter = 0.028;  ///< [m], > 0
  /// Axial, of one bolt across one joint [N/m], 1e3 to 1e12; of a grouted bolt without a bond
  /// stiffness.
  double stiffness = 0;
  double shear_stiffness = 0;              ///< of one bolt across one joint, axial_shear only [N/m]
  double pretension = 0;                   ///< [N], 0 to 1e9
  std::optional<double> yield_force = {};  ///< of one bolt [N], > 0, <= 1e9
  std::optional<double> rupture_force = {};  ///< of one bolt [N], > 0, <= 1e9
  /// Beyond yield until it is lost, at a joint or of an end-anchored bolt [m], 1e-4 to 10: the
  /// force goes straight to that of rupture, or stays where there is none. None: 2 % of the
  /// stiffness is left beyond yield.
  std::optional<double> rupture_elongation = {};
  double young_modulus = 200e9;     ///< E of the bar [Pa], 1e10 to 1e12
  std::optional<double> area = {};  ///< of the bar [m^2], 1e-5 to 0.1; none: of a full round one
  /// Of the grout along one bolt [N/m], > 0, <= 1e9; none: its bond is not checked. Without a bond
  /// stiffness the model holds the bolt at its anchors, whatever they carry.
  std::optional<double> bond_strength = {};
  /// Of the grout, over slip and length [N/m^2], 1e5 to 1e12, with a bond strength: bond slips in
  /// the model, and its stiffness is that of bar and bond.
  std::optional<double> bond_stiffness = {};
  /// Of plate and nut at the head [N], 0 to 1e9; none: of a grouted bolt there is none, that of an
  /// end-anchored one does not give.
  std::optional<double> plate_strength = {};
  /// Of a square plate [m], 0.01 to 2, with its strength: where the head lies on shotcrete, it may
  /// punch it. None: it is not asked.
  std::optional<double> plate_width = {};
  /// Of the anchor of an end-anchored bolt [N/m], 1e3 to 1e12, [N], > 0, <= 1e9; none: no end.
  std::optional<double> anchor_stiffness = {}, anchor_strength = {};
  AnchorKind anchors = AnchorKind::lorig;
  double anchor_offset = 0;  ///< joint to anchor, lorig only [m], > 0
  BoltKind law = BoltKind::axial;

  /// E A [N].
  [[nodiscard]] double axial_rigidity() const {
    return young_modulus * area.value_or(0.25 * std::numbers::pi * diameter * diameter);
  }
};

/// On which the ends of an arc of lining stand.
struct FeetInput {
  double width = 0;                     ///< [m], 1e-3 to 10
  double stiffness = 0;                 ///< bearing pressure over settlement [Pa/m], 1e3 to 1e12
  std::optional<double> strength = {};  ///< bearing [Pa], 1e3 to 1e12; none: no end to it
  double friction_angle = 0;            ///< [rad], 0 <= . < pi/2
  /// A beam along the tunnel on which ribs stand, as wide as the feet; none: the lining stands on
  /// the rock all along. depth [m], 1e-3 to 10; E [Pa], 1e6 to 1e12; spacing [m], 0.01 to 1000.
  std::optional<FootBeam> beam = {};

  /// What the beam makes of the feet; nothing without one.
  [[nodiscard]] FeetOnBeam on_beam() const {
    return beam ? feet_on_beam(stiffness, *beam) : FeetOnBeam{1, 0};
  }
};

/// A stretch of lining, or all of it.
struct LiningInput {
  std::string name;
  std::size_t opening = 0;     ///< as of bolts
  double thickness = 0;        ///< [m], 1e-3 to 10, less than half the opening's width
  double young_modulus = 0;    ///< E [Pa], 1e6 to 1e12
  double poisson_ratio = 0.2;  ///< nu [-], -1 < . < 0.5
  LiningElement beam = LiningElement::euler_bernoulli;
  double interface_normal_stiffness = 0;  ///< lining on rock [Pa/m], 1e3 to 1e12
  double interface_shear_stiffness = 0;   ///< the same [Pa/m], 1e3 to 1e12
  double interface_friction_angle = 0;    ///< the same [rad], 0 <= . < pi/2
  /// Bond to the rock until it fails [Pa], 100 to 1e9; 0: none. In tension no more than friction
  /// makes of the shear bond, c / tan(phi).
  double shear_bond = 0, tensile_bond = 0;
  /// On the full ring, 8 to 2000, for a tensile bond no farther apart than
  /// `coarsest_bonded_spacing`; none: as many as facets, or more where joints are closer or the
  /// bond needs them.
  std::optional<int> nodes = {};
  /// How far behind the outline it fills the holes of dropped pieces [m], 0 to 10.
  double fill_depth = default_fill_depth;
  std::optional<ArcInput> arc = {};  ///< none: the full ring
  /// 3-D: width of a strip along the tunnel [m], 0.01 to 1000; none: 1 m, or a shorter round.
  std::optional<double> rib_spacing = {};
  std::optional<LinedPart> part = {};  ///< arc as a word, of which `arc` then has the angles
  std::optional<FeetInput> feet = {};  ///< of an arc alone
  /// By which it is checked; thickness and width are those of the lining, areas of bars per metre
  /// of it [m^2/m]. None: it is not checked.
  std::optional<ConcreteSection> concrete = {};
  /// Of concrete that is loaded early: with `concrete` alone. None: it has the strength and the
  /// modulus that are given.
  std::optional<ConcreteAge> age = {};
  std::optional<SteelRibs> ribs = {};  ///< within its concrete
  /// Of shotcrete to the rock, characteristic [Pa], 1e3 to 1e7, on a strip along the edge of a
  /// block [m], 1e-3 to 1: single blocks are checked by it. Not the bond that the model knows.
  std::optional<double> adhesion = {};
  double adhesion_width = 0.03;

  /// E when it is so old [Pa].
  [[nodiscard]] double modulus_at(double when) const {
    return age && concrete ? young_modulus * age->modulus_part(when, concrete->strength)
                           : young_modulus;
  }
  /// E with which it is installed, the least that it has [Pa].
  [[nodiscard]] double first_modulus() const { return modulus_at(age ? age->when_loaded : 0.0); }
  /// Its nodes have to see the bond fail at the edge of a block, see `require_nodes_for_bond`.
  [[nodiscard]] bool bends_on_bond() const {
    return tensile_bond > 0 && beam != LiningElement::pinned;
  }
};

/// Prices, all in one currency.
struct CostsInput {
  std::string currency = "EUR";
  double bolt_per_metre = 0;   ///< of a bolt's length, with drilling and grout [1/m], >= 0
  double bolt_per_hole = 0;    ///< of each bolt besides: plate, nut, setting up [-], >= 0
  double concrete_per_m3 = 0;  ///< sprayed or cast [1/m^3], >= 0
  double rebound = 0;          ///< of what is sprayed the part that falls off [-], 0 to 0.9
  double steel_per_kg = 0;     ///< of bars and mesh in a lining [1/kg], >= 0

  /// @throws InvalidInput  out of range, or nothing costs anything
  void check() const {
    const auto price = [](double value, const char* what) {
      require(value >= 0 && std::isfinite(value), what, value, ">= 0");
    };
    price(bolt_per_metre, "cost of a metre of bolt");
    price(bolt_per_hole, "cost of a hole");
    price(concrete_per_m3, "cost of concrete");
    price(steel_per_kg, "cost of steel");
    require(rebound >= 0 && rebound <= 0.9, "rebound", rebound, "0 to 0.9");
    require(bolt_per_metre + bolt_per_hole + concrete_per_m3 + steel_per_kg > 0, "sum of all costs",
            0.0, "> 0");
  }
};

/// One step of the construction.
struct StageInput {
  std::string name;
  std::size_t opening = 0;  ///< in which it works: 0 the tunnel, else one behind it
  /// What of the section is excavated at the start; none: nothing.
  std::optional<SectionPart> part = {};
  std::vector<Vec2> outline = {};  ///< in place of limits: what of the section lies in it [m]
  bool takes_rest = false;         ///< what rounds before it have left of the section
  /// 3-D, of a tunnel that is driven in rounds: so many of them behind the face, 0 to 1000.
  int behind = 0;
  double wall_traction = 0;  ///< left on the wall at the end / in-situ traction [-], 0 to 1
  double duration = 0;       ///< for which joints creep at its end [s], >= 0
  std::vector<std::size_t> bolts = {};    ///< patterns installed at the start of the stage
  std::vector<std::size_t> linings = {};  ///< the same
};

}  // namespace voussoir::design
