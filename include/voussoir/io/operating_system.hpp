// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#if VOUSSOIR_BODIES
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <system_error>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <sys/stat.h>

// The few functions of Windows that are needed, declared as its own header does: that one defines
// `near`, `far`, `min` and hundreds of other words of ours as macros.
extern "C" {
struct _OVERLAPPED;
__declspec(dllimport) int __stdcall LockFileEx(void*, unsigned long, unsigned long, unsigned long,
                                               unsigned long, struct _OVERLAPPED*);
__declspec(dllimport) void* __stdcall OpenProcess(unsigned long, int, unsigned long);
__declspec(dllimport) int __stdcall GetExitCodeProcess(void*, unsigned long*);
__declspec(dllimport) int __stdcall CloseHandle(void*);
__declspec(dllimport) unsigned long __stdcall GetLastError();
__declspec(dllimport) wchar_t* __stdcall GetCommandLineW();
__declspec(dllimport) wchar_t** __stdcall CommandLineToArgvW(const wchar_t*, int*);
__declspec(dllimport) void* __stdcall LocalFree(void*);
__declspec(dllimport) unsigned __stdcall GetConsoleOutputCP();
__declspec(dllimport) int __stdcall SetConsoleOutputCP(unsigned);
}
#else
#include <fcntl.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): kill is of POSIX, not of C++
#include <spawn.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#endif
#endif

/// What C++ leaves to the operating system: processes, locks, writes that reach the disk. The one
/// header that knows POSIX and Windows; everything else in the toolkit is plain C++.
namespace voussoir {

/// This machine as it calls itself: letters, digits and hyphens, anything else as a hyphen; empty
/// if it has no name.
[[nodiscard]] VOUSSOIR_INLINE std::string host_name();
/// Of this process, > 0.
[[nodiscard]] VOUSSOIR_INLINE long process_number();
/// Whether a process of this host runs, whoever owns it.
[[nodiscard]] VOUSSOIR_INLINE bool process_runs(long number);
/// Whether somebody sits at the other end of a stream, and not a file or another program.
[[nodiscard]] VOUSSOIR_INLINE bool is_terminal(std::FILE* stream);
/// Whether files may be made in an existing folder, as far as permissions tell.
[[nodiscard]] VOUSSOIR_INLINE bool may_write_in(const std::filesystem::path& folder);
/// Opens a file for writing that must not exist yet.
/// @return  null, and errno says why
[[nodiscard]] VOUSSOIR_INLINE std::FILE* create_new_file(const std::filesystem::path& path);
/// Opens a file or device for writing from its beginning.
/// @return  null, and errno says why
[[nodiscard]] VOUSSOIR_INLINE std::FILE* open_to_write(const std::filesystem::path& path);
/// A path from its text in UTF-8. (`path(std::string)` is that on POSIX alone: Windows takes the
/// text for one in the letters of the country that it was bought in.)
[[nodiscard]] inline std::filesystem::path utf8_path(std::string_view text) {
  return std::u8string(text.begin(), text.end());
}
/// The text of a path, in UTF-8.
[[nodiscard]] VOUSSOIR_INLINE std::string utf8_text(const std::filesystem::path& path);
/// From now on a write beyond the limit on the size of files (`ulimit -f`) fails, as on a full
/// disk. POSIX ends the process with a signal otherwise, and what it had half written stays.
VOUSSOIR_INLINE void let_writes_beyond_limit_fail();
/// Whether a program of this name lies in a folder of PATH.
[[nodiscard]] VOUSSOIR_INLINE bool finds_program(const std::string& name);
/// Runs a program of PATH to its end; what it prints is not shown.
/// @param words  its name, then what it is given
/// @return  its exit status; -1: it could not be started, or something killed it
[[nodiscard]] VOUSSOIR_INLINE int run_to_its_end(const std::vector<std::string>& words);
/// What `main` was given, the name of the program first, in UTF-8.
[[nodiscard]] VOUSSOIR_INLINE std::vector<std::string> program_arguments(int argc, char** argv);

/// While it lives, standard output and error take bytes as they are: UTF-8, and no carriage return
/// before the end of a line. On POSIX they do so anyway.
class PlainOutput {
 public:
  VOUSSOIR_INLINE PlainOutput();
  VOUSSOIR_INLINE ~PlainOutput();
  PlainOutput(const PlainOutput&) = delete;
  PlainOutput& operator=(const PlainOutput&) = delete;

