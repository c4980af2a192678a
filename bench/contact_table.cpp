// SPDX-License-Identifier: MIT
// One table of all libraries, from one run:
//   contact_table [--dir FOLDER] [--budget SECONDS per query] [--rounds N] [--only PART OF LABEL]
// Runs every `contact_peers_*` that lies beside it, one after the other, N times round, and prints
// Markdown: a summary, then all queries. What is missing in FOLDER is written first, by
// `contact_workloads`.
#include <stdio.h>  // popen, of POSIX

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

/// A line of `contact_peers_*`, by its keys.
class Line {
 public:
  explicit Line(std::string text) : text_(std::move(text)) {}

  [[nodiscard]] std::string text(const std::string& key) const {
    const std::string mark = "\"" + key + "\":";
    const std::size_t at = text_.find(mark);
    if (at == std::string::npos) return {};
    const std::size_t start = at + mark.size();
    if (text_[start] == '"') return text_.substr(start + 1, text_.find('"', start + 1) - start - 1);
    return text_.substr(start, text_.find_first_of(",}", start) - start);
  }
  [[nodiscard]] double number(const std::string& key) const { return std::atof(text(key).c_str()); }

 private:
  std::string text_;
};

struct Row {
  Line accuracy;                 ///< of the last round; it is the same in all
  std::map<int, double> median;  ///< of the passes of a round, by round [ns per pair]

  [[nodiscard]] double least() const {
    double value = HUGE_VAL;
    for (const auto& [round, time] : median) value = std::min(value, time);
    return value;
  }
  [[nodiscard]] double most() const {
    double value = 0;
    for (const auto& [round, time] : median) value = std::max(value, time);
    return value;
  }
};

/// By workload, then in the order in which the programs spoke first.
using Rows = std::vector<std::pair<std::string, Row>>;
using Table = std::map<std::string, Rows>;

void read(const std::string& command, int round, Table& table) {
  std::fprintf(stderr, "round %d: %s\n", round + 1, command.c_str());
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return;
  std::string text;
  for (int c = std::getc(pipe); c != EOF; c = std::getc(pipe)) {
    if (c != '\n') {
      text.push_back(static_cast<char>(c));
      continue;
    }
    const Line line(std::exchange(text, {}));
    std::string key;
    for (const char* part : {"peer", "build", "precision", "op", "warm"})
      key += line.text(part) + '|';
    auto& rows = table[line.text("workload")];
    auto row =
        std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.first == key; });
    if (row == rows.end()) row = rows.insert(rows.end(), {key, Row{line, {}}});
    row->second.median[round] = line.number("ns_median");
  }
  if (pclose(pipe) != 0)
    std::fprintf(stderr, "%s: failed, its rows are incomplete\n", command.c_str());
}

/// What ratios refer to: the library closest in purpose, by its full manifold.
bool is_measure(const Line& line) {
  return line.text("peer") == "Box2D 2.4 b2CollidePolygons" ||
         line.text("peer") == "ODE 0.16 dCollide (up to 32)";
}

