// SPDX-License-Identifier: MIT
// Bolt forces along the radius against elastic ground with smeared bolts: Figs 8 and 11.
#include <algorithm>
#include <cmath>
#include <map>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

namespace {

struct Pattern {
  const char* name;
  const char* title;
  Bolts bolts;
};
const std::vector<Pattern>& patterns() {
  static const std::vector<Pattern> all{
      {"bolt_forces_11", "7 m bolts, 11.25°", reference_bolts},
      {"bolt_forces_15", "4 m bolts, 15°", {.length = 4, .spacing = 15 * degree}},
      {"bolt_forces_22", "4 m bolts, 22.5°", {.length = 4, .spacing = 22.5 * degree}}};
  return all;
}

/// Forces of all bolts of all realisations in classes of r/a of 0.1, as in the paper.
struct Binned {
  std::vector<double> r, force, spread;
};
Binned binned(const std::vector<Outcome>& outcomes) {
  std::map<int, std::vector<double>> classes;
  for (const Outcome& o : outcomes)
    if (o.stable())
      for (const BoltOutcome& bolt : o.bolts)
        for (const auto& c : bolt.crossings)
          classes[static_cast<int>(std::floor((c.distance / radius - 1) / 0.1 + 1e-9))].push_back(
              c.force / force_unit);
  Binned b;
  for (const auto& [k, forces] : classes) {
    const Measured m{.values = forces};
    b.r.push_back(1 + 0.1 * (k + 0.5));
    b.force.push_back(m.mean());
    b.spread.push_back(m.deviation());
  }
  return b;
}
/// Root mean square of ln(F / F_elastic) with G3, over the classes.
double misfit_of(const Binned& b, const Bolts& bolts) {
  const SmearedBolts theory(smeared(bolts), elastic_grounds()[2].ground, ground_pressure);
  double squares = 0;
  int count = 0;
  for (std::size_t k = 0; k < b.r.size(); ++k) {
    const double r = b.r[k] * radius;
    if (r > radius + bolts.length || !(b.force[k] > 0)) continue;
    const double l = std::log(b.force[k] * force_unit / theory.bolt_force(r));
    squares += l * l;
    ++count;
  }
  return std::sqrt(squares / std::max(count, 1));
}
double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v / static_cast<double>(values.size());
  return sum;
}

}  // namespace

