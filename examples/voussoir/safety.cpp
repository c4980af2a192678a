// SPDX-License-Identifier: MIT
#include "safety.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <type_traits>
#include <voussoir/core/version.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/csv_table.hpp>
#include <voussoir/io/solved_picture.hpp>

#include "blocks_analysis.hpp"
#include "blocks_outputs.hpp"
#include "output_parts.hpp"
#include "plausibility.hpp"
#include "rock_loads.hpp"
#include "run_folder.hpp"

namespace voussoir::program {

namespace {

const char* word_of(TrialOutcome outcome) {  // in files
  switch (outcome) {
    case TrialOutcome::stands:
      return "stands";
    case TrialOutcome::falls:
      return "falls";
    case TrialOutcome::undecided:
      return "undecided";
  }
  return "undecided";
}

/// What a trial that falls is said to do.
std::string limit_text(const SafetySettings& settings) {
  if (settings.limit == SafetyLimit::collapse) return "where it collapses";
  const std::string rock = settings.tolerated_loss > 0
                               ? "where more than " + shortest_text(settings.tolerated_loss) +
                                     " m2 of rock per metre, or lining, comes off"
                               : "where any rock or lining comes off";
  return settings.limit == SafetyLimit::rockfall ? rock
                                                 : rock + ", or a support reaches its strength";
}

std::string factor_text(double factor) { return significant_text(factor, 4); }

/// Over the picture of what falls.
std::string mechanism_title(const Input& input, double factor) {
  return (input.title.empty() ? "Factor of safety" : input.title) +
         ": what falls with the strength of joints over " + factor_text(factor);
}

/// What falls, in 2-D or 3-D.
template <class Geometry>
std::string mechanism_picture(const Input& input, const TunnelAtFactor<Geometry>& falling) {
  TunnelPictureText words;
  words.title = mechanism_title(input, falling.factor);
  if constexpr (std::is_same_v<Geometry, Spatial>) {
    words.axes = {"right", "along", "up"};
    words.from = input.picture.from;
    words.strip_width = input.linings.empty() ? 0.0 : strip_width(input);
  } else {
    if (input.linings.size() == 1) words.lining_thickness = input.linings.front().thickness;
    words.loads = loads_in_section(input, falling.built.stages.size());
  }
  return draw_tunnel(falling.tunnel, falling.built, words);
}

/// @param standing  the model under the largest factor that stands; null: under none
template <class TunnelType>
LimitAnswer limit_beside(const FactorBracket& bracket, const TunnelType* standing,
                         const LawsBySet<AnyJoint>& laws, const Report& report) {
  if (standing == nullptr) {
    LimitAnswer none;
    none.reason = "not sought: nothing stands under any factor tried";
    return none;
  }
  return limit_of(*standing, laws, bracket.stands, report);
}

template <class Geometry>
SafetyAnswer answer_of(const Input& input, const SafetySettings& settings,
                       const TunnelSafety<Geometry>& safety) {
  SafetyAnswer answer;
  answer.bracket = safety.bracket;
  answer.unit = std::is_same_v<Geometry, Planar> ? "m2" : "m3";
  for (std::size_t k = 0; k < safety.results.size(); ++k) {
    const TunnelResult& result = safety.results[k];
    const FactorTrial& trial = safety.bracket.trials[k];
    // One that ended at the first block too many is no collapse.
    const bool ended_early = settings.limit != SafetyLimit::collapse && !result.failed &&
                             result.verdict == Verdict::collapse;
    answer.trials.push_back({trial.factor, trial.outcome,
                             ended_early ? "rock comes off" : result.word(), result.reason,
                             result.fallen, result.convergence.crown,
                             trial.outcome == TrialOutcome::falls && !result.failed &&
                                 result.verdict == Verdict::stable && !result.lost_lining &&
                                 result.fallen <= settings.tolerated_loss});
  }
  if (safety.falling && !safety.falling->built.stages.empty()) {
    answer.fallen = safety.falling->built.fallen_measure();
    answer.mechanism = mechanism_picture(input, *safety.falling);
  }
  return answer;
}

/// Every trial lays the blocks anew.
SafetyAnswer safety_of_blocks(const Input& input, const SafetySettings& settings, bool wants_limit,
                              const Report& report) {
  SafetyAnswer answer;
  std::optional<BlocksRun> standing, falling;
  const auto trial = [&](double factor) {
    Input weaker = input;
    weaker.joint = weakened(*input.joint, factor);
    weaker.run.out_of_balance = std::min(input.run.out_of_balance, 0.1 * settings.search.width);
    SafetyTrial& made = answer.trials.emplace_back();
    made.factor = factor;
    BlocksRun run = run_blocks(weaker, [&](const std::string&, double fraction) {
      return report("strength over " + factor_text(factor), fraction);
    });
    made.word = run.word();
    made.reason = run.last().reason;
    made.fallen = run.solver.fallen_measure();
    const bool keeps_all = made.word == "stands";
    // Half of the loads is not the loads.
    const bool is_loaded = !input.laid->has_loading() || run.reached == 1;
    const bool stands = run.last().verdict == Verdict::stable && is_loaded &&
                        (settings.limit == SafetyLimit::collapse || keeps_all ||
                         made.fallen <= settings.tolerated_loss);
    made.outcome = stands                                     ? TrialOutcome::stands
                   : run.last().verdict == Verdict::undecided ? TrialOutcome::undecided
                                                              : TrialOutcome::falls;
    (stands ? standing : falling) = std::move(run);
    return made.outcome;
  };
  answer.bracket = bracket_factor(trial, settings.search);
  if (falling) {
    answer.fallen = falling->solver.fallen_measure();
    Input titled = input;
    titled.title = mechanism_title(input, answer.bracket.falls);
    answer.mechanism = laid_blocks_svg(titled, *falling);
  }
  if (wants_limit)
    answer.limit =
        limit_beside(answer.bracket, standing ? &standing->solver : nullptr, *input.joint, report);
  return answer;
}

}  // namespace

std::string SafetyAnswer::text() const {
  const auto at_end = std::find_if(trials.begin(), trials.end(), [&](const SafetyTrial& trial) {
    return trial.factor == bracket.falls;
  });
  const bool is_of_support = at_end != trials.end() && at_end->is_of_support;
  if (bracket.stands == 0)
    return "less than " + factor_text(bracket.falls) +
           (is_of_support ? ": a support is at its strength" : ": falls") +
           " over every factor tried";
  if (std::isinf(bracket.falls))
    return "more than " + factor_text(bracket.stands) + ": stands over every factor tried";
  return significant_text(bracket.stands, 3) + ": stands over " + factor_text(bracket.stands) +
         (is_undecided()  ? ", not decided over "
          : is_of_support ? ", a support is at its strength over "
                          : ", falls over ") +
         factor_text(bracket.falls);
}

bool SafetyAnswer::is_undecided() const {
  return std::any_of(trials.begin(), trials.end(), [&](const SafetyTrial& trial) {
    return trial.factor == bracket.falls && trial.outcome == TrialOutcome::undecided;
  });
}

SafetyAnswer safety_of(const Input& input, const SafetySettings& settings, bool wants_limit,
                       const Report& report) {
  const auto start = std::chrono::steady_clock::now();
  const Progress blocks = [&](double fraction) { return report("blocks", fraction); };
  SafetyAnswer answer;
  std::vector<std::string> warnings;
  if (input.laid) {
    answer = safety_of_blocks(input, settings, wants_limit, report);
  } else if (input.is_spatial()) {
    const RockIn<Spatial> rock = described_spatial_rock(input, blocks);
    warnings = rock.warnings;
    const TunnelSafety<Spatial> safety = factor_of_safety(input, rock, settings, report);
    answer = answer_of(input, settings, safety);
    if (wants_limit)
      answer.limit =
          limit_beside(answer.bracket, safety.standing ? &safety.standing->tunnel : nullptr,
                       laws_of(input), report);
  } else {
    const RockIn<Planar> rock = described_rock(input, blocks);
    warnings = rock.warnings;
    const TunnelSafety<Planar> safety = factor_of_safety(input, rock, settings, report);
    answer = answer_of(input, settings, safety);
    if (wants_limit)
      answer.limit =
          limit_beside(answer.bracket, safety.standing ? &safety.standing->tunnel : nullptr,
                       laws_of(input), report);
  }
  for (std::string& value : warnings_about_values(input)) warnings.push_back(std::move(value));
  if (answer.is_undecided())
    warnings.push_back("no verdict was found over " + factor_text(answer.bracket.falls) +
                       ", which counts as a factor under which it falls");
  answer.warnings = std::move(warnings);
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return answer;
}

std::string safety_text(const SafetySettings& settings, const SafetyAnswer& answer) {
  std::string out;
  for (const SafetyTrial& trial : answer.trials) {
    std::string factor = factor_text(trial.factor);
    factor.resize(std::max<std::size_t>(factor.size(), 7), ' ');
    out += "strength over " + factor + std::string(" ") +
           (trial.is_of_support ? "exceeds" : word_of(trial.outcome)) + ": " + trial.word;
    if (std::isfinite(trial.crown)) out += ", crown " + millimetres_text(trial.crown) + " mm";
    if (trial.fallen > 0) out += text(", %.3g m2 detached", trial.fallen);
    out += "\n";
  }
  out += "safety   " + answer.text() + text(" (in %.1f s)\n", answer.seconds);
  out += std::string("falls    ") + limit_text(settings) +
         (settings.from_start ? ", each factor from the in-situ state on"
                              : ", strength divided where it stood under a smaller factor") +
         (settings.with_supports ? "; strength of supports divided too\n" : "\n");
  if (answer.fallen > 0)
    out += text("detached %.3g ", answer.fallen) + answer.unit + " with strength over " +
           factor_text(answer.bracket.falls) + "\n";
  out += limit_text(answer.limit, answer.bracket.stands);
  for (const std::string& warning : answer.warnings) out += "warning  " + warning + "\n";
  return out;
}

std::string safety_json(const Input& input, const SafetySettings& settings,
                        const SafetyAnswer& answer) {
  using Json = nlohmann::ordered_json;
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  Json trials = Json::array();
  for (const SafetyTrial& trial : answer.trials)
    trials.push_back({{"factor", trial.factor},
                      {"outcome", word_of(trial.outcome)},
                      {"verdict", trial.word},
                      {"reason", trial.reason},
                      {"detached_m2_per_m", trial.fallen},
                      {"crown_mm", number(1e3 * trial.crown)}});
  const Json json = {
      {"schema", 1},
      {"program", std::string("voussoir ") + VOUSSOIR_VERSION_STRING},
      {"title", input.title},
      {"tunnel_id", RunId(input.laid ? "blocks" : "tunnel").add(input).text()},
      {"factor_of_safety", answer.bracket.stands > 0 ? Json(answer.bracket.stands) : Json()},
      {"text", answer.text()},
      {"stands_over", answer.bracket.stands > 0 ? Json(answer.bracket.stands) : Json()},
      {"falls_over", number(answer.bracket.falls)},
      {"is_decided", !answer.is_undecided()},
      {"falls_where", to_string(settings.limit)},
      {"tolerated_loss_m2_per_m", settings.tolerated_loss},
      {"from_start", settings.from_start},
      {"supports_divided", settings.with_supports},
      {"width_percent", 100 * settings.search.width},
      {"mechanism", {{"detached_" + answer.unit, answer.fallen}}},
      {"limit_load", limit_json(answer.limit)},
      {"trials", trials},
      {"warnings", answer.warnings},
      {"seconds", answer.seconds}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string safety_csv(const SafetyAnswer& answer) {
  CsvTable table(
      {"factor", "outcome", "verdict", "detached_area_m2_per_m", "crown_convergence_mm", "reason"},
      6);
  for (const SafetyTrial& trial : answer.trials)
    table.add_row(trial.factor, word_of(trial.outcome), trial.word, trial.fallen, 1e3 * trial.crown,
                  trial.reason);
  return table.text();
}

}  // namespace voussoir::program
