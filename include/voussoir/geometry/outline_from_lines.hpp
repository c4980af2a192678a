// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

/// A piece of a drawing: a line, an arc as chords or a polyline, in either sense.
struct LooseLine {
  std::vector<Vec2> points;  ///< [m]
  bool is_closed = false;    ///< from the last point to the first, which need not be repeated
};

/// One closed outline out of pieces in any order and sense, whose ends meet.
///
/// Pieces that stay within the tolerance of their first point are left out. Where two ends meet,
/// the outline has one of them, the lower, then the left one; it begins with its lowest, then
/// leftmost point. Points within the tolerance of the one before are left out. The order and sense
/// of the pieces therefore leave the outline as it is, bit for bit. Nothing is moved or closed
/// beyond the tolerance.
///
/// @param lines      pieces; a piece may be closed
/// @param tolerance  most that two ends which meet may lie apart [m], > 0
/// @return  three points or more, anticlockwise, the first not repeated [m]; whether edges cross is
///          for SimplePolygon to say
/// @throws InvalidInput  no line; points that are not finite; ends that meet no other, with their
///                       gap; three ends or more at one point; several closed outlines, with where
///                       they lie; an outline without area
/// @cost   O(n log n)
[[nodiscard]] VOUSSOIR_INLINE std::vector<Vec2> outline_from_lines(
    const std::vector<LooseLine>& lines, double tolerance = 1e-3);

#if VOUSSOIR_BODIES

namespace detail {

/// See `outline_from_lines`.
class OutlineChain {
 public:
  OutlineChain(const std::vector<LooseLine>& lines, double tolerance)
      : lines_(lines), tolerance_(tolerance) {}

  [[nodiscard]] std::vector<Vec2> outline() {
    sort_lines();
    if (pieces_.empty() && loops_.empty())
      throw InvalidInput(lines_.empty()
                             ? std::string("outline: there are no lines")
                             : message({"outline: there are no lines longer than the tolerance, ",
                                        tolerance_, " m"}));
    meet();
    chain();
    if (loops_.size() > 1) refuse_several();
    return cleaned(std::move(loops_[0]));
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1), most_named = 3;

  [[nodiscard]] static std::string at(const Vec2& p) {
    return message({"(", message_number(p.x(), 9), ", ", message_number(p.y(), 9), ")"});
  }
  [[nodiscard]] bool is_near(const Vec2& a, const Vec2& b) const {
    return length_of(a - b) <= tolerance_;
  }
  /// End of a piece: that of piece k / 2, its first point if k is even.
  [[nodiscard]] const Vec2& end(std::size_t k) const {
    const std::vector<Vec2>& points = *pieces_[k / 2];
    return k % 2 == 0 ? points.front() : points.back();
  }

  /// Closed lines are loops, others pieces.
  void sort_lines() {
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      const std::vector<Vec2>& points = lines_[k].points;
      bool is_short = true;
      for (const Vec2& p : points) {
        if (!voussoir::is_finite(p))
          throw InvalidInput(message({"outline: line ", k, " is not finite"}));
        is_short = is_short && is_near(p, points.front());
      }
      if (is_short) continue;
      if (lines_[k].is_closed || is_near(points.front(), points.back()))
        loops_.push_back(points);
      else
        pieces_.push_back(&points);
    }
  }

