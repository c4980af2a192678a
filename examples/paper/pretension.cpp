// SPDX-License-Identifier: MIT
// Pretension of bolts: Figs 15 to 17.
#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

namespace {

Variant tensioned(double force, double spacing) {
  return {.bolts = Bolts{.spacing = spacing * degree, .pretension = force}};
}

}  // namespace

Section pretension(Study& study) {
  Section section{"pretension",
                  "Pretension of bolts",
                  "5.2, Figs 15 to 17",
                  {"4 m bolts that are tensioned when they are installed, at 15° and at 22.5°."}};
  const std::vector<double> forces{0, 50, 100, 150};
  const auto at15 = [](double kn) { return tensioned(1e3 * kn, 15); };
  const auto at22 = [](double kn) { return tensioned(1e3 * kn, 22.5); };
  const auto mean_wall = [](const Outcome& o) { return o.mean_convergence; };
  const auto mean_force = [](const Outcome& o) { return o.mean_force(); };
  const auto largest = [](const Outcome& o) { return o.largest_force(); };
  const auto uneven = [](const Outcome& o) { return std::abs(crown(o) - springing(o)); };

  const Swept wall = swept(study, "mean of the upper wall, 15°", forces, at15, mean_wall, 1e3);
  const Swept top = swept(study, "crown, 15°", forces, at15, crown, 1e3);
  const Swept sides = swept(study, "springings, 15°", forces, at15, springing, 1e3);
  const Swept top22 = swept(study, "crown, 22.5°", forces, at22, crown, 1e3);
  const Swept mean15 =
      swept(study, "mean of the bolts' largest, 15°", forces, at15, mean_force, 1e-3);
  const Swept most15 = swept(study, "largest, 15°", forces, at15, largest, 1e-3);
  const Swept mean22 =
      swept(study, "mean of the bolts' largest, 22.5°", forces, at22, mean_force, 1e-3);
  Plot u{
      "pretension_wall", "Convergence under pretension", "pretension, kN", "convergence, mm", {}};
  Plot f{"pretension_force", "Bolt forces under pretension", "pretension, kN", "force, kN", {}};
  for (const Swept* s : {&wall, &top, &sides, &top22}) draw(u, *s);
  for (const Swept* s : {&mean15, &most15, &mean22}) draw(f, *s);
  u.y_range = f.y_range = {{0, NAN}};
  section.plots = {u, f};

  const Measured change = ratio(study, at15(0), at15(150), mean_wall);
  section.findings.push_back(
      {"PF-062", agrees_if(falls(wall.measured) && change.mean() > 0.8),
       "mean convergence of the upper wall " + means(wall.measured, 1e3, "mm") +
           " for 0, 50, 100, 150 kN: " + percent(change.mean() - 1) + " at 150 kN",
       falls(wall.measured) && change.mean() > 0.8 ? "" : "the change is larger or not monotonic"});
  const std::vector<Measured> apart{study.measure(at15(0), uneven),
                                    study.measure(at15(100), uneven),
                                    study.measure(at15(150), uneven)};
  section.findings.push_back(
      {"PF-063", agrees_if(falls(apart)),
       "|crown − springings| " + means(apart, 1e3, "mm") + " for 0, 100, 150 kN",
       falls(apart)
           ? ""
           : "Differences of some hundredths of a millimetre: the unevenness comes from single "
             "loose blocks, and pretension pulls crown and springings alike."});
  section.findings.push_back({"PF-064", agrees_if(rises(mean15.measured) && rises(most15.measured)),
                              "mean " + means(mean15.measured, 1e-3, "kN") + ", largest " +
                                  means(most15.measured, 1e-3, "kN")});
  const Measured less = ratio(study, at22(0), at22(150), crown);
  const Measured more = paired(study, at22(0), at22(150), [&](const Outcome& a, const Outcome& b) {
    return b.mean_force() - a.mean_force();
  });
  section.findings.push_back(
      {"PF-067", agrees_if(less.mean() < 1 && more.mean() > 0.3 * 150e3),
       "crown × " + less.text(1, "", 3) + ", mean bolt force +" + more.text(1e-3, "kN", 3)});
  double lost = 0, lost0 = 0;
  int shedding = 0;
  for (const Outcome& o : study.of(at22(150))) {
    lost += o.fallen() / study.samples();
    shedding += o.sheds();
  }
  for (const Outcome& o : study.of(at22(0))) lost0 += o.fallen() / study.samples();
  section.findings.push_back({"PF-068", agrees_if(shedding > 0),
                              "detached rock with 150 kN: " + printed_text(lost, 2) +
                                  " m² on average (" + printed_text(lost0, 2) + " without), in " +
                                  std::to_string(shedding) + " of " +
                                  std::to_string(study.samples()) + " realisations"});
  return section;
}

}  // namespace voussoir::paper
