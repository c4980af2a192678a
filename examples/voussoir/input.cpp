// SPDX-License-Identifier: MIT
#include "input.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <voussoir/core/elementary.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/io/operating_system.hpp>

#include "blocks_input.hpp"
#include "drawn_outline.hpp"
#include "input_checks.hpp"
#include "input_document.hpp"
#include "input_section.hpp"
#include "joint_laws.hpp"
#include "joint_sets.hpp"
#include "orientation_input.hpp"
#include "plausibility.hpp"
#include "survey.hpp"

namespace voussoir::program {

namespace {

// Rounded as a quantity read from a text is, so that "90 deg" equals its bound.
double degrees(double angle) { return angle * std::numbers::pi / 180; }

Range angle_below_90() { return {.low = 0, .high = degrees(90), .high_included = false}; }

// ---- Ranges of what the equations add up. Far outside of them one spring drowns another in the
// ---- 16 digits of a number, and a body then "can move without resistance"; or blocks take for
// ---- ever to fall.

constexpr Range per_area_range{.low = 1e3, .high = 1e12};       // interface [Pa/m]
constexpr Range bolt_range{.low = 1e3, .high = 1e12};           // of one bolt [N/m]
constexpr Range modulus_range{.low = 1e6, .high = 1e12};        // of a lining [Pa]
constexpr Range density_range{.low = 1, .high = 1e5};           // [kg/m^3]
constexpr Range tolerance_range{.low = 1e-6, .high = 0.1};      // below it rounding decides
constexpr Range out_of_plane_range{.low = 0.01, .high = 1000};  // [m]
constexpr Range surcharge_range{.low = 0, .high = 1e9};         // [Pa]
constexpr Range force_range{.low = 0, .high = 1e9, .low_included = false};  // of one bolt [N]
constexpr Range bond_range{.low = 100, .high = 1e9};           // of a lining to rock [Pa]
constexpr Range bearing_range{.low = 1e3, .high = 1e12};       // strength under a foot [Pa]
constexpr Range rib_spacing_range{.low = 0.01, .high = 1000};  // along the tunnel [m]
constexpr Range ground_range{.low = 1e3, .high = 1e13};        // modulus of ground [Pa]

// ---- The keys: name, where it goes, dimension, range, needed or not. Defaults are in input.hpp.

/// Takes note of a key that is there, and has a meaning in the other dimension only.
void note_unused(Input& input, const Section& s, std::string_view key) {
  if (s.has(key)) input.unused.push_back(s.full(key));
}

void read_model(Section& s, Input& input) {
  ModelInput& model = input.model;
  s.integer("dimension", model.dimension, 2, 3);
  s.quantity("length", model.length, dimension::length, above(0),
             input.is_spatial() ? Need::required : Need::optional);
  if (!input.is_spatial()) note_unused(input, s, "length");
  s.quantity("width", model.width, dimension::length, above(0), Need::required);
  s.quantity("below_invert", model.below_invert, dimension::length, above(0), Need::required);
  s.integer("seed", model.seed, 0, std::numeric_limits<std::int64_t>::max());
  s.quantity("gravity", model.gravity, dimension::acceleration, gravity_range, Need::optional);
  if (const auto value = s.find("origin", Need::optional))
    model.origin = value->as_point().value_or(model.origin);
}

void read_stress(Section& s, Input& input) {
  StressInput& stress = input.stress;
  s.number("K0", stress.K0, between(0, 10), Need::required);
  if (const auto value = s.find("K0_minor", Need::optional))
    stress.K0_minor = value->as_number(between(0, 10));
  s.quantity("K0_trend", stress.K0_trend, dimension::angle, between(0, degrees(360)));
  s.quantity("horizontal", stress.horizontal, dimension::pressure, surcharge_range, Need::optional);
  s.quantity("surcharge", stress.surcharge, dimension::pressure, surcharge_range, Need::optional);
  if (s.has("K0_minor") != s.has("K0_trend"))
    s.complain(
        s.has("K0_minor") ? "K0_minor" : "K0_trend",
        std::string("is given without ") + (s.has("K0_minor") ? "K0_trend" : "K0_minor"),
        R"(both: K0 of the major horizontal stress, K0_minor, and K0_trend = "120 deg" of the major one, clockwise from North)");
  else if (stress.K0_minor && *stress.K0_minor > stress.K0 && !s.faulty("K0"))
    s.complain("K0_minor", "is more than K0, that of the major horizontal stress",
               "0 to " + shortest_text(stress.K0));
  else if (stress.K0_minor && !input.tunnel.trend && !s.checker().faulty("tunnel"))
    s.complain(
        "K0_trend", "says where the stress goes, and nothing where the tunnel does",
        R"(tunnel.trend = "0 deg" besides it, clockwise from North, looking along the tunnel)");
}

void read_boundary(Section& s, BoundaryInput& boundary) {
  using Choice = std::optional<Boundary>;
  (void)s.choice<Choice>("sides", boundary.sides,
                         {{"automatic", std::nullopt},
                          {"rollers", Boundary::rollers},
                          {"stress", Boundary::stress},
                          {"elastic", Boundary::elastic}},
                         Need::optional);
  (void)s.choice<Choice>(
      "base", boundary.base,
      {{"automatic", std::nullopt}, {"rollers", Boundary::rollers}, {"elastic", Boundary::elastic}},
      Need::optional);
  (void)s.choice<bool>("top", boundary.ground_above, {{"surface", false}, {"elastic", true}},
                       Need::optional);
  s.quantity("E", boundary.young_modulus, dimension::pressure, ground_range);
  s.only_with(s.has("E"), "E", [&] {
    s.number("nu", boundary.poisson_ratio,
             {.low = -1, .high = 0.5, .low_included = false, .high_included = false},
             Need::required);
  });
}

/// A path in the file is UTF-8 whatever the system's own encoding.
/// @return  resolved; empty if there is none
std::filesystem::path read_path(Section& s, std::string_view key, Need need,
                                const std::filesystem::path& directory) {
  const std::string form = "a file name, relative to the input file";
  const auto value = s.find(key, need, form);
  const auto text = value ? value->as_text() : std::nullopt;
  if (!text) return {};
  if (text->empty()) {
    value->refuse("is empty", form);
    return {};
  }
  return directory / utf8_path(*text);
}

/// Twice the area, positive when anticlockwise, about the first vertex (site coordinates).
double signed_area(const std::vector<Point>& v) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < v.size(); ++i)
    sum += (v[i][0] - v[0][0]) * (v[i + 1][1] - v[0][1]) -
           (v[i + 1][0] - v[0][0]) * (v[i][1] - v[0][1]);
  return sum;
}

