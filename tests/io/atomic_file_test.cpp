// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <voussoir/io/atomic_file.hpp>

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace atomic_file_test {
#define VOUSSOIR_TEST_HAS_FILE_LIMIT 1
#endif

using namespace voussoir;
namespace fs = std::filesystem;

namespace {

/// A folder of one test, gone afterwards.
class Folder {
 public:
  Folder()
      : path_(fs::temp_directory_path() /
              ("voussoir-test-" + std::to_string(std::random_device{}()))) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path operator/(const std::string& name) const { return path_ / name; }
  /// Hidden temporaries count too.
  std::ptrdiff_t file_count() const {
    return std::distance(fs::directory_iterator(path_), fs::directory_iterator());
  }

 private:
  fs::path path_;
};

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("io/atomic_file") {
  TEST_CASE("content is written byte for byte and replaces an older file") {
    const Folder folder;
    const std::string bytes("line\nwith zero \0 and \r\n", 23);
    write_atomically(folder / "a b \xC3\xA9.txt", "older and longer than the new one by far");
    write_atomically(folder / "a b \xC3\xA9.txt", bytes);
    CHECK(content_of(folder / "a b \xC3\xA9.txt") == bytes);
    write_atomically(folder / "empty", "");
    CHECK(fs::file_size(folder / "empty") == 0);
    CHECK(folder.file_count() == 2);
  }

  TEST_CASE("errors name the path and the reason") {
    const Folder folder;
    const std::string missing = message_of([&] { write_atomically(folder / "no/such/f", "x"); });
    CHECK(contains(missing, "no/such/f"));
    CHECK(contains(missing, "No such file"));
    fs::create_directory(folder / "d");
    CHECK(contains(message_of([&] { write_atomically(folder / "d", "x"); }), "folder"));
    CHECK(contains(message_of([&] { write_atomically((folder / "d") / "", "x"); }), "folder"));
    write_atomically(folder / "f", "x");
    CHECK(contains(message_of([&] { write_atomically((folder / "f") / "g", "x"); }), "Not a dir"));
    CHECK(content_of(folder / "f") == "x");
  }

  TEST_CASE("a full device is noticed and is not replaced by a file") {
    if (!fs::is_character_file("/dev/full")) return;
    CHECK(contains(message_of([] { write_atomically("/dev/full", "x"); }), "No space"));
    CHECK(fs::is_character_file("/dev/full"));
    write_atomically("/dev/null", "x");
    CHECK(fs::is_character_file("/dev/null"));
  }

  TEST_CASE("a link stays a link") {
    const Folder folder;
    write_atomically(folder / "real", "old");
    std::error_code failure;
    fs::create_symlink(folder / "real", folder / "link", failure);
    if (failure) return;  // a system without links
    write_atomically(folder / "link", "new");
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(content_of(folder / "real") == "new");
  }

#ifdef VOUSSOIR_TEST_HAS_FILE_LIMIT
  TEST_CASE("a write that breaks off leaves the old file and no temporary") {
    // A limit of the file size breaks off half-way, as a full disk does.
    const Folder folder;
    write_atomically(folder / "f", "old");
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before;
    small.rlim_cur = 5000;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
    const std::string message =
        message_of([&] { write_atomically(folder / "f", std::string(100000, 'x')); });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    CHECK(contains(message, "too large"));
    CHECK(content_of(folder / "f") == "old");
    CHECK(folder.file_count() == 1);
  }
#endif

  TEST_CASE("a read-only folder is refused") {
    const Folder folder;
    fs::create_directory(folder / "closed");
    fs::permissions(folder / "closed", fs::perms::owner_read | fs::perms::owner_exec);
    if (!std::ofstream((folder / "closed") / "probe")) {  // the superuser writes anywhere
      const std::string message =
          message_of([&] { write_atomically((folder / "closed") / "f", "x"); });
      CHECK(contains(message, "denied"));
    }
    fs::permissions(folder / "closed", fs::perms::owner_all);
  }

  TEST_CASE("a set appears as a whole or not at all") {
    const Folder folder;
    write_atomically(folder / "a", "old");
    {
      OutputSet outputs;
      outputs.add(folder / "a", "new");
      outputs.add(folder / "b", "new");
      CHECK(content_of(folder / "a") == "old");
      CHECK_THROWS_AS(outputs.add(folder / "no/such/c", "new"), std::runtime_error);
    }  // given up
    CHECK(content_of(folder / "a") == "old");
    CHECK(folder.file_count() == 1);

    OutputSet outputs;
    outputs.add(folder / "a", "new");
    outputs.add(folder / "b", "new");
    CHECK_THROWS_AS(outputs.add(folder / "./b", "again"), std::invalid_argument);
    outputs.publish();
    CHECK(content_of(folder / "a") == "new");
    CHECK(content_of(folder / "b") == "new");
    CHECK(folder.file_count() == 2);
    CHECK(outputs.size() == 0);
  }

#ifdef VOUSSOIR_TEST_HAS_FILE_LIMIT
  TEST_CASE("what a killed process left is cleared, what a living one stages is not") {
    const Folder folder;
    const pid_t child = fork();
    if (child == 0) {
      try {
        const StagedFile staged(folder / "a", "never published");
        raise(SIGKILL);
      } catch (...) {
      }
      _exit(1);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    CHECK(folder.file_count() == 1);  // the hidden part
    StagedFile staged(folder / "b", "mine");
    CHECK(folder.file_count() == 2);
    CHECK(clear_abandoned_parts(folder / ".") == 1);
    CHECK(folder.file_count() == 1);
    staged.publish();
    CHECK(content_of(folder / "b") == "mine");
    CHECK(clear_abandoned_parts(folder / ".") == 0);
    CHECK(clear_abandoned_parts(folder / "no such folder") == 0);
  }
#endif

  TEST_CASE("a rename that fails leaves no temporary") {
    const Folder folder;
    OutputSet outputs;
    outputs.add(folder / "a", "new");
    outputs.add(folder / "b", "new");
    fs::create_directories(folder / "b" / "in the way");  // after the check, as another run might
    CHECK(contains(message_of([&] { outputs.publish(); }), "'" + (folder / "b").string() + "'"));
    CHECK(content_of(folder / "a") == "new");
    CHECK(folder.file_count() == 2);
  }
}

}  // namespace atomic_file_test
