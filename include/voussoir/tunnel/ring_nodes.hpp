// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/elementary.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/message_number.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/tunnel/opening_centre.hpp>
#include <voussoir/tunnel/outline_path.hpp>

namespace voussoir {

/// Nodes on the full outline of a lining: where no number is given, and at most.
inline constexpr int default_lining_nodes = 72, most_lining_nodes = 2000;
/// How far behind the outline a lining fills holes where it is not said [m].
inline constexpr double default_fill_depth = 0.5;

/// An end of an arc that turns round a corner by less than this, as seen from the centre, is put on
/// the corner [rad]: angles of corners are seldom round, and those of arcs are given by the degree.
inline constexpr double corner_tolerance = std::numbers::pi / 360;

/// A lining along the wall: the full ring, or an arc of it about the centre of the opening. An arc
/// that begins where one ends that stands joins it.
struct LiningRing {
  /// On the full outline, 8 to 2000; none: 72, or what a bond to the rock needs
  /// (`with_chosen_nodes`, asked by `construct`). So many parts of the outline are no shorter than
  /// the stretch of a node; those at its corners stand for none, and come besides.
  std::optional<int> nodes{};
  double from = 0;                   ///< [rad], anticlockwise from the right-hand springing
  double to = 2 * std::numbers::pi;  ///< [rad], from < to <= from + 2 pi
  std::optional<Vec2> centre{};      ///< about which angles are counted [m]; none: see `centre_of`
  /// Where pieces of rock were dropped (`carve`) or have fallen, it fills the holes up to this far
  /// behind the outline and bears on the rock there; what is deeper stays a gap, see
  /// `LiningFrame::gaps` [m], >= 0.
  double fill_depth = default_fill_depth;
};

namespace detail {

/// What of the outline a node stands for. One that goes on behind vertex 0 is two.
struct RingStretch {
  double begin, end;  ///< from vertex 0 along the outline [m]
  int node;           ///< index into `RingNodes::places`
};
/// An end of an arc.
struct RingEnd {
  int node;
  Vec2 place;                ///< where the lining ends, on the outline [m]
  Vec2 direction;            ///< in which it goes on, a unit vector
  bool is_after;             ///< what follows would, anticlockwise
  std::string refusal = {};  ///< why no foot can stand there; empty: one can, if there is rock

  /// At right angles to the direction, into the opening.
  [[nodiscard]] Vec2 inward() const {
    return is_after ? perpendicular(direction) : Vec2(-perpendicular(direction));
  }
};

/// Where the nodes of a ring lie on an outline.
///
/// Corners and ends of the arc are fixed. Between two of them the outline is divided into even
/// stretches, the fewest that are no longer than `stretch`; a node stands for each and lies in its
/// middle. At a corner lies one more, which stands for nothing (`is_bare`): members meet where the
/// walls do, and what is installed up to a corner is the ring at once. So nodes follow the ends of
/// the arc without a jump, and are the same in the mirror and whichever vertex comes first.
/// A ring on an outline without corners has stretches that end at the crown if a vertex is there,
/// else a node lies there.
struct RingNodes {
  double stretch;                        ///< the outline over the number of nodes [m]
  bool closed = false;                   ///< all the way round
  std::vector<Vec2> places;              ///< neighbours one after the other [m]
  std::vector<char> joined;              ///< for every node, whether a member joins it and the next
  std::vector<char> is_bare;             ///< for every node, whether it stands for no stretch
  std::vector<RingStretch> stretches{};  ///< from vertex 0 on
  std::vector<RingEnd> ends{};