void read_vertices(Section& s, std::vector<Point>& vertices, Need need) {
  const std::string form =
      R"(3 to 2000 points [["-2 m", "-2 m"], ["2 m", "-2 m"], ["0 m", "3 m"]] around the tunnel centre, sides that do not cross)";
  const auto value = s.find("vertices", need, form);
  if (!value) return;
  const auto points = value->as_list(3, 2000, form);
  if (!points) return;
  for (const Value& point : *points)
    if (const auto read = point.as_point()) vertices.push_back(*read);
  if (vertices.size() != points->size()) return;  // already reported
  // Closed by its first point, or with a point twice, it is the same outline.
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  if (vertices.size() > 1 && vertices.front() == vertices.back()) vertices.pop_back();
  if (const std::string fault = outline_fault(vertices); !fault.empty())
    return s.checker().report(value->node().place, value->key(), value->key() + " " + fault, form);
  if (signed_area(vertices) < 0) std::reverse(vertices.begin(), vertices.end());
}

/// The outline by its points, or from a drawing.
void read_outline(Section& s, Input& input, const std::filesystem::path& directory) {
  const bool has_file = s.has("file");
  read_vertices(s, input.tunnel.vertices, has_file ? Need::optional : Need::required);
  const std::filesystem::path file = read_path(s, "file", Need::optional, directory);
  std::string layer;
  double unit = 0;
  s.only_with(has_file, "file", [&] {
    s.text("layer", layer);
    read_drawing_unit(s, unit);
  });
  if (file.empty() || s.faulty("unit") || s.checker().faulty("model")) return;
  if (s.has("vertices"))
    return s.complain("vertices", "are given besides tunnel.file", "one of the two");
  input.tunnel.vertices = drawn_outline(s, input, file, layer, unit);
}

void read_tunnel(Section& s, Input& input, const std::filesystem::path& directory) {
  TunnelInput& tunnel = input.tunnel;
  const bool known = s.choice<TunnelShape>("shape", tunnel.shape,
                                           {{"circle", TunnelShape::circle},
                                            {"horseshoe", TunnelShape::horseshoe},
                                            {"polygon", TunnelShape::polygon}},
                                           Need::required);
  const auto of_shape = [&](TunnelShape shape, const std::string& word,
                            const std::function<void()>& declare) {
    if (!known) return s.unread(declare);
    s.only_with(tunnel.shape == shape, "shape = \"" + word + "\"", declare);
  };
  of_shape(TunnelShape::circle, "circle", [&] {
    s.quantity("diameter", tunnel.diameter, dimension::length, above(0), Need::required);
  });
  of_shape(TunnelShape::horseshoe, "horseshoe", [&] {
    s.quantity("width", tunnel.width, dimension::length, above(0), Need::required);
    s.quantity("wall_height", tunnel.wall_height, dimension::length, above(0), Need::required);
  });
  of_shape(TunnelShape::polygon, "polygon", [&] { read_outline(s, input, directory); });
  s.quantity("cover", tunnel.cover, dimension::length, above(0), Need::required);
  s.integer("facets", tunnel.facets, 12, 720);
  s.quantity("trend", tunnel.trend, dimension::angle, between(0, degrees(360)));
  s.quantity("round_length", tunnel.round_length, dimension::length, above(0));
  s.only_with(s.has("round_length"), "round_length",
              [&] { s.integer("rounds", tunnel.rounds, 1, 1000); });
  if (input.is_spatial()) return;
  for (const char* const key : {"round_length", "rounds"}) note_unused(input, s, key);
}

/// The law of the spacings fits what is said of them.
void check_spacing(Section& s, const JointSetInput& set) {
  const bool is_lognormal = set.spacing_law == SpacingLaw::lognormal;
  if (set.spacing_law != SpacingLaw::fixed && (!set.spacing || std::isfinite(set.extent)))
    s.complain("spacing_law",
               "is of joints that go right through, by their spacing; others lie independently of "
               "each other",
               "a key spacing and no extent, or no spacing_law");
  else if (is_lognormal && !s.has("spacing_sd"))
    s.complain("spacing_law", "lacks its standard deviation", R"(spacing_sd = "0.5 m" besides it)");
  else if (!is_lognormal && s.has("spacing_sd"))
    s.complain("spacing_sd", "is of a lognormal spacing alone", R"(spacing_law = "lognormal")");
  else if (set.spacing && set.spacing_sd && *set.spacing_sd > 3 * *set.spacing)
    s.complain("spacing_sd", "is more than three times the spacing",
               "at most " + format_quantity(3 * *set.spacing, dimension::length));
}

