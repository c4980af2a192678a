// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <clocale>
#include <cstddef>
#include <sstream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/rockmass/trace_file.hpp>

namespace trace_file_test {

using namespace voussoir;

namespace {

std::vector<Joint> read(const std::string& text, const Vec2& origin = Vec2::Zero(),
                        const TraceFileLimits& limits = {}) {
  std::istringstream in(text);
  return read_traces(in, "map.csv", origin, limits);
}

std::string refusal(const std::string& text, const TraceFileLimits& limits = {}) {
  try {
    (void)read(text, Vec2::Zero(), limits);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("rockmass/trace_file") {
  TEST_CASE("traces come in the order of the file, with their set or -1") {
    const auto joints = read("1,2,3,4\n-1.5,2e1,3.25,-4e-1,7\n0,0,0,1,0\n");
    REQUIRE(joints.size() == 3);
    CHECK(joints[0].trace.start == Vec2(1, 2));
    CHECK(joints[0].trace.end == Vec2(3, 4));
    CHECK(joints[0].set == -1);
    CHECK(joints[1].trace.start == Vec2(-1.5, 20));
    CHECK(joints[1].trace.end == Vec2(3.25, -0.4));
    CHECK(joints[1].set == 7);
    CHECK(joints[2].set == 0);
  }

  TEST_CASE(
      "however the file was written: header, comments, BOM, LF, CR LF, CR, blanks, no last end") {
    for (const char* text : {
             "x1,y1,x2,y2\n1,2,3,4\n5,6,7,8\n", "x1,y1,x2,y2,set\n1,2,3,4\n5,6,7,8",
             "\xEF\xBB\xBFx1,y1,x2,y2\r\n1,2,3,4\r\n5,6,7,8\r\n",
             "\xEF\xBB\xBF"
             "1,2,3,4\n5,6,7,8\n",
             "# north wall\n1,2,3,4\n\n#5,5,5,5\n   \n5,6,7,8\n\n",
             " 1 , 2 ,3, 4 \r\n\r\n5,6 ,7,8  \n",
             "1,2,3,4\r5,6,7,8\r",  // a classic Mac's
             "x1,y1,x2,y2\r# wall\r\r1,2,3,4\r\r5,6,7,8",
             "\xEF\xBB\xBFx1,y1,x2,y2\r1,2,3,4\n5,6,7,8\r\n",  // all of them
         }) {
      CAPTURE(text);
      const auto joints = read(text);
      REQUIRE(joints.size() == 2);
      CHECK(joints[0].trace.start == Vec2(1, 2));
      CHECK(joints[0].trace.end == Vec2(3, 4));
      CHECK(joints[1].trace.start == Vec2(5, 6));
      CHECK(joints[1].trace.end == Vec2(7, 8));
    }
  }

  TEST_CASE("a file without a trace is refused, whatever else it holds") {
    CHECK(contains(refusal(""),
                   "map.csv: holds no trace: it is empty; accepted: one trace per line"));
    const std::string comments = refusal("x1,y1,x2,y2\n# none mapped\n\n");
    CHECK(contains(comments, "map.csv: holds no trace: 3 lines, all empty, header or comment"));
    CHECK(contains(refusal("\r\r\n\n"), "holds no trace: 3 lines"));
  }

  TEST_CASE("lines are counted alike however they end, so that a message names the right one") {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      const std::string message =
          refusal("x1,y1,x2,y2" + end + end + "1,2,3,4" + end + "1,2,3" + end);
      CHECK(contains(message, "map.csv:4: 3 fields instead of 4 or 5 in \"1,2,3\""));
    }
  }

  TEST_CASE("a set that the model does not have is refused by line, number and range") {
    const std::string text = "0,0,1,1,2\n0,0,1,1,3\n";
    CHECK(read(text, Vec2::Zero(), {.sets = 4}).size() == 2);
    CHECK(read(text).size() == 2);  // who does not say how many sets there are takes any
    const std::string message = refusal(text, {.sets = 3});
    CHECK(contains(message, "map.csv:2: there is no joint set 3 in \"0,0,1,1,3\""));
    CHECK(
        contains(message, "accepted: as set number 0 to 2 (joint sets, counted from 0), or none"));
    CHECK(contains(refusal(text, {.sets = 1}), "map.csv:1: there is no joint set 2"));
    CHECK(contains(refusal(text, {.sets = 0}), "none, as there is no joint set to name"));
    CHECK(refusal("0,0,1,1\n", {.sets = 0}) == "accepted");
  }

  TEST_CASE("a source that never ends is refused by its lines, its traces or its bytes") {
    /// Gives `text` again and again, as a device or a pipe does.
    struct Endless : std::streambuf {
      explicit Endless(std::string given) : text(std::move(given)) {
        while (text.size() < 10000) text += text;
      }
      int_type underflow() override {
        setg(text.data(), text.data(), text.data() + text.size());
        return traits_type::to_int_type(text.front());
      }
      std::string text;
    };
    const auto refused = [](const std::string& text, const TraceFileLimits& limits) {
      Endless buffer(text);
      std::istream in(&buffer);
      try {
        (void)read_traces(in, "map.csv", Vec2::Zero(), limits);
      } catch (const InvalidInput& error) {
        return std::string(error.what());
      }
      return std::string();
    };
    CHECK(contains(refused(std::string(1, '\0'), {}),
                   "map.csv:1: a line of more than 1000 characters, beginning with \"??"));
    CHECK(contains(refused("0,0,1,1\n", {.traces = 500}),
                   "map.csv:501: trace number 501 in \"0,0,1,1\"; accepted: at most 500 traces"));
    CHECK(contains(refused("# nothing\n", {.bytes = 100000}),
                   "map.csv: more than 100000 bytes; accepted"));
    CHECK(contains(refused("\n", {}), "more than 256000000 bytes"));
  }

  TEST_CASE("reading ends when told to, within the file and within a line") {
    std::string text;
    for (int k = 0; k < 900000; ++k) text += "0,0,1,1\n";
    int asked = 0;
    const Progress stop = [&](double) { return ++asked < 2; };
    std::istringstream in(text);
    CHECK_THROWS_AS((void)read_traces(in, "map.csv", Vec2::Zero(), {}, stop), Stopped);
    CHECK(asked == 2);
  }

  TEST_CASE("site coordinates are taken relative to the origin, to the last digit") {
    const auto joints = read("621000.25,5140000.5,621003.75,5139998.125,2\n", {621000, 5140000});
    REQUIRE(joints.size() == 1);
    CHECK(joints[0].trace.start == Vec2(0.25, 0.5));  // all exact in binary
    CHECK(joints[0].trace.end == Vec2(3.75, -1.875));
    CHECK(joints[0].set == 2);
  }

  TEST_CASE("a broken line is refused with file, line, the reason and the line itself") {
    struct Case {
      const char* line;
      const char* reason;
    };
    for (const Case& broken : {
             Case{"1,2,3", "3 fields instead of 4 or 5"},
             Case{"1,2,3,4,5,6", "6 fields instead of 4 or 5"},
             Case{"1", "1 fields instead of 4 or 5"},
             Case{"1,2,,4", "field 3 is not a finite number"},
             Case{"1,2,3,", "field 4 is not a finite number"},
             Case{",2,3,4", "field 1 is not a finite number"},
             Case{"1,two,3,4", "field 2 is not a finite number"},
             Case{"1,2,3 m,4", "field 3 is not a finite number"},
             Case{"1;2;3;4", "field 1 is not a finite number"},
             Case{"1,2,nan,4", "field 3 is not a finite number"},
             Case{"inf,2,3,4", "field 1 is not a finite number"},
             Case{"1,2,3,1e999", "field 4 is not a finite number"},
             Case{"1,2,3,0x10", "field 4 is not a finite number"},
             Case{"1,2,1,2", "a trace of zero length"},
             Case{"1,2,3,4,-1", "the set is not a whole number >= 0"},
             Case{"1,2,3,4,0.5", "the set is not a whole number >= 0"},
             Case{"1,2,3,4,1e9", "the set is not a whole number >= 0"},
             Case{"x1,y1,x2,y2", "field 1 is not a finite number"},  // a header further down
         }) {
      const std::string line = broken.line;
      CAPTURE(line);
      // The third line of the file, after a comment: comments count as lines.
      const std::string message = refusal("# comment\n1,2,3,4\n" + line + "\n5,6,7,8\n");
      CAPTURE(message);
      CHECK(message.rfind("map.csv:3: ", 0) == 0);
      CHECK(contains(message, broken.reason));
      CHECK(contains(message, "\"" + line + "\""));
      CHECK(contains(message, "accepted: x1,y1,x2,y2[,set]"));
    }
    CHECK(refusal("1,2\n").rfind("map.csv:1: ", 0) == 0);
  }

  TEST_CASE("a broken line that ends in CRLF, or holds a control character, is echoed clean") {
    const std::string message = refusal("1,2,3\r\n");
    CHECK(contains(message, "\"1,2,3\""));
    CHECK(message.find('\r') == std::string::npos);
    CHECK(refusal("1,2,\x1b[31m3\n").find('\x1b') == std::string::npos);
    CHECK(refusal("1,2," + std::string(100000, '3') + "x\n").size() < 1000);
  }

  TEST_CASE("the decimal sign is a point under a locale that writes a comma") {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    // Not every machine has one of these; the test then says nothing.
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
      if (std::setlocale(LC_ALL, name) != nullptr) break;
    CHECK(read("1.5,2.5,3.5,4.5\n").at(0).trace.start == Vec2(1.5, 2.5));
    std::setlocale(LC_ALL, before.c_str());
  }

  TEST_CASE("a stream that fails is reported, not taken for a short file") {
    struct Broken : std::streambuf {
      int_type underflow() override { throw 1; }
    } buffer;
    std::istream in(&buffer);
    CHECK_THROWS_WITH_AS((void)read_traces(in, "map.csv"), "map.csv: cannot be read", InvalidInput);
  }
}

}  // namespace trace_file_test
