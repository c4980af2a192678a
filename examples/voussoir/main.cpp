// SPDX-License-Identifier: MIT
// voussoir: tunnel support design from an input file. `voussoir run FILE`, `voussoir diagram FILE`;
// `voussoir patterns` shows how unsupported tunnels fail; `voussoir paper` runs every analysis of
// the paper behind it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <type_traits>
#include <vector>
#include <voussoir/core/memory.hpp>
#include <voussoir/core/parallel.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/io/operating_system.hpp>

#include "completion.hpp"
#include "input_document.hpp"
#include "input_page.hpp"
#include "key_catalogue.hpp"
#include "patterns.hpp"
#include "ranks.hpp"
#include "run_diff.hpp"
#include "run_folder.hpp"
#include "templates.hpp"
#include "verbs.hpp"

using namespace voussoir::program;

namespace voussoir::program {

volatile std::sig_atomic_t stop_asked = 0;
Work work;

}  // namespace voussoir::program

namespace {

extern "C" void ask_to_stop(int signal) {
  stop_asked = 1;
  std::signal(signal, ask_to_stop);  // Windows forgets it
}

/// Which cases, and how many rock masses of each.
struct PatternChoice {
  std::vector<int> cases;
  int seeds = 3;
};

int patterns_verb(const Options& options, const PatternChoice& choice,
                  const PatternOptions& settings) {
  RunFolder outputs(options.folder);
  work = {"computing collapses with --threads " + std::to_string(options.threads),
          "fewer --threads, --cases or --seeds"};
  RunId run("patterns");
  run.add(settings.duration).add(settings.unloading);
  std::vector<PatternResult> results;
  for (const PatternCase& c : pattern_cases())
    if (choice.cases.empty() ||
        std::find(choice.cases.begin(), choice.cases.end(), c.number) != choice.cases.end())
      for (int seed = 1; seed <= choice.seeds; ++seed) {
        results.emplace_back();
        results.back().number = c.number;
        results.back().seed = static_cast<std::uint64_t>(seed);
        run.add(c.number).add(seed);
      }
  ProgressLine line(options.quiet);
  std::atomic<std::size_t> done{0};
  std::mutex guard;
  voussoir::parallel_for(results.size(), options.threads, [&](std::size_t k) {
    if (stop_asked != 0) return;
    const PatternCase& c = pattern_cases()[static_cast<std::size_t>(results[k].number - 1)];
    results[k] = run_pattern(c, results[k].seed, settings);
    const std::scoped_lock lock(guard);
    line.show("collapses", static_cast<double>(++done) / static_cast<double>(results.size()));
  });
  line.clear();
  if (stop_asked != 0) return say_interrupted();
  work.doing = "writing the results";
  const std::string id = run.text();
  outputs.add("patterns.csv", patterns_csv(results), id);
  outputs.add("patterns.svg", patterns_sheet(results), id);
  int roofs = 0, walls = 0;
  for (const PatternResult& result : results) {
    const PatternCase& c = pattern_cases()[static_cast<std::size_t>(result.number - 1)];
    char name[64];
    std::snprintf(name, sizeof name, "case_%02d_seed_%d.svg", result.number,
                  static_cast<int>(result.seed));
    outputs.add(name, pattern_svg(result), id);
    roofs += roof_agrees(c, result);
    walls += wall_agrees(c, result);
    if (options.quiet) continue;
    std::cout << "case " << result.number << ", seed " << result.seed << ": " << description(result)
              << "\n  paper: roof: " << to_string(c.roof) << "; walls: " << to_string(c.wall)
              << "\n";
    if (!result.note.empty()) std::cout << "  ended early: " << result.note << "\n";
  }
  if (!options.quiet)
    std::cout << "named as in the paper: roof " << roofs << ", walls " << walls << " of "
              << results.size() << " runs\n";
  publish(outputs, options, "patterns.csv, patterns.svg, case_*_seed_*.svg");
  return finished;
}

/// What `safety` is asked besides its input.
struct SafetyOptions {
  std::string limit = "collapse";
  double width = 1, largest = 5;  ///< of the bracket [%]; of the factors
  double loss = 0;                ///< tolerated [m^2]
  bool from_start = false, with_supports = false, without_limit = false;