/// @param is_mapped    joints.file may give the joints of a set that has no random ones
/// @param is_surveyed  joints.orientations may give the orientation of one that says nothing of it
void read_joint_set(Section& s, Input& input, JointSetInput& set, bool is_mapped,
                    bool is_surveyed) {
  const int given = s.has("intensity") + s.has("spacing") + s.has("P32");
  const bool is_random = given > 0;
  set.wants_survey = is_surveyed && is_random && !s.has("dip") && !s.has("dip_direction");
  const Need need = (is_mapped && !is_random) || set.wants_survey ? Need::optional : Need::required;
  s.text("name", set.name);
  read_orientation(s, set, need);
  s.quantity("intensity", set.intensity, dimension::intensity,
             {.low = 0, .high = 1e4, .low_included = false});
  s.quantity("spacing", set.spacing, dimension::length, above(0));
  (void)s.choice<SpacingLaw>("spacing_law", set.spacing_law,
                             {{"fixed", SpacingLaw::fixed},
                              {"exponential", SpacingLaw::exponential},
                              {"lognormal", SpacingLaw::lognormal}},
                             Need::optional);
  s.quantity("spacing_sd", set.spacing_sd, dimension::length, above(0));
  s.quantity("P32", set.p32, dimension::area_per_volume,
             {.low = 0, .high = 1e4, .low_included = false});
  s.only_with(is_random || !is_mapped, "intensity, spacing or P32", [&] {
    s.quantity("sd", set.sd, dimension::angle, between(0, degrees(45)), Need::optional);
    if (const auto value = s.find("K", Need::optional))
      set.fisher = value->as_number({.low = 5, .high = 1e6});
    s.quantity("extent", set.extent, dimension::length, above(0), Need::optional,
               Infinity::allowed);
    s.quantity("strike_extent", set.strike_extent, dimension::length, above(0));
  });
  if (!input.is_spatial()) note_unused(input, s, "strike_extent");
  check_spacing(s, set);
  if (s.has("sd") && s.has("K"))
    s.complain("K", "is given besides sd", "one of the two; K = 1 / sd^2, sd in radians");
  if (set.strike_extent && !set.is_azimuth && !set.wants_survey && !input.tunnel.trend)
    s.complain("strike_extent",
               "is of a set of the section, whose joints go on along the tunnel without end",
               "no strike_extent, or a dip_direction by azimuth and tunnel.trend");
  else if (set.strike_extent && std::isinf(set.extent) && !s.faulty("extent"))
    s.complain("strike_extent", "is of joints that have no extent down the dip",
               R"(extent = "2 m" besides it)");
  if (JointLawInput law = read_joint_law(s, &input.joint); !law.given.empty()) set.law = law;
  if (given > 1) {
    s.complain(s.has("spacing") ? "spacing" : "P32",
               std::string("is given besides ") + (s.has("intensity") ? "intensity" : "P32"),
               "one of intensity, spacing and P32");
  } else if (!is_random && !is_mapped) {
    s.complain(
        "intensity", "is missing, and so are spacing and P32",
        R"(one of intensity = "1 /m^2", spacing = "1.2 m" and P32 = "1.5 m^2/m^3"; or joints.file, with mapped joints of this set)");
  } else if (set.intensity && std::isinf(set.extent) && !s.faulty("extent")) {
    s.complain(
        "intensity",
        "counts centres per area, and of joints without extent more reach into a large "
        "domain than into a small one",
        R"(extent = "2 m", the length of their traces; or spacing = "1.2 m" in place of intensity: joints that go right through, as far apart in any domain)");
  }
}

void read_mapped(Section& s, Input& input, const std::filesystem::path& directory) {
  MappedInput& mapped = input.mapped;
  if (const auto value = s.find("first_set", Need::optional)) {
    if (const auto first = value->as_integer(0, 1)) mapped.first_set = static_cast<int>(*first);
  }
  s.quantity("snap", mapped.snap, dimension::length, above(0));
  (void)s.choice<DeadEnds>(
      "dead_ends", mapped.dead_ends,
      {{"do_not_cut", DeadEnds::do_not_cut}, {"cut_through", DeadEnds::cut_through}},
      Need::optional);
  const bool has_survey = s.has("orientations");
  input.joints_file = read_path(s, "file", has_survey ? Need::optional : Need::required, directory);
  s.only_with(is_drawing(input.joints_file), "a drawing as file",
              [&] { read_drawing_unit(s, mapped.unit); });
  if (const auto file = read_path(s, "orientations", Need::optional, directory); !file.empty())
    input.survey.emplace().file = file;
  SurveyInput unused;
  SurveyInput& survey = input.survey ? *input.survey : unused;
  s.only_with(has_survey, "orientations", [&] {
    s.quantity("declination", survey.declination, dimension::angle,
               between(-degrees(90), degrees(90)), Need::optional);
    (void)s.choice<bool>("strike", survey.strike_is_right_handed, {{"right-hand", true}},
                         Need::optional);
  });
}

