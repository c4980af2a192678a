// SPDX-License-Identifier: MIT
// Thrust of a lining without bolts against theory, and the stiffness of its interface: Figs 19, 20.
#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

namespace {

Variant lined(double interface, double thickness = 0.1) {
  return {.lining = Lining{.thickness = thickness, .interface_stiffness = interface}};
}

}  // namespace

Section lining_thrust(Study& study) {
  Section section{"lining_thrust",
                  "Thrust of the lining and stiffness of its interface",
                  "7.1, eq. (13), Figs 19 and 20",
                  {"A ring of 10 cm without bolts; the paper does not print the thickness of these "
                   "runs. The interface carries K_L per area, normal and tangential, with 30° of "
                   "friction and no tension. Elastic: eq. (13)."}};
  const std::vector<double> stiffnesses{1e6, 1e7, 1e8, 1e9, 1e10}, printed{1e6, 1e8, 1e9};
  const auto mean_thrust = [](const Outcome& o) { return o.mean_thrust(); };
  const auto at = [](double k) { return lined(k); };
  const auto sudden_at = [](double k) { return lined(k).as_the_paper(); };
  const Swept mean =
      swept(study, "blocks, mean over the ring", stiffnesses, at, mean_thrust, 1 / force_unit);
  const Swept sudden =
      swept(study, "mean, as the paper ran it", printed, sudden_at, mean_thrust, 1 / force_unit);
  Plot by_stiffness{"lining_thrust_interface",
                    "Mean thrust, t = 10 cm",
                    "interface stiffness K_L, Pa/m",
                    "N / (p_0 D)",
                    {}};
  by_stiffness.logarithmic_x = true;
  by_stiffness.y_range = {{0, NAN}};
  for (const NamedGround& g : elastic_grounds()) {
    Series line{std::string("eq. (13), ") + g.name, Mark::line, {}, {}};
    for (double e = 5.8; e <= 10.3; e += 0.1) {
      const double k = std::pow(10, e);
      line.x.push_back(k);
      line.y.push_back(thin_lining(thin({.thickness = 0.1, .interface_stiffness = k}),
                                   ground_pressure, g.ground.shear_modulus)
                           .thrust /
                       force_unit);
    }
    by_stiffness.series.push_back(line);
  }
  for (const Swept* s : {&mean, &sudden}) draw(by_stiffness, *s);

  Plot around{"lining_thrust_around",
              "Thrust around the ring: mean and standard deviation",
              "angle from the right-hand springing, degrees",
              "N / (p_0 D)",
              {}};
  for (const auto& [k, name] :
       {std::pair(1e6, "K_L = 1 MPa/m"), {1e8, "0.1 GPa/m"}, {1e9, "1 GPa/m"}}) {
    Series s{name, Mark::line, {}, {}};
    for (double angle = 0; angle <= 360; angle += 10) {
      const Measured m =
          study.measure(at(k), [&](const Outcome& o) { return o.thrust_near(angle * degree); });
      if (m.values.empty()) continue;
      s.x.push_back(angle);
      s.y.push_back(m.mean() / force_unit);
      s.spread.push_back(m.deviation() / force_unit);
    }
    around.series.push_back(s);
  }
  say_collapsed(around, study,
                {{"1 MPa/m", at(1e6)}, {"0.1 GPa/m", at(1e8)}, {"1 GPa/m", at(1e9)}});
  around.x_range = {{0, 360}};
  around.y_range = {{0, NAN}};
  section.plots = {by_stiffness, around};

  // ---- findings ----
  const std::size_t nodes = study.of(at(1e9)).front().lining.size();
  section.findings.push_back(
      {"PF-078", agrees_if(nodes > 41),
       std::to_string(nodes) + " nodes, " +
           printed_text(2 * std::numbers::pi * radius / static_cast<double>(nodes), 3) +
           " m apart; E_L = 25 GPa, K_L = 1 GPa/m, 30° of friction. Nodes have no mass at rest; in "
           "motion they have (docs/theory.md)."});
  const ThinLining ring = thin({.thickness = 0.1});
  const double g = elastic_grounds()[2].ground.shear_modulus, t = ring.thickness;
  const double by_eq13 =
      ground_pressure * lining_modulus * t * interface_stiffness * radius /
      (2 * interface_stiffness * g * radius + 2 * lining_modulus * t * g / radius +
       lining_modulus * t * interface_stiffness);
  const double in_series = thin_lining(ring, ground_pressure, g).thrust;
  section.findings.push_back(
      {"PF-079", agrees_if(std::abs(in_series / by_eq13 - 1) < 1e-12),
       "three flexibilities in series give " + printed_text(1e-3 * in_series, 6) +
           " kN/m, eq. (13) as printed " + printed_text(1e-3 * by_eq13, 6) + " kN/m (G3, 10 cm)"});
  section.findings.push_back(
      {"PF-080",
       agrees_if(mean.measured[0].complete() && mean.measured[2].complete() &&
                 mean.measured[3].complete()),
       "run at 1 MPa/m, 0.1 GPa/m and 1 GPa/m with t = 10 cm: mean "
       "thrust " +
           means({mean.measured[0], mean.measured[2], mean.measured[3]}, 1e-3, "kN/m")});
  section.findings.push_back(
      {"PF-081", agrees_if(rises(mean.measured)),
       "mean thrust " + means(mean.measured, 1e-3, "kN/m") + " for 1 MPa/m to 10 GPa/m", "",
       means(sudden.measured, 1e-3, "kN/m") + " for the paper's three",
       sudden.measured[0].values.empty() ? Agreement::not_testable
                                         : agrees_if(rises(sudden.measured))});
  const auto elastic = [&](std::size_t which, double k) {
    return thin_lining(thin({.thickness = 0.1, .interface_stiffness = k}), ground_pressure,
                       elastic_grounds()[which].ground.shear_modulus)
        .thrust;
  };
  const auto between = [&](const Measured& m) {
    return m.mean() > elastic(1, 1e9) && m.mean() < elastic(0, 1e9);
  };
  section.findings.push_back(
      {"PF-082", agrees_if(between(mean.measured[3])),
       "mean thrust " + mean.measured[3].text(1e-3, "kN/m") + "; elastic G2 " +
           printed_text(1e-3 * elastic(1, 1e9)) + ", G1 " + printed_text(1e-3 * elastic(0, 1e9)),
       "", sudden.measured[2].text(1e-3, "kN/m"), agrees_if(between(sudden.measured[2]))});
  const Measured& soft = mean.measured[0];
  const bool more = soft.mean() > elastic(0, 1e6);
  section.findings.push_back(
      {"PF-083", agrees_if(more),
       "mean thrust at 1 MPa/m " + soft.text(1e-3, "kN/m") + "; elastic G1 " +
           printed_text(1e-3 * elastic(0, 1e6)),
       more ? "" : "a soft ring holds little, and the rock behind it comes loose",
       sudden.measured[0].text(1e-3, "kN/m"),
       sudden.measured[0].values.empty() ? Agreement::not_testable
                                         : agrees_if(sudden.measured[0].mean() > elastic(0, 1e6))});
  return section;
}

}  // namespace voussoir::paper