  [[nodiscard]] SafetySettings settings() const {
    return {.limit = limit == "rockfall"   ? SafetyLimit::rockfall
                     : limit == "supports" ? SafetyLimit::supports
                                           : SafetyLimit::collapse,
            .tolerated_loss = loss,
            .search = {.most = largest, .width = 0.01 * width},
            .from_start = from_start,
            .with_supports = with_supports};
  }
};

void add_safety_options(CLI::App& verb, SafetyOptions& chosen) {
  verb.add_option("--falls-where", chosen.limit,
                  "collapse: most of it comes down; rockfall: rock or lining comes off; supports: "
                  "that, or one of them reaches its strength")
      ->capture_default_str()
      ->check(CLI::IsMember({"collapse", "rockfall", "supports"}));
  verb.add_option("--loss", chosen.loss,
                  "of rock that may come off all the same, not for collapse [m2 per metre]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e6));
  verb.add_option("--width", chosen.width, "between the two factors in the end [%]")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 50.0));
  verb.add_option("--largest", chosen.largest, "factor that is tried")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 1000.0));
  CLI::Option* const from_start = verb.add_flag(
      "--from-start", chosen.from_start,
      "every factor from the in-situ state on; else strength is divided once the tunnel stands");
  verb.add_flag("--with-supports", chosen.with_supports,
                "divide what bolts, feet and the bond of a lining bear, too")
      ->needs(from_start);
  verb.add_flag("--no-limit", chosen.without_limit, "without the bound by limit analysis");
}

/// Where this program lies, for scripts that call it from elsewhere.
std::string program_path(const char* called) {
  const std::filesystem::path path = voussoir::utf8_path(called == nullptr ? "voussoir" : called);
  return voussoir::utf8_text(
      path.has_parent_path() ? std::filesystem::absolute(path).lexically_normal() : path);
}

/// What was given in place of a verb; nothing if it is one, or none was given.
const char* unknown_verb(const std::vector<std::string>& verbs, int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    if (argv[k][0] == '-') continue;
    return std::find(verbs.begin(), verbs.end(), argv[k]) == verbs.end() ? argv[k] : nullptr;
  }
  return nullptr;
}

