// SPDX-License-Identifier: MIT
// Bolt forces over p0 D theta_b on three joint patterns: Fig. 14.
#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

Section normalised_forces(Study& study) {
  Section section{"normalised_forces",
                  "Bolt forces normalised by spacing",
                  "5.2, Fig. 14",
                  {"Mean over bolts of each bolt's largest force, divided by p0 D θ_b, 4 m bolts; "
                   "every realisation for itself. A bolt that carries the whole pressure on "
                   "its share of the wall has 0.5."}};
  const std::vector<double> spacings{11.25, 15, 22.5};
  const auto at = [](double s) { return Variant{.bolts = Bolts{.spacing = s * degree}}; };
  std::vector<Variant> variants;
  for (const double s : spacings) {
    variants.push_back(at(s));
    variants.push_back(at(s).as_the_paper());
  }
  study.prepare(variants);
  const auto normalised = [](const Outcome& o, double spacing) {
    return o.mean_force() / (force_unit * spacing * degree);
  };
  Plot plot{"normalised_forces",
            "Bolt force over its share of the ground pressure",
            "bolt spacing θ_b, degrees",
            "F / (p_0 D θ_b)",
            {}};
  for (const NamedGround& g : elastic_grounds()) {
    Series line{std::string("elastic at the wall, ") + g.name, Mark::line, {}, {}};
    for (double s = 10; s <= 24; s += 0.5) {
      line.x.push_back(s);
      line.y.push_back(SmearedBolts(smeared({.spacing = s * degree}), g.ground, ground_pressure)
                           .bolt_force(radius) /
                       (force_unit * s * degree));
    }
    plot.series.push_back(line);
  }
  for (int k = 0; k < study.samples(); ++k) {
    Series points{"realisation " + std::to_string(k + 1), Mark::linked_points, {}, {}};
    for (const double s : spacings) {
      const Outcome& o = study.of(at(s))[static_cast<std::size_t>(k)];
      if (!o.stable()) continue;
      points.x.push_back(s);
      points.y.push_back(normalised(o, s));
    }
    if (k < 4) plot.series.push_back(points);
  }
  plot.y_range = {{0, NAN}};
  plot.caption = "The first four realisations.";
  for (const double s : spacings) say_collapsed(plot, study, {{printed_text(s, 4) + "°", at(s)}});
  section.plots.push_back(plot);

  const auto over = [&](bool sudden) {
    std::vector<Measured> result;
    for (const double s : spacings)
      result.push_back(study.measure(sudden ? at(s).as_the_paper() : at(s),
                                     [&](const Outcome& o) { return normalised(o, s); }));
    return result;
  };
  const std::vector<Measured> quasi = over(false), sudden = over(true);
  const auto spread_of = [](const std::vector<Measured>& m) {
    return std::max({m[0].mean(), m[1].mean(), m[2].mean()}) /
           std::min({m[0].mean(), m[1].mean(), m[2].mean()});
  };
  const auto falls_a_little = [&](const std::vector<Measured>& m) {
    return spread_of(m) < 2 && m[2].mean() < m[0].mean();
  };
  section.findings.push_back({"PF-060", agrees_if(falls_a_little(quasi)),
                              "F / (p0 D θ_b) = " + means(quasi, 1, "") +
                                  " for 11.25°, 15°, 22.5°: largest over smallest " +
                                  printed_text(spread_of(quasi), 3) + " (elastic, G1: 1.85)",
                              "", means(sudden, 1, ""), agrees_if(falls_a_little(sudden))});
  double most = 0, most_sudden = 0;
  for (const double s : spacings)
    for (const bool explicit_way : {false, true})
      for (const Outcome& o : study.of(explicit_way ? at(s).as_the_paper() : at(s)))
        if (o.stable())
          (explicit_way ? most_sudden : most) =
              std::max(explicit_way ? most_sudden : most,
                       o.largest_force() / (ground_pressure * radius * s * degree));
  section.findings.push_back(
      {"PF-061", agrees_if(most <= 1),
       "largest bolt force of any realisation over p0 a θ_b: " + printed_text(most, 3), "",
       printed_text(most_sudden, 3), agrees_if(most_sudden <= 1)});
  return section;
}

}  // namespace voussoir::paper
