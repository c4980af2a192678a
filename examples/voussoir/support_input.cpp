// SPDX-License-Identifier: MIT
#include "support_input.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/design/openings.hpp>

#include "input_checks.hpp"
#include "lining_strength.hpp"
#include "rock_input.hpp"

namespace voussoir::program {

namespace {

// Ranges of what the equations add up. Far outside of them one spring drowns another in the 16
// digits of a number, and a body then "can move without resistance".
constexpr Range per_area_range{.low = 1e3, .high = 1e12};                   // interface [Pa/m]
constexpr Range bolt_range{.low = 1e3, .high = 1e12};                       // of one bolt [N/m]
constexpr Range modulus_range{.low = 1e6, .high = 1e12};                    // of a lining [Pa]
constexpr Range out_of_plane_range{.low = 0.01, .high = 1000};              // [m]
constexpr Range force_range{.low = 0, .high = 1e9, .low_included = false};  // of one bolt [N]
constexpr Range bond_per_metre_range{.low = 1, .high = 1e9};     // of the grout of a bolt [N/m]
constexpr Range bond_stiffness_range{.low = 1e5, .high = 1e12};  // of that, over slip [N/m^2]
constexpr Range bar_modulus_range{.low = 1e10, .high = 1e12};    // of a bolt [Pa]
constexpr Range bar_area_range{.low = 1e-5, .high = 0.1};        // of a bolt [m^2]
constexpr Range elongation_range{.low = 1e-4, .high = 10};       // of a bolt that is lost [m]
constexpr Range bond_range{.low = 100, .high = 1e9};             // of a lining to rock [Pa]
constexpr Range bearing_range{.low = 1e3, .high = 1e12};         // strength under a foot [Pa]
constexpr Range duration_range{.low = 0, .high = 3.2e10};        // a thousand years [s]
constexpr Range rib_spacing_range{.low = 0.01, .high = 1000};    // along the tunnel [m]

constexpr const char* arc_form =
    R"(two angles from -360 to 360 deg, the first below the second, at most 360 deg apart, such as ["0 deg", "180 deg"])";
constexpr const char* bars_form =
    R"(1 to 1000 pairs of points, head and tip of each bar, such as [[["0 m", "4 m"], ["0 m", "8 m"]]])";
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
    } else if (!(quantity.value >= (is_angle ? radians(0.1) : 0.01))) {
      value.refuse("is outside the accepted range", spacing_form);
    } else if (value.stays_in(at_least(is_angle ? radians(0.1) : 0.01), spacing_form)) {
      return BoltSpacing{quantity.value, is_angle};
    }
  } catch (const UnitError& error) {
    value.refuse(error.complaint(), spacing_form);
  }
  return std::nullopt;
}

std::optional<ArcInput> read_arc(const Value& value) {
  const std::string form = arc_form;
  const auto ends = value.as_list(2, 2, form);
  if (!ends) return std::nullopt;
  const Range range = between(radians(-360), radians(360));
  const auto from = ends->at(0).as_quantity(dimension::angle, range);
  const auto to = ends->at(1).as_quantity(dimension::angle, range);
  if (!from || !to) return std::nullopt;
  // One rounding of slack: -180 to 180 deg is the whole ring.
  if (!(*from < *to) || *to - *from > radians(360) * (1 + 1e-15)) {
    value.refuse(*from < *to ? "spans more than 360 deg" : "does not rise", form);
    return std::nullopt;
  }
  return ArcInput{*from, *to};
}

/// Two angles, or what of the outline is lined in a word.
void read_lined_arc(Section& s, LiningInput& lining) {
  const std::vector<std::string> words{"roof", "roof and walls", "all"};
  const auto value =
      s.find("arc", Need::optional, words_form(words).append("; or ").append(arc_form));
  if (!value) return;
  if (value->node().kind != Node::Kind::text) {
    lining.arc = read_arc(*value);
    return;
  }
  constexpr LinedPart parts[] = {LinedPart::roof, LinedPart::roof_and_walls, LinedPart::all};
  if (const auto word = value->as_word(words)) lining.part = parts[*word];
}

