// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/geometry/inscribed_ball.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/detail/group_cut.hpp>
#include <voussoir/rockmass/rock_mass.hpp>
#include <voussoir/rockmass/welding.hpp>

namespace voussoir {

/// Which blocks may exist. A cut that would make a smaller or longer one is not made.
///
/// A block that is too long itself, as a wide or flat domain is, must still become blocks: it is
/// cut where neither part is further beyond the limit in metres, nor has more of an elongation than
/// the domain. Cuts that make it less long are so never refused for length. What remains too long
/// in the end is counted.
struct BlockLimits {
  /// [m], >= 0. No block is smaller than the tolerance of the domain: its vertices would be too few
  /// places apart to give it a volume.
  double min_inscribed_radius = 0;
  /// Longest diagonal / inscribed diameter [-], >= 2.
  double max_elongation = std::numeric_limits<double>::infinity();

  /// @throws InvalidInput
  void check() const {
    require(min_inscribed_radius >= 0 && std::isfinite(min_inscribed_radius),
            "min_inscribed_radius", min_inscribed_radius, ">= 0");
    require(max_elongation >= 2, "max_elongation", max_elongation, ">= 2");
  }
};

namespace detail {

enum class Fit { good, too_small, too_long };

/// V / S: area over perimeter, volume over surface [m].
[[nodiscard]] inline double hydraulic_radius(const ConvexPolygon& block) {
  return mass_properties(block).measure / block.perimeter();
}
[[nodiscard]] VOUSSOIR_INLINE double hydraulic_radius(const ConvexPolyhedron& block);

/// Radius of the ball about the mean of the vertices: the inscribed one is at least as large [m].
template <class Shape>
[[nodiscard]] double central_radius(const Shape& block) {
  Vec<Shape::dim> arm = zeros<Vec<Shape::dim>>();
  for (const auto& v : block.vertices()) arm += v - block.vertex(0);
  const Vec<Shape::dim> centre =
      block.vertex(0) + arm / static_cast<double>(block.vertices().size());
  double radius = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < block.size(); ++k)
    radius = std::fmin(radius, -block.distance(k, centre));
  return radius;
}

/// The limits against a block; a linear program only where bounds of the inscribed radius r do not
/// settle it. In d dimensions, V the area or volume and S what bounds it,
///
///   V / S <= r <= d V / S
///
/// Right: the faces are at least r away from the incentre, so V = sum(A_i h_i) / d >= r S / d.
/// Left: no point is further than r from the nearest face, so the points nearest to face i fill at
/// most A_i r, and V <= r S.
template <class Shape>
[[nodiscard]] Fit fits(const Shape& block, const BlockLimits& limits) {
  const double smallest = limits.min_inscribed_radius;
  const bool bounded = std::isfinite(limits.max_elongation);
  if (!(smallest > 0 || bounded)) return Fit::good;
  const double ratio = hydraulic_radius(block);
  if (Shape::dim * ratio < smallest) return Fit::too_small;
  const double diameter = bounded ? block.diameter() : 0.0;
  const auto is_good = [&](double radius) {
    return radius >= smallest && (!bounded || diameter <= 2 * limits.max_elongation * radius);
  };
  if (is_good(ratio) || is_good(central_radius(block))) return Fit::good;
  const double radius = inscribed_ball(block).radius;
  if (radius < smallest) return Fit::too_small;
  return is_good(radius) ? Fit::good : Fit::too_long;
}

/// Longest diagonal / inscribed diameter [-].
template <class Shape>
[[nodiscard]] double elongation(const Shape& block) {
  return block.diameter() / (2 * inscribed_ball(block).radius);
}

/// By how much the longest diagonal is longer than the limit lets it be [m]; 0 within the limit.
template <class Shape>
[[nodiscard]] double excess_length(const Shape& block, const BlockLimits& limits) {
  if (!std::isfinite(limits.max_elongation)) return 0;
  return std::max(0.0, block.diameter() - 2 * limits.max_elongation * inscribed_ball(block).radius);
}

/// The half space below (left of) a joint.
[[nodiscard]] inline HalfSpace<2> side_of(const Segment& trace) {
  return left_of(trace.start, trace.end);
}
[[nodiscard]] inline HalfSpace<3> side_of(const JointPlane& trace) { return trace.plane; }

/// A joint of finite extent that is the same inside the domain.
[[nodiscard]] inline const Segment& bounded(const Segment& trace, const Domain<2>&) {
  return trace;
}
[[nodiscard]] inline JointPlane bounded(const JointPlane& trace, const Domain<3>& domain) {
  return covering(trace, 0.5 * (domain.low + domain.high), domain.diameter());
}

/// Rock that is cut so far, and the tree of its cuts: blocks of one convex part or of several.
struct SlicedSoFar {
  struct Node {
    HalfSpace<2> plane{};
    std::size_t below = 0, above = 0;
    std::ptrdiff_t part = 0;  ///< >= 0: a leaf. Several may be one part
  };
  std::vector<Cut> cuts;
  std::vector<Node> nodes;
  std::vector<ConvexPolygon> parts;
  std::vector<std::size_t> body;  ///< of every part
  SlicingReport report;
};

/// Cuts blocks one after the other. The cuts made so far form a binary tree over the blocks: a
/// joint walks down it, clipped at each cut, and arrives in exactly the blocks it reaches. The work
/// is therefore linear in the number of blocks but for the depth of the tree.
template <class Geometry>
class Slicer {
 public:
  using Shape = typename Geometry::Shape;
  using Trace = typename Geometry::Trace;

