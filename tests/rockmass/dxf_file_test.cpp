// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/geometry/outline_from_lines.hpp>
#include <voussoir/rockmass/dxf_file.hpp>

#include "../support/near.hpp"

namespace dxf_file_test {

using namespace voussoir;
using voussoir_test::near;

namespace {

constexpr double pi = std::numbers::pi;

DxfFile read(const std::string& text, const Vec2& origin = Vec2::Zero(),
             const DxfLimits& limits = {}) {
  std::istringstream in(text);
  return read_dxf(in, "face.dxf", origin, limits);
}

std::string refusal(const std::string& text, const DxfLimits& limits = {}) {
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

bool has_note(const DxfFile& file, const std::string& part) {
  return std::any_of(file.notes.begin(), file.notes.end(),
                     [&](const std::string& note) { return contains(note, part); });
}

/// Groups written "10 1.5, 20 2" as the lines of a DXF.
std::string groups(const std::string& text) {
  std::string lines;
  std::istringstream in(text);
  for (std::string group; std::getline(in, group, ',');) {
    group.erase(0, group.find_first_not_of(" \n"));
    const std::size_t blank = group.find(' ');
    lines += group.substr(0, blank) + "\n" +
             (blank == std::string::npos ? "" : group.substr(blank + 1)) + "\n";
  }
  return lines;
}

/// Entities as a drawing in a unit: $INSUNITS.
std::string drawing(const std::string& entities, const std::string& unit = "6") {
  return groups("0 SECTION, 2 HEADER, 9 $ACADVER, 1 AC1009, 9 $INSUNITS, 70 " + unit +
                ", 0 ENDSEC, 0 SECTION, 2 ENTITIES, " + entities + ", 0 ENDSEC, 0 EOF");
}

/// Signed [m^2].
double area(const std::vector<Vec2>& points) {
  double sum = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
    sum += cross<2>(points[k], points[(k + 1) % points.size()]);
  return 0.5 * sum;
}

/// Chord polygon of a circle of radius 3 m about (10, 5), by its closed form.
double chord_area(std::size_t count) {
  return 0.5 * static_cast<double>(count) * 9 * std::sin(2 * pi / static_cast<double>(count));
}

/// As R12 writes it: no handles, numbers with blanks before them, POLYLINE and VERTEX.
const char* const of_r12 = R"(999
made by hand
  0
SECTION
  2
HEADER
  9
$ACADVER
  1
AC1009
  0
ENDSEC
  0
SECTION
  2
BLOCKS
  0
BLOCK
  8
0
  2
BOLT
 10
0.0
 20
0.0
  0
LINE
  8
0
 10
0.0
 20
0.0
 11
9.0
 21
9.0
  0
ENDBLK
  0
ENDSEC
  0
SECTION
  2
ENTITIES
  0
LINE
  8
J1
 10
1.5
 20
-2.0
 30
0.0
 11
4.25
 21
3.0
 31
0.0
  0
POLYLINE
  8
j2
 66
     1
 70
     1
 10
0.0
 20
0.0
 30
0.0
  0
VERTEX
  8
j2
 10
0.0
 20
0.0
  0
VERTEX
  8
j2
 10
1.0
 20
0.0
  0
VERTEX
  8
j2
 10
1.0
 20
2.0
  0
SEQEND
  8
j2
  0
ENDSEC
  0
EOF
)";

/// As versions from 2000 to 2018 write it: handles, owners, subclass markers, data of programs.
const char* const of_2018 = R"(  0
SECTION
  2
HEADER
  9
$ACADVER
  1
AC1032
  9
$DWGCODEPAGE
  3
ANSI_1252
  9
$INSUNITS
 70
     6
  0
ENDSEC
  0
SECTION
  2
ENTITIES
  0
LINE
  5
2A1
102
{ACAD_REACTORS
330
2A0
 10
77.0
102
}
330
1F
100
AcDbEntity
  8
J1
100
AcDbLine
 10
1.5
 20
-2.0
 30
0.0
 11
4.25
 21
3.0
 31
0.0
1001
ACAD
1010
55.0
  0
LWPOLYLINE
  5
2A2
330
1F
100
AcDbEntity
  8
j2
100
AcDbPolyline
 90
        3
 70
     1
 43
0.0
 10
0.0
 20
0.0
 10
1.0
 20
0.0
 91
0
 10
1.0
 20
2.0
  0
ENDSEC
  0
SECTION
  2
OBJECTS
  0
DICTIONARY
  5
C
  0
ENDSEC
  0
EOF
)";

const std::string circle = "0 CIRCLE, 8 W, 10 10, 20 5, 40 3",
                  two_arcs =
                      "0 ARC, 8 W, 10 10, 20 5, 40 3, 50 -90, 51 90, "
                      "0 ARC, 8 W, 10 10, 20 5, 40 3, 50 90, 51 270",
                  two_bulges =
                      "0 LWPOLYLINE, 8 W, 90 2, 70 1, "
                      "10 7, 20 5, 42 1, 10 13, 20 5, 42 1",
                  old_bulges =
                      "0 POLYLINE, 8 W, 66 1, 70 1, 10 0, 20 0, 30 0, "
                      "0 VERTEX, 8 W, 10 7, 20 5, 42 1, 0 VERTEX, 8 W, 10 13, 20 5, 42 1, 0 SEQEND";

}  // namespace

