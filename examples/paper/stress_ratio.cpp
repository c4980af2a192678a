// SPDX-License-Identifier: MIT
// In-situ stress ratio with 4 m bolts at 15 degrees and 10 cm of lining: Figs 27 and 28.
#include <voussoir/theory/lining_in_ground.hpp>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

Section stress_ratio(Study& study) {
  Section section{
      "stress_ratio",
      "In-situ stress ratio",
      "8.3, Figs 27 and 28",
      {"K0, horizontal over vertical stress, from 0.5 to 2, with 4 m bolts at 15° and a "
       "ring of 10 cm. At K0 = 0.5 and 2 some joint orientations need 19.5° of friction "
       "in situ; all have 35°."}};
  const std::vector<double> ratios{0.5, 0.75, 1, 1.25, 1.5, 2};
  const auto at = [](double k0) { return Variant{.bolts = Bolts{}, .lining = Lining{}, .k0 = k0}; };
  const auto mean_force = [](const Outcome& o) { return o.mean_force(); };
  const auto thrust_at = [](double angle) {
    return [angle](const Outcome& o) { return o.thrust_near(angle * degree); };
  };
  const auto thrust_springing = [](const Outcome& o) {
    return 0.5 * (o.thrust_near(0) + o.thrust_near(180 * degree));
  };
  const auto moment_crown = [](const Outcome& o) { return o.moment_near(90 * degree); };
  const auto moment_springing = [](const Outcome& o) {
    return 0.5 * (o.moment_near(0) + o.moment_near(180 * degree));
  };
  const Swept f =
      swept(study, "blocks, mean of the bolts' largest", ratios, at, mean_force, 1 / force_unit);
  const Swept u_top = swept(study, "blocks, crown", ratios, at, crown, 1e3);
  const Swept u_side = swept(study, "blocks, springings", ratios, at, springing, 1e3);
  const Swept n_top = swept(study, "blocks, crown", ratios, at, thrust_at(90), 1 / force_unit);
  const Swept n_low = swept(study, "blocks, invert", ratios, at, thrust_at(270), 1 / force_unit);
  const Swept n_side =
      swept(study, "blocks, springings", ratios, at, thrust_springing, 1 / force_unit);
  const Swept m_top = swept(study, "blocks, crown", ratios, at, moment_crown, 1e-3);
  const Swept m_side = swept(study, "blocks, springings", ratios, at, moment_springing, 1e-3);

  Plot force{"stress_ratio_bolts", "Bolt forces", "K_0", "F / (p_0 D)", {}};
  Plot wall{"stress_ratio_wall", "Convergence", "K_0", "convergence, mm", {}};
  Plot thrust{"stress_ratio_thrust", "Thrust of the lining", "K_0", "N / (p_0 D)", {}};
  Plot moment{"stress_ratio_moment",
              "Moment of the lining (tension outside positive)",
              "K_0",
              "M, kN m/m",
              {}};
  draw(force, f);
  for (const Swept* s : {&u_top, &u_side}) draw(wall, *s);
  for (const Swept* s : {&n_top, &n_low, &n_side}) draw(thrust, *s);
  for (const Swept* s : {&m_top, &m_side}) draw(moment, *s);
  Series lines[6] = {{"elastic ring, G_3, crown", Mark::line, {}, {}},
                     {"elastic ring, G_3, springings", Mark::dashed_line, {}, {}},
                     {"elastic ring, G_3, crown", Mark::line, {}, {}},
                     {"elastic ring, G_3, springings", Mark::dashed_line, {}, {}},
                     {"elastic ring, G_3, crown", Mark::line, {}, {}},
                     {"elastic ring, G_3, springings", Mark::dashed_line, {}, {}}};
  for (double k = 0.5; k <= 2.01; k += 0.05) {
    const auto r = einstein_schwartz(RingLining::rectangular(radius, 0.1, lining_modulus),
                                     {ground_pressure, k}, elastic_grounds()[2].ground,
                                     LiningInterface::no_slip);
    const double up = 90 * degree;
    const double y[6] = {1e3 * r.convergence_at(up),   1e3 * r.convergence_at(0),
                         r.thrust_at(up) / force_unit, r.thrust_at(0) / force_unit,
                         1e-3 * r.moment_at(up),       1e-3 * r.moment_at(0)};
    for (int i = 0; i < 6; ++i) {
      lines[i].x.push_back(k);
      lines[i].y.push_back(y[i]);
    }
  }
  Plot* drawn_in[3] = {&wall, &thrust, &moment};
  for (int i = 0; i < 6; ++i) drawn_in[i / 2]->series.push_back(lines[i]);
  wall.caption =
      "Elastic: the ring alone, glued to the wall (Einstein and Schwartz, no slip); the "
      "blocks have bolts and a springy interface besides.";
  force.y_range = {{0, NAN}};
  section.plots = {force, wall, thrust, moment};

  // ---- findings ----
  bool signs = true;
  std::string text;
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    const double more = u_top.measured[k].mean() - u_side.measured[k].mean();
    if (ratios[k] < 1) signs = signs && more > 0;
    if (ratios[k] > 1) signs = signs && more < 0;
    text += (text.empty() ? "" : ", ") + printed_text(1e3 * more, 3);
  }
  section.findings.push_back({"PF-098", agrees_if(signs),
                              "crown minus springings " + text +
                                  " mm for K0 = 0.5, 0.75, 1, 1.25, "
                                  "1.5, 2"});
  double most = 0;
  for (std::size_t k = 0; k < ratios.size(); ++k)
    if (std::isfinite(f.measured[k].mean()))
      most = std::max(most, std::abs(f.measured[k].mean() / f.measured[2].mean() - 1));
  section.findings.push_back(
      {"PF-099", agrees_if(most < 0.3),
       "F / (p0 D) " + means(f.measured, 1 / force_unit, "") + "; all within " + percent(most) +
           " of K0 = 1",
       most < 0.3 ? ""
                  : "the paper calls it particular to its patterns; here the forces follow "
                    "the mean stress, which grows with K0"});
  const Measured &crown15 = n_top.measured[4], &invert15 = n_low.measured[4],
                 &side15 = n_side.measured[4];
  section.findings.push_back(
      {"PF-100", agrees_if(crown15.mean() > side15.mean() && invert15.mean() > side15.mean()),
       "K0 = 1.5: crown " + printed_text(1e-3 * crown15.mean()) + ", invert " +
           printed_text(1e-3 * invert15.mean()) + ", springings " +
           printed_text(1e-3 * side15.mean()) + " kN/m"});
  const bool moments = m_top.measured[0].mean() < 0 && m_side.measured[0].mean() > 0 &&
                       m_top.measured[4].mean() > 0 && m_side.measured[4].mean() < 0;
  section.findings.push_back({"PF-101", agrees_if(moments),
                              "moment at crown and springings: K0 = 0.5 " +
                                  printed_text(1e-3 * m_top.measured[0].mean(), 2) + ", " +
                                  printed_text(1e-3 * m_side.measured[0].mean(), 2) +
                                  "; K0 = 1.5 " + printed_text(1e-3 * m_top.measured[4].mean(), 2) +
                                  ", " + printed_text(1e-3 * m_side.measured[4].mean(), 2) +
                                  " kN m/m",
                              moments ? "" : "one sign is not that of elastic ground"});
  return section;
}

}  // namespace voussoir::paper
