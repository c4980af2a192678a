// SPDX-License-Identifier: MIT
#include "input_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/design/models.hpp>
#include <voussoir/design/openings.hpp>
#include <voussoir/design/size_estimate.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/lining/node_spacing.hpp>
#include <voussoir/solver/creep.hpp>
#include <voussoir/tunnel/ring_nodes.hpp>
#include <voussoir/tunnel/section_part.hpp>

#include "design_criteria.hpp"
#include "joint_laws.hpp"
#include "plausibility.hpp"
#include "rock_loads.hpp"

namespace voussoir::program {

namespace {

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
  const std::vector<LiningInput>& linings = input.linings;
  for (std::size_t k = 0; k < linings.size(); ++k)
    if (const std::string key = input.lining_key(k) + ".thickness";
        linings[k].opening == 0 && !checker.faulty(key) && !(linings[k].thickness < half_width))
      checker.report(key, "fills the opening" + opening, below);
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
void check_arc(Checker& checker, const Input& input, LiningInput& lining,
               const std::string& table) {
  if (checker.faulty("tunnel") || checker.faulty("opening") || checker.faulty("support.lining"))
    return;
  const std::string key = table + ".arc";
  const OutlineInput& outline = outline_input(input, lining.opening);
  try {
    const SimplePolygon opening = outline_of(outline);
    LiningRing ring{.nodes = lining.nodes.value_or(std::max(outline.facets, 8))};
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
      if (outline.shape == TunnelShape::horseshoe)
        why += " (" + opening_key(lining.opening) +
               ".wall_height = " + format_quantity(outline.wall_height, dimension::length) + ")";
      checker.report(key, "is too long for feet: " + why,
                     end.refusal.substr(at + mark.size()) + R"(; "roof and walls" ends there)");
      return;
    }
  } catch (const InvalidInput& fault) {
    checker.report(key,
                   "does not fit the " + opening_name(input, lining.opening) + ": " + fault.what(),
                   R"(two angles, "roof", "roof and walls" or "all")");
  }
}

/// Nodes are close enough together for a bond, see `node_spacing.hpp`.
void check_bond(Checker& checker, const Input& input, const LiningInput& lining,
                const std::string& table) {
  if (!lining.bends_on_bond()) return;
  for (const char* key : {"support.lining", "tunnel", "opening", "diagram"})
    if (checker.faulty(key)) return;
  double thinnest = lining.thickness;
  if (input.diagram && &lining == &input.linings.front())
    for (const double thickness : input.diagram->thickness)
      if (thickness > 0) thinnest = std::min(thinnest, thickness);
  const double length = bending_length(section_of(lining, thinnest).bending_stiffness,
                                       lining.interface_normal_stiffness);
  const double perimeter = outline_of(outline_input(input, lining.opening)).perimeter();
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
    checker.report(table + ".nodes",
                   "puts nodes " + metres(perimeter / *lining.nodes) +
                       " apart, too far to see the bond fail at the edge of a block: " + why,
                   accepted + (chosen <= 2000 ? ", or no key nodes to have it chosen"
                               : least > 2000 ? ""
                                              : ", or " + others));
  else
    checker.report(
        table,
        "has no key nodes, and " + counted(chosen) + " would be chosen, more than 2000: " + why,
        least > 2000 ? accepted : "a key nodes of " + accepted + ", " + others);
}

/// What only a section can have.
void check_spatial(Checker& checker, const Input& input) {
  if (!input.is_spatial()) return;
  const std::string here = " in 3-D (model.dimension = 3)";
  if (!input.joints_file.empty())
    checker.report("joints.file", "has traces of a section, and no planes to cut with" + here,
                   "joint sets, or model.dimension = 2");
  const BoundaryInput& boundary = input.boundary;
  const auto is_rollers = [](const std::optional<Boundary>& side) {
    return side.value_or(Boundary::rollers) == Boundary::rollers;
  };
  for (const auto& [key, fits] : {std::pair("boundary.sides", is_rollers(boundary.sides)),
                                  std::pair("boundary.base", is_rollers(boundary.base)),
                                  std::pair("boundary.top", !boundary.ground_above)})
    if (!fits)
      checker.report(key, "is of a section: elastic ground and stress are not made" + here,
                     key == std::string("boundary.top")
                         ? "\"surface\", with the ground above as stress.surcharge"
                         : "\"rollers\"");
  const std::vector<LiningInput>& linings = input.linings;
  for (std::size_t k = 0; k < linings.size(); ++k)
    if (linings[k].feet && linings[k].feet->beam)
      checker.report(input.lining_key(k) + ".feet.beam",
                     "stands for what happens between ribs, which are there" + here,
                     "no such table");
  if (checker.faulty("model") || checker.faulty("tunnel")) return;
  const double length = input.tunnel_length();
  const double slope = elementary::tangent(input.tunnel.plunge);
  if (const double rise = -slope * input.model.length; rise >= input.tunnel.cover)
    checker.report("tunnel.plunge",
                   "is so steep a rise that the crown comes out of the ground: it climbs " +
                       format_quantity(rise, dimension::length) + " under " +
                       format_quantity(input.tunnel.cover, dimension::length) + " of cover",
                   "a flatter tunnel, more cover or a shorter model");
  if (const auto& round = input.tunnel.round_length) {
    const std::string within =
        "the tunnel of " + format_quantity(length, dimension::length) + " (model.length)";
    if (!input.tunnel.rounds && length / *round > 1000) {
      checker.report("tunnel.round_length", "makes more than 1000 rounds of " + within,
                     "1000 rounds or fewer: a longer one, or tunnel.rounds");
      return;
    }
    if (*round > length)
      checker.report("tunnel.round_length", "is longer than " + within,
                     "at most " + format_quantity(length, dimension::length));
    else if (input.round_count() * *round > length * (1 + 1e-9))
      checker.report(
          "tunnel.rounds",
          "rounds of " + format_quantity(*round, dimension::length) + " are longer than " + within,
          "1 to " + std::to_string(static_cast<int>(std::floor(length / *round * (1 + 1e-9)))));
  }
  if (checker.faulty("opening")) return;
  const std::vector<BoltsInput>& patterns = input.bolts;
  for (std::size_t k = 0; k < patterns.size() && !checker.faulty("support.bolts"); ++k)
    if (const double driven = drive_of(input, patterns[k].opening).length();
        patterns[k].out_of_plane > driven)
      checker.report(input.bolts_key(k) + ".out_of_plane",
                     "leaves no row of bolts in the " + opening_name(input, patterns[k].opening),
                     "at most " + format_quantity(driven, dimension::length) + ", what is driven");
  for (std::size_t k = 0; k < linings.size(); ++k) {
    const auto& asked = linings[k].rib_spacing;
    const std::string key = input.lining_key(k) + ".rib_spacing";
    const double stretch = drive_of(input, linings[k].opening).stretch;
    if (asked && *asked > stretch)
      checker.report(key,
                     "is longer than what is lined at a time, round_length or the whole length",
                     "at most " + format_quantity(stretch, dimension::length));
    else if (asked != linings[0].rib_spacing)
      checker.report(key, "is not that of the first lining: forces are given per strip",
                     "the same rib_spacing in all linings");
    else if (const double width = strips_of(input, linings[k].opening).width,
             first = strip_width(input);
             std::abs(width - first) > 1e-6 * first)
      checker.report(
          input.lining_key(k),
          "is of strips " + format_quantity(width, dimension::length) + " wide in the " +
              opening_name(input, linings[k].opening) + ", those of the first of " +
              format_quantity(first, dimension::length) + ": forces are given per strip",
          "a rib_spacing of which both have a whole number in a round, or in their length");
  }
}

/// Where other openings lie, and that they are excavated.
void check_openings(Checker& checker, const Input& input) {
  if (input.openings.empty()) return;
  for (const char* key : {"model", "tunnel", "opening", "round", "stage"})
    if (checker.faulty(key)) return;
  for (std::size_t k = 1; k <= input.openings.size(); ++k) {
    const OpeningInput& opening = input.openings[k - 1];
    const std::string key = opening_key(k);
    for (std::size_t other = 0; other < k; ++other)
      if (opening_name(input, other) == opening.name)
        return checker.report(key + ".name", "is that of another opening", "a name of its own");
    if (input.is_spatial() && !opening.to && !opening.is_along_tunnel(input.tunnel))
      return checker.report(key, "turns away from the tunnel and does not say where it ends",
                            R"(to = "12 m", along its axis)");
    if (input.is_spatial() && opening.place > input.tunnel_length())
      return checker.report(key + ".place", "is beyond the end of the model",
                            "0 to " + format_quantity(input.tunnel_length(), dimension::length));
    if (input.is_spatial() && !(drive_of(input, k).length() > 0))
      return checker.report(key, "has no length: it begins where it ends, or beyond",
                            "from below to; places along its axis");
    if (input.is_spatial() && drive_of(input, k).count > 1000)
      return checker.report(key + ".round_length", "makes more than 1000 rounds",
                            "1000 rounds or fewer");
    if (input.blocks.min_inscribed_radius > opening.half_width() && !checker.faulty("blocks"))
      return checker.report(key, "is smaller than the smallest blocks",
                            "an opening wider than blocks.min_inscribed_radius");
    const bool is_excavated =
        std::any_of(input.stages.begin(), input.stages.end(),
                    [&](const StageInput& stage) { return stage.opening == k && stage.part; });
    if (!is_excavated)
      return checker.report(key, "is excavated by no round",
                            "a [[round]] with opening = \"" + opening.name + "\"");
  }
  if (const auto fault = fault_of_openings(input))
    checker.report(opening_key(fault->opening), fault->text,
                   "openings beside each other, within the domain");
}

/// Linings have names of their own, and what is printed of a foot's beam is of one lining.
void check_linings(Checker& checker, Input& input) {
  const std::vector<BoltsInput>& patterns = input.bolts;
  const std::vector<LiningInput>& linings = input.linings;
  for (std::size_t k = 0; k < linings.size(); ++k) {
    LiningInput& lining = input.linings[k];
    const std::string table = input.lining_key(k);
    check_arc(checker, input, lining, table);
    check_bond(checker, input, lining, table);
    if (lining.name == "bolts" || lining.name == "lining")
      checker.report(table + ".name", "stands for all of a kind", "another name");
    const auto is_same = [&](const auto& other) { return other.name == lining.name; };
    if (std::any_of(linings.begin(), linings.begin() + static_cast<std::ptrdiff_t>(k), is_same) ||
        std::any_of(patterns.begin(), patterns.end(), is_same))
      checker.report(table + ".name", "is that of another support", "a name of its own");
    if (linings.size() > 1 && lining.feet && lining.feet->beam)
      checker.report(table + ".feet.beam", "is of the only lining, and there are others",
                     "feet without a beam, or one [support.lining]");
  }
}

/// Rounds take the section of an opening out, all of it, without leaving rock that hangs in it.
void check_rounds_of(Checker& checker, const Input& input, std::size_t opening,
                     std::vector<std::size_t> order) {
  const auto key = [&](std::size_t k) { return "round[" + std::to_string(k) + "]"; };
  std::erase_if(order, [&](std::size_t k) { return input.stages[k].opening != opening; });
  if (order.empty()) return;
  if (!input.stages[order.front()].part) {
    checker.report(key(order.front()), "excavates nothing, and there is no opening yet",
                   "an excavation first");
    return;
  }
  std::erase_if(order, [&](std::size_t k) { return !input.stages[k].part; });
  const SimplePolygon section = outline_of(outline_input(input, opening));
  const std::string nothing = "excavates nothing: no part of the section lies in it",
                    crossing = "limits or an outline that cross the section";
  std::vector<ExcavatedPart> parts;
  for (const std::size_t k : order) {
    const StageInput& round = input.stages[k];
    try {
      const auto outline = outline_of_round(input, round);
      if (!outline) return checker.report(key(k), nothing, crossing);
      parts.push_back({*outline, round.takes_rest, !round.outline.empty()});
    } catch (const InvalidInput& fault) {
      return checker.report(key(k),
                            round.outline.empty() ? "takes several pieces of the section at once"
                                                  : std::string(fault.what()),
                            "limits or an outline within which the section is in one piece");
    }
  }
  const auto fault = fault_of_parts(section, parts);
  if (!fault) return;
  const auto place = [&] {
    const SectionPart& at = fault->where;
    const auto metres = [](double value) { return significant_text(value, 3) + " m"; };
    return "x " + metres(at.left) + " to " + metres(at.right) + ", y " + metres(at.bottom) +
           " to " + metres(at.top);
  };
  const std::string where = key(order[fault->part]);
  using Kind = SectionFault::Kind;
  switch (fault->kind) {
    case Kind::empty:
      return checker.report(
          where, parts[fault->part].takes_rest ? "finds nothing left to excavate" : nothing,
          parts[fault->part].takes_rest ? R"(excavate = "nothing")" : crossing);
    case Kind::twice:
      return checker.report(
          where, "excavates once more what a round before it has taken out: " + place(),
          R"(limits (above, below, left_of, right_of) that leave that out, excavate = "rest" or excavate = "nothing")");
    case Kind::undermined:
      return checker.report(where, "leaves rock of the section hanging above it: " + place(),
                            "the rock above first: a heading before its bench");
    case Kind::left_over:
      return checker.report(opening == 0 ? "round" : opening_key(opening),
                            "leaves rock in the section: " + place(),
                            "rounds that take out all of it");
  }
}

void check_rounds(Checker& checker, const Input& input) {
  if (!input.has_rounds) return;
  for (const char* key : {"round", "stage", "tunnel", "opening"})
    if (checker.faulty(key)) return;
  std::vector<std::size_t> order(input.stages.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Along a tunnel what follows farther behind the face comes later.
  if (input.is_spatial() && input.tunnel.round_length)
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return input.stages[a].behind < input.stages[b].behind;
    });
  for (std::size_t k = 0; k <= input.openings.size(); ++k)
    check_rounds_of(checker, input, k, order);
  if (std::none_of(order.begin(), order.end(),
                   [&](std::size_t k) { return input.stages[k].opening == 0; }))
    checker.report("round", "excavates other openings, and not the tunnel", "rounds of the tunnel");
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

void check_bolts(Checker& checker, const Input& input) {
  if (checker.faulty("support.bolts")) return;
  const std::vector<BoltsInput>& patterns = input.bolts;
  for (std::size_t k = 0; k < patterns.size(); ++k) {
    const BoltsInput& bolts = patterns[k];
    const std::string table = input.bolts_key(k) + ".";
    const auto below = [&](const std::string& key, double value, const char* limit_key,
                           const std::optional<double>& limit) {
      if (!limit || value < *limit) return;
      checker.report(table + key, std::string("is not below ") + limit_key,
                     "below " + format_quantity(*limit, dimension::force));
    };
    below("pretension", bolts.pretension, "yield_force", bolts.yield_force);
    below("pretension", bolts.pretension, "rupture_force", bolts.rupture_force);
    if (bolts.yield_force)
      below("yield_force", *bolts.yield_force, "rupture_force", bolts.rupture_force);
    if (bolts.type == BoltType::end_anchored) {
      below("pretension", bolts.pretension, "anchor_strength", bolts.anchor_strength);
      if (bolts.plate_strength == 0.0)
        checker.report(table + "plate_strength", "leaves an end-anchored bolt without a plate",
                       "above 0 N; left out: the plate does not give");
      else
        below("pretension", bolts.pretension, "plate_strength", bolts.plate_strength);
    }
    if (bolts.name == "bolts" || bolts.name == "lining")
      checker.report(table + "name", "is what a stage installs all of", "another name");
    for (std::size_t other = 0; other < k; ++other)
      if (patterns[other].name == bolts.name)
        checker.report(table + "name", "is that of another pattern", "a name of its own");
  }
}

/// A stage lasts for joints that creep, and no longer than they can be followed.
void check_duration(Checker& checker, const Input& input, const StageInput& stage,
                    const std::string& key) {
  if (stage.duration == 0 || checker.faulty("joint") || checker.faulty("joint_set")) return;
  const double step = longest_creep_step(laws_of(input));
  constexpr double most_steps = 1000;
  const bool ages = std::any_of(input.linings.begin(), input.linings.end(),
                                [](const LiningInput& lining) { return lining.age.has_value(); });
  if (std::isinf(step)) {
    if (!ages)
      checker.report(key, "is for joints that creep or concrete that ages, and none does",
                     R"(law = "burgers" of [joint] or a [[joint_set]], )"
                     "support.lining.concrete.age, or no duration");
    return;
  }
  if (stage.duration > most_steps * step)
    checker.report(key,
                   "would take " + significant_text(std::ceil(stage.duration / step), 3) +
                       " steps, each a fifth of the shortest time in which shear relaxes",
                   "up to " + format_quantity(most_steps * step, dimension::time) +
                       ": 1000 steps; or joints that creep more slowly");
}

void check_stages(Checker& checker, Input& input) {
  if (input.stages.empty()) {
    if (checker.faulty("stage") || checker.faulty("round")) return;  // meant to have some
    input.stages.push_back({.name = "excavation and support", .part = SectionPart{}});
    for (std::size_t k = 0; k < input.bolts.size(); ++k) input.stages.back().bolts.push_back(k);
    for (std::size_t k = 0; k < input.linings.size(); ++k) input.stages.back().linings.push_back(k);
    return;
  }
  const std::string table = input.has_rounds ? "round" : "stage";
  if (checker.faulty(table)) return;
  const auto key = [&](std::size_t i) { return table + "[" + std::to_string(i) + "]"; };
  for (std::size_t i = 0; i < input.stages.size(); ++i)
    check_duration(checker, input, input.stages[i], key(i) + ".duration");
  for (std::size_t i = 1; i < input.stages.size(); ++i) {
    // Of what a round excavates, the wall has all of its traction yet.
    if (input.has_rounds && input.stages[i].part) continue;
    if (input.stages[i].wall_traction > input.stages[i - 1].wall_traction)
      checker.report(
          key(i) + ".wall_traction", "is above that of the stage before",
          "at most " + format_quantity(input.stages[i - 1].wall_traction, dimension::number));
  }
  if (input.stages.back().wall_traction > 0)
    checker.report(key(input.stages.size() - 1) + ".wall_traction",
                   "leaves traction on the wall at the end", "\"0 %\" in the last " + table);

  // Each support once, whatever a stage calls it.
  const auto check_support = [&](const std::string& called, const std::string& table_key,
                                 bool exists, const auto& is_installed_in) {
    bool installed = false;
    for (std::size_t i = 0; i < input.stages.size(); ++i) {
      if (!is_installed_in(input.stages[i])) continue;
      const std::string place = key(i) + ".install";
      if (!exists && !checker.faulty("support"))
        checker.report(place, "names " + called + ", which the file does not describe",
                       "a table [" + table_key + "]");
      if (installed) checker.report(place, "names " + called + " again", "each support once");
      installed = true;
    }
    if (exists && !installed)
      checker.report(table_key, "is in no stage",
                     "install = [\"" + called + "\"] in one [[" + table + "]]");
  };
  const std::vector<BoltsInput>& patterns = input.bolts;
  for (std::size_t k = 0; k < std::max<std::size_t>(patterns.size(), 1); ++k)
    check_support(patterns.size() > 1 ? patterns[k].name : "bolts", input.bolts_key(k),
                  !patterns.empty(), [&](const StageInput& stage) {
                    return std::find(stage.bolts.begin(), stage.bolts.end(), k) !=
                           stage.bolts.end();
                  });
  const std::vector<LiningInput>& linings = input.linings;
  for (std::size_t k = 0; k < std::max<std::size_t>(linings.size(), 1); ++k)
    check_support(linings.size() > 1 ? linings[k].name : "lining", input.lining_key(k),
                  !linings.empty(), [&](const StageInput& stage) {
                    return std::find(stage.linings.begin(), stage.linings.end(), k) !=
                           stage.linings.end();
                  });
}

void check_diagram(Checker& checker, const Input& input) {
  if (!input.diagram || checker.faulty("diagram")) return;
  if (input.bolts.empty() && input.diagram->spacing.front() && !checker.faulty("support"))
    checker.report("diagram.spacing", "varies bolts, which the file does not describe",
                   "a table [support.bolts]");
  if (!input.bolts.empty() && !input.bolts.front().bars.empty() && input.diagram->spacing.front())
    checker.report("diagram.spacing", "varies bolts that are given one by one",
                   "a first [[support.bolts]] with a spacing");
  if (input.linings.empty() && input.diagram->thickness.back() > 0 && !checker.faulty("support"))
    checker.report("diagram.thickness", "varies a lining, which the file does not describe",
                   "a table [support.lining]");
  if (input.linings.empty() || checker.faulty("support")) return;
  const LiningInput& lining = input.linings.front();
  for (const double thickness : input.diagram->thickness) {
    if (!lining.concrete || thickness == 0) continue;
    ConcreteSection section = *lining.concrete;
    section.thickness = thickness;
    try {
      (void)SectionCapacity(std::move(section));
    } catch (const InvalidInput& fault) {
      checker.report("diagram.thickness",
                     "has " + format_quantity(thickness, dimension::length) +
                         ", which is no section of this concrete: " + fault.what(),
                     "thicknesses in which the bars of support.lining.concrete lie");
      return;
    }
  }
}

/// A utilisation is that of a strength.
void check_criteria(Checker& checker, const Input& input) {
  const CriteriaInput& criteria = input.criteria;
  if (criteria.bolt_utilisation && !has_bolt_strength(input) && !checker.faulty("support"))
    checker.report("criteria.bolt_utilisation", "is of bolts, and none has a strength",
                   "support.bolts.yield_force, rupture_force or bond_strength beside it");
  if (criteria.utilisation && !has_lining_strength(input) && !checker.faulty("support"))
    checker.report("criteria.utilisation", "is of linings, and none has a strength",
                   "support.lining.concrete beside it");
}

void check_costs(Checker& checker, const Input& input) {
  if (!input.costs || checker.faulty("costs")) return;
  const CostsInput& costs = *input.costs;
  if (!(costs.bolt_per_metre + costs.bolt_per_hole + costs.concrete_per_m3 + costs.steel_per_kg >
        0))
    checker.report("costs", "has no price above 0: every support costs nothing",
                   "bolt_per_metre, bolt_per_hole, concrete_per_m3 or steel_per_kg");
}

}  // namespace

void check_together(Checker& checker, Input& input) {
  check_costs(checker, input);
  check_opening(checker, input);
  check_snap(checker, input);
  check_linings(checker, input);
  check_boundary(checker, input);
  check_spatial(checker, input);
  check_rounds(checker, input);
  check_openings(checker, input);
  check_size(checker, input);
  check_bolts(checker, input);
  check_stages(checker, input);
  check_rock_loads(checker, input);
  check_diagram(checker, input);
  check_criteria(checker, input);
}

}  // namespace voussoir::program
