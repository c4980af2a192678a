// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/io/operating_system.hpp>

namespace voussoir {

namespace detail {
[[noreturn]] inline void throw_write_error(const std::filesystem::path& path,
                                           const std::string& reason) {
  throw std::runtime_error("cannot write '" + utf8_text(path) + "': " + reason);
}

/// Writes all of `content` and closes the file.
/// @return  0, or the errno of the first step that failed
VOUSSOIR_INLINE int write_and_close(std::FILE* file, std::string_view content);

inline std::string error_text(int error_number) {
  return std::generic_category().message(error_number);
}

/// "4711@host": this process, as part files are named.
inline std::string process_name() { return std::to_string(process_number()) + "@" + host_name(); }

/// The hidden neighbour in which the content of `file_name` waits:
/// ".NAME.PROCESS@HOST.RANDOM.part". 64 random bits: two runs that write one path at a time must
/// not share it.
inline std::string part_name(const std::string& file_name) {
  std::random_device random;
  return "." + file_name + "." + process_name() + "." + std::to_string(random()) +
         std::to_string(random()) + ".part";
}

/// Whether a file is a part of ours whose process, of this host, has ended.
VOUSSOIR_INLINE bool is_abandoned_part(const std::string& file_name);
}  // namespace detail

/// Removes from a folder the part files that killed processes have left there. Those of processes
/// that run, or ran on another host, stay, and so does every file with another pattern of name.
/// @return  how many were removed
VOUSSOIR_INLINE int clear_abandoned_parts(const std::filesystem::path& folder);

/// Content on its way to a file: it lies, complete and checked, in a hidden neighbour of the
/// target until `publish` renames it. Destroyed before that, it leaves no trace; what a killed
/// process leaves, `clear_abandoned_parts` finds.
///
/// Survives a killed process and a full disk; not a power cut, for which the operating system
/// would have to be told to empty its own buffers. A target that is a device or pipe
/// (/dev/stdout) is written in place by `publish`: renaming would replace the device itself.
class StagedFile {
 public:
  /// @throws std::runtime_error  naming path and reason: no such folder, no permission, disk full,
  ///                             target is a folder
  StagedFile(const std::filesystem::path& path, std::string_view content);

  StagedFile(StagedFile&& other) noexcept
      : path_(std::move(other.path_)),
        temporary_(std::exchange(other.temporary_, {})),
        content_for_device_(std::move(other.content_for_device_)),
        is_device_(std::exchange(other.is_device_, false)) {}
  StagedFile& operator=(StagedFile&&) = delete;
  ~StagedFile() { discard(); }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Puts the content in its place, replacing an older file in one step. A second call does
  /// nothing.
  /// @throws std::runtime_error  naming path and reason; the older file is then untouched
  void publish();

 private:
  void discard() noexcept {
    if (temporary_.empty()) return;
    std::error_code ignored;  // nothing left to tell it to
    std::filesystem::remove(temporary_, ignored);
    temporary_.clear();
  }