/// Bars one by one: head and tip of each.
void read_bars(const Value& value, std::vector<Segment>& bars) {
  const std::string form = bars_form;
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

/// In which opening something is: the tunnel, or one by its name.
void read_opening_name(Section& s, const Input& input, std::size_t& opening) {
  KeyForm form = R"("tunnel", or the name of an [[opening]])";
  form.otherwise = "tunnel";
  const auto value = s.find("opening", Need::optional, form);
  if (!value) return;
  std::vector<std::string> names;
  for (std::size_t k = 0; k <= input.openings.size(); ++k) names.push_back(opening_name(input, k));
  opening = value->as_word(names).value_or(opening);
}

/// What holds only where all of these conditions do; nothing of it is read where one is not known.
void read_where(Section& s, std::optional<bool> holds, const std::string& condition,
                const std::function<void()>& read) {
  if (holds)
    s.only_with(*holds, condition, read);
  else
    s.unread(read);
}

/// What a bolt is of, and how long it bears.
void read_bolt_bar(Section& s, BoltsInput& bolts) {
  s.quantity("diameter", bolts.diameter, dimension::length, above(0), Need::optional);
  s.quantity("pretension", bolts.pretension, dimension::force, between(0, force_range.high),
             Need::optional);
  s.quantity("yield_force", bolts.yield_force, dimension::force, force_range);
  s.quantity("rupture_force", bolts.rupture_force, dimension::force, force_range);
  s.only_with(bolts.yield_force.has_value() || s.faulty("yield_force"), "yield_force", [&] {
    s.quantity("rupture_elongation", bolts.rupture_elongation, dimension::length, elongation_range);
  });
}

/// How it is held in the rock.
void read_bolt_grip(Section& s, BoltsInput& bolts) {
  std::optional<bool> is_grouted, is_ended;  // none: what it is is not known
  if (s.choice<BoltType>("type", bolts.type,
                         {{"grouted", BoltType::grouted}, {"end-anchored", BoltType::end_anchored}},
                         Need::optional)) {
    is_grouted = bolts.type == BoltType::grouted;
    is_ended = !*is_grouted;
  }
  const auto grouted_and = [&](bool more) {
    return is_grouted ? std::optional(*is_grouted && more) : std::nullopt;
  };
  const std::string grouted = R"(type = "grouted")";
  read_where(s, is_grouted, grouted, [&] {
    s.quantity("bond_strength", bolts.bond_strength, dimension::stiffness, bond_per_metre_range);
  });
  const bool has_bond = bolts.bond_strength || s.faulty("bond_strength");
  read_where(s, grouted_and(has_bond), grouted + " and bond_strength", [&] {
    s.quantity("bond_stiffness", bolts.bond_stiffness, dimension::pressure, bond_stiffness_range);
  });
  const bool slips = bolts.bond_stiffness || s.faulty("bond_stiffness");
  read_where(s, grouted_and(!slips), grouted + ", without bond_stiffness,", [&] {
    s.quantity("stiffness", bolts.stiffness, dimension::stiffness, bolt_range, Need::required);
  });
  read_where(s, is_grouted ? std::optional(*is_ended || has_bond) : std::nullopt,
             R"(bond_strength or type = "end-anchored")", [&] {
               s.quantity("plate_strength", bolts.plate_strength, dimension::force,
                          between(0, force_range.high));
             });
  read_where(
      s,
      is_grouted ? std::optional(bolts.plate_strength.value_or(0) > 0 || s.faulty("plate_strength"))
                 : std::nullopt,
      "plate_strength",
      [&] { s.quantity("plate_width", bolts.plate_width, dimension::length, between(0.01, 2)); });
  read_where(s, is_grouted ? std::optional(*is_ended || slips) : std::nullopt,
             R"(bond_stiffness or type = "end-anchored")", [&] {
               s.quantity("E", bolts.young_modulus, dimension::pressure, bar_modulus_range,
                          Need::optional);
               s.quantity("area", bolts.area, dimension::area, bar_area_range);
             });
  read_where(s, is_ended, R"(type = "end-anchored")", [&] {
    s.quantity("anchor_stiffness", bolts.anchor_stiffness, dimension::stiffness, bolt_range);
    s.quantity("anchor_strength", bolts.anchor_strength, dimension::force, force_range);
  });

  bool anchors_known = false;
  read_where(s, is_grouted, grouted, [&] {
    anchors_known = s.choice<AnchorKind>("anchors", bolts.anchors,
                                         {{"lorig", AnchorKind::lorig},
                                          {"garga-wang", AnchorKind::garga_wang},
                                          {"joint-face", AnchorKind::joint_face}},
                                         Need::optional);
  });
  std::optional<double> offset;
  const bool is_lorig = bolts.anchors == AnchorKind::lorig && is_grouted.value_or(true);
  read_where(s, anchors_known ? std::optional(is_lorig) : std::nullopt, "anchors = \"lorig\"",
             [&] { s.quantity("anchor_offset", offset, dimension::length, above(0)); });

  // As Boon et al. (2015), section 5.2.
  bolts.anchor_offset = offset.value_or(1.2 * bolts.diameter);

  // A dowel is beside a spring of one stiffness.
  bool law_known = false;
  read_where(s, grouted_and(!slips && !bolts.rupture_elongation),
             grouted + ", without bond_stiffness and rupture_elongation,", [&] {
               law_known = s.choice<BoltKind>(
                   "law", bolts.law,
                   {{"axial", BoltKind::axial}, {"axial-shear", BoltKind::axial_shear}},
                   Need::optional);
             });
  read_where(s, law_known ? std::optional(bolts.law == BoltKind::axial_shear) : std::nullopt,
             "law = \"axial-shear\"", [&] {
               s.quantity("shear_stiffness", bolts.shear_stiffness, dimension::stiffness,
                          bolt_range, Need::required);
             });
}

}  // namespace

