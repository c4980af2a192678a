// SPDX-License-Identifier: MIT
// What cannot be computed is refused in words, and nothing is written.
#include <doctest/doctest.h>
#include <sys/resource.h>

#include <algorithm>

#include "harness.hpp"

// A sanitizer maps more memory than any limit would leave it. g++ tells by the first two names.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define VOUSSOIR_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define VOUSSOIR_SANITIZED
#endif
#endif

namespace program_bad_input_test {

namespace {

using namespace voussoir_test;

const std::string good = InputText{}.text();

// Whether the program has the verbs `paper` and `verify`.
#ifdef VOUSSOIR_TEST_ANALYSES
constexpr bool has_paper = true;
#else
constexpr bool has_paper = false;
#endif

/// One fault and what the message must name.
struct Fault {
  std::string from, to;
  std::vector<std::string> named;
};

/// Line of the file, from 1, on which `what` stands.
std::string line_of(const std::string& text, const std::string& what) {
  const auto at = text.begin() + static_cast<std::ptrdiff_t>(text.find(what));
  return std::to_string(1 + std::count(text.begin(), at, '\n'));
}

}  // namespace

TEST_SUITE("program/bad_input") {
  TEST_CASE("a fault in the file: status 2, file, line, key, value and what is accepted") {
    const Folder folder;
    const std::string out = folder / "out";
    // The results of an earlier run must survive.
    REQUIRE(
        run_program({"run", write_file(folder / "good.toml", good), "--out", out, "-q"}).status ==
        0);
    const auto before = contents(out);
    const std::vector<Fault> faults = {
        {"density = ", "densty = ", {"unknown key `densty`", "did you mean `density`"}},
        {"density = \"2700 kg/m^3\"", "# none", {"rock.density is missing"}},
        {"cover = ", "cover = \"9 m\"\ncover = ", {"cover", "given twice"}},
        {"\"5 GPa/m\"", "5e9", {"joint.kn = 5e9 has no unit", "5 GPa/m"}},
        {"\"5 GPa/m\"", "\"5 GPa\"", {"joint.kn", "5 GPa", "not a stiffness per area"}},
        {"K0 = 1.0", "K0 = nan", {"stress.K0 = nan", "not finite", "0 to 10"}},
        {"\"2700 kg/m^3\"", "\"-2700 kg/m^3\"", {"rock.density", "-2700", "from 1 kg/m^3"}},
        {"\"35 deg\"", "\"90 deg\"", {"joint.friction", "90 deg", "below 90 deg"}},
        {"width = \"24 m\"", "width = \"4 m\"", {"model.width", "\"4 m\"", "above 4 m"}},
        {"cover = \"8 m\"", "cover = \"0 m\"", {"tunnel.cover", "0 m", "above 0"}},
        {"cover = \"8 m\"", "cover = \"-1 m\"", {"tunnel.cover", "-1 m", "above 0"}},
        {"E = \"25 GPa\"", "E = \"25 GPa\"\nnodes = 3", {"support.lining.nodes = 3", "8 to 2000"}},
        {"\"30 deg\" }",
         "\"30 deg\", tensile_bond = \"0.5 MPa\" }",
         {"support.lining.interface.tensile_bond", "without strength in shear", "shear_bond"}},
        {"\"30 deg\" }",
         "\"30 deg\", shear_bond = \"0.5 MPa\", tensile_bond = \"2 MPa\" }",
         {"support.lining.interface.tensile_bond", "more than shear_bond / tan(friction)"}},
        // 12.5 m of wall, L = 0.2556 m.
        {"\"30 deg\" }",
         "\"30 deg\", shear_bond = \"0.5 MPa\", tensile_bond = \"0.2 MPa\" }\nnodes = 40",
         {"support.lining.nodes = 40", "41 to 2000", "1.2 L"}},
        {"E = \"25 GPa\"",
         "E = \"25 GPa\"\nfeet.stiffness = \"2 GPa/m\"",
         {"support.lining.feet", "a full ring has none", "a key arc"}},
        {"E = \"25 GPa\"",
         "E = \"25 GPa\"\nfeet = { width = \"20 cm\" }\narc = [\"0 deg\", \"180 deg\"]",
         {"support.lining.feet.stiffness is missing"}},
        {"E = \"25 GPa\"",
         "E = \"25 GPa\"\nfeet = { stiffness = \"2 GPa/m\", strength = \"0 MPa\" }\n"
         "arc = [\"0 deg\", \"180 deg\"]",
         {"support.lining.feet.strength", "0 MPa", "1 kPa"}},
        {"E = \"25 GPa\"",
         "E = \"25 GPa\"\nfeet = { stiffness = \"2 GPa/m\", beam = { depth = \"40 cm\", E = \"25 GPa\", "
         "spacing = \"0 m\" } }\narc = [\"0 deg\", \"180 deg\"]",
         {"support.lining.feet.beam.spacing", "0 m", "10 mm"}},
        {"E = \"25 GPa\"",
         "E = \"25 GPa\"\narc = \"roof and wall\"",
         {"support.lining.arc = \"roof and wall\"", "did you mean \"roof and walls\"?",
          R"("roof", "roof and walls")", R"("all")"}},
        {"E = \"25 GPa\"",
         "E = \"25 GPa\"\nfeet.stiffness = \"2 GPa/m\"\narc = \"all\"",
         {"support.lining.feet", "a full ring has none"}},
        {"shape = \"circle\"", "shape = \"oval\"", {"tunnel.shape", "oval", "circle"}},
        {"max_elongation = 5", "max_elongation = 1", {"blocks.max_elongation = 1", "2"}},
        {"\"0.2 m\"", "\"3 m\"", {"blocks.min_inscribed_radius", "3 m", "below 2 m"}},
        {"seed = 3", "seed = -1", {"model.seed = -1", "0"}},
        {"[model]",
         "#\nboundary = { sides = \"springs\" }\n[model]",
         {"boundary.sides", "springs", "rollers"}},
        {"[model]",
         "#\nboundary = { sides = \"elastic\" }\n[model]",
         {"boundary.sides", "boundary.base is left to be chosen", "both, or neither"}},
        {"[model]",
         "#\nboundary = { sides = \"rollers\", base = \"stress\" }\n[model]",
         {"boundary.base", "stress", "elastic"}},
        {"[model]",
         "#\nboundary = { sides = \"stress\", base = \"rollers\" }\n[model]",
         {"boundary.base", "free to slide", "elastic"}},
        {"[model]",
         "#\nboundary = { top = \"elastic\" }\n[model]",
         {"boundary.top", "stress.surcharge", "weighs nothing"}},
        {"[model]",
         "#\nboundary = { E = \"5 GPa\", nu = 0.5 }\n[model]",
         {"boundary.nu", "0.5", "below 0.5"}},
        {"[model]", "#\nboundary = { E = \"5 GPa\" }\n[model]", {"boundary.nu is missing"}},
        {"[model]", "#\nboundary = { nu = 0.2 }\n[model]", {"boundary.nu", "E"}},
    };
    for (const Fault& fault : faults) {
      CAPTURE(fault.to);
      const std::string text = replaced(good, fault.from, fault.to);
      const Outcome outcome =
          run_program({"run", write_file(folder / "case.toml", text), "--out", out});
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      CHECK(outcome.out.empty());
      CHECK(outcome.err.find("error: ") != std::string::npos);
      CHECK(outcome.err.find("accepted: ") != std::string::npos);
      for (const std::string& name : fault.named)
        CHECK_MESSAGE(outcome.err.find(name) != std::string::npos, name);
      // A missing key is shown at its table, a repeated one where it comes again.
      std::string line = line_of(text, fault.to);
      if (fault.to == "# none") line = line_of(text, "[rock]");
      if (fault.to.find('\n') != std::string::npos) line = std::to_string(std::stoi(line) + 1);
      CHECK(outcome.err.find("case.toml:" + line + ":") != std::string::npos);
      CHECK(contents(out) == before);
    }
  }

  TEST_CASE("elastic ground around rock whose moduli cannot be measured: what to give") {
    const Folder folder;
    InputText one_block;
    one_block.joints = "";
    const Outcome outcome = run_program({"run", write_file(folder / "case.toml", one_block.text()),
                                         "--out", folder / "out", "--set", "boundary.sides=elastic",
                                         "--set", "boundary.base=elastic"});
    CAPTURE(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find("moduli of the rock cannot be measured") != std::string::npos);
    CHECK(outcome.err.find("accepted: E and nu of the ground beyond") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
  }

  TEST_CASE("a fault in --set names the override") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", good);
    for (const std::string& fault :
         {std::string("joint.friction=90 deg"), std::string("rock.density=nan"),
          std::string("joint.kx=5 GPa/m"), std::string("nonsense")}) {
      CAPTURE(fault);
      const Outcome outcome = run_program({"run", file, "--out", folder / "out", "--set", fault});
      CHECK(outcome.status == 2);
      CHECK(outcome.err.find("--set " + fault) != std::string::npos);
      CHECK(outcome.err.find("accepted: ") != std::string::npos);
      CHECK_FALSE(std::filesystem::exists(folder / "out"));
    }
  }

  TEST_CASE("all faults are reported in one go") {
    const Folder folder;
    const std::string text =
        replaced(replaced(good, "\"5 GPa/m\"", "5e9"), "\"35 deg\"", "\"95 deg\"");
    const Outcome outcome =
        run_program({"run", write_file(folder / "case.toml", text), "--out", folder / "out"});
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find("joint.kn") != std::string::npos);
    CHECK(outcome.err.find("joint.friction") != std::string::npos);
    CHECK(outcome.err.find("2 errors") != std::string::npos);
  }

