// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/segment.hpp>
#include <voussoir/rockmass/detail/place_order.hpp>
#include <voussoir/rockmass/detail/segment_grid.hpp>
#include <voussoir/rockmass/detail/trace_chains.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/mapped_trace.hpp>

namespace voussoir {

/// What becomes of a trace that ends in whole rock.
enum class DeadEnds {
  do_not_cut,   ///< beyond the last joint that it meets it parts nothing, and is left out
  cut_through,  ///< it is drawn on, straight, to the next joint: a joint cuts whole blocks, as in
                ///< the paper
};

/// How mapped traces become joints.
struct MappedRule {
  /// What ends closer than this to another joint, before or beyond it, ends on it; traces so close
  /// all along are one [m], > 0.
  double snap = 0;
  DeadEnds dead_ends = DeadEnds::cut_through;

  /// A polyline may be drawn with fewer points if it moves by no more than this [m].
  [[nodiscard]] double straightness() const { return 0.1 * snap; }
};

/// A straight piece of a mapped joint.
struct MappedPiece {
  Segment mapped;             ///< as far as it was mapped [m]
  double before = 0;          ///< drawn on beyond its start, to meet what it meets [m], >= 0
  double after = 0;           ///< and beyond its end
  int set = -1;               ///< of the joint
  std::size_t joint = 0;      ///< rank of the joint it belongs to, the longest first
  bool is_connector = false;  ///< all of it is drawn on, from an end to a joint beside it
};

/// Mapped joints in their canonical order.
struct MappedJoints {
  std::vector<MappedPiece> pieces;  ///< those of a joint follow one another
  std::size_t joints = 0;
  std::size_t duplicates = 0;  ///< traces left out: a longer one runs there already
  std::size_t dead_ends = 0;   ///< ends in whole rock
  MappedRule rule = {};
};

/// Joints from traces: the same for every order and direction of the traces, for traces that are
/// given in one piece or in several that touch end to end, and for polylines with more or fewer
/// points.
///
/// 1. Points that repeat are dropped. Traces of one set that touch end to end, and go on in nearly
///    the same direction, are one.
/// 2. Points that lie within a tenth of `rule.snap` of the line without them are left out.
/// 3. Order: the longest first, then by the place of its first end, to a micrometre: the lower,
/// then
///    the one nearer to the middle of the domain, then the left one.
/// 4. A trace that runs within `rule.snap` of a longer one all along is left out.
/// 5. Every end is drawn on by `rule.snap`, so that it meets what it ends close to, or is joined to
///    the joint beside it; what is too long by that parts nothing (see `slice`). With
///    `DeadEnds::cut_through` those that meet nothing so far are drawn on to the next joint.
///
/// @param traces  relative to the origin of the domain; finite, of two or more points
/// @throws InvalidInput  `rule.snap` is not a length > 0
/// @throws Stopped
/// @cost   O(n log n) for n pieces that are spread over the domain
[[nodiscard]] VOUSSOIR_INLINE MappedJoints mapped_joints(std::vector<MappedTrace> traces,
                                                         const Domain<2>& domain,
                                                         const MappedRule& rule,
                                                         const Progress& progress = {});

#if VOUSSOIR_BODIES

namespace detail {

/// Whether all of a segment is within a distance of others, each stretch of one of them.
[[nodiscard]] VOUSSOIR_INLINE bool runs_along(const Segment& segment, const SegmentGrid& others,
                                              double distance) {
  const Vec2 margin(distance, distance);
  bool is_near = false, start_is_near = false, end_is_near = false;
  others.near(smaller_of(segment.start, segment.end) - margin,
              larger_of(segment.start, segment.end) + margin, [&](std::size_t k) {
                const auto near = [&](const Vec2& p) {
                  return length_of(p - nearest_on(others[k], p)) <= distance;
                };
                const bool start = near(segment.start), end = near(segment.end);
                is_near = is_near || (start && end);
                start_is_near = start_is_near || start;
                end_is_near = end_is_near || end;
              });
  if (is_near || !(start_is_near && end_is_near)) return is_near;
  // From one of the others to the next: what is shorter than the distance is near enough.
  if (segment.length() < distance) return true;
  const Vec2 middle = segment.centre();
  return runs_along({segment.start, middle}, others, distance) &&
         runs_along({middle, segment.end}, others, distance);
}

/// Draws the ends of joints on to what they meet.
class TraceEnds {
 public:
  TraceEnds(MappedJoints& joints, const Domain<2>& domain, StopCheck& stop)
      : joints_(joints),
        domain_(domain),
        stop_(stop),
        grid_(domain.low, domain.high, joints.pieces.size()) {
    for (const MappedPiece& piece : joints.pieces) grid_.add(piece.mapped);
  }

