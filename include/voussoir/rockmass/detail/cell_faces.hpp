// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/detail/cell_tree.hpp>
#include <voussoir/rockmass/detail/circle_between.hpp>
#include <voussoir/rockmass/detail/place_order.hpp>
#include <voussoir/rockmass/slicing.hpp>

namespace voussoir::detail {

/// Sets that are united step by step; each is known by its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : up_(count) {
    std::iota(up_.begin(), up_.end(), std::size_t{0});
  }
  [[nodiscard]] std::size_t root(std::size_t k) const {
    while (up_[k] != k) k = up_[k] = up_[up_[k]];
    return k;
  }
  void unite(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    up_[std::max(a, b)] = std::min(a, b);
  }

 private:
  mutable std::vector<std::size_t> up_;
};

/// The blocks that mapped joints make of cells: those that hang together, without blocks that are
/// too small.
class CellFaces {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// A stretch of a cut that one joint covers all along, or none does.
  struct Portion {
    std::size_t below, above, cut;  ///< cells, cut
    double from, to;                ///< along the line of the cut [m]
    Vec2 from_end, to_end;          ///< [m]
    std::size_t stretch;            ///< the joint that covers it; none
    bool is_outline = false;        ///< the outline of an opening does
    bool is_removed = false;        ///< the joint is not cut here: a block would be too small
  };

  /// @param gap        an opening between joints narrower than this does not hold cells together
  /// @param outlines   stretches from this number on are the outline of an opening, no joints
  CellFaces(const CellTree& tree, double gap, std::size_t outlines, StopCheck& stop)
      : tree_(tree), gap_(gap), outlines_(outlines), stop_(stop), body_(tree.cells().size()) {
    make_portions();
    for (const Portion& p : portions_)
      if (p.stretch == none && p.to - p.from > gap_) body_.unite(p.below, p.above);
  }

  /// Unites blocks in which no circle of this radius fits with the neighbour beyond the joint that
  /// counts least: what was drawn on, then the shortest. Of several beyond one joint it is the one
  /// that shares most of it.
  /// @return  number of blocks united
  std::size_t remove_smaller_than(double radius);

  /// The block of a cell, by its first cell.
  [[nodiscard]] std::size_t body(std::size_t cell) const { return body_.root(cell); }
  [[nodiscard]] const std::vector<Portion>& portions() const { return portions_; }

  /// Whether a portion of a joint parts blocks, or would once the opening is taken out.
  [[nodiscard]] std::vector<bool> parting() const {
    DisjointSets opened(tree_.cells().size());
    for (const Portion& p : portions_)
      if ((p.stretch == none ? p.to - p.from > gap_ : p.is_removed) && !p.is_outline)
        opened.unite(p.below, p.above);
    std::vector<bool> parts(portions_.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Portion& p = portions_[k];
      parts[k] = p.stretch != none && !p.is_removed &&
                 (body(p.below) != body(p.above) || opened.root(p.below) != opened.root(p.above));
    }
    return parts;
  }

 private:
  [[nodiscard]] bool counts_less(std::size_t a, std::size_t b) const {
    const Stretch &first = tree_.stretches()[a], &second = tree_.stretches()[b];
    if (first.is_real != second.is_real) return !first.is_real;
    return first.piece > second.piece;
  }
  void make_portions() {
    std::vector<double> ends;
    for (const CellTree::Touch& touch : tree_.touches()) {
      stop_();
      const auto& covers = tree_.cuts()[touch.cut].covers;
      ends.assign({touch.from, touch.to});
      for (const CellTree::Cover& cover : covers)
        for (const double end : {cover.from, cover.to})
          if (end > touch.from + tree_.tolerance() && end < touch.to - tree_.tolerance())
            ends.push_back(end);
      std::sort(ends.begin(), ends.end());
      const Stretch& line = tree_.stretches()[tree_.cuts()[touch.cut].stretch];
      Vec2 begin = touch.from_end;
      for (std::size_t k = 1; k < ends.size(); ++k) {
        if (k + 1 < ends.size() && ends[k] - ends[k - 1] <= tree_.tolerance()) {
          ends[k] = ends[k - 1];
          continue;
        }
        const Vec2 end =
            k + 1 == ends.size() ? touch.to_end : Vec2(line.line.start + ends[k] * line.along());
        Portion portion{touch.below, touch.above, touch.cut, ends[k - 1],
                        ends[k],     begin,       end,       none};
        const double middle = 0.5 * (ends[k - 1] + ends[k]);
        for (const CellTree::Cover& cover : covers) {
          if (!(cover.from <= middle && middle <= cover.to)) continue;
          if (cover.stretch >= outlines_)
            portion.is_outline = true;
          else if (portion.stretch == none || counts_less(portion.stretch, cover.stretch))
            portion.stretch = cover.stretch;
        }
        portions_.push_back(portion);
        begin = end;
      }
    }
  }

