// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/repeatable.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/orientation.hpp>
#include <voussoir/rockmass/orientation_file.hpp>

#include "support/degree.hpp"
#include "support/near.hpp"

namespace orientation_file_test {

using namespace voussoir;
using voussoir_test::degree;
using voussoir_test::near;

namespace {

OrientationFile read(const std::string& text, const OrientationFileLimits& limits = {}) {
  std::istringstream in(text);
  return read_orientations(in, "survey.csv", limits);
}

std::string refusal(const std::string& text, const OrientationFileLimits& limits = {}) {
  try {
    (void)read(text, limits);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool has_note(const OrientationFile& file, const std::string& part) {
  for (const std::string& note : file.notes)
    if (contains(note, part)) return true;
  return false;
}

/// A plane of the file, in degrees.
bool is(const SurveyedPlane& found, double dip, double direction) {
  return std::abs(found.plane.dip - dip * degree) < 1e-12 &&
         std::abs(found.plane.dip_direction - direction * degree) < 1e-12;
}

/// A plane in whole degrees.
struct Whole {
  int dip, direction;
};

/// Planes towards every eighth of the compass, upright ones, level ones and drawn ones.
std::vector<Whole> whole_planes() {
  std::vector<Whole> planes;
  for (int direction = 0; direction < 360; direction += 45)
    for (const int dip : {30, 90}) planes.push_back({dip, direction});
  planes.push_back({0, 0});
  planes.push_back({1, 359});
  std::mt19937 draw(2024);
  for (int k = 0; k < 40; ++k) {
    const int dip = static_cast<int>(draw() % 91), direction = static_cast<int>(draw() % 360);
    planes.push_back({dip, direction});
  }
  return planes;
}

/// A file of these rows under a header has the planes of another, bit by bit; which that are.
template <class Row>
std::string unlike_plain(const std::string& header, const Row& row) {
  const std::vector<Whole> planes = whole_planes();
  std::string plain = "dip;dip direction\n", text = header + "\n", unlike;
  for (const Whole& plane : planes) {
    plain += std::to_string(plane.dip) + ";" + std::to_string(plane.direction) + "\n";
    text += row(plane) + "\n";
  }
  const OrientationFile expected = read(plain), found = read(text);
  if (found.planes.size() != planes.size()) return "not all planes are read";
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (found.planes[k].plane.dip != expected.planes[k].plane.dip ||
        found.planes[k].plane.dip_direction != expected.planes[k].plane.dip_direction)
      unlike += row(planes[k]) + " ";
  return unlike;
}

/// An azimuth of 0 to 359 degrees as a bearing: N45E.
std::string bearing(int azimuth, const std::string& blank = "", const std::string& sign = "") {
  const auto text = [&](const char* from, int angle, const char* towards) {
    return from + blank + std::to_string(angle) + sign + blank + towards;
  };
  if (azimuth <= 90) return text("N", azimuth, "E");
  if (azimuth <= 180) return text("S", 180 - azimuth, "E");
  if (azimuth < 270) return text("S", azimuth - 180, "W");
  return text("N", 360 - azimuth, "W");
}

/// The quadrant in which a direction is, or the cardinal point that it is.
std::string quadrant_of(int direction) {
  if (direction % 90 == 0) return std::string(1, "NESW"[direction / 90]);
  constexpr const char* quadrants[] = {"NE", "SE", "SW", "NW"};
  return quadrants[direction / 90];
}

/// The cardinal point nearest to a direction.
std::string cardinal_of(int direction) { return std::string(1, "NESWN"[(direction + 45) / 90]); }

/// A text of ASCII in UTF-16 with a mark.
std::string wide(const std::string& text) {
  std::string out = "\xFF\xFE";
  for (const char c : text) {
    out += c;
    out += '\0';
  }
  return out;
}

}  // namespace

TEST_SUITE("rockmass/orientation_file") {
  TEST_CASE("however it was written: header, order, separator, decimal sign, encoding, units") {
    const std::string plain = "dip,dip direction\n45.5,120\n60,300.25\n";
    for (const std::string& text : {
             plain,
             std::string("Dip Direction;DIP\r\n120;45,5\r\n300,25;60\r\n"),
             std::string("Dip\tDipDir\n45.5\t120\n60\t300.25"),
             std::string("dip | dip_dir\n45.5 | 120\n60 | 300.25\n"),
             std::string("Dip Dip direction\n45.5 120\n60 300.25\n"),
             std::string("Dip Azimuth\n45,5 120\n60 300,25\n"),
             std::string("Dip dir. [deg],Dip angle (deg)\n120,45.5\n300.25,60\n"),
             std::string("dip_deg,dip_direction_deg\n45.5,120\n60,300.25\n"),
             std::string("dip,dd\n(\xC2\xB0),(\xC2\xB0)\n45.5\xC2\xB0,120\xC2\xB0\n60,300.25\n"),
             std::string("Dip;Dip direction\ndeg;deg\n45.5;120\n60;300.25\n"),
             std::string("\"Inclination\",\"Dip Azimuth\"\n\"45.5\",\"120\"\n60,300.25\n"),
             std::string("Strike (RHR),Dip\n30,45.5\n210.25,60\n"),
             std::string("strike rhr;dip\n30;45.5\n210.25;60\n"),
             std::string("Strike_right,Dip\n30,45.5\n210.25,60\n"),
             std::string("Strike (right-hand rule) [deg],Dip [deg]\n30,45.5\n210.25,60\n"),
             std::string("Fallrichtung;Fallen\n120;45,5\n300,25;60\n"),
             std::string("dip [gon];dip direction [gon]\n50,5555555555555555;133,3333333333333333\n"
                         "66,6666666666666667;333,6111111111111111\n"),
             std::string("dip [rad];dip direction [rad]\n0.7941248096574199;2.0943951023931953\n"
                         "1.0471975511965976;5.240351079113107\n"),
             std::string("# made by hand\n* Dips\n\nsep=;\nDip;Dip direction\n45.5;120\n60;300.25"),
             std::string("45.5,120\n60,300.25\n"),
             std::string("120;45,5\n300,25;60\n"),
             std::string("45,5 120,0\n60 300,25\n"),
             std::string("\xEF\xBB\xBF") + plain,
             wide(plain),
         }) {
      CAPTURE(text);
      const OrientationFile file = read(text);
      REQUIRE(file.planes.size() == 2);
      CHECK(is(file.planes[0], 45.5, 120));
      CHECK(is(file.planes[1], 60, 300.25));
      CHECK(file.planes[0].set == -1);
      CHECK(file.planes[0].weight == 1);
      CHECK(file.set_names.empty());
    }
    CHECK(read("Dip Direction;DIP\n120;45,5\n").layout ==
          "fields separated by ;, decimal comma, columns by the header, dip direction, angles in "
          "degrees");
    CHECK(contains(read(wide("strike rhr\tdip [rad]\n1\t1\n")).layout,
                   "separated by tabs, UTF-16, columns by the header, strike with the dip to its "
                   "right, angles in radians"));
  }

  TEST_CASE("a file as Dips writes it: titles before the header, quantity, set, other columns") {
    const OrientationFile file = read(
        "* This file generated by Dips\nAdit 3\nDIP/DIPDIRECTION\n0\n1 LINEAR 0 90\n"
        "ID,Dip,Dip Direction,Quantity,Traverse,Set,Spacing\n"
        "1,30,40,2,1,J2,0.3\n2,90,360,1,1,J1,\n3,0,0,1.5,1,,\n4,35,41,1,1,j2\n");
    REQUIRE(file.planes.size() == 4);
    CHECK(is(file.planes[0], 30, 40));
    CHECK(is(file.planes[1], 90, 0));  // 360 is North
    CHECK(is(file.planes[2], 0, 0));
    CHECK(file.planes[0].weight == 2);
    CHECK(file.planes[2].weight == 1.5);
    CHECK(file.set_names == std::vector<std::string>{"J2", "J1"});
    CHECK(file.planes[0].set == 0);
    CHECK(file.planes[1].set == 1);
    CHECK(file.planes[2].set == -1);
    CHECK(file.planes[3].set == 0);  // in any case
    CHECK(has_note(file, "4 lines before the header are skipped, from \"Adit 3\" on"));
    CHECK(has_note(file, "columns that are not read: ID, Traverse, Spacing"));
    CHECK(has_note(file, "1 planes of no set"));
  }

  TEST_CASE("a file as FieldMove writes it: the strike beside the dip direction is left") {
    const OrientationFile file = read(
        "localityName, x, y, planeType, dip, dipAzimuth, strike, declination\n"
        "A, 1, 2, Joint, 44.5, 123.4, 33.4, 0\n");
    REQUIRE(file.planes.size() == 1);
    CHECK(is(file.planes[0], 44.5, 123.4));
    CHECK(has_note(file, "not read: localityName, x, y, planeType, strike, declination"));
  }

  TEST_CASE("sets that are numbers are in order of value, others as they appear") {
    const auto names = [](const std::string& column) {
      return read("dip,dd,family\n" + column).set_names;
    };
    CHECK(names("1,2,10\n1,2,2\n1,2,1\n1,2,-1\n") == std::vector<std::string>{"1", "2", "10"});
    CHECK(names("1,2,10\n1,2,F\n1,2,1\n") == std::vector<std::string>{"10", "F", "1"});
    const OrientationFile file = read("dip,dd,set\n1,2,10\n1,2,2\n1,2,1\n1,2,none\n1,2,2.0\n");
    const int sets[] = {2, 1, 0, -1, 1};
    for (std::size_t k = 0; k < 5; ++k) CHECK(file.planes[k].set == sets[k]);
  }

  TEST_CASE("a column that may mean two things yields to a clearer one") {
    // The azimuth of a scanline; n is the northing beside an easting, a number without it.
    CHECK(is(read("azimuth,dip,dip direction\n10,30,200\n").planes[0], 30, 200));
    CHECK(read("e,n,dip,dd\n500,600,30,200\n").planes[0].weight == 1);
    CHECK(read("n,dip,dd\n6,30,200\n").planes[0].weight == 6);
  }

  TEST_CASE("without a header the column with values above 90 is the direction, or none is") {
    CHECK(has_note(read("45,120\n60,30\n"),
                   "without a header, the second column is taken for the dip direction"));
    CHECK(has_note(read("120,45\n30,60\n"), "the first column is taken for the dip direction"));
    CHECK(is(read("120,45\n30,60\n").planes[1], 60, 30));
    CHECK(contains(refusal("45,60\n30,20\n"),
                   "survey.csv:1: which column is the dip? There is no header, and no value above "
                   "90 in \"45, 60\"; accepted: a header: columns dip and dip direction"));
    CHECK(
        contains(refusal("45,160\n130,20\n"),
                 "survey.csv:2: which column is the dip? There is no header, and values are above "
                 "90 in both columns in \"130, 20\""));
    CHECK(contains(refusal("45,160,1\n"),
                   "survey.csv:1: 3 fields instead of 2 in \"45,160,1\"; accepted: dip and dip "
                   "direction, or a header"));
    CHECK(contains(refusal("45,370\n"), "survey.csv:1: dip direction = 370 in \"45, 370\""));
  }

  TEST_CASE("a strike needs a rule, unless the caller has one") {
    CHECK(refusal("dip,strike\n30,40\n") ==
          "survey.csv:1: strike without rule in \"dip,strike\"; accepted: a column named strike "
          "(RHR), with the dip to the right of the strike, or a dip direction, or dips with the "
          "letters of their side, as 60SE");
    CHECK(contains(refusal("strike,dip [rad]\n1,1\n"), "survey.csv:1: strike without rule"));
    // A level and an upright plane have no side.
    CHECK(is(read("strike,dip\n40,90\n250,0\n").planes[0], 90, 130));
    CHECK(is(read("strike,dip\n40,90\n300,0\n").planes[1], 0, 30));
    OrientationFileLimits limits;
    limits.strike_is_right_handed = true;
    CHECK(is(read("dip,strike\n30,40\n", limits).planes[0], 30, 130));
    CHECK(is(read("dip,strike\n30,300\n", limits).planes[0], 30, 30));
    CHECK(contains(refusal("dip,strike (LHR)\n30,40\n"), "strike without rule"));
  }

  TEST_CASE("poles by trend and plunge are the planes of their dips and dip directions") {
    const auto trend = [](const Whole& plane) {
      return std::to_string((plane.direction + 180) % 360);
    };
    const auto row = [&](const Whole& plane) {
      return trend(plane) + ";" + std::to_string(90 - plane.dip);
    };
    for (const char* header :
         {"pole trend;pole plunge", "Trend of pole;Plunge of pole", "POLE AZIMUTH;POLE PLUNGE",
          "pole_trend_deg;pole_plunge_deg", "Trend (pole) [deg];Plunge (pole) [deg]",
          "trend of normal;plunge of normal", "Pole to plane trend;Pole to plane plunge",
          "trend;pole plunge", "pole trend;plunge", "poletrend;poleplunge"}) {
      CAPTURE(header);
      CHECK(unlike_plain(header, row) == "");
    }
    CHECK(unlike_plain("Pole Plunge,Set,Pole Trend", [&](const Whole& plane) {
            return std::to_string(90 - plane.dip) + ",," + trend(plane);
          }) == "");
    CHECK(unlike_plain("pole trend pole plunge", [&](const Whole& plane) {
            return trend(plane) + " " + std::to_string(90 - plane.dip);
          }) == "");
    CHECK(unlike_plain("pole trend;pole plunge", [&](const Whole& plane) {
            return bearing((plane.direction + 180) % 360) + ";" + std::to_string(90 - plane.dip);
          }) == "");
    const OrientationFile file = read("pole trend,pole plunge,set\n30,90,1\n360,25.5,2\n");
    CHECK(is(file.planes[0], 0, 210));  // level: it has any dip direction
    CHECK(is(file.planes[1], 64.5, 180));
    CHECK(file.set_names.size() == 2);
    CHECK(file.layout ==
          "fields separated by ,, columns by the header, poles by trend and plunge, angles in "
          "degrees");
    CHECK(has_note(file, "each plane dips 90 degrees less the plunge, opposite to the trend"));
    CHECK(is(read("pole trend [gon],pole plunge [gon]\n100,50\n").planes[0], 45, 270));
    const SurveyedPlane level = read("pole trend [rad],pole plunge [rad]\n0,1.571\n").planes[0];
    CHECK(level.plane.dip == 0);
    CHECK(has_note(read("pole trend,pole plunge\n1.1,1.2\n0.3,0.2\n1.5,0.2\n"),
                   "no plunge is above 1.58, no trend above 6.29"));
  }

  TEST_CASE("a pole of the lower hemisphere is the downward normal of its plane") {
    std::mt19937 draw(7);
    for (int k = 0; k < 30; ++k) {
      const double trend = 0.01 * static_cast<double>(draw() % 36'000),
                   plunge = 0.01 * static_cast<double>(draw() % 9'000);
      std::ostringstream text;
      text << "pole trend,pole plunge\n" << trend << "," << plunge << "\n";
      CAPTURE(text.str());
      const Vec3 normal = upward_normal(read(text.str()).planes[0].plane);
      const auto [down, level] = repeatable::sine_cosine(plunge * degree);
      const auto [east, north] = repeatable::sine_cosine(trend * degree);
      CHECK(std::abs(normal.x() + level * east) < 1e-12);
      CHECK(std::abs(normal.y() + level * north) < 1e-12);
      CHECK(std::abs(normal.z() - down) < 1e-12);
    }
  }

  TEST_CASE("a trend and a plunge that are not told to be of a pole are refused") {
    const std::string sentence =
        "accepted: of poles (normals) columns named pole trend and pole plunge; lineations are not "
        "read";
    for (const char* header : {"trend,plunge", "Plunge,Trend", "azimuth,plunge", "set,Azi,Plunge",
                               "bearing,plunge", "trend [deg],plunge [deg]"}) {
      CAPTURE(header);
      const std::string told = refusal(std::string(header) + "\n120,45,1\n");
      CHECK(contains(told,
                     "survey.csv:1: trend and plunge of a line: is it the pole of the plane "
                     "or a lineation? in \"" +
                         std::string(header) + "\""));
      CHECK(contains(told, sentence));
    }
    CHECK(contains(refusal("pole trend,set\n1,1\n"), "a pole's trend without its plunge in"));
    CHECK(contains(refusal("pole plunge,azimuth\n1,1\n"), "a pole's plunge without its trend in"));
    CHECK(contains(refusal("pole trend,pole azimuth,plunge\n1,1,1\n"),
                   "two columns mean the same, \"pole trend\""));
    CHECK(contains(refusal("pole trend,pole plunge\n370,45\n"),
                   "survey.csv:2: pole trend = 370 in \"370,45\"; accepted: 0 to 360 degrees"));
    CHECK(contains(refusal("pole trend,pole plunge\n30,-5\n"),
                   "survey.csv:2: pole plunge = -5, upward: the same pole plunges 5 towards 210 in "
                   "\"30,-5\"; accepted: 0 to 90 degrees, downward"));
    CHECK(contains(refusal("pole trend,pole plunge\n300,95\n"),
                   "pole plunge = 95, beyond upright: the same pole plunges 85 towards 120 in"));
    CHECK(contains(refusal("pole trend,pole plunge\n300,200\n"), "pole plunge = 200 in"));
    CHECK(contains(refusal("pole trend,pole plunge\n300,60SE\n"),
                   "field 2 (column 5, \"60SE\") is not a finite number in"));
    CHECK(contains(refusal("pole trend,pole plunge\nSE,60\n"), "has no angle: letters alone name"));
  }

  TEST_CASE("a plane and a line in one table: the plane, or the pole of a strike without rule") {
    const OrientationFile plane = read("dip,dd,trend,plunge\n30,40,100,10\n");
    CHECK(is(plane.planes[0], 30, 40));
    CHECK(has_note(plane, "not read: trend, plunge"));
    CHECK(is(read("dip,dd,pole trend,pole plunge\n30,40,220,60\n").planes[0], 30, 40));
    const OrientationFile pole = read("strike,dip,pole trend,pole plunge\n130,30,220,60\n");
    CHECK(is(pole.planes[0], 30, 40));
    CHECK(has_note(pole, "not read: strike, dip"));
    CHECK(is(read("strike,dip,trend,plunge\n310,30NE,100,10\n").planes[0], 30, 40));
    CHECK(is(read("azimuth,pole trend,pole plunge,trend\n5,220,60,7\n").planes[0], 30, 40));
  }

  TEST_CASE("quadrant notation is the planes of its dips and dip directions, exactly") {
    const auto strike = [](const Whole& plane) { return (plane.direction + 270) % 360; };
    const auto other_end = [](const Whole& plane) { return (plane.direction + 90) % 360; };
    const auto dip = [](const Whole& plane) { return std::to_string(plane.dip); };
    // Every plane by either end of its strike, by a quadrant or a cardinal point, in all spellings.
    CHECK(unlike_plain("strike;dip", [&](const Whole& plane) {
            return bearing(strike(plane)) + ";" + dip(plane) + quadrant_of(plane.direction);
          }) == "");
    CHECK(unlike_plain("Strike;Dip", [&](const Whole& plane) {
            return bearing(other_end(plane), " ") + ";" + dip(plane) + " " +
                   cardinal_of(plane.direction);
          }) == "");
    CHECK(unlike_plain("STRIKE [deg];DIP [deg]", [&](const Whole& plane) {
            return bearing(other_end(plane), "", "\xC2\xB0") + ";" + dip(plane) + "\xC2\xB0" +
                   quadrant_of(plane.direction);
          }) == "");
    CHECK(unlike_plain("dip strike (quadrant)", [&](const Whole& plane) {
            return dip(plane) + quadrant_of(plane.direction) + " " + bearing(strike(plane));
          }) == "");
    // A strike by azimuth, with the side in letters; with a rule, too, if both agree.
    CHECK(unlike_plain("strike;dip", [&](const Whole& plane) {
            return std::to_string(other_end(plane)) + ";" + dip(plane) +
                   quadrant_of(plane.direction);
          }) == "");
    CHECK(unlike_plain("strike (LHR);dip", [&](const Whole& plane) {
            return std::to_string(other_end(plane)) + ";" + dip(plane) +
                   quadrant_of(plane.direction);
          }) == "");
    CHECK(unlike_plain("strike (RHR);dip", [&](const Whole& plane) {
            return std::to_string(strike(plane)) + ";" + dip(plane) + quadrant_of(plane.direction);
          }) == "");
    // A strike in quadrant notation is a line under any header.
    CHECK(unlike_plain("strike (RHR);dip", [&](const Whole& plane) {
            return bearing(other_end(plane)) + ";" + dip(plane) + quadrant_of(plane.direction);
          }) == "");
    // A dip direction.
    CHECK(unlike_plain("dip;dip direction", [&](const Whole& plane) {
            return dip(plane) + ";" + bearing(plane.direction);
          }) == "");
    CHECK(unlike_plain("dip;dip direction", [&](const Whole& plane) {
            return dip(plane) + quadrant_of(plane.direction) + ";" +
                   std::to_string(plane.direction);
          }) == "");
    // Mixed rows.
    CHECK(unlike_plain("dip;dip direction", [&](const Whole& plane) {
            return dip(plane) + ";" +
                   (plane.direction % 2 == 0 ? bearing(plane.direction)
                                             : std::to_string(plane.direction));
          }) == "");
    CHECK(unlike_plain("strike rhr;dip", [&](const Whole& plane) {
            return plane.direction % 2 == 0
                       ? bearing(other_end(plane)) + ";" + dip(plane) + quadrant_of(plane.direction)
                       : std::to_string(strike(plane)) + ";" + dip(plane);
          }) == "");
  }

  TEST_CASE("every quadrant of the strike and every side of it") {
    const auto direction = [](const std::string& row) {
      return read("strike;dip\n" + row + "\n").planes[0].plane.dip_direction / degree;
    };
    for (const auto& [row, expected] :
         std::vector<std::pair<const char*, double>>{{"N45E;60SE", 135},
                                                     {"N45E;60NW", 315},
                                                     {"N45E;60S", 135},
                                                     {"N45E;60E", 135},
                                                     {"N45E;60N", 315},
                                                     {"N45E;60W", 315},
                                                     {"S45W;60SE", 135},
                                                     {"S45W;60NW", 315},
                                                     {"N30W;60NE", 60},
                                                     {"N30W;60SW", 240},
                                                     {"S30E;60NE", 60},
                                                     {"S30E;60SW", 240},
                                                     {"S30W;60SE", 120},
                                                     {"S30W;60W", 300},
                                                     {"N;60E", 90},
                                                     {"N;60W", 270},
                                                     {"S;60NE", 90},
                                                     {"NS;60SW", 270},
                                                     {"N-S;60E", 90},
                                                     {"SN;60W", 270},
                                                     {"E;60N", 0},
                                                     {"E;60S", 180},
                                                     {"W;60NW", 0},
                                                     {"EW;60SE", 180},
                                                     {"E-W;60N", 0},
                                                     {"WE;60S", 180},
                                                     {"N0W;60E", 90},
                                                     {"N0E;60E", 90},
                                                     {"N90W;60S", 180},
                                                     {"n45e;60se", 135},
                                                     {"N 45 E;60 SE", 135},
                                                     {"N45\xC2\xB0 E;60\xC2\xB0 SE", 135},
                                                     {"N45\xBA"
                                                      "E;60\xBASE",
                                                      135},
                                                     {"045;60SE", 135},
                                                     {"225;60SE", 135},
                                                     {"N10E;60NE", 100},
                                                     {"N45E;90SE", 135},
                                                     {"N45E;90NW", 315},
                                                     {"N45E;90", 135},
                                                     {"N45E;0", 135},
                                                     {"E-W;0", 180},
                                                     {"N45.5E;60SE", 135.5},
                                                     {"N45,5E;60SE", 135.5},
                                                     {"S0W;60E", 90},
                                                     {"N22.5E;60N", 292.5}}) {
      const std::string text = row;  // clang++ 14 captures no structured binding
      CAPTURE(text);
      const double found = direction(text);
      CHECK(std::abs(found - expected) < 1e-12 * 360);
    }
    CHECK(read("strike;dip\nN45E;60.5SE\n").planes[0].plane.dip == near(60.5 * degree));
    const OrientationFile file = read("strike,dip\nN45E,60SE\n30,90\n120,20SW\n");
    CHECK(file.layout ==
          "fields separated by ,, columns by the header, strike with the side of the dip, quadrant "
          "notation, angles in degrees");
    CHECK(has_note(file, "quadrant notation in 2 of 3 planes: the letters of a dip tell its side"));
    CHECK(contains(read("dip,dd\n30,S45E\n").layout, "dip direction, quadrant notation, angles"));
    CHECK(has_note(read("dip,dd\n30,S45E\n"), "quadrant notation in 1 of 1 planes"));
    CHECK_FALSE(contains(read("dip,dd\n30,45\n").layout, "quadrant"));
    CHECK_FALSE(has_note(read("dip,dd\n30SE,130\n"), "across which"));
  }

  TEST_CASE("strike and dip in one column are those of two columns") {
    const auto strike = [](const Whole& plane) { return (plane.direction + 90) % 360; };
    const auto dip = [](const Whole& plane) {
      return std::to_string(plane.dip) + quadrant_of(plane.direction);
    };
    for (const char* header : {"Orientation", "ATTITUDE", "Strike/Dip", "Strike & Dip [deg]",
                               "strike and dip (quadrant)"}) {
      CAPTURE(header);
      CHECK(unlike_plain(header, [&](const Whole& plane) {
              return bearing(strike(plane)) + "/" + dip(plane);
            }) == "");
    }
    // Other signs between, other columns before and behind, a strike by azimuth.
    CHECK(unlike_plain("No;Orientation;Set", [&](const Whole& plane) {
            return "7;" + bearing(strike(plane), "", "\xC2\xB0") + " / " + dip(plane) + ";J1";
          }) == "");
    CHECK(unlike_plain("No;Orientation", [&](const Whole& plane) {
            return "7;" + bearing(strike(plane), " ") + ", " + dip(plane);
          }) == "");
    CHECK(unlike_plain("No;Orientation", [&](const Whole& plane) {
            return "7;" + bearing(strike(plane), " ") + " " + dip(plane);
          }) == "");
    CHECK(unlike_plain("No,Orientation", [&](const Whole& plane) {
            return "7,\"" + bearing(strike(plane)) + ", " + dip(plane) + "\"";
          }) == "");
    CHECK(unlike_plain("Orientation", [&](const Whole& plane) {
            return std::to_string(strike(plane)) + "/" + dip(plane);
          }) == "");
    const OrientationFile file = read("No;Orientation;Set\n1;N45,5E/60SE;B\n2;N-S/30W;A\n");
    REQUIRE(file.planes.size() == 2);
    CHECK(is(file.planes[0], 60, 135.5));
    CHECK(is(file.planes[1], 30, 270));
    CHECK(file.set_names == std::vector<std::string>{"B", "A"});
    CHECK(file.planes[1].set == 1);
    CHECK(file.layout ==
          "fields separated by ;, decimal comma, columns by the header, strike with the side of "
          "the dip, both in one column, quadrant notation, angles in degrees");
    CHECK(has_note(file, "columns that are not read: No"));
    CHECK(file.notes.size() == 2);
  }

  TEST_CASE("two numbers in one column are in the order of its name, or refused") {
    CHECK(is(read("Dip/Dip direction\n60/135\n").planes[0], 60, 135));
    CHECK(is(read("DipDir/Dip;Set\n135/060;1\n").planes[0], 60, 135));
    CHECK(is(read("Dip direction/Dip [gon]\n150/50\n").planes[0], 45, 135));
    CHECK(is(read("Strike/Dip (RHR)\n045/60\n").planes[0], 60, 135));
    CHECK(contains(refusal("Strike/Dip\n045/60\n"), "survey.csv:1: strike without rule"));
    CHECK(refusal("No;Orientation\n1;N45E/60SE\n2;135/60\n") ==
          "survey.csv:3: field 2 (column 3, \"135/60\") is two numbers: which of them is the dip, "
          "and is the other a strike or a dip direction? The name of the column, \"Orientation\", "
          "does not say in \"2;135/60\"; accepted: a column named dip/dip direction, dip "
          "direction/dip or strike/dip (RHR); or strike and dip with letters, as N45E/60SE or "
          "045/60SE");
  }

  TEST_CASE("a column of planes yields to clearer ones, and is refused where it is damaged") {
    const OrientationFile beside = read("Orientation,Dip,Dip direction\nN45E/60SE,30,40\n");
    CHECK(is(beside.planes[0], 30, 40));
    CHECK(has_note(beside, "not read: Orientation"));
    // Dips has a title that names two angles; the line that follows holds none.
    CHECK(is(read("DIP/DIPDIRECTION\n0\nID,Dip,Dip Direction\n1,30,40\n").planes[0], 30, 40));
    const auto one = [](const std::string& field) {
      return refusal("Orientation;Set\nN45E/60SE;1\n" + field + ";1\n");
    };
    CHECK(one("N45E") ==
          "survey.csv:3: field 1 (column 1, \"N45E\") is not two angles in \"N45E;1\"; accepted: "
          "strike and dip with letters, as N45E/60SE or 045/60SE");
    CHECK(contains(one("N 45 E"), "field 1 (column 1, \"N 45 E\") is not two angles"));
    CHECK(contains(one(""), "field 1 (column 1, \"\") is empty"));
    CHECK(contains(one("N45E/60"),
                   "survey.csv:3: to which side of its strike is the dip of 60? in \"N45E/60;1\"; "
                   "accepted: dips with the letters of their side: 60SE or 60NW"));
    CHECK(contains(one("N45E/60NE"), "the dip towards NE is along the strike, 45 degrees"));
    CHECK(contains(one("N45E/60QQ"), "field 1 (column 6, \"60QQ\") is not a finite number"));
    CHECK(contains(one("60SE/N45E"), "field 1 (column 6, \"N45E\") is not a finite number"));
    CHECK(contains(one("N45E/95SE"), "dip = 95 in"));
    CHECK(contains(refusal("No;Orientation;Set\n1;N45E/60SE;1\n2;N45E/60SE;1;x\n"),
                   "survey.csv:3: 4 fields instead of 3 in \"2;N45E/60SE;1;x\"; accepted: a field "
                   "for each column of the header, which is: No, Orientation, Set"));
  }

  TEST_CASE("quadrant notation that leaves the side open, or contradicts itself, is refused") {
    const auto one = [](const std::string& row) { return refusal("strike;dip\n" + row + "\n"); };
    CHECK(one("N45E;60") ==
          "survey.csv:2: to which side of its strike is the dip of 60? in \"N45E;60\"; accepted: "
          "dips with the letters of their side: 60SE or 60NW");
    CHECK(contains(refusal("strike rhr;dip\nN45E;60\n"), "to which side of its strike is the dip"));
    CHECK(contains(refusal("strike;dip\nN45E;60SE\n45;60\n"),
                   "survey.csv:3: to which side of its strike is the dip of 60? in \"45;60\""));
    CHECK(contains(one("45;60"), "survey.csv:1: strike without rule in \"strike;dip\""));
    for (const char* row : {"N45E;60NE", "N45E;60SW", "S45W;60NE", "45;60NE", "N44E;60NE", "N;60N",
                            "EW;60W", "N22E;60N", "N45E;90NE"}) {
      CAPTURE(row);
      CHECK(contains(one(row), " is along the strike, "));
    }
    CHECK(contains(one("N45E;60NE"),
                   "survey.csv:2: the dip towards NE is along the strike, 45 degrees in "
                   "\"N45E;60NE\"; accepted: letters of the side to which the plane dips, across "
                   "its strike: SE or NW"));
    CHECK(contains(refusal("strike (RHR);dip\n45;60NW\n"),
                   "survey.csv:2: the dip towards NW contradicts the right-hand rule: with it the "
                   "dip direction is 135 in \"45;60NW\"; accepted: letters on the right of the "
                   "strike"));
    CHECK(contains(refusal("dip;dip direction\n60NW;130\n"),
                   "the dip towards NW contradicts the dip direction, 130 in"));
    CHECK(contains(refusal("dip;dip direction\n60NW;S45E\n"), "contradicts the dip direction"));
  }

  TEST_CASE("damaged quadrant notation is refused by line, value and what is accepted") {
    const auto one = [](const std::string& row) { return refusal("strike;dip\n" + row + "\n"); };
    CHECK(one("N95E;60SE") ==
          "survey.csv:2: field 1 (column 1, \"N95E\") has an angle above 90 in \"N95E;60SE\"; "
          "accepted: a number in each column of angles or weights, a strike also as N45E, S30W, N, "
          "E, NS or EW");
    CHECK(contains(one("N45X;60SE"), "field 1 (column 1, \"N45X\") is not a finite number in"));
    CHECK(contains(one("E45N;60SE"), "(column 1, \"E45N\") does not begin with N or S in"));
    CHECK(contains(one("NE45E;60SE"), "does not begin with N or S in"));
    CHECK(contains(one("N45;60SE"), "does not end with E or W in"));
    CHECK(contains(one("N45S;60SE"), "does not end with E or W in"));
    CHECK(contains(one("45E;60SE"), "has an angle with letters behind it only, as a dip has in"));
    CHECK(contains(one("NE;60SE"), "has no angle between its letters in"));
    CHECK(contains(one("-N45E;60SE"), "is not a finite number"));
    CHECK(contains(one("N-45E;60SE"), "is not a finite number"));
    CHECK(contains(one("N4 5E;60SE"), "is not a finite number"));
    CHECK(contains(one("N1.045,5E;60SE"), "thousands are grouped"));
    CHECK(contains(one(";60SE"), "field 1 (column 1, \"\") is empty"));
    CHECK(contains(one("N45E;"), "field 2 (column 6, \"\") is empty"));
    CHECK(
        contains(one("N45E;60QQ"),
                 "field 2 (column 6, \"60QQ\") is not a finite number in \"N45E;60QQ\"; accepted: "
                 "a number in each column of angles or weights, a dip also with the side"));
    CHECK(contains(one("N45E;60SES"), "ends with no point of the compass"));
    CHECK(contains(one("N45E;60SN"), "ends with no point of the compass"));
    CHECK(contains(one("N45E;S"), "(column 6, \"S\") has no angle before its letters in"));
    CHECK(contains(one("N45E;SE60"), "is not a finite number"));
    CHECK(contains(one("N45E;-60SE"), "is not a finite number"));
    CHECK(contains(one("N45E;95SE"), "dip = 95 in \"N45E;95SE\"; accepted: 0 to 90 degrees"));
    CHECK(contains(one("N45E;1e1SE"), "is not a finite number"));
    CHECK(contains(one("361;60SE"), "strike = 361 in"));
    CHECK(contains(one("N45,5E;60SE\nN45.5E;60SE"), "has a decimal point, line 2 a decimal comma"));
    CHECK(contains(refusal("dip;dip direction\n30;SE\n"),
                   "has no angle: letters alone name a side, not a direction in \"30;SE\"; "
                   "accepted: a number in each column of angles or weights, a direction also as "
                   "S45E"));
    CHECK(contains(refusal("dip;dip direction\n30;NS\n"), "has no angle"));
    // A table whose side is in a third column, where it is no direction.
    CHECK(contains(refusal("strike;dip;dip direction\nN45E;60;SE\n"),
                   "a side alone, SE, stands behind a dip beside its strike"));
    CHECK(refusal("45,x\n").ends_with("accepted: a number in each column of angles or weights"));
    CHECK(contains(refusal("dip;dip direction;weight\n30;S45E;2E\n"), "is not a finite number"));
    CHECK(contains(refusal("strike [gon];dip [gon]\nN45E;60SE\n"),
                   "is in quadrant notation, which is in degrees; the header says gon in"));
    CHECK(contains(refusal("N45E,60SE\n"),
                   "survey.csv:1: field 1 (column 1, \"N45E\") is in quadrant notation, and there "
                   "is no header in \"N45E,60SE\"; accepted: a header: columns dip"));
    CHECK(contains(refusal("strike dip\nN 45 E 60 SE\n"),
                   "5 fields instead of 2: where blanks separate fields, N 45 E must be written "
                   "N45E"));
  }

  TEST_CASE("a header that names no plane, or something twice, is refused") {
    // Once, not for every row below it.
    const std::string nameless = refusal("ID;Orient1;Orient2\n1;52;202\n2;65;15\n");
    CHECK(
        nameless.starts_with("survey.csv:1: the header names neither a dip nor a direction in "
                             "\"ID;Orient1;Orient2\"; accepted: columns dip and dip direction"));
    CHECK_FALSE(contains(nameless, ":2:"));
    CHECK(contains(refusal("dip,set\n30,1\n"),
                   "survey.csv:1: a dip without a direction in \"dip,set\"; accepted: columns dip "
                   "and dip direction (or strike (RHR), with the dip to its right)"));
    CHECK(contains(refusal("set,dip direction\n1,30\n"),
                   "survey.csv:1: a direction without a dip in \"set,dip direction\""));
    CHECK(contains(refusal("dip,dip angle,dd\n30,30,1\n"),
                   "survey.csv:1: two columns mean the same, \"dip\" in"));
    CHECK(contains(refusal("dip,dd,weight,count\n30,30,1,1\n"),
                   "two columns mean the same, \"weight\""));
    CHECK(contains(refusal("dip [grad],dd [grad]\n30,30\n"),
                   "survey.csv:1: the unit \"grad\" of an angle is not known in \"dip [grad],dd "
                   "[grad]\"; accepted: deg, rad or gon (400 to the turn), in brackets"));
    CHECK(contains(refusal("dip [deg],dd [gon]\n30,30\n"),
                   "survey.csv:1: units are mixed, degrees and gon"));
    CHECK(has_note(read("dip,dip direction (magnetic)\n30,130\n"),
                   "dip direction (magnetic): taken as it stands, no magnetic declination"));
    CHECK(is(read("dip,dip direction (true)\n30,130\n").planes[0], 30, 130));
  }

  TEST_CASE("angles and weights out of range are refused by line, value and range") {
    const auto one = [](const std::string& row) {
      return refusal("dip,dip direction,weight\n" + row + "\n");
    };
    CHECK(one("95,40,1") ==
          "survey.csv:2: dip = 95, beyond upright: the same plane dips 85 towards 220 in "
          "\"95,40,1\"; accepted: 0 to 90 degrees, downward");
    CHECK(contains(one("100.5,340,1"), "the same plane dips 79.5 towards 160 in"));
    CHECK(contains(one("-5,40,1"), "survey.csv:2: dip = -5 in \"-5,40,1\"; accepted: 0 to 90"));
    CHECK(one("200,40,1") ==
          "survey.csv:2: dip = 200 in \"200,40,1\"; accepted: 0 to 90 degrees, downward; are the "
          "columns of dip and dip direction swapped?");
    CHECK_FALSE(contains(one("200,140,1"), "swapped"));
    CHECK(contains(refusal("strike rhr,dip\n40,200\n"), "of dip and strike swapped?"));
    CHECK(contains(one("30,360.5,1"),
                   "survey.csv:2: dip direction = 360.5 in \"30,360.5,1\"; accepted: 0 to 360 "
                   "degrees, clockwise from North"));
    CHECK(contains(one("30,-10,1"), "dip direction = -10 in"));
    CHECK(contains(one("30,40,0"),
                   "survey.csv:2: weight = 0 in \"30,40,0\"; accepted: a weight > 0"));
    CHECK(contains(one("30,40,-1"), "weight = -1 in"));
    CHECK(contains(one("30,40,"), "field 3 (column 7, \"\") is empty"));
    CHECK(contains(refusal("strike rhr,dip\n361,30\n"),
                   "strike = 361 in \"361,30\"; accepted: 0 to 360"));
    // In the unit of the file.
    CHECK(contains(refusal("dip [gon],dd [gon]\n110,40\n"),
                   "dip = 110, beyond upright: the same plane dips 90 towards 240 in \"110,40\"; "
                   "accepted: 0 to 100 gon"));
    CHECK(contains(refusal("dip [rad],dd [rad]\n45,1\n"), "accepted: 0 to 1.5708 radians"));
    // Rounded to three digits, a right angle and a full turn are a little more.
    const OrientationFile rounded = read("dip [rad],dd [rad]\n1.571,6.284\n");
    CHECK(rounded.planes[0].plane.dip == std::numbers::pi / 2);
    CHECK(rounded.planes[0].plane.dip_direction == 0);
  }

  TEST_CASE("fields that are no numbers, too few, too many, or separated otherwise") {
    CHECK(contains(refusal("dip,dd\nN45E,30\n"),
                   "survey.csv:2: field 1 (column 1, \"N45E\") is not a finite number in "
                   "\"N45E,30\"; accepted: a number in each column of angles or weights"));
    CHECK(contains(refusal("dip,dd\n45 deg,30\n"), "a unit belongs into the header, dip [deg]"));
    CHECK(contains(refusal("dip;dd\n1.045,5;30\n"), "thousands are grouped; write 45.5 without"));
    CHECK(contains(refusal("dip,dd\n30\n"),
                   "survey.csv:2: 1 fields instead of 2 in \"30\"; accepted: a field for each "
                   "column of the header, which is: dip, dd"));
    CHECK(contains(refusal("dip,dd\n30,40,50\n"), "3 fields instead of 2"));
    CHECK(contains(refusal("dip,dd\n30,5,40,5\n"),
                   "4 fields instead of 2: are these decimal commas?"));
    CHECK(contains(refusal("dip,dd\n30;40\n"), "this line is separated otherwise than the first"));
    CHECK(
        contains(refusal("dip;dd\n30,5;40\n30.5;40\n"),
                 "survey.csv:3: field 1 (column 1, \"30.5\") has a decimal point, line 2 a decimal "
                 "comma in \"30.5;40\"; accepted: one decimal sign in all of the file"));
  }

  TEST_CASE("five faults are told at once, the rest not") {
    const std::string five = refusal("dip,dd\n95,1\n96,1\n97,1\n98,1\n99,1\n100,1\n");
    for (const char* line : {":2:", ":3:", ":4:", ":5:", ":6:"}) CHECK(contains(five, line));
    CHECK_FALSE(contains(five, ":7:"));
    CHECK(contains(five, "survey.csv: reading ended there"));
    const std::string two = refusal("dip,dd\n95,1\n30,1\n97,1\n");
    CHECK(contains(two, ":2:"));
    CHECK(contains(two, ":4:"));
  }

  TEST_CASE("no planes, too many, too many sets, another format") {
    CHECK(contains(refusal(""), "survey.csv: holds no plane: it is empty; accepted: columns dip"));
    CHECK(contains(refusal("dip,dd\n# none\n\n"),
                   "holds no plane: 3 lines, all empty, header or comment"));
    OrientationFileLimits limits;
    limits.planes = 2;
    limits.sets = 2;
    CHECK(read("dip,dd\n1,2\n1,2\n", limits).planes.size() == 2);
    CHECK(contains(refusal("dip,dd\n1,2\n1,2\n1,2\n", limits),
                   "survey.csv:4: plane number 3 in \"1,2\"; accepted: at most 2 planes"));
    limits.planes = 10;
    CHECK(contains(refusal("dip,dd,set\n1,2,a\n1,2,b\n1,2,c\n", limits),
                   "survey.csv:4: set number 3 in \"1,2,c\"; accepted: at most 2 sets: is this a "
                   "column of sets, or a number for each plane?"));
    CHECK(refusal(std::string("PK\x03\x04 spreadsheet")) ==
          "survey.csv: this is a spreadsheet (.xlsx, .ods) or another ZIP archive: save it as CSV; "
          "accepted: a table of orientations as text");
    CHECK(contains(refusal("{\"a\": 1}"),
                   "JSON, which is not read yet: export dip and direction as CSV"));
    CHECK(contains(refusal(std::string("dip,dd\n1,2\0,3\n", 14)),
                   "holds a byte 0: this is no text; accepted: a table of orientations as text"));
    limits.line_length = 20;
    CHECK(contains(refusal("dip,dip direction,a long comment\n", limits),
                   "is this a file of orientations?"));
  }

  TEST_CASE("angles that look like radians are taken in degrees, and that is told") {
    CHECK(has_note(read("dip,dd\n1.1,6.1\n0.3,2\n1.5,0.2\n"), "if these are radians"));
    CHECK_FALSE(has_note(read("dip,dd\n1.1,6.1\n0.3,2\n15,2\n"), "radians"));
  }

  TEST_CASE("who does not want to go on is obeyed") {
    std::string text = "dip,dd\n";
    for (int k = 0; k < 200'000; ++k) text += "30,40\n";
    std::istringstream in(text);
    CHECK_THROWS_AS((void)read_orientations(in, "survey.csv", {}, [](double) { return false; }),
                    Stopped);
  }
}

}  // namespace orientation_file_test
