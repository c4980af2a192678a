// SPDX-License-Identifier: MIT
#include "report_files.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <system_error>
#include <voussoir/core/errors.hpp>
#include <voussoir/io/operating_system.hpp>

#include "regular_file.hpp"

namespace voussoir::program {

namespace {

/// Files of one verb: the first that is there tells of which run the others must be.
struct FileGroup {
  const char* verb;
  std::vector<const char*> names;
};

/// What reports show. A group that stands behind another may be of a run of its own, if its first
/// file says that it is of the same tunnel.
const std::vector<FileGroup>& groups() {
  static const std::vector<FileGroup> all = {
      {"run",
       {"run.json", "blocks.svg", "bolts.csv", "lining.csv", "lining_strength.svg", "stereonet.svg",
        "blocks.csv", "contacts.csv"}},
      {"safety", {"safety.json", "safety.csv", "safety.svg"}},
      {"realisations", {"realisations.json", "realisations.csv", "realisations.svg"}},
      {"design", {"design.json", "design.csv", "design.svg"}},
      {"diagram",
       {"interaction.json", "interaction.csv", "interaction.svg", "interaction_quantile.svg",
        "interaction_rockfall.svg"}},
      {"sweep", {"sweep.csv", "sweep_means.csv", "sweep.svg"}}};
  return all;
}

constexpr const char* stage_folder = "history";

bool is_stage_picture(const std::string& name) {
  return name.starts_with(std::string(stage_folder) + "/stage_") && name.ends_with(".svg");
}

bool is_shown(const std::string& name) {
  if (is_stage_picture(name)) return true;
  for (const FileGroup& group : groups())
    if (std::find(group.names.begin(), group.names.end(), name) != group.names.end()) return true;
  return false;
}

constexpr const char* what_is_accepted =
    "\n   = accepted: a folder of results as voussoir run, safety, diagram, design, realisations "
    "or sweep --out writes it";

/// Cells of rows, by the rules of RFC 4180.
std::vector<std::vector<std::string>> rows_of(std::string_view text) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row(1);
  bool is_quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (is_quoted && c == '"' && k + 1 < text.size() && text[k + 1] == '"') {
      row.back() += '"';
      ++k;
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      row.emplace_back();
    } else if (c == '\n' && !is_quoted) {
      rows.push_back(std::move(row));
      row.assign(1, "");
    } else if (c != '\r' || is_quoted) {
      row.back() += c;
    }
  }
  if (row.size() > 1 || !row.front().empty()) rows.push_back(std::move(row));
  return rows;
}

std::string words_of(const nlohmann::json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string()
             ? json[key].get<std::string>()
             : std::string();
}

}  // namespace

ReportTable::ReportTable(std::string_view text) : rows_(rows_of(text)) {
  if (rows_.empty()) return;
  columns_ = std::move(rows_.front());
  rows_.erase(rows_.begin());
}

bool ReportTable::has(std::string_view column) const {
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

std::string_view ReportTable::cell(std::size_t row, std::string_view column) const {
  const auto at = static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), column) -
                                           columns_.begin());
  return row < rows_.size() && at < rows_[row].size() ? rows_[row][at] : std::string_view();
}

double ReportTable::number(std::size_t row, std::string_view column) const {
  const std::string_view text = cell(row, column);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  return is_number ? value : std::numeric_limits<double>::quiet_NaN();
}

std::string run_id_of(const std::string& name, const std::string& text) {
  const auto sixteen = [&](std::size_t at) {
    const std::string id = text.substr(std::min(at, text.size()), 16);
    const bool is_id =
        id.size() == 16 && id.find_first_not_of("0123456789abcdef") == std::string::npos;
    return is_id ? id : "";
  };
  if (name.ends_with(".csv")) {
    const ReportTable table(text);
    return table.size() > 0 ? std::string(table.cell(0, "run_id")) : "";
  }
  const std::string mark = name.ends_with(".json") ? "\"run_id\": \"" : ", run ";
  const std::size_t at = text.find(mark);
  return at > 1000 ? "" : sixteen(at + mark.size());  // it stands at the beginning
}

ReportFiles ReportFiles::read(const std::string& folder) {
  namespace fs = std::filesystem;
  ReportFiles files;
  files.folder_ = folder;
  std::error_code error;
  const fs::path there = utf8_path(folder);
  if (!fs::is_directory(there, error))
    throw InvalidInput((folder.empty() ? "\"\"" : folder) +
                       (fs::exists(there, error) ? " is no folder" : ": there is no such folder") +
                       what_is_accepted);
  const auto take = [&](const std::string& name) {
    const fs::path path = there / utf8_path(name);
    if (!fs::exists(path, error)) return;
    std::ifstream file;
    if (const std::string fault = open_regular(path, file); !fault.empty())
      throw InvalidInput(utf8_text(path) + " " + fault + what_is_accepted);
    files.add(name, std::string(std::istreambuf_iterator<char>(file), {}));
  };
  for (const FileGroup& group : groups())
    for (const char* const name : group.names) take(name);
  if (files.has("run.json"))
    for (fs::directory_iterator entry(there / stage_folder, error), end; !error && entry != end;
         entry.increment(error)) {
      const std::string name = stage_folder + ("/" + utf8_text(entry->path().filename()));
      if (is_stage_picture(name)) take(name);
    }
  files.check();
  return files;
}

