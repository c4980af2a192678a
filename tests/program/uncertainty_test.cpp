// SPDX-License-Identifier: MIT
// Keys with a distribution: read, drawn, counted; which of them decides, and when it is enough.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/statistics/confidence.hpp>
#include <voussoir/statistics/rank_correlation.hpp>

#include "case_outputs.hpp"
#include "case_plan.hpp"
#include "case_uncertainty.hpp"
#include "case_work.hpp"
#include "harness.hpp"
#include "support/near.hpp"

namespace program_uncertainty_test {

using namespace voussoir_test;
using namespace voussoir::program;
using voussoir::Verdict;

namespace {

/// Three keys that are not known, and a lining and bolts that some tunnels do not need.
std::string uncertain_input() {
  std::string text = replaced(small_input(), "friction = \"35 deg\"",
                              "friction = {mean = \"32 deg\", sd = \"4 deg\", min = \"20 deg\"}");
  text = replaced(text, "K0 = 1.0", "K0 = {min = 0.5, mode = 1, max = 1.5}");
  text = replaced(text, "spacing = \"30 deg\"", "spacing = {min = \"25 deg\", max = \"45 deg\"}");
  return text + "[criteria]\nconvergence = \"0.09 mm\"\nprobability = \"20 %\"\n";
}

PlanParts parts_of(const std::string& text, int realisations,
                   PlanVerb verb = PlanVerb::realisations) {
  return {.verb = verb,
          .file = "case.toml",
          .text = text,
          .directory = ".",
          .overrides = {},
          .realisations = realisations};
}

/// The files that it wrote for people: without journal and plan.
std::map<std::string, std::string> results_in(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const char* const name : {"realisations.csv", "realisations.json", "realisations.svg"})
    files[name] = read_file(folder + "/" + name);
  return files;
}

std::size_t cases_computed(const std::string& folder) {
  std::size_t count = 0;
  for (const auto& [path, text] : contents(folder)) {
    if (!path.ends_with(".jsonl")) continue;
    if (const auto journal = voussoir::read_journal(path)) count += journal->entries.size();
  }
  return count;
}

/// Columns of a table by name; no cell of ours has a comma in it before those that are read.
std::map<std::string, std::vector<std::string>> columns_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::string>> columns;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::size_t k = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++k)
      if (names.size() == k && columns.size() == k && line.find("seed,") != std::string::npos) {
        names.push_back(cell);
        columns[cell];
      } else if (k < names.size()) {
        columns[names[k]].push_back(cell);
      }
  }
  return columns;
}

TunnelResult standing(double crown, double fallen = 0) {
  TunnelResult r;
  r.verdict = Verdict::stable;
  r.convergence.crown = crown;
  r.fallen = fallen;
  return r;
}
TunnelResult with_verdict(Verdict verdict) {
  TunnelResult r;
  r.verdict = verdict;
  return r;
}

}  // namespace

