// SPDX-License-Identifier: MIT
#include "case_work.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <future>
#include <iterator>
#include <list>
#include <memory>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <voussoir/core/parallel.hpp>
#include <voussoir/io/atomic_file.hpp>

#include "plausibility.hpp"

namespace voussoir::program {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr auto replace = Json::error_handler_t::replace;

/// A number that may be not a number, which JSON has not.
double number_at(const Json& json, const char* key) {
  const Json& value = json.at(key);
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

/// A utilisation may be infinite besides.
constexpr const char* beyond_any = "infinite";
Json utilisation_json(double value) { return std::isinf(value) ? Json(beyond_any) : Json(value); }
double utilisation_at(const Json& json, const char* key) {
  return json.at(key) == beyond_any ? std::numeric_limits<double>::infinity()
                                    : number_at(json, key);
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read '" + utf8_text(path) + "'");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// By one thread at a time.
std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char text[32] = "";
  if (const std::tm* const parts = std::gmtime(&now))  // NOLINT(concurrency-mt-unsafe)
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", parts);
  return text;
}

/// Rocks that are being made or were made last: cases that differ in their supports share one.
class RockStore {
 public:
  explicit RockStore(std::size_t most) : most_(most) {}

  std::shared_ptr<const RockInSitu> of(const Input& input, const Report& report) {
    std::string key = std::to_string(input.model.seed);
    for (const std::string& line : input.content)
      if (!is_of_support(line)) key += "\n" + line;
    std::promise<std::shared_ptr<const RockInSitu>> made;
    std::shared_future<std::shared_ptr<const RockInSitu>> rock;
    bool is_mine = false;
    {
      const std::scoped_lock lock(guard_);
      for (auto entry = rocks_.begin(); entry != rocks_.end() && !rock.valid(); ++entry)
        if (entry->first == key) {
          rock = entry->second;
          rocks_.splice(rocks_.begin(), rocks_, entry);
        }
      if (!rock.valid()) {
        is_mine = true;
        rock = made.get_future().share();
        rocks_.emplace_front(key, rock);
        if (rocks_.size() > most_) rocks_.pop_back();
      }
    }
    if (is_mine) {
      try {
        made.set_value(std::make_shared<const RockInSitu>(rock_in_situ(input, false, report)));
      } catch (...) {
        made.set_exception(std::current_exception());
      }
    }
    return rock.get();
  }

 private:
  std::size_t most_;
  std::mutex guard_;
  std::list<std::pair<std::string, std::shared_future<std::shared_ptr<const RockInSitu>>>>
      rocks_;  ///< the last used first
};

TunnelResult failed(const std::string& reason, const Input& input) {
  TunnelResult result;
  result.failed = true;
  result.reason = reason;
  result.warnings = unusual_values(input);
  return result;
}

/// Calls a file of joints what the input calls it: a result is the same wherever the file lies.
void name_as_written(std::string& text, const PlannedFile& file) {
  const std::string path = utf8_text(file.path);
  for (std::size_t at = text.find(path); at != std::string::npos;
       at = text.find(path, at + file.name.size()))
    text.replace(at, path.size(), file.name);
}

TunnelResult computed(const CasePlan& plan, std::size_t index, RockStore& rocks,
                      const Report& report) {
  const Case the_case = plan.at(index);
  const Input input = plan.input_of(the_case);
  TunnelResult result;
  try {
    const auto rock = rocks.of(input, report);
    result = tunnel_in(input, *rock, plan.supports_of(the_case, input), report);
  } catch (const std::logic_error& error) {  // InvalidInput, and an invariant that does not hold
    result = failed(error.what(), input);
  } catch (const NumericalFault& fault) {
    result = failed(fault.what(), input);
  }
  for (const PlannedFile& file : plan.files()) {
    if (file.path != input.joints_file) continue;
    name_as_written(result.reason, file);
    for (std::string& warning : result.warnings) name_as_written(warning, file);
  }
  return result;
}

std::string journal_header(const CasePlan& plan) {
  return std::string("\"of\":\"") + to_string(plan.parts().verb) + " " + plan.work_id() + "\"";
}

/// Than a plan with this content. With fewer, files of results of the larger number might stay.
bool has_more_realisations(const CasePlan& plan, const std::vector<std::string>& content) {
  for (const std::string& line : content)
    if (line.starts_with(realisations_line))
      return plan.parts().realisations > std::atoi(line.c_str() + realisations_line.size());
  return false;
}

/// Without what results are held against: that may change in a folder.
std::vector<std::string> without_criteria(std::vector<std::string> content) {
  std::erase_if(content, is_of_choice);
  return content;
}

/// Paths of the journals in a folder, sorted.
std::vector<fs::path> journals_in(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code ignored;  // no such folder: no journals
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    if (entry->path().extension() == ".jsonl") paths.push_back(entry->path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 90) return std::to_string(static_cast<int>(std::ceil(seconds))) + " s";
  if (seconds < 5400) return std::to_string(static_cast<int>(std::ceil(seconds / 60))) + " min";
  return std::to_string(static_cast<int>(std::ceil(seconds / 3600))) + " h";
}

std::string result_json(const TunnelResult& r) {
  const Json json = {{"verdict", to_string(r.verdict)},
                     {"failed", r.failed},
                     {"lost_lining", r.lost_lining},
                     {"fallen_m2", r.fallen},
                     {"marginal", r.marginal},
                     {"crown_m", r.convergence.crown},
                     {"right_springing_m", r.convergence.right_springing},
                     {"left_springing_m", r.convergence.left_springing},
                     {"invert_m", r.convergence.invert},
                     {"rise_m", r.convergence.rise},
                     {"largest_bolt_force_N", r.demand.largest_bolt_force},
                     {"mean_bolt_force_N", r.demand.mean_bolt_force},
                     {"largest_thrust_N_per_m", r.demand.largest_thrust},
                     {"mean_thrust_N_per_m", r.demand.mean_thrust},
                     {"largest_moment_Nm_per_m", r.demand.largest_moment},
                     {"bolts_yielded", r.bolts_yielded},
                     {"bolts_ruptured", r.bolts_ruptured},
                     {"feet_yielded", r.feet_yielded},
                     {"of_bolt_strength", utilisation_json(r.of_bolt_strength)},
                     {"bolts_governed_by", r.bolts_governed_by},
                     {"of_lining_strength", utilisation_json(r.of_lining_strength)},
                     {"lining_governed_by", r.lining_governed_by},
                     {"error_estimate", r.error_estimate},
                     {"out_of_balance_force_ratio", r.out_of_balance},
                     {"blocks", r.blocks},
                     {"boundary", r.boundary},
                     {"warnings", r.warnings},
                     {"reason", r.reason}};
  return json.dump(-1, ' ', false, replace);
}

TunnelResult result_from_json(const std::string& text) {
  TunnelResult r;
  try {
    const Json json = Json::parse(text);
    bool known = false;
    for (const Verdict verdict : {Verdict::stable, Verdict::collapse, Verdict::undecided})
      if (json.at("verdict") == to_string(verdict)) {
        r.verdict = verdict;
        known = true;
      }
    if (!known)
      throw std::runtime_error("a result has the unknown verdict " + json.at("verdict").dump());
    r.failed = json.at("failed");
    r.lost_lining = json.at("lost_lining");
    r.fallen = number_at(json, "fallen_m2");
    r.marginal = json.at("marginal");
    r.convergence = {number_at(json, "crown_m"), number_at(json, "right_springing_m"),
                     number_at(json, "left_springing_m"), number_at(json, "invert_m"),
                     number_at(json, "rise_m")};
    r.demand.largest_bolt_force = number_at(json, "largest_bolt_force_N");
    r.demand.mean_bolt_force = number_at(json, "mean_bolt_force_N");
    r.demand.largest_thrust = number_at(json, "largest_thrust_N_per_m");
    r.demand.mean_thrust = number_at(json, "mean_thrust_N_per_m");
    r.demand.largest_moment = number_at(json, "largest_moment_Nm_per_m");
    r.bolts_yielded = json.at("bolts_yielded");
    r.bolts_ruptured = json.at("bolts_ruptured");
    r.feet_yielded = json.at("feet_yielded");
    r.of_bolt_strength = utilisation_at(json, "of_bolt_strength");
    r.bolts_governed_by = json.at("bolts_governed_by");
    r.of_lining_strength = utilisation_at(json, "of_lining_strength");
    r.lining_governed_by = json.at("lining_governed_by");
    r.error_estimate = number_at(json, "error_estimate");
    r.out_of_balance = number_at(json, "out_of_balance_force_ratio");
    r.blocks = json.at("blocks");
    r.boundary = json.at("boundary");
    json.at("warnings").get_to(r.warnings);
    r.reason = json.at("reason");
  } catch (const Json::exception& error) {
    throw std::runtime_error(std::string("a result cannot be read: ") + error.what());
  }
  return r;
}

fs::path journal_folder(const fs::path& folder, PlanVerb verb) {
  return folder / (std::string(to_string(verb)) + ".journal");
}

fs::path plan_file(const fs::path& folder, PlanVerb verb) {
  return folder / (std::string(to_string(verb)) + ".plan.json");
}

void FinishedCases::add_folder(const fs::path& folder, const CasePlan& plan) {
  for (const fs::path& path : journals_in(journal_folder(folder, plan.parts().verb))) {
    const auto journal = read_journal(path);
    if (!journal) continue;
    const std::string name = "'" + utf8_text(path) + "'";
    if (journal->header != journal_header(plan))
      throw std::runtime_error(name + " is the journal of another plan: {" + journal->header +
                               "}\n   = accepted: journals of {" + journal_header(plan) + "}");
    for (const std::size_t line : journal->damaged_lines)
      remarks_.push_back(name + ", line " + std::to_string(line) +
                         " is damaged: the case on it counts as not finished");
    for (const JournalEntry& entry : journal->entries) {
      std::string result;
      try {
        result = Json::parse("{" + entry.fields + "}").at("result").dump(-1, ' ', false, replace);
      } catch (const Json::exception& error) {
        throw std::runtime_error(name + ": case " + entry.name + ": " + error.what());
      }
      const auto [place, is_new] = results_.try_emplace(entry.name, result);
      if (!is_new && place->second != result)
        throw std::runtime_error(
            "two journals differ on the case " + entry.name + ": " + journals_[entry.name] +
            " and " + name +
            "\n   = accepted: results of one program; remove the journal that is wrong");
      if (is_new) journals_[entry.name] = name;
    }
  }
}

std::vector<TunnelResult> FinishedCases::results(const CasePlan& plan) const {
  std::vector<std::size_t> cases(plan.size());
  std::iota(cases.begin(), cases.end(), 0);
  return results(plan, cases);
}

std::vector<TunnelResult> FinishedCases::results(const CasePlan& plan,
                                                 const std::vector<std::size_t>& cases) const {
  std::vector<TunnelResult> found;
  found.reserve(cases.size());
  for (const std::size_t k : cases) found.push_back(result_from_json(results_.at(plan.name(k))));
  return found;
}

std::vector<std::size_t> FinishedCases::missing(const CasePlan& plan) const {
  std::vector<std::size_t> indices;
  for (std::size_t k = 0; k < plan.size(); ++k)
    if (!has(plan.name(k))) indices.push_back(k);
  return indices;
}

void adopt_plan(const fs::path& folder, const CasePlan& plan, bool discard) {
  const PlanVerb verb = plan.parts().verb;
  const fs::path path = plan_file(folder, verb), journals = journal_folder(folder, verb);
  const auto copy = [&](std::size_t file) { return folder / CasePlan::copy_name(verb, file); };
  if (fs::exists(path)) {
    std::vector<std::string> before;
    std::string trouble;
    try {
      Json::parse(content_of(path)).at("content").get_to(before);
    } catch (const Json::exception& error) {
      trouble = error.what();
    }
    if (trouble.empty() && plan.content() == before) return;
    const auto different = differences(without_criteria(plan.content()), without_criteria(before));
    if (trouble.empty() &&
        (different.empty() || (different.size() == 1 && has_more_realisations(plan, before)))) {
      write_atomically(path, plan.json());
      return;
    }
    if (!discard) {
      std::string all;
      for (const std::string& line : different) all += "\n   | " + line;
      if (!trouble.empty()) all = "\n   | its plan cannot be read: " + trouble;
      throw std::runtime_error("the folder " + utf8_text(folder) + " holds another " +
                               to_string(verb) + ", which differs:" + all +
                               "\n   = accepted: another --out, the same input and program, or "
                               "--discard to remove what is there");
    }
  }
  if (discard) {
    fs::remove_all(journals);
    std::size_t file = 0;
    while (fs::remove(copy(file))) ++file;
    fs::remove(path);
  } else if (!journals_in(journals).empty()) {
    throw std::runtime_error("the folder " + utf8_text(folder) + " holds the journals of a " +
                             to_string(verb) + " without their plan, '" + utf8_text(path) +
                             "'\n   = accepted: another --out, or --discard to remove them");
  }
  OutputSet files;
  for (std::size_t k = 0; k < plan.files().size(); ++k)
    files.add(copy(k), content_of(plan.files()[k].path));
  files.add(path, plan.json());
  files.publish();
  fs::create_directories(journals);
}

CasePlan plan_in(const fs::path& path) {
  if (fs::is_regular_file(path)) return CasePlan::from_json(content_of(path), path);
  std::vector<fs::path> plans;
  if (fs::is_directory(path))
    for (const PlanVerb verb : {PlanVerb::diagram, PlanVerb::realisations, PlanVerb::sweep})
      if (fs::exists(plan_file(path, verb))) plans.push_back(plan_file(path, verb));
  if (plans.empty())
    throw std::runtime_error("'" + utf8_text(path) +
                             "' holds no plan\n   = accepted: a folder in which sweep, "
                             "realisations or diagram were started, or the plan's file in it");
  if (plans.size() > 1)
    throw std::runtime_error("'" + utf8_text(path) + "' holds " + std::to_string(plans.size()) +
                             " plans\n   = accepted: the file of one, such as " +
                             utf8_text(plans.front()));
  return CasePlan::from_json(content_of(plans.front()), plans.front());
}

std::optional<Journal> journal_of(const fs::path& folder, const CasePlan& plan,
                                  const std::string& name) {
  const fs::path journals = journal_folder(folder, plan.parts().verb);
  fs::create_directories(journals);
  auto journal = Journal::open(journals / (name + ".jsonl"), journal_header(plan));
  if (!journal || journal->is_locked()) return journal;
  // A drive without locks: a journal that nobody else can have.
  return Journal::open(
      journals / (name + "-" + host_name() + "-" + std::to_string(process_number()) + ".jsonl"),
      journal_header(plan));
}

WorkDone work_on(const CasePlan& plan, const std::vector<std::size_t>& cases,
                 FinishedCases& finished, Journal& journal, const WorkSettings& settings) {
  std::vector<std::size_t> todo;
  for (const std::size_t index : cases)
    if (!finished.has(plan.name(index))) todo.push_back(index);
  WorkDone done;
  RockStore rocks(settings.threads + 1);
  std::mutex guard;
  std::atomic<bool> go_on{true};
  std::size_t handed_out = 0;
  const auto start = std::chrono::steady_clock::now();
  const auto since = [](std::chrono::steady_clock::time_point then) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
  };
  const auto say = [&] {  // under the guard
    if (!settings.report) return;
    const std::size_t count = done.computed + done.refused.size(), all = plan.size();
    std::string text = std::string(to_string(plan.parts().verb)) + ": " +
                       std::to_string(finished.size()) + " of " + std::to_string(all) + " cases";
    if (count > 0 && count < todo.size())
      text += ", about " +
              duration_text(since(start) / static_cast<double>(count) *
                            static_cast<double>(todo.size() - count)) +
              " left";
    if (!settings.report(text, static_cast<double>(finished.size()) / static_cast<double>(all)))
      go_on = false;
  };
  // Asked every few milliseconds from every thread: whether to stop. And to the disk with a
  // short case behind which a long one is computed.
  const Report quiet = [&](const std::string&, double) {
    if (settings.report && !settings.report("", -1)) go_on = false;
    const std::scoped_lock lock(guard);
    journal.sync_when_due();
    return go_on.load();
  };
  const auto next = [&]() -> std::optional<std::size_t> {
    const std::scoped_lock lock(guard);
    return go_on && handed_out < todo.size() ? std::optional(todo[handed_out++]) : std::nullopt;
  };
  {
    const std::scoped_lock lock(guard);
    say();
  }
  const unsigned workers = std::max(settings.threads, 1U);
  const auto serve = [&] {
    while (const auto index = next()) {
      const auto begin = std::chrono::steady_clock::now();
      std::string result, refusal;
      try {
        result = result_json(computed(plan, *index, rocks, quiet));
      } catch (const Stopped&) {
        go_on = false;
        return;
      } catch (const NotEnoughMemory& error) {
        refusal = error.what();
      } catch (const std::bad_alloc&) {
        refusal = "out of memory";
      }
      const double seconds = since(begin);
      const std::scoped_lock lock(guard);
      if (!refusal.empty()) {
        done.refused.push_back(plan.label(plan.at(*index)) + ": " + refusal);
        continue;
      }
      const std::string& name = plan.name(*index);
      const Json about = {{"of", plan.label(plan.at(*index))},
                          {"seconds", std::round(1e3 * seconds) / 1e3},
                          {"host", host_name()},
                          {"process", process_number()},
                          {"finished", utc_now()}};
      const std::string rest = about.dump(-1, ' ', false, replace);
      journal.add({name, "\"result\":" + result + "," + rest.substr(1, rest.size() - 2)});
      finished.add(name, result);
      ++done.computed;
      say();
    }
  };
  parallel_for(workers, workers, [&](std::size_t) {
    try {
      serve();
    } catch (...) {  // the journal cannot be written: the others need not go on
      go_on = false;
      throw;
    }
  });
  journal.sync();
  if (!go_on) throw Stopped();
  return done;
}

}  // namespace voussoir::program