  /// visit(node, begin, end): the stretches that a part of the outline reaches into [m].
  template <class Visit>
  void each_stretch(double from, double to, Visit&& visit) const {
    auto first = std::upper_bound(stretches.begin(), stretches.end(), from,
                                  [](double s, const RingStretch& at) { return s < at.end; });
    for (; first != stretches.end() && first->begin < to; ++first)
      visit(first->node, first->begin, first->end);
  }
};

/// @throws InvalidInput  a value out of range; fewer than two nodes in the arc
[[nodiscard]] VOUSSOIR_INLINE RingNodes ring_nodes(const SimplePolygon& opening,
                                                   const LiningRing& ring);

/// A straight part of the outline in the stretch of one node, opening on its left.
struct OutlinePart {
  int node;
  Segment edge;
};
/// @param shortest  parts that are no longer are left out [m]
[[nodiscard]] VOUSSOIR_INLINE std::vector<OutlinePart> outline_parts(const SimplePolygon& opening,
                                                                     const RingNodes& nodes,
                                                                     double shortest);

}  // namespace detail

#if VOUSSOIR_BODIES

namespace detail {

/// From vertex 0 to where the stretches of a ring without corners begin, see `RingNodes`.
[[nodiscard]] inline double ring_offset(const SimplePolygon& opening, double stretch) {
  const auto& vertices = opening.vertices();
  double low = vertices.front().x(), high = low;
  for (const Vec2& v : vertices) {
    low = std::min(low, v.x());
    high = std::max(high, v.x());
  }
  // The crown: the highest point midway between the walls.
  const double middle = 0.5 * (low + high), near = 1e-9 * opening.perimeter();
  double along = 0, crown = 0, highest = -std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < opening.size(); ++e) {
    const Segment edge = opening.edge(e);
    const double from = edge.start.x() - middle, to = edge.end.x() - middle;
    const bool crosses = (from < -near && to > near) || (from > near && to < -near);
    const double part = crosses ? from / (from - to) : 0.0;
    if (crosses || std::abs(from) <= near)
      if (const double height = edge.at(part).y(); height > highest + near) {
        highest = height;
        crown = along + part * edge.length() + (crosses ? 0.5 * stretch : 0.0);
      }
    along += edge.length();
  }
  const double offset = crown - stretch * std::floor(crown / stretch);
  return offset < 1e-9 * stretch || offset > (1 - 1e-9) * stretch ? 0.0 : offset;
}

/// Puts the nodes of a ring on its outline.
class RingDivision {
 public:
  RingDivision(const SimplePolygon& opening, const LiningRing& ring)
      : path_(opening),
        ring_(ring),
        centre_(ring.centre.value_or(centre_of(opening))),
        count_(ring.nodes.value_or(default_lining_nodes)) {
    require(count_ >= 8 && count_ <= most_lining_nodes, "lining nodes", count_, "8 to 2000");
    require(ring.fill_depth >= 0 && std::isfinite(ring.fill_depth), "fill depth of a lining",
            ring.fill_depth, ">= 0 m and finite");
    arc_ = ring.to - ring.from;
    require(arc_ > 0 && arc_ <= circle * (1 + 1e-12), "lining arc", arc_, "> 0 and <= 2 pi rad");
    made_.stretch = opening.perimeter() / count_;
    corners_ = corners_of(path_, 0.5 * made_.stretch);
  }

  [[nodiscard]] RingNodes divide() {
    std::vector<OutlineRun> runs;
    if (!(arc_ > circle * (1 - 1e-9))) runs = runs_in_arc();
    made_.closed =
        arc_ > circle * (1 - 1e-9) ||
        (runs.size() == 1 && runs[0].to - runs[0].from > path_.perimeter() - path_.near());
    if (!made_.closed) {
      for (const OutlineRun& run : runs) add_arc(run);
    } else if (corners_.empty()) {
      add_smooth_ring();
    } else {
      add_bare(corners_.front());
      add_between_corners({corners_.front(), corners_.front() + path_.perimeter()});
      made_.joined.assign(made_.places.size(), 1);
    }
    if (made_.places.size() < 2) throw InvalidInput("lining: fewer than two nodes lie in the arc");
    std::sort(made_.stretches.begin(), made_.stretches.end(),
              [](const RingStretch& a, const RingStretch& b) { return a.begin < b.begin; });
    return std::move(made_);
  }

 private:
  static constexpr double circle = 2 * std::numbers::pi;

  /// Of a point as seen from the centre, behind the beginning of the arc: 0 <= . < 2 pi [rad].
  [[nodiscard]] double angle_behind_begin(const Vec2& p) const {
    const double angle =
        elementary::angle_of(p.y() - centre_.y(), p.x() - centre_.x()) - ring_.from;
    return angle - circle * std::floor(angle / circle);
  }
  [[nodiscard]] bool is_corner(double s) const {
    return std::any_of(corners_.begin(), corners_.end(),
                       [&](double corner) { return path_.is_near(s, corner); });
  }