  std::filesystem::path path_;
  std::filesystem::path temporary_;  ///< empty: nothing staged, or already published
  std::string content_for_device_;
  bool is_device_ = false;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE StagedFile::StagedFile(const std::filesystem::path& path, std::string_view content)
    : path_(path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  // Follow a link, so that what it points to is replaced and not the link.
  if (fs::is_symlink(fs::symlink_status(path_, ignored))) {
    const fs::path pointed_to = fs::weakly_canonical(path_, ignored);
    if (!ignored) path_ = pointed_to;
  }
  const fs::file_status status = fs::status(path_, ignored);
  if (path_.filename().empty() || fs::is_directory(status)) {
    detail::throw_write_error(path_, "it is a folder");
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    content_for_device_ = content;
    is_device_ = true;
    return;
  }
  temporary_ = path_.parent_path() / utf8_path(detail::part_name(utf8_text(path_.filename())));
  errno = 0;
  std::FILE* file = create_new_file(temporary_);
  if (file == nullptr) {
    const int reason = errno;
    temporary_.clear();
    detail::throw_write_error(path_, detail::error_text(reason));
  }
  if (const int reason = detail::write_and_close(file, content); reason != 0) {
    discard();  // the destructor of a half-built object does not run
    detail::throw_write_error(path_, detail::error_text(reason));
  }
}

VOUSSOIR_INLINE void StagedFile::publish() {
  if (is_device_) {
    is_device_ = false;
    errno = 0;
    std::FILE* file = open_to_write(path_);
    const int reason = file == nullptr ? errno : detail::write_and_close(file, content_for_device_);
    if (reason != 0) detail::throw_write_error(path_, detail::error_text(reason));
  }
  if (temporary_.empty()) return;
  std::error_code failure;
  std::filesystem::rename(temporary_, path_, failure);
  if (failure) detail::throw_write_error(path_, failure.message());
  temporary_.clear();
}

#endif

/// Writes a file so that a reader sees the old content or the new, never a part.
/// @throws std::runtime_error  naming path and reason; the old file stays, no temporary is left
inline void write_atomically(const std::filesystem::path& path, std::string_view content) {
  StagedFile(path, content).publish();
}

/// The files of one run: all are written and checked first, then renamed together, so that a run
/// that fails half-way leaves the folder as it was.
///
///   OutputSet outputs;
///   outputs.add(folder / "bolts.csv", bolts.text());
///   outputs.add(folder / "blocks.svg", picture);
///   outputs.publish();
///
/// The renames come one after another: a process killed between two of them leaves every file
/// whole, but some of this run and some of the last.
class OutputSet {
 public:
  /// @throws std::runtime_error     the content cannot be written (see StagedFile)
  /// @throws std::invalid_argument  the path was added before
  void add(const std::filesystem::path& path, std::string_view content) {
    for (const StagedFile& file : files_) {
      if (file.path().lexically_normal() == path.lexically_normal()) {
        throw std::invalid_argument("OutputSet: '" + utf8_text(path) + "' was added twice");
      }
    }
    files_.emplace_back(path, content);
  }

  [[nodiscard]] std::size_t size() const { return files_.size(); }
  void clear() { files_.clear(); }  ///< forgets what was added: nothing of it is left

  /// Renames everything and empties the set.
  /// @throws std::runtime_error  one file could not be put in its place; those added before it are
  ///                             in place, it and those after it are not
  void publish() {
    std::vector<StagedFile> files = std::exchange(files_, {});
    for (StagedFile& file : files) file.publish();
  }

 private:
  std::vector<StagedFile> files_;
};

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE int write_and_close(std::FILE* file, std::string_view content) {
  errno = 0;
  const bool is_written =
      std::fwrite(content.data(), 1, content.size(), file) == content.size() &&
      std::fflush(file) == 0;  // a full disk shows here, not in fwrite, which only fills a buffer
  int reason = is_written ? 0 : (errno != 0 ? errno : EIO);
  errno = 0;
  if (std::fclose(file) != 0 && reason == 0) reason = errno != 0 ? errno : EIO;  // network drives
  return reason;
}

VOUSSOIR_INLINE bool is_abandoned_part(const std::string& file_name) {
  const std::string end = ".part";
  if (!file_name.starts_with('.') || !file_name.ends_with(end)) return false;
  const std::string name = file_name.substr(0, file_name.size() - end.size());
  const auto all_digits = [](const std::string& text) {
    return !text.empty() && text.size() <= 20 &&
           text.find_first_not_of("0123456789") == std::string::npos;
  };
  const std::size_t random = name.find_last_of('.');
  if (random == 0 || random == std::string::npos || !all_digits(name.substr(random + 1)))
    return false;
  const std::size_t process = name.find_last_of('.', random - 1);
  if (process == 0 || process == std::string::npos) return false;  // a name must stand before
  const std::string owner = name.substr(process + 1, random - process - 1), own = process_name();
  const std::size_t at = owner.find('@');
  if (at == std::string::npos || !all_digits(owner.substr(0, at)) || at > 9 ||
      owner.substr(at) != own.substr(own.find('@')))
    return false;
  return !process_runs(std::stol(owner.substr(0, at)));
}

}  // namespace detail

VOUSSOIR_INLINE int clear_abandoned_parts(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code ignored;  // what cannot be read or removed stays
  std::vector<fs::path> abandoned;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    if (detail::is_abandoned_part(utf8_text(entry->path().filename())))
      abandoned.push_back(entry->path());
  int removed = 0;
  for (const fs::path& path : abandoned)
    if (fs::is_regular_file(fs::symlink_status(path, ignored)))
      removed += fs::remove(path, ignored) ? 1 : 0;
  return removed;
}

#endif

}  // namespace voussoir