Section bolt_forces(Study& study) {
  Section section{"bolt_forces",
                  "Bolt forces along the radius against elastic theory",
                  "5.1, 5.2, Figs 8 and 11",
                  {"Forces at all joints that the bolts cross, averaged in classes of r/a of 0.1 "
                   "over all bolts and realisations, against ground and smeared bolts in elastic "
                   "equilibrium, for the three moduli of Table 3. Forces are divided by p0 D for "
                   "bolts one metre apart along the tunnel."}};
  std::vector<Variant> variants;
  for (const Pattern& p : patterns()) {
    variants.push_back({.bolts = p.bolts});
    variants.push_back(Variant{.bolts = p.bolts}.as_the_paper());
  }
  study.prepare(variants);
  Table table{"Dimensionless bolt stiffness and elastic force at the wall",
              {"pattern", "modulus", "beta", "wall moves, mm", "F / (p0 D) at the wall"},
              {}};
  std::vector<double> misfit, misfit_sudden;
  for (const Pattern& p : patterns()) {
    const Variant variant{.bolts = p.bolts};
    const Binned quasi = binned(study.of(variant));
    const Binned sudden = binned(study.of(variant.as_the_paper()));
    Plot plot{p.name, p.title, "r/a", "F / (p_0 D)", {}};
    std::vector<double> axis;
    for (double x = 1; x <= 1 + p.bolts.length / radius + 1e-9; x += 0.05) axis.push_back(x);
    for (const NamedGround& g : elastic_grounds()) {
      const SmearedBolts theory(smeared(p.bolts), g.ground, ground_pressure);
      Series line{std::string("elastic, ") + g.name, Mark::line, axis, {}};
      for (const double x : axis)
        line.y.push_back(theory.bolt_force(std::min(x * radius, radius + p.bolts.length)) /
                         force_unit);
      plot.series.push_back(line);
      table.rows.push_back({p.title, g.name, printed_text(theory.beta(), 4),
                            printed_text(1e3 * theory.convergence(), 4),
                            printed_text(theory.bolt_force(radius) / force_unit, 4)});
    }
    plot.series.push_back({"blocks, quasi-static", Mark::linked_points, quasi.r, quasi.force});
    plot.series.push_back(
        {"blocks, as the paper ran it", Mark::linked_points, sudden.r, sudden.force});
    plot.y_range = {{0, 0.05}};
    plot.caption =
        "Mean over bolts and " + std::to_string(study.samples()) +
        " realisations in each class. The elastic force is largest at the wall; that of the "
        "blocks rises first, for a joint near the wall has little rock before it to "
        "hold.";
    say_collapsed(plot, study,
                  {{"quasi-static", variant}, {"as the paper ran it", variant.as_the_paper()}});
    misfit.push_back(misfit_of(quasi, p.bolts));
    misfit_sudden.push_back(misfit_of(sudden, p.bolts));
    section.plots.push_back(std::move(plot));
  }
  section.tables.push_back(std::move(table));

  const Variant reference{.bolts = reference_bolts};
  const double beta = SmearedBolts(smeared(reference_bolts), elastic_grounds()[0].ground, 1).beta();
  const double beta15 = SmearedBolts(smeared({}), elastic_grounds()[0].ground, 1).beta();
  const double beta22 =
      SmearedBolts(smeared({.spacing = 22.5 * degree}), elastic_grounds()[0].ground, 1).beta();
  section.findings.push_back(
      {"PF-049",
       agrees_if(std::abs(beta - 0.203718) < 1e-6 && std::abs(beta15 - 0.152789) < 1e-6 &&
                 std::abs(beta22 - 0.101859) < 1e-6),
       "beta = " + printed_text(beta, 6) + ", " + printed_text(beta15, 6) + ", " +
           printed_text(beta22, 6) + " (G1; 11.25°, 15°, 22.5°)"});
  const Binned quasi = binned(study.of(reference));
  const Binned sudden = binned(study.of(reference.as_the_paper()));
  const auto within_bolt = [](const Binned& b) {
    std::vector<double> forces;
    for (std::size_t k = 0; k < b.r.size(); ++k)
      if (b.r[k] < 2.4) forces.push_back(b.force[k]);
    return mean_of(forces);
  };
  const auto elastic_mean = [&](int g) {
    const SmearedBolts s(smeared(reference_bolts),
                         elastic_grounds()[static_cast<std::size_t>(g)].ground, ground_pressure);
    std::vector<double> forces;
    for (double x = 1.05; x < 2.4; x += 0.1)
      forces.push_back(s.bolt_force(x * radius) / force_unit);
    return mean_of(forces);
  };
  const double band_low = elastic_mean(1), band_high = elastic_mean(0);
  const auto in_band = [&](double f) { return f > 0.5 * band_low && f < 2 * band_high; };
  section.findings.push_back(
      {"PF-050", agrees_if(in_band(within_bolt(quasi))),
       "mean over 1 < r/a < 2.4: " + printed_text(within_bolt(quasi)) +
           " p0 D; elastic G2 to G1: " + printed_text(band_low) + " to " + printed_text(band_high),
       in_band(within_bolt(quasi)) ? "" : "outside twice the elastic band",
       printed_text(within_bolt(sudden)) + " p0 D", agrees_if(in_band(within_bolt(sudden)))});
  const auto grows = [](const std::vector<double>& m) { return m[0] < m[1] && m[1] < m[2]; };
  const auto listed = [](const std::vector<double>& m) {
    return printed_text(m[0], 2) + ", " + printed_text(m[1], 2) + ", " + printed_text(m[2], 2);
  };
  section.findings.push_back(
      {"PF-051", agrees_if(grows(misfit)),
       "root mean square of ln(F / F_elastic(G3)): " + listed(misfit) + " for 11.25°, 15°, 22.5°",
       grows(misfit)
           ? ""
           : "Quasi-statically bolts of every spacing follow elastic ground within some "
             "15 %: what they carry besides is loosened ground, which a sudden excavation "
             "makes more of the wider they are apart.",
       listed(misfit_sudden), agrees_if(grows(misfit_sudden))});
  const auto peak = [](const Binned& b) {
    return b.r[static_cast<std::size_t>(std::max_element(b.force.begin(), b.force.end()) -
                                        b.force.begin())];
  };
  const auto last_part = [](const Binned& b) {
    return b.force.back() / *std::max_element(b.force.begin(), b.force.end());
  };
  const auto peak_text = [&](const Binned& b) {
    return "largest mean at r/a = " + printed_text(peak(b)) + ", at the last class " +
           printed_text(last_part(b), 2) + " of it";
  };
  const auto near_wall = [&](const Binned& b) { return peak(b) < 1.5 && last_part(b) < 0.5; };
  section.findings.push_back({"PF-052", agrees_if(near_wall(quasi)), peak_text(quasi), "",
                              peak_text(sudden), agrees_if(near_wall(sudden))});
  const auto slope = [](const Binned& b, double from, double to) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t k = 0; k < b.r.size(); ++k) {
      if (b.r[k] < from || b.r[k] > to) continue;
      ++n;
      sx += b.r[k];
      sy += b.force[k];
      sxx += b.r[k] * b.r[k];
      sxy += b.r[k] * b.force[k];
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
  };
  const double near = slope(quasi, 1, 1.8), far = slope(quasi, 1.8, 2.4);
  section.findings.push_back(
      {"PF-053", agrees_if(std::abs(far) < 0.5 * std::abs(near)),
       "slope of F / (p0 D) over r/a: " + printed_text(far) + " beyond 1.8, " + printed_text(near) +
           " before",
       std::abs(far) < 0.5 * std::abs(near) ? "" : "Forces go on falling, as in elastic ground."});
  const Measured scatter = study.measure(reference, [](const Outcome& o) {
    const Measured m{.values = o.largest_forces()};
    return m.deviation() / m.mean();
  });
  const Measured scatter_sudden = study.measure(reference.as_the_paper(), [](const Outcome& o) {
    const Measured m{.values = o.largest_forces()};
    return m.deviation() / m.mean();
  });
  section.findings.push_back({"PF-054", agrees_if(scatter.mean() > 0.15),
                              "coefficient of variation over bolts " + scatter.text(1, "", 2), "",
                              scatter_sudden.text(1, "", 2),
                              agrees_if(scatter_sudden.mean() > 0.15)});
  return section;
}

}  // namespace voussoir::paper