  void draw_on() {
    const double snap = joints_.rule.snap;
    const std::size_t count = joints_.pieces.size();
    for (std::size_t k = 0; k < count; ++k) {
      stop_();
      const bool is_first = k == 0 || joints_.pieces[k - 1].joint != joints_.pieces[k].joint,
                 is_last = k + 1 == count || joints_.pieces[k + 1].joint != joints_.pieces[k].joint;
      // Within a joint far enough that no rounding parts its pieces.
      joints_.pieces[k].before = is_first ? snap : 0.01 * snap;
      joints_.pieces[k].after = is_last ? snap : 0.01 * snap;
      const Segment mapped = joints_.pieces[k].mapped;
      if (is_first) end_at(k, {mapped.end, mapped.start}, joints_.pieces[k].before);
      if (is_last) end_at(k, mapped, joints_.pieces[k].after);
    }
  }

 private:
  /// The end of a segment that is one of a joint.
  void end_at(std::size_t k, const Segment& last, double& drawn_on) {
    const double snap = joints_.rule.snap;
    const Vec2 &end = last.end, margin(snap, snap);
    if (!is_inside(end, -snap)) return;
    const Vec2 along = normalized(last.end - last.start);
    const Segment tip{end - std::min(snap, last.length()) * along, end + snap * along};
    bool meets = !is_inside(tip.end, 0);
    double nearest = snap;
    std::optional<Vec2> beside;
    grid_.near(end - margin, end + margin, [&](std::size_t other) {
      if (other == k) return;
      // The next piece of a polyline meets in its point, which is no end of it.
      const bool is_neighbour = joints_.pieces[other].joint == joints_.pieces[k].joint &&
                                (other + 1 == k || k + 1 == other);
      if (is_neighbour) return;
      meets = meets || crossing_of(tip, grid_[other]).has_value();
      const Vec2 foot = nearest_on(grid_[other], end);
      const double away = length_of(foot - end);
      if (away < nearest * (1 - 1e-9)) {
        nearest = away;
        beside = foot;
      }
    });
    if (meets) return;
    if (beside && nearest > domain_.tolerance()) {
      MappedPiece connector = joints_.pieces[k];
      connector.mapped = {end, *beside};
      connector.before = connector.after = 0.1 * snap;
      connector.is_connector = true;
      connectors_.push_back(connector);
      return;
    }
    if (beside) return;  // they touch, end to end
    ++joints_.dead_ends;
    if (joints_.rule.dead_ends == DeadEnds::cut_through) dead_.push_back({k, last, &drawn_on});
  }

 public:
  /// Draws dead ends on to the next joint, those of longer joints first: what is drawn on so far
  /// stops those that come later.
  void cut_through() {
    for (const Dead& dead : dead_) {
      stop_();
      const Vec2 along = normalized(dead.last.end - dead.last.start);
      const double step = std::max(grid_.cell(), joints_.rule.snap);
      double reach = domain_.diameter();
      for (double from = 0; from < domain_.diameter(); from += step) {
        const Segment stretch{dead.last.end + from * along, dead.last.end + (from + step) * along};
        double nearest = 2;
        grid_.near(smaller_of(stretch.start, stretch.end), larger_of(stretch.start, stretch.end),
                   [&](std::size_t other) {
                     if (other == dead.piece) return;
                     if (const auto met = crossing_of(stretch, grid_[other]))
                       nearest = std::min(nearest, met->first);
                   });
        if (nearest <= 1) reach = from + nearest * step;
        if (nearest <= 1 || !is_inside(stretch.end, 0)) break;
      }
      *dead.drawn_on = reach + joints_.rule.snap;
      grid_.add({dead.last.end, dead.last.end + reach * along});
    }
    joints_.pieces.insert(joints_.pieces.end(), connectors_.begin(), connectors_.end());
  }

