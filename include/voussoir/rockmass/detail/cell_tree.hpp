// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/rockmass/domain.hpp>
#include <voussoir/rockmass/slicing.hpp>

namespace voussoir::detail {

/// A straight joint, or part of one, on the line of a segment.
struct Stretch {
  Segment line;         ///< along which lengths count, from its start [m]
  double from, to;      ///< along it [m]
  std::size_t piece;    ///< number of the joint
  bool is_real = true;  ///< false: it was drawn on, no one has seen it

  [[nodiscard]] Vec2 along() const { return normalized(Vec2(line.end - line.start)); }
  [[nodiscard]] Segment segment() const {
    const Vec2 direction = along();
    return {line.start + from * direction, line.start + to * direction};
  }
};

/// Convex cells between straight joints, and which part of every face a joint covers.
///
/// A joint cuts every cell that it reaches right through, as in `Slicer`; how far it really goes is
/// remembered beside each cut. Cells that share a stretch of face which no joint covers hang
/// together.
class CellTree {
 public:
  using Cell = ConvexPolygon;

  /// One stretch of the line of a cut that a joint covers.
  struct Cover {
    double from, to;  ///< along the line of the cut [m]
    std::size_t stretch;
  };
  /// A cut of one cell in two. Its label on the faces is its index + 4.
  struct Cut {
    std::size_t stretch;  ///< that made it: its line is that of the cut
    std::vector<Cover> covers;
  };
  /// Two cells on the two sides of a cut, and where they touch.
  struct Touch {
    std::size_t below, above;  ///< cells
    std::size_t cut;
    double from, to;        ///< along the line of the cut [m]
    Vec2 from_end, to_end;  ///< vertices of either cell
  };

  CellTree(const Domain<2>& domain, StopCheck& stop)
      : stop_(stop), domain_(domain), tolerance_(domain.tolerance()) {
    nodes_.push_back({});
    cells_.push_back(as_block(domain));
  }

  /// Cuts every cell that the stretch reaches.
  void insert(const Stretch& stretch) {
    const std::size_t number = stretches_.size();
    stretches_.push_back(stretch);
    const HalfSpace<2> plane = left_of(stretch.line.start, stretch.line.end);
    std::optional<Segment> inside = inside_domain(stretch.segment());
    if (!inside) return;
    pending_.emplace_back(0, *inside);
    while (!pending_.empty()) {
      stop_();
      const auto [at, piece] = pending_.back();
      pending_.pop_back();
      const Node node = nodes_[at];
      if (node.cell >= 0) {
        cut_cell(at, plane, number);
        continue;
      }
      const auto [below, above] = split(piece, node.plane, tolerance_);
      if (!below && !above) add_cover(cuts_[node.cut], number);
      if (above) pending_.emplace_back(node.above, *above);
      if (below) pending_.emplace_back(node.below, *below);
    }
  }

