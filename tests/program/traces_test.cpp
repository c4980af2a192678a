// SPDX-License-Identifier: MIT
// Mapped joints through the program: from files of traces to blocks, and what is said of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>

#include "analysis.hpp"
#include "harness.hpp"
#include "support/trace_maps.hpp"

namespace traces_test {

namespace {

using namespace voussoir_test;
using namespace voussoir::program;
using Json = nlohmann::json;

const std::string data = VOUSSOIR_TEST_DATA "/traces/";

/// The rock of a case among the data, with another file of traces.
RockIn<voussoir::Planar> rock_of_case(const std::string& name, const std::string& traces,
                                      std::vector<std::string> overrides = {}) {
  overrides.push_back("joints.file=" + traces);
  return described_rock(read_input_text(read_file(data + name), name, data, overrides));
}

std::size_t blocks(const std::string& name, const std::string& traces,
                   const std::vector<std::string>& overrides = {}) {
  return rock_of_case(name, traces, overrides).mass.bodies.size();
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A circular tunnel in the middle of 60 m x 45 m of rock whose joints are all mapped.
std::string mapped_case(const std::string& sets) {
  return replaced(read_file(data + "overshoot.toml"), "[joint]\n", sets + "[joint]\n");
}

}  // namespace

TEST_SUITE("program/traces") {
  TEST_CASE("an overshoot of a micrometre cuts nothing; a short trace as far as the key says") {
    CHECK(blocks("overshoot.toml", "overshoot.csv") == 4);
    CHECK(blocks("overshoot.toml", "short-trace.csv", {"joints.dead_ends=do_not_cut"}) == 1);
    CHECK(blocks("overshoot.toml", "short-trace.csv") == 2);
  }

  TEST_CASE("metres that are mapped and not cut, or made where none was mapped, are warned of") {
    const RockIn<voussoir::Planar> left = rock_of_case("overshoot.toml", "short-trace.csv",
                                                       {"joints.dead_ends=do_not_cut"}),
                                   cut = rock_of_case("overshoot.toml", "short-trace.csv"),
                                   good = rock_of_case("overshoot.toml", "overshoot.csv");
    const auto said = [](const RockIn<voussoir::Planar>& rock, const std::string& part) {
      return std::any_of(rock.warnings.begin(), rock.warnings.end(),
                         [&](const std::string& warning) { return contains(warning, part); });
    };
    CHECK(said(left, "joints.file, no set: of 1.0 m mapped 0.0 m part blocks"));
    CHECK(said(left, "joints.dead_ends = \"cut_through\""));
    CHECK(said(cut, " of joint are made where none was mapped, of 1.0 m mapped"));
    CHECK(good.warnings.empty());
    REQUIRE(good.joints.size() == 1);
    REQUIRE(good.joints[0].mapped.has_value());
    CHECK(std::abs(good.joints[0].mapped->mapped - (60 + 60 + 24)) < 1e-5);
    CHECK(std::abs(good.joints[0].mapped->cut - (60 + 60 + 24)) < 1e-5);
  }

  TEST_CASE("a curved joint is one joint, whatever the number of its segments") {
    for (const int chords : {1, 8, 64, 512}) {
      CAPTURE(chords);
      const Folder folder;
      std::string polyline = "id,x,y\n", rows;
      const double half = 0.312, size = 30 / std::sin(half);  // 61 m from side to side
      const auto at = [&](int k) {
        const double angle = half * (2.0 * k / chords - 1);
        char text[64];
        std::snprintf(text, sizeof text, "%.6f,%.6f", size * std::sin(angle),
                      size * (std::cos(angle) - 1) - 8);
        return std::string(text);
      };
      for (int k = 0; k <= chords; ++k) polyline += "1," + at(k) + "\n";
      for (int k = 0; k < chords; ++k) rows += at(k) + "," + at(k + 1) + "\n";
      for (const std::string& text : {polyline, rows}) {
        const std::string file = write_file(folder / "arc.csv", text);
        CHECK(blocks("overshoot.toml", file) == 2);
      }
    }
  }

  TEST_CASE("the same traces in another order give the same run, to the last bit") {
    std::vector<std::pair<Json, std::string>> runs;
    for (const std::string traces : {"row-order-long-first.csv", "row-order-short-first.csv"}) {
      const Folder folder;
      const Outcome outcome =
          run_program({"run", data + "row-order.toml", "--set", "joints.file=" + traces, "--out",
                       folder / "out", "--quiet"});
      CAPTURE(outcome.err);
      REQUIRE((outcome.status == 0 || outcome.status == 6));
      runs.emplace_back(Json::parse(read_file(folder / "out/run.json")), "");
    }
    Json &a = runs[0].first, &b = runs[1].first;
    CHECK(a.at("rock").at("bodies") == b.at("rock").at("bodies"));
    CHECK(a.at("convergence") == b.at("convergence"));
    CHECK(a.at("lining") == b.at("lining"));
    CHECK(a.at("bolts") == b.at("bolts"));
    CHECK(a.at("rock").at("joints_by_source") == b.at("rock").at("joints_by_source"));
  }

  TEST_CASE("what is read is shown set by set, by name, with the mechanics taken") {
    const Folder folder;
    write_file(folder / "map.csv",
               "X1 [m];Y1 [m];X2 [m];Y2 [m];Set\n-40;-12;40;-12;Bedding\n-40;12;40;12;bedding\n"
               "15;-12;15;12;cross joints\n-15;-12;-15;12;\n");
    const std::string sets =
        "[[joint_set]]\nname = \"bedding\"\nfriction = \"25 deg\"\n"
        "[[joint_set]]\nname = \"cross joints\"\n[[joint_set]]\nname = \"faults\"\n";
    const std::string file =
        write_file(folder / "case.toml", replaced(mapped_case(sets), "overshoot.csv", "map.csv"));
    const Outcome outcome = run_program({"run", file, "--out", folder / "out"});
    CAPTURE(outcome.out);
    CAPTURE(outcome.err);
    REQUIRE((outcome.status == 0 || outcome.status == 6));
    CHECK(contains(outcome.out, "map.csv: 4 traces, fields separated by ;, columns by the header"));
    CHECK(contains(outcome.out,
                   "joints   joints.file, bedding: 2 traces, 2 used, 0 part nothing, 0 outside; "
                   "120.0 m mapped, 120.0 m of it cut, 0.0 m made beyond; kn 5 GPa/m, ks "
                   "500 MPa/m, friction 25 deg"));
    CHECK(contains(outcome.out, "joints   joints.file, cross joints: 1 trace, 1 used"));
    CHECK(contains(outcome.out, "joints   joints.file, no set: 1 trace, 1 used"));
    CHECK(contains(outcome.out + outcome.err, "joint_set[2] faults has no joint"));
    const Json json = Json::parse(read_file(folder / "out/run.json"));
    const Json& sources = json.at("rock").at("joints_by_source");
    REQUIRE(sources.size() == 3);
    CHECK(sources[0].at("set") == -1);
    CHECK(sources[1].at("source") == "joints.file, bedding");
    CHECK(std::abs(sources[1].at("friction_deg").get<double>() - 25) < 1e-12);
    CHECK(std::abs(sources[2].at("friction_deg").get<double>() - 35) < 1e-12);
    CHECK(std::abs(sources[1].at("mapped_m").get<double>() - 120) < 1e-9);
  }

  TEST_CASE("sets numbered from 1 are taken so where that is clear, and asked for where not") {
    const Folder folder;
    const std::string sets =
        "[[joint_set]]\nname = \"a\"\n[[joint_set]]\nname = \"b\"\nfriction = \"20 deg\"\n"
        "[[joint_set]]\nname = \"c\"\n";
    const auto frictions = [&](const std::string& rows, std::vector<std::string> overrides = {}) {
      overrides.push_back("joints.file=" + write_file(folder / "map.csv", rows));
      std::string found;
      try {
        for (const JointSource& source :
             described_rock(read_input_text(mapped_case(sets), "case.toml", "", overrides)).joints)
          found += source.name + " ";
      } catch (const voussoir::InvalidInput& error) {
        return std::string(error.what());
      }
      return found;
    };
    const std::string two = "-40,-12,40,-12,1\n-40,12,40,12,2\n", three = two + "-40,0,40,0,3\n";
    CHECK(frictions(three) == "joints.file, a joints.file, b joints.file, c ");
    const std::string asked = frictions(two);
    CHECK(contains(asked, "sets are numbered 1 to 2, and there are 3"));
    CHECK(contains(asked, "joints.first_set = 0 or 1"));
    CHECK(frictions(two, {"joints.first_set=1"}) == "joints.file, a joints.file, b ");
    CHECK(frictions(two, {"joints.first_set=0"}) == "joints.file, b joints.file, c ");
  }

  TEST_CASE("keys of [joints] and of sets without random joints, and what is wrong with them") {
    const auto fault = [](const std::string& text, const std::vector<std::string>& overrides) {
      try {
        (void)read_input_text(text, "case.toml", data, overrides);
      } catch (const InputErrors& error) {
        return std::string(error.what());
      }
      return std::string("accepted");
    };
    const std::string plain = read_file(data + "overshoot.toml");
    CHECK(fault(plain, {"joints.snap=10 cm"}) == "accepted");
    CHECK(contains(fault(plain, {"joints.snap=11 cm"}), "at most 100 mm"));
    CHECK(contains(fault(plain, {"joints.snap=0 m"}), "above 0"));
    CHECK(contains(fault(plain, {"joints.first_set=2"}), "joints.first_set"));
    CHECK(contains(fault(plain, {"joints.dead_ends=cut"}), "cut_through"));
    const std::string set = "[[joint_set]]\nname = \"a\"\n";
    CHECK(fault(mapped_case(set), {}) == "accepted");
    CHECK(contains(fault(mapped_case(set + "extent = \"2 m\"\n"), {}),
                   "intensity, spacing, P32 or P30"));
    // Without a file of traces a set has to say how many joints it has.
    const std::string none = replaced(mapped_case(set), "[joints]\nfile = \"overshoot.csv\"\n", "");
    CHECK(contains(fault(none, {}), "joint_set[0].intensity is missing"));
  }

  TEST_CASE("mapped and random joints together: the mapped ones first, both said") {
    const Folder folder;
    const std::string set =
        "[[joint_set]]\nname = \"mapped\"\n[[joint_set]]\nname = \"random\"\ndip = \"60 deg\"\n"
        "dip_direction = \"E\"\nsd = \"5 deg\"\nintensity = \"0.2 /m^2\"\nextent = \"4 m\"\n";
    const std::string traces = write_file(
        folder / "map.csv", "-40,-12,40,-12,mapped\n-40,12,0,14,mapped\n0,14,40,12,mapped\n");
    const RockIn<voussoir::Planar> rock = described_rock(
        read_input_text(mapped_case(set), "case.toml", "", {"joints.file=" + traces}));
    REQUIRE(rock.joints.size() == 2);
    CHECK(rock.joints[0].name == "joints.file, mapped");
    CHECK(rock.joints[0].asked == 2);  // two touch, and go on in nearly the same direction
    CHECK(rock.joints[0].used == 2);
    CHECK(rock.joints[1].name == "random");
    CHECK(rock.joints[1].used > 100);
    CHECK(rock.mass.bodies.size() > 100);
    // Its joints have its law: those of set 1 are random, those of set 0 were mapped.
    std::size_t mapped = 0;
    for (const auto& joint : rock.mass.joints) mapped += joint.set == 0;
    CHECK(mapped == 3);
  }
}

}  // namespace traces_test
