// SPDX-License-Identifier: MIT
#include "input.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <voussoir/core/elementary.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/io/operating_system.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/lining/node_spacing.hpp>

#include "blocks_input.hpp"
#include "input_document.hpp"
#include "input_section.hpp"
#include "orientation_input.hpp"
#include "plausibility.hpp"

namespace voussoir::program {

namespace {

// Rounded as a quantity read from a text is, so that "90 deg" equals its bound.
double degrees(double angle) { return angle * std::numbers::pi / 180; }

Range angle_below_90() { return {.low = 0, .high = degrees(90), .high_included = false}; }

// ---- Ranges of what the equations add up. Far outside of them one spring drowns another in the
// ---- 16 digits of a number, and a body then "can move without resistance"; or blocks take for
// ---- ever to fall.

constexpr Range per_area_range{.low = 1e3, .high = 1e12};       // joints, interface [Pa/m]
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
constexpr Range thickness_range{.low = 1e-3, .high = 10};      // of a lining [m]
constexpr Range ground_range{.low = 1e3, .high = 1e13};        // modulus of ground [Pa]

// ---- The keys: name, where it goes, dimension, range, needed or not. Defaults are in input.hpp.

void read_model(Section& s, ModelInput& model) {
  s.quantity("width", model.width, dimension::length, above(0), Need::required);
  s.quantity("below_invert", model.below_invert, dimension::length, above(0), Need::required);
  s.integer("seed", model.seed, 0, std::numeric_limits<std::int64_t>::max());
  s.quantity("gravity", model.gravity, dimension::acceleration, gravity_range, Need::optional);
  if (const auto value = s.find("origin", Need::optional))
    model.origin = value->as_point().value_or(model.origin);
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

/// Twice the area, positive when anticlockwise, about the first vertex (site coordinates).
double signed_area(const std::vector<Point>& v) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < v.size(); ++i)
    sum += (v[i][0] - v[0][0]) * (v[i + 1][1] - v[0][1]) -
           (v[i + 1][0] - v[0][0]) * (v[i][1] - v[0][1]);
  return sum;
}

double turn(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

bool within_box(const Point& a, const Point& b, const Point& p) {
  return p[0] >= std::min(a[0], b[0]) && p[0] <= std::max(a[0], b[0]) &&
         p[1] >= std::min(a[1], b[1]) && p[1] <= std::max(a[1], b[1]);
}

/// Whether the closed segments ab and cd have a point in common.
bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double c_side = turn(a, b, c), d_side = turn(a, b, d);
  const double a_side = turn(c, d, a), b_side = turn(c, d, b);
  if (((c_side > 0 && d_side < 0) || (c_side < 0 && d_side > 0)) &&
      ((a_side > 0 && b_side < 0) || (a_side < 0 && b_side > 0)))
    return true;
  return (c_side == 0 && within_box(a, b, c)) || (d_side == 0 && within_box(a, b, d)) ||
         (a_side == 0 && within_box(c, d, a)) || (b_side == 0 && within_box(c, d, b));
}

bool contains_centre(const std::vector<Point>& v) {
  bool inside = false;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++)
    if ((v[i][1] > 0) != (v[j][1] > 0) &&
        v[i][0] - v[i][1] * (v[j][0] - v[i][0]) / (v[j][1] - v[i][1]) > 0)
      inside = !inside;
  return inside;
}

