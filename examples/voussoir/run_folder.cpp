// SPDX-License-Identifier: MIT
#include "run_folder.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/drawing/xml_text.hpp>
#include <voussoir/io/journal.hpp>

#include "regular_file.hpp"

namespace voussoir::program {

RunId::RunId(std::string_view what) {
  add(VOUSSOIR_VERSION_STRING);
  add(what);
}

RunId& RunId::add(std::string_view part) {
  text_ += std::to_string(part.size()) + ":";  // "ab", "c" is not "a", "bc"
  text_ += part;
  return *this;
}

RunId& RunId::add(double part) { return add(shortest_text(part)); }

RunId& RunId::add(const Input& input) {
  add_keys(input).add(joints_hash(input));
  if (input.laid)  // what a file of blocks holds, too
    for (const LaidBlockInput& block : input.laid->blocks) {
      add(block.name);
      for (const Point& p : block.vertices) add(p[0]).add(p[1]);
    }
  return *this;
}

RunId& RunId::add_keys(const Input& input) {
  // Mapped joints are what they are wherever their file lies.
  for (const std::string& line : input.content)
    if (!names_a_file(line)) add(line);
  return add(std::to_string(input.model.seed));
}

std::string joints_hash(const Input& input) {
  return input.joints_file.empty() ? "" : file_hash(input.joints_file);
}

std::string RunId::text() const { return text_hash(text_); }

namespace {

/// A column at the end of a table; line breaks within quotes end no row.
std::string with_column(const std::string& table, const std::string& name,
                        const std::string& value) {
  std::string result;
  bool quoted = false, is_header = true;
  for (const char c : table) {
    if (c == '"') quoted = !quoted;
    if (c == '\n' && !quoted) {
      const bool carriage = result.ends_with('\r');
      if (carriage) result.pop_back();
      result.append(",").append(is_header ? name : value);
      if (carriage) result += '\r';
      is_header = false;
    }
    result += c;
  }
  return result;
}

}  // namespace

std::string with_run_id(const std::string& file_name, std::string text, const std::string& run_id) {
  const std::string kind = std::filesystem::path(file_name).extension().string();
  std::string words = "voussoir " VOUSSOIR_VERSION_STRING ", run ";
  words += run_id;
  if (kind == ".csv") return with_column(text, "run_id", run_id);
  if (kind == ".json" && text.starts_with("{\n"))
    return text.insert(2, "  \"run_id\": \"" + run_id + "\",\n");
  if (kind == ".gp") return "# " + words + "\n" + text;
  if (kind == ".md") return text + "\n<!-- " + words + " -->\n";
  if (kind == ".svg" || kind == ".vtu" || kind == ".vtm" || kind == ".pvd" || kind == ".html") {
    // Behind the first line, which must stay the first: <?xml ...> or <!DOCTYPE ...>.
    const std::string comment = "<!-- " + words + " -->\n";
    const std::size_t end = text.find(">\n");
    if (text.starts_with("<?") || text.starts_with("<!")) {
      if (end == std::string::npos) return text;
      return text.insert(end + 2, comment);
    }
    return comment + text;
  }
  return text;
}

namespace {

/// Who wrote itself into a lock.
struct Holder {
  long process = 0;  ///< 0: not known
  std::string host;
};

Holder holder_of(const std::filesystem::path& lock) {
  Holder holder;
  std::ifstream file(lock);
  if (!(file >> holder.process >> holder.host)) holder = {};
  return holder;
}

}  // namespace

RunFolder::RunFolder(const std::string& folder, const std::string& option, LockedFile::Mode mode)
    : path_(utf8_path(folder)) {
  namespace fs = std::filesystem;
  if (folder.empty())
    throw InvalidInput(option + " \"\": the folder for the results has no name\n   = accepted: " +
                       option + " results, or . for the present folder");
  std::error_code error;
  fs::path there = fs::absolute(path_, error);
  std::vector<fs::path> missing;
  while (!fs::exists(there, error) && there.has_relative_path()) {
    if (!there.filename().empty()) missing.push_back(there);
    there = there.parent_path();
  }
  if (!fs::is_directory(there, error))
    throw std::runtime_error(option + " " + folder + ": '" + utf8_text(there) +
                             "' is not a folder");
  if (!may_write_in(there))
    throw std::runtime_error(option + " " + folder + ": no permission to write in '" +
                             utf8_text(there) + "'");
  while (!missing.empty()) {
    const bool is_new = fs::create_directory(missing.back(), error);
    if (error) {
      const std::string reason = error.message();
      let_go();
      throw std::runtime_error(option + " " + folder + ": cannot make the folder '" +
                               utf8_text(missing.back()) + "': " + reason);
    }
    if (is_new) made_.push_back(missing.back());
    missing.pop_back();
  }
  try {
    take_lock(option, mode);
    clear_abandoned_parts(path_);
  } catch (...) {  // the destructor of a half-built object does not run
    let_go();
    throw;
  }
}

RunFolder::~RunFolder() {
  outputs_.clear();
  let_go();
}

void RunFolder::add(const std::string& name, const std::string& text, const std::string& run_id) {
  const std::filesystem::path path = path_ / utf8_path(name), folder = path.parent_path();
  if (name.find('/') != std::string::npos && !std::filesystem::exists(folder)) {
    std::error_code error;
    if (std::filesystem::create_directory(folder, error)) made_.push_back(folder);
    if (error)
      throw std::runtime_error("cannot make the folder '" + utf8_text(folder) +
                               "': " + error.message());
  }
  outputs_.add(path, with_run_id(name, text, run_id));
  added_.insert(name);
}

void RunFolder::expect_folder(const std::string& name) const {
  const std::filesystem::path folder = path_ / utf8_path(name);
  std::error_code error;
  if (std::filesystem::exists(folder, error) && !std::filesystem::is_directory(folder, error))
    throw std::runtime_error("'" + utf8_text(folder) + "' is not a folder");
  clear_abandoned_parts(folder);
}

namespace {

/// Whether a file says that the program wrote it, see `with_run_id`.
bool is_of_program(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, error))) return false;
  std::ifstream file(path, std::ios::binary);
  std::string start(300, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return start.find("<!-- voussoir ") != std::string::npos;
}

}  // namespace