  Slicer(const Domain<Geometry::dim>& domain, const BlockLimits& limits, StopCheck& stop)
      : stop_(stop), domain_(domain), limits_(limits), tolerance_(domain.tolerance()) {
    domain.check();
    limits.check();
    limits_.min_inscribed_radius = std::max(limits_.min_inscribed_radius, tolerance_);
    for (int side = 0; side < 2 * Geometry::dim; ++side)
      cuts_.push_back({Cut::Kind::boundary, side});
    nodes_.push_back({});
    blocks_.push_back(as_block(domain));
    excess_.push_back(detail::excess_length(blocks_.front(), limits));
    if (excess_.front() > 0) longest_ = elongation(blocks_.front());
    for (std::size_t face = 0; face < blocks_.front().size(); ++face)
      sides_.push_back(blocks_.front().half_space(face));
  }

  /// Goes on where other cuts have been made.
  /// @param limits  a block that is too long so far may be cut where no part is longer than that
  Slicer(const Domain<2>& domain, SlicedSoFar start, const BlockLimits& limits, StopCheck& stop)
      : Slicer(domain, limits, stop) {
    cuts_ = std::move(start.cuts);
    blocks_ = std::move(start.parts);
    report_ = std::move(start.report);
    nodes_.clear();
    groups_.resize(blocks_.size());
    for (std::size_t k = 0; k < blocks_.size(); ++k) groups_[start.body[k]].push_back(k);
    group_of_.assign(blocks_.size(), -1);
    for (std::size_t k = 0; k < blocks_.size(); ++k)
      if (groups_[start.body[k]].size() > 1)
        group_of_[k] = static_cast<std::ptrdiff_t>(start.body[k]);
    excess_.assign(blocks_.size(), 0.0);
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      if (group_of_[k] >= 0) continue;
      excess_[k] = detail::excess_length(blocks_[k], limits);
      if (excess_[k] > 0) longest_ = std::max(longest_, elongation(blocks_[k]));
    }
    leaf_of_.assign(blocks_.size(), none);
    for (const SlicedSoFar::Node& node : start.nodes) {
      nodes_.push_back({node.plane, node.below, node.above, node.part});
      if (node.part < 0) continue;
      std::size_t& leaf = leaf_of_[static_cast<std::size_t>(node.part)];
      if (leaf == none) {
        leaf = nodes_.size() - 1;
      } else {  // the rest of a part that has a leaf: all of space is below
        nodes_.back() = {{zeros<Vec2>(), 1}, leaf, leaf, -1};
      }
    }
  }

  void cut_by(const JointOf<Geometry::dim>& joint, int index) {
    ++report_.joints;
    const HalfSpace<Geometry::dim> plane = side_of(joint.trace);
    bool used = false;
    // The tree divides all space: what lies outside the domain must not reach it.
    std::optional<Trace> inside = bounded(joint.trace, domain_);
    for (const auto& side : sides_)
      if (inside) inside = voussoir::split(std::move(*inside), side, tolerance_).below;
    const bool reaches_domain = inside.has_value();
    if (!reaches_domain) ++report_.outside_joints;
    if (is_zero(plane.normal)) inside.reset();  // a trace whose ends are one point
    pending_.clear();
    if (inside) pending_.emplace_back(0, std::move(*inside));
    while (!pending_.empty()) {
      auto [at, piece] = std::move(pending_.back());
      pending_.pop_back();
      const Node& node = nodes_[at];
      if (node.block < 0) {
        auto [below, above] = voussoir::split(std::move(piece), node.plane, tolerance_);
        if (above) pending_.emplace_back(node.above, std::move(*above));
        if (below) pending_.emplace_back(node.below, std::move(*below));
      } else {
        stop_();  // a long joint may reach every block there is
        used = cut_block(at, plane, index) || used;
      }
    }
    if (!used) ++report_.unused_joints;
    report_.fates.push_back(used             ? JointFate::used
                            : reaches_domain ? JointFate::refused
                                             : JointFate::outside);
  }

