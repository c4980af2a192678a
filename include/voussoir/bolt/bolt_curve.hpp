// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>
#include <voussoir/core/errors.hpp>

namespace voussoir {

/// What a bolt carries over how far it has been pulled, for the first time: straight from one point
/// to the next, from nothing on. Let go it follows the first slope.
///
/// Made of a slope or of points, then cut where something gives: `straight(k).yielding_at(...)`.
class BoltCurve {
 public:
  struct Point {
    double extension;  ///< [m], > that of the point before, 0 before the first
    double force;      ///< tension [N], no less than that of the point before
  };

  /// @param stiffness  [N/m], > 0
  /// @throws InvalidInput  it is not
  [[nodiscard]] static BoltCurve straight(double stiffness) {
    require(stiffness > 0 && std::isfinite(stiffness), "stiffness of a bolt", stiffness, "> 0 N/m");
    return BoltCurve({{1 / stiffness, 1}}, stiffness);
  }
  /// @param points  at least one; no slope steeper than the first
  /// @param beyond  slope after the last [N/m], >= 0
  /// @throws InvalidInput  they are not as above
  explicit BoltCurve(std::vector<Point> points, double beyond = 0)
      : points_(std::move(points)), beyond_(beyond) {
    if (points_.empty()) throw InvalidInput("curve of a bolt: needs at least one point");
    Point before{0, 0};
    for (const Point& point : points_) {
      require(point.extension > before.extension && std::isfinite(point.extension),
              "extension of a bolt in its curve", point.extension,
              "above that of the point before");
      require(point.force >= before.force && std::isfinite(point.force),
              "force of a bolt in its curve", point.force, "no less than at the point before");
      require(slope(before, point) <= stiffness() * (1 + rounding), "slope of the curve of a bolt",
              slope(before, point), "no steeper than its beginning");
      before = point;
    }
    require(stiffness() > 0, "stiffness of a bolt", stiffness(), "> 0 N/m");
    require(beyond >= 0 && beyond <= stiffness() * (1 + rounding),
            "slope beyond the curve of a bolt", beyond, "from 0 N/m to that of its beginning");
    sum_up();
  }

  /// The first slope, with which it is let go [N/m].
  [[nodiscard]] double stiffness() const { return slope({0, 0}, points_.front()); }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] const Point& last() const { return points_.back(); }
  /// Whether it is lost at the last point.
  [[nodiscard]] bool breaks() const { return breaks_; }
  /// The largest force that it carries [N]; infinite: no end to it.
  [[nodiscard]] double strength() const {
    return breaks_ || beyond_ == 0 ? last().force : std::numeric_limits<double>::infinity();
  }

  /// @param extension  [m]; below 0 nothing
  [[nodiscard]] double force(double extension) const {
    if (!(extension > 0)) return 0;
    if (extension >= last().extension)
      return last().force + (breaks_ ? 0 : beyond_ * (extension - last().extension));
    const std::size_t k = segment(extension);
    return between(start_of(k), points_[k], extension);
  }
  /// Work to there [J].
  [[nodiscard]] double work(double extension) const {
    if (!(extension > 0)) return 0;
    if (extension >= last().extension) {
      const double past = breaks_ ? 0 : extension - last().extension;
      return work_.back() + (last().force + 0.5 * beyond_ * past) * past;
    }
    const std::size_t k = segment(extension);
    const Point from = start_of(k);
    const double before = k > 0 ? work_[k - 1] : 0;
    return before +
           0.5 * (from.force + between(from, points_[k], extension)) * (extension - from.extension);
  }
  /// Where it first carries a force [m].
  /// @param force  [N], 0 to `strength`
  [[nodiscard]] double extension_at(double force) const {
    if (!(force > 0)) return 0;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (points_[k].force < force) continue;
      const Point from = start_of(k);
      return from.extension + (force - from.force) / slope(from, points_[k]);
    }
    return beyond_ > 0 ? last().extension + (force - last().force) / beyond_ : last().extension;
  }

  /// It gives at this force and keeps it: bond or an anchor that slips.
  /// @param force  [N], > 0
  [[nodiscard]] BoltCurve holding_at(double force) const { return cut_at(force, 0, false); }
  /// It is lost at this force: bar or plate that breaks.
  [[nodiscard]] BoltCurve breaking_at(double force) const { return cut_at(force, 0, true); }
  /// Beyond this force it goes on with a part of the first slope.
  /// @param ratio  [-], 0 to 1
  [[nodiscard]] BoltCurve yielding_at(double force, double ratio) const {
    return cut_at(force, ratio * stiffness(), false);
  }
  /// From its last point straight on to another, at which it is lost.
  /// @param longer  by how far [m], > 0
  /// @param force   there [N], no less than at the last
  [[nodiscard]] BoltCurve breaking_after(double longer, double force) const {
    std::vector<Point> points = points_;
    points.push_back({last().extension + longer, force});
    BoltCurve made(std::move(points));
    made.breaks_ = true;
    return made;
  }

 private:
  static constexpr double rounding = 1e-9;

  [[nodiscard]] static double slope(const Point& from, const Point& to) {
    return (to.force - from.force) / (to.extension - from.extension);
  }
  [[nodiscard]] static double between(const Point& from, const Point& to, double extension) {
    return from.force + slope(from, to) * (extension - from.extension);
  }
  [[nodiscard]] Point start_of(std::size_t k) const { return k > 0 ? points_[k - 1] : Point{0, 0}; }
  /// The one that holds an extension before the last point.
  [[nodiscard]] std::size_t segment(double extension) const {
    const auto end = std::upper_bound(points_.begin(), points_.end() - 1, extension,
                                      [](double e, const Point& p) { return e < p.extension; });
    return static_cast<std::size_t>(end - points_.begin());
  }
  [[nodiscard]] BoltCurve cut_at(double force, double beyond, bool breaks) const {
    require(force > 0, "force at which a bolt gives", force, "> 0 N");
    // At its strength too: a bolt that is lost there does not hold on.
    if (force > strength() || std::isinf(force)) return *this;
    const double end = extension_at(force);
    std::vector<Point> points;
    const bool is_straight = points_.size() == 1 && beyond_ >= stiffness() * (1 - rounding);
    for (const Point& point : points_)
      if (!is_straight && point.force < force && point.extension < end) points.push_back(point);
    points.push_back({end, force});
    BoltCurve made(std::move(points), beyond);
    made.breaks_ = breaks;
    return made;
  }
  void sum_up() {
    double sum = 0;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Point from = start_of(k);
      sum += 0.5 * (from.force + points_[k].force) * (points_[k].extension - from.extension);
      work_.push_back(sum);
    }
  }

  std::vector<Point> points_;
  std::vector<double> work_ = {};  ///< to each of them [J]
  double beyond_ = 0;
  bool breaks_ = false;
};

}  // namespace voussoir
