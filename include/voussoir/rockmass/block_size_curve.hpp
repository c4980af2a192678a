// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir {

/// A block that no side of the domain has cut.
struct WholeBlock {
  int body;             ///< its number in the mass
  double size;          ///< area [m^2] or volume [m^3]
  double weight;        ///< of the edge correction [-], >= 1: see `WholeBlockSizes`
  double passing;       ///< share of the rock in blocks up to this one, 0 to 1 [-]
  double true_passing;  ///< that with the edge correction, 0 to 1 [-]
};

/// In-situ block size distribution of the blocks that lie whole in the domain, weighted by their
/// size as a grading curve is, so that many small blocks do not hide the large ones.
///
/// A block that touches a side of the domain was cut by it, and its size says nothing: it is left
/// out. Large blocks are left out more often than small ones, so what remains is too fine. The edge
/// correction counts every block that is left for as many as there are of it,
///
///   w = prod_k L_k / (L_k - l_k),
///
/// 1 over the probability that a block of the extents l_k, thrown anywhere, lies in a domain of the
/// sides L_k. What never fits the domain no weight brings back.
///
/// Source: Miles (1974), On the elimination of edge effects in planar sampling; Lantuejoul (1978);
/// both as in Serra (1982), Image Analysis and Mathematical Morphology.
class WholeBlockSizes {
 public:
  /// @cost  O(n log n) in the blocks
  template <class Geometry>
  explicit WholeBlockSizes(const RockMass<Geometry>& mass);

  /// Ascending by size.
  [[nodiscard]] const std::vector<WholeBlock>& blocks() const { return blocks_; }
  [[nodiscard]] std::size_t count() const { return blocks_.size(); }
  /// Blocks that touch the sides of the domain, left out, and how much rock they are [m^2], [m^3].
  [[nodiscard]] std::size_t cut_count() const { return cut_count_; }
  [[nodiscard]] double cut_measure() const { return cut_measure_; }

  /// Of the blocks by number; not a number where there is none [m^2], [m^3].
  [[nodiscard]] double mean() const;
  /// Mean of the two middle ones where their number is even.
  [[nodiscard]] double median() const;
  /// Of the rock in all blocks [m^2], [m^3].
  [[nodiscard]] double measure() const { return measure_; }

  /// D50 is `size_at(0.5)`: the smallest size such that blocks up to it are this share of the rock.
  /// Not a number where there is no block [m^2], [m^3].
  /// @throws InvalidInput  a share outside 0 to 1
  [[nodiscard]] double size_at(double share) const { return at(share, &WholeBlock::passing); }
  /// That with the edge correction.
  [[nodiscard]] double true_size_at(double share) const {
    return at(share, &WholeBlock::true_passing);
  }

 private:
  /// Adds up the shares. @pre  sizes and weights are there
  void finish();
  [[nodiscard]] double at(double share, double WholeBlock::*passing) const;

  std::vector<WholeBlock> blocks_;
  std::size_t cut_count_ = 0;
  double cut_measure_ = 0, measure_ = 0;
};

namespace detail {

/// True if a side of the domain has made a face of the body.
template <class Geometry>
[[nodiscard]] bool touches_boundary(const Body<Geometry>& body, const std::vector<Cut>& cuts) {
  for (const auto& part : body.parts)
    for (std::size_t k = 0; k < part.size(); ++k)
      if (const int cut = part.cut(k);
          cut >= 0 && cuts[static_cast<std::size_t>(cut)].kind == Cut::Kind::boundary)
        return true;
  return false;
}

/// Extents along the axes [m].
template <class Geometry>
[[nodiscard]] Vec<Geometry::dim> extents_of(const Body<Geometry>& body) {
  auto low = body.parts.front().vertex(0), high = low;
  for (const auto& part : body.parts)
    for (const auto& v : part.vertices()) {
      low = smaller_of(low, v);
      high = larger_of(high, v);
    }
  return high - low;
}

}  // namespace detail

template <class Geometry>
WholeBlockSizes::WholeBlockSizes(const RockMass<Geometry>& mass) {
  const auto sides = mass.domain.size();
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const Body<Geometry>& body = mass.bodies[b];
    const double size = body.properties.measure;
    if (detail::touches_boundary(body, mass.cuts)) {
      ++cut_count_;
      cut_measure_ += size;
      continue;
    }
    const auto extents = detail::extents_of(body);
    double weight = 1;
    // A joint may run along a side at no distance from it: there the weight would have no end.
    for (int k = 0; k < Geometry::dim; ++k)
      weight *= sides[k] / std::max(sides[k] - extents[k], 1e-3 * sides[k]);
    blocks_.push_back({static_cast<int>(b), size, weight, 0, 0});
  }
  finish();
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void WholeBlockSizes::finish() {
  std::vector<double> sizes;
  for (const WholeBlock& block : blocks_) sizes.push_back(block.size);
  std::vector<WholeBlock> sorted;
  double sum = 0, true_sum = 0;
  for (const std::size_t k : order_of_values(sizes)) {
    sorted.push_back(blocks_[k]);
    sorted.back().passing = sum += blocks_[k].size;
    sorted.back().true_passing = true_sum += blocks_[k].weight * blocks_[k].size;
  }
  for (WholeBlock& block : sorted) {
    block.passing /= sum;
    block.true_passing /= true_sum;
  }
  measure_ = sum;
  blocks_ = std::move(sorted);
}

VOUSSOIR_INLINE double WholeBlockSizes::mean() const {
  if (blocks_.empty()) return std::numeric_limits<double>::quiet_NaN();
  return measure_ / static_cast<double>(blocks_.size());
}

VOUSSOIR_INLINE double WholeBlockSizes::median() const {
  if (blocks_.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = blocks_.size();
  return 0.5 * (blocks_[(n - 1) / 2].size + blocks_[n / 2].size);
}

VOUSSOIR_INLINE double WholeBlockSizes::at(double share, double WholeBlock::*passing) const {
  require(share >= 0 && share <= 1, "share of the rock", share, "0 to 1");
  if (blocks_.empty()) return std::numeric_limits<double>::quiet_NaN();
  for (const WholeBlock& block : blocks_)
    if (block.*passing >= share) return block.size;
  return blocks_.back().size;  // the sum of shares may round to less than 1
}

#endif

}  // namespace voussoir
