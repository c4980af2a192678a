// SPDX-License-Identifier: MIT
// What one bolt does at one joint: section 3.1 and the data of section 5.2.
#include <cmath>
#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/bolt_anchors.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/theory/grouted_bolt.hpp>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

namespace {

struct JointForce {
  double along, normal;  ///< on the joint: shear resistance and clamping [N]
};
/// A bolt normal to a joint that shears by `shear` and opens by `opening`.
JointForce force_across(double initial, double shear, double opening) {
  const AxialBolt bolt({.axial_stiffness = bolt_stiffness});
  BoltSpan<2> span{};
  span.axis = Vec2(0, 1);
  span.initial = initial * span.axis;
  span.motion = span.jump = Vec2(shear, opening);
  const Vec2 pull = bolt.force(span, {}).pull;  // on the first anchor, towards the second
  return {pull.x(), pull.y()};
}

}  // namespace

Section bolt_model(Study& study) {
  Section section{"bolt_model",
                  "What a bolt does at a joint",
                  "3.1, 5.2, Appendix A, Figs 3 and 4",
                  {"A spring between two anchors, one in each block, along the line that joins "
                   "them. For a joint that shears without opening a bolt normal to it does next to "
                   "nothing until it has turned; anchors near the joint turn soonest."}};
  Plot plot{"bolt_across_joint",
            "A bolt normal to a joint that shears",
            "shear displacement, mm",
            "force, kN",
            {}};
  for (const auto& [name, initial] : {std::pair("1.2 d from the joint", 0.0672),
                                      {"midway in 0.77 m blocks", 0.77},
                                      {"on the joint", 0.0}}) {
    Series along{std::string(name) + ": along it", Mark::line, {}, {}};
    Series clamp{std::string(name) + ": clamping", Mark::dashed_line, {}, {}};
    for (double s = 0; s <= 0.0201; s += 0.0005) {
      const JointForce f = force_across(initial, s, 0);
      along.x.push_back(1e3 * s);
      clamp.x.push_back(1e3 * s);
      along.y.push_back(1e-3 * f.along);
      clamp.y.push_back(1e-3 * f.normal);
    }
    plot.series.push_back(along);
    plot.series.push_back(clamp);
  }
  plot.y_range = {{0, 1000}};
  section.plots.push_back(plot);

  // ---- findings ----
  double worst = 0;
  for (const double initial : {0.0672, 0.77})
    for (const double s : {0.001, 0.01})
      for (const double w : {0.0, 0.002}) {
        const double length = elementary::length(initial + w, s);
        const double f = bolt_stiffness * (length - initial);
        const JointForce got = force_across(initial, s, w);
        worst = std::max({worst, std::abs(got.along - f * s / length) / f,
                          std::abs(got.normal - f * (initial + w) / length) / f});
      }
  section.findings.push_back({"PF-031", agrees_if(worst < 1e-9),
                              "f = K_a (l - d_init) along the anchors, 8 motions: within " +
                                  printed_text(1e12 * worst, 1) + " · 10⁻¹²"});
  const JointForce on_joint = force_across(0, 0.01, 0), near = force_across(0.0672, 0.01, 0);
  const double l = elementary::length(0.0672, 0.01);
  section.findings.push_back(
      {"PF-032",
       agrees_if(on_joint.normal == 0 &&
                 std::abs(near.normal / (bolt_stiffness * 0.0672 * (1 - 0.0672 / l)) - 1) < 1e-9),
       "sheared by 10 mm: on the joint " + printed_text(1e-3 * on_joint.along) + " kN along it, " +
           printed_text(1e-3 * on_joint.normal) + " kN clamping; 1.2 d from it " +
           printed_text(1e-3 * near.along) + " and " + printed_text(1e-3 * near.normal) + " kN"});
  const GroutedBoltStiffness grout = grouted_bolt_stiffness({0.028, 0.042, 200e9, 10e9, 4e9});
  Bolts stiffer{};
  stiffer.shear_stiffness = grout.shear;
  const Measured less = ratio(study, {.bolts = Bolts{}}, {.bolts = stiffer}, crown);
  bool never_more = true;
  for (const double r : less.values) never_more = never_more && r <= 1.001;
  section.findings.push_back(
      {"PF-033", agrees_if(never_more),
       "4 m bolts at 15° with a shear spring of " + printed_text(1e-9 * grout.shear) +
           " GN/m (28 mm bar, 42 mm hole, grout of 10 GPa): crown × " + less.text(1, "", 3),
       never_more ? "" : "in some realisation the crown moves more"});
  const AnchorDistances d = LorigAnchors{1.2 * bolt_diameter}.distances({.before = 1, .after = 1});
  section.findings.push_back({"PF-034", agrees_if(std::abs(d.before + d.after - 0.0672) < 1e-12),
                              "d_init = " + printed_text(1e3 * (d.before + d.after), 4) + " mm"});
  const double areas = std::pow(0.028 / 0.020, 2);
  const double strength = bolt_strength / (std::numbers::pi * 0.028 * 0.028 / 4);
  section.findings.push_back({"PF-035", agrees_if(std::abs(areas / 2 - 1) < 0.05),
                              "areas of the bars " + printed_text(areas, 3) +
                                  ", stiffnesses 2; 500 kN is " + printed_text(1e-6 * strength) +
                                  " MPa on 28 mm"});
  const double rigidity = bolt_stiffness * joint_spacing;
  const double modulus = rigidity / (std::numbers::pi * 0.028 * 0.028 / 4);
  section.findings.push_back({"PF-036", agrees_if(modulus > 190e9 && modulus < 260e9),
                              "E_b A_b = " + printed_text(1e-9 * rigidity) + " GN, E_b = " +
                                  printed_text(1e-9 * modulus, 4) + " GPa of the full bar"});
  return section;
}

}  // namespace voussoir::paper