TEST_SUITE("program/uncertainty") {
  TEST_CASE("a distribution stands at its median, in the unit that it is written in") {
    const auto read = [](const std::string& key, const std::string& value) {
      return read_input_text(small_input(), "case.toml", ".", {key + "=" + value});
    };
    // Of a normal distribution, cut off at one side: 30 + 5 z where half of what is left is below.
    CHECK(read("joint.friction", R"({mean = "30 deg", sd = "5 deg"})").joint_law.at("friction") ==
          near(30 * std::numbers::pi / 180).epsilon(1e-14));
    CHECK(read("joint.friction", R"({mean = "30 deg", sd = "0.05 rad"})")
              .uncertain.at(0)
              .distribution.high() == near(30 + 4 * 0.05 * 180 / std::numbers::pi).epsilon(1e-14));
    const Input lognormal =
        read("joint.kn", R"({mean = "5 GPa/m", sd = "1000 MPa/m", distribution = "lognormal"})");
    CHECK(lognormal.joint_law.at("kn") == near(5e9 / std::sqrt(1.04)).epsilon(1e-6));
    CHECK(lognormal.uncertain.at(0).unit == "GPa/m");
    CHECK(read("stress.K0", "{min = 0.5, max = 1}").stress.K0 == 0.75);
    CHECK(read("stress.K0", "{min = 0, mode = 1, max = 3}").stress.K0 ==
          near(3 - std::sqrt(3.0)).epsilon(1e-6));
    // Readers of their own: an angle or a length, a list.
    CHECK(
        read("support.bolts.spacing", R"({min = "1 m", max = "2 m"})").bolts.at(0).spacing.value ==
        1.5);
    const Input arc = read("support.bolts.arc", R"([{min = "10 deg", max = "30 deg"}, "170 deg"])");
    CHECK(arc.uncertain.at(0).key == "support.bolts.arc[0]");
    CHECK(arc.bolts.at(0).arc.from == near(20 * std::numbers::pi / 180).epsilon(1e-14));
    CHECK(read("joint_set[0].dip", R"({mean = "70 deg", sd = "3 deg"})").uncertain.at(0).key ==
          "joint_set[0].dip");
    // Under a header of its own.
    const std::string text = replaced(small_input(), "friction = \"35 deg\"", "") +
                             "[joint.friction]\nmin = \"30 deg\"\nmax = \"40 deg\"\n";
    CHECK(read_input_text(text, "case.toml", ".").uncertain.at(0).written ==
          "uniform, min 30 deg, max 40 deg");
    // The content has the distribution, not its median: another one is another run.
    const auto content = read("stress.K0", "{min = 0.5, max = 1}").content;
    CHECK(std::find(content.begin(), content.end(), "stress.K0.min = 0.5") != content.end());
  }

  TEST_CASE("what is no distribution, or reaches what cannot be: key, value and what is accepted") {
    struct Fault {
      std::string set, message, accepted;
    };
    for (const Fault& fault : {
             Fault{R"(joint.friction={mean="5 deg",sd="3 deg"})", "reaches -7 deg",
                   "0 to below 90"},
             {R"(joint.friction={mean="80 deg",sd="3 deg"})", "reaches 92 deg", "min and max cut"},
             {R"(joint.friction={mean="35 deg",sd="0 deg"})",
              "joint.friction.sd = \"0 deg\" is not", "above 0"},
             {R"(joint.friction={mean="35 deg",sd="-1 deg"})", "is not above 0", "above 0"},
             {R"(joint.friction={mean="35 deg",sd="3 m"})", "another dimension", "{mean, sd}"},
             {R"(joint.friction={mean="35 deg",sd=3})", "joint.friction.sd = 3 has no unit", ""},
             {R"(joint.friction={mean="35 deg",sd=true})", "neither a number nor", ""},
             {R"(joint.friction={min="35 deg",max="30 deg"})", "is not below max = 30 deg",
              "below 30 deg"},
             {R"(joint.friction={mean="50 deg",sd="3 deg",max="45 deg"})",
              "joint.friction.mean = \"50 deg\" lies outside", "to 45 deg"},
             {R"(joint.friction={mode="50 deg",min="3 deg",max="45 deg"})",
              "joint.friction.mode = \"50 deg\" lies outside", "from 3 deg to 45 deg"},
             {R"(joint.friction={mean="35 deg",std="3 deg"})", "did you mean `sd`?", "{mean, sd}"},
             {R"(joint.friction={mean="35 deg"})", "lacks sd", "{mean, sd}"},
             {R"(joint.friction={min="35 deg"})", "lacks max", "{min, max} uniform"},
             {R"(joint.friction={mode="30 deg",min="20 deg",max="40 deg",sd="3 deg"})",
              "lacks mean", ""},
             {R"(joint.friction={mean="3 deg",sd="3 deg",distribution="weibull"})", "none that is",
              "\"lognormal\""},
             {R"(stress.K0={mean=-1,sd=0.1,distribution="lognormal"})", "stress.K0.mean = -1",
              "above 0"},
             {R"(stress.K0={mean=1,sd=0.1,min=-1,distribution="lognormal"})", "stress.K0.min = -1",
              "0 or more"},
             {R"(stress.K0={mean=1,sd=0.4})", "reaches -0.6,", "from 0 to 10"},
             {R"(joint.kn={mean="26 deg",sd="1 deg"})", "is an angle, not", ""},
             {"model.seed={min=1,max=5}", "is a distribution, not a whole number", ""},
             {"title={min=1,max=3}", "is a distribution, not a text", ""},
             {R"(support.bolts.spacing={min="0 deg",max="20 deg"})", "reaches 0 deg", "0.1 deg"},
             {"criteria.utilisation=1", "is of linings, and none has a strength", "concrete"},
             {"criteria.probability=1", "is outside the accepted range", "below"},
         }) {
      CAPTURE(fault.set);
      try {
        (void)read_input_text(small_input(), "case.toml", ".", {fault.set});
        FAIL("it was accepted");
      } catch (const InputErrors& errors) {
        const InputError& first = errors.errors().at(0);
        CAPTURE(first.message);
        CHECK(first.key.starts_with(fault.set.substr(0, fault.set.find('='))));
        CHECK(first.message.find(fault.message) != std::string::npos);
        CHECK(first.accepted.find(fault.accepted) != std::string::npos);
      }
    }
    // In a file: at the line of the part.
    const std::string text = replaced(small_input(), "K0 = 1.0", "K0 = {min = 2, max = 1}");
    try {
      (void)read_input_text(text, "case.toml", ".");
      FAIL("it was accepted");
    } catch (const InputErrors& errors) {
      CHECK(errors.errors()[0].message == "stress.K0.min = 2 is not below max = 1");
      CHECK(errors.errors()[0].source_line == "K0 = {min = 2, max = 1}");
    }
  }

  TEST_CASE("a realisation is a seed and a point, whatever else is asked for") {
    const CasePlan ten(parts_of(uncertain_input(), 10)), four(parts_of(uncertain_input(), 4));
    REQUIRE(ten.uncertain().size() == 3);
    std::set<std::string> names;
    for (std::size_t k = 0; k < 10; ++k) {
      names.insert(ten.name(k));
      if (k < 4) CHECK(ten.name(k) == four.name(k));
    }
    CHECK(names.size() == 10);
    CHECK(ten.work_id() == four.work_id());
    // One in each tenth of every key.
    for (std::size_t key = 0; key < 3; ++key) {
      std::set<int> tenths;
      for (std::size_t k = 0; k < 10; ++k)
        tenths.insert(static_cast<int>(
            10 * ten.uncertain()[key].distribution.probability_below(ten.at(k).drawn[key])));
      CHECK(tenths.size() == 10);
    }
    // The input of a case is that of the values set by hand, and so is its name.
    const Case third = ten.at(2);
    PlanParts by_hand = parts_of(uncertain_input(), 1);
    for (std::size_t key = 0; key < 3; ++key)
      by_hand.overrides.push_back(ten.uncertain()[key].key + "=" +
                                  ten.uncertain()[key].text_of(third.drawn[key]));
    by_hand.overrides.push_back("model.seed=" + std::to_string(third.seed));
    CHECK(CasePlan(by_hand).name(0) == ten.name(2));
    // What is drawn of one key does not hang on the others, on how they are called or varied.
    const auto other =
        replaced(uncertain_input(), "K0 = {min = 0.5, mode = 1, max = 1.5}", "K0 = 1");
    const CasePlan fewer(parts_of(other, 10));
    REQUIRE(fewer.uncertain().size() == 2);
    CHECK(fewer.at(7).drawn[0] == ten.at(7).drawn[0]);
    // Criteria name no case: what was computed stays when they change.
    const CasePlan stricter(parts_of(
        replaced(uncertain_input(), "convergence = \"0.09 mm\"", "convergence = \"0.08 mm\""), 10));
    CHECK(stricter.name(5) == ten.name(5));
    CHECK(stricter.run_id() != ten.run_id());
    PlanParts random = parts_of(uncertain_input(), 10);
    random.sampling = Sampling::random;
    CHECK(CasePlan(random).name(5) != ten.name(5));
    CHECK(CasePlan(random).work_id() != ten.work_id());
  }

  TEST_CASE("one tunnel of a sweep or a diagram has the medians, several are drawn") {
    PlanParts parts = parts_of(uncertain_input(), 1, PlanVerb::sweep);
    parts.varied = {{"joint.friction", {"30 deg", "35 deg"}}};
    const CasePlan one(parts);
    CHECK(one.uncertain().empty());
    CHECK(one.input_of(one.at(1)).stress.K0 == 1);
    parts.realisations = 3;
    const CasePlan several(parts);
    REQUIRE(several.uncertain().size() == 2);  // what is varied is not drawn
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(several.at(k).drawn == several.at(k + 3).drawn);
      CHECK(several.input_of(several.at(k + 3)).joint_law.at("friction") ==
            near(35 * std::numbers::pi / 180).epsilon(1e-14));
    }
    CHECK(CasePlan(parts_of(uncertain_input(), 3, PlanVerb::diagram)).uncertain().size() == 3);
  }

  TEST_CASE(
      "probabilities by hand: what collapses is beyond every limit, what failed is no trial") {
    const Input input = read_input_text(uncertain_input(), "case.toml", ".");
    TunnelResult broken = standing(5e-5);
    broken.failed = true;
    TunnelResult torn = standing(5e-5);
    torn.of_bolt_strength = 1.2;
    TunnelResult held = standing(5e-5);
    held.of_bolt_strength = 0.7;
    TunnelResult shed = standing(std::numeric_limits<double>::quiet_NaN(), 0.3);  // the crown's own
    shed.of_bolt_strength = 0.1;
    const std::vector<TunnelResult> results{held,
                                            torn,
                                            shed,
                                            broken,
                                            with_verdict(Verdict::collapse),
                                            with_verdict(Verdict::undecided)};
    const auto events = unwanted_events(input, results);
    const auto share_of = [&](const std::string& what) {
      for (const UnwantedEvent& event : events)
        if (event.what == what) return event.share;
      FAIL("no event ", what);
      return Share{};
    };
    CHECK(events.size() == 5);
    for (const UnwantedEvent& event : events) CHECK(event.share.trials == 4);
    CHECK(share_of("rockfall").events == 2);
    CHECK(share_of("collapse").events == 1);
    CHECK(share_of("crown convergence above 0.09 mm").events == 2);
    CHECK(share_of("bolt utilisation above 1").events == 2);
    CHECK(share_of("any of these").events == 3);
    CHECK(widest_interval(events) ==
          near(voussoir::probability_interval(2, 4).width()).epsilon(1e-15));
    CHECK(probability_text(input.criteria, events).find("not known to be kept") !=
          std::string::npos);
    // 0 of 40: at most 8.81 %, below 20 %; 40 of 40 above.
    const std::vector<TunnelResult> good(40, held), bad(40, torn);
    CHECK(probability_text(input.criteria, unwanted_events(input, good))
              .find("is kept with 95 % confidence: 0 to 8.81 %") != std::string::npos);
    CHECK(probability_text(input.criteria, unwanted_events(input, bad)).find("is not kept") !=
          std::string::npos);
    CHECK(more_realisations_text(unwanted_events(input, good)) ==
          "widest interval: 8.81 percentage points (rockfall); 5 would take about 72 realisations, "
          "2 about 183\n");
    // Without criteria there is no "any of these".
    CHECK(unwanted_events(read_input_text(small_input(), "case.toml", "."), good).size() == 3);
  }

  TEST_CASE("what to measure next: the key that decides comes first, the others not by chance") {
    const CasePlan plan(parts_of(uncertain_input(), 50));
    std::vector<TunnelResult> results;
    std::vector<double> friction, rest;
    for (std::size_t k = 0; k < plan.size(); ++k) {
      const Case c = plan.at(k);
      friction.push_back(c.drawn[0]);
      // Steep in the friction, a little of the spacing, none of K0; the weakest collapse.
      results.push_back(standing(1e-3 * std::exp(-0.2 * c.drawn[0]) + 1e-8 * c.drawn[2]));
      rest.push_back(-results.back().convergence.crown);
      if (c.drawn[0] < 26) {
        results.back() = with_verdict(Verdict::collapse);
        rest.back() = -1;
      }
    }
    const Influences found = influences(plan, results);
    REQUIRE(found.keys.size() == 3);
    CHECK(found.realisations == 50);
    CHECK(found.limit == voussoir::rank_correlation_limit(50));
    CHECK(found.keys[0].key == "joint.friction");
    CHECK(found.outcomes[0] == "crown convergence");
    CHECK(found.keys[0].correlations[0] ==
          near(-voussoir::rank_correlation(friction, rest)).epsilon(1e-14));
    CHECK(found.keys[0].correlations[0] < -0.9);
    for (const KeyInfluence& key : found.keys)
      if (key.key == "stress.K0") CHECK(std::abs(key.correlations[0]) < found.limit);
    CHECK(found.explained[0] > 0.9);
    const std::string text = found.text();
    CAPTURE(text);
    CHECK(text.find("joint.friction") < text.find("stress.K0"));
    CHECK(text.find("beyond +-0.28 (*)") != std::string::npos);
  }

  TEST_CASE("realisations: every row is the tunnel of its values, and the table is counted right") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", uncertain_input());
    const Outcome outcome =
        run_program({"realisations", file, "-n", "20", "--out", folder / "out", "-j", "1"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto columns = columns_of(read_file(folder / "out/realisations.csv"));
    REQUIRE(columns.at("seed").size() == 20);
    for (const std::size_t k : std::vector<std::size_t>{0, 13}) {
      const Outcome alone = run_program(
          {"run", file, "--out", folder / "alone", "--set",
           "joint.friction=" + columns.at("joint.friction_deg")[k] + " deg", "--set",
           "stress.K0=" + columns.at("stress.K0")[k], "--set",
           "support.bolts.spacing=" + columns.at("support.bolts.spacing_deg")[k] + " deg", "--set",
           "model.seed=" + columns.at("seed")[k], "--json"});
      CAPTURE(alone.err);
      const auto json = nlohmann::json::parse(alone.out);
      CHECK(voussoir::significant_text(json.at("convergence").at("crown_mm").get<double>(), 6) ==
            columns.at("crown_convergence_mm")[k]);
      CHECK(alone.out.find("distribution") == std::string::npos);
    }
    const auto json = nlohmann::json::parse(read_file(folder / "out/realisations.json"));
    int above = 0;
    for (const std::string& crown : columns.at("crown_convergence_mm"))
      above += std::stod(crown) > 0.09;
    bool is_counted = false;
    for (const auto& event : json.at("probabilities"))
      if (event.at("event") == "crown convergence above 0.09 mm") {
        CHECK(event.at("probability").at("events") == above);
        CHECK(event.at("probability").at("of") == 20);
        is_counted = true;
      }
    CHECK(is_counted);
    MESSAGE(above, " of 20 above the limit");
    std::vector<double> friction, crown;
    for (std::size_t k = 0; k < 20; ++k) {
      friction.push_back(std::stod(columns.at("joint.friction_deg")[k]));
      crown.push_back(std::stod(columns.at("crown_convergence_mm")[k]));
    }
    // Of six digits in the table: a tie of two of them would move it by 1e-3.
    CHECK(json.at("uncertain_keys")
              .at("keys")[0]
              .at("rank_correlations")
              .at("crown convergence")
              .get<double>() == near(voussoir::rank_correlation(friction, crown)).epsilon(1e-3));
    CHECK(outcome.out.find("drawn    joint.friction: normal, mean 32 deg, sd 4 deg, min 20 deg") !=
          std::string::npos);
    CHECK(outcome.out.find("measure next: rank correlations of 20 realisations") !=
          std::string::npos);
  }

  TEST_CASE("it grows, in chunks and by threads, to the same bytes") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", uncertain_input());
    const auto grown = [&](const std::string& out, const std::string& count,
                           const std::vector<std::string>& more = {}) {
      std::vector<std::string> arguments{"realisations", file, "-n", count, "--out", out};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = run_program(arguments);
      CAPTURE(outcome.err);
      REQUIRE(outcome.status == 0);
      return outcome;
    };
    (void)grown(folder / "out", "5", {"-j", "1"});
    (void)grown(folder / "out", "12", {"-j", "3"});
    CHECK(cases_computed(folder / "out") == 12);
    (void)grown(folder / "at once", "12", {"-j", "1"});
    CHECK(results_in(folder / "out") == results_in(folder / "at once"));
    (void)grown(folder / "parts", "12", {"--plan", "slurm", "--chunks", "3"});
    for (const char* const chunk : {"3/3", "1/3", "2/3"})
      REQUIRE(run_program({"case", folder / "parts", "--chunk", chunk}).status == 0);
    REQUIRE(run_program({"merge", folder / "parts"}).status == 0);
    CHECK(results_in(folder / "parts") == results_in(folder / "at once"));
    // Other criteria are other results of the same tunnels; other points are other tunnels.
    (void)grown(folder / "out", "12", {"--set", "criteria.convergence=0.08 mm"});
    CHECK(cases_computed(folder / "out") == 12);
    const Outcome other = run_program(
        {"realisations", file, "-n", "12", "--out", folder / "out", "--sampling", "random"});
    CHECK(other.status == 1);
    CHECK(other.err.find("--sampling = random, was not there") != std::string::npos);
  }

  TEST_CASE("it stops by itself where the interval is narrow enough, whoever computes") {
    const Folder folder;
    const std::string file =
        write_file(folder / "case.toml", replaced(uncertain_input(), "\"0.09 mm\"", "\"1 m\""));
    const auto run = [&](const std::string& out, const std::string& threads,
                         const std::string& width, const std::string& most) {
      const Outcome outcome = run_program({"realisations", file, "-n", most, "--out", folder / out,
                                           "-j", threads, "--until-width", width});
      CAPTURE(outcome.err);
      CHECK(outcome.status == 0);
      return outcome.out;
    };
    // Nothing happens: 0 of 10 is 30.8 percentage points wide, 0 of 20 is 16.8.
    const std::string said = run("one", "1", "25", "100");
    CAPTURE(said);
    CHECK(said.find("enough   20 realisations: the widest interval has 16.8") == 0);
    CHECK(cases_computed(folder / "one") == 20);
    (void)run("three", "3", "25", "100");
    CHECK(results_in(folder / "one") == results_in(folder / "three"));
    const Outcome plain =
        run_program({"realisations", file, "-n", "20", "--out", folder / "plain"});
    CHECK(plain.status == 0);
    CHECK(results_in(folder / "one") == results_in(folder / "plain"));
    // Again, and narrower: what is there is not computed again.
    CHECK(run("one", "1", "25", "100") == said);
    CHECK(cases_computed(folder / "one") == 20);
    CHECK(run("one", "2", "12", "25").find("not enough   25 realisations") == 0);
    CHECK(cases_computed(folder / "one") == 25);
    const Outcome planned = run_program({"realisations", file, "-n", "20", "--out", folder / "p",
                                         "--until-width", "10", "--plan", "slurm"});
    CHECK(planned.status == 2);
    CHECK(planned.err.find("do not know each other's results") != std::string::npos);
  }

  TEST_CASE("verbs of one tunnel take the medians, and say so") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", uncertain_input());
    for (const std::string verb : {"run", "check", "grc", "blocks"}) {
      CAPTURE(verb);
      const Outcome outcome = run_program({verb, file, "--out", folder / verb});
      CAPTURE(outcome.err);
      CAPTURE(outcome.out);
      CHECK(outcome.status == 0);
      CHECK(outcome.out.find("keys with a distribution are at their medians: joint.friction = ") !=
            std::string::npos);
      CHECK(outcome.out.find("stress.K0 = 1, support.bolts.spacing = 35 deg") != std::string::npos);
    }
  }

  TEST_CASE("a combination that does not fit together is named with its values") {
    // Bolts of a length that some realisations end outside of the ground.
    const std::string text =
        replaced(small_input(), "length = \"2 m\"", "length = {min = \"2 m\", max = \"20 m\"}");
    try {
      const CasePlan plan(parts_of(text, 10));
      FAIL("it was accepted");
    } catch (const std::exception& error) {
      const std::string message = error.what();
      CAPTURE(message);
      CHECK(message.find("in the case support.bolts.length=") != std::string::npos);
      CHECK(message.find("seed ") != std::string::npos);
    }
  }
}

}  // namespace program_uncertainty_test
