// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/rockmass/detail/cell_faces.hpp>
#include <voussoir/rockmass/detail/cell_tree.hpp>
#include <voussoir/rockmass/detail/joined_cells.hpp>
#include <voussoir/rockmass/joint.hpp>
#include <voussoir/rockmass/mapped_traces.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/trace_coverage.hpp>
#include <voussoir/rockmass/welding.hpp>

namespace voussoir {

/// What became of the mapped joints of one set.
struct MappedSet {
  int set = -1;             ///< -1: of those that name none
  std::size_t joints = 0;   ///< traces, those that touch end to end counted as one
  std::size_t used = 0;     ///< of them, those that part blocks
  std::size_t outside = 0;  ///< of them, those that do not reach the domain
  double mapped = 0;        ///< length within the domain [m]
  double cut = 0;           ///< of that, what parts blocks [m]
  double made = 0;          ///< parts blocks where nothing was mapped [m]
};

/// Rock with mapped joints, and what became of these.
struct MappedRock {
  RockMass<Planar> mass;
  std::vector<MappedSet> sets;  ///< ascending, those that have a joint
  std::size_t too_small = 0;    ///< blocks that were left in one piece with a neighbour
};

/// Slices the domain by mapped joints as far as they were mapped, no farther (but see `DeadEnds`),
/// then by others, which cut whole blocks as in `slice`. What parts nothing, as an end in whole
/// rock or an overshoot does not, is left out. A block may so be hollow, or have a hole: it is then
/// a body of several convex parts.
///
/// A block that mapped joints make too small, and that is all that is asked of these, is left in
/// one piece with the neighbour beyond the joint that counts least.
/// @param limits    `min_inscribed_radius` > 0
/// @param openings  that will be taken out: a joint that ends at one is kept, for it parts the wall
/// @return  joints: the pieces of those mapped, then the others
/// @throws InvalidInput, Stopped
/// @cost  about 0.1 ms per piece, and as `slice`
[[nodiscard]] VOUSSOIR_INLINE MappedRock slice_mapped(const Domain<2>& domain,
                                                      const MappedJoints& mapped,
                                                      const std::vector<Joint>& others,
                                                      const BlockLimits& limits,
                                                      const std::vector<SimplePolygon>& openings,
                                                      const Progress& progress = {});

#if VOUSSOIR_BODIES

namespace detail {

/// From mapped joints to blocks: see `slice_mapped`.
class MappedSlicer {
 public:
  MappedSlicer(const Domain<2>& domain, const MappedJoints& joints, double radius, StopCheck& stop)
      : domain_(domain),
        joints_(joints),
        stop_(stop),
        // What is drawn on so far, to meet what it ends on, makes no block.
        radius_(std::max({radius, 2 * negligible(), domain.tolerance()})) {
    kept_.resize(joints.pieces.size());
  }

  /// @param rock  gets what became of the joints
  [[nodiscard]] SlicedSoFar sliced(const std::vector<SimplePolygon>& openings, MappedRock& rock) {
    find_parting(openings);
    cut_cells();
    account(rock);
    return std::move(made_);
  }

 private:
  struct Interval {
    double from, to;  ///< along the line of a piece [m]
  };

  /// Length by which what parts blocks is drawn on, lest a rounding keeps it from parting them [m].
  [[nodiscard]] double negligible() const { return 0.01 * joints_.rule.snap; }
  /// What lies open by less holds nothing together [m].
  [[nodiscard]] double gap() const { return 0.1 * negligible(); }

  /// Cuts cells by all joints as far as they go and a little farther, and finds what parts blocks.
  void find_parting(const std::vector<SimplePolygon>& openings) {
    CellTree tree(domain_, stop_);
    const auto& pieces = joints_.pieces;
    for (std::size_t k = 0; k < pieces.size(); ++k)
      if (!pieces[k].is_connector)
        tree.insert({pieces[k].mapped, 0, pieces[k].mapped.length(), k, true});
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const MappedPiece& piece = pieces[k];
      const double length = piece.mapped.length();
      if (piece.is_connector) {
        tree.insert({piece.mapped, -piece.before, length + piece.after, k, false});
        continue;
      }
      if (piece.before > 0) tree.insert({piece.mapped, -piece.before, 0, k, false});
      if (piece.after > 0) tree.insert({piece.mapped, length, length + piece.after, k, false});
    }
    const std::size_t outlines = tree.stretches().size();
    for (const SimplePolygon& opening : openings)
      for (std::size_t e = 0; e < opening.size(); ++e)
        tree.insert({opening.edge(e), 0, opening.edge(e).length(), pieces.size(), true});
    CellFaces faces(tree, gap(), outlines, stop_);
    too_small_ = faces.remove_smaller_than(radius_);
    const std::vector<bool> parting = faces.parting();
    for (std::size_t p = 0; p < parting.size(); ++p) {
      if (!parting[p]) continue;
      const CellFaces::Portion& portion = faces.portions()[p];
      const std::size_t k = tree.stretches()[portion.stretch].piece;
      const Segment& line = pieces[k].mapped;
      const Vec2 along = normalized(Vec2(line.end - line.start));
      const double a = dot_product(along, portion.from_end - line.start),
                   b = dot_product(along, portion.to_end - line.start);
      kept_[k].push_back({std::min(a, b), std::max(a, b)});
    }
    for (auto& intervals : kept_) join(intervals);
  }

