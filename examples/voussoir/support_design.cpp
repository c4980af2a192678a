// SPDX-License-Identifier: MIT
#include "support_design.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <voussoir/core/units.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/csv_table.hpp>
#include <voussoir/io/interaction_picture.hpp>

#include "case_outputs.hpp"
#include "design_criteria.hpp"
#include "diagram_outputs.hpp"
#include "output_parts.hpp"
#include "run_folder.hpp"

namespace voussoir::program {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string percent(double share) { return significant_text(100 * share, 3) + " %"; }

std::string money(const CasePlan& plan, double cost) {
  return significant_text(cost, 4) + " " + plan.input().costs->currency + "/m";
}

std::string thickness_text(double thickness) {
  return thickness > 0 ? "lining " + format_quantity(thickness, dimension::length) : "no lining";
}

std::string supports_text(const SupportChoice& supports, const char* degrees) {
  return (supports.spacing ? "bolts every " : "") + spacing_text(supports.spacing, degrees) + ", " +
         thickness_text(supports.thickness);
}

/// What is known of a place from all of its realisations.
void judge(const Input& input, const std::vector<TunnelResult>& results, bool is_sure,
           SupportAt& at) {
  at.is_computed = true;
  at.criteria.clear();
  const std::vector<DesignLimit> limits = limits_of(input);
  for (const DesignLimit& limit : limits) at.criteria.push_back({limit.what, {}});
  for (const TunnelResult& result : results) {
    if (result.failed || result.verdict == Verdict::undecided) {
      ++at.undecided;
      continue;
    }
    bool is_any = false;
    for (std::size_t k = 0; k < limits.size(); ++k) {
      CriterionAt& criterion = at.criteria[k];
      const bool is_broken = limits[k].is_exceeded(result);
      criterion.broken.events += is_broken;
      ++criterion.broken.trials;
      is_any = is_any || is_broken;
      const double ratio = limits[k].ratio ? limits[k].ratio(result) : none;
      if (!(criterion.worst >= ratio)) criterion.worst = ratio;
    }
    at.broken.events += is_any;
    ++at.broken.trials;
  }
  if (at.undecided > 0) return;
  const double allowed = input.criteria.probability.value_or(0);
  at.holds = is_sure ? at.broken.interval().high <= allowed : at.broken.value() <= allowed;
}

/// "lining utilisation above 1 in 40 %, up to 123 % of the limit", "rockfall in 20 %"
std::string broken_text(const CriterionAt& criterion) {
  std::string text = criterion.what + " in " + percent(criterion.broken.value());
  if (std::isfinite(criterion.worst) && criterion.worst > 1)
    text += ", up to " + percent(criterion.worst) + " of the limit";
  return text;
}

std::string failing_text(const SupportAt& at) {
  std::string text;
  if (at.undecided > 0) text = std::to_string(at.undecided) + " realisations are not decided";
  for (const CriterionAt& criterion : at.criteria)
    if (criterion.broken.events > 0) text += (text.empty() ? "" : "; ") + broken_text(criterion);
  return text.empty() ? "the share of realisations is not sure enough" : text;
}

/// "lining utilisation above 1: 83 % of the limit"
std::string margin_text(const SupportAt& at) {
  const CriterionAt* const nearest = at.nearest();
  if (nearest == nullptr) return "no criterion has a value";
  return "nearest to its limit: " + nearest->what + ", at " + percent(nearest->worst) + " of it";
}

}  // namespace

const CriterionAt* SupportAt::nearest() const {
  const CriterionAt* found = nullptr;
  for (const CriterionAt& criterion : criteria)
    if (!std::isnan(criterion.worst) && (found == nullptr || criterion.worst > found->worst))
      found = &criterion;
  return found;
}

int SupportDesign::computed() const {
  return static_cast<int>(
      std::count_if(all.begin(), all.end(), [](const SupportAt& at) { return at.is_computed; }));
}

