// SPDX-License-Identifier: MIT
#include "plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <voussoir/contact/law_in_situ.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/design/joint_sets.hpp>
#include <voussoir/drawing/number_text.hpp>

#include "drawn_outline.hpp"
#include "joint_laws.hpp"

namespace voussoir::program {

namespace {

/// What is common for a key; `or_zero`: so is nothing at all.
struct Common {
  double low, high;
  bool or_zero = false;
};

// By judgement, from values in use: wide enough for filled and for fresh joints, for cable bolts
// and for dowels, and narrow enough that a slip by a thousand is seen
// (tests/program/plausibility_test).
constexpr double degree = std::numbers::pi / 180;
constexpr Common gravity{5, 20};                               // [m/s^2]
constexpr Common density{1500, 4500};                          // [kg/m^3]
constexpr Common interface_stiffness{0.1e9, 95e9};             // [Pa/m]
constexpr Common ks_over_kn{0.01, 1.5};                        // [-]
constexpr Common wet_friction{5 * degree, 75 * degree, true};  // of an interface that may be smooth
constexpr Common dip{0.5 * degree, 90 * degree, true};         // [rad]
constexpr Common scatter{0.1 * degree, 30 * degree, true};     // standard deviation [rad]
constexpr Common joint_spacing{0.05, 40};                      // of joints [m]
constexpr Common fisher{10, 9000};                             // K [-]
constexpr Common trace_length{0.1, 90};                        // [m]
constexpr Common ground_modulus{0.1e9, 95e9};                  // [Pa]
constexpr Common concrete_modulus{0.5e9, 250e9};               // to steel [Pa]
constexpr Common poisson_ratio{0.05, 0.45, true};              // [-]
constexpr Common bolt_stiffness{5e6, 4e9}, dowel_stiffness{1e6, 900e6};  // [N/m]
// Grouted cables and bars: 0.1 to 1 MN/m; split sets less.
constexpr Common bolt_bond{10e3, 2e6};          // [N/m]
constexpr Common bond_stiffness{2e7, 1.5e10};   // of grout over slip [N/m^2]
constexpr Common bar_modulus{30e9, 230e9};      // glass fibre to steel [Pa]
constexpr Common bar_area{20e-6, 5000e-6};      // [m^2]
constexpr Common anchor_stiffness{2e6, 900e6};  // [N/m]
constexpr Common pretension{1e3, 900e3, true}, bolt_strength{10e3, 5e6};  // [N]
constexpr Common bond{20e3, 10e6, true};                                  // [Pa]
constexpr Common bearing_stiffness{20e6, 19e9};                           // [Pa/m]
constexpr Common bearing_strength{0.2e6, 150e6};                          // [Pa]

/// Collects what is unusual.
class Look {
 public:
  [[nodiscard]] std::vector<std::string> found() && { return std::move(found_); }

  void at(const std::string& key, double value, const Common& common, const Dimension& dimension,
          const std::string& why = "") {
    if (is_common(value, common)) return;
    const auto text = [&](double v) { return format_quantity(v, dimension); };
    say(key, text(value), text(common.low), text(common.high), common, why);
  }
  void at(const std::string& key, const std::optional<double>& value, const Common& common,
          const Dimension& dimension) {
    if (value) at(key, *value, common, dimension);
  }
  /// A bare number.
  void at(const std::string& key, double value, const Common& common) {
    if (is_common(value, common)) return;
    const auto text = [](double v) { return significant_text(v, 3); };
    say(key, text(value), text(common.low), text(common.high), common, "");
  }
  /// A length, beside that of the opening.
  void beside_opening(const std::string& key, double value, double opening, const Common& times) {
    at(key, value, {times.low * opening, times.high * opening, times.or_zero}, dimension::length,
       ", " + significant_text(times.low, 3) + " to " + significant_text(times.high, 3) +
           " times the width of the opening");
  }
  /// Stiffness along beside that across.
  void in_shear(const std::string& key, double along, double across) {
    at(key, along, {ks_over_kn.low * across, ks_over_kn.high * across},
       dimension::stiffness_per_area,
       ", " + significant_text(ks_over_kn.low, 3) + " to " + significant_text(ks_over_kn.high, 3) +
           " of the normal stiffness");
  }

 private:
  // Nine digits: 90 deg is read with a rounding.
  [[nodiscard]] static bool is_common(double value, const Common& c) {
    return (c.or_zero && value == 0) ||
           (value >= c.low * (1 - 1e-9) && value <= c.high * (1 + 1e-9));
  }
  void say(const std::string& key, const std::string& value, const std::string& low,
           const std::string& high, const Common& common, const std::string& why) {
    found_.push_back(key + " = " + value + " is unusual (common: " +
                     (common.or_zero ? "0, or " : "") + low + " to " + high + why + ")");
  }

