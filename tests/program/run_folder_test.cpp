// SPDX-License-Identifier: MIT
// One run at a time in a folder, and every file says which run wrote it.
#include "run_folder.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>
#include <voussoir/core/errors.hpp>

#include "harness.hpp"

namespace program_run_folder_test {

using namespace voussoir_test;
using voussoir::program::RunFolder;
using voussoir::program::RunId;
using voussoir::program::with_run_id;

namespace {

const std::string good = InputText{}.text();

/// Explicit stepping without damping never comes to rest.
std::vector<std::string> endless(const std::string& file, const std::string& out) {
  return {"run",   file,
          "--out", out,
          "--set", "run.method=explicit",
          "--set", "run.damping=0",
          "--set", "run.max_steps=2000000000"};
}

void wait_for(const std::string& path) {
  for (int k = 0; k < 3000 && !std::filesystem::exists(path); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  REQUIRE(std::filesystem::exists(path));
}

/// A process that has ended and been waited for: nobody has its number now.
pid_t dead_process() {
  Running running({"--version"});
  const pid_t process = running.process();
  (void)running.wait();
  return process;
}

/// The id that a file holds; empty if none.
std::string run_id_in(const std::string& text) {
  for (const std::string& before : {std::string("\"run_id\": \""), std::string(", run ")}) {
    const std::size_t at = text.find(before);
    if (at != std::string::npos) return text.substr(at + before.size(), 16);
  }
  if (!text.starts_with("bolt") && !text.starts_with("lining")) return "";
  const std::size_t end = text.find_last_not_of("\r\n");
  return text.substr(end - 15, 16);  // the last cell of the last row
}

}  // namespace

TEST_SUITE("program/run_folder") {
  TEST_CASE("a second run into a folder is refused and names the process that holds it") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", good), out = folder / "out";
    Running first(endless(file, out));
    wait_for(folder / "out/.voussoir.lock");
    const Outcome second = run_program({"run", file, "--out", out});
    CAPTURE(second.err);
    CHECK(second.status == 1);
    CHECK(second.out.empty());
    CHECK(second.err.find("the folder is in use: process " + std::to_string(first.process()) +
                          " ") != std::string::npos);
    CHECK(second.err.find("accepted: another folder") != std::string::npos);
    CHECK(contents(out).size() == 1);
    CHECK(run_program({"run", file, "--out", folder / "other"}).status == 0);
    first.signal(SIGINT);
    CHECK(first.wait().status == 130);
    CHECK_FALSE(std::filesystem::exists(out));  // nothing written, nothing left
    CHECK(run_program({"run", file, "--out", out}).status == 0);
    CHECK(contents(out).size() == 5);
  }

  TEST_CASE("the lock of a killed run is taken over") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", good), out = folder / "out";
    Running first(endless(file, out));
    wait_for(folder / "out/.voussoir.lock");
    first.signal(SIGKILL);
    CHECK(first.wait().status == 1000 + SIGKILL);
    REQUIRE(std::filesystem::exists(folder / "out/.voussoir.lock"));
    const Outcome next = run_program({"run", file, "--out", out});
    CAPTURE(next.err);
    CHECK(next.status == 0);
    CHECK(contents(out).size() == 5);
  }