  /// Pairs ends that meet.
  void meet() {
    const std::size_t count = 2 * pieces_.size();
    partner_.assign(count, none);
    // Squares as wide as the tolerance: ends that meet lie in one or in two that touch.
    std::map<std::pair<double, double>, std::vector<std::size_t>> squares;
    for (std::size_t b = 0; b < count; ++b) {
      const double x = std::floor(end(b).x() / tolerance_), y = std::floor(end(b).y() / tolerance_);
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy)
          if (const auto found = squares.find({x + dx, y + dy}); found != squares.end())
            for (const std::size_t a : found->second)
              if (is_near(end(a), end(b))) join(a, b);
      squares[{x, y}].push_back(b);
    }
    std::vector<std::size_t> loose;
    for (std::size_t k = 0; k < count; ++k)
      if (partner_[k] == none) loose.push_back(k);
    if (!loose.empty()) refuse_open(std::move(loose));
  }

  void join(std::size_t a, std::size_t b) {
    if (partner_[a] != none || partner_[b] != none)
      throw InvalidInput("outline: three ends or more meet at " + at(end(a)) +
                         ": a branch, or a line that is drawn twice; accepted: one closed "
                         "outline, each end of a line meeting one other");
    partner_[a] = b;
    partner_[b] = a;
  }

  [[noreturn]] void refuse_open(std::vector<std::size_t> loose) const {
    std::string text = "outline: it is open";
    for (std::size_t named = 0; named < most_named && loose.size() > 1; ++named) {
      const std::size_t first = loose.front();
      std::size_t nearest = 1;
      for (std::size_t k = 2; k < loose.size(); ++k)
        if (length_of(end(loose[k]) - end(first)) < length_of(end(loose[nearest]) - end(first)))
          nearest = k;
      const Vec2 &a = end(first), &b = end(loose[nearest]);
      text += message({named == 0 ? ": " : ", ", "a gap of ", length_of(b - a), " m from ", at(a),
                       " to ", at(b)});
      loose.erase(loose.begin() + static_cast<std::ptrdiff_t>(nearest));
      loose.erase(loose.begin());
    }
    if (!loose.empty()) text += message({" and ", loose.size(), " more loose ends"});
    throw InvalidInput(message(
        {text, "; accepted: ends that meet within ", tolerance_, " m, or a larger tolerance"}));
  }

  void chain() {
    std::vector<bool> is_used(pieces_.size(), false);
    for (std::size_t first = 0; first < pieces_.size(); ++first) {
      if (is_used[first]) continue;
      std::vector<Vec2> loop;
      for (std::size_t from = 2 * first; !is_used[from / 2];) {
        is_used[from / 2] = true;
        std::vector<Vec2> points = *pieces_[from / 2];
        if (from % 2 == 1) std::reverse(points.begin(), points.end());
        points.front() = lower_of(end(from), end(partner_[from]));
        // The far end is the next piece's first point.
        loop.insert(loop.end(), points.begin(), points.end() - 1);
        from = partner_[from ^ 1];
      }
      loops_.push_back(std::move(loop));
    }
  }

  [[nodiscard]] static bool is_lower(const Vec2& a, const Vec2& b) {
    return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
  }
  [[nodiscard]] static const Vec2& lower_of(const Vec2& a, const Vec2& b) {
    return is_lower(b, a) ? b : a;
  }

  [[noreturn]] void refuse_several() const {
    std::string text = message({"outline: there are ", loops_.size(), " closed outlines: "});
    for (std::size_t k = 0; k < std::min(most_named, loops_.size()); ++k) {
      Vec2 low = loops_[k][0], high = low;
      for (const Vec2& p : loops_[k])
        for (int i = 0; i < 2; ++i)
          low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
      text += (k == 0 ? "" : ", ") + ("from " + at(low)) + " to " + at(high);
    }
    if (loops_.size() > most_named) text += message({" and ", loops_.size() - most_named, " more"});
    throw InvalidInput(text + "; accepted: one, on a layer of its own");
  }

  [[nodiscard]] std::vector<Vec2> cleaned(std::vector<Vec2> loop) const {
    double area = 0;  // twice, about the first point: grids of a mine are far from (0, 0)
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      area += cross<2>(loop[k] - loop[0], loop[k + 1] - loop[0]);
    if (area < 0) std::reverse(loop.begin(), loop.end());
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), is_lower), loop.end());
    std::vector<Vec2> kept;
    for (const Vec2& p : loop)
      if (kept.empty() || !is_near(p, kept.back())) kept.push_back(p);
    while (kept.size() > 1 && is_near(kept.back(), kept.front())) kept.pop_back();
    if (kept.size() < 3 || !(std::abs(area) > 0))
      throw InvalidInput(message({"outline: the closed line at ", at(kept[0]),
                                  " has no area; accepted: three points or more"}));
    return kept;
  }

  const std::vector<LooseLine>& lines_;
  double tolerance_;
  std::vector<std::vector<Vec2>> loops_;
  std::vector<const std::vector<Vec2>*> pieces_;
  std::vector<std::size_t> partner_;  ///< the end that an end meets
};

}  // namespace detail

VOUSSOIR_INLINE std::vector<Vec2> outline_from_lines(const std::vector<LooseLine>& lines,
                                                     double tolerance) {
  require(tolerance > 0 && tolerance < 1e9, "outline: tolerance", tolerance, "> 0 m");
  return detail::OutlineChain(lines, tolerance).outline();
}

#endif

}  // namespace voussoir
