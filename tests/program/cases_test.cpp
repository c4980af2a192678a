// SPDX-License-Identifier: MIT
// Long work as cases: the same results whoever computes them, in whatever order and however often
// it is killed.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/statistics/sample.hpp>

#include "case_plan.hpp"
#include "case_statistics.hpp"
#include "case_work.hpp"
#include "harness.hpp"
#include "support/near.hpp"

namespace program_cases_test {

using namespace voussoir_test;
using namespace voussoir::program;
using voussoir::InvalidInput;
using voussoir::Verdict;

namespace {

namespace fs = std::filesystem;

std::vector<std::string> sweep(const std::string& file, const std::string& out,
                               const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"sweep",  file,
                                        "--out",  out,
                                        "--vary", "support.bolts.spacing=30 deg, 60 deg",
                                        "--vary", "joint.friction=30..40 deg:3",
                                        "-n",     "3"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// The files of results in a folder, by name: neither journals nor plans.
std::map<std::string, std::string> results_in(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& [path, text] : contents(folder)) {
    const std::string name = fs::path(path).filename().string();
    if (fs::path(path).parent_path() == fs::path(folder) && fs::is_regular_file(path) &&
        !name.ends_with(".plan.json") && name.find(".joints") == std::string::npos &&
        !name.starts_with("."))
      files[name] = text;
  }
  return files;
}

/// Lines of cases in all journals of a folder, by name of the case.
std::map<std::string, int> finished_in(const std::string& folder) {
  std::map<std::string, int> counts;
  for (const auto& [path, text] : contents(folder)) {
    if (!path.ends_with(".jsonl")) continue;
    if (const auto journal = voussoir::read_journal(path))
      for (const auto& entry : journal->entries) ++counts[entry.name];
  }
  return counts;
}

PlanParts parts_of(PlanVerb verb, const std::string& text, std::vector<VariedKey> varied = {},
                   int realisations = 1) {
  return {.verb = verb,
          .file = "case.toml",
          .text = text,
          .directory = ".",
          .overrides = {},
          .varied = std::move(varied),
          .realisations = realisations};
}

}  // namespace

TEST_SUITE("program/cases") {
  TEST_CASE("values are lists or ranges, and what is neither is refused in a sentence") {
    CHECK(varied_key("a.b=1, 2 ,3").values == std::vector<std::string>{"1", "2", "3"});
    CHECK(varied_key(" a.b = [\"0 deg\", \"9 deg\"], [\"1 deg\", \"2 deg\"]").values ==
          std::vector<std::string>{"[\"0 deg\", \"9 deg\"]", "[\"1 deg\", \"2 deg\"]"});
    CHECK(varied_key("k=\"a, b\"").values == std::vector<std::string>{"\"a, b\""});
    CHECK(varied_key("k=10..30 cm:5").values ==
          std::vector<std::string>{"10 cm", "15 cm", "20 cm", "25 cm", "30 cm"});
    CHECK(varied_key("k=0.1..0.4:4").values ==
          std::vector<std::string>{"0.1", "0.2", "0.3", "0.4"});  // not 0.30000000000000004
    CHECK(varied_key("k=1..-1 m:3").values == std::vector<std::string>{"1 m", "0 m", "-1 m"});
    const std::map<std::string, std::string> faulty{{"k", "no `=`"},
                                                    {"=1", "no key"},
                                                    {"k=", "a value is empty"},
                                                    {"k=1,,2", "a value is empty"},
                                                    {"k=1,1", "stands there twice"},
                                                    {"k=1..2", "how many values"},
                                                    {"k=1..2:1", "2 to 10000"},
                                                    {"k=1..2:2.5", "2 to 10000"},
                                                    {"k=1..1:3", "different numbers"},
                                                    {"k=1..m:3", "ends with a number"},
                                                    // 1, 1.5, 2 or 1, 0.6, 0.2: it reads two ways
                                                    {"k=1...2:3", "two dots between its ends"}};
    for (const auto& fault : faulty) {
      CAPTURE(fault.first);
      CHECK_THROWS_WITH_AS((void)varied_key(fault.first), doctest::Contains(fault.second.c_str()),
                           InvalidInput);
    }
  }

  TEST_CASE("every case has a name of its own, and the same one in every plan") {
    const std::string text = small_input();
    const VariedKey friction{"joint.friction", {"30 deg", "35 deg"}};
    const VariedKey thickness{"support.lining.thickness", {"8 cm", "10 cm"}};
    const CasePlan one(parts_of(PlanVerb::sweep, text, {friction, thickness}, 3));
    const CasePlan other(parts_of(PlanVerb::sweep, text, {thickness, friction}, 5));
    REQUIRE(one.size() == 12);
    REQUIRE(other.size() == 20);
    std::map<std::string, std::string> names;
    for (std::size_t k = 0; k < other.size(); ++k) {
      const Case c = other.at(k);
      CHECK(names.emplace(other.name(k), c.overrides[1] + c.overrides[0] + std::to_string(c.seed))
                .second);
    }
    for (std::size_t k = 0; k < one.size(); ++k) {
      const Case c = one.at(k);
      CHECK(names[one.name(k)] == c.overrides[0] + c.overrides[1] + std::to_string(c.seed));
    }
    // 35 deg and 8 cm are the file's own values: the realisations of it have the same names.
    const CasePlan plain(parts_of(PlanVerb::realisations, text, {}, 3));
    std::set<std::string> of_file;
    for (std::size_t k = 0; k < plain.size(); ++k) of_file.insert(plain.name(k));
    CHECK(of_file.size() == 3);
    CHECK(one.run_id() != other.run_id());
    CHECK(CasePlan(parts_of(PlanVerb::sweep, "# a remark\n" + text, {friction, thickness}, 3))
              .run_id() == one.run_id());
  }

  TEST_CASE("a key that is set and varied, or varied twice, is refused: one would not count") {
    PlanParts parts = parts_of(PlanVerb::sweep, small_input(), {{"joint.kn", {"4 GPa/m"}}});
    parts.overrides = {"stress.K0=1.2", "joint.ks=1 GPa/m"};
    CHECK(CasePlan(parts).at(0).overrides == std::vector<std::string>{"joint.kn=4 GPa/m"});
    const auto refused = [&](const std::string& set, const std::string& varied,
                             const std::string& words) {
      CAPTURE(set);
      CAPTURE(varied);
      PlanParts both = parts;
      both.overrides.push_back(set);
      both.varied.push_back({varied, {"1"}});
      CHECK_THROWS_WITH_AS(CasePlan{both}, doctest::Contains(words.c_str()), InvalidInput);
    };
    refused(" joint.kn = 3 GPa/m", "stress.surcharge",
            "--vary joint.kn: --set  joint.kn = 3 GPa/m gives the same key a value");
    refused("joint_set[01].dip=30 deg", "joint_set[1].dip", "gives the same key a value");
    refused("joint_set[1].dip=30 deg", "joint_set", "gives the same key a value");
    refused("title=x", "joint.kn", "is given twice");
    refused("title=x", "joint", "give the same key a value");
  }

  TEST_CASE("a case is named by what its own file of joints holds, wherever that lies") {
    const Folder folder;
    const std::string text = small_input();
    write_file(folder / "a.csv", "-9,3,9,3\n");
    write_file(folder / "b.csv", "-9,-3,9,-2\n");
    write_file(folder / "copy of a.csv", "-9,3,9,3\n");
    const auto plan_of = [&](const std::vector<std::string>& files, const std::string& base = "") {
      PlanParts parts = parts_of(
          PlanVerb::sweep,
          base.empty()
              ? text
              : replaced(text, "[joint]\n", "[joints]\nfile = \"" + base + "\"\n[joint]\n"),
          {{"joints.file", files}});
      parts.directory = voussoir::utf8_path(folder / "");
      return CasePlan(parts);
    };
    const CasePlan both = plan_of({"a.csv", "b.csv"});
    CHECK(both.name(0) != both.name(1));
    REQUIRE(both.files().size() == 2);
    CHECK(both.files()[0].hash != both.files()[1].hash);
    // The other order, another base file that no case reads, another name of the same joints.
    const CasePlan turned = plan_of({"b.csv", "a.csv"}, "is not there.csv");
    CHECK(turned.name(0) == both.name(1));
    CHECK(turned.name(1) == both.name(0));
    CHECK(plan_of({"copy of a.csv"}).name(0) == both.name(0));
    // What one of the files holds is part of the plan.
    write_file(folder / "b.csv", "-9,-3,9,-2.5\n");
    const CasePlan changed = plan_of({"a.csv", "b.csv"});
    CHECK(changed.name(0) == both.name(0));
    CHECK(changed.name(1) != both.name(1));
    CHECK(changed.run_id() != both.run_id());
    CHECK(changed.work_id() != both.work_id());
    CHECK_THROWS_WITH_AS(plan_of({"a.csv", "copy of a.csv"}),
                         doctest::Contains("two cases are the same: joints.file=a.csv, seed 3 and "
                                           "joints.file=copy of a.csv, seed 3"),
                         InvalidInput);
    // The one that is missing is to blame, and its case.
    CHECK_THROWS_WITH_AS(plan_of({"a.csv", "c.csv"}, "a.csv"),
                         doctest::Contains("c.csv is no file that can be read again and again"),
                         InvalidInput);
    CHECK_THROWS_WITH_AS(plan_of({"a.csv", "c.csv"}, "a.csv"),
                         doctest::Contains("in the case joints.file=c.csv, seed 3"), InvalidInput);
  }

  TEST_CASE("the order of work has every case once, those of one rock together") {
    const CasePlan plan(parts_of(PlanVerb::sweep, small_input(),
                                 {{"support.lining.thickness", {"8 cm", "10 cm", "12 cm"}},
                                  {"stress.K0", {"1", "0.8"}},
                                  {"support.bolts.length", {"2 m", "3 m"}}},
                                 4));
    const std::vector<std::size_t> order = plan.work_order();
    CHECK(std::set<std::size_t>(order.begin(), order.end()).size() == plan.size());
    REQUIRE(order.size() == 48);
    std::set<std::string> rocks;
    std::string last;
    for (const std::size_t index : order) {
      const Case c = plan.at(index);
      const std::string rock = c.overrides[1] + " " + std::to_string(c.seed);
      if (rock != last) CHECK(rocks.insert(rock).second);  // it was not left before
      last = rock;
    }
    CHECK(rocks.size() == 8);
    // Of a diagram the least supported comes first: the thinnest lining, no bolts.
    const CasePlan diagram(parts_of(PlanVerb::diagram, small_input(), {}, 2));
    std::vector<std::array<std::size_t, 2>> places;
    for (const std::size_t index : diagram.work_order()) {
      const Case c = diagram.at(index);
      REQUIRE(c.place);
      if (c.seed == diagram.at(diagram.work_order().front()).seed) places.push_back(*c.place);
    }
    CHECK(places ==
          std::vector<std::array<std::size_t, 2>>{{2, 0}, {1, 0}, {0, 0}, {2, 1}, {1, 1}, {0, 1}});
  }

  TEST_CASE("a result is read back from its journal to the last bit") {
    TunnelResult r;
    r.verdict = Verdict::stable;
    r.fallen = 0.1 + 0.2;
    r.reason = "with \"quotes\", \\ and \n a break";
    r.convergence = {1.0 / 3, -0.0, 5e-324, TunnelResult::not_computed, 1e300};
    r.demand = {1, 2, 1.0 / 7, 4, 5};
    r.error_estimate = TunnelResult::not_computed;
    r.out_of_balance = 1e-17;
    r.blocks = 12345;
    r.marginal = true;
    r.bolts_yielded = 3;
    r.bolts_ruptured = 2;
    r.feet_yielded = 1;
    r.of_bolt_strength = 1.0 / 3;
    r.bolts_governed_by = "bolt 7: bond beyond its joint at 2.9 m";
    r.of_lining_strength = std::numeric_limits<double>::infinity();
    r.lining_governed_by = "crown, 92 deg: bending";
    r.boundary = "rollers";
    r.warnings = {"one", "two"};
    const TunnelResult back = result_from_json(result_json(r));
    CHECK(result_json(back) == result_json(r));
    CHECK(back.fallen == r.fallen);
    CHECK(back.marginal);
    CHECK(back.convergence.left_springing == 5e-324);
    CHECK(std::signbit(back.convergence.right_springing));
    CHECK(std::isnan(back.convergence.invert));
    CHECK(back.reason == r.reason);
    CHECK(std::isinf(back.of_lining_strength));
    CHECK(back.lining_governed_by == r.lining_governed_by);
    CHECK(back.bolts_governed_by == r.bolts_governed_by);
    CHECK(back.word() ==
          "stable after rockfall, bolts yielded, bolts ruptured, feet at their strength, "
          "lining beyond its strength");
    CHECK_THROWS_AS((void)result_from_json("{}"), std::runtime_error);
    CHECK_THROWS_AS((void)result_from_json("{\"verdict\":"), std::runtime_error);
  }

  TEST_CASE("statistics over realisations: by hand, and by the library's own") {
    std::vector<TunnelResult> results(10);
    for (std::size_t k = 0; k < 10; ++k) {
      results[k].verdict = k == 9   ? Verdict::undecided
                           : k == 8 ? Verdict::collapse
                                    : Verdict::stable;
      results[k].fallen = k == 7 ? 2 : 0;
      results[k].convergence.crown = 1e-3 * static_cast<double>(k + 1);
    }
    const Realised r(results);
    CHECK(r.whole == 7);
    CHECK(r.shedding == 1);
    CHECK(r.verdicts() == "7 stable, 1 stable after rockfall, 1 collapse, 1 undecided");
    results[8].marginal = results[7].marginal = true;
    CHECK(Realised(results).marginal == 2);
    CHECK(Realised(results).verdicts() ==
          "7 stable, 1 stable after rockfall, 1 collapse, 1 undecided; 2 of these marginal");
    CHECK(r.rockfall().events == 2);
    CHECK(r.rockfall().trials == 9);
    CHECK(r.crown.mean() == near(4.5e-3));
    CHECK(r.crown.deviation() == near(std::sqrt(42.0 / 7) * 1e-3));
    // Student's t of 7 degrees of freedom, 0.975: 2.3646 (tables).
    REQUIRE(r.crown.mean_between());
    CHECK(r.crown.mean_between()->width() ==
          near(2 * 2.3646 * std::sqrt(6.0 / 8) * 1e-3).epsilon(1e-4));
    // Sorted 1 to 8 mm, then two without a value: the median of ten lies between the 5th and 6th.
    CHECK(r.crown.quantile(0.5) == near(5.5e-3));
    CHECK(r.crown.quantile(0) == near(1e-3));
    CHECK(std::isnan(r.crown.quantile(0.9)));  // among those that did not stand
    CHECK(std::isnan(r.crown.quantile(1)));
    CHECK(Realised(std::vector<TunnelResult>(1)).crown.quantile() !=
          Realised(std::vector<TunnelResult>(1)).crown.quantile());  // undecided: none
  }

#ifdef VOUSSOIR_TEST_PROGRAM

  TEST_CASE("threads, chunks, a merge and a second start give the same bytes") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input());
    const Outcome local = run_program(sweep(file, folder / "local", {"-j", "1"}));
    CAPTURE(local.err);
    REQUIRE(local.status == 0);
    const auto expected = results_in(folder / "local");
    REQUIRE(expected.size() == 3);  // two tables and a picture
    CHECK(finished_in(folder / "local").size() == 18);