  const CellTree& tree_;
  double gap_;
  std::size_t outlines_;
  StopCheck& stop_;
  DisjointSets body_;
  std::vector<Portion> portions_;
};

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::size_t CellFaces::remove_smaller_than(double radius) {
  const auto& cells = tree_.cells();
  struct Block {
    double area = 0;
    Vec2 moment = zeros<Vec2>();            ///< area times centroid [m^3]
    bool is_large = false;                  ///< a circle fits in one of its cells
    std::vector<std::size_t> cells, sides;  ///< the latter: portions of joints
  };
  std::vector<Block> blocks(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    stop_();
    Block& block = blocks[body(c)];
    const auto properties = mass_properties(cells[c]);
    block.area += properties.measure;
    block.moment += properties.measure * properties.centroid;
    block.is_large =
        block.is_large || fits(cells[c], {.min_inscribed_radius = radius}) == Fit::good;
    block.cells.push_back(c);
  }
  for (std::size_t k = 0; k < portions_.size(); ++k)
    for (const std::size_t side : {body(portions_[k].below), body(portions_[k].above)})
      if (body(portions_[k].below) != body(portions_[k].above)) blocks[side].sides.push_back(k);
  const auto is_good = [&](const Block& block) {
    if (block.is_large) return true;
    if (block.area < std::numbers::pi * radius * radius || block.cells.size() == 1) return false;
    std::vector<const ConvexPolygon*> of_block;
    std::vector<Segment> sides;
    for (const std::size_t c : block.cells) {
      of_block.push_back(&cells[c]);
      for (std::size_t f = 0; f < cells[c].size(); ++f)
        if (cells[c].cut(f) < CellTree::first_label) sides.push_back(cells[c].face(f));
    }
    for (const std::size_t k : block.sides)
      if (body(portions_[k].below) != body(portions_[k].above))
        sides.push_back({portions_[k].from_end, portions_[k].to_end});
    return holds_circle(of_block, sides, radius);
  };
  // The smallest first: it is most surely none. Of one size, to a square millimetre, by place.
  const PlaceOrder order(tree_.domain());
  using Entry = std::tuple<double, PlaceOrder::Key, std::size_t, double>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> small;
  const auto consider = [&](std::size_t b) {
    const double area = blocks[b].area;
    if (!is_good(blocks[b]))
      small.emplace(std::round(1e6 * area), order(blocks[b].moment / area), b, area);
  };
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (!blocks[b].cells.empty()) consider(b);
  std::size_t united = 0;
  while (!small.empty()) {
    stop_();
    const auto [size, place, b, area] = small.top();
    small.pop();
    if (body(b) != b || area != blocks[b].area) continue;  // it has grown since
    std::size_t least = none;                              // a joint
    for (const std::size_t k : blocks[b].sides) {
      const Portion& p = portions_[k];
      if (body(p.below) == body(p.above) || p.stretch == none) continue;
      if (least == none || counts_less(p.stretch, least)) least = p.stretch;
    }
    if (least == none) continue;  // the whole domain
    struct Share {
      double length = 0;
      Vec2 moment = zeros<Vec2>();  ///< length times centre [m^2]
    };
    std::map<std::size_t, Share> beyond;
    for (const std::size_t k : blocks[b].sides) {
      const Portion& p = portions_[k];
      // What was drawn on before and behind a joint counts alike.
      if (body(p.below) == body(p.above) || p.stretch == none || counts_less(least, p.stretch))
        continue;
      Share& share = beyond[body(p.below) == b ? body(p.above) : body(p.below)];
      const double length = p.to - p.from;
      share.length += length;
      share.moment += 0.5 * length * (p.from_end + p.to_end);
    }
    const auto key = [&](const std::pair<const std::size_t, Share>& neighbour) {
      const auto& [length, moment] = neighbour.second;
      return std::pair(-to_micrometre(length), order(moment / length));
    };
    const std::size_t other =
        std::min_element(beyond.begin(), beyond.end(), [&](const auto& x, const auto& y) {
          return key(x) < key(y);
        })->first;
    for (const std::size_t k : blocks[b].sides) {
      Portion& p = portions_[k];
      if ((body(p.below) == b && body(p.above) == other) ||
          (body(p.above) == b && body(p.below) == other))
        p.is_removed = true;
    }
    body_.unite(b, other);
    ++united;
    const std::size_t into = body(b), from = into == b ? other : b;
    Block &kept = blocks[into], &gone = blocks[from];
    kept.area += gone.area;
    kept.moment += gone.moment;
    kept.is_large = kept.is_large || gone.is_large;
    if (kept.cells.size() < gone.cells.size()) kept.cells.swap(gone.cells);
    if (kept.sides.size() < gone.sides.size()) kept.sides.swap(gone.sides);
    kept.cells.insert(kept.cells.end(), gone.cells.begin(), gone.cells.end());
    kept.sides.insert(kept.sides.end(), gone.sides.begin(), gone.sides.end());
    gone = {};
    consider(into);
  }
  return united;
}

#endif

}  // namespace voussoir::detail
