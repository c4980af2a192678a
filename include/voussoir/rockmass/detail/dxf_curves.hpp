// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/detail/dxf_chords.hpp>
#include <voussoir/rockmass/detail/dxf_entity.hpp>
#include <voussoir/rockmass/detail/dxf_left_out.hpp>

namespace voussoir::detail {

#if VOUSSOIR_BODIES

/// A corner of a polyline in the axes of its frame, and its bulge towards the next.
struct DxfCorner {
  Vec2 at;
  double bulge;
};

/// A POLYLINE whose vertices follow.
struct DxfOpenPolyline {
  DxfCurve curve;
  DxfFrame frame;
  bool is_read = true, is_spatial = false;
  double elevation = 0;  ///< [m]
  std::vector<DxfCorner> corners;
};

/// Makes polylines of the entities of a drawing, one after the other, and counts those that are
/// not read.
///
/// Source: Autodesk, DXF Reference (2018), "ENTITIES section".
class DxfCurves {
 public:
  struct Limits {
    double sagitta;      ///< [m]
    std::size_t points;  ///< of all polylines
  };
  DxfCurves(const Limits& limits, TraceFaults& faults) : limits_(limits), faults_(faults) {}

  /// Whether its groups are looked at.
  [[nodiscard]] static bool is_known(std::string_view type) {
    for (const char* known :
         {"LINE", "LWPOLYLINE", "POLYLINE", "VERTEX", "SEQEND", "ARC", "CIRCLE", "ELLIPSE"})
      if (type == known) return true;
    return false;
  }

  void use(const DxfUnits& units) { units_ = units; }

  /// @param reason  why it is not read, or null
  void add(DxfEntity& entity, const std::string& layer, int index, const char* reason) {
    entity_ = &entity;
    if (entity.type == "SEQEND") return end_polyline();  // of an INSERT: nothing is open
    if (entity.type == "VERTEX") return vertex();
    if (open_) fail(open_->curve.line, "POLYLINE without SEQEND", "POLYLINE", whole_again);
    open_.reset();
    if (reason != nullptr || !is_known(entity.type)) {
      if (reason != nullptr)
        left_out_.count(reason);
      else
        left_out_.add(entity, layer);
      if (entity.type != "POLYLINE") return;
      open_.emplace().is_read = false;
      open_->curve.line = entity.line;
      return;
    }
    curve_ = {{}, false, index, entity.line};
    if (entity.type == "POLYLINE") return begin_polyline();
    if (entity.type == "LINE") line();
    if (entity.type == "ARC" || entity.type == "CIRCLE") arc();
    if (entity.type == "ELLIPSE") ellipse();
    if (entity.type == "LWPOLYLINE") light_polyline();
    if (entity.is_good && !curve_.points.empty()) curves_.push_back(std::move(curve_));
  }

  /// Says what was refused. After the last entity.
  void finish() {
    if (open_) fail(open_->curve.line, "POLYLINE without SEQEND", "POLYLINE", whole_again);
    left_out_.finish(faults_);
  }
  [[nodiscard]] const std::vector<DxfCurve>& curves() const { return curves_; }
  [[nodiscard]] const DxfLeftOut& left_out() const { return left_out_; }

 private:
  static constexpr const char* whole_again = "entities that are whole: save the drawing again";
  void fail(std::size_t line, const std::string& what, std::string_view text,
            const std::string& accepted) {
    faults_.add(line, what, text, accepted);
  }
  void refuse_entity(const std::string& what, const std::string& accepted) {
    if (entity_->is_good) fail(entity_->line, entity_->type + what, entity_->type, accepted);
    entity_->is_good = false;
  }

  void add_point(const Vec3& p) {
    take(1);
    curve_.points.push_back(p);
  }
  /// As many points more, if they are allowed.
  void take(double count) {
    points_ += count;
    if (points_ <= static_cast<double>(limits_.points)) return;
    fail(entity_->line, "more points than are allowed, arcs as chords included", entity_->type,
         message({"drawings of up to ", limits_.points, " points; coarser arcs"}));
    faults_.finish();
  }
  [[nodiscard]] Vec3 point(int code, const DxfFrame& frame) {
    return entity_->point(code, frame, *units_, faults_);
  }
  [[nodiscard]] double number(int code, std::optional<double> absent) {
    return entity_->number(code, absent, faults_).value;
  }

