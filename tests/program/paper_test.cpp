// SPDX-License-Identifier: MIT
// The analyses of the paper: claims, study, plots, verification.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "claims.hpp"
#include "pages.hpp"
#include "plotting.hpp"
#include "program/harness.hpp"
#include "report.hpp"
#include "scoreboard.hpp"
#include "study.hpp"
#include "verification.hpp"

namespace program_paper_test {

using namespace voussoir::paper;
using voussoir::InvalidInput;
using voussoir_test::Folder;

namespace {

/// A tunnel that stands in every realisation and is quick.
const Variant quick{.bolts = Bolts{}, .lining = Lining{}};

Section all_decided() {
  Section section{"all", "All", "", {}};
  for (const Claim& claim : claims())
    section.findings.push_back({claim.id, Agreement::agrees, "seen"});
  return section;
}

}  // namespace

TEST_SUITE("program/paper") {
  TEST_CASE("the build makes a program of every analysis and of nothing else") {
    std::string names;
    for (const NamedAnalysis& analysis : analyses())
      names += (names.empty() ? "" : " ") + std::string(analysis.name);
    CHECK(names == VOUSSOIR_TEST_ANALYSES);
  }

  TEST_CASE("104 claims in order, every one in a chapter") {
    REQUIRE(claims().size() == 104);
    for (std::size_t k = 0; k < claims().size(); ++k) {
      char id[16];
      std::snprintf(id, sizeof id, "PF-%03d", static_cast<int>(k + 1));
      CHECK(claims()[k].id == std::string(id));
      CHECK(std::string(claims()[k].statement).size() > 10);
    }
    int next = 1;
    for (const ClaimChapter& chapter : claim_chapters()) {
      CHECK(chapter.first == next);
      next = chapter.last + 1;
    }
    CHECK(next == 105);
    // PF-069 and PF-042 as the print has them.
    CHECK(std::string(claims()[68].statement).find("mean 0.030, sd 0.008") != std::string::npos);
    CHECK(claims()[41].kind == ClaimKind::quantitative);
  }

  TEST_CASE("a claim that nobody decides, or two, is an error of ours") {
    std::vector<Section> sections{all_decided()};
    const auto score = scores(sections);
    // 28 of them say what was put in: no evidence when they are met.
    CHECK(score.back().agrees == 76);
    CHECK(score.back().restated == 28);
    CHECK(verdict_word(sections[0].findings[0]) == "as put in");
    CHECK(verdict_word(sections[0].findings[3]) == "agrees");
    CHECK(score.size() == claim_chapters().size() + 1);
    sections[0].findings[7].agreement = Agreement::differs;
    sections[0].findings[8].agreement = Agreement::not_testable;
    const auto other = scores(sections);
    CHECK(other.back().agrees == 76);
    CHECK(other.back().restated == 26);
    CHECK(verdict_word(sections[0].findings[7]) == "differs");
    CHECK(other.front().differs == 1);
    CHECK(other.front().not_testable == 1);
    CHECK(score_text(other).find(" 26") != std::string::npos);
    sections[0].findings[7].agreement_as_the_paper = Agreement::agrees;
    sections[0].findings[9].agreement_as_the_paper = Agreement::not_testable;
    CHECK(second_column_text(sections).find("2 of the claims depend") == 0);
    CHECK(second_column_text(sections).find("1 of these agree and 1 differ; as the paper ran it 1 "
                                            "agree, 0 differ, and 1 have") != std::string::npos);
    CHECK(second_column(sections[0].findings[7]) == "agrees: ");
    CHECK(cause(sections[0].findings[0]).empty());
    CHECK_FALSE(cause(sections[0].findings[7]).empty());  // differs, and no reason was given
    sections[0].findings.push_back({"PF-042", Agreement::agrees, ""});
    CHECK_THROWS_AS((void)scores(sections), std::logic_error);
    sections[0].findings.resize(103);
    CHECK_THROWS_WITH_AS((void)scores(sections), doctest::Contains("PF-104"), std::logic_error);
  }

  TEST_CASE("what differs by rounding does not differ, and a cause is given where it was found") {
    // The ground closes a joint by 662 kPa / 5 GPa/m = 0.13 mm; a millionth is 0.13 nm.
    CHECK(needed_friction_agrees(3e-18, 164e-9) == Agreement::agrees);
    CHECK(needed_friction_agrees(2.4e-12, 1e-9) == Agreement::agrees);
    CHECK(needed_friction_agrees(5e-10, 1e-9) == Agreement::differs);
    CHECK(needed_friction_agrees(2.4e-12, 2.4e-12) == Agreement::not_testable);
    const auto measured = [](double value) { return Measured{.values = {value}}; };
    CHECK(rises({measured(2), measured(2 - 1e-12), measured(3)}));
    CHECK_FALSE(rises({measured(2), measured(2 - 1e-6), measured(3)}));
    CHECK(falls({measured(2), measured(2 + 1e-12)}));
    const Finding bare{"PF-009", Agreement::differs, "", "", ""};
    CHECK(cause(bare).find("has not been looked into") != std::string::npos);
    const Finding explained{"PF-009", Agreement::differs, "", "because", ""};
    CHECK(cause(explained) == "because");
  }

  TEST_CASE("measured over realisations: what collapsed or detached is counted and said") {
    Measured m;
    Outcome stands, collapses;
    stands.report.verdict = voussoir::Verdict::stable;
    m.add(stands.report, 1);
    m.add(stands.report, 3);
    m.add(stands.report, std::numeric_limits<double>::quiet_NaN());
    m.add(collapses.report, 100);
    stands.report.fallen_measure = 0.5;
    m.add(stands.report, 5);
    CHECK(m.samples == 5);
    CHECK(m.mean() == 3);
    CHECK(m.deviation() == 2);
    CHECK_FALSE(m.complete());
    CHECK(m.text(10, "mm", 3) ==
          "30.0 ± 20 mm (5 realisations; 1 collapsed; 1 have lost that rock; 1 shed rock)");
    Measured none;
    none.add(collapses.report, 1);
    CHECK(std::isnan(none.mean()));
    CHECK(none.text(1, "mm") == "no value (1 realisation; 1 collapsed)");
  }

  TEST_CASE("the same outcomes on one thread and two; every tunnel computed once") {
    Study one(2, 1), two(2, 2);
    const Variant held{.held = 0.5};
    two.prepare({quick, held, quick});
    CHECK(two.tunnels_solved() == 4);
    two.prepare({held, quick});
    CHECK(two.tunnels_solved() == 4);
    for (const Variant& v : {quick, held})
      for (std::size_t k = 0; k < 2; ++k) {
        CHECK(one.of(v)[k].convergence.crown == two.of(v)[k].convergence.crown);
        CHECK(one.of(v)[k].mean_thrust() == two.of(v)[k].mean_thrust());
        CHECK(one.of(v)[k].seed == k + 1);
      }
    CHECK(one.of(quick)[0].bolts.size() == 13);
    CHECK(one.of(quick)[0].lining.size() == 72);
    CHECK(one.of(held)[0].convergence.crown < 0.6 * 3.5e-3);
    CHECK_THROWS_AS(Study(0, 1), InvalidInput);
    Study stopped(1, 1, [](const std::string&, double) { return false; });
    CHECK_THROWS_AS(stopped.prepare({quick}), Study::Stopped);
  }

  TEST_CASE("a plot keeps its data, its script and its picture together") {
    Plot plot{"one",
              "Title with a \"word\"",
              "x, m",
              "F / (p_0 D)",
              {{"theory, G_1", Mark::line, {0, 1, 2}, {0, 1, 4}},
               {"blocks", Mark::linked_points, {0.5, 1.5}, {0.3, 2.2}, {0.1, 0.2}},
               {"nothing failed", Mark::failed, {}, {}},
               {"failed", Mark::failed, {1}, {1}}}};
    plot.y_range = {{0, std::numeric_limits<double>::quiet_NaN()}};
    CHECK(plot_csv(plot) ==
          "series,x,y,spread\r\n\"theory, G_1\",0,0,0\r\n\"theory, G_1\",1,1,0\r\n"
          "\"theory, G_1\",2,4,0\r\nblocks,0.5,0.3,0.1\r\nblocks,1.5,2.2,0.2\r\nfailed,1,1,0\r\n");
    const std::string script = plot_script(plot);
    CHECK(script.find("set yrange [0:*]") != std::string::npos);
    CHECK(script.find("every ::0::2 using 2:3") != std::string::npos);
    CHECK(script.find("every ::3::4 using 2:3:4") != std::string::npos);
    CHECK(script.find("every ::5::5") != std::string::npos);
    CHECK(script.find("nothing failed") == std::string::npos);
    CHECK(script.find("filledcurves") == std::string::npos);
    Plot banded = plot;
    banded.series[0].spread = {0, 0.1, 0.2};
    CHECK(plot_script(banded).find("every ::0::2 using 2:($3-$4):($3+$4) with filledcurves") !=
          std::string::npos);
    const auto section_of = [](std::vector<Plot> plots) {
      Section section{"s", "S", "", {}};
      section.plots = std::move(plots);
      return std::vector<Section>{section};
    };
    Plot other = plot;
    other.name = "two";
    const auto sections = section_of({plot, other});
    const Drawings drawings = drawn(sections);
    REQUIRE(drawings.size() == 2);
    CHECK(drawings.at("two").find("</svg>") != std::string::npos);
    CHECK(drawings.at("one").find("blocks") != std::string::npos);
    CHECK(plot_files(sections, drawings).size() == 6);
    CHECK(drawn({}).empty());
    CHECK_THROWS_WITH_AS((void)drawn(section_of({plot, plot})), doctest::Contains("one"),
                         std::logic_error);
    plot.series[0].y.pop_back();
    CHECK_THROWS_WITH_AS((void)plot_csv(plot), doctest::Contains("theory"), InvalidInput);
    plot.series.clear();
    CHECK_THROWS_WITH_AS((void)drawn(section_of({plot})), doctest::Contains("one"),
                         std::runtime_error);
  }

  TEST_CASE("realisations that collapse have their mark in a plot, never a gap") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Plot plot{"p", "P", "x", "y", {}};
    draw(plot, {{"whole", Mark::points, {1, 2}, {5, 6}, {}}, {"gone", Mark::failed, {}, {}}, {}});
    CHECK(plot.series.size() == 1);
    draw(plot, {{"some", Mark::points, {1, 2}, {5, 6}, {}}, {"gone", Mark::failed, {2}, {6}}, {}});
    draw(plot, {{"none", Mark::points, {1}, {5}, {}}, {"gone", Mark::failed, {2}, {nan}}, {}}, 0.5);
    REQUIRE(plot.series.size() == 4);
    CHECK(plot.series[2].mark == Mark::failed);
    CHECK(plot.series[2].x == std::vector<double>{2, 2});
    CHECK(plot.series[2].y == std::vector<double>{6, 0.5});
    CHECK(plot.series[3].name == "none");

    // The tunnel without support: of the first two realisations one stands.
    Study study(2, 2);
    const Swept bare = swept(
        study, "bare", {1}, [](double) { return Variant{}; }, crown, 1e3);
    CHECK(bare.measured[0].collapsed > 0);
    CHECK(bare.failed.x == std::vector<double>{1});
    CHECK(collapsed_text(study, {{"held", quick}}).empty());
    CHECK(collapsed_text(study, {{"held", quick}, {"bare", Variant{}}}) ==
          "Collapsed: bare " + std::to_string(bare.measured[0].collapsed) + " of 2 realisations.");
  }