/// @return  what keeps the vertices from being a simple polygon around (0, 0); empty if they are.
/// @cost  O(n^2) for n vertices
std::string polygon_fault(const std::vector<Point>& v) {
  const auto named = [](std::size_t i) { return std::to_string(i); };
  const std::size_t count = v.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      if (v[i] == v[j]) return "repeats vertex " + named(i) + " as vertex " + named(j);
  for (std::size_t i = 0; i < count; ++i) {
    const Point &a = v[i], &b = v[(i + 1) % count], &c = v[(i + 2) % count];
    const double ahead = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
    if (turn(a, b, c) == 0 && ahead < 0)
      return "folds back on itself at vertex " + named((i + 1) % count);
    for (std::size_t j = i + 2; j < count; ++j) {
      if ((j + 1) % count == i) continue;  // neighbours share a vertex
      if (segments_meet(a, b, v[j], v[(j + 1) % count]))
        return "crosses itself: the sides from vertex " + named(i) + " and from vertex " +
               named(j) + " meet";
    }
  }
  if (signed_area(v) == 0) return "encloses no area";
  if (!contains_centre(v)) return "does not contain the tunnel centre (0, 0)";
  return "";
}

void read_vertices(Section& s, std::vector<Point>& vertices) {
  const std::string form =
      R"(3 to 2000 points [["-2 m", "-2 m"], ["2 m", "-2 m"], ["0 m", "3 m"]] around the tunnel centre, sides that do not cross)";
  const auto value = s.find("vertices", Need::required, form);
  if (!value) return;
  const auto points = value->as_list(3, 2000, form);
  if (!points) return;
  for (const Value& point : *points)
    if (const auto read = point.as_point()) vertices.push_back(*read);
  if (vertices.size() != points->size()) return;  // already reported
  if (const std::string fault = polygon_fault(vertices); !fault.empty())
    return s.checker().report(value->node().place, value->key(), value->key() + " " + fault, form);
  if (signed_area(vertices) < 0) std::reverse(vertices.begin(), vertices.end());
}

void read_tunnel(Section& s, TunnelInput& tunnel) {
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
  of_shape(TunnelShape::polygon, "polygon", [&] { read_vertices(s, tunnel.vertices); });
  s.quantity("cover", tunnel.cover, dimension::length, above(0), Need::required);
  s.integer("facets", tunnel.facets, 12, 720);
}

