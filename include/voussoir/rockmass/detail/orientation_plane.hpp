// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <voussoir/core/bodies.hpp>
#include <voussoir/drawing/number_text.hpp>
#include <voussoir/rockmass/detail/orientation_table.hpp>
#include <voussoir/rockmass/detail/quadrant_angle.hpp>

namespace voussoir::detail {

/// An angle of a row, in the unit of the file.
struct WrittenAngle {
  double value = 0;
  bool is_bearing = false;  ///< an azimuth that was written in quadrant notation
  std::string side;         ///< letters of the side to which a plane dips; empty: none
};

/// Dip and dip direction of a row, in the unit of the file, or why it has none.
struct WrittenPlane {
  double dip = 0, direction = 0;
  std::string fault, accepted;  ///< empty if there is none
  bool lacks_rule = false;      ///< the fault: an azimuth of a strike without rule or letters
};

/// The plane of an azimuth and of a dip, or of the trend and the plunge of its pole in the lower
/// hemisphere: dip = 90 - plunge, dip direction = trend + 180. A strike in quadrant notation is a
/// line: it follows no rule, and only the letters of the dip tell the side. They do not tell the
/// dip direction itself, which is across the strike.
/// @param tilt    the dip or the plunge
/// @param column  of the azimuth
[[nodiscard]] VOUSSOIR_INLINE WrittenPlane plane_of(const WrittenAngle& tilt,
                                                    const WrittenAngle& azimuth,
                                                    OrientationColumn column,
                                                    const OrientationLayout& layout);

#if VOUSSOIR_BODIES

/// The dip direction of a row whose dip has letters, in degrees.
/// @param right      the direction if the dip is to the right of the strike
/// @param is_settled  the side is known without letters, which must agree
[[nodiscard]] VOUSSOIR_INLINE WrittenPlane sided_plane(const WrittenAngle& dip, double right,
                                                       bool is_settled, bool by_strike) {
  const double strike = right < 90 ? right + 270 : right - 90;
  const double left = right < 180 ? right + 180 : right - 180;
  const int side = side_of_strike(strike, azimuth_of_letters(dip.side).value_or(0));
  WrittenPlane plane{dip.value, side < 0 ? left : right, "", "", false};
  if (side == 0) {
    plane.fault = "the dip towards " + dip.side + " is along the strike, " +
                  trimmed_text(strike, 4) + " degrees";
    plane.accepted =
        "letters of the side to which the plane dips, across its strike: " + nearest_point(right) +
        " or " + nearest_point(left);
  } else if (side < 0 && is_settled) {
    plane.fault = "the dip towards " + dip.side + " contradicts ";
    plane.fault +=
        by_strike ? "the right-hand rule: with it the dip direction is " : "the dip direction, ";
    plane.fault += trimmed_text(right, 4);
    plane.accepted = by_strike ? "letters on the right of the strike, or a column named strike"
                               : "letters on the side of the dip direction";
  }
  return plane;
}

VOUSSOIR_INLINE WrittenPlane plane_of(const WrittenAngle& tilt, const WrittenAngle& azimuth,
                                      OrientationColumn column, const OrientationLayout& layout) {
  const bool by_pole = column == OrientationColumn::pole_trend,
             by_strike =
                 column == OrientationColumn::strike || column == OrientationColumn::right_strike;
  const double turn = layout.turn, half = 0.5 * turn, quarter = 0.25 * turn;
  const double slack = turn < 10 ? 1e-3 : 0;  // 1.571 rad is what is left of a right angle
  const auto text = [](double angle) { return trimmed_text(angle, 4); };
  const auto within = [&](double angle) { return angle >= turn ? angle - turn : angle; };
  WrittenPlane plane;
  if (!(azimuth.value >= 0 && azimuth.value <= turn + slack)) {
    plane.fault = by_pole ? "pole trend = " : by_strike ? "strike = " : "dip direction = ";
    plane.fault += text(azimuth.value);
    plane.accepted = "0 to " + text(turn) + " " + layout.unit + ", clockwise from North";
    return plane;
  }
  plane.dip = tilt.value;
  plane.direction = within(within(std::min(azimuth.value, turn)) + (by_pole     ? half
                                                                    : by_strike ? quarter
                                                                                : 0));
  const bool is_settled =
      !by_strike || (column == OrientationColumn::right_strike && !azimuth.is_bearing);
  if (!(tilt.value >= 0 && tilt.value <= quarter + slack)) {
    const bool is_beyond = tilt.value > quarter && tilt.value <= half;
    const bool is_upward = tilt.value < 0 && tilt.value >= -quarter;
    plane.fault = by_pole ? "pole plunge = " : "dip = ";
    plane.fault += text(tilt.value);
    if (by_pole && (is_beyond || is_upward)) {
      plane.fault += is_beyond ? ", beyond upright" : ", upward";
      plane.fault += ": the same pole plunges " +
                     text(is_beyond ? half - tilt.value : -tilt.value) + " towards " +
                     text(plane.direction);
    } else if (is_beyond && is_settled && tilt.side.empty()) {
      plane.fault += ", beyond upright: the same plane dips " + text(half - tilt.value) +
                     " towards " + text(within(plane.direction + half));
    }
    plane.accepted = "0 to " + text(quarter) + " " + layout.unit + ", downward";
    if (!by_pole && tilt.value > half && azimuth.value <= quarter)
      plane.accepted += std::string("; are the columns of dip and ") +
                        (by_strike ? "strike" : "dip direction") + " swapped?";
    return plane;
  }
  if (!tilt.side.empty()) return sided_plane(tilt, plane.direction, is_settled, by_strike);
  if (by_pole) plane.dip = std::max(quarter - tilt.value, 0.0);
  // A level or an upright plane has no side.
  if (!is_settled && tilt.value > 0 && tilt.value < quarter) {
    plane.lacks_rule = !azimuth.is_bearing;
    const std::string dip = text(tilt.value);
    plane.fault = "to which side of its strike is the dip of " + dip + "?";
    plane.accepted = "dips with the letters of their side";
    if (turn == 360)
      plane.accepted += ": " + dip + nearest_point(plane.direction) + " or " + dip +
                        nearest_point(plane.direction + 180);
  }
  return plane;
}

#endif

}  // namespace voussoir::detail
