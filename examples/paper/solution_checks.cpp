// SPDX-License-Identifier: MIT
// What the answer depends on besides the design: nodes, domain, tolerance, method, realisation.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

Section solution_checks(Study& study) {
  Section section{
      "solution_checks",
      "Solution checks",
      "",
      {"The design case (4 m bolts at 15°, 10 cm of lining), one thing of the computation changed at "
       "a time; means over the realisations, ± the standard deviation between them. Another domain is "
       "another realisation of the rock: differences below that deviation mean nothing there. In the "
       "other rows the rock is the same, and differences are those of the computation.",
       "The crown's convergence depends on the depth of the base: the whole tunnel rises with the "
       "rock that is relieved of its weight. What the tunnel closes, crown and invert together, "
       "does not."}};
  const Variant design{.bolts = Bolts{}, .lining = Lining{}};
  std::vector<std::pair<std::string, Variant>> rows{
      {"as it is: 72 nodes, 70 m wide, 30 m below, tolerance 1.0e-03", design}};
  const auto changed = [&](std::string name, const auto& change) {
    Variant variant = design;
    change(variant);
    rows.emplace_back(std::move(name), variant);
  };
  for (const int nodes : {24, 36, 48, 108, 144})
    changed(std::to_string(nodes) + " nodes", [&](Variant& v) { v.lining->nodes = nodes; });
  const std::vector<Extent> extents{{50, 20}, {110, 50}, {150, 70}};
  for (const Extent& extent : extents)
    changed(
        trimmed_text(extent.width, 1) + " m wide, " + trimmed_text(extent.below, 1) + " m below",
        [&](Variant& v) { v.extent = extent; });
  for (const double tolerance : {1e-2, 1e-4, 1e-6})
    changed("tolerance " + power_text(tolerance), [&](Variant& v) { v.tolerance = tolerance; });
  changed("explicit stepping, excavated over 8000 steps",
          [](Variant& v) { v.way = Way::slow_explicit; });
  std::vector<Variant> variants;
  for (const auto& [name, variant] : rows) variants.push_back(variant);
  study.prepare(variants);

  const auto closes = [](const Outcome& o) { return o.convergence.crown + o.convergence.invert; };
  Table table{"The design case, one thing changed at a time",
              {"", "crown, mm", "crown + invert, mm", "mean thrust, kN/m", "largest moment, kN m/m",
               "mean bolt force, kN", "worst error estimate"},
              {}};
  for (const auto& [name, variant] : rows) {
    const auto cell = [&, &v = variant](const Quantity& quantity, double scale, int digits) {
      const Measured m = study.measure(v, quantity);
      if (m.values.empty()) return std::string("none stands");
      return printed_text(scale * m.mean(), digits) + " ± " +
             printed_text(scale * m.deviation(), 2) +
             (m.complete() ? "" : " (" + std::to_string(m.collapsed) + " collapsed)");
    };
    double worst = 0;
    for (const Outcome& o : study.of(variant)) worst = std::max(worst, o.report.error_estimate);
    table.rows.push_back({name, cell(crown, 1e3, 4), cell(closes, 1e3, 4),
                          cell([](const Outcome& o) { return o.mean_thrust(); }, 1e-3, 4),
                          cell([](const Outcome& o) { return o.largest_moment(); }, 1e-3, 3),
                          cell([](const Outcome& o) { return o.mean_force(); }, 1e-3, 4),
                          variant.way == Way::quasi_static ? power_text(worst) : "none"});
  }
  section.tables.push_back(table);

  const auto by_nodes = [&](double nodes) {
    Variant v = design;
    v.lining->nodes = static_cast<int>(nodes);
    return v;
  };
  const auto by_base = [&](double depth) {
    Variant v = design;
    for (const Extent& extent : extents)
      if (extent.below == depth) v.extent = extent;
    return v;
  };
  const std::vector<double> nodes{24, 36, 48, 72, 108, 144}, bases{20, 30, 50, 70};
  Plot moment{
      "solution_nodes", "Largest moment of the ring", "nodes around the ring", "|M|, kN m/m", {}};
  draw(moment, swept(
                   study, "blocks, largest |M|", nodes, by_nodes,
                   [](const Outcome& o) { return o.largest_moment(); }, 1e-3));
  Plot base{"solution_base",
            "Convergence and the depth of the base",
            "rock below the invert, m",
            "convergence, mm",
            {}};
  draw(base, swept(study, "crown", bases, by_base, crown, 1e3));
  draw(base, swept(study, "crown and invert", bases, by_base, closes, 1e3));
  moment.caption = "Joints are 0.62 m apart, nodes 1.31 m to 0.22 m.";
  base.caption = "The wider domains are other realisations of the rock.";
  moment.y_range = base.y_range = {{0, NAN}};
  section.plots = {moment, base};
  return section;
}

}  // namespace voussoir::paper
