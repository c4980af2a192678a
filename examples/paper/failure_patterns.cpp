// SPDX-License-Identifier: MIT
// How unsupported tunnels fail: Table 1 and Fig. 2, every block moving.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <voussoir/core/parallel.hpp>

#include "analyses.hpp"
#include "analysis_parts.hpp"
#include "patterns.hpp"
#include "section.hpp"
#include "study.hpp"

namespace voussoir::paper {

namespace {

using program::PatternCase;
using program::PatternResult;
using program::RoofFall;
using program::WallFailure;

const PatternCase& case_of(const PatternResult& r) {
  return program::pattern_cases()[static_cast<std::size_t>(r.number - 1)];
}
double lost(const PatternResult& r) { return r.roof_area + r.wall_area; }

}  // namespace

Section failure_patterns(Study& study) {
  Section section{"failure_patterns",
                  "How unsupported tunnels fail",
                  "2, Table 1, Fig. 2",
                  {"24 sets of joints under 50 m of rock, let go at once and followed for one "
                   "second, with contact updates: a free fall of 4.9 m. Rock that "
                   "has moved by 0.3 m is lost. Names follow from measurements by rules that were "
                   "fixed beforehand (docs/failure-patterns.md); \"agrees\" is the same name."}};
  const program::PatternOptions options;
  std::vector<PatternResult> results;
  for (const PatternCase& c : program::pattern_cases())
    for (int seed = 1; seed <= study.samples(); ++seed) {
      results.emplace_back();
      results.back().number = c.number;
      results.back().seed = static_cast<std::uint64_t>(seed);
    }
  std::atomic<std::size_t> finished{0};
  std::atomic<bool> go_on{true};
  std::mutex guard;
  parallel_for(results.size(), study.threads(), [&](std::size_t k) {
    if (!go_on) return;
    const std::string what = case_text(case_of(results[k]), results[k].seed, options);
    const auto stored = study.store().find ? study.store().find(what) : std::nullopt;
    if (stored) {
      results[k] = pattern_from_json(*stored);
    } else {
      results[k] = program::run_pattern(case_of(results[k]), results[k].seed, options);
      if (study.store().add) study.store().add(what, pattern_json(results[k]));
    }
    const std::size_t now = ++finished;
    const std::scoped_lock lock(guard);
    if (!study.progress("collapses",
                        static_cast<double>(now) / static_cast<double>(results.size())))
      go_on = false;
  });
  if (!go_on) throw Study::Stopped{};

  section.pictures.push_back(
      {"failure_patterns", program::patterns_sheet(results),
       "The first realisation of every case at the end, with the paper's name and "
       "ours."});
  const auto of_case = [&](int number) {
    std::vector<const PatternResult*> found;
    for (const PatternResult& r : results)
      if (r.number == number) found.push_back(&r);
    return found;
  };
  Table table{"Roof and walls, by realisation (m² lost)",
              {"case", "roof, paper", "roof, measured", "agree", "walls, paper", "walls, measured",
               "agree"},
              {}};
  int roofs = 0, walls = 0;
  for (const PatternCase& c : program::pattern_cases()) {
    std::string roof, wall;
    int roof_same = 0, wall_same = 0;
    for (const PatternResult* r : of_case(c.number)) {
      roof += (roof.empty() ? "" : "; ") + std::string(to_string(r->roof)) + " " +
              fixed_text(r->roof_area, 0);
      wall += (wall.empty() ? "" : "; ") + std::string(to_string(r->wall)) + " " +
              fixed_text(r->wall_area, 0);
      roof_same += program::roof_agrees(c, *r);
      wall_same += program::wall_agrees(c, *r);
    }
    roofs += roof_same;
    walls += wall_same;
    table.rows.push_back({std::to_string(c.number), to_string(c.roof), roof,
                          std::to_string(roof_same), to_string(c.wall), wall,
                          std::to_string(wall_same)});
  }
  section.tables.push_back(table);

  // ---- findings ----
  const int runs = static_cast<int>(results.size()), n = study.samples();
  const auto of_all = [&](int count) {
    return std::to_string(count) + " of " + std::to_string(runs) + " runs";
  };
  section.findings.push_back(
      {"PF-019", agrees_if(roofs > runs / 2),
       "roof named as in the paper in " + of_all(roofs) + ", walls in " + of_all(walls),
       "One run a case cannot be compared with one word: realisations of the same case differ as much as "
       "cases do, which is the paper's own conclusion. Sliding of the roof along one set is named "
       "less often here: blocks that ride down together fall straight once they are free."});
  int falls = 0, falls_cases = 0;
  for (const PatternCase& c : program::pattern_cases()) {
    int here = 0;
    for (const PatternResult* r : of_case(c.number)) here += r->roof != RoofFall::none;
    falls += here;
    falls_cases += here > 0;
  }
  section.findings.push_back(
      {"PF-020", agrees_if(falls == runs),
       "rock falls from the roof in " + of_all(falls) + ", in some realisation of " +
           std::to_string(falls_cases) + " of 24 cases",
       falls == runs
           ? ""
           : "Steep sets with 35° of friction (11 to 16, 24) hold the roof up by horizontal stress "
             "in some realisations."});
  int second = 0;
  for (const PatternResult& r : results) second += r.wall != WallFailure::none;
  section.findings.push_back({"PF-021", agrees_if(2 * second > runs),
                              "rock is lost at the walls too in " + of_all(second)});
  int uneven = 0;
  double evenest = std::numeric_limits<double>::infinity();
  for (const PatternResult& r : results) {
    uneven += r.wall_unevenness > 1.5;
    evenest = std::min(evenest, r.wall_unevenness);
  }
  section.findings.push_back(
      {"PF-022", agrees_if(uneven == runs),
       "the rock within half a radius of the wall moves more than 1.5 times the mean in one eighth "
       "of the circle in " +
           of_all(uneven) + "; evenest " + printed_text(evenest, 3),
       uneven == runs ? "" : "Runs in which little comes down close almost evenly."});
  // Along which of its sets, by falling dip, the roof of a case moves.
  const auto moved_along = [&](int number, int set) {
    double moved = 0;
    for (const PatternResult* r : of_case(number))
      moved += r->roof_slides[static_cast<std::size_t>(set)] * r->roof_area;
    return moved;
  };
  const bool first = moved_along(1, 2) > moved_along(1, 0) && moved_along(1, 2) > moved_along(1, 1);
  const bool sixth = moved_along(6, 2) > moved_along(6, 0);
  section.findings.push_back(
      {"PF-023", agrees_if(first && sixth),
       "roof rock that moved along sets A, B, C, all realisations: no. 1 " +
           printed_text(moved_along(1, 0), 2) + ", " + printed_text(moved_along(1, 1), 2) + ", " +
           printed_text(moved_along(1, 2), 2) + " m² (80W is C); no. 6 " +
           printed_text(moved_along(6, 0), 2) + ", " + printed_text(moved_along(6, 1), 2) + ", " +
           printed_text(moved_along(6, 2), 2) + " m² (45W is C, 55E is A)",
       first && sixth
           ? ""
           : "Most of the rock falls straight once it is loose; of the little that slides in "
             "no. 6 more follows 55E than 45W. The paper shows one realisation."});
  int all_three = 0, third_runs = 0;
  for (const PatternResult* r : of_case(3)) {
    if (r->roof_area < 0.2) continue;
    ++third_runs;
    all_three += *std::min_element(r->bounds.begin(), r->bounds.end()) > 0.02;
  }
  section.findings.push_back(
      {"PF-024", agrees_if(2 * all_three > third_runs),
       "no. 3: all three sets make more than 2 % of the edge of the fall in " +
           std::to_string(all_three) + " of " + std::to_string(third_runs) + " roofs that fall"});
  std::map<std::pair<int, int>, int> pairs;
  for (const PatternResult& r : results) {
    if (r.roof_area < 4) continue;
    const auto least = std::min_element(r.bounds.begin(), r.bounds.end()) - r.bounds.begin();
    ++pairs[{least == 0 ? 1 : 0, least == 2 ? 1 : 2}];
  }
  std::string pair_text;
  for (const auto& [pair, count] : pairs)
    pair_text += (pair_text.empty() ? "" : ", ") +
                 std::string(1, static_cast<char>('A' + pair.first)) +
                 static_cast<char>('A' + pair.second) + " " + std::to_string(count);
  section.findings.push_back({"PF-025", agrees_if(pairs.size() > 1),
                              "pairs that bound the larger roof falls: " + pair_text});
  double right_c = 0, left_b = 0, right_all = 0, left_all = 0;
  for (const PatternResult* r : of_case(5)) {
    right_c += r->right_slides[2] * r->right_area;
    right_all += r->right_area;
    left_b += (r->left_slides[0] + r->left_slides[1]) * r->left_area;
    left_all += r->left_area;
  }
  const bool sides = right_c > 0.25 * right_all && left_b > 0.25 * left_all;
  section.findings.push_back(
      {"PF-026", agrees_if(sides),
       "no. 5: " + printed_text(right_c, 2) + " of " + printed_text(right_all, 2) +
           " m² lost at the eastern wall moved along 50W; " + printed_text(left_b, 2) + " of " +
           printed_text(left_all, 2) + " m² at the western one along 20E or 40E",
       sides ? "" : "one of the walls loses its rock otherwise"});
  double toppled = 0, at_walls = 0;
  for (const PatternResult* r : of_case(10)) {
    toppled += r->toppled * r->wall_area;
    at_walls += r->wall_area;
  }
  section.findings.push_back(
      {"PF-027", agrees_if(toppled > 0.1 * at_walls),
       "no. 10: " + printed_text(toppled, 2) + " of " + printed_text(at_walls, 2) +
           " m² lost at the walls turned more than it moved",
       toppled > 0.1 * at_walls ? "" : "it slides; a second may be too short to topple"});
  const auto areas = [&](int number) {
    std::pair<double, double> sum{0, 0};
    for (const PatternResult* r : of_case(number)) {
      sum.first += r->roof_area / n;
      sum.second += r->wall_area / n;
    }
    return sum;
  };
  const auto c22 = areas(22), c23 = areas(23);
  const bool moves = c22.first > c22.second && c23.first < c23.second;
  section.findings.push_back(
      {"PF-028", agrees_if(moves),
       "mean lost at roof and walls: no. 22 " + printed_text(c22.first, 2) + ", " +
           printed_text(c22.second, 2) + " m²; no. 23 " + printed_text(c23.first, 2) + ", " +
           printed_text(c23.second, 2) + " m²",
       moves ? ""
             : "Half a dozen square metres decide it, and realisations differ by more; the "
               "paper compares one realisation of each."});
  bool less = true;
  std::string pair_losses;
  for (const auto& [soft, rough] : {std::pair(11, 12), {13, 14}, {15, 16}}) {
    double a = 0, b = 0;
    for (const PatternResult* r : of_case(soft)) a += lost(*r) / n;
    for (const PatternResult* r : of_case(rough)) b += lost(*r) / n;
    less = less && b <= a;
    pair_losses += (pair_losses.empty() ? "" : "; ") + std::to_string(soft) + "/" +
                   std::to_string(rough) + " " + printed_text(a, 3) + ", " + printed_text(b, 3);
  }
  section.findings.push_back(
      {"PF-029", agrees_if(less),
       "mean m² lost with the smaller and the larger friction: " + pair_losses});
  // Where the sector that loses most lies, from realisation to realisation.
  int moving = 0, compared = 0;
  for (const PatternCase& c : program::pattern_cases()) {
    std::vector<long> places;
    for (const PatternResult* r : of_case(c.number))
      if (lost(*r) > 0.5)
        places.push_back(std::max_element(r->by_direction.begin(), r->by_direction.end()) -
                         r->by_direction.begin());
    if (places.size() < 2) continue;
    ++compared;
    moving +=
        std::adjacent_find(places.begin(), places.end(), std::not_equal_to<>()) != places.end();
  }
  section.findings.push_back(
      {"PF-030", Agreement::not_testable,
       "the eighth that loses most differs between realisations in " + std::to_string(moving) +
           " of " + std::to_string(compared) +
           " cases: where to put a single bolt is not known beforehand",
       "A conclusion, not a measurement: that failure moves about supports it, but no run with "
       "single bolts is in the paper to be held against."});
  return section;
}

}  // namespace voussoir::paper