  TEST_CASE("the report holds every section, plot and claim, and no other file") {
    Section section = all_decided();
    section.plots = {{"p", "P", "x", "y", {{"s", Mark::line, {0, 1}, {0, 1}}}}};
    section.tables = {{"T <1>", {"a", "b"}, {{"1", "<2>"}}}};
    Study study(1, 1);
    const std::string page = report_html({section}, drawn({section}), study);
    CHECK(page.find("&lt;2&gt;") != std::string::npos);
    CHECK(page.find("<svg") != std::string::npos);
    CHECK(page.find("PF-104") != std::string::npos);
    CHECK(page.find("href=\"http") == std::string::npos);
    CHECK(page.find("src=") == std::string::npos);
    std::set<std::string> ids;  // no id twice
    for (auto at = page.find("id=\""); at != std::string::npos; at = page.find("id=\"", at + 4))
      CHECK(ids.insert(page.substr(at + 4, page.find('"', at + 4) - at - 4)).second);
    CHECK(scoreboard_csv({section}).find("PF-001") != std::string::npos);
  }

  TEST_CASE("pages of documentation: every link and picture is among them") {
    Section section = all_decided();
    section.text = {"What is shown."};
    section.name = "all_of_it";
    section.plots = {{"p", "P", "x", "y", {{"s", Mark::line, {0, 1}, {0, 1}}}}};
    section.pictures = {{"q", "<svg></svg>", "caption | of q"}};
    section.tables = {{"T", {"a_1", "b"}, {{"1", "a | b*"}}}};
    section.findings[15].agreement = Agreement::differs;
    section.findings[15].why = "for a reason";
    section.findings[16].agreement = Agreement::not_testable;
    Study study(2, 1);
    const auto pages = documentation_pages({section}, drawn({section}), study);
    CHECK(pages.size() == 4);
    for (const auto& [name, text] : pages) {
      if (!name.ends_with(".md")) continue;
      for (auto at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2)) {
        const std::string target = text.substr(at + 2, text.find(')', at) - at - 2);
        CAPTURE(target);
        CHECK(pages.contains(target));
      }
    }
    const std::string& index = pages.at("README.md");
    CHECK(index.find("76 agree, 1 differ, 1 cannot be tested, 26 restate") != std::string::npos);
    CHECK(index.find("for a reason") != std::string::npos);
    CHECK(index.find("48 collapses") != std::string::npos);
    CHECK(pages.at("all_of_it.md").find("| 1 | a \\| b\\* |") != std::string::npos);
  }

  TEST_CASE("verify: each check passes, and compares two computations [long]") {
    Study study(1, 2);
    const auto checks = verification(study);
    CHECK(checks.size() > 40);
    for (const Check& check : checks) {
      CAPTURE(check.what);
      CHECK(check.passes());
      // Another computation, not the same number twice; counts of blocks in balance are exact.
      if (check.kind == Check::Kind::solution) CHECK(check.deviation() > 0);
    }
  }

  TEST_CASE("verify: a value that is off does not pass") {
    Check off{Check::Kind::solver, "off", 1.02, 1, 0.01, "none"};
    CHECK_FALSE(off.passes());
    off.value = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(off.passes());
    CHECK(verification_text({off}).find("FAIL") != std::string::npos);
    CHECK(verification_text({off}).find("0 of 1 pass") != std::string::npos);
  }

