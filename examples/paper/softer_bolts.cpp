// SPDX-License-Identifier: MIT
// Stiffness of the bolts in composite support: Figs 25 and 26.
#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

Section softer_bolts(Study& study) {
  Section section{
      "softer_bolts",
      "Stiffness of the bolts",
      "8.2, Figs 25 and 26",
      {"Two thirds, one and three times the axial stiffness of the 28 mm bar; 4 m bolts "
       "at 15°, with a ring of 10 cm and without."}};
  const std::vector<double> factors{2.0 / 3, 1, 3};
  const auto lined = [](double f) {
    return Variant{.bolts = Bolts{.stiffness = f * bolt_stiffness}, .lining = Lining{}};
  };
  const auto bare = [](double f) {
    return Variant{.bolts = Bolts{.stiffness = f * bolt_stiffness}};
  };
  const auto mean_force = [](const Outcome& o) { return o.mean_force(); };
  const Swept force =
      swept(study, "with 10 cm of lining", factors, lined, mean_force, 1 / force_unit);
  const Swept force_bare =
      swept(study, "without lining", factors, bare, mean_force, 1 / force_unit);
  const Swept u = swept(study, "with 10 cm of lining", factors, lined, crown, 1e2 / radius);
  const Swept u_bare = swept(study, "without lining", factors, bare, crown, 1e2 / radius);
  const Swept n = swept(
      study, "mean thrust", factors, lined, [](const Outcome& o) { return o.mean_thrust(); },
      1 / force_unit);
  const Swept m = swept(
      study, "largest |M|", factors, lined, [](const Outcome& o) { return o.largest_moment(); },
      1e-3);
  Plot f{"softer_bolts_force",
         "Mean of the bolts' largest forces",
         "K_a / (0.2 GN/m)",
         "F / (p_0 D)",
         {}};
  Plot c{"softer_bolts_crown", "Crown convergence", "K_a / (0.2 GN/m)", "convergence, % of a", {}};
  Plot thrust{"softer_bolts_thrust", "Thrust of the lining", "K_a / (0.2 GN/m)", "N / (p_0 D)", {}};
  Plot moment{"softer_bolts_moment", "Moment of the lining", "K_a / (0.2 GN/m)", "|M|, kN m/m", {}};
  for (const Swept* s : {&force, &force_bare}) draw(f, *s);
  for (const Swept* s : {&u, &u_bare}) draw(c, *s);
  draw(thrust, n);
  draw(moment, m);
  for (const NamedGround& g : elastic_grounds()) {
    Series lines[3] = {{std::string("elastic, lined, ") + g.name, Mark::line, {}, {}},
                       {std::string("elastic, lined, ") + g.name, Mark::line, {}, {}},
                       {std::string("elastic, ") + g.name, Mark::line, {}, {}}};
    for (double k = 0.6; k <= 3.05; k += 0.1) {
      const ElasticSupport s = elastic_support(radius, smeared({.stiffness = k * bolt_stiffness}),
                                               thin({}), g.ground, ground_pressure);
      const double y[3] = {s.bolt_force / force_unit, 1e2 * s.convergence / radius,
                           s.thrust / force_unit};
      for (int i = 0; i < 3; ++i) {
        lines[i].x.push_back(k);
        lines[i].y.push_back(y[i]);
      }
    }
    f.series.push_back(lines[0]);
    c.series.push_back(lines[1]);
    thrust.series.push_back(lines[2]);
  }
  for (Plot* p : {&f, &c, &thrust, &moment}) p->y_range = {{0, NAN}};
  section.plots = {f, c, thrust, moment};

  section.findings.push_back(
      {"PF-094", agrees_if(rises(force.measured) && rises(force_bare.measured)),
       "F / (p0 D) " + means(force.measured, 1 / force_unit, "") + " lined, " +
           means(force_bare.measured, 1 / force_unit, "") + " unlined, for 2/3, 1, 3 K_a"});
  const double n_more = n.measured[0].mean() / n.measured[2].mean() - 1;
  const double m_more = m.measured[0].mean() / m.measured[2].mean() - 1;
  const bool slightly = n_more >= 0 && m_more >= 0 && n_more < 0.1 && m_more < 0.1;
  section.findings.push_back(
      {"PF-095", agrees_if(slightly),
       "from 3 K_a down to 2/3 K_a: mean thrust " + percent(n_more) + ", largest moment " +
           percent(m_more),
       slightly ? "" : "one of the two goes the other way or by more than 10 %"});
  const double u_more = u.measured[0].mean() / u.measured[2].mean() - 1;
  section.findings.push_back(
      {"PF-096", agrees_if(std::abs(u_more) < 0.1),
       "crown from 3 K_a down to 2/3 K_a: " + percent(u_more) + " lined, " +
           percent(u_bare.measured[0].mean() / u_bare.measured[2].mean() - 1) + " unlined"});
  const auto beta = [](double factor, double spacing) {
    return SmearedBolts(
               smeared({.spacing = spacing * degree, .stiffness = factor * bolt_stiffness}),
               elastic_grounds()[0].ground, 1)
        .beta();
  };
  // What shares beta should share the crown; an elastic ring of 10 cm cannot tell them apart.
  const auto with_spacing = [](double spacing) {
    return Variant{.bolts = Bolts{.spacing = spacing * degree}, .lining = Lining{}};
  };
  const Measured softer = ratio(study, with_spacing(22.5), lined(2.0 / 3), crown);
  const Measured stiffer = ratio(study, with_spacing(5), lined(3), crown);
  section.findings.push_back(
      {"PF-097",
       agrees_if(std::abs(beta(2.0 / 3, 15) / beta(1, 22.5) - 1) < 1e-12 &&
                 std::abs(beta(3, 15) / beta(1, 5) - 1) < 1e-12 &&
                 std::abs(softer.mean() - 1) < 0.05 && std::abs(stiffer.mean() - 1) < 0.05),
       "beta of 2/3 K_a at 15° and of K_a at 22.5°: " + printed_text(beta(2.0 / 3, 15), 5) + ", " +
           printed_text(beta(1, 22.5), 5) + "; of 3 K_a at 15° and of K_a at 5°: " +
           printed_text(beta(3, 15), 5) + ", " + printed_text(beta(1, 5), 5) +
           "; crowns of blocks that share beta: " + softer.text(1, "") + ", " +
           stiffer.text(1, "") + " of each other"});
  return section;
}

}  // namespace voussoir::paper