  /// Every pair of cells that touch across a cut, cut by cut, from the start of its line on.
  [[nodiscard]] std::vector<Touch> touches() const {
    struct Face {
      std::size_t cut, cell;
      bool is_below;
      double from, to;
      Vec2 from_end, to_end;
    };
    std::vector<Face> faces;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (std::size_t k = 0; k < cells_[c].size(); ++k) {
        if (cells_[c].cut(k) < first_label) continue;
        const auto cut = static_cast<std::size_t>(cells_[c].cut(k) - first_label);
        const Segment face = cells_[c].face(k);
        // The cell below, on the left of the line, has it in its own direction.
        const double from = along(cut, face.start), to = along(cut, face.end);
        if (from < to)
          faces.push_back({cut, c, true, from, to, face.start, face.end});
        else
          faces.push_back({cut, c, false, to, from, face.end, face.start});
      }
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
      if (a.cut != b.cut) return a.cut < b.cut;
      if (a.is_below != b.is_below) return a.is_below;
      return a.from < b.from;
    });
    std::vector<Touch> touches;
    for (std::size_t first = 0; first < faces.size();) {
      stop_();
      std::size_t middle = first, last = first;
      while (last < faces.size() && faces[last].cut == faces[first].cut) ++last;
      while (middle < last && faces[middle].is_below) ++middle;
      for (std::size_t i = first, j = middle; i < middle && j < last;) {
        const Face &below = faces[i], &above = faces[j];
        const bool begins_below = below.from >= above.from, ends_below = below.to <= above.to;
        const Face &begin = begins_below ? below : above, &end = ends_below ? below : above;
        if (end.to - begin.from > tolerance_)
          touches.push_back(
              {below.cell, above.cell, below.cut, begin.from, end.to, begin.from_end, end.to_end});
        ++(ends_below ? i : j);
      }
      first = last;
    }
    return touches;
  }

  /// Along the line of a cut [m].
  [[nodiscard]] double along(std::size_t cut, const Vec2& p) const {
    const Stretch& stretch = stretches_[cuts_[cut].stretch];
    return dot_product(stretch.along(), p - stretch.line.start);
  }

  /// The tree, its leaves the numbers of cells. Neighbours in space are near in it.
  [[nodiscard]] std::vector<SlicedSoFar::Node> nodes() const {
    std::vector<SlicedSoFar::Node> all;
    all.reserve(nodes_.size());
    for (const Node& node : nodes_) all.push_back({node.plane, node.below, node.above, node.cell});
    return all;
  }

  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  [[nodiscard]] const std::vector<Cut>& cuts() const { return cuts_; }
  [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }
  [[nodiscard]] const Domain<2>& domain() const { return domain_; }
  [[nodiscard]] double tolerance() const { return tolerance_; }

  static constexpr int first_label = 4;  ///< below it: sides of the domain

 private:
  struct Node {
    HalfSpace<2> plane{};
    std::size_t below = 0, above = 0, cut = 0;
    std::ptrdiff_t cell = 0;  ///< >= 0: a leaf
  };

  [[nodiscard]] std::optional<Segment> inside_domain(const Segment& segment) const {
    std::optional<Segment> inside = segment;
    const Cell ground = as_block(domain_);
    for (std::size_t side = 0; inside && side < ground.size(); ++side)
      inside = split(*inside, ground.half_space(side), tolerance_).below;
    return inside;
  }

  void add_cover(Cut& cut, std::size_t number) const {
    const Stretch& line = stretches_[cut.stretch];
    const Segment segment = stretches_[number].segment();
    const Vec2 along = line.along();
    double from = dot_product(along, segment.start - line.line.start),
           to = dot_product(along, segment.end - line.line.start);
    if (to < from) std::swap(from, to);
    cut.covers.push_back({from, to, number});
  }

  void cut_cell(std::size_t at, const HalfSpace<2>& plane, std::size_t number) {
    const auto cell = static_cast<std::size_t>(nodes_[at].cell);
    auto parts =
        cells_[cell].split(plane, static_cast<int>(cuts_.size()) + first_label, tolerance_);
    if (!parts) return;
    cuts_.push_back({number, {}});
    add_cover(cuts_.back(), number);
    Node below, above;
    below.cell = static_cast<std::ptrdiff_t>(cell);
    above.cell = static_cast<std::ptrdiff_t>(cells_.size());
    nodes_[at] = {plane, nodes_.size(), nodes_.size() + 1, cuts_.size() - 1, -1};
    nodes_.push_back(below);
    nodes_.push_back(above);
    cells_[cell] = std::move(parts->first);
    cells_.push_back(std::move(parts->second));
  }

  StopCheck& stop_;
  Domain<2> domain_;
  double tolerance_;
  std::vector<Node> nodes_;
  std::vector<Cell> cells_;
  std::vector<Cut> cuts_;
  std::vector<Stretch> stretches_;
  std::vector<std::pair<std::size_t, Segment>> pending_;
};

}  // namespace voussoir::detail