void read_blocks(Section& s, BlocksInput& blocks) {
  s.quantity("min_inscribed_radius", blocks.min_inscribed_radius, dimension::length, above(0),
             Need::required);
  s.number("max_elongation", blocks.max_elongation, at_least(2), Need::optional);
  s.quantity("min_wall_area", blocks.min_wall_area, dimension::area, at_least(0), Need::optional);
}

constexpr const char* spacing_form =
    R"(an angle from 0.1 deg or a length from 1 cm, such as "15 deg" or "1.3 m")";

/// An angle or a length, whichever its unit says.
std::optional<BoltSpacing> read_spacing(const Value& value) {
  if (value.node().kind != Node::Kind::text) {
    value.refuse("has no unit", spacing_form);
    return std::nullopt;
  }
  try {
    const Quantity quantity = parse_quantity(value.node().text);
    const bool is_angle = quantity.dimension == dimension::angle;
    if (!is_angle && quantity.dimension != dimension::length) {
      value.refuse("is neither an angle nor a length", spacing_form);
    } else if (!(quantity.value >= (is_angle ? degrees(0.1) : 0.01))) {
      value.refuse("is outside the accepted range", spacing_form);
    } else {
      return BoltSpacing{quantity.value, is_angle};
    }
  } catch (const UnitError& error) {
    value.refuse(error.complaint(), spacing_form);
  }
  return std::nullopt;
}

std::optional<ArcInput> read_arc(const Value& value) {
  const std::string form =
      R"(two angles from -360 to 360 deg, the first below the second, at most 360 deg apart, such as ["0 deg", "180 deg"])";
  const auto ends = value.as_list(2, 2, form);
  if (!ends) return std::nullopt;
  const Range range = between(degrees(-360), degrees(360));
  const auto from = ends->at(0).as_quantity(dimension::angle, range);
  const auto to = ends->at(1).as_quantity(dimension::angle, range);
  if (!from || !to) return std::nullopt;
  // One rounding of slack: -180 to 180 deg is the whole ring.
  if (!(*from < *to) || *to - *from > degrees(360) * (1 + 1e-15)) {
    value.refuse(*from < *to ? "spans more than 360 deg" : "does not rise", form);
    return std::nullopt;
  }
  return ArcInput{*from, *to};
}

/// Two angles, or what of the outline is lined in a word.
void read_lined_arc(Section& s, LiningInput& lining) {
  const auto value = s.find("arc", Need::optional);
  if (!value) return;
  if (value->node().kind != Node::Kind::text) {
    lining.arc = read_arc(*value);
    return;
  }
  constexpr LinedPart parts[] = {LinedPart::roof, LinedPart::roof_and_walls, LinedPart::all};
  if (const auto word = value->as_word({"roof", "roof and walls", "all"}))
    lining.part = parts[*word];
}

/// Bars one by one: head and tip of each.
void read_bars(const Value& value, std::vector<std::array<Point, 2>>& bars) {
  const std::string form =
      R"(1 to 1000 pairs of points, head and tip of each bar, such as [[["0 m", "4 m"], ["0 m", "8 m"]]])";
  const auto entries = value.as_list(1, 1000, form);
  for (std::size_t k = 0; entries && k < entries->size(); ++k) {
    const auto ends = entries->at(k).as_list(2, 2, form);
    if (!ends) continue;
    const auto head = ends->at(0).as_point(), tip = ends->at(1).as_point();
    if (!head || !tip) continue;
    if (*head == *tip)
      entries->at(k).refuse("has no length", form);
    else
      bars.push_back({*head, *tip});
  }
}

void read_bolts(Section& s, BoltsInput& bolts) {
  s.text("name", bolts.name);
  const bool has_bars = s.has("bars");
  if (const auto value = s.find("bars", Need::optional)) read_bars(*value, bolts.bars);
  bolts.arc = {0, degrees(180)};
  s.only_with(!has_bars, "length and spacing, without bars,", [&] {
    s.quantity("length", bolts.length, dimension::length, above(0), Need::required);
    if (const auto value = s.find("spacing", Need::required, spacing_form))
      bolts.spacing = read_spacing(*value).value_or(bolts.spacing);
    if (const auto value = s.find("arc", Need::optional))
      bolts.arc = read_arc(*value).value_or(bolts.arc);
  });
  s.quantity("out_of_plane", bolts.out_of_plane, dimension::length, out_of_plane_range,
             Need::optional);
  s.quantity("diameter", bolts.diameter, dimension::length, above(0), Need::optional);
  s.quantity("stiffness", bolts.stiffness, dimension::stiffness, bolt_range, Need::required);
  s.quantity("pretension", bolts.pretension, dimension::force, between(0, force_range.high),
             Need::optional);
  s.quantity("yield_force", bolts.yield_force, dimension::force, force_range);
  s.quantity("rupture_force", bolts.rupture_force, dimension::force, force_range);

  const bool anchors_known = s.choice<BoltAnchors>("anchors", bolts.anchors,
                                                   {{"lorig", BoltAnchors::lorig},
                                                    {"garga-wang", BoltAnchors::garga_wang},
                                                    {"joint-face", BoltAnchors::joint_face}},
                                                   Need::optional);
  bolts.anchor_offset = 1.2 * bolts.diameter;  // as Boon et al. (2015), section 5.2
  const auto offset = [&] {
    s.quantity("anchor_offset", bolts.anchor_offset, dimension::length, above(0), Need::optional);
  };
  if (anchors_known) {
    s.only_with(bolts.anchors == BoltAnchors::lorig, "anchors = \"lorig\"", offset);
  } else {
    s.unread(offset);
  }

  const bool law_known = s.choice<BoltLaw>(
      "law", bolts.law, {{"axial", BoltLaw::axial}, {"axial-shear", BoltLaw::axial_shear}},
      Need::optional);
  const auto shear = [&] {
    s.quantity("shear_stiffness", bolts.shear_stiffness, dimension::stiffness, bolt_range,
               Need::required);
  };
  if (law_known) {
    s.only_with(bolts.law == BoltLaw::axial_shear, "law = \"axial-shear\"", shear);
  } else {
    s.unread(shear);
  }
}

