// SPDX-License-Identifier: MIT
#include "study.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/parallel.hpp>

namespace voussoir::paper {

Study::Study(int samples, unsigned threads, Progress progress, CaseStore store)
    : samples_(samples),
      threads_(threads),
      progress_(std::move(progress)),
      store_(std::move(store)) {
  require(samples >= 1 && samples <= 1000, "number of realisations", samples, "1 to 1000");
}

void Study::prepare(const std::vector<Variant>& variants) {
  std::map<Variant, std::vector<Outcome>> fresh;
  for (const Variant& v : variants)
    if (!done_.contains(v)) fresh.try_emplace(v, static_cast<std::size_t>(samples_));
  if (fresh.empty()) return;
  const std::size_t count = fresh.size() * static_cast<std::size_t>(samples_);
  std::atomic<std::size_t> finished{0};
  std::atomic<bool> go_on{true};
  std::mutex guard;
  const auto report = [&] {
    const std::size_t now = ++finished;
    const std::scoped_lock lock(guard);
    if (!progress("tunnels", static_cast<double>(now) / static_cast<double>(count))) go_on = false;
  };
  // Some realisations at a time: a rock takes ten or twenty megabytes.
  constexpr int at_a_time = 8;
  constexpr std::size_t most_rocks = 64;
  for (int first = 0; first < samples_ && go_on; first += at_a_time) {
    struct Job {
      const Variant* variant;
      Outcome* outcome;
      std::uint64_t seed;
    };
    std::vector<Job> jobs;
    // Explicit runs take longest: first, so that none is left for one thread at the end.
    for (const Way way : {Way::as_the_paper, Way::slow_explicit, Way::quasi_static})
      for (auto& [variant, outcomes] : fresh)
        if (variant.way == way)
          for (int k = first; k < std::min(first + at_a_time, samples_); ++k) {
            const Job job{&variant, &outcomes[static_cast<std::size_t>(k)],
                          static_cast<std::uint64_t>(k) + 1};
            const auto stored =
                store_.find ? store_.find(case_text(variant, job.seed)) : std::nullopt;
            if (stored) {
              *job.outcome = outcome_from_json(*stored);
              report();
            } else {
              jobs.push_back(job);
            }
          }
    // The rock first, once for all variants that start from it.
    std::map<RockKey, Job> missing;
    for (const Job& job : jobs)
      if (const RockKey key = rock_of(job.seed, *job.variant); !rocks_.contains(key))
        missing.try_emplace(key, job);
    const std::vector<std::pair<RockKey, Job>> to_make(missing.begin(), missing.end());
    parallel_for(to_make.size(), threads_, [&](std::size_t k) {
      ExcavatedRock rock(to_make[k].second.seed, *to_make[k].second.variant);
      const std::scoped_lock lock(guard);
      rocks_.emplace(to_make[k].first, std::move(rock));
    });
    parallel_for(jobs.size(), threads_, [&](std::size_t k) {
      if (!go_on) return;
      const Job& job = jobs[k];
      *job.outcome = rocks_.at(rock_of(job.seed, *job.variant)).run(*job.variant);
      if (store_.add) store_.add(case_text(*job.variant, job.seed), outcome_json(*job.outcome));
      report();
    });
    if (rocks_.size() > most_rocks) rocks_.clear();
  }
  if (!go_on) throw Stopped{};
  solved_ += count;
  done_.merge(fresh);
}

const std::vector<Outcome>& Study::of(const Variant& variant) {
  prepare({variant});
  return done_.at(variant);
}

Measured Study::measure(const Variant& variant,
                        const std::function<double(const Outcome&)>& quantity) {
  Measured measured;
  for (const Outcome& outcome : of(variant)) measured.add(outcome.report, quantity(outcome));
  return measured;
}

}  // namespace voussoir::paper
