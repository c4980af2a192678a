// SPDX-License-Identifier: MIT
#include "pullout.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <variant>
#include <voussoir/bolt/bar_in_rock.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/design/bolt_strength.hpp>
#include <voussoir/design/models.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/csv_table.hpp>
#include <voussoir/io/curve_picture.hpp>
#include <voussoir/theory/pull_out.hpp>

#include "output_parts.hpp"

namespace voussoir::program {

namespace {

/// The whole of a bolt; of bars one by one the longest.
double length_of_bolt(const BoltsInput& pattern) {
  double longest = pattern.length;
  for (const Segment& bar : pattern.bars) longest = std::max(longest, bar.length());
  return longest;
}

/// What becomes of the bar itself on a curve that ends or goes on.
/// @param bears            what holds the bar [N]
/// @param displacement_at  displacement_at(force) where all but that is elastic or slips [m]
template <class DisplacementAt>
void add_bar_events(const BarStrength& bar, const BoltCurve& curve, double bears,
                    const DisplacementAt& displacement_at, PullOutTest& test) {
  if (bar.yield_force < bar.rupture_force && bar.yield_force <= bears)
    test.events.push_back({"the bar yields", displacement_at(bar.yield_force), bar.yield_force});
  if (curve.breaks())
    test.events.push_back({"the bolt is lost", curve.last().extension, curve.last().force});
}

PullOutTest bonded_test(const BoltsInput& pattern, const BondedBolt& bolt, double length) {
  const PullOut pulled = pull_out_of(bolt, length);
  const BoltCurve curve = pull_out_curve(bolt, length);
  PullOutTest test{.pattern = pattern.name,
                   .length = length,
                   .stiffness = pulled.head_stiffness(),
                   .events = {},
                   .curve = curve};
  const PullOutPoint first = pulled.first_slip(), all = pulled.last();
  const double bears = bolt_strength(pattern);
  if (first.force < bears)
    test.events.push_back({"bond begins to slip", first.displacement, first.force});
  // The curve is of chords; what is told of the bond and of yield is not.
  add_bar_events(
      bolt.strength, curve, all.force,
      [&](double force) { return pulled.at_force(force).displacement; }, test);
  if (all.force < bears)
    test.events.push_back({"all of the bond slips", all.displacement, all.force});
  if (std::isfinite(bears)) test.enough = bears / bolt.bond_strength;
  return test;
}

PullOutTest end_anchored_test(const BoltsInput& pattern, const EndAnchoredBolt& bolt) {
  const double length = length_of_bolt(pattern);
  const BoltCurve curve = curve_of(bolt, {0.5 * length, 0.5 * length});
  PullOutTest test{.pattern = pattern.name,
                   .is_bonded = false,
                   .length = length,
                   .stiffness = curve.stiffness(),
                   .events = {},
                   .curve = curve};
  add_bar_events(
      bolt.strength, curve, curve.strength(),
      [&](double force) { return curve.extension_at(force); }, test);
  if (!curve.breaks() && std::isfinite(curve.strength()))
    test.events.push_back({"the anchor slips", curve.last().extension, curve.last().force});
  return test;
}

std::string millimetres(double length) { return significant_text(1e3 * length, 3) + " mm"; }
std::string kilonewtons(double force) { return significant_text(1e-3 * force, 3) + " kN"; }

/// "bonded over 3 m", "anchored at 3 m"
std::string held_text(const PullOutTest& test) {
  return (test.is_bonded ? "bonded over " : "anchored at ") + significant_text(test.length, 3) +
         " m";
}

}  // namespace

PullOutTests pull_out_tests(const Input& input, const std::vector<double>& lengths) {
  PullOutTests all;
  for (const BoltsInput& pattern : input.bolts) {
    const auto bar = bar_in_rock_of(pattern);
    if (!bar) {
      all.warnings.push_back(pattern.name +
                             ": given by its stiffness across a joint, which tells no pull-out");
      continue;
    }
    if (const auto* const bonded = std::get_if<BondedBolt>(&*bar)) {
      for (const double length : lengths.empty() ? std::vector{length_of_bolt(pattern)} : lengths)
        all.tests.push_back(bonded_test(pattern, *bonded, length));
    } else {
      all.tests.push_back(end_anchored_test(pattern, std::get<EndAnchoredBolt>(*bar)));
    }
  }
  if (all.tests.empty())
    throw InvalidInput(
        "support.bolts: says of no bolt how the rock holds its bar\n   = accepted: bond_strength "
        "and bond_stiffness with area and E, or type = \"end-anchored\"");
  for (PullOutTest& test : all.tests) {
    // Beyond what gives last by a half; without any to the fifth of a percent of the length.
    double last = 0;
    for (const PullOutEvent& event : test.events) last = std::max(last, event.displacement);
    test.shown = test.curve.breaks() ? test.curve.last().extension
                 : last > 0          ? 1.5 * last
                                     : 2e-3 * test.length;
  }
  return all;
}

std::string pull_out_text(const PullOutTests& all) {
  std::string out;
  for (const PullOutTest& test : all.tests) {
    out += "pullout  " + test.pattern + ", " + held_text(test) + ": head stiffness " +
           significant_text(1e-6 * test.stiffness, 3) + " MN/m\n";
    for (const PullOutEvent& event : test.events)
      out += "         " + event.what + " at " + millimetres(event.displacement) + " and " +
             kilonewtons(event.force) + "\n";
    if (test.events.empty()) out += "         no strength was given: it stays elastic\n";
    if (test.enough)
      out += "         bond over " + significant_text(*test.enough, 3) +
             " m bears what the bar does\n";
  }
  for (const std::string& warning : all.warnings) out += "warning  " + warning + "\n";
  return out;
}

std::string pull_out_csv(const PullOutTests& all) {
  CsvTable table({"pattern", "length_m", "displacement_mm", "force_kN"}, 6);
  for (const PullOutTest& test : all.tests) {
    const auto row = [&](double displacement) {
      table.add_row(test.pattern, test.length, 1e3 * displacement,
                    1e-3 * test.curve.force(displacement));
    };
    row(0);
    for (const BoltCurve::Point& point : test.curve.points())
      if (point.extension < test.shown) row(point.extension);
    row(test.shown);
  }
  return table.text();
}

std::string pull_out_json(const PullOutTests& all) {
  nlohmann::json json = {
      {"schema", 1}, {"tests", nlohmann::json::array()}, {"warnings", all.warnings}};
  for (const PullOutTest& test : all.tests) {
    nlohmann::json events = nlohmann::json::array();
    for (const PullOutEvent& event : test.events)
      events.push_back({{"what", event.what},
                        {"displacement_mm", 1e3 * event.displacement},
                        {"force_kN", 1e-3 * event.force}});
    json["tests"].push_back({{"pattern", test.pattern},
                             {"type", test.is_bonded ? "bonded" : "end-anchored"},
                             {"length_m", test.length},
                             {"head_stiffness_MN_per_m", 1e-6 * test.stiffness},
                             {"events", events},
                             {"length_as_strong_as_the_bar_m", number_json(test.enough)}});
  }
  return json.dump(2) + "\n";
}

std::string pull_out_svg(const Input& input, const PullOutTests& all) {
  constexpr const char* colours[] = {"#1f4e79", "#b3541e", "#5b8c3e", "#7a4a8c", "#8c6d1f"};
  CurvePicture picture;
  picture.header.title = input.title.empty() ? "Pull-out test" : input.title;
  picture.across = "displacement of the head [mm]";
  picture.up = "force [kN]";
  Curve gives{.name = "what gives", .points = {}, .colour = "#222", .is_joined = false};
  for (std::size_t k = 0; k < all.tests.size(); ++k) {
    const PullOutTest& test = all.tests[k];
    const auto at = [&](double displacement) {
      return Vec2(1e3 * displacement, 1e-3 * test.curve.force(displacement));
    };
    Curve curve{.name = test.pattern + ", " + held_text(test),
                .points = {Vec2(0, 0)},
                .colour = colours[k % std::size(colours)],
                .is_marked = false};
    for (const BoltCurve::Point& point : test.curve.points())
      if (point.extension < test.shown) curve.points.push_back(at(point.extension));
    curve.points.push_back(at(test.shown));
    picture.curves.push_back(curve);
    for (const PullOutEvent& event : test.events)
      gives.points.push_back({1e3 * event.displacement, 1e-3 * event.force});
  }
  if (!gives.points.empty()) picture.curves.push_back(gives);
  return draw_curve_picture(picture);
}

}  // namespace voussoir::program