  /// Joins what touches, to a negligible length.
  void join(std::vector<Interval>& intervals) const {
    std::sort(intervals.begin(), intervals.end(),
              [](const Interval& a, const Interval& b) { return a.from < b.from; });
    std::vector<Interval> joined;
    for (const Interval& next : intervals)
      if (!joined.empty() && next.from <= joined.back().to + negligible())
        joined.back().to = std::max(joined.back().to, next.to);
      else
        joined.push_back(next);
    intervals = std::move(joined);
  }

  /// Cuts cells by what parts blocks, and numbers the bodies of those that hang together.
  void cut_cells() {
    CellTree tree(domain_, stop_);
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const Segment& line = joints_.pieces[k].mapped;
      for (const Interval& i : kept_[k])
        tree.insert({line, i.from - negligible(), i.to + negligible(), k, is_mapped(k, i)});
    }
    CellFaces faces(tree, gap(), CellFaces::none, stop_);
    too_small_ += faces.remove_smaller_than(radius_);
    std::vector<ConvexPolygon> cells = labelled(tree, faces);
    VertexWelder<2> welder(domain_.tolerance());
    for (ConvexPolygon& cell : cells) made_.report.vanished_faces += cell.move_vertices(welder);
    std::vector<std::size_t> body(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) body[c] = faces.body(c);
    std::vector<bool> is_seam;
    for (const Cut& cut : made_.cuts) is_seam.push_back(cut.kind == Cut::Kind::seam);
    const std::vector<std::size_t> into = join_cells(cells, body, is_seam, domain_, stop_);
    std::vector<std::size_t> number(cells.size());  // of the part that a cell has become
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (into[c] != c) continue;
      number[c] = made_.parts.size();
      made_.parts.push_back(std::move(cells[c]));
      made_.body.push_back(body[c]);
    }
    // Bodies are numbered by their first cells.
    std::vector<std::size_t> bodies = made_.body;
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    for (std::size_t& b : made_.body)
      b = static_cast<std::size_t>(std::lower_bound(bodies.begin(), bodies.end(), b) -
                                   bodies.begin());
    made_.nodes = tree.nodes();
    for (SlicedSoFar::Node& node : made_.nodes)
      if (node.part >= 0)
        node.part = static_cast<std::ptrdiff_t>(number[into[static_cast<std::size_t>(node.part)]]);
    made_.report.cuts = bodies.size() - 1;
  }

  /// Whether most of an interval was mapped.
  [[nodiscard]] bool is_mapped(std::size_t k, const Interval& i) const {
    return !joints_.pieces[k].is_connector && 2 * mapped_of(k, i) > i.to - i.from;
  }
  [[nodiscard]] double mapped_of(std::size_t k, const Interval& i) const {
    if (joints_.pieces[k].is_connector) return 0;
    return std::max(0.0, std::min(i.to, joints_.pieces[k].mapped.length()) - std::max(i.from, 0.0));
  }

  /// The cells, every face divided where it goes over from one joint to another or from a joint to
  /// a seam, with labels that are those of the rock.
  [[nodiscard]] std::vector<ConvexPolygon> labelled(const CellTree& tree, const CellFaces& faces) {
    for (int side = 0; side < 4; ++side) made_.cuts.push_back({Cut::Kind::boundary, side});
    std::map<std::pair<std::size_t, bool>, int> labels;
    const auto label_of = [&](std::size_t piece, bool is_seam) {
      const auto [at, is_new] =
          labels.emplace(std::pair(piece, is_seam), static_cast<int>(made_.cuts.size()));
      if (is_new)
        made_.cuts.push_back(
            {is_seam ? Cut::Kind::seam : Cut::Kind::joint, static_cast<int>(piece)});
      return at->second;
    };
    struct Piece {
      std::size_t cut;
      double from, to;
      Vec2 from_end, to_end;
      int label;
    };
    std::vector<std::vector<Piece>> of_cell(tree.cells().size());
    for (const CellFaces::Portion& p : faces.portions()) {
      const bool parts = faces.body(p.below) != faces.body(p.above);
      // What is negligibly long parts nothing; a joint that ends at the wall to be will.
      const bool is_slit =
          p.stretch != CellFaces::none && !p.is_removed && p.to - p.from > 3 * negligible();
      const std::size_t line = tree.stretches()[tree.cuts()[p.cut].stretch].piece;
      const int label =
          parts || is_slit
              ? label_of(p.stretch == CellFaces::none ? line : tree.stretches()[p.stretch].piece,
                         false)
              : label_of(line, true);
      for (const std::size_t cell : {p.below, p.above})
        of_cell[cell].push_back({p.cut, p.from, p.to, p.from_end, p.to_end, label});
    }
    std::vector<ConvexPolygon> cells;
    for (std::size_t c = 0; c < of_cell.size(); ++c) {
      stop_();
      const ConvexPolygon& cell = tree.cells()[c];
      std::vector<Vec2> corners;
      std::vector<int> labels_of_cell;
      const auto append = [&](const Vec2& corner, int label) {
        if (!labels_of_cell.empty() && squared_length_of(corner - corners.back()) == 0) {
          labels_of_cell.back() = label;
          return;
        }
        corners.push_back(corner);
        labels_of_cell.push_back(label);
      };
      for (std::size_t k = 0; k < cell.size(); ++k) {
        if (cell.cut(k) < CellTree::first_label) {
          append(cell.vertex(k), cell.cut(k));
          continue;
        }
        const auto cut = static_cast<std::size_t>(cell.cut(k) - CellTree::first_label);
        std::vector<Piece> pieces;
        for (const Piece& piece : of_cell[c])
          if (piece.cut == cut) pieces.push_back(piece);
        std::sort(pieces.begin(), pieces.end(),
                  [](const Piece& a, const Piece& b) { return a.from < b.from; });
        const Segment face = cell.face(k);
        const bool is_along = tree.along(cut, face.start) < tree.along(cut, face.end);
        if (!is_along) std::reverse(pieces.begin(), pieces.end());
        if (pieces.empty()) {  // narrower than the tolerance
          append(face.start, label_of(tree.stretches()[tree.cuts()[cut].stretch].piece, true));
          continue;
        }
        for (std::size_t i = 0; i < pieces.size(); ++i) {
          if (i > 0 && pieces[i].label == pieces[i - 1].label) continue;
          append(i == 0     ? face.start
                 : is_along ? pieces[i].from_end
                            : pieces[i].to_end,
                 pieces[i].label);
        }
      }
      cells.push_back(ConvexPolygon::trusted(std::move(corners), std::move(labels_of_cell)));
    }
    return cells;
  }

  /// What became of the joints, by set and by piece.
  void account(MappedRock& rock) {
    const auto& pieces = joints_.pieces;
    std::map<int, MappedSet> sets;
    SlicingReport& report = made_.report;
    std::vector<char> is_used(joints_.joints, 0), is_inside(joints_.joints, 0),
        is_counted(joints_.joints, 0);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      MappedSet& set = sets[pieces[k].set];
      set.set = pieces[k].set;
      const auto inside = inside_of(domain_, pieces[k].mapped);
      for (const Interval& i : kept_[k]) {
        const double mapped = mapped_of(k, i);
        set.cut += mapped;
        set.made += i.to - i.from - mapped;
      }
      report.fates.push_back(!kept_[k].empty() ? JointFate::used
                             : inside          ? JointFate::refused
                                               : JointFate::outside);
      report.unused_joints += kept_[k].empty();
      report.outside_joints += report.fates.back() == JointFate::outside;
      if (pieces[k].is_connector) continue;
      if (inside) set.mapped += inside->length();
      is_used[pieces[k].joint] |= !kept_[k].empty();
      is_inside[pieces[k].joint] |= inside.has_value();
    }
    report.joints = pieces.size() + joints_.duplicates;
    report.unused_joints += joints_.duplicates;
    for (const MappedPiece& piece : pieces) {
      if (std::exchange(is_counted[piece.joint], 1)) continue;
      MappedSet& set = sets[piece.set];
      ++set.joints;
      set.used += is_used[piece.joint] != 0;
      set.outside += is_inside[piece.joint] == 0;
    }
    for (const auto& [number, set] : sets) rock.sets.push_back(set);
    rock.too_small = too_small_;
  }

  const Domain<2>& domain_;
  const MappedJoints& joints_;
  StopCheck& stop_;
  double radius_;
  std::vector<std::vector<Interval>> kept_;  ///< of every piece, what parts blocks
  SlicedSoFar made_;
  std::size_t too_small_ = 0;
};

}  // namespace detail

VOUSSOIR_INLINE MappedRock slice_mapped(const Domain<2>& domain, const MappedJoints& mapped,
                                        const std::vector<Joint>& others, const BlockLimits& limits,
                                        const std::vector<SimplePolygon>& openings,
                                        const Progress& progress) {
  domain.check();
  limits.check();
  StopCheck stop(progress);
  MappedRock rock;
  std::vector<Joint> all;
  for (const MappedPiece& piece : mapped.pieces) all.push_back({piece.mapped, piece.set});
  all.insert(all.end(), others.begin(), others.end());
  detail::MappedSlicer first(domain, mapped, limits.min_inscribed_radius, stop);
  detail::Slicer<Planar> slicer(domain, first.sliced(openings, rock), limits, stop);
  for (std::size_t k = mapped.pieces.size(); k < all.size(); ++k) {
    stop(static_cast<double>(k) / static_cast<double>(all.size()));
    slicer.cut_by(all[k], static_cast<int>(k));
  }
  rock.mass = slicer.finish(all);
  return rock;
}

#endif

}  // namespace voussoir