  TEST_CASE("a broken line in a file of joints is named with its number and what is accepted") {
    const Folder folder;
    InputText mapped;
    mapped.joints = "[joints]\nfile = \"traces.csv\"\n";
    const std::string file = write_file(folder / "case.toml", mapped.text());
    for (const std::string& line :
         {std::string("1,2,3"), std::string("1,2,3,4,5,6"), std::string("1,2,3,x"),
          std::string("1,2,nan,4"), std::string("1,2,1,2"), std::string("1,2,3,4,-1"),
          std::string("1;2;3;4"), std::string("1,2,3,")}) {
      CAPTURE(line);
      write_file(folder / "traces.csv", "x1,y1,x2,y2\n0,3,0,9\n" + line + "\n1,1,2,2\n");
      const Outcome outcome = run_program({"run", file, "--out", folder / "out"});
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      CHECK(outcome.err.find("traces.csv:3: ") != std::string::npos);
      CHECK(outcome.err.find(line) != std::string::npos);
      CHECK(outcome.err.find("the header is: x1, y1, x2, y2") != std::string::npos);
      CHECK_FALSE(std::filesystem::exists(folder / "out"));
    }
    std::filesystem::remove(folder / "traces.csv");
    const Outcome missing = run_program({"run", file, "--out", folder / "out"});
    CHECK(missing.status == 2);
    CHECK(missing.err.find("joints.file") != std::string::npos);
    CHECK(missing.err.find("traces.csv") != std::string::npos);
  }