 private:
  unsigned code_page_ = 0;  ///< of the console before; 0: there is none
};

/// A file open for writing and locked, until it is closed or its process ends in whatever way: no
/// lock outlives its owner. Others may read it meanwhile.
class LockedFile {
 public:
  enum class Mode {
    exclusive,  ///< nobody else holds it
    shared,     ///< with others that share it
  };
  /// Opens an existing file or makes an empty one. Never waits.
  /// @return  nothing if another process holds it
  /// @throws std::runtime_error  it can be neither opened nor made: path and reason
  [[nodiscard]] static VOUSSOIR_INLINE std::optional<LockedFile> open(
      const std::filesystem::path& path, Mode mode = Mode::exclusive);

  LockedFile(LockedFile&& other) noexcept
      : path_(std::move(other.path_)),
        descriptor_(std::exchange(other.descriptor_, -1)),
        is_locked_(other.is_locked_) {}
  LockedFile& operator=(LockedFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    std::swap(is_locked_, other.is_locked_);
    return *this;
  }
  ~LockedFile() { close(); }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// False on a drive that knows no locks, as some network drives: then it is open, and others may
  /// have it open too.
  [[nodiscard]] bool is_locked() const { return is_locked_; }

  /// Puts text behind the last byte: all of it, or, if it throws, none.
  /// @throws std::runtime_error  path and reason: disk full, a limit on file sizes
  VOUSSOIR_INLINE void append(std::string_view text);
  /// Cuts the file off behind so many bytes. @throws std::runtime_error
  VOUSSOIR_INLINE void cut(std::uintmax_t size);
  /// Waits until all that was appended is on the disk, where a power cut leaves it.
  /// @throws std::runtime_error
  VOUSSOIR_INLINE void sync();
  /// Closes it and, if nobody else holds it, removes it.
  VOUSSOIR_INLINE void close_and_remove() noexcept;

 private:
  LockedFile() = default;
  VOUSSOIR_INLINE void close() noexcept;

  std::filesystem::path path_;
  int descriptor_ = -1;  ///< -1: closed
  bool is_locked_ = false;
};

}  // namespace voussoir

#if VOUSSOIR_BODIES

