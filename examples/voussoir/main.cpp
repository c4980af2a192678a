// SPDX-License-Identifier: MIT
// voussoir: tunnel support design from an input file. `voussoir run FILE`, `voussoir diagram FILE`.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <thread>
#include <vector>
#include <voussoir/core/version.hpp>

#include "outputs.hpp"

namespace {

using namespace voussoir::program;

enum ExitStatus {
  finished = 0,
  failed = 1,
  bad_input = 2,
  not_decided = 3,
  numerical_fault = 4,
  interrupted = 130
};

volatile std::sig_atomic_t stop_asked = 0;
extern "C" void ask_to_stop(int) { stop_asked = 1; }

struct Options {
  std::string file, folder = ".";
  std::vector<std::string> overrides;
  bool quiet = false;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
};

/// One line that rewrites itself on a terminal, nothing in a pipe.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet) : shown_(!quiet && isatty(fileno(stderr)) != 0) {}
  ~ProgressLine() { clear(); }
  bool show(const std::string& what, double fraction) {
    if (shown_) {
      if (fraction >= 0) {
        const int filled = static_cast<int>(30 * fraction);
        std::fprintf(stderr, "\r\033[K%s [%-30s] %3.0f %%", what.c_str(),
                     std::string(static_cast<std::size_t>(filled), '#').c_str(), 100 * fraction);
      } else {
        std::fprintf(stderr, "\r\033[K%s ...", what.c_str());
      }
      std::fflush(stderr);
    }
    return stop_asked == 0;
  }
  void clear() {
    if (shown_) std::fprintf(stderr, "\r\033[K");
  }

 private:
  bool shown_;
};

/// Refuses a folder in which nothing can be written, before anything is computed.
void check_folder(const Options& options) {
  std::filesystem::path there = std::filesystem::absolute(options.folder);
  std::error_code error;
  while (!std::filesystem::exists(there, error) && there.has_relative_path())
    there = there.parent_path();
  if (!std::filesystem::is_directory(there, error))
    throw std::runtime_error("--out " + options.folder + ": '" + there.string() +
                             "' is not a folder");
  if (access(there.c_str(), W_OK | X_OK) != 0)
    throw std::runtime_error("--out " + options.folder + ": no permission to write in '" +
                             there.string() + "'");
}

std::filesystem::path prepared_folder(const Options& options) {
  const std::filesystem::path folder = options.folder;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error("cannot make folder '" + folder.string() + "': " + error.message());
  return folder;
}

/// The line says what was written only once it is there.
void publish(voussoir::OutputSet& outputs, const Options& options, const std::string& names) {
  outputs.publish();
  if (!options.quiet) std::cout << "written  " << names << " in " << options.folder << "\n";
}

int say_interrupted() {
  std::cerr << "interrupted: nothing written\n";
  return interrupted;
}

int run_verb(const Options& options) {
  const Input input = read_input(options.file, options.overrides);
  check_folder(options);
  ProgressLine line(options.quiet);
  const RunResult run = run_tunnel(
      input, [&](const std::string& what, double fraction) { return line.show(what, fraction); });
  line.clear();
  if (stop_asked != 0) return say_interrupted();
  const std::filesystem::path folder = prepared_folder(options);
  voussoir::OutputSet outputs;
  outputs.add(folder / "run.json", run_json(input, run));
  outputs.add(folder / "bolts.csv", bolts_csv(run));
  outputs.add(folder / "lining.csv", lining_csv(run));
  outputs.add(folder / "blocks.svg", blocks_svg(input, run));
  if (!options.quiet) std::cout << run_summary(input, run);
  publish(outputs, options, "run.json, bolts.csv, lining.csv, blocks.svg");
  return run.verdict() == voussoir::Verdict::undecided ? not_decided : finished;
}

int diagram_verb(const Options& options) {
  const Input input = read_input(options.file, options.overrides);
  if (!input.diagram)
    throw voussoir::InvalidInput(
        "no [diagram] in " + options.file +
        "\n  accepted: spacing = [\"11.25 deg\", \"15 deg\", \"none\"] and thickness = [\"0 cm\", \"10 cm\"]");
  check_folder(options);
  ProgressLine line(options.quiet);
  const DiagramResult diagram = run_diagram(
      input, options.threads,
      [&](const std::string& what, double fraction) { return line.show(what, fraction); });
  line.clear();
  if (stop_asked != 0) return say_interrupted();
  const std::filesystem::path folder = prepared_folder(options);
  voussoir::OutputSet outputs;
  outputs.add(folder / "interaction.csv", interaction_csv(input, diagram));
  outputs.add(folder / "interaction.svg", interaction_svg(input, diagram));
  if (!options.quiet) std::cout << diagram_summary(input, diagram);
  publish(outputs, options, "interaction.csv, interaction.svg");
  for (const auto& point : diagram.points)
    if (point.report.verdict == voussoir::Verdict::undecided) return not_decided;
  return finished;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Designs bolts and lining of tunnels in jointed rock.");
  app.set_version_flag("--version", std::string("voussoir ") + VOUSSOIR_VERSION_STRING);
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 finished (stable or collapsing: see run.json), 1 results cannot be written,\n"
      "2 error in the input, 3 undecided, 4 numerical fault, 130 interrupted (nothing written).");
  Options options;
  const auto add_common = [&options](CLI::App* verb) {
    verb->add_option("FILE", options.file, "input file (TOML)")->required();
    verb->add_option("-o,--out", options.folder, "folder for the results, made if missing")
        ->capture_default_str();
    verb->add_option("--set", options.overrides,
                     "KEY=VALUE in place of the file's, for example joint.kn=\"10 GPa/m\"")
        ->allow_extra_args(false);
    verb->add_flag("-q,--quiet", options.quiet, "print nothing but errors");
  };
  CLI::App* run = app.add_subcommand("run", "one tunnel: verdict, forces, picture");
  CLI::App* diagram = app.add_subcommand(
      "diagram", "interaction diagram: crown convergence over bolt spacing and lining thickness");
  add_common(run);
  add_common(diagram);
  diagram->add_option("-j,--threads", options.threads, "tunnels computed at a time")
      ->capture_default_str()
      ->check(CLI::Range(1U, 1024U));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? finished : bad_input;
  }
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  try {
    return *run ? run_verb(options) : diagram_verb(options);
  } catch (const InputErrors& errors) {
    std::cerr << errors.what() << "\n";
    return bad_input;
  } catch (const voussoir::InvalidInput& error) {
    std::cerr << "error: " << error.what() << "\n";
    return bad_input;
  } catch (const voussoir::NumericalFault& fault) {
    std::cerr << "stopped: " << fault.what() << "\n";
    return numerical_fault;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return failed;
  }
}
