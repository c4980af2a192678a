// SPDX-License-Identifier: MIT
// From where the picture of a tunnel in 3-D shows it, and its stages as ParaView plays them.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness.hpp"
#include "input.hpp"
#include "run_results.hpp"

namespace {

using namespace voussoir_test;
using namespace voussoir::program;
using voussoir::ViewFrom;

/// A circle of 4 m in few blocks, driven in two rounds of three metres; rock is left ahead.
const std::string two_rounds = R"(
[model]
dimension = 3
length = "9 m"
width = "20 m"
below_invert = "8 m"
[tunnel]
shape = "circle"
diameter = "4 m"
cover = "8 m"
facets = 16
trend = "30 deg"
round_length = "3 m"
rounds = 2
[rock]
density = "2700 kg/m^3"
[stress]
K0 = 1
surcharge = "500 kPa"
[[joint_set]]
dip = "70 deg"
dip_direction = "100 deg"
spacing = "2.5 m"
[[joint_set]]
dip = "20 deg"
dip_direction = "250 deg"
spacing = "2.5 m"
[[joint_set]]
dip = "85 deg"
dip_direction = "20 deg"
spacing = "3 m"
[joint]
kn = "5 GPa/m"
ks = "0.5 GPa/m"
friction = "30 deg"
[blocks]
min_inscribed_radius = "0.3 m"
[support.bolts]
length = "2 m"
spacing = "30 deg"
stiffness = "0.2 GN/m"
[[round]]
name = "face"
[[round]]
name = "bolts"
excavate = "nothing"
install = ["bolts"]
behind = 1
)";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Files below a folder by their names from there, with what they hold.
std::map<std::string, std::string> files_below(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& [path, text] : contents(folder))
    if (std::filesystem::is_regular_file(path))
      files[std::filesystem::path(path).lexically_relative(folder).generic_string()] = text;
  return files;
}

/// The ids of the files that hold one: "run 0123456789abcdef".
std::string run_id_of(const std::string& text) {
  const std::size_t at = text.find(", run ");
  return at == std::string::npos ? "" : text.substr(at + 6, 16);
}

}  // namespace

TEST_SUITE("program/spatial_pictures") {
  TEST_CASE("picture.from: its words, what it is without, and in a section it is not used") {
    const auto from = [](const std::vector<std::string>& overrides) {
      return read_input_text(two_rounds, "case.toml", ".", overrides);
    };
    CHECK(from({}).picture.from == ViewFrom::axis);
    CHECK(from({"picture.from=axis"}).picture.from == ViewFrom::axis);
    CHECK(from({"picture.from=face"}).picture.from == ViewFrom::face);
    const Input above = from({"picture.from=above"});
    CHECK(above.picture.from == ViewFrom::above);
    CHECK(above.unused.empty());
    const auto unused = from({"picture.from=above", "model.dimension=2"}).unused;
    CHECK(std::count(unused.begin(), unused.end(), "picture.from") == 1);
    CHECK(std::count(unused.begin(), unused.end(), "picture.to") == 0);
    for (const char* const wrong : {"picture.from=portal", "picture.to=face"}) {
      CAPTURE(wrong);
      CHECK_THROWS_AS((void)from({wrong}), InputErrors);
    }
  }

  TEST_CASE(
      "stages are played by history.pvd, each file of this run, and others are cleared away") {
    const Folder folder;
    const std::string out = folder / "out", file = write_file(folder / "case.toml", two_rounds);
    const auto run = [&](std::vector<std::string> more) {
      more.insert(more.begin(), {"run", file, "--out", out});
      Outcome outcome = run_program(more);
      INFO(outcome.err);
      CHECK((outcome.status == 0 || outcome.status == 6));
      return outcome;
    };
    // Three stages: two rounds, and the bolts behind the second.
    const Outcome first = run({"--set", "picture.from=face"});
    CHECK(contains(first.out, "history.pvd"));
    auto files = files_below(out);
    const std::string id = run_id_of(files.at("blocks.vtu"));
    REQUIRE(id.size() == 16);
    std::size_t stages = 0;
    for (const auto& file_of_run : files)
      if (const std::string& name = file_of_run.first; name.starts_with("history")) {
        CAPTURE(name);
        CHECK(run_id_of(file_of_run.second) == id);
        stages += name.ends_with(".vtm");
      }
    CHECK(stages == 3);
    for (std::size_t stage = 1; stage <= stages; ++stage) {
      const std::string name = "history/stage_00" + std::to_string(stage);
      CHECK(contains(files.at("history.pvd"), "timestep=\"" + std::to_string(stage) +
                                                  "\" group=\"\" part=\"0\" file=\"" + name +
                                                  ".vtm\""));
      CHECK(contains(files.at(name + "_blocks.vtu"), "Name=\"displacement_m\""));
      CHECK(files.count(name + "_bolts.vtu") == (stage > 1 ? 1 : 0));
    }
    CHECK(
        contains(files.at("blocks.svg"),
                 "Seen from the portal: cut across at 4.5 m along the axis, the face is at 6 m."));

    // One stage: no history, and nothing is left of the one before, but what is not ours.
    (void)write_file(out + "/history/notes.txt", "mine");
    (void)write_file(out + "/history/stage_001_mine.vtu", "<?xml version=\"1.0\"?>\n<VTKFile/>\n");
    const Outcome second =
        run({"--set", "tunnel.rounds=1", "--unset", "support", "--unset", "round"});
    CHECK_FALSE(contains(second.out, "history"));
    files = files_below(out);
    CHECK(run_id_of(files.at("blocks.vtu")) != id);
    for (const char* const gone :
         {"history.pvd", "bolts.vtu", "history/stage_001.vtm", "history/stage_003_blocks.vtu"})
      CHECK(files.count(gone) == 0);
    for (const char* const kept : {"history/notes.txt", "history/stage_001_mine.vtu"})
      CHECK(files.count(kept) == 1);
    CHECK_FALSE(contains(files.at("blocks.svg"), "Seen from"));

    // Nor where none is asked for, and as little in a section.
    CHECK_FALSE(contains(run({"--set", "picture.history=false"}).out, "history"));
    CHECK(files_below(out).count("history.pvd") == 0);
    CHECK(files_below(out).count("history/stage_001.vtm") == 0);
    std::filesystem::remove(out + "/history/notes.txt");
    std::filesystem::remove(out + "/history/stage_001_mine.vtu");
    (void)run({"--set", "model.dimension=2", "--unset", "support", "--unset", "round"});
    for (const auto& [name, text] : files_below(out)) CHECK_FALSE(name.ends_with(".vtu"));
    CHECK_FALSE(std::filesystem::exists(out + "/history"));
  }

  TEST_CASE(
      "what stands where the folder of stages has to be is named before anything is computed") {
    const Folder folder;
    const std::string out = folder / "out", file = write_file(folder / "case.toml", two_rounds);
    std::filesystem::create_directory(out);
    (void)write_file(out + "/history", "mine");
    const Outcome outcome = run_program({"run", file, "--out", out});
    CHECK(outcome.status == 1);
    CHECK(contains(outcome.err, "history' is not a folder"));
    CHECK(files_below(out).size() == 1);
    CHECK(read_file(out + "/history") == "mine");
  }
}