namespace voussoir {

namespace detail {

[[noreturn]] inline void throw_file_error(const char* what, const std::filesystem::path& path,
                                          int error_number) {
  throw std::runtime_error(std::string(what) + " '" + utf8_text(path) +
                           "': " + std::generic_category().message(error_number));
}

/// Letters, digits and hyphens: what names of part files and journals are made of.
inline std::string plain_name(std::string name) {
  for (char& c : name)
    if (!((c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'))) c = '-';
  return name;
}

enum class LockOutcome { locked, held, impossible };

#ifdef _WIN32

inline LockOutcome lock_descriptor(int descriptor, bool exclusive) {
  // Locks of Windows forbid even reading: this one is on a byte far behind the end of the file.
  struct {
    std::uintptr_t internal = 0, internal_high = 0;
    unsigned long offset = 0, offset_high = 0x40000000UL;
    void* event = nullptr;
  } where;
  constexpr unsigned long at_once = 1, alone = 2, lock_violation = 33;
  void* const handle = reinterpret_cast<void*>(_get_osfhandle(descriptor));
  if (LockFileEx(handle, at_once | (exclusive ? alone : 0UL), 0, 1, 0,
                 reinterpret_cast<struct _OVERLAPPED*>(&where)) != 0)
    return LockOutcome::locked;
  return GetLastError() == lock_violation ? LockOutcome::held : LockOutcome::impossible;
}

inline int open_for_writing(const std::filesystem::path& path) {
  int descriptor = -1;
  const int mode = _O_RDWR | _O_CREAT | _O_BINARY | _O_NOINHERIT;
  errno = _wsopen_s(&descriptor, path.c_str(), mode, 0x40 /* share all */, _S_IREAD | _S_IWRITE);
  return descriptor;
}
constexpr char between_folders = ';';  // in PATH
constexpr const char* program_suffix = ".exe";
inline bool is_named(int, const std::filesystem::path&) { return true; }  // cannot be removed
inline std::int64_t end_of(int descriptor) { return _lseeki64(descriptor, 0, SEEK_END); }
inline std::int64_t write_some(int descriptor, const char* text, std::size_t size) {
  return _write(descriptor, text, static_cast<unsigned>(std::min<std::size_t>(size, 1U << 20U)));
}
inline int cut_at(int descriptor, std::int64_t size) { return _chsize_s(descriptor, size); }
inline int synchronise(int descriptor) { return _commit(descriptor) == 0 ? 0 : errno; }
inline void close_descriptor(int descriptor) { _close(descriptor); }

#else

inline LockOutcome lock_descriptor(int descriptor, bool exclusive) {
  if (flock(descriptor, (exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) return LockOutcome::locked;
  return errno == EWOULDBLOCK ? LockOutcome::held : LockOutcome::impossible;
}

constexpr char between_folders = ':';  // in PATH
constexpr const char* program_suffix = "";
inline int open_for_writing(const std::filesystem::path& path) {
  return ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
}
/// Whether the path still leads to the open file: its last owner may have removed it meanwhile.
inline bool is_named(int descriptor, const std::filesystem::path& path) {
  struct stat mine {
  }, named{};
  return fstat(descriptor, &mine) == 0 && stat(path.c_str(), &named) == 0 &&
         mine.st_ino == named.st_ino && mine.st_dev == named.st_dev;
}
inline std::int64_t end_of(int descriptor) { return lseek(descriptor, 0, SEEK_END); }
inline std::int64_t write_some(int descriptor, const char* text, std::size_t size) {
  const ssize_t written = write(descriptor, text, size);
  return written < 0 && errno == EINTR ? 0 : written;
}
inline int cut_at(int descriptor, std::int64_t size) {
  return ftruncate(descriptor, size) == 0 ? 0 : errno;
}
inline int synchronise(int descriptor) {
  // Pipes, and drives that keep no files of their own, have nothing to synchronise.
  return fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
}
inline void close_descriptor(int descriptor) { ::close(descriptor); }

#endif

}  // namespace detail

#ifdef _WIN32

VOUSSOIR_INLINE std::string host_name() {
  const char* const name = std::getenv("COMPUTERNAME");
  return detail::plain_name(name == nullptr ? "" : name);
}
VOUSSOIR_INLINE long process_number() { return _getpid(); }
VOUSSOIR_INLINE bool process_runs(long number) {
  constexpr unsigned long may_ask = 0x1000, is_active = 259, access_denied = 5;
  void* const process = OpenProcess(may_ask, 0, static_cast<unsigned long>(number));
  if (process == nullptr) return GetLastError() == access_denied;
  unsigned long code = 0;
  const bool runs = GetExitCodeProcess(process, &code) != 0 && code == is_active;
  CloseHandle(process);
  return runs;
}
VOUSSOIR_INLINE bool is_terminal(std::FILE* stream) { return _isatty(_fileno(stream)) != 0; }
VOUSSOIR_INLINE bool may_write_in(const std::filesystem::path& folder) {
  return _waccess(folder.c_str(), 2) == 0;
}
VOUSSOIR_INLINE std::FILE* create_new_file(const std::filesystem::path& path) {
  int descriptor = -1;
  const int mode = _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT;
  errno = _wsopen_s(&descriptor, path.c_str(), mode, 0x40 /* share all */, _S_IREAD | _S_IWRITE);
  return descriptor < 0 ? nullptr : _fdopen(descriptor, "wb");
}
VOUSSOIR_INLINE std::FILE* open_to_write(const std::filesystem::path& path) {
  return _wfopen(path.c_str(), L"wb");
}
VOUSSOIR_INLINE void let_writes_beyond_limit_fail() {}  // there is no such limit
VOUSSOIR_INLINE int run_to_its_end(const std::vector<std::string>& words) {
  std::vector<std::wstring> quoted;  // Windows joins them with blanks, and parts them there again
  for (const std::string& word : words) quoted.push_back(L"\"" + utf8_path(word).wstring() + L"\"");
  std::vector<const wchar_t*> arguments;
  for (const std::wstring& word : quoted) arguments.push_back(word.c_str());
  arguments.push_back(nullptr);
  return static_cast<int>(
      _wspawnvp(_P_WAIT, utf8_path(words.at(0)).wstring().c_str(), arguments.data()));
}
VOUSSOIR_INLINE std::vector<std::string> program_arguments(int argc, char** argv) {
  int count = 0;
  wchar_t** const words = CommandLineToArgvW(GetCommandLineW(), &count);
  if (words == nullptr) return {argv, argv + argc};
  std::vector<std::string> arguments;
  for (int k = 0; k < count; ++k) arguments.push_back(utf8_text(words[k]));
  LocalFree(words);
  return arguments;
}
VOUSSOIR_INLINE PlainOutput::PlainOutput() : code_page_(GetConsoleOutputCP()) {
  constexpr unsigned utf8 = 65001;
  for (std::FILE* const stream : {stdout, stderr}) _setmode(_fileno(stream), _O_BINARY);
  if (code_page_ != 0) SetConsoleOutputCP(utf8);
}
VOUSSOIR_INLINE PlainOutput::~PlainOutput() {
  if (code_page_ != 0) SetConsoleOutputCP(code_page_);
}

#else

VOUSSOIR_INLINE std::string host_name() {
  char name[256] = {};
  if (gethostname(name, sizeof name - 1) != 0) return "";
  return detail::plain_name(name);
}
VOUSSOIR_INLINE long process_number() { return getpid(); }
VOUSSOIR_INLINE bool process_runs(long number) {
  return number > 0 && number <= std::numeric_limits<pid_t>::max() &&
         (kill(static_cast<pid_t>(number), 0) == 0 || errno == EPERM);
}
VOUSSOIR_INLINE bool is_terminal(std::FILE* stream) { return isatty(fileno(stream)) != 0; }
VOUSSOIR_INLINE bool may_write_in(const std::filesystem::path& folder) {
  return access(folder.c_str(), W_OK | X_OK) == 0;
}
VOUSSOIR_INLINE std::FILE* create_new_file(const std::filesystem::path& path) {
  return std::fopen(path.c_str(), "wbx");
}
VOUSSOIR_INLINE std::FILE* open_to_write(const std::filesystem::path& path) {
  return std::fopen(path.c_str(), "wb");
}
VOUSSOIR_INLINE void let_writes_beyond_limit_fail() { (void)signal(SIGXFSZ, SIG_IGN); }
VOUSSOIR_INLINE int run_to_its_end(const std::vector<std::string>& words) {
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  pid_t process = -1;
  const int failed =
      posix_spawnp(&process, arguments.at(0), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (failed != 0) return -1;
  while (waitpid(process, &status, 0) != process)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}
VOUSSOIR_INLINE std::vector<std::string> program_arguments(int argc, char** argv) {
  return {argv, argv + argc};
}
VOUSSOIR_INLINE PlainOutput::PlainOutput() = default;
VOUSSOIR_INLINE PlainOutput::~PlainOutput() { (void)code_page_; }

#endif

VOUSSOIR_INLINE std::string utf8_text(const std::filesystem::path& path) {
  const std::u8string text = path.u8string();
  return {text.begin(), text.end()};
}

VOUSSOIR_INLINE bool finds_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::string_view rest = path == nullptr ? "" : path;
  std::error_code ignored;  // what cannot be looked at is not there
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(detail::between_folders), rest.size());
    const auto file = utf8_path(rest.substr(0, end)) / (name + detail::program_suffix);
    if (end > 0 && std::filesystem::is_regular_file(file, ignored)) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

VOUSSOIR_INLINE std::optional<LockedFile> LockedFile::open(const std::filesystem::path& path,
                                                           Mode mode) {
  while (true) {
    LockedFile file;
    file.path_ = path;
    file.descriptor_ = detail::open_for_writing(path);
    if (file.descriptor_ < 0) detail::throw_file_error("cannot open", path, errno);
    const auto outcome = detail::lock_descriptor(file.descriptor_, mode == Mode::exclusive);
    if (outcome == detail::LockOutcome::held) return std::nullopt;
    file.is_locked_ = outcome == detail::LockOutcome::locked;
    if (!file.is_locked_ || detail::is_named(file.descriptor_, path))
      return std::optional<LockedFile>(std::move(file));
  }
}

VOUSSOIR_INLINE void LockedFile::append(std::string_view text) {
  const std::int64_t before = detail::end_of(descriptor_);
  int reason = before < 0 ? errno : 0;
  while (reason == 0 && !text.empty()) {
    errno = 0;
    const std::int64_t written = detail::write_some(descriptor_, text.data(), text.size());
    if (written < 0)
      reason = errno != 0 ? errno : EIO;
    else
      text.remove_prefix(static_cast<std::size_t>(written));
  }
  if (reason == 0) return;
  if (before >= 0) (void)detail::cut_at(descriptor_, before);
  detail::throw_file_error("cannot write", path_, reason);
}

VOUSSOIR_INLINE void LockedFile::cut(std::uintmax_t size) {
  if (const int reason = detail::cut_at(descriptor_, static_cast<std::int64_t>(size)); reason != 0)
    detail::throw_file_error("cannot write", path_, reason);
}

VOUSSOIR_INLINE void LockedFile::sync() {
  if (const int reason = detail::synchronise(descriptor_); reason != 0)
    detail::throw_file_error("cannot write", path_, reason);
}

VOUSSOIR_INLINE void LockedFile::close() noexcept {
  if (descriptor_ >= 0) detail::close_descriptor(std::exchange(descriptor_, -1));
}

VOUSSOIR_INLINE void LockedFile::close_and_remove() noexcept {
  if (descriptor_ < 0) return;
  std::error_code ignored;  // nothing left to tell it to
#ifdef _WIN32
  // Windows removes no file that is open, here or elsewhere. (Nor would it lock this one a second
  // time, to see whether others hold it: not even for the process that has locked it.)
  close();
  std::filesystem::remove(path_, ignored);
#else
  // While it is still locked, and by nobody else: a file that others hold is theirs to remove.
  const bool is_sole =
      !is_locked_ || detail::lock_descriptor(descriptor_, true) == detail::LockOutcome::locked;
  if (is_sole) std::filesystem::remove(path_, ignored);
  close();
#endif
}

}  // namespace voussoir

#endif