void ReportFiles::add(const std::string& name, std::string text) {
  if (is_shown(name)) files_[name] = std::move(text);
}

std::string ReportFiles::path_of(const std::string& name) const {
  return folder_.empty() ? name : utf8_text(utf8_path(folder_) / utf8_path(name));
}

nlohmann::json ReportFiles::json(const std::string& name) const {
  if (!has(name)) return nullptr;
  nlohmann::json json = nlohmann::json::parse(text(name), nullptr, false);
  if (!json.is_object())
    throw InvalidInput(path_of(name) +
                       " is damaged: it is no JSON object\n   = accepted: the file as voussoir "
                       "wrote it; compute it again");
  return json;
}

ReportTable ReportFiles::table(const std::string& name) const {
  return ReportTable(has(name) ? std::string_view(text(name)) : std::string_view());
}

std::vector<std::string> ReportFiles::names() const {
  std::vector<std::string> all;
  for (const FileGroup& group : groups())
    for (const char* const name : group.names)
      if (has(name)) all.emplace_back(name);
  return all;
}

std::vector<std::string> ReportFiles::stage_pictures() const {
  std::vector<std::string> all;
  for (const auto& [name, text] : files_)
    if (is_stage_picture(name)) all.push_back(name);
  std::sort(all.begin(), all.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;  // 1000 stands behind 999
  });
  return all;
}

std::string ReportFiles::run_id() const {
  for (const std::string& name : names())
    if (std::string id = run_id_of(name, text(name)); !id.empty()) return id;
  return "";
}

void ReportFiles::check() const {
  std::string leader, tunnel;      // the file that leads, the id of its run
  std::vector<std::string> known;  // that, and the ids of what is of the same tunnel
  for (const FileGroup& group : groups()) {
    std::string first, id;
    for (const char* const name : group.names) {
      if (!has(name)) continue;
      const std::string found = run_id_of(name, text(name));
      const bool is_empty_table = std::string_view(name).ends_with(".csv") && found.empty() &&
                                  table(name).size() == 0 && !table(name).columns().empty();
      if (is_empty_table) continue;  // a table without rows has no id
      if (found.empty())
        throw InvalidInput(path_of(name) +
                           " does not say of which run it is\n   = accepted: the file as voussoir "
                           "wrote it; compute it again");
      if (first.empty()) {
        first = name;
        id = found;
        // What belongs to the run of a tunnel says so, even where it has an id of its own.
        std::string of = id;
        if (first.ends_with(".json")) of = words_of(json(first), "tunnel_id");
        if (of.empty()) of = id;
        if (leader.empty()) {
          leader = first;
          tunnel = of;
        } else if (std::find(known.begin(), known.end(), of) == known.end()) {
          throw InvalidInput(path_of(name) + " is of another run (" + id + ") than " + leader +
                             " (" + tunnel +
                             "): a report is of one\n   = accepted: a folder for each of them");
        }
        known.insert(known.end(), {of, id});
      } else if (found != id) {
        throw InvalidInput(path_of(name) + " is of another run (" + found + ") than " + first +
                           " (" + id +
                           "): a report is of one\n   = accepted: the files of one run; compute it "
                           "again, or in a folder of its own");
      }
    }
  }
  if (leader.empty()) throw InvalidInput(folder_ + ": holds no results" + what_is_accepted);
  const nlohmann::json run = json("run.json");
  if (has("run.json") && !(run.contains("verdict") && run["verdict"].is_string()))
    throw InvalidInput(path_of("run.json") +
                       " is damaged: it has no verdict\n   = accepted: the file as voussoir run "
                       "wrote it; compute it again");
  for (const std::string& name : stage_pictures())
    if (const std::string id = run_id_of(name, text(name)); id != words_of(run, "run_id"))
      throw InvalidInput(path_of(name) + " is of another run (" + (id.empty() ? "none" : id) +
                         ") than run.json (" + words_of(run, "run_id") +
                         "): a report is of one\n   = accepted: the files of one run; compute it "
                         "again, or in a folder of its own");
  // Whatever belongs to a run is nothing without it.
  for (const char* const name : groups().front().names)
    if (has(name) && !has("run.json"))
      throw InvalidInput(path_of("run.json") + " is missing, and " + name + " is there" +
                         what_is_accepted);
}

}  // namespace voussoir::program