void read_lining(Section& s, Input& input) {
  LiningInput& lining = input.lining.emplace();
  s.quantity("thickness", lining.thickness, dimension::length, thickness_range, Need::required);
  s.quantity("E", lining.young_modulus, dimension::pressure, modulus_range, Need::required);
  s.number("nu", lining.poisson_ratio,
           {.low = -1, .high = 0.5, .low_included = false, .high_included = false}, Need::optional);
  s.choice<LiningBeam>(
      "beam", lining.beam,
      {{"euler-bernoulli", LiningBeam::euler_bernoulli}, {"timoshenko", LiningBeam::timoshenko}},
      Need::optional);
  s.table("interface", [&](Section& interface) {
    interface.quantity("kn", lining.interface_normal_stiffness, dimension::stiffness_per_area,
                       per_area_range, Need::required);
    lining.interface_shear_stiffness = lining.interface_normal_stiffness;
    interface.quantity("ks", lining.interface_shear_stiffness, dimension::stiffness_per_area,
                       per_area_range, Need::optional);
    interface.quantity("friction", lining.interface_friction_angle, dimension::angle,
                       angle_below_90(), Need::required);
    interface.quantity("shear_bond", lining.shear_bond, dimension::pressure, bond_range,
                       Need::optional);
    interface.quantity("tensile_bond", lining.tensile_bond, dimension::pressure, bond_range,
                       Need::optional);
    const double most = lining.shear_bond / elementary::tangent(lining.interface_friction_angle);
    if (lining.tensile_bond > most * (1 + 1e-12))
      interface.complain("tensile_bond",
                         lining.shear_bond > 0 ? "is more than shear_bond / tan(friction)"
                                               : "is a bond without strength in shear",
                         lining.shear_bond > 0
                             ? "at most " + format_quantity(most, dimension::pressure)
                             : "with a key shear_bond, at most shear_bond / tan(friction)");
  });
  s.integer("nodes", lining.nodes, 8, 2000);
  s.quantity("fill_depth", lining.fill_depth, dimension::length, {.low = 0, .high = 10},
             Need::optional);
  s.quantity("rib_spacing", lining.rib_spacing, dimension::length, rib_spacing_range);
  if (!input.is_spatial()) note_unused(input, s, "rib_spacing");
  read_lined_arc(s, lining);
  s.optional_table("feet", [&](Section& table) {
    FeetInput& feet = lining.feet.emplace();
    feet.width = lining.thickness;
    table.quantity("width", feet.width, dimension::length, thickness_range, Need::optional);
    table.quantity("stiffness", feet.stiffness, dimension::stiffness_per_area, per_area_range,
                   Need::required);
    table.quantity("strength", feet.strength, dimension::pressure, bearing_range);
    feet.friction_angle = lining.interface_friction_angle;
    table.quantity("friction", feet.friction_angle, dimension::angle, angle_below_90(),
                   Need::optional);
    table.optional_table("beam", [&](Section& under) {
      FootBeam& beam = feet.beam.emplace();
      under.quantity("depth", beam.depth, dimension::length, thickness_range, Need::required);
      under.quantity("E", beam.modulus, dimension::pressure, modulus_range, Need::required);
      under.quantity("spacing", beam.spacing, dimension::length, rib_spacing_range, Need::required);
    });
  });
  if (lining.feet && !lining.arc && lining.part.value_or(LinedPart::all) == LinedPart::all)
    s.complain("feet", "stand under the ends of an arc, and a full ring has none",
               "a key arc, or no table feet");
}

/// What a round excavates: all of the section, or what lies between the limits given.
void read_part(Section& s, StageInput& round) {
  bool excavates = true;
  const bool known = s.choice<bool>("excavate", excavates, {{"section", true}, {"nothing", false}},
                                    Need::optional);
  SectionPart part;
  const auto limits = [&] {
    s.quantity("above", part.bottom, dimension::length, Range{}, Need::optional);
    s.quantity("below", part.top, dimension::length, Range{}, Need::optional);
    s.quantity("right_of", part.left, dimension::length, Range{}, Need::optional);
    s.quantity("left_of", part.right, dimension::length, Range{}, Need::optional);
  };
  if (!known) return s.unread(limits);
  s.only_with(excavates, R"(excavate = "section")", limits);
  if (!excavates) return;
  if (!(part.bottom < part.top) && !s.faulty("above") && !s.faulty("below"))
    s.complain("above", "leaves nothing: it is not lower than below", "an elevation under below");
  if (!(part.left < part.right) && !s.faulty("right_of") && !s.faulty("left_of"))
    s.complain("right_of", "leaves nothing: it is not left of left_of", "a place left of left_of");
  round.part = part;
}

