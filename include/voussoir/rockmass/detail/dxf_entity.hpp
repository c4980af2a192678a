// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/detail/dxf_chords.hpp>
#include <voussoir/rockmass/detail/dxf_pairs.hpp>
#include <voussoir/rockmass/detail/trace_table.hpp>

namespace voussoir::detail {

/// A number of a DXF and how many decimals it was written with; -1: an exponent.
struct DxfNumber {
  double value = 0;
  int decimals = 0;
};

/// From drawing units to metres from the site origin, to the digits that were written: what
/// TraceReader does for a whole table, here number by number.
class DxfUnits {
 public:
  VOUSSOIR_INLINE DxfUnits(double metres, const Vec2& origin);
  [[nodiscard]] double metres() const { return metres_; }
  [[nodiscard]] VOUSSOIR_INLINE double local(const DxfNumber& number, double origin) const;
  /// A point of the drawing; z is taken from the origin's y, for sections drawn in x and z.
  [[nodiscard]] Vec3 local(const std::array<DxfNumber, 3>& at) const {
    return {local(at[0], origin_.x()), local(at[1], origin_.y()), local(at[2], origin_.y())};
  }

 private:
  double metres_;
  Vec2 origin_;
  int shift_, origin_digits_ = 0;  ///< decimals of a metre more than of the unit
};

/// Axes of the coordinates of an entity [-], each along one of the drawing's.
struct DxfFrame {
  Vec3 u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};
  /// By the "arbitrary axis algorithm" (DXF Reference, "Object coordinate systems"): an entity seen
  /// from behind, with normal (0, 0, -1), has its x mirrored. Nothing if the normal is not +-y or
  /// +-z.
  [[nodiscard]] static VOUSSOIR_INLINE std::optional<DxfFrame> of(const Vec3& normal);
};

/// Polyline of an entity before it is known which two axes the section is drawn in.
struct DxfCurve {
  std::vector<Vec3> points;  ///< [m]
  bool is_closed = false;    ///< the first point is not repeated
  int layer = 0;
  std::size_t line = 0;
};

/// What is read from the groups of one entity. A fault is said once, with its line, and `is_good`
/// cleared.
struct DxfEntity {
  std::string type;
  std::size_t line = 0;  ///< of its name in the file
  std::vector<DxfGroup> groups;
  bool is_good = true;

  /// First group of that code, or null.
  [[nodiscard]] VOUSSOIR_INLINE const DxfGroup* find(int code) const;
  [[nodiscard]] VOUSSOIR_INLINE DxfNumber number(const DxfGroup& group, TraceFaults& faults);
  /// Of the first group of that code; without it `absent`, or a fault if there is none.
  [[nodiscard]] VOUSSOIR_INLINE DxfNumber number(int code, std::optional<double> absent,
                                                 TraceFaults& faults);
  [[nodiscard]] VOUSSOIR_INLINE int whole(int code, TraceFaults& faults);  ///< 0 if absent
  [[nodiscard]] VOUSSOIR_INLINE DxfFrame frame(TraceFaults& faults);
  /// Point of the codes `x`, x + 10 and x + 20, of which the last may be absent, in the drawing.
  [[nodiscard]] VOUSSOIR_INLINE Vec3 point(int x, const DxfFrame& frame, const DxfUnits& units,
                                           TraceFaults& faults);
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE DxfUnits::DxfUnits(double metres, const Vec2& origin)
    : metres_(metres),
      origin_(origin),
      shift_(metres == 1      ? 0
             : metres == 1e-3 ? 3
             : metres == 1e-2 ? 2
             : metres == 0.1  ? 1
             : metres == 1e3  ? -3
                              : 99) {
  const auto is_whole = [](double x) { return std::abs(x - std::round(x)) < 1e-3; };
  for (double scale = 1; origin_digits_ < 10; ++origin_digits_, scale *= 10)
    if (is_whole(origin.x() * scale) && is_whole(origin.y() * scale)) break;
}

VOUSSOIR_INLINE double DxfUnits::local(const DxfNumber& number, double origin) const {
  const double away = number.value * metres_ - origin;
  const int digits = std::max(
      {0, number.decimals < 0 ? 99 : number.decimals + shift_, origin == 0 ? 0 : origin_digits_});
  if (digits > 9) return away;  // what is beyond cannot be told apart at 1e9 m
  double scale = 1;
  for (int k = 0; k < digits; ++k) scale *= 10;
  return std::abs(away * scale) < 1e15 ? std::round(away * scale) / scale : away;
}

VOUSSOIR_INLINE std::optional<DxfFrame> DxfFrame::of(const Vec3& normal) {
  for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0, 1, 0), Vec3(0, -1, 0)})
    if (length_of(normal - n) < 1e-9) {
      const Vec3 u = n.z() != 0 ? cross<3>(Vec3(0, 1, 0), n) : cross<3>(Vec3(0, 0, 1), n);
      return DxfFrame{u, cross<3>(n, u), n};
    }
  return std::nullopt;
}