  /// What of the outline lies in the arc. One that turns back can leave it and come again.
  [[nodiscard]] std::vector<OutlineRun> runs_in_arc() const {
    // Where the two ends of the arc are met; vertices, so that what is between is on one edge.
    std::vector<double> marks;
    for (std::size_t e = 0; e < path_.size(); ++e) {
      const Segment edge = path_.outline().edge(e);
      marks.push_back(path_.start(e));
      std::vector<double> met;
      for (const double angle : {ring_.from, ring_.to}) {
        const Vec2 ray(elementary::cosine(angle), elementary::sine(angle));
        const double a = cross(ray, Vec2(edge.start - centre_)),
                     b = cross(ray, Vec2(edge.end - centre_));
        if (!((a < 0 && b > 0) || (a > 0 && b < 0))) continue;
        const double s = a / (a - b) * edge.length();
        if (s > path_.near() && s < edge.length() - path_.near() &&
            dot_product(ray, Vec2(edge.at(s / edge.length()) - centre_)) > 0)
          met.push_back(path_.start(e) + s);
      }
      std::sort(met.begin(), met.end());
      marks.insert(marks.end(), met.begin(), met.end());
    }
    marks.push_back(path_.perimeter());
    std::vector<OutlineRun> runs;
    for (std::size_t k = 0; k + 1 < marks.size(); ++k) {
      // What lies along an end of the arc, a floor through the centre, is not in it.
      const double behind = angle_behind_begin(path_.at(0.5 * (marks[k] + marks[k + 1])));
      if (!(behind > 1e-9 && behind < arc_ - 1e-9)) continue;
      if (!runs.empty() && runs.back().to == marks[k])
        runs.back().to = marks[k + 1];
      else
        runs.push_back({marks[k], marks[k + 1]});
    }
    if (runs.size() > 1 && runs.front().from == 0 && runs.back().to == path_.perimeter()) {
      runs.back().to += runs.front().to;
      runs.erase(runs.begin());
    }
    return runs;
  }

  /// The corner that an end has just been turned round, or the end.
  /// @param way  from the end into the arc: 1 or -1
  [[nodiscard]] double put_on_corner(double end, double way, double length) const {
    const Vec2 here = path_.at(end) - centre_;
    for (const double corner : corners_) {
      const double along = path_.in_round(way * (corner - end));
      const Vec2 there = path_.at(corner) - centre_;
      if (along < length && along < 0.05 * length_of(there) &&
          std::abs(elementary::angle_of(cross(here, there), dot_product(here, there))) <
              corner_tolerance)
        return end + way * along;
    }
    return end;
  }

  void add_arc(OutlineRun run) {
    const double length = run.to - run.from;
    const OutlineRun asked = run;
    run.from = put_on_corner(asked.from, 1, length);
    run.to = put_on_corner(asked.to, -1, length);
    if (!(run.to - run.from > path_.near())) return;
    const std::size_t first = made_.places.size();
    if (is_corner(run.from)) add_bare(run.from);
    add_between_corners(run);
    if (is_corner(run.to)) add_bare(run.to);
    made_.joined.resize(made_.places.size(), 1);
    made_.joined.back() = 0;
    add_end(run.from, static_cast<int>(first), false);
    add_end(run.to, static_cast<int>(made_.places.size()) - 1, true);
  }

  /// Stretches from one fixed place to the next, and the corners between.
  void add_between_corners(const OutlineRun& run) {
    std::vector<double> fixed;
    for (const double corner : corners_)
      for (const double s : {corner, corner + path_.perimeter(), corner + 2 * path_.perimeter()})
        if (s > run.from + path_.near() && s < run.to - path_.near()) fixed.push_back(s);
    std::sort(fixed.begin(), fixed.end());
    fixed.push_back(run.to);
    double from = run.from;
    for (const double to : fixed) {
      const double parts = std::ceil((to - from) / made_.stretch * (1 - 1e-9));
      const int cells = std::max(1, static_cast<int>(parts));
      const auto border = [&](int k) { return k == cells ? to : from + (to - from) * k / cells; };
      for (int k = 0; k < cells; ++k) add_node(border(k), border(k + 1));
      if (to != run.to) add_bare(to);
      from = to;
    }
  }

