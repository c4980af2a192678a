// SPDX-License-Identifier: MIT
#include "rock_input.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <voussoir/core/elementary.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/operating_system.hpp>

#include "drawn_outline.hpp"
#include "joint_laws.hpp"
#include "orientation_input.hpp"

namespace voussoir::program {

namespace {

// Ranges of what the equations add up. Far outside of them one spring drowns another in the 16
// digits of a number, and a body then "can move without resistance".
constexpr Range surcharge_range{.low = 0, .high = 1e9};  // [Pa]
constexpr Range ground_range{.low = 1e3, .high = 1e13};  // modulus of ground [Pa]

}  // namespace

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
  if (const auto value = s.find("origin", Need::optional, point_form))
    model.origin = value->as_point().value_or(model.origin);
}

void read_stress(Section& s, Input& input) {
  StressInput& stress = input.stress;
  s.number("K0", stress.K0, between(0, 10), Need::required);
  s.number("K0_minor", stress.K0_minor, between(0, 10));
  s.quantity("K0_trend", stress.K0_trend, dimension::angle, between(0, radians(360)));
  s.quantity("horizontal", stress.horizontal, dimension::pressure, surcharge_range, Need::optional);
  s.quantity("surcharge", stress.surcharge, dimension::pressure, surcharge_range, Need::optional);
  const bool has_minor = s.has("K0_minor");
  if (has_minor != s.has("K0_trend"))
    s.complain(
        has_minor ? "K0_minor" : "K0_trend",
        has_minor ? "is given without K0_trend" : "is given without K0_minor",
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

namespace {

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

void read_vertices(Section& s, std::vector<Point>& vertices, bool holds_centre, Need need) {
  const std::string form =
      R"(3 to 2000 points [["-2 m", "-2 m"], ["2 m", "-2 m"], ["0 m", "3 m"]])" +
      std::string(holds_centre ? " around the tunnel centre" : "") + ", sides that do not cross";
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
  if (const std::string fault = outline_fault(vertices, holds_centre); !fault.empty())
    return s.checker().report(value->node().place, value->key(), value->key() + " " + fault, form);
  if (signed_area(vertices) < 0) std::reverse(vertices.begin(), vertices.end());
}

/// The outline by its points, or from a drawing, whose place on the site is `centre` [m].
void read_outline(Section& s, OutlineInput& outline, const Point& centre, bool holds_centre,
                  bool is_required, const std::filesystem::path& directory) {
  const bool has_file = s.has("file");
  read_vertices(s, outline.vertices, holds_centre,
                is_required && !has_file ? Need::required : Need::optional);
  const std::filesystem::path file = read_path(s, "file", Need::optional, directory);
  std::string layer;
  double unit = 0;
  s.only_with(has_file, "file", [&] {
    s.text("layer", layer);
    read_drawing_unit(s, unit);
  });
  if (file.empty() || s.faulty("unit") || s.checker().faulty("model")) return;
  if (s.has("vertices"))
    return s.complain("vertices", "are given besides " + s.full("file"), "one of the two");
  outline.vertices = drawn_outline(s, outline.drawn, file, {layer, unit, centre, holds_centre});
}

/// @param centre  on the site [m]
void read_shape(Section& s, OutlineInput& outline, const Point& centre,
                const std::filesystem::path& directory) {
  const bool known = s.choice<TunnelShape>("shape", outline.shape,
                                           {{"circle", TunnelShape::circle},
                                            {"horseshoe", TunnelShape::horseshoe},
                                            {"polygon", TunnelShape::polygon}},
                                           Need::required);
  const auto of_shape = [&](TunnelShape shape, const std::string& word,
                            const std::function<void()>& declare) {
    if (!known) return s.unread(declare);
    s.only_with(outline.shape == shape, "shape = \"" + word + "\"", declare);
  };
  of_shape(TunnelShape::circle, "circle", [&] {
    s.quantity("diameter", outline.diameter, dimension::length, above(0), Need::required);
  });
  of_shape(TunnelShape::horseshoe, "horseshoe", [&] {
    s.quantity("width", outline.width, dimension::length, above(0), Need::required);
    s.quantity("wall_height", outline.wall_height, dimension::length, above(0), Need::required);
  });
  of_shape(TunnelShape::polygon, "polygon",
           [&] { read_outline(s, outline, centre, true, true, directory); });
  s.integer("facets", outline.facets, 12, 720);
}

}  // namespace

void read_tunnel(Section& s, Input& input, const std::filesystem::path& directory) {
  TunnelInput& tunnel = input.tunnel;
  read_shape(s, tunnel, input.model.origin, directory);
  s.quantity("cover", tunnel.cover, dimension::length, above(0), Need::required);
  s.quantity("trend", tunnel.trend, dimension::angle, between(0, radians(360)));
  s.quantity("plunge", tunnel.plunge, dimension::angle, between(-radians(45), radians(45)),
             Need::optional);
  s.quantity("round_length", tunnel.round_length, dimension::length, above(0));
  s.only_with(s.has("round_length"), "round_length",
              [&] { s.integer("rounds", tunnel.rounds, 1, 1000); });
  if (input.is_spatial()) return;
  for (const char* const key : {"round_length", "rounds"}) note_unused(input, s, key);
}

void read_opening(Section& s, Input& input, OpeningInput& opening,
                  const std::filesystem::path& directory) {
  s.text("name", opening.name);
  if (const auto value = s.find("at", Need::required, point_form))
    opening.at = value->as_point().value_or(opening.at);
  read_shape(s, opening,
             {input.model.origin[0] + opening.at[0], input.model.origin[1] + opening.at[1]},
             directory);
  s.quantity("turn", opening.turn, dimension::angle, between(-radians(180), radians(180)),
             Need::optional);
  s.quantity("plunge", opening.plunge, dimension::angle, between(-radians(90), radians(90)));
  s.quantity("place", opening.place, dimension::length, at_least(0), Need::optional);
  s.quantity("from", opening.from, dimension::length, Range{});
  s.quantity("to", opening.to, dimension::length, Range{});
  s.only_with(input.tunnel.round_length.has_value(), "tunnel.round_length", [&] {
    s.quantity("round_length", opening.round_length, dimension::length, above(0));
  });
  if (input.is_spatial() || !opening.is_along_tunnel(input.tunnel)) return;
  for (const char* const key : {"place", "from", "to", "round_length"}) note_unused(input, s, key);
}

void read_round_outline(Section& s, Input& input, StageInput& round,
                        const std::filesystem::path& directory) {
  OutlineInput outline;
  Vec2 centre = input.model.origin;
  if (round.opening > 0) centre += input.openings[round.opening - 1].at;
  read_outline(s, outline, centre, false, false, directory);
  round.outline = outline.vertices;
  if (!outline.drawn.empty()) input.drawn_rounds.push_back(input.stages.size() - 1);
}

namespace {

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

/// The part of its planes that is parted: as such, or by the gaps between joints.
void read_persistence(Section& s, JointSetInput& set) {
  std::optional<double> gap;
  s.quantity("persistence", set.persistence, dimension::number,
             {.low = 0, .high = 1, .low_included = false});
  s.quantity("gap", gap, dimension::length, above(0));
  const bool has_both = s.has("persistence") && s.has("gap");
  const char* const key = s.has("gap") ? "gap" : "persistence";
  if (has_both) {
    s.complain("gap", "is given besides persistence",
               "one of the two; persistence = extent / (extent + gap)");
  } else if (s.has(key) && (!s.has("spacing") || !s.has("extent"))) {
    s.complain(key, "is of joints by their spacing, which have an extent",
               R"(spacing = "2 m" of their planes and extent = "5 m" besides it)");
  } else if (gap && std::isfinite(set.extent)) {
    set.persistence = set.extent / (set.extent + *gap);
  }
}

}  // namespace

void read_joint_set(Section& s, Input& input, JointSetInput& set, JointSetFile& set_file,
                    bool is_mapped, bool is_surveyed) {
  std::vector<const char*> given{"intensity", "P32", "P30", "spacing"};
  std::erase_if(given, [&](const char* key) { return !s.has(key); });
  const bool is_random = !given.empty();
  set_file.wants_survey = is_surveyed && is_random && !s.has("dip") && !s.has("dip_direction");
  const Need need =
      (is_mapped && !is_random) || set_file.wants_survey ? Need::optional : Need::required;
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
  s.quantity("P30", set.p30, dimension::number_per_volume,
             {.low = 0, .high = 1e6, .low_included = false});
  s.only_with(is_random || !is_mapped, "intensity, spacing, P32 or P30", [&] {
    s.quantity("sd", set.sd, dimension::angle, between(0, radians(45)), Need::optional);
    s.number("K", set.fisher, {.low = 5, .high = 1e6});
    s.quantity("extent", set.extent, dimension::length, above(0), Need::optional,
               Infinity::allowed);
    s.quantity("strike_extent", set.strike_extent, dimension::length, above(0));
  });
  if (!input.is_spatial()) note_unused(input, s, "strike_extent");
  read_persistence(s, set);
  check_spacing(s, set);
  if (set.p30 && std::isinf(set.extent) && !s.faulty("extent"))
    s.complain("P30", "counts joints, and their area is not known without an extent",
               R"(extent = "2 m" besides it, or P32)");
  else if (set.p30 && !set.is_azimuth && !set_file.wants_survey && !input.tunnel.trend)
    s.complain(
        "P30", "is of a set of the section, whose joints go on along the tunnel without end",
        R"(intensity, the number of traces per area; or a dip_direction by azimuth and tunnel.trend)");
  if (s.has("sd") && s.has("K"))
    s.complain("K", "is given besides sd", "one of the two; K = 1 / sd^2, sd in radians");
  if (set.strike_extent && !set.is_azimuth && !set_file.wants_survey && !input.tunnel.trend)
    s.complain("strike_extent",
               "is of a set of the section, whose joints go on along the tunnel without end",
               "no strike_extent, or a dip_direction by azimuth and tunnel.trend");
  else if (set.strike_extent && std::isinf(set.extent) && !s.faulty("extent"))
    s.complain("strike_extent", "is of joints that have no extent down the dip",
               R"(extent = "2 m" besides it)");
  if (const JointLawInput law = read_joint_law(s, &input.joint_law); !law.given.empty()) {
    set_file.law = law;
    if (law.is_sound) set.law = joint_of(law);
  }
  if (given.size() > 1) {
    s.complain(given.back(), std::string("is given besides ") + given.front(),
               "one of intensity, spacing, P32 and P30");
  } else if (!is_random && !is_mapped) {
    s.complain(
        "intensity", "is missing, and so are spacing, P32 and P30",
        R"(one of intensity = "1 /m^2", spacing = "1.2 m", P32 = "1.5 m^2/m^3" and P30 = "0.1 /m^3"; or joints.file, with mapped joints of this set)");
  } else if (set.intensity && std::isinf(set.extent) && !s.faulty("extent")) {
    s.complain(
        "intensity",
        "counts centres per area, and of joints without extent more reach into a large "
        "domain than into a small one",
        R"(extent = "2 m", the length of their traces; or spacing = "1.2 m" in place of intensity: joints that go right through, as far apart in any domain)");
  }
}

void read_mapped(Section& s, Input& input, const std::filesystem::path& directory) {
  TracesInput& mapped = input.mapped;
  s.integer("first_set", input.trace_file.first_set, 0, 1);
  s.quantity("snap", mapped.snap, dimension::length, above(0));
  (void)s.choice<DeadEnds>(
      "dead_ends", mapped.dead_ends,
      {{"do_not_cut", DeadEnds::do_not_cut}, {"cut_through", DeadEnds::cut_through}},
      Need::optional);
  const bool has_survey = s.has("orientations");
  input.joints_file = read_path(s, "file", has_survey ? Need::optional : Need::required, directory);
  s.only_with(is_drawing(input.joints_file), "a drawing as file",
              [&] { read_drawing_unit(s, input.trace_file.unit); });
  if (const auto file = read_path(s, "orientations", Need::optional, directory); !file.empty())
    input.survey.emplace().file = file;
  SurveyInput unused;
  SurveyInput& survey = input.survey ? *input.survey : unused;
  s.only_with(has_survey, "orientations", [&] {
    s.quantity("declination", survey.declination, dimension::angle,
               between(-radians(90), radians(90)), Need::optional);
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

}  // namespace voussoir::program