void RunFolder::replace_all_in(const std::string& folder) {
  emptied_.insert(folder);
  std::error_code ignored;  // what cannot be read stays
  for (std::filesystem::directory_iterator entry(path_ / folder, ignored), end;
       !ignored && entry != end; entry.increment(ignored))
    replace(folder + "/" + utf8_text(entry->path().filename()));
}

void RunFolder::publish() {
  outputs_.publish();
  made_.clear();
  std::error_code ignored;  // the results are there, whatever becomes of older ones
  for (const std::string& name : replaced_)
    if (const auto path = path_ / utf8_path(name); !added_.contains(name) && is_of_program(path))
      std::filesystem::remove(path, ignored);
  for (const std::string& folder : emptied_)
    if (std::filesystem::is_directory(path_ / folder, ignored) &&
        std::filesystem::is_empty(path_ / folder, ignored))
      std::filesystem::remove(path_ / folder, ignored);
}

void RunFolder::take_lock(const std::string& option, LockedFile::Mode mode) {
  const std::filesystem::path path = path_ / ".voussoir.lock";
  const auto refuse = [&](const std::string& reason) {
    throw std::runtime_error(option + " " + utf8_text(path_) + ": " + reason);
  };
  const auto refuse_held = [&](const Holder& holder) {
    const std::string who =
        holder.process == 0
            ? std::string("another process")
            : "process " + std::to_string(holder.process) +
                  (holder.host == host_name() || holder.host.empty() ? "" : " on " + holder.host);
    refuse("the folder is in use: " + who + " is computing results for it (it holds '" +
           utf8_text(path) +
           "')\n   = accepted: another folder, or this one when that run has ended");
  };
  try {
    lock_ = LockedFile::open(path, mode);
    const Holder holder = holder_of(path);
    if (!lock_) refuse_held(holder);
    // A drive without locks: believe what is written, if that process lives here.
    if (!lock_->is_locked() && holder.process > 0 && holder.host == host_name() &&
        holder.process != process_number() && process_runs(holder.process))
      refuse_held(holder);
    // Of several that share it the first is named, while it lives.
    const bool is_named_already = mode == LockedFile::Mode::shared && holder.host == host_name() &&
                                  process_runs(holder.process);
    if (is_named_already) return;
    lock_->cut(0);
    lock_->append(std::to_string(process_number()) + " " + host_name() +
                  "\nthe voussoir process that is computing results for this folder\n");
  } catch (const std::runtime_error& error) {
    if (std::string(error.what()).starts_with(option)) throw;
    refuse(error.what());
  }
}

void RunFolder::let_go() noexcept {
  std::error_code ignored;  // nothing left to tell it to
  if (lock_) lock_->close_and_remove();
  lock_.reset();
  for (; !made_.empty(); made_.pop_back()) std::filesystem::remove(made_.back(), ignored);
}

}  // namespace voussoir::program
