// SPDX-License-Identifier: MIT
// The verbs that work through many tunnels: diagram, realisations, sweep, and case and merge, which
// share their work among machines.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/io/atomic_file.hpp>

#include "case_outputs.hpp"
#include "case_uncertainty.hpp"
#include "case_work.hpp"
#include "engine_scripts.hpp"
#include "input_document.hpp"
#include "verbs.hpp"

namespace voussoir::program {

namespace fs = std::filesystem;

namespace {

int say_kept(const FinishedCases& finished, const CasePlan& plan) {
  std::cerr << "interrupted: " << finished.size() << " of " << plan.size()
            << " cases are finished and kept; the same command goes on from there\n";
  return interrupted;
}

void say_remarks(const FinishedCases& finished) {
  for (const std::string& remark : finished.remarks()) std::cerr << "warning: " << remark << "\n";
}

/// Cases that this machine could not compute.
int say_refused(const WorkDone& done) {
  for (const std::string& text : done.refused) std::cerr << "error: not computed: " << text << "\n";
  std::cerr << done.refused.size() << (done.refused.size() == 1 ? " case is" : " cases are")
            << " left for another run; those that are finished are kept\n   = accepted: fewer "
               "--threads, or a machine with more memory\n";
  return failed;
}

int say_missing(const CasePlan& plan, const std::vector<std::size_t>& missing) {
  std::cerr << "not complete: " << plan.size() - missing.size() << " of " << plan.size()
            << " cases are finished; missing:\n";
  constexpr std::size_t most = 10;
  for (std::size_t k = 0; k < std::min(most, missing.size()); ++k)
    std::cerr << "   | " << plan.label(plan.at(missing[k])) << "\n";
  if (missing.size() > most) std::cerr << "   | and " << missing.size() - most << " more\n";
  std::cerr << "nothing written\n   = accepted: all cases, in the folders given: run the chunks "
               "that are missing again\n";
  return incomplete;
}

/// What reports of the work do: show them, and pass on a wish to stop.
Report shown_on(ProgressLine& line) {
  return [&line](const std::string& what, double fraction) {
    return what.empty() ? stop_asked == 0 : line.show(what, fraction);
  };
}

int status_of(const std::vector<TunnelResult>& results) {
  for (const TunnelResult& result : results)
    if (!result.is_decided()) return not_decided;
  return finished;
}

/// Writes the results of a finished plan.
int publish_results(const CasePlan& plan, const FinishedCases& finished_cases, RunFolder& outputs,
                    const Options& options) {
  work.doing = "writing the results";
  const std::vector<TunnelResult> results = finished_cases.results(plan);
  const CaseOutputs made = outputs_of(plan, results);
  // A diagram of one rock has the id of that tunnel's run.
  const bool is_one_rock = plan.parts().verb == PlanVerb::diagram && plan.parts().realisations == 1;
  const std::string id = is_one_rock ? RunId("tunnel").add(plan.input()).text() : plan.run_id();
  std::string names;
  for (const auto& [name, text] : made.files) {
    outputs.add(name, text, id);
    names += (names.empty() ? "" : ", ") + name;
  }
  if (!options.quiet) std::cout << made.summary;
  publish(outputs, options, names);
  return status_of(results);
}

/// A part of a list, as even as can be.
std::vector<std::size_t> part_of(const std::vector<std::size_t>& all, std::size_t part,
                                 std::size_t parts) {
  const auto at = [&](std::size_t k) {
    return all.begin() + static_cast<std::ptrdiff_t>(all.size() * k / parts);
  };
  return {at(part), at(part + 1)};
}

/// Computes one case, so that chunks can be made to last. @return seconds it took
double trial(const CasePlan& plan, const fs::path& folder, FinishedCases& finished_cases,
             ProgressLine& line) {
  auto journal = journal_of(folder, plan, "local");
  if (!journal) throw std::runtime_error("another process computes cases in this folder");
  const auto start = std::chrono::steady_clock::now();
  const auto missing = finished_cases.missing(plan);
  if (missing.empty()) return 0;
  const WorkDone done = work_on(plan, {missing[missing.size() / 2]}, finished_cases, *journal,
                                {.threads = 1, .report = shown_on(line)});
  if (!done.refused.empty())
    throw std::runtime_error("the case that was tried, " + done.refused.front() +
                             "\n   = accepted: --chunks N, and machines with more memory");
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

int write_plan(const CasePlan& plan, FinishedCases& finished_cases, const Options& options,
               const PlanOptions& settings, ProgressLine& line) {
  Engine engine{.name = settings.engine,
                .program = utf8_path(options.program),
                .folder = fs::absolute(utf8_path(options.folder)).lexically_normal()};
  std::string chunk_text;
  if (settings.chunks > 0) {
    engine.chunks = std::min(settings.chunks, static_cast<int>(plan.size()));
  } else {
    const double seconds = trial(plan, utf8_path(options.folder), finished_cases, line);
    line.clear();
    const double wanted =
        std::ceil(seconds * static_cast<double>(plan.size()) / (60 * settings.chunk_minutes));
    engine.chunks = static_cast<int>(
        std::clamp(wanted, 1.0, std::min(1000.0, static_cast<double>(plan.size()))));
    chunk_text =
        "; one case took " + readable_text(seconds, 2) + " s here, so that a chunk lasts about " +
        duration_text(seconds * std::ceil(static_cast<double>(plan.size()) / engine.chunks));
    // Cases differ, and a node may be slower: ten times what the trial says, an hour at least.
    engine.minutes = static_cast<int>(std::clamp(
        10 * seconds * static_cast<double>(plan.size()) / engine.chunks / 60, 60.0, 6000.0));
  }
  std::vector<std::string> results;
  switch (plan.parts().verb) {
    case PlanVerb::diagram:
      results = {"interaction.csv"};
      break;
    case PlanVerb::realisations:
      results = {"realisations.csv"};
      break;
    case PlanVerb::sweep:
      results = {"sweep.csv"};
      break;
  }
  OutputSet scripts;
  std::string names;
  for (const auto& [name, text] : engine_scripts(plan, engine, results)) {
    const fs::path path = utf8_path(options.folder) / name;
    fs::create_directories(path.parent_path());
    scripts.add(path, text);
    names += (names.empty() ? "" : ", ") + name;
  }
  scripts.publish();
  if (!options.quiet)
    std::cout << "plan     " << plan.size() << " cases in " << engine.chunks
              << (engine.chunks == 1 ? " chunk" : " chunks") << chunk_text << "\nwritten  "
              << utf8_text(plan_file("", plan.parts().verb)) << ", " << names << " in "
              << options.folder << "\n"
              << engine_advice(plan, engine);
  return finished;
}

/// Of several processes that work together one has failed, and says so itself.
struct FailedElsewhere {};

/// A step of all processes together: none goes on to the next if one has failed in this.
/// @throws FailedElsewhere  in all but the first of those that failed, which throws its own error
template <class Step>
void together(const Ranks& ranks, const Step& step) {
  std::exception_ptr trouble;
  try {
    step();
  } catch (...) {
    trouble = std::current_exception();
  }
  const int order = ranks.size() - ranks.rank(),  // the first has the largest
      first_failed = ranks.largest(trouble ? order : 0);
  if (first_failed == 0) return;
  if (first_failed == order) std::rethrow_exception(trouble);
  throw FailedElsewhere();
}

}  // namespace

CasePlan plan_of(const Options& options, PlanVerb verb, const PlanOptions& settings) {
  work = {"reading " + options.file, "a smaller input file"};
  PlanParts parts{.verb = verb,
                  .file = options.file,
                  .text = read_text(utf8_path(options.file)),
                  .directory = utf8_path(options.file).parent_path(),
                  .overrides = options.overrides,
                  .realisations = settings.realisations,
                  .sampling = settings.sampling == "random" ? Sampling::random : Sampling::latin};
  for (const std::string& text : settings.varied) parts.varied.push_back(varied_key(text));
  return CasePlan(std::move(parts));
}

namespace {

/// After how many realisations is looked whether they are enough: where the Latin hypercube is
/// even, and few times, for whoever looks often is lucky sooner.
std::vector<int> looks_until(int most) {
  std::vector<int> looks;
  for (int tenth = 10; tenth < most; tenth *= 10)
    for (const int times : {1, 2, 3, 4, 5})
      if (times * tenth < most) looks.push_back(times * tenth);
  looks.push_back(most);
  return looks;
}

/// Computes cases of a plan, a part of them in each of several processes.
/// @return  finished if all of them are, in every process
int work_together(const CasePlan& plan, const std::vector<std::size_t>& all_cases,
                  FinishedCases& finished_cases, Journal& journal, const Options& options,
                  ProgressLine& line) {
  const Ranks& ranks = *options.ranks;
  const bool is_first = ranks.rank() == 0;
  // Parts of all cases, not of those that are left: of these two processes may think differently,
  // if a network drive shows one of them a journal later than the other.
  const std::vector<std::size_t> cases = part_of(all_cases, static_cast<std::size_t>(ranks.rank()),
                                                 static_cast<std::size_t>(ranks.size()));
  WorkDone done;
  int status = finished;
  together(ranks, [&] {
    try {
      done = work_on(plan, cases, finished_cases, journal,
                     {.threads = options.threads, .report = shown_on(line)});
    } catch (const Stopped&) {
      status = interrupted;
    }
  });
  line.clear();
  together(ranks, [&] {
    if (ranks.size() > 1 && is_first) finished_cases.add_folder(utf8_path(options.folder), plan);
  });
  status = ranks.largest(status);
  if (status == interrupted) return is_first ? say_kept(finished_cases, plan) : interrupted;
  if (!done.refused.empty()) status = say_refused(done);
  return ranks.largest(status);
}

/// The realisations that are enough of those that a plan has, and why: a line.
struct Enough {
  int realisations;
  std::string text;
};
Enough enough_of(const CasePlan& plan, const FinishedCases& finished_cases, int look,
                 double width) {
  PlanParts parts = plan.parts();
  parts.realisations = look;
  const CasePlan shorter(std::move(parts));
  // Of several processes one may see another's journal later than it was written.
  if (const auto missing = finished_cases.missing(shorter); !missing.empty())
    throw std::runtime_error(std::to_string(missing.size()) + " of " + std::to_string(look) +
                             " realisations are not in the journals that can be read\n   = "
                             "accepted: the same command again");
  const auto events = unwanted_events(plan.input(), finished_cases.results(shorter));
  const double widest = 100 * widest_interval(events);
  const std::string found = std::to_string(look) + " realisations: the widest interval has " +
                            significant_text(widest, 3) + " percentage points, asked for were " +
                            significant_text(width, 3) + "\n";
  if (widest <= width) return {look, "enough   " + found};
  return {0, "not enough   " + found};
}

int worked_plan(const Options& options, PlanVerb verb, const PlanOptions& settings) {
  const Ranks& ranks = *options.ranks;
  const bool is_first = ranks.rank() == 0;
  if (settings.until_width > 0 && !settings.engine.empty())
    throw InvalidInput(
        "--until-width " + significant_text(settings.until_width, 6) + " with --plan " +
        settings.engine +
        ": machines that share a plan do not know each other's results\n   = accepted: either; what "
        "was computed stays when -n grows");
  std::optional<CasePlan> made;
  together(ranks, [&] { made.emplace(plan_of(options, verb, settings)); });
  const CasePlan& plan = *made;
  work = {"computing the cases with --threads " + std::to_string(options.threads),
          "a smaller domain (model.width, model.below_invert, tunnel.cover), fewer joints or a "
          "larger blocks.min_inscribed_radius, or fewer --threads"};

  // The first of several processes holds the folder for all.
  std::optional<RunFolder> outputs;
  FinishedCases finished_cases;
  together(ranks, [&] {
    if (!is_first) return;
    outputs.emplace(options.folder);
    adopt_plan(utf8_path(options.folder), plan, settings.discard);
    outputs->keep();
  });
  together(ranks, [&] { finished_cases.add_folder(utf8_path(options.folder), plan); });
  if (is_first) say_remarks(finished_cases);
  ProgressLine line(options.quiet || !is_first);
  if (!settings.engine.empty())
    return is_first ? write_plan(plan, finished_cases, options, settings, line) : finished;

  const std::string name = ranks.size() == 1 ? "local" : "rank-" + std::to_string(ranks.rank() + 1);
  std::optional<Journal> journal;
  together(ranks, [&] {
    journal = journal_of(utf8_path(options.folder), plan, name);
    if (!journal)
      throw std::runtime_error("another process writes the journal " + name + ".jsonl in " +
                               options.folder);
  });
  if (settings.until_width <= 0) {
    const int status =
        work_together(plan, plan.work_order(), finished_cases, *journal, options, line);
    if (status != finished || !is_first) return status;
    if (const auto missing = finished_cases.missing(plan); !missing.empty())
      return say_missing(plan, missing);
    return publish_results(plan, finished_cases, *outputs, options);
  }
  for (const int look : looks_until(plan.parts().realisations)) {
    std::vector<std::size_t> cases = plan.work_order();  // a case for each realisation
    std::erase_if(cases, [&](std::size_t k) { return k >= static_cast<std::size_t>(look); });
    const int status = work_together(plan, cases, finished_cases, *journal, options, line);
    if (status != finished) return status;
    const bool is_last = look == plan.parts().realisations;
    Enough enough{0, ""};
    together(ranks, [&] {
      if (is_first) enough = enough_of(plan, finished_cases, look, settings.until_width);
    });
    if (ranks.largest(enough.realisations) == 0 && !is_last) continue;
    if (!is_first) return finished;
    PlanParts parts = plan.parts();
    parts.realisations = look;
    const CasePlan shorter(std::move(parts));
    write_atomically(plan_file(utf8_path(options.folder), plan.parts().verb), shorter.json());
    if (!options.quiet) std::cout << enough.text;
    return publish_results(shorter, finished_cases, *outputs, options);
  }
  return finished;
}

}  // namespace

int plan_verb(const Options& options, PlanVerb verb, const PlanOptions& settings) {
  if (const std::string why = why_ranks_are_apart(); !why.empty()) throw InvalidInput(why);
  try {
    return worked_plan(options, verb, settings);
  } catch (const FailedElsewhere&) {
    return failed;
  }
}

int case_verb(const Options& options, const std::string& chunk) {
  const auto refuse = [&](const std::string& reason) {
    throw InvalidInput("--chunk " + printable(chunk) + ": " + reason +
                       "\n   = accepted: --chunk 3/60, the third of sixty parts");
  };
  const std::size_t slash = chunk.find('/');
  const auto whole = [&](const std::string& text) {
    if (text.empty() || text.size() > 7 ||
        text.find_first_not_of("0123456789") != std::string::npos)
      refuse("not two whole numbers");
    return static_cast<std::size_t>(std::stoul(text));
  };
  if (slash == std::string::npos) refuse("how many chunks there are is missing");
  const std::size_t part = whole(chunk.substr(0, slash)), parts = whole(chunk.substr(slash + 1));
  if (part < 1 || part > parts) refuse("there is no such chunk");

  work = {"reading the plan " + options.file, "a smaller plan"};
  const CasePlan plan = plan_in(utf8_path(options.file));
  const fs::path folder = fs::is_directory(utf8_path(options.file))
                              ? utf8_path(options.file)
                              : utf8_path(options.file).parent_path();
  work = {"computing a chunk with --threads " + std::to_string(options.threads),
          "fewer --threads, or a machine with more memory"};
  // With other chunks, but not with a run that computes everything.
  const RunFolder held(folder.empty() ? "." : utf8_text(folder), "the plan's folder",
                       LockedFile::Mode::shared);
  char name[64];
  std::snprintf(name, sizeof name, "chunk-%04zu-of-%04zu", part, parts);
  auto journal = journal_of(folder, plan, name);
  if (!journal)
    throw std::runtime_error("chunk " + chunk + " is being computed by another process, which " +
                             "writes its journal\n   = accepted: another chunk, or this one when "
                             "that process has ended");
  FinishedCases finished_cases;
  finished_cases.add_folder(folder, plan);
  say_remarks(finished_cases);
  const std::vector<std::size_t> cases = part_of(plan.work_order(), part - 1, parts);
  ProgressLine line(options.quiet);
  try {
    const WorkDone done = work_on(plan, cases, finished_cases, *journal,
                                  {.threads = options.threads, .report = shown_on(line)});
    line.clear();
    if (!options.quiet)
      std::cout << "chunk    " << chunk << " of the " << to_string(plan.parts().verb) << ": "
                << cases.size() << (cases.size() == 1 ? " case" : " cases") << ", " << done.computed
                << " computed now\n";
    return done.refused.empty() ? finished : say_refused(done);
  } catch (const Stopped&) {
    line.clear();
    return say_kept(finished_cases, plan);
  }
}

int merge_verb(const Options& options, const std::vector<std::string>& folders) {
  work = {"reading the journals", "fewer cases"};
  const CasePlan plan = plan_in(utf8_path(folders.front()));
  FinishedCases finished_cases;
  for (const std::string& path : folders) {
    const CasePlan other = plan_in(utf8_path(path));
    const auto different = differences(other.content(), plan.content());
    if (!different.empty()) {
      std::string all;
      for (const std::string& line : different) all += "\n   | " + line;
      throw std::runtime_error("the plans of " + folders.front() + " and " + path + " differ:" +
                               all + "\n   = accepted: folders with parts of one plan");
    }
    finished_cases.add_folder(
        fs::is_directory(utf8_path(path)) ? utf8_path(path) : utf8_path(path).parent_path(), plan);
  }
  say_remarks(finished_cases);
  if (const auto missing = finished_cases.missing(plan); !missing.empty())
    return say_missing(plan, missing);
  Options where = options;
  if (where.folder.empty())
    where.folder = fs::is_directory(utf8_path(folders.front()))
                       ? folders.front()
                       : utf8_text(utf8_path(folders.front()).parent_path());
  if (where.folder.empty()) where.folder = ".";
  RunFolder outputs(where.folder);
  return publish_results(plan, finished_cases, outputs, where);
}

}  // namespace voussoir::program