 private:
  struct Dead {
    std::size_t piece;
    Segment last;
    double* drawn_on;
  };

  [[nodiscard]] bool is_inside(const Vec2& p, double margin) const {
    for (int axis = 0; axis < 2; ++axis)
      if (!(p[axis] > domain_.low[axis] + margin && p[axis] < domain_.high[axis] - margin))
        return false;
    return true;
  }

  MappedJoints& joints_;
  const Domain<2>& domain_;
  StopCheck& stop_;
  SegmentGrid grid_;
  std::vector<Dead> dead_;
  std::vector<MappedPiece> connectors_;
};

}  // namespace detail

VOUSSOIR_INLINE MappedJoints mapped_joints(std::vector<MappedTrace> traces, const Domain<2>& domain,
                                           const MappedRule& rule, const Progress& progress) {
  require(rule.snap > 0 && std::isfinite(rule.snap), "snap", rule.snap, "a length > 0");
  domain.check();
  StopCheck stop(progress);
  // 1. One trace for what touches end to end.
  for (MappedTrace& trace : traces) {
    auto& points = trace.points;
    points.erase(std::unique(points.begin(), points.end(),
                             [](const Vec2& a, const Vec2& b) {
                               return detail::place_of(a) == detail::place_of(b);
                             }),
                 points.end());
  }
  std::erase_if(traces, [](const MappedTrace& trace) { return trace.points.size() < 2; });
  const detail::PlaceOrder order(domain);
  const auto key_of = [&](const MappedTrace& trace) {
    return std::tuple(-detail::to_micrometre(detail::length_of_trace(trace.points)),
                      order(trace.points.front()), order(trace.points.back()), trace.set,
                      trace.points.size());
  };
  const auto in_order = [&](std::vector<MappedTrace>& all) {
    std::vector<std::pair<decltype(key_of(all.front())), std::size_t>> keys;
    for (std::size_t k = 0; k < all.size(); ++k) keys.emplace_back(key_of(all[k]), k);
    std::sort(keys.begin(), keys.end(), [&](const auto& a, const auto& b) {
      if (a.first != b.first) return a.first < b.first;
      // Of one length between the same ends: by their points.
      return std::lexicographical_compare(
          all[a.second].points.begin(), all[a.second].points.end(), all[b.second].points.begin(),
          all[b.second].points.end(),
          [&](const Vec2& p, const Vec2& q) { return order(p) < order(q); });
    });
    std::vector<MappedTrace> sorted;
    sorted.reserve(all.size());
    for (const auto& [key, k] : keys) sorted.push_back(std::move(all[k]));
    all = std::move(sorted);
  };
  for (MappedTrace& trace : traces) detail::direct(trace.points, order);
  in_order(traces);  // so that of ends that are equally straight on the same are joined
  traces = detail::ChainOfTraces(traces, 0.2 * rule.straightness()).joined();
  // 2. and 3.
  for (MappedTrace& trace : traces) {
    stop();
    detail::direct(trace.points, order);
    detail::simplify(trace.points, rule.straightness());
  }
  in_order(traces);
  // 4. and 5.
  MappedJoints joints;
  joints.rule = rule;
  detail::SegmentGrid taken(domain.low, domain.high, traces.size());
  for (const MappedTrace& trace : traces) {
    stop();
    const auto& points = trace.points;
    bool is_there = true;
    for (std::size_t k = 1; is_there && k < points.size(); ++k)
      is_there = detail::runs_along({points[k - 1], points[k]}, taken, rule.snap);
    if (is_there) {
      ++joints.duplicates;
      continue;
    }
    for (std::size_t k = 1; k < points.size(); ++k) {
      const Segment piece{points[k - 1], points[k]};
      taken.add(piece);
      joints.pieces.push_back({piece, 0, 0, trace.set, joints.joints});
    }
    ++joints.joints;
  }
  detail::TraceEnds ends(joints, domain, stop);
  ends.draw_on();
  ends.cut_through();
  return joints;
}

#endif

}  // namespace voussoir
