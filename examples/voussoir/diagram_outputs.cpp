// SPDX-License-Identifier: MIT
#include "diagram_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <voussoir/core/version.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/csv_table.hpp>
#include <voussoir/io/interaction_picture.hpp>
#include <voussoir/io/solved_picture.hpp>

#include "case_statistics.hpp"
#include "outputs.hpp"
#include "run_folder.hpp"

namespace voussoir::program {

double in_own_unit(const BoltSpacing& spacing) {
  return spacing.value / (spacing.is_angle ? std::numbers::pi / 180 : 1.0);
}
std::string spacing_text(const std::optional<BoltSpacing>& spacing, const char* degrees) {
  if (!spacing) return "no bolts";
  return significant_text(in_own_unit(*spacing), 6) + (spacing->is_angle ? degrees : " m");
}
std::string spacing_cell(const std::optional<BoltSpacing>& spacing) {
  return spacing ? significant_text(in_own_unit(*spacing), 6) : "none";
}
const char* spacing_column(const DiagramInput& axes) {
  return axes.spacing.front() && axes.spacing.front()->is_angle ? "bolt_spacing_deg"
                                                                : "bolt_spacing_m";
}

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The tunnels of one place in the diagram, over the seeds.
struct Place {
  std::size_t spacing, thickness;
  std::span<const TunnelResult> tunnels;
  Realised realised;
};

std::vector<Place> places_of(const CasePlan& plan, const std::vector<TunnelResult>& results) {
  const DiagramInput& axes = *plan.input().diagram;
  const auto seeds = static_cast<std::size_t>(plan.parts().realisations);
  std::vector<Place> places;
  for (std::size_t i = 0; i < axes.spacing.size(); ++i)
    for (std::size_t j = 0; j < axes.thickness.size(); ++j) {
      const auto tunnels =
          std::span<const TunnelResult>(results).subspan(places.size() * seeds, seeds);
      places.push_back({i, j, tunnels, Realised(tunnels)});
    }
  return places;
}

std::string tunnels_csv(const CasePlan& plan, const std::vector<Place>& places) {
  const DiagramInput& axes = *plan.input().diagram;
  CsvTable table({spacing_column(axes),
                  "lining_thickness_cm",
                  "verdict",
                  "failed",
                  "marginal",
                  "crown_convergence_mm",
                  "crown_convergence_percent_of_radius",
                  "detached_area_m2",
                  "largest_bolt_force_kN",
                  "mean_bolt_force_kN",
                  "largest_thrust_kN_per_m",
                  "largest_moment_kNm_per_m",
                  "bolt_joints_yielded",
                  "bolt_joints_ruptured",
                  "feet_yielded",
                  "largest_bolt_force_of_its_strength",
                  "bolts_governed_by",
                  "lining_of_its_strength",
                  "lining_governed_by",
                  "error_estimate",
                  "out_of_balance_force_ratio",
                  "warnings"},
                 6);
  const double radius = plan.input().tunnel.half_width();
  for (const Place& place : places) {
    const TunnelResult& r = place.tunnels.front();
    table.add_row(spacing_cell(axes.spacing[place.spacing]), 1e2 * axes.thickness[place.thickness],
                  r.word(), !r.is_whole(), r.marginal, 1e3 * r.convergence.crown,
                  1e2 * r.convergence.crown / radius, r.fallen, 1e-3 * r.demand.largest_bolt_force,
                  1e-3 * r.demand.mean_bolt_force, 1e-3 * r.demand.largest_thrust,
                  1e-3 * r.demand.largest_moment, r.bolts_yielded, r.bolts_ruptured, r.feet_yielded,
                  strength_cell(r.of_bolt_strength), governed_cell(r.bolts_governed_by),
                  strength_cell(r.of_lining_strength), governed_cell(r.lining_governed_by),
                  r.error_estimate, r.out_of_balance, warnings_cell(r));
  }
  return table.text();
}

std::string realised_csv(const CasePlan& plan, const std::vector<Place>& places) {
  const DiagramInput& axes = *plan.input().diagram;
  const std::string quantile = "_quantile_" + fixed_text(100 * reported_quantile, 0) + "_percent";
  CsvTable table({spacing_column(axes),
                  "lining_thickness_cm",
                  "realisations",
                  "stable",
                  "stable_after_rockfall",
                  "stable_without_lining",
                  "collapse",
                  "undecided",
                  "failed",
                  "marginal",
                  "supports_yielded",
                  "rockfall_share",
                  "rockfall_share_low_95",
                  "rockfall_share_high_95",
                  "crown_convergence_mm_mean",
                  "crown_convergence_mm_deviation",
                  "crown_convergence_mm_mean_low_95",
                  "crown_convergence_mm_mean_high_95",
                  "crown_convergence_mm" + quantile,
                  "largest_bolt_force_kN_mean",
                  "largest_bolt_force_kN" + quantile,
                  "largest_thrust_kN_per_m_mean",
                  "largest_thrust_kN_per_m" + quantile,
                  "largest_moment_kNm_per_m_mean",
                  "largest_moment_kNm_per_m" + quantile},
                 6);
  for (const Place& place : places) {
    const Realised& r = place.realised;
    const Share share = r.rockfall();
    const Interval shares = share.trials > 0 ? share.interval() : Interval{none, none};
    const Interval crowns = r.crown.mean_between().value_or(Interval{none, none});
    table.add_row(spacing_cell(axes.spacing[place.spacing]), 1e2 * axes.thickness[place.thickness],
                  r.count, r.whole, r.shedding, r.without_lining, r.collapsed, r.undecided,
                  r.failed, r.marginal, r.yielded, share.trials > 0 ? share.value() : none,
                  shares.low, shares.high, 1e3 * r.crown.mean(), 1e3 * r.crown.deviation(),
                  1e3 * crowns.low, 1e3 * crowns.high, 1e3 * r.crown.quantile(),
                  1e-3 * r.largest_bolt_force.mean(), 1e-3 * r.largest_bolt_force.quantile(),
                  1e-3 * r.largest_thrust.mean(), 1e-3 * r.largest_thrust.quantile(),
                  1e-3 * r.largest_moment.mean(), 1e-3 * r.largest_moment.quantile());
  }
  return table.text();
}

/// What a picture shows at one place.
struct Shown {
  double value = none;
  bool failed = false, collapsed = false, undecided = false, marginal = false;
};

InteractionPicture picture_of(const CasePlan& plan, const std::vector<Place>& places,
                              const std::function<Shown(const Place&)>& shown) {
  const DiagramInput& axes = *plan.input().diagram;
  InteractionPicture picture;
  const auto columns = static_cast<Eigen::Index>(axes.thickness.size());
  const auto rows = static_cast<Eigen::Index>(axes.spacing.size());
  picture.values.resize(columns, rows);
  picture.failed.resize(columns, rows);
  picture.collapsed.resize(columns, rows);
  picture.undecided.resize(columns, rows);
  picture.marginal.resize(columns, rows);
  for (const Place& place : places) {
    const auto i = static_cast<Eigen::Index>(place.thickness);
    const auto j = static_cast<Eigen::Index>(place.spacing);
    const Shown what = shown(place);
    picture.values(i, j) = what.value;
    picture.failed(i, j) = what.failed;
    picture.collapsed(i, j) = what.collapsed;
    picture.undecided(i, j) = what.undecided;
    picture.marginal(i, j) = what.marginal;
  }
  picture.diameter = 2 * plan.input().tunnel.half_width();
  picture.thicknesses = axes.thickness;
  for (const auto& spacing : axes.spacing)
    picture.spacings.push_back(
        {spacing_text(spacing, "°"), spacing ? std::optional(spacing->value) : std::nullopt});
  picture.spacing_axis = "bolt spacing";
  return picture;
}

std::string title_of(const CasePlan& plan) {
  const std::string& title = plan.input().title;
  return "Interaction diagram" + (title.empty() ? "" : ": " + title);
}

KeyNumber bolt_length(const CasePlan& plan) {
  const auto& bolts = plan.input().bolts;
  return {"bolt length",
          bolts.empty() ? "no bolts" : significant_text(bolts.front().length, 6) + " m"};
}

std::string tunnels_svg(const CasePlan& plan, const std::vector<Place>& places) {
  double worst = 0;
  bool estimated = false;
  int failed = 0, undecided = 0, marginal = 0, yielded = 0;
  InteractionPicture picture = picture_of(plan, places, [&](const Place& place) {
    const TunnelResult& r = place.tunnels.front();
    // Where rock detached but a crown remains, its convergence still belongs to the surface; a
    // collapse has none.
    const bool stands = !r.failed && r.verdict == Verdict::stable;
    Shown shown{stands ? r.convergence.crown : none, r.is_decided() && !r.is_whole(),
                r.is_decided() && r.verdict == Verdict::collapse, !r.is_decided(), r.marginal};
    marginal += shown.marginal;
    failed += shown.failed;
    undecided += shown.undecided;
    yielded += stands && r.has_yielded();
    if (stands && std::isfinite(r.error_estimate)) {
      worst = std::max(worst, r.error_estimate);
      estimated = true;
    }
    return shown;
  });
  const std::string count = std::to_string(places.size());
  picture.header.title = title_of(plan);
  picture.header.lines = {
      "Convergence of the crown over lining thickness and bolt spacing, " + count + " tunnels in " +
      std::to_string(places.front().tunnels.front().blocks) + " blocks (seed " +
      std::to_string(plan.input().model.seed) + "). " +
      (estimated ? "Largest estimated error of the displacements " +
                       significant_text(100 * worst, 2) + " %. "
                 : "Error of the displacements not estimated. ") +
      "Arrows: rock falls, the rest stands; red crosses: collapse." +
      (marginal > 0
           ? " Rings: marginal, another displacement limit, other damping or slower unloading changes what falls."
           : "")};
  picture.header.key_numbers = {
      bolt_length(plan), {"tunnels with detached blocks", std::to_string(failed) + " of " + count}};
  if (marginal > 0)
    picture.header.key_numbers.push_back(
        {"tunnels marginal", std::to_string(marginal) + " of " + count});
  if (yielded > 0)
    picture.header.key_numbers.push_back(
        {"stable with supports at their strength", std::to_string(yielded) + " of " + count});
  if (undecided > 0) {
    const std::string text = std::to_string(undecided) + " of " + count;
    picture.header.key_numbers.push_back({"tunnels undecided", text});
    picture.banner = {{std::to_string(undecided) + " OF " + count + " TUNNELS UNDECIDED",
                       "neither an equilibrium nor detached blocks were found at the points marked "
                       "with ?: no result there"}};
  }
  return draw_interaction_picture(picture);
}

/// A picture over the realisations.
/// @param value  of a place; not a number: none
std::string realised_svg(const CasePlan& plan, const std::vector<Place>& places,
                         const std::string& line, std::optional<InteractionQuantity> quantity,
                         const std::function<double(const Realised&)>& value) {
  int sheds = 0, undecided = 0, marginal = 0;
  InteractionPicture picture = picture_of(plan, places, [&](const Place& place) {
    const Realised& r = place.realised;
    const bool is_decided = r.decided() > 0;
    const Shown shown{value(r), is_decided && r.rockfall().events + r.without_lining > 0,
                      r.collapsed > 0, !is_decided, r.marginal > 0};
    marginal += shown.marginal;
    sheds += shown.failed;
    undecided += r.undecided + r.failed;
    return shown;
  });
  const std::string places_text = std::to_string(places.size());
  const auto first = plan.input().model.seed;
  const auto last = first + static_cast<std::uint64_t>(plan.parts().realisations) - 1;
  picture.header.title = title_of(plan);
  picture.header.lines = {
      line +
      " Arrows: in at least one realisation rock falls; red crosses: in "
      "at least one the tunnel collapses." +
      (marginal > 0
           ? " Rings: at least one is marginal, another displacement limit, other damping or slower unloading changes what falls."
           : "")};
  picture.header.key_numbers = {
      bolt_length(plan),
      {"realisations of the rock", std::to_string(plan.parts().realisations) + " (seeds " +
                                       std::to_string(first) + " to " + std::to_string(last) + ")"},
      {"designs with detached blocks", std::to_string(sheds) + " of " + places_text}};
  if (undecided > 0)
    picture.header.key_numbers.push_back(
        {"tunnels without a result",
         std::to_string(undecided) + " of " +
             std::to_string(places.size() * static_cast<std::size_t>(plan.parts().realisations))});
  picture.quantity = std::move(quantity);
  return draw_interaction_picture(picture);
}

/// One table with a row a spacing.
std::string table_text(const CasePlan& plan, const std::vector<Place>& places,
                       const std::function<std::string(const Place&)>& cell) {
  const DiagramInput& axes = *plan.input().diagram;
  std::string out = "spacing \\ lining";
  for (const double t : axes.thickness) {
    const std::string head = significant_text(1e2 * t, 3) + " cm";
    out += std::string(12 - std::min<std::size_t>(head.size(), 12), ' ') + head;
  }
  out += "\n";
  for (std::size_t i = 0; i < axes.spacing.size(); ++i) {
    std::string label = spacing_text(axes.spacing[i], " deg");
    label.resize(16, ' ');
    out += label;
    for (std::size_t j = 0; j < axes.thickness.size(); ++j) {
      const std::string text = cell(places[i * axes.thickness.size() + j]);
      out += std::string(12 - std::min<std::size_t>(text.size(), 12), ' ') + text;
    }
    out += "\n";
  }
  return out;
}

std::string closing_text(const CasePlan& plan, const std::vector<TunnelResult>& results) {
  return "boundary " + results.front().boundary + "\n" + strength_text(plan) +
         warnings_text(results);
}

std::string tunnels_summary(const CasePlan& plan, const std::vector<Place>& places,
                            const std::vector<TunnelResult>& results) {
  std::string out = "crown convergence [mm] of " + std::to_string(places.size()) + " tunnels in " +
                    std::to_string(results.front().blocks) +
                    " blocks; R: stable after rockfall, C: collapse, ?: undecided\n";
  if (std::any_of(results.begin(), results.end(), [](const auto& r) { return r.marginal; }))
    out +=
        "~: marginal, another displacement limit, other damping or slower unloading changes what falls\n";
  const bool any_yielded =
      std::any_of(results.begin(), results.end(), [](const auto& r) { return r.has_yielded(); });
  if (any_yielded) out += "y: supports have reached their strength\n";
  out += "\n" + table_text(plan, places, [&](const Place& place) {
           const TunnelResult& r = place.tunnels.front();
           const char* const mark = !r.is_decided()                  ? " ?"
                                    : r.verdict == Verdict::collapse ? " C"
                                    : !r.is_whole()                  ? " R"
                                                                     : "  ";
           return millimetres_text(r.convergence.crown) + mark + (r.marginal ? "~" : " ") +
                  (!any_yielded      ? ""
                   : r.has_yielded() ? "y"
                                     : " ");
         });
  out += closing_text(plan, results);
  return out;
}

std::string realised_summary(const CasePlan& plan, const std::vector<Place>& places,
                             const std::vector<TunnelResult>& results) {
  std::string out = "crown convergence [mm], mean and " + fixed_text(100 * reported_quantile, 0) +
                    " % quantile, of " + std::to_string(places.size()) + " designs in " +
                    std::to_string(plan.parts().realisations) + " realisations of the rock\n\n";
  out += table_text(plan, places, [](const Place& place) {
    return millimetres_text(place.realised.crown.mean()) + " / " +
           millimetres_text(place.realised.crown.quantile());
  });
  int yielded = 0;
  for (const Place& place : places) yielded += place.realised.yielded;
  if (yielded > 0)
    out += "\nsupports have reached their strength in " + std::to_string(yielded) + " of " +
           std::to_string(results.size()) + " tunnels\n";
  out += "\nrealisations in which rock falls [%]; ?: some are undecided; ~: some are marginal\n\n";
  out += table_text(plan, places, [](const Place& place) {
    const Realised& r = place.realised;
    if (r.decided() == 0) return std::string("?  ");
    return readable_text(100 * r.rockfall().value()) + (r.decided() < r.count ? " ?" : "  ") +
           (r.marginal > 0 ? "~" : " ");
  });
  return out + closing_text(plan, results);
}

/// What the diagram is of: with several realisations it has a run id of its own, and says here to
/// which tunnel it belongs.
std::string realised_json(const CasePlan& plan) {
  const nlohmann::ordered_json json = {
      {"schema", 1},
      {"program", std::string("voussoir ") + VOUSSOIR_VERSION_STRING},
      {"title", plan.input().title},
      {"tunnel_id", RunId("tunnel").add(plan.input()).text()},
      {"first_seed", plan.input().model.seed},
      {"realisations", plan.parts().realisations}};
  return json.dump(2) + "\n";
}

}  // namespace

