// SPDX-License-Identifier: MIT
// The report of a folder of results: a page that stands alone, says what the files say, and is of
// one run.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness.hpp"
#include "io/xml_check.hpp"
#include "run_results.hpp"

namespace program_report_test {

using namespace voussoir_test;
using Json = nlohmann::json;

namespace {

/// What stands in attributes of this name, everywhere.
std::vector<std::string> values_of(const std::string& html, const std::string& before, char close) {
  std::vector<std::string> values;
  for (std::size_t at = 0; (at = html.find(before, at)) != std::string::npos;) {
    at += before.size();
    values.push_back(html.substr(at, html.find(close, at) - at));
  }
  return values;
}

/// A page taken apart as XML, in which nothing may be left open.
struct Page {
  std::string fault;  ///< empty: well-formed, ids are unique
  std::map<std::string, int> elements;
  std::string text;  ///< without tags, style and script; entities as they are
};

Page taken_apart(std::string html) {
  Page page;
  html.erase(0, html.find('\n') + 1);  // <!DOCTYPE html>
  const auto cut_out = [&](const std::string& from, const std::string& to, bool is_text) {
    for (std::size_t at = 0; (at = html.find(from, at)) != std::string::npos;) {
      at += from.size();
      const std::size_t end = html.find(to, at);
      if (end == std::string::npos) page.fault = from + " without an end";
      const std::string inside = html.substr(at, end - at);
      if (is_text && inside.find_first_of("<&") != std::string::npos)
        page.fault = from + " is no XML";
      html.erase(at, inside.size());
    }
  };
  cut_out("<style>", "</style>", true);
  cut_out("<script>", "</script>", true);
  cut_out("<!--", "-->", false);
  for (std::size_t at; (at = html.find("<!---->")) != std::string::npos;) html.erase(at, 7);
  if (page.fault.empty()) page.fault = xml_fault(html);
  for (std::size_t at = 0; at < html.size();) {
    const std::size_t open = std::min(html.find('<', at), html.size());
    page.text += html.substr(at, open - at);
    if (open == html.size()) break;
    const std::string name = html.substr(open + 1, html.find_first_of(" />", open + 1) - open - 1);
    if (!name.empty()) ++page.elements[name];
    at = html.find('>', open) + 1;
  }
  return page;
}

/// What every report must be, whatever it is of.
Page sound_page(const std::string& html) {
  Page page = taken_apart(html);
  CHECK(page.fault == "");
  CHECK(html.size() < 5'000'000);
  const std::vector<std::string> all = values_of(html, " id=\"", '"');
  const std::set<std::string> ids(all.begin(), all.end());
  CHECK(ids.size() == all.size());
  for (const std::string& link : values_of(html, " href=\"", '"')) {
    CAPTURE(link);
    CHECK(link.starts_with("#"));  // to nothing but the page itself
    CHECK(ids.contains(link.substr(1)));
  }
  for (const std::string& reference : values_of(html, "=\"url(#", ')')) {
    CAPTURE(reference);
    CHECK(ids.contains(reference));
  }
  // No address, but for the names of namespaces, which nobody fetches.
  for (std::size_t at = 0; (at = html.find("://", at)) != std::string::npos; ++at)
    CHECK(html.substr(at - 11, 30).find("xmlns=\"http://www.w3.org/") != std::string::npos);
  CHECK(html.find("@import") == std::string::npos);
  CHECK(html.starts_with("<!DOCTYPE html>\n<!-- voussoir "));
  CHECK(page.elements["script"] == 1);
  CHECK(page.elements["link"] + page.elements["img"] + page.elements["iframe"] == 0);
  return page;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string number(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// As a page has it: m² for m2.
std::string raised(std::string text) {
  for (const auto& [plain, on_page] : {std::pair("m2", "m²"), std::pair("m3", "m³")})
    for (std::size_t at = 0; (at = text.find(plain, at)) != std::string::npos;)
      text.replace(at, 2, on_page);
  return text;
}

/// The number at the head under a name.
std::string card(const std::string& html, const std::string& name) {
  const std::string before = "<span class=\"name\">" + name + "</span><span class=\"value\">";
  const std::size_t at = html.find(before);
  REQUIRE(at != std::string::npos);
  const std::size_t from = at + before.size();
  return html.substr(from, html.find_first_of(" <", from) - from);
}

/// A small tunnel whose supports all have a strength.
InputText with_strength() {
  InputText text;
  text.lining += "[support.lining.concrete]\nfck = \"30 MPa\"\n";
  return text;
}

}  // namespace

TEST_SUITE("program/report") {
  TEST_CASE(
      "a run writes its report, whose sections stand in order and whose numbers are its own") {
    const Results run = results_of(with_strength().text());
    REQUIRE(run.outcome.status == 0);
    const std::string& html = run.files.at("report.html");
    const Page page = sound_page(html);
    std::size_t before = 0;
    for (const char* const id : {"verdict", "picture", "strength", "detached", "history", "basis",
                                 "inputs", "checks", "limits", "reproduce"}) {
      CAPTURE(id);
      const std::size_t at = html.find(std::string("<section id=\"") + id + "\"");
      CHECK(at != std::string::npos);
      CHECK(at > before);
      before = at;
    }
    CHECK(has(html, ">The tunnel stands</h2>"));
    const Json& json = run.json;
    double most = -1e9;
    for (const char* const place :
         {"crown_mm", "left_springing_mm", "right_springing_mm", "invert_mm"})
      most = std::max(most, json.at("convergence").at(place).get<double>());
    CHECK(card(html, "Largest convergence") == number("%.2f", most));
    CHECK(has(html, number("%.2g", most / 4000 * 100) + "\u00a0% of the width of 4\u00a0m"));
    const double force = json.at("bolts").at("largest_force_kN");
    CHECK(std::abs(std::stod(card(html, "Largest bolt force")) - force) <= 0.005 * force);
    const double use = json.at("lining").at("of_its_strength");
    CHECK(std::abs(std::stod(card(html, "Largest utilisation of the lining")) - 100 * use) <=
          0.05 * 100 * use);
    // The tables: the stage, the governing node, the bolt with the largest force.
    const Json& stage = json.at("stages").at(0);
    for (const char* const place : {"crown_mm", "left_springing_mm", "invert_mm"})
      CHECK(has(page.text, number("%.2f", stage.at("convergence").at(place))));
    CHECK(has(page.text, json.at("lining").at("governing").at("place").get<std::string>()));
    CHECK(has(page.text, number("%.1f", force)));
    CHECK(has(page.text, json.at("run_id").get<std::string>()));
    CHECK(has(page.text, json.at("result_hash").get<std::string>()));
    CHECK(has(page.text, json.at("build").at("compiler").get<std::string>()));
    CHECK(has(page.text, "5 GPa/m"));  // joint.kn as the file has it
    for (const Json& warning : json.at("warnings"))
      CHECK(has(page.text, raised(warning.get<std::string>())));
    // Both pictures, and places in them that speak.
    CHECK(page.elements.at("svg") == 2);
    CHECK(has(html, "class=\"spots\""));
    CHECK(has(html, "<title>bolt 1\n"));
    CHECK(has(html, "% of its strength</title>"));
  }

  TEST_CASE("rock that comes off is listed with its weight and place") {
    InputText text;
    text.bolts.clear();
    text.lining.clear();
    const Results run = results_of(text.text());
    const Page page = sound_page(run.files.at("report.html"));
    const Json& blocks = run.json.at("detached_blocks");
    REQUIRE(!blocks.empty());
    for (const Json& block : blocks) {
      // density times gravity times area: the default gravity is that of the Earth
      const double weight = 2.7 * 9.81 * block.at("area_m2").get<double>();
      CHECK(std::abs(block.at("weight_kN_per_m").get<double>() - weight) <= 1e-9 * weight);
      CHECK(has(page.text, number("%.3f", block.at("area_m2"))));
      CHECK(has(page.text, number("%.1f", weight)));
      CHECK(has(page.text, block.at("from").get<std::string>()));
    }
    CHECK(has(page.text, run.json.at("verdict") == "collapse"
                             ? "The tunnel collapses"
                             : "The tunnel stands after rockfall"));
    CHECK(has(page.text, "it has no supports"));
    // Where a support carries more than it bears besides, the head says so too.
    const Folder folder;
    auto beyond = nlohmann::ordered_json::parse(run.files.at("run.json"));
    beyond["verdict"] = "stable after rockfall";
    beyond["bolts"]["of_its_strength"] = 1.2;
    std::filesystem::create_directory(folder / "out");
    (void)write_file(folder / "out/run.json", beyond.dump(2));
    const Outcome outcome = run_program({"report", folder / "out"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(has(sound_page(read_file(folder / "out/report.html")).text,
              "The tunnel stands after rockfall, and a support carries more than it bears"));
  }

  TEST_CASE("what an input says is text, whatever it looks like") {
    const Folder folder;
    const std::string title = "<script>alert(1)</script> & \\\"quoted\\\" 'x' ]]> -->";
    InputText text;
    text.joints = replaced(text.joints, "[[joint_set]]\n",
                           "[[joint_set]]\nname = \"<img src=x onerror=alert(2)>\"\n");
    const std::string file =
        write_file(folder / "a&b <i>.toml", "title = \"" + title + "\"\n" + text.text());
    const Outcome outcome = run_program({"run", file, "--out", folder / "out", "-q"});
    CAPTURE(outcome.err);
    CHECK(outcome.status == 0);
    const std::string html = read_file(folder / "out/report.html");
    const Page page = sound_page(html);
    CHECK(has(page.text, "&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;quoted&quot;"));
    CHECK(has(page.text, "a&amp;b &lt;i&gt;.toml"));
    CHECK(has(page.text, "&lt;img src=x onerror=alert(2)&gt;"));
    CHECK(page.elements.count("i") == 0);
  }

  TEST_CASE("the verb writes what the run wrote, where it is told to") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", InputText{}.text());
    REQUIRE(run_program({"run", file, "--out", folder / "out", "-q"}).status == 0);
    const std::string written = read_file(folder / "out/report.html");
    std::filesystem::remove(folder / "out/report.html");
    const Outcome first = run_program({"report", folder / "out"});
    CAPTURE(first.err);
    CHECK(first.status == 0);
    CHECK(has(first.out, "report.html"));
    CHECK(read_file(folder / "out/report.html") == written);
    const Outcome second =
        run_program({"report", folder / "out", "-o", folder / "page.html", "-q"});
    CHECK(second.status == 0);
    CHECK(second.out.empty());
    CHECK(read_file(folder / "page.html") == written);
  }

  TEST_CASE("folders that are of no run, or of two, are refused by the name of the file") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", InputText{}.text());
    const std::string out = folder / "out";
    REQUIRE(run_program({"run", file, "--out", out, "-q"}).status == 0);
    REQUIRE(run_program({"run", file, "--out", folder / "other", "-q", "--set", "model.seed=4"})
                .status == 0);
    std::filesystem::remove(out + "/report.html");
    const auto refused = [&](const std::string& at, const std::vector<std::string>& words) {
      const Outcome outcome = run_program({"report", at});
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      CHECK(has(outcome.err, "accepted: "));
      for (const std::string& word : words) CHECK(has(outcome.err, word));
      CHECK_FALSE(std::filesystem::exists(at + "/report.html"));
    };
    refused(folder / "none", {"none: there is no such folder"});
    refused(file, {"case.toml is no folder"});
    std::filesystem::create_directory(folder / "empty");
    refused(folder / "empty", {"empty: holds no results"});
    // A file of another run; of none; a run.json that is damaged.
    for (const char* const name : {"bolts.csv", "lining.csv", "blocks.svg", "run.json"}) {
      CAPTURE(name);
      const std::string path = out + "/" + name, mine = read_file(path),
                        others = read_file(folder / (std::string("other/") + name));
      write_file(path, others);
      refused(out, {std::string(name) == "run.json" ? "blocks.svg" : name, "another run"});
      write_file(path, mine);
    }
    const std::string json = read_file(out + "/run.json");
    for (const std::string& damaged :
         {json.substr(0, json.size() / 2), std::string("[]"), std::string(),
          replaced(json, "\n  \"verdict\"", "\n  \"verdikt\"")}) {
      write_file(out + "/run.json", damaged);
      refused(out, {"run.json"});
    }
    std::filesystem::remove(out + "/run.json");
    refused(out, {"run.json is missing"});
    write_file(out + "/run.json", json);
    write_file(out + "/blocks.svg", "<svg></svg>");
    refused(out, {"blocks.svg does not say of which run it is"});
    std::filesystem::remove(out + "/blocks.svg");
    std::filesystem::create_directory(out + "/blocks.svg");
    refused(out, {"blocks.svg cannot be read: it is a folder"});
  }

  TEST_CASE("values of another kind than expected leave a gap, and no damage") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", InputText{}.text());
    const std::string out = folder / "out";
    REQUIRE(run_program({"run", file, "--out", out, "-q"}).status == 0);
    using Ordered = nlohmann::ordered_json;  // the id stays in front
    const Ordered json = Ordered::parse(read_file(out + "/run.json"));
    for (const auto& [key, value] : json.items()) {
      if (key == "run_id" || key == "verdict") continue;
      for (const char* const other : {"null", "\"text\"", "7", "[1]", "{\"a\": 1}"}) {
        Ordered changed = json;
        changed[key] = Ordered::parse(other);
        write_file(out + "/run.json", changed.dump(2));
        const Outcome outcome = run_program({"report", out, "-q"});
        const std::string& changed_key = key;
        CAPTURE(changed_key);
        CAPTURE(outcome.err);
        CHECK(outcome.status == 0);
        CHECK(taken_apart(read_file(out + "/report.html")).fault == "");
      }
    }
  }

  TEST_CASE("run.json says what was read, from where and by which build, and has a hash") {
    const Folder folder;
    const std::string text = InputText{}.text();
    const auto ran = [&](const std::string& name, const std::vector<std::string>& more) {
      std::vector<std::string> arguments{"run", write_file(folder / (name + ".toml"), text),
                                         "--out", folder / name, "-q"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      REQUIRE(run_program(arguments).status == 0);
      return Json::parse(read_file(folder / (name + "/run.json")));
    };
    const Json a = ran("a", {}), b = ran("b", {}), c = ran("c", {"--set", "joint.friction=40 deg"});
    CHECK(a.at("input").at("file") == "a.toml");
    CHECK(a.at("input").at("hash") == b.at("input").at("hash"));
    CHECK(a.at("result_hash") == b.at("result_hash"));
    CHECK(a.at("result_hash") != c.at("result_hash"));
    CHECK(a.at("run_id") == b.at("run_id"));
    CHECK(a.at("input").at("keys").at("joint.friction") == "35 deg");
    CHECK(c.at("input").at("keys").at("joint.friction") == "40 deg");
    CHECK(a.at("input").at("overrides").empty());
    CHECK(c.at("input").at("overrides").at(0) == "joint.friction=40 deg");
    CHECK(a.at("acceptance").at("error_estimate") == 1e-3);
    CHECK(a.at("tunnel").at("width_m") == 4.0);
    CHECK(a.at("build").at("compiler").get<std::string>().find("++ ") != std::string::npos);
    const std::string page = read_file(folder / "c/report.html");
    CHECK(has(page, "40 deg  (set on the command line)"));
    CHECK(has(page, "voussoir run c.toml --set &#39;joint.friction=40 deg&#39;"));
  }

  TEST_CASE("a tunnel in 3-D and blocks that are laid have reports of their own") {
    std::string text = CircleInRock{}.text();
    const Results spatial = results_of(
        replaced(text, "[model]\n", "[model]\ndimension = 3\n") +
        "[support.bolts]\nlength = \"2 m\"\nspacing = \"45 deg\"\nout_of_plane = \"1 m\"\n"
        "stiffness = \"0.2 GN/m\"\nyield_force = \"200 kN\"\n");
    const Page in_space = sound_page(spatial.files.at("report.html"));
    CHECK(has(in_space.text, "Tunnel in 3-D, "));
    CHECK(has(in_space.text, number("%.1f", spatial.json.at("bolts").at("largest_force_kN"))));
    CHECK(has(spatial.files.at("report.html"), "<title>block "));
    const Folder folder;
    const Outcome laid =
        run_program({"run", std::string(VOUSSOIR_TEST_EXAMPLES) + "/blocks/arch.toml", "--out",
                     folder / "out", "-q"});
    CAPTURE(laid.err);
    const Page blocks = sound_page(read_file(folder / "out/report.html"));
    const Json json = Json::parse(read_file(folder / "out/run.json"));
    CHECK(has(blocks.text, "Laid blocks in 2-D, " + json.at("blocks").at("count").dump()));
    CHECK(has(blocks.text, "Limits of the model"));
    CHECK(has(blocks.text, json.at("fallen_blocks").at(0).get<std::string>()));
    CHECK(has(read_file(folder / "out/report.html"), "<title>voussoir 1\nmoved "));
    CHECK(json.at("input").at("keys").is_object());
  }

  TEST_CASE("stages before the last have pictures of their own, of this run") {
    const Folder folder;
    const std::string
        out = folder / "out",
        file = write_file(
            folder / "case.toml",
            InputText{}.text() +
                "[[stage]]\nname = \"heading\"\nwall_traction = \"60 %\"\n"
                "[[stage]]\nname = \"bolts <1>\"\nwall_traction = \"20 %\"\n"
                "install = [\"bolts\"]\n[[stage]]\nname = \"lining\"\nwall_traction = 0\n"
                "install = [\"lining\"]\n");
    const Outcome run = run_program({"run", file, "--out", out});
    CAPTURE(run.err);
    REQUIRE(run.status == 0);
    const std::string html = read_file(out + "/report.html");
    const Page page = sound_page(html);
    CHECK(page.elements.at("figure") == 4);  // three stages, and convergence over them
    CHECK(has(page.text, "Stage 1, heading: stable."));
    CHECK(has(page.text, "Stage 2, bolts &lt;1&gt;: stable."));
    CHECK(std::filesystem::exists(out + "/history/stage_002.svg"));
    CHECK_FALSE(std::filesystem::exists(out + "/history/stage_003.svg"));
    REQUIRE(run_program({"report", out, "-q"}).status == 0);
    CHECK(read_file(out + "/report.html") == html);
    // One of another run is refused; a run without stages clears them away.
    const std::string picture = read_file(out + "/history/stage_001.svg");
    const std::string id = nlohmann::json::parse(read_file(out + "/run.json")).at("run_id");
    write_file(out + "/history/stage_001.svg", replaced(picture, id, "0123456789abcdef"));
    const Outcome mixed = run_program({"report", out, "-q"});
    CHECK(mixed.status == 2);
    CHECK(has(mixed.err, "stage_001.svg is of another run (0123456789abcdef)"));
    REQUIRE(
        run_program({"run", file, "--out", out, "-q", "--set", "picture.history=false"}).status ==
        0);
    CHECK_FALSE(std::filesystem::exists(out + "/history"));
    CHECK(taken_apart(read_file(out + "/report.html")).elements.at("figure") == 2);
  }

  TEST_CASE("many tunnels: alone, and beside the run of their tunnel") {
    const Folder folder;
    InputText small;
    const std::string text =
        small.text() +
        "[diagram]\nspacing = [\"30 deg\", \"none\"]\nthickness = [\"8 cm\", \"12 cm\"]\n";
    const std::string file = write_file(folder / "case.toml", text);
    const std::string many = folder / "many", both = folder / "both";
    REQUIRE(run_program({"realisations", file, "-n", "3", "--out", many, "-q"}).status != 2);
    REQUIRE(run_program({"report", many, "-q"}).status == 0);
    const Page realisations = sound_page(read_file(many + "/report.html"));
    CHECK(has(realisations.text, "Realisations and probabilities"));
    const Json json = Json::parse(read_file(many + "/realisations.json"));
    const Json& crown = json.at("quantities").begin().value();
    CHECK(has(realisations.text, crown.at("unit").get<std::string>()));
    // One design: its run, its diagram and its realisations share a folder.
    REQUIRE(run_program({"run", file, "--out", both, "-q"}).status != 2);
    REQUIRE(run_program({"diagram", file, "--out", both, "-q"}).status != 2);
    REQUIRE(run_program({"report", both, "-q"}).status == 0);
    const Page diagram = sound_page(read_file(both + "/report.html"));
    CHECK(has(diagram.text, "Interaction diagram"));
    // Of several realisations it has an id of its own, and says of which tunnel it is.
    const std::string several = folder / "several";
    REQUIRE(run_program({"run", file, "--out", several, "-q"}).status != 2);
    REQUIRE(run_program({"diagram", file, "-n", "2", "--out", several, "-q"}).status != 2);
    REQUIRE(run_program({"report", several, "-q"}).status == 0);
    CHECK(has(sound_page(read_file(several + "/report.html")).text, "Interaction diagram"));
    std::filesystem::remove(several + "/interaction.json");
    CHECK(has(run_program({"report", several, "-q"}).err, "interaction.csv is of another run"));
    for (const char* const name : {"realisations.json", "realisations.csv", "realisations.svg"})
      std::filesystem::copy(many + "/" + name, both + "/" + name);
    const Outcome all = run_program({"report", both, "-q"});
    CAPTURE(all.err);
    CHECK(all.status == 0);
    CHECK(has(read_file(both + "/report.html"), "Realisations and probabilities"));
    // So does its factor of safety, if it says so; one that does not is of another run.
    const std::string safety =
        "\"factor_of_safety\": 1.37,\n  \"text\": \"1.37 <of> it\",\n  \"stands_over\": 1.37,\n"
        "  \"falls_over\": 1.38,\n  \"falls_where\": \"a block falls\",\n  \"trials\": "
        "[{\"factor\": 1.372, \"outcome\": \"stands\", \"verdict\": \"stable\"}]\n}\n";
    const std::string start = "{\n  \"run_id\": \"00000000000000aa\",\n  ";
    const std::string id = Json::parse(read_file(both + "/run.json")).at("run_id");
    write_file(both + "/safety.json", start + safety);
    const Outcome other = run_program({"report", both, "-q"});
    CHECK(other.status == 2);
    CHECK(has(other.err, "safety.json is of another run (00000000000000aa) than run.json"));
    write_file(both + "/safety.json", start + "\"tunnel_id\": \"" + id + "\",\n  " + safety);
    REQUIRE(run_program({"report", both, "-q"}).status == 0);
    const std::string with_safety = read_file(both + "/report.html");
    const Page safe = sound_page(with_safety);
    CHECK(card(with_safety, "Factor of safety") == "1.37");
    for (const char* const words : {"1.37 &lt;of&gt; it", "1.372", "falls where", "a block falls"})
      CHECK(has(safe.text, words));
    // Realisations of another design do not.
    REQUIRE(run_program({"realisations", file, "-n", "2", "--out", folder / "others", "-q", "--set",
                         "joint.friction=40 deg"})
                .status != 2);
    for (const char* const name : {"realisations.json", "realisations.csv", "realisations.svg"})
      std::filesystem::copy(folder / (std::string("others/") + name), both + "/" + name,
                            std::filesystem::copy_options::overwrite_existing);
    const Outcome mixed = run_program({"report", both, "-q"});
    CHECK(mixed.status == 2);
    CHECK(has(mixed.err, "realisations.json is of another run"));
  }

  TEST_CASE("what safety and design have found of a tunnel is in its report") {
    const Folder folder;
    const std::string file = write_file(
        folder / "case.toml",
        InputText{}.text() +
            "[diagram]\nspacing = [\"30 deg\", \"none\"]\nthickness = [\"8 cm\", \"12 cm\"]\n"
            "[criteria]\nconvergence = \"1 m\"\n[costs]\nbolt_per_metre = 20\n"
            "concrete_per_m3 = 400\n");
    const std::string out = folder / "out";
    for (const std::vector<std::string>& verb : {std::vector<std::string>{"run"},
                                                 {"safety", "--largest", "1.5"},
                                                 {"design", "-n", "2"},
                                                 {"diagram", "-n", "2"}}) {
      std::vector<std::string> arguments{verb.front(), file, "--out", out, "-q"};
      arguments.insert(arguments.end(), verb.begin() + 1, verb.end());
      const Outcome outcome = run_program(arguments);
      CAPTURE(outcome.err);
      REQUIRE(outcome.status != 2);
    }
    const Outcome outcome = run_program({"report", out, "-q"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    const std::string html = read_file(out + "/report.html");
    const Page page = sound_page(html);
    const Json safety = Json::parse(read_file(out + "/safety.json")),
               design = Json::parse(read_file(out + "/design.json"));
    CHECK(has(page.text, "Factor of safety"));
    CHECK(has(page.text, safety.at("text").get<std::string>()));
    CHECK(has(page.text, "Cheapest support that holds"));
    CHECK(has(page.text, design.at("text").get<std::string>()));
    CHECK(has(page.text, "Interaction diagram"));
    // Of other joints it is of another tunnel.
    REQUIRE(run_program(
                {"safety", file, "--largest", "1.5", "--set", "model.seed=4", "--out", out, "-q"})
                .status != 2);
    const Outcome mixed = run_program({"report", out, "-q"});
    CHECK(mixed.status == 2);
    CHECK(has(mixed.err, "safety.json is of another run"));
  }
}

}  // namespace program_report_test
