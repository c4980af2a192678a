// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>
#include <voussoir/core/random.hpp>
#include <voussoir/io/journal.hpp>

namespace journal_test {

using namespace voussoir;
namespace fs = std::filesystem;

namespace {

/// A path of this test's own, removed at the end.
struct Scratch {
  fs::path path;
  explicit Scratch(const std::string& name)
      : path(fs::temp_directory_path() /
             ("voussoir-" + name + "-" + std::to_string(process_number()) + ".jsonl")) {
    fs::remove(path);
  }
  ~Scratch() { fs::remove(path); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] std::string text() const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::string& text) const {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
  }
};

constexpr const char* header = "\"of\":\"a test\"";

void fill(const Scratch& scratch, int cases) {
  auto journal = Journal::open(scratch.path, header);
  REQUIRE(journal);
  for (int k = 0; k < cases; ++k)
    journal->add({"c" + std::to_string(k), "\"result\":" + std::to_string(10 * k)});
}

}  // namespace

TEST_SUITE("io/journal") {
  TEST_CASE("what was added is read back, by another opening and while it is open") {
    const Scratch scratch("journal");
    CHECK_FALSE(read_journal(scratch.path));
    fill(scratch, 2);
    auto journal = Journal::open(scratch.path, header);
    REQUIRE(journal);
    journal->add({"c2", "\"result\":20"});
    const auto text = read_journal(scratch.path);
    REQUIRE(text);
    CHECK(text->header == header);
    REQUIRE(text->entries.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(text->entries[k].name == "c" + std::to_string(k));
      CHECK(text->entries[k].fields == "\"result\":" + std::to_string(10 * k));
    }
    CHECK(text->torn_bytes == 0);
    CHECK(text->damaged_lines.empty());
  }

  TEST_CASE("cut off anywhere, a journal keeps every whole line and goes on behind the last") {
    const Scratch whole("journal-whole"), torn("journal-torn");
    fill(whole, 4);
    const std::string text = whole.text();
    std::vector<std::size_t> ends;  // behind each line break
    for (std::size_t k = 0; k < text.size(); ++k)
      if (text[k] == '\n') ends.push_back(k + 1);
    REQUIRE(ends.size() == 5);
    for (std::size_t size = 0; size <= text.size(); ++size) {
      torn.write(text.substr(0, size));
      std::size_t lines = 0;
      while (lines < ends.size() && ends[lines] <= size) ++lines;
      const auto before = read_journal(torn.path);
      CHECK(before.has_value() == (lines > 0));
      if (before) CHECK(before->entries.size() == lines - 1);
      auto journal = Journal::open(torn.path, header);
      REQUIRE(journal);
      journal->add({"next", ""});
      const auto after = read_journal(torn.path);
      REQUIRE(after);
      CHECK(after->entries.size() == (lines == 0 ? 1 : lines));
      CHECK(after->entries.back().name == "next");
      CHECK(after->torn_bytes == 0);
      CHECK(after->damaged_lines.empty());
    }
  }

  TEST_CASE("a bit turned anywhere in a line is noticed, and costs that line alone") {
    const Scratch scratch("journal-bits");
    fill(scratch, 3);
    const std::string text = scratch.text();
    const std::size_t first = text.find('\n') + 1;
    Random random(1);
    for (int k = 0; k < 300; ++k) {
      std::string damaged = text;
      const auto at = first + static_cast<std::size_t>(random.uniform() *
                                                       static_cast<double>(text.size() - first));
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << static_cast<int>(8 * random.uniform())));
      scratch.write(damaged);
      const auto read = read_journal(scratch.path);
      REQUIRE(read);
      const bool is_break = text[at] == '\n' || damaged[at] == '\n';
      // A line break more or less makes two lines of one, or one of two.
      CHECK(read->entries.size() >= (is_break ? 1 : 2));
      CHECK(read->entries.size() < 3);
      CHECK(read->damaged_lines.size() + (read->torn_bytes > 0 ? 1 : 0) >= 1);
      for (const JournalEntry& entry : read->entries)
        CHECK(text.find("{\"case\":\"" + entry.name + "\"") != std::string::npos);
    }
  }

  TEST_CASE("one writer at a time; other work and other files are refused") {
    const Scratch scratch("journal-two");
    {
      auto first = Journal::open(scratch.path, header);
      REQUIRE(first);
      if (first->is_locked()) CHECK_FALSE(Journal::open(scratch.path, header));
      first->add({"c0", ""});
    }
    CHECK(Journal::open(scratch.path, header));
    CHECK_THROWS_WITH_AS((void)Journal::open(scratch.path, "\"of\":\"other\""),
                         doctest::Contains("is the journal of other work: {\"of\":\"a test\"}"),
                         std::runtime_error);
    scratch.write("{\"journal\":2}\n");
    CHECK_THROWS_WITH_AS((void)read_journal(scratch.path),
                         doctest::Contains("is no journal of this version"), std::runtime_error);
    scratch.write("bolt,force\n1,2\n");
    CHECK_THROWS_WITH_AS((void)Journal::open(scratch.path, header),
                         doctest::Contains("`bolt,force`"), std::runtime_error);
    CHECK(scratch.text() == "bolt,force\n1,2\n");  // and left as it was
    CHECK_THROWS_WITH_AS((void)Journal::open(scratch.path / "below" / "x.jsonl", header),
                         doctest::Contains("cannot open"), std::runtime_error);
  }

  TEST_CASE("a shared lock is held by many, an exclusive one by one") {
    const Scratch scratch("lock");
    using Mode = LockedFile::Mode;
    auto one = LockedFile::open(scratch.path, Mode::shared);
    REQUIRE(one);
    if (!one->is_locked()) return;  // a drive without locks: nothing to test
    CHECK(LockedFile::open(scratch.path, Mode::shared));
    CHECK_FALSE(LockedFile::open(scratch.path, Mode::exclusive));
    one.reset();
    auto alone = LockedFile::open(scratch.path, Mode::exclusive);
    REQUIRE(alone);
    CHECK_FALSE(LockedFile::open(scratch.path, Mode::shared));
    alone->append("text");
    alone->close_and_remove();
    CHECK_FALSE(fs::exists(scratch.path));
  }

  TEST_CASE("hashes of FNV-1a are those of its authors") {
    // Known answers of the 64-bit variant: Fowler, Noll and Vo, test suite of the reference code.
    CHECK(text_hash("") == "cbf29ce484222325");
    CHECK(text_hash("a") == "af63dc4c8601ec8c");
    CHECK(text_hash("foobar") == "85944171f73967e8");
  }
}

}  // namespace journal_test