/// Median over the rounds of the ratio of times within one round.
std::optional<double> ratio(const Row& row, const Row& measure) {
  std::vector<double> ratios;
  for (const auto& [round, time] : row.median)
    if (const auto other = measure.median.find(round); other != measure.median.end())
      ratios.push_back(time / other->second);
  if (ratios.empty()) return std::nullopt;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

const Row* measure_of(const Rows& rows) {
  for (const auto& [key, row] : rows)
    if (is_measure(row.accuracy)) return &row;
  return nullptr;
}

std::string formatted(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string ratio_text(const Row& row, const Row* measure) {
  const auto value = measure != nullptr ? ratio(row, *measure) : std::nullopt;
  return value ? formatted("%.2f", *value) : "";
}

std::string built(const Line& line) {
  const std::string build = line.text("build");
  return build.rfind("O2-", 0) == 0 ? "plain -O2" : build == "O3-native" ? "native -O3" : build;
}

std::string described(const Line& line) {
  return line.text("peer") + ", " + line.text("op") + " | " + line.text("precision") + ", " +
         (line.number("warm") > 0 ? "warm" : "cold") + " | " + built(line);
}

/// True for the most that a library gives: its manifold, else its depth.
bool is_fullest(const Line& line) {
  const std::string peer = line.text("peer"), operation = line.text("op");
  const bool has_manifold = peer.rfind("libccd", 0) != 0 && peer.rfind("FCL", 0) != 0;
  return operation == (has_manifold ? "manifold" : "depth");
}

/// The fullest answers on the two workloads of one dimension, one line for each library.
void print_summary(const Table& table, const std::string& name) {
  const auto near = table.find(name), deep = table.find(name + "deep");
  if (near == table.end() || deep == table.end()) return;
  Rows rows;
  std::copy_if(near->second.begin(), near->second.end(), std::back_inserter(rows),
               [](const auto& row) { return is_fullest(row.second.accuracy); });
  std::stable_sort(rows.begin(), rows.end(), [](const auto& p, const auto& q) {
    return p.second.least() < q.second.least();
  });
  std::printf(
      "\n| query | | built | %s: ns | ratio | %sdeep: ns | ratio | wrong | depth error, m |\n",
      name.c_str(), name.c_str());
  std::printf("|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& row : rows) {
    const auto other = std::find_if(deep->second.begin(), deep->second.end(),
                                    [&row](const auto& r) { return r.first == row.first; });
    if (other == deep->second.end()) continue;
    double wrong = 0, error = 0;
    for (const Row* each : {&row.second, &other->second}) {
      for (const char* key : {"false_pos", "false_neg", "fail"})
        wrong += each->accuracy.number(key);
      error = std::max(error, each->accuracy.number("depth_err_max"));
    }
    std::printf("| %s | %.0f | %s | %.0f | %s | %.0f | %.1e |\n",
                described(row.second.accuracy).c_str(), row.second.least(),
                ratio_text(row.second, measure_of(near->second)).c_str(), other->second.least(),
                ratio_text(other->second, measure_of(deep->second)).c_str(), wrong, error);
  }
}

/// All queries on one workload.
void print(const std::string& workload, Rows rows) {
  const auto rank = [](const Row& row) {
    const std::string operation = row.accuracy.text("op");
    return operation == "manifold" ? 0 : operation == "depth" ? 1 : 2;
  };
  std::stable_sort(rows.begin(), rows.end(), [&](const auto& p, const auto& q) {
    return rank(p.second) != rank(q.second) ? rank(p.second) < rank(q.second)
                                            : p.second.least() < q.second.least();
  });
  const Row* measure = measure_of(rows);
  std::printf("\n### %s\n\n", workload.c_str());
  std::printf(
      "| query | | built | ns per pair | ratio | invented / missed | failed | depth error, m | deep wrong by > 10 um |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [key, row] : rows) {
    const Line& line = row.accuracy;
    const bool has_depth = line.number("both_touch") > 0;
    std::printf("| %s | %.1f (%.1f) | %s | %.0f / %.0f | %.0f | %s | %s |\n",
                described(line).c_str(), row.least(), row.most(), ratio_text(row, measure).c_str(),
                line.number("false_pos"), line.number("false_neg"), line.number("fail"),
                has_depth ? formatted("%.1e", line.number("depth_err_max")).c_str() : "",
                has_depth ? formatted("%.0f", line.number("depth_err_over_10um")).c_str() : "");
  }
}

std::string in_quotes(const std::string& text) { return "'" + text + "'"; }

}  // namespace

int main(int argc, char** argv) {
  namespace files = std::filesystem;
  std::string folder = "contact_workloads.data", budget = "0.4", only;
  int rounds = 3;
  for (int k = 1; k + 1 < argc; k += 2) {
    const std::string option = argv[k];
    if (option == "--dir") folder = argv[k + 1];
    if (option == "--budget") budget = argv[k + 1];
    if (option == "--only") only = argv[k + 1];
    if (option == "--rounds") rounds = std::atoi(argv[k + 1]);
  }
  const files::path here = files::absolute(files::path(argv[0])).parent_path();
  if (!files::exists(files::path(folder) / "W3deep.pairs")) {
    const std::string command =
        in_quotes((here / "contact_workloads").string()) + ' ' + in_quotes(folder) + " >&2";
    if (std::system(command.c_str()) != 0) return 1;
  }
  std::vector<std::string> programs;
  for (const auto& entry : files::directory_iterator(here))
    if (entry.path().filename().string().rfind("contact_peers_", 0) == 0 &&
        !entry.path().has_extension())
      programs.push_back(entry.path().string());
  std::sort(programs.begin(), programs.end());
  Table table;
  for (int round = 0; round < rounds; ++round)
    for (const std::string& program : programs)
      read(in_quotes(program) + " --dir " + in_quotes(folder) + " --budget " + in_quotes(budget) +
               " --only " + in_quotes(only),
           round, table);
  std::printf(
      "Nanoseconds per candidate pair, one thread: least of the medians of %d rounds (greatest in brackets). `ratio`: to the manifold of Box2D in 2-D, of ODE in 3-D, within one round. `wrong`: decisions on both workloads.\n",
      rounds);
  print_summary(table, "W2");
  print_summary(table, "W3");
  for (const auto& [workload, rows] : table) print(workload, rows);
  return table.empty() ? 1 : 0;
}
