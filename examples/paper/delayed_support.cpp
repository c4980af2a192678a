// SPDX-License-Identifier: MIT
// Support that comes late, by a fictitious support pressure: section 8.1 and the ground reaction
// curve.
#include <voussoir/theory/ground_reaction.hpp>
#include <voussoir/theory/longitudinal_profile.hpp>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

Section delayed_support(Study& study) {
  Section section{
      "delayed_support",
      "Support that comes late",
      "8.1",
      {"A residual wall traction holds the wall while the rock comes in: the "
       "ground reaction curve. A support installed on the way starts free of force; "
       "what is left of the traction is then taken away. How far the face is belongs to "
       "the longitudinal profile, which is a fit to continuum analyses (Vlachopoulos "
       "and Diederichs 2009): that of jointed rock needs 3-D runs.",
       "Ground that yields: Mohr-Coulomb with G3, nu = 0.37, 35° of friction and 20 kPa "
       "of cohesion, for comparison only; a jointed mass has no such constants."}};
  const std::vector<double> held{1, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2, 0.15, 0.1, 0.05, 0};
  const auto bare = [](double p) { return Variant{.held = p}; };
  std::vector<double> reversed(held.rbegin(), held.rend());
  Swept curve = swept(
      study, "blocks, mean of the upper wall", reversed, bare,
      [](const Outcome& o) { return o.mean_convergence; }, 1e3);
  // Drawn as usual: convergence along x, pressure up.
  std::swap(curve.series.x, curve.series.y);
  curve.series.spread.clear();
  std::swap(curve.failed.x, curve.failed.y);
  Plot reaction{"ground_reaction",
                "Ground reaction curve and a ring of 10 cm",
                "convergence, mm",
                "p_i / p_0",
                {}};
  draw(reaction, curve);
  const ElasticGround elastic = elastic_grounds()[2].ground;
  const GroundReactionCurve yielding(radius, ground_pressure, {elastic, 20e3, 35 * degree, 0});
  Series line{"elastic, G_3", Mark::line, {}, {}},
      soft{"yielding, 20 kPa, 35°", Mark::dashed_line, {}, {}};
  for (double p = 0; p <= 1.0001; p += 0.01) {
    line.x.push_back(1e3 * ground_pressure * (1 - p) * radius / (2 * elastic.shear_modulus));
    line.y.push_back(p);
    if (p >= 0.045) {
      soft.x.push_back(1e3 * yielding.convergence(std::min(p, 1.0) * ground_pressure));
      soft.y.push_back(p);
    }
  }
  const double f = thin({}).flexibility();
  const auto support_line = [&](const std::string& name, double from) {
    Series s{
        name, Mark::dashed_line, {1e3 * from, 1e3 * (from + f * 0.6 * ground_pressure)}, {0, 0.6}};
    return s;
  };
  const double u_free = ground_pressure * radius / (2 * elastic.shear_modulus);
  reaction.series.push_back(line);
  reaction.series.push_back(soft);
  reaction.series.push_back(support_line("ring wished in place", 0));
  reaction.series.push_back(support_line("ring at half of the convergence", 0.5 * u_free));
  reaction.x_range = {{0, 8}};
  reaction.y_range = {{0, 1}};

  const std::vector<double> at_support{0.1, 0.2, 0.4, 0.6, 0.8, 1};
  const auto late = [](double p) {
    return Variant{.bolts = Bolts{}, .lining = Lining{}, .held_at_support = p};
  };
  const Swept thrust = swept(
      study, "blocks, mean thrust", at_support, late,
      [](const Outcome& o) { return o.mean_thrust(); }, 1 / force_unit);
  const Swept force = swept(
      study, "blocks, mean of the bolts' largest", at_support, late,
      [](const Outcome& o) { return o.mean_force(); }, 1 / force_unit);
  const Swept top = swept(study, "blocks, crown in all", at_support, late, crown, 1e3);
  Plot forces{"delayed_forces",
              "Support installed at a residual wall traction",
              "residual wall traction, part of the in-situ traction",
              "N / (p_0 D), F / (p_0 D)",
              {}};
  for (const Swept* s : {&thrust, &force}) draw(forces, *s);
  Series elastic_n{"elastic thrust, G_3", Mark::line, {}, {}},
      elastic_f{"elastic bolt force, G_3", Mark::line, {}, {}};
  const ElasticSupport placed =
      elastic_support(radius, smeared({}), thin({}), elastic, ground_pressure);
  for (double p = 0; p <= 1.001; p += 0.05) {
    elastic_n.x.push_back(p);
    elastic_n.y.push_back(p * placed.thrust / force_unit);
    elastic_f.x.push_back(p);
    elastic_f.y.push_back(p * placed.bolt_force / force_unit);
  }
  forces.series.push_back(elastic_n);
  forces.series.push_back(elastic_f);
  Plot crowns{"delayed_crown",
              "Crown, in all, with support installed on the way",
              "residual wall traction, part of the in-situ traction",
              "convergence, mm",
              {}};
  draw(crowns, top);
  crowns.y_range = forces.y_range = {{0, NAN}};
  Plot profile{"longitudinal_profile",
               "Longitudinal displacement profile (continuum)",
               "distance from the face X / a",
               "u / u_{max}",
               {}};
  for (const double r : {1.0, 2.0, 4.0}) {
    Series s{"r_p / a = " + printed_text(r, 1), Mark::line, {}, {}};
    for (double x = -4; x <= 8.001; x += 0.1) {
      s.x.push_back(x);
      s.y.push_back(longitudinal_profile(x, r));
    }
    profile.series.push_back(s);
  }
  profile.x_range = {{-4, 8}};
  section.plots = {reaction, forces, crowns, profile};

  const Measured& half = thrust.measured[2];  // 0.4 held
  const Measured& whole = thrust.measured[5];
  const double part = half.mean() / whole.mean();
  section.findings.push_back(
      {"PF-102", agrees_if(rises(thrust.measured) && std::abs(part - 0.4) < 0.1),
       "thrust of a ring installed at a residual wall traction of 40 %: " + printed_text(part, 3) +
           " of that wished in place (elastic: 0.4); " + means(thrust.measured, 1e-3, "kN/m") +
           " for 0.1, 0.2, 0.4, 0.6, 0.8, 1 of the in-situ traction",
       std::abs(part - 0.4) < 0.1 ? "" : "the ground is not elastic"});
  section.findings.push_back(
      {"PF-104", Agreement::not_testable, "no joint of any run creeps",
       "There is nothing to measure; joints that creep are BurgersJoint (docs/theory.md)."});
  return section;
}

}  // namespace voussoir::paper