  TEST_CASE("part files of dead processes are cleared, all others stay") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", good), out = folder / "out";
    std::filesystem::create_directories(out);
    const std::string own = voussoir::detail::process_name();
    const std::string host = own.substr(own.find('@'));
    const std::string dead = std::to_string(dead_process()) + host;
    write_file(out + "/.run.json." + dead + ".123.part", "half a file");
    write_file(out + "/.blocks.svg." + dead + ".4561239.part", "");
    const std::vector<std::string> stay = {
        ".run.json." + own + ".123.part",            // of a process that runs
        ".run.json." + dead + "elsewhere.123.part",  // of another host
        "run.json." + dead + ".123.part",            // not hidden
        ".run.json." + dead + ".12x.part",           // not our pattern
        ".run.json.123.part",
        ".part",
        "notes.part",
        ".part.123@.part"};
    for (const std::string& name : stay) write_file(out + "/" + name, "kept");
    std::filesystem::create_directory(out + "/.folder." + dead + ".1.part");
    CHECK(run_program({"run", file, "--out", out, "-q"}).status == 0);
    CHECK(contents(out).size() == 5 + stay.size() + 1);
    for (const std::string& name : stay) CHECK(read_file(out + "/" + name) == "kept");
  }

  TEST_CASE("every file of a run holds its id, equal for equal inputs only") {
    const Folder folder;
    InputText input;
    input.rest = "[diagram]\nspacing = [\"30 deg\", \"none\"]\nthickness = [\"4 cm\", \"8 cm\"]\n";
    const std::string file = write_file(folder / "case.toml", input.text());
    const auto ids_of = [&](const std::string& name, std::vector<std::string> more) {
      more.insert(more.begin(), {"run", file, "--out", folder / name, "-q"});
      REQUIRE(run_program(more).status == 0);
      std::vector<std::string> ids;
      for (const auto& [path, text] : contents(folder / name)) ids.push_back(run_id_in(text));
      REQUIRE(ids.size() == 5);
      for (const std::string& id : ids) CHECK(id == ids.front());
      CHECK(ids.front().size() == 16);
      CHECK(ids.front().find_first_not_of("0123456789abcdef") == std::string::npos);
      return ids.front();
    };
    const std::string id = ids_of("one", {});
    CHECK(ids_of("again", {"--set", "stress.K0=1.0"}) == id);
    CHECK(ids_of("seed", {"--set", "model.seed=4"}) != id);
    CHECK(ids_of("other", {"--set", "stress.K0=1.1"}) != id);
    REQUIRE(run_program({"diagram", file, "--out", folder / "diagram", "-q"}).status == 0);
    CHECK(run_id_in(read_file(folder / "diagram/interaction.svg")) == id);
    CHECK(read_file(folder / "diagram/interaction.csv").find("," + id + "\r\n") !=
          std::string::npos);
  }

  TEST_CASE("mapped joints are part of what is computed") {
    const Folder folder;
    InputText mapped;
    mapped.joints = "[joints]\nfile = \"traces.csv\"\n";
    const std::string file = write_file(folder / "case.toml", mapped.text());
    std::vector<std::string> ids;
    for (const char* traces : {"-9,4,9,4\n", "-9,4,9,4\n", "-9,5,9,5\n"}) {
      write_file(folder / "traces.csv", traces);
      REQUIRE(run_program({"run", file, "--out", folder / "out", "-q"}).status == 0);
      ids.push_back(run_id_in(read_file(folder / "out/run.json")));
    }
    CHECK(ids[0] == ids[1]);
    CHECK(ids[0] != ids[2]);
  }

  TEST_CASE("the id goes where readers of each kind of file expect nothing else") {
    const std::string id = RunId("tunnel").add("x").text();
    CHECK(id != RunId("tunnel").add("y").text());
    CHECK(RunId("a").add("bc").text() != RunId("ab").add("c").text());
    CHECK(with_run_id("a.csv", "x,y\r\n1,2\r\n\"a\nb\",3\r\n", id) ==
          "x,y,run_id\r\n1,2," + id + "\r\n\"a\nb\",3," + id + "\r\n");
    CHECK(with_run_id("a.json", "{\n  \"b\": 1\n}\n", id) ==
          "{\n  \"run_id\": \"" + id + "\",\n  \"b\": 1\n}\n");
    for (const char* name : {"a.svg", "a.vtu", "a.html"}) {
      const std::string text = with_run_id(name, "<?xml version=\"1.0\"?>\n<a>\n</a>\n", id);
      CHECK(text.starts_with("<?xml version=\"1.0\"?>\n<!-- voussoir "));
      CHECK(text.find(", run " + id + " -->\n<a>") != std::string::npos);
    }
    CHECK(with_run_id("a.gp", "plot x\n", id).starts_with("# voussoir "));
    CHECK(with_run_id("a.png", "bytes", id) == "bytes");
  }

  TEST_CASE("a folder made for a run that fails is gone afterwards, one that was there is not") {
    const Folder folder;
    {
      RunFolder made(folder / "a/b");
      CHECK(std::filesystem::exists(folder / "a/b/.voussoir.lock"));
      CHECK_THROWS_WITH_AS(RunFolder(folder / "a/b"),
                           doctest::Contains(std::to_string(getpid()).c_str()), std::runtime_error);
    }
    CHECK_FALSE(std::filesystem::exists(folder / "a"));
    std::filesystem::create_directories(folder / "a");
    { RunFolder made(folder / "a/b"); }
    CHECK(std::filesystem::exists(folder / "a"));
    CHECK_FALSE(std::filesystem::exists(folder / "a/b"));
    {
      RunFolder made(folder / "a/b");
      made.add("x.txt", "text", "");
      made.publish();
    }
    CHECK(contents(folder / "a/b").size() == 1);
    CHECK_THROWS_AS(RunFolder(""), voussoir::InvalidInput);
  }
}

}  // namespace program_run_folder_test