/// @param is_round  in a table [[round]], which says what it excavates
void read_stage(Section& s, Input& input, StageInput& stage, bool is_round) {
  s.text("name", stage.name);
  s.quantity("wall_traction", stage.wall_traction, dimension::number, between(0, 1),
             is_round ? Need::optional : Need::required);
  if (is_round) {
    read_part(s, stage);
    s.only_with(input.tunnel.round_length.has_value(), "tunnel.round_length",
                [&] { s.integer("behind", stage.behind, 0, 1000); });
    if (!input.is_spatial()) note_unused(input, s, "behind");
    if (input.is_spatial() && input.tunnel.round_length) note_unused(input, s, "wall_traction");
  }
  const auto value = s.find("install", Need::optional);
  if (!value) return;
  std::vector<std::string> words{"bolts", "lining"};  // all patterns, or one by its name
  const std::vector<const BoltsInput*> patterns = input.bolt_patterns();
  for (const BoltsInput* pattern : patterns) words.push_back(pattern->name);
  const auto items = value->as_list(0, words.size(), R"(a list of "bolts", "lining")");
  if (!items) return;
  std::vector<bool> seen(words.size(), false);
  for (const Value& item : *items) {
    const auto word = item.as_word(words);
    if (!word) continue;
    if (seen[*word]) item.refuse("is in the list twice", "each support once");
    seen[*word] = true;
    if (*word == 1) stage.install_lining = true;
    if (*word >= 2) stage.bolts.push_back(*word - 2);
    for (std::size_t k = 0; *word == 0 && k < std::max<std::size_t>(patterns.size(), 1); ++k)
      stage.bolts.push_back(k);
  }
}

void read_run(Section& s, RunInput& run) {
  const bool known = s.choice<RunMethod>("method", run.method,
                                         {{"two-level", RunMethod::two_level},
                                          {"relaxation", RunMethod::relaxation},
                                          {"explicit", RunMethod::explicit_}},
                                         Need::optional);
  s.choice<LinearMethod>("linear_solver", run.linear_solver,
                         {{"automatic", LinearMethod::automatic},
                          {"direct", LinearMethod::direct},
                          {"iterative", LinearMethod::iterative}},
                         Need::optional);
  s.number("tolerance", run.tolerance, tolerance_range, Need::optional);
  std::optional<double> displacement_limit, contact_update_limit;
  s.quantity("displacement_limit", displacement_limit, dimension::length, above(0));
  run.displacement_limit = displacement_limit.value_or(run.displacement_limit);
  s.quantity("contact_update_limit", contact_update_limit, dimension::length, above(0));
  run.contact_update_limit = contact_update_limit.value_or(run.contact_update_limit);
  if (contact_update_limit && displacement_limit && *contact_update_limit >= *displacement_limit)
    s.complain("contact_update_limit",
               "is never reached: a block that has moved so far is detached (displacement_limit: " +
                   format_quantity(*displacement_limit, dimension::length) + ")",
               "a length below displacement_limit");
  if (const auto value = s.find("max_steps", Need::optional))
    run.max_steps = value->as_integer(1, 2'000'000'000);
  const auto of_explicit = [&] {
    s.number("damping", run.damping, between(0, 0.95), Need::optional);
    s.integer("ramp_steps", run.ramp_steps, 0, 1'000'000'000);
  };
  if (known) {
    s.only_with(run.method == RunMethod::explicit_, "method = \"explicit\"", of_explicit);
  } else {
    s.unread(of_explicit);
  }
  const std::int64_t most = run.max_steps.value_or(voussoir::Explicit::Params{}.max_steps);
  if (known && run.method == RunMethod::explicit_ && most <= run.ramp_steps)
    s.complain(run.max_steps ? "max_steps" : "ramp_steps",
               "leaves no step after the ramp: max_steps = " + std::to_string(most) +
                   ", ramp_steps = " + std::to_string(run.ramp_steps),
               "max_steps above ramp_steps");
}

void read_diagram(Section& s, DiagramInput& diagram) {
  const std::string spacing_list =
      R"(a rising list of 2 to 100 bolt spacings, all angles or all lengths, "none" last, such as ["9 deg", "18 deg", "none"])";
  const std::string thickness_list =
      R"(a rising list of 2 to 100 lengths, "0 cm" for no lining, such as ["0 cm", "10 cm"])";
  if (const auto value = s.find("spacing", Need::required, spacing_list)) {
    const auto entries = value->as_list(2, 100, spacing_list);
    for (std::size_t i = 0; entries && i < entries->size(); ++i) {
      const Value& entry = entries->at(i);
      std::optional<BoltSpacing> spacing;
      if (entry.node().kind == Node::Kind::text && entry.node().text == "none") {
        if (i + 1 < entries->size()) entry.refuse("is not the last entry", spacing_list);
      } else {
        spacing = read_spacing(entry);
        if (!spacing) continue;
        const auto& previous = diagram.spacing;
        if (!previous.empty() && previous.back()) {
          if (previous.back()->is_angle != spacing->is_angle) {
            entry.refuse("mixes angles and lengths", spacing_list);
          } else if (!(spacing->value > previous.back()->value)) {
            entry.refuse("is not above the entry before it", spacing_list);
          }
        }
      }
      diagram.spacing.push_back(spacing);
    }
  }
  if (const auto value = s.find("thickness", Need::required, thickness_list)) {
    const auto entries = value->as_list(2, 100, thickness_list);
    for (std::size_t i = 0; entries && i < entries->size(); ++i) {
      const auto thickness = entries->at(i).as_quantity(dimension::length, at_least(0));
      if (!thickness) continue;
      if (*thickness > 0 && !thickness_range.contains(*thickness)) {
        entries->at(i).refuse("is outside the accepted range",
                              "0 for no lining, or " + thickness_range.text(&dimension::length));
        continue;
      }
      if (!diagram.thickness.empty() && !(*thickness > diagram.thickness.back()))
        entries->at(i).refuse("is not above the entry before it", thickness_list);
      diagram.thickness.push_back(*thickness);
    }
  }
}

void read_all(Section& file, Input& input, const std::filesystem::path& directory) {
  int schema = 1;
  file.integer("schema", schema, 1, 1);
  file.text("title", input.title);
  const auto rock = [&] {
    file.table("rock", [&](Section& s) {
      s.quantity("density", input.rock.density, dimension::density, density_range, Need::required);
    });
    file.table("joint", [&](Section& s) { input.joint = read_joint_law(s, nullptr); });
    file.table("run", [&](Section& s) { read_run(s, input.run); });
  };
  if (has_laid_blocks(file)) {
    rock();
    read_laid_blocks(file, input, directory);
    return file.finish();
  }
  file.table("model", [&](Section& s) { read_model(s, input); });
  file.table("tunnel", [&](Section& s) { read_tunnel(s, input, directory); });
  rock();
  file.table("stress", [&](Section& s) { read_stress(s, input); });
  file.table("boundary", [&](Section& s) { read_boundary(s, input.boundary); });
  file.tables("joint_set", [&](Section& s, std::size_t i) {
    JointSetInput& set = input.joint_sets.emplace_back();
    set.name = "set " + std::to_string(i + 1);
    const bool is_surveyed = file.has("joints", "orientations");
    read_joint_set(s, input, set,
                   file.has("joints") && (file.has("joints", "file") || !is_surveyed), is_surveyed);
  });
  file.optional_table("joints", [&](Section& s) { read_mapped(s, input, directory); });
  read_survey(file, input);
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k)
    if (input.joint_sets[k].is_azimuth && input.joint_sets[k].is_random() && !input.tunnel.trend)
      file.complain("joint_set[" + std::to_string(k) + "].dip_direction",
                    "is an azimuth, and the file does not say where the tunnel goes",
                    R"(tunnel.trend = "0 deg", clockwise from North, looking along the tunnel)");
  file.table("blocks", [&](Section& s) { read_blocks(s, input.blocks); });
  file.table("support", [&](Section& support) {
    input.lists_bolts = support.has_list("bolts");
    support.table_or_tables("bolts", [&](Section& s, std::size_t k) {
      BoltsInput& pattern = k == 0 ? input.bolts.emplace() : input.further_bolts.emplace_back();
      pattern.name = "bolts " + std::to_string(k + 1);
      read_bolts(s, pattern);
    });
    support.optional_table("lining", [&](Section& s) { read_lining(s, input); });
  });
  input.has_rounds = file.has("round");
  for (const char* const table : {"stage", "round"})
    file.tables(table, [&](Section& s, std::size_t i) {
      const bool is_round = table == std::string_view("round");
      if (!is_round && input.has_rounds && i == 0)
        file.complain(
            "stage", "is given besides round, and nothing says which comes first",
            R"([[round]] alone; a stage without excavation is one with excavate = "nothing")");
      StageInput& stage = input.stages.emplace_back();
      stage.name = std::string(table).append(" ").append(std::to_string(i + 1));
      read_stage(s, input, stage, is_round);
      if (!is_round && i == 0) stage.part = SectionPart{};
    });
  refuse_loads_on_blocks(file);
  file.optional_table("diagram", [&](Section& s) { read_diagram(s, input.diagram.emplace()); });
  file.finish();
}

}  // namespace