  [[nodiscard]] RockMass<Geometry> finish(const std::vector<JointOf<Geometry::dim>>& joints) {
    RockMass<Geometry> mass;
    mass.domain = domain_;
    mass.joints = joints;
    mass.cuts = std::move(cuts_);
    mass.slicing = report_;
    mass.bodies.reserve(blocks_.size());
    // In the order of the tree neighbours in space are neighbours in memory.
    std::vector<std::size_t> stack{0};
    std::map<std::ptrdiff_t, std::size_t> of_group;  // the body that a group becomes
    while (!stack.empty()) {
      stop_();
      const Node& node = nodes_[stack.back()];
      stack.pop_back();
      if (node.block < 0) {
        if (node.above == node.below) continue;  // stands for a leaf elsewhere
        stack.push_back(node.above);
        stack.push_back(node.below);
      } else {
        const auto block = static_cast<std::size_t>(node.block);
        const std::ptrdiff_t group = group_of_.empty() ? -1 : group_of_[block];
        const auto [at, is_new] = group < 0 ? std::pair(of_group.end(), true)
                                            : of_group.emplace(group, mass.bodies.size());
        if (is_new) mass.bodies.emplace_back();
        Body<Geometry>& body = is_new ? mass.bodies.back() : mass.bodies[at->second];
        body.parts.push_back(std::move(blocks_[block]));
      }
    }
    for (Body<Geometry>& body : mass.bodies) body.properties = mass_properties(body.parts);
    VOUSSOIR_ASSERT(mass.bodies.size() == report_.cuts + 1, "every block becomes a body");
    VOUSSOIR_ASSERT(
        report_.outside_joints <= report_.unused_joints && report_.unused_joints <= report_.joints,
        "a joint outside the domain cuts nothing");
    mass.slicing.blocks_too_long = static_cast<std::size_t>(
        std::count_if(excess_.begin(), excess_.end(), [](double excess) { return excess > 0; }));
    mass.slicing.vanished_faces += weld(mass.bodies, tolerance_, stop_);
    return mass;
  }

 private:
  struct Node {
    HalfSpace<Geometry::dim> plane{};
    std::size_t below = 0, above = 0;
    std::ptrdiff_t block = 0;  ///< >= 0: a leaf
  };

  bool cut_block(std::size_t at, const HalfSpace<Geometry::dim>& plane, int joint) {
    VOUSSOIR_ASSERT(nodes_[at].block >= 0, "a leaf of the tree is a block");
    const auto block = static_cast<std::size_t>(nodes_[at].block);
    if constexpr (Geometry::dim == 2)
      if (!group_of_.empty() && group_of_[block] >= 0) return cut_group_at(block, plane, joint);
    auto parts = blocks_[block].split(plane, static_cast<int>(cuts_.size()), tolerance_);
    if (!parts) {
      ++report_.coincident;
      return false;
    }
    std::array<double, 2> excess{};
    for (std::size_t side = 0; side < 2; ++side) {
      const Shape& part = side == 0 ? parts->first : parts->second;
      Fit fit = fits(part, limits_);
      if (fit == Fit::too_long && excess_[block] > 0) {
        excess[side] = excess_length(part, limits_);
        // A part that keeps the longest diagonal is as long as the block: no rounding refuses it.
        if (excess[side] <= excess_[block] * (1 + same_length) &&
            elongation(part) <= longest_ * (1 + same_length))
          fit = Fit::good;
      }
      if (fit == Fit::too_small) ++report_.refused_too_small;
      if (fit == Fit::too_long) ++report_.refused_too_long;
      if (fit != Fit::good) return false;
    }
    cuts_.push_back({Cut::Kind::joint, joint});
    ++report_.cuts;
    excess_[block] = excess[0];
    divide(at, plane, std::move(parts->first), std::move(parts->second));
    excess_.back() = excess[1];
    return true;
  }

  /// Makes two leaves of one.
  void divide(std::size_t at, const HalfSpace<Geometry::dim>& plane, Shape below, Shape above) {
    const auto block = static_cast<std::size_t>(nodes_[at].block);
    Node lower, upper;
    lower.block = static_cast<std::ptrdiff_t>(block);
    upper.block = static_cast<std::ptrdiff_t>(blocks_.size());
    nodes_[at] = {plane, nodes_.size(), nodes_.size() + 1, -1};
    nodes_.push_back(lower);
    nodes_.push_back(upper);
    blocks_[block] = std::move(below);
    blocks_.push_back(std::move(above));
    excess_.push_back(0);
    if (group_of_.empty()) {
      VOUSSOIR_ASSERT(nodes_.size() == 2 * blocks_.size() - 1, "a cut makes two leaves of one");
      VOUSSOIR_ASSERT(blocks_.size() == report_.cuts + 1, "a cut makes two blocks of one");
      return;
    }
    group_of_.push_back(-1);
    leaf_of_[block] = nodes_.size() - 2;
    leaf_of_.push_back(nodes_.size() - 1);
  }