int run_program(int argc, char** argv) {
  CLI::App app("Designs bolts and lining of tunnels in jointed rock.");
  app.set_version_flag("--version", std::string("voussoir ") + VOUSSOIR_VERSION_STRING);
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 finished, and the tunnel of run is stable; 1 results cannot be written or\n"
      "memory is exhausted, 2 error in the input or the command line, 3 undecided (of diagram, sweep\n"
      "and realisations: one of their tunnels), 4 numerical fault, " +
      std::string(has_paper ? "5 a check of verify fails, " : "") +
      "6 the\n"
      "tunnel of run is stable after rockfall, 7 it collapses, 8 merge: cases are missing, 9 design:\n"
      "no support on the axes holds, 130 interrupted (results are not written; finished cases are\n"
      "kept).");
  Ranks ranks(argc, argv);
  Options options;
  options.ranks = &ranks;
  options.program = program_path(argv[0]);
  const auto add_out = [&options](CLI::App* verb) {
    verb->add_option("-o,--out", options.folder, "folder for the results, made if missing")
        ->capture_default_str();
  };
  const auto add_quiet = [&options](CLI::App* verb) {
    verb->add_flag("-q,--quiet", options.quiet, "print nothing but errors");
  };
  const auto add_threads = [&options](CLI::App* verb) {
    verb->add_option("-j,--threads", options.threads, "tunnels computed at a time")
        ->capture_default_str()
        ->check(CLI::Range(1U, 1024U));
  };
  const auto add_input = [&](CLI::App* verb) {
    verb->add_option("FILE", options.file, "input file (TOML)")->required();
    add_out(verb);
    verb->add_option("--set", options.overrides,
                     "KEY=VALUE in place of the file's, for example joint.kn=\"10 GPa/m\"")
        ->allow_extra_args(false);
    verb->add_option("--unset", options.removed,
                     "KEY that the file has, to be taken away: a value, a table, a list entry")
        ->allow_extra_args(false);
    add_quiet(verb);
  };
  CLI::App* init =
      app.add_subcommand("init", "an input file to begin with, with comments; it runs as it is");
  std::string template_name, template_file;
  bool lists_templates = false;
  std::vector<std::string> template_names;
  for (const Template& one : templates()) template_names.emplace_back(one.name);
  CLI::Option* const init_name =
      init->add_option("TEMPLATE", template_name, "which one, see --list")
          ->check(CLI::IsMember(template_names));
  init->add_option("FILE", template_file, "to be written; left out: standard output");
  init->add_flag("--list", lists_templates, "what there is");
  init->callback([&] {
    if (!lists_templates && init_name->count() == 0)
      throw CLI::ValidationError("TEMPLATE",
                                 "is missing; voussoir init --list shows what there is");
  });
  CLI::App* check = app.add_subcommand(
      "check", "what is known before anything is computed: the model made, in words and a picture");
  add_input(check);
  CLI::App* run = app.add_subcommand("run", "one tunnel: verdict, forces, picture");
  add_input(run);
  CLI::App* blocks = app.add_subcommand(
      "blocks", "the rock alone: sizes of blocks, scan lines, which blocks could leave the wall");
  add_input(blocks);
  CLI::App* grc = app.add_subcommand(
      "grc", "ground reaction with and without support; of a tunnel in 3-D the wall along it");
  add_input(grc);
  int reaction_steps = 10;
  grc->add_option("--steps", reaction_steps, "in which the wall is unloaded, in a section")
      ->capture_default_str()
      ->check(CLI::Range(2, 100));
  CLI::App* pullout = app.add_subcommand(
      "pullout", "the pull-out test of its bolts: head stiffness, first slip, what gives and when");
  add_input(pullout);
  std::vector<std::string> bonded_lengths;
  pullout
      ->add_option("--length", bonded_lengths,
                   "bonded, for example \"0.5 m\"; again for more; left out: the whole bolt")
      ->allow_extra_args(false);
  CLI::App* safety = app.add_subcommand(
      "safety",
      "factor of safety: by how much the strength of joints may be divided, and what falls");
  add_input(safety);
  SafetyOptions safety_options;
  add_safety_options(*safety, safety_options);
  CLI::App* explain = app.add_subcommand(
      "explain", "what a key of the input, a verdict, an exit status or a result means");
  std::string explained;
  explain->add_option("NAME", explained, "for example stress.K0, marginal, 6, run.json")
      ->required();
  CLI::App* schema = app.add_subcommand(
      "schema", "JSON schema of input files, by which an editor completes and checks them");
  CLI::App* completion =
      app.add_subcommand("completion", "a script that lets a shell complete verbs and keys");
  std::string shell;
  completion->add_option("SHELL", shell, "bash or zsh")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
  for (CLI::App* verb : {run, check, blocks, grc, pullout, safety})
    verb->add_flag("--json", options.json, "print JSON in place of words");
  CLI::App* diff = app.add_subcommand("diff", "what differs between two runs");
  std::vector<std::string> compared;
  diff->add_option("FOLDERS", compared, "two folders of results, or their run.json")
      ->required()
      ->expected(2);
  CLI::App* report = app.add_subcommand(
      "report", "the results of a folder as one page, to be read, printed and forwarded");
  std::string report_file;
  report->add_option("FOLDER", options.folder, "that run, diagram, realisations or sweep wrote to")
      ->required();
  report->add_option("-o,--out", report_file, "file; left out: report.html in the folder");
  bool wants_pdf = false;
  report->add_flag("--pdf", wants_pdf, "print it by Chromium, too: report.pdf beside it");
  add_quiet(report);
  CLI::App* diagram = app.add_subcommand(
      "diagram", "interaction diagram: crown convergence over bolt spacing and lining thickness");
  add_input(diagram);
  add_threads(diagram);
  CLI::App* realisations = app.add_subcommand(
      "realisations",
      "one design in many realisations of the rock: probabilities, distributions, what decides");
  add_input(realisations);
  add_threads(realisations);
  CLI::App* sweep = app.add_subcommand(
      "sweep", "one tunnel over lists and ranges of any keys: a table with a row for each");
  add_input(sweep);
  add_threads(sweep);
  PlanOptions plan;
  sweep
      ->add_option("--vary", plan.varied,
                   "KEY=A, B, C or KEY=A..B UNIT:N (N values), for example "
                   "support.lining.thickness=\"5 cm, 10 cm\"")
      ->allow_extra_args(false);
  CLI::App* design = app.add_subcommand(
      "design", "the cheapest supports on the axes of [diagram] that comply with [criteria]");
  add_input(design);
  add_threads(design);
  bool is_sure = false;
  design->add_flag("--sure", is_sure,
                   "criteria.probability with 95 % confidence, not only as the share found");
  design->add_flag("--json", options.json, "print JSON in place of words");
  for (CLI::App* verb : {diagram, design, realisations, sweep}) {
    CLI::Option* const count =
        verb->add_option("-n,--realisations", plan.realisations,
                         "of the rock: seeds model.seed, model.seed + 1, ...")
            ->check(CLI::Range(1, CasePlan::most_realisations));
    if (verb == realisations) {
      count->required();
      verb->add_option("--until-width", plan.until_width,
                       "stop before -n once no interval of a probability is wider, in percentage "
                       "points; looked at after 10, 20, 30, 40, 50, 100, 200, ...")
          ->check(CLI::Range(0.1, 100.0));
    } else {
      count->capture_default_str();
    }
    verb->add_option("--sampling", plan.sampling,
                     "of keys with a distribution: Latin hypercube, or plain Monte Carlo")
        ->capture_default_str()
        ->check(CLI::IsMember({"latin", "random"}));
    verb->add_flag("--discard", plan.discard,
                   "remove the cases of another input or program from the folder first");
    if (verb == design) continue;
    verb->add_option(
            "--plan", plan.engine,
            "compute nothing here: write a job array for Slurm, or a workflow for Snakemake")
        ->check(CLI::IsMember({"slurm", "snakemake"}));
    verb->add_option("--chunks", plan.chunks, "parts of the plan; left out: see --chunk-minutes")
        ->check(CLI::Range(1, 100000));
    verb->add_option("--chunk-minutes", plan.chunk_minutes,
                     "that a part lasts, about: one case is tried for that")
        ->capture_default_str()
        ->check(CLI::Range(0.1, 1440.0));
  }
  CLI::App* one_case = app.add_subcommand("case", "one chunk of a plan that --plan has written");
  std::string chunk;
  one_case->add_option("PLAN", options.file, "the plan's file, or its folder")->required();
  one_case->add_option("--chunk", chunk, "K/N: the K-th of N parts")->required();
  add_threads(one_case);
  add_quiet(one_case);
  CLI::App* merge =
      app.add_subcommand("merge", "joins the cases of one plan from any number of folders");
  std::vector<std::string> folders;
  std::string merged_folder;
  merge->add_option("PLAN", folders, "folders with a plan in them, or the plans' files")
      ->required();
  merge->add_option("-o,--out", merged_folder, "folder for the results; left out: the first");
  add_quiet(merge);
  CLI::App* patterns =
      app.add_subcommand("patterns", "how unsupported tunnels fail: 24 cases, every block moving");
  PatternChoice choice;
  PatternOptions settings;
  add_out(patterns);
  patterns->add_option("--cases", choice.cases, "numbers of cases, 1 to 24; all if none is given")
      ->check(CLI::Range(1, 24));
  patterns->add_option("--seeds", choice.seeds, "rock masses of each case")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  patterns->add_option("--duration", settings.duration, "time after the excavation [s]")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 60.0));
  patterns
      ->add_option("--unloading", settings.unloading,
                   "time over which the wall traction goes [s], 0: sudden")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 60.0));
  add_threads(patterns);
  add_quiet(patterns);
  CLI::App* paper = app.add_subcommand(
      "paper", "every analysis of Boon, Houlsby and Utili (2015) and what became of its claims");
  int samples = 5;
  std::string pages;
  add_out(paper);
  paper->add_option("--samples", samples, "random realisations of the rock mass")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  paper->add_option("--pages", pages,
                    "folder for a page of documentation on each analysis; none if not given");
  add_threads(paper);
  add_quiet(paper);
  paper->callback([&] {
    if (paper->count("--pages") > 0 && pages.empty())
      throw CLI::ValidationError("--pages", "the folder has no name");
  });
  CLI::App* verify = app.add_subcommand(
      "verify", "closed forms and solvers against values from elsewhere: PASS or FAIL");
  add_threads(verify);
  add_quiet(verify);
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
  std::vector<std::string> listed = verbs;
  if (!has_paper)  // not in the help, but who asks for them is told how to get them
    for (CLI::App* verb : {paper, verify}) {
      verb->group("");
      std::erase(listed, verb->get_name());
    }
  if (const char* word = unknown_verb(verbs, argc, argv)) {
    const std::string guess = closest(word, verbs);
    std::cerr << "error: `" << printable(word) << "` is not a verb of voussoir"
              << (guess.empty() ? "" : ", did you mean `" + guess + "`?") << "\n   = accepted: ";
    for (const std::string& verb : listed)
      std::cerr << verb << (verb == listed.back() ? "; see voussoir --help\n" : ", ");
    return bad_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? finished : bad_input;
  }
  for (std::size_t k = options.removed.size(); k-- > 0;)
    options.overrides.insert(options.overrides.begin(), "!" + options.removed[k]);
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
#ifdef SIGBREAK  // Windows: Ctrl-Break, or the window is closed
  std::signal(SIGBREAK, ask_to_stop);