  void line() {
    add_point(point(10, {}));
    add_point(point(11, {}));
  }

  void arc() {
    const bool is_circle = entity_->type == "CIRCLE";
    const DxfFrame frame = entity_->frame(faults_);
    const Vec3 centre = point(10, frame);
    const double radius = units_->local(entity_->number(40, std::nullopt, faults_), 0);
    const double start = is_circle ? 0 : number(50, std::nullopt),
                 end = is_circle ? 360 : number(51, std::nullopt);
    if (!(radius > 0 && radius <= 1e9))
      return refuse_entity(": its radius is not > 0, or above 1e9 m", "a radius > 0");
    double angle = std::fmod(end - start, 360);  // anticlockwise from start to end
    if (angle < 0) angle += 360;
    const bool is_full = angle < 1e-9 || angle > 360 - 1e-9;
    if (is_full) angle = 360;
    curve_.is_closed = is_full;
    const double chords = chords_of_arc(angle / 360, radius, limits_.sagitta);
    if (!entity_->is_good) return;
    take(chords + 1);
    const int count = static_cast<int>(chords);
    for (int k = 0; k < (is_full ? count : count + 1); ++k) {
      const Vec2 to = direction_of_degrees(k == count ? end : start + angle * k / count);
      curve_.points.push_back(centre + (radius * to.x()) * frame.u + (radius * to.y()) * frame.v);
    }
  }

  void ellipse() {
    constexpr double turn = 2 * std::numbers::pi;
    const DxfFrame frame = entity_->frame(faults_);
    const Vec3 centre = point(10, {});  // in the drawing, unlike those of an arc
    const Vec3 major =
        units_->metres() * Vec3(number(11, std::nullopt), number(21, std::nullopt), number(31, 0));
    const double ratio = number(40, std::nullopt), start = number(41, 0), end = number(42, turn);
    const double radius = length_of(major);
    if (!(radius > 0 && radius <= 1e9 && ratio > 0 && ratio <= 1 && std::abs(start) < 1e4 &&
          std::abs(end) < 1e4))
      return refuse_entity(": its axes or its angles are out of range",
                           "axes > 0 and angles [rad]");
    if (!entity_->is_good) return;
    double angle = std::fmod(end - start, turn);
    if (angle < 0) angle += turn;
    const bool is_full = angle < 1e-9 || angle > turn - 1e-9;
    if (is_full) angle = turn;
    curve_.is_closed = is_full;
    // A chord over the step h lies h^2 / 8 of the long half axis from the curve, or less.
    const double chords = std::ceil(
        angle / std::min(0.25 * std::numbers::pi, std::sqrt(8 * limits_.sagitta / radius)) - 1e-9);
    take(chords + 1);
    const int count = static_cast<int>(chords);
    const Vec3 minor = ratio * cross<3>(frame.normal, major);
    for (int k = 0; k < (is_full ? count : count + 1); ++k) {
      const auto [s, c] = elementary::sine_cosine(start + angle * k / count);
      curve_.points.push_back(centre + c * major + s * minor);
    }
  }

  /// Corners and bulges as points of the curve.
  void bend(const std::vector<DxfCorner>& corners, const DxfFrame& frame, double elevation) {
    const std::size_t size = corners.size();
    const auto place = [&](const Vec2& p) {
      curve_.points.push_back(p.x() * frame.u + p.y() * frame.v + elevation * frame.normal);
    };
    for (std::size_t k = 0; k < size; ++k) {
      take(1);
      place(corners[k].at);
      if (k + 1 == size && !curve_.is_closed) break;
      const Vec2 &a = corners[k].at, &b = corners[(k + 1) % size].at;
      if (a == b || std::abs(corners[k].bulge) < 1e-15) continue;
      const BulgeArc arc(a, b, corners[k].bulge);
      const double chords =
          chords_of_arc(arc.half_angle / std::numbers::pi, arc.radius, limits_.sagitta);
      take(chords - 1);
      for (int i = 1; i < static_cast<int>(chords); ++i) place(arc.at(i / chords));
    }
  }