void read_bolts(Section& s, Input& input, BoltsInput& bolts) {
  s.text("name", bolts.name);
  read_opening_name(s, input, bolts.opening);
  const bool has_bars = s.has("bars");
  if (const auto value = s.find("bars", Need::optional, bars_form)) read_bars(*value, bolts.bars);
  bolts.arc = {0, radians(180)};
  s.only_with(!has_bars, "length and spacing, without bars,", [&] {
    s.quantity("length", bolts.length, dimension::length, above(0), Need::required);
    if (const auto value = s.find("spacing", Need::required, spacing_form))
      bolts.spacing = read_spacing(*value).value_or(bolts.spacing);
    if (const auto value = s.find("arc", Need::optional, arc_form))
      bolts.arc = read_arc(*value).value_or(bolts.arc);
  });
  s.quantity("out_of_plane", bolts.out_of_plane, dimension::length, out_of_plane_range,
             Need::optional);
  s.quantity("ahead", bolts.ahead, dimension::angle, between(radians(1), radians(45)));
  if (!input.is_spatial()) note_unused(input, s, "ahead");
  read_bolt_bar(s, bolts);
  read_bolt_grip(s, bolts);
}

void read_lining(Section& s, Input& input, LiningInput& lining) {
  s.text("name", lining.name);
  read_opening_name(s, input, lining.opening);
  s.quantity("thickness", lining.thickness, dimension::length, thickness_range, Need::required);
  s.quantity("E", lining.young_modulus, dimension::pressure, modulus_range, Need::required);
  s.number("nu", lining.poisson_ratio,
           {.low = -1, .high = 0.5, .low_included = false, .high_included = false}, Need::optional);
  s.choice<LiningElement>("beam", lining.beam,
                          {{"euler-bernoulli", LiningElement::euler_bernoulli},
                           {"timoshenko", LiningElement::timoshenko},
                           {"pinned", LiningElement::pinned},
                           {"bonded-chain", LiningElement::bonded_chain}},
                          Need::optional);
  s.table("interface", [&](Section& interface) {
    interface.quantity("kn", lining.interface_normal_stiffness, dimension::stiffness_per_area,
                       per_area_range, Need::required);
    std::optional<double> ks;
    interface.quantity("ks", ks, dimension::stiffness_per_area, per_area_range);
    lining.interface_shear_stiffness = ks.value_or(lining.interface_normal_stiffness);
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
  s.optional_table("concrete", [&](Section& table) { read_concrete(table, lining); });
  s.optional_table("ribs", [&](Section& table) { read_ribs(table, lining); });
  if (lining.ribs && lining.age && lining.age->has_growing_modulus)
    s.complain("ribs", "share forces with concrete whose E grows, which is not followed",
               "concrete.E_grows = false, no concrete.age, or no table ribs");
  s.optional_table("feet", [&](Section& table) {
    FeetInput& feet = lining.feet.emplace();
    std::optional<double> width, friction;
    table.quantity("width", width, dimension::length, thickness_range);
    feet.width = width.value_or(lining.thickness);
    table.quantity("stiffness", feet.stiffness, dimension::stiffness_per_area, per_area_range,
                   Need::required);
    table.quantity("strength", feet.strength, dimension::pressure, bearing_range);
    table.quantity("friction", friction, dimension::angle, angle_below_90());
    feet.friction_angle = friction.value_or(lining.interface_friction_angle);
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

namespace {

enum class Excavated { section, rest, nothing };

/// What a round excavates: of the section what lies between the limits or in the outline given, or
/// what rounds before it have left.
void read_part(Section& s, Input& input, StageInput& round,
               const std::filesystem::path& directory) {
  Excavated excavated = Excavated::section;
  const bool known = s.choice<Excavated>(
      "excavate", excavated,
      {{"section", Excavated::section}, {"rest", Excavated::rest}, {"nothing", Excavated::nothing}},
      Need::optional);
  SectionPart part;
  const char* const limits[] = {"above", "below", "right_of", "left_of"};
  const auto read = [&] {
    s.quantity("above", part.bottom, dimension::length, Range{}, Need::optional);
    s.quantity("below", part.top, dimension::length, Range{}, Need::optional);
    s.quantity("right_of", part.left, dimension::length, Range{}, Need::optional);
    s.quantity("left_of", part.right, dimension::length, Range{}, Need::optional);
    read_round_outline(s, input, round, directory);
  };
  if (!known) return s.unread(read);
  s.only_with(excavated == Excavated::section, R"(excavate = "section")", read);
  round.takes_rest = excavated == Excavated::rest;
  if (excavated == Excavated::nothing) return;
  if (!(part.bottom < part.top) && !s.faulty("above") && !s.faulty("below"))
    s.complain("above", "leaves nothing: it is not lower than below", "an elevation under below");
  if (!(part.left < part.right) && !s.faulty("right_of") && !s.faulty("left_of"))
    s.complain("right_of", "leaves nothing: it is not left of left_of", "a place left of left_of");
  for (const char* const key : limits)
    if (s.has(key) && (s.has("vertices") || s.has("file")))
      s.complain(key, "is given besides an outline", "limits, or an outline (vertices, file)");
  round.part = part;
}

}  // namespace

void read_stage(Section& s, Input& input, StageInput& stage, bool is_round,
                const std::filesystem::path& directory) {
  s.text("name", stage.name);
  s.quantity("wall_traction", stage.wall_traction, dimension::number, between(0, 1),
             is_round ? Need::optional : Need::required);
  if (is_round) {
    read_opening_name(s, input, stage.opening);
    read_part(s, input, stage, directory);
    s.only_with(input.tunnel.round_length.has_value(), "tunnel.round_length",
                [&] { s.integer("behind", stage.behind, 0, 1000); });
    if (!input.is_spatial()) note_unused(input, s, "behind");
    if (input.is_spatial() && input.tunnel.round_length) note_unused(input, s, "wall_traction");
  }
  s.quantity("duration", stage.duration, dimension::time, duration_range, Need::optional);
  const std::string form = R"(a list of "bolts", "lining" and names of bolts and linings)";
  const auto value = s.find("install", Need::optional, form);
  if (!value) return;
  std::vector<std::string> words{"bolts", "lining"};  // all of a kind, or one by its name
  const std::size_t patterns = input.bolts.size();
  for (const BoltsInput& pattern : input.bolts) words.push_back(pattern.name);
  for (const LiningInput& lining : input.linings) words.push_back(lining.name);
  const auto items = value->as_list(0, words.size(), form);
  if (!items) return;
  for (const Value& item : *items) {
    const auto word = item.as_word(words);
    if (!word) continue;
    bool is_again = false;
    // Supports that no table describes are said of the whole file, below.
    const auto install = [&](std::vector<std::size_t>& installed, bool are_all,
                             const auto& supports, std::size_t number) {
      const std::size_t first = are_all ? 0 : number,
                        last = are_all ? std::max<std::size_t>(supports.size(), 1) : number + 1;
      for (std::size_t k = first; k < last; ++k) {
        // All of a kind are those of the opening in which the round works.
        if (k < supports.size() && supports[k].opening != stage.opening) {
          if (!are_all)
            item.refuse("is of the " + opening_name(input, supports[k].opening) +
                            ", and the round works in the " + opening_name(input, stage.opening),
                        "what is of the opening of the round");
          continue;
        }
        is_again = is_again || std::find(installed.begin(), installed.end(), k) != installed.end();
        installed.push_back(k);
      }
    };
    if (*word == 0 || (*word >= 2 && *word < 2 + patterns))
      install(stage.bolts, *word == 0, input.bolts, *word - 2);
    else
      install(stage.linings, *word == 1, input.linings, *word - 2 - patterns);
    if (is_again) item.refuse("is in the list twice", "each support once");
  }
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

}  // namespace voussoir::program