  /// Stretches that stand as the crown asks.
  void add_smooth_ring() {
    const double offset = ring_offset(path_.outline(), made_.stretch);
    for (int k = 0; k < count_; ++k) {
      made_.places.push_back(path_.at((k + 0.5) * made_.stretch + offset));
      const double begin = offset + k * made_.stretch, end = offset + (k + 1) * made_.stretch;
      made_.stretches.push_back({begin, end, k});
      if (k + 1 == count_ && offset > 0) made_.stretches.push_back({0, offset, k});
    }
    made_.is_bare.assign(made_.places.size(), 0);
    made_.joined.assign(made_.places.size(), 1);
  }

  void add_bare(double s) {
    made_.places.push_back(path_.at(s));
    made_.is_bare.push_back(1);
  }
  void add_node(double begin, double end) {
    const auto node = static_cast<int>(made_.places.size());
    made_.places.push_back(path_.at(0.5 * (begin + end)));
    made_.is_bare.push_back(0);
    const double round = path_.perimeter() * std::floor((begin + path_.near()) / path_.perimeter());
    begin = std::max(0.0, begin - round);
    end -= round;
    made_.stretches.push_back({begin, std::min(end, path_.perimeter()), node});
    if (end > path_.perimeter() + path_.near())
      made_.stretches.push_back({0, end - path_.perimeter(), node});
  }

  void add_end(double s, int node, bool is_after) {
    const Vec2 place = path_.at(s);
    const int last =
        made_.is_bare[static_cast<std::size_t>(node)] ? node + (is_after ? -1 : 1) : node;
    const Vec2 direction = normalized(place - made_.places[static_cast<std::size_t>(last)]);
    made_.ends.push_back({node, place, direction, is_after, refusal_at(s, direction, is_after)});
  }
  /// On a flat floor or roof that reaches from corner to corner nothing is ahead of a foot.
  [[nodiscard]] std::string refusal_at(double s, const Vec2& direction, bool is_after) const {
    const Vec2 inward = is_after ? perpendicular(direction) : Vec2(-perpendicular(direction));
    for (const double ahead : {0.05, 0.35, 0.65, 1.0})
      if (!path_.outline().contains(path_.at(s) +
                                    made_.stretch * (ahead * direction + 0.05 * inward)))
        return {};
    for (const auto& run : {floor_of(path_), flat_roof_of(path_)}) {
      if (!run || !is_corner(run->from) || !is_corner(run->to)) continue;
      const double along = path_.in_round(s - run->from), length = run->to - run->from;
      if (!(along > path_.near() && along < length - path_.near())) continue;
      const auto degrees = [&](double at) {
        const Vec2 p = path_.at(at) - centre_;
        double angle = elementary::angle_of(p.y(), p.x());
        // As the arc counts them.
        const double asked = is_after ? ring_.to : ring_.from;
        angle += circle * std::round((asked - angle) / circle);
        return message_number(angle * 180 / std::numbers::pi, 5);
      };
      const Vec2 place = path_.at(s);
      return message({"lining: the foot at (", place.x(), ", ", place.y(),
                      ") m would stand on nothing: the arc's end at ", degrees(s),
                      " deg is on the flat ", place.y() < centre_.y() ? "floor" : "roof",
                      " between its corners at ", degrees(run->from), " and ", degrees(run->to),
                      " deg; accepted: an end on one of these (within 0.5 deg) or on a wall, or no "
                      "feet"});
    }
    return {};
  }

  OutlinePath path_;
  const LiningRing& ring_;
  Vec2 centre_;
  int count_;
  double arc_ = 0;
  std::vector<double> corners_;
  RingNodes made_{};
};

VOUSSOIR_INLINE RingNodes ring_nodes(const SimplePolygon& opening, const LiningRing& ring) {
  return RingDivision(opening, ring).divide();
}

VOUSSOIR_INLINE std::vector<OutlinePart> outline_parts(const SimplePolygon& opening,
                                                       const RingNodes& nodes, double shortest) {
  std::vector<OutlinePart> parts;
  double start = 0;
  for (std::size_t e = 0; e < opening.size(); ++e) {
    const Segment edge = opening.edge(e);
    const double length = edge.length();
    nodes.each_stretch(start, start + length, [&](int node, double begin, double end) {
      const double from = std::max(0.0, begin - start), to = std::min(length, end - start);
      if (to - from > shortest)
        parts.push_back({node, {edge.at(from / length), edge.at(to / length)}});
    });
    start += length;
  }
  return parts;
}

}  // namespace detail

#endif

}  // namespace voussoir
