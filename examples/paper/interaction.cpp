// SPDX-License-Identifier: MIT
// The interaction diagram of bolts and lining, from several realisations of the rock: Fig. 24.
#include <algorithm>
#include <cmath>
#include <utility>
#include <voussoir/io/interaction_picture.hpp>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

namespace {

const std::vector<double>& spacings() {  // degrees; 0: no bolts
  static const std::vector<double> all{5, 9, 11.25, 15, 18, 22.5, 0};
  return all;
}
const std::vector<double>& thicknesses() {
  static const std::vector<double> all{0, 0.05, 0.1, 0.15, 0.2, 0.3};
  return all;
}
Variant at(double spacing, double thickness) {
  Variant v;
  if (spacing > 0) v.bolts = Bolts{.spacing = spacing * degree};
  if (thickness > 0) v.lining = Lining{.thickness = thickness};
  return v;
}
std::string spacing_name(double spacing) {
  return spacing > 0 ? trimmed_text(spacing, 2) + "°" : std::string("none");
}

/// Of the ring's fibres, thrust and moment together [Pa].
double largest_stress(const Outcome& outcome, double thickness) {
  double most = 0;
  for (const LiningOutcome& l : outcome.lining)
    most = std::max(most, l.thrust / thickness + 6 * std::abs(l.moment) / (thickness * thickness));
  return most;
}

}  // namespace