  std::vector<std::string> found_;
};

std::string entry(const char* list, std::size_t k) {
  return std::string(list) + "[" + std::to_string(k) + "]";
}

void look_at_model(const Input& input, Look& look) {
  const TunnelInput& tunnel = input.tunnel;
  const double span = 2 * tunnel.half_width();
  look.beside_opening("model.width", input.model.width, span, {3, 100});
  if (input.is_spatial()) {
    look.beside_opening("model.length", input.model.length, span, {0.2, 100});
    look.at("tunnel.round_length", tunnel.round_length, {0.2, 20}, dimension::length);
  }
  look.beside_opening("model.below_invert", input.model.below_invert, span, {0.3, 100});
  const char* const widths[] = {"diameter", "width", "vertices (their width)"};
  look.at(std::string("tunnel.") + widths[static_cast<int>(tunnel.shape)], span, {1, 50},
          dimension::length);
  if (tunnel.shape == TunnelShape::horseshoe)
    look.beside_opening("tunnel.wall_height", tunnel.wall_height, span, {0.05, 5});
  look.beside_opening("tunnel.cover", tunnel.cover, span, {0.4, 350});
  for (std::size_t k = 0; k < input.openings.size(); ++k) {
    const OpeningInput& other = input.openings[k];
    const std::string table = "opening[" + std::to_string(k) + "].";
    if (other.shape == TunnelShape::circle)
      look.beside_opening(table + "diameter", other.diameter, span, {0.05, 5});
    if (other.shape != TunnelShape::horseshoe) continue;
    look.beside_opening(table + "width", other.width, span, {0.05, 5});
    look.beside_opening(table + "wall_height", other.wall_height, span, {0.02, 5});
  }
  look.at("stress.K0", input.stress.K0, {0.2, 5});
  if (input.stress.K0_minor) look.at("stress.K0_minor", *input.stress.K0_minor, {0.1, 5});
  look.at("stress.horizontal", input.stress.horizontal, {50e3, 40e6, true}, dimension::pressure);
  // Of ground that goes on above: as deep as any mine. On a surface: a town or a lake.
  if (input.boundary.ground_above)
    look.at("stress.surcharge", input.stress.surcharge, {0.1e6, 90e6}, dimension::pressure,
            " of ground above");
  else
    look.at("stress.surcharge", input.stress.surcharge, {1e3, 900e3, true}, dimension::pressure,
            R"( on a ground surface; where ground goes on above: boundary.top = "elastic")");
  look.at("boundary.E", input.boundary.young_modulus, ground_modulus, dimension::pressure);
  look.at("boundary.nu", input.boundary.poisson_ratio, poisson_ratio);
  look.beside_opening("blocks.min_inscribed_radius", input.blocks.min_inscribed_radius, span,
                      {0.001, 0.3});
  if (std::isfinite(input.blocks.max_elongation))
    look.at("blocks.max_elongation", input.blocks.max_elongation, {2, 90});
  look.at("blocks.min_wall_area", input.blocks.min_wall_area,
          {2e-5 * span * span, 1.5e-2 * span * span, true}, dimension::area,
          ", small beside the opening");
}

/// How much of the length of traces whose centres lie in the domain lies in it, too.
double length_inside(const Input& input, const JointSetInput& set) {
  const double width = input.model.width, height = input.domain_top() - input.domain_bottom();
  const double across = set.extent * elementary::cosine(set.plane.dip) / width,
               up = set.extent * elementary::sine(set.plane.dip) / height;
  constexpr int parts = 200;
  double sum = 0;
  for (int k = 0; k < parts; ++k) {
    const double from_centre = 0.5 * (k + 0.5) / parts;  // in lengths of the trace
    sum += std::max(0.0, 1 - from_centre * across) * std::max(0.0, 1 - from_centre * up);
  }
  return sum / parts;
}

/// The parameters that a table gives, and those that are held against one of them.
void look_at_law(const std::string& table, const JointLawInput& law, Look& look) {
  const auto is_given = [&](std::string_view key) {
    return std::find(law.given.begin(), law.given.end(), key) != law.given.end();
  };
  for (const LawParameter& p : joint_law_row(law.law).parameters) {
    if (!is_given(p.key) && !is_given(p.beside)) continue;
    const std::string key = table + std::string(p.key);
    const Common common{p.common_low, p.common_high, p.is_common_at_zero};
    if (!p.beside.empty())
      look.in_shear(key, law.at(p.key), law.at(p.beside));
    else if (p.dimension == dimension::number)
      look.at(key, law.at(p.key), common);
    else
      look.at(key, law.at(p.key), common, p.dimension);
  }
}

void look_at_joints(const Input& input, Look& look) {
  look_at_law("joint.", input.joint_law, look);
  for (std::size_t k = 0; k < input.joint_sets.size(); ++k) {
    const JointSetInput& set = input.joint_sets[k];
    const std::string table = entry("joint_set", k) + ".";
    if (const auto& own = input.set_files[k].law) look_at_law(table, *own, look);
    look.at(table + "dip", set.plane.dip, dip, dimension::angle);
    look.at(table + "sd", set.sd, scatter, dimension::angle);
    if (set.fisher) look.at(table + "K", *set.fisher, fisher);
    if (set.persistence)
      look.at(table + "persistence", *set.persistence, {0.05, 1}, dimension::number);
    look.at(table + "P32", set.p32, {1 / joint_spacing.high, 1 / joint_spacing.low},
            dimension::area_per_volume);
    look.at(table + "strike_extent", set.strike_extent, trace_length, dimension::length);
    if (std::isfinite(set.extent)) {
      look.at(table + "extent", set.extent, trace_length, dimension::length);
      const double area = set.extent * set.strike_extent.value_or(set.extent);
      look.at(table + "P30", set.p30,
              {1 / (joint_spacing.high * area), 1 / (joint_spacing.low * area)},
              dimension::number_per_volume);
      if (set.intensity)
        look.at(table + "intensity", *set.intensity,
                {1 / (joint_spacing.high * set.extent), 1 / (joint_spacing.low * set.extent)},
                dimension::intensity,
                ", spacings of " + format_quantity(joint_spacing.high, dimension::length) + " to " +
                    format_quantity(joint_spacing.low, dimension::length) + " with this extent");
    }
    look.at(table + "spacing", set.spacing, joint_spacing, dimension::length);
    if (set.spacing && set.spacing_sd)
      look.at(table + "spacing_sd", *set.spacing_sd, {0.05 * *set.spacing, 3 * *set.spacing},
              dimension::length, ", 0.05 to 3 times the spacing");
  }
}

void look_at_bolts(const std::string& table, const BoltsInput& bolts, Look& look) {
  for (const Segment& bar : bolts.bars)
    look.at(table + "bars (the length of one)", bar.length(), {0.5, 40}, dimension::length);
  if (bolts.bars.empty()) look.at(table + "length", bolts.length, {0.5, 40}, dimension::length);
  look.at(table + "out_of_plane", bolts.out_of_plane, {0.2, 10}, dimension::length);
  look.at(table + "diameter", bolts.diameter, {0.008, 0.08}, dimension::length);
  look.at(table + "arc (its angle)", bolts.arc.to - bolts.arc.from, {2 * degree, 360 * degree},
          dimension::angle);
  if (bolts.type == BoltType::grouted && !bolts.bond_stiffness)
    look.at(table + "stiffness", bolts.stiffness, bolt_stiffness, dimension::stiffness);
  if (bolts.type == BoltType::end_anchored || bolts.bond_stiffness)
    look.at(table + "E", bolts.young_modulus, bar_modulus, dimension::pressure);
  look.at(table + "area", bolts.area, bar_area, dimension::area);
  look.at(table + "bond_stiffness", bolts.bond_stiffness, bond_stiffness, dimension::pressure);
  look.at(table + "anchor_stiffness", bolts.anchor_stiffness, anchor_stiffness,
          dimension::stiffness);
  look.at(table + "anchor_strength", bolts.anchor_strength, bolt_strength, dimension::force);
  look.at(table + "rupture_elongation", bolts.rupture_elongation, {2e-3, 1}, dimension::length);
  if (bolts.law == BoltKind::axial_shear)
    look.at(table + "shear_stiffness", bolts.shear_stiffness, dowel_stiffness,
            dimension::stiffness);
  look.at(table + "pretension", bolts.pretension, pretension, dimension::force);
  look.at(table + "yield_force", bolts.yield_force, bolt_strength, dimension::force);
  look.at(table + "rupture_force", bolts.rupture_force, bolt_strength, dimension::force);
  look.at(table + "bond_strength", bolts.bond_strength, bolt_bond, dimension::stiffness);
  if (bolts.anchors == AnchorKind::lorig && bolts.type == BoltType::grouted)
    look.at(table + "anchor_offset", bolts.anchor_offset, {0.005, 2}, dimension::length);
}

void look_at_spacing(const std::string& key, const BoltSpacing& apart, Look& look) {
  if (apart.is_angle)
    look.at(key, apart.value, {2 * degree, 180 * degree}, dimension::angle);
  else
    look.at(key, apart.value, {0.2, 20}, dimension::length);
}

constexpr Common shotcrete_to_concrete{0.02, 3};  // thickness [m]

void look_at_lining(const std::string& table, const LiningInput& lining, Look& look) {
  look.at(table + "thickness", lining.thickness, shotcrete_to_concrete, dimension::length);
  look.at(table + "E", lining.young_modulus, concrete_modulus, dimension::pressure);
  look.at(table + "nu", lining.poisson_ratio, poisson_ratio);
  look.at(table + "interface.kn", lining.interface_normal_stiffness, interface_stiffness,
          dimension::stiffness_per_area);
  look.in_shear(table + "interface.ks", lining.interface_shear_stiffness,
                lining.interface_normal_stiffness);
  look.at(table + "interface.friction", lining.interface_friction_angle, wet_friction,
          dimension::angle);
  look.at(table + "interface.shear_bond", lining.shear_bond, bond, dimension::pressure);
  look.at(table + "interface.tensile_bond", lining.tensile_bond, bond, dimension::pressure);
  look.at(table + "rib_spacing", lining.rib_spacing, {0.05, 20}, dimension::length);
  if (lining.arc)
    look.at(table + "arc (its angle)", lining.arc->to - lining.arc->from,
            {2 * degree, 360 * degree}, dimension::angle);
  if (!lining.feet) return;
  const FeetInput& feet = *lining.feet;
  look.at(table + "feet.width", feet.width, {0.02, 5}, dimension::length);
  look.at(table + "feet.stiffness", feet.stiffness, bearing_stiffness,
          dimension::stiffness_per_area);
  look.at(table + "feet.strength", feet.strength, bearing_strength, dimension::pressure);
  look.at(table + "feet.friction", feet.friction_angle, wet_friction, dimension::angle);
  if (!feet.beam) return;
  look.at(table + "feet.beam.depth", feet.beam->depth, {0.05, 3}, dimension::length);
  look.at(table + "feet.beam.E", feet.beam->modulus, concrete_modulus, dimension::pressure);
  look.at(table + "feet.beam.spacing", feet.beam->spacing, {0.2, 10}, dimension::length);
}

void look_at_run(const Input& input, Look& look) {
  const RunInput& run = input.run;
  look.at("run.tolerance", run.tolerance, {1e-5, 9e-3});
  if (run.method == MethodKind::explicit_) {
    look.at("run.damping", run.damping, {0.02, 0.95, true});
    look.at("run.ramp_steps", run.ramp_steps, {500, 400000, true});
  }
  if (run.max_steps) look.at("run.max_steps", static_cast<double>(*run.max_steps), {2000, 1900000});
  if (input.laid) return;
  const double span = 2 * input.tunnel.half_width();
  if (run.displacement_limit != by_the_rock)
    look.beside_opening("run.displacement_limit", run.displacement_limit, span, {0.001, 0.5});
  if (run.contact_update_limit != by_the_rock)
    look.beside_opening("run.contact_update_limit", run.contact_update_limit, span, {1e-5, 0.009});
}

/// Outlines that stand on their head. It is said, and nothing is turned: some are meant so.
void look_for_arches_below(const Input& input, std::vector<std::string>& found) {
  const auto look = [&](const std::string& table, const OutlineInput& outline) {
    if (outline.shape != TunnelShape::polygon || !is_flat_above_an_arch(outline.vertices)) return;
    const bool is_drawn = !outline.drawn.empty();
    found.push_back(table + (is_drawn ? "file" : "vertices") +
                    " has its flat side on top and its arch below, as where y counts downwards; it "
                    "is read upwards: unless it is meant so, " +
                    (is_drawn ? "mirror it about a level line in the drawing"
                              : "change the sign of every second coordinate"));
  };
  look("tunnel.", input.tunnel);
  for (std::size_t k = 0; k < input.openings.size(); ++k) {
    // The outline of a shaft is a plan, which has no top.
    const double plunge = input.openings[k].plunge.value_or(0);
    if (std::abs(plunge) <= 45 * degree) look(entry("opening", k) + ".", input.openings[k]);
  }
}

}  // namespace

std::vector<std::string> unusual_values(const Input& input) {
  Look look;
  look.at("model.gravity", input.model.gravity, gravity, dimension::acceleration);
  look.at("rock.density", input.rock.density, density, dimension::density);
  if (!input.laid) look_at_model(input, look);
  look_at_joints(input, look);
  const std::vector<BoltsInput>& patterns = input.bolts;
  for (std::size_t k = 0; k < patterns.size(); ++k) {
    const std::string table = input.bolts_key(k) + ".";
    look_at_bolts(table, patterns[k], look);
    if (patterns[k].bars.empty()) look_at_spacing(table + "spacing", patterns[k].spacing, look);
  }
  const std::vector<LiningInput>& linings = input.linings;
  for (std::size_t k = 0; k < linings.size(); ++k)
    look_at_lining(input.lining_key(k) + ".", linings[k], look);
  for (std::size_t k = 0; k < input.stages.size(); ++k)
    look.at(entry(input.has_rounds ? "round" : "stage", k) + ".wall_traction",
            input.stages[k].wall_traction, {0.01, 1, true}, dimension::number);
  if (input.diagram) {
    for (std::size_t k = 0; k < input.diagram->spacing.size(); ++k)
      if (const auto& spacing = input.diagram->spacing[k])
        look_at_spacing(entry("diagram.spacing", k), *spacing, look);
    for (std::size_t k = 0; k < input.diagram->thickness.size(); ++k)
      if (input.diagram->thickness[k] > 0)
        look.at(entry("diagram.thickness", k), input.diagram->thickness[k], shotcrete_to_concrete,
                dimension::length);
  }
  look_at_run(input, look);
  std::vector<std::string> found = std::move(look).found();
  if (!input.laid) look_for_arches_below(input, found);
  for (std::size_t k = 0; k < input.joint_sets.size() && !input.laid; ++k) {
    const JointSetInput& set = input.joint_sets[k];
    if (!std::isfinite(set.extent) || (input.is_spatial() && !is_of_section(input, set))) continue;
    // As few as four fifths: half of the domain or more is the length of a trace.
    const double inside = length_inside(input, set);
    if (inside < 0.8)
      found.push_back(entry("joint_set", k) +
                      ".extent = " + format_quantity(set.extent, dimension::length) +
                      " is long beside the domain, in which the centres of joints lie: " +
                      significant_text(100 * inside, 2) +
                      " % of the length of these joints lies in it, and they are so much farther "
                      "apart than in a larger one; without extent and with spacing they go right "
                      "through, as far apart as asked for");
  }
  return found;
}

std::vector<std::string> warnings_about_values(const Input& input) {
  std::vector<std::string> warnings = unusual_values(input);
  for (std::string text : {input.unused_text(), input.uncertain_text()})
    if (!text.empty()) warnings.push_back(std::move(text));
  return warnings;
}

std::string unusual_among(const Input& input, std::initializer_list<std::string_view> tables) {
  std::string all;
  for (const std::string& text : unusual_values(input))
    if (std::any_of(tables.begin(), tables.end(),
                    [&](std::string_view table) { return text.starts_with(table); }))
      all += "; " + text;
  return all;
}

InSituClosure in_situ_closure(const Input& input, double stress, double block, double spacing) {
  double softest = std::numeric_limits<double>::infinity();
  for (const JointLawInput* law : laws_in_use(input))
    softest = std::min(softest, normal_stiffness_at(joint_of(*law), stress));
  const double opening = 2 * input.tunnel.half_width();
  return {stress, stress / softest, block, stress / softest * (opening / spacing), opening};
}

std::vector<std::string> remarks_on(const InSituClosure& closure) {
  std::vector<std::string> remarks;
  const auto metres = [](double value) { return format_quantity(value, dimension::length); };
  const std::string stress =
      "the in-situ stress p0 = " + format_quantity(closure.stress, dimension::pressure) +
      " at the centre of the opening";
  if (closure.is_large_for_blocks())
    remarks.push_back(stress + " closes joints by p0/kn = " + metres(closure.of_joints) +
                      ", more than a tenth of a block (" + metres(closure.block) +
                      "): small displacements no longer hold, see the kn of the joints");
  if (closure.is_large_for_opening())
    remarks.push_back(
        stress + " closes an opening in this rock by about p0 D/E = " + metres(closure.of_opening) +
        ", " + significant_text(100 * closure.of_opening / closure.opening, 2) +
        " % of its width D (E = kn s, s the spacing of joints; common: below 2 %), see the kn of "
        "the joints");
  return remarks;
}

}  // namespace voussoir::program
