// SPDX-License-Identifier: MIT
// Length and spacing of bolts: Figs 9, 12 and 13.
#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

namespace {

Variant bolted(double spacing, double length = 4) {
  return {.bolts = Bolts{.length = length, .spacing = spacing * degree}};
}

}  // namespace

Section bolt_spacing(Study& study) {
  Section section{
      "bolt_spacing",
      "Length and spacing of bolts",
      "5.2, Figs 7, 9, 12 and 13",
      {"The four trials of the paper (7 m at 11.25°, then 4 m at 11.25°, 15° and "
       "22.5°), and the unsupported opening. Blocks that move by more than 20 mm are detached: "
       "they are taken out and counted."}};
  const std::vector<double> spacings{9, 11.25, 12.86, 15, 18, 22.5, 30};
  const auto at = [](double s) { return bolted(s); };
  const auto sudden_at = [](double s) { return bolted(s).as_the_paper(); };
  const std::vector<double> printed{11.25, 15, 22.5};
  const Variant reference{.bolts = reference_bolts}, bare{};
  study.prepare({reference, bare, reference.as_the_paper(), bare.as_the_paper()});
  const auto largest = [](const Outcome& o) { return o.largest_force(); };
  const auto mean_force = [](const Outcome& o) { return o.mean_force(); };

  const Swept u = swept(study, "blocks, crown", spacings, at, crown, 1e3);
  const Swept u_sudden = swept(study, "crown, as the paper ran it", printed, sudden_at, crown, 1e3);
  const Swept f =
      swept(study, "blocks, mean of the bolts' largest", spacings, at, mean_force, 1 / force_unit);
  const Swept f_top = swept(study, "blocks, largest", spacings, at, largest, 1 / force_unit);
  const Swept f_sudden =
      swept(study, "mean, as the paper ran it", printed, sudden_at, mean_force, 1 / force_unit);
  Plot crown_plot{"bolt_spacing_crown",
                  "Crown convergence, 4 m bolts",
                  "bolt spacing θ_b, degrees",
                  "convergence, mm",
                  {}};
  Plot force_plot{"bolt_spacing_force",
                  "Bolt forces, 4 m bolts",
                  "bolt spacing θ_b, degrees",
                  "F / (p_0 D)",
                  {}};
  for (const NamedGround& g : elastic_grounds()) {
    Series lines[2] = {{std::string("elastic, ") + g.name, Mark::line, {}, {}},
                       {std::string("elastic at the wall, ") + g.name, Mark::line, {}, {}}};
    for (double s = 8; s <= 31; s += 0.5) {
      const SmearedBolts theory(smeared({.spacing = s * degree}), g.ground, ground_pressure);
      lines[0].x.push_back(s);
      lines[1].x.push_back(s);
      lines[0].y.push_back(1e3 * theory.convergence());
      lines[1].y.push_back(theory.bolt_force(radius) / force_unit);
    }
    crown_plot.series.push_back(lines[0]);
    force_plot.series.push_back(lines[1]);
  }
  for (const Swept* s : {&u, &u_sudden}) draw(crown_plot, *s);
  for (const Swept* s : {&f, &f_top, &f_sudden}) draw(force_plot, *s);
  crown_plot.y_range = force_plot.y_range = {{0, NAN}};

  // Rock that falls, realisation by realisation.
  const auto fallen = [&](const Variant& v) {
    Measured m;
    for (const Outcome& o : study.of(v)) {
      ++m.samples;
      m.values.push_back(o.fallen());  // of those that collapsed too
      m.shedding += o.sheds();
    }
    return m;
  };
  Series shed{"detached rock, mean of all realisations", Mark::linked_points, {}, {}, {}};
  for (const double s : spacings) {
    const Measured m = fallen(bolted(s));
    shed.x.push_back(s);
    shed.y.push_back(m.mean());
    shed.spread.push_back(m.deviation());
  }
  Plot shed_plot{"bolt_spacing_fallen",
                 "Detached rock between 4 m bolts",
                 "bolt spacing θ_b, degrees",
                 "m² of section",
                 {shed}};
  shed_plot.y_range = {{0, NAN}};
  section.plots = {crown_plot, force_plot, shed_plot};

  Table table{"The trials",
              {"support", "crown, mm", "F / (p0 D), mean of largest", "largest, kN",
               "detached rock, m² by realisation", "stable"},
              {}};
  const auto row = [&](const std::string& name, const Variant& v) {
    std::string by_sample;
    int stable = 0;
    for (const Outcome& o : study.of(v)) {
      by_sample += (by_sample.empty() ? "" : ", ") + printed_text(o.fallen(), 2);
      stable += o.stable();
    }
    const bool bolts = v.bolts.has_value();
    table.rows.push_back({name, study.measure(v, crown).text(1e3, ""),
                          bolts ? study.measure(v, mean_force).text(1 / force_unit, "") : "",
                          bolts ? study.measure(v, largest).text(1e-3, "") : "", by_sample,
                          std::to_string(stable) + " of " + std::to_string(study.samples())});
  };
  row("none", bare);
  row("7 m, 11.25°", reference);
  for (const double s : printed) row("4 m, " + printed_text(s, 4) + "°", bolted(s));
  row("7 m, 22.5°", bolted(22.5, 7));
  section.tables.push_back(table);

  // ---- findings ----
  const auto count = [&](const Variant& v) { return study.of(v).front().bolts.size(); };
  section.findings.push_back({"PF-037", agrees_if(count(reference) == 21),
                              std::to_string(count(reference)) + " bolts from −22.5° to 202.5°"});
  section.findings.push_back(
      {"PF-038",
       agrees_if(count(bolted(11.25)) == 17 && count(bolted(15)) == 13 && count(bolted(22.5)) == 9),
       std::to_string(count(bolted(11.25))) + ", " + std::to_string(count(bolted(15))) + ", " +
           std::to_string(count(bolted(22.5))) +
           " bolts from springing to springing at 11.25°, 15°, 22.5°"});
  const auto m = [&](double s) { return study.measure(bolted(s), crown).mean(); };
  const double first = m(15) - m(11.25), second = m(22.5) - m(15);
  const auto ms = [&](double s) { return study.measure(sudden_at(s), crown).mean(); };
  const double steps = second / first;
  const double sudden_first = ms(15) - ms(11.25), sudden_second = ms(22.5) - ms(15);
  const auto change = [](double metres) {
    return (metres < 0 ? "" : "+") + printed_text(1e3 * metres);
  };
  section.findings.push_back(
      {"PF-057", agrees_if(first > 0 && steps > 2),
       "crown " + change(first) + " mm from 11.25° to 15°, " + change(second) +
           " mm from 15° to 22.5°: ratio " + printed_text(steps, 2),
       first > 0 && steps > 2
           ? ""
           : "Quasi-statically the crown follows the loosened blocks only a little; what 22.5° does "
             "not hold falls, and counts no longer in the crown's convergence. The overshoot of a "
             "sudden excavation makes the difference.",
       change(sudden_first) + ", " + change(sudden_second) + " mm",
       agrees_if(sudden_first > 0 && sudden_second > 2 * sudden_first)});
  const Measured lost11 = fallen(bolted(11.25)), lost15 = fallen(bolted(15)),
                 lost22 = fallen(bolted(22.5));
  const bool ravels =
      lost22.mean() > 0 && lost22.mean() > 2 * lost15.mean() && lost22.shedding > lost15.shedding;
  section.findings.push_back(
      {"PF-058", agrees_if(ravels),
       "detached rock: " + printed_text(lost11.mean(), 2) + ", " + printed_text(lost15.mean(), 2) +
           ", " + printed_text(lost22.mean(), 2) + " m² at 11.25°, 15°, 22.5°, in " +
           std::to_string(lost11.shedding) + ", " + std::to_string(lost15.shedding) + ", " +
           std::to_string(lost22.shedding) + " of " + std::to_string(study.samples()) +
           " realisations",
       ravels ? "" : "the realisations shed about as much at both spacings"});
  const std::vector<Measured> crowns{study.measure(bolted(11.25), crown),
                                     study.measure(bolted(15), crown),
                                     study.measure(bolted(22.5), crown)};
  const auto crown_force = [](const Outcome& o) {
    double most = 0;
    for (const BoltOutcome& b : o.bolts)
      if (std::abs(b.angle - 90 * degree) < 23 * degree) most = std::max(most, b.largest);
    return most;
  };
  const std::vector<Measured> crown_forces{study.measure(bolted(11.25), crown_force),
                                           study.measure(bolted(15), crown_force),
                                           study.measure(bolted(22.5), crown_force)};
  std::vector<Measured> sudden_crowns, sudden_forces;
  for (const double spacing : printed) {
    sudden_crowns.push_back(study.measure(sudden_at(spacing), crown));
    sudden_forces.push_back(study.measure(sudden_at(spacing), crown_force));
  }
  section.findings.push_back(
      {"PF-059", agrees_if(rises(crowns) && rises(crown_forces)),
       "crown " + means(crowns, 1e3, "mm") + "; largest bolt force within 22.5° of the crown " +
           means(crown_forces, 1e-3, "kN"),
       rises(crowns) && rises(crown_forces)
           ? ""
           : "The crown does; the largest force near it depends on which joints the few bolts there "
             "cross, and fewer bolts offer fewer chances of a large one.",
       "crown " + means(sudden_crowns, 1e3, "mm") + ", " + means(sudden_forces, 1e-3, "kN"),
       agrees_if(rises(sudden_crowns) && rises(sudden_forces))});
  const Measured design = study.measure(bolted(15), largest);
  bool suitable = design.complete();
  for (const double force : design.values) suitable = suitable && force < bolt_strength;
  section.findings.push_back({"PF-065", agrees_if(suitable),
                              "largest force " + design.text(1e-3, "kN") +
                                  " of 500 kN; detached rock " + printed_text(lost15.mean(), 2) +
                                  " m² on average",
                              suitable ? "" : "not every realisation stands below the strength"});
  const Measured longer = ratio(study, bolted(22.5), bolted(22.5, 7), crown);
  section.findings.push_back({"PF-066", agrees_if(std::abs(longer.mean() - 1) < 0.1),
                              "crown with 7 m over crown with 4 m: " + longer.text(1, "", 3)});
  return section;
}

}  // namespace voussoir::paper