#endif
  try {
    if (*schema) {
      std::cout << schema_json();
      return finished;
    }
    if (*explain) {
      std::cout << explanation(explained);
      return finished;
    }
    if (*completion) {
      std::cout << completion_script(app, shell);
      return finished;
    }
    if (*init) {
      if (!lists_templates) return init_verb(template_name, template_file);
      for (const Template& one : templates())
        std::cout << one.name << std::string(12 - one.name.size(), ' ') << one.sentence << "\n";
      return finished;
    }
    if (*diff) {
      std::cout << run_diff(compared[0], compared[1]);
      return finished;
    }
    if (*report) return report_verb(options, report_file, wants_pdf);
    if (*blocks) return blocks_verb(options);
    if (*grc) return grc_verb(options, reaction_steps);
    if (*pullout) return pullout_verb(options, bonded_lengths);
    if (*safety)
      return safety_verb(options, safety_options.settings(), !safety_options.without_limit);
    if (*check) return check_verb(options, check->count("--out") > 0);
    if (*patterns) return patterns_verb(options, choice, settings);
    if (*paper) return paper_verb(options, samples, pages);
    if (*verify) return verify_verb(options);
    if (*diagram) return plan_verb(options, PlanVerb::diagram, plan);
    if (*design) return design_verb(options, plan, is_sure);
    if (*realisations) return plan_verb(options, PlanVerb::realisations, plan);
    if (*sweep) return plan_verb(options, PlanVerb::sweep, plan);
    if (*one_case) return case_verb(options, chunk);
    if (*merge) {
      options.folder = merged_folder;
      return merge_verb(options, folders);
    }
    return run_verb(options);
  } catch (const InputErrors& errors) {
    std::cerr << errors.what() << "\n";
    return bad_input;
  } catch (const voussoir::Stopped&) {
    return say_interrupted();
  } catch (const voussoir::InvalidInput& error) {
    std::cerr << "error: " << error.what() << "\n";
    return bad_input;
  } catch (const voussoir::NumericalFault& fault) {
    std::cerr << "stopped: " << fault.what() << "\n";
    return numerical_fault;
  } catch (const voussoir::NotEnoughMemory& error) {
    std::cerr << "error: " << error.what() << "; nothing written\n   = accepted: " << work.remedy
              << "\n";
    return failed;
  } catch (const std::bad_alloc&) {
    std::cerr << "error: out of memory while " << work.doing
              << "; nothing written\n   = accepted: " << work.remedy << "\n";
    return failed;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return failed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  voussoir::keep_freed_memory();
  voussoir::let_writes_beyond_limit_fail();
  const voussoir::PlainOutput plain;
  std::vector<std::string> words = voussoir::program_arguments(argc, argv);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int status = run_program(static_cast<int>(words.size()), arguments.data());
  // A full disk behind `> file` shows only now.
  errno = 0;
  std::cout.flush();
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout;
  if (!lost) return status;
  const std::string reason = errno != 0 ? ": " + std::generic_category().message(errno) : "";
  std::cerr << "error: cannot write to standard output" << reason << "\n";
  return status == finished ? failed : status;
}
