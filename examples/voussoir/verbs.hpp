// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <string>
#include <thread>
#include <vector>
#include <voussoir/design/factor_of_safety.hpp>
#include <voussoir/io/operating_system.hpp>

#include "case_plan.hpp"
#include "ranks.hpp"
#include "run_folder.hpp"

/// What the verbs of the program share: options, exit status, progress, what to say at the end.
namespace voussoir::program {

enum ExitStatus {
  finished = 0,  ///< of `run`: stable
  failed = 1,
  bad_input = 2,
  not_decided = 3,
  numerical_fault = 4,
  not_verified = 5,
  stands_after_rockfall = 6,
  collapsed = 7,
  incomplete = 8,
  nothing_holds = 9,
  interrupted = 130
};

/// Set by Ctrl-C and SIGTERM; looked at wherever progress is shown.
extern volatile std::sig_atomic_t stop_asked;

struct Options {
  std::string program;           ///< as it is called, absolute where that can be told
  const Ranks* ranks = nullptr;  ///< never null
  std::string file, folder = ".";
  std::vector<std::string> overrides;  ///< see `read_input`
  std::vector<std::string> removed;    ///< keys, which become overrides
  bool quiet = false;
  bool json = false;  ///< on screen, in place of words: `run`, `check`, `blocks`
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
};

/// What memory may run out of, in words, and what then to reduce.
struct Work {
  std::string doing = "reading the command line", remedy = "fewer and smaller arguments";
};
extern Work work;

/// One line that rewrites itself on a terminal, nothing in a pipe.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet) : shown_(!quiet && is_terminal(stderr)) {}
  ~ProgressLine() { clear(); }
  bool show(const std::string& what, double fraction) {
    // Asked every few milliseconds: what it said already is not drawn again.
    if (shown_ && (fraction >= 0 || what != doing_)) {
      doing_ = what;
      std::string line = what + " ...";
      if (fraction >= 0) {
        char bar[64];
        std::snprintf(bar, sizeof bar, " [%-30s] %3.0f %%",
                      std::string(static_cast<std::size_t>(30 * fraction), '#').c_str(),
                      100 * fraction);
        line = what + bar;
      }
      draw(line);
    }
    return stop_asked == 0;
  }
  void clear() {
    if (length_ == 0) return;
    draw("");
    std::fputc('\r', stderr);
  }

 private:
  /// Blanks over what is longer: not every console of Windows can be told to erase a line.
  void draw(const std::string& line) {
    const std::size_t longer = length_ > line.size() ? length_ - line.size() : 0;
    std::fprintf(stderr, "\r%s%s", line.c_str(), std::string(longer, ' ').c_str());
    std::fflush(stderr);
    length_ = line.size();
  }

  bool shown_;
  std::size_t length_ = 0;  ///< of what stands there [bytes]
  std::string doing_;
};

/// The line says what was written only once it is there.
inline void publish(RunFolder& outputs, const Options& options, const std::string& names) {
  outputs.publish();
  if (!options.quiet && !options.json)
    std::cout << "written  " << names << " in " << options.folder << "\n";
}

inline int say_interrupted() {
  std::cerr << "interrupted: nothing written\n";
  return interrupted;
}

/// What the verbs that work through many tunnels are asked besides.
struct PlanOptions {
  std::vector<std::string> varied;  ///< "key=values" of a sweep
  int realisations = 1;
  std::string sampling = "latin";  ///< of keys with a distribution: or "random"
  /// Of realisations: no more of them than make every interval of a probability this wide
  /// [percentage points]; 0: all that are asked for.
  double until_width = 0;
  bool discard = false;       ///< what the folder holds of another plan
  std::string engine;         ///< to hand the plan to; empty: compute here
  int chunks = 0;             ///< 0: so that each lasts `chunk_minutes`
  double chunk_minutes = 10;  ///< about
};
/// One tunnel, or laid blocks.
[[nodiscard]] int run_verb(const Options& options);
/// What is known before equilibrium is sought. Writes nothing unless it is told where.
[[nodiscard]] int check_verb(const Options& options, bool wants_picture);
/// The rock alone: sizes of blocks, scan lines, blocks at the wall that can move out.
[[nodiscard]] int blocks_verb(const Options& options);
/// Ground reaction, and what supports do; in 3-D the wall along the tunnel.
/// @param steps  in which the wall is unloaded, 2-D
[[nodiscard]] int grc_verb(const Options& options, int steps);
/// The pull-out test of its bolts, in closed form: nothing of the rock is computed.
/// @param lengths  bonded, as quantities; none: the whole bolt
[[nodiscard]] int pullout_verb(const Options& options, const std::vector<std::string>& lengths);
/// The factor of safety by strength reduction, and what falls beyond it.
[[nodiscard]] int safety_verb(const Options& options, const SafetySettings& settings,
                              bool wants_limit);
/// @param file  to be written, which must not be there; empty: standard output
[[nodiscard]] int init_verb(const std::string& name, const std::string& file);

/// @throws as `CasePlan`
[[nodiscard]] CasePlan plan_of(const Options& options, PlanVerb verb, const PlanOptions& settings);
/// The cheapest supports on the axes of a diagram that comply with [criteria]; in the folder of
/// that diagram, of which it computes as little as it takes.
[[nodiscard]] int design_verb(const Options& options, const PlanOptions& settings, bool is_sure);
/// `diagram`, `realisations`, `sweep`.
[[nodiscard]] int plan_verb(const Options& options, PlanVerb verb, const PlanOptions& settings);
/// One chunk of a plan, "3/60"; options.file names the plan or its folder.
[[nodiscard]] int case_verb(const Options& options, const std::string& chunk);
/// Joins what several folders hold of one plan; options.folder empty: into the first.
[[nodiscard]] int merge_verb(const Options& options, const std::vector<std::string>& folders);

/// The results in options.folder as one page.
/// @param file       to be written; empty: report.html in that folder
/// @param wants_pdf  printed by Chromium, too, beside it
[[nodiscard]] int report_verb(const Options& options, const std::string& file, bool wants_pdf);

/// Whether `paper` and `verify` are in this build (CMake option VOUSSOIR_BUILD_PAPER). Where they
/// are not, `--help` does not list them, and both say how to get them.
extern const bool has_paper;
/// Every analysis of the paper; `pages` empty: no documentation.
[[nodiscard]] int paper_verb(const Options& options, int samples, const std::string& pages);
/// Closed forms and solvers against values from elsewhere.
[[nodiscard]] int verify_verb(const Options& options);

}  // namespace voussoir::program
