// SPDX-License-Identifier: MIT
// Lining thickness with 4 m bolts at 15 degrees: Figs 22 and 23.
#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

Section lining_thickness(Study& study) {
  Section section{"lining_thickness",
                  "Thickness of the lining, with bolts",
                  "8, Figs 22 and 23",
                  {"4 m bolts at 15° and a ring of shotcrete from nothing to 50 cm, both in place "
                   "before the rock moves."}};
  const std::vector<double> thicknesses{0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5};
  const auto variant = [](double t) {
    Variant v{.bolts = Bolts{}};
    if (t > 0) v.lining = Lining{.thickness = t};
    return v;
  };
  const auto sudden = [&](double t) { return variant(t).as_the_paper(); };
  const std::vector<double> ratios{0, 0.005, 0.01, 0.015, 0.02, 0.03, 0.04, 0.05};
  const auto at_ratio = [&](double r) { return variant(r * diameter); };
  const auto sudden_at = [&](double r) { return sudden(r * diameter); };

  const Swept crowns = swept(study, "blocks, quasi-static", ratios, at_ratio, crown, 1e2 / radius);
  const Swept crowns_sudden =
      swept(study, "blocks, as the paper ran it", {0, 0.01, 0.02}, sudden_at, crown, 1e2 / radius);
  const Swept forces = swept(
      study, "blocks, quasi-static", ratios, at_ratio,
      [](const Outcome& o) { return o.mean_force(); }, 1 / force_unit);
  const Swept forces_sudden = swept(
      study, "blocks, as the paper ran it", {0, 0.01, 0.02}, sudden_at,
      [](const Outcome& o) { return o.mean_force(); }, 1 / force_unit);
  const std::vector<double> lined(ratios.begin() + 1, ratios.end());
  const Swept thrusts = swept(
      study, "blocks, mean over the ring", lined, at_ratio,
      [](const Outcome& o) { return o.mean_thrust(); }, 1 / force_unit);
  const Swept largest = swept(
      study, "blocks, largest", lined, at_ratio,
      [](const Outcome& o) { return o.largest_thrust(); }, 1 / force_unit);
  const Swept moments = swept(
      study, "blocks, largest |M|", lined, at_ratio,
      [](const Outcome& o) { return o.largest_moment(); }, 1e-3);

  Plot convergence{"lining_thickness_crown",
                   "Crown convergence of the bolted opening",
                   "t / D",
                   "convergence, % of a",
                   {}};
  Plot force{"lining_thickness_bolts",
             "Largest force of each bolt, mean over bolts",
             "t / D",
             "F / (p_0 D)",
             {}};
  Plot thrust{"lining_thickness_thrust", "Thrust of the lining", "t / D", "N / (p_0 D)", {}};
  Plot moment{
      "lining_thickness_moment", "Largest moment of the lining", "t / D", "|M|, kN m/m", {}};
  draw(moment, moments);
  for (const NamedGround& g : elastic_grounds()) {
    Series u{std::string("elastic, ") + g.name, Mark::line, {}, {}}, f = u, n = u;
    for (double r = 0; r <= 0.0501; r += 0.0025) {
      std::optional<ThinLining> ring;
      if (r > 0) ring = thin({.thickness = r * diameter});
      const ElasticSupport s =
          elastic_support(radius, smeared({}), ring, g.ground, ground_pressure);
      for (Series* line : {&u, &f, &n}) line->x.push_back(r);
      u.y.push_back(1e2 * s.convergence / radius);
      f.y.push_back(s.bolt_force / force_unit);
      n.y.push_back(s.thrust / force_unit);
    }
    convergence.series.push_back(u);
    force.series.push_back(f);
    thrust.series.push_back(n);
  }
  for (const Swept* s : {&crowns, &crowns_sudden}) draw(convergence, *s);
  for (const Swept* s : {&forces, &forces_sudden}) draw(force, *s);
  for (const Swept* s : {&thrusts, &largest}) draw(thrust, *s);
  for (Plot* p : {&convergence, &force, &thrust, &moment}) p->y_range = {{0, NAN}};
  section.plots = {convergence, force, thrust, moment};

  const Variant bare = variant(0), tenth = variant(0.1);
  section.findings.push_back(
      {"PF-087", agrees_if(falls(forces.measured)),
       "F / (p0 D) " + means(forces.measured, 1 / force_unit, "") + " for t / D from 0 to 0.05", "",
       means(forces_sudden.measured, 1 / force_unit, "") + " for 0, 0.01, 0.02",
       agrees_if(falls(forces_sudden.measured))});
  const Measured left = ratio(study, bare, tenth, crown);
  const Measured left_sudden = ratio(study, bare.as_the_paper(), tenth.as_the_paper(), crown);
  const auto about_half = [](const Measured& m) { return m.mean() > 0.4 && m.mean() < 0.65; };
  section.findings.push_back({"PF-088", agrees_if(about_half(left)),
                              "crown with 10 cm over crown without: " + left.text(1, "", 3), "",
                              left_sudden.text(1, "", 3), agrees_if(about_half(left_sudden))});
  bool convex = true;
  for (std::size_t k = 0; k + 2 < ratios.size(); ++k) {
    const auto& m = crowns.measured;
    const double first = (m[k].mean() - m[k + 1].mean()) / (ratios[k + 1] - ratios[k]);
    const double next = (m[k + 1].mean() - m[k + 2].mean()) / (ratios[k + 2] - ratios[k + 1]);
    convex = convex && next > 0 && next < first;
  }
  section.findings.push_back({"PF-089", agrees_if(convex),
                              "crown " + means(crowns.measured, 1e3, "mm") +
                                  ": every step takes less per centimetre than the one before"});
  section.findings.push_back({"PF-090",
                              agrees_if(rises(thrusts.measured) && rises(moments.measured)),
                              "mean thrust " + means(thrusts.measured, 1e-3, "kN/m") +
                                  "; largest moment " + means(moments.measured, 1e-3, "kN m/m")});
  return section;
}

}  // namespace voussoir::paper