VOUSSOIR_INLINE const DxfGroup* DxfEntity::find(int code) const {
  for (const DxfGroup& group : groups)
    if (group.code == code) return &group;
  return nullptr;
}

VOUSSOIR_INLINE DxfNumber DxfEntity::number(const DxfGroup& group, TraceFaults& faults) {
  const WrittenNumber read = written_number(group.value);
  const bool is_number = read.fault.empty() && !read.has_comma;
  if (is_number && std::abs(read.value) <= 1e13) return {read.value, read.decimals};
  is_good = false;
  faults.add(group.line,
             message({type, ": group ", group.code, " ",
                      is_number        ? "is out of range"
                      : read.has_comma ? "has a decimal comma"
                                       : "is not a finite number"}),
             group.value, "a number with a decimal point, up to 1e9 m");
  return {};
}

VOUSSOIR_INLINE DxfNumber DxfEntity::number(int code, std::optional<double> absent,
                                            TraceFaults& faults) {
  if (const DxfGroup* const group = find(code)) return number(*group, faults);
  if (absent) return {*absent, 0};
  if (is_good)
    faults.add(line, message({type, " without its group ", code}), type,
               "entities with all their coordinates: save the drawing again");
  is_good = false;
  return {};
}

VOUSSOIR_INLINE int DxfEntity::whole(int code, TraceFaults& faults) {
  const double value = number(code, 0, faults).value;
  if (value == std::floor(value) && std::abs(value) < 1e9) return static_cast<int>(value);
  faults.add(find(code)->line, message({type, ": group ", code, " is no whole number"}),
             find(code)->value, "a whole number");
  is_good = false;
  return 0;
}

VOUSSOIR_INLINE DxfFrame DxfEntity::frame(TraceFaults& faults) {
  const Vec3 normal(number(210, 0, faults).value, number(220, 0, faults).value,
                    number(230, 1, faults).value);
  if (const auto found = DxfFrame::of(normal)) return *found;
  if (is_good)
    faults.add(line,
               type + " has the extrusion direction " + text_of<3>(normal) +
                   ": it is tilted against the section",
               type, "entities in x and y, or in x and z: flatten the drawing (FLATTEN)");
  is_good = false;
  return {};
}

VOUSSOIR_INLINE Vec3 DxfEntity::point(int x, const DxfFrame& frame, const DxfUnits& units,
                                      TraceFaults& faults) {
  const std::array<DxfNumber, 3> own{number(x, std::nullopt, faults),
                                     number(x + 10, std::nullopt, faults),
                                     number(x + 20, 0, faults)};
  std::array<DxfNumber, 3> at;
  for (int k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const double sign = (axis == 0 ? frame.u : axis == 1 ? frame.v : frame.normal)[k];
      const DxfNumber& written = own[static_cast<std::size_t>(axis)];
      if (sign != 0) at[static_cast<std::size_t>(k)] = {sign * written.value, written.decimals};
    }
  for (const DxfNumber& coordinate : at)
    if (is_good && !(std::abs(coordinate.value) * units.metres() <= 1e9)) {
      faults.add(line, type + ": a coordinate is out of range", type, "-1e9 to 1e9 m");
      is_good = false;
    }
  return units.local(at);
}

#endif

}  // namespace voussoir::detail