    CHECK(run_program(sweep(file, folder / "threads", {"-j", "3"})).status == 0);
    CHECK(results_in(folder / "threads") == expected);

    // Again in the same folder: nothing is computed, and the journal stays as it is.
    const auto before = contents(folder / "local/sweep.journal");
    fs::remove(folder / "local/sweep.csv");
    CHECK(run_program(sweep(file, folder / "local")).status == 0);
    CHECK(results_in(folder / "local") == expected);
    CHECK(contents(folder / "local/sweep.journal") == before);

    // In five chunks, in two folders, backwards.
    for (const std::string part : {"one", "two"}) {
      const Outcome plan =
          run_program(sweep(file, folder / part, {"--plan", "slurm", "--chunks", "5"}));
      CAPTURE(plan.err);
      REQUIRE(plan.status == 0);
      CHECK(results_in(folder / part).count("sweep.csv") == 0);
    }
    for (int k = 5; k >= 1; --k)
      CHECK(run_program({"case", folder / (k % 2 == 0 ? "one" : "two"), "--chunk",
                         std::to_string(k) + "/5"})
                .status == 0);
    const Outcome incomplete = run_program({"merge", folder / "one"});
    CHECK(incomplete.status == 8);
    CHECK(incomplete.err.find("missing:") != std::string::npos);
    CHECK(incomplete.err.find("seed 3") != std::string::npos);
    CHECK(results_in(folder / "one").count("sweep.csv") == 0);
    const Outcome merged =
        run_program({"merge", folder / "two", folder / "one", "--out", folder / "all"});
    CAPTURE(merged.err);
    CHECK(merged.status == 0);
    CHECK(results_in(folder / "all") == expected);
    CHECK(merged.out.find("18 stable") != std::string::npos);
  }

  TEST_CASE("killed at random moments a sweep loses nothing, does nothing twice, ends the same") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input());
    const auto start = std::chrono::steady_clock::now();
    REQUIRE(run_program(sweep(file, folder / "whole")).status == 0);
    const double whole =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto expected = results_in(folder / "whole");
    voussoir::Random random(20);
    int kills = 0;
    for (int round = 0; round < 6; ++round) {
      const std::string out = folder / ("out" + std::to_string(round));
      // A machine that has grown slower since `whole` was taken may need longer to finish one case:
      // each time that nothing was finished, the next is given a tenth of the whole more.
      double longest = 0.4 * whole;
      for (int attempt = 0;; ++attempt) {
        REQUIRE(attempt < 200);
        const auto before = finished_in(out);
        Running run(sweep(file, out, {"-j", attempt % 2 == 0 ? "1" : "2"}));
        std::this_thread::sleep_for(std::chrono::duration<double>(longest * random.uniform()));
        run.signal(SIGKILL);
        const bool was_killed = run.wait().status == 1000 + SIGKILL;
        const auto after = finished_in(out);
        for (const auto& [name, count] : before) CHECK(after.count(name) == 1);  // nothing is lost
        for (const auto& [name, count] : after) CHECK(count == 1);               // nor done twice
        if (!was_killed) break;
        ++kills;
        if (after.size() == before.size()) longest += 0.1 * whole;
      }
      CHECK(results_in(out) == expected);
    }
    CHECK(kills >= 6);
  }

  TEST_CASE("another input in the same folder is refused with what differs, or discarded") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input()), out = folder / "out";
    REQUIRE(run_program(sweep(file, out)).status == 0);
    const auto before = contents(out);
    const auto refused = [&](const std::vector<std::string>& more, const std::string& words) {
      const Outcome outcome = run_program(sweep(file, out, more));
      CAPTURE(outcome.err);
      CHECK(outcome.status == 1);
      CHECK(outcome.err.find(words) != std::string::npos);
      CHECK(contents(out) == before);
    };
    refused({"--set", "stress.K0=1.5"}, "stress.K0 = 1.5, was 1");
    refused({"--vary", "rock.density=2600 kg/m^3, 2700 kg/m^3"},
            "--vary rock.density = 2600 kg/m^3, 2700 kg/m^3, was not there");
    Outcome outcome =
        run_program({"sweep", file, "--out", out, "--vary", "support.bolts.spacing=30 deg, 60 deg",
                     "--vary", "joint.friction=30..40 deg:3", "-n", "2"});
    CHECK(outcome.err.find("realisations = 2, was 3") != std::string::npos);
    // Another program of the same version.
    const std::string plan = out + "/sweep.plan.json";
    const std::string text = read_file(plan);
    write_file(plan, replaced(text, "\"program = ", "\"program = 0"));
    outcome = run_program(sweep(file, out));
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("program = ") != std::string::npos);
    outcome = run_program({"case", out, "--chunk", "1/2"});
    CHECK(outcome.err.find("is not what this program would compute") != std::string::npos);
    write_file(plan, "{");
    outcome = run_program(sweep(file, out));
    CHECK(outcome.err.find("its plan cannot be read") != std::string::npos);
    fs::remove(plan);
    outcome = run_program(sweep(file, out));
    CHECK(outcome.err.find("without their plan") != std::string::npos);
    CHECK(run_program(sweep(file, out, {"--set", "stress.K0=1.5", "--discard"})).status == 0);
    CHECK(finished_in(out).size() == 18);
    for (const auto& [name, count] : finished_in(out)) CHECK(before.count(name) == 0);
  }

  TEST_CASE("more realisations in the same folder: those that are there are not computed again") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input()), out = folder / "out";
    const auto realisations = [&](const std::string& where, int count) {
      const Outcome outcome =
          run_program({"realisations", file, "--out", where, "-n", std::to_string(count)});
      CAPTURE(outcome.err);
      REQUIRE(outcome.status == 0);
      return results_in(where);
    };
    const auto three = realisations(out, 3);
    CHECK(three == realisations(folder / "fewer", 3));
    const auto five = realisations(out, 5);
    for (const auto& [name, count] : finished_in(out)) CHECK(count == 1);
    CHECK(finished_in(out).size() == 5);
    CHECK(five == realisations(folder / "at once", 5));
    // Two folders with different numbers are not merged: which of them would be meant?
    const Outcome merged = run_program({"merge", out, folder / "fewer"});
    CHECK(merged.status == 1);
    CHECK(merged.err.find("realisations = 3, was 5") != std::string::npos);
    CHECK(results_in(out) == five);
  }

  TEST_CASE("a damaged line is said and computed again; two journals that differ are refused") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input()), out = folder / "out";
    REQUIRE(run_program(sweep(file, out)).status == 0);
    const auto expected = results_in(out);
    const std::string journal = out + "/sweep.journal/local.jsonl", text = read_file(journal);
    write_file(journal, replaced(text, "\"fallen_m2\":0.0", "\"fallen_m2\":1.0"));
    Outcome outcome = run_program(sweep(file, out));
    CAPTURE(outcome.err);
    CHECK(outcome.status == 0);
    CHECK(outcome.err.find("line 2 is damaged") != std::string::npos);
    CHECK(results_in(out) == expected);
    // A line that is whole, of the same case, with another result.
    auto second = voussoir::Journal::open(out + "/sweep.journal/other.jsonl",
                                          voussoir::read_journal(journal)->header);
    REQUIRE(second);
    auto entry = voussoir::read_journal(journal)->entries.back();
    entry.fields = replaced(entry.fields, "\"fallen_m2\":0.0", "\"fallen_m2\":1.0");
    second->add(entry);
    outcome = run_program({"merge", out});
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("two journals differ on the case") != std::string::npos);
  }

  TEST_CASE("a case that fails is a result with its reason, and the others go on") {
    const Folder folder;
    std::string text = small_input();
    const std::size_t second = text.rfind("[[joint_set]]");
    text.erase(second, text.find("[joint]") - second);
    const std::string file = write_file(folder / "case.toml", text);
    // The moduli of rock that is hardly cut, and in one direction, cannot be measured, which
    // elastic ground needs.
    const Outcome outcome = run_program({"sweep", file, "--out", folder / "out", "--set",
                                         "boundary={sides=\"elastic\",base=\"elastic\"}", "--vary",
                                         "blocks.max_elongation=20, 2", "-n", "2"});
    CAPTURE(outcome.err);
    CHECK(outcome.status == 3);
    CHECK(outcome.out.find("2 stable, 2 failed") != std::string::npos);
    const std::string table = read_file(folder / "out/sweep.csv");
    CHECK(table.find("the moduli of the rock cannot be measured") != std::string::npos);
    CHECK(table.find(",failed,") != std::string::npos);
    CHECK(table.find(",stable,") != std::string::npos);
  }

  TEST_CASE("the input of every case is checked before anything is computed") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input());
    const auto refused = [&](std::vector<std::string> more, const std::string& words) {
      more.insert(more.begin(), {"sweep", file, "--out", folder / "out"});
      const Outcome outcome = run_program(more);
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      CHECK(outcome.err.find(words) != std::string::npos);
      CHECK_FALSE(fs::exists(folder / "out"));
    };
    refused({"--vary", "joint.friction=30 deg, 95 deg"},
            "in the case joint.friction=95 deg, seed 3");
    refused({"--vary", "joint.frction=30 deg, 35 deg"}, "did you mean `friction`");
    refused({"--vary", "support.bolts.length=2 m, 20 m"}, "a bolt would end at");
    refused({}, "a sweep varies nothing");
    refused({"--vary", "model.seed=1, 2"}, "seeds are counted by --realisations");
    refused({"--vary", "joint.friction=30 deg, 35 deg", "--vary", "joint.friction=31 deg"},
            "is given twice");
    refused({"--vary", "stress.K0=0.5..1.5:1001", "--vary", "joint.friction=20..40 deg:1001"},
            "at most 1000000");
    CHECK(run_program({"realisations", file, "--out", folder / "out"}).status == 2);
    CHECK(run_program({"realisations", file, "-n", "0", "--out", folder / "out"}).status == 2);
  }

  TEST_CASE("two runs in one folder: one works, the other says so; chunks share it") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input()), out = folder / "out";
    const std::vector<std::string> endless = {"--set", "run.method=explicit",
                                              "--set", "run.damping=0",
                                              "--set", "run.max_steps=2000000000"};
    auto arguments = sweep(file, out, endless);
    REQUIRE(run_program([&] {
              auto plan = arguments;
              plan.insert(plan.end(), {"--plan", "snakemake", "--chunks", "3"});
              return plan;
            }())
                .status == 0);
    Running chunk({"case", out, "--chunk", "1/3"});
    const std::string journal = out + "/sweep.journal/chunk-0001-of-0003.jsonl";
    for (int k = 0; k < 3000 && !fs::exists(journal); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    REQUIRE(fs::exists(journal));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    Outcome second = run_program({"case", out, "--chunk", "1/3"});
    CAPTURE(second.err);
    CHECK(second.status == 1);
    CHECK(second.err.find("chunk 1/3 is being computed by another process") != std::string::npos);
    second = run_program(arguments);
    CHECK(second.status == 1);
    CHECK(second.err.find("the folder is in use: process " + std::to_string(chunk.process())) !=
          std::string::npos);
    Running other({"case", out, "--chunk", "2/3"});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    for (Running* const running : {&other, &chunk}) {
      const auto asked = std::chrono::steady_clock::now();
      running->signal(running == &other ? SIGINT : SIGTERM);
      const Outcome stopped = running->wait();
      CHECK(stopped.status == 130);
      CHECK(stopped.err.find("cases are finished and kept") != std::string::npos);
      // Ten times what it takes here: machines are shared.
      CHECK(std::chrono::steady_clock::now() - asked < std::chrono::seconds(10));
    }
    Running whole(arguments);
    for (int k = 0; k < 3000 && !fs::exists(out + "/sweep.journal/local.jsonl"); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    second = run_program({"case", out, "--chunk", "3/3"});
    CHECK(second.status == 1);
    CHECK(second.err.find("is in use") != std::string::npos);
    whole.signal(SIGTERM);
    CHECK(whole.wait().status == 130);
  }

  TEST_CASE("a folder that cannot be written, chunks and plans that are not there: sentences") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input()), out = folder / "out";
    const auto says = [&](const std::vector<std::string>& arguments, int status,
                          const std::string& words) {
      const Outcome outcome = run_program(arguments);
      CAPTURE(outcome.err);
      CHECK(outcome.status == status);
      CHECK(outcome.err.find(words) != std::string::npos);
    };
    says({"case", out, "--chunk", "1/2"}, 1, "holds no plan");
    says({"merge", out}, 1, "holds no plan");
    REQUIRE(run_program(sweep(file, out, {"--plan", "slurm", "--chunks", "2"})).status == 0);
    const std::string path = std::getenv("PATH");
    for (const bool is_there : {false, true}) {
      CAPTURE(is_there);
      if (is_there) write_file(folder / "sbatch", "");
      setenv("PATH", ("/nowhere::" + std::string(folder / "")).c_str(), 1);
      const Outcome advice = run_program(sweep(file, out, {"--plan", "slurm", "--chunks", "2"}));
      setenv("PATH", path.c_str(), 1);
      CHECK((advice.out.find("there is no sbatch on this machine") == std::string::npos) ==
            is_there);
      CHECK(advice.out.find("next     sbatch '") != std::string::npos);
    }
    for (const char* const chunk : {"0/2", "3/2", "1", "1/x", "/", "-1/2", "1/99999999"})
      says({"case", out, "--chunk", chunk}, 2, "third of sixty parts");
    says(sweep(file, folder / "x", {"--plan", "lsf"}), 2, "lsf");
    write_file(out + "/diagram.plan.json", "{}");
    says({"case", out, "--chunk", "1/2"}, 1, "holds 2 plans");
    says({"merge", out + "/diagram.plan.json"}, 1, "is no plan");
    write_file(out + "/diagram.plan.json", "{\"schema\": 9}");
    says({"merge", out + "/diagram.plan.json"}, 1, "schema 9");
    if (getuid() != 0) {
      fs::create_directory(folder / "locked");
      chmod((folder / "locked").c_str(), 0500);
      says(sweep(file, folder / "locked"), 1, "no permission to write");
    }
    write_file(folder / "other.toml", replaced(small_input(), "K0 = 1.0", "K0 = 1.1"));
    REQUIRE(run_program(sweep(folder / "other.toml", folder / "other",
                              {"--plan", "slurm", "--chunks", "2"}))
                .status == 0);
    says({"merge", out + "/sweep.plan.json", folder / "other"}, 1, "stress.K0 = 1.1, was 1");
  }

  TEST_CASE("a full disk stops the work with a sentence; what was finished stays") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input()), out = folder / "out";
    REQUIRE(run_program(sweep(file, folder / "whole")).status == 0);
    // A limit on the size of files, inherited by the program, is as good as a full disk: a write
    // ends short.
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{8000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const Outcome full = run_program(sweep(file, out, {"-j", "2"}));
    setrlimit(RLIMIT_FSIZE, &before);
    CAPTURE(full.err);
    CHECK(full.status == 1);
    CHECK(full.err.find("cannot write '") != std::string::npos);
    CHECK(full.err.find("local.jsonl': File too large") != std::string::npos);
    const auto kept = finished_in(out);
    CHECK(kept.size() > 2);
    CHECK(kept.size() < 18);
    CHECK(run_program(sweep(file, out)).status == 0);
    for (const auto& [name, count] : finished_in(out)) CHECK(count == 1);
    CHECK(results_in(out) == results_in(folder / "whole"));
  }

  TEST_CASE("a limit on the size of files is a sentence, never a signal, and leaves nothing") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input());
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    // Too little for the lock, for a plan, for a picture.
    for (const rlim_t bytes : {0U, 1000U, 8000U})
      for (const std::string verb : {"run", "sweep"}) {
        if (verb == "sweep" && bytes == 8000U) continue;  // it has a journal to go on from, above
        CAPTURE(bytes);
        CAPTURE(verb);
        const std::string out = folder / (verb + std::to_string(bytes));
        const rlimit small{bytes, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
        const Outcome full = verb == "run" ? run_program({"run", file, "--out", out})
                                           : run_program(sweep(file, out));
        setrlimit(RLIMIT_FSIZE, &before);
        CAPTURE(full.err);
        CHECK(full.status == 1);
        if (bytes > 0) CHECK(full.err.find("File too large") != std::string::npos);
        CHECK(contents(out).empty());
        CHECK(!fs::exists(out));
      }
  }

  TEST_CASE(
      "several processes of a program without MPI are told that they cannot share their work") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input());
    setenv("OMPI_COMM_WORLD_SIZE", "4", 1);
    const Outcome outcome = run_program(sweep(file, folder / "out"));
    unsetenv("OMPI_COMM_WORLD_SIZE");
    if (outcome.status == 0) return;  // a program with MPI: tests/engines/run
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find("was built without MPI, and mpirun has started it 4 times") !=
          std::string::npos);
  }

  TEST_CASE("mapped joints travel with the plan") {
    const Folder folder;
    std::string text = small_input();
    text = replaced(text, "[joint]\n", "[joints]\nfile = \"traces.csv\"\n[joint]\n");
    const std::string file = write_file(folder / "case.toml", text);
    write_file(folder / "traces.csv", "-9,3,9,3\n-9,-3,9,-2\n");
    REQUIRE(run_program(sweep(file, folder / "local")).status == 0);
    REQUIRE(
        run_program(sweep(file, folder / "plan", {"--plan", "slurm", "--chunks", "1"})).status ==
        0);
    fs::remove(folder / "traces.csv");
    fs::rename(folder / "plan", folder / "elsewhere");
    const Outcome chunk = run_program({"case", folder / "elsewhere", "--chunk", "1/1"});
    CAPTURE(chunk.err);
    CHECK(chunk.status == 0);
    CHECK(run_program({"merge", folder / "elsewhere", "-o", folder / "merged"}).status == 0);
    CHECK(results_in(folder / "merged") == results_in(folder / "local"));
    write_file(folder / "elsewhere/sweep.joints.csv", "-9,3,9,3\n");
    const Outcome changed = run_program({"case", folder / "elsewhere", "--chunk", "1/1"});
    CHECK(changed.status == 1);
    CHECK(changed.err.find("joints.file (its content)") != std::string::npos);
  }

  TEST_CASE("mapped joints that vary: every row is of its own file, here and where the plan goes") {
    const Folder folder;
    const std::string file = write_file(
        folder / "case.toml",
        replaced(small_input(), "[joint]\n", "[joints]\nfile = \"north.csv\"\n[joint]\n"));
    // Most traces of the north miss the ground, which a warning says with the name of the file.
    const std::string north = write_file(
        folder / "north.csv", "-9,3,9,3\n-9,-3,9,-2\n-900,-3,-800,-2\n900,3,800,2\n900,5,800,6\n");
    const std::string south = write_file(folder / "south.csv", "-9,4,9,2.5\n-9,0.5,9,0\n");
    const auto sweep_of = [&](const std::string& files, const std::string& out,
                              const std::vector<std::string>& more = {}) {
      std::vector<std::string> arguments = {"sweep", file, "--vary", "joints.file=" + files,
                                            "--out", out};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return run_program(arguments);
    };
    const auto rows = [&](const std::string& out) {
      std::map<std::string, std::string> of_file;  // without the name and the id of the run
      std::string text = read_file(out + "/sweep.csv");
      for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
        const std::string row = text.substr(at, text.find('\n', at) - at);
        const std::size_t comma = row.find(',');
        of_file[row.substr(0, comma)] = row.substr(comma, row.rfind(',') - comma);
      }
      return of_file;
    };
    REQUIRE(sweep_of("north.csv, south.csv", folder / "both").status == 0);
    const auto both = rows(folder / "both");
    REQUIRE(both.count("north.csv") == 1);
    REQUIRE(both.count("south.csv") == 1);
    CHECK(both.at("north.csv") != both.at("south.csv"));
    CHECK(both.at("north.csv").find("joints.file: north.csv: ") != std::string::npos);
    REQUIRE(sweep_of("south.csv", folder / "alone").status == 0);
    CHECK(rows(folder / "alone").at("south.csv") == both.at("south.csv"));
    REQUIRE(sweep_of("south.csv, north.csv", folder / "turned", {"-j", "2"}).status == 0);
    CHECK(rows(folder / "turned").at("south.csv") == both.at("south.csv"));
    CHECK(rows(folder / "turned").at("north.csv") == both.at("north.csv"));

    REQUIRE(sweep_of("north.csv, south.csv", folder / "plan", {"--plan", "slurm", "--chunks", "2"})
                .status == 0);
    fs::remove(north);
    fs::remove(south);
    for (const std::string part : {"1/2", "2/2"}) {
      const Outcome chunk = run_program({"case", folder / "plan", "--chunk", part});
      CAPTURE(chunk.err);
      CHECK(chunk.status == 0);
    }
    CHECK(run_program({"merge", folder / "plan", "-o", folder / "merged"}).status == 0);
    CHECK(results_in(folder / "merged") == results_in(folder / "both"));
    write_file(folder / "plan/sweep.joints-2.csv", "-9,3,9,3\n");
    const Outcome changed = run_program({"merge", folder / "plan"});
    CHECK(changed.status == 1);
    CHECK(changed.err.find("joints.file (its content)") != std::string::npos);
  }

  TEST_CASE("one tunnel is the same by run, realisations, sweep and diagram") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", small_input());
    REQUIRE(run_program({"run", file, "--out", folder / "run"}).status == 0);
    const auto run = nlohmann::json::parse(read_file(folder / "run/run.json"));
    const double crown = run["convergence"]["crown_mm"];
    const auto cell = [&](const std::string& table, std::size_t row, const std::string& column) {
      std::vector<std::vector<std::string>> rows(1, {""});
      bool quoted = false;
      for (const char c : table) {
        if (c == '"')
          quoted = !quoted;
        else if (c == '\n' && !quoted)
          rows.push_back({""});
        else if (c == ',' && !quoted)
          rows.back().emplace_back();
        else if (c != '\r')
          rows.back().back() += c;
      }
      const auto& header = rows.front();
      const auto at = std::find(header.begin(), header.end(), column);
      REQUIRE(at != header.end());
      return rows.at(row).at(static_cast<std::size_t>(at - header.begin()));
    };
    // Six digits are written.
    const auto same = [&](const std::string& text) {
      CHECK(std::stod(text) == near(crown).epsilon(1e-5));
    };
    REQUIRE(run_program({"realisations", file, "-n", "2", "-o", folder / "r"}).status == 0);
    same(cell(read_file(folder / "r/realisations.csv"), 1, "crown_convergence_mm"));
    REQUIRE(run_program({"sweep", file, "--vary", "support.lining.thickness=10 cm, 8 cm", "-o",
                         folder / "s"})
                .status == 0);
    const std::string table = read_file(folder / "s/sweep.csv");
    CHECK(cell(table, 2, "support.lining.thickness_cm") == "8");
    same(cell(table, 2, "crown_convergence_mm"));
    const int diagram = run_program({"diagram", file, "-o", folder / "d"}).status;
    CHECK((diagram == 0 || diagram == 3));
    same(cell(read_file(folder / "d/interaction.csv"), 2, "crown_convergence_mm"));
    // Over realisations: the mean of those that realisations has one by one.
    REQUIRE(run_program({"diagram", file, "-n", "2", "-o", folder / "dn"}).status >= 0);
    const std::string both = read_file(folder / "r/realisations.csv");
    const double mean = (std::stod(cell(both, 1, "crown_convergence_mm")) +
                         std::stod(cell(both, 2, "crown_convergence_mm"))) /
                        2;
    CHECK(std::stod(cell(read_file(folder / "dn/interaction.csv"), 2,
                         "crown_convergence_mm_mean")) == near(mean).epsilon(1e-5));
    for (const char* const name : {"interaction_quantile.svg", "interaction_rockfall.svg"})
      CHECK(read_file(folder / "dn" + std::string("/") + name).ends_with("</svg>\n"));
  }

#endif
}

}  // namespace program_cases_test