/// @param is_mapped  joints.file may give the joints of a set that has no random ones
void read_joint_set(Section& s, JointSetInput& set, bool is_mapped) {
  const bool is_random = s.has("intensity") || s.has("spacing");
  const Need need = is_mapped && !is_random ? Need::optional : Need::required;
  s.text("name", set.name);
  read_orientation(s, set, need);
  // One of the two, so the one that is there decides which of them is needed.
  const bool both = s.has("intensity") && s.has("spacing");
  s.quantity("intensity", set.intensity, dimension::intensity,
             {.low = 0, .high = 1e4, .low_included = false});
  s.quantity("spacing", set.spacing, dimension::length, above(0));
  s.only_with(is_random || !is_mapped, "intensity or spacing", [&] {
    s.quantity("sd", set.sd, dimension::angle, between(0, degrees(45)), Need::optional);
    s.quantity("extent", set.extent, dimension::length, above(0), Need::optional,
               Infinity::allowed);
  });
  s.quantity("kn", set.normal_stiffness, dimension::stiffness_per_area, per_area_range);
  s.quantity("ks", set.shear_stiffness, dimension::stiffness_per_area, per_area_range);
  s.quantity("friction", set.friction_angle, dimension::angle, angle_below_90());
  if (both) {
    s.complain("spacing", "is given besides intensity", "one of intensity and spacing");
  } else if (!is_random && !is_mapped) {
    s.complain(
        "intensity", "is missing, and so is spacing",
        R"(either intensity = "1 /m^2" or spacing = "1.2 m"; or joints.file, with mapped joints of this set)");
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
  const std::string form = "a file name, relative to the input file";
  const auto value = s.find("file", Need::required, form);
  const auto text = value ? value->as_text() : std::nullopt;
  if (!text) return;
  if (text->empty()) {
    value->refuse("is empty", form);
    return;
  }
  // A path in the file is UTF-8 whatever the system's own encoding.
  input.joints_file = directory / utf8_path(*text);
}

void read_joint(Section& s, JointInput& joint) {
  s.quantity("kn", joint.normal_stiffness, dimension::stiffness_per_area, per_area_range,
             Need::required);
  s.quantity("ks", joint.shear_stiffness, dimension::stiffness_per_area, per_area_range,
             Need::required);
  s.quantity("friction", joint.friction_angle, dimension::angle, angle_below_90(), Need::required);
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

void read_bolts(Section& s, BoltsInput& bolts) {
  s.quantity("length", bolts.length, dimension::length, above(0), Need::required);
  if (const auto value = s.find("spacing", Need::required, spacing_form))
    bolts.spacing = read_spacing(*value).value_or(bolts.spacing);
  bolts.arc = {0, degrees(180)};
  if (const auto value = s.find("arc", Need::optional))
    bolts.arc = read_arc(*value).value_or(bolts.arc);
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

void read_lining(Section& s, LiningInput& lining) {
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

void read_stage(Section& s, StageInput& stage) {
  s.text("name", stage.name);
  s.quantity("wall_traction", stage.wall_traction, dimension::number, between(0, 1),
             Need::required);
  const auto value = s.find("install", Need::optional);
  if (!value) return;
  const auto items = value->as_list(0, 2, R"(a list of "bolts", "lining")");
  if (!items) return;
  for (const Value& item : *items) {
    const auto word = item.as_word({"bolts", "lining"});
    if (!word) continue;
    bool& installed = *word == 0 ? stage.install_bolts : stage.install_lining;
    if (installed) item.refuse("is in the list twice", "each support once");
    installed = true;
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
    file.table("joint", [&](Section& s) { read_joint(s, input.joint); });
    file.table("run", [&](Section& s) { read_run(s, input.run); });
  };
  if (has_laid_blocks(file)) {
    rock();
    read_laid_blocks(file, input, directory);
    return file.finish();
  }
  file.table("model", [&](Section& s) { read_model(s, input.model); });
  file.table("tunnel", [&](Section& s) { read_tunnel(s, input.tunnel); });
  rock();
  file.table("stress", [&](Section& s) {
    s.number("K0", input.stress.K0, between(0, 10), Need::required);
    s.quantity("surcharge", input.stress.surcharge, dimension::pressure, surcharge_range,
               Need::optional);
  });
  file.table("boundary", [&](Section& s) { read_boundary(s, input.boundary); });
  file.tables("joint_set", [&](Section& s, std::size_t i) {
    JointSetInput& set = input.joint_sets.emplace_back();
    set.name = "set " + std::to_string(i + 1);
    read_joint_set(s, set, file.has("joints"));
  });
  file.optional_table("joints", [&](Section& s) { read_mapped(s, input, directory); });
  file.table("blocks", [&](Section& s) { read_blocks(s, input.blocks); });
  file.table("support", [&](Section& support) {
    support.optional_table("bolts", [&](Section& s) { read_bolts(s, input.bolts.emplace()); });
    support.optional_table("lining", [&](Section& s) { read_lining(s, input.lining.emplace()); });
  });
  file.tables("stage", [&](Section& s, std::size_t i) {
    StageInput& stage = input.stages.emplace_back();
    stage.name = "stage " + std::to_string(i + 1);
    read_stage(s, stage);
  });
  refuse_loads_on_blocks(file);
  file.optional_table("diagram", [&](Section& s) { read_diagram(s, input.diagram.emplace()); });
  file.finish();
}

// ---- What two or more keys must agree on. Each looks only at keys that were read without fault.

void check_opening(Checker& checker, const Input& input) {
  if (checker.faulty("tunnel")) return;
  const double half_width = input.tunnel.half_width();
  const std::string below =
      "below " + format_quantity(half_width, dimension::length) + ", half the width of the opening";
  const char* const keys[] = {"diameter", "width", "vertices"};
  const std::string opening = std::string(" (tunnel.") +
                              keys[static_cast<int>(input.tunnel.shape)] + ": " +
                              format_quantity(2 * half_width, dimension::length) + " wide)";
  if (!checker.faulty("model")) {
    double reach = half_width;  // of the opening to a side; a polygon may sit off its centre
    for (const Point& vertex : input.tunnel.vertices) reach = std::max(reach, std::abs(vertex[0]));
    if (!(reach < input.model.width / 2)) {
      checker.report("model.width", "leaves no ground beside the opening" + opening,
                     "above " + format_quantity(2 * reach, dimension::length));
    }
  }
  if (!checker.faulty("blocks") && !(input.blocks.min_inscribed_radius < half_width))
    checker.report("blocks.min_inscribed_radius", "makes blocks larger than the opening" + opening,
                   below);
  if (input.lining && !checker.faulty("support.lining.thickness") &&
      !(input.lining->thickness < half_width))
    checker.report("support.lining.thickness", "fills the opening" + opening, below);
  if (input.diagram && !checker.faulty("diagram.thickness") &&
      !(input.diagram->thickness.back() < half_width))
    checker.report("diagram.thickness", "fills the opening" + opening, below);
}

void check_snap(Checker& checker, const Input& input) {
  if (!input.mapped.snap || checker.faulty("joints") || checker.faulty("blocks")) return;
  if (*input.mapped.snap > input.blocks.min_inscribed_radius)
    checker.report("joints.snap", "closes more than the smallest block is wide",
                   "at most " +
                       format_quantity(input.blocks.min_inscribed_radius, dimension::length) +
                       ", blocks.min_inscribed_radius");
}

std::string counted(double count) {
  return count < 1e15 ? std::to_string(std::llround(count)) : std::string("1e15 or more");
}

/// The arc of a word, and whether feet can stand where it ends.
void check_arc(Checker& checker, Input& input) {
  if (!input.lining || checker.faulty("tunnel") || checker.faulty("support.lining")) return;
  LiningInput& lining = *input.lining;
  const std::string key = "support.lining.arc";
  try {
    const SimplePolygon opening = opening_of(input);
    LiningRing ring{.nodes = lining.nodes.value_or(std::max(input.tunnel.facets, 8))};
    if (lining.part && *lining.part != LinedPart::all) {
      ring = lined_part(opening, *lining.part, ring);
      lining.arc = ArcInput{ring.from, ring.to};
    }
    if (!lining.arc || !lining.feet) return;
    ring.from = lining.arc->from;
    ring.to = lining.arc->to;
    for (const auto& end : detail::ring_nodes(opening, ring).ends) {
      if (end.refusal.empty()) continue;
      const std::string begin = "lining: ", mark = "; accepted: ";
      const std::size_t at = end.refusal.find(mark);
      std::string why = end.refusal.substr(begin.size(), at - begin.size());
      if (input.tunnel.shape == TunnelShape::horseshoe)
        why += " (tunnel.wall_height = " +
               format_quantity(input.tunnel.wall_height, dimension::length) + ")";
      checker.report(key, "is too long for feet: " + why,
                     end.refusal.substr(at + mark.size()) + R"(; "roof and walls" ends there)");
      return;
    }
  } catch (const InvalidInput& fault) {
    checker.report(key, std::string("does not fit the tunnel: ") + fault.what(),
                   R"(two angles, "roof", "roof and walls" or "all")");
  }
}

/// Nodes are close enough together for a bond, see `node_spacing.hpp`.
void check_bond(Checker& checker, const Input& input) {
  if (!input.lining || !(input.lining->tensile_bond > 0)) return;
  for (const char* key : {"support.lining", "tunnel", "diagram"})
    if (checker.faulty(key)) return;
  const LiningInput& lining = *input.lining;
  double thinnest = lining.thickness;
  if (input.diagram)
    for (const double thickness : input.diagram->thickness)
      if (thickness > 0) thinnest = std::min(thinnest, thickness);
  const double length =
      bending_length(LiningSection::rectangular(thinnest, lining.young_modulus).bending_stiffness,
                     lining.interface_normal_stiffness);
  const double perimeter = opening_of(input).perimeter();
  const double least = node_count_for(perimeter, length, coarsest_bonded_spacing),
               chosen = node_count_for(perimeter, length, chosen_bonded_spacing);
  const auto metres = [](double value) { return format_quantity(value, dimension::length); };
  const std::string why = "the bond of a lining " + metres(thinnest) +
                          " thick acts over L = (4 E I / kn)^(1/4) = " + metres(length);
  const std::string others = "a softer interface, or no tensile_bond";
  const std::string enough = counted(least) + " to 2000, no farther apart than " +
                             shortest_text(coarsest_bonded_spacing) + " L";
  if (lining.nodes ? *lining.nodes >= least : chosen <= 2000) return;
  const std::string accepted = least > 2000 ? "a thicker lining, " + others : enough;
  if (lining.nodes)
    checker.report("support.lining.nodes",
                   "puts nodes " + metres(perimeter / *lining.nodes) +
                       " apart, too far to see the bond fail at the edge of a block: " + why,
                   accepted + (chosen <= 2000 ? ", or no key nodes to have it chosen"
                               : least > 2000 ? ""
                                              : ", or " + others));
  else
    checker.report(
        "support.lining",
        "has no key nodes, and " + counted(chosen) + " would be chosen, more than 2000: " + why,
        least > 2000 ? accepted : "a key nodes of " + accepted + ", " + others);
}

void check_boundary(Checker& checker, const Input& input) {
  if (checker.faulty("boundary")) return;
  const BoundaryInput& boundary = input.boundary;
  if (boundary.sides.has_value() != boundary.base.has_value()) {
    const bool has_sides = boundary.sides.has_value();
    checker.report(has_sides ? "boundary.sides" : "boundary.base",
                   std::string("is given, and ") +
                       (has_sides ? "boundary.base" : "boundary.sides") + " is left to be chosen",
                   "both, or neither");
  } else if (boundary.sides == Boundary::stress && boundary.base == Boundary::rollers) {
    checker.report("boundary.base", "leaves the rock free to slide between sides under stress",
                   R"("elastic", or other sides)");
  }
  if (boundary.ground_above && input.stress.surcharge == 0 && !checker.faulty("stress"))
    checker.report("boundary.top",
                   "says that ground goes on above the domain, and stress.surcharge that it weighs "
                   "nothing",
                   R"(stress.surcharge = its weight, or "surface")");
}

void check_size(Checker& checker, const Input& input) {
  for (const char* key : {"model", "tunnel", "joint_set", "blocks"})
    if (checker.faulty(key)) return;
  const SizeEstimate size = estimate_size(input);
  const bool has_many_joints = size.joints > largest_count;
  if (!has_many_joints && !(size.blocks > largest_count)) return;
  const std::string blamed = unusual_among(input, {"model.", "tunnel.", "joint_set", "blocks."});
  if (has_many_joints)
    checker.report("joint_set", "would come to about " + counted(size.joints) + " joints" + blamed,
                   "at most 1000000 in the domain: a smaller domain, or fewer joints");
  else
    checker.report("joint_set", "would come to about " + counted(size.blocks) + " blocks" + blamed,
                   "at most 1000000 in the domain: a smaller domain, fewer joints, or a larger "
                   "blocks.min_inscribed_radius");
}

void check_bolts(Checker& checker, const BoltsInput& bolts) {
  if (checker.faulty("support.bolts")) return;
  const auto below = [&](const std::string& key, double value, const char* limit_key,
                         const std::optional<double>& limit) {
    if (!limit || value < *limit) return;
    checker.report("support.bolts." + key, std::string("is not below ") + limit_key,
                   "below " + format_quantity(*limit, dimension::force));
  };
  below("pretension", bolts.pretension, "yield_force", bolts.yield_force);
  below("pretension", bolts.pretension, "rupture_force", bolts.rupture_force);
  if (bolts.yield_force)
    below("yield_force", *bolts.yield_force, "rupture_force", bolts.rupture_force);
}

void check_stages(Checker& checker, Input& input) {
  if (input.stages.empty()) {
    if (checker.faulty("stage")) return;  // meant to have some
    input.stages.push_back({.name = "excavation and support",
                            .install_bolts = input.bolts.has_value(),
                            .install_lining = input.lining.has_value()});
    return;
  }
  if (checker.faulty("stage")) return;
  const auto key = [](std::size_t i) { return "stage[" + std::to_string(i) + "]"; };
  for (std::size_t i = 1; i < input.stages.size(); ++i) {
    if (input.stages[i].wall_traction > input.stages[i - 1].wall_traction)
      checker.report(
          key(i) + ".wall_traction", "is above that of the stage before",
          "at most " + format_quantity(input.stages[i - 1].wall_traction, dimension::number));
  }
  if (input.stages.back().wall_traction > 0)
    checker.report(key(input.stages.size() - 1) + ".wall_traction",
                   "leaves traction on the wall at the end", R"("0 %" in the last stage)");

  const auto check_support = [&](const std::string& word, bool StageInput::*install, bool exists) {
    bool installed = false;
    for (std::size_t i = 0; i < input.stages.size(); ++i) {
      if (!(input.stages[i].*install)) continue;
      const std::string place = key(i) + ".install";
      if (!exists && !checker.faulty("support"))
        checker.report(place, "names " + word + ", which the file does not describe",
                       "a table [support." + word + "]");
      if (installed) checker.report(place, "names " + word + " again", "each support once");
      installed = true;
    }
    if (exists && !installed)
      checker.report("support." + word, "is in no stage",
                     "install = [\"" + word + "\"] in one [[stage]]");
  };
  check_support("bolts", &StageInput::install_bolts, input.bolts.has_value());
  check_support("lining", &StageInput::install_lining, input.lining.has_value());
}

void check_diagram(Checker& checker, const Input& input) {
  if (!input.diagram || checker.faulty("diagram")) return;
  if (!input.bolts && input.diagram->spacing.front() && !checker.faulty("support"))
    checker.report("diagram.spacing", "varies bolts, which the file does not describe",
                   "a table [support.bolts]");
  if (!input.lining && input.diagram->thickness.back() > 0 && !checker.faulty("support"))
    checker.report("diagram.thickness", "varies a lining, which the file does not describe",
                   "a table [support.lining]");
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
  return line.starts_with("joints.file = ") || line.starts_with("blocks.file = ");
}

double Input::domain_top() const { return tunnel.crown() + tunnel.cover; }
double Input::domain_bottom() const { return tunnel.invert() - model.below_invert; }

SizeEstimate estimate_size(const Input& input) {
  const double height = input.domain_top() - input.domain_bottom();
  const double area = input.model.width * height;
  struct Set {
    double intensity, frequency, angle;  // 1/m^2; length of trace per area, 1/m; rad
  };
  std::vector<Set> sets;
  for (const JointSetInput& set : input.joint_sets) {
    const double extent = std::min(set.extent, std::max(input.model.width, height));
    const double frequency = set.spacing ? 1 / *set.spacing : set.intensity.value_or(0) * extent;
    const double angle = set.dip_direction == DipDirection::east ? -set.dip : set.dip;
    sets.push_back({set.intensity.value_or(frequency / extent), frequency, angle});
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
  check_opening(checker, input);
  check_snap(checker, input);
  check_arc(checker, input);
  check_bond(checker, input);
  check_boundary(checker, input);
  check_size(checker, input);
  if (input.bolts) check_bolts(checker, *input.bolts);
  check_stages(checker, input);
  check_diagram(checker, input);
  checker.finish();
  input.content = canonical_lines(document);
  return input;
}

Input read_input(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return read_input_text(read_text(file), utf8_text(file), file.parent_path(), overrides);
}

}  // namespace voussoir::program
