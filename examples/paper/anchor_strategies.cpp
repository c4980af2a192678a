// SPDX-License-Identifier: MIT
// Where a bolt grips: near the joint, midway in the block, on the joint. Fig. 10.
#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

namespace {

Bolts with(AnchorPlace place) {
  Bolts bolts = reference_bolts;
  bolts.anchors = place;
  return bolts;
}

}  // namespace

Section anchor_strategies(Study& study) {
  Section section{"anchor_strategies",
                  "Where bolts grip",
                  "3.1, 5.2, Figs 4 and 10",
                  {"21 bolts of 7 m whose anchors sit 1.2 bolt diameters from each joint (Lorig), "
                   "midway in the blocks (Garga and Wang) or on the joint itself, in the same "
                   "realisations of the rock."}};
  const Variant lorig{.bolts = with(AnchorPlace::near_joint)};
  const Variant midway{.bolts = with(AnchorPlace::mid_block)};
  const Variant on_joint{.bolts = with(AnchorPlace::on_joint)};
  study.prepare({lorig, midway, on_joint, lorig.as_the_paper(), midway.as_the_paper()});

  Plot forces{"anchors_forces",
              "Largest force of each bolt, mean over realisations",
              "angle from the right-hand springing, degrees",
              "F / (p_0 D)",
              {}};
  Plot wall{"anchors_wall",
            "Convergence of the wall, median over ± 12°, mean over realisations",
            "angle from the right-hand springing, degrees",
            "convergence, mm",
            {}};
  for (const auto& [name, variant] : {std::pair("1.2 diameters from the joint", lorig),
                                      {"midway in the block", midway},
                                      {"on the joint", on_joint}}) {
    Series f{name, Mark::linked_points, {}, {}}, u{name, Mark::line, {}, {}};
    const auto& outcomes = study.of(variant);
    for (std::size_t b = 0; b < outcomes.front().bolts.size(); ++b) {
      const Measured m =
          study.measure(variant, [b](const Outcome& o) { return o.bolts[b].largest; });
      if (m.values.empty()) continue;
      f.x.push_back(outcomes.front().bolts[b].angle / degree);
      f.y.push_back(m.mean() / force_unit);
    }
    for (double angle = -30; angle <= 210; angle += 7.5) {
      const Measured m = study.measure(
          variant, [angle](const Outcome& o) { return convergence_at(o.wall, angle * degree); });
      if (m.values.empty()) continue;
      u.x.push_back(angle);
      u.y.push_back(1e3 * m.mean());
    }
    forces.series.push_back(f);
    wall.series.push_back(u);
  }
  forces.y_range = wall.y_range = {{0, NAN}};
  forces.caption = wall.caption = "The first two lie on each other.";
  for (Plot* plot : {&forces, &wall})
    say_collapsed(*plot, study,
                  {{"1.2 diameters", lorig}, {"midway", midway}, {"on the joint", on_joint}});
  section.plots = {forces, wall};

  // The largest difference over bolts, and over places of the wall, in each realisation.
  const auto bolts_apart = [](const Outcome& a, const Outcome& b) {
    return std::abs(b.mean_force() / a.mean_force() - 1);
  };
  const auto worst_bolt_apart = [](const Outcome& a, const Outcome& b) {
    double most = 0;
    for (std::size_t k = 0; k < a.bolts.size(); ++k)
      most = std::max(most, std::abs(b.bolts[k].largest - a.bolts[k].largest) / a.largest_force());
    return most;
  };
  const auto walls_apart = [](const Outcome& a, const Outcome& b) {
    double most = 0;
    for (double angle = 0; angle <= 180; angle += 15) {
      const double before = convergence_at(a.wall, angle * degree);
      most = std::max(most, std::abs(convergence_at(b.wall, angle * degree) / before - 1));
    }
    return most;
  };
  const auto sudden_l = lorig.as_the_paper(), sudden_m = midway.as_the_paper();
  const Measured f = paired(study, lorig, midway, worst_bolt_apart);
  const Measured f_mean = paired(study, lorig, midway, bolts_apart);
  const Measured u = paired(study, lorig, midway, walls_apart);
  const Measured f_sudden = paired(study, sudden_l, sudden_m, worst_bolt_apart);
  const Measured u_sudden = paired(study, sudden_l, sudden_m, walls_apart);
  section.findings.push_back(
      {"PF-055", agrees_if(f.mean() < 0.15),
       "largest difference of one bolt over the largest force: " + f.text(100, "%", 2) +
           "; of the mean over bolts: " + f_mean.text(100, "%", 2),
       f.mean() < 0.15 ? "" : "single bolts differ more than the paper's 8.1 %",
       f_sudden.text(100, "%", 2), agrees_if(f_sudden.mean() < 0.15)});
  section.findings.push_back(
      {"PF-056", agrees_if(u.mean() < 0.10),
       "largest difference of convergence at 13 places of the upper wall: " + u.text(100, "%", 2),
       u.mean() < 0.10 ? "" : "loose pieces of the wall move differently",
       u_sudden.text(100, "%", 2), agrees_if(u_sudden.mean() < 0.10)});
  return section;
}

}  // namespace voussoir::paper