  /// Cuts the block of several parts that one of them, reached by a joint, belongs to. Its length
  /// is not limited, as that of what was mapped is not.
  bool cut_group_at(std::size_t block, const HalfSpace<2>& plane, int joint) {
    std::vector<std::size_t> members = groups_[static_cast<std::size_t>(group_of_[block])];
    const auto reached = static_cast<std::size_t>(std::find(members.begin(), members.end(), block) -
                                                  members.begin());
    std::vector<const Shape*> parts;
    for (const std::size_t k : members) parts.push_back(&blocks_[k]);
    cuts_.push_back({Cut::Kind::joint, joint});
    auto made = detail::cut_group(parts, reached, plane, static_cast<int>(cuts_.size()) - 1, cuts_,
                                  limits_.min_inscribed_radius, tolerance_);
    if (!made || made->is_too_small || made->groups.size() < 2) {
      cuts_.pop_back();
      ++(made && made->is_too_small ? report_.refused_too_small : report_.coincident);
      return false;
    }
    report_.cuts += made->groups.size() - 1;
    for (auto& halves : made->halves) {
      divide(leaf_of_[members[halves.part]], plane, std::move(halves.below),
             std::move(halves.above));
      members.push_back(blocks_.size() - 1);
    }
    for (const auto& group : made->groups) {
      const bool is_alone = group.size() == 1;
      const auto number = is_alone ? -1 : static_cast<std::ptrdiff_t>(groups_.size());
      if (!is_alone) groups_.emplace_back();
      for (const std::size_t k : group) {
        group_of_[members[k]] = number;
        if (!is_alone) groups_.back().push_back(members[k]);
      }
    }
    return true;
  }

  static constexpr double same_length = 1e-9;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  StopCheck& stop_;
  Domain<Geometry::dim> domain_;
  BlockLimits limits_;
  double tolerance_;
  std::vector<Node> nodes_;
  std::vector<Shape> blocks_;
  std::vector<double> excess_;  ///< of each block: its length beyond the limit, 0 for most [m]
  double longest_ = 0;          ///< elongation of the domain, where it is beyond the limit [-]
  /// Blocks of several parts, where cutting began with such: of every part its group, -1 if it is
  /// alone; and its leaf.
  std::vector<std::ptrdiff_t> group_of_;
  std::vector<std::size_t> leaf_of_;
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<HalfSpace<Geometry::dim>> sides_;  ///< of the domain
  std::vector<Cut> cuts_;
  std::vector<std::pair<std::size_t, Trace>> pending_;
  SlicingReport report_;
};

}  // namespace detail

/// Slices the domain by the joints, in their order. A joint cuts right through every block that
/// its extent reaches, unless a child would break the limits (see BlockLimits, for domains that
/// break them as well).
///
/// @param progress  told how many of the joints are through, asked whether to go on
/// @throws InvalidInput  domain or limits out of range, a joint that is not finite
/// @throws Stopped
/// @cost   about 10 microseconds per block in 2-D, 5 in 3-D (`slice<Spatial>`); linear
///
/// Source: Boon, Houlsby & Utili (2015), section 2.1 (rock slicing).
template <class Geometry = Planar>
[[nodiscard]] RockMass<Geometry> slice(const Domain<Geometry::dim>& domain,
                                       const std::vector<JointOf<Geometry::dim>>& joints,
                                       const BlockLimits& limits, const Progress& progress = {}) {
  StopCheck stop(progress);
  detail::Slicer<Geometry> slicer(domain, limits, stop);
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (!detail::is_finite(joints[k].trace))
      throw InvalidInput(
          message({"joint ", k, " of set ", joints[k].set,
                   ": every coordinate must be finite, and less than 1e150 m from 0"}));
  for (std::size_t k = 0; k < joints.size(); ++k) {
    stop(static_cast<double>(k) / static_cast<double>(joints.size()));
    slicer.cut_by(joints[k], static_cast<int>(k));
  }
  return slicer.finish(joints);
}

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE double hydraulic_radius(const ConvexPolyhedron& block) {
  double volume = 0, surface = 0;
  for (std::size_t k = 0; k < block.size(); ++k) {
    const auto loop = block.loop(k);
    const auto corner = [&](std::size_t i) -> const Vec3& {
      return block.vertex(static_cast<std::size_t>(loop[i]));
    };
    const Vec3 area = doubled_area(loop.size(), corner);
    surface += length_of(area);
    volume += dot_product(area, corner(0) - block.vertex(0)) / 3;
  }
  return volume / surface;
}

}  // namespace detail

#endif

}  // namespace voussoir
