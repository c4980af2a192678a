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

std::vector<MappedTrace> read(const std::string& text, const Vec2& origin = Vec2::Zero(),
                              const TraceFileLimits& limits = {}) {
  std::istringstream in(text);
  return read_traces(in, "map.csv", origin, limits).traces;
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

/// A text of ASCII in UTF-16.
std::string wide(const std::string& text, bool is_big, bool has_mark) {
  std::string out;
  if (has_mark) out = is_big ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) {
    if (is_big) out += '\0';
    out += c;
    if (!is_big) out += '\0';
  }
  return out;
}

}  // namespace

TEST_SUITE("rockmass/trace_file") {
  TEST_CASE("traces come in the order of the file, with their set or -1") {
    const auto joints = read("1,2,3,4\n-1.5,2e1,3.25,-4e-1,7\n0,0,0,1,0\n");
    REQUIRE(joints.size() == 3);
    CHECK(joints[0].points.front() == Vec2(1, 2));
    CHECK(joints[0].points.back() == Vec2(3, 4));
    CHECK(joints[0].set == -1);
    CHECK(joints[1].points.front() == Vec2(-1.5, 20));
    CHECK(joints[1].points.back() == Vec2(3.25, -0.4));
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
      CHECK(joints[0].points.front() == Vec2(1, 2));
      CHECK(joints[0].points.back() == Vec2(3, 4));
      CHECK(joints[1].points.front() == Vec2(5, 6));
      CHECK(joints[1].points.back() == Vec2(7, 8));
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
      CHECK(contains(message, "map.csv:4: 3 fields instead of 4 in \"1,2,3\""));
    }
  }

  TEST_CASE("a set that the model does not have is refused by line, number and range") {
    const std::string text = "0,0,1,1,2\n0,0,1,1,3\n";
    CHECK(read(text, Vec2::Zero(), {.sets = 4, .first_set = 0}).size() == 2);
    CHECK(read(text).size() == 2);  // who does not say how many sets there are takes any
    const std::string message = refusal(text, {.sets = 3, .first_set = 0});
    CHECK(contains(message, "map.csv:2: there is no joint set 3 in \"trace from (0, 0)\""));
    CHECK(
        contains(message, "accepted: as set number 0 to 2 (joint sets, counted from 0), or none"));
    CHECK(
        contains(refusal(text, {.sets = 1, .first_set = 0}), "map.csv:1: there is no joint set 2"));
    CHECK(contains(refusal(text, {.sets = 0}),
                   "as set number none, for the model has no joint sets: define one"));
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
    CHECK(
        contains(refused(std::string(1, '\0'), {}), "map.csv:1: holds a byte 0: this is no text"));
    CHECK(contains(refused("1", {.line_length = 1000}),
                   "map.csv:1: a line of more than 1000 characters, beginning with \"1111"));
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
    CHECK(joints[0].points.front() == Vec2(0.25, 0.5));  // all exact in binary
    CHECK(joints[0].points.back() == Vec2(3.75, -1.875));
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
             Case{"1,2,,4", "field 3 (column 5, \"\") is empty: is not a finite number"},
             Case{"1,2,3,", "field 4 (column 7, \"\") is empty"},
             Case{",2,3,4", "field 1 (column 1, \"\") is empty"},
             Case{"1,two,3,4", "field 2 (column 3, \"two\") is not a finite number"},
             Case{"1,2,3 m,4",
                  "field 3 (column 5, \"3 m\") is not a finite number: a unit belongs"},
             Case{"1;2;3;4", "1 fields instead of 4 or 5: this line is separated otherwise"},
             Case{"1,2,nan,4", "is not a finite number but a word for none: leave the row out"},
             Case{"inf,2,3,4", "is not a finite number but a word for none"},
             Case{"1,#N/A,3,4", "is not a finite number but a word for none"},
             Case{"1,2,3,1e999", "field 4 (column 7, \"1e999\") is not a finite number"},
             Case{"1,2,3,0x10", "field 4 (column 7, \"0x10\") is not a finite number"},
             Case{"1,2,3,4e9", "field 4 (column 7, \"4e9\") is out of range"},
             Case{"1,5,2,5,3,5,4,5", "8 fields instead of 4 or 5: are these decimal commas?"},
             Case{"1,2,3'000.5,4", "thousands are grouped"},
             Case{"1,2,1,2", "a trace of zero length"},
             Case{"1,2,3,4,-1", "the set is not a whole number >= 0"},
             Case{"1,2,3,4,0.5", "the set is not a whole number >= 0"},
             Case{"1,2,3,4,1e9", "the set is not a whole number >= 0"},
             Case{"x1,y1,x2,y2", "field 1 (column 1, \"x1\") is not a finite"},  // a header below
         }) {
      const std::string line = broken.line;
      CAPTURE(line);
      // The third line of the file, after a comment: comments count as lines.
      const std::string message = refusal("# comment\n1,2,3,4\n" + line + "\n5,6,7,8\n");
      CAPTURE(message);
      CHECK(message.rfind("map.csv:3: ", 0) == 0);
      CHECK(contains(message, broken.reason));
      CHECK(contains(message, "\"" + line + "\""));
      CHECK(contains(message, "accepted: "));
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
    CHECK(read("1.5,2.5,3.5,4.5\n").at(0).points.front() == Vec2(1.5, 2.5));
    std::setlocale(LC_ALL, before.c_str());
  }

  TEST_CASE("a stream that fails is reported, not taken for a short file") {
    struct Broken : std::streambuf {
      int_type underflow() override { throw 1; }
    } buffer;
    std::istream in(&buffer);
    CHECK_THROWS_WITH_AS((void)read_traces(in, "map.csv"), "map.csv: cannot be read", InvalidInput);
  }
  TEST_CASE("the forms in which programs export the same two traces are read") {
    struct Form {
      const char* what;
      std::string text;
    };
    const std::string plain = "x1,y1,x2,y2,set\n1.5,2,3,4,0\n5,6,7,8,1\n";
    const std::vector<Form> forms = {
        {"plain", plain},
        {"no header", "1.5,2,3,4,0\n5,6,7,8,1\n"},
        {"semicolons", "x1;y1;x2;y2;set\n1.5;2;3;4;0\n5;6;7;8;1\n"},
        {"semicolons, decimal comma", "x1;y1;x2;y2;set\n1,5;2,0;3,0;4,0;0\n5;6;7;8;1\n"},
        {"semicolons, decimal comma, no header", "1,5;2,0;3,0;4,0;0\n5;6;7;8;1\n"},
        {"tabs", "x1\ty1\tx2\ty2\tset\n1.5\t2\t3\t4\t0\n5\t6\t7\t8\t1\n"},
        {"tabs, decimal comma", "x1\ty1\tx2\ty2\tset\n1,5\t2\t3\t4\t0\n5\t6\t7\t8\t1\n"},
        {"blanks", "x1 y1 x2 y2 set\n1.5 2 3 4 0\n5 6 7 8 1\n"},
        {"blanks in columns", "   1.5   2.0  3.0  4.0  0\n   5.0   6.0  7.0  8.0  1\n"},
        {"blanks, decimal comma", "1,5 2,0 3,0 4,0 0\n5,0 6,0 7,0 8,0 1\n"},
        {"bars", "x1|y1|x2|y2|set\n1.5|2|3|4|0\n5|6|7|8|1\n"},
        {"comma and blank", "x1, y1, x2, y2, set\n1.5, 2, 3, 4, 0\n5, 6, 7, 8, 1\n"},
        {"quotes",
         "\"x1\",\"y1\",\"x2\",\"y2\",\"set\"\n\"1.5\",\"2\",\"3\",\"4\",\"0\"\n"
         "\"5\",\"6\",\"7\",\"8\",\"1\"\n"},
        {"quoted decimal comma", "\"1,5\",\"2,0\",\"3,0\",\"4,0\",0\n\"5\",\"6\",\"7\",\"8\",1\n"},
        {"counted from 0", "x0,y0,x1,y1,set\n1.5,2,3,4,0\n5,6,7,8,1\n"},
        {"counted from 0, the end first", "x1,y1,x0,y0,set\n3,4,1.5,2,0\n7,8,5,6,1\n"},
        {"capitals", "X1,Y1,X2,Y2,SET\n1.5,2,3,4,0\n5,6,7,8,1\n"},
        {"units", "X1 [m],Y1 [m],X2 [m],Y2 [m],Set\n1.5,2,3,4,0\n5,6,7,8,1\n"},
        {"units in blanks", "x1 [m] y1 [m] x2 [m] y2 [m] set\n1.5 2 3 4 0\n5 6 7 8 1\n"},
        {"millimetres",
         "x1 (mm),y1 (mm),x2 (mm),y2 (mm),set\n1500,2000,3000,4000,0\n"
         "5000,6000,7000,8000,1\n"},
        {"kilometres",
         "x1_km;y1_km;x2_km;y2_km;set\n0,0015;0,002;0,003;0,004;0\n"
         "0,005;0,006;0,007;0,008;1\n"},
        {"another order", "set,x1,x2,y1,y2\n0,1.5,3,2,4\n1,5,7,6,8\n"},
        {"other columns",
         "FID,name,x1,y1,x2,y2,set,length\n1,a,1.5,2,3,4,0,2.5\n"
         "2,b,5,6,7,8,1,2.8\n"},
        {"east and north",
         "Easting_start;Northing_start;Easting_end;Northing_end;Set\n"
         "1.5;2;3;4;0\n5;6;7;8;1\n"},
        {"after a comment", "# north wall\n# 3 May\nx1,y1,x2,y2,set\n1.5,2,3,4,0\n5,6,7,8,1\n"},
        {"after a title",
         "Trace map of the north wall\n\nx1,y1,x2,y2,set\n1.5,2,3,4,0\n"
         "5,6,7,8,1\n"},
        {"sep=", "sep=;\nx1;y1;x2;y2;set\n1,5;2;3;4;0\n5;6;7;8;1\n"},
        {"mark of UTF-8", "\xEF\xBB\xBF" + plain},
        {"UTF-16, little", wide(plain, false, true)},
        {"UTF-16, big", wide(plain, true, true)},
        {"UTF-16 without a mark", wide(plain, false, false)},
        {"CR LF", "x1,y1,x2,y2,set\r\n1.5,2,3,4,0\r\n5,6,7,8,1\r\n"},
        {"leading +", "x1,y1,x2,y2,set\n+1.5,+2,+3,+4,0\n5,6,7,8,1\n"},
        {"trailing commas", "x1,y1,x2,y2,set,\n1.5,2,3,4,0,\n5,6,7,8,1,,,\n"},
        {"trailing semicolons", "1,5;2;3;4;0;\n5;6;7;8;1;\n"},
        {"exponents", "1.5E+00,2.0E+00,3.0E+00,4.0E+00,0\n5e0,6e0,7e0,8e0,1\n"},
        {"sets as 0.0", "x1,y1,x2,y2,set\n1.5,2,3,4,0.0\n5,6,7,8,1.0\n"},
        {"WKT", "WKT,set\n\"LINESTRING (1.5 2, 3 4)\",0\n\"LINESTRING (5 6,7 8)\",1\n"},
        {"WKT after others", "fid;set;geom\n1;0;LINESTRING(1.5 2,3 4)\n2;1;LINESTRING(5 6,7 8)\n"},
        {"WKT without header", "LINESTRING (1.5 2, 3 4),0\nLINESTRING (5 6, 7 8),1\n"},
        {"WKT of several lines",
         "wkt\tset\nMULTILINESTRING ((1.5 2, 3 4))\t0\n"
         "SRID=25832;LINESTRING(5 6, 7 8)\t1\n"},
        {"points", "id,x,y,set\na,1.5,2,0\na,3,4,0\nb,5,6,1\nb,7,8,1\n"},
        {"points of a GIS", "X;Y;FID;set\n1,5;2;1;0\n3;4;1;0\n5;6;2;1\n7;8;2;1\n"},
        {"names of sets", "x1,y1,x2,y2,set\n1.5,2,3,4,Bedding\n5,6,7,8,\"joint, east\"\n"},
    };
    CHECK(forms.size() >= 40);
    for (const Form& form : forms) {
      const std::string what = form.what;
      CAPTURE(what);
      std::vector<MappedTrace> traces;
      CHECK_NOTHROW(traces = read(form.text, Vec2::Zero(),
                                  {.sets = 2, .set_names = {"bedding", "joint, east"}}));
      REQUIRE(traces.size() == 2);
      CHECK(traces[0].points == std::vector<Vec2>{{1.5, 2}, {3, 4}});
      CHECK(traces[1].points == std::vector<Vec2>{{5, 6}, {7, 8}});
      CHECK(traces[0].set == 0);
      CHECK(traces[1].set == 1);
    }
  }

  TEST_CASE("forms that are not read are refused by name, with what to do") {
    struct Form {
      std::string text, cause, remedy;
    };
    for (const Form& form : {
             Form{"{\"type\":\"FeatureCollection\",\"features\":[]}", "GeoJSON", "export"},
             Form{"  0\nSECTION\n  2\nENTITIES\n", "DXF",
                  "ends in .dxf, or export its lines as CSV"},
             Form{"0\r\nSECTION\r\n2\r\nHEADER\r\n", "DXF",
                  "ends in .dxf, or export its lines as CSV"},
             Form{"<?xml version=\"1.0\"?><kml/>", "XML (KML", "export"},
             Form{"PK\x03\x04 and more", "spreadsheet (.xlsx", "save it as CSV"},
             Form{"%PDF-1.4\n", "PDF", "digitise"},
             Form{std::string("\0\0\x27\x0A\0\0", 6), "shapefile", "export the lines"},
             Form{"x1,y1,x2,y2\n1,5,2,0,3,0,4,0\n", "8 fields", "separated by ;"},
             Form{"x1;y1;x2;y2\n1.234,5;2;3;4\n", "thousands are grouped", "without a sign"},
             Form{"x1;y1;x2;y2\n1 234,5;2;3;4\n", "thousands are grouped", "without a sign"},
             Form{"x1;y1;x2;y2\n1,5;2.5;3;4\n", "has a decimal point, line 2 a decimal comma",
                  "one decimal sign"},
             Form{"x1 [m],y1 [mm],x2 [m],y2 [mm]\n1,2,3,4\n", "units are mixed, m and mm",
                  "one unit"},
             Form{"x1 [furlong],y1,x2,y2\n1,2,3,4\n", "the unit \"furlong\" is not known", "mm"},
             Form{"id,x,y,z\n1,1,2,3\n1,2,3,4\n", "three coordinates", "y (or z) up"},
             Form{"x1,y1,length\n1,2,3\n", "does not name what makes a trace", "x1,y1,x2,y2"},
             Form{"x1,y1,x2,y2,x1\n1,2,3,4,5\n", "does not name", "x1,y1,x2,y2"},
             Form{"wkt\nPOINT (1 2)\n", "no line in WKT", "LINESTRING"},
             Form{"wkt\nLINESTRING Z (1 2 3, 4 5 6)\n", "more than two coordinates", "LINESTRING"},
             Form{"wkt\nLINESTRING EMPTY\n", "no line in WKT", "LINESTRING"},
             Form{"id,x,y\n1,0,0\n1,1,1\n2,0,0\n2,1,0\n1,5,5\n", "id 1 came before",
                  "one after the other"},
             Form{"id,x,y\n1,0,0\n2,1,0\n2,2,0\n", "id 1 has one point", "two points"},
             Form{"id,x,y,set\n1,0,0,0\n1,1,0,1\n", "another set", "one set"},
             Form{"x1,y1,x2,y2,set\n1,2,3,4,foliation\n", "there is no joint set \"foliation\"",
                  "a name (bedding, east)"},
         }) {
      CAPTURE(form.text);
      const std::string message = refusal(form.text, {.sets = 2, .set_names = {"bedding", "east"}});
      CAPTURE(message);
      CHECK(contains(message, form.cause));
      CHECK(contains(message, form.remedy));
    }
  }

  TEST_CASE("the first five faults are said at once, and no more") {
    std::string text = "x1,y1,x2,y2\n";
    for (int k = 0; k < 9; ++k) text += "1,2,bad,4\n5,6,7,8\n";
    const std::string message = refusal(text);
    for (const char* place :
         {"map.csv:2: ", "map.csv:4: ", "map.csv:6: ", "map.csv:8: ", "map.csv:10: "})
      CHECK(contains(message, place));
    CHECK_FALSE(contains(message, "map.csv:12: "));
    CHECK(contains(message, "map.csv: reading ended there"));
  }

  TEST_CASE("where sets are counted from is taken from the numbers, or asked for") {
    const std::string from_1 = "0,0,1,1,1\n0,1,1,2,2\n0,2,1,3,3\n",
                      from_0 = "0,0,1,1,0\n0,1,1,2,1\n0,2,1,3,2\n",
                      unclear = "0,0,1,1,1\n0,1,1,2,2\n";
    const auto sets = [](const std::vector<MappedTrace>& traces) {
      std::vector<int> found;
      for (const MappedTrace& trace : traces) found.push_back(trace.set);
      return found;
    };
    CHECK(sets(read(from_1, Vec2::Zero(), {.sets = 3})) == std::vector<int>{0, 1, 2});
    CHECK(sets(read(from_0, Vec2::Zero(), {.sets = 3})) == std::vector<int>{0, 1, 2});
    const std::string message = refusal(unclear, {.sets = 3, .first_set_key = "the.key"});
    CHECK(contains(message, "sets are numbered 1 to 2, and there are 3"));
    CHECK(contains(message, "the.key = 0 or 1"));
    CHECK(sets(read(unclear, Vec2::Zero(), {.sets = 3, .first_set = 0})) == std::vector<int>{1, 2});
    CHECK(sets(read(unclear, Vec2::Zero(), {.sets = 3, .first_set = 1})) == std::vector<int>{0, 1});
    CHECK(contains(refusal(from_0, {.sets = 3, .first_set = 1}), "there is no joint set 0"));
    CHECK(contains(refusal("0,0,1,1,0\n0,1,1,2,3\n", {.sets = 3}), "there is no joint set 3"));
  }

  TEST_CASE("points of one id are one polyline; those that repeat are counted") {
    std::istringstream in("id,x,y\n7,0,0\n7,1,0\n7,1,0\n7,2,1\n8,5,5\n8,6,6\n");
    const TraceFile file = read_traces(in, "map.csv");
    REQUIRE(file.traces.size() == 2);
    CHECK(file.traces[0].points == std::vector<Vec2>{{0, 0}, {1, 0}, {2, 1}});
    REQUIRE(file.notes.size() == 1);
    CHECK(file.notes[0] == "1 points that repeat the one before");
    const auto rows = read("id,x1,y1,x2,y2\n7,0,0,1,0\n7,1,0,2,1\n7,9,9,8,8\n");
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].points == std::vector<Vec2>{{0, 0}, {1, 0}, {2, 1}});
  }

  TEST_CASE("the same map on another site grid gives the same traces, bit for bit") {
    std::string here, there;
    for (int k = 0; k < 1000; ++k) {
      const auto number = [](long thousandths) {
        std::string text = std::to_string(thousandths);
        return text.insert(text.size() - 3, ".");
      };
      const long x = 10007 + 37 * k, y = 20011 + 91 * k;
      here += number(x) + "," + number(y) + "," + number(x + 1234) + "," + number(y + 777) + "\n";
      there += number(621000000 + x) + "," + number(5140000000L + y) + "," +
               number(621000000 + x + 1234) + "," + number(5140000000L + y + 777) + "\n";
    }
    const auto a = read(here), b = read(there, {621000, 5140000});
    REQUIRE(a.size() == b.size());
    bool is_same = true;
    for (std::size_t k = 0; k < a.size(); ++k) is_same = is_same && a[k].points == b[k].points;
    CHECK(is_same);
  }
}

}  // namespace trace_file_test