SupportDesign cheapest_support(const CasePlan& plan, const PlaceResults& results, bool is_sure) {
  const Input& input = plan.input();
  if (!input.costs)
    throw InvalidInput(
        "no [costs] in " + plan.parts().file +
        ": nothing says which support is cheap\n   = accepted: bolt_per_metre, bolt_per_hole, "
        "concrete_per_m3, rebound, steel_per_kg, currency");
  if (is_sure && !input.criteria.probability)
    throw InvalidInput(
        "--sure: of which probability is not said\n   = accepted: a key "
        "criteria.probability");
  const DiagramInput& axes = *input.diagram;
  SupportDesign design;
  design.thicknesses = axes.thickness.size();
  Eigen::MatrixXd costs(axes.spacing.size(), axes.thickness.size());
  for (std::size_t i = 0; i < axes.spacing.size(); ++i)
    for (std::size_t j = 0; j < axes.thickness.size(); ++j) {
      SupportAt& at = design.all.emplace_back();
      at.place = {i, j};
      at.supports = {axes.spacing[i], axes.thickness[j]};
      at.cost = cost_of(*input.costs, support_quantities(input, at.supports));
      costs(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = at.cost;
    }
  const auto compute = [&](const SupportPlace& place) {
    SupportAt& at = design.at(place);
    if (!at.is_computed) judge(input, results(place), is_sure, at);
    return at.holds;
  };
  design.cheapest = cheapest_place(costs, compute);
  if (!design.cheapest) {
    (void)compute({0, axes.thickness.size() - 1});  // how far the strongest is from it
    return design;
  }
  const SupportPlace& best = *design.cheapest;
  if (best.spacing > 0) design.surer.push_back({best.spacing - 1, best.thickness});
  if (best.thickness + 1 < axes.thickness.size())
    design.surer.push_back({best.spacing, best.thickness + 1});
  for (const SupportPlace& place : design.surer) (void)compute(place);
  return design;
}

namespace {

/// The answer in a sentence.
std::string answer_text(const CasePlan& plan, const SupportDesign& design) {
  if (!design.cheapest) {
    const SupportAt& strongest = design.strongest();
    return "none on the axes of [diagram] holds; the strongest, " +
           supports_text(strongest.supports, " deg") + ", does not: " + failing_text(strongest);
  }
  const SupportAt& best = design.at(*design.cheapest);
  return supports_text(best.supports, " deg") + ": " + money(plan, best.cost) +
         ", the cheapest that holds; " + margin_text(best);
}

}  // namespace

std::string design_text(const CasePlan& plan, const SupportDesign& design) {
  std::string out;
  const int realisations = plan.parts().realisations;
  for (const SupportAt& at : design.all)
    if (at.is_computed)
      out += "tried    " + supports_text(at.supports, " deg") + ", " + money(plan, at.cost) + ": " +
             (at.holds ? "holds; " + margin_text(at) : "does not hold: " + failing_text(at)) + "\n";
  out += "tunnels  " + std::to_string(design.computed() * realisations) + " computed of " +
         std::to_string(design.all.size() * static_cast<std::size_t>(realisations)) + ", " +
         std::to_string(realisations) + (realisations == 1 ? " realisation" : " realisations") +
         " each\n";
  out += "design   " + answer_text(plan, design) + "\n";
  if (!design.cheapest) return out;
  const SupportAt& best = design.at(*design.cheapest);
  if (best.broken.trials > 0) out += "broken   any criterion in " + best.broken.text() + "\n";
  for (const SupportPlace& place : design.surer) {
    const SupportAt& at = design.at(place);
    out +=
        "surer    " + supports_text(at.supports, " deg") + ": " + money(plan, at.cost) + " (+" +
        significant_text(at.cost - best.cost, 4) + "); " +
        (at.holds ? margin_text(at) : "does not hold, though it is stronger: " + failing_text(at)) +
        "\n";
  }
  return out;
}

std::string design_json(const CasePlan& plan, const SupportDesign& design) {
  using Json = nlohmann::ordered_json;
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  const auto support_json = [&](const SupportAt& at) {
    Json json = {{"bolt_spacing", at.supports.spacing ? spacing_text(at.supports.spacing, " deg")
                                                      : std::string("none")},
                 {"lining_thickness_cm", 100 * at.supports.thickness},
                 {"cost_per_m", at.cost},
                 {"computed", at.is_computed}};
    if (!at.is_computed) return json;
    json["holds"] = at.holds;
    json["undecided"] = at.undecided;
    json["broken"] = {{"events", at.broken.events}, {"of", at.broken.trials}};
    if (at.broken.trials > 0) {
      const Interval between = at.broken.interval();
      json["broken"]["low_95"] = between.low;
      json["broken"]["high_95"] = between.high;
    }
    Json criteria = Json::array();
    for (const CriterionAt& criterion : at.criteria)
      criteria.push_back({{"broken_by", criterion.what},
                          {"events", criterion.broken.events},
                          {"worst_over_limit", number(criterion.worst)}});
    json["criteria"] = std::move(criteria);
    return json;
  };
  Json all = Json::array(), surer = Json::array();
  for (const SupportAt& at : design.all) all.push_back(support_json(at));
  for (const SupportPlace& place : design.surer) surer.push_back(support_json(design.at(place)));
  const Json json = {
      {"schema", 1},
      {"program", std::string("voussoir ") + VOUSSOIR_VERSION_STRING},
      {"title", plan.input().title},
      {"tunnel_id", RunId("tunnel").add(plan.input()).text()},
      {"text", answer_text(plan, design)},
      {"currency", plan.input().costs->currency},
      {"realisations", plan.parts().realisations},
      {"design", design.cheapest ? support_json(design.at(*design.cheapest)) : Json()},
      {"surer", surer},
      {"supports", all}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string design_csv(const CasePlan& plan, const SupportDesign& design) {
  const DiagramInput& axes = *plan.input().diagram;
  CsvTable table({spacing_column(axes), "lining_thickness_cm", "cost_per_m", "computed", "holds",
                  "realisations_broken", "realisations_undecided", "nearest_criterion",
                  "nearest_of_its_limit", "recommended"},
                 6);
  for (const SupportAt& at : design.all) {
    const CriterionAt* const nearest = at.nearest();
    table.add_row(spacing_cell(at.supports.spacing), 1e2 * at.supports.thickness, at.cost,
                  at.is_computed ? 1 : 0, at.is_computed ? (at.holds ? "1" : "0") : "-",
                  at.is_computed ? std::to_string(at.broken.events) : "-",
                  at.is_computed ? std::to_string(at.undecided) : "-",
                  nearest != nullptr ? nearest->what : "-",
                  strength_cell(nearest != nullptr ? nearest->worst : none),
                  design.cheapest == at.place ? 1 : 0);
  }
  return table.text();
}

std::string design_svg(const CasePlan& plan, const SupportDesign& design) {
  const Input& input = plan.input();
  const DiagramInput& axes = *input.diagram;
  InteractionPicture picture;
  const auto columns = static_cast<Eigen::Index>(axes.thickness.size());
  const auto rows = static_cast<Eigen::Index>(axes.spacing.size());
  picture.values.resize(columns, rows);
  picture.failed.resize(columns, rows);
  picture.assumed.resize(columns, rows);
  for (const SupportAt& at : design.all) {
    const auto i = static_cast<Eigen::Index>(at.place.thickness),
               j = static_cast<Eigen::Index>(at.place.spacing);
    picture.values(i, j) = at.cost;
    picture.failed(i, j) = at.is_computed && !at.holds;
    picture.assumed(i, j) = !at.is_computed;
  }
  picture.failed_name = "does not hold";
  picture.computed_name = "holds";
  picture.diameter = 2 * input.tunnel.half_width();
  picture.thicknesses = axes.thickness;
  for (const auto& spacing : axes.spacing)
    picture.spacings.push_back(
        {spacing_text(spacing, "°"), spacing ? std::optional(spacing->value) : std::nullopt});
  picture.quantity = InteractionQuantity::in("cost", 1, input.costs->currency + "/m");
  picture.header.title =
      "Cheapest support that holds" + (input.title.empty() ? "" : ": " + input.title);
  const int realisations = plan.parts().realisations;
  std::string criteria;
  for (const DesignLimit& limit : limits_of(input))
    criteria += (criteria.empty() ? "" : ", ") + limit.what;
  picture.header.lines = {"Cost over lining thickness and bolt spacing. What holds has, in " +
                          (realisations == 1 ? "the realisation of the rock, no "
                           : input.criteria.probability
                               ? "no more than " + percent(*input.criteria.probability) + " of " +
                                     std::to_string(realisations) + " realisations, a "
                               : "none of " + std::to_string(realisations) + " realisations, a ") +
                          criteria +
                          ". Circles without filling follow from what was computed beside them."};
  if (design.cheapest) {
    const SupportAt& best = design.at(*design.cheapest);
    picture.chosen = {best.place.thickness, best.place.spacing};
    picture.header.key_numbers = {{"recommended", supports_text(best.supports, "°")},
                                  {"cost", money(plan, best.cost)}};
    if (const CriterionAt* const nearest = best.nearest())
      picture.header.key_numbers.push_back(
          {"nearest criterion", percent(nearest->worst) + " of its limit"});
  } else {
    picture.banner = {{"NO SUPPORT ON THE AXES HOLDS",
                       "the strongest does not: " + failing_text(design.strongest())}};
  }
  return draw_interaction_picture(picture);
}

}  // namespace voussoir::program