Section interaction(Study& study) {
  Section section{
      "interaction",
      "Interaction diagram of bolts and lining",
      "8.1, Fig. 24",
      {"Crown convergence over lining thickness and bolt spacing, 4 m bolts: the mean "
       "of the realisations that stand. A point where blocks detach in any realisation is marked; "
       "where none stands there is no value. Diamonds: bolts of two thirds and three times "
       "the stiffness at 15° (Figs 25 and 26), drawn at the spacing at which bolts of "
       "28 mm have the same dimensionless stiffness. Elastic theory cannot tell them apart."}};
  std::vector<Variant> variants;
  for (const double s : spacings())
    for (const double t : thicknesses()) variants.push_back(at(s, t));
  study.prepare(variants);
  // 15 degrees with another stiffness: the spacing of equal dimensionless stiffness.
  struct OtherBolts {
    double factor;
    const char* name;
    [[nodiscard]] Variant at(double thickness) const {
      return {.bolts = Bolts{.stiffness = factor * bolt_stiffness},
              .lining = Lining{.thickness = thickness}};
    }
    [[nodiscard]] double spacing() const { return 15 / factor; }
  };
  const std::vector<OtherBolts> others{{2.0 / 3, "2/3 Ka"}, {3, "3 Ka"}};
  for (const OtherBolts& other : others) study.prepare({other.at(0.1)});
  // Three tables and three diagrams from the same tunnels.
  const std::string of_samples = ", mean of " + std::to_string(study.samples()) +
                                 (study.samples() == 1 ? " realisation" : " realisations");
  const auto picture_of = [&](const std::string& title) {
    InteractionPicture picture;
    picture.header.title = title + of_samples;
    picture.diameter = diameter;
    picture.spacing_axis = "bolt spacing";
    return picture;
  };
  const auto spacing_row = [](double s) {
    return s > 0 ? InteractionPicture::Spacing{spacing_name(s), s}
                 : InteractionPicture::Spacing{"no bolts", {}};
  };
  InteractionPicture picture = picture_of("Crown convergence");
  InteractionPicture force_picture = picture_of("Mean of the bolts' largest forces");
  InteractionPicture stress_picture = picture_of("Largest compressive stress in the lining");
  force_picture.quantity = InteractionQuantity::in("bolt force", 1e-3, "kN");
  stress_picture.quantity = InteractionQuantity::in("stress", 1e-6, "MPa");
  picture.thicknesses = force_picture.thicknesses = thicknesses();
  stress_picture.thicknesses.assign(thicknesses().begin() + 1, thicknesses().end());
  for (const double s : spacings()) {
    picture.spacings.push_back(spacing_row(s));
    stress_picture.spacings.push_back(spacing_row(s));
    if (s > 0) force_picture.spacings.push_back(spacing_row(s));
  }
  for (InteractionPicture* p : {&picture, &force_picture, &stress_picture}) {
    const auto wide = static_cast<Eigen::Index>(p->thicknesses.size());
    const auto high = static_cast<Eigen::Index>(p->spacings.size());
    p->values.resize(wide, high);
    p->failed.resize(wide, high);
    p->collapsed.resize(wide, high);
  }
  Table crowns{
      "Crown convergence, mm; R: blocks detach in some realisation, C: some realisation collapses",
      {"spacing \\ t, cm"},
      {}};
  Table bolts{"Mean of the bolts' largest forces, kN", {"spacing \\ t, cm"}, {}};
  Table stresses{"Largest compressive stress in the lining, N / t + 6 |M| / t², MPa",
                 {"spacing \\ t, cm"},
                 {}};
  for (Table* table : {&crowns, &bolts, &stresses})
    for (const double t : thicknesses()) table->columns.push_back(trimmed_text(100 * t, 1));
  std::vector<std::vector<Measured>> grid;  // by spacing
  for (std::size_t j = 0; j < spacings().size(); ++j) {
    std::vector<std::string> u_row{spacing_name(spacings()[j])}, f_row = u_row, s_row = u_row;
    grid.emplace_back();
    for (std::size_t i = 0; i < thicknesses().size(); ++i) {
      const double t = thicknesses()[i];
      const Variant v = at(spacings()[j], t);
      const Measured u = study.measure(v, crown);
      grid.back().push_back(u);
      bool sheds = false;
      for (const Outcome& o : study.of(v)) sheds = sheds || o.sheds() || !o.stable();
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      picture.values(row, column) = u.mean();
      picture.failed(row, column) = sheds;
      picture.collapsed(row, column) = u.collapsed > 0;
      const char* mark = u.collapsed > 0 ? " C" : sheds ? " R" : "";
      u_row.push_back(u.values.empty() ? "C" : printed_text(1e3 * u.mean()) + mark);
      if (v.bolts) {
        const double force =
            study.measure(v, [](const Outcome& o) { return o.mean_force(); }).mean();
        force_picture.values(row, column) = force;
        force_picture.failed(row, column) = sheds;
        force_picture.collapsed(row, column) = u.collapsed > 0;
        f_row.push_back(printed_text(1e-3 * force));
      } else {
        f_row.emplace_back();
      }
      if (v.lining) {
        const double stress =
            study.measure(v, [t](const Outcome& o) { return largest_stress(o, t); }).mean();
        stress_picture.values(row - 1, column) = stress;
        stress_picture.failed(row - 1, column) = sheds;
        stress_picture.collapsed(row - 1, column) = u.collapsed > 0;
        s_row.push_back(printed_text(1e-6 * stress));
      } else {
        s_row.emplace_back();
      }
    }
    crowns.rows.push_back(u_row);
    bolts.rows.push_back(f_row);
    stresses.rows.push_back(s_row);
  }
  const auto draw_others = [&](InteractionPicture& p, const Quantity& quantity) {
    p.others_name = "15°, other stiffness, at equal β";
    for (const OtherBolts& other : others)
      p.others.push_back(
          {0.1, other.spacing(), study.measure(other.at(0.1), quantity).mean(), other.name});
  };
  draw_others(picture, crown);
  draw_others(stress_picture, [](const Outcome& o) { return largest_stress(o, 0.1); });
  for (const auto& [name, p] :
       {std::pair("interaction", &picture), std::pair("interaction_bolts", &force_picture),
        std::pair("interaction_stress", &stress_picture)})
    section.pictures.push_back({name, draw_interaction_picture(*p), p->header.title});
  section.tables = {crowns, bolts, stresses};
  Plot slices{"interaction_slices",
              "Crown convergence over spacing",
              "bolt spacing θ_b, degrees",
              "convergence, % of a",
              {}};
  Series crosses{"not all realisations stand", Mark::failed, {}, {}, {}};
  for (std::size_t i = 0; i < thicknesses().size(); ++i) {
    Series s{
        "t = " + trimmed_text(100 * thicknesses()[i], 1) + " cm", Mark::linked_points, {}, {}, {}};
    for (std::size_t j = 0; j + 1 < spacings().size(); ++j) {
      const Measured& m = grid[j][i];
      if (!m.complete()) {
        crosses.x.push_back(spacings()[j]);
        crosses.y.push_back(m.values.empty() ? 0 : 1e2 * m.mean() / radius);
      }
      if (m.values.empty()) continue;
      s.x.push_back(spacings()[j]);
      s.y.push_back(1e2 * m.mean() / radius);
      s.spread.push_back(1e2 * m.deviation() / radius);
    }
    slices.series.push_back(s);
  }
  Series other_points{"10 cm, 2/3 and 3 K_a (equal β)", Mark::points, {}, {}, {}};
  for (const OtherBolts& other : others) {
    const Measured m = study.measure(other.at(0.1), crown);
    if (m.values.empty()) continue;
    other_points.x.push_back(other.spacing());
    other_points.y.push_back(1e2 * m.mean() / radius);
    other_points.spread.push_back(1e2 * m.deviation() / radius);
  }
  slices.series.push_back(other_points);
  slices.series.push_back(crosses);
  slices.y_range = {{0, NAN}};
  section.plots.push_back(slices);

  // ---- findings ----
  bool by_thickness = true, by_spacing = true;
  for (std::size_t j = 0; j < grid.size(); ++j)
    for (std::size_t i = 0; i < grid[j].size(); ++i) {
      if (grid[j][i].values.empty()) continue;
      if (i + 1 < grid[j].size())
        by_thickness = by_thickness && grid[j][i + 1].mean() < grid[j][i].mean();
      // Where lined: without lining blocks detach and other realisations make the mean.
      if (j + 1 < grid.size() && i > 0)
        by_spacing = by_spacing && grid[j + 1][i].mean() > grid[j][i].mean();
    }
  int unlined_failures = 0;
  for (std::size_t j = 0; j < spacings().size(); ++j) unlined_failures += picture.is_failed(0, j);
  section.findings.push_back(
      {"PF-091", agrees_if(by_thickness && by_spacing && unlined_failures > 0),
       "falls with t at every spacing: " + std::string(by_thickness ? "yes" : "no") +
           "; rises with spacing at every lined thickness: " + (by_spacing ? "yes" : "no") +
           "; unlined spacings where blocks detach: " + std::to_string(unlined_failures) + " of " +
           std::to_string(spacings().size()),
       by_thickness && by_spacing ? "" : "not monotonic in the mean of the realisations"});
  const auto crown_at = [&](double spacing, double thickness) {
    return study.measure(at(spacing, thickness), crown).mean();
  };
  const double over_bolts = crown_at(0, 0.2) / crown_at(9, 0.2) - 1;
  section.findings.push_back({"PF-092", agrees_if(over_bolts < 0.15),
                              "t = 0.02 D: crown from bolts at 9° to no bolts +" +
                                  percent(over_bolts) + "; unlined from 9° to 22.5° +" +
                                  percent(crown_at(22.5, 0) / crown_at(9, 0) - 1)});
  const Variant choice = at(15, 0.1);
  const Measured chosen = study.measure(choice, crown);
  bool sheds = false;
  for (const Outcome& o : study.of(choice)) sheds = sheds || o.sheds();
  section.findings.push_back(
      {"PF-093", agrees_if(chosen.complete() && !sheds),
       "10 cm, 15°: crown " + chosen.text(1e3, "mm") + ", largest bolt force " +
           study.measure(choice, [](const Outcome& o) { return o.largest_force(); })
               .text(1e-3, "kN"),
       chosen.complete() && !sheds ? "" : "blocks detach in some realisation"});
  section.findings.push_back(
      {"PF-103", agrees_if(chosen.values.size() > 1),
       "the diagram is the mean of " + std::to_string(study.samples()) +
           " realisations; at the chosen point the realisations scatter by " +
           percent(chosen.deviation() / chosen.mean()) + " of the crown's convergence"});
  return section;
}

}  // namespace voussoir::paper