  TEST_CASE("an input that is not there, is a folder or is no TOML is refused by name") {
    const Folder folder;
    const Outcome missing = run_program({"run", folder / "none.toml", "--out", folder / "out"});
    CHECK(missing.status == 2);
    CHECK(missing.err.find("none.toml") != std::string::npos);
    CHECK(run_program({"run", folder / ".", "--out", folder / "out"}).status == 2);
    for (const std::string& text :
         {std::string(), std::string("[model\n"), std::string(200, '\0')}) {
      const Outcome outcome =
          run_program({"run", write_file(folder / "case.toml", text), "--out", folder / "out"});
      CHECK(outcome.status == 2);
      CHECK(outcome.err.find("case.toml") != std::string::npos);
    }
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
  }

  TEST_CASE("a diagram without its table says what to write") {
    const Folder folder;
    const Outcome outcome =
        run_program({"diagram", write_file(folder / "case.toml", good), "--out", folder / "out"});
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find("[diagram]") != std::string::npos);
    CHECK(outcome.err.find("accepted: ") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
  }

  TEST_CASE("a wrong command line is status 2 and points to --help") {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                      {"run"},
                                                      {"walk"},
                                                      {"run", "a.toml", "b.toml"},
                                                      {"run", "a.toml", "--colour"},
                                                      {"diagram", "a.toml", "--threads", "0"}}) {
      const Outcome outcome = run_program(arguments);
      CHECK(outcome.status == 2);
      CHECK(outcome.err.find("--help") != std::string::npos);
    }
    const Outcome help = run_program({"--help"});
    CHECK(help.status == 0);
    CHECK(help.out.find("Exit status") != std::string::npos);
    CHECK(run_program({"--version"}).out.starts_with("voussoir "));
    // The quick start's program has neither verb: it lists none, and says how to get them.
    CHECK((help.out.find("\n  paper ") != std::string::npos) == has_paper);
    CHECK((help.out.find("verify") != std::string::npos) == has_paper);
    if (has_paper) return;
    for (const std::string verb : {"paper", "verify"}) {
      const Outcome asked = run_program({verb});
      CHECK(asked.status == 2);
      CHECK(asked.err.find("built without `" + verb + "`") != std::string::npos);
      CHECK(asked.err.find("build/release/voussoir " + verb) != std::string::npos);
    }
  }

  TEST_CASE("a word that is no verb is named, with the verb that was probably meant") {
    struct Case {
      std::string word, meant;
    };
    for (const Case& c : {Case{"rnu", "`run`"}, Case{"Run", "`run`"}, Case{"diagramm", "`diagram`"},
                          Case{"verfy", "`verify`"}, Case{"begin", ""}, Case{"", ""}}) {
      CAPTURE(c.word);
      const Outcome outcome = run_program({c.word, "--out", "nowhere"});
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      CHECK(outcome.err.find("`" + c.word + "` is not a verb") != std::string::npos);
      CHECK((outcome.err.find("did you mean " + c.meant) != std::string::npos) == !c.meant.empty());
      CHECK(outcome.err.find(
                "accepted: init, check, run, blocks, grc, pullout, safety, explain, schema, "
                "completion, diff, report, diagram, realisations, sweep, design, case, merge, "
                "patterns" +
                std::string(has_paper ? ", paper, verify; " : "; ")) != std::string::npos);
    }
  }

  TEST_CASE("a folder without a name is refused in a sentence") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", good);
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"run", file, "--out", ""}, {"patterns", "--out", ""}}) {
      const Outcome outcome = run_program(arguments);
      CHECK(outcome.status == 2);
      CHECK(outcome.err.find("--out \"\": the folder for the results has no name") !=
            std::string::npos);
      CHECK(outcome.err.find("accepted: --out results") != std::string::npos);
    }
    CHECK(run_program({"paper", "--pages", ""}).err.find("--pages: the folder has no name") !=
          std::string::npos);
    CHECK(run_program({"run", ""}).err.find("the input file has no name") != std::string::npos);
  }

  TEST_CASE("standard output that cannot be written is an error") {
    if (!std::filesystem::exists("/dev/full")) return;
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", good);
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"run", file, "--out", folder / "out"}, {"--help"}}) {
      const Outcome outcome = Running(arguments, "/dev/full").wait();
      CHECK(outcome.status == 1);
      CHECK(outcome.err.find("cannot write to standard output: No space left") !=
            std::string::npos);
    }
    CHECK(std::filesystem::exists(folder / "out/run.json"));  // the files are another matter
    CHECK(Running({"run", file, "--out", folder / "out", "-q"}, "/dev/full").wait().status == 0);
  }