  [[nodiscard]] static Vec2 in_frame(const Vec3& p, const DxfFrame& frame) {
    return {dot_product(p, frame.u), dot_product(p, frame.v)};
  }

  void light_polyline() {
    const DxfFrame frame = entity_->frame(faults_);
    curve_.is_closed = (entity_->whole(70, faults_) & 1) != 0;
    const DxfGroup* const elevation = entity_->find(38);
    DxfEntity vertex{entity_->type, entity_->line, {}, true};
    std::vector<DxfCorner> corners;
    Vec3 at = zeros<Vec3>();
    const auto end_vertex = [&] {
      if (vertex.groups.empty()) return;
      if (elevation != nullptr) vertex.groups.push_back({30, elevation->value, elevation->line});
      at = vertex.point(10, frame, *units_, faults_);
      corners.push_back({in_frame(at, frame), vertex.number(42, 0, faults_).value});
      entity_->is_good = entity_->is_good && vertex.is_good;
      vertex.groups.clear();
      vertex.is_good = true;
    };
    for (const DxfGroup& group : entity_->groups) {
      if (group.code == 10) end_vertex();
      if (group.code == 10 || group.code == 20 || group.code == 42) {
        if (group.code == 10 || !vertex.groups.empty()) vertex.groups.push_back(group);
      }
      if (!entity_->is_good) return;
    }
    end_vertex();
    if (const int told = entity_->whole(90, faults_);
        entity_->find(90) && static_cast<std::size_t>(told) != corners.size())
      return refuse_entity(message({" of ", told, " points has ", corners.size()}), whole_again);
    bend(corners, frame, dot_product(at, frame.normal));
  }

  void begin_polyline() {
    const int flags = entity_->whole(70, faults_);
    if ((flags & (16 | 64)) != 0)
      refuse_entity(" is a mesh", "lines and polylines: explode it (EXPLODE), or leave it out");
    open_.emplace();
    open_->curve = std::move(curve_);
    open_->curve.is_closed = (flags & 1) != 0;
    open_->is_spatial = (flags & 8) != 0;
    if (!open_->is_spatial) open_->frame = entity_->frame(faults_);
    const DxfGroup* const elevation = entity_->find(30);
    elevation_ = elevation != nullptr ? *elevation : DxfGroup{30, "0", entity_->line};
    open_->is_read = entity_->is_good;
  }

  void vertex() {
    if (!open_) return refuse_entity(" without a POLYLINE", whole_again);
    if (!open_->is_read) return;
    const int flags = entity_->whole(70, faults_);
    if ((flags & 16) != 0) return;  // a corner of the frame of a smoothed polyline
    if (!open_->is_spatial) {
      std::erase_if(entity_->groups, [](const DxfGroup& group) { return group.code == 30; });
      entity_->groups.push_back(elevation_);
    }
    const Vec3 at = point(10, open_->frame);
    const double bulge = number(42, 0);
    open_->is_read = entity_->is_good;
    if (open_->is_spatial) {
      take(1);
      open_->curve.points.push_back(at);
    } else {
      open_->elevation = dot_product(at, open_->frame.normal);
      open_->corners.push_back({in_frame(at, open_->frame), bulge});
    }
  }

  void end_polyline() {
    if (!open_) return;
    if (open_->is_read) {
      curve_ = std::move(open_->curve);
      bend(open_->corners, open_->frame, open_->elevation);
      if (!curve_.points.empty()) curves_.push_back(std::move(curve_));
    }
    open_.reset();
  }

  Limits limits_;
  TraceFaults& faults_;
  std::optional<DxfUnits> units_;
  DxfEntity* entity_ = nullptr;
  DxfCurve curve_;  ///< of the entity
  std::vector<DxfCurve> curves_;
  std::optional<DxfOpenPolyline> open_;
  DxfGroup elevation_;  ///< of it
  double points_ = 0;
  DxfLeftOut left_out_;
};

#endif

}  // namespace voussoir::detail