TEST_SUITE("rockmass/dxf_file") {
  TEST_CASE("R12 and 2018 write the lines of a drawing otherwise, and mean the same") {
    for (const char* text : {of_r12, of_2018}) {
      const DxfFile file = read(text);
      REQUIRE(file.lines.size() == 2);
      CHECK(file.lines[0].points == std::vector<Vec2>{{1.5, -2}, {4.25, 3}});
      CHECK_FALSE(file.lines[0].is_closed);
      CHECK(file.lines[0].layer == 0);
      CHECK(file.lines[1].points == std::vector<Vec2>{{0, 0}, {1, 0}, {1, 2}});
      CHECK(file.lines[1].is_closed);
      CHECK(file.lines[1].layer == 1);
      CHECK(file.layers == std::vector<std::string>{"J1", "j2"});
      CHECK(file.unit == "m");
      CHECK(file.metres == 1);
      CHECK(file.name == "face.dxf");
    }
    CHECK(
        has_note(read(of_r12),
                 "does not say its unit ($INSUNITS): taken as metres, its lines span 4.25 m by 5"));
    CHECK(read(of_2018).notes.empty());
    CHECK(read(of_r12).lines[0].line == 48);
    CHECK(read(of_2018).lines[0].line == 24);
  }

  TEST_CASE("lines may end in LF, CR LF or CR, and a byte order mark may come first") {
    const std::string plain = of_2018;
    std::string windows, mac;
    for (const char c : plain) {
      windows += c == '\n' ? "\r\n" : std::string(1, c);
      mac += c == '\n' ? '\r' : c;
    }
    for (const std::string& text : {windows, mac, "\xEF\xBB\xBF" + plain}) {
      const DxfFile file = read(text);
      REQUIRE(file.lines.size() == 2);
      CHECK(file.lines[1].points[2] == Vec2(1, 2));
      CHECK(file.lines[1].line == read(plain).lines[1].line);
    }
  }

  TEST_CASE("a circle has one area however it is drawn, that of its chords by the closed form") {
    for (const double sagitta : {0.1, 0.005, 1e-5}) {
      const DxfLimits limits{.sagitta = sagitta};
      const std::vector<Vec2> whole = read(drawing(circle), Vec2::Zero(), limits).lines[0].points;
      const double expected = chord_area(whole.size());
      CHECK(area(whole) == near(expected).epsilon(1e-13));
      CHECK(expected < 9 * pi);
      for (const std::string& text : {two_bulges, old_bulges}) {
        const DxfFile file = read(drawing(text), Vec2::Zero(), limits);
        REQUIRE(file.lines.size() == 1);
        CHECK(file.lines[0].is_closed);
        CHECK(file.lines[0].points.size() == whole.size());
        CHECK(area(file.lines[0].points) == near(expected).epsilon(1e-13));
      }
      const DxfFile arcs = read(drawing(two_arcs), Vec2::Zero(), limits);
      REQUIRE(arcs.lines.size() == 2);
      const std::vector<Vec2> joined = outline_from_lines(lines_of(arcs, "W"), 1e-9);
      CHECK(joined.size() == whole.size());
      CHECK(area(joined) == near(expected).epsilon(1e-13));
    }
    const DxfFile full = read(drawing("0 ARC, 8 W, 10 10, 20 5, 40 3, 50 30, 51 390"));
    CHECK(read(drawing(circle + ", " + two_bulges)).notes.empty());  // no point comes twice
    // Smaller than the tolerance, it is still a circle.
    CHECK(read(drawing("0 CIRCLE, 10 0, 20 0, 40 0.001")).lines[0].points.size() == 8);
    CHECK(full.lines[0].is_closed);
    CHECK(area(full.lines[0].points) == near(chord_area(full.lines[0].points.size())));
  }

  TEST_CASE("points lie on the arc, and no chord further from it than told, nor much nearer") {
    // 27 degrees from -10 to 17, the 333 the other way round, and those by tan(333 deg / 4).
    for (const double sagitta : {0.05, 0.005, 1e-4}) {
      for (const char* text : {"0 ARC, 10 0, 20 0, 40 7, 50 350, 51 17",
                               "0 ARC, 10 0, 20 0, 40 7, 50 17, 51 350", "bulge"}) {
        CAPTURE(text);
        std::string entity = text;
        if (entity == "bulge") {
          const auto polar = [](double degrees) {
            return "10 " + message_number(7 * std::cos(degrees * pi / 180), 17) + ", 20 " +
                   message_number(7 * std::sin(degrees * pi / 180), 17);
          };
          entity = "0 LWPOLYLINE, " + polar(17) + ", 42 " +
                   message_number(std::tan(333 * pi / 720), 17) + ", " + polar(350);
        }
        const std::vector<Vec2> points =
            read(drawing(entity), Vec2::Zero(), {.sagitta = sagitta}).lines.at(0).points;
        double largest = 0;
        for (std::size_t k = 0; k < points.size(); ++k) {
          CHECK(points[k].norm() == near(7).epsilon(1e-13));
          if (k > 0) largest = std::max(largest, 7 - (0.5 * (points[k] + points[k - 1])).norm());
        }
        CHECK(largest <= sagitta);
        CHECK(largest > 0.3 * sagitta);
      }
    }
    const auto first = read(drawing("0 ARC, 10 0, 20 0, 40 7, 50 350, 51 17")).lines[0].points;
    CHECK(first.front().y() == near(7 * std::sin(-10 * pi / 180)).epsilon(1e-13));
    CHECK(first.back().y() == near(7 * std::sin(17 * pi / 180)).epsilon(1e-13));
    for (const Vec2& p : first) CHECK(p.x() > 6.6);
  }

  TEST_CASE(
      "a bulge of +1 runs anticlockwise, a quarter's is tan(22.5 deg), flat ones stay exact") {
    const auto arc = [](double bulge) {
      return read(drawing("0 LWPOLYLINE, 10 0, 20 0, 42 " + message_number(bulge, 17) +
                          ", 10 2, 20 0, 42 5"))
          .lines[0]
          .points;
    };
    double lowest = 0;
    for (const Vec2& p : arc(1)) lowest = std::min(lowest, p.y());
    CHECK(lowest == near(-1).epsilon(1e-14));  // below a chord to the right: to its right
    double highest = 0;
    for (const Vec2& p : arc(-1)) highest = std::max(highest, p.y());
    CHECK(highest == near(1).epsilon(1e-14));
    // Quarter of a circle of radius sqrt 2 about (1, 1).
    for (const Vec2& p : arc(std::tan(pi / 8)))
      CHECK((p - Vec2(1, 1)).norm() == near(std::sqrt(2.0)).epsilon(1e-13));
    // The rise is half the bulge times the chord: within the tolerance, one chord; then two.
    CHECK(arc(0.0049).size() == 2);
    REQUIRE(arc(0.0055).size() == 3);
    CHECK(arc(0.0055)[1].y() == near(-0.0055).epsilon(1e-12));
    CHECK(arc(1e-300) == std::vector<Vec2>{{0, 0}, {2, 0}});
    CHECK(arc(0).size() == 2);
  }

  TEST_CASE("an ellipse passes its four ends and keeps to its equation") {
    const DxfFile file =
        read(drawing("0 ELLIPSE, 8 W, 10 10, 20 5, 30 0, 11 0, 21 4, 31 0, 40 0.5, 41 0, "
                     "42 6.283185307179586"));
    const std::vector<Vec2>& points = file.lines[0].points;
    CHECK(file.lines[0].is_closed);
    for (const Vec2& p : points)
      CHECK(std::pow((p.x() - 10) / 2, 2) + std::pow((p.y() - 5) / 4, 2) == near(1).epsilon(1e-12));
    CHECK(area(points) < 8 * pi);
    CHECK(area(points) > 8 * pi - 0.005 * 20);  // sagitta times a bound of the perimeter
    double largest = 0;  // at the ends of the major axis, where it is bent most
    for (std::size_t k = 1; k < points.size(); ++k) {
      const Vec2 middle = 0.5 * (points[k] + points[k - 1]) - Vec2(10, 5);
      largest = std::max(largest, 1 - std::hypot(middle.x() / 2, middle.y() / 4));
    }
    CHECK(4 * largest <= 0.005);
    CHECK(4 * largest > 0.003);
    // A quarter from the major to the minor axis, anticlockwise: to the left of the upward one.
    const auto quarter = read(drawing("0 ELLIPSE, 8 W, 10 0, 20 0, 11 0, 21 4, 40 0.5, 41 0, "
                                      "42 1.570796326794897"))
                             .lines[0];
    CHECK_FALSE(quarter.is_closed);
    CHECK((quarter.points.front() - Vec2(0, 4)).norm() < 1e-14);
    CHECK((quarter.points.back() - Vec2(-2, 0)).norm() < 1e-14);
  }

  TEST_CASE("drawings in other units equal that in metres, bit for bit") {
    const std::string head = "0 LWPOLYLINE, 8 W, 70 1, ", arc = "0 ARC, 8 W, 50 10, 51 100, ";
    const auto metres =
        read(drawing(head + "10 1.234, 20 -0.5, 42 0.3, 10 7.001, 20 0.1, 10 3.3, 20 4.7, " + arc +
                     "10 0.1, 20 0.7, 40 2.3"));
    struct Unit {
      const char *code, *name, *entities;
      double metres;
    };
    for (const Unit& unit :
         {Unit{"4", "mm",
               "10 1234, 20 -500.0, 42 0.3, 10 7001, 20 100, 10 3300, 20 4700, |10 100, 20 700, 40 "
               "2300",
               1e-3},
          Unit{"5", "cm",
               "10 123.4, 20 -50, 42 0.3, 10 700.1, 20 10, 10 330, 20 470, |10 10, 20 70, 40 230",
               1e-2},
          Unit{"14", "dm",
               "10 12.34, 20 -5, 42 0.3, 10 70.01, 20 1, 10 33, 20 47, |10 1, 20 7, 40 23", 0.1},
          Unit{"7", "km",
               "10 0.001234, 20 -0.0005, 42 0.3, 10 0.007001, 20 0.0001, 10 0.0033, 20 0.0047, "
               "|10 0.0001, 20 0.0007, 40 0.0023",
               1e3}}) {
      std::string text = unit.entities;
      text.replace(text.find('|'), 1, arc);
      const DxfFile file = read(drawing(head + text, unit.code));
      CHECK(file.unit == unit.name);
      CHECK(file.metres == unit.metres);
      REQUIRE(file.lines.size() == 2);
      CHECK(file.lines[0].points == metres.lines[0].points);
      CHECK(file.lines[1].points == metres.lines[1].points);
      const DxfFile told = read(drawing(head + text, "6"), Vec2::Zero(), {.metres = unit.metres});
      CHECK(told.lines[0].points == metres.lines[0].points);
      CHECK(told.unit == unit.name);
    }
    const std::string line = "0 LINE, 10 0, 20 0, 11 1, 21 10";
    CHECK(read(drawing(line, "1")).lines[0].points[1].y() == near(0.254).epsilon(1e-15));
    CHECK(read(drawing(line, "2")).lines[0].points[1].y() == near(3.048).epsilon(1e-15));
    CHECK(has_note(read(drawing(line, "0")), "taken as metres, its lines span 1 m by 10 m"));
    CHECK(read(drawing(line, "0"), Vec2::Zero(), {.metres = 1}).notes.empty());
    CHECK(contains(refusal(drawing(line, "8")),
                   "face.dxf:12: the unit of the drawing, $INSUNITS, is not known in \"8\"; "
                   "accepted: 1 in, 2 ft, 4 mm"));
  }

  TEST_CASE("on another site grid the drawing stays as it is, bit for bit") {
    const auto here =
        read(drawing("0 LINE, 10 0.123, 20 4.567, 11 8.9, 21 1.002, "
                     "0 ARC, 10 0.1, 20 0.7, 40 2.3, 50 10, 51 100"));
    const auto there = read(drawing("0 LINE, 10 621000.123, 20 5140004.567, 11 621008.9, 21 "
                                    "5140001.002, 0 ARC, 10 621000.1, 20 5140000.7, 40 2.3, 50 10, "
                                    "51 100"),
                            {621000, 5140000});
    for (std::size_t k = 0; k < 2; ++k) CHECK(here.lines[k].points == there.lines[k].points);
    const auto other = read(drawing("0 LINE, 10 1000.623, 20 -94.933, 11 1009.4, 21 -98.498, "
                                    "0 ARC, 10 1000.6, 20 -98.8, 40 2.3, 50 10, 51 100"),
                            {1000.5, -99.5});
    for (std::size_t k = 0; k < 2; ++k) CHECK(here.lines[k].points == other.lines[k].points);
  }

  TEST_CASE("an entity seen from behind is mirrored in x, as its coordinates are") {
    const std::string behind = ", 210 0, 220 0, 230 -1";
    const auto points = [](const std::string& text) {
      return read(drawing(text)).lines.at(0).points;
    };
    const auto mirrored = [](std::vector<Vec2> list) {
      for (Vec2& p : list) p.x() = -p.x();
      return list;
    };
    for (const std::string& text :
         {std::string("0 ARC, 10 2, 20 1, 40 3, 50 20, 51 80"),
          std::string("0 CIRCLE, 10 2, 20 1, 40 3"),
          std::string("0 LWPOLYLINE, 38 0, 10 1, 20 2, 42 0.5, 10 4, 20 2, 10 4, 20 7"),
          std::string("0 LWPOLYLINE, 38 4, 10 1, 20 2, 42 0.5, 10 4, 20 2, 10 4, 20 7")})
      CHECK(points(text + behind) == mirrored(points(text)));
    // One arc, drawn from either side.
    const auto front = points("0 ARC, 10 2, 20 1, 40 3, 50 20, 51 80"),
               back = points("0 ARC, 10 -2, 20 1, 40 3, 50 100, 51 160" + behind);
    REQUIRE(front.size() == back.size());
    for (std::size_t k = 0; k < front.size(); ++k)
      CHECK((front[k] - back[front.size() - 1 - k]).norm() < 1e-14);
    CHECK(points("0 POLYLINE, 70 0, 10 0, 20 0, 30 2" + behind +
                 ", 0 VERTEX, 10 1, 20 2, 0 VERTEX, 10 4, 20 2, 0 SEQEND") ==
          std::vector<Vec2>{{-1, 2}, {-4, 2}});
    // A line has its ends in the drawing's own axes; so has an ellipse its centre.
    CHECK(points("0 LINE, 10 1, 20 2, 11 3, 21 4" + behind) == std::vector<Vec2>{{1, 2}, {3, 4}});
    const auto ellipse =
        points("0 ELLIPSE, 10 1, 20 2, 11 3, 21 0, 40 0.5, 41 0, 42 1.570796326794897" + behind);
    CHECK((ellipse.front() - Vec2(4, 2)).norm() < 1e-14);
    CHECK((ellipse.back() - Vec2(1, 0.5)).norm() < 1e-14);
    CHECK(contains(refusal(drawing("0 CIRCLE, 10 0, 20 0, 40 1, 210 0.6, 220 0, 230 0.8")),
                   "face.dxf:20: CIRCLE has the extrusion direction (0.6, 0, 0.8): it is tilted "
                   "against the section in \"CIRCLE\"; accepted: entities in x and y"));
  }

  TEST_CASE("a section drawn in x and z is read with z up, and says so") {
    const std::string line = "0 LINE, 10 1, 20 7, 30 2, 11 3, 21 7, 31 5";
    // Normal -y: the entity's axes are x and z; its third coordinate is -y.
    const std::string front = "0 ARC, 10 2, 20 1, 30 -7, 40 3, 50 20, 51 80, 210 0, 220 -1, 230 0",
                      back = "0 ARC, 10 -2, 20 1, 30 7, 40 3, 50 100, 51 160, 210 0, 220 1, 230 0",
                      poly =
                          "0 POLYLINE, 70 8, 10 0, 20 0, 30 0, 0 VERTEX, 70 32, 10 0, 20 7, 30 1, "
                          "0 VERTEX, 70 32, 10 2, 20 7, 30 4, 0 SEQEND";
    const DxfFile file = read(drawing(line + ", " + front + ", " + back + ", " + poly));
    CHECK(has_note(file, "drawn in x and z: z is taken as up"));
    REQUIRE(file.lines.size() == 4);
    CHECK(file.lines[0].points == std::vector<Vec2>{{1, 2}, {3, 5}});
    CHECK(file.lines[1].points ==
          read(drawing("0 ARC, 10 2, 20 1, 40 3, 50 20, 51 80")).lines[0].points);
    CHECK((file.lines[2].points.back() - file.lines[1].points.front()).norm() < 1e-14);
    CHECK(file.lines[3].points == std::vector<Vec2>{{0, 1}, {2, 4}});
    // The site origin's height is taken off z.
    CHECK(read(drawing(line), {0.5, 100}).lines[0].points ==
          std::vector<Vec2>{{0.5, -98}, {2.5, -95}});
    // One height for all is no section in x and z; two heights and several y are no section.
    const DxfFile level = read(drawing("0 LINE, 10 1, 20 7, 30 2, 11 3, 21 7, 31 2"));
    CHECK(level.lines[0].points == std::vector<Vec2>{{1, 7}, {3, 7}});
    CHECK(level.notes.empty());
    CHECK(contains(refusal(drawing("0 LINE, 10 1, 20 7, 30 2, 11 3, 21 8, 31 5")),
                   "face.dxf: the drawing is no flat section: x differs by 2 m, y by 1 m and z by "
                   "3 m; accepted: a section drawn in x and y (or in x and z, with one y): flatten "
                   "it in the CAD program (FLATTEN)"));
    CHECK(contains(refusal(drawing("0 LINE, 10 1, 20 7, 30 2, 11 1, 21 8, 31 5")),
                   "turn the drawing out of y and z"));
    CHECK(refusal(drawing("0 LINE, 10 1, 20 7, 30 2, 11 3, 21 8, 31 2.1"), {.flatness = 0.2}) ==
          "accepted");
  }

  TEST_CASE("lines of joints are traces of the set that their layer names") {
    const DxfFile file =
        read(drawing("0 LINE, 8 Bedding, 10 0, 20 0, 11 1, 21 0, 0 LINE, 8 FRAME, 10 0, 20 0, 11 "
                     "9, 21 0, 0 LINE, 8 FRAME, 10 0, 20 0, 11 9, 21 9, "
                     "0 LWPOLYLINE, 8 east, 70 1, 10 0, 20 0, 10 1, 20 0, 10 1, 20 1, "
                     "0 LINE, 8 BEDDING, 10 0, 20 5, 11 1, 21 5, 0 TEXT, 8 Notes, 1 hello"));
    CHECK(file.layers == std::vector<std::string>{"Bedding", "FRAME", "east", "Notes"});
    const DxfTraces found = traces_of(file, {"East", "bedding"});
    REQUIRE(found.traces.size() == 3);
    CHECK(found.traces[0].set == 1);
    CHECK(found.traces[0].points == std::vector<Vec2>{{0, 0}, {1, 0}});
    CHECK(found.traces[1].set == 0);
    CHECK(found.traces[1].points == std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 0}});
    CHECK(found.traces[2].set == 1);
    REQUIRE(found.left_out.size() == 1);
    CHECK(found.left_out[0].layer == "FRAME");
    CHECK(found.left_out[0].lines == 2);
    const DxfTraces all = traces_of(file, {});
    CHECK(all.traces.size() == 5);
    CHECK(all.traces[0].set == -1);
    CHECK(all.left_out.empty());
    const auto message = [&](const std::string& set) {
      try {
        (void)traces_of(file, {"east", set});
      } catch (const InvalidInput& error) {
        return std::string(error.what());
      }
      return std::string("accepted");
    };
    const std::string layers = "Bedding (2 lines), FRAME (2 lines), east (1 line), Notes (none)";
    CHECK(contains(message("J7"), "face.dxf: there is no layer \"J7\"; layers: " + layers));
    CHECK(contains(message("notes"), "face.dxf: no lines on layer \"notes\"; layers: " + layers));
    CHECK(lines_of(file, "frame").size() == 2);
    CHECK(lines_of(file, "").size() == 5);
    CHECK(lines_of(file, "east")[0].is_closed);
    CHECK_THROWS_AS((void)lines_of(file, "J7"), InvalidInput);
    // Layers may be chosen when the file is read, and then others may hold anything.
    const std::string text = drawing(
        "0 LINE, 8 W, 10 0, 20 0, 11 1, 21 0, 0 SPLINE, 8 X, 10 0, 20 0, "
        "0 POLYLINE, 8 X, 70 16, 0 VERTEX, 8 X, 10 1, 20 1, 0 SEQEND, 8 X");
    const DxfFile chosen = read(text, Vec2::Zero(), {.layers = {"w"}});
    CHECK(chosen.lines.size() == 1);
    CHECK(has_note(chosen, "not read: 2 on layers that were not asked for"));
    CHECK(contains(refusal(text, {.layers = {"W", "Q"}}),
                   "face.dxf: there is no layer \"Q\"; layers: W (1 line), X (none)"));
    CHECK(contains(refusal(text, {.layers = {"Q"}}),
                   "holds no line, polyline, arc or circle on the layers that were asked for; "
                   "layers: W, X; not read: "));  // nobody counted the lines of others
    CHECK(contains(refusal(drawing("0 LINE, 8 W, 10 0, 20 0, 11 1, 21 0, 0 TEXT, 8 X, 1 a"),
                           {.layers = {"x"}}),
                   "layers: W, X (none); not read: "));
  }

  TEST_CASE("names of layers come in UTF-8, whatever the file has them in") {
    const auto file = [](const std::string& layer) {
      return read(drawing("0 LINE, 8 " + layer + ", 10 0, 20 0, 11 1, 21 0"));
    };
    const std::string name = "Kl\xC3\xBC\x66te";
    CHECK(file(name).layers[0] == name);
    CHECK(file(name).notes.empty());
    CHECK(file("Kl\\U+00FCfte").layers[0] == name);
    CHECK(file("\\U+4E2D").layers[0] == "\xE4\xB8\xAD");
    CHECK(file("\\U+00G1").layers[0] == "\\U+00G1");
    CHECK(file("Kl\xFC\x66te").layers[0] == name);
    CHECK(has_note(file("Kl\xFC\x66te"), "no UTF-8 are taken as Latin-1"));
  }

  TEST_CASE("what holds no lines is counted by its type; what is not seen, too") {
    const DxfFile file = read(drawing(
        "0 LINE, 10 0, 20 0, 11 1, 21 0, 0 TEXT, 1 a, 0 HATCH, 10 0, 20 0, 0 TEXT, 1 b, 0 "
        "DIMENSION, 0 POINT, 10 5, 20 5, 0 LINE, 67 1, 10 0, 20 0, 11 9, 21 9, 0 LINE, 60 1, 10 0, "
        "20 0, 11 9, 21 9, 0 LINE, 10 2, 20 2, 11 2, 21 2, "
        "0 LWPOLYLINE, 70 1, 10 0, 20 0, 10 1, 20 0, 10 1, 20 0, 10 1, 20 1, 10 0, 20 0"));
    REQUIRE(file.lines.size() == 2);
    CHECK(file.lines[1].points == std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}});
    CHECK(has_note(
        file, "not read: 1 DIMENSION, 1 HATCH, 1 POINT, 2 TEXT, 1 in paper space, 1 invisible"));
    CHECK(has_note(file, "1 lines of zero length, left out"));
    CHECK(has_note(file, "3 points that repeat the one before"));
    // Corners of the frame of a smoothed polyline are no points of it.
    CHECK(read(drawing("0 POLYLINE, 70 4, 0 VERTEX, 70 16, 10 9, 20 9, 0 VERTEX, 70 8, 10 0, 20 0, "
                       "0 VERTEX, 70 8, 10 1, 20 1, 0 SEQEND"))
              .lines[0]
              .points == std::vector<Vec2>{{0, 0}, {1, 1}});
  }

  TEST_CASE("faults are sentences with the file and the line, and what to do") {
    struct Fault {
      std::string text, cause, remedy;
    };
    const std::string good = "0 LINE, 10 0, 20 0, 11 1, 21 0";
    const std::string utf16 = [] {
      std::string text;
      for (const char* c = of_2018; *c != 0; ++c) (text += *c) += '\0';
      return text;
    }();
    for (const Fault& fault : {
             Fault{"", "face.dxf:0: the file is empty", "ASCII DXF, R12 to 2018"},
             Fault{"AutoCAD Binary DXF\r\n\x1A", "face.dxf:1: this is a binary DXF",
                   "save it again as ASCII"},
             Fault{"AC1032\x01\x02", "face.dxf:1: this is a DWG in \"AC1032\"",
                   "save it again as DXF"},
             Fault{utf16, "face.dxf:1: this is a text in UTF-16", "in ASCII, UTF-8"},
             Fault{"\xFF\xFE" + utf16, "face.dxf:1: this is a text in UTF-16", "in ASCII, UTF-8"},
             Fault{"%PDF-1.4\n", "face.dxf:1: this is a PDF", "ASCII DXF"},
             Fault{"x1,y1,x2,y2\n0,0,1,1\n",
                   "face.dxf:1: this is no DXF: its first line is no group code in \"x1,y1,x2,y2\"",
                   "ASCII DXF"},
             Fault{groups("0 LINE, 8 0"), "face.dxf:2: no section begins here in \"LINE\"", ""},
             Fault{groups("10 5, 0 SECTION"), "face.dxf:2: no section begins here in \"5\"", ""},
             Fault{groups("0 EOF"), "face.dxf:2: the file has no section ENTITIES", "with lines"},
             Fault{groups("0 SECTION, 2 ENTITIES, " + good),
                   "face.dxf:14: the file ends without EOF", "ASCII DXF"},
             Fault{groups("0 SECTION, 2 ENTITIES, " + good) + "8\n",
                   "face.dxf:15: the file ends after a group code, without its value: it was cut "
                   "off in \"8\"",
                   ""},
             Fault{groups("0 SECTION, 2 ENTITIES, " + good + ", 0 EOF"),
                   "face.dxf:16: the file ends inside a section: it was cut off", ""},
             Fault{groups("0 SECTION, 2 ENTITIES, 0 LINE, ten 5"),
                   "face.dxf:7: a group code is no number from -5 to 1071: lines are missing, or "
                   "there is one too many in \"ten\"",
                   ""},
             Fault{groups("0 SECTION, 2 ENTITIES, 0 LINE, 1072 5"),
                   "face.dxf:7: a group code is no", ""},
             Fault{groups("0 SECTION, 2 ENTITIES") + std::string("0\nLI\0NE\n", 8),
                   "face.dxf:6: holds a byte 0: this is no text", "ASCII DXF"},
             Fault{drawing("0 TEXT, 8 A, 1 x"),
                   "face.dxf: holds no line, polyline, arc or circle; layers: A (none); not read: "
                   "1 TEXT",
                   ""},
             Fault{
                 drawing("0 SPLINE, 8 J1, 0 SPLINE, 8 J2, " + good),
                 "face.dxf:20: 2 SPLINE (free curves) cannot be read, the first on layer \"J1\" in "
                 "\"SPLINE\"; accepted: lines, polylines and arcs",
                 "convert splines to polylines in the CAD program (SPLINEDIT"},
             Fault{drawing(good + ", 0 INSERT, 8 B, 2 BOLT, 10 0, 20 0"),
                   "face.dxf:30: 1 INSERT (references to blocks)", "explode the blocks in the CAD"},
             Fault{drawing("0 MLINE, 8 B, " + good), "1 MLINE (multilines)", "explode them"},
             Fault{drawing("0 HELIX, 8 B, " + good), "1 HELIX (free curves)", "explode it"},
             Fault{drawing("0 POLYLINE, 70 16, 71 4, 0 VERTEX, 10 0, 20 0, 0 SEQEND"),
                   "face.dxf:20: POLYLINE is a mesh", "explode it (EXPLODE), or leave it out"},
             Fault{drawing("0 POLYLINE, 70 64, 0 SEQEND"), "POLYLINE is a mesh", "explode it"},
             Fault{drawing("0 POLYLINE, 70 0, 0 VERTEX, 10 0, 20 0, " + good),
                   "face.dxf:20: POLYLINE without SEQEND", "save the drawing again"},
             Fault{drawing(good + ", 0 POLYLINE, 70 0"), "face.dxf:30: POLYLINE without SEQEND",
                   "save the drawing again"},
             Fault{drawing("0 VERTEX, 10 0, 20 0"), "face.dxf:20: VERTEX without a POLYLINE",
                   "save the drawing again"},
             Fault{drawing("0 LINE, 10 0, 20 0, 11 1"), "face.dxf:20: LINE without its group 21",
                   "all their coordinates"},
             Fault{drawing("0 LWPOLYLINE, 10 0, 20 0, 10 1"),
                   "face.dxf:20: LWPOLYLINE without its group 20", "all their coordinates"},
             Fault{drawing("0 LWPOLYLINE, 90 3, 10 0, 20 0, 10 1, 20 1"),
                   "face.dxf:20: LWPOLYLINE of 3 points has 2", "save the drawing again"},
             Fault{drawing("0 LINE, 10 0, 20 zero, 11 1, 21 0"),
                   "face.dxf:24: LINE: group 20 is not a finite number in \"zero\"",
                   "a number with a decimal point"},
             Fault{drawing("0 LINE, 10 nan, 20 0, 11 1, 21 0"),
                   "face.dxf:22: LINE: group 10 is not a finite number", ""},
             Fault{drawing("0 LINE, 10 1e99, 20 0, 11 1, 21 0"),
                   "face.dxf:22: LINE: group 10 is out of range", "up to 1e9 m"},
             Fault{drawing("0 LINE, 10 2e9, 20 0, 11 1, 21 0"),
                   "face.dxf:20: LINE: a coordinate is out of range", "-1e9 to 1e9 m"},
             Fault{drawing("0 LWPOLYLINE, 70 0.5, 10 0, 20 0"),
                   "face.dxf:22: LWPOLYLINE: group 70 is no whole number", "a whole number"},
             Fault{drawing("0 CIRCLE, 10 0, 20 0, 40 0"),
                   "face.dxf:20: CIRCLE: its radius is not > 0", "a radius > 0"},
             Fault{drawing("0 ARC, 10 0, 20 0, 40 1, 50 10"),
                   "face.dxf:20: ARC without its group 51", ""},
             Fault{drawing("0 ELLIPSE, 10 0, 20 0, 11 1, 21 0, 40 2"),
                   "face.dxf:20: ELLIPSE: its axes or its angles are out of range", "axes > 0"},
         }) {
      const std::string message = refusal(fault.text);
      CAPTURE(message);
      CAPTURE(fault.cause);
      CHECK(contains(message, fault.cause));
      CHECK(contains(message, fault.remedy));
    }
    std::string comma = drawing("0 LINE, 10 0, 20 0, 11 1, 21 7");
    comma.replace(comma.rfind("7\n"), 1, "7,5");
    CHECK(contains(refusal(comma), "face.dxf:28: LINE: group 21 has a decimal comma in \"7,5\""));
    // A circle of 1e8 m in chords of a nanometre's rise, and sources that are too long.
    CHECK(contains(refusal(drawing("0 CIRCLE, 10 0, 20 0, 40 1e8"), {.sagitta = 1e-9}),
                   "face.dxf:20: more points than are allowed, arcs as chords included in "
                   "\"CIRCLE\"; accepted: drawings of up to 1000000 points"));
    CHECK(contains(refusal(drawing("0 LWPOLYLINE, 10 0, 20 0, 42 1e12, 10 1, 20 0")),
                   "more points than are allowed"));
    CHECK(contains(refusal(of_2018, {.points = 4}), "accepted: drawings of up to 4 points"));
    CHECK(contains(refusal(of_2018, {.line_length = 9}),
                   "face.dxf:10: a line of more than 9 characters in \"$DWGCODEP\""));
    CHECK(contains(refusal(of_2018, {.bytes = 99}),
                   "face.dxf: more than 99 bytes; accepted: drawings up to that size"));
    CHECK(contains(refusal(of_2018, {.sagitta = 0}), "sagitta = 0: must be > 0 m"));
    CHECK(contains(refusal(of_2018, {.flatness = -1}), "flatness = -1: must be >= 0 m"));
    CHECK(contains(refusal(of_2018, {.metres = -1}), "metres of the drawing's unit = -1"));
    // Five faults at once, each with its line.
    std::string bad;
    for (int k = 0; k < 9; ++k) bad += "0 LINE, 10 x, 20 0, 11 1, 21 0, ";
    const std::string five = refusal(drawing(bad + good));
    for (const char* place : {"dxf:22: ", "dxf:32: ", "dxf:42: ", "dxf:52: ", "dxf:62: "})
      CHECK(contains(five, place));
    CHECK_FALSE(contains(five, "dxf:72: "));
    CHECK(contains(five, "face.dxf: reading ended there"));
  }

  TEST_CASE("a file that is cut off anywhere, or has wrong bytes, is read or refused") {
    const std::string whole =
        drawing(two_bulges + ", " + old_bulges + ", " + two_arcs + ", " + circle +
                ", 0 TEXT, 8 W, 1 a, 0 ELLIPSE, 10 0, 20 0, 11 3, 21 0, 40 0.5, " +
                "0 POLYLINE, 70 9, 0 VERTEX, 10 0, 20 0, 0 VERTEX, 10 1, 20 1, 0 SEQEND");
    int read_count = 0, refused_count = 0;
    const auto try_it = [&](const std::string& text) {
      try {
        const DxfFile file = read(text, Vec2::Zero(), {.points = 20000});
        for (const DxfPolyline& line : file.lines) {
          REQUIRE(line.points.size() >= 2);
          REQUIRE(line.layer < static_cast<int>(file.layers.size()));
          for (const Vec2& p : line.points) REQUIRE(p.allFinite());
        }
        ++read_count;
      } catch (const InvalidInput& error) {
        REQUIRE(contains(error.what(), "face.dxf"));
        ++refused_count;
      }
    };
    for (const std::string& text : {std::string(of_r12), std::string(of_2018), whole})
      for (std::size_t k = 0; k < text.size(); ++k)
        if (text[k] == '\n') {
          try_it(text.substr(0, k));
          // Nothing short of the whole is taken for it.
          if (k + 1 < text.size()) CHECK(refusal(text.substr(0, k + 1)) != "accepted");
        }
    CHECK(read_count == 3);  // without the last end of a line
    CHECK(refused_count > 100);
    std::mt19937 random(7);
    for (const std::string& text : {std::string(of_2018), whole})
      for (int k = 0; k < 2000; ++k) {
        std::string changed = text;
        for (std::uint32_t flips = 1 + random() % 4; flips > 0; --flips)
          changed[random() % changed.size()] =
              static_cast<char>(flips % 2 == 0 ? '0' + random() % 10 : random() % 256);
        try_it(changed);
      }
    CHECK(read_count > 100);
  }

  TEST_CASE(
      "a horseshoe in lines and arcs is the outline by its closed form, and reading can stop") {
    // 6 m wide, walls 3 m high, a half circle on top.
    const std::string section =
        "0 ARC, 8 WALL, 10 0, 20 3, 40 3, 50 0, 51 180, 0 LINE, 8 WALL, 10 -3, 20 0, 11 3, 21 0, "
        "0 LINE, 8 WALL, 10 3, 20 3, 11 3, 21 0, 0 LINE, 8 WALL, 10 -3, 20 3, 11 -3, 21 0";
    const std::vector<Vec2> outline = outline_from_lines(lines_of(read(drawing(section)), "wall"));
    const double chords = static_cast<double>(outline.size() - 3);
    CHECK(area(outline) == near(6 * 3 + 0.5 * chords * 9 * std::sin(pi / chords)).epsilon(1e-14));
    CHECK(outline[0] == Vec2(-3, 0));
    CHECK(outline[1] == Vec2(3, 0));
    std::string many;
    for (int k = 0; k < 50000; ++k) many += "0 LINE, 8 WALL, 10 0, 20 0, 11 1, 21 1, ";
    const std::string text = drawing(many + section);
    std::istringstream in(text);
    CHECK_THROWS_AS((void)read_dxf(in, "face.dxf", Vec2::Zero(), {}, [](double) { return false; }),
                    Stopped);
  }
}

}  // namespace dxf_file_test