#ifndef VOUSSOIR_SANITIZED
  TEST_CASE("memory that runs out is an error that says where, and what to reduce") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", good);
    const auto run_with = [&](rlim_t megabytes) {
      rlimit before{};
      REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
      rlimit small = before;
      small.rlim_cur = megabytes << 20U;
      REQUIRE(setrlimit(RLIMIT_AS, &small) == 0);  // inherited by the program
      Outcome outcome =
          run_program({"run", file, "--out", folder / "out", "--set", "model.width=200 m", "--set",
                       "model.below_invert=100 m", "--set", "blocks.min_inscribed_radius=1 cm"});
      REQUIRE(setrlimit(RLIMIT_AS, &before) == 0);
      return outcome;
    };
    // Wherever it runs out, while blocks are cut or in the search; a thread that finds no room for
    // its stack is no reason.
    for (const rlim_t megabytes : {60U, 150U, 180U, 190U, 200U, 210U, 220U}) {
      const Outcome outcome = run_with(megabytes);
      CAPTURE(megabytes);
      CAPTURE(outcome.err);
      CHECK(outcome.status == 1);
      CHECK(outcome.err.find("error: out of memory while ") != std::string::npos);
      CHECK(outcome.err.find("accepted: a smaller domain") != std::string::npos);
      CHECK(outcome.err.find("bad_alloc") == std::string::npos);
      CHECK_FALSE(std::filesystem::exists(folder / "out"));
    }
  }
#endif

  // Permissions do not stop root, which tests may be run as; a file or folder in the way does.
  TEST_CASE(
      "a folder that cannot be written is status 1, named, and nothing is left half-written") {
    const Folder folder;
    const std::string file = write_file(folder / "case.toml", good);
    const std::string in_the_way = write_file(folder / "taken", "mine");
    for (const std::string& out : {in_the_way, in_the_way + "/below"}) {
      const Outcome outcome = run_program({"run", file, "--out", out});
      CAPTURE(outcome.err);
      CHECK(outcome.status == 1);
      CHECK(outcome.err.find(out) != std::string::npos);
      CHECK(read_file(in_the_way) == "mine");
    }
    // The last of the four files cannot be replaced: none of the others may appear.
    std::filesystem::create_directories(folder / "out/blocks.svg");
    const auto before = contents(folder / "out");
    const Outcome outcome = run_program({"run", file, "--out", folder / "out"});
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("blocks.svg") != std::string::npos);
    CHECK(outcome.out.find("written") == std::string::npos);
    CHECK(contents(folder / "out") == before);
  }
}

}  // namespace program_bad_input_test