double TunnelInput::half_width() const {
  if (shape == TunnelShape::circle) return diameter / 2;
  if (shape == TunnelShape::horseshoe) return width / 2;
  const auto [low, high] = std::minmax_element(
      vertices.begin(), vertices.end(), [](const Point& a, const Point& b) { return a[0] < b[0]; });
  return vertices.empty() ? 0 : ((*high)[0] - (*low)[0]) / 2;
}

double TunnelInput::crown() const {
  if (shape != TunnelShape::polygon) return half_width();
  double y = vertices.empty() ? 0 : vertices.front()[1];
  for (const Point& vertex : vertices) y = std::max(y, vertex[1]);
  return y;
}

double TunnelInput::invert() const {
  if (shape == TunnelShape::circle) return -half_width();
  if (shape == TunnelShape::horseshoe) return -wall_height;
  double y = vertices.empty() ? 0 : vertices.front()[1];
  for (const Point& vertex : vertices) y = std::min(y, vertex[1]);
  return y;
}

bool names_a_file(std::string_view line) {
  for (const std::string_view key :
       {"joints.file", "joints.orientations", "blocks.file", "tunnel.file"})
    if (line.starts_with(std::string(key).append(" = "))) return true;
  return false;
}

int Input::round_count() const {
  if (!tunnel.round_length) return 1;
  return tunnel.rounds.value_or(
      std::max(1, static_cast<int>(std::floor(model.length / *tunnel.round_length * (1 + 1e-9)))));
}

std::vector<const BoltsInput*> Input::bolt_patterns() const {
  std::vector<const BoltsInput*> patterns;
  if (bolts) patterns.push_back(&*bolts);
  for (const BoltsInput& pattern : further_bolts) patterns.push_back(&pattern);
  return patterns;
}

std::string Input::bolts_key(std::size_t pattern) const {
  const std::string key = "support.bolts";
  return !lists_bolts ? key : key + "[" + std::to_string(pattern) + "]";
}