#ifdef VOUSSOIR_TEST_PROGRAM
  TEST_CASE("voussoir paper: bad options write nothing") {
    Folder folder;
    for (const std::string samples : {"0", "-3", "many"}) {
      const auto run =
          voussoir_test::run_program({"paper", "--samples", samples, "--out", folder / "out"});
      CHECK(run.status == 2);
      CHECK(run.err.find("--samples") != std::string::npos);
      CHECK(voussoir_test::contents(folder / "out").empty());
    }
    const std::string file = voussoir_test::write_file(folder / "file", "");
    const auto run = voussoir_test::run_program({"paper", "--out", file});
    CHECK(run.status == 1);
    CHECK(run.err.find("is not a folder") != std::string::npos);
    const auto paged =
        voussoir_test::run_program({"paper", "--out", folder / "out", "--pages", file});
    CHECK(paged.status == 1);
    CHECK(paged.err.find("--pages " + file) != std::string::npos);
    CHECK(voussoir_test::contents(folder / "out").empty());
  }

  TEST_CASE("voussoir paper without gnuplot says what to install, before it computes") {
    const char* path = std::getenv("PATH");
    const std::string before = path ? path : "";
    setenv("PATH", "/nowhere", 1);
    Folder folder;
    const auto run = voussoir_test::run_program({"paper", "--out", folder / "out"});
    setenv("PATH", before.c_str(), 1);
    CHECK(run.status == 1);
    CHECK(run.err.find("gnuplot-nox") != std::string::npos);
    CHECK(voussoir_test::contents(folder / "out").empty());
  }

  TEST_CASE("voussoir verify prints its table and ends with 0") {
    const auto run = voussoir_test::run_program({"verify"});
    CHECK(run.status == 0);
    std::size_t passed = 0;
    for (auto at = run.out.find("PASS"); at != std::string::npos; at = run.out.find("PASS", at + 4))
      ++passed;
    CHECK(passed > 40);
    CHECK(run.out.find("FAIL") == std::string::npos);
  }
#endif
}

}  // namespace program_paper_test