CaseOutputs diagram_outputs(const CasePlan& plan, const std::vector<TunnelResult>& results) {
  const std::vector<Place> places = places_of(plan, results);
  if (plan.parts().realisations == 1)
    return {{{"interaction.csv", tunnels_csv(plan, places)},
             {"interaction.svg", tunnels_svg(plan, places)}},
            tunnels_summary(plan, places, results)};
  const std::string over = " over lining thickness and bolt spacing, " +
                           std::to_string(places.size()) + " designs in " +
                           std::to_string(plan.parts().realisations) + " realisations of the rock.";
  const double diameter = 2 * plan.input().tunnel.half_width();
  InteractionQuantity quantile = InteractionQuantity::crown_convergence(diameter);
  quantile.name += ", " + fixed_text(100 * reported_quantile, 0) + " % quantile";
  CaseOutputs outputs;
  outputs.files["interaction.json"] = realised_json(plan);
  outputs.files["interaction.csv"] = realised_csv(plan, places);
  outputs.files["interaction.svg"] =
      realised_svg(plan, places, "Mean convergence of the crown" + over, std::nullopt,
                   [](const Realised& r) { return r.crown.mean(); });
  outputs.files["interaction_quantile.svg"] =
      realised_svg(plan, places,
                   "Convergence of the crown that " + fixed_text(100 * reported_quantile, 0) +
                       " % of the realisations stay below" + over +
                       " A realisation that collapses counts as worse than any other.",
                   quantile, [](const Realised& r) { return r.crown.quantile(); });
  outputs.files["interaction_rockfall.svg"] =
      realised_svg(plan, places, "Realisations in which rock falls or the tunnel collapses" + over,
                   InteractionQuantity::in("realisations with rockfall", 100, "%"),
                   [](const Realised& r) { return r.decided() > 0 ? r.rockfall().value() : none; });
  outputs.summary = realised_summary(plan, places, results);
  return outputs;
}

}  // namespace voussoir::program
