// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/io/journal.hpp>

#include "analysis.hpp"
#include "case_plan.hpp"

/// Cases computed and written down: by threads here, by any number of processes on any number of
/// machines, each with a journal of its own.
namespace voussoir::program {

/// "12 s", "3 min", "2 h": rounded up.
[[nodiscard]] std::string duration_text(double seconds);

/// A result as it stands in a journal, and back: equal to the last bit.
[[nodiscard]] std::string result_json(const TunnelResult& result);
/// @throws std::runtime_error  no result of this form
[[nodiscard]] TunnelResult result_from_json(const std::string& text);

/// Where the journals of a plan lie: "FOLDER/sweep.journal".
[[nodiscard]] std::filesystem::path journal_folder(const std::filesystem::path& folder,
                                                   PlanVerb verb);
/// "FOLDER/sweep.plan.json"
[[nodiscard]] std::filesystem::path plan_file(const std::filesystem::path& folder, PlanVerb verb);

/// The finished cases of a plan, by name.
class FinishedCases {
 public:
  /// Adds what the journals of a folder hold.
  /// @throws std::runtime_error  a journal cannot be read or is of another plan, or two hold
  ///                             different results of one case
  void add_folder(const std::filesystem::path& folder, const CasePlan& plan);
  void add(const std::string& name, std::string result) { results_[name] = std::move(result); }

  [[nodiscard]] bool has(const std::string& name) const { return results_.contains(name); }
  [[nodiscard]] std::size_t size() const { return results_.size(); }
  /// In the order of the plan. @pre  all are there
  [[nodiscard]] std::vector<TunnelResult> results(const CasePlan& plan) const;
  /// Of these, in their order. @pre  they are there
  [[nodiscard]] std::vector<TunnelResult> results(const CasePlan& plan,
                                                  const std::vector<std::size_t>& cases) const;
  /// Indices of those that are not there.
  [[nodiscard]] std::vector<std::size_t> missing(const CasePlan& plan) const;
  /// About lines that were damaged: a sentence each.
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  std::map<std::string, std::string> results_;   ///< JSON by name
  std::map<std::string, std::string> journals_;  ///< where each was found
  std::vector<std::string> remarks_;
};

/// Puts a plan into a folder, or finds the same plan there, with as many realisations or fewer.
/// @param discard  removes another plan of this verb, and its journals, first
/// @throws std::runtime_error  the folder holds another plan: names what differs
void adopt_plan(const std::filesystem::path& folder, const CasePlan& plan, bool discard);

/// The plan that a folder holds.
/// @param path  a plan's file, or a folder with one
/// @throws std::runtime_error  there is none, or more than one
[[nodiscard]] CasePlan plan_in(const std::filesystem::path& path);

/// Opens the journal that this process writes.
/// @param name  of the part of the work: "local", "chunk-0003"
/// @return  nothing if another process writes it
[[nodiscard]] std::optional<Journal> journal_of(const std::filesystem::path& folder,
                                                const CasePlan& plan, const std::string& name);

struct WorkSettings {
  unsigned threads = 1;
  /// What is being done, and how far; without words only whether to go on. False ends the work.
  /// Called from every thread.
  Report report;
};

/// What became of it.
struct WorkDone {
  std::size_t computed = 0;
  /// Of those that this machine could not compute (memory): label and reason. They stay unfinished.
  std::vector<std::string> refused = {};
};

/// Computes cases that are not finished and writes each into the journal as it comes.
/// @param cases  indices in the plan
/// @throws Stopped             the report said so: what is in the journal stays
/// @throws std::runtime_error  the journal cannot be written: the same
WorkDone work_on(const CasePlan& plan, const std::vector<std::size_t>& cases,
                 FinishedCases& finished, Journal& journal, const WorkSettings& settings);

}  // namespace voussoir::program
