// SPDX-License-Identifier: MIT
// The scatter of bolt forces, and what it says about a design: section 6, Fig. 18.
#include <voussoir/statistics/confidence.hpp>
#include <voussoir/statistics/distribution_fit.hpp>
#include <voussoir/statistics/goodness_of_fit.hpp>
#include <voussoir/statistics/histogram.hpp>
#include <voussoir/statistics/normal_update.hpp>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

namespace {

Sample normalised(const std::vector<const Outcome*>& outcomes) {
  std::vector<double> values;
  for (const Outcome* o : outcomes)
    for (const double f : o->largest_forces()) values.push_back(f / force_unit);
  return Sample(std::move(values));
}
std::string summary(const Sample& s) {
  return printed_text(s.mean(), 3) + " ± " + printed_text(s.deviation(), 2);
}
double distance_to_normal(const Sample& s) {
  const NormalFit fit = fit_normal(s);
  return kolmogorov_smirnov(s, [&](double x) { return fit.probability_below(x); });
}

}  // namespace

Section force_histograms(Study& study) {
  Section section{
      "force_histograms",
      "Scatter of bolt forces",
      "6, Fig. 18",
      {"The largest force of each of the 21 bolts of the reference pattern, F / (p0 D), "
       "in each realisation of the rock and in all together; normal distributions fitted to "
       "the raw data. The paper has three realisations, A, B and C."}};
  const Variant reference{.bolts = reference_bolts};
  study.prepare({reference, reference.as_the_paper()});
  std::vector<const Outcome*> quasi, sudden;
  for (const Outcome& o : study.of(reference))
    if (o.stable()) quasi.push_back(&o);
  for (const Outcome& o : study.of(reference.as_the_paper()))
    if (o.stable()) sudden.push_back(&o);
  if (const std::string gone = collapsed_text(
          study, {{"quasi-static", reference}, {"as the paper ran it", reference.as_the_paper()}});
      !gone.empty())
    section.text.push_back(gone);
  if (quasi.empty() || sudden.empty()) {
    section.text.push_back("No realisation stands: there is nothing to fit.");
    for (const char* id :
         {"PF-069", "PF-070", "PF-071", "PF-072", "PF-073", "PF-074", "PF-075", "PF-076", "PF-077"})
      section.findings.push_back(
          {id, Agreement::not_testable, "no realisation stands", "see above"});
    return section;
  }
  const Sample all = normalised(quasi), all_sudden = normalised(sudden);
  for (const auto& [name, title, sample] :
       {std::tuple("histogram", "All realisations, quasi-static", &all),
        std::tuple("histogram_explicit", "All realisations, as the paper ran it", &all_sudden)}) {
    const double top = 0.08;
    const double high = std::max(top, sample->largest());
    const Histogram h(*sample, 0, high, static_cast<std::size_t>(std::lround(high / 0.004)));
    const NormalFit fit = fit_normal(*sample);
    Plot plot{name, title, "F / (p_0 D)", "relative frequency over class width", {}};
    Series bars{"21 bolts of each realisation", Mark::bars, {}, {}};
    for (std::size_t k = 0; k < h.counts().size(); ++k) {
      bars.x.push_back(h.middle(k));
      bars.y.push_back(h.density(k));
    }
    Series normal{"normal, fitted", Mark::line, {}, {}};
    Series paper{"normal 0.030 ± 0.009 (paper)", Mark::dashed_line, {}, {}};
    const NormalFit printed(boost::math::normal(0.03, 0.009));
    for (double x = 0; x <= 0.08; x += 0.0005) {
      normal.x.push_back(x);
      normal.y.push_back(fit.density(x));
      paper.x.push_back(x);
      paper.y.push_back(printed.density(x));
    }
    plot.series = {bars, normal, paper};
    plot.x_range = {{0, high}};
    plot.y_range = {{0, NAN}};
    section.plots.push_back(plot);
  }
  if (sudden.size() >= 1) {
    Series line{"mean, 95 % interval", Mark::linked_points, {}, {}, {}};
    NormalBelief belief{0.03, 1, 2, 1e-4};
    Series update{"updated from 0.030", Mark::linked_points, {}, {}, {}};
    std::vector<const Outcome*> first;
    for (const Outcome* o : quasi) {
      first.push_back(o);
      const Sample s = normalised(first);
      line.x.push_back(static_cast<double>(first.size()));
      line.y.push_back(s.mean());
      line.spread.push_back(0.5 * mean_interval(s).width());
      belief = belief.after(normalised({o}));
      update.x.push_back(static_cast<double>(first.size()) + 0.08);
      update.y.push_back(belief.m);
      update.spread.push_back(0.5 * belief.mean_interval().width());
    }
    Plot plot{"force_intervals",
              "The mean, as realisations are added (quasi-static)",
              "samples of 21 bolts",
              "F / (p_0 D)",
              {line, update}};
    plot.x_range = {{0.5, static_cast<double>(quasi.size()) + 0.5}};
    section.plots.push_back(plot);
  }
  Table table{"Largest forces of 21 bolts, F / (p0 D)",
              {"realisation", "quasi-static", "95 % of the mean",
               "distance to the normal (limit 5 %)", "as the paper ran it"},
              {}};
  for (const Outcome* o : quasi) {
    const Sample s = normalised({o});
    std::string other = "did not stand";
    for (const Outcome* x : sudden)
      if (x->seed == o->seed) other = summary(normalised({x}));
    const Interval i = mean_interval(s);
    table.rows.push_back({std::to_string(o->seed), summary(s),
                          printed_text(i.low) + " to " + printed_text(i.high),
                          printed_text(distance_to_normal(s), 2) + " (" +
                              printed_text(lilliefors_limit(s.size()), 2) + ")",
                          other});
  }
  table.rows.push_back(
      {"all", summary(all),
       printed_text(mean_interval(all).low) + " to " + printed_text(mean_interval(all).high),
       printed_text(distance_to_normal(all), 2) + " (" +
           printed_text(lilliefors_limit(all.size()), 2) + ")",
       summary(all_sudden)});
  section.tables.push_back(table);

  // ---- findings ----
  const std::string gap =
      "The quasi-static forces are half of the paper's. Sudden excavation with little damping brings "
      "some three quarters; joints half as stiff, as where a code takes the area of a contact from "
      "its overlap, bring the rest (docs/bolt-forces.md).";
  const auto in_range = [](const Sample& s) { return s.mean() > 0.02 && s.mean() < 0.04; };
  const char* ids[3] = {"PF-069", "PF-070", "PF-071"};
  for (std::size_t k = 0; k < 3; ++k) {
    if (k >= quasi.size()) {
      section.findings.push_back({ids[k], Agreement::not_testable, "fewer than three realisations",
                                  "run with more realisations"});
      continue;
    }
    const Sample s = normalised({quasi[k]});
    section.findings.push_back(
        {ids[k], agrees_if(in_range(s)),
         "realisation " + std::to_string(quasi[k]->seed) + ": " + summary(s),
         in_range(s) ? "" : gap,
         k < sudden.size() ? summary(normalised({sudden[k]})) : "did not stand",
         k < sudden.size() ? std::optional(agrees_if(in_range(normalised({sudden[k]}))))
                           : std::nullopt});
  }
  section.findings.push_back({"PF-072", agrees_if(in_range(all)),
                              "all realisations: " + summary(all), in_range(all) ? "" : gap,
                              summary(all_sudden), agrees_if(in_range(all_sudden))});
  const double d = distance_to_normal(all), limit = lilliefors_limit(all.size());
  const double d_sudden = distance_to_normal(all_sudden);
  const double limit_sudden = lilliefors_limit(all_sudden.size());
  int fitting = 0;
  for (const Outcome* o : quasi) {
    const Sample s = normalised({o});
    fitting += distance_to_normal(s) < lilliefors_limit(s.size());
  }
  section.findings.push_back(
      {"PF-073", agrees_if(d < limit),
       "distance of all to the fitted normal " + printed_text(d, 3) + ", 5 % limit " +
           printed_text(limit, 3) + "; realisation by realisation " + std::to_string(fitting) +
           " of " + std::to_string(quasi.size()) + " pass",
       d < limit
           ? ""
           : "More values tell more: the merged forces are skewed (skewness " +
                 printed_text(all.skewness(), 2) + "), which a single sample of 21 does not show.",
       printed_text(d_sudden, 3) + ", limit " + printed_text(limit_sudden, 3),
       agrees_if(d_sudden < limit_sudden)});
  section.findings.push_back(
      {"PF-074",
       agrees_if(fit_normal(all).distribution().mean() == all.mean() &&
                 fit_normal(all).distribution().standard_deviation() == all.deviation()),
       "mean and deviation of the " + std::to_string(all.size()) + " raw values: " + summary(all) +
           "; the histogram is for the eye"});
  NormalBelief belief{0.03, 1, 2, 1e-4};
  for (const Outcome* o : quasi) belief = belief.after(normalised({o}));
  const NormalBelief at_once = NormalBelief{0.03, 1, 2, 1e-4}.after(all);
  const Interval mean95 = belief.mean_interval();
  section.findings.push_back(
      {"PF-075", agrees_if(std::abs(belief.beta / at_once.beta - 1) < 1e-10),
       "mean between " + printed_text(mean95.low) + " and " + printed_text(mean95.high) +
           " (95 %) after updating realisation by realisation; all at once: the same to " +
           printed_text(std::abs(belief.beta / at_once.beta - 1), 1)});
  section.findings.push_back({"PF-076",
                              agrees_if(std::abs(0.03 * force_unit - 198652.5) < 1 &&
                                        std::abs(0.03 * force_unit / bolt_strength - 0.4) < 0.005),
                              "0.030 p0 D s_l = " + printed_text(0.03 * force_unit * 1e-3, 4) +
                                  " kN, " + percent(0.03 * force_unit / bolt_strength, 3) +
                                  " of the strength; here " +
                                  printed_text(all.mean() * force_unit * 1e-3) + " kN, " +
                                  percent(all.mean() * force_unit / bolt_strength),
                              "", percent(all_sudden.mean() * force_unit / bolt_strength)});
  const double one = mean_interval(normalised({quasi.front()})).width();
  const double many = mean_interval(all).width();
  section.findings.push_back(
      {"PF-077", quasi.size() < 2 ? Agreement::not_testable : agrees_if(many < one),
       "95 % interval of the mean " + printed_text(one, 3) + " wide from one realisation, " +
           printed_text(many, 3) + " from " + std::to_string(quasi.size()),
       quasi.size() < 2 ? "one realisation only" : ""});
  return section;
}

}  // namespace voussoir::paper
