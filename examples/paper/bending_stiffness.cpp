// SPDX-License-Identifier: MIT
// Bending stiffness of the lining at a constant area: Fig. 21.
#include <voussoir/theory/lining_in_ground.hpp>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

Section bending_stiffness(Study& study) {
  Section section{"bending_stiffness",
                  "Bending stiffness of the lining",
                  "7.2, Fig. 21",
                  {"A ring of 10 cm whose moment of inertia is changed while its area stays. In "
                   "elastic ground under equal stresses there is no moment at all; that of the "
                   "blocks comes from their size."}};
  const std::vector<double> factors{0.01, 0.1, 1, 10, 100};
  const auto at = [](double factor) { return Variant{.lining = Lining{.bending_factor = factor}}; };
  const auto largest = [](const Outcome& o) { return o.largest_thrust(); };
  const auto moment = [](const Outcome& o) { return o.largest_moment(); };
  const Swept thrusts = swept(study, "largest thrust", factors, at, largest, 1 / force_unit);
  const Swept mean = swept(
      study, "mean thrust", factors, at, [](const Outcome& o) { return o.mean_thrust(); },
      1 / force_unit);
  const Swept moments = swept(study, "blocks, largest |M|", factors, at, moment, 1e-3);
  Plot n{"bending_thrust", "Thrust", "E I / E I of 10 cm", "N / (p_0 D)", {}};
  Plot m{"bending_moment", "Moment", "E I / E I of 10 cm", "|M|, kN m/m", {}};
  for (const Swept* s : {&thrusts, &mean}) draw(n, *s);
  draw(m, moments, 1e-3);  // a logarithmic axis has no 0
  Series elastic{"elastic, K_0 = 0.9, G_3, no slip", Mark::line, {}, {}};
  for (double e = -2; e <= 2.01; e += 0.1) {
    RingLining ring = RingLining::rectangular(radius, 0.1, lining_modulus);
    ring.inertia *= std::pow(10, e);
    const auto r = einstein_schwartz(ring, {ground_pressure, 0.9}, elastic_grounds()[2].ground,
                                     LiningInterface::no_slip);
    elastic.x.push_back(std::pow(10, e));
    elastic.y.push_back(1e-3 * std::abs(r.moment_amplitude));
  }
  m.series.push_back(elastic);
  for (Plot* p : {&n, &m}) p->logarithmic_x = true;
  n.y_range = {{0, NAN}};
  m.more = "set logscale y\nset format y '10^{%T}'\n";
  section.plots = {n, m};
  section.findings.push_back({"PF-084", agrees_if(rises(moments.measured)),
                              "largest moment " + means(moments.measured, 1e-3, "kN m/m") +
                                  " for E I × 0.01, 0.1, 1, 10, 100"});
  section.findings.push_back(
      {"PF-085", agrees_if(rises(thrusts.measured)),
       "largest thrust " + means(thrusts.measured, 1e-3, "kN/m") + "; mean thrust " +
           means(mean.measured, 1e-3, "kN/m"),
       rises(thrusts.measured)
           ? ""
           : "The mean hardly changes (elastic: below 1.5 %); the largest is a local peak where a "
             "block presses, and a stiffer ring spreads it."});
  // A pushed crown: tension inside there. K0 < 1 does it.
  const Variant flat{.lining = Lining{}, .k0 = 0.5};
  const Measured sign =
      study.measure(flat, [](const Outcome& o) { return o.moment_near(90 * degree); });
  section.findings.push_back({"PF-086", agrees_if(sign.mean() < 0),
                              "K0 = 0.5 pushes the crown in: moment there " +
                                  sign.text(1e-3, "kN m/m", 2) + " (tension outside positive)"});
  return section;
}

}  // namespace voussoir::paper