double Input::K0_across() const {
  if (!stress.K0_minor) return stress.K0;
  // The section's right is a quarter turn clockwise from the tunnel.
  const double along = elementary::cosine(stress.K0_trend.value_or(0) - tunnel.trend.value_or(0));
  return stress.K0 + (*stress.K0_minor - stress.K0) * along * along;
}

std::string Input::unused_text() const {
  if (unused.empty()) return "";
  std::string text = is_spatial() ? "not used in 3-D, where the rock ahead of the face is there: "
                                  : "not used in a section (model.dimension = 2): ";
  for (const std::string& key : unused) text += (&key == &unused.front() ? "" : ", ") + key;
  return text;
}

double Input::domain_top() const { return tunnel.crown() + tunnel.cover; }
double Input::domain_bottom() const { return tunnel.invert() - model.below_invert; }

namespace {

/// In 3-D every crossing of three joints splits a block.
SizeEstimate estimate_spatial_size(const Input& input) {
  const double height = input.domain_top() - input.domain_bottom();
  const double volume = input.model.width * height * input.model.length;
  const double across = std::cbrt(volume);
  struct Set {
    double p32, area;  // 1/m; of a joint inside the domain, m^2
    Vec3 normal;
  };
  std::vector<Set> sets;
  for (const JointSetInput& set : input.joint_sets) {
    const double extent = std::min(mean_extent(set), across);
    sets.push_back({p32_of(set, input.tunnel.trend.value_or(0)),
                    extent * std::min(set.strike_extent.value_or(extent), across),
                    upward_normal(set.plane)});
  }
  SizeEstimate size{0, 1};
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const double joints = sets[i].p32 * volume / sets[i].area;
    size.joints += joints;
    size.blocks += joints;
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k)
        size.blocks += sets[i].p32 * sets[j].p32 * sets[k].p32 * volume *
                       std::abs(sets[i].normal.dot(cross(sets[j].normal, sets[k].normal)));
  }
  // Of cubes there would be 0.125 per cube of the inscribed radius.
  const double radius = input.blocks.min_inscribed_radius;
  size.blocks = std::min(size.blocks, 0.1 * volume / (radius * radius * radius));
  return size;
}

}  // namespace

SizeEstimate estimate_size(const Input& input) {
  const bool is_prismatic =
      std::all_of(input.joint_sets.begin(), input.joint_sets.end(),
                  [&](const JointSetInput& set) { return is_of_section(input, set); });
  if (input.is_spatial() && !is_prismatic) return estimate_spatial_size(input);
  const double height = input.domain_top() - input.domain_bottom();
  const double area = input.model.width * height;
  struct Set {
    double intensity, frequency, angle;  // 1/m^2; length of trace per area, 1/m; rad
  };
  std::vector<Set> sets;
  for (const JointSetInput& set : input.joint_sets) {
    const auto shown = section_set(set, input.tunnel.trend.value_or(0));
    if (!shown) continue;
    const double extent = std::min(shown->extent, std::max(input.model.width, height));
    const double frequency = shown->spacing > 0 ? 1 / shown->spacing : shown->intensity * extent;
    const double angle = shown->dip_direction == DipDirection::east ? -shown->dip : shown->dip;
    sets.push_back(
        {shown->intensity > 0 ? shown->intensity : frequency / extent, frequency, angle});
  }
  SizeEstimate size{0, 1};
  // Every trace splits a block, and so does every crossing of two traces.
  for (std::size_t i = 0; i < sets.size(); ++i) {
    size.joints += sets[i].intensity * area;
    size.blocks += sets[i].intensity * area;
    for (std::size_t j = 0; j < i; ++j)
      size.blocks += sets[i].frequency * sets[j].frequency * area *
                     std::abs(elementary::sine(sets[i].angle - sets[j].angle));
  }
  // Cutting stops when no child would hold the smallest circle. Random masses of three sets then
  // have 0.09 (short joints) to 0.13 (through-going ones) blocks per square of its radius.
  const double radius = input.blocks.min_inscribed_radius;
  size.blocks = std::min(size.blocks, 0.13 * area / (radius * radius));
  return size;
}

Input read_input_text(std::string_view text, const std::string& name,
                      const std::filesystem::path& directory,
                      const std::vector<std::string>& overrides) {
  const Document document = read_document(text, name, overrides);
  Checker checker(document);
  Input input;
  Section file(checker, &document.root, "");
  read_all(file, input, directory);
  if (input.laid) {
    checker.finish();
    input.content = canonical_lines(document);
    return input;
  }
  check_together(checker, input);
  checker.finish();
  input.content = canonical_lines(document);
  // What a survey comes to decides the rock, wherever its file lies.
  for (const JointSetInput& set : input.joint_sets)
    if (set.surveyed >= 0)
      input.content.push_back(set.name + " (surveyed) = " + shortest_text(set.plane.dip) + ", " +
                              shortest_text(set.plane.dip_direction) + ", " +
                              shortest_text(set.fisher.value_or(0)));
  if (!input.tunnel.drawn.empty())
    for (const Point& p : input.tunnel.vertices)
      input.content.push_back("tunnel.file (a point) = " + shortest_text(p[0]) + ", " +
                              shortest_text(p[1]));
  return input;
}

Input read_input(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return read_input_text(read_text(file), utf8_text(file), file.parent_path(), overrides);
}

}  // namespace voussoir::program
